/* SPDX-License-Identifier: MIT
 *
 * Many rays through a map that stays as it is, which an index is made for: each must meet what its walk meets first, which asks the
 * map itself; after changes, too.
 */
#include "dense_map.h"

#include <cubemap/pool.h>

#include "modules/octree/ray_index.h"

enum
{
    RAYS = 6000
};

static cm_camera *camera;

typedef struct meeting
{
    int is_met;
    cm_voxel voxel;
} meeting;

static int keep_occupied(void *user, const cm_voxel *voxel)
{
    meeting *first = user;
    first->is_met = voxel->state == CM_VOXEL_OCCUPIED;
    first->voxel = *voxel;
    return first->is_met;
}

static void draw_ray(uint64_t seed, double origin[3], double direction[3], double *far)
{
    dice from = {seed};
    const double size = seed % 3 == 0 ? 1.5 : seed % 3 == 1 ? 0.4 : 6.0;
    for (int axis = 0; axis < 3; axis++)
    {
        origin[axis] = dice_between(&from, -size, size);
        direction[axis] = dice_between(&from, -1.5, 1.5) - (seed % 2 ? origin[axis] : 0.0);
        direction[axis] = seed % 5 == 0 && seed / 5 % 3 != (uint64_t)axis ? 0.0 : direction[axis];
    }
    *far = seed % 7 == 0 ? dice_between(&from, 0.1, 2.0) : 0.0;
}

/* 0 if a ray meets what its walk does. */
static int ray_differs(const cm_octree *octree, uint64_t seed)
{
    double origin[3], direction[3], far;
    draw_ray(seed, origin, direction, &far);
    cm_voxel voxel = {0};
    meeting wanted = {0};
    const int met = cm_octree_ray(octree, origin, direction, far, &voxel);
    (void)cm_octree_walk_ray(octree, origin, direction, far, keep_occupied, &wanted);
    const cm_voxel *other = &wanted.voxel;
    if (met != wanted.is_met)
    {
        return 1;
    }
    return met && (voxel.x != other->x || voxel.y != other->y || voxel.z != other->z ||
                   voxel.level != other->level || voxel.alpha != other->alpha ||
                   voxel.has_color != other->has_color ||
                   memcmp(voxel.color, other->color, sizeof voxel.color) != 0 ||
                   voxel.distance != other->distance);
}

static void check_rays(const cm_octree *octree, const char *what)
{
    size_t met = 0;
    for (uint64_t i = 0; i < RAYS; i++)
    {
        double origin[3], direction[3], far;
        draw_ray(i, origin, direction, &far);
        ck_assert_msg(!ray_differs(octree, i), "%s: ray %d", what, (int)i);
        met += (size_t)cm_octree_ray(octree, origin, direction, far, NULL);
    }
    ck_assert_msg(met > RAYS / 50, "%s: only %d rays meet anything", what, (int)met);
    ck_assert_msg(cm_ray_index_of(octree) != NULL, "%s: there is no index", what);
}

static void add_views(cm_octree *octree, int first, int count)
{
    for (int i = first; i < first + count; i++)
    {
        dice from = {(uint64_t)i + 100};
        add_drawn_view(octree, camera, i, &from);
    }
}

START_TEST(many_rays_meet_what_few_do)
{
    for (int levels = 3; levels <= 9; levels += 2)
    {
        for (int rule = CM_OCTREE_COUNTS; rule <= CM_OCTREE_LOG_ODDS; rule++)
        {
            const cm_octree_options options = {.size = sizeof options,
                                               .levels = levels,
                                               .edge = ldexp(3.2, -levels),
                                               .color = levels != 7,
                                               .rule = rule,
                                               .hit = 0.85,
                                               .miss = -0.4,
                                               .low = -2.0,
                                               .high = 3.5,
                                               .footprint = levels == 5 ? 2.0 : 0.0};
            cm_octree *octree = make_map(&options);
            add_views(octree, 0, 3);
            check_rays(octree, "views");
            add_views(octree, 3, 2);
            check_rays(octree, "more views");
            ck_assert_int_eq(cm_octree_compact(octree), CM_OK);
            check_rays(octree, "compacted");
            add_views(octree, 5, 1);
            check_rays(octree, "opened again");
            cm_octree_destroy(octree);
        }
    }
}
END_TEST

START_TEST(other_changes_are_seen)
{
    const cm_octree_options options = {
        .size = sizeof options, .levels = 8, .edge = ldexp(3.2, -8), .color = 1};
    cm_octree *octree = make_map(&options), *other = make_map(&options);
    add_views(octree, 0, 2);
    add_views(other, 7, 2);
    check_rays(octree, "first");
    ck_assert_int_eq(cm_octree_merge(octree, other, NULL), CM_OK);
    check_rays(octree, "merged");
    const double eye[3] = {0.0, 0.0, -1.0};
    const float points[6] = {0.3f, 0.2f, 0.7f, -0.4f, 0.1f, 0.5f};
    const uint8_t colors[6] = {200, 100, 50, 1, 2, 3};
    for (int i = 0; i < 40; i++)
    {
        ck_assert_int_eq(cm_octree_update_points(octree, eye, 2, points, colors), CM_OK);
    }
    check_rays(octree, "points");
    cm_octree_destroy(octree);
    cm_octree_destroy(other);
}
END_TEST

/* All of a hull is even cubes, large ones too. */
START_TEST(rays_meet_hulls)
{
    const cm_octree_options options = {.size = sizeof options, .levels = 8, .edge = ldexp(3.2, -8)};
    cm_octree *octree = make_map(&options);
    uint8_t mask[64 * 64];
    for (int i = 0; i < 64 * 64; i++)
    {
        const int x = i % 64 - 32, y = i / 64 - 32;
        mask[i] = x * x + y * y < 500;
    }
    cm_camera *of_masks = straight_camera(64, 64, 0.5);
    const double places[2][3] = {{0.0, 0.0, -1.9}, {1.9, 0.1, 0.0}}, at[3] = {0.0, 0.0, 0.0};
    cm_view views[2];
    for (int i = 0; i < 2; i++)
    {
        views[i] = (cm_view){.size = sizeof(cm_view), .camera = of_masks};
        views[i].pose = look_at(places[i], at, 0.1);
        views[i].color = (cm_image){.size = sizeof(cm_image),
                                    .data = mask,
                                    .type = CM_PIXEL_U8,
                                    .width = 64,
                                    .height = 64,
                                    .channels = 1};
    }
    /* of a map that has nothing yet: what they leave is forgotten, so that there is an index of the hull */
    for (uint64_t i = 0; i < RAYS; i++)
    {
        double origin[3], direction[3], far;
        draw_ray(i, origin, direction, &far);
        ck_assert(!cm_octree_ray(octree, origin, direction, far, NULL));
    }
    ck_assert_int_eq(cm_hull_carve(octree, 2, views, 0, NULL), CM_OK);
    check_rays(octree, "hull");
    cm_octree_destroy(octree);
    cm_camera_destroy(of_masks);
}
END_TEST

/* A ray that all but stands still along an axis, at the border of the index' box: 0 times infinity is no place. */
START_TEST(rays_along_a_border)
{
    const cm_octree_options options = {.size = sizeof options, .levels = 8, .edge = 0.01};
    cm_octree *octree = make_map(&options);
    const double eye[3] = {0.0, 0.0, -1.0};
    for (int i = 0; i < 40; i++)
    {
        const float points[6] = {0.505f, 0.005f, 0.005f, 0.705f, 0.205f, 0.005f};
        ck_assert_int_eq(cm_octree_update_points(octree, eye, 2, points, NULL), CM_OK);
    }
    const double origin[3] = {0.1, 0.0, 0.005};
    const double small[] = {1e-311, 5e-324, 1e-300, 1e-290, -1e-311, 0.0};
    for (size_t i = 0; i < sizeof small / sizeof small[0]; i++)
    {
        const double direction[3] = {1.0, small[i], 0.0};
        cm_voxel before = {0}, after = {0};
        ck_assert_int_eq(cm_octree_compact(octree), CM_OK);
        const int is_met = cm_octree_ray(octree, origin, direction, 0.0, &before);
        for (int k = 0; k < RAYS; k++)
        {
            (void)cm_octree_ray(octree, origin, direction, 0.0, NULL);
        }
        ck_assert_ptr_nonnull(cm_ray_index_of(octree));
        ck_assert_int_eq(cm_octree_ray(octree, origin, direction, 0.0, &after), is_met);
        ck_assert(is_met && before.x == after.x && before.distance == after.distance);
    }
    cm_octree_destroy(octree);
}
END_TEST

/* Saving packs blocks, of which an index has values of its own. */
static int count_job(void *user, const cm_voxel *voxel)
{
    *(int *)user += voxel->state == CM_VOXEL_OCCUPIED;
    return 0;
}

/* Of what begins at far, with an index and without, and of what begins behind it. */
START_TEST(far_belongs_to_a_ray)
{
    const cm_octree_options options = {
        .size = sizeof options, .levels = 5, .edge = 0.25, .endpoints_only = 1};
    cm_octree *octree = make_map(&options);
    const float point[3] = {1.1f, 0.1f, 0.1f};
    const double origin[3] = {0.0, 0.125, 0.125}, along[3] = {2.0, 0.0, 0.0};
    ck_assert_int_eq(cm_octree_update_points(octree, origin, 1, point, NULL), CM_OK);
    cm_voxel voxel;
    int walked = 0;
    ck_assert_int_eq(cm_octree_walk_ray(octree, origin, along, 1.0, count_job, &walked), CM_OK);
    ck_assert_int_eq(walked, 1);
    for (int i = 0; i < 1000; i++) /* more than make an index */
    {
        ck_assert_msg(cm_octree_ray(octree, origin, along, 1.0, &voxel) && voxel.distance == 1.0,
                      "ray %d does not meet what is as far as far", i);
        ck_assert(!cm_octree_ray(octree, origin, along, 0.9999999999, &voxel));
    }
    cm_octree_destroy(octree);
}
END_TEST

START_TEST(saving_keeps_an_index)
{
    const cm_octree_options options = {
        .size = sizeof options, .levels = 8, .edge = ldexp(3.2, -8), .color = 1};
    cm_octree *octree = make_map(&options);
    cm_store *store = NULL;
    ck_assert_int_eq(cm_store_create_in_memory(&store), CM_OK);
    for (int i = 0; i < 3; i++)
    {
        add_views(octree, i, 1);
        ck_assert_ptr_null(octree->ray_index);
        check_rays(octree, "views");
        const struct cm_ray_index *index = octree->ray_index;
        ck_assert_int_eq(cm_octree_save(octree, store, NULL, 0), CM_OK);
        ck_assert_ptr_eq(octree->ray_index, index);
        check_rays(octree, "saved");
    }
    cm_octree_destroy(octree);
    cm_store_destroy(store);
}
END_TEST

typedef struct many_rays
{
    const cm_octree *octree;
    uint8_t differs[RAYS];
} many_rays;

static void cast_some(size_t begin, size_t end, void *user)
{
    many_rays *rays = user;
    for (size_t i = begin; i < end; i++)
    {
        rays->differs[i] = (uint8_t)ray_differs(rays->octree, i);
    }
}

START_TEST(threads_share_an_index)
{
    const cm_octree_options options = {
        .size = sizeof options, .levels = 7, .edge = ldexp(3.2, -7), .color = 1};
    cm_octree *octree = make_map(&options);
    cm_pool *pool = make_pool(4);
    for (int round = 0; round < 5; round++)
    {
        add_views(octree, round, 1);
        many_rays rays = {.octree = octree};
        cm_pool_run(pool, RAYS, 1, cast_some, &rays);
        for (size_t i = 0; i < RAYS; i++)
        {
            ck_assert_msg(!rays.differs[i], "ray %d", (int)i);
        }
    }
    cm_pool_destroy(pool);
    cm_octree_destroy(octree);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {many_rays_meet_what_few_do,
                                  other_changes_are_seen,
                                  rays_meet_hulls,
                                  rays_along_a_border,
                                  far_belongs_to_a_ray,
                                  saving_keeps_an_index,
                                  threads_share_an_index,
                                  NULL};
    camera = straight_camera(160, 120, 0.5);
    const int result = run_suite("octree rays", tests);
    cm_camera_destroy(camera);
    return result;
}
