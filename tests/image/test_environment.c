/* SPDX-License-Identifier: MIT
 *
 * Environments: solid angles, projection, irradiance and prefiltered levels, against closed forms and each other.
 */
#include <cubemap/environment.h>

#include "tests/suite.h"

#define PI 3.14159265358979323846

/* ---------------------------------------------------------------- faces */

/* Six faces of floats. */
typedef struct faces
{
    cm_image image[6];
    float *value;
} faces;

static faces make_faces(uint32_t size, uint32_t channels)
{
    faces f;
    const size_t count = (size_t)size * size * channels;
    f.value = calloc(6 * count, sizeof *f.value);
    ck_assert_ptr_nonnull(f.value);
    for (size_t i = 0; i < 6; i++)
    {
        f.image[i] = (cm_image){
            sizeof(cm_image), f.value + i * count, CM_PIXEL_FLOAT, size, size, channels, 0, 0};
    }
    return f;
}

/* The direction of a pixel's centre, rows as pictures have them. */
static void direction_of(const cm_mapping *mapping, uint32_t size, size_t face, size_t row,
                         size_t column, double direction[3])
{
    const double down = cm_mapping_frame(mapping)->first_row_v;
    const double uv[2] = {(2.0 * (double)column + 1.0) / size - 1.0,
                          down * (1.0 - (2.0 * (double)row + 1.0) / size)};
    cm_inverse(mapping, (uint8_t)face, uv, direction);
}

typedef double (*light)(const double direction[3], uint32_t channel);

static faces paint(const cm_mapping *mapping, uint32_t size, uint32_t channels, light value)
{
    faces f = make_faces(size, channels);
    for (size_t i = 0; i < (size_t)6 * size * size; i++)
    {
        double direction[3];
        direction_of(mapping, size, i / size / size, i / size % size, i % size, direction);
        for (uint32_t c = 0; c < channels; c++)
        {
            f.value[i * channels + c] = (float)value(direction, c);
        }
    }
    return f;
}

static cm_environment *make_environment(const cm_mapping *mapping, const faces *f)
{
    cm_environment *environment = NULL;
    ck_assert_int_eq(cm_environment_create(mapping, f->image, 2, &environment), CM_OK);
    return environment;
}

static double constant(const double direction[3], uint32_t channel)
{
    (void)direction;
    return channel + 0.7;
}

/* Smooth, of degree 3, and above 0. */
static double smooth(const double d[3], uint32_t channel)
{
    return 2.0 + d[0] * (0.5 + channel) + 0.3 * d[1] * d[2] - 0.4 * d[0] * d[1] * d[2];
}

/* A sky with a small sun. */
static double sky(const double d[3], uint32_t channel)
{
    const double sun = 0.6 * d[0] + 0.48 * d[1] + 0.64 * d[2];
    return 1.0 + 0.5 * d[2] + 0.2 * sin(9.0 * d[0] + channel) + 60.0 * exp(300.0 * (sun - 1.0));
}

/* Every mapping, each in one of the frames. */
static void for_each_mapping(void (*check)(const cm_mapping *))
{
    for (size_t i = 0; i < cube_count(); i++)
    {
        cm_mapping *mapping =
            make_mapping(cm_catalogue_at(i)->identifier, cm_frame_at(i % cm_frame_count()));
        check(mapping);
        cm_mapping_destroy(mapping);
    }
}

/* ---------------------------------------------------------------- solid angles */

static void check_sum(const cm_mapping *mapping)
{
    static const uint32_t sizes[] = {1, 2, 7, 33, 64};
    double angle[64 * 64];
    for (size_t k = 0; k < 5; k += step_of(3))
    {
        double sum = 0.0;
        for (uint8_t face = 0; face < 6; face++)
        {
            ck_assert_int_eq(cm_texel_solid_angles(mapping, face, sizes[k], angle), CM_OK);
            for (size_t i = 0; i < (size_t)sizes[k] * sizes[k]; i++)
            {
                REQUIRE(angle[i] > 0.0, "%s, %u, %zu", cm_mapping_describe(mapping)->identifier,
                        sizes[k], i);
                sum += angle[i];
            }
        }
        REQUIRE(fabs(sum / (4.0 * PI) - 1.0) < 1e-12, "%s, %u: %.17g",
                cm_mapping_describe(mapping)->identifier, sizes[k], sum);
    }
}

START_TEST(solid_angles_are_the_sphere)
{
    for_every_mapping(check_sum);
}
END_TEST

/* Outlines bend sharply around the middles of qsc's faces and in the corners of slice's: few pixels, by little. */
START_TEST(solid_angles_of_equal_areas_are_equal)
{
    enum
    {
        N = 96
    };
    static double angle[N * N];
    for (size_t i = 0; i < cube_count(); i++)
    {
        const cm_mapping_info *info = cm_catalogue_at(i);
        if ((info->properties & CM_EQUAL_AREA) == 0)
        {
            continue;
        }
        cm_mapping *mapping = make_mapping(info->identifier, NULL);
        for (uint8_t face = 0; face < 6; face++)
        {
            double squares = 0.0;
            cm_texel_solid_angles(mapping, face, N, angle);
            for (size_t k = 0; k < (size_t)N * N; k++)
            {
                const double error = angle[k] * 6.0 * N * N / (4.0 * PI) - 1.0;
                REQUIRE(fabs(error) < 1e-3, "%s, %u, %zu: %g", info->identifier, face, k, error);
                squares += error * error;
            }
            REQUIRE(sqrt(squares) / N < 3e-5, "%s, %u: %g", info->identifier, face,
                    sqrt(squares) / N);
        }
        cm_mapping_destroy(mapping);
    }
}
END_TEST

/* The solid angle between the middle of a gnomonic face and a point of it. */
static double gnomonic(double p, double q)
{
    return atan(p * q / sqrt(1.0 + p * p + q * q));
}

START_TEST(solid_angles_of_univariate_mappings_are_exact)
{
    enum
    {
        N = 37
    };
    double angle[N * N];
    for (size_t i = 0; i < cube_count(); i++)
    {
        if (cm_catalogue_at(i)->family != CM_FAMILY_UNIVARIATE)
        {
            continue;
        }
        cm_mapping *mapping = make_mapping(cm_catalogue_at(i)->identifier, cm_frame_find("gl"));
        double edge[N + 1];
        for (size_t k = 0; k <= N; k++)
        {
            const double uv[2] = {2.0 * (double)k / N - 1.0, 0.0};
            double pq[2];
            cm_unwarp(mapping, uv, pq);
            edge[k] = pq[0];
        }
        cm_texel_solid_angles(mapping, 3, N, angle);
        for (size_t k = 0; k < (size_t)N * N; k++)
        {
            const size_t r = k / N;
            const size_t c = k % N;
            const double expected = gnomonic(edge[c + 1], edge[r + 1]) -
                                    gnomonic(edge[c], edge[r + 1]) -
                                    gnomonic(edge[c + 1], edge[r]) + gnomonic(edge[c], edge[r]);
            REQUIRE(fabs(angle[k] - expected) < 1e-15 * 4.0, "%s, %zu: %.17g, not %.17g",
                    cm_catalogue_at(i)->identifier, k, angle[k], expected);
        }
        cm_mapping_destroy(mapping);
    }
}
END_TEST

/* Of what has no closed form: the Jacobian's area at 3 x 3 Gauss points. Creases are on the diagonals, which go through
 * corners alone. */
START_TEST(solid_angles_are_those_of_the_jacobian)
{
    enum
    {
        N = 48
    };
    static const char *const names[] = {"coupled", "conformal", "difference", "s2"};
    static double angle[N * N];
    const double node[3] = {-sqrt(0.6), 0.0, sqrt(0.6)};
    const double weight[3] = {5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};
    for (size_t i = 0; i < 4; i++)
    {
        cm_mapping *mapping = make_mapping(names[i], NULL);
        cm_texel_solid_angles(mapping, 1, N, angle);
        for (size_t k = 0; k < (size_t)N * N; k++)
        {
            const double down = cm_mapping_frame(mapping)->first_row_v;
            const double u = (2.0 * (double)(k % N) + 1.0) / N - 1.0;
            const double v = down * (1.0 - (2.0 * (double)(k / N) + 1.0) / N);
            double sum = 0.0;
            for (size_t g = 0; g < 9; g++)
            {
                const double uv[2] = {u + node[g % 3] / N, v + node[g / 3] / N};
                cm_distortion at;
                cm_inverse_distortion(mapping, 1, uv, &at);
                sum += weight[g % 3] * weight[g / 3] / at.scale / N / N;
            }
            /* at the conformal cube's corners the area is a power, which neither takes well */
            const int is_corner = (k % N < 3 || k % N > N - 4) && (k / N < 3 || k / N > N - 4);
            REQUIRE(fabs(angle[k] / sum - 1.0) < (is_corner ? 2e-2 : 1e-5),
                    "%s, %zu: %.9g, not %.9g", names[i], k, angle[k], sum);
        }
        cm_mapping_destroy(mapping);
    }
}
END_TEST

/* ---------------------------------------------------------------- what must stay */

static const double all_roughness[] = {0.0, 1e-20, 0.01, 0.1, 0.3, 0.6, 1.0};

static void check_constant(const cm_mapping *mapping)
{
    faces f = paint(mapping, 21, 3, constant);
    faces to = make_faces(5, 3);
    cm_environment *environment = make_environment(mapping, &f);
    for (size_t k = 0; k < 7; k += step_of(3))
    {
        for (int method = 0; method <= (int)CM_PREFILTER_ALL; method++)
        {
            const cm_prefilter_options options = {.size = sizeof options,
                                                  .method = (cm_prefilter_method)method,
                                                  .samples = 40,
                                                  .threads = 1};
            ck_assert_int_eq(cm_environment_prefilter(environment, all_roughness[k], &options,
                                                      mapping, to.image),
                             CM_OK);
            for (size_t i = 0; i < (size_t)6 * 5 * 5 * 3; i++)
            {
                REQUIRE(fabs((double)to.value[i] / constant(NULL, (uint32_t)(i % 3)) - 1.0) < 1e-6,
                        "%s, %g, %d: %.9g", cm_mapping_describe(mapping)->identifier,
                        all_roughness[k], method, (double)to.value[i]);
            }
        }
    }
    cm_environment_irradiance(environment, mapping, 1, to.image);
    for (size_t i = 0; i < (size_t)6 * 5 * 5 * 3; i++)
    {
        ck_assert(fabs((double)to.value[i] / (PI * constant(NULL, (uint32_t)(i % 3))) - 1.0) <
                  1e-6);
    }
    cm_environment_destroy(environment);
    free(to.value);
    free(f.value);
}

START_TEST(a_constant_stays)
{
    for_each_mapping(check_constant);
}
END_TEST

/* ---------------------------------------------------------------- spherical harmonics */

START_TEST(coefficients_come_back)
{
    static const char *const names[] = {"gnomonic", "coupled", "healpix"};
    double error[3][2];
    for (size_t k = 0; k < 6; k++)
    {
        cm_mapping *mapping = make_mapping(names[k / 2], cm_frame_find("gl"));
        const uint32_t size = k % 2 == 0 ? 24 : 48;
        double coefficients[2 * 25];
        double found[2 * 36];
        for (size_t i = 0; i < 50; i++)
        {
            coefficients[i] = sin(3.0 * (double)i + 1.0);
        }
        faces f = make_faces(size, 2);
        ck_assert_int_eq(cm_harmonics_faces(4, 2, coefficients, mapping, 2, f.image), CM_OK);
        cm_environment *environment = make_environment(mapping, &f);
        ck_assert_int_eq(cm_environment_project(environment, 5, 2, found), CM_OK);
        error[k / 2][k % 2] = 0.0;
        for (size_t i = 0; i < 72; i++)
        {
            error[k / 2][k % 2] =
                fmax(error[k / 2][k % 2], fabs(found[i] - (i < 50 ? coefficients[i] : 0.0)));
        }
        cm_environment_destroy(environment);
        free(f.value);
        cm_mapping_destroy(mapping);
    }
    for (size_t k = 0; k < 3; k++)
    {
        /* a quarter, as the rule of middles has it */
        REQUIRE(error[k][0] < 1.5e-2 && error[k][1] < 0.3 * error[k][0], "%s: %g, %g", names[k],
                error[k][0], error[k][1]);
    }
}
END_TEST

/* One bright texel is a point: coefficients and irradiance are those of its direction and solid angle. */
static void check_texel(const cm_mapping *mapping)
{
    enum
    {
        N = 16
    };
    static double angle[N * N];
    faces f = make_faces(N, 1);
    const size_t face = 2;
    const size_t row = 3;
    const size_t column = 9;
    f.value[(face * N + row) * N + column] = 1000.0F;
    double d[3];
    direction_of(mapping, N, face, row, column, d);
    cm_texel_solid_angles(mapping, (uint8_t)face, N, angle);
    const double power = 1000.0 * angle[row * N + column];
    cm_environment *environment = make_environment(mapping, &f);
    double found[49];
    double basis[49];
    cm_environment_project(environment, 6, 1, found);
    cm_harmonics_basis(6, 1, d, d + 1, d + 2, basis);
    for (size_t i = 0; i < 49; i++)
    {
        REQUIRE(fabs(found[i] - power * basis[i]) < 1e-13 * 1000.0, "%zu: %g, not %g", i, found[i],
                power * basis[i]);
    }
    faces to = make_faces(8, 1);
    ck_assert_int_eq(cm_environment_irradiance(environment, mapping, 2, to.image), CM_OK);
    for (size_t i = 0; i < (size_t)6 * 8 * 8; i++)
    {
        double n[3];
        direction_of(mapping, 8, i / 64, i / 8 % 8, i % 8, n);
        const double expected = power * fmax(0.0, n[0] * d[0] + n[1] * d[1] + n[2] * d[2]);
        /* the sum over all texels of the cosine is not quite pi */
        REQUIRE(fabs((double)to.value[i] - expected) < 2e-2 * power, "%s, %zu: %g, not %g",
                cm_mapping_describe(mapping)->identifier, i, (double)to.value[i], expected);
    }
    cm_environment_destroy(environment);
    free(to.value);
    free(f.value);
}

START_TEST(a_bright_texel)
{
    for_each_mapping(check_texel);
}
END_TEST

/* Irradiance by nine coefficients, as is usual, and by more, against all texels. */
START_TEST(irradiance_from_coefficients)
{
    cm_mapping *mapping = make_mapping("coupled", NULL);
    faces f = paint(mapping, 32, 3, sky);
    cm_environment *environment = make_environment(mapping, &f);
    faces exact = make_faces(6, 3);
    faces to = make_faces(6, 3);
    cm_environment_irradiance(environment, mapping, 1, exact.image);
    double mean = 0.0;
    for (size_t i = 0; i < (size_t)6 * 36 * 3; i++)
    {
        mean += (double)exact.value[i] / (6 * 36 * 3);
    }
    static const uint32_t degrees[] = {2, 4, 8};
    static const double bounds[] = {6e-2, 2.5e-2, 8e-3};
    for (size_t k = 0; k < 3; k++)
    {
        double coefficients[81 * 3];
        double lobe[9];
        cm_environment_project(environment, degrees[k], 1, coefficients);
        cm_harmonics_cosine_lobe(degrees[k], lobe);
        cm_harmonics_scale(degrees[k], 3, lobe, coefficients);
        cm_harmonics_faces(degrees[k], 3, coefficients, mapping, 1, to.image);
        double worst = 0.0;
        for (size_t i = 0; i < (size_t)6 * 36 * 3; i++)
        {
            worst = fmax(worst, fabs((double)(to.value[i] - exact.value[i])) / mean);
        }
        REQUIRE(worst < bounds[k], "degree %u: %g", degrees[k], worst);
    }
    cm_environment_destroy(environment);
    free(exact.value);
    free(to.value);
    free(f.value);
    cm_mapping_destroy(mapping);
}
END_TEST

/* ---------------------------------------------------------------- prefiltered levels */

static double difference(const faces *a, const faces *b, size_t count, double *mean)
{
    double sum = 0.0;
    double whole = 0.0;
    for (size_t i = 0; i < count; i++)
    {
        const double d = (double)a->value[i] - (double)b->value[i];
        sum += d * d;
        whole += (double)b->value[i];
    }
    *mean = whole / (double)count;
    return sqrt(sum / (double)count) / *mean;
}

/* A function of one degree is multiplied by the lobe's factor. */
START_TEST(lobes_are_factors)
{
    cm_mapping *mapping = make_mapping("coupled", NULL);
    double coefficients[36] = {0.0};
    coefficients[0] = 3.0;
    coefficients[17] = 1.0;
    coefficients[30] = -0.7;
    faces f = make_faces(is_quick() ? 32 : 64, 1);
    faces expected = make_faces(8, 1);
    faces to = make_faces(8, 1);
    cm_harmonics_faces(5, 1, coefficients, mapping, 1, f.image);
    cm_environment *environment = make_environment(mapping, &f);
    static const double roughness[] = {0.2, 0.35, 0.5, 0.8, 1.0};
    for (size_t k = 0; k < 5; k++)
    {
        double factor[6];
        double scaled[36];
        double mean;
        memcpy(scaled, coefficients, sizeof scaled);
        cm_harmonics_ggx_lobe(5, roughness[k], factor);
        cm_harmonics_scale(5, 1, factor, scaled);
        cm_harmonics_faces(5, 1, scaled, mapping, 1, expected.image);
        cm_prefilter_options options = {
            .size = sizeof options, .method = CM_PREFILTER_ALL, .subdivision = 2, .threads = 2};
        cm_environment_prefilter(environment, roughness[k], &options, mapping, to.image);
        const double all = difference(&to, &expected, 6 * 64, &mean);
        options.level = 1;
        options.subdivision = 1;
        cm_environment_prefilter(environment, roughness[k], &options, mapping, to.image);
        const double coarse = difference(&to, &expected, 6 * 64, &mean);
        REQUIRE(coarse > all && coarse < 1e-2, "%g: %g, %g", roughness[k], coarse, all);
        options.method = CM_PREFILTER_CELLS;
        cm_environment_prefilter(environment, roughness[k], &options, mapping, to.image);
        const double cells = difference(&to, &expected, 6 * 64, &mean);
        REQUIRE(cells < (roughness[k] < 0.3 ? 2e-2 : 3e-3), "%g: %g", roughness[k], cells);
        options.method = CM_PREFILTER_SPIRAL;
        options.samples = 256;
        cm_environment_prefilter(environment, roughness[k], &options, mapping, to.image);
        const double spiral = difference(&to, &expected, 6 * 64, &mean);
        options.method = CM_PREFILTER_UNFILTERED;
        options.samples = 4096;
        cm_environment_prefilter(environment, roughness[k], &options, mapping, to.image);
        const double plain = difference(&to, &expected, 6 * 64, &mean);
        REQUIRE(all < (is_quick() ? 3e-3 : 1e-3) && spiral < 4e-3 && plain < 2e-3, "%g: %g, %g, %g",
                roughness[k], all, spiral, plain);
    }
    cm_environment_destroy(environment);
    free(f.value);
    free(to.value);
    free(expected.value);
    cm_mapping_destroy(mapping);
}
END_TEST

/* Of a sky with a sun: filtered samples are near the mean over all texels, and much nearer than as many that are not.
 * */
START_TEST(filtered_samples_are_near_the_mean_of_all)
{
    cm_mapping *from = make_mapping("algebraic", cm_frame_find("gl"));
    cm_mapping *target = make_mapping("coupled", NULL);
    faces f = paint(from, is_quick() ? 32 : 96, 3, sky);
    faces exact = make_faces(8, 3);
    faces to = make_faces(8, 3);
    cm_environment *environment = make_environment(from, &f);
    static const double roughness[] = {0.25, 0.5, 1.0};
    for (size_t k = 0; k < 3; k++)
    {
        double mean;
        cm_prefilter_options options = {
            .size = sizeof options, .method = CM_PREFILTER_ALL, .subdivision = 2, .threads = 2};
        cm_environment_prefilter(environment, roughness[k], &options, target, exact.image);
        double error[4];
        options.samples = 64;
        for (int method = 0; method < 4; method++)
        {
            options.method = (cm_prefilter_method)(CM_PREFILTER_CELLS + method);
            ck_assert_int_eq(
                cm_environment_prefilter(environment, roughness[k], &options, target, to.image),
                CM_OK);
            error[method] = difference(&to, &exact, 6 * 64 * 3, &mean);
        }
        REQUIRE(error[0] < 0.01 && error[1] < 0.04 && error[2] < 0.08 && error[3] > 1.5 * error[1],
                "%g: %g, %g, %g, %g", roughness[k], error[0], error[1], error[2], error[3]);
    }
    cm_environment_destroy(environment);
    free(f.value);
    free(to.value);
    free(exact.value);
    cm_mapping_destroy(from);
    cm_mapping_destroy(target);
}
END_TEST

/* The mean over the sphere stays, by weights of the target's solid angles. */
START_TEST(energy_stays)
{
    cm_mapping *mapping = make_mapping("tangent", NULL);
    faces f = paint(mapping, 64, 1, sky);
    faces to = make_faces(32, 1);
    cm_environment *environment = make_environment(mapping, &f);
    double whole;
    cm_environment_project(environment, 0, 1, &whole);
    for (size_t k = 0; k < 7; k++)
    {
        double sum;
        cm_environment_prefilter(environment, all_roughness[k], NULL, mapping, to.image);
        cm_environment *filtered = make_environment(mapping, &to);
        cm_environment_project(filtered, 0, 1, &sum);
        /* what a target of 32 does not resolve is in the first three */
        REQUIRE(fabs(sum / whole - 1.0) < (k < 3 ? 5e-3 : 1.5e-3), "%g: %g", all_roughness[k],
                sum / whole - 1.0);
        cm_environment_destroy(filtered);
    }
    cm_environment_destroy(environment);
    free(f.value);
    free(to.value);
    cm_mapping_destroy(mapping);
}
END_TEST

/* From every mapping to another: where the environment is smooth, what comes out is it. Seams would show. */
static void check_mirror(const cm_mapping *mapping)
{
    cm_mapping *target = make_mapping("tangent", cm_frame_find("gl"));
    faces f = paint(mapping, 64, 2, smooth);
    faces to = make_faces(80, 2);
    cm_environment *environment = make_environment(mapping, &f);
    ck_assert_uint_eq(cm_environment_size(environment), 64);
    ck_assert_uint_eq(cm_environment_channels(environment), 2);
    ck_assert_int_eq(cm_environment_prefilter(environment, 0.0, NULL, target, to.image), CM_OK);
    for (size_t i = 0; i < (size_t)6 * 80 * 80; i++)
    {
        double d[3];
        direction_of(target, 80, i / 6400, i / 80 % 80, i % 80, d);
        for (uint32_t c = 0; c < 2; c++)
        {
            REQUIRE(fabs((double)to.value[2 * i + c] - smooth(d, c)) < 0.04, "%s, %zu: %g, not %g",
                    cm_mapping_describe(mapping)->identifier, i, (double)to.value[2 * i + c],
                    smooth(d, c));
        }
    }
    cm_environment_destroy(environment);
    free(to.value);
    free(f.value);
    cm_mapping_destroy(target);
}

START_TEST(every_mapping_to_another)
{
    for_each_mapping(check_mirror);
}
END_TEST

/* ---------------------------------------------------------------- bits, types, arguments */

START_TEST(threads_change_nothing)
{
    cm_mapping *mapping = make_mapping("coupled", NULL);
    faces f = paint(mapping, 40, 3, sky);
    faces a = make_faces(17, 3);
    faces b = make_faces(17, 3);
    static const unsigned threads[] = {1, 2, 5, 16};
    static const double roughness[] = {0.05, 0.8};
    double one[81 * 3];
    double other[81 * 3];
    for (size_t i = 0; i < 8; i++)
    {
        const size_t k = i % 4;
        cm_environment *environment = NULL;
        faces *to = k == 0 ? &a : &b;
        double *coefficients = k == 0 ? one : other;
        cm_environment_create(mapping, f.image, threads[k], &environment);
        const cm_prefilter_options options = {
            .size = sizeof options, .samples = 300, .threads = threads[k]};
        cm_environment_prefilter(environment, roughness[i / 4], &options, mapping, to->image);
        ck_assert_int_eq(memcmp(a.value, to->value, (size_t)6 * 17 * 17 * 3 * sizeof(float)), 0);
        cm_environment_project(environment, 8, threads[k], coefficients);
        ck_assert_int_eq(memcmp(one, coefficients, sizeof one), 0);
        cm_environment_destroy(environment);
    }
    free(f.value);
    free(a.value);
    free(b.value);
    cm_mapping_destroy(mapping);
}
END_TEST

/* Types of pixels on both sides; rows from below and channels apart. */
START_TEST(types_of_pixels)
{
    enum
    {
        N = 4
    };
    cm_mapping *mapping = make_mapping("gnomonic", NULL);
    static const double expected[4] = {51.0 / 255.0, 13107.0 / 65535.0, 0.199951171875, 0.2F};
    static const uint16_t stored[4] = {51, 13107, 0x3266, 0};
    for (size_t type = 0; type < 4; type++)
    {
        uint16_t memory[6 * N * N * 2] = {0};
        float floats[6 * N * N];
        unsigned char *bytes = (unsigned char *)memory;
        cm_image image[6];
        const size_t width = type == CM_PIXEL_U8 ? 1 : 2;
        for (size_t i = 0; i < (size_t)6 * N * N; i++)
        {
            floats[i] = 0.2F;
            memory[i] = stored[type];
        }
        if (type == CM_PIXEL_U8)
        {
            memset(bytes, 51, sizeof memory);
        }
        for (size_t i = 0; i < 6; i++)
        {
            void *data = type == CM_PIXEL_FLOAT ? (void *)(floats + (i * N + N - 1) * N)
                                                : (void *)(bytes + (i * N + N - 1) * N * width);
            const ptrdiff_t pixel = (ptrdiff_t)(type == CM_PIXEL_FLOAT ? 4 : width);
            image[i] =
                (cm_image){sizeof(cm_image), data, (cm_pixel_type)type, N, N, 1, -N * pixel, pixel};
        }
        cm_environment *environment = NULL;
        ck_assert_int_eq(cm_environment_create(mapping, image, 1, &environment), CM_OK);
        faces to = make_faces(3, 1);
        cm_environment_prefilter(environment, 0.0, NULL, mapping, to.image);
        for (size_t i = 0; i < 54; i++)
        {
            REQUIRE(fabs((double)to.value[i] - expected[type]) < 1e-7, "%zu: %.9g", type,
                    (double)to.value[i]);
        }
        /* and out again, over what was there */
        memset(memory, 0, sizeof memory);
        ck_assert_int_eq(cm_environment_prefilter(environment, 0.0, NULL, mapping, image), CM_OK);
        for (size_t i = 0; i < (size_t)6 * N * N; i++)
        {
            ck_assert(type == CM_PIXEL_U8      ? bytes[i] == 51
                      : type == CM_PIXEL_FLOAT ? floats[i] == 0.2F
                                               : memory[i] == stored[type]);
        }
        free(to.value);
        cm_environment_destroy(environment);
    }
    cm_mapping_destroy(mapping);
}
END_TEST

/* Every half goes through unchanged; what lies between rounds to even; whole numbers end at 0 and 1. */
START_TEST(halves_and_ends)
{
    cm_mapping *mapping = make_mapping("gnomonic", NULL);
    static const struct
    {
        float value;
        uint16_t half;
    } known[] = {{0.0F, 0},
                 {-0.0F, 0x8000},
                 {1.0F, 0x3c00},
                 {-2.0F, 0xc000},
                 {65504.0F, 0x7bff},
                 {65519.0F, 0x7bff},
                 {65520.0F, 0x7c00},
                 {6e-8F, 1},
                 {2.9e-8F, 0},
                 {6.1035156e-5F, 0x0400},
                 {6.0975e-5F, 0x03ff},
                 {1.00048828125F, 0x3c00},
                 {1.00146484375F, 0x3c02},
                 {2047.9999F, 0x6800}};
    for (size_t k = 0; k < sizeof known / sizeof *known; k++)
    {
        faces f = make_faces(1, 1);
        for (size_t i = 0; i < 6; i++)
        {
            f.value[i] = known[k].value;
        }
        cm_environment *environment = make_environment(mapping, &f);
        uint16_t halves[6];
        uint8_t bytes[6];
        cm_image to[6];
        for (size_t i = 0; i < 6; i++)
        {
            to[i] = (cm_image){sizeof(cm_image), halves + i, CM_PIXEL_HALF, 1, 1, 1, 0, 0};
        }
        cm_environment_prefilter(environment, 0.0, NULL, mapping, to);
        REQUIRE((halves[0] & 0x7fff) == (known[k].half & 0x7fff), "%.9g: %x",
                (double)known[k].value, halves[0]);
        for (size_t i = 0; i < 6; i++)
        {
            to[i] = (cm_image){sizeof(cm_image), bytes + i, CM_PIXEL_U8, 1, 1, 1, 0, 0};
        }
        cm_environment_prefilter(environment, 0.0, NULL, mapping, to);
        ck_assert_uint_eq(bytes[5], known[k].value >= 1.0F ? 255 : 0);
        cm_environment_destroy(environment);
        free(f.value);
    }
    cm_mapping_destroy(mapping);
}
END_TEST

START_TEST(numbers_that_are_not_finite)
{
    cm_mapping *mapping = make_mapping("coupled", NULL);
    faces f = paint(mapping, 8, 1, constant);
    faces to = make_faces(4, 1);
    f.value[100] = (float)NAN;
    cm_environment *environment = make_environment(mapping, &f);
    ck_assert_int_eq(cm_environment_prefilter(environment, 0.0, NULL, mapping, to.image), CM_OK);
    size_t bad = 0;
    for (size_t i = 0; i < 96; i++)
    {
        bad += isnan(to.value[i]) ? 1 : 0;
    }
    REQUIRE(bad > 0 && bad < 16, "%zu", bad);
    ck_assert_int_eq(cm_environment_prefilter(environment, 1.0, NULL, mapping, to.image), CM_OK);
    cm_environment_destroy(environment);
    free(f.value);
    free(to.value);
    cm_mapping_destroy(mapping);
}
END_TEST

static void check_options(const cm_environment *environment, const cm_mapping *mapping,
                          const cm_image *to)
{
    cm_prefilter_options options = {.size = sizeof options, .threads = 1};
    ck_assert_int_eq(cm_environment_prefilter(environment, -0.1, &options, mapping, to),
                     CM_ERROR_RANGE);
    ck_assert_int_eq(cm_environment_prefilter(environment, 1.1, &options, mapping, to),
                     CM_ERROR_RANGE);
    ck_assert_int_eq(cm_environment_prefilter(environment, (double)NAN, &options, mapping, to),
                     CM_ERROR_RANGE);
    options.method = (cm_prefilter_method)6;
    ck_assert_int_eq(cm_environment_prefilter(environment, 0.5, &options, mapping, to),
                     CM_ERROR_RANGE);
    options.method = CM_PREFILTER_ALL;
    options.subdivision = 17;
    ck_assert_int_eq(cm_environment_prefilter(environment, 0.5, &options, mapping, to),
                     CM_ERROR_RANGE);
    options.subdivision = 0;
    options.level = cm_environment_level_count(environment);
    ck_assert_uint_eq(options.level, 3);
    ck_assert_int_eq(cm_environment_prefilter(environment, 0.5, &options, mapping, to),
                     CM_ERROR_RANGE);
    options.level = 2;
    options.coarseness = 1e-4;
    ck_assert_int_eq(cm_environment_prefilter(environment, 0.5, &options, mapping, to),
                     CM_ERROR_RANGE);
    options.coarseness = 1.0;
    options.samples = 65537;
    ck_assert_int_eq(cm_environment_prefilter(environment, 0.5, &options, mapping, to),
                     CM_ERROR_RANGE);
    options.samples = 1;
    options.blur = 17.0;
    ck_assert_int_eq(cm_environment_prefilter(environment, 0.5, &options, mapping, to),
                     CM_ERROR_RANGE);
    options.size = 8;
    ck_assert_int_eq(cm_environment_prefilter(environment, 0.5, &options, mapping, to),
                     CM_ERROR_ARGUMENT);
}

START_TEST(wrong_arguments)
{
    cm_mapping *mapping = make_mapping("coupled", NULL);
    cm_mapping *octahedral = make_mapping("octahedral", NULL);
    faces f = paint(mapping, 4, 2, constant);
    faces three = make_faces(4, 3);
    cm_environment *none = NULL;
    cm_environment *environment = make_environment(mapping, &f);
    double value[8] = {7.0};
    ck_assert_int_eq(cm_environment_create(NULL, f.image, 1, &none), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_environment_create(mapping, NULL, 1, &none), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_environment_create(mapping, f.image, 1, NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_environment_create(octahedral, f.image, 1, &none), CM_ERROR_UNSUPPORTED);
    for (int fault = 0; fault < 7; fault++)
    {
        cm_image bad[6];
        memcpy(bad, f.image, sizeof bad);
        bad[3].width = fault == 0 ? 3 : fault == 1 ? 0 : 4;
        bad[3].channels = fault == 2 ? 1 : fault == 3 ? 5 : 2;
        bad[3].type = fault == 4 ? CM_PIXEL_HALF : fault == 5 ? (cm_pixel_type)9 : CM_PIXEL_FLOAT;
        bad[3].data = fault == 6 ? NULL : bad[3].data;
        ck_assert_int_eq(cm_environment_create(mapping, bad, 1, &none),
                         fault == 6 ? CM_ERROR_ARGUMENT : CM_ERROR_RANGE);
    }
    ck_assert_ptr_null(none);
    ck_assert_int_eq(cm_environment_project(NULL, 0, 1, value), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_environment_project(environment, 0, 1, NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_environment_project(environment, 2001, 1, value), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_environment_irradiance(NULL, mapping, 1, f.image), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_environment_irradiance(environment, octahedral, 1, f.image),
                     CM_ERROR_UNSUPPORTED);
    ck_assert_int_eq(cm_environment_irradiance(environment, mapping, 1, three.image),
                     CM_ERROR_RANGE);
    ck_assert_int_eq(cm_environment_prefilter(NULL, 0.5, NULL, mapping, f.image),
                     CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_environment_prefilter(environment, 0.5, NULL, mapping, three.image),
                     CM_ERROR_RANGE);
    ck_assert_int_eq(cm_harmonics_faces(0, 3, value, mapping, 1, f.image), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_harmonics_faces(0, 2, NULL, mapping, 1, f.image), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_harmonics_faces(0, 2, value, octahedral, 1, f.image), CM_ERROR_UNSUPPORTED);
    ck_assert_int_eq(cm_texel_solid_angles(NULL, 0, 1, value), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_texel_solid_angles(mapping, 6, 1, value), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_texel_solid_angles(mapping, 0, 0, value), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_texel_solid_angles(octahedral, 0, 1, value), CM_ERROR_UNSUPPORTED);
    check_options(environment, mapping, f.image);
    ck_assert(value[0] == 7.0 && three.value[0] == 0.0F && f.value[0] == 0.7F);
    cm_environment_destroy(NULL);
    cm_environment_destroy(environment);
    free(f.value);
    free(three.value);
    cm_mapping_destroy(mapping);
    cm_mapping_destroy(octahedral);
}
END_TEST

int main(void)
{
    const TTest *tests[] = {solid_angles_are_the_sphere,
                            solid_angles_of_equal_areas_are_equal,
                            solid_angles_of_univariate_mappings_are_exact,
                            solid_angles_are_those_of_the_jacobian,
                            a_constant_stays,
                            coefficients_come_back,
                            a_bright_texel,
                            irradiance_from_coefficients,
                            lobes_are_factors,
                            filtered_samples_are_near_the_mean_of_all,
                            energy_stays,
                            every_mapping_to_another,
                            threads_change_nothing,
                            types_of_pixels,
                            halves_and_ends,
                            numbers_that_are_not_finite,
                            wrong_arguments,
                            NULL};
    return run_suite("environment", tests);
}
