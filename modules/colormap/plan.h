/* SPDX-License-Identifier: MIT
 *
 * Where the samples of a map are.
 */
#ifndef COLORMAP_PLAN_H
#define COLORMAP_PLAN_H

#include "colormap_path.h"

/* Each run of samples goes on in equal steps from its first one, which is the first
 * behind a corner. */
typedef struct cm_colormap_run
{
    size_t first;
    double t;
} cm_colormap_run;

typedef struct cm_colormap_plan
{
    size_t n;
    int is_even; /* 0: there is no corner, or no room for this; then there is no more in the plan */
    int mirrored;
    double step; /* of t */
    size_t run_count;
    cm_colormap_run run[CM_COLORMAP_PIECES_MAX + 1];
} cm_colormap_plan;

void cm_colormap_make_plan(const cm_colormap *map, size_t n, cm_colormap_plan *plan);
double cm_colormap_place(const cm_colormap *map, const cm_colormap_plan *plan, size_t index);

#endif
