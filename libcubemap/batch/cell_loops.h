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
 * cells, which must be valid, to the middles of theirs. A face above 5 gives CM_NO_CELL. */
typedef struct cm_cell_loops
{
    void (*forward)(cm_curve curve, int level, size_t n, const uint8_t *face, const double *u,
                    const double *v, cm_cell *cell);
    void (*centre)(cm_curve curve, size_t n, const cm_cell *cell, uint8_t *face, double *u,
                   double *v);
} cm_cell_loops;

#endif
