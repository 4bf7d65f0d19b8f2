/* SPDX-License-Identifier: MIT
 *
 * Cell grids: points to cells, and where cells are.
 */
#include "cell_shape.h"
#include "libcubemap/batch/mapping_object.h"

#include <stdlib.h>
#include <string.h>

/* ---- Points ---- */

static size_t up_to_whole(const cm_cell_grid *cells, size_t n)
{
    size_t lanes = cells->set->lanes_f64;
    return (n + lanes - 1) / lanes * lanes;
}

/* The block's cells from its faces, u and v; what fills the last vector up has no face. */
static void cells_of_block(const cm_cell_grid *cells, int level, size_t n, uint8_t *face, double *u,
                           double *v, cm_cell *cell)
{
    cm_cell block[CM_BLOCK];
    size_t whole = up_to_whole(cells, n);
    for (size_t i = n; i < whole; i++)
    {
        face[i] = CM_NO_FACE;
        u[i] = v[i] = 0.0;
    }
    cells->set->cells->forward(cells->curve, level, whole, face, u, v, block);
    memcpy(cell, block, n * sizeof *cell);
}

static void no_cells(size_t n, cm_cell *cell)
{
    for (size_t i = 0; i < n; i++)
    {
        cell[i] = CM_NO_CELL;
    }
}

static int is_level(int level)
{
    return level >= 0 && level <= CM_CELL_LEVEL_MAX;
}

static size_t block_of(size_t n, size_t done)
{
    return n - done < CM_BLOCK ? n - done : CM_BLOCK;
}

void cm_cell_forward_array(const cm_cell_grid *cells, int level, size_t n, const double *x,
                           const double *y, const double *z, cm_cell *cell)
{
    if (!is_level(level))
    {
        no_cells(n, cell);
        return;
    }
    for (size_t done = 0; done < n; done += CM_BLOCK)
    {
        uint8_t face[CM_BLOCK];
        double u[CM_BLOCK], v[CM_BLOCK];
        size_t count = block_of(n, done);
        cm_grid_forward_array(cells->grid, count, x + done, y + done, z + done, face, u, v);
        cells_of_block(cells, level, count, face, u, v, cell + done);
    }
}

void cm_cell_forward_lonlat_array(const cm_cell_grid *cells, int level, size_t n, const double *lon,
                                  const double *lat, cm_cell *cell)
{
    if (!is_level(level))
    {
        no_cells(n, cell);
        return;
    }
    for (size_t done = 0; done < n; done += CM_BLOCK)
    {
        uint8_t face[CM_BLOCK];
        double u[CM_BLOCK], v[CM_BLOCK];
        size_t count = block_of(n, done);
        cm_grid_forward_lonlat_array(cells->grid, count, lon + done, lat + done, face, u, v);
        cells_of_block(cells, level, count, face, u, v, cell + done);
    }
}

/* Single points need no vector: whole numbers are the same in every set. */
static cm_cell cell_of_place(const cm_cell_grid *cells, int level, uint8_t face, const double uv[2])
{
    cm_cell cell = CM_NO_CELL;
    if (is_level(level))
    {
        cm_batch_scalar.cells->forward(cells->curve, level, 1, &face, &uv[0], &uv[1], &cell);
    }
    return cell;
}

cm_cell cm_cell_forward(const cm_cell_grid *cells, int level, const double normal[3])
{
    double uv[2];
    uint8_t face = cm_grid_forward(cells->grid, normal, uv);
    return cell_of_place(cells, level, face, uv);
}

cm_cell cm_cell_forward_lonlat(const cm_cell_grid *cells, int level, double lon, double lat)
{
    double uv[2];
    uint8_t face = cm_grid_forward_lonlat(cells->grid, lon, lat, uv);
    return cell_of_place(cells, level, face, uv);
}

/* ---- Centres ---- */

/* Faces, u and v of the middles of a block of cells; CM_NO_FACE and NaN for what is none. */
static void middles_of_block(const cm_cell_grid *cells, size_t n, const cm_cell *cell,
                             uint8_t *face, double *u, double *v)
{
    cm_cell block[CM_BLOCK];
    size_t whole = up_to_whole(cells, n);
    for (size_t i = 0; i < whole; i++)
    {
        block[i] = i < n && cm_cell_is_valid(cell[i]) ? cell[i] : 1;
    }
    cells->set->cells->centre(cells->curve, whole, block, face, u, v);
    for (size_t i = 0; i < n; i++)
    {
        if (!cm_cell_is_valid(cell[i]))
        {
            face[i] = CM_NO_FACE;
            u[i] = v[i] = (double)NAN;
        }
    }
}

void cm_cell_centre_array(const cm_cell_grid *cells, size_t n, const cm_cell *cell, double *x,
                          double *y, double *z)
{
    for (size_t done = 0; done < n; done += CM_BLOCK)
    {
        uint8_t face[CM_BLOCK];
        double u[CM_BLOCK], v[CM_BLOCK];
        size_t count = block_of(n, done);
        middles_of_block(cells, count, cell + done, face, u, v);
        cm_grid_inverse_array(cells->grid, count, face, u, v, x + done, y + done, z + done);
    }
}

void cm_cell_centre_lonlat_array(const cm_cell_grid *cells, size_t n, const cm_cell *cell,
                                 double *lon, double *lat)
{
    for (size_t done = 0; done < n; done += CM_BLOCK)
    {
        uint8_t face[CM_BLOCK];
        double u[CM_BLOCK], v[CM_BLOCK];
        size_t count = block_of(n, done);
        middles_of_block(cells, count, cell + done, face, u, v);
        cm_grid_inverse_lonlat_array(cells->grid, count, face, u, v, lon + done, lat + done);
    }
}

static uint8_t middle_of(const cm_cell_grid *cells, cm_cell cell, double uv[2])
{
    uint8_t face = CM_NO_FACE;
    uv[0] = uv[1] = (double)NAN;
    if (cm_cell_is_valid(cell))
    {
        cm_batch_scalar.cells->centre(cells->curve, 1, &cell, &face, &uv[0], &uv[1]);
    }
    return face;
}

void cm_cell_centre(const cm_cell_grid *cells, cm_cell cell, double normal[3])
{
    double uv[2];
    uint8_t face = middle_of(cells, cell, uv);
    cm_grid_inverse(cells->grid, face, uv, normal);
}

void cm_cell_centre_lonlat(const cm_cell_grid *cells, cm_cell cell, double lonlat[2])
{
    double uv[2];
    uint8_t face = middle_of(cells, cell, uv);
    cm_grid_inverse_lonlat(cells->grid, face, uv, lonlat);
}

/* ---- Corners ---- */

/* The corners' places on the face, and the middle as the fifth; CM_NO_FACE for what is no cell. */
static void places_of(const cm_cell_grid *cells, cm_cell cell, uint8_t face[5], double u[5],
                      double v[5])
{
    double low[2] = {(double)NAN, (double)NAN};
    double high[2] = {(double)NAN, (double)NAN};
    uint8_t on = CM_NO_FACE;
    cm_cell_square(cells->curve, cell, &on, low, high);
    for (int k = 0; k < 5; k++)
    {
        face[k] = on;
        u[k] = k == 4 ? 0.5 * (low[0] + high[0]) : k == 1 || k == 2 ? high[0] : low[0];
        v[k] = k == 4 ? 0.5 * (low[1] + high[1]) : k >= 2 ? high[1] : low[1];
    }
}

void cm_cell_normals(const cm_cell_grid *cells, cm_cell cell, double normal[5][3])
{
    uint8_t face[5];
    double u[5], v[5], x[5], y[5], z[5];
    places_of(cells, cell, face, u, v);
    cm_grid_inverse_array(cells->grid, 5, face, u, v, x, y, z);
    for (int k = 0; k < 5; k++)
    {
        normal[k][0] = x[k];
        normal[k][1] = y[k];
        normal[k][2] = z[k];
    }
}

void cm_cell_corners(const cm_cell_grid *cells, cm_cell cell, double normal[4][3])
{
    double all[5][3];
    cm_cell_normals(cells, cell, all);
    memcpy(normal, all, 4 * sizeof all[0]);
}

void cm_cell_corners_lonlat(const cm_cell_grid *cells, cm_cell cell, double lonlat[4][2])
{
    uint8_t face[5];
    double u[5], v[5], lon[4], lat[4];
    places_of(cells, cell, face, u, v);
    cm_grid_inverse_lonlat_array(cells->grid, 4, face, u, v, lon, lat);
    for (int k = 0; k < 4; k++)
    {
        lonlat[k][0] = lon[k];
        lonlat[k][1] = lat[k];
    }
}

/* ---- Caps ---- */

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

/* Points along an edge; fewer where cells are more. */
static const int points_along[CM_CELL_BULGES] = {64, 32, 16, 8, 8};

/* By what factor the edges of a cell, at so many points of each, are further from the centre than its
 * corners. */
static double bulge_of(const cm_cell_grid *cells, cm_cell cell, int steps)
{
    double normal[5][3];
    uint8_t face[CM_BLOCK];
    double u[CM_BLOCK], v[CM_BLOCK], x[CM_BLOCK], y[CM_BLOCK], z[CM_BLOCK];
    double low[2], high[2];
    double most = 0.0;
    int at = 0;
    uint8_t on = 0;
    cm_cell_normals(cells, cell, normal);
    cm_cell_square(cells->curve, cell, &on, low, high);
    for (int k = 0; k < 4 * steps; k++)
    {
        int side = k / steps;
        double t = (k % steps + 0.5) / steps;
        face[k] = on;
        u[k] = side == 1 ? high[0] : side == 3 ? low[0] : low[0] + t * (high[0] - low[0]);
        v[k] = side == 0 ? low[1] : side == 2 ? high[1] : low[1] + t * (high[1] - low[1]);
    }
    cm_grid_inverse_array(cells->grid, 4 * (size_t)steps, face, u, v, x, y, z);
    for (int k = 0; k < 4 * steps; k++)
    {
        double square = chord_squared((const double[3]){x[k], y[k], z[k]}, normal[4]);
        at = square > most ? k : at;
        most = fmax(most, square);
    }
    return cm_angle((const double[3]){x[at], y[at], z[at]}, normal[4]) / reach_of(normal);
}

/* What is missed between the points, and on finer levels, is less than the quarter that is added. */
static void measure_bulges(cm_cell_grid *cells)
{
    for (int level = 0; level < CM_CELL_BULGES; level++)
    {
        double most = 1.0;
        for (uint64_t index = 0; index < 6ull << (2 * level); index++)
        {
            most = fmax(most, bulge_of(cells, cm_cell_at_index(level, index), points_along[level]));
        }
        cells->bulge[level] = 1.0 + 1.25 * (most - 1.0) + 1e-3;
    }
}

/* ---- Life ---- */

cm_status cm_cell_grid_create(const cm_grid *grid, cm_curve curve, cm_cell_grid **cells)
{
    if (grid == NULL || cells == NULL || !cm_curve_is_valid(curve))
    {
        return CM_ERROR_ARGUMENT;
    }
    const cm_mapping *mapping = cm_grid_mapping(grid);
    if (cm_mapping_describe(mapping)->kind != CM_KIND_CUBE)
    {
        return CM_ERROR_UNSUPPORTED;
    }
    cm_cell_grid *made = calloc(1, sizeof *made);
    if (made == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    made->grid = grid;
    made->curve = curve;
    made->set = mapping->set;
    measure_bulges(made);
    *cells = made;
    return CM_OK;
}

void cm_cell_grid_destroy(cm_cell_grid *cells)
{
    free(cells);
}

const cm_grid *cm_cell_grid_of(const cm_cell_grid *cells)
{
    return cells->grid;
}

cm_curve cm_cell_grid_curve(const cm_cell_grid *cells)
{
    return cells->curve;
}
