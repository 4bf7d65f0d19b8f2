/* SPDX-License-Identifier: MIT
 *
 * Lengths and areas of the ellipsoid on the sphere that a grid makes of it, and so on its faces.
 */
#include <cubemap/cubemap.h>
#include <cubemap/kernels.h>

#include "grid_object.h"
#include "libcubemap/mapping/exception_flags.h"

#include <string.h>

/* Closer to a pole or to the equator than this, sines and cosines are proportional to the angle. */
#define SMALL 1e-200

/* Where a normal is on the ellipsoid, and what becomes of it. */
typedef struct place
{
    double sine; /* of the geographic latitude */
    double cosine;
    double widening;  /* cosine of the auxiliary latitude over that of the geographic one */
    double curvature; /* 1 - e^2 sine^2, as a sum */
} place;

/* Of a normal in the meridian of longitude 0. */
static void convert(const cm_grid *grid, double cosine, double sine, double to[3])
{
    const double normal[3] = {cosine, 0.0, sine};
    if (grid->there != NULL)
    {
        cm_latitude_convert_direction(grid->there, normal, to);
    }
    else
    {
        memcpy(to, normal, sizeof normal);
    }
}

/* Sine and cosine of a normal's latitude; what the latitude becomes is left. */
static place latitude_of(const double normal[3])
{
    place p = {0};
    double across = hypot(normal[0], normal[1]);
    double length = hypot(across, normal[2]);
    p.sine = normal[2] / length;
    p.cosine = fmax(across / length, SMALL);
    return p;
}

/* to: the cosine of the auxiliary latitude. */
static void complete(const cm_grid *grid, place *p, double to)
{
    p->widening = to / p->cosine;
    double polar = (1.0 - grid->ellipsoid.f) * p->sine;
    p->curvature = p->cosine * p->cosine + polar * polar;
}

static place place_of(const cm_grid *grid, const double normal[3])
{
    double to[3];
    place p = latitude_of(normal);
    convert(grid, p.cosine, p.sine, to);
    complete(grid, &p, to[0]);
    return p;
}

/* What is the same everywhere in d xi / d phi. */
static double slope_constant(const cm_grid *grid)
{
    double flat = 1.0 - grid->ellipsoid.f;
    switch (grid->latitude)
    {
    /* a tangent that is multiplied by k: the cosine is divided by sqrt(cos^2 + k^2 sin^2) */
    case CM_LATITUDE_GEOCENTRIC:
        return flat * flat;
    case CM_LATITUDE_PARAMETRIC:
        return flat;
    case CM_LATITUDE_AUTHALIC_APPROXIMATION:
        return cbrt(flat * flat * flat * flat);
    case CM_LATITUDE_AUTHALIC:
        return flat / (cm_ellipsoid_authalic_radius(&grid->ellipsoid) / grid->ellipsoid.a);
    case CM_LATITUDE_CONFORMAL:
        return flat * flat;
    case CM_LATITUDE_RECTIFYING:
    {
        /* in proportion to the radius of curvature, which is flat^2 on the equator */
        double to[3];
        convert(grid, 1.0, SMALL, to);
        return to[2] / SMALL;
    }
    case CM_LATITUDE_GEOGRAPHIC:
        break;
    }
    return 1.0;
}

/* d xi / d phi. */
static double slope_at(const cm_grid *grid, double constant, const place *p)
{
    switch (grid->latitude)
    {
    case CM_LATITUDE_GEOCENTRIC:
    case CM_LATITUDE_PARAMETRIC:
    case CM_LATITUDE_AUTHALIC_APPROXIMATION:
        return constant * p->widening * p->widening;
    case CM_LATITUDE_AUTHALIC:
    {
        double ratio = constant / p->curvature;
        return ratio * ratio / p->widening;
    }
    case CM_LATITUDE_CONFORMAL:
        return constant / p->curvature * p->widening;
    case CM_LATITUDE_RECTIFYING:
        return constant / (p->curvature * sqrt(p->curvature));
    case CM_LATITUDE_GEOGRAPHIC:
        break;
    }
    return constant;
}

/* Lengths on the unit sphere per length on the ellipsoid with equatorial radius 1. */
static void scales_at(const cm_grid *grid, double constant, const place *p, double *east,
                      double *north)
{
    double flat = 1.0 - grid->ellipsoid.f;
    double root = sqrt(p->curvature);
    *east = p->widening * root;
    *north = slope_at(grid, constant, p) * p->curvature * root / (flat * flat);
}

/* The cosines of the auxiliary latitudes of n places. */
static void convert_places(const cm_grid *grid, size_t n, const place *p, double *cosine)
{
    double zero[CM_BLOCK], sine[CM_BLOCK], none[CM_BLOCK];
    for (size_t i = 0; i < n; i++)
    {
        cosine[i] = p[i].cosine;
        sine[i] = p[i].sine;
        zero[i] = 0.0;
    }
    if (grid->there != NULL)
    {
        cm_latitude_convert_direction_array(grid->there, n, cosine, zero, sine, cosine, none, none);
    }
}

static void area_elements_of_block(const cm_grid *grid, double constant, size_t n,
                                   const uint8_t *face, const double *u, const double *v,
                                   double *area)
{
    double x[CM_BLOCK], y[CM_BLOCK], z[CM_BLOCK], scale[CM_BLOCK], cosine[CM_BLOCK];
    place p[CM_BLOCK];
    double a = grid->ellipsoid.a;
    cm_inverse_distortion_array(grid->mapping, n, face, u, v,
                                &(cm_distortion_arrays){.scale = scale});
    cm_inverse_array(grid->mapping, n, face, u, v, x, y, z);
    cm_grid_from_sphere_array(grid, n, x, y, z, x, y, z);
    for (size_t i = 0; i < n; i++)
    {
        p[i] = latitude_of((const double[3]){x[i], y[i], z[i]});
    }
    convert_places(grid, n, p, cosine);
    for (size_t i = 0; i < n; i++)
    {
        double east, north;
        complete(grid, &p[i], cosine[i]);
        scales_at(grid, constant, &p[i], &east, &north);
        area[i] = a * a / (east * north * scale[i]);
    }
}

/* ---- Public functions, documented in <cubemap/grid.h> ---- */

void cm_grid_area_element_array(const cm_grid *grid, size_t n, const uint8_t *face, const double *u,
                                const double *v, double *area)
{
    const cm_exceptions held = cm_exceptions_hold();
    double constant = slope_constant(grid);
    for (size_t done = 0; done < n; done += CM_BLOCK)
    {
        size_t count = n - done < CM_BLOCK ? n - done : CM_BLOCK;
        area_elements_of_block(grid, constant, count, face + done, u + done, v + done, area + done);
    }
    cm_exceptions_restore(held);
}

double cm_grid_area_element(const cm_grid *grid, uint8_t face, const double uv[2])
{
    double area;
    cm_grid_area_element_array(grid, 1, &face, &uv[0], &uv[1], &area);
    return area;
}

/* Two directions of the mapping's sphere, and lengths there per length on the ellipsoid with a = 1. */
typedef struct axes
{
    double east[3];
    double north[3];
    double east_scale;
    double north_scale;
} axes;

static axes axes_at(const cm_grid *grid, const double normal[3], const double direction[3])
{
    axes a;
    place p = place_of(grid, normal);
    scales_at(grid, slope_constant(grid), &p, &a.east_scale, &a.north_scale);
    /* at a pole any direction is east */
    double across = hypot(normal[0], normal[1]);
    const double east[3] = {across > 0.0 ? -normal[1] / across : 0.0,
                            across > 0.0 ? normal[0] / across : 1.0, 0.0};
    cm_rotate(&grid->rotation, east, a.east);
    double length = sqrt(direction[0] * direction[0] + direction[1] * direction[1] +
                         direction[2] * direction[2]);
    for (int i = 0; i < 3; i++)
    {
        int k = (i + 1) % 3;
        int l = (i + 2) % 3;
        a.north[i] = (direction[k] * a.east[l] - direction[l] * a.east[k]) / length;
    }
    return a;
}

/* A tangent vector of the sphere, stretched along the axes; so many elements apart. */
static void stretch(double *vector, int apart, const axes *a, double east_scale, double north_scale)
{
    double along = 0.0;
    double up = 0.0;
    for (int i = 0; i < 3; i++)
    {
        along += vector[i * apart] * a->east[i];
        up += vector[i * apart] * a->north[i];
    }
    for (int i = 0; i < 3; i++)
    {
        vector[i * apart] = east_scale * along * a->east[i] + north_scale * up * a->north[i];
    }
}

static cm_distortion distortion_of(const cm_grid *grid, cm_indicatrix_f64 r)
{
    return (cm_distortion){.major = r.major,
                           .minor = r.minor,
                           .orientation = r.orientation,
                           .scale = r.scale,
                           .deformation = r.deformation,
                           .area = r.area * grid->mapping->area_scale,
                           .isotropy = r.isotropy,
                           .texel_aspect = r.texel_aspect,
                           .texel_area = r.texel_area};
}

void cm_grid_forward_distortion(const cm_grid *grid, const double normal[3],
                                cm_distortion *distortion)
{
    const cm_exceptions held = cm_exceptions_hold();
    double direction[3], j[6];
    cm_grid_to_sphere(grid, normal, direction);
    cm_forward_jacobian(grid->mapping, direction, j);
    axes a = axes_at(grid, normal, direction);
    stretch(j, 1, &a, a.east_scale, a.north_scale);
    stretch(j + 3, 1, &a, a.east_scale, a.north_scale);
    const cm_gradients_f64 gradients = {
        .a_x = j[0], .a_y = j[1], .a_z = j[2], .b_x = j[3], .b_y = j[4], .b_z = j[5]};
    *distortion = distortion_of(grid, cm_indicatrix_of_gradients_f64(gradients));
    cm_exceptions_restore(held);
}

void cm_grid_inverse_distortion(const cm_grid *grid, uint8_t face, const double uv[2],
                                cm_distortion *distortion)
{
    const cm_exceptions held = cm_exceptions_hold();
    double direction[3], normal[3], j[6];
    cm_inverse(grid->mapping, face, uv, direction);
    cm_inverse_jacobian(grid->mapping, face, uv, j);
    cm_grid_from_sphere(grid, direction, normal);
    axes a = axes_at(grid, normal, direction);
    stretch(j, 2, &a, 1.0 / a.east_scale, 1.0 / a.north_scale);
    stretch(j + 1, 2, &a, 1.0 / a.east_scale, 1.0 / a.north_scale);
    const cm_tangents_f64 tangents = {
        .x_a = j[0], .x_b = j[1], .y_a = j[2], .y_b = j[3], .z_a = j[4], .z_b = j[5]};
    *distortion = distortion_of(grid, cm_indicatrix_of_tangents_f64(tangents));
    cm_exceptions_restore(held);
}
