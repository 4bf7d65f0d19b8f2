/* SPDX-License-Identifier: MIT
 *
 * The command line of cubemap-project. Input: an argument a line; after an empty line, what the
 * program reads.
 */
#define _GNU_SOURCE

#include <getopt.h>
#include <setjmp.h>

#include "arguments.h"
#include "streams.h"

int project_main(int argc, char **argv);
_Noreturn void project_exit(int status);
int project_open(const char *name, int flags, ...);
int project_close(int descriptor);

static jmp_buf end_of_program;

_Noreturn void project_exit(int status)
{
    longjmp(end_of_program, status + 1);
}

/* Whatever the name: what stands behind the arguments. */
int project_open(const char *name, int flags, ...)
{
    (void)name;
    (void)flags;
    return 0;
}

int project_close(int descriptor)
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
static int run(int argc, char **argv)
{
    int status = setjmp(end_of_program);
    if (status != 0)
    {
        return status - 1;
    }
    optind = 0; /* tells glibc to begin anew */
    return project_main(argc, argv);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    arguments given = read_arguments("cubemap-project", data, size);
    talk with;
    set_input(given.rest, given.rest_size);
    begin_talk(&with);
    int status = run(given.count, given.argument);
    end_talk(&with);
    EXPECT(status >= 0 && status <= 2, "exit status %d", status);
    EXPECT((status == 0) == (with.messages_size == 0), "exit status %d: %s", status, with.messages);
    EXPECT(are_messages(with.messages, ""), "exit status %d: %s", status, with.messages);
    EXPECT(status != 2 ||
               (is_one_message(with.messages, "cubemap-project: ") && with.output_size == 0),
           "wrong usage: %s", with.messages);
    drop_talk(&with);
    drop_arguments(&given);
    return 0;
}
