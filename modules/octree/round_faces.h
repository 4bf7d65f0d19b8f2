/* SPDX-License-Identifier: MIT
 *
 * The six sides of a cube around a camera of any kind, as pictures of straight cameras: what the camera's pixels say is bounded in
 * their cells, so that cubes of voxels are compared with these as with a straight camera's.
 */
#ifndef MODULES_OCTREE_ROUND_FACES_H
#define MODULES_OCTREE_ROUND_FACES_H

#include <cubemap/pool.h>

#include "pixel_tree.h"
#include "view_table.h"

#define CM_ROUND_FACES 6

/* Sides reach so far from their middle, where the next side begins at 1, so that small cubes are wholly on one. */
#define CM_ROUND_SIDE 1.25

/* Pixels of a row of the camera. */
typedef struct cm_pixel_run
{
    uint32_t first;
    uint32_t count;
} cm_pixel_run;

/* What of the picture falls on one side; the cells' windows are the desk's. */
typedef struct cm_round_face
{
    cm_view_desk desk;
    int is_used;        /* 0: no pixel falls on it */
    uint32_t *start;    /* of each cell in rows: its first run; and one more */
    cm_pixel_run *run;  /* that perhaps fall on the cell */
    uint8_t *is_border; /* of cells: 1: some of it may have nothing of the picture beside */
} cm_round_face;

/* They depend on the camera alone, but for the bounds. */
typedef struct cm_round_faces
{
    cm_round_face face[CM_ROUND_FACES];
    float greatest; /* of all that pixels say */
} cm_round_faces;

/* Cubes with their centres in the camera's axes. */
typedef struct cm_round_cubes
{
    size_t count;
    const float *at[3];
    const float *half; /* of a box along the camera's axes around each */
    int is_range;      /* is range measured, or depth? */
    float nearest;     /* what is no farther is not seen */
} cm_round_cubes;

/* mean_pixel: of the camera (cm_round_mean_pixel). What was there is cleared if there is no memory. */
cm_status cm_round_faces_make(const cm_pixel_tree *tree, double mean_pixel, cm_round_faces *faces);
void cm_round_faces_clear(cm_round_faces *faces);

/* From bounds of each pixel. */
void cm_round_faces_fill(cm_round_faces *faces, const cm_octree_set *set, const float *least,
                         const float *most, cm_pool *pool);

/* Classes of cubes, as classify of cm_octree_set has them; CM_CUBE_UNKNOWN are those that are not wholly on one side, whose bounds,
 * if asked for, tell nothing. */
void cm_round_faces_classify(const cm_round_faces *faces, const cm_octree_set *set,
                             const cm_round_cubes *cubes, uint8_t *class_of,
                             cm_cube_bounds *bounds);

#endif
