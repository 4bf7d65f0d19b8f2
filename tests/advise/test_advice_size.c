/* SPDX-License-Identifier: MIT
 *
 * How much is needed (cubemap/advise.h): pixels, a precision, terms; and what the next cheaper choice loses.
 */
#include "tests/suite.h"

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

#define PI 3.14159265358979324

static cm_advice_size size_of(const cm_mapping *mapping, double angle)
{
    cm_advice_size size = {.size = sizeof size};
    const cm_status status = cm_advise_size(mapping, angle, &size);
    REQUIRE(status == CM_OK, "%s", cm_status_text(status));
    return size;
}

/* gnomonic is coarsest in the middle, where the scale is 1; tangent in the corners along the edge of three right
 * angles, where the minor axis is 4/pi sin 60. */
START_TEST(closed_forms)
{
    static const struct
    {
        const char *specification;
        double minor;
    } rows[] = {{"gnomonic", 1.0}, {"tangent", 1.1026577908435840}};
    for (size_t i = 0; i < COUNT(rows); i++)
    {
        cm_mapping *mapping = make_mapping(rows[i].specification, NULL);
        for (double width = 4.0; width < 1e9; width *= 30.0)
        {
            double exact = 2.0 / (rows[i].minor * 2.0 * PI / width);
            cm_advice_size s = size_of(mapping, 2.0 * PI / width);
            REQUIRE((double)s.pixels >= exact * (1.0 - 1e-9) &&
                        (double)s.pixels < exact * (1.0 + 1e-9) + 1.0,
                    "%s: %g, not %g", rows[i].specification, (double)s.pixels, exact);
            ck_assert(s.coarsest <= 2.0 * PI / width * (1.0 + 1e-9));
            ck_assert_uint_ge(s.power, s.pixels);
            ck_assert_uint_eq(s.cheaper, s.power / 2);
            ck_assert_uint_lt(s.cheaper, s.pixels);
            ck_assert_uint_eq(s.power & (s.power - 1), 0);
            ck_assert_uint_ge(s.pixels, s.mean_pixels);
            ck_assert(fabs((double)s.mean_pixels - sqrt(2.0 * PI / 3.0) * width / (2.0 * PI)) <=
                      1.0);
        }
        cm_mapping_destroy(mapping);
    }
}
END_TEST

/* Exactly so many pixels are enough, though the division is rounded. */
START_TEST(whole_numbers)
{
    cm_mapping *mapping = make_mapping("gnomonic", NULL);
    for (int pixels = 1; pixels < 5000; pixels += 97 * (int)step_of(5))
    {
        cm_advice_size s = size_of(mapping, 2.0 / pixels);
        ck_assert_uint_eq(s.pixels, (uint64_t)pixels);
    }
    cm_advice_size one = size_of(mapping, PI);
    ck_assert_uint_eq(one.pixels, 1);
    ck_assert_uint_eq(one.power, 1);
    ck_assert_uint_eq(one.cheaper, 0);
    ck_assert(one.cheaper_share == 0.0);
    cm_mapping_destroy(mapping);
}
END_TEST

/* No step as long as a pixel goes farther on the sphere than it says, at random places in random directions; and
 * nearly so far somewhere. The share that a smaller face coarsens is counted by random directions. */
static void check_steps(const cm_mapping *mapping, const char *specification)
{
    const double step = 1e-5;
    double angle = 1e-3;
    cm_advice_size s = size_of(mapping, angle);
    uint64_t state = 3;
    double longest = 0.0;
    int count = 20000 / (int)step_of(10);
    int coarser = 0;
    for (int i = 0; i < count; i++)
    {
        double direction[3];
        double uv[2];
        cm_distortion d;
        next_direction(&state, direction);
        uint8_t face = cm_forward(mapping, direction, uv);
        cm_forward_distortion(mapping, direction, &d);
        coarser += 2.0 / (d.minor * (double)s.cheaper) > angle;
        double bearing = PI * next_real(&state);
        double other[2] = {fmax(-1.0, fmin(1.0, uv[0] + step * cos(bearing))),
                           fmax(-1.0, fmin(1.0, uv[1] + step * sin(bearing)))};
        double here[3];
        double there[3];
        cm_inverse(mapping, face, uv, here);
        cm_inverse(mapping, face, other, there);
        double way = hypot(hypot(there[0] - here[0], there[1] - here[1]), there[2] - here[2]);
        longest = fmax(longest, way / step);
    }
    longest *= 2.0 / (double)s.pixels;
    REQUIRE(longest <= s.coarsest * (1.0 + 1e-4) && longest >= s.coarsest * 0.9, "%s: %g, not %g",
            specification, longest, s.coarsest);
    double share = (double)coarser / count;
    REQUIRE(fabs(share - s.cheaper_share) < (is_quick() ? 0.06 : 0.02), "%s: %g, not %g",
            specification, share, s.cheaper_share);
}

START_TEST(every_mapping)
{
    for (size_t i = 0; i < cube_count(); i++)
    {
        cm_mapping *mapping = make_mapping(cm_catalogue_at(i)->identifier, NULL);
        check_steps(mapping, cm_catalogue_at(i)->identifier);
        cm_mapping_destroy(mapping);
    }
}
END_TEST

START_TEST(no_size)
{
    cm_advice_size s = {.size = sizeof s, .pixels = 7};
    cm_mapping *mapping = make_mapping("smoothstep:c=1", NULL);
    ck_assert(cm_advise_size(mapping, 0.1, &s) == CM_ERROR_UNSUPPORTED);
    cm_mapping_destroy(mapping);
    mapping = make_mapping("peirce", NULL);
    ck_assert(cm_advise_size(mapping, 0.1, &s) == CM_ERROR_UNSUPPORTED);
    cm_mapping_destroy(mapping);
    mapping = make_mapping("gnomonic", NULL);
    static const double wrong[] = {0.0, -1.0, 4.0, 1e-15};
    for (size_t i = 0; i < COUNT(wrong); i++)
    {
        ck_assert(cm_advise_size(mapping, wrong[i], &s) == CM_ERROR_ARGUMENT);
    }
    ck_assert(cm_advise_size(mapping, (double)NAN, &s) == CM_ERROR_ARGUMENT);
    ck_assert(cm_advise_size(NULL, 0.1, &s) == CM_ERROR_ARGUMENT);
    ck_assert(cm_advise_size(mapping, 0.1, NULL) == CM_ERROR_ARGUMENT);
    ck_assert_uint_eq(s.pixels, 7);
    s.size = 1;
    ck_assert(cm_advise_size(mapping, 0.1, &s) == CM_ERROR_ARGUMENT);
    cm_mapping_destroy(mapping);
}
END_TEST

START_TEST(precisions)
{
    cm_mapping *mapping = make_mapping("algebraic", NULL);
    cm_advice_precision p = {.size = sizeof p};
    ck_assert(cm_advise_precision(mapping, 2.0, &p) == CM_OK);
    ck_assert_int_eq((int)p.precision, CM_PRECISION_FLOAT);
    ck_assert(fabs(p.error / (2.7 * 0x1p-24 * EARTH_RADIUS) - 1.0) < 1e-6 &&
              p.cheaper_error == 0.0);
    double in_float = p.error;
    ck_assert(cm_advise_precision(mapping, 1.0, &p) == CM_OK);
    ck_assert_int_eq((int)p.precision, CM_PRECISION_DOUBLE);
    ck_assert(p.error < 2e-9 && p.cheaper_error == in_float);
    ck_assert(cm_advise_precision(mapping, HUGE_VAL, &p) == CM_OK);
    ck_assert_int_eq((int)p.precision, CM_PRECISION_FLOAT);
    ck_assert(cm_advise_precision(mapping, 1e-10, &p) == CM_ERROR_RANGE);
    ck_assert(cm_advise_precision(mapping, 0.0, &p) == CM_ERROR_ARGUMENT);
    ck_assert(cm_advise_precision(mapping, (double)NAN, &p) == CM_ERROR_ARGUMENT);
    ck_assert(cm_advise_precision(NULL, 1.0, &p) == CM_ERROR_ARGUMENT);
    ck_assert(cm_advise_precision(mapping, 1.0, NULL) == CM_ERROR_ARGUMENT);
    p.size = 1;
    ck_assert(cm_advise_precision(mapping, 1.0, &p) == CM_ERROR_ARGUMENT);
    cm_mapping_destroy(mapping);
    p.size = sizeof p;
    static const char *const without[] = {"cobe:legacy=1", "border", "tangent:c=2"};
    for (size_t i = 0; i < COUNT(without); i++)
    {
        mapping = make_mapping(without[i], NULL);
        ck_assert(cm_advise_precision(mapping, 1.0, &p) == CM_ERROR_UNSUPPORTED);
        cm_mapping_destroy(mapping);
    }
}
END_TEST

/* The terms are those of the conversion, and with one less the error would be more than was allowed. */
START_TEST(terms)
{
    const cm_ellipsoid *earth = cm_ellipsoid_find("WGS84");
    for (double metres = 1e-9; metres < 1e3; metres *= 10.0)
    {
        cm_advice_terms t = {.size = sizeof t};
        ck_assert(cm_advise_terms(earth, CM_LATITUDE_GEOGRAPHIC, CM_LATITUDE_AUTHALIC, metres,
                                  &t) == CM_OK);
        const cm_latitude_options options = {.size = sizeof options, .tolerance = t.tolerance};
        cm_latitude_conversion *conversion = NULL;
        ck_assert(cm_latitude_conversion_create(earth, CM_LATITUDE_GEOGRAPHIC, CM_LATITUDE_AUTHALIC,
                                                &options, &conversion) == CM_OK);
        ck_assert_int_eq(t.terms, cm_latitude_conversion_order(conversion));
        cm_latitude_conversion_destroy(conversion);
        REQUIRE(t.error <= metres, "%g m: %d terms cut off %g m", metres, t.terms, t.error);
        ck_assert_int_eq(t.cheaper_terms, t.terms - 1);
        ck_assert(t.terms == 1 ? t.cheaper_error == 0.0 : t.cheaper_error > metres);
    }
    cm_advice_terms t = {.size = sizeof t};
    ck_assert(cm_advise_terms(earth, CM_LATITUDE_GEOGRAPHIC, CM_LATITUDE_AUTHALIC, 0.0, &t) ==
              CM_OK);
    REQUIRE(t.terms == 6 && t.cheaper_terms == 5 && t.error < 1e-9, "%d terms", t.terms);
    ck_assert(cm_advise_terms(earth, CM_LATITUDE_GEOGRAPHIC, CM_LATITUDE_GEOCENTRIC, 1.0, &t) ==
              CM_OK);
    ck_assert(t.terms == 0 && t.cheaper_terms == 0 && t.error == 0.0);
}
END_TEST

START_TEST(wrong_terms)
{
    const cm_ellipsoid *earth = cm_ellipsoid_find("WGS84");
    cm_ellipsoid none = *earth;
    cm_advice_terms t = {.size = sizeof t};
    none.f = 2.0;
    ck_assert(cm_advise_terms(&none, CM_LATITUDE_GEOGRAPHIC, CM_LATITUDE_AUTHALIC, 1.0, &t) ==
              CM_ERROR_ELLIPSOID);
    ck_assert(cm_advise_terms(NULL, CM_LATITUDE_GEOGRAPHIC, CM_LATITUDE_AUTHALIC, 1.0, &t) ==
              CM_ERROR_ARGUMENT);
    ck_assert(cm_advise_terms(earth, CM_LATITUDE_GEOGRAPHIC, (cm_latitude)CM_LATITUDE_COUNT, 1.0,
                              &t) == CM_ERROR_LATITUDE);
    static const double wrong[] = {-1.0, (double)NAN, (double)INFINITY};
    for (size_t i = 0; i < COUNT(wrong); i++)
    {
        ck_assert(cm_advise_terms(earth, CM_LATITUDE_GEOGRAPHIC, CM_LATITUDE_AUTHALIC, wrong[i],
                                  &t) == CM_ERROR_ARGUMENT);
    }
    ck_assert(cm_advise_terms(earth, CM_LATITUDE_GEOGRAPHIC, CM_LATITUDE_AUTHALIC, 1.0, NULL) ==
              CM_ERROR_ARGUMENT);
    t.size = 1;
    ck_assert(cm_advise_terms(earth, CM_LATITUDE_GEOGRAPHIC, CM_LATITUDE_AUTHALIC, 1.0, &t) ==
              CM_ERROR_ARGUMENT);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {closed_forms, whole_numbers, every_mapping, no_size,
                                  precisions,   terms,         wrong_terms,   NULL};
    return run_suite("advice of sizes", tests);
}
