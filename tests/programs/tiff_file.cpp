// SPDX-License-Identifier: MIT

#include "tiff_file.hpp"
#include "image_cases.hpp"

#include <algorithm>

TiffTag shorts(std::uint16_t number, const std::vector<std::uint16_t> &values)
{
    std::string bytes;
    for (const std::uint16_t value : values)
    {
        bytes += bytes_of(value);
    }
    return {number, 3, static_cast<std::uint32_t>(values.size()), bytes};
}

TiffTag doubles(std::uint16_t number, const std::vector<double> &values)
{
    std::string bytes;
    for (const double value : values)
    {
        bytes += bytes_of(value);
    }
    return {number, 12, static_cast<std::uint32_t>(values.size()), bytes};
}

TiffTag text(std::uint16_t number, const std::string &value)
{
    return {number, 2, static_cast<std::uint32_t>(value.size() + 1), value + '\0'};
}

void write_tiff(const std::string &name, std::uint16_t width, std::uint16_t height,
                const std::vector<float> &pixels, const std::vector<TiffTag> &more)
{
    const auto size = static_cast<std::uint32_t>(pixels.size() * sizeof(float));
    std::vector<TiffTag> tags = {
        shorts(256, {width}), shorts(257, {height}), shorts(258, {32}),
        shorts(259, {1}),     shorts(262, {1}),      {273, 4, 1, bytes_of(std::uint32_t{8})},
        shorts(277, {1}),     shorts(278, {height}), {279, 4, 1, bytes_of(size)},
        shorts(339, {3})};
    tags.insert(tags.end(), more.begin(), more.end());
    std::sort(tags.begin(), tags.end(),
              [](const TiffTag &one, const TiffTag &other) { return one.number < other.number; });
    const auto head = static_cast<std::uint32_t>(8 + size);
    std::string file = "II" + bytes_of(std::uint16_t{42}) + bytes_of(head);
    for (const float pixel : pixels)
    {
        file += bytes_of(pixel);
    }
    std::string entries = bytes_of(static_cast<std::uint16_t>(tags.size()));
    std::string behind;
    const auto end = static_cast<std::uint32_t>(head + 2 + 12 * tags.size() + 4);
    for (const TiffTag &tag : tags)
    {
        const bool fits = tag.values.size() <= 4;
        const auto place = static_cast<std::uint32_t>(end + behind.size());
        entries += bytes_of(tag.number) + bytes_of(tag.type) + bytes_of(tag.count) +
                   (fits ? tag.values + std::string(4 - tag.values.size(), '\0') : bytes_of(place));
        behind += fits ? "" : tag.values;
    }
    write_file(name, file + entries + bytes_of(std::uint32_t{0}) + behind);
}

TiffTag geo_keys(std::uint16_t model, std::uint16_t raster, std::uint16_t key, std::uint16_t code)
{
    return shorts(34735, {1, 1, 0, 3, 1024, 0, 1, model, 1025, 0, 1, raster, key, 0, 1, code});
}
