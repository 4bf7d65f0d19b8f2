/* SPDX-License-Identifier: MIT
 *
 * Sparsification plots: Nair et al. 2013, section 5.2.2; the oracle is that of Haeusler, Nair and Kondermann 2013.
 */
#include <cubemap/depth_error.h>

#include "modules/memory/checked_size.h"
#include "depth_error_pair.h"

#include <stdlib.h>

/* A pixel: it is kept the longer the greater its rank is. */
typedef struct ranked
{
    double rank;
    double value; /* what is averaged */
} ranked;

static int compare(const void *first, const void *second)
{
    const ranked *a = first, *b = second;
    if (a->rank != b->rank)
    {
        return a->rank > b->rank ? -1 : 1;
    }
    return (a->value > b->value) -
           (a->value < b->value); /* so that sums are the same in any order */
}

/* Sums of the first k of them, k from 0 to count. Pixels of one rank count by their mean. */
static void add_up(ranked *pixel, size_t count, double *sum)
{
    cm_error_sum total = {0.0, 0.0};
    qsort(pixel, count, sizeof *pixel, compare);
    sum[0] = 0.0;
    for (size_t i = 0; i < count;)
    {
        const double before = sum[i];
        size_t end = i;
        for (; end < count && pixel[end].rank == pixel[i].rank; end++)
        {
            cm_error_add(&total, pixel[end].value);
        }
        const double mean = (cm_error_total(&total) - before) / (double)(end - i);
        for (size_t k = i + 1; k <= end; k++)
        {
            sum[k] = before + mean * (double)(k - i);
        }
        sum[end] = cm_error_total(&total);
        i = end;
    }
}

/* The error of so many pixels that are left, and parts of one. */
static double error_of(const double *sum, size_t count, double left, int is_square)
{
    const size_t whole = (size_t)left < count ? (size_t)left : count - 1;
    const double part = left - (double)whole;
    const double mean = (sum[whole] + part * (sum[whole + 1] - sum[whole])) / left;
    return is_square ? sqrt(fmax(mean, 0.0)) : mean;
}

static void make_curve(const double *sum, size_t pixels, int is_square, size_t count,
                       const double *fraction, double *curve)
{
    for (size_t i = 0; i < count && curve != NULL; i++)
    {
        curve[i] = error_of(sum, pixels, (double)pixels * (1.0 - fraction[i]), is_square);
    }
}

/* The mean over all numbers of pixels that can be left. */
static double area_between(const double *sum, const double *best, size_t count, int is_square)
{
    const double all = error_of(sum, count, (double)count, is_square);
    cm_error_sum area = {0.0, 0.0};
    for (size_t k = 1; k <= count; k++)
    {
        cm_error_add(&area, error_of(sum, count, (double)k, is_square) -
                                error_of(best, count, (double)k, is_square));
    }
    return all > 0.0 ? cm_error_total(&area) / ((double)count * all) : 0.0;
}

static size_t collect(size_t n, const float *depth, const float *truth, const float *confidence,
                      int is_square, ranked *pixel)
{
    size_t count = 0;
    for (size_t i = 0; i < n; i++)
    {
        if (cm_error_counts(depth[i], truth[i]) && !isnan(confidence[i]))
        {
            const double error = fabs(cm_error_of(depth[i], truth[i]));
            pixel[count].rank = (double)confidence[i];
            pixel[count++].value = is_square ? error * error : error;
        }
    }
    return count;
}

static int are_fractions(size_t count, const double *fraction)
{
    for (size_t i = 0; i < count; i++)
    {
        if (!(fraction[i] >= 0.0 && fraction[i] < 1.0))
        {
            return 0;
        }
    }
    return 1;
}

cm_status cm_depth_error_sparsify(size_t n, const float *depth, const float *truth,
                                  const float *confidence, cm_sparsification_measure measure,
                                  size_t count, const double *fraction, double *error,
                                  double *oracle, double *area)
{
    if ((n > 0 && (depth == NULL || truth == NULL || confidence == NULL)) ||
        (count > 0 && fraction == NULL))
    {
        return CM_ERROR_ARGUMENT;
    }
    const int is_square = measure == CM_SPARSIFICATION_RMSE;
    if ((!is_square && measure != CM_SPARSIFICATION_MAE) || !are_fractions(count, fraction))
    {
        return CM_ERROR_RANGE;
    }
    ranked *pixel = cm_array_of(n + 1, sizeof *pixel);
    double *sum = cm_array_of(n + 1, 2 * sizeof *sum);
    const size_t pixels =
        pixel == NULL || sum == NULL ? 0 : collect(n, depth, truth, confidence, is_square, pixel);
    if (pixels > 0)
    {
        double *best = sum + n + 1;
        add_up(pixel, pixels, sum);
        for (size_t i = 0; i < pixels; i++)
        {
            pixel[i].rank = -pixel[i].value;
        }
        add_up(pixel, pixels, best);
        make_curve(sum, pixels, is_square, count, fraction, error);
        make_curve(best, pixels, is_square, count, fraction, oracle);
        if (area != NULL)
        {
            *area = area_between(sum, best, pixels, is_square);
        }
    }
    const int has_memory = pixel != NULL && sum != NULL;
    free(pixel);
    free(sum);
    return !has_memory ? CM_ERROR_MEMORY : pixels == 0 ? CM_ERROR_RANK : CM_OK;
}
