// SPDX-License-Identifier: MIT

#include "distortion_rows.hpp"

#include "tools/image/face_image_choice.hpp"

#include <algorithm>
#include <cmath>

namespace
{

// Where the whole face changes by less than this part of the value, a line would be rounding.
constexpr double flat = 1e-9;

// Per pixel, on the steeper side of its centre: on a crease the two sides may cancel.
double slope(double before, double at, double behind)
{
    return 2 * std::fmax(std::fabs(at - before), std::fabs(behind - at));
}

// The distance of a value from the nearest multiple of step, in pixels.
double isoline_distance(const Quantity &quantity, double value, double step, double by_pixel,
                        int size)
{
    const double line = std::round(value / step) * step;
    const bool blot = line <= quantity.least * (1 + flat);
    return blot || !(by_pixel * size > flat * value) ? HUGE_VAL
                                                     : std::fabs(value - line) / by_pixel;
}

} // namespace

DistortionRows::DistortionRows(const std::string &specification, const cm_frame &frame,
                               int face_size, const Quantity &wanted)
    : faces(make_face_image(specification, frame, face_size)),
      mapping(make_mapping(specification, frame)), size(face_size),
      quantity(face_count(*mapping) == 6 ? wanted : with_mean_scale(wanted, faces->mean_scale()))
{
}

void DistortionRows::evaluate_batch(std::size_t count, const PointBatch &batch,
                                    double *values) const
{
    cm_distortion_arrays arrays = {};
    arrays.*quantity.values = values;
    cm_inverse_distortion_array(mapping.get(), count, batch.plane.data(), batch.x.data(),
                                batch.y.data(), &arrays);
    for (std::size_t i = 0; i < count; ++i)
    {
        values[i] *= quantity.factor;
    }
}

void DistortionRows::evaluate(int face, int row, double *values) const
{
    thread_local PointBatch batch;
    for (int column = 0; column < size;)
    {
        const std::size_t count =
            std::min(PointBatch::capacity, static_cast<std::size_t>(size - column));
        faces->face_coordinates(face, row, column, count, batch);
        evaluate_batch(count, batch, values + column);
        column += static_cast<int>(count);
    }
}

void DistortionRows::lower_distances(int face, int row, double step, const double *values,
                                     double *distance) const
{
    thread_local PointBatch batch;
    thread_local std::array<DerivativeBatch::Numbers, 4> around; // left, right, and along v
    const double shift[4][2] = {
        {-1.0 / size, 0}, {1.0 / size, 0}, {0, -1.0 / size}, {0, 1.0 / size}};
    for (int column = 0; column < size;)
    {
        const std::size_t count =
            std::min(PointBatch::capacity, static_cast<std::size_t>(size - column));
        for (std::size_t side = 0; side < 4; ++side)
        {
            faces->face_coordinates(face, row, column, count, batch);
            for (std::size_t i = 0; i < count; ++i)
            {
                batch.x[i] += shift[side][0];
                batch.y[i] += shift[side][1];
            }
            evaluate_batch(count, batch, around[side].data());
        }
        for (std::size_t i = 0; i < count; ++i)
        {
            const std::size_t at = static_cast<std::size_t>(column) + i;
            const double by_pixel = std::hypot(slope(around[0][i], values[at], around[1][i]),
                                               slope(around[2][i], values[at], around[3][i]));
            distance[at] = std::fmin(distance[at],
                                     isoline_distance(quantity, values[at], step, by_pixel, size));
        }
        column += static_cast<int>(count);
    }
}
