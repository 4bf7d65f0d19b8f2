// SPDX-License-Identifier: MIT
//
// Pictures of views: their bytes, and whether a view is one.

#ifndef CUBEMAP_MODULES_SCENE_VIEW_CHECK_HPP
#define CUBEMAP_MODULES_SCENE_VIEW_CHECK_HPP

#include <cubemap/view.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

struct CameraDestroyer
{
    void operator()(cm_camera *camera) const noexcept
    {
        cm_camera_destroy(camera);
    }
};
using CameraPointer = std::unique_ptr<cm_camera, CameraDestroyer>;

// A picture with memory of its own, which grows.
struct OwnPicture
{
    std::vector<unsigned char> bytes;
    cm_image image = {};

    // Room for so many pixels, one beside the other.
    void shape(std::uint32_t width, std::uint32_t height, std::uint32_t channels,
               cm_pixel_type type);
    // No picture.
    void clear()
    {
        image = {};
        image.size = sizeof image;
    }
};

// The first byte of a row, and the bytes from a pixel to the next.
const unsigned char *row_of(const cm_image &image, std::uint32_t row);
std::ptrdiff_t pixel_step(const cm_image &image);

// "" if the view is one of this camera's: a pose, a unit, and pictures of the camera's size; else what is wrong.
std::string view_fault(const cm_view &view, const cm_camera *camera);

#endif
