/* SPDX-License-Identifier: MIT */
#include "flip_color.h"

#include <cubemap/srgb.h>

#include <math.h>

/* To XYZ of sRGB over that of its white, so that each row's sum is 1, and back: both in exact fractions. */
static const double xyz_from_linear[3][3] = {
    {10135552.0 / 23359437.0, 8788810.0 / 23359437.0, 4435075.0 / 23359437.0},
    {871024.0 / 4096299.0, 8788810.0 / 12288897.0, 887015.0 / 12288897.0},
    {158368.0 / 8920923.0, 8788810.0 / 80288307.0, 70074185.0 / 80288307.0},
};
static const double linear_from_xyz[3][3] = {
    {1219569.0 / 395920.0, -608687.0 / 395920.0, -107481.0 / 197960.0},
    {-80960619.0 / 87888100.0, 82435961.0 / 43944050.0, 3976797.0 / 87888100.0},
    {93813.0 / 1774030.0, -180961.0 / 887015.0, 107481.0 / 93370.0},
};

/* The curve is (x^2 k0 + x k1) / (x^2 k3 + x k4 + k5), x first times 1 / 0.6. */
static const double k0 = 0.36 * 2.51;
static const double k1 = 0.6 * 0.03;
static const double k3 = 0.36 * 2.43;
static const double k4 = 0.6 * 0.59;
static const double k5 = 0.14;

static const double color_exponent = 0.7; /* q_c */
static const double share = 0.4;          /* p_c, of the greatest difference */
static const double share_value = 0.95;   /* p_t, what that becomes */

static double clamp(double value)
{
    return value < 0.0 ? 0.0 : value > 1.0 ? 1.0 : value; /* NaN stays */
}

static double product(const double row[3], const double vector[3])
{
    return row[0] * vector[0] + row[1] * vector[1] + row[2] * vector[2];
}

double cm_flip_linear_from_srgb(double value)
{
    return cm_light_from_srgb(clamp(value));
}

double cm_flip_tone(double value)
{
    return clamp(value * (value * k0 + k1) / (value * (value * k3 + k4) + k5));
}

double cm_flip_tone_inverse(double value)
{
    const double a = k0 - k3 * value;
    const double b = k1 - k4 * value;
    const double c = -k5 * value;
    return (-b + sqrt(b * b - 4.0 * a * c)) / (2.0 * a);
}

void cm_flip_opponent_from_linear(const double linear[3], double opponent[3])
{
    const double x = product(xyz_from_linear[0], linear);
    const double y = product(xyz_from_linear[1], linear);
    const double z = product(xyz_from_linear[2], linear);
    opponent[0] = 116.0 * y - 16.0;
    opponent[1] = 500.0 * (x - y);
    opponent[2] = 200.0 * (y - z);
}

/* CIE 15:2004, 8.2.1. */
static double lab_root(double value)
{
    return value > 216.0 / 24389.0 ? cbrt(value) : value * (841.0 / 108.0) + 4.0 / 29.0;
}

static void hunt_from_linear(const double linear[3], double hunt[3])
{
    const double x = lab_root(product(xyz_from_linear[0], linear));
    const double y = lab_root(product(xyz_from_linear[1], linear));
    const double z = lab_root(product(xyz_from_linear[2], linear));
    hunt[0] = 116.0 * y - 16.0;
    hunt[1] = 0.01 * hunt[0] * (500.0 * (x - y));
    hunt[2] = 0.01 * hunt[0] * (200.0 * (y - z));
}

void cm_flip_hunt_from_opponent(const double opponent[3], double hunt[3])
{
    const double y = (opponent[0] + 16.0) / 116.0;
    const double xyz[3] = {y + opponent[1] / 500.0, y, y - opponent[2] / 200.0};
    double linear[3];
    for (int i = 0; i < 3; i++)
    {
        linear[i] = clamp(product(linear_from_xyz[i], xyz));
    }
    hunt_from_linear(linear, hunt);
}

static double hyab(const double one[3], const double other[3])
{
    const double a = one[1] - other[1];
    const double b = one[2] - other[2];
    return fabs(one[0] - other[0]) + sqrt(a * a + b * b);
}

double cm_flip_greatest_difference(void)
{
    static const double linear_green[3] = {0.0, 1.0, 0.0};
    static const double linear_blue[3] = {0.0, 0.0, 1.0};
    double green[3], blue[3];
    hunt_from_linear(linear_green, green);
    hunt_from_linear(linear_blue, blue);
    return pow(hyab(green, blue), color_exponent);
}

double cm_flip_color_difference(const double one[3], const double other[3], double greatest)
{
    const double difference = pow(hyab(one, other), color_exponent);
    const double bend = share * greatest;
    return difference < bend
               ? difference * (share_value / bend)
               : share_value + (difference - bend) / (greatest - bend) * (1.0 - share_value);
}
