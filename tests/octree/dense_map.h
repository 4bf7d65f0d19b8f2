/* SPDX-License-Identifier: MIT
 *
 * Maps as arrays of all their voxels, and drawn views that go into maps: what the suites of this room compare with.
 */
#ifndef TESTS_OCTREE_DENSE_MAP_H
#define TESTS_OCTREE_DENSE_MAP_H

#include <cubemap/mapping.h>
#include <cubemap/octree.h>

#include "tests/suite.h"

/* One value a voxel of level 0, x fastest; colors are 0, or 1 << 24 and red, green, blue. */
typedef struct dense_map
{
    int64_t n; /* voxels each way */
    uint8_t *alpha;
    uint32_t *color;
} dense_map;

dense_map dense_make(int levels);
void dense_clear(dense_map *map);

/* All voxels of a map, by its walk over what was ever changed; each must come once, in the order of keys. */
void dense_read(const cm_octree *octree, dense_map *map);

/* What differs: "" if nothing does. */
const char *dense_differs(const dense_map *a, const dense_map *b);

/* Are two maps equal, voxel for voxel, colors too? "" if they are. */
const char *maps_differ(const cm_octree *a, const cm_octree *b);

/* The index of a voxel. */
static inline size_t dense_at(const dense_map *map, int64_t x, int64_t y, int64_t z)
{
    return (size_t)(x + map->n * (y + map->n * z));
}

/* Numbers from 0 to 1, the same for the same seed. */
typedef struct dice
{
    uint64_t state;
} dice;
double throw_dice(dice *from);
double dice_between(dice *from, double low, double high);

/* A camera that looks about along z: 0.9 of its width is the focal length. */
cm_camera *straight_camera(uint32_t width, uint32_t height, double pixel_centre);

/* A pose at a place that looks at another, tilted. */
cm_pose look_at(const double place[3], const double at[3], double roll);

/* A view with pictures of its own. */
typedef struct drawn_view
{
    cm_view view;
    float *depth;
    uint8_t *color;
} drawn_view;

/* Planes, steps, holes and noise at depths around a middle; colors at random. Pixels are no finer than the map's voxels need. */
void draw_view(drawn_view *drawn, const cm_camera *camera, const cm_pose *pose, double middle,
               int has_color, dice *from);
void clear_view(drawn_view *drawn);

/* Takes a map on by such a view from somewhere before the middle; the fourth has no colours. */
void add_drawn_view(cm_octree *octree, const cm_camera *camera, int number, dice *from);

/* Options of a map of which a part is in pages; NULL: without pages. */
cm_octree_options paged_options(cm_store *pages);

/* Draw a view and integrate it: the same for the same seed. */
cm_status update_drawn(cm_octree *octree, const cm_camera *camera, uint64_t seed);

/* A map, which must be made. */
cm_octree *make_map(const cm_octree_options *options);

/* A map whose root is one cube: of a hull that no mask sees. Occupied, or free. */
cm_octree *even_map(const cm_octree_options *options, int is_occupied);

/* A pool of so many threads; NULL for one. */
cm_pool *make_pool(unsigned threads);

/* Kind 0: straight, 1: by a lens, 2: all around. */
static inline cm_camera *camera_of(int kind)
{
    cm_camera_options options = {.size = sizeof options,
                                 .width = 61,
                                 .height = 47,
                                 .fx = 50.0,
                                 .fy = 50.0,
                                 .cx = 30.0,
                                 .cy = 23.0};
    cm_mapping *mapping = kind == 2 ? make_mapping("gnomonic", NULL) : NULL;
    options.distortion[0] = kind == 1 ? 0.05 : 0.0;
    if (kind == 2)
    {
        options = (cm_camera_options){.size = sizeof options,
                                      .width = 23,
                                      .height = 6 * 23,
                                      .pixel_centre = 0.5,
                                      .mapping = mapping};
    }
    cm_camera *camera = NULL;
    ck_assert_int_eq(cm_camera_create(&options, &camera), CM_OK);
    cm_mapping_destroy(mapping);
    return camera;
}

#endif
