/* SPDX-License-Identifier: MIT
 *
 * cm_image_io_get where the library of image files is linked, as tests and fuzzers have it.
 */
#include "image_io_entry.h"

const cm_image_io *cm_image_io_get(char *message)
{
    (void)message;
    return cm_image_io_entry(CM_IMAGE_IO_VERSION);
}
