// SPDX-License-Identifier: MIT

#include "flat_mesh.hpp"

#include "file_failure.hpp"

#define TINYOBJLOADER_USE_DOUBLE
#include <tiny_obj_loader.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <istream>
#include <map>
#include <numeric>
#include <set>
#include <sstream>
#include <streambuf>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace
{

constexpr std::uint64_t largest_text = std::uint64_t{1} << 31;

// What the library has read.
struct ObjParts
{
    tinyobj::attrib_t attributes;
    std::vector<tinyobj::shape_t> shapes;
    std::vector<tinyobj::material_t> materials;
};

// A text behind the mark of UTF-8, if it begins with one, which the library would take for a part of its first word.
std::ifstream open_text(const std::string &path)
{
    std::ifstream file(path, std::ios::binary);
    std::array<char, byte_order_mark.size()> begin{};
    file.read(begin.data(), begin.size());
    if (!file || std::string_view(begin.data(), begin.size()) != byte_order_mark)
    {
        file.clear();
        file.seekg(0);
    }
    return file;
}

// In place of the spaces in a name, at which the library ends it.
constexpr char tie = '\x1f';

bool is_space(char letter)
{
    return letter == ' ' || letter == '\t';
}

std::string with_ties(std::string name)
{
    std::replace_if(name.begin(), name.end(), is_space, tie);
    const std::size_t begin = std::min(name.find_first_not_of(tie), name.size());
    return name.substr(begin, name.find_last_not_of(tie) + 1 - begin);
}

// Materials of files in the folder of the mesh and below it. One that is not there is none.
class NearbyMaterials : public tinyobj::MaterialReader
{
public:
    // The names that faces use, with ties.
    NearbyMaterials(const std::string &mesh, std::set<std::string> names)
        : folder(mesh.substr(0, mesh.rfind('/') + 1)), used(std::move(names))
    {
    }

    // The name, with ties, is of one file, or of several.
    bool operator()(const std::string &name, std::vector<tinyobj::material_t> *materials,
                    std::map<std::string, int> *numbers, std::string *warning,
                    std::string *error) override
    {
        bool is_there = false;
        for (const std::string &path : paths_of(name))
        {
            if (file_is_there(path))
            {
                std::ifstream file = open_text(path);
                tinyobj::LoadMtl(numbers, materials, &file, warning, error);
                is_there = true;
            }
        }
        add_used(*numbers);
        return is_there;
    }

private:
    std::string path_of(const std::string &name) const
    {
        if (leads_up(name))
        {
            throw MeshFailure("names a file of materials outside its folder");
        }
        return (folder.empty() ? "./" : folder) + name;
    }

    std::vector<std::string> paths_of(const std::string &name) const
    {
        std::string whole = name;
        std::replace(whole.begin(), whole.end(), tie, ' ');
        std::vector<std::string> paths = {path_of(whole)};
        if (whole != name && !file_is_there(paths[0]))
        {
            paths.clear();
            std::istringstream words(whole);
            for (std::string word; words >> word;)
            {
                paths.push_back(path_of(word));
            }
        }
        return paths;
    }

    // What faces use is a material's name, or begins with one and goes on with a comment.
    void add_used(std::map<std::string, int> &numbers) const
    {
        std::map<std::string, int> known;
        for (const auto &[name, number] : numbers)
        {
            known.emplace(with_ties(name), number);
        }
        for (const std::string &name : used)
        {
            auto found = known.find(name);
            for (std::size_t end = name.rfind(tie);
                 found == known.end() && end != std::string::npos && end > 0;
                 end = name.rfind(tie, end - 1))
            {
                found = known.find(name.substr(0, end));
            }
            if (found != known.end())
            {
                numbers.emplace(name, found->second);
            }
        }
    }

    std::string folder;
    std::set<std::string> used;
};

// A text as a stream, without a copy.
class TextStream : private std::streambuf, public std::istream
{
public:
    explicit TextStream(std::string &text) : std::istream(static_cast<std::streambuf *>(this))
    {
        setg(text.data(), text.data(), text.data() + text.size());
    }
};

// Puts ties into the names of materials and of their files; the names of materials.
std::set<std::string> tie_names(std::string &text)
{
    std::set<std::string> used;
    for (std::size_t at = 0, end = 0; at < text.size(); at = end + 1)
    {
        end = std::min(text.find('\n', at), text.size());
        const std::size_t word = std::min(text.find_first_not_of(" \t", at), end);
        const bool is_use = text.compare(word, 6, "usemtl") == 0;
        if (word + 7 >= end || !(is_use || text.compare(word, 6, "mtllib") == 0) ||
            !is_space(text[word + 6]))
        {
            continue;
        }
        const std::string name = with_ties(text.substr(word + 7, end - word - 7));
        const std::size_t rest = end - word - 7 - name.size();
        text.replace(word + 7, end - word - 7, name + std::string(rest, ' '));
        if (is_use)
        {
            used.insert(name);
        }
    }
    return used;
}

ObjParts parts_of(const std::string &path, std::string &text)
{
    ObjParts parts;
    NearbyMaterials nearby(path, tie_names(text));
    TextStream file(text);
    std::string warning;
    std::string error;
    const bool triangulate = false; // its ears are not those of all polygons
    if (!tinyobj::LoadObj(&parts.attributes, &parts.shapes, &parts.materials, &warning, &error,
                          &file, &nearby, triangulate))
    {
        throw MeshFailure("is no OBJ: " + error);
    }
    return parts;
}

// The library keeps eight bits of how many corners a face has.
constexpr std::size_t most_corners_kept = 255;

// A face of the file, by its number among all, that has more.
struct LargeFace
{
    std::size_t face;
    std::size_t corners;
};

// Vertices and faces as they stand: the library takes what is no number for 0, and leaves out what is no face.
class ObjLines
{
public:
    explicit ObjLines(std::string_view text) : lines("", text, " \t\r") // no comma
    {
    }

    // The large faces, as they come.
    std::vector<LargeFace> check()
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
        return large;
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
        const std::size_t corners = lines.words().size() - 1;
        if (corners > most_corners_kept)
        {
            large.push_back({faces, corners});
        }
        ++faces;
    }

    LineWords lines;
    std::vector<LargeFace> large;
    std::size_t faces = 0;
    double vertices = 0;
    double highest = 0; // of a face
    std::size_t highest_line = 0;
};

// A file's text, whose lines end with one letter each.
std::string text_of(const std::string &path)
{
    std::string text = read_whole(path, largest_text);
    std::size_t to = 0;
    for (std::size_t i = begin_of_text(text); i < text.size(); ++i)
    {
        const bool is_first_of_two = text[i] == '\r' && i + 1 < text.size() && text[i + 1] == '\n';
        i += is_first_of_two;
        text[to++] = text[i] == '\r' ? '\n' : text[i];
    }
    text.resize(to);
    return text;
}

// Does a line have numbers alone, so that "#" cannot be of a name?
bool is_of_numbers(std::string_view line)
{
    constexpr std::array<std::string_view, 8> words = {"v", "vt", "vn", "vp", "f", "l", "p", "s"};
    const std::string_view word = line.substr(0, line.find_first_of(" \t\\#\n"));
    return std::find(words.begin(), words.end(), word) != words.end();
}

// Lines that go on behind a "\" at their end (OBJ specification, "General statement") become one, and the ends that they had
// come behind it, so that all other lines keep their numbers. Comments do not go on: their last letter may be of a path. Those
// behind numbers are left out, since the library takes them for more numbers of a face.
void join_lines(std::string &text)
{
    std::size_t to = 0, ends = 0;
    bool is_begin = true, is_comment = false, is_numbers = false;
    for (std::size_t i = 0; i < text.size(); ++i)
    {
        const char letter = text[i];
        is_comment = is_comment || (letter == '#' && (is_begin || is_numbers));
        if (letter == '\\' && !is_comment && i + 1 < text.size() && text[i + 1] == '\n')
        {
            text[to++] = ' ';
            ++ends;
            ++i;
            continue;
        }
        if (is_begin && !is_space(letter))
        {
            is_begin = false;
            is_numbers = is_of_numbers(std::string_view(text).substr(i, 3));
        }
        if (letter == '\n')
        {
            text[to++] = letter;
            text.replace(to, ends, ends, '\n');
            to += ends;
            ends = 0;
            is_begin = true;
            is_comment = is_numbers = false;
        }
        else if (!is_comment || !is_numbers)
        {
            text[to++] = letter;
        }
    }
    text.resize(to);
}

// Vertices are those of the file, once for each material that they are of.
class ObjVertices
{
public:
    ObjVertices(const ObjParts &from, FlatMesh &to)
        : parts(from), mesh(to), first(from.attributes.vertices.size() / 3, {nothing, 0})
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
        const tinyobj::attrib_t &from = parts.attributes;
        const std::size_t at = 3 * static_cast<std::size_t>(vertex);
        for (std::size_t i = 0; i < 3; ++i)
        {
            const double own = at + i < from.colors.size() ? from.colors[at + i] : 1.0;
            const auto &materials = parts.materials;
            const bool has_one =
                material >= 0 && static_cast<std::size_t>(material) < materials.size();
            const double diffuse =
                has_one ? materials[static_cast<std::size_t>(material)].diffuse[i] : 1.0;
            mesh.position.push_back(from.vertices[at + i]);
            mesh.color.push_back(static_cast<float>(std::clamp(own * diffuse, 0.0, 1.0)));
        }
    }

    const ObjParts &parts;
    FlatMesh &mesh;
    // what most vertices are: of one material
    std::vector<std::pair<int, std::uint32_t>> first;
    std::map<std::pair<int, int>, std::uint32_t> others;
};

// The triangles of one polygon, by cutting ears (Meisters, Polygons have ears, 1975) where it is seen along its normal (Newell).
class Polygon
{
public:
    void add(const double *place)
    {
        corner.push_back({place[0], place[1], place[2]});
    }

    // Numbers of corners, three each.
    std::vector<std::size_t> triangles()
    {
        flatten();
        std::vector<std::size_t> cut;
        rest.resize(corner.size());
        std::iota(rest.begin(), rest.end(), std::size_t{0});
        while (rest.size() > 3)
        {
            const std::size_t ear = find_ear();
            const std::size_t n = rest.size();
            cut.insert(cut.end(), {rest[(ear + n - 1) % n], rest[ear], rest[(ear + 1) % n]});
            rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(ear));
        }
        cut.insert(cut.end(), rest.begin(), rest.end());
        return cut;
    }

private:
    using Flat = std::array<double, 2>;

    // Without the axis along which it is least wide, and so that it turns to the left.
    void flatten()
    {
        std::array<double, 3> normal{};
        const std::size_t n = corner.size();
        for (std::size_t i = 0; i < n; ++i)
        {
            const auto &here = corner[i], &next = corner[(i + 1) % n];
            for (std::size_t k = 0; k < 3; ++k)
            {
                const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
                normal[k] += (here[a] - next[a]) * (here[b] + next[b]);
            }
        }
        std::size_t axis = 0;
        for (std::size_t k = 1; k < 3; ++k)
        {
            axis = std::abs(normal[k]) > std::abs(normal[axis]) ? k : axis;
        }
        const bool turns = normal[axis] < 0;
        for (const auto &place : corner)
        {
            const double a = place[(axis + 1) % 3], b = place[(axis + 2) % 3];
            flat.push_back(turns ? Flat{b, a} : Flat{a, b});
        }
    }

    static double side(const Flat &from, const Flat &to, const Flat &at)
    {
        return (to[0] - from[0]) * (at[1] - from[1]) - (to[1] - from[1]) * (at[0] - from[0]);
    }

    // Is no other corner in the triangle of one and its neighbours?
    bool is_ear(std::size_t at) const
    {
        const std::size_t n = rest.size();
        const Flat &before = flat[rest[(at + n - 1) % n]], &here = flat[rest[at]],
                   &after = flat[rest[(at + 1) % n]];
        if (!(side(before, here, after) > 0))
        {
            return false;
        }
        for (std::size_t i = 2; i < n - 1; ++i)
        {
            const Flat &other = flat[rest[(at + i) % n]];
            if (other != before && other != here && other != after &&
                side(before, here, other) >= 0 && side(here, after, other) >= 0 &&
                side(after, before, other) >= 0)
            {
                return false;
            }
        }
        return true;
    }

    // The second corner first, which makes a fan of what is convex, and of what crosses itself.
    std::size_t find_ear() const
    {
        for (std::size_t i = 0; i < rest.size(); ++i)
        {
            const std::size_t at = (i + 1) % rest.size();
            if (is_ear(at))
            {
                return at;
            }
        }
        return 1;
    }

    std::vector<std::array<double, 3>> corner;
    std::vector<Flat> flat;
    std::vector<std::size_t> rest;
};

// Of a shape's polygon, whose corners begin at one of its indices.
void add_polygon(const tinyobj::mesh_t &part, std::size_t begin, std::size_t corners, int material,
                 const ObjParts &parts, ObjVertices &vertices, FlatMesh &mesh)
{
    std::vector<std::uint32_t> number;
    Polygon polygon;
    for (std::size_t i = 0; i < corners; ++i)
    {
        const int vertex = part.indices[begin + i].vertex_index;
        number.push_back(vertices.find(vertex, material));
        const tinyobj::real_t *at =
            &parts.attributes.vertices[3 * static_cast<std::size_t>(vertex)];
        const double place[3] = {static_cast<double>(at[0]), static_cast<double>(at[1]),
                                 static_cast<double>(at[2])};
        polygon.add(place);
    }
    if (corners == 3)
    {
        mesh.index.insert(mesh.index.end(), number.begin(), number.end());
        return;
    }
    for (const std::size_t i : polygon.triangles())
    {
        mesh.index.push_back(number[i]);
    }
}

} // namespace

FlatMesh read_obj(const std::string &path)
{
    std::string text = text_of(path);
    join_lines(text);
    const std::vector<LargeFace> large = ObjLines(text).check();
    const ObjParts parts = parts_of(path, text);
    std::string().swap(text);
    FlatMesh mesh;
    ObjVertices vertices(parts, mesh);
    auto next_large = large.begin();
    std::size_t of_file = 0; // the face's number: shapes have them as the file has
    for (const tinyobj::shape_t &shape : parts.shapes)
    {
        const tinyobj::mesh_t &part = shape.mesh;
        std::size_t begin = 0;
        for (std::size_t face = 0; face < part.num_face_vertices.size(); ++face, ++of_file)
        {
            const bool is_large = next_large != large.end() && next_large->face == of_file;
            const std::size_t corners =
                is_large ? (next_large++)->corners : part.num_face_vertices[face];
            const int material = face < part.material_ids.size() ? part.material_ids[face] : -1;
            if (corners < 3 || corners > part.indices.size() - begin)
            {
                throw MeshFailure("has polygons that could not be made triangles");
            }
            add_polygon(part, begin, corners, material, parts, vertices, mesh);
            begin += corners;
        }
        if (begin != part.indices.size())
        {
            throw MeshFailure("has faces whose corners could not be counted");
        }
    }
    return mesh;
}
