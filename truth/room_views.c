/* SPDX-License-Identifier: MIT */
#include "room_views.h"

#include <math.h>
#include <stdlib.h>

#include <cubemap/random.h>

#define TURN 6.28318530717958647692

cm_pose room_pose(size_t index, size_t count)
{
    const double angle = TURN * (double)index / (double)count;
    const double heading = angle + 0.5 * sin(5.0 * angle);
    const double pitch = 0.6 * sin(7.0 * angle + 0.3);
    const double forward[3] = {cos(pitch) * cos(heading), cos(pitch) * sin(heading), sin(pitch)};
    const double right[3] = {sin(heading), -cos(heading), 0.0};
    const double down[3] = {sin(pitch) * cos(heading), sin(pitch) * sin(heading), -cos(pitch)};
    cm_pose pose = {.position = {0.7 * cos(angle), 0.7 * sin(angle), 1.3 + 0.3 * sin(3.0 * angle)}};
    for (int i = 0; i < 3; i++)
    {
        pose.rotation.row[0][i] = right[i];
        pose.rotation.row[1][i] = down[i];
        pose.rotation.row[2][i] = forward[i];
    }
    return pose;
}

int room_picture_make(const cm_camera *camera, room_picture *picture)
{
    const cm_camera_options *options = cm_camera_describe(camera);
    const size_t pixels = (size_t)options->width * options->height;
    *picture = (room_picture){.pixels = pixels};
    double **const columns[] = {&picture->depth,     &picture->point[0],  &picture->point[1],
                                &picture->point[2],  &picture->normal[0], &picture->normal[1],
                                &picture->normal[2], &picture->cosine};
    int made = 1;
    for (size_t i = 0; i < sizeof columns / sizeof *columns; i++)
    {
        *columns[i] = malloc(pixels * sizeof(double));
        made = made && *columns[i] != NULL;
    }
    picture->measured = malloc(pixels * sizeof(float));
    picture->color = malloc(3 * pixels);
    if (!made || picture->measured == NULL || picture->color == NULL)
    {
        room_picture_free(picture);
        return 0;
    }
    return 1;
}

void room_picture_free(room_picture *picture)
{
    free(picture->depth);
    free(picture->cosine);
    free(picture->measured);
    free(picture->color);
    for (int i = 0; i < 3; i++)
    {
        free(picture->point[i]);
        free(picture->normal[i]);
    }
    *picture = (room_picture){0};
}

enum
{
    ROW = 512
};

/* Pixels from first on, ROW at most. */
static void take_pixels(const cm_scene *scene, const cm_camera *camera, const cm_pose *pose,
                        size_t first, size_t n, room_picture *picture)
{
    const cm_camera_options *options = cm_camera_describe(camera);
    double column[ROW], row[ROW], ray[3][ROW], origin[3][ROW], color[3][ROW];
    for (size_t i = 0; i < n; i++)
    {
        column[i] = (double)((first + i) % options->width) + options->pixel_centre;
        row[i] = (double)((first + i) / options->width) + options->pixel_centre;
    }
    cm_camera_ray_array(camera, n, column, row, ray[0], ray[1], ray[2]);
    for (size_t i = 0; i < n; i++)
    {
        const double of_camera[3] = {ray[0][i], ray[1][i], ray[2][i]};
        for (int k = 0; k < 3; k++)
        {
            ray[k][i] = 0.0;
            for (int j = 0; j < 3; j++)
            {
                ray[k][i] += pose->rotation.row[j][k] * of_camera[j];
            }
            origin[k][i] = pose->position[k];
        }
    }
    cm_hit_arrays hit = {.size = sizeof hit, .distance = picture->depth + first};
    for (int k = 0; k < 3; k++)
    {
        hit.normal[k] = picture->normal[k] + first;
        hit.color[k] = color[k];
    }
    cm_scene_cast_array(scene, n, origin[0], origin[1], origin[2], ray[0], ray[1], ray[2], &hit);
    for (size_t i = 0; i < n; i++)
    {
        const size_t at = first + i;
        double along = 0.0;
        double length = 0.0;
        for (int k = 0; k < 3; k++)
        {
            picture->point[k][at] = pose->position[k] + picture->depth[at] * ray[k][i];
            along -= ray[k][i] * picture->normal[k][at];
            length += ray[k][i] * ray[k][i];
            picture->color[3 * at + (size_t)k] = (unsigned char)lround(255.0 * color[k][i]);
        }
        picture->cosine[at] = along / sqrt(length);
    }
}

void room_picture_take(const cm_scene *scene, const cm_camera *camera, const cm_pose *pose,
                       double noise, uint32_t index, room_picture *picture)
{
    for (size_t first = 0; first < picture->pixels; first += ROW)
    {
        const size_t left = picture->pixels - first;
        take_pixels(scene, camera, pose, first, left < ROW ? left : ROW, picture);
    }
    for (size_t i = 0; i < picture->pixels; i++)
    {
        const double depth = picture->depth[i];
        const double error = noise > 0.0 ? noise * cm_random_normal(1, index, (uint32_t)i, 0) : 0.0;
        picture->measured[i] = isfinite(depth) ? (float)(depth * (1.0 + error)) : 0.0f;
    }
}

cm_view room_picture_view(const room_picture *picture, const cm_camera *camera, const cm_pose *pose,
                          int color)
{
    const cm_camera_options *options = cm_camera_describe(camera);
    cm_view view = {.size = sizeof view, .camera = camera, .pose = *pose, .depth_unit = 1.0};
    view.depth_is_range = options->mapping != NULL;
    view.depth = (cm_image){.size = sizeof(cm_image),
                            .data = picture->measured,
                            .type = CM_PIXEL_FLOAT,
                            .width = options->width,
                            .height = options->height,
                            .channels = 1};
    if (color)
    {
        view.color = (cm_image){.size = sizeof(cm_image),
                                .data = picture->color,
                                .type = CM_PIXEL_U8,
                                .width = options->width,
                                .height = options->height,
                                .channels = 3};
    }
    return view;
}
