// SPDX-License-Identifier: MIT

#include "reproject_input.hpp"
#include "tools/image/chart_image.hpp"
#include "tools/image/equirect.hpp"
#include "tools/cli/parallel.hpp"
#include "tools/cli/program.hpp"

#include <algorithm>

namespace
{

std::string size_text(const ImageFile &image)
{
    return std::to_string(image.width()) + " x " + std::to_string(image.height());
}

// Does the image have this shape, in squares?
bool has_shape(const ImageFile &image, int columns, int rows)
{
    return image.width() % columns == 0 && image.height() % rows == 0 &&
           image.width() / columns == image.height() / rows;
}

void multiply_by_alpha(SphereGrid &grid, int plane, int alpha)
{
    for (int row = 0; row < grid.height(); ++row)
    {
        for (int column = 0; column < grid.width(); ++column)
        {
            float *const pixel = grid.pixel(plane, column, row);
            for (int c = 0; c < grid.channels(); ++c)
            {
                pixel[c] *= c == alpha ? 1.0f : pixel[alpha];
            }
        }
    }
}

} // namespace

Input::Input(const Options &options)
{
    chart = options.from == Kind::chart;
    open(options);
    find_kind(options);
    make_projection(options);
    check_memory(in_quotes(images.front().path()),
                 (std::int64_t{sphere->width()} + 2) * (std::int64_t{sphere->height()} + 2) *
                     sphere->planes(),
                 images.front().channels());
}

void Input::open(const Options &options)
{
    const bool cube = options.from.value_or(Kind::cube) == Kind::cube;
    const bool faces = cube && (options.from_layout == CubeLayout::faces ||
                                (!options.from_layout && names_faces(options.input)));
    if (!cube && options.from_layout)
    {
        throw UsageFailure("--from-layout is for a cube, but --from says " +
                           (chart ? options.from_mapping : "equirect"));
    }
    const std::vector<std::string> names =
        faces ? face_names(options.input) : std::vector<std::string>{options.input};
    for (const std::string &name : names)
    {
        images.emplace_back(name);
    }
    if (faces)
    {
        layout = CubeLayout::faces;
        check_faces();
    }
}

void Input::check_faces() const
{
    const ImageFile &first = images.front();
    for (const ImageFile &image : images)
    {
        if (image.width() != image.height())
        {
            throw Failure(in_quotes(image.path()) + " is " + size_text(image) +
                          "; the face of a cube must be square");
        }
        if (image.width() != first.width() || image.channels() != first.channels())
        {
            throw Failure(in_quotes(image.path()) + " is " + size_text(image) + " with " +
                          std::to_string(image.channels()) + " channels, " +
                          in_quotes(first.path()) + " is " + size_text(first) + " with " +
                          std::to_string(first.channels()) + "; all six faces must be alike");
        }
    }
}

void Input::check_chart(const Options &options) const
{
    const ImageFile &image = images.front();
    if (image.width() != image.height())
    {
        throw Failure(in_quotes(image.path()) + " is " + size_text(image) + "; an image in " +
                      options.from_mapping + " must be square");
    }
}

// Sets the layout, unless the image is equirectangular or its layout is known.
void Input::find_kind(const Options &options)
{
    const ImageFile &image = images.front();
    const bool may_be_cube = options.from != Kind::equirect;
    const bool may_be_equirect = options.from != Kind::cube && !options.from_layout;
    if (chart)
    {
        check_chart(options);
        return;
    }
    if (layout || !may_be_cube || (may_be_equirect && has_shape(image, 2, 1)))
    {
        return;
    }
    layout = options.from_layout;
    if (!layout && (has_shape(image, 6, 1) || has_shape(image, 4, 3)))
    {
        layout = has_shape(image, 6, 1) ? CubeLayout::strip : CubeLayout::cross;
    }
    const bool right =
        layout == CubeLayout::strip ? has_shape(image, 6, 1) : layout && has_shape(image, 4, 3);
    if (right)
    {
        return;
    }
    throw Failure(in_quotes(image.path()) + " is " + size_text(image) +
                  (layout == CubeLayout::strip   ? "; a strip must be 6N x N"
                   : layout == CubeLayout::cross ? "; a cross must be 4N x 3N"
                   : may_be_equirect ? ", neither 2:1 (equirect), 6:1 (strip) nor 4:3 (cross); "
                                       "say --from equirect if it is that all the same"
                                     : "; a cube must be a strip, 6N x N, or a cross, 4N x 3N, "
                                       "or six faces, with %f in the name"));
}

void Input::make_projection(const Options &options)
{
    const ImageFile &image = images.front();
    if (kind() == Kind::equirect)
    {
        sphere = std::make_unique<Equirect>(image.width(), image.height());
    }
    else if (kind() == Kind::chart)
    {
        sphere = std::make_unique<ChartImage>(options.from_mapping, image.width());
    }
    else
    {
        sphere = std::make_unique<CubeImage>(options.from_mapping,
                                             turn_poles(*options.from_frame, options.from_columns),
                                             face_size_in_picture());
    }
}

int Input::face_size_in_picture() const
{
    const int width = images.front().width();
    return layout == CubeLayout::faces   ? width
           : layout == CubeLayout::strip ? width / 6
                                         : width / 4;
}

SphereGrid Input::read(const Options &options, bool multiply_alpha, int threads)
{
    const Finite finite = options.filter == Filter::nearest ? Finite::not_nan : Finite::all;
    const ImageFile &first = images.front();
    SphereGrid grid(sphere->planes(), sphere->width(), sphere->height(), first.channels());
    if (layout == CubeLayout::strip || layout == CubeLayout::cross)
    {
        const std::vector<PictureLayout> pictures =
            cube_pictures(*layout, *options.from_frame, options.from_columns);
        read_parts(grid, pictures.front(), finite);
    }
    else
    {
        parallel_for(static_cast<int>(images.size()), threads,
                     [&](int plane)
                     {
                         images[static_cast<std::size_t>(plane)].read(grid.pixel(plane, 0, 0),
                                                                      grid.row_stride(), finite);
                     });
    }
    for (int plane = 0; multiply_alpha && plane < grid.planes(); ++plane)
    {
        multiply_by_alpha(grid, plane, first.spec().alpha_channel);
    }
    sphere->fill_border(grid);
    return grid;
}

// Reads a picture that holds several planes.
void Input::read_parts(SphereGrid &grid, const PictureLayout &picture, Finite finite)
{
    ImageFile &image = images.front();
    check_memory(in_quotes(image.path()), std::int64_t{image.width()} * image.height(),
                 image.channels());
    const std::size_t channels = static_cast<std::size_t>(image.channels());
    const std::size_t stride = static_cast<std::size_t>(image.width()) * channels;
    const std::size_t part = static_cast<std::size_t>(grid.width()) * channels;
    std::vector<float> pixels(stride * static_cast<std::size_t>(image.height()));
    image.read(pixels.data(), stride, finite);
    for (const Placement &placement : picture.placements)
    {
        for (int row = 0; row < grid.height(); ++row)
        {
            const std::size_t from_row =
                static_cast<std::size_t>(placement.row * grid.height() + row);
            const float *const from = pixels.data() + from_row * stride +
                                      static_cast<std::size_t>(placement.column) * part;
            std::copy(from, from + part, grid.pixel(placement.plane, 0, row));
        }
    }
}

std::string Input::description(const Options &options) const
{
    const ImageFile &first = images.front();
    std::string text = chart ? options.from_mapping + " " : "equirect ";
    if (layout)
    {
        text = "cube:" + options.from_mapping + ", frame " + options.from_frame->identifier + ", ";
        text += layout == CubeLayout::faces ? "" : std::string(layout_name(*layout)) + " ";
    }
    return text + std::to_string(first.width()) + "x" + std::to_string(first.height()) + ", " +
           std::to_string(first.channels()) +
           (first.channels() == 1 ? " channel, " : " channels, ") + first.pixel_type();
}
