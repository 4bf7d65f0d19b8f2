// SPDX-License-Identifier: MIT

#include "face_image_choice.hpp"
#include "chart_image.hpp"
#include "cube_image.hpp"

std::unique_ptr<FaceImage> make_face_image(const std::string &specification, const cm_frame &frame,
                                           int size)
{
    if (face_count(*make_mapping(specification, frame)) == 1)
    {
        return std::make_unique<ChartImage>(specification, size);
    }
    return std::make_unique<CubeImage>(specification, frame, size);
}
