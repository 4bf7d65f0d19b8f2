/* SPDX-License-Identifier: MIT
 *
 * The rays of all pixels of a camera.
 */
#ifndef MODULES_SCENE_RAY_TABLE_H
#define MODULES_SCENE_RAY_TABLE_H

#include <cubemap/depth.h>

#include "depth_set.h"

struct cm_rays
{
    const cm_depth_set *set;
    cm_pool *pool; /* whose threads do the work; NULL: threads are made for it */
    size_t width;
    size_t height;
    size_t face_rows; /* rows of a face of a cube; else all */
    int is_all_round; /* 1: rays of length 1; 0: z is 1 */
    int is_separable; /* x is of the column alone, y of the row */
    float focal;      /* the mean of both ways, of perspective cameras */
    float step_x;     /* 1 / fx and 1 / fy, of perspective cameras */
    float step_y;
    float *memory; /* of x, y and z */
    float *x, *y,
        *z; /* of pixels; separable: of columns, of rows, NULL. CM_DEPTH_SLACK beside each */
    float *pixel_side; /* the root of the solid angle, of all pixels; NULL of perspective cameras */
};

/* Floats of a row with its slack, so that all rows begin alike. */
size_t cm_row_stride(size_t width);

/* Memory whose rows begin at a line of the cache; 0 if there is none. `memory` is to be freed. */
typedef struct cm_row_desk
{
    void *memory;
    float *rows;
} cm_row_desk;
int cm_row_desk_make(size_t count, cm_row_desk *desk);

/* The rays of a row. */
cm_ray_row cm_ray_row_at(const cm_rays *rays, size_t row);

/* Rays of a part of a row, as the camera has them. */
void cm_camera_rays_of_row(const cm_camera *camera, size_t row, size_t n, double *x, double *y,
                           double *z);

/* Is it a perspective camera without distortion? */
int cm_camera_is_plain(const cm_camera_options *options);

/* The rows of a face. */
size_t cm_camera_face_rows(const cm_camera_options *options);

#endif
