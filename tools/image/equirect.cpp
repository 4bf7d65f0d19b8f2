// SPDX-License-Identifier: MIT

#include "equirect.hpp"
#include "tools/cli/circle.hpp"

#include <cmath>

#include <cubemap/direction.h>

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
