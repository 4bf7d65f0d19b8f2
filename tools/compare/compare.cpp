// SPDX-License-Identifier: MIT
//
// cubemap-compare: how far two images of the same size are from each other.

#include "compare_main.h"
#include "compare_table.h"
#include "tools/cli/image_file.hpp"
#include "tools/cli/program.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>

namespace
{

constexpr double infinity = std::numeric_limits<double>::infinity();

struct Options
{
    std::optional<double> max_mean;
    std::optional<double> max_rmse;
    std::optional<double> max;
    bool quiet = false;
    bool printed = false; // is there nothing left to do?
    std::vector<std::string> names;
};

Options parse_options(int argc, char **argv, const cm_streams &streams)
{
    Options options;
    OptionReader reader(cm_compare_command, argc, argv, streams);
    while (const int id = reader.next())
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
        default:
            options.quiet = true;
            break;
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

struct Difference
{
    double mean = 0;
    double rmse = 0;
    double largest = 0;
    std::size_t where = 0; // index of the largest among all values
};

double error_of(float a, float b)
{
    if (std::isfinite(a) && std::isfinite(b))
    {
        return std::fabs(static_cast<double>(a) - static_cast<double>(b));
    }
    return a == b || (std::isnan(a) && std::isnan(b)) ? 0 : infinity;
}

Difference difference(const std::vector<float> &a, const std::vector<float> &b, double scale)
{
    Difference result;
    double sum = 0;
    double sum_of_squares = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
    {
        const double error = scale * error_of(a[i], b[i]);
        sum += error;
        sum_of_squares += error * error;
        if (error > result.largest)
        {
            result.largest = error;
            result.where = i;
        }
    }
    result.mean = sum / static_cast<double>(a.size());
    result.rmse = std::sqrt(sum_of_squares / static_cast<double>(a.size()));
    return result;
}

std::string size_text(const ImageFile &image)
{
    return in_quotes(image.path()) + " is " + std::to_string(image.width()) + " x " +
           std::to_string(image.height()) + " with " + std::to_string(image.channels()) +
           " channels";
}

std::vector<float> pixels_of(ImageFile &image)
{
    const std::int64_t count = std::int64_t{image.width()} * image.height();
    check_memory(in_quotes(image.path()), count, image.channels());
    const std::size_t stride =
        static_cast<std::size_t>(image.width()) * static_cast<std::size_t>(image.channels());
    std::vector<float> pixels(stride * static_cast<std::size_t>(image.height()));
    image.read(pixels.data(), stride, Finite::any);
    return pixels;
}

void print_difference(const cm_streams &streams, const Difference &found, const ImageFile &image,
                      bool integers)
{
    const char *const unit = integers ? " grey levels of 8 bits" : "";
    const double peak = integers ? 255 : 1;
    const std::size_t channels = static_cast<std::size_t>(image.channels());
    const std::size_t pixel = found.where / channels;
    const std::size_t width = static_cast<std::size_t>(image.width());
    const std::string channel(image.spec().channel_name(static_cast<int>(found.where % channels)));
    char text[500];
    std::snprintf(text, sizeof text,
                  "mean absolute error  %.6g%s\nRMSE                 %.6g%s\n"
                  "maximum              %.6g%s",
                  found.mean, unit, found.rmse, unit, found.largest, unit);
    std::string lines = text;
    if (found.largest > 0)
    {
        lines += " at x = " + std::to_string(pixel % width) +
                 ", y = " + std::to_string(pixel / width) + ", channel " + channel;
    }
    std::snprintf(text, sizeof text, "\nPSNR                 %.4g dB\n",
                  20 * std::log10(peak / found.rmse));
    print(streams, lines + text);
}

void check_limit(const char *what, double value, const std::optional<double> &limit)
{
    if (limit && !(value <= *limit))
    {
        char text[200];
        std::snprintf(text, sizeof text, "the %s is %.6g, above the limit of %.6g", what, value,
                      *limit);
        throw Failure(text);
    }
}

int compare(int argc, char **argv, const cm_streams &streams)
{
    const Options options = parse_options(argc, argv, streams);
    if (options.printed)
    {
        return 0;
    }
    ImageFile a(options.names[0]);
    ImageFile b(options.names[1]);
    if (a.width() != b.width() || a.height() != b.height() || a.channels() != b.channels())
    {
        throw Failure(size_text(a) + ", " + size_text(b) + "; they must be alike");
    }
    const bool integers =
        !a.spec().format.is_floating_point() && !b.spec().format.is_floating_point();
    const Difference found = difference(pixels_of(a), pixels_of(b), integers ? 255 : 1);
    if (!options.quiet)
    {
        print_difference(streams, found, a, integers);
    }
    check_limit("mean absolute error", found.mean, options.max_mean);
    check_limit("root of the mean square error", found.rmse, options.max_rmse);
    check_limit("largest error", found.largest, options.max);
    return 0;
}

} // namespace

int cm_compare_main(int argc, char **argv, const cm_streams *streams)
{
    return run_program("cubemap-compare", *streams,
                       [argc, argv, streams] { return compare(argc, argv, *streams); });
}
