/* SPDX-License-Identifier: MIT
 *
 * Pixels of depth and truth that count, and sums of them.
 */
#ifndef MODULES_SIM_DEPTH_ERROR_PAIR_H
#define MODULES_SIM_DEPTH_ERROR_PAIR_H

#include <math.h>
#include <stddef.h>

static inline int cm_error_is_measured(float depth)
{
    return depth > 0.0f && !isinf(depth);
}

static inline int cm_error_counts(float depth, float truth)
{
    return cm_error_is_measured(depth) && cm_error_is_measured(truth);
}

static inline double cm_error_of(float depth, float truth)
{
    return (double)depth - (double)truth;
}

/* A sum with what rounding has lost (Neumaier 1974). */
typedef struct cm_error_sum
{
    double sum, lost;
} cm_error_sum;

static inline void cm_error_add(cm_error_sum *to, double value)
{
    const double sum = to->sum + value;
    to->lost += fabs(to->sum) >= fabs(value) ? (to->sum - sum) + value : (value - sum) + to->sum;
    to->sum = sum;
}

static inline double cm_error_total(const cm_error_sum *of)
{
    return of->sum + of->lost;
}

#endif
