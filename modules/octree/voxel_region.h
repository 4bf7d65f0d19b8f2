/* SPDX-License-Identifier: MIT
 *
 * Regions and their blocks: reading cells, writing them, packing them.
 */
#ifndef MODULES_OCTREE_VOXEL_REGION_H
#define MODULES_OCTREE_VOXEL_REGION_H

#include "color_word.h"
#include "octree_object.h"

/* Cells of a block of that detail. */
static inline size_t cm_cell_count(unsigned detail)
{
    return (size_t)512 >> 3 * detail;
}

/* The alphas that a block of few values has a list of. */
static inline unsigned cm_palette_count(unsigned form)
{
    return form <= CM_BLOCK_BITS_4 ? 1u << form : 0u;
}

/* The alpha of a cell as it is stored, without the misses that wait; the block is not even. */
static inline uint8_t cm_block_stored(const cm_region *region, unsigned block, size_t cell)
{
    const uint8_t *alpha = region->alpha[block];
    const unsigned form = region->form[block];
    if (form == CM_BLOCK_PLAIN || form == CM_BLOCK_BYTES)
    {
        return alpha[cell];
    }
    const unsigned place = alpha[cm_palette_count(form) + cell * form / 8];
    return alpha[place >> cell * form % 8 & ((1u << form) - 1u)];
}

/* One whose blocks all have an alpha; NULL if there is no memory. */
cm_region *cm_region_make(const uint32_t place[3], uint8_t alpha);
void cm_region_drop(cm_region *region);

/* The memory of a region with its blocks. */
uint64_t cm_region_size(const cm_region *region);

/* Bring down misses to its blocks. */
void cm_region_miss(cm_region *region, const cm_count_rule *rule, unsigned misses);

/* Alphas of a block, cm_cell_count of them, with the misses that wait; and colors, 0 where there is none (NULL: not wanted).
 * more: misses that wait above the region. Returns the detail. */
unsigned cm_block_read(const cm_region *region, unsigned block, const cm_count_rule *rule,
                       unsigned more, uint8_t alpha[512], uint32_t *color);

/* One cell of it, as cm_block_read has them; cell is of level 0. */
uint8_t cm_block_cell(const cm_region *region, unsigned block, const cm_count_rule *rule,
                      unsigned more, unsigned cell, uint32_t *color);

/* The bytes of a block that can be written, with no misses waiting: plain, of that detail or a finer one. NULL if there is no
 * memory: nothing is lost then. */
uint8_t *cm_block_open(cm_region *region, unsigned block, const cm_count_rule *rule,
                       unsigned detail);

/* The colors of an open block, which are made if there are none; NULL if there is no memory. */
uint32_t *cm_block_colors(cm_region *region, unsigned block);

/* If all cells of an open block are equal and none is occupied with a color, it is even from now on. */
void cm_block_settle(cm_region *region, unsigned block);

/* Have all voxels of a block one alpha, and none is occupied, however it is stored? It is in *alpha, with the misses that wait in
 * the block and `more` above it. Such a block says no more than an even one: what is asked and what is counted must not depend on
 * its cells, which last only until it is packed. Even blocks are such, occupied ones too. */
int cm_block_is_even(const cm_region *region, unsigned block, const cm_count_rule *rule,
                     unsigned more, uint8_t *alpha);

/* Then it has no cells from now on. */
void cm_block_drop_cells(cm_region *region, unsigned block, const cm_count_rule *rule);

/* Are all cells of a block at the lowest with the misses that wait, as far as is known without much looking? Then it becomes even,
 * and further misses change nothing. */
void cm_block_drain(cm_region *region, unsigned block, const cm_count_rule *rule);

/* Less memory for the same cells; open blocks are made of it again when they are written. 0 if there is no memory: it is
 * as it was. */
int cm_block_pack(cm_region *region, unsigned block, const cm_count_rule *rule);

/* Make it even. */
void cm_block_even(cm_region *region, unsigned block, uint8_t alpha);

/* All blocks are even and of one alpha: it is in *alpha. */
int cm_region_is_even(const cm_region *region, uint8_t *alpha);

#endif
