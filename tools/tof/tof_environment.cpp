// SPDX-License-Identifier: MIT

#include "tof_environment.hpp"

#include "tools/cli/image_file.hpp"
#include "tools/cli/program.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <new>

#include <cubemap/image.h>

namespace
{

constexpr const char *resampled_surface = "cube:coupled;layout=faces;size="; // nearly equal-area
constexpr std::size_t looks =
    8; // along a texel's side; a sun of one texel keeps its light within 1 %
constexpr std::size_t faces = 6;

using SurfacePointer = std::shared_ptr<const cm_surface>;

void check(cm_status status, const std::string &name)
{
    if (status == CM_ERROR_MEMORY)
    {
        throw std::bad_alloc();
    }
    if (status != CM_OK)
    {
        throw Failure(name + ": " + cm_status_text(status));
    }
}

SurfacePointer surface_of(const std::optional<std::string> &specification, const ImageFile &image)
{
    const std::string size = in_quotes(image.path()) + ", which is " +
                             std::to_string(image.width()) + " x " + std::to_string(image.height());
    if (!specification && image.width() != 2 * image.height())
    {
        throw UsageFailure("--environment-surface is missing: " + size +
                           ", may be any map of the sphere");
    }
    cm_surface_options options = {};
    options.size = sizeof options;
    options.width = static_cast<std::uint32_t>(image.width());
    options.height = static_cast<std::uint32_t>(image.height());
    const char *const text = specification ? specification->c_str() : "equirect";
    char message[400] = "";
    cm_surface *made = nullptr;
    if (cm_surface_check(text, &options, message, sizeof message) != CM_OK)
    {
        throw UsageFailure("--environment-surface: " + in_quotes(text) + " of " + size + ": " +
                           message);
    }
    check(cm_surface_create(text, &options, &made), "--environment-surface");
    const SurfacePointer owned(made, cm_surface_destroy);
    if (cm_surface_picture_count(made) != 1)
    {
        throw UsageFailure("--environment-surface: " + in_quotes(text) +
                           " is of several images; say a layout of one, as in cube;layout=strip");
    }
    return owned;
}

// One channel, or the mean of three colours; opacity does not count.
std::vector<float> read_radiance(ImageFile &image)
{
    const auto channels = static_cast<std::size_t>(image.channels());
    const std::size_t colors = channels < 3 ? 1 : 3;
    const std::size_t pixels =
        static_cast<std::size_t>(image.width()) * static_cast<std::size_t>(image.height());
    check_memory(in_quotes(image.path()), std::int64_t{image.width()} * image.height(),
                 image.channels());
    std::vector<float> all(pixels * channels);
    std::vector<float> mean(pixels);
    image.read(all.data(), static_cast<std::size_t>(image.width()) * channels, Finite::any);
    for (std::size_t i = 0; i < pixels; ++i)
    {
        double sum = 0;
        for (std::size_t k = 0; k < colors; ++k)
        {
            const float value = all[i * channels + k];
            if (!(value >= 0) || std::isinf(value))
            {
                throw Failure(
                    in_quotes(image.path()) +
                    " has a radiance that is no finite number of 0 or more at x = " +
                    std::to_string(i % static_cast<std::size_t>(image.width())) +
                    ", y = " + std::to_string(i / static_cast<std::size_t>(image.width())));
            }
            sum += static_cast<double>(value);
        }
        mean[i] = static_cast<float>(sum / static_cast<double>(colors));
    }
    return mean;
}

cm_image picture_of(std::vector<float> &pixels, const cm_surface &surface)
{
    cm_image image = {};
    image.size = sizeof image;
    image.data = pixels.data();
    image.type = CM_PIXEL_FLOAT;
    image.width = cm_surface_width(&surface);
    image.height = cm_surface_height(&surface);
    image.channels = 1;
    return image;
}

// From the surface's rows to the mapping's cells, texel by texel.
void take_cells(const std::string &name, const cm_surface &surface,
                const std::vector<float> &pixels, TofEnvironment &made)
{
    cm_mapping *mapping = nullptr;
    check(cm_mapping_copy(cm_surface_mapping(&surface), &mapping), name);
    made.mapping.reset(mapping, cm_mapping_destroy);
    const std::uint32_t edge = cm_surface_plane_width(&surface);
    const auto planes = static_cast<std::uint32_t>(cm_surface_plane_count(&surface));
    const double half = 0.5 * edge;
    made.radiance.resize(std::size_t{planes} * edge * edge);
    for (std::uint32_t plane = 0; plane < planes; ++plane)
    {
        for (std::size_t i = 0; i < std::size_t{edge} * edge; ++i)
        {
            const auto column = static_cast<std::uint32_t>(i % edge);
            const auto row = static_cast<std::uint32_t>(i / edge);
            const auto number = static_cast<std::uint8_t>(plane);
            const double across = column + 0.5;
            const double down = row + 0.5;
            double direction[3];
            double uv[2];
            std::uint32_t picture = 0;
            std::uint32_t right = 0;
            std::uint32_t below = 0;
            cm_surface_directions(&surface, 1, &number, &across, &down, &direction[0],
                                  &direction[1], &direction[2]);
            const std::uint8_t face = cm_forward(made.mapping.get(), direction, uv);
            if (face == CM_NO_FACE ||
                cm_surface_pixel(&surface, plane, column, row, &picture, &right, &below) != CM_OK)
            {
                continue;
            }
            const auto x = std::min(static_cast<std::uint32_t>((uv[0] + 1) * half), edge - 1);
            const auto y = std::min(static_cast<std::uint32_t>((uv[1] + 1) * half), edge - 1);
            made.radiance[(std::size_t{face} * edge + y) * edge + x] =
                pixels[(std::size_t{picture} * cm_surface_height(&surface) + below) *
                           cm_surface_width(&surface) +
                       right];
        }
    }
    made.given.edge = edge;
}

// The mean of each looks x looks pixels of so many rows of texels.
void take_means(const std::vector<float> &fine, std::size_t edge, std::size_t rows, float *texels)
{
    for (std::size_t texel = 0; texel < edge * rows; ++texel)
    {
        const std::size_t first = (texel / edge * looks * edge + texel % edge) * looks;
        double sum = 0;
        for (std::size_t i = 0; i < looks * looks; ++i)
        {
            sum += static_cast<double>(fine[first + i / looks * edge * looks + i % looks]);
        }
        texels[texel] = static_cast<float>(sum / (looks * looks));
    }
}

SurfacePointer cube_of(std::size_t edge, const std::string &name)
{
    const std::string text = resampled_surface + std::to_string(edge);
    cm_surface *made = nullptr;
    check(cm_surface_create(text.c_str(), nullptr, &made), name);
    return SurfacePointer(made, cm_surface_destroy);
}

// The pictures of a surface of which only the band is there, from that row on; no other one is touched.
cm_image picture_around(std::vector<float> &band, std::size_t first_row, const cm_surface &surface)
{
    cm_image image = picture_of(band, surface);
    const std::size_t before = first_row * cm_surface_width(&surface) * sizeof(float);
    image.data = reinterpret_cast<void *>(reinterpret_cast<std::uintptr_t>(band.data()) - before);
    return image;
}

// On a cube, about as fine. Bilinear means keep the light of what is small, and nothing goes below 0. What is finer is there in
// bands of no more than a face's texels.
void resample(const std::string &name, const cm_surface &from, std::vector<float> &pixels,
              unsigned threads, TofEnvironment &made)
{
    const double texels = static_cast<double>(cm_surface_plane_count(&from)) *
                          cm_surface_plane_width(&from) * cm_surface_plane_height(&from);
    const auto edge = static_cast<std::size_t>(std::ceil(std::sqrt(texels / faces)));
    const std::size_t band_rows = std::max<std::size_t>(1, edge / (looks * looks));
    const SurfacePointer finer = cube_of(edge * looks, name);
    cm_plan *plan = nullptr;
    cm_source *source = nullptr;
    cm_plan_options options = {};
    options.size = sizeof options;
    options.filter = CM_FILTER_BILINEAR;
    check(cm_plan_create(&from, finer.get(), &options, &plan), name);
    const std::shared_ptr<cm_plan> owned_plan(plan, cm_plan_destroy);
    const cm_image given = picture_of(pixels, from);
    check(cm_source_create(plan, &given, CM_PIXEL_FLOAT, threads, &source), name);
    const std::shared_ptr<cm_source> owned_source(source, cm_source_destroy);
    std::vector<float> fine(looks * edge * looks * band_rows);
    std::vector<float> laid(faces * edge * edge);
    for (std::size_t row = 0; row < faces * edge;)
    {
        const std::size_t first = row % edge; // of the face
        const std::size_t count = std::min(band_rows, edge - first);
        std::vector<cm_image> wanted(faces, picture_around(fine, first * looks, *finer));
        cm_rows rows = {};
        rows.plane = static_cast<std::uint32_t>(row / edge);
        rows.first_row = static_cast<std::uint32_t>(first * looks);
        rows.row_count = static_cast<std::uint32_t>(count * looks);
        check(cm_resample_source(plan, source, wanted.data(), rows, threads), name);
        take_means(fine, edge, count, laid.data() + row * edge);
        row += count;
    }
    take_cells(name, *cube_of(edge, name), laid, made);
}

} // namespace

std::unique_ptr<TofEnvironment>
read_tof_environment(const std::string &path, const std::optional<std::string> &specification,
                     unsigned threads)
{
    ImageFile image(path);
    const std::string name = in_quotes(path);
    const SurfacePointer surface = surface_of(specification, image);
    std::vector<float> pixels = read_radiance(image);
    auto made = std::make_unique<TofEnvironment>();
    if (cm_surface_mapping(surface.get()) != nullptr &&
        cm_surface_plane_width(surface.get()) == cm_surface_plane_height(surface.get()))
    {
        take_cells(name, *surface, pixels, *made);
    }
    else
    {
        resample(name, *surface, pixels, threads, *made);
    }
    made->given.size = sizeof made->given;
    made->given.mapping = made->mapping.get();
    made->given.radiance = made->radiance.data();
    return made;
}
