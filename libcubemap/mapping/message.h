/* SPDX-License-Identifier: MIT
 *
 * Messages about bad words.
 */
#ifndef LIBCUBEMAP_MAPPING_MESSAGE_H
#define LIBCUBEMAP_MAPPING_MESSAGE_H

#include <cubemap/status.h>

#include <stddef.h>

/* Writes a message, unless it is NULL or size is 0: one line of text, whatever the arguments are, cut to
 * size bytes with a zero byte at its end. Returns the status. */
#if defined(__GNUC__)
__attribute__((format(printf, 4, 5)))
#endif
cm_status
cm_fail(cm_status status, char *message, size_t size, const char *format, ...);

#endif
