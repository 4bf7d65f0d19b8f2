/* SPDX-License-Identifier: MIT
 *
 * A map in a store: "m" has its options and its step, "t" its nodes above regions, "u" what the user adds, and "r" with a number
 * each of its regions (page.c). Numbers are little-endian.
 */
#include <stdlib.h>
#include <string.h>

#include "node_tree.h"
#include "page.h"

#define MAP_KIND 0x4f434d4du  /* "MMCO" */
#define TREE_KIND 0x4f435454u /* "TTCO" */
#define USER_KIND 0x4f435555u /* "UUCO" */
#define KEEP_VERSION 1u

#define USER_MOST 65536u

/* Bits of what is said of free space. */
#define NO_RETURN_IS_FREE 1u
#define ENDPOINTS_ONLY 2u
/* and of colors */
#define HAS_COLOR 1u

/* ---- numbers ---- */

typedef struct byte_list
{
    unsigned char *byte;
    size_t count;
    size_t room;
    int failed;
} byte_list;

static void put(byte_list *list, uint64_t value, unsigned bytes)
{
    if (list->count + bytes > list->room)
    {
        const size_t room = list->room == 0 ? 4096 : 2 * list->room;
        unsigned char *more = realloc(list->byte, room);
        if (more == NULL)
        {
            list->failed = 1;
            return;
        }
        list->byte = more;
        list->room = room;
    }
    for (unsigned i = 0; i < bytes; i++)
    {
        list->byte[list->count++] = (unsigned char)(value >> 8 * i);
    }
}

static void put_double(byte_list *list, double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    put(list, bits, 8);
}

typedef struct byte_reader
{
    const unsigned char *at;
    size_t left;
    int failed;
} byte_reader;

static uint64_t get(byte_reader *reader, unsigned bytes)
{
    uint64_t value = 0;
    if (reader->left < bytes)
    {
        reader->failed = 1;
        return 0;
    }
    for (unsigned i = 0; i < bytes; i++)
    {
        value |= (uint64_t)reader->at[i] << 8 * i;
    }
    reader->at += bytes;
    reader->left -= bytes;
    return value;
}

static double get_double(byte_reader *reader)
{
    const uint64_t bits = get(reader, 8);
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static cm_status put_blob(cm_store *store, const char *name, uint32_t kind, const byte_list *list)
{
    const cm_store_key key = {name, 1};
    const cm_blob blob = {sizeof blob, kind, KEEP_VERSION, list->byte, list->count};
    return list->failed ? CM_ERROR_MEMORY : cm_store_put(store, &key, &blob);
}

/* ---- options ---- */

static void write_options(const cm_octree *octree, byte_list *list)
{
    const cm_octree_options *o = &octree->options;
    put(list, (uint64_t)o->levels, 4);
    put(list, (uint64_t)o->rule, 4);
    put(list,
        (o->no_return_is_free ? NO_RETURN_IS_FREE : 0u) | (o->endpoints_only ? ENDPOINTS_ONLY : 0u),
        4);
    put(list, o->color != 0 ? HAS_COLOR : 0u, 4);
    put(list, octree->step, 4);
    const double numbers[] = {o->edge, o->centre[0], o->centre[1], o->centre[2],
                              o->hit,  o->miss,      o->low,       o->high,
                              o->near, o->far,       o->noise,     o->footprint};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
    {
        put_double(list, numbers[i]);
    }
}

/* A small number, or one that none of the options may be. */
static int get_small(byte_reader *reader)
{
    const uint64_t value = get(reader, 4);
    return value <= INT16_MAX ? (int)value : INT16_MAX;
}

/* Bits that this version does not know are of a newer one: what they say would be lost. */
static cm_status read_options(byte_reader *reader, cm_octree_options *o, uint32_t *step)
{
    o->levels = get_small(reader);
    o->rule = get_small(reader);
    const uint64_t flags = get(reader, 4), color = get(reader, 4);
    o->no_return_is_free = (flags & NO_RETURN_IS_FREE) != 0;
    o->endpoints_only = (flags & ENDPOINTS_ONLY) != 0;
    o->color = (color & HAS_COLOR) != 0;
    *step = (uint32_t)get(reader, 4);
    double *const numbers[] = {&o->edge, &o->centre[0], &o->centre[1], &o->centre[2],
                               &o->hit,  &o->miss,      &o->low,       &o->high,
                               &o->near, &o->far,       &o->noise,     &o->footprint};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
    {
        *numbers[i] = get_double(reader);
    }
    if (reader->failed || reader->left > 0)
    {
        return CM_ERROR_DATA;
    }
    const int is_newer =
        (flags & ~(uint64_t)(NO_RETURN_IS_FREE | ENDPOINTS_ONLY)) != 0 || color > HAS_COLOR;
    return is_newer ? CM_ERROR_VERSION : CM_OK;
}

/* ---- nodes ---- */

/* In the order of keys, each before its children; regions are in the store then. */
static void write_node(const cm_octree *octree, uint32_t index, byte_list *list)
{
    const cm_node *node = &octree->node[index];
    put(list, node->kind == CM_NODE_REGION ? CM_NODE_PAGED : node->kind, 1);
    put(list, node->value, 1);
    put(list, node->changed, 4);
    for (uint32_t child = 0; node->kind == CM_NODE_INNER && child < 8; child++)
    {
        write_node(octree, node->link + child, list);
    }
}

static cm_status read_node(cm_octree *octree, uint32_t index, int level, byte_reader *reader)
{
    const unsigned kind = (unsigned)get(reader, 1);
    const uint8_t value = (uint8_t)get(reader, 1);
    const uint32_t changed = (uint32_t)get(reader, 4);
    const int is_good = kind == CM_NODE_LEAF ||
                        (kind == CM_NODE_INNER && level > CM_REGION_LEVEL) ||
                        (kind == CM_NODE_PAGED && level == CM_REGION_LEVEL);
    if (reader->failed || !is_good)
    {
        return CM_ERROR_DATA;
    }
    cm_status status = CM_OK;
    if (kind == CM_NODE_INNER)
    {
        if (!cm_node_divide(octree, index))
        {
            return CM_ERROR_MEMORY;
        }
        for (uint32_t child = 0; status == CM_OK && child < 8; child++)
        {
            status = read_node(octree, octree->node[index].link + child, level - 1, reader);
        }
    }
    cm_node *node = &octree->node[index];
    node->kind = (uint8_t)kind;
    node->value = value;
    node->changed = changed;
    return status;
}

/* ---- saving ---- */

/* What an older map has left there. */
static cm_status remove_regions(cm_store *store)
{
    unsigned char key[CM_STORE_KEY_MAX];
    size_t count = 0;
    cm_store_key after = {"r", 1};
    cm_status status = cm_store_next(store, &after, key, &count);
    while (status == CM_OK && count > 0 && key[0] == 'r')
    {
        const cm_store_key this_key = {key, count};
        status = cm_store_remove(store, &this_key);
        status = status == CM_OK ? cm_store_next(store, &this_key, key, &count) : status;
    }
    return status;
}

static cm_status save_node(cm_octree *octree, cm_store *store, uint32_t index,
                           const uint32_t place[3], int level)
{
    const cm_node *node = &octree->node[index];
    const int is_pages = store == octree->options.pages;
    cm_status status = CM_OK;
    if (node->kind == CM_NODE_INNER)
    {
        for (uint32_t child = 0; status == CM_OK && child < 8; child++)
        {
            uint32_t below[3];
            for (int axis = 0; axis < 3; axis++)
            {
                below[axis] = place[axis] + ((child >> axis & 1u) << (level - 1));
            }
            status = save_node(octree, store, node->link + child, below, level - 1);
        }
    }
    else if (node->kind == CM_NODE_REGION)
    {
        cm_region *region = octree->region[node->link];
        if (!is_pages || region->is_dirty)
        {
            octree->bytes -= cm_region_size(region);
            status = cm_page_put(octree, store, region);
            octree->bytes += cm_region_size(region);
        }
    }
    else if (node->kind == CM_NODE_PAGED && !is_pages)
    {
        cm_region *region = NULL;
        status = cm_page_get(octree, octree->options.pages, place, &region);
        status = status == CM_OK ? cm_page_put(octree, store, region) : status;
        cm_region_drop(region);
    }
    return status;
}

static cm_status save_all(cm_octree *octree, cm_store *store, const void *user_data, size_t count)
{
    const uint32_t first[3] = {0, 0, 0};
    byte_list options = {0}, tree = {0}, user = {0};
    cm_status status = store == octree->options.pages ? CM_OK : remove_regions(store);
    status = status == CM_OK ? save_node(octree, store, 0, first, octree->tree_level) : status;
    write_options(octree, &options);
    write_node(octree, 0, &tree);
    for (size_t i = 0; i < count; i++)
    {
        put(&user, ((const unsigned char *)user_data)[i], 1);
    }
    status = status == CM_OK ? put_blob(store, "m", MAP_KIND, &options) : status;
    status = status == CM_OK ? put_blob(store, "t", TREE_KIND, &tree) : status;
    status = status == CM_OK ? put_blob(store, "u", USER_KIND, &user) : status;
    free(options.byte);
    free(tree.byte);
    free(user.byte);
    return status == CM_OK ? cm_store_commit(store) : status;
}

cm_status cm_octree_save(cm_octree *octree, cm_store *store, const void *user_data, size_t count)
{
    if (octree == NULL || store == NULL || (user_data == NULL && count > 0) || count > USER_MOST)
    {
        return CM_ERROR_ARGUMENT;
    }
    const cm_status status = save_all(octree, store, user_data, count);
    const int is_pages = store == octree->options.pages;
    if (status != CM_OK && !is_pages)
    {
        cm_store_rollback(store); /* pages have what is nowhere else: they are left as they are */
    }
    for (size_t i = 0; status == CM_OK && is_pages && i < octree->region_count; i++)
    {
        if (octree->region[i] != NULL)
        {
            octree->region[i]->is_dirty = 0;
        }
    }
    return status;
}

/* ---- loading ---- */

static cm_status get_blob(cm_store *store, const char *name, uint32_t kind, cm_blob *blob)
{
    const cm_store_key key = {name, 1};
    *blob = (cm_blob){.size = sizeof *blob};
    const cm_status status = cm_store_get(store, &key, kind, KEEP_VERSION, blob);
    return status == CM_OK && blob->data == NULL ? CM_ERROR_DATA : status;
}

static cm_status make_map(cm_store *store, const cm_octree_options *options, cm_octree **octree)
{
    cm_blob blob;
    cm_status status = get_blob(store, "m", MAP_KIND, &blob);
    if (status != CM_OK)
    {
        return status;
    }
    cm_octree_options kept = {.size = sizeof kept};
    uint32_t step = 0;
    byte_reader reader = {blob.data, blob.count, 0};
    status = read_options(&reader, &kept, &step);
    cm_blob_clear(&blob);
    if (options != NULL)
    {
        kept.memory = options->memory;
        kept.pages = options->pages;
        kept.instructions = options->instructions;
    }
    status = status == CM_OK ? cm_octree_create(&kept, octree) : status;
    if (status == CM_OK)
    {
        (*octree)->step = step;
    }
    return status == CM_ERROR_RANGE ? CM_ERROR_DATA : status;
}

static cm_status load_regions(cm_octree *octree, cm_store *store, uint32_t index,
                              const uint32_t place[3], int level)
{
    cm_status status = CM_OK;
    if (octree->node[index].kind == CM_NODE_PAGED)
    {
        cm_region *region = NULL;
        status = cm_page_get(octree, store, place, &region);
        return status == CM_OK ? cm_node_take_region(octree, index, region) : status;
    }
    for (uint32_t child = 0;
         status == CM_OK && octree->node[index].kind == CM_NODE_INNER && child < 8; child++)
    {
        uint32_t below[3];
        for (int axis = 0; axis < 3; axis++)
        {
            below[axis] = place[axis] + ((child >> axis & 1u) << (level - 1));
        }
        status = load_regions(octree, store, octree->node[index].link + child, below, level - 1);
    }
    return status;
}

static cm_status load_tree(cm_octree *octree, cm_store *store)
{
    cm_blob blob;
    cm_status status = get_blob(store, "t", TREE_KIND, &blob);
    if (status != CM_OK)
    {
        return status;
    }
    byte_reader reader = {blob.data, blob.count, 0};
    status = read_node(octree, 0, octree->tree_level, &reader);
    status = status == CM_OK && reader.left > 0 ? CM_ERROR_DATA : status;
    cm_blob_clear(&blob);
    return status;
}

static cm_status load_user_data(cm_octree *octree, cm_store *store)
{
    cm_blob blob;
    const cm_status status = get_blob(store, "u", USER_KIND, &blob);
    if (status == CM_OK)
    {
        octree->user_data = blob.data;
        octree->user_data_count = blob.count;
    }
    return status;
}

cm_status cm_octree_load(cm_store *store, const cm_octree_options *options, cm_octree **octree)
{
    if (store == NULL || octree == NULL ||
        (options != NULL &&
         (options->size != sizeof *options || (options->pages != NULL && options->pages != store))))
    {
        return CM_ERROR_ARGUMENT;
    }
    cm_octree *made = NULL;
    cm_status status = make_map(store, options, &made);
    status = status == CM_OK ? load_tree(made, store) : status;
    if (status == CM_OK && made->options.pages == NULL)
    {
        const uint32_t first[3] = {0, 0, 0};
        status = load_regions(made, store, 0, first, made->tree_level);
    }
    status = status == CM_OK ? load_user_data(made, store) : status;
    if (status != CM_OK)
    {
        cm_octree_destroy(made);
        return status;
    }
    *octree = made;
    return CM_OK;
}

const void *cm_octree_user_data(const cm_octree *octree, size_t *count)
{
    *count = octree->user_data_count;
    return octree->user_data_count > 0 ? octree->user_data : NULL;
}
