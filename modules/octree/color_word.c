/* SPDX-License-Identifier: MIT
 *
 * Colors in a word. No word of a color is 0, which is that of none.
 */
#include "region.h"

static uint32_t word_of(uint32_t red, uint32_t green, uint32_t blue)
{
    return red << 21 | green << 10 | blue;
}

uint32_t cm_color_from(const uint8_t rgb[3])
{
    return word_of(8u * rgb[0] + 1u, 8u * rgb[1] + 1u, 4u * rgb[2]);
}

void cm_color_to(uint32_t color, uint8_t rgb[3])
{
    rgb[0] = rgb[1] = rgb[2] = 0;
    if (color != 0)
    {
        const uint32_t red = (color >> 21) - 1u;
        const uint32_t green = (color >> 10 & 2047u) - 1u;
        const uint32_t blue = color & 1023u;
        rgb[0] = (uint8_t)((red + 4u) / 8u < 255u ? (red + 4u) / 8u : 255u);
        rgb[1] = (uint8_t)((green + 4u) / 8u < 255u ? (green + 4u) / 8u : 255u);
        rgb[2] = (uint8_t)((blue + 2u) / 4u < 255u ? (blue + 2u) / 4u : 255u);
    }
}

/* 65536 / weight, to the nearest; there are no more than 255 hits. */
static uint32_t part_of(unsigned weight)
{
    return (65536u + weight / 2u) / weight;
}

static uint32_t mixed(uint32_t old, uint32_t more, uint32_t part)
{
    const int32_t difference = (int32_t)more - (int32_t)old;
    const int32_t sum = (int32_t)(old << 16) + difference * (int32_t)part + 32768;
    return (uint32_t)sum >> 16;
}

uint32_t cm_color_mix(uint32_t color, const uint8_t rgb[3], unsigned weight)
{
    const uint32_t more = cm_color_from(rgb);
    if (color == 0 || weight <= 1)
    {
        return more;
    }
    const uint32_t part = part_of(weight);
    return word_of(mixed(color >> 21, more >> 21, part),
                   mixed(color >> 10 & 2047u, more >> 10 & 2047u, part),
                   mixed(color & 1023u, more & 1023u, part));
}
