/* SPDX-License-Identifier: MIT
 *
 * Statistics of distortion (cubemap/statistics.h): against closed forms, against published figures, and
 * against plain sums and samples; the errors that the quadrature states against those that it has.
 */
#include "tests/suite.h"

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

#define PI 3.14159265358979324

enum
{
    QUANTITIES = 6,
    MEASURES = 2
};

static cm_statistics statistics_of(const cm_mapping *mapping, cm_quantity quantity,
                                   const cm_statistics_options *options)
{
    cm_statistics s = {.size = sizeof s};
    cm_status status = cm_distortion_statistics(mapping, quantity, options, &s);
    REQUIRE(status == CM_OK, "%s", cm_status_text(status));
    return s;
}

static cm_statistics_options over(cm_measure measure, unsigned faces, double tolerance)
{
    return (cm_statistics_options){.size = sizeof(cm_statistics_options),
                                   .measure = measure,
                                   .faces = faces,
                                   .tolerance = tolerance};
}

static int is_near(double a, double b, double tolerance)
{
    return fabs(a - b) <= tolerance;
}

/* gnomonic: D_A = (1 + u^2 + v^2)^1.5 pi / 6, of which the mean over the face and that of the square
 * are elementary; the median follows from a circle that is inside the face. */
START_TEST(test_closed_forms)
{
    cm_mapping *mapping = make_mapping("gnomonic", NULL);
    cm_statistics s = statistics_of(mapping, CM_QUANTITY_AREA, NULL);
    /* (pi / 6)^2 times the mean of (1 + x + y)^3 for the squares x, y of two coordinates */
    double cube =
        1.0 + 3.0 * (2.0 / 3.0) + 3.0 * (2.0 / 5.0 + 2.0 / 9.0) + (2.0 / 7.0 + 3.0 * 2.0 / 15.0);
    double square = PI * PI / 36.0 * cube;
    REQUIRE(is_near(s.rmse * s.rmse, square - 2.0 * s.mean + 1.0, 1e-12), "%.15g", s.rmse);
    REQUIRE(is_near(s.minimum, PI / 6.0, 1e-15) && is_near(s.maximum, sqrt(27.0) * PI / 6.0, 1e-11),
            "%.17g %.17g", s.minimum, s.maximum);
    REQUIRE(is_near(s.ratio, sqrt(27.0), 1e-11) && s.ideal == 1.0 &&
                is_near(s.maximum_error, s.maximum - 1.0, 1e-15),
            "%.17g", s.ratio);
    REQUIRE(is_near(fabs(s.maximum_uv[0]), 1.0, 1e-6) &&
                is_near(fabs(s.maximum_uv[1]), 1.0, 1e-6) && is_near(s.minimum_uv[0], 0.0, 1e-6) &&
                is_near(s.minimum_uv[1], 0.0, 1e-6),
            "at %g %g, %g %g", s.maximum_uv[0], s.maximum_uv[1], s.minimum_uv[0], s.minimum_uv[1]);

    static const double percent[] = {0.0, 10.0, 50.0, 75.0, 100.0};
    double value[COUNT(percent)];
    double doubt[COUNT(percent)];
    ck_assert_int_eq(cm_distortion_percentiles(mapping, CM_QUANTITY_AREA, NULL, COUNT(percent),
                                               percent, value, doubt),
                     CM_OK);
    for (size_t i = 0; i + 1 < COUNT(percent); i++)
    {
        double truth = pow(1.0 + 4.0 * percent[i] / 100.0 / PI, 1.5) * PI / 6.0;
        REQUIRE(is_near(value[i], truth, 1e-3) && doubt[i] < 1e-2, "%g %%: %.6f, not %.6f, +- %g",
                percent[i], value[i], truth, doubt[i]);
    }
    REQUIRE(is_near(value[COUNT(percent) - 1], s.maximum, 0.05), "%g", value[COUNT(percent) - 1]);
    cm_mapping_destroy(mapping);
}
END_TEST

/* Over the sphere the mean of D_A is 1, that of s 6/pi, and that of 1/s's square what it is over the
 * face; within the stated error. A weight that is off by more than that is seen. */
START_TEST(test_means_over_the_sphere)
{
    const cm_statistics_options sphere = over(CM_OVER_SPHERE, 0, 0.0);
    for (size_t m = 0; m < cube_count(); m += step_of(3))
    {
        cm_mapping *mapping = make_mapping(cm_catalogue_at(m)->identifier, NULL);
        cm_statistics area = statistics_of(mapping, CM_QUANTITY_AREA, &sphere);
        cm_statistics scale = statistics_of(mapping, CM_QUANTITY_SCALE, &sphere);
        REQUIRE(is_near(area.mean, 1.0, area.mean_error + 1e-13), "%s: %.17g +- %g",
                cm_catalogue_at(m)->identifier, area.mean, area.mean_error);
        REQUIRE(is_near(scale.mean, 6.0 / PI, scale.mean_error + 1e-13), "%s: %.17g +- %g",
                cm_catalogue_at(m)->identifier, scale.mean, scale.mean_error);
        int equal = (cm_catalogue_at(m)->properties & CM_EQUAL_AREA) != 0;
        REQUIRE(equal == (area.maximum_error < 1e-12), "%s: equal-area? %g",
                cm_catalogue_at(m)->identifier, area.maximum_error);
        cm_mapping_destroy(mapping);
    }
}
END_TEST

/* Corners of a face where the area is a power of the distance, or depends on where one comes from, are followed: the
 * RMSE of conformal by a program of other origin; and over the sphere the mean of D_A^2 is that of D_A over the
 * face, so that the square of the RMSE is that mean less 1. */
START_TEST(test_corner_singularities)
{
    static const char *const names[] = {"conformal", "difference"};
    const cm_statistics_options face = over(CM_OVER_FACE, 1, 0.0);
    const cm_statistics_options sphere = over(CM_OVER_SPHERE, 1, 0.0);
    for (size_t i = 0; i < COUNT(names); i++)
    {
        cm_mapping *mapping = make_mapping(names[i], NULL);
        cm_statistics a = statistics_of(mapping, CM_QUANTITY_AREA, &face);
        cm_statistics b = statistics_of(mapping, CM_QUANTITY_AREA, &sphere);
        REQUIRE(fmax(fmax(a.mean_error, a.rmse_error), fmax(b.mean_error, b.rmse_error)) < 1e-9 &&
                    is_near(b.rmse * b.rmse, a.mean - 1.0, 1e-11),
                "%s: %.15g +- %g, %.15g +- %g; %.15g +- %g, %.15g +- %g", names[i], a.mean,
                a.mean_error, a.rmse, a.rmse_error, b.mean, b.mean_error, b.rmse, b.rmse_error);
        REQUIRE(i != 0 || is_near(a.rmse, 0.554554, 5e-7), "%.15g", a.rmse);
        cm_mapping_destroy(mapping);
    }
}
END_TEST

/* The faces whose distortion differs: of a hybrid also one of a pole. */
static unsigned faces_of(const cm_mapping *mapping)
{
    return cm_mapping_describe(mapping)->family == CM_FAMILY_HYBRID ? 17u : 1u;
}

/* The stated errors of a rough quadrature are never less than a fifth of what it is from a fine one. */
static void check_rough(const cm_mapping *mapping, cm_quantity quantity, cm_measure measure,
                        double tolerance, const cm_statistics *fine)
{
    const char *name = cm_mapping_describe(mapping)->identifier;
    const cm_statistics_options rough = over(measure, faces_of(mapping), tolerance);
    cm_statistics a = statistics_of(mapping, quantity, &rough);
    REQUIRE(is_near(a.mean, fine->mean, 5.0 * (a.mean_error + fine->mean_error) + 1e-13),
            "%s, %s: mean %.15g +- %g, and %.15g +- %g", name, cm_quantity_name(quantity), a.mean,
            a.mean_error, fine->mean, fine->mean_error);
    REQUIRE(is_near(a.rmse, fine->rmse, 5.0 * (a.rmse_error + fine->rmse_error) + 1e-12),
            "%s, %s: RMSE %.15g +- %g, and %.15g +- %g", name, cm_quantity_name(quantity), a.rmse,
            a.rmse_error, fine->rmse, fine->rmse_error);
    REQUIRE(a.minimum == fine->minimum && a.maximum == fine->maximum, "%s, %s: extremes", name,
            cm_quantity_name(quantity));
}

static void check_quadrature(const cm_mapping *mapping, cm_quantity quantity, cm_measure measure)
{
    static const double tolerances[] = {1e-2, 1e-5};
    const cm_statistics_options options = over(measure, faces_of(mapping), 1e-8);
    cm_statistics fine = statistics_of(mapping, quantity, &options);
    REQUIRE(fine.mean_error <= 1e-6 && fine.rmse_error <= 1e-5, "%s, %s: errors %g, %g",
            cm_mapping_describe(mapping)->identifier, cm_quantity_name(quantity), fine.mean_error,
            fine.rmse_error);
    for (size_t i = 0; i < COUNT(tolerances); i++)
    {
        check_rough(mapping, quantity, measure, tolerances[i], &fine);
    }
}

START_TEST(test_stated_errors)
{
    for (size_t m = 0; m < cube_count(); m++)
    {
        cm_mapping *mapping = make_mapping(cm_catalogue_at(m)->identifier, NULL);
        for (size_t i = m % step_of(5); i < QUANTITIES * MEASURES; i += step_of(5))
        {
            /* the scale is the area but for a factor */
            if (i / MEASURES != CM_QUANTITY_SCALE)
            {
                check_quadrature(mapping, (cm_quantity)(i / MEASURES), (cm_measure)(i % MEASURES));
            }
        }
        cm_mapping_destroy(mapping);
    }
}
END_TEST

/* A list of the quantities' values, in their order. */
static void values_of(const cm_distortion *d, const cm_distortion *centre, double value[QUANTITIES])
{
    const double all[QUANTITIES] = {d->area,  d->isotropy,     d->deformation,
                                    d->scale, d->texel_aspect, d->texel_area / centre->texel_area};
    memcpy(value, all, sizeof all);
}

/* No sample is beyond the extremes, the best of many is near them, and means agree to what chance allows;
 * so do percentiles. */
START_TEST(test_samples)
{
    enum
    {
        SAMPLES = 15000,
        PERCENTILES_OF = 2 /* the first quantities: each sorts 200 000 numbers */
    };
    static const double percent[] = {5.0, 50.0, 95.0};
    static const double origin[2] = {0.0, 0.0};
    for (size_t m = 0; m < cube_count(); m += long_step_of(2, 7))
    {
        cm_mapping *mapping = make_mapping(cm_catalogue_at(m)->identifier, NULL);
        cm_statistics s[QUANTITIES];
        double at[QUANTITIES][COUNT(percent)];
        double sum[QUANTITIES] = {0};
        long below[QUANTITIES][COUNT(percent)] = {{0}};
        long not_above[QUANTITIES][COUNT(percent)] = {{0}};
        uint64_t state = 11;
        cm_distortion centre[6];
        for (int face = 0; face < 6; face++)
        {
            cm_inverse_distortion(mapping, (uint8_t)face, origin, &centre[face]);
        }
        for (int k = 0; k < QUANTITIES; k++)
        {
            s[k] = statistics_of(mapping, (cm_quantity)k, NULL);
            ck_assert_int_eq(k >= PERCENTILES_OF
                                 ? CM_OK
                                 : cm_distortion_percentiles(mapping, (cm_quantity)k, NULL,
                                                             COUNT(percent), percent, at[k], NULL),
                             CM_OK);
        }
        for (int i = 0; i < SAMPLES; i++)
        {
            const double uv[2] = {next_real(&state), next_real(&state)};
            cm_distortion d;
            double value[QUANTITIES];
            cm_inverse_distortion(mapping, (uint8_t)(i % 6), uv, &d);
            values_of(&d, &centre[i % 6], value);
            for (int k = 0; k < QUANTITIES; k++)
            {
                /* what is 0 but for rounding, the deformation of a conformal mapping, differs by rounding */
                REQUIRE(value[k] >= s[k].minimum - 1e-12 &&
                            value[k] <= s[k].maximum * (1.0 + 1e-10) + 1e-12,
                        "%s, %s: %.15g is not within %.15g to %.15g",
                        cm_catalogue_at(m)->identifier, cm_quantity_name((size_t)k), value[k],
                        s[k].minimum, s[k].maximum);
                sum[k] += value[k];
                for (size_t j = 0; j < COUNT(percent) && k < PERCENTILES_OF; j++)
                {
                    below[k][j] += value[k] < at[k][j] * (1.0 - 1e-12);
                    not_above[k][j] += value[k] <= at[k][j] * (1.0 + 1e-12);
                }
            }
        }
        for (int k = 0; k < QUANTITIES; k++)
        {
            double range = s[k].maximum - s[k].minimum;
            REQUIRE(is_near(sum[k] / SAMPLES, s[k].mean, 0.02 * range + 1e-9), "%s, %s: %g, not %g",
                    cm_catalogue_at(m)->identifier, cm_quantity_name((size_t)k), sum[k] / SAMPLES,
                    s[k].mean);
            for (size_t j = 0; j < COUNT(percent) && k < PERCENTILES_OF; j++)
            {
                double wanted = percent[j] / 100.0;
                REQUIRE((double)below[k][j] / SAMPLES <= wanted + 0.02 &&
                            (double)not_above[k][j] / SAMPLES >= wanted - 0.02,
                        "%s, %s: %ld of %d are below %g", cm_catalogue_at(m)->identifier,
                        cm_quantity_name((size_t)k), below[k][j], SAMPLES, at[k][j]);
            }
        }
        cm_mapping_destroy(mapping);
    }
}
END_TEST

/* Of formulas that were published, or computed with 50 digits: the extremes of some mappings. */
START_TEST(test_suprema)
{
    static const struct
    {
        const char *specification;
        cm_quantity quantity;
        double minimum; /* NaN: unknown */
        double maximum;
        double tolerance;
    } known[] = {
        {"gnomonic", CM_QUANTITY_ISOTROPY, 1.0, 1.7320508075688773, 1e-10},
        {"gnomonic", CM_QUANTITY_DEFORMATION, 0.0, 31.0845 * PI / 180.0, 1e-6},
        {"gnomonic", CM_QUANTITY_TEXEL_AREA, 2.0 / 9.0, 1.0, 1e-10},
        {"gnomonic", CM_QUANTITY_TEXEL_ASPECT, 0.70710678118654752, 1.4142135623730951, 1e-10},
        {"tangent", CM_QUANTITY_AREA, 0.84882636315677512, 1.20042, 5e-6},
        {"unicube", CM_QUANTITY_AREA, 0.82699, (double)NAN, 5e-6},
        {"nowell", CM_QUANTITY_AREA, (double)NAN, 1.20920, 5e-6},
        {"continuous", CM_QUANTITY_AREA, (double)NAN, 1.59603, 5e-6},
        {"algebraic", CM_QUANTITY_AREA, 0.88143, 1.11730, 5e-6},
        {"qsc", CM_QUANTITY_ISOTROPY, (double)NAN, 1.55728, 5e-6},
        {"qsc", CM_QUANTITY_DEFORMATION, (double)NAN, 25.174 * PI / 180.0, 1e-5},
        {"slice", CM_QUANTITY_ISOTROPY, (double)NAN, 1.4266730784783803, 1e-9},
        {"slice", CM_QUANTITY_DEFORMATION, (double)NAN, 20.2535 * PI / 180.0, 1e-6},
        {"slice", CM_QUANTITY_AREA, 1.0, 1.0, 1e-12},
        {"outerra", CM_QUANTITY_TEXEL_AREA, 0.3238, 1.0, 1e-4},
        {"coupled", CM_QUANTITY_AREA, 0.9975308, 1.0025037, 1e-7},
    };
    for (size_t i = 0; i < COUNT(known); i++)
    {
        cm_mapping *mapping = make_mapping(known[i].specification, NULL);
        cm_statistics s = statistics_of(mapping, known[i].quantity, NULL);
        REQUIRE(
            (isnan(known[i].minimum) || is_near(s.minimum, known[i].minimum, known[i].tolerance)) &&
                (isnan(known[i].maximum) ||
                 is_near(s.maximum, known[i].maximum, known[i].tolerance)),
            "%s, %s: %.10g to %.10g", known[i].specification, cm_quantity_name(known[i].quantity),
            s.minimum, s.maximum);
        cm_mapping_destroy(mapping);
    }
}
END_TEST

/* Pixels: the same sums, done plainly. */
START_TEST(test_pixels)
{
    enum
    {
        PIXELS = 137 /* a row is more than one block of points */
    };
    cm_mapping *mapping = make_mapping("everitt", NULL);
    cm_statistics_options o = over(CM_OVER_FACE, 1u << 3, 0.0);
    o.pixels = PIXELS;
    cm_statistics s = statistics_of(mapping, CM_QUANTITY_ISOTROPY, &o);
    double sum = 0.0;
    double square = 0.0;
    double most = 0.0;
    for (int i = 0; i < PIXELS * PIXELS; i++)
    {
        const double uv[2] = {(2.0 * (i % PIXELS) + 1.0) / PIXELS - 1.0,
                              (2.0 * (double)(i / PIXELS) + 1.0) / PIXELS - 1.0};
        cm_distortion d;
        cm_inverse_distortion(mapping, 3, uv, &d);
        sum += d.isotropy;
        square += (d.isotropy - 1.0) * (d.isotropy - 1.0);
        most = fmax(most, d.isotropy);
    }
    REQUIRE(is_near(s.mean, sum / (PIXELS * PIXELS), 1e-13) &&
                is_near(s.rmse, sqrt(square / (PIXELS * PIXELS)), 1e-13) && s.maximum == most &&
                s.mean_error == 0.0 && s.maximum_face == 3 && s.evaluations == PIXELS * PIXELS,
            "%.17g %.17g %.17g", s.mean, s.rmse, s.maximum);
    cm_mapping_destroy(mapping);
}
END_TEST

/* The polar faces of healpix are others than those of the equator; means add up. */
START_TEST(test_faces)
{
    cm_mapping *mapping = make_mapping("healpix", cm_frame_find("geo"));
    const cm_statistics_options side = over(CM_OVER_FACE, 15, 0.0);
    const cm_statistics_options top = over(CM_OVER_FACE, 48, 0.0);
    cm_statistics a = statistics_of(mapping, CM_QUANTITY_ISOTROPY, &side);
    cm_statistics b = statistics_of(mapping, CM_QUANTITY_ISOTROPY, &top);
    cm_statistics all = statistics_of(mapping, CM_QUANTITY_ISOTROPY, NULL);
    const double most = 100.0;
    double of_side;
    double of_top;
    ck_assert_int_eq(
        cm_distortion_percentiles(mapping, CM_QUANTITY_ISOTROPY, &side, 1, &most, &of_side, NULL),
        CM_OK);
    ck_assert_int_eq(
        cm_distortion_percentiles(mapping, CM_QUANTITY_ISOTROPY, &top, 1, &most, &of_top, NULL),
        CM_OK);
    REQUIRE(is_near(of_side, a.maximum, 0.02) && is_near(of_top, b.maximum, 0.1), "%g %g", of_side,
            of_top);
    REQUIRE(a.maximum < 1.6 && b.maximum > 2.4 && all.maximum == b.maximum && a.maximum_face < 4 &&
                b.maximum_face >= 4,
            "%g %g %g", a.maximum, b.maximum, all.maximum);
    REQUIRE(is_near(all.mean, (4.0 * a.mean + 2.0 * b.mean) / 6.0, 1e-7), "%g", all.mean);
    cm_mapping_destroy(mapping);
}
END_TEST

START_TEST(test_names)
{
    for (size_t k = 0; k < QUANTITIES; k++)
    {
        ck_assert_int_eq(cm_quantity_find(cm_quantity_name(k)), (int)k);
    }
    ck_assert_ptr_null(cm_quantity_name(QUANTITIES));
    ck_assert_int_eq(cm_quantity_find("Texel-Area"), CM_QUANTITY_TEXEL_AREA);
    ck_assert_int_eq(cm_quantity_find("areas"), -1);
    ck_assert_int_eq(cm_quantity_find(NULL), -1);
}
END_TEST

static void expect_refused(const cm_mapping *mapping, int quantity,
                           const cm_statistics_options *options)
{
    cm_statistics s = {.size = sizeof s, .mean = 77.0};
    double value = 77.0;
    const double percent = 50.0;
    ck_assert_int_eq(cm_distortion_statistics(mapping, (cm_quantity)quantity, options, &s),
                     CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_distortion_percentiles(mapping, (cm_quantity)quantity, options, 1, &percent,
                                               &value, NULL),
                     CM_ERROR_ARGUMENT);
    ck_assert(s.mean == 77.0 && value == 77.0);
}

START_TEST(test_bad_arguments)
{
    cm_mapping *mapping = make_mapping("gnomonic", NULL);
    const cm_statistics_options good = over(CM_OVER_FACE, 0, 0.0);
    cm_statistics_options bad = good;
    expect_refused(NULL, 0, &good);
    expect_refused(mapping, QUANTITIES, &good);
    expect_refused(mapping, -1, &good);
    bad.size--;
    expect_refused(mapping, 0, &bad);
    bad = over((cm_measure)2, 0, 0.0);
    expect_refused(mapping, 0, &bad);
    bad = over(CM_OVER_FACE, 64, 0.0);
    expect_refused(mapping, 0, &bad);
    bad = over(CM_OVER_FACE, 0, (double)NAN);
    expect_refused(mapping, 0, &bad);
    bad = over(CM_OVER_FACE, 0, 0.1);
    expect_refused(mapping, 0, &bad);
    bad = over(CM_OVER_SPHERE, 0, 0.0);
    bad.pixels = 4;
    expect_refused(mapping, 0, &bad);
    bad = good;
    bad.pixels = 16385;
    expect_refused(mapping, 0, &bad);
    cm_statistics s = {.size = 1};
    ck_assert_int_eq(cm_distortion_statistics(mapping, CM_QUANTITY_AREA, NULL, &s),
                     CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_distortion_statistics(mapping, CM_QUANTITY_AREA, NULL, NULL),
                     CM_ERROR_ARGUMENT);
    static const double percents[] = {-1.0, 100.1, (double)NAN};
    double value;
    for (size_t i = 0; i < COUNT(percents); i++)
    {
        ck_assert_int_eq(cm_distortion_percentiles(mapping, CM_QUANTITY_AREA, NULL, 1, &percents[i],
                                                   &value, NULL),
                         CM_ERROR_ARGUMENT);
    }
    ck_assert_int_eq(
        cm_distortion_percentiles(mapping, CM_QUANTITY_AREA, NULL, 1, percents, NULL, NULL),
        CM_ERROR_ARGUMENT);
    ck_assert_int_eq(
        cm_distortion_percentiles(mapping, CM_QUANTITY_AREA, NULL, 1, NULL, &value, NULL),
        CM_ERROR_ARGUMENT);
    const double half = 50.0;
    bad = good;
    bad.pixels = 8;
    ck_assert_int_eq(
        cm_distortion_percentiles(mapping, CM_QUANTITY_AREA, &bad, 1, &half, &value, NULL),
        CM_ERROR_ARGUMENT);
    ck_assert_int_eq(
        cm_distortion_percentiles(mapping, CM_QUANTITY_AREA, &good, 1, &half, &value, NULL), CM_OK);
    ck_assert_int_eq(
        cm_distortion_percentiles(NULL, CM_QUANTITY_AREA, NULL, 1, &half, &value, NULL),
        CM_ERROR_ARGUMENT);
    ck_assert_int_eq(
        cm_distortion_percentiles(mapping, CM_QUANTITY_AREA, NULL, 0, NULL, NULL, NULL), CM_OK);
    cm_mapping_destroy(mapping);
}
END_TEST

/* What has not six faces has no such statistics, and the outputs are as they were. */
START_TEST(test_other_kinds)
{
    ck_assert_uint_lt(cube_count(), cm_catalogue_count());
    for (size_t m = cube_count(); m < cm_catalogue_count(); m++)
    {
        cm_mapping *mapping = make_mapping(cm_catalogue_at(m)->identifier, NULL);
        cm_statistics s = {.size = sizeof s, .mean = 77.0};
        const cm_statistics_options pixels = {.size = sizeof pixels, .pixels = 4};
        const double half = 50.0;
        double value = 77.0;
        double doubt = 77.0;
        ck_assert_int_eq(cm_distortion_statistics(mapping, CM_QUANTITY_AREA, NULL, &s),
                         CM_ERROR_UNSUPPORTED);
        ck_assert_int_eq(cm_distortion_statistics(mapping, CM_QUANTITY_AREA, &pixels, &s),
                         CM_ERROR_UNSUPPORTED);
        ck_assert_int_eq(cm_distortion_percentiles(mapping, CM_QUANTITY_ISOTROPY, NULL, 1, &half,
                                                   &value, &doubt),
                         CM_ERROR_UNSUPPORTED);
        ck_assert(s.mean == 77.0 && value == 77.0 && doubt == 77.0);
        ck_assert_int_eq(cm_distortion_statistics(mapping, (cm_quantity)QUANTITIES, NULL, &s),
                         CM_ERROR_ARGUMENT);
        cm_mapping_destroy(mapping);
    }
}
END_TEST

/* Where a map is singular, something comes out, and says that it is uncertain. */
START_TEST(test_singular)
{
    cm_mapping *mapping = make_mapping("smoothstep:c=1", NULL);
    const cm_statistics_options sphere = over(CM_OVER_SPHERE, 1, 1e-4);
    cm_statistics s = statistics_of(mapping, CM_QUANTITY_AREA, &sphere);
    REQUIRE(is_near(s.mean, 1.0, s.mean_error) && s.mean_error > 1e-4 && s.minimum == 0.0,
            "%g +- %g, least %g", s.mean, s.mean_error, s.minimum);
    s = statistics_of(mapping, CM_QUANTITY_ISOTROPY, &sphere);
    REQUIRE(isinf(s.maximum) && isfinite(s.mean), "%g, mean %g", s.maximum, s.mean);
    REQUIRE(fmax(fabs(s.maximum_uv[0]), fabs(s.maximum_uv[1])) == 1.0, "at %g, %g", s.maximum_uv[0],
            s.maximum_uv[1]);
    cm_mapping_destroy(mapping);
    mapping = make_mapping("smoothstep:c=0.99999999", NULL); /* steep, and no more */
    s = statistics_of(mapping, CM_QUANTITY_ISOTROPY, &sphere);
    REQUIRE(s.maximum > 1e5 && isfinite(s.maximum), "%g", s.maximum);
    cm_mapping_destroy(mapping);
}
END_TEST

/* At a corner of the cube the area of the conformal mapping grows without bound, but its integral is finite. */
START_TEST(test_infinite_extremes)
{
    cm_mapping *mapping = make_mapping("conformal", NULL);
    cm_statistics s = statistics_of(mapping, CM_QUANTITY_AREA, NULL);
    REQUIRE(isinf(s.maximum) && fabs(s.maximum_uv[0]) == 1.0 && fabs(s.maximum_uv[1]) == 1.0 &&
                isinf(s.maximum_error) && isfinite(s.rmse) && s.minimum > 0.5,
            "area %g to %g at %g, %g, RMSE %g", s.minimum, s.maximum, s.maximum_uv[0],
            s.maximum_uv[1], s.rmse);
    s = statistics_of(mapping, CM_QUANTITY_TEXEL_AREA, NULL);
    REQUIRE(s.minimum == 0.0 && is_near(s.maximum, 1.0, 1e-12), "texels %g to %g", s.minimum,
            s.maximum);
    cm_mapping_destroy(mapping);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {test_closed_forms,
                                  test_means_over_the_sphere,
                                  test_corner_singularities,
                                  test_stated_errors,
                                  test_samples,
                                  test_suprema,
                                  test_pixels,
                                  test_faces,
                                  test_names,
                                  test_bad_arguments,
                                  test_other_kinds,
                                  test_singular,
                                  test_infinite_extremes,
                                  NULL};
    return run_suite("statistics", tests);
}
