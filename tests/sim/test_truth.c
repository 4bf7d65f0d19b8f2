/* SPDX-License-Identifier: MIT
 *
 * The truth of frames: as the world itself says it, and flows there and back.
 */
#include <cubemap/sim.h>

#include "tests/suite.h"

#include <math.h>
#include <string.h>

enum
{
    WIDTH = 48,
    HEIGHT = 36,
    PIXELS = WIDTH * HEIGHT
};

typedef struct picture
{
    double position[3][PIXELS];
    float normal[3][PIXELS], depth[PIXELS], range[PIXELS];
    float next[3][PIXELS], before[3][PIXELS];
    uint32_t object[PIXELS], shape[PIXELS], triangle[PIXELS];
} picture;

static picture seen, again;

static cm_tof_truth truth_of(picture *to)
{
    const cm_tof_truth truth = {.size = sizeof truth,
                                .position = {to->position[0], to->position[1], to->position[2]},
                                .normal = {to->normal[0], to->normal[1], to->normal[2]},
                                .object = to->object,
                                .shape = to->shape,
                                .triangle = to->triangle,
                                .depth = to->depth,
                                .range = to->range,
                                .flow_next = {to->next[0], to->next[1], to->next[2]},
                                .flow_before = {to->before[0], to->before[1], to->before[2]}};
    return truth;
}

static cm_camera *make_camera(void)
{
    const cm_camera_options shape = {.size = sizeof shape,
                                     .width = WIDTH,
                                     .height = HEIGHT,
                                     .fx = 40.0,
                                     .fy = 40.0,
                                     .cx = 24.0,
                                     .cy = 18.0,
                                     .distortion = {-0.1, 0.02}};
    cm_camera *camera = NULL;
    ck_assert_int_eq(cm_camera_create(&shape, &camera), CM_OK);
    return camera;
}

/* Looks along x, moves and turns a little between two times. */
static cm_trajectory *make_path(void)
{
    const double stamp[2] = {0.0, 1.0};
    const double place[3] = {-1.5, 0.2, 1.3}, turn[4] = {0.5, -0.5, 0.5, -0.5};
    const double step[6] = {0.05, 0.02, 0.1, 0.01, -0.03, 0.02};
    cm_pose pose[2], motion;
    cm_trajectory *path = NULL;
    ck_assert_int_eq(cm_pose_from_quaternion(place, turn, &pose[0]), CM_OK);
    cm_pose_exp(step, &motion);
    cm_pose_compose(&pose[0], &motion, &pose[1]);
    ck_assert_int_eq(cm_trajectory_create(2, stamp, pose, &path, NULL), CM_OK);
    return path;
}

START_TEST(truth_is_what_the_world_says)
{
    cm_scene *world = NULL;
    cm_tof_scene *scene = NULL;
    cm_camera *camera = make_camera();
    cm_trajectory *path = make_path();
    cm_pose pose;
    cm_tof_truth truth = truth_of(&seen);
    ck_assert_int_eq(cm_scene_create_named("room", &world), CM_OK);
    ck_assert_int_eq(cm_tof_scene_create(world, &scene), CM_OK);
    ck_assert_int_eq(cm_tof_find_truth(scene, camera, path, 0.0, 1.0, 0.0, NULL, &truth), CM_OK);
    ck_assert_int_eq(cm_trajectory_at(path, 0, NULL, &pose), CM_OK);
    size_t edges = 0;
    for (size_t i = 0; i < PIXELS; i++)
    {
        const double column = (double)(i % WIDTH), row = (double)(i / WIDTH);
        double ray[3], distance, normal[3];
        uint32_t id;
        cm_camera_ray_array(camera, 1, &column, &row, &ray[0], &ray[1], &ray[2]);
        const double length = sqrt(ray[0] * ray[0] + ray[1] * ray[1] + ray[2] * ray[2]);
        const cm_hit_arrays hit = {.size = sizeof hit,
                                   .distance = &distance,
                                   .id = &id,
                                   .normal = {&normal[0], &normal[1], &normal[2]}};
        cm_rotate_back(&pose.rotation, ray, ray);
        cm_scene_cast_array(world, 1, &pose.position[0], &pose.position[1], &pose.position[2],
                            &ray[0], &ray[1], &ray[2], &hit);
        if (seen.object[i] != id) /* where two surfaces meet, to rounding */
        {
            edges++;
            ck_assert_double_eq_tol((double)seen.depth[i], distance, 1e-6 * distance);
            continue;
        }
        ck_assert_uint_eq(seen.shape[i], (uint32_t)cm_scene_at(world, id)->kind);
        ck_assert_double_eq_tol((double)seen.depth[i], distance, 1e-6 * distance);
        ck_assert_double_eq_tol((double)seen.range[i], distance * length, 1e-6 * distance);
        for (int k = 0; k < 3; k++)
        {
            ck_assert_double_eq_tol(seen.position[k][i], pose.position[k] + distance * ray[k],
                                    1e-12);
            ck_assert_double_eq_tol((double)seen.normal[k][i], normal[k], 1e-6);
        }
    }
    ck_assert_uint_lt(edges, PIXELS / 50);
    cm_trajectory_destroy(path);
    cm_camera_destroy(camera);
    cm_tof_scene_destroy(scene);
    cm_scene_destroy(world);
}
END_TEST

/* No axis, no depth along it: a cube map's is its range, as its images have it. */
START_TEST(depth_of_a_cube_map_is_its_range)
{
    cm_scene *world = NULL;
    cm_tof_scene *scene = NULL;
    cm_camera *camera = NULL;
    cm_mapping *mapping = NULL;
    cm_trajectory *path = make_path();
    cm_tof_truth truth = truth_of(&seen);
    ck_assert_int_eq(cm_mapping_create("coupled", NULL, &mapping), CM_OK);
    const cm_camera_options shape = {
        .size = sizeof shape, .width = 16, .height = 96, .mapping = mapping};
    ck_assert_int_eq(cm_camera_create(&shape, &camera), CM_OK);
    ck_assert_int_eq(cm_scene_create_named("room", &world), CM_OK);
    ck_assert_int_eq(cm_tof_scene_create(world, &scene), CM_OK);
    ck_assert_int_eq(cm_tof_find_truth(scene, camera, path, 0.0, 1.0, 0.0, NULL, &truth), CM_OK);
    for (size_t i = 0; i < 16 * 96; i++)
    {
        REQUIRE(seen.range[i] > 0.1f && seen.depth[i] == seen.range[i], "%zu: %g and %g", i,
                (double)seen.depth[i], (double)seen.range[i]);
    }
    cm_trajectory_destroy(path);
    cm_camera_destroy(camera);
    cm_mapping_destroy(mapping);
    cm_tof_scene_destroy(scene);
    cm_scene_destroy(world);
}
END_TEST

/* The place that a pixel sees is where the flow says at the other time; before is now: it does not flow. */
START_TEST(flow_leads_to_the_same_place)
{
    cm_scene *world = NULL;
    cm_tof_scene *scene = NULL;
    cm_camera *camera = make_camera();
    cm_trajectory *path = make_path();
    cm_pose then;
    cm_tof_truth truth = truth_of(&seen);
    ck_assert_int_eq(cm_scene_create_named("room", &world), CM_OK);
    ck_assert_int_eq(cm_tof_scene_create(world, &scene), CM_OK);
    ck_assert_int_eq(cm_tof_find_truth(scene, camera, path, 0.0, 1.0, 0.0, NULL, &truth), CM_OK);
    ck_assert_int_eq(cm_trajectory_at(path, 1, NULL, &then), CM_OK);
    size_t followed = 0;
    for (size_t i = 0; i < PIXELS; i++)
    {
        double place[3], column, row;
        const double at[3] = {seen.position[0][i], seen.position[1][i], seen.position[2][i]};
        cm_pose_apply(&then, at, place);
        cm_camera_project_array(camera, 1, &place[0], &place[1], &place[2], &column, &row);
        if (!isnan(column))
        {
            followed++;
            ck_assert_double_eq_tol((double)seen.next[0][i], column - (double)(i % WIDTH), 1e-4);
            ck_assert_double_eq_tol((double)seen.next[1][i], row - (double)(i / WIDTH), 1e-4);
        }
        ck_assert_double_eq_tol((double)seen.before[0][i], 0.0, 1e-4);
        ck_assert_double_eq_tol((double)seen.before[2][i], 0.0, 1e-5);
    }
    ck_assert_uint_gt(followed, PIXELS / 2);
    cm_trajectory_destroy(path);
    cm_camera_destroy(camera);
    cm_tof_scene_destroy(scene);
    cm_scene_destroy(world);
}
END_TEST

/* A box that moves by 10 cm along x in front of a camera that stands. */
START_TEST(bodies_carry_their_places_along)
{
    const double stamp[2] = {0.0, 1.0}, start[3] = {0, 0, 0}, end[3] = {0.1, 0, 0.2};
    const double still[4] = {0, 0, 0, 1};
    cm_pose key[2];
    cm_trajectory *motion = NULL;
    cm_scene *world = NULL;
    cm_tof_scene *scene = NULL;
    cm_camera *camera = make_camera();
    ck_assert_int_eq(cm_pose_from_quaternion(start, still, &key[0]), CM_OK);
    ck_assert_int_eq(cm_pose_from_quaternion(end, still, &key[1]), CM_OK);
    ck_assert_int_eq(cm_trajectory_create(2, stamp, key, &motion, NULL), CM_OK);
    const cm_primitive box = {.size = sizeof box,
                              .kind = CM_PRIMITIVE_BOX,
                              .first = {-0.3, -0.3, 1.0},
                              .second = {0.3, 0.3, 1.2},
                              .material = {{1, 1, 1}, 0.5},
                              .motion = motion};
    ck_assert_int_eq(cm_scene_create(&world), CM_OK);
    ck_assert_int_eq(cm_scene_add(world, &box, NULL), CM_OK);
    ck_assert_int_eq(cm_tof_scene_create(world, &scene), CM_OK);
    cm_tof_truth truth = truth_of(&seen);
    ck_assert_int_eq(cm_tof_find_truth(scene, camera, NULL, 0.0, 1.0, -5.0, NULL, &truth), CM_OK);
    const size_t middle = 18 * WIDTH + 24;
    ck_assert_uint_eq(seen.object[middle], 0);
    ck_assert_double_eq_tol((double)seen.range[middle], 1.0, 1e-6);
    ck_assert_double_eq_tol((double)seen.next[2][middle], hypot(0.1, 1.2) - 1.0, 1e-6);
    ck_assert_double_gt((double)seen.next[0][middle], 3.0);
    ck_assert_double_eq_tol((double)seen.before[2][middle], 0.0, 1e-6); /* it stood */
    ck_assert_uint_eq(seen.object[0], CM_SCENE_NOTHING);
    ck_assert(isnan(seen.range[0]) && isnan(seen.next[0][0]) && isnan(seen.normal[0][0]));
    const unsigned threads[] = {1, 2, 7};
    for (int t = 0; t < 3; t++)
    {
        cm_pool *pool = NULL;
        ck_assert_int_eq(cm_pool_create(threads[t], &pool), CM_OK);
        truth = truth_of(&again);
        ck_assert_int_eq(cm_tof_find_truth(scene, camera, NULL, 0.0, 1.0, -5.0, pool, &truth),
                         CM_OK);
        ck_assert_mem_eq(&seen, &again, sizeof seen);
        cm_pool_destroy(pool);
    }
    cm_camera_destroy(camera);
    cm_tof_scene_destroy(scene);
    cm_scene_destroy(world);
    cm_trajectory_destroy(motion);
}
END_TEST

/* Pixels beyond a fold of the lens have no ray; a mesh is asked of none such. */
START_TEST(pixels_without_rays_see_nothing)
{
    const double corner[12] = {-9, -9, 1.7, 9, -9, 1.7, 9, 9, 1.7, -9, 9, 1.7};
    const uint32_t index[6] = {0, 1, 2, 0, 2, 3};
    const cm_mesh_options shape = {.size = sizeof shape,
                                   .vertex_count = 4,
                                   .position = corner,
                                   .triangle_count = 2,
                                   .index = index,
                                   .material = {{1, 1, 1}, 1.0}};
    const cm_camera_options folded = {.size = sizeof folded,
                                      .width = WIDTH,
                                      .height = HEIGHT,
                                      .fx = 20.0,
                                      .fy = 20.0,
                                      .cx = 24.0,
                                      .cy = 18.0,
                                      .distortion = {-0.4}};
    cm_mesh *mesh = NULL;
    cm_scene *world = NULL;
    cm_tof_scene *scene = NULL;
    cm_camera *camera = NULL;
    ck_assert_int_eq(cm_mesh_create(&shape, &mesh), CM_OK);
    ck_assert_int_eq(cm_camera_create(&folded, &camera), CM_OK);
    const cm_primitive body = {.size = sizeof body,
                               .kind = CM_PRIMITIVE_MESH,
                               .mesh = mesh,
                               .pose = {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {0, 0, 0}},
                               .material = {{1, 1, 1}, 0.5}};
    ck_assert_int_eq(cm_scene_create(&world), CM_OK);
    ck_assert_int_eq(cm_scene_add(world, &body, NULL), CM_OK);
    ck_assert_int_eq(cm_tof_scene_create(world, &scene), CM_OK);
    cm_tof_truth truth = truth_of(&seen);
    ck_assert_int_eq(cm_tof_find_truth(scene, camera, NULL, 0, 0, 0, NULL, &truth), CM_OK);
    ck_assert_uint_eq(seen.object[0], CM_SCENE_NOTHING);
    ck_assert_uint_eq(seen.object[18 * WIDTH + 24], 0);
    ck_assert_double_eq_tol((double)seen.range[18 * WIDTH + 24], 1.7, 1e-6);
    cm_camera_destroy(camera);
    cm_tof_scene_destroy(scene);
    cm_scene_destroy(world);
    cm_mesh_destroy(mesh);
}
END_TEST

START_TEST(refusals)
{
    cm_scene *world = NULL;
    cm_tof_scene *scene = NULL;
    cm_camera *camera = make_camera();
    cm_tof_truth truth = {.size = sizeof truth};
    ck_assert_int_eq(cm_scene_create_named("room", &world), CM_OK);
    ck_assert_int_eq(cm_tof_scene_create(world, &scene), CM_OK);
    ck_assert_int_eq(cm_tof_find_truth(scene, camera, NULL, 0, 0, 0, NULL, &truth), CM_OK);
    ck_assert_int_eq(cm_tof_find_truth(NULL, camera, NULL, 0, 0, 0, NULL, &truth),
                     CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_tof_find_truth(scene, NULL, NULL, 0, 0, 0, NULL, &truth),
                     CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_tof_find_truth(scene, camera, NULL, 0, 0, 0, NULL, NULL),
                     CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_tof_find_truth(scene, camera, NULL, NAN, 0, 0, NULL, &truth),
                     CM_ERROR_RANGE);
    truth.size = 1;
    ck_assert_int_eq(cm_tof_find_truth(scene, camera, NULL, 0, 0, 0, NULL, &truth),
                     CM_ERROR_ARGUMENT);
    cm_camera_destroy(camera);
    cm_tof_scene_destroy(scene);
    cm_scene_destroy(world);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {truth_is_what_the_world_says,
                                  depth_of_a_cube_map_is_its_range,
                                  flow_leads_to_the_same_place,
                                  bodies_carry_their_places_along,
                                  pixels_without_rays_see_nothing,
                                  refusals,
                                  NULL};
    return run_suite("truth", tests);
}
