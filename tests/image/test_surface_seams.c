/* SPDX-License-Identifier: MIT
 *
 * Seams: resampling from every kind of surface is as good beside the edges of planes, at corners, poles and the dateline as
 * inside, and what is beside the map, or in the empty parts of a picture, is never seen.
 */
#include <cubemap/image.h>

#include "tests/suite.h"

#define CHANNELS 2
#define NEAR 3.0 /* pixels */
#define RING                                                                                       \
    9.0 /* what is farther away, but near enough to be as large on the sphere, is compared with it */

/* Polynomials through six points do not fill better, in decibels. */
#define FILLED 97.0

/* Regions of the source. */
enum
{
    INSIDE,
    EDGE,
    CORNER,
    POLE,
    DATELINE,
    REGIONS
};

static const char *const region_names[] = {"inside", "edge", "corner", "pole", "dateline"};

typedef struct seam_case
{
    const char *specification;
    int creased; /* the worst creases inside end at edges; a seam would be worse than any of them */
} seam_case;

static const seam_case cases[] = {
    {"equirect;size=512", 0},
    {"cube;size=128", 0},
    {"cube:gnomonic;frame=gl;layout=vcross;size=128", 0},
    {"cube;layout=cross:north=3,south=0;size=128", 0},
    {"cube:tangent;layout=eac:pad=3;size=128", 0},
    {"cube;frame=s2;layout=strip;size=128", 0},
    {"dual-fisheye;size=512", 0},
    {"dual-fisheye:fov=190;size=512", 0},
    {"dual-fisheye:lambert;size=512", 0},
    {"dual-paraboloid;size=512", 0},
    {"fisheye:equidistant:fov=360;size=512", 0},
    {"fisheye:breusing:fov=360;size=512", 0},
    {"azimuthal:equidistant:fov=360;size=512", 0},
    {"healpix:128", 1},
    {"rhealpix;size=512", 1},
};
#define CASES (sizeof cases / sizeof *cases)

static cm_surface *make(const char *specification)
{
    cm_surface *surface = NULL;
    REQUIRE(cm_surface_create(specification, NULL, &surface) == CM_OK, "%s", specification);
    return surface;
}

/* Waves all around: the shortest has about 20 pixels. */
static float scene(const double d[3], int channel)
{
    static const double wave[4][3] = {{14, 3, 7}, {-5, 13, 9}, {9, -6, 14}, {10, 10, -10}};
    double sum = 0.0;
    for (int i = 0; i < 4; i++)
    {
        sum += cos(wave[i][0] * d[0] + wave[i][1] * d[1] + wave[i][2] * d[2] + i + channel);
    }
    return (float)(0.5 + sum / 9.0);
}

/* ---- pictures ---- */

static void allocate(const cm_surface *surface, cm_pixel_type type, cm_image pictures[6])
{
    for (size_t i = 0; i < cm_surface_picture_count(surface); i++)
    {
        pictures[i] = (cm_image){.size = sizeof *pictures,
                                 .type = type,
                                 .width = cm_surface_width(surface),
                                 .height = cm_surface_height(surface),
                                 .channels = CHANNELS};
        pictures[i].data =
            malloc((size_t)pictures[i].width * pictures[i].height * CHANNELS * cm_pixel_size(type));
        ck_assert_ptr_nonnull(pictures[i].data);
    }
}

static void release(const cm_surface *surface, cm_image pictures[6])
{
    for (size_t i = 0; i < cm_surface_picture_count(surface); i++)
    {
        free(pictures[i].data);
    }
}

static size_t bytes_of(const cm_image *picture)
{
    return (size_t)picture->width * picture->height * CHANNELS * cm_pixel_size(picture->type);
}

static void *pixel_of(const cm_surface *surface, cm_image pictures[6], uint32_t plane,
                      uint32_t column, uint32_t row)
{
    uint32_t at[3];
    cm_surface_pixel(surface, plane, column, row, &at[0], &at[1], &at[2]);
    cm_image *picture = &pictures[at[0]];
    return (unsigned char *)picture->data +
           ((size_t)at[2] * picture->width + at[1]) * CHANNELS * cm_pixel_size(picture->type);
}

static void put(cm_pixel_type type, void *pixel, const double d[3])
{
    for (int c = 0; c < CHANNELS; c++)
    {
        const float value = scene(d, c);
        if (type == CM_PIXEL_FLOAT)
        {
            ((float *)pixel)[c] = value;
        }
        else
        {
            ((uint8_t *)pixel)[c] = (uint8_t)lrintf(255.0f * value);
        }
    }
}

/* The scene where the map is, and a byte's value where it is not: NaN in float is all 255. */
static void paint(const cm_surface *surface, cm_image pictures[6], int beside)
{
    for (size_t i = 0; i < cm_surface_picture_count(surface); i++)
    {
        memset(pictures[i].data, beside, bytes_of(&pictures[i]));
    }
    for (uint32_t plane = 0; plane < cm_surface_plane_count(surface); plane++)
    {
        for (uint32_t row = 0; row < cm_surface_plane_height(surface); row++)
        {
            for (uint32_t column = 0; column < cm_surface_plane_width(surface); column++)
            {
                const uint8_t face = (uint8_t)plane;
                const double x = column + 0.5, y = row + 0.5;
                double d[3];
                cm_surface_directions(surface, 1, &face, &x, &y, &d[0], &d[1], &d[2]);
                if (!isnan(d[0]))
                {
                    put(pictures->type, pixel_of(surface, pictures, plane, column, row), d);
                }
            }
        }
    }
}

static void resample(const cm_surface *from, const cm_surface *to, cm_image source[6],
                     cm_image target[6], cm_filter filter, unsigned threads)
{
    const cm_plan_options options = {.size = sizeof options, .filter = filter, .tolerance = -1.0};
    cm_plan *plan = NULL;
    cm_source *ready = NULL;
    ck_assert_int_eq(cm_plan_create(from, to, &options, &plan), CM_OK);
    ck_assert_int_eq(cm_source_create(plan, source, target->type, threads, &ready), CM_OK);
    ck_assert_int_eq(cm_resample_source(plan, ready, target, (cm_rows){0}, threads), CM_OK);
    cm_source_destroy(ready);
    cm_plan_destroy(plan);
}

/* ---- quality ---- */

/* Is there nothing near on the plane? */
static int is_beside_gap(const cm_surface *surface, uint8_t plane, double x, double y, double near)
{
    for (int k = 0; k < 8; k++)
    {
        const double column = x + near * cos(0.78539816 * k);
        const double row = y + near * sin(0.78539816 * k);
        double d[3];
        cm_surface_directions(surface, 1, &plane, &column, &row, &d[0], &d[1], &d[2]);
        if (isnan(d[0]))
        {
            return 1;
        }
    }
    return 0;
}

static int region_within(const cm_surface *surface, const double d[3], uint8_t plane, double x,
                         double y, double near)
{
    const double width = cm_surface_plane_width(surface);
    const double height = cm_surface_plane_height(surface);
    const double pixel = 6.2832 / cm_surface_width(surface);
    const int left = fmin(x, width - x) < near;
    const int top = fmin(y, height - y) < near;
    /* of meridians and parallels; in other kinds these places are like all */
    const int has_poles = strncmp(cm_surface_specification(surface), "equi", 4) == 0;
    if (has_poles && hypot(d[0], d[1]) < near * pixel)
    {
        return POLE;
    }
    if (has_poles && d[0] < 0.0 && fabs(d[1]) < near * pixel)
    {
        return DATELINE;
    }
    return left && top                                                ? CORNER
           : left || top || is_beside_gap(surface, plane, x, y, near) ? EDGE
                                                                      : INSIDE;
}

/* A region, or REGIONS + the one that it is a ring around. */
static int region_of(const cm_surface *surface, const double d[3], uint8_t plane, double x,
                     double y)
{
    const int region = region_within(surface, d, plane, x, y, NEAR);
    const int ring = region_within(surface, d, plane, x, y, RING);
    return region != INSIDE ? region : ring != INSIDE ? REGIONS + ring : INSIDE;
}

typedef struct quality
{
    double sum[2 * REGIONS];
    double worst[2 * REGIONS];
    size_t count[2 * REGIONS];
} quality;

static void measure(const cm_surface *from, const cm_surface *to, cm_image target[6],
                    quality *measured)
{
    memset(measured, 0, sizeof *measured);
    for (uint32_t plane = 0; plane < cm_surface_plane_count(to); plane++)
    {
        for (uint32_t row = 0; row < cm_surface_plane_height(to); row++)
        {
            for (uint32_t column = 0; column < cm_surface_plane_width(to); column++)
            {
                uint8_t face = (uint8_t)plane;
                double x = column + 0.5, y = row + 0.5, d[3];
                cm_surface_directions(to, 1, &face, &x, &y, &d[0], &d[1], &d[2]);
                cm_surface_positions(from, 1, &d[0], &d[1], &d[2], &face, &x, &y);
                const int region = region_of(from, d, face, x, y);
                const float *pixel = pixel_of(to, target, plane, column, row);
                for (int c = 0; c < CHANNELS; c++)
                {
                    const double error = fabs((double)pixel[c] - (double)scene(d, c));
                    ck_assert(!isnan(error));
                    measured->sum[region] += error * error;
                    measured->worst[region] = fmax(measured->worst[region], error);
                    measured->count[region]++;
                }
            }
        }
    }
}

static double decibels(const quality *measured, int region)
{
    return -10.0 * log10(measured->sum[region] / (double)measured->count[region]);
}

START_TEST(test_seams_are_as_good_as_the_inside)
{
    static const cm_filter filters[] = {CM_FILTER_BILINEAR, CM_FILTER_CATMULL_ROM,
                                        CM_FILTER_SPLINE36};
    cm_surface *to = make("cube;size=80");
    cm_image target[6];
    allocate(to, CM_PIXEL_FLOAT, target);
    for (size_t i = 0; i < CASES; i += step_of(4))
    {
        cm_surface *from = make(cases[i].specification);
        cm_image source[6];
        allocate(from, CM_PIXEL_FLOAT, source);
        paint(from, source, 255);
        for (size_t f = 0; f < sizeof filters / sizeof *filters; f++)
        {
            quality measured;
            resample(from, to, source, target, filters[f], 1);
            measure(from, to, target, &measured);
            for (int region = EDGE; region < REGIONS; region++)
            {
                if (measured.count[region] == 0)
                {
                    continue;
                }
                if (cases[i].creased)
                {
                    REQUIRE(measured.worst[region] < 3.0 * measured.worst[INSIDE],
                            "%s, %s, %s: %g, inside %g", cases[i].specification,
                            cm_filter_name(filters[f]), region_names[region],
                            measured.worst[region], measured.worst[INSIDE]);
                    continue;
                }
                const double ring = measured.count[REGIONS + region] == 0
                                        ? HUGE_VAL
                                        : decibels(&measured, REGIONS + region);
                const double inside = fmin(decibels(&measured, INSIDE), ring);
                REQUIRE(decibels(&measured, region) > fmin(inside - 1.0, FILLED),
                        "%s, %s, %s: %.2f dB, inside %.2f", cases[i].specification,
                        cm_filter_name(filters[f]), region_names[region],
                        decibels(&measured, region), inside);
            }
        }
        release(from, source);
        cm_surface_destroy(from);
    }
    release(to, target);
    cm_surface_destroy(to);
}
END_TEST

/* ---- what is beside the map ---- */

/* Of maps of a part of the sphere, too. */
static const char *const gapped[] = {"fisheye:equidistant:fov=170;size=90;height=70",
                                     "fisheye:lambert:fov=360;size=80",
                                     "fisheye:orthographic;size=64;x=20;y=40;radius=30.5",
                                     "dual-fisheye;size=128",
                                     "dual-paraboloid;size=120;height=64",
                                     "rhealpix;size=90",
                                     "azimuthal:stereographic:fov=120;size=70",
                                     "cube;layout=cross:north=0;size=24",
                                     "cube:tangent;layout=eac:pad=5;size=24"};
#define GAPPED (sizeof gapped / sizeof *gapped)

START_TEST(test_what_is_beside_is_never_seen)
{
    cm_surface *to = make("cube;size=40");
    for (size_t i = 0; i < GAPPED; i++)
    {
        cm_surface *from = make(gapped[i]);
        for (int filter = CM_FILTER_NEAREST; filter <= CM_FILTER_SPLINE36; filter++)
        {
            cm_image source[6], target[2][6];
            for (int type = 0; type < 2; type++)
            {
                const cm_pixel_type pixels = type == 0 ? CM_PIXEL_U8 : CM_PIXEL_FLOAT;
                allocate(from, pixels, source);
                for (int beside = 0; beside < 2; beside++)
                {
                    allocate(to, pixels, target[beside]);
                    paint(from, source, 255 * beside);
                    unsigned char *before = malloc(bytes_of(source));
                    ck_assert_ptr_nonnull(before);
                    memcpy(before, source->data, bytes_of(source));
                    resample(from, to, source, target[beside], (cm_filter)filter,
                             beside == 0 ? 1 : 3);
                    REQUIRE(memcmp(before, source->data, bytes_of(source)) == 0,
                            "%s: the caller's picture is another", gapped[i]);
                    free(before);
                }
                for (size_t k = 0; k < 6; k++)
                {
                    REQUIRE(memcmp(target[0][k].data, target[1][k].data, bytes_of(target[0])) == 0,
                            "%s, %s: face %zu", gapped[i], cm_filter_name((cm_filter)filter), k);
                }
                release(to, target[0]);
                release(to, target[1]);
                release(from, source);
            }
        }
        cm_surface_destroy(from);
    }
    cm_surface_destroy(to);
}
END_TEST

/* A map of a part of the sphere goes on as its last pixels are: one colour stays one to the rim. */
START_TEST(test_parts_are_whole_to_their_rim)
{
    static const char *const parts[] = {"fisheye:equidistant:fov=170;size=64",
                                        "view:fov=80;size=60", "fisheye:lambert:fov=360;size=64",
                                        "equirect;west=0;east=50;south=10;north=90;size=50"};
    cm_surface *to = make("cube;size=60");
    cm_image target[6], source[6];
    allocate(to, CM_PIXEL_FLOAT, target);
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
    {
        cm_surface *from = make(parts[i]);
        allocate(from, CM_PIXEL_FLOAT, source);
        paint(from, source, 0);
        float *values = source->data;
        for (size_t k = 0; k < bytes_of(source) / sizeof *values; k++)
        {
            values[k] = values[k] != 0.0f ? 0.75f : -7.0f;
        }
        for (int filter = CM_FILTER_NEAREST; filter <= CM_FILTER_SPLINE36; filter++)
        {
            size_t seen = 0;
            resample(from, to, source, target, (cm_filter)filter, 1);
            for (size_t k = 0; k < 6 * 60 * 60; k++)
            {
                const float value = ((float *)target[k / 3600].data)[k % 3600 * CHANNELS];
                seen += value != 0.0f;
                REQUIRE(value == 0.0f || fabsf(value - 0.75f) < 1e-5f, "%s, %s: %g", parts[i],
                        cm_filter_name((cm_filter)filter), (double)value);
            }
            ck_assert_uint_gt(seen, 1000);
        }
        release(from, source);
        cm_surface_destroy(from);
    }
    release(to, target);
    cm_surface_destroy(to);
}
END_TEST

/* Very small maps have no polynomials, and what is asked of them still has a value. */
START_TEST(test_small_maps)
{
    static const char *const small[] = {"fisheye;size=1",
                                        "fisheye;size=2",
                                        "dual-fisheye;size=2",
                                        "dual-paraboloid;size=6",
                                        "rhealpix;size=3",
                                        "healpix:1",
                                        "healpix:2",
                                        "cube;layout=vcross;size=1",
                                        "azimuthal:lambert:fov=360;size=3"};
    cm_surface *to = make("cube;size=9");
    cm_image target[6], source[6];
    allocate(to, CM_PIXEL_FLOAT, target);
    for (size_t i = 0; i < sizeof small / sizeof *small; i++)
    {
        cm_surface *from = make(small[i]);
        allocate(from, CM_PIXEL_FLOAT, source);
        paint(from, source, 0);
        for (int filter = CM_FILTER_NEAREST; filter <= CM_FILTER_SPLINE36; filter++)
        {
            resample(from, to, source, target, (cm_filter)filter, 1);
            for (size_t k = 0; k < 6 * 81 * CHANNELS; k++)
            {
                const float value =
                    ((float *)target[k / (81 * CHANNELS)].data)[k % (81 * CHANNELS)];
                REQUIRE(fabsf(value) < 4.0f, "%s, %s: %g", small[i],
                        cm_filter_name((cm_filter)filter), (double)value);
            }
        }
        release(from, source);
        cm_surface_destroy(from);
    }
    release(to, target);
    cm_surface_destroy(to);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {test_seams_are_as_good_as_the_inside,
                                  test_what_is_beside_is_never_seen,
                                  test_parts_are_whole_to_their_rim, test_small_maps, NULL};
    return run_suite("surface seams", tests);
}
