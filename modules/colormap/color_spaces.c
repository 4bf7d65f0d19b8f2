/* SPDX-License-Identifier: MIT
 *
 * XYZ, CIELUV and sRGB, and how much chroma sRGB has.
 */
#include "color_spaces.h"

#include <cubemap/colormap.h>
#include <cubemap/srgb.h>

#include <math.h>

/* u' and v' of the white x = 0.3127, y = 0.3290: 4 x / (-2 x + 12 y + 3) and 9 y / (-2 x + 12 y + 3). */
#define WHITE_U (6254.0 / 31613.0)
#define WHITE_V (14805.0 / 31613.0)

/* From the chromaticities of IEC 61966-2-1, red 0.64, 0.33, green 0.30, 0.60, blue 0.15, 0.06 and that
 * white, in exact fractions; tests/colormap/own_colors.c derives them again. The standard prints them rounded to
 * four digits. */
static const double xyz_from_linear[3][3] = {
    {506752.0 / 1228815.0, 87881.0 / 245763.0, 12673.0 / 70218.0},
    {87098.0 / 409605.0, 175762.0 / 245763.0, 12673.0 / 175545.0},
    {7918.0 / 409605.0, 87881.0 / 737289.0, 1001167.0 / 1053270.0},
};
static const double linear_from_xyz[3][3] = {
    {12831.0 / 3959.0, -329.0 / 214.0, -1974.0 / 3959.0},
    {-851781.0 / 878810.0, 1648619.0 / 878810.0, 36519.0 / 878810.0},
    {705.0 / 12673.0, -2585.0 / 12673.0, 705.0 / 667.0},
};

static double product(const double row[3], double x, double y, double z)
{
    return row[0] * x + row[1] * y + row[2] * z;
}

void cm_colormap_multiply(const double matrix[3][3], const double vector[3], double result[3])
{
    const double x = vector[0], y = vector[1], z = vector[2];
    for (int i = 0; i < 3; i++)
    {
        result[i] = product(matrix[i], x, y, z);
    }
}

void cm_colormap_xyz_from_linear(const double linear[3], double xyz[3])
{
    cm_colormap_multiply(xyz_from_linear, linear, xyz);
}

void cm_colormap_linear_from_xyz(const double xyz[3], double linear[3])
{
    cm_colormap_multiply(linear_from_xyz, xyz, linear);
}

static void set_all(double to[3], double value)
{
    to[0] = to[1] = to[2] = value;
}

/* ---- CIELUV: CIE 15:2004, 8.2.2 ---- */

static double luminance_from_lightness(double lightness)
{
    const double root = (lightness + 16.0) / 116.0;
    return lightness > 8.0 ? root * root * root : lightness * (27.0 / 24389.0);
}

/* 1 - Y, without cancellation near white: 1 - y^3 = (1 - y) (1 + y + y^2). */
static double luminance_left(double lightness)
{
    const double root = (lightness + 16.0) / 116.0;
    return lightness > 8.0 ? (100.0 - lightness) / 116.0 * (1.0 + root + root * root)
                           : 1.0 - luminance_from_lightness(lightness);
}

static double lightness_from_luminance(double luminance)
{
    return luminance > 216.0 / 24389.0 ? 116.0 * cbrt(luminance) - 16.0
                                       : luminance * (24389.0 / 27.0);
}

void cm_colormap_luv_from_lch(const double lch[3], double luv[3])
{
    const double angle = lch[2] * (CM_COLORMAP_PI / 180.0);
    const double chroma = lch[1];
    luv[0] = lch[0];
    luv[1] = chroma * cos(angle);
    luv[2] = chroma * sin(angle);
}

void cm_colormap_lch_from_luv(const double luv[3], double lch[3])
{
    const double angle = atan2(luv[2], luv[1]) * (180.0 / CM_COLORMAP_PI);
    const double chroma = hypot(luv[1], luv[2]);
    lch[0] = luv[0];
    lch[1] = chroma;
    lch[2] = angle < 0.0 ? angle + 360.0 : angle + 0.0;
    if (lch[2] >= 360.0)
    {
        lch[2] = 0.0;
    }
}

void cm_colormap_linear_from_luv(const double luv[3], double linear[3])
{
    const double lightness = luv[0];
    if (lightness == 0.0 && isfinite(luv[1]) && isfinite(luv[2]))
    {
        set_all(linear, 0.0);
        return;
    }
    const double u = WHITE_U + luv[1] / (13.0 * lightness);
    const double v = WHITE_V + luv[2] / (13.0 * lightness);
    if (!(lightness > 0.0 && isfinite(lightness) && isfinite(u) && v > 0.0 && isfinite(v)))
    {
        set_all(linear, (double)NAN);
        return;
    }
    const double scale = luminance_from_lightness(lightness) / (4.0 * v);
    for (int i = 0; i < 3; i++)
    {
        linear[i] =
            scale * product(linear_from_xyz[i], 9.0 * u, 4.0 * v, 12.0 - 3.0 * u - 20.0 * v);
    }
}

void cm_colormap_luv_from_linear(const double linear[3], double luv[3])
{
    double xyz[3];
    cm_colormap_xyz_from_linear(linear, xyz);
    const double x = xyz[0], y = xyz[1], z = xyz[2];
    const double sum = x + 15.0 * y + 3.0 * z;
    if (y == 0.0 && isfinite(sum))
    {
        set_all(luv, 0.0);
    }
    else if (!(y > 0.0 && sum > 0.0 && isfinite(sum)))
    {
        set_all(luv, (double)NAN);
    }
    else
    {
        luv[0] = lightness_from_luminance(y);
        luv[1] = 13.0 * luv[0] * (4.0 * x / sum - WHITE_U);
        luv[2] = 13.0 * luv[0] * (9.0 * y / sum - WHITE_V);
    }
}

/* ---- the transfer function ---- */

void cm_colormap_srgb_from_linear(const double linear[3], double srgb[3])
{
    for (int i = 0; i < 3; i++)
    {
        srgb[i] = isfinite(linear[i]) ? cm_srgb_from_light(linear[i]) : (double)NAN;
    }
}

void cm_colormap_linear_from_srgb(const double srgb[3], double linear[3])
{
    for (int i = 0; i < 3; i++)
    {
        linear[i] = isfinite(srgb[i]) ? cm_light_from_srgb(srgb[i]) : (double)NAN;
    }
}

/* ---- the gamut ---- */

/* With k = C / (13 L), u' = WHITE_U + k cos H and v' = WHITE_V + k sin H, a channel is
 *     Y (4 WHITE_V + k slope) / (4 v'),
 * where slope is its row of linear_from_xyz times (9 cos H, 4 sin H, -3 cos H - 20 sin H); the constant
 * is the same in every channel, because white has Y in all. So "channel >= 0" and "channel <= 1" are
 * linear in k; v' is positive as long as all channels are. */
double cm_colormap_largest_chroma(double lightness, double hue)
{
    if (!(lightness >= 0.0 && lightness <= 100.0 && isfinite(hue)))
    {
        return (double)NAN;
    }
    const double angle = hue * (CM_COLORMAP_PI / 180.0);
    const double cosine = cos(angle);
    const double sine = sin(angle);
    const double luminance = luminance_from_lightness(lightness);
    double most = (double)INFINITY;
    for (int i = 0; i < 3; i++)
    {
        const double slope =
            product(linear_from_xyz[i], 9.0 * cosine, 4.0 * sine, -3.0 * cosine - 20.0 * sine);
        const double rise = luminance * slope - 4.0 * sine;
        if (slope < 0.0)
        {
            most = fmin(most, 4.0 * WHITE_V / -slope);
        }
        if (rise > 0.0)
        {
            most = fmin(most, 4.0 * WHITE_V * luminance_left(lightness) / rise);
        }
    }
    return 13.0 * lightness * most;
}
