// SPDX-License-Identifier: MIT
//
// How coarse a map may be for an error of its surface, and what being coarse saved.

#ifndef CUBEMAP_TOOLS_OCTREE_BUDGET_HPP
#define CUBEMAP_TOOLS_OCTREE_BUDGET_HPP

#include <cstdint>
#include <optional>
#include <string>

#include <cubemap/octree.h>

// The coarsest edge whose voxels have no point farther from their centre than the budget: of the finest one, if it is given,
// doubled so often. UsageFailure if the finest is too coarse.
double edge_within_budget(double budget, std::optional<double> finest);

// What each saving of this map saved, in bytes of memory, as JSON of cm_budget. finest: the edge that the user would have; 0:
// this one. file_bytes: of its file.
std::string budget_report(const cm_octree *map, const cm_octree_count &count, double finest,
                          std::uint64_t file_bytes);

#endif
