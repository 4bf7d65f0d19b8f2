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

/* 20 bits each as a number of 60. */
static inline uint64_t cm_interleave(const uint32_t place[3])
{
    uint64_t key = 0;
    for (unsigned bit = 0; bit < 21; bit++)
    {
        for (unsigned axis = 0; axis < 3; axis++)
        {
            key |= (uint64_t)(place[axis] >> bit & 1u) << (3 * bit + axis);
        }
    }
    return key;
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
