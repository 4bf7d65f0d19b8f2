/* SPDX-License-Identifier: MIT
 *
 * The one function that the library of image files exports.
 */
#ifndef CUBEMAP_MODULES_IMAGE_IO_ENTRY_H
#define CUBEMAP_MODULES_IMAGE_IO_ENTRY_H

#include "image_io.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Its name, as it is looked for. */
#define CM_IMAGE_IO_ENTRY "cm_image_io_entry"

/* The table of that version, or NULL if this library has another. */
const cm_image_io *cm_image_io_entry(uint32_t version);

#ifdef __cplusplus
}
#endif

#endif
