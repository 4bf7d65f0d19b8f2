/* SPDX-License-Identifier: MIT
 *
 * Voxels of a footprint: which size is told, and what comes after, does not depend on how a map is kept. A block that all became
 * free is one of that alpha whether its cells are still there, with misses that wait, or were packed away.
 */
#include <cubemap/store.h>

#include "dense_map.h"

enum
{
    LEVELS = 6,
    N = 1 << LEVELS
};

/* After a hit two misses make a voxel as free as can be, but a block that was hit before is kept for five. */
static cm_octree_options footprint_options(int kind)
{
    return (cm_octree_options){.size = sizeof(cm_octree_options),
                               .levels = LEVELS,
                               .edge = 0.05,
                               .rule = CM_OCTREE_LOG_ODDS,
                               .hit = 0.5,
                               .miss = -1.0,
                               .low = -1.0,
                               .high = 3.0,
                               .footprint = kind == 2 ? 0.6 : 2.0};
}

/* A wall at a depth, or range, in front of a place on the axis of z. */
static void see_wall(cm_octree *octree, int kind, double place, float depth)
{
    float wall[23 * 6 * 23];
    cm_camera *camera = camera_of(kind);
    const cm_camera_options *of = cm_camera_describe(camera);
    cm_view view = {
        .size = sizeof view,
        .camera = camera,
        .pose = {.rotation = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, .position = {0.01, 0.02, place}},
        .depth_unit = 1.0,
        .depth = {.size = sizeof view.depth,
                  .data = wall,
                  .type = CM_PIXEL_FLOAT,
                  .width = of->width,
                  .height = of->height,
                  .channels = 1}};
    ck_assert(sizeof wall / sizeof *wall >= (size_t)of->width * of->height);
    for (size_t i = 0; i < sizeof wall / sizeof *wall; i++)
    {
        wall[i] = depth;
    }
    ck_assert_int_eq(cm_octree_update(octree, &view, NULL), CM_OK);
    cm_camera_destroy(camera);
}

/* A wall was there, near and in small cells, and is gone: its blocks are all free. */
static cm_octree *map_of_former_wall(int kind)
{
    const cm_octree_options options = footprint_options(kind);
    cm_octree *octree = make_map(&options);
    see_wall(octree, kind, -2.4, 1.85f);
    see_wall(octree, kind, -2.4, 3.5f);
    see_wall(octree, kind, -2.4, 3.5f);
    return octree;
}

static size_t larger_voxels(const cm_octree *octree)
{
    size_t larger = 0;
    for (int i = 0; i < N * N * N; i++)
    {
        const double point[3] = {0.05 * (i % N - N / 2 + 0.5), 0.05 * (i / N % N - N / 2 + 0.5),
                                 0.05 * (i / N / N - N / 2 + 0.5)};
        cm_voxel voxel;
        cm_octree_at(octree, point, 0, &voxel);
        larger += voxel.level > 0;
    }
    return larger;
}

/* Is each voxel told alike? */
static void check_alike(const cm_octree *a, const cm_octree *b)
{
    for (int i = 0; i < N * N * N; i++)
    {
        const double point[3] = {0.05 * (i % N - N / 2 + 0.5), 0.05 * (i / N % N - N / 2 + 0.5),
                                 0.05 * (i / N / N - N / 2 + 0.5)};
        cm_voxel of_a, of_b;
        cm_octree_at(a, point, 0, &of_a);
        cm_octree_at(b, point, 0, &of_b);
        ck_assert_msg(memcmp(&of_a, &of_b, sizeof of_a) == 0, "%d: levels %d and %d, alphas %d, %d",
                      i, of_a.level, of_b.level, of_a.alpha, of_b.alpha);
    }
}

/* The map as a store has it. */
static cm_octree *saved_and_loaded(cm_octree *octree)
{
    cm_store *store = NULL;
    cm_octree *back = NULL;
    ck_assert_int_eq(cm_store_create_in_memory(&store), CM_OK);
    ck_assert_int_eq(cm_octree_save(octree, store, NULL, 0), CM_OK);
    ck_assert_int_eq(cm_octree_load(store, NULL, &back), CM_OK);
    cm_store_destroy(store);
    return back;
}

START_TEST(sizes_do_not_depend_on_keeping)
{
    for (int kind = 0; kind < 3; kind++)
    {
        cm_octree *plain = map_of_former_wall(kind), *packed = map_of_former_wall(kind);
        ck_assert_int_eq(cm_octree_compact(packed), CM_OK);
        ck_assert(larger_voxels(plain) > 0);
        check_alike(plain, packed);
        cm_octree *other = map_of_former_wall(kind), *back = saved_and_loaded(other);
        check_alike(plain, back);
        cm_octree_destroy(plain);
        cm_octree_destroy(packed);
        cm_octree_destroy(other);
        cm_octree_destroy(back);
    }
}
END_TEST

/* A new wall, seen from farther away: in larger cells where the block is even, which it is. */
START_TEST(updates_do_not_depend_on_keeping)
{
    for (int kind = 0; kind < 3; kind++)
    {
        cm_octree *plain = map_of_former_wall(kind), *packed = map_of_former_wall(kind);
        ck_assert_int_eq(cm_octree_compact(packed), CM_OK);
        see_wall(plain, kind, -6.0, 5.4f);
        see_wall(packed, kind, -6.0, 5.4f);
        ck_assert_str_eq(maps_differ(plain, packed), "");
        check_alike(plain, packed);
        cm_octree_destroy(plain);
        cm_octree_destroy(packed);
    }
}
END_TEST

/* Two maps: of a wall in large cells, sure to be there, and of one that was there in small ones. */
static cm_octree *merged(int to_is_packed, int from_is_packed, const cm_pose *pose)
{
    const cm_octree_options options = footprint_options(0);
    cm_octree *to = make_map(&options), *from = map_of_former_wall(0);
    for (int i = 0; i < 3; i++)
    {
        see_wall(to, 0, -6.0, 5.4f);
    }
    ck_assert_int_eq(to_is_packed ? cm_octree_compact(to) : CM_OK, CM_OK);
    ck_assert_int_eq(from_is_packed ? cm_octree_compact(from) : CM_OK, CM_OK);
    ck_assert_int_eq(cm_octree_merge(to, from, pose), CM_OK);
    cm_octree_destroy(from);
    return to;
}

START_TEST(merging_does_not_depend_on_keeping)
{
    const cm_pose aside = {.rotation = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
                           .position = {0.1, 0.2, 0.4}};
    for (int i = 1; i < 8; i++)
    {
        const cm_pose *pose = i & 4 ? &aside : NULL;
        cm_octree *a = merged(0, 0, pose), *b = merged(i & 1, i >> 1 & 1, pose);
        check_alike(a, b);
        cm_octree_destroy(a);
        cm_octree_destroy(b);
    }
}
END_TEST

/* Blocks that are even, occupied ones of a hull, are no larger voxels when they come into a map of one size. */
START_TEST(one_size_stays_one_size)
{
    cm_octree_options options = footprint_options(0);
    options.footprint = 0.0;
    options.levels = 5; /* a small map has no leaf but the root of its region */
    cm_octree *hull = even_map(&options, 1), *to;
    options.levels = LEVELS;
    to = make_map(&options);
    see_wall(to, 0, -1.0, 1.5f);
    ck_assert_int_eq(cm_octree_merge(to, hull, NULL), CM_OK);
    ck_assert_uint_eq(larger_voxels(to), 0);
    cm_octree *packed = saved_and_loaded(to);
    check_alike(to, packed);
    cm_octree_destroy(hull);
    cm_octree_destroy(to);
    cm_octree_destroy(packed);
}
END_TEST

static int count_voxel(void *user, const cm_voxel *voxel)
{
    *(size_t *)user += (size_t)1 << 3 * voxel->level;
    return 0;
}

static size_t changed_after(const cm_octree *octree, uint64_t step)
{
    size_t count = 0;
    ck_assert_int_eq(cm_octree_walk_changes(octree, step, count_voxel, &count), CM_OK);
    return count;
}

/* A region whose blocks are all hit alike, so that it is even once they are packed, changed when they were hit. */
START_TEST(changes_outlast_compacting)
{
    cm_octree_options options = {.size = sizeof options, .levels = LEVELS, .edge = 0.05};
    const double origin[3] = {0.01, 0.01, 0.01};
    cm_octree *octree = even_map(&options, 0);
    float *point = malloc((size_t)3 * N * N * N * sizeof *point);
    ck_assert_ptr_nonnull(point);
    for (int i = 0; i < N * N * N; i++)
    {
        point[3 * i] = (float)(0.05 * (i % N - N / 2 + 0.5));
        point[3 * i + 1] = (float)(0.05 * (i / N % N - N / 2 + 0.5));
        point[3 * i + 2] = (float)(0.05 * (i / N / N - N / 2 + 0.5));
    }
    for (uint64_t step = 0; step < 2; step++)
    {
        ck_assert_uint_eq(cm_octree_step(octree), step);
        ck_assert_int_eq(cm_octree_update_points(octree, origin, (size_t)N * N * N, point, NULL),
                         CM_OK);
    }
    ck_assert_uint_eq(changed_after(octree, 1), (size_t)N * N * N);
    ck_assert_int_eq(cm_octree_compact(octree), CM_OK);
    ck_assert_uint_eq(changed_after(octree, 1), (size_t)N * N * N);
    ck_assert_uint_eq(changed_after(octree, 2), 0);
    free(point);
    cm_octree_destroy(octree);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        sizes_do_not_depend_on_keeping,     updates_do_not_depend_on_keeping,
        merging_does_not_depend_on_keeping, one_size_stays_one_size,
        changes_outlast_compacting,         NULL};
    return run_suite("octree footprint", tests);
}
