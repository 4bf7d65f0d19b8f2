/* SPDX-License-Identifier: MIT
 *
 * The certificate: the worst errors of every mapping in double and in float, measured at all hard
 * points (tests/hard_points.h) and at random ones, where they occur, and the published bounds
 * (cm_mapping_info.bounds). Errors are in eps, 2^-53 in double and 2^-24 in float:
 *
 *   round trip        direction -> face, u, v -> direction: the angle, in rad / eps
 *   plane round trip  face, u, v -> direction -> face, u, v: the larger difference of u and of v; where
 *                     the face is another (beside an edge) the angle between what the two stand for
 *   forward           u and v of a direction, and of p, q, against the truth: absolute, and relative
 *                     where the truth is at least 1e-300 (1e-36 in float)
 *   inverse           x, y and z, and p and q, of u, v; likewise
 *
 * Maps with one face, and what is between disc and square:
 *   - round trips of the latter are disc -> square -> disc and square -> disc -> square, in lengths of the disc;
 *   - of the others a plane round trip is measured as the angle where that is less than the difference of u and
 *     of v: beside a corner of the square, and where the border meets itself, the map stretches without bound;
 *   - directions outside the field of view, and points outside the disc, are none and are left out;
 *   - where forward is on another side of a fold than the truth, that is as with another face;
 *   - a bound of 0 is none that is stated; with other than the standard parts or parameters the bounds are
 *     those of mapping.h: 21 eps for round trips, 8 forward and inverse, and none relative to the truth.
 *
 * With other than the standard parameters the bounds are greater by the factor by which the condition
 * is: how much the warp, or its inverse, stretches a small difference at most; but those of forward and
 * inverse stay below 8 eps, and relative to the truth below 16.
 *
 * The tier fast (options.h) has the bounds of float and what the rounding of its arguments adds: an eps
 * for round trips; for forward and inverse, and relative to the truth, an eps and one more for the
 * condition. Its directions are of lengths near 1 or greater.
 *
 * The truth is the kernel's own text in quadruple precision (tests/quad.h) for double, and the library
 * in double for float and fast. The exit status is 1 if a bound does not hold.
 */
#define _POSIX_C_SOURCE 200809L

#include "../tests/cubes.h"
#include "../tests/hard_points.h"
#include "../tests/quad.h"
#include "../tests/sphere.h"

#include <cubemap/cubemap.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum
{
    BLOCK = 1024
};

typedef enum kind
{
    ROUND_TRIP,
    PLANE_ROUND_TRIP,
    FORWARD,
    FORWARD_RELATIVE,
    INVERSE,
    INVERSE_RELATIVE,
    KINDS
} kind;

static const char *const kind_names[KINDS] = {"round trip", "plane round trip",
                                              "forward",    "forward, relative",
                                              "inverse",    "inverse, relative"};

typedef struct extreme
{
    double error; /* eps */
    char where[128];
} extreme;

/* double, float, and double computed in float */
typedef enum precision_kind
{
    DOUBLE,
    FLOAT,
    FAST,
    PRECISIONS
} precision_kind;

static const char *const precision_names[PRECISIONS] = {"double", "float", "fast"};

/* One mapping in one precision, and what has been found of it. */
typedef struct subject
{
    cm_mapping *mapping;
    cm_mapping *exact; /* the truth unless in double */
    cm_mapping *undo;  /* whose inverse is that of forward */
    quad_mapping truth;
    precision_kind precision;
    int narrow; /* the functions for float */
    int faces;
    int is_disc;  /* are u and v a point of the disc? */
    int has_gaps; /* of six squares in a rectangle: rhealpix */
    int is_other; /* are parts or parameters of one face not the standard ones? */
    int is_flat;  /* does the radius stop to grow with the angle, so that no bound holds there? */
    int is_drawn_out;  /* is the azimuth at the antipode drawn out to the square's corners? */
    int is_plane;      /* between disc and square, without a sphere */
    double centre[3];  /* of the field of view */
    double rim_cosine; /* of the angle from there to the rim */
    double eps;
    double least; /* where relative errors begin */
    double condition;
    double widening; /* of the bounds */
    extreme worst[KINDS];
} subject;

/* ---- The two precisions under one roof; in float the numbers are floats already ---- */

static void forward_block(const subject *s, size_t n, double (*d)[BLOCK], uint8_t *face,
                          double (*uv)[BLOCK])
{
    static float in[3][BLOCK];
    static float out[2][BLOCK];
    if (!s->narrow)
    {
        cm_forward_array(s->mapping, n, d[0], d[1], d[2], face, uv[0], uv[1]);
        return;
    }
    for (size_t i = 0; i < n; i++)
    {
        in[0][i] = (float)d[0][i];
        in[1][i] = (float)d[1][i];
        in[2][i] = (float)d[2][i];
    }
    cm_forward_array_f32(s->mapping, n, in[0], in[1], in[2], face, out[0], out[1]);
    for (size_t i = 0; i < n; i++)
    {
        uv[0][i] = (double)out[0][i];
        uv[1][i] = (double)out[1][i];
    }
}

static void inverse_block(const subject *s, size_t n, const uint8_t *face, double (*uv)[BLOCK],
                          double (*d)[BLOCK])
{
    static float in[2][BLOCK];
    static float out[3][BLOCK];
    if (!s->narrow)
    {
        cm_inverse_array(s->mapping, n, face, uv[0], uv[1], d[0], d[1], d[2]);
        return;
    }
    for (size_t i = 0; i < n; i++)
    {
        in[0][i] = (float)uv[0][i];
        in[1][i] = (float)uv[1][i];
    }
    cm_inverse_array_f32(s->mapping, n, face, in[0], in[1], out[0], out[1], out[2]);
    for (size_t i = 0; i < n; i++)
    {
        d[0][i] = (double)out[0][i];
        d[1][i] = (double)out[1][i];
        d[2][i] = (double)out[2][i];
    }
}

/* The warp, or with back its inverse, of the library; 0 if the mapping has none. */
static int warp_point(const subject *s, int back, const double from[2], double to[2])
{
    float in[2] = {(float)from[0], (float)from[1]};
    float out[2];
    if (!s->narrow)
    {
        return (back ? cm_unwarp : cm_warp)(s->mapping, from, to) == CM_OK;
    }
    if ((back ? cm_unwarp_f32 : cm_warp_f32)(s->mapping, in, out) != CM_OK)
    {
        return 0;
    }
    to[0] = (double)out[0];
    to[1] = (double)out[1];
    return 1;
}

/* ---- Truth ---- */

static int true_forward(const subject *s, const double d[3], long double uv[2])
{
    if (s->precision != DOUBLE)
    {
        double wide[2];
        int face = cm_forward(s->exact, d, wide);
        uv[0] = (long double)wide[0];
        uv[1] = (long double)wide[1];
        return face;
    }
    quad in[3] = {(quad)d[0], (quad)d[1], (quad)d[2]};
    quad out[2];
    int face = quad_forward(&s->truth, in, out);
    uv[0] = (long double)out[0];
    uv[1] = (long double)out[1];
    return face;
}

/* u, v beyond the edge are on it. In double exact is the kernel's text, whatever the argument. */
static void true_inverse(const subject *s, const cm_mapping *exact, int face, const double uv[2],
                         long double d[3])
{
    if (s->precision != DOUBLE)
    {
        double wide[3];
        cm_inverse(exact, (uint8_t)face, uv, wide);
        for (int k = 0; k < 3; k++)
        {
            d[k] = (long double)wide[k];
        }
        return;
    }
    quad in[2] = {(quad)fmax(-1.0, fmin(1.0, uv[0])), (quad)fmax(-1.0, fmin(1.0, uv[1]))};
    if (s->is_disc)
    {
        in[0] = (quad)uv[0];
        in[1] = (quad)uv[1];
    }
    quad out[3];
    quad_inverse(&s->truth, face, in, out);
    for (int k = 0; k < 3; k++)
    {
        d[k] = (long double)out[k];
    }
}

static void true_warp(const subject *s, int back, const double from[2], long double to[2])
{
    if (s->precision != DOUBLE)
    {
        double wide[2];
        (void)(back ? cm_unwarp : cm_warp)(s->exact, from, wide);
        to[0] = (long double)wide[0];
        to[1] = (long double)wide[1];
        return;
    }
    quad in[2] = {(quad)fmax(-1.0, fmin(1.0, from[0])), (quad)fmax(-1.0, fmin(1.0, from[1]))};
    quad out[2];
    (back ? quad_unwarp : quad_warp)(&s->truth, in, out);
    to[0] = (long double)out[0];
    to[1] = (long double)out[1];
}

/* ---- Errors ---- */

/* What the three numbers of a place are. */
typedef enum place
{
    DIRECTION, /* x y z */
    POINT,     /* face u v */
    WARP,      /* p q, of the warp alone */
    UNWARP     /* u v, of its inverse */
} place;

static void describe(char *text, size_t size, place what, double a, double b, double c)
{
    switch (what)
    {
    case DIRECTION:
        snprintf(text, size, "%.17g %.17g %.17g", a, b, c);
        break;
    case POINT:
        snprintf(text, size, "%d %.17g %.17g", (int)a, b, c);
        break;
    default:
        snprintf(text, size, "%s %.17g %.17g", what == WARP ? "p, q" : "u, v", a, b);
        break;
    }
}

/* NaN is the worst there is. */
static void note(subject *s, kind which, double error, place what, double a, double b, double c)
{
    extreme *worst = &s->worst[which];
    if (!(error <= worst->error))
    {
        worst->error = isnan(error) ? (double)INFINITY : error;
        describe(worst->where, sizeof worst->where, what, a, b, c);
    }
}

/* a b - c d to an ulp and a half (Kahan), however much cancels. */
static inline double difference_of_products(double a, double b, double c, double d)
{
    double cd = c * d;
    return fma(a, b, -cd) - fma(c, d, -cd);
}

/* The angle between a direction a, of any length that can be squared, and b of unit length near it, in
 * radians; 2 and more where they are not near. */
static inline double small_angle(double ax, double ay, double az, double bx, double by, double bz)
{
    double x = difference_of_products(ay, bz, az, by);
    double y = difference_of_products(az, bx, ax, bz);
    double z = difference_of_products(ax, by, ay, bx);
    double sine = sqrt((x * x + y * y + z * z) / (ax * ax + ay * ay + az * az));
    return ax * bx + ay * by + az * bz > 0.0 ? sine : 2.0 + sine;
}

static void small_angles(size_t n, double (*a)[BLOCK], double (*b)[BLOCK], double *angle)
{
    for (size_t i = 0; i < n; i++)
    {
        angle[i] = small_angle(a[0][i], a[1][i], a[2][i], b[0][i], b[1][i], b[2][i]);
    }
}

/* The same for any length: a times a power of two that makes its largest component about 1; what that
 * loses of the others is far below eps. */
static double small_angle_of_any(const double a[3], const double b[3])
{
    int exponent;
    frexp(fmax(fabs(a[0]), fmax(fabs(a[1]), fabs(a[2]))), &exponent);
    return small_angle(ldexp(a[0], -exponent), ldexp(a[1], -exponent), ldexp(a[2], -exponent), b[0],
                       b[1], b[2]);
}

static double absolute(const long double *truth, const double *got, int count, double eps)
{
    double worst = 0.0;
    for (int k = 0; k < count; k++)
    {
        worst = fmax(worst, (double)fabsl((long double)got[k] - truth[k]) / eps);
        worst = isnan(got[k]) ? (double)INFINITY : worst;
    }
    return worst;
}

static double relative(const subject *s, const long double *truth, const double *got, int count)
{
    double worst = 0.0;
    for (int k = 0; k < count; k++)
    {
        if (fabsl(truth[k]) >= s->least)
        {
            worst = fmax(worst, (double)fabsl((long double)got[k] / truth[k] - 1.0L) / s->eps);
        }
    }
    return worst;
}

/* ---- Round trips ---- */

/* The largest of n errors into the record, with where it is. */
static size_t index_of_worst(size_t n, const double *error)
{
    size_t at = 0;
    for (size_t i = 1; i < n; i++)
    {
        at = !(error[i] <= error[at]) ? i : at;
    }
    return at;
}

/* face, u, v -> back: a direction -> face, u, v, for n points */
static void plane_round_trips(subject *s, size_t n, const uint8_t *face, double (*uv)[BLOCK],
                              double (*back)[BLOCK])
{
    static double again[2][BLOCK], twice[3][BLOCK], angle[BLOCK], error[BLOCK];
    static uint8_t face_again[BLOCK];
    forward_block(s, n, back, face_again, again);
    inverse_block(s, n, face_again, again, twice);
    small_angles(n, back, twice, angle);
    for (size_t i = 0; i < n; i++)
    {
        double u = fmax(-1.0, fmin(1.0, uv[0][i]));
        double v = fmax(-1.0, fmin(1.0, uv[1][i]));
        double plane = fmax(fabs(again[0][i] - u), fabs(again[1][i] - v));
        plane = s->faces == 1 ? fmin(plane, angle[i]) : plane;
        error[i] = (face_again[i] == face[i] ? plane : angle[i]) / s->eps;
    }
    size_t at = index_of_worst(n, error);
    note(s, PLANE_ROUND_TRIP, error[at], POINT, face[at], uv[0][at], uv[1][at]);
}

/* Directions whose lengths may be squared. */
static void round_trips(subject *s, size_t n, double (*d)[BLOCK])
{
    static double uv[2][BLOCK], back[3][BLOCK], angle[BLOCK];
    static uint8_t face[BLOCK];
    forward_block(s, n, d, face, uv);
    inverse_block(s, n, face, uv, back);
    small_angles(n, d, back, angle);
    size_t at = index_of_worst(n, angle);
    note(s, ROUND_TRIP, angle[at] / s->eps, DIRECTION, d[0][at], d[1][at], d[2][at]);
    plane_round_trips(s, n, face, uv, back);
}

/* Directions of any length, subnormal and huge, one by one. */
static void hard_round_trips(subject *s, size_t n, double (*d)[BLOCK])
{
    static double uv[2][BLOCK], back[3][BLOCK];
    static uint8_t face[BLOCK];
    forward_block(s, n, d, face, uv);
    inverse_block(s, n, face, uv, back);
    for (size_t i = 0; i < n; i++)
    {
        const double from[3] = {d[0][i], d[1][i], d[2][i]};
        const double to[3] = {back[0][i], back[1][i], back[2][i]};
        note(s, ROUND_TRIP, small_angle_of_any(from, to) / s->eps, DIRECTION, from[0], from[1],
             from[2]);
    }
    plane_round_trips(s, n, face, uv, back);
}

/* from given points, all six faces */
static void face_round_trips(subject *s, size_t n, double (*uv)[BLOCK])
{
    static double back[3][BLOCK];
    static uint8_t face[BLOCK];
    for (int f = 0; f < s->faces; f++)
    {
        memset(face, f, sizeof face);
        inverse_block(s, n, face, uv, back);
        plane_round_trips(s, n, face, uv, back);
    }
}

/* ---- Against the truth ---- */

/* Where a mapping's derivatives are infinite, at the corners of a conformal face, the rounding of p and q
 * comes out magnified without bound; comparisons of the warp alone, from p and q, have no such exception. */
static int is_beside_singularity(const cm_mapping *mapping, double u, double v)
{
    return (cm_mapping_describe(mapping)->properties & CM_CONFORMAL) != 0 &&
           fmin(fabs(u), fabs(v)) > 0.9375;
}

/* Beside where the border of a single square meets itself: is it the other end of a fold? */
static int is_across(const subject *s, const long double *truth, const double *got)
{
    if (s->faces != 1 || s->is_disc ||
        (!s->has_gaps && fmax(fabs(got[0]), fabs(got[1])) < 1.0 - 1e-6))
    {
        return 0;
    }
    return fabsl(truth[0] - (long double)got[0]) > 1e3L * (long double)s->eps ||
           fabsl(truth[1] - (long double)got[1]) > 1e3L * (long double)s->eps;
}

static void compare_forward(subject *s, size_t n, double (*d)[BLOCK])
{
    static double uv[2][BLOCK];
    static uint8_t face[BLOCK];
    forward_block(s, n, d, face, uv);
    for (size_t i = 0; i < n; i++)
    {
        const double direction[3] = {d[0][i], d[1][i], d[2][i]};
        const double got[2] = {uv[0][i], uv[1][i]};
        long double truth[2];
        if (true_forward(s, direction, truth) == face[i] && !is_across(s, truth, got) &&
            !is_beside_singularity(s->mapping, (double)truth[0], (double)truth[1]))
        {
            note(s, FORWARD, absolute(truth, got, 2, s->eps), DIRECTION, direction[0], direction[1],
                 direction[2]);
            note(s, FORWARD_RELATIVE, relative(s, truth, got, 2), DIRECTION, direction[0],
                 direction[1], direction[2]);
            continue;
        }
        /* on the other side of an edge by rounding, or that: as near to it on the sphere */
        long double meant[3];
        true_inverse(s, s->undo, face[i], got, meant);
        const double stands_for[3] = {(double)meant[0], (double)meant[1], (double)meant[2]};
        note(s, FORWARD, small_angle_of_any(direction, stands_for) / s->eps, DIRECTION,
             direction[0], direction[1], direction[2]);
    }
}

static void compare_inverse(subject *s, size_t n, const uint8_t *face, double (*uv)[BLOCK])
{
    static double d[3][BLOCK];
    inverse_block(s, n, face, uv, d);
    for (size_t i = 0; i < n; i++)
    {
        const double point[2] = {uv[0][i], uv[1][i]};
        const double got[3] = {d[0][i], d[1][i], d[2][i]};
        long double truth[3];
        true_inverse(s, s->exact, face[i], point, truth);
        note(s, INVERSE, absolute(truth, got, 3, s->eps), POINT, face[i], point[0], point[1]);
        note(s, INVERSE_RELATIVE, relative(s, truth, got, 3), POINT, face[i], point[0], point[1]);
    }
}

/* The warp, or with back its inverse. */
static void compare_warps_of(subject *s, int back, size_t n, double (*from)[BLOCK])
{
    for (size_t i = 0; i < n; i++)
    {
        const double point[2] = {from[0][i], from[1][i]};
        const place what = back ? UNWARP : WARP;
        kind which = back ? INVERSE : FORWARD;
        kind which_relative = back ? INVERSE_RELATIVE : FORWARD_RELATIVE;
        double got[2];
        long double truth[2];
        if (!warp_point(s, back, point, got))
        {
            return;
        }
        true_warp(s, back, point, truth);
        note(s, which, absolute(truth, got, 2, s->eps), what, point[0], point[1], 0.0);
        note(s, which_relative, relative(s, truth, got, 2), what, point[0], point[1], 0.0);
    }
}

static void compare_warps(subject *s, size_t n, double (*from)[BLOCK])
{
    compare_warps_of(s, 0, n, from);
    compare_warps_of(s, 1, n, from);
}

/* ---- Points ---- */

/* Onto rhealpix' belt of four squares, or, one point in three each, its caps. */
static void put_into_squares(const subject *s, size_t i, double *a, double *b)
{
    *b *= 0.25;
    if (i % 3 != 0)
    {
        double square = cm_mapping_parameter(s->exact, i % 3 - 1);
        *a = 0.25 * *a + (0.5 * square - 0.75);
        *b += i % 3 == 1 ? 0.5 : -0.5;
    }
}

/* In the subject's precision. What is outside the disc is moved to its rim, or beside it. */
static void put_point(const subject *s, const double point[2], size_t i, double (*uv)[BLOCK])
{
    double length = s->is_disc ? hypot(point[0], point[1]) : 0.0;
    double a = length > 1.0 ? point[0] / length : point[0];
    double b = length > 1.0 ? point[1] / length : point[1];
    if (s->has_gaps)
    {
        put_into_squares(s, i, &a, &b);
    }
    uv[0][i] = s->narrow ? (double)(float)a : a;
    uv[1][i] = s->narrow ? (double)(float)b : b;
}

static void find_view(subject *s)
{
    const quad middle[2] = {(quad)0, (quad)0};
    quad centre[3];
    quad_inverse(&s->truth, 0, middle, centre);
    for (int k = 0; k < 3; k++)
    {
        s->centre[k] = (double)centre[k];
    }
    s->rim_cosine = 1.0 - 2.0 * (double)(s->truth.constants.k0 * s->truth.constants.k0);
}

/* Is the direction in the field of view? Quadruple precision is for what is near its rim. */
static int is_seen(const subject *s, double x, double y, double z)
{
    double scale = 1.0 / fmax(fabs(x), fmax(fabs(y), fabs(z)));
    double a = x * scale, b = y * scale, c = z * scale;
    double cosine =
        (a * s->centre[0] + b * s->centre[1] + c * s->centre[2]) / sqrt(a * a + b * b + c * c);
    if (fabs(cosine - s->rim_cosine) > 1e-6)
    {
        return cosine > s->rim_cosine;
    }
    const quad direction[3] = {(quad)x, (quad)y, (quad)z};
    return quad_inside(&s->truth, direction) >= 0;
}

/* Of n directions those that are in it; returns how many. */
static size_t keep_seen(const subject *s, size_t n, double (*d)[BLOCK])
{
    size_t kept = 0;
    for (size_t i = 0; i < n && s->truth.kind == CM_KIND_AZIMUTHAL; i++)
    {
        if (is_seen(s, d[0][i], d[1][i], d[2][i]))
        {
            for (int k = 0; k < 3; k++)
            {
                d[k][kept] = d[k][i];
            }
            kept++;
        }
    }
    return s->truth.kind == CM_KIND_AZIMUTHAL ? kept : n;
}

static void random_directions(subject *s, uint64_t *state, double (*d)[BLOCK])
{
    for (size_t i = 0; i < BLOCK; i++)
    {
        double direction[3];
        next_direction(state, direction);
        for (int k = 0; k < 3; k++)
        {
            d[k][i] = s->narrow ? (double)(float)direction[k] : direction[k];
        }
    }
}

/* One in four has a coordinate that is small, by up to 2^-60, or as near to the edge. */
static void random_points(subject *s, uint64_t *state, uint8_t *face, double (*uv)[BLOCK])
{
    for (size_t i = 0; i < BLOCK; i++)
    {
        double point[2] = {next_real(state), next_real(state)};
        uint64_t bits = next_bits(state);
        double small = ldexp(point[bits & 1], -(int)(bits >> 8 & 63) % 60);
        switch (bits >> 1 & 7)
        {
        case 0:
            point[bits & 1] = small;
            break;
        case 1:
            point[bits & 1] = copysign(1.0 - fabs(small), small);
            break;
        default:
            break;
        }
        face[i] = (uint8_t)((bits >> 16) % (unsigned)s->faces);
        put_point(s, point, i, uv);
    }
}

/* Is it one for this precision? Not of zero length, nor for fast too short. */
static int is_wanted(const subject *s, double x, double y, double z)
{
    double length = fmax(fabs(x), fmax(fabs(y), fabs(z)));
    return s->precision == FAST ? length >= 0.1 && length <= 1e30 : length > 0.0;
}

/* From index on. */
static size_t hard_directions(const subject *s, uint64_t *index, double (*d)[BLOCK])
{
    size_t n = 0;
    while (n < BLOCK && *index < HARD_DIRECTIONS)
    {
        double direction[3];
        float narrow[3];
        if (s->narrow)
        {
            hard_direction_f32(*index, narrow);
        }
        else
        {
            hard_direction(*index, direction);
        }
        ++*index;
        for (int k = 0; k < 3; k++)
        {
            d[k][n] = s->narrow ? (double)narrow[k] : direction[k];
        }
        n += (size_t)is_wanted(s, d[0][n], d[1][n], d[2][n]);
    }
    return n;
}

static size_t hard_face_points(const subject *s, uint64_t *index, double (*uv)[BLOCK])
{
    size_t n = 0;
    for (; n < BLOCK && *index < HARD_POINTS; n++)
    {
        double point[2];
        float narrow[2];
        hard_point(*index, point);
        hard_point_f32(*index, narrow);
        ++*index;
        point[0] = s->narrow ? (double)narrow[0] : point[0];
        point[1] = s->narrow ? (double)narrow[1] : point[1];
        put_point(s, point, n, uv);
    }
    return n;
}

/* ---- The whole of one mapping ---- */

/* Disc -> square -> disc, and square -> disc -> square -> disc: how far the disc's points are apart. */
static void plane_trips(subject *s, size_t n, double (*disc)[BLOCK], double (*square)[BLOCK])
{
    for (size_t i = 0; i < 2 * n; i++)
    {
        int from_square = (int)(i % 2);
        const double start[2] = {(from_square ? square : disc)[0][i / 2],
                                 (from_square ? square : disc)[1][i / 2]};
        double from[2] = {start[0], start[1]};
        double to[2], back[2];
        if (from_square)
        {
            (void)warp_point(s, 1, start, from);
        }
        (void)warp_point(s, 0, from, to);
        (void)warp_point(s, 1, to, back);
        double apart = fmax(fabs(back[0] - from[0]), fabs(back[1] - from[1]));
        note(s, from_square ? PLANE_ROUND_TRIP : ROUND_TRIP, apart / s->eps,
             from_square ? UNWARP : WARP, start[0], start[1], 0.0);
    }
}

static void compare_planes(subject *s, size_t n, double (*disc)[BLOCK], double (*square)[BLOCK])
{
    compare_warps_of(s, 0, n, disc);
    compare_warps_of(s, 1, n, square);
}

/* What is between disc and square; as many points of the one as of the other. */
static void measure_plane(subject *s, double round_trip_count, double truth_count)
{
    static double disc[2][BLOCK], square[2][BLOCK];
    static uint8_t face[BLOCK];
    uint64_t state = 77;
    double most = fmax(round_trip_count, truth_count);
    for (double done = 0.0; done < most; done += BLOCK)
    {
        s->is_disc = 1;
        random_points(s, &state, face, disc);
        s->is_disc = 0;
        random_points(s, &state, face, square);
        if (done < round_trip_count)
        {
            plane_trips(s, BLOCK, disc, square);
        }
        if (done < truth_count)
        {
            compare_planes(s, BLOCK, disc, square);
        }
    }
    size_t n;
    for (uint64_t index = 0, next; index < HARD_POINTS; index = next)
    {
        next = index;
        s->is_disc = 1;
        n = hard_face_points(s, &next, disc);
        next = index;
        s->is_disc = 0;
        n = hard_face_points(s, &next, square);
        plane_trips(s, n, disc, square);
        compare_planes(s, n, disc, square);
    }
}

enum
{
    THINNED = 100 /* from this stride on a third of the hard directions does */
};

/* stride: of the hard directions, one block in so many is compared with the truth; above 1 a block of hard points
 * of a face is compared on one face, each in turn, else on all */
static void measure(subject *s, double round_trip_count, double truth_count, uint64_t stride)
{
    static double d[3][BLOCK], uv[2][BLOCK];
    static uint8_t face[BLOCK];
    uint64_t state = 77;
    if (s->is_plane)
    {
        measure_plane(s, round_trip_count, truth_count);
        return;
    }
    for (double done = 0.0; done < round_trip_count; done += BLOCK)
    {
        random_directions(s, &state, d);
        round_trips(s, keep_seen(s, BLOCK, d), d);
    }
    for (double done = 0.0; done < truth_count; done += BLOCK)
    {
        random_directions(s, &state, d);
        compare_forward(s, keep_seen(s, BLOCK, d), d);
        random_points(s, &state, face, uv);
        compare_inverse(s, BLOCK, face, uv);
        random_points(s, &state, face, uv);
        compare_warps(s, BLOCK / 4, uv);
    }
    size_t n;
    uint64_t index = 0;
    for (uint64_t block = 0; (n = hard_directions(s, &index, d)) > 0; block++)
    {
        n = keep_seen(s, n, d);
        hard_round_trips(s, n, d);
        if (block % stride == 0)
        {
            compare_forward(s, n, d);
        }
        /* no multiple of a block, so that no place in the list's runs is always left out */
        index += stride >= THINNED ? 2 * BLOCK + 37 : 0;
    }
    index = 0;
    for (int block = 0; (n = hard_face_points(s, &index, uv)) > 0; block++)
    {
        face_round_trips(s, n, uv);
        compare_warps(s, n, uv);
        for (int f = 0; f < s->faces; f++)
        {
            if (stride == 1 || block % s->faces == f)
            {
                memset(face, f, sizeof face);
                compare_inverse(s, n, face, uv);
            }
        }
    }
}

/* The largest stretch of a small difference, by the warp or by its inverse, over a grid that comes
 * close to the edges, but not to where it is infinite; 1 for a mapping that is no warp. */
static double condition_of(const cm_mapping *mapping, const quad_mapping *truth)
{
    enum
    {
        GRID = 64
    };
    const quad step = (quad)1e-12;
    quad worst = (quad)1.0;
    for (int i = 0; truth->kernels->warp != NULL && i < 2 * GRID * GRID; i++)
    {
        quad at[2] = {(i / 2 % GRID + (quad)0.5) / GRID, (i / 2 / GRID + (quad)0.5) / GRID};
        at[0] = at[0] > (quad)0.98 ? (quad)1.0 - (quad)2.0 * step : at[0];
        at[1] = at[1] > (quad)0.98 ? (quad)1.0 - (quad)2.0 * step : at[1];
        if (is_beside_singularity(mapping, (double)at[0], (double)at[1]))
        {
            continue;
        }
        quad column[2][2];
        for (int k = 0; k < 2; k++)
        {
            quad low[2] = {at[0], at[1]}, high[2] = {at[0], at[1]}, from[2], to[2];
            low[k] -= step;
            high[k] += step;
            (i % 2 ? quad_warp : quad_unwarp)(truth, low, from);
            (i % 2 ? quad_warp : quad_unwarp)(truth, high, to);
            column[k][0] = fabsq(to[0] - from[0]) / ((quad)2.0 * step);
            column[k][1] = fabsq(to[1] - from[1]) / ((quad)2.0 * step);
        }
        worst = fmaxq(worst, column[0][0] + column[1][0]);
        worst = fmaxq(worst, column[0][1] + column[1][1]);
    }
    return (double)worst;
}

/* The published inverse of cobe is none. */
static int is_no_inverse(const cm_mapping *mapping)
{
    return strcmp(cm_mapping_describe(mapping)->identifier, "cobe") == 0 &&
           cm_mapping_parameter(mapping, 0) == 1.0;
}

static double bound_of(const subject *s, kind which)
{
    const cm_bounds *bounds = &cm_mapping_describe(s->mapping)->bounds;
    const double of[KINDS] = {bounds->round_trip, bounds->plane_round_trip, bounds->forward,
                              bounds->relative,   bounds->inverse,          bounds->relative};
    if (is_no_inverse(s->mapping) && (which == ROUND_TRIP || which == PLANE_ROUND_TRIP))
    {
        return (double)INFINITY;
    }
    const double most[KINDS] = {INFINITY, INFINITY, 8.0, 16.0, 8.0, 16.0};
    int is_round_trip = which == ROUND_TRIP || which == PLANE_ROUND_TRIP;
    /* what mapping.h promises of them; relative to the truth nothing */
    const double of_other[KINDS] = {21.0, 16.0, 8.0, 0.0, 8.0, 0.0};
    int is_open =
        (s->is_flat && which == ROUND_TRIP) || (s->is_drawn_out && which == PLANE_ROUND_TRIP);
    if (s->is_other && !is_open && of_other[which] > 0.0)
    {
        return of_other[which];
    }
    if (s->is_other || of[which] == 0.0)
    {
        return (double)INFINITY;
    }
    double rounding = s->precision != FAST ? 0.0 : is_round_trip ? 1.0 : 1.0 + s->condition;
    return fmin(of[which] * s->widening, most[which]) + rounding;
}

/* One line a kind, fields apart by tabs. */
static int report(const subject *s, const char *specification)
{
    int broken = 0;
    for (int which = 0; which < KINDS; which++)
    {
        const extreme *worst = &s->worst[which];
        double bound = bound_of(s, (kind)which);
        int held = worst->error <= bound;
        printf("%s\t%s\t%.2f\t%s\t%.3f\t%.3g\t%s\t%s\n", specification,
               precision_names[s->precision], s->condition, kind_names[which], worst->error, bound,
               worst->where, held ? "held" : "BROKEN");
        broken |= !held;
    }
    fflush(stdout);
    return broken;
}

/* The condition of the mapping with its standard parameters. */
static double standard_condition(const cm_mapping *mapping)
{
    cm_mapping *standard = NULL;
    double condition = 1.0;
    if (cm_mapping_create(cm_mapping_describe(mapping)->identifier, NULL, &standard) == CM_OK)
    {
        quad_mapping truth = quad_from(standard);
        condition = condition_of(standard, &truth);
    }
    cm_mapping_destroy(standard);
    return condition;
}

/* As mapping.h tells it. */
static void note_where_it_is_flat(subject *s, const char *specification)
{
    int is_border = strncmp(specification, "border:", 7) == 0;
    int is_whole = is_border || strstr(specification, "full=1") != NULL;
    s->is_flat = strstr(specification, "orthographic") != NULL ||
                 (is_whole && (strstr(specification, "lambert") != NULL ||
                               strstr(specification, "mixture") != NULL));
    s->is_drawn_out = is_border && strstr(specification, "conformal") != NULL;
}

/* What is asked for. */
typedef struct amounts
{
    double round_trips;
    double comparisons;
    double stride;
} amounts;

static int certify(const char *specification, const char *instructions, precision_kind precision,
                   const amounts *of)
{
    cm_options options = {.size = sizeof options,
                          .instructions = instructions,
                          .tier = precision == FAST ? CM_TIER_FAST : CM_TIER_EXACT};
    subject s = {.precision = precision,
                 .narrow = precision == FLOAT,
                 .eps = precision == DOUBLE ? 0x1p-53 : 0x1p-24,
                 .least = precision == DOUBLE ? 1e-300 : 1e-36};
    cm_status status = cm_mapping_create_with(specification, NULL, &options, &s.mapping);
    if (status != CM_OK || cm_mapping_create(specification, NULL, &s.exact) != CM_OK ||
        cm_mapping_create(is_no_inverse(s.exact) ? "cobe" : specification, NULL, &s.undo) != CM_OK)
    {
        fprintf(stderr, "certificate: %s: %s\n", specification, cm_status_text(status));
        cm_mapping_destroy(s.mapping);
        cm_mapping_destroy(s.exact);
        return 2;
    }
    int broken = 0;
    if (precision != FAST || cm_mapping_tier(s.mapping) == CM_TIER_FAST)
    {
        s.truth = quad_from_text(s.exact, specification);
        s.faces = s.truth.kind == CM_KIND_CUBE ? 6 : 1;
        s.is_disc = s.truth.kind == CM_KIND_AZIMUTHAL;
        s.has_gaps = strncmp(specification, "rhealpix", 8) == 0;
        s.is_other = s.faces == 1 && cm_catalogue_find(specification) == NULL;
        note_where_it_is_flat(&s, specification);
        s.is_plane = s.truth.kind == CM_KIND_DISC_SQUARE;
        if (s.is_disc)
        {
            find_view(&s);
        }
        s.condition = condition_of(s.exact, &s.truth);
        s.widening = fmax(1.0, s.condition / standard_condition(s.exact));
        measure(&s, of->round_trips, of->comparisons, (uint64_t)of->stride);
        broken = report(&s, specification);
    }
    cm_mapping_destroy(s.mapping);
    cm_mapping_destroy(s.exact);
    cm_mapping_destroy(s.undo);
    return broken;
}

static int usage(void)
{
    fprintf(
        stderr,
        "usage: certificate [-r ROUND_TRIPS] [-t COMPARISONS] [-s STRIDE] "
        "[-p double|float|fast] [-i INSTRUCTIONS] [SPECIFICATION...]\n"
        "  -r  random round trips a mapping (1000000)\n"
        "  -t  random comparisons with the truth, forward, inverse and warp (100000)\n"
        "  -s  compare one block of hard directions in so many with the truth, and\n"
        "      above 1 hard points of one face at a time, each in turn (1: all); from\n"
        "      100 on only a third of the hard directions makes round trips\n"
        "  -p  only that precision, or the fast tier\n"
        "  Without a specification the mappings to six faces.\n"
        "  -i  scalar, sse2, avx2, avx512, neon; 77 is the exit status if this machine cannot\n");
    return 2;
}

static int is_runnable(const char *instructions)
{
    int found = instructions == NULL;
    for (size_t i = 0; i < cm_instructions_count(); i++)
    {
        found |= instructions != NULL && strcmp(instructions, cm_instructions_at(i)) == 0;
    }
    return found;
}

int main(int argc, char **argv)
{
    amounts of = {1e6, 1e5, 1.0};
    const char *only = NULL;
    const char *instructions = NULL;
    int first = 1;
    for (; first + 1 < argc && argv[first][0] == '-'; first += 2)
    {
        const char *value = argv[first + 1];
        switch (argv[first][1])
        {
        case 'r':
            of.round_trips = atof(value);
            break;
        case 't':
            of.comparisons = atof(value);
            break;
        case 's':
            of.stride = atof(value);
            break;
        case 'p':
            only = value;
            break;
        case 'i':
            instructions = value;
            break;
        default:
            return usage();
        }
    }
    if (!(of.round_trips >= 0.0 && of.comparisons >= 0.0 && of.stride >= 1.0) ||
        (first < argc && argv[first][0] == '-'))
    {
        return usage();
    }
    if (!is_runnable(instructions))
    {
        fprintf(stderr, "certificate: no instruction set %s here\n", instructions);
        return 77;
    }
    int broken = 0;
    size_t count = first < argc ? (size_t)(argc - first) : cube_count();
    for (size_t i = 0; i < count; i++)
    {
        const char *name = first < argc ? argv[(size_t)first + i] : cm_catalogue_at(i)->identifier;
        for (int k = 0; k < PRECISIONS; k++)
        {
            if (only == NULL || strcmp(only, precision_names[k]) == 0)
            {
                broken |= certify(name, instructions, (precision_kind)k, &of);
            }
        }
    }
    return broken;
}
