/* SPDX-License-Identifier: MIT
 *
 * Mappings: forward (sphere to faces) and inverse, for one point and for arrays, in double and in float.
 *
 *   direction   three finite numbers, not all zero, of any length; axes as in frame.h
 *   face        0..5, numbered by the mapping's frame; 255 (CM_NO_FACE) for "no face". Azimuthal projections and
 *               layouts have face 0 alone
 *   u, v        [-1, 1], centre of the face (0, 0). Forward never leaves that square; inverse takes u, v up to
 *               1e-9 outside as the edge
 *   bad input   a direction that is zero, NaN or infinite gives CM_NO_FACE and NaN, NaN; a face above 5, a NaN, or
 *               u, v further outside give three NaN. Nothing is read or written beyond the arguments
 *   exceptions  nothing traps, and the flags of <fenv.h> are as they were (docs/guide/conventions.md)
 *   ties        on an edge or a corner of the cube the first of x, y, z with the largest magnitude wins
 *   results     the same input gives the same bits in every function of one precision, whatever n, the position
 *               in the array and the thread; instruction sets may differ in the last bits (options.h)
 *   threads     a mapping is constant after its creation: any number of threads may use one
 *   example     uint8_t face = cm_forward(mapping, direction, uv);
 *
 * docs/guide/conventions.md has this in full, docs/measured/accuracy.md bounds, docs/measured/costs.md times.
 */
#ifndef CUBEMAP_MAPPING_H
#define CUBEMAP_MAPPING_H

#include <stddef.h>
#include <stdint.h>

#include <cubemap/catalogue.h>
#include <cubemap/export.h>
#include <cubemap/frame.h>
#include <cubemap/status.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The face of what is on none. */
#define CM_NO_FACE 255

/* A mapping, from cm_mapping_create to cm_mapping_destroy. */
typedef struct cm_mapping cm_mapping;

/* Make a mapping from a specification, NAME[:PARAMETER=VALUE[,PARAMETER=VALUE...]] or NAME:PRESET, e.g.
 * "algebraic", "tangent:c=1.1823", "difference:mild"; NAME is an identifier or an alias of the catalogue,
 * PRESET one of the mapping's, which sets all its parameters and stands alone; parameters that are not
 * given have their standard values. Upper and lower case are the same, values are decimal numbers with a
 * point in every locale. frame NULL means geo; the table is copied, but not the texts that it points to. On success *mapping is to be given to
 * cm_mapping_destroy.
 * Errors: CM_ERROR_ARGUMENT, _SYNTAX, _MAPPING, _PARAMETER, _RANGE, _FRAME, _MEMORY, _INSTRUCTIONS;
 * cm_specification_check says what is wrong in words. */
CM_API cm_status cm_mapping_create(const char *specification, const cm_frame *frame,
                                   cm_mapping **mapping);

/* The same mapping once more, with its parameters, parts, frame, tier and instruction set. *copy is to be given to
 * cm_mapping_destroy, before or after the other one.
 * Errors: CM_ERROR_ARGUMENT (NULL), CM_ERROR_MEMORY. */
CM_API cm_status cm_mapping_copy(const cm_mapping *mapping, cm_mapping **copy);

/* NULL is allowed. */
CM_API void cm_mapping_destroy(cm_mapping *mapping);

/* What the mapping was made from. Pointers live as long as the mapping. value is the parameter's
 * value, NaN if index is not below the descriptor's parameter_count. */
CM_API const cm_mapping_info *cm_mapping_describe(const cm_mapping *mapping);
CM_API const cm_frame *cm_mapping_frame(const cm_mapping *mapping);
CM_API double cm_mapping_parameter(const cm_mapping *mapping, size_t index);

/* 1 if the bounds of its descriptor hold (cm_mapping_info.bounds): its parameters are the standard ones or those of a
 * preset, and its parts those it has when none are given; else 0. */
CM_API int cm_mapping_has_bounds(const cm_mapping *mapping);

/* One point. forward returns the face. mapping must not be NULL here and below; the result may
 * overwrite the argument. */
CM_API uint8_t cm_forward(const cm_mapping *mapping, const double direction[3], double uv[2]);
CM_API uint8_t cm_forward_f32(const cm_mapping *mapping, const float direction[3], float uv[2]);

/* One point back: direction is a unit vector. */
CM_API void cm_inverse(const cm_mapping *mapping, uint8_t face, const double uv[2],
                       double direction[3]);
CM_API void cm_inverse_f32(const cm_mapping *mapping, uint8_t face, const float uv[2],
                           float direction[3]);

/* One point in lon/lat, radians, as in direction.h: the bits are those of its functions
 * and of cm_forward and cm_inverse in a row. */
CM_API uint8_t cm_forward_lonlat(const cm_mapping *mapping, double lon, double lat, double uv[2]);
CM_API void cm_inverse_lonlat(const cm_mapping *mapping, uint8_t face, const double uv[2],
                              double lonlat[2]);

/* n points in lon/lat, radians, in separate arrays, by vectors: not the bits of the two functions above, which ask the C
 * library, but the same ones whatever n and the position. lon is any finite number (beyond 1e6 it takes the C
 * library's time), lat in [-pi/2, pi/2], up to 1e-9 beyond which is taken as the pole; inverse gives lon in [-pi, pi].
 * Arrays may be NULL if n is 0; an output may be the same array as an input. */
CM_API void cm_forward_lonlat_array(const cm_mapping *mapping, size_t n, const double *lon,
                                    const double *lat, uint8_t *face, double *u, double *v);
CM_API void cm_inverse_lonlat_array(const cm_mapping *mapping, size_t n, const uint8_t *face,
                                    const double *u, const double *v, double *lon, double *lat);

/* n points in separate arrays of n elements each. Arrays may be NULL if n is 0. An output array may
 * be the same as an input array (x and u, say); other overlaps are not allowed. No alignment beyond
 * the element's own is needed. */
CM_API void cm_forward_array(const cm_mapping *mapping, size_t n, const double *x, const double *y,
                             const double *z, uint8_t *face, double *u, double *v);
CM_API void cm_forward_array_f32(const cm_mapping *mapping, size_t n, const float *x,
                                 const float *y, const float *z, uint8_t *face, float *u, float *v);
CM_API void cm_inverse_array(const cm_mapping *mapping, size_t n, const uint8_t *face,
                             const double *u, const double *v, double *x, double *y, double *z);
CM_API void cm_inverse_array_f32(const cm_mapping *mapping, size_t n, const uint8_t *face,
                                 const float *u, const float *v, float *x, float *y, float *z);

/* n directions in one array: x, y, z of point i are xyz[i * stride], xyz[i * stride + 1] and
 * xyz[i * stride + 2]; stride counts elements, is 3 for a dense array, and may be any number,
 * negative included, that keeps the points apart when they are written. What lies between the points
 * is neither read nor written. No output array may overlap an input array. */
CM_API void cm_forward_strided(const cm_mapping *mapping, size_t n, const double *xyz,
                               ptrdiff_t stride, uint8_t *face, double *u, double *v);
CM_API void cm_forward_strided_f32(const cm_mapping *mapping, size_t n, const float *xyz,
                                   ptrdiff_t stride, uint8_t *face, float *u, float *v);
CM_API void cm_inverse_strided(const cm_mapping *mapping, size_t n, const uint8_t *face,
                               const double *u, const double *v, double *xyz, ptrdiff_t stride);
CM_API void cm_inverse_strided_f32(const cm_mapping *mapping, size_t n, const uint8_t *face,
                                   const float *u, const float *v, float *xyz, ptrdiff_t stride);

/* Jacobians, in closed form. forward: d(u, v) / d(x, y, z), 2 x 3 by rows, at the direction scaled to unit
 * length, so per radian; the product with the direction is zero. inverse: d(x, y, z) / d(u, v) of the unit
 * direction, 3 x 2 by rows. Arrays take six outputs of n elements each, in that order; an input
 * array may be the same as one of them. Creases: the values of the side that forward, or the face, counts
 * the point to; the diagonals of qsc belong to |p| >= |q|. smoothstep with c = 1 has a
 * singular Jacobian on the edges, where the inverse's is infinite or NaN. cobe:legacy=1 has that of the
 * forward direction, or its inverse, though the published inverse differs a little from it.
 * Bad input gives NaN. */
CM_API void cm_forward_jacobian(const cm_mapping *mapping, const double direction[3],
                                double jacobian[6]);
CM_API void cm_forward_jacobian_f32(const cm_mapping *mapping, const float direction[3],
                                    float jacobian[6]);
CM_API void cm_inverse_jacobian(const cm_mapping *mapping, uint8_t face, const double uv[2],
                                double jacobian[6]);
CM_API void cm_inverse_jacobian_f32(const cm_mapping *mapping, uint8_t face, const float uv[2],
                                    float jacobian[6]);
CM_API void cm_forward_jacobian_array(const cm_mapping *mapping, size_t n, const double *x,
                                      const double *y, const double *z, double *const jacobian[6]);
CM_API void cm_forward_jacobian_array_f32(const cm_mapping *mapping, size_t n, const float *x,
                                          const float *y, const float *z, float *const jacobian[6]);
CM_API void cm_inverse_jacobian_array(const cm_mapping *mapping, size_t n, const uint8_t *face,
                                      const double *u, const double *v, double *const jacobian[6]);
CM_API void cm_inverse_jacobian_array_f32(const cm_mapping *mapping, size_t n, const uint8_t *face,
                                          const float *u, const float *v, float *const jacobian[6]);

/* The plane part alone, without the sphere. Of a mapping to six faces: gnomonic (p, q) to (u, v) and back,
 * both in [-1, 1]^2 with the same tolerance and the same NaN as above; independent of frame and face. Of
 * CM_KIND_DISC_SQUARE: the disc's (p, q) to the square's (u, v) and back. A point of the disc may be up to 1e-9
 * (1e-6 in float) outside, which is the rim.
 * jacobian: d(u, v) / d(p, q), 2 x 2 by rows; infinite or NaN at the corners of a square that are on the disc's
 * rim (squircle, elliptical, conformal). Arrays as above, of four outputs there.
 * CM_OK; CM_ERROR_UNSUPPORTED if there is no such part: healpix, azimuthal projections, layouts. */
CM_API cm_status cm_warp(const cm_mapping *mapping, const double pq[2], double uv[2]);
CM_API cm_status cm_warp_f32(const cm_mapping *mapping, const float pq[2], float uv[2]);
CM_API cm_status cm_unwarp(const cm_mapping *mapping, const double uv[2], double pq[2]);
CM_API cm_status cm_unwarp_f32(const cm_mapping *mapping, const float uv[2], float pq[2]);
CM_API cm_status cm_warp_array(const cm_mapping *mapping, size_t n, const double *p,
                               const double *q, double *u, double *v);
CM_API cm_status cm_warp_array_f32(const cm_mapping *mapping, size_t n, const float *p,
                                   const float *q, float *u, float *v);
CM_API cm_status cm_unwarp_array(const cm_mapping *mapping, size_t n, const double *u,
                                 const double *v, double *p, double *q);
CM_API cm_status cm_unwarp_array_f32(const cm_mapping *mapping, size_t n, const float *u,
                                     const float *v, float *p, float *q);
CM_API cm_status cm_warp_jacobian(const cm_mapping *mapping, const double pq[2],
                                  double jacobian[4]);
CM_API cm_status cm_warp_jacobian_f32(const cm_mapping *mapping, const float pq[2],
                                      float jacobian[4]);
CM_API cm_status cm_warp_jacobian_array(const cm_mapping *mapping, size_t n, const double *p,
                                        const double *q, double *const jacobian[4]);
CM_API cm_status cm_warp_jacobian_array_f32(const cm_mapping *mapping, size_t n, const float *p,
                                            const float *q, float *const jacobian[4]);

#ifdef __cplusplus
}
#endif

#endif
