/* SPDX-License-Identifier: MIT
 *
 * How far depth is from ground truth (Nair et al., "Ground Truth for Evaluating Time of Flight Imaging", 2013, section 5). Of
 * the library cubemap-sim.
 *
 *   images      dense arrays of float, depth or range, both of one kind and in one unit, which results have
 *   measured    what is finite and above 0. A pixel counts where depth and truth are measured
 *   error       depth - truth: too far is positive. The endpoint error is its absolute value
 *   errors      CM_ERROR_ARGUMENT for NULL and a wrong size, CM_ERROR_RANGE for numbers that cannot be, CM_ERROR_RANK where
 *               too few pixels count, CM_ERROR_MEMORY; outputs are untouched then
 *   threads     any number may call
 */
#ifndef CUBEMAP_DEPTH_ERROR_H
#define CUBEMAP_DEPTH_ERROR_H

#include <stddef.h>
#include <stdint.h>

#include <cubemap/export.h>
#include <cubemap/status.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- of one image ---- */

/* What is said of all pixels at once. */
typedef struct cm_depth_error
{
    size_t size;            /* sizeof(cm_depth_error) */
    size_t count;           /* pixels that count */
    size_t missing;         /* truth is measured, depth is not */
    size_t extra;           /* depth is measured, truth is not */
    double bias;            /* mean error: accuracy */
    double mae;             /* mean endpoint error */
    double deviation;       /* standard deviation of the error: precision, over the image */
    double mse;             /* mean square; bias^2 + deviation^2 */
    double rmse;            /* its root. It is not bias + deviation, as the chapter says */
    double median;          /* of the error */
    double median_absolute; /* of the endpoint error */
    double maximum;         /* of the endpoint error */
} cm_depth_error;

/* The local metric: the error of each pixel, NaN where it does not count. error may be depth or truth.
 * CM_OK; CM_ERROR_ARGUMENT. */
CM_API cm_status cm_depth_error_local(size_t n, const float *depth, const float *truth,
                                      float *error);

/* The global ones. Sums are compensated: their order does not matter to 1e-15.
 * CM_OK; CM_ERROR_ARGUMENT; CM_ERROR_RANK (no pixel counts); CM_ERROR_MEMORY. */
CM_API cm_status cm_depth_error_measure(size_t n, const float *depth, const float *truth,
                                        cm_depth_error *error);

/* Quantiles of the endpoint error for fractions from 0 (the least) to 1 (the greatest), between pixels linearly.
 * CM_OK; CM_ERROR_ARGUMENT; CM_ERROR_RANGE; CM_ERROR_RANK; CM_ERROR_MEMORY. */
CM_API cm_status cm_depth_error_quantiles(size_t n, const float *depth, const float *truth,
                                          size_t count, const double *fraction, double *quantile);

/* The part of pixels whose endpoint error is above each limit, of those that truth has: what is missing is bad.
 * CM_OK; CM_ERROR_ARGUMENT; CM_ERROR_RANGE (a limit negative or NaN); CM_ERROR_RANK (truth has no pixel). */
CM_API cm_status cm_depth_error_bad(size_t n, const float *depth, const float *truth, size_t count,
                                    const double *limit, double *ratio);

/* ---- of several images ---- */

/* Over time, for n pixels of so many frames, one behind the other: the mean and the standard deviation (divided by frames
 * - 1) of what each pixel has measured; NaN where it has none, or just one. Each output may be NULL.
 * CM_OK; CM_ERROR_ARGUMENT; CM_ERROR_RANGE (fewer than 2 frames). */
CM_API cm_status cm_depth_error_temporal(size_t frames, size_t n, const float *depth, float *mean,
                                         float *deviation);

/* ---- of surfaces ---- */

/* Slope: the angle in radians between n normals and the true ones, planes of x, y and z as cm_depth_make_maps has them;
 * NaN where one is none. CM_OK; CM_ERROR_ARGUMENT. */
CM_API cm_status cm_depth_error_slope(size_t n, const float *const normal[3],
                                      const float *const truth[3], float *angle);

/* A plane through points, and how they leave it: what walls are made to by a camera. */
typedef struct cm_depth_plane
{
    size_t size;      /* sizeof(cm_depth_plane) */
    size_t count;     /* points that are finite */
    double normal[3]; /* of length 1; towards the origin */
    double distance;  /* from the origin to the plane, along the normal; not above 0 */
    double centre[3]; /* of the points */
    double rms;       /* of distances from the plane: planarity */
    double maximum;   /* of their absolute values */
    double curvature
        [2]; /* principal ones of the surface of second degree, 1 / unit; bent towards the origin is positive;
                            the greater first. NaN where points are too few, or on a conic */
} cm_depth_plane;

/* The best plane through n points (planes of x, y and z), by least squares of distances.
 * CM_OK; CM_ERROR_ARGUMENT; CM_ERROR_RANK (fewer than 3 points, or all on a line); CM_ERROR_MEMORY. */
CM_API cm_status cm_depth_error_plane(size_t n, const float *const point[3], cm_depth_plane *plane);

/* How edges of depth were found. */
typedef struct cm_depth_edges
{
    size_t size;      /* sizeof(cm_depth_edges) */
    size_t measured;  /* pixels on edges of depth */
    size_t true_ones; /* and of truth */
    size_t right;     /* those of depth that have one of truth within reach */
    size_t found;     /* those of truth that have one of depth within reach */
    double precision; /* right / measured; NaN if none is measured */
    double recall;    /* found / true_ones; NaN if truth has none */
} cm_depth_edges;

/* Edges: a pixel that differs from its right or its lower neighbour by more than this part of the nearer one. reach is in
 * pixels, in both directions. False edges, as of texture, lower precision.
 * CM_OK; CM_ERROR_ARGUMENT; CM_ERROR_RANGE (gap not above 0 or not finite; 2^31 pixels; reach from 65536); CM_ERROR_MEMORY. */
CM_API cm_status cm_depth_error_edges(uint32_t width, uint32_t height, const float *depth,
                                      const float *truth, double gap, uint32_t reach,
                                      cm_depth_edges *edges);

/* ---- by confidence ---- */

/* What a sparsification plot is of. */
typedef enum cm_sparsification_measure
{
    CM_SPARSIFICATION_MAE = 0, /* mean endpoint error */
    CM_SPARSIFICATION_RMSE = 1 /* root of the mean square */
} cm_sparsification_measure;

/* Sparsification: the error of the pixels that are left, when this fraction of them with the least confidence is removed;
 * and the oracle's, who removes those of the greatest error. Confidence may be of depth, or of weak ground truth; where it is NaN a
 * pixel does not count. Of pixels of one confidence each is removed by its part, so that no order of theirs matters, and
 * a confidence that says nothing gives a level curve. fraction is from 0 to less than 1. error, oracle and area may be NULL;
 * area is that between both curves, over all fractions, by the error of all pixels: 0 is a perfect confidence.
 * CM_OK; CM_ERROR_ARGUMENT; CM_ERROR_RANGE; CM_ERROR_RANK (no pixel counts); CM_ERROR_MEMORY. */
CM_API cm_status cm_depth_error_sparsify(size_t n, const float *depth, const float *truth,
                                         const float *confidence, cm_sparsification_measure measure,
                                         size_t count, const double *fraction, double *error,
                                         double *oracle, double *area);

/* ---- weak ground truth ---- */

/* How wrong the distance of a checkerboard is at most that corners tell of (eq. 1): distance from the focal point,
 * spacing of the corners, focal length, and the error of each corner on the chip, all in one unit, which the result has. Of
 * many corners it is to be divided by the root of their number. NaN where that is no number, or where the error hides the corners. */
CM_API double cm_depth_error_checkerboard(double distance, double spacing, double focal_length,
                                          double corner_error);

#ifdef __cplusplus
}
#endif

#endif
