// SPDX-License-Identifier: MIT
//
// The maps of cubemap-octree: in their files and open, and what a run has noted in them.

#ifndef CUBEMAP_TOOLS_OCTREE_MAP_HPP
#define CUBEMAP_TOOLS_OCTREE_MAP_HPP

#include "tools/cli/program.hpp"
#include "tools/cli/scene_handle.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <string>

#include <cubemap/octree.h>
#include <cubemap/store.h>

using StorePointer = std::unique_ptr<cm_store, HandleDeleter<cm_store_destroy>>;
using OctreePointer = std::unique_ptr<cm_octree, HandleDeleter<cm_octree_destroy>>;

// A map, and the store that the rest of it is in if it has one, which must outlive it.
struct OctreeMap
{
    StorePointer store;
    OctreePointer map;
};

// What a run notes in the file: how far it has come, and of what it is.
struct OctreeRun
{
    std::uint64_t views = 0;
    std::uint64_t empty = 0; // of these: without a measurement
    bool complete = true;
    std::string settings; // one line that tells runs apart
};

// "" for what is no note.
std::string note_of(const OctreeRun &run);
OctreeRun read_note(const cm_octree *map);

// Opens a MAP of the command line to read: one of ours, or of OctoMap. memory: bytes, 0 for no limit.
OctreeMap open_map(const std::string &path, std::uint64_t memory);

// Writes a map into a file of its own, which appears when it is complete.
void save_map(cm_octree *map, const std::string &path, const OctreeRun &run);

// Failure if a call on a map did not go well; what is it about, in words, or the file's name in quotes; after ends the message.
void check_map(cm_status status, const std::string &what, const cm_store *store = nullptr,
               const std::string &after = "");

// UsageFailure if the map of a file has no such level.
void check_level(int level, const cm_octree *map, const std::string &path);

cm_octree_count count_map(const cm_octree *map, const std::string &path);

// Arguments of options: UsageFailure if they are none.
std::array<double, 3> read_place(OptionReader &reader);
std::uint64_t read_memory(OptionReader &reader);

// A map as it is without a word, and options that say where its voxels are: false if it is another option.
cm_octree_options standard_map();
bool read_grid_option(int id, OptionReader &reader, cm_octree_options &map);

// The MAP and what else is asked for among the operands.
std::vector<std::string> needed_operands(const OptionReader &reader, std::size_t count,
                                         const std::string &names);
void need_output(const std::string &output, const std::string &what);

// The one pose of a file.
cm_pose read_one_pose(const std::string &path);

#endif
