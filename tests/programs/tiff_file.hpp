// SPDX-License-Identifier: MIT
//
// TIFF files, byte by byte, for machines with the lowest byte first.

#ifndef TESTS_TIFF_FILE_HPP
#define TESTS_TIFF_FILE_HPP

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

template <typename Number> std::string bytes_of(Number number)
{
    char bytes[sizeof number];
    std::memcpy(bytes, &number, sizeof number);
    return std::string(bytes, sizeof number);
}

struct TiffTag
{
    std::uint16_t number;
    std::uint16_t type; // 2: text, 3: short, 4: long, 12: double
    std::uint32_t count;
    std::string values;
};

// Tags of such values.
TiffTag shorts(std::uint16_t number, const std::vector<std::uint16_t> &values);
TiffTag text(std::uint16_t number, const std::string &value);
TiffTag doubles(std::uint16_t number, const std::vector<double> &values);

// GeoKeys: their version, the model (2: geographic), where pixels are (1: areas), and a key of the system of coordinates.
TiffTag geo_keys(std::uint16_t model, std::uint16_t raster, std::uint16_t key, std::uint16_t code);

// One channel of floats, with further tags.
void write_tiff(const std::string &name, std::uint16_t width, std::uint16_t height,
                const std::vector<float> &pixels, const std::vector<TiffTag> &more = {});

#endif
