/* SPDX-License-Identifier: MIT
 *
 * The valid field of a lens: the rays (a, b, 1) that the axis sees over none where the lens folds, has a pole, or leaves
 * the tilted sensor. In each direction about the axis it ends at a border.
 */
#ifndef MODULES_SCENE_CAMERA_FIELD_H
#define MODULES_SCENE_CAMERA_FIELD_H

#include "camera_fold.h"

#define CM_FIELD_SIDES 128

/* No ray is looked at that is further from the axis, whose length there is 1. */
#define CM_FIELD_FURTHEST 3.9e5

/* Sides that lines do not divide are split into so many parts, as long as they are few; not if what is not sure is so far from
 * the axis that few pictures have it. */
#define CM_FIELD_FAR 4.0
#define CM_FIELD_PARTS 16
#define CM_FIELD_SPLITS 16

/* Where the field ends in one direction: INFINITY where it does not; and what is certain between that and the next. */
typedef struct cm_field_end
{
    double border;
    double sure; /* up to this all is inside */
    double line; /* if it is plain, up to this signs tell, and nothing beyond it is inside */
    int is_plain;
    int split; /* -1, or which one */
} cm_field_end;

/* Directions about the axis are numbered from a towards b, an eighth of them in an eighth of a turn; the last is the first
 * once more. */
typedef struct cm_camera_field
{
    cm_fold fold;
    cm_field_end end[CM_FIELD_SIDES + 1];
    cm_field_end part[CM_FIELD_SPLITS][CM_FIELD_PARTS + 1];
    double within;   /* the square up to which signs alone tell inside from outside */
    double furthest; /* the square up to which there are images */
} cm_camera_field;

/* The direction of a number from 0 to CM_FIELD_SIDES, which may be broken. */
void cm_camera_field_direction(double side, double *cosine, double *sine);

/* Fills it in but for furthest, which is infinite. The lens has to stay. */
void cm_camera_field_find(const cm_lens *lens, cm_camera_field *field);

/* How far the field goes in one direction (cosine, sine), or up to 1e-15 of it less: signs are good there. */
double cm_camera_field_border(const cm_camera_field *field, double cosine, double sine);

/* Is the ray inside, if signs are good there? */
int cm_camera_field_joins(const cm_camera_field *field, double a, double b);

#endif
