// SPDX-License-Identifier: MIT

#include "reproject_output.hpp"
#include "reproject_table.h"
#include "tools/image/chart_image.hpp"
#include "tools/image/equirect.hpp"
#include "tools/cli/parallel.hpp"
#include "tools/cli/program.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace
{

// Rows are computed, then written, in bands of about so many floats, but at least so many rows.
constexpr std::size_t band_floats = std::size_t{1} << 22;
constexpr int band_rows_least = 16;

// How opaque ellipses are inside: what is below must still be seen.
constexpr double ellipse_fill = 0.35;

constexpr double pi = 3.14159265358979323846;

// The edge of a square of the unit sphere that has as many pixels as the projection has along its width: at
// the equator, and of a chart in the mean.
double span(Kind kind, const std::string &mapping)
{
    switch (kind)
    {
    case Kind::equirect:
        return 2 * pi;
    case Kind::cube:
        return pi / 2;
    case Kind::chart:
        break;
    }
    return 2 / std::sqrt(ChartImage(mapping, 1).mean_scale());
}

int largest_size(Kind kind)
{
    return kind == Kind::equirect ? REPROJECT_EQUIRECT_MAX : REPROJECT_FACE_MAX;
}

// With the same resolution as the input.
int natural_size(Kind kind, const Options &options, const Input &input)
{
    const double radian = input.projection().width() / span(input.kind(), options.from_mapping);
    const double width = std::round(radian * span(kind, options.to_mapping));
    const int size =
        static_cast<int>(std::clamp(width, 1.0, static_cast<double>(largest_size(kind))));
    return kind == Kind::equirect ? size + size % 2 : size;
}

int output_size(Kind kind, const Options &options, const Input &input)
{
    const int size = options.size ? *options.size : natural_size(kind, options, input);
    if (size > largest_size(kind))
    {
        throw UsageFailure("--size: " + std::to_string(size) + " is too large; the " +
                           (kind == Kind::cube    ? "edge of a face"
                            : kind == Kind::chart ? "edge of a square image"
                                                  : "width of an equirectangular image") +
                           " may be " + std::to_string(largest_size(kind)) + " at most");
    }
    if (kind == Kind::equirect && size % 2 != 0)
    {
        throw UsageFailure("--size: " + std::to_string(size) +
                           " is odd; the width of an equirectangular image must be even");
    }
    return size;
}

// Computes the rows of a picture.
class Band
{
public:
    // draw_over, if there is one, gets each row of a plane when it is computed.
    using DrawOver = std::function<void(int plane, int row, float *pixels)>;

    Band(const PictureLayout &picture_layout, const Projection &target, int channel_count,
         DrawOver draw_over)
        : picture(picture_layout), sphere(target),
          channels(static_cast<std::size_t>(channel_count)), over(std::move(draw_over))
    {
    }

    std::size_t row_floats() const
    {
        return static_cast<std::size_t>(picture.columns) *
               static_cast<std::size_t>(sphere.width()) * channels;
    }

    int most_rows() const
    {
        const std::size_t rows = band_floats / row_floats();
        const int all = picture.rows * sphere.height();
        return std::min(all, std::max(band_rows_least, static_cast<int>(rows)));
    }

    // One row of the picture, its empty parts 0.
    void compute_row(const Projection &from, const SphereGrid &grid, Filter filter, int row,
                     float *pixels) const
    {
        std::fill(pixels, pixels + row_floats(), 0.0f);
        for (const Placement &placement : picture.placements)
        {
            const int plane_row = row - placement.row * sphere.height();
            if (plane_row >= 0 && plane_row < sphere.height())
            {
                compute_plane_row(from, grid, filter, placement.plane, plane_row,
                                  pixels + static_cast<std::size_t>(placement.column) *
                                               static_cast<std::size_t>(sphere.width()) * channels);
            }
        }
    }

private:
    void compute_plane_row(const Projection &from, const SphereGrid &grid, Filter filter, int plane,
                           int row, float *pixels) const
    {
        thread_local PointBatch batch;
        float *const whole_row = pixels;
        for (int column = 0; column < sphere.width();)
        {
            const std::size_t count =
                std::min(PointBatch::capacity, static_cast<std::size_t>(sphere.width() - column));
            sphere.directions(plane, row, column, count, batch);
            from.positions(count, batch);
            sample(grid, filter, batch, count, pixels);
            pixels += count * channels;
            column += static_cast<int>(count);
        }
        if (over)
        {
            over(plane, row, whole_row);
        }
    }

    const PictureLayout &picture;
    const Projection &sphere;
    const std::size_t channels;
    const DrawOver over;
};

} // namespace

struct Output::Render
{
    const Projection &from;
    const SphereGrid &grid;
    Filter filter;
    Progress &progress;
};

Output::Output(const Options &options, const Input &input)
{
    choose_projection(options, input);
    choose_names(options, input);
    const ImageFile &source = input.files().front();
    plan = plan_image(output_format(names.front()), source.spec(), source.format(), names.front());
    choose_overlay(options, source.spec());
    for (const std::string &name : names)
    {
        files.push_back(std::make_unique<AtomicFile>(name));
    }
}

void Output::choose_projection(const Options &options, const Input &input)
{
    const Kind other = input.kind() == Kind::equirect ? Kind::cube : Kind::equirect;
    kind = options.to.value_or(other);
    if (kind != Kind::cube && options.layout)
    {
        throw UsageFailure("--layout is for a cube, but OUTPUT is " +
                           (kind == Kind::chart ? options.to_mapping : "equirectangular") +
                           (options.to ? "" : "; say --to cube if it is to be a cube"));
    }
    const int size = output_size(kind, options, input);
    if (kind == Kind::equirect)
    {
        sphere = std::make_unique<Equirect>(size, size / 2);
        pictures = {{1, 1, {{0, 0, 0}}}};
        return;
    }
    if (kind == Kind::chart)
    {
        sphere = std::make_unique<ChartImage>(options.to_mapping, size);
        pictures = {{1, 1, {{0, 0, 0}}}};
        return;
    }
    layout = options.layout.value_or(CubeLayout::faces);
    sphere = std::make_unique<CubeImage>(options.to_mapping,
                                         turn_poles(*options.frame, options.columns), size);
    pictures = cube_pictures(*layout, *options.frame, options.columns);
}

// The pixels are those of the source, multiplied by alpha if the format wants it so.
void Output::choose_overlay(const Options &options, const OIIO::ImageSpec &source)
{
    if (!options.overlay.wanted())
    {
        return;
    }
    const bool own = kind != Kind::equirect;
    const cm_frame frame = own ? turn_poles(*options.frame, options.columns)
                               : turn_poles(*options.from_frame, options.from_columns);
    overlay = std::make_unique<Overlay>(
        options.overlay, own ? options.to_mapping : options.from_mapping, frame, *sphere);
    line_style = {options.overlay.line_width, options.overlay.line_color, ellipse_fill};
    const bool divided = source.get_int_attribute("oiio:UnassociatedAlpha", 0) != 0;
    line_channels = {source.nchannels, source.alpha_channel, !divided || plan.multiply_alpha};
}

void Output::choose_names(const Options &options, const Input &input)
{
    if (layout && layout != CubeLayout::faces && names_faces(options.output))
    {
        throw UsageFailure(in_quotes(options.output) + " has %f for six faces, but --layout says " +
                           layout_name(*layout));
    }
    names =
        pictures.size() > 1 ? face_names(options.output) : std::vector<std::string>{options.output};
    for (const std::string &name : names)
    {
        for (const ImageFile &image : input.files())
        {
            if (same_file(name, image.path()))
            {
                throw UsageFailure("OUTPUT " + in_quotes(name) +
                                   " is the same file as INPUT; give it another name");
            }
        }
    }
}

void Output::write(const Options &options, const Input &input, const SphereGrid &grid, int threads,
                   std::FILE *terminal)
{
    const std::int64_t rows =
        std::int64_t{pictures.front().rows} * sphere->height() * std::int64_t(pictures.size());
    {
        Progress progress(rows, !options.quiet, terminal);
        const Render render = {input.projection(), grid, options.filter, progress};
        const int count = static_cast<int>(pictures.size());
        const int threads_each = std::max(1, threads / count);
        parallel_for(count, threads,
                     [&](int i)
                     { write_picture(render, static_cast<std::size_t>(i), threads_each); });
    }
    appear_together(files);
}

std::function<void(int, int, float *)> Output::line_drawer() const
{
    if (!overlay)
    {
        return nullptr;
    }
    return [this](int plane, int row, float *pixels)
    {
        LineRow lines(sphere->width());
        overlay->add_lines(plane, row, lines);
        lines.draw(line_style, line_channels, pixels);
    };
}

void Output::write_picture(const Render &render, std::size_t index, int threads)
{
    const PictureLayout &picture = pictures[index];
    const int height = picture.rows * sphere->height();
    const Band band(picture, *sphere, render.grid.channels(), line_drawer());
    const int most_rows = band.most_rows();
    std::vector<float> pixels(band.row_floats() * static_cast<std::size_t>(most_rows));
    ImageWriter writer(plan, picture.columns * sphere->width(), height, names[index],
                       *files[index]);
    for (int first = 0; first < height; first += most_rows)
    {
        const int rows = std::min(most_rows, height - first);
        parallel_for(rows, threads,
                     [&](int row)
                     {
                         band.compute_row(render.from, render.grid, render.filter, first + row,
                                          pixels.data() +
                                              band.row_floats() * static_cast<std::size_t>(row));
                     });
        writer.write(first, first + rows, pixels.data(), render.grid.channels());
        render.progress.advance(rows);
    }
    writer.close();
    files[index]->finish();
}

std::string Output::description(const Options &options) const
{
    std::string text =
        name_list(names) + " (" + (kind == Kind::chart ? options.to_mapping : "equirect") + " ";
    if (layout)
    {
        text = name_list(names) + " (cube:" + options.to_mapping + ", frame " +
               options.frame->identifier + ", ";
        text += layout == CubeLayout::faces ? "" : std::string(layout_name(*layout)) + " ";
    }
    const PictureLayout &picture = pictures.front();
    return text + std::to_string(picture.columns * sphere->width()) + "x" +
           std::to_string(picture.rows * sphere->height()) +
           (plan.alpha_dropped ? ", without alpha" : "") +
           (overlay ? "; " + overlay->description() : "") + ")";
}
