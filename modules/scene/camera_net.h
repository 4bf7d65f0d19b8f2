/* SPDX-License-Identifier: MIT
 *
 * Where Newton's method may begin for a pixel to which no straight way leads from the axis: a net over the field, and the
 * triangles of it whose images have the pixel in them.
 */
#ifndef MODULES_SCENE_CAMERA_NET_H
#define MODULES_SCENE_CAMERA_NET_H

#include <stddef.h>

#include "camera_field.h"
#include "camera_set.h"

/* Knots of each of the field's directions; the first is the axis. */
#define CM_NET_RINGS 33
#define CM_NET_GROUPS 8 /* of meshes between two directions */

/* What the lens makes of the knots, on the sensor, in focal lengths. For a beginning floats are enough. */
typedef struct cm_camera_net
{
    int is_made;
    /* of directions, and up to where their knots are */
    double cosine[CM_FIELD_SIDES + 1], sine[CM_FIELD_SIDES + 1], border[CM_FIELD_SIDES + 1];
    float x[CM_FIELD_SIDES + 1][CM_NET_RINGS];
    float y[CM_FIELD_SIDES + 1][CM_NET_RINGS];
    /* around a group's triangles and what is beside them: least x and y, most x and y */
    float box[CM_FIELD_SIDES][CM_NET_GROUPS][4];
} cm_camera_net;

/* Does nothing if it is made. */
void cm_camera_net_make(const cm_lens *lens, const cm_camera_set *set, const cm_camera_field *field,
                        cm_camera_net *net);

/* The next triangle, from a number on, that the place on the sensor is in or beside: the ray that is where the place is in it,
 * were the lens straight there, and the number to go on from. 0 if none is left. */
int cm_camera_net_find(const cm_camera_net *net, const double place[2], size_t *next,
                       double ray[2]);

#endif
