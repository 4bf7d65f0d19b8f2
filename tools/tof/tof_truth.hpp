// SPDX-License-Identifier: MIT
//
// What is truly there in a frame: found, and into a file.

#ifndef CUBEMAP_TOOLS_TOF_TRUTH_HPP
#define CUBEMAP_TOOLS_TOF_TRUTH_HPP

#include "tof_frame.hpp"

#include <memory>
#include <string>
#include <vector>

// The pictures of the truth of one camera, and effects from the flags of a frame.
class TruthPictures
{
public:
    explicit TruthPictures(const cm_camera *of);

    // At a time, with flows to the next frame's and the one before.
    void find(const cm_tof_scene *scene, const cm_trajectory *trajectory, double time, double next,
              double before, const std::vector<std::uint8_t> &flags, cm_pool *pool);

    // All of it as modules/sim/io/truth_file.h has it; complete, to appear later.
    std::unique_ptr<AtomicFile> write(const std::string &path) const;

    // Where all is: what has three coordinates has them one after another.
    cm_tof_truth arrays() const;

private:
    const cm_camera *camera;
    std::size_t pixels;
    std::vector<double> position;
    std::vector<float> normal;
    std::vector<std::uint32_t> ids;
    std::vector<float> ranges;
    std::vector<float> flow;
    std::vector<std::uint8_t> seen;
};

// Bytes of a pixel, and of what its file takes while it is written.
std::size_t truth_pixel_bytes();

#endif
