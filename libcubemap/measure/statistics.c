/* SPDX-License-Identifier: MIT */
#include "pieces.h"

#include <stdlib.h>

/* ---- Pixels ---- */

typedef struct pixel_sums
{
    double count;
    double value;
    double square;
} pixel_sums;

/* One row of a face's pixels, summed apart, so that the sums are as accurate as they are short. */
static pixel_sums sum_row(const cm_quadrature *quadrature, uint8_t face, unsigned row,
                          unsigned pixels, cm_statistics *s)
{
    pixel_sums sums = {0};
    for (unsigned done = 0; done < pixels;)
    {
        cm_piece_points points;
        for (points.count = 0; points.count < CM_PIECE_POINTS && done < pixels; done++)
        {
            points.face[points.count] = face;
            points.u[points.count] = (2.0 * done + 1.0) / pixels - 1.0;
            points.v[points.count++] = (2.0 * row + 1.0) / pixels - 1.0;
        }
        cm_quadrature_evaluate(quadrature, &points);
        s->evaluations += points.count;
        for (size_t i = 0; i < points.count; i++)
        {
            double difference = points.value[i] - quadrature->ideal;
            cm_quadrature_extreme(s, points.value[i], face, points.u[i], points.v[i]);
            sums.count += 1.0;
            sums.value += points.value[i];
            sums.square += difference * difference;
        }
    }
    return sums;
}

static void sum_pixels(const cm_quadrature *quadrature, unsigned pixels, cm_statistics *s)
{
    pixel_sums sums = {0};
    for (uint8_t face = 0; face < 6; face++)
    {
        for (unsigned row = 0; row < pixels && (quadrature->faces >> face & 1u) != 0; row++)
        {
            pixel_sums of_row = sum_row(quadrature, face, row, pixels, s);
            sums.count += of_row.count;
            sums.value += of_row.value;
            sums.square += of_row.square;
        }
    }
    s->mean = sums.value / sums.count;
    s->rmse = sqrt(sums.square / sums.count);
}

/* ---- Statistics ---- */

cm_status cm_distortion_statistics(const cm_mapping *mapping, cm_quantity quantity,
                                   const cm_statistics_options *options, cm_statistics *statistics)
{
    cm_quadrature quadrature;
    if (statistics == NULL || statistics->size != sizeof *statistics)
    {
        return CM_ERROR_ARGUMENT;
    }
    cm_status status = cm_quadrature_make(mapping, quantity, options, &quadrature);
    if (status != CM_OK)
    {
        return status;
    }
    cm_statistics s = {.size = sizeof s,
                       .ideal = quadrature.ideal,
                       .minimum = (double)INFINITY,
                       .maximum = -(double)INFINITY};
    if (options != NULL && options->pixels > 0)
    {
        sum_pixels(&quadrature, options->pixels, &s);
    }
    else
    {
        double tolerance = options == NULL ? 0.0 : options->tolerance;
        cm_quadrature_integrate(&quadrature, tolerance == 0.0 ? 1e-9 : tolerance, &s);
        cm_quadrature_search(&quadrature, &s);
    }
    s.maximum_error = fmax(s.maximum - s.ideal, s.ideal - s.minimum);
    s.ratio = s.maximum / s.minimum;
    *statistics = s;
    return CM_OK;
}

/* ---- Percentiles ---- */

enum
{
    SAMPLES = 64 /* along r and t of a piece */
};

typedef struct sample
{
    double value;
    double weight;
} sample;

static int compare(const void *a, const void *b)
{
    double x = ((const sample *)a)->value;
    double y = ((const sample *)b)->value;
    return (x > y) - (x < y);
}

/* The part of a cell at which a piece's samples lie: another for each, spread evenly, so that pieces that
 * are mirrored do not all have the same values (Roberts's sequence from the plastic number). */
static double offset_of(int piece, double step)
{
    double offset = (piece + 0.5) * step;
    return offset - floor(offset);
}

/* One point in each of so many cells along r and t of every piece, sorted; returns how many. */
static size_t take_samples(const cm_quadrature *quadrature, int along, sample *samples)
{
    size_t count = 0;
    for (int piece = 0; piece < CM_PIECES; piece++)
    {
        for (int i = 0; i < along && cm_quadrature_has(quadrature, piece); i++)
        {
            double r = (i + offset_of(piece, 0.7548776662466927)) / along;
            double t = offset_of(piece, 0.5698402909980532);
            cm_piece_points points;
            points.count = 0;
            for (int j = 0; j < along; j++)
            {
                cm_piece_point(&points, piece, r, (j + t) / along);
            }
            cm_quadrature_evaluate(quadrature, &points);
            for (int j = 0; j < along; j++)
            {
                double weight = points.weight[j] * r;
                if (isfinite(weight) && !isnan(points.value[j]))
                {
                    samples[count++] = (sample){points.value[j], weight};
                }
            }
        }
    }
    qsort(samples, count, sizeof samples[0], compare);
    return count;
}

/* Half of a sample's weight lies below its value; between two values linear. */
static double percentile_of(const sample *samples, size_t count, double total, double percent)
{
    double wanted = percent / 100.0 * total;
    double below = 0.0;
    double last = -samples[0].weight / 2.0;
    for (size_t i = 0; i < count; i++)
    {
        double middle = below + samples[i].weight / 2.0;
        if (middle >= wanted)
        {
            double part = i == 0 ? 1.0 : (wanted - last) / (middle - last);
            double from = samples[i == 0 ? 0 : i - 1].value;
            return from + part * (samples[i].value - from);
        }
        below += samples[i].weight;
        last = middle;
    }
    return samples[count - 1].value;
}

static void find_percentiles(const cm_quadrature *quadrature, int along, sample *samples,
                             size_t count, const double *percent, double *value)
{
    size_t n = take_samples(quadrature, along, samples);
    double total = 0.0;
    for (size_t i = 0; i < n; i++)
    {
        total += samples[i].weight;
    }
    for (size_t k = 0; k < count; k++)
    {
        value[k] = n == 0 ? (double)NAN : percentile_of(samples, n, total, percent[k]);
    }
}

cm_status cm_distortion_percentiles(const cm_mapping *mapping, cm_quantity quantity,
                                    const cm_statistics_options *options, size_t count,
                                    const double *percent, double *value, double *doubt)
{
    cm_quadrature quadrature;
    if ((options != NULL && options->pixels != 0) ||
        (count > 0 && (percent == NULL || value == NULL)))
    {
        return CM_ERROR_ARGUMENT;
    }
    for (size_t k = 0; k < count; k++)
    {
        if (!(percent[k] >= 0.0 && percent[k] <= 100.0))
        {
            return CM_ERROR_ARGUMENT;
        }
    }
    cm_status status = cm_quadrature_make(mapping, quantity, options, &quadrature);
    if (status != CM_OK)
    {
        return status;
    }
    sample *samples = malloc((size_t)CM_PIECES * SAMPLES * SAMPLES * sizeof *samples);
    if (samples == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    if (doubt != NULL)
    {
        find_percentiles(&quadrature, SAMPLES / 2, samples, count, percent, doubt);
    }
    find_percentiles(&quadrature, SAMPLES, samples, count, percent, value);
    for (size_t k = 0; k < count && doubt != NULL; k++)
    {
        doubt[k] = fabs(doubt[k] - value[k]);
    }
    free(samples);
    return CM_OK;
}
