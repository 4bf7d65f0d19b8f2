/* SPDX-License-Identifier: MIT
 *
 * Shot noise in Freeman and Tukey's space: beside Poisson's distribution itself, by a polynomial whose noise is known by
 * hand, for any threads, and what is refused.
 */
#include "tof_stage.h"

enum
{
    IMAGES = PHASES * PIXELS,
    VIEWS = 8
};

static float without[2][IMAGES];

/* A wall so far away, and such light, that charges are from some tens to some hundreds of electrons. */
static stage make_dim_stage(void)
{
    stage at = make_stage(&wall, 1);
    at.light.power = 0.3;
    ck_assert_int_eq(simulate(&at, NULL), CM_OK);
    memcpy(without[0], charge_a, sizeof without[0]);
    memcpy(without[1], charge_b, sizeof without[1]);
    return at;
}

typedef struct moments
{
    double count, mean, variance;
} moments;

/* Of (charge - N - more_mean) / sqrt(factor N + more_variance), where N is large enough that the formulas hold. */
static moments measure(const stage *at, cm_tof_options options, double more_mean, double factor,
                       double more_variance)
{
    moments found = {0.0, 0.0, 0.0};
    double square = 0.0;
    options.size = sizeof options;
    options.noise = 1;
    for (uint32_t view = 0; view < VIEWS; view++)
    {
        options.view = view;
        ck_assert_int_eq(simulate(at, &options), CM_OK);
        for (size_t i = 0; i < 2 * (size_t)IMAGES; i++)
        {
            const double truth = (double)without[i / IMAGES][i % IMAGES];
            const double seen = (double)(i < IMAGES ? charge_a : charge_b)[i % IMAGES];
            if (truth >= 25.0)
            {
                const double apart =
                    (seen - truth - more_mean) / sqrt(factor * truth + more_variance);
                found.count++;
                found.mean += apart;
                square += apart * apart;
            }
        }
    }
    found.mean /= found.count;
    found.variance = square / found.count - found.mean * found.mean;
    return found;
}

static void check_moments(const char *what, moments found)
{
    REQUIRE(found.count > 50000.0, "%s: %g charges", what, found.count);
    REQUIRE(fabs(found.mean) < 4.0 / sqrt(found.count) &&
                fabs(found.variance - 1.0) < 5.0 * sqrt(2.0 / found.count),
            "%s: mean %g, variance %g of %g", what, found.mean, found.variance, found.count);
}

/* Poisson's numbers have N and N. The space's normal numbers are squared on their way back: N + V / 4 in the mean and, to the
 * same order, V (N + 1 / 2). */
START_TEST(moments_are_those_of_the_exact_distribution)
{
    stage at = make_dim_stage();
    const cm_tof_options exact = {.shot = CM_TOF_POISSON, .seed = 11};
    const cm_tof_options normal = {.shot = CM_TOF_FREEMAN_TUKEY, .seed = 11};
    check_moments("Poisson", measure(&at, exact, 0.0, 1.0, 0.0));
    check_moments("Freeman and Tukey", measure(&at, normal, 0.25, 1.0, 0.5));
    free_stage(&at);
}
END_TEST

START_TEST(a_measured_polynomial_is_followed)
{
    stage at = make_dim_stage();
    const cm_tof_options normal = {.size = sizeof normal, .shot = CM_TOF_FREEMAN_TUKEY, .noise = 1};
    const double none[1] = {0.0}, four[3] = {2.0, 0.0, 2.0};
    at.sensor.shot_terms = 1;
    at.sensor.shot_variance = none;
    at.sensor.shot_least = 1.0;
    at.sensor.shot_most = 2.0;
    ck_assert_int_eq(simulate(&at, &normal), CM_OK);
    for (size_t i = 0; i < IMAGES; i++)
    {
        const double truth = (double)without[0][i];
        ck_assert_double_eq_tol((double)charge_a[i], truth, 2e-7 * truth + 1e-12);
    }
    /* 2 + 2 y^2, which is measured up to y = 1.00001 and stays there: 4 */
    at.sensor.shot_terms = 3;
    at.sensor.shot_variance = four;
    at.sensor.shot_most = 1.00001;
    check_moments("a variance of 4", measure(&at, normal, 1.0, 4.0, 6.0));
    free_stage(&at);
}
END_TEST

START_TEST(no_charge_has_no_noise)
{
    stage at = make_stage(&wall, 1);
    const cm_tof_options normal = {.size = sizeof normal, .shot = CM_TOF_FREEMAN_TUKEY, .noise = 1};
    at.light.power = 0.0;
    ck_assert_int_eq(simulate(&at, &normal), CM_OK);
    for (size_t i = 0; i < IMAGES; i++)
    {
        ck_assert_double_lt((double)charge_a[i], 1e-12);
        ck_assert_double_ge((double)charge_a[i], 0.0);
    }
    free_stage(&at);
}
END_TEST

START_TEST(threads_change_no_bit)
{
    static float first[IMAGES];
    stage at = make_dim_stage();
    const cm_tof_options normal = {
        .size = sizeof normal, .shot = CM_TOF_FREEMAN_TUKEY, .noise = 1, .seed = 3};
    const unsigned threads[] = {1, 2, 7};
    at.sensor.read_noise = 3.0;
    for (int t = 0; t < 3; t++)
    {
        cm_pool *pool = NULL;
        cm_tof_result result = {.size = sizeof result, .phase = phase};
        ck_assert_int_eq(cm_pool_create(threads[t], &pool), CM_OK);
        ck_assert_int_eq(
            cm_tof_simulate(at.scene, &at.sensor, &at.light, 1, NULL, 0.0, &normal, pool, &result),
            CM_OK);
        if (t == 0)
        {
            memcpy(first, phase, sizeof first);
        }
        ck_assert_mem_eq(first, phase, sizeof first);
        cm_pool_destroy(pool);
    }
    free_stage(&at);
}
END_TEST

START_TEST(bad_input_is_refused)
{
    const stage good = make_dim_stage();
    stage at = good;
    const double factor[2] = {1.0, 0.0}, no_number[1] = {NAN}, huge[2] = {0.0, 1e12};
    cm_tof_options normal = {.size = sizeof normal, .shot = 2, .noise = 1};
    ck_assert_int_eq(simulate(&at, &normal), CM_ERROR_RANGE);
    normal.shot = -1;
    ck_assert_int_eq(simulate(&at, &normal), CM_ERROR_RANGE);
    normal.shot = CM_TOF_FREEMAN_TUKEY;
    at.sensor.shot_terms = 1;
    ck_assert_int_eq(simulate(&at, &normal), CM_ERROR_ARGUMENT);
    at.sensor.shot_variance = factor;
    ck_assert_int_eq(simulate(&at, &normal), CM_ERROR_RANGE); /* from 0 to 0 */
    at.sensor.shot_least = 1.0;
    at.sensor.shot_most = INFINITY;
    ck_assert_int_eq(simulate(&at, &normal), CM_ERROR_RANGE);
    at.sensor.shot_most = 100.0;
    ck_assert_int_eq(simulate(&at, &normal), CM_OK);
    at.sensor.shot_terms = 33;
    ck_assert_int_eq(simulate(&at, &normal), CM_ERROR_RANGE);
    at.sensor.shot_terms = 1;
    at.sensor.shot_variance = no_number;
    ck_assert_int_eq(simulate(&at, &normal), CM_ERROR_RANGE);
    at.sensor.shot_terms = 2;
    at.sensor.shot_variance = huge;
    ck_assert_int_eq(simulate(&at, &normal), CM_ERROR_RANGE);
    at = good;
    free_stage(&at);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {moments_are_those_of_the_exact_distribution,
                                  a_measured_polynomial_is_followed,
                                  no_charge_has_no_noise,
                                  threads_change_no_bit,
                                  bad_input_is_refused,
                                  NULL};
    return run_suite("shot noise", tests);
}
