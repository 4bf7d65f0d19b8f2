/* SPDX-License-Identifier: MIT
 *
 * Finds and opens the library that has OpenCV. VISION_INSTALLED is where it is installed, VISION_FROM_BIN the same from the folder
 * of programs, VISION_FROM_TOOLS where it is built from the folder where programs are; none where there was no OpenCV.
 */
#define _POSIX_C_SOURCE 200809L

#include "vision.h"

#include "modules/image/io/image_io.h"
#include "modules/image/io/library_loader.h"

#include <pthread.h>
#include <stdio.h>

const cm_vision *cm_vision_get(char *message)
{
#ifdef VISION_INSTALLED
    static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
    static const cm_vision *opened;
    static const cm_library_place place = {"library that has OpenCV",
                                           "CUBEMAP_SIM_VISION",
                                           VISION_FROM_BIN,
                                           VISION_FROM_TOOLS,
                                           VISION_INSTALLED,
                                           CM_VISION_ENTRY,
                                           {CM_VISION_VERSION, sizeof(cm_vision)}};
    pthread_mutex_lock(&lock);
    if (opened == NULL)
    {
        opened = cm_library_open(&place, message);
    }
    const cm_vision *const table = opened;
    pthread_mutex_unlock(&lock);
    return table;
#else
    snprintf(message, CM_IMAGE_MESSAGE, "this was built without OpenCV");
    return NULL;
#endif
}
