/* SPDX-License-Identifier: MIT
 *
 * What the native library's plain C computes of cameras, a world, and a map of it, for the tests of JavaScript: pixels and
 * rays of a camera with a lens, depths of a room seen by it from three places, maps of one, and the voxels of an octree that
 * has seen all three. scene.test.mjs beside it does the same and reads this in the same order.
 * Usage: native_scene >FILE
 */
#include <cubemap/camera.h>
#include <cubemap/depth.h>
#include <cubemap/octree.h>
#include <cubemap/world.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum
{
    WIDTH = 64,
    HEIGHT = 48,
    PIXELS = WIDTH * HEIGHT,
    VIEWS = 3,
    MOST = 100000
};

static double column[PIXELS], row[PIXELS], ray[3][PIXELS], direction[3][PIXELS], origin[3][PIXELS],
    distance[PIXELS];
static float depth[PIXELS], map[7][PIXELS];
static cm_voxel voxel[MOST];

static void need(int good)
{
    if (!good)
    {
        exit(1);
    }
}

static void put(const void *values, size_t size, size_t n)
{
    need(fwrite(values, size, n, stdout) == n);
}

/* The camera at a place of the room, turned about the vertical by multiples of a right angle: exact numbers. */
static cm_pose pose_of(int view)
{
    static const double ahead[VIEWS][2] = {{1, 0}, {0, 1}, {-1, 0}};
    const double x = ahead[view][0];
    const double y = ahead[view][1];
    /* rows: right, down, forward */
    return (cm_pose){{{{y, -x, 0}, {0, 0, -1}, {x, y, 0}}}, {0.1 * view, -0.05 * view, 1.25}};
}

static void look(const cm_scene *scene, int view)
{
    const cm_pose pose = pose_of(view);
    for (int i = 0; i < PIXELS; i++)
    {
        for (int k = 0; k < 3; k++)
        {
            origin[k][i] = pose.position[k];
            direction[k][i] = pose.rotation.row[0][k] * ray[0][i] +
                              pose.rotation.row[1][k] * ray[1][i] +
                              pose.rotation.row[2][k] * ray[2][i];
        }
    }
    const cm_hit_arrays hit = {.size = sizeof hit, .distance = distance};
    cm_scene_cast_array(scene, PIXELS, origin[0], origin[1], origin[2], direction[0], direction[1],
                        direction[2], &hit);
    put(distance, sizeof *distance, PIXELS);
    for (int i = 0; i < PIXELS; i++)
    {
        depth[i] = (float)distance[i];
    }
}

static cm_view view_of(const cm_camera *camera, int view)
{
    return (cm_view){.size = sizeof(cm_view),
                     .camera = camera,
                     .pose = pose_of(view),
                     .depth = {.size = sizeof(cm_image),
                               .data = depth,
                               .type = CM_PIXEL_FLOAT,
                               .width = WIDTH,
                               .height = HEIGHT,
                               .channels = 1},
                     .depth_unit = 1};
}

static void write_maps(const cm_camera *camera)
{
    cm_rays *rays;
    need(cm_rays_create(camera, "scalar", &rays) == CM_OK);
    const cm_depth_maps maps = {.size = sizeof maps,
                                .vertex = {map[0], map[1], map[2]},
                                .normal = {map[3], map[4], map[5]},
                                .radius = map[6]};
    need(cm_depth_make_maps(rays, depth, 1, &maps) == CM_OK);
    for (int k = 0; k < 7; k++)
    {
        put(map[k], sizeof **map, PIXELS);
    }
    need(cm_depth_smooth(rays, depth, 2, 0.05, 1, map[0]) == CM_OK);
    put(map[0], sizeof **map, PIXELS);
    cm_rays_destroy(rays);
}

static void write_voxels(const cm_octree *octree, int level)
{
    size_t count;
    need(cm_octree_extract(octree, level, MOST, voxel, &count) == CM_OK);
    const double n = (double)count;
    put(&n, sizeof n, 1);
    for (size_t i = 0; i < count; i++)
    {
        const double numbers[5] = {voxel[i].x, voxel[i].y, voxel[i].z, voxel[i].edge,
                                   voxel[i].alpha};
        put(numbers, sizeof *numbers, 5);
    }
}

int main(void)
{
    const cm_camera_options options = {.size = sizeof options,
                                       .width = WIDTH,
                                       .height = HEIGHT,
                                       .fx = 40,
                                       .fy = 41,
                                       .cx = 31.5,
                                       .cy = 23.5,
                                       .distortion = {-0.1, 0.02, 0.001, -0.0005}};
    const cm_octree_options map_options = {
        .size = sizeof map_options, .edge = 0.05, .levels = 9, .instructions = "scalar"};
    cm_camera *camera;
    cm_scene *scene;
    cm_octree *octree;
    need(cm_camera_create(&options, &camera) == CM_OK &&
         cm_scene_create_named("room", &scene) == CM_OK &&
         cm_octree_create(&map_options, &octree) == CM_OK);
    for (int i = 0; i < PIXELS; i++)
    {
        column[i] = i % WIDTH;
        row[i] = i / WIDTH;
    }
    cm_camera_ray_array(camera, PIXELS, column, row, ray[0], ray[1], ray[2]);
    put(ray[0], sizeof **ray, PIXELS);
    put(ray[1], sizeof **ray, PIXELS);
    cm_camera_project_array(camera, PIXELS, ray[0], ray[1], ray[2], column, row);
    put(column, sizeof *column, PIXELS);
    put(row, sizeof *row, PIXELS);
    for (int view = 0; view < VIEWS; view++)
    {
        look(scene, view);
        const cm_view seen = view_of(camera, view);
        need(cm_octree_update(octree, &seen, NULL) == CM_OK);
    }
    write_maps(camera);
    write_voxels(octree, 0);
    write_voxels(octree, 3);
    return ferror(stdout) != 0;
}
