/* SPDX-License-Identifier: MIT
 *
 * Nair et al. 2013, section 5.1: metrics of one image and of several.
 */
#include <cubemap/depth_error.h>

#include "modules/memory/checked_size.h"
#include "depth_error_pair.h"

#include <stdlib.h>

static int are_missing(size_t n, const void *first, const void *second)
{
    return n > 0 && (first == NULL || second == NULL);
}

cm_status cm_depth_error_local(size_t n, const float *depth, const float *truth, float *error)
{
    if (are_missing(n, depth, truth) || are_missing(n, error, error))
    {
        return CM_ERROR_ARGUMENT;
    }
    for (size_t i = 0; i < n; i++)
    {
        error[i] = cm_error_counts(depth[i], truth[i]) ? (float)cm_error_of(depth[i], truth[i])
                                                       : (float)NAN;
    }
    return CM_OK;
}

/* ---- order ---- */

static int compare(const void *first, const void *second)
{
    const double a = *(const double *)first, b = *(const double *)second;
    return (a > b) - (a < b);
}

/* Between sorted values, linearly. */
static double quantile_of(const double *sorted, size_t count, double fraction)
{
    const double at = fraction * (double)(count - 1);
    const size_t below = (size_t)at;
    const size_t above = below + 1 < count ? below + 1 : below;
    return sorted[below] + (at - (double)below) * (sorted[above] - sorted[below]);
}

/* The errors of pixels that count; NULL without memory. */
static double *collect(size_t n, const float *depth, const float *truth, size_t *count)
{
    double *error = cm_array_of(n > 0 ? n : 1, sizeof *error);
    *count = 0;
    for (size_t i = 0; i < n && error != NULL; i++)
    {
        if (cm_error_counts(depth[i], truth[i]))
        {
            error[(*count)++] = cm_error_of(depth[i], truth[i]);
        }
    }
    return error;
}

static void make_absolute(double *error, size_t count)
{
    for (size_t i = 0; i < count; i++)
    {
        error[i] = fabs(error[i]);
    }
    qsort(error, count, sizeof *error, compare);
}

/* ---- global metrics ---- */

static void find_moments(const double *error, size_t count, cm_depth_error *found)
{
    cm_error_sum sum = {0.0, 0.0}, absolute = {0.0, 0.0}, square = {0.0, 0.0}, spread = {0.0, 0.0};
    for (size_t i = 0; i < count; i++)
    {
        cm_error_add(&sum, error[i]);
        cm_error_add(&absolute, fabs(error[i]));
        cm_error_add(&square, error[i] * error[i]);
    }
    found->bias = cm_error_total(&sum) / (double)count;
    for (size_t i = 0; i < count; i++)
    {
        const double from_mean = error[i] - found->bias;
        cm_error_add(&spread, from_mean * from_mean);
    }
    found->mae = cm_error_total(&absolute) / (double)count;
    found->mse = cm_error_total(&square) / (double)count;
    found->rmse = sqrt(found->mse);
    found->deviation = sqrt(cm_error_total(&spread) / (double)count);
}

cm_status cm_depth_error_measure(size_t n, const float *depth, const float *truth,
                                 cm_depth_error *error)
{
    if (are_missing(n, depth, truth) || error == NULL || error->size != sizeof *error)
    {
        return CM_ERROR_ARGUMENT;
    }
    cm_depth_error found = {.size = sizeof found};
    double *each = collect(n, depth, truth, &found.count);
    if (each == NULL || found.count == 0)
    {
        free(each);
        return each == NULL ? CM_ERROR_MEMORY : CM_ERROR_RANK;
    }
    for (size_t i = 0; i < n; i++)
    {
        const int has_depth = cm_error_is_measured(depth[i]);
        const int has_truth = cm_error_is_measured(truth[i]);
        found.missing += (size_t)(has_truth && !has_depth);
        found.extra += (size_t)(has_depth && !has_truth);
    }
    find_moments(each, found.count, &found);
    qsort(each, found.count, sizeof *each, compare);
    found.median = quantile_of(each, found.count, 0.5);
    make_absolute(each, found.count);
    found.median_absolute = quantile_of(each, found.count, 0.5);
    found.maximum = each[found.count - 1];
    free(each);
    *error = found;
    return CM_OK;
}

cm_status cm_depth_error_quantiles(size_t n, const float *depth, const float *truth, size_t count,
                                   const double *fraction, double *quantile)
{
    if (are_missing(n, depth, truth) || are_missing(count, fraction, quantile))
    {
        return CM_ERROR_ARGUMENT;
    }
    for (size_t i = 0; i < count; i++)
    {
        if (!(fraction[i] >= 0.0 && fraction[i] <= 1.0))
        {
            return CM_ERROR_RANGE;
        }
    }
    size_t pixels;
    double *each = collect(n, depth, truth, &pixels);
    if (each == NULL || pixels == 0)
    {
        free(each);
        return each == NULL ? CM_ERROR_MEMORY : CM_ERROR_RANK;
    }
    make_absolute(each, pixels);
    for (size_t i = 0; i < count; i++)
    {
        quantile[i] = quantile_of(each, pixels, fraction[i]);
    }
    free(each);
    return CM_OK;
}

static size_t count_bad(size_t n, const float *depth, const float *truth, double limit)
{
    size_t bad = 0;
    for (size_t i = 0; i < n; i++)
    {
        const int is_good =
            cm_error_is_measured(depth[i]) && fabs(cm_error_of(depth[i], truth[i])) <= limit;
        bad += (size_t)(cm_error_is_measured(truth[i]) && !is_good);
    }
    return bad;
}

cm_status cm_depth_error_bad(size_t n, const float *depth, const float *truth, size_t count,
                             const double *limit, double *ratio)
{
    if (are_missing(n, depth, truth) || are_missing(count, limit, ratio))
    {
        return CM_ERROR_ARGUMENT;
    }
    for (size_t i = 0; i < count; i++)
    {
        if (!(limit[i] >= 0.0))
        {
            return CM_ERROR_RANGE;
        }
    }
    size_t pixels = 0;
    for (size_t i = 0; i < n; i++)
    {
        pixels += (size_t)cm_error_is_measured(truth[i]);
    }
    if (pixels == 0)
    {
        return CM_ERROR_RANK;
    }
    for (size_t i = 0; i < count; i++)
    {
        ratio[i] = (double)count_bad(n, depth, truth, limit[i]) / (double)pixels;
    }
    return CM_OK;
}

/* ---- over time ---- */

/* Welford's recurrence (1962), over the frames that have measured the pixel. */
static size_t find_spread(size_t frames, size_t n, const float *depth, double *mean, double *spread)
{
    size_t count = 0;
    *mean = *spread = 0.0;
    for (size_t f = 0; f < frames; f++)
    {
        const float value = depth[f * n];
        if (cm_error_is_measured(value))
        {
            const double from_mean = (double)value - *mean;
            *mean += from_mean / (double)++count;
            *spread += from_mean * ((double)value - *mean);
        }
    }
    return count;
}

cm_status cm_depth_error_temporal(size_t frames, size_t n, const float *depth, float *mean,
                                  float *deviation)
{
    if (are_missing(n, depth, depth))
    {
        return CM_ERROR_ARGUMENT;
    }
    if (frames < 2)
    {
        return CM_ERROR_RANGE;
    }
    for (size_t i = 0; i < n; i++)
    {
        double middle, spread;
        const size_t count = find_spread(frames, n, depth + i, &middle, &spread);
        if (mean != NULL)
        {
            mean[i] = count > 0 ? (float)middle : (float)NAN;
        }
        if (deviation != NULL)
        {
            deviation[i] = count > 1 ? (float)sqrt(spread / (double)(count - 1)) : (float)NAN;
        }
    }
    return CM_OK;
}

/* ---- eq. 1 ---- */

double cm_depth_error_checkerboard(double distance, double spacing, double focal_length,
                                   double corner_error)
{
    const double projected = spacing / distance * focal_length;
    const double hidden = projected - 2.0 * corner_error;
    return distance > 0.0 && spacing > 0.0 && focal_length > 0.0 && corner_error >= 0.0 &&
                   hidden > 0.0
               ? 2.0 * spacing * corner_error / (projected * hidden) * focal_length
               : (double)NAN;
}
