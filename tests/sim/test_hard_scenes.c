/* SPDX-License-Identifier: MIT
 *
 * Worlds and sensors that nobody builds on purpose: cameras and lights within walls, meshes that are open or of no area, numbers
 * at the ends of their ranges, millions of triangles. Every pixel is measured, or flagged.
 */
#include "tof_stage.h"

#include <float.h>
#include <time.h>

static const cm_pose at_origin = {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {0, 0, 0}};

/* A distance is a number above 0, or there was no light and the flag says so; charges are numbers. */
static size_t count_measured(const char *what)
{
    size_t measured = 0;
    for (size_t i = 0; i < PIXELS; i++)
    {
        const int is_there = distance[i] >= 0.0f && distance[i] <= FLT_MAX;
        ck_assert_msg(is_there || isnan(distance[i]), "%s: %g", what, (double)distance[i]);
        ck_assert_msg(is_there == ((flags[i] & CM_TOF_NOTHING) == 0), "%s: flags of pixel %zu",
                      what, i);
        measured += (size_t)is_there;
    }
    for (size_t i = 0; i < (size_t)PHASES * PIXELS; i++)
    {
        ck_assert_msg(isfinite(charge_a[i]) && isfinite(charge_b[i]), "%s: a charge", what);
    }
    return measured;
}

/* By direct light, virtual lights with shadows, and paths, of one and of more samples. */
static void simulate_all_ways(const stage *at, const char *what, size_t measured[3])
{
    for (int bounces = 0; bounces < 3; bounces++)
    {
        const cm_tof_options options = {.size = sizeof options,
                                        .bounces = bounces,
                                        .visibility = 1,
                                        .lights = 40,
                                        .paths = 4,
                                        .map_edge = 16,
                                        .sample_columns = 2,
                                        .sample_rows = 2,
                                        .noise = bounces == 2};
        ck_assert_int_eq(simulate(at, &options), CM_OK);
        measured[bounces] = count_measured(what);
    }
}

/* In each of these the camera or its light lies in a surface, or in a corner of several. */
START_TEST(cameras_within_walls_see_what_is_behind)
{
    static const struct
    {
        const char *name;
        cm_primitive of;
        int sees_all; /* the camera is within, and there is an other side */
    } hard[] = {
        {"plane across", {.kind = CM_PRIMITIVE_PLANE, .second = {0, 0, 1}}, 0},
        {"plane along", {.kind = CM_PRIMITIVE_PLANE, .second = {1, 0, 0}}, 0},
        {"box around", {.kind = CM_PRIMITIVE_BOX, .first = {-1, -1, -1}, .second = {1, 1, 1}}, 1},
        {"box's face", {.kind = CM_PRIMITIVE_BOX, .first = {-1, -1, 0}, .second = {1, 1, 1}}, 1},
        {"box's corner", {.kind = CM_PRIMITIVE_BOX, .second = {1, 1, 1}}, 0},
        {"sphere's pole", {.kind = CM_PRIMITIVE_SPHERE, .first = {0, 0, 1}, .radius = 1}, 1},
        {"tiny sphere", {.kind = CM_PRIMITIVE_SPHERE, .radius = 1e-300}, 0},
        {"cylinder's cap", {.kind = CM_PRIMITIVE_CYLINDER, .second = {0, 0, 1}, .radius = 0.2}, 1},
        {"in a cylinder",
         {.kind = CM_PRIMITIVE_CYLINDER, .first = {0, 0, -1}, .second = {0, 0, 1}, .radius = 0.2},
         1},
    };
    for (size_t i = 0; i < sizeof hard / sizeof *hard; i++)
    {
        cm_primitive body = hard[i].of;
        size_t measured[3];
        body.size = sizeof body;
        body.material = wall.material;
        stage at = make_stage(&body, 1);
        simulate_all_ways(&at, hard[i].name, measured);
        ck_assert_msg(!hard[i].sees_all || measured[0] == PIXELS, "%s: %zu", hard[i].name,
                      measured[0]);
        free_stage(&at);
    }
}
END_TEST

START_TEST(lights_behind_and_in_walls_light_nothing)
{
    const double places[5][3] = {
        {0, 0, 3.0}, {0, 0, 1.7}, {0, 0, 1e300}, {1e300, 0, 0}, {-1e200, 1e300, -1e300}};
    for (int i = 0; i < 5; i++)
    {
        stage at = make_stage(&wall, 1);
        memcpy(at.light.position, places[i], sizeof places[i]);
        for (int bounces = 0; bounces < 3; bounces++)
        {
            const cm_tof_options options = {.size = sizeof options,
                                            .bounces = bounces,
                                            .lights = 40,
                                            .paths = 4,
                                            .visibility = 1};
            ck_assert_int_eq(simulate(&at, &options), CM_OK);
            (void)count_measured("a light behind");
            for (size_t k = 0; k < PIXELS; k++)
            {
                ck_assert_float_le(amplitude[k], 1e-9f); /* cosines that are rounding */
                ck_assert_uint_eq(flags[k] & CM_TOF_SATURATED, 0);
            }
        }
        free_stage(&at);
    }
}
END_TEST

/* Triangles of no area are not there; those beside them are, with no side that is not seen. */
START_TEST(open_meshes_of_degenerate_triangles_are_met_as_planes)
{
    const double corner[18] = {-9, -9, 1.7, 9, -9, 1.7, 9, 9, 1.7, 1, 1, 1, 1, 1, 1, 2, 2, 2};
    const uint32_t index[15] = {3, 3, 3, 0, 1, 2, 3, 4, 5, 0, 0, 1, 2, 1, 0};
    const cm_mesh_options shape = {.size = sizeof shape,
                                   .vertex_count = 6,
                                   .position = corner,
                                   .triangle_count = 5,
                                   .index = index,
                                   .material = {{1, 1, 1}, 1.0}};
    cm_mesh *mesh = NULL;
    size_t measured[3];
    ck_assert_int_eq(cm_mesh_create(&shape, &mesh), CM_OK);
    cm_primitive body = wall;
    body.kind = CM_PRIMITIVE_MESH;
    body.mesh = mesh;
    body.pose = at_origin;
    stage at = make_stage(&body, 1);
    simulate_all_ways(&at, "open", measured);
    const cm_tof_options plain = {.size = sizeof plain};
    ck_assert_int_eq(simulate(&at, &plain), CM_OK);
    for (size_t i = 0; i < PIXELS; i++)
    {
        const double x = ((double)(i % WIDTH) - 32.0) / 50.0;
        const double y = ((double)(i / WIDTH) - 24.0) / 50.0;
        const double range = 1.7 * sqrt(1.0 + x * x + y * y);
        if (fabs(x - y) > 1e-9) /* not on the border */
        {
            ck_assert_msg(x > y ? fabs((double)distance[i] - range) < 2e-6 : isnan(distance[i]),
                          "pixel %zu: %g, not %g", i, (double)distance[i], range);
        }
    }
    free_stage(&at);
    cm_mesh_destroy(mesh);
}
END_TEST

/* A mesh of nothing but triangles of no area is nowhere. */
START_TEST(meshes_without_area_are_seen_nowhere)
{
    const double corner[9] = {-1, 0, 1, 0, 0, 1, 1, 0, 1};
    const uint32_t index[3] = {0, 1, 2};
    cm_mesh_options shape = {.size = sizeof shape,
                             .vertex_count = 3,
                             .position = corner,
                             .index = index,
                             .material = {{1, 1, 1}, 1.0}};
    for (size_t triangles = 0; triangles < 2; triangles++)
    {
        cm_mesh *mesh = NULL;
        size_t measured[3];
        shape.triangle_count = triangles;
        ck_assert_int_eq(cm_mesh_create(&shape, &mesh), CM_OK);
        cm_primitive body = wall;
        body.kind = CM_PRIMITIVE_MESH;
        body.mesh = mesh;
        body.pose = at_origin;
        stage at = make_stage(&body, 1);
        simulate_all_ways(&at, "no area", measured);
        ck_assert_uint_eq(measured[0] + measured[1] + measured[2], 0);
        free_stage(&at);
        cm_mesh_destroy(mesh);
    }
}
END_TEST

START_TEST(meshes_beyond_reach_are_refused)
{
    const double corner[9] = {-1, 0, 1, 0, 1e18, 1, 1, 0, 1};
    const uint32_t index[3] = {0, 1, 2};
    const cm_mesh_options shape = {.size = sizeof shape,
                                   .vertex_count = 3,
                                   .position = corner,
                                   .triangle_count = 1,
                                   .index = index,
                                   .material = {{1, 1, 1}, 1.0}};
    cm_mesh *mesh = NULL;
    cm_scene *world = NULL;
    cm_tof_scene *scene = NULL;
    ck_assert_int_eq(cm_mesh_create(&shape, &mesh), CM_OK);
    ck_assert_int_eq(cm_scene_create(&world), CM_OK);
    cm_primitive body = wall;
    body.kind = CM_PRIMITIVE_MESH;
    body.mesh = mesh;
    body.pose = at_origin;
    ck_assert_int_eq(cm_scene_add(world, &body, NULL), CM_OK);
    ck_assert_int_eq(cm_tof_scene_create(world, &scene), CM_ERROR_RANGE);
    ck_assert_ptr_null(scene);
    cm_scene_destroy(world);
    cm_mesh_destroy(mesh);
}
END_TEST

/* What no float holds is cut there, and told. */
START_TEST(charges_beyond_all_floats_are_flagged)
{
    for (int single = 0; single < 2; single++)
    {
        for (int noise = 0; noise < 2; noise++)
        {
            const cm_tof_options options = {.size = sizeof options, .noise = noise};
            stage at = make_stage(&wall, 1);
            at.light.power = 1e300;
            at.sensor.single_readout = single;
            at.sensor.fixed_pattern = noise * 0.1;
            ck_assert_int_eq(simulate(&at, &options), CM_OK);
            (void)count_measured("1e300 W");
            for (size_t i = 0; i < PIXELS; i++)
            {
                ck_assert_uint_eq(flags[i] & CM_TOF_SATURATED, CM_TOF_SATURATED);
            }
            free_stage(&at);
        }
    }
}
END_TEST

START_TEST(axes_of_lights_are_of_any_length)
{
    static float kept[PIXELS];
    const double scales[4] = {1.0, 1e-300, 1e300, 1.7e308};
    for (int i = 0; i < 4; i++)
    {
        stage at = make_stage(&wall, 1);
        at.light.aperture = 0.5;
        at.light.direction[0] = 0.25 * scales[i];
        at.light.direction[2] = scales[i];
        ck_assert_int_eq(simulate(&at, NULL), CM_OK);
        ck_assert_uint_gt(count_measured("axis"), 100);
        for (size_t k = 0; k < PIXELS; k++)
        {
            kept[k] = i == 0 ? intensity[k] : kept[k];
            ck_assert_float_le(fabsf(intensity[k] - kept[k]), 1e-5f * kept[k]);
        }
        free_stage(&at);
    }
}
END_TEST

/* A thin cone has all of its power: what falls on the middle of the wall is of the small solid angle. */
START_TEST(thin_cones_keep_their_power)
{
    stage at = make_stage(&wall, 1);
    ck_assert_int_eq(simulate(&at, NULL), CM_OK);
    const double even = (double)intensity[24 * WIDTH + 32];
    at.light.aperture = 1e-6;
    at.light.power = 1e-9;
    ck_assert_int_eq(simulate(&at, NULL), CM_OK);
    ck_assert_uint_eq(count_measured("cone"), 1);
    const double more = 4.0 * PI / (PI * 0.25e-12) * (1e-9 / 0.7);
    ck_assert_double_eq_tol((double)intensity[24 * WIDTH + 32], even * more, 1e-6 * even * more);
    free_stage(&at);
}
END_TEST

/* Waves: a grid of so many corners a side, its triangles found and made anew by hand. */
static cm_mesh *make_waves(size_t side)
{
    double *const corner = malloc(3 * side * side * sizeof *corner);
    uint32_t *const index = malloc(6 * (side - 1) * (side - 1) * sizeof *index);
    cm_mesh *mesh = NULL;
    ck_assert(corner != NULL && index != NULL);
    for (size_t i = 0; i < side * side; i++)
    {
        const double x = -2.0 + 4.0 * (double)(i % side) / (double)(side - 1);
        const double y = -2.0 + 4.0 * (double)(i / side) / (double)(side - 1);
        corner[3 * i] = x;
        corner[3 * i + 1] = y;
        corner[3 * i + 2] = 1.7 + 0.05 * sin(5.0 * x) * cos(4.0 * y);
    }
    uint32_t *next = index;
    for (size_t row = 0; row + 1 < side; row++)
    {
        for (size_t column = 0; column + 1 < side; column++)
        {
            const uint32_t first = (uint32_t)(row * side + column);
            const uint32_t below = first + (uint32_t)side;
            const uint32_t both[6] = {first, first + 1, below + 1, first, below + 1, below};
            memcpy(next, both, sizeof both);
            next += 6;
        }
    }
    const cm_mesh_options shape = {.size = sizeof shape,
                                   .vertex_count = side * side,
                                   .position = corner,
                                   .triangle_count = 2 * (side - 1) * (side - 1),
                                   .index = index,
                                   .material = {{1, 1, 1}, 1.0}};
    ck_assert_int_eq(cm_mesh_create(&shape, &mesh), CM_OK);
    free(corner);
    free(index);
    return mesh;
}

/* Ten million triangles in the long run. */
START_TEST(millions_of_triangles_are_a_surface_without_gaps)
{
    cm_mesh *const mesh = make_waves(is_long() ? 2237 : 225);
    cm_primitive body = wall;
    body.kind = CM_PRIMITIVE_MESH;
    body.mesh = mesh;
    body.pose = at_origin;
    const clock_t begin = clock();
    stage at = make_stage(&body, 1);
    const clock_t made = clock();
    ck_assert_int_eq(simulate(&at, NULL), CM_OK);
    printf("%zu triangles: made in %.2f s, a frame in %.4f s\n",
           cm_mesh_describe(mesh)->triangle_count, (double)(made - begin) / CLOCKS_PER_SEC,
           (double)(clock() - made) / CLOCKS_PER_SEC);
    for (size_t i = 0; i < PIXELS; i++)
    {
        const double x = ((double)(i % WIDTH) - 32.0) / 50.0;
        const double y = ((double)(i / WIDTH) - 24.0) / 50.0;
        const double depth = (double)distance[i] / sqrt(1.0 + x * x + y * y);
        const double waves = 1.7 + 0.05 * sin(5.0 * x * depth) * cos(4.0 * y * depth);
        ck_assert_double_eq_tol(depth, waves, 1e-4); /* facets of 2 cm lie so far within */
    }
    free_stage(&at);
    cm_mesh_destroy(mesh);
}
END_TEST

/* So large that every loop is in pieces of several threads: two circuits a pixel and shared ones, all kinds of noise. */
START_TEST(large_pictures_have_the_same_bits_by_any_threads)
{
    enum
    {
        WIDE = 224,
        HIGH = 171,
        ALL = WIDE * HIGH
    };
    static float seen[2][5][ALL];
    static uint8_t seen_flags[2][ALL];
    const cm_camera_options shape = {.size = sizeof shape,
                                     .width = WIDE,
                                     .height = HIGH,
                                     .fx = 190,
                                     .fy = 190,
                                     .cx = 111.5,
                                     .cy = 85};
    stage at = make_stage(&wall, 1);
    at.sensor.read_noise = 5;
    ck_assert_int_eq(simulate(&at, NULL), CM_OK);
    cm_camera_destroy(at.camera);
    ck_assert_int_eq(cm_camera_create(&shape, &at.camera), CM_OK);
    at.sensor.full_well = 0.7 * (double)charge_a[24 * WIDTH + 32]; /* reached in the middle */
    at.sensor.camera = at.camera;
    for (int way = 0; way < 4; way++)
    {
        at.sensor.single_readout = way % 2;
        at.sensor.fixed_pattern = way / 2 * 0.1;
        const cm_tof_options options = {.size = sizeof options,
                                        .noise = way > 0,
                                        .bounces = way == 1,
                                        .lights = 20,
                                        .sample_columns = 2,
                                        .sample_rows = 2};
        for (int many = 0; many < 2; many++)
        {
            cm_pool *pool = NULL;
            cm_tof_result to = {.size = sizeof to,
                                .phase = seen[many][0],
                                .distance = seen[many][4],
                                .flags = seen_flags[many]};
            at.sensor.phases = 4;
            ck_assert_int_eq(cm_pool_create(many ? 7 : 1, &pool), CM_OK);
            ck_assert_int_eq(
                cm_tof_simulate(at.scene, &at.sensor, &at.light, 1, NULL, 0.0, &options, pool, &to),
                CM_OK);
            cm_pool_destroy(pool);
        }
        ck_assert_mem_eq(seen[0], seen[1], sizeof seen[0]);
        ck_assert_mem_eq(seen_flags[0], seen_flags[1], sizeof seen_flags[0]);
        ck_assert(seen_flags[0][HIGH / 2 * WIDE + WIDE / 2] & CM_TOF_SATURATED);
    }
    free_stage(&at);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {cameras_within_walls_see_what_is_behind,
                                  lights_behind_and_in_walls_light_nothing,
                                  open_meshes_of_degenerate_triangles_are_met_as_planes,
                                  meshes_without_area_are_seen_nowhere,
                                  meshes_beyond_reach_are_refused,
                                  charges_beyond_all_floats_are_flagged,
                                  axes_of_lights_are_of_any_length,
                                  thin_cones_keep_their_power,
                                  millions_of_triangles_are_a_surface_without_gaps,
                                  large_pictures_have_the_same_bits_by_any_threads,
                                  NULL};
    return run_suite("hard scenes", tests);
}
