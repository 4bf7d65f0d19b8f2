// SPDX-License-Identifier: MIT

#include "gltf_numbers.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace
{

const char *const damaged = "has an accessor that is none";

// Elements that are 0 but for some: few bytes may ask for very many, of which a mesh makes nothing.
constexpr std::size_t most_zeros = std::size_t{1} << 24;

template <typename Value> Value read_value(const unsigned char *from)
{
    Value value;
    std::memcpy(&value, from, sizeof value);
    return value;
}

// The bytes of a buffer view from `offset` on, `length` of them.
const unsigned char *bytes_of(const tinygltf::Model &model, int view_index, std::size_t offset,
                              std::size_t length, const std::string &whose)
{
    const tinygltf::BufferView &view = gltf_element(model.bufferViews, view_index, "a buffer view");
    const tinygltf::Buffer &buffer = gltf_element(model.buffers, view.buffer, "a buffer");
    if (offset > view.byteLength || length > view.byteLength - offset)
    {
        throw MeshFailure("has " + whose + ", which ends behind its buffer view");
    }
    return buffer.data.data() + view.byteOffset + offset; // check_views
}

std::size_t index_at(const unsigned char *from, std::size_t size)
{
    return size == 1   ? *from
           : size == 2 ? read_value<std::uint16_t>(from)
                       : read_value<std::uint32_t>(from);
}

} // namespace

std::size_t gltf_index_size(int type)
{
    return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE    ? 1
           : type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ? 2
           : type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT   ? 4
                                                            : 0;
}

GltfNumbers::GltfNumbers(const tinygltf::Model &model, int which)
    : accessor(gltf_element(model.accessors, which, "an accessor")),
      name("accessor " + std::to_string(which))
{
    const int size =
        tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(accessor.componentType));
    const int count = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
    if (size <= 0 || count <= 0 || accessor.count > largest_gltf ||
        accessor.byteOffset > largest_gltf)
    {
        throw MeshFailure(damaged);
    }
    component = static_cast<std::size_t>(size);
    components = static_cast<std::size_t>(count);
    if (accessor.bufferView >= 0 || !accessor.sparse.isSparse)
    {
        read_dense(model);
    }
    else if (accessor.count > most_zeros)
    {
        throw MeshFailure("has " + name + ", of more than " + std::to_string(most_zeros) +
                          " elements without a buffer view");
    }
    if (accessor.sparse.isSparse)
    {
        replace_some(model);
    }
}

void GltfNumbers::read_dense(const tinygltf::Model &model)
{
    const int step =
        accessor.ByteStride(gltf_element(model.bufferViews, accessor.bufferView, "a buffer view"));
    if (step <= 0)
    {
        throw MeshFailure(damaged);
    }
    stride = static_cast<std::size_t>(step);
    const std::size_t length =
        accessor.count == 0 ? 0 : (accessor.count - 1) * stride + component * components;
    data = bytes_of(model, accessor.bufferView, accessor.byteOffset, length, name);
}

void GltfNumbers::replace_some(const tinygltf::Model &model)
{
    const std::size_t size = component * components;
    const std::size_t count = static_cast<std::size_t>(accessor.sparse.count);
    const auto &where = accessor.sparse.indices;
    const std::size_t step = gltf_index_size(where.componentType);
    if (step == 0)
    {
        throw MeshFailure("has " + name + ", whose sparse indices are no whole numbers");
    }
    const unsigned char *const indices =
        bytes_of(model, where.bufferView, static_cast<std::size_t>(where.byteOffset), count * step,
                 name + "'s sparse indices");
    const unsigned char *const values =
        bytes_of(model, accessor.sparse.values.bufferView,
                 static_cast<std::size_t>(accessor.sparse.values.byteOffset), count * size,
                 name + "'s sparse values");
    own.resize(accessor.count * size);
    for (std::size_t i = 0; data != nullptr && i < accessor.count; ++i)
    {
        std::memcpy(own.data() + i * size, data + i * stride, size);
    }
    std::size_t least = 0;
    for (std::size_t i = 0; i < count; ++i)
    {
        const std::size_t index = index_at(indices + i * step, step);
        if (index < least || index >= accessor.count)
        {
            throw MeshFailure("has " + name + ", whose sparse indices do not rise below its count");
        }
        std::memcpy(own.data() + index * size, values + i * size, size);
        least = index + 1;
    }
    data = own.data();
    stride = size;
}

double GltfNumbers::at(std::size_t i, std::size_t k) const
{
    const unsigned char *const from = data + i * stride + k * component;
    switch (accessor.componentType)
    {
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
        return static_cast<double>(read_value<float>(from));
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        return read_value<std::int8_t>(from);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return *from;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        return read_value<std::int16_t>(from);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return read_value<std::uint16_t>(from);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return read_value<std::uint32_t>(from);
    default:
        throw MeshFailure(damaged);
    }
}

double GltfNumbers::one() const
{
    switch (type())
    {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        return 127.0;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return 255.0;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        return 32767.0;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return 65535.0;
    default:
        return 1.0;
    }
}

double GltfNumbers::value(std::size_t i, std::size_t k) const
{
    const bool is_scaled = accessor.normalized && type() != TINYGLTF_COMPONENT_TYPE_FLOAT;
    return is_scaled ? std::max(at(i, k) / one(), -1.0) : at(i, k);
}
