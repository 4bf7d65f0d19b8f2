/* SPDX-License-Identifier: MIT
 *
 * FLIP from the paper's formulas with filters in two dimensions, slow and apart from the library's: the tests' own.
 */
#ifndef TESTS_OWN_FLIP_H
#define TESTS_OWN_FLIP_H

#include <stddef.h>

/* Of two pictures, three doubles a pixel of linear light from 0 to 1; flip has one a pixel. */
void own_flip(size_t width, size_t height, const double *one, const double *other,
              double pixels_per_degree, double *flip);

/* The curve that stands for ACES with an exposure of the given power of two, 0 to 1. */
double own_tone(double light, double exposure);

#endif
