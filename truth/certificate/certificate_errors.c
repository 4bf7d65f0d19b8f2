/* SPDX-License-Identifier: MIT
 *
 * The errors of blocks of points: round trips, and against the truth.
 */
#include "certificate.h"

#include "truth/cube_count.h"
#include "truth/sphere.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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
void round_trips(subject *s, size_t n, double (*d)[BLOCK])
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
void hard_round_trips(subject *s, size_t n, double (*d)[BLOCK])
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
void face_round_trips(subject *s, size_t n, double (*uv)[BLOCK])
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
int is_beside_singularity(const cm_mapping *mapping, double u, double v)
{
    return (cm_mapping_describe(mapping)->properties & CM_CONFORMAL) != 0 &&
           fmin(fabs(u), fabs(v)) > 0.9375;
}

/* Beside where the border of a single square meets itself: is it the other end of a fold? What is far from the truth there
 * is; what is as near as a thin tear's other side takes long to tell, and that only counts where it would be the worst. */
static int is_across(const subject *s, const double d[3], const long double *truth,
                     const double *got)
{
    if (s->faces != 1 || s->is_disc)
    {
        return 0;
    }
    const double error = absolute(truth, got, 2, s->eps);
    if (error > 1e3 && (s->has_gaps || fmax(fabs(got[0]), fabs(got[1])) >= 1.0 - 1e-6))
    {
        return 1;
    }
    if (!(error > s->worst[FORWARD].error))
    {
        return 0;
    }
    long double meant[3];
    true_inverse(s, s->undo, 0, got, meant);
    return is_across_tear(s, d, meant, truth, got);
}

void compare_forward(subject *s, size_t n, double (*d)[BLOCK])
{
    static double uv[2][BLOCK];
    static uint8_t face[BLOCK];
    forward_block(s, n, d, face, uv);
    for (size_t i = 0; i < n; i++)
    {
        const double direction[3] = {d[0][i], d[1][i], d[2][i]};
        const double got[2] = {uv[0][i], uv[1][i]};
        long double truth[2];
        if (true_forward(s, direction, truth) == face[i] && !is_across(s, direction, truth, got) &&
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

void compare_inverse(subject *s, size_t n, const uint8_t *face, double (*uv)[BLOCK])
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

void compare_warps(subject *s, size_t n, double (*from)[BLOCK])
{
    compare_warps_of(s, 0, n, from);
    compare_warps_of(s, 1, n, from);
}

/* ---- Between disc and square ---- */

/* Disc -> square -> disc, and square -> disc -> square -> disc: how far the disc's points are apart. */
void plane_trips(subject *s, size_t n, double (*disc)[BLOCK], double (*square)[BLOCK])
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

void compare_planes(subject *s, size_t n, double (*disc)[BLOCK], double (*square)[BLOCK])
{
    compare_warps_of(s, 0, n, disc);
    compare_warps_of(s, 1, n, square);
}
