/* SPDX-License-Identifier: MIT
 *
 * The condition of a mapping: how much its warp, or the inverse of that, stretches a small difference at most.
 */
#include "certificate.h"

#include <math.h>

enum
{
    GRID = 64
};

/* A mapping whose condition is asked for; without truth by the library. */
typedef struct warping
{
    const cm_mapping *mapping;
    const quad_mapping *truth;
    quad step;
} warping;

static void warp_by(const warping *w, int back, const quad from[2], quad to[2])
{
    if (w->truth != NULL)
    {
        (back ? quad_unwarp : quad_warp)(w->truth, from, to);
        return;
    }
    const double in[2] = {(double)from[0], (double)from[1]};
    double out[2] = {(double)NAN, (double)NAN};
    (void)(back ? cm_unwarp : cm_warp)(w->mapping, in, out);
    to[0] = (quad)out[0];
    to[1] = (quad)out[1];
}

/* How much the inverse, or at odd places the warp, stretches a small difference there; 0 where that is infinite. */
static quad stretch_at(const warping *w, int place)
{
    const quad step = w->step;
    quad at[2] = {(place / 2 % GRID + (quad)0.5) / GRID, (place / 2 / GRID + (quad)0.5) / GRID};
    at[0] = at[0] > (quad)0.98 ? (quad)1.0 - (quad)2.0 * step : at[0];
    at[1] = at[1] > (quad)0.98 ? (quad)1.0 - (quad)2.0 * step : at[1];
    if (is_beside_singularity(w->mapping, (double)at[0], (double)at[1]))
    {
        return (quad)0.0;
    }
    quad column[2][2];
    for (int k = 0; k < 2; k++)
    {
        quad low[2] = {at[0], at[1]}, high[2] = {at[0], at[1]}, from[2], to[2];
        low[k] -= step;
        high[k] += step;
        warp_by(w, place % 2 == 0, low, from);
        warp_by(w, place % 2 == 0, high, to);
        column[k][0] = fabsq(to[0] - from[0]) / ((quad)2.0 * step);
        column[k][1] = fabsq(to[1] - from[1]) / ((quad)2.0 * step);
    }
    return fmaxq(column[0][0] + column[1][0], column[0][1] + column[1][1]);
}

/* The largest stretch of a small difference, by the warp or by its inverse, over a grid that comes
 * close to the edges, but not to where it is infinite; 1 for a mapping that is no warp. Where it is largest double
 * precision says. */
double condition_of(const cm_mapping *mapping, const quad_mapping *truth)
{
    const warping quickly = {mapping, NULL, (quad)1e-6};
    const warping exactly = {mapping, truth, (quad)1e-12};
    int place = 0;
    quad most = (quad)0.0;
    if (truth->kernels->warp == NULL)
    {
        return 1.0;
    }
    for (int i = 0; i < 2 * GRID * GRID; i++)
    {
        const quad here = stretch_at(&quickly, i);
        place = here > most ? i : place;
        most = here > most ? here : most;
    }
    return (double)fmaxq((quad)1.0, stretch_at(&exactly, place));
}
