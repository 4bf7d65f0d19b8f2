// SPDX-License-Identifier: MIT
//
// The curve is that of IEC 61966-2-1; below zero and above one it goes on, odd about zero.

#include "color_rows.hpp"

#include <cmath>

namespace
{

float encoded(float light)
{
    const float size = std::fabs(light);
    const float value =
        size <= 0.0031308f ? 12.92f * size : 1.055f * std::pow(size, 1.0f / 2.4f) - 0.055f;
    return std::copysign(value, light);
}

float decoded(float stored)
{
    const float size = std::fabs(stored);
    const float value = size <= 0.04045f ? size / 12.92f : std::pow((size + 0.055f) / 1.055f, 2.4f);
    return std::copysign(value, stored);
}

float recoded(float value, Recode recode)
{
    return recode == Recode::encode   ? encoded(value)
           : recode == Recode::decode ? decoded(value)
                                      : value;
}

} // namespace

void ColorRows::convert(float *pixels, std::size_t count) const
{
    for (std::size_t i = 0; i < count; ++i, pixels += channels)
    {
        const float opacity = alpha >= 0 ? pixels[alpha] : 1.0f;
        const float divide = multiplied && opacity > 0 ? 1 / opacity : 1.0f;
        const float factor = multiply ? opacity : 1.0f;
        int colors = 0;
        for (int c = 0; c < channels; ++c)
        {
            if (c == alpha)
            {
                continue;
            }
            const bool is_color = colors++ < 3;
            const float value = pixels[c] * divide;
            pixels[c] = (is_color ? recoded(value, recode) : value) * factor;
        }
    }
}
