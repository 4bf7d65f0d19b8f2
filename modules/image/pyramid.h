/* SPDX-License-Identifier: MIT
 *
 * Levels of a surface, each of half the size of the one above, the first perhaps of three eighths, with what the sphere has
 * beyond their edges.
 */
#ifndef MODULES_IMAGE_PYRAMID_H
#define MODULES_IMAGE_PYRAMID_H

#include "padded.h"

#include <stdatomic.h>

/* Planes of 2^30 pixels have 31 halves. */
#define CM_LEVELS_MAX 32

/* The sizes of levels: 1, 1/2, 1/4, ...; or 1, 3/8, 3/16, 3/32, ..., if level 0 is large enough for that. */
typedef enum cm_pyramid_steps
{
    CM_PYRAMID_HALVES,
    CM_PYRAMID_EIGHTHS
} cm_pyramid_steps;

typedef struct cm_level_size
{
    uint32_t width;
    uint32_t height;
} cm_level_size;

/* Pixels beyond the edges of planes: of all, and beside those whose columns come again after a period. */
#define CM_PYRAMID_BORDER 16
#define CM_PYRAMID_BESIDE 64

/* Level 0 are the pictures themselves, which must stay. */
typedef struct cm_pyramid
{
    unsigned count;
    cm_level pictures;
    cm_level_reader reader; /* of the pictures */
    int is_whole;           /* are the other levels whole numbers? */
    /* from 1 on; each row channel by channel. Sizes and borders are known before the pixels are there */
    cm_padded level[CM_LEVELS_MAX];
    const cm_surface *surface;
    cm_pyramid_steps steps;
    const cm_filter_set *set;
    atomic_uint made; /* levels that are there, with the pictures */
    atomic_int busy;  /* does some thread make more of them? */
} cm_pyramid;

/* The sizes of levels from that to 1 x 1; returns how many there are. */
unsigned cm_pyramid_sizes(cm_pyramid_steps steps, uint32_t width, uint32_t height,
                          cm_level_size sizes[CM_LEVELS_MAX]);

/* The levels of pictures of the surface, whose own have a border as wide as wanted, or what the next level needs; the
 * others lie in `memory` as of cm_padded_create. If is_whole, they are whole numbers of CM_PADDED_ONE, which is for bytes.
 * What is after the first `wanted` levels is made when cm_pyramid_need asks for it. The surface must stay. CM_OK or
 * CM_ERROR_MEMORY. */
cm_status cm_pyramid_make(const cm_surface *surface, const cm_image *pictures,
                          const cm_values *values, const cm_sample_set *set, cm_pyramid_steps steps,
                          int32_t border, int is_whole, unsigned wanted, const cm_memory *memory,
                          unsigned threads, cm_pyramid *pyramid);

/* Level k is there from now on: it is made if it is not, by one thread, for which others wait. Bits do not depend on when
 * that is. CM_OK or CM_ERROR_MEMORY, after which it may be tried again. */
cm_status cm_pyramid_need(const cm_pyramid *pyramid, unsigned k);

void cm_pyramid_free(cm_pyramid *pyramid);

#endif
