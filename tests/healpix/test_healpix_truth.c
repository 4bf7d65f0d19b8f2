/* SPDX-License-Identifier: MIT
 *
 * HEALPix pixels against quadruple precision, with every instruction set: points in the pixels that they are
 * in, and how far from its border one is that is not; centres and boundaries, and how far from the true ones
 * they are. Random points and pixels, hard ones, and points on borders and within some ulp of them.
 *
 * Usage: healpix_truth [COUNT]; prints the worst errors, and fails if one is beyond what the header promises.
 */
#include <cubemap/cubemap.h>

#include "truth/hard_points.h"
#include "truth/quad_healpix.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

/* the suffix Q of literals */
#pragma GCC diagnostic ignored "-Wpedantic"

/* What cubemap/healpix.h promises, in metres and relative. */
static const double border_bound = 5e-9;
static const double direction_bound = 2e-9;
static const double angles_bound = 6e-9;
static const double theta_bound = 5e-16;

static const int64_t nsides[] = {1, 32, 8192, (int64_t)1 << 29};

enum
{
    DIRECTION,
    ANGLES,
    LONLAT,
    KINDS
};

static const char *const kind_names[KINDS] = {"direction", "theta, phi", "lon, lat"};

/* The worst of one kind. */
typedef struct worst
{
    size_t points;
    size_t wrong;
    double metres;
    double at[3];
} worst;

/* A length on the sphere is at most that much more than the same in the plane, where a side is one: the lines
 * are furthest from each other beside the middle of a cap. */
static const double stretch = 1.3;

/* theta or lat in at[0], phi or lon in at[1], or a direction. */
static void check_point(const cm_healpix *healpix, int kind, const double at[3], worst *w)
{
    int64_t nside = cm_healpix_nside(healpix);
    healpix_quad_place truth;
    int64_t pixel = -7;
    cm_status status;
    switch (kind)
    {
    case DIRECTION:
        truth = healpix_quad_place_of_direction(nside, at);
        status = cm_healpix_pixel_from_direction(healpix, at, &pixel);
        break;
    case ANGLES:
        truth = healpix_quad_place_of_angles(nside, at[0], at[1]);
        status = cm_healpix_pixel_from_angles(healpix, at[0], at[1], &pixel);
        break;
    default:
        truth = healpix_quad_place_of_lonlat(nside, at[1], at[0]);
        status = cm_healpix_pixel_from_lonlat(healpix, at[1], at[0], &pixel);
    }
    if (status == CM_OK && cm_healpix_order_of(healpix) == CM_HEALPIX_RING)
    {
        status = cm_healpix_nested_from_ring(healpix, pixel, &pixel);
    }
    w->points++;
    if (status != CM_OK || pixel != healpix_quad_nested(nside, &truth))
    {
        double metres = stretch * truth.margin * EARTH_RADIUS / (double)nside;
        w->wrong++;
        if (!(metres <= w->metres) || status != CM_OK)
        {
            w->metres = status == CM_OK ? metres : INFINITY;
            w->at[0] = at[0];
            w->at[1] = at[1];
            w->at[2] = at[2];
        }
    }
}

/* A whole number of any size up to n, or so far below n. */
static int64_t any_size(int64_t n, uint64_t *state)
{
    int64_t small = (int64_t)exp2(0.5 * log2((double)n) * (1.0 + next_real(state))) - 1;
    small = small < n ? small : n - 1;
    return next_bits(state) >> 63 ? small : n - 1 - small;
}

static double step_beside(double value, uint64_t *state)
{
    int steps = (int)(next_bits(state) % 7) - 3;
    for (int i = 0; i < abs(steps); i++)
    {
        value = nextafter(value, steps < 0 ? -INFINITY : INFINITY);
    }
    return value;
}

/* On a side of a pixel, to some ulp. */
static void point_on_border(int64_t nside, int kind, uint64_t *state, double at[3])
{
    healpix_quad angles[2];
    healpix_quad direction[3];
    healpix_quad x = (healpix_quad)any_size(nside, state);
    healpix_quad y = (healpix_quad)any_size(nside, state);
    healpix_quad along = 0.5Q + 0.5Q * (healpix_quad)next_real(state);
    int is_x = (int)(next_bits(state) >> 63);
    healpix_quad_point(nside, (int)(next_bits(state) % 12), x + (is_x ? along : 0.0Q),
                       y + (is_x ? 0.0Q : along), angles, direction);
    if (kind == DIRECTION)
    {
        for (int k = 0; k < 3; k++)
        {
            at[k] = step_beside((double)direction[k], state);
        }
        return;
    }
    at[0] = (double)(kind == ANGLES ? angles[0] : M_PI_2q - angles[0]);
    at[0] = fmax(kind == ANGLES ? 0.0 : -1.5707963267948966, step_beside(at[0], state));
    at[1] = step_beside((double)angles[1], state);
}

static void random_point(int kind, uint64_t *state, double at[3])
{
    next_direction(state, at);
    if (kind != DIRECTION)
    {
        double theta = atan2(hypot(at[0], at[1]), at[2]);
        double phi = atan2(at[1], at[0]);
        at[0] = kind == ANGLES ? theta : 1.5707963267948966 - theta;
        at[1] = phi;
        at[2] = 0.0;
    }
}

/* Beside a pole, at any distance down to 1e-300. */
static void polar_point(int kind, uint64_t *state, double at[3])
{
    double distance = pow(10.0, 150.0 * (next_real(state) - 1.0));
    double phi = 3.1415926535897931 * next_real(state);
    double side = next_bits(state) >> 63 ? 1.0 : -1.0;
    at[0] = kind == DIRECTION ? distance * cos(phi)
            : kind == ANGLES  ? distance
                              : side * (1.5707963267948966 - distance);
    at[1] = kind == DIRECTION ? distance * sin(phi) : phi;
    at[2] = side;
}

static int has_length(const double at[3])
{
    return at[0] != 0.0 || at[1] != 0.0 || at[2] != 0.0;
}

static void check_points(const cm_healpix *healpix, int kind, size_t count, worst *w)
{
    uint64_t state = 31;
    for (size_t i = 0; i < count; i++)
    {
        double at[3];
        random_point(kind, &state, at);
        check_point(healpix, kind, at, w);
        point_on_border(cm_healpix_nside(healpix), kind, &state, at);
        check_point(healpix, kind, at, w);
        polar_point(kind, &state, at);
        check_point(healpix, kind, at, w);
        hard_direction(next_bits(&state), at);
        if (kind == DIRECTION && has_length(at))
        {
            check_point(healpix, kind, at, w);
        }
    }
}

static int report_points(const cm_healpix *healpix, int kind, size_t count)
{
    worst w = {0, 0, 0.0, {0.0, 0.0, 0.0}};
    check_points(healpix, kind, count, &w);
    printf("%-7s nside %-9" PRId64 " %-6s %-10s %zu of %zu wrong, at most %.2f nm from a border",
           cm_healpix_instructions(healpix), cm_healpix_nside(healpix),
           cm_healpix_order_of(healpix) == CM_HEALPIX_RING ? "RING" : "NESTED", kind_names[kind],
           w.wrong, w.points, w.metres * 1e9);
    if (w.metres <= border_bound)
    {
        puts("");
        return 0;
    }
    printf(": too far, at %.17g %.17g %.17g\n", w.at[0], w.at[1], w.at[2]);
    return 1;
}

/* ---- Centres ---- */

static int report_centres(const cm_healpix *healpix, size_t count)
{
    int64_t nside = cm_healpix_nside(healpix);
    uint64_t state = 37;
    double of_direction = 0.0;
    double of_angles = 0.0;
    double of_theta = 0.0;
    for (size_t i = 0; i < count; i++)
    {
        healpix_quad angles[2];
        healpix_quad truth[3];
        double d[3];
        double theta;
        double phi;
        const healpix_quad_place at = {(int)(next_bits(&state) % 12), any_size(nside, &state),
                                       any_size(nside, &state), 0.0};
        int64_t nested = healpix_quad_nested(nside, &at);
        int64_t pixel = nested;
        if (cm_healpix_order_of(healpix) == CM_HEALPIX_RING)
        {
            (void)cm_healpix_ring_from_nested(healpix, nested, &pixel);
        }
        healpix_quad_centre(nside, nested, angles, truth);
        if (cm_healpix_direction_from_pixel(healpix, pixel, d) != CM_OK ||
            cm_healpix_angles_from_pixel(healpix, pixel, &theta, &phi) != CM_OK)
        {
            printf("no pixel %" PRId64 "\n", pixel);
            return 1;
        }
        of_direction = fmax(of_direction, healpix_quad_metres_of_direction(d, truth));
        of_angles = fmax(of_angles, healpix_quad_metres_of_angles(theta, phi, truth));
        of_theta = fmax(of_theta, (double)fabsq(((healpix_quad)theta - angles[0]) / angles[0]));
    }
    printf("%-7s nside %-9" PRId64
           " %-6s centres: direction %.2f nm, angles %.2f nm, theta %.1e relative\n",
           cm_healpix_instructions(healpix), nside,
           cm_healpix_order_of(healpix) == CM_HEALPIX_RING ? "RING" : "NESTED", of_direction * 1e9,
           of_angles * 1e9, of_theta);
    return !(of_direction <= direction_bound && of_angles <= angles_bound &&
             of_theta <= theta_bound);
}

static int report_all(int64_t nside, cm_healpix_order order, const char *set, size_t count)
{
    const cm_options options = {.size = sizeof options, .instructions = set};
    cm_healpix *healpix;
    int failures = 0;
    if (cm_healpix_create(nside, order, &options, &healpix) != CM_OK)
    {
        return 1;
    }
    for (int kind = 0; kind < KINDS; kind++)
    {
        failures += report_points(healpix, kind, count);
    }
    failures += report_centres(healpix, count);
    cm_healpix_destroy(healpix);
    return failures;
}

int main(int argc, char **argv)
{
    size_t count = argc > 1 ? (size_t)strtod(argv[1], NULL) : 2000;
    int failures = 0;
    for (size_t s = 0; s < cm_instructions_count(); s++)
    {
        for (size_t i = 0; i < sizeof nsides / sizeof *nsides; i++)
        {
            for (int order = 0; order < 2; order++)
            {
                failures +=
                    report_all(nsides[i], (cm_healpix_order)order, cm_instructions_at(s), count);
            }
        }
    }
    return failures != 0;
}
