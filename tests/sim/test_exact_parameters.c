/* SPDX-License-Identifier: MIT
 *
 * What formulas say of walls, spheres and noise, of parameters from all over their ranges.
 */
#include <complex.h>

#include "tof_stage.h"

#define PLANCK 6.62607015e-34

static uint64_t state = 3;

static double between(double low, double high)
{
    state = state * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * (double)(state >> 11) * 0x1p-53;
}

static cm_tof_sensor any_sensor(const cm_camera *camera)
{
    const cm_tof_sensor sensor = {.size = sizeof sensor,
                                  .camera = camera,
                                  .pitch = between(2e-6, 60e-6),
                                  .f_number = between(0.8, 4.0),
                                  .wavelength = between(700e-9, 950e-9),
                                  .efficiency = between(0.05, 1.0),
                                  .exposure = between(1e-4, 2e-2),
                                  .readout = between(0.0, 1e-2),
                                  .frequency = between(5e6, 120e6),
                                  .duty = between(0.1, 1.0),
                                  .contrast = between(0.1, 1.0),
                                  .phases = 3 + (int)between(0.0, 6.0)};
    return sensor;
}

static cm_camera *any_camera(cm_camera_options *shape)
{
    const cm_camera_options any = {.size = sizeof any,
                                   .width = WIDTH,
                                   .height = HEIGHT,
                                   .fx = between(30.0, 200.0),
                                   .fy = between(30.0, 200.0),
                                   .cx = between(20.0, 40.0),
                                   .cy = between(15.0, 30.0)};
    cm_camera *camera = NULL;
    *shape = any;
    ck_assert_int_eq(cm_camera_create(shape, &camera), CM_OK);
    return camera;
}

/* Lambers, Hoberg and Kolb 2015, eqs. 9 to 12, of radiance that comes at an angle from the axis. */
static double electrons_of(const cm_tof_sensor *sensor, double radiance, double cosine)
{
    const double irradiance =
        PI / 4.0 / (sensor->f_number * sensor->f_number) * pow(cosine, 4.0) * radiance;
    const double energy =
        irradiance * sensor->pitch * sensor->pitch * sensor->exposure * sensor->duty;
    return sensor->efficiency * energy * sensor->wavelength / (PLANCK * CM_SPEED_OF_LIGHT);
}

/* The correlation of a phase image: a cosine, or the series of one. */
static double correlation_of(const cm_tof_sensor *sensor, int image, double range)
{
    const double turned = 2.0 * PI * image / sensor->phases +
                          4.0 * PI * range * sensor->frequency / CM_SPEED_OF_LIGHT;
    double sum = sensor->harmonics == 0 ? cos(turned) : 0.0;
    for (size_t j = 0; j < sensor->harmonics; j++)
    {
        sum += sensor->harmonic[j] * cos((double)(j + 1) * turned);
    }
    return sum;
}

/* What a driver makes of correlations: amplitude by the cosine's, and the distance that it tells, which harmonics bend. */
static double told_distance(const cm_tof_sensor *sensor, double range, double *relative)
{
    double x = 0.0, y = 0.0;
    for (int k = 0; k < sensor->phases; k++)
    {
        x += correlation_of(sensor, k, range) * cos(2.0 * PI * k / sensor->phases);
        y -= correlation_of(sensor, k, range) * sin(2.0 * PI * k / sensor->phases);
    }
    *relative = 2.0 / sensor->phases * hypot(x, y);
    return atan2(y, x) / (4.0 * PI * sensor->frequency) * CM_SPEED_OF_LIGHT;
}

/* Charges of a pixel's phase images. */
static void check_charges(const cm_tof_sensor *sensor, size_t pixel, double electrons, double range)
{
    for (int k = 0; k < sensor->phases; k++)
    {
        const double moved = electrons * sensor->contrast * correlation_of(sensor, k, range);
        const size_t j = (size_t)k * PIXELS + pixel;
        ck_assert_double_eq_tol((double)charge_a[j], 0.5 * (electrons + moved),
                                1e-6 * electrons + 1e-30);
        ck_assert_double_eq_tol((double)charge_b[j], 0.5 * (electrons - moved),
                                1e-6 * electrons + 1e-30);
    }
}

/* Lambers, Hoberg and Kolb 2015, eqs. 4 to 11, with electrons as photons times efficiency, in every pixel of walls at any
 * distance, of any reflectance, under cones of any width; every other one's correlation has harmonics, which 3 phases take for
 * the cosine itself. */
START_TEST(all_pixels_of_walls_are_as_worked_out_by_hand)
{
    for (int run = 0; run < 20; run++)
    {
        cm_primitive any = wall;
        cm_camera_options shape;
        any.first[2] = between(0.3, 6.0);
        any.material.reflectance = between(0.05, 1.0);
        stage at = make_stage(&any, 1);
        cm_camera_destroy(at.camera);
        at.camera = any_camera(&shape);
        at.sensor = any_sensor(at.camera);
        const double harmonic[6] = {
            between(0.4, 0.5), between(-0.1, 0.1), between(-0.1, 0.1), between(-0.1, 0.1), 0.0,
            between(-0.1, 0.1)};
        at.sensor.harmonics = run / 2 % 2 == 0 ? 0 : 2 + (size_t)run / 4;
        at.sensor.harmonic = harmonic;
        at.light.power = between(0.01, 5.0);
        at.light.aperture = run % 2 == 0 ? 2.0 * PI : between(0.3, 1.5);
        ck_assert_int_eq(simulate(&at, NULL), CM_OK);
        const double cone = 2.0 * PI * (1.0 - cos(0.5 * at.light.aperture));
        for (size_t i = 0; i < PIXELS; i++)
        {
            const double x = ((double)(i % WIDTH) - shape.cx) / shape.fx;
            const double y = ((double)(i / WIDTH) - shape.cy) / shape.fy;
            const double cosine = 1.0 / sqrt(1.0 + x * x + y * y);
            const double range = any.first[2] / cosine;
            if (fabs(acos(cosine) - 0.5 * at.light.aperture) < 1e-9)
            {
                continue; /* the rim of the cone */
            }
            const double lit = acos(cosine) < 0.5 * at.light.aperture ? 1.0 : 0.0;
            const double radiance = lit * any.material.reflectance / PI * at.light.power / cone *
                                    cosine / (range * range);
            const double electrons = electrons_of(&at.sensor, radiance, cosine);
            const double unambiguous = CM_SPEED_OF_LIGHT / (2.0 * at.sensor.frequency);
            ck_assert_double_eq_tol((double)intensity[i], electrons, 1e-6 * electrons + 1e-30);
            double relative;
            const double told = told_distance(&at.sensor, range, &relative);
            ck_assert_double_eq_tol((double)amplitude[i], relative * at.sensor.contrast * electrons,
                                    1e-6 * electrons + 1e-30);
            check_charges(&at.sensor, i, electrons, range);
            REQUIRE(lit > 0.0 ? fabs(remainder((double)distance[i] - told, unambiguous)) <
                                    1e-6 * unambiguous / (at.sensor.contrast * relative) + 1e-6
                              : isnan(distance[i]),
                    "run %d, pixel %zu: %g m, not %g", run, i, (double)distance[i], told);
            ck_assert(at.sensor.harmonics > 0 || fabs(remainder(told - range, unambiguous)) < 1e-9);
        }
        free_stage(&at);
    }
}
END_TEST

/* Of all pixels, each by what the lens leaves of direct light, cos^4. */
static double complex mean_phasor(void)
{
    double complex sum = 0.0;
    for (size_t i = 0; i < PIXELS; i++)
    {
        const double u = ((double)(i % WIDTH) - 32.0) / 50.0;
        const double v = ((double)(i / WIDTH) - 24.0) / 50.0;
        const double lens = pow(1.0 + u * u + v * v, -2.0);
        sum += ((double)phase[i] - I * (double)phase[PIXELS + i]) / lens;
    }
    return sum / PIXELS;
}

/* Every bounce in a sphere of radius R multiplies the phasor by rho K, K = int_0^2R r / (2 R^2) e^(ikr) dr. */
START_TEST(spheres_of_any_size_are_as_the_integral_says)
{
    for (int run = 0; run < 4; run++)
    {
        const double radius = between(0.2, 4.0), reflectance = between(0.1, 0.7);
        const cm_primitive ball = {.size = sizeof ball,
                                   .kind = CM_PRIMITIVE_SPHERE,
                                   .radius = radius,
                                   .material = {{1, 1, 1}, reflectance}};
        stage at = make_stage(&ball, 1);
        at.sensor.frequency = between(5e6, 60e6);
        const double k = 2.0 * PI * at.sensor.frequency / CM_SPEED_OF_LIGHT, x = k * radius;
        const double complex factor =
            reflectance * (cexp(2.0 * I * x) * (1.0 - 2.0 * I * x) - 1.0) / (2.0 * x * x);
        static const struct
        {
            int bounces, traces, asked;
            double bound; /* of the phasor's error, as a part of direct light */
        } ways[] = {{0, 0, 0, 2e-6}, {1, 0, 0, 1e-2}, {1, 1, 32, 2e-3}, {24, 0, 16, 4e-3}};
        for (size_t w = 0; w < sizeof ways / sizeof *ways; w++)
        {
            const cm_tof_options options = {.size = sizeof options,
                                            .bounces = ways[w].bounces,
                                            .traces = ways[w].traces,
                                            .paths = (uint32_t)ways[w].asked};
            double complex truth = 0.0, power = 1.0;
            for (int i = 0; i <= ways[w].bounces; i++)
            {
                truth += power;
                power *= factor;
            }
            truth *= cexp(2.0 * I * x);
            ck_assert_int_eq(simulate(&at, &options), CM_OK);
            double complex found = mean_phasor();
            const double radiance = reflectance / PI * 0.7 / (4.0 * PI) / (radius * radius);
            const double electrons = electrons_of(&at.sensor, radiance, 1.0);
            found /= electrons * 0.8;
            REQUIRE(cabs(found - truth) < ways[w].bound,
                    "R %g, rho %g, %g Hz, %d bounces: %g %+gi, not %g %+gi", radius, reflectance,
                    at.sensor.frequency, ways[w].bounces, creal(found), cimag(found), creal(truth),
                    cimag(truth));
        }
        free_stage(&at);
    }
}
END_TEST

/* c / (4 pi f) sqrt(2 / n) sqrt(N + N_ambient) / (D N), of any number of phases, with light from around and without. */
START_TEST(noise_has_the_spread_that_the_formula_gives)
{
    static const int phases[] = {3, 4, 5, 8};
    static float clean[PIXELS], signal[PIXELS], all[PIXELS];
    for (int run = 0; run < 8; run++)
    {
        stage at = make_stage(&wall, 1);
        at.sensor.phases = phases[run / 2];
        at.sensor.frequency = between(10e6, 40e6);
        at.sensor.contrast = between(0.4, 1.0);
        at.light.power = 100.0;
        const cm_tof_environment around = {.size = sizeof around,
                                           .constant = run % 2 == 0 ? 0.0 : 3.0};
        cm_tof_options options = {.size = sizeof options};
        ck_assert_int_eq(simulate(&at, &options), CM_OK);
        memcpy(signal, intensity, sizeof signal);
        memcpy(clean, distance, sizeof clean);
        options.environment = &around;
        options.paths = 4;
        ck_assert_int_eq(simulate(&at, &options), CM_OK);
        memcpy(all, intensity, sizeof all);
        ck_assert(run % 2 == 0 ? all[0] == signal[0] : all[0] > 1.5f * signal[0]);
        double square = 0.0, count = 0.0;
        options.noise = 1;
        for (uint32_t view = 0; view < 8; view++)
        {
            options.view = view;
            ck_assert_int_eq(simulate(&at, &options), CM_OK);
            for (size_t i = 0; i < PIXELS; i++)
            {
                const double n = (double)signal[i], ambient = (double)all[i] - n;
                const double expected = CM_SPEED_OF_LIGHT / (4.0 * PI * at.sensor.frequency) *
                                        sqrt(2.0 / at.sensor.phases) * sqrt(n + ambient) /
                                        (at.sensor.contrast * n);
                const double turn = CM_SPEED_OF_LIGHT / (2.0 * at.sensor.frequency);
                const double error =
                    remainder((double)distance[i] - (double)clean[i], turn) / expected;
                ck_assert_double_eq_tol(cm_tof_noise_of_distance(&at.sensor, n, ambient), expected,
                                        1e-12);
                square += error * error;
                count++;
            }
        }
        /* of 24,576 of them the spread itself spreads by half a percent; noise is small, but no differential */
        REQUIRE(fabs(sqrt(square / count) - 1.0) < 0.02, "%d phases, around %g: %g of the formula",
                at.sensor.phases, around.constant, sqrt(square / count));
        free_stage(&at);
    }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {all_pixels_of_walls_are_as_worked_out_by_hand,
                                  spheres_of_any_size_are_as_the_integral_says,
                                  noise_has_the_spread_that_the_formula_gives, NULL};
    return run_suite("exact parameters", tests);
}
