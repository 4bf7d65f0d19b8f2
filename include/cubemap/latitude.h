/* SPDX-License-Identifier: MIT
 *
 * Auxiliary latitudes of an ellipsoid, each to each, forward and back.
 *
 *   geographic    phi    the angle of the normal with the equator's plane: what maps and GPS give
 *   geocentric    theta  tan theta = (1 - f)^2 tan phi: the angle of the direction from the centre
 *   parametric    beta   tan beta = (1 - f) tan phi: on the sphere that is stretched to the ellipsoid
 *   authalic      xi     areas on a sphere are as those on the ellipsoid
 *   conformal     chi    angles are
 *   rectifying    mu     lengths along a meridian are
 *   authalic-approximation  tan = (1 - f)^(4/3) tan phi (Dimitrijevic et al. 2020); on WGS 84 it is up to
 *                        0.1159 arc seconds, 3.58 m, from the authalic latitude (at 25.6 degrees)
 *
 * Conventions of every function here:
 *   angles      radians, in [-pi/2, pi/2]; beyond that by 1e-9 at most they are taken as the pole, which is the double
 *               nearest to pi/2. Poles, the equator and the sign of zero stay what they are
 *   directions  (x, y, z) of any finite length but zero, z north; the result has length 1. They keep what an angle
 *               loses: a distance from the pole of 1e-300 is relatively as accurate as any other
 *   bad input   angles beyond, NaN, infinities and a direction without length give NaN. Nothing traps, nothing is read or
 *               written beyond the arguments, for any n
 *   accuracy    in units of 2^-53, 1.1e-16, of angles in radians (beside the equator also relative to them), of directions
 *               relative to the component along z and to the distance from the axis:
 *                                                       angle   direction
 *                   flattenings from -1/50 to 1/50       2       4.5
 *                   beyond, between those of a ratio     3       6
 *                   beyond, others; options.exact        8      12
 *               A ratio is what tangents of geographic, geocentric, parametric and approximate latitude have. With a
 *               tolerance, the error that cm_latitude_conversion_error states is added. Where one latitude changes
 *               faster than the other, as conformal ones of prolate ellipsoids of b / a = 100 do, the bound for
 *               directions counts times that condition. tests/earth/test_latitude_accuracy.c holds them to it, against quadruple
 *               precision, at poles, equator and beside them; docs/guide/latitudes.md has what was measured
 *   cost        by series 1.5 to 2.1 ns an angle and 2.3 ns a direction in arrays with AVX-512, by ratios 3.2 and 1.4 ns;
 *               by closed forms 0.1 to 0.6 us. No allocation but for the conversion itself
 *   threads     a conversion is constant after its creation: any number of threads may use one
 *   results     the same input gives the same bits, alone or anywhere in an array; instruction sets differ by no more
 *               than the bounds. Outputs may be inputs
 *
 * Series are those of C. F. F. Karney, On auxiliary latitudes, Survey Review 56 (2024), anew derived by
 * research/earth/latitude-series: a sum of C_k sin 2k phi, each C_k a power series of the third flattening n = f / (2 - f).
 * Definitions and closed forms: O. S. Adams, Latitude developments connected with geodesy and cartography, USC&GS
 * Special Publication 67 (1921); J. P. Snyder, Map projections: a working manual, USGS Professional Paper 1395
 * (1987), section 3; B. C. Carlson's elliptic integrals. libcubemap/earth/latitude_exact.c has them in forms without
 * cancellation. Shaders have kernel/auxiliary_latitude.h.
 */
#ifndef CUBEMAP_LATITUDE_H
#define CUBEMAP_LATITUDE_H

#include <stddef.h>

#include <cubemap/ellipsoid.h>
#include <cubemap/export.h>
#include <cubemap/status.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum cm_latitude
{
    CM_LATITUDE_GEOGRAPHIC = 0,
    CM_LATITUDE_GEOCENTRIC = 1,
    CM_LATITUDE_PARAMETRIC = 2,
    CM_LATITUDE_AUTHALIC = 3,
    CM_LATITUDE_CONFORMAL = 4,
    CM_LATITUDE_RECTIFYING = 5,
    CM_LATITUDE_AUTHALIC_APPROXIMATION = 6
} cm_latitude;

#define CM_LATITUDE_COUNT 7

/* "geographic"...; NULL for what is none. find takes upper and lower case as the same:
 * CM_OK, CM_ERROR_ARGUMENT (NULL), CM_ERROR_LATITUDE; *latitude is untouched on failure. */
CM_API const char *cm_latitude_name(cm_latitude latitude);
CM_API cm_status cm_latitude_find(const char *name, cm_latitude *latitude);

/* Up to this flattening, oblate or prolate, there are series. */
#define CM_LATITUDE_SERIES_FLATTENING 0.02

/* A conversion from one latitude to another on one ellipsoid. The size of the ellipsoid does not matter, and the
 * conversion keeps nothing of what it was made from. */
typedef struct cm_latitude_conversion cm_latitude_conversion;

/* To be filled with zeros but for size, which is sizeof(cm_latitude_options), and for what is wanted. */
typedef struct cm_latitude_options
{
    size_t size;
    double
        tolerance; /* radians, not below 0: the series has the least terms that keep it; 0: full double */
    int exact;                /* closed forms and iterations whatever the flattening */
    const char *instructions; /* as in options.h */
} cm_latitude_options;

/* Makes *conversion, to be destroyed. options may be NULL, which is all zeros.
 * Errors, *conversion being untouched: CM_ERROR_ARGUMENT (a pointer is NULL, a size is none, the tolerance is below 0,
 * infinite or NaN), CM_ERROR_ELLIPSOID, CM_ERROR_LATITUDE, CM_ERROR_INSTRUCTIONS, CM_ERROR_MEMORY. */
CM_API cm_status cm_latitude_conversion_create(const cm_ellipsoid *ellipsoid, cm_latitude from,
                                               cm_latitude to, const cm_latitude_options *options,
                                               cm_latitude_conversion **conversion);
CM_API void
cm_latitude_conversion_destroy(cm_latitude_conversion *conversion); /* NULL is allowed */

/* The terms of the series, 1 to 12; 0 for closed forms, which ratios of tangents are, too. And what is cut off, in
 * radians: a bound that holds at every latitude, 0 for closed forms. On WGS 84 full double takes six terms at most,
 * a millimetre three, a metre two. */
CM_API int cm_latitude_conversion_order(const cm_latitude_conversion *conversion);
CM_API double cm_latitude_conversion_error(const cm_latitude_conversion *conversion);

#define CM_LATITUDE_CONSTANTS 13

/* What the kernels take that shaders and programs inline (kernel/auxiliary_latitude.h): p0 to p11 and ratio of
 * cm_latitude_constants, in that order, and for which number of terms, 3, 6 or 12; 0 for a ratio of tangents.
 * CM_OK; with constants and terms untouched CM_ERROR_ARGUMENT (NULL), or CM_ERROR_UNSUPPORTED for what takes iterations. */
CM_API cm_status cm_latitude_conversion_constants(const cm_latitude_conversion *conversion,
                                                  double constants[CM_LATITUDE_CONSTANTS],
                                                  int *terms);

/* One latitude, radians. */
CM_API double cm_latitude_convert(const cm_latitude_conversion *conversion, double latitude);

/* A direction whose latitude is the one becomes one of the other, in the same longitude. from and to are three
 * numbers each, and may be the same. */
CM_API void cm_latitude_convert_direction(const cm_latitude_conversion *conversion,
                                          const double from[3], double to[3]);

/* n at once, n numbers in each array; pointers may be NULL if n is 0. An output array may be the input array in its
 * place, but not overlap it otherwise. */
CM_API void cm_latitude_convert_array(const cm_latitude_conversion *conversion, size_t n,
                                      const double *from, double *to);
CM_API void cm_latitude_convert_direction_array(const cm_latitude_conversion *conversion, size_t n,
                                                const double *x, const double *y, const double *z,
                                                double *to_x, double *to_y, double *to_z);

#ifdef __cplusplus
}
#endif

#endif
