/* SPDX-License-Identifier: MIT
 *
 * Ground truth of time-of-flight cameras: places against the formulas of planes and spheres, flows against those of pinholes.
 */
#include <cubemap/sim.h>

#include "tests/suite.h"

#include <math.h>
#include <string.h>

enum
{
    WIDTH = 64,
    HEIGHT = 48,
    PIXELS = WIDTH * HEIGHT
};

#define FOCAL 50.0
#define MIDDLE_COLUMN 31.5
#define MIDDLE_ROW 23.5

static const cm_pose still = {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {0, 0, 0}};

/* All that can be asked, of one frame. */
typedef struct answer
{
    double position[3][PIXELS];
    float normal[3][PIXELS], depth[PIXELS], range[PIXELS], next[3][PIXELS], before[3][PIXELS];
    uint32_t object[PIXELS], shape[PIXELS], triangle[PIXELS];
} answer;

static cm_tof_truth all_of(answer *to)
{
    cm_tof_truth truth = {.size = sizeof truth,
                          .object = to->object,
                          .shape = to->shape,
                          .triangle = to->triangle,
                          .depth = to->depth,
                          .range = to->range};
    memset(to, 0xa5, sizeof *to);
    for (int k = 0; k < 3; k++)
    {
        truth.position[k] = to->position[k];
        truth.normal[k] = to->normal[k];
        truth.flow_next[k] = to->next[k];
        truth.flow_before[k] = to->before[k];
    }
    return truth;
}

static cm_camera *make_camera(void)
{
    const cm_camera_options shape = {.size = sizeof shape,
                                     .width = WIDTH,
                                     .height = HEIGHT,
                                     .fx = FOCAL,
                                     .fy = FOCAL,
                                     .cx = MIDDLE_COLUMN,
                                     .cy = MIDDLE_ROW};
    cm_camera *camera = NULL;
    ck_assert_int_eq(cm_camera_create(&shape, &camera), CM_OK);
    return camera;
}

static cm_trajectory *make_motion(const cm_pose *first, const cm_pose *last)
{
    const double stamp[2] = {0.0, 1.0};
    const cm_pose pose[2] = {*first, *last};
    cm_trajectory *made = NULL;
    ck_assert_int_eq(cm_trajectory_create(2, stamp, pose, &made, NULL), CM_OK);
    return made;
}

static cm_pose moved(double x, double y, double z, double turn)
{
    cm_pose pose;
    const double twist[6] = {0, 0, 0, 0, 0, turn};
    cm_pose_exp(twist, &pose);
    pose.position[0] = x;
    pose.position[1] = y;
    pose.position[2] = z;
    return pose;
}

/* What one primitive looks like at 0.25, with flow to 1 and to 0. */
static void find(const cm_primitive *primitive, size_t count, const cm_trajectory *trajectory,
                 cm_pool *pool, answer *to)
{
    cm_scene *world = NULL;
    cm_tof_scene *scene = NULL;
    cm_camera *camera = make_camera();
    cm_tof_truth truth = all_of(to);
    ck_assert_int_eq(cm_scene_create(&world), CM_OK);
    for (size_t i = 0; i < count; i++)
    {
        ck_assert_int_eq(cm_scene_add(world, &primitive[i], NULL), CM_OK);
    }
    ck_assert_int_eq(cm_tof_scene_create(world, &scene), CM_OK);
    ck_assert_int_eq(cm_tof_find_truth(scene, camera, trajectory, 0.25, 1.0, 0.0, pool, &truth),
                     CM_OK);
    cm_tof_scene_destroy(scene);
    cm_scene_destroy(world);
    cm_camera_destroy(camera);
}

static cm_primitive wall_at(double depth)
{
    const cm_primitive wall = {.size = sizeof wall,
                               .kind = CM_PRIMITIVE_PLANE,
                               .first = {0, 0, depth},
                               .second = {0, 0, -1},
                               .material = {{1, 1, 1}, 0.5},
                               .pose = still};
    return wall;
}

static cm_primitive ball_at(double depth, double radius)
{
    const cm_primitive ball = {.size = sizeof ball,
                               .kind = CM_PRIMITIVE_SPHERE,
                               .first = {0, 0, depth},
                               .radius = radius,
                               .material = {{1, 1, 1}, 0.5},
                               .pose = still};
    return ball;
}

START_TEST(a_wall_is_where_its_formula_says)
{
    static answer found;
    const cm_primitive wall = wall_at(2.0);
    find(&wall, 1, NULL, NULL, &found);
    for (int i = 0; i < PIXELS; i++)
    {
        const double x = (i % WIDTH - MIDDLE_COLUMN) / FOCAL, y = (i / WIDTH - MIDDLE_ROW) / FOCAL;
        ck_assert_double_eq_tol(found.position[0][i], 2.0 * x, 1e-14);
        ck_assert_double_eq_tol(found.position[1][i], 2.0 * y, 1e-14);
        ck_assert_double_eq_tol(found.position[2][i], 2.0, 1e-14);
        ck_assert_double_eq_tol((double)found.depth[i], 2.0, 1e-6);
        ck_assert_double_eq_tol((double)found.range[i], (2.0 * sqrt(1.0 + x * x + y * y)), 1e-6);
        ck_assert_float_eq(found.normal[2][i], -1.0f);
        ck_assert_uint_eq(found.object[i], 0);
        ck_assert_uint_eq(found.shape[i], CM_PRIMITIVE_PLANE);
        for (int k = 0; k < 3; k++)
        {
            ck_assert_double_eq_tol((double)found.next[k][i], 0.0, 1e-12);
            ck_assert_double_eq_tol((double)found.before[k][i], 0.0, 1e-12);
        }
    }
}
END_TEST

START_TEST(beside_a_ball_is_nothing)
{
    static answer found;
    const cm_primitive ball = ball_at(3.0, 0.97); /* no pixel on its rim */
    int count = 0;
    find(&ball, 1, NULL, NULL, &found);
    for (int i = 0; i < PIXELS; i++)
    {
        const double x = (i % WIDTH - MIDDLE_COLUMN) / FOCAL, y = (i / WIDTH - MIDDLE_ROW) / FOCAL;
        const double square = 1.0 + x * x + y * y;
        const double beneath =
            9.0 / square - 9.0 + 0.97 * 0.97; /* (c.d)^2 - (c.c - r^2), d of length 1 */
        if (beneath < 0.0)
        {
            ck_assert(isnan(found.range[i]) && isnan(found.depth[i]) && isnan(found.normal[1][i]));
            ck_assert(isnan(found.position[2][i]) && isnan(found.next[0][i]));
            ck_assert(isnan(found.before[2][i]));
            ck_assert_uint_eq(found.object[i], CM_SCENE_NOTHING);
            ck_assert_uint_eq(found.shape[i], CM_SCENE_NOTHING);
            ck_assert_uint_eq(found.triangle[i], CM_SCENE_NOTHING);
            continue;
        }
        const double range = 3.0 / sqrt(square) - sqrt(beneath);
        ck_assert_double_eq_tol((double)found.range[i], range, 1e-6);
        ck_assert_double_eq_tol((double)found.normal[0][i], (x * range / sqrt(square) / 0.97),
                                1e-6);
        ck_assert_uint_eq(found.shape[i], CM_PRIMITIVE_SPHERE);
        count++;
    }
    ck_assert_int_gt(count, 100);
    ck_assert_int_lt(count, PIXELS);
}
END_TEST

START_TEST(a_camera_that_moves_sees_the_wall_flow)
{
    static answer found;
    const cm_primitive wall = wall_at(2.0);
    const cm_pose last = moved(0.4, -0.2, 0.5, 0.0);
    cm_trajectory *motion = make_motion(&still, &last);
    find(&wall, 1, motion, NULL, &found);
    for (int i = 0; i < PIXELS; i++)
    {
        /* at 0.25 the wall is 1.875 away, at 1 1.5 and 0.3, -0.15 further */
        const double x = (i % WIDTH - MIDDLE_COLUMN) / FOCAL, y = (i / WIDTH - MIDDLE_ROW) / FOCAL;
        const double to_x = 1.875 * x - 0.3, to_y = 1.875 * y + 0.15;
        const double column = FOCAL * to_x / 1.5 + MIDDLE_COLUMN;
        const double row = FOCAL * to_y / 1.5 + MIDDLE_ROW;
        const int is_seen =
            column > -0.4 && column < WIDTH - 0.6 && row > -0.4 && row < HEIGHT - 0.6;
        ck_assert_double_eq_tol((double)found.depth[i], 1.875f, 1e-6);
        if (is_seen)
        {
            ck_assert_double_eq_tol((double)found.next[0][i], (column - i % WIDTH), 1e-5);
            ck_assert_double_eq_tol((double)found.next[1][i], (row - i / WIDTH), 1e-5);
        }
        ck_assert_double_eq_tol(
            (double)found.next[2][i],
            (sqrt(to_x * to_x + to_y * to_y + 2.25) - 1.875 * sqrt(1.0 + x * x + y * y)), 1e-6);
    }
    cm_trajectory_destroy(motion);
}
END_TEST

START_TEST(a_body_that_turns_carries_its_points)
{
    static answer found;
    const cm_primitive body[2] = {ball_at(3.0, 1.0), wall_at(5.0)};
    /* around the optical axis: all stays where it is, its points do not */
    const cm_pose last = moved(0.0, 0.0, 0.0, 0.4);
    cm_trajectory *motion = make_motion(&still, &last);
    cm_primitive turning[2] = {body[0], body[1]};
    turning[0].motion = motion;
    find(turning, 2, NULL, NULL, &found);
    for (int i = 0; i < PIXELS; i++)
    {
        const double x = i % WIDTH - MIDDLE_COLUMN, y = i / WIDTH - MIDDLE_ROW;
        const double turn = found.object[i] == 0 ? 0.3 : 0.0,
                     back = found.object[i] == 0 ? -0.1 : 0;
        if (x * x + y * y > 23.0 * 23.0) /* may leave the picture */
        {
            continue;
        }
        ck_assert_double_eq_tol((double)found.next[0][i], (x * cos(turn) - y * sin(turn) - x),
                                1e-5);
        ck_assert_double_eq_tol((double)found.next[1][i], (x * sin(turn) + y * cos(turn) - y),
                                1e-5);
        ck_assert_double_eq_tol((double)found.next[2][i], 0.0, 1e-6);
        ck_assert_double_eq_tol((double)found.before[0][i], (x * cos(back) - y * sin(back) - x),
                                1e-5);
        ck_assert_double_eq_tol((double)found.before[1][i], (x * sin(back) + y * cos(back) - y),
                                1e-5);
    }
    ck_assert_uint_eq(found.object[HEIGHT / 2 * WIDTH + WIDTH / 2], 0);
    ck_assert_uint_eq(found.object[0], 1);
    cm_trajectory_destroy(motion);
}
END_TEST

START_TEST(threads_change_no_bit)
{
    static answer alone, together;
    const cm_primitive body[2] = {ball_at(3.0, 1.0), wall_at(5.0)};
    const cm_pose last = moved(0.1, 0.0, 0.2, 0.1);
    cm_trajectory *motion = make_motion(&still, &last);
    cm_pool *pool = NULL;
    ck_assert_int_eq(cm_pool_create(7, &pool), CM_OK);
    find(body, 2, motion, NULL, &alone);
    find(body, 2, motion, pool, &together);
    ck_assert_mem_eq(&alone, &together, sizeof alone);
    cm_pool_destroy(pool);
    cm_trajectory_destroy(motion);
}
END_TEST

START_TEST(what_is_not_asked_for_is_left_out)
{
    static float range[PIXELS];
    const cm_primitive wall = wall_at(2.0);
    cm_scene *world = NULL;
    cm_tof_scene *scene = NULL;
    cm_camera *camera = make_camera();
    cm_tof_truth truth = {.size = sizeof truth, .range = range};
    ck_assert_int_eq(cm_scene_create(&world), CM_OK);
    ck_assert_int_eq(cm_scene_add(world, &wall, NULL), CM_OK);
    ck_assert_int_eq(cm_tof_scene_create(world, &scene), CM_OK);
    ck_assert_int_eq(cm_tof_find_truth(scene, camera, NULL, 0, 0, 0, NULL, &truth), CM_OK);
    ck_assert_double_eq_tol((double)range[HEIGHT / 2 * WIDTH + WIDTH / 2], 2.0, 1e-3);
    ck_assert_int_eq(cm_tof_find_truth(NULL, camera, NULL, 0, 0, 0, NULL, &truth),
                     CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_tof_find_truth(scene, NULL, NULL, 0, 0, 0, NULL, &truth),
                     CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_tof_find_truth(scene, camera, NULL, 0, 0, 0, NULL, NULL),
                     CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_tof_find_truth(scene, camera, NULL, NAN, 0, 0, NULL, &truth),
                     CM_ERROR_RANGE);
    ck_assert_int_eq(cm_tof_find_truth(scene, camera, NULL, 0, INFINITY, 0, NULL, &truth),
                     CM_ERROR_RANGE);
    ck_assert_int_eq(cm_tof_find_truth(scene, camera, NULL, 0, 0, NAN, NULL, &truth),
                     CM_ERROR_RANGE);
    truth.size = 8;
    ck_assert_int_eq(cm_tof_find_truth(scene, camera, NULL, 0, 0, 0, NULL, &truth),
                     CM_ERROR_ARGUMENT);
    cm_tof_scene_destroy(scene);
    cm_scene_destroy(world);
    cm_camera_destroy(camera);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {a_wall_is_where_its_formula_says,
                                  beside_a_ball_is_nothing,
                                  a_camera_that_moves_sees_the_wall_flow,
                                  a_body_that_turns_carries_its_points,
                                  threads_change_no_bit,
                                  what_is_not_asked_for_is_left_out,
                                  NULL};
    return run_suite("tof truth", tests);
}
