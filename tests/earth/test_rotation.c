/* SPDX-License-Identifier: MIT
 *
 * Rotations (cubemap/orientation.h): exact at multiples of 90 degrees, elsewhere against long double; there and
 * back; what is no rotation; texts.
 */
#include "tests/suite.h"

#include <float.h>
#include <locale.h>

#include "truth/hard_points.h"

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))
#define EPS 0x1p-53
#define PI_LONG 3.14159265358979323846264338327950288L

static const double hard_angles[] = {
    0.0,   -0.0,  1e-300, -5e-324, 1e-15, -1e-15, 1e-8,  0.1,    17.0,  30.0,   44.999999999999993,
    45.0,  45.1,  60.0,   89.9,    90.0,  -90.0,  120.0, -135.0, 179.9, 180.0,  -180.0,
    270.0, 360.0, 450.0,  -720.5,  1e6,   1e15,   1e22,  1e300,  -10.0, -33.25, 89.99999999999999};

static cm_rotation rotation_of(double lon, double lat, double roll)
{
    cm_rotation rotation;
    cm_status status = cm_rotation_from_angles(lon, lat, roll, &rotation);
    REQUIRE(status == CM_OK, "%.17g, %.17g, %.17g: %s", lon, lat, roll, cm_status_text(status));
    return rotation;
}

static void truth_of(double degrees, long double *sine, long double *cosine)
{
    long double angle = fmodl((long double)degrees, 360.0L) * (PI_LONG / 180.0L);
    *sine = sinl(angle);
    *cosine = cosl(angle);
}

/* The largest difference of two rotations' elements. */
static double apart(const cm_rotation *a, const cm_rotation *b)
{
    double worst = 0.0;
    for (int i = 0; i < 9; i++)
    {
        worst = fmax(worst, fabs(a->row[i / 3][i % 3] - b->row[i / 3][i % 3]));
    }
    return worst;
}

static double off_truth(const cm_rotation *rotation, double lon, double lat, double roll)
{
    long double a, b, c, d, e, f;
    truth_of(lon, &a, &b);
    truth_of(lat, &c, &d);
    truth_of(roll, &e, &f);
    const long double truth[3][3] = {{d * b, d * a, c},
                                     {-f * a - e * c * b, f * b - e * c * a, e * d},
                                     {-f * c * b + e * a, -f * c * a - e * b, f * d}};
    double worst = 0.0;
    for (int i = 0; i < 9; i++)
    {
        worst = fmax(worst,
                     (double)fabsl((long double)rotation->row[i / 3][i % 3] - truth[i / 3][i % 3]));
    }
    return worst;
}

/* Against the formula in long double, and there and back. */
static void check_angles(double lon, double lat, double roll)
{
    cm_rotation rotation = rotation_of(lon, lat, roll);
    double off = off_truth(&rotation, lon, lat, roll);
    REQUIRE(off <= 3.0 * EPS, "%.17g, %.17g, %.17g: %.3g eps off", lon, lat, roll, off / EPS);
    REQUIRE(cm_rotation_check(&rotation) == CM_OK, "%.17g, %.17g, %.17g", lon, lat, roll);
    double angles[3];
    REQUIRE(cm_rotation_angles(&rotation, &angles[0], &angles[1], &angles[2]) == CM_OK, "angles");
    REQUIRE(fabs(angles[0]) <= 180.0 && fabs(angles[1]) <= 90.0 && fabs(angles[2]) <= 180.0,
            "%.17g, %.17g, %.17g are %.17g, %.17g, %.17g", lon, lat, roll, angles[0], angles[1],
            angles[2]);
    cm_rotation again = rotation_of(angles[0], angles[1], angles[2]);
    off = apart(&rotation, &again);
    REQUIRE(off <= 8.0 * EPS, "%.17g, %.17g, %.17g come back %.3g eps off", lon, lat, roll,
            off / EPS);
}

START_TEST(test_angles)
{
    for (size_t i = 0; i < COUNT(hard_angles); i++)
    {
        for (size_t j = 0; j < COUNT(hard_angles); j++)
        {
            for (size_t k = 0; k < COUNT(hard_angles); k++)
            {
                if (fabs(hard_angles[j]) <= 90.0)
                {
                    check_angles(hard_angles[i], hard_angles[j], hard_angles[k]);
                }
            }
        }
    }
    uint64_t state = 1;
    for (int i = 0; i < 100000; i++)
    {
        double lon = 180.0 * next_real(&state);
        double lat = 90.0 * next_real(&state);
        check_angles(lon, i % 7 == 0 ? copysign(90.0 - 1e-9 * fabs(lat), lat) : lat,
                     180.0 * next_real(&state));
    }
}
END_TEST

/* Where the axes go is what the header says, and all else is a permutation with signs. */
START_TEST(test_multiples_of_90)
{
    const double front[3] = {1.0, 0.0, 0.0};
    const double top[3] = {0.0, 0.0, 1.0};
    double to[3];
    cm_rotation none = rotation_of(0.0, 0.0, 0.0);
    cm_rotation east = rotation_of(90.0, 0.0, 0.0);
    cm_rotation north = rotation_of(0.0, 90.0, 0.0);
    cm_rotation rolled = rotation_of(0.0, 0.0, 90.0);
    for (int i = 0; i < 9; i++)
    {
        REQUIRE(none.row[i / 3][i % 3] == (i % 4 == 0) && !signbit(none.row[i / 3][i % 3]), "%d",
                i);
    }
    cm_rotate_back(&east, front, to); /* the middle of the front is at 90 E */
    REQUIRE(to[0] == 0.0 && to[1] == 1.0 && to[2] == 0.0, "%g %g %g", to[0], to[1], to[2]);
    cm_rotate_back(&east, top, to);
    REQUIRE(to[0] == 0.0 && to[1] == 0.0 && to[2] == 1.0, "%g %g %g", to[0], to[1], to[2]);
    cm_rotate_back(&north, front, to);
    REQUIRE(to[0] == 0.0 && to[1] == 0.0 && to[2] == 1.0, "%g %g %g", to[0], to[1], to[2]);
    cm_rotate_back(&north, top, to); /* away from the meridian of lon, over the pole */
    REQUIRE(to[0] == -1.0 && to[1] == 0.0 && to[2] == 0.0, "%g %g %g", to[0], to[1], to[2]);
    cm_rotate_back(&rolled, top, to); /* anticlockwise: up goes left, which is west */
    REQUIRE(to[0] == 0.0 && to[1] == -1.0 && to[2] == 0.0, "%g %g %g", to[0], to[1], to[2]);

    for (int i = 0; i < 5 * 3 * 5; i++)
    {
        double lon = i % 5 * 90.0 - 180.0;
        double lat = i / 5 % 3 * 90.0 - 90.0;
        cm_rotation rotation = rotation_of(lon, lat, i / 15 * 90.0 - 180.0);
        for (int j = 0; j < 9; j++)
        {
            double element = rotation.row[j / 3][j % 3];
            REQUIRE(element == 0.0 ? !signbit(element) : fabs(element) == 1.0, "%g", element);
        }
        double a, b, c;
        ck_assert_int_eq(cm_rotation_angles(&rotation, &a, &b, &c), CM_OK);
        REQUIRE(fmod(a, 90.0) == 0.0 && b == lat && fmod(c, 90.0) == 0.0, "%g %g %g", a, b, c);
        REQUIRE(lat != 0.0 ? a == 0.0 : fabs(a) == fabs(lon), "%g, not %g", a, lon);
        cm_rotation again = rotation_of(a, b, c);
        REQUIRE(apart(&rotation, &again) == 0.0, "%g %g %g", a, b, c);
    }
}
END_TEST

/* Directions come back with their length; those on axes exactly where nothing is turned but by 90 degrees. */
START_TEST(test_directions)
{
    const cm_rotation quarter = rotation_of(-90.0, 0.0, 180.0);
    const cm_rotation other = rotation_of(17.3, -48.1, 133.0);
    for (size_t i = 0; i < HARD_DIRECTIONS; i += 997)
    {
        double from[3], to[3], back[3];
        hard_direction(i, from);
        cm_rotate(&quarter, from, to);
        cm_rotate_back(&quarter, to, back);
        double size = fmax(fabs(from[0]), fmax(fabs(from[1]), fabs(from[2])));
        if (isfinite(size))
        {
            REQUIRE(back[0] == from[0] && back[1] == from[1] && back[2] == from[2], "%zu", i);
        }
        cm_rotate(&other, from, to);
        memcpy(back, to, sizeof back);
        cm_rotate_back(&other, back, back); /* in place */
        for (int k = 0; k < 3 && size > 1e-290 && size < 1e300; k++)
        {
            REQUIRE(fabs(back[k] - from[k]) <= 12.0 * EPS * size * 1.8, "%zu: %g eps", i,
                    fabs(back[k] - from[k]) / size / EPS);
        }
    }
    const double nan[3] = {1.0, (double)NAN, 0.0};
    const double infinite[3] = {0.0, 0.0, (double)INFINITY};
    double to[3];
    cm_rotate(&other, nan, to);
    REQUIRE(isnan(to[0]) && isnan(to[1]) && isnan(to[2]), "NaN");
    cm_rotate(&quarter, infinite, to);
    REQUIRE(!isfinite(to[0] + to[1] + to[2]), "infinite");
}
END_TEST

/* Every column of the front's centre is where the angles say, in the mapping's own words. */
START_TEST(test_with_a_mapping)
{
    cm_mapping *mapping = make_mapping("gnomonic", NULL);
    cm_rotation rotation = rotation_of(12.0, 34.0, 56.0);
    double direction[3], uv[2];
    cm_direction_from_lonlat(12.0 * (double)(PI_LONG / 180.0L), 34.0 * (double)(PI_LONG / 180.0L),
                             direction);
    cm_rotate(&rotation, direction, direction);
    REQUIRE(cm_forward(mapping, direction, uv) == 0 && fabs(uv[0]) < 1e-15 && fabs(uv[1]) < 1e-15,
            "%g %g", uv[0], uv[1]);
    /* a little to the north of it: turned clockwise on the face, as the face is turned anticlockwise */
    cm_direction_from_lonlat(12.0 * (double)(PI_LONG / 180.0L), 34.1 * (double)(PI_LONG / 180.0L),
                             direction);
    cm_rotate(&rotation, direction, direction);
    cm_forward(mapping, direction, uv);
    REQUIRE(fabs(atan2(uv[0], uv[1]) * 180.0 / (double)PI_LONG - 56.0) < 1e-9, "%g",
            atan2(uv[0], uv[1]) * 180.0 / (double)PI_LONG);
    cm_mapping_destroy(mapping);
}
END_TEST

START_TEST(test_bad_input)
{
    const double bad[] = {(double)NAN, (double)INFINITY, -(double)INFINITY};
    cm_rotation untouched = {{{7.0, 7.0, 7.0}, {7.0, 7.0, 7.0}, {7.0, 7.0, 7.0}}};
    const cm_rotation before = untouched;
    for (size_t i = 0; i < COUNT(bad); i++)
    {
        ck_assert_int_eq(cm_rotation_from_angles(bad[i], 0, 0, &untouched), CM_ERROR_ORIENTATION);
        ck_assert_int_eq(cm_rotation_from_angles(0, bad[i], 0, &untouched), CM_ERROR_ORIENTATION);
        ck_assert_int_eq(cm_rotation_from_angles(0, 0, bad[i], &untouched), CM_ERROR_ORIENTATION);
    }
    double over = nextafter(90.0, 91.0);
    ck_assert_int_eq(cm_rotation_from_angles(0, over, 0, &untouched), CM_ERROR_ORIENTATION);
    ck_assert_int_eq(cm_rotation_from_angles(0, -over, 0, &untouched), CM_ERROR_ORIENTATION);
    ck_assert_int_eq(cm_rotation_from_angles(0, 0, 0, NULL), CM_ERROR_ARGUMENT);
    REQUIRE(memcmp(&untouched, &before, sizeof before) == 0, "touched");

    double a = 7.0, b = 7.0, c = 7.0;
    cm_rotation rotation = rotation_of(1, 2, 3);
    ck_assert_int_eq(cm_rotation_check(NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_rotation_angles(NULL, &a, &b, &c), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_rotation_angles(&rotation, NULL, &b, &c), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_rotation_angles(&rotation, &a, NULL, &c), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_rotation_angles(&rotation, &a, &b, NULL), CM_ERROR_ARGUMENT);
    for (int i = 0; i < 9; i++)
    {
        const double wrong[] = {rotation.row[i / 3][i % 3] + 1e-11, (double)NAN, (double)INFINITY,
                                1e300};
        for (size_t k = 0; k < COUNT(wrong); k++)
        {
            cm_rotation changed = rotation;
            changed.row[i / 3][i % 3] = wrong[k];
            ck_assert_int_eq(cm_rotation_check(&changed), CM_ERROR_ORIENTATION);
            ck_assert_int_eq(cm_rotation_angles(&changed, &a, &b, &c), CM_ERROR_ORIENTATION);
        }
    }
    cm_rotation mirrored = rotation;
    for (int i = 0; i < 3; i++)
    {
        mirrored.row[2][i] = -mirrored.row[2][i];
    }
    ck_assert_int_eq(cm_rotation_check(&mirrored), CM_ERROR_ORIENTATION);
    REQUIRE(a == 7.0 && b == 7.0 && c == 7.0, "touched");
}
END_TEST

static void check_refused(const char *text)
{
    cm_rotation rotation = {{{7.0}}};
    char message[200] = "";
    ck_assert_msg(cm_rotation_parse(text, &rotation, message, sizeof message) ==
                      CM_ERROR_ORIENTATION,
                  "'%s'", text);
    REQUIRE(rotation.row[0][0] == 7.0 && message[0] != '\0' && strlen(message) < 199, "'%s': '%s'",
            text, message);
    for (const char *at = message; *at != '\0'; at++)
    {
        REQUIRE((unsigned char)*at >= 0x20, "'%s': '%s'", text, message);
    }
    char little[5] = {1, 1, 1, 1, 1};
    cm_rotation_parse(text, &rotation, little, 4);
    REQUIRE(little[3] == '\0' && little[4] == 1 && strncmp(little, message, 3) == 0, "'%s'", text);
    cm_rotation_parse(text, &rotation, little + 4, 0);
    REQUIRE(little[4] == 1, "'%s'", text);
    cm_rotation_parse(text, &rotation, NULL, 10);
}

START_TEST(test_texts)
{
    static const struct
    {
        const char *text;
        double lon, lat, roll;
    } good[] = {{"0,0", 0, 0, 0},
                {"17,-10,32", 17, -10, 32},
                {"-20.5,+10,3e1", -20.5, 10, 30},
                {"400,90,-1e3", 400, 90, -1000},
                {".5,-.5,5.", 0.5, -0.5, 5.0}};
    static const char *const bad[] = {
        "",      ",",       "1",        "1,",      ",1",       "1,2,",  "1,2,3,",  "1,2,3,4",
        "a,b",   "1;2",     "1 ,2",     " 1,2",    "1,2 ",     "1,91",  "1,-90.1", "1,2,nan",
        "inf,0", "1e400,2", "0x10,2",   "1,2,3e",  "1.2.3,4",  "--1,2", "land",    "land-",
        "\n",    "\x01,2",  "a\tb,c\n", "1e400,0", "0,0,1e999"};
    setlocale(LC_ALL, "de_DE.UTF-8"); /* where there is one: a comma for the point */
    for (size_t i = 0; i < COUNT(good); i++)
    {
        char message[20] = "untouched";
        cm_rotation rotation;
        ck_assert_msg(cm_rotation_parse(good[i].text, &rotation, message, sizeof message) == CM_OK,
                      "%s", good[i].text);
        cm_rotation wanted = rotation_of(good[i].lon, good[i].lat, good[i].roll);
        REQUIRE(apart(&rotation, &wanted) == 0.0 && strcmp(message, "untouched") == 0, "%s",
                good[i].text);
    }
    setlocale(LC_ALL, "C");
    for (size_t i = 0; i < COUNT(bad); i++)
    {
        check_refused(bad[i]);
    }
    char longest[1000];
    memset(longest, '1', sizeof longest - 1);
    longest[sizeof longest - 1] = '\0';
    check_refused(longest);
    longest[500] = ',';
    check_refused(longest);
    cm_rotation rotation;
    char message[100] = "";
    ck_assert_int_eq(cm_rotation_parse(NULL, &rotation, message, sizeof message),
                     CM_ERROR_ARGUMENT);
    REQUIRE(message[0] != '\0', "no message");
    ck_assert_int_eq(cm_rotation_parse("1,2", NULL, NULL, 0), CM_ERROR_ARGUMENT);
}
END_TEST

/* The named ones are found by their names, and are rotations. */
START_TEST(test_named)
{
    for (size_t i = 0; i < cm_orientation_count(); i++)
    {
        const cm_orientation *named = cm_orientation_at(i);
        cm_rotation parsed;
        cm_rotation wanted = rotation_of(named->lon, named->lat, named->roll);
        REQUIRE(cm_orientation_find(named->identifier) == named, "%s", named->identifier);
        REQUIRE(named->size == sizeof *named && named->name[0] != '\0', "%s", named->identifier);
        REQUIRE(named->after < named->before, "%s", named->identifier);
        ck_assert_int_eq(cm_specification_check(named->mapping, NULL, 0), CM_OK);
        ck_assert_int_eq(cm_rotation_parse(named->identifier, &parsed, NULL, 0), CM_OK);
        REQUIRE(apart(&parsed, &wanted) == 0.0, "%s", named->identifier);
    }
    ck_assert_ptr_null(cm_orientation_at(cm_orientation_count()));
    ck_assert_ptr_null(cm_orientation_at(SIZE_MAX));
    ck_assert_ptr_null(cm_orientation_find("no such orientation"));
    ck_assert_ptr_null(cm_orientation_find(""));
    ck_assert_ptr_null(cm_orientation_find(NULL));
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        test_angles,    test_multiples_of_90, test_directions, test_with_a_mapping,
        test_bad_input, test_texts,           test_named,      NULL};
    return run_suite("rotation", tests);
}
