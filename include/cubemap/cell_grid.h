/* SPDX-License-Identifier: MIT
 *
 * Cells on the Earth: which cell a point is in, where a cell is, its neighbours, its area. A grid (grid.h) says where
 * the faces are, a curve (cell.h) how their cells are numbered.
 *
 *   point       the normal of the ellipsoid, of any length, or geographic longitude and latitude in
 *               radians, as in grid.h. What is no point is in CM_NO_CELL, and what is no cell has the centre
 *               NaN, NaN, NaN
 *   ties        a point goes to the face, u and v that the grid finds. On a face i is the whole part of
 *               2^level (u + 1) / 2, computed without rounding, and 2^level - 1 where u = 1; j and v likewise
 *   threads     a cell grid is constant after its creation: any number of threads may use one
 *   results     the same input gives the same bits whatever n, the position in the array and the thread
 *
 * docs/guide/cells.md shows their use, docs/measured/accuracy.md and costs.md have bounds and times.
 */
#ifndef CUBEMAP_CELL_GRID_H
#define CUBEMAP_CELL_GRID_H

#include <stddef.h>
#include <stdint.h>

#include <cubemap/cell.h>
#include <cubemap/export.h>
#include <cubemap/grid.h>
#include <cubemap/status.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The cells of a grid, from cm_cell_grid_create to cm_cell_grid_destroy. */
typedef struct cm_cell_grid cm_cell_grid;

/* The grid is not copied and must live as long. Some 30 000 points are computed to learn how round the grid's
 * cells are (cm_cell_bounding_cap).
 * CM_OK; CM_ERROR_ARGUMENT (NULL, or no curve), CM_ERROR_UNSUPPORTED (a mapping that does not have six faces),
 * CM_ERROR_MEMORY. */
CM_API cm_status cm_cell_grid_create(const cm_grid *grid, cm_curve curve, cm_cell_grid **cells);

/* Cells of the S2 library, to the bit: a point is in the cell that S2CellId gives it, centres and corners are those of
 * S2Cell, and what is given in longitude and latitude is S2LatLng's, as far as the C library's sines are the same. So
 * at a tie the last of x, y, z wins a face and not the first, and a point within rounding of an edge is where S2's
 * rounding has it. What makes no cell here, NaN or the zero vector, makes none.
 * The grid has the mapping s2 in the frame s2, on a sphere or with geographic latitude, and is not rotated.
 * CM_OK; CM_ERROR_ARGUMENT (NULL), CM_ERROR_UNSUPPORTED (another grid), CM_ERROR_MEMORY. */
CM_API cm_status cm_cell_grid_create_s2(const cm_grid *grid, cm_cell_grid **cells);

/* NULL is allowed. */
CM_API void cm_cell_grid_destroy(cm_cell_grid *cells);

/* What it was made from. */
CM_API const cm_grid *cm_cell_grid_of(const cm_cell_grid *cells);
CM_API cm_curve cm_cell_grid_curve(const cm_cell_grid *cells);

/* Was it made by cm_cell_grid_create_s2? 1 or 0. */
CM_API int cm_cell_grid_is_s2(const cm_cell_grid *cells);

/* ---- Points and cells; cells must not be NULL here and below ---- */

/* The cell of that level at a point; CM_NO_CELL if there is none, or no such level. */
CM_API cm_cell cm_cell_forward(const cm_cell_grid *cells, int level, const double normal[3]);
CM_API cm_cell cm_cell_forward_lonlat(const cm_cell_grid *cells, int level, double lon, double lat);

/* The same of n points, by vectors. Arrays may be NULL if n is 0; the output may be one of the
 * inputs. */
CM_API void cm_cell_forward_array(const cm_cell_grid *cells, int level, size_t n, const double *x,
                                  const double *y, const double *z, cm_cell *cell);
CM_API void cm_cell_forward_lonlat_array(const cm_cell_grid *cells, int level, size_t n,
                                         const double *lon, const double *lat, cm_cell *cell);

/* The point in the middle of a cell's u and v; the normal has length 1. The n cells may be of several levels. */
CM_API void cm_cell_centre(const cm_cell_grid *cells, cm_cell cell, double normal[3]);
CM_API void cm_cell_centre_lonlat(const cm_cell_grid *cells, cm_cell cell, double lonlat[2]);
CM_API void cm_cell_centre_array(const cm_cell_grid *cells, size_t n, const cm_cell *cell,
                                 double *x, double *y, double *z);
CM_API void cm_cell_centre_lonlat_array(const cm_cell_grid *cells, size_t n, const cm_cell *cell,
                                        double *lon, double *lat);

/* The corners, in the order of u and v: low low, high low, high high, low high. With right-handed axes that is
 * anticlockwise seen from outside, in the frame gl clockwise. */
CM_API void cm_cell_corners(const cm_cell_grid *cells, cm_cell cell, double normal[4][3]);
CM_API void cm_cell_corners_lonlat(const cm_cell_grid *cells, cm_cell cell, double lonlat[4][2]);

/* A cap, about the cell's centre, that has the whole cell in it: every point of the cell has a normal at an
 * angle of no more than radius from that of the centre. It is what the corners are away from the centre, and
 * more by what the edges of cells of that level bulge, which has been measured on the grid's cells of levels 0
 * to 4, and a quarter more of that. NaN for what is no cell. */
CM_API void cm_cell_bounding_cap(const cm_cell_grid *cells, cm_cell cell, double normal[3],
                                 double *radius);

/* The surface of the cell on the ellipsoid, in square metres; NaN for none. If the mapping is equal-area and
 * the grid's latitude authalic, it is the ellipsoid's surface divided by 6 4^level. Else it is integrated
 * from cm_grid_area_element, adaptively. */
CM_API double cm_cell_area(const cm_cell_grid *cells, cm_cell cell);

/* ---- Neighbours, across the edges and corners of faces too. The frame says which they are ---- */

/* The cells of the same level beyond the edges of low v, high u, high v and low u, in that order. 4; 0 for no
 * cell, and then to is untouched. With mappings that are torn along edges of faces, neighbours there do
 * not quite touch. */
CM_API int cm_cell_edge_neighbours(const cm_cell_grid *cells, cm_cell cell, cm_cell to[4]);

/* All cells of the same level that have an edge or a corner in common with the cell, anticlockwise in u and
 * v from low u, low v, those of the corners where they come. 8, beside a corner of the cube 7, of a face 4; 0
 * for no cell. */
CM_API int cm_cell_neighbours(const cm_cell_grid *cells, cm_cell cell, cm_cell to[8]);

/* The same of a finer level: all cells of it that touch the cell from outside, anticlockwise from low u, low v.
 * CM_OK; CM_ERROR_ARGUMENT (a pointer is NULL, to with a capacity above 0), CM_ERROR_CELL (no cell, or a level
 * that is none or above the cell's), CM_ERROR_SPACE (more than the capacity): then *count is how many there
 * are, and to is untouched. They are 4 2^(level - the cell's level) and those of four corners at most, three in
 * a corner of the cube. */
CM_API cm_status cm_cell_neighbours_at(const cm_cell_grid *cells, cm_cell cell, int level,
                                       size_t capacity, cm_cell *to, size_t *count);

#ifdef __cplusplus
}
#endif

#endif
