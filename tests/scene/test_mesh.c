/* SPDX-License-Identifier: MIT
 *
 * Meshes: what is refused, and that rays find in the tree what going through all triangles finds, edges and corners too.
 */
#define _POSIX_C_SOURCE 200809L

#include <cubemap/world.h>

#include "tests/suite.h"
#include "truth/scenes/ray_truth.h"

enum
{
    SIDE = 12,
    GRID_VERTICES = (SIDE + 1) * (SIDE + 1),
    GRID_TRIANGLES = 2 * SIDE * SIDE,
    RAYS = 4000
};

/* A hilly square of triangles over [0, 1]^2, whose corners are at multiples of 1 / SIDE. */
typedef struct hills
{
    double position[3 * GRID_VERTICES];
    float color[3 * GRID_VERTICES];
    uint32_t index[3 * GRID_TRIANGLES];
} hills;

static void make_hills(hills *made)
{
    uint64_t state = 3;
    for (int i = 0; i < GRID_VERTICES; i++)
    {
        made->position[3 * i] = (double)(i % (SIDE + 1)) / SIDE;
        made->position[3 * i + 1] = (double)(i / (SIDE + 1)) / SIDE;
        made->position[3 * i + 2] = 0.1 * next_real(&state);
        made->color[3 * i] = (float)made->position[3 * i];
        made->color[3 * i + 1] = (float)made->position[3 * i + 1];
        made->color[3 * i + 2] = 0.5f;
    }
    for (uint32_t i = 0; i < SIDE * SIDE; i++)
    {
        const uint32_t a = i / SIDE * (SIDE + 1) + i % SIDE;
        const uint32_t corners[6] = {a, a + 1, a + SIDE + 1, a + 1, a + SIDE + 2, a + SIDE + 1};
        memcpy(made->index + 6 * (size_t)i, corners, sizeof corners);
    }
}

static cm_mesh_options options_of(const hills *from)
{
    return (cm_mesh_options){.size = sizeof(cm_mesh_options),
                             .vertex_count = GRID_VERTICES,
                             .position = from->position,
                             .color = from->color,
                             .triangle_count = GRID_TRIANGLES,
                             .index = from->index,
                             .material = {{1.0, 0.5, 1.0}, 0.8}};
}

static cm_scene *world_with(const cm_mesh *mesh, const cm_pose *pose)
{
    cm_scene *scene = NULL;
    ck_assert_int_eq(cm_scene_create(&scene), CM_OK);
    const cm_primitive one = {.size = sizeof one,
                              .kind = CM_PRIMITIVE_MESH,
                              .mesh = mesh,
                              .pose = *pose,
                              .material = {{1.0, 1.0, 1.0}, 0.5}};
    ck_assert_int_eq(cm_scene_add(scene, &one, NULL), CM_OK);
    return scene;
}

static double cast_one(const cm_scene *scene, const double from[3], const double to[3],
                       uint32_t *triangle, double color[3], double *reflectance)
{
    double distance;
    const double direction[3] = {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
    const cm_hit_arrays hit = {.size = sizeof hit,
                               .distance = &distance,
                               .triangle = triangle,
                               .color = {&color[0], &color[1], &color[2]},
                               .reflectance = reflectance};
    cm_scene_cast_array(scene, 1, &from[0], &from[1], &from[2], &direction[0], &direction[1],
                        &direction[2], &hit);
    return distance;
}

/* A point over the hills: anywhere, or exactly above an edge or a corner. */
static void choose_place(uint64_t *state, int kind, double place[3])
{
    for (int i = 0; i < 2; i++)
    {
        place[i] = 0.5 + 0.2 * next_real(state); /* slanting rays stay over the hills */
        if (kind == 1 || (kind == 2 && i == 0))
        {
            place[i] = round(place[i] * SIDE) / SIDE;
        }
    }
    place[2] = 0.0;
}

static void check_rays(const cm_scene *scene, const cm_pose *pose)
{
    uint64_t state = 8;
    for (int k = 0; k < RAYS; k++)
    {
        double to[3], from[3], color[3], reflectance;
        choose_place(&state, k % 3, to);
        /* from above; straight down the ray meets the edge itself */
        memcpy(from, to, sizeof from);
        from[2] = k % 2 == 0 ? 1.0 : -2.0;
        if (k % 4 < 2)
        {
            from[0] += 2.0 * next_real(&state);
            from[1] += 2.0 * next_real(&state);
        }
        cm_pose_apply_back(pose, to, to);
        cm_pose_apply_back(pose, from, from);
        uint32_t triangle, id;
        const double distance = cast_one(scene, from, to, &triangle, color, &reflectance);
        double direction[3], next;
        for (int i = 0; i < 3; i++)
        {
            direction[i] = to[i] - from[i];
        }
        const double truth = ray_truth(scene, from, direction, &id, &next);
        /* on an edge the truth may go between two triangles, but not the tree */
        REQUIRE(distance < INFINITY, "a crack");
        REQUIRE(fabs(distance - truth) < 1e-13 || (k % 3 != 0 && fabs(distance - next) < 1e-13) ||
                    (k % 3 != 0 && distance < truth),
                "%d: %.17g, not %.17g", k, distance, truth);
        REQUIRE(reflectance == 0.8 * 0.5 && triangle < GRID_TRIANGLES, "%g", reflectance);
        if (k % 4 >= 2 && pose->rotation.row[0][0] == 1.0) /* straight down on what is not moved */
        {
            REQUIRE(fabs(color[0] - to[0]) < 1e-6 && fabs(color[1] - 0.5 * to[1]) < 1e-6,
                    "color %g %g at %g %g", color[0], color[1], to[0], to[1]);
        }
    }
}

START_TEST(the_tree_finds_what_all_triangles_have)
{
    hills made;
    make_hills(&made);
    const cm_mesh_options options = options_of(&made);
    cm_mesh *mesh = NULL;
    ck_assert_int_eq(cm_mesh_create(&options, &mesh), CM_OK);
    double least[3], greatest[3];
    cm_mesh_bounds(mesh, least, greatest);
    ck_assert(least[0] == 0.0 && greatest[1] == 1.0 && least[2] >= -0.1 && greatest[2] < 0.1);
    cm_pose pose = {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {0, 0, 0}};
    cm_scene *scene = world_with(mesh, &pose);
    check_rays(scene, &pose);
    cm_scene_destroy(scene);
    ck_assert_int_eq(cm_rotation_from_angles(25, -40, 70, &pose.rotation), CM_OK);
    pose.position[0] = 3.0;
    pose.position[1] = -1.0;
    scene = world_with(mesh, &pose);
    check_rays(scene, &pose);
    cm_scene_destroy(scene);
    ck_assert(cm_mesh_describe(mesh)->position != made.position);
    cm_mesh_destroy(mesh);
}
END_TEST

/* All triangles in one place, or in a line: no split helps. */
START_TEST(triangles_that_lie_on_each_other)
{
    double position[9] = {0, 0, 1, 1, 0, 1, 0, 1, 1};
    uint32_t index[3000];
    for (uint32_t i = 0; i < 3000; i++)
    {
        index[i] = i % 3;
    }
    const cm_mesh_options options = {.size = sizeof options,
                                     .vertex_count = 3,
                                     .position = position,
                                     .triangle_count = 1000,
                                     .index = index};
    cm_mesh *mesh = NULL;
    ck_assert_int_eq(cm_mesh_create(&options, &mesh), CM_OK);
    const cm_pose pose = {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {0, 0, 0}};
    cm_scene *scene = world_with(mesh, &pose);
    uint32_t triangle;
    double color[3], reflectance;
    const double from[3] = {0.25, 0.25, 0.0}, to[3] = {0.25, 0.25, 2.0};
    ck_assert_double_eq(cast_one(scene, from, to, &triangle, color, &reflectance), 0.5);
    const double beside[3] = {0.75, 0.75, 0.0}, up[3] = {0.75, 0.75, 2.0};
    ck_assert(isinf(cast_one(scene, beside, up, &triangle, color, &reflectance)));
    const double edge_on[3] = {0.2, 0.2, 1.0}, along[3] = {0.9, 0.3, 1.0};
    ck_assert(isinf(cast_one(scene, edge_on, along, &triangle, color, &reflectance)));
    cm_scene_destroy(scene);
    cm_mesh_destroy(mesh);
}
END_TEST

static void refused(cm_mesh_options options, cm_status wanted)
{
    cm_mesh *mesh = NULL;
    ck_assert_int_eq(cm_mesh_create(&options, &mesh), wanted);
    ck_assert_ptr_null(mesh);
}

START_TEST(what_is_no_mesh_is_refused)
{
    hills made;
    make_hills(&made);
    const cm_mesh_options good = options_of(&made);
    cm_mesh_options bad = good;
    bad.size = 0;
    refused(bad, CM_ERROR_ARGUMENT);
    bad = good;
    bad.vertex_count--;
    refused(bad, CM_ERROR_ARGUMENT); /* an index out of range */
    bad = good;
    bad.index = NULL;
    refused(bad, CM_ERROR_ARGUMENT);
    bad = good;
    bad.triangle_count = (size_t)1 << 31;
    refused(bad, CM_ERROR_ARGUMENT);
    bad = good;
    bad.material.reflectance = NAN;
    refused(bad, CM_ERROR_RANGE);
    made.color[5] = 1.01f;
    refused(good, CM_ERROR_RANGE);
    made.color[5] = 1.0f;
    made.position[7] = NAN;
    refused(good, CM_ERROR_RANGE);
    made.position[7] = 0.0;
    float normals[3 * GRID_VERTICES] = {0.0f};
    bad = good;
    bad.normal = normals;
    refused(bad, CM_ERROR_RANGE);
    cm_mesh *mesh = NULL;
    ck_assert_int_eq(cm_mesh_create(NULL, &mesh), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_mesh_create(&good, NULL), CM_ERROR_ARGUMENT);
    cm_mesh_destroy(NULL);
    const cm_mesh_options empty = {.size = sizeof empty};
    double least[3], greatest[3];
    ck_assert_int_eq(cm_mesh_create(&empty, &mesh), CM_OK);
    cm_mesh_bounds(mesh, least, greatest);
    ck_assert(isnan(least[0]) && isnan(greatest[2]));
    cm_mesh_destroy(mesh);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {the_tree_finds_what_all_triangles_have,
                                  triangles_that_lie_on_each_other, what_is_no_mesh_is_refused,
                                  NULL};
    return run_suite("mesh", tests);
}
