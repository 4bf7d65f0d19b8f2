// SPDX-License-Identifier: MIT
//
// GeographicLib (Karney): the gnomonic projection of a sphere, centred on each face, and geocentric
// coordinates.
#include "truth/peers/peers.h"

#include <cmath>

#include <GeographicLib/Config.h>
#include <GeographicLib/Geocentric.hpp>
#include <GeographicLib/Geodesic.hpp>
#include <GeographicLib/Gnomonic.hpp>

namespace
{

const GeographicLib::Geodesic unit_sphere(1.0, 0.0);
const GeographicLib::Gnomonic projection(unit_sphere);
const GeographicLib::Geocentric geocentric(1.0, 0.0);

int forward(const peer_subject *, const double sphere[3], peer_place *place)
{
    const double *const centre = peer_geo_centre[place->chart];
    projection.Forward(centre[1], centre[0], sphere[1], sphere[0], place->x, place->y);
    return std::isfinite(place->x) && std::isfinite(place->y);
}

int inverse(const peer_subject *, const peer_place *place, double sphere[3])
{
    const double *const centre = peer_geo_centre[place->chart];
    projection.Reverse(centre[1], centre[0], place->x, place->y, sphere[1], sphere[0]);
    return std::isfinite(sphere[0]) && std::isfinite(sphere[1]);
}

void to_plane(const peer_subject *, const peer_face_place *from, peer_place *place)
{
    place->chart = from->face;
    place->x = static_cast<double>(from->u);
    place->y = static_cast<double>(from->v);
}

void from_plane(const peer_subject *, const peer_place *place, peer_face_place *to)
{
    to->face = place->chart;
    to->u = static_cast<long double>(place->x);
    to->v = static_cast<long double>(place->y);
}

void to_direction(const double lonlat[2], double direction[3])
{
    geocentric.Forward(lonlat[1], lonlat[0], 0.0, direction[0], direction[1], direction[2]);
}

void to_lonlat(const double direction[3], double lonlat[2])
{
    double height = 0.0;
    geocentric.Reverse(direction[0], direction[1], direction[2], lonlat[1], lonlat[0], height);
}

} // namespace

int main()
{
    const char *const version = GEOGRAPHICLIB_VERSION_STRING;
    const double degree = std::acos(-1.0) / 180.0;
    const peer_subject gnomonic = {
        "GeographicLib", version, "Gnomonic", "gnomonic", nullptr, cm_frame_find("geo"),
        degree,          0,       6,          forward,    inverse, to_plane,
        from_plane,      nullptr};
    const peer_record record = {
        {{PEER_EVERYWHERE, 8.0}, {PEER_EVERYWHERE, 8.0}, {PEER_EVERYWHERE, 8.0}},
        version,
        0,
        nullptr};
    const peer_lonlat sphere = {"GeographicLib", version,      "Geocentric",
                                degree,          to_direction, to_lonlat};
    peer_table_head();
    return peer_compare(&gnomonic, &record) + peer_compare_lonlat(&sphere, 4.0) != 0;
}
