/* SPDX-License-Identifier: MIT
 *
 * The variable of the environment that chooses an instruction set. Who includes it says before any other header that it wants
 * POSIX: #define _POSIX_C_SOURCE 200809L.
 */
#ifndef TESTS_INSTRUCTIONS_VARIABLE_H
#define TESTS_INSTRUCTIONS_VARIABLE_H

#include <stdlib.h>

/* NULL: no value. */
static inline void set_instructions_variable(const char *value)
{
    static const char variable[] = "CUBEMAP_INSTRUCTIONS";
#ifdef _WIN32
    (void)_putenv_s(variable, value == NULL ? "" : value);
#else
    (void)(value == NULL ? unsetenv(variable) : setenv(variable, value, 1));
#endif
}

#endif
