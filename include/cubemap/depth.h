/* SPDX-License-Identifier: MIT
 *
 * Depth images: cleaned, as points and normals, smoothed, halved, and bounded for boxes of pixels. Of the library
 * cubemap-scene.
 *
 *   images      dense arrays of float, row by row, of the camera's size; metres, or the user's unit. NaN: nothing was
 *               measured. Every function takes what is not above 0, or not finite, for that
 *   kind        depth is along the optical axis, range along the ray; those of omnidirectional cameras hold range
 *   vertices    in the camera's axes, as three planes of floats: of x, of y and of z
 *   faces       windows, differences and halves of cube images end at the edges of faces
 *   memory      grows with the number of pixels, never with what they hold
 *   threads     as in threads.h; the same bits for any number of them. Instruction sets may differ in the last ones
 *   errors      CM_ERROR_ARGUMENT for NULL and a wrong size, CM_ERROR_RANGE for numbers that cannot be, CM_ERROR_MEMORY;
 *               outputs are untouched then
 */
#ifndef CUBEMAP_DEPTH_H
#define CUBEMAP_DEPTH_H

#include <stddef.h>
#include <stdint.h>

#include <cubemap/camera.h>
#include <cubemap/export.h>
#include <cubemap/image.h>
#include <cubemap/pool.h>
#include <cubemap/status.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- cleaning ---- */

/* What counts as a measurement. */
typedef struct cm_depth_limits
{
    size_t size;     /* sizeof(cm_depth_limits) */
    double unit;     /* metres per stored unit, above 0: 1/5000 of TUM, 1 of metres */
    double nearest;  /* metres; what is nearer is none. 0: no limit */
    double farthest; /* metres; what is farther is none. 0: no limit */
} cm_depth_limits;

/* How many pixels were what. */
typedef struct cm_depth_count
{
    size_t size;     /* sizeof(cm_depth_count) */
    size_t valid;    /* measurements */
    size_t zero;     /* 0, or less than a float can be */
    size_t nan;      /* no number */
    size_t infinite; /* or too large for a float */
    size_t negative; /* below 0 */
    size_t near;     /* nearer than the nearest */
    size_t far;      /* farther than the farthest */
} cm_depth_count;

/* The picture, of one channel, CM_PIXEL_U16 or CM_PIXEL_FLOAT, times the unit, rounded to float, with NaN for all that is
 * no measurement. depth has width x height of the picture and may be the picture's own memory if that is float and
 * dense. count may be NULL, else its size must be set.
 * CM_OK; CM_ERROR_ARGUMENT; CM_ERROR_RANGE (another type, more channels, unit, limits); CM_ERROR_MEMORY. */
CM_API cm_status cm_depth_clean(const cm_image *picture, const cm_depth_limits *limits,
                                unsigned threads, float *depth, cm_depth_count *count);

/* ---- the rays of all pixels ---- */

/* What functions here need of a camera: its rays in float, from cm_rays_create to cm_rays_destroy. */
typedef struct cm_rays cm_rays;

/* instructions as in cm_options. The camera is not needed afterwards. 12 bytes a pixel, or 16 of omnidirectional cameras;
 * of perspective cameras without distortion as good as nothing.
 * CM_OK; CM_ERROR_ARGUMENT; CM_ERROR_INSTRUCTIONS; CM_ERROR_MEMORY. */
CM_API cm_status cm_rays_create(const cm_camera *camera, const char *instructions, cm_rays **rays);
CM_API void cm_rays_destroy(cm_rays *rays);

/* From now on the functions that are given these rays have the threads of a pool, which must outlive that: as many as
 * `threads` says, 0 for all. NULL: threads are made for each call. The same bits either way. Not while a call is at work.
 * CM_OK; CM_ERROR_ARGUMENT (no rays). */
CM_API cm_status cm_rays_use_pool(cm_rays *rays, cm_pool *pool);

/* How many pixels its images have, and how many those have that cm_depth_halve makes of them; 0 of NULL. */
CM_API size_t cm_rays_pixel_count(const cm_rays *rays);
CM_API size_t cm_rays_halved_pixel_count(const cm_rays *rays);

/* Depth to range and back. to may be from. Omnidirectional cameras have no depth: CM_ERROR_UNSUPPORTED. */
CM_API cm_status cm_depth_to_range(const cm_rays *rays, const float *depth, unsigned threads,
                                   float *range);
CM_API cm_status cm_depth_from_range(const cm_rays *rays, const float *range, unsigned threads,
                                     float *depth);

/* ---- maps ---- */

/* Which maps, and how. To be filled with zeros but for size and what is wanted. */
typedef struct cm_depth_maps
{
    size_t size;  /* sizeof(cm_depth_maps) */
    int is_range; /* 1: the image holds range. Those of omnidirectional cameras do in any case */
    double
        gap; /* neighbours whose depths differ by more than this part of the pixel's own are of another
                         surface. Above 0; 0 stands for 0.05 */
    float *vertex[3]; /* x, y and z of the points */
    float *normal[3]; /* unit normals, towards the camera; all NULL: not wanted */
    float *radius;    /* of the surfels; needs normals. NULL: not wanted */
} cm_depth_maps;

/* The maps of an image. A normal is the cross product of the differences of vertices along the row and along the column:
 * from neighbour to neighbour, or from the pixel to the one that is of its surface; NaN where both ways one has none. The
 * radius is depth sqrt(2) / (f |n_z|) with the mean f of both ways, which covers the pixel (Keller et al. 2013; Whelan et
 * al. 2015, ElasticFusion), not limited; of omnidirectional cameras range sqrt(2 solid angle) / |n ray|. Depths are to
 * be from 1e-6 to 1e9 for normals. No map may overlap the image or another map.
 * CM_OK; CM_ERROR_ARGUMENT (a map without those that it needs); CM_ERROR_RANGE (gap); CM_ERROR_MEMORY. */
CM_API cm_status cm_depth_make_maps(const cm_rays *rays, const float *image, unsigned threads,
                                    const cm_depth_maps *maps);

/* ---- smoothing and halving ---- */

/* The bilateral filter of 7 x 7 pixels (Tomasi and Manduchi 1998): weights exp(-p^2 / (2 pixels^2) - d^2 / (2 metres^2))
 * of distance p in the image and difference d of values; weights are good to 2e-4 of themselves, differences of more than
 * 13 sigmas weigh nothing. What was not measured stays so and weighs nothing. to and from must not overlap. pixels and
 * metres from 1e-6 to 1e6. CM_OK; CM_ERROR_ARGUMENT; CM_ERROR_RANGE; CM_ERROR_MEMORY. */
CM_API cm_status cm_depth_smooth(const cm_rays *rays, const float *from, double pixels,
                                 double metres, unsigned threads, float *to);

/* An image of half the size, width / 2 x height / 2: each pixel is the mean of those of its 2 x 2 that are no more than
 * this part of the nearest one behind it, so that surfaces do not mix. An odd last column or row is left out. gap from 0 on. to and from must
 * not overlap.
 * CM_OK; CM_ERROR_ARGUMENT; CM_ERROR_RANGE (gap; less than two pixels; faces of odd size). */
CM_API cm_status cm_depth_halve(const cm_rays *rays, const float *from, double gap,
                                unsigned threads, float *to);

/* The camera of the halved image, whose pixel centres lie between those of the four: options to be given to
 * cm_camera_create. to may be from. CM_OK; CM_ERROR_ARGUMENT; CM_ERROR_RANGE (as of cm_depth_halve). */
CM_API cm_status cm_depth_halve_camera(const cm_camera_options *from, cm_camera_options *to);

/* ---- bounds of boxes of pixels ---- */

/* The least and greatest values of squares of 2, 4, 8 ... pixels, from cm_depth_pyramid_create to
 * cm_depth_pyramid_destroy. */
typedef struct cm_depth_pyramid cm_depth_pyramid;

/* A level: of 2^level pixels each way a cell. Cells at the right and lower end count the pixels that there are. */
typedef struct cm_depth_level
{
    size_t size;     /* sizeof(cm_depth_level) */
    uint32_t width;  /* cells from left to right */
    uint32_t height; /* cells from top to bottom */
    const float *
        least; /* of the measurements, with a minus sign if a pixel of the cell has none; -infinity if none has.
                           So least > z says that all pixels are measured and farther than z */
    const float *most; /* of the measurements; 0 if there is none */
} cm_depth_level;

/* What is known of a box of pixels. */
typedef struct cm_depth_bounds
{
    float least;        /* of the measurements; infinite if there is none */
    float most;         /* of the measurements; 0 if there is none */
    int has_unmeasured; /* 1: a pixel has no measurement */
} cm_depth_bounds;

/* For images of a size, level 1 and on until no side has more than 8 cells, and one at least: 7 of 640 x 480.
 * instructions as in cm_options.
 * CM_OK; CM_ERROR_ARGUMENT; CM_ERROR_RANGE (a side of 0, or 2^31 pixels); CM_ERROR_INSTRUCTIONS; CM_ERROR_MEMORY. */
CM_API cm_status cm_depth_pyramid_create(uint32_t width, uint32_t height, const char *instructions,
                                         cm_depth_pyramid **pyramid);
CM_API void cm_depth_pyramid_destroy(cm_depth_pyramid *pyramid);

/* As cm_rays_use_pool. */
CM_API cm_status cm_depth_pyramid_use_pool(cm_depth_pyramid *pyramid, cm_pool *pool);

/* How many pixels its images have; 0 of NULL. */
CM_API size_t cm_depth_pyramid_pixel_count(const cm_depth_pyramid *pyramid);

/* Fill all levels from an image, which is not needed afterwards. CM_OK; CM_ERROR_ARGUMENT. */
CM_API cm_status cm_depth_pyramid_fill(cm_depth_pyramid *pyramid, const float *image,
                                       unsigned threads);

/* The last level; and the cells of one, from 1 on. The arrays live as long as the pyramid. level->size must be set.
 * CM_OK; CM_ERROR_ARGUMENT (no such level too). */
CM_API uint32_t cm_depth_pyramid_last(const cm_depth_pyramid *pyramid);
CM_API cm_status cm_depth_pyramid_level(const cm_depth_pyramid *pyramid, uint32_t level,
                                        cm_depth_level *cells);

/* Bounds of the pixels from (column, row) to (last_column, last_row), both within the image, of cells that cover them: at
 * the level where those are 3 x 3 at most, or at the last one. They are of these pixels and of others near them, so that
 * least is no greater and most no less. CM_OK; CM_ERROR_ARGUMENT; CM_ERROR_RANGE (a box that is none). */
CM_API cm_status cm_depth_pyramid_bounds(const cm_depth_pyramid *pyramid, uint32_t column,
                                         uint32_t row, uint32_t last_column, uint32_t last_row,
                                         cm_depth_bounds *bounds);

#ifdef __cplusplus
}
#endif

#endif
