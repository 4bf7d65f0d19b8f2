/* SPDX-License-Identifier: MIT
 *
 * Levels by a sinc in a Kaiser window, whose edge is at the new level's highest frequency: J. F. Kaiser, Nonrecursive
 * digital filter design using the I0-sinh window function, IEEE Symposium on Circuits and Systems, 1974. It reaches three
 * new pixels each way, its stop band is 50 dB down; sizes that are odd have weights for each pixel.
 */
#include "pyramid.h"
#include "filter_set.h"

#include <cubemap/threads.h>

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846

/* New pixels each way, and the window's parameter: 0.5842 (A - 21)^0.4 + 0.07886 (A - 21) for A = 50 dB. */
#define RADIUS 3.0
#define WINDOW 4.533514

/* The modified Bessel function of order 0, by its series. */
static double bessel_i0(double x)
{
    double sum = 1.0;
    double term = 1.0;
    for (int k = 1; k < 40; k++)
    {
        term *= 0.25 * x * x / ((double)k * k);
        sum += term;
    }
    return sum;
}

static double low_pass(double x)
{
    const double inside = 1.0 - x * x / (RADIUS * RADIUS);
    const double sinc = x == 0.0 ? 1.0 : sin(PI * x) / (PI * x);
    return inside > 0.0 ? sinc * bessel_i0(WINDOW * sqrt(inside)) : 0.0;
}

uint32_t cm_half_size(uint32_t size)
{
    return size / 2 + size % 2;
}

unsigned cm_level_count(uint32_t width, uint32_t height)
{
    unsigned count = 1;
    for (; width > 1 || height > 1; count++)
    {
        width = cm_half_size(width);
        height = cm_half_size(height);
    }
    return count;
}

/* Where each new pixel's taps begin, and their weights. NULL if there is no memory. */
static cm_half_taps *make_taps(uint32_t from, uint32_t to)
{
    cm_half_taps *taps = malloc(to * sizeof *taps);
    const double ratio = (double)from / to;
    for (uint32_t i = 0; taps != NULL && i < to; i++)
    {
        const double centre = (i + 0.5) * ratio - 0.5;
        double weight[CM_HALF_TAPS];
        double sum = 0.0;
        taps[i].first = (int32_t)floor(centre) - (CM_HALF_TAPS / 2 - 1);
        if (i > 0 && from == 2 * to)
        {
            /* all are as far from their centres */
            memcpy(taps[i].weight, taps[0].weight, sizeof taps[i].weight);
            continue;
        }
        for (int k = 0; k < CM_HALF_TAPS; k++)
        {
            weight[k] = low_pass((taps[i].first + k - centre) / ratio);
            sum += weight[k];
        }
        for (int k = 0; k < CM_HALF_TAPS; k++)
        {
            taps[i].weight[k] = (float)(weight[k] / sum);
        }
    }
    return taps;
}

/* New columns that are made at once, so that the rows that they are made of stay in a cache of their own. */
#define STRIP 1024

/* The rows of a strip that are kept: a power of 2. */
#define KEPT 16

/* From pictures, or from the level above. */
typedef struct halve_job
{
    const cm_level_reader *pictures;
    const cm_padded *above;
    const cm_padded *to;
    const cm_filter_set *set;
    cm_half_taps *columns;
    cm_half_taps *rows;
    int is_even;      /* is the width half the one above? */
    int is_even_down; /* and the height? */
    uint32_t lines;   /* of a row above: channels that are apart */
    uint32_t pixel;   /* floats from a column of a line to the next */
    atomic_int failed;
} halve_job;

/* Columns of a strip, of new ones and of those above. */
typedef struct strip
{
    uint32_t first;
    uint32_t count;
    int32_t first_above;
    size_t length;
} strip;

static strip strip_at(const halve_job *job, uint32_t first)
{
    strip at = {.first = first, .count = job->to->width - first};
    at.count = at.count < STRIP ? at.count : STRIP;
    at.first_above = job->columns[first].first - 1;
    at.length = (size_t)(job->columns[first + at.count - 1].first + CM_HALF_TAPS - at.first_above +
                         job->is_even);
    return at;
}

/* A row of the level above as floats: of pictures all channels, of whole numbers one. */
static void read_row(const halve_job *job, size_t plane, uint32_t line, const strip *at,
                     int32_t row, float *to)
{
    const cm_padded *above = job->above;
    if (above == NULL)
    {
        cm_level_read(job->pictures, (unsigned)plane, at->first_above, row, (int32_t)at->length,
                      to);
        return;
    }
    job->set->from_whole(at->length,
                         above->whole[plane] + row * above->row + line * above->channel +
                             at->first_above,
                         CM_PADDED_ONE, to);
}

/* The rows that a new one is made of, or two of them, of a line. What is read is read once, up to row `end` by now, and kept
 * from row to row. */
static void find_rows(const halve_job *job, size_t plane, uint32_t line, const strip *at,
                      int32_t first, int32_t count, int32_t end, float *kept, const float **rows)
{
    const size_t floats = at->length * job->pixel;
    for (int32_t k = 0; k < count; k++)
    {
        const int32_t row = first + k;
        if (job->above != NULL && job->above->first[plane] != NULL)
        {
            rows[k] = job->above->first[plane] + row * job->above->row +
                      line * job->above->channel + at->first_above;
            continue;
        }
        float *own = kept + ((size_t)line * KEPT + (uint32_t)row % KEPT) * floats;
        if (row >= end)
        {
            read_row(job, plane, line, at, row, own);
        }
        rows[k] = own;
    }
}

/* Memory of a thread. */
typedef struct halve_desk
{
    float *kept;
    float *mixed[2]; /* rows, pixel by pixel */
    float *lines;    /* one of them, channel by channel */
    float *parts;
    float *halved;
} halve_desk;

/* A row that has been mixed, of `pixel` channels from a line on. */
static void store_row(const halve_job *job, size_t plane, const strip *at, uint32_t row,
                      uint32_t line, const halve_desk *desk, const float *mixed)
{
    const cm_padded *to = job->to;
    const float *lines = mixed;
    if (job->pixel > 1)
    {
        job->set->part_channels(mixed, job->pixel, at->length, desk->lines, (ptrdiff_t)at->length);
        lines = desk->lines;
    }
    for (uint32_t c = 0; c < job->pixel; c++)
    {
        const ptrdiff_t first =
            (ptrdiff_t)row * to->row + (line + c) * to->channel + (ptrdiff_t)at->first;
        float *halved = to->first[plane] != NULL ? to->first[plane] + first : desk->halved;
        job->set->halve_row(lines + c * at->length, at->length, job->columns + at->first,
                            job->is_even, at->count, desk->parts, halved);
        if (to->first[plane] == NULL)
        {
            job->set->to_whole(at->count, halved, CM_PADDED_ONE, to->whole[plane] + first);
        }
    }
}

/* New rows of a strip of a plane. */
static void do_strip(const halve_job *job, size_t plane, const strip *at, uint32_t begin,
                     uint32_t end, const halve_desk *desk)
{
    const size_t floats = at->length * job->pixel;
    const float *rows[CM_HALF_TAPS + 2];
    int32_t read = INT32_MIN;
    uint32_t count;
    for (uint32_t row = begin; row < end; row += count)
    {
        const cm_half_taps *taps = &job->rows[row];
        count = job->is_even_down && row + 1 < end ? 2 : 1;
        for (uint32_t line = 0; line < job->lines; line++)
        {
            find_rows(job, plane, line, at, taps->first, CM_HALF_TAPS + 2 * (int32_t)(count - 1),
                      read, desk->kept, rows);
            if (count == 2)
            {
                job->set->mix_two_rows(rows, taps->weight, floats, desk->mixed[0], desk->mixed[1]);
                store_row(job, plane, at, row + 1, line, desk, desk->mixed[1]);
            }
            else
            {
                job->set->mix_rows(rows, taps->weight, floats, desk->mixed[0]);
            }
            store_row(job, plane, at, row, line, desk, desk->mixed[0]);
        }
        read = taps->first + CM_HALF_TAPS + 2 * (int32_t)(count - 1);
    }
}

/* Rows of the new level, of all planes. */
static void do_rows(size_t begin, size_t end, void *user)
{
    halve_job *job = user;
    const cm_padded *to = job->to;
    const size_t length = 2 * (STRIP + CM_HALF_TAPS);
    const size_t floats = length * job->pixel;
    const size_t kept = KEPT * floats * job->lines;
    float *memory = malloc((kept + 3 * floats + length + 2 + STRIP) * sizeof(float));
    if (memory == NULL)
    {
        atomic_store(&job->failed, CM_ERROR_MEMORY);
        return;
    }
    const halve_desk desk = {memory,
                             {memory + kept, memory + kept + floats},
                             memory + kept + 2 * floats,
                             memory + kept + 3 * floats,
                             memory + kept + 3 * floats + length + 2};
    while (begin < end)
    {
        const size_t plane = begin / to->height;
        const size_t next = (plane + 1) * to->height < end ? (plane + 1) * to->height : end;
        for (uint32_t first = 0; first < to->width; first += STRIP)
        {
            const strip at = strip_at(job, first);
            do_strip(job, plane, &at, (uint32_t)(begin - plane * to->height),
                     (uint32_t)(next - plane * to->height), &desk);
        }
        begin = next;
    }
    free(memory);
}

/* A level from the pictures, or from the one above, which has that size. */
static cm_status halve(const cm_level_reader *pictures, const cm_padded *above, uint32_t width,
                       uint32_t height, const cm_padded *to, const cm_filter_set *set,
                       unsigned threads)
{
    halve_job job = {.pictures = pictures, .above = above, .to = to, .set = set};
    job.columns = make_taps(width, to->width);
    job.rows = make_taps(height, to->height);
    job.is_even = width == 2 * to->width;
    job.is_even_down = height == 2 * to->height;
    job.lines = above != NULL ? to->channels : 1;
    job.pixel = above != NULL ? 1 : to->channels;
    atomic_init(&job.failed, job.columns == NULL || job.rows == NULL ? CM_ERROR_MEMORY : CM_OK);
    if (atomic_load(&job.failed) == CM_OK)
    {
        cm_run_threads(threads, (size_t)to->planes * to->height, 64, do_rows, &job);
    }
    free(job.columns);
    free(job.rows);
    return (cm_status)atomic_load(&job.failed);
}

static cm_status make_level(const cm_surface *surface, uint32_t width, uint32_t height,
                            uint32_t channels, int is_whole, const cm_memory *memory,
                            unsigned threads, cm_padded *level)
{
    const int32_t beside = surface->period != 0.0 ? CM_PYRAMID_BESIDE : CM_PYRAMID_BORDER;
    if (is_whole)
    {
        return cm_padded_create_whole(surface, width, height, channels, beside, CM_PYRAMID_BORDER,
                                      memory, threads, level);
    }
    return cm_padded_create(surface, width, height, channels, beside, CM_PYRAMID_BORDER,
                            CM_PADDED_CHANNELS, memory, threads, level);
}

cm_status cm_pyramid_make(const cm_surface *surface, const cm_image *pictures,
                          const cm_values *values, const cm_sample_set *set, unsigned count,
                          int32_t border, int is_whole, const cm_memory *memory, unsigned threads,
                          cm_pyramid *pyramid)
{
    const cm_filter_set *loops = cm_filter_set_find(set->name);
    const uint32_t least = surface->width < surface->height ? surface->width : surface->height;
    const int32_t wanted = surface->has_gaps          ? CM_BESIDE_MAP
                           : border > CM_BORDER_LEAST ? border
                                                      : CM_BORDER_LEAST;
    memset(pyramid, 0, sizeof *pyramid);
    cm_status status =
        cm_level_of_pictures(surface, pictures, values, 0, cm_border_of(surface, least, wanted),
                             threads, &pyramid->pictures);
    if (status != CM_OK)
    {
        return status;
    }
    pyramid->reader = cm_level_reader_of(&pyramid->pictures, surface, set);
    pyramid->is_whole = is_whole;
    pyramid->count = 1;
    uint32_t width = surface->width, height = surface->height;
    while (status == CM_OK && pyramid->count < count)
    {
        const cm_padded *above = pyramid->count > 1 ? &pyramid->level[pyramid->count - 1] : NULL;
        cm_padded *level = &pyramid->level[pyramid->count++];
        status = make_level(surface, cm_half_size(width), cm_half_size(height), values->working,
                            is_whole, memory, threads, level);
        status = status == CM_OK
                     ? halve(&pyramid->reader, above, width, height, level, loops, threads)
                     : status;
        if (status == CM_OK)
        {
            cm_padded_border(level, surface, threads);
        }
        width = cm_half_size(width);
        height = cm_half_size(height);
    }
    if (status != CM_OK)
    {
        cm_pyramid_free(pyramid);
    }
    return status;
}

void cm_pyramid_free(cm_pyramid *pyramid)
{
    for (unsigned i = 1; i < pyramid->count; i++)
    {
        cm_padded_free(&pyramid->level[i]);
    }
    cm_level_free(&pyramid->pictures);
    pyramid->count = 0;
}
