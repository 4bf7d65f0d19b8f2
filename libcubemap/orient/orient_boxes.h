/* SPDX-License-Identifier: MIT
 *
 * Boxes of rotations, and the rotations that exchange faces that look alike (orient_boxes.c).
 */
#ifndef LIBCUBEMAP_ORIENT_BOXES_H
#define LIBCUBEMAP_ORIENT_BOXES_H

#include <cubemap/grid.h>

#include <stddef.h>
#include <stdint.h>

typedef struct cm_quaternion
{
    double q[4]; /* scalar first */
} cm_quaternion;

/* Of quaternions up to sign: axis is the component that is 1, the others, in order, are tangents of
 * angles from -45 to 45 degrees, and the box is the index-th of 2^level * CM_BOXES_ROOT intervals of each. */
typedef struct cm_box
{
    uint8_t axis;
    uint8_t level;
    uint16_t index[3];
} cm_box;

#define CM_BOXES_ROOT 32u

typedef struct cm_box_shape
{
    cm_quaternion centre;
    double radius; /* the largest angle from the centre, radians */
    double corner
        [8][3]; /* tan(half the angle) times the axis of the turn from the centre to each corner */
} cm_box_shape;

/* The rotations of a cube that keep something, as quaternions; the first is none at all. */
typedef struct cm_symmetries
{
    unsigned count;
    cm_quaternion turn[24];
} cm_symmetries;

void cm_all_symmetries(cm_symmetries *all);
void cm_box_find_shape(const cm_box *box, cm_box_shape *shape);
/* Is every rotation of the box nearer to one of the symmetries than to none? Then another box has the like. */
int cm_box_is_spare(const cm_box *box, const cm_symmetries *symmetries);

typedef struct cm_boxes
{
    cm_box *box;
    size_t count;
} cm_boxes;

/* All boxes of the first level that are not spare; each one's eight parts that are not, in place of it. 0 if
 * there is no memory. */
int cm_boxes_make(cm_boxes *boxes, const cm_symmetries *symmetries);
int cm_boxes_split(cm_boxes *boxes, const cm_symmetries *symmetries);

/* Sorts boxes of one level so that they can be found. */
void cm_boxes_sort(cm_boxes *boxes);
/* Which of the sorted boxes a rotation is in, or one as good by symmetry; their count if none. */
size_t cm_boxes_find(const cm_boxes *boxes, const cm_quaternion *turn,
                     const cm_symmetries *symmetries);
/* The middle of the box so many steps, -1 to 1, along each axis. Not of unit length. */
cm_quaternion cm_box_neighbour(const cm_box *box, const int step[3]);

void cm_matrix_from_quaternion(const cm_quaternion *from, cm_rotation *to);
void cm_quaternion_from_matrix(const cm_rotation *from, cm_quaternion *to);
cm_quaternion cm_quaternion_product(const cm_quaternion *a, const cm_quaternion *b);
/* The angle between two rotations, radians, as small as the symmetries make it. */
double cm_rotations_apart(const cm_quaternion *a, const cm_quaternion *b,
                          const cm_symmetries *symmetries);

#endif
