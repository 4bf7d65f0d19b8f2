/* SPDX-License-Identifier: MIT
 *
 * Memory for planes: the caller's, or the system's.
 */
#ifndef MODULES_IMAGE_LARGE_MEMORY_H
#define MODULES_IMAGE_LARGE_MEMORY_H

#include <cubemap/image.h>

/* Bytes of any value, which cm_large_free gives back; NULL if there are none. `memory` is NULL for the system's. */
void *cm_large_allocate(const cm_memory *memory, size_t bytes);

/* What cm_large_allocate has given for that memory and so many bytes; NULL is allowed. */
void cm_large_free(const cm_memory *memory, void *pointer, size_t bytes);

/* The bytes of the pages that a system maps around one that is read. */
#define CM_TOUCHED_AROUND ((size_t)65536)

/* So many bytes more of it have been read or written by this thread: the caller's memory is told. */
void cm_large_touched(const cm_memory *memory, size_t bytes);

#endif
