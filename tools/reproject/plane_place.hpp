// SPDX-License-Identifier: MIT
//
// Where a plane of a surface stands in its picture.

#ifndef CUBEMAP_TOOLS_PLANE_PLACE_HPP
#define CUBEMAP_TOOLS_PLANE_PLACE_HPP

#include <cubemap/image.h>

#include <vector>

// The plane's pixel (column, row) is the picture's (left + column * right_x + row * down_x, top + column * right_y +
// row * down_y).
struct PlanePlace
{
    unsigned plane = 0;
    unsigned picture = 0;
    int width = 0; // of the plane
    int height = 0;
    int left = 0;
    int top = 0;
    int right_x = 1;
    int right_y = 0;
    int down_x = 0;
    int down_y = 1;

    // The picture's rows that it stands in.
    int first_row() const noexcept;
    int end_row() const noexcept;

    // What of the plane is in rows from first to before end of its picture; row_count is 0 if nothing is.
    cm_rows part(int first, int end) const noexcept;

    // Do its rows stand in columns?
    bool exchanged() const noexcept
    {
        return right_y != 0;
    }
};

std::vector<PlanePlace> plane_places(const cm_surface &surface);

#endif
