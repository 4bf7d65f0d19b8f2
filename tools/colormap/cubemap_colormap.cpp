// SPDX-License-Identifier: MIT
//
// cubemap-colormap: perceptually uniform colour maps as tables, as code and as pictures.

#include "tools/cli/atomic_file.hpp"
#include "colormap_main.h"
#include "colormap_output.hpp"
#include "tools/cli/program.hpp"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <optional>

#include <cubemap/status.h>
#include <cubemap/version.h>

namespace
{

constexpr const char *help_text =
    R"(Usage: cubemap-colormap [OPTION]... MAP

Makes a perceptually uniform colour map: equal steps of the data are equal steps
of CIELUV. MAP is NAME or NAME:PARAMETER=VALUE[,...]; --list prints them.

  -o, --output FILE  what to write; default: standard output
  --format FORMAT    json, csv, matplotlib (a Python file that registers the map),
                     gimp (a palette) or png; default: by the end of FILE's name,
                     .json, .csv, .py, .gpl or .png, and csv for standard output
  --samples N        number of colours, 1 to 65536; default: 256; 257 for diverging
                     maps, so that their middle is one; 8 for qualitative ones; for
                     png otherwise one for each column
  --reverse          the last colour first
  --fit              lower the saturation until no colour is outside sRGB
  --strict           refuse a map with colours outside sRGB; without it they are cut,
                     and a warning says so
  --name NAME        for matplotlib and gimp; default: cubemap-MODEL
  --size WxH         of the png; default: 512x64
  --test-pattern     for png: Kovesi's sine wave, fading from top to bottom, over a
                     ramp; where it is hard to see, the map is flat
  --list             print the maps and their parameters
  --help, --version

Examples:
  cubemap-colormap rainbow:saturation=1.5 -o rainbow.json
  cubemap-colormap diverging --test-pattern --size 768x160 -o diverging.png
  cubemap-colormap qualitative --samples 6 --format gimp
)";

constexpr std::int64_t samples_max = 65536;
constexpr int side_max = 32768;

enum class Format
{
    json,
    csv,
    matplotlib,
    gimp,
    png
};

const std::vector<std::string> format_names = {"json", "csv", "matplotlib", "gimp", "png"};
const std::vector<std::string> format_suffixes = {".json", ".csv", ".py", ".gpl", ".png"};

struct Options
{
    std::vector<std::string> maps;
    std::string output; // empty for standard output
    std::optional<Format> format;
    std::optional<std::size_t> samples;
    std::optional<PictureSize> size;
    std::string name;
    bool reverse = false;
    bool fit = false;
    bool strict = false;
    bool test_pattern = false;
    bool list = false;
    bool help = false;
    bool version = false;
};

// ---- the command line

PictureSize read_size(ArgumentReader &reader)
{
    const std::string text = reader.value();
    PictureSize size;
    const char *const end = text.data() + text.size();
    const auto width = std::from_chars(text.data(), end, size.width);
    const bool has_cross = width.ec == std::errc() && width.ptr != end && *width.ptr == 'x';
    const auto height = has_cross ? std::from_chars(width.ptr + 1, end, size.height)
                                  : std::from_chars(end, end, size.height);
    const bool good = height.ec == std::errc() && height.ptr == end && size.width >= 1 &&
                      size.height >= 1 && size.width <= side_max && size.height <= side_max;
    if (!good)
    {
        throw UsageFailure("--size: " + in_quotes(text) +
                           " is not WIDTHxHEIGHT, two whole numbers from 1 to " +
                           std::to_string(side_max));
    }
    return size;
}

// What goes into files as it is: nothing that ends a line or a quoted text.
std::string read_name(ArgumentReader &reader)
{
    const std::string name = reader.value();
    const auto is_allowed = [](char letter)
    {
        return (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') ||
               (letter >= '0' && letter <= '9') || letter == '-' || letter == '_' || letter == '.';
    };
    if (name.empty() || !std::all_of(name.begin(), name.end(), is_allowed))
    {
        throw UsageFailure("--name: " + in_quotes(name) +
                           " is not a word of letters, digits, '-', '_' and '.'");
    }
    return name;
}

bool *switch_called(const std::string &name, Options &options)
{
    return name == "--reverse"        ? &options.reverse
           : name == "--fit"          ? &options.fit
           : name == "--strict"       ? &options.strict
           : name == "--test-pattern" ? &options.test_pattern
           : name == "--list"         ? &options.list
           : name == "--help"         ? &options.help
           : name == "--version"      ? &options.version
                                      : nullptr;
}

void read_option(ArgumentReader &reader, Options &options)
{
    const std::string name = reader.text();
    bool *const is_set = switch_called(name, options);
    if (is_set != nullptr)
    {
        *is_set = true;
    }
    else if (name == "-o" || name == "--output")
    {
        options.output = reader.value();
        if (options.output.empty())
        {
            throw UsageFailure(name + " needs the name of a file");
        }
    }
    else if (name == "--format")
    {
        options.format = static_cast<Format>(reader.word(format_names));
    }
    else if (name == "--samples")
    {
        options.samples = static_cast<std::size_t>(reader.whole_number(1, samples_max));
    }
    else if (name == "--size")
    {
        options.size = read_size(reader);
    }
    else if (name == "--name")
    {
        options.name = read_name(reader);
    }
    else
    {
        throw UsageFailure("there is no option " + in_quotes(name) + "; see --help");
    }
}

Format format_of(const Options &options)
{
    if (options.format)
    {
        return *options.format;
    }
    if (options.output.empty())
    {
        return Format::csv;
    }
    const std::string suffix = std::filesystem::path(options.output).extension().string();
    const auto found = std::find(format_suffixes.begin(), format_suffixes.end(), suffix);
    if (found == format_suffixes.end())
    {
        throw UsageFailure(in_quotes(options.output) +
                           ": an output's name must end in .json, .csv, .py, .gpl or .png, or "
                           "--format say what it is");
    }
    return static_cast<Format>(found - format_suffixes.begin());
}

void check_options(const Options &options, Format format)
{
    if (options.maps.size() != 1)
    {
        throw UsageFailure("one MAP is needed, " + std::to_string(options.maps.size()) +
                           (options.maps.size() == 1 ? " is" : " are") + " given; see --help");
    }
    if (format == Format::png && options.output.empty())
    {
        throw UsageFailure("a png goes to a file: -o FILE");
    }
    if (format != Format::png && (options.size || options.test_pattern))
    {
        throw UsageFailure(std::string(options.size ? "--size" : "--test-pattern") +
                           " is for png only, not for " +
                           format_names[static_cast<std::size_t>(format)]);
    }
    if (options.test_pattern && options.samples)
    {
        throw UsageFailure(
            "--samples has no meaning with --test-pattern, which shows all of the map");
    }
    if (!options.name.empty() && format != Format::matplotlib && format != Format::gimp)
    {
        throw UsageFailure("--name is for matplotlib and gimp only");
    }
}

Options parse_options(int argc, char **argv)
{
    Options options;
    ArgumentReader reader(argc, argv);
    while (reader.next())
    {
        if (reader.is_option())
        {
            read_option(reader, options);
        }
        else
        {
            options.maps.push_back(reader.text());
        }
    }
    return options;
}

// ---- the map

// A line that does not end the program.
void note(const cm_streams &streams, const std::string &text)
{
    std::fprintf(streams.err, "cubemap-colormap: %s\n", text.c_str());
}

ColormapPointer make_map(const std::string &specification)
{
    char message[400];
    if (cm_colormap_check(specification.c_str(), message, sizeof message) != CM_OK)
    {
        throw UsageFailure(std::string(message) + "; see --list");
    }
    cm_colormap *map = nullptr;
    const cm_status status = cm_colormap_create(specification.c_str(), &map);
    if (status != CM_OK)
    {
        throw Failure(in_quotes(specification) + ": " + cm_status_text(status));
    }
    return ColormapPointer(map);
}

double value_called(const cm_colormap *map, const std::string &name)
{
    const cm_colormap_info *const info = cm_colormap_describe(map);
    std::size_t i = 0;
    while (i < info->parameter_count && name != info->parameter[i].name)
    {
        ++i;
    }
    return cm_colormap_parameter(map, i);
}

// "saturation from 3 to 2.2", for what --fit has changed; empty if nothing.
std::string changes_between(const cm_colormap *before, const cm_colormap *after)
{
    std::string text;
    for (const char *name : {"saturation", "saturation-range"})
    {
        const double from = value_called(before, name);
        const double to = value_called(after, name);
        if (from < to || from > to)
        {
            text += std::string(text.empty() ? "" : ", ") + name + " from " + number_text(from, 6) +
                    " to " + number_text(to, 6);
        }
    }
    return text;
}

ColormapPointer fitted(const cm_streams &streams, const ColormapPointer &map)
{
    cm_colormap *result = nullptr;
    const cm_status status = cm_colormap_fit(map.get(), &result);
    if (status != CM_OK)
    {
        throw Failure(std::string("--fit: ") + cm_status_text(status));
    }
    ColormapPointer fit(result);
    const std::string changes = changes_between(map.get(), fit.get());
    note(streams,
         changes.empty() ? "the map is inside sRGB as it is" : "fitted into sRGB: " + changes);
    return fit;
}

// What of the specification would bring the map into sRGB.
std::string remedy(const cm_colormap *map)
{
    const double saturation = cm_colormap_largest_saturation(map);
    return saturation >= 0 ? "saturation=" + number_text(std::floor(saturation * 1e4) / 1e4, 6)
                           : "a larger saturation-range";
}

// Says what is cut, or refuses it.
void report_clipping(const cm_streams &streams, const SampledMap &sampled, const Options &options)
{
    const cm_colormap_clipping &clipping = sampled.clipping;
    const bool outside =
        options.test_pattern ? cm_colormap_inside(sampled.map) == 0 : clipping.count > 0;
    if (!outside)
    {
        return;
    }
    const std::string what =
        options.test_pattern
            ? "colours of the map are outside sRGB"
            : std::to_string(clipping.count) + " of " + std::to_string(sampled.samples.size()) +
                  " colours are outside sRGB, the first at t = " + number_text(clipping.first_t, 4);
    const std::string advice = "; --fit mends that, or " + remedy(sampled.map);
    if (options.strict)
    {
        throw Failure(what + advice);
    }
    note(streams, "warning: " + what + advice + "; they are cut");
}

std::size_t sample_count(const Options &options, const cm_colormap *map, Format format,
                         PictureSize size)
{
    if (options.samples)
    {
        return *options.samples;
    }
    const cm_colormap_family family = cm_colormap_describe(map)->family;
    if (family == CM_COLORMAP_QUALITATIVE)
    {
        return 8;
    }
    if (format == Format::png)
    {
        return static_cast<std::size_t>(size.width);
    }
    return family == CM_COLORMAP_DIVERGING ? 257 : 256;
}

void write_text(const cm_streams &streams, const std::string &text, const std::string &path)
{
    if (path.empty())
    {
        print(streams, text);
        return;
    }
    std::vector<std::unique_ptr<AtomicFile>> files;
    files.push_back(std::make_unique<AtomicFile>(path));
    files.back()->write(text.data(), text.size());
    files.back()->check();
    appear_together(files);
}

std::string text_of(const SampledMap &sampled, Format format)
{
    switch (format)
    {
    case Format::json:
        return json_text(sampled);
    case Format::matplotlib:
        return matplotlib_text(sampled);
    case Format::gimp:
        return gimp_text(sampled);
    default:
        return csv_text(sampled);
    }
}

int colormap(int argc, char **argv, const cm_streams &streams)
{
    const Options options = parse_options(argc, argv);
    if (options.help || options.version || options.list)
    {
        print(streams, options.help      ? help_text
                       : options.version ? "cubemap-colormap " + std::string(cm_version()) + "\n"
                                         : listing_text());
        return 0;
    }
    const Format format = format_of(options);
    check_options(options, format);
    ColormapPointer map = make_map(options.maps[0]);
    if (options.fit)
    {
        map = fitted(streams, map);
    }
    const PictureSize size = options.size.value_or(PictureSize());
    const std::string name =
        options.name.empty() ? std::string("cubemap-") + cm_colormap_describe(map.get())->identifier
                             : options.name;
    const SampledMap sampled = sample_map(
        map.get(), name, sample_count(options, map.get(), format, size), options.reverse);
    report_clipping(streams, sampled, options);
    if (format == Format::png)
    {
        write_picture(sampled, size, options.test_pattern, options.output);
    }
    else
    {
        write_text(streams, text_of(sampled, format), options.output);
    }
    return 0;
}

} // namespace

int cm_colormap_main(int argc, char **argv, const cm_streams *streams)
{
    return run_program("cubemap-colormap", *streams,
                       [argc, argv, streams] { return colormap(argc, argv, *streams); });
}
