/* SPDX-License-Identifier: MIT
 *
 * Arrays as a file of HDF5, a dataset each, behind a table of functions: one library alone links HDF5, which is opened when it is
 * first asked for.
 */
#ifndef CUBEMAP_MODULES_SIM_HDF5_FILE_H
#define CUBEMAP_MODULES_SIM_HDF5_FILE_H

#include "array_file.h"

#ifdef __cplusplus
extern "C" {
#endif

#define CM_HDF5_VERSION 1
#define CM_HDF5_ENTRY "cm_hdf5_entry"

typedef struct cm_hdf5
{
    uint32_t version; /* CM_HDF5_VERSION */
    uint32_t size;    /* sizeof(cm_hdf5) */

    /* A whole file, made in memory: the same bytes for the same arrays. Numbers stand in it with their lowest bytes first.
     * CM_OK; CM_ERROR_ARGUMENT (NULL, none, what is no array, a name twice); CM_ERROR_MEMORY; CM_ERROR_FILE. */
    cm_status (*write)(const cm_image_stream *stream, const cm_array *array, size_t count,
                       char *message);
} cm_hdf5;

/* The one function that the library exports: the table of that version, or NULL if it has another. */
const cm_hdf5 *cm_hdf5_entry(uint32_t version);

/* The table, from a library that stays open, found as cm_vision_get finds its own: by CUBEMAP_SIM_HDF5, or as
 * cubemap-sim-hdf5.so. NULL with a message, a whole sentence. Any thread may call. */
const cm_hdf5 *cm_hdf5_get(char *message);

#ifdef __cplusplus
}
#endif

#endif
