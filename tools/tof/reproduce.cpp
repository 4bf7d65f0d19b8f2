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

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include <sys/wait.h>
#include <unistd.h>

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

std::string quoted(const std::string &text)
{
    std::string made = "\"";
    for (const char c : text)
    {
        made += c == '"' || c == '\\' ? std::string("\\") + c : std::string(1, c);
    }
    return made + "\"";
}

template <class Number> std::string list_of(const std::vector<Number> &values)
{
    std::string made = "[";
    for (const Number value : values)
    {
        made += made.size() > 1 ? "," : "";
        made += std::isfinite(value) ? text_of_number(static_cast<double>(value), 9) : "null";
    }
    return made + "]";
}

std::string list_of(const std::vector<std::string> &words)
{
    std::string made = "[";
    for (const std::string &word : words)
    {
        made += (&word == words.data() ? "" : ",") + quoted(word);
    }
    return made + "]";
}

std::string chart_json(const Chart &chart)
{
    std::string made = "{\"name\":" + quoted(chart.name) + ",\"title\":" + quoted(chart.title) +
                       ",\"x\":" + quoted(chart.x) + ",\"y\":" + quoted(chart.y) +
                       ",\"scatter\":" + (chart.is_scatter ? "true" : "false") +
                       ",\"logarithmic\":" + (chart.is_logarithmic ? "true" : "false") +
                       ",\"ticks\":" + list_of(chart.tick) + ",\"curves\":[";
    for (const ChartCurve &curve : chart.curves)
    {
        made += &curve == chart.curves.data() ? "" : ",";
        made += "{\"name\":" + quoted(curve.name) + ",\"x\":" + list_of(curve.x) +
                ",\"y\":" + list_of(curve.y) + ",\"mark\":" + list_of(curve.mark) + "}";
    }
    made += "],\"pictures\":[";
    for (const ChartPicture &picture : chart.pictures)
    {
        made += &picture == chart.pictures.data() ? "" : ",";
        made += "{\"name\":" + quoted(picture.name) + ",\"unit\":" + quoted(picture.unit) +
                ",\"width\":" + std::to_string(picture.width) +
                ",\"value\":" + list_of(picture.value) + "}";
    }
    return made + "]}";
}

std::string reproduction_json(const Experiment &experiment, const Reproduction &made)
{
    std::string text = "{\"name\":" + quoted(experiment.name) +
                       ",\"source\":" + quoted(experiment.source) +
                       ",\"missing\":" + quoted(made.missing) + ",\"rows\":[";
    for (const ReproducedRow &row : made.rows)
    {
        text += &row == made.rows.data() ? "\n" : ",\n";
        text += "{\"what\":" + quoted(row.what) + ",\"paper\":" + quoted(row.paper) +
                ",\"ours\":" + quoted(row.ours) + ",\"holds\":" + (row.holds ? "true" : "false") +
                "}";
    }
    text += "],\"charts\":[";
    for (const Chart &chart : made.charts)
    {
        text += &chart == made.charts.data() ? "\n" : ",\n";
        text += chart_json(chart);
    }
    return text + "]}\n";
}

void write_text(const std::string &path, const std::string &text)
{
    AtomicFile file(path);
    file.write(text.data(), text.size());
    file.finish();
    file.appear();
}

// Where the script is that draws: beside what is installed, or among the sources.
std::string chart_script()
{
    for (const char *const path : {CM_TOF_CHART_INSTALLED, CM_TOF_CHART_SOURCE})
    {
        if (std::filesystem::exists(path))
        {
            return path;
        }
    }
    return "";
}

// Did it draw? The system's Python has the system's matplotlib, where another comes first.
bool draws(const char *python, const std::string &script, const std::string &json,
           const std::string &folder)
{
    const pid_t child = fork();
    if (child == 0)
    {
        execlp(python, python, script.c_str(), json.c_str(), folder.c_str(),
               static_cast<char *>(nullptr));
        _exit(127);
    }
    int status = 0;
    return child > 0 && waitpid(child, &status, 0) == child && WIFEXITED(status) &&
           WEXITSTATUS(status) == 0;
}

// False if there are no charts, since Python or matplotlib is missing.
bool draw(const std::string &json, const std::string &folder)
{
    const std::string script = chart_script();
    return !script.empty() && (draws("python3", script, json, folder) ||
                               draws("/usr/bin/python3", script, json, folder));
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

std::string text_of_number(double value, int digits)
{
    std::array<char, 40> text = {};
    std::snprintf(text.data(), text.size(), "%.*g", digits, value);
    return text.data();
}

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
        if (!made.charts.empty() && !draw(json, options.folder))
        {
            std::fprintf(streams.err,
                         "cubemap-tof: no charts of %s: python3 with matplotlib is not there\n",
                         experiment->name);
        }
    }
    write_text(options.folder + "/report.md", report);
    return 0;
}
