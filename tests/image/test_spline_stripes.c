/* SPDX-License-Identifier: MIT
 *
 * Splines whose coefficients are never all in memory: the same bits, and when they have to be there after all.
 */
#include "drawn_scene.h"

#include "modules/image/source.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

/* From surfaces whose coefficients have more than 32 MiB. */
typedef struct way
{
    const char *from;
    const char *to;
    cm_pixel_type type;
    uint32_t channels;
} way;

static const way ways[] = {
    {"equirect;size=2048", "cube:coupled;size=83", CM_PIXEL_FLOAT, 4},
    {"cube:coupled;size=768", "equirect;size=250", CM_PIXEL_U8, 3},
    {"cube:qsc;size=700;layout=cross", "cube:gnomonic;size=97", CM_PIXEL_U8, 3},
    {"cube:cobe;frame=gl;size=768;layout=3x2", "view:fov=100;size=200", CM_PIXEL_U16, 4},
    {"equirect;size=2400", "octahedral;size=210", CM_PIXEL_U8, 4},
    {"equirect;size=2400", "fisheye:fov=150;size=160", CM_PIXEL_FLOAT, 4},
};

enum
{
    WAYS = sizeof ways / sizeof *ways
};

/* Noise, which has all there is to be seen at edges. */
static void draw_noise(pictures *on)
{
    uint32_t state = 12345;
    for (size_t i = 0; i < cm_surface_picture_count(on->surface); i++)
    {
        cm_image *image = &on->image[i];
        const size_t size = cm_pixel_size(image->type);
        for (size_t k = 0; k < on->bytes / size; k++)
        {
            state = state * 1664525u + 1013904223u;
            const float value = (float)(state >> 8) / 16777216.0f;
            const uint16_t word = (uint16_t)(state >> 16);
            memcpy((unsigned char *)image->data + k * size,
                   image->type == CM_PIXEL_FLOAT ? (const void *)&value : (const void *)&word,
                   size);
        }
    }
}

static cm_plan *make_plan(const pictures *from, const pictures *to)
{
    cm_plan *plan;
    const cm_plan_options options = {.size = sizeof options, .filter = CM_FILTER_BSPLINE5};
    ck_assert_int_eq(cm_plan_create(from->surface, to->surface, &options, &plan), CM_OK);
    return plan;
}

static cm_source *make_source(const cm_plan *plan, const pictures *from, cm_pixel_type type)
{
    cm_source *source;
    ck_assert_int_eq(cm_source_create(plan, from->image, type, 2, &source), CM_OK);
    return source;
}

/* Plane by plane, for which coefficients are kept. */
static void resample_parts(const cm_plan *plan, const cm_source *source, pictures *to)
{
    for (uint32_t plane = 0; plane < cm_surface_plane_count(to->surface); plane++)
    {
        const cm_rows rows = {.plane = plane, .row_count = cm_surface_plane_height(to->surface)};
        ck_assert_int_eq(cm_resample_source(plan, source, to->image, rows, 2), CM_OK);
    }
}

static void free_all(cm_plan *plan, cm_source *source, pictures *from, pictures *all,
                     pictures *parts)
{
    cm_source_destroy(source);
    cm_plan_destroy(plan);
    free_pictures(from);
    free_pictures(all);
    free_pictures(parts);
}

static void check_same(const pictures *one, const pictures *other)
{
    for (size_t i = 0; i < cm_surface_picture_count(one->surface); i++)
    {
        ck_assert_int_eq(memcmp(one->image[i].data, other->image[i].data, one->bytes), 0);
    }
}

START_TEST(same_bits)
{
    for (size_t i = 0; i < WAYS; i += is_quick() ? 3 : 1) /* a panorama and a cube at least */
    {
        const way *at = &ways[i];
        pictures from = make_pictures(at->from, NULL, at->type, at->channels, 0);
        pictures all = make_pictures(at->to, NULL, at->type, at->channels, 1);
        pictures parts = make_pictures(at->to, NULL, at->type, at->channels, 1);
        draw_noise(&from);
        cm_plan *plan = make_plan(&from, &all);
        cm_source *source = make_source(plan, &from, at->type);
        ck_assert_int_eq(atomic_load(&source->state), CM_SOURCE_LATER);
        for (unsigned threads = 1; threads <= 3; threads += 2)
        {
            memset(all.image->data, (int)threads, all.bytes);
            memset(parts.image->data, (int)threads, all.bytes);
            ck_assert_int_eq(cm_resample_source(plan, source, all.image, (cm_rows){0}, threads),
                             CM_OK);
            ck_assert_int_eq(atomic_load(&source->state),
                             threads == 1 ? CM_SOURCE_LATER : CM_SOURCE_READY);
            resample_parts(plan, source, &parts);
            ck_assert_int_eq(atomic_load(&source->state), CM_SOURCE_READY);
            check_same(&all, &parts);
            cm_source *other = make_source(plan, &from, at->type);
            ck_assert_int_eq(cm_resample_source(plan, other, all.image, (cm_rows){0}, 3), CM_OK);
            ck_assert_int_eq(atomic_load(&other->state), CM_SOURCE_LATER);
            check_same(&all, &parts);
            cm_source_destroy(other);
        }
        free_all(plan, source, &from, &all, &parts);
    }
}
END_TEST

/* What a spline cannot go through is filled from all sides: coefficients are kept then. */
START_TEST(holes)
{
    static const float values[] = {NAN, INFINITY, 1e38f};
    static const size_t rows[] = {3, 500, 1020}; /* at the last one the walk down is over */
    for (size_t i = 0; i < 3; i++)
    {
        pictures from = make_pictures("equirect;size=2048", NULL, CM_PIXEL_FLOAT, 4, 0);
        pictures all = make_pictures("cube:coupled;size=64", NULL, CM_PIXEL_FLOAT, 4, 1);
        pictures parts = make_pictures("cube:coupled;size=64", NULL, CM_PIXEL_FLOAT, 4, 1);
        draw_noise(&from);
        ((float *)from.image->data)[(rows[i] * 2048 + 77) * 4 + 1] = values[i];
        cm_plan *plan = make_plan(&from, &all);
        cm_source *source = make_source(plan, &from, CM_PIXEL_FLOAT);
        ck_assert_int_eq(cm_resample_source(plan, source, all.image, (cm_rows){0}, 2), CM_OK);
        ck_assert_int_eq(atomic_load(&source->state), CM_SOURCE_READY);
        resample_parts(plan, source, &parts);
        check_same(&all, &parts);
        free_all(plan, source, &from, &all, &parts);
    }
}
END_TEST

/* Small coefficients, and those of surfaces with an end, are there at once. */
START_TEST(made_at_once)
{
    static const char *const surfaces[] = {"equirect;size=500", "fisheye:fov=150;size=1800"};
    for (size_t i = 0; i < 2; i++)
    {
        pictures from = make_pictures(surfaces[i], NULL, CM_PIXEL_U8, 3, 7);
        pictures to = make_pictures("cube:coupled;size=32", NULL, CM_PIXEL_U8, 3, 0);
        cm_plan *plan = make_plan(&from, &to);
        cm_source *source = make_source(plan, &from, CM_PIXEL_U8);
        ck_assert_int_eq(atomic_load(&source->state), CM_SOURCE_READY);
        cm_source_destroy(source);
        cm_plan_destroy(plan);
        free_pictures(&from);
        free_pictures(&to);
    }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {same_bits, holes, made_at_once, NULL};
    return run_suite("spline stripes", tests);
}
