// SPDX-License-Identifier: MIT

#include "chart_image.hpp"

#include <algorithm>
#include <cmath>

#include <cubemap/frame.h>

namespace
{

constexpr double pi = 3.14159265358979323846;

// How far beyond the rim interpolation reaches, in pixels: the diagonal of one, and some rounding.
constexpr double reach = 1.5;

void copy_pixel(SphereGrid &grid, int from_column, int from_row, int column, int row)
{
    const float *const from = grid.pixel(0, from_column, from_row);
    std::copy(from, from + grid.channels(), grid.pixel(0, column, row));
}

// A pixel's centre, from the middle of the image.
double from_middle(int index, int size)
{
    return index + 0.5 - 0.5 * size;
}

bool is_on_disc(int column, int row, int size)
{
    const double x = from_middle(column, size);
    const double y = from_middle(row, size);
    return 4 * (x * x + y * y) <= double(size) * size;
}

} // namespace

ChartImage::ChartImage(const std::string &specification, int image_size)
    : FaceImage(specification, *cm_frame_find("geo"), image_size), point(border_is_point())
{
}

bool ChartImage::is_disc() const
{
    return cm_mapping_describe(mapping.get())->kind == CM_KIND_AZIMUTHAL;
}

// Opposite places of the border are then the same point.
bool ChartImage::border_is_point() const
{
    const double place[2] = {1, is_disc() ? 0.0 : 0.25};
    const double opposite[2] = {-place[0], -place[1]};
    double one[3];
    double other[3];
    cm_inverse(mapping.get(), 0, place, one);
    cm_inverse(mapping.get(), 0, opposite, other);
    return std::hypot(one[0] - other[0], one[1] - other[1], one[2] - other[2]) < 1e-6;
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
        return 1 / pi;
    }
    cm_inverse(mapping.get(), 0, centre, inwards);
    cm_inverse(mapping.get(), 0, rim, outwards);
    const double chord =
        std::hypot(inwards[0] - outwards[0], inwards[1] - outwards[1], inwards[2] - outwards[2]);
    return 1 / (chord * chord);
}

void ChartImage::fill_border(SphereGrid &grid) const
{
    if (is_disc())
    {
        fill_beyond_rim(grid);
    }
    else
    {
        fill_square_border(grid);
    }
}

// Beyond a border that is one point the map goes on at its opposite side. Else each side of the square is folded
// onto itself at its middle: it goes on half a turn about that.
void ChartImage::fill_square_border(SphereGrid &grid) const
{
    const int last = size - 1;
    for (int i = -1; i <= size; ++i)
    {
        const int along = std::clamp(i, 0, last);
        for (const int side : {-1, size})
        {
            const int near = std::clamp(side, 0, last);
            const bool corner = along != i;
            const int across = point || corner ? last - near : near;
            copy_pixel(grid, across, last - along, side, i);
            copy_pixel(grid, last - along, across, i, side);
        }
    }
}

// Beyond a rim that is one point the map goes on at its opposite side; else there is nothing, and what is next to
// it inside stands for it.
void ChartImage::fill_beyond_rim(SphereGrid &grid) const
{
    const double radius = 0.5 * size;
    for (int row = -1; row <= size; ++row)
    {
        for (int column = -1; column <= size; ++column)
        {
            const double x = from_middle(column, size);
            const double y = from_middle(row, size);
            const double away = std::hypot(x, y);
            if (is_on_disc(column, row, size) || away > radius + reach)
            {
                continue;
            }
            double part = (point ? away - 2 * radius : radius) / away;
            int from_column = 0;
            int from_row = 0;
            do
            {
                from_column = static_cast<int>(std::floor(radius + part * x));
                from_row = static_cast<int>(std::floor(radius + part * y));
                part *= 1 - 0.125 / size;
            } while (!is_on_disc(from_column, from_row, size));
            copy_pixel(grid, from_column, from_row, column, row);
        }
    }
}
