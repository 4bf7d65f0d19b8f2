// SPDX-License-Identifier: MIT

#include "surface_projection.hpp"
#include "tools/cli/program.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

namespace
{

// Of a pixel: what is lost to the third derivative and what to rounding are both far below what is seen.
constexpr double difference_step = 1.0 / 64;

} // namespace

SurfaceProjection::SurfaceProjection(const cm_surface &like, const cm_rotation &rotation)
    : around(is_whole_equirect(cm_surface_specification(&like)))
{
    std::string message;
    surface = make_surface(cm_surface_specification(&like), 0, 0, rotation, message);
    if (!surface)
    {
        throw Failure(message);
    }
}

int SurfaceProjection::planes() const noexcept
{
    return static_cast<int>(cm_surface_plane_count(surface.get()));
}

int SurfaceProjection::width() const noexcept
{
    return static_cast<int>(cm_surface_plane_width(surface.get()));
}

int SurfaceProjection::height() const noexcept
{
    return static_cast<int>(cm_surface_plane_height(surface.get()));
}

void SurfaceProjection::directions(int plane, int row, int first_column, std::size_t count,
                                   PointBatch &batch) const
{
    for (std::size_t i = 0; i < count; ++i)
    {
        batch.plane[i] = static_cast<std::uint8_t>(plane);
        batch.x[i] = first_column + static_cast<double>(i) + 0.5;
        batch.y[i] = row + 0.5;
    }
    cm_surface_directions(surface.get(), count, batch.plane.data(), batch.x.data(), batch.y.data(),
                          batch.direction_x.data(), batch.direction_y.data(),
                          batch.direction_z.data());
}

void SurfaceProjection::positions(std::size_t count, PointBatch &batch) const
{
    cm_surface_positions(surface.get(), count, batch.direction_x.data(), batch.direction_y.data(),
                         batch.direction_z.data(), batch.plane.data(), batch.x.data(),
                         batch.y.data());
}

// At an edge from inside.
void SurfaceProjection::derivatives(std::size_t count, const PointBatch &batch,
                                    DerivativeBatch &derivatives) const
{
    const auto moved = std::make_unique<PointBatch>();
    const double extent[2] = {static_cast<double>(width()), static_cast<double>(height())};
    for (int axis = 0; axis < 2; ++axis)
    {
        auto &by = axis == 0 ? derivatives.by_x : derivatives.by_y;
        DerivativeBatch::Numbers span;
        for (const double sign : {-1.0, 1.0})
        {
            for (std::size_t i = 0; i < count; ++i)
            {
                const double place = axis == 0 ? batch.x[i] : batch.y[i];
                const double there = std::clamp(place + sign * difference_step, 0.0, extent[axis]);
                moved->plane[i] = batch.plane[i];
                moved->x[i] = axis == 0 ? there : batch.x[i];
                moved->y[i] = axis == 0 ? batch.y[i] : there;
                span[i] = sign < 0 ? -there : span[i] + there;
            }
            cm_surface_directions(surface.get(), count, moved->plane.data(), moved->x.data(),
                                  moved->y.data(), moved->direction_x.data(),
                                  moved->direction_y.data(), moved->direction_z.data());
            const double *const found[3] = {moved->direction_x.data(), moved->direction_y.data(),
                                            moved->direction_z.data()};
            for (std::size_t k = 0; k < 3; ++k)
            {
                for (std::size_t i = 0; i < count; ++i)
                {
                    by[k][i] = sign < 0 ? -found[k][i] : (by[k][i] + found[k][i]) / span[i];
                }
            }
        }
    }
}
