// SPDX-License-Identifier: MIT

#include "picture_density.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace
{

// Places along a row and a column of a plane; the outermost are half a step inside, where no pixel is far. None is on
// an axis or a diagonal, where mappings have creases: a difference across one is that of neither side.
constexpr int density_columns = 96;
constexpr int density_rows = 94;
// Of the difference for a derivative, in pixels, and the most of the plane's edge.
constexpr double density_step = 1e-3;
constexpr double density_part = 1e-5;

struct Vector
{
    double x;
    double y;
    double z;
};

Vector direction(const cm_surface &surface, unsigned plane, double column, double row)
{
    const auto face = static_cast<std::uint8_t>(plane);
    Vector at = {};
    cm_surface_directions(&surface, 1, &face, &column, &row, &at.x, &at.y, &at.z);
    return at;
}

Vector difference(const Vector &a, const Vector &b, double step)
{
    return {(a.x - b.x) / step, (a.y - b.y) / step, (a.z - b.z) / step};
}

double dot(const Vector &a, const Vector &b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

} // namespace

PictureDensity density_of(const cm_surface &surface)
{
    const double width = cm_surface_plane_width(&surface);
    const double height = cm_surface_plane_height(&surface);
    const double step = std::min(density_step, density_part * std::min(width, height));
    double area = 0;
    double count = 0;
    double longest = 0;
    double shortest = INFINITY;
    const int places = density_columns * density_rows;
    for (int i = 0; i < places * static_cast<int>(cm_surface_plane_count(&surface)); ++i)
    {
        const auto plane = static_cast<unsigned>(i / places);
        const double column = width * ((i % density_columns + 0.5) / density_columns);
        const double row = height * ((i / density_columns % density_rows + 0.5) / density_rows);
        const Vector at = direction(surface, plane, column, row);
        const Vector right = difference(direction(surface, plane, column + step, row), at, step);
        const Vector down = difference(direction(surface, plane, column, row + step), at, step);
        const double xx = dot(right, right);
        const double yy = dot(down, down);
        const double xy = dot(right, down);
        const double half = std::hypot((xx - yy) / 2, xy);
        const double square = xx * yy - xy * xy;
        if (!(square > 0))
        {
            continue; // beside the map, or at its rim
        }
        area += std::sqrt(square);
        count += 1;
        const double radians = std::sqrt((xx + yy) / 2 + half);
        longest = std::max(longest, radians);
        shortest = std::min(shortest, radians);
    }
    return count > 0 ? PictureDensity{count / area, 1 / longest, 1 / shortest}
                     : PictureDensity{0, 0, 0};
}
