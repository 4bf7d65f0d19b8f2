/* SPDX-License-Identifier: MIT
 *
 * Conversions between colours: against the tests' own, and back.
 */
#include "many_colormaps.h"

START_TEST(known_colors)
{
    /* computed with 30 digits from the chromaticities of IEC 61966-2-1 */
    static const double known[][2][3] = {
        {{1.0, 0.0, 0.0}, {53.237115595429, 175.00982216288, 37.765093625560}},
        {{0.0, 1.0, 0.0}, {87.735519109660, -83.067119714401, 107.41811123934}},
        {{0.0, 0.0, 1.0}, {32.300872903980, -9.4024072148241, -130.35108850356}},
        {{1.0, 1.0, 0.0}, {97.138559341797, 7.7042191772699, 106.80811125090}},
        {{0.0, 1.0, 1.0}, {91.114752316705, -70.464379963878, -15.205397466927}},
        {{1.0, 0.0, 1.0}, {60.322731354551, 84.055601989752, -108.69636549177}},
        {{1.0, 1.0, 1.0}, {100.0, 0.0, 0.0}},
        {{0.5, 0.5, 0.5}, {53.388964741114, 0.0, 0.0}},
        {{0.2, 0.4, 0.6}, {42.009163494482, -20.244149803300, -47.559331810386}},
        {{0.01, 0.02, 0.03}, {1.3000987749436, -0.44226033877491, -0.64193295903125}},
        {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}},
    };
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
    {
        double linear[3], luv[3], own[3], srgb[3];
        cm_colormap_linear_from_srgb(known[i][0], linear);
        cm_colormap_luv_from_linear(linear, luv);
        own_luv(known[i][0], own);
        REQUIRE(distance(luv, known[i][1]) < 1e-10, "%zu: %.14g %.14g %.14g", i, luv[0], luv[1],
                luv[2]);
        REQUIRE(distance(own, known[i][1]) < 1e-10, "the test's own: %zu", i);
        cm_colormap_linear_from_luv(known[i][1], linear);
        cm_colormap_srgb_from_linear(linear, srgb);
        REQUIRE(distance(srgb, known[i][0]) < 1e-12, "%zu: %.14g %.14g %.14g", i, srgb[0], srgb[1],
                srgb[2]);
    }
}
END_TEST

/* With the matrix in the rounding of B. Lindbloom and the white 0.95047, 1, 1.08883, as many programs
 * have them, red is 53.2408, 175.0151, 37.7564. */
START_TEST(red_of_other_programs)
{
    const double red[3] = {1.0, 0.0, 0.0};
    const double others[3] = {53.2408, 175.0151, 37.7564};
    double luv[3];
    cm_colormap_luv_from_linear(red, luv);
    ck_assert_double_lt(distance(luv, others), 0.02);
}
END_TEST

/* The matrix is the one that the standard prints with four digits. */
START_TEST(printed_matrix)
{
    static const double printed[3][3] = {
        {0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505}};
    double matrix[3][3];
    derive_matrix(matrix);
    for (int k = 0; k < 9; k++)
    {
        ck_assert_double_eq_tol(matrix[k / 3][k % 3], printed[k / 3][k % 3], 0.5e-4);
    }
}
END_TEST

START_TEST(conversions_come_back)
{
    double worst = 0.0;
    for (int i = 0; i < 33 * 33 * 33; i++)
    {
        const double srgb[3] = {i % 33 / 32.0, i / 33 % 33 / 32.0, i / 1089 / 32.0};
        double linear[3], luv[3], lch[3], again[3], own[3], back[3];
        cm_colormap_linear_from_srgb(srgb, linear);
        cm_colormap_luv_from_linear(linear, luv);
        own_luv(srgb, own);
        cm_colormap_lch_from_luv(luv, lch);
        ck_assert(lch[1] >= 0.0 && lch[2] >= 0.0 && lch[2] < 360.0);
        cm_colormap_luv_from_lch(lch, again);
        cm_colormap_linear_from_luv(again, linear);
        cm_colormap_srgb_from_linear(linear, back);
        REQUIRE(distance(luv, own) < 1e-10 && distance(luv, again) < 1e-10 &&
                    distance(srgb, back) < 1e-12,
                "%g %g %g: %g %g %g", srgb[0], srgb[1], srgb[2], distance(luv, own),
                distance(luv, again), distance(srgb, back));
        cm_colormap_linear_from_srgb(back, linear);
        cm_colormap_luv_from_linear(linear, again);
        worst = fmax(worst, distance(luv, again));
    }
    REQUIRE(worst < 1e-10, "%g", worst);
}
END_TEST

/* Around the joint of the transfer function, where printed constants leave a step of 3e-8. */
START_TEST(transfer_function_has_an_inverse)
{
    double before = -1.0;
    for (int i = -20000; i <= 20000; i++)
    {
        const double linear[3] = {0.0031307 + i * 1e-11, -(0.0031307 + i * 1e-11), i / 20000.0};
        double srgb[3], back[3];
        cm_colormap_srgb_from_linear(linear, srgb);
        cm_colormap_linear_from_srgb(srgb, back);
        ck_assert_double_lt(distance(linear, back), 1e-15);
        ck_assert_double_eq(srgb[0], -srgb[1]);
        REQUIRE(srgb[0] >= before, "falls at %.17g", linear[0]);
        before = srgb[0];
    }
}
END_TEST

START_TEST(no_colors)
{
    const double bad[] = {(double)NAN, (double)INFINITY, -(double)INFINITY};
    for (int i = 0; i < 9; i++)
    {
        double values[3] = {50.0, 1.0, 1.0}, result[3];
        values[i % 3] = bad[i / 3];
        cm_colormap_linear_from_luv(values, result);
        REQUIRE(all_nan(result), "linear_from_luv %d", i);
        cm_colormap_luv_from_linear(values, result);
        REQUIRE(all_nan(result), "luv_from_linear %d", i);
        cm_colormap_srgb_from_linear(values, result);
        ck_assert_double_nan(result[i % 3]);
        cm_colormap_linear_from_srgb(values, result);
        ck_assert_double_nan(result[i % 3]);
    }
    double result[3];
    cm_colormap_linear_from_luv((const double[3]){-1.0, 0.0, 0.0}, result);
    ck_assert(all_nan(result));
    cm_colormap_linear_from_luv((const double[3]){50.0, 0.0, -1000.0}, result);
    ck_assert(all_nan(result)); /* v' < 0 */
    cm_colormap_luv_from_linear((const double[3]){-1.0, 0.0, 0.0}, result);
    ck_assert(all_nan(result));
    cm_colormap_linear_from_luv((const double[3]){0.0, 5.0, 7.0}, result);
    ck_assert(result[0] == 0.0 && result[1] == 0.0 && result[2] == 0.0);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {known_colors,
                                  red_of_other_programs,
                                  printed_matrix,
                                  conversions_come_back,
                                  transfer_function_has_an_inverse,
                                  no_colors,
                                  NULL};
    return run_suite("colormap color", tests);
}
