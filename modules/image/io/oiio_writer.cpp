// SPDX-License-Identifier: MIT
//
// Writing image files with OpenImageIO.

#include "header_lines.h"
#include "row_writer.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>
#include <vector>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

namespace
{

// The greatest number of Radiance's pixels: 255 of 256 parts, and an exponent of 255 - 128.
constexpr float most_light = 0x1.fep126f;

// The caller's stream as the library wants it: one that never fails.
class StreamProxy : public OIIO::Filesystem::IOProxy
{
public:
    // lines: what the file has behind its first line, and the library does not write; none of a format that is sought in
    StreamProxy(const cm_image_stream &to, const std::string &path, std::string lines)
        : IOProxy(path, Write), stream(to), second_lines(std::move(lines))
    {
    }
    // Not "file": the library takes what calls itself that for its own IOFile.
    const char *proxytype() const override
    {
        return "stream";
    }
    bool seek(std::int64_t offset) override
    {
        stream.seek(stream.context, offset);
        m_pos = offset;
        return true;
    }
    std::size_t read(void *buffer, std::size_t size) override
    {
        const std::size_t count = stream.read(stream.context, buffer, size);
        m_pos += static_cast<std::int64_t>(count);
        return count;
    }
    std::size_t write(const void *buffer, std::size_t size) override
    {
        const auto *const bytes = static_cast<const char *>(buffer);
        const void *const end = second_lines.empty() ? nullptr : std::memchr(bytes, '\n', size);
        const std::size_t before =
            end == nullptr ? size
                           : static_cast<std::size_t>(static_cast<const char *>(end) - bytes) + 1;
        stream.write(stream.context, bytes, before);
        if (end != nullptr)
        {
            stream.write(stream.context, second_lines.data(), second_lines.size());
            second_lines.clear();
            stream.write(stream.context, bytes + before, size - before);
        }
        m_pos += static_cast<std::int64_t>(size);
        return size;
    }
    std::size_t size() const override
    {
        return stream.size(stream.context);
    }

private:
    const cm_image_stream stream;
    std::string second_lines;
};

// What Radiance's header has beside the library's lines.
std::string lines_of(const cm_image_description &description)
{
    char lines[CM_HEADER_LINES_SIZE] = "";
    if (std::strcmp(description.format, "hdr") == 0)
    {
        cm_header_lines_write(&description, lines);
    }
    return lines;
}

OIIO::TypeDesc stored_type(const cm_image_description &description)
{
    check_type(description.type);
    const OIIO::TypeDesc type = description.stored_type == nullptr
                                    ? type_of(description.type)
                                    : OIIO::TypeDesc(description.stored_type);
    if (type == OIIO::TypeUnknown || type.aggregate != OIIO::TypeDesc::SCALAR || type.arraylen != 0)
    {
        throw ImageFailure("cannot be written: no such type of pixels", CM_ERROR_ARGUMENT);
    }
    return type;
}

void add_tags(const cm_image_description &description, OIIO::ImageSpec &spec)
{
    for (std::size_t i = 0; i < description.tag_count; ++i)
    {
        const cm_image_tag &tag = description.tags[i];
        if (tag.type == nullptr)
        {
            spec.attribute(tag.key, tag.text);
            continue;
        }
        const OIIO::TypeDesc type(tag.type);
        if (tag.data == nullptr || type.size() == 0 || type.size() != tag.data_size)
        {
            throw ImageFailure(std::string("cannot be written: the tag ") + tag.key +
                                   " is not of its type, " + tag.type,
                               CM_ERROR_ARGUMENT);
        }
        spec.attribute(tag.key, type, tag.data);
    }
}

void add_channels(const cm_image_description &description, OIIO::ImageSpec &spec)
{
    if (description.channel_names != nullptr)
    {
        spec.channelnames.assign(description.channel_names,
                                 description.channel_names + description.channels);
    }
    spec.z_channel = -1;
    for (int i = 0; i < spec.nchannels; ++i)
    {
        if (spec.channel_name(i) == OIIO::string_view("Z"))
        {
            spec.z_channel = i;
        }
    }
    spec.alpha_channel = description.alpha;
    // PNG's second and fourth channels are alpha to the library, whatever is said: then nothing is to be divided by it.
    if (description.alpha >= 0 || std::strcmp(description.format, "png") == 0)
    {
        const bool multiplied = description.alpha >= 0 && description.alpha_multiplied;
        spec.attribute("oiio:UnassociatedAlpha", multiplied ? 0 : 1);
    }
}

OIIO::ImageSpec spec_of(const cm_image_description &description)
{
    if (description.width == 0 || description.height == 0 || description.channels == 0 ||
        description.width > INT32_MAX || description.height > INT32_MAX ||
        description.channels > INT16_MAX || description.alpha < -1 ||
        description.alpha >= static_cast<std::int32_t>(description.channels) ||
        (description.tile_width == 0) != (description.tile_height == 0) ||
        description.tile_width > INT16_MAX || description.tile_height > INT16_MAX)
    {
        throw ImageFailure("cannot be written: sizes or channels that no picture has",
                           CM_ERROR_ARGUMENT);
    }
    OIIO::ImageSpec spec(static_cast<int>(description.width), static_cast<int>(description.height),
                         static_cast<int>(description.channels), stored_type(description));
    add_tags(description, spec);
    add_channels(description, spec);
    spec.tile_width = static_cast<int>(description.tile_width);
    spec.tile_height = static_cast<int>(description.tile_height);
    if (description.color != CM_IMAGE_COLOR_UNKNOWN)
    {
        spec.attribute("oiio:ColorSpace",
                       description.color == CM_IMAGE_COLOR_SRGB ? "sRGB" : "Linear");
    }
    // else the library puts the time of writing there, and no file would be the same again
    if ((std::strcmp(description.format, "openexr") == 0 ||
         std::strcmp(description.format, "tiff") == 0) &&
        spec.get_string_attribute("DateTime").empty())
    {
        spec.attribute("DateTime", "1970:01:01 00:00:00");
    }
    if (description.compression != nullptr)
    {
        spec.attribute("Compression", description.compression);
    }
    else if (std::strcmp(description.format, "tiff") == 0 &&
             spec.find_attribute("Compression") == nullptr)
    {
        spec.attribute("Compression", "none");
    }
    return spec;
}

class LibraryWriter final : public cm_image_writer
{
public:
    LibraryWriter(const std::string &name, const cm_image_stream *stream,
                  const cm_image_description &description);

    void write(std::uint32_t first, std::uint32_t end, cm_pixel_type type, const char *pixels,
               std::ptrdiff_t pixel_stride, std::ptrdiff_t row_stride) override;
    void finish() override;

private:
    void check(bool good);
    void check_end() const;
    void open_parts(const cm_image_description &description);
    void begin_next_part();
    bool is_complete() const noexcept
    {
        return next_row == static_cast<std::uint32_t>(spec.height);
    }
    void write_light(std::uint32_t first, std::uint32_t end, cm_pixel_type type, const char *pixels,
                     std::ptrdiff_t pixel_stride, std::ptrdiff_t row_stride);
    void keep_rows(cm_pixel_type type, std::uint32_t rows, const char *pixels,
                   std::ptrdiff_t pixel_stride, std::ptrdiff_t row_stride);
    void write_tiles(std::uint32_t first, std::uint32_t end);

    std::string path;
    OIIO::ImageSpec spec;
    std::vector<OIIO::ImageSpec> parts; // none: one picture
    std::size_t part = 0;
    std::unique_ptr<StreamProxy> proxy; // none: by name
    std::unique_ptr<OIIO::ImageOutput> output;
    std::uint32_t next_row = 0;
    std::vector<char> kept; // rows that are not yet a row of tiles
    std::uint32_t kept_from = 0;
    cm_pixel_type kept_type = CM_PIXEL_U8;
};

// OpenImageIO 2.4 writes TIFF files with Exif metadata to a stream so that nobody can read them.
LibraryWriter::LibraryWriter(const std::string &name, const cm_image_stream *stream,
                             const cm_image_description &description)
    : path(name), spec(spec_of(description)),
      output(OIIO::ImageOutput::create(std::string(description.format)))
{
    if (!output)
    {
        throw ImageFailure("cannot be written: " + one_line(OIIO::geterror()));
    }
    if (spec.tile_width > 0 && !output->supports("tiles"))
    {
        throw ImageFailure(std::string("cannot be written: ") + description.format +
                           " has no tiles");
    }
    if (stream != nullptr && std::strcmp(description.format, "tiff") != 0 &&
        output->supports("ioproxy"))
    {
        proxy = std::make_unique<StreamProxy>(*stream, path, lines_of(description));
        output->set_ioproxy(proxy.get());
    }
    if (description.part_count > 0)
    {
        open_parts(description);
    }
    else if (!output->open(path, spec))
    {
        throw ImageFailure("cannot be written: " + one_line(output->geterror()));
    }
}

// All at once, since the file begins with what all of them are.
void LibraryWriter::open_parts(const cm_image_description &description)
{
    if (std::strcmp(description.format, "openexr") != 0)
    {
        throw ImageFailure(std::string("cannot be written: ") + description.format +
                               " has no parts with names",
                           CM_ERROR_ARGUMENT);
    }
    for (std::uint32_t i = 0; i < description.part_count; ++i)
    {
        parts.push_back(spec);
        parts.back().attribute("oiio:subimagename", description.part_names[i]);
    }
    if (!output->open(path, static_cast<int>(parts.size()), parts.data()))
    {
        throw ImageFailure("cannot be written: " + one_line(output->geterror()));
    }
}

void LibraryWriter::begin_next_part()
{
    ++part;
    check(output->open(path, parts[part], OIIO::ImageOutput::AppendSubimage));
    next_row = 0;
    kept_from = 0;
}

void LibraryWriter::check(bool good)
{
    const int number = errno;
    if (!good) // messages alone mean nothing: TIFF files without Exif metadata bring one
    {
        const bool full = number == ENOSPC || number == EFBIG || number == EDQUOT;
        throw ImageFailure("cannot be written: " +
                           (full ? std::strerror(number) : one_line(output->geterror())));
    }
}

// Radiance's pixels have one exponent and no sign: what they cannot be is the nearest that they can. Without this the
// library writes the low bits of a negative number as if it was large.
void LibraryWriter::write_light(std::uint32_t first, std::uint32_t end, cm_pixel_type type,
                                const char *pixels, std::ptrdiff_t pixel_stride,
                                std::ptrdiff_t row_stride)
{
    std::vector<float> rows(static_cast<std::size_t>(end - first) *
                            static_cast<std::size_t>(spec.width) *
                            static_cast<std::size_t>(spec.nchannels));
    OIIO::convert_image(spec.nchannels, spec.width, static_cast<int>(end - first), 1, pixels,
                        type_of(type), pixel_stride, row_stride, OIIO::AutoStride, rows.data(),
                        OIIO::TypeFloat, OIIO::AutoStride, OIIO::AutoStride, OIIO::AutoStride);
    for (float &value : rows)
    {
        value = value > 0 ? std::min(value, most_light) : 0.0f; // NaN is 0
    }
    check(output->write_scanlines(static_cast<int>(first), static_cast<int>(end), 0,
                                  OIIO::TypeFloat, rows.data()));
}

void LibraryWriter::keep_rows(cm_pixel_type type, std::uint32_t rows, const char *pixels,
                              std::ptrdiff_t pixel_stride, std::ptrdiff_t row_stride)
{
    const std::size_t pixel =
        static_cast<std::size_t>(size_of(type)) * static_cast<std::size_t>(spec.nchannels);
    const std::size_t width = static_cast<std::size_t>(spec.width);
    std::size_t at = kept.size();
    kept.resize(at + rows * width * pixel);
    for (std::uint32_t row = 0; row < rows; ++row)
    {
        const char *from = pixels + static_cast<std::ptrdiff_t>(row) * row_stride;
        for (std::size_t column = 0; column < width; ++column)
        {
            std::memcpy(kept.data() + at, from, pixel);
            at += pixel;
            from += pixel_stride;
        }
    }
    kept_type = type;
}

// All whole rows of tiles that are kept, and at the lower edge the last one.
void LibraryWriter::write_tiles(std::uint32_t first, std::uint32_t end)
{
    const std::uint32_t down = static_cast<std::uint32_t>(spec.tile_height);
    const bool last = end == static_cast<std::uint32_t>(spec.height);
    const std::uint32_t whole = last ? end : end / down * down;
    if (whole <= first)
    {
        return;
    }
    check(output->write_tiles(0, spec.width, static_cast<int>(first), static_cast<int>(whole), 0, 1,
                              type_of(kept_type), kept.data()));
    const std::size_t row = static_cast<std::size_t>(size_of(kept_type)) *
                            static_cast<std::size_t>(spec.nchannels) *
                            static_cast<std::size_t>(spec.width);
    kept.erase(kept.begin(), kept.begin() + static_cast<std::ptrdiff_t>((whole - first) * row));
    kept_from = whole;
}

void LibraryWriter::write(std::uint32_t first, std::uint32_t end, cm_pixel_type type,
                          const char *pixels, std::ptrdiff_t pixel_stride,
                          std::ptrdiff_t row_stride)
{
    if (first == 0 && is_complete() && part + 1 < parts.size())
    {
        errno = 0;
        begin_next_part();
    }
    if (first != next_row || end <= first || end > static_cast<std::uint32_t>(spec.height) ||
        (!kept.empty() && type != kept_type))
    {
        throw ImageFailure("cannot be written: rows must come in order, each once, of one type",
                           CM_ERROR_ARGUMENT);
    }
    const std::ptrdiff_t x_stride =
        pixel_stride == 0 ? size_of(type) * spec.nchannels : pixel_stride;
    const std::ptrdiff_t y_stride = row_stride == 0 ? x_stride * spec.width : row_stride;
    errno = 0;
    if (spec.tile_width > 0)
    {
        keep_rows(type, end - first, pixels, x_stride, y_stride);
        write_tiles(kept_from, end);
    }
    else if (std::strcmp(output->format_name(), "hdr") == 0)
    {
        write_light(first, end, type, pixels, x_stride, y_stride);
    }
    else
    {
        check(output->write_scanlines(static_cast<int>(first), static_cast<int>(end), 0,
                                      type_of(type), pixels, x_stride, y_stride));
    }
    next_row = end;
}

void LibraryWriter::finish()
{
    if (!is_complete() || part + 1 < parts.size())
    {
        throw ImageFailure("cannot be written: rows are missing", CM_ERROR_ARGUMENT);
    }
    errno = 0;
    check(output->close());
    if (!proxy)
    {
        check_end();
    }
}

// Not every error of writing by name is reported; but then the end is missing.
void LibraryWriter::check_end() const
{
    const auto written = OIIO::ImageInput::open(path);
    bool good = written != nullptr;
    if (good)
    {
        const OIIO::ImageSpec &found = written->spec();
        const bool tiled = found.tile_width > 0;
        const int rows = tiled ? (found.height - 1) % found.tile_height + 1 : 1;
        std::vector<float> row(static_cast<std::size_t>(found.width) *
                               static_cast<std::size_t>(found.nchannels) *
                               static_cast<std::size_t>(rows));
        const int from = found.y + found.height - rows;
        good = (tiled ? written->read_tiles(0, 0, found.x, found.x + found.width, from, from + rows,
                                            0, 1, 0, found.nchannels, OIIO::TypeFloat, row.data())
                      : written->read_scanlines(0, 0, from, from + rows, 0, 0, found.nchannels,
                                                OIIO::TypeFloat, row.data())) &&
               written->geterror().empty();
    }
    OIIO::geterror();
    if (!good)
    {
        throw ImageFailure("cannot be written: the end of the file is missing");
    }
}

} // namespace

WriterPointer begin_with_library(const std::string &path, const cm_image_stream *stream,
                                 const cm_image_description &description)
{
    return std::make_unique<LibraryWriter>(path, stream, description);
}
