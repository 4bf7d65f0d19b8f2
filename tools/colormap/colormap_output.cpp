// SPDX-License-Identifier: MIT

#include "colormap_output.hpp"

#include "tools/cli/circle.hpp"
#include "tools/cli/image_writer.hpp"
#include "tools/cli/program.hpp"

#include <cubemap/number.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include <cubemap/version.h>

namespace
{

std::array<unsigned char, 3> to_bytes(const std::array<double, 3> &srgb)
{
    std::array<unsigned char, 3> bytes;
    std::transform(srgb.begin(), srgb.end(), bytes.begin(),
                   [](double value) { return static_cast<unsigned char>(value * 255.0 + 0.5); });
    return bytes;
}

// The colour at t, cut to sRGB.
Sample sample_at(const cm_colormap *map, double t)
{
    cm_colormap_color color;
    cm_colormap_color_at(map, t, &color);
    Sample sample = {t, {}, {}, {}, color.inside != 0};
    for (std::size_t i = 0; i < 3; ++i)
    {
        sample.lch[i] = color.lch[i];
        sample.srgb[i] = std::clamp(color.srgb[i], 0.0, 1.0);
    }
    sample.bytes = to_bytes(sample.srgb);
    return sample;
}

std::string hex_text(const Sample &sample)
{
    char text[8];
    std::snprintf(text, sizeof text, "#%02x%02x%02x", sample.bytes[0], sample.bytes[1],
                  sample.bytes[2]);
    return text;
}

std::string triple_text(const std::array<double, 3> &values, const char *separator)
{
    return number_text(values[0]) + separator + number_text(values[1]) + separator +
           number_text(values[2]);
}

const char *family_name(cm_colormap_family family)
{
    switch (family)
    {
    case CM_COLORMAP_SEQUENTIAL:
        return "sequential";
    case CM_COLORMAP_DIVERGING:
        return "diverging";
    case CM_COLORMAP_QUALITATIVE:
        return "qualitative";
    case CM_COLORMAP_CYCLIC:
        return "cyclic";
    }
    return "unknown";
}

// ---- the steps between neighbouring samples, measured from the sRGB that is written

struct Steps
{
    double mean;               // in the map's space
    double deviation;          // the largest from the mean, as a part of it
    double deviation_at;       // t where that step begins
    double without_corners;    // the same of steps across which the path has no corner
    double deviation_of_bytes; // the same of colours that are rounded to 8 bits
    double uneven_in_cieluv;   // the standard deviation of all steps, as a part of their mean
    double uneven_in_ucs;
    double uneven_by_ciede2000;
};

using Triple = std::array<double, 3>;
using Distance = double (*)(const Triple &one, const Triple &other);

template <void from_linear(const double linear[3], double point[3])>
Triple point_of(const Triple &srgb)
{
    Triple linear;
    Triple point;
    cm_colormap_linear_from_srgb(srgb.data(), linear.data());
    from_linear(linear.data(), point.data());
    return point;
}

template <void from_linear(const double linear[3], double point[3])>
double distance(const Triple &one, const Triple &other)
{
    const Triple a = point_of<from_linear>(one);
    const Triple b = point_of<from_linear>(other);
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

double ciede2000(const Triple &one, const Triple &other)
{
    return cm_colormap_ciede2000(point_of<cm_colormap_lab_from_linear>(one).data(),
                                 point_of<cm_colormap_lab_from_linear>(other).data());
}

const char *space_name(cm_colormap_space space)
{
    return space == CM_COLORMAP_CIELUV ? "CIELUV" : "CAM16-UCS";
}

Distance distance_in(cm_colormap_space space)
{
    return space == CM_COLORMAP_CIELUV ? distance<cm_colormap_luv_from_linear>
                                       : distance<cm_colormap_ucs_from_linear>;
}

std::array<double, 3> from_bytes(const std::array<unsigned char, 3> &bytes)
{
    return {bytes[0] / 255.0, bytes[1] / 255.0, bytes[2] / 255.0};
}

bool crosses_corner(const cm_colormap *map, double from, double to)
{
    for (std::size_t i = 0; i < cm_colormap_corner_count(map); ++i)
    {
        const double corner = cm_colormap_corner(map, i);
        if (corner > std::min(from, to) && corner < std::max(from, to))
        {
            return true;
        }
    }
    return false;
}

// The mean, and how far the furthest is from it, as a part of it; zeros where there is nothing to divide by.
struct Spread
{
    double mean = 0;
    double deviation = 0;
    std::size_t furthest = 0;
};

Spread spread_of(const std::vector<double> &steps)
{
    Spread spread;
    for (const double step : steps)
    {
        spread.mean += step / static_cast<double>(steps.size());
    }
    for (std::size_t i = 0; i < steps.size() && spread.mean > 0; ++i)
    {
        const double deviation = std::fabs(steps[i] / spread.mean - 1.0);
        if (deviation > spread.deviation)
        {
            spread.deviation = deviation;
            spread.furthest = i;
        }
    }
    return spread;
}

std::vector<double> steps_by(Distance between, const std::vector<Sample> &samples)
{
    std::vector<double> steps;
    for (std::size_t i = 0; i + 1 < samples.size(); ++i)
    {
        steps.push_back(between(samples[i].srgb, samples[i + 1].srgb));
    }
    return steps;
}

double unevenness(const std::vector<double> &steps)
{
    const double mean = spread_of(steps).mean;
    double sum = 0;
    for (const double step : steps)
    {
        sum += (step - mean) * (step - mean) / static_cast<double>(steps.size());
    }
    return mean > 0 ? std::sqrt(sum) / mean : 0.0;
}

Steps measure_steps(const SampledMap &sampled)
{
    const std::vector<Sample> &samples = sampled.samples;
    const Distance between = distance_in(cm_colormap_describe(sampled.map)->space);
    const std::vector<double> all = steps_by(between, samples);
    std::vector<double> straight;
    std::vector<double> of_bytes;
    for (std::size_t i = 0; i + 1 < samples.size(); ++i)
    {
        of_bytes.push_back(between(from_bytes(samples[i].bytes), from_bytes(samples[i + 1].bytes)));
        if (!crosses_corner(sampled.map, samples[i].t, samples[i + 1].t))
        {
            straight.push_back(all[i]);
        }
    }
    const Spread spread = spread_of(all);
    return {spread.mean,
            spread.deviation,
            samples[spread.furthest].t,
            spread_of(straight).deviation,
            spread_of(of_bytes).deviation,
            unevenness(steps_by(distance<cm_colormap_luv_from_linear>, samples)),
            unevenness(steps_by(distance<cm_colormap_ucs_from_linear>, samples)),
            unevenness(steps_by(ciede2000, samples))};
}

// ---- where the samples are

// The places between two samples whose places are known. Between two corners they are equally far apart, which
// saves the library's planning of all places for each of them.
void fill_places(const cm_colormap *map, std::vector<double> &places, std::size_t first,
                 std::size_t last)
{
    if (last - first < 2)
    {
        return;
    }
    if (!crosses_corner(map, places[first], places[last]))
    {
        const double step = (places[last] - places[first]) / static_cast<double>(last - first);
        for (std::size_t i = first + 1; i < last; ++i)
        {
            places[i] = places[first] + static_cast<double>(i - first) * step;
        }
        return;
    }
    const std::size_t middle = first + (last - first) / 2;
    places[middle] = cm_colormap_position(map, places.size(), middle);
    fill_places(map, places, first, middle);
    fill_places(map, places, middle, last);
}

std::vector<double> places_of_samples(const cm_colormap *map, std::size_t count)
{
    std::vector<double> places(count);
    places.front() = cm_colormap_position(map, count, 0);
    places.back() = cm_colormap_position(map, count, count - 1);
    fill_places(map, places, 0, count - 1);
    return places;
}

// ---- JSON

std::string json_string(const std::string &text)
{
    return "\"" + text + "\""; // the texts here have no quote, no backslash, no control character
}

std::string json_parameters(const cm_colormap *map)
{
    const cm_colormap_info *const info = cm_colormap_describe(map);
    std::string text;
    for (std::size_t i = 0; i < info->parameter_count; ++i)
    {
        text += (i == 0 ? "" : ", ") + json_string(info->parameter[i].name) + ": ";
        if (info->parameter[i].stops == nullptr)
        {
            text += number_text(cm_colormap_parameter(map, i), CM_NUMBER_DIGITS);
            continue;
        }
        for (std::size_t k = 0; k < cm_colormap_stop_count(map); ++k)
        {
            double stop[2];
            cm_colormap_stop(map, k, stop);
            text += std::string(k == 0 ? "[" : ", ") + "{\"place\": " + number_text(stop[0], 17) +
                    ", \"hue\": " + number_text(stop[1], 17) + "}";
        }
        text += "]";
    }
    return "{" + text + "}";
}

std::string json_corners(const cm_colormap *map)
{
    std::string text;
    for (std::size_t i = 0; i < cm_colormap_corner_count(map); ++i)
    {
        text += (i == 0 ? "" : ", ") + number_text(cm_colormap_corner(map, i));
    }
    return "[" + text + "]";
}

std::string json_clipping(const SampledMap &sampled)
{
    const cm_colormap_clipping &clipping = sampled.clipping;
    const bool none = clipping.count == 0;
    return "{\"count\": " + std::to_string(clipping.count) +
           ", \"first\": " + (none ? "null" : std::to_string(clipping.first)) +
           ", \"first_t\": " + (none ? "null" : number_text(clipping.first_t)) +
           ", \"excess\": " + number_text(clipping.excess) + "}";
}

std::string json_steps(const SampledMap &sampled)
{
    if (sampled.samples.size() < 2)
    {
        return "null";
    }
    const Steps steps = measure_steps(sampled);
    const auto percent = [](double value) { return number_text(value * 100.0, 4); };
    return "{\"mean\": " + number_text(steps.mean) +
           ",\n           \"max_deviation_percent\": " + percent(steps.deviation) +
           ", \"max_deviation_t\": " + number_text(steps.deviation_at) +
           ",\n           \"max_deviation_without_corners_percent\": " +
           percent(steps.without_corners) +
           ",\n           \"max_deviation_8_bit_percent\": " + percent(steps.deviation_of_bytes) +
           ",\n           \"unevenness_percent\": {\"CIELUV\": " + percent(steps.uneven_in_cieluv) +
           ", \"CAM16-UCS\": " + percent(steps.uneven_in_ucs) +
           ", \"CIEDE2000\": " + percent(steps.uneven_by_ciede2000) + "}}";
}

std::string json_sample(const Sample &sample)
{
    return "    {\"t\": " + number_text(sample.t) + ", \"srgb\": [" +
           triple_text(sample.srgb, ", ") + "], \"hex\": " + json_string(hex_text(sample)) +
           ", \"lch\": [" + triple_text(sample.lch, ", ") +
           "], \"inside\": " + (sample.inside ? "true" : "false") + "}";
}

std::string json_finite(double value)
{
    return std::isfinite(value) ? number_text(value) : "null";
}

// ---- pictures

// P. Kovesi, Good Colour Maps: How to Design Them, arXiv:1509.03700, 2015, section 3: over a ramp from left
// to right a sine wave whose amplitude falls with the square of the height to nothing at the bottom. The
// ramp is shortened by the amplitude, so that the wave stays in [0, 1].
double test_pattern_at(double x, double y, int width)
{
    constexpr double amplitude = 0.05;
    constexpr double wave_length = 8.0; // pixels
    const double waves = std::max(1.0, std::round(width / wave_length));
    const double height = 1.0 - y;
    const double swing = amplitude * height * height;
    return swing + (1.0 - 2.0 * swing) * x + swing * std::sin(2.0 * pi * waves * x);
}

void put_bytes(const Sample &sample, float *pixel)
{
    std::transform(sample.bytes.begin(), sample.bytes.end(), pixel,
                   [](unsigned char byte) { return static_cast<float>(byte) / 255.0f; });
}

void fill_row(const SampledMap &sampled, PictureSize size, bool test_pattern, int row,
              std::vector<float> &pixels)
{
    const double y = size.height == 1 ? 0.0 : static_cast<double>(row) / (size.height - 1);
    for (int column = 0; column < size.width; ++column)
    {
        float *const pixel = &pixels[3 * static_cast<std::size_t>(column)];
        if (test_pattern)
        {
            const double x = size.width == 1 ? 0.0 : static_cast<double>(column) / (size.width - 1);
            const double t = test_pattern_at(x, y, size.width);
            put_bytes(sample_at(sampled.map, sampled.reversed ? 1.0 - t : t), pixel);
        }
        else
        {
            const std::size_t band = static_cast<std::size_t>(column) * sampled.samples.size() /
                                     static_cast<std::size_t>(size.width);
            put_bytes(sampled.samples[band], pixel);
        }
    }
}

// ---- the listing

std::string range_text(const cm_colormap_parameter_info &parameter)
{
    const std::string unit = *parameter.unit == '\0' ? "" : std::string(" ") + parameter.unit;
    const std::string range = std::string(parameter.low_excluded != 0 ? "(" : "[") +
                              number_text(parameter.low) + ", " + number_text(parameter.high) +
                              "]" + unit;
    return (parameter.stops != nullptr ? "hues in " : "in ") + range + ", default " +
           (parameter.stops != nullptr ? parameter.stops : number_text(parameter.standard));
}

} // namespace

std::string number_text(double value, int digits)
{
    char text[CM_NUMBER_SIZE];
    const std::size_t length = digits == CM_NUMBER_DIGITS ? cm_number_write_shortest(value, text)
                                                          : cm_number_write(value, digits, text);
    return std::string(text, length);
}

std::string specification_of(const cm_colormap *map)
{
    std::string text(cm_colormap_specification(map, nullptr, 0) + 1, '\0');
    cm_colormap_specification(map, text.data(), text.size());
    text.pop_back();
    return text;
}

SampledMap sample_map(const cm_colormap *map, const std::string &name, std::size_t count,
                      bool reversed)
{
    SampledMap sampled = {map, name, reversed, {}, {}};
    std::vector<double> srgb(3 * count);
    cm_colormap_samples(map, count, srgb.data(), &sampled.clipping);
    sampled.samples.reserve(count);
    for (const double t : places_of_samples(map, count))
    {
        sampled.samples.push_back(sample_at(map, t));
    }
    if (reversed)
    {
        std::reverse(sampled.samples.begin(), sampled.samples.end());
    }
    return sampled;
}

std::string json_text(const SampledMap &sampled)
{
    const cm_colormap_info *const info = cm_colormap_describe(sampled.map);
    std::string text = "{\n  \"version\": " + json_string(cm_version());
    const auto add = [&text](const char *name, const std::string &value)
    { text += ",\n  " + json_string(name) + ": " + value; };
    add("specification", json_string(specification_of(sampled.map)));
    add("model", json_string(info->identifier));
    add("family", json_string(family_name(info->family)));
    add("meaning", json_string(info->name));
    add("source", json_string(info->source));
    add("parameters", json_parameters(sampled.map));
    add("reversed", sampled.reversed ? "true" : "false");
    add("space", json_string(space_name(info->space)));
    add("length", number_text(cm_colormap_length(sampled.map)));
    add("corners", json_corners(sampled.map));
    add("inside", cm_colormap_inside(sampled.map) != 0 ? "true" : "false");
    add("largest_saturation", json_finite(cm_colormap_largest_saturation(sampled.map)));
    add("clipped", json_clipping(sampled));
    add("step", json_steps(sampled));
    text += ",\n  \"samples\": [";
    for (const Sample &sample : sampled.samples)
    {
        text += (&sample == sampled.samples.data() ? "\n" : ",\n") + json_sample(sample);
    }
    return text + "\n  ]\n}\n";
}

std::string csv_text(const SampledMap &sampled)
{
    std::string text = "t,red,green,blue,hex,lightness,chroma,hue,inside\n";
    for (const Sample &sample : sampled.samples)
    {
        text += number_text(sample.t) + "," + triple_text(sample.srgb, ",") + "," +
                hex_text(sample) + "," + triple_text(sample.lch, ",") + "," +
                (sample.inside ? "1" : "0") + "\n";
    }
    return text;
}

std::string matplotlib_text(const SampledMap &sampled)
{
    std::string text = "# Made by cubemap-colormap " + std::string(cm_version()) + " from\n# " +
                       specification_of(sampled.map) + (sampled.reversed ? ", reversed" : "") +
                       "\n#\n# Importing this file registers the map, and its reverse with _r "
                       "behind the name.\n\nimport matplotlib\n"
                       "from matplotlib.colors import ListedColormap\n\nNAME = \"" +
                       sampled.name + "\"\nCOLORS = [\n";
    for (const Sample &sample : sampled.samples)
    {
        text += "    (" + triple_text(sample.srgb, ", ") + "),\n";
    }
    return text + "]\n\ncolormap = ListedColormap(COLORS, name=NAME)\n\n"
                  "for each in (colormap, colormap.reversed()):\n"
                  "    try:\n"
                  "        matplotlib.colormaps.register(each, force=True)\n"
                  "    except AttributeError:  # before matplotlib 3.5\n"
                  "        from matplotlib import cm\n"
                  "        cm.register_cmap(cmap=each)\n";
}

std::string gimp_text(const SampledMap &sampled)
{
    std::string text = "GIMP Palette\nName: " + sampled.name + "\nColumns: 0\n# " +
                       specification_of(sampled.map) + "\n";
    for (const Sample &sample : sampled.samples)
    {
        char line[32];
        std::snprintf(line, sizeof line, "%3d %3d %3d\t", sample.bytes[0], sample.bytes[1],
                      sample.bytes[2]);
        text += line + hex_text(sample) + "\n";
    }
    return text;
}

std::string listing_text()
{
    std::string text = "Colour maps, as NAME or NAME:PARAMETER=VALUE[,...]\n";
    for (std::size_t i = 0; i < cm_colormap_count(); ++i)
    {
        const cm_colormap_info *const info = cm_colormap_at(i);
        char line[200];
        std::snprintf(line, sizeof line, "\n%-22s %-12s %s\n", info->identifier,
                      family_name(info->family), info->name);
        text += line;
        if (*info->aliases != '\0')
        {
            text += "    also       " + std::string(info->aliases) + "\n";
        }
        for (std::size_t k = 0; k < info->parameter_count; ++k)
        {
            const cm_colormap_parameter_info &parameter = info->parameter[k];
            text += "    parameter  " + std::string(parameter.name) + ", " + range_text(parameter) +
                    ": " + parameter.meaning + "\n";
        }
        text += "    source     " + std::string(info->source) + "\n";
    }
    return text;
}

void write_picture(const SampledMap &sampled, PictureSize size, bool test_pattern,
                   const std::string &path)
{
    ImageDescription description(3, CM_PIXEL_U8);
    description.color = CM_IMAGE_COLOR_SRGB;
    description.set("ImageDescription", specification_of(sampled.map));
    std::vector<std::unique_ptr<AtomicFile>> files;
    files.push_back(std::make_unique<AtomicFile>(path));
    const ImagePlan plan = plan_image("png", description, "png", path);
    ImageWriter writer(plan, size.width, size.height, path, *files.back());
    std::vector<float> pixels(3 * static_cast<std::size_t>(size.width));
    for (int row = 0; row < size.height; ++row)
    {
        if (row == 0 || test_pattern)
        {
            fill_row(sampled, size, test_pattern, row, pixels);
        }
        writer.write(row, row + 1, pixels.data(), 3);
    }
    writer.close();
    appear_together(files);
}
