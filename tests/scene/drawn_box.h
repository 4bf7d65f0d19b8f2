/* SPDX-License-Identifier: MIT
 *
 * What the suites of drawing share: cameras of every kind, and a closed box around them.
 */
#ifndef TESTS_SCENE_DRAWN_BOX_H
#define TESTS_SCENE_DRAWN_BOX_H

#include <cubemap/raster.h>

#include "tests/suite.h"

/* A camera, with what it was made of. */
typedef struct some_camera
{
    const char *name;
    cm_camera *camera;
    cm_mapping *mapping;
    size_t width;
    size_t height;
    double *rays; /* of all pixels: x, then y, then z */
} some_camera;

enum
{
    CAMERAS = 7
};

/* Made together: one by one they are most of what a test takes. */
static inline double *rays_of_pixels(const some_camera *c)
{
    const size_t pixels = c->width * c->height;
    const double centre = cm_camera_describe(c->camera)->pixel_centre;
    double *rays = calloc(5 * pixels, sizeof *rays);
    double *column = rays + 3 * pixels;
    double *row = rays + 4 * pixels;
    for (size_t i = 0; i < pixels; i++)
    {
        column[i] = (double)(i % c->width) + centre;
        row[i] = (double)(i / c->width) + centre;
    }
    cm_camera_ray_array(c->camera, pixels, column, row, rays, rays + pixels, rays + 2 * pixels);
    return rays;
}

/* Perspective without and with distortion, and both centres; faces of several mappings; a fisheye. */
static inline some_camera camera_at(int which)
{
    static const char *const names[CAMERAS] = {
        "plain", "halves", "distorted", "coupled", "tangent", "healpix", "azimuthal:equidistant"};
    some_camera c = {.name = names[which]};
    cm_camera_options options = {.size = sizeof options,
                                 .width = 160,
                                 .height = 120,
                                 .fx = 130.0,
                                 .fy = 131.0,
                                 .cx = 79.5,
                                 .cy = 59.5,
                                 .pixel_centre = which == 1 ? 0.5 : 0.0};
    options.distortion[0] = which == 2 ? -0.12 : 0.0;
    options.distortion[3] = which == 2 ? 0.002 : 0.0;
    if (which > 2)
    {
        c.mapping = make_mapping(names[which], NULL);
        options.mapping = c.mapping;
        options.width = which == 6 ? 101 : 50; /* faces that tiles do not fit */
        options.height = which == 6 ? 101 : 300;
        options.pixel_centre = 0.5;
    }
    ck_assert_msg(cm_camera_create(&options, &c.camera) == CM_OK, "%s", c.name);
    c.width = options.width;
    c.height = options.height;
    c.rays = rays_of_pixels(&c);
    return c;
}

static inline void drop(some_camera *c)
{
    cm_camera_destroy(c->camera);
    cm_mapping_destroy(c->mapping);
    free(c->rays);
}

static inline cm_raster *canvas(const some_camera *c, const char *instructions)
{
    cm_raster *raster = NULL;
    ck_assert_int_eq(cm_raster_create(c->camera, 0.0, instructions, &raster), CM_OK);
    return raster;
}

static inline void ray_of(const some_camera *c, size_t i, double ray[3])
{
    for (size_t k = 0; k < 3; k++)
    {
        ray[k] = c->rays[k * c->width * c->height + i];
    }
}

static inline double next_random(uint32_t *state)
{
    *state = *state * 1664525u + 1013904223u;
    return (double)(*state >> 8) * 0x1p-23 - 1.0;
}

/* A box around the camera, each side of n x n squares of two triangles. */
typedef struct closed_box
{
    cm_triangles triangles;
    double *position;
    uint32_t *index;
} closed_box;

static inline closed_box make_box(size_t n, double size)
{
    closed_box box = {.triangles = {.size = sizeof box.triangles}};
    const size_t side = (n + 1) * (n + 1);
    box.position = calloc(6 * side * 3, sizeof *box.position);
    box.index = calloc(6 * n * n * 6, sizeof *box.index);
    size_t count = 0;
    for (size_t f = 0; f < 6; f++)
    {
        for (size_t i = 0; i < side; i++)
        {
            double *p = box.position + 3 * (f * side + i);
            const double u = 2.0 * (double)(i % (n + 1)) / (double)n - 1.0;
            const double v = 2.0 * (double)(i / (n + 1)) / (double)n - 1.0;
            p[f % 3] = f < 3 ? size : -size;
            p[(f + 1) % 3] = u * size;
            p[(f + 2) % 3] = v * size;
        }
        for (size_t i = 0; i < n * n; i++)
        {
            const uint32_t at = (uint32_t)(f * side + i / n * (n + 1) + i % n);
            const uint32_t below = at + (uint32_t)n + 1;
            const uint32_t corners[6] = {at, at + 1, below, below, at + 1, below + 1};
            memcpy(box.index + count, corners, sizeof corners);
            count += 6;
        }
    }
    box.triangles.vertex_count = 6 * side;
    box.triangles.position = box.position;
    box.triangles.index = box.index;
    box.triangles.triangle_count = count / 3;
    return box;
}

static inline void drop_box(closed_box *box)
{
    free(box->position);
    free(box->index);
}

#endif
