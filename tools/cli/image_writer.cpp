// SPDX-License-Identifier: MIT

#include "image_writer.hpp"
#include "program.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <vector>

namespace
{

constexpr const char *default_jpeg_compression = "jpeg:95";

// Metadata that a resampled image on another grid does not share with its source. A name that ends
// in '*' stands for all that begin like it.
constexpr std::array<const char *, 43> dropped_metadata = {"Orientation",
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
    return OIIO::Strutil::iequals(name, "compression") ||
           OIIO::Strutil::iequals(name, "CompressionQuality");
}

// The type in which a format keeps all of the source's precision, or what comes closest.
OIIO::TypeDesc pixel_type(const std::string &format, OIIO::TypeDesc source)
{
    if (format == "openexr" && source != OIIO::TypeHalf)
    {
        return source.size() == 1 ? OIIO::TypeHalf : OIIO::TypeFloat;
    }
    return source;
}

// How many of the channels a format can hold: all, or all but the alpha channel, or else Failure.
int held_channels(const std::string &format, const OIIO::ImageSpec &source, const std::string &path)
{
    const int all = source.nchannels;
    const int colours = source.alpha_channel == all - 1 ? all - 1 : all;
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

void copy_metadata(const OIIO::ImageSpec &source, bool same_format, OIIO::ImageSpec &spec)
{
    for (const OIIO::ParamValue &value : source.extra_attribs)
    {
        const std::string name = value.name().string();
        if (metadata_still_holds(name) && (same_format || !is_compression(name)))
        {
            spec.attribute(name, value.type(), value.data());
        }
    }
}

} // namespace

std::string output_format(const std::string &path)
{
    const std::string extension = std::filesystem::path(path).extension().string();
    std::string format;
    if (extension.size() > 1)
    {
        const std::unique_ptr<OIIO::ImageOutput> writer =
            OIIO::ImageOutput::create("x" + extension);
        format = writer ? writer->format_name() : "";
        OIIO::geterror(); // so that it does not come up later
    }
    for (const char *known : {"png", "jpeg", "tiff", "openexr", "hdr"})
    {
        if (format == known)
        {
            return format;
        }
    }
    throw UsageFailure(in_quotes(path) + ": an output's name must end in .png, .jpg, .tif, .exr "
                                         "or .hdr");
}

ImagePlan plan_image(const std::string &format, const OIIO::ImageSpec &source,
                     const std::string &source_format, const std::string &path)
{
    const int channels = held_channels(format, source, path);
    ImagePlan plan = {format, OIIO::ImageSpec(1, 1, channels, pixel_type(format, source.format)),
                      channels != source.nchannels, false};
    copy_metadata(source, format == source_format, plan.spec);
    plan.spec.channelnames.assign(source.channelnames.begin(),
                                  source.channelnames.begin() + channels);
    plan.spec.alpha_channel = source.alpha_channel < channels ? source.alpha_channel : -1;
    plan.spec.z_channel = source.z_channel < channels ? source.z_channel : -1;
    if (plan.spec.alpha_channel >= 0 && source.get_int_attribute("oiio:UnassociatedAlpha", 0) != 0)
    {
        plan.multiply_alpha = format == "openexr";
        plan.spec.attribute("oiio:UnassociatedAlpha", plan.multiply_alpha ? 0 : 1);
    }
    if (format == "jpeg" && !plan.spec.extra_attribs.contains("Compression"))
    {
        plan.spec.attribute("Compression", default_jpeg_compression);
    }
    if (format == "jpeg" && !plan.spec.extra_attribs.contains("jpeg:subsampling"))
    {
        plan.spec.attribute("jpeg:subsampling", "4:4:4");
    }
    return plan;
}

// OpenImageIO 2.4 writes TIFF files with Exif metadata to a stream so that nobody can read them.
ImageWriter::ImageWriter(const ImagePlan &plan, int width, int height, const std::string &path,
                         AtomicFile &destination)
    : name(path), file(destination), by_name(plan.format == "tiff"),
      output(OIIO::ImageOutput::create(plan.format))
{
    OIIO::ImageSpec spec = plan.spec;
    spec.width = spec.full_width = width;
    spec.height = spec.full_height = height;
    if (!output || !open(spec))
    {
        const std::string message = output ? output->geterror() : OIIO::geterror();
        throw Failure(in_quotes(name) + " cannot be written: " + first_line(message));
    }
}

bool ImageWriter::open(const OIIO::ImageSpec &spec)
{
    return by_name ? output->open(file.temporary_name(), spec)
                   : output->set_ioproxy(&file) && output->open(name, spec);
}

void ImageWriter::check(bool good)
{
    const int number = errno;
    file.check();
    if (!good) // messages alone mean nothing: TIFF files without Exif metadata bring one
    {
        const bool full = number == ENOSPC || number == EFBIG || number == EDQUOT;
        throw Failure(in_quotes(name) + " cannot be written: " +
                      (full ? std::strerror(number) : first_line(output->geterror())));
    }
}

void ImageWriter::write(int first, int end, const float *rows, int channels)
{
    const OIIO::stride_t x_stride = static_cast<OIIO::stride_t>(sizeof(float)) * channels;
    errno = 0;
    check(output->write_scanlines(first, end, 0, OIIO::TypeFloat, rows, x_stride,
                                  x_stride * output->spec().width));
}

void ImageWriter::close()
{
    errno = 0;
    check(output->close());
    if (by_name)
    {
        check_end();
    }
}

// Not every error of writing by name is reported; but then the end is missing.
void ImageWriter::check_end() const
{
    const auto written = OIIO::ImageInput::open(file.temporary_name());
    bool good = written != nullptr;
    if (good)
    {
        const OIIO::ImageSpec &spec = written->spec();
        std::vector<float> row(static_cast<std::size_t>(spec.width) *
                               static_cast<std::size_t>(spec.nchannels));
        good = written->read_scanlines(0, 0, spec.height - 1, spec.height, 0, 0, spec.nchannels,
                                       OIIO::TypeFloat, row.data()) &&
               written->geterror().empty();
    }
    OIIO::geterror();
    if (!good)
    {
        throw Failure(in_quotes(name) + " cannot be written: the end of the file is missing");
    }
}
