/* SPDX-License-Identifier: MIT
 *
 * Pictures of a map: a cone through each pixel.
 */
#include <cubemap/octree.h>

#include <math.h>
#include <stdlib.h>

#include "modules/memory/checked_size.h"
#include "light.h"
#include "picture.h"
#include "snapshot.h"
#include "start_map.h"

/* Rows and columns of a square whose pixels have the solid angle of its middle. */
#define SQUARE 4

/* Pixels whose rays are made together. */
#define PART 128

typedef struct rendering
{
    const cm_octree_options *map;
    const cm_camera *camera;
    const cm_camera_options *lens;
    int is_plain; /* no lens distortion */
    const cm_pose *pose;
    const cm_octree_shading *shading;
    const float *mesh; /* depths, or ranges; NULL */
    cm_snapshot snapshot;
    cm_start_map *start;
    float *width; /* of squares of pixels; NULL if is_plain */
    size_t width_stride;
    cm_light light;
    double origin[3]; /* in voxels from the snapshot's corner */
    double far;       /* in voxels */
    const cm_image *color;
    const cm_image *depth;
} rendering;

/* What a thread keeps from one pixel to the next. */
typedef struct desk
{
    cm_cone_path path;
    cm_light_windows windows;
} desk;

/* Of a pixel. */
typedef struct pixel_ray
{
    double direction[3]; /* of length 1, in the world */
    double length;       /* in the camera's axes */
    double width;        /* of its cone at distance 1 */
} pixel_ray;

static cm_status check_shading(const cm_octree_shading *s)
{
    if (s->size != sizeof *s)
    {
        return CM_ERROR_ARGUMENT;
    }
    int is_good = s->coarsest >= 0 && s->coarsest <= CM_OCTREE_LEVELS_MAX && s->far >= 0.0 &&
                  s->far < 1e100 && s->light_angle >= 0.0 && s->light_angle < 3.0 &&
                  s->ambient >= 0.0 && s->ambient <= 1.0;
    for (int axis = 0; axis < 3; axis++)
    {
        is_good = is_good && isfinite(s->background[axis]) &&
                  (!s->light || fabs(s->light_position[axis]) < 1e100);
    }
    return is_good ? CM_OK : CM_ERROR_RANGE;
}

static cm_status check(const cm_camera_options *lens, const cm_pose *pose,
                       const cm_octree_shading *shading, const cm_image *color,
                       const cm_image *depth)
{
    cm_status status = cm_pose_check(pose);
    status = status == CM_OK ? check_shading(shading) : status;
    if (status == CM_OK && color != NULL)
    {
        status = cm_picture_check(color, lens->width, lens->height, 3, 4);
        status = status == CM_OK && color->type == CM_PIXEL_HALF ? CM_ERROR_RANGE : status;
    }
    if (status == CM_OK && depth != NULL)
    {
        status = cm_picture_check(depth, lens->width, lens->height, 1, 1);
        status = status == CM_OK && depth->type != CM_PIXEL_FLOAT ? CM_ERROR_RANGE : status;
    }
    return status;
}

/* ---- rays ---- */

static int is_plain(const cm_camera_options *lens)
{
    int is = lens->mapping == NULL;
    for (size_t i = 0; i < sizeof lens->distortion / sizeof *lens->distortion; i++)
    {
        is = is && lens->distortion[i] == 0.0;
    }
    return is;
}

/* The root of the solid angle of the pixel in the middle of a square. */
static double width_of_square(const rendering *r, size_t column, size_t row)
{
    const size_t middle_column = column - column % SQUARE + SQUARE / 2;
    const size_t middle_row = row - row % SQUARE + SQUARE / 2;
    const double c = (double)(middle_column < r->lens->width ? middle_column : column);
    const double l = (double)(middle_row < r->lens->height ? middle_row : row);
    const double centre = r->lens->pixel_centre;
    const double angle = cm_camera_solid_angle(r->camera, c + centre, l + centre);
    const double own = angle > 0.0 ? angle
                                   : cm_camera_solid_angle(r->camera, (double)column + centre,
                                                           (double)row + centre);
    return own > 0.0 ? sqrt(own) : 1e-6;
}

/* Rays of `count` pixels of a row, NaN where the camera has none. */
static void make_rays(const rendering *r, size_t column, size_t row, size_t count, pixel_ray *rays)
{
    double columns[PART], rows[PART], x[PART], y[PART], z[PART];
    const double(*axis)[3] = r->pose->rotation.row;
    for (size_t i = 0; i < count; i++)
    {
        columns[i] = (double)(column + i) + r->lens->pixel_centre;
        rows[i] = (double)row + r->lens->pixel_centre;
    }
    cm_camera_ray_array(r->camera, count, columns, rows, x, y, z);
    const double side = 1.0 / sqrt(fabs(r->lens->fx * r->lens->fy));
    for (size_t i = 0; i < count; i++)
    {
        const double length = sqrt(x[i] * x[i] + y[i] * y[i] + z[i] * z[i]);
        rays[i].length = length;
        rays[i].width = r->is_plain
                            ? side / (length * sqrt(length))
                            : r->width[row / SQUARE * r->width_stride + (column + i) / SQUARE];
        for (int k = 0; k < 3; k++)
        {
            rays[i].direction[k] =
                (axis[0][k] * x[i] + axis[1][k] * y[i] + axis[2][k] * z[i]) / length;
        }
    }
}

/* ---- pixels ---- */

static double light_of(const rendering *r, desk *d, const pixel_ray *ray, const cm_cone_view *seen)
{
    double place[3], normal[3];
    for (int k = 0; k < 3; k++)
    {
        place[k] = r->origin[k] + seen->half * ray->direction[k];
    }
    cm_light_normal(&r->snapshot, &d->path, &d->windows, place, ray->direction, seen->level,
                    normal);
    return cm_light_at(&r->light, &r->snapshot, &d->path, place, normal, seen->level);
}

/* What is behind the map: the mesh at a distance, or the background. */
static void add_behind(const rendering *r, desk *d, const pixel_ray *ray, size_t pixel, double mesh,
                       cm_cone_view *seen, float rgba[4])
{
    const float left = 1.0f - seen->opacity;
    const float *behind = r->shading->background;
    float color[3] = {1.0f, 1.0f, 1.0f};
    rgba[3] = seen->opacity;
    if (mesh < INFINITY)
    {
        double place[3];
        for (int k = 0; k < 3; k++)
        {
            color[k] = r->shading->mesh_color == NULL
                           ? 1.0f
                           : r->shading->mesh_color[3 * pixel + (size_t)k];
            place[k] = r->origin[k] + mesh * ray->direction[k];
        }
        const double bright = r->shading->light
                                  ? cm_light_at(&r->light, &r->snapshot, &d->path, place, NULL, 0)
                                  : 1.0;
        for (int k = 0; k < 3; k++)
        {
            color[k] *= (float)bright;
        }
        behind = color;
        rgba[3] = 1.0f;
        seen->half = seen->opacity < 0.5f ? mesh : seen->half;
    }
    for (int k = 0; k < 3; k++)
    {
        rgba[k] += left * behind[k];
    }
}

static void draw_pixel(const rendering *r, desk *d, const pixel_ray *ray, size_t column, size_t row)
{
    const size_t pixel = row * r->lens->width + column;
    const double unit = r->map->edge;
    cm_cone_view seen = {.half = INFINITY};
    const double per_length = r->lens->mapping == NULL ? ray->length : 1.0;
    const int has_mesh = r->mesh != NULL && r->mesh[pixel] > 0.0f;
    const double mesh = has_mesh ? r->mesh[pixel] * per_length / unit : INFINITY;
    cm_cone cone = {.width = ray->width, .end = r->far, .coarsest = r->shading->coarsest};
    for (int k = 0; k < 3; k++)
    {
        cone.origin[k] = r->origin[k];
        cone.direction[k] = ray->direction[k];
    }
    if (r->snapshot.top >= 0 && ray->length > 0.0 && cm_start_map_shorten(r->start, &cone))
    {
        cone.end = mesh < cone.end ? mesh : cone.end;
        seen = cm_cone_trace(&r->snapshot, &d->path, &cone);
    }
    float rgba[4] = {seen.color[0], seen.color[1], seen.color[2], 0.0f};
    if (r->color != NULL)
    {
        if (r->shading->light && seen.opacity > 0.0f)
        {
            const double bright = seen.half < INFINITY ? light_of(r, d, ray, &seen) : 1.0;
            rgba[0] *= (float)bright;
            rgba[1] *= (float)bright;
            rgba[2] *= (float)bright;
        }
        add_behind(r, d, ray, pixel, mesh, &seen, rgba);
        cm_picture_write(r->color, column, row, rgba, r->color->channels);
    }
    if (r->depth != NULL)
    {
        seen.half = seen.opacity < 0.5f ? mesh : seen.half;
        *(float *)cm_picture_at(r->depth, column, row) =
            seen.half < INFINITY ? (float)(seen.half * unit / per_length) : NAN;
    }
}

static void draw_rows(size_t begin, size_t end, void *user)
{
    const rendering *r = user;
    const size_t width = r->lens->width;
    pixel_ray rays[PART];
    desk d = {.windows = {{{{0}, 0, {0}}}}};
    if (r->snapshot.top >= 0)
    {
        cm_cone_start(&r->snapshot, &d.path);
    }
    const size_t last = end * SQUARE < r->lens->height ? end * SQUARE : r->lens->height;
    for (size_t first = 0; first < width; first += PART)
    {
        const size_t count = width - first < PART ? width - first : PART;
        for (size_t row = begin * SQUARE; row < last; row++)
        {
            make_rays(r, first, row, count, rays);
            for (size_t i = 0; i < count; i++)
            {
                draw_pixel(r, &d, &rays[i], first + i, row);
            }
        }
    }
}

/* ---- the whole picture ---- */

static void measure_squares(size_t begin, size_t end, void *user)
{
    const rendering *r = user;
    for (size_t i = begin; i < end; i++)
    {
        r->width[i] =
            (float)width_of_square(r, i % r->width_stride * SQUARE, i / r->width_stride * SQUARE);
    }
}

/* How wide cones are, and the widest; 0 if there is no memory. */
static double measure_widths(rendering *r)
{
    if (r->is_plain)
    {
        return 1.0 / sqrt(fabs(r->lens->fx * r->lens->fy));
    }
    r->width_stride = (r->lens->width + SQUARE - 1) / SQUARE;
    const size_t count = r->width_stride * ((r->lens->height + SQUARE - 1) / SQUARE);
    r->width = cm_array_of(count, sizeof *r->width);
    if (r->width == NULL)
    {
        return 0.0;
    }
    cm_pool_run(r->shading->pool, count, 64, measure_squares, r);
    double widest = 0.0;
    for (size_t i = 0; i < count; i++)
    {
        widest = r->width[i] > widest ? r->width[i] : widest;
    }
    return widest;
}

/* One side of the pyramid that a camera sees: where the product with a vector of its axes is not negative. */
static void add_plane(const rendering *r, const double camera[3], double x, double y, double z,
                      cm_snapshot_bounds *bounds)
{
    const double length = sqrt(x * x + y * y + z * z);
    double *plane = bounds->plane[bounds->planes++];
    plane[3] = 0.0;
    for (int k = 0; k < 3; k++)
    {
        const double(*row)[3] = r->pose->rotation.row;
        plane[k] = (x * row[0][k] + y * row[1][k] + z * row[2][k]) / length;
        plane[3] += plane[k] * camera[k];
    }
}

/* All that a camera sees without a lens; shadows are of what it does not see, too. */
static void add_planes(const rendering *r, const double camera[3], double widest,
                       cm_snapshot_bounds *bounds)
{
    const cm_camera_options *lens = r->lens;
    const double left = (lens->pixel_centre - 0.5 - lens->cx) / lens->fx;
    const double right = left + lens->width / lens->fx;
    const double up = (lens->pixel_centre - 0.5 - lens->cy) / lens->fy;
    const double down = up + lens->height / lens->fy;
    add_plane(r, camera, 1.0, 0.0, -fmin(left, right), bounds);
    add_plane(r, camera, -1.0, 0.0, fmax(left, right), bounds);
    add_plane(r, camera, 0.0, 1.0, -fmin(up, down), bounds);
    add_plane(r, camera, 0.0, -1.0, fmax(up, down), bounds);
    /* cells that are read beyond the picture are whole */
    bounds->margin = 2.0 * (cm_size_of_level(r->shading->coarsest) + widest * r->far);
}

/* The snapshot of all that cones reach, with places in it, and where they begin. */
static cm_status prepare(const cm_octree *octree, rendering *r)
{
    const double widest = measure_widths(r);
    if (!(widest > 0.0))
    {
        return CM_ERROR_MEMORY;
    }
    const double unit = r->map->edge;
    double camera[3], light[3];
    cm_snapshot_bounds bounds = {.planes = 0};
    r->far = (r->shading->far > 0.0 ? r->shading->far : 10.0) / unit;
    for (int k = 0; k < 3; k++)
    {
        camera[k] = (r->pose->position[k] - r->map->centre[k]) / unit;
        light[k] = (r->shading->light_position[k] - r->map->centre[k]) / unit;
        bounds.least[k] = camera[k] - r->far;
        bounds.greatest[k] = camera[k] + r->far;
        if (r->shading->light)
        {
            bounds.least[k] = fmin(bounds.least[k], light[k]);
            bounds.greatest[k] = fmax(bounds.greatest[k], light[k]);
        }
    }
    if (r->is_plain && !r->shading->light)
    {
        add_planes(r, camera, widest, &bounds);
    }
    const cm_status status = cm_snapshot_make(octree, &bounds, r->shading->pool, &r->snapshot);
    for (int k = 0; k < 3; k++)
    {
        r->origin[k] = camera[k] - (double)r->snapshot.corner[k];
        r->light.place[k] = light[k] - (double)r->snapshot.corner[k];
    }
    r->light.width =
        2.0 * tan(0.5 * (r->shading->light_angle > 0.0 ? r->shading->light_angle : 0.1));
    r->light.ambient = r->shading->ambient > 0.0 ? r->shading->ambient : 0.3;
    r->light.coarsest = r->shading->coarsest;
    if (status == CM_OK)
    {
        cm_start_map_make(&r->snapshot, r->origin, widest, r->shading->coarsest, r->far, r->start);
    }
    return status;
}

static cm_status draw(const cm_octree *octree, rendering *r)
{
    const size_t pixels = (size_t)r->lens->width * r->lens->height;
    const cm_raster *raster = r->shading->mesh;
    if (raster != NULL && cm_raster_pixel_count(raster) != pixels)
    {
        return CM_ERROR_ARGUMENT;
    }
    float *mesh = raster != NULL ? cm_array_of(pixels, sizeof *mesh) : NULL;
    r->start = malloc(sizeof *r->start);
    cm_status status =
        r->start == NULL || (raster != NULL && mesh == NULL) ? CM_ERROR_MEMORY : CM_OK;
    if (status == CM_OK && raster != NULL)
    {
        status = cm_raster_read(raster, mesh, NULL);
    }
    if (status == CM_OK)
    {
        r->mesh = mesh;
        status = prepare(octree, r);
    }
    if (status == CM_OK)
    {
        cm_pool_run(r->shading->pool, (r->lens->height + SQUARE - 1) / SQUARE, 1, draw_rows, r);
    }
    cm_snapshot_drop(&r->snapshot);
    free(r->start);
    free(r->width);
    free(mesh);
    return status;
}

cm_status cm_octree_render(const cm_octree *octree, const cm_camera *camera, const cm_pose *pose,
                           const cm_octree_shading *shading, cm_image *color, cm_image *depth)
{
    static const cm_octree_shading standard = {.size = sizeof standard};
    const cm_octree_shading *how = shading == NULL ? &standard : shading;
    if (octree == NULL || camera == NULL || pose == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    const cm_camera_options *lens = cm_camera_describe(camera);
    const cm_status status = check(lens, pose, how, color, depth);
    if (status != CM_OK || (color == NULL && depth == NULL))
    {
        return status;
    }
    rendering r = {.map = cm_octree_describe(octree),
                   .camera = camera,
                   .lens = lens,
                   .is_plain = is_plain(lens),
                   .pose = pose,
                   .shading = how,
                   .snapshot = {.top = -1},
                   .color = color,
                   .depth = depth};
    return draw(octree, &r);
}
