/* SPDX-License-Identifier: MIT
 *
 * Stores: blobs under keys, changed in steps that are whole or not at all. Of the library cubemap-scene.
 *
 *   store     a table of functions: here is one in memory, and who has files makes others; modules see only this
 *   key       1 to CM_STORE_KEY_MAX bytes of any value; keys have the order of memcmp, a shorter one first
 *   blob      any bytes, none too, with a kind and a version of the caller's
 *   commit    what was put and removed is kept from then on. Before it, only this store sees it; rollback, and the end of the
 *             store, forget it
 *   failures  CM_ERROR_FILE and CM_ERROR_MEMORY of put, remove and commit leave what was committed as it was, and nothing
 *             but cm_store_rollback and reading is possible then: no step is kept in part. A disk that fails at a commit's
 *             very end may leave the step made, which nobody can undo: the message says so
 *   threads   one store is used by one thread at a time
 */
#ifndef CUBEMAP_STORE_H
#define CUBEMAP_STORE_H

#include <stddef.h>
#include <stdint.h>

#include <cubemap/export.h>
#include <cubemap/status.h>

#ifdef __cplusplus
extern "C" {
#endif

/* No key has more bytes. */
#define CM_STORE_KEY_MAX 255

/* A key. Its bytes belong to the caller. */
typedef struct cm_store_key
{
    const void *bytes; /* the first of them */
    size_t count;      /* 1 to CM_STORE_KEY_MAX */
} cm_store_key;

/* A blob. What is put belongs to the caller; what cm_store_get gives is to be given to cm_blob_clear. */
typedef struct cm_blob
{
    size_t size;      /* sizeof(cm_blob) */
    uint32_t kind;    /* what it holds, as the module that puts it has it */
    uint32_t version; /* of its form */
    void *data;       /* aligned as by malloc, if it was got; NULL: there is no such blob */
    size_t count;     /* bytes of data */
} cm_blob;

/* How a store does its work, for who makes one. Arguments were checked; outputs are untouched on failure. */
typedef struct cm_store_methods
{
    size_t size; /* sizeof(cm_store_methods) */
    /* As the functions below. get gives data from malloc, NULL if there is no such key. */
    cm_status (*get)(void *context, const cm_store_key *key, cm_blob *blob);
    /* Keep a copy under the key, in the place of what was there. */
    cm_status (*put)(void *context, const cm_store_key *key, const cm_blob *blob);
    /* Forget the key; one that is not there is no failure. */
    cm_status (*remove)(void *context, const cm_store_key *key);
    /* The first key after this one, or of all if it has no bytes; *count 0 if there is none. */
    cm_status (*next)(void *context, const cm_store_key *after, unsigned char key[CM_STORE_KEY_MAX],
                      size_t *count);
    /* Make what was changed last. */
    cm_status (*commit)(void *context);
    /* Undo what was changed since the last commit. */
    cm_status (*rollback)(void *context);
    /* What went wrong last, one line; "" for nothing. Lives until the next call. */
    const char *(*message)(void *context);
    /* The end, without commit. */
    void (*destroy)(void *context);
} cm_store_methods;

/* A store, from the function that made it to cm_store_destroy. */
typedef struct cm_store cm_store;

/* A store of such methods, which are copied; context is theirs, and methods->destroy is given it by cm_store_destroy.
 * CM_OK; CM_ERROR_ARGUMENT (a pointer or a method is NULL, size); CM_ERROR_MEMORY. */
CM_API cm_status cm_store_create(const cm_store_methods *methods, void *context, cm_store **store);

/* A store in memory, which begins empty. CM_OK; CM_ERROR_ARGUMENT; CM_ERROR_MEMORY. */
CM_API cm_status cm_store_create_in_memory(cm_store **store);

/* What was not committed is forgotten. NULL is allowed. */
CM_API void cm_store_destroy(cm_store *store);

/* The blob of a key, of a kind and of a version not above the newest that the caller knows. blob->data is NULL if there is
 * no such key.
 * CM_OK; CM_ERROR_ARGUMENT; CM_ERROR_DATA (another kind, or it is damaged); CM_ERROR_VERSION (newer); CM_ERROR_FILE;
 * CM_ERROR_MEMORY. */
CM_API cm_status cm_store_get(cm_store *store, const cm_store_key *key, uint32_t kind,
                              uint32_t newest, cm_blob *blob);

/* Give back the bytes of a blob that was got; data is NULL then. NULL is allowed. */
CM_API void cm_blob_clear(cm_blob *blob);

/* Put a blob in the place of what the key has. data may be NULL only if count is 0.
 * CM_OK; CM_ERROR_ARGUMENT; CM_ERROR_SPACE (no store takes so many bytes in one blob); CM_ERROR_FILE; CM_ERROR_MEMORY. */
CM_API cm_status cm_store_put(cm_store *store, const cm_store_key *key, const cm_blob *blob);

/* Remove a key with its blob. That there is none is no error. CM_OK; CM_ERROR_ARGUMENT; CM_ERROR_FILE; CM_ERROR_MEMORY. */
CM_API cm_status cm_store_remove(cm_store *store, const cm_store_key *key);

/* The first key after one, in their order: *count bytes, 0 if there is none. after NULL: the first of all. The store may be
 * changed between calls, and key may be what after points to.
 * CM_OK; CM_ERROR_ARGUMENT; CM_ERROR_FILE; CM_ERROR_DATA; CM_ERROR_MEMORY. */
CM_API cm_status cm_store_next(cm_store *store, const cm_store_key *after,
                               unsigned char key[CM_STORE_KEY_MAX], size_t *count);

/* Keep what was put and removed since the last commit: all of it, or on failure none. CM_OK; CM_ERROR_ARGUMENT;
 * CM_ERROR_FILE; CM_ERROR_DATA; CM_ERROR_MEMORY. */
CM_API cm_status cm_store_commit(cm_store *store);

/* Forget what was put and removed since the last commit. CM_OK; CM_ERROR_ARGUMENT; CM_ERROR_FILE; CM_ERROR_DATA. */
CM_API cm_status cm_store_rollback(cm_store *store);

/* What went wrong in the last call that failed, one line that names the file if there is one; "" for nothing. Lives until
 * the store's next call. */
CM_API const char *cm_store_message(const cm_store *store);

#ifdef __cplusplus
}
#endif

#endif
