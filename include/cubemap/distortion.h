/* SPDX-License-Identifier: MIT
 *
 * Distortion at a point of a map: Tissot's indicatrix, what cartographers and renderers derive from it, and the
 * shape of a texel. From the Jacobians of mapping.h in closed form, no finite differences.
 *
 * Conventions beside those of mapping.h (directions, faces, u and v, bad input, results, overlaps, threads):
 *   units       lengths of the map are those of u and v, a face being 2 wide; lengths of the sphere and angles are
 *               radians
 *   one face    the mean scale is 6/pi of a cube, 1/pi of a layout (of rhealpix 3/(8 pi)), and for an azimuthal
 *               projection 1/4 of the whole sphere, 1/2 of a hemisphere; area is relative to that.
 *               Mappings between disc and square give NaN: cm_warp_jacobian has their derivatives
 *   creases     where derivatives jump the values are those of the face and the side that the point counts to
 *   singular    where a map stands still or a law ends, values are infinite, 0 or NaN; docs/guide/conventions.md
 *               says where
 *   sources     Tissot 1881 by Snyder, Map projections: a working manual, 1987, pp. 20-26 (a, b, s, omega); Lambers,
 *               Mappings between sphere, disc, and square, 2016, section 5.1 (D_A, D_I); Dimitrijevic, Lambers,
 *               Rancic, Comparison of spherical cube map projections, 2016, eqs. 3.4 to 3.7 (texels)
 */
#ifndef CUBEMAP_DISTORTION_H
#define CUBEMAP_DISTORTION_H

#include <stddef.h>
#include <stdint.h>

#include <cubemap/export.h>
#include <cubemap/mapping.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What there is at a point. This struct will not change. */
typedef struct cm_distortion
{
    double major; /* a >= b > 0, the semi-axes: lengths on the map per radian of the sphere */
    double minor; /* b */
    double
        orientation; /* of the major axis on the map: the angle from +u towards +v, (-pi/2, pi/2] */
    double scale;    /* s = a b: area on the map per area of the sphere; its mean is above */
    double
        deformation; /* omega = 2 asin((a - b) / (a + b)): by how much an angle can differ, [0, pi) */
    double area;     /* D_A = s over its mean: 1 where the map has its mean scale */
    double isotropy;     /* D_I = a / b >= 1 */
    double texel_aspect; /* width over height of a texel on the sphere: Lambda_x / Lambda_y */
    double
        texel_area; /* width times height, Lambda_x Lambda_y / (du dv), without the sine of the angle
                            between them; the paper's is this over its value at the centre of the face */
} cm_distortion;

/* The same in float. */
typedef struct cm_distortion_f32
{
    float major;        /* a */
    float minor;        /* b */
    float orientation;  /* of the major axis */
    float scale;        /* s */
    float deformation;  /* omega */
    float area;         /* D_A */
    float isotropy;     /* D_I */
    float texel_aspect; /* width over height of a texel */
    float texel_area;   /* width times height of a texel */
} cm_distortion_f32;

/* Where n of each go; NULL for what is not wanted. An array may be one of the inputs' arrays. */
typedef struct cm_distortion_arrays
{
    double *major;        /* a */
    double *minor;        /* b */
    double *orientation;  /* of the major axis */
    double *scale;        /* s */
    double *deformation;  /* omega */
    double *area;         /* D_A */
    double *isotropy;     /* D_I */
    double *texel_aspect; /* width over height of a texel */
    double *texel_area;   /* width times height of a texel */
} cm_distortion_arrays;

/* The same in float. */
typedef struct cm_distortion_arrays_f32
{
    float *major;        /* a */
    float *minor;        /* b */
    float *orientation;  /* of the major axis */
    float *scale;        /* s */
    float *deformation;  /* omega */
    float *area;         /* D_A */
    float *isotropy;     /* D_I */
    float *texel_aspect; /* width over height of a texel */
    float *texel_area;   /* width times height of a texel */
} cm_distortion_arrays_f32;

/* At a direction, which cm_forward counts to its face and side; at a point of a face. Bad input gives
 * NaN in all of them. */
CM_API void cm_forward_distortion(const cm_mapping *mapping, const double direction[3],
                                  cm_distortion *distortion);
CM_API void cm_forward_distortion_f32(const cm_mapping *mapping, const float direction[3],
                                      cm_distortion_f32 *distortion);
CM_API void cm_inverse_distortion(const cm_mapping *mapping, uint8_t face, const double uv[2],
                                  cm_distortion *distortion);
CM_API void cm_inverse_distortion_f32(const cm_mapping *mapping, uint8_t face, const float uv[2],
                                      cm_distortion_f32 *distortion);

/* The same of n points in separate arrays of n elements each. For several threads there is
 * cm_run_threads (threads.h). */
CM_API void cm_forward_distortion_array(const cm_mapping *mapping, size_t n, const double *x,
                                        const double *y, const double *z,
                                        const cm_distortion_arrays *distortion);
CM_API void cm_forward_distortion_array_f32(const cm_mapping *mapping, size_t n, const float *x,
                                            const float *y, const float *z,
                                            const cm_distortion_arrays_f32 *distortion);
CM_API void cm_inverse_distortion_array(const cm_mapping *mapping, size_t n, const uint8_t *face,
                                        const double *u, const double *v,
                                        const cm_distortion_arrays *distortion);
CM_API void cm_inverse_distortion_array_f32(const cm_mapping *mapping, size_t n,
                                            const uint8_t *face, const float *u, const float *v,
                                            const cm_distortion_arrays_f32 *distortion);

#ifdef __cplusplus
}
#endif

#endif
