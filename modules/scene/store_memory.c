/* SPDX-License-Identifier: MIT
 *
 * A store in memory: a tree of keys, and the list of changes since the last commit, by which they can be undone without
 * any memory.
 */
#include <cubemap/store.h>

#include "modules/memory/checked_size.h"

#include <stdlib.h>
#include <string.h>

/* A key with its blob behind it. The tree is a treap (Seidel & Aragon 1996): in the order of keys across, of random
 * priorities down, so that its depth is of the order of log n whatever order keys come in. */
typedef struct node
{
    struct node *left, *right;
    uint64_t priority;
    uint32_t kind, version;
    size_t count;
    size_t key_count;
    unsigned char bytes[]; /* the key, then the blob */
} node;

/* What was in the tree went, and what came in its place. Either may be NULL. */
typedef struct change
{
    node *went, *came;
} change;

typedef struct memory_store
{
    node *root;
    change *changes;
    size_t change_count, change_room;
    uint64_t random;
    int failed; /* a change had no memory: only rollback helps */
    const char *message;
} memory_store;

static int compare(const node *a, const cm_store_key *key)
{
    const size_t least = a->key_count < key->count ? a->key_count : key->count;
    const int order = least == 0 ? 0 : memcmp(a->bytes, key->bytes, least);
    return order != 0 ? order : (a->key_count > key->count) - (a->key_count < key->count);
}

static cm_store_key key_of(const node *of)
{
    return (cm_store_key){of->bytes, of->key_count};
}

/* Keys below this one to the left, the others to the right. */
static void split(node *tree, const cm_store_key *key, node **left, node **right)
{
    while (tree != NULL)
    {
        if (compare(tree, key) < 0)
        {
            *left = tree;
            left = &tree->right;
            tree = tree->right;
        }
        else
        {
            *right = tree;
            right = &tree->left;
            tree = tree->left;
        }
    }
    *left = NULL;
    *right = NULL;
}

/* All keys of the left are below those of the right. */
static node *join(node *left, node *right)
{
    node *root = NULL;
    node **at = &root;
    while (left != NULL && right != NULL)
    {
        if (left->priority > right->priority)
        {
            *at = left;
            at = &left->right;
            left = left->right;
        }
        else
        {
            *at = right;
            at = &right->left;
            right = right->left;
        }
    }
    *at = left != NULL ? left : right;
    return root;
}

static node *find(node *tree, const cm_store_key *key)
{
    while (tree != NULL)
    {
        const int order = compare(tree, key);
        if (order == 0)
        {
            return tree;
        }
        tree = order < 0 ? tree->right : tree->left;
    }
    return NULL;
}

/* Out of the tree: NULL if it is not there. */
static node *take(node **tree, const cm_store_key *key)
{
    while (*tree != NULL)
    {
        const int order = compare(*tree, key);
        if (order == 0)
        {
            node *found = *tree;
            *tree = join(found->left, found->right);
            return found;
        }
        tree = order < 0 ? &(*tree)->right : &(*tree)->left;
    }
    return NULL;
}

/* Into the tree, which has no such key. */
static void insert(node **tree, node *in)
{
    const cm_store_key key = key_of(in);
    while (*tree != NULL && (*tree)->priority >= in->priority)
    {
        tree = compare(*tree, &key) < 0 ? &(*tree)->right : &(*tree)->left;
    }
    split(*tree, &key, &in->left, &in->right);
    *tree = in;
}

static cm_status fail(memory_store *store)
{
    store->failed = 1;
    store->message = "a change found no memory; what is not committed has to be rolled back";
    return CM_ERROR_MEMORY;
}

/* Room for one more change. */
static int has_room(memory_store *store)
{
    if (store->change_count < store->change_room)
    {
        return 1;
    }
    const size_t room = store->change_room == 0 ? 16 : 2 * store->change_room;
    change *more = cm_array_resized(store->changes, room, sizeof *more);
    if (more == NULL)
    {
        return 0;
    }
    store->changes = more;
    store->change_room = room;
    return 1;
}

static cm_status get(void *context, const cm_store_key *key, cm_blob *blob)
{
    memory_store *store = context;
    const node *found = find(store->root, key);
    if (found == NULL)
    {
        return CM_OK;
    }
    void *data = malloc(found->count == 0 ? 1 : found->count);
    if (data == NULL)
    {
        store->message = "the blob found no memory";
        return CM_ERROR_MEMORY;
    }
    memcpy(data, found->bytes + found->key_count, found->count);
    *blob = (cm_blob){.size = sizeof *blob,
                      .kind = found->kind,
                      .version = found->version,
                      .data = data,
                      .count = found->count};
    return CM_OK;
}

static cm_status put(void *context, const cm_store_key *key, const cm_blob *blob)
{
    memory_store *store = context;
    const size_t most = SIZE_MAX / 2 - sizeof(node) - CM_STORE_KEY_MAX;
    node *made = store->failed || blob->count > most || !has_room(store)
                     ? NULL
                     : malloc(sizeof *made + key->count + blob->count);
    if (made == NULL)
    {
        return fail(store);
    }
    /* Marsaglia 2003, "Xorshift RNGs", p. 4 */
    store->random ^= store->random << 13;
    store->random ^= store->random >> 7;
    store->random ^= store->random << 17;
    *made = (node){.priority = store->random,
                   .kind = blob->kind,
                   .version = blob->version,
                   .count = blob->count,
                   .key_count = key->count};
    memcpy(made->bytes, key->bytes, key->count);
    if (blob->count > 0)
    {
        memcpy(made->bytes + key->count, blob->data, blob->count);
    }
    node *went = take(&store->root, key);
    insert(&store->root, made);
    store->changes[store->change_count++] = (change){went, made};
    return CM_OK;
}

static cm_status remove_key(void *context, const cm_store_key *key)
{
    memory_store *store = context;
    if (store->failed || !has_room(store))
    {
        return fail(store);
    }
    node *went = take(&store->root, key);
    if (went != NULL)
    {
        store->changes[store->change_count++] = (change){went, NULL};
    }
    return CM_OK;
}

static cm_status next(void *context, const cm_store_key *after, unsigned char key[CM_STORE_KEY_MAX],
                      size_t *count)
{
    const memory_store *store = context;
    const node *first = NULL;
    for (const node *at = store->root; at != NULL;)
    {
        const int above = compare(at, after) > 0;
        first = above ? at : first;
        at = above ? at->left : at->right;
    }
    *count = first == NULL ? 0 : first->key_count;
    if (first != NULL)
    {
        memcpy(key, first->bytes, first->key_count);
    }
    return CM_OK;
}

static cm_status commit(void *context)
{
    memory_store *store = context;
    if (store->failed)
    {
        return fail(store);
    }
    for (size_t i = 0; i < store->change_count; i++)
    {
        free(store->changes[i].went);
    }
    store->change_count = 0;
    return CM_OK;
}

static cm_status rollback(void *context)
{
    memory_store *store = context;
    while (store->change_count > 0)
    {
        const change last = store->changes[--store->change_count];
        if (last.came != NULL)
        {
            const cm_store_key key = key_of(last.came);
            free(take(&store->root, &key));
        }
        if (last.went != NULL)
        {
            insert(&store->root, last.went);
        }
    }
    store->failed = 0;
    store->message = "";
    return CM_OK;
}

static const char *message(void *context)
{
    const memory_store *store = context;
    return store->message;
}

static void destroy(void *context)
{
    memory_store *store = context;
    for (size_t i = 0; i < store->change_count; i++)
    {
        free(store->changes[i].went);
    }
    while (store->root != NULL)
    {
        /* the left branch first, without recursion: turned to the right until there is none */
        node *root = store->root;
        if (root->left == NULL)
        {
            store->root = root->right;
            free(root);
            continue;
        }
        node *left = root->left;
        root->left = left->right;
        left->right = root;
        store->root = left;
    }
    free(store->changes);
    free(store);
}

cm_status cm_store_create_in_memory(cm_store **store)
{
    static const cm_store_methods methods = {
        .size = sizeof methods,
        .get = get,
        .put = put,
        .remove = remove_key,
        .next = next,
        .commit = commit,
        .rollback = rollback,
        .message = message,
        .destroy = destroy,
    };
    if (store == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    memory_store *made = malloc(sizeof *made);
    if (made == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    *made = (memory_store){.random = 88172645463325252u, .message = ""};
    const cm_status status = cm_store_create(&methods, made, store);
    if (status != CM_OK)
    {
        free(made);
    }
    return status;
}
