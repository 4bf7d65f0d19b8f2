// SPDX-License-Identifier: MIT
//
// TIFF files that say where on Earth their pixels are.

#ifndef CUBEMAP_TOOLS_GEO_REFERENCE_HPP
#define CUBEMAP_TOOLS_GEO_REFERENCE_HPP

#include "tools/cli/atomic_file.hpp"
#include "tools/cli/image_file.hpp"

#include <cubemap/image.h>

#include <optional>
#include <string>

// What a file says of where it is.
struct GeoPlace
{
    std::optional<std::string>
        specification;     // of the surface, by longitude and latitude or as web maps are
    std::string otherwise; // or how it is placed: "by EPSG:32632"
    // numbers in an unknown unit: otherwise says so, and this is the surface if they are degrees, "" if they cannot be
    bool unit_is_unknown = false;
    std::string in_degrees;
    bool misses_values = false; // is there a value that stands for none?
    std::string ignored;        // numbers that place nothing: "pixel coordinates"
};

// Writes it into a TIFF file that is complete: EPSG:4326 of equirectangular pictures and EPSG:3857 of Mercator's. Nothing
// is written of other surfaces. Failure if it cannot be.
void write_geographic_place(const cm_surface &surface, const std::string &name, AtomicFile &file);

// Is there a system of coordinates for such pictures?
bool has_geographic_place(const cm_surface &surface, const std::optional<cm_rotation> &rotation);

// Neither of both if it does not say where it is.
GeoPlace geographic_place(const ImageFile &image);

// Can rasters be opened so?
bool has_gdal();

// Opens a raster as what is placed so, by warping it if it must be. Failure if there is nothing that can do it. why is
// what stands against taking the file as it is.
ImageFile open_by_gdal(const std::string &path, const std::string &why);

#endif
