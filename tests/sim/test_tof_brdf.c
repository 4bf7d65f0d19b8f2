/* SPDX-License-Identifier: MIT
 *
 * BRDFs: both ways of light are one, no more comes out than went in, and directions are drawn of the density that is told.
 */
#include <cubemap/brdf.h>

#include "tests/suite.h"

#define PI 3.14159265358979323846

static const double up[3] = {0.0, 0.0, 1.0};

static void direction_of(double theta, double azimuth, double d[3])
{
    d[0] = sin(theta) * cos(azimuth);
    d[1] = sin(theta) * sin(azimuth);
    d[2] = cos(theta);
}

static double smooth_value(double in, double out, double azimuth)
{
    const double lobe = 1.0 + 0.3 * sin(in) * sin(out) * cos(azimuth);
    return 0.2 * lobe * (0.5 + 0.5 * cos(in) * cos(out));
}

/* What a gonioreflectometer measures in steps, without what it cannot: the detector before the light, and grazing angles. */
static size_t measure(double step, double (*value)(double, double, double), cm_brdf_sample *sample)
{
    size_t n = 0;
    for (double alpha = -75.0; alpha <= 75.0; alpha += step)
    {
        for (double beta = -150.0; beta <= 150.0; beta += step)
        {
            for (double gamma = 0.0; gamma <= 75.0; gamma += step)
            {
                cm_brdf_sample s;
                cm_brdf_goniometer(alpha * PI / 180.0, beta * PI / 180.0, gamma * PI / 180.0, &s);
                const double most = 80.0 * PI / 180.0;
                if (fabs(beta) > 10.0 && s.theta_in <= most && s.theta_out <= most)
                {
                    s.value = value(s.theta_in, s.theta_out, s.azimuth);
                    sample[n++] = s;
                }
            }
        }
    }
    return n;
}

static double lambert_value(double in, double out, double azimuth)
{
    (void)in;
    (void)out;
    (void)azimuth;
    return 1.0 / PI;
}

static cm_brdf *make_measured(double step, double (*value)(double, double, double))
{
    static cm_brdf_sample sample[20000];
    cm_brdf *brdf = NULL;
    const size_t n = measure(step, value, sample);
    REQUIRE(n > 1000 && n <= 20000, "%zu", n);
    ck_assert_int_eq(cm_brdf_create_measured(n, sample, &brdf), CM_OK);
    return brdf;
}

static cm_brdf *make_facets(double diffuse, double specular, double roughness)
{
    const cm_cook_torrance options = {sizeof options, diffuse, specular, roughness, 2.8, 8.45};
    cm_brdf *brdf = NULL;
    ck_assert_int_eq(cm_brdf_create_cook_torrance(&options, &brdf), CM_OK);
    return brdf;
}

enum
{
    KINDS = 5
};

static cm_brdf *make_kind(int kind)
{
    cm_brdf *brdf = NULL;
    switch (kind)
    {
    case 0:
        ck_assert_int_eq(cm_brdf_create_lambert(&brdf), CM_OK);
        return brdf;
    case 1:
        return make_facets(0.0, 1.0, 0.2);
    case 2:
        return make_facets(0.5, 0.4, 0.5);
    case 3:
        return make_facets(0.2, 0.8, 1.0);
    default:
        return make_measured(10.0, smooth_value);
    }
}

START_TEST(both_ways)
{
    for (int kind = 0; kind < KINDS; kind++)
    {
        cm_brdf *brdf = make_kind(kind);
        double worst = 0.0;
        for (int i = 0; i < 4000; i++)
        {
            double a[3];
            double b[3];
            direction_of(fmod(i * 0.6180339887, 1.0) * 1.57, 0.0, a);
            direction_of(fmod(i * 0.7548776662, 1.0) * 1.57, fmod(i * 0.5698402910, 1.0) * 6.28, b);
            const double one = cm_brdf_value(brdf, up, a, b);
            const double other = cm_brdf_value(brdf, up, b, a);
            ck_assert(one >= 0.0);
            worst = fmax(worst, fabs(one - other) / (one + 1e-6));
        }
        REQUIRE(worst < 1e-9, "kind %d: %g", kind, worst);
        cm_brdf_destroy(brdf);
    }
}
END_TEST

/* The mean of many drawn directions is what is scattered of a furnace's light; the sum of value times cosine over the
 * hemisphere, too; and never is it more than all. */
START_TEST(furnace)
{
    for (int kind = 0; kind < KINDS; kind++)
    {
        cm_brdf *brdf = make_kind(kind);
        for (int k = 0; k < 8; k++)
        {
            const double theta = 0.05 + 0.2 * k;
            const double albedo = cm_brdf_albedo(brdf, theta);
            double out[3];
            double drawn = 0.0;
            double summed = 0.0;
            direction_of(theta, 0.3, out);
            enum
            {
                SIDE = 256
            };
            for (int i = 0; i < SIDE * SIDE; i++)
            {
                const double u[3] = {(i + 0.5) / (SIDE * SIDE), fmod(i * 0.7548776662466927, 1.0),
                                     fmod(i * 0.5698402909980532, 1.0)};
                double in[3];
                double density;
                drawn += cm_brdf_sample_direction(brdf, up, out, u, in, &density);
                const double square = (i / SIDE + 0.5) / SIDE; /* of the sine */
                direction_of(asin(sqrt(square)), (i % SIDE + 0.5) * 2.0 * PI / SIDE, in);
                summed += PI * cm_brdf_value(brdf, up, in, out);
            }
            drawn /= SIDE * SIDE;
            summed /= SIDE * SIDE;
            REQUIRE(fabs(drawn - albedo) < 0.01 && fabs(summed - albedo) < 0.01 && albedo <= 1.0001,
                    "kind %d, %g: drawn %g, summed %g, told %g", kind, theta, drawn, summed,
                    albedo);
        }
        cm_brdf_destroy(brdf);
    }
}
END_TEST

/* The density over the hemisphere, and what is drawn below it, are 1; and it is the one of the drawn. */
START_TEST(densities)
{
    for (int kind = 0; kind < KINDS; kind++)
    {
        cm_brdf *brdf = make_kind(kind);
        for (int k = 0; k < 6; k++)
        {
            enum
            {
                SIDE = 300
            };
            double out[3];
            double sum = 0.0;
            double lost = 0.0;
            double inverse =
                0.0; /* of density: the solid angle of what is drawn around the normal */
            direction_of(0.1 + 0.25 * k, 1.0, out);
            for (int i = 0; i < SIDE * SIDE; i++)
            {
                double in[3];
                double density;
                const double height = (i / SIDE + 0.5) / SIDE;
                const double azimuth = (i % SIDE + 0.5) * 2.0 * PI / SIDE;
                direction_of(acos(height), azimuth, in);
                sum += cm_brdf_density(brdf, up, in, out) * 2.0 * PI / (SIDE * SIDE);
                const double u[3] = {(i + 0.5) / (SIDE * SIDE), fmod(i * 0.7548776662466927, 1.0),
                                     fmod(i * 0.5698402909980532, 1.0)};
                cm_brdf_sample_direction(brdf, up, out, u, in, &density);
                lost += density > 0.0 ? 0.0 : 1.0 / (SIDE * SIDE);
                if (density > 0.0)
                {
                    const double again = cm_brdf_density(brdf, up, in, out);
                    REQUIRE(fabs(again - density) <= 1e-9 * density, "%g %g", again, density);
                    inverse += in[2] > 0.7 ? 1.0 / density / (SIDE * SIDE) : 0.0;
                }
            }
            REQUIRE(fabs(sum + lost - 1.0) < 0.01, "kind %d: %g and %g", kind, sum, lost);
            /* Where facets alone draw, some directions hardly are. */
            REQUIRE(kind == 1 || fabs(inverse - 2.0 * PI * 0.3) < 0.06, "kind %d: %g", kind,
                    inverse);
        }
        cm_brdf_destroy(brdf);
    }
}
END_TEST

/* Gaps of Lambert's law are filled as it is; those of what changes slowly, nearly. */
START_TEST(gaps)
{
    cm_brdf *lambert = make_measured(10.0, lambert_value);
    cm_brdf *smooth = make_measured(5.0, smooth_value);
    double worst[3] = {0.0, 0.0, 0.0}; /* of the last, beyond what is measured */
    for (int i = 0; i < 5000; i++)
    {
        double a[3];
        double b[3];
        const double in = fmod(i * 0.6180339887, 1.0) * 0.5 * PI;
        const double out = fmod(i * 0.7548776662, 1.0) * 0.5 * PI;
        const double azimuth = fmod(i * 0.5698402910, 1.0) * PI;
        direction_of(in, 0.4, a);
        direction_of(out, 0.4 + azimuth, b);
        worst[0] = fmax(worst[0], fabs(cm_brdf_value(lambert, up, a, b) * PI - 1.0));
        const int which = in > 80.0 * PI / 180.0 || out > 80.0 * PI / 180.0 ? 2 : 1;
        const double apart = cm_brdf_value(smooth, up, a, b) / smooth_value(in, out, azimuth);
        worst[which] = fmax(worst[which], fabs(apart - 1.0));
    }
    REQUIRE(worst[0] < 1e-6, "%g", worst[0]);
    REQUIRE(worst[1] < 0.1 && worst[2] < 0.3, "%g %g", worst[1], worst[2]);
    ck_assert(fabs(cm_brdf_albedo(lambert, 0.7) - 1.0) < 1e-6);
    cm_brdf_destroy(lambert);
    cm_brdf_destroy(smooth);
}
END_TEST

/* What is measured is there again, at a place of the table; and once more where the light goes the other way. */
START_TEST(measured_places)
{
    const cm_brdf_sample sample[2] = {{20.0 * PI / 180.0, 40.0 * PI / 180.0, 2.0 * PI / 3.0, 0.3},
                                      {60.0 * PI / 180.0, 10.0 * PI / 180.0, 0.0, 0.1}};
    cm_brdf *brdf = NULL;
    double in[3];
    double out[3];
    ck_assert_int_eq(cm_brdf_create_measured(2, sample, &brdf), CM_OK);
    direction_of(sample[0].theta_in, 0.0, in);
    direction_of(sample[0].theta_out, -sample[0].azimuth, out);
    REQUIRE(fabs(cm_brdf_value(brdf, up, in, out) - 0.3) < 1e-6, "%g",
            cm_brdf_value(brdf, up, in, out));
    REQUIRE(fabs(cm_brdf_value(brdf, up, out, in) - 0.3) < 1e-6, "%g",
            cm_brdf_value(brdf, up, out, in));
    cm_brdf_destroy(brdf);
}
END_TEST

/* Aluminium at 850 nm reflects 87 of 100 at right angles (McPeak and others 2015 have 0.87): (eta-1)^2 + k^2 by
 * (eta+1)^2 + k^2. A plate that is nearly smooth has that albedo. */
START_TEST(aluminium)
{
    const double expected = (1.8 * 1.8 + 8.45 * 8.45) / (3.8 * 3.8 + 8.45 * 8.45);
    cm_brdf *brdf = make_facets(0.0, 1.0, 0.02);
    REQUIRE(fabs(cm_brdf_albedo(brdf, 0.0) - expected) < 1e-3, "%g, not %g",
            cm_brdf_albedo(brdf, 0.0), expected);
    cm_brdf_destroy(brdf);
}
END_TEST

START_TEST(goniometer)
{
    cm_brdf_sample s = {0.0, 0.0, 0.0, 0.0};
    cm_brdf_goniometer(0.3, 0.5, 0.0, &s); /* all in one plane: the normal is between both */
    REQUIRE(fabs(s.theta_in - 0.3) < 1e-12 && fabs(s.theta_out - 0.2) < 1e-12 &&
                fabs(s.azimuth - PI) < 1e-7,
            "%g %g %g", s.theta_in, s.theta_out, s.azimuth);
    cm_brdf_goniometer(-0.3, 0.5, 0.0, &s);
    REQUIRE(fabs(s.theta_in - 0.3) < 1e-12 && fabs(s.theta_out - 0.8) < 1e-12 &&
                fabs(s.azimuth) < 1e-7,
            "%g %g %g", s.theta_in, s.theta_out, s.azimuth);
    cm_brdf_goniometer(0.0, 0.0, 0.4, &s);
    REQUIRE(fabs(s.theta_in - 0.4) < 1e-12 && fabs(s.theta_out - 0.4) < 1e-12 && s.azimuth < 1e-7,
            "%g %g %g", s.theta_in, s.theta_out, s.azimuth);
}
END_TEST

START_TEST(refused)
{
    cm_brdf *brdf = NULL;
    cm_cook_torrance f = {sizeof f, 0.5, 0.5, 0.3, 1.5, 0.0};
    const cm_brdf_sample wrong[] = {{NAN, 0, 0, 1},     {0, 2.0, 0, 1}, {0, 0, INFINITY, 1},
                                    {0, 0, 0, -1},      {0, 0, 0, NAN}, {-0.1, 0, 0, 1},
                                    {0, 0, 0, INFINITY}};
    ck_assert_int_eq(cm_brdf_create_lambert(NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_brdf_create_cook_torrance(NULL, &brdf), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_brdf_create_cook_torrance(&f, NULL), CM_ERROR_ARGUMENT);
    f.diffuse = 0.6;
    ck_assert_int_eq(cm_brdf_create_cook_torrance(&f, &brdf), CM_ERROR_RANGE);
    f.diffuse = NAN;
    ck_assert_int_eq(cm_brdf_create_cook_torrance(&f, &brdf), CM_ERROR_RANGE);
    f.diffuse = 0.5;
    f.size--;
    ck_assert_int_eq(cm_brdf_create_cook_torrance(&f, &brdf), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_brdf_create_measured(0, wrong, &brdf), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_brdf_create_measured(1, NULL, &brdf), CM_ERROR_ARGUMENT);
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
    {
        REQUIRE(cm_brdf_create_measured(1, wrong + i, &brdf) == CM_ERROR_RANGE, "%zu", i);
    }
    ck_assert_ptr_null(brdf);
    ck_assert(cm_brdf_albedo(NULL, NAN) == 0.0);
    cm_brdf_destroy(NULL);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {both_ways, furnace,    densities, gaps, measured_places,
                                  aluminium, goniometer, refused,   NULL};
    return run_suite("time-of-flight brdf", tests);
}
