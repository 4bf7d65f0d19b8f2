/* SPDX-License-Identifier: MIT
 *
 * What programs ask of the system: bytes from a descriptor and to one, and whether some have arrived.
 */
#ifndef TOOLS_CLI_DESCRIPTOR_H
#define TOOLS_CLI_DESCRIPTOR_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The descriptor of a stream, below 0 if it has none. Line ends are from now on what is in the file. */
int descriptor_of(FILE *stream);

/* How many bytes there were, 0 at the end of the input, -1 and errno for an error. At least one is waited for, by a
 * descriptor that does not wait too. A signal is no error. */
ptrdiff_t descriptor_read(int descriptor, char *to, size_t room);

/* How many bytes were written, at least one; -1 and errno for an error. */
ptrdiff_t descriptor_write(int descriptor, const char *from, size_t length);

/* Would reading not wait? */
bool descriptor_has_input(int descriptor);

/* For the beginning of a program: standard streams that are closed stay so, reading and writing fail, and no file that is
 * opened later gets their numbers, and with them what is meant for a stream. */
void descriptors_keep_closed(void);

#ifdef __cplusplus
}
#endif

#endif
