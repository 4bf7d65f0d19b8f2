/* SPDX-License-Identifier: MIT
 *
 * Maps from damaged files. After a letter 'O' the input is a map of OctoMap: it is read, or refused in one line. Else a good map
 * is saved into a store, triples of the input replace bytes of its blobs, or cut them, and what is loaded is a map that can be
 * asked, changed and saved, or is refused.
 */
#include <cubemap/octree.h>

#include "modules/octree/io/octomap_file.h"

#include "fuzz.h"

enum
{
    KEYS_MOST = 64,
    BLOB_MOST = 1 << 20
};

static int count_voxel(void *user, const cm_voxel *voxel)
{
    EXPECT(voxel->edge > 0.0, "an edge of nothing");
    return ++*(int *)user > 20000;
}

static void ask(cm_octree *map)
{
    const double least[3] = {-1.0, -1.0, -1.0};
    const double greatest[3] = {1.0, 1.0, 1.0};
    const double ahead[3] = {1.0, 0.3, 0.2};
    int count = 0;
    cm_voxel voxel;
    (void)cm_octree_walk_box(map, least, greatest, count_voxel, &count);
    (void)cm_octree_ray(map, least, ahead, 3.0, &voxel);
    const int state = cm_octree_at(map, least, 0, &voxel);
    EXPECT(state == (int)voxel.state, "state %d", state);
}

static void change(cm_octree *map)
{
    const float point[6] = {0.3f, 0.2f, 0.1f, -0.4f, 0.1f, 0.0f};
    const double origin[3] = {0.0, 0.0, 0.0};
    (void)cm_octree_update_points(map, origin, 2, point, NULL);
    (void)cm_octree_compact(map);
    ask(map);
}

static void read_octomap(supply *from)
{
    cm_octree *map = NULL;
    char message[CM_IMAGE_MESSAGE] = "";
    const cm_status status = cm_octomap_parse("it", from->at, from->left, &map, message);
    if (status == CM_OK)
    {
        ask(map);
    }
    else
    {
        EXPECT(map == NULL && strncmp(message, "it: ", 4) == 0 && is_one_line(message), "%d: %s",
               (int)status, message);
    }
    cm_octree_destroy(map);
}

static cm_store *good_store(void)
{
    const cm_octree_options options = {
        .size = sizeof options, .edge = 0.05, .levels = 9, .color = 1};
    cm_octree *map = NULL;
    cm_store *store = NULL;
    EXPECT(cm_octree_create(&options, &map) == CM_OK && cm_store_create_in_memory(&store) == CM_OK,
           "no memory");
    float point[3 * 60];
    uint8_t color[3 * 60];
    for (int i = 0; i < 3 * 60; i++)
    {
        point[i] = (float)((i * 37) % 101) / 40.0f - 1.2f;
        color[i] = (uint8_t)(i * 5);
    }
    const double origin[3] = {0.01, 0.02, 0.03};
    EXPECT(cm_octree_update_points(map, origin, 60, point, color) == CM_OK, "points");
    EXPECT(cm_octree_save(map, store, "note", 4) == CM_OK, "save");
    cm_octree_destroy(map);
    return store;
}

static size_t keys_of(cm_store *store, unsigned char keys[KEYS_MOST][CM_STORE_KEY_MAX],
                      size_t counts[KEYS_MOST])
{
    size_t found = 0;
    cm_store_key after = {NULL, 0};
    while (found < KEYS_MOST &&
           cm_store_next(store, found == 0 ? NULL : &after, keys[found], &counts[found]) == CM_OK &&
           counts[found] > 0)
    {
        after = (cm_store_key){keys[found], counts[found]};
        found++;
    }
    return found;
}

/* A blob whose kind is not told is got with the one that the store asks for: its versions and kinds are damaged by others. */
static void damage(cm_store *store, const cm_store_key *key, uint32_t word)
{
    static unsigned char bytes[BLOB_MOST];
    for (uint32_t kind = 0; kind < 64; kind++)
    {
        cm_blob blob = {.size = sizeof blob};
        if (cm_store_get(store, key, kind, UINT32_MAX, &blob) != CM_OK || blob.count == 0 ||
            blob.count > BLOB_MOST)
        {
            cm_blob_clear(&blob);
            continue;
        }
        memcpy(bytes, blob.data, blob.count);
        const size_t place = (word >> 8) % blob.count;
        bytes[place] = (unsigned char)word;
        cm_blob other = blob;
        other.data = bytes;
        other.count = (word >> 28) == 15 ? place : blob.count;
        EXPECT(cm_store_put(store, key, &other) == CM_OK, "put");
        cm_blob_clear(&blob);
        return;
    }
}

static void load(cm_store *store, int pages)
{
    const cm_octree_options options = {.size = sizeof options, .pages = store, .memory = 1 << 20};
    cm_octree *map = NULL;
    const cm_status status = cm_octree_load(store, pages ? &options : NULL, &map);
    if (status != CM_OK)
    {
        EXPECT(map == NULL, "%d, and a map", (int)status);
        return;
    }
    size_t count = 0;
    const void *note = cm_octree_user_data(map, &count);
    EXPECT((note == NULL) == (count == 0), "%zu bytes of note", count);
    ask(map);
    change(map);
    (void)cm_octree_save(map, store, note, count);
    cm_octree_destroy(map);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    supply from = {data, size};
    const uint8_t letter = take_byte(&from);
    if (letter == 'O')
    {
        read_octomap(&from);
        return 0;
    }
    static unsigned char keys[KEYS_MOST][CM_STORE_KEY_MAX];
    size_t counts[KEYS_MOST];
    cm_store *store = good_store();
    const size_t found = keys_of(store, keys, counts);
    EXPECT(found > 1, "%zu keys", found);
    while (from.left >= 5)
    {
        const size_t which = take_byte(&from) % found;
        const cm_store_key key = {keys[which], counts[which]};
        damage(store, &key, take_word(&from));
    }
    load(store, letter % 2);
    cm_store_destroy(store);
    return 0;
}
