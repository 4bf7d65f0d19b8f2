/* SPDX-License-Identifier: MIT
 *
 * A room of quads in a camera's axes, each divided into so many by so many pairs of triangles, and lenses that look at it.
 */
#ifndef TESTS_SIM_LENS_ROOM_H
#define TESTS_SIM_LENS_ROOM_H

#include <cubemap/camera.h>
#include <cubemap/world.h>

#include <stdlib.h>

/* Corner, and the two edges: left, right, ceiling, floor, end, and a board that stands aslant. */
static const double room_quads[6][9] = {
    {-2.0, -1.5, 0.1, 0.0, 3.0, 0.0, 0.0, 0.0, 3.9},
    {2.0, -1.5, 0.1, 0.0, 3.0, 0.0, 0.0, 0.0, 3.9},
    {-2.0, -1.5, 0.1, 4.0, 0.0, 0.0, 0.0, 0.0, 3.9},
    {-2.0, 1.5, 0.1, 4.0, 0.0, 0.0, 0.0, 0.0, 3.9},
    {-2.0, -1.5, 4.0, 4.0, 0.0, 0.0, 0.0, 3.0, 0.0},
    {-0.7, -0.4, 2.0, 0.9, 0.3, 0.5, -0.2, 0.8, 0.1},
};

typedef struct lens_room
{
    size_t vertices, triangles;
    double *plane[3]; /* of coordinates */
    double *position; /* and one vertex behind the other */
    uint32_t *index;
    size_t per_quad; /* triangles */
} lens_room;

static inline lens_room make_room(size_t n)
{
    lens_room room = {.vertices = 6 * (n + 1) * (n + 1), .triangles = 12 * n * n};
    room.per_quad = 2 * n * n;
    room.position = malloc(3 * room.vertices * sizeof *room.position);
    room.index = malloc(3 * room.triangles * sizeof *room.index);
    for (int k = 0; k < 3; k++)
    {
        room.plane[k] = malloc(room.vertices * sizeof *room.plane[k]);
    }
    uint32_t at = 0;
    uint32_t *index = room.index;
    const uint32_t row = (uint32_t)n + 1;
    for (size_t v = 0; v < 6 * (n + 1) * (n + 1); v++, at++)
    {
        const size_t q = v / (n + 1) / (n + 1), j = v / (n + 1) % (n + 1), i = v % (n + 1);
        for (int k = 0; k < 3; k++)
        {
            room.plane[k][v] = room_quads[q][k] + (double)i / (double)n * room_quads[q][3 + k] +
                               (double)j / (double)n * room_quads[q][6 + k];
            room.position[3 * v + (size_t)k] = room.plane[k][v];
        }
        if (i < n && j < n)
        {
            const uint32_t corner[6] = {at, at + 1, at + row, at + 1, at + row + 1, at + row};
            for (int k = 0; k < 6; k++)
            {
                *index++ = corner[k];
            }
        }
    }
    return room;
}

static inline void drop_room(lens_room *room)
{
    for (int k = 0; k < 3; k++)
    {
        free(room->plane[k]);
    }
    free(room->position);
    free(room->index);
}

/* Barrel, all parameters as figure 2, pincushion, and the whole model. */
static const double room_lenses[][14] = {
    {-0.08},
    {-0.05, 0.01, 0.03, -0.01},
    {0.09, 0.01},
    {0.2, 0.05, 0.002, -0.003, 0.01, 0.3, 0.05, 0.0, 0.004, 0.001, -0.003, 0.001, 0.02, -0.03},
};

enum
{
    ROOM_LENSES = sizeof room_lenses / sizeof room_lenses[0]
};

static inline cm_camera_options lens_options(int lens)
{
    cm_camera_options options = {.size = sizeof options, .width = 200, .height = 150};
    options.fx = 100.0;
    options.fy = lens % 2 ? 104.0 : 100.0;
    options.pixel_centre = lens % 2 ? 0.0 : 0.5;
    options.cx = 99.5 + options.pixel_centre + lens;
    options.cy = 74.5 + options.pixel_centre - 2.0 * lens;
    for (int k = 0; k < 14; k++)
    {
        options.distortion[k] = room_lenses[lens][k];
    }
    return options;
}

/* What the lens sees, by rays: depth, and which quad; those are the truth. */
static inline void cast_room(const cm_camera *camera, const lens_room *room, double *depth,
                             uint32_t *quad)
{
    const cm_camera_options *options = cm_camera_describe(camera);
    const size_t n = (size_t)options->width * options->height;
    double *memory = calloc(6 * n, sizeof *memory);
    double *x = memory, *y = x + n, *z = y + n, *column = z + n, *row = column + n, *zero = row + n;
    cm_mesh *mesh = NULL;
    cm_scene *scene = NULL;
    const cm_mesh_options made = {.size = sizeof made,
                                  .vertex_count = room->vertices,
                                  .position = room->position,
                                  .triangle_count = room->triangles,
                                  .index = room->index,
                                  .material = {{1.0, 1.0, 1.0}, 1.0}};
    cm_primitive primitive = {.size = sizeof primitive,
                              .kind = CM_PRIMITIVE_MESH,
                              .pose = {.rotation = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}},
                              .material = {{1.0, 1.0, 1.0}, 1.0}};
    ck_assert_int_eq(cm_mesh_create(&made, &mesh), CM_OK);
    primitive.mesh = mesh;
    ck_assert_int_eq(cm_scene_create(&scene), CM_OK);
    ck_assert_int_eq(cm_scene_add(scene, &primitive, NULL), CM_OK);
    for (size_t i = 0; i < n; i++)
    {
        column[i] = options->pixel_centre + (double)(i % options->width);
        row[i] = options->pixel_centre + (double)(i / options->width);
    }
    cm_camera_ray_array(camera, n, column, row, x, y, z);
    const cm_hit_arrays hit = {.size = sizeof hit, .distance = depth, .triangle = quad};
    cm_scene_cast_array(scene, n, zero, zero, zero, x, y, z, &hit);
    for (size_t i = 0; i < n; i++)
    {
        quad[i] = isfinite(depth[i]) ? quad[i] / (uint32_t)room->per_quad : UINT32_MAX;
    }
    cm_scene_destroy(scene);
    cm_mesh_destroy(mesh);
    free(memory);
}

#endif
