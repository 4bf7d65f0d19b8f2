/* SPDX-License-Identifier: MIT
 *
 * What the files of the certificate (certificate.c) share.
 */
#ifndef TRUTH_CERTIFICATE_H
#define TRUTH_CERTIFICATE_H

#include "truth/quad.h"

#include <cubemap/cubemap.h>

#include <stddef.h>
#include <stdint.h>

enum
{
    BLOCK = 1024
};

typedef enum kind
{
    ROUND_TRIP,
    PLANE_ROUND_TRIP,
    FORWARD,
    FORWARD_RELATIVE,
    INVERSE,
    INVERSE_RELATIVE,
    KINDS
} kind;

typedef struct extreme
{
    double error; /* eps */
    char where[128];
} extreme;

/* double, float, and double computed in float */
typedef enum precision_kind
{
    DOUBLE,
    FLOAT,
    FAST,
    PRECISIONS
} precision_kind;

/* One mapping in one precision, and what has been found of it. */
typedef struct subject
{
    cm_mapping *mapping;
    cm_mapping *exact; /* the truth unless in double */
    cm_mapping *undo;  /* whose inverse is that of forward */
    quad_mapping truth;
    precision_kind precision;
    int narrow; /* the functions for float */
    int faces;
    int is_disc;  /* are u and v a point of the disc? */
    int has_gaps; /* of six squares in a rectangle: rhealpix */
    int is_other; /* are parts or parameters of one face not the standard ones? */
    int is_flat;  /* does the radius stop to grow with the angle, so that no bound holds there? */
    int is_drawn_out;  /* is the azimuth at the antipode drawn out to the square's corners? */
    int is_plane;      /* between disc and square, without a sphere */
    double centre[3];  /* of the field of view */
    double rim_cosine; /* of the angle from there to the rim */
    double eps;
    double least; /* where relative errors begin */
    double condition;
    double widening; /* of the bounds */
    extreme worst[KINDS];
} subject;

/* certificate_library.c: the mapping and its truth, of blocks and of points */
void forward_block(const subject *s, size_t n, double (*d)[BLOCK], uint8_t *face,
                   double (*uv)[BLOCK]);
void inverse_block(const subject *s, size_t n, const uint8_t *face, double (*uv)[BLOCK],
                   double (*d)[BLOCK]);
int warp_point(const subject *s, int back, const double from[2], double to[2]);
int true_forward(const subject *s, const double d[3], long double uv[2]);
void true_inverse(const subject *s, const cm_mapping *exact, int face, const double uv[2],
                  long double d[3]);
void true_warp(const subject *s, int back, const double from[2], long double to[2]);

/* certificate_errors.c */
void round_trips(subject *s, size_t n, double (*d)[BLOCK]);
void hard_round_trips(subject *s, size_t n, double (*d)[BLOCK]);
void face_round_trips(subject *s, size_t n, double (*uv)[BLOCK]);
int is_beside_singularity(const cm_mapping *mapping, double u, double v);
void compare_forward(subject *s, size_t n, double (*d)[BLOCK]);
void compare_inverse(subject *s, size_t n, const uint8_t *face, double (*uv)[BLOCK]);
void compare_warps(subject *s, size_t n, double (*from)[BLOCK]);
void plane_trips(subject *s, size_t n, double (*disc)[BLOCK], double (*square)[BLOCK]);
void compare_planes(subject *s, size_t n, double (*disc)[BLOCK], double (*square)[BLOCK]);

/* certificate_points.c */
void find_view(subject *s);
size_t keep_seen(const subject *s, size_t n, double (*d)[BLOCK]);
void random_directions(subject *s, uint64_t *state, double (*d)[BLOCK]);
void random_points(subject *s, uint64_t *state, uint8_t *face, double (*uv)[BLOCK]);
size_t hard_directions(const subject *s, uint64_t step, uint64_t *index, double (*d)[BLOCK]);
size_t hard_face_points(const subject *s, uint64_t step, uint64_t *index, double (*uv)[BLOCK]);

/* certificate_tear.c */
int is_across_tear(const subject *s, const double d[3], const long double meant[3],
                   const long double truth[2], const double got[2]);

/* certificate_condition.c */
double condition_of(const cm_mapping *mapping, const quad_mapping *truth);

#endif
