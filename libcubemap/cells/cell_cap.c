/* SPDX-License-Identifier: MIT
 *
 * Caps about cells: how far their corners are from their centre, and how much further their edges bulge.
 */
#include "cell_shape.h"

#include <stdlib.h>
#include <string.h>

static double chord_squared(const double a[3], const double b[3])
{
    double d[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    return d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
}

/* The largest angle from the centre to a corner. */
static double reach_of(double normal[5][3])
{
    int at = 0;
    double most = 0.0;
    for (int k = 0; k < 4; k++)
    {
        double square = chord_squared(normal[k], normal[4]);
        at = square > most ? k : at;
        most = fmax(most, square);
    }
    return cm_angle(normal[at], normal[4]);
}

double cm_cell_cap(const cm_cell_grid *cells, cm_cell cell, double normal[5][3])
{
    int level = cm_cell_level(cell);
    int row = level < CM_CELL_BULGES ? level : CM_CELL_BULGES - 1;
    cm_cell_normals(cells, cell, normal);
    return level < 0 ? (double)NAN : reach_of(normal) * cells->bulge[row] + CM_CELL_SLACK;
}

void cm_cell_bounding_cap(const cm_cell_grid *cells, cm_cell cell, double normal[3], double *radius)
{
    double all[5][3];
    *radius = cm_cell_cap(cells, cell, all);
    memcpy(normal, all[4], sizeof all[4]);
}

/* ---- How much edges bulge ---- */

enum
{
    FINEST = CM_CELL_BULGES - 1,
    CELLS = 1 << FINEST, /* along a side of a face */
    STEPS = 8,           /* points along a side of one of them, at the middles of eighths */
    POINTS = CELLS * STEPS
};

/* Normals of a face. Cells of coarser levels have their edges and corners among those of the finest, and their
 * middles too but for the finest ones. */
typedef struct net
{
    double along[2][CELLS + 1][POINTS][3]; /* of lines of equal v, and of equal u */
    double corner[CELLS + 1][CELLS + 1][3];
    double middle[CELLS][CELLS][3];
} net;

static double line_at(int k)
{
    return 2.0 * k / CELLS - 1.0;
}

/* A row of points whose u are given, at the same v, or the other way round. */
static void fill_row(const cm_cell_grid *cells, uint8_t face, size_t n, const double *along,
                     double across, int is_turned, double (*to)[3])
{
    uint8_t on[POINTS] = {0};
    double other[POINTS] = {0}, x[POINTS], y[POINTS], z[POINTS];
    for (size_t i = 0; i < n; i++)
    {
        on[i] = face;
        other[i] = across;
    }
    cm_cell_normals_at(cells, n, on, is_turned ? other : along, is_turned ? along : other, x, y, z);
    for (size_t i = 0; i < n; i++)
    {
        to[i][0] = x[i];
        to[i][1] = y[i];
        to[i][2] = z[i];
    }
}

static void fill_net(const cm_cell_grid *cells, uint8_t face, net *to)
{
    double along[POINTS], corner[CELLS + 1], middle[CELLS];
    for (int i = 0; i < POINTS; i++)
    {
        along[i] = (2.0 * i + 1.0) / POINTS - 1.0;
    }
    for (int i = 0; i <= CELLS; i++)
    {
        corner[i] = line_at(i);
        middle[i % CELLS] = line_at(i % CELLS) + 1.0 / CELLS;
    }
    for (int k = 0; k <= CELLS; k++)
    {
        fill_row(cells, face, POINTS, along, line_at(k), 0, to->along[0][k]);
        fill_row(cells, face, POINTS, along, line_at(k), 1, to->along[1][k]);
        fill_row(cells, face, CELLS + 1, corner, line_at(k), 0, to->corner[k]);
    }
    for (int k = 0; k < CELLS; k++)
    {
        fill_row(cells, face, CELLS, middle, middle[k], 0, to->middle[k]);
    }
}

/* The greatest square of a distance from a centre to a part of a line, if that is more than most. */
static void reach_along(double (*line)[3], int count, const double centre[3], double *most)
{
    for (int i = 0; i < count; i++)
    {
        *most = fmax(*most, chord_squared(line[i], centre));
    }
}

static double angle_of_chord(double square)
{
    return 2.0 * asin(fmin(1.0, 0.5 * sqrt(square)));
}

/* By what factor the edges of a cell, the one in column i and row j, are further from its centre than its corners. */
static double bulge_of(net *of, int level, int i, int j)
{
    int size = CELLS >> level;
    int low_i = i * size;
    int low_j = j * size;
    const double *centre =
        size == 1 ? of->middle[j][i] : of->corner[low_j + size / 2][low_i + size / 2];
    double corners = 0.0;
    for (int k = 0; k < 4; k++)
    {
        const double *corner = of->corner[low_j + (k >> 1) * size][low_i + (k & 1) * size];
        corners = fmax(corners, chord_squared(corner, centre));
    }
    double edges = 0.0;
    for (int k = 0; k < 2; k++)
    {
        reach_along(of->along[0][low_j + k * size] + low_i * STEPS, size * STEPS, centre, &edges);
        reach_along(of->along[1][low_i + k * size] + low_j * STEPS, size * STEPS, centre, &edges);
    }
    return angle_of_chord(edges) / angle_of_chord(corners);
}

static double bulge_of_level(net *of, int level)
{
    double most = 1.0;
    for (int n = 0; n < 1 << (2 * level); n++)
    {
        most = fmax(most, bulge_of(of, level, n >> level, n & ((1 << level) - 1)));
    }
    return most;
}

/* What is missed between the points, and on finer levels, is less than the quarter that is added. */
cm_status cm_cell_measure_bulges(cm_cell_grid *cells)
{
    double most[CM_CELL_BULGES] = {0};
    net *of_face = malloc(sizeof *of_face);
    if (of_face == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    for (int face = 0; face < 6; face++)
    {
        fill_net(cells, (uint8_t)face, of_face);
        for (int level = 0; level < CM_CELL_BULGES; level++)
        {
            most[level] = fmax(most[level], bulge_of_level(of_face, level));
        }
    }
    for (int level = 0; level < CM_CELL_BULGES; level++)
    {
        cells->bulge[level] = 1.0 + 1.25 * (most[level] - 1.0) + 1e-3;
    }
    free(of_face);
    return CM_OK;
}
