// SPDX-License-Identifier: MIT

#include "view_check.hpp"

#include <cmath>
#include <cstring>

void OwnPicture::shape(std::uint32_t width, std::uint32_t height, std::uint32_t channels,
                       cm_pixel_type type)
{
    bytes.resize(std::size_t{width} * height * channels * cm_pixel_size(type));
    image = {};
    image.size = sizeof image;
    image.data = bytes.data();
    image.type = type;
    image.width = width;
    image.height = height;
    image.channels = channels;
}

std::ptrdiff_t pixel_step(const cm_image &image)
{
    return image.pixel_stride != 0
               ? image.pixel_stride
               : static_cast<std::ptrdiff_t>(cm_pixel_size(image.type) * image.channels);
}

const unsigned char *row_of(const cm_image &image, std::uint32_t row)
{
    const std::ptrdiff_t stride =
        image.row_stride != 0 ? image.row_stride : pixel_step(image) * std::ptrdiff_t{image.width};
    return static_cast<const unsigned char *>(image.data) + std::ptrdiff_t{row} * stride;
}

namespace
{

std::string picture_fault(const char *what, const cm_image &image, const cm_camera_options &camera)
{
    if (image.width != camera.width || image.height != camera.height)
    {
        return std::string(what) + " is " + std::to_string(image.width) + " x " +
               std::to_string(image.height) + " pixels; the camera has " +
               std::to_string(camera.width) + " x " + std::to_string(camera.height);
    }
    if (image.channels < 1 || image.channels > CM_CHANNELS_MAX || cm_pixel_size(image.type) == 0)
    {
        return std::string(what) + " has channels or a type that no picture has";
    }
    return "";
}

} // namespace

std::string view_fault(const cm_view &view, const cm_camera *camera)
{
    const cm_camera_options &options = *cm_camera_describe(camera);
    if (view.size != sizeof view || view.depth.data == nullptr)
    {
        return "a view without depth";
    }
    if (!std::isfinite(view.time))
    {
        return "a time that is not finite";
    }
    if (cm_pose_check(&view.pose) != CM_OK)
    {
        return "a pose that is none";
    }
    if (!(view.depth_unit > 0.0) || !std::isfinite(view.depth_unit))
    {
        return "a unit of depth that is not greater than 0";
    }
    std::string fault = picture_fault("depth", view.depth, options);
    if (fault.empty() && (view.depth.channels != 1 ||
                          (view.depth.type != CM_PIXEL_U16 && view.depth.type != CM_PIXEL_FLOAT)))
    {
        fault = "depth is not one channel of 16 bits or floating point";
    }
    if (fault.empty() && view.color.data != nullptr)
    {
        fault = picture_fault("color", view.color, options);
    }
    if (fault.empty() && view.amplitude.data != nullptr)
    {
        fault = picture_fault("amplitude", view.amplitude, options);
    }
    return fault;
}
