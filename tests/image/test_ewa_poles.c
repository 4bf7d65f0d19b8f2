/* SPDX-License-Identifier: MIT
 *
 * Elliptic footprints beside the poles of a source in longitude and latitude: as exact as elsewhere, and nothing aliases.
 */
#include "tests/image/round_scene.h"
#include "truth/analytic_scene.h"

#define PI 3.14159265358979323846

/* Target pixels from a pole: what is beside it, the ends of what is done around it, and what is like both. */
#define BESIDE 3.0
#define AROUND 14.0
#define LIKE 28.0
#define TARGET_MOST 1024

/* A source, a target, how it is turned, and the scene's shortest period in target pixels. */
typedef struct pole_case
{
    const char *from;
    const char *to;
    double turn[3];
    double period;
} pole_case;

static cm_surface *make_turned(const char *specification, const double turn[3])
{
    cm_surface *surface = NULL;
    cm_rotation rotation;
    const cm_surface_options options = {.size = sizeof options, .rotation = &rotation};
    ck_assert_int_eq(cm_rotation_from_angles(turn[0], turn[1], turn[2], &rotation), CM_OK);
    REQUIRE(cm_surface_create(specification, &options, &surface) == CM_OK, "%s", specification);
    return surface;
}

/* The directions of a row of a plane. */
static void row_directions(const cm_surface *surface, size_t plane, size_t row, double *d[3])
{
    static uint8_t planes[2 * TARGET_MOST];
    static double column[2 * TARGET_MOST], at[2 * TARGET_MOST];
    const uint32_t width = cm_surface_plane_width(surface);
    ck_assert_uint_le(width, 2 * TARGET_MOST);
    for (size_t i = 0; i < width; i++)
    {
        planes[i] = (uint8_t)plane;
        column[i] = (double)i + 0.5;
        at[i] = (double)row + 0.5;
    }
    cm_surface_directions(surface, width, planes, column, at, d[0], d[1], d[2]);
}

typedef void row_visitor(const cm_image *pictures, size_t plane, size_t row, double *d[3],
                         const double *values, void *user);

static void visit_rows(const cm_surface *surface, const cm_image *pictures,
                       const analytic_scene *scene, row_visitor *visit, void *user)
{
    static double x[2 * TARGET_MOST], y[2 * TARGET_MOST], z[2 * TARGET_MOST];
    static double values[2 * TARGET_MOST * SCENE_CHANNELS];
    double *d[3] = {x, y, z};
    for (size_t plane = 0; plane < cm_surface_plane_count(surface); plane++)
    {
        for (size_t row = 0; row < cm_surface_plane_height(surface); row++)
        {
            row_directions(surface, plane, row, d);
            scene_values(scene, cm_surface_plane_width(surface), x, y, z, values);
            visit(pictures, plane, row, d, values, user);
        }
    }
}

static void paint_row(const cm_image *pictures, size_t plane, size_t row, double *d[3],
                      const double *values, void *user)
{
    (void)d;
    (void)user;
    for (size_t i = 0; i < pictures->width; i++)
    {
        for (uint32_t c = 0; c < SCENE_CHANNELS; c++)
        {
            put_number(pictures, plane, i, row, c, values[SCENE_CHANNELS * i + c]);
        }
    }
}

/* ---- how far from the truth ---- */

typedef struct pole_errors
{
    double pixel;  /* of the target beside a pole, in radians */
    double flat;   /* not 0: what is there is to be this, and not the scene */
    double sum[4]; /* beside, around, like and elsewhere */
    double count[4];
} pole_errors;

static int region_at(double pixels)
{
    return pixels < BESIDE ? 0 : pixels < AROUND ? 1 : pixels < LIKE ? 2 : 3;
}

static void measure_row(const cm_image *pictures, size_t plane, size_t row, double *d[3],
                        const double *values, void *user)
{
    pole_errors *errors = user;
    for (size_t i = 0; i < pictures->width; i++)
    {
        if (errors->flat != 0.0 && d[2][i] < 0.0)
        {
            continue; /* plates have more rings around the other pole than there are pixels */
        }
        const int where = region_at(hypot(d[0][i], d[1][i]) / errors->pixel);
        for (uint32_t c = 0; c < SCENE_CHANNELS; c++)
        {
            const double wanted =
                errors->flat != 0.0 ? errors->flat : values[SCENE_CHANNELS * i + c];
            const double off = number_at(pictures, plane, i, row, c) - wanted;
            errors->sum[where] += off * off;
            errors->count[where]++;
        }
    }
}

static double decibels(const pole_errors *errors, int where)
{
    return -10.0 * log10(errors->sum[where] / errors->count[where]);
}

/* Of a target pixel: a face has the most in its middle. */
static double pixel_of(const cm_surface *to)
{
    const double width = cm_surface_plane_width(to);
    return cm_surface_plane_count(to) == 6 ? 2.0 / width : 2.0 * PI / width;
}

static pole_errors errors_of(const pole_case *one, cm_pixel_type type, const analytic_scene *scene,
                             double flat)
{
    static const double straight[3] = {0.0, 0.0, 0.0};
    cm_surface *from = make_turned(one->from, straight), *to = make_turned(one->to, one->turn);
    cm_image source[PICTURES_MOST], target[PICTURES_MOST];
    pole_errors errors = {.pixel = pixel_of(to), .flat = flat};
    make_pictures(from, type, SCENE_CHANNELS, source);
    make_pictures(to, type, SCENE_CHANNELS, target);
    visit_rows(from, source, scene, paint_row, NULL);
    cm_plan *plan = make_plan(from, to, CM_FILTER_EWA);
    ck_assert_int_eq(cm_resample(plan, source, target, (cm_rows){0}), CM_OK);
    visit_rows(to, target, scene, measure_row, &errors);
    cm_plan_destroy(plan);
    free_pictures(from, source);
    free_pictures(to, target);
    cm_surface_destroy(from);
    cm_surface_destroy(to);
    return errors;
}

/* ---- tests ---- */

static const pole_case cases[] = {
    /* 1:1, 2:1 and 4:1; of columns that are denser than rows; a corner of faces, and pixels whose centre is a pole */
    {"equirect;size=512", "cube:gnomonic;size=128", {0.0, 0.0, 0.0}, 10.0},
    {"equirect;size=512", "cube:coupled;size=65", {10.0, 20.0, 30.0}, 10.0},
    {"equirect;size=1024", "cube:gnomonic;size=65", {0.0, 0.0, 0.0}, 10.0},
    {"equirect;size=2048;height=200", "cube:gnomonic;size=100", {0.0, 0.0, 0.0}, 10.0},
    {"equirect;size=512", "equirect;size=512", {20.0, 50.0, 30.0}, 10.0},
    {"equirect;size=512", "equirect;size=256", {20.0, 50.0, 30.0}, 10.0},
    {"equirect;size=1024", "equirect;size=256", {20.0, 50.0, 30.0}, 10.0},
    {"equirect;size=512", "cube:coupled;size=100", {45.0, 35.264389682754654, 0.0}, 10.0},
};

START_TEST(poles_are_as_exact_as_the_inside)
{
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
    {
        for (int is_float = 0; is_float < 2; is_float++)
        {
            static const double straight[3] = {0.0, 0.0, 0.0};
            cm_surface *to = make_turned(cases[i].to, straight);
            const analytic_scene scene = scene_waves(cases[i].period * pixel_of(to), 5);
            const pole_errors errors =
                errors_of(&cases[i], is_float ? CM_PIXEL_FLOAT : CM_PIXEL_U8, &scene, 0.0);
            const double inside = decibels(&errors, 3);
            /* few pixels have by chance more of rounding: two standard deviations of a sum of squares */
            const double chance = is_float ? 0.0 : 8.7 * sqrt(2.0 / errors.count[0]);
            REQUIRE(decibels(&errors, 0) > inside - 1.0 - chance,
                    "%s -> %s, %s: %.1f dB beside a pole, %.1f inside", cases[i].from, cases[i].to,
                    is_float ? "float" : "u8", decibels(&errors, 0), inside);
            REQUIRE(decibels(&errors, 1) > fmin(decibels(&errors, 2), inside) - 1.0,
                    "%s -> %s, %s: %.1f dB around a pole, %.1f further on", cases[i].from,
                    cases[i].to, is_float ? "float" : "u8", decibels(&errors, 1),
                    decibels(&errors, 2));
            cm_surface_destroy(to);
        }
    }
}
END_TEST

/* One wave of so many cycles a radian that goes across the poles, of other phases in other channels. */
static analytic_scene wave_across(double cycles)
{
    analytic_scene scene = {0};
    scene.wave[0] = (scene_wave){.k = {0.8 * cycles, 0.6 * cycles, 0.0},
                                 .cosine = {SCENE_AMPLITUDE, 0.0, 0.6 * SCENE_AMPLITUDE},
                                 .sine = {0.0, SCENE_AMPLITUDE, 0.8 * SCENE_AMPLITUDE}};
    return scene;
}

/* Waves of 2.5 cycles a target pixel across the poles, and rings around one, of one cycle and more from BESIDE on. */
START_TEST(detail_beside_poles_vanishes)
{
    static const char *const targets[] = {"cube:gnomonic;size=32", "cube:gnomonic;size=27",
                                          "cube:gnomonic;size=45"};
    for (size_t i = 0; i < sizeof targets / sizeof *targets; i++)
    {
        static const double pole[3] = {0.0, 0.0, 1.0};
        const pole_case one = {"equirect;size=1024", targets[i], {0.0, 0.0, 0.0}, 0.4};
        cm_surface *to = make_turned(one.to, one.turn);
        const double pixel = pixel_of(to);
        const double most = 50.0 - 20.0 * log10(SCENE_AMPLITUDE);
        const analytic_scene wave = wave_across(1.0 / (one.period * pixel));
        const pole_errors waves = errors_of(&one, CM_PIXEL_FLOAT, &wave, SCENE_MEAN);
        REQUIRE(decibels(&waves, 0) >= most, "%s: %.1f dB of waves, not %.1f", one.to,
                decibels(&waves, 0), most);
        /* a smaller pixel would have more rings at AROUND than the source's rows show */
        if (i < 2)
        {
            const analytic_scene plate = scene_zone_plate(pole, 0.0, 0.35 / (pixel * pixel));
            const pole_errors rings = errors_of(&one, CM_PIXEL_FLOAT, &plate, SCENE_MEAN);
            REQUIRE(decibels(&rings, 1) >= most, "%s: %.1f dB of rings, not %.1f", one.to,
                    decibels(&rings, 1), most);
        }
        cm_surface_destroy(to);
    }
}
END_TEST

/* Instruction sets round differently, and that is all. */
START_TEST(instruction_sets_agree)
{
    cm_surface *from = make_surface("equirect;size=400");
    cm_surface *to = make_surface("cube:gnomonic;size=40");
    cm_image source[PICTURES_MOST], target[2][PICTURES_MOST];
    make_pictures(from, CM_PIXEL_FLOAT, 3, source);
    paint_noise(from, source);
    for (size_t s = 0; s < cm_instructions_count(); s++)
    {
        cm_plan *plan = NULL;
        const cm_plan_options options = {.size = sizeof options,
                                         .filter = CM_FILTER_EWA,
                                         .tolerance = -1.0,
                                         .instructions = cm_instructions_at(s)};
        make_pictures(to, CM_PIXEL_FLOAT, 3, target[s > 0]);
        ck_assert_int_eq(cm_plan_create(from, to, &options, &plan), CM_OK);
        ck_assert_int_eq(cm_resample(plan, source, target[s > 0], (cm_rows){0}), CM_OK);
        cm_plan_destroy(plan);
        for (size_t i = 0; s > 0 && i < PICTURES_MOST; i++)
        {
            for (size_t k = 0; k < 3 * 40 * 40; k++)
            {
                const float one = ((float *)target[0][i].data)[k];
                const float other = ((float *)target[1][i].data)[k];
                ck_assert_msg(fabsf(one - other) < 1e-5f, "%s: %g", options.instructions,
                              (double)fabsf(one - other));
            }
        }
        if (s > 0)
        {
            free_pictures(to, target[1]);
        }
    }
    free_pictures(from, source);
    free_pictures(to, target[0]);
    cm_surface_destroy(from);
    cm_surface_destroy(to);
}
END_TEST

/* Columns go by so fast that they count as without a derivative: rows, white and black in turn, are a mean all the same. */
START_TEST(a_pixel_on_a_pole_is_a_mean)
{
    cm_surface *from = make_surface("equirect;size=200000;height=96");
    cm_surface *to = make_surface("cube:gnomonic;size=1");
    cm_image source[PICTURES_MOST], target[PICTURES_MOST];
    cm_plan *plan = make_plan(from, to, CM_FILTER_EWA);
    make_pictures(from, CM_PIXEL_U8, 1, source);
    make_pictures(to, CM_PIXEL_U8, 1, target);
    for (size_t row = 0; row < 96; row++)
    {
        memset((uint8_t *)source->data + row * 200000, row % 2 != 0 ? 255 : 0, 200000);
    }
    ck_assert_int_eq(cm_resample(plan, source, target, (cm_rows){0}), CM_OK);
    cm_plan_destroy(plan);
    for (size_t i = 0; i < cm_surface_plane_count(to); i++)
    {
        const int value = *(const uint8_t *)target[i].data;
        REQUIRE(value > 117 && value < 138, "picture %zu: %d", i, value);
    }
    free_pictures(from, source);
    free_pictures(to, target);
    cm_surface_destroy(from);
    cm_surface_destroy(to);
}
END_TEST

START_TEST(bits_do_not_depend_on_threads_or_parts)
{
    check_same_bits("equirect;size=400", "view:fov=8,lat=90;size=40;aspect=1", CM_FILTER_EWA);
    check_same_bits("equirect;size=400", "view:fov=90,lat=-90;size=33;aspect=1", CM_FILTER_EWA);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {poles_are_as_exact_as_the_inside,
                                  detail_beside_poles_vanishes,
                                  instruction_sets_agree,
                                  a_pixel_on_a_pole_is_a_mean,
                                  bits_do_not_depend_on_threads_or_parts,
                                  NULL};
    return run_suite("ewa poles", tests);
}
