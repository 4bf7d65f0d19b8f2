/* SPDX-License-Identifier: MIT
 *
 * Where the pixels of blocks go in the pictures of a target: row by row, by whole lines past the caches, or one by one.
 */
#ifndef MODULES_IMAGE_BLOCK_TARGET_H
#define MODULES_IMAGE_BLOCK_TARGET_H

#include "geometry.h"
#include "source.h"

/* What all threads write to. */
typedef struct cm_target
{
    const cm_plan *plan;
    const cm_source *source;
    const cm_image *to;
    cm_values values; /* as they are stored in the target */
    cm_rows wanted;   /* of one plane */
} cm_target;

/* So many blocks side by side, at most, have rows of whole lines of memory. */
#define CM_BUNDLE_MOST 4

/* Bytes of a pixel of which rows are bundled, at most: those of four floats. */
#define CM_BUNDLED_MOST 16

/* Room for a bundle. */
#define CM_BUNDLE_BYTES (CM_BLOCK_PIXELS * CM_BUNDLE_MOST * CM_BUNDLED_MOST)

/* Where a row of blocks goes. */
typedef struct cm_row_target
{
    unsigned char *first; /* the pixel of column 0; NULL: pixels go one by one */
    ptrdiff_t right;      /* from column to column, in bytes */
    ptrdiff_t down;       /* from row to row */
    uint32_t bundle;      /* blocks that go to memory together, past the caches; 0: by themselves */
    unsigned char *memory; /* of a bundle, CM_BUNDLE_BYTES */
} cm_row_target;

/* Where the rows of a block go. */
typedef struct cm_block_target
{
    unsigned char *first; /* NULL: pixels go one by one */
    ptrdiff_t down;       /* from row to row, in bytes */
    unsigned char
        *own; /* not NULL: first is in a bundle, and this is where the block's pixels come to be */
    int is_last; /* of its bundle? */
    int is_past; /* is it a bundle of its own, without a copy? */
} cm_block_target;

/* Of the row of blocks that begins with that row of pixels. */
cm_row_target cm_target_row(const cm_target *job, unsigned plane, uint32_t row,
                            unsigned char *memory);

cm_block_target cm_target_block(const cm_target *job, const cm_row_target *row, uint32_t column);

/* Asks for the memory of a block before it is written. bytes: of a row of it. */
void cm_target_fetch(const cm_block_target *target, size_t bytes);

/* The pixels of a group, dense, as the source's level has them. */
void cm_target_store(const cm_target *job, unsigned plane, uint32_t block_column,
                     uint32_t block_row, const cm_group *group, const cm_block_target *target,
                     unsigned char *pixels);

/* What the source does not show of a block is 0. */
void cm_target_clear(const cm_target *job, unsigned plane, uint32_t block_column,
                     uint32_t block_row, const cm_group *groups, unsigned count);

/* After all groups of a block, of which all may have come as a whole. Bundles that are full go to memory. */
void cm_target_finish(const cm_target *job, const cm_row_target *row, const cm_block_target *target,
                      int came_whole);

#endif
