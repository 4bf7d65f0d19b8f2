/* SPDX-License-Identifier: MIT
 *
 * Cones around tiles of pixels of any camera, in a tree for each face, and what is known of the pixels in them.
 */
#ifndef MODULES_OCTREE_PIXEL_TREE_H
#define MODULES_OCTREE_PIXEL_TREE_H

#include <cubemap/camera.h>

#include <stddef.h>
#include <stdint.h>

/* Pixels of a tile each way. */
#define CM_TILE_EDGE 4

/* A cell: a tile, or four cells of the level below. */
typedef struct cm_pixel_cell
{
    float axis[3];
    float cosine; /* of the angle around the axis that its pixels are within */
    float sine;
    float least; /* as in cm_window_level */
    float most;
    uint8_t is_border; /* 1: some of it may have nothing of the picture beside */
    uint8_t is_empty;  /* 1: no pixel of it has a ray */
} cm_pixel_cell;

typedef struct cm_pixel_level
{
    uint32_t width;
    uint32_t height; /* of all faces */
    cm_pixel_cell *cell;
} cm_pixel_level;

#define CM_PIXEL_LEVELS 32

#define CM_PIXEL_SLACK 32

/* The cones depend on the camera alone. */
typedef struct cm_pixel_tree
{
    uint32_t width;
    uint32_t height;
    uint32_t face_rows; /* of pixels */
    uint32_t faces;
    int levels;
    cm_pixel_level level[CM_PIXEL_LEVELS];
    cm_pixel_cell *memory;
    float *rays;   /* memory of these; CM_PIXEL_SLACK floats before and behind each can be read */
    float *ray[3]; /* unit, of all pixels; NaN where there is none */
} cm_pixel_tree;

/* What is known of pixels that a cone may touch. */
typedef struct cm_cone_bounds
{
    float least;
    float most;
    int is_border;
    int is_empty; /* 1: it touches none */
} cm_cone_bounds;

cm_status cm_pixel_tree_make(const cm_camera *camera, cm_pixel_tree *tree);
void cm_pixel_tree_clear(cm_pixel_tree *tree);

/* The greatest angle to a pixel beside: more than what a pixel reaches from its own centre. Pixels without a ray are
 * of none. Bits of *border become 1: the picture ends beside the pixel, or what has rays does. */
#define CM_BORDER_OF_PICTURE 1
#define CM_BORDER_OF_RAYS 2
double cm_pixel_angle_beside(const cm_pixel_tree *tree, uint32_t column, uint32_t row, int *border);

/* From bounds of each pixel. */
void cm_pixel_tree_fill(cm_pixel_tree *tree, const float *least, const float *most);

/* Of a cone around a unit axis. */
cm_cone_bounds cm_pixel_tree_ask(const cm_pixel_tree *tree, const float axis[3], float cosine,
                                 float sine);

#endif
