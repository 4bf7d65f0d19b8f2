// SPDX-License-Identifier: MIT

#include "plane_place.hpp"

#include <algorithm>
#include <cstdint>

namespace
{

PlanePlace place_of(const cm_surface &surface, unsigned plane)
{
    PlanePlace place;
    place.plane = plane;
    place.width = static_cast<int>(cm_surface_plane_width(&surface));
    place.height = static_cast<int>(cm_surface_plane_height(&surface));
    std::uint32_t picture = 0;
    const auto pixel = [&](std::uint32_t column, std::uint32_t row, int &x, int &y)
    {
        std::uint32_t picture_column = 0;
        std::uint32_t picture_row = 0;
        cm_surface_pixel(&surface, plane, column, row, &picture, &picture_column, &picture_row);
        x = static_cast<int>(picture_column);
        y = static_cast<int>(picture_row);
    };
    int x = 0;
    int y = 0;
    pixel(0, 0, place.left, place.top);
    if (place.width > 1)
    {
        pixel(1, 0, x, y);
        place.right_x = x - place.left;
        place.right_y = y - place.top;
    }
    if (place.height > 1)
    {
        pixel(0, 1, x, y);
        place.down_x = x - place.left;
        place.down_y = y - place.top;
    }
    place.picture = picture;
    return place;
}

} // namespace

int PlanePlace::first_row() const noexcept
{
    return top + std::min(0, (width - 1) * right_y) + std::min(0, (height - 1) * down_y);
}

int PlanePlace::end_row() const noexcept
{
    return top + std::max(0, (width - 1) * right_y) + std::max(0, (height - 1) * down_y) + 1;
}

cm_rows PlanePlace::part(int first, int end) const noexcept
{
    const int from = std::max(first, first_row());
    const int to = std::min(end, end_row());
    cm_rows rows = {};
    rows.plane = plane;
    if (from >= to)
    {
        return rows;
    }
    const int forth = exchanged() ? right_y : down_y;
    const int one = (from - top) * forth;
    const int other = (to - 1 - top) * forth;
    const auto begin = static_cast<std::uint32_t>(std::min(one, other));
    const auto count = static_cast<std::uint32_t>(to - from);
    rows.first_row = exchanged() ? 0 : begin;
    rows.row_count = exchanged() ? static_cast<std::uint32_t>(height) : count;
    rows.first_column = exchanged() ? begin : 0;
    rows.column_count = exchanged() ? count : static_cast<std::uint32_t>(width);
    return rows;
}

std::vector<PlanePlace> plane_places(const cm_surface &surface)
{
    std::vector<PlanePlace> places;
    for (unsigned plane = 0; plane < cm_surface_plane_count(&surface); ++plane)
    {
        places.push_back(place_of(surface, plane));
    }
    return places;
}
