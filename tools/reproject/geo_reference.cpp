// SPDX-License-Identifier: MIT
//
// GeoTIFF 1.1 (OGC 19-008r4), sections 7.1.1 (keys), 7.1.2 (raster space) and 7.2.

#include "geo_reference.hpp"
#include "tools/cli/program.hpp"

#include <cubemap/number.h>

#include <cmath>

namespace
{

constexpr unsigned model_key = 1024;
constexpr unsigned raster_key = 1025;
constexpr unsigned geographic_key = 2048;
constexpr unsigned projected_key = 3072;
constexpr unsigned geographic_model = 2;
constexpr unsigned pixel_is_point = 2;
constexpr unsigned wgs84_degrees = 4326;
constexpr unsigned user_defined = 32767;

// Bounds that are so near, in pixels, to those of the whole sphere are those.
constexpr double nearly = 0.01;

struct Bounds
{
    double west;
    double north;
    double column; // degrees of a pixel
    double row;
};

// The value of a key that is a number in the directory itself; 0 if it is not there.
unsigned key_value(const cm_image_geo_tags &tags, unsigned key)
{
    for (std::size_t i = 4; i + 4 <= tags.key_count; i += 4)
    {
        if (tags.keys[i] == key && tags.keys[i + 1] == 0)
        {
            return tags.keys[i + 3];
        }
    }
    return 0;
}

[[noreturn]] void refuse(const ImageFile &image, const std::string &how)
{
    throw Failure(in_quotes(image.path()) + " is placed on the Earth " + how +
                  "; make it EPSG:4326 (gdalwarp -t_srs EPSG:4326), or say --from SPEC to take it "
                  "as something else");
}

void check_system(const ImageFile &image, const cm_image_geo_tags &tags)
{
    const unsigned model = key_value(tags, model_key);
    const unsigned code =
        key_value(tags, model == geographic_model ? geographic_key : projected_key);
    if (model != geographic_model || code != wgs84_degrees)
    {
        const bool named = code != 0 && code != user_defined;
        refuse(image, named ? "by EPSG:" + std::to_string(code)
                            : "otherwise than by longitude and latitude of EPSG:4326");
    }
}

Bounds bounds_of(const ImageFile &image, const cm_image_geo_tags &tags)
{
    const double half = key_value(tags, raster_key) == pixel_is_point ? 0.5 : 0;
    if (tags.transformation_count == 16)
    {
        const double *const m = tags.transformation;
        if (m[1] != 0 || m[4] != 0 || !(m[0] > 0) || !(m[5] < 0))
        {
            refuse(image, "turned or mirrored");
        }
        return {m[3] - half * m[0], m[7] - half * m[5], m[0], -m[5]};
    }
    const double *const tie = tags.tie_points;
    if (tags.tie_point_count != 6 || tags.scale_count < 2 || !(tags.scale[0] > 0) ||
        !(tags.scale[1] > 0))
    {
        refuse(image, "by several points");
    }
    return {tie[3] - (tie[0] + half) * tags.scale[0], tie[4] + (tie[1] + half) * tags.scale[1],
            tags.scale[0], tags.scale[1]};
}

std::string key(const char *name, double value)
{
    char text[CM_NUMBER_SIZE];
    cm_number_write_shortest(value, text);
    return std::string(";") + name + "=" + text;
}

} // namespace

std::optional<std::string> geographic_surface(const ImageFile &image)
{
    const cm_image_geo_tags *const tags = image.stored().geo_tags;
    const bool placed = tags != nullptr && tags->key_count >= 4 &&
                        (tags->tie_point_count > 0 || tags->transformation_count > 0);
    if (!placed)
    {
        return std::nullopt;
    }
    check_system(image, *tags);
    const Bounds at = bounds_of(image, *tags);
    const auto near_to = [](double value, double wanted, double pixel)
    { return std::fabs(value - wanted) < nearly * pixel ? wanted : value; };
    const double west = near_to(at.west, -180, at.column);
    const double east = near_to(at.west + image.width() * at.column, west + 360, at.column);
    const double north = near_to(at.north, 90, at.row);
    const double south = near_to(at.north - image.height() * at.row, -90, at.row);
    if (west == -180 && east == 180 && south == -90 && north == 90)
    {
        return "equirect";
    }
    return "equirect" + key("west", west) + key("east", east) + key("south", south) +
           key("north", north);
}
