/* SPDX-License-Identifier: MIT
 *
 * Errors of single values. Every row is cut into spans of so many pixels, whose sums are added up in order: threads
 * share out spans, callers rows, and neither changes a bit.
 */
#include "compare_pixels.h"
#include "compare_sum.h"

#include <cubemap/threads.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum
{
    SPAN = 512,       /* pixels */
    SPANS = 256,      /* are measured at a time */
    LEAST_SPANS = 64, /* that are worth a thread */
    LANES = 4,        /* sums side by side, which become a vector */
    THREAD_STEP = 64  /* cm_run_threads cuts at multiples of that */
};

/* What a span has of one channel. */
typedef struct channel_span
{
    double absolute;
    double with_sign;
    double square;
    double largest;
    uint32_t largest_column;
    uint32_t infinite;
} channel_span;

/* What a span has besides. */
typedef struct span
{
    double weight;
    double peak;
    uint32_t pixels;
    uint32_t not_finite;
} span;

typedef struct channel_total
{
    cm_compare_sum absolute;
    cm_compare_sum with_sign;
    cm_compare_sum square;
    double largest;
    uint64_t largest_row;
    uint32_t largest_column;
    uint64_t infinite;
} channel_total;

typedef struct total
{
    cm_compare_sum weight;
    double peak; /* -inf: none yet */
    uint64_t pixels;
    uint64_t not_finite;
    uint64_t rows;
} total;

struct cm_errors
{
    uint32_t channels;
    cm_compare_not_finite not_finite;
    double peak;
    unsigned threads;
    total total;
    channel_total *channel;     /* channels of them, and as many for trials */
    span *span;                 /* SPANS */
    channel_span *channel_span; /* SPANS times channels */
};

double cm_psnr(double mse, double peak)
{
    return mse == 0.0 ? (double)INFINITY : 10.0 * log10(peak / mse * peak);
}

cm_status cm_errors_create(uint32_t channels, const cm_compare_options *options, cm_errors **errors)
{
    cm_compare_options wanted;
    if (errors == NULL || channels == 0 || channels > CM_CHANNELS_MAX ||
        !cm_compare_options_of(options, &wanted) || wanted.border != 0 || wanted.weights != NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    cm_errors *const made = calloc(1, sizeof *made);
    if (made == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    made->channels = channels;
    made->not_finite = wanted.not_finite;
    made->peak = wanted.peak;
    made->threads = wanted.threads;
    made->total.peak = -(double)INFINITY;
    made->channel = calloc(2 * (size_t)channels, sizeof *made->channel);
    made->span = calloc(SPANS, sizeof *made->span);
    made->channel_span = calloc(SPANS * (size_t)channels, sizeof *made->channel_span);
    if (made->channel == NULL || made->span == NULL || made->channel_span == NULL)
    {
        cm_errors_destroy(made);
        return CM_ERROR_MEMORY;
    }
    *errors = made;
    return CM_OK;
}

void cm_errors_destroy(cm_errors *errors)
{
    if (errors != NULL)
    {
        free(errors->channel);
        free(errors->span);
        free(errors->channel_span);
        free(errors);
    }
}

/* ---- one span ---- */

/* The spans from first on, of the rows that are added. */
typedef struct span_job
{
    cm_errors *errors;
    const cm_compare_pair *pair;
    uint64_t first;
    uint64_t spans_of_row;
} span_job;

/* Weights of a span: 0 for pixels that do not count, behind the last one too. */
static void weigh_span(const span_job *job, uint64_t row, uint32_t column, size_t count,
                       double weight[SPAN], span *found)
{
    const cm_compare_pair *const pair = job->pair;
    double one[SPAN];
    double other[SPAN];
    uint8_t odd[SPAN] = {0};
    memset(weight, 0, SPAN * sizeof *weight);
    cm_compare_read_weights(pair, row, column, count, weight);
    const int are_whole =
        cm_compare_is_whole(pair->reference.type) && cm_compare_is_whole(pair->picture.type);
    for (uint32_t c = 0; c < job->errors->channels && !are_whole; c++)
    {
        cm_compare_read(&pair->reference, row, column, count, c, one);
        cm_compare_read(&pair->picture, row, column, count, c, other);
        for (size_t i = 0; i < count; i++)
        {
            odd[i] |= (uint8_t) !(isfinite(one[i]) && isfinite(other[i]));
        }
    }
    memset(found, 0, sizeof *found);
    found->peak = -(double)INFINITY;
    for (size_t i = 0; i < count; i++)
    {
        found->not_finite += (uint32_t)(odd[i] && weight[i] > 0.0);
        if (odd[i] && job->errors->not_finite != CM_COMPARE_ALIKE)
        {
            weight[i] = 0.0;
        }
        found->pixels += (uint32_t)(weight[i] > 0.0);
    }
    double lane[LANES] = {0};
    for (size_t i = 0; i < SPAN; i += LANES)
    {
        for (size_t l = 0; l < LANES; l++)
        {
            lane[l] += weight[i + l];
        }
    }
    found->weight = (lane[0] + lane[1]) + (lane[2] + lane[3]);
}

static double largest_of(const double value[SPAN])
{
    double lane[LANES] = {0};
    for (size_t i = 0; i < SPAN; i += LANES)
    {
        for (size_t l = 0; l < LANES; l++)
        {
            lane[l] = value[i + l] > lane[l] ? value[i + l] : lane[l];
        }
    }
    const double even = lane[0] > lane[2] ? lane[0] : lane[2];
    const double odd = lane[1] > lane[3] ? lane[1] : lane[3];
    return even > odd ? even : odd;
}

/* Sums of errors that are finite, 0 where nothing counts. */
static void sum_span(const double error[SPAN], const double weight[SPAN], channel_span *found)
{
    double size[SPAN];
    double absolute[LANES] = {0};
    double with_sign[LANES] = {0};
    double square[LANES] = {0};
    for (size_t i = 0; i < SPAN; i += LANES)
    {
        for (size_t l = 0; l < LANES; l++)
        {
            const double weighted = error[i + l] * weight[i + l];
            size[i + l] = fabs(error[i + l]);
            absolute[l] += size[i + l] * weight[i + l];
            with_sign[l] += weighted;
            square[l] += weighted * error[i + l];
        }
    }
    found->absolute = (absolute[0] + absolute[1]) + (absolute[2] + absolute[3]);
    found->with_sign = (with_sign[0] + with_sign[1]) + (with_sign[2] + with_sign[3]);
    found->square = (square[0] + square[1]) + (square[2] + square[3]);
    found->largest = largest_of(size);
    found->largest_column = 0;
    while (found->largest > 0.0 && size[found->largest_column] < found->largest)
    {
        found->largest_column++;
    }
}

/* Errors of a span as CM_COMPARE_ALIKE has it: not finite ones are 0, and counted. */
static void find_infinite(const double one[SPAN], const double other[SPAN],
                          const double weight[SPAN], double error[SPAN], channel_span *found)
{
    for (uint32_t i = 0; i < SPAN; i++)
    {
        const int is_finite = isfinite(one[i]) && isfinite(other[i]);
        if (is_finite || !(weight[i] > 0.0))
        {
            continue;
        }
        error[i] = 0.0;
        if (!(other[i] == one[i] || (isnan(other[i]) && isnan(one[i]))))
        {
            found->largest_column = found->infinite == 0 ? i : found->largest_column;
            found->infinite++;
        }
    }
}

static double peak_of(const double one[SPAN], const double weight[SPAN])
{
    double peak = -(double)INFINITY;
    for (size_t i = 0; i < SPAN; i++)
    {
        peak = weight[i] > 0.0 && one[i] > peak && !isinf(one[i]) ? one[i] : peak;
    }
    return peak;
}

/* One channel of a span. What is refused or left out has the weight 0. */
static void measure_channel(const span_job *job, uint64_t row, uint32_t column, size_t count,
                            uint32_t c, const double weight[SPAN], span *all, channel_span *found)
{
    double one[SPAN];
    double other[SPAN];
    double error[SPAN];
    channel_span infinite = {.infinite = 0};
    memset(one, 0, sizeof one);
    memset(other, 0, sizeof other);
    cm_compare_read(&job->pair->reference, row, column, count, c, one);
    cm_compare_read(&job->pair->picture, row, column, count, c, other);
    for (size_t i = 0; i < SPAN; i++)
    {
        error[i] = weight[i] > 0.0 ? other[i] - one[i] : 0.0;
    }
    if (all->not_finite > 0)
    {
        find_infinite(one, other, weight, error, &infinite);
    }
    const double peak = cm_compare_is_whole(job->pair->reference.type) ? 1.0 : peak_of(one, weight);
    all->peak = all->pixels > 0 && peak > all->peak ? peak : all->peak;
    sum_span(error, weight, found);
    found->infinite = infinite.infinite;
    if (infinite.infinite > 0)
    {
        found->largest = (double)INFINITY;
        found->largest_column = infinite.largest_column;
    }
}

static void measure_spans(size_t begin, size_t end, void *user)
{
    const span_job *const job = user;
    const size_t channels = job->errors->channels;
    for (size_t i = begin / THREAD_STEP; i < end / THREAD_STEP; i++)
    {
        const uint64_t row = (job->first + i) / job->spans_of_row;
        const uint32_t column = (uint32_t)((job->first + i) % job->spans_of_row * SPAN);
        const uint32_t left = job->pair->reference.width - column;
        const size_t count = left < SPAN ? left : SPAN;
        double weight[SPAN];
        weigh_span(job, row, column, count, weight, &job->errors->span[i]);
        for (uint32_t c = 0; c < channels; c++)
        {
            measure_channel(job, row, column, count, c, weight, &job->errors->span[i],
                            &job->errors->channel_span[i * channels + c]);
            job->errors->channel_span[i * channels + c].largest_column += column;
        }
    }
}

/* ---- all spans ---- */

static void add_span(const cm_errors *errors, size_t i, uint64_t row, total *to,
                     channel_total *channel)
{
    const span *const found = &errors->span[i];
    cm_compare_sum_add(&to->weight, found->weight);
    to->peak = found->peak > to->peak ? found->peak : to->peak;
    to->pixels += found->pixels;
    to->not_finite += found->not_finite;
    for (uint32_t c = 0; c < errors->channels; c++)
    {
        const channel_span *const from = &errors->channel_span[i * errors->channels + c];
        cm_compare_sum_add(&channel[c].absolute, from->absolute);
        cm_compare_sum_add(&channel[c].with_sign, from->with_sign);
        cm_compare_sum_add(&channel[c].square, from->square);
        channel[c].infinite += from->infinite;
        if (from->largest > channel[c].largest)
        {
            channel[c].largest = from->largest;
            channel[c].largest_row = to->rows + row;
            channel[c].largest_column = from->largest_column;
        }
    }
}

cm_status cm_errors_add(cm_errors *errors, const cm_image *reference, const cm_image *picture,
                        const cm_image *weights)
{
    cm_compare_pair pair;
    if (errors == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    const cm_status status = cm_compare_pair_of(reference, picture, weights, &pair);
    if (status != CM_OK || reference->channels != errors->channels)
    {
        return status != CM_OK ? status : CM_ERROR_RANGE;
    }
    channel_total *const trial = errors->channel + errors->channels;
    const size_t size = errors->channels * sizeof *trial;
    total sum = errors->total;
    memcpy(trial, errors->channel, size);
    span_job job = {errors, &pair, 0, (pair.picture.width + (uint64_t)SPAN - 1) / SPAN};
    const uint64_t spans = job.spans_of_row * pair.picture.height;
    for (; job.first < spans; job.first += SPANS)
    {
        const uint64_t left = spans - job.first;
        const size_t count = left < SPANS ? (size_t)left : SPANS;
        cm_run_threads(errors->threads, count * THREAD_STEP, LEAST_SPANS * THREAD_STEP,
                       measure_spans, &job);
        for (size_t i = 0; i < count; i++)
        {
            add_span(errors, i, (job.first + i) / job.spans_of_row, &sum, trial);
        }
    }
    if (errors->not_finite == CM_COMPARE_REFUSE && sum.not_finite > 0)
    {
        return CM_ERROR_RANGE;
    }
    sum.rows += pair.picture.height;
    memcpy(errors->channel, trial, size);
    errors->total = sum;
    return CM_OK;
}

/* ---- figures ---- */

/* NaN of nothing, without the sign that processors give 0 / 0. */
static double mean_of(double sum, double weight)
{
    return weight > 0.0 ? sum / weight : (double)NAN;
}

/* Of all channels together: a place counts before another one row by row, then channel by channel. */
static int is_before(const channel_total *one, const channel_total *other)
{
    return one->largest_row < other->largest_row ||
           (one->largest_row == other->largest_row && one->largest_column < other->largest_column);
}

static void find_largest(const cm_errors *errors, uint32_t first, uint32_t end,
                         cm_error_figures *figures)
{
    uint32_t at = first;
    for (uint32_t c = first + 1; c < end; c++)
    {
        const channel_total *const best = &errors->channel[at];
        const channel_total *const next = &errors->channel[c];
        at = next->largest > best->largest ||
                     (next->largest == best->largest && is_before(next, best))
                 ? c
                 : at;
    }
    const channel_total *const best = &errors->channel[at];
    figures->largest = errors->total.pixels > 0 ? best->largest : (double)NAN;
    figures->largest_row = best->largest_row;
    figures->largest_column = best->largest_column;
    figures->largest_channel = best->largest > 0.0 ? at : 0;
}

cm_status cm_errors_get(const cm_errors *errors, uint32_t channel, cm_error_figures *figures)
{
    if (errors == NULL || figures == NULL || figures->size != sizeof *figures ||
        (channel != CM_ALL_CHANNELS && channel >= errors->channels))
    {
        return CM_ERROR_ARGUMENT;
    }
    const uint32_t first = channel == CM_ALL_CHANNELS ? 0 : channel;
    const uint32_t end = channel == CM_ALL_CHANNELS ? errors->channels : channel + 1;
    double absolute = 0.0, with_sign = 0.0, square = 0.0;
    uint64_t infinite = 0;
    for (uint32_t c = first; c < end; c++)
    {
        absolute += cm_compare_sum_value(&errors->channel[c].absolute);
        with_sign += cm_compare_sum_value(&errors->channel[c].with_sign);
        square += cm_compare_sum_value(&errors->channel[c].square);
        infinite += errors->channel[c].infinite;
    }
    figures->pixels = errors->total.pixels;
    figures->not_finite = errors->total.not_finite;
    figures->weight = cm_compare_sum_value(&errors->total.weight);
    const double weight = figures->weight * (end - first);
    figures->mse = infinite > 0 ? (double)INFINITY : mean_of(square, weight);
    figures->rmse = sqrt(figures->mse);
    figures->mean_absolute = infinite > 0 ? (double)INFINITY : mean_of(absolute, weight);
    figures->mean_signed = infinite > 0 ? (double)NAN : mean_of(with_sign, weight);
    find_largest(errors, first, end, figures);
    figures->peak = errors->peak > 0.0         ? errors->peak
                    : errors->total.peak > 0.0 ? errors->total.peak
                                               : 1.0;
    figures->psnr = cm_psnr(figures->mse, figures->peak);
    return CM_OK;
}

/* ---- whole pictures ---- */

/* The part of a picture inside a border; a column of weights stays one pixel wide. */
static cm_image inside(const cm_image *image, uint32_t border)
{
    cm_image part = *image;
    const uint32_t columns = part.width == 1 && part.type == CM_PIXEL_FLOAT ? 0 : border;
    part.data = (unsigned char *)part.data + (ptrdiff_t)border * part.row_stride +
                (ptrdiff_t)columns * part.pixel_stride;
    part.height -= 2 * border;
    part.width -= 2 * columns;
    return part;
}

cm_status cm_compare_errors(const cm_image *reference, const cm_image *picture,
                            const cm_compare_options *options, cm_error_figures *figures)
{
    cm_compare_options wanted;
    cm_compare_pair pair;
    cm_errors *errors = NULL;
    if (!cm_compare_options_of(options, &wanted) || figures == NULL ||
        figures->size != sizeof *figures)
    {
        return CM_ERROR_ARGUMENT;
    }
    cm_status status = cm_compare_pair_of(reference, picture, wanted.weights, &pair);
    if (status != CM_OK)
    {
        return status;
    }
    const uint32_t border = wanted.border;
    wanted.weights = NULL;
    wanted.border = 0;
    status = cm_errors_create(pair.reference.channels, &wanted, &errors);
    /* of a picture that is all border nothing counts */
    if (status == CM_OK && border < (pair.picture.width + 1) / 2 &&
        border < (pair.picture.height + 1) / 2)
    {
        const cm_image one = inside(&pair.reference, border);
        const cm_image other = inside(&pair.picture, border);
        const cm_image weights = pair.has_weights ? inside(&pair.weights, border) : one;
        status = cm_errors_add(errors, &one, &other, pair.has_weights ? &weights : NULL);
    }
    if (status == CM_OK)
    {
        status = cm_errors_get(errors, CM_ALL_CHANNELS, figures);
        figures->largest_row += figures->largest > 0.0 ? border : 0;
        figures->largest_column += figures->largest > 0.0 ? border : 0;
    }
    cm_errors_destroy(errors);
    return status;
}

cm_status cm_compare_values(size_t n, uint32_t channels, const float *reference,
                            const float *picture, const cm_compare_options *options,
                            cm_error_figures *figures)
{
    if (reference == NULL || picture == NULL || n == 0 || n > UINT32_MAX)
    {
        return CM_ERROR_ARGUMENT;
    }
    /* what is compared is not written to */
    union
    {
        const float *constant;
        void *data;
    } one = {reference}, other = {picture};
    const cm_image first = {sizeof first, one.data, CM_PIXEL_FLOAT, (uint32_t)n, 1, channels, 0, 0};
    cm_image second = first;
    second.data = other.data;
    return cm_compare_errors(&first, &second, options, figures);
}
