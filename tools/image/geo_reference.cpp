// SPDX-License-Identifier: MIT
//
// GeoTIFF 1.1 (OGC 19-008r4), sections 7.1.1 (keys), 7.1.2 (raster space) and 7.2.

#include "geo_reference.hpp"
#include "surface_text.hpp"
#include "tools/cli/circle.hpp"
#include "tools/cli/program.hpp"

#include "modules/image/io/geo_tags.h"
#include "modules/image/io/image_gdal.h"

#include <cubemap/number.h>

#include <algorithm>
#include <cmath>

namespace
{

constexpr unsigned model_key = 1024;
constexpr unsigned raster_key = 1025;
constexpr unsigned geographic_key = 2048;
constexpr unsigned projected_key = 3072;
constexpr unsigned projected_model = 1;
constexpr unsigned geographic_model = 2;
constexpr unsigned pixel_is_point = 2;
constexpr unsigned wgs84_degrees = 4326;
constexpr unsigned web_mercator = 3857;

constexpr unsigned user_defined = 32767;

// Bounds that are so near, in pixels, to those of the whole sphere are those.
constexpr double nearly = 0.01;

// The radius of web maps, in metres.
constexpr double web_radius = 6378137;

// In the system's own unit.
struct Bounds
{
    double west;
    double north;
    double column; // of a pixel
    double row;
};

// Why a file is not placed as is wanted.
struct PlacedOtherwise
{
    std::string how;
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

// 4326 or 3857.
unsigned system_of(const cm_image_geo_tags &tags)
{
    const unsigned model = key_value(tags, model_key);
    const unsigned code =
        key_value(tags, model == geographic_model ? geographic_key : projected_key);
    if ((model == geographic_model && code == wgs84_degrees) ||
        (model == projected_model && code == web_mercator))
    {
        return code;
    }
    const bool named = code != 0 && code != user_defined;
    throw PlacedOtherwise{named ? "by EPSG:" + std::to_string(code)
                                : "otherwise than by longitude and latitude of EPSG:4326"};
}

Bounds bounds_of(const cm_image_geo_tags &tags)
{
    const double half = key_value(tags, raster_key) == pixel_is_point ? 0.5 : 0;
    if (tags.transformation_count == 16)
    {
        const double *const m = tags.transformation;
        if (m[1] != 0 || m[4] != 0)
        {
            throw PlacedOtherwise{"turned or mirrored"};
        }
        if (!(m[0] > 0) || !(m[5] < 0))
        {
            throw PlacedOtherwise{"mirrored"};
        }
        return {m[3] - half * m[0], m[7] - half * m[5], m[0], -m[5]};
    }
    const double *const tie = tags.tie_points;
    if (tags.tie_point_count != 6 || tags.scale_count < 2 || !(tags.scale[0] > 0) ||
        !(tags.scale[1] > 0))
    {
        throw PlacedOtherwise{"by several points"};
    }
    return {tie[3] - (tie[0] + half) * tags.scale[0], tie[4] + (tie[1] + half) * tags.scale[1],
            tags.scale[0], tags.scale[1]};
}

std::string key(const char *name, double value)
{
    char text[CM_NUMBER_SIZE];
    cm_number_write(value, 15, text); // more would be those of rounding
    return std::string(";") + name + "=" + text;
}

double near_to(double value, double wanted, double pixel)
{
    return std::fabs(value - wanted) < nearly * pixel ? wanted : value;
}

std::string with_bounds(const char *kind, double west, double east, double south, double north)
{
    return kind + key("west", west) + key("east", east) + key("south", south) + key("north", north);
}

// Further round than once, or beyond a pole, as grids do whose nodes stand at both ends.
bool goes_beyond(const ImageFile &image, const Bounds &at, double around, double highest)
{
    return image.width() * at.column > around + nearly * at.column ||
           at.north > highest + nearly * at.row ||
           at.north - image.height() * at.row < -highest - nearly * at.row;
}

std::string in_degrees(const ImageFile &image, const Bounds &at)
{
    const double west = near_to(at.west, -180, at.column);
    const double east = near_to(at.west + image.width() * at.column, west + 360, at.column);
    const double north = near_to(at.north, 90, at.row);
    const double south = near_to(at.north - image.height() * at.row, -90, at.row);
    const bool whole = west == -180 && east == 180 && south == -90 && north == 90;
    return whole ? "equirect" : with_bounds("equirect", west, east, south, north);
}

// Longitudes and latitudes of EPSG:4326 by the formulas of the sphere.
std::string in_web_metres(const ImageFile &image, const Bounds &at)
{
    const double edge = pi * web_radius;
    const auto lon = [](double x) { return x / web_radius * 180 / pi; };
    const auto lat = [](double y) { return std::atan(std::sinh(y / web_radius)) * 180 / pi; };
    const double west = near_to(at.west, -edge, at.column);
    const double east = near_to(at.west + image.width() * at.column, west + 2 * edge, at.column);
    return with_bounds("mercator", west == -edge ? -180 : lon(west),
                       east == west + 2 * edge ? (west == -edge ? 180 : lon(west) + 360)
                                               : lon(east),
                       lat(at.north - image.height() * at.row), lat(at.north));
}

} // namespace

namespace
{

// Do rows go up, as those of drawings do and those of maps do not?
bool goes_up(const cm_image_geo_tags &tags)
{
    const double *const m = tags.transformation;
    return tags.transformation_count == 16 ? m[1] == 0 && m[4] == 0 && m[0] > 0 && m[5] > 0
                                           : tags.tie_point_count == 6 && tags.scale_count >= 2 &&
                                                 tags.scale[0] > 0 && tags.scale[1] < 0;
}

// Numbers that only count pixels, from the top or the bottom: those of writers that fill in the tags always.
bool counts_pixels(const ImageFile &image, const Bounds &at, bool can_be_degrees)
{
    return at.column == 1 && at.row == 1 && at.west == 0 &&
           (at.north == 0 || (at.north == image.height() && !can_be_degrees));
}

bool is_whole_sphere(const ImageFile &image, const Bounds &at)
{
    return std::fabs(image.width() * at.column - 360) < nearly * at.column &&
           std::fabs(at.north - 90) < nearly * at.row &&
           std::fabs(image.height() * at.row - 180) < nearly * at.row;
}

// Without keys: numbers that are those of the whole sphere in degrees are degrees. Of others nobody knows.
void place_without_system(const ImageFile &image, const cm_image_geo_tags &tags, GeoPlace &place)
{
    if (goes_up(tags))
    {
        place.ignored = "coordinates that go up";
        return;
    }
    place.unit_is_unknown = true;
    const Bounds at = bounds_of(tags);
    const std::string degrees = in_degrees(image, at);
    std::string message;
    const bool can_be =
        make_surface(degrees, image.width(), image.height(), {}, message) != nullptr;
    if (can_be && is_whole_sphere(image, at))
    {
        place.specification = degrees;
        return;
    }
    if (counts_pixels(image, at, can_be))
    {
        place.unit_is_unknown = false;
        place.ignored = at.north == 0 ? "" : "coordinates of pixels"; // 0: nobody has given any
        return;
    }
    place.in_degrees = can_be ? degrees : "";
    throw PlacedOtherwise{"by numbers without a system of coordinates"};
}

} // namespace

GeoPlace geographic_place(const ImageFile &image)
{
    const cm_image_geo_tags *const tags = image.stored().geo_tags;
    GeoPlace place;
    if (tags == nullptr || (tags->tie_point_count == 0 && tags->transformation_count == 0))
    {
        return place;
    }
    try
    {
        if (tags->key_count < 4)
        {
            place_without_system(image, *tags, place);
            return place;
        }
        const unsigned system = system_of(*tags);
        const Bounds at = bounds_of(*tags);
        const bool web = system == web_mercator;
        if (goes_beyond(image, at, web ? 2 * pi * web_radius : 360, web ? HUGE_VAL : 90))
        {
            throw PlacedOtherwise{"beyond the whole sphere"};
        }
        place.specification = web ? in_web_metres(image, at) : in_degrees(image, at);
        place.misses_values = tags->no_data != nullptr && tags->no_data[0] != '\0';
    }
    catch (const PlacedOtherwise &placement)
    {
        place.otherwise = placement.how;
    }
    return place;
}

bool has_gdal()
{
    char message[CM_IMAGE_MESSAGE] = "";
    return cm_image_gdal_get(message) != nullptr;
}

ImageFile open_by_gdal(const std::string &path, const std::string &why)
{
    char message[CM_IMAGE_MESSAGE] = "";
    const cm_image_io *const io = cm_image_gdal_get(message);
    if (io == nullptr)
    {
        throw Failure(why);
    }
    cm_image_reader *opened = nullptr;
    const cm_status status = io->open(path.c_str(), 0, &opened, message);
    if (status != CM_OK)
    {
        throw Failure(why + ", and it " + message);
    }
    return ImageFile(path, *io, opened);
}

bool has_geographic_place(const cm_surface &surface, const std::optional<cm_rotation> &rotation)
{
    const std::string kind = kind_of(cm_surface_specification(&surface));
    return (kind == "equirect" || kind == "mercator") && !(rotation && is_turned(*rotation));
}

void write_geographic_place(const cm_surface &surface, const std::string &name, AtomicFile &file)
{
    const std::string specification = cm_surface_specification(&surface);
    const bool web = kind_of(specification) == "mercator";
    // web maps are square
    const double highest = web ? std::atan(std::sinh(pi)) * 180 / pi : 90;
    const auto bound = [&specification](const char *name_of, double standard)
    { return read_number(key_of(specification, name_of)).value_or(standard); };
    const auto x_of = [web](double lon) { return web ? web_radius * lon * pi / 180 : lon; };
    const auto y_of = [web](double lat)
    { return web ? web_radius * std::asinh(std::tan(lat * pi / 180)) : lat; };
    const double west = x_of(bound("west", -180));
    const double north = y_of(bound("north", highest));
    const double scale[3] = {(x_of(bound("east", 180)) - west) / cm_surface_width(&surface),
                             (north - y_of(bound("south", -highest))) / cm_surface_height(&surface),
                             0};
    const double tie[6] = {0, 0, 0, west, north, 0};
    const auto model = static_cast<std::uint16_t>(web ? projected_model : geographic_model);
    const auto code = static_cast<std::uint16_t>(web ? web_mercator : wgs84_degrees);
    const auto code_key = static_cast<std::uint16_t>(web ? projected_key : geographic_key);
    const std::uint16_t keys[] = {1,          1, 0, 3, model_key, 0, 1, model,
                                  raster_key, 0, 1, 1, code_key,  0, 1, code};
    cm_image_geo_tags tags = {};
    tags.scale = scale;
    tags.scale_count = 3;
    tags.tie_points = tie;
    tags.tie_point_count = 6;
    tags.keys = keys;
    tags.key_count = sizeof keys / sizeof *keys;
    char message[CM_IMAGE_MESSAGE] = "";
    const cm_image_stream stream = file.stream();
    const cm_status status = cm_geo_tags_write(&stream, &tags, message);
    file.check();
    if (status != CM_OK)
    {
        fail_image(in_quotes(name), status, message);
    }
}
