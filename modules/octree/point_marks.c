/* SPDX-License-Identifier: MIT */
#include "modules/memory/checked_size.h"
#include "point_marks.h"

#include <stdlib.h>
#include <string.h>

#include "color_word.h"
#include "interleave.h"

void cm_marks_clear(cm_point_marks *marks)
{
    free(marks->region);
    free(marks->slot);
    free(marks->block);
    free(marks->cell);
    free(marks->run);
    free(marks->color);
    memset(marks, 0, sizeof *marks);
}

/* Room for one more of so many; 0 if there is no memory. */
static int has_room(void **list, size_t count, size_t *room, size_t size, size_t first)
{
    if (count < *room)
    {
        return 1;
    }
    const size_t wanted = *room == 0 ? first : 2 * *room;
    void *more = wanted > INT32_MAX ? NULL : cm_array_resized(*list, wanted, size);
    if (more == NULL)
    {
        return 0;
    }
    *list = more;
    *room = wanted;
    return 1;
}

/* ---- regions ---- */

/* Where a place is, or is to be. Places are multiples of 64. */
static size_t slot_of(const cm_point_marks *marks, const uint32_t place[3])
{
    const uint64_t key =
        (uint64_t)place[0] >> CM_REGION_LEVEL ^ (uint64_t)place[1] << 15 ^ (uint64_t)place[2] << 36;
    size_t slot = (size_t)(key * 0x9e3779b97f4a7c15u >> 32) & (marks->slots - 1);
    while (marks->slot[slot] != 0 &&
           memcmp(marks->region[marks->slot[slot] - 1].place, place, 3 * sizeof *place) != 0)
    {
        slot = (slot + 1) & (marks->slots - 1);
    }
    return slot;
}

/* The table is never more than half full. */
static int has_slots(cm_point_marks *marks)
{
    if (2 * (marks->region_count + 1) <= marks->slots)
    {
        return 1;
    }
    const size_t slots = marks->slots == 0 ? 64 : 2 * marks->slots;
    uint32_t *slot = calloc(slots, sizeof *slot);
    if (slot == NULL)
    {
        return 0;
    }
    free(marks->slot);
    marks->slot = slot;
    marks->slots = slots;
    for (size_t i = 0; i < marks->region_count; i++)
    {
        marks->slot[slot_of(marks, marks->region[i].place)] = (uint32_t)i + 1;
    }
    return 1;
}

static cm_region_marks *region_of(cm_point_marks *marks, const uint32_t place[3])
{
    if (marks->last_region != 0 &&
        memcmp(marks->region[marks->last_region - 1].place, place, 3 * sizeof *place) == 0)
    {
        return &marks->region[marks->last_region - 1];
    }
    if (!has_slots(marks))
    {
        return NULL;
    }
    const size_t slot = slot_of(marks, place);
    if (marks->slot[slot] == 0)
    {
        void *list = marks->region;
        if (!has_room(&list, marks->region_count, &marks->region_room, sizeof *marks->region, 16))
        {
            return NULL;
        }
        marks->region = list;
        cm_region_marks *made = &marks->region[marks->region_count];
        memset(made, 0, sizeof *made);
        memcpy(made->place, place, sizeof made->place);
        marks->slot[slot] = (uint32_t)++marks->region_count;
    }
    marks->last_region = marks->slot[slot];
    return &marks->region[marks->last_region - 1];
}

static cm_block_marks *block_of(cm_point_marks *marks, cm_region_marks *region, unsigned block)
{
    if (region->block[block] == 0)
    {
        void *list = marks->block;
        if (!has_room(&list, marks->block_count, &marks->block_room, sizeof *marks->block, 64))
        {
            return NULL;
        }
        marks->block = list;
        cm_block_marks *made = &marks->block[marks->block_count];
        memset(made, 0, sizeof *made);
        region->block[block] = (uint32_t)++marks->block_count;
    }
    return &marks->block[region->block[block] - 1];
}

cm_block_marks *cm_marks_of(cm_point_marks *marks, const uint32_t place[3], unsigned block)
{
    cm_region_marks *region = region_of(marks, place);
    return region == NULL ? NULL : block_of(marks, region, block);
}

/* ---- hits ---- */

/* The same bit of each coordinate of a place. */
#define OF_EACH(bit)                                                                               \
    ((uint64_t)(bit) | (uint64_t)(bit) << CM_PLACE_BITS | (uint64_t)(bit) << 2 * CM_PLACE_BITS)

static unsigned cell_of(uint64_t place)
{
    const uint64_t spread =
        (place & OF_EACH(1)) | (place & OF_EACH(2)) << 2 | (place & OF_EACH(4)) << 4;
    return (unsigned)(spread | spread >> (CM_PLACE_BITS - 1) | spread >> 2 * (CM_PLACE_BITS - 1)) &
           511u;
}

/* The block at a place, a multiple of 8; NULL if there is no memory. */
static cm_block_marks *hit_block(cm_point_marks *marks, uint64_t place)
{
    uint32_t first[3], in[3];
    for (int axis = 0; axis < 3; axis++)
    {
        const uint32_t at = (uint32_t)(place >> CM_PLACE_BITS * axis) & ((1u << CM_PLACE_BITS) - 1);
        first[axis] = at >> CM_REGION_LEVEL << CM_REGION_LEVEL;
        in[axis] = at >> CM_BLOCK_LEVEL;
    }
    cm_region_marks *region = region_of(marks, first);
    if (region == NULL)
    {
        return NULL;
    }
    region->has_hits = 1;
    return block_of(marks, region, cm_interleave_3(in[0], in[1], in[2]));
}

/* Room for as many hits with colors as there are points, each in a run of its own. */
static int has_hit_room(cm_point_marks *marks)
{
    void *cells = marks->cell, *colors = marks->color, *runs = marks->run;
    const size_t count = marks->hit_count + CM_POINTS_TOGETHER - 1;
    size_t room = marks->hit_room;
    if (!has_room(&cells, count, &room, sizeof *marks->cell, 1024))
    {
        return 0;
    }
    marks->cell = cells;
    if (!has_room(&colors, count, &marks->hit_room, sizeof *marks->color, 1024))
    {
        return 0;
    }
    marks->color = colors;
    if (!has_room(&runs, marks->run_count + CM_POINTS_TOGETHER - 1, &marks->run_room,
                  sizeof *marks->run, 1024))
    {
        return 0;
    }
    marks->run = runs;
    return 1;
}

/* A hit with a color, which is the first of its voxel. */
static void add_hit(cm_point_marks *marks, cm_block_marks *block, unsigned cell, const uint8_t *rgb)
{
    if (block->run == 0 || block->run != marks->run_count)
    {
        marks->run[marks->run_count++] = (cm_hit_run){(uint32_t)marks->hit_count, block->run};
        block->run = (uint32_t)marks->run_count;
    }
    marks->cell[marks->hit_count] = (uint16_t)cell;
    marks->color[marks->hit_count++] = cm_color_word(rgb);
}

int cm_marks_hits(cm_point_marks *marks, const uint64_t place[CM_POINTS_TOGETHER], uint64_t bits,
                  const uint8_t *rgb)
{
    if (rgb != NULL && !has_hit_room(marks))
    {
        return 0;
    }
    cm_block_marks *block = marks->last == 0 ? NULL : &marks->block[marks->last - 1];
    for (; bits != 0; bits &= bits - 1)
    {
        const size_t i = (size_t)__builtin_ctzll(bits);
        const uint64_t of_block = place[i] & ~OF_EACH(7);
        if (block == NULL || of_block != marks->last_place)
        {
            block = hit_block(marks, of_block);
            if (block == NULL)
            {
                return 0;
            }
            marks->last_place = of_block;
            marks->last = (uint32_t)(block - marks->block) + 1;
        }
        const unsigned cell = cell_of(place[i]);
        const uint64_t bit = (uint64_t)1 << cell % 64;
        const int is_first = (block->hits[cell / 64] & bit) == 0;
        block->hits[cell / 64] |= bit;
        if (is_first && rgb != NULL)
        {
            add_hit(marks, block, cell, rgb + 3 * i);
        }
    }
    return 1;
}
