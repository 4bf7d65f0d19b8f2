// SPDX-License-Identifier: MIT
//
// cubemap-orient: the best orientation of the base cube for a mask.

#include "orient_main.h"
#include "orient_options.hpp"
#include "orient_picture.hpp"
#include "tools/image/face_image.hpp"
#include "tools/cli/parallel.hpp"
#include "tools/cli/program.hpp"
#include "tools/cli/progress.hpp"

#include <cmath>
#include <cstdio>

namespace
{

constexpr double degrees_a_radian = 57.29577951308232;
constexpr double earth_km = 6371.0072;
constexpr int progress_steps = 1000;

// How much each pixel counts.
void weigh(const OrientOptions &options, WholeImage &mask)
{
    for (float &value : mask.pixels)
    {
        value = options.invert ? 1.0f - value : value;
        if (options.threshold)
        {
            value = static_cast<double>(value) >= *options.threshold ? 1.0f : 0.0f;
        }
        if (value < 0.0f)
        {
            throw Failure(in_quotes(options.mask) + " has values below 0" +
                          (options.invert ? ", inverted" : "") + ", which cannot count");
        }
    }
}

struct Bar
{
    Progress progress;
    int steps = 0;
};

int advance(double done, void *user)
{
    Bar &bar = *static_cast<Bar *>(user);
    const int steps = static_cast<int>(done * progress_steps);
    bar.progress.advance(steps - bar.steps);
    bar.steps = steps;
    return 0;
}

void check(cm_status status, const OrientOptions &options)
{
    if (status == CM_ERROR_ARGUMENT)
    {
        throw Failure(in_quotes(options.mask) + " has no pixel that counts, or too many");
    }
    if (status != CM_OK)
    {
        throw Failure(cm_status_text(status));
    }
}

// What a unit of the measure is in what is printed, and its name.
double unit_of(cm_orient_measure measure)
{
    return measure == CM_ORIENT_DEFORMATION ? degrees_a_radian
           : measure == CM_ORIENT_EDGES     ? earth_km
                                            : 1.0;
}

const char *unit_name(cm_orient_measure measure)
{
    return measure == CM_ORIENT_DEFORMATION ? " degrees" : measure == CM_ORIENT_EDGES ? " km" : "";
}

const char *words_for(cm_orient_measure measure)
{
    static const char *const words[] = {"mean angular deformation", "mean isotropy D_I",
                                        "mean |ln D_A|", "mean areal scale s",
                                        "edges over the mask"};
    return words[measure];
}

std::string formatted(const char *format, double a, double b = 0, double c = 0)
{
    char text[200];
    std::snprintf(text, sizeof text, format, a, b, c);
    return text;
}

// Edges change by kilometres in a hundredth of a degree.
int digits_of(cm_orient_measure measure)
{
    return measure == CM_ORIENT_EDGES ? 4 : 2;
}

std::string angle_text(cm_orient_measure measure, double angle)
{
    const int digits = digits_of(measure);
    const double unit = std::pow(10.0, digits);
    char word[40];
    // -0.00 is 0.00
    std::snprintf(word, sizeof word, "%.*f", digits, std::round(angle * unit) / unit + 0.0);
    return word;
}

std::string angles_text(cm_orient_measure measure, double lon, double lat, double roll)
{
    return angle_text(measure, lon) + " " + angle_text(measure, lat) + " " +
           angle_text(measure, roll);
}

std::string angles_text(cm_orient_measure measure, const cm_rotation &rotation)
{
    double lon = 0;
    double lat = 0;
    double roll = 0;
    cm_rotation_angles(&rotation, &lon, &lat, &roll);
    return angles_text(measure, lon, lat, roll);
}

// What was looked at, and the second-best valley.
std::string survey_text(const OrientOptions &options, const cm_orient_result &found)
{
    const double unit = unit_of(options.measure);
    const std::string name = unit_name(options.measure);
    if (found.nodes == 0)
    {
        return "";
    }
    std::string text =
        formatted("looked at %.0f rotations, one each %.3g degrees; ",
                  static_cast<double>(found.nodes), found.spacing) +
        formatted("followed all %.0f local minima to %.0f valleys, "
                  "%.0f of them by all pixels\n",
                  static_cast<double>(found.minima), static_cast<double>(found.valleys),
                  static_cast<double>(found.followed));
    if (found.other_apart > 0)
    {
        text += "next best valley: " + angles_text(options.measure, found.other.rotation) +
                formatted(" with %.6g", found.other.value * unit) + name +
                formatted(", %.3g degrees away\n", found.other_apart);
    }
    else
    {
        text += "no other valley\n";
    }
    return text;
}

std::string report(const OrientOptions &options, const cm_orient_result &found)
{
    const double unit = unit_of(options.measure);
    const std::string name = unit_name(options.measure);
    std::string text = angles_text(options.measure, found.lon, found.lat, found.roll) + "\n";
    text += std::string(words_for(options.measure)) + ": " +
            formatted("%.6g", found.before * unit) + " -> " +
            formatted("%.6g", found.after * unit) + name + "\n";
    if (found.after < found.before)
    {
        text += formatted("no rotation is better by more than %.3g", found.gap * unit) + name;
        text +=
            found.radius < 180
                ? formatted("; none is better that is farther than %.3g degrees\n", found.radius)
                : "\n";
    }
    else
    {
        text += "no rotation is better\n";
    }
    return text + survey_text(options, found);
}

std::string survey_json(const OrientOptions &options, const cm_orient_result &found)
{
    const double unit = unit_of(options.measure);
    std::string text = formatted("\"nodes\": %.0f, \"spacing\": %.6g, \"minima\": %.0f, ",
                                 static_cast<double>(found.nodes), found.spacing,
                                 static_cast<double>(found.minima));
    text += formatted("\"valleys\": %.0f, \"followed\": %.0f, ", static_cast<double>(found.valleys),
                      static_cast<double>(found.followed));
    text += formatted("\"margin\": %.6g, \"error\": %.6g, \"drop\": %.6g, ", found.margin * unit,
                      found.error * unit, found.drop * unit);
    double lon = 0;
    double lat = 0;
    double roll = 0;
    cm_rotation_angles(&found.other.rotation, &lon, &lat, &roll);
    return text + (found.other_apart > 0
                       ? formatted("\"other\": [%.6f, %.6f, %.6f, ", lon, lat, roll) +
                             formatted("%.9g], \"other_apart\": %.6g, ", found.other.value * unit,
                                       found.other_apart)
                       : "\"other\": null, ");
}

std::string json_report(const OrientOptions &options, const cm_orient_result &found)
{
    const double unit = unit_of(options.measure);
    std::string text = "{\"mapping\": \"" + options.mapping + "\", \"measure\": \"" +
                       cm_orient_measure_name(options.measure) + "\", \"over\": \"" +
                       (options.over == CM_OVER_FACE ? "face" : "sphere") + "\", ";
    text += formatted("\"lon\": %.6f, \"lat\": %.6f, \"roll\": %.6f, ", found.lon, found.lat,
                      found.roll);
    text += formatted("\"before\": %.9g, \"after\": %.9g, \"gap\": %.9g, ", found.before * unit,
                      found.after * unit, found.gap * unit);
    text += formatted("\"radius\": %.6g, \"symmetries\": %.0f, \"rotations\": %.0f, ", found.radius,
                      found.symmetries, static_cast<double>(found.boxes));
    text += survey_json(options, found) + "\"best\": [";
    for (std::size_t i = 0; i < found.rival_count; ++i)
    {
        double lon = 0;
        double lat = 0;
        double roll = 0;
        cm_rotation_angles(&found.rival[i].rotation, &lon, &lat, &roll);
        text += (i == 0 ? "" : ", ") + formatted("[%.6f, %.6f, %.6f, ", lon, lat, roll) +
                formatted("%.9g]", found.rival[i].value * unit);
    }
    return text + "]}\n";
}

// A line each: name, mapping, measure, lon, lat, roll, before, after.
std::string list_text()
{
    std::string text;
    for (std::size_t i = 0; i < cm_orientation_count(); ++i)
    {
        const cm_orientation *const named = cm_orientation_at(i);
        const auto measure = static_cast<cm_orient_measure>(cm_orient_measure_find(named->measure));
        const double unit = unit_of(measure);
        text += std::string(named->identifier) + " " + named->mapping + " " + named->measure + " ";
        text += angles_text(measure, named->lon, named->lat, named->roll) +
                formatted(" %.8g %.8g\n", named->before * unit, named->after * unit);
    }
    return text;
}

std::string evaluate(const OrientOptions &options, const cm_mapping *mapping, const cm_mask &mask,
                     const cm_orient_options &wanted, cm_rotation *rotation)
{
    double value = 0;
    check(cm_rotation_parse(options.evaluate->c_str(), rotation, nullptr, 0), options);
    check(cm_orient_value(mapping, &mask, &wanted, rotation, &value), options);
    const std::string number = formatted("%.9g", value * unit_of(options.measure));
    return options.json ? "{\"value\": " + number + "}\n"
                        : std::string(words_for(options.measure)) + ": " + number +
                              unit_name(options.measure) + "\n";
}

// The title of the cube in a picture: how it stands, and the measure there.
std::vector<std::string> title_of(const OrientOptions &options, const cm_mapping *mapping,
                                  const cm_mask &mask, const cm_orient_options &wanted,
                                  const cm_rotation &rotation, const std::string &name)
{
    double value = 0;
    double lon = 0;
    double lat = 0;
    double roll = 0;
    cm_rotation_angles(&rotation, &lon, &lat, &roll);
    check(cm_orient_value(mapping, &mask, &wanted, &rotation, &value), options);
    return {options.mapping.substr(0, options.mapping.find(':')) + ", " + name,
            "front at " + angle_text(options.measure, lon) + " " + angle_text(options.measure, lat),
            "roll " + angle_text(options.measure, roll) + " degrees", words_for(options.measure),
            formatted("%.5g", value * unit_of(options.measure)) + unit_name(options.measure)};
}

cm_orient_result search(const OrientOptions &options, const cm_mapping *mapping,
                        const cm_mask &mask, cm_orient_options wanted, std::FILE *terminal)
{
    cm_orient_result found{};
    found.size = sizeof found;
    Bar bar{Progress(progress_steps, !options.quiet, terminal)};
    wanted.progress = advance;
    wanted.user = &bar;
    check(cm_orient(mapping, &mask, &wanted, &found), options);
    return found;
}

int orient(int argc, char **argv, const cm_streams &streams)
{
    const OrientOptions options = parse_orient_options(argc, argv, streams);
    if (options.printed)
    {
        return 0;
    }
    if (options.list)
    {
        print(streams, list_text());
        return 0;
    }
    const int threads = thread_count(options.threads);
    WholeImage image = read_equirect(options.mask, true);
    weigh(options, image);
    const cm_mask mask = {sizeof mask, static_cast<std::size_t>(image.width),
                          static_cast<std::size_t>(image.height), image.pixels.data()};
    const MappingPointer mapping = make_mapping(options.mapping, *cm_frame_find("geo"));
    std::unique_ptr<OrientPicture> picture;
    if (!options.picture.empty())
    {
        picture = std::make_unique<OrientPicture>(options, image);
    }
    cm_orient_options wanted{};
    wanted.size = sizeof wanted;
    wanted.measure = options.measure;
    wanted.over = options.over;
    wanted.resolution = options.resolution;
    wanted.boxes_max = static_cast<std::size_t>(options.boxes);
    wanted.threads = static_cast<unsigned>(threads);
    cm_rotation rotation{};
    std::string text;
    if (options.evaluate)
    {
        text = evaluate(options, mapping.get(), mask, wanted, &rotation);
    }
    else
    {
        const cm_orient_result found = search(options, mapping.get(), mask, wanted, streams.err);
        rotation = found.rotation;
        text = options.json ? json_report(options, found) : report(options, found);
    }
    if (picture)
    {
        const cm_rotation before = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
        picture->write(rotation,
                       {title_of(options, mapping.get(), mask, wanted, before, "as it is"),
                        title_of(options, mapping.get(), mask, wanted, rotation, "turned")},
                       threads);
    }
    print(streams, text);
    return 0;
}

} // namespace

int cm_orient_main(int argc, char **argv, const cm_streams *streams)
{
    return run_program("cubemap-orient", *streams,
                       [argc, argv, streams] { return orient(argc, argv, *streams); });
}
