/* SPDX-License-Identifier: MIT
 *
 * Spherical harmonics: what defines them, by quadrature that is exact, and sums that are known.
 */
#include <cubemap/environment.h>

#include <float.h>

#include "tests/suite.h"

#define PI 3.14159265358979323846

/* The same numbers in every run, from -1 to 1. */
static uint64_t state = 1;

static double next_number(void)
{
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (double)(int64_t)(state >> 11) / 4503599627370496.0 - 1.0;
}

static double *numbers(size_t count)
{
    double *values = malloc(count * sizeof *values);
    ck_assert_ptr_nonnull(values);
    for (size_t i = 0; i < count; i++)
    {
        values[i] = next_number();
    }
    return values;
}

/* ---------------------------------------------------------------- quadrature on the sphere */

/* Legendre's polynomial of a degree, and its derivative. */
static double legendre(uint32_t degree, double x, double *slope)
{
    double last = 0.0;
    double value = 1.0;
    for (uint32_t l = 0; l < degree; l++)
    {
        const double next = ((2.0 * l + 1.0) * x * value - l * last) / (l + 1.0);
        last = value;
        value = next;
    }
    if (slope != NULL)
    {
        *slope = degree * (last - x * value) / (1.0 - x * x);
    }
    return value;
}

/* Points and weights that integrate products of two functions of that degree exactly. */
typedef struct sphere_rule
{
    size_t count;
    double *x, *y, *z, *weight;
} sphere_rule;

static sphere_rule make_rule(uint32_t degree)
{
    const uint32_t rings = degree + 1;
    const uint32_t round = 2 * degree + 1;
    sphere_rule rule = {(size_t)rings * round, NULL, NULL, NULL, NULL};
    rule.x = numbers(4 * rule.count);
    rule.y = rule.x + rule.count;
    rule.z = rule.y + rule.count;
    rule.weight = rule.z + rule.count;
    size_t k = 0;
    for (uint32_t i = 0; i < rings; i++)
    {
        double slope = 0.0;
        double z = cos(PI * (i + 0.75) / (rings + 0.5));
        for (int turn = 0; turn < 8; turn++)
        {
            const double value = legendre(rings, z, &slope);
            z -= value / slope;
        }
        legendre(rings, z, &slope);
        const double weight = 2.0 / ((1.0 - z * z) * slope * slope) * 2.0 * PI / round;
        for (uint32_t j = 0; j < round; j++, k++)
        {
            const double lon = 2.0 * PI * (j + 0.3) / round;
            rule.x[k] = sqrt(1.0 - z * z) * cos(lon);
            rule.y[k] = sqrt(1.0 - z * z) * sin(lon);
            rule.z[k] = z;
            rule.weight[k] = weight;
        }
    }
    return rule;
}

START_TEST(the_basis_is_orthonormal)
{
    const uint32_t degree = is_quick() ? 6 : 14;
    const size_t count = cm_harmonics_count(degree);
    sphere_rule rule = make_rule(degree);
    double *value = malloc(rule.count * count * sizeof *value);
    ck_assert_int_eq(cm_harmonics_basis(degree, rule.count, rule.x, rule.y, rule.z, value), CM_OK);
    for (size_t a = 0; a < count; a++)
    {
        for (size_t b = 0; b <= a; b++)
        {
            double sum = 0.0;
            for (size_t k = 0; k < rule.count; k++)
            {
                sum += rule.weight[k] * value[k * count + a] * value[k * count + b];
            }
            REQUIRE(fabs(sum - (a == b)) < 1e-13, "%zu, %zu: %g", a, b, sum);
        }
    }
    free(value);
    free(rule.x);
}
END_TEST

/* Of a high degree, with functions of one order, which alone could be near each other. */
START_TEST(high_degrees_are_orthonormal)
{
    const uint32_t degree = is_quick() ? 40 : 120;
    const size_t count = cm_harmonics_count(degree);
    sphere_rule rule = make_rule(degree);
    static const uint32_t orders[] = {0, 1, 7, 39};
    const size_t some = 64;
    double *sums = calloc(4 * (degree + 1), sizeof *sums);
    double *value = malloc(some * count * sizeof *value);
    for (size_t k = 0; k < rule.count; k++)
    {
        if (k % some == 0)
        {
            const size_t n = rule.count - k < some ? rule.count - k : some;
            cm_harmonics_basis(degree, n, rule.x + k, rule.y + k, rule.z + k, value);
        }
        const double *one = value + k % some * count;
        const double *top = one + (size_t)degree * (degree + 1);
        for (size_t o = 0; o < 4; o++)
        {
            for (uint32_t l = orders[o]; l <= degree; l++)
            {
                sums[o * (degree + 1) + l] +=
                    rule.weight[k] * top[orders[o]] * one[(size_t)l * (l + 1) + orders[o]];
            }
        }
    }
    for (size_t o = 0; o < 4; o++)
    {
        for (uint32_t l = orders[o]; l <= degree; l++)
        {
            REQUIRE(fabs(sums[o * (degree + 1) + l] - (l == degree)) < 1e-11, "%u, %u: %g", l,
                    orders[o], sums[o * (degree + 1) + l]);
        }
    }
    free(value);
    free(sums);
    free(rule.x);
}
END_TEST

START_TEST(the_first_functions_are_known)
{
    static const double lengths[] = {1.0, 1e-300, 1e300};
    for (int turn = 0; turn < 60; turn++)
    {
        const double x = next_number();
        const double y = next_number();
        const double z = next_number();
        const double r = sqrt(x * x + y * y + z * z);
        const double a = x / r;
        const double b = y / r;
        const double c = z / r;
        const double one = sqrt(3.0 / (4.0 * PI));
        const double two = sqrt(15.0 / (4.0 * PI));
        const double expected[9] = {sqrt(0.25 / PI),
                                    one * b,
                                    one * c,
                                    one * a,
                                    two * a * b,
                                    two * b * c,
                                    sqrt(5.0 / (16.0 * PI)) * (3.0 * c * c - 1.0),
                                    two * a * c,
                                    0.5 * two * (a * a - b * b)};
        const double length = lengths[turn % 3];
        const double direction[3] = {x * length, y * length, z * length};
        double value[9];
        ck_assert_int_eq(cm_harmonics_basis(2, 1, direction, direction + 1, direction + 2, value),
                         CM_OK);
        for (size_t k = 0; k < 9; k++)
        {
            REQUIRE(fabs(value[k] - expected[k]) < 1e-15 * 8.0, "%zu: %g, not %g", k, value[k],
                    expected[k]);
        }
    }
}
END_TEST

/* The sum over m of Y(l, m) at two places is (2 l + 1) / (4 pi) P_l of the cosine between them. Near the poles an eps
 * of the cosine is l^2 / 2 eps of the sum. */
static void check_addition(uint32_t degree, const double a[3], const double b[3])
{
    const size_t count = cm_harmonics_count(degree);
    double *value = malloc(2 * count * sizeof *value);
    const double x[2] = {a[0], b[0]};
    const double y[2] = {a[1], b[1]};
    const double z[2] = {a[2], b[2]};
    ck_assert_int_eq(cm_harmonics_basis(degree, 2, x, y, z, value), CM_OK);
    const long double aa =
        (long double)a[0] * a[0] + (long double)a[1] * a[1] + (long double)a[2] * a[2];
    const long double bb =
        (long double)b[0] * b[0] + (long double)b[1] * b[1] + (long double)b[2] * b[2];
    const long double ab =
        (long double)a[0] * b[0] + (long double)a[1] * b[1] + (long double)a[2] * b[2];
    const long double cosine = ab / sqrtl(aa * bb);
    long double last = 0.0L;
    long double polynomial = 1.0L;
    for (uint32_t l = 0; l <= degree; l++)
    {
        double sum = 0.0;
        for (size_t k = (size_t)l * l; k < ((size_t)l + 1) * (l + 1); k++)
        {
            sum += value[k] * value[count + k];
        }
        const double expected = (2.0 * l + 1.0) / (4.0 * PI) * (double)polynomial;
        const double bound = (2.0 * l + 1.0) / (4.0 * PI) * DBL_EPSILON * (50.0 + 0.5 * l * l);
        REQUIRE(fabs(sum - expected) < bound, "%u at %g %g %g: %.17g, not %.17g", l, a[0], a[1],
                a[2], sum, expected);
        const long double next = ((2.0L * l + 1.0L) * cosine * polynomial - l * last) / (l + 1.0L);
        last = polynomial;
        polynomial = next;
    }
    free(value);
}

START_TEST(high_degrees_obey_the_addition_theorem)
{
    static const double places[][3] = {
        {0, 0, 1},       {0, 0, -1},         {1, 0, 0},       {0, -1, 0},
        {1, 1, 1},       {-1, 1, -1},        {1e-300, 0, 1},  {1e-160, 1e-160, -1},
        {1e-9, 1e-9, 1}, {1e-3, 2e-3, 1},    {0.1, -0.05, 1}, {0.4, 0.1, 0.9},
        {1, 0, 1e-300},  {1, 1e-300, 1e-12}, {-1, 1e-12, 0}};
    const size_t count = sizeof places / sizeof *places;
    const uint32_t degree = is_long() ? CM_HARMONICS_DEGREE_MAX : is_quick() ? 120 : 1000;
    for (size_t i = 0; i < count; i++)
    {
        check_addition(degree, places[i], places[i]);
        check_addition(degree, places[i], places[(i + 4) % count]);
    }
}
END_TEST

START_TEST(what_is_no_direction_is_nan)
{
    const double bad[] = {0.0, (double)NAN, (double)INFINITY, -(double)INFINITY};
    double value[4];
    const double coefficients[4] = {1, 2, 3, 4};
    for (size_t i = 0; i < 4; i++)
    {
        const double x[2] = {bad[i], 1.0};
        const double y[2] = {0.0, 2.0};
        const double z[2] = {0.0, 3.0};
        double sum[2];
        cm_harmonics_basis(1, 1, x, y, z, value);
        cm_harmonics_evaluate(1, 1, coefficients, 2, x, y, z, sum);
        for (size_t k = 0; k < 4; k++)
        {
            ck_assert(isnan(value[k]));
        }
        ck_assert(isnan(sum[0]) && isfinite(sum[1]));
    }
}
END_TEST

START_TEST(sums_are_those_of_the_basis)
{
    const uint32_t degree = 9;
    const size_t count = cm_harmonics_count(degree);
    const size_t n = 131; /* two blocks and a part of one */
    double *at = numbers(3 * n);
    double *value = malloc(n * count * sizeof *value);
    ck_assert_int_eq(cm_harmonics_basis(degree, n, at, at + n, at + 2 * n, value), CM_OK);
    for (uint32_t channels = 1; channels <= 4; channels++)
    {
        double *coefficients = numbers(count * channels);
        double sums[131 * 4];
        ck_assert_int_eq(
            cm_harmonics_evaluate(degree, channels, coefficients, n, at, at + n, at + 2 * n, sums),
            CM_OK);
        for (size_t i = 0; i < n; i++)
        {
            for (uint32_t c = 0; c < channels; c++)
            {
                double sum = 0.0;
                for (size_t k = 0; k < count; k++)
                {
                    sum += value[i * count + k] * coefficients[k * channels + c];
                }
                REQUIRE(fabs(sum - sums[i * channels + c]) < 1e-13, "%zu: %g", i, sum);
            }
        }
        free(coefficients);
    }
    free(value);
    free(at);
}
END_TEST

/* ---------------------------------------------------------------- rotations */

static double norm_of(uint32_t l, const double *coefficients)
{
    double sum = 0.0;
    for (size_t k = (size_t)l * l; k < ((size_t)l + 1) * (l + 1); k++)
    {
        sum += coefficients[k] * coefficients[k];
    }
    return sqrt(sum);
}

static const double angles[][3] = {{0, 0, 0},     {90, 0, 0},   {0, 90, 0},
                                   {0, -90, 180}, {180, 0, 90}, {30, 45, 60},
                                   {-77, 1, 3},   {1e-7, 0, 0}, {10, 89.999, -20}};

/* The turned function has the turned one's values. */
static void check_rotation(const cm_rotation *rotation, uint32_t degree)
{
    const size_t count = cm_harmonics_count(degree);
    double *coefficients = numbers(2 * count);
    double *turned = malloc(2 * count * sizeof *turned);
    ck_assert_int_eq(cm_harmonics_rotate(degree, 2, rotation, coefficients, turned), CM_OK);
    for (int turn = 0; turn < 20; turn++)
    {
        const double from[3] = {next_number(), next_number(), next_number()};
        double to[3];
        double before[2];
        double behind[2];
        cm_rotate(rotation, from, to);
        cm_harmonics_evaluate(degree, 2, coefficients, 1, from, from + 1, from + 2, before);
        cm_harmonics_evaluate(degree, 2, turned, 1, to, to + 1, to + 2, behind);
        REQUIRE(fabs(before[0] - behind[0]) < 1e-12 * degree &&
                    fabs(before[1] - behind[1]) < 1e-12 * degree,
                "degree %u: %.17g, not %.17g", degree, behind[0], before[0]);
    }
    /* in place */
    cm_harmonics_rotate(degree, 2, rotation, coefficients, coefficients);
    ck_assert_int_eq(memcmp(coefficients, turned, 2 * count * sizeof *turned), 0);
    free(turned);
    free(coefficients);
}

START_TEST(rotations_turn_values)
{
    for (size_t i = 0; i < sizeof angles / sizeof *angles; i++)
    {
        cm_rotation rotation;
        ck_assert_int_eq(
            cm_rotation_from_angles(angles[i][0], angles[i][1], angles[i][2], &rotation), CM_OK);
        for (uint32_t degree = 1; degree <= 5; degree++)
        {
            check_rotation(&rotation, degree);
        }
        check_rotation(&rotation, is_quick() ? 12 : 40);
    }
}
END_TEST

START_TEST(rotations_keep_the_norm_and_come_back)
{
    const uint32_t degree = is_long() ? 1000 : is_quick() ? 20 : 300;
    const size_t count = cm_harmonics_count(degree);
    double *coefficients = numbers(count);
    double *turned = malloc(count * sizeof *turned);
    for (size_t i = 4; i < sizeof angles / sizeof *angles; i += 2)
    {
        cm_rotation rotation;
        cm_rotation back;
        cm_rotation_from_angles(angles[i][0], angles[i][1], angles[i][2], &rotation);
        for (size_t k = 0; k < 9; k++)
        {
            back.row[k / 3][k % 3] = rotation.row[k % 3][k / 3];
        }
        cm_harmonics_rotate(degree, 1, &rotation, coefficients, turned);
        for (uint32_t l = 0; l <= degree; l++)
        {
            REQUIRE(fabs(norm_of(l, turned) / norm_of(l, coefficients) - 1.0) < 1e-12, "%u", l);
        }
        cm_harmonics_rotate(degree, 1, &back, turned, turned);
        for (size_t k = 0; k < count; k++)
        {
            REQUIRE(fabs(turned[k] - coefficients[k]) < 1e-11, "%zu: %g", k,
                    turned[k] - coefficients[k]);
        }
    }
    free(turned);
    free(coefficients);
}
END_TEST

START_TEST(rotations_by_nothing_are_exact)
{
    const uint32_t degree = 24;
    const size_t count = cm_harmonics_count(degree);
    double *coefficients = numbers(count);
    double *turned = malloc(count * sizeof *turned);
    cm_rotation rotation;
    cm_rotation_from_angles(0, 0, 0, &rotation);
    cm_harmonics_rotate(degree, 1, &rotation, coefficients, turned);
    for (size_t k = 0; k < count; k++)
    {
        REQUIRE(fabs(turned[k] - coefficients[k]) < 1e-14, "%zu", k);
    }
    free(turned);
    free(coefficients);
}
END_TEST

/* ---------------------------------------------------------------- factors */

START_TEST(the_cosine_lobe_is_known)
{
    const double known[] = {PI,  2.0 * PI / 3.0, PI / 4.0, 0.0,        -PI / 24.0,
                            0.0, PI / 64.0,      0.0,      -PI / 128.0};
    double factor[201];
    ck_assert_int_eq(cm_harmonics_cosine_lobe(8, factor), CM_OK);
    for (size_t l = 0; l < 9; l++)
    {
        REQUIRE(fabs(factor[l] - known[l]) < 1e-15, "%zu: %.17g", l, factor[l]);
    }
    /* the lobe comes back as their sum: at 60 degrees it is 1/2 */
    cm_harmonics_cosine_lobe(200, factor);
    double sum = 0.0;
    for (uint32_t l = 0; l <= 200; l++)
    {
        sum += (2.0 * l + 1.0) / (4.0 * PI) * factor[l] * legendre(l, 0.5, NULL);
    }
    REQUIRE(fabs(sum - 0.5) < 1e-4, "%.17g", sum);
}
END_TEST

/* By the trapezoidal rule in many steps that come to rest at both ends. */
static double ggx_factor(uint32_t degree, double roughness)
{
    const int steps = 50000;
    const double a = pow(roughness, 4.0);
    double sum = 0.0;
    double whole = 0.0;
    for (int k = 1; k < steps; k++)
    {
        /* in the logarithm of s / a, which reaches a middle so narrow */
        const double t = (double)k / steps;
        const double x = t * t * t * (10.0 - 15.0 * t + 6.0 * t * t);
        const double s = a * sinh(x * asinh(0.5 / a));
        const double ds = a * cosh(x * asinh(0.5 / a)) * t * t * (1.0 - t) * (1.0 - t);
        const double below = a * (1.0 - s) + s;
        const double weight = (1.0 - 2.0 * s) / (below * below) * ds;
        whole += weight;
        sum += weight * legendre(degree, 1.0 - 2.0 * s, NULL);
    }
    return sum / whole;
}

START_TEST(the_lobe_of_ggx)
{
    static const double roughness[] = {0.05, 0.2, 0.5, 0.8, 1.0};
    double factor[301];
    for (size_t i = 0; i < 5; i += step_of(3))
    {
        ck_assert_int_eq(cm_harmonics_ggx_lobe(300, roughness[i], factor), CM_OK);
        static const uint32_t degrees[] = {0, 1, 2, 7, 40, 300};
        for (size_t k = 0; k < 6; k += step_of(2))
        {
            const double expected = ggx_factor(degrees[k], roughness[i]);
            REQUIRE(fabs(factor[degrees[k]] - expected) < 1e-8, "%g, %u: %.12g, not %.12g",
                    roughness[i], degrees[k], factor[degrees[k]], expected);
        }
    }
    /* at 1 it is the cosine lobe: D is even */
    double cosine[301];
    cm_harmonics_cosine_lobe(300, cosine);
    cm_harmonics_ggx_lobe(300, 1.0, factor);
    for (size_t l = 0; l <= 300; l++)
    {
        REQUIRE(fabs(factor[l] - cosine[l] / PI) < 1e-13, "%zu: %g", l, factor[l] - cosine[l] / PI);
    }
    cm_harmonics_ggx_lobe(300, 0.0, factor);
    ck_assert(factor[0] == 1.0 && factor[300] == 1.0);
}
END_TEST

/* However small the roughness, its factors are numbers from 0 to 1 which fall with the degree: 1 but for the lobe's width.
 * That grows with the fourth power of roughness, so that the lobe is a point to double precision long before 0. */
START_TEST(the_narrowest_lobes)
{
    double last = 0.0;
    for (int power = 1; power <= 330; power++)
    {
        double factor[101];
        const double roughness = pow(10.0, -power);
        ck_assert_int_eq(cm_harmonics_ggx_lobe(100, roughness, factor), CM_OK);
        ck_assert_double_eq_tol(factor[0], 1.0, 1e-15);
        for (size_t l = 1; l <= 100; l++)
        {
            REQUIRE(factor[l] >= -1e-12 && factor[l] <= factor[l - 1] + 1e-12,
                    "roughness 1e-%d, degree %zu: %.17g after %.17g", power, l, factor[l],
                    factor[l - 1]);
        }
        REQUIRE(factor[100] >= last, "roughness 1e-%d: %.17g", power, factor[100]);
        REQUIRE(power < 5 || factor[100] > 1.0 - 1e-12, "roughness 1e-%d: %.17g", power,
                factor[100]);
        last = factor[100] - 1e-12;
    }
}
END_TEST

START_TEST(windows)
{
    double factor[12];
    ck_assert_int_eq(cm_harmonics_window_factors(CM_WINDOW_HANNING, 4.0, 11, factor), CM_OK);
    ck_assert(factor[0] == 1.0 && fabs(factor[2] - 0.5) < 1e-15 && factor[4] == 0.0 &&
              factor[11] == 0.0);
    ck_assert_int_eq(cm_harmonics_window_factors(CM_WINDOW_LANCZOS, 4.0, 11, factor), CM_OK);
    ck_assert(factor[0] == 1.0 && fabs(factor[2] - 2.0 / PI) < 1e-15 && factor[4] == 0.0 &&
              factor[11] == 0.0);
    ck_assert_int_eq(cm_harmonics_window_factors(CM_WINDOW_NONE, 4.0, 11, factor), CM_OK);
    ck_assert(factor[0] == 1.0 && factor[11] == 1.0);
    /* a point, cut off at degree 11, is negative around; windowed by Hanning it hardly is */
    double least[2] = {0.0, 0.0};
    for (int window = 0; window < 2; window++)
    {
        cm_harmonics_window_factors(window == 0 ? CM_WINDOW_NONE : CM_WINDOW_HANNING, 12.0, 11,
                                    factor);
        for (int k = 0; k <= 400; k++)
        {
            double sum = 0.0;
            for (uint32_t l = 0; l <= 11; l++)
            {
                sum += factor[l] * (2.0 * l + 1.0) * legendre(l, k / 200.0 - 1.0, NULL);
            }
            least[window] = fmin(least[window], sum);
        }
    }
    REQUIRE(least[1] > 0.25 * least[0], "%g, %g", least[0], least[1]);
    double coefficients[2 * 9];
    for (size_t k = 0; k < 18; k++)
    {
        coefficients[k] = 1.0;
    }
    const double by[3] = {2.0, 3.0, 5.0};
    ck_assert_int_eq(cm_harmonics_scale(2, 2, by, coefficients), CM_OK);
    for (size_t k = 0; k < 18; k++)
    {
        ck_assert(coefficients[k] == by[k < 2 ? 0 : k < 8 ? 1 : 2]);
    }
}
END_TEST

/* ---------------------------------------------------------------- JSON */

/* All numbers of a text in its order, from where. */
static size_t numbers_in(const char *text, size_t length, double *values, size_t most)
{
    size_t found = 0;
    for (size_t i = 0; i < length;)
    {
        double value = 0.0;
        const size_t used = cm_number_read(text + i, length - i, &value);
        if (used > 0)
        {
            ck_assert(found < most);
            values[found++] = value;
        }
        i += used > 0 ? used : 1;
    }
    return found;
}

START_TEST(json_comes_back)
{
    const uint32_t degree = 6;
    const size_t count = cm_harmonics_count(degree) * 3;
    double *coefficients = numbers(count);
    double values[200];
    coefficients[0] = 1e-310;
    coefficients[1] = DBL_MAX;
    coefficients[2] = 0.0;
    size_t length = 0;
    ck_assert_int_eq(cm_harmonics_json(degree, 3, coefficients, NULL, 0, &length), CM_ERROR_SPACE);
    char *text = malloc(length + 1);
    memset(text, 'x', length + 1);
    size_t again = 0;
    ck_assert_int_eq(cm_harmonics_json(degree, 3, coefficients, text, length, &again),
                     CM_ERROR_SPACE);
    ck_assert(again == length && text[0] == 'x');
    ck_assert_int_eq(cm_harmonics_json(degree, 3, coefficients, text, length + 1, &again), CM_OK);
    ck_assert(again == length && strlen(text) == length);
    ck_assert_ptr_nonnull(strstr(text, "\"degree\": 6, \"channels\": 3, "));
    const char *list = strstr(text, "\"coefficients\": [");
    ck_assert_ptr_nonnull(list);
    ck_assert_uint_eq(numbers_in(list, strlen(list), values, 200), count);
    ck_assert_int_eq(memcmp(values, coefficients, count * sizeof *values), 0);
    /* brackets and braces are balanced */
    int depth = 0;
    for (size_t i = 0; i < length; i++)
    {
        depth += (text[i] == '[' || text[i] == '{') - (text[i] == ']' || text[i] == '}');
        ck_assert(depth > 0 || i + 2 >= length);
    }
    ck_assert_int_eq(depth, 0);
    coefficients[7] = (double)NAN;
    ck_assert_int_eq(cm_harmonics_json(degree, 3, coefficients, text, length + 1, &again),
                     CM_ERROR_RANGE);
    free(text);
    free(coefficients);
}
END_TEST

/* ---------------------------------------------------------------- arguments */

START_TEST(wrong_arguments)
{
    const uint32_t above = CM_HARMONICS_DEGREE_MAX + 1;
    double one[4] = {1, 0, 0, 0};
    double value[4] = {7, 7, 7, 7};
    size_t length = 7;
    cm_rotation rotation;
    cm_rotation_from_angles(1, 2, 3, &rotation);
    ck_assert_int_eq(cm_harmonics_basis(1, 1, NULL, one, one, value), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_harmonics_basis(above, 1, one, one, one, value), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_harmonics_basis(1, 0, NULL, NULL, NULL, NULL), CM_OK);
    ck_assert_int_eq(cm_harmonics_evaluate(0, 1, NULL, 1, one, one, one, value), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_harmonics_evaluate(0, 0, one, 1, one, one, one, value), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_harmonics_evaluate(0, 5, one, 1, one, one, one, value), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_harmonics_cosine_lobe(1, NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_harmonics_cosine_lobe(above, value), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_harmonics_ggx_lobe(1, -0.1, value), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_harmonics_ggx_lobe(1, (double)NAN, value), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_harmonics_ggx_lobe(1, 0.1, NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_harmonics_window_factors(CM_WINDOW_HANNING, 0.0, 1, value), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_harmonics_window_factors((cm_harmonics_window)3, 1.0, 1, value),
                     CM_ERROR_RANGE);
    ck_assert_int_eq(cm_harmonics_window_factors(CM_WINDOW_NONE, (double)INFINITY, 1, value),
                     CM_ERROR_RANGE);
    ck_assert_int_eq(cm_harmonics_window_factors(CM_WINDOW_NONE, 1.0, 1, NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_harmonics_scale(1, 0, one, value), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_harmonics_scale(1, 1, NULL, value), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_harmonics_rotate(0, 1, NULL, one, value), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_harmonics_rotate(above, 1, &rotation, one, value), CM_ERROR_RANGE);
    rotation.row[0][0] += 0.1;
    ck_assert_int_eq(cm_harmonics_rotate(0, 1, &rotation, one, value), CM_ERROR_ORIENTATION);
    ck_assert_int_eq(cm_harmonics_json(0, 1, NULL, NULL, 0, &length), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_harmonics_json(0, 1, one, NULL, 1, &length), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_harmonics_json(0, 9, one, NULL, 0, &length), CM_ERROR_RANGE);
    ck_assert(value[0] == 7 && value[3] == 7 && length == 7);
}
END_TEST

int main(void)
{
    const TTest *tests[] = {the_basis_is_orthonormal,
                            high_degrees_are_orthonormal,
                            the_first_functions_are_known,
                            high_degrees_obey_the_addition_theorem,
                            what_is_no_direction_is_nan,
                            sums_are_those_of_the_basis,
                            rotations_turn_values,
                            rotations_keep_the_norm_and_come_back,
                            rotations_by_nothing_are_exact,
                            the_cosine_lobe_is_known,
                            the_lobe_of_ggx,
                            the_narrowest_lobes,
                            windows,
                            json_comes_back,
                            wrong_arguments,
                            NULL};
    return run_suite("harmonics", tests);
}
