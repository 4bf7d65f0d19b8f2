/* SPDX-License-Identifier: MIT
 *
 * Grids: mappings on ellipsoids. Round trips at the hard points, areas by quadrature, distortion against
 * differences, and what is not to be had.
 */
#include "tests/suite.h"

#include "truth/hard_points.h"

#define DEGREE 0.017453292519943295
#define EPS 0x1p-53

static const char *const ellipsoids[] = {
    "WGS84",         "6371007.2,0", "6378137,-298.257223563", "3396190,169.894447223612",
    "60268000,10.2", "1,-10"};
#define ELLIPSOIDS (sizeof ellipsoids / sizeof *ellipsoids)

static cm_ellipsoid ellipsoid_of(const char *text)
{
    cm_ellipsoid ellipsoid;
    char message[200] = "";
    ck_assert_msg(cm_ellipsoid_parse(text, &ellipsoid, message, sizeof message) == CM_OK, "%s: %s",
                  text, message);
    return ellipsoid;
}

static cm_rotation rotation_of(double lon, double lat, double roll)
{
    cm_rotation rotation;
    ck_assert_int_eq(cm_rotation_from_angles(lon, lat, roll, &rotation), CM_OK);
    return rotation;
}

/* latitude below 0: what the mapping asks for */
static cm_grid *make_grid(const char *mapping, const char *ellipsoid, int latitude,
                          const cm_rotation *rotation)
{
    cm_ellipsoid e = ellipsoid_of(ellipsoid);
    cm_latitude l = (cm_latitude)latitude;
    cm_grid_options options = {.size = sizeof options,
                               .mapping = mapping,
                               .ellipsoid = &e,
                               .latitude = latitude < 0 ? NULL : &l,
                               .rotation = rotation};
    cm_grid *grid = NULL;
    cm_status status = cm_grid_create(&options, &grid);
    ck_assert_msg(status == CM_OK, "%s on %s: %s", mapping, ellipsoid, cm_status_text(status));
    return grid;
}

/* ---- Round trips ---- */

#define POINTS 4096

static double worst_round_trip(const cm_grid *grid, uint64_t start)
{
    static double x[POINTS], y[POINTS], z[POINTS], u[POINTS], v[POINTS], to[3][POINTS];
    static uint8_t face[POINTS];
    double worst = 0.0;
    for (size_t i = 0; i < POINTS; i++)
    {
        double d[3];
        hard_direction(start + 4099 * i, d);
        x[i] = d[0];
        y[i] = d[1];
        z[i] = d[2];
    }
    cm_grid_forward_array(grid, POINTS, x, y, z, face, u, v);
    cm_grid_inverse_array(grid, POINTS, face, u, v, to[0], to[1], to[2]);
    for (size_t i = 0; i < POINTS; i++)
    {
        const double from[3] = {x[i], y[i], z[i]};
        const double back[3] = {to[0][i], to[1][i], to[2][i]};
        double size = fmax(fabs(x[i]), fmax(fabs(y[i]), fabs(z[i])));
        if (size == 0.0 || !isfinite(size))
        {
            ck_assert(face[i] == CM_NO_FACE && isnan(back[0]));
            continue;
        }
        double metres = earth_metres(from, back);
        REQUIRE(metres < 1.0, "%a %a %a comes back %g m away", x[i], y[i], z[i], metres);
        worst = fmax(worst, metres);
    }
    return worst;
}

START_TEST(round_trips)
{
    static const char *const mappings[] = {
        "coupled",   "qsc",      "gnomonic",   "slice",   "healpix",
        "conformal", "seamless", "octahedral", "tangent", "azimuthal:lambert:full=1"};
    const cm_rotation rotation = rotation_of(-20.5, 33.3, 12.25);
    double worst = 0.0;
    for (size_t m = 0; m < sizeof mappings / sizeof *mappings; m++)
    {
        for (size_t k = 0; k < 2 * ELLIPSOIDS; k++)
        {
            cm_grid *grid = make_grid(mappings[m], ellipsoids[k / 2],
                                      (int)((k + m) % CM_LATITUDE_COUNT), k % 2 ? &rotation : NULL);
            double metres = worst_round_trip(grid, m + 10 * k);
            /* beside the antipode a rounding of u and v is that much */
            REQUIRE(metres < (m == 9 ? 0.3 : 7e-9), "%s on %s: %g m", mappings[m],
                    ellipsoids[k / 2], metres);
            worst = m == 9 ? worst : fmax(worst, metres);
            cm_grid_destroy(grid);
        }
    }
    printf("worst round trip of a grid: %.3g nm\n", worst * 1e9);
}
END_TEST

START_TEST(round_trips_of_lonlat)
{
    cm_grid *grid = make_grid("coupled", "WGS84", -1, NULL);
    uint64_t state = 7;
    for (int i = 0; i < 100000; i++)
    {
        double uv[2], back[2], from[3], to[3];
        double lon = 3.141592653589793 * next_real(&state);
        double lat = i % 2 ? 1.5707963267948966 * next_real(&state)
                           : 1.5707963267948966 - pow(10.0, 8.0 * next_real(&state) - 8.0);
        uint8_t face = cm_grid_forward_lonlat(grid, lon, lat, uv);
        cm_grid_inverse_lonlat(grid, face, uv, back);
        cm_direction_from_lonlat(lon, lat, from);
        cm_direction_from_lonlat(back[0], back[1], to);
        REQUIRE(earth_metres(from, to) < 7e-9, "%a %a: %g", lon, lat, earth_metres(from, to));
    }
    cm_grid_destroy(grid);
}
END_TEST

/* What an ellipsoid does to a latitude is what latitude.h says, and the sphere's mapping is the rest. */
START_TEST(chain_is_made_of_its_links)
{
    const cm_rotation rotation = rotation_of(100.0, -40.0, 77.0);
    cm_grid *grid = make_grid("slice", "WGS84", -1, &rotation);
    cm_latitude_conversion *conversion = NULL;
    ck_assert_int_eq(cm_grid_latitude(grid), CM_LATITUDE_AUTHALIC);
    ck_assert_int_eq(cm_latitude_conversion_create(cm_grid_ellipsoid(grid), CM_LATITUDE_GEOGRAPHIC,
                                                   CM_LATITUDE_AUTHALIC, NULL, &conversion),
                     CM_OK);
    uint64_t state = 11;
    for (int i = 0; i < 10000; i++)
    {
        double normal[3], authalic[3], turned[3], sphere[3], back[3], uv[2], expected[2];
        next_direction(&state, normal);
        cm_latitude_convert_direction(conversion, normal, authalic);
        cm_rotate(&rotation, authalic, turned);
        uint8_t face = cm_forward(cm_grid_mapping(grid), turned, expected);
        ck_assert_uint_eq(cm_grid_forward(grid, normal, uv), face);
        ck_assert(uv[0] == expected[0] && uv[1] == expected[1]);
        cm_grid_to_sphere(grid, normal, sphere);
        ck_assert(memcmp(sphere, turned, sizeof turned) == 0);
        cm_grid_from_sphere(grid, sphere, back);
        ck_assert(angle_between(normal, back) < 8.0 * EPS);
    }
    cm_latitude_conversion_destroy(conversion);
    cm_grid_destroy(grid);
}
END_TEST

/* ---- One point as many ---- */

START_TEST(same_bits_for_any_number)
{
    const cm_rotation rotation = rotation_of(1.0, 2.0, 3.0);
    cm_grid *grid = make_grid("coupled", "WGS84", CM_LATITUDE_AUTHALIC, &rotation);
    enum
    {
        N = 700
    };
    static double lon[N], lat[N], u[N], v[N], a[N + 1], b[N + 1];
    static uint8_t face[N];
    uint64_t state = 3;
    for (int i = 0; i < N; i++)
    {
        lon[i] = i % 9 == 0 ? 1e9 * next_real(&state) : 7.0 * next_real(&state);
        lat[i] = 1.5707963267948966 * next_real(&state);
    }
    lon[5] = (double)NAN;
    lat[6] = 1.58;
    cm_grid_forward_lonlat_array(grid, N, lon, lat, face, u, v);
    ck_assert(face[5] == CM_NO_FACE && isnan(u[5]) && face[6] == CM_NO_FACE && isnan(v[6]));
    cm_grid_forward_lonlat_array(grid, 0, NULL, NULL, NULL, NULL, NULL);
    cm_grid_inverse_array(grid, 0, NULL, NULL, NULL, NULL, NULL, NULL);
    for (int i = 0; i < N; i++)
    {
        double uv[2];
        ck_assert_uint_eq(cm_grid_forward_lonlat(grid, lon[i], lat[i], uv), face[i]);
        ck_assert(memcmp(&uv[0], &u[i], sizeof *u) == 0 && memcmp(&uv[1], &v[i], sizeof *v) == 0);
    }
    /* results over arguments, and arrays that are not aligned to vectors */
    memcpy(a + 1, lon + 1, (N - 1) * sizeof *a);
    memcpy(b + 1, lat + 1, (N - 1) * sizeof *b);
    cm_grid_forward_lonlat_array(grid, N - 1, a + 1, b + 1, face + 1, a + 1, b + 1);
    ck_assert(memcmp(a + 1, u + 1, (N - 1) * sizeof *u) == 0);
    ck_assert(memcmp(b + 1, v + 1, (N - 1) * sizeof *v) == 0);
    cm_grid_inverse_lonlat_array(grid, N - 1, face + 1, a + 1, b + 1, a + 1, b + 1);
    for (int i = 1; i < N; i++)
    {
        double lonlat[2];
        const double uv[2] = {u[i], v[i]};
        cm_grid_inverse_lonlat(grid, face[i], uv, lonlat);
        ck_assert(memcmp(&lonlat[0], &a[i], sizeof *a) == 0);
        ck_assert(memcmp(&lonlat[1], &b[i], sizeof *b) == 0);
    }
    cm_grid_destroy(grid);
}
END_TEST

START_TEST(arrays_without_mapping)
{
    enum
    {
        N = 700
    };
    const cm_rotation rotation = rotation_of(40.0, -20.0, 10.0);
    cm_grid *grid = make_grid("coupled", "WGS84", CM_LATITUDE_AUTHALIC, &rotation);
    ck_assert(memcmp(cm_grid_rotation(grid), &rotation, sizeof rotation) == 0);
    static double from[3][N], there[3][N], back[3][N];
    for (size_t i = 0; i < N; i++)
    {
        double d[3];
        hard_direction(4099 * i, d);
        for (int k = 0; k < 3; k++)
        {
            from[k][i] = there[k][i] = d[k];
        }
    }
    cm_grid_to_sphere_array(grid, 0, NULL, NULL, NULL, NULL, NULL, NULL);
    cm_grid_from_sphere_array(grid, 0, NULL, NULL, NULL, NULL, NULL, NULL);
    /* results over arguments */
    cm_grid_to_sphere_array(grid, N, there[0], there[1], there[2], there[0], there[1], there[2]);
    cm_grid_from_sphere_array(grid, N, there[0], there[1], there[2], back[0], back[1], back[2]);
    for (size_t i = 0; i < N; i++)
    {
        const double d[3] = {from[0][i], from[1][i], from[2][i]};
        const double t[3] = {there[0][i], there[1][i], there[2][i]};
        double one[3];
        cm_grid_to_sphere(grid, d, one);
        REQUIRE(memcmp(one, t, sizeof t) == 0 || (isnan(one[0]) && isnan(t[0])), "%zu", i);
        cm_grid_from_sphere(grid, t, one);
        for (int k = 0; k < 3; k++)
        {
            REQUIRE(one[k] == back[k][i] || (isnan(one[k]) && isnan(back[k][i])), "%zu", i);
        }
    }
    cm_grid_destroy(grid);
}
END_TEST

START_TEST(arrays_of_area_elements)
{
    static const double u[] = {0.0, 0.5, -1.0, 0.25, (double)NAN};
    static const double v[] = {0.0, -0.5, 1.0, 0.75, 0.0};
    static const uint8_t face[] = {0, 5, 2, 6, 1};
    double area[6] = {7.0, 7.0, 7.0, 7.0, 7.0, 7.0};
    cm_grid *grid = make_grid("coupled", "WGS84", -1, NULL);
    cm_grid_area_element_array(grid, 0, NULL, NULL, NULL, NULL);
    cm_grid_area_element_array(grid, 5, face, u, v, area);
    for (size_t i = 0; i < 5; i++)
    {
        const double uv[2] = {u[i], v[i]};
        const double one = cm_grid_area_element(grid, face[i], uv);
        REQUIRE(one == area[i] || (isnan(one) && isnan(area[i])), "%zu", i);
        REQUIRE((isnan(one) != 0) == (i > 2), "%zu: %g", i, one);
    }
    ck_assert(area[5] == 7.0);
    cm_grid_destroy(grid);
}
END_TEST

/* ---- Areas ---- */

/* Gauss and Legendre's rule on [0, 1]. */
#define RULE 24

static void make_rule(double node[RULE], double weight[RULE])
{
    for (int i = 0; i < RULE; i++)
    {
        long double x = cosl(3.14159265358979323846L * (i + 0.75L) / (RULE + 0.5L));
        long double slope = 1.0L;
        for (int turn = 0; turn < 8; turn++)
        {
            long double before = 1.0L;
            long double value = x;
            for (int k = 2; k <= RULE; k++)
            {
                long double next = ((2 * k - 1) * x * value - (k - 1) * before) / k;
                before = value;
                value = next;
            }
            slope = RULE * (before - x * value) / (1.0L - x * x);
            x -= value / slope;
        }
        node[i] = (double)((1.0L + x) / 2.0L);
        weight[i] = (double)(1.0L / ((1.0L - x * x) * slope * slope));
    }
}

/* Over the triangle between the middle of a face, the middle of an edge and a corner, cut in parts. */
static double integral_over_piece(const cm_grid *grid, uint8_t face, int piece)
{
    enum
    {
        PARTS = 3
    };
    double node[RULE], weight[RULE];
    double sum = 0.0;
    make_rule(node, weight);
    for (int i = 0; i < PARTS * RULE; i++)
    {
        for (int k = 0; k < PARTS * RULE; k++)
        {
            double r = (i / RULE + node[i % RULE]) / PARTS;
            double t = (k / RULE + node[k % RULE]) / PARTS;
            double along = piece & 1 ? -r : r;
            double across = piece & 2 ? -r * t : r * t;
            const double uv[2] = {piece & 4 ? across : along, piece & 4 ? along : across};
            sum += weight[i % RULE] * weight[k % RULE] * r * cm_grid_area_element(grid, face, uv);
        }
    }
    return sum / (PARTS * PARTS);
}

START_TEST(area_elements_make_the_surface)
{
    const cm_rotation rotation = rotation_of(15.0, 20.0, 30.0);
    static const struct
    {
        const char *mapping;
        int latitude;
        int rotated;
    } cases[] = {{"gnomonic", CM_LATITUDE_GEOCENTRIC, 0},
                 {"coupled", CM_LATITUDE_CONFORMAL, 1},
                 {"tangent", CM_LATITUDE_RECTIFYING, 0},
                 {"slice", CM_LATITUDE_PARAMETRIC, 1},
                 {"s2", CM_LATITUDE_GEOGRAPHIC, 1},
                 {"coupled", CM_LATITUDE_AUTHALIC, 1},
                 {"nowell", CM_LATITUDE_AUTHALIC_APPROXIMATION, 0}};
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++)
    {
        const char *on = ellipsoids[c % 2 ? 0 : c % ELLIPSOIDS];
        cm_grid *grid =
            make_grid(cases[c].mapping, on, cases[c].latitude, cases[c].rotated ? &rotation : NULL);
        double sum = 0.0;
        for (int face = 0; face < 6; face++)
        {
            for (int piece = 0; piece < 8; piece++)
            {
                sum += integral_over_piece(grid, (uint8_t)face, piece);
            }
        }
        double area = cm_ellipsoid_area(cm_grid_ellipsoid(grid));
        REQUIRE(fabs(sum / area - 1.0) < 1e-12, "%s, %s on %s: %.3g", cases[c].mapping,
                cm_latitude_name((cm_latitude)cases[c].latitude), on, sum / area - 1.0);
        cm_grid_destroy(grid);
    }
}
END_TEST

START_TEST(equal_areas_on_the_ellipsoid)
{
    static const char *const mappings[] = {"qsc",     "slice",    "seamless",           "arvo",
                                           "healpix", "rhealpix", "octahedral:clarberg"};
    for (size_t m = 0; m < sizeof mappings / sizeof *mappings; m++)
    {
        for (size_t e = 0; e < ELLIPSOIDS; e++)
        {
            cm_grid *grid = make_grid(mappings[m], ellipsoids[e], -1, NULL);
            int is_cube = cm_mapping_describe(cm_grid_mapping(grid))->kind == CM_KIND_CUBE;
            int is_gapped = strcmp(mappings[m], "rhealpix") == 0;
            double mean = cm_ellipsoid_area(cm_grid_ellipsoid(grid)) / (is_cube     ? 24.0
                                                                        : is_gapped ? 1.5
                                                                                    : 4.0);
            uint64_t state = 5;
            ck_assert_int_eq(cm_grid_latitude(grid), CM_LATITUDE_AUTHALIC);
            for (int i = 0; i < 2000; i++)
            {
                const double uv[2] = {next_real(&state), next_real(&state)};
                double area = cm_grid_area_element(grid, (uint8_t)(is_cube ? i % 6 : 0), uv);
                REQUIRE((is_gapped && isnan(area)) || fabs(area / mean - 1.0) < 40.0 * EPS,
                        "%s on %s: %g eps at %a %a", mappings[m], ellipsoids[e],
                        (area / mean - 1.0) / EPS, uv[0], uv[1]);
            }
            cm_grid_destroy(grid);
        }
    }
}
END_TEST

/* ---- Distortion ---- */

/* Metres to east and to north of a place on the ellipsoid with a = 1, by the radii of curvature. */
static void step_on(const cm_ellipsoid *e, double lon, double lat, double east, double north,
                    double to[2])
{
    double square = e->f * (2.0 - e->f);
    double curvature = 1.0 - square * sin(lat) * sin(lat);
    to[0] = lon + east * sqrt(curvature) / cos(lat);
    to[1] = lat + north * curvature * sqrt(curvature) / (1.0 - square);
}

START_TEST(distortion_is_that_of_differences)
{
    const cm_rotation rotation = rotation_of(-33.0, 21.0, 5.0);
    const double h = 1e-5;
    uint64_t state = 9;
    for (int i = 0; i < 3000; i++)
    {
        cm_grid *grid =
            make_grid(i % 3 ? "coupled" : "difference:mild", ellipsoids[(size_t)i % ELLIPSOIDS],
                      i % CM_LATITUDE_COUNT, i % 2 ? &rotation : NULL);
        const cm_ellipsoid *e = cm_grid_ellipsoid(grid);
        double lon = 3.0 * next_real(&state);
        double lat = 1.5 * next_real(&state);
        double at[2], uv[2], ends[4][2], normal[3];
        uint8_t face = cm_grid_forward_lonlat(grid, lon, lat, uv);
        int inside = fabs(uv[0]) < 0.99 && fabs(uv[1]) < 0.99;
        for (int k = 0; k < 4 && inside; k++)
        {
            double s = k % 2 ? h : -h;
            step_on(e, lon, lat, k < 2 ? s : 0.0, k < 2 ? 0.0 : s, at);
            inside = cm_grid_forward_lonlat(grid, at[0], at[1], ends[k]) == face;
        }
        if (inside)
        {
            double j[4];
            for (int k = 0; k < 4; k++)
            {
                j[k] = (ends[2 * (k % 2) + 1][k / 2] - ends[2 * (k % 2)][k / 2]) / (2.0 * h);
            }
            double scale = fabs(j[0] * j[3] - j[1] * j[2]);
            double sum = sqrt(j[0] * j[0] + j[1] * j[1] + j[2] * j[2] + j[3] * j[3] + 2.0 * scale);
            cm_distortion there, here;
            cm_direction_from_lonlat(lon, lat, normal);
            cm_grid_forward_distortion(grid, normal, &there);
            cm_grid_inverse_distortion(grid, face, uv, &here);
            REQUIRE(fabs(there.scale / scale - 1.0) < 1e-6 &&
                        fabs((there.major + there.minor) / sum - 1.0) < 1e-6,
                    "%s on f = %g at %g %g: scale %g, %g", cm_latitude_name(cm_grid_latitude(grid)),
                    e->f, lon / DEGREE, lat / DEGREE, there.scale, scale);
            REQUIRE(fabs(here.scale / there.scale - 1.0) < 1e-13 &&
                        fabs(here.isotropy / there.isotropy - 1.0) < 1e-13,
                    "at %g %g: %a %a", lon, lat, here.isotropy, there.isotropy);
        }
        cm_grid_destroy(grid);
    }
}
END_TEST

START_TEST(conformal_on_the_ellipsoid)
{
    for (size_t e = 0; e < ELLIPSOIDS; e++)
    {
        cm_grid *grid = make_grid("conformal", ellipsoids[e], -1, NULL);
        ck_assert_int_eq(cm_grid_latitude(grid), CM_LATITUDE_CONFORMAL);
        uint64_t state = 13;
        for (int i = 0; i < 2000; i++)
        {
            const double uv[2] = {0.999 * next_real(&state), 0.999 * next_real(&state)};
            cm_distortion d;
            cm_grid_inverse_distortion(grid, (uint8_t)(i % 6), uv, &d);
            REQUIRE(d.isotropy < 1.0 + 1e-7 && d.deformation < 1e-12, "%s: %g at %a %a",
                    ellipsoids[e], d.deformation, uv[0], uv[1]);
        }
        cm_grid_destroy(grid);
    }
}
END_TEST

/* Where sines and cosines are nothing, and where the sphere's longitude is. */
START_TEST(poles_and_equator)
{
    for (int l = 0; l < CM_LATITUDE_COUNT; l++)
    {
        cm_grid *grid = make_grid("coupled", "WGS84", l, NULL);
        const double pole[3] = {0.0, 0.0, 1.0};
        const double beside[3] = {0.0, 1e-9, 1.0};
        cm_distortion at, near;
        double uv[2], back[3];
        cm_grid_forward_distortion(grid, pole, &at);
        cm_grid_forward_distortion(grid, beside, &near);
        ck_assert(fabs(at.scale / near.scale - 1.0) < 1e-8 && at.isotropy < 1.0 + 1e-9);
        ck_assert_uint_eq(cm_grid_forward(grid, pole, uv), 4);
        ck_assert(uv[0] == 0.0 && uv[1] == 0.0);
        ck_assert_uint_eq(cm_grid_forward(grid, (const double[3]){1e-300, 0.0, 1.0}, uv), 4);
        cm_grid_inverse(grid, 4, uv, back);
        ck_assert(fabs(back[0] / 1e-300 - 1.0) < 1e-14 && back[1] == 0.0 && back[2] == 1.0);
        ck_assert_uint_eq(cm_grid_forward_lonlat(grid, 0.0, 0.0, uv), 0);
        ck_assert(uv[0] == 0.0 && uv[1] == 0.0);
        ck_assert(fabs(cm_grid_area_element(grid, 0, uv)) > 0.0);
        cm_grid_destroy(grid);
    }
}
END_TEST

/* ---- What is not to be had ---- */

START_TEST(errors)
{
    cm_grid *grid = (cm_grid *)&grid;
    cm_grid *const untouched = grid;
    cm_grid_options options = {.size = sizeof options};
    ck_assert_int_eq(cm_grid_create(&options, NULL), CM_ERROR_ARGUMENT);
    options.size = 0;
    ck_assert_int_eq(cm_grid_create(&options, &grid), CM_ERROR_ARGUMENT);
    options.size = sizeof options;
    options.mapping = "nothing";
    ck_assert_int_eq(cm_grid_create(&options, &grid), CM_ERROR_MAPPING);
    options.mapping = "square:radial";
    ck_assert_int_eq(cm_grid_create(&options, &grid), CM_ERROR_UNSUPPORTED);
    options.mapping = "qsc";
    cm_ellipsoid flat = ellipsoid_of("WGS84");
    flat.f = 1.0;
    options.ellipsoid = &flat;
    ck_assert_int_eq(cm_grid_create(&options, &grid), CM_ERROR_ELLIPSOID);
    options.ellipsoid = NULL;
    cm_latitude none = (cm_latitude)77;
    options.latitude = &none;
    ck_assert_int_eq(cm_grid_create(&options, &grid), CM_ERROR_LATITUDE);
    options.latitude = NULL;
    cm_rotation mirror = rotation_of(0.0, 0.0, 0.0);
    mirror.row[0][0] = -1.0;
    options.rotation = &mirror;
    ck_assert_int_eq(cm_grid_create(&options, &grid), CM_ERROR_ORIENTATION);
    options.rotation = NULL;
    options.tolerance = (double)NAN;
    ck_assert_int_eq(cm_grid_create(&options, &grid), CM_ERROR_ARGUMENT);
    ck_assert_ptr_eq(grid, untouched);
    cm_grid_destroy(NULL);

    ck_assert_int_eq(cm_grid_create(NULL, &grid), CM_OK);
    ck_assert_str_eq(cm_mapping_describe(cm_grid_mapping(grid))->identifier,
                     CM_MAPPING_RECOMMENDED);
    ck_assert_str_eq(cm_grid_ellipsoid(grid)->identifier, "WGS84");
    double uv[2], normal[3];
    ck_assert_uint_eq(cm_grid_forward(grid, (const double[3]){0.0, 0.0, 0.0}, uv), CM_NO_FACE);
    ck_assert(isnan(uv[0]) && isnan(uv[1]));
    cm_grid_inverse(grid, 6, (const double[2]){0.0, 0.0}, normal);
    ck_assert(isnan(normal[0]) && isnan(normal[2]));
    ck_assert(isnan(cm_grid_area_element(grid, 6, (const double[2]){0.0, 0.0})));
    cm_distortion d;
    cm_grid_forward_distortion(grid, (const double[3]){(double)NAN, 0.0, 1.0}, &d);
    ck_assert(isnan(d.scale));
    cm_grid_destroy(grid);
}
END_TEST

int main(void)
{
    const TTest *tests[] = {round_trips,
                            round_trips_of_lonlat,
                            chain_is_made_of_its_links,
                            same_bits_for_any_number,
                            arrays_without_mapping,
                            arrays_of_area_elements,
                            area_elements_make_the_surface,
                            equal_areas_on_the_ellipsoid,
                            distortion_is_that_of_differences,
                            conformal_on_the_ellipsoid,
                            poles_and_equator,
                            errors,
                            NULL};
    return run_suite("grids", tests);
}
