/* SPDX-License-Identifier: MIT
 *
 * Derivatives of exact blocks, by differences.
 */
#include "geometry_exact.h"
#include "lattice.h"
#include "pole.h"

#include <math.h>
#include <string.h>

/* Steps of differences for derivatives, in pixels. */
#define STEP (1.0 / 4096.0)

/* What goes on faster around a pole, in parts of all columns for a pixel, bends too much for steps of columns. */
#define AROUND (1.0 / 16.0)

/* No pixel is wider on a source that goes round, of its whole width: footprints reach twice it each way. */
#define POLE_MOST 0.5

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

/* From one place to another, for a step. */
static void slope_between(const cm_surface *surface, const double from[2], const double to[2],
                          double step, double slope[2])
{
    slope[0] = unwrapped(to[0] - from[0], surface->period) / step;
    slope[1] = (to[1] - from[1]) / step;
    if (surface->poles != 0 && fabs(slope[0]) > AROUND * surface->width)
    {
        const int is_lower = cm_pole_is_lower(surface, from[1]);
        const cm_pole_place one = cm_pole_place_of(surface, is_lower, from[0], from[1]);
        const cm_pole_place other = cm_pole_place_of(surface, is_lower, to[0], to[1]);
        const double on_plane[2] = {(other.x - one.x) / step, (other.y - one.y) / step};
        cm_pole_slope_back(&one, on_plane, slope);
    }
}

/* Differences by a step to the right or down, where it stays on the plane of the source and there is none yet. */
static void difference(const cm_plan *plan, const cm_exact_places *at, double right, double down,
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
        const double from[2] = {at->x[k], at->y[k]}, to[2] = {x[i], y[i]};
        double slope[2];
        slope_between(plan->from, from, to, right + down, slope);
        /* at a pole columns have no derivative, but those of the plane around it have */
        slopes->is_there[k] = found[i] == at->found[k] &&
                              (plan->from->poles != 0 || fabs(slope[0]) <= plan->from->width);
        if (slopes->is_there[k])
        {
            slopes->x[k] = (float)slope[0];
            slopes->y[k] = (float)slope[1];
        }
    }
}

/* By steps to either side; what has its plane on neither is a corner, as steep as the pixel before it. */
static void slopes_of_block(const cm_plan *plan, const cm_exact_places *at, int is_row,
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
 * without bounds, become a footprint that goes once round, but where poles are done on a plane of their own. */
static void calm_poles(const cm_surface *surface, unsigned count, block_slopes slopes[2])
{
    const double most = POLE_MOST * surface->period;
    for (unsigned i = 0; i < count && surface->period > 0.0 && surface->poles == 0; i++)
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

void cm_exact_slopes(const cm_plan *plan, const cm_exact_places *at, const uint8_t *group_of,
                     cm_group *groups)
{
    block_slopes slopes[2];
    slopes_of_block(plan, at, 0, &slopes[0]);
    slopes_of_block(plan, at, 1, &slopes[1]);
    calm_poles(plan->from, at->count, slopes);
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
