/* SPDX-License-Identifier: MIT
 *
 * How cubemap-project ends when it cannot go on.
 */
#ifndef CUBEMAP_TOOLS_FAILURE_H
#define CUBEMAP_TOOLS_FAILURE_H

#define PROGRAM "cubemap-project"

/* the exit status of wrong usage; everything else is EXIT_FAILURE */
#define EXIT_USAGE 2

#define PRINTF_LIKE(position, first) __attribute__((format(printf, position, first)))

/* One line to stderr, the program's name before it, and the end. */
PRINTF_LIKE(2, 3) _Noreturn void die(int status, const char *format, ...);

#endif
