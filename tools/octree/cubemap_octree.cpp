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
    const char *needs_less; // what does, where memory is not enough
};

constexpr const char *paged_needs_less = "--memory keeps the rest of the map in its file";

constexpr NamedOctreeCommand octree_commands[] = {
    {"integrate", integrate_views,
     "a larger --edge needs less, and --far; --memory keeps the rest of the map in its file"},
    {"query", query_octree, paged_needs_less},
    {"ray", cast_octree_rays, paged_needs_less},
    {"extract", extract_octree, paged_needs_less},
    {"render", render_octree, paged_needs_less},
    {"probe", probe_octree,
     "a smaller --size needs less; --memory keeps the rest of the map in its file"},
    {"merge", merge_octrees, "both maps are in it as a whole"},
    {"hull", carve_hull, "a larger --edge needs less, and fewer --levels"},
    {"info", tell_octree, paged_needs_less}};

constexpr const char *octree_command_list =
    "integrate, query, ray, extract, render, probe, merge, hull or info";

const char *octree_command_at(std::size_t index)
{
    return index < std::size(octree_commands) ? octree_commands[index].name : nullptr;
}

int run_in_memory(const NamedOctreeCommand &command, int argc, char **argv,
                  const cm_streams &streams)
{
    try
    {
        return command.run(argc, argv, streams);
    }
    catch (const std::bad_alloc &)
    {
        throw Failure(std::string("not enough memory; ") + command.needs_less);
    }
}

int octree(int argc, char **argv, const cm_streams &streams)
{
    const std::string first = argc > 1 ? argv[1] : "";
    for (const NamedOctreeCommand &command : octree_commands)
    {
        if (first == command.name)
        {
            return run_in_memory(command, argc - 1, argv + 1, streams);
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
