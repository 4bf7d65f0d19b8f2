/* SPDX-License-Identifier: MIT
 *
 * Levels by a sinc in a Kaiser window, whose edge is at the new level's highest frequency: J. F. Kaiser, Nonrecursive
 * digital filter design using the I0-sinh window function, IEEE Symposium on Circuits and Systems, 1974. It reaches three
 * new pixels each way, its stop band is 50 dB down; sizes that are odd have weights for each pixel.
 */
#include "pyramid.h"
#include "filter_set.h"
#include "large_memory.h"
#include "wait_a_while.h"

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

/* Rounded up. */
static uint32_t half_of(uint32_t size)
{
    return size / 2 + size % 2;
}

static uint32_t eighths_of(uint32_t size)
{
    return size - (uint32_t)(5 * (uint64_t)size / 8);
}

/* Smaller planes have no borders that wide taps could use. */
#define EIGHTHS_LEAST 96

static int has_eighths(cm_pyramid_steps steps, uint32_t width, uint32_t height)
{
    return steps == CM_PYRAMID_EIGHTHS && width >= EIGHTHS_LEAST && height >= EIGHTHS_LEAST;
}

unsigned cm_pyramid_sizes(cm_pyramid_steps steps, uint32_t width, uint32_t height,
                          cm_level_size sizes[CM_LEVELS_MAX])
{
    unsigned count = 1;
    sizes[0] = (cm_level_size){width, height};
    if (has_eighths(steps, width, height))
    {
        sizes[count++] = (cm_level_size){eighths_of(width), eighths_of(height)};
    }
    while (sizes[count - 1].width > 1 || sizes[count - 1].height > 1)
    {
        const cm_level_size *last = &sizes[count - 1];
        sizes[count++] = (cm_level_size){half_of(last->width), half_of(last->height)};
    }
    return count;
}

/* Whole weights whose sum is exact: the largest takes what rounding left. */
static void round_taps(cm_half_taps *taps)
{
    int left = CM_HALF_ONE;
    int largest = 0;
    for (int k = 0; k < CM_TAPS_MOST; k++)
    {
        taps->whole[k] = (int16_t)lrintf(taps->weight[k] * CM_HALF_ONE);
        left -= taps->whole[k];
        largest = taps->weight[k] > taps->weight[largest] ? k : largest;
    }
    taps->whole[largest] = (int16_t)(taps->whole[largest] + left);
}

static cm_half_steps steps_of(int are_eighths, uint32_t from, uint32_t to)
{
    if (are_eighths)
    {
        return 3 * (uint64_t)from == 8 * (uint64_t)to ? CM_EIGHTHS_EVEN : CM_EIGHTHS_ODD;
    }
    return from == 2 * (uint64_t)to ? CM_HALF_EVEN : CM_HALF_ODD;
}

/* After so many new pixels weights come again; 0: never. */
static uint32_t period_of(cm_half_steps steps)
{
    return steps == CM_HALF_EVEN ? 1 : steps == CM_EIGHTHS_EVEN ? 3 : 0;
}

/* Where each new pixel's taps begin, and their weights. NULL if there is no memory. */
static cm_half_taps *make_taps(cm_half_steps steps, uint32_t from, uint32_t to)
{
    cm_half_taps *taps = calloc(to, sizeof *taps);
    const double ratio = (double)from / to;
    const uint32_t period = period_of(steps);
    const int count = cm_half_count(steps);
    for (uint32_t i = 0; taps != NULL && i < to; i++)
    {
        const double centre = (i + 0.5) * ratio - 0.5;
        double weight[CM_TAPS_MOST];
        double sum = 0.0;
        const int32_t first = (int32_t)floor(centre) - (count / 2 - 1);
        if (period > 0 && i >= period)
        {
            /* those are as far from their centres */
            taps[i] = taps[i - period];
            taps[i].first = first;
            continue;
        }
        taps[i].first = first;
        for (int k = 0; k < count; k++)
        {
            weight[k] = low_pass((first + k - centre) / ratio);
            sum += weight[k];
        }
        for (int k = 0; k < count; k++)
        {
            taps[i].weight[k] = (float)(weight[k] / sum);
        }
        round_taps(&taps[i]);
    }
    return taps;
}

/* New columns that are made at once, so that the rows that they are made of stay in a cache of their own: a multiple of 3,
 * after which weights come again, and of what vectors have. */
#define STRIP 2016

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
    cm_half_steps across;
    cm_half_steps down;
    int16_t of_bytes[3]
                    [CM_EIGHTHS_TAPS]; /* weights of rows of bytes, of which so many come again */
    uint32_t lines;                    /* of a row above: channels that are apart */
    uint32_t pixel;                    /* floats from a column of a line to the next */
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

/* Of pictures the first and the last columns are strips of their own, whose taps go beyond the edges. */
#define STRIP_OF_EDGE 3

static strip strip_at(const halve_job *job, uint32_t first)
{
    const uint32_t width = job->to->width;
    const int has_edges = job->above == NULL && width > 3 * STRIP_OF_EDGE;
    const uint32_t last = has_edges ? width - STRIP_OF_EDGE : width;
    const uint32_t end = first == 0 && has_edges ? STRIP_OF_EDGE : first < last ? last : width;
    strip at = {.first = first, .count = end - first};
    at.count = at.count < STRIP ? at.count : STRIP;
    at.first_above = job->columns[first].first - 1;
    at.length = (size_t)(job->columns[first + at.count - 1].first + cm_half_count(job->across) -
                         at.first_above + (job->across == CM_HALF_EVEN));
    return at;
}

/* Memory of a thread. */
typedef struct halve_desk
{
    char *kept;
    void *mixed[3]; /* rows, pixel by pixel */
    void *lines;    /* one of them, channel by channel */
    float *parts;
} halve_desk;

/* ---- rows of floats, or of whole numbers ---- */

static size_t number_size(const halve_job *job)
{
    return job->to->is_whole ? sizeof(int16_t) : sizeof(float);
}

/* The number of a line of the level above that a strip begins with. */
static const void *row_above(const halve_job *job, size_t plane, uint32_t line, const strip *at,
                             int32_t row)
{
    const cm_padded *above = job->above;
    const ptrdiff_t first = row * above->row + (ptrdiff_t)line * above->channel + at->first_above;
    return above->is_whole ? (const void *)(above->whole[plane] + first)
                           : (const void *)(above->first[plane] + first);
}

/* A row of the pictures: all channels. */
static void read_row(const halve_job *job, size_t plane, const strip *at, int32_t row, float *desk,
                     void *to)
{
    const int32_t n = (int32_t)at->length;
    if (job->to->is_whole)
    {
        cm_level_read_whole(job->pictures, job->set, (unsigned)plane, at->first_above, row, n,
                            CM_PADDED_ONE, desk, to);
        return;
    }
    cm_level_read(job->pictures, (unsigned)plane, at->first_above, row, n, to);
}

/* The most rows that are mixed at once, or fetched. */
#define ROWS_MOST (CM_EIGHTHS_ROWS + CM_ROWS_NEXT)

/* The rows that a new one, or two, are made of. */
static int32_t rows_for(const halve_job *job, uint32_t count)
{
    return cm_half_count(job->down) + 2 * (int32_t)(count - 1);
}

/* The rows that a new one is made of, or two of them, of a line. What is read is read once, up to row `end` by now, and kept
 * from row to row. */
static void find_rows(const halve_job *job, size_t plane, uint32_t line, const strip *at,
                      int32_t first, int32_t count, int32_t end, const halve_desk *desk,
                      const void **rows)
{
    const size_t bytes = at->length * job->pixel * number_size(job);
    for (int32_t k = 0; k < count; k++)
    {
        const int32_t row = first + k;
        if (job->above != NULL)
        {
            rows[k] = row_above(job, plane, line, at, row);
            continue;
        }
        void *own = desk->kept + (uint32_t)row % KEPT * bytes;
        if (row >= end)
        {
            read_row(job, plane, at, row, desk->parts, own);
        }
        rows[k] = own;
    }
}

/* The rows of pictures that a new one is made of, or the three that come again, if they are bytes, and inside. */
static int find_bytes(const halve_job *job, size_t plane, const strip *at, int32_t first,
                      const uint8_t **rows)
{
    const cm_level_reader *reader = job->pictures;
    const int32_t count = job->down == CM_HALF_EVEN ? CM_HALF_TAPS : CM_EIGHTHS_ROWS;
    if (job->above != NULL || !job->to->is_whole || period_of(job->down) == 0 ||
        reader->level->values->type != CM_PIXEL_U8)
    {
        return 0;
    }
    for (int32_t k = 0; k < count + CM_ROWS_NEXT; k++)
    {
        rows[k] = cm_level_stored(reader, (unsigned)plane, at->first_above, first + k,
                                  (int32_t)at->length);
        if (rows[k] == NULL && k < count)
        {
            return 0;
        }
        /* of the last ones there is no next */
        rows[k] = rows[k] == NULL ? rows[k - 1] : rows[k];
    }
    return 1;
}

/* One new row, or two. */
static void mix(const halve_job *job, const void *const *rows, const cm_half_taps *taps, size_t n,
                uint32_t count, const halve_desk *desk)
{
    const float *floats[ROWS_MOST];
    const int16_t *whole[ROWS_MOST];
    for (int32_t k = 0; k < rows_for(job, count); k++)
    {
        floats[k] = rows[k];
        whole[k] = rows[k];
    }
    if (job->to->is_whole && count == 2)
    {
        job->set->mix_two_whole(whole, taps->whole, n, desk->mixed[0], desk->mixed[1]);
    }
    else if (job->to->is_whole)
    {
        job->set->mix_whole(whole, taps->whole, job->down, n, desk->mixed[0]);
    }
    else if (count == 2)
    {
        job->set->mix_two_rows(floats, taps->weight, n, desk->mixed[0], desk->mixed[1]);
    }
    else
    {
        job->set->mix_rows(floats, taps->weight, job->down, n, desk->mixed[0]);
    }
}

/* A row that has been mixed, of `pixel` channels from a line on, channel by channel. */
static const void *part(const halve_job *job, size_t n, const halve_desk *desk, const void *mixed)
{
    if (job->pixel == 1)
    {
        return mixed;
    }
    if (job->to->is_whole)
    {
        job->set->part_whole(mixed, job->pixel, n, desk->lines, (ptrdiff_t)n);
    }
    else
    {
        job->set->part_channels(mixed, job->pixel, n, desk->lines, (ptrdiff_t)n);
    }
    return desk->lines;
}

static void store_row(const halve_job *job, size_t plane, const strip *at, uint32_t row,
                      uint32_t line, const halve_desk *desk, const void *mixed)
{
    const cm_padded *to = job->to;
    const cm_half_taps *taps = job->columns + at->first;
    const char *lines = part(job, at->length, desk, mixed);
    for (uint32_t c = 0; c < job->pixel; c++, lines += at->length * number_size(job))
    {
        const ptrdiff_t first =
            (ptrdiff_t)row * to->row + (ptrdiff_t)(line + c) * to->channel + (ptrdiff_t)at->first;
        if (to->is_whole)
        {
            job->set->halve_row_whole((const void *)lines, taps, job->across, at->count,
                                      to->whole[plane] + first);
        }
        else
        {
            job->set->halve_row((const void *)lines, at->length, taps, job->across, at->count,
                                desk->parts, to->first[plane] + first);
        }
    }
}

/* ---- strips ---- */

/* New rows from `row` on, of bytes, up to `end` or the last one that comes again. Returns how many there are; 0: they are no
 * bytes, or lie beyond the edges. It does not depend on where rows begin and end. */
static uint32_t do_bytes(const halve_job *job, size_t plane, const strip *at, uint32_t row,
                         uint32_t end, const halve_desk *desk)
{
    const uint8_t *rows[ROWS_MOST];
    const uint32_t period = period_of(job->down);
    const uint32_t first = period == 0 ? row : row - row % period;
    const size_t n = at->length * job->pixel;
    uint32_t count = 0;
    if (!find_bytes(job, plane, at, job->rows[first].first, rows))
    {
        return 0;
    }
    if (job->down == CM_HALF_EVEN)
    {
        job->set->mix_bytes(rows, job->of_bytes[0], n, desk->mixed[0]);
    }
    else
    {
        int16_t *const mixed[3] = {desk->mixed[0], desk->mixed[1], desk->mixed[2]};
        job->set->mix_bytes_eighths(rows, job->of_bytes, n, mixed);
    }
    for (; row + count < end && row + count < first + period; count++)
    {
        store_row(job, plane, at, row + count, 0, desk, desk->mixed[row + count - first]);
    }
    return count;
}

/* One new row, or two, of whatever numbers. */
static uint32_t do_numbers(const halve_job *job, size_t plane, const strip *at, uint32_t row,
                           uint32_t end, int32_t *read, const halve_desk *desk)
{
    const void *rows[ROWS_MOST];
    const uint8_t *bytes[ROWS_MOST];
    const cm_half_taps *taps = &job->rows[row];
    const int are_two = job->down == CM_HALF_EVEN && row + 1 < end &&
                        !find_bytes(job, plane, at, taps[1].first, bytes);
    const uint32_t count = are_two ? 2 : 1;
    for (uint32_t line = 0; line < job->lines; line++)
    {
        find_rows(job, plane, line, at, taps->first, rows_for(job, count), *read, desk, rows);
        mix(job, rows, taps, at->length * job->pixel, count, desk);
        for (uint32_t k = 0; k < count; k++)
        {
            store_row(job, plane, at, row + k, line, desk, desk->mixed[k]);
        }
    }
    *read = taps->first + rows_for(job, count);
    return count;
}

/* New rows of a strip of a plane. */
static void do_strip(const halve_job *job, size_t plane, const strip *at, uint32_t begin,
                     uint32_t end, const halve_desk *desk)
{
    int32_t read = INT32_MIN;
    for (uint32_t row = begin; row < end;)
    {
        const uint32_t count = do_bytes(job, plane, at, row, end, desk);
        row += count > 0 ? count : do_numbers(job, plane, at, row, end, &read, desk);
    }
}

/* Where pages may have to be given back, that is said after so many new rows. */
#define ROWS_TOLD 64

/* What that many new rows of a strip have read and written. */
static size_t bytes_touched(const halve_job *job, const strip *at, size_t rows)
{
    const size_t written = rows * at->count * job->to->channels * number_size(job);
    const size_t read =
        job->above != NULL ? number_size(job) : cm_pixel_size(job->pictures->level->values->type);
    return written + (3 * rows + CM_TAPS_MOST) * at->length * job->to->channels * read;
}

/* Rows of the new level, of all planes. */
static void do_rows(size_t begin, size_t end, void *user)
{
    halve_job *job = user;
    const cm_padded *to = job->to;
    const size_t length = 3 * (STRIP + CM_TAPS_MOST);
    const size_t bytes = length * job->pixel * number_size(job);
    const size_t kept = job->above == NULL ? KEPT * bytes : 0;
    const size_t parts = (length * job->pixel + CM_HALF_DESK) * sizeof(float);
    const size_t all = kept + 4 * bytes + parts;
    char *memory = malloc(all);
    if (memory == NULL)
    {
        atomic_store(&job->failed, CM_ERROR_MEMORY);
        return;
    }
    const halve_desk desk = {
        .kept = memory,
        .mixed = {memory + kept, memory + kept + bytes, memory + kept + 2 * bytes},
        .lines = memory + kept + 3 * bytes,
        .parts = (float *)(void *)(memory + kept + 4 * bytes),
    };
    while (begin < end)
    {
        const size_t plane = begin / to->height;
        const size_t stop = (plane + 1) * to->height < end ? (plane + 1) * to->height : end;
        const size_t told = begin + (to->owner != NULL ? ROWS_TOLD : SIZE_MAX / 2);
        const size_t next = told < stop ? told : stop;
        for (uint32_t first = 0; first < to->width;)
        {
            const strip at = strip_at(job, first);
            do_strip(job, plane, &at, (uint32_t)(begin - plane * to->height),
                     (uint32_t)(next - plane * to->height), &desk);
            cm_large_touched(to->owner, bytes_touched(job, &at, next - begin));
            first += at.count;
        }
        begin = next;
    }
    free(memory);
}

/* The weights of bytes, whose sum is exact: the largest are in the middle. Of halves it is the first half of them. */
static void weigh_bytes(const cm_half_taps *taps, cm_half_steps steps, int16_t *weight)
{
    const int is_half = steps == CM_HALF_EVEN;
    const int count = is_half ? CM_HALF_TAPS / 2 : CM_EIGHTHS_TAPS;
    int left = is_half ? CM_HALF_BYTE_ONE / 2 : CM_HALF_BYTE_ONE;
    int largest = 0;
    for (int k = 0; k < count; k++)
    {
        weight[k] = (int16_t)lrintf(taps->weight[k] * CM_HALF_BYTE_ONE);
        left -= weight[k];
        largest = weight[k] > weight[largest] ? k : largest;
    }
    weight[largest] = (int16_t)(weight[largest] + left);
}

/* A level from the pictures, or from the one above, which has that size. */
static cm_status halve(const cm_level_reader *pictures, const cm_padded *above, int are_eighths,
                       uint32_t width, uint32_t height, const cm_padded *to,
                       const cm_filter_set *set, unsigned threads)
{
    halve_job job = {.pictures = pictures, .above = above, .to = to, .set = set};
    job.across = steps_of(are_eighths, width, to->width);
    job.down = steps_of(are_eighths, height, to->height);
    job.columns = make_taps(job.across, width, to->width);
    job.rows = make_taps(job.down, height, to->height);
    job.lines = above != NULL ? to->channels : 1;
    job.pixel = above != NULL ? 1 : to->channels;
    atomic_init(&job.failed, job.columns == NULL || job.rows == NULL ? CM_ERROR_MEMORY : CM_OK);
    if (atomic_load(&job.failed) == CM_OK)
    {
        for (uint32_t k = 0; k < period_of(job.down) && k < to->height; k++)
        {
            weigh_bytes(&job.rows[k], job.down, job.of_bytes[k]);
        }
        cm_run_threads(threads, (size_t)to->planes * to->height, 64, do_rows, &job);
    }
    free(job.columns);
    free(job.rows);
    return (cm_status)atomic_load(&job.failed);
}

/* As wide as the level, at most: what is further is seen on it once more. */
static int32_t border_of(int32_t wanted, uint32_t extent)
{
    const int32_t most = extent < CM_BORDER_LEAST ? CM_BORDER_LEAST : (int32_t)extent;
    return wanted < most ? wanted : most;
}

/* The size and the border of a level. */
static void shape_level(const cm_surface *surface, cm_level_size size, uint32_t channels,
                        cm_padded *level)
{
    const int32_t beside =
        border_of(surface->period != 0.0 ? CM_PYRAMID_BESIDE : CM_PYRAMID_BORDER, size.width);
    const int32_t beyond = border_of(CM_PYRAMID_BORDER, size.height);
    cm_padded_shape(surface, size.width, size.height, channels, beside, beyond, CM_PADDED_CHANNELS,
                    level);
}

/* The next level that is not there. */
static cm_status make_level(cm_pyramid *pyramid, const cm_memory *memory, unsigned threads)
{
    const cm_surface *surface = pyramid->surface;
    const unsigned k = atomic_load(&pyramid->made);
    const cm_padded *above = k > 1 ? &pyramid->level[k - 1] : NULL;
    const int are_eighths = k == 1 && has_eighths(pyramid->steps, surface->width, surface->height);
    cm_padded *level = &pyramid->level[k];
    cm_status status = cm_padded_allocate(pyramid->is_whole, memory, threads, level);
    if (status == CM_OK)
    {
        status = halve(
            &pyramid->reader, above, are_eighths, above != NULL ? above->width : surface->width,
            above != NULL ? above->height : surface->height, level, pyramid->set, threads);
    }
    if (status != CM_OK)
    {
        cm_padded_release(level);
        return status;
    }
    cm_padded_border(level, surface, pyramid->set, threads);
    atomic_store(&pyramid->made, k + 1);
    return CM_OK;
}

cm_status cm_pyramid_make(const cm_surface *surface, const cm_image *pictures,
                          const cm_values *values, const cm_sample_set *set, cm_pyramid_steps steps,
                          int32_t border, int is_whole, unsigned wanted, const cm_memory *memory,
                          unsigned threads, cm_pyramid *pyramid)
{
    const uint32_t least = surface->width < surface->height ? surface->width : surface->height;
    const int32_t beyond = surface->has_gaps          ? CM_BESIDE_MAP
                           : border > CM_BORDER_LEAST ? border
                                                      : CM_BORDER_LEAST;
    memset(pyramid, 0, sizeof *pyramid);
    cm_status status = cm_level_of_pictures(surface, pictures, values, set, 0,
                                            cm_border_of(surface, least, beyond), memory, threads,
                                            &pyramid->pictures);
    if (status != CM_OK)
    {
        return status;
    }
    cm_level_size sizes[CM_LEVELS_MAX];
    pyramid->count = cm_pyramid_sizes(steps, surface->width, surface->height, sizes);
    pyramid->reader = cm_level_reader_of(&pyramid->pictures, surface, set);
    pyramid->is_whole = is_whole;
    pyramid->surface = surface;
    pyramid->steps = steps;
    pyramid->set = cm_filter_set_find(set->name);
    atomic_init(&pyramid->made, 1);
    atomic_init(&pyramid->busy, 0);
    for (unsigned k = 1; k < pyramid->count; k++)
    {
        shape_level(surface, sizes[k], values->working, &pyramid->level[k]);
    }
    while (status == CM_OK && atomic_load(&pyramid->made) < wanted &&
           atomic_load(&pyramid->made) < pyramid->count)
    {
        status = make_level(pyramid, memory, threads);
    }
    if (status != CM_OK)
    {
        cm_pyramid_free(pyramid);
    }
    return status;
}

cm_status cm_pyramid_need(const cm_pyramid *pyramid, unsigned k)
{
    cm_pyramid *own = (cm_pyramid *)(uintptr_t)pyramid; /* they are all made by cm_pyramid_make */
    cm_status status = CM_OK;
    while (status == CM_OK && atomic_load(&own->made) <= k)
    {
        int busy = 0;
        if (!atomic_compare_exchange_strong(&own->busy, &busy, 1))
        {
            cm_wait_a_while();
            continue;
        }
        while (status == CM_OK && atomic_load(&own->made) <= k)
        {
            status = make_level(own, NULL, 1);
        }
        atomic_store(&own->busy, 0);
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
