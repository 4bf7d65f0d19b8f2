/* SPDX-License-Identifier: MIT
 *
 * Measures of depth against truth: what was made is what is found, and simple cases by hand.
 */
#include <cubemap/depth_error.h>

#include "tests/suite.h"

enum
{
    N = 4000
};

static uint64_t state = 1;

static double uniform(double low, double high)
{
    state = state * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * (double)(state >> 11) * 0x1p-53;
}

/* ---- one image ---- */

START_TEST(a_few_pixels_by_hand)
{
    const float depth[8] = {1.0f, 2.5f, 3.0f, NAN, 5.0f, 0.0f, 1.0f, 2.0f};
    const float truth[8] = {1.0f, 2.0f, 4.0f, 1.0f, 4.75f, 2.0f, NAN, 2.25f};
    /* errors: 0, 0.5, -1, -, 0.25, -, -, -0.25 */
    cm_depth_error error = {.size = sizeof error};
    ck_assert_int_eq(cm_depth_error_measure(8, depth, truth, &error), CM_OK);
    REQUIRE(error.count == 5 && error.missing == 2 && error.extra == 1, "%zu", error.count);
    REQUIRE(fabs(error.bias + 0.1) < 1e-15, "%g", error.bias);
    REQUIRE(fabs(error.mae - 0.4) < 1e-15, "%g", error.mae);
    REQUIRE(fabs(error.mse - 0.275) < 1e-15, "%g", error.mse);
    REQUIRE(fabs(error.rmse - sqrt(0.275)) < 1e-15, "%g", error.rmse);
    REQUIRE(error.median == 0.0 && error.median_absolute == 0.25, "%g", error.median);
    REQUIRE(error.maximum == 1.0, "%g", error.maximum);
    float local[8];
    ck_assert_int_eq(cm_depth_error_local(8, depth, truth, local), CM_OK);
    REQUIRE(local[0] == 0.0f && local[1] == 0.5f && local[2] == -1.0f && isnan(local[3]) &&
                local[4] == 0.25f && isnan(local[5]) && isnan(local[6]) && local[7] == -0.25f,
            "%g", (double)local[2]);
    const double fraction[5] = {0.0, 0.25, 0.5, 0.625, 1.0}, limit[4] = {0.0, 0.25, 0.4, 1.0};
    const double quantiles[5] = {0.0, 0.25, 0.25, 0.375, 1.0};
    const double bad[4] = {6.0 / 7.0, 4.0 / 7.0, 4.0 / 7.0, 2.0 / 7.0};
    double got[5];
    ck_assert_int_eq(cm_depth_error_quantiles(8, depth, truth, 5, fraction, got), CM_OK);
    for (int i = 0; i < 5; i++)
    {
        REQUIRE(got[i] == quantiles[i], "%d: %g", i, got[i]);
    }
    ck_assert_int_eq(cm_depth_error_bad(8, depth, truth, 4, limit, got), CM_OK);
    for (int i = 0; i < 4; i++)
    {
        REQUIRE(fabs(got[i] - bad[i]) < 1e-15, "%d: %g", i, got[i]);
    }
}
END_TEST

/* The mean square is bias and deviation in quadrature; the chapter adds them. */
START_TEST(the_square_is_of_bias_and_deviation)
{
    static float depth[N], truth[N];
    state = 5;
    for (int i = 0; i < N; i++)
    {
        truth[i] = (float)uniform(1.0, 4.0);
        depth[i] = truth[i] + (float)(0.02 + uniform(-0.03, 0.03));
    }
    cm_depth_error error = {.size = sizeof error};
    ck_assert_int_eq(cm_depth_error_measure(N, depth, truth, &error), CM_OK);
    REQUIRE(fabs(error.bias - 0.02) < 1e-3, "%g", error.bias);
    REQUIRE(fabs(error.deviation - 0.06 / sqrt(12.0)) < 5e-4, "%g", error.deviation);
    REQUIRE(fabs(error.mse - error.bias * error.bias - error.deviation * error.deviation) < 1e-16,
            "%g", error.mse);
    REQUIRE(error.rmse < 0.9 * (error.bias + error.deviation), "%g", error.rmse);
}
END_TEST

START_TEST(time_has_means_and_deviations)
{
    const float depth[3][4] = {
        {1.0f, 2.0f, NAN, 0.0f}, {2.0f, NAN, NAN, 7.0f}, {3.0f, 4.0f, 5.0f, NAN}};
    float mean[4], deviation[4];
    ck_assert_int_eq(cm_depth_error_temporal(3, 4, depth[0], mean, deviation), CM_OK);
    REQUIRE(mean[0] == 2.0f && mean[1] == 3.0f && mean[2] == 5.0f && mean[3] == 7.0f, "%g",
            (double)mean[1]);
    REQUIRE(deviation[0] == 1.0f && deviation[1] == sqrtf(2.0f) && isnan(deviation[2]) &&
                isnan(deviation[3]),
            "%g", (double)deviation[0]);
    const float none[2] = {NAN, NAN};
    ck_assert_int_eq(cm_depth_error_temporal(2, 1, none, mean, NULL), CM_OK);
    REQUIRE(isnan(mean[0]), "%g", (double)mean[0]);
    ck_assert_int_eq(cm_depth_error_temporal(2, 1, none, NULL, deviation), CM_OK);
    ck_assert_int_eq(cm_depth_error_temporal(1, 1, none, mean, NULL), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_depth_error_temporal(2, 1, NULL, mean, NULL), CM_ERROR_ARGUMENT);
}
END_TEST

/* ---- surfaces ---- */

START_TEST(slopes_are_angles)
{
    const float x[3] = {0.0f, 1e-6f, 0.0f}, zero[3] = {0}, z[3] = {-1.0f, -1.0f, 0.0f};
    const float y[3] = {1.0f, 0.0f, 0.0f}, back[3] = {0.0f, -1.0f, -1.0f};
    float angle[3];
    const float *const one[3] = {x, zero, z}, *const other[3] = {zero, y, back};
    ck_assert_int_eq(cm_depth_error_slope(3, one, other, angle), CM_OK);
    REQUIRE(fabs((double)angle[0] - acos(0.0)) < 1e-7, "%g", (double)angle[0]);
    REQUIRE(fabs((double)angle[1] - 1e-6) < 1e-12, "%g", (double)angle[1]);
    REQUIRE(isnan(angle[2]), "%g", (double)angle[2]);
    const float *const missing[3] = {x, NULL, z};
    ck_assert_int_eq(cm_depth_error_slope(3, missing, other, angle), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_depth_error_slope(3, one, NULL, angle), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_depth_error_slope(3, one, other, NULL), CM_ERROR_ARGUMENT);
}
END_TEST

static float points[3][N];
static const float *const point_planes[3] = {points[0], points[1], points[2]};

/* A plane at any place and any angle, with noise along its normal. */
START_TEST(planes_are_found)
{
    const double normal[3] = {0.48, -0.6, -0.64}, u[3] = {0.8, 0.6, 0.0375};
    state = 11;
    double v[3], centre[3] = {1.0, -2.0, 3.0};
    v[0] = normal[1] * u[2] - normal[2] * u[1];
    v[1] = normal[2] * u[0] - normal[0] * u[2];
    v[2] = normal[0] * u[1] - normal[1] * u[0];
    const double along = normal[0] * u[0] + normal[1] * u[1] + normal[2] * u[2];
    for (int i = 0; i < N; i++)
    {
        const double a = uniform(-1.0, 1.0), b = uniform(-0.5, 0.5), h = uniform(-1e-3, 1e-3);
        for (int k = 0; k < 3; k++)
        {
            points[k][i] =
                (float)(centre[k] + a * (u[k] - along * normal[k]) + b * v[k] + h * normal[k]);
        }
    }
    points[1][17] = NAN;
    cm_depth_plane plane = {.size = sizeof plane};
    ck_assert_int_eq(cm_depth_error_plane(N, point_planes, &plane), CM_OK);
    const double side = normal[0] * centre[0] + normal[1] * centre[1] + normal[2] * centre[2];
    REQUIRE(plane.count == N - 1, "%zu", plane.count);
    for (int k = 0; k < 3; k++)
    {
        REQUIRE(fabs(plane.normal[k] - (side > 0.0 ? -normal[k] : normal[k])) < 1e-4, "%d: %g", k,
                plane.normal[k]);
    }
    REQUIRE(plane.distance < 0.0 && fabs(plane.distance + fabs(side)) < 4e-4, "%g", plane.distance);
    REQUIRE(fabs(plane.rms - 2e-3 / sqrt(12.0)) < 2e-5, "%g", plane.rms);
    REQUIRE(plane.maximum < 1.1e-3 && plane.maximum > 0.98e-3, "%g", plane.maximum);
    REQUIRE(fabs(plane.curvature[0]) < 2e-3 && fabs(plane.curvature[1]) < 2e-3, "%g",
            plane.curvature[0]);
}
END_TEST

/* Of a piece of a sphere or a cylinder; a bowl around the camera is positive, a ball before it negative. */
START_TEST(bent_walls_have_curvatures)
{
    for (int kind = 0; kind < 4; kind++)
    {
        const double radius = 5.0, sign = kind % 2 ? -1.0 : 1.0;
        state = 13;
        for (int i = 0; i < N; i++)
        {
            const double a = uniform(-0.3, 0.3), b = uniform(-0.2, 0.2);
            const double square = a * a + (kind < 2 ? b * b : 0.0);
            points[0][i] = (float)a;
            points[1][i] = (float)b;
            points[2][i] = (float)(3.0 + sign * (sqrt(radius * radius - square) - radius));
        }
        cm_depth_plane plane = {.size = sizeof plane};
        ck_assert_int_eq(cm_depth_error_plane(N, point_planes, &plane), CM_OK);
        const double expected[2] = {kind == 3 ? 0.0 : sign / radius,
                                    kind == 2 ? 0.0 : sign / radius};
        REQUIRE(fabs(plane.curvature[0] - expected[0]) < 2e-3 &&
                    fabs(plane.curvature[1] - expected[1]) < 2e-3,
                "%d: %g %g", kind, plane.curvature[0], plane.curvature[1]);
        REQUIRE(plane.normal[2] < -0.999, "%g", plane.normal[2]);
    }
}
END_TEST

START_TEST(what_is_no_plane_is_refused)
{
    cm_depth_plane plane = {.size = sizeof plane};
    const float line[3][4] = {{1, 2, 3, 4}, {2, 4, 6, 8}, {0.1f, 0.2f, 0.3f, 0.4f}};
    const float *const planes[3] = {line[0], line[1], line[2]}, *const missing[3] = {line[0]};
    ck_assert_int_eq(cm_depth_error_plane(4, planes, &plane), CM_ERROR_RANK);
    ck_assert_int_eq(cm_depth_error_plane(2, planes, &plane), CM_ERROR_RANK);
    ck_assert_int_eq(cm_depth_error_plane(0, planes, &plane), CM_ERROR_RANK);
    ck_assert_int_eq(cm_depth_error_plane(4, missing, &plane), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_depth_error_plane(4, NULL, &plane), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_depth_error_plane(4, planes, NULL), CM_ERROR_ARGUMENT);
    REQUIRE(plane.count == 0, "written");
    plane.size = 1;
    ck_assert_int_eq(cm_depth_error_plane(4, planes, &plane), CM_ERROR_ARGUMENT);
    /* three points have a plane, and no curvature */
    const float three[3][3] = {{0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
    const float *const corner[3] = {three[0], three[1], three[2]};
    plane.size = sizeof plane;
    ck_assert_int_eq(cm_depth_error_plane(3, corner, &plane), CM_OK);
    REQUIRE(plane.rms < 1e-15 && isnan(plane.curvature[0]), "%g", plane.rms);
    /* seven on a circle, which is a conic: neither */
    const double turn = 2.0 * acos(-1.0) / 7.0;
    for (int i = 0; i < 7; i++)
    {
        points[0][i] = (float)cos(turn * i);
        points[1][i] = (float)sin(turn * i);
        points[2][i] = 2.0f;
    }
    ck_assert_int_eq(cm_depth_error_plane(7, point_planes, &plane), CM_OK);
    REQUIRE(isnan(plane.curvature[0]) && isnan(plane.curvature[1]), "%g", plane.curvature[0]);
}
END_TEST

/* A step that is a column off, and one that only depth has. */
START_TEST(edges_are_matched_within_reach)
{
    float truth[8 * 6], depth[8 * 6];
    for (int i = 0; i < 48; i++)
    {
        truth[i] = i % 8 < 3 ? 1.0f : 2.0f;
        depth[i] = (i % 8 < 4 ? 1.0f : 2.0f) * (i / 8 == 0 && i % 8 == 7 ? 1.5f : 1.0f);
    }
    for (uint32_t reach = 0; reach < 2; reach++)
    {
        cm_depth_edges edges = {.size = sizeof edges};
        ck_assert_int_eq(cm_depth_error_edges(8, 6, depth, truth, 0.1, reach, &edges), CM_OK);
        REQUIRE(edges.measured == 8 && edges.true_ones == 6, "%zu", edges.measured);
        REQUIRE(edges.right == (reach ? 6 : 0) && edges.found == (reach ? 6 : 0), "%zu",
                edges.right);
        REQUIRE(edges.precision == (reach ? 0.75 : 0.0) && edges.recall == (reach ? 1.0 : 0.0),
                "%g", edges.precision);
    }
    cm_depth_edges none = {.size = sizeof none};
    for (int i = 0; i < 48; i++)
    {
        depth[i] = i % 2 ? NAN : 1.0f;
    }
    ck_assert_int_eq(cm_depth_error_edges(8, 6, depth, depth, 0.1, 65535, &none), CM_OK);
    REQUIRE(isnan(none.precision) && isnan(none.recall), "%g", none.recall);
    static const double gaps[4] = {0.0, -1.0, NAN, INFINITY};
    for (int i = 0; i < 4; i++)
    {
        ck_assert_int_eq(cm_depth_error_edges(8, 6, depth, truth, gaps[i], 1, &none),
                         CM_ERROR_RANGE);
    }
    ck_assert_int_eq(cm_depth_error_edges(0, 6, depth, truth, 0.1, 1, &none), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_depth_error_edges(65536, 65536, depth, truth, 0.1, 1, &none),
                     CM_ERROR_RANGE);
    ck_assert_int_eq(cm_depth_error_edges(8, 6, depth, truth, 0.1, 65536, &none), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_depth_error_edges(8, 6, NULL, truth, 0.1, 1, &none), CM_ERROR_ARGUMENT);
    none.size = 0;
    ck_assert_int_eq(cm_depth_error_edges(8, 6, depth, truth, 0.1, 1, &none), CM_ERROR_ARGUMENT);
}
END_TEST

/* ---- sparsification ---- */

/* Errors 1, 2, 3, 4: right, reversed and equal confidences, by hand. */
START_TEST(curves_by_hand)
{
    const float truth[4] = {10, 10, 10, 10}, depth[4] = {11, 8, 13, 14};
    const float right[4] = {4, 3, 2, 1}, wrong[4] = {1, 2, 3, 4}, equal[4] = {1, 1, 1, 1};
    const double fraction[4] = {0.0, 0.25, 0.5, 0.875}, best[4] = {2.5, 2.0, 1.5, 1.0};
    const double worst[4] = {2.5, 3.0, 3.5, 4.0};
    double error[4], oracle[4], area;
    ck_assert_int_eq(cm_depth_error_sparsify(4, depth, truth, right, CM_SPARSIFICATION_MAE, 4,
                                             fraction, error, oracle, &area),
                     CM_OK);
    for (int i = 0; i < 4; i++)
    {
        REQUIRE(fabs(error[i] - best[i]) < 1e-15 && fabs(oracle[i] - best[i]) < 1e-15, "%d: %g", i,
                error[i]);
    }
    REQUIRE(fabs(area) < 1e-15, "%g", area);
    ck_assert_int_eq(cm_depth_error_sparsify(4, depth, truth, wrong, CM_SPARSIFICATION_MAE, 4,
                                             fraction, error, oracle, &area),
                     CM_OK);
    for (int i = 0; i < 4; i++)
    {
        REQUIRE(fabs(error[i] - worst[i]) < 1e-15 && fabs(oracle[i] - best[i]) < 1e-15, "%d: %g", i,
                error[i]);
    }
    REQUIRE(fabs(area - (3.0 + 2.0 + 1.0) / 4.0 / 2.5) < 1e-15, "%g", area);
    ck_assert_int_eq(cm_depth_error_sparsify(4, depth, truth, equal, CM_SPARSIFICATION_RMSE, 4,
                                             fraction, error, oracle, &area),
                     CM_OK);
    for (int i = 0; i < 4; i++)
    {
        REQUIRE(fabs(error[i] - sqrt(7.5)) < 1e-15, "%d: %g", i, error[i]);
    }
    REQUIRE(fabs(oracle[2] - sqrt(2.5)) < 1e-15 && area > 0.2, "%g", area);
}
END_TEST

/* A confidence that knows something is between chance and the oracle, and no order of pixels matters. */
START_TEST(curves_are_between_chance_and_oracle)
{
    static float depth[N], truth[N], confidence[N], turned[3][N];
    double fraction[10], error[10], oracle[10], again[10], area, area_again;
    state = 23;
    for (int i = 0; i < N; i++)
    {
        const double sigma = uniform(0.01, 0.1);
        truth[i] = 2.0f;
        depth[i] = (float)(2.0 + sigma * uniform(-1.0, 1.0));
        confidence[i] = (float)(floor(10.0 / sigma) / 10.0); /* many are equal */
    }
    for (int i = 0; i < 10; i++)
    {
        fraction[i] = i * 0.1;
    }
    for (int i = 0; i < N; i++)
    {
        turned[0][i] = depth[N - 1 - i];
        turned[1][i] = truth[N - 1 - i];
        turned[2][i] = confidence[N - 1 - i];
    }
    for (int m = 0; m < 2; m++)
    {
        const cm_sparsification_measure measure = (cm_sparsification_measure)m;
        ck_assert_int_eq(cm_depth_error_sparsify(N, depth, truth, confidence, measure, 10, fraction,
                                                 error, oracle, &area),
                         CM_OK);
        ck_assert_int_eq(cm_depth_error_sparsify(N, turned[0], turned[1], turned[2], measure, 10,
                                                 fraction, again, NULL, &area_again),
                         CM_OK);
        cm_depth_error all = {.size = sizeof all};
        ck_assert_int_eq(cm_depth_error_measure(N, depth, truth, &all), CM_OK);
        REQUIRE(fabs(error[0] - (m ? all.rmse : all.mae)) < 1e-15, "%g", error[0]);
        for (int i = 0; i < 10; i++)
        {
            REQUIRE(error[i] == again[i] && area == area_again, "%d: %g", i, error[i] - again[i]);
            REQUIRE(oracle[i] <= error[i] + 1e-15, "%d: %g", i, oracle[i]);
            REQUIRE(i == 0 || error[i] < error[i - 1], "%d: %g", i, error[i]);
        }
        REQUIRE(area > 0.05 && area < 0.5, "%g", area);
        ck_assert_int_eq(cm_depth_error_sparsify(N, depth, truth, confidence, measure, 0, NULL,
                                                 NULL, NULL, NULL),
                         CM_OK);
    }
}
END_TEST

START_TEST(curves_of_nothing_are_refused)
{
    const float one[2] = {1, 2}, none[2] = {NAN, NAN};
    const double good = 0.5, bad[4] = {1.0, -0.1, NAN, INFINITY};
    double error = 3.0, area;
    const cm_sparsification_measure mae = CM_SPARSIFICATION_MAE;
    ck_assert_int_eq(cm_depth_error_sparsify(2, one, one, one, mae, 1, &good, &error, NULL, &area),
                     CM_OK);
    REQUIRE(error == 0.0 && area == 0.0, "%g", area);
    error = 3.0;
    ck_assert_int_eq(cm_depth_error_sparsify(2, one, one, none, mae, 1, &good, &error, NULL, &area),
                     CM_ERROR_RANK);
    ck_assert_int_eq(
        cm_depth_error_sparsify(0, NULL, NULL, NULL, mae, 1, &good, &error, NULL, &area),
        CM_ERROR_RANK);
    ck_assert_int_eq(cm_depth_error_sparsify(2, one, none, one, mae, 1, &good, &error, NULL, &area),
                     CM_ERROR_RANK);
    for (int i = 0; i < 4; i++)
    {
        ck_assert_int_eq(
            cm_depth_error_sparsify(2, one, one, one, mae, 1, &bad[i], &error, NULL, &area),
            CM_ERROR_RANGE);
    }
    ck_assert_int_eq(cm_depth_error_sparsify(2, one, one, one, (cm_sparsification_measure)2, 1,
                                             &good, &error, NULL, &area),
                     CM_ERROR_RANGE);
    ck_assert_int_eq(cm_depth_error_sparsify(2, one, one, NULL, mae, 1, &good, &error, NULL, &area),
                     CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_depth_error_sparsify(2, one, one, one, mae, 1, NULL, &error, NULL, &area),
                     CM_ERROR_ARGUMENT);
    REQUIRE(error == 3.0, "%g", error);
}
END_TEST

/* ---- eq. 1 ---- */

/* The chapter's set-up: 1 m, corners 85 mm apart, a tenth of a pixel of 40 um, 10 mm. One distance between two corners is
 * 9.50 mm off; the 0.73 mm that are printed are that by the root of 169 corners, 13 x 13. */
START_TEST(the_checkerboard_of_the_chapter)
{
    const double e = cm_depth_error_checkerboard(1.0, 0.085, 0.010, 0.1 * 40e-6);
    REQUIRE(fabs(e - 9.501e-3) < 1e-6, "%.9g", e);
    REQUIRE(fabs(e / sqrt(169.0) - 0.73e-3) < 0.005e-3, "%g", e / 13.0);
    /* by the intercept theorem itself: corners that seem closer by two errors seem farther */
    const double projected = 0.085 * 0.010, seen = projected - 2.0 * 4e-6;
    REQUIRE(fabs(e - (0.085 * 0.010 / seen - 1.0)) < 1e-14, "%g", e);
}
END_TEST

START_TEST(no_checkerboard_has_no_error)
{
    REQUIRE(cm_depth_error_checkerboard(1.0, 0.085, 0.01, 0.0) == 0.0, "none");
    REQUIRE(isnan(cm_depth_error_checkerboard(1.0, 0.085, 0.01, 0.0005)), "hidden");
    REQUIRE(isnan(cm_depth_error_checkerboard(0.0, 0.085, 0.01, 1e-6)), "distance");
    REQUIRE(isnan(cm_depth_error_checkerboard(1.0, -0.085, 0.01, 1e-6)), "spacing");
    REQUIRE(isnan(cm_depth_error_checkerboard(1.0, 0.085, 0.0, 1e-6)), "focal length");
    REQUIRE(isnan(cm_depth_error_checkerboard(1.0, 0.085, 0.01, -1e-6)), "error");
    REQUIRE(isnan(cm_depth_error_checkerboard(NAN, 0.085, 0.01, 1e-6)), "NaN");
}
END_TEST

/* ---- bad input ---- */

START_TEST(what_is_none_is_refused)
{
    const float one[2] = {1, 2}, none[2] = {NAN, -1.0f};
    cm_depth_error error = {.size = sizeof error};
    float local[2];
    double number = 0.5, got = 3.0;
    const double bad[3] = {-0.1, 1.1, NAN};
    ck_assert_int_eq(cm_depth_error_local(2, NULL, one, local), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_depth_error_local(2, one, one, NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_depth_error_local(0, NULL, NULL, NULL), CM_OK);
    ck_assert_int_eq(cm_depth_error_measure(2, one, NULL, &error), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_depth_error_measure(2, one, one, NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_depth_error_measure(2, one, none, &error), CM_ERROR_RANK);
    ck_assert_int_eq(cm_depth_error_measure(0, NULL, NULL, &error), CM_ERROR_RANK);
    error.size = 1;
    ck_assert_int_eq(cm_depth_error_measure(2, one, one, &error), CM_ERROR_ARGUMENT);
    REQUIRE(error.count == 0, "written");
    ck_assert_int_eq(cm_depth_error_quantiles(2, one, one, 1, NULL, &got), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_depth_error_quantiles(2, NULL, one, 1, &number, &got), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_depth_error_quantiles(2, one, none, 1, &number, &got), CM_ERROR_RANK);
    ck_assert_int_eq(cm_depth_error_bad(2, one, one, 1, &number, NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_depth_error_bad(2, one, none, 1, &number, &got), CM_ERROR_RANK);
    for (int i = 0; i < 3; i++)
    {
        ck_assert_int_eq(cm_depth_error_quantiles(2, one, one, 1, &bad[i], &got), CM_ERROR_RANGE);
        ck_assert_int_eq(cm_depth_error_bad(2, one, one, 1, &bad[i], &got),
                         i == 1 ? CM_OK : CM_ERROR_RANGE);
    }
    REQUIRE(got == 0.0, "%g", got); /* of the limit 1.1 */
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {a_few_pixels_by_hand,
                                  the_square_is_of_bias_and_deviation,
                                  time_has_means_and_deviations,
                                  slopes_are_angles,
                                  planes_are_found,
                                  bent_walls_have_curvatures,
                                  what_is_no_plane_is_refused,
                                  edges_are_matched_within_reach,
                                  curves_by_hand,
                                  curves_are_between_chance_and_oracle,
                                  curves_of_nothing_are_refused,
                                  the_checkerboard_of_the_chapter,
                                  no_checkerboard_has_no_error,
                                  what_is_none_is_refused,
                                  NULL};
    return run_suite("depth error", tests);
}
