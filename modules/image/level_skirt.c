/* SPDX-License-Identifier: MIT
 *
 * What is beyond the edges of a level's planes: values between the pixels of neighbours, by six points each way where there
 * are so many.
 */
#include "fetch.h"
#include "large_memory.h"
#include "level_between.h"
#include "level_rim.h"

#include <cubemap/threads.h>

#include <string.h>

#define BLOCK 64

/* Pixels of a plane's skirt that are filled at once. */
typedef struct skirt_run
{
    const cm_level *level;
    const cm_surface *surface;
    const cm_filter_set *set;
    unsigned plane;
    unsigned count;
    int32_t column[BLOCK];
    int32_t row[BLOCK];
} skirt_run;

/* Neighbours' pixels go along a column as often as along a row, which processors do not foresee. Above and below they are
 * asked for by other pixels of the run. */
static void fetch_pixel(const cm_level *level, uint8_t plane, double x, double y)
{
    if (plane != CM_NO_FACE)
    {
        const cm_level_plane *from = &level->plane[plane];
        CM_FETCH(from->pixels + (int32_t)y * from->row_stride + (int32_t)x * from->pixel_stride);
    }
}

/* ---- many at once ---- */

/* May places be done many at once, of bytes or floats as they are stored? */
static int are_many(const skirt_run *run)
{
    const cm_level *level = run->level;
    const int are_plain = level->values->type == CM_PIXEL_U8
                              ? level->is_plain || cm_values_are_stored(level->values)
                              : level->is_plain;
    return are_plain && !run->surface->creased && level->width >= CM_LEVEL_POINTS &&
           level->height >= CM_LEVEL_POINTS && level->channels <= CM_SIX_CHANNELS;
}

/* The values of places that lie on planes, one after the other, rows as far apart; those that have six pixels there. */
static void sum_many(const skirt_run *run, const uint8_t *found, const cm_six_points *across,
                     const cm_six_points *along, const void **from, float *sum)
{
    const cm_level *level = run->level;
    const ptrdiff_t row = level->plane[run->plane].row_stride;
    const int are_bytes = level->values->type == CM_PIXEL_U8;
    const void *some = NULL;
    for (unsigned i = 0; i < run->count; i++)
    {
        /* of floats what weighs nothing may be NaN */
        const int is_one = found[i] == CM_NO_FACE || level->plane[found[i]].row_stride != row ||
                           (!are_bytes && (across->exact[i] || along->exact[i]));
        from[i] =
            is_one ? NULL : cm_level_six_at(level, found[i], across->first[i], along->first[i]);
        some = from[i] != NULL ? from[i] : some;
    }
    if (some == NULL)
    {
        return;
    }
    const void *all[BLOCK];
    for (unsigned i = 0; i < run->count; i++)
    {
        all[i] = from[i] != NULL ? from[i] : some;
    }
    if (are_bytes)
    {
        run->set->six_bytes(level->channels, run->count, all, row,
                            level->is_bytes ? 1.0f : 1.0f / 255.0f, across, along, sum);
        return;
    }
    run->set->six_floats(level->channels, run->count, all, row, 1.0f, across, along, sum);
}

/* The pixels of a run from their places. */
static void put_places(skirt_run *run, const uint8_t *found, const double *x, const double *y)
{
    const cm_level *level = run->level;
    const int many = are_many(run);
    const int is_cautious = level->values->type == CM_PIXEL_U8;
    const void *from[BLOCK] = {0};
    float sum[CM_SIX_CHANNELS * BLOCK];
    cm_six_points across, along;
    if (many)
    {
        run->set->six_points(run->count, x, level->width, is_cautious, &across);
        run->set->six_points(run->count, y, level->height, is_cautious, &along);
        sum_many(run, found, &across, &along, from, sum);
    }
    for (unsigned i = 0; i < run->count; i++)
    {
        unsigned char *to = cm_level_skirt_pixel(level, run->plane, run->column[i], run->row[i]);
        if (found[i] == CM_NO_FACE)
        {
            cm_level_continue_edge(level, run->plane, run->column[i], run->row[i], to);
        }
        else if (many && from[i] != NULL)
        {
            cm_level_put(level, sum + CM_SIX_CHANNELS * i, to);
        }
        else
        {
            cm_level_between(level, run->surface->creased, found[i], x[i], y[i], to);
        }
    }
}

/* The pixels of a run from their directions, which become places. */
static void put_run(skirt_run *run, double *x, double *y, double *z)
{
    uint8_t found[BLOCK];
    const unsigned count = run->count;
    cm_surface_find(run->surface, count, x, y, z, found, x, y);
    for (unsigned i = 0; i < count; i++)
    {
        x[i] = found[i] != CM_NO_FACE ? x[i] : 0.0;
        y[i] = found[i] != CM_NO_FACE ? y[i] : 0.0;
        fetch_pixel(run->level, found[i], x[i], y[i]);
    }
    put_places(run, found, x, y);
    run->count = 0;
}

static void fill_run(skirt_run *run)
{
    double columns[BLOCK] = {0}, rows[BLOCK] = {0}, x[BLOCK], y[BLOCK], z[BLOCK];
    const unsigned count = run->count;
    for (unsigned i = 0; run->level->gaps != NULL && i < count; i++)
    {
        cm_gaps_values(run->level, run->level->gaps, run->surface, run->plane, 1, &run->column[i],
                       run->row[i],
                       cm_level_skirt_pixel(run->level, run->plane, run->column[i], run->row[i]));
    }
    if (run->level->gaps != NULL)
    {
        run->count = 0;
        return;
    }
    for (unsigned i = 0; i < count; i++)
    {
        columns[i] = run->column[i] + 0.5;
        rows[i] = run->row[i] + 0.5;
    }
    cm_surface_directions_beyond(run->surface, run->plane, count, columns, rows, x, y, z);
    put_run(run, x, y, z);
}

static void add_pixel(skirt_run *run, int32_t column, int32_t row)
{
    run->column[run->count] = column;
    run->row[run->count++] = row;
    if (run->count == BLOCK)
    {
        fill_run(run);
    }
}

/* Both ends of a line of pixels across a plane, which share what directions come from. */
static void add_line(skirt_run *run, int is_column, int32_t at)
{
    const int32_t reach = run->level->reach;
    const int32_t extent = (int32_t)(is_column ? run->level->height : run->level->width);
    for (int32_t end = 0; end < 2; end++)
    {
        const int32_t first = end == 0 ? -reach : extent;
        for (int32_t i = first; i < first + reach; i++)
        {
            add_pixel(run, is_column ? at : i, is_column ? i : at);
        }
    }
}

/* Pixels beyond one edge, which go along it. 0 if they are no such that share their polynomials. */
static int fill_edge(skirt_run *run, cm_edge edge, int32_t begin, int32_t count)
{
    const cm_level *level = run->level;
    const int is_row = edge == CM_EDGE_UPPER || edge == CM_EDGE_LOWER;
    const int is_low = edge == CM_EDGE_LEFT || edge == CM_EDGE_UPPER;
    const int32_t last = (int32_t)(is_row ? level->height : level->width);
    double x[BLOCK], y[BLOCK], z[BLOCK];
    cm_edge_run nodes;
    if (!cm_surface_edge_nodes(run->surface, run->plane, edge, begin, (size_t)count, &nodes))
    {
        return 0;
    }
    for (int32_t k = 0; k < level->reach; k++)
    {
        const int32_t across = is_low ? -1 - k : last + k;
        for (int32_t i = 0; i < count; i++)
        {
            run->column[i] = is_row ? begin + i : across;
            run->row[i] = is_row ? across : begin + i;
        }
        run->count = (unsigned)count;
        cm_surface_edge_directions(&nodes, run->set, k, x, y, z);
        put_run(run, x, y, z);
    }
    return 1;
}

typedef struct skirt_job
{
    const cm_level *level;
    const cm_surface *surface;
    const cm_filter_set *set;
    const cm_memory *memory;
} skirt_job;

/* Elements of cm_run_threads for a block of lines. */
#define TASK 64

/* Blocks of a plane's rows, of its columns, and those beyond its columns, which have the corners. */
static size_t row_blocks(const cm_level *level)
{
    return (level->height + (size_t)BLOCK - 1) / BLOCK;
}

static size_t blocks_of(const cm_level *level)
{
    return row_blocks(level) + (level->width + (size_t)BLOCK - 1) / BLOCK + 2;
}

/* Both ends of lines that cross a plane. */
static void fill_block(skirt_run *run, int is_column, int32_t begin, int32_t count)
{
    const cm_level *level = run->level;
    const int32_t extent = (int32_t)(is_column ? level->width : level->height);
    const int is_inside = begin >= 0 && begin + count <= extent && level->gaps == NULL;
    if (is_inside && fill_edge(run, is_column ? CM_EDGE_UPPER : CM_EDGE_LEFT, begin, count) &&
        fill_edge(run, is_column ? CM_EDGE_LOWER : CM_EDGE_RIGHT, begin, count))
    {
        return;
    }
    for (int32_t i = begin; i < begin + count; i++)
    {
        add_line(run, is_column, i);
    }
    if (run->count > 0)
    {
        fill_run(run);
    }
}

/* Which lines a block has. */
static void fill_lines(skirt_run *run, size_t block)
{
    const cm_level *level = run->level;
    const size_t rows = row_blocks(level), corners = blocks_of(level) - 2;
    const int is_column = block >= rows;
    const int32_t extent = (int32_t)(is_column ? level->width : level->height);
    if (block >= corners)
    {
        fill_block(run, 1, block == corners ? -level->reach : extent, level->reach);
        return;
    }
    const int32_t begin = (int32_t)(is_column ? block - rows : block) * BLOCK;
    fill_block(run, is_column, begin, cm_level_least(extent - begin, BLOCK));
}

static void fill_blocks(size_t begin, size_t end, void *user)
{
    const skirt_job *job = user;
    const size_t per_plane = blocks_of(job->level);
    skirt_run run = {.level = job->level, .surface = job->surface, .set = job->set};
    for (size_t at = begin / TASK; at < end / TASK; at++)
    {
        run.plane = (unsigned)(at / per_plane);
        fill_lines(&run, at % per_plane);
        cm_large_touched(job->memory, 2 * BLOCK * CM_TOUCHED_AROUND);
    }
}

/* ---- what is beyond the edges of maps that go round ---- */

static int32_t at_turn(int32_t column, int32_t width)
{
    return (column % width + width) % width;
}

/* Pixels of a row from a column on, which come again, into the skirt. */
static void fill_from_row(const cm_level *level, int32_t column, int32_t row, int32_t count,
                          int32_t from_column, int32_t from_row)
{
    const int32_t width = (int32_t)level->width;
    while (count > 0)
    {
        const int32_t from = at_turn(from_column, width);
        const int32_t n = cm_level_least(count, width - from);
        cm_level_load(level, 0, from, from_row, n, cm_level_skirt_pixel(level, 0, column, row));
        column += n;
        from_column += n;
        count -= n;
    }
}

/* A skirt of pixels of the plane itself, if all are. */
static int fill_copies(const cm_level *level, const cm_surface *surface, const cm_memory *memory)
{
    const double pixel[2] = {1.0, 1.0};
    const int32_t reach = level->reach;
    const int32_t width = (int32_t)level->width;
    const int32_t height = (int32_t)level->height;
    int32_t further, same;
    if (surface->period != (double)level->width || level->gaps != NULL)
    {
        return 0;
    }
    for (int32_t k = 0; k < 2 * reach; k++)
    {
        const int32_t row = k < reach ? -1 - k : height + k - reach;
        if (!cm_surface_same_row(surface, pixel, row, &further, &same))
        {
            return 0;
        }
        fill_from_row(level, -reach, row, width + 2 * reach, further - reach, same);
    }
    for (int32_t row = 0; row < height; row++)
    {
        fill_from_row(level, -reach, row, reach, -reach, row);
        fill_from_row(level, width, row, reach, 0, row);
        cm_large_touched(memory, 2 * CM_TOUCHED_AROUND);
    }
    return 1;
}

void cm_level_fill_skirt(const cm_level *level, const cm_surface *surface, const cm_memory *memory,
                         unsigned threads)
{
    if (!fill_copies(level, surface, memory))
    {
        skirt_job job = {level, surface, cm_filter_set_find(level->set->name), memory};
        cm_run_threads(threads, level->planes * blocks_of(level) * TASK, 2 * TASK, fill_blocks,
                       &job);
    }
}
