// SPDX-License-Identifier: MIT

#include "flat_mesh.hpp"

#define TINYOBJLOADER_USE_DOUBLE
#include <tiny_obj_loader.h>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

namespace
{

// Vertices are those of the file, once for each material that they are of.
class ObjVertices
{
public:
    ObjVertices(const tinyobj::ObjReader &from, FlatMesh &to)
        : reader(from), mesh(to), first(from.GetAttrib().vertices.size() / 3, {nothing, 0})
    {
    }

    std::uint32_t find(int vertex, int material)
    {
        if (vertex < 0 || static_cast<std::size_t>(vertex) >= first.size())
        {
            throw MeshFailure("has a face of a vertex that is not there");
        }
        const auto next = static_cast<std::uint32_t>(mesh.position.size() / 3);
        auto &[its_material, its_place] = first[static_cast<std::size_t>(vertex)];
        if (its_material == nothing)
        {
            its_material = material;
            its_place = next;
            add(vertex, material);
        }
        if (its_material == material)
        {
            return its_place;
        }
        const auto [place, is_new] = others.try_emplace({vertex, material}, next);
        if (is_new)
        {
            add(vertex, material);
        }
        return place->second;
    }

private:
    static constexpr int nothing = -2; // -1 is a face without material

    void add(int vertex, int material)
    {
        const tinyobj::attrib_t &from = reader.GetAttrib();
        const std::size_t at = 3 * static_cast<std::size_t>(vertex);
        for (std::size_t i = 0; i < 3; ++i)
        {
            const double own = at + i < from.colors.size() ? from.colors[at + i] : 1.0;
            const auto &materials = reader.GetMaterials();
            const bool has_one =
                material >= 0 && static_cast<std::size_t>(material) < materials.size();
            const double diffuse =
                has_one ? materials[static_cast<std::size_t>(material)].diffuse[i] : 1.0;
            mesh.position.push_back(from.vertices[at + i]);
            mesh.color.push_back(static_cast<float>(std::clamp(own * diffuse, 0.0, 1.0)));
        }
    }

    const tinyobj::ObjReader &reader;
    FlatMesh &mesh;
    // what most vertices are: of one material
    std::vector<std::pair<int, std::uint32_t>> first;
    std::map<std::pair<int, int>, std::uint32_t> others;
};

} // namespace

FlatMesh read_obj(const std::string &path)
{
    tinyobj::ObjReader reader;
    tinyobj::ObjReaderConfig config;
    config.triangulate = true;
    if (!reader.ParseFromFile(path, config))
    {
        throw MeshFailure("is no OBJ: " + reader.Error());
    }
    FlatMesh mesh;
    ObjVertices vertices(reader, mesh);
    for (const tinyobj::shape_t &shape : reader.GetShapes())
    {
        const tinyobj::mesh_t &part = shape.mesh;
        if (3 * part.num_face_vertices.size() != part.indices.size())
        {
            throw MeshFailure("has polygons that could not be made triangles");
        }
        for (std::size_t i = 0; i < part.indices.size(); ++i)
        {
            const std::size_t face = i / 3;
            const int material = face < part.material_ids.size() ? part.material_ids[face] : -1;
            mesh.index.push_back(vertices.find(part.indices[i].vertex_index, material));
        }
    }
    return mesh;
}
