// SPDX-License-Identifier: MIT
//
// BRDFs of what a scene's JSON says.

#ifndef CUBEMAP_TOOLS_TOF_BRDF_HPP
#define CUBEMAP_TOOLS_TOF_BRDF_HPP

#include "tools/cli/scene_world.hpp"

// Nothing if numbers are outside their ranges.
std::shared_ptr<const cm_brdf> make_brdf(const BrdfDescription &description);

#endif
