/* SPDX-License-Identifier: MIT
 *
 * Arrays of numbers as NumPy writes them, one after another: NPY 1.0 (numpy.lib.format), in the machine's order of bytes.
 *
 *   message     one line of CM_IMAGE_MESSAGE bytes at most. Written on failure only
 */
#ifndef CUBEMAP_MODULES_SIM_ARRAY_FILE_H
#define CUBEMAP_MODULES_SIM_ARRAY_FILE_H

#include <stddef.h>
#include <stdint.h>

#include "modules/image/io/image_io.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum cm_array_type
{
    CM_ARRAY_U8,
    CM_ARRAY_U32,
    CM_ARRAY_FLOAT,
    CM_ARRAY_DOUBLE
} cm_array_type;

#define CM_ARRAY_RANK 4

/* A dense array, its last axis innermost. */
typedef struct cm_array
{
    const char *name; /* with slashes between groups, where files have those */
    cm_array_type type;
    size_t rank; /* 1 to CM_ARRAY_RANK */
    uint64_t shape[CM_ARRAY_RANK];
    const void *data;
} cm_array;

/* Of all its numbers; 0 if it is no array: a rank or type outside, an axis of 0, no data, or more than memory can hold. */
size_t cm_array_bytes(const cm_array *array);

/* One array of NPY. A stream needs no seek. CM_OK; CM_ERROR_ARGUMENT (NULL, no array); CM_ERROR_FILE (a stream that takes not
 * all). */
cm_status cm_array_write_npy(const cm_image_stream *stream, const cm_array *array, char *message);

#ifdef __cplusplus
}
#endif

#endif
