// SPDX-License-Identifier: MIT

#include "color_rows.hpp"

#include <cubemap/srgb.h>

namespace
{

float recoded(float value, Recode recode)
{
    return recode == Recode::encode   ? cm_srgb_from_light_float(value)
           : recode == Recode::decode ? cm_light_from_srgb_float(value)
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
