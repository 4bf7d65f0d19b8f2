/* SPDX-License-Identifier: MIT
 *
 * Texel images: a fine colour picture over a coarse cloud of depths, as of a camera that has both behind one lens (Killpack,
 * "Visualization of Three-Dimensional Models from Multiple Texel Images", 2016, chapter 3). Of the library cubemap-sim.
 *
 *   canvas      the fine picture, dense, row by row; places on it count from its upper left corner, centres of pixels are at
 *               halves
 *   samples     the coarse ones, row by row, spread over the canvas by even angles or by even spaces
 *   axes        of the camera: x right, y down, z forward. Depth is along z, range along the ray
 *   nothing     NaN, and so is what is not finite or not above 0; means leave it out
 *   errors      CM_ERROR_ARGUMENT for NULL and a wrong size, CM_ERROR_RANGE for numbers that cannot be; outputs are
 *               untouched then
 */
#ifndef CUBEMAP_TEXEL_H
#define CUBEMAP_TEXEL_H

#include <stddef.h>
#include <stdint.h>

#include <cubemap/export.h>
#include <cubemap/pool.h>
#include <cubemap/pose.h>
#include <cubemap/status.h>
#include <cubemap/world.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What is alike between neighbouring samples. */
typedef enum cm_texel_spacing
{
    CM_TEXEL_EVEN_SPACES = 0, /* the distance on a wall in front of the camera */
    CM_TEXEL_EVEN_ANGLES = 1  /* the angle, along the row and along the column through the axis */
} cm_texel_spacing;

/* To be filled with zeros but for size, field and what is wanted. */
typedef struct cm_texel_options
{
    size_t size;     /* sizeof(cm_texel_options) */
    double field;    /* radians from the left edge of the canvas to the right; below pi */
    uint32_t width;  /* of the canvas, in pixels; 0: 1024 */
    uint32_t height; /* 0: as the width. Pixels are square: it says the field from top to bottom */
    uint32_t
        columns;   /* of samples, no more than the width; 0: a sixteenth of the width, 1 at least */
    uint32_t rows; /* 0: a sixteenth of the height, 1 at least */
    uint32_t window;       /* pixels of the canvas each way that a sample is the mean of; 0: 16 */
    uint32_t oversampling; /* rays each way through a pixel of the canvas, up to 16; 0: 1 */
    cm_texel_spacing spacing; /* of samples */
    double unit;              /* metres per unit of the world; 0: 1 */
} cm_texel_options;

/* Where arrays are; those that are NULL are left out. */
typedef struct cm_texel_image
{
    size_t size; /* sizeof(cm_texel_image) */
    float *
        color; /* height x width x 3, 0..1: of surfaces, as they are without light; 0 where nothing is */
    float *depth;    /* rows x columns, metres */
    float *range;    /* rows x columns, metres: of the points */
    float *point[3]; /* x, y and z, rows x columns each, metres */
    float *uv[2]; /* where on the canvas samples are: 0..1 from its left and from its upper edge */
} cm_texel_image;

/* n values of a z-buffer, 0 at the near plane and 1 at the far one, to depth along the axis (eq. 3.1). far may be infinite.
 * What is not from 0 to 1 becomes NaN. depth may be z_buffer.
 * CM_OK; CM_ERROR_ARGUMENT; CM_ERROR_RANGE (0 < near < far is not so; near is infinite). */
CM_API cm_status cm_texel_linearise(double near, double far, size_t n, const float *z_buffer,
                                    float *depth);

/* The options with numbers in the place of zeros. CM_OK; CM_ERROR_ARGUMENT; CM_ERROR_RANGE (field, sizes, unit,
 * spacing). */
CM_API cm_status cm_texel_complete(cm_texel_options *options);

/* Where samples are on the canvas: a column for each of the columns, a row for each of the rows; and where their rays meet
 * z = 1: the coordinates x and y there. Each array may be NULL. CM_OK; CM_ERROR_ARGUMENT; CM_ERROR_RANGE. */
CM_API cm_status cm_texel_places(const cm_texel_options *options, double *column, double *row,
                                 double *x, double *y);

/* Depths of the canvas to those of samples: each is the mean of the window around its place, in which pixels at the edge
 * count by their part, and only those that were measured. NaN where none was. No unit is changed.
 * CM_OK; CM_ERROR_ARGUMENT; CM_ERROR_RANGE; CM_ERROR_MEMORY. */
CM_API cm_status cm_texel_sample(const cm_texel_options *options, const float *canvas,
                                 float *depth);

/* Points, ranges and places of samples, from their depths in metres; image->color is not looked at.
 * CM_OK; CM_ERROR_ARGUMENT; CM_ERROR_RANGE; CM_ERROR_MEMORY. */
CM_API cm_status cm_texel_points(const cm_texel_options *options, const float *depth,
                                 const cm_texel_image *image);

/* The matrix, by rows, that takes points of a scan's camera to the axes of the base scan's: the identity, to the bit, if the
 * scan is the base. Its translation is in metres, of which a unit of the world has so many.
 * CM_OK; CM_ERROR_ARGUMENT; CM_ERROR_CAMERA (a pose that is none); CM_ERROR_RANGE (unit). */
CM_API cm_status cm_texel_matrix(const cm_pose *base, const cm_pose *scan, double unit,
                                 double matrix[16]);

/* The texel image of a world seen from a pose: rays through the canvas, then all of the above. threads of the pool; NULL:
 * the calling one; the same bits for any number.
 * CM_OK; CM_ERROR_ARGUMENT; CM_ERROR_RANGE; CM_ERROR_CAMERA (pose); CM_ERROR_MEMORY. */
CM_API cm_status cm_texel_render(const cm_scene *scene, const cm_pose *pose,
                                 const cm_texel_options *options, cm_pool *pool,
                                 const cm_texel_image *image);

#ifdef __cplusplus
}
#endif

#endif
