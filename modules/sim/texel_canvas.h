/* SPDX-License-Identifier: MIT
 *
 * The canvas of a texel image, whose options are complete.
 */
#ifndef MODULES_SIM_TEXEL_CANVAS_H
#define MODULES_SIM_TEXEL_CANVAS_H

#include <cubemap/texel.h>

/* Its focal length in pixels, both ways alike. */
double cm_texel_focal(const cm_texel_options *complete);

/* A copy with numbers in the place of zeros. */
cm_status cm_texel_completed(const cm_texel_options *options, cm_texel_options *complete);

/* Where samples are on the canvas, and on z = 1. The arrays begin with column. */
typedef struct cm_texel_grid
{
    double *column, *x, *row, *y;
} cm_texel_grid;

/* CM_OK, or CM_ERROR_MEMORY. */
cm_status cm_texel_make_grid(const cm_texel_options *complete, cm_texel_grid *grid);
void cm_texel_drop_grid(cm_texel_grid *grid);

void cm_texel_take_means(const cm_texel_options *complete, const cm_texel_grid *grid,
                         const float *canvas, float *depth);
void cm_texel_take_points(const cm_texel_options *complete, const cm_texel_grid *grid,
                          const float *depth, const cm_texel_image *image);

#endif
