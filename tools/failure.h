/* SPDX-License-Identifier: MIT
 *
 * How cubemap-project says what is wrong, and ends when it cannot go on.
 */
#ifndef CUBEMAP_TOOLS_FAILURE_H
#define CUBEMAP_TOOLS_FAILURE_H

#define PROGRAM "cubemap-project"

/* the exit status of wrong usage; everything else is EXIT_FAILURE */
#define EXIT_USAGE 2

#define PRINTF_LIKE(position, first) __attribute__((format(printf, position, first)))

/* One line to stderr; control characters in it become question marks. */
PRINTF_LIKE(1, 2) void say(const char *format, ...);

/* Such a line, the program's name before it, and the end. */
PRINTF_LIKE(2, 3) _Noreturn void die(int status, const char *format, ...);

#endif
