/* SPDX-License-Identifier: MIT */
#include "modules/memory/checked_size.h"
#include "compare_tile.h"
#include "compare_sum.h"

#include <cubemap/threads.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum
{
    THREAD_STEP = 64 /* cm_run_threads cuts at multiples of that */
};

/* A value and its place. */
typedef struct extreme
{
    double value;
    uint32_t column;
    uint32_t row;
} extreme;

/* What a tile has. */
typedef struct tile_sums
{
    double weight;
    extreme lowest;
    extreme highest;
    uint32_t pixels;
    uint32_t not_finite;
    int has_failed;
} tile_sums;

typedef struct tile_job
{
    const cm_compare_task *task;
    uint32_t across; /* tiles */
    size_t tiles;
    tile_sums *sums;
    double *value_sums; /* task->values of each tile */
} tile_job;

void cm_compare_filter(size_t count, const double *from, ptrdiff_t step, size_t radius,
                       const double *k, double sign, double *to)
{
    for (size_t i = 0; i < count; i++)
    {
        to[i] = k[0] * from[i];
    }
    for (size_t j = 1; j <= radius; j++)
    {
        const double *const after = from + (ptrdiff_t)j * step;
        const double *const before = from - (ptrdiff_t)j * step;
        const double weight = k[j];
        for (size_t i = 0; i < count; i++)
        {
            to[i] += weight * (after[i] + sign * before[i]);
        }
    }
}

void cm_compare_load(const cm_image *image, const cm_compare_tile *tile, size_t radius,
                     uint32_t channel, int outside, double *to)
{
    const int64_t reach = (int64_t)radius;
    const int64_t width = tile->width + 2 * reach;
    const int64_t left = tile->column - reach;
    const int64_t first = left < 0 ? 0 : left;
    const int64_t last = left + width > image->width ? image->width : left + width;
    for (int64_t y = 0; y < tile->height + 2 * reach; y++, to += width)
    {
        int64_t row = tile->row - reach + y;
        if (!outside && (row < 0 || row >= image->height))
        {
            memset(to, 0, (size_t)width * sizeof *to);
            continue;
        }
        row = row < 0 ? 0 : row >= image->height ? image->height - 1 : row;
        double *const inside = to + (first - left);
        const int64_t count = last - first;
        cm_compare_read(image, (uint64_t)row, (uint32_t)first, (size_t)count, channel, inside);
        for (int64_t i = 0; i < count; i++)
        {
            inside[i] = isfinite(inside[i]) ? inside[i] : (double)NAN;
        }
        for (int64_t x = 0; x < first - left; x++)
        {
            to[x] = outside ? inside[0] : 0.0;
        }
        for (int64_t x = last - left; x < width; x++)
        {
            to[x] = outside ? inside[count - 1] : 0.0;
        }
    }
}

/* ---- one tile ---- */

static int is_inside(const cm_compare_task *task, uint32_t column, uint32_t row)
{
    const uint64_t border = task->options->border;
    return column >= border && row >= border && column + border < task->pair->picture.width &&
           row + border < task->pair->picture.height;
}

static int is_before(const extreme *one, const extreme *other)
{
    return one->row < other->row || (one->row == other->row && one->column < other->column);
}

/* The better of two by sign, which is 1 for the highest, -1 for the lowest; of equals the first place. */
static void find_extreme(extreme *best, const extreme *next, double sign)
{
    const double better = sign * (next->value - best->value);
    if (isnan(best->value) || better > 0.0 || (better == 0.0 && is_before(next, best)))
    {
        *best = *next;
    }
}

/* Counts the pixels of a row of a tile; value becomes the mean of each pixel, or NaN where it does not count. */
static void count_row(const tile_job *job, const cm_compare_tile *tile, uint32_t y, tile_sums *sums,
                      double *value_sums, double *value)
{
    const cm_compare_task *const task = job->task;
    double weight[CM_TILE];
    cm_compare_read_weights(task->pair, tile->row + y, tile->column, tile->width, weight);
    for (uint32_t x = 0; x < tile->width; x++)
    {
        double sum = 0.0;
        for (size_t k = 0; k < task->values; k++)
        {
            sum += value[k * CM_TILE_PIXELS + x];
        }
        const int counts = weight[x] > 0.0 && is_inside(task, tile->column + x, tile->row + y);
        sums->not_finite += (uint32_t)(counts && isnan(sum));
        if (!counts || isnan(sum))
        {
            value[x] = (double)NAN;
            continue;
        }
        for (size_t k = 0; k < task->values; k++)
        {
            value_sums[k] += weight[x] * value[k * CM_TILE_PIXELS + x];
        }
        value[x] = sum / (double)task->values;
        const extreme here = {value[x], tile->column + x, tile->row + y};
        find_extreme(&sums->lowest, &here, -1.0);
        find_extreme(&sums->highest, &here, 1.0);
        sums->weight += weight[x];
        sums->pixels++;
    }
}

static void measure_tile(const tile_job *job, size_t index, double *value, double *work)
{
    const cm_compare_task *const task = job->task;
    const cm_image *const picture = &task->pair->picture;
    cm_compare_tile tile = {(uint32_t)(index % job->across * CM_TILE),
                            (uint32_t)(index / job->across * CM_TILE), CM_TILE, CM_TILE};
    tile.width = picture->width - tile.column < CM_TILE ? picture->width - tile.column : CM_TILE;
    tile.height = picture->height - tile.row < CM_TILE ? picture->height - tile.row : CM_TILE;
    tile_sums sums = {.lowest = {.value = (double)NAN}, .highest = {.value = (double)NAN}};
    double *const value_sums = job->value_sums + index * task->values;
    memset(value_sums, 0, task->values * sizeof *value_sums);
    task->call(task->measure, task->pair, &tile, work, value);
    for (uint32_t y = 0; y < tile.height; y++)
    {
        double *const row = value + (size_t)y * tile.width;
        count_row(job, &tile, y, &sums, value_sums, row);
        if (task->map != NULL)
        {
            cm_compare_write(task->map, tile.row + y, tile.column, tile.width, 0, row);
        }
    }
    job->sums[index] = sums;
}

static void measure_tiles(size_t begin, size_t end, void *user)
{
    const tile_job *const job = user;
    const size_t values = job->task->values * (size_t)CM_TILE_PIXELS;
    double *const value = cm_array_of(values + job->task->work, sizeof *value);
    for (size_t i = begin / THREAD_STEP; i < end / THREAD_STEP; i++)
    {
        if (value != NULL)
        {
            measure_tile(job, i, value, value + values);
        }
        else
        {
            job->sums[i].has_failed = 1;
        }
    }
    free(value);
}

/* ---- all tiles ---- */

static cm_status add_tiles(const tile_job *job, cm_map_figures *figures, double *means)
{
    const cm_compare_task *const task = job->task;
    cm_compare_sum weight = {0.0, 0.0};
    cm_map_figures found = {.size = sizeof found};
    extreme lowest = {.value = (double)NAN};
    extreme highest = lowest;
    double mean = 0.0;
    for (size_t i = 0; i < job->tiles; i++)
    {
        const tile_sums *const tile = &job->sums[i];
        if (tile->has_failed)
        {
            return CM_ERROR_MEMORY;
        }
        cm_compare_sum_add(&weight, tile->weight);
        found.pixels += tile->pixels;
        found.not_finite += tile->not_finite;
        if (tile->pixels > 0)
        {
            find_extreme(&lowest, &tile->lowest, -1.0);
            find_extreme(&highest, &tile->highest, 1.0);
        }
    }
    if (found.not_finite > 0 && task->options->not_finite == CM_COMPARE_REFUSE)
    {
        return CM_ERROR_RANGE;
    }
    found.weight = cm_compare_sum_value(&weight);
    for (size_t k = 0; k < task->values; k++)
    {
        cm_compare_sum sum = {0.0, 0.0};
        for (size_t i = 0; i < job->tiles; i++)
        {
            cm_compare_sum_add(&sum, job->value_sums[i * task->values + k]);
        }
        const double of_value =
            cm_compare_sum_value(&sum) / found.weight; /* 0 / 0 is NaN, as said */
        mean += of_value / (double)task->values;
        if (means != NULL)
        {
            means[k] = of_value;
        }
    }
    found.mean = mean;
    found.lowest = lowest.value;
    found.lowest_column = lowest.column;
    found.lowest_row = lowest.row;
    found.highest = highest.value;
    found.highest_column = highest.column;
    found.highest_row = highest.row;
    if (figures != NULL)
    {
        *figures = found;
    }
    return CM_OK;
}

cm_status cm_compare_tiles(const cm_compare_task *task, cm_map_figures *figures, double *means)
{
    const cm_image *const picture = &task->pair->picture;
    const uint32_t across = (uint32_t)(((uint64_t)picture->width + CM_TILE - 1) / CM_TILE);
    const size_t down = (size_t)(((uint64_t)picture->height + CM_TILE - 1) / CM_TILE);
    const size_t tiles = across * down;
    tile_job job = {task, across, tiles, calloc(tiles, sizeof *job.sums),
                    calloc(tiles * task->values, sizeof *job.value_sums)};
    cm_status status = CM_ERROR_MEMORY;
    if (job.sums != NULL && job.value_sums != NULL)
    {
        cm_run_threads(task->options->threads, tiles * THREAD_STEP, THREAD_STEP, measure_tiles,
                       &job);
        status = add_tiles(&job, figures, means);
    }
    free(job.sums);
    free(job.value_sums);
    return status;
}
