/* SPDX-License-Identifier: MIT
 *
 * Discs: what is near their centre on their plane.
 */
#include "raster_object.h"

#include <float.h>
#include <math.h>

#include "bands.h"

#define COORDINATE_MOST 1e15

/* Cones are wider by so much. */
#define ROOM 1e-9

/* A disc and its id. */
typedef struct named_disc
{
    cm_raster_disc shape; /* first: meets sees it */
    uint32_t id;
} named_disc;

typedef struct drawing
{
    cm_raster *raster;
    const cm_pose *pose;
    const cm_discs *discs;
    cm_disc_view view;
} drawing;

static int meets(const void *user, const cm_tile_cone *cone)
{
    const cm_raster_disc *shape = user;
    if (shape->sine > 1.0)
    {
        return 1;
    }
    const double along = shape->centre[0] * cone->axis[0] + shape->centre[1] * cone->axis[1] +
                         shape->centre[2] * cone->axis[2];
    const double least = cone->cosine * shape->cosine - cone->sine * shape->sine - ROOM;
    return along >= least * shape->distance;
}

static void draw_tile(cm_raster *raster, const void *user, size_t column, size_t row,
                      size_t columns, size_t rows)
{
    const named_disc *disc = user;
    for (size_t i = row; i < row + rows; i++)
    {
        const cm_raster_rays rays = cm_raster_rays_at(raster, column, i);
        const cm_raster_pixels pixels = cm_raster_pixels_at(raster, column, i, disc->id);
        raster->set->disc_row(columns, &rays, &disc->shape, &pixels);
    }
}

static int make_disc(const cm_pose *pose, const cm_discs *discs, size_t i, cm_raster_disc *shape)
{
    const double centre[3] = {discs->centre[0][i], discs->centre[1][i], discs->centre[2][i]};
    const double normal[3] = {discs->normal[0][i], discs->normal[1][i], discs->normal[2][i]};
    const double radius = discs->radius[i];
    double turned[3] = {normal[0], normal[1], normal[2]};
    cm_raster_transform(pose, centre, shape->centre);
    if (pose != NULL)
    {
        cm_rotate(&pose->rotation, normal, turned);
    }
    const double *c = shape->centre;
    const double length =
        sqrt(turned[0] * turned[0] + turned[1] * turned[1] + turned[2] * turned[2]);
    const double off = (turned[0] * c[0] + turned[1] * c[1] + turned[2] * c[2]) / length;
    const double size = fabs(c[0]) + fabs(c[1]) + fabs(c[2]) + radius;
    if (!(radius > 0.0 && size < COORDINATE_MOST && length > 0.0 &&
          fabs(1.0 / off) < COORDINATE_MOST))
    {
        return 0;
    }
    shape->square = radius * radius;
    shape->distance = sqrt(c[0] * c[0] + c[1] * c[1] + c[2] * c[2]);
    for (int k = 0; k < 3; k++)
    {
        shape->plane[k] = turned[k] / length / off;
    }
    const double sine = radius / shape->distance;
    shape->sine = sine < 1.0 ? sine : 2.0;
    shape->cosine = sine < 1.0 ? sqrt(1.0 - sine * sine) : 0.0;
    return 1;
}

static void draw_by_tiles(const drawing *d, size_t i, size_t first, size_t last)
{
    named_disc disc = {.id = d->discs->first_id + (uint32_t)i};
    if (make_disc(d->pose, d->discs, i, &disc.shape))
    {
        cm_raster_visit(d->raster, &disc, meets, draw_tile, first, last);
    }
}

/* A plain camera: many together, by boxes of pixels, but for those that have none. */
static void draw_block(const drawing *d, size_t begin, size_t n, size_t first, size_t last)
{
    const cm_discs *discs = d->discs;
    const float *from[7];
    cm_disc_block block;
    for (size_t k = 0; k < 3; k++)
    {
        from[k] = discs->centre[k] + begin;
        from[3 + k] = discs->normal[k] + begin;
    }
    from[6] = discs->radius + begin;
    d->raster->set->discs_place(n, from, &d->view, &block);
    d->raster->set->discs_draw(n, &d->view, &block, first, last, discs->first_id + (uint32_t)begin);
    for (size_t i = 0; i < n; i++)
    {
        if (block.is_odd[i])
        {
            draw_by_tiles(d, begin + i, first, last);
        }
    }
}

static void draw_band(size_t first, size_t last, size_t band, void *user)
{
    const drawing *d = user;
    const int has_blocks = d->raster->is_plain && d->raster->width <= CM_DISC_PIXELS_MOST &&
                           d->raster->height <= CM_DISC_PIXELS_MOST;
    (void)band;
    for (size_t i = 0; has_blocks && i < d->discs->count; i += CM_DISC_BLOCK)
    {
        const size_t left = d->discs->count - i;
        draw_block(d, i, left < CM_DISC_BLOCK ? left : CM_DISC_BLOCK, first, last);
    }
    for (size_t i = 0; !has_blocks && i < d->discs->count; i++)
    {
        draw_by_tiles(d, i, first, last);
    }
}

static cm_disc_view view_of(const cm_raster *raster, const cm_pose *pose)
{
    const cm_camera_options *options = cm_camera_describe(raster->camera);
    cm_disc_view view = {.rotation = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0},
                         .fx = options->fx,
                         .fy = options->fy,
                         .cx = options->cx - options->pixel_centre,
                         .cy = options->cy - options->pixel_centre,
                         .width = (float)raster->width,
                         .height = (float)raster->height,
                         .near_most = raster->near_most,
                         .column_x = raster->column_x,
                         .row_y = raster->row_y,
                         .stride = raster->stride,
                         .key = raster->key};
    for (int i = 0; pose != NULL && i < 3; i++)
    {
        const double axis[3] = {i == 0, i == 1, i == 2};
        double column[3];
        cm_rotate(&pose->rotation, axis, column);
        for (int k = 0; k < 3; k++)
        {
            view.rotation[3 * k + i] = column[k];
        }
        view.position[i] = pose->position[i];
    }
    return view;
}

cm_status cm_raster_discs(cm_raster *raster, const cm_pose *pose, const cm_discs *discs,
                          unsigned threads)
{
    if (raster == NULL || discs == NULL || discs->size != sizeof *discs)
    {
        return CM_ERROR_ARGUMENT;
    }
    for (int k = 0; discs->count > 0 && k < 3; k++)
    {
        if (discs->centre[k] == NULL || discs->normal[k] == NULL || discs->radius == NULL)
        {
            return CM_ERROR_ARGUMENT;
        }
    }
    if (cm_raster_check_ids(discs->first_id, discs->count) != CM_OK)
    {
        return CM_ERROR_RANGE;
    }
    drawing d = {raster, pose, discs, view_of(raster, pose)};
    cm_run_bands(raster->pool, cm_band_count(raster->pool, threads, raster->height, CM_TILE),
                 raster->height, CM_TILE, draw_band, &d);
    return CM_OK;
}
