// SPDX-License-Identifier: MIT
//
// How the sphere lies on planes of pixels, for what is drawn on them: directions of pixels, their derivatives, and the
// way back.

#ifndef CUBEMAP_TOOLS_PROJECTION_HPP
#define CUBEMAP_TOOLS_PROJECTION_HPP

#include <array>
#include <cstddef>
#include <cstdint>

// Points that are computed together: first their directions, then where they lie on planes. x and y
// of a position count pixels from the plane's upper left corner: the first pixel's centre is at
// (0.5, 0.5). Where there is no direction, its numbers are NaN; where there is no position, plane is
// no_plane.
constexpr std::uint8_t no_plane = 255;

struct PointBatch
{
    static constexpr std::size_t capacity = 4096;
    std::array<double, capacity> direction_x, direction_y, direction_z;
    std::array<double, capacity> x, y;
    std::array<std::uint8_t, capacity> plane;
};

// How the directions of a batch move with their positions, per pixel: the derivatives of x, y and z by
// the position's x, which grows to the right, and by its y, which grows down.
struct DerivativeBatch
{
    using Numbers = std::array<double, PointBatch::capacity>;
    std::array<Numbers, 3> by_x, by_y;
};

// How a sphere lies on planes of pixels.
class Projection
{
public:
    virtual ~Projection() = default;

    virtual int planes() const noexcept = 0;
    virtual int width() const noexcept = 0;
    virtual int height() const noexcept = 0;

    // Sets the directions of the centres of count <= PointBatch::capacity pixels of a row.
    virtual void directions(int plane, int row, int first_column, std::size_t count,
                            PointBatch &batch) const = 0;

    // Sets the positions of the first count directions, as far as they are on the planes.
    virtual void positions(std::size_t count, PointBatch &batch) const = 0;

    // Sets the derivatives at the first count positions, whose directions, of unit length, are in the
    // batch, too.
    virtual void derivatives(std::size_t count, const PointBatch &batch,
                             DerivativeBatch &derivatives) const = 0;

    // Does the plane go on at its left edge where it ends at its right one?
    virtual bool wraps() const noexcept = 0;
};

#endif
