// SPDX-License-Identifier: MIT
//
// The files of one image that is compared, and how the sphere lies on it. Six faces are one image, a strip in their order.

#ifndef CUBEMAP_TOOLS_COMPARED_FILES_HPP
#define CUBEMAP_TOOLS_COMPARED_FILES_HPP

#include "tools/image/sphere_files.hpp"

#include <memory>
#include <string>
#include <vector>

class ComparedFiles
{
public:
    // option says specification, which may be "". Failure if there are no such images.
    ComparedFiles(const std::string &name, const std::string &option,
                  const std::string &specification);

    int width() const;
    int height() const;
    int channels() const;
    std::string channel_name(int channel) const;
    bool holds_integers() const;
    // Are the numbers proportional to light, or have they sRGB's curve? Of some files nobody knows.
    bool holds_light() const;
    bool holds_curve() const;

    // "'earth.png' is 64 x 32 with 3 channels"
    std::string size_text() const;

    bool is_six() const;
    bool is_told() const;

    // For a comparison on the sphere: a raster is warped to where it is. Failure if it cannot be.
    void open_placed();

    // The kind of surface that the files tell, which pictures have in common that may be compared as they stand: a cube
    // with its mapping, frame and layout; "": none.
    std::string told() const;

    // Finds the surface: what the option says, or the files do, or 2:1 is equirectangular. UsageFailure if nobody knows, or
    // if it is none of this image.
    std::shared_ptr<const cm_surface> surface();

    // Lines for people about what is not as it seems; behind surface().
    const std::vector<std::string> &warnings() const;

    // Rows of all channels. Failure if a file is damaged.
    std::vector<float> pixels();

private:
    std::shared_ptr<const cm_surface> made(const std::string &text,
                                           const std::optional<cm_rotation> &rotation) const;

    std::string option;
    std::string specification;
    SphereFiles files;
};

#endif
