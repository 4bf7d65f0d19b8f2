/* SPDX-License-Identifier: MIT
 *
 * Into how many steps an exposure is divided: as many as the motion in any of a frame's exposures needs, wherever and however
 * something moves.
 */
#include "tof_stage.h"

/* Positions at times, without turning. */
static cm_trajectory *make_motion(size_t n, const double *stamp, const double (*place)[3])
{
    const double turn[4] = {0, 0, 0, 1};
    cm_pose key[8];
    for (size_t i = 0; i < n; i++)
    {
        ck_assert_int_eq(cm_pose_from_quaternion(place[i], turn, &key[i]), CM_OK);
    }
    cm_trajectory *made = NULL;
    ck_assert_int_eq(cm_trajectory_create(n, stamp, key, &made, NULL), CM_OK);
    return made;
}

static cm_primitive ball(double x, double z, double radius, const cm_trajectory *motion)
{
    const cm_primitive made = {.size = sizeof made,
                               .kind = CM_PRIMITIVE_SPHERE,
                               .first = {x, 0, z},
                               .radius = radius,
                               .material = {{1, 1, 1}, 0.8},
                               .motion = motion};
    return made;
}

/* Before the wall, with exposures of 1 ms every 2 ms: how many steps are chosen. Charges are those of as many by hand. */
static uint32_t steps_of(const cm_primitive *moving)
{
    static float chosen[PHASES * PIXELS];
    const cm_primitive both[2] = {wall, *moving};
    stage at = make_stage(both, 2);
    at.sensor.exposure = at.sensor.readout = 1e-3;
    cm_tof_report report = {.size = sizeof report};
    cm_tof_result result = {.size = sizeof result, .phase = chosen, .report = &report};
    ck_assert_int_eq(
        cm_tof_simulate(at.scene, &at.sensor, &at.light, 1, NULL, 0.0, NULL, NULL, &result), CM_OK);
    const cm_tof_options options = {.size = sizeof options, .sample_times = report.times};
    ck_assert_int_eq(simulate(&at, &options), CM_OK);
    ck_assert_mem_eq(chosen, phase, sizeof chosen);
    free_stage(&at);
    return report.times;
}

/* A ball that goes along a trajectory. */
static uint32_t steps_of_ball(double x, double z, double radius, size_t n, const double *stamp,
                              const double (*place)[3])
{
    cm_trajectory *motion = make_motion(n, stamp, place);
    const cm_primitive moving = ball(x, z, radius, motion);
    const uint32_t steps = steps_of(&moving);
    cm_trajectory_destroy(motion);
    return steps;
}

/* A ball that stands in the first exposure and in the third one moves by 16 of its pixels. */
START_TEST(what_begins_to_move_later_counts)
{
    const double stamp[3] = {0.0, 4e-3, 5e-3};
    const double place[3][3] = {{0, 0, 0}, {0, 0, 0}, {0.32, 0, 0}};
    ck_assert_uint_eq(steps_of_ball(-0.2, 1.2, 0.2, 3, stamp, place), 16);
}
END_TEST

/* One that comes into the picture while the exposure lasts. */
START_TEST(what_comes_in_counts)
{
    const double stamp[2] = {0.0, 1e-3};
    const double place[2][3] = {{0, 0, 0}, {1.5, 0, 0}};
    ck_assert_uint_eq(steps_of_ball(-1.5, 1.2, 0.2, 2, stamp, place), 16);
}
END_TEST

/* One of two pixels that moves by five. */
START_TEST(small_things_count)
{
    const double stamp[2] = {0.0, 1e-3};
    const double place[2][3] = {{0, 0, 0}, {0.1, 0, 0}};
    const uint32_t steps = steps_of_ball(0.01, 1.0, 0.02, 2, stamp, place);
    ck_assert_uint_ge(steps, 5);
    ck_assert_uint_le(steps, 6);
}
END_TEST

/* What is beyond the picture's edges may move as it likes. */
START_TEST(what_is_not_seen_does_not_count)
{
    const double stamp[2] = {0.0, 1e-3};
    const double place[2][3] = {{0, 0, 0}, {0, 0, 0.5}};
    ck_assert_uint_eq(steps_of_ball(-4.0, 1.0, 0.02, 2, stamp, place), 1);
}
END_TEST

/* Of something flat that moves to and fro charges are the mean of a thousand moments', though it moves across no pixel. */
static void compare_with_many(size_t n, const double *stamp, const double (*place)[3], float bound)
{
    cm_trajectory *motion = make_motion(n, stamp, place);
    cm_primitive moving = wall;
    moving.motion = motion;
    stage at = make_stage(&moving, 1);
    at.sensor.exposure = 5e-3;
    ck_assert_int_eq(simulate(&at, NULL), CM_OK);
    const size_t middle = 24 * WIDTH + 32;
    const float electrons = intensity[middle];
    float chosen[PHASES];
    for (size_t k = 0; k < PHASES; k++)
    {
        chosen[k] = phase[k * PIXELS + middle];
    }
    const cm_tof_options options = {.size = sizeof options, .sample_times = 1000};
    ck_assert_int_eq(simulate(&at, &options), CM_OK);
    for (size_t k = 0; k < PHASES; k++)
    {
        ck_assert_float_eq_tol(chosen[k], phase[k * PIXELS + middle], bound * electrons);
    }
    free_stage(&at);
    cm_trajectory_destroy(motion);
}

START_TEST(what_comes_nearer_counts)
{
    const double stamp[2] = {0.0, 1.0};
    const double place[2][3] = {{0, 0, 0}, {0, 0, -60}};
    compare_with_many(2, stamp, place, 3e-4f);
}
END_TEST

/* It is back where it was when an exposure ends; or stops in the middle of one. */
START_TEST(what_bends_within_an_exposure_counts)
{
    const double swing[5] = {0.0, 2.5e-3, 5e-3, 7.5e-3, 10e-3};
    const double swung[5][3] = {{0, 0, 0}, {0, 0, 0.04}, {0, 0, 0}, {0, 0, 0.04}, {0, 0, 0}};
    const double stop[2] = {0.0, 7e-3};
    const double stopped[2][3] = {{0, 0, 0}, {0, 0, 0.02}};
    compare_with_many(5, swing, swung, 2e-4f);
    compare_with_many(2, stop, stopped, 2e-4f);
}
END_TEST

enum
{
    MOMENTS = 7,
    IMAGES = 10 /* two series of five */
};

static float whole_a[IMAGES * PIXELS], whole_b[IMAGES * PIXELS], moment_a[IMAGES * PIXELS],
    moment_b[IMAGES * PIXELS];

/* Means of charges of an image, over frames of a picosecond, each as bright as the whole exposure. */
static void take_means(const stage *at, const cm_trajectory *path, size_t image, double *mean_a,
                       double *mean_b)
{
    const cm_tof_options options = {.size = sizeof options,
                                    .sample_times = 1,
                                    .sample_columns = 3,
                                    .sample_rows = 2,
                                    .full = 1};
    cm_tof_result result = {.size = sizeof result, .charge_a = moment_a, .charge_b = moment_b};
    cm_tof_sensor moment = at->sensor;
    cm_tof_light flash = at->light;
    moment.exposure = 1e-12;
    moment.readout = 0.0;
    flash.power *= at->sensor.exposure / moment.exposure;
    memset(mean_a, 0, PIXELS * sizeof *mean_a);
    memset(mean_b, 0, PIXELS * sizeof *mean_b);
    for (int k = 0; k < MOMENTS; k++)
    {
        const double time = (double)image * (at->sensor.exposure + at->sensor.readout) +
                            (k + 0.5) / MOMENTS * at->sensor.exposure;
        ck_assert_int_eq(
            cm_tof_simulate(at->scene, &moment, &flash, 1, path, time, &options, NULL, &result),
            CM_OK);
        for (size_t i = 0; i < PIXELS; i++)
        {
            mean_a[i] += (double)moment_a[image * PIXELS + i] / MOMENTS;
            mean_b[i] += (double)moment_b[image * PIXELS + i] / MOMENTS;
        }
    }
}

static void compare_means(const stage *at, const cm_trajectory *path)
{
    static double mean_a[PIXELS], mean_b[PIXELS];
    const cm_tof_options options = {.size = sizeof options,
                                    .sample_times = MOMENTS,
                                    .sample_columns = 3,
                                    .sample_rows = 2,
                                    .full = 1};
    cm_tof_result result = {.size = sizeof result, .charge_a = whole_a, .charge_b = whole_b};
    ck_assert_int_eq(
        cm_tof_simulate(at->scene, &at->sensor, &at->light, 1, path, 0.0, &options, NULL, &result),
        CM_OK);
    for (size_t image = 0; image < IMAGES; image += step_of(3))
    {
        take_means(at, path, image, mean_a, mean_b);
        for (size_t i = 0; i < PIXELS; i++)
        {
            const double a = (double)whole_a[image * PIXELS + i];
            const double b = (double)whole_b[image * PIXELS + i];
            REQUIRE(fabs(a - mean_a[i]) < 1e-4 * (a + b) && fabs(b - mean_b[i]) < 1e-4 * (a + b),
                    "layout %d, image %zu, pixel %zu: %g and %g, not %g and %g",
                    at->sensor.single_readout, image, i, a, b, mean_a[i], mean_b[i]);
        }
    }
}

/* A camera that turns while it goes, a ball that crosses. In both layouts, with a mask, harmonics and two frequencies. */
START_TEST(charges_are_means_of_moments)
{
    static const float mask[6] = {0.9f, 0.0f, 1.0f, 0.3f, 0.7f, 0.2f};
    static const double harmonic[3] = {0.9, 0.05, 0.11};
    const double stamp[2] = {0.0, 0.05};
    const double place[2][3] = {{0, 0, 0}, {0.4, 0.1, 0.2}};
    const double turn[2][4] = {{0, 0, 0, 1}, {0.06, -0.1, 0.15, 0.98178409}};
    cm_pose key[2];
    cm_trajectory *path = NULL, *motion = make_motion(2, stamp, place);
    for (int i = 0; i < 2; i++)
    {
        ck_assert_int_eq(cm_pose_from_quaternion(place[i], turn[i], &key[i]), CM_OK);
    }
    ck_assert_int_eq(cm_trajectory_create(2, stamp, key, &path, NULL), CM_OK);
    const cm_primitive both[2] = {wall, ball(-0.2, 1.1, 0.2, motion)};
    for (int single = 0; single < 2; single++)
    {
        stage at = make_stage(both, 2);
        at.sensor.exposure = 4e-3;
        at.sensor.readout = 1e-3;
        at.sensor.phases = IMAGES / 2;
        at.sensor.second_frequency = 17e6;
        at.sensor.harmonics = 3;
        at.sensor.harmonic = harmonic;
        at.sensor.mask = mask;
        at.sensor.mask_columns = 3;
        at.sensor.mask_rows = 2;
        at.sensor.single_readout = single;
        at.light.position[0] = 0.04;
        compare_means(&at, path);
        free_stage(&at);
    }
    cm_trajectory_destroy(path);
    cm_trajectory_destroy(motion);
}
END_TEST

/* How far scattered light moves distances does not depend on whether anything moves: of two frequencies it is that of the
 * first. Here the camera moves by a millionth of a pixel. */
START_TEST(multipath_is_flagged_by_the_first_frequency)
{
    static uint8_t still[PIXELS];
    const double stamp[2] = {0.0, 1.0};
    const double place[2][3] = {{0, 0, 0}, {1e-7, 0, 0}};
    cm_trajectory *path = make_motion(2, stamp, place);
    cm_primitive both[2] = {wall, wall};
    both[1].material.reflectance = 0.02;
    both[1].first[0] = 2.5;
    both[1].second[0] = 1.0;
    both[1].second[2] = 0.0;
    stage at = make_stage(both, 2);
    at.sensor.second_frequency = 100e6;
    const cm_tof_options options = {.size = sizeof options, .bounces = 1};
    cm_tof_result result = {.size = sizeof result, .flags = still};
    ck_assert_int_eq(
        cm_tof_simulate(at.scene, &at.sensor, &at.light, 1, NULL, 0.0, &options, NULL, &result),
        CM_OK);
    result.flags = flags;
    ck_assert_int_eq(
        cm_tof_simulate(at.scene, &at.sensor, &at.light, 1, path, 0.0, &options, NULL, &result),
        CM_OK);
    size_t flagged = 0, other = 0;
    for (size_t i = 0; i < PIXELS; i++)
    {
        flagged += still[i] & CM_TOF_MULTIPATH ? 1 : 0;
        other += ((still[i] ^ flags[i]) & CM_TOF_MULTIPATH) != 0 ? 1 : 0;
    }
    REQUIRE(flagged > 100 && flagged < PIXELS - 100, "%zu pixels are flagged", flagged);
    REQUIRE(other < 10, "%zu pixels are flagged otherwise while something moves", other);
    free_stage(&at);
    cm_trajectory_destroy(path);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {what_begins_to_move_later_counts,
                                  what_comes_in_counts,
                                  small_things_count,
                                  what_is_not_seen_does_not_count,
                                  what_comes_nearer_counts,
                                  what_bends_within_an_exposure_counts,
                                  charges_are_means_of_moments,
                                  multipath_is_flagged_by_the_first_frequency,
                                  NULL};
    return run_suite("exposure steps", tests);
}
