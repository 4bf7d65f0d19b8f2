/* SPDX-License-Identifier: MIT
 *
 * The search for an orientation (cubemap/orient.h): on masks whose answer is known, against plain sums, and what
 * it says about all other rotations against those.
 */
#include "tests/suite.h"

#include "mask_pixel.h"

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))
#define DEGREE (PI / 180.0)

enum
{
    WIDTH = 240,
    HEIGHT = 120,
    FEW_BOXES = 1 /* those of the first level and no more */
};

typedef struct raster
{
    float value[WIDTH * HEIGHT];
    cm_mask mask;
} raster;

static void begin(raster *r)
{
    *r = (raster){.mask = {sizeof(cm_mask), WIDTH, HEIGHT, NULL}};
    r->mask.value = r->value;
}

/* The direction of a pixel's middle. */
static void pixel(size_t i, double d[3])
{
    const double lon = (((double)(i % WIDTH) + 0.5) / WIDTH - 0.5) * 2.0 * PI;
    const double lat = (0.5 - ((double)(i / WIDTH) + 0.5) / HEIGHT) * PI;
    cm_direction_from_lonlat(lon, lat, d);
}

/* A cap whose border is a degree and a half wide, so that rasters of turned ones are alike; turn NULL is none. */
static void add_cap(raster *r, double lon, double lat, double radius, const cm_rotation *turn)
{
    double centre[3];
    cm_direction_from_lonlat(lon * DEGREE, lat * DEGREE, centre);
    for (size_t i = 0; i < WIDTH * HEIGHT; i++)
    {
        double d[3];
        pixel(i, d);
        if (turn != NULL)
        {
            cm_rotate(turn, d, d);
        }
        const double inside = (radius - angle_between(d, centre) / DEGREE) / 1.5 + 0.5;
        r->value[i] = fmaxf(r->value[i], (float)fmin(fmax(inside, 0.0), 1.0));
    }
}

static cm_orient_options options_of(cm_orient_measure measure)
{
    return (cm_orient_options){.size = sizeof(cm_orient_options),
                               .measure = measure,
                               .over = CM_OVER_SPHERE,
                               .boxes_max = FEW_BOXES};
}

static cm_orient_result orient(const char *mapping, const raster *r,
                               const cm_orient_options *options)
{
    cm_mapping *made = make_mapping(mapping, NULL);
    cm_orient_result result = {.size = sizeof result};
    cm_status status = cm_orient(made, &r->mask, options, &result);
    REQUIRE(status == CM_OK, "%s: %s", mapping, cm_status_text(status));
    cm_mapping_destroy(made);
    return result;
}

static double value_of(const cm_mapping *mapping, const raster *r, const cm_orient_options *options,
                       const cm_rotation *rotation)
{
    double value = 7.0;
    cm_status status = cm_orient_value(mapping, &r->mask, options, rotation, &value);
    REQUIRE(status == CM_OK, "%s", cm_status_text(status));
    return value;
}

static cm_rotation product(const cm_rotation *a, const cm_rotation *b)
{
    cm_rotation c = {{{0.0}}};
    for (int i = 0; i < 27; i++)
    {
        c.row[i / 9][i / 3 % 3] += a->row[i / 9][i % 3] * b->row[i % 3][i / 3 % 3];
    }
    return c;
}

/* Degrees between two rotations, of those that the 24 turns of a cube make of the first. */
static double apart(const cm_rotation *a, const cm_rotation *b)
{
    double least = 180.0;
    for (int i = 0; i < 6 * 4; i++)
    {
        static const double fronts[6][2] = {{0, 0}, {90, 0}, {180, 0}, {-90, 0}, {0, 90}, {0, -90}};
        cm_rotation turn;
        cm_rotation_from_angles(fronts[i / 4][0], fronts[i / 4][1], i % 4 * 90.0, &turn);
        const cm_rotation turned = product(&turn, a);
        double trace = 0.0;
        for (int k = 0; k < 9; k++)
        {
            trace += turned.row[k / 3][k % 3] * b->row[k / 3][k % 3];
        }
        least = fmin(least, acos(fmin(1.0, 0.5 * (trace - 1.0))) / DEGREE);
    }
    return least;
}

static cm_rotation any_rotation(uint64_t *state)
{
    cm_rotation rotation;
    cm_rotation_from_angles(180.0 * next_real(state), asin(next_real(state)) / DEGREE,
                            180.0 * next_real(state), &rotation);
    return rotation;
}

/* ---- The measures ---- */

/* Over all of the sphere every orientation has the mean that quadrature finds, and all of the edges. */
START_TEST(test_whole_sphere)
{
    static const char *const mappings[] = {"tangent", "coupled", "nowell", "healpix"};
    static const cm_quantity quantities[] = {CM_QUANTITY_DEFORMATION, CM_QUANTITY_ISOTROPY,
                                             CM_QUANTITY_AREA, CM_QUANTITY_SCALE};
    raster whole;
    uint64_t state = 1;
    begin(&whole);
    for (size_t i = 0; i < WIDTH * HEIGHT; i++)
    {
        whole.value[i] = 3.0f;
    }
    for (size_t m = 0; m < COUNT(mappings) * 8; m += step_of(3))
    {
        cm_mapping *mapping = make_mapping(mappings[m / 8], NULL);
        cm_orient_options options = options_of((cm_orient_measure)(m % 4));
        options.over = m / 4 % 2 == 0 ? CM_OVER_SPHERE : CM_OVER_FACE;
        const cm_rotation rotation = any_rotation(&state);
        const double value = value_of(mapping, &whole, &options, &rotation);
        const cm_statistics_options over = {.size = sizeof over, .measure = options.over};
        cm_statistics truth = {.size = sizeof truth};
        cm_distortion_statistics(mapping, quantities[m % 4], &over, &truth);
        /* no quantity is the logarithm of D_A: its mean is that of what D_A is off 1, about */
        const double slack =
            options.measure == CM_ORIENT_AREA ? truth.rmse + 1e-9 : 2e-3 * truth.mean;
        const double wanted = options.measure == CM_ORIENT_AREA ? 0.7 * truth.rmse : truth.mean;
        REQUIRE(fabs(value - wanted) <= slack, "%s, %s: %g, not %g", mappings[m / 8],
                cm_orient_measure_name(m % 4), value, wanted);
        cm_mapping_destroy(mapping);
    }
    cm_mapping *mapping = make_mapping("coupled", NULL);
    const cm_orient_options edges = options_of(CM_ORIENT_EDGES);
    for (int i = 0; i < 5; i++)
    {
        const cm_rotation rotation = any_rotation(&state);
        const double value = value_of(mapping, &whole, &edges, &rotation);
        REQUIRE(fabs(value / 3.0 - 12.0 * acos(1.0 / 3.0)) < 1e-12, "%.17g", value / 3.0);
    }
    cm_mapping_destroy(mapping);
}
END_TEST

/* More pixels than are taken one by one: a mean over cells that are small. */
START_TEST(test_many_pixels)
{
    enum
    {
        HIGH = 1450
    };
    float *values = malloc((size_t)2 * HIGH * HIGH * sizeof *values);
    const cm_mask mask = {sizeof mask, 2 * HIGH, HIGH, values};
    const cm_orient_options options = options_of(CM_ORIENT_DEFORMATION);
    cm_mapping *mapping = make_mapping("tangent", NULL);
    const cm_statistics_options over = {.size = sizeof over, .measure = CM_OVER_SPHERE};
    cm_statistics truth = {.size = sizeof truth};
    uint64_t state = 3;
    const cm_rotation rotation = any_rotation(&state);
    double value = 0.0;
    ck_assert_ptr_nonnull(values);
    for (size_t i = 0; i < (size_t)2 * HIGH * HIGH; i++)
    {
        values[i] = 2.0f;
    }
    ck_assert_int_eq(cm_orient_value(mapping, &mask, &options, &rotation, &value), CM_OK);
    cm_distortion_statistics(mapping, CM_QUANTITY_DEFORMATION, &over, &truth);
    REQUIRE(fabs(value - truth.mean) < 1e-6, "%.9g, not %.9g", value, truth.mean);
    cm_mapping_destroy(mapping);
    free(values);
}
END_TEST

/* One pixel has the distortion of its middle; edges over a hemisphere are half of them. */
START_TEST(test_simple_masks)
{
    raster one;
    uint64_t state = 2;
    cm_mapping *mapping = make_mapping("tangent", NULL);
    for (int i = 0; i < 300; i++)
    {
        const size_t at = (size_t)(next_bits(&state) % (WIDTH * HEIGHT));
        const cm_rotation rotation = any_rotation(&state);
        double d[3];
        cm_distortion there;
        begin(&one);
        one.value[at] = 0.25f;
        pixel(at, d);
        cm_rotate(&rotation, d, d);
        cm_forward_distortion(mapping, d, &there);
        const double truth[] = {there.deformation, there.isotropy, fabs(log(there.area)),
                                there.scale};
        cm_orient_options options = options_of((cm_orient_measure)(i % 4));
        options.over = i / 4 % 2 == 0 ? CM_OVER_SPHERE : CM_OVER_FACE;
        const double value = value_of(mapping, &one, &options, &rotation);
        REQUIRE(fabs(value - truth[i % 4]) < 1e-5, "%g, not %g", value, truth[i % 4]);
    }
    raster half;
    begin(&half);
    for (size_t i = 0; i < WIDTH * HEIGHT / 2; i++)
    {
        half.value[i] = 2.0f;
    }
    const cm_orient_options edges = options_of(CM_ORIENT_EDGES);
    for (int i = 0; i < 20; i++)
    {
        const cm_rotation rotation = any_rotation(&state);
        const double value = value_of(mapping, &half, &edges, &rotation);
        REQUIRE(fabs(value - 12.0 * acos(1.0 / 3.0)) < 1e-12, "%.17g", value);
    }
    cm_mapping_destroy(mapping);
}
END_TEST

/* The length of the turned edges over the pixels, by so many samples of each side of a face. */
static double sampled_edges(const cm_mapping *mapping, const cm_mask *mask,
                            const cm_rotation *rotation, int samples)
{
    double sum = 0.0;
    for (int side = 0; side < 24; side++)
    {
        double before[3] = {0.0, 0.0, 0.0};
        double value = 0.0;
        for (int i = 0; i <= 2 * samples; i++)
        {
            const double along = (double)i / samples - 1.0;
            const double across = side % 2 == 0 ? -1.0 : 1.0;
            const double uv[2] = {side % 4 < 2 ? across : along, side % 4 < 2 ? along : across};
            double d[3];
            cm_inverse(mapping, (uint8_t)(side / 4), uv, d);
            cm_rotate_back(rotation, d, d);
            /* from one even number to the next, over the pixel of the odd one between */
            if (i % 2 == 1)
            {
                value = pixel_at(mask, d);
                continue;
            }
            sum += i > 0 ? 0.5 * angle_between(before, d) * value : 0.0;
            memcpy(before, d, sizeof before);
        }
    }
    return sum;
}

/* Each point of an edge has the value of its pixel: so say many samples, of masks whose neighbours differ. */
START_TEST(test_edges_by_samples)
{
    static const size_t sizes[][2] = {{240, 120}, {1, 1},  {1, 5},  {3, 2},
                                      {7, 1},     {2, 90}, {61, 33}};
    static const char *const mappings[] = {"tangent", "healpix"};
    static float value[WIDTH * HEIGHT];
    uint64_t state = 17;
    for (size_t n = 0; n < 2 * COUNT(sizes); n++)
    {
        const cm_mask mask = {sizeof mask, sizes[n / 2][0], sizes[n / 2][1], value};
        cm_mapping *mapping = make_mapping(mappings[n % 2], NULL);
        const cm_orient_options options = options_of(CM_ORIENT_EDGES);
        for (size_t i = 0; i < mask.width * mask.height; i++)
        {
            value[i] = (float)(1.0 + next_real(&state));
        }
        for (int i = 0; i < 6; i++)
        {
            /* and nearly not turned, when edges are nearly meridians and pass by the poles */
            const double little = i < 4 ? 0.0 : i == 4 ? 1e-7 : 1e-9;
            cm_rotation rotation = any_rotation(&state);
            if (little > 0.0)
            {
                cm_rotation_from_angles(10.0 + little, 45.0 + little, 3.0 * little, &rotation);
            }
            const int samples = 2000;
            const double truth = sampled_edges(mapping, &mask, &rotation, samples);
            double found = 0.0;
            ck_assert_int_eq(cm_orient_value(mapping, &mask, &options, &rotation, &found), CM_OK);
            REQUIRE(fabs(found - truth) < 40.0 / samples, "%s, %zu x %zu, %d: %.9g, not %.9g",
                    mappings[n % 2], mask.width, mask.height, i, found, truth);
        }
        cm_mapping_destroy(mapping);
    }
}
END_TEST

/* Of an edge along a border of pixels half is on either side. The cube's upright edges are there at longitudes of 45
 * and 135 degrees; turned by 45 degrees of latitude it has two edges on the equator. */
START_TEST(test_edges_along_borders)
{
    static const float east[] = {0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f};
    static const float north[] = {1.0f, 1.0f, 0.0f, 0.0f};
    const double edge = acos(1.0 / 3.0);
    const cm_mask columns = {sizeof columns, 8, 1, east}; /* the column from 45 to 90 degrees */
    const cm_mask rows = {sizeof rows, 2, 2, north};
    const cm_orient_options options = options_of(CM_ORIENT_EDGES);
    cm_mapping *mapping = make_mapping("tangent", NULL);
    cm_rotation rotation;
    double value = 0.0;
    cm_rotation_from_angles(0.0, 0.0, 0.0, &rotation);
    ck_assert_int_eq(cm_orient_value(mapping, &columns, &options, &rotation, &value), CM_OK);
    /* half of the upright edge, and half of an edge above and of one below */
    REQUIRE(fabs(value - (0.5 + 1.0) * edge) < 1e-12, "%.17g", value / edge);
    cm_rotation_from_angles(0.0, 45.0, 0.0, &rotation);
    ck_assert_int_eq(cm_orient_value(mapping, &rows, &options, &rotation, &value), CM_OK);
    REQUIRE(fabs(value - 6.0 * edge) < 1e-12, "%.17g", value / edge);
    cm_mapping_destroy(mapping);
}
END_TEST

/* A cube that is turned on to itself has the same measure. */
START_TEST(test_symmetry_of_values)
{
    raster r;
    uint64_t state = 3;
    begin(&r);
    add_cap(&r, 20.0, 30.0, 25.0, NULL);
    add_cap(&r, -100.0, -50.0, 15.0, NULL);
    cm_mapping *mapping = make_mapping("coupled", NULL);
    for (int measure = 0; measure < 5; measure++)
    {
        const cm_orient_options options = options_of((cm_orient_measure)measure);
        const cm_rotation rotation = any_rotation(&state);
        const double value = value_of(mapping, &r, &options, &rotation);
        for (int i = 0; i < 16; i++)
        {
            cm_rotation turn;
            cm_rotation_from_angles(i % 4 * 90.0, 0.0, i / 4 * 90.0, &turn);
            const cm_rotation turned = product(&turn, &rotation);
            const double other = value_of(mapping, &r, &options, &turned);
            REQUIRE(fabs(other - value) < 1e-6, "%s: %.9g, not %.9g",
                    cm_orient_measure_name((size_t)measure), other, value);
        }
    }
    cm_mapping_destroy(mapping);
}
END_TEST

/* ---- The search ---- */

/* A cap belongs into the middle of a face, where nothing is deformed and no edge is. */
START_TEST(test_one_cap)
{
    static const double places[][2] = {{33.0, 21.0}, {-170.0, 62.0}, {77.0, -88.0}};
    for (size_t i = 0; i < COUNT(places); i++)
    {
        for (int measure = 0; measure < (i == 0 ? 5 : 1); measure += 4)
        {
            raster r;
            begin(&r);
            add_cap(&r, places[i][0], places[i][1], 12.0, NULL);
            const cm_orient_options options = options_of((cm_orient_measure)measure);
            const cm_orient_result found = orient("tangent", &r, &options);
            double d[3];
            cm_direction_from_lonlat(places[i][0] * DEGREE, places[i][1] * DEGREE, d);
            cm_rotate(&found.rotation, d, d);
            const double off = acos(fmax(fabs(d[0]), fmax(fabs(d[1]), fabs(d[2])))) / DEGREE;
            REQUIRE(off < (measure == 0 ? 0.2 : 33.0), "%g degrees off the middle", off);
            REQUIRE(found.symmetries == 24 && found.boxes > 0, "%u", found.symmetries);
            REQUIRE(measure == 0 ? found.after < 0.2 * found.before + 0.02 : found.after == 0.0,
                    "%g from %g", found.after, found.before);
        }
    }
}
END_TEST

/* The same mask elsewhere has its optimum there, and the same value. */
START_TEST(test_turned_mask)
{
    uint64_t state = 5;
    const cm_rotation turn = any_rotation(&state);
    raster first, second;
    begin(&first);
    begin(&second);
    for (int i = 0; i < 2; i++)
    {
        const cm_rotation *by = i == 0 ? NULL : &turn;
        raster *r = i == 0 ? &first : &second;
        add_cap(r, 10.0, 20.0, 14.0, by);
        add_cap(r, 75.0, -35.0, 10.0, by);
        add_cap(r, -120.0, 50.0, 8.0, by);
    }
    const cm_orient_options options = options_of(CM_ORIENT_DEFORMATION);
    const cm_orient_result a = orient("coupled", &first, &options);
    const cm_orient_result b = orient("coupled", &second, &options);
    const cm_rotation expected = product(&a.rotation, &turn);
    REQUIRE(fabs(a.after - b.after) < 5e-3 * a.after, "%.9g and %.9g", a.after, b.after);
    REQUIRE(apart(&expected, &b.rotation) < 0.5, "%g degrees", apart(&expected, &b.rotation));
}
END_TEST

static void check_survey(const cm_orient_result *found)
{
    REQUIRE(found->nodes > 5000 && found->minima >= 1 && found->minima < found->nodes, "%zu of %zu",
            found->minima, found->nodes);
    REQUIRE(found->valleys >= 1 && found->valleys <= found->minima && found->followed >= 1 &&
                found->followed <= found->valleys,
            "%zu, %zu", found->valleys, found->followed);
    REQUIRE(found->margin >= 0.0 && found->error >= 0.0 && found->drop >= 0.0, "%g %g %g",
            found->margin, found->error, found->drop);
    REQUIRE(found->other_apart > 0.0
                ? found->other_apart >= 5.0 && found->other.value >= found->after
                : found->other.value == found->after,
            "%g at %g", found->other.value, found->other_apart);
}

/* What is said of all other rotations holds for any; the result is the least turned of its like; the rivals are
 * sorted and have their values. */
static void check_claims(const char *name, const raster *r, const cm_orient_options *options)
{
    cm_mapping *mapping = make_mapping(name, NULL);
    const cm_orient_result found = orient(name, r, options);
    uint64_t state = 7;
    const cm_rotation none = {{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
    cm_rotation parsed;
    ck_assert_int_eq(cm_rotation_from_angles(found.lon, found.lat, found.roll, &parsed), CM_OK);
    REQUIRE(apart(&parsed, &found.rotation) < 1e-5, "angles");
    REQUIRE(value_of(mapping, r, options, &found.rotation) == found.after, "after");
    REQUIRE(fabs(value_of(mapping, r, options, &none) - found.before) <= 1e-12, "before");
    REQUIRE(found.after <= found.before && found.gap >= 0.0, "%g, gap %g", found.after, found.gap);
    for (int i = 0; i < 300; i += (int)step_of(5))
    {
        cm_rotation other = any_rotation(&state);
        if (i % 3 == 0) /* near the optimum */
        {
            cm_rotation little;
            cm_rotation_from_angles(next_real(&state), next_real(&state), next_real(&state),
                                    &little);
            other = product(&little, &found.rotation);
        }
        const double value = value_of(mapping, r, options, &other);
        REQUIRE(value >= found.after - found.gap, "%s: %g, but %g - %g is least", name, value,
                found.after, found.gap);
        REQUIRE(found.symmetries != 24 || apart(&other, &found.rotation) < found.radius ||
                    value >= found.after,
                "%s: %g at %g degrees", name, value, apart(&other, &found.rotation));
    }
    for (size_t i = 0; i < found.rival_count; i++)
    {
        REQUIRE(value_of(mapping, r, options, &found.rival[i].rotation) == found.rival[i].value,
                "%s: rival %zu", name, i);
        REQUIRE(found.rival[i].value >= found.after, "%s: rival %zu is better", name, i);
    }
    REQUIRE(found.rival_count > 0 && found.rival[0].value == found.after, "%s: first", name);
    check_survey(&found);
    cm_mapping_destroy(mapping);
}

START_TEST(test_claims)
{
    raster r;
    begin(&r);
    add_cap(&r, -60.0, -10.0, 18.0, NULL);
    add_cap(&r, 20.0, 5.0, 20.0, NULL);
    cm_orient_options options = options_of(CM_ORIENT_DEFORMATION);
    /* with all levels in the long run */
    options.boxes_max = is_long() ? 100000 : 11000;
    check_claims("tangent", &r, &options);
    options.boxes_max = FEW_BOXES;
    options.over = CM_OVER_FACE;
    check_claims("nowell", &r, &options);
    options.measure = CM_ORIENT_AREA;
    check_claims("gnomonic", &r, &options);
    options = options_of(CM_ORIENT_ISOTROPY);
    check_claims("qsc", &r, &options);
    options = options_of(CM_ORIENT_SCALE);
    check_claims("coupled", &r, &options);
    options = options_of(CM_ORIENT_EDGES);
    check_claims("coupled", &r, &options);
    raster wide; /* more than a face, so that some edge is always over it */
    begin(&wide);
    add_cap(&wide, 30.0, 20.0, 70.0, NULL);
    options.threads = 2;
    check_claims("coupled", &wide, &options);
    options = options_of(CM_ORIENT_DEFORMATION);
    check_claims("healpix", &r, &options);
}
END_TEST

/* How far, degrees, the direction between two places is from the middle of a face, or of an edge, of the turned cube. */
static double from_middle(const cm_rotation *rotation, const double place[2][2], int of_edge)
{
    double sum[3] = {0.0, 0.0, 0.0};
    for (int i = 0; i < 2; i++)
    {
        double d[3];
        cm_direction_from_lonlat(place[i][0] * PI / 180.0, place[i][1] * PI / 180.0, d);
        for (int k = 0; k < 3; k++)
        {
            sum[k] += d[k];
        }
    }
    cm_rotate(rotation, sum, sum);
    const double size[3] = {fabs(sum[0]), fabs(sum[1]), fabs(sum[2])};
    const double all = size[0] + size[1] + size[2];
    const double most = fmax(size[0], fmax(size[1], size[2]));
    const double least = fmin(size[0], fmin(size[1], size[2]));
    const double length = sqrt(size[0] * size[0] + size[1] * size[1] + size[2] * size[2]);
    /* of the nearest edge the middle is (1, 1, 0) / sqrt 2 in some order */
    return acos(fmin(1.0, of_edge ? (all - least) / length * sqrt(0.5) : most / length)) * 180.0 /
           PI;
}

/* Two caps are deformed least with both on one face, its middle between them, or on two, with the middle of an edge
 * between them: as far from a middle as half their distance, or as 45 degrees less that. So the one is the best valley
 * of caps 40 degrees apart, and the other one of those 50 apart, and there is no third. */
START_TEST(test_two_valleys)
{
    cm_mapping *mapping = make_mapping("algebraic", NULL);
    for (int wide = 0; wide < 2; wide++)
    {
        const double place[2][2] = {{10.0, 0.0}, {wide ? 60.0 : 50.0, 0.0}};
        raster r;
        begin(&r);
        add_cap(&r, place[0][0], place[0][1], 7.0, NULL);
        add_cap(&r, place[1][0], place[1][1], 7.0, NULL);
        const cm_orient_options options = options_of(CM_ORIENT_DEFORMATION);
        const cm_orient_result found = orient("algebraic", &r, &options);
        check_survey(&found);
        REQUIRE(found.valleys == 2 && found.rival_count == 2, "%zu valleys", found.valleys);
        const double best = from_middle(&found.rotation, place, wide);
        const double other = from_middle(&found.other.rotation, place, !wide);
        REQUIRE(best < 0.5 && other < 5.0, "%g and %g degrees", best, other);
        REQUIRE(found.other_apart > 20.0, "%g degrees", found.other_apart);
        /* no rotation near its own is better: it is an optimum, not a slope */
        for (int i = 0; i < 6; i++)
        {
            const double angle = i % 2 == 0 ? 0.5 : -0.5;
            cm_rotation little;
            cm_rotation_from_angles(i / 2 == 0 ? angle : 0.0, i / 2 == 1 ? angle : 0.0,
                                    i / 2 == 2 ? angle : 0.0, &little);
            const cm_rotation near = product(&little, &found.other.rotation);
            REQUIRE(value_of(mapping, &r, &options, &near) > found.other.value, "way %d", i);
        }
    }
    cm_mapping_destroy(mapping);
}
END_TEST

/* The search over edges of healpix, which takes as long as all others here, is for the long run; that its edges have 8
 * turns a mask of one pixel shows, which leaves nothing to search. */
START_TEST(test_symmetries)
{
    static const struct
    {
        const char *mapping;
        cm_orient_measure measure;
        unsigned count;
    } known[] = {{"coupled", CM_ORIENT_DEFORMATION, 24},   {"qsc", CM_ORIENT_DEFORMATION, 24},
                 {"gnomonic", CM_ORIENT_EDGES, 24},        {"healpix", CM_ORIENT_DEFORMATION, 8},
                 {"continuous", CM_ORIENT_DEFORMATION, 4}, {"healpix", CM_ORIENT_EDGES, 8}};
    raster r;
    begin(&r);
    add_cap(&r, 0.0, 45.0, 5.0, NULL);
    raster single;
    begin(&single);
    single.mask.width = single.mask.height = 1;
    single.value[0] = 1.0f;
    const cm_orient_options edges = options_of(CM_ORIENT_EDGES);
    REQUIRE(orient("healpix", &single, &edges).symmetries == 8, "healpix");
    for (size_t i = 0; i < COUNT(known) - (is_long() ? 0 : 1); i++)
    {
        cm_orient_options options = options_of(known[i].measure);
        const cm_orient_result found = orient(known[i].mapping, &r, &options);
        REQUIRE(found.symmetries == known[i].count, "%s: %u", known[i].mapping, found.symmetries);
        /* the cap finds room on a face, and no bound is less than nothing */
        REQUIRE(known[i].measure != CM_ORIENT_EDGES || (found.after == 0.0 && found.gap < 1e-5),
                "%s: %g, gap %g", known[i].mapping, found.after, found.gap);
    }
}
END_TEST

/* Where the measure is the same for all, the cube stays. */
START_TEST(test_flat)
{
    raster r;
    begin(&r);
    add_cap(&r, 30.0, 40.0, 20.0, NULL);
    for (int i = 0; i < 2; i++)
    {
        const cm_orient_options options =
            options_of(i == 0 ? CM_ORIENT_DEFORMATION : CM_ORIENT_AREA);
        const cm_orient_result found = orient(i == 0 ? "conformal" : "qsc", &r, &options);
        REQUIRE(found.lon == 0.0 && found.lat == 0.0 && found.roll == 0.0, "turned");
        REQUIRE(found.before == found.after && found.radius == 180.0, "%g", found.after);
    }
}
END_TEST

START_TEST(test_threads)
{
    raster r;
    begin(&r);
    add_cap(&r, 30.0, 40.0, 20.0, NULL);
    add_cap(&r, -30.0, 10.0, 9.0, NULL);
    cm_orient_options options = options_of(CM_ORIENT_DEFORMATION);
    cm_orient_result first = {.size = 0};
    for (unsigned threads = 1; threads < 4; threads++)
    {
        options.threads = threads;
        const cm_orient_result found = orient("tangent", &r, &options);
        first = threads == 1 ? found : first;
        REQUIRE(memcmp(&found.rotation, &first.rotation, sizeof found.rotation) == 0 &&
                    found.after == first.after && found.gap == first.gap &&
                    found.boxes == first.boxes && found.rival_count == first.rival_count &&
                    found.nodes == first.nodes && found.minima == first.minima &&
                    found.valleys == first.valleys && found.followed == first.followed &&
                    found.margin == first.margin && found.error == first.error &&
                    found.drop == first.drop && found.other_apart == first.other_apart &&
                    memcmp(&found.other, &first.other, sizeof found.other) == 0 &&
                    memcmp(found.rival, first.rival, sizeof found.rival) == 0,
                "%u threads", threads);
    }
}
END_TEST

/* ---- What is refused ---- */

typedef struct calls
{
    double last;
    int count;
    int stop_at;
} calls;

static int count_calls(double done, void *user)
{
    calls *c = user;
    REQUIRE(done >= c->last && done <= 1.0, "%g after %g", done, c->last);
    c->last = done;
    return ++c->count == c->stop_at;
}

/* When the grid about the first valley of edges has been looked at, before the first bound. */
static int stop_about(double done, void *user)
{
    *(double *)user = done;
    return done > 0.594;
}

START_TEST(test_progress_of_edges)
{
    raster r;
    begin(&r);
    add_cap(&r, 30.0, 40.0, 70.0, NULL);
    double last = 0.0;
    cm_orient_options options = options_of(CM_ORIENT_EDGES);
    options.progress = stop_about;
    options.user = &last;
    cm_mapping *mapping = make_mapping("tangent", NULL);
    cm_orient_result result = {.size = sizeof result};
    ck_assert_int_eq(cm_orient(mapping, &r.mask, &options, &result), CM_ERROR_STOPPED);
    REQUIRE(last < 0.6, "%g", last);
    cm_mapping_destroy(mapping);
}
END_TEST

START_TEST(test_progress)
{
    raster r;
    begin(&r);
    add_cap(&r, 30.0, 40.0, 10.0, NULL);
    calls seen = {0.0, 0, 0};
    cm_orient_options options = options_of(CM_ORIENT_DEFORMATION);
    options.progress = count_calls;
    options.user = &seen;
    orient("tangent", &r, &options);
    REQUIRE(seen.count > 5 && seen.last == 1.0, "%d calls to %g", seen.count, seen.last);
    cm_mapping *mapping = make_mapping("tangent", NULL);
    const int all = seen.count;
    const size_t most[] = {
        0, SIZE_MAX}; /* begin in the same way, but the latter's grid takes seconds */
    for (size_t i = 0; i < (is_long() ? COUNT(most) : 1); i++)
    {
        cm_orient_result result = {.size = sizeof result};
        seen = (calls){0.0, 0, 1};
        options.boxes_max = most[i];
        ck_assert_int_eq(cm_orient(mapping, &r.mask, &options, &result), CM_ERROR_STOPPED);
    }
    options.boxes_max = FEW_BOXES;
    for (int stop = 1; stop <= all; stop += 1 + all / 7)
    {
        cm_orient_result result = {.size = sizeof result, .after = 7.0};
        seen = (calls){0.0, 0, stop};
        ck_assert_int_eq(cm_orient(mapping, &r.mask, &options, &result), CM_ERROR_STOPPED);
        REQUIRE(result.after == 7.0 && seen.count == stop, "%d calls", seen.count);
    }
    cm_mapping_destroy(mapping);
}
END_TEST

static void check_refused(const cm_mapping *mapping, const cm_mask *mask,
                          const cm_orient_options *options, cm_status wanted)
{
    const cm_rotation none = {{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
    cm_orient_result result = {.size = sizeof result, .after = 7.0};
    double value = 7.0;
    ck_assert_int_eq(cm_orient(mapping, mask, options, &result), wanted);
    ck_assert_int_eq(cm_orient_value(mapping, mask, options, &none, &value), wanted);
    REQUIRE(result.after == 7.0 && value == 7.0, "touched");
}

START_TEST(test_bad_input)
{
    raster r;
    begin(&r);
    add_cap(&r, 30.0, 40.0, 10.0, NULL);
    cm_mapping *mapping = make_mapping("tangent", NULL);
    const cm_orient_options good = options_of(CM_ORIENT_DEFORMATION);
    check_refused(NULL, &r.mask, &good, CM_ERROR_ARGUMENT);
    check_refused(mapping, NULL, &good, CM_ERROR_ARGUMENT);
    check_refused(mapping, &r.mask, NULL, CM_ERROR_ARGUMENT);
    for (int i = 0; i < 9; i++)
    {
        cm_mask mask = r.mask;
        cm_orient_options options = good;
        mask.size -= i == 0;
        mask.width = i == 1 ? 0 : i == 2 ? CM_MASK_MAX + 1 : mask.width;
        mask.height = i == 3 ? 0 : i == 8 ? CM_MASK_MAX + 1 : mask.height;
        mask.value = i == 4 ? NULL : mask.value;
        options.size -= i == 5;
        options.measure = (cm_orient_measure)(i == 6 ? 5 : 0);
        options.over = (cm_measure)(i == 7 ? 2 : 1);
        check_refused(mapping, &mask, &options, CM_ERROR_ARGUMENT);
    }
    const double resolutions[] = {-1.0, 0.001, 11.0, (double)NAN, (double)INFINITY};
    for (size_t i = 0; i < COUNT(resolutions); i++)
    {
        cm_orient_options options = good;
        options.resolution = resolutions[i];
        check_refused(mapping, &r.mask, &options, CM_ERROR_ARGUMENT);
    }
    const float values[] = {-1.0f, NAN, INFINITY, -INFINITY, -1e-30f};
    for (size_t i = 0; i < COUNT(values); i++)
    {
        raster wrong = r;
        wrong.mask.value = wrong.value;
        wrong.value[777] = values[i];
        check_refused(mapping, &wrong.mask, &good, CM_ERROR_ARGUMENT);
    }
    raster empty;
    begin(&empty);
    check_refused(mapping, &empty.mask, &good, CM_ERROR_ARGUMENT);
    cm_mapping_destroy(mapping);
    mapping = make_mapping("octahedral", NULL);
    check_refused(mapping, &r.mask, &good, CM_ERROR_UNSUPPORTED);
    cm_mapping_destroy(mapping);

    mapping = make_mapping("tangent", NULL);
    cm_orient_result result = {.size = sizeof result - 1};
    double value = 7.0;
    const cm_rotation zero = {{{0.0}}};
    ck_assert_int_eq(cm_orient(mapping, &r.mask, &good, NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_orient(mapping, &r.mask, &good, &result), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_orient_value(mapping, &r.mask, &good, NULL, &value), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_orient_value(mapping, &r.mask, &good, &zero, &value), CM_ERROR_ORIENTATION);
    ck_assert_int_eq(cm_orient_value(mapping, &r.mask, &good, &zero, NULL), CM_ERROR_ARGUMENT);
    REQUIRE(value == 7.0, "touched");
    cm_mapping_destroy(mapping);
}
END_TEST

START_TEST(test_odd_masks)
{
    static const size_t sizes[][2] = {{1, 1}, {1, 7}, {3, 1}, {2, 2}, {5, 3}};
    static const float values[] = {0.0f, 3e38f, 1e-38f, 1e-45f, 0.5f, 1.0f, 0.0f, 0.0f,
                                   1.0f, 2.0f,  0.0f,   0.0f,   0.0f, 0.0f, 9.0f};
    for (size_t i = 0; i < COUNT(sizes); i++)
    {
        /* edges, which take longer: of one odd size and one even one, and of all in the long run */
        const int measures = is_long() || (!is_quick() && i % 2 == 1) ? 5 : 1;
        for (int measure = 0; measure < measures; measure += 4)
        {
            const cm_mask mask = {sizeof mask, sizes[i][0], sizes[i][1],
                                  values + (sizes[i][0] * sizes[i][1] == 1)};
            cm_orient_options options = options_of((cm_orient_measure)measure);
            cm_orient_result result = {.size = sizeof result};
            cm_mapping *mapping = make_mapping("coupled", NULL);
            ck_assert_int_eq(cm_orient(mapping, &mask, &options, &result), CM_OK);
            REQUIRE(isfinite(result.after) && result.after <= result.before, "%g", result.after);
            cm_mapping_destroy(mapping);
        }
    }
}
END_TEST

/* At edges of this map a / b is infinite, and all pixels of this mask are there until the cube is turned. */
START_TEST(test_no_value)
{
    static const float values[] = {1.0f, 1.0f, 1.0f, 1.0f};
    const cm_mask mask = {sizeof mask, 4, 1, values};
    const cm_orient_options options = options_of(CM_ORIENT_ISOTROPY);
    const cm_rotation none = {{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
    cm_orient_result result = {.size = sizeof result};
    double value = 7.0;
    cm_mapping *mapping = make_mapping("smoothstep:c=1", NULL);
    ck_assert_int_eq(cm_orient_value(mapping, &mask, &options, &none, &value), CM_OK);
    REQUIRE(value == (double)INFINITY, "%g", value);
    ck_assert_int_eq(cm_orient(mapping, &mask, &options, &result), CM_OK);
    REQUIRE(result.before == (double)INFINITY && isfinite(result.after) && result.after > 1.0,
            "%g to %g", result.before, result.after);
    cm_mapping_destroy(mapping);
}
END_TEST

START_TEST(test_names)
{
    for (size_t i = 0; i < 5; i++)
    {
        REQUIRE(cm_orient_measure_find(cm_orient_measure_name(i)) == (int)i, "%zu", i);
    }
    ck_assert_ptr_null(cm_orient_measure_name(5));
    ck_assert_int_eq(cm_orient_measure_find("EDGES"), CM_ORIENT_EDGES);
    ck_assert_int_eq(cm_orient_measure_find("edge"), -1);
    ck_assert_int_eq(cm_orient_measure_find(""), -1);
    ck_assert_int_eq(cm_orient_measure_find(NULL), -1);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {test_whole_sphere,
                                  test_many_pixels,
                                  test_simple_masks,
                                  test_edges_by_samples,
                                  test_edges_along_borders,
                                  test_progress_of_edges,
                                  test_symmetry_of_values,
                                  test_one_cap,
                                  test_turned_mask,
                                  test_claims,
                                  test_two_valleys,
                                  test_symmetries,
                                  test_flat,
                                  test_threads,
                                  test_progress,
                                  test_bad_input,
                                  test_odd_masks,
                                  test_no_value,
                                  test_names,
                                  NULL};
    return run_suite("orientation", tests);
}
