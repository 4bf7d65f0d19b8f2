/* SPDX-License-Identifier: MIT
 *
 * What the harnesses of filters' command lines have in common. Input: an argument a line; after an empty line, what
 * the program reads.
 */
#ifndef TESTS_FUZZ_FILTER_PROGRAM_H
#define TESTS_FUZZ_FILTER_PROGRAM_H

#include "fuzz_arguments.h"
#include "fuzz_talk.h"

#include "tools/cli/input_file.h"

/* Instead of the one that opens files: whatever the name, there is nothing in it. */
FILE *open_input(const char *name, cm_failure *failure)
{
    (void)name;
    (void)failure;
    return fopen("/dev/null", "r");
}

static void check_filter(const char *program, int (*filter_main)(int, char **, const cm_streams *),
                         const uint8_t *data, size_t size)
{
    arguments given = read_arguments(program, data, size);
    /* the program changes the order of its arguments */
    arguments kept = given;
    char wrong_usage[64];
    talk with;
    snprintf(wrong_usage, sizeof wrong_usage, "%s: ", program);
    const cm_streams streams = open_streams(&with, given.rest, given.rest_size);
    const int status = filter_main(given.count, given.argument, &streams);
    close_streams(&streams);
    EXPECT(status >= 0 && status <= 2, "exit status %d", status);
    EXPECT((status == 0) == (with.messages_size == 0), "exit status %d: %s", status, with.messages);
    EXPECT(are_messages(with.messages, ""), "exit status %d: %s", status, with.messages);
    EXPECT(status != 2 || (is_one_message(with.messages, wrong_usage) && with.output_size == 0),
           "wrong usage: %s", with.messages);
    drop_talk(&with);
    drop_arguments(&kept);
}

#endif
