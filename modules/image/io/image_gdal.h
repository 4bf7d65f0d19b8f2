/* SPDX-License-Identifier: MIT
 *
 * Rasters that GDAL reads, by the table of image_io.h: open, describe, read and close; the others are NULL.
 *
 *   what they are  geo_tags says where they are on Earth, by EPSG:4326 or EPSG:3857: a raster of any other system is
 *                  warped to EPSG:4326 while it is read. One that is not placed has none
 *   pixels         those of 8 and 16 bits without a sign are whole numbers, all others floats as they are; what the
 *                  raster calls no data is NaN there. Colours of a palette are red, green and blue
 *   read           the type of the description alone
 */
#ifndef CUBEMAP_MODULES_IMAGE_GDAL_H
#define CUBEMAP_MODULES_IMAGE_GDAL_H

#include "image_io.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The table, from a library that is opened at the first call and stays open: the file that the environment variable
 * CUBEMAP_IMAGE_GDAL names; without it cubemap-image-gdal.so where cubemap-image-io.so would be. NULL with a message
 * if it is not there, as in builds without GDAL. Any thread may call. */
const cm_image_io *cm_image_gdal_get(char *message);

#ifdef __cplusplus
}
#endif

#endif
