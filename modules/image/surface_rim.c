/* SPDX-License-Identifier: MIT
 *
 * Planes with gaps: where the map is, and where the sphere goes on beyond its rim. Directions beyond are polynomials
 * through places before the rim, by Newton's forward differences, of as high a degree as makes the terms smaller: a crease
 * of the map ends them early. Where the map is flat at its rim, as Lambert's is at the antipode, no polynomial holds, and the
 * direction is that of the place as far inside, mirrored at the rim.
 */
#include "surface_object.h"

#include <math.h>

#define BLOCK 64
#define NODES 8

/* Halvings of a distance of some pixels. A polynomial does not need to begin at the rim itself. */
#define HALVINGS 10

/* A second difference that is more than this part of the first is no smooth map's. */
#define FLAT 0.4

void cm_surface_covers(const cm_surface *surface, unsigned plane, size_t n, const double *column,
                       const double *row, uint8_t *covered)
{
    double x[BLOCK], y[BLOCK], z[BLOCK];
    for (size_t done = 0; done < n; done += BLOCK)
    {
        const size_t count = n - done < BLOCK ? n - done : BLOCK;
        if (surface->methods->covers != NULL)
        {
            surface->methods->covers(surface, plane, count, column + done, row + done,
                                     covered + done);
        }
        else
        {
            surface->methods->directions(surface, plane, count, column + done, row + done, x, y, z);
        }
        for (size_t i = 0; i < count; i++)
        {
            const double right = column[done + i];
            const double down = row[done + i];
            const int is_on_plane =
                right >= 0.0 && right <= surface->width && down >= 0.0 && down <= surface->height;
            const int is_there =
                surface->methods->covers != NULL ? covered[done + i] : !isnan(x[i]);
            covered[done + i] = is_on_plane && is_there;
        }
    }
}

/* Places on the way from those on the map to those beside it: the last ones of the map. */
static void find_rim(const cm_surface *surface, unsigned plane, size_t n, const cm_rim_places *at,
                     double *rim_column, double *rim_row)
{
    double inside[BLOCK] = {0};
    double outside[BLOCK];
    uint8_t covered[BLOCK];
    for (size_t i = 0; i < n; i++)
    {
        outside[i] = 1.0;
    }
    for (int step = 0; step < HALVINGS; step++)
    {
        for (size_t i = 0; i < n; i++)
        {
            const double part = 0.5 * (inside[i] + outside[i]);
            rim_column[i] = at->inner_column[i] + part * (at->column[i] - at->inner_column[i]);
            rim_row[i] = at->inner_row[i] + part * (at->row[i] - at->inner_row[i]);
        }
        cm_surface_covers(surface, plane, n, rim_column, rim_row, covered);
        for (size_t i = 0; i < n; i++)
        {
            double *end = covered[i] ? inside : outside;
            end[i] = 0.5 * (inside[i] + outside[i]);
        }
    }
    for (size_t i = 0; i < n; i++)
    {
        rim_column[i] = at->inner_column[i] + inside[i] * (at->column[i] - at->inner_column[i]);
        rim_row[i] = at->inner_row[i] + inside[i] * (at->row[i] - at->inner_row[i]);
    }
}

static double length_of(const double v[3])
{
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/* node[k] is the direction k pixels before the rim; away is how many pixels beyond it the result is. */
static void extrapolate(double node[NODES][3], unsigned count, double away, double direction[3])
{
    double factor = 1.0;
    double before = HUGE_VAL;
    for (int axis = 0; axis < 3; axis++)
    {
        direction[axis] = node[0][axis];
    }
    for (unsigned k = 1; k < count; k++)
    {
        for (unsigned i = 0; i < count - k; i++)
        {
            for (int axis = 0; axis < 3; axis++)
            {
                node[i][axis] = node[i + 1][axis] - node[i][axis];
            }
        }
        factor *= -(away + k - 1.0) / k;
        const double term = fabs(factor) * length_of(node[0]);
        if (!(term < before))
        {
            return;
        }
        before = term;
        for (int axis = 0; axis < 3; axis++)
        {
            direction[axis] += factor * node[0][axis];
        }
    }
}

static int is_flat(double node[NODES][3], unsigned count)
{
    double first[3];
    double second[3];
    for (int axis = 0; axis < 3 && count >= 3; axis++)
    {
        first[axis] = node[1][axis] - node[0][axis];
        second[axis] = node[2][axis] - node[1][axis] - first[axis];
    }
    return count >= 3 && length_of(second) > FLAT * length_of(first);
}

static void mirror(const double node[3], const double inside[3], double direction[3])
{
    const double along = 2.0 * (node[0] * inside[0] + node[1] * inside[1] + node[2] * inside[2]);
    for (int axis = 0; axis < 3; axis++)
    {
        direction[axis] = along * node[axis] - inside[axis];
    }
}

/* One place, of which the rim and so the way inwards is known. */
static void continue_one(const cm_surface *surface, unsigned plane, double rim_column,
                         double rim_row, double column, double row, const double inwards[2],
                         double direction[3])
{
    double columns[NODES + 1], rows[NODES + 1];
    double x[NODES + 1], y[NODES + 1], z[NODES + 1];
    double node[NODES][3];
    unsigned count = 0;
    const double away = hypot(column - rim_column, row - rim_row);
    for (unsigned k = 0; k <= NODES; k++)
    {
        const double step = k < NODES ? k : away;
        columns[k] = fmin(fmax(rim_column + step * inwards[0], 0.0), surface->width);
        rows[k] = fmin(fmax(rim_row + step * inwards[1], 0.0), surface->height);
    }
    cm_surface_own_directions(surface, plane, NODES + 1, columns, rows, x, y, z);
    while (count < NODES && !isnan(x[count]))
    {
        node[count][0] = x[count];
        node[count][1] = y[count];
        node[count][2] = z[count];
        count++;
    }
    if (count == 0)
    {
        direction[0] = direction[1] = direction[2] = (double)NAN;
    }
    else if (is_flat(node, count) && !isnan(x[NODES]))
    {
        const double inside[3] = {x[NODES], y[NODES], z[NODES]};
        mirror(node[0], inside, direction);
    }
    else
    {
        extrapolate(node, count, away, direction);
    }
}

void cm_surface_continue(const cm_surface *surface, unsigned plane, size_t n,
                         const cm_rim_places *at, double *x, double *y, double *z)
{
    double rim_column[BLOCK];
    double rim_row[BLOCK];
    for (size_t done = 0; done < n; done += BLOCK)
    {
        const size_t count = n - done < BLOCK ? n - done : BLOCK;
        const cm_rim_places part = {at->inner_column + done, at->inner_row + done,
                                    at->column + done, at->row + done};
        find_rim(surface, plane, count, &part, rim_column, rim_row);
        for (size_t i = 0; i < count; i++)
        {
            double direction[3];
            const double right = part.inner_column[i] - part.column[i];
            const double down = part.inner_row[i] - part.row[i];
            const double length = hypot(right, down);
            const double inwards[2] = {right / length, down / length};
            continue_one(surface, plane, rim_column[i], rim_row[i], part.column[i], part.row[i],
                         inwards, direction);
            x[done + i] = direction[0];
            y[done + i] = direction[1];
            z[done + i] = direction[2];
        }
    }
}
