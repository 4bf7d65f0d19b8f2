/* SPDX-License-Identifier: MIT */
#include "modules/memory/checked_size.h"
#include "ray_index.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include "block_mask.h"
#include "interleave.h"
#include "walk.h"

/* An index takes as long as so many rays for each region, without it. */
#define RAYS_A_REGION 16

/* No box has more blocks than this part of the map's bytes; what is of a block itself takes no more than the map. */
#define PART_OF_MAP 8

/* As far as rays go in one step, in blocks. */
#define AWAY_MOST 16

/* A block that has something occupied. */
typedef struct found_block
{
    int32_t place[3];        /* in blocks */
    const cm_region *region; /* NULL: a part of an even cube */
    uint16_t block;
    uint8_t above; /* misses that wait above the region */
} found_block;

typedef struct finding
{
    const cm_octree *octree;
    found_block *found;
    size_t count;
    size_t room;
    size_t most;       /* blocks of the box: the map is too large beyond */
    size_t most_found; /* and of those that have something */
} finding;

/* What is not 0 stops. */
static int add(finding *f, const uint32_t place[3], const cm_region *region, unsigned block,
               unsigned above)
{
    if (f->count == f->room)
    {
        const size_t room = f->room == 0 ? 1024 : 2 * f->room;
        found_block *more =
            f->count >= f->most_found ? NULL : cm_array_resized(f->found, room, sizeof *f->found);
        if (more == NULL)
        {
            return 1;
        }
        f->found = more;
        f->room = room;
    }
    found_block *at = &f->found[f->count++];
    for (int axis = 0; axis < 3; axis++)
    {
        at->place[axis] = (int32_t)(place[axis] >> CM_BLOCK_LEVEL);
    }
    at->region = region;
    at->block = (uint16_t)block;
    at->above = (uint8_t)above;
    return 0;
}

static int find_even(void *user, const uint32_t place[3], int level, uint8_t alpha)
{
    finding *f = user;
    const uint32_t edge = level > CM_BLOCK_LEVEL ? 1u << (level - CM_BLOCK_LEVEL) : 1u;
    const uint64_t blocks = alpha > CM_UNKNOWN ? (uint64_t)edge * edge * edge : 0;
    int stops = blocks > f->most_found;
    for (uint64_t i = 0; !stops && i < blocks; i++)
    {
        const uint32_t at[3] = {place[0] + 8 * (uint32_t)(i % edge),
                                place[1] + 8 * (uint32_t)(i / edge % edge),
                                place[2] + 8 * (uint32_t)(i / edge / edge)};
        stops = add(f, at, NULL, 0, 0);
    }
    return stops;
}

static int find_block(void *user, const cm_region *region, unsigned block, unsigned misses)
{
    unsigned in[3];
    cm_divide_3(block, in);
    const uint32_t place[3] = {region->place[0] + 8 * in[0], region->place[1] + 8 * in[1],
                               region->place[2] + 8 * in[2]};
    return add(user, place, region, block, misses);
}

/* The box around all; 0 if it has more blocks than `most`. */
static size_t find_box(const finding *f, cm_ray_index *index)
{
    size_t blocks = 1;
    for (int axis = 0; axis < 3; axis++)
    {
        int32_t least = INT32_MAX, greatest = INT32_MIN;
        for (size_t i = 0; i < f->count; i++)
        {
            const int32_t place = f->found[i].place[axis];
            least = place < least ? place : least;
            greatest = place > greatest ? place : greatest;
        }
        index->first[axis] = f->count == 0 ? 0 : least;
        index->count[axis] = f->count == 0 ? 1 : greatest - least + 1;
        blocks = blocks <= f->most ? blocks * (size_t)index->count[axis] : blocks;
    }
    return blocks <= f->most ? blocks : 0;
}

static size_t index_at(const cm_ray_index *index, const int32_t place[3])
{
    size_t at = 0;
    for (int axis = 2; axis >= 0; axis--)
    {
        at = at * (size_t)index->count[axis] + (size_t)(place[axis] - index->first[axis]);
    }
    return at;
}

/* ---- how far away ---- */

static void away_along_row(uint8_t *row, size_t n)
{
    for (size_t i = 1; i < n; i++)
    {
        const unsigned step = row[i - 1] + 1u;
        row[i] = (uint8_t)(step < row[i] ? step : row[i]);
    }
    for (size_t i = n - 1; i-- > 0;)
    {
        const unsigned step = row[i + 1] + 1u;
        row[i] = (uint8_t)(step < row[i] ? step : row[i]);
    }
}

/* What is so many lines away counts as far as it is, or as far as it has to the next. */
static void heed_line(size_t n, const uint8_t *restrict from, uint8_t apart, uint8_t *restrict to)
{
    for (size_t i = 0; i < n; i++)
    {
        const uint8_t further = from[i] > apart ? from[i] : apart;
        to[i] = further < to[i] ? further : to[i];
    }
}

/* Along an axis whose neighbours are `stride` apart: lines of `stride` blocks, `n` of them, as they were before. */
static void away_along_lines(uint8_t *away, uint8_t *before, size_t n, size_t stride)
{
    memcpy(before, away, n * stride);
    for (size_t line = 0; line < n; line++)
    {
        for (size_t apart = 1; apart < AWAY_MOST; apart++)
        {
            if (line >= apart)
            {
                heed_line(stride, before + (line - apart) * stride, (uint8_t)apart,
                          away + line * stride);
            }
            if (line + apart < n)
            {
                heed_line(stride, before + (line + apart) * stride, (uint8_t)apart,
                          away + line * stride);
            }
        }
    }
}

/* The greatest difference of coordinates to the nearest block with a bit, AWAY_MOST at most, axis by axis. 0 if there is no
 * memory. */
static int measure(cm_ray_index *index)
{
    const size_t row = (size_t)index->count[0], slice = row * (size_t)index->count[1];
    const size_t slices = (size_t)index->count[2], all = slice * slices;
    uint8_t *before = malloc(all);
    if (before == NULL)
    {
        return 0;
    }
    for (size_t i = 0; i < all; i++)
    {
        index->away[i] = index->has[i / 64] >> i % 64 & 1u ? 0 : AWAY_MOST;
    }
    for (size_t at = 0; at < all; at += row)
    {
        away_along_row(index->away + at, row);
    }
    for (size_t at = 0; at < all; at += slice)
    {
        away_along_lines(index->away + at, before, (size_t)index->count[1], row);
    }
    away_along_lines(index->away, before, slices, slice);
    free(before);
    return 1;
}

/* ---- the whole index ---- */

static void clear(cm_ray_index *index)
{
    free(index->away);
    free(index->has);
    free(index->before);
    free(index->block);
    free(index->alpha);
    free(index->color);
    *index = (cm_ray_index){.away = NULL};
}

/* Bits and numbers of blocks. */
static void number_blocks(const finding *f, cm_ray_index *index, size_t words)
{
    for (size_t i = 0; i < f->count; i++)
    {
        const size_t at = index_at(index, f->found[i].place);
        index->has[at / 64] |= (uint64_t)1 << at % 64;
    }
    uint32_t before = 0;
    for (size_t w = 0; w < words; w++)
    {
        index->before[w] = before;
        before += cm_bit_count(index->has[w]);
    }
}

/* Masks, and how many values there are. */
static size_t mask_blocks(const finding *f, cm_ray_index *index)
{
    size_t values = 0;
    for (size_t i = 0; i < f->count; i++)
    {
        const found_block *from = &f->found[i];
        cm_ray_block *to = &index->block[cm_ray_block_number(index, index_at(index, from->place))];
        if (from->region == NULL)
        {
            memset(to->mask, 0xff, sizeof to->mask);
            to->level = CM_RAY_BLOCK_EVEN;
            continue;
        }
        cm_block_mask(from->region, from->block, &f->octree->rule, from->above, to->mask);
        to->level = from->region->detail[from->block];
        to->first = (uint32_t)values;
        unsigned before = 0;
        for (unsigned w = 0; w < 8; w++)
        {
            to->before[w] = (uint16_t)before;
            before += cm_bit_count(to->mask[w]);
        }
        values += before;
    }
    return values;
}

static void copy_values(const finding *f, cm_ray_index *index)
{
    for (size_t i = 0; i < f->count; i++)
    {
        const found_block *from = &f->found[i];
        const cm_region *region = from->region;
        if (region == NULL)
        {
            continue;
        }
        const cm_ray_block *block =
            &index->block[cm_ray_block_number(index, index_at(index, from->place))];
        const int is_plain = region->form[from->block] == CM_BLOCK_PLAIN;
        const unsigned misses = cm_more_misses(region->value[from->block], from->above);
        uint8_t read_alpha[512];
        uint32_t read_color[512];
        if (!is_plain)
        {
            cm_block_read(region, from->block, &f->octree->rule, from->above, read_alpha,
                          read_color);
        }
        const uint8_t *alpha = is_plain ? region->alpha[from->block] : read_alpha;
        const uint32_t *color = !is_plain               ? read_color
                                : region->color == NULL ? NULL
                                                        : region->color[from->block];
        size_t at = block->first;
        for (unsigned w = 0; w < 8; w++)
        {
            for (uint64_t left = block->mask[w]; left != 0; left &= left - 1, at++)
            {
                const unsigned cell = (64 * w + cm_lowest_bit(left)) >> 3 * block->level;
                index->alpha[at] =
                    is_plain ? cm_after_misses(&f->octree->rule, alpha[cell], misses) : alpha[cell];
                index->color[at] = color == NULL ? 0 : color[cell];
            }
        }
    }
}

static int build(const finding *f, cm_ray_index *index)
{
    const size_t blocks = find_box(f, index), words = blocks / 64 + 1;
    if (blocks == 0)
    {
        return 0;
    }
    index->away = malloc(blocks);
    index->has = calloc(words, sizeof *index->has);
    index->before = cm_array_of(words, sizeof *index->before);
    index->block = calloc(f->count + 1, sizeof *index->block);
    if (index->away == NULL || index->has == NULL || index->before == NULL || index->block == NULL)
    {
        return 0;
    }
    number_blocks(f, index, words);
    const size_t values = mask_blocks(f, index);
    index->alpha = malloc(values + 1);
    index->color = cm_array_of(values + 1, sizeof *index->color);
    if (values > UINT32_MAX || index->alpha == NULL || index->color == NULL)
    {
        return 0;
    }
    copy_values(f, index);
    return measure(index);
}

static cm_ray_index *make(const cm_octree *octree)
{
    cm_ray_index *index = calloc(1, sizeof *index);
    if (index == NULL)
    {
        return NULL;
    }
    const uint64_t most = octree->bytes / PART_OF_MAP;
    finding f = {.octree = octree,
                 .most = most < UINT32_MAX ? (size_t)most : UINT32_MAX,
                 .most_found = (size_t)(octree->bytes / sizeof(cm_ray_block))};
    cm_walk walk = {.only_solid = 1, .user = &f, .even = find_even, .block = find_block};
    cm_walk_all(octree, &walk);
    if (cm_walk_run(octree, &walk) != CM_OK || !build(&f, index))
    {
        clear(index);
    }
    free(f.found);
    return index;
}

const cm_ray_index *cm_ray_index_of(const cm_octree *octree)
{
    const cm_ray_index *made = atomic_load_explicit(&octree->ray_index, memory_order_acquire);
    if (made != NULL || octree->options.pages != NULL)
    {
        return made != NULL && made->away != NULL ? made : NULL;
    }
    /* what the caller sees of the map does not change; one of all threads makes it, and who has it uses it */
    cm_octree *owner = (cm_octree *)(uintptr_t)octree;
    const uint64_t enough = RAYS_A_REGION * (uint64_t)octree->region_count;
    if (atomic_fetch_add_explicit(&owner->rays_asked, 1, memory_order_relaxed) != enough)
    {
        return NULL;
    }
    cm_ray_index *index = make(octree);
    atomic_store_explicit(&owner->ray_index, index, memory_order_release);
    return index != NULL && index->away != NULL ? index : NULL;
}

void cm_ray_index_forget(cm_octree *octree)
{
    cm_ray_index *index = atomic_load_explicit(&octree->ray_index, memory_order_relaxed);
    if (index != NULL)
    {
        clear(index);
        free(index);
        atomic_store_explicit(&octree->ray_index, NULL, memory_order_relaxed);
    }
    atomic_store_explicit(&octree->rays_asked, 0, memory_order_relaxed);
}
