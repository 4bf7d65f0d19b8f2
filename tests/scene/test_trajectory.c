/* SPDX-License-Identifier: MIT
 *
 * Trajectories: what is none, poses near and between, association, alignment, errors that are known. Errors
 * beside those of another program: check_trajectory_errors.py.
 */
#include "curved_trajectory.h"

#include <float.h>

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

/* As decimals are read: 0.02 after is within 0.02, and 0.020001 after is not, from 0 on and in our time. */
START_TEST(limits_are_as_written)
{
    fill(0.0, 0.05);
    size_t lost = 0;
    for (long k = 0; k < 3000; k++)
    {
        const long begin = k % 2 == 0 ? 0 : 1305031102;
        const long fraction = k % 3 == 0 ? 10000 * (k % 98) : (k * 7919) % 970000;
        char texts[3][40];
        double stamp[3];
        size_t index[2];
        for (int i = 0; i < 3; i++)
        {
            const long after = i == 0 ? 0 : 19999 + i;
            snprintf(texts[i], sizeof texts[i], "%ld.%06ld", begin, fraction + after);
            stamp[i] = strtod(texts[i], NULL);
        }
        lost += stamp[1] - stamp[0] <= 0.02 ? 0 : 1;
        for (int i = 1; i < 3; i++)
        {
            const size_t pairs = associate(1, stamp, 1, stamp + i, 0.02, index, index + 1);
            const size_t back = associate(1, stamp + i, 1, stamp, 0.02, index, index + 1);
            cm_trajectory *made = make(1, stamp, poses);
            const cm_status near = cm_trajectory_nearest(made, stamp[i], 0.02, index);
            cm_trajectory_destroy(made);
            REQUIRE(pairs == (i == 1) && back == pairs && (near == CM_OK) == (i == 1),
                    "%s and %s: %zu %zu %d", texts[0], texts[i], pairs, back, (int)near);
        }
    }
    REQUIRE(lost > 500, "only %zu of these would be lost by rounding", lost);
    /* too coarse for any of this */
    const double coarse[] = {1e17, 1e17 + 16.0};
    size_t index[2];
    ck_assert_uint_eq(associate(1, coarse, 1, coarse + 1, 0.02, index, index + 1), 0);
}
END_TEST

/* So many stamps of one, two or three units from each other; written with so many decimals, and as whole numbers. */
static void write_stamps(size_t n, long begin, int decimals, unsigned *state, double *stamp,
                         double *whole)
{
    long unit = 1;
    for (int i = 0; i < decimals; i++)
    {
        unit *= 10;
    }
    long at = 0;
    for (size_t i = 0; i < n; i++)
    {
        char text[40];
        *state = *state * 1664525 + 1013904223;
        at += 1 + (long)(*state >> 28) % 3;
        snprintf(text, sizeof text, "%ld.%0*ld", begin + at / unit, decimals, at % unit);
        stamp[i] = strtod(text, NULL);
        whole[i] = (double)at;
    }
}

/* The pairs of stamps as written, of which many are as close as others, do not change when all stamps are later by seconds. */
START_TEST(ties_are_as_written)
{
    fill(0.0, 0.05);
    static const long begins[] = {0, 1, 2, 1000, 100000, 1305031102};
    static const double most[] = {0.0, 0.05, 0.005, 0.0005, 0.00005, 0.000005, 0.0000005};
    for (unsigned trial = 0; trial < 600; trial++)
    {
        const int decimals = 2 + (int)(trial % 5);
        double a[60], b[60], whole_a[60], whole_b[60];
        size_t index_a[COUNT], index_b[COUNT], partner[COUNT];
        unsigned state = trial;
        write_stamps(60, begins[trial % 6], decimals, &state, a, whole_a);
        write_stamps(60, begins[trial % 6], decimals, &state, b, whole_b);
        const size_t count = associate(60, a, 60, b, most[decimals - 1], index_a, index_b);
        ck_assert_uint_eq(count, associate_slowly(60, whole_a, 60, whole_b, 5.0, partner));
        for (size_t i = 0; i < count; i++)
        {
            REQUIRE(partner[index_a[i]] == index_b[i], "trial %u: %.17g to %.17g, not %.17g", trial,
                    a[index_a[i]], b[index_b[i]], b[partner[index_a[i]]]);
        }
    }
}
END_TEST

/* 0.09 and 0.11 are as near to 0.1, and so are they later. */
START_TEST(nearest_of_ties_is_earlier)
{
    fill(0.0, 0.05);
    for (long begin = 0; begin < 1400000000; begin = 3 * begin / 2 + 1)
    {
        for (int hundredth = 1; hundredth < 99; hundredth++)
        {
            double stamp[3];
            for (int i = 0; i < 3; i++)
            {
                char text[40];
                snprintf(text, sizeof text, "%ld.%02d", begin, hundredth - 1 + i);
                stamp[i] = strtod(text, NULL);
            }
            const double both[] = {stamp[0], stamp[2]};
            cm_trajectory *made = make(2, both, poses);
            size_t index = 99;
            ck_assert_int_eq(cm_trajectory_nearest(made, stamp[1], 0.02, &index), CM_OK);
            REQUIRE(index == 0, "%.17g and not %.17g is near to %.17g", both[1], both[0], stamp[1]);
            cm_trajectory_destroy(made);
        }
    }
    /* as near, but that a wider limit lets in only the later one */
    const double around[] = {1.0, 1.0 + 3.0 * DBL_EPSILON};
    cm_trajectory *made = make(2, around, poses);
    size_t index = 99;
    ck_assert_int_eq(
        cm_trajectory_nearest(made, 1.0 + 2.0 * DBL_EPSILON, 0.5 * DBL_EPSILON, &index),
        CM_ERROR_RANGE);
    ck_assert_int_eq(cm_trajectory_nearest(made, 1.0 + 2.0 * DBL_EPSILON, DBL_EPSILON, &index),
                     CM_OK);
    ck_assert_uint_eq(index, 1);
    cm_trajectory_destroy(made);
}
END_TEST

/* Stamps a second later are of the same errors. */
START_TEST(errors_do_not_depend_on_the_second)
{
    static const double along[] = {0.0, 5.0, 10.0, 20.0};
    static const double across[] = {0.0, 0.0, 0.0, 1.0};
    static const char *const fractions[] = {".09", ".11", ".40", ".90", ".10", ".40", ".90"};
    cm_pose places[4];
    cm_evaluation first = {.size = sizeof first};
    for (int i = 0; i < 4; i++)
    {
        const double twist[6] = {along[i], across[i], 0.0, 0.0, 0.0, 0.0};
        cm_pose_exp(twist, &places[i]);
    }
    const cm_pose guesses[] = {places[0], places[2], places[3]};
    for (long begin = 0; begin < 1400000000; begin = 3 * begin / 2 + 1)
    {
        double stamp[7];
        for (int i = 0; i < 7; i++)
        {
            char text[40];
            snprintf(text, sizeof text, "%ld%s", begin, fractions[i]);
            stamp[i] = strtod(text, NULL);
        }
        cm_trajectory *truth = make(4, stamp, places);
        cm_trajectory *guess = make(3, stamp + 4, guesses);
        cm_evaluation errors = {.size = sizeof errors};
        ck_assert_int_eq(cm_trajectory_evaluate(truth, guess, NULL, &errors), CM_OK);
        first = begin == 0 ? errors : first;
        REQUIRE(errors.pairs == 3 && errors.ate_rmse == first.ate_rmse && errors.ate_rmse < 1e-12,
                "from %ld on: %zu pairs, %g, not %g", begin, errors.pairs, errors.ate_rmse,
                first.ate_rmse);
        cm_trajectory_destroy(truth);
        cm_trajectory_destroy(guess);
    }
}
END_TEST

/* Of the widest stamps there are, whose distances are infinite. */
START_TEST(ties_of_infinite_distances)
{
    fill(0.0, 0.05);
    const double low[] = {-1.7e308, -1.6e308};
    const double high[] = {1.6e308, 1.7e308};
    size_t index_a[COUNT];
    size_t index_b[COUNT];
    ck_assert_uint_eq(associate(2, low, 2, high, (double)INFINITY, index_a, index_b), 2);
    ck_assert(index_a[0] == 0 && index_b[0] == 1 && index_a[1] == 1 && index_b[1] == 0);
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

/* As decimals are read: 1.4 is a second after 0.4, and 1.399999 is not, from 0 on and in our time. */
START_TEST(intervals_are_as_written)
{
    size_t lost = 0;
    fill(0.0, 0.05);
    for (long k = 0; k < 3000; k++)
    {
        const long begin = k % 2 == 0 ? 0 : 1305031102;
        const long fraction = k % 3 == 0 ? 100000 * (k % 10) : (k * 7919) % 1000000;
        char texts[3][40];
        double stamp[3];
        snprintf(texts[0], sizeof texts[0], "%ld.%06ld", begin, fraction);
        snprintf(texts[1], sizeof texts[1], "%ld.%06ld", begin + (fraction > 0),
                 (fraction + 999999) % 1000000);
        snprintf(texts[2], sizeof texts[2], "%ld.%06ld", begin + 1, fraction);
        for (int i = 0; i < 3; i++)
        {
            stamp[i] = strtod(texts[i], NULL);
        }
        lost += stamp[2] - stamp[0] >= 1.0 ? 0 : 1;
        for (size_t n = 2; n <= 3; n++)
        {
            cm_trajectory *made = make(n, stamp, poses);
            cm_evaluation errors = {.size = sizeof errors};
            ck_assert_int_eq(cm_trajectory_evaluate(made, made, NULL, &errors), CM_OK);
            REQUIRE(errors.motions == n - 2, "%zu from %s to %s", errors.motions, texts[0],
                    texts[n - 1]);
            cm_trajectory_destroy(made);
        }
    }
    REQUIRE(lost > 300, "only %zu of these would be lost by rounding", lost);
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

int main(void)
{
    const TTest *const tests[] = {what_is_no_trajectory,
                                  near_and_between,
                                  closest_pairs_first,
                                  limits_are_as_written,
                                  ties_are_as_written,
                                  nearest_of_ties_is_earlier,
                                  errors_do_not_depend_on_the_second,
                                  ties_of_infinite_distances,
                                  room_for_pairs,
                                  alignment_and_its_rank,
                                  known_errors,
                                  intervals_are_as_written,
                                  what_cannot_be_evaluated,
                                  NULL};
    return run_suite("trajectory", tests);
}
