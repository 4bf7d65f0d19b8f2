// SPDX-License-Identifier: MIT
//
// cubemap-colormap: perceptually uniform colour maps as tables, as code and as pictures.

#include "tools/cli/atomic_file.hpp"
#include "colormap_main.h"
#include "colormap_output.hpp"
#include "colormap_table.h"
#include "tools/cli/colormap_name.h"
#include "tools/cli/program.hpp"

#include <algorithm>
#include <cmath>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <optional>

#include <cubemap/status.h>

namespace
{

constexpr int side_max = 32768;

enum class Format
{
    json,
    csv,
    matplotlib,
    gimp,
    png
};

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
    bool printed = false; // is there nothing left to do?
};

// ---- the command line

PictureSize read_size(OptionReader &reader)
{
    const std::string text = reader.text();
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
        reader.refuse("WIDTHxHEIGHT, two whole numbers from 1 to " + std::to_string(side_max));
    }
    return size;
}

// What goes into files as it is: nothing that ends a line or a quoted text.
std::string read_name(OptionReader &reader)
{
    const std::string name = reader.text();
    const auto is_allowed = [](char letter)
    {
        return (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') ||
               (letter >= '0' && letter <= '9') || letter == '-' || letter == '_' || letter == '.';
    };
    if (name.empty() || !std::all_of(name.begin(), name.end(), is_allowed))
    {
        reader.refuse("a word of letters, digits, '-', '_' and '.'");
    }
    return name;
}

std::string read_output(const OptionReader &reader)
{
    if (reader.text().empty())
    {
        throw UsageFailure(reader.name() + " needs the name of a file");
    }
    return reader.text();
}

void read_option(int id, OptionReader &reader, Options &options)
{
    switch (id)
    {
    case COLORMAP_OUTPUT:
        options.output = read_output(reader);
        break;
    case COLORMAP_FORMAT:
        options.format = static_cast<Format>(reader.choice());
        break;
    case COLORMAP_SAMPLES:
        options.samples = static_cast<std::size_t>(reader.whole_number());
        break;
    case COLORMAP_REVERSE:
        options.reverse = true;
        break;
    case COLORMAP_FIT:
        options.fit = true;
        break;
    case COLORMAP_STRICT:
        options.strict = true;
        break;
    case COLORMAP_NAME:
        options.name = read_name(reader);
        break;
    case COLORMAP_SIZE:
        options.size = read_size(reader);
        break;
    case COLORMAP_TEST_PATTERN:
        options.test_pattern = true;
        break;
    default:
        options.list = true;
        break;
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
                           cm_colormap_formats[static_cast<std::size_t>(format)]);
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

Options parse_options(int argc, char **argv, const cm_streams &streams)
{
    Options options;
    OptionReader reader(cm_colormap_command, argc, argv, streams);
    while (const int id = reader.next())
    {
        read_option(id, reader, options);
    }
    options.printed = reader.printed();
    if (!options.printed)
    {
        options.maps = reader.operands();
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
        const std::string meant = suggestion(nearest_colormap(specification.c_str()));
        throw UsageFailure(message + (meant.empty() ? "; see --list" : meant));
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
    const Options options = parse_options(argc, argv, streams);
    if (options.printed)
    {
        return 0;
    }
    if (options.list)
    {
        print(streams, listing_text());
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
