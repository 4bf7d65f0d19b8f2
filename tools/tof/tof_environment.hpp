// SPDX-License-Identifier: MIT
//
// The surroundings' light, from a picture of the sphere.

#ifndef CUBEMAP_TOOLS_TOF_ENVIRONMENT_HPP
#define CUBEMAP_TOOLS_TOF_ENVIRONMENT_HPP

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <cubemap/sim.h>

// What it points to it owns.
struct TofEnvironment
{
    std::shared_ptr<const cm_mapping> mapping;
    std::vector<float> radiance;
    cm_tof_environment given = {};
};

// A picture in a mapping is taken as it is, each other one is resampled to a cube. Of colours the mean counts. Failure if it
// cannot be read, or has what is no radiance; UsageFailure if surface, equirectangular if there is none, is not the picture's.
std::unique_ptr<TofEnvironment> read_tof_environment(const std::string &path,
                                                     const std::optional<std::string> &surface,
                                                     unsigned threads);

#endif
