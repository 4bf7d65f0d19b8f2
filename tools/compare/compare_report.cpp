// SPDX-License-Identifier: MIT

#include "compare_report.hpp"
#include "tools/cli/program.hpp"

#include <cubemap/colormap.h>
#include <cubemap/number.h>

#include <cmath>
#include <cstdio>
#include <memory>

namespace
{

// What errors are multiplied by for people.
double unit_of(const Pictures &pictures)
{
    return pictures.integers ? 255 : 1;
}

// ---- words

template <typename... Values> std::string formatted(const char *format, Values... values)
{
    char text[300];
    std::snprintf(text, sizeof text, format, values...);
    return text;
}

// The largest error as it is printed. Between whole numbers it is one, but for what floats have rounded of both.
double scaled_largest(const Pictures &pictures, const cm_error_figures &errors)
{
    constexpr double words = 65535;
    const double whole = std::round(errors.largest * words);
    const bool is_whole = pictures.integers && std::fabs(errors.largest * words - whole) < 0.01;
    return is_whole ? whole * unit_of(pictures) / words : unit_of(pictures) * errors.largest;
}

std::string largest_text(const Pictures &pictures, const cm_error_figures &errors)
{
    const std::string place = " at x = " + std::to_string(errors.largest_column) +
                              ", y = " + std::to_string(errors.largest_row) + ", channel " +
                              pictures.channel_names[errors.largest_channel];
    return errors.largest > 0 ? place : "";
}

std::string errors_text(const CompareOptions &options, const Pictures &pictures,
                        const cm_error_figures &errors)
{
    const char *const unit = pictures.integers ? " grey levels of 8 bits" : "";
    const double scale = unit_of(pictures);
    std::string text;
    if (options.measure[MEASURE_MEAN])
    {
        text += formatted("mean absolute error  %.6g%s\n", scale * errors.mean_absolute, unit);
    }
    if (options.measure[MEASURE_RMSE])
    {
        text += formatted("RMSE                 %.6g%s\n", scale * errors.rmse, unit);
    }
    if (options.measure[MEASURE_MAX])
    {
        text += formatted("maximum              %.6g%s", scaled_largest(pictures, errors), unit) +
                largest_text(pictures, errors) + "\n";
    }
    if (options.measure[MEASURE_BIAS])
    {
        text += formatted("mean error           %.6g%s\n", scale * errors.mean_signed, unit);
    }
    if (options.measure[MEASURE_MSE])
    {
        text += formatted("mean square error    %.6g%s\n", scale * scale * errors.mse,
                          pictures.integers ? " squared grey levels of 8 bits" : "");
    }
    if (options.measure[MEASURE_PSNR])
    {
        text += formatted("PSNR                 %.4g dB\n", errors.psnr);
    }
    return text;
}

std::string flip_text(const char *name, const std::optional<cm_map_figures> &found)
{
    return found ? formatted("%-21s%.6g, the most %.6g at x = %u, y = %u\n", name, found->mean,
                             found->highest, found->highest_column, found->highest_row)
                 : "";
}

std::string words(const CompareOptions &options, const Pictures &pictures, const Measured &measured)
{
    std::string text = errors_text(options, pictures, measured.errors);
    if (measured.by_area)
    {
        text += formatted("WS-PSNR              %.4g dB\n", measured.by_area->psnr);
    }
    if (measured.at_points)
    {
        text += formatted("S-PSNR               %.4g dB\n", measured.at_points->psnr);
    }
    if (measured.ssim)
    {
        text += formatted("SSIM                 %.6g, the least %.6g at x = %u, y = %u\n",
                          measured.ssim->mean, measured.ssim->lowest, measured.ssim->lowest_column,
                          measured.ssim->lowest_row);
    }
    text += flip_text("FLIP", measured.flip) + flip_text("HDR-FLIP", measured.hdr_flip);
    if (measured.hdr_flip)
    {
        text += formatted("exposures            %u, from 2^%.4g to 2^%.4g\n",
                          measured.hdr_flip->exposure_count, measured.hdr_flip->exposure_start,
                          measured.hdr_flip->exposure_stop);
    }
    if (options.skip_not_finite)
    {
        text += "left out             " + std::to_string(measured.errors.not_finite) +
                " pixels that are not finite\n";
    }
    return text;
}

// ---- JSON

std::string json_text(const std::string &text)
{
    std::string quoted = "\"";
    for (const char letter : text)
    {
        const auto code = static_cast<unsigned char>(letter);
        if (letter == '"' || letter == '\\')
        {
            quoted += '\\';
        }
        quoted += code < 32 ? formatted("\\u%04x", code) : std::string(1, letter);
    }
    return quoted + "\"";
}

std::string json_number(const char *name, double value)
{
    char text[CM_NUMBER_SIZE];
    cm_number_write_shortest(value, text);
    return ", \"" + std::string(name) + "\": " + (std::isfinite(value) ? text : "null");
}

std::string json_map(const std::string &name, const std::optional<cm_map_figures> &found)
{
    if (!found)
    {
        return "";
    }
    const bool low = name == "ssim"; // the worst is the least
    std::string text = ", \"" + name + "\": {" + json_number("mean", found->mean).substr(2);
    text += json_number("worst", low ? found->lowest : found->highest);
    text += json_number("x", low ? found->lowest_column : found->highest_column);
    text += json_number("y", low ? found->lowest_row : found->highest_row);
    text += json_number("pixels", static_cast<double>(found->pixels));
    if (found->exposure_count > 0)
    {
        text += json_number("exposures", found->exposure_count) +
                json_number("first_exposure", found->exposure_start) +
                json_number("last_exposure", found->exposure_stop);
    }
    return text + "}";
}

std::string json_errors(const CompareOptions &options, const Pictures &pictures,
                        const cm_error_figures &errors)
{
    const double scale = unit_of(pictures);
    const std::pair<int, double> numbers[] = {{MEASURE_MEAN, scale * errors.mean_absolute},
                                              {MEASURE_RMSE, scale * errors.rmse},
                                              {MEASURE_BIAS, scale * errors.mean_signed},
                                              {MEASURE_MSE, scale * scale * errors.mse},
                                              {MEASURE_PSNR, errors.psnr}};
    std::string text;
    for (const auto &[which, value] : numbers)
    {
        const auto index = static_cast<std::size_t>(which);
        text += options.measure[index] ? json_number(cm_compare_measure_name(index), value) : "";
    }
    if (options.measure[MEASURE_MAX])
    {
        text += ", \"max\": {" + json_number("value", scaled_largest(pictures, errors)).substr(2) +
                json_number("x", errors.largest_column) +
                json_number("y", static_cast<double>(errors.largest_row)) +
                ", \"channel\": " + json_text(pictures.channel_names[errors.largest_channel]) + "}";
    }
    return text;
}

std::string json(const CompareOptions &options, const Pictures &pictures, const Measured &measured)
{
    std::string text = "{\"reference\": " + json_text(pictures.reference_name) +
                       ", \"picture\": " + json_text(pictures.picture_name);
    text += json_number("width", pictures.width) + json_number("height", pictures.height) +
            json_number("channels", pictures.channels);
    text += json_number("unit", unit_of(pictures)) + // what errors of 1 have become
            json_number("peak", unit_of(pictures) * measured.errors.peak) +
            json_number("pixels", static_cast<double>(measured.errors.pixels)) +
            json_number("not_finite", static_cast<double>(measured.errors.not_finite));
    text += json_errors(options, pictures, measured.errors);
    text += measured.by_area ? json_number("ws-psnr", measured.by_area->psnr) : "";
    text += measured.at_points ? json_number("s-psnr", measured.at_points->psnr) : "";
    text += json_map("ssim", measured.ssim) + json_map("flip", measured.flip) +
            json_map("hdr-flip", measured.hdr_flip);
    return text + "}\n";
}

// ---- limits and colours

void check_limit(const char *what, double value, const std::optional<double> &limit)
{
    // one level of 8 bits is 1 but for the rounding of floats
    if (limit && !(value <= *limit * (1 + 3e-5)))
    {
        throw Failure(formatted("the %s is %.6g, above the limit of %.6g", what, value, *limit));
    }
}

struct MapDeleter
{
    void operator()(cm_colormap *map) const noexcept
    {
        cm_colormap_destroy(map);
    }
};

// As many colours as an eye tells apart, and more; what is beyond sRGB is cut.
constexpr std::size_t color_count = 1024;

void color_at(double t, double color[3], void *user)
{
    const auto &colors = *static_cast<const std::vector<double> *>(user);
    const auto place = static_cast<std::size_t>(
        std::isnan(t) ? 0 : std::lround(t * static_cast<double>(color_count - 1)));
    for (std::size_t c = 0; c < 3; ++c)
    {
        color[c] = std::isnan(t) ? 0.5 : colors[3 * place + c];
    }
}

} // namespace

std::string report(const CompareOptions &options, const Pictures &pictures,
                   const Measured &measured)
{
    return options.json ? json(options, pictures, measured) : words(options, pictures, measured);
}

void draw_difference(const CompareOptions &options, Pictures &pictures)
{
    cm_colormap *made = nullptr;
    const cm_status status = cm_colormap_create(options.colors.c_str(), &made);
    const std::unique_ptr<cm_colormap, MapDeleter> map(made);
    if (status != CM_OK)
    {
        throw Failure(in_quotes(options.colors) + ": " + cm_status_text(status));
    }
    std::vector<double> colors(3 * color_count);
    cm_colormap_clipping clipping = {};
    cm_colormap_samples(map.get(), color_count, colors.data(), &clipping);
    double highest = 0;
    std::vector<float> values = difference_map(options, pictures, &highest);
    const double most = options.difference_of == DIFFERENCE_ERROR && highest > 0 ? highest : 1;
    const auto [low, high] = options.range.value_or(std::pair<double, double>(0, most));
    std::vector<float> drawn(3 * values.size());
    const cm_image from = image_of(values, pictures.width, pictures.height, 1);
    const cm_image to = image_of(drawn, pictures.width, pictures.height, 3);
    if (cm_draw_map(&from, low, high, color_at, &colors, &to, nullptr) != CM_OK)
    {
        throw UsageFailure("--range is too wide");
    }
    write_difference(*options.difference, pictures.width, pictures.height, drawn);
}

void check_limits(const CompareOptions &options, const Pictures &pictures, const Measured &measured)
{
    const double scale = unit_of(pictures);
    check_limit("mean absolute error", scale * measured.errors.mean_absolute, options.max_mean);
    check_limit("root of the mean square error", scale * measured.errors.rmse, options.max_rmse);
    check_limit("largest error", scaled_largest(pictures, measured.errors), options.max);
}
