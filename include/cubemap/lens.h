/* SPDX-License-Identifier: MIT
 *
 * Lenses for rasterisers that know only pinholes, two ways (Lambers, Sommerhoff and Kolb, "Realistic Lens Distortion
 * Rendering", 2018). Of the library cubemap-sim.
 *
 *   vertices    moved before they are drawn: right where triangles are small, for data of all kinds
 *   images      drawn through a pinhole that sees all that the lens sees, then resampled: triangles of any size. Colours
 *               and depths are interpolated, ids and flows are not
 *   lenses      the whole model of camera.h; its inverse is the camera's own, so nothing is approximated
 *   cameras     perspective ones; others are CM_ERROR_UNSUPPORTED
 *   pixels      counted as the camera counts them: its pixel_centre
 *   images      dense, row by row, the channels of a pixel one beside the other
 *   errors      CM_ERROR_ARGUMENT for NULL, CM_ERROR_RANGE for numbers that cannot be, CM_ERROR_MEMORY; outputs are
 *               untouched then
 *   threads     those of the pool; NULL: the calling one. The same bits for any number of them
 */
#ifndef CUBEMAP_LENS_H
#define CUBEMAP_LENS_H

#include <stddef.h>
#include <stdint.h>

#include <cubemap/camera.h>
#include <cubemap/export.h>
#include <cubemap/pool.h>
#include <cubemap/status.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- vertices ---- */

/* The frustum of the camera without its distortion, as a rasteriser's projection matrix needs it: the planes of the
 * picture's left, right, upper and lower edge at z = 1, in the camera's axes, whose y goes down.
 * CM_OK; CM_ERROR_ARGUMENT; CM_ERROR_UNSUPPORTED. */
CM_API cm_status cm_lens_frustum(const cm_camera *camera, double frustum[4]);

/* How far vertices must be kept around that frustum, so that no hole comes into the distorted picture: in normalised device
 * coordinates, where the picture goes from -1 to 1, the guard is 1 + delta + D. delta is for triangles that are partly
 * inside; the paper has 0.1. D is what the lens brings in from beyond the frustum. The paper takes it from the four
 * corners; here it is that of all pixels, whose middles of edges may reach further. Looks at every pixel.
 * CM_OK; CM_ERROR_ARGUMENT; CM_ERROR_RANGE (delta negative or not finite; no pixel has a ray); CM_ERROR_UNSUPPORTED;
 * CM_ERROR_MEMORY. */
CM_API cm_status cm_lens_guard(const cm_camera *camera, double delta, double *guard);

/* n vertices of the camera's axes, moved so that the pinhole of cm_lens_frustum draws them where the lens has them. z
 * stays. Three NaN, for triangles that are to be left out: behind the camera, beyond the valid field, or outside of the
 * guard; guard 0: no guard. to may be from.
 * CM_OK; CM_ERROR_ARGUMENT; CM_ERROR_RANGE (guard negative or not finite); CM_ERROR_UNSUPPORTED. */
CM_API cm_status cm_lens_move_vertices(const cm_camera *camera, double guard, size_t n,
                                       const double *x, const double *y, const double *z,
                                       double *to_x, double *to_y, double *to_z);

/* ---- images ---- */

/* The pinhole whose picture covers the whole distorted one, with a pixel more around it: options for cm_camera_create. Its
 * focal lengths are the camera's times scale; 0: so many times that neighbours in the distorted picture are nowhere less
 * than a pixel apart. Looks at every pixel.
 * CM_OK; CM_ERROR_ARGUMENT (size too); CM_ERROR_RANGE (scale; 2^31 pixels, as near to a right angle, or so many to the
 * axis; no pixel has a ray); CM_ERROR_UNSUPPORTED; CM_ERROR_MEMORY. */
CM_API cm_status cm_lens_pinhole(const cm_camera *camera, double scale, cm_camera_options *pinhole);

/* Where each pixel of a distorted picture is in the undistorted one, from cm_lens_map_create to cm_lens_map_destroy. */
typedef struct cm_lens_map cm_lens_map;

/* Both cameras must outlive the map. The pinhole is any camera without distortion; what it does not show stays unfilled.
 * CM_OK; CM_ERROR_ARGUMENT; CM_ERROR_CAMERA (a pinhole with distortion); CM_ERROR_UNSUPPORTED; CM_ERROR_MEMORY. */
CM_API cm_status cm_lens_map_create(const cm_camera *camera, const cm_camera *pinhole,
                                    cm_pool *pool, cm_lens_map **map);
CM_API void cm_lens_map_destroy(cm_lens_map *map);

/* How many pixels have a ray that the pinhole does not show: 0 with that of cm_lens_pinhole; 0 of NULL. */
CM_API size_t cm_lens_map_unfilled(const cm_lens_map *map);

/* How many pixels the distorted picture has, and how many the pinhole's; 0 of NULL. */
CM_API size_t cm_lens_map_pixel_count(const cm_lens_map *map);
CM_API size_t cm_lens_map_pinhole_pixel_count(const cm_lens_map *map);

/* The places: columns and rows of the undistorted picture, one a pixel of the distorted one; NaN where there is none.
 * CM_OK; CM_ERROR_ARGUMENT. */
CM_API cm_status cm_lens_map_places(const cm_lens_map *map, double *column, double *row);

/* Colours, or other values that may be mixed: bilinear. Where one of the four is not finite the nearest pixel is taken.
 * What is unfilled is NaN. CM_OK; CM_ERROR_ARGUMENT; CM_ERROR_RANGE (no channels). */
CM_API cm_status cm_lens_map_color(const cm_lens_map *map, uint32_t channels, const float *from,
                                   float *to, cm_pool *pool);

/* Depth along the axis: 1 / depth is interpolated, which is exact on planes. Of four pixels that are not of one surface, as
 * they differ by more than this part of the nearest depth, or of which one was not measured, the nearest pixel is taken:
 * nothing comes between surfaces. gap 0 stands for 0.05. NaN where nothing is.
 * CM_OK; CM_ERROR_ARGUMENT; CM_ERROR_RANGE (gap). */
CM_API cm_status cm_lens_map_depth(const cm_lens_map *map, double gap, const float *from, float *to,
                                   cm_pool *pool);

/* Ids and all else that is never mixed: the bytes of the nearest pixel, so many each; of unfilled ones those of nothing.
 * CM_OK; CM_ERROR_ARGUMENT; CM_ERROR_RANGE (no bytes). */
CM_API cm_status cm_lens_map_labels(const cm_lens_map *map, size_t bytes, const void *from,
                                    const void *nothing, void *to, cm_pool *pool);

/* Flow, two floats a pixel, in pixels along columns and rows: that of the nearest pixel, never a mixture, whose end goes
 * through the lens like its beginning. NaN where a place has no flow, or where the lens does not see the end.
 * CM_OK; CM_ERROR_ARGUMENT. */
CM_API cm_status cm_lens_map_flow(const cm_lens_map *map, const float *from, float *to,
                                  cm_pool *pool);

#ifdef __cplusplus
}
#endif

#endif
