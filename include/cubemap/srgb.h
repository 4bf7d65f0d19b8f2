/* SPDX-License-Identifier: MIT
 *
 * The transfer function of sRGB, IEC 61966-2-1, 5.2: numbers as stored, from linear light and back.
 *
 * 0 is 0 and 1 is 1, but for rounding; beyond 1 the curve goes on, and negative numbers are mirrored. Its branches part
 * where they meet, at 0.00313066844 of light, so that it is continuous: rounded, as in the standard, the two places are
 * 0.0031308 and 0.04045, between which no number of 8 or 16 bits lies. NaN and infinities stay what they are. Inline, in
 * double precision and in single: nothing has to be linked but the C library's mathematics.
 */
#ifndef CUBEMAP_SRGB_H
#define CUBEMAP_SRGB_H

#include <math.h>

/* The light at which the branches meet: 12.92 c = 1.055 c^(1 / 2.4) - 0.055. */
#define CM_SRGB_JOINT 0.00313066844250063403

/* As stored, of linear light. */
static inline double cm_srgb_from_light(double light)
{
    const double size = fabs(light);
    return copysign(size <= CM_SRGB_JOINT ? 12.92 * size : 1.055 * pow(size, 1.0 / 2.4) - 0.055,
                    light);
}

/* Linear light, of what is stored. */
static inline double cm_light_from_srgb(double srgb)
{
    const double size = fabs(srgb);
    return copysign(size <= 12.92 * CM_SRGB_JOINT ? size / 12.92 : pow((size + 0.055) / 1.055, 2.4),
                    srgb);
}

/* The same in single precision. */
static inline float cm_srgb_from_light_float(float light)
{
    const float size = fabsf(light);
    return copysignf(size <= (float)CM_SRGB_JOINT ? 12.92f * size
                                                  : 1.055f * powf(size, 1.0f / 2.4f) - 0.055f,
                     light);
}

static inline float cm_light_from_srgb_float(float srgb)
{
    const float size = fabsf(srgb);
    return copysignf(size <= (float)(12.92 * CM_SRGB_JOINT) ? size / 12.92f
                                                            : powf((size + 0.055f) / 1.055f, 2.4f),
                     srgb);
}

#endif
