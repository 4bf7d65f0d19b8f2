/* SPDX-License-Identifier: MIT
 *
 * The tables that papers have printed, computed again: what the files of cubemap-bench papers share.
 */
#ifndef BENCH_SUITE_PAPERS_H
#define BENCH_SUITE_PAPERS_H

#include "bench.h"

/* One figure of a paper. */
typedef struct figure
{
    char row[40];
    char column[40];
    char printed[24]; /* as the paper has it; "?" where the scan of it cannot be read, "" if it
                         has none */
    double computed;
    int expected; /* to agree? Else note says why not */
    const char *note;
} figure;

typedef struct table
{
    size_t count;
    figure *figures;
} table;

/* note NULL: it must agree. */
void add_figure(table *t, const char *row, const char *column, const char *printed, double computed,
                const char *note);

/* Points along an edge: of the papers' pixels, and of the grid with the edges, of which more are better. */
typedef struct resolution
{
    size_t pixels;
    size_t grid;
} resolution;

/* Lambers, Survey of cube mapping methods in interactive computer graphics, 2020 */
void compute_survey(table *t, resolution r);
void compute_optima(table *t, resolution r);
/* Dimitrijevic, Lambers, Rancic, Comparison of spherical cube map projections, 2016 */
void compute_terrain(table *t, resolution r);
/* Dimitrijevic et al., Distortion optimized spherical cube mapping for discrete global grids, 2020 */
void compute_grid(table *t, resolution r);
/* s2geometry, s2coords.h */
void compute_s2(table *t, resolution r);

/* The mapping of a specification that is good, in the frame geo. */
cm_mapping *paper_mapping(const char *specification);

#endif
