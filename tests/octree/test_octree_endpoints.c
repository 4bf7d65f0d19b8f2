/* SPDX-License-Identifier: MIT
 *
 * Maps that leave free space unknown: each voxel has the hits that a map of each view alone has there, and no miss.
 */
#include "dense_map.h"

enum
{
    LEVELS = 6,
    VIEWS = 3
};

static cm_octree_options options_of(int endpoints_only)
{
    return (cm_octree_options){.size = sizeof(cm_octree_options),
                               .levels = LEVELS,
                               .edge = 0.05,
                               .color = 1,
                               .endpoints_only = endpoints_only};
}

/* A view, or its pixels' depths as points from where it is. */
static void add(cm_octree *octree, const drawn_view *drawn, int as_points)
{
    float xyz[150];
    const cm_pose *pose = &drawn->view.pose;
    for (int i = 0; i < 150; i++)
    {
        xyz[i] = (float)pose->position[i % 3] + drawn->depth[i] * (0.3f - 0.02f * (float)(i % 7));
    }
    ck_assert_int_eq(as_points
                         ? cm_octree_update_points(octree, pose->position, 50, xyz, drawn->color)
                         : cm_octree_update(octree, &drawn->view, NULL),
                     CM_OK);
}

/* Hits of a view alone are added to what a map of endpoints is to have. */
static void expect(dense_map *wanted, const drawn_view *drawn, double footprint, int as_points,
                   size_t *missed)
{
    cm_octree_options options = options_of(0);
    options.footprint = footprint;
    cm_octree *alone = make_map(&options);
    dense_map of = dense_make(LEVELS);
    add(alone, drawn, as_points);
    dense_read(alone, &of);
    for (size_t i = 0; i < (size_t)1 << 3 * LEVELS; i++)
    {
        wanted->alpha[i] = (uint8_t)(wanted->alpha[i] + (of.alpha[i] > 127 ? 2 : 0));
        *missed += of.alpha[i] < 127;
    }
    dense_clear(&of);
    cm_octree_destroy(alone);
}

static void check(int kind, double footprint, int as_points)
{
    cm_camera *camera = camera_of(kind);
    cm_octree_options options = options_of(1);
    options.footprint = footprint;
    cm_octree *octree = make_map(&options);
    dense_map wanted = dense_make(LEVELS), is = dense_make(LEVELS);
    memset(wanted.alpha, 127, (size_t)1 << 3 * LEVELS);
    dice from = {(uint64_t)kind + 7};
    size_t missed = 0, hit = 0;
    for (int i = 0; i < VIEWS; i++)
    {
        const double place[3] = {dice_between(&from, -0.3, 0.3), 0.1 * i, -1.1};
        const double at[3] = {0.1, 0.2, 0.3};
        const cm_pose pose = look_at(place, at, 0.2 * i);
        drawn_view drawn;
        draw_view(&drawn, camera, &pose, 1.2, 1, &from);
        add(octree, &drawn, as_points);
        expect(&wanted, &drawn, footprint, as_points, &missed);
        clear_view(&drawn);
    }
    dense_read(octree, &is);
    for (size_t i = 0; i < (size_t)1 << 3 * LEVELS; i++)
    {
        ck_assert_msg(is.alpha[i] == wanted.alpha[i], "kind %d voxel %zu: %d, not %d", kind, i,
                      is.alpha[i], wanted.alpha[i]);
        hit += is.alpha[i] > 127;
        ck_assert((is.color[i] != 0) == (is.alpha[i] > 127));
    }
    ck_assert_msg(missed > 200 && hit > 30, "kind %d: %zu missed, %zu hit", kind, missed, hit);
    dense_clear(&wanted);
    dense_clear(&is);
    cm_octree_destroy(octree);
    cm_camera_destroy(camera);
}

START_TEST(views_hit_and_miss_nothing)
{
    for (int kind = 0; kind < 3; kind++)
    {
        check(kind, 0.0, 0);
    }
    check(0, 0.5, 0);
}
END_TEST

START_TEST(points_hit_and_miss_nothing)
{
    check(0, 0.0, 1);
}
END_TEST

/* A map goes on as it was made, and what needs free space is refused. */
START_TEST(it_is_kept_and_not_mixed)
{
    cm_octree_options options = options_of(1);
    cm_store *store = NULL;
    ck_assert_int_eq(cm_store_create_in_memory(&store), CM_OK);
    cm_octree *octree = make_map(&options), *back = NULL;
    ck_assert_int_eq(cm_octree_save(octree, store, NULL, 0), CM_OK);
    ck_assert_int_eq(cm_octree_load(store, NULL, &back), CM_OK);
    ck_assert(cm_octree_describe(back)->endpoints_only == 1 &&
              cm_octree_describe(back)->no_return_is_free == 0);
    cm_octree_destroy(back);
    cm_octree_destroy(octree);
    cm_store_destroy(store);
    options.far = 3.0;
    options.no_return_is_free = 1;
    octree = NULL;
    ck_assert_int_eq(cm_octree_create(&options, &octree), CM_ERROR_RANGE);
    ck_assert(octree == NULL);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {views_hit_and_miss_nothing, points_hit_and_miss_nothing,
                                  it_is_kept_and_not_mixed, NULL};
    return run_suite("octree endpoints", tests);
}
