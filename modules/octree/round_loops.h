/* SPDX-License-Identifier: MIT
 *
 * What the loops of an update have of cameras with distortion or a mapping. Places are double: which pixel a voxel's centre falls on
 * is the camera's to say.
 */
#ifndef MODULES_OCTREE_ROUND_LOOPS_H
#define MODULES_OCTREE_ROUND_LOOPS_H

#include <stddef.h>
#include <stdint.h>

/* Cells are asked in eights, of two each way, which are neighbours in Morton's order. */
#define CM_ROUND_EIGHT 8
#define CM_ROUND_EIGHTS 64

/* A row of pixels and those so many rows above and below; where there are none: rows of NaN. */
typedef struct cm_round_row
{
    const float *value;      /* depth or range */
    const float *inverse[3]; /* 1 / value: above, here, below */
    const float *ray[3][3];  /* x, y, z of the same, at value 1 */
    size_t apart;            /* pixels between those that slopes are taken from */
    double by_apart;         /* 1 / apart, which is a power of two */
    double step[3][3];       /* as in cm_update */
    double edge;
    double noise;
    float far;
    /* of what a plane changes from a pixel's centre to its corners, what hits reach more, and in edges */
    double hit_aside;
    double hit_more;
    double front_aside; /* the same of what is not missed */
    double front_more;
    double most; /* edges: nothing reaches more */
} cm_round_row;

/* Where rays end: pixels, and the map whose voxels these are. */
typedef struct cm_round_rays
{
    const struct cm_pixel_rule *rule;
    const float *ray[3]; /* unit */
    int is_range;
    double back[3][3]; /* the camera's axes, by rows */
    double position[3];
    double centre[3];
    double edge;
    double middle;
    double first[3]; /* voxels of the map */
    double beyond[3];
} cm_round_rays;

/* Terms of the centres of a block's cells in the camera's axes: that of cells along x with the origin's, along y, along z; of two
 * neighbours as they follow in an eight. */
typedef struct cm_round_terms
{
    double of[3][3][4][CM_ROUND_EIGHT]; /* camera's axis, map's axis, pair, cell */
} cm_round_terms;

/* Cells whose pixels are to be asked. */
typedef struct cm_round_cells
{
    size_t eights;
    uint8_t eight[CM_ROUND_EIGHTS + 1]; /* in the block */
    double x[512];
    double y[512];
    double z[512];
    double column[512];
    double row[512];
    float value[512 + 16]; /* NaN: nothing is said of it */
    int32_t pixel[512 + 16];
} cm_round_cells;

/* What is known of 64 cells before their pixels are asked. */
typedef struct cm_round_group
{
    unsigned first_eight;
    unsigned eights; /* 8, of coarse cells 1 */
    int is_range;
    int is_inside; /* all fall on the picture, no nearer than it sees */
    double near;   /* what is nearer is not seen */
    float least;
    float most;
} cm_round_group;

/* A picture, as cells ask it. */
typedef struct cm_round_picture
{
    uint32_t width;
    uint32_t height;
    uint32_t stride; /* of colours */
    double pixel_centre;
    const struct cm_pixel_rule *rule; /* rows of width */
} cm_round_picture;

#endif
