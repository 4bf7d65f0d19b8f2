// SPDX-License-Identifier: MIT
//
// Latitudes beside GeographicLib's class Ellipsoid: all that it has, both ways, on ellipsoids from prolate to very
// oblate ones, and the surface and its radius. It works in degrees; 40 units of 2^-53 of a radian, 0.03 um on
// Earth, are the roundings of the ways to degrees and back, its own errors and, for strange ellipsoids, its arctangents.
#include <cmath>
#include <cstdio>

#include <GeographicLib/Config.h>
#include <GeographicLib/Ellipsoid.hpp>

#include <cubemap/cubemap.h>

namespace
{

using GeographicLib::Ellipsoid;

const double pole = 1.5707963267948966;
const double degree = 0.017453292519943295;

struct kind
{
    cm_latitude latitude;
    double (Ellipsoid::*forward)(double) const;
    double (Ellipsoid::*inverse)(double) const;
};

const kind kinds[] = {
    {CM_LATITUDE_GEOCENTRIC, &Ellipsoid::GeocentricLatitude, &Ellipsoid::InverseGeocentricLatitude},
    {CM_LATITUDE_PARAMETRIC, &Ellipsoid::ParametricLatitude, &Ellipsoid::InverseParametricLatitude},
    {CM_LATITUDE_AUTHALIC, &Ellipsoid::AuthalicLatitude, &Ellipsoid::InverseAuthalicLatitude},
    {CM_LATITUDE_CONFORMAL, &Ellipsoid::ConformalLatitude, &Ellipsoid::InverseConformalLatitude},
    {CM_LATITUDE_RECTIFYING, &Ellipsoid::RectifyingLatitude, &Ellipsoid::InverseRectifyingLatitude},
};

cm_latitude_conversion *make(double f, cm_latitude from, cm_latitude to)
{
    cm_ellipsoid e = {};
    e.size = sizeof e;
    e.a = 6378137.0;
    e.f = f;
    cm_latitude_conversion *made = nullptr;
    return cm_latitude_conversion_create(&e, from, to, nullptr, &made) == CM_OK ? made : nullptr;
}

struct comparison
{
    double worst;       // difference, in units of 2^-53 radians
    int contradictions; // points that the peer itself does not bring back
};

comparison compare(const Ellipsoid &peer, double f, const kind &k, bool forward)
{
    cm_latitude_conversion *const own = make(f, forward ? CM_LATITUDE_GEOGRAPHIC : k.latitude,
                                             forward ? k.latitude : CM_LATITUDE_GEOGRAPHIC);
    comparison result = {own == nullptr ? HUGE_VAL : 0.0, 0};
    for (int i = -3600; i <= 3600 && own != nullptr; i++)
    {
        const double latitude = i * 0.025;
        const double theirs = (peer.*(forward ? k.forward : k.inverse))(latitude);
        const double back = (peer.*(forward ? k.inverse : k.forward))(theirs);
        const double from = i == 3600 ? pole : i == -3600 ? -pole : latitude * degree;
        const double difference =
            std::fabs(theirs * degree - cm_latitude_convert(own, from)) * 0x1p53;
        if (!forward && !(std::fabs(back - latitude) < 1e-13))
        {
            result.contradictions++;
        }
        else if (!(difference <= result.worst))
        {
            result.worst = difference;
        }
    }
    cm_latitude_conversion_destroy(own);
    return result;
}

int compare_surface(const Ellipsoid &peer, double f)
{
    cm_ellipsoid e = {};
    e.size = sizeof e;
    e.a = 6378137.0;
    e.f = f;
    const double difference = std::fabs(cm_ellipsoid_area(&e) / peer.Area() - 1.0);
    std::printf("f %-10.6g surface: %.1e of it apart\n", f, difference);
    return difference <= 2e-14;
}

} // namespace

int main()
{
    const double flattenings[] = {1.0 / 298.257223563, 0.02, -0.02, 0.021, 0.1, -0.1, 0.5, -1.0};
    int good = 1;
    std::printf("GeographicLib %s\n", GEOGRAPHICLIB_VERSION_STRING);
    for (const double f : flattenings)
    {
        const Ellipsoid peer(6378137.0, f);
        good &= compare_surface(peer, f);
        for (const kind &k : kinds)
        {
            for (int inverse = 0; inverse < 2; inverse++)
            {
                const comparison c = compare(peer, f, k, inverse == 0);
                // what it contradicts itself in is the conformal latitude of prolate ellipsoids
                const bool agrees =
                    c.worst <= (c.contradictions == 0 ? 40.0 : 100.0) &&
                    (c.contradictions == 0 || (f < 0.0 && k.latitude == CM_LATITUDE_CONFORMAL));
                std::printf(
                    "%sf %-10.6g %s %s: %.1f eps apart; %d points of 7201 it does not bring back\n",
                    agrees ? "" : "not ok: ", f, inverse != 0 ? "from" : "to",
                    cm_latitude_name(k.latitude), c.worst, c.contradictions);
                good &= agrees;
            }
        }
    }
    return good ? 0 : 1;
}
