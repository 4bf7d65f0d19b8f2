/* SPDX-License-Identifier: MIT
 *
 * Where a lens first folds along a direction, found for certain: there the determinant, times the cube of the divisor, is a
 * polynomial of the ray's length of degree 22 at most, and so is the reach of a tilted sensor, times the divisor. Bernstein's
 * coefficients bound a polynomial between two lengths, and halving makes bounds as close as wanted (Lane and Riesenfeld,
 * Bounds on a polynomial, 1981).
 */
#ifndef MODULES_SCENE_CAMERA_FOLD_H
#define MODULES_SCENE_CAMERA_FOLD_H

#include "camera_lens.h"

#define CM_FOLD_DEGREE 22
#define CM_FOLD_RADIAL 10

/* Polynomials of the square of a ray's length, N / D being the lens's quotient: N W, D W, N D^2 and D^3, where W / D^2 is how fast
 * the length of the place grows without what is tangential. */
typedef struct cm_fold
{
    const cm_lens *lens;
    double unit;               /* of lengths: no coefficient is above 1 by it */
    double above[4], below[4]; /* N and D */
    double square[CM_FOLD_RADIAL], bent[CM_FOLD_RADIAL]; /* N W, D W */
    double drawn[CM_FOLD_RADIAL], cube[CM_FOLD_RADIAL];  /* N D^2, D^3 */
    double twice[2], even[2], steep[2], tilt[3];         /* as of the lens, in units */
    int degree, reach_degree; /* of what depends on the direction; the latter is 0 without a tilt */
    double most;              /* the pole, or what is looked at furthest: a length */
    int has_pole;
    /* of the determinant and of the reach: what is the same in all directions, and a bound of what is a square form of them */
    double same[2][CM_FOLD_DEGREE + 1], form[2][CM_FOLD_DEGREE + 1];
} cm_fold;

/* Bernstein's coefficients of one direction, from 0 to the fold's most. */
typedef struct cm_fold_ray
{
    double cosine, sine;
    double determinant[CM_FOLD_DEGREE + 1];
    double reach[CM_FOLD_DEGREE + 1];
} cm_fold_ray;

/* The lens has to stay; rays are looked at up to a length. */
void cm_fold_prepare(const cm_lens *lens, double furthest, cm_fold *fold);

void cm_fold_turn(const cm_fold *fold, double cosine, double sine, cm_fold_ray *ray);

/* The first length at which the lens folds, has its pole or leaves the sensor, as well as doubles tell it, or a little less, where
 * signs are good; INFINITY if there is none up to the furthest. */
double cm_fold_first(const cm_fold *fold, const cm_fold_ray *ray);

/* Are there none up to a length, at which signs are good? */
int cm_fold_is_clear(const cm_fold *fold, double cosine, double sine, double length);

/* What is certain of all directions between two that are near to each other. */
typedef struct cm_fold_between
{
    double sure; /* up to this length signs are good */
    double
        line; /* and up to this they are where the field is, if is_divided; beyond it nothing is of the field */
    int is_divided;
} cm_fold_between;

/* Of two directions and their first lengths. */
cm_fold_between cm_fold_look_between(const cm_fold *fold, const cm_fold_ray *one,
                                     const cm_fold_ray *next, double one_first, double next_first);

#endif
