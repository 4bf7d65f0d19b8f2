/* SPDX-License-Identifier: MIT
 *
 * Memory that a program gives for planes.
 */
#include "aligned_memory.h"
#include "drawn_scene.h"

#include <cubemap/mips.h>

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

/* What was asked of us. */
typedef struct keeper
{
    size_t allocations;
    size_t bytes;   /* that are given */
    size_t most;    /* that were at any time */
    size_t refused; /* from which allocation on there is nothing; 0: never */
    atomic_size_t touched;
} keeper;

static void *allocate(void *context, size_t bytes)
{
    keeper *kept = context;
    ck_assert_uint_ge(bytes, 1);
    if (kept->refused != 0 && kept->allocations + 1 >= kept->refused)
    {
        return NULL;
    }
    void *pointer = allocate_aligned(bytes);
    ck_assert_ptr_nonnull(pointer);
    memset(pointer, 0xff, bytes); /* NaN, where it should not be read */
    kept->allocations++;
    kept->bytes += bytes;
    kept->most = kept->bytes > kept->most ? kept->bytes : kept->most;
    return pointer;
}

static void release(void *context, void *pointer, size_t bytes)
{
    keeper *kept = context;
    kept->bytes -= bytes;
    free_aligned(pointer);
}

static void touched(void *context, size_t bytes)
{
    keeper *kept = context;
    atomic_fetch_add(&kept->touched, bytes);
}

static cm_memory memory_of(keeper *kept)
{
    const cm_memory memory = {sizeof memory, allocate, release, kept, touched};
    return memory;
}

static void check_same(const pictures *one, const pictures *other)
{
    for (size_t i = 0; i < cm_surface_picture_count(one->surface); i++)
    {
        ck_assert_int_eq(memcmp(one->image[i].data, other->image[i].data, one->bytes), 0);
    }
}

/* Of planes with more rows than a part of the spline's walk has, and with fewer. */
START_TEST(same_bits)
{
    static const cm_filter filters[] = {CM_FILTER_BILINEAR, CM_FILTER_BSPLINE5, CM_FILTER_EWA};
    static const char *const surfaces[] = {"equirect;size=500", "cube:coupled;size=67",
                                           "equirect;size=20"};
    for (int i = 0; i < 9; i++)
    {
        keeper kept = {0};
        const cm_memory memory = memory_of(&kept);
        cm_plan_options options = {.size = sizeof options, .filter = filters[i % 3]};
        pictures from = make_pictures(surfaces[i / 3], NULL, CM_PIXEL_U8, 3, 0);
        pictures free_one = make_pictures("cube:qsc;size=51", NULL, CM_PIXEL_FLOAT, 3, 1);
        pictures kept_one = make_pictures("cube:qsc;size=51", NULL, CM_PIXEL_FLOAT, 3, 2);
        draw_scene(&from);
        resample(&from, &free_one, &options, 1);
        options.memory = &memory;
        resample(&from, &kept_one, &options, 3);
        check_same(&free_one, &kept_one);
        ck_assert_int_eq(kept.allocations > 0, filters[i % 3] != CM_FILTER_BILINEAR);
        /* what is read of the pictures' own edges, too */
        ck_assert_uint_gt(atomic_load(&kept.touched), 0);
        /* rows as they are written, and once more as they are read */
        ck_assert_uint_ge(atomic_load(&kept.touched), kept.most / 2);
        ck_assert_uint_eq(kept.bytes, 0);
        free_pictures(&from);
        free_pictures(&free_one);
        free_pictures(&kept_one);
    }
}
END_TEST

/* A spline asks for no more than 4 bytes a channel and pixel, with 20 pixels around each plane and 128 bytes behind each
 * row, of whatever type the pictures are. */
START_TEST(spline_asks_for_planes)
{
    static const char *const surfaces[] = {"equirect;size=500", "cube:coupled;size=67"};
    static const uint32_t channels[] = {1, 3, 4};
    static const cm_pixel_type types[] = {CM_PIXEL_U8, CM_PIXEL_HALF, CM_PIXEL_FLOAT};
    for (size_t i = 0; i < 18; i++)
    {
        const uint32_t count = channels[i / 2 % 3];
        const cm_pixel_type type = types[i / 6];
        keeper kept = {0};
        const cm_memory memory = memory_of(&kept);
        const cm_plan_options options = {
            .size = sizeof options, .filter = CM_FILTER_BSPLINE5, .memory = &memory};
        pictures from = make_pictures(surfaces[i % 2], NULL, type, count, 0);
        pictures to = make_pictures("cube:qsc;size=16", NULL, type, count, 0);
        resample(&from, &to, &options, 2);
        const size_t wide = cm_surface_plane_width(from.surface) + 40;
        const size_t high = cm_surface_plane_height(from.surface) + 40;
        const size_t plane = high * (wide * count * sizeof(float) + 128);
        ck_assert_uint_gt(kept.most, 0);
        ck_assert_uint_le(kept.most, plane * cm_surface_plane_count(from.surface));
        ck_assert_uint_eq(kept.bytes, 0);
        free_pictures(&from);
        free_pictures(&to);
    }
}
END_TEST

/* Whatever is refused: a status, and all that was given comes back. */
START_TEST(refused)
{
    static const cm_filter filters[] = {CM_FILTER_BSPLINE5, CM_FILTER_EWA};
    pictures from = make_pictures("equirect;size=64", NULL, CM_PIXEL_U8, 3, 0);
    pictures to = make_pictures("cube:qsc;size=16", NULL, CM_PIXEL_U8, 3, 0);
    for (size_t i = 0; i < 2; i++)
    {
        keeper kept = {.refused = 1};
        const cm_memory memory = memory_of(&kept);
        const cm_plan_options options = {
            .size = sizeof options, .filter = filters[i], .memory = &memory};
        cm_plan *plan;
        cm_source *source = NULL;
        ck_assert_int_eq(cm_plan_create(from.surface, to.surface, &options, &plan), CM_OK);
        while (cm_source_create(plan, from.image, CM_PIXEL_U8, 1, &source) != CM_OK)
        {
            ck_assert_ptr_null(source);
            ck_assert_uint_eq(kept.bytes, 0);
            kept.allocations = 0;
            kept.refused++;
            ck_assert_uint_lt(kept.refused, 20);
        }
        ck_assert_uint_gt(kept.refused, 1);
        ck_assert_uint_gt(kept.bytes, 0);
        cm_source_destroy(source);
        cm_plan_destroy(plan);
        ck_assert_uint_eq(kept.bytes, 0);
    }
    free_pictures(&from);
    free_pictures(&to);
}
END_TEST

/* Levels and borders take it, too. */
START_TEST(levels_and_borders)
{
    keeper kept = {0};
    const cm_memory memory = memory_of(&kept);
    const cm_plan_options options = {.size = sizeof options, .memory = &memory};
    pictures from = make_pictures("equirect;size=64", NULL, CM_PIXEL_U8, 3, 0);
    pictures wide = make_pictures("equirect;size=72;height=40", NULL, CM_PIXEL_U8, 3, 0);
    cm_mips *mips;
    ck_assert_int_eq(cm_mips_create(from.surface, from.image, &options, 1, &mips), CM_OK);
    cm_mips_destroy(mips);
    const size_t allocations = kept.allocations;
    ck_assert_uint_gt(allocations, 1);
    ck_assert_int_eq(cm_border(from.surface, from.image, 4, &options, 1, wide.image), CM_OK);
    ck_assert_uint_gt(kept.allocations, allocations);
    ck_assert_uint_eq(kept.bytes, 0);
    free_pictures(&from);
    free_pictures(&wide);
}
END_TEST

START_TEST(arguments)
{
    keeper kept = {0};
    cm_memory bad[3] = {memory_of(&kept), memory_of(&kept), memory_of(&kept)};
    bad[0].size--;
    bad[1].allocate = NULL;
    bad[2].release = NULL;
    pictures one = make_pictures("equirect;size=16", NULL, CM_PIXEL_U8, 1, 0);
    for (size_t i = 0; i < 3; i++)
    {
        const cm_plan_options options = {.size = sizeof options, .memory = &bad[i]};
        cm_plan *plan = NULL;
        ck_assert_int_eq(cm_plan_create(one.surface, one.surface, &options, &plan),
                         CM_ERROR_ARGUMENT);
        ck_assert_ptr_null(plan);
    }
    free_pictures(&one);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        same_bits, spline_asks_for_planes, refused, levels_and_borders, arguments, NULL};
    return run_suite("plan memory", tests);
}
