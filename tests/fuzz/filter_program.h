/* SPDX-License-Identifier: MIT
 *
 * What the harnesses of filters' command lines have in common. Input: an argument a line; after an empty line, what
 * the program reads.
 */
#ifndef TESTS_FUZZ_FILTER_PROGRAM_H
#define TESTS_FUZZ_FILTER_PROGRAM_H

#include <getopt.h>
#include <setjmp.h>

#include "fuzz_arguments.h"
#include "fuzz_streams.h"

/* A program that ends leaves its memory to the system; where it is a function that is no leak. What it loses before it
 * ends well the shell tests of a sanitized build find. */
#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#include <sanitizer/lsan_interface.h>
#define FILTER_LEAKS(word) __lsan_##word()
#endif
#endif
#ifndef FILTER_LEAKS
#define FILTER_LEAKS(word) (void)0
#endif

/* What exit, open and close are in filter_as_function.h. */
_Noreturn void filter_exit(int status);
int filter_open(const char *name, int flags, ...);
int filter_close(int descriptor);

static jmp_buf end_of_program;

_Noreturn void filter_exit(int status)
{
    longjmp(end_of_program, status + 1);
}

/* Whatever the name: what stands behind the arguments. */
int filter_open(const char *name, int flags, ...)
{
    (void)name;
    (void)flags;
    return 0;
}

int filter_close(int descriptor)
{
    (void)descriptor;
    return 0;
}

int LLVMFuzzerInitialize(int *argc, char ***argv)
{
    (void)argc;
    (void)argv;
    replace_descriptors();
    return 0;
}

/* The exit status. */
static int run_filter(int (*filter_main)(int, char **), int argc, char **argv)
{
    int status = setjmp(end_of_program);
    if (status == 0)
    {
        FILTER_LEAKS(disable);
        optind = 0; /* tells glibc to begin anew */
        status = filter_main(argc, argv) + 1;
    }
    FILTER_LEAKS(enable);
    return status - 1;
}

static void check_filter(const char *program, int (*filter_main)(int, char **), const uint8_t *data,
                         size_t size)
{
    arguments given = read_arguments(program, data, size);
    char wrong_usage[64];
    talk with;
    snprintf(wrong_usage, sizeof wrong_usage, "%s: ", program);
    set_input(given.rest, given.rest_size);
    begin_talk(&with);
    int status = run_filter(filter_main, given.count, given.argument);
    end_talk(&with);
    EXPECT(status >= 0 && status <= 2, "exit status %d", status);
    EXPECT((status == 0) == (with.messages_size == 0), "exit status %d: %s", status, with.messages);
    EXPECT(are_messages(with.messages, ""), "exit status %d: %s", status, with.messages);
    EXPECT(status != 2 || (is_one_message(with.messages, wrong_usage) && with.output_size == 0),
           "wrong usage: %s", with.messages);
    drop_talk(&with);
    drop_arguments(&given);
}

#endif
