// SPDX-License-Identifier: MIT

#include "sphere_grid.hpp"

#include <algorithm>
#include <new>

namespace
{

std::size_t product(std::size_t a, std::size_t b)
{
    std::size_t result = 0;
    if (__builtin_mul_overflow(a, b, &result))
    {
        throw std::bad_alloc();
    }
    return result;
}

void sample_nearest(const SphereGrid &grid, const PointBatch &batch, std::size_t count,
                    float *output)
{
    const std::size_t channels = static_cast<std::size_t>(grid.channels());
    for (std::size_t i = 0; i < count; ++i)
    {
        if (batch.plane[i] == no_plane)
        {
            std::fill_n(output + i * channels, channels, 0.0f);
            continue;
        }
        const int column = std::min(static_cast<int>(batch.x[i]), grid.width() - 1);
        const int row = std::min(static_cast<int>(batch.y[i]), grid.height() - 1);
        const float *const pixel = grid.pixel(batch.plane[i], column, row);
        std::copy(pixel, pixel + channels, output + i * channels);
    }
}

inline float mix(float a, float b, float weight)
{
    return a + weight * (b - a);
}

// CHANNELS 0 stands for any number, known at run time.
template <std::size_t CHANNELS>
void sample_bilinear(const SphereGrid &grid, const PointBatch &batch, std::size_t count,
                     float *output)
{
    const std::size_t channels =
        CHANNELS != 0 ? CHANNELS : static_cast<std::size_t>(grid.channels());
    const std::size_t stride = grid.row_stride();
    for (std::size_t i = 0; i < count; ++i)
    {
        float *const pixel = output + i * channels;
        if (batch.plane[i] == no_plane)
        {
            std::fill_n(pixel, channels, 0.0f);
            continue;
        }
        // Counted from the centre of the border's first pixel, so never negative.
        const double x = batch.x[i] + 0.5;
        const double y = batch.y[i] + 0.5;
        const int column = static_cast<int>(x);
        const int row = static_cast<int>(y);
        const float weight_x = static_cast<float>(x - column);
        const float weight_y = static_cast<float>(y - row);
        const float *const upper = grid.pixel(batch.plane[i], column - 1, row - 1);
        const float *const lower = upper + stride;
        for (std::size_t c = 0; c < channels; ++c)
        {
            const float above = mix(upper[c], upper[c + channels], weight_x);
            const float below = mix(lower[c], lower[c + channels], weight_x);
            pixel[c] = mix(above, below, weight_y);
        }
    }
}

} // namespace

SphereGrid::SphereGrid(int planes, int width, int height, int channels)
    : plane_count(planes), plane_width(width), plane_height(height), channel_count(channels),
      stride(product(static_cast<std::size_t>(width) + 2, static_cast<std::size_t>(channels))),
      plane_stride(product(stride, static_cast<std::size_t>(height) + 2)),
      data(product(plane_stride, static_cast<std::size_t>(planes)))
{
}

void sample(const SphereGrid &grid, Filter filter, const PointBatch &batch, std::size_t count,
            float *output)
{
    if (filter == Filter::nearest)
    {
        sample_nearest(grid, batch, count, output);
        return;
    }
    switch (grid.channels())
    {
    case 1:
        sample_bilinear<1>(grid, batch, count, output);
        break;
    case 3:
        sample_bilinear<3>(grid, batch, count, output);
        break;
    case 4:
        sample_bilinear<4>(grid, batch, count, output);
        break;
    default:
        sample_bilinear<0>(grid, batch, count, output);
    }
}
