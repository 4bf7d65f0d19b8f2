// SPDX-License-Identifier: MIT
//
// PGM and PPM of bytes and words, and PFM, among the image files, row by row where they stand: OpenImageIO holds them whole.

#include "image_reader.hpp"
#include "file_words.h"
#include "header_tags.hpp"
#include "opened_file.hpp"
#include "pnm_file.h"

#include <algorithm>
#include <cstring>
#include <vector>

#include <OpenImageIO/imageio.h>

namespace
{

// Rows are read in bands of about so many bytes where they become another type.
constexpr std::size_t pnm_band_bytes = std::size_t{1} << 20;

class PnmReader final : public cm_image_reader
{
public:
    PnmReader(FilePointer opened, const cm_pnm_picture &found, off_t first_byte, HeaderTags said);
    void read(const cm_image_region &region, cm_pixel_type type, char *pixels,
              std::ptrdiff_t row_stride) override;

private:
    void read_run(std::uint32_t row, std::uint32_t column, std::size_t count, char *to);
    std::size_t pixel() const
    {
        return static_cast<std::size_t>(size_of(description.type)) * description.channels;
    }

    void describe_samples(const cm_pnm_picture &found);

    FilePointer file;
    off_t first;
    bool bottom_up;
    bool little_endian;
    HeaderTags own_tags;
    std::vector<cm_image_tag> tags;
    int is_binary = 1;
    int is_big_endian;
    float bits;
    const char *const color_space = "Rec709";
};

PnmReader::PnmReader(FilePointer opened, const cm_pnm_picture &found, off_t first_byte,
                     HeaderTags said)
    : file(std::move(opened)), first(first_byte), bottom_up(found.bottom_up != 0),
      little_endian(found.little_endian != 0), own_tags(std::move(said)),
      is_big_endian(little_endian ? 0 : 1), bits(found.type == CM_PIXEL_U8 ? 8.0f : 16.0f)
{
    static constexpr const char *const colors[] = {"R", "G", "B"};
    static constexpr const char *const gray[] = {"Y"};
    description.format = "pnm";
    description.width = description.window_width = found.width;
    description.height = description.window_height = found.height;
    description.channels = found.channels;
    description.channel_names = found.channels == 1 ? gray : colors;
    description.type = found.type;
    description.stored_type = type_of(found.type).c_str();
    description.whole_numbers = found.type != CM_PIXEL_FLOAT;
    description.alpha = -1;
    description.alpha_multiplied = true;
    description.color = CM_IMAGE_COLOR_UNKNOWN;
    description.orientation = 1;
    description.subimage_count = 1;
    describe_samples(found);
    tags.push_back({"oiio:ColorSpace", color_space, "string", &color_space, sizeof color_space});
    for (const auto &[key, text] : own_tags)
    {
        tags.push_back({key.c_str(), text.c_str(), nullptr, nullptr, 0});
    }
    description.tags = tags.data();
    description.tag_count = tags.size();
}

// The tags are those that OpenImageIO has.
void PnmReader::describe_samples(const cm_pnm_picture &found)
{
    if (found.type == CM_PIXEL_FLOAT)
    {
        tags.push_back({"pnm:bigendian", little_endian ? "0" : "1", "int", &is_big_endian,
                        sizeof is_big_endian});
        return;
    }
    tags.push_back({"pnm:binary", "1", "int", &is_binary, sizeof is_binary});
    tags.push_back({"oiio:BitsPerSample", found.type == CM_PIXEL_U8 ? "8" : "16", "float", &bits,
                    sizeof bits});
}

// Pixels of the file's type.
void PnmReader::read_run(std::uint32_t row, std::uint32_t column, std::size_t count, char *to)
{
    const std::uint32_t above = bottom_up ? description.height - 1 - row : row;
    const std::uint64_t before = std::uint64_t{above} * description.width + column;
    if (fseeko(file.get(), first + static_cast<off_t>(before * pixel()), SEEK_SET) != 0 ||
        std::fread(to, pixel(), count, file.get()) != count)
    {
        throw ImageFailure("is damaged or ends too early");
    }
    cm_file_order(to, count * description.channels,
                  static_cast<std::size_t>(size_of(description.type)), little_endian);
}

void PnmReader::read(const cm_image_region &region, cm_pixel_type type, char *pixels,
                     std::ptrdiff_t row_stride)
{
    const std::uint32_t columns = region.x1 - region.x0;
    const std::size_t own = pixel() * columns;
    const std::size_t most = std::max<std::size_t>(pnm_band_bytes / own, 1);
    std::vector<char> band(type == description.type ? 0 : own * most);
    for (std::uint32_t row = region.y0; row < region.y1;)
    {
        char *const to = pixels + static_cast<std::ptrdiff_t>(row - region.y0) * row_stride;
        if (type == description.type)
        {
            read_run(row++, region.x0, columns, to);
            continue;
        }
        const auto rows = static_cast<std::uint32_t>(std::min<std::size_t>(most, region.y1 - row));
        for (std::uint32_t i = 0; i < rows; ++i)
        {
            read_run(row + i, region.x0, columns, band.data() + i * own);
        }
        const auto samples = static_cast<int>(description.channels);
        if (!OIIO::convert_image(samples, static_cast<int>(columns), static_cast<int>(rows), 1,
                                 band.data(), type_of(description.type), OIIO::AutoStride,
                                 static_cast<std::ptrdiff_t>(own), OIIO::AutoStride, to,
                                 type_of(type), samples * size_of(type), row_stride,
                                 OIIO::AutoStride))
        {
            throw ImageFailure("cannot be read as pixels of another type");
        }
        row += rows;
    }
}

// The kinds whose numbers stand in the file as they are.
bool is_plain(const cm_pnm_picture &found)
{
    switch (found.kind)
    {
    case CM_PNM_PGM:
    case CM_PNM_PPM:
        return found.maximum == (found.type == CM_PIXEL_U8 ? 255 : 65535);
    case CM_PNM_PFM:
        return found.scale == 1.0f;
    default:
        return false;
    }
}

} // namespace

// What else there is of the format, and what is wrong with a file, is for others.
ReaderPointer open_pnm(const std::string &path, std::uint32_t which)
{
    FilePointer file(std::fopen(path.c_str(), "rb"));
    const int letter = file ? std::fgetc(file.get()) : EOF;
    if (letter != 'P' || which != 0 || fseeko(file.get(), 0, SEEK_SET) != 0)
    {
        return nullptr;
    }
    const cm_image_stream stream = {file.get(), read_file, nullptr, nullptr, nullptr};
    cm_pnm_reader header = {};
    header.size = sizeof header;
    header.stream = &stream;
    cm_pnm_picture found = {};
    found.size = sizeof found;
    bool more = false;
    char message[CM_IMAGE_MESSAGE] = "";
    if (cm_pnm_next(&header, &found, &more, message) != CM_OK || !more || !is_plain(found))
    {
        return nullptr;
    }
    const off_t first = ftello(file.get());
    const auto pixel = static_cast<std::uint64_t>(size_of(found.type)) * found.channels;
    const std::uint64_t bytes = pixel * found.width * found.height;
    if (first < 0 || fseeko(file.get(), 0, SEEK_END) != 0 ||
        static_cast<std::uint64_t>(ftello(file.get())) < static_cast<std::uint64_t>(first) + bytes)
    {
        return nullptr;
    }
    return std::make_unique<PnmReader>(
        std::move(file), found, first,
        header_tags(header.header, header.header + header.header_size));
}
