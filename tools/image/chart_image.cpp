// SPDX-License-Identifier: MIT

#include "chart_image.hpp"
#include "tools/cli/circle.hpp"

#include <cmath>

#include <cubemap/frame.h>

ChartImage::ChartImage(const std::string &specification, int image_size)
    : FaceImage(specification, *cm_frame_find("geo"), image_size)
{
}

bool ChartImage::is_disc() const
{
    return cm_mapping_describe(mapping.get())->kind == CM_KIND_AZIMUTHAL;
}

bool ChartImage::is_on_map(const double uv[2]) const
{
    double direction[3];
    cm_inverse(mapping.get(), 0, uv, direction);
    return std::fabs(uv[0]) <= 1 && std::fabs(uv[1]) <= 1 && !std::isnan(direction[0]);
}

// How much of it is on the map, by places that are even with eighths.
double ChartImage::part_of_square() const
{
    constexpr int count = 32;
    int there = 0;
    for (int i = 0; i < count * count; ++i)
    {
        const double place[2] = {(2.0 * (i % count) + 1) / count - 1,
                                 (2.0 * (i / count) + 1) / count - 1};
        there += is_on_map(place) ? 1 : 0;
    }
    return double(there) / (count * count);
}

// A disc has an area of pi, and its field of view, which is 2 t wide, 4 pi sin^2(t / 2) of the sphere.
double ChartImage::mean_scale() const
{
    const double centre[2] = {0, 0};
    const double rim[2] = {1, 0};
    double inwards[3];
    double outwards[3];
    if (!is_disc())
    {
        return part_of_square() / pi;
    }
    cm_inverse(mapping.get(), 0, centre, inwards);
    cm_inverse(mapping.get(), 0, rim, outwards);
    const double chord =
        std::hypot(inwards[0] - outwards[0], inwards[1] - outwards[1], inwards[2] - outwards[2]);
    return 1 / (chord * chord);
}
