// SPDX-License-Identifier: MIT

#include "chart_image.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <vector>

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
    : FaceImage(specification, *cm_frame_find("geo"), image_size),
      gaps(!is_disc() && part_of_square() < 1), point(border_is_point())
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

void ChartImage::fill_border(SphereGrid &grid) const
{
    if (is_disc())
    {
        fill_beyond_rim(grid);
    }
    else if (gaps)
    {
        fill_gaps(grid);
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

// The value beyond an edge of the map, for a pixel of a gap beside a pixel on the map: the place of the edge
// between the two is a point of the sphere, and what is beyond it on the way there is on the map elsewhere.
void ChartImage::copy_continuation(SphereGrid &grid, int column, int row, int from_column,
                                   int from_row) const
{
    const double per_pixel = 2.0 / size;
    double inside[2] = {per_pixel * from_middle(from_column, size),
                        -per_pixel * from_middle(from_row, size)};
    const double gap[2] = {per_pixel * from_middle(column, size),
                           -per_pixel * from_middle(row, size)};
    double outside[2] = {gap[0], gap[1]};
    for (int step = 0; step < 40; ++step)
    {
        const double middle[2] = {(inside[0] + outside[0]) / 2, (inside[1] + outside[1]) / 2};
        double *const end = is_on_map(middle) ? inside : outside;
        end[0] = middle[0];
        end[1] = middle[1];
    }
    const double mirrored[2] = {2 * inside[0] - gap[0], 2 * inside[1] - gap[1]};
    double edge[3];
    double before[3];
    double uv[2];
    cm_inverse(mapping.get(), 0, inside, edge);
    cm_inverse(mapping.get(), 0, mirrored, before);
    const double along = 2 * (before[0] * edge[0] + before[1] * edge[1] + before[2] * edge[2]);
    const double beyond[3] = {along * edge[0] - before[0], along * edge[1] - before[1],
                              along * edge[2] - before[2]};
    if (cm_forward(mapping.get(), beyond, uv) != CM_NO_FACE)
    {
        const int other_column = std::clamp(static_cast<int>((1 + uv[0]) / per_pixel), 0, size - 1);
        const int other_row = std::clamp(static_cast<int>((1 - uv[1]) / per_pixel), 0, size - 1);
        const double centre[2] = {per_pixel * from_middle(other_column, size),
                                  -per_pixel * from_middle(other_row, size)};
        from_column = is_on_map(centre) ? other_column : from_column;
        from_row = is_on_map(centre) ? other_row : from_row;
    }
    copy_pixel(grid, from_column, from_row, column, row);
}

void ChartImage::fill_gaps(SphereGrid &grid) const
{
    // a row of pixels on the map and its neighbours, with a border of two
    const auto row_on_map = [this](int row)
    {
        std::vector<bool> there(static_cast<std::size_t>(size) + 4, false);
        for (int column = 0; row >= 0 && row < size && column < size; ++column)
        {
            const double uv[2] = {2.0 / size * from_middle(column, size),
                                  -2.0 / size * from_middle(row, size)};
            there[static_cast<std::size_t>(column) + 2] = is_on_map(uv);
        }
        return there;
    };
    // those beside a pixel first, then those at its corners
    constexpr int steps[8][2] = {{-1, 0},  {1, 0},  {0, -1}, {0, 1},
                                 {-1, -1}, {1, -1}, {-1, 1}, {1, 1}};
    std::array<std::vector<bool>, 3> near = {row_on_map(-2), row_on_map(-1), row_on_map(0)};
    for (int row = -1; row <= size; ++row)
    {
        for (int column = -1; column <= size; ++column)
        {
            const auto on_map = [&](int right, int down) {
                return near[static_cast<std::size_t>(down + 1)]
                           [static_cast<std::size_t>(column + right + 2)];
            };
            const auto beside =
                std::find_if(std::begin(steps), std::end(steps),
                             [&](const int(&step)[2]) { return on_map(step[0], step[1]); });
            if (!on_map(0, 0) && beside != std::end(steps))
            {
                copy_continuation(grid, column, row, column + (*beside)[0], row + (*beside)[1]);
            }
        }
        near = {near[1], near[2], row_on_map(row + 2)};
    }
}
