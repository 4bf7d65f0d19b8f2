/* SPDX-License-Identifier: MIT
 *
 * Stores on a disk that fails at any of its calls, once or from then on: a step is whole or not at all, what is said to
 * be so is so, and the store goes on after cm_store_rollback.
 */
#include "modules/scene/io/store_file.h"

#include <unistd.h>

#include "failing_disk.h"
#include "store_model.h"
#include "tests/killed_child.h"
#include "tests/suite.h"

enum
{
    STEPS_BEFORE = 3,
    STEPS_THEN = 4
};

static char folder[40];
static char path[200];
static char message[CM_IMAGE_MESSAGE];

static void forget_file(void)
{
    char journal[220];
    snprintf(journal, sizeof journal, "%s-journal", path);
    unlink(path);
    unlink(journal);
}

static cm_status open_store(cm_store **store)
{
    const cm_store_file_options options = {.size = sizeof options, .create = 1};
    *store = NULL;
    return cm_store_file_open(path, &options, store, message);
}

static cm_status make_step(cm_store *store, unsigned step)
{
    const cm_status status = model_step_store(store, step);
    return status == CM_OK ? cm_store_commit(store) : status;
}

/* A store of some steps, on a disk that does not fail. */
static void make_store(store_model *model)
{
    forget_file();
    let_disk_fail(0, 0);
    *model = (store_model){{0}};
    cm_store *store;
    REQUIRE(open_store(&store) == CM_OK, "%s", message);
    for (unsigned step = 1; step <= STEPS_BEFORE; step++)
    {
        REQUIRE(make_step(store, step) == CM_OK, "%s", cm_store_message(store));
        model_step(model, step);
    }
    cm_store_destroy(store);
}

/* Is a step that failed made all the same, as its message says? */
enum
{
    NO,
    YES,
    MAYBE
};

/* Steps until one fails, which model has not. */
static int step_until_failure(cm_store *store, store_model *model, unsigned *step)
{
    for (; *step <= STEPS_BEFORE + STEPS_THEN; *step += 1)
    {
        const cm_status status = make_step(store, *step);
        if (status != CM_OK)
        {
            const char *const text = cm_store_message(store);
            REQUIRE(status == CM_ERROR_FILE && strncmp(text, path, strlen(path)) == 0, "%d %s",
                    (int)status, text);
            return strstr(text, "the step is made") != NULL                ? YES
                   : strstr(text, "whether the last step is made") != NULL ? MAYBE
                                                                           : NO;
        }
        model_step(model, *step);
    }
    return NO;
}

static void check_same(const store_model *model, cm_store *store, unsigned long at,
                       const char *when)
{
    const char *differs = model_differs(model, store);
    REQUIRE(differs[0] == '\0', "call %lu, %s: %s", at, when, differs);
}

/* After a failure that is over: the step is not there, and is made anew. */
static void go_on(cm_store *store, store_model *model, unsigned step, unsigned long at)
{
    REQUIRE(cm_store_rollback(store) == CM_OK, "call %lu: %s", at, cm_store_message(store));
    check_same(model, store, at, "rolled back");
    REQUIRE(make_step(store, step) == CM_OK, "call %lu: %s", at, cm_store_message(store));
    model_step(model, step);
}

/* The steps with a call that fails. How many calls there are. */
static unsigned long fail_at(unsigned long at, int lasts)
{
    store_model model;
    make_store(&model);
    cm_store *store;
    unsigned step = STEPS_BEFORE + 1;
    int is_made = NO;
    let_disk_fail(at, lasts);
    if (open_store(&store) == CM_OK)
    {
        is_made = step_until_failure(store, &model, &step);
        REQUIRE(is_made == NO || lasts, "call %lu: %s", at, cm_store_message(store));
        if (!lasts && step <= STEPS_BEFORE + STEPS_THEN)
        {
            go_on(store, &model, step, at);
        }
        cm_store_destroy(store);
    }
    const unsigned long calls = disk_calls();
    let_disk_fail(0, 0);
    REQUIRE(open_store(&store) == CM_OK, "call %lu: %s", at, message);
    store_model after = model;
    model_step(&after, step);
    const int is_there = is_made == MAYBE ? model_differs(&model, store)[0] != '\0' : is_made;
    check_same(is_there ? &after : &model, store, at, "opened again");
    cm_store_destroy(store);
    return calls;
}

START_TEST(one_call_that_fails)
{
    use_failing_disk();
    const unsigned long calls = fail_at(0, 0);
    REQUIRE(calls > 100, "%lu calls", calls);
    for (unsigned long at = 1; at <= calls; at += 1)
    {
        fail_at(at, 0);
    }
}
END_TEST

START_TEST(all_calls_fail_from_one_on)
{
    use_failing_disk();
    const unsigned long calls = fail_at(0, 0);
    for (unsigned long at = 1; at <= calls; at += 1)
    {
        fail_at(at, 1);
    }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {one_call_that_fails, all_calls_fail_from_one_on, NULL};
    make_quick_folder(folder, "cubemap-faults");
    snprintf(path, sizeof path, "%s/store", folder);
    const int failed = run_suite("store faults", tests);
    forget_file();
    rmdir(folder);
    return failed;
}
