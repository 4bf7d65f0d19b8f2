/* SPDX-License-Identifier: MIT
 *
 * Motion on a trajectory: through its poses, with the derivatives that it says; and what sensors on it measure.
 */
#include "curved_trajectory.h"

static void acceleration_at(double t, double acceleration[3])
{
    acceleration[0] = -0.98 * cos(0.7 * t);
    acceleration[1] = -0.735 * sin(0.7 * t);
    acceleration[2] = -0.507 * sin(1.3 * t);
}

/* ---- Motion ---- */

static cm_motion *make_motion(const cm_trajectory *of)
{
    cm_motion *made = NULL;
    ck_assert_int_eq(cm_motion_create(of, &made), CM_OK);
    return made;
}

/* The angular velocity by differences of poses. */
static void rate_by_difference(const cm_motion *motion, double time, double rate[3])
{
    const double step = 1e-4;
    cm_motion_state before = {.size = sizeof before};
    cm_motion_state after = {.size = sizeof after};
    double twist[6];
    cm_pose between;
    ck_assert_int_eq(cm_motion_at(motion, time - step, &before), CM_OK);
    ck_assert_int_eq(cm_motion_at(motion, time + step, &after), CM_OK);
    cm_pose_between(&before.pose, &after.pose, &between);
    cm_pose_log(&between, twist);
    for (int i = 0; i < 3; i++)
    {
        rate[i] = twist[3 + i] / (2.0 * step);
    }
}

START_TEST(motion_through_poses)
{
    fill(50.0, 0.05);
    cm_trajectory *of = make(COUNT, stamps, poses);
    cm_motion *motion = make_motion(of);
    cm_motion_state state = {.size = sizeof state};
    for (int i = 0; i < COUNT; i++)
    {
        double expected[3];
        ck_assert_int_eq(cm_motion_at(motion, stamps[i], &state), CM_OK);
        REQUIRE(apart(&state.pose, &poses[i]) <= 4e-15, "knot %d: %g", i,
                apart(&state.pose, &poses[i]));
        acceleration_at(stamps[i] - 50.0, expected);
        for (int k = 0; k < 3; k++)
        {
            REQUIRE(fabs(state.acceleration[k] - expected[k]) <= 2e-3, "knot %d: %g, not %g", i,
                    state.acceleration[k], expected[k]);
        }
    }
    for (double t = 50.01; t < 59.9; t += 0.0371)
    {
        double rate[3];
        double place[3];
        ck_assert_int_eq(cm_motion_at(motion, t, &state), CM_OK);
        rate_by_difference(motion, t, rate);
        place_at(t - 50.0, place);
        for (int k = 0; k < 3; k++)
        {
            REQUIRE(fabs(state.rate[k] - rate[k]) <= 1e-7, "%g: %g, not %g", t, state.rate[k],
                    rate[k]);
            REQUIRE(fabs(state.pose.position[k] - place[k]) <= 3e-6, "%g: %g", t,
                    state.pose.position[k] - place[k]);
        }
        ck_assert_int_eq(cm_pose_check(&state.pose), CM_OK);
    }
    ck_assert_int_eq(cm_motion_at(motion, 49.9, &state), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_motion_at(motion, (double)NAN, &state), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_motion_at(NULL, 50.0, &state), CM_ERROR_ARGUMENT);
    state.size = 1;
    ck_assert_int_eq(cm_motion_at(motion, 50.0, &state), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_motion_create(NULL, &motion), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_motion_create(of, NULL), CM_ERROR_ARGUMENT);
    cm_motion_destroy(motion);
    cm_motion_destroy(NULL);
    cm_trajectory_destroy(of);
}
END_TEST

/* One pose, two and three. */
START_TEST(short_motions)
{
    fill(0.0, 0.5);
    for (size_t n = 1; n <= 4; n++)
    {
        cm_trajectory *of = make(n, stamps, poses);
        cm_motion *motion = make_motion(of);
        cm_motion_state state = {.size = sizeof state};
        for (size_t i = 0; i < n; i++)
        {
            ck_assert_int_eq(cm_motion_at(motion, stamps[i], &state), CM_OK);
            ck_assert(apart(&state.pose, &poses[i]) <= 4e-15);
        }
        cm_motion_destroy(motion);
        cm_trajectory_destroy(of);
    }
}
END_TEST

/* ---- Sensors ---- */

enum
{
    SAMPLES = 19901 /* 9.95 s at 2000 Hz */
};

static double sample_stamps[SAMPLES];
static double accelerations[3 * SAMPLES];
static double rates[3 * SAMPLES];

static size_t sense(const cm_motion *motion, const cm_inertial_options *options)
{
    size_t count = 0;
    ck_assert_int_eq(
        cm_motion_inertial(motion, options, SAMPLES, sample_stamps, accelerations, rates, &count),
        CM_OK);
    return count;
}

/* Without noise what the sensors say leads through the trajectory again: turned by the rates, acceleration and gravity
 * summed up twice. */
START_TEST(sensors_bring_back_the_trajectory)
{
    fill(50.0, 0.05);
    cm_trajectory *of = make(COUNT, stamps, poses);
    cm_motion *motion = make_motion(of);
    const cm_inertial_options options = {
        .size = sizeof options, .rate = 2000.0, .latency = 0.25, .gravity = {0.0, 0.0, -9.81}};
    const size_t count = sense(motion, &options);
    ck_assert_uint_ge(count, SAMPLES - 1);
    cm_motion_state state = {.size = sizeof state};
    ck_assert_int_eq(cm_motion_at(motion, 50.0, &state), CM_OK);
    cm_pose pose = state.pose;
    double velocity[3];
    double worst = 0.0;
    memcpy(velocity, state.velocity, sizeof velocity);
    ck_assert(fabs(sample_stamps[0] - 50.25) <= 1e-12);
    for (size_t i = 0; i + 1 < count; i++)
    {
        const double h = sample_stamps[i + 1] - sample_stamps[i];
        double twist[6] = {0.0};
        double before[3];
        double after[3];
        cm_pose turn;
        cm_rotate_back(&pose.rotation, &accelerations[3 * i], before);
        for (size_t k = 0; k < 3; k++)
        {
            twist[3 + k] = 0.5 * h * (rates[3 * i + k] + rates[3 * i + 3 + k]);
        }
        cm_pose_exp(twist, &turn);
        cm_pose_compose(&pose, &turn, &pose);
        cm_rotate_back(&pose.rotation, &accelerations[3 * i + 3], after);
        for (int k = 0; k < 3; k++)
        {
            const double first = before[k] + options.gravity[k];
            const double second = after[k] + options.gravity[k];
            pose.position[k] += h * velocity[k] + h * h * (first / 3.0 + second / 6.0);
            velocity[k] += 0.5 * h * (first + second);
        }
        ck_assert_int_eq(cm_motion_at(motion, fmin(sample_stamps[i + 1] - 0.25, 59.95), &state),
                         CM_OK);
        worst = fmax(worst, apart(&state.pose, &pose));
    }
    REQUIRE(worst <= 2e-5, "%g", worst);
    cm_motion_destroy(motion);
    cm_trajectory_destroy(of);
}
END_TEST

/* At rest: the mean is the bias against gravity, the deviation that of the density, and a bias walks as it should. */
START_TEST(noise_of_sensors)
{
    fill(0.0, 0.05);
    for (int i = 0; i < COUNT; i++)
    {
        poses[i] = poses[0];
    }
    cm_trajectory *of = make(COUNT, stamps, poses);
    cm_motion *motion = make_motion(of);
    cm_inertial_options options = {.size = sizeof options,
                                   .rate = 2000.0,
                                   .gravity = {0.0, 0.0, -9.81},
                                   .accelerometer = {.density = 0.01, .bias = {0.1, 0.2, 0.3}},
                                   .gyroscope = {.density = 0.002, .bias = {0.01, 0.0, 0.0}},
                                   .seed = 4};
    const size_t count = sense(motion, &options);
    const double expected[3] = {0.1, 0.2, 0.3 + 9.81};
    for (size_t k = 0; k < 3; k++)
    {
        double sum = 0.0;
        double squares = 0.0;
        for (size_t i = 0; i < count; i++)
        {
            const double off = accelerations[3 * i + k] - expected[k];
            sum += off;
            squares += off * off;
        }
        const double deviation = 0.01 * sqrt(2000.0);
        REQUIRE(fabs(sum / (double)count) <= 4.5 * deviation / sqrt((double)count), "mean %g",
                sum / (double)count);
        REQUIRE(fabs(squares / (double)count / (deviation * deviation) - 1.0) <= 0.05, "%g",
                sqrt(squares / (double)count));
    }
    options.accelerometer.density = 0.0;
    options.accelerometer.walk = 0.5;
    double squares = 0.0;
    for (options.seed = 0; options.seed < 200; options.seed++) /* the bias at the end */
    {
        options.rate = 100.0;
        const size_t last = sense(motion, &options) - 1;
        const double off = accelerations[3 * last] - 0.1;
        squares += off * off / (0.25 * stamps[COUNT - 1]);
    }
    REQUIRE(fabs(squares / 200.0 - 1.0) <= 4.5 * sqrt(2.0 / 200.0), "%g", squares / 200.0);
    cm_motion_destroy(motion);
    cm_trajectory_destroy(of);
}
END_TEST

START_TEST(sensors_that_are_none)
{
    fill(0.0, 0.05);
    cm_trajectory *of = make(COUNT, stamps, poses);
    cm_motion *motion = make_motion(of);
    const cm_inertial_options good = {.size = sizeof good, .rate = 10.0};
    size_t count = 7;
    ck_assert_int_eq(cm_motion_inertial(motion, &good, 0, NULL, NULL, NULL, &count),
                     CM_ERROR_SPACE);
    ck_assert_uint_eq(count, 100);
    ck_assert_int_eq(cm_motion_inertial(motion, &good, 5, NULL, NULL, NULL, &count),
                     CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_motion_inertial(NULL, &good, 0, NULL, NULL, NULL, &count),
                     CM_ERROR_ARGUMENT);
    for (int i = 0; i < 8; i++)
    {
        cm_inertial_options bad = good;
        double *const fault[] = {&bad.rate,
                                 &bad.rate,
                                 &bad.latency,
                                 &bad.gravity[1],
                                 &bad.accelerometer.density,
                                 &bad.gyroscope.walk,
                                 &bad.gyroscope.bias[2],
                                 &bad.rate};
        const double value[] = {0.0,   -1.0,        (double)NAN,      (double)INFINITY,
                                -1e-9, (double)NAN, (double)INFINITY, 1e12};
        *fault[i] = value[i];
        count = 7;
        ck_assert_int_eq(cm_motion_inertial(motion, &bad, 0, NULL, NULL, NULL, &count),
                         CM_ERROR_RANGE);
        ck_assert_uint_eq(count, 7);
    }
    cm_motion_destroy(motion);
    cm_trajectory_destroy(of);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        motion_through_poses, short_motions,         sensors_bring_back_the_trajectory,
        noise_of_sensors,     sensors_that_are_none, NULL};
    return run_suite("motion", tests);
}
