/* SPDX-License-Identifier: MIT
 *
 * Frames with each effect, and with all of them: not one bit depends on how many threads there are.
 */
#include "tof_stage.h"

enum
{
    SKY_EDGE = 8
};

/* A wall, a metal ball that moves, a mesh of two triangles that turn around each other, and a cylinder. */
typedef struct hall
{
    cm_mesh *mesh;
    cm_brdf *metal;
    cm_trajectory *way;
    cm_mapping *mapping;
    float sky[6 * SKY_EDGE * SKY_EDGE];
    cm_tof_environment environment;
    stage at;
} hall;

static void make_hall(hall *made)
{
    static const double corner[12] = {-0.5, 0.2, 1.1, -0.2, 0.3, 1.2,
                                      -0.4, 0.5, 1.0, -0.3, 0.1, 1.3};
    static const uint32_t index[6] = {0, 1, 2, 1, 2, 3};
    const cm_mesh_options shape = {.size = sizeof shape,
                                   .vertex_count = 4,
                                   .position = corner,
                                   .triangle_count = 2,
                                   .index = index,
                                   .material = {{1, 1, 1}, 0.7}};
    const cm_cook_torrance metal = {sizeof metal, 0.3, 0.5, 0.3, 2.8, 8.45};
    const double time[2] = {0.0, 0.1};
    const cm_pose pose[2] = {{{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {0, 0, 0}},
                             {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {0.2, 0.1, 0}}};
    ck_assert_int_eq(cm_mesh_create(&shape, &made->mesh), CM_OK);
    ck_assert_int_eq(cm_brdf_create_cook_torrance(&metal, &made->metal), CM_OK);
    ck_assert_int_eq(cm_trajectory_create(2, time, pose, &made->way, NULL), CM_OK);
    const cm_primitive all[4] = {wall,
                                 {.size = sizeof(cm_primitive),
                                  .kind = CM_PRIMITIVE_SPHERE,
                                  .first = {0.2, -0.1, 1.2},
                                  .radius = 0.2,
                                  .material = {{1, 1, 1}, 0.9},
                                  .brdf = made->metal,
                                  .motion = made->way},
                                 {.size = sizeof(cm_primitive),
                                  .kind = CM_PRIMITIVE_MESH,
                                  .mesh = made->mesh,
                                  .pose = pose[0],
                                  .material = {{1, 1, 1}, 1.0}},
                                 {.size = sizeof(cm_primitive),
                                  .kind = CM_PRIMITIVE_CYLINDER,
                                  .first = {-0.3, 0.1, 1.2},
                                  .second = {0.4, 0.2, 1.4},
                                  .radius = 0.02,
                                  .material = {{1, 1, 1}, 0.4}}};
    made->at = make_stage(all, 4);
    made->mapping = make_mapping("tangent", NULL);
    for (int i = 0; i < 6 * SKY_EDGE * SKY_EDGE; i++)
    {
        made->sky[i] = i % 97 == 0 ? 1e-3f : 1e-6f;
    }
    const cm_tof_environment environment = {.size = sizeof environment,
                                            .mapping = made->mapping,
                                            .edge = SKY_EDGE,
                                            .radiance = made->sky,
                                            .constant = 1e-6};
    made->environment = environment;
}

static void free_hall(hall *made)
{
    free_stage(&made->at);
    cm_mesh_destroy(made->mesh);
    cm_brdf_destroy(made->metal);
    cm_trajectory_destroy(made->way);
    cm_mapping_destroy(made->mapping);
}

static void compare(const hall *h, double time, cm_tof_options options, const char *what)
{
    static float first_phase[8 * PIXELS], first_distance[PIXELS];
    static uint8_t first_flags[PIXELS];
    const unsigned threads[] = {1, 2, 7};
    options.size = sizeof options;
    for (int t = 0; t < 3; t++)
    {
        cm_pool *pool = NULL;
        cm_tof_result result = whole_result();
        memset(phase, 0, sizeof phase);
        ck_assert_int_eq(cm_pool_create(threads[t], &pool), CM_OK);
        ck_assert_int_eq(cm_tof_simulate(h->at.scene, &h->at.sensor, &h->at.light, 1, NULL, time,
                                         &options, pool, &result),
                         CM_OK);
        cm_pool_destroy(pool);
        if (t == 0)
        {
            memcpy(first_phase, phase, sizeof phase);
            memcpy(first_distance, distance, sizeof distance);
            memcpy(first_flags, flags, sizeof flags);
        }
        REQUIRE(memcmp(first_phase, phase, sizeof phase) == 0 &&
                    memcmp(first_distance, distance, sizeof distance) == 0 &&
                    memcmp(first_flags, flags, sizeof flags) == 0,
                "%s: %u threads make another frame", what, threads[t]);
    }
}

START_TEST(threads_change_no_bit_of_any_effect)
{
    static hall h;
    make_hall(&h);
    const struct
    {
        const char *what;
        cm_tof_options options;
    } ways[] = {
        {"virtual lights", {.bounces = 1, .lights = 60}},
        {"virtual lights with shadows", {.bounces = 1, .lights = 40, .visibility = 1}},
        {"paths of two bounces", {.bounces = 2, .paths = 3}},
        {"paths of one bounce, all samples",
         {.bounces = 1, .traces = 1, .paths = 2, .sample_columns = 2, .sample_rows = 2, .full = 1}},
        {"surroundings", {.environment = &h.environment, .paths = 6}},
        {"all",
         {.bounces = 1,
          .lights = 20,
          .visibility = 1,
          .environment = &h.environment,
          .paths = 4,
          .sample_columns = 2,
          .sample_rows = 3,
          .noise = 1,
          .seed = 9}}};
    for (int moving = 0; moving < 2; moving++)
    {
        /* when the ball has come to its end, and before */
        h.at.sensor.exposure = 2e-3;
        h.at.sensor.second_frequency = moving ? 15e6 : 0.0;
        h.at.sensor.single_readout = moving;
        h.at.sensor.read_noise = h.at.sensor.dark = 10.0;
        h.at.sensor.fixed_pattern = 0.01;
        h.at.light.position[0] = 0.05;
        for (size_t i = is_quick() && moving; i < sizeof ways / sizeof *ways; i += step_of(2))
        {
            cm_tof_options options = ways[i].options;
            options.sample_times = moving ? 2 : 1;
            options.shot = moving ? CM_TOF_FREEMAN_TUKEY : CM_TOF_POISSON;
            compare(&h, moving ? 0.0 : 0.2, options, ways[i].what);
        }
    }
    free_hall(&h);
}
END_TEST

enum
{
    AT_ONCE = 6
};

typedef struct several
{
    const hall *of;
    float distance[AT_ONCE][PIXELS];
    cm_status status[AT_ONCE];
} several;

static void take_frames(size_t begin, size_t end, void *user)
{
    several *const to = user;
    const cm_tof_options options = {.size = sizeof options, .sample_columns = 3, .sample_rows = 3};
    for (size_t i = begin; i < end; i++)
    {
        const stage *at = &to->of->at;
        cm_tof_result result = {.size = sizeof result, .distance = to->distance[i]};
        to->status[i] = cm_tof_simulate(at->scene, &at->sensor, &at->light, 1, NULL, 0.2, &options,
                                        NULL, &result);
    }
}

/* Of a scene whose mesh no frame has asked for its edges so far. */
START_TEST(frames_of_one_scene_may_be_made_at_once)
{
    static hall h;
    static several all;
    cm_pool *pool = NULL;
    make_hall(&h);
    all.of = &h;
    ck_assert_int_eq(cm_pool_create(AT_ONCE, &pool), CM_OK);
    cm_pool_run(pool, AT_ONCE, 1, take_frames, &all);
    cm_pool_destroy(pool);
    for (int i = 0; i < AT_ONCE; i++)
    {
        ck_assert_int_eq(all.status[i], CM_OK);
        ck_assert_mem_eq(all.distance[i], all.distance[0], sizeof all.distance[0]);
    }
    free_hall(&h);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {threads_change_no_bit_of_any_effect,
                                  frames_of_one_scene_may_be_made_at_once, NULL};
    return run_suite("frame bits", tests);
}
