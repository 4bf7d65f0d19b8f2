// SPDX-License-Identifier: MIT
//
// What a glTF file says beside what tinygltf has read of it.

#ifndef CUBEMAP_MODULES_SCENE_GLTF_TEXT_HPP
#define CUBEMAP_MODULES_SCENE_GLTF_TEXT_HPP

#include <string>
#include <string_view>
#include <vector>

#include <tiny_gltf.h>

// tinygltf reads binary files of any version, and a last chunk that ends up to 8 bytes behind the file. MeshFailure for such
// bytes; none for what is no binary file.
void check_gltf_chunks(std::string_view bytes);

// tinygltf takes a number that it cannot read, such as an offset below 0, for one that is absent. Where the file, all of its
// bytes, has another number than the model: MeshFailure, which names the line where the file is a text.
void check_gltf_numbers(std::string_view bytes, const tinygltf::Model &model);

// What a file asks of its reader.
struct GltfNeeds
{
    std::string version;
    std::string least_version;
    std::vector<std::string> extensions;
};

// As the text of a file has it, all of whose bytes are given; nothing, where it is no JSON.
GltfNeeds needs_of_gltf(std::string_view bytes);

// How many bytes it wants of each buffer that is a file of its own, in order; as many as there are where that is no number.
std::vector<double> lengths_of_gltf_files(std::string_view bytes);

#endif
