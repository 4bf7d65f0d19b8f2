/* SPDX-License-Identifier: MIT
 *
 * Cell grids: points to cells, and where cells are.
 */
#include "cell_shape.h"
#include "libcubemap/batch/mapping_object.h"
#include "libcubemap/mapping/exception_flags.h"

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
    const cm_exceptions held = cm_exceptions_hold();
    cm_cell block[CM_BLOCK];
    size_t whole = up_to_whole(cells, n);
    for (size_t i = n; i < whole; i++)
    {
        face[i] = CM_NO_FACE;
        u[i] = v[i] = 0.0;
    }
    cells->set->cells->forward(cells->curve, level, whole, face, u, v, block);
    memcpy(cell, block, n * sizeof *cell);
    cm_exceptions_restore(held);
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
        size_t count = block_of(n, done);
        if (cells->is_s2)
        {
            cm_s2_cells_of_block(cells, level, count, x + done, y + done, z + done, cell + done);
        }
        else
        {
            uint8_t face[CM_BLOCK];
            double u[CM_BLOCK], v[CM_BLOCK];
            cm_grid_forward_array(cells->grid, count, x + done, y + done, z + done, face, u, v);
            cells_of_block(cells, level, count, face, u, v, cell + done);
        }
    }
}

/* By the C library's sines and cosines, as S2LatLng::ToPoint. */
static void s2_cells_of_lonlats(const cm_cell_grid *cells, int level, size_t n, const double *lon,
                                const double *lat, cm_cell *cell)
{
    const cm_exceptions held = cm_exceptions_hold();
    double x[CM_BLOCK], y[CM_BLOCK], z[CM_BLOCK];
    for (size_t i = 0; i < n; i++)
    {
        double direction[3];
        cm_direction_from_lonlat(lon[i], lat[i], direction);
        x[i] = direction[0];
        y[i] = direction[1];
        z[i] = direction[2];
    }
    cm_s2_cells_of_block(cells, level, n, x, y, z, cell);
    cm_exceptions_restore(held);
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
        size_t count = block_of(n, done);
        if (cells->is_s2)
        {
            s2_cells_of_lonlats(cells, level, count, lon + done, lat + done, cell + done);
        }
        else
        {
            uint8_t face[CM_BLOCK];
            double u[CM_BLOCK], v[CM_BLOCK];
            cm_grid_forward_lonlat_array(cells->grid, count, lon + done, lat + done, face, u, v);
            cells_of_block(cells, level, count, face, u, v, cell + done);
        }
    }
}

/* Single points need no vector: whole numbers are the same in every set. */
static cm_cell cell_of_place(const cm_cell_grid *cells, int level, uint8_t face, const double uv[2])
{
    cm_cell cell = CM_NO_CELL;
    if (is_level(level))
    {
        const cm_exceptions held = cm_exceptions_hold();
        CM_BATCH_PLAIN.cells->forward(cells->curve, level, 1, &face, &uv[0], &uv[1], &cell);
        cm_exceptions_restore(held);
    }
    return cell;
}

/* It rounds alike in every set. */
static cm_cell s2_cell_of(int level, const double d[3])
{
    cm_cell cell = CM_NO_CELL;
    if (is_level(level))
    {
        const cm_exceptions held = cm_exceptions_hold();
        CM_BATCH_PLAIN.cells->s2_forward(level, 1, &d[0], &d[1], &d[2], &cell);
        cm_exceptions_restore(held);
    }
    return cell;
}

cm_cell cm_cell_forward(const cm_cell_grid *cells, int level, const double normal[3])
{
    double uv[2];
    if (cells->is_s2)
    {
        return s2_cell_of(level, normal);
    }
    uint8_t face = cm_grid_forward(cells->grid, normal, uv);
    return cell_of_place(cells, level, face, uv);
}

cm_cell cm_cell_forward_lonlat(const cm_cell_grid *cells, int level, double lon, double lat)
{
    double uv[2];
    if (cells->is_s2)
    {
        double direction[3];
        cm_direction_from_lonlat(lon, lat, direction);
        return s2_cell_of(level, direction);
    }
    uint8_t face = cm_grid_forward_lonlat(cells->grid, lon, lat, uv);
    return cell_of_place(cells, level, face, uv);
}

/* ---- Centres ---- */

/* Faces, u and v of the middles of a block of cells; CM_NO_FACE and NaN for what is none. */
static void middles_of_block(const cm_cell_grid *cells, size_t n, const cm_cell *cell,
                             uint8_t *face, double *u, double *v)
{
    const cm_exceptions held = cm_exceptions_hold();
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
    cm_exceptions_restore(held);
}

void cm_cell_normals_at(const cm_cell_grid *cells, size_t n, const uint8_t *face, const double *u,
                        const double *v, double *x, double *y, double *z)
{
    if (cells->is_s2)
    {
        cm_s2_normals_of_block(cells, n, face, u, v, x, y, z);
    }
    else
    {
        cm_grid_inverse_array(cells->grid, n, face, u, v, x, y, z);
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
        cm_cell_normals_at(cells, count, face, u, v, x + done, y + done, z + done);
    }
}

static void s2_lonlats_of_places(size_t n, const uint8_t *face, const double *u, const double *v,
                                 double *lon, double *lat)
{
    for (size_t i = 0; i < n; i++)
    {
        double lonlat[2];
        cm_s2_lonlat(face[i], (const double[2]){u[i], v[i]}, lonlat);
        lon[i] = lonlat[0];
        lat[i] = lonlat[1];
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
        if (cells->is_s2)
        {
            s2_lonlats_of_places(count, face, u, v, lon + done, lat + done);
        }
        else
        {
            cm_grid_inverse_lonlat_array(cells->grid, count, face, u, v, lon + done, lat + done);
        }
    }
}

static uint8_t middle_of(const cm_cell_grid *cells, cm_cell cell, double uv[2])
{
    uint8_t face = CM_NO_FACE;
    uv[0] = uv[1] = (double)NAN;
    if (cm_cell_is_valid(cell))
    {
        const cm_exceptions held = cm_exceptions_hold();
        CM_BATCH_PLAIN.cells->centre(cells->curve, 1, &cell, &face, &uv[0], &uv[1]);
        cm_exceptions_restore(held);
    }
    return face;
}

void cm_cell_centre(const cm_cell_grid *cells, cm_cell cell, double normal[3])
{
    double uv[2];
    uint8_t face = middle_of(cells, cell, uv);
    cm_cell_normals_at(cells, 1, &face, &uv[0], &uv[1], &normal[0], &normal[1], &normal[2]);
}

void cm_cell_centre_lonlat(const cm_cell_grid *cells, cm_cell cell, double lonlat[2])
{
    double uv[2];
    uint8_t face = middle_of(cells, cell, uv);
    if (cells->is_s2)
    {
        cm_s2_lonlat(face, uv, lonlat);
    }
    else
    {
        cm_grid_inverse_lonlat(cells->grid, face, uv, lonlat);
    }
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
    cm_cell_normals_at(cells, 5, face, u, v, x, y, z);
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
    if (cells->is_s2)
    {
        double normal[4][3];
        cm_cell_corners(cells, cell, normal);
        for (int k = 0; k < 4; k++)
        {
            cm_s2_lonlat_of(normal[k], lonlat[k]);
        }
        return;
    }
    places_of(cells, cell, face, u, v);
    cm_grid_inverse_lonlat_array(cells->grid, 4, face, u, v, lon, lat);
    for (int k = 0; k < 4; k++)
    {
        lonlat[k][0] = lon[k];
        lonlat[k][1] = lat[k];
    }
}

/* ---- Life ---- */

static cm_status create(const cm_grid *grid, cm_curve curve, int is_s2, cm_cell_grid **cells)
{
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
    made->is_s2 = is_s2;
    made->set = mapping->set;
    cm_status status = cm_cell_measure_bulges(made);
    if (status != CM_OK)
    {
        free(made);
        return status;
    }
    *cells = made;
    return CM_OK;
}

cm_status cm_cell_grid_create(const cm_grid *grid, cm_curve curve, cm_cell_grid **cells)
{
    if (grid == NULL || cells == NULL || !cm_curve_is_valid(curve))
    {
        return CM_ERROR_ARGUMENT;
    }
    return create(grid, curve, 0, cells);
}

cm_status cm_cell_grid_create_s2(const cm_grid *grid, cm_cell_grid **cells)
{
    if (grid == NULL || cells == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    return cm_grid_has_s2_cells(grid) ? create(grid, CM_CURVE_HILBERT, 1, cells)
                                      : CM_ERROR_UNSUPPORTED;
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

int cm_cell_grid_is_s2(const cm_cell_grid *cells)
{
    return cells->is_s2;
}
