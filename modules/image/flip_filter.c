/* SPDX-License-Identifier: MIT */
#include "flip_filter.h"

#include <math.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

/* Contrast sensitivity: sums of a sqrt(pi / b) exp(-pi^2 d^2 / b), d in degrees (section 4.1.1, table 1). */
static const double b_luminance = 0.0047;
static const double b_red_green = 0.0053;
static const double a_blue_yellow[2] = {34.1, 13.5};
static const double b_blue_yellow[2] = {0.04, 0.025};

/* From peak to trough of the edge detector, in degrees (section 4.2). */
static const double feature_width = 0.082;

/* The sum of both sides and the middle. */
static double sum_of(const cm_flip_half k, size_t radius)
{
    double sum = 0.0;
    for (size_t j = radius; j >= 1; j--)
    {
        sum += 2.0 * k[j];
    }
    return sum + k[0];
}

static void scale(cm_flip_half k, size_t radius, double factor)
{
    for (size_t j = 0; j <= radius; j++)
    {
        k[j] *= factor;
    }
}

/* exp(-j^2 / (2 sd^2)). */
static void make_gaussian(double sd, size_t radius, cm_flip_half k)
{
    for (size_t j = 0; j <= radius; j++)
    {
        const double place = (double)j / sd;
        k[j] = exp(-0.5 * place * place);
    }
}

/* The standard deviation in pixels of exp(-pi^2 d^2 / b). */
static double deviation(double b, double pixels_per_degree)
{
    return sqrt(b / 2.0) / pi * pixels_per_degree;
}

static void make_colors(double pixels_per_degree, cm_flip_filters *filters)
{
    const size_t radius = filters->radius;
    double sum[2];
    make_gaussian(deviation(b_luminance, pixels_per_degree), radius, filters->luminance);
    scale(filters->luminance, radius, 1.0 / sum_of(filters->luminance, radius));
    make_gaussian(deviation(b_red_green, pixels_per_degree), radius, filters->red_green);
    scale(filters->red_green, radius, 1.0 / sum_of(filters->red_green, radius));
    for (int i = 0; i < 2; i++)
    {
        double *const k = filters->blue_yellow[i];
        make_gaussian(deviation(b_blue_yellow[i], pixels_per_degree), radius, k);
        scale(k, radius, sqrt(a_blue_yellow[i] * sqrt(pi / b_blue_yellow[i])));
        sum[i] = sum_of(k, radius);
    }
    for (int i = 0; i < 2; i++)
    {
        scale(filters->blue_yellow[i], radius, 1.0 / sqrt(sum[0] * sum[0] + sum[1] * sum[1]));
    }
}

/* Signs of the products with the Gaussian are those along one axis, so sums to 1 are made there. Exponents are relative
 * to the first pixel's, since at few pixels per degree all but the middle would be 0. */
static void make_features(double pixels_per_degree, cm_flip_filters *filters)
{
    const double sd = 0.5 * feature_width * pixels_per_degree;
    const size_t radius = filters->feature_radius;
    double above = 0.0, below = 1.0;
    double sum = 0.0;
    make_gaussian(sd, radius, filters->blur);
    scale(filters->blur, radius, 1.0 / sum_of(filters->blur, radius));
    filters->edge[0] = 0.0;
    filters->point[0] = -1.0;
    for (size_t j = 1; j <= radius; j++)
    {
        const double place = (double)j / sd;
        const double relative = exp(-0.5 * (place * place - 1.0 / (sd * sd)));
        const double second = place * place - 1.0;
        filters->edge[j] = (double)j * relative;
        filters->point[j] = second * (second > 0.0 ? relative : exp(-0.5 * place * place));
        sum += filters->edge[j];
        above += second > 0.0 ? 2.0 * filters->point[j] : 0.0;
        below -= second > 0.0 ? 0.0 : 2.0 * filters->point[j];
    }
    scale(filters->edge, radius, 1.0 / sum);
    for (size_t j = 0; j <= radius; j++)
    {
        filters->point[j] /= filters->point[j] > 0.0 ? above : below;
    }
}

void cm_flip_make_filters(double pixels_per_degree, cm_flip_filters *filters)
{
    memset(filters, 0, sizeof *filters);
    filters->radius = (size_t)ceil(3.0 * deviation(b_blue_yellow[0], pixels_per_degree));
    filters->feature_radius = (size_t)ceil(3.0 * (0.5 * feature_width * pixels_per_degree));
    make_colors(pixels_per_degree, filters);
    make_features(pixels_per_degree, filters);
}
