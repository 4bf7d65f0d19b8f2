// SPDX-License-Identifier: MIT
//
// A quantity of distortion along the rows of the faces of a mapping.

#ifndef CUBEMAP_TOOLS_DISTORTION_ROWS_HPP
#define CUBEMAP_TOOLS_DISTORTION_ROWS_HPP

#include "tools/image/face_image.hpp"
#include "quantity.hpp"

class DistortionRows
{
public:
    DistortionRows(const std::string &specification, const cm_frame &frame, int face_size,
                   const Quantity &wanted);

    const Projection &projection() const noexcept
    {
        return *faces;
    }

    // That for the mean scale of the mapping.
    const Quantity &what() const noexcept
    {
        return quantity;
    }

    // The values at the centres of a row's pixels; NaN beside a disc.
    void evaluate(int face, int row, double *values) const;

    // Lowers the distance of each pixel of the row, whose values these are, to that of the nearest
    // isoline, in pixels, by differences of the quantity across the pixel.
    void lower_distances(int face, int row, double step, const double *values,
                         double *distance) const;

private:
    void evaluate_batch(std::size_t count, const PointBatch &batch, double *values) const;

    std::unique_ptr<FaceImage> faces;
    MappingPointer mapping;
    int size;
    const Quantity quantity;
};

#endif
