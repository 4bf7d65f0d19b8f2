/* SPDX-License-Identifier: MIT
 *
 * The points at which peers are compared, random and hard ones.
 */
#include "peers.h"

#include "truth/sphere.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Beside a value: one ulp either side, these steps either side, and random ones of every size. */
static const double steps[] = {1e-300, 1e-30, 1e-16, 1e-15, 1e-14, 1e-12,
                               1e-10,  1e-8,  1e-7,  1e-6,  1e-4,  1e-2};

enum
{
    STEPS = sizeof steps / sizeof steps[0],
    BESIDE = 3 + 2 * STEPS,
    RANDOMLY_BESIDE = 700
};

static double beside(double value, int i)
{
    switch (i)
    {
    case 0:
        return value;
    case 1:
        return nextafter(value, INFINITY);
    case 2:
        return nextafter(value, -INFINITY);
    default:
        return value + (i & 1 ? steps[(i - 3) / 2] : -steps[(i - 3) / 2]);
    }
}

static double randomly_beside(double value, uint64_t *state)
{
    double step = pow(10.0, 7.5 * next_real(state) - 8.5);
    return next_bits(state) >> 63 ? value + step : value - step;
}

typedef struct list
{
    double *numbers;
    size_t count;
    size_t room;
    uint64_t state;
} list;

static void append(list *points, const double point[3])
{
    if (points->count == points->room)
    {
        points->room = points->room == 0 ? 4096 : 2 * points->room;
        points->numbers =
            (double *)realloc(points->numbers, points->room * 3 * sizeof points->numbers[0]);
        if (points->numbers == NULL)
        {
            perror("peers");
            exit(1);
        }
    }
    memcpy(points->numbers + 3 * points->count++, point, 3 * sizeof point[0]);
}

/* A point and points beside it in two of its numbers, as far as those stay in their ranges. */
static void append_around(list *points, const double base[3], int first, int second,
                          double first_limit, double second_limit)
{
    double point[3] = {base[0], base[1], base[2]};
    for (int i = 0; i < BESIDE * BESIDE + RANDOMLY_BESIDE; i++)
    {
        int grid = i < BESIDE * BESIDE;
        point[first] =
            grid ? beside(base[first], i / BESIDE) : randomly_beside(base[first], &points->state);
        point[second] =
            grid ? beside(base[second], i % BESIDE) : randomly_beside(base[second], &points->state);
        if (fabs(point[first]) <= first_limit && fabs(point[second]) <= second_limit)
        {
            append(points, point);
        }
    }
}

static void append_lonlat(list *points, const peer_subject *subject, double lon, double lat)
{
    int radians = subject->unit == 1.0;
    double half_turn = radians ? acos(-1.0) : 180.0;
    double base[3] = {lon * (half_turn / 180.0), lat * (half_turn / 180.0), 0.0};
    append_around(points, base, 0, 1, half_turn, radians ? asin(1.0) : 90.0);
}

/* The centres, edges and corners of the cube. */
static void hard_vectors(list *points)
{
    for (int i = 0; i < 27; i++)
    {
        double base[3] = {i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1};
        for (int axis = 0; axis < 3 && i != 13; axis++) /* 13 is the zero vector */
        {
            append_around(points, base, axis, (axis + 1) % 3, INFINITY, INFINITY);
        }
    }
}

/* The same, and diagonals of the faces; poles, antimeridian; HEALPix's |z| = 2/3, where its belt
 * and caps meet. */
static void hard_lonlats(list *points, const peer_subject *subject)
{
    const double degrees = 180.0 / acos(-1.0);
    const double lats[] = {0.0, asin(2.0 / 3.0) * degrees, 45.0, atan(sqrt(0.5)) * degrees, 90.0};
    for (int i = -4; i <= 4; i++)
    {
        double between = 45.0 * i + (i < 4 ? 20.0 : -20.0);
        double off = remainder(between, 90.0) / degrees;
        for (int sign = -1; sign <= 1; sign += 2)
        {
            for (size_t k = 0; k < sizeof lats / sizeof lats[0]; k++)
            {
                append_lonlat(points, subject, 45.0 * i, sign * lats[k]);
            }
            append_lonlat(points, subject, between, sign * atan(cos(off)) * degrees);
            append_lonlat(points, subject, between, sign * atan(sin(off)) * degrees);
            append_lonlat(points, subject, between, sign * lats[1]);
            append_lonlat(points, subject, between, sign * 90.0);
        }
    }
}

double *peer_hard_sphere(const peer_subject *subject, size_t *count)
{
    list points = {NULL, 0, 0, 22};
    if (subject->unit == 0.0)
    {
        hard_vectors(&points);
    }
    else
    {
        hard_lonlats(&points, subject);
    }
    *count = points.count;
    return points.numbers;
}

double *peer_random_sphere(const peer_subject *subject, size_t count)
{
    uint64_t state = 20;
    double *points = (double *)peer_allocate(count, 3 * sizeof points[0]);
    for (size_t i = 0; i < count; i++)
    {
        double d[3];
        next_direction(&state, d);
        if (subject->unit == 0.0)
        {
            memcpy(points + 3 * i, d, sizeof d);
            continue;
        }
        points[3 * i] = atan2(d[1], d[0]) / subject->unit;
        points[3 * i + 1] = atan2(d[2], hypot(d[0], d[1])) / subject->unit;
    }
    return points;
}

double *peer_random_places(size_t count)
{
    uint64_t state = 21;
    double *points = (double *)peer_allocate(count, 3 * sizeof points[0]);
    for (size_t i = 0; i < count; i++)
    {
        points[3 * i] = (double)(next_bits(&state) % 6);
        points[3 * i + 1] = next_real(&state);
        points[3 * i + 2] = next_real(&state);
    }
    return points;
}

double *peer_hard_places(size_t *count)
{
    static const double bases[] = {-1.0, -0.7, -0.5, 0.0, 0.5, 0.7, 1.0};
    enum
    {
        BASES = sizeof bases / sizeof bases[0]
    };
    list points = {NULL, 0, 0, 23};
    for (int i = 0; i < 6 * BASES * BASES; i++)
    {
        double base[3] = {i % 6, bases[i / 6 % BASES], bases[i / 6 / BASES]};
        append_around(&points, base, 1, 2, 1.0, 1.0);
    }
    *count = points.count;
    return points.numbers;
}
