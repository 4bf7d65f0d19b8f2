/* SPDX-License-Identifier: MIT
 *
 * Maps in stores and in pages: the same map back, with any ceiling of memory, after failures of the store, and never a part.
 */
#include <cubemap/store.h>

#include "dense_map.h"

static cm_camera *camera;

static cm_store *memory_store(void)
{
    cm_store *store = NULL;
    ck_assert_int_eq(cm_store_create_in_memory(&store), CM_OK);
    return store;
}

START_TEST(pages_change_nothing)
{
    cm_store *pages = memory_store();
    const cm_octree_options with = paged_options(pages), without = paged_options(NULL);
    cm_octree *paged = make_map(&with), *whole = make_map(&without);
    for (uint64_t seed = 0; seed < 6; seed++)
    {
        ck_assert_int_eq(update_drawn(paged, camera, seed), CM_OK);
        ck_assert_int_eq(update_drawn(whole, camera, seed), CM_OK);
        ck_assert_str_eq(maps_differ(paged, whole), "");
    }
    cm_octree_count of_paged = {.size = sizeof of_paged}, of_whole = of_paged;
    ck_assert_int_eq(cm_octree_count_voxels(paged, &of_paged), CM_OK);
    ck_assert_int_eq(cm_octree_count_voxels(whole, &of_whole), CM_OK);
    ck_assert(of_paged.paged > 4 && of_paged.occupied == of_whole.occupied &&
              of_paged.free == of_whole.free);
    ck_assert(of_paged.bytes < of_whole.bytes);
    const float point[3] = {0.5f, 0.5f, 3.0f};
    const double origin[3] = {-3.0, -3.0, -3.0};
    ck_assert_int_eq(cm_octree_update_points(paged, origin, 1, point, NULL), CM_OK);
    ck_assert_int_eq(cm_octree_update_points(whole, origin, 1, point, NULL), CM_OK);
    ck_assert_str_eq(maps_differ(paged, whole), "");
    for (int level = 0; level < 7; level += 3)
    {
        size_t a = 0, b = 0;
        const cm_status first = cm_octree_extract(paged, level, 0, NULL, &a);
        ck_assert(first == cm_octree_extract(whole, level, 0, NULL, &b) && a == b);
    }
    cm_octree_destroy(paged);
    cm_octree_destroy(whole);
    cm_store_destroy(pages);
}
END_TEST

START_TEST(what_is_saved_is_loaded)
{
    cm_store *store = memory_store(), *pages = memory_store();
    const cm_octree_options with = paged_options(pages), without = paged_options(NULL);
    cm_octree *paged = make_map(&with), *whole = make_map(&without), *back = NULL;
    for (uint64_t seed = 0; seed < 4; seed++)
    {
        ck_assert_int_eq(update_drawn(paged, camera, seed), CM_OK);
        ck_assert_int_eq(update_drawn(whole, camera, seed), CM_OK);
        ck_assert_int_eq(cm_octree_save(seed % 2 ? paged : whole, store, "user", seed), CM_OK);
        ck_assert_int_eq(cm_octree_load(store, NULL, &back), CM_OK);
        ck_assert_str_eq(maps_differ(back, whole), "");
        size_t count = 99;
        const void *user = cm_octree_user_data(back, &count);
        ck_assert(count == seed && (seed == 0 ? user == NULL : memcmp(user, "user", seed) == 0));
        ck_assert(cm_octree_step(back) == cm_octree_step(whole));
        cm_octree_destroy(back);
    }
    /* into its own pages, and on from there */
    ck_assert_int_eq(cm_octree_save(paged, pages, NULL, 0), CM_OK);
    ck_assert_int_eq(update_drawn(paged, camera, 50), CM_OK);
    cm_octree_destroy(paged);
    ck_assert_int_eq(cm_store_rollback(pages), CM_OK);
    ck_assert_int_eq(cm_octree_load(pages, &with, &back), CM_OK);
    ck_assert_str_eq(maps_differ(back, whole), "");
    ck_assert_int_eq(update_drawn(back, camera, 51), CM_OK);
    ck_assert_int_eq(update_drawn(whole, camera, 51), CM_OK);
    ck_assert_str_eq(maps_differ(back, whole), "");
    cm_octree_destroy(back);
    cm_octree_destroy(whole);
    cm_store_destroy(pages);
    cm_store_destroy(store);
}
END_TEST

/* ---- what became even does not come back ---- */

START_TEST(old_pages_do_not_come_back)
{
    cm_store *pages = memory_store();
    const cm_octree_options options = paged_options(pages);
    cm_octree *octree = make_map(&options), *back = NULL;
    const double origin[3] = {-3.7, 0.01, 0.01}, at[3] = {1.0, 0.01, 0.01};
    const float near[3] = {1.0f, 0.01f, 0.01f}, far[3] = {2.2f, 0.01f, 0.01f};
    ck_assert_int_eq(cm_octree_update_points(octree, origin, 1, near, NULL), CM_OK);
    ck_assert_int_eq(cm_octree_save(octree, pages, NULL, 0), CM_OK);
    for (int i = 0; i < 70; i++)
    {
        ck_assert_int_eq(cm_octree_update_points(octree, origin, 1, far, NULL), CM_OK);
    }
    ck_assert_int_eq(cm_octree_compact(octree), CM_OK);
    ck_assert_int_eq(cm_octree_at(octree, at, 0, NULL), CM_VOXEL_FREE);
    ck_assert_int_eq(cm_octree_save(octree, pages, NULL, 0), CM_OK);
    cm_octree_destroy(octree);
    ck_assert_int_eq(cm_octree_load(pages, &options, &back), CM_OK);
    ck_assert_int_eq(cm_octree_at(back, at, 0, NULL), CM_VOXEL_FREE);
    cm_octree_destroy(back);
    cm_store_destroy(pages);
}
END_TEST

static size_t regions_in(cm_store *store)
{
    unsigned char key[CM_STORE_KEY_MAX];
    size_t count = 0, regions = 0;
    cm_store_key after = {"r", 1};
    ck_assert_int_eq(cm_store_next(store, &after, key, &count), CM_OK);
    for (; count > 0 && key[0] == 'r'; regions++)
    {
        const cm_store_key this_key = {key, count};
        ck_assert_int_eq(cm_store_next(store, &this_key, key, &count), CM_OK);
    }
    return regions;
}

/* Or a long run over the same places would leave more and more in its store that nobody reads. */
START_TEST(pages_of_what_became_even_go)
{
    cm_store *pages = memory_store();
    cm_octree_options options = paged_options(pages);
    options.memory = 0;
    options.far = 0.0;
    cm_octree *octree = make_map(&options), *back = NULL;
    for (uint64_t seed = 0; seed < 3; seed++)
    {
        ck_assert_int_eq(update_drawn(octree, camera, seed), CM_OK);
    }
    ck_assert_int_eq(cm_octree_save(octree, pages, NULL, 0), CM_OK);
    const size_t before = regions_in(pages);
    /* nothing is left in the regions that the camera looks through */
    const size_t pixels = (size_t)60 * 44;
    float *depth = malloc(pixels * sizeof *depth);
    ck_assert_ptr_nonnull(depth);
    for (size_t i = 0; i < pixels; i++)
    {
        depth[i] = 50.0f;
    }
    const double place[3] = {0.1, 0.2, -12.0}, at[3] = {0.0, 0.0, 0.0};
    const cm_view view = {.size = sizeof view,
                          .camera = camera,
                          .pose = look_at(place, at, 0.3),
                          .depth_unit = 1.0,
                          .depth = {.size = sizeof view.depth,
                                    .data = depth,
                                    .type = CM_PIXEL_FLOAT,
                                    .width = 60,
                                    .height = 44,
                                    .channels = 1}};
    for (int i = 0; i < 200; i++)
    {
        ck_assert_int_eq(cm_octree_update(octree, &view, NULL), CM_OK);
    }
    free(depth);
    ck_assert_int_eq(cm_octree_compact(octree), CM_OK);
    ck_assert_int_eq(cm_octree_save(octree, pages, NULL, 0), CM_OK);
    cm_octree_destroy(octree);
    ck_assert_int_eq(cm_octree_load(pages, &options, &back), CM_OK);
    cm_octree_count count = {.size = sizeof count};
    ck_assert_int_eq(cm_octree_count_voxels(back, &count), CM_OK);
    ck_assert_msg(count.paged < before, "%zu regions of %zu", (size_t)count.paged, before);
    ck_assert_uint_eq(regions_in(pages), count.paged);
    cm_octree_destroy(back);
    cm_store_destroy(pages);
}
END_TEST

/* ---- stores that fail ---- */

typedef struct failing_store
{
    cm_store *inner;
    int calls_until_failure; /* below 0: none fails */
} failing_store;

static int fails(failing_store *store)
{
    return store->calls_until_failure >= 0 && store->calls_until_failure-- == 0;
}

static cm_status failing_get(void *context, const cm_store_key *key, cm_blob *blob)
{
    failing_store *store = context;
    cm_blob got = {.size = sizeof got};
    if (fails(store))
    {
        return CM_ERROR_FILE;
    }
    /* of any kind: first letters say which */
    const char letter = *(const char *)key->bytes;
    const uint32_t kind = letter == 'm'   ? 0x4f434d4du
                          : letter == 't' ? 0x4f435454u
                          : letter == 'u' ? 0x4f435555u
                                          : 0x4f435252u;
    const cm_status status = cm_store_get(store->inner, key, kind, 1000, &got);
    *blob = status == CM_OK ? got : *blob;
    return status;
}
static cm_status failing_put(void *context, const cm_store_key *key, const cm_blob *blob)
{
    failing_store *store = context;
    return fails(store) ? CM_ERROR_FILE : cm_store_put(store->inner, key, blob);
}
static cm_status failing_remove(void *context, const cm_store_key *key)
{
    failing_store *store = context;
    return fails(store) ? CM_ERROR_FILE : cm_store_remove(store->inner, key);
}
static cm_status failing_next(void *context, const cm_store_key *after,
                              unsigned char key[CM_STORE_KEY_MAX], size_t *count)
{
    failing_store *store = context;
    return fails(store) ? CM_ERROR_FILE : cm_store_next(store->inner, after, key, count);
}
static cm_status failing_commit(void *context)
{
    failing_store *store = context;
    return fails(store) ? CM_ERROR_FILE : cm_store_commit(store->inner);
}
static cm_status failing_rollback(void *context)
{
    return cm_store_rollback(((failing_store *)context)->inner);
}
static const char *failing_message(void *context)
{
    (void)context;
    return "refused";
}
static void failing_destroy(void *context)
{
    cm_store_destroy(((failing_store *)context)->inner);
}

static cm_store *store_that_fails(failing_store *context)
{
    const cm_store_methods methods = {sizeof methods,   failing_get,     failing_put,
                                      failing_remove,   failing_next,    failing_commit,
                                      failing_rollback, failing_message, failing_destroy};
    cm_store *store = NULL;
    *context = (failing_store){memory_store(), -1};
    ck_assert_int_eq(cm_store_create(&methods, context, &store), CM_OK);
    return store;
}

/* An update whose pages fail says so, and leaves the map as it was or whole with the view. */
START_TEST(pages_that_fail_leave_a_whole_map)
{
    failing_store context;
    cm_store *pages = store_that_fails(&context);
    const cm_octree_options with = paged_options(pages), without = paged_options(NULL);
    cm_octree *paged = make_map(&with), *before = make_map(&without), *after = make_map(&without);
    for (uint64_t seed = 0; seed < 3; seed++)
    {
        ck_assert_int_eq(update_drawn(paged, camera, seed), CM_OK);
        ck_assert_int_eq(update_drawn(before, camera, seed), CM_OK);
        ck_assert_int_eq(update_drawn(after, camera, seed), CM_OK);
    }
    int failures = 0, is_done = 0;
    for (int call = 0; !is_done && call < 400; call += is_quick() ? 3 : 1)
    {
        ck_assert_int_eq(update_drawn(after, camera, 100 + (uint64_t)call), CM_OK);
        context.calls_until_failure = call;
        const cm_status status = update_drawn(paged, camera, 100 + (uint64_t)call);
        is_done = context.calls_until_failure >= 0;
        context.calls_until_failure = -1;
        ck_assert_int_eq(status, is_done ? CM_OK : CM_ERROR_FILE);
        failures += !is_done;
        const int is_after = maps_differ(paged, after)[0] == '\0';
        const char *text = maps_differ(paged, is_after ? after : before);
        ck_assert_msg(text[0] == '\0', "call %d: %s", call, text);
        ck_assert_uint_eq(cm_octree_step(paged), cm_octree_step(is_after ? after : before));
        if (!is_after)
        {
            ck_assert_int_eq(update_drawn(paged, camera, 100 + (uint64_t)call), CM_OK);
        }
        ck_assert_int_eq(update_drawn(before, camera, 100 + (uint64_t)call), CM_OK);
    }
    ck_assert_msg(failures > 1 && is_done, "%d failures", failures);
    cm_octree_destroy(paged);
    cm_octree_destroy(before);
    cm_octree_destroy(after);
    cm_store_destroy(pages);
}
END_TEST

/* What cannot be read is no answer, and not what is farther. */
START_TEST(pages_that_fail_are_no_answer)
{
    failing_store context;
    cm_store *pages = store_that_fails(&context);
    const cm_octree_options with = paged_options(pages), without = paged_options(NULL);
    cm_octree *paged = make_map(&with), *whole = make_map(&without);
    for (uint64_t seed = 0; seed < 3; seed++)
    {
        ck_assert_int_eq(update_drawn(paged, camera, seed), CM_OK);
        ck_assert_int_eq(update_drawn(whole, camera, seed), CM_OK);
    }
    dice from = {5};
    int failures = 0;
    for (int i = 0; i < 300; i++)
    {
        double point[3], direction[3];
        for (int axis = 0; axis < 3; axis++)
        {
            point[axis] = dice_between(&from, -3.0, 3.0);
            direction[axis] = dice_between(&from, -1.0, 1.0);
        }
        cm_voxel right, found;
        const int is_near = cm_octree_nearest(whole, point, 3.0, &right);
        context.calls_until_failure = i % 3;
        const int is_found = cm_octree_nearest(paged, point, 3.0, &found);
        failures += context.calls_until_failure < 0;
        ck_assert(!is_found || (is_near && memcmp(&right, &found, sizeof found) == 0));
        ck_assert(is_found || !is_near || context.calls_until_failure < 0);
        const int is_met = cm_octree_ray(whole, point, direction, 0.0, &right);
        context.calls_until_failure = i % 3;
        const int is_hit = cm_octree_ray(paged, point, direction, 0.0, &found);
        failures += context.calls_until_failure < 0;
        ck_assert(!is_hit || (is_met && memcmp(&right, &found, sizeof found) == 0));
        ck_assert(is_hit || !is_met || context.calls_until_failure < 0);
    }
    context.calls_until_failure = -1;
    ck_assert_msg(failures > 50, "%d failures", failures);
    ck_assert_str_eq(maps_differ(paged, whole), "");
    cm_octree_destroy(paged);
    cm_octree_destroy(whole);
    cm_store_destroy(pages);
}
END_TEST

START_TEST(saving_and_loading_fail_whole)
{
    failing_store context;
    cm_store *store = store_that_fails(&context);
    const cm_octree_options options = paged_options(NULL);
    cm_octree *octree = make_map(&options), *kept = make_map(&options), *back = NULL;
    ck_assert_int_eq(update_drawn(octree, camera, 0), CM_OK);
    ck_assert_int_eq(update_drawn(kept, camera, 0), CM_OK);
    ck_assert_int_eq(cm_octree_save(octree, store, NULL, 0), CM_OK);
    ck_assert_int_eq(update_drawn(octree, camera, 1), CM_OK);
    cm_status status = CM_ERROR_FILE;
    int call = 0;
    for (; status != CM_OK; call += 5)
    {
        context.calls_until_failure = call;
        status = cm_octree_save(octree, store, NULL, 0);
        context.calls_until_failure = -1;
        ck_assert(status == CM_OK || status == CM_ERROR_FILE);
        ck_assert_int_eq(cm_octree_load(store, NULL, &back), CM_OK);
        ck_assert_str_eq(maps_differ(back, status == CM_OK ? octree : kept), "");
        cm_octree_destroy(back);
    }
    ck_assert_int_gt(call, 10);
    status = CM_ERROR_FILE;
    for (call = 0; status != CM_OK; call++)
    {
        back = NULL;
        context.calls_until_failure = call;
        status = cm_octree_load(store, NULL, &back);
        ck_assert(status == CM_OK ? back != NULL : status == CM_ERROR_FILE && back == NULL);
    }
    context.calls_until_failure = -1;
    cm_octree_destroy(back);
    cm_octree_destroy(kept);
    cm_octree_destroy(octree);
    cm_store_destroy(store);
}
END_TEST

/* ---- damage ---- */

START_TEST(damaged_blobs_are_refused)
{
    cm_store *store = memory_store();
    const cm_octree_options options = paged_options(NULL);
    cm_octree *octree = make_map(&options), *back = NULL;
    ck_assert_int_eq(update_drawn(octree, camera, 0), CM_OK);
    ck_assert_int_eq(cm_octree_save(octree, store, "abc", 3), CM_OK);
    unsigned char bytes[CM_STORE_KEY_MAX];
    size_t count = 0;
    cm_store_key key = {bytes, 0};
    dice from = {4};
    int refused = 0;
    for (cm_status s = cm_store_next(store, NULL, bytes, &count); s == CM_OK && count > 0;)
    {
        key.count = count;
        const uint32_t kind = bytes[0] == 'm'   ? 0x4f434d4du
                              : bytes[0] == 't' ? 0x4f435454u
                              : bytes[0] == 'u' ? 0x4f435555u
                                                : 0x4f435252u;
        cm_blob blob = {.size = sizeof blob};
        ck_assert_int_eq(cm_store_get(store, &key, kind, 1, &blob), CM_OK);
        const size_t length = blob.count;
        for (int i = 0; i < 4; i++)
        {
            unsigned char *damaged = malloc(length + 1);
            memcpy(damaged, blob.data, length);
            const size_t at = (size_t)((double)length * throw_dice(&from));
            damaged[at] = (unsigned char)(damaged[at] ^ (1 << i * 2));
            cm_blob other = blob;
            other.data = damaged;
            other.count = i == 3 ? at : length;
            other.version = i == 2 ? 77 : blob.version;
            ck_assert_int_eq(cm_store_put(store, &key, &other), CM_OK);
            back = NULL;
            const cm_status status = cm_octree_load(store, NULL, &back);
            ck_assert(status != CM_OK || back != NULL);
            ck_assert_msg(status == CM_OK || status == CM_ERROR_DATA || status == CM_ERROR_VERSION,
                          "%d", (int)status);
            ck_assert(i < 2 || bytes[0] == 'u' || status != CM_OK);
            if (status == CM_OK)
            {
                size_t cells;
                cm_octree_extract(back, 2, 0, NULL, &cells);
                update_drawn(back, camera, 5);
                cm_octree_compact(back);
                cm_octree_destroy(back);
            }
            refused += status != CM_OK;
            free(damaged);
        }
        ck_assert_int_eq(cm_store_put(store, &key, &blob), CM_OK);
        cm_blob_clear(&blob);
        s = cm_store_next(store, &key, bytes, &count);
    }
    ck_assert_int_gt(refused, 10);
    ck_assert_int_eq(cm_octree_load(store, NULL, &back), CM_OK);
    ck_assert_str_eq(maps_differ(back, octree), "");
    cm_octree_destroy(back);
    cm_octree_destroy(octree);
    cm_store_destroy(store);
}
END_TEST

/* Bits of free space and of colors that this version has no word for, and numbers beyond all that it knows. */
START_TEST(what_a_newer_version_says_is_not_dropped)
{
    cm_store *store = memory_store();
    const cm_octree_options options = paged_options(NULL);
    cm_octree *octree = make_map(&options), *back = NULL;
    ck_assert_int_eq(cm_octree_save(octree, store, NULL, 0), CM_OK);
    const cm_store_key key = {"m", 1};
    cm_blob blob = {.size = sizeof blob};
    ck_assert_int_eq(cm_store_get(store, &key, 0x4f434d4du, 1, &blob), CM_OK);
    for (int field = 0; field < 4; field++) /* levels, rule, free space, colors */
    {
        for (int bit = 0; bit < 32; bit++)
        {
            const int is_known = field == 2 ? bit < 2 : field == 3 && bit == 0;
            if (is_known || (field < 2 && bit < 5))
            {
                continue;
            }
            unsigned char *byte = (unsigned char *)blob.data + 4 * field + bit / 8;
            *byte = (unsigned char)(*byte ^ 1 << bit % 8);
            ck_assert_int_eq(cm_store_put(store, &key, &blob), CM_OK);
            const cm_status status = cm_octree_load(store, NULL, &back);
            ck_assert_msg(status == (field < 2 ? CM_ERROR_DATA : CM_ERROR_VERSION) && back == NULL,
                          "field %d, bit %d: %d", field, bit, (int)status);
            *byte = (unsigned char)(*byte ^ 1 << bit % 8);
        }
    }
    ck_assert_int_eq(cm_store_put(store, &key, &blob), CM_OK);
    ck_assert_int_eq(cm_octree_load(store, NULL, &back), CM_OK);
    cm_blob_clear(&blob);
    cm_octree_destroy(back);
    cm_octree_destroy(octree);
    cm_store_destroy(store);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {pages_change_nothing,
                                  what_is_saved_is_loaded,
                                  old_pages_do_not_come_back,
                                  pages_of_what_became_even_go,
                                  pages_that_fail_leave_a_whole_map,
                                  pages_that_fail_are_no_answer,
                                  saving_and_loading_fail_whole,
                                  damaged_blobs_are_refused,
                                  what_a_newer_version_says_is_not_dropped,
                                  NULL};
    camera = straight_camera(60, 44, 0.5);
    const int result = run_suite("octree keep", tests);
    cm_camera_destroy(camera);
    return result;
}
