/* SPDX-License-Identifier: MIT
 *
 * Elliptic footprints: what they let through and what not.
 */
#include "tests/image/round_scene.h"

/* Target pixels of a face, source pixels for one of them, and target pixels where a plate has its most cycles. */
#define TARGET 64
#define MINIFIED 16
#define FARTHEST 28.0

#define PI 3.14159265358979323846

/* Pixels of the first face from a function of the position in target pixels, from its centre. */
typedef double pattern(double x, double y);

static void paint_face(const cm_image *pictures, size_t plane, double per_pixel, pattern *at)
{
    const double middle = 0.5 * pictures->width;
    for (size_t row = 0; row < pictures->height; row++)
    {
        for (size_t column = 0; column < pictures->width; column++)
        {
            put_number(pictures, plane, column, row, 0,
                       at(((double)column + 0.5 - middle) / per_pixel,
                          ((double)row + 0.5 - middle) / per_pixel));
        }
    }
}

/* 8 cycles a target pixel at the distance FARTHEST. */
static double zone_plate(double x, double y)
{
    return 0.5 + 0.5 * cos(PI * 8.0 / FARTHEST * (x * x + y * y));
}

/* 4 cycles there. */
static double half_plate(double x, double y)
{
    return 0.5 + 0.5 * cos(PI * 4.0 / FARTHEST * (x * x + y * y));
}

/* A quarter of a cycle a target pixel. */
static double wave(double x, double y)
{
    return 0.5 + 0.5 * cos(2.0 * PI * 0.25 * (0.8 * x + 0.6 * y) + 0.3);
}

static void minify(pattern *at, double minified, cm_image *target)
{
    char name[64];
    snprintf(name, sizeof name, "cube:gnomonic;size=%.0f", minified * TARGET);
    cm_surface *from = make_surface(name);
    cm_surface *to = make_surface("cube:gnomonic;size=64");
    cm_image source[PICTURES_MOST];
    make_pictures(from, CM_PIXEL_FLOAT, 1, source);
    make_pictures(to, CM_PIXEL_FLOAT, 1, target);
    for (size_t plane = 0; plane < 6; plane++)
    {
        paint_face(source, plane, minified, at);
    }
    cm_plan *plan = make_plan(from, to, CM_FILTER_EWA);
    ck_assert_int_eq(cm_resample(plan, source, target, (cm_rows){0}), CM_OK);
    cm_plan_destroy(plan);
    free_pictures(from, source);
    cm_surface_destroy(from);
    cm_surface_destroy(to);
}

static void free_six(cm_image *pictures)
{
    for (size_t i = 0; i < 6; i++)
    {
        free(pictures[i].data);
    }
}

/* What is left of a plate, of its amplitude, where it has from one cycle a target pixel to `most`. */
static double left_of_plate(pattern *plate, double most, double minified)
{
    cm_image target[PICTURES_MOST];
    double sum = 0.0;
    size_t count = 0;
    minify(plate, minified, target);
    for (size_t row = 0; row < TARGET; row++)
    {
        for (size_t column = 0; column < TARGET; column++)
        {
            const double x = (double)column + 0.5 - TARGET / 2, y = (double)row + 0.5 - TARGET / 2;
            const double cycles = most / FARTHEST * sqrt(x * x + y * y);
            const double off = number_at(target, 0, column, row, 0) - 0.5;
            if (cycles >= 1.0 && cycles <= most)
            {
                sum += off * off;
                count++;
            }
        }
    }
    free_six(target);
    return 20.0 * log10(sqrt(sum / (double)count) / 0.5);
}

START_TEST(a_zone_plate_does_not_alias)
{
    const double decibels = left_of_plate(zone_plate, 8.0, MINIFIED);
    ck_assert_msg(decibels <= -50.0, "%.1f dB of its amplitude", decibels);
    /* where the level's pixels are as large as they get, between, and as small */
    static const double others[] = {8.25, 11.0, 9.25, 12.0, 8.75};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
    {
        const double of_half = left_of_plate(half_plate, 4.0, others[i]);
        ck_assert_msg(of_half <= -50.0, "%g: %.1f dB", others[i], of_half);
    }
}
END_TEST

START_TEST(a_quarter_of_a_cycle_is_kept)
{
    cm_image target[PICTURES_MOST];
    double along = 0.0, across = 0.0;
    size_t count = 0;
    minify(wave, MINIFIED, target);
    for (size_t row = 12; row < TARGET - 12; row++)
    {
        for (size_t column = 12; column < TARGET - 12; column++)
        {
            const double x = (double)column + 0.5 - TARGET / 2, y = (double)row + 0.5 - TARGET / 2;
            const double phase = 2.0 * PI * 0.25 * (0.8 * x + 0.6 * y) + 0.3;
            const double value = number_at(target, 0, column, row, 0) - 0.5;
            along += value * cos(phase);
            across += value * sin(phase);
            count++;
        }
    }
    const double amplitude = 2.0 * hypot(along, across) / (double)count;
    const double decibels = 20.0 * log10(amplitude / 0.5);
    ck_assert_msg(decibels >= -4.0 && decibels <= 1.0, "%.2f dB", decibels);
    free_six(target);
}
END_TEST

START_TEST(constants_stay_what_they_are)
{
    static const char *const pairs[][2] = {{"equirect;size=64", "cube:coupled;size=7"},
                                           {"cube:qsc;size=33", "equirect;size=9;height=5"},
                                           {"equirect;size=1;height=1", "cube:gnomonic;size=2"},
                                           {"cube:gnomonic;size=2", "cube:coupled;size=1"},
                                           {"equirect;size=300;height=3", "cube:gnomonic;size=20"},
                                           {"cube:coupled;size=5", "equirect;size=64"}};
    for (size_t s = 0; s < sizeof pairs / sizeof *pairs; s++)
    {
        cm_surface *from = make_surface(pairs[s][0]), *to = make_surface(pairs[s][1]);
        cm_image source[PICTURES_MOST], target[PICTURES_MOST];
        make_pictures(from, CM_PIXEL_U8, 6, source);
        make_pictures(to, CM_PIXEL_FLOAT, 6, target);
        for (size_t i = 0; i < cm_surface_picture_count(from); i++)
        {
            memset(source[i].data, 51, picture_bytes(&source[i]));
        }
        cm_plan *plan = make_plan(from, to, CM_FILTER_EWA);
        ck_assert_int_eq(cm_resample(plan, source, target, (cm_rows){0}), CM_OK);
        for (size_t i = 0; i < cm_surface_picture_count(to); i++)
        {
            for (size_t k = 0; k < picture_bytes(&target[i]) / sizeof(float); k++)
            {
                const float value = ((const float *)target[i].data)[k];
                ck_assert_msg(fabsf(value - 0.2f) < 2e-6f, "%s -> %s: %g", pairs[s][0], pairs[s][1],
                              (double)value);
            }
        }
        cm_plan_destroy(plan);
        free_pictures(from, source);
        free_pictures(to, target);
        cm_surface_destroy(from);
        cm_surface_destroy(to);
    }
}
END_TEST

/* The greatest difference of two filters' results. */
static double difference(const char *from_name, const char *to_name, cm_filter one, cm_filter other)
{
    double most = 0.0;
    cm_surface *from = make_surface(from_name), *to = make_surface(to_name);
    cm_image source[PICTURES_MOST], target[2][PICTURES_MOST];
    make_pictures(from, CM_PIXEL_FLOAT, 3, source);
    paint(from, 3.0, source);
    for (int k = 0; k < 2; k++)
    {
        cm_plan *plan = make_plan(from, to, k == 0 ? one : other);
        make_pictures(to, CM_PIXEL_FLOAT, 3, target[k]);
        ck_assert_int_eq(cm_resample(plan, source, target[k], (cm_rows){0}), CM_OK);
        cm_plan_destroy(plan);
    }
    for (size_t i = 0; i < cm_surface_picture_count(to); i++)
    {
        for (size_t k = 0; k < picture_bytes(&target[0][i]) / sizeof(float); k++)
        {
            const float a = ((const float *)target[0][i].data)[k];
            const float b = ((const float *)target[1][i].data)[k];
            most = fmax(most, fabs((double)a - (double)b));
        }
    }
    free_pictures(from, source);
    free_pictures(to, target[0]);
    free_pictures(to, target[1]);
    cm_surface_destroy(from);
    cm_surface_destroy(to);
    return most;
}

START_TEST(magnification_is_sharp)
{
    const double off = difference("cube:gnomonic;size=20", "cube:gnomonic;size=61", CM_FILTER_EWA,
                                  CM_FILTER_SPLINE36);
    ck_assert_msg(off < 1e-5, "%g", off);
    /* and another filter is another */
    ck_assert_msg(difference("cube:gnomonic;size=20", "cube:gnomonic;size=61", CM_FILTER_EWA,
                             CM_FILTER_BILINEAR) > 1e-3,
                  "bilinear");
}
END_TEST

/* The scene has no waves that the target does not: it goes through, also where footprints are on two faces. */
/* What is smooth and made a little smaller is what another filter has, on every kind; where a pixel of the target is
 * the pole of the source, too. */
START_TEST(footprints_are_of_every_kind)
{
    static const char *const targets[] = {
        "healpix:40",         "cube:coupled;size=41",
        "octahedral;size=95", "azimuthal:lambert:full=1;size=95",
        "fisheye;size=61",    "view:fov=90,lat=90;size=31;aspect=1",
        "rhealpix;size=96"};
    for (size_t i = 0; i < sizeof targets / sizeof *targets; i++)
    {
        const double off =
            difference("equirect;size=256", targets[i], CM_FILTER_EWA, CM_FILTER_SPLINE36);
        ck_assert_msg(off < 0.1, "%s: %g", targets[i], off);
    }
}
END_TEST

START_TEST(what_the_target_can_show_is_there)
{
    static const char *const pairs[][2] = {{"cube:coupled;size=256", "equirect;size=256"},
                                           {"equirect;size=1024", "cube:gnomonic;size=64"},
                                           {"cube:gnomonic;size=201", "cube:qsc;size=48"}};
    for (size_t s = 0; s < sizeof pairs / sizeof *pairs; s++)
    {
        cm_surface *from = make_surface(pairs[s][0]), *to = make_surface(pairs[s][1]);
        cm_image source[PICTURES_MOST], target[PICTURES_MOST], truth[PICTURES_MOST];
        make_pictures(from, CM_PIXEL_FLOAT, 1, source);
        make_pictures(to, CM_PIXEL_FLOAT, 1, target);
        make_pictures(to, CM_PIXEL_FLOAT, 1, truth);
        paint(from, 6.0, source);
        paint(to, 6.0, truth);
        cm_plan *plan = make_plan(from, to, CM_FILTER_EWA);
        ck_assert_int_eq(cm_resample(plan, source, target, (cm_rows){0}), CM_OK);
        double worst = 0.0;
        for (size_t i = 0; i < cm_surface_picture_count(to); i++)
        {
            for (size_t k = 0; k < picture_bytes(&truth[i]) / sizeof(float); k++)
            {
                worst = fmax(worst, fabs((double)((float *)target[i].data)[k] -
                                         (double)((float *)truth[i].data)[k]));
            }
        }
        ck_assert_msg(worst < 0.02, "%s -> %s: %g", pairs[s][0], pairs[s][1], worst);
        cm_plan_destroy(plan);
        free_pictures(from, source);
        free_pictures(to, target);
        free_pictures(to, truth);
        cm_surface_destroy(from);
        cm_surface_destroy(to);
    }
}
END_TEST

START_TEST(long_ellipses_are_shortened)
{
    cm_surface *from = make_surface("equirect;size=512"),
               *to = make_surface("equirect;size=16;height=256");
    cm_image source, target[2];
    make_pictures(from, CM_PIXEL_FLOAT, 1, &source);
    paint_noise(from, &source);
    for (int k = 0; k < 2; k++)
    {
        cm_plan *plan = NULL;
        const cm_plan_options options = {
            .size = sizeof options, .filter = CM_FILTER_EWA, .pixels_most = k == 0 ? 4096.0 : 32.0};
        make_pictures(to, CM_PIXEL_FLOAT, 1, &target[k]);
        ck_assert_int_eq(cm_plan_create(from, to, &options, &plan), CM_OK);
        ck_assert_int_eq(cm_resample(plan, &source, &target[k], (cm_rows){0}), CM_OK);
        cm_plan_destroy(plan);
    }
    double spread[2] = {0.0, 0.0};
    for (size_t k = 0; k < 16 * 256; k++)
    {
        for (int i = 0; i < 2; i++)
        {
            const double value = (double)((float *)target[i].data)[k] - 0.5;
            ck_assert_msg(fabs(value) < 1.0, "%g", value);
            spread[i] += value * value;
        }
    }
    /* fewer pixels leave more of the noise */
    ck_assert_msg(spread[1] > 2.0 * spread[0], "%g, %g", spread[0], spread[1]);
    free_pictures(from, &source);
    free_pictures(to, &target[0]);
    free_pictures(to, &target[1]);
    cm_surface_destroy(from);
    cm_surface_destroy(to);
}
END_TEST

START_TEST(bits_do_not_depend_on_threads_or_parts)
{
    check_same_bits("cube:coupled;size=150", "equirect;size=90;height=47", CM_FILTER_EWA);
    check_same_bits("equirect;size=301;height=151", "cube:gnomonic;size=37", CM_FILTER_EWA);
}
END_TEST

/* Noise of a quarter of what there is: beyond the corners of faces six points a way extrapolate it, and whole numbers end
 * at twice of what there is. */
static void paint_bytes(const cm_surface *surface, const cm_image *pictures)
{
    uint32_t state = 7;
    for (size_t i = 0; i < cm_surface_picture_count(surface); i++)
    {
        for (size_t k = 0; k < picture_bytes(&pictures[i]); k++)
        {
            state = state * 1664525u + 1013904223u;
            ((uint8_t *)pictures[i].data)[k] = (uint8_t)(96 + (state >> 26));
        }
    }
}

/* The levels that bytes have for bytes are whole numbers: what comes of them is within a twenty-fifth of rounding of what comes
 * of floats, and does not depend on threads. */
static void check_bytes(const char *from_name, const char *to_name, uint32_t channels)
{
    cm_surface *from = make_surface(from_name), *to = make_surface(to_name);
    cm_image source[PICTURES_MOST], floats[PICTURES_MOST], bytes[2][PICTURES_MOST];
    cm_plan *plan = make_plan(from, to, CM_FILTER_EWA);
    make_pictures(from, CM_PIXEL_U8, channels, source);
    make_pictures(to, CM_PIXEL_FLOAT, channels, floats);
    paint_bytes(from, source);
    ck_assert_int_eq(cm_resample(plan, source, floats, (cm_rows){0}), CM_OK);
    for (unsigned k = 0; k < 2; k++)
    {
        cm_source *made = NULL;
        make_pictures(to, CM_PIXEL_U8, channels, bytes[k]);
        ck_assert_int_eq(cm_source_create(plan, source, CM_PIXEL_U8, 1 + 2 * k, &made), CM_OK);
        ck_assert_int_eq(cm_resample_source(plan, made, bytes[k], (cm_rows){0}, 1 + k), CM_OK);
        cm_source_destroy(made);
    }
    for (size_t i = 0; i < cm_surface_picture_count(to); i++)
    {
        const size_t n = picture_bytes(&bytes[0][i]);
        ck_assert_msg(memcmp(bytes[0][i].data, bytes[1][i].data, n) == 0, "%s", from_name);
        for (size_t k = 0; k < n; k++)
        {
            const double is = ((uint8_t *)bytes[0][i].data)[k];
            const double wanted = fmin(fmax(((float *)floats[i].data)[k], 0.0), 1.0) * 255.0;
            ck_assert_msg(fabs(is - wanted) <= 0.52, "%s -> %s: %g, not %g", from_name, to_name, is,
                          wanted);
        }
    }
    cm_plan_destroy(plan);
    free_pictures(from, source);
    free_pictures(to, floats);
    free_pictures(to, bytes[0]);
    free_pictures(to, bytes[1]);
    cm_surface_destroy(from);
    cm_surface_destroy(to);
}

START_TEST(bytes_are_those_of_floats)
{
    check_bytes("cube:coupled;size=300", "equirect;size=190;height=97", 3);
    check_bytes("equirect;size=600;height=301", "cube:gnomonic;size=37", 3);
    check_bytes("equirect;size=512", "azimuthal:lambert:full=1;size=95", 1);
    check_bytes("fisheye;size=201", "cube:coupled;size=20", 4);
    check_bytes("cube:qsc;size=9", "equirect;size=4", 5);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        a_zone_plate_does_not_alias,  a_quarter_of_a_cycle_is_kept,
        constants_stay_what_they_are, magnification_is_sharp,
        footprints_are_of_every_kind, what_the_target_can_show_is_there,
        long_ellipses_are_shortened,  bits_do_not_depend_on_threads_or_parts,
        bytes_are_those_of_floats,    NULL};
    return run_suite("ewa", tests);
}
