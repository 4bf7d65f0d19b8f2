/* SPDX-License-Identifier: MIT
 *
 * The points that paths are tried at: bad ones first, then random ones, then the hard points. All are
 * functions of an index, so that a failure is found again.
 */
#include "paths.h"

#include "truth/hard_points.h"
#include "truth/sphere.h"

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

enum
{
    RANDOM = 8192
};

/* Components of what may be no direction. */
static const double bad_components[] = {
    0.0, -0.0, 1.0, -1.0, (double)NAN, (double)INFINITY, -(double)INFINITY, DBL_MAX, 5e-324};
enum
{
    BAD_COMPONENTS = COUNT(bad_components),
    BAD_DIRECTIONS = BAD_COMPONENTS * BAD_COMPONENTS * BAD_COMPONENTS
};

/* On a face, nearly on it, and off it. */
static const double bad_coordinates[] = {0.0,
                                         -0.0,
                                         1.0,
                                         -1.0,
                                         0.5,
                                         1.0 + 1e-10,
                                         -1.0 - 1e-10,
                                         1.0 + 1e-9,
                                         1.0 + 1.000001e-9,
                                         -1.0 - 2e-9,
                                         2.0,
                                         -DBL_MAX,
                                         (double)NAN,
                                         (double)INFINITY,
                                         -(double)INFINITY};
enum
{
    BAD_COORDINATES = COUNT(bad_coordinates),
    BAD_PAIRS = BAD_COORDINATES * BAD_COORDINATES,
    BAD_POINTS = 256 * BAD_COORDINATES + 6 * BAD_PAIRS
};

static void bad_direction(size_t index, number *point)
{
    uint64_t digits = index;
    for (int k = 0; k < 3; k++)
    {
        point[k].real = bad_components[hard_digit(&digits, BAD_COMPONENTS)];
    }
}

static void bad_pair(size_t index, number *pair)
{
    pair[0].real = bad_coordinates[index % BAD_COORDINATES];
    pair[1].real = bad_coordinates[index / BAD_COORDINATES % BAD_COORDINATES];
}

/* Every pair on every face, and every face with some of them. */
static void bad_point(size_t index, number *point)
{
    if (index < 6 * BAD_PAIRS)
    {
        point[0].word = index % 6;
        bad_pair(index / 6, point + 1);
        return;
    }
    index -= 6 * BAD_PAIRS;
    point[0].word = index % 256;
    point[1].real = bad_coordinates[index / 256];
    point[2].real = bad_coordinates[index % BAD_COORDINATES];
}

/* One coordinate in four is small, by up to 2^-60, or as near to the edge. */
static double random_coordinate(uint64_t *state, int ordinary)
{
    double coordinate = next_real(state);
    uint64_t bits = next_bits(state) >> 32;
    if (ordinary)
    {
        return coordinate;
    }
    double small = ldexp(coordinate, -(int)(bits >> 8 & 63) % 60);
    switch (bits & 7)
    {
    case 0:
        return small;
    case 1:
        return copysign(1.0 - fabs(small), small);
    default:
        return coordinate;
    }
}

void random_input(input_kind kind, uint64_t index, int ordinary, number *point)
{
    uint64_t state = (index + 1) * 0x9e3779b97f4a7c15u;
    double direction[3];
    next_bits(&state);
    switch (kind)
    {
    case DIRECTIONS:
        next_direction(&state, direction);
        for (int k = 0; k < 3; k++)
        {
            point[k].real = direction[k];
        }
        break;
    case POINTS:
        point[0].word = (next_bits(&state) >> 32) % 6;
        point[1].real = random_coordinate(&state, ordinary);
        point[2].real = random_coordinate(&state, ordinary);
        break;
    case PLANE:
        point[0].real = random_coordinate(&state, ordinary);
        point[1].real = random_coordinate(&state, ordinary);
        break;
    }
}

/* In the path's precision, which decides where the points are. */
static void hard_real(input_kind kind, const precision *in, uint64_t index, double real[3])
{
    float narrow[3] = {0.0f, 0.0f, 0.0f};
    if (!in->narrow)
    {
        (kind == DIRECTIONS ? hard_direction : hard_point)(index, real);
        return;
    }
    (kind == DIRECTIONS ? hard_direction_f32 : hard_point_f32)(index, narrow);
    for (int k = 0; k < 3; k++)
    {
        real[k] = (double)narrow[k];
    }
}

static void hard_input(input_kind kind, const precision *in, uint64_t index, number *point)
{
    double real[3] = {0.0, 0.0, 0.0};
    int first = kind == POINTS;
    hard_real(kind, in, index, real);
    point[0].word = (index / HARD_POINTS + index) % 6; /* only of a point */
    for (int k = 0; k < (kind == DIRECTIONS ? 3 : 2); k++)
    {
        point[first + k].real = real[k];
    }
}

/* Points are fewer than directions, so that more of them are taken. */
static size_t stride_of(input_kind kind, size_t one_in)
{
    return kind == DIRECTIONS ? one_in : one_in / 9 + 1;
}

static size_t hard_count(input_kind kind)
{
    return kind == DIRECTIONS ? HARD_DIRECTIONS : kind == POINTS ? 6 * HARD_POINTS : HARD_POINTS;
}

static size_t bad_count(input_kind kind)
{
    return kind == DIRECTIONS ? BAD_DIRECTIONS : kind == POINTS ? BAD_POINTS : BAD_PAIRS;
}

size_t input_count(input_kind kind, size_t one_in)
{
    return bad_count(kind) + RANDOM + (hard_count(kind) - 1) / stride_of(kind, one_in) + 1;
}

void input_at(input_kind kind, const precision *in, size_t one_in, size_t index, number *point)
{
    size_t bad = bad_count(kind);
    if (index >= bad + RANDOM)
    {
        hard_input(kind, in, (index - bad - RANDOM) * stride_of(kind, one_in), point);
    }
    else if (index >= bad)
    {
        random_input(kind, index, 0, point);
    }
    else if (kind == DIRECTIONS)
    {
        bad_direction(index, point);
    }
    else if (kind == POINTS)
    {
        bad_point(index, point);
    }
    else
    {
        bad_pair(index, point);
    }
}
