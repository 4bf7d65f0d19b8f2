/* SPDX-License-Identifier: MIT
 *
 * The kernels in quadruple precision (113 bits), from the same text as all backends: the truth that
 * errors in double and in float are measured against. That the text itself is right is shown apart,
 * by the vectors of research/vectors/vectors, which come from the printed formulas.
 *
 * Needs gcc's libquadmath. Directions and faces are those of the frame geo. What is made of parts is put
 * together here, as libcubemap/mapping/parts.inc does.
 */
#ifndef TRUTH_QUAD_H
#define TRUTH_QUAD_H

#include <cubemap/cubemap.h>
#include <quadmath.h>
#include <stdio.h>
#include <string.h>

/* the suffix Q of literals */
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"

__extension__ typedef __float128 quad;

/* What elementary.h holds, by the library's functions, and cm_atan, which some kernels use here only.
 * An excess is f(x) / x - 1, accurate to 2^-110 absolute, which is what its users need. */
static inline quad cm_excess_of(quad (*f)(quad), quad z)
{
    quad x = sqrtq(z);
    return z < 0x1p-200Q ? 0.0Q : f(x) / x - 1.0Q;
}

static inline quad cm_atan_excess_f128(quad z)
{
    return cm_excess_of(atanq, z);
}

static inline quad cm_tan_excess_f128(quad z)
{
    return cm_excess_of(tanq, z);
}

static inline quad cm_tanh_excess_f128(quad z)
{
    return cm_excess_of(tanhq, z);
}

static inline quad cm_atanh_excess_f128(quad z)
{
    return cm_excess_of(atanhq, z);
}

static inline quad cm_atan_f128(quad x)
{
    return atanq(x);
}

static inline quad cm_sin_quarter_f128(quad x)
{
    return sinq(x);
}

static inline quad cm_versine_quarter_f128(quad x)
{
    quad half = sinq(0.5Q * x);
    return 2.0Q * half * half;
}

static inline quad cm_trisect_f128(quad y, quad s)
{
    (void)s;
    return 2.0Q * sinq(asinq(fminq(1.0Q, y)) / 3.0Q);
}

#define CM_BACKEND 4
#include <cubemap/kernel/backend.h>
#undef CM_BACKEND
#include <cubemap/kernel/undefine.h>

/* One mapping; kernels that it does not have are NULL. */
typedef struct quad_kernels
{
    cm_constants_f128 (*prepare)(cm_constants_f128 parameters);
    cm_uv_f128 (*warp)(quad p, quad q, cm_constants_f128 k);
    cm_pq_f128 (*unwarp)(quad u, quad v, cm_constants_f128 k);
    cm_face_point_f128 (*project)(quad x, quad y, quad z, cm_constants_f128 k);
    cm_xyz_f128 (*unproject)(quad face, quad a, quad b, cm_constants_f128 k);
    cm_jacobian_f128 (*jacobian)(quad p, quad q, quad u, quad v, cm_constants_f128 k);
    cm_disc_point_f128 (*to_disc)(quad x, quad y, quad z, cm_constants_f128 k);
    cm_xyz_f128 (*from_disc)(cm_disc_point_f128 d, cm_constants_f128 k);
    cm_uv_f128 (*to_square)(cm_disc_point_f128 d);
    cm_disc_point_f128 (*from_square)(quad x, quad y);
} quad_kernels;

/* the faces of the cube, which take no constants */
static inline cm_face_point_f128 quad_cube_project(quad x, quad y, quad z, cm_constants_f128 k)
{
    (void)k;
    return cm_cube_project_f128(x, y, z);
}

static inline cm_xyz_f128 quad_cube_unproject(quad face, quad a, quad b, cm_constants_f128 k)
{
    (void)k;
    return cm_cube_unproject_f128(face, a, b);
}

/* By index in the catalogue. */
#define CM_DESCRIPTORS
#define CM_SPHERE(id, ...)                                                                         \
    {.prepare = cm_##id##_prepare_f128,                                                            \
     .project = cm_##id##_project_f128,                                                            \
     .unproject = cm_##id##_unproject_f128},
#define CM_LAYOUT(id, ...) {0},
#define CM_AZIMUTHAL(id, ...)                                                                      \
    {.prepare = cm_azimuthal_##id##_prepare_f128,                                                  \
     .to_disc = cm_azimuthal_##id##_project_f128,                                                  \
     .from_disc = cm_azimuthal_##id##_unproject_f128},
#define CM_SQUARE(id, ...)                                                                         \
    {.to_square = cm_square_##id##_forward_f128, .from_square = cm_square_##id##_inverse_f128},
#define CM_WARP(id, ...)                                                                           \
    {.prepare = cm_##id##_prepare_f128,                                                            \
     .warp = cm_##id##_forward_f128,                                                               \
     .unwarp = cm_##id##_inverse_f128,                                                             \
     .project = quad_cube_project,                                                                 \
     .unproject = quad_cube_unproject,                                                             \
     .jacobian = cm_##id##_jacobian_f128},
static const quad_kernels quad_table[] = {
#include <cubemap/kernel/kernel_catalogue.h>
};
#undef CM_LAYOUT
#undef CM_AZIMUTHAL
#undef CM_SQUARE
#undef CM_SPHERE
#undef CM_WARP
#undef CM_DESCRIPTORS

typedef struct quad_mapping
{
    const quad_kernels *kernels;
    cm_constants_f128 constants;
    cm_kind kind;
    const quad_kernels *azimuthal; /* the parts, of what is made of parts */
    const quad_kernels *square;
    int folded;
    int turned;
    quad axes[9]; /* by rows: south, east and outwards at the centre */
} quad_mapping;

static inline const quad_kernels *quad_kernels_of(const cm_mapping_info *info)
{
    size_t i = 0;
    while (i < cm_catalogue_count() && cm_catalogue_at(i) != info)
    {
        i++;
    }
    return &quad_table[i];
}

static inline double quad_parameter(const cm_mapping *mapping, const char *name, double otherwise)
{
    const cm_mapping_info *info = cm_mapping_describe(mapping);
    for (size_t i = 0; i < info->parameter_count; i++)
    {
        otherwise = strcmp(info->parameter[i].name, name) == 0 ? cm_mapping_parameter(mapping, i)
                                                               : otherwise;
    }
    return otherwise;
}

/* Exact at multiples of 90 degrees. */
static inline void quad_sine_cosine(double degrees, quad *sine, quad *cosine)
{
    quad turns = roundq((quad)degrees / 90.0Q);
    quad angle = ((quad)degrees - turns * 90.0Q) * (M_PIq / 180.0Q);
    quad s = sinq(angle);
    quad c = cosq(angle);
    int quarter = (int)(turns - 4.0Q * floorq(turns / 4.0Q));
    *sine = quarter == 0 ? s : quarter == 1 ? c : quarter == 2 ? -s : -c;
    *cosine = quarter == 0 ? c : quarter == 1 ? -s : quarter == 2 ? -c : s;
}

static inline void quad_turn_axes(quad_mapping *made, double lon, double lat)
{
    quad sine_lon, cosine_lon, sine_lat, cosine_lat;
    quad_sine_cosine(lon, &sine_lon, &cosine_lon);
    quad_sine_cosine(lat, &sine_lat, &cosine_lat);
    const quad axes[9] = {
        sine_lat * cosine_lon,   sine_lat * sine_lon,   -cosine_lat, -sine_lon, cosine_lon, 0.0Q,
        cosine_lat * cosine_lon, cosine_lat * sine_lon, sine_lat};
    made->turned = lon != 0.0 || lat != 90.0;
    memcpy(made->axes, axes, sizeof axes);
}

/* A part of that kind, "azimuthal" or "square", of a text that begins with the part's name. */
static inline const quad_kernels *quad_part(const char *kind, const char *text)
{
    char name[64];
    size_t length = strcspn(text, ",:");
    (void)snprintf(name, sizeof name, "%s:%.*s", kind, (int)length, text);
    return quad_kernels_of(cm_catalogue_find(name));
}

/* Where the two parts of a layout stand in what it is made from: "border:lambert,shirley,lon=3". */
static inline const char *quad_parts(const cm_mapping_info *info, const char *specification)
{
    const char *colon = strchr(specification, ':');
    int named = strncmp(specification, info->identifier, strlen(info->identifier)) == 0;
    if (!named && *info->aliases != '\0') /* "peirce:stereographic,conformal" */
    {
        return strchr(info->aliases, ':') + 1;
    }
    return colon == NULL || strcspn(colon + 1, "=") < strcspn(colon + 1, ",") ? info->parts
                                                                              : colon + 1;
}

static inline quad_mapping quad_from_parts(const cm_mapping *mapping, const char *specification)
{
    const cm_mapping_info *info = cm_mapping_describe(mapping);
    const quad_kernels *own = quad_kernels_of(info);
    quad_mapping made = {.kernels = own, .kind = info->kind, .azimuthal = own, .square = own};
    double fov =
        quad_parameter(mapping, "full", 0.0) != 0.0 ? 360.0 : quad_parameter(mapping, "fov", 180.0);
    if (info->parts != NULL)
    {
        const char *parts = quad_parts(info, specification);
        made.azimuthal = quad_part("azimuthal", parts);
        made.square = quad_part("square", parts + strcspn(parts, ",:") + 1);
        made.folded = strcmp(info->identifier, "quincuncial") == 0;
        fov = made.folded ? 180.0 : 360.0;
    }
    if (made.azimuthal->prepare != NULL)
    {
        made.constants = made.azimuthal->prepare(
            cm_make_parameters_f128((quad)fov, (quad)quad_parameter(mapping, "beta", 0.0)));
    }
    quad_turn_axes(&made, quad_parameter(mapping, "lon", 0.0),
                   quad_parameter(mapping, "lat", 90.0));
    return made;
}

/* The same mapping with the same parameters, as the doubles that they are; specification is what it was made
 * from, of which only the parts of a layout are read. */
static inline quad_mapping quad_from_text(const cm_mapping *mapping, const char *specification)
{
    const cm_mapping_info *info = cm_mapping_describe(mapping);
    if (info->kind == CM_KIND_AZIMUTHAL || info->kind == CM_KIND_DISC_SQUARE || info->parts != NULL)
    {
        return quad_from_parts(mapping, specification);
    }
    quad_mapping made = {.kernels = quad_kernels_of(info), .kind = info->kind};
    quad parameter[CM_PARAMETERS_MAX] = {0.0Q};
    for (size_t i = 0; i < cm_mapping_describe(mapping)->parameter_count; i++)
    {
        parameter[i] = (quad)cm_mapping_parameter(mapping, i);
    }
    made.constants = cm_make_parameters_f128(parameter[0], parameter[1]);
    made.constants.k2 = parameter[2];
    made.constants.k3 = parameter[3];
    made.constants.k4 = parameter[4];
    made.constants.k5 = parameter[5];
    if (made.kernels->prepare != NULL)
    {
        made.constants = made.kernels->prepare(made.constants);
    }
    return made;
}

static inline quad_mapping quad_from(const cm_mapping *mapping)
{
    return quad_from_text(mapping, cm_mapping_describe(mapping)->identifier);
}

static inline void quad_warp(const quad_mapping *mapping, const quad pq[2], quad uv[2])
{
    cm_uv_f128 r = mapping->square != NULL
                       ? mapping->square->to_square(cm_make_disc_point_f128(pq[0], pq[1]))
                       : mapping->kernels->warp(pq[0], pq[1], mapping->constants);
    uv[0] = r.u;
    uv[1] = r.v;
}

static inline void quad_unwarp(const quad_mapping *mapping, const quad uv[2], quad pq[2])
{
    if (mapping->square != NULL)
    {
        cm_disc_point_f128 d = mapping->square->from_square(uv[0], uv[1]);
        pq[0] = d.u;
        pq[1] = d.v;
        return;
    }
    cm_pq_f128 r = mapping->kernels->unwarp(uv[0], uv[1], mapping->constants);
    pq[0] = r.p;
    pq[1] = r.q;
}

/* The components along the axes of the centre, and with back from them. */
static inline void quad_turn(const quad_mapping *mapping, int back, const quad from[3], quad to[3])
{
    for (int k = 0; k < 3; k++)
    {
        const quad *row = &mapping->axes[back ? k : 3 * k];
        int step = back ? 3 : 1;
        to[k] = mapping->turned ? row[0] * from[0] + row[step] * from[1] + row[2 * step] * from[2]
                                : from[k];
    }
}

/* How far inside the field of view, relative to its radius: 1 at the centre, less than 0 outside. */
static inline quad quad_inside(const quad_mapping *mapping, const quad direction[3])
{
    quad d[3];
    quad_turn(mapping, 0, direction, d);
    d[2] = mapping->folded ? fabsq(d[2]) : d[2];
    cm_constants_f128 k = mapping->constants;
    return cm_azimuthal_bearing_f128(d[0], d[1], d[2], k).t.margin / (k.k0 * k.k0);
}

static inline int quad_forward_parts(const quad_mapping *mapping, const quad direction[3],
                                     quad uv[2])
{
    quad d[3];
    quad_turn(mapping, 0, direction, d);
    quad side = mapping->folded && d[2] < 0.0Q ? -1.0Q : 1.0Q;
    cm_disc_point_f128 disc =
        mapping->azimuthal->to_disc(d[0], d[1], d[2] * side, mapping->constants);
    uv[0] = disc.u;
    uv[1] = disc.v;
    if (mapping->kind == CM_KIND_LAYOUT)
    {
        cm_uv_f128 r = mapping->square->to_square(disc);
        r = mapping->folded ? cm_quincuncial_place_f128(r.u, r.v, side) : r;
        uv[0] = r.u;
        uv[1] = r.v;
    }
    return quad_inside(mapping, direction) >= -1e-9Q ? 0 : CM_NO_FACE;
}

static inline void quad_inverse_parts(const quad_mapping *mapping, const quad uv[2],
                                      quad direction[3])
{
    cm_face_point_f128 p = {.face = 1.0Q, .a = uv[0], .b = uv[1]};
    p = mapping->folded ? cm_quincuncial_unplace_f128(uv[0], uv[1]) : p;
    cm_disc_point_f128 d = mapping->kind == CM_KIND_LAYOUT ? mapping->square->from_square(p.a, p.b)
                                                           : cm_make_disc_point_f128(p.a, p.b);
    cm_xyz_f128 r = mapping->azimuthal->from_disc(d, mapping->constants);
    const quad about[3] = {r.x, r.y, r.z * p.face};
    quad_turn(mapping, 1, about, direction);
}

static inline int quad_forward(const quad_mapping *mapping, const quad direction[3], quad uv[2])
{
    if (mapping->azimuthal != NULL)
    {
        return quad_forward_parts(mapping, direction, uv);
    }
    cm_face_point_f128 r = mapping->kernels->project(direction[0], direction[1], direction[2],
                                                     mapping->constants);
    uv[0] = r.a;
    uv[1] = r.b;
    if (mapping->kernels->warp != NULL)
    {
        quad pq[2] = {r.a, r.b};
        quad_warp(mapping, pq, uv);
    }
    return (int)r.face;
}

static inline void quad_inverse(const quad_mapping *mapping, int face, const quad uv[2],
                                quad direction[3])
{
    quad pq[2] = {uv[0], uv[1]};
    if (mapping->azimuthal != NULL)
    {
        quad_inverse_parts(mapping, uv, direction);
        return;
    }
    if (mapping->kernels->unwarp != NULL)
    {
        quad_unwarp(mapping, uv, pq);
    }
    cm_xyz_f128 r = mapping->kernels->unproject((quad)face, pq[0], pq[1], mapping->constants);
    direction[0] = r.x;
    direction[1] = r.y;
    direction[2] = r.z;
}

#pragma GCC diagnostic pop

#endif
