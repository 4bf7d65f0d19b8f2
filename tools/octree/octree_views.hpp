// SPDX-License-Identifier: MIT
//
// The views that maps are made of: whether they say something, and whether they are near the map.

#ifndef CUBEMAP_TOOLS_OCTREE_VIEWS_HPP
#define CUBEMAP_TOOLS_OCTREE_VIEWS_HPP

#include "tools/cli/scene_handle.hpp"

#include <cubemap/octree.h>

// The greatest depth, or range, that a view measured; 0 if it measured nothing.
double greatest_depth(const cm_view &view);

// What tells the sequence of a folder from another: all poses and names of files, and what is in the first. Another
// may be broken, and mended before the run goes on.
std::uint64_t sequence_sum(const cm_sequence *sequence, const std::string &folder);

// Calls body for each view from one on. Those before it are passed over.
void for_views_from(cm_sequence *sequence, std::size_t first,
                    const std::function<void(const cm_view &)> &body);

// Failure if the camera is farther from the map than the map is wide, and than a hundred times what it measured: then its
// pose is none.
void check_near_map(const cm_octree_options &map, const cm_view &view, double depth,
                    std::uint64_t number, const std::string &folder);

// What is said of a view that cm_octree_update refuses for its depths, as of a background that is not marked.
Failure refused_depth(const cm_octree_options &map, const cm_view &view, double depth,
                      std::uint64_t number, const std::string &folder);

#endif
