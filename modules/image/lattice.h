/* SPDX-License-Identifier: MIT
 *
 * Exact positions at the nodes between which pixels are interpolated. Nodes stand at absolute places of the target's plane,
 * so that neighbours share them and no bit depends on what is wanted.
 */
#ifndef MODULES_IMAGE_LATTICE_H
#define MODULES_IMAGE_LATTICE_H

#include "place_set.h"
#include "resample_plan.h"

/* A block's nodes each way, with those beyond it. */
#define CM_LATTICE_SEEN 8
#define CM_LATTICE_ROWS CM_LATTICE_SEEN
#define CM_LATTICE_COLUMNS_MAX 53
#define CM_LATTICE_NODES (CM_LATTICE_ROWS * CM_LATTICE_COLUMNS_MAX)

/* A lattice is of so many blocks in a row, from a multiple of it on: array functions like many points. */
typedef struct cm_lattice_shape
{
    int32_t edge;   /* of a block, in pixels */
    int32_t steps;  /* from its first node to its last one */
    int32_t beyond; /* nodes beyond it on each side; steps + 1 + 2 beyond are CM_LATTICE_SEEN */
    int32_t blocks; /* steps * blocks + 1 + 2 beyond are at most CM_LATTICE_COLUMNS_MAX */
    int has_fourth; /* are fourth differences wanted? */
} cm_lattice_shape;

/* Of the blocks of 16 pixels: nodes a third of one apart. The first ones beyond tell how smooth it is, and both, where four
 * nodes each way do not suffice, give polynomials of more. */
extern const cm_lattice_shape cm_lattice_fine;

typedef struct cm_lattice
{
    const cm_lattice_shape *shape; /* to be set before it is filled first, all else 0 */
    int is_there;                  /* has it been filled? */
    unsigned to_plane;
    uint32_t block_row;
    uint32_t chunk; /* the first block's column, in shape's blocks */
    int is_uniform; /* are all nodes on one plane of the source? */
    int is_wrapped; /* may columns jump by the source's period? */
    size_t columns; /* of nodes, which are row by row */
    double x[CM_LATTICE_NODES];
    double y[CM_LATTICE_NODES];
    float across[CM_LATTICE_NODES]; /* squared differences of five in a row */
    float along[2 *
                CM_LATTICE_COLUMNS_MAX]; /* of five in a column, from its second and third row on */
    uint8_t plane[CM_LATTICE_NODES];     /* of the source, or CM_NO_FACE */
} cm_lattice;

/* Exact positions of places of the target's plane. Results may overwrite places. */
void cm_lattice_find(const cm_plan *plan, unsigned plane, size_t n, const double *column,
                     const double *row, uint8_t *found, double *x, double *y);

/* Makes it the lattice of that chunk; what it has of the row of blocks above is used again. */
void cm_lattice_fill(cm_lattice *lattice, const cm_plan *plan, const cm_place_set *set,
                     unsigned to_plane, uint32_t block_row, uint32_t chunk);

/* What a block sees of a lattice: its own nodes and those beyond. */
typedef struct cm_lattice_view
{
    size_t stride;   /* from row to row */
    const double *x; /* of the furthest node above and to the left */
    const double *y;
    const uint8_t *plane;
    const float *across;
    const float *along; /* two rows, so far apart as rows of nodes */
} cm_lattice_view;

/* A view's nodes of its own. */
typedef struct cm_lattice_copy
{
    double x[CM_LATTICE_SEEN * CM_LATTICE_SEEN];
    double y[CM_LATTICE_SEEN * CM_LATTICE_SEEN];
    float across[CM_LATTICE_SEEN * CM_LATTICE_SEEN];
    float along[2 * CM_LATTICE_SEEN];
    uint8_t plane[CM_LATTICE_SEEN * CM_LATTICE_SEEN];
} cm_lattice_copy;

/* The view of a block of the lattice, the block's number counted from the first. Where columns may jump by a period
 * they are counted on from the block's first node, in the copy. */
cm_lattice_view cm_lattice_see(const cm_lattice *lattice, const cm_place_set *set, double period,
                               unsigned block, cm_lattice_copy *copy);

/* The squares of the greatest fourth differences of a block, across and along. 0 if the block's own nodes are not on
 * one plane, or nothing beyond them is; alone is set if one of the sides is missing. */
int cm_lattice_bend(const cm_lattice_view *view, int is_uniform, float *across, float *along,
                    int *alone);

/* The greatest sixth differences of a block and the nodes around it, across and along. 0 if not all that the block sees are
 * on one plane. */
int cm_lattice_bend_wide(const cm_lattice_view *view, int is_uniform, double *across,
                         double *along);

/* The same where only the inner six of the eight nodes each way must be, and those beyond them on one side. alone is set if
 * one of the sides is missing. */
int cm_lattice_bend_six(const cm_lattice_view *view, int is_uniform, double *across, double *along,
                        int *alone);

#endif
