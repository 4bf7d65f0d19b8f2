// SPDX-License-Identifier: MIT
//
// S2 (Google): its faces with the quadratic projection, and its longitudes and latitudes. A NaN is
// not tried: without NDEBUG, S2's own checks end the process.
#include "truth/peers/peers.h"

#include <s2/s2coords.h>
#include <s2/s2latlng.h>

namespace
{

int forward(const peer_subject *, const double sphere[3], peer_place *place)
{
    double u = 0.0;
    double v = 0.0;
    place->chart = S2::XYZtoFaceUV(S2Point(sphere[0], sphere[1], sphere[2]), &u, &v);
    place->x = S2::UVtoST(u);
    place->y = S2::UVtoST(v);
    return 1;
}

int inverse(const peer_subject *, const peer_place *place, double sphere[3])
{
    const S2Point point = S2::FaceUVtoXYZ(place->chart, S2::STtoUV(place->x), S2::STtoUV(place->y));
    for (int i = 0; i < 3; i++)
    {
        sphere[i] = point[i];
    }
    return 1;
}

void to_plane(const peer_subject *, const peer_face_place *from, peer_place *place)
{
    place->chart = from->face;
    place->x = static_cast<double>((from->u + 1.0L) / 2.0L);
    place->y = static_cast<double>((from->v + 1.0L) / 2.0L);
}

void from_plane(const peer_subject *, const peer_place *place, peer_face_place *to)
{
    to->face = place->chart;
    to->u = 2.0L * static_cast<long double>(place->x) - 1.0L;
    to->v = 2.0L * static_cast<long double>(place->y) - 1.0L;
}

void to_direction(const double lonlat[2], double direction[3])
{
    const S2Point point = S2LatLng::FromRadians(lonlat[1], lonlat[0]).ToPoint();
    for (int i = 0; i < 3; i++)
    {
        direction[i] = point[i];
    }
}

void to_lonlat(const double direction[3], double lonlat[2])
{
    const S2LatLng point(S2Point(direction[0], direction[1], direction[2]));
    lonlat[0] = point.lng().radians();
    lonlat[1] = point.lat().radians();
}

} // namespace

int main()
{
    const peer_subject quadratic = {
        "S2",    PEER_VERSION, "quadratic", "s2",       nullptr, cm_frame_find("s2"), 0.0, 0, 0,
        forward, inverse,      to_plane,    from_plane, nullptr};
    const peer_record record = {
        {{PEER_EVERYWHERE, 4.0}, {PEER_EVERYWHERE, 4.0}, {PEER_EVERYWHERE, 4.0}},
        PEER_VERSION,
        0,
        nullptr};
    const peer_lonlat latlng = {"S2", PEER_VERSION, "S2LatLng", 1.0, to_direction, to_lonlat};
    peer_table_head();
    return peer_compare(&quadratic, &record) + peer_compare_lonlat(&latlng, 4.0) != 0;
}
