/* SPDX-License-Identifier: MIT
 *
 * Surfaces: where the sphere lies on pictures, in every kind and every layout.
 */
#include <cubemap/image.h>

#include "tests/suite.h"

#define PI 3.14159265358979323846

/* What a kind shows. */
typedef struct kind_case
{
    const char *specification;
    int is_whole;    /* every direction? */
    int has_gaps;    /* positions without a direction? */
    int has_doubles; /* directions on two planes, inside of both? */
} kind_case;

static const kind_case cases[] = {
    {"equirect;size=48", 1, 0, 0},
    {"equirect;size=7;height=3", 1, 0, 0},
    {"equirect;size=1", 1, 0, 0},
    {"equirect;west=-10;east=35;south=-5;north=40;size=33;height=30", 0, 0, 0},
    {"equirect;west=170;east=200;south=-90;north=0;size=20", 0, 0, 0},
    {"equal-area;size=40", 1, 0, 0},
    {"mercator;size=32", 0, 0, 0},
    {"cube;size=9", 1, 0, 0},
    {"cube:qsc;frame=gl;layout=strip;size=8", 1, 0, 0},
    {"cube:gnomonic;frame=fits;layout=column;size=8", 1, 0, 0},
    {"cube:tangent;frame=s2;layout=3x2;size=7", 1, 0, 0},
    {"cube:s2;layout=2x3;size=8", 1, 0, 0},
    {"cube;layout=cross;size=8", 1, 0, 0},
    {"cube;frame=gl;layout=cross;size=8", 1, 0, 0},
    {"cube;frame=s2;layout=cross;size=8", 1, 0, 0},
    {"cube;layout=cross:north=2,south=0;size=8", 1, 0, 0},
    {"cube;frame=fits;layout=cross:south=3;size=8", 1, 0, 0},
    {"cube;layout=vcross;size=8", 1, 0, 0},
    {"cube;frame=gl;layout=vcross;size=8", 1, 0, 0},
    {"cube:tangent;layout=eac;size=8", 1, 0, 0},
    {"cube:tangent;frame=s2;layout=eac:pad=3;size=8", 1, 0, 0},
    {"cube;layout=vcross;size=1", 1, 0, 0},
    {"cube;layout=faces:border=4;size=8", 1, 0, 0},
    {"cube:qsc;frame=gl;layout=3x2:border=1;size=7", 1, 0, 0},
    {"cube;frame=fits;layout=column:border=2;size=8", 1, 0, 0},
    {"view:fov=90;size=20", 0, 0, 0},
    {"view:vfov=60,lon=100,lat=-40,roll=20;size=24;aspect=1.5", 0, 0, 0},
    {"view:focal=28,shift-x=0.4,shift-y=-1.2;size=21;height=14", 0, 0, 0},
    {"view:fov=170,lat=90;size=16", 0, 0, 0},
    {"fisheye;size=20", 0, 1, 0},
    {"fisheye:equisolid:fov=220;size=40;height=20", 0, 1, 0},
    {"fisheye:stereographic:fov=180,lon=40,lat=10;size=30;height=20;x=11.5;y=7;radius=13.25", 0, 1,
     0},
    {"fisheye:gnomonic:fov=120;size=17", 0, 1, 0},
    {"fisheye:orthographic;size=17", 0, 1, 0},
    {"fisheye:breusing:fov=360;size=24", 1, 1, 0},
    {"fisheye:equidistant:fov=100;size=20;radius=40", 0, 0, 0},
    {"dual-fisheye;size=40", 1, 1, 0},
    {"dual-fisheye:fov=220;size=40", 1, 1, 1},
    {"dual-fisheye:lambert:fov=190;size=44;height=22;x=11.5;radius=10", 1, 1, 1},
    {"dual-paraboloid;size=40", 1, 1, 0},
    {"healpix:1", 1, 0, 0},
    {"healpix:7", 1, 0, 0},
    {"healpix;size=16", 1, 0, 0},
    {"azimuthal:equidistant:fov=185;size=20", 0, 1, 0},
    {"azimuthal:lambert:fov=360;size=21", 1, 1, 0},
    {"quincuncial:stereographic,conformal;size=16", 1, 0, 0},
    {"border:lambert,shirley;size=16", 1, 0, 0},
    {"octahedral;size=16", 1, 0, 0},
    {"rhealpix;size=18", 1, 1, 0},
};
#define CASES (sizeof cases / sizeof *cases)

/* Directions of hard points: axes, diagonals, edges of cubes and what is beside them. */
static const double values[] = {0.0,    1.0,   -1.0, 0.5, -0.5, 0.99999999999999989,
                                1e-300, -1e-9, 0.6,  -0.8};
#define VALUES (sizeof values / sizeof *values)

static cm_surface *make(const char *specification)
{
    cm_surface *surface = NULL;
    char message[300] = "";
    const cm_surface_options options = {.size = sizeof options};
    cm_surface_check(specification, NULL, message, sizeof message);
    REQUIRE(cm_surface_create(specification, &options, &surface) == CM_OK, "%s: %s", specification,
            message);
    return surface;
}

static double angle(const double a[3], const double b[3])
{
    return hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
}

/* ---- positions and directions ---- */

/* Halves of pixels: centres, edges and corners. */
static void check_place(const cm_surface *surface, const kind_case *at, uint8_t plane,
                        double column, double row, size_t *gaps)
{
    double d[3], e[3], x, y;
    uint8_t found;
    const int is_centre = column != floor(column) && row != floor(row);
    cm_surface_directions(surface, 1, &plane, &column, &row, &d[0], &d[1], &d[2]);
    if (isnan(d[0]))
    {
        *gaps += 1;
        REQUIRE(at->has_gaps && isnan(d[1]) && isnan(d[2]), "%s: plane %d, %g %g",
                at->specification, plane, column, row);
        return;
    }
    REQUIRE(fabs(sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) - 1.0) < 1e-15, "%s",
            at->specification);
    cm_surface_positions(surface, 1, &d[0], &d[1], &d[2], &found, &x, &y);
    REQUIRE(found < cm_surface_plane_count(surface), "%s: plane %d, %.17g %.17g is lost",
            at->specification, plane, column, row);
    const double away = found == plane ? hypot(x - column, y - row) : HUGE_VAL;
    if (is_centre && !at->has_doubles && !at->has_gaps)
    {
        REQUIRE(away <= 1e-9, "%s: plane %d, %.17g %.17g is on %d at %.17g %.17g",
                at->specification, plane, column, row, found, x, y);
    }
    /* what is on several planes, or on the border of one twice, is the same direction there */
    if (away > 1e-9)
    {
        cm_surface_directions(surface, 1, &found, &x, &y, &e[0], &e[1], &e[2]);
        REQUIRE(angle(d, e) < 1e-14, "%s: plane %d, %.17g %.17g is on %d at %.17g %.17g, %g off",
                at->specification, plane, column, row, found, x, y, angle(d, e));
    }
}

START_TEST(test_positions_return)
{
    for (size_t i = 0; i < CASES; i++)
    {
        cm_surface *surface = make(cases[i].specification);
        size_t gaps = 0;
        for (size_t plane = 0; plane < cm_surface_plane_count(surface); plane++)
        {
            for (uint32_t row = 0; row <= 2 * cm_surface_plane_height(surface); row++)
            {
                for (uint32_t column = 0; column <= 2 * cm_surface_plane_width(surface); column++)
                {
                    check_place(surface, &cases[i], (uint8_t)plane, 0.5 * column, 0.5 * row, &gaps);
                }
            }
        }
        ck_assert_int_eq(gaps > 0, cases[i].has_gaps);
        cm_surface_destroy(surface);
    }
}
END_TEST

/* Is the map flat somewhere? There a rounding of the plane is its root on the sphere. */
static int is_flat(const kind_case *at)
{
    static const char *const flat[] = {"lambert", "orthographic", "equal-area"};
    for (size_t i = 0; i < sizeof flat / sizeof *flat; i++)
    {
        if (strstr(at->specification, flat[i]) != NULL)
        {
            return 1;
        }
    }
    return 0;
}

/* What is beside a rim by less than 1e-9 is on it. */
static void check_direction(const cm_surface *surface, const kind_case *at, const double d[3])
{
    uint8_t plane;
    double x, y, e[3];
    cm_surface_positions(surface, 1, &d[0], &d[1], &d[2], &plane, &x, &y);
    if (plane == CM_NO_FACE)
    {
        REQUIRE(!at->is_whole && isnan(x) && isnan(y), "%s: %.17g %.17g %.17g", at->specification,
                d[0], d[1], d[2]);
        return;
    }
    REQUIRE(plane < cm_surface_plane_count(surface) && x >= 0.0 && y >= 0.0 &&
                x <= cm_surface_plane_width(surface) && y <= cm_surface_plane_height(surface),
            "%s: plane %d, %g %g", at->specification, plane, x, y);
    cm_surface_directions(surface, 1, &plane, &x, &y, &e[0], &e[1], &e[2]);
    const double scale = fmax(fmax(fabs(d[0]), fabs(d[1])), fabs(d[2]));
    double unit[3] = {d[0] / scale, d[1] / scale, d[2] / scale};
    const double length = hypot(hypot(unit[0], unit[1]), unit[2]);
    unit[0] /= length;
    unit[1] /= length;
    unit[2] /= length;
    REQUIRE(angle(unit, e) < (is_flat(at)    ? 1e-7
                              : at->has_gaps ? 2e-9
                                             : 1e-13),
            "%s: %.17g %.17g %.17g comes back %g off", at->specification, d[0], d[1], d[2],
            angle(unit, e));
}

START_TEST(test_directions_have_places)
{
    for (size_t i = 0; i < CASES; i++)
    {
        cm_surface *surface = make(cases[i].specification);
        for (size_t k = 0; k < VALUES * VALUES * VALUES; k++)
        {
            const double d[3] = {values[k % VALUES], values[k / VALUES % VALUES],
                                 values[k / VALUES / VALUES]};
            if (d[0] != 0.0 || d[1] != 0.0 || d[2] != 0.0)
            {
                check_direction(surface, &cases[i], d);
            }
        }
        for (int k = 0; k < 2000; k++)
        {
            const double z = (k + 0.5) / 1000.0 - 1.0;
            const double lon = k * 2.39996322972865332;
            const double rho = sqrt(1.0 - z * z);
            const double d[3] = {rho * cos(lon), rho * sin(lon), z};
            check_direction(surface, &cases[i], d);
        }
        cm_surface_destroy(surface);
    }
}
END_TEST

/* Angles of a view go round, as those of a rotation do. */
START_TEST(test_angles_of_views_go_round)
{
    static const char *const same[][2] = {
        {"view:fov=80,lon=370,lat=20,roll=-400;size=8",
         "view:fov=80,lon=10,lat=20,roll=-40;size=8"},
        {"view:fov=80,lon=-3590;size=8", "view:fov=80,lon=10;size=8"}};
    for (size_t i = 0; i < sizeof same / sizeof *same; i++)
    {
        cm_surface *view[2] = {make(same[i][0]), make(same[i][1])};
        for (int k = 0; k < 48; k++)
        {
            const uint8_t plane = 0;
            const double column = k % 8 + 0.5, row = k / 8 + 0.5;
            double d[2][3];
            for (int side = 0; side < 2; side++)
            {
                cm_surface_directions(view[side], 1, &plane, &column, &row, &d[side][0],
                                      &d[side][1], &d[side][2]);
            }
            ck_assert_mem_eq(d[0], d[1], sizeof *d);
        }
        cm_surface_destroy(view[0]);
        cm_surface_destroy(view[1]);
    }
}
END_TEST

/* What kinds that show a part promise of it. */
START_TEST(test_parts_of_the_sphere)
{
    cm_surface *view = make("view:fov=90,lon=30,lat=20;size=16;aspect=1");
    cm_surface *fisheye = make("fisheye:equidistant:fov=200;size=16");
    cm_rotation turn;
    ck_assert_int_eq(cm_rotation_from_angles(30.0, 20.0, 0.0, &turn), CM_OK);
    size_t seen = 0;
    for (int k = 0; k < 20000; k++)
    {
        const double z = (k + 0.5) / 10000.0 - 1.0;
        const double lon = k * 2.39996322972865332;
        const double d[3] = {sqrt(1.0 - z * z) * cos(lon), sqrt(1.0 - z * z) * sin(lon), z};
        double own[3], x, y;
        uint8_t plane;
        cm_rotate(&turn, d, own);
        const double beside = fmax(fabs(own[1]), fabs(own[2])) - own[0];
        cm_surface_positions(view, 1, &d[0], &d[1], &d[2], &plane, &x, &y);
        REQUIRE(fabs(beside) < 1e-12 || (plane == 0) == (beside < 0.0), "%g %g %g", d[0], d[1],
                d[2]);
        seen += plane == 0;
        if (plane == 0)
        {
            ck_assert_double_eq_tol(x, 8.0 + 8.0 * own[1] / own[0], 1e-12);
            ck_assert_double_eq_tol(y, 8.0 - 8.0 * own[2] / own[0], 1e-12);
        }
        const double away = acos(d[0]) * (180.0 / PI);
        cm_surface_positions(fisheye, 1, &d[0], &d[1], &d[2], &plane, &x, &y);
        REQUIRE((plane == 0) == (away < 100.0), "%g degrees", away);
        if (plane == 0)
        {
            ck_assert_double_eq_tol(hypot(x - 8.0, y - 8.0), 8.0 * away / 100.0, 1e-9);
        }
    }
    /* a face of the cube is a sixth of the sphere */
    ck_assert_uint_gt(seen, 20000 / 6 - 20);
    ck_assert_uint_lt(seen, 20000 / 6 + 20);
    cm_surface_destroy(view);
    cm_surface_destroy(fisheye);
}
END_TEST

START_TEST(test_lenses)
{
    /* a shift by 1 moves what is seen by half the width: the middle comes to the edge */
    const double ahead[3] = {1.0, 0.0, 0.0};
    static const struct
    {
        const char *specification;
        double column;
        double row;
    } lens[] = {{"view:fov=60,shift-x=1;size=30;height=20", 0.0, 10.0},
                {"view:fov=60,shift-x=-0.5;size=30;height=20", 22.5, 10.0},
                {"view:fov=60,shift-y=1;size=30;height=20", 15.0, 20.0},
                {"view:focal=18;size=30;height=20", 15.0, 10.0}};
    for (size_t i = 0; i < sizeof lens / sizeof *lens; i++)
    {
        cm_surface *surface = make(lens[i].specification);
        uint8_t plane;
        double x, y;
        cm_surface_positions(surface, 1, &ahead[0], &ahead[1], &ahead[2], &plane, &x, &y);
        ck_assert_double_eq_tol(x, lens[i].column, 1e-12);
        ck_assert_double_eq_tol(y, lens[i].row, 1e-12);
        cm_surface_destroy(surface);
    }
    /* 18 mm before 36 mm: 90 degrees wide */
    cm_surface *focal = make("view:focal=18;size=30;height=20");
    const uint8_t plane = 0;
    const double column = 30.0, row = 10.0;
    double d[3];
    cm_surface_directions(focal, 1, &plane, &column, &row, &d[0], &d[1], &d[2]);
    ck_assert_double_eq_tol(d[1], sqrt(0.5), 1e-15);
    cm_surface_destroy(focal);
}
END_TEST

START_TEST(test_bad_positions)
{
    for (size_t i = 0; i < CASES; i++)
    {
        cm_surface *surface = make(cases[i].specification);
        const double bad[][3] = {
            {0.0, 0.0, 0.0}, {(double)NAN, 1.0, 0.0}, {1.0, (double)INFINITY, 0.0}};
        for (size_t k = 0; k < sizeof bad / sizeof *bad; k++)
        {
            uint8_t plane = 0;
            double x = 0.0, y = 0.0;
            cm_surface_positions(surface, 1, &bad[k][0], &bad[k][1], &bad[k][2], &plane, &x, &y);
            REQUIRE(plane == CM_NO_FACE && isnan(x) && isnan(y), "%s, %zu", cases[i].specification,
                    k);
        }
        const double width = cm_surface_plane_width(surface);
        const struct
        {
            uint8_t plane;
            double column;
            double row;
        } none[] = {{0, -1e-3, 0.5},        {0, width + 1e-3, 0.5},
                    {0, 0.5, -1.0},         {0, (double)NAN, 0.5},
                    {CM_NO_FACE, 0.5, 0.5}, {(uint8_t)cm_surface_plane_count(surface), 0.5, 0.5}};
        for (size_t k = 0; k < sizeof none / sizeof *none; k++)
        {
            double d[3] = {0.0, 0.0, 0.0};
            cm_surface_directions(surface, 1, &none[k].plane, &none[k].column, &none[k].row, &d[0],
                                  &d[1], &d[2]);
            REQUIRE(isnan(d[0]) && isnan(d[1]) && isnan(d[2]), "%s, %zu", cases[i].specification,
                    k);
        }
        cm_surface_destroy(surface);
    }
}
END_TEST

/* ---- specifications ---- */

static void check_same(const cm_surface *a, const cm_surface *b)
{
    ck_assert_str_eq(cm_surface_specification(a), cm_surface_specification(b));
    ck_assert_uint_eq(cm_surface_width(a), cm_surface_width(b));
    ck_assert_uint_eq(cm_surface_height(a), cm_surface_height(b));
    ck_assert_uint_eq(cm_surface_picture_count(a), cm_surface_picture_count(b));
    ck_assert_uint_eq(cm_surface_plane_count(a), cm_surface_plane_count(b));
    for (int k = 0; k < 500; k++)
    {
        const double z = (k + 0.5) / 250.0 - 1.0;
        const double d[3] = {sqrt(1.0 - z * z) * cos(2.4 * k), sqrt(1.0 - z * z) * sin(2.4 * k), z};
        uint8_t planes[2];
        double places[2][2];
        cm_surface_positions(a, 1, &d[0], &d[1], &d[2], &planes[0], &places[0][0], &places[0][1]);
        cm_surface_positions(b, 1, &d[0], &d[1], &d[2], &planes[1], &places[1][0], &places[1][1]);
        ck_assert_int_eq(planes[0], planes[1]);
        ck_assert(planes[0] == CM_NO_FACE || memcmp(places[0], places[1], sizeof *places) == 0);
    }
    for (uint32_t plane = 0; plane < cm_surface_plane_count(a); plane++)
    {
        uint32_t at[2][3];
        const uint32_t column = cm_surface_plane_width(a) / 3;
        ck_assert_int_eq(cm_surface_pixel(a, plane, column, 0, &at[0][0], &at[0][1], &at[0][2]),
                         CM_OK);
        ck_assert_int_eq(cm_surface_pixel(b, plane, column, 0, &at[1][0], &at[1][1], &at[1][2]),
                         CM_OK);
        ck_assert_mem_eq(at[0], at[1], sizeof *at);
    }
}

START_TEST(test_specifications_return)
{
    for (size_t i = 0; i < CASES; i++)
    {
        cm_surface *surface = make(cases[i].specification);
        cm_surface *again = make(cm_surface_specification(surface));
        check_same(surface, again);
        cm_surface_destroy(again);
        const cm_surface_options options = {.size = sizeof options,
                                            .width = cm_surface_width(surface),
                                            .height = cm_surface_height(surface)};
        ck_assert_int_eq(cm_surface_create(cm_surface_specification(surface), &options, &again),
                         CM_OK);
        check_same(surface, again);
        cm_surface_destroy(again);
        cm_surface_destroy(surface);
    }
}
END_TEST

START_TEST(test_kinds)
{
    ck_assert_uint_gt(cm_surface_kind_count(), 8);
    ck_assert_ptr_null(cm_surface_kind_at(cm_surface_kind_count()));
    for (size_t i = 0; i < cm_surface_kind_count(); i++)
    {
        const cm_surface_kind *kind = cm_surface_kind_at(i);
        char text[200], message[300];
        ck_assert(strlen(kind->name) > 0 && kind->parameters != NULL);
        snprintf(text, sizeof text, "%s;size=24", kind->identifier);
        REQUIRE(cm_surface_check(text, NULL, message, sizeof message) == CM_OK, "%s: %s", text,
                message);
        /* a key that it does not have is told with those that it has */
        snprintf(text, sizeof text, "%s;size=24;colour=red", kind->identifier);
        ck_assert_int_eq(cm_surface_check(text, NULL, message, sizeof message), CM_ERROR_PARAMETER);
        REQUIRE(strstr(message, kind->keys) != NULL, "%s", message);
    }
}
END_TEST

START_TEST(test_bad_specifications)
{
    static const struct
    {
        const char *text;
        cm_status status;
        const char *message;
    } bad[] = {
        {"", CM_ERROR_SYNTAX, "KIND"},
        {"cube:", CM_ERROR_SYNTAX, "KIND"},
        {"cube;size", CM_ERROR_SYNTAX, "KEY=VALUE"},
        {"cube;size=8;size=9", CM_ERROR_SYNTAX, "twice"},
        {"cube;size=x", CM_ERROR_SYNTAX, "not a number"},
        {"cube;size=1.5", CM_ERROR_RANGE, "no size"},
        {"cube;size=0", CM_ERROR_RANGE, "from 1"},
        {"cube;size=2147483648", CM_ERROR_RANGE, "from 1"},
        {"cube;layout=strip;size=1073741824", CM_ERROR_RANGE, "no size"},
        {"cube;layout=heap;size=8", CM_ERROR_PARAMETER, "vcross"},
        {"cube;layout=cross:north=4;size=8", CM_ERROR_PARAMETER, "north=0..3"},
        {"cube;layout=cross:north=1.5;size=8", CM_ERROR_PARAMETER, "north=0..3"},
        {"cube;layout=cross:north=1,north=2;size=8", CM_ERROR_PARAMETER, "north=0..3"},
        {"cube;layout=strip:north=1;size=8", CM_ERROR_PARAMETER, "north=0..3"},
        {"cube;layout=eac:pad=-1;size=8", CM_ERROR_PARAMETER, "pad=0..4096"},
        {"cube;layout=faces:border=129;size=8", CM_ERROR_PARAMETER, "border=0..128"},
        {"cube;layout=cross:border=1;size=8", CM_ERROR_PARAMETER, "first five"},
        {"cube;frame=up;size=8", CM_ERROR_FRAME, "geo"},
        {"cube:nothing;size=8", CM_ERROR_MAPPING, "nothing"},
        {"cube:octahedral;size=8", CM_ERROR_MAPPING, "one face"},
        {"qsc;size=8", CM_ERROR_MAPPING, "cube:qsc"},
        {"nothing;size=8", CM_ERROR_MAPPING, "nothing"},
        {"square:shirley;size=8", CM_ERROR_MAPPING, "layout"},
        {"equirect:a=1;size=8", CM_ERROR_PARAMETER, "no parameters"},
        {"equirect;west=10;east=-10;size=8", CM_ERROR_RANGE, "east"},
        {"mercator;north=90;size=8", CM_ERROR_RANGE, "89.9999"},
        {"view:fov=180;size=8", CM_ERROR_RANGE, "179.999999"},
        {"view:fov=90,vfov=30;size=8", CM_ERROR_PARAMETER, "one of"},
        {"view:fov=90,fov=91;size=8", CM_ERROR_PARAMETER, "twice"},
        {"view:zoom=2;size=8", CM_ERROR_PARAMETER, "no such"},
        {"view:fov;size=8", CM_ERROR_SYNTAX, "NAME=NUMBER"},
        {"view:fov=wide;size=8", CM_ERROR_SYNTAX, "NAME=NUMBER"},
        {"view;size=8;aspect=0", CM_ERROR_RANGE, "aspect"},
        {"fisheye:nothing;size=8", CM_ERROR_MAPPING, "azimuthal"},
        {"fisheye:orthographic:fov=200;size=8", CM_ERROR_RANGE, "fov"},
        {"fisheye;size=8;radius=0", CM_ERROR_RANGE, "radius"},
        {"dual-fisheye;size=9", CM_ERROR_RANGE, "even"},
        {"dual-fisheye:lambert:lon=1;size=8", CM_ERROR_PARAMETER, "rotation"},
        {"dual-paraboloid:fov=1;size=8", CM_ERROR_PARAMETER, "no parameters"},
        {"healpix:0", CM_ERROR_SYNTAX, "NSIDE"},
        {"healpix:1.5", CM_ERROR_SYNTAX, "NSIDE"},
        {"healpix:ring", CM_ERROR_SYNTAX, "NSIDE"},
        {"healpix:8;size=9", CM_ERROR_RANGE, "8"},
        {"healpix:536870912", CM_ERROR_RANGE, "no size"},
        {"cube\n;size=8", CM_ERROR_MAPPING, "?"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
    {
        char message[400] = "";
        cm_surface *surface = NULL;
        const cm_status status = cm_surface_check(bad[i].text, NULL, message, sizeof message);
        REQUIRE(status == bad[i].status, "'%s' is %d, not %d: %s", bad[i].text, status,
                bad[i].status, message);
        REQUIRE(strstr(message, bad[i].message) != NULL && strchr(message, '\n') == NULL,
                "'%s': %s", bad[i].text, message);
        ck_assert_int_eq(cm_surface_create(bad[i].text, NULL, &surface), bad[i].status);
        ck_assert_ptr_null(surface);
    }
    ck_assert_int_eq(cm_surface_check(NULL, NULL, NULL, 0), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_surface_create("cube;size=1", NULL, NULL), CM_ERROR_ARGUMENT);
}
END_TEST

START_TEST(test_sizes)
{
    static const struct
    {
        const char *text;
        uint32_t width;
        uint32_t height;
        cm_status status;
    } sizes[] = {
        {"equirect", 0, 0, CM_ERROR_RANGE},
        {"equirect", 1, 1, CM_OK},
        {"equirect", 2147483648u, 1, CM_ERROR_RANGE},
        {"cube", 0, 0, CM_ERROR_RANGE},
        {"cube", 1, 1, CM_OK},
        {"cube", 2, 1, CM_ERROR_RANGE},
        {"cube", 2147483648u, 2147483648u, CM_ERROR_RANGE},
        {"cube;layout=cross", 4, 3, CM_OK},
        {"cube;layout=cross", 5, 3, CM_ERROR_RANGE},
        {"cube;layout=cross", 1, 1, CM_ERROR_RANGE},
        {"cube;layout=column", 715827883u, 0, CM_ERROR_RANGE},
        {"cube;layout=eac:pad=2", 7, 10, CM_OK},
        {"cube;layout=strip:border=2", 30, 5, CM_OK},
        {"cube;layout=strip:border=2", 31, 5, CM_ERROR_RANGE},
        {"cube;layout=faces:border=2", 4, 4, CM_ERROR_RANGE},
        {"cube;layout=eac:pad=2", 3, 2, CM_ERROR_RANGE},
        {"view", 1, 1, CM_OK},
        {"view", 0, 0, CM_ERROR_RANGE},
        {"view", 1, 2147483648u, CM_ERROR_RANGE},
        {"view;size=2", 3, 3, CM_ERROR_RANGE},
        {"fisheye", 1, 1, CM_OK},
        {"fisheye", 0, 0, CM_ERROR_RANGE},
        {"dual-fisheye", 2, 1, CM_OK},
        {"dual-fisheye", 1, 1, CM_ERROR_RANGE},
        {"healpix", 12, 1, CM_OK},
        {"healpix", 12, 2, CM_ERROR_RANGE},
        {"healpix", 2147483648u, 1, CM_ERROR_RANGE},
        {"octahedral", 1, 1, CM_OK},
        {"octahedral", 1, 2, CM_ERROR_RANGE},
        {"rhealpix", 0, 0, CM_ERROR_RANGE},
    };
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++)
    {
        const cm_surface_options options = {
            .size = sizeof options, .width = sizes[i].width, .height = sizes[i].height};
        cm_surface *surface = NULL;
        const cm_status status = cm_surface_create(sizes[i].text, &options, &surface);
        REQUIRE(status == sizes[i].status, "%s of %u x %u is %d, not %d", sizes[i].text,
                (unsigned)sizes[i].width, (unsigned)sizes[i].height, status, sizes[i].status);
        if (status == CM_OK)
        {
            ck_assert_uint_eq(cm_surface_width(surface), sizes[i].width);
            ck_assert_uint_eq(cm_surface_height(surface), sizes[i].height);
        }
        cm_surface_destroy(surface);
    }
}
END_TEST

START_TEST(test_pixels_are_apart)
{
    for (size_t i = 0; i < CASES; i++)
    {
        cm_surface *surface = make(cases[i].specification);
        const size_t width = cm_surface_width(surface);
        const size_t height = cm_surface_height(surface);
        unsigned char *used = calloc(width * height, cm_surface_picture_count(surface));
        ck_assert_ptr_nonnull(used);
        uint32_t at[3];
        for (uint32_t plane = 0; plane < cm_surface_plane_count(surface); plane++)
        {
            for (uint32_t row = 0; row < cm_surface_plane_height(surface); row++)
            {
                for (uint32_t column = 0; column < cm_surface_plane_width(surface); column++)
                {
                    ck_assert_int_eq(
                        cm_surface_pixel(surface, plane, column, row, &at[0], &at[1], &at[2]),
                        CM_OK);
                    ck_assert(at[0] < cm_surface_picture_count(surface) && at[1] < width &&
                              at[2] < height);
                    unsigned char *pixel = &used[(at[0] * height + at[2]) * width + at[1]];
                    REQUIRE(*pixel == 0, "%s: %u %u", cases[i].specification, (unsigned)at[1],
                            (unsigned)at[2]);
                    *pixel = 1;
                }
            }
        }
        ck_assert_int_eq(cm_surface_pixel(surface, 0, cm_surface_plane_width(surface), 0, &at[0],
                                          &at[1], &at[2]),
                         CM_ERROR_RANGE);
        free(used);
        cm_surface_destroy(surface);
    }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {test_positions_return,
                                  test_directions_have_places,
                                  test_angles_of_views_go_round,
                                  test_parts_of_the_sphere,
                                  test_lenses,
                                  test_bad_positions,
                                  test_specifications_return,
                                  test_kinds,
                                  test_bad_specifications,
                                  test_sizes,
                                  test_pixels_are_apart,
                                  NULL};
    return run_suite("surface", tests);
}
