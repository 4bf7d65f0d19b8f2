/* SPDX-License-Identifier: MIT
 *
 * Input that is not a point: NaN, infinities, zero, faces that there are not, coordinates outside.
 */
#include "suite.h"

static int all_nan(const double *values, int count)
{
    int all = 1;
    for (int i = 0; i < count; i++)
    {
        all &= isnan(values[i]) != 0;
    }
    return all;
}

static const double odd[] = {0.0,     -0.0,  1.0,     -1.0,     0.5,      1e-300,    5e-324,
                             -5e-324, 1e300, 1.7e308, -1.7e308, INFINITY, -INFINITY, NAN};
#define ODD (sizeof odd / sizeof odd[0])

static void check_odd_directions(const cm_mapping *mapping)
{
    for (size_t n = 0; n < ODD * ODD * ODD; n++)
    {
        double direction[3] = {odd[n % ODD], odd[n / ODD % ODD], odd[n / ODD / ODD]};
        float narrow[3] = {(float)direction[0], (float)direction[1], (float)direction[2]};
        double uv[2] = {7.0, 7.0};
        float narrow_uv[2] = {7.0f, 7.0f};
        int good = 1;
        int narrow_good = 1;
        int zero = 1;
        int narrow_zero = 1;
        for (int k = 0; k < 3; k++)
        {
            good &= isfinite(direction[k]) != 0;
            narrow_good &= isfinite(narrow[k]) != 0;
            zero &= direction[k] == 0.0;
            narrow_zero &= narrow[k] == 0.0f;
        }
        uint8_t face = cm_forward(mapping, direction, uv);
        uint8_t narrow_face = cm_forward_f32(mapping, narrow, narrow_uv);
        if (good && !zero)
        {
            ck_assert_msg(face < 6 && fabs(uv[0]) <= 1.0 && fabs(uv[1]) <= 1.0,
                          "%s: %g %g %g: %d %g %g", cm_mapping_describe(mapping)->identifier,
                          direction[0], direction[1], direction[2], face, uv[0], uv[1]);
        }
        else
        {
            ck_assert_int_eq(face, CM_NO_FACE);
            ck_assert(all_nan(uv, 2));
        }
        if (narrow_good && !narrow_zero)
        {
            ck_assert(narrow_face < 6 && fabsf(narrow_uv[0]) <= 1.0f &&
                      fabsf(narrow_uv[1]) <= 1.0f);
        }
        else
        {
            ck_assert_int_eq(narrow_face, CM_NO_FACE);
            ck_assert(isnan(narrow_uv[0]) && isnan(narrow_uv[1]));
        }
    }
}

START_TEST(directions_that_are_none)
{
    for_every_mapping(check_odd_directions);
}
END_TEST

static void check_odd_points(const cm_mapping *mapping)
{
    static const double coordinates[] = {0.0,         -0.0,      1.0,          -1.0, 5e-324,
                                         1.0 + 9e-10, 1.000001,  -1.0 - 9e-10, -1.1, 1e300,
                                         INFINITY,    -INFINITY, NAN};
    const size_t count = sizeof coordinates / sizeof coordinates[0];
    for (int face = 0; face < 256; face += face < 9 || face > 250 ? 1 : 40)
    {
        for (size_t n = 0; n < count * count; n++)
        {
            double uv[2] = {coordinates[n % count], coordinates[n / count]};
            double direction[3];
            double clamped[3];
            int good = face < 6 && fabs(uv[0]) <= 1.0 + 1e-9 && fabs(uv[1]) <= 1.0 + 1e-9;
            cm_inverse(mapping, (uint8_t)face, uv, direction);
            if (!good)
            {
                ck_assert(all_nan(direction, 3));
                continue;
            }
            double length = sqrt(direction[0] * direction[0] + direction[1] * direction[1] +
                                 direction[2] * direction[2]);
            ck_assert_msg(fabs(length - 1.0) < 1e-15, "%s",
                          cm_mapping_describe(mapping)->identifier);
            double edge[2] = {fmax(-1.0, fmin(1.0, uv[0])), fmax(-1.0, fmin(1.0, uv[1]))};
            cm_inverse(mapping, (uint8_t)face, edge, clamped);
            ck_assert(memcmp(direction, clamped, sizeof clamped) == 0);
        }
    }
}

START_TEST(points_that_are_none)
{
    for_every_mapping(check_odd_points);
}
END_TEST

/* one bad point among good ones spoils nothing but itself */
static void check_mixed(const cm_mapping *mapping)
{
    enum
    {
        n = 515
    };
    static double x[n], y[n], z[n], u[n], v[n], bx[n], by[n], bz[n];
    static uint8_t face[n];
    uint64_t state = 9;
    for (size_t i = 0; i < n; i++)
    {
        double direction[3];
        next_direction(&state, direction);
        x[i] = direction[0];
        y[i] = i % 5 == 3 ? (double)NAN : direction[1];
        z[i] = i % 7 == 6 ? (double)INFINITY : direction[2];
    }
    cm_forward_array(mapping, n, x, y, z, face, u, v);
    cm_inverse_array(mapping, n, face, u, v, bx, by, bz);
    for (size_t i = 0; i < n; i++)
    {
        double direction[3] = {x[i], y[i], z[i]};
        double back[3] = {bx[i], by[i], bz[i]};
        if (i % 5 == 3 || i % 7 == 6)
        {
            ck_assert_int_eq(face[i], CM_NO_FACE);
            ck_assert(isnan(u[i]) && isnan(v[i]) && all_nan(back, 3));
        }
        else
        {
            ck_assert_int_lt(face[i], 6);
            ck_assert(earth_metres(direction, back) < 5e-9);
        }
    }
}

START_TEST(bad_among_good)
{
    for_every_mapping(check_mixed);
}
END_TEST

static void check_nothing(const cm_mapping *mapping)
{
    cm_forward_array(mapping, 0, NULL, NULL, NULL, NULL, NULL, NULL);
    cm_inverse_array(mapping, 0, NULL, NULL, NULL, NULL, NULL, NULL);
    cm_forward_strided(mapping, 0, NULL, 3, NULL, NULL, NULL);
    cm_inverse_strided(mapping, 0, NULL, NULL, NULL, NULL, 3);
    cm_forward_array_f32(mapping, 0, NULL, NULL, NULL, NULL, NULL, NULL);
    cm_inverse_array_f32(mapping, 0, NULL, NULL, NULL, NULL, NULL, NULL);
    cm_forward_strided_f32(mapping, 0, NULL, 3, NULL, NULL, NULL);
    cm_inverse_strided_f32(mapping, 0, NULL, NULL, NULL, NULL, 3);
}

START_TEST(no_points)
{
    for_every_mapping(check_nothing);
}
END_TEST

/* the warp alone has the same tolerance, and exact edges and corners */
static void check_warps(const cm_mapping *mapping)
{
    static const double ends[] = {1.0, -1.0};
    double to[2] = {7.0, 7.0};
    double from[2] = {0.5, 0.25};
    if (cm_mapping_describe(mapping)->family == CM_FAMILY_HYBRID)
    {
        ck_assert_int_eq(cm_warp(mapping, from, to), CM_ERROR_UNSUPPORTED);
        ck_assert_int_eq(cm_unwarp(mapping, from, to), CM_ERROR_UNSUPPORTED);
        ck_assert(to[0] == 7.0 && to[1] == 7.0);
        return;
    }
    for (int i = 0; i < 200; i++)
    {
        double end = ends[i & 1];
        double along = (i / 2 - 50) / 50.0;
        const double edge[2][2] = {{end, along}, {along, end}};
        for (int k = 0; k < 2; k++)
        {
            ck_assert_int_eq(cm_warp(mapping, edge[k], to), CM_OK);
            ck_assert_msg(to[k] == end, "%s: %.17g", cm_mapping_describe(mapping)->identifier,
                          to[k]);
            ck_assert_int_eq(cm_unwarp(mapping, edge[k], to), CM_OK);
            ck_assert_msg(to[k] == end, "%s: %.17g", cm_mapping_describe(mapping)->identifier,
                          to[k]);
        }
    }
    from[0] = 1.0 + 2e-9;
    ck_assert_int_eq(cm_warp(mapping, from, to), CM_OK);
    ck_assert(all_nan(to, 2));
    from[0] = (double)NAN;
    ck_assert_int_eq(cm_unwarp(mapping, from, to), CM_OK);
    ck_assert(all_nan(to, 2));
}

START_TEST(warps_at_the_edge)
{
    for_every_mapping(check_warps);
}
END_TEST

int main(void)
{
    const TTest *tests[] = {directions_that_are_none, points_that_are_none,
                            bad_among_good,           no_points,
                            warps_at_the_edge,        NULL};
    return run_suite("robustness", tests);
}
