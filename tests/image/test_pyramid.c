/* SPDX-License-Identifier: MIT
 *
 * Levels of pictures that are made when somebody asks: which are there, and the same bits as of those made at once.
 */
#include "drawn_scene.h"

#include "modules/image/ewa_object.h"
#include "modules/image/source.h"

#include <cubemap/threads.h>

#include <stdint.h>
#include <string.h>

enum
{
    TASKS = 16,
    EACH = 64
};

/* A pyramid of pictures that are there as long as it is. */
typedef struct drawn_pyramid
{
    pictures from;
    cm_plan *plan;
    cm_values values;
    cm_pyramid made;
} drawn_pyramid;

static void make(const char *name, cm_pixel_type type, unsigned wanted, drawn_pyramid *to)
{
    to->from = make_pictures(name, NULL, type, 3, 0);
    draw_scene(&to->from);
    ck_assert_int_eq(cm_plan_create(to->from.surface, to->from.surface, NULL, &to->plan), CM_OK);
    to->values = cm_values_of(to->plan, to->from.image);
    ck_assert_int_eq(cm_pyramid_make(to->plan->from, to->from.image, &to->values,
                                     cm_sample_set_find(NULL), CM_PYRAMID_EIGHTHS, 8,
                                     type == CM_PIXEL_U8, wanted, NULL, 1, &to->made),
                     CM_OK);
}

static void leave(drawn_pyramid *to)
{
    cm_pyramid_free(&to->made);
    cm_plan_destroy(to->plan);
    free_pictures(&to->from);
}

/* Tasks ask for levels in different orders, most of them for the last one first. */
static void ask(size_t begin, size_t end, void *user)
{
    const cm_pyramid *made = user;
    for (size_t at = begin / EACH; at < end / EACH; at++)
    {
        const unsigned k = at % 4 == 3 ? 1 + (unsigned)at % (made->count - 1) : made->count - 1;
        ck_assert_int_eq(cm_pyramid_need(made, k), CM_OK);
        ck_assert(made->level[k].memory != NULL);
    }
}

static void check_levels(const cm_pyramid *one, const cm_pyramid *other)
{
    ck_assert_uint_eq(one->count, other->count);
    for (unsigned k = 1; k < one->count; k++)
    {
        const cm_padded *a = &one->level[k], *b = &other->level[k];
        const size_t size = a->is_whole ? sizeof(int16_t) : sizeof(float);
        ck_assert_int_eq(a->beyond, b->beyond);
        ck_assert_msg(memcmp(a->memory, b->memory, a->plane_floats * a->planes * size) == 0,
                      "level %u", k);
    }
}

static void check_later(const char *name, cm_pixel_type type)
{
    drawn_pyramid at_once, later;
    make(name, type, CM_LEVELS_MAX, &at_once);
    for (unsigned threads = 1; threads <= 4; threads += 3)
    {
        make(name, type, 2, &later);
        ck_assert_uint_eq(later.made.count, at_once.made.count);
        ck_assert_uint_eq(atomic_load(&later.made.made), 2);
        ck_assert(later.made.level[1].memory != NULL && later.made.level[2].memory == NULL);
        ck_assert_int_eq(later.made.level[2].beside, at_once.made.level[2].beside);
        cm_run_threads(threads, (size_t)TASKS * EACH, EACH, ask, &later.made);
        check_levels(&at_once.made, &later.made);
        leave(&later);
    }
    leave(&at_once);
}

START_TEST(levels_wait_until_somebody_asks)
{
    check_later("cube:coupled;size=150", CM_PIXEL_U8);
    check_later("equirect;size=301;height=151", CM_PIXEL_FLOAT);
}
END_TEST

/* A source has what footprints want, and what they do not want is not made; the caller's memory is asked for at once. */
static unsigned levels_of(const char *from_name, const char *to_name, const cm_memory *memory)
{
    pictures from = make_pictures(from_name, NULL, CM_PIXEL_U8, 3, 0);
    pictures to = make_pictures(to_name, NULL, CM_PIXEL_U8, 3, 0);
    const cm_plan_options options = {
        .size = sizeof options, .filter = CM_FILTER_EWA, .memory = memory};
    cm_plan *plan;
    cm_source *source;
    draw_scene(&from);
    ck_assert_int_eq(cm_plan_create(from.surface, to.surface, &options, &plan), CM_OK);
    ck_assert_int_eq(cm_source_create(plan, from.image, CM_PIXEL_U8, 1, &source), CM_OK);
    ck_assert_int_eq(cm_resample_source(plan, source, to.image, (cm_rows){0}, 1), CM_OK);
    const unsigned made = atomic_load(&source->ewa.pyramid.made);
    cm_source_destroy(source);
    cm_plan_destroy(plan);
    free_pictures(&from);
    free_pictures(&to);
    return made;
}

static void *allocate_some(void *context, size_t bytes)
{
    (void)context;
    return aligned_alloc(64, (bytes + 63) / 64 * 64);
}

static void release_some(void *context, void *pointer, size_t bytes)
{
    (void)context;
    (void)bytes;
    free(pointer);
}

START_TEST(a_source_has_the_levels_that_are_wanted)
{
    const cm_memory memory = {
        .size = sizeof memory, .allocate = allocate_some, .release = release_some};
    ck_assert_uint_eq(levels_of("cube:coupled;size=256", "equirect;size=1024", NULL), 1);
    ck_assert_uint_eq(levels_of("cube:coupled;size=256", "equirect;size=256", NULL), 2);
    ck_assert_uint_gt(levels_of("cube:coupled;size=256", "equirect;size=32", NULL), 4);
    ck_assert_uint_eq(levels_of("cube:coupled;size=256", "equirect;size=256", &memory), 9);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {levels_wait_until_somebody_asks,
                                  a_source_has_the_levels_that_are_wanted, NULL};
    return run_suite("pyramid", tests);
}
