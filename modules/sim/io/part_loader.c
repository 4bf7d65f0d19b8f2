/* SPDX-License-Identifier: MIT
 *
 * Finds and opens the libraries that have OpenCV and HDF5. Of each, NAME_INSTALLED is where it is installed, NAME_FROM_BIN the same
 * from the folder of programs, NAME_FROM_TOOLS where it is built from the folder where programs are; none where it was not built.
 */
#define _POSIX_C_SOURCE 200809L

#include "hdf5_file.h"
#include "vision.h"

#include "modules/image/io/image_io.h"
#include "modules/image/io/library_loader.h"

#include <pthread.h>
#include <stdio.h>

#if defined(VISION_INSTALLED) || defined(HDF5_INSTALLED)
static const void *open_once(const cm_library_place *place, const void **opened, char *message)
{
    static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
    pthread_mutex_lock(&lock);
    if (*opened == NULL)
    {
        *opened = cm_library_open(place, message);
    }
    const void *const table = *opened;
    pthread_mutex_unlock(&lock);
    return table;
}
#endif

const cm_vision *cm_vision_get(char *message)
{
#ifdef VISION_INSTALLED
    static const void *opened;
    static const cm_library_place place = {"library that has OpenCV",
                                           "CUBEMAP_SIM_VISION",
                                           VISION_FROM_BIN,
                                           VISION_FROM_TOOLS,
                                           VISION_INSTALLED,
                                           CM_VISION_ENTRY,
                                           {CM_VISION_VERSION, sizeof(cm_vision)}};
    return open_once(&place, &opened, message);
#else
    snprintf(message, CM_IMAGE_MESSAGE, "this was built without OpenCV");
    return NULL;
#endif
}

const cm_hdf5 *cm_hdf5_get(char *message)
{
#ifdef HDF5_INSTALLED
    static const void *opened;
    static const cm_library_place place = {"library that has HDF5",
                                           "CUBEMAP_SIM_HDF5",
                                           HDF5_FROM_BIN,
                                           HDF5_FROM_TOOLS,
                                           HDF5_INSTALLED,
                                           CM_HDF5_ENTRY,
                                           {CM_HDF5_VERSION, sizeof(cm_hdf5)}};
    return open_once(&place, &opened, message);
#else
    snprintf(message, CM_IMAGE_MESSAGE, "this was built without HDF5");
    return NULL;
#endif
}
