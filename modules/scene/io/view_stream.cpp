// SPDX-License-Identifier: MIT

#include "view_stream.h"

#include "camera_file.h"
#include "check_sum.h"
#include "file_failure.hpp"
#include "view_check.hpp"

#include "modules/image/io/file_words.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>

namespace
{

constexpr std::size_t stream_head_bytes = 24;
constexpr std::size_t view_head_bytes = 192;
constexpr std::size_t view_end_bytes = 24;
constexpr std::size_t camera_text_most = std::size_t{1} << 20;
// Memory is asked for as the bytes come, so that a head that lies costs nothing.
constexpr std::size_t part_bytes = std::size_t{1} << 20;

double f64_at(const unsigned char *bytes)
{
    const std::uint64_t bits = cm_file_u64(bytes);
    double value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
}

void put_f64(unsigned char *bytes, double value)
{
    std::uint64_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    cm_file_put_u64(bytes, bits);
}

bool sum_is(const unsigned char *bytes, std::size_t count)
{
    return cm_check_sum(CM_CHECK_SUM_BEGIN, bytes, count) == cm_file_u64(bytes + count);
}

void put_sum(unsigned char *bytes, std::size_t count)
{
    cm_file_put_u64(bytes + count, cm_check_sum(CM_CHECK_SUM_BEGIN, bytes, count));
}

// All of so many bytes, or as many as there are.
std::size_t take_all(const cm_image_stream &stream, unsigned char *bytes, std::size_t count)
{
    std::size_t done = 0;
    while (done < count)
    {
        const std::size_t some = stream.read(stream.context, bytes + done, count - done);
        if (some == 0)
        {
            break;
        }
        done += some;
    }
    return done;
}

} // namespace

struct cm_view_reader
{
    cm_view_reader(const char *stream_name, const cm_image_stream &from);
    const cm_view *next();

    CameraPointer camera;
    double depth_scale = 0.0;

private:
    [[noreturn]] void fail(const std::string &text, cm_status status = CM_ERROR_DATA) const
    {
        fail_file(name, "view " + std::to_string(count) + ": " + text, status);
    }
    void read_head(const unsigned char *head);
    void read_picture(OwnPicture &picture, const unsigned char *head, std::uint64_t &left,
                      std::uint64_t &sum);
    bool is_end(const unsigned char *begin);

    std::string name;
    cm_image_stream stream;
    std::uint64_t count = 0;
    bool ended = false;
    std::array<OwnPicture, 3> pictures;
    cm_view view = {};
};

cm_view_reader::cm_view_reader(const char *stream_name, const cm_image_stream &from)
    : name(stream_name), stream(from)
{
    std::array<unsigned char, stream_head_bytes> head;
    if (take_all(stream, head.data(), head.size()) != head.size() ||
        std::memcmp(head.data(), "CMVIEWS", 7) != 0)
    {
        fail_file(name, "is no stream of views");
    }
    if (head[7] != '1')
    {
        fail_file(name, "is a stream of views of another version", CM_ERROR_VERSION);
    }
    const std::size_t length = cm_file_u32(head.data() + 8);
    std::string text(length <= camera_text_most ? length : 0, '\0');
    if (text.empty() || cm_file_u32(head.data() + 12) != 0 ||
        take_all(stream, reinterpret_cast<unsigned char *>(text.data()), length) != length ||
        cm_check_sum(CM_CHECK_SUM_BEGIN, text.data(), length) != cm_file_u64(head.data() + 16))
    {
        fail_file(name, "its camera is damaged, or cut");
    }
    char message[CM_IMAGE_MESSAGE] = "";
    cm_camera *made = nullptr;
    const cm_status status = cm_camera_file_parse((name + ": camera").c_str(), text.data(), length,
                                                  &made, &depth_scale, message);
    if (status != CM_OK)
    {
        throw FileFailure(status, message);
    }
    camera.reset(made);
}

bool cm_view_reader::is_end(const unsigned char *begin)
{
    if (std::memcmp(begin, "DONE", 4) != 0)
    {
        return false;
    }
    std::array<unsigned char, view_end_bytes> end;
    std::memcpy(end.data(), begin, 8);
    if (take_all(stream, end.data() + 8, view_end_bytes - 8) != view_end_bytes - 8 ||
        cm_file_u32(begin + 4) != view_end_bytes || !sum_is(end.data(), view_end_bytes - 8) ||
        cm_file_u64(end.data() + 8) != count)
    {
        fail("the end of the stream is damaged");
    }
    return true;
}

void cm_view_reader::read_head(const unsigned char *head)
{
    view = {};
    view.size = sizeof view;
    view.camera = camera.get();
    view.time = f64_at(head + 8);
    for (int i = 0; i < 9; ++i)
    {
        view.pose.rotation.row[i / 3][i % 3] = f64_at(head + 16 + 8 * i);
    }
    for (int i = 0; i < 3; ++i)
    {
        view.pose.position[i] = f64_at(head + 88 + 8 * i);
    }
    view.depth_unit = f64_at(head + 112);
    view.depth_is_range = cm_file_u32(head + 120) != 0;
}

void cm_view_reader::read_picture(OwnPicture &picture, const unsigned char *head,
                                  std::uint64_t &left, std::uint64_t &sum)
{
    const std::uint32_t type = cm_file_u32(head);
    const std::uint32_t channels = cm_file_u32(head + 4);
    const cm_camera_options &options = *cm_camera_describe(camera.get());
    picture.clear();
    if (channels == 0)
    {
        return;
    }
    if (type > CM_PIXEL_FLOAT || channels > CM_CHANNELS_MAX)
    {
        fail("channels or a type that no picture has");
    }
    const std::size_t sample = cm_pixel_size(static_cast<cm_pixel_type>(type));
    const std::uint64_t bytes = std::uint64_t{options.width} * options.height * channels * sample;
    if (bytes > left)
    {
        fail("its pictures have not as many bytes as it says");
    }
    left -= bytes;
    std::size_t done = 0;
    while (done < bytes)
    {
        const std::size_t some =
            static_cast<std::size_t>(std::min<std::uint64_t>(part_bytes, bytes - done));
        if (picture.bytes.size() < done + some)
        {
            picture.bytes.resize(done + some);
        }
        if (take_all(stream, picture.bytes.data() + done, some) != some)
        {
            fail("the stream ends within its pictures");
        }
        sum = cm_check_sum(sum, picture.bytes.data() + done, some);
        done += some;
    }
    picture.shape(options.width, options.height, channels, static_cast<cm_pixel_type>(type));
    cm_file_order(picture.bytes.data(), bytes / sample, sample, true);
}

const cm_view *cm_view_reader::next()
{
    if (ended)
    {
        throw FileFailure(CM_ERROR_RANGE, name + ": has no more views");
    }
    ended = true; // unless all of this view is good
    std::array<unsigned char, view_head_bytes> head;
    if (take_all(stream, head.data(), 8) != 8)
    {
        fail("the stream ends without its end: it was cut");
    }
    if (is_end(head.data()))
    {
        // streams that a shell has put together would lose all but the first without a word
        unsigned char more = 0;
        if (take_all(stream, &more, 1) != 0)
        {
            fail_file(name, "bytes follow the end of the stream, after " + std::to_string(count) +
                                " views; one stream is read");
        }
        throw FileFailure(CM_ERROR_RANGE, name + ": has no more views");
    }
    if (std::memcmp(head.data(), "VIEW", 4) != 0 || cm_file_u32(head.data() + 4) != head.size() ||
        take_all(stream, head.data() + 8, head.size() - 8) != head.size() - 8 ||
        !sum_is(head.data(), head.size() - 8))
    {
        fail("its head is damaged, or cut");
    }
    const cm_camera_options &options = *cm_camera_describe(camera.get());
    if (cm_file_u32(head.data() + 128) != options.width ||
        cm_file_u32(head.data() + 132) != options.height)
    {
        fail("is not of the camera's size");
    }
    if (cm_file_u32(head.data() + 120) > 1 || cm_file_u32(head.data() + 124) != 0 ||
        cm_file_u64(head.data() + 176) != 0)
    {
        fail("has words in its head that this version does not know");
    }
    const double before = view.time;
    read_head(head.data());
    if (count > 0 && view.time <= before)
    {
        fail("its time is not after the one before");
    }
    std::uint64_t left = cm_file_u64(head.data() + 160);
    std::uint64_t sum = CM_CHECK_SUM_BEGIN;
    for (std::size_t i = 0; i < 3; ++i)
    {
        read_picture(pictures[i], head.data() + 136 + 8 * i, left, sum);
    }
    if (left != 0 || sum != cm_file_u64(head.data() + 168))
    {
        fail("its pictures are damaged");
    }
    view.depth = pictures[0].image;
    view.color = pictures[1].image;
    view.amplitude = pictures[2].image;
    const std::string fault = view_fault(view, camera.get());
    if (!fault.empty())
    {
        fail(fault);
    }
    ended = false;
    ++count;
    return &view;
}

struct cm_view_writer
{
    cm_view_writer(const char *stream_name, const cm_image_stream &to, const cm_camera *of,
                   double depth_scale);
    void put(const cm_view &view);
    void finish();

private:
    void write(const void *bytes, std::size_t size)
    {
        if (stream.write(stream.context, bytes, size) != size)
        {
            fail_file(name, "cannot be written", CM_ERROR_FILE);
        }
    }

    std::string name;
    cm_image_stream stream;
    CameraPointer camera;
    std::uint64_t count = 0;
};

cm_view_writer::cm_view_writer(const char *stream_name, const cm_image_stream &to,
                               const cm_camera *of, double depth_scale)
    : name(stream_name), stream(to)
{
    char message[CM_IMAGE_MESSAGE] = "";
    char *text = nullptr;
    const cm_status status = cm_camera_file_format(of, depth_scale, &text, message);
    if (status != CM_OK)
    {
        throw FileFailure(status, name + ": " + message);
    }
    const std::unique_ptr<char, decltype(&std::free)> owner(text, std::free);
    cm_camera *copy = nullptr;
    if (cm_camera_create(cm_camera_describe(of), &copy) != CM_OK)
    {
        throw std::bad_alloc();
    }
    camera.reset(copy);
    const std::size_t length = std::strlen(text);
    std::array<unsigned char, stream_head_bytes> head = {'C', 'M', 'V', 'I', 'E', 'W', 'S', '1'};
    cm_file_put_u32(head.data() + 8, static_cast<std::uint32_t>(length));
    cm_file_put_u64(head.data() + 16, cm_check_sum(CM_CHECK_SUM_BEGIN, text, length));
    write(head.data(), head.size());
    write(text, length);
}

void cm_view_writer::put(const cm_view &view)
{
    const std::string fault = view_fault(view, camera.get());
    if (!fault.empty())
    {
        fail_file(name, "view " + std::to_string(count) + ": " + fault, CM_ERROR_CAMERA);
    }
    std::array<unsigned char, view_head_bytes> head = {'V', 'I', 'E', 'W', view_head_bytes};
    put_f64(head.data() + 8, view.time);
    for (int i = 0; i < 9; ++i)
    {
        put_f64(head.data() + 16 + 8 * i, view.pose.rotation.row[i / 3][i % 3]);
    }
    for (int i = 0; i < 3; ++i)
    {
        put_f64(head.data() + 88 + 8 * i, view.pose.position[i]);
    }
    put_f64(head.data() + 112, view.depth_unit);
    cm_file_put_u32(head.data() + 120, view.depth_is_range != 0);
    cm_file_put_u32(head.data() + 128, view.depth.width);
    cm_file_put_u32(head.data() + 132, view.depth.height);
    std::vector<unsigned char> bytes;
    const std::array<const cm_image *, 3> images = {&view.depth, &view.color, &view.amplitude};
    for (std::size_t i = 0; i < 3; ++i)
    {
        const cm_image &image = *images[i];
        if (image.data == nullptr)
        {
            continue;
        }
        const std::size_t size = cm_pixel_size(image.type) * image.channels;
        cm_file_put_u32(head.data() + 136 + 8 * i, image.type);
        cm_file_put_u32(head.data() + 140 + 8 * i, image.channels);
        for (std::uint32_t y = 0; y < image.height; ++y)
        {
            const unsigned char *at = row_of(image, y);
            for (std::uint32_t x = 0; x < image.width; ++x)
            {
                bytes.insert(bytes.end(), at, at + size);
                at += pixel_step(image);
            }
        }
        const std::size_t own = std::size_t{image.width} * image.height * size;
        const std::size_t sample = cm_pixel_size(image.type);
        cm_file_order(bytes.data() + bytes.size() - own, own / sample, sample, true);
    }
    cm_file_put_u64(head.data() + 160, bytes.size());
    cm_file_put_u64(head.data() + 168,
                    cm_check_sum(CM_CHECK_SUM_BEGIN, bytes.data(), bytes.size()));
    put_sum(head.data(), view_head_bytes - 8);
    write(head.data(), head.size());
    write(bytes.data(), bytes.size());
    ++count;
}

void cm_view_writer::finish()
{
    std::array<unsigned char, view_end_bytes> end = {'D', 'O', 'N', 'E', view_end_bytes};
    cm_file_put_u64(end.data() + 8, count);
    put_sum(end.data(), view_end_bytes - 8);
    write(end.data(), end.size());
}

cm_status cm_view_reader_create(const char *name, const cm_image_stream *stream,
                                cm_view_reader **reader, char *message)
{
    if (name == nullptr || stream == nullptr || reader == nullptr || stream->read == nullptr)
    {
        return CM_ERROR_ARGUMENT;
    }
    return guarded_file(message, [&] { *reader = new cm_view_reader(name, *stream); });
}

void cm_view_reader_destroy(cm_view_reader *reader)
{
    delete reader;
}

const cm_camera *cm_view_reader_camera(const cm_view_reader *reader, double *depth_scale)
{
    *depth_scale = reader->depth_scale;
    return reader->camera.get();
}

cm_status cm_view_reader_next(cm_view_reader *reader, const cm_view **view, char *message)
{
    if (reader == nullptr || view == nullptr)
    {
        return CM_ERROR_ARGUMENT;
    }
    return guarded_file(message, [&] { *view = reader->next(); });
}

cm_status cm_view_writer_create(const char *name, const cm_image_stream *stream,
                                const cm_camera *camera, double depth_scale,
                                cm_view_writer **writer, char *message)
{
    if (name == nullptr || stream == nullptr || writer == nullptr || camera == nullptr ||
        stream->write == nullptr)
    {
        return CM_ERROR_ARGUMENT;
    }
    return guarded_file(message,
                        [&] { *writer = new cm_view_writer(name, *stream, camera, depth_scale); });
}

cm_status cm_view_writer_put(cm_view_writer *writer, const cm_view *view, char *message)
{
    if (writer == nullptr || view == nullptr)
    {
        return CM_ERROR_ARGUMENT;
    }
    return guarded_file(message, [&] { writer->put(*view); });
}

cm_status cm_view_writer_finish(cm_view_writer *writer, char *message)
{
    if (writer == nullptr)
    {
        return CM_ERROR_ARGUMENT;
    }
    return guarded_file(message, [&] { writer->finish(); });
}

void cm_view_writer_destroy(cm_view_writer *writer)
{
    delete writer;
}
