/* SPDX-License-Identifier: MIT
 *
 * Trajectories: what is none, poses near and between, association, alignment, errors that are known, motion, and sensors on
 * it. Errors beside those of another program: check_trajectory_errors.py.
 */
#include <cubemap/trajectory.h>

#include <float.h>

#include "tests/suite.h"

enum
{
    COUNT = 200
};

static double stamps[COUNT];
static cm_pose poses[COUNT];

/* A curve with known derivatives, turning about a fixed axis. */
static void place_at(double t, double place[3])
{
    place[0] = 2.0 * cos(0.7 * t);
    place[1] = 1.5 * sin(0.7 * t);
    place[2] = 0.3 * sin(1.3 * t);
}

static void acceleration_at(double t, double acceleration[3])
{
    acceleration[0] = -0.98 * cos(0.7 * t);
    acceleration[1] = -0.735 * sin(0.7 * t);
    acceleration[2] = -0.507 * sin(1.3 * t);
}

static void fill(double begin, double step)
{
    for (int i = 0; i < COUNT; i++)
    {
        const double t = step * i;
        double twist[6] = {0.0, 0.0, 0.0, 0.3 * sin(t), 0.6 * sin(t), -0.2 * sin(t)};
        cm_pose_exp(twist, &poses[i]);
        place_at(t, poses[i].position);
        stamps[i] = begin + t;
    }
}

static cm_trajectory *make(size_t n, const double *stamp, const cm_pose *pose)
{
    cm_trajectory *made = NULL;
    ck_assert_int_eq(cm_trajectory_create(n, stamp, pose, &made, NULL), CM_OK);
    return made;
}

START_TEST(what_is_no_trajectory)
{
    cm_trajectory *made = NULL;
    size_t wrong = 7;
    fill(1.3e9, 0.05);
    ck_assert_int_eq(cm_trajectory_create(0, stamps, poses, &made, &wrong), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_trajectory_create(3, NULL, poses, &made, &wrong), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_trajectory_create(3, stamps, NULL, &made, &wrong), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_trajectory_create(3, stamps, poses, NULL, &wrong), CM_ERROR_ARGUMENT);
    ck_assert_uint_eq(wrong, 7);
    const double bad[] = {stamps[9], stamps[8], (double)NAN, (double)INFINITY};
    for (size_t i = 0; i < 4; i++)
    {
        fill(1.3e9, 0.05);
        stamps[10] = bad[i];
        ck_assert_int_eq(cm_trajectory_create(COUNT, stamps, poses, &made, &wrong), CM_ERROR_DATA);
        ck_assert_uint_eq(wrong, 10);
        ck_assert_int_eq(cm_trajectory_create(COUNT, stamps, poses, &made, NULL), CM_ERROR_DATA);
    }
    fill(1.3e9, 0.05);
    poses[11].rotation.row[2][1] = (double)NAN;
    ck_assert_int_eq(cm_trajectory_create(COUNT, stamps, poses, &made, &wrong), CM_ERROR_CAMERA);
    ck_assert_uint_eq(wrong, 11);
    ck_assert_ptr_null(made);
    cm_trajectory_destroy(NULL);
}
END_TEST

static double apart(const cm_pose *a, const cm_pose *b)
{
    double worst = 0.0;
    for (int i = 0; i < 9; i++)
    {
        worst = fmax(worst, fabs(a->rotation.row[i / 3][i % 3] - b->rotation.row[i / 3][i % 3]));
        worst = fmax(worst, fabs(a->position[i / 3] - b->position[i / 3]));
    }
    return worst;
}

START_TEST(near_and_between)
{
    fill(0.0, 0.25);
    cm_trajectory *made = make(COUNT, stamps, poses);
    size_t index = 99;
    double stamp;
    cm_pose pose;
    cm_pose expected;
    ck_assert_uint_eq(cm_trajectory_count(made), COUNT);
    ck_assert_uint_eq(cm_trajectory_count(NULL), 0);
    ck_assert_int_eq(cm_trajectory_at(made, 5, &stamp, &pose), CM_OK);
    ck_assert(stamp == 1.25 && apart(&pose, &poses[5]) == 0.0);
    ck_assert_int_eq(cm_trajectory_at(made, COUNT, NULL, NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_trajectory_nearest(made, 1.25 - 0.0625, 0.1, &index), CM_OK);
    ck_assert_uint_eq(index, 5);
    ck_assert_int_eq(cm_trajectory_nearest(made, 1.125, 0.125, &index), CM_OK);
    ck_assert_uint_eq(index, 4); /* as near to both */
    ck_assert_int_eq(cm_trajectory_nearest(made, 1.125, 0.12, &index), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_trajectory_nearest(made, -0.02, 0.02, &index), CM_OK);
    ck_assert_uint_eq(index, 0);
    ck_assert_int_eq(cm_trajectory_nearest(made, 49.77, 0.02 + 1e-9, &index), CM_OK);
    ck_assert_uint_eq(index, COUNT - 1);
    ck_assert_int_eq(cm_trajectory_nearest(made, (double)NAN, 1e9, &index), CM_ERROR_RANGE);
    for (int i = 0; i < COUNT; i++)
    {
        ck_assert_int_eq(cm_trajectory_interpolate(made, stamps[i], &pose), CM_OK);
        ck_assert(apart(&pose, &poses[i]) == 0.0);
    }
    ck_assert_int_eq(cm_trajectory_interpolate(made, 2.5625, &pose), CM_OK);
    cm_pose_interpolate(&poses[10], &poses[11], 0.25, &expected);
    ck_assert(apart(&pose, &expected) <= 1e-15);
    const double outside[] = {-1e-9, 50.0, (double)NAN};
    for (int i = 0; i < 3; i++)
    {
        ck_assert_int_eq(cm_trajectory_interpolate(made, outside[i], &pose), CM_ERROR_RANGE);
    }
    ck_assert(apart(&pose, &expected) <= 1e-15);
    cm_trajectory_destroy(made);
}
END_TEST

/* ---- Association ---- */

static size_t associate(size_t n, const double *a, size_t m, const double *b, double most,
                        size_t *index_a, size_t *index_b)
{
    cm_trajectory *first = make(n, a, poses);
    cm_trajectory *second = make(m, b, poses);
    size_t count = 99;
    ck_assert_int_eq(cm_trajectory_associate(first, second, most, COUNT, index_a, index_b, &count),
                     CM_OK);
    cm_trajectory_destroy(first);
    cm_trajectory_destroy(second);
    return count;
}

/* All pairs, the least difference first: the definition itself. */
static size_t associate_slowly(size_t n, const double *a, size_t m, const double *b, double most,
                               size_t *partner)
{
    int is_taken[COUNT] = {0};
    size_t count = 0;
    for (size_t i = 0; i < n; i++)
    {
        partner[i] = SIZE_MAX;
    }
    for (;;)
    {
        double best = (double)INFINITY;
        size_t at[2] = {0, 0};
        for (size_t i = 0; i < n; i++)
        {
            for (size_t k = 0; k < m; k++)
            {
                const double off = fabs(a[i] - b[k]);
                if (partner[i] == SIZE_MAX && !is_taken[k] && off <= most && off < best)
                {
                    best = off;
                    at[0] = i;
                    at[1] = k;
                }
            }
        }
        if (best > most)
        {
            return count;
        }
        partner[at[0]] = at[1];
        is_taken[at[1]] = 1;
        count++;
    }
}

START_TEST(closest_pairs_first)
{
    fill(0.0, 0.05);
    size_t index_a[COUNT];
    size_t index_b[COUNT];
    /* 1.01 is closer to 1.012 than 1 is, and then 1 goes to what is left within reach */
    const double a[] = {1.0, 1.01, 2.0};
    const double b[] = {0.985, 1.012, 2.021};
    ck_assert_uint_eq(associate(3, a, 3, b, 0.02, index_a, index_b), 2);
    ck_assert(index_a[0] == 0 && index_b[0] == 0 && index_a[1] == 1 && index_b[1] == 1);
    for (unsigned seed = 0; seed < 60; seed++)
    {
        double first[COUNT];
        double second[COUNT];
        size_t partner[COUNT];
        const size_t n = 1 + seed * 7 % 60;
        const size_t m = 1 + seed * 13 % 60;
        unsigned state = seed;
        for (size_t i = 0; i < 60; i++) /* whole numbers, so that many are as close as others */
        {
            state = state * 1664525 + 1013904223;
            first[i] = (i == 0 ? 0.0 : first[i - 1]) + 1.0 + (double)(state >> 24) / 64.0;
            state = state * 1664525 + 1013904223;
            second[i] = (i == 0 ? 0.0 : second[i - 1]) + 1.0 + (double)(state >> 30);
        }
        const size_t count = associate(n, first, m, second, 3.0, index_a, index_b);
        ck_assert_uint_eq(count, associate_slowly(n, first, m, second, 3.0, partner));
        for (size_t i = 0; i < count; i++)
        {
            REQUIRE(partner[index_a[i]] == index_b[i], "seed %u, %zu: %zu, not %zu", seed,
                    index_a[i], index_b[i], partner[index_a[i]]);
            ck_assert(i == 0 || index_a[i] > index_a[i - 1]);
        }
    }
}
END_TEST

START_TEST(room_for_pairs)
{
    fill(0.0, 0.05);
    cm_trajectory *made = make(COUNT, stamps, poses);
    size_t index[2] = {77, 77};
    size_t count = 0;
    ck_assert_int_eq(cm_trajectory_associate(made, made, 0.0, 0, NULL, NULL, &count),
                     CM_ERROR_SPACE);
    ck_assert_uint_eq(count, COUNT);
    count = 1;
    ck_assert_int_eq(cm_trajectory_associate(made, made, 0.0, 2, index, index, &count),
                     CM_ERROR_SPACE);
    ck_assert(count == COUNT && index[0] == 77);
    ck_assert_int_eq(cm_trajectory_associate(made, made, -1.0, 2, index, index, &count),
                     CM_ERROR_RANGE);
    ck_assert_int_eq(cm_trajectory_associate(made, made, (double)NAN, 2, index, index, &count),
                     CM_ERROR_RANGE);
    ck_assert_int_eq(cm_trajectory_associate(made, NULL, 0.0, 2, index, index, &count),
                     CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_trajectory_associate(made, made, 0.0, 2, NULL, index, &count),
                     CM_ERROR_ARGUMENT);
    cm_trajectory_destroy(made);
}
END_TEST

/* ---- Alignment and errors ---- */

START_TEST(alignment_and_its_rank)
{
    static const double points[] = {1, 2, 3, -4, 5, 1, 0, 2, 2, 7, -1, 0, 3, 3, 3};
    const double twist[6] = {1.0, -2.0, 30.0, 0.4, -1.1, 2.0};
    double to[15];
    cm_pose motion;
    cm_pose found;
    int rank = -1;
    int is_determined = -1;
    cm_pose_exp(twist, &motion);
    for (int i = 0; i < 15; i += 3)
    {
        cm_pose_apply_back(&motion, &points[i], &to[i]);
    }
    ck_assert_int_eq(cm_pose_align(5, points, to, &found, &rank, &is_determined), CM_OK);
    REQUIRE(apart(&motion, &found) <= 2e-14, "%g", apart(&motion, &found));
    ck_assert(rank == 3 && is_determined == 1);
    ck_assert_int_eq(cm_pose_align(3, points, to, &found, &rank, &is_determined), CM_OK);
    REQUIRE(apart(&motion, &found) <= 2e-14, "%g", apart(&motion, &found));
    ck_assert(rank == 2 && is_determined == 1);
    ck_assert_int_eq(cm_pose_align(2, points, to, &found, &rank, &is_determined), CM_OK);
    ck_assert(rank == 1 && is_determined == 0);
    ck_assert_int_eq(cm_pose_align(1, points, to, &found, &rank, &is_determined), CM_OK);
    ck_assert(rank == 0 && is_determined == 0);
    double moved[3];
    cm_pose_apply_back(&found, points, moved);
    ck_assert(hypot(moved[0] - to[0], hypot(moved[1] - to[1], moved[2] - to[2])) <= 1e-14);
    /* on a line that no axis is on, far away: what rounding makes of it is no plane */
    double line[30];
    for (int i = 0; i < 10; i++)
    {
        line[3 * i] = 1e6 + 0.1 * i;
        line[3 * i + 1] = 3e5 + 0.7 * i;
        line[3 * i + 2] = -0.3 * i;
    }
    ck_assert_int_eq(cm_pose_align(10, line, line, &found, &rank, &is_determined), CM_OK);
    ck_assert(rank == 1 && is_determined == 0);
    /* an octahedron and its mirror image: no rotation is better than others */
    static const double eight[] = {1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1};
    static const double image[] = {-1, 0, 0, 1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1};
    ck_assert_int_eq(cm_pose_align(6, eight, image, &found, &rank, &is_determined), CM_OK);
    ck_assert(rank == 3 && is_determined == 0);
    to[4] = (double)NAN;
    ck_assert_int_eq(cm_pose_align(5, points, to, &found, NULL, NULL), CM_ERROR_RANGE);
    to[4] = 2e100;
    ck_assert_int_eq(cm_pose_align(5, to, points, NULL, NULL, NULL), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_pose_align(0, to, points, NULL, NULL, NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_pose_align(1, NULL, points, NULL, NULL, NULL), CM_ERROR_ARGUMENT);
}
END_TEST

/* Steps of a metre, of which the estimate makes 1.1, and turns by 2 degrees about the way that it goes. */
START_TEST(known_errors)
{
    static const double times[4] = {10.0, 11.0, 11.5, 12.5};
    static const double along[4] = {0.0, 1.0, 1.5, 2.5};
    const double turn = 0.034906585039886591538;
    cm_pose truth[4];
    cm_pose estimate[4];
    for (int i = 0; i < 4; i++)
    {
        const double right[6] = {along[i], 0.0, 0.0, 0.0, 0.0, 0.0};
        const double wrong[6] = {1.1 * along[i], 0.0, 0.0, turn * along[i], 0.0, 0.0};
        cm_pose_exp(right, &truth[i]);
        cm_pose_exp(wrong, &estimate[i]);
    }
    cm_trajectory *right = make(4, times, truth);
    cm_trajectory *guess = make(4, times, estimate);
    cm_evaluation made = {.size = sizeof made};
    ck_assert_int_eq(cm_trajectory_evaluate(right, guess, NULL, &made), CM_OK);
    ck_assert_uint_eq(made.pairs, 4);
    /* 10 to 11, 11 to 12.5, the first at least a second later, and 11.5 to 12.5 */
    ck_assert_uint_eq(made.motions, 3);
    const double mean = sqrt((1.0 + 1.5 * 1.5 + 1.0) / 3.0);
    REQUIRE(fabs(made.rpe_translation_rmse - 0.1 * mean) <= 1e-15, "%.17g",
            made.rpe_translation_rmse);
    REQUIRE(fabs(made.rpe_rotation_rmse_degrees - 2.0 * mean) <= 1e-14, "%.17g",
            made.rpe_rotation_rmse_degrees);
    /* positions of a tenth of the distance from their mean, 1.25 */
    const double spread = sqrt((1.25 * 1.25 + 0.25 * 0.25) / 2.0);
    REQUIRE(fabs(made.ate_rmse - 0.1 * spread) <= 1e-15, "%.17g", made.ate_rmse);
    ck_assert(made.rank == 1 && !made.is_determined);
    cm_evaluation_options options = {.size = sizeof options, .interval = 2.0};
    ck_assert_int_eq(cm_trajectory_evaluate(right, guess, &options, &made), CM_OK);
    ck_assert_uint_eq(made.motions, 1); /* 10 to 12.5 */
    REQUIRE(fabs(made.rpe_translation_rmse - 0.25) <= 1e-15, "%.17g", made.rpe_translation_rmse);
    cm_trajectory_destroy(right);
    cm_trajectory_destroy(guess);
}
END_TEST

START_TEST(what_cannot_be_evaluated)
{
    fill(0.0, 0.05);
    cm_trajectory *made = make(COUNT, stamps, poses);
    fill(100.0, 0.05);
    cm_trajectory *other = make(COUNT, stamps, poses);
    cm_trajectory *one = make(1, stamps, poses);
    cm_evaluation errors = {.size = sizeof errors, .pairs = 77};
    cm_evaluation_options options = {.size = sizeof options};
    ck_assert_int_eq(cm_trajectory_evaluate(made, other, NULL, &errors), CM_ERROR_RANK);
    ck_assert_int_eq(cm_trajectory_evaluate(made, NULL, NULL, &errors), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_trajectory_evaluate(made, made, NULL, NULL), CM_ERROR_ARGUMENT);
    options.interval = (double)NAN;
    ck_assert_int_eq(cm_trajectory_evaluate(made, made, &options, &errors), CM_ERROR_RANGE);
    options.interval = -1.0;
    ck_assert_int_eq(cm_trajectory_evaluate(made, made, &options, &errors), CM_ERROR_RANGE);
    options = (cm_evaluation_options){.size = 3};
    ck_assert_int_eq(cm_trajectory_evaluate(made, made, &options, &errors), CM_ERROR_ARGUMENT);
    ck_assert_uint_eq(errors.pairs, 77);
    errors.size = 3;
    ck_assert_int_eq(cm_trajectory_evaluate(made, made, NULL, &errors), CM_ERROR_ARGUMENT);
    errors.size = sizeof errors;
    ck_assert_int_eq(cm_trajectory_evaluate(one, other, NULL, &errors), CM_OK);
    ck_assert(errors.pairs == 1 && errors.motions == 0 && errors.ate_rmse <= 1e-15);
    ck_assert(isnan(errors.rpe_translation_rmse) && isnan(errors.rpe_rotation_rmse_degrees));
    ck_assert(!errors.is_determined && errors.rank == 0);
    cm_trajectory_destroy(made);
    cm_trajectory_destroy(other);
    cm_trajectory_destroy(one);
}
END_TEST

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
    const TTest *const tests[] = {what_is_no_trajectory,
                                  near_and_between,
                                  closest_pairs_first,
                                  room_for_pairs,
                                  alignment_and_its_rank,
                                  known_errors,
                                  what_cannot_be_evaluated,
                                  motion_through_poses,
                                  short_motions,
                                  sensors_bring_back_the_trajectory,
                                  noise_of_sensors,
                                  sensors_that_are_none,
                                  NULL};
    return run_suite("trajectory", tests);
}
