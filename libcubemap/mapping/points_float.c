/* SPDX-License-Identifier: MIT */
#include <cubemap/cubemap.h>
#include <cubemap/kernels.h>

#include "libcubemap/batch/mapping_object.h"
#include "parts.h"

#define CM_BACKEND 2
#define CM_PUBLIC(name) name##_f32
#include "parts.inc"
#include "points.inc"

/* The bits of a magnitude, which are in its order: to compare NaN would raise an exception. */
static uint32_t magnitude_of(float x)
{
    uint32_t word;
    memcpy(&word, &x, sizeof word);
    return word & 0x7fffffffu;
}

/* Does conformal's inverse raise nothing but inexact there? Its powers underflow where both coordinates are within 2^-8 of an
 * edge, as the squares of what is left of differences of fourth powers of the distance to a corner, and where both are below
 * 2^-7, beside diagonals, as the square of what the series adds to them. */
static int is_calm(const float uv[2])
{
    const uint32_t u = magnitude_of(uv[0]);
    const uint32_t v = magnitude_of(uv[1]);
    const uint32_t less = u < v ? u : v;
    const uint32_t more = u < v ? v : u;
    return less < 0x3f7f0000u && more >= 0x3c000000u;
}

/* As held, of conformal: elsewhere nothing waits for the flags. */
static void inverse_held_beside(const cm_mapping *mapping, uint8_t face, const float uv[2],
                                float direction[3])
{
    if (is_calm(uv))
    {
        lone_of_set_f32(mapping)->inverse(mapping, face, uv, direction);
    }
    else
    {
        inverse_held_f32(mapping, face, uv, direction);
    }
}

const cm_lone_f32 cm_lone_held_beside_f32 = {forward_held_f32, inverse_held_beside};
