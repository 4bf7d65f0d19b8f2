/* SPDX-License-Identifier: MIT
 *
 * Bad points among good ones, and no points at all. What single points and numbers may be is tested in
 * signs.c.
 */
#include "tests/suite.h"

static int all_nan(const double *values, int count)
{
    int all = 1;
    for (int i = 0; i < count; i++)
    {
        all &= isnan(values[i]) != 0;
    }
    return all;
}

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

START_TEST(no_direction_has_no_longitude)
{
    static const double bad[] = {(double)NAN, (double)INFINITY, -(double)INFINITY};
    for (int k = 0; k < 4; k++)
    {
        for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++)
        {
            double direction[3] = {0.0, 0.0, 0.0};
            double lonlat[2] = {7.0, 7.0};
            if (k < 3)
            {
                direction[(k + 1) % 3] = 1.0;
                direction[k] = bad[i];
            }
            cm_lonlat_from_direction(direction, lonlat);
            ck_assert(isnan(lonlat[0]) && isnan(lonlat[1]));
        }
    }
}
END_TEST

static void check_warp_alone(const cm_mapping *mapping)
{
    const double from[2] = {0.25, -0.5};
    double to[2] = {7.0, -7.0};
    float to_f32[2] = {7.0F, -7.0F};
    int has_none = cm_mapping_describe(mapping)->family == CM_FAMILY_HYBRID;
    cm_status expected = has_none ? CM_ERROR_UNSUPPORTED : CM_OK;
    ck_assert_int_eq(cm_warp(mapping, from, to), expected);
    ck_assert_int_eq(cm_unwarp(mapping, from, to), expected);
    ck_assert_int_eq(cm_warp_f32(mapping, (float[2]){0.25F, -0.5F}, to_f32), expected);
    ck_assert_int_eq(cm_unwarp_f32(mapping, (float[2]){0.25F, -0.5F}, to_f32), expected);
    ck_assert_int_eq(to[0] == 7.0 && to[1] == -7.0, has_none);
    ck_assert_int_eq(to_f32[0] == 7.0F && to_f32[1] == -7.0F, has_none);
}

START_TEST(mappings_without_a_warp_say_so)
{
    for_every_mapping(check_warp_alone);
}
END_TEST

int main(void)
{
    const TTest *tests[] = {bad_among_good, no_points, no_direction_has_no_longitude,
                            mappings_without_a_warp_say_so, NULL};
    return run_suite("robustness", tests);
}
