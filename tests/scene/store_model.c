/* SPDX-License-Identifier: MIT */
#include "store_model.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

cm_store_key model_key(unsigned number, unsigned char bytes[CM_STORE_KEY_MAX])
{
    const size_t count = number == 0 ? CM_STORE_KEY_MAX : 1 + number % 9;
    memset(bytes, (int)(number * 7 % 256), CM_STORE_KEY_MAX);
    bytes[0] = (unsigned char)(255 - number);
    return (cm_store_key){bytes, count};
}

/* Blobs of a seed: from nothing to 20,000 bytes, some that zstd makes smaller. */
static cm_blob make_blob(unsigned seed)
{
    cm_blob blob = {.size = sizeof blob, .kind = MODEL_KIND, .version = seed % 5};
    blob.count = seed % 3 == 0 ? seed % 17 : seed * 131u % 20000u;
    unsigned char *bytes = malloc(blob.count + 1);
    unsigned value = seed;
    for (size_t i = 0; bytes != NULL && i < blob.count; i++)
    {
        value = value * 1664525u + 1013904223u; /* Knuth 1997, section 3.3.4 */
        bytes[i] = seed % 2 == 0 ? (unsigned char)(value >> 24) : (unsigned char)(i / 64);
    }
    blob.data = bytes;
    return blob;
}

/* What a step does with its i-th key: the key, and a seed, 0 to remove it. */
static unsigned choose(unsigned step, unsigned i, unsigned *number)
{
    const unsigned mixed = (step * 2654435761u) ^ (i * 40503u + 12345u);
    *number = (mixed >> 8) % MODEL_KEYS;
    return (mixed >> 3) % 5 == 0 ? 0 : 1 + step * 16 + i;
}

static unsigned count_of(unsigned step)
{
    return 1 + step * 7 % 12;
}

void model_step(store_model *model, unsigned step)
{
    for (unsigned i = 0; i < count_of(step); i++)
    {
        unsigned number;
        const unsigned seed = choose(step, i, &number);
        model->seed[number] = seed;
    }
}

cm_status model_step_store(cm_store *store, unsigned step)
{
    cm_status status = CM_OK;
    for (unsigned i = 0; i < count_of(step) && status == CM_OK; i++)
    {
        unsigned number;
        unsigned char bytes[CM_STORE_KEY_MAX];
        const unsigned seed = choose(step, i, &number);
        const cm_store_key key = model_key(number, bytes);
        cm_blob blob = make_blob(seed);
        status = seed == 0 ? cm_store_remove(store, &key) : cm_store_put(store, &key, &blob);
        free(blob.data);
    }
    return status;
}

static int is_same(const cm_blob *found, unsigned seed)
{
    cm_blob wanted = make_blob(seed);
    const int same = found->data != NULL && found->count == wanted.count &&
                     found->version == wanted.version &&
                     memcmp(found->data, wanted.data, wanted.count) == 0;
    free(wanted.data);
    return same;
}

/* Are the keys that next gives as many, and in order? */
static int has_keys(const store_model *model, cm_store *store)
{
    unsigned wanted = 0, found = 0;
    for (unsigned i = 0; i < MODEL_KEYS; i++)
    {
        wanted += model->seed[i] != 0;
    }
    unsigned char key[CM_STORE_KEY_MAX], before[CM_STORE_KEY_MAX];
    size_t count = 0, count_before = 0;
    cm_store_key after = {key, 0};
    while (cm_store_next(store, found == 0 ? NULL : &after, key, &count) == CM_OK && count > 0)
    {
        const size_t least = count < count_before ? count : count_before;
        const int order = least == 0 ? 0 : memcmp(before, key, least);
        if (found > 0 && (order > 0 || (order == 0 && count_before >= count)))
        {
            return 0;
        }
        memcpy(before, key, count);
        count_before = after.count = count;
        found++;
    }
    return found == wanted;
}

const char *model_differs(const store_model *model, cm_store *store)
{
    static char text[200];
    for (unsigned i = 0; i < MODEL_KEYS; i++)
    {
        unsigned char bytes[CM_STORE_KEY_MAX];
        const cm_store_key key = model_key(i, bytes);
        cm_blob blob = {.size = sizeof blob};
        const cm_status status = cm_store_get(store, &key, MODEL_KIND, 4, &blob);
        const int same = status == CM_OK &&
                         (model->seed[i] == 0 ? blob.data == NULL : is_same(&blob, model->seed[i]));
        cm_blob_clear(&blob);
        if (!same)
        {
            snprintf(text, sizeof text, "key %u, seed %u: status %d, %s", i, model->seed[i],
                     (int)status, cm_store_message(store));
            return text;
        }
    }
    return has_keys(model, store) ? "" : "other keys, or in another order";
}
