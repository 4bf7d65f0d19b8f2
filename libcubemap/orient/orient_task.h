/* SPDX-License-Identifier: MIT
 *
 * What is sought: the task that the files of the search share.
 *
 * orient.c          the search: levels of boxes, the best so far, what is left out
 * orient_survey.c   the measure at all nodes of a grid, and all its valleys followed downhill
 * orient_boxes.c    boxes of rotations, and the rotations that exchange faces that look alike
 * orient_bound.c    the bound of a box: the sum over points of linear pieces that a table has
 * orient_field.c    distortion as a field on the sphere, and its table
 * orient_mask.c     the mask as points, as few as a level needs; as a table, and eroded
 * orient_edges.c    the edges of faces, and their length over the mask
 * orient_value.c    the measure itself, and following it downhill
 */
#ifndef LIBCUBEMAP_ORIENT_TASK_H
#define LIBCUBEMAP_ORIENT_TASK_H

#include <cubemap/orient.h>

#include "libcubemap/batch/mapping_object.h"
#include "orient_bound.h"
#include "orient_boxes.h"

/* An arc of a great circle: the directions from cos t + along sin t, t from 0 to length; how often it counts. */
typedef struct cm_edge_arc
{
    double from[3];
    double along[3];
    double length;
    double weight;
} cm_edge_arc;

/* A raster as it is used: of binary fractions of its largest value, at most 1. */
typedef struct cm_orient_task
{
    const cm_mapping *mapping;
    cm_orient_measure measure;
    cm_measure over;
    unsigned threads;
    const cm_mask *mask;
    double largest; /* of the mask's values */
    cm_symmetries symmetries;
    /* of the measure edges (orient_edges.c): */
    cm_edge_arc *arc;
    size_t arc_count;
    double edges_length; /* of them all, radians */
    double *column;      /* the mask's borders of columns and of rows */
    double *row;
} cm_orient_task;

#endif
