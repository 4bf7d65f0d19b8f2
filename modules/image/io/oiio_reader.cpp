// SPDX-License-Identifier: MIT
//
// Reading image files with OpenImageIO.

#include "geo_tags.h"
#include "header_tags.hpp"
#include "image_reader.hpp"
#include "opened_file.hpp"
#include "whole_png.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <memory>
#include <vector>

#include <OpenImageIO/imageio.h>

namespace
{

// Parts of rows are taken out of whole rows, of about so many bytes at a time.
constexpr std::size_t band_bytes = std::size_t{1} << 20;

// As the JPEG library says it.
bool ends_too_early(const std::string &message)
{
    return message.find("remature end") != std::string::npos;
}

// Does this message, with which a file was decoded, mean that pixels are missing or wrong? The JPEG library also complains
// of whole files, where stray bytes stand between their parts.
bool pixels_are_missing(const std::string &format, const std::string &message)
{
    return format == "jpeg" ? ends_too_early(message) : !message.empty();
}

// So that no other library makes up what is missing.
void refuse_what_ends(const std::string &line)
{
    if (ends_too_early(line))
    {
        throw ImageFailure("is damaged or ends too early: " + line, CM_ERROR_DATA);
    }
}

std::unique_ptr<OIIO::ImageInput> open_input(const std::string &path)
{
    OIIO::ImageSpec request;
    request.attribute("oiio:UnassociatedAlpha", 1);
    std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(path, &request);
    if (!input)
    {
        const std::string line = one_line(OIIO::geterror());
        refuse_what_ends(line);
        throw ImageFailure("is not an image that can be read: " +
                           (line.empty() ? "it is damaged or ends too early" : line));
    }
    refuse_what_ends(one_line(input->geterror())); // within its head
    return input;
}

void check_flat(const OIIO::ImageSpec &spec)
{
    if (spec.width <= 0 || spec.height <= 0 || spec.nchannels <= 0)
    {
        throw ImageFailure("has no pixels: it is " + std::to_string(spec.width) + " x " +
                           std::to_string(spec.height) + " with " + std::to_string(spec.nchannels) +
                           " channels");
    }
    if (spec.depth > 1 || spec.deep)
    {
        throw ImageFailure("is a volume or a deep image; a flat one is needed");
    }
}

cm_image_color color_of(const OIIO::ImageSpec &spec)
{
    const std::string name = spec.get_string_attribute("oiio:ColorSpace");
    const auto is = [&name](const char *word) { return OIIO::Strutil::iequals(name, word); };
    return is("sRGB")                                             ? CM_IMAGE_COLOR_SRGB
           : is("linear") || is("scene_linear") || is("lin_srgb") ? CM_IMAGE_COLOR_LINEAR
                                                                  : CM_IMAGE_COLOR_UNKNOWN;
}

class LibraryReader final : public cm_image_reader
{
public:
    LibraryReader(const std::string &path, std::uint32_t which);
    ~LibraryReader() override
    {
        std::free(geo_tags);
    }

    void read(const cm_image_region &region, cm_pixel_type type, char *pixels,
              std::ptrdiff_t row_stride) override;

private:
    void choose_subimage(std::uint32_t which, const std::string &path);
    void describe(const std::string &path);
    void describe_window();
    void describe_tags();
    void describe_header(const std::string &path, HeaderTags (*tags_of)(std::FILE *));
    const char *keep(const std::string &text);
    bool read_native(const cm_image_region &region, OIIO::TypeDesc type, char *pixels,
                     std::ptrdiff_t row_stride);
    void read_part(const cm_image_region &region, cm_pixel_type type, char *pixels,
                   std::ptrdiff_t row_stride);
    void check(bool good);

    std::unique_ptr<OIIO::ImageInput> input;
    OIIO::ImageSpec spec;
    int subimage = 0;
    cm_image_geo_tags *geo_tags = nullptr;
    std::deque<std::string> texts; // which the description points to
    std::vector<const char *> names;
    std::vector<cm_image_tag> tags;
};

LibraryReader::LibraryReader(const std::string &path, std::uint32_t which)
{
    if (!cm_png_is_whole(path.c_str()))
    {
        throw ImageFailure("is damaged or ends too early: a PNG file without its end",
                           CM_ERROR_DATA);
    }
    input = open_input(path);
    choose_subimage(which, path);
    check_flat(spec);
    describe(path);
    if (std::strcmp(input->format_name(), "tiff") == 0)
    {
        if (cm_geo_tags_are_cut(path.c_str(), which))
        {
            throw ImageFailure("is damaged or ends too early: what it says of itself is not whole",
                               CM_ERROR_DATA);
        }
        geo_tags = cm_geo_tags_read(path.c_str(), which);
        description.geo_tags = geo_tags;
    }
}

// Counts them, too.
void LibraryReader::choose_subimage(std::uint32_t which, const std::string &path)
{
    std::uint32_t count = 0;
    const auto is_there = [this, &count]
    { return input->spec_dimensions(static_cast<int>(count)).width != 0 || count == 0; };
    while (count < INT32_MAX && is_there())
    {
        ++count;
    }
    input->geterror(); // that there are no more
    if (std::strcmp(input->format_name(), "webp") == 0)
    {
        input =
            open_input(path); // which was asked for one too many, and complains of all that follow
    }
    if (which >= count)
    {
        throw ImageFailure("has no picture " + std::to_string(which) + "; it has " +
                               std::to_string(count) + ", from 0",
                           CM_ERROR_ARGUMENT);
    }
    subimage = static_cast<int>(which);
    spec = input->spec(subimage);
    description.subimage = which;
    description.subimage_count = count;
}

const char *LibraryReader::keep(const std::string &text)
{
    texts.push_back(text);
    return texts.back().c_str();
}

void LibraryReader::describe(const std::string &path)
{
    description.format = input->format_name();
    description.width = static_cast<std::uint32_t>(spec.width);
    description.height = static_cast<std::uint32_t>(spec.height);
    description.channels = static_cast<std::uint32_t>(spec.nchannels);
    description.type = pixel_type_of(spec.format);
    description.stored_type = spec.format.c_str();
    description.whole_numbers = !spec.format.is_floating_point();
    for (int i = 0; i < spec.nchannels; ++i)
    {
        names.push_back(keep(std::string(spec.channel_name(i))));
    }
    description.channel_names = names.data();
    // of GIF files the library says 4 of 4 channels
    const auto letter = std::find(spec.channelnames.begin(), spec.channelnames.end(), "A");
    description.alpha = spec.alpha_channel < spec.nchannels ? spec.alpha_channel
                        : letter == spec.channelnames.end()
                            ? -1
                            : static_cast<std::int32_t>(letter - spec.channelnames.begin());
    description.alpha_multiplied = spec.get_int_attribute("oiio:UnassociatedAlpha", 0) == 0;
    description.color = color_of(spec);
    const int orientation = spec.get_int_attribute("Orientation", 1);
    description.orientation =
        orientation < 1 || orientation > 8 ? 1 : static_cast<std::uint32_t>(orientation);
    description.tile_width = static_cast<std::uint32_t>(spec.tile_width);
    description.tile_height = static_cast<std::uint32_t>(spec.tile_height);
    const std::string compression = spec.get_string_attribute("Compression");
    description.compression = compression.empty() ? nullptr : keep(compression);
    const std::string name = spec.get_string_attribute("oiio:subimagename");
    description.subimage_name = name.empty() ? nullptr : keep(name);
    describe_window();
    describe_tags();
    if (std::strcmp(description.format, "hdr") == 0)
    {
        describe_header(path, radiance_tags);
    }
    if (std::strcmp(description.format, "pnm") == 0)
    {
        describe_header(path, pnm_tags);
    }
}

void LibraryReader::describe_window()
{
    const bool windows = std::strcmp(input->format_name(), "openexr") == 0;
    if (windows && (spec.full_width <= 0 || spec.full_height <= 0))
    {
        throw ImageFailure("has an empty display window");
    }
    description.left = windows ? spec.x - spec.full_x : 0;
    description.top = windows ? spec.y - spec.full_y : 0;
    description.window_width = static_cast<std::uint32_t>(windows ? spec.full_width : spec.width);
    description.window_height =
        static_cast<std::uint32_t>(windows ? spec.full_height : spec.height);
}

void LibraryReader::describe_tags()
{
    for (const OIIO::ParamValue &value : spec.extra_attribs)
    {
        const std::size_t size = static_cast<std::size_t>(value.datasize());
        tags.push_back({keep(value.name().string()), keep(value.get_string()),
                        keep(value.type().c_str()), value.data(), size});
    }
    description.tags = tags.data();
    description.tag_count = tags.size();
}

// The library passes over lines that it does not know.
void LibraryReader::describe_header(const std::string &path, HeaderTags (*tags_of)(std::FILE *))
{
    const FilePointer file(std::fopen(path.c_str(), "rb"));
    for (const auto &[key, text] : file ? tags_of(file.get()) : HeaderTags())
    {
        tags.push_back({keep(key), keep(text), nullptr, nullptr, 0});
    }
    description.tags = tags.data();
    description.tag_count = tags.size();
}

void LibraryReader::check(bool good)
{
    const std::string message = input->geterror();
    if (!good || pixels_are_missing(input->format_name(), message))
    {
        throw ImageFailure("is damaged or ends too early" +
                           (message.empty() ? "" : ": " + one_line(message)));
    }
}

// What the library reads without help: whole rows, or whole tiles.
bool LibraryReader::read_native(const cm_image_region &region, OIIO::TypeDesc type, char *pixels,
                                std::ptrdiff_t row_stride)
{
    const int top = spec.y + static_cast<int>(region.y0);
    const int bottom = spec.y + static_cast<int>(region.y1);
    if (spec.tile_width > 0)
    {
        return input->read_tiles(subimage, 0, spec.x + static_cast<int>(region.x0),
                                 spec.x + static_cast<int>(region.x1), top, bottom, spec.z,
                                 spec.z + 1, 0, spec.nchannels, type, pixels, OIIO::AutoStride,
                                 row_stride, OIIO::AutoStride);
    }
    return input->read_scanlines(subimage, 0, top, bottom, spec.z, 0, spec.nchannels, type, pixels,
                                 OIIO::AutoStride, row_stride);
}

// In bands of rows, or of rows of tiles, of which the columns that are wanted are copied.
void LibraryReader::read_part(const cm_image_region &region, cm_pixel_type type, char *pixels,
                              std::ptrdiff_t row_stride)
{
    const bool tiled = spec.tile_width > 0;
    const std::uint32_t across = tiled ? static_cast<std::uint32_t>(spec.tile_width) : 1;
    const std::uint32_t down = tiled ? static_cast<std::uint32_t>(spec.tile_height) : 1;
    const std::uint32_t x0 = tiled ? region.x0 / across * across : 0;
    const std::uint64_t x_end = (std::uint64_t{region.x1} + across - 1) / across * across;
    const std::uint32_t x1 =
        tiled ? static_cast<std::uint32_t>(std::min<std::uint64_t>(x_end, description.width))
              : description.width;
    const std::size_t pixel = static_cast<std::size_t>(size_of(type)) * description.channels;
    const std::size_t stride = pixel * (x1 - x0);
    const std::size_t fitting = std::max<std::size_t>(band_bytes / (stride * down), 1) * down;
    const std::uint64_t y_end = (std::uint64_t{region.y1} + down - 1) / down * down;
    const std::uint64_t last = std::min<std::uint64_t>(y_end, description.height);
    std::vector<char> band;
    for (std::uint64_t y = region.y0 / down * down; y < region.y1;)
    {
        const std::uint64_t end = std::min<std::uint64_t>(y + fitting, last);
        const cm_image_region whole = {x0, static_cast<std::uint32_t>(y), x1,
                                       static_cast<std::uint32_t>(end)};
        band.resize(stride * static_cast<std::size_t>(end - y));
        check(read_native(whole, type_of(type), band.data(), static_cast<std::ptrdiff_t>(stride)));
        for (std::uint64_t row = std::max<std::uint64_t>(y, region.y0);
             row < std::min<std::uint64_t>(end, region.y1); ++row)
        {
            std::memcpy(pixels + static_cast<std::ptrdiff_t>(row - region.y0) * row_stride,
                        band.data() + stride * static_cast<std::size_t>(row - y) +
                            pixel * (region.x0 - x0),
                        pixel * (region.x1 - region.x0));
        }
        y = end;
    }
}

void LibraryReader::read(const cm_image_region &region, cm_pixel_type type, char *pixels,
                         std::ptrdiff_t row_stride)
{
    const bool all_columns = region.x0 == 0 && region.x1 == description.width;
    const bool all_rows = region.y0 == 0 && region.y1 == description.height;
    if (all_columns && all_rows)
    {
        check(input->read_image(subimage, 0, 0, spec.nchannels, type_of(type), pixels,
                                OIIO::AutoStride, row_stride, OIIO::AutoStride));
    }
    else if (all_columns && spec.tile_width == 0)
    {
        check(read_native(region, type_of(type), pixels, row_stride));
    }
    else
    {
        read_part(region, type, pixels, row_stride);
    }
}

} // namespace

ReaderPointer open_with_library(const std::string &path, std::uint32_t which)
{
    return std::make_unique<LibraryReader>(path, which);
}
