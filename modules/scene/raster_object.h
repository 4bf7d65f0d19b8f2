/* SPDX-License-Identifier: MIT
 *
 * What a canvas is in memory.
 */
#ifndef MODULES_SCENE_RASTER_OBJECT_H
#define MODULES_SCENE_RASTER_OBJECT_H

#include <cubemap/raster.h>

#include "raster_set.h"

/* Pixels of a tile each way, and tiles of a larger one. */
#define CM_TILE 8
#define CM_TILE_LEVELS 6

/* A cone around the rays of a tile. */
typedef struct cm_tile_cone
{
    double axis[3]; /* of length 1 */
    double sine;    /* of half the opening; 2: all directions; -1: no rays */
    double cosine;
} cm_tile_cone;

/* Tiles of 8^(level + 1) pixels. */
typedef struct cm_tile_level
{
    size_t width;
    size_t height;
    cm_tile_cone *cone;
} cm_tile_level;

struct cm_raster
{
    const cm_camera *camera;
    const cm_raster_set *set;
    cm_pool *pool; /* whose threads draw; NULL: threads are made for it */
    size_t width;
    size_t height;
    size_t stride;     /* of two rows of pixels: raster_set.h */
    int is_plain;      /* rays: x is of the column alone, y of the row, z is 1 */
    int is_all_round;  /* rays of length 1 */
    double ray_most;   /* no coordinate of a ray is larger */
    float near_most;   /* 1 / nearest */
    double *x, *y, *z; /* rays of pixels; plain: of columns, of rows, NULL */
    float *column_x;   /* plain: x in float, with slack, */
    float *row_y;      /* and y behind it */
    int64_t *key;      /* of pixels; nearness is 1 / depth, or 1 / range */
    void *key_memory;  /* where they begin at a line of the cache */
    size_t levels;
    cm_tile_level level[CM_TILE_LEVELS];
};

/* A shape, and whether it meets a cone. */
typedef int (*cm_tile_test)(const void *shape, const cm_tile_cone *cone);
typedef void (*cm_tile_draw)(cm_raster *raster, const void *shape, size_t column, size_t row,
                             size_t columns, size_t rows);

/* Make the tiles' cones from the rays. */
cm_status cm_raster_make_tiles(cm_raster *raster);

/* Draw all tiles that a shape meets, in rows first to last - 1, which begin at a tile's row. */
void cm_raster_visit(cm_raster *raster, const void *shape, cm_tile_test meets, cm_tile_draw draw,
                     size_t first, size_t last);

/* A part of a row of rays, and its pixels. */
cm_raster_rays cm_raster_rays_at(const cm_raster *raster, size_t column, size_t row);
cm_raster_pixels cm_raster_pixels_at(const cm_raster *raster, size_t column, size_t row,
                                     uint32_t own);

/* Into the camera's axes; pose may be NULL. */
void cm_raster_transform(const cm_pose *pose, const double world[3], double camera[3]);

/* The corners of a triangle in the camera's axes; 0 if it is none. */
int cm_raster_take_corners(const cm_pose *pose, const cm_triangles *triangles, size_t which,
                           double corner[3][3]);

/* CM_OK, or what is wrong with a list of triangles. */
cm_status cm_raster_check_triangles(const cm_triangles *triangles);

/* Are so many ids from the first one on ids? */
cm_status cm_raster_check_ids(uint32_t first, size_t count);

#endif
