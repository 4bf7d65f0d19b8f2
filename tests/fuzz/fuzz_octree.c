/* SPDX-License-Identifier: MIT
 *
 * Small maps, driven by the input: views of small cameras, points, merging, compaction, hulls and pictures in any order, and
 * after each what is asked agrees: voxels that are extracted are occupied, rays and the nearest end at such, a saved map is the
 * same. And arguments that are none.
 */
#include <cubemap/octree.h>

#include <math.h>

#include "fuzz.h"

enum
{
    WIDTH = 9,
    HEIGHT = 7,
    PIXELS = WIDTH * HEIGHT,
    POINTS = 40,
    VOXELS_MOST = 4096
};

static double amount(supply *from)
{
    const uint8_t kind = take_byte(from);
    return kind == 255 ? take_double(from) : (kind % 4 == 0 ? 1.0 : 4.0) * take_fraction(from);
}

static cm_pose take_pose(supply *from)
{
    double twist[6];
    cm_pose pose;
    for (int i = 0; i < 6; i++)
    {
        twist[i] = amount(from);
    }
    cm_pose_exp(twist, &pose);
    return pose;
}

static cm_camera *take_camera(supply *from)
{
    const uint8_t kind = take_byte(from);
    cm_camera_options options = {.size = sizeof options,
                                 .width = WIDTH,
                                 .height = HEIGHT,
                                 .fx = 4.0 + kind % 8,
                                 .fy = 4.0,
                                 .cx = 4.0,
                                 .cy = 3.0,
                                 .distortion = {kind >= 128 ? -0.1 : 0.0}};
    cm_camera *camera = NULL;
    EXPECT(cm_camera_create(&options, &camera) == CM_OK, "no camera");
    return camera;
}

/* ---- what is asked */

typedef struct voxel_list
{
    cm_voxel voxel[VOXELS_MOST];
    size_t count;
} voxel_list;

/* 0 if there are too many. */
static int extract(const cm_octree *map, int level, voxel_list *list)
{
    list->count = 0;
    const cm_status status = cm_octree_extract(map, level, VOXELS_MOST, list->voxel, &list->count);
    EXPECT(status == CM_OK || (status == CM_ERROR_SPACE && list->count > VOXELS_MOST), "%d",
           (int)status);
    return status == CM_OK;
}

static void check_voxel(const cm_octree *map, const cm_voxel *voxel)
{
    const double point[3] = {voxel->x, voxel->y, voxel->z};
    cm_voxel again;
    EXPECT(voxel->state == CM_VOXEL_OCCUPIED && voxel->alpha > 127, "alpha %d", voxel->alpha);
    EXPECT(cm_octree_at(map, point, voxel->level, &again) == CM_VOXEL_OCCUPIED, "%g %g %g",
           point[0], point[1], point[2]);
    EXPECT(again.alpha == voxel->alpha && memcmp(again.color, voxel->color, 3) == 0,
           "another voxel");
}

static int count_walk(void *user, const cm_voxel *voxel)
{
    EXPECT(voxel->state != CM_VOXEL_UNKNOWN && voxel->edge > 0.0, "unknown");
    return ++*(int *)user > 100000;
}

static void ask(const cm_octree *map, supply *from)
{
    static voxel_list list;
    double point[3], direction[3];
    for (int i = 0; i < 3; i++)
    {
        point[i] = amount(from);
        direction[i] = amount(from);
    }
    cm_voxel voxel;
    if (cm_octree_ray(map, point, direction, 0.0, &voxel))
    {
        EXPECT(voxel.distance >= 0.0, "%g", voxel.distance);
        check_voxel(map, &voxel);
    }
    if (cm_octree_nearest(map, point, 2.0, &voxel))
    {
        EXPECT(voxel.distance <= 2.0, "%g", voxel.distance);
        check_voxel(map, &voxel);
    }
    const int state = cm_octree_at(map, point, take_byte(from) % 8, NULL);
    EXPECT(state >= 0 && state <= 2, "state %d", state);
    int steps = 0;
    const cm_status walked = cm_octree_walk_ray(map, point, direction, 9.0, count_walk, &steps);
    EXPECT(walked == CM_OK || walked == CM_ERROR_ARGUMENT || walked == CM_ERROR_RANGE, "%d",
           (int)walked);
    const double least[3] = {-1.0, -1.0, -1.0};
    const double greatest[3] = {1.0, 1.0, 1.0};
    (void)cm_octree_walk_box(map, least, greatest, count_walk, &steps);
    (void)cm_octree_walk_changes(map, cm_octree_step(map) / 2, count_walk, &steps);
    if (extract(map, 0, &list))
    {
        cm_octree_count count = {.size = sizeof count};
        EXPECT(cm_octree_count_voxels(map, &count) == CM_OK, "no count");
        EXPECT(cm_octree_describe(map)->footprint > 0.0 || count.occupied == list.count,
               "%zu voxels", list.count);
        for (size_t i = 0; i < list.count; i++)
        {
            check_voxel(map, &list.voxel[i]);
        }
    }
}

/* ---- what is done */

static void add_view(cm_octree *map, supply *from)
{
    static float depth[PIXELS];
    static uint8_t color[3 * PIXELS];
    cm_camera *camera = take_camera(from);
    const cm_pose pose = take_pose(from);
    for (int i = 0; i < PIXELS; i++)
    {
        const uint8_t byte = take_byte(from);
        depth[i] = byte == 255 ? (float)take_double(from) : (float)byte / 64.0f;
        color[3 * i] = byte;
    }
    cm_view view = {.size = sizeof view, .camera = camera, .pose = pose, .depth_unit = 1.0};
    view.depth = (cm_image){sizeof view.depth, depth, CM_PIXEL_FLOAT, WIDTH, HEIGHT, 1, 0, 0};
    if (take_byte(from) % 2 == 0)
    {
        view.color = (cm_image){sizeof view.color, color, CM_PIXEL_U8, WIDTH, HEIGHT, 3, 0, 0};
    }
    const cm_status status = cm_octree_update(map, &view, NULL);
    EXPECT(status == CM_OK || status == CM_ERROR_CAMERA, "%d", (int)status);
    cm_camera_destroy(camera);
}

static void add_points(cm_octree *map, supply *from)
{
    float xyz[3 * POINTS];
    uint8_t rgb[3 * POINTS];
    double origin[3];
    const size_t n = take_byte(from) % POINTS;
    for (int i = 0; i < 3; i++)
    {
        origin[i] = amount(from);
    }
    for (size_t i = 0; i < 3 * n; i++)
    {
        xyz[i] = (float)amount(from);
        rgb[i] = (uint8_t)i;
    }
    const cm_status status =
        cm_octree_update_points(map, origin, n, xyz, take_byte(from) % 2 ? rgb : NULL);
    EXPECT(status == CM_OK || status == CM_ERROR_RANGE, "%d", (int)status);
}

static void draw(const cm_octree *map, supply *from)
{
    float color[3 * PIXELS], depth[PIXELS];
    cm_camera *camera = take_camera(from);
    const cm_pose pose = take_pose(from);
    cm_octree_shading shading = {.size = sizeof shading,
                                 .coarsest = take_byte(from) % 6,
                                 .far = 5.0,
                                 .light = take_byte(from) % 2};
    cm_image picture = {sizeof picture, color, CM_PIXEL_FLOAT, WIDTH, HEIGHT, 3, 0, 0};
    cm_image range = {sizeof range, depth, CM_PIXEL_FLOAT, WIDTH, HEIGHT, 1, 0, 0};
    if (cm_octree_render(map, camera, &pose, &shading, &picture, &range) == CM_OK)
    {
        for (int i = 0; i < 3 * PIXELS; i++)
        {
            EXPECT(color[i] >= 0.0f && color[i] <= 1.0001f, "%g", (double)color[i]);
        }
    }
    cm_camera_destroy(camera);
}

static cm_octree *make_map(uint8_t kind)
{
    const cm_octree_options options = {.size = sizeof options,
                                       .edge = 0.125,
                                       .levels = 1 + kind % 7,
                                       .centre = {0.01, 0.02, 0.03},
                                       .rule = kind / 64 % 2,
                                       .hit = 0.85,
                                       .miss = -0.4,
                                       .low = -2.0,
                                       .high = 3.5,
                                       .far = kind & 8 ? 3.0 : 0.0,
                                       .no_return_is_free = kind & 8 ? 1 : 0,
                                       .endpoints_only = (kind & 12) == 4,
                                       .footprint = kind & 16 ? 1.0 : 0.0,
                                       .noise = kind & 32 ? 0.02 : 0.0,
                                       .color = kind / 128};
    cm_octree *map = NULL;
    EXPECT(cm_octree_create(&options, &map) == CM_OK, "kind %d", kind);
    return map;
}

static void carve(const cm_octree *like, supply *from)
{
    static uint8_t mask[PIXELS];
    cm_octree *map = make_map((uint8_t)(cm_octree_describe(like)->levels - 1));
    cm_camera *camera = take_camera(from);
    for (int i = 0; i < PIXELS; i++)
    {
        mask[i] = take_byte(from) % 2;
    }
    cm_view view = {
        .size = sizeof view, .camera = camera, .pose = take_pose(from), .depth_unit = 1.0};
    view.color = (cm_image){sizeof view.color, mask, CM_PIXEL_U8, WIDTH, HEIGHT, 1, 0, 0};
    const cm_status status = cm_hull_carve(map, 1, &view, take_byte(from) % 2, NULL);
    EXPECT(status == CM_OK || status == CM_ERROR_CAMERA || status == CM_ERROR_ARGUMENT, "%d",
           (int)status);
    cm_camera_destroy(camera);
    cm_octree_destroy(map);
}

/* Bad arguments are told, and change nothing. */
static void refuse(cm_octree *map)
{
    cm_octree *none = NULL;
    EXPECT(cm_octree_create(NULL, &none) == CM_ERROR_ARGUMENT && none == NULL, "NULL");
    EXPECT(cm_octree_update(map, NULL, NULL) == CM_ERROR_ARGUMENT, "NULL");
    EXPECT(cm_octree_update_points(map, NULL, 0, NULL, NULL) == CM_ERROR_ARGUMENT, "NULL");
    EXPECT(cm_octree_merge(map, map, NULL) == CM_ERROR_ARGUMENT, "itself");
    EXPECT(cm_octree_extract(map, 0, 0, NULL, NULL) == CM_ERROR_ARGUMENT, "NULL");
    EXPECT(cm_octree_render(map, NULL, NULL, NULL, NULL, NULL) == CM_ERROR_ARGUMENT, "NULL");
    EXPECT(cm_hull_carve(map, 0, NULL, 0, NULL) == CM_ERROR_ARGUMENT, "NULL");
    const double nowhere[3] = {(double)NAN, 0.0, 0.0};
    cm_voxel voxel;
    EXPECT(cm_octree_at(map, nowhere, 0, &voxel) == CM_VOXEL_UNKNOWN && voxel.edge == 0.0, "NaN");
    EXPECT(cm_octree_ray(map, nowhere, nowhere, 0.0, NULL) == 0, "NaN");
    EXPECT(cm_octree_nearest(map, nowhere, 1.0, NULL) == 0, "NaN");
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    supply from = {data, size};
    const uint8_t kind = take_byte(&from);
    cm_octree *map[2] = {make_map(kind), make_map(kind)};
    refuse(map[0]);
    for (int i = 0; i < 12 && from.left > 0; i++)
    {
        cm_octree *at = map[i % 2];
        const uint8_t what = take_byte(&from);
        switch (what % 7)
        {
        case 0:
        case 1:
            add_view(at, &from);
            break;
        case 2:
            add_points(at, &from);
            break;
        case 3:
        {
            const cm_pose pose = take_pose(&from);
            const cm_status status = cm_octree_merge(map[0], map[1], what & 128 ? &pose : NULL);
            EXPECT(status == CM_OK || status == CM_ERROR_CAMERA, "%d", (int)status);
            break;
        }
        case 4:
            EXPECT(cm_octree_compact(at) == CM_OK, "compact");
            break;
        case 5:
            draw(at, &from);
            break;
        default:
            carve(at, &from);
            break;
        }
        ask(at, &from);
    }
    cm_octree_destroy(map[0]);
    cm_octree_destroy(map[1]);
    return 0;
}
