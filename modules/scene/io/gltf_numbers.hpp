// SPDX-License-Identifier: MIT
//
// The numbers that accessors of a glTF file stand for.

#ifndef CUBEMAP_MODULES_SCENE_GLTF_NUMBERS_HPP
#define CUBEMAP_MODULES_SCENE_GLTF_NUMBERS_HPP

#include "flat_mesh.hpp"

#include <tiny_gltf.h>

#include <cstddef>
#include <string>
#include <vector>

// Bytes of a file, and numbers of an accessor.
constexpr std::size_t largest_gltf = std::size_t{1} << 31;

template <typename Value>
const Value &gltf_element(const std::vector<Value> &list, int index, const char *what)
{
    if (index < 0 || static_cast<std::size_t>(index) >= list.size())
    {
        throw MeshFailure(std::string("names ") + what + " that is not there");
    }
    return list[static_cast<std::size_t>(index)];
}

// Bytes of an index of that component type; 0 for types that indices do not have (glTF 2.0, 3.7.2.1 and 5.4.1).
std::size_t gltf_index_size(int type);

// Within their buffer views, which lie within their buffers. Of a sparse accessor (glTF 2.0, 3.6.2.3) they are a copy: those
// of its buffer view, or 0 where it has none, but for some that stand elsewhere.
class GltfNumbers
{
public:
    GltfNumbers(const tinygltf::Model &model, int which);
    GltfNumbers(const GltfNumbers &) = delete;
    GltfNumbers &operator=(const GltfNumbers &) = delete;

    std::size_t count() const
    {
        return accessor.count;
    }
    std::size_t width() const
    {
        return components;
    }
    int type() const
    {
        return accessor.componentType;
    }
    double at(std::size_t i, std::size_t k) const;
    // What a normalised whole number counts as 1.
    double one() const;
    // The number that is meant: glTF 2.0, 3.6.2.2, where it is normalised; -128 / 127 is -1.
    double value(std::size_t i, std::size_t k) const;

private:
    void read_dense(const tinygltf::Model &model);
    void replace_some(const tinygltf::Model &model);

    const tinygltf::Accessor &accessor;
    std::string name; // "accessor 3"
    const unsigned char *data = nullptr;
    std::size_t component = 0;
    std::size_t components = 0;
    std::size_t stride = 0;
    std::vector<unsigned char> own; // of a sparse accessor
};

#endif
