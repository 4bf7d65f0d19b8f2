// SPDX-License-Identifier: MIT

#include "flat_mesh.hpp"

#include "file_failure.hpp"

#define TINYOBJLOADER_USE_DOUBLE
#include <tiny_obj_loader.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace
{

constexpr std::uint64_t largest_text = std::uint64_t{1} << 31;

// Vertices and faces as they stand: the library takes what is no number for 0, and leaves out what is no face.
class ObjLines
{
public:
    explicit ObjLines(std::string_view text) : lines("", text)
    {
    }

    void check()
    {
        while (lines.next())
        {
            const std::string_view first = lines.words()[0];
            if (first == "v")
            {
                check_vertex();
            }
            else if (first == "f")
            {
                check_face();
            }
        }
        if (highest > vertices)
        {
            fail(highest_line, "a face of a vertex that is not there");
        }
    }

private:
    [[noreturn]] static void fail(std::size_t line, const std::string &what)
    {
        throw MeshFailure(":" + std::to_string(line) + ": " + what);
    }

    void check_vertex()
    {
        if (lines.words().size() < 4)
        {
            fail(lines.line(), "a vertex of fewer than 3 numbers");
        }
        for (std::size_t i = 1; i < lines.words().size(); ++i)
        {
            if (i > 3 && lines.words()[i][0] == '#')
            {
                break;
            }
            double number = 0;
            if (!word_number(lines.words()[i], number) || !(number - number == 0))
            {
                fail(lines.line(), "a vertex with what is no finite number");
            }
        }
        ++vertices;
    }

    void check_face()
    {
        if (lines.words().size() < 4)
        {
            fail(lines.line(), "a face of fewer than 3 vertices");
        }
        for (std::size_t i = 1; i < lines.words().size(); ++i)
        {
            const std::string_view word = lines.words()[i];
            double vertex = 0;
            if (!word_number(word.substr(0, word.find('/')), vertex) || vertex == 0 ||
                vertex != std::floor(vertex) || -vertex > vertices)
            {
                fail(lines.line(), "a face of what is no vertex");
            }
            if (vertex > highest)
            {
                highest = vertex;
                highest_line = lines.line();
            }
        }
    }

    LineWords lines;
    double vertices = 0;
    double highest = 0; // of a face
    std::size_t highest_line = 0;
};

// A file's text as its check reads it: lines end as they may anywhere, and no comma parts words, as none does in OBJ.
std::string text_of(const std::string &path)
{
    std::string text = read_whole(path, largest_text);
    for (std::size_t i = 0; i < text.size(); ++i)
    {
        const bool ends_alone = text[i] == '\r' && (i + 1 == text.size() || text[i + 1] != '\n');
        text[i] = ends_alone ? '\n' : text[i] == ',' ? ';' : text[i];
    }
    return text;
}

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
    ObjLines(text_of(path)).check();
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
