// SPDX-License-Identifier: MIT
//
// cubemap-octree: maps of scenes from depth views.

#include "octree_command.hpp"
#include "octree_main.h"
#include "tools/cli/catalogue_name.h"
#include "tools/cli/program.hpp"

namespace
{

using OctreeCommand = int (*)(int, char **, const cm_streams &);

struct NamedOctreeCommand
{
    const char *name;
    OctreeCommand run;
};

constexpr NamedOctreeCommand octree_commands[] = {
    {"integrate", integrate_views}, {"query", query_octree},   {"ray", cast_octree_rays},
    {"extract", extract_octree},    {"render", render_octree}, {"probe", probe_octree},
    {"merge", merge_octrees},       {"hull", carve_hull},      {"info", tell_octree}};

constexpr const char *octree_command_list =
    "integrate, query, ray, extract, render, probe, merge, hull or info";

const char *octree_command_at(std::size_t index)
{
    return index < std::size(octree_commands) ? octree_commands[index].name : nullptr;
}

int octree(int argc, char **argv, const cm_streams &streams)
{
    const std::string first = argc > 1 ? argv[1] : "";
    for (const NamedOctreeCommand &command : octree_commands)
    {
        if (first == command.name)
        {
            return command.run(argc - 1, argv + 1, streams);
        }
    }
    OptionReader reader(cm_octree_command, argc, argv, streams);
    while (reader.next() != 0)
    {
    }
    if (reader.printed())
    {
        return 0;
    }
    const std::vector<std::string> names = reader.operands();
    if (names.empty())
    {
        throw UsageFailure(std::string("a command is needed: ") + octree_command_list +
                           "; see --help");
    }
    throw UsageFailure(in_quotes(names.front()) + " is not a command: " + octree_command_list +
                       suggestion(nearest_name(names.front().c_str(), octree_command_at)));
}

} // namespace

int cm_octree_main(int argc, char **argv, const cm_streams *streams)
{
    return run_program("cubemap-octree", *streams,
                       [argc, argv, streams] { return octree(argc, argv, *streams); });
}
