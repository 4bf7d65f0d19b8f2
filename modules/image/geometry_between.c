/* SPDX-License-Identifier: MIT */
#include "geometry_between.h"

#include "patch.h"

#include <math.h>
#include <string.h>

/* What is between four nodes by a cubic is off by the fourth derivative, over 24 at most (de Boor, A practical guide to
 * splines, 1978, chapter II); half as much again for what differences do not see of it. Where derivatives jump between
 * nodes it is off by more of the differences: by so much where the second ones do, and the first. */
#define ERROR_SMOOTH (1.5 / 24.0)
#define ERROR_CREASED 0.17
#define ERROR_FOLDED 0.61

/* Differences of which part of the extent mean that first derivatives jump. */
#define FOLD 0.003

/* The most that weights of a cubic through four nodes add up to, between them. */
#define LEBESGUE 1.63

/* The same of a polynomial through six nodes, between the inner four: the sixth derivative over 142 at most, with more to
 * spare. Its weights add up to as much. */
#define ERROR_WIDE (2.0 / 142.0)

/* Derivatives of the cubic are off by a quarter of the fourth difference, in nodes, and so good as that. */
#define ERROR_SLOPE (1.5 * 3.0 / CM_BLOCK_EDGE / 4.0)
#define SLOPE_TOLERANCE 2.5e-3

/* A footprint, which is some of the target's pixels wide, is placed so many times the tolerance in one of these pixels. */
#define FOOTPRINT 4.0

/* Of cm_lattice_fine. */
#define BEYOND 2

void cm_between_begin(const cm_plan *plan, const cm_place_set *set, int derivatives,
                      cm_between *between)
{
    const double per_pixel = 3.0 / CM_BLOCK_EDGE;
    between->plan = plan;
    between->set = set;
    between->derivatives = derivatives;
    between->is_creased = plan->from->creased || plan->to->creased;
    cm_weigh_nodes(CM_BLOCK_NODES, 0.0, per_pixel, between->weights, between->slopes);
    cm_weigh_nodes(CM_WIDE_NODES, 1.0, per_pixel, between->wide, NULL);
    for (unsigned i = 0; i < CM_BLOCK_PIXELS; i++)
    {
        between->all_pixels[i] = (uint8_t)i;
    }
}

/* A block's own nodes, or those and the next ones around them, from its origin. */
typedef struct block_nodes
{
    double column; /* the origin, a whole number */
    double row;
    float x[CM_WIDE_NODES * CM_WIDE_NODES];
    float y[CM_WIDE_NODES * CM_WIDE_NODES];
    float low[2]; /* of x and y */
    float high[2];
} block_nodes;

/* Towards zero, for what an int32_t can have. */
static double whole(double x)
{
    return (double)(int32_t)x;
}

static void bounds_of(const float *value, size_t n, float *low, float *high)
{
    *low = *high = value[0];
    for (size_t i = 1; i < n; i++)
    {
        *low = value[i] < *low ? value[i] : *low;
        *high = value[i] > *high ? value[i] : *high;
    }
}

/* The origin is a whole number near the middle. */
static void begin_nodes(const cm_lattice_view *view, block_nodes *nodes)
{
    const size_t inner = (BEYOND + 1) * (view->stride + 1);
    nodes->column = whole(view->x[inner]);
    nodes->row = whole(view->y[inner]);
}

/* Places are subtracted in double and go on as floats. */
static void take_nodes(const cm_place_set *set, const cm_lattice_view *view, block_nodes *nodes)
{
    const size_t first = BEYOND * (view->stride + 1);
    begin_nodes(view, nodes);
    set->take(view->x + first, view->stride, nodes->column + 0.5, nodes->x, &nodes->low[0],
              &nodes->high[0]);
    set->take(view->y + first, view->stride, nodes->row + 0.5, nodes->y, &nodes->low[1],
              &nodes->high[1]);
}

static void take_wide_nodes(const cm_lattice_view *view, block_nodes *nodes)
{
    const size_t count = CM_WIDE_NODES;
    const size_t first = (BEYOND - 1) * (view->stride + 1);
    begin_nodes(view, nodes);
    for (size_t r = 0; r < count; r++)
    {
        const double *x = view->x + first + r * view->stride;
        const double *y = view->y + first + r * view->stride;
        for (size_t k = 0; k < count; k++)
        {
            nodes->x[count * r + k] = (float)(x[k] - (nodes->column + 0.5));
            nodes->y[count * r + k] = (float)(y[k] - (nodes->row + 0.5));
        }
    }
    bounds_of(nodes->x, count * count, &nodes->low[0], &nodes->high[0]);
    bounds_of(nodes->y, count * count, &nodes->low[1], &nodes->high[1]);
}

static double extent_of(const block_nodes *nodes)
{
    const float width = nodes->high[0] - nodes->low[0];
    const float height = nodes->high[1] - nodes->low[1];
    return (double)(width > height ? width : height);
}

/* What floats round of places. */
static double rounded(double extent)
{
    return extent / 4194304.0;
}

/* Is the polynomial as near to the truth as is asked, and its derivative? */
static int is_near(const cm_between *between, float across, float along, int alone,
                   const block_nodes *nodes)
{
    const double extent = extent_of(nodes);
    const double bend = sqrt((double)across) + LEBESGUE * sqrt((double)along);
    double factor = alone ? 2.0 * ERROR_SMOOTH : ERROR_SMOOTH;
    if (between->is_creased)
    {
        factor = alone ? INFINITY : bend > FOLD * extent ? ERROR_FOLDED : ERROR_CREASED;
    }
    const double error = factor * bend + rounded(extent);
    if (!between->derivatives)
    {
        return error <= between->plan->options.tolerance;
    }
    const double pixel = extent / CM_BLOCK_EDGE;
    return error <= between->plan->options.tolerance * fmax(FOOTPRINT * pixel, 1.0) &&
           ERROR_SLOPE * bend <= SLOPE_TOLERANCE * pixel;
}

/* The same of the polynomial through six nodes each way. */
static int is_near_wide(const cm_between *between, const cm_lattice_view *view, int is_uniform,
                        block_nodes *nodes)
{
    double across, along;
    if (between->is_creased || between->derivatives ||
        !cm_lattice_bend_wide(view, is_uniform, &across, &along))
    {
        return 0;
    }
    take_wide_nodes(view, nodes);
    return ERROR_WIDE * (across + LEBESGUE * along) + rounded(extent_of(nodes)) <=
           between->plan->options.tolerance;
}

/* May places between the nodes be beyond the source's plane? */
static int is_inside(const cm_surface *from, const block_nodes *nodes, double slack)
{
    const double extent[2] = {from->width, from->height};
    const double origin[2] = {nodes->column + 0.5, nodes->row + 0.5};
    for (int k = 0; k < 2; k++)
    {
        /* the weights of both ways add up to so much, and half of it is within the bounds */
        const double more =
            0.5 * (LEBESGUE * LEBESGUE - 1.0) * (nodes->high[k] - nodes->low[k]) - slack;
        if (origin[k] + nodes->low[k] < more || origin[k] + nodes->high[k] > extent[k] - more)
        {
            return 0;
        }
    }
    return 1;
}

static void interpolate(const cm_between *between, const block_nodes *nodes, cm_group *group)
{
    cm_placer *place = between->set->place;
    const cm_place_weights *weights = &between->weights;
    const cm_place_weights *slopes = &between->slopes;
    place(nodes->x, weights, weights, group->x);
    place(nodes->y, weights, weights, group->y);
    if (between->derivatives)
    {
        place(nodes->x, slopes, weights, group->by_column[0]);
        place(nodes->y, slopes, weights, group->by_column[1]);
        place(nodes->x, weights, slopes, group->by_row[0]);
        place(nodes->y, weights, slopes, group->by_row[1]);
    }
}

/* What a cubic through nodes reaches at most. */
static void bound(const block_nodes *nodes, cm_group *group)
{
    group->is_bounded = 1;
    for (int k = 0; k < 2; k++)
    {
        /* the weights of both ways add up to so much, and half of it is within the nodes */
        const float extent = nodes->high[k] - nodes->low[k];
        const float more = (float)(0.5 * (LEBESGUE * LEBESGUE - 1.0) + 1e-3) * extent + 1e-3f;
        group->low[k] = nodes->low[k] - more;
        group->high[k] = nodes->high[k] + more;
    }
}

static void interpolate_wide(const cm_between *between, const block_nodes *nodes, cm_group *group)
{
    const cm_wide_weights *weights = &between->wide;
    group->is_bounded = 1;
    for (int k = 0; k < 2; k++)
    {
        between->set->place_wide(k == 0 ? nodes->x : nodes->y, weights, weights,
                                 k == 0 ? group->x : group->y, &group->low[k], &group->high[k]);
    }
}

/* What all places of a block of one group reach. */
static void bound_places(const cm_between *between, cm_group *group)
{
    float bounds[4];
    between->set->bounds(CM_BLOCK_PIXELS, group->x, group->y, bounds);
    group->is_bounded = 1;
    for (int k = 0; k < 2; k++)
    {
        group->low[k] = bounds[2 * k];
        group->high[k] = bounds[2 * k + 1];
    }
}

cm_between_found cm_between_block(const cm_between *between, const cm_lattice_view *view,
                                  int is_uniform, double slack, cm_group *group)
{
    block_nodes nodes;
    float across, along;
    int alone;
    if (!cm_lattice_bend(view, is_uniform, &across, &along, &alone))
    {
        return CM_BETWEEN_NONE;
    }
    take_nodes(between->set, view, &nodes);
    const int is_wide = !is_near(between, across, along, alone, &nodes);
    if (is_wide && !is_near_wide(between, view, is_uniform, &nodes))
    {
        return CM_BETWEEN_NONE;
    }
    cm_group_begin(group, view->plane[BEYOND * (view->stride + 1)], nodes.column, nodes.row);
    group->count = CM_BLOCK_PIXELS;
    group->pixel = between->all_pixels;
    (is_wide ? interpolate_wide : interpolate)(between, &nodes, group);
    if (is_wide)
    {
        return CM_BETWEEN_ANYWHERE;
    }
    if (is_inside(between->plan->from, &nodes, slack))
    {
        bound(&nodes, group);
        return CM_BETWEEN_INSIDE;
    }
    bound_places(between, group);
    return CM_BETWEEN_ANYWHERE;
}
