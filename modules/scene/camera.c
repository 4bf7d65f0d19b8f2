/* SPDX-License-Identifier: MIT
 *
 * The life of a camera, and the ways between its axes and its pixels.
 */
#include "camera_object.h"
#include "camera_inverse.h"

#include <stdlib.h>
#include <string.h>

/* A row of pixels may be numbered by 31 bits. */
#define PIXELS_MOST 2147483648.0

/* A box around the picture and a pixel more, in focal lengths, the tilt undone. 0 if it reaches where no ray gets. */
static int box_of(const cm_camera *camera, double box[4])
{
    const cm_lens *lens = &camera->lens;
    const double *back = lens->level;
    for (int i = 0; i < 4; i++)
    {
        const double column = i % 2 == 0 ? -1.0 : (double)camera->options.width + 1.0;
        const double row = i < 2 ? -1.0 : (double)camera->options.height + 1.0;
        double x = (column - lens->cx) * lens->per_x;
        double y = (row - lens->cy) * lens->per_y;
        const double third = LENS_MAD(back[6], x, LENS_MAD(back[7], y, back[8]));
        if (lens->is_tilted)
        {
            const double plain[2] = {x, y};
            x = cm_lens_turn(back, plain[0], plain[1], 1.0 / third);
            y = cm_lens_turn(back + 3, plain[0], plain[1], 1.0 / third);
        }
        if (!(fabs(x) + fabs(y) < 1e100 && (third > 0.0 || !lens->is_tilted)))
        {
            return 0;
        }
        box[0] = i == 0 ? x : fmin(box[0], x);
        box[1] = i == 0 ? y : fmin(box[1], y);
        box[2] = i == 0 ? x : fmax(box[2], x);
        box[3] = i == 0 ? y : fmax(box[3], y);
    }
    return box[2] > box[0] && box[3] > box[1];
}

/* 0 if there was no memory. */
static int find_field(cm_camera *camera)
{
    double box[4];
    cm_camera_field_find(&camera->lens, &camera->field);
    return cm_camera_image_find(&camera->lens, &camera->field, box_of(camera, box) ? box : NULL,
                                &camera->image);
}

cm_status cm_camera_create(const cm_camera_options *options, cm_camera **camera)
{
    if (options == NULL || camera == NULL || options->size != sizeof *options)
    {
        return CM_ERROR_ARGUMENT;
    }
    const double pixels = (double)options->width * options->height;
    if (!(pixels > 0.0 && pixels < PIXELS_MOST) ||
        !(options->pixel_centre >= 0.0 && options->pixel_centre <= 1.0))
    {
        return CM_ERROR_CAMERA;
    }
    cm_camera *made = calloc(1, sizeof *made);
    if (made == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    made->options = *options;
    made->options.mapping = NULL;
    made->set = cm_camera_set_find();
    const cm_status status = options->mapping != NULL
                                 ? cm_camera_take_mapping(made, options->mapping)
                                 : cm_camera_make_lens(options, &made->lens);
    if (status != CM_OK)
    {
        cm_camera_destroy(made);
        return status;
    }
    if (made->faces == 0 && !find_field(made))
    {
        cm_camera_destroy(made);
        return CM_ERROR_MEMORY;
    }
    *camera = made;
    return CM_OK;
}

void cm_camera_destroy(cm_camera *camera)
{
    if (camera != NULL)
    {
        cm_mapping_destroy((cm_mapping *)camera->options.mapping);
        free(camera->image.corner);
        free(atomic_load(&camera->net));
        free(camera);
    }
}

const cm_camera_options *cm_camera_describe(const cm_camera *camera)
{
    return &camera->options;
}

/* Part of an array, and zeros behind it. */
static void take(double *to, const double *from, size_t count, double rest)
{
    memcpy(to, from, count * sizeof *to);
    for (size_t i = count; i < CM_CAMERA_BLOCK; i++)
    {
        to[i] = rest;
    }
}

/* What signs alone do not tell. */
static void settle_points(const cm_camera *camera, cm_camera_block *block, size_t count)
{
    for (size_t i = 0; i < count; i++)
    {
        if (block->mark[i] > 1.0 &&
            !cm_camera_field_joins(&camera->field, block->x[i], block->y[i]))
        {
            block->column[i] = block->row[i] = (double)NAN;
        }
    }
}

/* A ray that the loops found, if it is inside; or one that is looked for. */
static int settle_pixel(const cm_camera *camera, const double pixel[2], const double aim[2],
                        double slack, cm_camera_net *net, double ray[2])
{
    const cm_camera_search search = {&camera->lens,        camera->set,      &camera->field, net,
                                     {pixel[0], pixel[1]}, {aim[0], aim[1]}, slack};
    const cm_camera_reach reach = cm_camera_image_reaches(&camera->image, aim[0], aim[1]);
    if (reach == CM_IMAGE_MISSED)
    {
        return 0;
    }
    const int is_found = isfinite(ray[0]) && cm_camera_field_joins(&camera->field, ray[0], ray[1]);
    double other[2];
    if ((!is_found || cm_camera_is_off(&search, ray)) && cm_camera_solve(&search, reach, other))
    {
        ray[0] = other[0];
        ray[1] = other[1];
        return 1;
    }
    return is_found;
}

static void settle_pixels(const cm_camera *camera, cm_camera_block *block, size_t count,
                          cm_camera_net *net)
{
    for (size_t i = 0; i < count; i++)
    {
        if (block->mark[i] > 1.0)
        {
            double ray[2] = {block->x[i], block->y[i]};
            const double pixel[2] = {block->column[i], block->row[i]};
            const double aim[2] = {block->aim_x[i], block->aim_y[i]};
            const int is_ray = settle_pixel(camera, pixel, aim, block->slack[i], net, ray);
            block->x[i] = is_ray ? ray[0] : (double)NAN;
            block->y[i] = is_ray ? ray[1] : (double)NAN;
            block->z[i] = is_ray ? 1.0 : (double)NAN;
        }
    }
}

void cm_camera_project_array(const cm_camera *camera, size_t n, const double *x, const double *y,
                             const double *z, double *column, double *row)
{
    if (camera->faces != 0)
    {
        cm_camera_project_faces(camera, n, x, y, z, column, row);
        return;
    }
    cm_camera_block block;
    for (size_t done = 0; done < n; done += CM_CAMERA_BLOCK)
    {
        const size_t count = n - done < CM_CAMERA_BLOCK ? n - done : CM_CAMERA_BLOCK;
        take(block.x, x + done, count, 0.0);
        take(block.y, y + done, count, 0.0);
        take(block.z, z + done, count, 1.0);
        if (camera->set->project(&camera->lens, camera->field.within, &block) > 0)
        {
            settle_points(camera, &block, count);
        }
        memcpy(column + done, block.column, count * sizeof *column);
        memcpy(row + done, block.row, count * sizeof *row);
    }
}

/* So that who asks pixel by pixel does not make it for each. Of threads that make it at once one keeps it. */
static void keep_net(const cm_camera *camera, const cm_camera_net *net)
{
    cm_camera_net *const kept = malloc(sizeof *kept);
    if (kept != NULL)
    {
        cm_camera_net *none = NULL;
        *kept = *net;
        if (!atomic_compare_exchange_strong(&((cm_camera *)camera)->net, &none, kept))
        {
            free(kept);
        }
    }
}

void cm_camera_ray_array(const cm_camera *camera, size_t n, const double *column, const double *row,
                         double *x, double *y, double *z)
{
    if (camera->faces != 0)
    {
        cm_camera_ray_faces(camera, n, column, row, x, y, z);
        return;
    }
    cm_camera_block block;
    cm_camera_net own;
    own.is_made = 0;
    cm_camera_net *const kept = atomic_load(&camera->net);
    for (size_t done = 0; done < n; done += CM_CAMERA_BLOCK)
    {
        const size_t count = n - done < CM_CAMERA_BLOCK ? n - done : CM_CAMERA_BLOCK;
        take(block.column, column + done, count, camera->lens.cx);
        take(block.row, row + done, count, camera->lens.cy);
        camera->set->aim(&camera->lens, camera->field.furthest, &block);
        cm_camera_image_drop(&camera->image, &block);
        if (camera->set->rays(&camera->lens, camera->field.within, &block) > 0)
        {
            settle_pixels(camera, &block, count, kept != NULL ? kept : &own);
        }
        memcpy(x + done, block.x, count * sizeof *x);
        memcpy(y + done, block.y, count * sizeof *y);
        memcpy(z + done, block.z, count * sizeof *z);
    }
    if (own.is_made)
    {
        keep_net(camera, &own);
    }
}

/* d(column, row) / d(a, b) of a ray inside, by rows. */
static void ray_jacobian(const cm_lens *lens, double a, double b, double jacobian[4])
{
    const cm_lens_point at = cm_lens_at(lens, a, b);
    const double *t = lens->tilt;
    const double inverse = 1.0 / cm_lens_reach(lens, at.x, at.y);
    for (int i = 0; i < 2; i++)
    {
        const double f = (i == 0 ? lens->fx : lens->fy) * inverse;
        const double place = cm_lens_turn(t + 3 * (size_t)i, at.x, at.y, inverse);
        const double by_x = f * (t[3 * i] - place * t[6]);
        const double by_y = f * (t[3 * i + 1] - place * t[7]);
        jacobian[2 * i] = by_x * at.x_by_a + by_y * at.y_by_a;
        jacobian[2 * i + 1] = by_x * at.x_by_b + by_y * at.y_by_b;
    }
}

void cm_camera_jacobian(const cm_camera *camera, const double point[3], double jacobian[6])
{
    if (camera->faces != 0)
    {
        cm_camera_jacobian_faces(camera, point, jacobian);
        return;
    }
    double column;
    double row;
    cm_camera_project_array(camera, 1, &point[0], &point[1], &point[2], &column, &row);
    const double nothing = 0.0 * column; /* NaN outside */
    const double inverse = 1.0 / point[2];
    const double a = point[0] * inverse;
    const double b = point[1] * inverse;
    double by_ray[4];
    ray_jacobian(&camera->lens, a, b, by_ray);
    for (int i = 0; i < 2; i++)
    {
        jacobian[3 * i] = by_ray[2 * i] * inverse + nothing;
        jacobian[3 * i + 1] = by_ray[2 * i + 1] * inverse + nothing;
        jacobian[3 * i + 2] = -(by_ray[2 * i] * a + by_ray[2 * i + 1] * b) * inverse + nothing;
    }
}

/* A ray (a, b, 1) moves on the unit sphere by the area da db / length^3. */
double cm_camera_solid_angle(const cm_camera *camera, double column, double row)
{
    if (camera->faces != 0)
    {
        return cm_camera_angle_faces(camera, column, row);
    }
    double ray[3];
    cm_camera_ray_array(camera, 1, &column, &row, &ray[0], &ray[1], &ray[2]);
    const double length2 = ray[0] * ray[0] + ray[1] * ray[1] + ray[2] * ray[2];
    double by_ray[4];
    ray_jacobian(&camera->lens, ray[0], ray[1], by_ray);
    return 1.0 / (fabs(by_ray[0] * by_ray[3] - by_ray[1] * by_ray[2]) * length2 * sqrt(length2));
}

int cm_camera_has_ray(const cm_camera *camera, double column, double row)
{
    double ray[3];
    cm_camera_ray_array(camera, 1, &column, &row, &ray[0], &ray[1], &ray[2]);
    return ray[0] == ray[0];
}

double cm_camera_border(const cm_camera *camera, double angle)
{
    if (camera->faces != 0 || !(fabs(angle) < (double)INFINITY))
    {
        return (double)NAN;
    }
    return camera->lens.is_plain ? (double)INFINITY
                                 : cm_camera_field_border(&camera->field, cos(angle), sin(angle));
}
