/* SPDX-License-Identifier: MIT
 *
 * Grids against quadruple precision: each step and the whole, in both directions, on several ellipsoids, with
 * every latitude, turned and not, at the hard points and at random ones; against the bounds that <cubemap/grid.h>
 * and <cubemap/mapping.h> state. Prints the table of docs/guide/grids.md.
 *
 * Usage: grid_accuracy [POINTS], so many random points for each grid, and as many hard ones.
 */
#include "truth/quad_latitude.h"
#include "truth/quad.h"

#include "truth/hard_points.h"
#include "truth/sphere.h"

#include <math.h>
#include <string.h>

#define EPS 0x1p-53
/* What the headers state. */
#define BOUND_SPHERE 4.0        /* eps, each component of a direction */
#define BOUND_SPHERE_TURNED 5.0 /* eps */
#define BOUND_ROUND_TRIP 7.0    /* nm */
#define BOUND_AREA 40.0         /* eps of its size */

enum
{
    LATITUDES = CM_LATITUDE_COUNT
};

typedef enum figure
{
    TO_SPHERE,
    FROM_SPHERE,
    PLANE, /* u and v */
    ROUND_TRIP,
    FIGURES
} figure;

typedef struct subject
{
    cm_grid *grid;
    quad_mapping truth;
    double f;
    cm_latitude latitude;
    cm_latitude_conversion *back; /* where a search starts */
    int turned;
    double plane_bound;
    double worst[FIGURES];
} subject;

static int failures;

static void take(subject *s, figure which, double value, double bound, const double at[3])
{
    s->worst[which] = fmax(s->worst[which], value);
    if (!(value <= bound) && failures++ < 20)
    {
        fprintf(stderr, "not ok: %s, %s, f %g%s: figure %d is %.3g, not %.3g, at %a %a %a\n",
                cm_mapping_describe(cm_grid_mapping(s->grid))->identifier,
                cm_latitude_name(s->latitude), s->f, s->turned ? ", turned" : "", (int)which, value,
                bound, at[0], at[1], at[2]);
    }
}

/* ---- Truth ---- */

/* The direction whose latitude is another one, of length 1. */
static void quad_other(const subject *s, cm_latitude from, cm_latitude to, const quad d[3],
                       quad out[3])
{
    quad across = sqrtq(d[0] * d[0] + d[1] * d[1]);
    quad length = sqrtq(across * across + d[2] * d[2]);
    for (int i = 0; i < 3; i++)
    {
        out[i] = d[i] / length;
    }
    if (across == 0.0Q || d[2] == 0.0Q || from == to)
    {
        return;
    }
    quad tangent = fabsq(d[2]) / across;
    const double narrow[3] = {(double)(across / length), 0.0, (double)(fabsq(d[2]) / length)};
    double start[3] = {narrow[0], 0.0, narrow[2]};
    if (from != CM_LATITUDE_GEOGRAPHIC)
    {
        cm_latitude_convert_direction(s->back, narrow, start);
    }
    quad other = quad_latitude(s->f, from, to, tangent, (quad)start[2] / (quad)start[0]);
    quad cosine = 1.0Q / sqrtq(1.0Q + other * other);
    out[0] = d[0] / across * cosine;
    out[1] = d[1] / across * cosine;
    out[2] = copysignq(other * cosine, d[2]);
}

static void quad_rotate(const cm_rotation *r, int back, const quad d[3], quad out[3])
{
    for (int i = 0; i < 3; i++)
    {
        out[i] = 0.0Q;
        for (int k = 0; k < 3; k++)
        {
            out[i] += (quad)(back ? r->row[k][i] : r->row[i][k]) * d[k];
        }
    }
}

/* In eps. got is first brought to length 1 where nothing changes its latitude, so that it keeps its length. */
static double apart(const subject *s, const double got[3], const quad truth[3])
{
    double worst = 0.0;
    int exponent;
    int keeps_length = s->f == 0.0 || s->latitude == CM_LATITUDE_GEOGRAPHIC;
    frexp(fmax(fabs(got[0]), fmax(fabs(got[1]), fabs(got[2]))), &exponent);
    quad d[3];
    for (int i = 0; i < 3; i++)
    {
        d[i] = keeps_length ? ldexpq((quad)got[i], -exponent) : (quad)got[i];
    }
    quad length = keeps_length ? sqrtq(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) : 1.0Q;
    for (int i = 0; i < 3; i++)
    {
        worst = fmax(worst, (double)fabsq(d[i] / length - truth[i]) / EPS);
    }
    return worst;
}

/* ---- A point ---- */

static void measure_point(subject *s, const double normal[3])
{
    const cm_rotation *rotation = cm_grid_rotation(s->grid);
    double bound = s->turned ? BOUND_SPHERE_TURNED : BOUND_SPHERE;
    double sphere[3], uv[2], back[3];
    quad in[3], sphere_truth[3], turned[3], uv_truth[2];
    int exponent;
    frexp(fmax(fabs(normal[0]), fmax(fabs(normal[1]), fabs(normal[2]))), &exponent);
    for (int i = 0; i < 3; i++)
    {
        in[i] = ldexpq((quad)normal[i], -exponent);
    }
    quad_other(s, CM_LATITUDE_GEOGRAPHIC, s->latitude, in, sphere_truth);
    quad_rotate(rotation, 0, sphere_truth, turned);
    cm_grid_to_sphere(s->grid, normal, sphere);
    take(s, TO_SPHERE, apart(s, sphere, turned), bound, normal);

    int face = cm_grid_forward(s->grid, normal, uv);
    int face_truth = quad_forward(&s->truth, turned, uv_truth);
    if (face == face_truth)
    {
        double off = fmax((double)fabsq((quad)uv[0] - uv_truth[0]),
                          (double)fabsq((quad)uv[1] - uv_truth[1]));
        take(s, PLANE, off / EPS, s->plane_bound, normal);
    }
    cm_grid_inverse(s->grid, (uint8_t)face, uv, back);
    take(s, ROUND_TRIP, earth_metres(normal, back) * 1e9, BOUND_ROUND_TRIP, normal);

    quad inverse_truth[3];
    quad wide[3];
    frexp(fmax(fabs(sphere[0]), fmax(fabs(sphere[1]), fabs(sphere[2]))), &exponent);
    for (int i = 0; i < 3; i++)
    {
        wide[i] = ldexpq((quad)sphere[i], -exponent);
    }
    quad_rotate(rotation, 1, wide, in);
    quad_other(s, s->latitude, CM_LATITUDE_GEOGRAPHIC, in, inverse_truth);
    cm_grid_from_sphere(s->grid, sphere, back);
    take(s, FROM_SPHERE, apart(s, back, inverse_truth), bound, normal);
}

static void measure(subject *s, long points, uint64_t seed)
{
    uint64_t state = seed;
    for (long i = 0; i < 2 * points; i++)
    {
        double d[3];
        if (i % 2 == 0)
        {
            next_direction(&state, d);
        }
        else
        {
            hard_direction(next_bits(&state), d);
        }
        double size = fmax(fabs(d[0]), fmax(fabs(d[1]), fabs(d[2])));
        if (size > 0.0 && isfinite(size))
        {
            measure_point(s, d);
        }
    }
}

/* ---- Grids ---- */

static const struct
{
    const char *text;
    const char *name;
} ellipsoids[] = {{"WGS84", "WGS84"},
                  {"Mars", "Mars"},
                  {"6378137,50", "1/50"},
                  {"6378137,-50", "-1/50"},
                  {"6371007.2,0", "sphere"}};
#define ELLIPSOIDS (sizeof ellipsoids / sizeof *ellipsoids)

static void measure_grid(const char *mapping, size_t e, int latitude, int turned, long points,
                         double worst[FIGURES])
{
    cm_ellipsoid ellipsoid;
    cm_rotation rotation;
    cm_latitude l = (cm_latitude)latitude;
    cm_grid_options options = {.size = sizeof options,
                               .mapping = mapping,
                               .ellipsoid = &ellipsoid,
                               .latitude = &l,
                               .rotation = turned ? &rotation : NULL};
    subject s = {.turned = turned, .latitude = l};
    if (cm_ellipsoid_parse(ellipsoids[e].text, &ellipsoid, NULL, 0) != CM_OK ||
        cm_rotation_from_angles(-20.5 + latitude, 33.0, 12.25, &rotation) != CM_OK ||
        cm_grid_create(&options, &s.grid) != CM_OK ||
        cm_latitude_conversion_create(&ellipsoid, l, CM_LATITUDE_GEOGRAPHIC, NULL, &s.back) !=
            CM_OK)
    {
        fprintf(stderr, "no grid\n");
        exit(1);
    }
    const cm_mapping *of = cm_grid_mapping(s.grid);
    s.f = ellipsoid.f;
    s.truth = quad_from(of);
    /* what the direction is off is so much on the face, at most */
    s.plane_bound = cm_mapping_describe(of)->bounds.forward +
                    2.0 * (turned ? BOUND_SPHERE_TURNED : BOUND_SPHERE);
    measure(&s, points, 1 + (uint64_t)latitude + 100 * e);
    for (int k = 0; k < FIGURES; k++)
    {
        worst[k] = fmax(worst[k], s.worst[k]);
    }
    cm_latitude_conversion_destroy(s.back);
    cm_grid_destroy(s.grid);
}

/* ---- Areas ---- */

/* Square metres of an ellipsoid with a = 1 per area of the unit sphere, at a normal: by the radii of curvature, and
 * by differences of the latitude. */
static quad quad_area(double f, cm_latitude latitude, const double normal[3])
{
    const quad h = 1e-11Q;
    quad flat = 1.0Q - (quad)f;
    quad across = sqrtq((quad)normal[0] * normal[0] + (quad)normal[1] * normal[1]);
    quad t = fabsq((quad)normal[2]) / across;
    quad to = quad_from_geographic((quad)f, latitude, t);
    quad slope = logq(quad_from_geographic((quad)f, latitude, t * expq(h)) /
                      quad_from_geographic((quad)f, latitude, t * expq(-h))) /
                 (2.0Q * h) * (to / (1.0Q + to * to)) / (t / (1.0Q + t * t));
    quad square = (1.0Q + flat * flat * t * t) / (1.0Q + t * t);
    quad east = sqrtq((1.0Q + t * t) / (1.0Q + to * to) * square);
    quad north = slope * square * sqrtq(square) / (flat * flat);
    return 1.0Q / (east * north);
}

/* The worst error of the area element, in eps of its size, over all latitudes on an ellipsoid; on a face of healpix the
 * sphere's is the same everywhere. */
static double measure_areas(double f, long points)
{
    double worst = 0.0;
    uint64_t state = 23;
    const cm_ellipsoid ellipsoid = {.size = sizeof ellipsoid, .a = 1.0, .f = f};
    for (int k = 0; k < LATITUDES; k++)
    {
        cm_latitude l = (cm_latitude)k;
        cm_grid *grid = NULL;
        cm_grid_options options = {
            .size = sizeof options, .mapping = "healpix", .ellipsoid = &ellipsoid, .latitude = &l};
        if (cm_grid_create(&options, &grid) != CM_OK)
        {
            fprintf(stderr, "no grid\n");
            exit(1);
        }
        for (long i = 0; i < points; i++)
        {
            /* a third of them beside the middle of a face, where the poles are */
            double near = i % 3 == 0 ? 1e-4 : 1.0;
            const double uv[2] = {near * next_real(&state), near * next_real(&state)};
            double normal[3];
            uint8_t face = (uint8_t)(i % 6);
            cm_grid_inverse(grid, face, uv, normal);
            quad truth = M_PIq / 6.0Q * quad_area(f, l, normal);
            double error = (double)fabsq(cm_grid_area_element(grid, face, uv) / truth - 1.0Q) / EPS;
            worst = fmax(worst, error);
            if (!(error <= BOUND_AREA) && failures++ < 20)
            {
                fprintf(stderr, "not ok: area element, %s, f %g: %.3g eps on face %d at %a %a\n",
                        cm_latitude_name(l), f, error, face, uv[0], uv[1]);
            }
        }
        cm_grid_destroy(grid);
    }
    return worst;
}

/* ---- Longitude and latitude ---- */

static void measure_lonlat(long points, double worst[2])
{
    cm_mapping *mapping = NULL;
    if (cm_mapping_create("gnomonic", NULL, &mapping) != CM_OK)
    {
        exit(1);
    }
    uint64_t state = 17;
    for (long i = 0; i < points; i++)
    {
        /* on the front face, where v / u are quotients of the direction's components */
        double lon = 0.7 * next_real(&state);
        double lat = 0.5 * next_real(&state);
        double uv[2], lonlat[2];
        if (i % 4 == 0)
        {
            lon += 6.283185307179586 * (double)(next_bits(&state) % 100000);
        }
        uint8_t face;
        cm_forward_lonlat_array(mapping, 1, &lon, &lat, &face, &uv[0], &uv[1]);
        quad p = tanq((quad)lon);
        quad q = tanq((quad)lat) / cosq((quad)lon);
        if (face == 0 && fabsq(p) < 0.9Q && fabsq(q) < 0.9Q)
        {
            worst[0] = fmax(worst[0], (double)fabsq(uv[0] - p) / EPS);
            worst[0] = fmax(worst[0], (double)fabsq(uv[1] - q) / EPS);
            cm_inverse_lonlat_array(mapping, 1, &face, &uv[0], &uv[1], &lonlat[0], &lonlat[1]);
            quad back_lon = atanq((quad)uv[0]);
            quad back_lat = atanq((quad)uv[1] / sqrtq(1.0Q + (quad)uv[0] * uv[0]));
            worst[1] = fmax(worst[1], (double)fabsq((lonlat[0] - back_lon) / back_lon) / EPS);
            worst[1] = fmax(worst[1], (double)fabsq((lonlat[1] - back_lat) / back_lat) / EPS);
        }
    }
    cm_mapping_destroy(mapping);
}

int main(int argc, char **argv)
{
    long points = argc > 1 ? strtol(argv[1], NULL, 10) : 30;
    static const char *const mappings[] = {"coupled", "qsc", "slice", "healpix"};
    gauss_prepare();
    printf(
        "| ellipsoid | turned | to the sphere (eps) | from it (eps) | u, v (eps) | round trip |\n"
        "|---|---|---:|---:|---:|---:|\n");
    for (size_t e = 0; e < ELLIPSOIDS; e++)
    {
        for (int turned = 0; turned < 2; turned++)
        {
            double worst[FIGURES] = {0.0};
            for (int k = 0; k < LATITUDES; k++)
            {
                for (size_t m = 0; m < sizeof mappings / sizeof *mappings; m++)
                {
                    measure_grid(mappings[m], e, k, turned, points, worst);
                }
            }
            printf("| %s | %s | %.1f | %.1f | %.1f | %.1f nm |\n", ellipsoids[e].name,
                   turned ? "yes" : "no", worst[TO_SPHERE], worst[FROM_SPHERE], worst[PLANE],
                   worst[ROUND_TRIP]);
        }
    }
    static const double flattenings[] = {
        1.0 / 298.257223563, 0.02, -0.02, 0.5, 0.9, 0.99, -1.0, -9.0, -99.0};
    double area = 0.0;
    for (size_t k = 0; k < sizeof flattenings / sizeof *flattenings; k++)
    {
        area = fmax(area, measure_areas(flattenings[k], 4 * points));
    }
    printf("\nArea elements on ellipsoids of b / a from 1/100 to 100: %.1f eps of their size\n",
           area);
    double lonlat[2] = {0.0, 0.0};
    measure_lonlat(20 * points, lonlat);
    printf("\nPlaces on a face from longitude and latitude, gnomonic: %.1f eps; back: %.1f eps of "
           "their size\n",
           lonlat[0], lonlat[1]);
    return failures > 0 || lonlat[0] > 12.0 || lonlat[1] > 12.0;
}
