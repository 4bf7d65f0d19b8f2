// SPDX-License-Identifier: MIT

#include "gltf_text.hpp"

#include "file_failure.hpp"
#include "flat_mesh.hpp"
#include "modules/image/io/file_words.h"
#include "parsed_json.hpp"

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace
{

// glTF 2.0, 4.4: a header of 12 bytes (mark, version, length of all), then chunks: length, kind, as many bytes.
constexpr std::size_t header_size = 12;
constexpr std::size_t chunk_head_size = 8;

bool is_binary(std::string_view bytes)
{
    return bytes.size() >= header_size + chunk_head_size && bytes.substr(0, 4) == "glTF";
}

std::uint32_t word_at(std::string_view bytes, std::size_t place)
{
    return cm_file_u32(reinterpret_cast<const unsigned char *>(bytes.data()) + place);
}

// The first chunk is the text.
std::string_view text_of(std::string_view bytes)
{
    return is_binary(bytes)
               ? bytes.substr(header_size + chunk_head_size, word_at(bytes, header_size))
               : bytes;
}

class GltfText
{
public:
    GltfText(std::string_view bytes, const tinygltf::Model &read)
        : text(text_of(bytes)), is_text(text.size() == bytes.size()), model(read)
    {
    }

    void check() const
    {
        JsonFault fault;
        const JsonPointer json = parse_json_object(text, fault);
        root = json.get();
        if (root == nullptr)
        {
            throw MeshFailure((is_text ? ":" + std::to_string(fault.line) + ": " : "") +
                              fault.what);
        }
        whole(root, "a root", "scene", model.defaultScene);
        check_each("scenes", "scene ", model.scenes, &GltfText::check_scene);
        check_each("nodes", "node ", model.nodes, &GltfText::check_node);
        check_each("meshes", "mesh ", model.meshes, &GltfText::check_mesh);
        check_each("materials", "material ", model.materials, &GltfText::check_material);
        check_each("accessors", "accessor ", model.accessors, &GltfText::check_accessor);
        check_each("bufferViews", "buffer view ", model.bufferViews, &GltfText::check_view);
    }

private:
    // The last of that name, as tinygltf has it.
    static const cJSON *member(const cJSON *object, const char *key)
    {
        const cJSON *last = nullptr;
        const bool has_members = cJSON_IsObject(object);
        for (const cJSON *item = has_members ? object->child : nullptr; item != nullptr;
             item = item->next)
        {
            last = std::strcmp(item->string, key) == 0 ? item : last;
        }
        return last;
    }

    [[noreturn]] void fail(const cJSON *item, const std::string &who, const char *key,
                           const char *what) const
    {
        const std::string line =
            is_text ? ":" + std::to_string(line_of_item(text, root, item)) + ": " : "";
        throw MeshFailure(line + "has " + who + ", whose " + key +
                          (cJSON_IsNumber(item) ? " is " + number_text(item->valuedouble) + ", not "
                                                : " is not ") +
                          what);
    }

    template <typename Read>
    void whole(const cJSON *object, const std::string &who, const char *key, Read read) const
    {
        const cJSON *const item = member(object, key);
        if (item != nullptr && !is_whole(item, static_cast<double>(read)))
        {
            fail(item, who, key, "a whole number of 0 or more, in digits alone");
        }
    }

    static bool is_whole(const cJSON *item, double read)
    {
        return cJSON_IsNumber(item) && item->valuedouble >= 0 && item->valuedouble == read;
    }

    template <typename Value, typename Same>
    void list(const cJSON *object, const std::string &who, const char *key,
              const std::vector<Value> &read, const Same &same, const char *what) const
    {
        const cJSON *const items = member(object, key);
        if (items == nullptr)
        {
            return;
        }
        bool good = cJSON_IsArray(items);
        std::size_t at = 0;
        for (const cJSON *item = items->child; good && item != nullptr; item = item->next)
        {
            good = at < read.size() && same(item, static_cast<double>(read[at]));
            ++at;
        }
        if (!good || at != read.size())
        {
            fail(items, who, key, what);
        }
    }

    void indices(const cJSON *object, const std::string &who, const char *key,
                 const std::vector<int> &read) const
    {
        list(object, who, key, read, is_whole, "a list of whole numbers of 0 or more");
    }

    void numbers(const cJSON *object, const std::string &who, const char *key,
                 const std::vector<double> &read) const
    {
        const auto same = [](const cJSON *item, double number)
        { return cJSON_IsNumber(item) && item->valuedouble == number; };
        list(object, who, key, read, same, "a list of numbers");
    }

    template <typename Element>
    void check_each(const char *key, const char *who, const std::vector<Element> &read,
                    void (GltfText::*check_one)(const cJSON *, const std::string &, const Element &)
                        const) const
    {
        const cJSON *const items = member(root, key);
        std::size_t at = 0;
        for (const cJSON *item = items == nullptr ? nullptr : items->child; item != nullptr;
             item = item->next)
        {
            if (at >= read.size())
            {
                break;
            }
            (this->*check_one)(item, who + std::to_string(at), read[at]);
            ++at;
        }
        if (items != nullptr && (!cJSON_IsArray(items) || at != read.size() ||
                                 static_cast<std::size_t>(cJSON_GetArraySize(items)) != at))
        {
            fail(items, "a root", key, "a list of objects");
        }
    }

    void check_scene(const cJSON *item, const std::string &who, const tinygltf::Scene &scene) const
    {
        indices(item, who, "nodes", scene.nodes);
    }

    void check_node(const cJSON *item, const std::string &who, const tinygltf::Node &node) const
    {
        whole(item, who, "mesh", node.mesh);
        indices(item, who, "children", node.children);
        numbers(item, who, "matrix", node.matrix);
        numbers(item, who, "translation", node.translation);
        numbers(item, who, "rotation", node.rotation);
        numbers(item, who, "scale", node.scale);
    }

    void check_mesh(const cJSON *item, const std::string &who, const tinygltf::Mesh &mesh) const
    {
        // one that it cannot read is left out
        const cJSON *const parts = member(item, "primitives");
        if (parts != nullptr &&
            static_cast<std::size_t>(cJSON_GetArraySize(parts)) != mesh.primitives.size())
        {
            fail(parts, who, "primitives", "a list of primitives with accessors as attributes");
        }
        const cJSON *part = parts == nullptr ? nullptr : parts->child;
        for (const tinygltf::Primitive &primitive : mesh.primitives)
        {
            whole(part, who, "indices", primitive.indices);
            whole(part, who, "material", primitive.material);
            whole(part, who, "mode", primitive.mode);
            for (const auto &[name, accessor] : primitive.attributes)
            {
                whole(member(part, "attributes"), who, name.c_str(), accessor);
            }
            part = part->next;
        }
    }

    void check_material(const cJSON *item, const std::string &who,
                        const tinygltf::Material &material) const
    {
        const cJSON *const looks = member(item, "pbrMetallicRoughness");
        numbers(looks, who, "baseColorFactor", material.pbrMetallicRoughness.baseColorFactor);
    }

    void check_accessor(const cJSON *item, const std::string &who,
                        const tinygltf::Accessor &accessor) const
    {
        whole(item, who, "bufferView", accessor.bufferView);
        whole(item, who, "byteOffset", accessor.byteOffset);
        whole(item, who, "count", accessor.count);
        whole(item, who, "componentType", accessor.componentType);
        const cJSON *const normalized = member(item, "normalized");
        if (normalized != nullptr && !cJSON_IsBool(normalized))
        {
            fail(normalized, who, "normalized", "true or false");
        }
        if (accessor.sparse.isSparse)
        {
            const cJSON *const sparse = member(item, "sparse");
            const std::string whose = who + " with sparse numbers";
            whole(sparse, whose, "count", accessor.sparse.count);
            check_place(member(sparse, "indices"), whose, accessor.sparse.indices);
            whole(member(sparse, "indices"), whose, "componentType",
                  accessor.sparse.indices.componentType);
            check_place(member(sparse, "values"), whose, accessor.sparse.values);
        }
    }

    template <typename Place>
    void check_place(const cJSON *item, const std::string &who, const Place &place) const
    {
        whole(item, who, "bufferView", place.bufferView);
        whole(item, who, "byteOffset", place.byteOffset);
    }

    void check_view(const cJSON *item, const std::string &who,
                    const tinygltf::BufferView &view) const
    {
        whole(item, who, "buffer", view.buffer);
        whole(item, who, "byteOffset", view.byteOffset);
        whole(item, who, "byteLength", view.byteLength);
        whole(item, who, "byteStride", view.byteStride);
    }

    std::string_view text;
    bool is_text;
    const tinygltf::Model &model;
    mutable const cJSON *root = nullptr;
};

} // namespace

void check_gltf_chunks(std::string_view bytes)
{
    if (!is_binary(bytes))
    {
        return;
    }
    const std::uint32_t version = word_at(bytes, 4);
    if (version != 2)
    {
        throw MeshFailure("is a binary file of version " + std::to_string(version) +
                          ", which is not read; 2 is");
    }
    const std::size_t length = word_at(bytes, 8);
    if (length > bytes.size())
    {
        throw MeshFailure("has " + std::to_string(bytes.size()) + " bytes, not " +
                          std::to_string(length) + " as it says");
    }
    std::size_t at = header_size;
    while (at + chunk_head_size <= length)
    {
        const std::size_t size = word_at(bytes, at);
        if (size > length - chunk_head_size - at)
        {
            throw MeshFailure("has a chunk that ends behind the file");
        }
        at += chunk_head_size + size;
    }
}

void check_gltf_numbers(std::string_view bytes, const tinygltf::Model &model)
{
    GltfText(bytes, model).check();
}

GltfNeeds needs_of_gltf(std::string_view bytes)
{
    GltfNeeds needs;
    JsonFault fault;
    const JsonPointer root = parse_json_object(text_of(bytes), fault);
    const auto text_at = [](const cJSON *item)
    { return std::string(cJSON_IsString(item) ? item->valuestring : ""); };
    const cJSON *const asset = cJSON_GetObjectItemCaseSensitive(root.get(), "asset");
    needs.version = text_at(cJSON_GetObjectItemCaseSensitive(asset, "version"));
    needs.least_version = text_at(cJSON_GetObjectItemCaseSensitive(asset, "minVersion"));
    const cJSON *name = nullptr;
    cJSON_ArrayForEach(name, cJSON_GetObjectItemCaseSensitive(root.get(), "extensionsRequired"))
    {
        needs.extensions.push_back(text_at(name));
    }
    return needs;
}

std::vector<double> lengths_of_gltf_files(std::string_view bytes)
{
    std::vector<double> lengths;
    JsonFault fault;
    const JsonPointer root = parse_json_object(text_of(bytes), fault);
    const cJSON *buffer = nullptr;
    cJSON_ArrayForEach(buffer, cJSON_GetObjectItemCaseSensitive(root.get(), "buffers"))
    {
        const cJSON *const name = cJSON_GetObjectItemCaseSensitive(buffer, "uri");
        const std::string_view uri = cJSON_IsString(name) ? name->valuestring : "";
        if (!uri.empty() && uri.substr(0, 5) != "data:")
        {
            const cJSON *const length = cJSON_GetObjectItemCaseSensitive(buffer, "byteLength");
            lengths.push_back(cJSON_IsNumber(length) ? length->valuedouble : -1.0);
        }
    }
    return lengths;
}
