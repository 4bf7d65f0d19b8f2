// SPDX-License-Identifier: MIT
//
// cubemap-tof reproduce: the papers' tables and figures, as texts, JSON and charts.

#include "reproduce.hpp"

#include "tof_command.hpp"
#include "tof_table.h"
#include "tools/cli/atomic_file.hpp"
#include "tools/cli/catalogue_name.h"
#include "tools/cli/image_file.hpp"
#include "tools/cli/parallel.hpp"
#include "tools/cli/program.hpp"

#include <cstdio>
#include <filesystem>

namespace
{

constexpr Experiment experiments[] = {
    {"exact", "formulas", reproduce_exact},
    {"layouts", "Lambers, Hoberg and Kolb 2015, figures 6, 9 and 10", reproduce_layouts},
    {"resolution", "Lambers, Hoberg and Kolb 2015, figure 7", reproduce_resolution},
    {"multipath", "Bulczak, Lambers and Kolb 2018, table 2 and figure 9", reproduce_multipath},
    {"lens", "Lambers, Sommerhoff and Kolb 2018, section 4", reproduce_lens},
    {"motion", "Steiner and others 2019, table 2 and figure 6", reproduce_motion_compensation}};

const char *experiment_at(std::size_t index)
{
    return index < std::size(experiments) ? experiments[index].name : nullptr;
}

std::string reproduction_json(const Experiment &experiment, const Reproduction &made)
{
    std::string text = "{\"name\":" + json_text(experiment.name) +
                       ",\"source\":" + json_text(experiment.source) +
                       ",\"missing\":" + json_text(made.missing) + ",\"rows\":[";
    for (const ReproducedRow &row : made.rows)
    {
        text += &row == made.rows.data() ? "\n" : ",\n";
        text += "{\"what\":" + json_text(row.what) + ",\"paper\":" + json_text(row.paper) +
                ",\"ours\":" + json_text(row.ours) +
                ",\"holds\":" + (row.holds ? "true" : "false") + "}";
    }
    return text + "],\"charts\":" + charts_json(made.charts) + "}\n";
}

void write_text(const std::string &path, const std::string &text)
{
    AtomicFile file(path);
    file.write(text.data(), text.size());
    file.finish();
    file.appear();
}

std::string table_of(const Experiment &experiment, const Reproduction &made)
{
    std::string text = std::string("## ") + experiment.name + ": " + experiment.source + "\n\n";
    if (!made.missing.empty())
    {
        return text + "Not done: " + made.missing + ".\n\n";
    }
    text += "| what | paper | here | holds |\n| --- | --- | --- | --- |\n";
    for (const ReproducedRow &row : made.rows)
    {
        text += "| " + row.what + " | " + row.paper + " | " + row.ours + " | " +
                (row.holds ? "yes" : "no") + " |\n";
    }
    return text + "\n";
}

struct ReproduceOptions
{
    std::string folder;
    std::vector<const Experiment *> chosen;
    int threads = 0;
    bool quiet = false;
    bool printed = false;
};

const Experiment *find_experiment(const std::string &name)
{
    for (const Experiment &each : experiments)
    {
        if (name == each.name)
        {
            return &each;
        }
    }
    throw UsageFailure(in_quotes(name) +
                       " is no experiment: exact, layouts, resolution, multipath, lens or motion" +
                       suggestion(nearest_name(name.c_str(), experiment_at)));
}

ReproduceOptions parse(int argc, char **argv, const cm_streams &streams)
{
    ReproduceOptions options;
    OptionReader reader(tof_reproduce_command, argc, argv, streams);
    while (const int id = reader.next())
    {
        if (id == TOF_OUTPUT)
        {
            options.folder = reader.text();
        }
        else if (id == TOF_THREADS)
        {
            options.threads = reader.whole_number();
        }
        else
        {
            options.quiet = true;
        }
    }
    options.printed = reader.printed();
    if (options.printed)
    {
        return options;
    }
    for (const std::string &name : reader.operands())
    {
        options.chosen.push_back(find_experiment(name));
    }
    for (const Experiment &each : experiments)
    {
        if (reader.operands().empty())
        {
            options.chosen.push_back(&each);
        }
    }
    if (options.folder.empty())
    {
        throw UsageFailure("-o DIR is needed: the folder to write; see --help");
    }
    return options;
}

} // namespace

int reproduce_papers(int argc, char **argv, const cm_streams &streams)
{
    const ReproduceOptions options = parse(argc, argv, streams);
    if (options.printed)
    {
        return 0;
    }
    std::error_code wrong;
    std::filesystem::create_directories(options.folder, wrong);
    if (wrong)
    {
        throw Failure(in_quotes(options.folder) + " cannot be made: " + wrong.message());
    }
    const ReproduceSettings settings = {thread_count(options.threads), [&](const std::string &what)
                                        {
                                            if (!options.quiet)
                                            {
                                                std::fprintf(streams.err, "%s\n", what.c_str());
                                            }
                                        }};
    std::string report;
    for (const Experiment *experiment : options.chosen)
    {
        const Reproduction made = experiment->run(settings);
        const std::string json = options.folder + "/" + experiment->name + ".json";
        write_text(json, reproduction_json(*experiment, made));
        const std::string table = table_of(*experiment, made);
        print(streams, table);
        report += table;
        if (!made.charts.empty() && !draw_charts(json, options.folder))
        {
            std::fprintf(streams.err,
                         "cubemap-tof: no charts of %s: python3 with matplotlib is not there\n",
                         experiment->name);
        }
    }
    write_text(options.folder + "/report.md", report);
    return 0;
}
