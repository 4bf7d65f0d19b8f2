// SPDX-License-Identifier: MIT
//
// Mappings of one face: a disc in a square image, or a square that is all of it. The first row is that of
// v = 1.

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

    const bool point; // is the whole border, or rim, one point of the sphere?
};

#endif
