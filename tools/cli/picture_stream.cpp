// SPDX-License-Identifier: MIT

#include "picture_stream.hpp"
#include "program.hpp"

#include "modules/image/io/header_tags.hpp"

#include <cerrno>
#include <cstring>
#include <memory>
#include <new>
#include <utility>
#include <vector>

#include <unistd.h>

namespace
{

constexpr const char *stream_name = "standard input";

constexpr const char *color_names[] = {"R", "G", "B", "A"};
constexpr const char *gray_names[] = {"Y", "A"};

// What stands behind the words of image_io.h: one picture.
struct StreamPicture
{
    cm_pnm_reader *reader = nullptr;
    bool planes = false;
    cm_image_description description = {};
    std::vector<std::string> names;
    std::vector<const char *> name_pointers;
    HeaderTags own_tags;
    std::vector<cm_image_tag> tags;
    std::uint32_t next_row = 0;
    std::vector<unsigned char> whole; // of what does not come from the top, row by row

    std::size_t row_size() const
    {
        return std::size_t{description.width} * description.channels *
               cm_pixel_size(description.type);
    }
};

StreamPicture &picture_of(cm_image_reader *reader)
{
    return *reinterpret_cast<StreamPicture *>(reader);
}

const cm_image_description *describe(const cm_image_reader *reader)
{
    return &reinterpret_cast<const StreamPicture *>(reader)->description;
}

void close(cm_image_reader *reader)
{
    delete reinterpret_cast<StreamPicture *>(reader);
}

cm_status read_planes(StreamPicture &picture, char *message)
{
    const std::size_t width = picture.description.width;
    const std::size_t channels = picture.description.channels;
    const std::size_t sample = cm_pixel_size(picture.description.type);
    std::vector<unsigned char> row(width * sample);
    for (std::size_t plane = 0; plane < channels; ++plane)
    {
        unsigned char *to = picture.whole.data() + plane_channels[plane] * sample;
        for (std::uint32_t i = 0; i < picture.description.height; ++i)
        {
            const cm_status status = cm_pnm_read(picture.reader, 1, row.data(), 0, message);
            if (status != CM_OK)
            {
                return status;
            }
            for (std::size_t k = 0; k < width; ++k, to += channels * sample)
            {
                std::memcpy(to, &row[k * sample], sample);
            }
        }
    }
    return CM_OK;
}

cm_status read_whole(StreamPicture &picture, char *message)
{
    const std::size_t row = picture.row_size();
    const std::uint32_t height = picture.description.height;
    picture.whole.resize(row * height);
    return picture.planes
               ? read_planes(picture, message)
               : cm_pnm_read(picture.reader, height, picture.whole.data() + row * (height - 1),
                             -static_cast<std::ptrdiff_t>(row), message);
}

// Whole rows from the top downwards, as they are.
cm_status read(StreamPicture &picture, const cm_image_region &region, cm_pixel_type type,
               unsigned char *pixels, std::ptrdiff_t row_stride, char *message)
{
    const cm_image_description &is = picture.description;
    const bool in_order = picture.reader->picture.bottom_up == 0 && !picture.planes;
    if (type != is.type || region.x0 != 0 || region.x1 != is.width || region.y1 > is.height ||
        region.y0 > region.y1 || (in_order && region.y0 != picture.next_row))
    {
        std::snprintf(message, CM_IMAGE_MESSAGE, "cannot be read in another order than it comes");
        return CM_ERROR_ARGUMENT;
    }
    const std::ptrdiff_t row = static_cast<std::ptrdiff_t>(picture.row_size());
    const std::ptrdiff_t down = row_stride != 0 ? row_stride : row;
    picture.next_row = region.y1;
    if (in_order)
    {
        return cm_pnm_read(picture.reader, region.y1 - region.y0, pixels, down, message);
    }
    if (picture.whole.empty())
    {
        const cm_status status = read_whole(picture, message);
        if (status != CM_OK)
        {
            return status;
        }
    }
    for (std::uint32_t i = region.y0; i < region.y1; ++i, pixels += down)
    {
        std::memcpy(pixels, picture.whole.data() + static_cast<std::size_t>(row) * i,
                    static_cast<std::size_t>(row));
    }
    return CM_OK;
}

cm_status read_guarded(cm_image_reader *reader, const cm_image_region *region, cm_pixel_type type,
                       void *pixels, std::ptrdiff_t row_stride, char *message)
{
    try
    {
        return read(picture_of(reader), *region, type, static_cast<unsigned char *>(pixels),
                    row_stride, message);
    }
    catch (const std::bad_alloc &)
    {
        return CM_ERROR_MEMORY;
    }
}

const cm_image_io &stream_reading()
{
    static const cm_image_io table = []
    {
        cm_image_io made = {};
        made.version = CM_IMAGE_IO_VERSION;
        made.size = sizeof made;
        made.describe = describe;
        made.read = read_guarded;
        made.close = close;
        return made;
    }();
    return table;
}

std::string channel_name(std::uint32_t channel, std::uint32_t channels)
{
    if (channels > 4)
    {
        return std::to_string(channel + 1);
    }
    return channels > 2 ? color_names[channel] : gray_names[channel];
}

void describe_picture(const cm_pnm_picture &found, bool alpha, StreamPicture &picture)
{
    static constexpr const char *types[] = {"uint8", "uint16", "half", "float"};
    cm_image_description &is = picture.description;
    is.format = found.kind == CM_PNM_RAW ? "raw" : "pnm";
    is.width = is.window_width = found.width;
    is.height = is.window_height = found.height;
    is.channels = found.channels;
    is.type = found.type;
    is.stored_type = types[found.type];
    is.whole_numbers = found.type != CM_PIXEL_FLOAT;
    is.alpha = alpha ? static_cast<std::int32_t>(found.channels) - 1 : -1;
    // PFM has light; what bare floats mean nobody says
    is.color = found.kind == CM_PNM_PFM ? CM_IMAGE_COLOR_LINEAR : CM_IMAGE_COLOR_UNKNOWN;
    is.orientation = 1;
    is.subimage_count = 1;
    for (std::uint32_t i = 0; i < found.channels; ++i)
    {
        picture.names.push_back(channel_name(i, found.channels));
    }
    for (const std::string &name : picture.names)
    {
        picture.name_pointers.push_back(name.c_str());
    }
    is.channel_names = picture.name_pointers.data();
}

// Those that files have in comments.
void describe_tags(const cm_pnm_reader &reader, StreamPicture &picture)
{
    picture.own_tags = header_tags(reader.header, reader.header + reader.header_size);
    for (const auto &[key, text] : picture.own_tags)
    {
        picture.tags.push_back({key.c_str(), text.c_str(), nullptr, nullptr, 0});
    }
    picture.description.tags = picture.tags.data();
    picture.description.tag_count = picture.tags.size();
}

std::size_t take(void *context, void *bytes, std::size_t count)
{
    return std::fread(bytes, 1, count, static_cast<std::FILE *>(context));
}

} // namespace

std::optional<BarePictures> read_bare_pictures(const std::string &text)
{
    const std::size_t times = text.find('x');
    const std::size_t colon = text.find(':');
    if (times == std::string::npos || colon == std::string::npos || times > colon)
    {
        return std::nullopt;
    }
    const auto edge = [](const std::string &digits)
    {
        const bool good = !digits.empty() && digits.size() <= 7 &&
                          digits.find_first_not_of("0123456789") == std::string::npos;
        const int pixels = good ? std::stoi(digits) : 0;
        return pixels <= CM_PNM_SIZE_MOST ? pixels : 0;
    };
    BarePictures bare;
    bare.width = edge(text.substr(0, times));
    bare.height = edge(text.substr(times + 1, colon - times - 1));
    bare.format = find_stream_format(text.substr(colon + 1));
    const bool good = bare.width > 0 && bare.height > 0 && bare.format != nullptr &&
                      bare.format->kind == CM_PNM_RAW &&
                      bare.height <= CM_PNM_SIZE_MOST / bare.format->channels;
    return good ? std::optional<BarePictures>(bare) : std::nullopt;
}

PictureStream::PictureStream(std::FILE *from, const std::optional<BarePictures> &bare)
    : file(from), stream{from, take, nullptr, nullptr, nullptr}, samples(bare)
{
    if (fileno(file) >= 0 && isatty(fileno(file)) != 0)
    {
        throw UsageFailure(std::string("INPUT is ") + stream_name +
                           ", and that is a terminal; let a program write pictures into it, or "
                           "give the name of a file");
    }
    reader.size = sizeof reader;
    reader.stream = &stream;
}

std::optional<ImageFile> PictureStream::next()
{
    auto picture = std::make_unique<StreamPicture>();
    picture->reader = &reader;
    cm_pnm_picture found = {};
    found.size = sizeof found;
    if (samples)
    {
        picture->planes = samples->format->planes;
        const int planes = picture->planes ? samples->format->channels : 1;
        found.kind = CM_PNM_RAW;
        found.width = static_cast<std::uint32_t>(samples->width);
        found.height = static_cast<std::uint32_t>(samples->height * planes);
        found.channels = static_cast<std::uint32_t>(samples->format->channels / planes);
        found.type = samples->format->type;
        found.little_endian = 1;
    }
    bool more = false;
    char message[CM_IMAGE_MESSAGE] = "";
    const cm_status status = cm_pnm_next(&reader, &found, &more, message);
    if (std::ferror(file) != 0)
    {
        throw Failure(std::string(stream_name) + " cannot be read: " + std::strerror(errno));
    }
    if (status != CM_OK)
    {
        fail_image(stream_name, status, message);
    }
    if (!more)
    {
        return std::nullopt;
    }
    if (samples)
    {
        found.height = static_cast<std::uint32_t>(samples->height);
        found.channels = static_cast<std::uint32_t>(samples->format->channels);
    }
    describe_picture(found, samples ? samples->format->alpha : found.alpha != 0, *picture);
    describe_tags(reader, *picture);
    return ImageFile(stream_name, stream_reading(),
                     reinterpret_cast<cm_image_reader *>(picture.release()),
                     ImageFile::Origin::stream);
}
