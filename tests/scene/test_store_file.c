/* SPDX-License-Identifier: MIT
 *
 * Stores in a file: what is committed outlives kills and full disks, and a file that is damaged, newer or another
 * program's is refused.
 */
#define _GNU_SOURCE

#include "modules/scene/io/store_file.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "store_model.h"
#include "tests/killed_child.h"
#include "tests/suite.h"

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

static cm_store *open_store(uint64_t page_most)
{
    const cm_store_file_options options = {
        .size = sizeof options, .create = 1, .page_most = page_most};
    cm_store *store = NULL;
    const cm_status status = cm_store_file_open(path, &options, &store, message);
    REQUIRE(status == CM_OK, "%d %s", (int)status, message);
    return store;
}

/* The status of opening what should be refused. */
static cm_status refusal(void)
{
    cm_store *store = NULL;
    message[0] = '\0';
    const cm_status status = cm_store_file_open(path, NULL, &store, message);
    if (status == CM_OK)
    {
        cm_store_destroy(store);
    }
    else
    {
        REQUIRE(store == NULL && strncmp(message, path, strlen(path)) == 0 && message[0] != '\0',
                "%s", message);
    }
    return status;
}

static size_t read_file(unsigned char *bytes, size_t room)
{
    FILE *file = fopen(path, "rb");
    REQUIRE(file != NULL, "no file");
    const size_t count = fread(bytes, 1, room, file);
    fclose(file);
    return count;
}

static void write_file(const unsigned char *bytes, size_t count)
{
    FILE *file = fopen(path, "wb");
    REQUIRE(file != NULL && fwrite(bytes, 1, count, file) == count, "cannot write");
    fclose(file);
}

static void check_same(const store_model *model, cm_store *store, const char *when, unsigned step)
{
    const char *differs = model_differs(model, store);
    REQUIRE(differs[0] == '\0', "%s, step %u: %s", when, step, differs);
}

START_TEST(is_there_when_it_is_opened_again)
{
    forget_file();
    store_model model = {{0}};
    for (unsigned step = 1; step < 60 / step_of(4); step++)
    {
        cm_store *store = open_store(0);
        check_same(&model, store, "opened", step);
        ck_assert_int_eq(model_step_store(store, step), CM_OK);
        if (step % 3 == 0)
        {
            ck_assert_int_eq(cm_store_rollback(store), CM_OK);
        }
        else if (step % 3 == 1)
        {
            model_step(&model, step);
            ck_assert_int_eq(cm_store_commit(store), CM_OK);
        } /* else it ends without commit */
        if (step % 3 != 2)
        {
            check_same(&model, store, "changed", step);
        }
        cm_store_destroy(store);
        struct stat status;
        char journal[220];
        snprintf(journal, sizeof journal, "%s-journal", path);
        REQUIRE(stat(journal, &status) != 0, "a journal is left");
    }
}
END_TEST

/* Steps without end. */
static void write_until_killed(int pipe_end, unsigned step)
{
    const cm_store_file_options options = {.size = sizeof options, .create = 1};
    cm_store *store = NULL;
    if (cm_store_file_open(path, &options, &store, message) != CM_OK)
    {
        _exit(3);
    }
    for (;; step++)
    {
        if (model_step_store(store, step) != CM_OK || cm_store_commit(store) != CM_OK)
        {
            _exit(4);
        }
        tell_step(pipe_end, step);
    }
}

/* What is told is there, and at most the step after it, whole. */
START_TEST(every_committed_blob_is_back_after_a_kill)
{
    forget_file();
    store_model model = {{0}};
    unsigned step = 1, kept = 0, journals = 0, random = 1;
    const unsigned kills = is_long() ? 1000 : is_quick() ? 50 : 250;
    const long pause = pause_within_step(write_until_killed);
    forget_file();
    for (unsigned i = 0; i < kills; i++)
    {
        random = random * 1664525u + 1013904223u;
        const unsigned last =
            run_and_kill(write_until_killed, step, i % 3, (long)(random >> 8) % pause);
        for (; step <= last; step++)
        {
            model_step(&model, step);
            kept++;
        }
        char journal[220];
        struct stat status;
        snprintf(journal, sizeof journal, "%s-journal", path);
        journals += stat(journal, &status) == 0 && status.st_size > 0;
        cm_store *store = open_store(0);
        store_model after = model;
        model_step(&after, step);
        if (model_differs(&model, store)[0] != '\0')
        {
            check_same(&after, store, "killed", step);
            model = after;
            step++;
        }
        cm_store_destroy(store);
    }
    printf("%u kills, %u within a step; %u steps kept\n", kills, journals, kept);
    REQUIRE(kept > kills / 2 && journals > 0, "the children are killed before they write");
}
END_TEST

/* Steps until one fails, and after rollback the store is as it was committed, in the file too. */
static void fill_up(cm_store *store)
{
    store_model model = {{0}};
    cm_status status = CM_OK;
    unsigned step = 1;
    for (; step < 10000 && status == CM_OK; step++)
    {
        status = model_step_store(store, step);
        status = status == CM_OK ? cm_store_commit(store) : status;
        if (status == CM_OK)
        {
            model_step(&model, step);
        }
    }
    ck_assert_int_eq(status, CM_ERROR_FILE);
    REQUIRE(strncmp(cm_store_message(store), path, strlen(path)) == 0, "%s",
            cm_store_message(store));
    /* it is one error: nothing is kept in part */
    ck_assert_int_eq(model_step_store(store, 1), CM_ERROR_FILE);
    ck_assert_int_eq(cm_store_commit(store), CM_ERROR_FILE);
    ck_assert_int_eq(cm_store_rollback(store), CM_OK);
    check_same(&model, store, "rolled back", step);
    cm_store_destroy(store);
    store = open_store(0);
    check_same(&model, store, "opened again", step);
    ck_assert_int_eq(model_step_store(store, step), CM_OK);
    ck_assert_int_eq(cm_store_commit(store), CM_OK);
    cm_store_destroy(store);
}

START_TEST(full_database_changes_nothing)
{
    for (uint64_t pages = 20; pages < 60; pages += 7)
    {
        forget_file();
        fill_up(open_store(pages));
    }
}
END_TEST

START_TEST(full_disk_changes_nothing)
{
    signal(SIGXFSZ, SIG_IGN);
    for (rlim_t bytes = 60000; bytes < 200000; bytes += 30011)
    {
        forget_file();
        struct rlimit before;
        getrlimit(RLIMIT_FSIZE, &before);
        const struct rlimit small = {bytes, before.rlim_max};
        cm_store *store = open_store(0);
        setrlimit(RLIMIT_FSIZE, &small);
        store_model model = {{0}};
        unsigned step = 1;
        while (model_step_store(store, step) == CM_OK && cm_store_commit(store) == CM_OK)
        {
            model_step(&model, step++);
        }
        REQUIRE(strstr(cm_store_message(store), path) != NULL, "%s", cm_store_message(store));
        ck_assert_int_eq(cm_store_rollback(store), CM_OK);
        check_same(&model, store, "rolled back", step);
        cm_store_destroy(store);
        setrlimit(RLIMIT_FSIZE, &before);
        store = open_store(0);
        check_same(&model, store, "opened again", step);
        cm_store_destroy(store);
    }
}
END_TEST

/* A small store that was closed: its bytes, and what is in it. */
static size_t make_small(store_model *model, unsigned char *bytes, size_t room)
{
    forget_file();
    *model = (store_model){{0}};
    cm_store *store = open_store(0);
    for (unsigned step = 1; step < 4; step++)
    {
        model_step(model, step);
        ck_assert_int_eq(model_step_store(store, step), CM_OK);
        ck_assert_int_eq(cm_store_commit(store), CM_OK);
    }
    cm_store_destroy(store);
    const size_t count = read_file(bytes, room);
    REQUIRE(count > 4096 && count < room, "%zu bytes", count);
    return count;
}

/* Whether each blob is as it was, or refused as damaged: never another, never missing. */
static int is_honest(const store_model *model, cm_store *store, int *refused)
{
    for (unsigned i = 0; i < MODEL_KEYS; i++)
    {
        unsigned char bytes[CM_STORE_KEY_MAX];
        const cm_store_key key = model_key(i, bytes);
        cm_blob blob = {.size = sizeof blob};
        const cm_status status = cm_store_get(store, &key, MODEL_KIND, 4, &blob);
        cm_blob_clear(&blob);
        if (status != CM_OK)
        {
            *refused += 1;
            if (status != CM_ERROR_DATA)
            {
                return 0;
            }
        }
    }
    return *refused > 0 || model_differs(model, store)[0] == '\0';
}

START_TEST(damage_of_any_byte_is_seen)
{
    enum
    {
        ROOM = 1 << 20
    };
    static unsigned char bytes[ROOM];
    store_model model;
    const size_t count = make_small(&model, bytes, ROOM);
    size_t at_opening = 0, at_reading = 0, without_harm = 0;
    /* what SQLite keeps is at the begins of pages: there every byte */
    for (size_t i = 0; i < count; i += i < 4096 || i % 4096 < 256 ? 1 : 1 + 30 * step_of(20))
    {
        const unsigned char was = bytes[i];
        bytes[i] = (unsigned char)(was ^ (1 + i * 37 % 255));
        write_file(bytes, count);
        bytes[i] = was;
        cm_store *store = NULL;
        const cm_status status = cm_store_file_open(path, NULL, &store, message);
        if (status != CM_OK)
        {
            REQUIRE(status == CM_ERROR_DATA || status == CM_ERROR_VERSION ||
                        status == CM_ERROR_FILE,
                    "byte %zu: %d %s", i, (int)status, message);
            REQUIRE(strncmp(message, path, strlen(path)) == 0, "%s", message);
            at_opening++;
            continue;
        }
        int refused = 0;
        REQUIRE(is_honest(&model, store, &refused), "byte %zu of %zu", i, count);
        *(refused > 0 ? &at_reading : &without_harm) += 1;
        cm_store_destroy(store);
    }
    printf("damage: %zu refused at opening, %zu at reading, %zu without harm\n", at_opening,
           at_reading, without_harm);
}
END_TEST

START_TEST(files_that_end_early_are_refused)
{
    enum
    {
        ROOM = 1 << 20
    };
    static unsigned char bytes[ROOM];
    store_model model;
    const size_t count = make_small(&model, bytes, ROOM);
    for (size_t end = 1; end < count; end += 97 * step_of(10))
    {
        write_file(bytes, end);
        cm_store *store = NULL;
        const cm_status status = cm_store_file_open(path, NULL, &store, message);
        if (status == CM_OK)
        {
            int refused = 0;
            REQUIRE(is_honest(&model, store, &refused) && refused > 0, "%zu of %zu bytes", end,
                    count);
            cm_store_destroy(store);
            continue;
        }
        ck_assert_int_eq(status, CM_ERROR_DATA);
    }
}
END_TEST

START_TEST(other_files_are_refused_by_name)
{
    forget_file();
    ck_assert_int_eq(refusal(), CM_ERROR_FILE);
    static unsigned char bytes[1 << 20];
    store_model model;
    const size_t count = make_small(&model, bytes, sizeof bytes);
    const struct
    {
        size_t place;
        unsigned char value;
        cm_status status;
        const char *word;
    } cases[] = {{0, 'x', CM_ERROR_DATA, "not a store"},
                 {68, 'X', CM_ERROR_DATA, "another program"},
                 {63, 2, CM_ERROR_VERSION, "version 2"},
                 {63, 0, CM_ERROR_DATA, "damaged"},
                 {19, 2, CM_ERROR_DATA, "damaged"}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
    {
        const unsigned char was = bytes[cases[i].place];
        bytes[cases[i].place] = cases[i].value;
        write_file(bytes, count);
        ck_assert_int_eq(refusal(), cases[i].status);
        REQUIRE(strstr(message, cases[i].word) != NULL, "%zu: %s", i, message);
        static unsigned char now[1 << 20];
        REQUIRE(read_file(now, sizeof now) == count && memcmp(now, bytes, count) == 0,
                "%zu: a file that is refused was changed", i);
        bytes[cases[i].place] = was;
    }
    write_file((const unsigned char *)"a text, and no store at all\n", 28);
    ck_assert_int_eq(refusal(), CM_ERROR_DATA);
    unlink(path);
    mkdir(path, 0700);
    ck_assert_int_eq(refusal(), CM_ERROR_FILE);
    rmdir(path);
}
END_TEST

START_TEST(second_user_is_refused)
{
    forget_file();
    cm_store *store = open_store(0);
    ck_assert_int_eq(refusal(), CM_ERROR_FILE);
    REQUIRE(strstr(message, "in use") != NULL, "%s", message);
    const pid_t child = fork();
    if (child == 0)
    {
        cm_store *second = NULL;
        _exit(cm_store_file_open(path, NULL, &second, message) == CM_ERROR_FILE ? 0 : 1);
    }
    int status = 1;
    REQUIRE(waitpid(child, &status, 0) == child && status == 0, "another process may open it");
    cm_store_destroy(store);
    ck_assert_int_eq(refusal(), CM_OK);
}
END_TEST

static void put_one(cm_store *store)
{
    const cm_store_key key = {"key", 3};
    char text[] = "blob";
    const cm_blob blob = {.size = sizeof blob, .version = 1, .data = text, .count = sizeof text};
    REQUIRE(cm_store_put(store, &key, &blob) == CM_OK, "%s", cm_store_message(store));
}

/* Journals have the name of their file: another store that has this name by now needs its own. */
START_TEST(renamed_store_leaves_the_journal_of_another)
{
    forget_file();
    char moved[220], journal[220];
    snprintf(moved, sizeof moved, "%s-moved", path);
    snprintf(journal, sizeof journal, "%s-journal", path);
    cm_store *first = open_store(0);
    put_one(first);
    ck_assert_int_eq(cm_store_commit(first), CM_OK);
    ck_assert_int_eq(rename(path, moved), 0);
    cm_store *second = open_store(0);
    put_one(second);
    struct stat before, after;
    ck_assert_int_eq(stat(journal, &before), 0);
    cm_store_destroy(first);
    REQUIRE(stat(journal, &after) == 0 && before.st_ino == after.st_ino, "it is gone");
    ck_assert_int_eq(cm_store_commit(second), CM_OK);
    cm_store_destroy(second);
    REQUIRE(stat(journal, &after) != 0, "it stays");
    unlink(moved);
}
END_TEST

/* Of names that SQLite takes for addresses or for no file, each is the file of that name. */
START_TEST(names_are_names_of_files)
{
    const char *const names[] = {"file:inner/a", "file:b?mode=memory", "c?mode=ro", "d#e",
                                 ":memory:",     "inner/:memory:",     "f%20g",     "h i",
                                 "\xc3\xbc"};
    ck_assert_int_eq(chdir(folder), 0);
    mkdir("file:inner", 0700);
    mkdir("inner", 0700);
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
    {
        const cm_store_file_options options = {.size = sizeof options, .create = 1};
        cm_store *store = NULL;
        REQUIRE(cm_store_file_open(names[i], &options, &store, message) == CM_OK, "%s", message);
        put_one(store);
        ck_assert_int_eq(cm_store_commit(store), CM_OK);
        cm_store_destroy(store);
        REQUIRE(unlink(names[i]) == 0, "%s is not there", names[i]);
    }
    REQUIRE(rmdir("inner") == 0 && rmdir("file:inner") == 0, "other files are there");
}
END_TEST

/* A message says what is wrong with the place. */
START_TEST(places_that_cannot_be_written_are_told)
{
    const cm_store_file_options options = {.size = sizeof options, .create = 1};
    cm_store *store = NULL;
    char beside[220];
    snprintf(beside, sizeof beside, "%s/none/store", folder);
    ck_assert_int_eq(cm_store_file_open(beside, &options, &store, message), CM_ERROR_FILE);
    REQUIRE(strstr(message, "No such file or directory") != NULL, "%s", message);
    forget_file();
    store = open_store(0);
    put_one(store);
    ck_assert_int_eq(cm_store_commit(store), CM_OK);
    cm_store_destroy(store);
    chmod(path, 0666);
    chmod(folder, 0555);
    const pid_t child = fork();
    if (child == 0)
    {
        if (geteuid() == 0 && setuid(65534) != 0) /* root may write everywhere */
        {
            _exit(0);
        }
        store = open_store(0);
        const int is_told = cm_store_remove(store, &(cm_store_key){"key", 3}) == CM_ERROR_FILE &&
                            strstr(cm_store_message(store), "its folder") != NULL;
        cm_store_destroy(store);
        _exit(is_told ? 0 : 1);
    }
    int status = 1;
    REQUIRE(waitpid(child, &status, 0) == child && status == 0, "it is not told");
    chmod(folder, 0700);
}
END_TEST

START_TEST(options_that_are_none_are_refused)
{
    const cm_store_file_options bad[] = {
        {.size = 1}, {.size = sizeof bad[0], .level = 20}, {.size = sizeof bad[0], .level = -1}};
    cm_store *store = NULL;
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++)
    {
        ck_assert_int_eq(cm_store_file_open(path, &bad[i], &store, message), CM_ERROR_ARGUMENT);
    }
    ck_assert_int_eq(cm_store_file_open(NULL, NULL, &store, message), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_store_file_open(path, NULL, NULL, message), CM_ERROR_ARGUMENT);
    REQUIRE(store == NULL, "touched");
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {is_there_when_it_is_opened_again,
                                  every_committed_blob_is_back_after_a_kill,
                                  full_database_changes_nothing,
                                  full_disk_changes_nothing,
                                  damage_of_any_byte_is_seen,
                                  files_that_end_early_are_refused,
                                  other_files_are_refused_by_name,
                                  second_user_is_refused,
                                  options_that_are_none_are_refused,
                                  renamed_store_leaves_the_journal_of_another,
                                  names_are_names_of_files,
                                  places_that_cannot_be_written_are_told,
                                  NULL};
    make_quick_folder(folder, "cubemap-store");
    snprintf(path, sizeof path, "%s/store", folder);
    const int failed = run_suite("store file", tests);
    forget_file();
    rmdir(folder);
    return failed;
}
