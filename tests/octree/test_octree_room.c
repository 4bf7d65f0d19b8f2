/* SPDX-License-Identifier: MIT
 *
 * Maps of the analytic room, whose truth is known: how right they are, what is moved is gone, and maps merge exactly. The plain
 * run has 20 views, the long one the 60 of the promise, both voxels of 1 cm.
 */
#include "tests/suite.h"
#include "truth/room_views.h"

#include <cubemap/octree.h>

static const double least[3] = {-3.0, -2.5, 0.0};
static const double greatest[3] = {3.0, 2.5, 3.0};

typedef struct room_work
{
    cm_scene *scene;
    cm_camera *camera;
    room_picture picture;
    size_t views;
    double edge;
} room_work;

/* By that camera, whose pixels and voxels of that edge are in proportion. */
static room_work begin_work_by(const cm_camera_options *options, double edge, size_t views)
{
    room_work work = {.views = views, .edge = edge};
    ck_assert_int_eq(cm_scene_create_named("room", &work.scene), CM_OK);
    ck_assert_int_eq(cm_camera_create(options, &work.camera), CM_OK);
    ck_assert_int_eq(room_picture_make(work.camera, &work.picture), 1);
    return work;
}

static cm_camera_options camera_options(unsigned times)
{
    return (cm_camera_options){.size = sizeof(cm_camera_options),
                               .width = 640 / times,
                               .height = 480 / times,
                               .fx = 525.0 / times,
                               .fy = 525.0 / times,
                               .cx = 320.0 / times - 0.5,
                               .cy = 240.0 / times - 0.5};
}

static room_work begin_work(void)
{
    const unsigned times = is_quick() ? 2 : 1;
    const cm_camera_options options = camera_options(times);
    return begin_work_by(&options, 0.01 * times, is_long() ? 60 : is_quick() ? 6 : 10);
}

static void end_work(room_work *work)
{
    room_picture_free(&work->picture);
    cm_camera_destroy(work->camera);
    cm_scene_destroy(work->scene);
}

/* Walls do not lie on borders of voxels if the centre is moved by a part of an edge. */
static cm_octree *empty_map(double edge, double aside, int no_return_is_free)
{
    cm_octree_options options = {.size = sizeof options,
                                 .edge = edge,
                                 .centre = {aside * edge, aside * edge, aside * edge},
                                 .levels = 11,
                                 .color = 1,
                                 .far = no_return_is_free ? 6.0 : 0.0,
                                 .no_return_is_free = no_return_is_free};
    cm_octree *map = NULL;
    ck_assert_int_eq(cm_octree_create(&options, &map), CM_OK);
    return map;
}

/* The view of that index, seen so many times: the camera takes one picture. */
static void add_views(cm_octree *map, room_work *work, const cm_scene *scene, size_t index,
                      int times)
{
    const cm_pose pose = room_pose(index, work->views);
    room_picture_take(scene, work->camera, &pose, 0.0, (uint32_t)index, &work->picture);
    const cm_view view = room_picture_view(&work->picture, work->camera, &pose, 1);
    for (int i = 0; i < times; i++)
    {
        ck_assert_int_eq(cm_octree_update(map, &view, NULL), CM_OK);
    }
}

static void add_view(cm_octree *map, room_work *work, const cm_scene *scene, size_t index)
{
    add_views(map, work, scene, index, 1);
}

static int state_at(const void *map, const double point[3])
{
    return cm_octree_at(map, point, 0, NULL);
}

static cm_voxel *voxels_of(const cm_octree *map, size_t *count)
{
    *count = 0;
    const cm_status status = cm_octree_extract(map, 0, 0, NULL, count);
    ck_assert(status == CM_ERROR_SPACE || *count == 0);
    cm_voxel *voxel = malloc((*count + 1) * sizeof *voxel);
    ck_assert_ptr_nonnull(voxel);
    ck_assert_int_eq(cm_octree_extract(map, 0, *count, voxel, count), CM_OK);
    return voxel;
}

static double share(uint64_t part, uint64_t whole)
{
    return 100.0 * (double)part / (double)whole;
}

/* What is wrong with a map of all views. */
static room_errors errors_of(room_work *work, double aside)
{
    cm_octree *map = empty_map(work->edge, aside, 0);
    room_truth truth;
    ck_assert_int_eq(room_truth_make(work->scene, work->edge, cm_octree_describe(map)->centre,
                                     least, greatest, &truth),
                     1);
    for (size_t i = 0; i < work->views; i++)
    {
        add_view(map, work, work->scene, i);
        room_truth_see(&truth, &work->picture);
    }
    room_errors errors = {0};
    size_t count;
    cm_voxel *voxel = voxels_of(map, &count);
    for (size_t i = 0; i < count; i++)
    {
        room_truth_judge_occupied(&truth, (const double[3]){voxel[i].x, voxel[i].y, voxel[i].z},
                                  &errors);
    }
    free(voxel);
    room_truth_judge(&truth, map, state_at, &errors);
    room_truth_free(&truth);
    cm_octree_destroy(map);
    return errors;
}

/* What is to hold of maps by any camera; off: the most occupied voxels that may be far from surfaces, percent. */
static void check_errors(const room_errors *errors, double off)
{
    ck_assert_uint_gt(errors->visible, is_quick() ? 50000u : 100000u);
    ck_assert_uint_gt(errors->crossed, 10000);
    ck_assert_msg(share(errors->off, errors->occupied) <= off, "%g %% of occupied voxels are off",
                  share(errors->off, errors->occupied));
    ck_assert_msg(share(errors->visible_occupied, errors->visible) >= (is_quick() ? 98.0 : 99.0),
                  "%g %% of what is visible is occupied",
                  share(errors->visible_occupied, errors->visible));
    ck_assert_msg(share(errors->visible_free, errors->visible) <= 0.15,
                  "%g %% of what is visible is free", share(errors->visible_free, errors->visible));
}

static void check_accuracy(double aside)
{
    room_work work = begin_work();
    const room_errors errors = errors_of(&work, aside);
    end_work(&work);
    check_errors(&errors, 0.1);
    /* of walls on borders the crossed voxels are few: those of furniture, which are judged with the others */
    ck_assert_msg(aside == 0.0 || share(errors.crossed_free, errors.crossed) <= 0.15,
                  "%g %% of what surfaces cross is free",
                  share(errors.crossed_free, errors.crossed));
}

START_TEST(walls_inside_of_voxels)
{
    check_accuracy(0.37);
}
END_TEST

START_TEST(walls_on_borders_of_voxels)
{
    check_accuracy(0.0);
}
END_TEST

/* Silhouettes and creases, where slopes between pixels are of no surface, are no thicker than by a straight camera. */
START_TEST(walls_by_a_lens)
{
    const unsigned times = is_quick() ? 2 : 1;
    cm_camera_options options = camera_options(times);
    options.distortion[0] = -0.1;
    options.distortion[1] = 0.03;
    room_work work = begin_work_by(&options, 0.01 * times, is_quick() ? 4 : 5);
    const room_errors errors = errors_of(&work, 0.37);
    end_work(&work);
    check_errors(&errors, 0.1);
}
END_TEST

/* More of what is seen all around is seen at grazing angles, where hits reach farthest. */
START_TEST(walls_all_around)
{
    const uint32_t edge = is_quick() ? 160 : 320;
    cm_mapping *mapping = NULL;
    ck_assert_int_eq(cm_mapping_create("coupled", NULL, &mapping), CM_OK);
    const cm_camera_options options = {.size = sizeof options,
                                       .width = edge,
                                       .height = 6 * edge,
                                       .pixel_centre = 0.5,
                                       .mapping = mapping};
    room_work work = begin_work_by(&options, is_quick() ? 0.04 : 0.02, 2);
    const room_errors errors = errors_of(&work, 0.37);
    end_work(&work);
    cm_mapping_destroy(mapping);
    check_errors(&errors, 0.2);
}
END_TEST

/* Rims of round bodies, whose voxels are met in a corner by the ray of a pixel that is many from that of their centre. */
START_TEST(grazing_views_of_voxels_of_many_pixels)
{
    room_work work = begin_work();
    work.edge *= 2.0;
    const room_errors errors = errors_of(&work, 0.37);
    end_work(&work);
    ck_assert_uint_gt(errors.grazing, 100);
    ck_assert_msg(share(errors.grazing_occupied, errors.grazing) >= 99.0,
                  "%g %% of what is seen at grazing angles alone is occupied",
                  share(errors.grazing_occupied, errors.grazing));
}
END_TEST

/* The judge finds no fault with what is right everywhere, and finds what is wrong. */
static int always_occupied(const void *map, const double point[3])
{
    (void)map;
    (void)point;
    return 2;
}

static int always_free(const void *map, const double point[3])
{
    (void)map;
    (void)point;
    return 1;
}

START_TEST(the_judge_judges)
{
    room_work work = begin_work();
    const double centre[3] = {0.0037, 0.0037, 0.0037};
    room_truth truth;
    ck_assert_int_eq(room_truth_make(work.scene, 0.05, centre, least, greatest, &truth), 1);
    const cm_pose pose = room_pose(0, 1);
    room_picture_take(work.scene, work.camera, &pose, 0.0, 0, &work.picture);
    room_truth_see(&truth, &work.picture);
    room_errors right = {0}, wrong = {0};
    room_truth_judge(&truth, NULL, always_occupied, &right);
    room_truth_judge(&truth, NULL, always_free, &wrong);
    ck_assert_uint_eq(right.visible_occupied, right.visible);
    ck_assert_uint_eq(right.crossed_free, 0);
    ck_assert_uint_eq(wrong.visible_free, wrong.visible);
    ck_assert_uint_eq(wrong.crossed_free, wrong.crossed);
    ck_assert_uint_gt(right.crossed, right.visible);
    /* walls of 6 x 5 x 3 m have 126 square metres, furniture some 14: each square of 5 cm is crossed once or little more */
    ck_assert_uint_gt(right.crossed, 126 * 400);
    ck_assert_uint_lt(right.crossed, 210 * 400);
    ck_assert_double_eq_tol(room_truth_distance(&truth, (const double[3]){0.0, 0.0, 1.0}), 1.0,
                            1e-12);
    ck_assert_double_eq_tol(room_truth_distance(&truth, (const double[3]){2.9, 0.0, 1.0}), 0.1,
                            1e-12);
    ck_assert_double_eq_tol(room_truth_distance(&truth, (const double[3]){1.9, 0.1, 0.95}), 0.2,
                            1e-12);
    ck_assert_double_eq_tol(room_truth_distance(&truth, (const double[3]){2.3, 1.9, 1.0}), 0.2,
                            1e-12);
    ck_assert_double_eq_tol(room_truth_distance(&truth, (const double[3]){1.8, 0.0, 0.71}), 0.01,
                            1e-12);
    room_truth_free(&truth);
    end_work(&work);
}
END_TEST

/* ---- what was moved */

static const double box[2][3] = {{2.0, -0.2, 1.0}, {2.3, 0.2, 1.6}};

static void add_wall(cm_scene *scene, const double point[3], const double normal[3])
{
    cm_primitive wall = {
        .size = sizeof wall, .kind = CM_PRIMITIVE_PLANE, .material = {{0.5, 0.5, 0.5}, 1.0}};
    memcpy(wall.first, point, sizeof wall.first);
    memcpy(wall.second, normal, sizeof wall.second);
    ck_assert_int_eq(cm_scene_add(scene, &wall, NULL), CM_OK);
}

/* A box before a wall, or without both. */
static cm_scene *scene_with(int has_box, int has_wall)
{
    cm_scene *scene = NULL;
    ck_assert_int_eq(cm_scene_create(&scene), CM_OK);
    if (has_wall)
    {
        add_wall(scene, (const double[3]){3.0, 0.0, 0.0}, (const double[3]){-1.0, 0.0, 0.0});
    }
    if (has_box)
    {
        cm_primitive made = {
            .size = sizeof made, .kind = CM_PRIMITIVE_BOX, .material = {{1.0, 0.0, 0.0}, 1.0}};
        memcpy(made.first, box[0], sizeof made.first);
        memcpy(made.second, box[1], sizeof made.second);
        ck_assert_int_eq(cm_scene_add(scene, &made, NULL), CM_OK);
    }
    return scene;
}

/* How many voxels around the box are occupied. */
static int count_voxel(void *user, const cm_voxel *voxel)
{
    *(size_t *)user += voxel->state == CM_VOXEL_OCCUPIED ? 1 : 0;
    return 0;
}

static size_t occupied_at_box(const cm_octree *map)
{
    const double from[3] = {box[0][0] - 0.1, box[0][1] - 0.1, box[0][2] - 0.1};
    const double to[3] = {box[1][0] + 0.1, box[1][1] + 0.1, box[1][2] + 0.1};
    size_t count = 0;
    ck_assert_int_eq(cm_octree_walk_box(map, from, to, count_voxel, &count), CM_OK);
    return count;
}

static void check_moved_box(int has_wall)
{
    room_work work = begin_work();
    cm_scene *with = scene_with(1, has_wall);
    cm_scene *without = scene_with(0, has_wall);
    cm_octree *map = empty_map(0.02, 0.37, !has_wall);
    work.views = 1; /* from 0.7, 0, 1.3, ahead */
    add_views(map, &work, with, 0, 100);
    ck_assert_uint_gt(occupied_at_box(map), 200);
    add_views(map, &work, without, 0, 63);
    ck_assert_uint_gt(occupied_at_box(map), 200);
    add_view(map, &work, without, 0);
    ck_assert_uint_eq(occupied_at_box(map), 0);
    cm_octree_destroy(map);
    cm_scene_destroy(with);
    cm_scene_destroy(without);
    end_work(&work);
}

START_TEST(a_box_that_is_gone_before_a_wall)
{
    check_moved_box(1);
}
END_TEST

START_TEST(a_box_that_is_gone_before_nothing)
{
    check_moved_box(0);
}
END_TEST

/* ---- merging */

static void same_maps(const cm_octree *one, const cm_octree *other)
{
    size_t counts[2];
    cm_voxel *voxels[2] = {voxels_of(one, &counts[0]), voxels_of(other, &counts[1])};
    ck_assert_uint_eq(counts[0], counts[1]);
    for (size_t i = 0; i < counts[0]; i++)
    {
        const cm_voxel *a = &voxels[0][i];
        const cm_voxel *b = &voxels[1][i];
        ck_assert(a->x == b->x && a->y == b->y && a->z == b->z && a->alpha == b->alpha);
    }
    cm_octree_count told[2] = {{.size = sizeof told[0]}, {.size = sizeof told[0]}};
    ck_assert_int_eq(cm_octree_count_voxels(one, &told[0]), CM_OK);
    ck_assert_int_eq(cm_octree_count_voxels(other, &told[1]), CM_OK);
    ck_assert_uint_eq(told[0].free, told[1].free);
    ck_assert_uint_eq(told[0].occupied, told[1].occupied);
    free(voxels[0]);
    free(voxels[1]);
}

static void add_view_to_both(cm_octree *one, cm_octree *other, room_work *work, size_t index)
{
    add_view(one, work, work->scene, index);
    const cm_pose pose = room_pose(index, work->views);
    const cm_view view = room_picture_view(&work->picture, work->camera, &pose, 1);
    ck_assert_int_eq(cm_octree_update(other, &view, NULL), CM_OK);
}

START_TEST(merged_maps_are_the_map_of_all_views)
{
    room_work work = begin_work();
    cm_octree *map[4];
    for (int i = 0; i < 4; i++)
    {
        map[i] = empty_map(0.04, 0.37, 0);
    }
    for (size_t i = 0; i < 20; i++)
    {
        add_view_to_both(map[0], map[1 + i % 2], &work, i);
        add_view(map[3], &work, work.scene, 19 - i);
    }
    same_maps(map[0], map[3]);
    cm_octree_destroy(map[3]);
    map[3] = empty_map(0.04, 0.37, 0);
    ck_assert_int_eq(cm_octree_merge(map[3], map[2], NULL), CM_OK);
    ck_assert_int_eq(cm_octree_merge(map[3], map[1], NULL), CM_OK);
    same_maps(map[0], map[3]);
    ck_assert_int_eq(cm_octree_merge(map[1], map[2], NULL), CM_OK);
    same_maps(map[0], map[1]);
    for (int i = 0; i < 4; i++)
    {
        cm_octree_destroy(map[i]);
    }
    end_work(&work);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {walls_inside_of_voxels,
                                  walls_on_borders_of_voxels,
                                  walls_by_a_lens,
                                  walls_all_around,
                                  grazing_views_of_voxels_of_many_pixels,
                                  the_judge_judges,
                                  a_box_that_is_gone_before_a_wall,
                                  a_box_that_is_gone_before_nothing,
                                  merged_maps_are_the_map_of_all_views,
                                  NULL};
    return run_suite("octree room", tests);
}
