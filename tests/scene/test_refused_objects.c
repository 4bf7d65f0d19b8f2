/* SPDX-License-Identifier: MIT
 *
 * Rays, depth images, drawing, meshes, worlds and stores in memory where the system has none: each allocation fails once,
 * which is told; outputs stay as they were, all blocks are given back, and what was there is as before.
 */
#include <cubemap/depth.h>
#include <cubemap/mesh.h>
#include <cubemap/raster.h>
#include <cubemap/store.h>
#include <cubemap/world.h>

#include "drawn_box.h"
#include "tests/refused_allocation.h"

enum
{
    PIXELS = 160 * 120,
    BLOBS = 40
};

static some_camera camera;
static cm_rays *rays;
static float image[PIXELS], made_image[PIXELS], maps_made[7][PIXELS];
static cm_scene *world;
static cm_store *store;

/* Makes something and, if that went well, destroys it: *output must be NULL otherwise. */
typedef cm_status (*trial)(void **output);

static cm_status make_rays(void **output)
{
    cm_rays *made = NULL;
    const cm_status status = cm_rays_create(camera.camera, NULL, &made);
    *output = made;
    if (status == CM_OK)
    {
        cm_rays_destroy(made);
        *output = NULL;
    }
    return status;
}

static cm_status make_pyramid(void **output)
{
    cm_depth_pyramid *made = NULL;
    const cm_status status = cm_depth_pyramid_create(160, 120, NULL, &made);
    *output = made;
    if (status == CM_OK)
    {
        cm_depth_pyramid_destroy(made);
        *output = NULL;
    }
    return status;
}

static cm_status clean(void **output)
{
    const cm_image picture = {.size = sizeof picture,
                              .data = image,
                              .type = CM_PIXEL_FLOAT,
                              .width = 160,
                              .height = 120,
                              .channels = 1};
    const cm_depth_limits limits = {.size = sizeof limits, .unit = 1.0};
    cm_depth_count count = {.size = sizeof count};
    const cm_status status = cm_depth_clean(&picture, &limits, 1, made_image, &count);
    *output = status != CM_OK && count.valid != 0 ? &camera : NULL;
    return status;
}

static cm_status make_maps(void **output)
{
    (void)output;
    cm_depth_maps maps = {.size = sizeof maps, .radius = maps_made[6]};
    for (int k = 0; k < 3; k++)
    {
        maps.vertex[k] = maps_made[k];
        maps.normal[k] = maps_made[3 + k];
    }
    return cm_depth_make_maps(rays, image, 1, &maps);
}

static cm_status smooth(void **output)
{
    (void)output;
    return cm_depth_smooth(rays, image, 1.0, 0.1, 1, made_image);
}

static cm_status make_raster(void **output)
{
    cm_raster *made = NULL;
    const cm_status status = cm_raster_create(camera.camera, 0.0, NULL, &made);
    *output = made;
    if (status == CM_OK)
    {
        cm_raster_destroy(made);
        *output = NULL;
    }
    return status;
}

static cm_status make_mesh(void **output)
{
    static const double position[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    static const float color[4][3] = {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}};
    static const uint32_t index[] = {0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 2, 3};
    const cm_mesh_options options = {.size = sizeof options,
                                     .vertex_count = 4,
                                     .position = position[0],
                                     .color = color[0],
                                     .triangle_count = 4,
                                     .index = index,
                                     .material = {{1, 1, 1}, 1}};
    cm_mesh *made = NULL;
    const cm_status status = cm_mesh_create(&options, &made);
    *output = made;
    if (status == CM_OK)
    {
        cm_mesh_destroy(made);
        *output = NULL;
    }
    return status;
}

static cm_status make_world(void **output)
{
    cm_scene *made = NULL;
    const cm_status status = cm_scene_create_named("room", &made);
    *output = made;
    if (status == CM_OK)
    {
        cm_scene_destroy(made);
        *output = NULL;
    }
    return status;
}

/* So many that there must be more room for them; those that were added before stay. */
static cm_status add_to_world(void **output)
{
    const size_t before = cm_scene_count(world);
    const cm_primitive sphere = {.size = sizeof sphere,
                                 .kind = CM_PRIMITIVE_SPHERE,
                                 .radius = 1.0,
                                 .pose.rotation = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
                                 .material = {{1, 1, 1}, 1}};
    uint32_t id = 77;
    const cm_status status = cm_scene_add(world, &sphere, &id);
    const int is_right = status == CM_OK ? id == before && cm_scene_count(world) == before + 1
                                         : id == 77 && cm_scene_count(world) == before;
    *output = is_right ? NULL : &camera;
    return status;
}

static cm_status make_store(void **output)
{
    cm_store *made = NULL;
    const cm_status status = cm_store_create_in_memory(&made);
    *output = made;
    if (status == CM_OK)
    {
        cm_store_destroy(made);
        *output = NULL;
    }
    return status;
}

/* Returns how many allocations there are to fail. */
static int fail_each(trial call, const char *name)
{
    for (int i = 0;; i++)
    {
        void *output = NULL;
        const int before = blocks_alive();
        blocks_until_refusal = i;
        const cm_status status = call(&output);
        const int met = blocks_until_refusal < 0;
        blocks_until_refusal = -1;
        REQUIRE(output == NULL, "%s: allocation %d: something was touched", name, i);
        REQUIRE(status == (met ? CM_ERROR_MEMORY : CM_OK), "%s: allocation %d: %d", name, i,
                (int)status);
        if (!met)
        {
            return i;
        }
        REQUIRE(blocks_alive() == before, "%s: allocation %d: %d blocks are lost", name, i,
                blocks_alive() - before);
    }
}

START_TEST(objects_say_that_there_is_no_memory)
{
    static const struct
    {
        const char *name;
        trial call;
        int least; /* allocations, of the camera with the fewest */
    } calls[] = {{"rays", make_rays, 2}, {"pyramid", make_pyramid, 2}, {"clean", clean, 1},
                 {"maps", make_maps, 1}, {"smooth", smooth, 1},        {"raster", make_raster, 5},
                 {"mesh", make_mesh, 5}, {"room", make_world, 2},      {"store", make_store, 2}};
    for (int i = 0; i < PIXELS; i++)
    {
        image[i] = 2.0f + (float)(i % 7) * 0.01f;
    }
    for (int which = 0; which < CAMERAS; which++)
    {
        camera = camera_at(which);
        ck_assert_int_eq(cm_rays_create(camera.camera, NULL, &rays), CM_OK);
        for (size_t i = 0; i < sizeof calls / sizeof *calls; i++)
        {
            const int met = fail_each(calls[i].call, calls[i].name);
            REQUIRE(met >= calls[i].least, "%s: %d allocations", calls[i].name, met);
        }
        cm_rays_destroy(rays);
        drop(&camera);
    }
}
END_TEST

START_TEST(worlds_keep_what_they_have)
{
    int met = 0;
    ck_assert_int_eq(cm_scene_create(&world), CM_OK);
    for (int i = 0; i < 100; i++)
    {
        met += fail_each(add_to_world, "sphere");
    }
    REQUIRE(met >= 2 && cm_scene_count(world) == 100, "%d allocations", met);
    cm_scene_destroy(world);
}
END_TEST

static cm_status put_blob(unsigned char letter, unsigned char byte, size_t count)
{
    unsigned char data[300];
    memset(data, byte, sizeof data);
    const cm_store_key key = {&letter, 1};
    const cm_blob blob = {sizeof blob, 1, 2, data, count};
    return cm_store_put(store, &key, &blob);
}

/* What the last commit had: for each letter its own number of bytes. */
static void check_committed(void)
{
    for (unsigned char letter = 0; letter < BLOBS; letter++)
    {
        const cm_store_key key = {&letter, 1};
        cm_blob blob = {.size = sizeof blob};
        ck_assert_int_eq(cm_store_get(store, &key, 1, 2, &blob), CM_OK);
        REQUIRE(blob.data != NULL && blob.count == letter, "blob %d: %zu", letter, blob.count);
        cm_blob_clear(&blob);
    }
}

static cm_status get_blob(void **output)
{
    const unsigned char letter = 9;
    const cm_store_key key = {&letter, 1};
    cm_blob blob = {.size = sizeof blob};
    const cm_status status = cm_store_get(store, &key, 1, 2, &blob);
    *output = status == CM_OK ? NULL : blob.data;
    cm_blob_clear(&blob);
    return status;
}

/* Changes, of which one finds no memory: then all fail until they are undone. */
static cm_status change(int *undone)
{
    cm_status status = CM_OK;
    for (unsigned char letter = 0; letter < BLOBS && status == CM_OK; letter++)
    {
        const cm_store_key key = {&letter, 1};
        status = letter % 3 == 0 ? cm_store_remove(store, &key) : put_blob(letter, 99, 200);
    }
    if (status != CM_OK)
    {
        blocks_until_refusal = -1;
        ck_assert_int_eq(put_blob(1, 1, 1), CM_ERROR_MEMORY);
        ck_assert_int_eq(cm_store_commit(store), CM_ERROR_MEMORY);
        REQUIRE(cm_store_message(store)[0] != '\0', "no message");
    }
    *undone += status != CM_OK;
    return status;
}

START_TEST(stores_go_back_to_their_last_commit)
{
    const int blocks = blocks_alive();
    ck_assert_int_eq(cm_store_create_in_memory(&store), CM_OK);
    for (unsigned char letter = 0; letter < BLOBS; letter++)
    {
        ck_assert_int_eq(put_blob(letter, letter, letter), CM_OK);
    }
    ck_assert_int_eq(cm_store_commit(store), CM_OK);
    ck_assert_int_ge(fail_each(get_blob, "blob"), 1);
    int undone = 0;
    for (int i = 0;; i++)
    {
        const int before = undone;
        blocks_until_refusal = i;
        const cm_status status = change(&undone);
        blocks_until_refusal = -1;
        REQUIRE(status == CM_OK || status == CM_ERROR_MEMORY, "%d", (int)status);
        ck_assert_int_eq(cm_store_rollback(store), CM_OK);
        check_committed();
        if (undone == before)
        {
            break;
        }
    }
    ck_assert_int_ge(undone, BLOBS / 2);
    cm_store_destroy(store);
    ck_assert_int_eq(blocks_alive(), blocks);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {objects_say_that_there_is_no_memory, worlds_keep_what_they_have,
                                  stores_go_back_to_their_last_commit, NULL};
    return run_suite("refused objects", tests);
}
