// SPDX-License-Identifier: MIT

#include "pixel_mean.hpp"

#include <cmath>
#include <cstring>

namespace
{

// The sum of a channel's values, weighted by another's.
struct Mean
{
    double sum = 0;
    double weight = 0;

    void add(double value, double by)
    {
        sum += by > 0 && std::isfinite(value) ? value * by : 0;
        weight += std::isfinite(value) ? by : 0;
    }
};

double value_at(const unsigned char *pixel, cm_pixel_type type, std::size_t channel)
{
    float value = 0;
    if (type == CM_PIXEL_U8)
    {
        return pixel[channel];
    }
    std::memcpy(&value, pixel + channel * sizeof value, sizeof value);
    return static_cast<double>(value);
}

void put_value(double value, cm_pixel_type type, std::size_t channel, unsigned char *pixel)
{
    const float number = static_cast<float>(value);
    if (type == CM_PIXEL_U8)
    {
        pixel[channel] = static_cast<unsigned char>(value + 0.5);
        return;
    }
    std::memcpy(pixel + channel * sizeof number, &number, sizeof number);
}

} // namespace

void put_mean(const cm_image &from, std::uint32_t column, std::uint32_t row, std::uint32_t width,
              int alpha, unsigned char *to)
{
    for (std::size_t channel = 0; channel < from.channels; ++channel)
    {
        Mean mean;
        for (std::uint32_t i = 0; i < width * width; ++i)
        {
            const unsigned char *const pixel =
                static_cast<const unsigned char *>(from.data) +
                static_cast<std::ptrdiff_t>(row + i / width) * from.row_stride +
                static_cast<std::ptrdiff_t>(column + i % width) * from.pixel_stride;
            const bool plain = alpha < 0 || static_cast<std::size_t>(alpha) == channel;
            mean.add(value_at(pixel, from.type, channel),
                     plain ? 1.0 : value_at(pixel, from.type, static_cast<std::size_t>(alpha)));
        }
        const bool nothing = !(mean.weight > 0);
        put_value(nothing ? (from.type == CM_PIXEL_FLOAT && alpha < 0 ? std::nan("") : 0.0)
                          : mean.sum / mean.weight,
                  from.type, channel, to);
    }
}
