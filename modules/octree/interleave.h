/* SPDX-License-Identifier: MIT
 *
 * Morton's order: bits of x, y and z in turn, x lowest.
 */
#ifndef MODULES_OCTREE_INTERLEAVE_H
#define MODULES_OCTREE_INTERLEAVE_H

#include <stdint.h>

/* The lowest three bits of x, y and z as a number of nine. */
static inline unsigned cm_interleave_3(unsigned x, unsigned y, unsigned z)
{
#define SPREAD(a) (((a)&1u) | ((a)&2u) << 2 | ((a)&4u) << 4)
    return SPREAD(x) | SPREAD(y) << 1 | SPREAD(z) << 2;
#undef SPREAD
}

/* And back. */
static inline void cm_divide_3(unsigned key, unsigned place[3])
{
    for (unsigned axis = 0; axis < 3; axis++)
    {
        const unsigned k = key >> axis;
        place[axis] = (k & 1u) | (k >> 2 & 2u) | (k >> 4 & 4u);
    }
}

/* 21 bits, each two places from the next. */
static inline uint64_t cm_spread(uint64_t bits)
{
    bits &= 0x1fffffu;
    bits = (bits | bits << 32) & 0x001f00000000ffffu;
    bits = (bits | bits << 16) & 0x001f0000ff0000ffu;
    bits = (bits | bits << 8) & 0x100f00f00f00f00fu;
    bits = (bits | bits << 4) & 0x10c30c30c30c30c3u;
    return (bits | bits << 2) & 0x1249249249249249u;
}

/* 21 bits each as a number of 63. */
static inline uint64_t cm_interleave(const uint32_t place[3])
{
    return cm_spread(place[0]) | cm_spread(place[1]) << 1 | cm_spread(place[2]) << 2;
}

/* And back. */
static inline void cm_divide(uint64_t key, uint32_t place[3])
{
    place[0] = place[1] = place[2] = 0;
    for (unsigned bit = 0; bit < 21; bit++)
    {
        for (unsigned axis = 0; axis < 3; axis++)
        {
            place[axis] |= (uint32_t)(key >> (3 * bit + axis) & 1u) << bit;
        }
    }
}

#endif
