/* SPDX-License-Identifier: MIT */
#include "modules/memory/checked_size.h"
#include "level_rim.h"

#include <cubemap/threads.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define BLOCK 64

/* Points of a polynomial each way, at most. */
#define POINTS CM_LEVEL_POINTS

/* A footprint may stand on a place of the map whose pixel's centre is off it. */
#define MORE_REACH 1

/* ---- bits ---- */

/* No filter reaches farther than the bits of a word. */
static int32_t reach_of(const cm_level *level)
{
    return level->reach + MORE_REACH < 63 ? level->reach + MORE_REACH : 63;
}

static const uint64_t *row_of(const cm_level *level, const cm_gaps *gaps, unsigned plane,
                              int32_t row)
{
    return gaps->on_map + ((size_t)plane * level->height + (size_t)row) * gaps->words;
}

int cm_gaps_have(const cm_level *level, const cm_gaps *gaps, unsigned plane, int32_t column,
                 int32_t row)
{
    if (column < 0 || row < 0 || column >= (int32_t)level->width || row >= (int32_t)level->height)
    {
        return 0;
    }
    return row_of(level, gaps, plane, row)[column / 64] >> (column % 64) & 1u;
}

typedef struct gap_job
{
    const cm_level *level;
    const cm_surface *surface;
    cm_gaps *gaps;
} gap_job;

static void mark_rows(size_t begin, size_t end, void *user)
{
    const gap_job *job = user;
    const int32_t width = (int32_t)job->level->width;
    double columns[BLOCK] = {0}, rows[BLOCK] = {0};
    uint8_t covered[BLOCK] = {0};
    for (size_t at = begin; at < end; at++)
    {
        const unsigned plane = (unsigned)(at / job->level->height);
        uint64_t *bits = job->gaps->on_map + at * job->gaps->words;
        for (int32_t first = 0; first < width; first += BLOCK)
        {
            const int32_t count = width - first < BLOCK ? width - first : BLOCK;
            uint64_t word = 0;
            for (int32_t i = 0; i < count; i++)
            {
                columns[i] = first + i + 0.5;
                rows[i] = (double)(at % job->level->height) + 0.5;
            }
            cm_surface_covers(job->surface, plane, (size_t)count, columns, rows, covered);
            for (int32_t i = 0; i < count; i++)
            {
                word |= (uint64_t)covered[i] << i;
            }
            bits[first / BLOCK] = word;
        }
    }
}

/* What is on the map in any of the rows around one, as far as filters reach: 64 columns. */
static uint64_t gather(const gap_job *job, size_t at, size_t word)
{
    const cm_level *level = job->level;
    const unsigned plane = (unsigned)(at / level->height);
    const int32_t row = (int32_t)(at % level->height);
    const int32_t reach = reach_of(level);
    uint64_t bits = 0;
    for (int32_t i = row - reach; i <= row + reach && word < job->gaps->words; i++)
    {
        if (i >= 0 && i < (int32_t)level->height)
        {
            bits |= row_of(level, job->gaps, plane, i)[word];
        }
    }
    return bits;
}

/* Which of 64 columns of a row are off the map, but near it. */
static uint64_t gaps_of(const gap_job *job, size_t at, size_t word)
{
    const uint32_t after = job->level->width - (uint32_t)word * 64;
    const uint64_t off = ~job->gaps->on_map[at * job->gaps->words + word] &
                         (after < 64 ? ((uint64_t)1 << after) - 1 : UINT64_MAX);
    if (off == 0)
    {
        return 0;
    }
    const uint64_t here = gather(job, at, word);
    const uint64_t left = word == 0 ? 0 : gather(job, at, word - 1);
    const uint64_t right = gather(job, at, word + 1);
    uint64_t near = here;
    for (int32_t k = 1; k <= reach_of(job->level); k++)
    {
        near |= here << k | left >> (64 - k) | here >> k | right << (64 - k);
    }
    return near & off;
}

/* ---- values ---- */

/* Are these pixels on the map? */
static int are_on_map(const cm_level *level, const cm_gaps *gaps, unsigned plane, int32_t left,
                      int32_t top, int32_t points)
{
    for (int32_t j = 0; j < points; j++)
    {
        for (int32_t i = 0; i < points; i++)
        {
            if (!cm_gaps_have(level, gaps, plane, left + i, top + j))
            {
                return 0;
            }
        }
    }
    return 1;
}

/* How much a polynomial through pixels 0 to points - 1 may magnify errors at a place: the sum of its weights' magnitudes. */
static double magnification(double place, int32_t points)
{
    double sum = 0.0;
    for (int32_t i = 0; i < points; i++)
    {
        double weight = 1.0;
        for (int32_t k = 0; k < points; k++)
        {
            weight *= k == i ? 1.0 : (place - k) / ((double)i - k);
        }
        sum += fabs(weight);
    }
    return sum;
}

/* What is rounded is not to be magnified: a polynomial of degree five is 63 times its error a pixel beyond its last one. */
static double magnification_most(const cm_level *level)
{
    switch (level->values->type)
    {
    case CM_PIXEL_U8:
        return 3.0;
    case CM_PIXEL_U16:
    case CM_PIXEL_HALF:
        return 30.0;
    default:
        return 200.0;
    }
}

/* The pixels on the map that are the best to have a value at a place from: many, and around it, or not far. */
static int32_t choose_points(const cm_level *level, const cm_gaps *gaps, unsigned plane, double x,
                             double y, int32_t *left, int32_t *top)
{
    for (int32_t points = POINTS; points > 0; points -= points > 2 ? 2 : 1)
    {
        const int32_t column = (int32_t)floor(x - 0.5 * (points - 1));
        const int32_t row = (int32_t)floor(y - 0.5 * (points - 1));
        for (int32_t away = 0; away <= points; away++)
        {
            for (int32_t down = -away; down <= away; down++)
            {
                const int32_t right = away - (down < 0 ? -down : down);
                for (int32_t side = -1; side <= 1; side += 2)
                {
                    *left = column + side * right;
                    *top = row + down;
                    if (are_on_map(level, gaps, plane, *left, *top, points) &&
                        magnification(x - 0.5 - *left, points) *
                                magnification(y - 0.5 - *top, points) <=
                            magnification_most(level))
                    {
                        return points;
                    }
                }
            }
        }
    }
    return 0;
}

/* The pixel on the map that is nearest to one off it; 0 if there is none in reach. */
static int find_nearest(const cm_level *level, const cm_gaps *gaps, unsigned plane, int32_t column,
                        int32_t row, int32_t *found_column, int32_t *found_row)
{
    const int32_t reach = reach_of(level);
    int32_t best = INT32_MAX;
    for (int32_t j = -reach; j <= reach; j++)
    {
        for (int32_t i = -reach; i <= reach; i++)
        {
            if (i * i + j * j < best && cm_gaps_have(level, gaps, plane, column + i, row + j))
            {
                best = i * i + j * j;
                *found_column = column + i;
                *found_row = row + j;
            }
        }
    }
    return best != INT32_MAX;
}

/* From the map around it alone: continued, or that of the nearest pixel. */
static void fill_alone(const cm_level *level, const cm_gaps *gaps, unsigned plane,
                       const cm_rim_places *at, size_t i, unsigned char *to)
{
    if (!cm_level_continue_rim(level, gaps, plane, (int32_t)floor(at->column[i]),
                               (int32_t)floor(at->row[i]), reach_of(level), to))
    {
        cm_level_load(level, plane, (int32_t)at->inner_column[i], (int32_t)at->inner_row[i], 1, to);
    }
}

/* Up to BLOCK pixels, that all have one on the map near. */
static void fill_near(const cm_level *level, const cm_gaps *gaps, const cm_surface *surface,
                      unsigned plane, size_t n, const cm_rim_places *at, unsigned char *const *to)
{
    double x[BLOCK], y[BLOCK], z[BLOCK];
    uint8_t found[BLOCK];
    cm_surface_continue(surface, plane, n, at, x, y, z);
    cm_surface_find(surface, n, x, y, z, found, x, y);
    for (size_t i = 0; i < n; i++)
    {
        int32_t left, top;
        const int32_t points = found[i] == CM_NO_FACE
                                   ? 0
                                   : choose_points(level, gaps, found[i], x[i], y[i], &left, &top);
        if (points == 0)
        {
            fill_alone(level, gaps, plane, at, i, to[i]);
            continue;
        }
        cm_level_mix(level, found[i], left, top, x[i], y[i], (unsigned)points, to[i]);
    }
}

void cm_gaps_values(const cm_level *level, const cm_gaps *gaps, const cm_surface *surface,
                    unsigned plane, size_t n, const int32_t *column, int32_t row, unsigned char *to)
{
    double places[4][BLOCK];
    const cm_rim_places at = {places[0], places[1], places[2], places[3]};
    unsigned char *pixels[BLOCK];
    for (size_t done = 0; done < n; done += BLOCK)
    {
        const size_t end = n - done < BLOCK ? n : done + BLOCK;
        size_t count = 0;
        for (size_t i = done; i < end; i++)
        {
            int32_t inner_column, inner_row;
            pixels[count] = to + i * level->pixel_size;
            if (!find_nearest(level, gaps, plane, column[i], row, &inner_column, &inner_row))
            {
                memset(pixels[count], 0, level->pixel_size);
                continue;
            }
            places[0][count] = inner_column + 0.5;
            places[1][count] = inner_row + 0.5;
            places[2][count] = column[i] + 0.5;
            places[3][count++] = row + 0.5;
        }
        fill_near(level, gaps, surface, plane, count, &at, pixels);
    }
}

/* ---- life ---- */

/* Counts the pixels of rows that are to be filled. */
static void count_rows(size_t begin, size_t end, void *user)
{
    const gap_job *job = user;
    for (size_t at = begin; at < end; at++)
    {
        size_t count = 0;
        for (size_t word = 0; word < job->gaps->words; word++)
        {
            for (uint64_t bits = gaps_of(job, at, word); bits != 0; bits &= bits - 1)
            {
                count++;
            }
        }
        job->gaps->first[at + 1] = count;
    }
}

static void fill_rows(size_t begin, size_t end, void *user)
{
    const gap_job *job = user;
    const cm_level *level = job->level;
    cm_gaps *gaps = job->gaps;
    for (size_t at = begin; at < end; at++)
    {
        int32_t *column = gaps->column + gaps->first[at];
        for (size_t word = 0; word < gaps->words; word++)
        {
            const uint64_t bits = gaps_of(job, at, word);
            for (int32_t i = 0; i < 64 && bits >> i != 0; i++)
            {
                *column = (int32_t)word * 64 + i;
                column += bits >> i & 1u;
            }
        }
        cm_gaps_values(level, gaps, job->surface, (unsigned)(at / level->height),
                       gaps->first[at + 1] - gaps->first[at], gaps->column + gaps->first[at],
                       (int32_t)(at % level->height),
                       gaps->pixels + gaps->first[at] * level->pixel_size);
    }
}

static cm_status allocate_values(const cm_level *level, cm_gaps *gaps, size_t rows)
{
    for (size_t at = 0; at < rows; at++)
    {
        gaps->first[at + 1] += gaps->first[at];
    }
    /* one more, as an empty list needs memory, too, and a column is written before it counts */
    gaps->column = cm_array_of(gaps->first[rows] + 1, sizeof *gaps->column);
    gaps->pixels = cm_array_of(gaps->first[rows] + 1, level->pixel_size);
    return gaps->column == NULL || gaps->pixels == NULL ? CM_ERROR_MEMORY : CM_OK;
}

cm_status cm_gaps_create(const cm_level *level, const cm_surface *surface, unsigned threads,
                         cm_gaps **gaps)
{
    const size_t rows = (size_t)level->planes * level->height;
    cm_gaps *made = calloc(1, sizeof *made);
    if (made == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    made->words = (level->width + 63) / 64;
    made->on_map = cm_array_of(rows, cm_size_product(made->words, sizeof *made->on_map));
    made->first = calloc(rows + 1, sizeof *made->first);
    gap_job job = {level, surface, made};
    cm_status status = made->on_map == NULL || made->first == NULL ? CM_ERROR_MEMORY : CM_OK;
    if (status == CM_OK)
    {
        cm_run_threads(threads, rows, 64, mark_rows, &job);
        cm_run_threads(threads, rows, 64, count_rows, &job);
        status = allocate_values(level, made, rows);
    }
    if (status != CM_OK)
    {
        cm_gaps_free(made);
        return status;
    }
    cm_run_threads(threads, rows, 64, fill_rows, &job);
    *gaps = made;
    return CM_OK;
}

void cm_gaps_free(cm_gaps *gaps)
{
    if (gaps != NULL)
    {
        free(gaps->on_map);
        free(gaps->first);
        free(gaps->column);
        free(gaps->pixels);
        free(gaps);
    }
}

/* ---- windows ---- */

/* The first filled pixel of a row from a column on. */
static size_t find_filled(const cm_level *level, unsigned plane, int32_t row, int32_t column,
                          size_t *end)
{
    const cm_gaps *gaps = level->gaps;
    const size_t at = (size_t)plane * level->height + (size_t)row;
    size_t low = gaps->first[at];
    size_t high = gaps->first[at + 1];
    *end = high;
    while (low < high)
    {
        const size_t middle = low + (high - low) / 2;
        const int is_before = gaps->column[middle] < column;
        low = is_before ? middle + 1 : low;
        high = is_before ? high : middle;
    }
    return low;
}

/* Are all of count pixels of a row on the map? */
static int is_run_on_map(const cm_level *level, unsigned plane, int32_t column, int32_t row,
                         int32_t count)
{
    for (int32_t i = 0; i < count; i++)
    {
        if (!cm_gaps_have(level, level->gaps, plane, column + i, row))
        {
            return 0;
        }
    }
    return 1;
}

int cm_gaps_touch(const cm_level *level, unsigned plane, int32_t column, int32_t row, int32_t width,
                  int32_t height)
{
    for (int32_t i = row; i < row + height; i++)
    {
        if (!is_run_on_map(level, plane, column, i, width))
        {
            return 1;
        }
    }
    return 0;
}

void cm_gaps_put(const cm_level *level, unsigned plane, int32_t column, int32_t row, int32_t count,
                 unsigned char *to)
{
    const cm_gaps *gaps = level->gaps;
    size_t end;
    for (int32_t i = 0; i < count; i++)
    {
        if (!cm_gaps_have(level, gaps, plane, column + i, row))
        {
            memset(to + (size_t)i * level->pixel_size, 0, level->pixel_size);
        }
    }
    for (size_t at = find_filled(level, plane, row, column, &end);
         at < end && gaps->column[at] < column + count; at++)
    {
        memcpy(to + (size_t)(gaps->column[at] - column) * level->pixel_size,
               gaps->pixels + at * level->pixel_size, level->pixel_size);
    }
}
