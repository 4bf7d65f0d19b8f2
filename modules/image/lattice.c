/* SPDX-License-Identifier: MIT */
#include "lattice.h"

#include <math.h>
#include <string.h>

#define NODES (CM_LATTICE_ROWS * CM_LATTICE_COLUMNS)

/* Rows of nodes that a row of blocks shares with the next one. */
#define SHARED 3

void cm_lattice_find(const cm_plan *plan, unsigned plane, size_t n, const double *column,
                     const double *row, uint8_t *found, double *x, double *y)
{
    double z[NODES];
    cm_surface_own_directions(plan->to, plane, n, column, row, x, y, z);
    cm_surface_find(plan->from, n, x, y, z, found, x, y);
}

/* ---- filling ---- */

/* Where node number 3 n is the first one of block n. */
static double place_of(int64_t node)
{
    return (double)(node * CM_BLOCK_EDGE) / 3.0;
}

/* Exact positions of rows from first on. Where the target's plane does not go on, nodes beyond it are none. */
static void find_rows(cm_lattice *lattice, const cm_plan *plan, unsigned first)
{
    const cm_surface *to = plan->to;
    double columns[NODES];
    double rows[NODES];
    uint8_t beyond[NODES];
    const int64_t left = (int64_t)lattice->chunk * (3 * CM_LATTICE_BLOCKS) - 1;
    const int64_t top = (int64_t)lattice->block_row * 3 - 1;
    /* no kind is asked further beyond its edges than the blocks at them reach */
    const double most = 2.0 * CM_BLOCK_EDGE;
    const double low = to->methods->can_go_beyond ? -most : 0.0;
    size_t n = 0;
    for (int64_t r = first; r < CM_LATTICE_ROWS; r++)
    {
        for (int64_t k = 0; k < CM_LATTICE_COLUMNS; k++, n++)
        {
            const double column = place_of(left + k);
            const double row = place_of(top + r);
            const double right = column < to->width - low ? column : to->width - low;
            const double down = row < to->height - low ? row : to->height - low;
            columns[n] = right > low ? right : low;
            rows[n] = down > low ? down : low;
            beyond[n] = columns[n] != column || rows[n] != row;
        }
    }
    uint8_t *plane = lattice->plane[first];
    cm_lattice_find(plan, lattice->to_plane, n, columns, rows, plane, lattice->x[first],
                    lattice->y[first]);
    for (size_t i = 0; i < n; i++)
    {
        plane[i] = beyond[i] ? CM_NO_FACE : plane[i];
    }
}

static int spans_more_than(const cm_lattice *lattice, double extent)
{
    double low = INFINITY;
    double high = -INFINITY;
    const double *x = lattice->x[0];
    for (size_t i = 0; i < NODES; i++)
    {
        low = x[i] < low ? x[i] : low;
        high = x[i] > high ? x[i] : high;
    }
    return high - low > extent;
}

static void keep_shared(cm_lattice *lattice)
{
    const size_t from = CM_LATTICE_ROWS - SHARED;
    memcpy(lattice->x, lattice->x + from, SHARED * sizeof *lattice->x);
    memcpy(lattice->y, lattice->y + from, SHARED * sizeof *lattice->y);
    memcpy(lattice->plane, lattice->plane + from, SHARED * sizeof *lattice->plane);
    memcpy(lattice->across, lattice->across + from, SHARED * sizeof *lattice->across);
}

/* Differences of the rows from first on, and of all columns. */
static void difference(cm_lattice *lattice, const cm_place_set *set, unsigned first)
{
    for (unsigned r = first; r < CM_LATTICE_ROWS; r++)
    {
        set->differences(CM_LATTICE_COLUMNS - 4, lattice->x[r], lattice->y[r], 1,
                         lattice->across[r]);
    }
    for (unsigned r = 0; r < 2; r++)
    {
        set->differences(CM_LATTICE_COLUMNS, lattice->x[r], lattice->y[r], CM_LATTICE_COLUMNS,
                         lattice->along[r]);
    }
}

void cm_lattice_fill(cm_lattice *lattice, const cm_plan *plan, const cm_place_set *set,
                     unsigned to_plane, uint32_t block_row, uint32_t chunk)
{
    const int is_same =
        lattice->is_there && lattice->to_plane == to_plane && lattice->chunk == chunk;
    const int has_shared = is_same && lattice->block_row + 1 == block_row;
    if (is_same && lattice->block_row == block_row)
    {
        return;
    }
    if (has_shared)
    {
        keep_shared(lattice);
    }
    const unsigned first = has_shared ? SHARED : 0;
    const int has_differences = has_shared && !lattice->is_wrapped;
    lattice->is_there = 1;
    lattice->to_plane = to_plane;
    lattice->block_row = block_row;
    lattice->chunk = chunk;
    find_rows(lattice, plan, first);
    const uint8_t *plane = lattice->plane[0];
    const double period = plan->from->period;
    lattice->is_uniform = plane[0] != CM_NO_FACE && memcmp(plane, plane + 1, NODES - 1) == 0;
    lattice->is_wrapped = period > 0.0 && spans_more_than(lattice, 0.5 * period);
    if (!lattice->is_wrapped)
    {
        difference(lattice, set, has_differences ? first : 0);
    }
}

/* ---- seeing ---- */

/* Columns within half a period of the block's first node. */
static void unwrap(const cm_lattice_view *from, double period, double *x)
{
    const double first = from->x[from->stride + 1];
    for (size_t r = 0; r < CM_LATTICE_ROWS; r++)
    {
        for (size_t k = 0; k < 6; k++)
        {
            const double at = from->x[r * from->stride + k];
            const double away = at - first;
            x[6 * r + k] = away > 0.5 * period    ? at - period
                           : away < -0.5 * period ? at + period
                                                  : at;
        }
    }
}

cm_lattice_view cm_lattice_see(const cm_lattice *lattice, const cm_place_set *set, double period,
                               unsigned block, cm_lattice_copy *copy)
{
    const size_t first = 3 * (size_t)block;
    cm_lattice_view view = {.stride = CM_LATTICE_COLUMNS,
                            .x = lattice->x[0] + first,
                            .y = lattice->y[0] + first,
                            .plane = lattice->plane[0] + first,
                            .across = lattice->across[0] + first,
                            .along = lattice->along[0] + first};
    if (!lattice->is_wrapped)
    {
        return view;
    }
    unwrap(&view, period, copy->x);
    for (size_t r = 0; r < CM_LATTICE_ROWS; r++)
    {
        memcpy(copy->y + 6 * r, view.y + r * view.stride, 6 * sizeof *copy->y);
        memcpy(copy->plane + 6 * r, view.plane + r * view.stride, 6 * sizeof *copy->plane);
        set->differences(2, copy->x + 6 * r, copy->y + 6 * r, 1, copy->across + 6 * r);
    }
    set->differences(2 * 6, copy->x, copy->y, 6, copy->along);
    return (cm_lattice_view){6, copy->x, copy->y, copy->plane, copy->across, copy->along};
}

/* Are nodes of rows and columns on the plane? */
static int are_on(const cm_lattice_view *view, uint8_t plane, size_t row, size_t rows,
                  size_t column, size_t columns)
{
    for (size_t r = row; r < row + rows; r++)
    {
        for (size_t k = column; k < column + columns; k++)
        {
            if (view->plane[r * view->stride + k] != plane)
            {
                return 0;
            }
        }
    }
    return 1;
}

static float greatest(const float *square, size_t n, size_t apart, float most)
{
    for (size_t i = 0; i < n; i++)
    {
        const float next = square[i * apart];
        most = next > most ? next : most;
    }
    return most;
}

int cm_lattice_bend(const cm_lattice_view *view, int is_uniform, float *across, float *along,
                    int *alone)
{
    int left = 1, right = 1, above = 1, below = 1;
    const size_t stride = view->stride;
    if (!is_uniform)
    {
        const uint8_t plane = view->plane[stride + 1];
        left = are_on(view, plane, 1, 4, 0, 1);
        right = are_on(view, plane, 1, 4, 5, 1);
        above = are_on(view, plane, 0, 1, 1, 4);
        below = are_on(view, plane, 5, 1, 1, 4);
        if (plane == CM_NO_FACE || !are_on(view, plane, 1, 4, 1, 4) || !(left || right) ||
            !(above || below))
        {
            return 0;
        }
    }
    *across = left ? greatest(view->across + stride, 4, stride, 0.0f) : 0.0f;
    *across = right ? greatest(view->across + stride + 1, 4, stride, *across) : *across;
    *along = above ? greatest(view->along + 1, 4, 1, 0.0f) : 0.0f;
    *along = below ? greatest(view->along + stride + 1, 4, 1, *along) : *along;
    *alone = !(left && right && above && below);
    return 1;
}
