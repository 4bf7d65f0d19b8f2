/* SPDX-License-Identifier: MIT
 *
 * Levels by a sinc in a Kaiser window, whose edge is at the new level's highest frequency: J. F. Kaiser, Nonrecursive
 * digital filter design using the I0-sinh window function, IEEE Symposium on Circuits and Systems, 1974. It reaches three
 * new pixels each way, its stop band is 50 dB down; sizes that are odd have weights for each pixel.
 */
#include "pyramid.h"
#include "filter_set.h"
#include "large_memory.h"

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

/* Halves, and three quarters, rounded up. */
static uint32_t half_of(uint32_t size)
{
    return size / 2 + size % 2;
}

static uint32_t most_of(uint32_t size)
{
    return size - size / 4;
}

/* Rows and columns that a level between two others has at least; their borders cost more than they save where they are
 * small. */
#define BETWEEN_LEAST 96

static int is_large(const cm_level_size *size)
{
    return size->width >= BETWEEN_LEAST && size->height >= BETWEEN_LEAST;
}

unsigned cm_pyramid_sizes(cm_pyramid_steps steps, uint32_t width, uint32_t height,
                          cm_level_size sizes[CM_LEVELS_MAX])
{
    unsigned count = 1;
    cm_level_size half = {width, height, 0};
    unsigned last = 0; /* the half of halves that was the last */
    sizes[0] = half;
    while (half.width > 1 || half.height > 1)
    {
        half = (cm_level_size){half_of(half.width), half_of(half.height), last};
        last = count;
        sizes[count++] = half;
        const cm_level_size between = {most_of(half.width), most_of(half.height), last};
        if (steps == CM_PYRAMID_BETWEEN && is_large(&between))
        {
            sizes[count++] = between;
        }
    }
    return count;
}

/* Whole weights whose sum is exact: the largest takes what rounding left. */
static void round_taps(cm_half_taps *taps)
{
    int left = CM_HALF_ONE;
    int largest = 0;
    for (int k = 0; k < CM_HALF_TAPS; k++)
    {
        taps->whole[k] = (int16_t)lrintf(taps->weight[k] * CM_HALF_ONE);
        left -= taps->whole[k];
        largest = taps->weight[k] > taps->weight[largest] ? k : largest;
    }
    taps->whole[largest] = (int16_t)(taps->whole[largest] + left);
}

static cm_half_steps steps_of(uint32_t from, uint32_t to)
{
    return from == 2 * to                           ? CM_HALF_EVEN
           : 3 * (uint64_t)from == 4 * (uint64_t)to ? CM_HALF_THREE_OF_FOUR
                                                    : CM_HALF_ODD;
}

/* Where each new pixel's taps begin, and their weights. NULL if there is no memory. */
static cm_half_taps *make_taps(uint32_t from, uint32_t to)
{
    cm_half_taps *taps = malloc(to * sizeof *taps);
    const double ratio = (double)from / to;
    const cm_half_steps steps = steps_of(from, to);
    const uint32_t period = steps == CM_HALF_EVEN ? 1 : steps == CM_HALF_THREE_OF_FOUR ? 3 : 0;
    for (uint32_t i = 0; taps != NULL && i < to; i++)
    {
        const double centre = (i + 0.5) * ratio - 0.5;
        double weight[CM_HALF_TAPS];
        double sum = 0.0;
        taps[i].first = (int32_t)floor(centre) - (CM_HALF_TAPS / 2 - 1);
        if (period > 0 && i >= period)
        {
            /* those are as far from their centres */
            const int32_t first = taps[i].first;
            taps[i] = taps[i - period];
            taps[i].first = first;
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
        round_taps(&taps[i]);
    }
    return taps;
}

/* New columns that are made at once, so that the rows that they are made of stay in a cache of their own: a multiple of 3,
 * after which weights come again, and of what vectors have. */
#define STRIP 1008

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
    cm_half_steps steps;
    int is_even_down;                   /* is the height half the one above? */
    int16_t of_bytes[CM_HALF_TAPS / 2]; /* weights of rows of bytes, if it is */
    uint32_t lines;                     /* of a row above: channels that are apart */
    uint32_t pixel;                     /* floats from a column of a line to the next */
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
#define STRIP_OF_EDGE 48

static strip strip_at(const halve_job *job, uint32_t first)
{
    const uint32_t width = job->to->width;
    const int has_edges = job->above == NULL && width > 3 * STRIP_OF_EDGE;
    const uint32_t last = has_edges ? width - STRIP_OF_EDGE : width;
    const uint32_t end = first == 0 && has_edges ? STRIP_OF_EDGE : first < last ? last : width;
    strip at = {.first = first, .count = end - first};
    at.count = at.count < STRIP ? at.count : STRIP;
    at.first_above = job->columns[first].first - 1;
    at.length = (size_t)(job->columns[first + at.count - 1].first + CM_HALF_TAPS - at.first_above +
                         (job->steps == CM_HALF_EVEN));
    return at;
}

/* Memory of a thread. */
typedef struct halve_desk
{
    char *kept;
    void *mixed[2]; /* rows, pixel by pixel */
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

/* The rows of pictures that a new one is made of, if they are bytes, and inside. */
static int find_bytes(const halve_job *job, size_t plane, const strip *at, int32_t first,
                      const uint8_t **rows)
{
    const cm_level_reader *reader = job->pictures;
    if (job->above != NULL || !job->to->is_whole || !job->is_even_down ||
        reader->level->values->type != CM_PIXEL_U8)
    {
        return 0;
    }
    for (int32_t k = 0; k < CM_HALF_TAPS + 2; k++)
    {
        rows[k] = cm_level_stored(reader, (unsigned)plane, at->first_above, first + k,
                                  (int32_t)at->length);
        if (rows[k] == NULL && k < CM_HALF_TAPS)
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
    const float *floats[CM_HALF_TAPS + 2];
    const int16_t *whole[CM_HALF_TAPS + 2];
    for (uint32_t k = 0; k < CM_HALF_TAPS + 2 * (count - 1); k++)
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
        job->set->mix_whole(whole, taps->whole, n, desk->mixed[0]);
    }
    else if (count == 2)
    {
        job->set->mix_two_rows(floats, taps->weight, n, desk->mixed[0], desk->mixed[1]);
    }
    else
    {
        job->set->mix_rows(floats, taps->weight, n, desk->mixed[0]);
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
            job->set->halve_row_whole((const void *)lines, taps, job->steps, at->count,
                                      to->whole[plane] + first);
        }
        else
        {
            job->set->halve_row((const void *)lines, at->length, taps, job->steps, at->count,
                                desk->parts, to->first[plane] + first);
        }
    }
}

/* ---- strips ---- */

/* New rows of a strip of a plane. */
static void do_strip(const halve_job *job, size_t plane, const strip *at, uint32_t begin,
                     uint32_t end, const halve_desk *desk)
{
    const void *rows[CM_HALF_TAPS + 2];
    const uint8_t *bytes[CM_HALF_TAPS + 2];
    int32_t read = INT32_MIN;
    uint32_t count;
    for (uint32_t row = begin; row < end; row += count)
    {
        const cm_half_taps *taps = &job->rows[row];
        if (find_bytes(job, plane, at, taps->first, bytes))
        {
            count = 1;
            job->set->mix_bytes(bytes, job->of_bytes, at->length * job->pixel, desk->mixed[0]);
            store_row(job, plane, at, row, 0, desk, desk->mixed[0]);
            continue;
        }
        count =
            job->is_even_down && row + 1 < end && !find_bytes(job, plane, at, taps[1].first, bytes)
                ? 2
                : 1;
        const int32_t many = CM_HALF_TAPS + 2 * (int32_t)(count - 1);
        for (uint32_t line = 0; line < job->lines; line++)
        {
            find_rows(job, plane, line, at, taps->first, many, read, desk, rows);
            mix(job, rows, taps, at->length * job->pixel, count, desk);
            for (uint32_t k = 0; k < count; k++)
            {
                store_row(job, plane, at, row + k, line, desk, desk->mixed[k]);
            }
        }
        read = taps->first + many;
    }
}

/* Rows of the new level, of all planes. */
static void do_rows(size_t begin, size_t end, void *user)
{
    halve_job *job = user;
    const cm_padded *to = job->to;
    const size_t length = 2 * (STRIP + CM_HALF_TAPS);
    const size_t bytes = length * job->pixel * number_size(job);
    const size_t kept = job->above == NULL ? KEPT * bytes : 0;
    const size_t parts = (length * job->pixel + 4) * sizeof(float);
    char *memory = malloc(kept + 3 * bytes + parts);
    if (memory == NULL)
    {
        atomic_store(&job->failed, CM_ERROR_MEMORY);
        return;
    }
    const halve_desk desk = {
        .kept = memory,
        .mixed = {memory + kept, memory + kept + bytes},
        .lines = memory + kept + 2 * bytes,
        .parts = (float *)(void *)(memory + kept + 3 * bytes),
    };
    while (begin < end)
    {
        const size_t plane = begin / to->height;
        const size_t next = (plane + 1) * to->height < end ? (plane + 1) * to->height : end;
        for (uint32_t first = 0; first < to->width;)
        {
            const strip at = strip_at(job, first);
            do_strip(job, plane, &at, (uint32_t)(begin - plane * to->height),
                     (uint32_t)(next - plane * to->height), &desk);
            cm_large_touched(to->owner,
                             (next - begin) * at.count * to->channels * number_size(job));
            first += at.count;
        }
        begin = next;
    }
    free(memory);
}

/* The weights of bytes, whose sum is exact: the largest are in the middle. */
static void weigh_bytes(const cm_half_taps *taps, int16_t *weight)
{
    int left = CM_HALF_BYTE_ONE / 2;
    for (int k = 0; k < CM_HALF_TAPS / 2; k++)
    {
        weight[k] = (int16_t)lrintf(taps->weight[k] * CM_HALF_BYTE_ONE);
        left -= weight[k];
    }
    weight[CM_HALF_TAPS / 2 - 1] = (int16_t)(weight[CM_HALF_TAPS / 2 - 1] + left);
}

/* A level from the pictures, or from the one above, which has that size. */
static cm_status halve(const cm_level_reader *pictures, const cm_padded *above, uint32_t width,
                       uint32_t height, const cm_padded *to, const cm_filter_set *set,
                       unsigned threads)
{
    halve_job job = {.pictures = pictures, .above = above, .to = to, .set = set};
    job.columns = make_taps(width, to->width);
    job.rows = make_taps(height, to->height);
    job.steps = steps_of(width, to->width);
    job.is_even_down = steps_of(height, to->height) == CM_HALF_EVEN;
    job.lines = above != NULL ? to->channels : 1;
    job.pixel = above != NULL ? 1 : to->channels;
    atomic_init(&job.failed, job.columns == NULL || job.rows == NULL ? CM_ERROR_MEMORY : CM_OK);
    if (atomic_load(&job.failed) == CM_OK)
    {
        weigh_bytes(job.rows, job.of_bytes);
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

static cm_status make_level(const cm_surface *surface, uint32_t width, uint32_t height,
                            uint32_t channels, int is_whole, const cm_memory *memory,
                            unsigned threads, cm_padded *level)
{
    const int32_t beside =
        border_of(surface->period != 0.0 ? CM_PYRAMID_BESIDE : CM_PYRAMID_BORDER, width);
    const int32_t beyond = border_of(CM_PYRAMID_BORDER, height);
    if (is_whole)
    {
        return cm_padded_create_whole(surface, width, height, channels, beside, beyond, memory,
                                      threads, level);
    }
    return cm_padded_create(surface, width, height, channels, beside, beyond, CM_PADDED_CHANNELS,
                            memory, threads, level);
}

cm_status cm_pyramid_make(const cm_surface *surface, const cm_image *pictures,
                          const cm_values *values, const cm_sample_set *set, cm_pyramid_steps steps,
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
    cm_level_size sizes[CM_LEVELS_MAX];
    const unsigned count = cm_pyramid_sizes(steps, surface->width, surface->height, sizes);
    while (status == CM_OK && pyramid->count < count)
    {
        const unsigned k = pyramid->count++;
        const unsigned above = sizes[k].above;
        cm_padded *level = &pyramid->level[k];
        status = make_level(surface, sizes[k].width, sizes[k].height, values->working, is_whole,
                            memory, threads, level);
        status = status == CM_OK
                     ? halve(&pyramid->reader, above > 0 ? &pyramid->level[above] : NULL,
                             sizes[above].width, sizes[above].height, level, loops, threads)
                     : status;
        if (status == CM_OK)
        {
            cm_padded_border(level, surface, threads);
        }
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
