/* SPDX-License-Identifier: MIT
 *
 * Colors in a word: 11, 11 and 10 bits of red, green and blue, so that an average follows small changes. No word of a color is
 * 0, which is that of none.
 */
#ifndef MODULES_OCTREE_COLOR_WORD_H
#define MODULES_OCTREE_COLOR_WORD_H

#include <stdint.h>

static inline uint32_t cm_color_word(const uint8_t *rgb)
{
    return (8u * rgb[0] + 1u) << 21 | (8u * rgb[1] + 1u) << 10 | 4u * rgb[2];
}

/* 65536 / weight, to the nearest, of weights from 1 to 255. */
extern const uint32_t cm_color_part[256];

static inline uint32_t cm_color_between(uint32_t old, uint32_t more, uint32_t part)
{
    const int32_t difference = (int32_t)more - (int32_t)old;
    return (uint32_t)((int32_t)(old << 16) + difference * (int32_t)part + 32768) >> 16;
}

/* A color that is averaged with one more, of which so many 65536ths are taken. */
static inline uint32_t cm_color_blend(uint32_t color, uint32_t more, uint32_t part)
{
    const uint32_t red = cm_color_between(color >> 21, more >> 21, part);
    const uint32_t green = cm_color_between(color >> 10 & 2047u, more >> 10 & 2047u, part);
    const uint32_t blue = cm_color_between(color & 1023u, more & 1023u, part);
    return red << 21 | green << 10 | blue;
}

/* A color that is averaged with one more, the weight-th; none is none before it. */
static inline uint32_t cm_color_mix(uint32_t color, uint32_t more, unsigned weight)
{
    return color == 0 || weight <= 1 ? more : cm_color_blend(color, more, cm_color_part[weight]);
}

void cm_color_to(uint32_t color, uint8_t rgb[3]);

#endif
