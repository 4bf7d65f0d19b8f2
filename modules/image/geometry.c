/* SPDX-License-Identifier: MIT
 *
 * Blocks of pixels between nodes, where that is as exact as is asked, and pixel by pixel elsewhere.
 */
#include "geometry.h"

#include "patch.h"

#include <math.h>
#include <stdlib.h>
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
#define LATTICE_BLOCKS 8

/* Lattices that are kept, each for its columns, from a row of blocks to the next. */
#define LATTICES_MOST 128

/* Steps of differences for derivatives, in pixels. */
#define STEP (1.0 / 4096.0)

/* No pixel is wider on a source that goes round, of its whole width: footprints reach twice it each way. */
#define POLE_MOST 0.5

/* Places so far beyond a plane are still its own: filters reach beyond its edges. */
#define SLACK_MOST 0.25

struct cm_geometry
{
    const cm_plan *plan;
    const cm_place_set *set;
    int derivatives;
    int is_creased;
    cm_geometry_count count;
    cm_place_weights weights;
    cm_place_weights slopes; /* of weights, in pixels */
    cm_wide_weights wide;
    uint8_t all_pixels[CM_BLOCK_PIXELS]; /* 0, 1, ... */
    uint32_t lattices;
    cm_lattice *lattice;
    cm_patches *patches; /* NULL: there are none */
};

/* ---- life ---- */

static uint32_t blocks_of(uint32_t pixels)
{
    return (pixels + CM_BLOCK_EDGE - 1) / CM_BLOCK_EDGE;
}

cm_geometry *cm_geometry_create(const cm_plan *plan, int derivatives)
{
    cm_geometry *made = calloc(1, sizeof *made);
    if (made == NULL)
    {
        return NULL;
    }
    const uint32_t chunks = (blocks_of(plan->to->width) + LATTICE_BLOCKS - 1) / LATTICE_BLOCKS;
    made->plan = plan;
    made->set = cm_place_set_find(plan->options.instructions);
    made->derivatives = derivatives;
    made->is_creased = plan->from->creased || plan->to->creased;
    const double per_pixel = 3.0 / CM_BLOCK_EDGE;
    cm_weigh_nodes(CM_BLOCK_NODES, 0.0, per_pixel, made->weights, made->slopes);
    cm_weigh_nodes(CM_WIDE_NODES, 1.0, per_pixel, made->wide, NULL);
    for (unsigned i = 0; i < CM_BLOCK_PIXELS; i++)
    {
        made->all_pixels[i] = (uint8_t)i;
    }
    made->lattices = chunks < LATTICES_MOST ? chunks : LATTICES_MOST;
    made->lattice = calloc(made->lattices, sizeof *made->lattice);
    for (uint32_t i = 0; made->lattice != NULL && i < made->lattices; i++)
    {
        made->lattice[i].shape = &cm_lattice_fine;
    }
    const int has_patches = !derivatives && !made->is_creased;
    made->patches = has_patches ? cm_patches_create(plan, made->set) : NULL;
    if (made->lattice == NULL || made->set == NULL || (has_patches && made->patches == NULL))
    {
        cm_geometry_destroy(made);
        return NULL;
    }
    return made;
}

void cm_geometry_destroy(cm_geometry *geometry)
{
    if (geometry != NULL)
    {
        cm_patches_destroy(geometry->patches);
        free(geometry->lattice);
        free(geometry);
    }
}

cm_geometry_count cm_geometry_counted(const cm_geometry *geometry)
{
    return geometry->count;
}

/* ---- exact blocks ---- */

/* Pixels of a block that the target's plane has. */
typedef struct block_places
{
    unsigned plane;
    unsigned count;
    uint8_t pixel[CM_BLOCK_PIXELS];
    double column[CM_BLOCK_PIXELS];
    double row[CM_BLOCK_PIXELS];
    uint8_t found[CM_BLOCK_PIXELS];
    double x[CM_BLOCK_PIXELS];
    double y[CM_BLOCK_PIXELS];
} block_places;

static void place_block(const cm_surface *to, unsigned plane, uint32_t block_column,
                        uint32_t block_row, block_places *at)
{
    const double left = (double)block_column * CM_BLOCK_EDGE + 0.5;
    const double top = (double)block_row * CM_BLOCK_EDGE + 0.5;
    const unsigned columns = (unsigned)fmin(to->width + 0.5 - left, CM_BLOCK_EDGE);
    const unsigned rows = (unsigned)fmin(to->height + 0.5 - top, CM_BLOCK_EDGE);
    unsigned n = 0;
    at->plane = plane;
    for (unsigned r = 0; r < rows; r++)
    {
        for (unsigned k = 0; k < columns; k++, n++)
        {
            at->column[n] = left + k;
            at->row[n] = top + r;
            at->pixel[n] = (uint8_t)(r * CM_BLOCK_EDGE + k);
        }
    }
    at->count = n;
}

/* Do places lie on both sides of where columns begin again? */
static int is_wrapped(const block_places *at, double period)
{
    double low = INFINITY;
    double high = -INFINITY;
    for (unsigned i = 0; i < at->count && period > 0.0; i++)
    {
        low = at->x[i] < low ? at->x[i] : low;
        high = at->x[i] > high ? at->x[i] : high;
    }
    return period > 0.0 && high - low > 0.5 * period;
}

/* The origin is the first pixel's. */
static void begin_group(cm_group *group, uint8_t plane, double x, double y)
{
    group->plane = plane;
    group->count = 0;
    group->pixel = group->own_pixel;
    group->is_bounded = 0;
    group->column = (int32_t)x;
    group->row = (int32_t)y;
}

/* The one group of places that are all on one plane. */
static void group_all(const block_places *at, cm_group *group)
{
    begin_group(group, at->found[0], at->x[0], at->y[0]);
    const double column = group->column + 0.5;
    const double row = group->row + 0.5;
    for (unsigned i = 0; i < at->count; i++)
    {
        group->x[i] = (float)(at->x[i] - column);
        group->y[i] = (float)(at->y[i] - row);
    }
    memcpy(group->own_pixel, at->pixel, at->count);
    group->count = at->count;
}

static unsigned group_places(const cm_plan *plan, const block_places *at, cm_group *groups,
                             uint8_t *group_of)
{
    uint8_t used_by[CM_PLANES_MAX + 1];
    const double half = is_wrapped(at, plan->from->period) ? 0.5 * plan->from->period : INFINITY;
    unsigned used = 0;
    if (half == INFINITY && at->found[0] != CM_NO_FACE &&
        memcmp(at->found, at->found + 1, at->count - 1) == 0)
    {
        memset(group_of, 0, at->count);
        group_all(at, groups);
        return 1;
    }
    memset(used_by, CM_NO_FACE, sizeof used_by);
    for (unsigned i = 0; i < at->count; i++)
    {
        group_of[i] = CM_NO_FACE;
        if (at->found[i] == CM_NO_FACE)
        {
            continue;
        }
        uint8_t *index = &used_by[at->found[i] + (at->x[i] > half ? 1 : 0)];
        if (*index == CM_NO_FACE)
        {
            *index = (uint8_t)used;
            begin_group(&groups[used++], at->found[i], at->x[i], at->y[i]);
        }
        cm_group *group = &groups[*index];
        group_of[i] = *index;
        group->x[group->count] = (float)(at->x[i] - (group->column + 0.5));
        group->y[group->count] = (float)(at->y[i] - (group->row + 0.5));
        group->own_pixel[group->count++] = at->pixel[i];
    }
    return used;
}

/* ---- derivatives of exact blocks ---- */

typedef struct block_slopes
{
    float x[CM_BLOCK_PIXELS];
    float y[CM_BLOCK_PIXELS];
    uint8_t is_there[CM_BLOCK_PIXELS];
} block_slopes;

static double unwrapped(double difference, double period)
{
    return period > 0.0 && difference > 0.5 * period    ? difference - period
           : period > 0.0 && difference < -0.5 * period ? difference + period
                                                        : difference;
}

/* Differences by a step to the right or down, where it stays on the plane of the source and there is none yet. */
static void difference(const cm_plan *plan, const block_places *at, double right, double down,
                       block_slopes *slopes)
{
    double column[CM_BLOCK_PIXELS];
    double row[CM_BLOCK_PIXELS];
    uint8_t found[CM_BLOCK_PIXELS];
    uint8_t which[CM_BLOCK_PIXELS];
    size_t n = 0;
    for (unsigned i = 0; i < at->count; i++)
    {
        column[n] = at->column[i] + right;
        row[n] = at->row[i] + down;
        which[n] = (uint8_t)i;
        n += !slopes->is_there[i] && at->found[i] != CM_NO_FACE;
    }
    if (n == 0)
    {
        return;
    }
    double x[CM_BLOCK_PIXELS];
    double y[CM_BLOCK_PIXELS];
    cm_lattice_find(plan, at->plane, n, column, row, found, x, y);
    for (size_t i = 0; i < n; i++)
    {
        const unsigned k = which[i];
        const double step = right + down;
        const double across = unwrapped(x[i] - at->x[k], plan->from->period) / step;
        /* at a pole of the source columns have no derivative */
        slopes->is_there[k] = found[i] == at->found[k] && fabs(across) <= plan->from->width;
        if (slopes->is_there[k])
        {
            slopes->x[k] = (float)across;
            slopes->y[k] = (float)((y[i] - at->y[k]) / step);
        }
    }
}

/* By steps to either side; what has its plane on neither is a corner, as steep as the pixel before it. */
static void slopes_of_block(const cm_plan *plan, const block_places *at, int is_row,
                            block_slopes *slopes)
{
    memset(slopes, 0, sizeof *slopes);
    difference(plan, at, is_row ? 0.0 : STEP, is_row ? STEP : 0.0, slopes);
    difference(plan, at, is_row ? 0.0 : -STEP, is_row ? -STEP : 0.0, slopes);
    unsigned last[CM_PLANES_MAX];
    memset(last, 0xff, sizeof last);
    for (unsigned i = 0; i < at->count; i++)
    {
        const uint8_t plane = at->found[i];
        if (plane != CM_NO_FACE && slopes->is_there[i])
        {
            last[plane] = i;
        }
        else if (plane != CM_NO_FACE && last[plane] < CM_BLOCK_PIXELS)
        {
            slopes->x[i] = slopes->x[last[plane]];
            slopes->y[i] = slopes->y[last[plane]];
        }
    }
}

/* A pixel on a pole, or nearly so, has all longitudes, and as much latitude as it is high: its derivatives, which are
 * without bounds, become a footprint that goes once round. */
static void calm_poles(double period, unsigned count, block_slopes slopes[2])
{
    const double most = POLE_MOST * period;
    for (unsigned i = 0; i < count && period > 0.0; i++)
    {
        if (hypot((double)slopes[0].x[i], (double)slopes[1].x[i]) > most)
        {
            slopes[1].y[i] = (float)hypot((double)slopes[0].y[i], (double)slopes[1].y[i]);
            slopes[0].y[i] = 0.0f;
            slopes[0].x[i] = (float)most;
            slopes[1].x[i] = 0.0f;
        }
    }
}

static void derive_block(const cm_plan *plan, const block_places *at, const uint8_t *group_of,
                         cm_group *groups)
{
    block_slopes slopes[2];
    slopes_of_block(plan, at, 0, &slopes[0]);
    slopes_of_block(plan, at, 1, &slopes[1]);
    calm_poles(plan->from->period, at->count, slopes);
    for (int is_row = 0; is_row < 2; is_row++)
    {
        unsigned count[CM_GROUPS_MAX] = {0};
        for (unsigned i = 0; i < at->count; i++)
        {
            if (group_of[i] != CM_NO_FACE)
            {
                cm_group *group = &groups[group_of[i]];
                float(*to)[CM_BLOCK_PIXELS] = is_row ? group->by_row : group->by_column;
                const unsigned k = count[group_of[i]]++;
                to[0][k] = slopes[is_row].x[i];
                to[1][k] = slopes[is_row].y[i];
            }
        }
    }
}

static unsigned exact_block(cm_geometry *geometry, unsigned plane, uint32_t block_column,
                            uint32_t block_row, cm_group *groups)
{
    const cm_plan *plan = geometry->plan;
    block_places at;
    uint8_t group_of[CM_BLOCK_PIXELS];
    place_block(plan->to, plane, block_column, block_row, &at);
    cm_lattice_find(plan, plane, at.count, at.column, at.row, at.found, at.x, at.y);
    const unsigned used = group_places(plan, &at, groups, group_of);
    if (geometry->derivatives)
    {
        derive_block(plan, &at, group_of, groups);
    }
    geometry->count.exact++;
    return used;
}

/* ---- interpolated blocks ---- */

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
static int is_near(const cm_geometry *geometry, float across, float along, int alone,
                   const block_nodes *nodes)
{
    const double extent = extent_of(nodes);
    const double bend = sqrt((double)across) + LEBESGUE * sqrt((double)along);
    double factor = alone ? 2.0 * ERROR_SMOOTH : ERROR_SMOOTH;
    if (geometry->is_creased)
    {
        factor = alone ? INFINITY : bend > FOLD * extent ? ERROR_FOLDED : ERROR_CREASED;
    }
    const double error = factor * bend + rounded(extent);
    if (!geometry->derivatives)
    {
        return error <= geometry->plan->options.tolerance;
    }
    const double pixel = extent / CM_BLOCK_EDGE;
    return error <= geometry->plan->options.tolerance * fmax(FOOTPRINT * pixel, 1.0) &&
           ERROR_SLOPE * bend <= SLOPE_TOLERANCE * pixel;
}

/* The same of the polynomial through six nodes each way. */
static int is_near_wide(const cm_geometry *geometry, const cm_lattice_view *view, int is_uniform,
                        block_nodes *nodes)
{
    double across, along;
    if (geometry->is_creased || geometry->derivatives ||
        !cm_lattice_bend_wide(view, is_uniform, &across, &along))
    {
        return 0;
    }
    take_wide_nodes(view, nodes);
    return ERROR_WIDE * (across + LEBESGUE * along) + rounded(extent_of(nodes)) <=
           geometry->plan->options.tolerance;
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

static void interpolate(const cm_geometry *geometry, const block_nodes *nodes, cm_group *group)
{
    cm_placer *place = geometry->set->place;
    const cm_place_weights *weights = &geometry->weights;
    const cm_place_weights *slopes = &geometry->slopes;
    place(nodes->x, weights, weights, group->x);
    place(nodes->y, weights, weights, group->y);
    if (geometry->derivatives)
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

static void interpolate_wide(const cm_geometry *geometry, const block_nodes *nodes, cm_group *group)
{
    const cm_wide_weights *weights = &geometry->wide;
    group->is_bounded = 1;
    for (int k = 0; k < 2; k++)
    {
        geometry->set->place_wide(k == 0 ? nodes->x : nodes->y, weights, weights,
                                  k == 0 ? group->x : group->y, &group->low[k], &group->high[k]);
    }
}

/* What all places of a block of one group reach. */
static void bound_places(const cm_geometry *geometry, cm_group *group)
{
    float bounds[4];
    geometry->set->bounds(CM_BLOCK_PIXELS, group->x, group->y, bounds);
    group->is_bounded = 1;
    for (int k = 0; k < 2; k++)
    {
        group->low[k] = bounds[2 * k];
        group->high[k] = bounds[2 * k + 1];
    }
}

static int is_group_inside(const cm_surface *from, const cm_group *group, double slack)
{
    const double column = group->column + 0.5;
    const double row = group->row + 0.5;
    return column + (double)group->low[0] >= -slack &&
           column + (double)group->high[0] <= from->width + slack &&
           row + (double)group->low[1] >= -slack &&
           row + (double)group->high[1] <= from->height + slack;
}

static void copy_pixel(const cm_group *from, unsigned i, cm_group *to, int derivatives)
{
    const unsigned k = to->count++;
    to->x[k] = from->x[i];
    to->y[k] = from->y[i];
    to->own_pixel[k] = from->pixel[i];
    for (int axis = 0; derivatives && axis < 2; axis++)
    {
        to->by_column[axis][k] = from->by_column[axis][i];
        to->by_row[axis][k] = from->by_row[axis][i];
    }
}

/* Pixels that the target's plane does not have leave a group of all. */
static void drop_beyond(const cm_geometry *geometry, uint32_t block_column, uint32_t block_row,
                        cm_group *group)
{
    const cm_surface *to = geometry->plan->to;
    const uint32_t columns = to->width - block_column * CM_BLOCK_EDGE;
    const uint32_t rows = to->height - block_row * CM_BLOCK_EDGE;
    if (columns < CM_BLOCK_EDGE || rows < CM_BLOCK_EDGE)
    {
        group->count = 0;
        for (unsigned i = 0; i < CM_BLOCK_PIXELS; i++)
        {
            if (i % CM_BLOCK_EDGE < columns && i / CM_BLOCK_EDGE < rows)
            {
                copy_pixel(group, i, group, geometry->derivatives);
            }
        }
        group->pixel = group->own_pixel;
    }
}

/* Pixels that have gone round come from the other end. Returns how many groups there are, 0 if places are beyond the
 * source's plane. */
static unsigned bring_back(const cm_geometry *geometry, double slack, cm_group *groups)
{
    const cm_surface *from = geometry->plan->from;
    cm_group all = groups[0];
    const double row = all.row + 0.5;
    unsigned count[3] = {0};
    uint8_t side[CM_BLOCK_PIXELS];
    for (unsigned i = 0; i < all.count; i++)
    {
        const double x = all.column + 0.5 + (double)all.x[i];
        const double y = row + (double)all.y[i];
        if (y < -slack || y > from->height + slack)
        {
            return 0;
        }
        side[i] = x < -slack ? 0 : x > from->width + slack ? 2 : 1;
        count[side[i]]++;
    }
    if (count[0] + count[2] == 0)
    {
        return 1;
    }
    if (from->period == 0.0)
    {
        return 0;
    }
    if (all.pixel == groups[0].own_pixel)
    {
        all.pixel = all.own_pixel; /* the first group is written over */
    }
    unsigned used = 0;
    for (int s = 0; s < 3; s++)
    {
        if (count[s] == 0)
        {
            continue;
        }
        cm_group *group = &groups[used++];
        group->plane = all.plane;
        group->pixel = group->own_pixel;
        group->column = all.column + (1 - s) * (int32_t)from->width;
        group->row = all.row;
        group->is_bounded = 0;
        group->count = 0;
        for (unsigned i = 0; i < all.count; i++)
        {
            if (side[i] == s)
            {
                copy_pixel(&all, i, group, geometry->derivatives);
            }
        }
    }
    return used;
}

static cm_lattice *lattice_at(cm_geometry *geometry, unsigned plane, uint32_t block_column,
                              uint32_t block_row)
{
    const uint32_t chunk = block_column / LATTICE_BLOCKS;
    cm_lattice *lattice = &geometry->lattice[chunk % geometry->lattices];
    cm_lattice_fill(lattice, geometry->plan, geometry->set, plane, block_row, chunk);
    return lattice;
}

/* A block of which the bounds are known, and which may be beyond the source's plane. Returns as near_block. */
static unsigned settle(const cm_geometry *geometry, uint32_t block_column, uint32_t block_row,
                       double slack, cm_group *groups)
{
    const cm_surface *from = geometry->plan->from;
    drop_beyond(geometry, block_column, block_row, groups);
    return is_group_inside(from, groups, slack) ? 1 : bring_back(geometry, slack, groups);
}

/* A block of a patch. Returns 0 if it is none. */
static int patch_block(cm_geometry *geometry, unsigned plane, uint32_t block_column,
                       uint32_t block_row, cm_group *group)
{
    cm_patch_places places;
    if (!cm_patches_block(geometry->patches, plane, block_column, block_row, &places, group->x,
                          group->y))
    {
        return 0;
    }
    group->plane = places.plane;
    group->column = places.column;
    group->row = places.row;
    group->count = CM_BLOCK_PIXELS;
    group->is_bounded = 1;
    memcpy(group->low, places.low, sizeof group->low);
    memcpy(group->high, places.high, sizeof group->high);
    group->pixel = geometry->all_pixels;
    return 1;
}

/* Returns how many groups there are; 0: the block is to be done exactly. */
static unsigned near_block(cm_geometry *geometry, unsigned plane, uint32_t block_column,
                           uint32_t block_row, cm_group *groups)
{
    const cm_plan *plan = geometry->plan;
    const double slack = fmin(plan->options.tolerance, SLACK_MOST);
    if (geometry->patches != NULL && patch_block(geometry, plane, block_column, block_row, groups))
    {
        return settle(geometry, block_column, block_row, slack, groups);
    }
    const cm_lattice *lattice = lattice_at(geometry, plane, block_column, block_row);
    cm_lattice_copy copy;
    block_nodes nodes;
    const cm_lattice_view view = cm_lattice_see(lattice, geometry->set, plan->from->period,
                                                block_column % LATTICE_BLOCKS, &copy);
    float across, along;
    int alone;
    if (!cm_lattice_bend(&view, lattice->is_uniform, &across, &along, &alone))
    {
        return 0;
    }
    take_nodes(geometry->set, &view, &nodes);
    const int is_wide = !is_near(geometry, across, along, alone, &nodes);
    if (is_wide && !is_near_wide(geometry, &view, lattice->is_uniform, &nodes))
    {
        return 0;
    }
    begin_group(groups, view.plane[BEYOND * (view.stride + 1)], nodes.column, nodes.row);
    groups->count = CM_BLOCK_PIXELS;
    groups->pixel = geometry->all_pixels;
    (is_wide ? interpolate_wide : interpolate)(geometry, &nodes, groups);
    if (!is_wide && is_inside(plan->from, &nodes, slack))
    {
        bound(&nodes, groups);
        drop_beyond(geometry, block_column, block_row, groups);
        return 1;
    }
    if (!is_wide)
    {
        bound_places(geometry, groups);
    }
    return settle(geometry, block_column, block_row, slack, groups);
}

unsigned cm_geometry_block(cm_geometry *geometry, unsigned plane, uint32_t block_column,
                           uint32_t block_row, cm_group *groups)
{
    const unsigned used = geometry->plan->options.tolerance > 0.0
                              ? near_block(geometry, plane, block_column, block_row, groups)
                              : 0;
    geometry->count.interpolated += used != 0;
    return used != 0 ? used : exact_block(geometry, plane, block_column, block_row, groups);
}
