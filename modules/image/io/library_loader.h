/* SPDX-License-Identifier: MIT
 *
 * Opening one of our libraries, which has a table of functions.
 */
#ifndef CUBEMAP_MODULES_IMAGE_LIBRARY_LOADER_H
#define CUBEMAP_MODULES_IMAGE_LIBRARY_LOADER_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What every table begins with. */
typedef struct cm_library_head
{
    uint32_t version;
    uint32_t size; /* of the whole table */
} cm_library_head;

/* Where a library may be, and what is asked of it. */
typedef struct cm_library_place
{
    const char *what;       /* "library for image files" */
    const char *variable;   /* of the environment, which may name it */
    const char *from_bin;   /* where it is from the folder of installed programs */
    const char *from_tools; /* and of programs that were just built */
    const char *installed;
    const char *
        entry; /* the function it exports, which takes a version and returns the table of that or NULL */
    cm_library_head least; /* the version that is wanted, and how long its table is */
} cm_library_place;

/* Its table, or NULL with a message, a whole sentence. */
const void *cm_library_open(const cm_library_place *place, char *message);

#ifdef __cplusplus
}
#endif

#endif
