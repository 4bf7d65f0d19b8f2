// SPDX-License-Identifier: MIT
//
// The input of cubemap-reproject: finds out what it is, and reads it.

#ifndef CUBEMAP_TOOLS_REPROJECT_INPUT_HPP
#define CUBEMAP_TOOLS_REPROJECT_INPUT_HPP

#include "tools/image/face_names.hpp"
#include "tools/cli/image_file.hpp"
#include "reproject_options.hpp"

#include <memory>
#include <string>
#include <vector>

class Input
{
public:
    // Opens the files. Failure if they are not there, not images, or not of the shape that they
    // should have.
    explicit Input(const Options &options);

    Kind kind() const noexcept
    {
        return layout ? Kind::cube : chart ? Kind::chart : Kind::equirect;
    }
    const Projection &projection() const noexcept
    {
        return *sphere;
    }
    const std::vector<ImageFile> &files() const noexcept
    {
        return images;
    }

    // The pixels, with the border filled. Failure if a file turns out to be damaged.
    SphereGrid read(const Options &options, bool multiply_alpha, int threads);

    // "equirect 2048x1024, 3 channels, uint8"
    std::string description(const Options &options) const;

private:
    void open(const Options &options);
    void find_kind(const Options &options);
    void make_projection(const Options &options);
    void check_faces() const;
    void check_chart(const Options &options) const;
    int face_size_in_picture() const;
    void read_parts(SphereGrid &grid, const PictureLayout &picture, Finite finite);

    std::vector<ImageFile> images;
    std::optional<CubeLayout> layout; // of a cube
    bool chart = false;
    std::unique_ptr<Projection> sphere;
};

#endif
