// SPDX-License-Identifier: MIT

#include "compare_pictures.hpp"
#include "compared_files.hpp"
#include "tools/cli/image_writer.hpp"
#include "tools/cli/program.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <cubemap/compare.h>

namespace
{

// What is on no plane has CM_NO_FACE. Places are of planes.
struct Places
{
    std::vector<std::uint8_t> plane;
    std::vector<double> column;
    std::vector<double> row;
};

Places places_of(const cm_surface &surface)
{
    const std::size_t width = cm_surface_width(&surface);
    const std::size_t pixels = width * cm_surface_height(&surface);
    Places places = {std::vector<std::uint8_t>(pixels, CM_NO_FACE), std::vector<double>(pixels),
                     std::vector<double>(pixels)};
    for (std::uint32_t plane = 0; plane < cm_surface_plane_count(&surface); ++plane)
    {
        for (std::uint32_t row = 0; row < cm_surface_plane_height(&surface); ++row)
        {
            for (std::uint32_t column = 0; column < cm_surface_plane_width(&surface); ++column)
            {
                std::uint32_t picture = 0;
                std::uint32_t right = 0;
                std::uint32_t down = 0;
                cm_surface_pixel(&surface, plane, column, row, &picture, &right, &down);
                const std::size_t at = down * width + right;
                places.plane[at] = static_cast<std::uint8_t>(plane);
                places.column[at] = column;
                places.row[at] = row;
            }
        }
    }
    return places;
}

// Directions of places that are moved by so much.
std::array<std::vector<double>, 3> directions_of(const cm_surface &surface, const Places &places,
                                                 double right, double down)
{
    const std::size_t n = places.plane.size();
    std::vector<double> column(places.column);
    std::vector<double> row(places.row);
    std::array<std::vector<double>, 3> found;
    for (std::size_t i = 0; i < n; ++i)
    {
        column[i] += right;
        row[i] += down;
    }
    for (std::vector<double> &axis : found)
    {
        axis.resize(n);
    }
    cm_surface_directions(&surface, n, places.plane.data(), column.data(), row.data(),
                          found[0].data(), found[1].data(), found[2].data());
    return found;
}

// Twice the area of the flat triangle, which of a pixel is that on the sphere.
double twice_area(const double a[3], const double b[3], const double c[3])
{
    const double p[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    const double q[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    return std::hypot(p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2],
                      p[0] * q[1] - p[1] * q[0]);
}

// The solid angle of each pixel, by its corners; 0 where a corner is beside the map.
std::vector<float> areas_of(const cm_surface &surface, const Places &places)
{
    const std::array<std::vector<double>, 3> corner[4] = {
        directions_of(surface, places, 0, 0), directions_of(surface, places, 1, 0),
        directions_of(surface, places, 0, 1), directions_of(surface, places, 1, 1)};
    std::vector<float> areas(places.plane.size());
    for (std::size_t i = 0; i < areas.size(); ++i)
    {
        double at[4][3];
        for (std::size_t k = 0; k < 12; ++k)
        {
            at[k / 3][k % 3] = corner[k / 3][k % 3][i];
        }
        const double area = (twice_area(at[0], at[1], at[2]) + twice_area(at[3], at[1], at[2])) / 2;
        areas[i] = std::isnan(area) ? 0.0f : static_cast<float>(area);
    }
    return areas;
}

// 1 where both surfaces have the pixel.
std::vector<float> shown_by(const cm_surface &reference, const cm_surface &picture,
                            const Places &places)
{
    const std::array<std::vector<double>, 3> middle = directions_of(reference, places, 0.5, 0.5);
    const std::size_t n = places.plane.size();
    std::vector<std::uint8_t> plane(n);
    std::vector<double> column(n);
    std::vector<double> row(n);
    cm_surface_positions(&picture, n, middle[0].data(), middle[1].data(), middle[2].data(),
                         plane.data(), column.data(), row.data());
    std::vector<float> shown(n);
    std::transform(plane.begin(), plane.end(), shown.begin(),
                   [](std::uint8_t found) { return found == CM_NO_FACE ? 0.0f : 1.0f; });
    return shown;
}

// The second image as the first one would show it, by the quintic spline.
void lay_over(Pictures &pictures, const cm_surface &from, std::uint32_t width, std::uint32_t height,
              unsigned threads)
{
    cm_plan_options options = {};
    options.size = sizeof options;
    options.filter = CM_FILTER_BSPLINE5;
    cm_plan *plan = nullptr;
    cm_source *source = nullptr;
    std::vector<float> laid(pictures.reference.size());
    const cm_image image = image_of(pictures.picture, width, height, pictures.channels);
    cm_image to = image_of(laid, pictures.width, pictures.height, pictures.channels);
    cm_status status = cm_plan_create(&from, pictures.surface.get(), &options, &plan);
    const std::shared_ptr<cm_plan> owned_plan(plan, cm_plan_destroy);
    status =
        status != CM_OK ? status : cm_source_create(plan, &image, CM_PIXEL_FLOAT, threads, &source);
    const std::shared_ptr<cm_source> owned_source(source, cm_source_destroy);
    status = status != CM_OK ? status : cm_resample_source(plan, source, &to, cm_rows{}, threads);
    if (status != CM_OK)
    {
        throw Failure(in_quotes(pictures.picture_name) + ": " + cm_status_text(status));
    }
    pictures.picture = std::move(laid);
}

// Failure if the images can be compared in no way.
void check_alike(const ComparedFiles &a, const ComparedFiles &b, bool on_sphere)
{
    const bool same_size = a.width() == b.width() && a.height() == b.height();
    if ((!on_sphere && !same_size) || a.channels() != b.channels())
    {
        throw Failure(a.size_text() + ", " + b.size_text() + "; they must be alike" +
                      (a.channels() == b.channels()
                           ? ", or --surface and --reference-surface say what they are"
                           : ""));
    }
    if (a.channels() > CM_CHANNELS_MAX)
    {
        throw Failure(a.size_text() + "; " + std::to_string(CM_CHANNELS_MAX) + " are the most");
    }
}

// Is it known where on the sphere both are, and does that count? Images of one size are compared pixel by pixel, as ever.
bool are_on_sphere(const ComparedFiles &a, const ComparedFiles &b, const Surfaces &surfaces)
{
    if (!surfaces.reference.empty() || !surfaces.picture.empty())
    {
        return true;
    }
    const bool same_size = a.width() == b.width() && a.height() == b.height();
    return same_size ? (a.is_six() || b.is_six()) && a.is_told() && b.is_told()
                     : a.is_told() || b.is_told();
}

// The same places, and so nothing to resample.
bool are_the_same(const cm_surface &a, const cm_surface &b, const Places &places)
{
    const std::string one = cm_surface_specification(&a);
    const std::array<std::vector<double>, 3> here = directions_of(a, places, 0.5, 0.5);
    return one == cm_surface_specification(&b) && here == directions_of(b, places, 0.5, 0.5);
}

// What only one image shows, or none, is in windows of what both show: there they are alike.
void fill_beside(Pictures &pictures)
{
    const std::size_t channels = pictures.channels;
    for (std::size_t i = 0; i < pictures.shown.size(); ++i)
    {
        if (!(pictures.shown[i] > 0.0f))
        {
            const auto from =
                pictures.reference.begin() + static_cast<std::ptrdiff_t>(i * channels);
            std::copy_n(from, channels,
                        pictures.picture.begin() + static_cast<std::ptrdiff_t>(i * channels));
        }
    }
}

void lay_on_sphere(Pictures &pictures, ComparedFiles &b, const cm_surface &from, unsigned threads)
{
    const Places places = places_of(*pictures.surface);
    pictures.areas = areas_of(*pictures.surface, places);
    pictures.shown = shown_by(*pictures.surface, from, places);
    if (!are_the_same(*pictures.surface, from, places))
    {
        lay_over(pictures, from, static_cast<std::uint32_t>(b.width()),
                 static_cast<std::uint32_t>(b.height()), threads);
    }
    fill_beside(pictures);
}

} // namespace

Pictures read_pictures(const std::string &reference, const std::string &picture,
                       const Surfaces &surfaces, unsigned threads)
{
    ComparedFiles a(reference, "--reference-surface", surfaces.reference);
    ComparedFiles b(picture, "--surface", surfaces.picture);
    const bool on_sphere = are_on_sphere(a, b, surfaces);
    if (on_sphere)
    {
        a.open_placed();
        b.open_placed();
    }
    check_alike(a, b, on_sphere);
    Pictures pictures;
    pictures.reference_name = reference;
    pictures.picture_name = picture;
    pictures.width = static_cast<std::uint32_t>(a.width());
    pictures.height = static_cast<std::uint32_t>(a.height());
    pictures.channels = static_cast<std::uint32_t>(a.channels());
    for (int channel = 0; channel < a.channels(); ++channel)
    {
        pictures.channel_names.emplace_back(a.channel_name(channel));
    }
    pictures.integers = a.holds_integers() && b.holds_integers();
    if ((a.holds_light() && b.holds_curve()) || (a.holds_curve() && b.holds_light()))
    {
        pictures.warnings.push_back(in_quotes(a.holds_light() ? reference : picture) +
                                    " holds light, " +
                                    in_quotes(a.holds_light() ? picture : reference) +
                                    " numbers with sRGB's curve; they are compared as they stand");
    }
    std::shared_ptr<const cm_surface> from;
    if (on_sphere)
    {
        pictures.surface = a.surface();
        from = b.surface();
    }
    else if (a.told() != b.told() && !a.told().empty() && !b.told().empty())
    {
        pictures.warnings.push_back(in_quotes(reference) + " says that it is " + a.told() + ", " +
                                    in_quotes(picture) + " " + b.told() +
                                    "; their pixels are compared as they stand, unless --surface "
                                    "says what B is");
    }
    for (const ComparedFiles *const files : {&a, &b})
    {
        pictures.warnings.insert(pictures.warnings.end(), files->warnings().begin(),
                                 files->warnings().end());
    }
    pictures.reference = a.pixels();
    pictures.picture = b.pixels();
    if (on_sphere)
    {
        lay_on_sphere(pictures, b, *from, threads);
    }
    else if (pictures.width == 2 * std::uint64_t{pictures.height})
    {
        pictures.areas.resize(pictures.height);
        cm_equirect_weights(pictures.width, pictures.height, pictures.areas.data());
    }
    return pictures;
}

cm_image image_of(std::vector<float> &values, std::uint32_t width, std::uint32_t height,
                  std::uint32_t channels)
{
    cm_image image = {};
    image.size = sizeof image;
    image.data = values.data();
    image.type = CM_PIXEL_FLOAT;
    image.width = width;
    image.height = height;
    image.channels = channels;
    return image;
}

void check_difference_name(const std::string &name, const std::vector<std::string> &others)
{
    const std::string format = output_format(name);
    if (format != "png" && format != "jpeg" && format != "tiff")
    {
        throw UsageFailure("--difference: " + in_quotes(name) +
                           ": the name must end in .png, .jpg or .tif");
    }
    for (const std::string &other : others)
    {
        if (name == other || same_file(name, other))
        {
            throw UsageFailure("--difference: " + in_quotes(name) +
                               " is an image that is compared; give it another name");
        }
    }
}

void write_difference(const std::string &name, std::uint32_t width, std::uint32_t height,
                      const std::vector<float> &colors)
{
    const std::string format = output_format(name);
    ImageDescription description(3, CM_PIXEL_U8);
    description.color = CM_IMAGE_COLOR_SRGB;
    std::vector<std::unique_ptr<AtomicFile>> files;
    files.push_back(std::make_unique<AtomicFile>(name));
    ImageWriter writer(plan_image(format, description, format, name), static_cast<int>(width),
                       static_cast<int>(height), name, *files.back());
    writer.write(0, static_cast<int>(height), colors.data(), 3);
    writer.close();
    appear_together(files);
}
