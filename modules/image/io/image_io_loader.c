/* SPDX-License-Identifier: MIT
 *
 * Finds and opens the library of image files. IMAGE_IO_INSTALLED is where it is installed, IMAGE_IO_FROM_BIN the same
 * from the folder of programs, IMAGE_IO_FROM_TOOLS where it is built from the folder where programs are.
 */
#define _POSIX_C_SOURCE 200809L

#include "image_io_entry.h"
#include "library_loader.h"

#include <pthread.h>

/* A library that was opened is one of the process: it stays, as does why it could not be. */
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static const cm_image_io *opened;

const cm_image_io *cm_image_io_get(char *message)
{
    pthread_mutex_lock(&lock);
    if (opened == NULL)
    {
        static const cm_library_place place = {"library for image files",
                                               "CUBEMAP_IMAGE_IO",
                                               IMAGE_IO_FROM_BIN,
                                               IMAGE_IO_FROM_TOOLS,
                                               IMAGE_IO_INSTALLED,
                                               CM_IMAGE_IO_ENTRY,
                                               {CM_IMAGE_IO_VERSION, sizeof(cm_image_io)}};
        opened = cm_library_open(&place, message);
    }
    const cm_image_io *const table = opened;
    pthread_mutex_unlock(&lock);
    return table;
}
