// SPDX-License-Identifier: MIT
//
// GeographicLib (Karney): Gnomonic on a sphere, centred on each face, point by point. It is made
// for ellipsoids and solves for geodesics; it is told the face.
#include "side_by_side.h"

#include "truth/peers/peers.h"

#include <cmath>

#include <GeographicLib/Config.h>
#include <GeographicLib/Geodesic.hpp>
#include <GeographicLib/Gnomonic.hpp>

namespace
{

const GeographicLib::Geodesic unit_sphere(1.0, 0.0);
const GeographicLib::Gnomonic projection(unit_sphere);

void forward(const contestant *, batch *b)
{
    for (size_t i = 0; i < b->count; i++)
    {
        const double *const centre = peer_geo_centre[b->face[i]];
        projection.Forward(centre[1], centre[0], b->from[1][i], b->from[0][i], b->plane[0][i],
                           b->plane[1][i]);
    }
}

void inverse(const contestant *, batch *b)
{
    for (size_t i = 0; i < b->count; i++)
    {
        const double *const centre = peer_geo_centre[b->face[i]];
        projection.Reverse(centre[1], centre[0], b->plane[0][i], b->plane[1][i], b->back[1][i],
                           b->back[0][i]);
    }
}

} // namespace

int add_geographiclib(roster *all)
{
    contestant entrant = {};
    if (!roster_wants(all, "gnomonic"))
    {
        return 1;
    }
    entrant.library = "GeographicLib";
    entrant.version = GEOGRAPHICLIB_VERSION_STRING;
    entrant.group = "gnomonic";
    entrant.specification = "Gnomonic";
    entrant.name = "Gnomonic";
    entrant.path = "";
    entrant.tier = "";
    entrant.note = "for any ellipsoid, by geodesics; told the face";
    entrant.by_face = 1;
    entrant.unit = std::acos(-1.0) / 180.0;
    entrant.forward = forward;
    entrant.inverse = inverse;
    roster_add(all, &entrant);
    return 1;
}
