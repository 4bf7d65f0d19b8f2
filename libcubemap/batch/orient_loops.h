/* SPDX-License-Identifier: MIT
 *
 * What orient_loops.inc sums: points, and a table of linear pieces.
 */
#ifndef LIBCUBEMAP_BATCH_ORIENT_LOOPS_H
#define LIBCUBEMAP_BATCH_ORIENT_LOOPS_H

#include <stddef.h>

/* Directions with weights whose sum is 1. A vector shorter than 1 is the mean of directions about it. */
typedef struct cm_orient_points
{
    size_t count;
    float *x;
    float *y;
    float *z;
    float *weight;
    double reach; /* the farthest that a direction is from its vector's, radians */
} cm_orient_points;

/* What a field is no less than near a point P: base + (x, y, z) . P. */
typedef struct cm_orient_piece
{
    float base;
    float x;
    float y;
    float z;
} cm_orient_piece;

/* 6 x side x side pieces, over faces of a cube of their own: +x -x +y -y +z -z. */
typedef struct cm_orient_table
{
    unsigned side;
    cm_orient_piece *piece;
    double half_diagonal; /* of the largest piece, radians */
} cm_orient_table;

/* Coordinates of the table's faces, about equally long on the sphere: u in [-1, 1] from p = tan, and back; beyond,
 * p goes on along a line. */
#define CM_TABLE_BEND 0.27

#endif
