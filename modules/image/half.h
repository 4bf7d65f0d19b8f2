/* SPDX-License-Identifier: MIT
 *
 * Half precision, IEC 60559 binary16: a sign, 5 bits of exponent with the bias 15, 10 of fraction. Without branches, so that
 * loops over it become vectors, and without floats below 2^-126, which some programs have the processor take for 0.
 */
#ifndef MODULES_IMAGE_HALF_H
#define MODULES_IMAGE_HALF_H

#include <stdint.h>
#include <string.h>

#ifdef __GNUC__
#define CM_HALF_INLINE static inline __attribute__((always_inline))
#else
#define CM_HALF_INLINE static inline
#endif

CM_HALF_INLINE uint32_t cm_bits_of_float(float x)
{
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

CM_HALF_INLINE float cm_float_of_bits(uint32_t bits)
{
    float x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* Exact: all halves are floats, and NaN keeps its bits. The bits of a half below 2^-14 are a fraction behind 1; what
 * is subtracted is that 1. */
CM_HALF_INLINE float cm_float_of_half(uint16_t half)
{
    const uint32_t sign = (half & 0x8000u) << 16;
    const uint32_t size = (half & 0x7fffu) << 13;
    const float small = cm_float_of_bits(size + (113u << 23)) - 0x1p-14f;
    const uint32_t normal = size + ((size < 0x7c00u << 13 ? 112u : 224u) << 23);
    return cm_float_of_bits(sign | (size < 0x0400u << 13 ? cm_bits_of_float(small) : normal));
}

/* To the nearest, ties to even; from 65520 on infinite; NaN is 0x7e00 or 0xfe00. Normal numbers: add what rounds to even
 * at bit 13, then move the exponent. Below 2^-14: adding 1/2 leaves multiples of 2^-24 in the last bits of the sum,
 * rounded by the addition. */
CM_HALF_INLINE uint16_t cm_half_of_float(float value)
{
    const uint32_t bits = cm_bits_of_float(value);
    const uint32_t size = bits & 0x7fffffffu;
    const uint32_t even = (size >> 13) & 1u;
    const uint32_t normal = (size + 0xfffu + even - (112u << 23)) >> 13;
    const float below = cm_float_of_bits(size < 113u << 23 ? size : 0u);
    const uint32_t small = cm_bits_of_float(below + 0.5f) - (126u << 23);
    const uint32_t finite = size < 113u << 23 ? small : normal;
    const uint32_t infinite = size > 255u << 23 ? 0x7e00u : 0x7c00u;
    return (uint16_t)((bits >> 16 & 0x8000u) | (size >= 143u << 23 ? infinite : finite));
}

#endif
