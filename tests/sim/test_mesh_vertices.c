/* SPDX-License-Identifier: MIT
 *
 * Rays that go exactly to a vertex of a mesh see it, and nothing of the mesh behind it; meshes of any size and shape are met.
 */
#include "tof_stage.h"

#include <cubemap/random.h>

#include <stdlib.h>

enum
{
    VERTICES = PIXELS + 4,
    SOUP = 2000,
    TRIANGLES = 2 * (WIDTH - 1) * (HEIGHT - 1) + 2
};

static const cm_pose at_origin = {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {0, 0, 0}};

typedef struct hill
{
    double position[3 * VERTICES]; /* one in the ray of each pixel, and four far behind */
    double from[PIXELS];           /* depths of them */
    uint32_t index[3 * TRIANGLES];
} hill;

static void add_triangle(hill *to, size_t triangle, size_t a, size_t b, size_t c)
{
    to->index[3 * triangle] = (uint32_t)a;
    to->index[3 * triangle + 1] = (uint32_t)b;
    to->index[3 * triangle + 2] = (uint32_t)c;
}

static void join(hill *to)
{
    size_t triangle = 0;
    for (size_t row = 0; row + 1 < HEIGHT; row++)
    {
        for (size_t column = 0; column + 1 < WIDTH; column++)
        {
            const size_t first = row * WIDTH + column;
            add_triangle(to, triangle++, first, first + 1, first + 1 + WIDTH);
            add_triangle(to, triangle++, first, first + 1 + WIDTH, first + WIDTH);
        }
    }
    add_triangle(to, triangle++, PIXELS, PIXELS + 1, PIXELS + 2);
    add_triangle(to, triangle, PIXELS, PIXELS + 2, PIXELS + 3);
}

/* A camera that stands anywhere, and a rough surface whose vertices its pixels look at, before a wall of the same mesh. */
static void make_hill(uint32_t number, double distance_away, const cm_camera *camera, hill *to,
                      cm_pose *pose)
{
    static double column[PIXELS], row[PIXELS], ray[3][PIXELS];
    const double angle = 0.3 + number, far = 9.0;
    memset(pose, 0, sizeof *pose);
    pose->rotation.row[0][0] = pose->rotation.row[1][1] = cos(angle);
    pose->rotation.row[0][1] = sin(angle);
    pose->rotation.row[1][0] = -sin(angle);
    pose->rotation.row[2][2] = 1.0;
    for (int k = 0; k < 3; k++)
    {
        pose->position[k] = distance_away * cm_random_uniform(1, number, (uint32_t)k, 0);
    }
    for (size_t i = 0; i < PIXELS; i++)
    {
        column[i] = (double)(i % WIDTH);
        row[i] = (double)(i / WIDTH);
    }
    cm_camera_ray_array(camera, PIXELS, column, row, ray[0], ray[1], ray[2]);
    for (size_t i = 0; i < VERTICES; i++)
    {
        static const double sign[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
        double at[3];
        for (int k = 0; k < 3 && i < PIXELS; k++)
        {
            to->from[i] = 1.0 + 0.3 * cm_random_uniform(2, number, (uint32_t)i, 0);
            at[k] = to->from[i] * ray[k][i];
        }
        if (i >= PIXELS)
        {
            at[0] = far * sign[i - PIXELS][0];
            at[1] = far * sign[i - PIXELS][1];
            at[2] = 5.0;
        }
        cm_pose_apply_back(pose, at, to->position + 3 * i);
    }
    join(to);
}

/* How many of the pixels, but for the rim's, do not see the vertex. */
static size_t count_missed(uint32_t number, double distance_away)
{
    static hill made;
    static float depth[PIXELS];
    cm_camera *camera = make_camera(50.0);
    cm_pose pose;
    make_hill(number, distance_away, camera, &made, &pose);
    const cm_mesh_options shape = {.size = sizeof shape,
                                   .vertex_count = VERTICES,
                                   .position = made.position,
                                   .triangle_count = TRIANGLES,
                                   .index = made.index,
                                   .material = {{1, 1, 1}, 0.5}};
    cm_mesh *mesh = NULL;
    ck_assert_int_eq(cm_mesh_create(&shape, &mesh), CM_OK);
    cm_primitive body = wall;
    body.kind = CM_PRIMITIVE_MESH;
    body.mesh = mesh;
    body.pose = at_origin;
    stage at = make_stage(&body, 1);
    const double time = 0.0;
    cm_trajectory *standing = NULL;
    ck_assert_int_eq(cm_trajectory_create(1, &time, &pose, &standing, NULL), CM_OK);
    cm_tof_truth truth = {.size = sizeof truth, .depth = depth};
    ck_assert_int_eq(cm_tof_find_truth(at.scene, camera, standing, 0.0, 0.0, 0.0, NULL, &truth),
                     CM_OK);
    size_t missed = 0;
    for (size_t row = 1; row + 1 < HEIGHT; row++)
    {
        for (size_t i = row * WIDTH + 1; i < row * WIDTH + WIDTH - 1; i++)
        {
            missed += fabs((double)depth[i] - made.from[i]) < 1e-6 ? 0 : 1; /* or NaN */
        }
    }
    cm_trajectory_destroy(standing);
    free_stage(&at);
    cm_mesh_destroy(mesh);
    cm_camera_destroy(camera);
    return missed;
}

START_TEST(rays_to_vertices_meet_them)
{
    size_t all = 0;
    const double away[] = {0.0, 1.0, 30.0, 1000.0};
    for (size_t i = 0; i < sizeof away / sizeof *away; i++)
    {
        size_t missed = 0;
        for (uint32_t number = 0; number < 12; number++)
        {
            missed += count_missed(number, away[i]);
        }
        printf("%g m away: %zu of %d missed\n", away[i], missed, 12 * (WIDTH - 2) * (HEIGHT - 2));
        all += missed;
    }
    ck_assert_uint_eq(all, 0);
}
END_TEST

/* Triangles anywhere, of sides from a third of the whole to a millionth, or needles as thin as 1e-12 of it. */
static void make_soup(uint32_t number, double scale, double *position, uint32_t *index)
{
    for (uint32_t i = 0; i < SOUP; i++)
    {
        const double part =
            number % 2 == 0 ? 0.3 : pow(10.0, -6.0 * cm_random_uniform(3, number, i, 0));
        const double width = pow(10.0, -3.0 - 9.0 * cm_random_uniform(4, number, i, 0));
        double *const corner = position + 9 * (size_t)i;
        for (uint32_t k = 0; k < 9; k++)
        {
            const double centre =
                cm_random_uniform(5, number, i, k % 3) + (k % 3 == 2 ? 1.0 : -0.5);
            corner[k] = scale * (centre + part * (cm_random_uniform(6, number, i, k) - 0.5));
        }
        for (uint32_t k = 0; number % 4 == 2 && k < 3; k++)
        {
            const double beside = width * (cm_random_uniform(7, number, i, k) - 0.5);
            corner[6 + k] = 0.7 * corner[k] + 0.3 * corner[3 + k] + scale * beside;
        }
        for (uint32_t k = 0; k < 3; k++)
        {
            index[3 * i + k] = 3 * i + k;
        }
    }
}

/* Pixels that see another distance than rays of the library cubemap-scene, which has no single precision. */
static size_t count_other(const stage *at, double scale)
{
    static double place[3][PIXELS];
    size_t other = 0;
    cm_tof_truth truth = {.size = sizeof truth, .position = {place[0], place[1], place[2]}};
    ck_assert_int_eq(cm_tof_find_truth(at->scene, at->camera, NULL, 0.0, 0.0, 0.0, NULL, &truth),
                     CM_OK);
    for (size_t i = 0; i < PIXELS; i++)
    {
        const double x = ((double)(i % WIDTH) - 32.0) / 50.0;
        const double y = ((double)(i / WIDTH) - 24.0) / 50.0;
        const double one = 1.0, zero = 0.0;
        double depth = NAN;
        uint32_t id = CM_SCENE_NOTHING;
        const cm_hit_arrays hit = {.size = sizeof hit, .distance = &depth, .id = &id};
        cm_scene_cast_array(at->world, 1, &zero, &zero, &zero, &x, &y, &one, &hit);
        const int is_met = id != CM_SCENE_NOTHING;
        const double apart = is_met ? fabs(place[2][i] - depth) : 0.0;
        other += isnan(place[2][i]) == is_met || !(apart <= 1e-7 * scale) ? 1 : 0;
    }
    return other;
}

START_TEST(triangles_of_any_size_and_shape_are_met)
{
    static double position[9 * SOUP];
    static uint32_t index[3 * SOUP];
    const cm_mesh_options shape = {.size = sizeof shape,
                                   .vertex_count = 3 * SOUP,
                                   .position = position,
                                   .triangle_count = SOUP,
                                   .index = index,
                                   .material = {{1, 1, 1}, 0.5}};
    const double scale[] = {1e-26, 1e-6, 1.0, 1e6, 1e15};
    for (uint32_t number = 0; number < 20; number++)
    {
        cm_mesh *mesh = NULL;
        make_soup(number, scale[number % 5], position, index);
        ck_assert_int_eq(cm_mesh_create(&shape, &mesh), CM_OK);
        cm_primitive body = wall;
        body.kind = CM_PRIMITIVE_MESH;
        body.mesh = mesh;
        body.pose = at_origin;
        stage at = make_stage(&body, 1);
        ck_assert_uint_eq(count_other(&at, scale[number % 5]), 0);
        free_stage(&at);
        cm_mesh_destroy(mesh);
    }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {rays_to_vertices_meet_them,
                                  triangles_of_any_size_and_shape_are_met, NULL};
    return run_suite("mesh vertices", tests);
}
