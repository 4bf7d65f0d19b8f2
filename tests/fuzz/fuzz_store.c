/* SPDX-License-Identifier: MIT
 *
 * A store in memory, driven by the input: puts, removes, commits and rollbacks in any order, beside a table that knows what
 * should be there; and arguments that are none.
 */
#include <cubemap/store.h>

#include "fuzz.h"

enum
{
    KEYS = 16
};

/* What a key has: a length and a byte, and whether there is any. */
typedef struct entry
{
    uint8_t there, count, byte;
} entry;

static cm_store_key key_of(unsigned number, unsigned char bytes[KEYS])
{
    memset(bytes, 7, KEYS);
    bytes[number / 4] = (unsigned char)(number * 60);
    return (cm_store_key){bytes, 1 + number / 4};
}

static void check_entry(cm_store *store, unsigned number, entry wanted)
{
    unsigned char bytes[KEYS];
    const cm_store_key key = key_of(number, bytes);
    cm_blob blob = {.size = sizeof blob};
    EXPECT(cm_store_get(store, &key, 3, 5, &blob) == CM_OK, "key %u", number);
    EXPECT((blob.data != NULL) == wanted.there, "key %u", number);
    if (blob.data != NULL)
    {
        EXPECT(blob.count == wanted.count && blob.version == wanted.byte % 6, "key %u", number);
        for (size_t i = 0; i < blob.count; i++)
        {
            EXPECT(((unsigned char *)blob.data)[i] == wanted.byte, "key %u", number);
        }
    }
    cm_blob_clear(&blob);
}

static void check_all(cm_store *store, const entry *table)
{
    unsigned wanted = 0, found = 0;
    for (unsigned i = 0; i < KEYS; i++)
    {
        check_entry(store, i, table[i]);
        wanted += table[i].there;
    }
    unsigned char key[CM_STORE_KEY_MAX], before[CM_STORE_KEY_MAX];
    size_t count = 0, before_count = 0;
    cm_store_key after = {key, 0};
    while (cm_store_next(store, found == 0 ? NULL : &after, key, &count) == CM_OK && count > 0)
    {
        const size_t least = count < before_count ? count : before_count;
        const int order = least == 0 ? 0 : memcmp(before, key, least);
        EXPECT(found == 0 || order < 0 || (order == 0 && before_count < count), "out of order");
        memcpy(before, key, count);
        before_count = after.count = count;
        found++;
    }
    EXPECT(found == wanted, "%u keys, not %u", found, wanted);
}

static void put(cm_store *store, unsigned number, entry to)
{
    unsigned char bytes[KEYS], data[256];
    const cm_store_key key = key_of(number, bytes);
    memset(data, to.byte, sizeof data);
    const cm_blob blob = {sizeof blob, 3, to.byte % 6u, data, to.count};
    EXPECT(cm_store_put(store, &key, &blob) == CM_OK, "%s", cm_store_message(store));
}

static void check_bad_arguments(cm_store *store, supply *from)
{
    unsigned char bytes[CM_STORE_KEY_MAX] = {1};
    size_t count = take_byte(from);
    const size_t was = count;
    const cm_store_key keys[] = {{NULL, 1}, {bytes, 0}, {bytes, CM_STORE_KEY_MAX + 1 + count}};
    const cm_store_key *key = &keys[take_byte(from) % 3];
    cm_blob blob = {.size = sizeof blob + take_byte(from) % 2};
    EXPECT(cm_store_get(store, key, 0, 0, &blob) == CM_ERROR_ARGUMENT, "get");
    EXPECT(cm_store_put(store, key, &blob) == CM_ERROR_ARGUMENT, "put");
    EXPECT(cm_store_remove(store, key) == CM_ERROR_ARGUMENT, "remove");
    EXPECT(cm_store_next(store, key, bytes, &count) == CM_ERROR_ARGUMENT && count == was, "next");
    EXPECT(is_one_line(cm_store_message(store)), "message");
    EXPECT(cm_store_commit(NULL) == CM_ERROR_ARGUMENT, "commit");
    EXPECT(cm_store_rollback(NULL) == CM_ERROR_ARGUMENT, "rollback");
    const cm_store_methods none = {.size = sizeof none};
    cm_store *other = NULL;
    EXPECT(cm_store_create(&none, NULL, &other) == CM_ERROR_ARGUMENT && other == NULL, "create");
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    supply from = {data, size};
    entry now[KEYS] = {{0, 0, 0}}, kept[KEYS] = {{0, 0, 0}};
    cm_store *store = NULL;
    EXPECT(cm_store_create_in_memory(&store) == CM_OK, "no store");
    for (int steps = 0; from.left > 0 && steps < 400; steps++)
    {
        const uint8_t what = take_byte(&from);
        const unsigned number = what / 16;
        if (what % 16 < 8)
        {
            now[number] = (entry){1, take_byte(&from), take_byte(&from)};
            put(store, number, now[number]);
        }
        else if (what % 16 < 12)
        {
            unsigned char bytes[KEYS];
            const cm_store_key key = key_of(number, bytes);
            EXPECT(cm_store_remove(store, &key) == CM_OK, "remove");
            now[number] = (entry){0, 0, 0};
        }
        else if (what % 16 < 14)
        {
            EXPECT(cm_store_commit(store) == CM_OK, "commit");
            memcpy(kept, now, sizeof kept);
        }
        else if (what % 16 == 14)
        {
            EXPECT(cm_store_rollback(store) == CM_OK, "rollback");
            memcpy(now, kept, sizeof now);
        }
        else
        {
            check_bad_arguments(store, &from);
        }
    }
    check_all(store, now);
    cm_store_destroy(store);
    return 0;
}
