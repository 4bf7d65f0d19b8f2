/* SPDX-License-Identifier: MIT
 *
 * What the sphere has beyond the edges of planes of floats. Directions beyond an edge are a polynomial through points
 * inside of it, as in surface_beyond.c, which rows of the border share; values are those of border_values.c.
 */
#include "border_values.h"
#include "large_memory.h"

#include <cubemap/threads.h>

#include <math.h>

/* Pixels along an edge that are done together. */
#define BLOCK CM_BORDER_RUN

/* Points of the polynomial of directions. */
#define NODES CM_EDGE_NODES

/* A task is a block of one side of a plane, or one corner. */
typedef enum side
{
    ABOVE,
    BELOW,
    LEFT,
    RIGHT,
    CORNERS
} side;

/* A row of the border may have the pixels of one of the plane, so many columns further. */
typedef struct row_copy
{
    int is_there;
    int32_t further;
    int32_t same;
} row_copy;

typedef struct border_job
{
    cm_border_values values;
    size_t blocks[4];    /* of each side */
    size_t per_plane;    /* tasks */
    unsigned plane;      /* the first one */
    double node_step[2]; /* pixels from a node to the next */
    double weight[2][CM_BORDER_MOST][NODES];
    row_copy *copy; /* of the rows above and below: which others they are */
} border_job;

/* ---- directions ---- */

/* A run of a row whose pixels are those of another. */
static int copy_run(const border_job *job, unsigned plane, int32_t column, int32_t row,
                    int32_t right, size_t n)
{
    const cm_padded *padded = job->values.padded;
    const row_copy *copy =
        &job->copy[row < 0 ? row + padded->beyond : row - (int32_t)padded->height + padded->beyond];
    if (!copy->is_there)
    {
        return 0;
    }
    const int32_t first = right < 0 ? column - (int32_t)(n - 1) : column;
    cm_border_copy(padded, plane, first, (int32_t)n, row, copy->further, copy->same);
    return 1;
}

/* A run whose directions the surface itself can tell, or surface_beyond.c one by one. */
static void ask_run(const border_job *job, unsigned plane, int32_t column, int32_t row,
                    int32_t right, int32_t down, size_t n)
{
    double columns[BLOCK], rows[BLOCK], x[BLOCK], y[BLOCK], z[BLOCK];
    if (down == 0 && copy_run(job, plane, column, row, right, n))
    {
        return;
    }
    for (size_t i = 0; i < n; i++)
    {
        columns[i] = (column + (int32_t)i * right + 0.5) * job->values.scale[0];
        rows[i] = (row + (int32_t)i * down + 0.5) * job->values.scale[1];
    }
    cm_surface_directions_spaced(job->values.surface, plane, job->values.scale, n, columns, rows, x,
                                 y, z);
    cm_border_put(&job->values, plane, column, row, right, down, n, x, y, z);
}

/* The sum of nodes, which lie `stride` apart. */
static double weighted(const double *weight, const double *value, size_t stride)
{
    double sum = 0.0;
    for (size_t i = 0; i < NODES; i++)
    {
        sum += weight[i] * value[i * stride];
    }
    return sum;
}

/* Where node k of a side's polynomials lies: from the edge inwards. */
static double node_place(const border_job *job, int is_low, int way, int k)
{
    const double extent = way == 0 ? job->values.padded->width : job->values.padded->height;
    const double inwards = k * job->node_step[way];
    return is_low ? inwards : extent - inwards;
}

/* Directions of NODES rows of n nodes each: those of `along` are every pixel's centres from `begin` on. */
static void side_nodes(const border_job *job, unsigned plane, side where, int32_t begin, size_t n,
                       double direction[3][NODES * BLOCK])
{
    double columns[NODES * BLOCK], rows[NODES * BLOCK];
    const int is_row = where == ABOVE || where == BELOW;
    double *const along = is_row ? columns : rows;
    double *const across = is_row ? rows : columns;
    for (size_t k = 0; k < NODES; k++)
    {
        const double place = node_place(job, where == ABOVE || where == LEFT, is_row, (int)k);
        for (size_t i = 0; i < n; i++)
        {
            along[k * n + i] = (begin + (double)i + 0.5) * job->values.scale[!is_row];
            across[k * n + i] = place * job->values.scale[is_row];
        }
    }
    cm_surface_own_directions(job->values.surface, plane, NODES * n, columns, rows, direction[0],
                              direction[1], direction[2]);
}

/* A block of a side, by polynomials that its pixels of one column, or row, share. */
static void extrapolate_block(const border_job *job, unsigned plane, side where, int32_t begin,
                              size_t n)
{
    const cm_padded *padded = job->values.padded;
    const int is_row = where == ABOVE || where == BELOW;
    const int32_t depth = is_row ? padded->beyond : padded->beside;
    double node[3][NODES * BLOCK];
    side_nodes(job, plane, where, begin, n, node);
    for (int32_t k = 0; k < depth; k++)
    {
        double x[3][BLOCK];
        const double *weight = job->weight[is_row][k];
        for (int axis = 0; axis < 3; axis++)
        {
            job->values.set->sum_nodes(weight, node[axis], n, x[axis]);
        }
        const int32_t across = where == ABOVE || where == LEFT ? -1 - k
                               : is_row                        ? (int32_t)padded->height + k
                                                               : (int32_t)padded->width + k;
        cm_border_put(&job->values, plane, is_row ? begin : across, is_row ? across : begin, is_row,
                      !is_row, n, x[0], x[1], x[2]);
    }
}

/* A corner, by polynomials both ways. */
static void extrapolate_corner(const border_job *job, unsigned plane, int is_left, int is_upper)
{
    const cm_padded *padded = job->values.padded;
    double columns[NODES * NODES], rows[NODES * NODES], node[3][NODES * NODES];
    for (int i = 0; i < NODES * NODES; i++)
    {
        columns[i] = node_place(job, is_left, 0, i % NODES) * job->values.scale[0];
        rows[i] = node_place(job, is_upper, 1, i / NODES) * job->values.scale[1];
    }
    cm_surface_own_directions(job->values.surface, plane, (size_t)NODES * NODES, columns, rows,
                              node[0], node[1], node[2]);
    for (int32_t k = 0; k < padded->beyond; k++)
    {
        double line[3][NODES];
        for (int i = 0; i < 3 * NODES; i++)
        {
            line[i / NODES][i % NODES] =
                weighted(job->weight[1][k], node[i / NODES] + i % NODES, NODES);
        }
        const int32_t row = is_upper ? -1 - k : (int32_t)padded->height + k;
        for (int32_t begin = 0; begin < padded->beside; begin += BLOCK)
        {
            double x[3][BLOCK];
            const int32_t left = padded->beside - begin;
            const size_t n = (size_t)(left < BLOCK ? left : BLOCK);
            for (size_t i = 0; i < n; i++)
            {
                const double *weight = job->weight[0][begin + (int32_t)i];
                for (int axis = 0; axis < 3; axis++)
                {
                    x[axis][i] = weighted(weight, line[axis], 1);
                }
            }
            cm_border_put(&job->values, plane,
                          is_left ? -1 - begin : (int32_t)padded->width + begin, row,
                          is_left ? -1 : 1, 0, n, x[0], x[1], x[2]);
        }
    }
}

/* ---- tasks ---- */

/* Columns that come again after a period are copies. */
static void repeat_columns(const cm_padded *padded, unsigned plane, int32_t row, int is_left)
{
    cm_border_copy(padded, plane, is_left ? -padded->beside : (int32_t)padded->width,
                   padded->beside, row, 0, row);
}

/* Can the block's polynomials do without crossing a crease, which are on diagonals? */
static int is_smooth(const border_job *job, int way, int32_t begin, size_t n)
{
    const cm_padded *padded = job->values.padded;
    const int32_t extent = (int32_t)(way == 1 ? padded->width : padded->height);
    const double room = fmin(begin + 0.5, extent - (begin + (double)n) + 0.5);
    return !job->values.surface->creased || room >= (NODES - 1) * job->node_step[way];
}

static void do_side(const border_job *job, unsigned plane, side where, size_t block)
{
    const cm_padded *padded = job->values.padded;
    const int is_row = where == ABOVE || where == BELOW;
    const int32_t extent = (int32_t)(is_row ? padded->width : padded->height);
    const int32_t begin = (int32_t)block * BLOCK;
    const size_t n = (size_t)(extent - begin < BLOCK ? extent - begin : BLOCK);
    const int way = is_row ? 1 : 0;
    const int32_t depth = is_row ? padded->beyond : padded->beside;
    if (!is_row && job->values.surface->period == (double)job->values.surface->width)
    {
        for (size_t i = 0; i < n; i++)
        {
            repeat_columns(padded, plane, begin + (int32_t)i, where == LEFT);
        }
    }
    else if (!job->values.surface->methods->can_go_beyond && job->node_step[way] > 0.0 &&
             is_smooth(job, way, begin, n))
    {
        extrapolate_block(job, plane, where, begin, n);
    }
    else
    {
        for (int32_t k = 0; k < depth; k++)
        {
            const int32_t across = where == ABOVE || where == LEFT ? -1 - k
                                   : is_row                        ? (int32_t)padded->height + k
                                                                   : (int32_t)padded->width + k;
            ask_run(job, plane, is_row ? begin : across, is_row ? across : begin, is_row, !is_row,
                    n);
        }
    }
}

static void do_corner(const border_job *job, unsigned plane, int is_left, int is_upper)
{
    const cm_padded *padded = job->values.padded;
    if (!job->values.surface->methods->can_go_beyond && !job->values.surface->creased &&
        job->node_step[0] > 0.0 && job->node_step[1] > 0.0)
    {
        extrapolate_corner(job, plane, is_left, is_upper);
        return;
    }
    for (int32_t k = 0; k < padded->beyond; k++)
    {
        const int32_t row = is_upper ? -1 - k : (int32_t)padded->height + k;
        for (int32_t begin = 0; begin < padded->beside; begin += BLOCK)
        {
            const int32_t left = padded->beside - begin;
            ask_run(job, plane, is_left ? -1 - begin : (int32_t)padded->width + begin, row,
                    is_left ? -1 : 1, 0, (size_t)(left < BLOCK ? left : BLOCK));
        }
    }
}

static void do_tasks(size_t begin, size_t end, void *user)
{
    const border_job *job = user;
    for (size_t at = begin / CM_TASK; at < end / CM_TASK; at++)
    {
        const unsigned plane = job->plane + (unsigned)(at / job->per_plane);
        size_t task = at % job->per_plane;
        int where = ABOVE;
        while (where < CORNERS && task >= job->blocks[where])
        {
            task -= job->blocks[where++];
        }
        if (where < CORNERS)
        {
            do_side(job, plane, (side)where, task);
        }
        else
        {
            do_corner(job, plane, task % 2 == 0, task < 2);
        }
        cm_large_touched(job->values.padded->owner, BLOCK * CM_TOUCHED_AROUND);
    }
}

/* Nodes are spread over some of the plane where the border is wide, so that what rounding leaves of them is not
 * magnified more than it must. */
static void prepare_nodes(border_job *job, int way, int32_t depth, uint32_t extent)
{
    const double most = floor(((double)extent - 1.0) / (NODES - 1));
    const double wanted = fmax(floor(depth / 8.0), 1.0);
    const double step = fmin(wanted, most);
    job->node_step[way] = step;
    for (int32_t k = 0; k < depth && step > 0.0; k++)
    {
        for (int i = 0; i < NODES; i++)
        {
            double product = 1.0;
            for (int other = 0; other < NODES; other++)
            {
                product *= other == i ? 1.0 : (-(k + 0.5) / step - other) / ((double)i - other);
            }
            job->weight[way][k][i] = product;
        }
    }
}

static void do_planes(border_job *job, unsigned planes, unsigned threads)
{
    const cm_padded *padded = job->values.padded;
    const cm_surface *surface = job->values.surface;
    job->values.scale[0] = (double)surface->width / padded->width;
    job->values.scale[1] = (double)surface->height / padded->height;
    job->blocks[ABOVE] = job->blocks[BELOW] =
        padded->beyond > 0 ? (padded->width + (size_t)BLOCK - 1) / BLOCK : 0;
    job->blocks[LEFT] = job->blocks[RIGHT] =
        padded->beside > 0 ? (padded->height + (size_t)BLOCK - 1) / BLOCK : 0;
    job->per_plane = 2 * (job->blocks[ABOVE] + job->blocks[LEFT]) + 4;
    if (!surface->methods->can_go_beyond)
    {
        prepare_nodes(job, 0, padded->beside, padded->width);
        prepare_nodes(job, 1, padded->beyond, padded->height);
    }
    row_copy copy[2 * CM_BORDER_MOST];
    job->copy = copy;
    for (int32_t k = 0; k < 2 * padded->beyond; k++)
    {
        const int32_t row =
            k < padded->beyond ? k - padded->beyond : (int32_t)padded->height + k - padded->beyond;
        copy[k].is_there =
            cm_surface_same_row(surface, job->values.scale, row, &copy[k].further, &copy[k].same);
    }
    cm_run_threads(threads, planes * job->per_plane * CM_TASK, 2 * CM_TASK, do_tasks, job);
}

void cm_padded_border(const cm_padded *padded, const cm_surface *surface, const cm_filter_set *set,
                      unsigned threads)
{
    border_job job = {.values = {.padded = padded, .surface = surface, .set = set}};
    do_planes(&job, padded->planes, threads);
}

void cm_padded_border_alone(const cm_padded *shape, const cm_surface *surface,
                            const cm_filter_set *set, const cm_level_reader *reader, unsigned plane,
                            const cm_padded parts[CM_BORDER_SIDES], unsigned threads)
{
    border_job job = {.values = {.padded = shape,
                                 .surface = surface,
                                 .set = set,
                                 .reader = reader,
                                 .side = parts},
                      .plane = plane};
    do_planes(&job, 1, threads);
}
