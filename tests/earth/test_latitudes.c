/* SPDX-License-Identifier: MIT
 *
 * Ellipsoids and latitudes: the tables, what is refused, the ends, arrays against single points, and the
 * vectors of tests/vectors/latitudes. tests/earth/test_latitude_accuracy.c has the bounds on errors.
 */
#include "tests/suite.h"

#include <cubemap/kernels.h>

#include <locale.h>

#define EPS 0x1p-53

static const double pole = 1.5707963267948966;

static const char *vectors_folder;

/* ---- Ellipsoids ---- */

START_TEST(ellipsoids_are_complete)
{
    ck_assert_uint_ge(cm_ellipsoid_count(), 40);
    ck_assert_ptr_null(cm_ellipsoid_at(cm_ellipsoid_count()));
    ck_assert_ptr_null(cm_ellipsoid_find(NULL));
    ck_assert_ptr_null(cm_ellipsoid_find(""));
    ck_assert_ptr_null(cm_ellipsoid_find("WGS"));
    for (size_t i = 0; i < cm_ellipsoid_count(); i++)
    {
        const cm_ellipsoid *e = cm_ellipsoid_at(i);
        ck_assert_int_eq(cm_ellipsoid_check(e), CM_OK);
        ck_assert(*e->identifier != '\0' && *e->name != '\0' && *e->source != '\0');
        ck_assert_ptr_eq(cm_ellipsoid_find(e->identifier), e);
        ck_assert(e->f >= 0.0 && e->f < 0.11 && e->a > 1e5);
        ck_assert_ptr_null(strchr(e->identifier, ','));
    }
    ck_assert_ptr_eq(cm_ellipsoid_find("wGs84"), cm_ellipsoid_at(0));
}
END_TEST

START_TEST(ellipsoids_are_as_published)
{
    const cm_ellipsoid *wgs84 = cm_ellipsoid_find("WGS84");
    ck_assert(wgs84->a == 6378137.0 && wgs84->f == 1.0 / 298.257223563);
    /* Moritz 1980: the radius of the sphere of the same surface */
    double radius = cm_ellipsoid_authalic_radius(cm_ellipsoid_find("GRS80"));
    ck_assert_msg(fabs(radius - 6371007.1810) < 2e-4, "%.6f", radius);
    ck_assert(cm_ellipsoid_find("Moon")->f == 0.0);
    double mars = cm_ellipsoid_find("Mars")->f;
    ck_assert_msg(fabs(1.0 / mars - 169.894447) < 1e-6, "%.17g", 1.0 / mars);
    double saturn = cm_ellipsoid_find("Saturn")->f;
    ck_assert(fabs(60268000.0 * (1.0 - saturn) - 54364000.0) < 1e-7);
}
END_TEST

START_TEST(surfaces_of_limits)
{
    const double pi = 3.14159265358979323846;
    cm_ellipsoid e = {.size = sizeof e, .a = 2.0};
    ck_assert(fabs(cm_ellipsoid_area(&e) - 16.0 * pi) < 1e-14);
    ck_assert(cm_ellipsoid_authalic_radius(&e) == 2.0);
    e.f = 1e-300;
    ck_assert(cm_ellipsoid_authalic_radius(&e) == 2.0);
    e.f = -1e-300;
    ck_assert(cm_ellipsoid_authalic_radius(&e) == 2.0);
    e.f = 1.0;
    ck_assert(isnan(cm_ellipsoid_area(&e)) && isnan(cm_ellipsoid_authalic_radius(&e)));
    ck_assert(isnan(cm_ellipsoid_area(NULL)));
}
END_TEST

START_TEST(ellipsoids_from_texts)
{
    static const struct
    {
        const char *text;
        double a, f;
    } good[] = {
        {"6378137,298.257223563", 6378137.0, 1.0 / 298.257223563},
        {"6378137,1/298.257223563", 6378137.0, 1.0 / 298.257223563},
        {"+6.378137e6,1/298.257223563", 6378137.0, 1.0 / 298.257223563},
        {"6371000", 6371000.0, 0.0},
        {"6371000,0", 6371000.0, 0.0},
        {"1,-0", 1.0, 0.0},
        {"1,-50", 1.0, -0.02},
        {"1,1.25", 1.0, 0.8},
        {"1e-9,1e300", 1e-9, 1e-300},
        {"moon", 1737400.0, 0.0},
    };
    for (size_t i = 0; i < sizeof good / sizeof *good; i++)
    {
        cm_ellipsoid e;
        char message[100] = "";
        cm_status status = cm_ellipsoid_parse(good[i].text, &e, message, sizeof message);
        ck_assert_msg(status == CM_OK && e.a == good[i].a && e.f == good[i].f, "%s: %s",
                      good[i].text, message);
        ck_assert_int_eq(cm_ellipsoid_check(&e), CM_OK);
        ck_assert(e.identifier != NULL && e.name != NULL && e.source != NULL);
    }
}
END_TEST

START_TEST(texts_that_are_no_ellipsoids)
{
    static const char *const bad[] = {"",
                                      ",",
                                      "WGS85",
                                      "6378137,",
                                      "6378137,298.257223563,",
                                      "6378137, 298.257",
                                      " 6378137",
                                      "6378137 ",
                                      "6378137,1/",
                                      "6378137,1/0",
                                      "6378137,2/298",
                                      "0,298",
                                      "-6378137,298",
                                      "nan",
                                      "inf",
                                      "1e999,298",
                                      "1e-999,298",
                                      "6378137,1",
                                      "6378137,1/1",
                                      "6378137,1.01",
                                      "6378137,nan",
                                      "6378137,inf",
                                      "6378137,-0.01",
                                      "6378137,1e999",
                                      "6378137;298",
                                      "0x10,5",
                                      "6378137,0x10",
                                      "6378137,--5",
                                      "6378137,1/1/298",
                                      "WGS84,298",
                                      "0.000000000000000000000000000000000000000000000,298",
                                      "6,378,137"};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
    {
        cm_ellipsoid e = {.size = 77, .a = 5.0};
        char message[300] = "";
        cm_status status = cm_ellipsoid_parse(bad[i], &e, message, sizeof message);
        ck_assert_msg(status == CM_ERROR_ELLIPSOID, "'%s' is taken: %g %g", bad[i], e.a, e.f);
        ck_assert(e.size == 77 && e.a == 5.0);
        ck_assert(strlen(message) > 20 && strchr(message, '\n') == NULL);
        char little[5] = "????";
        ck_assert_int_eq(cm_ellipsoid_parse(bad[i], &e, little, sizeof little), CM_ERROR_ELLIPSOID);
        ck_assert(memchr(little, '\0', sizeof little) != NULL);
        ck_assert_int_eq(cm_ellipsoid_parse(bad[i], &e, NULL, 0), CM_ERROR_ELLIPSOID);
    }
    cm_ellipsoid e;
    ck_assert_int_eq(cm_ellipsoid_parse(NULL, &e, NULL, 0), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_ellipsoid_parse("WGS84", NULL, NULL, 0), CM_ERROR_ARGUMENT);
}
END_TEST

START_TEST(ellipsoids_that_are_none)
{
    const cm_ellipsoid good = {.size = sizeof good, .a = 1.0, .f = 0.1};
    ck_assert_int_eq(cm_ellipsoid_check(&good), CM_OK);
    ck_assert_int_eq(cm_ellipsoid_check(NULL), CM_ERROR_ARGUMENT);
    const double radii[] = {0.0, -1.0, (double)NAN, (double)INFINITY};
    const double flattenings[] = {
        1.0, 0.991, -99.1, (double)NAN, (double)INFINITY, -(double)INFINITY};
    cm_ellipsoid e = good;
    e.size--;
    ck_assert_int_eq(cm_ellipsoid_check(&e), CM_ERROR_ELLIPSOID);
    for (size_t i = 0; i < sizeof radii / sizeof *radii; i++)
    {
        e = good;
        e.a = radii[i];
        ck_assert_int_eq(cm_ellipsoid_check(&e), CM_ERROR_ELLIPSOID);
    }
    for (size_t i = 0; i < sizeof flattenings / sizeof *flattenings; i++)
    {
        e = good;
        e.f = flattenings[i];
        ck_assert_int_eq(cm_ellipsoid_check(&e), CM_ERROR_ELLIPSOID);
    }
}
END_TEST

/* ---- Conversions ---- */

START_TEST(names_of_latitudes)
{
    for (int i = 0; i < CM_LATITUDE_COUNT; i++)
    {
        cm_latitude found = (cm_latitude)-1;
        ck_assert_int_eq(cm_latitude_find(cm_latitude_name((cm_latitude)i), &found), CM_OK);
        ck_assert_int_eq((int)found, i);
    }
    cm_latitude found = CM_LATITUDE_CONFORMAL;
    ck_assert_ptr_null(cm_latitude_name((cm_latitude)CM_LATITUDE_COUNT));
    ck_assert_ptr_null(cm_latitude_name((cm_latitude)-1));
    ck_assert_int_eq(cm_latitude_find("geodetic", &found), CM_ERROR_LATITUDE);
    ck_assert_int_eq(cm_latitude_find("", &found), CM_ERROR_LATITUDE);
    ck_assert_int_eq(cm_latitude_find(NULL, &found), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_latitude_find("authalic", NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq((int)found, CM_LATITUDE_CONFORMAL);
    ck_assert_int_eq(cm_latitude_find("AUTHALIC", &found), CM_OK);
    ck_assert_int_eq((int)found, CM_LATITUDE_AUTHALIC);
}
END_TEST

static cm_latitude_conversion *make(double f, int from, int to, double tolerance, int exact,
                                    const char *instructions)
{
    cm_ellipsoid e = {.size = sizeof e, .a = 1.0, .f = f};
    cm_latitude_options o = {
        .size = sizeof o, .tolerance = tolerance, .exact = exact, .instructions = instructions};
    cm_latitude_conversion *made = NULL;
    cm_status status =
        cm_latitude_conversion_create(&e, (cm_latitude)from, (cm_latitude)to, &o, &made);
    ck_assert_msg(status == CM_OK && made != NULL, "f %g, %d to %d: %s", f, from, to,
                  cm_status_text(status));
    return made;
}

static cm_status refuse(const cm_ellipsoid *e, int from, int to, const cm_latitude_options *o)
{
    cm_latitude_conversion *const untouched = (cm_latitude_conversion *)(void *)&vectors_folder;
    cm_latitude_conversion *made = untouched;
    cm_status status =
        cm_latitude_conversion_create(e, (cm_latitude)from, (cm_latitude)to, o, &made);
    ck_assert(made == untouched);
    return status;
}

START_TEST(conversions_that_are_refused)
{
    const cm_ellipsoid good = {.size = sizeof good, .a = 1.0, .f = 0.01};
    cm_ellipsoid bad = good;
    bad.f = 1.0;
    cm_latitude_options o = {.size = sizeof o};
    cm_latitude_conversion *made;
    ck_assert_int_eq(cm_latitude_conversion_create(&good, 0, 3, &o, NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_latitude_conversion_create(&good, 0, 3, NULL, &made), CM_OK);
    cm_latitude_conversion_destroy(made);
    cm_latitude_conversion_destroy(NULL);
    ck_assert_int_eq(refuse(NULL, 0, 3, &o), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(refuse(&bad, 0, 3, &o), CM_ERROR_ELLIPSOID);
    ck_assert_int_eq(refuse(&good, -1, 3, &o), CM_ERROR_LATITUDE);
    ck_assert_int_eq(refuse(&good, 0, CM_LATITUDE_COUNT, &o), CM_ERROR_LATITUDE);
    o.instructions = "mmx";
    ck_assert_int_eq(refuse(&good, 0, 3, &o), CM_ERROR_INSTRUCTIONS);
    const double tolerances[] = {-1e-9, (double)NAN, (double)INFINITY};
    for (int i = 0; i < 3; i++)
    {
        o = (cm_latitude_options){.size = sizeof o, .tolerance = tolerances[i]};
        ck_assert_int_eq(refuse(&good, 0, 3, &o), CM_ERROR_ARGUMENT);
    }
    o = (cm_latitude_options){.size = sizeof o - 1};
    ck_assert_int_eq(refuse(&good, 0, 3, &o), CM_ERROR_ARGUMENT);
}
END_TEST

static const double flattenings[] = {1.0 / 298.257223563,
                                     0.02,
                                     -0.02,
                                     1.0 / 51.0,
                                     0.021,
                                     -0.1,
                                     0.9,
                                     -9.0,
                                     1e-12,
                                     1e-300,
                                     -1e-300,
                                     0.0,
                                     0.99,
                                     -99.0};
#define FLATTENINGS (sizeof flattenings / sizeof *flattenings)

/* Calls check for every pair of latitudes with every flattening, by series and by closed forms. */
static void for_every_conversion(void (*check)(const cm_latitude_conversion *, const char *what))
{
    for (size_t i = 0; i < FLATTENINGS * 2; i++)
    {
        for (int pair = 0; pair < CM_LATITUDE_COUNT * CM_LATITUDE_COUNT; pair++)
        {
            char what[80];
            int from = pair / CM_LATITUDE_COUNT;
            int to = pair % CM_LATITUDE_COUNT;
            snprintf(what, sizeof what, "f %g, %s to %s%s", flattenings[i / 2],
                     cm_latitude_name((cm_latitude)from), cm_latitude_name((cm_latitude)to),
                     i % 2 == 0 ? "" : ", exactly");
            cm_latitude_conversion *c = make(flattenings[i / 2], from, to, 0.0, i % 2 == 1, NULL);
            check(c, what);
            cm_latitude_conversion_destroy(c);
        }
    }
}

static int same_bits(double a, double b)
{
    return memcmp(&a, &b, sizeof a) == 0;
}

static void check_ends(const cm_latitude_conversion *c, const char *what)
{
    const double inside = nextafter(pole, 0.0);
    const double beyond[] = {pole + 1e-8,       3.0,        -2.0, (double)INFINITY,
                             -(double)INFINITY, (double)NAN};
    REQUIRE(same_bits(cm_latitude_convert(c, 0.0), 0.0), "%s", what);
    REQUIRE(same_bits(cm_latitude_convert(c, -0.0), -0.0), "%s", what);
    REQUIRE(cm_latitude_convert(c, pole) == pole && cm_latitude_convert(c, -pole) == -pole, "%s",
            what);
    REQUIRE(cm_latitude_convert(c, pole + 5e-10) == pole &&
                cm_latitude_convert(c, -pole - 5e-10) == -pole,
            "%s", what);
    REQUIRE(cm_latitude_convert(c, inside) <= pole && cm_latitude_convert(c, inside) > 0.0, "%s",
            what);
    for (size_t i = 0; i < sizeof beyond / sizeof *beyond; i++)
    {
        REQUIRE(isnan(cm_latitude_convert(c, beyond[i])), "%s: %g", what, beyond[i]);
    }
}

START_TEST(ends_and_beyond)
{
    for_every_conversion(check_ends);
}
END_TEST

static void check_order(const cm_latitude_conversion *c, const char *what)
{
    double before = 0.0;
    for (int i = 1; i <= 200; i++)
    {
        double at = pole * i / 200.0;
        double other = cm_latitude_convert(c, at);
        /* some come so near to the pole that doubles are too coarse */
        REQUIRE(other > before || (other >= before && other > pole - 1e-13), "%s: at %.17g", what,
                at);
        REQUIRE(cm_latitude_convert(c, -at) == -other, "%s: not odd at %.17g", what, at);
        before = other;
    }
}

START_TEST(growing_and_odd)
{
    for_every_conversion(check_order);
}
END_TEST

START_TEST(identities)
{
    for (int pair = 0; pair < CM_LATITUDE_COUNT * CM_LATITUDE_COUNT; pair++)
    {
        int from = pair / CM_LATITUDE_COUNT;
        int to = pair % CM_LATITUDE_COUNT;
        for (int exact = 0; exact < 2; exact++)
        {
            cm_latitude_conversion *c = make(from == to ? 0.3 : 0.0, from, to, 0.0, exact, NULL);
            for (int i = 0; i <= 1000; i++)
            {
                double at = pole * i / 1000.0;
                REQUIRE(same_bits(cm_latitude_convert(c, at), at), "%d to %d at %.17g", from, to,
                        at);
            }
            REQUIRE(same_bits(cm_latitude_convert(c, 5e-324), 5e-324), "%d", from);
            cm_latitude_conversion_destroy(c);
        }
    }
}
END_TEST

static void check_directions(const cm_latitude_conversion *c, const char *what)
{
    static const double bad[][3] = {{0.0, 0.0, 0.0},
                                    {(double)NAN, 1.0, 1.0},
                                    {1.0, (double)NAN, 1.0},
                                    {1.0, 1.0, (double)NAN},
                                    {(double)INFINITY, 1.0, 1.0},
                                    {1.0, -(double)INFINITY, 1.0},
                                    {1.0, 1.0, (double)INFINITY}};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
    {
        double to[3];
        cm_latitude_convert_direction(c, bad[i], to);
        REQUIRE(isnan(to[0]) && isnan(to[1]) && isnan(to[2]), "%s: %zu", what, i);
    }
    /* the length does not matter, and axes stay what they are */
    static const double lengths[] = {5e-324, 1e-310, 1e-160, 1.0, 3.0, 1e160, 1.7e308};
    for (size_t i = 0; i < sizeof lengths / sizeof *lengths; i++)
    {
        const double axes[6][3] = {{lengths[i], 0.0, 0.0},  {0.0, lengths[i], -0.0},
                                   {0.0, 0.0, lengths[i]},  {-lengths[i], -0.0, 0.0},
                                   {0.0, -lengths[i], 0.0}, {0.0, 0.0, -lengths[i]}};
        for (int k = 0; k < 6; k++)
        {
            double to[3];
            cm_latitude_convert_direction(c, axes[k], to);
            for (int j = 0; j < 3; j++)
            {
                double wanted = axes[k][j] == 0.0 ? axes[k][j] : copysign(1.0, axes[k][j]);
                REQUIRE(fabs(to[j] - wanted) <= 6.0 * EPS && signbit(to[j]) == signbit(axes[k][j]),
                        "%s: %g becomes %.17g", what, axes[k][j], to[j]);
            }
        }
    }
}

START_TEST(directions_at_limits)
{
    for_every_conversion(check_directions);
}
END_TEST

/* Scaled by powers of two, which rounds nothing, and with components of very different size. */
START_TEST(directions_of_any_length)
{
    static const double scales[] = {0x1p-950, 0x1p-500, 0x1p-401, 0x1p-399,
                                    0x1p399,  0x1p401,  0x1p1000};
    static const double from[][3] = {
        {0.3, -0.4, 0.5}, {1e-15, 2e-15, 1.0}, {1.0, -1.0, 1e-15}, {1.0, 0x1p-30, -0.5}};
    for (int way = 0; way < 4; way++)
    {
        cm_latitude_conversion *c =
            make(way == 1 ? 0.3 : 0.003, 0, way == 2 ? 1 : 3, 0.0, way == 3, NULL);
        for (size_t k = 0; k < sizeof scales / sizeof *scales * 4; k++)
        {
            const double *d = from[k % 4];
            double s = scales[k / 4];
            double scaled[3] = {d[0] * s, d[1] * s, d[2] * s};
            double one[3];
            double other[3];
            cm_latitude_convert_direction(c, d, one);
            cm_latitude_convert_direction(c, scaled, other);
            for (int j = 0; j < 3; j++)
            {
                ck_assert_msg(fabs(one[j] - other[j]) <= 2.0 * EPS * fabs(one[j]),
                              "way %d, scale %g: %.17g %.17g", way, s, one[j], other[j]);
            }
        }
        const double tiny[3] = {1e-300, 0.0, 1e200};
        double to[3];
        cm_latitude_convert_direction(c, tiny, to);
        ck_assert(to[0] >= 0.0 && to[0] < 1e-300 && fabs(to[2] - 1.0) < 1e-15);
        cm_latitude_conversion_destroy(c);
    }
}
END_TEST

/* ---- Arrays ---- */

#define POINTS 67

static void check_arrays(const cm_latitude_conversion *c, const char *what)
{
    double from[POINTS + 1], to[POINTS + 1], single[POINTS];
    double xyz[3][POINTS + 1], other[3][POINTS + 1], one[POINTS][3];
    for (int i = 0; i < POINTS; i++)
    {
        from[i + 1] = i == 13 ? (double)NAN : i == 14 ? 2.0 : -1.6 + 0.05 * i;
        single[i] = cm_latitude_convert(c, from[i + 1]);
        double d[3] = {cos(1.0 + i), i == 7 ? (double)NAN : 0.5, i % 9 == 0 ? 0.0 : 1.0 - 0.1 * i};
        cm_latitude_convert_direction(c, d, one[i]);
        for (int k = 0; k < 3; k++)
        {
            xyz[k][i + 1] = d[k];
        }
    }
    static const size_t counts[] = {0, 1, 2, 3, 4, 5, 7, 8, 9, 15, 16, 17, POINTS};
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++)
    {
        size_t n = counts[i];
        to[n] = -77.0; /* at to + 1 follows one that must stay */
        to[n + 1 > POINTS ? POINTS : n + 1] = -77.0;
        memset(other, 0, sizeof other);
        cm_latitude_convert_array(c, n, from + 1, to);
        cm_latitude_convert_direction_array(c, n, xyz[0] + 1, xyz[1] + 1, xyz[2] + 1, other[0],
                                            other[1], other[2]);
        REQUIRE(to[n] == -77.0, "%s: beyond the end, n %zu", what, n);
        for (size_t j = 0; j < n; j++)
        {
            REQUIRE(memcmp(&to[j], &single[j], sizeof *to) == 0, "%s: %zu of %zu", what, j, n);
            for (int k = 0; k < 3; k++)
            {
                REQUIRE(memcmp(&other[k][j], &one[j][k], sizeof(double)) == 0, "%s: %zu of %zu",
                        what, j, n);
            }
        }
        REQUIRE(other[0][n] == 0.0 && other[2][n] == 0.0, "%s: beyond the end", what);
    }
    cm_latitude_convert_array(c, POINTS, from + 1, from + 1);
    REQUIRE(memcmp(from + 1, single, sizeof single) == 0, "%s: in place", what);
    cm_latitude_convert_array(c, 0, NULL, NULL);
    cm_latitude_convert_direction_array(c, 0, NULL, NULL, NULL, NULL, NULL, NULL);
}

START_TEST(arrays_are_as_single_points)
{
    for (size_t s = 0; s < cm_instructions_count(); s++)
    {
        for (int pair = 0; pair < 6; pair++)
        {
            static const int to[6] = {1, 3, 4, 5, 3, 1};
            static const double f[6] = {0.003, 0.003, 0.02, 1e-6, 0.2, 0.9};
            cm_latitude_conversion *c = make(f[pair], 0, to[pair], 0.0, 0, cm_instructions_at(s));
            check_arrays(c, cm_instructions_at(s));
            cm_latitude_conversion_destroy(c);
        }
    }
}
END_TEST

/* ---- Closed forms ---- */

/* From the geographic latitude and back, in tangents: the search never leaves its bracket and always ends, from
 * b / a = 1 / 100 to 100 and for latitudes from 1e-12 to as near to the pole. */
static double round_trip(double f, int latitude)
{
    cm_latitude_conversion *there = make(f, CM_LATITUDE_GEOGRAPHIC, latitude, 0.0, 1, NULL);
    cm_latitude_conversion *back = make(f, latitude, CM_LATITUDE_GEOGRAPHIC, 0.0, 1, NULL);
    double worst = 0.0;
    for (double power = -12.0; power <= 12.0; power += 0.25)
    {
        double tangent = pow(10.0, power);
        double direction[3] = {1.0, 0.0, tangent};
        cm_latitude_convert_direction(there, direction, direction);
        cm_latitude_convert_direction(back, direction, direction);
        worst = fmax(worst, fabs(direction[2] / direction[0] / tangent - 1.0) / EPS);
    }
    cm_latitude_conversion_destroy(there);
    cm_latitude_conversion_destroy(back);
    return worst;
}

START_TEST(closed_forms_come_back)
{
    double worst = 0.0;
    for (double power = -1.99; power <= 1.99; power += 0.02)
    {
        double f = 1.0 - pow(10.0, power);
        for (int latitude = CM_LATITUDE_AUTHALIC; latitude <= CM_LATITUDE_RECTIFYING; latitude++)
        {
            double error = round_trip(f, latitude);
            ck_assert_msg(error <= 40.0, "f %.17g, %s: %.1f eps", f,
                          cm_latitude_name((cm_latitude)latitude), error);
            worst = fmax(worst, error);
        }
    }
    printf("closed forms there and back: %.1f eps of the tangent\n", worst);
}
END_TEST

/* ---- Orders and tolerances ---- */

/* What is stated is a bound, and no wide one where it is more than rounding. */
static void check_stated(double f, int from, int to, double tolerance)
{
    cm_latitude_conversion *full = make(f, from, to, 0.0, 0, NULL);
    cm_latitude_conversion *some = make(f, from, to, tolerance, 0, NULL);
    cm_latitude_conversion *exact = make(f, from, to, 0.0, 1, NULL);
    double stated = cm_latitude_conversion_error(some);
    double worst = 0.0;
    ck_assert(stated <= tolerance);
    ck_assert(cm_latitude_conversion_order(some) <= cm_latitude_conversion_order(full));
    for (double at = 0.0; at < 1.6; at += 0.01)
    {
        double error = fabs(cm_latitude_convert(some, at) - cm_latitude_convert(exact, at));
        worst = error > worst ? error : worst;
    }
    ck_assert_msg(worst <= stated + 8.0 * EPS && (stated < 1e-13 || worst >= 0.5 * stated),
                  "f %g, %d to %d within %g: %g, stated %g", f, from, to, tolerance, worst, stated);
    cm_latitude_conversion_destroy(full);
    cm_latitude_conversion_destroy(some);
    cm_latitude_conversion_destroy(exact);
}

START_TEST(orders_are_no_more_than_needed)
{
    for (int pair = 0; pair < CM_LATITUDE_COUNT * CM_LATITUDE_COUNT; pair++)
    {
        int from = pair / CM_LATITUDE_COUNT;
        int to = pair % CM_LATITUDE_COUNT;
        for (int i = 0; i < 3; i++)
        {
            for (double tolerance = 1e-4; tolerance > 1e-15; tolerance /= 10.0)
            {
                check_stated(flattenings[i], from, to, tolerance);
            }
            cm_latitude_conversion *full = make(flattenings[i], from, to, 0.0, 0, NULL);
            cm_latitude_conversion *exact = make(flattenings[i], from, to, 0.0, 1, NULL);
            int order = cm_latitude_conversion_order(full);
            ck_assert_msg(order <= (i == 0 ? 6 : 10), "%d to %d: %d", from, to, order);
            ck_assert(cm_latitude_conversion_error(full) <= 0x1p-55);
            ck_assert(cm_latitude_conversion_order(exact) == 0);
            ck_assert(cm_latitude_conversion_error(exact) == 0.0);
            cm_latitude_conversion_destroy(full);
            cm_latitude_conversion_destroy(exact);
        }
    }
}
END_TEST

static void check_tolerance(double tolerance, int to, int wanted)
{
    cm_latitude_conversion *c = make(flattenings[0], 0, to, tolerance, 0, NULL);
    int order = cm_latitude_conversion_order(c);
    ck_assert_msg(order == wanted, "to %d within %g: %d terms", to, tolerance, order);
    cm_latitude_conversion_destroy(c);
}

/* On WGS 84; docs/guide/latitudes.md has these. */
START_TEST(orders_of_the_earth)
{
    const double millimetre = 1e-3 / 6371007.2;
    for (int to = CM_LATITUDE_AUTHALIC; to <= CM_LATITUDE_RECTIFYING; to++)
    {
        check_tolerance(millimetre, to, 3);
        check_tolerance(1e3 * millimetre, to, 2);
        check_tolerance(1e9 * millimetre, to, 1);
    }
}
END_TEST

/* ---- The kernels, as shaders have them ---- */

/* In float, with the constants rounded, against double: 2 units of 2^-24 of an angle, 6 of a direction. */
static void check_kernels(double f, int from, int to)
{
    cm_latitude_conversion *c = make(f, from, to, 0.0, 0, NULL);
    double n[CM_LATITUDE_CONSTANTS];
    int terms = -1;
    ck_assert_int_eq(cm_latitude_conversion_constants(c, n, &terms), CM_OK);
    ck_assert_int_eq(cm_latitude_conversion_constants(NULL, n, &terms), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_latitude_conversion_constants(c, NULL, &terms), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_latitude_conversion_constants(c, n, NULL), CM_ERROR_ARGUMENT);
    ck_assert(terms >= cm_latitude_conversion_order(c) && terms <= 12);
    const cm_latitude_constants_f32 k = {
        (float)n[0], (float)n[1], (float)n[2], (float)n[3],  (float)n[4],  (float)n[5], (float)n[6],
        (float)n[7], (float)n[8], (float)n[9], (float)n[10], (float)n[11], (float)n[12]};
    for (int i = -157; i <= 157; i++)
    {
        float angle = 0.01f * (float)i;
        float got = terms > 0 ? cm_latitude_series_angle_f32(angle, terms, k)
                              : cm_latitude_tangent_angle_f32(angle, 1, k);
        double wanted = cm_latitude_convert(c, (double)angle);
        REQUIRE(fabs((double)got - wanted) <= 2.0 * 0x1p-24, "f %g, %d to %d: %.9g at %.9g", f,
                from, to, (double)got, (double)angle);
        const double d[3] = {(double)cosf(angle), 0.0, (double)sinf(angle)};
        double turned[3];
        cm_xyz_f32 r =
            terms > 0 ? cm_latitude_series_direction_f32((float)d[0], 0.0f, (float)d[2], terms, k)
                      : cm_latitude_tangent_direction_f32((float)d[0], 0.0f, (float)d[2], k);
        cm_latitude_convert_direction(c, d, turned);
        REQUIRE(fabs((double)r.x - turned[0]) <= 6.0 * 0x1p-24 * fabs(turned[0]) &&
                    fabs((double)r.z - turned[2]) <= 6.0 * 0x1p-24 * fabs(turned[2]),
                "f %g, %d to %d: %.9g %.9g at %.9g", f, from, to, (double)r.x, (double)r.z,
                (double)angle);
    }
    cm_latitude_conversion_destroy(c);
}

START_TEST(kernels_in_float)
{
    for (int i = 0; i < 3; i++)
    {
        for (int pair = 0; pair < CM_LATITUDE_COUNT * CM_LATITUDE_COUNT; pair++)
        {
            check_kernels(flattenings[i], pair / CM_LATITUDE_COUNT, pair % CM_LATITUDE_COUNT);
        }
    }
    double n[CM_LATITUDE_CONSTANTS] = {77.0};
    int terms = 77;
    cm_latitude_conversion *c = make(0.1, 0, 3, 0.0, 0, NULL);
    ck_assert_int_eq(cm_latitude_conversion_constants(c, n, &terms), CM_ERROR_UNSUPPORTED);
    ck_assert(n[0] == 77.0 && terms == 77);
    cm_latitude_conversion_destroy(c);
}
END_TEST

/* ---- Vectors ---- */

/* "F FLATTENING GEOGRAPHIC OTHER" or "I FLATTENING OTHER GEOGRAPHIC" */
static void check_line(const char *line, const char *file, int latitude, int exact, double *worst)
{
    char direction;
    char flattening[64];
    double from;
    double wanted;
    if (*line == '#')
    {
        return;
    }
    ck_assert_msg(sscanf(line, "%c %63s %lf %lf", &direction, flattening, &from, &wanted) == 4,
                  "%s", line);
    double f = strncmp(flattening, "1/", 2) == 0 ? 1.0 / strtod(flattening + 2, NULL)
                                                 : strtod(flattening, NULL);
    cm_latitude_conversion *c = direction == 'F' ? make(f, 0, latitude, 0.0, exact, NULL)
                                                 : make(f, latitude, 0, 0.0, exact, NULL);
    double got = cm_latitude_convert(c, from);
    /* the bound for closed forms and, for subnormals, one of them */
    double error = fabs(got - wanted);
    double relative = fabs(wanted) > 1e-300 ? error / (EPS * fabs(wanted)) : 0.0;
    *worst = relative > *worst ? relative : *worst;
    ck_assert_msg(error <= 9.0 * EPS * fabs(wanted) + 0x1p-1074, "%s: %s: %.17g is %g eps off",
                  file, line, got, relative);
    cm_latitude_conversion_destroy(c);
}

START_TEST(vectors_of_latitudes)
{
    static const struct
    {
        const char *name;
        cm_latitude latitude;
    } files[] = {{"authalic", CM_LATITUDE_AUTHALIC},
                 {"authalic_approx", CM_LATITUDE_AUTHALIC_APPROXIMATION},
                 {"conformal", CM_LATITUDE_CONFORMAL},
                 {"geocentric", CM_LATITUDE_GEOCENTRIC},
                 {"parametric", CM_LATITUDE_PARAMETRIC},
                 {"rectifying", CM_LATITUDE_RECTIFYING}};
    for (size_t i = 0; i < sizeof files / sizeof *files * 2; i++)
    {
        char path[4096];
        char line[256];
        int lines = 0;
        double worst = 0.0;
        snprintf(path, sizeof path, "%s/latitudes/lat_%s.txt", vectors_folder, files[i / 2].name);
        FILE *file = fopen(path, "r");
        ck_assert_msg(file != NULL, "%s", path);
        while (fgets(line, sizeof line, file) != NULL)
        {
            check_line(line, files[i / 2].name, (int)files[i / 2].latitude, i % 2 == 1, &worst);
            lines++;
        }
        fclose(file);
        ck_assert_msg(lines > 200, "%s: %d lines", path, lines);
        printf("%s%s: %d lines, worst %.2f eps of the result\n", files[i / 2].name,
               i % 2 == 0 ? "" : ", exactly", lines, worst);
    }
}
END_TEST

START_TEST(numbers_in_another_locale)
{
    const char *changed = setlocale(LC_ALL, "de_DE.UTF-8");
    cm_ellipsoid e;
    ck_assert_int_eq(cm_ellipsoid_parse("6378137,298.257223563", &e, NULL, 0), CM_OK);
    ck_assert(e.f == 1.0 / 298.257223563);
    printf("locale: %s\n", changed == NULL ? "none with a comma here" : changed);
    setlocale(LC_ALL, "C");
}
END_TEST

int main(int argc, char **argv)
{
    if (argc != 2)
    {
        fprintf(stderr, "usage: %s VECTORS\n", argv[0]);
        return 2;
    }
    vectors_folder = argv[1];
    const TTest *tests[] = {ellipsoids_are_complete,
                            ellipsoids_are_as_published,
                            surfaces_of_limits,
                            ellipsoids_from_texts,
                            texts_that_are_no_ellipsoids,
                            ellipsoids_that_are_none,
                            names_of_latitudes,
                            conversions_that_are_refused,
                            ends_and_beyond,
                            growing_and_odd,
                            identities,
                            directions_at_limits,
                            directions_of_any_length,
                            arrays_are_as_single_points,
                            closed_forms_come_back,
                            orders_are_no_more_than_needed,
                            orders_of_the_earth,
                            kernels_in_float,
                            vectors_of_latitudes,
                            numbers_in_another_locale,
                            NULL};
    return run_suite("latitudes", tests);
}
