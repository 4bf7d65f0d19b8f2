// SPDX-License-Identifier: MIT
//
// A mesh as the readers of files make it, before anything of it is checked.

#ifndef CUBEMAP_MODULES_SCENE_FLAT_MESH_HPP
#define CUBEMAP_MODULES_SCENE_FLAT_MESH_HPP

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

struct FlatMesh
{
    std::vector<double> position; // three a vertex
    std::vector<float> color;     // three a vertex
    std::vector<std::uint32_t> index;
};

// What is wrong with a file, without its name; it may begin with ":LINE: ".
class MeshFailure : public std::runtime_error
{
public:
    using std::runtime_error::runtime_error;
};

// Each reads a file. MeshFailure, and whatever the libraries throw.
FlatMesh read_gltf(const std::string &path);
FlatMesh read_obj(const std::string &path);

#endif
