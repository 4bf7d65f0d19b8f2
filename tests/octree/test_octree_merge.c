/* SPDX-License-Identifier: MIT
 *
 * Maps into maps: one that was updated with all views, short of the ends of the range, and else voxel by voxel.
 */
#include "dense_map.h"

static cm_camera *camera;

static void update_with_colors(cm_octree *octree, uint64_t seed, int has_color)
{
    dice from = {seed};
    const double place[3] = {dice_between(&from, -1.0, 1.0), dice_between(&from, -1.0, 1.0),
                             dice_between(&from, -1.0, 1.0)};
    const double at[3] = {dice_between(&from, -0.5, 0.5), 0.1, 0.2};
    const cm_pose pose = look_at(place, at, 6.28 * throw_dice(&from));
    drawn_view drawn;
    draw_view(&drawn, camera, &pose, 1.2, has_color, &from);
    ck_assert_int_eq(cm_octree_update(octree, &drawn.view, NULL), CM_OK);
    clear_view(&drawn);
}

static cm_octree *drawn_map(const cm_octree_options *options, uint64_t first, uint64_t end)
{
    cm_octree *octree = make_map(options);
    for (uint64_t seed = first; seed < end; seed++)
    {
        update_with_colors(octree, seed, options->color);
    }
    return octree;
}

static void drop_colors(dense_map *map)
{
    memset(map->color, 0, (size_t)(map->n * map->n * map->n) * sizeof *map->color);
}

START_TEST(merging_is_as_updating_with_both)
{
    for (int levels = 1; levels <= 7; levels++)
    {
        for (int compacts = 0; compacts < 2; compacts++)
        {
            const cm_octree_options options = {
                .size = sizeof options, .levels = levels, .edge = ldexp(3.0, -levels)};
            cm_octree *a = drawn_map(&options, 0, 4), *b = drawn_map(&options, 4, 9),
                      *all = drawn_map(&options, 0, 9);
            cm_octree *c = drawn_map(&options, 0, 4);
            if (compacts)
            {
                cm_octree_compact(a);
                cm_octree_compact(b);
            }
            ck_assert_int_eq(cm_octree_merge(a, b, NULL), CM_OK);
            ck_assert_str_eq(maps_differ(a, all), "");
            ck_assert_int_eq(cm_octree_merge(b, c, NULL), CM_OK);
            ck_assert_str_eq(maps_differ(b, all), "");
            ck_assert_uint_eq(cm_octree_step(a), 5);
            cm_octree_destroy(a);
            cm_octree_destroy(b);
            cm_octree_destroy(c);
            cm_octree_destroy(all);
        }
    }
}
END_TEST

/* ---- other roots ---- */

static int clamped(int alpha)
{
    return alpha < 0 ? 0 : alpha > 255 ? 255 : alpha;
}

/* Each voxel of the one takes what is at its centre in the other. */
static void add_dense(dense_map *to, const cm_octree_options *to_options, const cm_octree *from,
                      const cm_pose *pose)
{
    const int64_t n = to->n;
    for (size_t i = 0; i < (size_t)(n * n * n); i++)
    {
        const int64_t place[3] = {(int64_t)i % n, (int64_t)i / n % n, (int64_t)i / n / n};
        double at[3];
        for (int axis = 0; axis < 3; axis++)
        {
            at[axis] =
                to_options->centre[axis] + ((double)(place[axis] - n / 2) + 0.5) * to_options->edge;
        }
        if (pose != NULL)
        {
            cm_pose_apply(pose, at, at);
        }
        cm_voxel voxel;
        cm_octree_at(from, at, 0, &voxel);
        to->alpha[i] =
            (uint8_t)(voxel.edge > 0.0 ? clamped(to->alpha[i] + voxel.alpha - 127) : to->alpha[i]);
    }
}

static void check_other(const cm_octree_options *to_options, const cm_octree_options *from_options,
                        const cm_pose *pose, int evens)
{
    cm_octree *to = drawn_map(to_options, 20, 23),
              *from = drawn_map(from_options, 30, 30 + (uint64_t)(3 * !evens));
    if (evens)
    {
        /* all of it is free, up to the root */
        cm_octree_options options = *from_options;
        options.far = 1e4;
        options.no_return_is_free = 1;
        cm_octree_destroy(from);
        from = make_map(&options);
        const double place[3] = {0.0, 0.0, -1000.0}, at[3] = {0.0, 0.0, 0.0};
        const cm_pose away = look_at(place, at, 0.0);
        dice luck = {3};
        drawn_view drawn;
        draw_view(&drawn, camera, &away, 1.0, 0, &luck);
        for (size_t i = 0; i < (size_t)drawn.view.depth.width * drawn.view.depth.height; i++)
        {
            drawn.depth[i] = NAN;
        }
        ck_assert_int_eq(cm_octree_update(from, &drawn.view, NULL), CM_OK);
        cm_octree_compact(from);
        clear_view(&drawn);
    }
    dense_map wanted = dense_make(to_options->levels), is = dense_make(to_options->levels);
    dense_read(to, &wanted);
    add_dense(&wanted, to_options, from, pose);
    ck_assert_int_eq(cm_octree_merge(to, from, pose), CM_OK);
    dense_read(to, &is);
    drop_colors(&wanted);
    drop_colors(&is);
    const char *text = dense_differs(&is, &wanted);
    ck_assert_msg(text[0] == '\0', "levels %d and %d, centre %g, %d: %s", to_options->levels,
                  from_options->levels, from_options->centre[0], evens, text);
    dense_clear(&wanted);
    dense_clear(&is);
    cm_octree_destroy(to);
    cm_octree_destroy(from);
}

START_TEST(other_roots_are_sampled)
{
    const double edge = 0.0625;
    const double shifts[] = {0.0, 64.0, -64.0, 128.0, 8.0, 3.0, 0.4, 1e6};
    for (int to_levels = 3; to_levels <= 7; to_levels += is_quick() ? 3 : 1)
    {
        for (int from_levels = 4; from_levels <= 8; from_levels += 1)
        {
            for (size_t i = 0; i < sizeof shifts / sizeof *shifts; i++)
            {
                if ((to_levels * 7 + from_levels + (int)i) % 3 != 0)
                {
                    continue;
                }
                const cm_octree_options to = {.size = sizeof to, .levels = to_levels, .edge = edge};
                cm_octree_options from = {.size = sizeof from, .levels = from_levels, .edge = edge};
                from.centre[0] = shifts[i] * edge;
                from.centre[2] = -shifts[i] * edge;
                check_other(&to, &from, NULL, i % 2 != 0);
                check_other(&to, &from, NULL, i % 2 == 0);
            }
        }
    }
}
END_TEST

START_TEST(poses_and_edges_are_sampled)
{
    const double place[3] = {0.3, -0.2, 0.4}, at[3] = {1.0, 0.5, -2.0};
    const cm_pose pose = look_at(place, at, 0.5);
    for (int levels = 2; levels <= 6; levels++)
    {
        const cm_octree_options to = {
            .size = sizeof to, .levels = levels, .edge = ldexp(3.0, -levels)};
        cm_octree_options from = {.size = sizeof from, .levels = 6, .edge = 0.037};
        from.centre[1] = 0.111;
        check_other(&to, &from, &pose, 0);
        check_other(&to, &from, NULL, 0);
        check_other(&from, &to, &pose, 0);
    }
}
END_TEST

/* Its blocks are more than a machine could list. */
START_TEST(large_cubes_are_merged_at_once)
{
    const double place[3] = {0.3, -0.2, 0.4}, at[3] = {1.0, 0.5, -2.0};
    const cm_pose pose = look_at(place, at, 0.5);
    const cm_octree_options inner = {.size = sizeof inner, .levels = 14, .edge = 0.01};
    const cm_octree_options outer = {.size = sizeof outer, .levels = 16, .edge = 0.011};
    cm_octree *to = make_map(&inner), *from = even_map(&outer, 0);
    ck_assert_int_eq(cm_octree_merge(to, from, &pose), CM_OK);
    cm_octree_count count = {.size = sizeof count};
    ck_assert_int_eq(cm_octree_count_voxels(to, &count), CM_OK);
    ck_assert_uint_eq(count.free, (uint64_t)1 << 3 * inner.levels);
    ck_assert_uint_eq(count.occupied, 0);
    cm_octree_destroy(to);
    cm_octree_destroy(from);
}
END_TEST

/* Turned by a quarter, as a quaternion has it: on each axis borders fall on borders of cubes. By a pose across the
 * axes it would be more regions than there is memory for, which is told before anything is done. */
START_TEST(largest_cubes_are_merged_or_refused)
{
    const double place[3] = {0.0, 0.0, 0.0}, half = sqrt(0.5);
    const double turned[4] = {0.0, 0.0, half, half}, none[4] = {0.0, 0.0, 0.0, 1.0};
    const double at[3] = {1.0, 0.5, -2.0};
    const cm_octree_options options = {.size = sizeof options, .levels = 20, .edge = 0.01};
    cm_octree_options half_options = options;
    half_options.levels = 19;
    cm_octree *from = even_map(&half_options, 1);
    cm_octree_count count = {.size = sizeof count};
    for (int turns = 0; turns < 2; turns++)
    {
        cm_pose pose;
        cm_octree *to = make_map(&options);
        ck_assert_int_eq(cm_pose_from_quaternion(place, turns ? turned : none, &pose), CM_OK);
        ck_assert_int_eq(cm_octree_merge(to, from, &pose), CM_OK);
        ck_assert_int_eq(cm_octree_count_voxels(to, &count), CM_OK);
        ck_assert_uint_eq(count.occupied, (uint64_t)1 << 3 * half_options.levels);
        cm_octree_destroy(to);
    }
    const cm_pose across = look_at(place, at, 0.5);
    cm_octree *to = make_map(&options);
    ck_assert_int_eq(cm_octree_merge(to, from, &across), CM_ERROR_MEMORY);
    ck_assert_int_eq(cm_octree_count_voxels(to, &count), CM_OK);
    ck_assert(count.occupied == 0 && cm_octree_step(to) == 0);
    cm_octree_destroy(to);
    cm_octree_destroy(from);
}
END_TEST

/* Where the roots' borders cross each other, too. */
START_TEST(borders_of_large_cubes_are_sampled)
{
    const double place[3] = {0.3, -0.2, 0.4}, at[3] = {1.0, 0.5, -2.0};
    const cm_pose pose = look_at(place, at, 0.5);
    const cm_octree_options to_options = {.size = sizeof to_options, .levels = 7, .edge = 0.02};
    const cm_octree_options from_options = {
        .size = sizeof from_options, .levels = 9, .edge = 0.004};
    for (int is_occupied = 0; is_occupied < 2; is_occupied++)
    {
        cm_octree *to = drawn_map(&to_options, 20, 23),
                  *from = even_map(&from_options, is_occupied);
        dense_map wanted = dense_make(to_options.levels), is = dense_make(to_options.levels);
        dense_read(to, &wanted);
        add_dense(&wanted, &to_options, from, &pose);
        ck_assert_int_eq(cm_octree_merge(to, from, &pose), CM_OK);
        dense_read(to, &is);
        drop_colors(&wanted);
        drop_colors(&is);
        ck_assert_str_eq(dense_differs(&is, &wanted), "");
        dense_clear(&wanted);
        dense_clear(&is);
        cm_octree_destroy(to);
        cm_octree_destroy(from);
    }
}
END_TEST

START_TEST(colors_are_averaged_by_hits)
{
    const cm_octree_options options = {
        .size = sizeof options, .levels = 6, .edge = 0.1, .color = 1};
    cm_octree *a = make_map(&options), *b = make_map(&options);
    const double origin[3] = {0.05, 0.05, 0.05};
    const float point[3] = {1.05f, 0.05f, 0.05f};
    const uint8_t red[3] = {200, 0, 40}, green[3] = {0, 100, 80};
    for (int i = 0; i < 3; i++)
    {
        ck_assert_int_eq(cm_octree_update_points(a, origin, 1, point, red), CM_OK);
    }
    ck_assert_int_eq(cm_octree_update_points(b, origin, 1, point, green), CM_OK);
    ck_assert_int_eq(cm_octree_merge(a, b, NULL), CM_OK);
    cm_voxel voxel;
    const double at[3] = {1.05, 0.05, 0.05};
    ck_assert_int_eq(cm_octree_at(a, at, 0, &voxel), CM_VOXEL_OCCUPIED);
    ck_assert(voxel.has_color && voxel.alpha == 127 + 8);
    ck_assert_msg(abs(voxel.color[0] - 150) <= 1 && abs(voxel.color[1] - 25) <= 1 &&
                      abs(voxel.color[2] - 50) <= 1,
                  "%d %d %d", voxel.color[0], voxel.color[1], voxel.color[2]);
    cm_octree_destroy(a);
    cm_octree_destroy(b);
}
END_TEST

START_TEST(wrong_merges_are_refused)
{
    const cm_octree_options options = {.size = sizeof options, .levels = 6, .edge = 0.1};
    cm_octree_options other = options;
    other.rule = CM_OCTREE_LOG_ODDS;
    other.hit = 1.0;
    other.miss = -0.5;
    other.low = -2.0;
    other.high = 3.5;
    cm_octree *a = make_map(&options), *b = make_map(&other);
    const cm_pose none = {0};
    ck_assert_int_eq(cm_octree_merge(a, a, NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_octree_merge(a, NULL, NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_octree_merge(a, b, NULL), CM_ERROR_UNSUPPORTED);
    ck_assert_int_eq(cm_octree_merge(a, b, &none), CM_ERROR_CAMERA);
    ck_assert_uint_eq(cm_octree_step(a), 0);
    cm_octree_destroy(a);
    cm_octree_destroy(b);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {merging_is_as_updating_with_both,
                                  other_roots_are_sampled,
                                  poses_and_edges_are_sampled,
                                  large_cubes_are_merged_at_once,
                                  largest_cubes_are_merged_or_refused,
                                  borders_of_large_cubes_are_sampled,
                                  colors_are_averaged_by_hits,
                                  wrong_merges_are_refused,
                                  NULL};
    camera = straight_camera(60, 44, 0.5);
    const int result = run_suite("octree merge", tests);
    cm_camera_destroy(camera);
    return result;
}
