/* SPDX-License-Identifier: MIT */
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
    free(marks->hit);
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
    void *more = wanted > INT32_MAX ? NULL : realloc(*list, wanted * size);
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
    return &marks->region[marks->slot[slot] - 1];
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
        made->hit = CM_NO_HIT;
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

static int add_hit(cm_point_marks *marks, cm_block_marks *block, unsigned cell, const uint8_t *rgb)
{
    if (rgb == NULL)
    {
        return 1;
    }
    void *list = marks->hit, *colors = marks->color;
    size_t room = marks->hit_room;
    if (!has_room(&list, marks->hit_count, &room, sizeof *marks->hit, 256))
    {
        return 0;
    }
    marks->hit = list;
    if (!has_room(&colors, marks->hit_count, &marks->hit_room, sizeof *marks->color, 256))
    {
        return 0;
    }
    marks->color = colors;
    marks->hit[marks->hit_count] = (cm_point_hit){block->hit, cell};
    marks->color[marks->hit_count] = cm_color_word(rgb);
    block->hit = (uint32_t)marks->hit_count++;
    return 1;
}

/* The block that a hit is in; NULL if there is no memory. */
static cm_block_marks *hit_block(cm_point_marks *marks, const uint32_t place[3])
{
    const uint32_t in_block = ((uint32_t)1 << CM_BLOCK_LEVEL) - 1;
    uint32_t differs = 0;
    for (int axis = 0; axis < 3; axis++)
    {
        differs |= (place[axis] ^ marks->last_place[axis]) & ~in_block;
    }
    if (marks->last != 0 && differs == 0)
    {
        return &marks->block[marks->last - 1];
    }
    const uint32_t in_region = ((uint32_t)1 << CM_REGION_LEVEL) - 1;
    const uint32_t first[3] = {place[0] & ~in_region, place[1] & ~in_region, place[2] & ~in_region};
    cm_region_marks *region = region_of(marks, first);
    if (region == NULL)
    {
        return NULL;
    }
    region->has_hits = 1;
    cm_block_marks *block =
        block_of(marks, region,
                 cm_interleave_3(place[0] >> CM_BLOCK_LEVEL, place[1] >> CM_BLOCK_LEVEL,
                                 place[2] >> CM_BLOCK_LEVEL));
    if (block != NULL)
    {
        memcpy(marks->last_place, place, sizeof marks->last_place);
        marks->last = (uint32_t)(block - marks->block) + 1;
    }
    return block;
}

int cm_marks_hit(cm_point_marks *marks, const uint32_t place[3], const uint8_t *rgb)
{
    cm_block_marks *block = hit_block(marks, place);
    if (block == NULL)
    {
        return 0;
    }
    const unsigned cell = cm_interleave_3(place[0], place[1], place[2]);
    const uint64_t bit = (uint64_t)1 << cell % 64;
    if (block->hits[cell / 64] & bit)
    {
        return 1; /* an earlier point's color is its own */
    }
    block->hits[cell / 64] |= bit;
    return add_hit(marks, block, cell, rgb);
}
