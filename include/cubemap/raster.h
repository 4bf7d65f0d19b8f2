/* SPDX-License-Identifier: MIT
 *
 * Triangles, discs and points drawn into any camera, with a z-buffer and ids. Of the library cubemap-scene.
 *
 *   pixels      one that a primitive covers at its centre is the primitive's: rays through centres are met with planes, in
 *               every camera alike, so lenses and faces of cubes need no cutting
 *   triangles   of those that share an edge one has a pixel on it: signs are exact, and ties go by the top-left rule. Both
 *               sides are seen
 *   discs       oriented surfels: centre, normal, radius; both sides are seen
 *   points      one pixel each
 *   nearest     the nearest wins, of equals the smaller id; so neither threads nor the order of calls matter
 *   depth       perspective cameras have depth, omnidirectional ones range; float, in the units of the world
 *   bad input   primitives with numbers that are not finite, from 1e100 on (discs: 1e15), or without area are left out
 *   errors      CM_ERROR_ARGUMENT for NULL and a wrong size, CM_ERROR_MEMORY; outputs are untouched then
 */
#ifndef CUBEMAP_RASTER_H
#define CUBEMAP_RASTER_H

#include <stddef.h>
#include <stdint.h>

#include <cubemap/camera.h>
#include <cubemap/export.h>
#include <cubemap/pool.h>
#include <cubemap/pose.h>
#include <cubemap/status.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The id where nothing is; no primitive may have it. */
#define CM_RASTER_NOTHING UINT32_MAX

/* A canvas in front of a camera, from cm_raster_create to cm_raster_destroy. One call at a time may draw. */
typedef struct cm_raster cm_raster;

/* An empty canvas. The camera must outlive it. instructions as in cm_options. nearest: what is nearer is not seen, in units
 * of the world along the axis or the ray; 0 for all that is in front.
 * CM_OK; CM_ERROR_ARGUMENT; CM_ERROR_RANGE (nearest negative or not finite); CM_ERROR_INSTRUCTIONS; CM_ERROR_MEMORY. */
CM_API cm_status cm_raster_create(const cm_camera *camera, double nearest, const char *instructions,
                                  cm_raster **raster);
CM_API void cm_raster_destroy(cm_raster *raster);

/* From now on the threads of a pool draw, which must outlive that: as many as `threads` says, 0 for all. NULL: threads are
 * made for each call. The same bits either way. CM_OK; CM_ERROR_ARGUMENT (no canvas). */
CM_API cm_status cm_raster_use_pool(cm_raster *raster, cm_pool *pool);

/* How many pixels its camera has; 0 of NULL. */
CM_API size_t cm_raster_pixel_count(const cm_raster *raster);

/* Empty again. */
CM_API void cm_raster_clear(cm_raster *raster);

/* Triangles of the world. */
typedef struct cm_triangles
{
    size_t size;            /* sizeof(cm_triangles) */
    size_t vertex_count;    /* below 2^32 */
    const double *position; /* vertex_count x 3 */
    size_t triangle_count;  /* 0 draws nothing */
    const uint32_t *index;  /* triangle_count x 3, each below vertex_count; NULL: 0, 1, 2, ... */
    uint32_t first_id;      /* of the first triangle; the others follow */
} cm_triangles;

/* Discs of the world, an array for each number. */
typedef struct cm_discs
{
    size_t size;            /* sizeof(cm_discs) */
    size_t count;           /* 0 draws nothing */
    const float *centre[3]; /* x, y, z, count each */
    const float *normal[3]; /* of any length but 0 */
    const float *radius;    /* above 0 */
    uint32_t first_id;      /* of the first disc; the others follow */
} cm_discs;

/* Points of the world. */
typedef struct cm_points
{
    size_t size;            /* sizeof(cm_points) */
    size_t count;           /* 0 draws nothing */
    const double *position; /* count x 3 */
    uint32_t first_id;      /* of the first point; the others follow */
} cm_points;

/* Draw them. pose is the camera's; NULL: the world's axes are the camera's. threads as in threads.h.
 * CM_OK; CM_ERROR_ARGUMENT (an index that is none too); CM_ERROR_RANGE (ids from CM_RASTER_NOTHING on). */
CM_API cm_status cm_raster_triangles(cm_raster *raster, const cm_pose *pose,
                                     const cm_triangles *triangles, unsigned threads);
CM_API cm_status cm_raster_discs(cm_raster *raster, const cm_pose *pose, const cm_discs *discs,
                                 unsigned threads);
CM_API cm_status cm_raster_points(cm_raster *raster, const cm_pose *pose, const cm_points *points,
                                  unsigned threads);

/* What is seen, dense, of the camera's size: depth or range, NaN where nothing is; and ids. Each may be NULL. */
CM_API cm_status cm_raster_read(const cm_raster *raster, float *image, uint32_t *id);

/* Where in its triangle each pixel lies that shows one of these: the weights of the second and the third vertex, correct in
 * perspective; that of the first is what is left of 1. Other pixels become NaN. Dense, of the camera's size. pose and
 * triangles are those that were drawn. */
CM_API cm_status cm_raster_weights(const cm_raster *raster, const cm_pose *pose,
                                   const cm_triangles *triangles, float *second, float *third);

#ifdef __cplusplus
}
#endif

#endif
