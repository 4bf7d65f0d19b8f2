/* SPDX-License-Identifier: MIT
 *
 * What finds and opens the library of image files, whose name is the argument.
 */
#define _POSIX_C_SOURCE 200809L

#include "modules/image/io/image_io.h"
#include "tests/suite.h"

#include <pthread.h>

static const char *library;

/* From that file nothing is opened, and the line says why. */
static void fails_from(const char *named, const char *words)
{
    char message[CM_IMAGE_MESSAGE] = "";
    ck_assert_int_eq(setenv("CUBEMAP_IMAGE_IO", named, 1), 0);
    REQUIRE(cm_image_io_get(message) == NULL, "%s is opened", named);
    REQUIRE(strstr(message, words) != NULL && strpbrk(message, "\r\n") == NULL, "'%s'", message);
}

START_TEST(test_what_is_none)
{
    fails_from(
        "/no/such/file.so",
        "'/no/such/file.so', cannot be opened: cannot open shared object file: No such file");
    fails_from("/dev/null", "'/dev/null', cannot be opened");
    fails_from("/no\nsuch", "'/no?such'");
    fails_from("libm.so.6", "'libm.so.6', is none: it has no cm_image_io_entry");
    /* a program that is not installed beside it, with nothing said */
    char message[CM_IMAGE_MESSAGE] = "";
    unsetenv("CUBEMAP_IMAGE_IO");
    REQUIRE(cm_image_io_get(message) == NULL || strlen(message) == 0, "'%s'", message);
}
END_TEST

static void *get(void *place)
{
    char message[CM_IMAGE_MESSAGE] = "";
    const cm_image_io **table = place;
    *table = cm_image_io_get(message);
    return NULL;
}

/* Any thread may be the first. */
START_TEST(test_threads)
{
    ck_assert_int_eq(setenv("CUBEMAP_IMAGE_IO", library, 1), 0);
    const cm_image_io *tables[8] = {0};
    pthread_t threads[8];
    for (size_t i = 0; i < 8; i++)
    {
        ck_assert_int_eq(pthread_create(&threads[i], NULL, get, &tables[i]), 0);
    }
    for (size_t i = 0; i < 8; i++)
    {
        pthread_join(threads[i], NULL);
        REQUIRE(tables[i] != NULL && tables[i] == tables[0], "thread %zu", i);
    }
    ck_assert(tables[0]->version == CM_IMAGE_IO_VERSION && tables[0]->size >= sizeof(cm_image_io));
    char message[CM_IMAGE_MESSAGE] = "";
    cm_image_reader *reader = NULL;
    ck_assert(tables[0]->open("/no/such.png", 0, &reader, message) == CM_ERROR_UNSUPPORTED);
    ck_assert_ptr_null(reader);
}
END_TEST

int main(int argc, char **argv)
{
    if (argc != 2)
    {
        printf("usage: test-image-loader LIBRARY\n");
        return 1;
    }
    library = argv[1];
    const TTest *const tests[] = {test_what_is_none, test_threads, NULL};
    return run_suite("image loader", tests);
}
