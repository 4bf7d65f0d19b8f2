// SPDX-License-Identifier: MIT
//
// S2 (Google): XYZtoFaceUV and FaceUVtoXYZ, which are its linear projection, and its quadratic one,
// point by point, inlined from its headers. The directions are left at the length that FaceUVtoXYZ
// gives them.
#include "side_by_side.h"

#include <s2/s2coords.h>

namespace
{

struct linear
{
    static double to_plane(double u)
    {
        return u;
    }
    static double from_plane(double u)
    {
        return u;
    }
};

struct quadratic
{
    static double to_plane(double u)
    {
        return S2::UVtoST(u);
    }
    static double from_plane(double s)
    {
        return S2::STtoUV(s);
    }
};

template <class projection> void forward(const contestant *, batch *b)
{
    const batch at = *b; /* as in columns.c */
    for (size_t i = 0; i < at.count; i++)
    {
        double u = 0.0;
        double v = 0.0;
        const S2Point point(at.from[0][i], at.from[1][i], at.from[2][i]);
        at.face[i] = static_cast<uint8_t>(S2::XYZtoFaceUV(point, &u, &v));
        at.plane[0][i] = projection::to_plane(u);
        at.plane[1][i] = projection::to_plane(v);
    }
}

template <class projection> void inverse(const contestant *, batch *b)
{
    const batch at = *b; /* as in columns.c */
    for (size_t i = 0; i < at.count; i++)
    {
        const S2Point point = S2::FaceUVtoXYZ(at.face[i], projection::from_plane(at.plane[0][i]),
                                              projection::from_plane(at.plane[1][i]));
        for (int k = 0; k < 3; k++)
        {
            at.back[k][i] = point[k];
        }
    }
}

template <class projection> void add(roster *all, const char *group, const char *name)
{
    contestant entrant = {};
    if (!roster_wants(all, group))
    {
        return;
    }
    entrant.library = "S2";
    entrant.version = PEER_VERSION;
    entrant.group = group;
    entrant.specification = name;
    entrant.name = name;
    entrant.path = "";
    entrant.tier = "";
    entrant.note = "its inverse leaves directions at any length; libcubemap's are of length 1";
    entrant.forward = forward<projection>;
    entrant.inverse = inverse<projection>;
    roster_add(all, &entrant);
}

} // namespace

int add_s2(roster *all)
{
    add<linear>(all, "gnomonic", "linear");
    add<quadratic>(all, "s2", "quadratic");
    return 1;
}
