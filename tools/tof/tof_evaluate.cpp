// SPDX-License-Identifier: MIT
//
// cubemap-tof evaluate: measured distances against true ones, and what a confidence is worth.

#include "tof_chart.hpp"
#include "tof_command.hpp"
#include "tof_frame.hpp"
#include "tof_table.h"
#include "tools/cli/atomic_file.hpp"
#include "tools/cli/image_file.hpp"
#include "tools/cli/program.hpp"
#include "tools/cli/scene_handle.hpp"

#include <cubemap/depth_error.h>

#include <cstdio>

namespace
{

constexpr std::size_t curve_points = 20;
constexpr double edge_gap = 0.05;       // of the nearer distance, as in depth.h
constexpr std::uint32_t edge_reach = 1; // pixels

struct EvaluateOptions
{
    std::string measured;
    std::string truth;
    std::string confidence;
    std::string output; // folder of the plot
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
        else if (id == TOF_OUTPUT)
        {
            options.output = reader.text();
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
    if (!options.output.empty() && options.confidence.empty())
    {
        throw UsageFailure("-o DIR needs --confidence, whose plot is drawn there; see --help");
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

// The part of a file that has ranges: the only one, whatever its name is, the first of those without names, or that of the
// name, which the truth has.
std::uint32_t part_of_range(const std::string &path)
{
    std::uint32_t count = 1;
    for (std::uint32_t part = 0; part < count; ++part)
    {
        const ImageFile file(path, 0, part);
        const char *const name = file.stored().subimage_name;
        count = file.stored().subimage_count;
        if (count == 1 || name == nullptr || std::string(name) == "range")
        {
            return part;
        }
    }
    throw Failure(in_quotes(path) + " has " + std::to_string(count) +
                  " parts, of which none is called range");
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
struct SparsificationCurve
{
    std::vector<double> fraction, error, oracle;
    double area = 0;
};

SparsificationCurve sparsify(const EvaluateOptions &options, const DistancePicture &measured,
                             const DistancePicture &truth)
{
    const DistancePicture confidence = read_alike(options.confidence, truth, options.truth);
    SparsificationCurve made;
    for (std::size_t i = 0; i < curve_points; ++i)
    {
        made.fraction.push_back(static_cast<double>(i) / curve_points);
    }
    made.error.resize(curve_points);
    made.oracle.resize(curve_points);
    check_measures(cm_depth_error_sparsify(
                       truth.value.size(), measured.value.data(), truth.value.data(),
                       confidence.value.data(), CM_SPARSIFICATION_RMSE, curve_points,
                       made.fraction.data(), made.error.data(), made.oracle.data(), &made.area),
                   options);
    return made;
}

std::string sparsification_json(const SparsificationCurve &curve)
{
    return ", \"sparsification\": {\"fraction\": " + number_list(curve.fraction) +
           ", \"rmse\": " + number_list(curve.error) +
           ", \"oracle\": " + number_list(curve.oracle) + ", \"area\": " + json_number(curve.area) +
           "}";
}

std::string sparsification_text(const SparsificationCurve &curve)
{
    constexpr std::size_t quarter = curve_points / 4;
    const auto three = [](const std::vector<double> &errors)
    {
        return text_of_number(errors[quarter], 3) + ", " + text_of_number(errors[2 * quarter], 3) +
               " and " + text_of_number(errors[3 * quarter], 3) + " m";
    };
    return "root of the mean square without the least sure 25, 50 and 75 %: " + three(curve.error) +
           "; at best " + three(curve.oracle) + "; area between " + text_of_number(curve.area, 3) +
           "\n";
}

// The plot of Nair and others 2013, section 5.2.2.
void draw_sparsification(const EvaluateOptions &options, const SparsificationCurve &curve,
                         const cm_streams &streams)
{
    const Chart chart = {"sparsification",
                         "Error of the pixels that are left",
                         "part of the pixels removed",
                         "root of the mean square, m",
                         false,
                         {{"the least sure first", curve.fraction, curve.error},
                          {"the worst first", curve.fraction, curve.oracle}},
                         {}};
    const OutputFolder folder(options.output);
    const std::string json = folder.path_of("sparsification.json");
    const std::string text = "{\"charts\":" + charts_json({chart}) + "}\n";
    AtomicFile file(json);
    file.write(text.data(), text.size());
    file.finish();
    file.appear();
    if (!draw_charts(json, options.output))
    {
        std::fprintf(streams.err, "cubemap-tof: no plot: python3 with matplotlib is not there\n");
    }
}

struct DistanceMeasures
{
    cm_depth_error errors;
    double quantiles[3]; // of 0.5, 0.9 and 0.99
    double bad[3];       // parts beyond 1 mm, 1 cm and 10 cm
    cm_depth_edges edges;
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
    made.edges.size = sizeof made.edges;
    check_measures(cm_depth_error_edges(static_cast<std::uint32_t>(truth.width),
                                        static_cast<std::uint32_t>(truth.height),
                                        measured.value.data(), truth.value.data(), edge_gap,
                                        edge_reach, &made.edges),
                   options);
    return made;
}

std::string edges_json(const cm_depth_edges &of)
{
    return "{\"gap\": " + json_number(edge_gap) + ", \"reach\": " + std::to_string(edge_reach) +
           ", \"measured\": " + std::to_string(of.measured) +
           ", \"true\": " + std::to_string(of.true_ones) +
           ", \"precision\": " + json_number(of.precision) +
           ", \"recall\": " + json_number(of.recall) + "}";
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
           ", \"1cm\": " + json_number(of.bad[1]) + ", \"10cm\": " + json_number(of.bad[2]) +
           "}, \"edges\": " + edges_json(of.edges);
}

std::string edges_text(const cm_depth_edges &of)
{
    return std::to_string(of.measured) + " pixels are on edges, " + std::to_string(of.right) +
           " of them within a pixel of a true one; of " + std::to_string(of.true_ones) +
           " true ones " + std::to_string(of.found) + " are found\n";
}

std::string measures_text(const DistanceMeasures &of, const std::string &more)
{
    const cm_depth_error &errors = of.errors;
    char first[400], last[200];
    std::snprintf(first, sizeof first,
                  "mean error %.6g m, root of the mean square %.6g m, bias %.6g m, most %.6g m\n"
                  "%.3g %% of the pixels are more than 1 mm off, %.3g %% more than 1 cm, %.3g %% "
                  "more than 10 cm\n",
                  errors.mae, errors.rmse, errors.bias, errors.maximum, 100 * of.bad[0],
                  100 * of.bad[1], 100 * of.bad[2]);
    std::snprintf(last, sizeof last,
                  "%zu pixels count; %zu have a distance in the truth alone, %zu in what was "
                  "measured alone\n",
                  errors.count, errors.missing, errors.extra);
    return first + edges_text(of.edges) + more + last;
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
    std::string more;
    if (!options.confidence.empty())
    {
        const SparsificationCurve curve = sparsify(options, measured, truth);
        more = options.json ? sparsification_json(curve) : sparsification_text(curve);
        if (!options.output.empty())
        {
            draw_sparsification(options, curve, streams);
        }
    }
    print(streams,
          options.json ? "{" + measures_json(made) + more + "}\n" : measures_text(made, more));
    return 0;
}
