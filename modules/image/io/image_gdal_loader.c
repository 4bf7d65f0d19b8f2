/* SPDX-License-Identifier: MIT
 *
 * Finds and opens the library that reads rasters by GDAL. IMAGE_GDAL_INSTALLED and so on as in image_io_loader.c.
 */
#define _POSIX_C_SOURCE 200809L

#include "image_gdal.h"
#include "image_io_entry.h"
#include "library_loader.h"

#include <pthread.h>

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static const cm_image_io *opened;

const cm_image_io *cm_image_gdal_get(char *message)
{
    static const cm_library_place place = {"library for rasters of GDAL",
                                           "CUBEMAP_IMAGE_GDAL",
                                           IMAGE_GDAL_FROM_BIN,
                                           IMAGE_GDAL_FROM_TOOLS,
                                           IMAGE_GDAL_INSTALLED,
                                           CM_IMAGE_IO_ENTRY,
                                           {CM_IMAGE_IO_VERSION, sizeof(cm_image_io)}};
    pthread_mutex_lock(&lock);
    if (opened == NULL)
    {
        opened = cm_library_open(&place, message);
    }
    const cm_image_io *const table = opened;
    pthread_mutex_unlock(&lock);
    return table;
}
