/* SPDX-License-Identifier: MIT
 *
 * Where a lens first folds along a direction, found for certain: there the determinant, times the cube of the divisor, is a
 * polynomial of the ray's length of degree 22 at most, and so is the reach of a tilted sensor, times the divisor. Bernstein's
 * coefficients bound it between two lengths, and halving makes bounds as close as wanted (bernstein.h).
 */
#ifndef MODULES_SCENE_CAMERA_FOLD_H
#define MODULES_SCENE_CAMERA_FOLD_H

#include "bernstein.h"
#include "camera_lens.h"

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
    double same[2][CM_BERNSTEIN_COEFFICIENTS], form[2][CM_BERNSTEIN_COEFFICIENTS];
} cm_fold;

/* Bernstein's coefficients of one direction, from 0 to the fold's most. */
typedef struct cm_fold_ray
{
    double cosine, sine;
    double determinant[CM_BERNSTEIN_COEFFICIENTS];
    double reach[CM_BERNSTEIN_COEFFICIENTS];
} cm_fold_ray;

/* The lens has to stay; rays are looked at up to a length. */
void cm_fold_prepare(const cm_lens *lens, double furthest, cm_fold *fold);

void cm_fold_turn(const cm_fold *fold, double cosine, double sine, cm_fold_ray *ray);

/* The first length at which the lens folds, has its pole or leaves the sensor, as well as doubles tell it, or a little less, where
 * signs are good; INFINITY if there is none up to the furthest. */
double cm_fold_first(const cm_fold *fold, const cm_fold_ray *ray);

/* Are there none up to a length, at which signs are good? */
int cm_fold_is_clear(const cm_fold *fold, double cosine, double sine, double length);

/* The length of a place of a span, no more than is looked at. */
static inline double cm_fold_length(const cm_fold *fold, double t, double rest)
{
    const double furthest = fold->most;
    return t < rest * (furthest / fold->unit) ? fold->unit * (t / rest) : furthest;
}

/* From the axis to a length. */
static inline cm_span cm_fold_up_to(const cm_fold *fold, double length)
{
    const double units = length / fold->unit;
    const double rest = 1.0 / (1.0 + units);
    return (cm_span){{0.0, units < 1e300 ? units * rest : 1.0}, {1.0, rest}};
}

#endif
