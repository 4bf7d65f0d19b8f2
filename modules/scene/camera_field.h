/* SPDX-License-Identifier: MIT
 *
 * The valid field of a lens: the rays (a, b, 1) that the axis sees over none where the lens folds, has a pole, or leaves
 * the tilted sensor. In each direction about the axis it ends at a border.
 */
#ifndef MODULES_SCENE_CAMERA_FIELD_H
#define MODULES_SCENE_CAMERA_FIELD_H

#include "camera_set.h"

#define CM_FIELD_SIDES 128

/* Directions about the axis are numbered from a towards b; the last is the first once more. */
typedef struct cm_camera_field
{
    double border[CM_FIELD_SIDES + 1];      /* where it ends; INFINITY where it does not */
    double divide[CM_FIELD_SIDES + 1];      /* between the border and what is beyond the fold */
    unsigned char is_plain[CM_FIELD_SIDES]; /* do dividing lines go on to the next direction? */
    double image[CM_FIELD_SIDES][2];        /* what the lens makes of the border */
    double sag;    /* how far that is from the straight lines between those; INFINITY: not known */
    double within; /* the square up to which signs alone tell inside from outside */
    double furthest; /* the square up to which there are images */
} cm_camera_field;

typedef enum cm_camera_reach
{
    CM_FIELD_MISSED,
    CM_FIELD_UNKNOWN,
    CM_FIELD_REACHED
} cm_camera_reach;

/* Fills it in; some hundred thousand evaluations of the lens. */
void cm_camera_field_find(const cm_lens *lens, const cm_camera_set *set, cm_camera_field *field);

/* How far the field goes in one direction (cosine, sine); beyond, if it is not NULL, gets where signs are good again. */
double cm_camera_field_border(const cm_lens *lens, const cm_camera_set *set, double cosine,
                              double sine, double *beyond);

/* Is the ray inside, if signs are good there? */
int cm_camera_field_joins(const cm_lens *lens, const cm_camera_set *set,
                          const cm_camera_field *field, double a, double b);

/* Can the lens make (x, y) of an inside ray? */
cm_camera_reach cm_camera_field_reaches(const cm_camera_field *field, double x, double y);

#endif
