// SPDX-License-Identifier: MIT
//
// cubemap-octree merge and info: maps of maps, and what is in one.

#include "octree_command.hpp"
#include "octree_map.hpp"
#include "octree_table.h"

namespace
{

struct MergeOptions
{
    std::string first;
    std::string second;
    std::string output;
    std::string pose;
    bool json = false;
    bool printed = false;
};

MergeOptions parse_merge_options(int argc, char **argv, const cm_streams &streams)
{
    MergeOptions options;
    OptionReader reader(octree_merge_command, argc, argv, streams);
    while (const int id = reader.next())
    {
        switch (id)
        {
        case OCTREE_OUTPUT:
            options.output = reader.text();
            break;
        case OCTREE_POSE:
            options.pose = reader.text();
            break;
        default:
            options.json = true;
            break;
        }
    }
    options.printed = reader.printed();
    if (!options.printed)
    {
        const std::vector<std::string> names = needed_operands(reader, 2, "A and B");
        need_output(options.output, "MAP");
        options.first = names[0];
        options.second = names[1];
    }
    return options;
}

std::string count_json(const cm_octree_count &count)
{
    return "\"occupied\": " + std::to_string(count.occupied) +
           ", \"free\": " + std::to_string(count.free) +
           ", \"bytes\": " + std::to_string(count.bytes) +
           ", \"nodes\": " + std::to_string(count.nodes) +
           ", \"paged\": " + std::to_string(count.paged);
}

int merge(const MergeOptions &options, const cm_streams &streams)
{
    OctreeMap to = open_map(options.first, 0); // all of it, so that the output may be one of these
    OctreeMap from = open_map(options.second, 0);
    cm_pose pose = {};
    if (!options.pose.empty())
    {
        pose = read_one_pose(options.pose);
    }
    const cm_status status =
        cm_octree_merge(to.map.get(), from.map.get(), options.pose.empty() ? nullptr : &pose);
    if (status == CM_ERROR_UNSUPPORTED)
    {
        throw Failure(in_quotes(options.first) + " and " + in_quotes(options.second) +
                      " count hits and misses by different rules");
    }
    check_map(status, in_quotes(options.first) + " and " + in_quotes(options.second));
    check_map(cm_octree_compact(to.map.get()), in_quotes(options.first));
    OctreeRun run = read_note(to.map.get());
    const OctreeRun other = read_note(from.map.get());
    run.views += other.views;
    run.empty += other.empty;
    run.complete = true;
    run.settings = "merged";
    from.map.reset();
    save_map(to.map.get(), options.output, run);
    if (options.json)
    {
        print(streams, "{\"views\": " + std::to_string(run.views) + ", " +
                           count_json(count_map(to.map.get(), options.output)) + "}\n");
    }
    return 0;
}

std::string numbers_json(const double *numbers, std::size_t count)
{
    std::string text = "[";
    for (std::size_t i = 0; i < count; ++i)
    {
        text += (i > 0 ? ", " : "") + json_number(numbers[i]);
    }
    return text + "]";
}

std::string info_json(const cm_octree_options &made, const cm_octree_count &count,
                      const OctreeRun &run)
{
    const bool is_counts = made.rule == CM_OCTREE_COUNTS;
    std::string text = "{\"edge\": " + json_number(made.edge) +
                       ", \"levels\": " + std::to_string(made.levels) +
                       ", \"centre\": " + numbers_json(made.centre, 3) + ", \"rule\": \"" +
                       (is_counts ? "counts" : "log-odds") + "\"";
    if (!is_counts)
    {
        const double rule[4] = {made.hit, made.miss, made.low, made.high};
        text += ", \"log_odds\": " + numbers_json(rule, 4);
    }
    text += ", \"near\": " + json_number(made.near) + ", \"far\": " + json_number(made.far) +
            ", \"no_return_is_free\": " + (made.no_return_is_free != 0 ? "true" : "false") +
            ", \"endpoints_only\": " + (made.endpoints_only != 0 ? "true" : "false") +
            ", \"noise\": " + json_number(made.noise) +
            ", \"footprint\": " + json_number(made.footprint) +
            ", \"color\": " + (made.color != 0 ? "true" : "false");
    return text + ", \"views\": " + std::to_string(run.views) +
           ", \"complete\": " + (run.complete ? "true" : "false") + ", " + count_json(count) +
           "}\n";
}

std::string info_text(const cm_octree_options &made, const cm_octree_count &count,
                      const OctreeRun &run)
{
    char text[600];
    std::snprintf(
        text, sizeof text,
        "voxels of %.9g, %d levels around %.9g %.9g %.9g, %s, %s\n%llu views%s\n%llu "
        "voxels occupied, %llu free; %llu nodes, %.4g MB in memory, %llu regions in the "
        "file alone\n",
        made.edge, made.levels, made.centre[0], made.centre[1], made.centre[2],
        made.rule == CM_OCTREE_COUNTS ? "counts" : "log-odds",
        made.color != 0 ? "with colours" : "without colours",
        static_cast<unsigned long long>(run.views), run.complete ? "" : ", not complete",
        static_cast<unsigned long long>(count.occupied),
        static_cast<unsigned long long>(count.free), static_cast<unsigned long long>(count.nodes),
        1e-6 * static_cast<double>(count.bytes), static_cast<unsigned long long>(count.paged));
    return text;
}

} // namespace

int merge_octrees(int argc, char **argv, const cm_streams &streams)
{
    const MergeOptions options = parse_merge_options(argc, argv, streams);
    return options.printed ? 0 : merge(options, streams);
}

int tell_octree(int argc, char **argv, const cm_streams &streams)
{
    bool json = false;
    std::uint64_t memory = 0;
    OptionReader reader(octree_info_command, argc, argv, streams);
    while (const int id = reader.next())
    {
        json = json || id == OCTREE_JSON;
        memory = id == OCTREE_MEMORY ? read_memory(reader) : memory;
    }
    if (reader.printed())
    {
        return 0;
    }
    const std::string name = needed_operands(reader, 1, "MAP").front();
    const OctreeMap open = open_map(name, memory);
    const cm_octree_options &made = *cm_octree_describe(open.map.get());
    const cm_octree_count count = count_map(open.map.get(), name);
    const OctreeRun run = read_note(open.map.get());
    print(streams, json ? info_json(made, count, run) : info_text(made, count, run));
    return 0;
}
