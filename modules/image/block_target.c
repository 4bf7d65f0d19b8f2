/* SPDX-License-Identifier: MIT */
#include "block_target.h"
#include "past_caches.h"

#include <string.h>

/* Bytes of a target that caches do not keep. */
#define LARGE_TARGET ((size_t)4 << 20)

#ifdef __GNUC__
#define CM_FETCH_TO_WRITE(place) __builtin_prefetch(place, 1)
#else
#define CM_FETCH_TO_WRITE(place) (void)(place)
#endif

static unsigned char *target_pixel(const cm_target *job, unsigned plane, uint32_t column,
                                   uint32_t row, uint32_t *picture_column, uint32_t *picture_row,
                                   ptrdiff_t *stride)
{
    const cm_surface *to = job->plan->to;
    const cm_placement *place = &to->placement[plane];
    const cm_image *picture = &job->to[place->picture];
    const ptrdiff_t size = (ptrdiff_t)(picture->channels * cm_pixel_size(picture->type));
    const ptrdiff_t right = picture->pixel_stride != 0 ? picture->pixel_stride : size;
    const ptrdiff_t down = picture->row_stride != 0 ? picture->row_stride : right * picture->width;
    cm_placement_pixel(to, plane, column, row, picture_column, picture_row);
    if (place->turn & CM_TURN_EXCHANGED)
    {
        *stride = place->turn & CM_TURN_ROWS ? -down : down;
    }
    else
    {
        *stride = place->turn & CM_TURN_COLUMNS ? -right : right;
    }
    return (unsigned char *)picture->data + *picture_row * down + *picture_column * right;
}

static void store_run(const cm_target *job, unsigned plane, uint32_t column, uint32_t row, size_t n,
                      unsigned char *pixels)
{
    uint32_t picture_column, picture_row;
    ptrdiff_t stride;
    unsigned char *to =
        target_pixel(job, plane, column, row, &picture_column, &picture_row, &stride);
    const cm_level *level = &job->source->level;
    if (!level->is_bytes)
    {
        cm_values_store(&job->values, (float *)(void *)pixels, n, picture_column, picture_row, to,
                        stride);
    }
    else if (stride == (ptrdiff_t)level->pixel_size)
    {
        memcpy(to, pixels, n * level->pixel_size);
    }
    else
    {
        for (size_t i = 0; i < n; i++)
        {
            memcpy(to + (ptrdiff_t)i * stride, pixels + i * level->pixel_size, level->pixel_size);
        }
    }
}

/* The wanted ones of n pixels of a row that lie side by side. */
static void store_wanted(const cm_target *job, unsigned plane, uint32_t column, uint32_t row,
                         uint32_t n, unsigned char *pixels)
{
    const cm_rows *wanted = &job->wanted;
    const uint32_t first = column > wanted->first_column ? column : wanted->first_column;
    const uint32_t last = wanted->first_column + wanted->column_count;
    const uint32_t end = column + n < last ? column + n : last;
    if (row >= wanted->first_row && row < wanted->first_row + wanted->row_count && first < end)
    {
        store_run(job, plane, first, row, end - first,
                  pixels + (first - column) * job->source->level.pixel_size);
    }
}

/* Pixels of a group that lie side by side, from the one at an index. */
static uint32_t run_length(const cm_group *group, unsigned at)
{
    const uint8_t first = group->pixel[at];
    const unsigned most = CM_BLOCK_EDGE - first % CM_BLOCK_EDGE;
    uint32_t n = 1;
    while (n < most && at + n < group->count && group->pixel[at + n] == first + n)
    {
        n++;
    }
    return n;
}

static inline void copy_each(const unsigned char *from, size_t bytes, unsigned char *to,
                             ptrdiff_t down)
{
    for (int i = 0; i < CM_BLOCK_EDGE; i++, from += bytes, to += down)
    {
        memcpy(to, from, bytes);
    }
}

/* Rows of a block one below the other, each of so many bytes. The frequent sizes are constants, which need no call. */
static void copy_rows(const unsigned char *from, size_t bytes, unsigned char *to, ptrdiff_t down)
{
    switch (bytes)
    {
    case CM_BLOCK_EDGE * 3:
        copy_each(from, CM_BLOCK_EDGE * 3, to, down);
        break;
    case CM_BLOCK_EDGE * 4:
        copy_each(from, CM_BLOCK_EDGE * 4, to, down);
        break;
    case CM_BLOCK_EDGE * 12:
        copy_each(from, CM_BLOCK_EDGE * 12, to, down);
        break;
    default:
        copy_each(from, bytes, to, down);
    }
}

/* How many blocks of that row are bundled. */
static uint32_t bundle_of(const cm_target *job, unsigned plane, const cm_row_target *row)
{
    const cm_image *picture = &job->to[job->plan->to->placement[plane].picture];
    const size_t size = job->source->level.pixel_size;
    const size_t bytes = size * picture->width * picture->height * job->plan->to->pictures;
    if (!CM_HAVE_PAST_CACHES || row->first == NULL || size > CM_BUNDLED_MOST ||
        bytes < LARGE_TARGET || row->down % CM_LINE != 0 ||
        (uintptr_t)row->first % CM_BLOCK_EDGE != 0)
    {
        return 0;
    }
    return size % 4 == 0 ? 1 : size % 2 == 0 ? 2 : CM_BUNDLE_MOST;
}

/* Where a row of blocks goes as it is; NULL if it does not. */
cm_row_target cm_target_row(const cm_target *job, unsigned plane, uint32_t row,
                            unsigned char *memory)
{
    const cm_rows *wanted = &job->wanted;
    const cm_level *level = &job->source->level;
    uint32_t picture_column, picture_row;
    ptrdiff_t stride;
    if (!(level->is_bytes || cm_values_are_copied(&job->values)) || row < wanted->first_row ||
        row + CM_BLOCK_EDGE > wanted->first_row + wanted->row_count)
    {
        return (cm_row_target){0};
    }
    unsigned char *to = target_pixel(job, plane, 0, row, &picture_column, &picture_row, &stride);
    const unsigned char *below =
        target_pixel(job, plane, 0, row + 1, &picture_column, &picture_row, &stride);
    cm_row_target found = {.first = stride == (ptrdiff_t)level->pixel_size ? to : NULL,
                           .right = stride,
                           .down = below - to,
                           .memory = memory};
    found.bundle = bundle_of(job, plane, &found);
    return found;
}

/* A block's place in the bundle, which begins where a line of memory does, if all of it is wanted. */
static cm_block_target target_in_bundle(const cm_target *job, const cm_row_target *row,
                                        uint32_t column, unsigned char *own)
{
    const cm_rows *wanted = &job->wanted;
    const size_t width = CM_BLOCK_EDGE * job->source->level.pixel_size;
    uint32_t before = 0;
    while (before < row->bundle && ((uintptr_t)own - before * width) % CM_LINE != 0)
    {
        before++;
    }
    const uint32_t begin = before * CM_BLOCK_EDGE;
    if (before >= row->bundle || column < wanted->first_column + begin ||
        column - begin + row->bundle * CM_BLOCK_EDGE > wanted->first_column + wanted->column_count)
    {
        return (cm_block_target){.first = own, .down = row->down};
    }
    if (row->bundle == 1)
    {
        return (cm_block_target){.first = own, .down = row->down, .is_past = 1};
    }
    return (cm_block_target){.first = row->memory + before * width,
                             .down = (ptrdiff_t)(row->bundle * width),
                             .own = own,
                             .is_last = before + 1 == row->bundle};
}

cm_block_target cm_target_block(const cm_target *job, const cm_row_target *row, uint32_t column)
{
    const cm_rows *wanted = &job->wanted;
    if (row->first == NULL || column < wanted->first_column ||
        column + CM_BLOCK_EDGE > wanted->first_column + wanted->column_count)
    {
        return (cm_block_target){.down = row->down};
    }
    unsigned char *own = row->first + column * row->right;
    return row->bundle == 0 ? (cm_block_target){.first = own, .down = row->down}
                            : target_in_bundle(job, row, column, own);
}

static void store_past(const unsigned char *from, size_t bytes, unsigned char *to, ptrdiff_t down)
{
    for (int i = 0; i < CM_BLOCK_EDGE; i++, from += bytes, to += down)
    {
        cm_store_past_caches(to, from, bytes);
    }
}

/* The bundle of which this block is the last one goes to memory. */
static void store_bundle(const cm_row_target *row, const cm_block_target *last, size_t block)
{
    const size_t width = (size_t)last->down;
    store_past(row->memory, width, last->own + block - width, row->down);
}

/* A block that has not gone to its bundle as a whole is in its place already. */
static void take_to_bundle(const cm_row_target *row, const cm_block_target *target, size_t block)
{
    for (int i = 0; i < CM_BLOCK_EDGE; i++)
    {
        memcpy(target->first + i * target->down, target->own + i * row->down, block);
    }
}

void cm_target_store(const cm_target *job, unsigned plane, uint32_t block_column,
                     uint32_t block_row, const cm_group *group, const cm_block_target *target,
                     unsigned char *pixels)
{
    const size_t size = job->source->level.pixel_size;
    const int is_whole = group->count == CM_BLOCK_PIXELS;
    if (is_whole && target->is_past)
    {
        store_past(pixels, size * CM_BLOCK_EDGE, target->first, target->down);
        return;
    }
    if (is_whole && target->first != NULL)
    {
        copy_rows(pixels, size * CM_BLOCK_EDGE, target->first, target->down);
        return;
    }
    for (unsigned i = 0; i < group->count;)
    {
        const uint32_t n = is_whole ? CM_BLOCK_EDGE : run_length(group, i);
        store_wanted(job, plane, block_column * CM_BLOCK_EDGE + group->pixel[i] % CM_BLOCK_EDGE,
                     block_row * CM_BLOCK_EDGE + group->pixel[i] / CM_BLOCK_EDGE, n,
                     pixels + i * size);
        i += n;
    }
}

static void clear_pixel(const cm_target *job, unsigned plane, uint32_t column, uint32_t row)
{
    const cm_rows *wanted = &job->wanted;
    if (row >= wanted->first_row && row < wanted->first_row + wanted->row_count &&
        column >= wanted->first_column && column < wanted->first_column + wanted->column_count)
    {
        uint32_t picture_column, picture_row;
        ptrdiff_t stride;
        unsigned char *to =
            target_pixel(job, plane, column, row, &picture_column, &picture_row, &stride);
        memset(to, 0, job->to->channels * cm_pixel_size(job->to->type));
    }
}

void cm_target_clear(const cm_target *job, unsigned plane, uint32_t block_column,
                     uint32_t block_row, const cm_group *groups, unsigned count)
{
    unsigned char there[CM_BLOCK_PIXELS] = {0};
    for (unsigned i = 0; i < count; i++)
    {
        for (unsigned k = 0; k < groups[i].count; k++)
        {
            there[groups[i].pixel[k]] = 1;
        }
    }
    for (unsigned i = 0; i < CM_BLOCK_PIXELS; i++)
    {
        if (!there[i])
        {
            clear_pixel(job, plane, block_column * CM_BLOCK_EDGE + i % CM_BLOCK_EDGE,
                        block_row * CM_BLOCK_EDGE + i / CM_BLOCK_EDGE);
        }
    }
}

void cm_target_fetch(const cm_block_target *target, size_t bytes)
{
    const int has_rows = target->first != NULL && target->own == NULL && !target->is_past;
    for (ptrdiff_t i = 0; i < CM_BLOCK_EDGE && has_rows; i++)
    {
        const unsigned char *row = target->first + i * target->down;
        CM_FETCH_TO_WRITE(row + bytes - 1);
        for (size_t at = 64; at < bytes; at += 64)
        {
            CM_FETCH_TO_WRITE(row + bytes - 1 - at);
        }
    }
}

void cm_target_finish(const cm_target *job, const cm_row_target *row, const cm_block_target *target,
                      int came_whole)
{
    const size_t block = CM_BLOCK_EDGE * job->source->level.pixel_size;
    if (target->own != NULL && !came_whole)
    {
        take_to_bundle(row, target, block);
    }
    if (target->is_last)
    {
        store_bundle(row, target, block);
    }
}
