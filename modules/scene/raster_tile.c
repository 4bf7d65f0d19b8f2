/* SPDX-License-Identifier: MIT
 *
 * Cones around the rays of tiles of pixels, and of tiles of tiles: which pixels a shape may cover, in any camera.
 */
#include "raster_object.h"

#include <math.h>
#include <stdlib.h>

/* Cones are wider by so much than rounding. */
#define CONE_ROOM 1e-12

/* A sine above 1 is of all directions. */
#define ALL_ROUND 2.0
#define NO_RAYS (-1.0)

/* The unit ray of a pixel; 0 if it has none. */
static int unit_ray(const cm_raster *raster, size_t column, size_t row, double ray[3])
{
    const cm_raster_rays rays = cm_raster_rays_at(raster, column, row);
    const int has_all = rays.y != NULL;
    const double x = rays.x[0];
    const double y = has_all ? rays.y[0] : rays.y_all;
    const double z = has_all ? rays.z[0] : 1.0;
    const double length = sqrt(x * x + y * y + z * z);
    ray[0] = x / length;
    ray[1] = y / length;
    ray[2] = z / length;
    return length > 0.0;
}

/* Pixels of a tile: from column to last_column - 1, and so on. */
typedef struct pixel_box
{
    size_t column, last_column;
    size_t row, last_row;
} pixel_box;

static cm_tile_cone cone_of(const cm_raster *raster, const pixel_box *box)
{
    cm_tile_cone cone = {.sine = NO_RAYS};
    double ray[3];
    double cosine = 1.0;
    size_t rays = 0;
    for (size_t i = box->row; i < box->last_row; i++)
    {
        for (size_t j = box->column; j < box->last_column; j++)
        {
            if (unit_ray(raster, j, i, ray))
            {
                rays++;
                cone.axis[0] += ray[0];
                cone.axis[1] += ray[1];
                cone.axis[2] += ray[2];
            }
        }
    }
    const double length = sqrt(cone.axis[0] * cone.axis[0] + cone.axis[1] * cone.axis[1] +
                               cone.axis[2] * cone.axis[2]);
    for (int k = 0; k < 3; k++)
    {
        cone.axis[k] /= length;
    }
    for (size_t i = box->row; i < box->last_row; i++)
    {
        for (size_t j = box->column; j < box->last_column; j++)
        {
            if (unit_ray(raster, j, i, ray))
            {
                const double along =
                    cone.axis[0] * ray[0] + cone.axis[1] * ray[1] + cone.axis[2] * ray[2];
                cosine = along >= cosine ? cosine : along; /* NaN where they cancel */
            }
        }
    }
    if (rays > 0)
    {
        cone.cosine = cosine;
        cone.sine =
            cosine > CONE_ROOM ? sqrt(fmax(1.0 - cosine * cosine, 0.0)) + CONE_ROOM : ALL_ROUND;
    }
    return cone;
}

static void fill_level(const cm_raster *raster, const cm_tile_level *level, size_t pixels)
{
    for (size_t i = 0; i < level->height; i++)
    {
        for (size_t j = 0; j < level->width; j++)
        {
            const pixel_box box = {
                j * pixels, (j + 1) * pixels < raster->width ? (j + 1) * pixels : raster->width,
                i * pixels, (i + 1) * pixels < raster->height ? (i + 1) * pixels : raster->height};
            level->cone[i * level->width + j] = cone_of(raster, &box);
        }
    }
}

cm_status cm_raster_make_tiles(cm_raster *raster)
{
    size_t pixels = CM_TILE;
    do
    {
        cm_tile_level *level = &raster->level[raster->levels];
        level->width = (raster->width + pixels - 1) / pixels;
        level->height = (raster->height + pixels - 1) / pixels;
        level->cone = calloc(level->width * level->height, sizeof *level->cone);
        if (level->cone == NULL)
        {
            return CM_ERROR_MEMORY;
        }
        raster->levels++;
        fill_level(raster, level, pixels);
        if (level->width * level->height <= (size_t)CM_TILE * CM_TILE)
        {
            break;
        }
        pixels *= CM_TILE;
    } while (raster->levels < CM_TILE_LEVELS);
    return CM_OK;
}

/* What is looked for. */
typedef struct visit
{
    cm_raster *raster;
    const void *shape;
    cm_tile_test meets;
    cm_tile_draw draw;
    size_t first;
    size_t last;
} visit;

static void visit_tiles(const visit *v, size_t depth, size_t column, size_t row)
{
    const cm_tile_level *level = &v->raster->level[depth];
    size_t pixels = CM_TILE;
    for (size_t i = 0; i < depth; i++)
    {
        pixels *= CM_TILE;
    }
    const int is_top = depth + 1 == v->raster->levels;
    const size_t columns =
        is_top || column + CM_TILE > level->width ? level->width : column + CM_TILE;
    const size_t rows = is_top || row + CM_TILE > level->height ? level->height : row + CM_TILE;
    for (size_t i = row; i < rows; i++)
    {
        if ((i + 1) * pixels <= v->first || i * pixels >= v->last)
        {
            continue;
        }
        for (size_t j = column; j < columns; j++)
        {
            const cm_tile_cone *cone = &level->cone[i * level->width + j];
            if (cone->sine == NO_RAYS || (cone->sine <= 1.0 && !v->meets(v->shape, cone)))
            {
                continue;
            }
            if (depth > 0)
            {
                visit_tiles(v, depth - 1, j * CM_TILE, i * CM_TILE);
                continue;
            }
            const size_t left = v->raster->width - j * CM_TILE;
            const size_t below = v->last - i * CM_TILE;
            v->draw(v->raster, v->shape, j * CM_TILE, i * CM_TILE, left < CM_TILE ? left : CM_TILE,
                    below < CM_TILE ? below : CM_TILE);
        }
    }
}

void cm_raster_visit(cm_raster *raster, const void *shape, cm_tile_test meets, cm_tile_draw draw,
                     size_t first, size_t last)
{
    const visit v = {raster, shape, meets, draw, first, last};
    visit_tiles(&v, raster->levels - 1, 0, 0);
}
