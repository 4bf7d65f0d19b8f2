/* SPDX-License-Identifier: MIT
 *
 * Plans: what is dropped and kept depends on what effects do to distances, not on how long frames chance to take.
 */
#include "tof_stage.h"

enum
{
    MULTIPATH = 1,
    VISIBILITY,
    FURTHER,
    NOISE,
    BEYOND = 7,
    SAMPLING
};

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
        /* nothing is dropped: what remains is that light is sampled */
        ck_assert_double_eq(budget.error, entry[SAMPLING].contribution);
        ck_assert_double_gt(budget.error, 0.0);
        ck_assert_str_eq(entry[SAMPLING].reason,
                         "beyond the limit: no number of samples has no error");
    }
    free_stage(&at);
}
END_TEST

/* From where on distances of 20 MHz, and another frequency with them, repeat. */
static double range_of(const cm_tof_sensor *sensor)
{
    int wraps = 1;
    while (sensor->second_frequency > 0.0 &&
           fmod(wraps * sensor->second_frequency, sensor->frequency) != 0.0)
    {
        wraps++;
    }
    return wraps * 0.5 * CM_SPEED_OF_LIGHT / sensor->frequency;
}

/* The root mean square of what noise changes of distances, around their circle. */
static double spread_of_noise(const stage *at, const cm_tof_options *options, double range)
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
        const double apart = remainder((double)distance[i] - (double)clean[i], range);
        squares += apart * apart;
    }
    return sqrt(squares / PIXELS);
}

static const double nine_times[] = {9.0};
static const cm_tof_environment even_sky = {.size = sizeof even_sky, .constant = 0.1};

typedef struct noise_kind
{
    const char *name;
    double dark, read_noise, fixed_pattern;
    int shot;
    size_t terms;
    const cm_tof_environment *environment;
    double second_frequency, bound, power;
} noise_kind;

static const noise_kind noise_kinds[] = {
    {"Poisson", 0, 0, 0, CM_TOF_POISSON, 0, NULL, 0, 0.05, 20},
    {"circuits", 1e5, 30, 0.02, CM_TOF_POISSON, 0, NULL, 0, 0.05, 20},
    {"surroundings", 0, 0, 0, CM_TOF_POISSON, 0, &even_sky, 0, 0.05, 20},
    {"Freeman and Tukey", 0, 0, 0, CM_TOF_FREEMAN_TUKEY, 0, NULL, 0, 0.05, 20},
    {"nine times the variance", 0, 0, 0, CM_TOF_FREEMAN_TUKEY, 1, NULL, 0, 0.05, 20},
    {"all", 1e5, 30, 0.02, CM_TOF_FREEMAN_TUKEY, 1, &even_sky, 0, 0.05, 20},
    {"two frequencies", 1e5, 30, 0.02, CM_TOF_POISSON, 0, NULL, 15e6, 0.05, 20},
    {"two and a pattern", 0, 0, 0.1, CM_TOF_POISSON, 0, NULL, 35e6, 0.05, 20},
    {"one repeats in the other", 0, 0, 0, CM_TOF_POISSON, 0, NULL, 40e6, 0.05, 20},
    /* some hundred pixels of 3072, whose number is by chance, too */
    {"wrong wraps", 1e5, 150, 0, CM_TOF_POISSON, 0, NULL, 19e6, 0.15, 20},
    /* after 2000 wraps of the first both repeat: the next ones, and any of the first 1000 */
    {"beyond the most wraps", 0, 0, 0, CM_TOF_POISSON, 0, NULL, 20.01e6, 0.05, 200},
    {"any of the most wraps", 1e5, 30, 0, CM_TOF_POISSON, 0, NULL, 20.01e6, 0.05, 0.2},
    /* the angle of much noise is no normal number, and more wraps than the next ones are taken */
    {"wide tails", 1e5, 600, 0, CM_TOF_POISSON, 0, NULL, 18e6, 0.05, 20},
    {"any wrap", 1e5, 30, 0, CM_TOF_POISSON, 0, NULL, 18e6, 0.05, 0.2},
    {"little light", 1e5, 30, 0, CM_TOF_POISSON, 0, NULL, 0, 0.05, 0.05}};

static void check_noise(const noise_kind *kind)
{
    const cm_primitive far = {.size = sizeof far,
                              .kind = CM_PRIMITIVE_PLANE,
                              .first = {0, 0, 3},
                              .second = {0, 0, 1},
                              .material = {{1, 1, 1}, 0.6}};
    stage at = make_stage(&far, 1);
    at.light.power = kind->power;
    at.sensor.dark = kind->dark;
    at.sensor.read_noise = kind->read_noise;
    at.sensor.fixed_pattern = kind->fixed_pattern;
    at.sensor.second_frequency = kind->second_frequency;
    at.sensor.shot_terms = kind->terms;
    at.sensor.shot_variance = nine_times;
    at.sensor.shot_least = 1.0;
    at.sensor.shot_most = 1e3;
    cm_budget_entry entry[CM_TOF_EFFECTS] = {{0}};
    cm_budget budget = {.size = sizeof budget, .entry = entry};
    const cm_tof_options most = {.size = sizeof most,
                                 .lights = 5,
                                 .seed = 5,
                                 .shot = kind->shot,
                                 .environment = kind->environment,
                                 .paths = 8};
    cm_tof_options chosen = {.size = sizeof chosen};
    ck_assert_int_eq(cm_tof_plan(at.scene, &at.sensor, &at.light, 1, NULL, 0.0, 0.0, &most, NULL,
                                 &chosen, &budget),
                     CM_OK);
    const double measured = spread_of_noise(&at, &most, range_of(&at.sensor));
    printf("%s: %.3f mm, %.3f mm planned\n", kind->name, 1e3 * measured,
           1e3 * entry[4].contribution);
    ck_assert_str_eq(entry[4].name, "noise");
    REQUIRE(fabs(entry[4].contribution - measured) < kind->bound * measured, "%s: %g m, not %g",
            kind->name, entry[4].contribution, measured);
    free_stage(&at);
}

/* Noise is what frames have: of either kind, of a measured polynomial, of the surroundings' light and of the circuits. */
START_TEST(noise_is_that_of_frames)
{
    for (size_t i = 0; i < sizeof noise_kinds / sizeof *noise_kinds; i++)
    {
        check_noise(&noise_kinds[i]);
    }
}
END_TEST

/* A ball between the rays through pixels' middles, almost as far as distances repeat: all of it is what samples bring. */
START_TEST(what_one_frame_alone_sees_counts_in_full)
{
    const cm_primitive small = {.size = sizeof small,
                                .kind = CM_PRIMITIVE_SPHERE,
                                .first = {0.074, 0.074, 7.4},
                                .radius = 0.06,
                                .material = {{1, 1, 1}, 0.8}};
    stage at = make_stage(&small, 1);
    cm_budget_entry entry[CM_TOF_EFFECTS] = {{0}};
    cm_budget budget = {.size = sizeof budget, .entry = entry};
    cm_tof_options chosen = {.size = sizeof chosen};
    plan(&at, 1.0, &chosen, &budget);
    ck_assert_double_eq_tol(entry[0].contribution, 7.35, 0.05);
    ck_assert_int_eq(entry[0].is_kept, 1);
    free_stage(&at);
}
END_TEST

/* ---- scattered light ---- */

static const cm_primitive corner[3] = {{.size = sizeof *corner,
                                        .kind = CM_PRIMITIVE_PLANE,
                                        .first = {0, 0, 1.7},
                                        .second = {0, 0, 1},
                                        .material = {{1, 1, 1}, 0.6}},
                                       {.size = sizeof *corner,
                                        .kind = CM_PRIMITIVE_PLANE,
                                        .first = {0, 0.6, 0},
                                        .second = {0, 1, 0},
                                        .material = {{1, 1, 1}, 0.6}},
                                       {.size = sizeof *corner,
                                        .kind = CM_PRIMITIVE_PLANE,
                                        .first = {0.7, 0, 0},
                                        .second = {1, 0, 0},
                                        .material = {{1, 1, 1}, 0.6}}};

static void plan_most(const stage *at, double limit, const cm_tof_options *most, cm_pool *pool,
                      cm_tof_options *chosen, cm_budget *budget)
{
    ck_assert_int_eq(cm_tof_plan(at->scene, &at->sensor, &at->light, 1, NULL, 0.0, limit, most,
                                 pool, chosen, budget),
                     CM_OK);
}

/* Of two frames without noise, the root mean square of how far they are apart. */
static double apart_of(const stage *at, const cm_tof_options *one, const cm_tof_options *other)
{
    static float first[PIXELS];
    const cm_tof_options both[2] = {*one, *other};
    double squares = 0.0;
    for (int i = 0; i < 2; i++)
    {
        cm_tof_options options = both[i];
        options.noise = 0;
        options.sample_columns = options.sample_rows = 1;
        ck_assert_int_eq(simulate(at, &options), CM_OK);
        for (size_t k = 0; k < PIXELS; k++)
        {
            const double apart = (double)distance[k] - (double)first[k];
            squares += i == 1 ? apart * apart : 0.0;
            first[k] = distance[k];
        }
    }
    return sqrt(squares / PIXELS);
}

/* The spread that is told is that of frames of other seeds; given paths are not exceeded, and what is beyond has a name. */
START_TEST(spread_of_paths_is_that_of_frames)
{
    stage at = make_stage(corner, 3);
    cm_budget_entry entry[CM_TOF_EFFECTS] = {{0}};
    cm_budget budget = {.size = sizeof budget, .entry = entry};
    const cm_tof_options most = {.size = sizeof most, .bounces = 2, .paths = 16, .seed = 3};
    cm_tof_options chosen = {0};
    plan_most(&at, 1e-4, &most, NULL, &chosen, &budget);
    ck_assert(chosen.bounces == 2 && chosen.paths == 16);
    cm_tof_options other = chosen;
    other.seed = 77;
    const double measured = apart_of(&at, &chosen, &other) / sqrt(2.0);
    printf("16 paths: %.3f mm, %.3f mm planned\n", 1e3 * measured,
           1e3 * entry[SAMPLING].contribution);
    ck_assert_str_eq(entry[SAMPLING].name, "sampling of scattered light");
    ck_assert_str_eq(entry[SAMPLING].reason, "beyond the limit: no more samples than are given");
    ck_assert(!entry[SAMPLING].is_kept);
    REQUIRE(fabs(entry[SAMPLING].contribution - measured) < 0.15 * measured, "%g m, not %g",
            entry[SAMPLING].contribution, measured);
    /* what is dropped by the limit, too, is in the sum */
    double sum = 0.0;
    for (size_t i = 0; i < CM_TOF_EFFECTS; i++)
    {
        sum += entry[i].is_kept ? 0.0 : entry[i].contribution;
    }
    ck_assert_double_eq(budget.error, sum);
    ck_assert_double_gt(budget.error, 1e-4);
    free_stage(&at);
}
END_TEST

/* Where none are given they are as many as the limit needs: other seeds do not come out farther apart. */
START_TEST(paths_are_as_many_as_the_limit_needs)
{
    stage at = make_stage(corner, 3);
    cm_budget_entry entry[CM_TOF_EFFECTS] = {{0}};
    cm_budget budget = {.size = sizeof budget, .entry = entry};
    const cm_tof_options most = {.size = sizeof most, .bounces = 2};
    const double limit = 0.02;
    cm_tof_options chosen = {0};
    plan_most(&at, limit, &most, NULL, &chosen, &budget);
    ck_assert(chosen.bounces == 2 && chosen.paths > 64);
    ck_assert_str_eq(entry[SAMPLING].reason,
                     "the error is within the limit with the samples that are chosen");
    ck_assert_double_le(budget.error, limit + entry[BEYOND].contribution);
    cm_tof_options other = chosen;
    other.seed = 77;
    const double measured = apart_of(&at, &chosen, &other) / sqrt(2.0);
    printf("%u paths: %.3f mm\n", chosen.paths, 1e3 * measured);
    ck_assert_double_le(measured, limit);
    free_stage(&at);
}
END_TEST

/* Of a frame by virtual lights beside two by paths, whose own spread is taken off. */
static double error_beside_paths(const stage *at, const cm_tof_options *lights, uint32_t paths)
{
    cm_tof_options one = *lights, other = *lights;
    one.traces = other.traces = 1;
    one.paths = other.paths = paths;
    one.seed = 77;
    other.seed = 78;
    const double first = apart_of(at, lights, &one), second = apart_of(at, lights, &other);
    const double between = apart_of(at, &one, &other);
    return sqrt(fmax(0.0, 0.5 * (first * first + second * second - between * between)));
}

/* Virtual lights have no random numbers: their error is what paths say. */
START_TEST(error_of_lights_is_that_beside_paths)
{
    stage at = make_stage(corner, 3);
    cm_budget_entry entry[CM_TOF_EFFECTS] = {{0}};
    cm_budget budget = {.size = sizeof budget, .entry = entry};
    const cm_tof_options most = {.size = sizeof most, .bounces = 1, .lights = 40};
    cm_tof_options chosen = {0};
    plan_most(&at, 1e-5, &most, NULL, &chosen, &budget);
    ck_assert(chosen.bounces == 1 && chosen.lights == 40 && !chosen.traces);
    cm_tof_options paths = chosen;
    paths.traces = 1;
    paths.paths = 256;
    const double measured = apart_of(&at, &chosen, &paths);
    printf("40 lights: %.3f mm, %.3f mm planned\n", 1e3 * measured,
           1e3 * entry[SAMPLING].contribution);
    REQUIRE(fabs(entry[SAMPLING].contribution - measured) < 0.2 * measured, "%g m, not %g",
            entry[SAMPLING].contribution, measured);
    /* with none given there are more, and paths where even those are too few */
    const cm_tof_options any = {.size = sizeof any, .bounces = 1};
    plan_most(&at, 4e-3, &any, NULL, &chosen, &budget);
    ck_assert(chosen.bounces == 1 && (chosen.traces || chosen.lights > 338));
    ck_assert_double_le(entry[SAMPLING].contribution, 4e-3);
    const double error = error_beside_paths(&at, &chosen, 256);
    printf("%u lights: %.3f mm, %.3f mm planned\n", chosen.lights, 1e3 * error,
           1e3 * entry[SAMPLING].contribution);
    ck_assert_double_le(error, 4e-3);
    free_stage(&at);
}
END_TEST

/* Beside a ball a few pixels have most of the error, of which a small picture has few. */
START_TEST(error_of_lights_beside_a_ball_is_not_told_too_small)
{
    static const cm_primitive wall_and_ball[2] = {{.size = sizeof *wall_and_ball,
                                                   .kind = CM_PRIMITIVE_PLANE,
                                                   .first = {0, 0, 2},
                                                   .second = {0, 0, 1},
                                                   .material = {{1, 1, 1}, 0.3}},
                                                  {.size = sizeof *wall_and_ball,
                                                   .kind = CM_PRIMITIVE_SPHERE,
                                                   .first = {0, 0, 1.4},
                                                   .radius = 0.3,
                                                   .material = {{1, 1, 1}, 0.3}}};
    stage at = make_stage(wall_and_ball, 2);
    cm_budget_entry entry[CM_TOF_EFFECTS] = {{0}};
    cm_budget budget = {.size = sizeof budget, .entry = entry};
    const cm_tof_options most = {.size = sizeof most, .bounces = 1, .lights = 338};
    cm_tof_options chosen = {0};
    plan_most(&at, 4e-4, &most, NULL, &chosen, &budget);
    ck_assert(chosen.bounces == 1 && chosen.lights == 338 && !chosen.traces);
    const double error = error_beside_paths(&at, &chosen, is_quick() ? 512 : 2048);
    const double told = entry[SAMPLING].contribution;
    printf("beside a ball: %.3f mm, %.3f mm planned\n", 1e3 * error, 1e3 * told);
    REQUIRE(told > 0.95 * error, "%g m, not %g", told, error);
    free_stage(&at);
}
END_TEST

/* Bounces that are given are not exceeded; what more would do is told, and counts. */
START_TEST(bounces_are_not_more_than_given)
{
    stage at = make_stage(corner, 3);
    static const struct
    {
        int given, chosen;
    } cases[] = {{-1, 0}, {1, 1}, {2, 2}, {0, 4}, {5, 5}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
    {
        cm_budget_entry entry[CM_TOF_EFFECTS] = {{0}};
        cm_budget budget = {.size = sizeof budget, .entry = entry};
        const cm_tof_options most = {
            .size = sizeof most, .bounces = cases[i].given, .paths = 8, .lights = 20};
        cm_tof_options chosen = {0};
        plan_most(&at, 1e-4, &most, NULL, &chosen, &budget);
        REQUIRE(chosen.bounces == cases[i].chosen, "%d for %d", chosen.bounces, cases[i].given);
        const int dropped[] = {cases[i].given < 0, cases[i].given < 0,
                               cases[i].given < 0 || cases[i].given == 1, cases[i].given == 2};
        const int effects[] = {MULTIPATH, VISIBILITY, FURTHER, BEYOND};
        for (size_t k = 0; k < 4; k++)
        {
            const cm_budget_entry *of = &entry[effects[k]];
            const int is_dropped = strcmp(of->reason, "dropped: limit given") == 0;
            REQUIRE(is_dropped == (dropped[k] && of->contribution > 0.0), "%d: %s: %s",
                    cases[i].given, of->name, of->reason);
            ck_assert(!is_dropped || budget.error >= of->contribution);
        }
        ck_assert(!dropped[2] || entry[FURTHER].contribution > 1e-3);
        ck_assert(!dropped[3] || entry[BEYOND].contribution > 1e-3);
    }
    free_stage(&at);
}
END_TEST

/* What is told is what is done: paths have shadows, further bounces and shadows the first one; by whatever limit. */
START_TEST(what_comes_along_is_not_told_as_dropped)
{
    static const double limits[] = {0.3, 0.1, 0.06, 0.03, 0.02, 0.01};
    const cm_primitive room[4] = {corner[0], corner[1], corner[2], ball};
    stage at = make_stage(room, 4);
    int along = 0;
    for (size_t i = 0; i < sizeof limits / sizeof *limits; i++)
    {
        cm_budget_entry entry[CM_TOF_EFFECTS] = {{0}};
        cm_budget budget = {.size = sizeof budget, .entry = entry};
        const cm_tof_options most = {.size = sizeof most, .paths = 16};
        cm_tof_options chosen = {0};
        plan_most(&at, limits[i], &most, NULL, &chosen, &budget);
        const int by_paths = chosen.bounces > 1 || (chosen.bounces == 1 && chosen.traces);
        ck_assert(entry[MULTIPATH].contribution > 0.0 && entry[VISIBILITY].contribution > 0.0);
        ck_assert_int_eq(entry[FURTHER].is_kept, chosen.bounces > 1);
        ck_assert_int_eq(entry[MULTIPATH].is_kept, chosen.bounces > 0);
        ck_assert_int_eq(entry[VISIBILITY].is_kept, chosen.bounces > 0 && chosen.visibility);
        ck_assert(!by_paths || chosen.visibility);
        along += strcmp(entry[VISIBILITY].reason, "paths have it") == 0 ? 1 : 0;
    }
    ck_assert_int_gt(along, 0);
    free_stage(&at);
}
END_TEST

/* Neither threads nor clocks choose, also where some effects must go and others not. */
START_TEST(plans_have_one_answer)
{
    stage at = make_stage(corner, 3);
    cm_tof_options first = {0};
    cm_budget_entry before[CM_TOF_EFFECTS] = {{0}};
    for (unsigned threads = 1; threads <= 7; threads += threads == 1 ? 1 : 5)
    {
        cm_budget_entry entry[CM_TOF_EFFECTS] = {{0}};
        cm_budget budget = {.size = sizeof budget, .entry = entry};
        const cm_tof_options most = {.size = sizeof most, .sample_columns = 2, .sample_rows = 2};
        cm_tof_options chosen = {0};
        cm_pool *pool = NULL;
        ck_assert_int_eq(cm_pool_create(threads, &pool), CM_OK);
        plan_most(&at, 0.02, &most, pool, &chosen, &budget);
        cm_pool_destroy(pool);
        for (size_t i = 0; threads > 1 && i < CM_TOF_EFFECTS; i++)
        {
            ck_assert_double_eq(entry[i].contribution, before[i].contribution);
            ck_assert_int_eq(entry[i].is_kept, before[i].is_kept);
            ck_assert_str_eq(entry[i].reason, before[i].reason);
        }
        ck_assert(threads == 1 || memcmp(&chosen, &first, sizeof chosen) == 0);
        first = chosen;
        memcpy(before, entry, sizeof before);
    }
    free_stage(&at);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {clocks_decide_nothing,
                                  noise_is_that_of_frames,
                                  what_one_frame_alone_sees_counts_in_full,
                                  spread_of_paths_is_that_of_frames,
                                  paths_are_as_many_as_the_limit_needs,
                                  error_of_lights_is_that_beside_paths,
                                  error_of_lights_beside_a_ball_is_not_told_too_small,
                                  bounces_are_not_more_than_given,
                                  what_comes_along_is_not_told_as_dropped,
                                  plans_have_one_answer,
                                  NULL};
    return run_suite("plan", tests);
}
