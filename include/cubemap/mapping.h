/* SPDX-License-Identifier: MIT
 *
 * Mappings: forward (sphere to six faces, to a disc or to one square) and inverse, for one point and for
 * arrays, in double and in float.
 *
 * Conventions of every function here:
 *   direction   three finite numbers, not all zero, of any length; frame axes as in frame.h
 *   face        0..5, numbered by the mapping's frame; 255 (CM_NO_FACE) for "no face"
 *   u, v        [-1, 1], centre of the face (0, 0). Forward never leaves that square. Inverse takes
 *               u, v up to 1e-9 outside as the edge
 *   one face    azimuthal projections (CM_KIND_AZIMUTHAL) and layouts (CM_KIND_LAYOUT) have face 0 alone and
 *               no use for a frame. A projection's points are a disc: about the north pole
 *               u = r sin lon, v = -r cos lon, about other centres u is east and v north there, and r is 1
 *               at the rim, half the field of view from the centre. What is up to 1e-9 of the radius beyond
 *               it (1e-6 in float) is put on it; further out there is no point: CM_NO_FACE or NaN. At the
 *               centre's antipode, where every point of the rim is right, it is that of longitude 0, and
 *               inverse gives that direction exactly for the whole border of border:...
 *               Mappings between disc and square (CM_KIND_DISC_SQUARE) know no sphere: here
 *               they give CM_NO_FACE and NaN, see cm_warp
 *   bad input   a direction that is zero or has a NaN or an infinity gives CM_NO_FACE and NaN, NaN;
 *               a face above 5, a NaN, or u, v further outside give NaN, NaN, NaN. Nothing traps,
 *               nothing is read or written beyond the arguments
 *   ties        on an edge or a corner the first of x, y, z with the largest magnitude wins. The
 *               family CM_FAMILY_HYBRID has its own faces: healpix is on a polar one where
 *               3 |z| > 2 |d| by more than 4 eps, else on that of the first of x, y with the larger
 *               magnitude. An edge point that inverse has made a direction of is on the winner's
 *               edge for forward
 *   signs       a component of -0 gives a u or v of -0 or +0 by the frame's signs, and comes back
 *   accuracy    with the standard parameters u, v and the components of a direction are within 8 eps
 *               of the truth, eps = 2^-53 in double, 2^-24 in float, and 16 eps of their own size; a
 *               direction comes back from a round trip within 5 nm on Earth in double, 1e-6 rad in
 *               float (quincuncial, azimuthal:breusing, azimuthal:equidistant: 5.7 nm; maps of the whole sphere
 *               and other pairs of parts: 15 nm);
 *               the tier fast is less accurate (options.h). cm_mapping_info.bounds has the bounds of
 *               each mapping, docs/measured/certificate.md the errors themselves, and those of other parameters
 *   flat laws   where the radius of an azimuthal projection hardly grows with the angle, a rounding of u and v
 *               is far more on the sphere: beside the rim of a hemisphere of orthographic (up to 0.15 m
 *               in double), beside the antipode of whole spheres of lambert and mixture (0.3 m), so of
 *               border:... with these (0.1 m); quincuncial:orthographic,... has z there to sqrt(eps). About
 *               the antipode border:...,conformal draws the azimuth of 45 degrees out into the corners, so
 *               that a rounding of the direction is up to sqrt(eps) of u and v there
 *               Components of a direction that is turned to another centre, z of maps that go beyond
 *               the equator, and u and v of layouts are not relatively accurate where they pass 0
 *   cost        no allocation; a few square roots and divisions, and for some mappings polynomials,
 *               a point. Arrays are computed by vectors (options.h): 1 to 20 ns a point with AVX2 (the
 *               inverse of seamless 40), and single points cost 25 to 120 ns (200); docs/measured/speed.md has
 *               them all, beside the accuracy
 *   sources     of each mapping are in its descriptor (catalogue.h) and in its kernel
 *   threads     a mapping is constant after its creation: any number of threads may use one
 *   results     the same input gives the same bits in every function of one precision, whatever n,
 *               the position in the array and the thread; other instruction sets may differ in the last
 *               bits (options.h)
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

#define CM_NO_FACE 255

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

/* NULL is allowed. */
CM_API void cm_mapping_destroy(cm_mapping *mapping);

/* What the mapping was made from. Pointers live as long as the mapping. value is the parameter's
 * value, NaN if index is not below the descriptor's parameter_count. */
CM_API const cm_mapping_info *cm_mapping_describe(const cm_mapping *mapping);
CM_API const cm_frame *cm_mapping_frame(const cm_mapping *mapping);
CM_API double cm_mapping_parameter(const cm_mapping *mapping, size_t index);

/* One point. forward returns the face. mapping must not be NULL here and below; the result may
 * overwrite the argument. */
CM_API uint8_t cm_forward(const cm_mapping *mapping, const double direction[3], double uv[2]);
CM_API uint8_t cm_forward_f32(const cm_mapping *mapping, const float direction[3], float uv[2]);

/* direction is a unit vector, each component within 2 ulp of 1 of the truth for that u, v besides
 * the mapping's own error. */
CM_API void cm_inverse(const cm_mapping *mapping, uint8_t face, const double uv[2],
                       double direction[3]);
CM_API void cm_inverse_f32(const cm_mapping *mapping, uint8_t face, const float uv[2],
                           float direction[3]);

/* One point in lon/lat, radians, as in direction.h, whose accuracy they share: the bits are those of its functions
 * and of cm_forward and cm_inverse in a row. */
CM_API uint8_t cm_forward_lonlat(const cm_mapping *mapping, double lon, double lat, double uv[2]);
CM_API void cm_inverse_lonlat(const cm_mapping *mapping, uint8_t face, const double uv[2],
                              double lonlat[2]);

/* n points in lon/lat, radians, in separate arrays, by vectors: not the bits of the two functions above, which ask the C
 * library, but the same ones whatever n and the position. lon is any finite number (beyond 1e6 it takes the C
 * library's time), lat in [-pi/2, pi/2], up to 1e-9 beyond which is taken as the pole; inverse gives lon in [-pi, pi].
 * Error besides the mapping's own: 1.8 eps in each component of the direction, 3 eps of the size of lon and of
 * lat. Cost with AVX2 besides the mapping's own: 7 ns a point. Arrays may be NULL if n is 0; an output may be
 * the same array as an input. */
CM_API void cm_forward_lonlat_array(const cm_mapping *mapping, size_t n, const double *lon,
                                    const double *lat, uint8_t *face, double *u, double *v);
CM_API void cm_inverse_lonlat_array(const cm_mapping *mapping, size_t n, const uint8_t *face,
                                    const double *u, const double *v, double *lon, double *lat);

/* n points in separate arrays of n elements each. Arrays may be NULL if n is 0. An output array may
 * be the same as an input array (x and u, say); other overlaps are not allowed. No alignment beyond
 * the element's own is needed. Some 12 kB of stack. */
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
 * forward direction, or its inverse, though the published inverse differs from it by 0.7 % at most.
 * Accuracy: each element within 20 eps of the truth relative to the largest of its matrix (quincuncial 40), with
 * other than the standard parameters 64. Where derivatives grow without limit, beside the corners of a square with
 * squircle or elliptical, of border:...,conformal, and beside the antipode in turned maps of the whole sphere, it is
 * what the rounding of the point makes of them. Bad input gives NaN. */
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
 * CM_KIND_DISC_SQUARE: the disc's (p, q) to the square's (u, v) and back, all within 8 eps. A point of the disc
 * may be up to 1e-9 (1e-6 in float) outside, which is the rim. Where the square's corners are, the disc has no
 * numbers: beside them the rounding of p and q to eps is sqrt(eps) in u and v, and what is exact is the
 * result for the p and q that are given.
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
