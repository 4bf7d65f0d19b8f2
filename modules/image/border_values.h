/* SPDX-License-Identifier: MIT
 *
 * What stands in the borders of planes of numbers: values between the pixels of a neighbour, and copies.
 */
#ifndef MODULES_IMAGE_BORDER_VALUES_H
#define MODULES_IMAGE_BORDER_VALUES_H

#include "padded.h"

/* So many pixels are put at once, at most. */
#define CM_BORDER_RUN CM_SIX_MOST

/* The four parts of a border that stands alone: rows above and below with both ends, columns to the left and right. */
#define CM_BORDER_SIDES 4

typedef struct cm_border_values
{
    const cm_padded *padded;
    const cm_surface *surface;
    const cm_filter_set *set; /* NULL if there is a reader */
    double scale[2];          /* the surface's pixels of one of the planes', of columns and rows */
    const cm_level_reader *reader; /* of pictures that values come from; NULL: from padded */
    const cm_padded *side;         /* CM_BORDER_SIDES where they go then */
} cm_border_values;

/* n pixels of a border from their directions, which become places: (column, row) is the first, and each is one step on. */
void cm_border_put(const cm_border_values *values, unsigned plane, int32_t column, int32_t row,
                   int32_t right, int32_t down, size_t n, double *x, double *y, double *z);

/* The border of one plane that is like those of `shape`, which has no memory, from pictures: of planes that go on everywhere
 * and have six pixels each way. It is what cm_padded_border makes of the same pixels. padded_border.c has it. */
void cm_padded_border_alone(const cm_padded *shape, const cm_surface *surface,
                            const cm_filter_set *set, const cm_level_reader *reader, unsigned plane,
                            const cm_padded parts[CM_BORDER_SIDES], unsigned threads);

/* Pixels from a column on, which are those of the row `same` so many columns further, whose columns come again. */
void cm_border_copy(const cm_padded *padded, unsigned plane, int32_t column, int32_t count,
                    int32_t row, int32_t further, int32_t same);

#endif
