/* SPDX-License-Identifier: MIT
 *
 * Each is closed where it says so, stands on z = 0 and can be walked through at a height of 1.2 m near x = y = 0.
 */
#include "named_world.h"

#include <string.h>

#define COLORED(r, g, b, of_light) .material = {{r, g, b}, of_light}
#define PLANE(x, y, z, nx, ny, nz, ...)                                                            \
    {                                                                                              \
        .size = sizeof(cm_primitive), .kind = CM_PRIMITIVE_PLANE, .first = {x, y, z},              \
        .second = {nx, ny, nz}, COLORED(__VA_ARGS__)                                               \
    }
#define BOX(x, y, z, to_x, to_y, to_z, ...)                                                        \
    {                                                                                              \
        .size = sizeof(cm_primitive), .kind = CM_PRIMITIVE_BOX, .first = {x, y, z},                \
        .second = {to_x, to_y, to_z}, COLORED(__VA_ARGS__)                                         \
    }
#define SPHERE(x, y, z, r, ...)                                                                    \
    {                                                                                              \
        .size = sizeof(cm_primitive), .kind = CM_PRIMITIVE_SPHERE, .first = {x, y, z},             \
        .radius = r, COLORED(__VA_ARGS__)                                                          \
    }
#define CYLINDER(x, y, z, to_x, to_y, to_z, r, ...)                                                \
    {                                                                                              \
        .size = sizeof(cm_primitive), .kind = CM_PRIMITIVE_CYLINDER, .first = {x, y, z},           \
        .second = {to_x, to_y, to_z}, .radius = r, COLORED(__VA_ARGS__)                            \
    }

/* 6 x 5 x 3 m: walls of six colours, a table, a cupboard, a lamp, a ball and a column. */
static const cm_primitive room[] = {
    PLANE(0, 0, 0, 0, 0, 1, 0.55, 0.42, 0.30, 0.5),
    PLANE(0, 0, 3, 0, 0, -1, 0.95, 0.95, 0.92, 0.9),
    PLANE(3, 0, 0, -1, 0, 0, 0.85, 0.45, 0.35, 0.7),
    PLANE(-3, 0, 0, 1, 0, 0, 0.40, 0.60, 0.80, 0.7),
    PLANE(0, 2.5, 0, 0, -1, 0, 0.90, 0.85, 0.65, 0.8),
    PLANE(0, -2.5, 0, 0, 1, 0, 0.55, 0.75, 0.55, 0.7),
    BOX(1.2, -0.6, 0.70, 2.4, 0.6, 0.75, 0.65, 0.40, 0.20, 0.5),
    CYLINDER(1.8, 0, 0, 1.8, 0, 0.70, 0.08, 0.30, 0.30, 0.32, 0.3),
    BOX(-2.9, 1.2, 0, -2.0, 2.4, 2.0, 0.75, 0.70, 0.60, 0.6),
    SPHERE(1.9, 0.1, 0.95, 0.2, 0.85, 0.10, 0.12, 0.6),
    SPHERE(-1.4, -1.6, 0.45, 0.45, 0.15, 0.35, 0.75, 0.4),
    CYLINDER(2.3, 1.9, 0, 2.3, 1.9, 3, 0.2, 0.88, 0.88, 0.88, 0.8),
    CYLINDER(0, 0, 2.6, 0, 0, 3, 0.15, 1.00, 0.90, 0.50, 0.9),
};

/* 20 x 2 x 2.5 m along x, with doorframes, columns, a pipe and crates. */
static const cm_primitive corridor[] = {
    PLANE(0, 0, 0, 0, 0, 1, 0.45, 0.45, 0.48, 0.4),
    PLANE(0, 0, 2.5, 0, 0, -1, 0.92, 0.92, 0.92, 0.9),
    PLANE(0, 1, 0, 0, -1, 0, 0.80, 0.78, 0.65, 0.7),
    PLANE(0, -1, 0, 0, 1, 0, 0.62, 0.70, 0.78, 0.7),
    PLANE(10, 0, 0, -1, 0, 0, 0.80, 0.30, 0.25, 0.6),
    PLANE(-10, 0, 0, 1, 0, 0, 0.30, 0.65, 0.35, 0.6),
    BOX(3.0, 0.8, 0, 3.2, 1, 2.5, 0.50, 0.30, 0.15, 0.5),
    BOX(3.0, -1, 0, 3.2, -0.8, 2.5, 0.50, 0.30, 0.15, 0.5),
    BOX(3.0, -1, 2.2, 3.2, 1, 2.5, 0.50, 0.30, 0.15, 0.5),
    BOX(-4.2, 0.8, 0, -4.0, 1, 2.5, 0.25, 0.30, 0.50, 0.5),
    BOX(-4.2, -1, 0, -4.0, -0.8, 2.5, 0.25, 0.30, 0.50, 0.5),
    BOX(-4.2, -1, 2.2, -4.0, 1, 2.5, 0.25, 0.30, 0.50, 0.5),
    CYLINDER(-10, 0.85, 2.3, 10, 0.85, 2.3, 0.06, 0.75, 0.75, 0.80, 0.8),
    CYLINDER(6, -0.8, 0, 6, -0.8, 2.5, 0.15, 0.85, 0.80, 0.30, 0.6),
    BOX(5.0, 0.4, 0, 5.6, 0.95, 0.6, 0.70, 0.50, 0.25, 0.5),
    BOX(-7.5, -0.9, 0, -6.8, -0.3, 0.8, 0.35, 0.55, 0.30, 0.5),
    SPHERE(1.5, 0.6, 0.2, 0.2, 0.90, 0.40, 0.10, 0.6),
};

/* Spheres of radii from 5 cm to 1 m on a floor without walls: most rays upwards meet nothing. */
static const cm_primitive spheres[] = {
    PLANE(0, 0, 0, 0, 0, 1, 0.60, 0.60, 0.60, 0.5),
    SPHERE(4, 0, 1.00, 1.00, 0.80, 0.20, 0.20, 0.5),
    SPHERE(3, 2, 0.60, 0.60, 0.20, 0.70, 0.30, 0.6),
    SPHERE(3, -2, 0.60, 0.60, 0.20, 0.35, 0.80, 0.4),
    SPHERE(2, 0.8, 0.25, 0.25, 0.90, 0.80, 0.20, 0.8),
    SPHERE(2, -0.8, 0.25, 0.25, 0.60, 0.25, 0.70, 0.7),
    SPHERE(1.5, 0.2, 0.10, 0.10, 0.20, 0.75, 0.75, 0.9),
    SPHERE(1.3, -0.2, 0.05, 0.05, 0.95, 0.55, 0.15, 0.3),
    SPHERE(-4, 1, 0.80, 0.80, 0.90, 0.90, 0.95, 0.9),
    SPHERE(-3, -2, 0.40, 0.40, 0.35, 0.25, 0.15, 0.2),
    SPHERE(0, 4, 1.50, 0.50, 0.15, 0.55, 0.55, 0.5),
    SPHERE(0, -4, 0.70, 0.70, 0.75, 0.55, 0.60, 0.6),
};

static const named_world worlds[] = {
    {"room", room, sizeof room / sizeof *room},
    {"corridor", corridor, sizeof corridor / sizeof *corridor},
    {"spheres", spheres, sizeof spheres / sizeof *spheres},
};

const named_world *find_named_world(const char *name)
{
    for (size_t i = 0; i < sizeof worlds / sizeof *worlds; i++)
    {
        if (strcmp(worlds[i].name, name) == 0)
        {
            return &worlds[i];
        }
    }
    return NULL;
}

const char *cm_scene_name_at(size_t index)
{
    return index < sizeof worlds / sizeof *worlds ? worlds[index].name : NULL;
}
