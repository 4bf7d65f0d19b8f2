/* SPDX-License-Identifier: MIT */
#include "lattice.h"

#include <math.h>
#include <string.h>

const cm_lattice_shape cm_lattice_fine = {
    .edge = CM_BLOCK_EDGE, .steps = 3, .beyond = 2, .blocks = 8, .has_fourth = 1};

/* Rows of nodes that a row of blocks shares with the next one. */
static unsigned shared_rows(const cm_lattice *lattice)
{
    return CM_LATTICE_ROWS - (unsigned)lattice->shape->steps;
}

void cm_lattice_find(const cm_plan *plan, unsigned plane, size_t n, const double *column,
                     const double *row, uint8_t *found, double *x, double *y)
{
    double z[CM_LATTICE_NODES];
    cm_surface_own_directions(plan->to, plane, n, column, row, x, y, z);
    cm_surface_find(plan->from, n, x, y, z, found, x, y);
}

/* ---- filling ---- */

/* Where node number steps * n is the first one of block n. */
static double place_of(const cm_lattice_shape *shape, int64_t node)
{
    return (double)(node * shape->edge) / shape->steps;
}

static double between(double low, double x, double high)
{
    const double less = x < high ? x : high;
    return less > low ? less : low;
}

/* Exact positions of rows from first on. Where the target's plane does not go on, nodes beyond it are none. */
static void find_rows(cm_lattice *lattice, const cm_plan *plan, unsigned first)
{
    const cm_surface *to = plan->to;
    double columns[CM_LATTICE_NODES];
    double rows[CM_LATTICE_NODES];
    uint8_t beyond[CM_LATTICE_NODES];
    const cm_lattice_shape *shape = lattice->shape;
    const int64_t left = (int64_t)lattice->chunk * shape->steps * shape->blocks - shape->beyond;
    const int64_t top = (int64_t)lattice->block_row * shape->steps - shape->beyond;
    /* no kind is asked further beyond its edges than the small blocks at them reach */
    const double most = 2.0 * CM_BLOCK_EDGE;
    const double low = to->methods->can_go_beyond ? -most : 0.0;
    uint8_t is_beyond[CM_LATTICE_COLUMNS_MAX];
    const size_t across = lattice->columns;
    for (int64_t k = 0; k < (int64_t)across; k++)
    {
        const double column = place_of(shape, left + k);
        columns[k] = between(low, column, to->width - low);
        is_beyond[k] = columns[k] != column;
    }
    size_t n = 0;
    int64_t r = first;
    do
    {
        const double row = place_of(shape, top + r);
        const double at = between(low, row, to->height - low);
        memmove(columns + n, columns, across * sizeof *columns);
        for (size_t k = 0; k < across; k++)
        {
            rows[n + k] = at;
        }
        if (at == row)
        {
            memcpy(beyond + n, is_beyond, across);
        }
        else
        {
            memset(beyond + n, 1, across);
        }
        n += across;
    } while (++r < CM_LATTICE_ROWS);
    const size_t at = first * across;
    uint8_t *plane = lattice->plane + at;
    cm_lattice_find(plan, lattice->to_plane, n, columns, rows, plane, lattice->x + at,
                    lattice->y + at);
    for (size_t i = 0; i < n; i++)
    {
        plane[i] = beyond[i] ? CM_NO_FACE : plane[i];
    }
}

/* By rows, as compilers make vectors of it. */
static int spans_more_than(const cm_lattice *lattice, double extent)
{
    double low[CM_LATTICE_COLUMNS_MAX];
    double high[CM_LATTICE_COLUMNS_MAX];
    const size_t columns = lattice->columns;
    for (size_t k = 0; k < columns; k++)
    {
        /* NaN is neither less nor more */
        low[k] = INFINITY;
        high[k] = -INFINITY;
    }
    for (size_t r = 0; r < CM_LATTICE_ROWS; r++)
    {
        const double *x = lattice->x + r * columns;
        for (size_t k = 0; k < columns; k++)
        {
            low[k] = x[k] < low[k] ? x[k] : low[k];
            high[k] = x[k] > high[k] ? x[k] : high[k];
        }
    }
    for (size_t k = 1; k < columns; k++)
    {
        low[0] = low[k] < low[0] ? low[k] : low[0];
        high[0] = high[k] > high[0] ? high[k] : high[0];
    }
    return high[0] - low[0] > extent;
}

static void keep_shared(cm_lattice *lattice)
{
    const size_t shared = shared_rows(lattice) * lattice->columns;
    const size_t from = CM_LATTICE_ROWS * lattice->columns - shared;
    memmove(lattice->x, lattice->x + from, shared * sizeof *lattice->x);
    memmove(lattice->y, lattice->y + from, shared * sizeof *lattice->y);
    memmove(lattice->plane, lattice->plane + from, shared * sizeof *lattice->plane);
    memmove(lattice->across, lattice->across + from, shared * sizeof *lattice->across);
}

/* Differences of the rows from first on, and of all columns. */
static void difference(cm_lattice *lattice, const cm_place_set *set, unsigned first)
{
    const size_t columns = lattice->columns;
    for (size_t at = first * columns; at < CM_LATTICE_ROWS * columns; at += columns)
    {
        set->differences(columns - 4, lattice->x + at, lattice->y + at, 1, lattice->across + at);
    }
    set->differences(2 * columns, lattice->x + columns, lattice->y + columns, columns,
                     lattice->along);
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
    const unsigned first = has_shared ? shared_rows(lattice) : 0;
    const int has_differences = has_shared && !lattice->is_wrapped;
    lattice->is_there = 1;
    lattice->to_plane = to_plane;
    lattice->block_row = block_row;
    lattice->chunk = chunk;
    lattice->columns =
        (size_t)(lattice->shape->steps * lattice->shape->blocks + 1 + 2 * lattice->shape->beyond);
    find_rows(lattice, plan, first);
    const uint8_t *plane = lattice->plane;
    const double period = plan->from->period;
    lattice->is_uniform = plane[0] != CM_NO_FACE &&
                          memcmp(plane, plane + 1, CM_LATTICE_ROWS * lattice->columns - 1) == 0;
    lattice->is_wrapped = period > 0.0 && spans_more_than(lattice, 0.5 * period);
    if (!lattice->is_wrapped && lattice->shape->has_fourth)
    {
        difference(lattice, set, has_differences ? first : 0);
    }
}

/* ---- seeing ---- */

/* Columns within half a period of the block's first node. */
static void unwrap(const cm_lattice_view *from, size_t beyond, double period, double *x)
{
    const double first = from->x[beyond * (from->stride + 1)];
    for (size_t r = 0; r < CM_LATTICE_ROWS; r++)
    {
        for (size_t k = 0; k < CM_LATTICE_SEEN; k++)
        {
            const double at = from->x[r * from->stride + k];
            const double away = at - first;
            x[CM_LATTICE_SEEN * r + k] = away > 0.5 * period    ? at - period
                                         : away < -0.5 * period ? at + period
                                                                : at;
        }
    }
}

cm_lattice_view cm_lattice_see(const cm_lattice *lattice, const cm_place_set *set, double period,
                               unsigned block, cm_lattice_copy *copy)
{
    const size_t first = (size_t)lattice->shape->steps * block;
    cm_lattice_view view = {.stride = lattice->columns,
                            .x = lattice->x + first,
                            .y = lattice->y + first,
                            .plane = lattice->plane + first,
                            .across = lattice->across + first,
                            .along = lattice->along + first};
    if (!lattice->is_wrapped)
    {
        return view;
    }
    const size_t seen = CM_LATTICE_SEEN;
    unwrap(&view, (size_t)lattice->shape->beyond, period, copy->x);
    for (size_t r = 0; r < CM_LATTICE_ROWS; r++)
    {
        memcpy(copy->y + seen * r, view.y + r * view.stride, seen * sizeof *copy->y);
        memcpy(copy->plane + seen * r, view.plane + r * view.stride, seen * sizeof *copy->plane);
    }
    for (size_t r = 0; lattice->shape->has_fourth && r < CM_LATTICE_ROWS; r++)
    {
        set->differences(seen - 4, copy->x + seen * r, copy->y + seen * r, 1,
                         copy->across + seen * r);
    }
    if (lattice->shape->has_fourth)
    {
        set->differences(2 * seen, copy->x + seen, copy->y + seen, seen, copy->along);
    }
    return (cm_lattice_view){seen, copy->x, copy->y, copy->plane, copy->across, copy->along};
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
    const size_t own = (size_t)cm_lattice_fine.beyond;
    if (!is_uniform)
    {
        const uint8_t plane = view->plane[own * (stride + 1)];
        left = are_on(view, plane, own, 4, own - 1, 1);
        right = are_on(view, plane, own, 4, own + 4, 1);
        above = are_on(view, plane, own - 1, 1, own, 4);
        below = are_on(view, plane, own + 4, 1, own, 4);
        if (plane == CM_NO_FACE || !are_on(view, plane, own, 4, own, 4) || !(left || right) ||
            !(above || below))
        {
            return 0;
        }
    }
    const float *first = view->across + own * (stride + 1);
    *across = left ? greatest(first - 1, 4, stride, 0.0f) : 0.0f;
    *across = right ? greatest(first, 4, stride, *across) : *across;
    *along = above ? greatest(view->along + own, 4, 1, 0.0f) : 0.0f;
    *along = below ? greatest(view->along + stride + own, 4, 1, *along) : *along;
    *alone = !(left && right && above && below);
    return 1;
}

static double sixth(const double *at, size_t apart)
{
    return (at[0] + at[6 * apart]) - 6.0 * (at[apart] + at[5 * apart]) +
           15.0 * (at[2 * apart] + at[4 * apart]) - 20.0 * at[3 * apart];
}

/* Of two differences of each line but the first and the last: from its first node on, and from its second. */
static double greatest_sixth(const cm_lattice_view *view, size_t apart, size_t next, int first,
                             int second)
{
    double most = 0.0;
    for (size_t i = 1; i < CM_LATTICE_SEEN - 1; i++)
    {
        for (size_t k = first ? 0 : 1; k < (second ? 2 : 1); k++)
        {
            const size_t at = i * next + k * apart;
            const double right = sixth(view->x + at, apart);
            const double down = sixth(view->y + at, apart);
            const double square = right * right + down * down;
            most = square > most ? square : most;
        }
    }
    return sqrt(most);
}

int cm_lattice_bend_wide(const cm_lattice_view *view, int is_uniform, double *across, double *along)
{
    const uint8_t plane = view->plane[0];
    if (!is_uniform &&
        (plane == CM_NO_FACE || !are_on(view, plane, 0, CM_LATTICE_SEEN, 0, CM_LATTICE_SEEN)))
    {
        return 0;
    }
    *across = greatest_sixth(view, 1, view->stride, 1, 1);
    *along = greatest_sixth(view, view->stride, 1, 1, 1);
    return 1;
}

int cm_lattice_bend_six(const cm_lattice_view *view, int is_uniform, double *across, double *along,
                        int *alone)
{
    int left = 1, right = 1, above = 1, below = 1;
    if (!is_uniform)
    {
        const uint8_t plane = view->plane[view->stride + 1];
        if (plane == CM_NO_FACE || !are_on(view, plane, 1, 6, 1, 6))
        {
            return 0;
        }
        left = are_on(view, plane, 1, 6, 0, 1);
        right = are_on(view, plane, 1, 6, 7, 1);
        above = are_on(view, plane, 0, 1, 1, 6);
        below = are_on(view, plane, 7, 1, 1, 6);
    }
    if (!(left || right) || !(above || below))
    {
        return 0;
    }
    *across = greatest_sixth(view, 1, view->stride, left, right);
    *along = greatest_sixth(view, view->stride, 1, above, below);
    *alone = !(left && right && above && below);
    return 1;
}
