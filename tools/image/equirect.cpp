// SPDX-License-Identifier: MIT

#include "equirect.hpp"

#include <cmath>

#include <cubemap/direction.h>

namespace
{

constexpr double pi = 3.14159265358979323846;

// The row beyond a pole: the polar row itself, half a turn further on. With an odd width that lies
// between two pixels.
void fill_row_beyond_pole(SphereGrid &grid, int polar_row, int border_row)
{
    const int width = grid.width();
    for (int column = -1; column <= width; ++column)
    {
        const int opposite = (column + width + width / 2) % width;
        const int next = width % 2 == 0 ? opposite : (opposite + 1) % width;
        const float *const one = grid.pixel(0, opposite, polar_row);
        const float *const other = grid.pixel(0, next, polar_row);
        float *const border = grid.pixel(0, column, border_row);
        for (int c = 0; c < grid.channels(); ++c)
        {
            border[c] = one[c] + (other[c] - one[c]) / 2;
        }
    }
}

} // namespace

Equirect::Equirect(int width, int height)
    : columns(width), rows(height), cos_lon(static_cast<std::size_t>(width)),
      sin_lon(static_cast<std::size_t>(width))
{
    for (int i = 0; i < width; ++i)
    {
        const double lon = pi * ((2.0 * i + 1) / width - 1);
        cos_lon[static_cast<std::size_t>(i)] = std::cos(lon);
        sin_lon[static_cast<std::size_t>(i)] = std::sin(lon);
    }
}

void Equirect::directions(int, int row, int first_column, std::size_t count,
                          PointBatch &batch) const
{
    const double lat = pi / 2 * (1 - (2.0 * row + 1) / rows);
    const double cos_lat = std::cos(lat);
    const double sin_lat = std::sin(lat);
    for (std::size_t i = 0; i < count; ++i)
    {
        const std::size_t column = static_cast<std::size_t>(first_column) + i;
        batch.direction_x[i] = cos_lat * cos_lon[column];
        batch.direction_y[i] = cos_lat * sin_lon[column];
        batch.direction_z[i] = sin_lat;
    }
}

void Equirect::positions(std::size_t count, PointBatch &batch) const
{
    for (std::size_t i = 0; i < count; ++i)
    {
        const double direction[3] = {batch.direction_x[i], batch.direction_y[i],
                                     batch.direction_z[i]};
        double lonlat[2];
        cm_lonlat_from_direction(direction, lonlat);
        batch.plane[i] = std::isnan(lonlat[0]) ? no_plane : 0;
        batch.x[i] = (0.5 + lonlat[0] / (2 * pi)) * columns;
        batch.y[i] = (0.5 - lonlat[1] / pi) * rows;
    }
}

// At a pole the derivative by y has no direction, and is NaN.
void Equirect::derivatives(std::size_t count, const PointBatch &batch,
                           DerivativeBatch &derivatives) const
{
    const double per_column = 2 * pi / columns;
    const double per_row = pi / rows;
    for (std::size_t i = 0; i < count; ++i)
    {
        const double x = batch.direction_x[i];
        const double y = batch.direction_y[i];
        const double cos_lat = std::hypot(x, y);
        const double sin_lat = batch.direction_z[i];
        derivatives.by_x[0][i] = -per_column * y;
        derivatives.by_x[1][i] = per_column * x;
        derivatives.by_x[2][i] = 0;
        derivatives.by_y[0][i] = per_row * sin_lat * (x / cos_lat);
        derivatives.by_y[1][i] = per_row * sin_lat * (y / cos_lat);
        derivatives.by_y[2][i] = -per_row * cos_lat;
    }
}

void Equirect::fill_border(SphereGrid &grid) const
{
    for (int row = 0; row < rows; ++row)
    {
        for (int c = 0; c < grid.channels(); ++c)
        {
            grid.pixel(0, -1, row)[c] = grid.pixel(0, columns - 1, row)[c];
            grid.pixel(0, columns, row)[c] = grid.pixel(0, 0, row)[c];
        }
    }
    fill_row_beyond_pole(grid, 0, -1);
    fill_row_beyond_pole(grid, rows - 1, rows);
}
