/* SPDX-License-Identifier: MIT
 *
 * What stands in the borders of planes of numbers: values between the pixels of a neighbour, and copies.
 */
#ifndef MODULES_IMAGE_BORDER_VALUES_H
#define MODULES_IMAGE_BORDER_VALUES_H

#include "padded.h"

/* So many pixels are put at once, at most. */
#define CM_BORDER_RUN 64

typedef struct cm_border_values
{
    const cm_padded *padded;
    const cm_surface *surface;
    double scale[2]; /* the surface's pixels of one of the planes', of columns and rows */
} cm_border_values;

/* n pixels of a border from their directions, which become places: (column, row) is the first, and each is one step on. */
void cm_border_put(const cm_border_values *values, unsigned plane, int32_t column, int32_t row,
                   int32_t right, int32_t down, size_t n, double *x, double *y, double *z);

/* Pixels from a column on, which are those of the row `same` so many columns further, whose columns come again. */
void cm_border_copy(const cm_padded *padded, unsigned plane, int32_t column, int32_t count,
                    int32_t row, int32_t further, int32_t same);

#endif
