// SPDX-License-Identifier: MIT

#include "compare_options.hpp"
#include "compare_main.h"
#include "tools/cli/colormap_name.h"
#include "tools/cli/program.hpp"

#include <cubemap/colormap.h>

#include <cstring>

namespace
{

// "mean,rmse": each is wanted.
void read_measures(OptionReader &reader, CompareOptions &options)
{
    const std::string text = reader.text();
    options.measure = {};
    for (std::size_t first = 0; first <= text.size();)
    {
        const std::size_t comma = std::min(text.find(',', first), text.size());
        const std::string name = text.substr(first, comma - first);
        std::size_t found = 0;
        cm_nearest nearest = cm_nearest_to(name.c_str(), name.size());
        while (found < MEASURE_COUNT && name != cm_compare_measure_name(found))
        {
            const char *const known = cm_compare_measure_name(found++);
            cm_nearest_try(&nearest, known, std::strlen(known));
        }
        if (found == MEASURE_COUNT)
        {
            throw UsageFailure(reader.name() + ": " + in_quotes(name) + " is no measure" +
                               suggestion(nearest) + "; see --help");
        }
        options.measure[found] = true;
        first = comma + 1;
    }
}

void read_peak(OptionReader &reader, CompareOptions &options)
{
    options.peak_of_reference = reader.text() == "reference";
    options.peak = options.peak_of_reference ? std::nullopt : read_number(reader.text());
    if (!options.peak_of_reference &&
        !(options.peak && *options.peak >= 1e-90 && *options.peak <= 1e90))
    {
        reader.refuse("a number from 1e-90 to 1e90 or 'reference'");
    }
}

std::pair<double, double> read_range(OptionReader &reader)
{
    const std::string text = reader.text();
    const std::size_t colon = text.find(':');
    const std::optional<double> low = read_number(text.substr(0, colon));
    const std::optional<double> high =
        colon == std::string::npos ? std::nullopt : read_number(text.substr(colon + 1));
    if (!low || !high || !(*low < *high))
    {
        reader.refuse("LOW:HIGH, two numbers with LOW below HIGH, such as 0:0.5");
    }
    return {*low, *high};
}

std::string read_colors(const OptionReader &reader)
{
    const std::string text = reader.text();
    char message[400];
    if (cm_colormap_check(text.c_str(), message, sizeof message) != CM_OK)
    {
        throw UsageFailure(reader.name() + ": " + in_quotes(text) + ": " + message +
                           suggestion(nearest_colormap(text.c_str())));
    }
    return text;
}

// What the picture of the difference needs; false for other options.
bool read_picture_option(int id, OptionReader &reader, CompareOptions &options)
{
    switch (id)
    {
    case COMPARE_DIFFERENCE:
        options.difference = reader.text();
        return true;
    case COMPARE_DIFFERENCE_OF:
        options.difference_of = reader.choice();
        return true;
    case COMPARE_RANGE:
        options.range = read_range(reader);
        return true;
    case COMPARE_COLORS:
        options.colors = read_colors(reader);
        return true;
    default:
        return false;
    }
}

void read_option(int id, OptionReader &reader, CompareOptions &options)
{
    switch (id)
    {
    case COMPARE_MAX_MEAN:
        options.max_mean = reader.number();
        break;
    case COMPARE_MAX_RMSE:
        options.max_rmse = reader.number();
        break;
    case COMPARE_MAX:
        options.max = reader.number();
        break;
    case COMPARE_MEASURE:
        read_measures(reader, options);
        break;
    case COMPARE_PEAK:
        read_peak(reader, options);
        break;
    case COMPARE_PIXELS_PER_DEGREE:
        options.pixels_per_degree = reader.number();
        break;
    case COMPARE_BY_AREA:
        options.by_area = true;
        break;
    case COMPARE_SURFACE:
        options.surface = reader.text();
        break;
    case COMPARE_REFERENCE_SURFACE:
        options.reference_surface = reader.text();
        break;
    case COMPARE_BORDER:
        options.border = static_cast<unsigned>(reader.whole_number());
        break;
    case COMPARE_SKIP_NOT_FINITE:
        options.skip_not_finite = true;
        break;
    case COMPARE_JSON:
        options.json = true;
        break;
    case COMPARE_THREADS:
        options.threads = static_cast<unsigned>(reader.whole_number());
        break;
    default:
        options.quiet = true;
        break;
    }
}

} // namespace

CompareOptions parse_compare_options(int argc, char **argv, const cm_streams &streams)
{
    CompareOptions options;
    for (const int measure : {MEASURE_MEAN, MEASURE_RMSE, MEASURE_MAX, MEASURE_PSNR})
    {
        options.measure[static_cast<std::size_t>(measure)] = true;
    }
    OptionReader reader(cm_compare_command, argc, argv, streams);
    while (const int id = reader.next())
    {
        if (!read_picture_option(id, reader, options))
        {
            read_option(id, reader, options);
        }
    }
    options.printed = reader.printed();
    if (!options.printed)
    {
        options.names = reader.operands();
    }
    if (!options.printed && options.names.size() != 2)
    {
        throw UsageFailure("two images are needed, " + std::to_string(options.names.size()) +
                           (options.names.size() == 1 ? " is" : " are") + " given; see --help");
    }
    return options;
}
