/* SPDX-License-Identifier: MIT
 *
 * What the lens makes of the border of its field, as a chain of straight lines, and which parts of the picture that goes
 * around: only there are pixels that have rays.
 */
#ifndef MODULES_SCENE_CAMERA_IMAGE_H
#define MODULES_SCENE_CAMERA_IMAGE_H

#include <stddef.h>

#include "camera_field.h"
#include "camera_set.h"

/* The picture is divided into so many cells each way. */
#define CM_IMAGE_CELLS 128

typedef enum cm_camera_reach
{
    CM_IMAGE_MISSED,
    CM_IMAGE_UNKNOWN,
    CM_IMAGE_REACHED
} cm_camera_reach;

/* A corner of the chain, and how far the border's image may be from the line to the next one. */
typedef struct cm_image_corner
{
    double x, y;
    double sag;
} cm_image_corner;

typedef struct cm_camera_image
{
    cm_image_corner *corner; /* NULL: nothing is known */
    size_t corners;
    double disc;     /* beyond so much from the axis corners are drawn nearer, by the logarithm */
    double first[2]; /* of the picture, on the plane of the lens before the tilt */
    double per_unit[2]; /* cells; 0: the picture is nowhere */
    unsigned char reach[CM_IMAGE_CELLS][CM_IMAGE_CELLS];
} cm_camera_image;

/* box is that around the picture: the least x and y, and the most, in focal lengths, the tilt undone; NULL: it is nowhere. Sets
 * the field's furthest. 0 if there was no memory. */
int cm_camera_image_find(const cm_lens *lens, cm_camera_field *field, const double box[4],
                         cm_camera_image *image);

/* Can the lens make (x, y) of a ray inside? */
cm_camera_reach cm_camera_image_reaches(const cm_camera_image *image, double x, double y);

/* Takes the aims out of a block that a glance shows to be missed: no steps are made towards them. */
void cm_camera_image_drop(const cm_camera_image *image, cm_camera_block *block);

#endif
