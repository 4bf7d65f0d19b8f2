// SPDX-License-Identifier: MIT

#include "octree_command.hpp"
#include "octree_map.hpp"
#include "octree_table.h"

#include "modules/octree/io/vdb_file.h"
#include "modules/scene/io/ply_file.h"
#include "tools/cli/atomic_file.hpp"
#include "tools/cli/lower_case.hpp"

#include <algorithm>

namespace
{

enum ExtractFormat
{
    extract_xyz, // in the order of the table's choices
    extract_ply,
    extract_vdb
};

struct ExtractOptions
{
    std::string map;
    std::string output;
    std::optional<std::size_t> format;
    std::uint64_t memory = 0;
    int level = 0;
    bool printed = false;
};

// In capitals, too.
bool has_ending(const std::string &name, const std::string &ending)
{
    return name.size() > ending.size() &&
           lower_case(name.substr(name.size() - ending.size())) == ending;
}

ExtractOptions parse_extract_options(int argc, char **argv, const cm_streams &streams)
{
    ExtractOptions options;
    OptionReader reader(octree_extract_command, argc, argv, streams);
    while (const int id = reader.next())
    {
        switch (id)
        {
        case OCTREE_OUTPUT:
            options.output = reader.text();
            break;
        case OCTREE_FORMAT:
            options.format = reader.choice();
            break;
        case OCTREE_LEVEL:
            options.level = reader.whole_number();
            break;
        default:
            options.memory = read_memory(reader);
            break;
        }
    }
    options.printed = reader.printed();
    if (options.printed)
    {
        return options;
    }
    options.map = needed_operands(reader, 1, "MAP").front();
    need_output(options.output, "OUT");
    if (!options.format)
    {
        options.format = has_ending(options.output, ".ply")   ? extract_ply
                         : has_ending(options.output, ".vdb") ? extract_vdb
                                                              : extract_xyz;
    }
    if (options.output == "-" && options.format != extract_xyz)
    {
        throw UsageFailure("-o is '-', standard output, which is for xyz; give the name of a file");
    }
    return options;
}

std::vector<cm_voxel> occupied_of(const cm_octree *map, const ExtractOptions &options)
{
    check_level(options.level, map, options.map);
    std::size_t count = 0;
    const cm_status status = cm_octree_extract(map, options.level, 0, nullptr, &count);
    check_map(status == CM_ERROR_SPACE ? CM_OK : status, in_quotes(options.map));
    std::vector<cm_voxel> voxels(count);
    check_map(cm_octree_extract(map, options.level, count, voxels.data(), &count),
              in_quotes(options.map));
    return voxels;
}

std::string line_of(const cm_voxel &voxel)
{
    return json_number(voxel.x) + " " + json_number(voxel.y) + " " + json_number(voxel.z) + " " +
           json_number(voxel.edge) + " " + std::to_string(voxel.color[0]) + " " +
           std::to_string(voxel.color[1]) + " " + std::to_string(voxel.color[2]) + "\n";
}

// Calls put with lines, some hundred kilobytes at a time.
template <typename Put> void put_lines(const std::vector<cm_voxel> &voxels, const Put &put)
{
    std::string text;
    for (const cm_voxel &voxel : voxels)
    {
        text += line_of(voxel);
        if (text.size() > 1 << 18)
        {
            put(text);
            text.clear();
        }
    }
    put(text);
}

void write_xyz(const std::vector<cm_voxel> &voxels, const std::string &path,
               const cm_streams &streams)
{
    if (path == "-")
    {
        put_lines(voxels, [&streams](const std::string &text) { print(streams, text); });
        return;
    }
    AtomicFile file(path);
    put_lines(voxels, [&file](const std::string &text) { file.write(text.data(), text.size()); });
    file.finish();
    file.appear();
}

void write_ply(const std::vector<cm_voxel> &voxels, const std::string &path, bool has_color)
{
    std::vector<double> position;
    std::vector<unsigned char> color;
    for (const cm_voxel &voxel : voxels)
    {
        position.insert(position.end(), {voxel.x, voxel.y, voxel.z});
        color.insert(color.end(), std::begin(voxel.color), std::end(voxel.color));
    }
    cm_ply ply = {};
    ply.point_count = voxels.size();
    ply.position = position.data();
    ply.color = has_color ? color.data() : nullptr;
    char message[CM_IMAGE_MESSAGE] = "";
    check_scene(cm_ply_write(path.c_str(), &ply, true, message), message);
}

void write_vdb(const std::vector<cm_voxel> &voxels, const std::string &path, const cm_octree *map,
               int level)
{
    AtomicFile file(path);
    char message[CM_IMAGE_MESSAGE] = "";
    const cm_octree_options &made = *cm_octree_describe(map);
    check_scene(cm_vdb_write(file.temporary_name().c_str(), path.c_str(), &made, level,
                             voxels.size(), voxels.data(), message),
                message);
    file.finish();
    file.appear();
}

} // namespace

int extract_octree(int argc, char **argv, const cm_streams &streams)
{
    const ExtractOptions options = parse_extract_options(argc, argv, streams);
    if (options.printed)
    {
        return 0;
    }
    if (same_file(options.map, options.output))
    {
        throw UsageFailure("-o is " + in_quotes(options.output) +
                           ", the map itself; give another name");
    }
    const OctreeMap open = open_map(options.map, options.memory);
    const std::vector<cm_voxel> voxels = occupied_of(open.map.get(), options);
    switch (*options.format)
    {
    case extract_ply:
        write_ply(voxels, options.output, cm_octree_describe(open.map.get())->color != 0);
        break;
    case extract_vdb:
        write_vdb(voxels, options.output, open.map.get(), options.level);
        break;
    default:
        write_xyz(voxels, options.output, streams);
        break;
    }
    return 0;
}
