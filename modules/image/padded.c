/* SPDX-License-Identifier: MIT
 *
 * Planes of floats with memory of their own, from pictures.
 */
#include "modules/memory/checked_size.h"
#include "padded.h"
#include "filter_set.h"
#include "large_memory.h"
#include "level_rim.h"

#include <cubemap/threads.h>

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

/* ---- memory ---- */

static int32_t smaller(int32_t a, int32_t b)
{
    return a < b ? a : b;
}

int32_t cm_border_of(const cm_surface *surface, uint32_t extent, int32_t wanted)
{
    if (surface->methods->can_go_beyond)
    {
        return wanted;
    }
    const int32_t most = extent / 2 > (uint32_t)wanted ? wanted : (int32_t)(extent / 2);
    return smaller(wanted, most < CM_BORDER_LEAST ? CM_BORDER_LEAST : most);
}

/* Zeros in what is no pixel: the border's own are written later, what is behind rows never. */
static void clear_rows(size_t begin, size_t end, void *user)
{
    const cm_padded *padded = user;
    const size_t high = padded->height + 2 * (size_t)padded->beyond;
    const size_t lines = (size_t)(padded->channel == 1 ? 1 : padded->channels);
    const size_t line = (size_t)padded->row / lines;
    const size_t before = (size_t)(padded->beside * padded->pixel);
    const size_t inside = padded->width * (size_t)padded->pixel;
    for (size_t at = begin; at < end; at++)
    {
        const size_t size = padded->whole[0] != NULL ? sizeof(int16_t) : sizeof(float);
        unsigned char *row = (unsigned char *)padded->memory + at * (size_t)padded->row * size;
        const int is_inside = at % high >= (size_t)padded->beyond &&
                              at % high < (size_t)padded->beyond + padded->height;
        for (size_t k = 0; k < lines; k++, row += line * size)
        {
            const size_t kept = is_inside ? before + inside : 0;
            memset(row, 0, (is_inside ? before : 0) * size);
            memset(row + kept * size, 0, (line - kept) * size);
        }
        cm_large_touched(padded->owner, CM_TOUCHED_AROUND);
    }
}

static void clear_frame(const cm_padded *padded, unsigned threads)
{
    const size_t high = padded->height + 2 * (size_t)padded->beyond;
    cm_run_threads(threads, padded->planes * high, 64, clear_rows, (void *)(uintptr_t)padded);
}

static size_t rounded(size_t floats)
{
    return cm_size_sum(floats, 15) / 16 * 16;
}

static size_t bytes_of(const cm_padded *padded)
{
    const size_t number = padded->is_whole ? sizeof(int16_t) : sizeof(float);
    return cm_size_product(padded->plane_floats, padded->planes * number);
}

void cm_padded_shape(const cm_surface *surface, uint32_t width, uint32_t height, uint32_t channels,
                     int32_t beside, int32_t beyond, cm_padded_order order, cm_padded *shape)
{
    const size_t slack = CM_WINDOW_SLACK / sizeof(float);
    memset(shape, 0, sizeof *shape);
    shape->planes = surface->planes;
    shape->width = width;
    shape->height = height;
    shape->channels = channels;
    shape->beside = cm_border_of(surface, width < height ? width : height, beside);
    shape->beyond = cm_border_of(surface, width < height ? width : height, beyond);
    const size_t wide = width + 2 * (size_t)shape->beside;
    const size_t high = height + 2 * (size_t)shape->beyond;
    const size_t row = order == CM_PADDED_PIXELS ? cm_size_product(wide, channels) : wide;
    const size_t line = rounded(cm_size_sum(row, slack));
    shape->pixel = order == CM_PADDED_PIXELS ? (ptrdiff_t)channels : 1;
    shape->channel = order == CM_PADDED_PIXELS ? 1 : (ptrdiff_t)line;
    shape->row = (ptrdiff_t)(order == CM_PADDED_PIXELS ? line : cm_size_product(line, channels));
    shape->plane_floats = cm_size_product((size_t)shape->row, high);
}

cm_status cm_padded_allocate(int is_whole, const cm_memory *memory, unsigned threads,
                             cm_padded *shape)
{
    shape->is_whole = is_whole;
    shape->owner = memory;
    shape->memory = cm_large_allocate(memory, bytes_of(shape));
    if (shape->memory == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    for (unsigned plane = 0; plane < shape->planes; plane++)
    {
        const size_t first = plane * shape->plane_floats +
                             (size_t)(shape->beyond * shape->row + shape->beside * shape->pixel);
        shape->first[plane] = is_whole ? NULL : shape->memory + first;
        shape->whole[plane] = is_whole ? (int16_t *)(void *)shape->memory + first : NULL;
    }
    clear_frame(shape, threads);
    return CM_OK;
}

cm_status cm_padded_create(const cm_surface *surface, uint32_t width, uint32_t height,
                           uint32_t channels, int32_t beside, int32_t beyond, cm_padded_order order,
                           const cm_memory *memory, unsigned threads, cm_padded *padded)
{
    cm_padded_shape(surface, width, height, channels, beside, beyond, order, padded);
    return cm_padded_allocate(0, memory, threads, padded);
}

void cm_padded_release(cm_padded *padded)
{
    cm_large_free(padded->owner, padded->memory, bytes_of(padded));
    padded->memory = NULL;
}

void cm_padded_free(cm_padded *padded)
{
    cm_padded_release(padded);
    memset(padded, 0, sizeof *padded);
}

/* ---- from pictures ---- */

/* Pixels of a row that are converted at once. */
#define RUN 1024

typedef struct load_job
{
    const cm_padded *padded;
    const cm_filter_set *loops;
    cm_level_reader reader; /* of the pictures */
    int32_t beside;         /* columns and rows of the border that the level has */
    int32_t beyond;
    float most; /* of numbers; INFINITY: nobody asks */
    atomic_int has_more;
    atomic_int failed;
} load_job;

/* Is a number larger, or none? */
static int are_more(const float *restrict from, size_t n, float most)
{
    int found = 0;
    for (size_t i = 0; i < n; i++)
    {
        found |= !(fabsf(from[i]) <= most);
    }
    return found;
}

/* Rows of the planes one after the other, with those of the border where the level has them. Are numbers larger than
 * what was asked for? */
static int load_row(const load_job *job, size_t at, float *run)
{
    const cm_padded *padded = job->padded;
    const size_t rows = padded->height + 2 * (size_t)job->beyond;
    const unsigned plane = (unsigned)(at / rows);
    const int32_t row = (int32_t)(at % rows) - job->beyond;
    const int32_t end = (int32_t)padded->width + job->beside;
    float *line = padded->first[plane] + (ptrdiff_t)row * padded->row;
    const int is_direct = padded->channel == 1;
    int has_more = 0;
    for (int32_t column = -job->beside; column < end; column += RUN)
    {
        const int32_t count = smaller(end - column, RUN);
        float *to = line + (ptrdiff_t)column * padded->pixel;
        float *read = is_direct ? to : run;
        cm_level_read(&job->reader, plane, column, row, count, read);
        has_more |=
            job->most < INFINITY && are_more(read, (size_t)count * padded->channels, job->most);
        if (!is_direct)
        {
            job->loops->part_channels(run, padded->channels, (size_t)count, to, padded->channel);
        }
    }
    return has_more;
}

static void load_rows(size_t begin, size_t end, void *user)
{
    load_job *job = user;
    int has_more = 0;
    const size_t floats = cm_size_product(RUN, job->padded->channels);
    float *run = cm_array_of(cm_size_sum(floats, CM_WINDOW_SLACK / sizeof *run), sizeof *run);
    if (run == NULL)
    {
        atomic_store(&job->failed, CM_ERROR_MEMORY);
        return;
    }
    for (size_t at = begin; at < end; at++)
    {
        has_more |= load_row(job, at, run);
        cm_large_touched(job->padded->owner, (size_t)job->padded->row * sizeof(float));
    }
    if (has_more)
    {
        atomic_store(&job->has_more, 1);
    }
    free(run);
}

cm_status cm_padded_load(cm_padded *padded, const cm_surface *surface, const cm_image *pictures,
                         const cm_values *values, const cm_sample_set *set, unsigned threads,
                         float most, int *has_more)
{
    cm_level level;
    const int32_t reach = surface->has_gaps ? CM_BESIDE_MAP : 0;
    cm_status status = cm_level_of_pictures(surface, pictures, values, set, 0, reach, padded->owner,
                                            threads, &level);
    if (status != CM_OK)
    {
        return status;
    }
    load_job job = {.padded = padded,
                    .loops = cm_filter_set_find(set->name),
                    .reader = cm_level_reader_of(&level, surface, set),
                    .most = has_more != NULL ? most : INFINITY};
    job.beside = smaller(reach, padded->beside);
    job.beyond = smaller(reach, padded->beyond);
    atomic_init(&job.failed, CM_OK);
    atomic_init(&job.has_more, 0);
    cm_run_threads(threads, (size_t)padded->planes * (padded->height + 2 * (size_t)job.beyond), 64,
                   load_rows, &job);
    status = (cm_status)atomic_load(&job.failed);
    if (has_more != NULL)
    {
        *has_more = atomic_load(&job.has_more);
    }
    cm_level_free(&level);
    padded->goes_on = cm_rim_goes_on(values);
    if (status == CM_OK && !surface->has_gaps)
    {
        cm_padded_border(padded, surface, job.loops, threads);
    }
    return status;
}
