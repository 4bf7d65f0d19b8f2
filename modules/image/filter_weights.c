/* SPDX-License-Identifier: MIT
 *
 * The weights of filters, from their formulas.
 */
#include "filter_weights.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#define PI 3.14159265358979323846

/* D. P. Mitchell, A. N. Netravali, Reconstruction filters in computer graphics, SIGGRAPH 1988, equation 8. */
static double cubic(double x, double b, double c)
{
    if (x < 1.0)
    {
        return ((12.0 - 9.0 * b - 6.0 * c) * x * x * x + (-18.0 + 12.0 * b + 6.0 * c) * x * x +
                (6.0 - 2.0 * b)) /
               6.0;
    }
    return ((-b - 6.0 * c) * x * x * x + (6.0 * b + 30.0 * c) * x * x + (-12.0 * b - 48.0 * c) * x +
            (8.0 * b + 24.0 * c)) /
           6.0;
}

/* E. Catmull, R. Rom, A class of local interpolating splines, 1974; in the family above B = 0, C = 1/2. */
static double catmull_rom(double x)
{
    return cubic(x, 0.0, 0.5);
}

static double mitchell(double x)
{
    return cubic(x, 1.0 / 3.0, 1.0 / 3.0);
}

/* C. E. Duchon, Lanczos filtering in one and two dimensions, Journal of Applied Meteorology 18, 1979: sinc x times
 * sinc (x / 3), here for |x| < 3. At whole numbers it is 1 or 0 to the bit. */
static double lanczos3(double x)
{
    if (x == floor(x))
    {
        return x == 0.0 ? 1.0 : 0.0;
    }
    return 3.0 * sin(PI * x) * sin(PI * x / 3.0) / (PI * PI * x * x);
}

/* H. Dersch, Panorama Tools, interpolator spline36: the natural cubic spline through six points. */
static double spline36(double x)
{
    if (x < 1.0)
    {
        return ((13.0 / 11.0 * x - 453.0 / 209.0) * x - 3.0 / 209.0) * x + 1.0;
    }
    if (x < 2.0)
    {
        x -= 1.0;
        return ((-6.0 / 11.0 * x + 270.0 / 209.0) * x - 156.0 / 209.0) * x;
    }
    x -= 2.0;
    return ((1.0 / 11.0 * x - 45.0 / 209.0) * x + 26.0 / 209.0) * x;
}

/* I. J. Schoenberg, Contributions to the problem of approximation of equidistant data by analytic functions, 1946:
 * the sum of (-1)^k binomial(6, k) max(x + 3 - k, 0)^5 / 120, piece by piece. */
static double bspline5(double x)
{
    if (x < 1.0)
    {
        return 11.0 / 20.0 + x * x * (-1.0 / 2.0 + x * x * (1.0 / 4.0 - x / 12.0));
    }
    if (x < 2.0)
    {
        return 17.0 / 40.0 +
               x * (5.0 / 8.0 +
                    x * (-7.0 / 4.0 + x * (5.0 / 4.0 + x * (-3.0 / 8.0 + x * (1.0 / 24.0)))));
    }
    return x < 3.0 ? pow(3.0 - x, 5.0) / 120.0 : 0.0;
}

typedef double kernel_function(double x);

static kernel_function *function_of(cm_filter filter)
{
    switch (filter)
    {
    case CM_FILTER_CATMULL_ROM:
        return catmull_rom;
    case CM_FILTER_MITCHELL:
        return mitchell;
    case CM_FILTER_LANCZOS3:
        return lanczos3;
    case CM_FILTER_SPLINE36:
        return spline36;
    case CM_FILTER_BSPLINE5:
        return bspline5;
    default:
        return NULL;
    }
}

unsigned cm_filter_taps(cm_filter filter)
{
    if (function_of(filter) == NULL)
    {
        return 0;
    }
    return filter == CM_FILTER_CATMULL_ROM || filter == CM_FILTER_MITCHELL ? 4 : 6;
}

void cm_filter_weights(cm_filter filter, double t, double weights[CM_FILTER_TAPS_MAX])
{
    kernel_function *function = function_of(filter);
    const unsigned taps = cm_filter_taps(filter);
    double sum = 0.0;
    for (unsigned i = 0; i < taps; i++)
    {
        weights[i] = function(fabs((double)i - (taps / 2 - 1.0) - t));
        sum += weights[i];
    }
    for (unsigned i = 0; i < taps; i++)
    {
        weights[i] /= sum;
    }
}

/* Whole weights whose sum is exact: the largest takes what rounding left. */
static void round_weights(unsigned taps, const double *weights, int16_t *whole)
{
    int left = CM_FILTER_ONE;
    unsigned largest = 0;
    for (unsigned i = 0; i < taps; i++)
    {
        whole[i] = (int16_t)lround(weights[i] * CM_FILTER_ONE);
        left -= whole[i];
        largest = weights[i] > weights[largest] ? i : largest;
    }
    whole[largest] = (int16_t)(whole[largest] + left);
}

void cm_filter_table_fill(cm_filter filter, cm_filter_table *table)
{
    const unsigned taps = cm_filter_taps(filter);
    memset(table, 0, sizeof *table);
    for (int s = 0; s < CM_FILTER_SEGMENTS; s++)
    {
        double at[3][CM_FILTER_TAPS_MAX];
        for (int k = 0; k < 3; k++)
        {
            cm_filter_weights(filter, (s + 0.5 * k) / CM_FILTER_SEGMENTS, at[k]);
        }
        for (unsigned i = 0; i < taps; i++)
        {
            const double bend = 2.0 * (at[0][i] - 2.0 * at[1][i] + at[2][i]);
            table->segments[s][0][i] = (float)at[0][i];
            table->segments[s][1][i] = (float)(at[2][i] - at[0][i] - bend);
            table->segments[s][2][i] = (float)bend;
        }
    }
    for (int p = 0; p <= CM_FILTER_PHASES; p++)
    {
        double weights[CM_FILTER_TAPS_MAX];
        cm_filter_weights(filter, (double)p / CM_FILTER_PHASES, weights);
        round_weights(taps, weights, table->whole[p]);
        for (unsigned i = 0; i < taps; i++)
        {
            table->real[p][i] = (float)weights[i];
        }
    }
}
