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

/* Write scale, tie points and keys into the first directory of a whole TIFF or BigTIFF file, through a stream that reads,
 * writes, seeks and tells its size; they replace what is there. CM_ERROR_ARGUMENT: one of these is not there;
 * CM_ERROR_MEMORY; CM_ERROR_UNSUPPORTED: no such file, or the stream took no more. */
cm_status cm_geo_tags_write(const cm_image_stream *stream, const cm_image_geo_tags *tags,
                            char *message);

/* Those of the file's picture of that number, TIFF or BigTIFF of either byte order, to be freed with one free; NULL if
 * it has none, is no TIFF, or there is no memory. Damaged tags count as none. */
cm_image_geo_tags *cm_geo_tags_read(const char *path, uint32_t subimage);

/* Does what that picture of a TIFF file says of itself, these tags, its description (270) or its XMP (700), go on beyond the
 * file's end? Its pixels may be whole, and libtiff reads such a file without a word of what is missing. */
bool cm_geo_tags_are_cut(const char *path, uint32_t subimage);

#ifdef __cplusplus
}
#endif

#endif
