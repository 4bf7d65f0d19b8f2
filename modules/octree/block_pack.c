/* SPDX-License-Identifier: MIT
 *
 * Blocks with few values in few bits a cell, and with colors of occupied cells alone.
 */
#include "modules/memory/checked_size.h"
#include "voxel_region.h"

#include <stdlib.h>
#include <string.h>

/* The values that there are, in their order, and the place of each; how many. */
static unsigned find_values(const uint8_t *alpha, size_t cells, uint8_t value[256],
                            uint8_t place[256])
{
    uint8_t is_there[256] = {0};
    for (size_t cell = 0; cell < cells; cell++)
    {
        is_there[alpha[cell]] = 1;
    }
    unsigned count = 0;
    for (unsigned v = 0; v < 256; v++)
    {
        if (is_there[v])
        {
            place[v] = (uint8_t)count;
            value[count++] = (uint8_t)v;
        }
    }
    return count;
}

static unsigned form_for(unsigned values)
{
    return values <= 2    ? CM_BLOCK_BITS_1
           : values <= 4  ? CM_BLOCK_BITS_2
           : values <= 16 ? CM_BLOCK_BITS_4
                          : CM_BLOCK_BYTES;
}

/* A copy of cells in a form; NULL if there is no memory. */
static uint8_t *packed_cells(const uint8_t *alpha, size_t cells, unsigned form, unsigned count,
                             const uint8_t *value, const uint8_t *place, size_t *bytes)
{
    const size_t palette = form == CM_BLOCK_BYTES ? 0 : (size_t)1 << form;
    *bytes = form == CM_BLOCK_BYTES ? cells : palette + (cells * form + 7) / 8;
    uint8_t *to = calloc(1, *bytes);
    if (to == NULL)
    {
        return NULL;
    }
    if (form == CM_BLOCK_BYTES)
    {
        memcpy(to, alpha, cells);
        return to;
    }
    memcpy(to, value, count);
    for (size_t cell = 0; cell < cells; cell++)
    {
        to[palette + cell * form / 8] |= (uint8_t)(place[alpha[cell]] << cell * form % 8);
    }
    return to;
}

/* The colors of occupied cells that have one, or the only one; *count 0 and NULL if none has. Not all may have one: 0 is none. */
static int packed_colors(const uint8_t *alpha, const uint32_t *color, size_t cells, uint32_t **to,
                         size_t *count, int *is_one)
{
    size_t occupied = 0;
    uint32_t any = 0, first = 0;
    int are_equal = 1;
    for (size_t cell = 0; cell < cells; cell++)
    {
        if (alpha[cell] > CM_UNKNOWN)
        {
            first = occupied == 0 ? color[cell] : first;
            are_equal &= color[cell] == first;
            any |= color[cell];
            occupied++;
        }
    }
    *is_one = any != 0 && are_equal;
    *to = NULL;
    *count = 0;
    if (any == 0)
    {
        return 1;
    }
    *to = cm_array_of(*is_one ? 1 : occupied, sizeof **to);
    if (*to == NULL)
    {
        return 0;
    }
    for (size_t cell = 0; cell < cells && !(*is_one && *count == 1); cell++)
    {
        if (alpha[cell] > CM_UNKNOWN)
        {
            (*to)[(*count)++] = color[cell];
        }
    }
    return 1;
}

int cm_block_pack(cm_region *region, unsigned block, const cm_count_rule *rule)
{
    if (region->form[block] == CM_BLOCK_EVEN ||
        (region->form[block] != CM_BLOCK_PLAIN && region->value[block] == 0))
    {
        return 1;
    }
    uint8_t alpha[512];
    uint32_t color[512];
    const unsigned detail = cm_block_read(region, block, rule, 0, alpha, color);
    const size_t cells = cm_cell_count(detail);
    uint8_t value[256], place[256];
    const unsigned count = find_values(alpha, cells, value, place);
    if (count == 1 && alpha[0] <= CM_UNKNOWN)
    {
        cm_block_even(region, block, alpha[0]);
        return 1;
    }
    const unsigned form = form_for(count);
    size_t bytes = 0, colors = 0;
    uint32_t *packed_color = NULL;
    int is_one = 0;
    uint8_t *packed = packed_cells(alpha, cells, form, count, value, place, &bytes);
    if (packed == NULL || !packed_colors(alpha, color, cells, &packed_color, &colors, &is_one))
    {
        free(packed);
        return 0;
    }
    cm_block_even(region, block, 0);
    cm_region_mark(region, block, value[count - 1] > CM_UNKNOWN);
    region->detail[block] = (uint8_t)detail;
    region->form[block] = (uint8_t)form;
    region->alpha[block] = packed;
    if (packed_color != NULL)
    {
        region->color[block] = packed_color;
        region->one_color[block / 8] |= (uint8_t)((is_one ? 1u : 0u) << block % 8);
    }
    region->bytes += bytes + colors * sizeof *packed_color;
    return 1;
}
