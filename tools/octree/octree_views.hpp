// SPDX-License-Identifier: MIT
//
// The views that maps are made of: whether they say something, and whether they are near the map.

#ifndef CUBEMAP_TOOLS_OCTREE_VIEWS_HPP
#define CUBEMAP_TOOLS_OCTREE_VIEWS_HPP

#include "tools/cli/scene_handle.hpp"

#include <cubemap/octree.h>

// Has the view a pixel that measured something?
bool is_measured(const cm_view &view);

// Calls body for each view from one on. Those before it are passed over.
void for_views_from(cm_sequence *sequence, std::size_t first,
                    const std::function<void(const cm_view &)> &body);

// Failure if the camera is farther from the map than the map is wide: then its pose is none.
void check_near_map(const cm_octree_options &map, const cm_view &view, std::uint64_t number,
                    const std::string &folder);

// The same of all views before the first is read, if they are known.
void check_poses(const cm_sequence *sequence, const cm_octree_options &map,
                 const std::string &folder);

#endif
