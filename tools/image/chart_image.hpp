// SPDX-License-Identifier: MIT
//
// Mappings of one face: a disc in a square image, a square that is all of it, or one with gaps. The first row is
// that of v = 1.

#ifndef CUBEMAP_TOOLS_CHART_IMAGE_HPP
#define CUBEMAP_TOOLS_CHART_IMAGE_HPP

#include "face_image.hpp"

class ChartImage : public FaceImage
{
public:
    // An image of image_size x image_size pixels. The specification must be one that the library takes,
    // for one face.
    ChartImage(const std::string &specification, int image_size);

    void fill_border(SphereGrid &grid) const override;

    double mean_scale() const override;

private:
    bool is_disc() const;
    bool border_is_point() const;
    void fill_square_border(SphereGrid &grid) const;
    void fill_beyond_rim(SphereGrid &grid) const;
    void fill_gaps(SphereGrid &grid) const;
    bool is_on_map(const double uv[2]) const;
    double part_of_square() const;
    void copy_continuation(SphereGrid &grid, int column, int row, int from_column,
                           int from_row) const;

    const bool gaps;  // are there places of the square that are not on the map?
    const bool point; // is the whole border, or rim, one point of the sphere?
};

#endif
