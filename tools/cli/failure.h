/* SPDX-License-Identifier: MIT
 *
 * How the filters say what is wrong, and end when they cannot go on.
 */
#ifndef CUBEMAP_TOOLS_FAILURE_H
#define CUBEMAP_TOOLS_FAILURE_H

/* cubemap-project, but for what is built with another name */
#ifndef PROGRAM
#define PROGRAM "cubemap-project"
#endif

/* the exit status of wrong usage; everything else is EXIT_FAILURE */
#define EXIT_USAGE 2

#define PRINTF_LIKE(position, first) __attribute__((format(printf, position, first)))

/* One line to stderr; control characters in it become question marks. */
PRINTF_LIKE(1, 2) void say(const char *format, ...);

/* Such a line, the program's name before it, and the end. */
PRINTF_LIKE(2, 3) _Noreturn void die(int status, const char *format, ...);

#endif
