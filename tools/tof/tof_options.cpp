// SPDX-License-Identifier: MIT

#include "tof_options.hpp"
#include "tof_table.h"

#include <cmath>

namespace
{

constexpr unsigned long samples_most = 64;

// "3x2": 3 and 2.
void read_samples(OptionReader &reader, cm_tof_options &to)
{
    const std::string text = reader.text();
    const std::size_t cross = text.find('x');
    unsigned long count[2] = {0, 0};
    for (int i = 0; i < 2 && cross != std::string::npos; ++i)
    {
        const std::string word = i == 0 ? text.substr(0, cross) : text.substr(cross + 1);
        const bool digits = !word.empty() && word.size() < 4 &&
                            word.find_first_not_of("0123456789") == std::string::npos;
        count[i] = digits ? std::stoul(word) : 0;
    }
    if (count[0] < 1 || count[1] < 1 || count[0] > samples_most || count[1] > samples_most)
    {
        reader.refuse("COLUMNSxROWS, such as 3x3, each from 1 to 64");
    }
    to.sample_columns = static_cast<std::uint32_t>(count[0]);
    to.sample_rows = static_cast<std::uint32_t>(count[1]);
}

double read_budget(OptionReader &reader)
{
    const std::optional<double> length = read_length(reader.text());
    if (!length)
    {
        reader.refuse("a length above 0, such as 1mm, 0.5cm or 0.001");
    }
    return *length;
}

void read_way(int id, OptionReader &reader, SimulateOptions &options)
{
    switch (id)
    {
    case TOF_BOUNCES:
        options.tof.bounces = reader.whole_number();
        options.bounces_given = true;
        break;
    case TOF_LIGHTS:
        options.tof.lights = static_cast<std::uint32_t>(reader.whole_number());
        break;
    case TOF_PATHS_A_PIXEL:
        options.tof.paths = static_cast<std::uint32_t>(reader.whole_number());
        options.tof.traces = 1;
        break;
    case TOF_VISIBILITY:
        options.tof.visibility = 1;
        break;
    case TOF_SAMPLES:
        read_samples(reader, options.tof);
        options.samples_given = true;
        break;
    case TOF_FULL:
        options.tof.full = 1;
        break;
    case TOF_NOISE:
        options.tof.noise = 1;
        break;
    case TOF_SHOT:
        options.tof.shot = static_cast<int>(reader.choice());
        break;
    default:
        options.tof.seed = static_cast<std::uint64_t>(reader.whole_number());
        break;
    }
}

void read_simulate_option(int id, OptionReader &reader, SimulateOptions &options)
{
    switch (id)
    {
    case TOF_OUTPUT:
        options.output = reader.text();
        break;
    case TOF_PRESET:
        options.preset = tof_preset_names[reader.choice()];
        break;
    case TOF_ENVIRONMENT:
        options.environment = reader.text();
        break;
    case TOF_ENVIRONMENT_SURFACE:
        options.environment_surface = reader.text();
        break;
    case TOF_BUDGET:
        options.budget = read_budget(reader);
        break;
    case TOF_TRUTH:
        options.truth = true;
        break;
    case TOF_FORMAT:
        options.format = static_cast<int>(reader.choice());
        break;
    case TOF_THREADS:
        options.threads = reader.whole_number();
        break;
    case TOF_JSON:
        options.json = true;
        break;
    case TOF_QUIET:
        options.quiet = true;
        break;
    default:
        read_way(id, reader, options);
        break;
    }
}

void take_format(SimulateOptions &options)
{
    options.is_stream = options.output == "-";
    if (options.is_stream && options.format >= 0 && options.format != TOF_FORMAT_NPY)
    {
        throw UsageFailure(std::string("-o - writes arrays of NPY, not --format ") +
                           tof_format_names[options.format] + "; see --help");
    }
    if (options.is_stream && options.json)
    {
        throw UsageFailure("--json has no place where -o - writes frames; see --help");
    }
    if (options.is_stream && options.budget)
    {
        throw UsageFailure("--budget has no place to tell where -o - writes frames; see --help");
    }
    options.format = options.is_stream    ? TOF_FORMAT_NPY
                     : options.format < 0 ? TOF_FORMAT_EXR
                                          : options.format;
}

void take_operands(const std::vector<std::string> &names, SimulateOptions &options)
{
    const bool preset = !options.preset.empty();
    if (names.size() != (preset ? 2 : 3))
    {
        throw UsageFailure(std::string(preset
                                           ? "SCENE and TRAJECTORY.txt are needed with --preset, "
                                           : "SCENE, SENSOR.json and TRAJECTORY.txt are needed, ") +
                           std::to_string(names.size()) + (names.size() == 1 ? " is" : " are") +
                           " given; see --help");
    }
    if (options.output.empty())
    {
        throw UsageFailure("-o DIR is needed: the folder to write; see --help");
    }
    if (options.tof.shot != CM_TOF_POISSON && options.tof.noise == 0 && !options.budget)
    {
        throw UsageFailure("--shot says where shot noise comes from; it needs --noise; see --help");
    }
    if (!options.environment && options.environment_surface)
    {
        throw UsageFailure("--environment-surface says what --environment shows; see --help");
    }
    take_format(options);
    options.scene = names.front();
    options.sensor = preset ? "" : names[1];
    options.trajectory = names.back();
}

} // namespace

std::optional<double> read_length(const std::string &text)
{
    static const struct
    {
        const char *name;
        double metres;
    } units[] = {{"um", 1e-6}, {"mm", 1e-3}, {"cm", 1e-2}, {"m", 1.0}, {"", 1.0}};
    for (const auto &unit : units)
    {
        const std::string ending = unit.name;
        const std::size_t digits = text.size() - ending.size();
        if (text.size() > ending.size() && text.compare(digits, ending.size(), ending) == 0)
        {
            const std::optional<double> number = read_number(text.substr(0, digits));
            const double metres = number.value_or(0) * unit.metres;
            return metres > 0 && std::isfinite(metres) ? std::optional<double>(metres)
                                                       : std::nullopt;
        }
    }
    return std::nullopt;
}

SimulateOptions parse_simulate_options(int argc, char **argv, const cm_streams &streams)
{
    SimulateOptions options;
    options.tof.size = sizeof options.tof;
    options.tof.sample_columns = options.tof.sample_rows = 1;
    OptionReader reader(tof_simulate_command, argc, argv, streams);
    while (const int id = reader.next())
    {
        read_simulate_option(id, reader, options);
    }
    options.printed = reader.printed();
    if (!options.printed)
    {
        take_operands(reader.operands(), options);
    }
    return options;
}
