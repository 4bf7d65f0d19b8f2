/* SPDX-License-Identifier: MIT */
#include "own_flip.h"

#include <math.h>
#include <stdlib.h>

static const double pi = 3.14159265358979323846;

/* The matrix that the authors give, rows X, Y, Z. */
static const double to_xyz[3][3] = {
    {0.4123865632529916, 0.35759149092062535, 0.18045049120356364},
    {0.21263682167732384, 0.7151829818412507, 0.07218019648142547},
    {0.019330620152483984, 0.11919716364020845, 0.9503725870054354},
};

typedef struct color
{
    double c[3];
} color;

static color times(const double matrix[3][3], color from)
{
    color to;
    for (int i = 0; i < 3; i++)
    {
        to.c[i] = matrix[i][0] * from.c[0] + matrix[i][1] * from.c[1] + matrix[i][2] * from.c[2];
    }
    return to;
}

static color white(void)
{
    return times(to_xyz, (color){{1, 1, 1}});
}

/* The light that has this XYZ, by Cramer's rule. */
static color solve(color xyz)
{
    color light;
    double determinant[4];
    for (int k = 0; k < 4; k++)
    {
        double m[3][3];
        for (int i = 0; i < 3; i++)
        {
            for (int j = 0; j < 3; j++)
            {
                m[i][j] = j == k - 1 ? xyz.c[i] : to_xyz[i][j];
            }
        }
        determinant[k] = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                         m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
    }
    for (int i = 0; i < 3; i++)
    {
        light.c[i] = determinant[i + 1] / determinant[0];
    }
    return light;
}

static color opponent_of(color light)
{
    const color xyz = times(to_xyz, light);
    const double x = xyz.c[0] / white().c[0];
    const double y = xyz.c[1] / white().c[1];
    const double z = xyz.c[2] / white().c[2];
    return (color){{116 * y - 16, 500 * (x - y), 200 * (y - z)}};
}

static color light_of(color opponent)
{
    const double y = (opponent.c[0] + 16) / 116;
    const color xyz = {{(y + opponent.c[1] / 500) * white().c[0], y * white().c[1],
                        (y - opponent.c[2] / 200) * white().c[2]}};
    return solve(xyz);
}

static double f(double t)
{
    const double delta = 6.0 / 29.0;
    return t > delta * delta * delta ? pow(t, 1.0 / 3.0) : t / (3 * delta * delta) + 4.0 / 29.0;
}

static color hunt_of(color light)
{
    const color xyz = times(to_xyz, light);
    const double x = f(xyz.c[0] / white().c[0]);
    const double y = f(xyz.c[1] / white().c[1]);
    const double z = f(xyz.c[2] / white().c[2]);
    const double lightness = 116 * y - 16;
    return (color){{lightness, lightness / 100 * 500 * (x - y), lightness / 100 * 200 * (y - z)}};
}

static double hyab(color one, color other)
{
    return fabs(one.c[0] - other.c[0]) + hypot(one.c[1] - other.c[1], one.c[2] - other.c[2]);
}

/* One number of the pixel that is nearest to a place. */
static double at(size_t width, size_t height, const double *plane, long x, long y)
{
    x = x < 0 ? 0 : x >= (long)width ? (long)width - 1 : x;
    y = y < 0 ? 0 : y >= (long)height ? (long)height - 1 : y;
    return plane[(size_t)y * width + (size_t)x];
}

/* Weights of a filter, (2 r + 1)^2 of them. */
typedef double (*weight_of)(double x, double y, double parameter);

static double sensitivity_luminance(double x, double y, double unused)
{
    (void)unused;
    return sqrt(pi / 0.0047) * exp(-pi * pi * (x * x + y * y) / 0.0047);
}

static double sensitivity_red_green(double x, double y, double unused)
{
    (void)unused;
    return sqrt(pi / 0.0053) * exp(-pi * pi * (x * x + y * y) / 0.0053);
}

static double sensitivity_blue_yellow(double x, double y, double unused)
{
    (void)unused;
    const double z = pi * pi * (x * x + y * y);
    return 34.1 * sqrt(pi / 0.04) * exp(-z / 0.04) + 13.5 * sqrt(pi / 0.025) * exp(-z / 0.025);
}

static double edge_along_x(double x, double y, double sd)
{
    return -x * exp(-(x * x + y * y) / (2 * sd * sd));
}

static double edge_along_y(double x, double y, double sd)
{
    return edge_along_x(y, x, sd);
}

static double point_along_x(double x, double y, double sd)
{
    return (x * x / (sd * sd) - 1) * exp(-(x * x + y * y) / (2 * sd * sd));
}

static double point_along_y(double x, double y, double sd)
{
    return point_along_x(y, x, sd);
}

/* The sums of what is above and below 0 become 1 and -1. */
static void filter(size_t width, size_t height, const double *plane, weight_of weight, long radius,
                   double unit, double parameter, double *to)
{
    double above = 0, below = 0;
    for (long y = -radius; y <= radius; y++)
    {
        for (long x = -radius; x <= radius; x++)
        {
            const double w = weight((double)x * unit, (double)y * unit, parameter);
            above += w > 0 ? w : 0;
            below -= w < 0 ? w : 0;
        }
    }
    for (size_t i = 0; i < width * height; i++)
    {
        double sum = 0;
        for (long y = -radius; y <= radius; y++)
        {
            for (long x = -radius; x <= radius; x++)
            {
                const double w = weight((double)x * unit, (double)y * unit, parameter);
                sum += w /
                       (w > 0   ? above
                        : w < 0 ? below
                                : 1) *
                       at(width, height, plane, (long)(i % width) + x, (long)(i / width) + y);
            }
        }
        to[i] = sum;
    }
}

/* What a picture looks like: 3 numbers of colour, the sizes of edges and of points, each a plane. */
static void look(size_t width, size_t height, const double *light, double pixels_per_degree,
                 double *planes)
{
    static const weight_of sensitivity[3] = {sensitivity_luminance, sensitivity_red_green,
                                             sensitivity_blue_yellow};
    static const weight_of feature[4] = {edge_along_x, edge_along_y, point_along_x, point_along_y};
    const size_t n = width * height;
    const long radius = (long)ceil(3 * sqrt(0.04 / (2 * pi * pi)) * pixels_per_degree);
    const double sd = 0.5 * 0.082 * pixels_per_degree;
    double *const opponent = malloc(8 * n * sizeof *opponent);
    double *const luminance = opponent + 3 * n;
    double *const features = luminance + n;
    for (size_t i = 0; i < n; i++)
    {
        const color found =
            opponent_of((color){{light[3 * i], light[3 * i + 1], light[3 * i + 2]}});
        for (size_t c = 0; c < 3; c++)
        {
            opponent[c * n + i] = found.c[c];
        }
        luminance[i] = (found.c[0] + 16) / 116;
    }
    for (size_t c = 0; c < 3; c++)
    {
        filter(width, height, opponent + c * n, sensitivity[c], radius, 1 / pixels_per_degree, 0,
               planes + c * n);
    }
    for (size_t k = 0; k < 4; k++)
    {
        filter(width, height, luminance, feature[k], (long)ceil(3 * sd), 1, sd,
               features + k % 2 * n);
        for (size_t i = 0; k % 2 == 1 && i < n; i++)
        {
            planes[(3 + k / 2) * n + i] = hypot(features[i], features[n + i]);
        }
    }
    for (size_t i = 0; i < n; i++)
    {
        color seen = light_of((color){{planes[i], planes[n + i], planes[2 * n + i]}});
        for (size_t c = 0; c < 3; c++)
        {
            seen.c[c] = fmin(fmax(seen.c[c], 0), 1);
        }
        seen = hunt_of(seen);
        for (size_t c = 0; c < 3; c++)
        {
            planes[c * n + i] = seen.c[c];
        }
    }
    free(opponent);
}

void own_flip(size_t width, size_t height, const double *one, const double *other,
              double pixels_per_degree, double *flip)
{
    const size_t n = width * height;
    double *const planes = malloc(10 * n * sizeof *planes);
    const double *const again = planes + 5 * n;
    const double most = pow(hyab(hunt_of((color){{0, 1, 0}}), hunt_of((color){{0, 0, 1}})), 0.7);
    look(width, height, one, pixels_per_degree, planes);
    look(width, height, other, pixels_per_degree, planes + 5 * n);
    for (size_t i = 0; i < n; i++)
    {
        const color a = {{planes[i], planes[n + i], planes[2 * n + i]}};
        const color b = {{again[i], again[n + i], again[2 * n + i]}};
        const double power = pow(hyab(a, b), 0.7);
        const double colors = power < 0.4 * most
                                  ? 0.95 / (0.4 * most) * power
                                  : 0.95 + (power - 0.4 * most) / (most - 0.4 * most) * 0.05;
        const double features = fmax(fabs(planes[3 * n + i] - again[3 * n + i]),
                                     fabs(planes[4 * n + i] - again[4 * n + i]));
        flip[i] = pow(colors, 1 - pow(features / sqrt(2), 0.5));
    }
    free(planes);
}

double own_tone(double light, double exposure)
{
    const double x = fmax(light, 0) * pow(2, exposure) * 0.6;
    return fmin((x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14), 1);
}
