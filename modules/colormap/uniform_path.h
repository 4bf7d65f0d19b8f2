/* SPDX-License-Identifier: MIT
 *
 * The paths of the uniform maps: cubic splines through CAM16-UCS.
 */
#ifndef COLORMAP_UNIFORM_PATH_H
#define COLORMAP_UNIFORM_PATH_H

#include "colormap_catalogue.h"

/* The largest number of pieces that a path has. */
#define CM_UNIFORM_PIECES_MAX 10

/* J', a', b' at x in [0, 1] are cubic polynomials: coefficients of 1, x, x^2, x^3. */
typedef struct cm_uniform_piece
{
    double of_power[4][3];
} cm_uniform_piece;

/* The pieces of a uniform model's path, in their order, and their number. */
size_t cm_uniform_pieces(cm_colormap_model model, cm_uniform_piece piece[CM_UNIFORM_PIECES_MAX]);

void cm_uniform_point(const cm_uniform_piece *piece, double x, double ucs[3]);
void cm_uniform_velocity(const cm_uniform_piece *piece, double x, double velocity[3]);

/* The length from 0 to x, and the x up to which a part of it lies. */
double cm_uniform_length(const cm_uniform_piece *piece, double x);
double cm_uniform_place(const cm_uniform_piece *piece, double part);

#endif
