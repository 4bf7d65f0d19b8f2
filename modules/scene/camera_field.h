/* SPDX-License-Identifier: MIT
 *
 * The valid field of a lens: the rays (a, b, 1) that the axis sees over none where the lens folds, has a pole, or leaves
 * the tilted sensor. In each direction about the axis it ends at a border.
 */
#ifndef MODULES_SCENE_CAMERA_FIELD_H
#define MODULES_SCENE_CAMERA_FIELD_H

#include "camera_set.h"

#define CM_FIELD_SIDES 128

/* No ray is looked at that is further from the axis, whose length there is 1. */
#define CM_FIELD_FURTHEST 3.9e5

/* Sides that lines do not divide are split into so many parts, as long as they are few. */
#define CM_FIELD_PARTS 16
#define CM_FIELD_SPLITS 16

/* Where the field ends in one direction: INFINITY where it does not; and a line between that and what is beyond the fold. */
typedef struct cm_field_end
{
    double border;
    double divide;
    int is_plain; /* does the lower of the lines of this direction and the next divide all between them? */
    int split; /* -1, or which one */
} cm_field_end;

/* Directions about the axis are numbered from a towards b, an eighth of them in an eighth of a turn; the last is the first
 * once more. */
typedef struct cm_camera_field
{
    cm_field_end end[CM_FIELD_SIDES + 1];
    cm_field_end part[CM_FIELD_SPLITS][CM_FIELD_PARTS + 1];
    double within;   /* the square up to which signs alone tell inside from outside */
    double furthest; /* the square up to which there are images */
} cm_camera_field;

/* The direction of a number from 0 to CM_FIELD_SIDES, which may be broken. */
void cm_camera_field_direction(double side, double *cosine, double *sine);

/* Fills it in but for furthest, which is infinite. The lens is evaluated along each direction. */
void cm_camera_field_find(const cm_lens *lens, const cm_camera_set *set, cm_camera_field *field);

/* Of a border as well as doubles tell it: rounding moves it more. */
#define CM_FIELD_SLACK 1e-15

/* How far the field goes in one direction (cosine, sine), or up to slack less, a part of that: signs are good there. beyond, if
 * it is not NULL, gets where they are good again, or a place before that: up to slack less, or a step behind the border. */
double cm_camera_field_border(const cm_lens *lens, const cm_camera_set *set, double cosine,
                              double sine, double slack, double *beyond);

/* Is the ray inside, if signs are good there? */
int cm_camera_field_joins(const cm_lens *lens, const cm_camera_set *set,
                          const cm_camera_field *field, double a, double b);

#endif
