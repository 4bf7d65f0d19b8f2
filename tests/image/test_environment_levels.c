/* SPDX-License-Identifier: MIT
 *
 * Prefiltered levels of environments: lobes, energy, mappings; bits, types and arguments.
 */
#include "painted_faces.h"

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
    const TTest *const tests[] = {lobes_are_factors,      filtered_samples_are_near_the_mean_of_all,
                                  energy_stays,           every_mapping_to_another,
                                  threads_change_nothing, types_of_pixels,
                                  halves_and_ends,        numbers_that_are_not_finite,
                                  wrong_arguments,        NULL};
    return run_suite("environment levels", tests);
}
