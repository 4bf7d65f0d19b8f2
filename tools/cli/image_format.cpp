// SPDX-License-Identifier: MIT

#include "image_format.hpp"
#include "lower_case.hpp"
#include "program.hpp"
#include "stream_format.hpp"

#include <algorithm>
#include <array>
#include <filesystem>

namespace
{

constexpr const char *default_jpeg_compression = "jpeg:95";

struct Extension
{
    const char *extension;
    const char *format;
};

constexpr Extension extensions[] = {
    {".png", "png"},   {".jpg", "jpeg"},    {".jpe", "jpeg"},    {".jpeg", "jpeg"},
    {".jif", "jpeg"},  {".jfif", "jpeg"},   {".jfi", "jpeg"},    {".tif", "tiff"},
    {".tiff", "tiff"}, {".exr", "openexr"}, {".sxr", "openexr"}, {".mxr", "openexr"},
    {".hdr", "hdr"},   {".rgbe", "hdr"},    {".pgm", "pgm"},     {".ppm", "ppm"},
    {".pfm", "pfm"},
};

// Metadata that a resampled image on another grid does not share with its source. A name that ends
// in '*' stands for all that begin like it.
constexpr std::array<const char *, 44> dropped_metadata = {"Orientation",
                                                           "XResolution",
                                                           "YResolution",
                                                           "ResolutionUnit",
                                                           "PixelAspectRatio",
                                                           "Exif:PixelXDimension",
                                                           "Exif:PixelYDimension",
                                                           "Exif:ImageWidth",
                                                           "Exif:ImageLength",
                                                           "Exif:RelatedImageWidth",
                                                           "Exif:RelatedImageLength",
                                                           "GPano:*",
                                                           "Panorama:*",
                                                           "envmap",
                                                           "worldtocamera",
                                                           "worldtoscreen",
                                                           "worldtoNDC",
                                                           "worldtolocal",
                                                           "textureformat",
                                                           "wrapmodes",
                                                           "fovcot",
                                                           "thumbnail_*",
                                                           "oiio:*",
                                                           "screenWindowCenter",
                                                           "screenWindowWidth",
                                                           "openexr:lineOrder",
                                                           "openexr:levelmode",
                                                           "openexr:roundingmode",
                                                           "openexr:chunkCount",
                                                           "chunkCount",
                                                           "openexr:version",
                                                           "multiView",
                                                           "tiff:RowsPerStrip",
                                                           "tiff:subfiletype",
                                                           "tiff:PhotometricInterpretation",
                                                           "tiff:PlanarConfiguration",
                                                           "planarconfig",
                                                           "tiff:ColorSpace",
                                                           "tiff:Predictor",
                                                           "tile_width",
                                                           "tile_height",
                                                           "cubemap:*",
                                                           "preview",
                                                           "Raw profile type *"};

// Of the names that begin with "oiio:", those that hold for the pixels' values.
constexpr std::array<const char *, 2> kept_metadata = {"oiio:ColorSpace", "oiio:Gamma"};

bool matches(const std::string &name, const std::string &pattern)
{
    return pattern.back() == '*'
               ? name.compare(0, pattern.size() - 1, pattern, 0, pattern.size() - 1) == 0
               : name == pattern;
}

bool metadata_still_holds(const std::string &name)
{
    const auto is_meant = [&name](const char *pattern) { return matches(name, pattern); };
    return std::any_of(kept_metadata.begin(), kept_metadata.end(), is_meant) ||
           std::none_of(dropped_metadata.begin(), dropped_metadata.end(), is_meant);
}

bool is_compression(const std::string &name)
{
    return lower_case(name) == "compression" || lower_case(name) == "compressionquality";
}

// The type in which a format keeps all of the source's precision, or what comes closest.
void choose_type(const std::string &format, ImageDescription &description)
{
    if (format == "openexr" && description.type != CM_PIXEL_HALF)
    {
        description.type = description.type == CM_PIXEL_U8 ? CM_PIXEL_HALF : CM_PIXEL_FLOAT;
        description.stored_type.clear();
    }
}

// How many of the channels a format can hold: all, or all but the alpha channel, or else Failure.
int held_channels(const std::string &format, const ImageDescription &source,
                  const std::string &path)
{
    if (const StreamFormat *const stream = find_stream_format(format))
    {
        const int held = held_channels(*stream, source);
        if (held == 0)
        {
            throw Failure(in_quotes(path) + ": " + format + " holds " +
                          (stream->channels < 0 ? "1 or 3" : std::to_string(stream->channels)) +
                          (stream->channels == 1 ? " channel" : " channels") + ", the image has " +
                          std::to_string(source.channels) +
                          "; TIFF and EXR hold any number, and pam through a pipe");
        }
        return held;
    }
    const int all = source.channels;
    const int colours = source.alpha == all - 1 ? all - 1 : all;
    if (format == "png" && all > 4)
    {
        throw Failure(in_quotes(path) + ": PNG holds 1 to 4 channels, the image has " +
                      std::to_string(all) + "; TIFF and EXR hold any number");
    }
    if (format == "jpeg" && colours != 1 && colours != 3)
    {
        throw Failure(in_quotes(path) + ": JPEG holds 1 or 3 channels, the image has " +
                      std::to_string(all) + "; TIFF and EXR hold any number");
    }
    if (format == "hdr" && colours != 3)
    {
        throw Failure(in_quotes(path) + ": HDR holds 3 channels, the image has " +
                      std::to_string(all) + "; TIFF and EXR hold any number");
    }
    return format == "jpeg" || format == "hdr" ? colours : all;
}

} // namespace

std::string output_format(const std::string &path)
{
    const std::string extension = lower_case(std::filesystem::path(path).extension().string());
    for (const Extension &known : extensions)
    {
        if (extension == known.extension)
        {
            return known.format;
        }
    }
    throw UsageFailure(in_quotes(path) + ": an output's name must end in .png, .jpg, .tif, .exr, "
                                         ".hdr, .ppm, .pgm or .pfm");
}

cm_pixel_type held_type(const std::string &format, cm_pixel_type wanted)
{
    if (const StreamFormat *const stream = find_stream_format(format))
    {
        return held_type(*stream, wanted);
    }
    if (format == "jpeg" || (format == "png" && wanted != CM_PIXEL_U16))
    {
        return CM_PIXEL_U8;
    }
    return format == "hdr" ? CM_PIXEL_FLOAT : wanted;
}

ImagePlan plan_image(const std::string &wanted_format, const ImageDescription &source,
                     const std::string &source_format, const std::string &path)
{
    const std::string format =
        wanted_format == "pnm" ? best_stream_format(source).name : wanted_format;
    const int channels = held_channels(format, source, path);
    const bool same_format = format == source_format;
    ImagePlan plan = {format, source, channels != source.channels, false};
    ImageDescription &held = plan.description;
    const auto is_over = [same_format](const ImageTag &tag)
    { return !metadata_still_holds(tag.key) || (!same_format && is_compression(tag.key)); };
    held.tags.erase(std::remove_if(held.tags.begin(), held.tags.end(), is_over), held.tags.end());
    held.channels = channels;
    held.channel_names.resize(
        std::min(held.channel_names.size(), static_cast<std::size_t>(channels)));
    held.alpha = source.alpha < channels ? source.alpha : -1;
    held.compression = same_format ? source.compression : "";
    choose_type(format, held);
    if (held.alpha >= 0 && !source.alpha_multiplied)
    {
        plan.multiply_alpha = format == "openexr";
        held.alpha_multiplied = plan.multiply_alpha;
    }
    if (format == "jpeg" && held.compression.empty())
    {
        held.compression = default_jpeg_compression;
    }
    const auto is_subsampling = [](const ImageTag &tag) { return tag.key == "jpeg:subsampling"; };
    if (format == "jpeg" && std::none_of(held.tags.begin(), held.tags.end(), is_subsampling))
    {
        held.set("jpeg:subsampling", "4:4:4");
    }
    return plan;
}

namespace
{

// Names apart by blanks.
const char *compressions_of(const std::string &format)
{
    return format == "tiff"      ? "none lzw zip packbits"
           : format == "openexr" ? "none rle zip zips piz pxr24 b44 b44a dwaa dwab"
                                 : "";
}

bool is_number(const std::string &text, int least, int most)
{
    const bool digits = !text.empty() && text.size() <= 3 &&
                        text.find_first_not_of("0123456789") == std::string::npos;
    return digits && std::stoi(text) >= least && std::stoi(text) <= most;
}

} // namespace

void set_compression(ImagePlan &plan, const std::string &compression)
{
    const std::string names = std::string(" ") + compressions_of(plan.format) + " ";
    const bool known = compression.find(' ') == std::string::npos &&
                       names.find(" " + compression + " ") != std::string::npos;
    const std::string what = "--compression is " + in_quotes(compression) + ", not ";
    if (plan.format == "jpeg" && is_number(compression, 1, 100))
    {
        plan.description.compression = "jpeg:" + compression;
    }
    else if (plan.format == "png" && is_number(compression, 0, 9))
    {
        plan.description.compression.clear();
        plan.description.set_number("png:compressionLevel", std::stoi(compression));
    }
    else if (known && !compression.empty())
    {
        plan.description.compression = compression;
    }
    else
    {
        throw UsageFailure(plan.format == "jpeg"  ? what + "a quality from 1 to 100"
                           : plan.format == "png" ? what + "a number from 0 to 9"
                           : find_stream_format(plan.format) != nullptr
                               ? what + "to be chosen: " + plan.format + " has no compression"
                           : *compressions_of(plan.format) == '\0'
                               ? what + "to be chosen: the format has one way only"
                               : what + "one of:" + names.substr(0, names.size() - 1));
    }
}
