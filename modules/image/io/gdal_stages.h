/* SPDX-License-Identifier: MIT
 *
 * What is done to a raster of GDAL before its pixels are read, each time a virtual dataset above the one before it: NULL if
 * that fails, which CPLGetLastErrorMsg tells. The pixels are computed when they are read.
 */
#ifndef MODULES_IMAGE_IO_GDAL_STAGES_H
#define MODULES_IMAGE_IO_GDAL_STAGES_H

#include <gdal.h>

#include <stdbool.h>

/* Degrees, or metres of web maps: how far it is around the Earth, and from the equator to where the map ends. */
typedef struct cm_gdal_extent
{
    double around;
    double highest;
} cm_gdal_extent;

extern const cm_gdal_extent cm_gdal_degrees, cm_gdal_web_metres;

/* Are rows parallels, from north to south, and columns meridians, from west to east? */
bool cm_gdal_is_upright(const double transform[6]);

/* Whole numbers, in which nothing says that there is no value? */
bool cm_gdal_has_whole_numbers(GDALDatasetH raster);

/* Colours instead of indices. */
GDALDatasetH cm_gdal_expanded(GDALDatasetH raster);

/* May pixels of whole numbers be missing, by a mask or the value that stands for none, and no channel says where? */
bool cm_gdal_lacks_alpha(GDALDatasetH raster);

/* With that channel. */
GDALDatasetH cm_gdal_with_alpha(GDALDatasetH raster);

/* By longitude and latitude of EPSG:4326. What the raster does not show, in the corners say, is missing: NaN, or a channel
 * alpha more. */
GDALDatasetH cm_gdal_warped(GDALDatasetH raster);

/* Does an upright raster go more than once around, or beyond a pole? */
bool cm_gdal_goes_beyond(GDALDatasetH raster, cm_gdal_extent most);

/* The rest: as it stands where whole columns and rows are to be left out, else with pixels in other places. */
GDALDatasetH cm_gdal_cut(GDALDatasetH raster, cm_gdal_extent most);

#endif
