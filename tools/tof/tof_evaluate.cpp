// SPDX-License-Identifier: MIT
//
// cubemap-tof evaluate: measured distances against true ones, and what a confidence is worth.

#include "tof_command.hpp"
#include "tof_table.h"
#include "tools/cli/image_file.hpp"
#include "tools/cli/program.hpp"
#include "tools/cli/scene_handle.hpp"

#include <cubemap/depth_error.h>

#include <cstdio>

namespace
{

constexpr std::size_t curve_points = 20;

struct EvaluateOptions
{
    std::string measured;
    std::string truth;
    std::string confidence;
    bool json = false;
    bool printed = false;
};

EvaluateOptions parse_evaluate_options(int argc, char **argv, const cm_streams &streams)
{
    EvaluateOptions options;
    OptionReader reader(tof_evaluate_command, argc, argv, streams);
    while (const int id = reader.next())
    {
        if (id == TOF_CONFIDENCE)
        {
            options.confidence = reader.text();
        }
        else
        {
            options.json = true;
        }
    }
    options.printed = reader.printed();
    if (options.printed)
    {
        return options;
    }
    const std::vector<std::string> names = reader.operands();
    if (names.size() != 2)
    {
        throw UsageFailure("MEASURED.exr and TRUTH.exr are needed, " +
                           std::to_string(names.size()) + (names.size() == 1 ? " is" : " are") +
                           " given; see --help");
    }
    options.measured = names[0];
    options.truth = names[1];
    return options;
}

struct DistancePicture
{
    int width = 0;
    int height = 0;
    std::vector<float> value;
};

// The part of a file that has ranges, if it has parts with names, as the truth's has.
std::uint32_t part_of_range(const std::string &path)
{
    for (std::uint32_t part = 0;; ++part)
    {
        const ImageFile file(path, 0, part);
        const char *const name = file.stored().subimage_name;
        if (name == nullptr || std::string(name) == "range")
        {
            return part;
        }
    }
}

DistancePicture read_distances(const std::string &path)
{
    ImageFile file(path, 0, part_of_range(path));
    DistancePicture picture = {file.width(), file.height(), {}};
    const std::size_t channels = static_cast<std::size_t>(file.channels());
    const std::size_t width = static_cast<std::size_t>(picture.width);
    const std::size_t pixels = width * static_cast<std::size_t>(picture.height);
    std::vector<float> rows(pixels * channels);
    file.read(rows.data(), width * channels, Finite::any);
    for (std::size_t i = 0; i < pixels; ++i)
    {
        picture.value.push_back(rows[i * channels]);
    }
    return picture;
}

DistancePicture read_alike(const std::string &path, const DistancePicture &other,
                           const std::string &of)
{
    DistancePicture picture = read_distances(path);
    if (picture.width != other.width || picture.height != other.height)
    {
        throw Failure(in_quotes(path) + " has " + std::to_string(picture.width) + " x " +
                      std::to_string(picture.height) + " pixels, " + in_quotes(of) + " " +
                      std::to_string(other.width) + " x " + std::to_string(other.height));
    }
    return picture;
}

void check_measures(cm_status status, const EvaluateOptions &options)
{
    if (status == CM_ERROR_RANK)
    {
        throw Failure(in_quotes(options.measured) + " and " + in_quotes(options.truth) +
                      " have no pixel that both measure");
    }
    check_scene(status, "");
}

std::string number_list(const std::vector<double> &numbers)
{
    std::string text = "[";
    for (const double number : numbers)
    {
        text += (text.size() > 1 ? ", " : "") + json_number(number);
    }
    return text + "]";
}

// The curve of a confidence: errors of what is left when parts of the pixels are removed.
std::string sparsification_json(const EvaluateOptions &options, const DistancePicture &measured,
                                const DistancePicture &truth)
{
    if (options.confidence.empty())
    {
        return "";
    }
    const DistancePicture confidence = read_alike(options.confidence, truth, options.truth);
    std::vector<double> fraction, error(curve_points), oracle(curve_points);
    for (std::size_t i = 0; i < curve_points; ++i)
    {
        fraction.push_back(static_cast<double>(i) / curve_points);
    }
    double area = 0;
    check_measures(cm_depth_error_sparsify(truth.value.size(), measured.value.data(),
                                           truth.value.data(), confidence.value.data(),
                                           CM_SPARSIFICATION_RMSE, curve_points, fraction.data(),
                                           error.data(), oracle.data(), &area),
                   options);
    return ", \"sparsification\": {\"fraction\": " + number_list(fraction) +
           ", \"rmse\": " + number_list(error) + ", \"oracle\": " + number_list(oracle) +
           ", \"area\": " + json_number(area) + "}";
}

struct DistanceMeasures
{
    cm_depth_error errors;
    double quantiles[3]; // of 0.5, 0.9 and 0.99
    double bad[3];       // parts beyond 1 mm, 1 cm and 10 cm
};

DistanceMeasures measure(const EvaluateOptions &options, const DistancePicture &measured,
                         const DistancePicture &truth)
{
    const double fractions[] = {0.5, 0.9, 0.99}, limits[] = {0.001, 0.01, 0.1};
    const std::size_t n = truth.value.size();
    DistanceMeasures made = {};
    made.errors.size = sizeof made.errors;
    check_measures(
        cm_depth_error_measure(n, measured.value.data(), truth.value.data(), &made.errors),
        options);
    check_measures(cm_depth_error_quantiles(n, measured.value.data(), truth.value.data(), 3,
                                            fractions, made.quantiles),
                   options);
    check_measures(
        cm_depth_error_bad(n, measured.value.data(), truth.value.data(), 3, limits, made.bad),
        options);
    return made;
}

std::string measures_json(const DistanceMeasures &of)
{
    const cm_depth_error &errors = of.errors;
    return "\"count\": " + std::to_string(errors.count) +
           ", \"missing\": " + std::to_string(errors.missing) +
           ", \"extra\": " + std::to_string(errors.extra) +
           ", \"mae\": " + json_number(errors.mae) + ", \"mse\": " + json_number(errors.mse) +
           ", \"rmse\": " + json_number(errors.rmse) + ", \"bias\": " + json_number(errors.bias) +
           ", \"deviation\": " + json_number(errors.deviation) +
           ", \"median\": " + json_number(errors.median) +
           ", \"maximum\": " + json_number(errors.maximum) +
           ", \"quantiles\": {\"0.5\": " + json_number(of.quantiles[0]) +
           ", \"0.9\": " + json_number(of.quantiles[1]) +
           ", \"0.99\": " + json_number(of.quantiles[2]) +
           "}, \"bad\": {\"1mm\": " + json_number(of.bad[0]) +
           ", \"1cm\": " + json_number(of.bad[1]) + ", \"10cm\": " + json_number(of.bad[2]) + "}";
}

std::string measures_text(const DistanceMeasures &of)
{
    const cm_depth_error &errors = of.errors;
    char text[600];
    std::snprintf(text, sizeof text,
                  "mean error %.6g m, root of the mean square %.6g m, bias %.6g m, most %.6g m\n"
                  "%.3g %% of the pixels are more than 1 mm off, %.3g %% more than 1 cm, %.3g %% "
                  "more than 10 cm\n"
                  "%zu pixels count; %zu have a distance in the truth alone, %zu in what was "
                  "measured alone\n",
                  errors.mae, errors.rmse, errors.bias, errors.maximum, 100 * of.bad[0],
                  100 * of.bad[1], 100 * of.bad[2], errors.count, errors.missing, errors.extra);
    return text;
}

} // namespace

int evaluate_tof(int argc, char **argv, const cm_streams &streams)
{
    const EvaluateOptions options = parse_evaluate_options(argc, argv, streams);
    if (options.printed)
    {
        return 0;
    }
    const DistancePicture truth = read_distances(options.truth);
    const DistancePicture measured = read_alike(options.measured, truth, options.truth);
    const DistanceMeasures made = measure(options, measured, truth);
    print(streams, options.json ? "{" + measures_json(made) +
                                      sparsification_json(options, measured, truth) + "}\n"
                                : measures_text(made));
    return 0;
}
