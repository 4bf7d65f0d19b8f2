// SPDX-License-Identifier: MIT

#include "file_failure.hpp"
#include "flat_mesh.hpp"
#include "gltf_numbers.hpp"
#include "gltf_text.hpp"

#include <cubemap/pose.h>

#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>

namespace
{

const char *const quantization = "KHR_mesh_quantization";

using Matrix = std::array<double, 16>; // by columns, as glTF has it

// ---- files: no name is expanded by a shell, and none leads out of the folder

bool is_there(const std::string &path, void *)
{
    return std::ifstream(path).good();
}

std::string as_it_is(const std::string &path, void *)
{
    return path;
}

struct MainFile
{
    std::string path;
    std::string bytes;           // once it is read
    std::vector<double> lengths; // that it wants of the files beside it
    std::size_t asked = 0;       // for so many of them
};

// glTF 2.0, 3.6.1.1: files may be longer than their buffers; the library wants them to be as long, and reads buffers in order,
// before pictures.
std::size_t wanted_of(MainFile &main_file, std::size_t size)
{
    if (main_file.asked == main_file.lengths.size())
    {
        return size;
    }
    const double length = main_file.lengths[main_file.asked++];
    return length >= 1 && length < static_cast<double>(size) ? static_cast<std::size_t>(length)
                                                             : size;
}

bool read_gltf_part(std::vector<unsigned char> *out, std::string *error, const std::string &path,
                    void *user)
{
    MainFile &main_file = *static_cast<MainFile *>(user);
    const bool is_main = path == main_file.path;
    std::ifstream file(path, std::ios::binary);
    // the library looks beside the file, then where the program stands, and puts nothing before "/"
    const std::string &main_path = main_file.path;
    std::string folder = main_path.substr(0, main_path.rfind('/') + 1);
    while (folder.size() > 1 && folder[folder.size() - 2] == '/')
    {
        folder.pop_back(); // as the library has it
    }
    const bool is_beside = folder.empty() ? path[0] != '/' : path.rfind(folder, 0) == 0;
    if (!is_main && (!is_beside || leads_up(path.substr(folder.size()))))
    {
        *error = "names a file outside its folder";
        return false;
    }
    file.seekg(0, std::ios::end);
    const std::streamoff size = file.tellg();
    if (!file || size <= 0 || static_cast<std::size_t>(size) > largest_gltf)
    {
        *error = size == 0 ? "is empty" : "cannot be read";
        return false;
    }
    out->resize(static_cast<std::size_t>(size));
    file.seekg(0);
    file.read(reinterpret_cast<char *>(out->data()), size);
    if (is_main)
    {
        main_file.bytes.assign(out->begin(), out->end());
        check_gltf_chunks(main_file.bytes);
        main_file.lengths = lengths_of_gltf_files(main_file.bytes);
    }
    else
    {
        out->resize(wanted_of(main_file, out->size()));
    }
    return static_cast<bool>(file);
}

bool no_picture(tinygltf::Image *, const int, std::string *, std::string *, int, int,
                const unsigned char *, int, void *)
{
    return true;
}

// ---- transforms

Matrix product(const Matrix &a, const Matrix &b)
{
    Matrix result{};
    for (std::size_t i = 0; i < 16; ++i)
    {
        for (std::size_t k = 0; k < 4; ++k)
        {
            result[i] += a[4 * k + i % 4] * b[i / 4 * 4 + k];
        }
    }
    return result;
}

double number_of(const std::vector<double> &list, std::size_t i, double absent)
{
    return i < list.size() ? list[i] : absent;
}

// Absent is empty; the library takes lists of any length.
void check_length(int node, const char *what, const std::vector<double> &list, std::size_t wanted)
{
    if (!list.empty() && list.size() != wanted)
    {
        throw MeshFailure("has node " + std::to_string(node) + ", whose " + what + " is of " +
                          std::to_string(list.size()) + " numbers, not " + std::to_string(wanted));
    }
}

// glTF 2.0, 3.5.3: a matrix, or translation times rotation times scale.
Matrix matrix_of(int index, const tinygltf::Node &node)
{
    check_length(index, "matrix", node.matrix, 16);
    check_length(index, "translation", node.translation, 3);
    check_length(index, "rotation", node.rotation, 4);
    check_length(index, "scale", node.scale, 3);
    Matrix result{};
    if (!node.matrix.empty())
    {
        std::copy(node.matrix.begin(), node.matrix.end(), result.begin());
        return result;
    }
    const std::array<double, 4> quaternion = {
        number_of(node.rotation, 0, 0), number_of(node.rotation, 1, 0),
        number_of(node.rotation, 2, 0), number_of(node.rotation, 3, 1)};
    const std::array<double, 3> origin{};
    cm_pose turned;
    if (cm_pose_from_quaternion(origin.data(), quaternion.data(), &turned) != CM_OK)
    {
        throw MeshFailure("has node " + std::to_string(index) +
                          ", whose rotation's length is more than 0.001 off 1");
    }
    for (std::size_t column = 0; column < 3; ++column)
    {
        for (std::size_t row = 0; row < 3; ++row)
        {
            // a pose's rows are the columns of what its quaternion turns by
            result[4 * column + row] =
                turned.rotation.row[column][row] * number_of(node.scale, column, 1);
        }
        result[12 + column] = number_of(node.translation, column, 0);
    }
    result[15] = 1;
    return result;
}

// ---- the mesh

class GltfScene
{
public:
    explicit GltfScene(const tinygltf::Model &from) : model(from), seen(from.nodes.size())
    {
    }

    FlatMesh read()
    {
        const Matrix identity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
        if (model.defaultScene < 0 && model.scenes.empty())
        {
            throw MeshFailure("has no scene"); // but a library of parts
        }
        const int which = model.defaultScene < 0 ? 0 : model.defaultScene;
        // not by calls in each other: trees may be of any depth
        std::vector<Placed> waiting;
        add_waiting(gltf_element(model.scenes, which, "a scene").nodes, identity, waiting);
        while (!waiting.empty())
        {
            const Placed next = waiting.back();
            waiting.pop_back();
            const Matrix matrix = add_node(next.node, next.outer);
            add_waiting(model.nodes[static_cast<std::size_t>(next.node)].children, matrix, waiting);
        }
        return std::move(mesh);
    }

private:
    struct Placed
    {
        int node;
        Matrix outer;
    };

    // The last of them is the next.
    static void add_waiting(const std::vector<int> &nodes, const Matrix &outer,
                            std::vector<Placed> &waiting)
    {
        for (auto node = nodes.rbegin(); node != nodes.rend(); ++node)
        {
            waiting.push_back({*node, outer});
        }
    }

    // The node's own parts; its transform.
    Matrix add_node(int index, const Matrix &outer)
    {
        const tinygltf::Node &node = gltf_element(model.nodes, index, "a node");
        if (seen[static_cast<std::size_t>(index)])
        {
            throw MeshFailure("has nodes that are no tree");
        }
        seen[static_cast<std::size_t>(index)] = true;
        const Matrix matrix = product(outer, matrix_of(index, node));
        if (node.mesh >= 0)
        {
            for (const tinygltf::Primitive &part :
                 gltf_element(model.meshes, node.mesh, "a mesh").primitives)
            {
                add_part(part, matrix);
            }
        }
        return matrix;
    }

    void add_part(const tinygltf::Primitive &part, const Matrix &matrix)
    {
        const auto position = part.attributes.find("POSITION");
        const int mode = part.mode < 0 ? TINYGLTF_MODE_TRIANGLES : part.mode;
        if (mode > TINYGLTF_MODE_TRIANGLE_FAN)
        {
            throw MeshFailure("has a primitive of mode " + std::to_string(mode) +
                              ", which is none");
        }
        if (mode < TINYGLTF_MODE_TRIANGLES || position == part.attributes.end())
        {
            return; // points and lines
        }
        const std::size_t first = mesh.position.size() / 3;
        const GltfNumbers at(model, position->second);
        check_positions(at);
        for (std::size_t i = 0; i < at.count(); ++i)
        {
            for (std::size_t k = 0; k < 3; ++k)
            {
                mesh.position.push_back(matrix[k] * at.value(i, 0) +
                                        matrix[4 + k] * at.value(i, 1) +
                                        matrix[8 + k] * at.value(i, 2) + matrix[12 + k]);
            }
        }
        add_colors(part, at.count());
        add_triangles(part, mode, first, at.count());
    }

    // Floats, or, where the file names KHR_mesh_quantization, bytes and shorts too.
    void check_positions(const GltfNumbers &at) const
    {
        const bool is_whole = at.type() != TINYGLTF_COMPONENT_TYPE_FLOAT;
        const bool is_short = at.type() >= TINYGLTF_COMPONENT_TYPE_BYTE &&
                              at.type() <= TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
        if (at.width() != 3 || (is_whole && !is_short))
        {
            throw MeshFailure("has positions that are no three floats, bytes or shorts");
        }
        const auto names = [](const std::vector<std::string> &list)
        { return std::find(list.begin(), list.end(), quantization) != list.end(); };
        if (is_whole && !names(model.extensionsRequired) && !names(model.extensionsUsed))
        {
            throw MeshFailure("has positions that are no floats, and does not name the extension " +
                              std::string(quantization));
        }
    }

    void add_colors(const tinygltf::Primitive &part, std::size_t count)
    {
        std::array<double, 3> base = {1, 1, 1};
        if (part.material >= 0)
        {
            const std::vector<double> &factor =
                gltf_element(model.materials, part.material, "a material")
                    .pbrMetallicRoughness.baseColorFactor;
            base = {number_of(factor, 0, 1), number_of(factor, 1, 1), number_of(factor, 2, 1)};
        }
        const auto own = part.attributes.find("COLOR_0");
        const bool has_own = own != part.attributes.end();
        const GltfNumbers colors(model, has_own ? own->second : part.attributes.at("POSITION"));
        if (has_own && (colors.count() < count || colors.width() < 3))
        {
            throw MeshFailure("has fewer colours than vertices");
        }
        if (has_own && colors.type() != TINYGLTF_COMPONENT_TYPE_FLOAT &&
            colors.type() != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE &&
            colors.type() != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT)
        {
            throw MeshFailure("has colours that are neither floats nor unsigned bytes or shorts");
        }
        for (std::size_t i = 0; i < 3 * count; ++i)
        {
            const double color = has_own ? colors.at(i / 3, i % 3) / colors.one() : 1.0;
            mesh.color.push_back(static_cast<float>(std::clamp(color * base[i % 3], 0.0, 1.0)));
        }
    }

    void add_triangles(const tinygltf::Primitive &part, int mode, std::size_t first,
                       std::size_t count)
    {
        std::vector<std::uint32_t> list;
        if (part.indices >= 0)
        {
            const GltfNumbers indices(model, part.indices);
            if (gltf_index_size(indices.type()) == 0 || indices.width() != 1)
            {
                throw MeshFailure("has indices that are no whole numbers, one a vertex");
            }
            for (std::size_t i = 0; i < indices.count(); ++i)
            {
                const double index = indices.at(i, 0);
                if (!(index < static_cast<double>(count)))
                {
                    throw MeshFailure("has an index that is out of range");
                }
                list.push_back(static_cast<std::uint32_t>(first) +
                               static_cast<std::uint32_t>(index));
            }
        }
        else
        {
            for (std::size_t i = 0; i < count; ++i)
            {
                list.push_back(static_cast<std::uint32_t>(first + i));
            }
        }
        const std::size_t step = mode == TINYGLTF_MODE_TRIANGLES ? 3 : 1;
        for (std::size_t i = 0; i + 2 < list.size(); i += step)
        {
            const std::size_t begin = mode == TINYGLTF_MODE_TRIANGLE_FAN ? 0 : i;
            mesh.index.insert(mesh.index.end(), {list[begin], list[i + 1], list[i + 2]});
        }
    }

    const tinygltf::Model &model;
    std::vector<bool> seen;
    FlatMesh mesh;
};

// Those that no accessor names, too.
void check_views(const tinygltf::Model &model)
{
    for (std::size_t i = 0; i < model.bufferViews.size(); ++i)
    {
        const tinygltf::BufferView &view = model.bufferViews[i];
        const std::size_t size = gltf_element(model.buffers, view.buffer, "a buffer").data.size();
        if (view.byteOffset > size || view.byteLength > size - view.byteOffset)
        {
            throw MeshFailure("has buffer view " + std::to_string(i) +
                              ", which ends behind its buffer");
        }
    }
}

// What the loader has read, or, where it has failed, what the text says: compressed buffers are none to it.
void check_needs(const GltfNeeds &needs)
{
    for (const std::string &name : needs.extensions)
    {
        const bool is_looks = name.rfind("KHR_materials_", 0) == 0 ||
                              name.rfind("KHR_texture_", 0) == 0 ||
                              name.rfind("EXT_texture_", 0) == 0 || name == "MSFT_texture_dds" ||
                              name == "KHR_lights_punctual";
        if (!is_looks && name != quantization)
        {
            throw MeshFailure("needs the extension " + name + ", which is not read");
        }
    }
    const std::string &least = needs.least_version;
    const std::string &version = least.empty() ? needs.version : least;
    const bool is_read =
        least.empty() ? version.substr(0, version.find('.')) == "2" : least == "2.0";
    if (!version.empty() && !is_read)
    {
        throw MeshFailure("is of glTF " + version + ", which is not read; 2.0 is");
    }
}

} // namespace

FlatMesh read_gltf(const std::string &path)
{
    tinygltf::TinyGLTF loader;
    tinygltf::Model model;
    std::string error;
    std::string warning;
    MainFile main_file = {path, "", {}};
    loader.SetFsCallbacks({is_there, as_it_is, read_gltf_part, nullptr, &main_file});
    loader.SetImageLoader(no_picture, nullptr);
    const bool is_binary = !path.empty() && (path.back() == 'b' || path.back() == 'B'); // .glb
    const bool loaded = is_binary ? loader.LoadBinaryFromFile(&model, &error, &warning, path)
                                  : loader.LoadASCIIFromFile(&model, &error, &warning, path);
    check_needs(
        loaded ? GltfNeeds{model.asset.version, model.asset.minVersion, model.extensionsRequired}
               : needs_of_gltf(main_file.bytes));
    if (!loaded)
    {
        throw MeshFailure("is no glTF: " + error);
    }
    check_gltf_numbers(main_file.bytes, model);
    check_views(model);
    return GltfScene(model).read();
}
