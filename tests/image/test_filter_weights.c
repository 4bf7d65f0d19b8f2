/* SPDX-License-Identifier: MIT
 *
 * The weights of filters, against values computed by hand, and the tables of them.
 */
#include "tests/suite.h"

#include "modules/image/filter_weights.h"

static double weight_at(cm_filter filter, double t, unsigned tap)
{
    double weights[CM_FILTER_TAPS_MAX];
    cm_filter_weights(filter, t, weights);
    return tap < cm_filter_taps(filter) ? weights[tap] : 0.0;
}

START_TEST(weights_are_the_filters)
{
    ck_assert_uint_eq(cm_filter_taps(CM_FILTER_AUTO), 0);
    ck_assert_uint_eq(cm_filter_taps(CM_FILTER_BILINEAR), 0);
    ck_assert_uint_eq(cm_filter_taps(CM_FILTER_EWA), 0);
    /* half way between two pixels: Keys 1981 for the first, B = C = 1/3 put into the formula, sinc by hand */
    ck_assert_double_eq_tol(weight_at(CM_FILTER_CATMULL_ROM, 0.5, 1), 9.0 / 16.0, 1e-15);
    ck_assert_double_eq_tol(weight_at(CM_FILTER_CATMULL_ROM, 0.5, 0), -1.0 / 16.0, 1e-15);
    ck_assert_double_eq_tol(weight_at(CM_FILTER_MITCHELL, 0.0, 1), 8.0 / 9.0, 1e-15);
    ck_assert_double_eq_tol(weight_at(CM_FILTER_MITCHELL, 0.0, 0), 1.0 / 18.0, 1e-15);
    ck_assert_double_eq_tol(weight_at(CM_FILTER_BSPLINE5, 0.0, 2), 66.0 / 120.0, 1e-15);
    ck_assert_double_eq_tol(weight_at(CM_FILTER_BSPLINE5, 0.0, 1), 26.0 / 120.0, 1e-15);
    ck_assert_double_eq_tol(weight_at(CM_FILTER_BSPLINE5, 0.0, 5), 0.0, 1e-15);
    ck_assert_double_eq_tol(weight_at(CM_FILTER_BSPLINE5, 0.0, 0), 1.0 / 120.0, 1e-15);
    /* 6 / pi^2, -4 / (3 pi^2), 6 / (25 pi^2), before their sum is made 1 */
    const double sum = 2.0 * (6.0 - 4.0 / 3.0 + 6.0 / 25.0);
    ck_assert_double_eq_tol(weight_at(CM_FILTER_LANCZOS3, 0.5, 2), 6.0 / sum, 1e-14);
    ck_assert_double_eq_tol(weight_at(CM_FILTER_LANCZOS3, 0.5, 1), -4.0 / 3.0 / sum, 1e-14);
    ck_assert_double_eq_tol(weight_at(CM_FILTER_LANCZOS3, 0.5, 0), 6.0 / 25.0 / sum, 1e-14);
    for (int filter = CM_FILTER_CATMULL_ROM; filter <= CM_FILTER_BSPLINE5; filter++)
    {
        const unsigned taps = cm_filter_taps((cm_filter)filter);
        for (int k = 0; k <= 1000; k++)
        {
            double here[CM_FILTER_TAPS_MAX];
            double mirrored[CM_FILTER_TAPS_MAX];
            double total = 0.0;
            cm_filter_weights((cm_filter)filter, k / 1000.0, here);
            cm_filter_weights((cm_filter)filter, 1.0 - k / 1000.0, mirrored);
            for (unsigned i = 0; i < taps; i++)
            {
                total += here[i];
                ck_assert_double_eq_tol(here[i], mirrored[taps - 1 - i], 1e-14);
            }
            ck_assert_double_eq_tol(total, 1.0, 1e-15);
        }
        const int is_interpolating = filter != CM_FILTER_MITCHELL && filter != CM_FILTER_BSPLINE5;
        for (unsigned i = 0; i < taps && is_interpolating; i++)
        {
            ck_assert_double_eq_tol(weight_at((cm_filter)filter, 0.0, i), i == taps / 2 - 1, 1e-15);
        }
    }
}
END_TEST

START_TEST(tables_have_the_weights)
{
    for (int filter = CM_FILTER_CATMULL_ROM; filter <= CM_FILTER_BSPLINE5; filter++)
    {
        static cm_filter_table filled;
        const cm_filter_table *table = &filled;
        cm_filter_table_fill((cm_filter)filter, &filled);
        const unsigned taps = cm_filter_taps((cm_filter)filter);
        for (int p = 0; p <= CM_FILTER_PHASES; p++)
        {
            int sum = 0;
            for (unsigned i = 0; i < 8; i++)
            {
                const double weight = weight_at((cm_filter)filter, p / 256.0, i);
                sum += table->whole[p][i];
                ck_assert_double_eq_tol((double)table->real[p][i], weight, 6e-8);
                ck_assert_double_eq_tol(table->whole[p][i] / 16384.0, weight, 3.0 / 16384.0);
            }
            ck_assert_int_eq(sum, CM_FILTER_ONE);
        }
        double worst = 0.0;
        for (int k = 0; k <= 64 * 32; k++)
        {
            const double t = k / (64.0 * 32.0);
            const int s = k == 64 * 32 ? 63 : k / 32;
            const double u = 64.0 * t - s;
            for (unsigned i = 0; i < taps; i++)
            {
                const float(*terms)[8] = table->segments[s];
                const double sum =
                    (double)terms[0][i] + u * ((double)terms[1][i] + u * (double)terms[2][i]);
                worst = fmax(worst, fabs(sum - weight_at((cm_filter)filter, t, i)));
            }
        }
        REQUIRE(worst < 5e-7, "filter %d: %g", filter, worst);
    }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {weights_are_the_filters, tables_have_the_weights, NULL};
    return run_suite("filter weights", tests);
}
