/* SPDX-License-Identifier: MIT
 *
 * Cells as the S2 library rounds (kernel/s2.h): S2CellId of a point, its centre and its corners, to the bit. Sines,
 * cosines and arc tangents are the C library's there too.
 */
#include "cell_shape.h"
#include "libcubemap/mapping/exception_flags.h"

#include <string.h>

int cm_grid_has_s2_cells(const cm_grid *grid)
{
    const cm_mapping *mapping = cm_grid_mapping(grid);
    const cm_frame *frame = cm_mapping_frame(mapping);
    const cm_frame *wanted = cm_frame_find("s2");
    const cm_rotation *rotation = cm_grid_rotation(grid);
    int is_same =
        strcmp(cm_mapping_describe(mapping)->identifier, "s2") == 0 &&
        (cm_grid_latitude(grid) == CM_LATITUDE_GEOGRAPHIC || cm_grid_ellipsoid(grid)->f == 0.0);
    for (int i = 0; i < 6; i++)
    {
        is_same = is_same && frame->face[i].outward == wanted->face[i].outward &&
                  frame->face[i].u == wanted->face[i].u && frame->face[i].v == wanted->face[i].v;
    }
    for (int i = 0; i < 9; i++)
    {
        is_same = is_same && rotation->row[i / 3][i % 3] == (i % 4 == 0 ? 1.0 : 0.0);
    }
    return is_same;
}

/* n numbers, and zeros up to whole vectors. */
static void fill(double to[CM_BLOCK], const double *from, size_t n, size_t whole)
{
    memcpy(to, from, n * sizeof *to);
    memset(to + n, 0, (whole - n) * sizeof *to);
}

static size_t whole_vectors(const cm_cell_grid *cells, size_t n)
{
    size_t lanes = cells->set->lanes_f64;
    return (n + lanes - 1) / lanes * lanes;
}

void cm_s2_cells_of_block(const cm_cell_grid *cells, int level, size_t n, const double *x,
                          const double *y, const double *z, cm_cell *cell)
{
    const cm_exceptions held = cm_exceptions_hold();
    double a[CM_BLOCK], b[CM_BLOCK], c[CM_BLOCK];
    cm_cell block[CM_BLOCK];
    size_t whole = whole_vectors(cells, n);
    fill(a, x, n, whole);
    fill(b, y, n, whole);
    fill(c, z, n, whole);
    cells->set->cells->s2_forward(level, whole, a, b, c, block);
    memcpy(cell, block, n * sizeof *cell);
    cm_exceptions_restore(held);
}

void cm_s2_normals_of_block(const cm_cell_grid *cells, size_t n, const uint8_t *face,
                            const double *u, const double *v, double *x, double *y, double *z)
{
    const cm_exceptions held = cm_exceptions_hold();
    uint8_t on[CM_BLOCK] = {0};
    double a[CM_BLOCK], b[CM_BLOCK], d[3][CM_BLOCK];
    size_t whole = whole_vectors(cells, n);
    memcpy(on, face, n);
    fill(a, u, n, whole);
    fill(b, v, n, whole);
    cells->set->cells->s2_inverse(whole, on, a, b, d[0], d[1], d[2]);
    memcpy(x, d[0], n * sizeof *x);
    memcpy(y, d[1], n * sizeof *y);
    memcpy(z, d[2], n * sizeof *z);
    cm_exceptions_restore(held);
}

static void lonlat_of(const double direction[3], double lonlat[2])
{
    double x = direction[0];
    double y = direction[1];
    /* a zero of either sign is the same */
    lonlat[0] = atan2(y + 0.0, x + 0.0);
    lonlat[1] = atan2(direction[2] + 0.0, sqrt(x * x + y * y));
}

void cm_s2_lonlat(uint8_t face, const double uv[2], double lonlat[2])
{
    const cm_exceptions held = cm_exceptions_hold();
    cm_xyz_f64 d = cm_s2_library_unproject_f64(face, 0.5 * uv[0] + 0.5, 0.5 * uv[1] + 0.5);
    lonlat_of((const double[3]){d.x, d.y, d.z}, lonlat);
    cm_exceptions_restore(held);
}

void cm_s2_lonlat_of(const double direction[3], double lonlat[2])
{
    const cm_exceptions held = cm_exceptions_hold();
    lonlat_of(direction, lonlat);
    cm_exceptions_restore(held);
}
