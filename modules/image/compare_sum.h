/* SPDX-License-Identifier: MIT
 *
 * Sums whose rounding errors are kept (A. Neumaier, Zeitschrift fuer Angewandte Mathematik und Mechanik 54, 1974).
 */
#ifndef IMAGE_COMPARE_SUM_H
#define IMAGE_COMPARE_SUM_H

#include <math.h>

typedef struct cm_compare_sum
{
    double sum;
    double rest;
} cm_compare_sum;

static inline void cm_compare_sum_add(cm_compare_sum *to, double value)
{
    const double sum = to->sum + value;
    to->rest += fabs(to->sum) >= fabs(value) ? (to->sum - sum) + value : (value - sum) + to->sum;
    to->sum = sum;
}

static inline double cm_compare_sum_value(const cm_compare_sum *sum)
{
    return sum->sum + sum->rest;
}

#endif
