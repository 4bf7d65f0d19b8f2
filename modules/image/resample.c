/* SPDX-License-Identifier: MIT
 *
 * From a source to a target, block by block.
 */
#include "block_target.h"
#include "ewa_window.h"
#include "fetch.h"
#include "large_memory.h"
#include "past_caches.h"
#include "resample_stripes.h"
#include "source.h"

#include <cubemap/threads.h>

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

/* A window may have so many pixels for each that is asked; else pixels are taken by fewer at once. */
#define WINDOW_PER_PIXEL 64

/* Elements of cm_run_threads for a row of blocks: it counts in these (threads.h), and so there may be a thread for a few rows. */
#define ROW_WEIGHT 64

/* Rows of blocks that a thread takes at a time. */
#define ROWS_TAKEN 4

/* What a block reads of a source: so many rows. */
#define BLOCK_TOUCHES (CM_BLOCK_EDGE * CM_TOUCHED_AROUND)

/* Of so many pixels of a block one asks for what they need: another column in each row. */
#define FETCH_STEP 5

/* What all threads work on. */
typedef struct resample_job
{
    cm_target target;
    size_t rows;        /* of blocks, of all wanted planes */
    atomic_size_t next; /* that no thread has taken */
    atomic_int failed;
} resample_job;

/* What a thread works with. It begins where a line of memory does, and so do the first ones of what vectors are stored to:
 * what lies across two lines takes twice as long. */
typedef struct resample_desk
{
    cm_group groups[2][CM_GROUPS_MAX]; /* of a block, and of the next one */
    cm_fixed_places places[2];
    unsigned char bundle[CM_BUNDLE_BYTES]; /* of blocks, row by row */
    void *memory;                          /* in which it lies */
    cm_geometry *geometry;
    cm_scratch scratch;
    cm_row_target row; /* of the row of blocks that is done */
    cm_block_target targets[2];
    int has_places[2];     /* of blocks that go where they are to be at once */
    unsigned char *pixels; /* of a group */
} resample_desk;

/* ---- values of a group ---- */

/* Pixels of a plane, from a group's origin. */
typedef struct window_box
{
    int32_t column;
    int32_t row;
    int32_t width;
    int32_t height;
} window_box;

static int32_t floor_of(float x)
{
    const int32_t towards_zero = (int32_t)x;
    return towards_zero - ((float)towards_zero > x);
}

/* What pixels touch whose x and y are between bounds, the least and the greatest x and those of y, once their positions
 * count from the box. That may round them up to a whole number, so that the last one is asked after it. */
static window_box box_between(const cm_source *source, const float bounds[4])
{
    const int32_t before = source->taps < 2 ? 0 : source->taps / 2 - 1;
    const int32_t after = source->taps < 2 ? 1 : source->taps / 2;
    const int32_t column = floor_of(bounds[0]) - before;
    const int32_t row = floor_of(bounds[2]) - before;
    return (window_box){column, row, floor_of(bounds[1] - (float)column) + after + 1,
                        floor_of(bounds[3] - (float)row) + after + 1};
}

/* What n pixels of a group touch, a multiple of 16. */
static window_box box_of(const cm_source *source, const cm_group *group, size_t begin, size_t n)
{
    float bounds[4];
    source->places->bounds(n, group->x + begin, group->y + begin, bounds);
    return box_between(source, bounds);
}

static int is_wide(window_box box, size_t n)
{
    return (int64_t)box.width * box.height > (int64_t)(n * WINDOW_PER_PIXEL);
}

/* Is all that a group may touch in the source's own memory, by its bounds? It is nearly always, and then no extents are
 * looked for. */
static int is_there(const cm_source *source, const cm_group *group)
{
    const float bounds[4] = {group->low[0], group->high[0], group->low[1], group->high[1]};
    if (!group->is_bounded)
    {
        return 0;
    }
    const window_box box = box_between(source, bounds);
    return !is_wide(box, CM_BLOCK_PIXELS) &&
           cm_level_there(&source->level, group->plane, group->column + box.column,
                          group->row + box.row, box.width, box.height);
}

/* n pixels of a group, a multiple of 16, through one window. Its data are where the group's origin would be, inside the
 * window or not: positions are the same numbers, and so are the bits, in whatever memory it is. */
static cm_status sample_run(const cm_source *source, const cm_group *group, size_t begin, size_t n,
                            window_box box, cm_scratch *scratch, unsigned char *to)
{
    cm_window window;
    if (cm_level_there(&source->level, group->plane, group->column + box.column,
                       group->row + box.row, box.width, box.height))
    {
        cm_level_own(&source->level, group->plane, group->column, group->row, &window);
    }
    else
    {
        const cm_status status =
            cm_level_window(&source->level, group->plane, group->column + box.column,
                            group->row + box.row, box.width, box.height, scratch, &window);
        if (status != CM_OK)
        {
            return status;
        }
        window.data = (const unsigned char *)window.data - box.row * window.row_stride -
                      box.column * (ptrdiff_t)source->level.pixel_size;
    }
    source->sampler(&window, n, group->x + begin, group->y + begin, &source->table, to);
    return CM_OK;
}

/* The pixel 16 times, as samplers take no fewer. */
static cm_status sample_alone(const cm_source *source, const cm_group *group, size_t at,
                              cm_scratch *scratch, unsigned char *to)
{
    cm_group alone;
    unsigned char pixels[16 * (CM_CHANNELS_MAX + 1) * sizeof(float)];
    alone.plane = group->plane;
    alone.column = group->column;
    alone.row = group->row;
    for (size_t i = 0; i < 16; i++)
    {
        alone.x[i] = group->x[at];
        alone.y[i] = group->y[at];
    }
    const cm_status status =
        sample_run(source, &alone, 0, 16, box_of(source, &alone, 0, 16), scratch, pixels);
    memcpy(to, pixels, source->level.pixel_size);
    return status;
}

/* All pixels of a group whose window is large. */
static cm_status sample_apart(const cm_source *source, const cm_group *group, size_t whole,
                              cm_scratch *scratch, unsigned char *to)
{
    const size_t size = source->level.pixel_size;
    cm_status status = CM_OK;
    for (size_t begin = 0; begin < whole && status == CM_OK; begin += 16)
    {
        const window_box box = box_of(source, group, begin, 16);
        if (!is_wide(box, 16))
        {
            status = sample_run(source, group, begin, 16, box, scratch, to + begin * size);
            continue;
        }
        for (size_t i = begin; i < begin + 16 && i < group->count && status == CM_OK; i++)
        {
            status = sample_alone(source, group, i, scratch, to + i * size);
        }
    }
    return status;
}

/* Up to a multiple of 16; returns that. */
static size_t fill_up(cm_group *group)
{
    const size_t whole = (group->count + 15u) / 16 * 16;
    for (size_t i = group->count; i < whole; i++)
    {
        group->x[i] = group->x[group->count - 1];
        group->y[i] = group->y[group->count - 1];
    }
    return whole;
}

/* A row more each way: fewer pixels of a group may round otherwise. */
void cm_source_rows(const cm_source *source, cm_group *group, int32_t *first, int32_t *end)
{
    const float bounds[4] = {group->low[0], group->high[0], group->low[1], group->high[1]};
    const window_box box =
        group->is_tight ? box_between(source, bounds) : box_of(source, group, 0, fill_up(group));
    *first = group->row + box.row - 1;
    *end = group->row + box.row + box.height + 1;
}

/* All pixels of a group, which is filled up to a multiple of 16. */
cm_status cm_source_sample(const cm_source *source, cm_group *group, cm_scratch *scratch,
                           unsigned char *to)
{
    if (source->filter == CM_FILTER_EWA)
    {
        return cm_ewa_group(&source->ewa, group, scratch, (float *)(void *)to);
    }
    const size_t whole = fill_up(group);
    if (is_there(source, group))
    {
        cm_window window;
        cm_level_own(&source->level, group->plane, group->column, group->row, &window);
        source->sampler(&window, whole, group->x, group->y, &source->table, to);
        return CM_OK;
    }
    const window_box box = box_of(source, group, 0, whole);
    return is_wide(box, whole) ? sample_apart(source, group, whole, scratch, to)
                               : sample_run(source, group, 0, whole, box, scratch, to);
}

/* Blocks go along curves in the source, which processors do not foresee. Of eight pixels in a row one will do, of four where
 * they are large, which has its last row of taps asked for. */
void cm_source_fetch(const cm_source *source, const cm_group *group)
{
    cm_window window;
    if (source->filter == CM_FILTER_EWA)
    {
        cm_ewa_fetch(&source->ewa, group);
        return;
    }
    if (!group->is_bounded || !source->level.is_plain)
    {
        return;
    }
    cm_level_own(&source->level, group->plane, group->column, group->row + source->taps / 2,
                 &window);
    const char *data = window.data;
    const ptrdiff_t size = (ptrdiff_t)source->level.pixel_size;
    const unsigned step = size > 4 ? 4 : 8;
    for (unsigned i = step / 2; i < group->count; i += step)
    {
        CM_FETCH(data + (int32_t)group->y[i] * window.row_stride + (int32_t)group->x[i] * size);
    }
}

/* The places of a whole block of one group whose rows can go where they are to be at once, and what they need. 0 if that
 * cannot be. */
static int find_places(const cm_source *source, const cm_group *group,
                       const cm_block_target *target, cm_fixed_places *at)
{
    cm_window window;
    if (source->find_places == NULL || target->first == NULL || target->is_past ||
        group->count != CM_BLOCK_PIXELS || !is_there(source, group))
    {
        return 0;
    }
    cm_level_own(&source->level, group->plane, group->column, group->row, &window);
    source->find_places(&window, CM_BLOCK_PIXELS, group->x, group->y, at);
    const char *below = (const char *)window.data + window.row_stride;
    for (unsigned i = 0; i < CM_BLOCK_PIXELS; i += FETCH_STEP)
    {
        CM_FETCH(below + at->offset[i]);
    }
    return 1;
}

static unsigned place_block(const resample_job *job, resample_desk *desk, unsigned plane,
                            uint32_t block_column, uint32_t block_row)
{
    const unsigned side = block_column % 2;
    cm_group *groups = desk->groups[side];
    desk->targets[side] = cm_target_block(&job->target, &desk->row, block_column * CM_BLOCK_EDGE);
    const unsigned count =
        cm_geometry_block(desk->geometry, plane, block_column, block_row, groups);
    desk->has_places[side] = count == 1 && find_places(job->target.source, groups,
                                                       &desk->targets[side], &desk->places[side]);
    for (unsigned i = 0; i < count && !desk->has_places[side]; i++)
    {
        cm_source_fetch(job->target.source, &groups[i]);
    }
    return count;
}

/* A block whose places have been found. */
static void sample_in_place(const cm_source *source, const cm_group *group,
                            const cm_fixed_places *at, const cm_block_target *target)
{
    cm_window window;
    cm_level_own(&source->level, group->plane, group->column, group->row, &window);
    source->apart(&window, CM_BLOCK_PIXELS, at, target->first, target->down);
}

static cm_status fill_block(const resample_job *job, resample_desk *desk, unsigned plane,
                            uint32_t block_column, uint32_t block_row, unsigned count)
{
    cm_group *groups = desk->groups[block_column % 2];
    const cm_block_target *target = &desk->targets[block_column % 2];
    cm_status status = CM_OK;
    unsigned pixels = 0;
    cm_target_fetch(target, job->target.source->level.pixel_size * CM_BLOCK_EDGE);
    if (desk->has_places[block_column % 2])
    {
        sample_in_place(job->target.source, groups, &desk->places[block_column % 2], target);
        pixels = CM_BLOCK_PIXELS;
        count = 0;
    }
    for (unsigned i = 0; i < count && status == CM_OK; i++)
    {
        status = cm_source_sample(job->target.source, &groups[i], &desk->scratch, desk->pixels);
        if (status == CM_OK)
        {
            cm_target_store(&job->target, plane, block_column, block_row, &groups[i], target,
                            desk->pixels);
        }
        pixels += groups[i].count;
    }
    if (pixels < CM_BLOCK_PIXELS)
    {
        cm_target_clear(&job->target, plane, block_column, block_row, groups, count);
    }
    cm_target_finish(&job->target, &desk->row, target, count <= 1 && pixels == CM_BLOCK_PIXELS);
    return status;
}

static cm_status do_block_row(const resample_job *job, resample_desk *desk, unsigned plane,
                              uint32_t block_row)
{
    const cm_rows *wanted = &job->target.wanted;
    const uint32_t first = wanted->first_column / CM_BLOCK_EDGE;
    const uint32_t last = (wanted->first_column + wanted->column_count - 1) / CM_BLOCK_EDGE;
    cm_status status = CM_OK;
    desk->row = cm_target_row(&job->target, plane, block_row * CM_BLOCK_EDGE, desk->bundle);
    unsigned count = place_block(job, desk, plane, first, block_row);
    for (uint32_t column = first; column <= last && status == CM_OK; column++)
    {
        const unsigned next =
            column < last ? place_block(job, desk, plane, column + 1, block_row) : 0;
        status = fill_block(job, desk, plane, column, block_row, count);
        cm_large_touched(job->target.plan->options.memory, BLOCK_TOUCHES);
        count = next;
    }
    return status;
}

static uint32_t block_rows_before(const cm_rows *wanted)
{
    return wanted->first_row / CM_BLOCK_EDGE;
}

static uint32_t block_rows_of(const cm_rows *wanted)
{
    return (wanted->first_row + wanted->row_count - 1) / CM_BLOCK_EDGE + 1 -
           block_rows_before(wanted);
}

/* NULL if there is no memory. */
static resample_desk *make_desk(const cm_target *target)
{
    const size_t pixels = CM_BLOCK_PIXELS * target->source->level.pixel_size + CM_WINDOW_SLACK;
    void *memory;
    resample_desk *desk = cm_zeros_in_lines(sizeof *desk + CM_LINE + pixels, &memory);
    if (desk == NULL)
    {
        return NULL;
    }
    desk->memory = memory;
    desk->pixels = cm_next_line(desk + 1);
    desk->geometry = cm_geometry_create(target->plan, target->source->filter == CM_FILTER_EWA);
    if (desk->geometry == NULL)
    {
        free(memory);
        return NULL;
    }
    return desk;
}

static int take_rows(resample_job *job, size_t *at, size_t *beyond)
{
    *at = atomic_fetch_add(&job->next, ROWS_TAKEN);
    *beyond = *at + ROWS_TAKEN < job->rows ? *at + ROWS_TAKEN : job->rows;
    return *at < *beyond;
}

/* Rows of blocks, of all wanted planes in a row. Threads take some in turn: faces with a pole take longer than others. */
static void do_rows(size_t begin, size_t end, void *user)
{
    resample_job *job = user;
    resample_desk *desk = make_desk(&job->target);
    cm_status status = desk == NULL ? CM_ERROR_MEMORY : CM_OK;
    const size_t rows = block_rows_of(&job->target.wanted);
    size_t at = 0, beyond = 0;
    (void)begin;
    (void)end;
    while (status == CM_OK && (at < beyond || take_rows(job, &at, &beyond)))
    {
        status = do_block_row(job, desk, job->target.wanted.plane + (unsigned)(at / rows),
                              block_rows_before(&job->target.wanted) + (uint32_t)(at % rows));
        at++;
    }
    cm_finish_past_caches();
    if (status != CM_OK)
    {
        atomic_store(&job->failed, (int)status);
    }
    if (desk != NULL)
    {
        cm_geometry_destroy(desk->geometry);
        free(desk->scratch.bytes);
        free(desk->memory);
    }
}

/* ---- what is asked ---- */

/* Zeros stand for all of it. Returns how many planes are wanted, 0 if the surface does not have the rows. */
static uint32_t complete(const cm_surface *to, cm_rows *rows)
{
    uint32_t planes = 1;
    if (rows->row_count == 0)
    {
        planes = to->planes;
        *rows = (cm_rows){.row_count = to->height, .column_count = to->width};
    }
    rows->column_count =
        rows->column_count == 0 ? to->width - rows->first_column : rows->column_count;
    const int good = rows->plane < to->planes && rows->first_row < to->height &&
                     rows->row_count <= to->height - rows->first_row &&
                     rows->first_column < to->width &&
                     rows->column_count <= to->width - rows->first_column;
    return good ? planes : 0;
}

cm_status cm_resample_source(const cm_plan *plan, const cm_source *source, cm_image *to,
                             cm_rows rows, unsigned threads)
{
    if (plan == NULL || source == NULL || to == NULL || source->plan != plan)
    {
        return CM_ERROR_ARGUMENT;
    }
    resample_job job = {.target = {.plan = plan, .source = source, .to = to, .wanted = rows}};
    cm_status status = cm_pictures_check(plan->to, to);
    if (status != CM_OK)
    {
        return status;
    }
    job.target.values = cm_values_of(plan, to);
    job.target.values.working = source->values.working;
    const uint32_t planes = complete(plan->to, &job.target.wanted);
    if (planes == 0 || to->channels != source->values.channels || to->type != source->target_type)
    {
        return CM_ERROR_RANGE;
    }
    if (atomic_load(&source->state) != CM_SOURCE_READY)
    {
        int is_done = 0;
        status = rows.row_count == 0 ? cm_resample_stripes(&job.target, threads, &is_done) : CM_OK;
        if (status != CM_OK || is_done)
        {
            return status;
        }
        status = cm_source_complete(source, threads);
        if (status != CM_OK)
        {
            return status;
        }
    }
    atomic_init(&job.failed, CM_OK);
    atomic_init(&job.next, 0);
    job.rows = (size_t)planes * block_rows_of(&job.target.wanted);
    cm_run_threads(threads, job.rows * ROW_WEIGHT, ROWS_TAKEN * ROW_WEIGHT, do_rows, &job);
    return (cm_status)atomic_load(&job.failed);
}

cm_status cm_resample(const cm_plan *plan, const cm_image *from, cm_image *to, cm_rows rows)
{
    cm_source *source;
    if (to == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    cm_status status = cm_source_create(plan, from, to->type, 1, &source);
    if (status == CM_OK)
    {
        status = cm_resample_source(plan, source, to, rows, 1);
        cm_source_destroy(source);
    }
    return status;
}
