/* SPDX-License-Identifier: MIT
 *
 * Every mapping of the catalogue, and each at the ends of its parameters' ranges: round trips, that
 * arrays, strides and single points agree to the bit, lon/lat, equal area.
 */
#include "truth/hard_points.h"
#include "tests/suite.h"

#define COUNT 5000

static double random_directions[3][COUNT];

static const char *name_of(const cm_mapping *mapping)
{
    return cm_mapping_describe(mapping)->identifier;
}

static int is_legacy(const cm_mapping *mapping)
{
    return strcmp(name_of(mapping), "cobe") == 0 && cm_mapping_parameter(mapping, 0) == 1.0;
}

/* bounds are those of the standard parameters */
static double bound_metres(const cm_mapping *mapping)
{
    return cm_mapping_describe(mapping)->bounds.round_trip * 0x1p-53 * EARTH_RADIUS;
}

static double round_trip(const cm_mapping *mapping, const double direction[3])
{
    double uv[2];
    double back[3];
    uint8_t face = cm_forward(mapping, direction, uv);
    ck_assert_msg(face < 6, "%s: face %d", name_of(mapping), face);
    ck_assert_msg(fabs(uv[0]) <= 1.0 && fabs(uv[1]) <= 1.0, "%s: %.17g %.17g", name_of(mapping),
                  uv[0], uv[1]);
    cm_inverse(mapping, face, uv, back);
    return earth_metres(direction, back);
}

static void check_random_round_trip(const cm_mapping *mapping)
{
    double worst = 0.0;
    for (size_t i = 0; i < COUNT; i++)
    {
        double direction[3] = {random_directions[0][i], random_directions[1][i],
                               random_directions[2][i]};
        worst = fmax(worst, round_trip(mapping, direction));
    }
    ck_assert_msg(worst <= bound_metres(mapping), "%s: %.3g nm", name_of(mapping), worst * 1e9);
}

START_TEST(round_trip_of_random_directions)
{
    for_every_mapping(check_random_round_trip);
}
END_TEST

/* A few thousand of the hard points, others for each mapping; truth/certificate walks through all. */
static void check_hard_round_trip(const cm_mapping *mapping)
{
    static uint64_t start;
    for (uint64_t i = ++start; i < HARD_DIRECTIONS; i += 211)
    {
        double direction[3];
        hard_direction(i, direction);
        /* zero is no direction, and is among them */
        if (direction[0] != 0.0 || direction[1] != 0.0 || direction[2] != 0.0)
        {
            double error = round_trip(mapping, direction);
            ck_assert_msg(error <= bound_metres(mapping), "%s: %.17g %.17g %.17g: %.3g nm",
                          name_of(mapping), direction[0], direction[1], direction[2], error * 1e9);
        }
    }
}

/* A few ulp inside an edge of the cube, all along it: forward may not leave the square, and inverse
 * must take what forward gives. */
static void check_beside_edges(const cm_mapping *mapping)
{
    uint64_t state = 17;
    for (int i = 0; i < 5000; i++)
    {
        double beside = 1.0 - (double)(i % 40) * 0x1p-53;
        float beside_f32 = 1.0f - (float)(i % 40) * 0x1p-24f;
        double along = next_real(&state);
        double direction[3] = {1.0, i & 64 ? beside : along, i & 64 ? along : beside};
        float narrow[3] = {1.0f, i & 64 ? beside_f32 : (float)along,
                           i & 64 ? (float)along : beside_f32};
        float uv[2];
        float back[3];
        ck_assert(round_trip(mapping, direction) <= bound_metres(mapping));
        uint8_t face = cm_forward_f32(mapping, narrow, uv);
        ck_assert_msg(face < 6 && fabsf(uv[0]) <= 1.0f && fabsf(uv[1]) <= 1.0f,
                      "%s: %.9g %.9g: %.9g %.9g", name_of(mapping), (double)narrow[1],
                      (double)narrow[2], (double)uv[0], (double)uv[1]);
        cm_inverse_f32(mapping, face, uv, back);
        ck_assert(!isnan(back[0]) && !isnan(back[1]) && !isnan(back[2]));
    }
}

START_TEST(beside_the_edges)
{
    for_every_mapping(check_beside_edges);
}
END_TEST

START_TEST(round_trip_of_hard_directions)
{
    for_every_mapping(check_hard_round_trip);
}
END_TEST

static void check_float_round_trip(const cm_mapping *mapping)
{
    for (size_t i = 0; i < COUNT; i++)
    {
        float direction[3] = {(float)random_directions[0][i], (float)random_directions[1][i],
                              (float)random_directions[2][i]};
        float uv[2];
        float back[3];
        uint8_t face = cm_forward_f32(mapping, direction, uv);
        ck_assert_int_lt(face, 6);
        ck_assert(fabsf(uv[0]) <= 1.0f && fabsf(uv[1]) <= 1.0f);
        cm_inverse_f32(mapping, face, uv, back);
        double wide[2][3];
        for (int k = 0; k < 3; k++)
        {
            wide[0][k] = (double)direction[k];
            wide[1][k] = (double)back[k];
        }
        ck_assert_msg(angle_between(wide[0], wide[1]) <= 1e-6, "%s: %g %g %g: %g rad",
                      name_of(mapping), wide[0][0], wide[0][1], wide[0][2],
                      angle_between(wide[0], wide[1]));
    }
}

START_TEST(round_trip_in_float)
{
    for_every_mapping(check_float_round_trip);
}
END_TEST

/* Float against double on the same input, to 8 eps of a float. */
static void check_float_values(const cm_mapping *mapping)
{
    const double bound = 8.0 * 0x1p-24;
    for (size_t i = 0; i < COUNT; i++)
    {
        float direction[3];
        double wide[3];
        float uv[2];
        double wide_uv[2];
        for (int k = 0; k < 3; k++)
        {
            direction[k] = (float)random_directions[k][i];
            wide[k] = (double)direction[k];
        }
        uint8_t face = cm_forward_f32(mapping, direction, uv);
        if (cm_forward(mapping, wide, wide_uv) == face)
        {
            ck_assert_msg(fabs((double)uv[0] - wide_uv[0]) <= bound &&
                              fabs((double)uv[1] - wide_uv[1]) <= bound,
                          "%s: %.9g %.9g %.9g", name_of(mapping), wide[0], wide[1], wide[2]);
        }
        else /* only where two faces are equally near, up to rounding */
        {
            ck_assert(fmin(1.0 - fabs(wide_uv[0]), 1.0 - fabs(wide_uv[1])) < bound);
        }
        for (int k = 0; k < 2; k++)
        {
            wide_uv[k] = (double)uv[k];
        }
        cm_inverse_f32(mapping, face, uv, direction);
        cm_inverse(mapping, face, wide_uv, wide);
        for (int k = 0; k < 3; k++)
        {
            ck_assert_msg(fabs((double)direction[k] - wide[k]) <= bound, "%s: %d %.9g %.9g",
                          name_of(mapping), face, wide_uv[0], wide_uv[1]);
        }
    }
}

START_TEST(float_values)
{
    for_every_mapping(check_float_values);
}
END_TEST

/* Rounding of u, v by half an ulp is magnified by one over the slope at the edge. */
START_TEST(round_trip_over_the_ranges_of_parameters)
{
    for (size_t i = 0; i < cube_count(); i++)
    {
        const cm_mapping_info *info = cm_catalogue_at(i);
        for (size_t k = 0; k < 11 && info->parameter_count > 0; k++)
        {
            const cm_parameter_info *p = &info->parameter[0];
            char text[64];
            double value = p->low + (p->high - p->low) * (double)k / 10.0;
            value = k == 0 && p->low_excluded ? 1e-200 : value;
            snprintf(text, sizeof text, "%s:%s=%.17g", info->identifier, p->name,
                     p->whole ? floor(value) : value);
            cm_mapping *mapping = make_mapping(text, NULL);
            const double edge[2] = {1.0 - 1e-6, 0.0};
            double pq[2];
            ck_assert_int_eq(cm_unwarp(mapping, edge, pq), CM_OK);
            double slope = fmin(1.0, 1e-6 / (1.0 - pq[0]));
            double worst = 0.0;
            for (size_t n = 0; n < COUNT; n++)
            {
                double direction[3] = {random_directions[0][n], random_directions[1][n],
                                       random_directions[2][n]};
                worst = fmax(worst, round_trip(mapping, direction));
            }
            /* without a slope (smoothstep:c=1) only half the digits are left */
            double bound = slope < 0.01 ? sqrt(0x1p-53) * EARTH_RADIUS : fmax(5e-9, 1e-9 / slope);
            ck_assert_msg(worst <= (is_legacy(mapping) ? 1400.0 : bound), "%s: %.3g nm, slope %.3g",
                          text, worst * 1e9, slope);
            cm_mapping_destroy(mapping);
        }
    }
}
END_TEST

/* the inverse as printed is 1.39 km off; the default is not */
START_TEST(legacy_of_cobe)
{
    cm_mapping *legacy = make_mapping("cobe:legacy=1", NULL);
    double worst = 0.0;
    for (size_t n = 0; n < COUNT; n++)
    {
        double direction[3] = {random_directions[0][n], random_directions[1][n],
                               random_directions[2][n]};
        worst = fmax(worst, round_trip(legacy, direction));
    }
    ck_assert_msg(worst > 1300.0 && worst < 1400.0, "%g m", worst);
    cm_mapping_destroy(legacy);
}
END_TEST

static int same_bits(double a, double b)
{
    return memcmp(&a, &b, sizeof a) == 0;
}

/* every batch length around the block's, at odd offsets, against single points */
static void check_arrays(const cm_mapping *mapping)
{
    enum
    {
        most = 600
    };
    static const size_t lengths[] = {0, 1, 2, 3, 5, 31, 255, 256, 257, 511, 513, most};
    static double u[most + 1], v[most + 1], x[most + 1], y[most + 1], z[most + 1];
    static uint8_t face[most + 1];
    for (size_t l = 0; l < sizeof lengths / sizeof lengths[0]; l++)
    {
        size_t n = lengths[l];
        const double *in[3] = {random_directions[0] + l, random_directions[1] + l,
                               random_directions[2] + l};
        u[n] = v[n] = x[n] = y[n] = z[n] = 77.0;
        face[n] = 77;
        cm_forward_array(mapping, n, in[0], in[1], in[2], face, u, v);
        cm_inverse_array(mapping, n, face, u, v, x, y, z);
        for (size_t i = 0; i < n; i++)
        {
            double direction[3] = {in[0][i], in[1][i], in[2][i]};
            double uv[2];
            ck_assert_int_eq(cm_forward(mapping, direction, uv), face[i]);
            ck_assert(same_bits(uv[0], u[i]) && same_bits(uv[1], v[i]));
            cm_inverse(mapping, face[i], uv, direction);
            ck_assert(same_bits(direction[0], x[i]) && same_bits(direction[1], y[i]) &&
                      same_bits(direction[2], z[i]));
        }
        ck_assert(u[n] == 77.0 && v[n] == 77.0 && x[n] == 77.0 && y[n] == 77.0 && z[n] == 77.0 &&
                  face[n] == 77);
    }
}

START_TEST(arrays_agree_with_points)
{
    for_every_mapping(check_arrays);
}
END_TEST

static void check_strides(const cm_mapping *mapping)
{
    enum
    {
        n = 300
    };
    static const ptrdiff_t strides[] = {3, 4, 7, -3, -5};
    static double packed[7 * (n + 1)], out[7 * (n + 1)];
    static double u[n], v[n], expected_u[n], expected_v[n], x[n], y[n], z[n];
    static uint8_t face[n], expected_face[n];
    cm_forward_array(mapping, n, random_directions[0], random_directions[1], random_directions[2],
                     expected_face, expected_u, expected_v);
    cm_inverse_array(mapping, n, expected_face, expected_u, expected_v, x, y, z);
    for (size_t s = 0; s < sizeof strides / sizeof strides[0]; s++)
    {
        ptrdiff_t stride = strides[s];
        ptrdiff_t start = stride < 0 ? -stride * (n - 1) : 0;
        for (size_t i = 0; i < sizeof packed / sizeof packed[0]; i++)
        {
            packed[i] = out[i] = 55.0;
        }
        for (ptrdiff_t i = 0; i < n; i++)
        {
            for (int k = 0; k < 3; k++)
            {
                packed[start + i * stride + k] = random_directions[k][i];
            }
        }
        cm_forward_strided(mapping, n, packed + start, stride, face, u, v);
        cm_inverse_strided(mapping, n, face, u, v, out + start, stride);
        ck_assert(memcmp(face, expected_face, sizeof face) == 0);
        ck_assert(memcmp(u, expected_u, sizeof u) == 0 && memcmp(v, expected_v, sizeof v) == 0);
        for (ptrdiff_t i = 0; i < n; i++)
        {
            double *got = out + start + i * stride;
            ck_assert(same_bits(got[0], x[i]) && same_bits(got[1], y[i]) &&
                      same_bits(got[2], z[i]));
            got[0] = got[1] = got[2] = 55.0;
        }
        for (size_t i = 0; i < sizeof out / sizeof out[0]; i++)
        {
            ck_assert(out[i] == 55.0); /* nothing between the points was written */
        }
    }
}

START_TEST(strides_agree_with_arrays)
{
    for_every_mapping(check_strides);
}
END_TEST

static void check_in_place(const cm_mapping *mapping)
{
    enum
    {
        n = 700
    };
    static double a[3][n], u[n], v[n], x[n], y[n], z[n];
    static uint8_t face[n];
    for (int k = 0; k < 3; k++)
    {
        memcpy(a[k], random_directions[k], sizeof a[k]);
    }
    cm_forward_array(mapping, n, a[0], a[1], a[2], face, u, v);
    cm_inverse_array(mapping, n, face, u, v, x, y, z);
    cm_forward_array(mapping, n, a[0], a[1], a[2], face, a[2], a[0]); /* u over z, v over x */
    ck_assert(memcmp(a[2], u, sizeof u) == 0 && memcmp(a[0], v, sizeof v) == 0);
    cm_inverse_array(mapping, n, face, a[2], a[0], a[0], a[1], a[2]);
    ck_assert(memcmp(a[0], x, sizeof x) == 0 && memcmp(a[1], y, sizeof y) == 0 &&
              memcmp(a[2], z, sizeof z) == 0);
}

START_TEST(arrays_in_place)
{
    for_every_mapping(check_in_place);
}
END_TEST

static void check_float_arrays(const cm_mapping *mapping)
{
    enum
    {
        n = 300
    };
    static float x[n], y[n], z[n], u[n], v[n], bx[n], by[n], bz[n], packed[5 * n], pu[n], pv[n];
    static uint8_t face[n], packed_face[n];
    for (size_t i = 0; i < n; i++)
    {
        packed[5 * i] = x[i] = (float)random_directions[0][i];
        packed[5 * i + 1] = y[i] = (float)random_directions[1][i];
        packed[5 * i + 2] = z[i] = (float)random_directions[2][i];
    }
    cm_forward_array_f32(mapping, n, x, y, z, face, u, v);
    cm_forward_strided_f32(mapping, n, packed, 5, packed_face, pu, pv);
    ck_assert(memcmp(face, packed_face, sizeof face) == 0 && memcmp(u, pu, sizeof u) == 0 &&
              memcmp(v, pv, sizeof v) == 0);
    cm_inverse_array_f32(mapping, n, face, u, v, bx, by, bz);
    cm_inverse_strided_f32(mapping, n, face, u, v, packed, 5);
    for (size_t i = 0; i < n; i++)
    {
        float direction[3] = {x[i], y[i], z[i]};
        float uv[2];
        ck_assert_int_eq(cm_forward_f32(mapping, direction, uv), face[i]);
        ck_assert(uv[0] == u[i] && uv[1] == v[i]);
        cm_inverse_f32(mapping, face[i], uv, direction);
        ck_assert(direction[0] == bx[i] && direction[1] == by[i] && direction[2] == bz[i]);
        ck_assert(memcmp(&packed[5 * i], direction, sizeof direction) == 0);
    }
}

START_TEST(float_arrays_agree_with_points)
{
    for_every_mapping(check_float_arrays);
}
END_TEST

/* A mapping that says it is equal-area is: a small square anywhere on any face has its share of the
 * sphere. By differences, so only to a few digits; creases are stepped over. */
static double area_ratio(const cm_mapping *mapping, uint8_t face, double u, double v, double h)
{
    double corner[4][3];
    for (int i = 0; i < 4; i++)
    {
        double uv[2] = {u + (i & 1 ? h : -h), v + (i & 2 ? h : -h)};
        cm_inverse(mapping, face, uv, corner[i]);
    }
    /* half the cross product of the diagonals */
    double square = 0.0;
    for (int k = 0; k < 3; k++)
    {
        int l = (k + 1) % 3;
        int m = (k + 2) % 3;
        double c = (corner[3][l] - corner[0][l]) * (corner[2][m] - corner[1][m]) -
                   (corner[3][m] - corner[0][m]) * (corner[2][l] - corner[1][l]);
        square += c * c;
    }
    double area_on_sphere = 0.5 * sqrt(square);
    return 4.0 * h * h / area_on_sphere * (4.0 * 3.14159265358979323846 / 24.0);
}

START_TEST(area_is_as_claimed)
{
    for (size_t i = 0; i < cube_count(); i++)
    {
        const cm_mapping_info *info = cm_catalogue_at(i);
        cm_mapping *mapping = make_mapping(info->identifier, NULL);
        double worst = 0.0;
        for (int n = 0; n < 6 * 64; n++)
        {
            double u = (n / 6 % 8 - 3.5) / 4.1;
            double v = (n / 48 - 3.5) / 4.3;
            worst = fmax(worst, fabs(area_ratio(mapping, (uint8_t)(n % 6), u, v, 1e-4) - 1.0));
        }
        if (info->properties & CM_EQUAL_AREA)
        {
            ck_assert_msg(worst < 1e-6, "%s: %g", info->identifier, worst);
        }
        else
        {
            ck_assert_msg(worst > 5e-6, "%s: %g", info->identifier, worst);
        }
        /* what the recommended default promises */
        ck_assert(strcmp(info->identifier, CM_MAPPING_RECOMMENDED) != 0 || worst < 0.0025);
        cm_mapping_destroy(mapping);
    }
}
END_TEST

START_TEST(lonlat)
{
    uint64_t state = 3;
    cm_mapping *mapping = make_mapping("coupled", NULL);
    for (int i = 0; i < COUNT; i++)
    {
        double lon = 3.14159265358979 * next_real(&state);
        double lat = 1.57079632679489 * next_real(&state);
        if (i % 4 == 0)
        {
            lat = copysign(1.5707963267948966 - pow(10.0, -1.0 - i % 16), lat);
        }
        double uv[2];
        double back[2];
        double direction[3];
        double back_direction[3];
        uint8_t face = cm_forward_lonlat(mapping, lon, lat, uv);
        cm_inverse_lonlat(mapping, face, uv, back);
        cm_direction_from_lonlat(lon, lat, direction);
        cm_direction_from_lonlat(back[0], back[1], back_direction);
        ck_assert(earth_metres(direction, back_direction) < 8e-9);
        ck_assert(fabs(lat - back[1]) < 1e-15);
        /* the circle of latitude shrinks towards the pole; the direction's own lon is as good as x */
        cm_lonlat_from_direction(direction, back);
        ck_assert(fabs(lat - back[1]) < 5e-16 && fabs(lon - back[0]) < 9e-16);
    }
    cm_mapping_destroy(mapping);
}
END_TEST

START_TEST(lonlat_at_the_ends)
{
    double direction[3];
    double lonlat_back[2];
    cm_direction_from_lonlat(0.3, 1.5707963267948966 + 5e-10, direction);
    ck_assert(direction[2] == 1.0 && hypot(direction[0], direction[1]) < 1e-16);
    cm_direction_from_lonlat(0.3, 1.5708, direction);
    ck_assert(isnan(direction[0]) && isnan(direction[1]) && isnan(direction[2]));
    cm_direction_from_lonlat((double)INFINITY, 0.0, direction);
    ck_assert(isnan(direction[0]) && isnan(direction[1]) && isnan(direction[2]));
    cm_direction_from_lonlat(0.0, (double)NAN, direction);
    ck_assert(isnan(direction[0]) && isnan(direction[1]) && isnan(direction[2]));
    cm_lonlat_from_direction((const double[3]){0.0, 0.0, -2.0}, lonlat_back);
    ck_assert(lonlat_back[0] == 0.0 && lonlat_back[1] == -1.5707963267948966);
    cm_lonlat_from_direction((const double[3]){1e300, 1e300, 1.5e300}, lonlat_back);
    ck_assert(fabs(lonlat_back[1] - atan(1.5 / sqrt(2.0))) < 3e-16);
    cm_lonlat_from_direction((const double[3]){1e-320, 0.0, 1e-320}, lonlat_back);
    ck_assert(fabs(lonlat_back[1] - 0.7853981633974483) < 3e-16);
    cm_lonlat_from_direction((const double[3]){0.0, 0.0, 0.0}, lonlat_back);
    ck_assert(isnan(lonlat_back[0]) && isnan(lonlat_back[1]));
    cm_lonlat_from_direction((const double[3]){1.0, (double)INFINITY, 0.0}, lonlat_back);
    ck_assert(isnan(lonlat_back[0]) && isnan(lonlat_back[1]));
}
END_TEST

int main(void)
{
    uint64_t state = 1;
    for (size_t i = 0; i < COUNT; i++)
    {
        double direction[3];
        next_direction(&state, direction);
        for (size_t k = 0; k < 3; k++)
        {
            random_directions[k][i] = direction[k];
        }
    }
    const TTest *tests[] = {round_trip_of_random_directions,
                            round_trip_of_hard_directions,
                            beside_the_edges,
                            round_trip_in_float,
                            float_values,
                            round_trip_over_the_ranges_of_parameters,
                            legacy_of_cobe,
                            arrays_agree_with_points,
                            strides_agree_with_arrays,
                            arrays_in_place,
                            float_arrays_agree_with_points,
                            area_is_as_claimed,
                            lonlat,
                            lonlat_at_the_ends,
                            NULL};
    return run_suite("mappings", tests);
}
