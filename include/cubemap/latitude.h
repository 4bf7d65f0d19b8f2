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
 *   authalic-approximation  tan = (1 - f)^(4/3) tan phi (Dimitrijevic et al. 2020)
 *
 *   angles      radians, in [-pi/2, pi/2], up to 1e-9 beyond which is taken as the pole
 *   directions  (x, y, z) of any finite length but zero, z north; the result has length 1
 *   bad input   gives NaN. Nothing traps; nothing is read or written beyond the arguments
 *   results     the same input gives the same bits, alone or anywhere in an array. Outputs may be inputs
 *   threads     a conversion is constant after its creation: any number of threads may use one
 *
 * docs/guide/latitudes.md has definitions and sources, docs/measured/accuracy.md and costs.md bounds and times.
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

/* The latitudes of above. */
typedef enum cm_latitude
{
    CM_LATITUDE_GEOGRAPHIC = 0,            /* phi */
    CM_LATITUDE_GEOCENTRIC = 1,            /* theta */
    CM_LATITUDE_PARAMETRIC = 2,            /* beta */
    CM_LATITUDE_AUTHALIC = 3,              /* xi */
    CM_LATITUDE_CONFORMAL = 4,             /* chi */
    CM_LATITUDE_RECTIFYING = 5,            /* mu */
    CM_LATITUDE_AUTHALIC_APPROXIMATION = 6 /* nearly xi */
} cm_latitude;

/* How many latitudes there are. */
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
    size_t size; /* sizeof(cm_latitude_options) */
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
 * radians: a bound that holds at every latitude, 0 for closed forms. */
CM_API int cm_latitude_conversion_order(const cm_latitude_conversion *conversion);
CM_API double cm_latitude_conversion_error(const cm_latitude_conversion *conversion);

/* The numbers of cm_latitude_conversion_constants. */
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
