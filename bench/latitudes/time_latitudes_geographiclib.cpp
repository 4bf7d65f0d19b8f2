// SPDX-License-Identifier: MIT
//
// GeographicLib (Karney): class Ellipsoid, which has closed forms; versions from 2.2 have series too, in AuxLatitude.
#include "time_latitudes.h"

#include <GeographicLib/Config.h>
#include <GeographicLib/Ellipsoid.hpp>

namespace
{

using GeographicLib::Ellipsoid;

typedef double (Ellipsoid::*conversion)(double) const;

conversion find(cm_latitude from, cm_latitude to)
{
    const bool forward = from == CM_LATITUDE_GEOGRAPHIC;
    if (!forward && to != CM_LATITUDE_GEOGRAPHIC)
    {
        return nullptr;
    }
    switch (forward ? to : from)
    {
    case CM_LATITUDE_GEOCENTRIC:
        return forward ? &Ellipsoid::GeocentricLatitude : &Ellipsoid::InverseGeocentricLatitude;
    case CM_LATITUDE_PARAMETRIC:
        return forward ? &Ellipsoid::ParametricLatitude : &Ellipsoid::InverseParametricLatitude;
    case CM_LATITUDE_AUTHALIC:
        return forward ? &Ellipsoid::AuthalicLatitude : &Ellipsoid::InverseAuthalicLatitude;
    case CM_LATITUDE_CONFORMAL:
        return forward ? &Ellipsoid::ConformalLatitude : &Ellipsoid::InverseConformalLatitude;
    case CM_LATITUDE_RECTIFYING:
        return forward ? &Ellipsoid::RectifyingLatitude : &Ellipsoid::InverseRectifyingLatitude;
    default:
        return nullptr;
    }
}

} // namespace

const char *peer_name()
{
    return "GeographicLib " GEOGRAPHICLIB_VERSION_STRING;
}

int peer_convert(cm_latitude from, cm_latitude to, size_t n, const double *latitude, double *other)
{
    const conversion convert = find(from, to);
    if (convert == nullptr)
    {
        return 0;
    }
    for (size_t i = 0; i < n; i++)
    {
        other[i] = (Ellipsoid::WGS84().*convert)(latitude[i]);
    }
    return 1;
}
