/* SPDX-License-Identifier: MIT
 *
 * Plans: what is dropped and kept depends on what effects do to distances, not on how long frames chance to take.
 */
#include "tof_stage.h"

static const cm_primitive ball = {.size = sizeof ball,
                                  .kind = CM_PRIMITIVE_SPHERE,
                                  .first = {0.1, 0.1, 1.2},
                                  .radius = 0.3,
                                  .material = {{1, 1, 1}, 0.8}};

/* Frames of so few pixels that those with an effect are often made faster than those without. */
static stage make_small_stage(void)
{
    const cm_primitive both[2] = {wall, ball};
    const cm_camera_options shape = {
        .size = sizeof shape, .width = 6, .height = 4, .fx = 5, .fy = 5, .cx = 2.5, .cy = 1.5};
    stage at = make_stage(both, 2);
    cm_camera_destroy(at.camera);
    ck_assert_int_eq(cm_camera_create(&shape, &at.camera), CM_OK);
    at.sensor.camera = at.camera;
    return at;
}

static void plan(const stage *at, double limit, cm_tof_options *chosen, cm_budget *budget)
{
    const cm_tof_options most = {
        .size = sizeof most, .sample_columns = 3, .sample_rows = 3, .lights = 5};
    chosen->size = sizeof *chosen;
    budget->size = sizeof *budget;
    ck_assert_int_eq(cm_tof_plan(at->scene, &at->sensor, &at->light, 1, NULL, 0.0, limit, &most,
                                 NULL, chosen, budget),
                     CM_OK);
}

START_TEST(clocks_decide_nothing)
{
    stage at = make_small_stage();
    for (int run = 0; run < 30; run++)
    {
        cm_budget_entry entry[CM_TOF_EFFECTS] = {{0}};
        cm_budget budget = {.entry = entry};
        cm_tof_options chosen = {0};
        plan(&at, 1e6, &chosen, &budget);
        for (size_t i = 0; i < CM_TOF_EFFECTS; i++)
        {
            REQUIRE(!entry[i].is_kept, "run %d: %s is kept: %s", run, entry[i].name,
                    entry[i].reason);
        }
        ck_assert(chosen.bounces == 0 && chosen.sample_columns == 1 && !chosen.noise);
        plan(&at, 0.0, &chosen, &budget);
        ck_assert(chosen.bounces >= 1 && chosen.sample_columns == 3 && chosen.noise);
        ck_assert_double_eq(budget.error, 0.0);
    }
    free_stage(&at);
}
END_TEST

/* The root mean square of what noise changes of distances. */
static double spread_of_noise(const stage *at, const cm_tof_options *options)
{
    static float clean[PIXELS];
    cm_tof_options with = *options;
    double squares = 0.0;
    with.noise = 0;
    ck_assert_int_eq(simulate(at, &with), CM_OK);
    memcpy(clean, distance, sizeof clean);
    with.noise = 1;
    ck_assert_int_eq(simulate(at, &with), CM_OK);
    for (size_t i = 0; i < PIXELS; i++)
    {
        squares +=
            ((double)distance[i] - (double)clean[i]) * ((double)distance[i] - (double)clean[i]);
    }
    return sqrt(squares / PIXELS);
}

/* Noise is what frames have: of either kind, of a measured polynomial, of the surroundings' light and of the circuits. */
START_TEST(noise_is_that_of_frames)
{
    static const double nine[] = {9.0};
    const cm_tof_environment sky = {.size = sizeof sky, .constant = 0.1};
    const struct
    {
        const char *name;
        double dark, read_noise, fixed_pattern;
        int shot;
        size_t terms;
        const cm_tof_environment *environment;
    } kinds[] = {{"Poisson", 0, 0, 0, CM_TOF_POISSON, 0, NULL},
                 {"circuits", 1e5, 30, 0.02, CM_TOF_POISSON, 0, NULL},
                 {"surroundings", 0, 0, 0, CM_TOF_POISSON, 0, &sky},
                 {"Freeman and Tukey", 0, 0, 0, CM_TOF_FREEMAN_TUKEY, 0, NULL},
                 {"nine times the variance", 0, 0, 0, CM_TOF_FREEMAN_TUKEY, 1, NULL},
                 {"all", 1e5, 30, 0.02, CM_TOF_FREEMAN_TUKEY, 1, &sky}};
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
    {
        const cm_primitive far = {.size = sizeof far,
                                  .kind = CM_PRIMITIVE_PLANE,
                                  .first = {0, 0, 3},
                                  .second = {0, 0, 1},
                                  .material = {{1, 1, 1}, 0.6}};
        stage at = make_stage(&far, 1);
        at.light.power = 20.0;
        at.sensor.dark = kinds[i].dark;
        at.sensor.read_noise = kinds[i].read_noise;
        at.sensor.fixed_pattern = kinds[i].fixed_pattern;
        at.sensor.shot_terms = kinds[i].terms;
        at.sensor.shot_variance = nine;
        at.sensor.shot_least = 1.0;
        at.sensor.shot_most = 1e3;
        cm_budget_entry entry[CM_TOF_EFFECTS] = {{0}};
        cm_budget budget = {.size = sizeof budget, .entry = entry};
        const cm_tof_options most = {.size = sizeof most,
                                     .lights = 5,
                                     .seed = 5,
                                     .shot = kinds[i].shot,
                                     .environment = kinds[i].environment,
                                     .paths = 8};
        cm_tof_options chosen = {.size = sizeof chosen};
        ck_assert_int_eq(cm_tof_plan(at.scene, &at.sensor, &at.light, 1, NULL, 0.0, 0.0, &most,
                                     NULL, &chosen, &budget),
                         CM_OK);
        const double measured = spread_of_noise(&at, &most);
        printf("%s: %.3f mm, %.3f mm planned\n", kinds[i].name, 1e3 * measured,
               1e3 * entry[4].contribution);
        ck_assert_str_eq(entry[4].name, "noise");
        REQUIRE(fabs(entry[4].contribution - measured) < 0.05 * measured, "%s: %g m, not %g",
                kinds[i].name, entry[4].contribution, measured);
        free_stage(&at);
    }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {clocks_decide_nothing, noise_is_that_of_frames, NULL};
    return run_suite("plan", tests);
}
