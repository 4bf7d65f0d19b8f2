/* SPDX-License-Identifier: MIT
 *
 * What cell_loops.inc makes.
 */
#ifndef LIBCUBEMAP_BATCH_CELL_LOOPS_H
#define LIBCUBEMAP_BATCH_CELL_LOOPS_H

#include <cubemap/cell.h>

#include <stddef.h>
#include <stdint.h>

/* The loops of cells (cell_loops.inc), over whole vectors: from faces, u and v to the cells of a level, and from
 * cells, which must be valid, to the middles of theirs. A face above 5 gives CM_NO_CELL. As the S2 library rounds
 * (kernel/s2.h): from directions to the cells of a level, and from faces, u and v to directions of length 1, NaN if
 * u or v is. */
typedef struct cm_cell_loops
{
    void (*forward)(cm_curve curve, int level, size_t n, const uint8_t *face, const double *u,
                    const double *v, cm_cell *cell);
    void (*centre)(cm_curve curve, size_t n, const cm_cell *cell, uint8_t *face, double *u,
                   double *v);
    void (*s2_forward)(int level, size_t n, const double *x, const double *y, const double *z,
                       cm_cell *cell);
    void (*s2_inverse)(size_t n, const uint8_t *face, const double *u, const double *v, double *x,
                       double *y, double *z);
} cm_cell_loops;

#endif
