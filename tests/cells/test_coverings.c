/* SPDX-License-Identifier: MIT
 *
 * Coverings: that no point of a region is missed and none of an inner covering is beside it, at hard places;
 * budgets and levels; what is refused.
 */
#include "cell_suite.h"

#define PI 3.14159265358979323846
#define ROOM 4096

typedef struct covering
{
    size_t count;
    cm_cell cells[ROOM];
} covering;

static covering outer, inner;
static unsigned long points_in;

static const double places[][3] = {
    {1.0, 1.0, 1.0},   {-1.0, 1.0, -1.0}, {1.0, 0.0, 0.0},      {0.0, 0.0, 1.0},
    {0.0, 0.0, -1.0},  {1.0, 1.0, 0.0},   {-1.0, 1e-15, 0.0},   {-1.0, -1e-9, 0.3},
    {1.0, 0.5, 0.25},  {0.0, 1.0, 1.0},   {1e-15, 1e-15, -1.0}, {1.0, 1.0 + 1e-12, 1.0},
    {1.0, -1.0, 0.99}, {0.3, -0.7, 0.1},  {1e-8, -1e-8, 1.0},   {-1.0, -1.0, 1.0 - 1e-15}};

/* A hard place, or any. */
static void some_place(uint64_t *state, int n, double place[3])
{
    if (n % 2 == 0)
    {
        memcpy(place, places[(size_t)(n / 2) % (sizeof places / sizeof places[0])],
               sizeof places[0]);
    }
    else
    {
        next_direction(state, place);
    }
}

static void to_unit(double v[3])
{
    double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int k = 0; k < 3; k++)
    {
        v[k] /= length;
    }
}

/* The point at an angle from another, in a random azimuth. */
static void beside(uint64_t *state, const double from[3], double angle, double to[3])
{
    double unit[3] = {from[0], from[1], from[2]};
    double any[3], side[3];
    to_unit(unit);
    next_direction(state, any);
    for (int k = 0; k < 3; k++)
    {
        int l = (k + 1) % 3;
        int m = (k + 2) % 3;
        side[k] = unit[l] * any[m] - unit[m] * any[l];
    }
    to_unit(side);
    for (int k = 0; k < 3; k++)
    {
        to[k] = unit[k] * cos(angle) + side[k] * sin(angle);
    }
}

static void check_form(const subject *made, const covering *c, const cm_cover_options *o)
{
    (void)made;
    for (size_t i = 0; i < c->count; i++)
    {
        int level = cm_cell_level(c->cells[i]);
        REQUIRE(level >= o->level_min && level <= o->level_max, "a cell of level %d", level);
        REQUIRE(i == 0 || (c->cells[i - 1] < c->cells[i] &&
                           !cm_cell_intersects(c->cells[i - 1], c->cells[i])),
                "not in order");
        cm_cell parent = cm_cell_parent(c->cells[i], level - 1);
        REQUIRE(i < 3 || level == o->level_min || parent == CM_NO_CELL ||
                    c->cells[i - 3] != cm_cell_child(parent, 0) ||
                    c->cells[i - 2] != cm_cell_child(parent, 1) ||
                    c->cells[i - 1] != cm_cell_child(parent, 2) ||
                    c->cells[i] != cm_cell_child(parent, 3),
                "four quarters");
    }
    size_t least = 6ull << (2 * o->level_min);
    REQUIRE(o->cells_most == 0 || c->count <= o->cells_most || c->count <= least,
            "%zu cells, not %zu", c->count, o->cells_most);
}

/* Fills outer and inner, and checks what can be checked without knowing the region. */
static void cover(const subject *made, const cm_region *region, cm_cover_options o)
{
    o.size = sizeof o;
    o.kind = CM_COVER_OUTER;
    cm_status status = cm_cover(made->cells, region, &o, ROOM, outer.cells, &outer.count);
    REQUIRE(status == CM_OK, "%s: levels %d to %d, %zu: %s (%zu)", mapping_of(made), o.level_min,
            o.level_max, o.cells_most, cm_status_text(status), outer.count);
    check_form(made, &outer, &o);
    o.kind = CM_COVER_INNER;
    status = cm_cover(made->cells, region, &o, ROOM, inner.cells, &inner.count);
    REQUIRE(status == CM_OK, "%s: inner: %s", mapping_of(made), cm_status_text(status));
    check_form(made, &inner, &o);
    for (size_t i = 0; i < inner.count; i++)
    {
        REQUIRE(o.cells_most != 0 ||
                    cm_cell_union_contains(outer.count, outer.cells, inner.cells[i]) ||
                    cm_cell_union_intersects(outer.count, outer.cells, inner.cells[i]),
                "inner and not outer");
        double corner[4][3];
        cm_cell_corners(made->cells, inner.cells[i], corner);
        for (int k = 0; k < 4; k++)
        {
            REQUIRE(cm_region_contains(region, corner[k]), "%s: a corner of %llx is outside",
                    mapping_of(made), (unsigned long long)inner.cells[i]);
        }
    }
}

/* A point that is in the region. */
static void must_cover(const subject *made, const double normal[3], const char *what)
{
    cm_cell leaf = cm_cell_forward(made->cells, CM_CELL_LEVEL_MAX, normal);
    points_in++;
    REQUIRE(cm_cell_union_contains(outer.count, outer.cells, leaf),
            "%s %s, %s: %.17g %.17g %.17g is missed", mapping_of(made), made->frame->identifier,
            what, normal[0], normal[1], normal[2]);
}

/* A point that is outside. */
static void must_not_be_inner(const subject *made, const double normal[3], const char *what)
{
    cm_cell leaf = cm_cell_forward(made->cells, CM_CELL_LEVEL_MAX, normal);
    REQUIRE(!cm_cell_union_contains(inner.count, inner.cells, leaf),
            "%s %s, %s: %.17g %.17g %.17g is outside", mapping_of(made), made->frame->identifier,
            what, normal[0], normal[1], normal[2]);
}

/* Budgets and levels in turn, such that there is room for the result. */
static cm_cover_options some_options(uint64_t *state, double radius)
{
    cm_cover_options o = {.size = sizeof o};
    int fitting = (int)fmin(30.0, fmax(0.0, 3.0 - log2(radius + 1e-12)));
    switch (next_bits(state) % 4)
    {
    case 0:
        o.level_min = o.level_max = fitting;
        break;
    case 1:
        o.level_max = 30;
        o.cells_most = 1 + (size_t)(next_bits(state) % 100);
        break;
    case 2:
        o.level_min = fitting > 2 ? fitting - 2 : 0;
        o.level_max = fitting + 2 < 30 ? fitting + 2 : 30;
        o.cells_most = 50;
        break;
    default:
        o.level_max = fitting;
        break;
    }
    return o;
}

/* ---- Caps ---- */

/* The share of its cap's radius by which an outer cell is beside the region, as far as points of it tell. */
static double slack_of(const subject *made, const double middle[3], double radius)
{
    double most = 0.0;
    for (size_t i = 0; i < outer.count && i < 60; i++)
    {
        uint8_t face;
        double low[2], high[2], normal[3], reach;
        if (cm_cell_level(outer.cells[i]) == CM_CELL_LEVEL_MAX)
        {
            continue;
        }
        double nearest = INFINITY;
        cm_cell_square(cm_cell_grid_curve(made->cells), outer.cells[i], &face, low, high);
        cm_cell_bounding_cap(made->cells, outer.cells[i], normal, &reach);
        for (int k = 0; k < 17 * 17; k++)
        {
            const double uv[2] = {low[0] + (k % 17) / 16.0 * (high[0] - low[0]),
                                  low[1] + (k / 17) / 16.0 * (high[1] - low[1])};
            double at[3];
            cm_grid_inverse(made->grid, face, uv, at);
            nearest = fmin(nearest, angle_between(at, middle) - radius);
        }
        most = fmax(most, nearest / reach);
    }
    return most;
}

START_TEST(caps)
{
    uint64_t state = 71;
    double slack = 0.0;
    for (size_t m = 0; m < cube_count(); m++)
    {
        subject made = make_turn(m);
        for (int n = 0; n < 60; n += (int)step_of(7))
        {
            double middle[3];
            double radius = n % 10 == 0 ? 0.0 : pow(10.0, -4.5 + 4.9 * next_real(&state));
            cm_region *region;
            some_place(&state, n + (int)m, middle);
            ck_assert_int_eq(cm_region_cap(middle, radius, &region), CM_OK);
            cover(&made, region, some_options(&state, radius));
            for (int k = 0; k < 60; k++)
            {
                double at[3];
                double share = k % 3 == 0 ? 1.0 : sqrt(0.5 + 0.5 * next_real(&state));
                beside(&state, middle, fmin(share * radius, PI), at);
                must_cover(&made, at, "a cap");
                if (radius < 3.0)
                {
                    beside(&state, middle, radius * (1.0 + 1e-3 * (k + 1)) + 1e-13, at);
                    must_not_be_inner(&made, at, "a cap");
                    REQUIRE(!cm_region_contains(region, at), "beside a cap");
                }
            }
            must_cover(&made, middle, "the middle");
            ck_assert(cm_region_contains(region, middle));
            if (n % 6 == 1)
            {
                slack = fmax(slack, slack_of(&made, middle, radius));
            }
            cm_region_destroy(region);
        }
        drop_subject(&made);
    }
    printf("caps: cells up to %.3f of their radius beside them, by points\n", slack);
    ck_assert(slack <= 0.25);
}
END_TEST

START_TEST(whole_and_half_spheres)
{
    subject made = make_turn(1);
    const double middle[3] = {0.0, 0.0, 1.0};
    static const double radii[] = {PI, 4.0, INFINITY, PI / 2.0};
    for (size_t k = 0; k < 4; k++)
    {
        cm_region *region;
        ck_assert_int_eq(cm_region_cap(middle, radii[k], &region), CM_OK);
        cover(&made, region, (cm_cover_options){.level_max = 4});
        ck_assert_uint_eq(outer.count == 6, k < 3);
        ck_assert(k == 3 || (inner.count == 6 && memcmp(inner.cells, outer.cells, 48) == 0));
        cm_region_destroy(region);
    }
    cm_region *region;
    ck_assert_int_eq(cm_region_box(-PI, -PI / 2.0, PI, PI / 2.0, &region), CM_OK);
    cover(&made, region, (cm_cover_options){.level_min = 2, .level_max = 4});
    ck_assert_uint_eq(outer.count, 96);
    ck_assert_uint_eq(inner.count, 96);
    cm_region_destroy(region);
    drop_subject(&made);
}
END_TEST

/* A cap of metres contains what is so far along a meridian or a parallel, which are the extremes. */
START_TEST(caps_of_metres)
{
    static const char *const texts[] = {"WGS84", "6371000", "6378137,20", "6378137,-20"};
    for (size_t e = 0; e < 4; e++)
    {
        cm_ellipsoid ellipsoid;
        ck_assert_int_eq(cm_ellipsoid_parse(texts[e], &ellipsoid, NULL, 0), CM_OK);
        double square = ellipsoid.f * (2.0 - ellipsoid.f);
        double metres = 1000.0;
        double angle = cm_cap_radius(&ellipsoid, metres);
        for (int k = -90; k <= 90; k++)
        {
            double s = sin(k * PI / 180.0);
            double w = 1.0 - square * s * s;
            double meridian = ellipsoid.a * (1.0 - square) / (w * sqrt(w));
            double prime = ellipsoid.a / sqrt(w);
            ck_assert(metres / meridian <= angle * (1.0 + 1e-14) &&
                      metres / prime <= angle * (1.0 + 1e-14));
        }
        ck_assert(angle <= 1.17 * metres / ellipsoid.a);
    }
    cm_ellipsoid bad = {.size = 0};
    ck_assert(isnan(cm_cap_radius(NULL, 1.0)) && isnan(cm_cap_radius(&bad, 1.0)) &&
              isnan(cm_cap_radius(cm_ellipsoid_find("WGS84"), -1.0)) &&
              isnan(cm_cap_radius(cm_ellipsoid_find("WGS84"), NAN)));
    ck_assert(cm_cap_radius(cm_ellipsoid_find("WGS84"), 0.0) == 0.0);
}
END_TEST

/* ---- Boxes ---- */

START_TEST(boxes)
{
    static const double box_table[][4] = {
        {0.1, 0.2, 0.5, 0.6},
        {3.0, -0.4, -3.0, 0.3},            /* over the antimeridian */
        {-PI, 1.2, PI, PI / 2.0},          /* a polar cap */
        {0.0, -PI / 2.0, 2.0 * PI, -1.55}, /* the other one, tiny */
        {1.0, 0.5, 1.0, 0.5},              /* a point */
        {0.5, -1.0, 0.5, 1.0},             /* a part of a meridian */
        {-1.0, 0.7, 2.0, 0.7},             /* of a parallel */
        {0.3, 1.3, 0.4, PI / 2.0},         /* to the pole */
        {-2.0, -PI / 2.0, 1.5, PI / 2.0},  /* from pole to pole */
        {PI / 4.0, 0.6154797086703873, PI / 4.0 + 1e-9, 0.6154797086703873 + 1e-9}, /* a corner */
        {-PI, -1e-9, -PI + 1e-9, 1e-9},
        {7.0, -0.1, 7.5, 0.1}, /* turns of longitude */
        {-100.0, 0.0, -99.0, 0.5},
        {0.0, -0.2, 6.28, 0.2}, /* nearly all round */
        {0.0, 1.5707963, 1.0, 1.5707963267948966}};
    uint64_t state = 73;
    for (size_t m = 0; m < cube_count(); m += 2 * step_of(4))
    {
        subject made = make_turn(m);
        for (size_t b = 0; b < 2 * sizeof box_table / sizeof box_table[0]; b++)
        {
            const double *box = box_table[b / 2];
            double width = box[2] - box[0] + (box[2] < box[0] ? 2.0 * PI : 0.0);
            cm_region *region;
            ck_assert_int_eq(cm_region_box(box[0], box[1], box[2], box[3], &region), CM_OK);
            cm_cover_options o = {.level_max = 30, .cells_most = 5 + b};
            if (b % 2 == 1)
            {
                o = (cm_cover_options){.level_max = 5};
            }
            cover(&made, region, o);
            for (int k = 0; k < 200; k++)
            {
                double s = k % 4 == 0 ? (k >> 2 & 1) : 0.5 + 0.5 * next_real(&state);
                double t = k % 4 == 1 ? (k >> 2 & 1) : 0.5 + 0.5 * next_real(&state);
                double lat = box[1] + t * (box[3] - box[1]);
                double normal[3];
                cm_direction_from_lonlat(box[0] + s * width, fmin(lat, PI / 2.0), normal);
                must_cover(&made, normal, "a box");
                REQUIRE(cm_region_contains(region, normal), "box %zu: %g %g", b / 2, s, t);
                /* beside it */
                double away = 1e-3 + 0.1 * (1.0 + next_real(&state));
                if (box[3] + away < 1.57 && box[1] < 1.5)
                {
                    cm_direction_from_lonlat(box[0] + s * width, box[3] + away, normal);
                    must_not_be_inner(&made, normal, "a box");
                    ck_assert(!cm_region_contains(region, normal));
                }
                if (width + away < 2.0 * PI - 0.01 && fabs(lat) < 1.5)
                {
                    cm_direction_from_lonlat(box[0] + width + away, lat, normal);
                    must_not_be_inner(&made, normal, "a box");
                    ck_assert(away + width > 2.0 * PI || !cm_region_contains(region, normal));
                }
            }
            cm_region_destroy(region);
        }
        drop_subject(&made);
    }
}
END_TEST

/* ---- Polygons ---- */

/* A star about a place, anticlockwise, whose points are at the radius and at part of it. */
static size_t make_star(const double middle[3], double radius, double notch, size_t corners,
                        double *lonlat)
{
    double axis[3] = {middle[0], middle[1], middle[2]};
    double east[3], north[3];
    const double other[3] = {fabs(middle[0]) > 0.7 ? 0.0 : 1.0, fabs(middle[0]) > 0.7 ? 1.0 : 0.0,
                             0.0};
    to_unit(axis);
    for (int k = 0; k < 3; k++)
    {
        int l = (k + 1) % 3, m = (k + 2) % 3;
        east[k] = other[l] * axis[m] - other[m] * axis[l];
    }
    to_unit(east);
    for (int k = 0; k < 3; k++)
    {
        int l = (k + 1) % 3, m = (k + 2) % 3;
        north[k] = axis[l] * east[m] - axis[m] * east[l];
    }
    for (size_t i = 0; i < corners; i++)
    {
        double azimuth = 2.0 * PI * (double)i / (double)corners;
        double r = i % 2 == 0 ? radius : radius * notch;
        double at[3];
        for (int k = 0; k < 3; k++)
        {
            at[k] = axis[k] * cos(r) + sin(r) * (east[k] * cos(azimuth) + north[k] * sin(azimuth));
        }
        cm_lonlat_from_direction(at, lonlat + 2 * i);
    }
    return corners;
}

/* By the sum of angles at which the edges are seen: 2 pi inside, 0 outside, for what is less than a hemisphere. */
static int is_inside(const double p[3], size_t count, const double *lonlat)
{
    double sum = 0.0;
    for (size_t i = 0; i < count; i++)
    {
        double a[3], b[3], normal[3];
        const double *next = lonlat + 2 * ((i + 1) % count);
        cm_direction_from_lonlat(lonlat[2 * i], lonlat[2 * i + 1], a);
        cm_direction_from_lonlat(next[0], next[1], b);
        double ab = 0.0, ap = 0.0, bp = 0.0, volume = 0.0;
        for (int k = 0; k < 3; k++)
        {
            int l = (k + 1) % 3, m = (k + 2) % 3;
            normal[k] = a[l] * b[m] - a[m] * b[l];
            ab += a[k] * b[k];
            ap += a[k] * p[k];
            bp += b[k] * p[k];
            volume += normal[k] * p[k];
        }
        sum += atan2(volume, ab - ap * bp);
    }
    return sum > PI;
}

START_TEST(polygons)
{
    uint64_t state = 79;
    static double lonlat[2 * 40];
    for (size_t m = 0; m < cube_count(); m++)
    {
        subject made = make_turn(m);
        for (int n = 0; n < 24; n += (int)step_of(5))
        {
            double middle[3];
            double radius = pow(10.0, -3.0 + 3.1 * next_real(&state));
            size_t corners = 4 + 2 * (size_t)(next_bits(&state) % 18);
            double notch = n % 3 == 0 ? 1.0 : 0.35;
            cm_region *region;
            some_place(&state, n + (int)m, middle);
            to_unit(middle);
            radius = fmin(radius, 1.2);
            make_star(middle, radius, notch, corners, lonlat);
            ck_assert_int_eq(cm_region_polygon(1, &corners, lonlat, &region), CM_OK);
            cover(&made, region, some_options(&state, radius));
            must_cover(&made, middle, "the middle");
            for (int k = 0; k < 150; k++)
            {
                double at[3];
                beside(&state, middle, radius * sqrt(0.5 + 0.5 * next_real(&state)), at);
                if (radius > 1e-3 && !is_inside(at, corners, lonlat))
                {
                    must_not_be_inner(&made, at, "a polygon");
                    REQUIRE(!cm_region_contains(region, at), "outside a polygon");
                }
                else if (radius > 1e-3)
                {
                    must_cover(&made, at, "a polygon");
                    REQUIRE(cm_region_contains(region, at), "in a polygon");
                }
                else if (angle_between(at, middle) < 0.1 * radius)
                {
                    must_cover(&made, at, "a tiny polygon");
                }
                beside(&state, middle, radius * (1.0 + 0.1 * (k + 1) / 150.0) + 1e-13, at);
                must_not_be_inner(&made, at, "a polygon");
            }
            for (size_t i = 0; i < corners; i++)
            {
                double at[3];
                cm_direction_from_lonlat(lonlat[2 * i], lonlat[2 * i + 1], at);
                must_cover(&made, at, "a corner");
            }
            cm_region_destroy(region);
        }
        drop_subject(&made);
    }
    printf("%lu points were in regions\n", points_in);
}
END_TEST

/* A hole, the other way round; and a ring that is the other way round alone is all but what it encloses. */
START_TEST(rings)
{
    static double lonlat[2 * 32];
    const double middle[3] = {1.0, 1.0, 1.0};
    const size_t length[2] = {16, 16};
    double unit[3] = {1.0, 1.0, 1.0};
    uint64_t state = 83;
    subject made = make_turn(12);
    cm_region *region, *rest;
    to_unit(unit);
    make_star(unit, 0.6, 1.0, 16, lonlat);
    make_star(unit, 0.3, 1.0, 16, lonlat + 32);
    for (int i = 0; i < 8; i++)
    {
        for (int k = 0; k < 2; k++)
        {
            double kept = lonlat[32 + 2 * i + k];
            lonlat[32 + 2 * i + k] = lonlat[32 + 2 * (15 - i) + k];
            lonlat[32 + 2 * (15 - i) + k] = kept;
        }
    }
    ck_assert_int_eq(cm_region_polygon(2, length, lonlat, &region), CM_OK);
    ck_assert_int_eq(cm_region_polygon(1, length, lonlat + 32, &rest), CM_OK);
    for (int turn = 0; turn < 2; turn++)
    {
        cover(&made, turn == 0 ? region : rest, (cm_cover_options){.level_max = 6});
        for (int k = 0; k < 3000; k++)
        {
            double at[3];
            double angle = PI * (0.5 + 0.5 * next_real(&state));
            int is_in = turn == 0 ? angle > 0.302 && angle < 0.58 : angle > 0.302;
            int is_out = turn == 0 ? angle < 0.29 || angle > 0.602 : angle < 0.29;
            beside(&state, middle, angle, at);
            if (is_in)
            {
                must_cover(&made, at, "a ring");
            }
            if (is_out)
            {
                must_not_be_inner(&made, at, "a ring");
            }
            REQUIRE(cm_region_contains(turn == 0 ? region : rest, at) == is_in || is_in == is_out,
                    "at %g", angle);
        }
    }
    cm_region_destroy(region);
    cm_region_destroy(rest);
    drop_subject(&made);
}
END_TEST

/* A spike is left out, and so is a spike of a spike. */
START_TEST(spikes_of_rings)
{
    static const double spike[] = {0.0, -0.1, 0.3, -0.1, 0.3, 0.2, 0.0,
                                   0.2, 0.0,  0.0, -0.2, 0.0, 0.0, 0.0};
    static const double spikes[] = {0.0, 0.0, 0.5, 0.0, -0.3, 0.0, 0.2, 0.0, 0.2, 0.2, 0.0, 0.2};
    static const struct
    {
        const double *lonlat;
        size_t corners;
        double lon; /* on the spike */
    } made_of[] = {
        {spike, 7, -0.1}, {spike, 7, -0.2}, {spikes, 6, 0.4}, {spikes, 6, 0.5}, {spikes, 6, -0.2}};
    subject made = make_turn(3);
    for (size_t i = 0; i < sizeof made_of / sizeof made_of[0]; i++)
    {
        cm_region *region;
        double at[3];
        uint64_t state = 97;
        ck_assert_int_eq(cm_region_polygon(1, &made_of[i].corners, made_of[i].lonlat, &region),
                         CM_OK);
        cover(&made, region, (cm_cover_options){.level_max = 30, .cells_most = 200});
        cm_direction_from_lonlat(0.1, 0.1, at);
        must_cover(&made, at, "the ring");
        ck_assert(cm_region_contains(region, at));
        for (int k = 0; k < 400; k++)
        {
            const double far = pow(10.0, -16.0 + 1.5 * (k / 40)) * (1.0 + 0.1 * next_real(&state));
            cm_direction_from_lonlat(made_of[i].lon + far * cos(k * PI / 20.0),
                                     far * sin(k * PI / 20.0), at);
            REQUIRE(!cm_region_contains(region, at), "%zu: %g from %g", i, far, made_of[i].lon);
            must_not_be_inner(&made, at, "beside a spike");
        }
        cm_region_destroy(region);
    }
    drop_subject(&made);
}
END_TEST

/* ---- Room, and what is refused ---- */

START_TEST(room)
{
    subject made = make_turn(0);
    const double middle[3] = {1.0, 2.0, 3.0};
    cm_region *region;
    cm_cell cells[64];
    size_t needed = 99, count = 99;
    cm_cover_options o = {.size = sizeof o, .level_min = 4, .level_max = 4};
    ck_assert_int_eq(cm_region_cap(middle, 0.3, &region), CM_OK);
    ck_assert_int_eq(cm_cover(made.cells, region, &o, 0, NULL, &needed), CM_ERROR_SPACE);
    ck_assert(needed > 10 && needed < 64);
    memset(cells, 7, sizeof cells);
    ck_assert_int_eq(cm_cover(made.cells, region, &o, needed - 1, cells, &count), CM_ERROR_SPACE);
    ck_assert(count == needed && cells[0] == 0x0707070707070707ull);
    ck_assert_int_eq(cm_cover(made.cells, region, &o, needed, cells, &count), CM_OK);
    ck_assert(count == needed && cells[needed] == 0x0707070707070707ull);
    /* more than anybody has room for ends soon */
    o.level_min = o.level_max = 30;
    ck_assert_int_eq(cm_cover(made.cells, region, &o, 64, cells, &count), CM_ERROR_SPACE);
    ck_assert_uint_eq(count, 1u << 20);
    /* and an honest capacity is not needed where the result is small */
    o.level_min = o.level_max = 4;
    ck_assert_int_eq(cm_cover(made.cells, region, &o, SIZE_MAX, cells, &count), CM_OK);
    ck_assert_uint_eq(count, needed);
    o.cells_most = SIZE_MAX;
    ck_assert_int_eq(cm_cover(made.cells, region, &o, SIZE_MAX, cells, &count), CM_OK);
    ck_assert_uint_eq(count, needed);
    cm_region_destroy(region);
    drop_subject(&made);
}
END_TEST

/* A budget gives way to the levels that are asked for, and those to nothing but the room. */
START_TEST(levels_beyond_a_budget)
{
    subject made = make_turn(0);
    const double middle[3] = {1.0, 2.0, 3.0};
    cm_region *all, *most;
    ck_assert_int_eq(cm_region_cap(middle, 4.0, &all), CM_OK);
    ck_assert_int_eq(cm_region_cap(middle, 0.8, &most), CM_OK);
    cover(&made, all, (cm_cover_options){.level_min = 3, .level_max = 6, .cells_most = 10});
    ck_assert_uint_eq(outer.count, 6 << 6);
    ck_assert_uint_eq(inner.count, 10);

    /* many are found as well as they are without a budget */
    const size_t many = (size_t)1 << 20;
    cm_cell *cells[2] = {malloc(many * sizeof(cm_cell)), malloc(many * sizeof(cm_cell))};
    size_t count[2] = {0, 0};
    ck_assert(cells[0] != NULL && cells[1] != NULL);
    for (size_t i = 0; i < 2; i++)
    {
        const cm_cover_options o = {
            .size = sizeof o, .level_min = 10, .level_max = 10, .cells_most = i};
        ck_assert_int_eq(cm_cover(made.cells, most, &o, many, cells[i], &count[i]), CM_OK);
    }
    REQUIRE(count[0] > 900000 && count[0] == count[1], "%zu and %zu", count[0], count[1]);
    ck_assert(memcmp(cells[0], cells[1], count[0] * sizeof(cm_cell)) == 0);

    /* too many are not */
    const cm_cover_options o = {
        .size = sizeof o, .level_min = 30, .level_max = 30, .cells_most = 1};
    const cm_cell kept = cells[0][0];
    ck_assert_int_eq(cm_cover(made.cells, all, &o, many, cells[0], &count[0]), CM_ERROR_SPACE);
    REQUIRE(count[0] > many && count[0] < many + 4 && cells[0][0] == kept, "%zu", count[0]);
    free(cells[0]);
    free(cells[1]);
    cm_region_destroy(all);
    cm_region_destroy(most);
    drop_subject(&made);
}
END_TEST

/* The header's 1e-14 rad; 2e-14 for the meridians of a box. */
START_TEST(borders_are_wide)
{
    static const double corners[] = {-0.5, -0.2, 0.5, -0.2, 0.5, 0.4, -0.5, 0.4};
    static const size_t four = 4;
    cm_region *region[3];
    ck_assert_int_eq(cm_region_cap_lonlat(0.0, 0.0, 0.5, &region[0]), CM_OK);
    ck_assert_int_eq(cm_region_box(-0.5, -0.2, 0.5, 0.4, &region[1]), CM_OK);
    ck_assert_int_eq(cm_region_polygon(1, &four, corners, &region[2]), CM_OK);
    for (int i = 0; i < 3; i++)
    {
        for (int side = -1; side <= 1; side += 2)
        {
            double normal[3];
            cm_direction_from_lonlat(side * (0.5 - 2e-14), 0.0, normal);
            REQUIRE(cm_region_contains(region[i], normal), "region %d, inside", i);
            cm_direction_from_lonlat(side * (0.5 + 8e-15), 0.0, normal);
            REQUIRE(cm_region_contains(region[i], normal), "region %d, on the border", i);
            cm_direction_from_lonlat(side * (0.5 + (i == 1 ? 2.2e-14 : 1.2e-14)), 0.0, normal);
            REQUIRE(!cm_region_contains(region[i], normal), "region %d, outside", i);
        }
        cm_region_destroy(region[i]);
    }
}
END_TEST

/* A ring may end with its first corner again; and a box that runs west, by turns of a circle. */
START_TEST(closed_rings_and_boxes_by_turns)
{
    static const double lonlat[] = {0.1, 0.1, 0.9, 0.2, 0.5, 0.8, 0.1, 0.1};
    static const size_t open = 3, closed = 4;
    cm_region *region[3];
    ck_assert_int_eq(cm_region_polygon(1, &open, lonlat, &region[0]), CM_OK);
    ck_assert_int_eq(cm_region_polygon(1, &closed, lonlat, &region[1]), CM_OK);
    ck_assert_int_eq(cm_region_box(2.0 * PI, 0.0, 0.0, 0.5, &region[2]), CM_OK);
    uint64_t state = 5;
    int inside = 0;
    for (int i = 0; i < 10000; i++)
    {
        double normal[3];
        cm_direction_from_lonlat(next_real(&state), next_real(&state), normal);
        const int is_in = cm_region_contains(region[0], normal);
        REQUIRE(cm_region_contains(region[1], normal) == is_in, "%d", i);
        inside += is_in;
    }
    REQUIRE(inside > 100 && inside < 9900, "%d", inside);
    /* of no width */
    double normal[3];
    cm_direction_from_lonlat(0.0, 0.25, normal);
    ck_assert_int_eq(cm_region_contains(region[2], normal), 1);
    cm_direction_from_lonlat(0.001, 0.25, normal);
    ck_assert_int_eq(cm_region_contains(region[2], normal), 0);
    for (int i = 0; i < 3; i++)
    {
        cm_region_destroy(region[i]);
    }
}
END_TEST

START_TEST(what_is_no_region)
{
    const double middle[3] = {1.0, 0.0, 0.0};
    const double zero[3] = {0.0, 0.0, 0.0};
    const double not_finite[] = {NAN, INFINITY, -INFINITY};
    const size_t three = 3, two = 2, none = 0, huge = SIZE_MAX / 8;
    const double triangle[] = {0.0, 0.0, 0.1, 0.0, 0.1, 0.1};
    const double twice[] = {0.0, 0.0, 0.1, 0.0, 0.1, 0.0};
    const double once[] = {0.3, 0.2, 0.3, 0.2, 0.3, 0.2};
    const double there_and_back[] = {0.3, 0.2, 0.4, 0.2, 0.3, 0.2};
    const double flat[] = {0.94, 0.0, 0.0, 2e-315, 2.28, 6e-315};
    const double far[] = {0.0, 0.0, PI, 0.0, 0.1, 0.1};
    const double opposite[] = {0.0, 0.0, PI, 0.0, 0.1, 0.0, 0.2, 0.2};
    const size_t four = 4;
    const double high[] = {0.0, 0.0, 0.1, 2.0, 0.1, 0.1};
    cm_region *const before = (cm_region *)(uintptr_t)8;
    cm_region *region = before;
    ck_assert_int_eq(cm_region_cap(NULL, 1.0, &region), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_region_cap(zero, 1.0, &region), CM_ERROR_ARGUMENT);
    for (int i = 0; i < 9; i++)
    {
        double bad[3] = {1.0, 1.0, 1.0};
        bad[i % 3] = not_finite[i / 3];
        ck_assert_int_eq(cm_region_cap(bad, 1.0, &region), CM_ERROR_ARGUMENT);
    }
    ck_assert_int_eq(cm_region_cap(middle, -1.0, &region), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_region_cap(middle, NAN, &region), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_region_cap(middle, 1.0, NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_region_cap_lonlat(NAN, 0.0, 1.0, &region), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_region_cap_lonlat(0.0, 1.6, 1.0, &region), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_region_box(0.0, 0.1, 1.0, 0.0, &region), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_region_box(0.0, -1.6, 1.0, 0.0, &region), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_region_box(0.0, 0.0, 1.0, 1.6, &region), CM_ERROR_ARGUMENT);
    for (int i = 0; i < 3; i++)
    {
        const double bad = not_finite[i];
        ck_assert_int_eq(cm_region_box(bad, 0.0, 1.0, 1.0, &region), CM_ERROR_ARGUMENT);
        ck_assert_int_eq(cm_region_box(0.0, 0.0, bad, 1.0, &region), CM_ERROR_ARGUMENT);
    }
    ck_assert_int_eq(cm_region_box(0.0, NAN, 1.0, 1.0, &region), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_region_box(-1e308, 0.0, 1.7e308, 1.0, &region), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_region_box(0.0, 0.0, 1.0, 1.0, NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_region_polygon(1, &two, triangle, &region), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_region_polygon(1, &none, triangle, &region), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_region_polygon(1, &huge, triangle, &region), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_region_polygon(0, &three, triangle, &region), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_region_polygon(1, NULL, triangle, &region), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_region_polygon(1, &three, NULL, &region), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_region_polygon(1, &three, triangle, NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_region_polygon(1, &three, twice, &region), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_region_polygon(1, &three, once, &region), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_region_polygon(1, &three, there_and_back, &region), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_region_polygon(1, &three, flat, &region), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_region_polygon(1, &three, far, &region), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_region_polygon(1, &four, opposite, &region), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_region_polygon(1, &three, high, &region), CM_ERROR_ARGUMENT);
    ck_assert_ptr_eq(region, before);
    cm_region_destroy(NULL);
}
END_TEST

START_TEST(what_is_no_covering)
{
    subject made = make_turn(0);
    const double middle[3] = {1.0, 2.0, 3.0};
    cm_region *region;
    cm_cell cell = 7;
    size_t count = 99;
    const cm_cover_options good = {.size = sizeof good, .level_max = 3};
    cm_cover_options bad[6] = {good, good, good, good, good, good};
    bad[0].size = 3;
    bad[1].level_max = 31;
    bad[2].level_min = -1;
    bad[3].level_min = 4;
    bad[4].kind = (cm_cover_kind)2;
    bad[5].level_max = -1;
    ck_assert_int_eq(cm_region_cap(middle, 0.0, &region), CM_OK);
    for (size_t k = 0; k < 6; k++)
    {
        ck_assert_int_eq(cm_cover(made.cells, region, &bad[k], 1, &cell, &count),
                         CM_ERROR_ARGUMENT);
    }
    ck_assert_int_eq(cm_cover(NULL, region, &good, 1, &cell, &count), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_cover(made.cells, NULL, &good, 1, &cell, &count), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_cover(made.cells, region, NULL, 1, &cell, &count), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_cover(made.cells, region, &good, 1, NULL, &count), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_cover(made.cells, region, &good, 1, &cell, NULL), CM_ERROR_ARGUMENT);
    ck_assert(cell == 7 && count == 99);
    ck_assert(!cm_region_contains(region, (const double[3]){0.0, 0.0, 0.0}));
    ck_assert(!cm_region_contains(region, (const double[3]){NAN, 0.0, 0.0}));
    ck_assert(cm_region_contains(region, (const double[3]){1e300, 2e300, 3e300}));
    cm_region_destroy(region);
    drop_subject(&made);
}
END_TEST

int main(void)
{
    const TTest *tests[] = {caps,
                            whole_and_half_spheres,
                            caps_of_metres,
                            boxes,
                            polygons,
                            rings,
                            spikes_of_rings,
                            room,
                            levels_beyond_a_budget,
                            borders_are_wide,
                            closed_rings_and_boxes_by_turns,
                            what_is_no_region,
                            what_is_no_covering,
                            NULL};
    return run_suite("coverings", tests);
}
