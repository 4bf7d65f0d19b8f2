/* SPDX-License-Identifier: MIT
 *
 * Planes that go on beyond their edges: what a filter's footprint reaches there is on a neighbour, in directions that
 * continue those inside smoothly. They are polynomials through the centres of the last pixels before the edge, so
 * that no kind needs formulas for what is outside of it.
 */
#include "surface_object.h"

#include <math.h>
#include <string.h>

/* Points of a polynomial, from the edge inwards: a pixel apart, or what is taken for one. */
#define NODES CM_EDGE_NODES

/* Places that are done at once, and nodes for them: neighbours along a line that leaves the plane share theirs. */
#define PLACES 64
#define NODES_MOST 512

/* Distances from an edge whose weights are kept. */
#define DISTANCES 16

/* How a coordinate comes from those of nodes: itself, if it is on the plane. */
typedef struct nodes
{
    unsigned count;
    double first;
    double step;     /* from node to node */
    double distance; /* in steps, from the first node outwards; 0: on the plane */
} nodes;

/* Weights for a distance from the edge. */
typedef struct weights
{
    unsigned count;
    double distance;
    double weight[NODES];
} weights;

typedef struct weight_table
{
    unsigned used;
    unsigned
        next; /* likely the one that is asked for, since lines have the same distances in turn */
    weights at[DISTANCES];
} weight_table;

/* What is under way. */
typedef struct work
{
    const cm_surface *surface;
    unsigned plane;
    double spacing[2];
    unsigned places;
    unsigned count; /* of nodes */
    nodes right[PLACES];
    nodes down[PLACES];
    unsigned first[PLACES]; /* of a place's nodes, by rows */
    double column[NODES_MOST];
    double row[NODES_MOST];
    double axis[3][NODES_MOST];
    weight_table table;
} work;

/* Lagrange's weights of nodes 0, 1, ..., for what is that far before the first. */
static void weigh(unsigned count, double distance, weights *at)
{
    at->count = count;
    at->distance = distance;
    for (unsigned i = 0; i < count; i++)
    {
        at->weight[i] = 1.0;
        for (unsigned k = 0; k < count; k++)
        {
            at->weight[i] *= k == i ? 1.0 : (-distance - k) / ((double)i - k);
        }
    }
}

/* From the table, which begins anew when it is full. */
static const double *weights_of(weight_table *table, const nodes *at)
{
    for (unsigned k = 0; k < table->used; k++)
    {
        const unsigned i =
            table->next + k < table->used ? table->next + k : table->next + k - table->used;
        if (table->at[i].distance == at->distance && table->at[i].count == at->count)
        {
            table->next = i + 1 < table->used ? i + 1 : 0;
            return table->at[i].weight;
        }
    }
    table->used = table->used == DISTANCES ? 0 : table->used;
    table->next = 0;
    weights *made = &table->at[table->used++];
    weigh(at->count, at->distance, made);
    return made->weight;
}

/* room is how far it is to a crease. */
static void find_nodes(double place, double extent, double room, double spacing, nodes *found)
{
    if (place >= 0.0 && place <= extent)
    {
        *found = (nodes){.count = 1, .first = place};
        return;
    }
    const double least = (room < extent ? room : extent) / spacing;
    const double most = least < NODES ? least : NODES;
    const int is_before = place < 0.0;
    found->count = most >= 1.0 ? (unsigned)most : 1;
    found->first = is_before ? 0.0 : extent;
    found->step = is_before ? spacing : -spacing;
    found->distance = (is_before ? -place : place - extent) / spacing;
}

static int are_same(const nodes *a, const nodes *b)
{
    return a->count == b->count && a->first == b->first && a->step == b->step;
}

/* The distance to the nearest corner, along an edge that goes from 0 to extent. */
static double to_corner(double along, double extent)
{
    return fmax(fmin(along, extent - along), 0.0);
}

/* How far nodes are from the first. */
static const double ordinal[NODES] = {0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0};

/* By rows. */
static void put_nodes(const nodes *right, const nodes *down, double *restrict column,
                      double *restrict row)
{
    const nodes across = *right;
    for (unsigned j = 0; j < down->count; j++, column += across.count, row += across.count)
    {
        const double line = down->first + down->step * ordinal[j];
        for (unsigned k = 0; k < across.count; k++)
        {
            column[k] = across.first + across.step * ordinal[k];
            row[k] = line;
        }
    }
}

/* Takes a place, or leaves it for the next time: 0. */
static int take_place(work *at, double column, double row)
{
    const cm_surface *surface = at->surface;
    const double width = surface->width;
    const double height = surface->height;
    const unsigned i = at->places;
    if (i == PLACES)
    {
        return 0;
    }
    nodes *right = &at->right[i];
    nodes *down = &at->down[i];
    /* creases are on diagonals, so that there are as many pixels before one as to the corner */
    find_nodes(column, width, surface->creased ? to_corner(row, height) : width, at->spacing[0],
               right);
    find_nodes(row, height, surface->creased ? to_corner(column, width) : height, at->spacing[1],
               down);
    const int has_nodes =
        i > 0 && are_same(&at->right[i - 1], right) && are_same(&at->down[i - 1], down);
    if (!has_nodes && at->count + right->count * down->count > NODES_MOST)
    {
        return 0;
    }
    at->first[i] = has_nodes ? at->first[i - 1] : at->count;
    at->places++;
    if (!has_nodes)
    {
        put_nodes(right, down, at->column + at->count, at->row + at->count);
        at->count += right->count * down->count;
    }
    return 1;
}

/* The three axes, by rows of nodes, and then by their columns. */
static void sum_nodes(const work *at, unsigned place, const double *across, const double *along,
                      double sum[3])
{
    unsigned node = at->first[place];
    sum[0] = sum[1] = sum[2] = 0.0;
    for (unsigned j = 0; j < at->down[place].count; j++)
    {
        for (unsigned i = 0; i < at->right[place].count; i++, node++)
        {
            const double weight = along[j] * across[i];
            sum[0] += weight * at->axis[0][node];
            sum[1] += weight * at->axis[1][node];
            sum[2] += weight * at->axis[2][node];
        }
    }
}

static void finish(work *at, double *x, double *y, double *z)
{
    static const double one = 1.0;
    cm_surface_own_directions(at->surface, at->plane, at->count, at->column, at->row, at->axis[0],
                              at->axis[1], at->axis[2]);
    for (unsigned i = 0; i < at->places; i++)
    {
        const nodes *right = &at->right[i];
        const nodes *down = &at->down[i];
        double along[NODES];
        const double *found = down->distance == 0.0 ? &one : weights_of(&at->table, down);
        /* a copy, since the table may begin anew */
        memcpy(along, found, down->count * sizeof *along);
        const double *across = right->distance == 0.0 ? &one : weights_of(&at->table, right);
        double sum[3];
        sum_nodes(at, i, across, along, sum);
        x[i] = sum[0];
        y[i] = sum[1];
        z[i] = sum[2];
    }
    at->places = 0;
    at->count = 0;
}

void cm_surface_directions_spaced(const cm_surface *surface, unsigned plane,
                                  const double spacing[2], size_t n, const double *column,
                                  const double *row, double *x, double *y, double *z)
{
    if (surface->methods->can_go_beyond)
    {
        cm_surface_own_directions(surface, plane, n, column, row, x, y, z);
        return;
    }
    work at;
    at.surface = surface;
    at.plane = plane;
    at.spacing[0] = spacing[0];
    at.spacing[1] = spacing[1];
    at.places = at.count = at.table.used = at.table.next = 0;
    size_t done = 0;
    for (size_t i = 0; i < n;)
    {
        if (take_place(&at, column[i], row[i]))
        {
            i++;
            continue;
        }
        finish(&at, x + done, y + done, z + done);
        done = i;
    }
    finish(&at, x + done, y + done, z + done);
}

void cm_surface_directions_beyond(const cm_surface *surface, unsigned plane, size_t n,
                                  const double *column, const double *row, double *x, double *y,
                                  double *z)
{
    const double pixel[2] = {1.0, 1.0};
    cm_surface_directions_spaced(surface, plane, pixel, n, column, row, x, y, z);
}

int cm_surface_edge_nodes(const cm_surface *surface, unsigned plane, cm_edge edge, int32_t begin,
                          size_t count, cm_edge_run *run)
{
    const int is_row = edge == CM_EDGE_UPPER || edge == CM_EDGE_LOWER;
    const double across = is_row ? surface->height : surface->width;
    const double along = is_row ? surface->width : surface->height;
    const double first = edge == CM_EDGE_LEFT || edge == CM_EDGE_UPPER ? 0.0 : across;
    const double step = first == 0.0 ? 1.0 : -1.0;
    /* as find_nodes has it, of the pixel that is nearest to a corner */
    const double corner =
        fmin(to_corner(begin + 0.5, along), to_corner(begin + (double)count - 0.5, along));
    const double room = surface->creased ? fmin(corner, across) : across;
    double column[NODES * CM_EDGE_RUN], row[NODES * CM_EDGE_RUN];
    if (surface->methods->can_go_beyond || count > CM_EDGE_RUN || room < NODES)
    {
        return 0;
    }
    run->count = count;
    double *const centre = is_row ? column : row;
    double *const node = is_row ? row : column;
    for (size_t k = 0; k < NODES; k++)
    {
        for (size_t i = 0; i < count; i++)
        {
            centre[k * count + i] = begin + (double)i + 0.5;
            node[k * count + i] = first + step * ordinal[k];
        }
    }
    cm_surface_own_directions(surface, plane, NODES * count, column, row, run->node[0],
                              run->node[1], run->node[2]);
    return 1;
}

void cm_surface_edge_directions(const cm_edge_run *run, const cm_filter_set *set, int32_t away,
                                double *x, double *y, double *z)
{
    weights at;
    weigh(NODES, away + 0.5, &at);
    set->sum_nodes(at.weight, run->node[0], run->count, x);
    set->sum_nodes(at.weight, run->node[1], run->count, y);
    set->sum_nodes(at.weight, run->node[2], run->count, z);
}

/* Columns that come again are meridians as far from one another, and rows are parallels: one pixel tells of all. */
int cm_surface_same_row(const cm_surface *surface, const double spacing[2], int32_t row,
                        int32_t *further, int32_t *same)
{
    const double near = 1e-6;
    const double column = 0.5 * spacing[0];
    const double line = (row + 0.5) * spacing[1];
    double x, y, z;
    uint8_t found;
    if (surface->period == 0.0 || surface->planes != 1)
    {
        return 0;
    }
    cm_surface_directions_spaced(surface, 0, spacing, 1, &column, &line, &x, &y, &z);
    cm_surface_find(surface, 1, &x, &y, &z, &found, &x, &y);
    if (found == CM_NO_FACE)
    {
        return 0;
    }
    x = x / spacing[0] - 0.5;
    y = y / spacing[1] - 0.5;
    *further = (int32_t)(x + 0.5);
    *same = (int32_t)(y + 0.5);
    return fabs(x - *further) < near && fabs(y - *same) < near;
}
