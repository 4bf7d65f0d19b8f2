/* SPDX-License-Identifier: MIT
 *
 * CIELAB, and CIEDE2000: G. Sharma, W. Wu, E. N. Dalal, The CIEDE2000 color-difference formula: implementation
 * notes, supplementary test data, and mathematical observations, Color Research and Application 30, 2005. Letters
 * are the paper's.
 */
#include "color_spaces.h"

#include <cubemap/colormap.h>

#include <math.h>

/* CIE 15:2004, 8.2.1. */
static double root_of(double part)
{
    return part > 216.0 / 24389.0 ? cbrt(part) : (24389.0 / 27.0 * part + 16.0) / 116.0;
}

void cm_colormap_lab_from_linear(const double linear[3], double lab[3])
{
    double xyz[3];
    cm_colormap_xyz_from_linear(linear, xyz);
    const double x = root_of(xyz[0] / CM_COLORMAP_WHITE_X);
    const double y = root_of(xyz[1]);
    const double z = root_of(xyz[2] / CM_COLORMAP_WHITE_Z);
    lab[0] = 116.0 * y - 16.0;
    lab[1] = 500.0 * (x - y);
    lab[2] = 200.0 * (y - z);
    if (!isfinite(lab[0] + lab[1] + lab[2]))
    {
        lab[0] = lab[1] = lab[2] = (double)NAN;
    }
}

static double of_degrees(double (*function)(double), double degrees)
{
    return function(degrees * (CM_COLORMAP_PI / 180.0));
}

/* sqrt(C^7 / (C^7 + 25^7)) */
static double saturate(double chroma)
{
    const double third = chroma * chroma * chroma;
    const double seventh = third * third * chroma;
    return isfinite(seventh) ? sqrt(seventh / (seventh + 6103515625.0)) : 1.0;
}

static double hue_of(double a, double b)
{
    const double hue = atan2(b, a) * (180.0 / CM_COLORMAP_PI);
    return hue < 0.0 ? hue + 360.0 : hue;
}

/* From hue to hue the shorter way, in degrees. Of opposite ones, whose cross product is 0, rounding of the angles must
 * not say which way is the shorter: that from the smaller to the larger is. */
static double turn_between(const double one[2], const double other[2])
{
    const double cross = one[0] * other[1] - one[1] * other[0];
    const double along = one[0] * other[0] + one[1] * other[1];
    if (cross == 0.0 && along < 0.0)
    {
        return hue_of(other[0], other[1]) > hue_of(one[0], one[1]) ? 180.0 : -180.0;
    }
    return atan2(cross, along) * (180.0 / CM_COLORMAP_PI);
}

/* S_H without the chroma: T of the mean hue. */
static double hue_weight(double hue)
{
    return 1.0 - 0.17 * of_degrees(cos, hue - 30.0) + 0.24 * of_degrees(cos, 2.0 * hue) +
           0.32 * of_degrees(cos, 3.0 * hue + 6.0) - 0.20 * of_degrees(cos, 4.0 * hue - 63.0);
}

/* R_T, which turns the ellipse of what looks the same in blue. */
static double rotation(double chroma, double hue)
{
    const double away = (hue - 275.0) / 25.0;
    return -2.0 * saturate(chroma) * of_degrees(sin, 60.0 * exp(-away * away));
}

double cm_colormap_ciede2000(const double one[3], const double other[3])
{
    const double stretch =
        1.5 - 0.5 * saturate(0.5 * (hypot(one[1], one[2]) + hypot(other[1], other[2])));
    const double from[2] = {stretch * one[1], one[2]};
    const double to[2] = {stretch * other[1], other[2]};
    const double from_chroma = hypot(from[0], from[1]);
    const double to_chroma = hypot(to[0], to[1]);
    const double chroma = 0.5 * (from_chroma + to_chroma);
    const int has_hues = from_chroma > 0.0 && to_chroma > 0.0;
    const double turn = has_hues ? turn_between(from, to) : 0.0;
    /* the hue of black is 0, so that the sum is the other's */
    const double sum = (from_chroma > 0.0 ? hue_of(from[0], from[1]) : 0.0) +
                       (to_chroma > 0.0 ? hue_of(to[0], to[1]) : 0.0);
    const double half_way = hue_of(from[0], from[1]) + 0.5 * turn;
    const double hue = has_hues ? half_way - 360.0 * floor(half_way / 360.0) : sum;
    const double away = (0.5 * (one[0] + other[0]) - 50.0) * (0.5 * (one[0] + other[0]) - 50.0);
    const double l = (other[0] - one[0]) / (1.0 + 0.015 * away / sqrt(20.0 + away));
    const double c = (to_chroma - from_chroma) / (1.0 + 0.045 * chroma);
    const double h = 2.0 * sqrt(from_chroma * to_chroma) * of_degrees(sin, 0.5 * turn) /
                     (1.0 + 0.015 * chroma * hue_weight(hue));
    const double square = l * l + c * c + h * h + rotation(chroma, hue) * c * h;
    return isfinite(square) ? sqrt(square) : (double)NAN;
}
