/* SPDX-License-Identifier: MIT */
#include "modules/memory/checked_size.h"
#include "voxel_region.h"

#include <stdlib.h>
#include <string.h>

#include "block_access.h"

cm_region *cm_region_make(const uint32_t place[3], uint8_t alpha)
{
    cm_region *region = calloc(1, sizeof *region);
    if (region != NULL)
    {
        memcpy(region->place, place, sizeof region->place);
        memset(region->value, alpha, sizeof region->value);
        memset(region->solid, alpha > CM_UNKNOWN ? 0xff : 0, sizeof region->solid);
        region->is_dirty = 1;
    }
    return region;
}

uint64_t cm_region_size(const cm_region *region)
{
    return sizeof *region + region->bytes +
           (region->color != NULL ? CM_REGION_BLOCKS * sizeof *region->color : 0);
}

/* ---- forms ---- */

static size_t alpha_bytes(unsigned form, unsigned detail)
{
    const size_t cells = cm_cell_count(detail);
    switch (form)
    {
    case CM_BLOCK_EVEN:
        return 0;
    case CM_BLOCK_PLAIN:
        return cells < 64 ? 64 : cells; /* loops write 64 at once */
    case CM_BLOCK_BYTES:
        return cells;
    default:
        return cm_palette_count(form) + (cells * form + 7) / 8;
    }
}

/* How many colors a packed block has: of its occupied cells. */
static size_t colored_cells(const cm_region *region, unsigned block, size_t end)
{
    size_t count = 0;
    for (size_t cell = 0; cell < end; cell++)
    {
        count += cm_block_stored(region, block, cell) > CM_UNKNOWN;
    }
    return count;
}

static size_t color_count(const cm_region *region, unsigned block)
{
    const size_t cells = cm_cell_count(region->detail[block]);
    if (region->color == NULL || region->color[block] == NULL)
    {
        return 0;
    }
    return region->form[block] == CM_BLOCK_PLAIN ? cells
           : cm_has_one_color(region, block)     ? 1
                                                 : colored_cells(region, block, cells);
}

static uint64_t block_bytes(const cm_region *region, unsigned block)
{
    return alpha_bytes(region->form[block], region->detail[block]) +
           color_count(region, block) * sizeof(uint32_t);
}

/* ---- memory ---- */

static void release(cm_region *region, unsigned block)
{
    region->bytes -= block_bytes(region, block);
    free(region->alpha[block]);
    region->alpha[block] = NULL;
    region->one_color[block / 8] &= (uint8_t) ~(1u << block % 8);
    if (region->color != NULL)
    {
        free(region->color[block]);
        region->color[block] = NULL;
    }
}

void cm_region_drop(cm_region *region)
{
    if (region == NULL)
    {
        return;
    }
    for (unsigned block = 0; block < CM_REGION_BLOCKS; block++)
    {
        free(region->alpha[block]);
        if (region->color != NULL)
        {
            free(region->color[block]);
        }
    }
    free(region->color);
    free(region);
}

void cm_block_even(cm_region *region, unsigned block, uint8_t alpha)
{
    release(region, block);
    cm_region_mark(region, block, alpha > CM_UNKNOWN);
    region->value[block] = alpha;
    region->form[block] = CM_BLOCK_EVEN;
    region->detail[block] = 0;
}

void cm_region_miss(cm_region *region, const cm_count_rule *rule, unsigned misses)
{
    for (unsigned block = 0; misses > 0 && block < CM_REGION_BLOCKS; block++)
    {
        region->value[block] = region->form[block] == CM_BLOCK_EVEN
                                   ? cm_after_misses(rule, region->value[block], misses)
                                   : cm_more_misses(region->value[block], misses);
    }
}

int cm_region_is_even(const cm_region *region, uint8_t *alpha)
{
    for (unsigned block = 0; block < CM_REGION_BLOCKS; block++)
    {
        if (region->form[block] != CM_BLOCK_EVEN || region->value[block] != region->value[0])
        {
            return 0;
        }
    }
    *alpha = region->value[0];
    return 1;
}

/* ---- reading ---- */

static void read_packed(const cm_region *region, unsigned block, size_t cells, uint8_t *alpha)
{
    const unsigned form = region->form[block];
    const uint8_t *from = region->alpha[block];
    if (form == CM_BLOCK_PLAIN || form == CM_BLOCK_BYTES)
    {
        memcpy(alpha, from, cells);
        return;
    }
    const uint8_t *bits = from + cm_palette_count(form);
    for (size_t cell = 0; cell < cells; cell++)
    {
        alpha[cell] = from[bits[cell * form / 8] >> cell * form % 8 & ((1u << form) - 1u)];
    }
}

static void read_colors(const cm_region *region, unsigned block, size_t cells, uint32_t *color)
{
    const uint32_t *from = region->color == NULL ? NULL : region->color[block];
    if (from == NULL)
    {
        memset(color, 0, cells * sizeof *color);
        return;
    }
    const int is_plain = region->form[block] == CM_BLOCK_PLAIN;
    const size_t step = cm_has_one_color(region, block) ? 0 : 1;
    for (size_t cell = 0, next = 0; cell < cells; cell++)
    {
        const int is_occupied = cm_block_stored(region, block, cell) > CM_UNKNOWN;
        color[cell] = !is_occupied ? 0 : is_plain ? from[cell] : from[next];
        next += is_occupied ? step : 0;
    }
}

unsigned cm_block_read(const cm_region *region, unsigned block, const cm_count_rule *rule,
                       unsigned more, uint8_t alpha[512], uint32_t *color)
{
    const unsigned detail = region->detail[block];
    const size_t cells = cm_cell_count(detail);
    if (region->form[block] == CM_BLOCK_EVEN)
    {
        memset(alpha, cm_after_misses(rule, region->value[block], more), cells);
        if (color != NULL)
        {
            memset(color, 0, cells * sizeof *color);
        }
        return detail;
    }
    const unsigned misses = cm_more_misses(region->value[block], more);
    read_packed(region, block, cells, alpha);
    if (color != NULL)
    {
        read_colors(region, block, cells, color);
    }
    for (size_t cell = 0; misses > 0 && cell < cells; cell++)
    {
        alpha[cell] = cm_after_misses(rule, alpha[cell], misses);
        if (color != NULL && alpha[cell] <= CM_UNKNOWN)
        {
            color[cell] = 0;
        }
    }
    return detail;
}

uint8_t cm_block_cell(const cm_region *region, unsigned block, const cm_count_rule *rule,
                      unsigned more, unsigned cell, uint32_t *color)
{
    if (region->form[block] == CM_BLOCK_EVEN)
    {
        if (color != NULL)
        {
            *color = 0;
        }
        return cm_after_misses(rule, region->value[block], more);
    }
    const size_t at = cell >> 3 * region->detail[block];
    const uint8_t alpha = cm_after_misses(rule, cm_block_stored(region, block, at),
                                          cm_more_misses(region->value[block], more));
    if (color != NULL)
    {
        const uint32_t *from = region->color == NULL ? NULL : region->color[block];
        *color = from == NULL || alpha <= CM_UNKNOWN     ? 0
                 : region->form[block] == CM_BLOCK_PLAIN ? from[at]
                 : cm_has_one_color(region, block)       ? from[0]
                                                         : from[colored_cells(region, block, at)];
    }
    return alpha;
}

/* ---- writing ---- */

/* Cells of a block in a finer detail: each stands for its parts. */
static void refine(uint8_t *alpha, uint32_t *color, unsigned from, unsigned to)
{
    const unsigned shift = 3 * (from - to);
    for (size_t cell = cm_cell_count(to); cell-- > 0;)
    {
        alpha[cell] = alpha[cell >> shift];
        if (color != NULL)
        {
            color[cell] = color[cell >> shift];
        }
    }
}

static void miss_cells(uint8_t *restrict alpha, size_t cells, const cm_count_rule *rule,
                       unsigned misses)
{
    const uint8_t low = (uint8_t)rule->low, taken = cm_taken_by(rule, misses);
    for (size_t cell = 0; misses > 0 && cell < cells; cell++)
    {
        alpha[cell] = cm_lowered(alpha[cell], taken, low);
    }
}

uint8_t *cm_block_open(cm_region *region, unsigned block, const cm_count_rule *rule,
                       unsigned detail)
{
    const unsigned form = region->form[block];
    const unsigned old = form == CM_BLOCK_EVEN ? detail : region->detail[block];
    const unsigned wanted = old < detail ? old : detail;
    const int has_colors = region->color != NULL && region->color[block] != NULL;
    if (form == CM_BLOCK_PLAIN && wanted == old)
    {
        miss_cells(region->alpha[block], cm_cell_count(old), rule, region->value[block]);
        region->value[block] = 0;
        return region->alpha[block];
    }
    const size_t cells = cm_cell_count(wanted);
    uint8_t *alpha =
        malloc(cells < CM_BLOCK_CELLS ? CM_BLOCK_CELLS : alpha_bytes(CM_BLOCK_PLAIN, wanted));
    uint32_t *color = has_colors ? cm_array_of(CM_BLOCK_CELLS, sizeof *color) : NULL;
    if (alpha == NULL || (has_colors && color == NULL))
    {
        free(alpha);
        free(color);
        return NULL;
    }
    if (form == CM_BLOCK_EVEN)
    {
        memset(alpha, region->value[block], CM_BLOCK_CELLS);
    }
    else
    {
        cm_block_read(region, block, rule, 0, alpha, color);
        refine(alpha, color, old, wanted);
    }
    release(region, block);
    region->alpha[block] = alpha;
    if (color != NULL)
    {
        region->color[block] = color;
    }
    region->form[block] = CM_BLOCK_PLAIN;
    region->detail[block] = (uint8_t)wanted;
    region->value[block] = 0;
    region->bytes += block_bytes(region, block);
    return alpha;
}

uint32_t *cm_block_colors(cm_region *region, unsigned block)
{
    if (region->color == NULL)
    {
        region->color = calloc(CM_REGION_BLOCKS, sizeof *region->color);
    }
    if (region->color != NULL && region->color[block] == NULL)
    {
        const size_t cells = cm_cell_count(region->detail[block]);
        region->color[block] = calloc(cells, sizeof **region->color);
        region->bytes += region->color[block] != NULL ? cells * sizeof **region->color : 0;
    }
    return region->color == NULL ? NULL : region->color[block];
}

void cm_block_settle(cm_region *region, unsigned block)
{
    const uint8_t *alpha = region->alpha[block];
    const size_t cells = cm_cell_count(region->detail[block]);
    if (alpha[0] > CM_UNKNOWN || memcmp(alpha, alpha + 1, cells - 1) != 0)
    {
        return;
    }
    cm_block_even(region, block, alpha[0]);
}

int cm_block_is_even(const cm_region *region, unsigned block, const cm_count_rule *rule,
                     unsigned more, uint8_t *alpha)
{
    if (region->form[block] == CM_BLOCK_EVEN)
    {
        *alpha = cm_after_misses(rule, region->value[block], more);
        return 1;
    }
    const unsigned misses = cm_more_misses(region->value[block], more);
    if (misses == 0 && region->form[block] != CM_BLOCK_PLAIN)
    {
        return 0; /* or it would not have been packed so */
    }
    const uint8_t taken = cm_taken_by(rule, misses);
    const uint8_t first = cm_lowered(cm_block_stored(region, block, 0), taken, rule->low);
    const size_t cells = cm_cell_count(region->detail[block]);
    int is_even = first <= CM_UNKNOWN;
    for (size_t cell = 1; is_even && cell < cells; cell++)
    {
        is_even = cm_lowered(cm_block_stored(region, block, cell), taken, rule->low) == first;
    }
    *alpha = first;
    return is_even;
}

void cm_block_drop_cells(cm_region *region, unsigned block, const cm_count_rule *rule)
{
    uint8_t alpha;
    if (region->form[block] != CM_BLOCK_EVEN && cm_block_is_even(region, block, rule, 0, &alpha))
    {
        cm_block_even(region, block, alpha);
    }
}

void cm_block_drain(cm_region *region, unsigned block, const cm_count_rule *rule)
{
    if (region->form[block] == CM_BLOCK_EVEN)
    {
        return;
    }
    const unsigned misses = region->value[block];
    const unsigned listed = cm_palette_count(region->form[block]);
    uint8_t most = listed > 0 ? 0 : rule->high;
    for (unsigned i = 0; i < listed; i++)
    {
        const uint8_t alpha = region->alpha[block][i];
        most = alpha > most ? alpha : most;
    }
    if (cm_after_misses(rule, most, misses) == rule->low)
    {
        cm_block_even(region, block, rule->low);
    }
    else if (cm_after_misses(rule, CM_UNKNOWN, misses) == rule->low)
    {
        cm_block_drop_cells(region, block, rule);
    }
}
