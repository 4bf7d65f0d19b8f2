// SPDX-License-Identifier: MIT

#include "face_grid.hpp"

#include <cmath>

namespace
{

// A batch of the grid's own coordinates, and their derivatives by x, y and z.
struct GridBatch
{
    std::array<std::uint8_t, PointBatch::capacity> face;
    std::array<DerivativeBatch::Numbers, 2> uv;
    std::array<DerivativeBatch::Numbers, 6> by_direction;
};

} // namespace

// No derivatives here: on a crease those of the two directions may be of different sides.
void FaceGrid::lower_own_distances(std::size_t points, const PointBatch &batch,
                                   double *distance) const
{
    const double cell = double(size) / count;
    for (std::size_t i = 0; i < points; ++i)
    {
        if (std::isnan(batch.direction_x[i]))
        {
            continue;
        }
        for (const double place : {batch.x[i], batch.y[i]})
        {
            distance[i] =
                std::fmin(distance[i], std::fabs(place - std::round(place / cell) * cell));
        }
    }
}

void FaceGrid::lower_distances(std::size_t points, const PointBatch &batch,
                               const DerivativeBatch &derivatives, double *distance) const
{
    if (size > 0)
    {
        lower_own_distances(points, batch, distance);
        return;
    }
    thread_local GridBatch grid;
    const double *const x = batch.direction_x.data();
    const double *const y = batch.direction_y.data();
    const double *const z = batch.direction_z.data();
    double *jacobian[6];
    for (std::size_t k = 0; k < 6; ++k)
    {
        jacobian[k] = grid.by_direction[k].data();
    }
    cm_forward_array(&mapping, points, x, y, z, grid.face.data(), grid.uv[0].data(),
                     grid.uv[1].data());
    cm_forward_jacobian_array(&mapping, points, x, y, z, jacobian);
    for (std::size_t k = 0; k < 2; ++k)
    {
        for (std::size_t i = 0; i < points; ++i)
        {
            double by_x = 0;
            double by_y = 0;
            for (std::size_t axis = 0; axis < 3; ++axis)
            {
                by_x += jacobian[3 * k + axis][i] * derivatives.by_x[axis][i];
                by_y += jacobian[3 * k + axis][i] * derivatives.by_y[axis][i];
            }
            const double place = (grid.uv[k][i] + 1) / 2 * count;
            const double away = std::fabs(place - std::round(place)) * 2 / count;
            distance[i] = std::fmin(distance[i], away / std::hypot(by_x, by_y));
        }
    }
}
