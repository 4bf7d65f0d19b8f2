/* SPDX-License-Identifier: MIT */
#include <cubemap/store.h>

#include <stdlib.h>
#include <string.h>

struct cm_store
{
    cm_store_methods methods;
    void *context;
    const char *wrong; /* what went wrong before a method was asked; NULL: the method knows */
};

static int is_key(const cm_store_key *key)
{
    return key != NULL && key->bytes != NULL && key->count >= 1 && key->count <= CM_STORE_KEY_MAX;
}

cm_status cm_store_create(const cm_store_methods *methods, void *context, cm_store **store)
{
    if (methods == NULL || store == NULL || methods->size != sizeof *methods ||
        methods->get == NULL || methods->put == NULL || methods->remove == NULL ||
        methods->next == NULL || methods->commit == NULL || methods->rollback == NULL ||
        methods->message == NULL || methods->destroy == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    cm_store *made = malloc(sizeof *made);
    if (made == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    *made = (cm_store){.methods = *methods, .context = context};
    *store = made;
    return CM_OK;
}

void cm_store_destroy(cm_store *store)
{
    if (store != NULL)
    {
        store->methods.destroy(store->context);
        free(store);
    }
}

/* The caller's mistake: the store has no word about it. */
static cm_status refuse(cm_store *store, const char *wrong)
{
    if (store != NULL)
    {
        store->wrong = wrong;
    }
    return CM_ERROR_ARGUMENT;
}

cm_status cm_store_get(cm_store *store, const cm_store_key *key, uint32_t kind, uint32_t newest,
                       cm_blob *blob)
{
    if (store == NULL || !is_key(key) || blob == NULL || blob->size != sizeof *blob)
    {
        return refuse(store, "get was called with arguments that it does not take");
    }
    store->wrong = NULL;
    cm_blob found = {.size = sizeof found};
    cm_status status = store->methods.get(store->context, key, &found);
    if (status != CM_OK)
    {
        return status;
    }
    if (found.data != NULL && found.kind != kind)
    {
        cm_blob_clear(&found);
        store->wrong = "the blob is of another kind";
        return CM_ERROR_DATA;
    }
    if (found.data != NULL && found.version > newest)
    {
        cm_blob_clear(&found);
        store->wrong = "the blob is of a newer version than this program knows";
        return CM_ERROR_VERSION;
    }
    *blob = found;
    return CM_OK;
}

void cm_blob_clear(cm_blob *blob)
{
    if (blob != NULL)
    {
        free(blob->data);
        blob->data = NULL;
        blob->count = 0;
    }
}

cm_status cm_store_put(cm_store *store, const cm_store_key *key, const cm_blob *blob)
{
    if (store == NULL || !is_key(key) || blob == NULL || blob->size != sizeof *blob ||
        (blob->data == NULL && blob->count > 0))
    {
        return refuse(store, "put was called with arguments that it does not take");
    }
    store->wrong = NULL;
    return store->methods.put(store->context, key, blob);
}

cm_status cm_store_remove(cm_store *store, const cm_store_key *key)
{
    if (store == NULL || !is_key(key))
    {
        return refuse(store, "remove was called with arguments that it does not take");
    }
    store->wrong = NULL;
    return store->methods.remove(store->context, key);
}

cm_status cm_store_next(cm_store *store, const cm_store_key *after,
                        unsigned char key[CM_STORE_KEY_MAX], size_t *count)
{
    if (store == NULL || key == NULL || count == NULL || (after != NULL && !is_key(after)))
    {
        return refuse(store, "next was called with arguments that it does not take");
    }
    store->wrong = NULL;
    const cm_store_key none = {"", 0};
    return store->methods.next(store->context, after == NULL ? &none : after, key, count);
}

cm_status cm_store_commit(cm_store *store)
{
    if (store == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    store->wrong = NULL;
    return store->methods.commit(store->context);
}

cm_status cm_store_rollback(cm_store *store)
{
    if (store == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    store->wrong = NULL;
    return store->methods.rollback(store->context);
}

const char *cm_store_message(const cm_store *store)
{
    if (store == NULL)
    {
        return "";
    }
    return store->wrong != NULL ? store->wrong : store->methods.message(store->context);
}
