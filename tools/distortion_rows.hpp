// SPDX-License-Identifier: MIT
//
// A quantity of distortion along the rows of the faces of a cube.

#ifndef CUBEMAP_TOOLS_DISTORTION_ROWS_HPP
#define CUBEMAP_TOOLS_DISTORTION_ROWS_HPP

#include "cube_image.hpp"
#include "quantity.hpp"

class DistortionRows
{
public:
    DistortionRows(const std::string &specification, const cm_frame &frame, int face_size,
                   const Quantity &what);

    const Projection &projection() const noexcept
    {
        return cube;
    }

    // The values at the centres of a row's pixels.
    void evaluate(int face, int row, double *values) const;

    // Lowers the distance of each pixel of the row, whose values these are, to that of the nearest
    // isoline, in pixels, by differences of the quantity across the pixel.
    void lower_distances(int face, int row, double step, const double *values,
                         double *distance) const;

private:
    void evaluate_batch(std::size_t count, const PointBatch &batch, double *values) const;

    CubeImage cube;
    MappingPointer mapping;
    int size;
    const Quantity &quantity;
};

#endif
