/* SPDX-License-Identifier: MIT
 *
 * Opening one of our libraries, which has a table of functions.
 */
#ifndef CUBEMAP_MODULES_IMAGE_LIBRARY_LOADER_H
#define CUBEMAP_MODULES_IMAGE_LIBRARY_LOADER_H

#include "image_io_entry.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Where a library may be. */
typedef struct cm_library_place
{
    const char *what;       /* "library for image files" */
    const char *variable;   /* of the environment, which may name it */
    const char *from_bin;   /* where it is from the folder of installed programs */
    const char *from_tools; /* and of programs that were just built */
    const char *installed;
} cm_library_place;

/* Its table, or NULL with a message, a whole sentence. */
const cm_image_io *cm_library_open(const cm_library_place *place, char *message);

#ifdef __cplusplus
}
#endif

#endif
