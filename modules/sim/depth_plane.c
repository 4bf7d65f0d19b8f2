/* SPDX-License-Identifier: MIT
 *
 * Nair et al. 2013, section 5.1: walls that a camera has slanted or bent.
 */
#include <cubemap/depth_error.h>

#include "vector.h"

#include <float.h>
#include <math.h>

/* Of the surface of second degree above the plane: 1, u, v, u^2 / 2, u v, v^2 / 2. */
#define TERMS 6

static int take_point(const float *const point[3], size_t i, double at[3])
{
    for (int k = 0; k < 3; k++)
    {
        at[k] = (double)point[k][i];
    }
    return isfinite(at[0]) && isfinite(at[1]) && isfinite(at[2]);
}

/* ---- axes ---- */

/* One rotation of Jacobi's method (1846): the element (p, q) of a becomes 0. axis has eigenvectors in its columns. */
static void turn(double a[3][3], double axis[3][3], int p, int q)
{
    if (a[p][q] == 0.0)
    {
        return;
    }
    const double theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
    const double t = copysign(1.0, theta) / (fabs(theta) + sqrt(theta * theta + 1.0));
    const double c = 1.0 / sqrt(t * t + 1.0), s = t * c;
    for (int k = 0; k < 3; k++)
    {
        const double kp = a[k][p], kq = a[k][q];
        a[k][p] = c * kp - s * kq;
        a[k][q] = s * kp + c * kq;
    }
    for (int k = 0; k < 3; k++)
    {
        const double pk = a[p][k], qk = a[q][k];
        a[p][k] = c * pk - s * qk;
        a[q][k] = s * pk + c * qk;
    }
    for (int k = 0; k < 3; k++)
    {
        const double kp = axis[k][p], kq = axis[k][q];
        axis[k][p] = c * kp - s * kq;
        axis[k][q] = s * kp + c * kq;
    }
}

/* Rows of axes: along the most, the middle and the least of spread, whose squares they have. */
static void find_axes(double spread[3][3], double axes[3][3], double value[3])
{
    double column[3][3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    for (int sweep = 0; sweep < 30; sweep++)
    {
        turn(spread, column, 0, 1);
        turn(spread, column, 0, 2);
        turn(spread, column, 1, 2);
    }
    int order[3] = {0, 1, 2};
    for (int i = 0; i < 3; i++)
    {
        const int a = i == 1 ? 1 : 0; /* (0,1), (1,2), (0,1) sort three */
        if (spread[order[a]][order[a]] < spread[order[a + 1]][order[a + 1]])
        {
            const int kept = order[a];
            order[a] = order[a + 1];
            order[a + 1] = kept;
        }
    }
    for (int i = 0; i < 3; i++)
    {
        value[i] = spread[order[i]][order[i]];
        for (int k = 0; k < 3; k++)
        {
            axes[i][k] = column[k][order[i]];
        }
    }
}

/* ---- the plane ---- */

static void find_centre(size_t n, const float *const point[3], cm_depth_plane *plane)
{
    double at[3], sum[3] = {0.0, 0.0, 0.0};
    for (size_t i = 0; i < n; i++)
    {
        if (take_point(point, i, at))
        {
            plane->count++;
            for (int k = 0; k < 3; k++)
            {
                sum[k] += at[k];
            }
        }
    }
    for (int k = 0; k < 3; k++)
    {
        plane->centre[k] = sum[k] / (double)plane->count;
    }
}

static void find_spread(size_t n, const float *const point[3], const double centre[3],
                        double spread[3][3])
{
    double at[3];
    for (size_t i = 0; i < n; i++)
    {
        if (!take_point(point, i, at))
        {
            continue;
        }
        for (int k = 0; k < 9; k++)
        {
            spread[k / 3][k % 3] += (at[k / 3] - centre[k / 3]) * (at[k % 3] - centre[k % 3]);
        }
    }
}

/* ---- the surface of second degree ---- */

/* Gauss with pivots along the diagonal, of a symmetric matrix with its right side; 0 if it is singular. */
static int solve(double a[TERMS][TERMS + 1])
{
    const double size = a[0][0]; /* the number of points: all other terms have that size */
    for (int i = 0; i < TERMS; i++)
    {
        int pivot = i;
        for (int j = i + 1; j < TERMS; j++)
        {
            pivot = fabs(a[j][i]) > fabs(a[pivot][i]) ? j : pivot;
        }
        if (!(fabs(a[pivot][i]) > 1e-9 * size))
        {
            return 0;
        }
        for (int k = 0; k <= TERMS; k++)
        {
            const double kept = a[i][k];
            a[i][k] = a[pivot][k];
            a[pivot][k] = kept;
        }
        for (int j = 0; j < TERMS; j++)
        {
            const double times = j == i ? 0.0 : a[j][i] / a[i][i];
            for (int k = i; k <= TERMS && j != i; k++)
            {
                a[j][k] -= times * a[i][k];
            }
        }
    }
    return 1;
}

/* Principal curvatures of a graph at its middle, from gradient and second derivatives (do Carmo 1976, section 3.3). */
static void bend(const double g[2], const double h[3], double curvature[2])
{
    const double w = sqrt(1.0 + g[0] * g[0] + g[1] * g[1]);
    const double mean =
        ((1.0 + g[1] * g[1]) * h[0] - 2.0 * g[0] * g[1] * h[1] + (1.0 + g[0] * g[0]) * h[2]) /
        (2.0 * w * w * w);
    const double gauss = (h[0] * h[2] - h[1] * h[1]) / (w * w * w * w);
    const double apart = sqrt(fmax(mean * mean - gauss, 0.0));
    curvature[0] = mean + apart;
    curvature[1] = mean - apart;
}

/* In lengths of the spread, so that all terms are of one size. */
static void add_row(const double local[3], double a[TERMS][TERMS + 1])
{
    const double u = local[0], v = local[1];
    const double term[TERMS + 1] = {1.0, u, v, 0.5 * u * u, u * v, 0.5 * v * v, local[2]};
    for (int i = 0; i < TERMS; i++)
    {
        for (int k = 0; k <= TERMS; k++)
        {
            a[i][k] += term[i] * term[k];
        }
    }
}

static void find_curvature(size_t n, const float *const point[3], double axes[3][3], double scale,
                           cm_depth_plane *plane)
{
    double a[TERMS][TERMS + 1] = {{0.0}};
    double at[3];
    plane->curvature[0] = plane->curvature[1] = (double)NAN;
    for (size_t i = 0; i < n; i++)
    {
        if (take_point(point, i, at))
        {
            const double from[3] = {at[0] - plane->centre[0], at[1] - plane->centre[1],
                                    at[2] - plane->centre[2]};
            const double local[3] = {dot(axes[0], from) / scale, dot(axes[1], from) / scale,
                                     dot(plane->normal, from) / scale};
            add_row(local, a);
        }
    }
    if (plane->count >= TERMS && solve(a))
    {
        const double gradient[2] = {a[1][TERMS] / a[1][1], a[2][TERMS] / a[2][2]};
        const double second[3] = {a[3][TERMS] / a[3][3] / scale, a[4][TERMS] / a[4][4] / scale,
                                  a[5][TERMS] / a[5][5] / scale};
        bend(gradient, second, plane->curvature);
    }
}

static void find_distances(size_t n, const float *const point[3], cm_depth_plane *plane)
{
    double at[3], sum = 0.0;
    for (size_t i = 0; i < n; i++)
    {
        if (take_point(point, i, at))
        {
            const double from[3] = {at[0] - plane->centre[0], at[1] - plane->centre[1],
                                    at[2] - plane->centre[2]};
            const double distance = dot(plane->normal, from);
            sum += distance * distance;
            plane->maximum = fmax(plane->maximum, fabs(distance));
        }
    }
    plane->rms = sqrt(sum / (double)plane->count);
}

cm_status cm_depth_error_plane(size_t n, const float *const point[3], cm_depth_plane *plane)
{
    if (plane == NULL || plane->size != sizeof *plane || point == NULL ||
        (n > 0 && (point[0] == NULL || point[1] == NULL || point[2] == NULL)))
    {
        return CM_ERROR_ARGUMENT;
    }
    cm_depth_plane made = {.size = sizeof made};
    double spread[3][3] = {{0.0}}, axes[3][3], value[3];
    find_centre(n, point, &made);
    if (made.count < 3)
    {
        return CM_ERROR_RANK;
    }
    find_spread(n, point, made.centre, spread);
    find_axes(spread, axes, value);
    /* floats know their places to FLT_EPSILON: on a line nothing but that is beside it */
    const double size = sqrt(dot(made.centre, made.centre)) + sqrt(value[0] / (double)made.count);
    const double least = (double)FLT_EPSILON * size;
    if (!(value[1] > (double)made.count * least * least))
    {
        return CM_ERROR_RANK;
    }
    const double side = dot(axes[2], made.centre) > 0.0 ? -1.0 : 1.0;
    for (int k = 0; k < 3; k++)
    {
        made.normal[k] = side * axes[2][k];
    }
    made.distance = dot(made.normal, made.centre);
    find_distances(n, point, &made);
    find_curvature(n, point, axes, sqrt(value[0] / (double)made.count), &made);
    *plane = made;
    return CM_OK;
}
