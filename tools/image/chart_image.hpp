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

    double mean_scale() const override;

private:
    bool is_disc() const;
    bool is_on_map(const double uv[2]) const;
    double part_of_square() const;
};

#endif
