/* SPDX-License-Identifier: MIT
 *
 * The hard points: directions and points of a face where formulas for the sphere fail. One generator
 * for tests, fuzzers and benchmarks. Everything is a function of an index, taken modulo the count, so
 * that a failure is found again by its number and a program may walk through all of them or pick.
 *
 * Directions: every combination of
 *   - a base: the centres, edges and corners of the cube's faces (so the poles and the antimeridian),
 *     their diagonals, the mid-lines, the boundary |z| = 2/3 between the polar and the equatorial part
 *     of healpix, and where two kernels change their formula (|p| or |q| = 1/2, |q/p| = 1/2);
 *   - for each component a step from it: none, one ulp, 1e-15, 1e-12, 1e-8, 1e-4, both ways;
 *   - a scale: 1, 3, 1e300, 1e-300, and one that makes the components subnormal;
 * and then directions whose components are any of 0, subnormal, 1e-300, ..., 1, ..., 1e300, the largest.
 *
 * Points of a face: u and v are any of the same kind of values in [-1, 1], one ulp beyond included
 * (which the inverse must take as the edge); or v is a step from u, from u / 2 or from twice u.
 *
 * In float the steps and sizes are those of a float: 1e-7 and 1e-6 for 1e-15 and 1e-12, 1e-38 and 1e38
 * for 1e-300 and 1e300.
 */
#ifndef TRUTH_HARD_POINTS_H
#define TRUTH_HARD_POINTS_H

#include <float.h>
#include <math.h>
#include <stddef.h>
#include <stdint.h>

enum
{
    HARD_STEPS = 11,
    HARD_SCALES = 5,
    HARD_BASES_ON_CUBE = 343, /* 7 values a component */
    HARD_BASES_ON_BOUNDARY = 36,
    HARD_BASES = HARD_BASES_ON_CUBE + HARD_BASES_ON_BOUNDARY,
    HARD_SIZES = 23,
    HARD_NEAR = HARD_BASES * HARD_STEPS * HARD_STEPS * HARD_STEPS * HARD_SCALES,
    /* of directions; some of the first kind occur more than once, none is left out */
    HARD_DIRECTIONS = HARD_NEAR + HARD_SIZES * HARD_SIZES * HARD_SIZES,

    HARD_COORDINATES = 8 * HARD_STEPS + HARD_SIZES,
    HARD_POINTS_BESIDE = HARD_COORDINATES * 6 * HARD_STEPS,
    /* of points of a face */
    HARD_POINTS = HARD_COORDINATES * HARD_COORDINATES + HARD_POINTS_BESIDE
};

/* The next digit of a number in mixed radix. */
static inline size_t hard_digit(uint64_t *index, size_t radix)
{
    size_t digit = (size_t)(*index % radix);
    *index /= radix;
    return digit;
}

/* One of HARD_STEPS steps from a value. */
static inline double hard_step(double value, size_t which)
{
    static const double steps[] = {1e-15, 1e-12, 1e-8, 1e-4};
    double sign = which % 2 == 0 ? 1.0 : -1.0;
    if (which == 0)
    {
        return value;
    }
    if (which <= 2)
    {
        return nextafter(value, sign * INFINITY);
    }
    return value + sign * steps[(which - 3) / 2];
}

static inline float hard_step_f32(float value, size_t which)
{
    static const float steps[] = {1e-7f, 1e-6f, 1e-5f, 1e-3f};
    float sign = which % 2 == 0 ? 1.0f : -1.0f;
    if (which == 0)
    {
        return value;
    }
    if (which <= 2)
    {
        return nextafterf(value, sign * INFINITY);
    }
    return value + sign * steps[(which - 3) / 2];
}

static inline void hard_base(size_t which, double base[3])
{
    static const double values[] = {0.0, 1.0, -1.0, 0.5, -0.5, 0.3, -0.3};
    uint64_t digits = which;
    if (which < HARD_BASES_ON_CUBE)
    {
        for (int k = 0; k < 3; k++)
        {
            base[k] = values[hard_digit(&digits, sizeof values / sizeof values[0])];
        }
        return;
    }
    /* |z| = 2/3 on meridians every 20 degrees, the ends and middles of healpix's sectors moved to
     * every second of them */
    size_t meridian = (which - HARD_BASES_ON_CUBE) / 2;
    double lon = (double)meridian * (3.14159265358979323846 / 9.0);
    if (meridian % 2 == 0)
    {
        lon = (double)(meridian / 2 % 8) * (3.14159265358979323846 / 4.0);
    }
    base[0] = sqrt(5.0 / 9.0) * cos(lon);
    base[1] = sqrt(5.0 / 9.0) * sin(lon);
    base[2] = which % 2 == 0 ? 2.0 / 3.0 : -2.0 / 3.0;
}

static inline double hard_size(size_t which)
{
    static const double sizes[] = {0.0,  5e-324, 1e-310, 1e-300, 1e-160, 1e-8,
                                   0.25, 1.0,    1e8,    1e160,  1e300,  DBL_MAX};
    return which == 0 ? -0.0 : (which % 2 == 0 ? -sizes[which / 2] : sizes[which / 2]);
}

static inline float hard_size_f32(size_t which)
{
    static const float sizes[] = {0.0f,  1e-45f, 1e-40f, 2e-38f, 1e-20f, 1e-4f,
                                  0.25f, 1.0f,   1e4f,   1e20f,  1e38f,  FLT_MAX};
    return which == 0 ? -0.0f : (which % 2 == 0 ? -sizes[which / 2] : sizes[which / 2]);
}

/* May be zero, which is no direction: of 0, 0, 0 and its kind. */
static inline void hard_direction(uint64_t index, double direction[3])
{
    static const double scales[HARD_SCALES] = {1.0, 3.0, 1e300, 1e-300, 0x1p-1060};
    index %= HARD_DIRECTIONS;
    if (index >= HARD_NEAR)
    {
        index -= HARD_NEAR;
        for (int k = 0; k < 3; k++)
        {
            direction[k] = hard_size(hard_digit(&index, HARD_SIZES));
        }
        return;
    }
    double scale = scales[hard_digit(&index, HARD_SCALES)];
    size_t step[3];
    for (int k = 0; k < 3; k++)
    {
        step[k] = hard_digit(&index, HARD_STEPS);
    }
    hard_base((size_t)index, direction);
    for (int k = 0; k < 3; k++)
    {
        direction[k] = hard_step(direction[k], step[k]) * scale;
    }
}

static inline void hard_direction_f32(uint64_t index, float direction[3])
{
    static const float scales[HARD_SCALES] = {1.0f, 3.0f, 1e38f, 1e-37f, 0x1p-140f};
    index %= HARD_DIRECTIONS;
    if (index >= HARD_NEAR)
    {
        index -= HARD_NEAR;
        for (int k = 0; k < 3; k++)
        {
            direction[k] = hard_size_f32(hard_digit(&index, HARD_SIZES));
        }
        return;
    }
    float scale = scales[hard_digit(&index, HARD_SCALES)];
    size_t step[3];
    double base[3];
    for (int k = 0; k < 3; k++)
    {
        step[k] = hard_digit(&index, HARD_STEPS);
    }
    hard_base((size_t)index, base);
    for (int k = 0; k < 3; k++)
    {
        direction[k] = hard_step_f32((float)base[k], step[k]) * scale;
    }
}

/* In [-1, 1], or one ulp beyond; the larger steps from the edge go inwards only. */
static inline double hard_coordinate(size_t which)
{
    static const double bases[] = {0.0, 1.0, -1.0, 0.5, -0.5, 0.25, 2.0 / 3.0, -0.8};
    if (which >= 8 * HARD_STEPS)
    {
        double size = hard_size(which - 8 * HARD_STEPS);
        return fabs(size) <= 1.0 ? size : 1.0 / size;
    }
    double value = hard_step(bases[which / HARD_STEPS], which % HARD_STEPS);
    if (fabs(value) <= 1.0 + 0x1p-52)
    {
        return value;
    }
    return value - 2.0 * (value - copysign(1.0, value));
}

static inline float hard_coordinate_f32(size_t which)
{
    static const float bases[] = {0.0f, 1.0f, -1.0f, 0.5f, -0.5f, 0.25f, 2.0f / 3.0f, -0.8f};
    if (which >= 8 * HARD_STEPS)
    {
        float size = hard_size_f32(which - 8 * HARD_STEPS);
        return fabsf(size) <= 1.0f ? size : 1.0f / size;
    }
    float value = hard_step_f32(bases[which / HARD_STEPS], which % HARD_STEPS);
    /* in float one ulp beyond the edge is more than the inverse takes as the edge */
    return fabsf(value) <= 1.0f ? value : value - 2.0f * (value - copysignf(1.0f, value));
}

/* u, v of a face. */
static inline void hard_point(uint64_t index, double uv[2])
{
    static const double factors[] = {1.0, -1.0, 0.5, -0.5, 2.0, -2.0};
    index %= HARD_POINTS;
    uv[0] = hard_coordinate(hard_digit(&index, HARD_COORDINATES));
    if (index < HARD_COORDINATES)
    {
        uv[1] = hard_coordinate((size_t)index);
        return;
    }
    index -= HARD_COORDINATES;
    double factor = factors[hard_digit(&index, 6)];
    double beside = hard_step(factor * uv[0], (size_t)index);
    uv[1] = fmax(-1.0, fmin(1.0, beside));
}

static inline void hard_point_f32(uint64_t index, float uv[2])
{
    static const float factors[] = {1.0f, -1.0f, 0.5f, -0.5f, 2.0f, -2.0f};
    index %= HARD_POINTS;
    uv[0] = hard_coordinate_f32(hard_digit(&index, HARD_COORDINATES));
    if (index < HARD_COORDINATES)
    {
        uv[1] = hard_coordinate_f32((size_t)index);
        return;
    }
    index -= HARD_COORDINATES;
    float factor = factors[hard_digit(&index, 6)];
    float beside = hard_step_f32(factor * uv[0], (size_t)index);
    uv[1] = fmaxf(-1.0f, fminf(1.0f, beside));
}

#endif
