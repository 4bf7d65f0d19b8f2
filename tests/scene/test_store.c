/* SPDX-License-Identifier: MIT
 *
 * Stores: what any form of them does, by the one in memory, and what is refused.
 */
#define _POSIX_C_SOURCE 200809L

#include <cubemap/store.h>

#include "store_model.h"
#include "tests/suite.h"

static cm_store *make_store(void)
{
    cm_store *store = NULL;
    ck_assert_int_eq(cm_store_create_in_memory(&store), CM_OK);
    return store;
}

START_TEST(holds_what_was_committed)
{
    cm_store *store = make_store();
    store_model model = {{0}};
    for (unsigned step = 1; step < 600 / step_of(6); step++)
    {
        ck_assert_int_eq(model_step_store(store, step), CM_OK);
        if (step % 3 == 0)
        {
            ck_assert_int_eq(cm_store_rollback(store), CM_OK);
        }
        else
        {
            model_step(&model, step);
            ck_assert_int_eq(cm_store_commit(store), CM_OK);
        }
        const char *differs = model_differs(&model, store);
        REQUIRE(differs[0] == '\0', "step %u: %s", step, differs);
    }
    /* what is not committed goes with the store */
    ck_assert_int_eq(model_step_store(store, 1000), CM_OK);
    cm_store_destroy(store);
}
END_TEST

START_TEST(changes_are_seen_before_their_commit)
{
    cm_store *store = make_store();
    const cm_store_key key = {"a", 1};
    unsigned char byte = 1;
    const cm_blob blob = {sizeof blob, MODEL_KIND, 1, &byte, 1};
    ck_assert_int_eq(cm_store_put(store, &key, &blob), CM_OK);
    cm_blob found = {.size = sizeof found};
    ck_assert_int_eq(cm_store_get(store, &key, MODEL_KIND, 1, &found), CM_OK);
    REQUIRE(found.data != NULL && found.count == 1, "not there");
    cm_blob_clear(&found);
    ck_assert_int_eq(cm_store_remove(store, &key), CM_OK);
    ck_assert_int_eq(cm_store_get(store, &key, MODEL_KIND, 1, &found), CM_OK);
    REQUIRE(found.data == NULL, "still there");
    cm_store_destroy(store);
}
END_TEST

START_TEST(kinds_and_versions_are_told_apart)
{
    cm_store *store = make_store();
    const cm_store_key key = {"a", 1};
    const cm_blob blob = {sizeof blob, 3, 5, NULL, 0};
    ck_assert_int_eq(cm_store_put(store, &key, &blob), CM_OK);
    cm_blob found = {.size = sizeof found};
    ck_assert_int_eq(cm_store_get(store, &key, 4, 5, &found), CM_ERROR_DATA);
    REQUIRE(strstr(cm_store_message(store), "kind") != NULL, "%s", cm_store_message(store));
    ck_assert_int_eq(cm_store_get(store, &key, 3, 4, &found), CM_ERROR_VERSION);
    REQUIRE(strstr(cm_store_message(store), "newer") != NULL, "%s", cm_store_message(store));
    REQUIRE(found.data == NULL, "touched");
    ck_assert_int_eq(cm_store_get(store, &key, 3, 5, &found), CM_OK);
    REQUIRE(found.data != NULL && found.count == 0 && found.version == 5, "not there");
    cm_blob_clear(&found);
    cm_store_destroy(store);
}
END_TEST

START_TEST(bad_arguments_are_refused)
{
    cm_store *store = make_store();
    unsigned char key_bytes[CM_STORE_KEY_MAX + 1] = {0};
    size_t count = 9;
    const cm_store_key good = {"a", 1}, none = {"a", 0}, null = {NULL, 1},
                       large = {key_bytes, CM_STORE_KEY_MAX + 1};
    const cm_store_key *const bad[] = {NULL, &none, &null, &large};
    cm_blob blob = {.size = sizeof blob};
    const cm_blob short_blob = {.size = 1}, no_data = {.size = sizeof blob, .count = 1};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++)
    {
        ck_assert_int_eq(cm_store_get(store, bad[i], 0, 0, &blob), CM_ERROR_ARGUMENT);
        ck_assert_int_eq(cm_store_put(store, bad[i], &blob), CM_ERROR_ARGUMENT);
        ck_assert_int_eq(cm_store_remove(store, bad[i]), CM_ERROR_ARGUMENT);
        if (bad[i] != NULL)
        {
            ck_assert_int_eq(cm_store_next(store, bad[i], key_bytes, &count), CM_ERROR_ARGUMENT);
        }
    }
    ck_assert_int_eq(cm_store_get(store, &good, 0, 0, NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_store_put(store, &good, NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_store_put(store, &good, &short_blob), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_store_put(store, &good, &no_data), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_store_next(store, NULL, NULL, &count), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_store_next(store, NULL, key_bytes, NULL), CM_ERROR_ARGUMENT);
    REQUIRE(cm_store_message(store)[0] != '\0' && cm_store_message(NULL)[0] == '\0', "message");
    ck_assert_int_eq(cm_store_commit(NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_store_rollback(NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_store_create_in_memory(NULL), CM_ERROR_ARGUMENT);
    const cm_store_methods empty = {.size = sizeof empty};
    cm_store *other = store;
    ck_assert_int_eq(cm_store_create(&empty, NULL, &other), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_store_create(NULL, NULL, &other), CM_ERROR_ARGUMENT);
    REQUIRE(other == store && count == 9, "touched");
    cm_blob_clear(NULL);
    cm_store_destroy(NULL);
    cm_store_destroy(store);
}
END_TEST

START_TEST(many_keys_in_order_are_no_long_list)
{
    /* a tree without balance would take the square of their number */
    cm_store *store = make_store();
    const unsigned count = 200000 / (unsigned)step_of(20);
    for (unsigned i = 0; i < count; i++)
    {
        const unsigned char bytes[4] = {(unsigned char)(i >> 24), (unsigned char)(i >> 16),
                                        (unsigned char)(i >> 8), (unsigned char)i};
        const cm_store_key key = {bytes, 4};
        const cm_blob blob = {sizeof blob, 1, 1, NULL, 0};
        ck_assert_int_eq(cm_store_put(store, &key, &blob), CM_OK);
    }
    ck_assert_int_eq(cm_store_commit(store), CM_OK);
    unsigned char key[CM_STORE_KEY_MAX];
    cm_store_key after = {key, 4};
    size_t bytes = 4;
    unsigned found = 0;
    while (cm_store_next(store, found == 0 ? NULL : &after, key, &bytes) == CM_OK && bytes == 4)
    {
        found++;
    }
    ck_assert_uint_eq(found, count);
    cm_store_destroy(store);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {holds_what_was_committed,
                                  changes_are_seen_before_their_commit,
                                  kinds_and_versions_are_told_apart,
                                  bad_arguments_are_refused,
                                  many_keys_in_order_are_no_long_list,
                                  NULL};
    return run_suite("store", tests);
}
