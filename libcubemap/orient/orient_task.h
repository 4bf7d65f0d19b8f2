/* SPDX-License-Identifier: MIT
 *
 * What the files of the search for an orientation share.
 *
 * orient.c          the search: levels of boxes, the best so far, what is left out
 * orient_survey.c   the measure at all nodes of a grid, and all its valleys followed downhill
 * orient_boxes.c    boxes of rotations, and the rotations that exchange faces that look alike
 * orient_bound.c    the bound of a box: the sum over points of linear pieces that a table has
 * orient_loops.inc    that sum, for each instruction set
 * orient_field.c    distortion as a field on the sphere, and its table
 * orient_mask.c     the mask as points, as few as a level needs; the edges' mask and its erosion
 * orient_value.c    the measure itself, and following it downhill
 */
#ifndef LIBCUBEMAP_ORIENT_H
#define LIBCUBEMAP_ORIENT_H

#include "libcubemap/mapping/internal.h"

#include <cubemap/orient.h>

#include <math.h>
#include <stdint.h>

/* ---- Boxes of rotations ---- */

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

/* ---- Points and tables ---- */

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

int cm_points_make(cm_orient_points *points, size_t count); /* 0 if there is no memory */
void cm_points_free(cm_orient_points *points);

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

int cm_table_make(cm_orient_table *table, unsigned side);
void cm_table_free(cm_orient_table *table);

/* Coordinates of the table's faces, about equally long on the sphere: u in [-1, 1] from p = tan, and back; beyond,
 * p goes on along a line. */
#define CM_TABLE_BEND 0.27
static inline double cm_table_tangent(double u)
{
    const double a = 1.0 + CM_TABLE_BEND;
    const double size = u < 0.0 ? -u : u;
    const double p = size > 1.0 ? 1.0 + (size - 1.0) / (1.0 - CM_TABLE_BEND)
                                : 2.0 * size / (a + sqrt(a * a - 4.0 * CM_TABLE_BEND * size));
    return u < 0.0 ? -p : p;
}

/* The unit direction of (u, v) on a face of the table. */
void cm_table_direction(unsigned face, double u, double v, double direction[3]);

/* That of the middle of a piece, by its number. */
void cm_table_middle(unsigned side, unsigned piece, double direction[3]);

/* The number of the piece that a direction is in. */
int cm_table_locate(const double direction[3], unsigned side);

/* The sum over the points, turned by a rotation, of what the table says; and a bound of it for all rotations of a box.
 * With back the points are turned back. */
double cm_orient_sum(const cm_batch_set *set, const cm_orient_points *points,
                     const cm_orient_table *table, int back, const cm_quaternion *at);
double cm_orient_bound(const cm_batch_set *set, const cm_orient_points *points,
                       const cm_orient_table *table, int back, const cm_box_shape *shape);

/* ---- The task ---- */

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
    cm_orient_points
        edges;           /* measure edges: pieces of edges, their weights the parts of all of it */
    double edges_length; /* radians */
} cm_orient_task;

/* What is below the best value in a level's terms: fields are less best where that is over the sphere. */
typedef struct cm_orient_level
{
    cm_orient_points points;
    cm_orient_table table;
    int back;
    double least_scale; /* by which a bound below 0 is divided to be one of the value */
} cm_orient_level;

/* Points and table for boxes of a radius, relative to the best value (normalised as cm_task_value). 0 if there
 * is no memory. */
int cm_level_make(const cm_orient_task *task, double radius, double best, cm_orient_level *level);
void cm_level_free(cm_orient_level *level);

/* The mask's pixels that count, or with per_face > 0 their means in so many by so many cells of a cube's face. */
int cm_mask_points(const cm_orient_task *task, unsigned per_face, cm_orient_points *points);

/* The edges of the mapping's faces in pieces of at most so many radians. */
int cm_edge_points(const cm_mapping *mapping, double length, cm_orient_points *points,
                   double *whole);

/* The mask's value at a direction, between pixels bilinear. */
double cm_mask_at(const cm_mask *mask, const double direction[3]);
double cm_mask_at_lonlat(const cm_mask *mask, double lon, double lat); /* radians */

/* The table of what a mask is no less than within reach of the piece's centre, less best; and of what it is at the
 * centre. */
int cm_mask_table(const cm_orient_task *task, double reach, double best, cm_orient_table *table);
void cm_plain_table(const cm_orient_task *task, cm_orient_table *table);

/* Field and scale of n directions; not finite where there is none. */
void cm_field_values(const cm_orient_task *task, size_t n, const double *x, const double *y,
                     const double *z, double *field, double *scale);

/* The table of the field less best, times the scale where that counts: linear pieces of which the field is never
 * below within reach. threads as in the task. *least_scale as in cm_orient_level. */
int cm_field_table(const cm_orient_task *task, double reach, double turn, double best,
                   cm_orient_table *table, double *least_scale);

/* Does the measure stay with this turn of the cube? */
int cm_field_is_kept(const cm_orient_task *task, const cm_quaternion *turn);

/* The measure over points, a mean, infinite if no point has a value; of edges, for which no points are needed, the part
 * of their length that is over the mask, times the mask's value. NaN if there is no memory. */
double cm_task_value(const cm_orient_task *task, const cm_orient_points *points,
                     const cm_rotation *rotation);

/* A function of rotations, and following it downhill in steps from step to least, radians. Returns the value there, NaN
 * as soon as it is NaN anywhere: there is no memory. */
typedef double (*cm_orient_function)(const void *of, const cm_quaternion *at);
double cm_descend(cm_orient_function function, const void *of, double step, double least,
                  cm_quaternion *rotation);
/* The least of all rotations that are up to so many steps from one, along each of three axes. */
double cm_look_about(cm_orient_function function, const void *of, double step, int steps,
                     cm_quaternion *rotation);

/* ---- The survey ---- */

/* The measure over few points by tables of the field (of edges: of the mask), quickly. */
typedef struct cm_orient_sketch
{
    const cm_batch_set *set;
    cm_orient_points points;
    cm_orient_table table;
    cm_orient_table more; /* over faces; else no pieces */
    int back;
} cm_orient_sketch;

int cm_sketch_make(const cm_orient_task *task, cm_orient_sketch *sketch); /* 0 without memory */
void cm_sketch_free(cm_orient_sketch *sketch);                            /* and after a 0, too */
double cm_sketch_value(const void *of, const cm_quaternion *at);

typedef struct cm_valley
{
    cm_quaternion turn;
    double sketched; /* the least by the sketch */
    double value;    /* and by the whole mask, of those that were followed by it */
} cm_valley;

/* Valleys whose ends are nearer than this are not told apart when the best other one is sought. */
#define CM_OTHER_VALLEY (5.0 * 0.017453292519943295769)

typedef struct cm_orient_survey
{
    const cm_symmetries *symmetries;
    size_t nodes;
    size_t minima;
    double spacing; /* radians */
    cm_valley *valley;
    size_t valley_count;
    size_t followed; /* by the whole mask, the first ones, by value */
    double error;
    double drop;
    double margin; /* as in cm_orient_result */
} cm_orient_survey;

typedef struct cm_survey_progress
{
    int (*call)(double done, void *user); /* may be NULL */
    void *user;
    double part; /* of the whole that the survey is */
} cm_survey_progress;

static inline int cm_survey_stopped(const cm_survey_progress *progress, double done)
{
    return progress->call != NULL && progress->call(done * progress->part, progress->user) != 0;
}

/* CM_OK, CM_ERROR_MEMORY, CM_ERROR_STOPPED; to be freed after any. */
cm_status cm_survey_run(const cm_orient_task *task, const cm_orient_points *mask, double resolution,
                        size_t boxes_max, const cm_survey_progress *progress,
                        cm_orient_survey *result);
void cm_survey_free(cm_orient_survey *result);

#endif
