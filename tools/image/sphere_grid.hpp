// SPDX-License-Identifier: MIT
//
// An image of the sphere in memory: one or more planes of pixels, each with a border of one pixel
// that repeats what lies beyond its edges, so that interpolation needs no special case.

#ifndef CUBEMAP_TOOLS_SPHERE_GRID_HPP
#define CUBEMAP_TOOLS_SPHERE_GRID_HPP

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

enum class Filter
{
    nearest,
    bilinear
};

class SphereGrid
{
public:
    // All pixels are 0. std::bad_alloc if there is not enough memory.
    SphereGrid(int planes, int width, int height, int channels);

    int planes() const noexcept
    {
        return plane_count;
    }
    int width() const noexcept
    {
        return plane_width;
    }
    int height() const noexcept
    {
        return plane_height;
    }
    int channels() const noexcept
    {
        return channel_count;
    }

    // The channels of a pixel; column -1 ... width, row -1 ... height, the border included.
    float *pixel(int plane, int column, int row) noexcept
    {
        return data.data() + offset(plane, column, row);
    }
    const float *pixel(int plane, int column, int row) const noexcept
    {
        return data.data() + offset(plane, column, row);
    }

    // From a pixel to the one below it, in floats.
    std::size_t row_stride() const noexcept
    {
        return stride;
    }

private:
    std::size_t offset(int plane, int column, int row) const noexcept
    {
        return static_cast<std::size_t>(plane) * plane_stride +
               static_cast<std::size_t>(row + 1) * stride +
               static_cast<std::size_t>(column + 1) * static_cast<std::size_t>(channel_count);
    }

    int plane_count;
    int plane_width;
    int plane_height;
    int channel_count;
    std::size_t stride;
    std::size_t plane_stride;
    std::vector<float> data;
};

// Points that are computed together: first their directions, then where they lie on a grid. x and y
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

// Writes the values at the first count positions of a batch, channel by channel, pixel by pixel; 0 where there
// is no position.
void sample(const SphereGrid &grid, Filter filter, const PointBatch &batch, std::size_t count,
            float *output);

// How a sphere lies on the planes of a grid.
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

    // Fills the border of a grid of this projection's size from its pixels.
    virtual void fill_border(SphereGrid &grid) const = 0;
};

#endif
