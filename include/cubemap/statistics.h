/* SPDX-License-Identifier: MIT
 *
 * Statistics of a mapping's distortion: means by quadrature, extremes by search, percentiles by sampling.
 *
 * Means depend on what is counted, and papers often leave out which they mean:
 *   over the face     equal areas of the map count alike, as the pixels of an image do
 *   over the sphere   equal areas of the sphere count alike. The mean of D_A is then 1 for every mapping
 *   pixels            the sums over the centres of so many by so many pixels of each face, with equal
 *                     weights, extremes among these as well: what papers have tables of
 * RMSE and maximum error are of the difference from the ideal value, which each quantity has.
 *
 * The quadrature is adaptive and estimates its own errors; extremes come from a grid that is then searched, so that
 * a peak narrower than its cells can be missed. docs/measured/accuracy.md says how far estimates were right.
 */
#ifndef CUBEMAP_STATISTICS_H
#define CUBEMAP_STATISTICS_H

#include <stddef.h>
#include <stdint.h>

#include <cubemap/distortion.h>
#include <cubemap/export.h>
#include <cubemap/mapping.h>
#include <cubemap/status.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Of what; the ideal value stands beside each. */
typedef enum cm_quantity
{
    CM_QUANTITY_AREA = 0,         /* D_A: 1 */
    CM_QUANTITY_ISOTROPY = 1,     /* D_I: 1 */
    CM_QUANTITY_DEFORMATION = 2,  /* omega, radians: 0 */
    CM_QUANTITY_SCALE = 3,        /* s: 6/pi */
    CM_QUANTITY_TEXEL_ASPECT = 4, /* 1 */
    CM_QUANTITY_TEXEL_AREA = 5    /* relative to the centre of the same face: 1 */
} cm_quantity;

/* What counts alike in a mean. */
typedef enum cm_measure
{
    CM_OVER_FACE = 0,  /* equal areas of the map */
    CM_OVER_SPHERE = 1 /* equal areas of the sphere */
} cm_measure;

/* To be filled with zeros but for size, which is sizeof(cm_statistics_options), and for what is wanted. */
typedef struct cm_statistics_options
{
    size_t size;        /* sizeof(cm_statistics_options) */
    cm_measure measure; /* what counts alike */
    unsigned faces;     /* bit k for face k, 63 at most; 0 for all six */
    unsigned pixels; /* along a face's edge, 16384 at most; 0 for quadrature. Only over the face */
    double
        tolerance; /* of mean and RMSE, relative: where the quadrature stops, 1e-13 to 1e-2; 0 for
                         1e-9. The errors say what was reached */
} cm_statistics_options;

/* size must be sizeof(cm_statistics) before the call. */
typedef struct cm_statistics
{
    size_t size;          /* sizeof(cm_statistics) */
    double ideal;         /* the value of the quantity where nothing is distorted */
    double mean;          /* of the quantity */
    double mean_error;    /* of the quadrature; 0 with pixels */
    double rmse;          /* root of the mean square of the difference from the ideal value */
    double rmse_error;    /* of the quadrature; 0 with pixels */
    double minimum;       /* of the quantity */
    double maximum;       /* of the quantity; may be infinite */
    double maximum_error; /* the greatest difference from the ideal value */
    double ratio;         /* maximum over minimum */
    uint8_t minimum_face; /* where; one of several places */
    uint8_t maximum_face; /* where; one of several places */
    double minimum_uv[2]; /* u and v there */
    double maximum_uv[2]; /* u and v there */
    size_t evaluations;   /* points at which the quantity was computed */
} cm_statistics;

/* "area", "isotropy", "deformation", "scale", "texel-aspect", "texel-area" at 0 to 5, NULL at others; and
 * the quantity of a name (upper and lower case are the same), -1 if it is none. */
CM_API const char *cm_quantity_name(size_t index);
CM_API int cm_quantity_find(const char *name);

/* options NULL: over all faces, by quadrature. Where values grow as a power of the distance to a corner of
 * the cube, extremes are their limits, infinite or 0; where the map is singular otherwise, infinite or those
 * of points beside it; the errors there are large. Infinite values count in extremes, NaN in nothing.
 * Errors: CM_ERROR_ARGUMENT if a pointer other than options is NULL, a size is none, or quantity, measure,
 * faces, pixels or tolerance is outside its range; CM_ERROR_UNSUPPORTED, with nothing written, if the mapping
 * has not six faces (its kind is not CM_KIND_CUBE). */
CM_API cm_status cm_distortion_statistics(const cm_mapping *mapping, cm_quantity quantity,
                                          const cm_statistics_options *options,
                                          cm_statistics *statistics);

/* The values below which percent[i] of the face or sphere have it (0 and 100: the extremes of the samples), percent in [0, 100], for i below count:
 * value[i], and how far that of a quarter as many samples is from it: doubt[i], unless doubt is NULL. From
 * 64 x 64 points a triangle; options->pixels must be 0 and tolerance is not used.
 * Errors: as before; CM_ERROR_MEMORY. */
CM_API cm_status cm_distortion_percentiles(const cm_mapping *mapping, cm_quantity quantity,
                                           const cm_statistics_options *options, size_t count,
                                           const double *percent, double *value, double *doubt);

#ifdef __cplusplus
}
#endif

#endif
