/* SPDX-License-Identifier: MIT
 *
 * Grids: ellipsoid, auxiliary latitude, rotation and mapping in a row.
 */
#include <cubemap/cubemap.h>
#include <cubemap/kernels.h>

#include "lonlat_block.h"
#include "grid_object.h"
#include "libcubemap/mapping/exception_flags.h"

#include <stdlib.h>
#include <string.h>

/* ---- Life ---- */

/* What keeps the mapping's property on the ellipsoid, and areas as far as it can where it has none. */
static cm_latitude latitude_for(const cm_mapping *mapping)
{
    return cm_mapping_describe(mapping)->properties & CM_CONFORMAL ? CM_LATITUDE_CONFORMAL
                                                                   : CM_LATITUDE_AUTHALIC;
}

static cm_status take_options(cm_grid *grid, const cm_grid_options *options)
{
    const cm_ellipsoid *ellipsoid =
        options->ellipsoid != NULL ? options->ellipsoid : cm_ellipsoid_find("WGS84");
    cm_status status = cm_ellipsoid_check(ellipsoid);
    if (status != CM_OK)
    {
        return status;
    }
    grid->ellipsoid = *ellipsoid;
    if (options->latitude != NULL && cm_latitude_name(*options->latitude) == NULL)
    {
        return CM_ERROR_LATITUDE;
    }
    grid->rotation = (cm_rotation){{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
    if (options->rotation != NULL)
    {
        cm_rotation none = grid->rotation;
        grid->rotation = *options->rotation;
        grid->is_rotated = memcmp(&none, &grid->rotation, sizeof none) != 0;
        return cm_rotation_check(options->rotation);
    }
    return CM_OK;
}

static cm_status make_conversions(cm_grid *grid, const cm_grid_options *options)
{
    cm_latitude_options how = {.size = sizeof how,
                               .tolerance = options->tolerance,
                               .instructions = cm_mapping_instructions(grid->mapping)};
    cm_status status = CM_OK;
    if (grid->latitude != CM_LATITUDE_GEOGRAPHIC && grid->ellipsoid.f != 0.0)
    {
        status = cm_latitude_conversion_create(&grid->ellipsoid, CM_LATITUDE_GEOGRAPHIC,
                                               grid->latitude, &how, &grid->there);
        if (status == CM_OK)
        {
            status = cm_latitude_conversion_create(&grid->ellipsoid, grid->latitude,
                                                   CM_LATITUDE_GEOGRAPHIC, &how, &grid->back);
        }
    }
    return status;
}

cm_status cm_grid_create(const cm_grid_options *options, cm_grid **grid)
{
    static const cm_grid_options standard = {.size = sizeof standard};
    const cm_grid_options *wanted = options != NULL ? options : &standard;
    if (grid == NULL || wanted->size != sizeof *wanted)
    {
        return CM_ERROR_ARGUMENT;
    }
    cm_grid *made = calloc(1, sizeof *made);
    if (made == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    cm_status status = take_options(made, wanted);
    if (status == CM_OK)
    {
        status = cm_mapping_create_with(wanted->mapping != NULL ? wanted->mapping
                                                                : CM_MAPPING_RECOMMENDED,
                                        wanted->frame, wanted->options, &made->mapping);
    }
    if (status == CM_OK && cm_mapping_describe(made->mapping)->kind == CM_KIND_DISC_SQUARE)
    {
        status = CM_ERROR_UNSUPPORTED;
    }
    if (status == CM_OK)
    {
        made->latitude = wanted->latitude != NULL ? *wanted->latitude : latitude_for(made->mapping);
        status = make_conversions(made, wanted);
    }
    if (status != CM_OK)
    {
        cm_grid_destroy(made);
        return status;
    }
    *grid = made;
    return CM_OK;
}

void cm_grid_destroy(cm_grid *grid)
{
    if (grid != NULL)
    {
        cm_latitude_conversion_destroy(grid->there);
        cm_latitude_conversion_destroy(grid->back);
        cm_mapping_destroy(grid->mapping);
        free(grid);
    }
}

const cm_mapping *cm_grid_mapping(const cm_grid *grid)
{
    return grid->mapping;
}

const cm_ellipsoid *cm_grid_ellipsoid(const cm_grid *grid)
{
    return &grid->ellipsoid;
}

cm_latitude cm_grid_latitude(const cm_grid *grid)
{
    return grid->latitude;
}

const cm_rotation *cm_grid_rotation(const cm_grid *grid)
{
    return &grid->rotation;
}

/* ---- Points, CM_BLOCK at most ---- */

/* A few numbers at a time, which compilers make vectors of. The rows are multiplied in the same order for
 * every point. */
static void turn_by(const cm_rotation *rotation, size_t n, double *restrict x, double *restrict y,
                    double *restrict z)
{
    const cm_rotation r = *rotation;
    for (size_t i = 0; i < n; i++)
    {
        double a = x[i];
        double b = y[i];
        double c = z[i];
        x[i] = (r.row[0][0] * a + r.row[0][1] * b) + r.row[0][2] * c;
        y[i] = (r.row[1][0] * a + r.row[1][1] * b) + r.row[1][2] * c;
        z[i] = (r.row[2][0] * a + r.row[2][1] * b) + r.row[2][2] * c;
    }
}

/* Very long and very short vectors are scaled, so that sums neither overflow nor lose digits. */
static void bring_near_one(size_t n, double *restrict x, double *restrict y, double *restrict z)
{
    for (size_t i = 0; i < n; i++)
    {
        double size = fabs(x[i]) + fabs(y[i]) + fabs(z[i]);
        double scale = size > 0x1p500 ? 0x1p-600 : size < 0x1p-500 ? 0x1p600 : 1.0;
        x[i] *= scale;
        y[i] *= scale;
        z[i] *= scale;
    }
}

static void turn(const cm_grid *grid, size_t n, double *x, double *y, double *z)
{
    if (grid->is_rotated)
    {
        if (grid->there == NULL)
        {
            bring_near_one(n, x, y, z);
        }
        turn_by(&grid->rotation, n, x, y, z);
    }
}

static void turn_back(const cm_grid *grid, size_t n, double *x, double *y, double *z)
{
    if (grid->is_rotated)
    {
        cm_rotation transposed;
        for (int i = 0; i < 3; i++)
        {
            for (int k = 0; k < 3; k++)
            {
                transposed.row[i][k] = grid->rotation.row[k][i];
            }
        }
        turn_by(&transposed, n, x, y, z);
    }
}

/* From normals to directions of the mapping's sphere, in place, and back. */
static void to_sphere(const cm_grid *grid, size_t n, double *x, double *y, double *z)
{
    if (grid->there != NULL)
    {
        cm_latitude_convert_direction_array(grid->there, n, x, y, z, x, y, z);
    }
    turn(grid, n, x, y, z);
}

/* From directions of length 1. */
static void from_unit_sphere(const cm_grid *grid, size_t n, double *x, double *y, double *z)
{
    turn_back(grid, n, x, y, z);
    if (grid->back != NULL)
    {
        cm_latitude_convert_direction_array(grid->back, n, x, y, z, x, y, z);
    }
}

static void from_sphere(const cm_grid *grid, size_t n, double *x, double *y, double *z)
{
    if (grid->is_rotated)
    {
        bring_near_one(n, x, y, z);
    }
    from_unit_sphere(grid, n, x, y, z);
}

/* Normals are overwritten. */
static void forward_block(const cm_grid *grid, size_t n, double *x, double *y, double *z,
                          uint8_t *face, double *u, double *v)
{
    to_sphere(grid, n, x, y, z);
    cm_forward_array(grid->mapping, n, x, y, z, face, u, v);
}

static void inverse_block(const cm_grid *grid, size_t n, const uint8_t *face, const double *u,
                          const double *v, double *x, double *y, double *z)
{
    cm_inverse_array(grid->mapping, n, face, u, v, x, y, z);
    from_unit_sphere(grid, n, x, y, z);
}

static size_t block_of(size_t n, size_t done)
{
    return n - done < CM_BLOCK ? n - done : CM_BLOCK;
}

/* ---- Arrays ---- */

/* Vectors are copied to a block, so that results may overwrite any argument. */
static void move_blocks(const cm_grid *grid,
                        void (*move)(const cm_grid *grid, size_t n, double *x, double *y,
                                     double *z),
                        size_t n, const double *const from[3], double *const to[3])
{
    const cm_exceptions held = cm_exceptions_hold();
    for (size_t done = 0; done < n; done += CM_BLOCK)
    {
        double at[3][CM_BLOCK];
        size_t count = block_of(n, done);
        for (int i = 0; i < 3; i++)
        {
            memcpy(at[i], from[i] + done, count * sizeof at[i][0]);
        }
        move(grid, count, at[0], at[1], at[2]);
        for (int i = 0; i < 3; i++)
        {
            memcpy(to[i] + done, at[i], count * sizeof at[i][0]);
        }
    }
    cm_exceptions_restore(held);
}

void cm_grid_to_sphere_array(const cm_grid *grid, size_t n, const double *x, const double *y,
                             const double *z, double *to_x, double *to_y, double *to_z)
{
    move_blocks(grid, to_sphere, n, (const double *const[3]){x, y, z},
                (double *const[3]){to_x, to_y, to_z});
}

void cm_grid_from_sphere_array(const cm_grid *grid, size_t n, const double *x, const double *y,
                               const double *z, double *to_x, double *to_y, double *to_z)
{
    move_blocks(grid, from_sphere, n, (const double *const[3]){x, y, z},
                (double *const[3]){to_x, to_y, to_z});
}

void cm_grid_forward_array(const cm_grid *grid, size_t n, const double *x, const double *y,
                           const double *z, uint8_t *face, double *u, double *v)
{
    const cm_exceptions held = cm_exceptions_hold();
    for (size_t done = 0; done < n; done += CM_BLOCK)
    {
        double a[CM_BLOCK], b[CM_BLOCK], c[CM_BLOCK];
        size_t count = block_of(n, done);
        memcpy(a, x + done, count * sizeof *a);
        memcpy(b, y + done, count * sizeof *b);
        memcpy(c, z + done, count * sizeof *c);
        forward_block(grid, count, a, b, c, face + done, u + done, v + done);
    }
    cm_exceptions_restore(held);
}

void cm_grid_inverse_array(const cm_grid *grid, size_t n, const uint8_t *face, const double *u,
                           const double *v, double *x, double *y, double *z)
{
    const cm_exceptions held = cm_exceptions_hold();
    for (size_t done = 0; done < n; done += CM_BLOCK)
    {
        inverse_block(grid, block_of(n, done), face + done, u + done, v + done, x + done, y + done,
                      z + done);
    }
    cm_exceptions_restore(held);
}

void cm_grid_forward_lonlat_array(const cm_grid *grid, size_t n, const double *lon,
                                  const double *lat, uint8_t *face, double *u, double *v)
{
    const cm_exceptions held = cm_exceptions_hold();
    for (size_t done = 0; done < n; done += CM_BLOCK)
    {
        double x[CM_BLOCK], y[CM_BLOCK], z[CM_BLOCK];
        size_t count = block_of(n, done);
        cm_block_of_lonlats(grid->mapping->set, count, lon + done, lat + done, x, y, z);
        forward_block(grid, count, x, y, z, face + done, u + done, v + done);
    }
    cm_exceptions_restore(held);
}

void cm_grid_inverse_lonlat_array(const cm_grid *grid, size_t n, const uint8_t *face,
                                  const double *u, const double *v, double *lon, double *lat)
{
    const cm_exceptions held = cm_exceptions_hold();
    for (size_t done = 0; done < n; done += CM_BLOCK)
    {
        double x[CM_BLOCK], y[CM_BLOCK], z[CM_BLOCK];
        size_t count = block_of(n, done);
        inverse_block(grid, count, face + done, u + done, v + done, x, y, z);
        cm_block_to_lonlats(grid->mapping->set, count, x, y, z, lon + done, lat + done);
    }
    cm_exceptions_restore(held);
}

/* ---- Single points: the same instructions ---- */

void cm_grid_to_sphere(const cm_grid *grid, const double normal[3], double direction[3])
{
    const cm_exceptions held = cm_exceptions_hold();
    double d[3] = {normal[0], normal[1], normal[2]};
    to_sphere(grid, 1, &d[0], &d[1], &d[2]);
    memcpy(direction, d, sizeof d);
    cm_exceptions_restore(held);
}

void cm_grid_from_sphere(const cm_grid *grid, const double direction[3], double normal[3])
{
    const cm_exceptions held = cm_exceptions_hold();
    double d[3] = {direction[0], direction[1], direction[2]};
    from_sphere(grid, 1, &d[0], &d[1], &d[2]);
    memcpy(normal, d, sizeof d);
    cm_exceptions_restore(held);
}

uint8_t cm_grid_forward(const cm_grid *grid, const double normal[3], double uv[2])
{
    const cm_exceptions held = cm_exceptions_hold();
    uint8_t face;
    double d[3] = {normal[0], normal[1], normal[2]};
    forward_block(grid, 1, &d[0], &d[1], &d[2], &face, &uv[0], &uv[1]);
    cm_exceptions_restore(held);
    return face;
}

void cm_grid_inverse(const cm_grid *grid, uint8_t face, const double uv[2], double normal[3])
{
    const cm_exceptions held = cm_exceptions_hold();
    double at[2] = {uv[0], uv[1]};
    inverse_block(grid, 1, &face, &at[0], &at[1], &normal[0], &normal[1], &normal[2]);
    cm_exceptions_restore(held);
}

uint8_t cm_grid_forward_lonlat(const cm_grid *grid, double lon, double lat, double uv[2])
{
    uint8_t face;
    cm_grid_forward_lonlat_array(grid, 1, &lon, &lat, &face, &uv[0], &uv[1]);
    return face;
}

void cm_grid_inverse_lonlat(const cm_grid *grid, uint8_t face, const double uv[2], double lonlat[2])
{
    double at[2] = {uv[0], uv[1]};
    cm_grid_inverse_lonlat_array(grid, 1, &face, &at[0], &at[1], &lonlat[0], &lonlat[1]);
}
