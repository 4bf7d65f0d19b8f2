/* SPDX-License-Identifier: MIT
 *
 * Levels of a surface, each of half the size of the one above, with what the sphere has beyond their edges.
 */
#ifndef MODULES_IMAGE_PYRAMID_H
#define MODULES_IMAGE_PYRAMID_H

#include "padded.h"

/* Planes of 2^30 pixels have so many. */
#define CM_LEVELS_MAX 31

/* Pixels beyond the edges of planes: of all, and beside those whose columns come again after a period. */
#define CM_PYRAMID_BORDER 16
#define CM_PYRAMID_BESIDE 64

/* Level 0 are the pictures themselves, which must stay. */
typedef struct cm_pyramid
{
    unsigned count;
    cm_level pictures;
    cm_level_reader reader;         /* of the pictures */
    int is_whole;                   /* are the other levels whole numbers? */
    cm_padded level[CM_LEVELS_MAX]; /* from 1 on; each row channel by channel */
} cm_pyramid;

/* The size of the next level: halves, rounded up. */
uint32_t cm_half_size(uint32_t size);

/* The levels of sizes from that to 1 x 1. */
unsigned cm_level_count(uint32_t width, uint32_t height);

/* Count levels of pictures of the surface, whose own have a border as wide as wanted, or what the next level needs; the
 * others lie in `memory` as of cm_padded_create. If is_whole, they are whole numbers of CM_PADDED_ONE, which is for bytes.
 * CM_OK or CM_ERROR_MEMORY. */
cm_status cm_pyramid_make(const cm_surface *surface, const cm_image *pictures,
                          const cm_values *values, const cm_sample_set *set, unsigned count,
                          int32_t border, int is_whole, const cm_memory *memory, unsigned threads,
                          cm_pyramid *pyramid);

void cm_pyramid_free(cm_pyramid *pyramid);

#endif
