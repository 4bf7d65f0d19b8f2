/* SPDX-License-Identifier: MIT
 *
 * Associated Legendre functions and multiples of the longitude for a block of directions, order by order and, within
 * one, degree by degree: the standard forward columns, scaled, of Holmes and Featherstone 2002 (Journal of Geodesy 76,
 * eqs. 11 to 13).
 */
#ifndef MODULES_IMAGE_HARMONICS_BLOCK_H
#define MODULES_IMAGE_HARMONICS_BLOCK_H

#include <stddef.h>
#include <stdint.h>

/* So many directions at once; loops always go over all of them. */
#define CM_HARMONICS_BLOCK 64

/* What legendre carries too much. sin^m(theta) may fall to 2^-1322 so, which is below what weighs anything up to degree
 * 2000: a function of order m is noticeable where sin(theta) > m / degree, and (m / 2000)^m > 2^-1062. */
#define CM_HARMONICS_SCALE 0x1p300

/* A block between begin and the last degree. */
typedef struct cm_harmonics_block
{
    double cosine[CM_HARMONICS_BLOCK]; /* of the angle from z */
    double sine[CM_HARMONICS_BLOCK];
    double along[CM_HARMONICS_BLOCK]; /* cos(lon), sin(lon) */
    double aside[CM_HARMONICS_BLOCK];
    double sector[CM_HARMONICS_BLOCK];   /* the function of degree m */
    double previous[CM_HARMONICS_BLOCK]; /* that of degree l - 1 */
    double legendre
        [CM_HARMONICS_BLOCK]; /* that of degree l, times sqrt(2) for m > 0 and CM_HARMONICS_SCALE */
    double cosine_m[CM_HARMONICS_BLOCK]; /* cos(m lon), sin(m lon) */
    double sine_m[CM_HARMONICS_BLOCK];
    uint32_t order;  /* m */
    uint32_t degree; /* l */
} cm_harmonics_block;

/* n <= CM_HARMONICS_BLOCK directions of any length, at order 0 and degree 0. What is no direction is NaN. */
void cm_harmonics_block_begin(cm_harmonics_block *block, size_t n, const double *x, const double *y,
                              const double *z);

/* To order m + 1 and degree m + 1. */
void cm_harmonics_block_next_order(cm_harmonics_block *block);

/* To degree l + 1. */
void cm_harmonics_block_next_degree(cm_harmonics_block *block);

#endif
