// SPDX-License-Identifier: MIT

#include "stream_writer.hpp"
#include "stream_format.hpp"

#include "modules/image/io/header_lines.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <memory>
#include <new>
#include <vector>

namespace
{

struct StreamWriter
{
    const StreamFormat *format = nullptr;
    const cm_image_stream *stream = nullptr;
    cm_pnm_picture picture = {};
    char comments[CM_HEADER_LINES_SIZE] = "";
    std::vector<unsigned char> rows; // what is not written as it comes; else one row

    std::size_t row_size() const
    {
        return std::size_t{picture.width} * picture.channels * cm_pixel_size(picture.type);
    }
    bool keeps_all() const
    {
        return picture.kind == CM_PNM_PFM || format->planes;
    }
};

StreamWriter &writer_of(cm_image_writer *writer)
{
    return *reinterpret_cast<StreamWriter *>(writer);
}

template <typename Number>
void round_row(const unsigned char *from, std::ptrdiff_t stride, std::size_t width,
               std::size_t channels, Number most, unsigned char *to)
{
    for (std::size_t i = 0; i < width; ++i, from += stride)
    {
        for (std::size_t c = 0; c < channels; ++c, to += sizeof most)
        {
            float value = 0;
            std::memcpy(&value, from + c * sizeof value, sizeof value);
            // NaN is 0
            const float inside = value > 0 ? std::min(value, 1.0f) : 0.0f;
            const auto number = static_cast<Number>(inside * static_cast<float>(most) + 0.5f);
            std::memcpy(to, &number, sizeof number);
        }
    }
}

// One row in the picture's own type.
void convert_row(const StreamWriter &writer, cm_pixel_type type, const unsigned char *from,
                 std::ptrdiff_t stride, unsigned char *to)
{
    const cm_pnm_picture &picture = writer.picture;
    const std::size_t pixel = picture.channels * cm_pixel_size(picture.type);
    if (type == picture.type)
    {
        for (std::size_t i = 0; i < picture.width; ++i, from += stride, to += pixel)
        {
            std::memcpy(to, from, pixel);
        }
    }
    else if (picture.type == CM_PIXEL_U8)
    {
        round_row<std::uint8_t>(from, stride, picture.width, picture.channels, UINT8_MAX, to);
    }
    else
    {
        round_row<std::uint16_t>(from, stride, picture.width, picture.channels, UINT16_MAX, to);
    }
}

cm_image rows_at(const void *data, std::uint32_t count, std::ptrdiff_t row_stride,
                 std::ptrdiff_t pixel_stride)
{
    cm_image rows = {};
    rows.size = sizeof rows;
    rows.data = const_cast<void *>(data); // only read
    rows.height = count;
    rows.row_stride = row_stride;
    rows.pixel_stride = pixel_stride;
    return rows;
}

cm_status create(const char * /*path*/, const cm_image_stream *stream,
                 const cm_image_description *description, cm_image_writer **writer, char *message)
{
    auto made = std::make_unique<StreamWriter>();
    made->format = find_stream_format(description->format);
    made->stream = stream;
    if (made->format == nullptr || stream == nullptr)
    {
        std::snprintf(message, CM_IMAGE_MESSAGE, "cannot be written as '%s'", description->format);
        return CM_ERROR_ARGUMENT;
    }
    made->picture.size = sizeof made->picture;
    made->picture.kind = made->format->kind;
    made->picture.width = description->width;
    made->picture.height = description->height;
    made->picture.channels = description->channels;
    made->picture.type = held_type(*made->format, description->type);
    made->picture.alpha =
        description->alpha >= 0 && (description->channels == 2 || description->channels == 4) ? 1
                                                                                              : 0;
    made->picture.little_endian = 1;
    cm_header_lines_write(description, made->comments);
    made->picture.comments = made->comments;
    const cm_status status = cm_pnm_write_header(stream, &made->picture, message);
    if (status == CM_OK)
    {
        *writer = reinterpret_cast<cm_image_writer *>(made.release());
    }
    return status;
}

cm_status write(cm_image_writer *given, std::uint32_t first, std::uint32_t end, cm_pixel_type type,
                const void *pixels, std::ptrdiff_t pixel_stride, std::ptrdiff_t row_stride,
                char *message)
{
    StreamWriter &writer = writer_of(given);
    const std::uint32_t count = end - first;
    if (type != writer.picture.type && (type != CM_PIXEL_FLOAT || writer.keeps_all()))
    {
        std::snprintf(message, CM_IMAGE_MESSAGE, "cannot be written from this type of pixel");
        return CM_ERROR_ARGUMENT;
    }
    if (type == writer.picture.type && !writer.keeps_all())
    {
        const cm_image rows = rows_at(pixels, count, row_stride, pixel_stride);
        return cm_pnm_write_rows(writer.stream, &writer.picture, &rows, message);
    }
    const std::size_t size = writer.row_size();
    const std::ptrdiff_t down =
        row_stride != 0 ? row_stride
                        : pixel_stride * static_cast<std::ptrdiff_t>(writer.picture.width);
    const std::size_t begin = writer.keeps_all() ? writer.rows.size() : 0;
    writer.rows.resize(begin + size * count);
    for (std::uint32_t i = 0; i < count; ++i)
    {
        convert_row(writer, type,
                    static_cast<const unsigned char *>(pixels) +
                        static_cast<std::ptrdiff_t>(i) * down,
                    pixel_stride, writer.rows.data() + begin + i * size);
    }
    if (writer.keeps_all())
    {
        return CM_OK;
    }
    const cm_image rows = rows_at(writer.rows.data(), count, 0, 0);
    return cm_pnm_write_rows(writer.stream, &writer.picture, &rows, message);
}

cm_status finish(cm_image_writer *given, char *message)
{
    StreamWriter &writer = writer_of(given);
    const cm_pnm_picture &picture = writer.picture;
    const std::size_t size = writer.row_size();
    if (picture.kind == CM_PNM_PFM)
    {
        const cm_image rows = rows_at(writer.rows.data() + size * (picture.height - 1),
                                      picture.height, -static_cast<std::ptrdiff_t>(size), 0);
        return cm_pnm_write_rows(writer.stream, &picture, &rows, message);
    }
    cm_status status = CM_OK;
    for (std::size_t i = 0; writer.format->planes && i < picture.channels && status == CM_OK; ++i)
    {
        cm_pnm_picture plane = picture;
        plane.channels = 1;
        const cm_image rows = rows_at(
            writer.rows.data() + plane_channels[i] * cm_pixel_size(picture.type), picture.height,
            static_cast<std::ptrdiff_t>(size), static_cast<std::ptrdiff_t>(size / picture.width));
        status = cm_pnm_write_rows(writer.stream, &plane, &rows, message);
    }
    return status;
}

void drop(cm_image_writer *given)
{
    delete reinterpret_cast<StreamWriter *>(given);
}

// No exception passes a function of the table.
template <typename Function> cm_status guarded(const Function &function)
{
    try
    {
        return function();
    }
    catch (const std::bad_alloc &)
    {
        return CM_ERROR_MEMORY;
    }
}

} // namespace

const cm_image_io &stream_writing()
{
    static const cm_image_io table = []
    {
        cm_image_io made = {};
        made.version = CM_IMAGE_IO_VERSION;
        made.size = sizeof made;
        made.create = [](const char *path, const cm_image_stream *stream,
                         const cm_image_description *description, cm_image_writer **writer,
                         char *message)
        { return guarded([&] { return create(path, stream, description, writer, message); }); };
        made.write = [](cm_image_writer *writer, std::uint32_t first, std::uint32_t end,
                        cm_pixel_type type, const void *pixels, std::ptrdiff_t pixel_stride,
                        std::ptrdiff_t row_stride, char *message)
        {
            return guarded(
                [&] {
                    return write(writer, first, end, type, pixels, pixel_stride, row_stride,
                                 message);
                });
        };
        made.finish = finish;
        made.drop = drop;
        return made;
    }();
    return table;
}
