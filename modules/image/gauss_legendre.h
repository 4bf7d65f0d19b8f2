/* SPDX-License-Identifier: MIT
 *
 * Gauss-Legendre quadrature on [0, 1].
 */
#ifndef MODULES_IMAGE_GAUSS_LEGENDRE_H
#define MODULES_IMAGE_GAUSS_LEGENDRE_H

/* Polynomials up to degree 31 are integrated exactly. */
#define CM_GAUSS_NODES 16

/* Increasing, and their weights, whose sum is 1. */
extern const double cm_gauss_node[CM_GAUSS_NODES];
extern const double cm_gauss_weight[CM_GAUSS_NODES];

#endif
