/* SPDX-License-Identifier: MIT
 *
 * The tags of a TIFF file that say where on Earth its pixels are. OpenImageIO leaves them out.
 */
#ifndef CUBEMAP_MODULES_IMAGE_GEO_TAGS_H
#define CUBEMAP_MODULES_IMAGE_GEO_TAGS_H

#include "image_io.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Those of the file's picture of that number, TIFF or BigTIFF of either byte order, to be freed with one free; NULL if
 * it has none, is no TIFF, or there is no memory. Damaged tags count as none. */
cm_image_geo_tags *cm_geo_tags_read(const char *path, uint32_t subimage);

#ifdef __cplusplus
}
#endif

#endif
