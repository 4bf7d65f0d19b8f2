/* SPDX-License-Identifier: MIT
 *
 * What the files about cells share.
 */
#ifndef LIBCUBEMAP_CELLS_CELL_SHAPE_H
#define LIBCUBEMAP_CELLS_CELL_SHAPE_H

#include <cubemap/cubemap.h>
#include <cubemap/kernels.h>

#include "libcubemap/batch/batch_set.h"

#define CM_CELL_BULGES 5

struct cm_cell_grid
{
    const cm_grid *grid;
    cm_curve curve;
    int is_s2; /* points are placed as the S2 library rounds */
    const cm_batch_set *set;
    /* By what factor the points of a cell of level k may be further from its centre than its corners are; the
     * last is of finer ones, too. */
    double bulge[CM_CELL_BULGES];
};

static inline int cm_curve_is_valid(cm_curve curve)
{
    return curve == CM_CURVE_HILBERT || curve == CM_CURVE_MORTON;
}

/* The angle between two vectors of length 1, to eps of it where it is small. */
static inline double cm_angle(const double a[3], const double b[3])
{
    double d[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    double s[3] = {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
    return 2.0 * atan2(sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]),
                       sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]));
}

/* What rounding may add to an angle between two normals. */
#define CM_CELL_SLACK 1e-14

/* Are four cells the quarters of one, in their order? */
int cm_cell_are_quarters(const cm_cell *four);

int cm_cell_compare(const void *a, const void *b);

/* ---- As the S2 library rounds, CM_BLOCK points at most ---- */

/* Are the grid's cells S2's, but for rounding? */
int cm_grid_has_s2_cells(const cm_grid *grid);

void cm_s2_cells_of_block(const cm_cell_grid *cells, int level, size_t n, const double *x,
                          const double *y, const double *z, cm_cell *cell);

/* The normals at places of faces, which are multiples of 2^-30; NaN where u or v is. */
void cm_s2_normals_of_block(const cm_cell_grid *cells, size_t n, const uint8_t *face,
                            const double *u, const double *v, double *x, double *y, double *z);

/* Longitude and latitude of a place, as of a cell's centre. */
void cm_s2_lonlat(uint8_t face, const double uv[2], double lonlat[2]);

/* Those of a direction. */
void cm_s2_lonlat_of(const double direction[3], double lonlat[2]);

/* The normals at places of faces, CM_BLOCK at most. */
void cm_cell_normals_at(const cm_cell_grid *cells, size_t n, const uint8_t *face, const double *u,
                        const double *v, double *x, double *y, double *z);

/* By what factor edges of the grid's cells bulge. CM_OK or CM_ERROR_MEMORY. */
cm_status cm_cell_measure_bulges(cm_cell_grid *cells);

/* The normals at the corners of a cell, and at its centre; NaN for none. */
void cm_cell_normals(const cm_cell_grid *cells, cm_cell cell, double normal[5][3]);

/* These, and the radius of the bounding cap about the fifth. */
double cm_cell_cap(const cm_cell_grid *cells, cm_cell cell, double normal[5][3]);

#endif
