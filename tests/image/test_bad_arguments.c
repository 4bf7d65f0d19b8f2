/* SPDX-License-Identifier: MIT
 *
 * What public functions answer to what they cannot take: NULL in each place, sizes of 0, another size of a structure, NaN,
 * what is out of range; and that nothing is written then.
 */
#include <cubemap/compare.h>
#include <cubemap/environment.h>
#include <cubemap/mips.h>
#include <cubemap/panorama.h>

#include "tests/suite.h"

/* A call, as it stands here, what it gave and what it should give. */
typedef struct answer
{
    const char *call;
    cm_status given;
    cm_status wanted;
} answer;

#define ASK(call, status)                                                                          \
    {                                                                                              \
#call, call, status                                                                        \
    }
#define ARGUMENT(call) ASK(call, CM_ERROR_ARGUMENT)
#define RANGE(call) ASK(call, CM_ERROR_RANGE)
#define CHECK(answers) check(answers, sizeof(answers) / sizeof *(answers))

static void check(const answer *answers, size_t count)
{
    for (size_t i = 0; i < count; i++)
    {
        REQUIRE(answers[i].given == answers[i].wanted, "%s is %d, not %d", answers[i].call,
                (int)answers[i].given, (int)answers[i].wanted);
    }
}

enum
{
    WIDTH = 8,
    HEIGHT = 4,
    EDGE = 4,
    UNTOUCHED = 7
};

static const double nan_number = (double)NAN;
static const double infinite = (double)INFINITY;

/* Pictures of an equirectangular surface, and of the faces of a cube. */
typedef struct scene
{
    cm_surface *equirect;
    cm_surface *cube;
    cm_mapping *mapping;
    cm_mapping *octahedral;
    cm_plan *plan;
    cm_source *source;
    float pixels[WIDTH * HEIGHT];
    float faces[6][EDGE * EDGE];
    cm_image from;
    cm_image to[6];
} scene;

static void make_scene(scene *made)
{
    *made = (scene){.mapping = make_mapping("coupled", NULL),
                    .octahedral = make_mapping("octahedral", NULL)};
    ck_assert_int_eq(cm_surface_create("equirect;size=8", NULL, &made->equirect), CM_OK);
    ck_assert_int_eq(cm_surface_create("cube;size=4", NULL, &made->cube), CM_OK);
    made->from = (cm_image){sizeof(cm_image), made->pixels, CM_PIXEL_FLOAT, WIDTH, HEIGHT, 1, 0, 0};
    for (size_t i = 0; i < 6; i++)
    {
        made->to[i] =
            (cm_image){sizeof(cm_image), made->faces[i], CM_PIXEL_FLOAT, EDGE, EDGE, 1, 0, 0};
        made->faces[i][0] = UNTOUCHED;
    }
    ck_assert_int_eq(cm_plan_create(made->equirect, made->cube, NULL, &made->plan), CM_OK);
    ck_assert_int_eq(cm_source_create(made->plan, &made->from, CM_PIXEL_FLOAT, 1, &made->source),
                     CM_OK);
}

static void free_scene(scene *made)
{
    for (size_t i = 0; i < 6; i++)
    {
        ck_assert(made->faces[i][0] == (float)UNTOUCHED);
    }
    cm_source_destroy(made->source);
    cm_plan_destroy(made->plan);
    cm_surface_destroy(made->equirect);
    cm_surface_destroy(made->cube);
    cm_mapping_destroy(made->mapping);
    cm_mapping_destroy(made->octahedral);
}

/* ---- pictures that are none ---- */

/* As an image, but for one fault; the last number is that of the faults. */
static cm_image faulty(const cm_image *image, int fault)
{
    cm_image bad = *image;
    bad.size = fault == 0 ? sizeof bad - 1 : bad.size;
    bad.data = fault == 1 ? NULL : bad.data;
    bad.type = fault == 2 ? (cm_pixel_type)4 : fault == 3 ? (cm_pixel_type)-1 : bad.type;
    bad.channels = fault == 4 ? 0 : fault == 5 ? CM_CHANNELS_MAX + 1 : bad.channels;
    bad.width = fault == 6 ? 0 : fault == 7 ? UINT32_MAX : bad.width;
    bad.height = fault == 8 ? 0 : fault == 9 ? UINT32_MAX : bad.height;
    return bad;
}

enum
{
    FAULTS = 10
};

/* A picture that is none is CM_ERROR_ARGUMENT, one of another size CM_ERROR_RANGE: each call says one of the two. */
static void check_bad_picture(const char *call, int fault, cm_status status)
{
    REQUIRE(status == CM_ERROR_ARGUMENT || status == CM_ERROR_RANGE, "%s with fault %d is %d", call,
            fault, (int)status);
}
#define BAD_PICTURE(call) check_bad_picture(#call, fault, call)

START_TEST(pictures)
{
    scene s;
    make_scene(&s);
    const double x = 1.0, y = 0.0, z = 0.0;
    float value = UNTOUCHED;
    cm_source *source = NULL;
    cm_mips *mips = NULL;
    cm_environment *environment = NULL;
    cm_error_figures figures = {.size = sizeof figures, .pixels = UNTOUCHED};
    cm_map_figures map_figures = {.size = sizeof map_figures, .pixels = UNTOUCHED};
    for (int fault = 0; fault < FAULTS; fault++)
    {
        const cm_image bad = faulty(&s.from, fault);
        cm_image faces[6];
        memcpy(faces, s.to, sizeof faces);
        faces[5] = faulty(&faces[5], fault);
        BAD_PICTURE(cm_source_create(s.plan, &bad, CM_PIXEL_FLOAT, 1, &source));
        BAD_PICTURE(cm_resample(s.plan, &bad, s.to, (cm_rows){0}));
        BAD_PICTURE(cm_resample(s.plan, &s.from, faces, (cm_rows){0}));
        BAD_PICTURE(cm_resample_source(s.plan, s.source, faces, (cm_rows){0}, 1));
        BAD_PICTURE(cm_sample(s.equirect, &bad, CM_FILTER_NEAREST, 1, &x, &y, &z, &value));
        BAD_PICTURE(cm_mips_create(s.cube, faces, NULL, 1, &mips));
        BAD_PICTURE(cm_border(s.equirect, &bad, 1, NULL, 1, s.to));
        BAD_PICTURE(cm_compare_errors(&bad, &s.from, NULL, &figures));
        BAD_PICTURE(cm_compare_errors(&s.from, &bad, NULL, &figures));
        BAD_PICTURE(cm_ssim(&s.from, &bad, NULL, &map_figures, NULL, NULL));
        BAD_PICTURE(cm_flip(&s.from, &bad, NULL, &map_figures, NULL));
        BAD_PICTURE(cm_flip_hdr(&s.from, &bad, NULL, &map_figures, NULL));
        BAD_PICTURE(cm_difference_map(&s.from, &bad, 1, &s.to[0]));
        BAD_PICTURE(cm_environment_create(s.mapping, faces, 1, &environment));
        BAD_PICTURE(cm_brdf_table(CM_BRDF_SCHLICK, 1, &bad));
    }
    ck_assert(value == (float)UNTOUCHED && source == NULL && mips == NULL && environment == NULL);
    ck_assert(figures.pixels == UNTOUCHED && map_figures.pixels == UNTOUCHED);
    free_scene(&s);
}
END_TEST

/* ---- image.h ---- */

START_TEST(surfaces)
{
    cm_surface *surface = NULL;
    uint32_t picture = UNTOUCHED, column = UNTOUCHED, row = UNTOUCHED;
    cm_surface_options options = {.size = sizeof options - 1, .width = 8};
    const cm_rotation skew = {{{1, 1, 0}, {0, 1, 0}, {0, 0, 1}}};
    const cm_rotation nothing = {{{(double)NAN, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    const cm_surface_options skewed = {.size = sizeof options, .width = 8, .rotation = &skew};
    const cm_surface_options none = {.size = sizeof options, .width = 8, .rotation = &nothing};
    const cm_surface_options set = {.size = sizeof options, .width = 8, .instructions = "none"};
    scene s;
    make_scene(&s);
    const answer answers[] = {
        ARGUMENT(cm_surface_create(NULL, NULL, &surface)),
        ARGUMENT(cm_surface_create("equirect;size=8", NULL, NULL)),
        ARGUMENT(cm_surface_create("equirect", &options, &surface)),
        ARGUMENT(cm_surface_check("equirect", &options, NULL, 0)),
        ARGUMENT(cm_surface_check(NULL, NULL, NULL, 0)),
        ASK(cm_surface_create("equirect", &skewed, &surface), CM_ERROR_ORIENTATION),
        ASK(cm_surface_create("equirect", &none, &surface), CM_ERROR_ORIENTATION),
        ASK(cm_surface_create("equirect", &set, &surface), CM_ERROR_INSTRUCTIONS),
        RANGE(cm_surface_pixel(s.cube, 6, 0, 0, &picture, &column, &row)),
        RANGE(cm_surface_pixel(s.cube, 0, EDGE, 0, &picture, &column, &row)),
        RANGE(cm_surface_pixel(s.cube, 0, 0, UINT32_MAX, &picture, &column, &row)),
        ASK(cm_surface_check("equirect", NULL, NULL, 0), CM_OK),
    };
    CHECK(answers);
    ck_assert(surface == NULL && picture == UNTOUCHED && column == UNTOUCHED && row == UNTOUCHED);
    ck_assert_ptr_null(cm_surface_kind_at(cm_surface_kind_count()));
    ck_assert_ptr_null(cm_surface_kind_at(SIZE_MAX));
    ck_assert_ptr_null(cm_surface_preset_at(cm_surface_preset_count()));
    ck_assert_ptr_null(cm_surface_preset_find(NULL));
    ck_assert_ptr_null(cm_surface_preset_find(""));
    ck_assert_ptr_null(cm_filter_name((cm_filter)-1));
    ck_assert_ptr_null(cm_filter_name((cm_filter)(CM_FILTER_EWA + 1)));
    ck_assert_uint_eq(cm_pixel_size((cm_pixel_type)-1), 0);
    ck_assert_uint_eq(cm_pixel_size((cm_pixel_type)(CM_PIXEL_FLOAT + 1)), 0);
    cm_surface_destroy(NULL);
    free_scene(&s);
}
END_TEST

START_TEST(directions_that_are_none)
{
    scene s;
    make_scene(&s);
    const double bad[4][3] = {
        {0, 0, 0}, {nan_number, 0, 1}, {0, infinite, 0}, {infinite, infinite, -infinite}};
    for (size_t i = 0; i < 4; i++)
    {
        const double *d = bad[i];
        uint8_t plane = UNTOUCHED;
        double column = 0.0, row = 0.0;
        float value = UNTOUCHED;
        cm_surface_positions(s.equirect, 1, &d[0], &d[1], &d[2], &plane, &column, &row);
        REQUIRE(plane == CM_NO_FACE && isnan(column) && isnan(row), "%zu", i);
        ck_assert_int_eq(
            cm_sample(s.equirect, &s.from, CM_FILTER_BILINEAR, 1, &d[0], &d[1], &d[2], &value),
            CM_OK);
        ck_assert(value == 0.0f);
    }
    const double places[4][2] = {
        {nan_number, 1.0}, {1.0, nan_number}, {-1.0, 1.0}, {WIDTH + 1.0, 1.0}};
    for (size_t i = 0; i < 5; i++)
    {
        const uint8_t plane = i < 4 ? 0 : 1;
        const double *at = places[i % 4];
        double d[3] = {0.0, 0.0, 0.0};
        cm_surface_directions(s.equirect, 1, &plane, &at[0], &at[1], &d[0], &d[1], &d[2]);
        REQUIRE(isnan(d[0]) && isnan(d[1]) && isnan(d[2]), "%zu", i);
    }
    free_scene(&s);
}
END_TEST

START_TEST(lists_of_pixels)
{
    float one[12] = {0.0F};
    float other[12] = {UNTOUCHED};
    const answer answers[] = {
        ARGUMENT(cm_healpix_arrange(1, CM_HEALPIX_RING, 0, 4, NULL, other)),
        ARGUMENT(cm_healpix_arrange(1, CM_HEALPIX_RING, 0, 4, one, NULL)),
        ARGUMENT(cm_healpix_arrange(1, CM_HEALPIX_RING, 0, 0, one, other)),
        ASK(cm_healpix_arrange(-1, CM_HEALPIX_RING, 0, 4, one, other), CM_ERROR_PIXEL),
        ASK(cm_healpix_arrange(3, CM_HEALPIX_NESTED, 0, 4, one, other), CM_ERROR_PIXEL),
        RANGE(cm_healpix_arrange(1, CM_HEALPIX_RING, 0, SIZE_MAX / 2, one, other)),
    };
    CHECK(answers);
    ck_assert(other[0] == (float)UNTOUCHED);
}
END_TEST

/* Options of a plan with one fault each. */
START_TEST(options_of_plans)
{
    scene s;
    make_scene(&s);
    const size_t size = sizeof(cm_plan_options);
    const struct
    {
        const char *what;
        cm_plan_options options;
        cm_status status;
    } bad[] = {
        {"size", {.size = size - 1}, CM_ERROR_ARGUMENT},
        {"filter", {.size = size, .filter = (cm_filter)(CM_FILTER_EWA + 1)}, CM_ERROR_RANGE},
        {"filter", {.size = size, .filter = (cm_filter)-1}, CM_ERROR_RANGE},
        {"tolerance", {.size = size, .tolerance = nan_number}, CM_ERROR_RANGE},
        {"tolerance", {.size = size, .tolerance = infinite}, CM_ERROR_RANGE},
        {"pixels_most", {.size = size, .pixels_most = nan_number}, CM_ERROR_RANGE},
        {"pixels_most", {.size = size, .pixels_most = -1.0}, CM_ERROR_RANGE},
        {"transfer", {.size = size, .transfer = (cm_transfer)3}, CM_ERROR_RANGE},
        {"gamma", {.size = size, .transfer = CM_TRANSFER_GAMMA}, CM_ERROR_RANGE},
        {"gamma",
         {.size = size, .transfer = CM_TRANSFER_GAMMA, .gamma = nan_number},
         CM_ERROR_RANGE},
        {"gamma", {.size = size, .transfer = CM_TRANSFER_GAMMA, .gamma = -2.2}, CM_ERROR_RANGE},
        {"alpha", {.size = size, .alpha = CM_CHANNELS_MAX + 1}, CM_ERROR_RANGE},
        {"vector", {.size = size, .vector = CM_CHANNELS_MAX - 1}, CM_ERROR_RANGE},
        {"vector", {.size = size, .vector = UINT32_MAX}, CM_ERROR_RANGE},
        {"not_finite", {.size = size, .not_finite = (cm_not_finite)3}, CM_ERROR_RANGE},
        {"instructions", {.size = size, .instructions = "none"}, CM_ERROR_INSTRUCTIONS},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
    {
        cm_plan *plan = NULL;
        const cm_status status = cm_plan_create(s.equirect, s.cube, &bad[i].options, &plan);
        REQUIRE(status == bad[i].status && plan == NULL, "%zu, %s: %d", i, bad[i].what,
                (int)status);
    }
    free_scene(&s);
}
END_TEST

START_TEST(plans_and_sources)
{
    scene s;
    make_scene(&s);
    cm_plan *plan = NULL;
    cm_source *source = NULL;
    size_t length = UNTOUCHED;
    char text[8] = "text";
    const double x = 1.0, y = 0.0, z = 0.0;
    float value = UNTOUCHED;
    const cm_image *from = &s.from;
    const answer answers[] = {
        ARGUMENT(cm_plan_create(NULL, s.cube, NULL, &plan)),
        ARGUMENT(cm_plan_create(s.equirect, NULL, NULL, &plan)),
        ARGUMENT(cm_plan_create(s.equirect, s.cube, NULL, NULL)),
        ARGUMENT(cm_plan_write(NULL, text, sizeof text, &length)),
        ARGUMENT(cm_plan_write(s.plan, NULL, 1, &length)),
        ARGUMENT(cm_plan_read(NULL, 0, NULL, &plan)),
        ARGUMENT(cm_plan_read("cubemap-plan", 12, NULL, NULL)),
        ASK(cm_plan_read("", 0, NULL, &plan), CM_ERROR_SYNTAX),
        ASK(cm_plan_read("\0\0\0", 3, NULL, &plan), CM_ERROR_SYNTAX),
        ARGUMENT(cm_source_create(NULL, from, CM_PIXEL_FLOAT, 1, &source)),
        ARGUMENT(cm_source_create(s.plan, NULL, CM_PIXEL_FLOAT, 1, &source)),
        ARGUMENT(cm_source_create(s.plan, from, CM_PIXEL_FLOAT, 1, NULL)),
        ARGUMENT(cm_source_create(s.plan, from, (cm_pixel_type)4, 1, &source)),
        ARGUMENT(cm_resample_source(NULL, s.source, s.to, (cm_rows){0}, 1)),
        ARGUMENT(cm_resample_source(s.plan, NULL, s.to, (cm_rows){0}, 1)),
        ARGUMENT(cm_resample_source(s.plan, s.source, NULL, (cm_rows){0}, 1)),
        RANGE(cm_resample_source(s.plan, s.source, s.to, (cm_rows){.plane = 6, .row_count = 1}, 1)),
        RANGE(cm_resample_source(s.plan, s.source, s.to,
                                 (cm_rows){.first_row = 1, .row_count = UINT32_MAX}, 1)),
        RANGE(cm_resample_source(
            s.plan, s.source, s.to,
            (cm_rows){.row_count = 1, .first_column = UINT32_MAX, .column_count = UINT32_MAX}, 1)),
        ARGUMENT(cm_resample(NULL, from, s.to, (cm_rows){0})),
        ARGUMENT(cm_resample(s.plan, NULL, s.to, (cm_rows){0})),
        ARGUMENT(cm_resample(s.plan, from, NULL, (cm_rows){0})),
        ARGUMENT(cm_sample(NULL, from, CM_FILTER_NEAREST, 1, &x, &y, &z, &value)),
        ARGUMENT(cm_sample(s.equirect, NULL, CM_FILTER_NEAREST, 1, &x, &y, &z, &value)),
        ARGUMENT(cm_sample(s.equirect, from, CM_FILTER_NEAREST, 1, NULL, &y, &z, &value)),
        ARGUMENT(cm_sample(s.equirect, from, CM_FILTER_NEAREST, 1, &x, NULL, &z, &value)),
        ARGUMENT(cm_sample(s.equirect, from, CM_FILTER_NEAREST, 1, &x, &y, NULL, &value)),
        ARGUMENT(cm_sample(s.equirect, from, CM_FILTER_NEAREST, 1, &x, &y, &z, NULL)),
        ARGUMENT(cm_sample(s.equirect, from, CM_FILTER_EWA, 1, &x, &y, &z, &value)),
        RANGE(cm_sample(s.equirect, from, (cm_filter)99, 1, &x, &y, &z, &value)),
    };
    CHECK(answers);
    ck_assert(plan == NULL && source == NULL && value == (float)UNTOUCHED);
    cm_plan_destroy(NULL);
    cm_source_destroy(NULL);
    free_scene(&s);
}
END_TEST

/* ---- mips.h ---- */

START_TEST(levels_and_borders)
{
    scene s;
    make_scene(&s);
    cm_mips *mips = NULL;
    const cm_plan_options size = {.size = 1};
    const cm_plan_options gamma = {
        .size = sizeof gamma, .transfer = CM_TRANSFER_GAMMA, .gamma = nan_number};
    const cm_plan_options set = {.size = sizeof set, .instructions = "none"};
    const answer answers[] = {
        ARGUMENT(cm_mips_create(NULL, s.to, NULL, 1, &mips)),
        ARGUMENT(cm_mips_create(s.cube, NULL, NULL, 1, &mips)),
        ARGUMENT(cm_mips_create(s.cube, s.to, NULL, 1, NULL)),
        ARGUMENT(cm_mips_create(s.cube, s.to, &size, 1, &mips)),
        RANGE(cm_mips_create(s.cube, s.to, &gamma, 1, &mips)),
        ASK(cm_mips_create(s.cube, s.to, &set, 1, &mips), CM_ERROR_INSTRUCTIONS),
        ARGUMENT(cm_border(NULL, s.to, 1, NULL, 1, s.to)),
        ARGUMENT(cm_border(s.cube, NULL, 1, NULL, 1, s.to)),
        ARGUMENT(cm_border(s.cube, s.to, 1, NULL, 1, NULL)),
        ARGUMENT(cm_border(s.cube, s.to, 1, &size, 1, s.to)),
        RANGE(cm_border(s.cube, s.to, 1, &gamma, 1, s.to)),
        RANGE(cm_border(s.cube, s.to, CM_BORDER_MOST + 1, NULL, 1, s.to)),
        RANGE(cm_border(s.cube, s.to, UINT32_MAX, NULL, 1, s.to)),
        RANGE(cm_border(s.cube, s.to, 1, NULL, 1, s.to)), /* pictures for another border */
    };
    CHECK(answers);
    ck_assert_ptr_null(mips);
    ck_assert_int_eq(cm_mips_create(s.cube, s.to, NULL, 1, &mips), CM_OK);
    ck_assert_ptr_null(cm_mips_pictures(mips, cm_mips_count(mips)));
    ck_assert_ptr_null(cm_mips_pictures(mips, UINT32_MAX));
    cm_mips_destroy(mips);
    cm_mips_destroy(NULL);
    free_scene(&s);
}
END_TEST

/* ---- panorama.h ---- */

static cm_status check_panorama(cm_panorama panorama)
{
    panorama.size = sizeof panorama;
    return cm_panorama_check(&panorama);
}

START_TEST(panoramas)
{
    scene s;
    make_scene(&s);
    const cm_panorama good = {sizeof good, 8, 4, 2, 1, 4, 2, 0.0, 0.0, 0.0};
    cm_panorama panorama = {.size = sizeof panorama, .full_width = UNTOUCHED};
    cm_panorama old = good;
    char text[2048] = "text";
    cm_rotation rotation;
    old.size = 8;
#define PANORAMA(...) check_panorama((cm_panorama){0, __VA_ARGS__})
    const answer answers[] = {
        ASK(cm_panorama_check(&good), CM_OK),
        ARGUMENT(cm_panorama_check(NULL)),
        ARGUMENT(cm_panorama_check(&old)),
        RANGE(PANORAMA(8, 0, 0, 0, 0, 0, 0.0, 0.0, 0.0)),
        RANGE(PANORAMA(0, 4, 0, 0, 0, 0, 0.0, 0.0, 0.0)),
        RANGE(PANORAMA(8, 4, 5, 0, 4, 4, 0.0, 0.0, 0.0)),
        RANGE(PANORAMA(8, 4, UINT32_MAX, 0, 4, 4, 0.0, 0.0, 0.0)),
        RANGE(PANORAMA(8, 4, 0, 1, 8, 4, 0.0, 0.0, 0.0)),
        RANGE(PANORAMA(8, 4, 0, 0, 0, 4, 0.0, 0.0, 0.0)),
        RANGE(PANORAMA(UINT32_MAX, UINT32_MAX, 0, 0, 8, 4, 0.0, 0.0, 0.0)),
        RANGE(PANORAMA(8, 4, 0, 0, 8, 4, 360.0, 0.0, 0.0)),
        RANGE(PANORAMA(8, 4, 0, 0, 8, 4, -1.0, 0.0, 0.0)),
        RANGE(PANORAMA(8, 4, 0, 0, 8, 4, infinite, 0.0, 0.0)),
        RANGE(PANORAMA(8, 4, 0, 0, 8, 4, 0.0, nan_number, 0.0)),
        RANGE(PANORAMA(8, 4, 0, 0, 8, 4, 0.0, 90.5, 0.0)),
        RANGE(PANORAMA(8, 4, 0, 0, 8, 4, 0.0, 0.0, nan_number)),
        RANGE(PANORAMA(8, 4, 0, 0, 8, 4, 0.0, 0.0, -180.0)),
        ARGUMENT(cm_panorama_read(NULL, 4, &panorama)),
        ARGUMENT(cm_panorama_read("text", 4, NULL)),
        ARGUMENT(cm_panorama_read("text", 4, &old)),
        ASK(cm_panorama_read("", 0, &panorama), CM_ERROR_UNSUPPORTED),
        ARGUMENT(cm_panorama_write(NULL, text, sizeof text)),
        ARGUMENT(cm_panorama_write(&good, NULL, sizeof text)),
        ARGUMENT(cm_panorama_write(&old, text, sizeof text)),
        ASK(cm_panorama_write(&good, text, 0), CM_ERROR_SPACE),
        ARGUMENT(cm_panorama_surface(NULL, 4, 2, text, sizeof text, &rotation)),
        ARGUMENT(cm_panorama_surface(&good, 4, 2, NULL, sizeof text, &rotation)),
        RANGE(cm_panorama_surface(&good, 0, 2, text, sizeof text, &rotation)),
        RANGE(cm_panorama_surface(&good, 4, 0, text, sizeof text, &rotation)),
        ASK(cm_panorama_surface(&good, 4, 2, text, 0, &rotation), CM_ERROR_SPACE),
        ARGUMENT(cm_panorama_of_surface(NULL, &panorama)),
        ARGUMENT(cm_panorama_of_surface(s.equirect, NULL)),
        ARGUMENT(cm_panorama_of_surface(s.equirect, &old)),
        ASK(cm_panorama_of_surface(s.cube, &panorama), CM_ERROR_UNSUPPORTED),
    };
#undef PANORAMA
    CHECK(answers);
    ck_assert_str_eq(text, "text");
    ck_assert_uint_eq(panorama.full_width, UNTOUCHED);
    free_scene(&s);
}
END_TEST

/* ---- compare.h ---- */

START_TEST(options_of_comparisons)
{
    scene s;
    make_scene(&s);
    const size_t size = sizeof(cm_compare_options);
    float weight[WIDTH * HEIGHT] = {1.0F, -1.0F};
    cm_image weights = s.from;
    cm_image narrow = s.from;
    weights.data = weight;
    narrow.width = 2;
    const cm_compare_options bad[] = {
        {.size = size - 1},
        {.size = size, .not_finite = (cm_compare_not_finite)3},
        {.size = size, .peak = nan_number},
        {.size = size, .peak = -1.0},
        {.size = size, .peak = 1e200},
        {.size = size, .pixels_per_degree = nan_number},
        {.size = size, .pixels_per_degree = 1e6},
        {.size = size, .exposure_start = nan_number},
        {.size = size, .exposure_start = 1.0, .exposure_stop = 0.0},
        {.size = size, .exposure_count = CM_FLIP_EXPOSURES_MAX + 1},
        {.size = size, .weights = &weights},
        {.size = size, .weights = &narrow},
        {.size = size, .weights = &s.to[0]},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
    {
        const cm_status wanted = i < 10 ? CM_ERROR_ARGUMENT : CM_ERROR_RANGE;
        cm_error_figures errors = {.size = sizeof errors, .pixels = UNTOUCHED};
        cm_map_figures map = {.size = sizeof map, .pixels = UNTOUCHED};
        const answer answers[] = {
            ASK(cm_compare_errors(&s.from, &s.from, &bad[i], &errors), wanted),
            ASK(cm_ssim(&s.from, &s.from, &bad[i], &map, NULL, NULL), wanted),
            ASK(cm_flip(&s.from, &s.from, &bad[i], &map, NULL), wanted),
            ASK(cm_flip_hdr(&s.from, &s.from, &bad[i], &map, NULL), wanted),
        };
        CHECK(answers);
        ck_assert(errors.pixels == UNTOUCHED && map.pixels == UNTOUCHED);
    }
    free_scene(&s);
}
END_TEST

static void no_color(double t, double color[3], void *user)
{
    (void)user;
    color[0] = color[1] = color[2] = t;
}

START_TEST(comparisons)
{
    scene s;
    make_scene(&s);
    const cm_image *one = &s.from;
    const cm_compare_options bordered = {.size = sizeof bordered, .border = 1};
    cm_error_figures figures = {.size = sizeof figures, .pixels = UNTOUCHED};
    cm_error_figures old = {.size = 8};
    cm_map_figures old_map = {.size = 8};
    cm_errors *errors = NULL, *made = NULL;
    float values[4] = {UNTOUCHED};
    float drawn[3 * WIDTH * HEIGHT] = {UNTOUCHED};
    const cm_image color = {sizeof color, drawn, CM_PIXEL_FLOAT, WIDTH, HEIGHT, 3, 0, 0};
    double point[1] = {UNTOUCHED};
    ck_assert_int_eq(cm_errors_create(1, NULL, &made), CM_OK);
    const answer answers[] = {
        ARGUMENT(cm_compare_errors(NULL, one, NULL, &figures)),
        ARGUMENT(cm_compare_errors(one, NULL, NULL, &figures)),
        ARGUMENT(cm_compare_errors(one, one, NULL, NULL)),
        ARGUMENT(cm_compare_errors(one, one, NULL, &old)),
        RANGE(cm_compare_errors(one, &s.to[0], NULL, &figures)),
        ARGUMENT(cm_compare_values(1, 1, NULL, values, NULL, &figures)),
        ARGUMENT(cm_compare_values(1, 1, values, NULL, NULL, &figures)),
        ARGUMENT(cm_compare_values(1, 1, values, values, NULL, NULL)),
        ARGUMENT(cm_compare_values(0, 1, values, values, NULL, &figures)),
        ARGUMENT(cm_compare_values(1, 0, values, values, NULL, &figures)),
        ARGUMENT(cm_compare_values(1, CM_CHANNELS_MAX + 1, values, values, NULL, &figures)),
        ARGUMENT(cm_compare_values((size_t)UINT32_MAX + 1, 1, values, values, NULL, &figures)),
        ARGUMENT(cm_errors_create(0, NULL, &errors)),
        ARGUMENT(cm_errors_create(CM_CHANNELS_MAX + 1, NULL, &errors)),
        ARGUMENT(cm_errors_create(1, NULL, NULL)),
        ARGUMENT(cm_errors_create(1, &bordered, &errors)),
        ARGUMENT(cm_errors_add(NULL, one, one, NULL)),
        ARGUMENT(cm_errors_add(made, NULL, one, NULL)),
        ARGUMENT(cm_errors_add(made, one, NULL, NULL)),
        RANGE(cm_errors_add(made, one, &s.to[0], NULL)),
        ARGUMENT(cm_errors_get(NULL, 0, &figures)),
        ARGUMENT(cm_errors_get(made, 0, NULL)),
        ARGUMENT(cm_errors_get(made, 0, &old)),
        ARGUMENT(cm_errors_get(made, 1, &figures)),
        ARGUMENT(cm_ssim(NULL, one, NULL, NULL, NULL, NULL)),
        ARGUMENT(cm_ssim(one, one, NULL, &old_map, NULL, NULL)),
        RANGE(cm_ssim(one, one, NULL, NULL, &s.to[0], NULL)),
        ARGUMENT(cm_flip(one, NULL, NULL, NULL, NULL)),
        ARGUMENT(cm_flip(one, one, NULL, &old_map, NULL)),
        RANGE(cm_flip(one, one, NULL, NULL, &s.to[0])),
        ARGUMENT(cm_flip_hdr(NULL, one, NULL, NULL, NULL)),
        RANGE(cm_flip_hdr(one, one, NULL, NULL, &s.to[0])),
        ARGUMENT(cm_equirect_weights(0, 1, values)),
        ARGUMENT(cm_equirect_weights(1, 0, values)),
        ARGUMENT(cm_equirect_weights(1, 1, NULL)),
        ARGUMENT(cm_face_weights(NULL, 0, 1, 1, values)),
        ARGUMENT(cm_face_weights(s.mapping, 6, 1, 1, values)),
        ARGUMENT(cm_face_weights(s.octahedral, 1, 1, 1, values)),
        ARGUMENT(cm_face_weights(s.mapping, 0, 0, 1, values)),
        ARGUMENT(cm_face_weights(s.mapping, 0, 1, 1, NULL)),
        ARGUMENT(cm_sphere_points(1, 0, 1, NULL, point, point)),
        ARGUMENT(cm_sphere_points(1, 0, 1, point, NULL, point)),
        ARGUMENT(cm_sphere_points(1, 0, 1, point, point, NULL)),
        ARGUMENT(cm_sphere_points(1, 1, 1, point, point, point)),
        ARGUMENT(cm_sphere_points(1, 0, 2, point, point, point)),
        ARGUMENT(cm_sphere_points(1, UINT64_MAX, 2, point, point, point)),
        ARGUMENT(cm_difference_map(NULL, one, 1, one)),
        ARGUMENT(cm_difference_map(one, NULL, 1, one)),
        ARGUMENT(cm_difference_map(one, one, 1, NULL)),
        RANGE(cm_difference_map(one, one, 1, &s.to[0])),
        ARGUMENT(cm_draw_map(NULL, 0.0, 1.0, no_color, NULL, &color, NULL)),
        ARGUMENT(cm_draw_map(one, 0.0, 1.0, NULL, NULL, &color, NULL)),
        ARGUMENT(cm_draw_map(one, 0.0, 1.0, no_color, NULL, NULL, NULL)),
        ARGUMENT(cm_draw_map(one, 1.0, 1.0, no_color, NULL, &color, NULL)),
        ARGUMENT(cm_draw_map(one, nan_number, 1.0, no_color, NULL, &color, NULL)),
        ARGUMENT(cm_draw_map(one, 0.0, infinite, no_color, NULL, &color, NULL)),
        RANGE(cm_draw_map(one, 0.0, 1.0, no_color, NULL, one, NULL)),
        RANGE(cm_draw_map(&s.to[0], 0.0, 1.0, no_color, NULL, &color, NULL)),
    };
    CHECK(answers);
    ck_assert(figures.pixels == UNTOUCHED && errors == NULL && values[0] == (float)UNTOUCHED);
    ck_assert(point[0] == UNTOUCHED && drawn[0] == (float)UNTOUCHED);
    ck_assert(isnan(cm_psnr(nan_number, 1.0)) && isinf(cm_psnr(0.0, 1.0)));
    cm_errors_destroy(made);
    cm_errors_destroy(NULL);
    free_scene(&s);
}
END_TEST

/* ---- environment.h: what is not in test_harmonics.c and test_environment.c ---- */

START_TEST(environments)
{
    scene s;
    make_scene(&s);
    cm_environment *environment = NULL;
    double value[4] = {UNTOUCHED};
    double one[4] = {1.0};
    size_t length = UNTOUCHED;
    cm_brdf_terms terms = {UNTOUCHED, UNTOUCHED};
    cm_rotation rotation = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    cm_image large = s.to[0];
    const uint32_t above = CM_HARMONICS_DEGREE_MAX + 1;
    large.width = large.height = CM_ENVIRONMENT_SIZE_MAX + 1;
    const cm_image faces[6] = {large, large, large, large, large, large};
    ck_assert_int_eq(cm_environment_create(s.mapping, s.to, 1, &environment), CM_OK);
    cm_environment *none = NULL;
    const answer answers[] = {
        ARGUMENT(cm_harmonics_basis(1, 1, one, NULL, one, value)),
        ARGUMENT(cm_harmonics_basis(1, 1, one, one, NULL, value)),
        ARGUMENT(cm_harmonics_basis(1, 1, one, one, one, NULL)),
        RANGE(cm_harmonics_basis(UINT32_MAX, 1, one, one, one, value)),
        ARGUMENT(cm_harmonics_evaluate(0, 1, one, 1, NULL, one, one, value)),
        ARGUMENT(cm_harmonics_evaluate(0, 1, one, 1, one, one, one, NULL)),
        RANGE(cm_harmonics_evaluate(above, 1, one, 1, one, one, one, value)),
        RANGE(cm_harmonics_ggx_lobe(above, 0.5, value)),
        RANGE(cm_harmonics_ggx_lobe(1, infinite, value)),
        RANGE(cm_harmonics_window_factors(CM_WINDOW_HANNING, nan_number, 1, value)),
        RANGE(cm_harmonics_window_factors(CM_WINDOW_HANNING, -1.0, 1, value)),
        RANGE(cm_harmonics_window_factors(CM_WINDOW_HANNING, 1.0, above, value)),
        ARGUMENT(cm_harmonics_scale(1, 1, one, NULL)),
        RANGE(cm_harmonics_scale(above, 1, one, value)),
        ARGUMENT(cm_harmonics_rotate(0, 1, &rotation, NULL, value)),
        ARGUMENT(cm_harmonics_rotate(0, 1, &rotation, one, NULL)),
        RANGE(cm_harmonics_rotate(0, 0, &rotation, one, value)),
        ARGUMENT(cm_harmonics_json(0, 1, one, NULL, 0, NULL)),
        RANGE(cm_harmonics_json(above, 1, one, NULL, 0, &length)),
        RANGE(cm_harmonics_json(0, 0, one, NULL, 0, &length)),
        RANGE(cm_harmonics_json(0, 1, &nan_number, NULL, 0, &length)),
        ARGUMENT(cm_harmonics_faces(0, 1, one, NULL, 1, s.to)),
        ARGUMENT(cm_harmonics_faces(0, 1, one, s.mapping, 1, NULL)),
        RANGE(cm_harmonics_faces(above, 1, one, s.mapping, 1, s.to)),
        RANGE(cm_harmonics_faces(0, 2, one, s.mapping, 1, s.to)),
        ARGUMENT(cm_texel_solid_angles(s.mapping, 0, 1, NULL)),
        RANGE(cm_texel_solid_angles(s.mapping, 0, CM_ENVIRONMENT_SIZE_MAX + 1, value)),
        RANGE(cm_environment_create(s.mapping, faces, 1, &none)),
        RANGE(cm_environment_project(environment, above, 1, value)),
        ARGUMENT(cm_environment_irradiance(environment, NULL, 1, s.to)),
        ARGUMENT(cm_environment_irradiance(environment, s.mapping, 1, NULL)),
        ARGUMENT(cm_environment_prefilter(environment, 0.5, NULL, NULL, s.to)),
        ARGUMENT(cm_environment_prefilter(environment, 0.5, NULL, s.mapping, NULL)),
        RANGE(cm_brdf_integrate(CM_BRDF_CORRELATED, nan_number, 0.5, &terms)),
        RANGE(cm_brdf_integrate(CM_BRDF_CORRELATED, 0.5, nan_number, &terms)),
        RANGE(cm_brdf_integrate((cm_brdf_shadowing)-1, 0.5, 0.5, &terms)),
        RANGE(cm_brdf_table(CM_BRDF_CORRELATED, 1, &s.from)), /* one channel */
    };
    CHECK(answers);
    ck_assert(value[0] == UNTOUCHED && length == UNTOUCHED && none == NULL);
    ck_assert(terms.scale == UNTOUCHED && terms.bias == UNTOUCHED);
    ck_assert(isnan(cm_brdf_multiple(NULL, 0.5)));
    cm_environment_destroy(environment);
    free_scene(&s);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {pictures,           surfaces,         directions_that_are_none,
                                  lists_of_pixels,    options_of_plans, plans_and_sources,
                                  levels_and_borders, panoramas,        options_of_comparisons,
                                  comparisons,        environments,     NULL};
    return run_suite("bad arguments", tests);
}
