/* SPDX-License-Identifier: MIT
 *
 * Planes of floats with memory of their own, from pictures.
 */
#include "padded.h"
#include "level_rim.h"
#include "large_memory.h"

#include <cubemap/threads.h>

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

/* ---- memory ---- */

static int32_t smaller(int32_t a, int32_t b)
{
    return a < b ? a : b;
}

/* What a plane of faces can have. */
static int32_t border_of(const cm_surface *surface, uint32_t extent, int32_t wanted)
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
        float *row = padded->memory + at * (size_t)padded->row;
        const int is_inside = at % high >= (size_t)padded->beyond &&
                              at % high < (size_t)padded->beyond + padded->height;
        for (size_t k = 0; k < lines; k++, row += line)
        {
            const size_t kept = is_inside ? before + inside : 0;
            memset(row, 0, (is_inside ? before : 0) * sizeof(float));
            memset(row + kept, 0, (line - kept) * sizeof(float));
        }
    }
}

static void clear_frame(const cm_padded *padded, unsigned threads)
{
    const size_t high = padded->height + 2 * (size_t)padded->beyond;
    cm_run_threads(threads, padded->planes * high, 64, clear_rows, (void *)(uintptr_t)padded);
}

static size_t rounded(size_t floats)
{
    return (floats + 15) / 16 * 16;
}

cm_status cm_padded_create(const cm_surface *surface, uint32_t width, uint32_t height,
                           uint32_t channels, int32_t beside, int32_t beyond, cm_padded_order order,
                           const cm_memory *memory, unsigned threads, cm_padded *padded)
{
    const size_t slack = CM_WINDOW_SLACK / sizeof(float);
    memset(padded, 0, sizeof *padded);
    padded->planes = surface->planes;
    padded->width = width;
    padded->height = height;
    padded->channels = channels;
    padded->beside = border_of(surface, width < height ? width : height, beside);
    padded->beyond = border_of(surface, width < height ? width : height, beyond);
    const size_t wide = width + 2 * (size_t)padded->beside;
    const size_t high = height + 2 * (size_t)padded->beyond;
    const size_t line = rounded(order == CM_PADDED_PIXELS ? wide * channels + slack : wide + slack);
    padded->pixel = order == CM_PADDED_PIXELS ? (ptrdiff_t)channels : 1;
    padded->channel = order == CM_PADDED_PIXELS ? 1 : (ptrdiff_t)line;
    padded->row = (ptrdiff_t)(order == CM_PADDED_PIXELS ? line : line * channels);
    padded->plane_floats = (size_t)padded->row * high;
    padded->owner = memory;
    padded->memory =
        cm_large_allocate(memory, padded->plane_floats * padded->planes * sizeof(float));
    if (padded->memory == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    for (unsigned plane = 0; plane < padded->planes; plane++)
    {
        padded->first[plane] = padded->memory + plane * padded->plane_floats +
                               padded->beyond * padded->row + padded->beside * padded->pixel;
    }
    clear_frame(padded, threads);
    return CM_OK;
}

void cm_padded_free(cm_padded *padded)
{
    cm_large_free(padded->owner, padded->memory,
                  padded->plane_floats * padded->planes * sizeof(float));
    memset(padded, 0, sizeof *padded);
}

/* ---- from pictures ---- */

/* Pixels of a row that are converted at once. */
#define RUN 1024

/* Pixels beside a map with gaps that have what the sphere has there: as far as a spline's coefficients see it. */
#define BESIDE_MAP 20

typedef struct load_job
{
    const cm_padded *padded;
    const cm_level *level; /* of the pictures */
    const cm_values *values;
    cm_converter *convert; /* NULL: values have a meaning of their own */
    float scale;
    int32_t beside; /* columns and rows of the border that the level has */
    int32_t beyond;
    atomic_int failed;
} load_job;

/* What makes floats of numbers that are mixed as they are stored; NULL for floats, and for what is more than that. */
static cm_converter *converter_of(const cm_values *values, const cm_sample_set *set, float *scale)
{
    const int is_whole = values->type == CM_PIXEL_U8 || values->type == CM_PIXEL_U16;
    *scale = values->type == CM_PIXEL_U8    ? 1.0f / 255.0f
             : values->type == CM_PIXEL_U16 ? 1.0f / 65535.0f
                                            : 1.0f;
    if (values->transfer != CM_TRANSFER_STORED ||
        (values->alpha != 0 && !values->alpha_multiplied) ||
        (!is_whole && values->not_finite != CM_NOT_FINITE_SPREAD))
    {
        return NULL;
    }
    return values->type == CM_PIXEL_U8     ? set->u8_to_float
           : values->type == CM_PIXEL_U16  ? set->u16_to_float
           : values->type == CM_PIXEL_HALF ? set->half_to_float
                                           : NULL;
}

/* Pixels from (column, row) on to dense floats. */
static cm_status load_run(const load_job *job, unsigned plane, int32_t column, int32_t row,
                          uint32_t count, cm_scratch *scratch, float *to)
{
    const cm_level_plane *from = &job->level->plane[plane];
    const size_t dense = job->values->channels * cm_pixel_size(job->values->type);
    if (job->convert != NULL && from->pixel_stride == (ptrdiff_t)dense)
    {
        const unsigned char *pixel = from->pixels + (ptrdiff_t)row * from->row_stride +
                                     (ptrdiff_t)column * from->pixel_stride;
        job->convert((size_t)count * job->values->channels, pixel, job->scale, to);
        return CM_OK;
    }
    cm_window window;
    const cm_status status =
        cm_level_window(job->level, plane, column, row, (int32_t)count, 1, scratch, &window);
    if (status == CM_OK)
    {
        memcpy(to, window.data, (size_t)count * job->level->pixel_size);
    }
    return status;
}

/* From pixel by pixel to channel by channel. */
static void part_channels(const cm_padded *padded, const float *from, uint32_t count, float *to)
{
    const uint32_t channels = padded->channels;
    for (uint32_t c = 0; c < channels; c++)
    {
        float *restrict line = to + c * padded->channel;
        const float *restrict value = from + c;
        for (uint32_t i = 0; i < count; i++)
        {
            line[i] = value[(size_t)i * channels];
        }
    }
}

/* Rows of the planes one after the other, with those of the border where the level has them. */
static cm_status load_row(const load_job *job, size_t at, cm_scratch *scratch, float *run)
{
    const cm_padded *padded = job->padded;
    const size_t rows = padded->height + 2 * (size_t)job->beyond;
    const unsigned plane = (unsigned)(at / rows);
    const int32_t row = (int32_t)(at % rows) - job->beyond;
    const int32_t end = (int32_t)padded->width + job->beside;
    float *line = padded->first[plane] + (ptrdiff_t)row * padded->row;
    const int is_direct = padded->channel == 1;
    cm_status status = CM_OK;
    for (int32_t column = -job->beside; column < end && status == CM_OK; column += RUN)
    {
        const uint32_t count = (uint32_t)smaller(end - column, RUN);
        float *to = line + (ptrdiff_t)column * padded->pixel;
        status = load_run(job, plane, column, row, count, scratch, is_direct ? to : run);
        if (!is_direct && status == CM_OK)
        {
            part_channels(padded, run, count, to);
        }
    }
    return status;
}

static void load_rows(size_t begin, size_t end, void *user)
{
    load_job *job = user;
    cm_scratch scratch = {0};
    float *run = malloc(RUN * job->padded->channels * sizeof(float) + CM_WINDOW_SLACK);
    cm_status status = run == NULL ? CM_ERROR_MEMORY : CM_OK;
    for (size_t at = begin; at < end && status == CM_OK; at++)
    {
        status = load_row(job, at, &scratch, run);
    }
    if (status != CM_OK)
    {
        atomic_store(&job->failed, (int)status);
    }
    free(run);
    free(scratch.bytes);
}

cm_status cm_padded_load(cm_padded *padded, const cm_surface *surface, const cm_image *pictures,
                         const cm_values *values, const cm_sample_set *set, unsigned threads)
{
    cm_level level;
    const int32_t reach = surface->has_gaps ? BESIDE_MAP : 0;
    cm_status status = cm_level_of_pictures(surface, pictures, values, 0, reach, threads, &level);
    if (status != CM_OK)
    {
        return status;
    }
    load_job job = {.padded = padded, .level = &level, .values = values};
    job.beside = smaller(reach, padded->beside);
    job.beyond = smaller(reach, padded->beyond);
    job.convert = level.gaps == NULL ? converter_of(values, set, &job.scale) : NULL;
    atomic_init(&job.failed, CM_OK);
    cm_run_threads(threads, (size_t)padded->planes * (padded->height + 2 * (size_t)job.beyond), 64,
                   load_rows, &job);
    status = (cm_status)atomic_load(&job.failed);
    cm_level_free(&level);
    padded->goes_on = cm_rim_goes_on(values);
    if (status == CM_OK && !surface->has_gaps)
    {
        cm_padded_border(padded, surface, threads);
    }
    return status;
}
