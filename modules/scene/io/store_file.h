/* SPDX-License-Identifier: MIT
 *
 * A store in one file, which survives a kill and a failure of power: a database of SQLite, whose blobs are frames of zstd.
 *
 *   writers     one at a time, which has the file as long as it is open; local disks only, since the locks of others cannot be
 *               trusted. Many writers are many files
 *   file        application_id "CMST", user_version 1. While it is open a journal lies beside it, NAME-journal, and after a
 *               kill until it is opened again: it belongs to the file
 *   message     one line of CM_IMAGE_MESSAGE bytes at most, "FILE: what is wrong". Written on failure only
 */
#ifndef CUBEMAP_MODULES_SCENE_STORE_FILE_H
#define CUBEMAP_MODULES_SCENE_STORE_FILE_H

#include <cubemap/store.h>

#include "modules/image/io/image_io.h"

#ifdef __cplusplus
extern "C" {
#endif

/* To be filled with zeros but for size and what is wanted. */
typedef struct cm_store_file_options
{
    size_t size;        /* sizeof(cm_store_file_options) */
    int create;         /* 1: a file that is not there is made */
    int level;          /* of zstd, 1 to 19; 0: 3 */
    uint64_t page_most; /* pages of 4096 bytes that the file has at most; 0: as the disk has room */
} cm_store_file_options;

/* Open a store as it was at its last commit. Its table of keys is read and checked; a blob is checked when it is got. options
 * may be NULL: nothing is made.
 * CM_ERROR_ARGUMENT; CM_ERROR_FILE (it is not there, cannot be written, is in use, or is on a disk of another machine);
 * CM_ERROR_DATA (another program's, or damaged); CM_ERROR_VERSION (newer); CM_ERROR_MEMORY. */
cm_status cm_store_file_open(const char *path, const cm_store_file_options *options,
                             cm_store **store, char *message);

#ifdef __cplusplus
}
#endif

#endif
