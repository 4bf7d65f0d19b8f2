// SPDX-License-Identifier: MIT
//
// What a glTF file says beside what tinygltf has read of it.

#ifndef CUBEMAP_MODULES_SCENE_GLTF_TEXT_HPP
#define CUBEMAP_MODULES_SCENE_GLTF_TEXT_HPP

#include <string_view>

#include <tiny_gltf.h>

// tinygltf takes a number that it cannot read, such as an offset below 0, for one that is absent. Where the file, all of its
// bytes, has another number than the model: MeshFailure, which names the line where the file is a text.
void check_gltf_numbers(std::string_view bytes, const tinygltf::Model &model);

#endif
