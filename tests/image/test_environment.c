/* SPDX-License-Identifier: MIT
 *
 * Environments: solid angles, what must stay, projection and irradiance, against closed forms and each other.
 */
#include "painted_faces.h"

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

int main(void)
{
    const TTest *const tests[] = {solid_angles_are_the_sphere,
                                  solid_angles_of_equal_areas_are_equal,
                                  solid_angles_of_univariate_mappings_are_exact,
                                  solid_angles_are_those_of_the_jacobian,
                                  a_constant_stays,
                                  coefficients_come_back,
                                  a_bright_texel,
                                  irradiance_from_coefficients,
                                  NULL};
    return run_suite("environment", tests);
}
