// SPDX-License-Identifier: MIT

#include "distortion_picture.hpp"
#include "tools/image/face_names.hpp"
#include "legend.hpp"
#include "tools/cli/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <cubemap/version.h>

namespace
{

// Rows are computed, then written, in bands of so many floats, but at least so many rows.
constexpr std::size_t band_floats = std::size_t{1} << 22;
constexpr int band_rows_least = 16;

constexpr int color_channels = 3;

// Where a picture has no face.
constexpr float blank_color = 1;
constexpr float blank_value = std::numeric_limits<float>::quiet_NaN();

std::vector<PictureLayout> choose_pictures(const DistortionOptions &options)
{
    if (options.face || options.one_face)
    {
        return {{1, 1, {{options.face.value_or(0), 0, 0}}}};
    }
    return cube_pictures(options.layout.value_or(CubeLayout::cross), *options.frame);
}

void check_format(const std::string &name, bool values)
{
    const std::string format = output_format(name);
    const bool holds_numbers = format == "tiff" || format == "openexr";
    const bool holds_colors = format == "tiff" || format == "png" || format == "jpeg";
    if (values && !holds_numbers)
    {
        throw UsageFailure(in_quotes(name) + ": --values needs a name that ends in .tif or .exr");
    }
    if (!values && !holds_colors)
    {
        throw UsageFailure(in_quotes(name) + ": pictures need a name that ends in .png, .jpg or "
                                             ".tif; numbers need --values");
    }
}

std::string percent(double part)
{
    char text[40];
    std::snprintf(text, sizeof text, "%.3g %%", 100 * part);
    return text;
}

} // namespace

DistortionPicture::DistortionPicture(const DistortionOptions &wanted)
    : options(wanted), rows(wanted.mapping, *wanted.frame, wanted.size, *wanted.quantity),
      colors(wanted.colors),
      scale(rows.what(), wanted.range.value_or(rows.what().range), wanted.reverse),
      pictures(choose_pictures(wanted))
{
    if (options.overlay.wanted())
    {
        overlay = std::make_unique<Overlay>(
            options.overlay, LineFaces{options.mapping, *options.frame, !rows.projection().wraps()},
            rows.projection());
    }
    choose_names();
    for (const std::string &name : names)
    {
        files.push_back(std::make_unique<AtomicFile>(name));
    }
}

void DistortionPicture::choose_names()
{
    if (pictures.size() == 1 && names_faces(options.output))
    {
        throw UsageFailure(in_quotes(options.output) +
                           " has %f for six faces, but there is one picture; say --layout faces");
    }
    names =
        pictures.size() > 1 ? face_names(options.output) : std::vector<std::string>{options.output};
    check_format(names.front(), options.values);
    if (!options.legend)
    {
        return;
    }
    check_format(*options.legend, false);
    for (const std::string &name : names)
    {
        if (name == *options.legend || same_file(name, *options.legend))
        {
            throw UsageFailure("--legend: " + in_quotes(name) +
                               " is the same file as OUTPUT; give it another name");
        }
    }
    names.push_back(*options.legend);
}

void DistortionPicture::write(int threads, std::FILE *terminal)
{
    std::int64_t faces = 0;
    for (const PictureLayout &picture : pictures)
    {
        faces += static_cast<std::int64_t>(picture.placements.size());
    }
    {
        // All rows twice: the extremes stand before the pixels in a file.
        Progress progress(2 * faces * options.size, !options.quiet, terminal);
        survey(threads, progress);
        for (std::size_t i = 0; i < pictures.size(); ++i)
        {
            write_picture(i, threads, progress);
        }
    }
    if (options.legend)
    {
        write_legend();
    }
    appear_together(files);
}

void DistortionPicture::survey(int threads, Progress &progress)
{
    for (const PictureLayout &picture : pictures)
    {
        for (const Placement &placement : picture.placements)
        {
            parallel_for(options.size, threads,
                         [&](int row)
                         {
                             std::vector<double> values(static_cast<std::size_t>(options.size));
                             rows.evaluate(placement.plane, row, values.data());
                             add_to_survey(values);
                             progress.advance(1);
                         });
        }
    }
}

void DistortionPicture::add_to_survey(const std::vector<double> &values)
{
    Survey row;
    for (const double value : values)
    {
        row.low = std::min(row.low, value);
        row.high = std::max(row.high, value);
        row.below += value < scale.range().low;
        row.above += value > scale.range().high;
        row.count += options.one_face && std::isnan(value) ? 0 : 1;
    }
    const std::lock_guard<std::mutex> lock(mutex);
    found.low = std::min(found.low, row.low);
    found.high = std::max(found.high, row.high);
    found.below += row.below;
    found.above += row.above;
    found.count += row.count;
}

ImagePlan DistortionPicture::plan() const
{
    const std::string format = output_format(names.front());
    ImageDescription shown(options.values ? 1 : color_channels,
                           options.values ? CM_PIXEL_FLOAT : CM_PIXEL_U8);
    if (options.values)
    {
        shown.channel_names = {options.quantity->name};
    }
    else
    {
        shown.color = CM_IMAGE_COLOR_SRGB;
    }
    shown.set("ImageDescription", description());
    shown.set("Software", std::string("cubemap-distortion ") + cm_version());
    return plan_image(format, shown, format, names.front());
}

void DistortionPicture::write_picture(std::size_t index, int threads, Progress &progress)
{
    const PictureLayout &picture = pictures[index];
    const int width = picture.columns * options.size;
    const int height = picture.rows * options.size;
    const int channels = options.values ? 1 : color_channels;
    const std::size_t row_floats =
        static_cast<std::size_t>(width) * static_cast<std::size_t>(channels);
    const int band =
        std::min(height, std::max(band_rows_least, static_cast<int>(band_floats / row_floats)));
    std::vector<float> pixels(row_floats * static_cast<std::size_t>(band));
    ImageWriter writer(plan(), width, height, names[index], *files[index], threads);
    for (int first = 0; first < height; first += band)
    {
        const int count = std::min(band, height - first);
        parallel_for(count, threads,
                     [&](int row) {
                         draw_row(picture, first + row,
                                  pixels.data() + row_floats * static_cast<std::size_t>(row));
                     });
        writer.write(first, first + count, pixels.data(), channels);
        progress.advance(std::int64_t{count} * std::int64_t(picture.placements.size()) /
                         picture.rows);
    }
    writer.close();
    files[index]->finish();
}

void DistortionPicture::draw_row(const PictureLayout &picture, int row, float *pixels) const
{
    const std::size_t face_floats = static_cast<std::size_t>(options.size) *
                                    static_cast<std::size_t>(options.values ? 1 : color_channels);
    std::fill(pixels, pixels + face_floats * static_cast<std::size_t>(picture.columns),
              options.values ? blank_value : blank_color);
    for (const Placement &placement : picture.placements)
    {
        const int face_row = row - placement.row * options.size;
        if (face_row >= 0 && face_row < options.size)
        {
            draw_plane_row(placement.plane, face_row,
                           pixels + static_cast<std::size_t>(placement.column) * face_floats);
        }
    }
}

void DistortionPicture::draw_plane_row(int face, int row, float *pixels) const
{
    std::vector<double> values(static_cast<std::size_t>(options.size));
    rows.evaluate(face, row, values.data());
    if (options.values)
    {
        std::transform(values.begin(), values.end(), pixels,
                       [](double value) { return static_cast<float>(value); });
        return;
    }
    for (std::size_t i = 0; i < values.size(); ++i)
    {
        const bool blank = options.one_face && std::isnan(values[i]);
        const Color color = blank ? Color{blank_color, blank_color, blank_color}
                                  : colors.at(scale.place(values[i]));
        std::copy(color.begin(), color.end(), pixels + i * color_channels);
    }
    if (overlay || options.isolines)
    {
        draw_lines(face, row, values, pixels);
    }
}

void DistortionPicture::draw_lines(int face, int row, const std::vector<double> &values,
                                   float *pixels) const
{
    LineRow lines(options.size);
    if (overlay)
    {
        overlay->add_lines(face, row, lines);
    }
    if (options.isolines)
    {
        rows.lower_distances(face, row, *options.isolines, values.data(), lines.distance.data());
    }
    // Colours inside ellipses must stay what they are: no fill.
    const LineStyle style = {options.overlay.line_width, options.overlay.line_color, 0};
    lines.draw(style, {color_channels, -1, false}, pixels);
}

void DistortionPicture::write_legend()
{
    ImageDescription shown(color_channels, CM_PIXEL_U8);
    shown.set("ImageDescription", description());
    const std::string format = output_format(names.back());
    const std::vector<float> pixels = legend_pixels(
        colors, scale,
        std::string(options.quantity->name) + " " + options.quantity->symbol +
            (options.quantity->unit[0] == '\0' ? ", a ratio"
                                               : std::string(",") + options.quantity->unit));
    ImageWriter writer(plan_image(format, shown, format, names.back()), legend_width, legend_height,
                       names.back(), *files.back());
    writer.write(0, legend_height, pixels.data(), color_channels);
    writer.close();
    files.back()->finish();
}

std::string DistortionPicture::description() const
{
    const Quantity &quantity = *options.quantity;
    std::string text =
        options.mapping +
        (options.one_face ? ", " : std::string(", frame ") + options.frame->identifier + ", ") +
        quantity.name + " (" + quantity.symbol + "): " + quantity_text(found.low) + " to " +
        quantity_text(found.high) + quantity.unit + " at the pixels' centres";
    if (options.values)
    {
        return text;
    }
    text += "; colours " + options.colors + (options.reverse ? ", reversed" : "") + ", " +
            quantity_text(scale.range().low) + " to " + quantity_text(scale.range().high) + ", " +
            scale.description();
    text += out_of_range().empty() ? "" : "; " + out_of_range();
    text += options.isolines ? "; isolines every " + quantity_text(*options.isolines) : "";
    return text + (overlay ? "; " + overlay->description() : "");
}

// "2.1 % of the map is above 2 and has its colour"; "" if nothing is.
std::string DistortionPicture::out_of_range() const
{
    std::string text;
    const auto add = [&](double count, const char *where, double end)
    {
        if (count > 0)
        {
            text += (text.empty() ? "" : ", ") + percent(count / found.count) + " of the map is " +
                    where + " " + quantity_text(end) + " and has its colour";
        }
    };
    add(found.below, "below", scale.range().low);
    add(found.above, "above", scale.range().high);
    return text;
}

std::string DistortionPicture::report() const
{
    const PictureLayout &picture = pictures.front();
    const std::size_t count = names.size() - (options.legend ? 1 : 0);
    const std::vector<std::string> shown(names.begin(), names.begin() + static_cast<long>(count));
    std::string text = description() + " -> " + name_list(shown) + " (" +
                       std::to_string(picture.columns * options.size) + "x" +
                       std::to_string(picture.rows * options.size) + ")\n";
    if (!options.values && colors.cut() > 0)
    {
        text += "of the colours " + options.colors + ", " +
                percent(static_cast<double>(colors.cut()) / static_cast<double>(colors.count())) +
                " are outside sRGB and cut to it\n";
    }
    return text;
}
