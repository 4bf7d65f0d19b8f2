/* SPDX-License-Identifier: MIT
 *
 * The kernels in quadruple precision (113 bits), from the same text as all backends: the truth that
 * errors in double and in float are measured against. That the text itself is right is shown apart,
 * by the vectors of scripts/vectors, which come from the printed formulas.
 *
 * Needs gcc's libquadmath. Directions and faces are those of the frame geo.
 */
#ifndef TESTS_QUAD_H
#define TESTS_QUAD_H

#include <cubemap/cubemap.h>
#include <quadmath.h>

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
    cm_face_point_f128 (*project)(quad x, quad y, quad z);
    cm_xyz_f128 (*unproject)(quad face, quad a, quad b);
    cm_jacobian_f128 (*jacobian)(quad p, quad q, quad u, quad v, cm_constants_f128 k);
} quad_kernels;

/* By index in the catalogue. */
#define CM_DESCRIPTORS
#define CM_SPHERE(id, ...)                                                                         \
    {NULL, NULL, NULL, cm_##id##_project_f128, cm_##id##_unproject_f128, NULL},
#define CM_CHART(id, ...) {0},
#define CM_SPHERE_CONSTANTS(id, ...) {0},
#define CM_WARP(id, ...)                                                                           \
    {cm_##id##_prepare_f128, cm_##id##_forward_f128, cm_##id##_inverse_f128,                       \
     cm_cube_project_f128,   cm_cube_unproject_f128, cm_##id##_jacobian_f128},
static const quad_kernels quad_table[] = {
#include <cubemap/kernel/catalogue.h>
};
#undef CM_CHART
#undef CM_SPHERE_CONSTANTS
#undef CM_SPHERE
#undef CM_WARP
#undef CM_DESCRIPTORS

typedef struct quad_mapping
{
    const quad_kernels *kernels;
    cm_constants_f128 constants;
} quad_mapping;

/* The same mapping with the same parameters, as the doubles that they are. */
static inline quad_mapping quad_from(const cm_mapping *mapping)
{
    quad_mapping made = {&quad_table[0], cm_make_parameters_f128(0.0Q, 0.0Q)};
    for (size_t i = 0; i < cm_catalogue_count(); i++)
    {
        if (cm_catalogue_at(i) == cm_mapping_describe(mapping))
        {
            made.kernels = &quad_table[i];
        }
    }
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

static inline void quad_warp(const quad_mapping *mapping, const quad pq[2], quad uv[2])
{
    cm_uv_f128 r = mapping->kernels->warp(pq[0], pq[1], mapping->constants);
    uv[0] = r.u;
    uv[1] = r.v;
}

static inline void quad_unwarp(const quad_mapping *mapping, const quad uv[2], quad pq[2])
{
    cm_pq_f128 r = mapping->kernels->unwarp(uv[0], uv[1], mapping->constants);
    pq[0] = r.p;
    pq[1] = r.q;
}

static inline int quad_forward(const quad_mapping *mapping, const quad direction[3], quad uv[2])
{
    cm_face_point_f128 r = mapping->kernels->project(direction[0], direction[1], direction[2]);
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
    if (mapping->kernels->unwarp != NULL)
    {
        quad_unwarp(mapping, uv, pq);
    }
    cm_xyz_f128 r = mapping->kernels->unproject((quad)face, pq[0], pq[1]);
    direction[0] = r.x;
    direction[1] = r.y;
    direction[2] = r.z;
}

#pragma GCC diagnostic pop

#endif
