// SPDX-License-Identifier: MIT

#include "compare_measures.hpp"
#include "tools/cli/circle.hpp"
#include "tools/cli/program.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace
{

constexpr std::size_t points_at_a_time = 4096;

cm_error_figures empty_errors()
{
    cm_error_figures figures = {};
    figures.size = sizeof figures;
    return figures;
}

cm_map_figures empty_map()
{
    cm_map_figures figures = {};
    figures.size = sizeof figures;
    return figures;
}

void need_equirect(const Pictures &pictures, const std::string &what)
{
    if (pictures.areas.empty())
    {
        throw Failure(in_quotes(pictures.reference_name) + " is " + std::to_string(pictures.width) +
                      " x " + std::to_string(pictures.height) + "; " + what +
                      " is for equirectangular images, twice as wide as high, or those of "
                      "--reference-surface");
    }
}

void need_light(const Pictures &pictures)
{
    if (pictures.integers)
    {
        throw Failure(in_quotes(pictures.reference_name) +
                      " holds integers; hdr-flip is for linear light in floats, say flip");
    }
}

// The pictures and options as the library has them; what they point to belongs to Pictures.
struct Task
{
    cm_image reference;
    cm_image picture;
    std::vector<float> area; // solid angles, of what is shown
    std::vector<float> shown;
    cm_image weights;
    cm_image shown_weights;
    cm_compare_options options = {};

    Task(const CompareOptions &wanted, Pictures &pictures)
        : reference(
              image_of(pictures.reference, pictures.width, pictures.height, pictures.channels)),
          picture(image_of(pictures.picture, pictures.width, pictures.height, pictures.channels)),
          area(pictures.areas), shown(pictures.shown),
          weights(image_of(area, shown.empty() ? 1 : pictures.width, pictures.height, 1)),
          shown_weights(image_of(shown, pictures.width, pictures.height, 1))
    {
        for (std::size_t i = 0; i < shown.size(); ++i)
        {
            area[i] *= shown[i];
        }
        options.size = sizeof options;
        options.weights = wanted.by_area ? &weights : !shown.empty() ? &shown_weights : nullptr;
        options.border = wanted.border;
        options.not_finite = wanted.skip_not_finite ? CM_COMPARE_SKIP : CM_COMPARE_REFUSE;
        const double unit = pictures.integers ? 255 : 1;
        options.peak = wanted.peak_of_reference ? 0 : wanted.peak.value_or(unit) / unit;
        options.pixels_per_degree = wanted.pixels_per_degree;
        options.linear = !pictures.integers;
        options.threads = wanted.threads;
    }
    Task(const Task &) = delete;
    Task &operator=(const Task &) = delete;
};

void check(cm_status status, const std::string &what)
{
    if (status == CM_ERROR_RANGE)
    {
        throw Failure(what + ": there are pixels that are not finite; --skip-not-finite leaves "
                             "them out");
    }
    if (status != CM_OK)
    {
        throw Failure(what + ": " + cm_status_text(status));
    }
}

// Of single values, what is not finite has an error, unless it is left out.
cm_error_figures errors_of(const Task &task, const cm_image *weights)
{
    cm_error_figures figures = empty_errors();
    cm_compare_options options = task.options;
    options.weights = weights;
    options.not_finite =
        options.not_finite == CM_COMPARE_REFUSE ? CM_COMPARE_ALIKE : options.not_finite;
    check(cm_compare_errors(&task.reference, &task.picture, &options, &figures), "errors");
    return figures;
}

// The pixel of a picture that a direction is in, or how many there are if it is in none that counts.
std::size_t pixel_on(const Pictures &pictures, double x, double y, double z)
{
    const std::size_t none = std::size_t{pictures.width} * pictures.height;
    const cm_surface &surface = *pictures.surface;
    std::uint8_t plane = CM_NO_FACE;
    double column = 0;
    double row = 0;
    cm_surface_positions(&surface, 1, &x, &y, &z, &plane, &column, &row);
    if (plane == CM_NO_FACE)
    {
        return none;
    }
    std::uint32_t picture = 0;
    std::uint32_t right = 0;
    std::uint32_t down = 0;
    const double last_column = cm_surface_plane_width(&surface) - 1.0;
    const double last_row = cm_surface_plane_height(&surface) - 1.0;
    cm_surface_pixel(&surface, plane, static_cast<std::uint32_t>(std::fmin(column, last_column)),
                     static_cast<std::uint32_t>(std::fmin(row, last_row)), &picture, &right, &down);
    const std::size_t at = std::size_t{down} * pictures.width + right;
    return pictures.shown[at] > 0.0f ? at : none;
}

// The same of an equirectangular picture.
std::size_t pixel_at(const Pictures &pictures, double x, double y, double z)
{
    if (pictures.surface)
    {
        return pixel_on(pictures, x, y, z);
    }
    const double column = (std::atan2(y, x) / (2 * pi) + 0.5) * pictures.width;
    const double row = (0.5 - std::atan2(z, std::hypot(x, y)) / pi) * pictures.height;
    const auto last_column = static_cast<double>(pictures.width - 1);
    const auto last_row = static_cast<double>(pictures.height - 1);
    return static_cast<std::size_t>(std::clamp(std::floor(row), 0.0, last_row)) * pictures.width +
           static_cast<std::size_t>(std::clamp(std::floor(column), 0.0, last_column));
}

cm_error_figures errors_at_points(const Task &task, const Pictures &pictures)
{
    std::vector<float> reference;
    std::vector<float> picture;
    std::vector<double> place(3 * points_at_a_time);
    const std::size_t channels = pictures.channels;
    reference.reserve(channels * CM_SPHERE_POINTS);
    picture.reserve(channels * CM_SPHERE_POINTS);
    for (std::size_t first = 0; first < CM_SPHERE_POINTS; first += points_at_a_time)
    {
        const std::size_t count = std::min(points_at_a_time, CM_SPHERE_POINTS - first);
        double *const x = place.data();
        double *const y = x + points_at_a_time;
        double *const z = y + points_at_a_time;
        check(cm_sphere_points(CM_SPHERE_POINTS, first, count, x, y, z), "s-psnr");
        for (std::size_t i = 0; i < count; ++i)
        {
            const std::size_t pixel = pixel_at(pictures, x[i], y[i], z[i]);
            if (pixel == std::size_t{pictures.width} * pictures.height)
            {
                continue;
            }
            const std::size_t from = channels * pixel;
            const float *const one = pictures.reference.data() + from;
            const float *const other = pictures.picture.data() + from;
            reference.insert(reference.end(), one, one + channels);
            picture.insert(picture.end(), other, other + channels);
        }
    }
    cm_error_figures figures = empty_errors();
    cm_compare_options options = task.options;
    options.weights = nullptr;
    options.border = 0;
    options.not_finite =
        options.not_finite == CM_COMPARE_REFUSE ? CM_COMPARE_ALIKE : options.not_finite;
    check(cm_compare_values(reference.size() / channels, pictures.channels, reference.data(),
                            picture.data(), &options, &figures),
          "s-psnr");
    return figures;
}

} // namespace

Measured measure(const CompareOptions &options, Pictures &pictures)
{
    const Task task(options, pictures);
    const auto wants = [&options](int which)
    { return !options.quiet && options.measure[static_cast<std::size_t>(which)]; };
    Measured measured;
    if (options.by_area)
    {
        need_equirect(pictures, "--by-area");
    }
    measured.errors = errors_of(task, task.options.weights);
    if (wants(MEASURE_WS_PSNR))
    {
        need_equirect(pictures, "ws-psnr");
        measured.by_area = errors_of(task, &task.weights);
    }
    if (wants(MEASURE_S_PSNR))
    {
        need_equirect(pictures, "s-psnr");
        measured.at_points = errors_at_points(task, pictures);
    }
    if (wants(MEASURE_SSIM))
    {
        measured.ssim = empty_map();
        check(cm_ssim(&task.reference, &task.picture, &task.options, &*measured.ssim, nullptr,
                      nullptr),
              "ssim");
    }
    if (wants(MEASURE_FLIP))
    {
        measured.flip = empty_map();
        check(cm_flip(&task.reference, &task.picture, &task.options, &*measured.flip, nullptr),
              "flip");
    }
    if (wants(MEASURE_HDR_FLIP))
    {
        need_light(pictures);
        measured.hdr_flip = empty_map();
        check(cm_flip_hdr(&task.reference, &task.picture, &task.options, &*measured.hdr_flip,
                          nullptr),
              "hdr-flip");
    }
    return measured;
}

namespace
{

// Is a pixel inside the border?
bool counts(const CompareOptions &options, const Pictures &pictures, std::size_t pixel)
{
    const std::size_t x = pixel % pictures.width;
    const std::size_t y = pixel / pictures.width;
    const std::size_t border = options.border;
    return x >= border && y >= border && x + border < pictures.width &&
           y + border < pictures.height;
}

} // namespace

std::vector<float> difference_map(const CompareOptions &options, Pictures &pictures,
                                  double *highest)
{
    const Task task(options, pictures);
    std::vector<float> map(std::size_t{pictures.width} * pictures.height);
    const cm_image to = image_of(map, pictures.width, pictures.height, 1);
    cm_map_figures figures = empty_map();
    figures.highest = std::numeric_limits<double>::quiet_NaN();
    switch (options.difference_of)
    {
    case DIFFERENCE_SSIM:
        check(cm_ssim(&task.reference, &task.picture, &task.options, &figures, &to, nullptr),
              "ssim");
        break;
    case DIFFERENCE_FLIP:
        check(cm_flip(&task.reference, &task.picture, &task.options, &figures, &to), "flip");
        break;
    case DIFFERENCE_HDR_FLIP:
        need_light(pictures);
        check(cm_flip_hdr(&task.reference, &task.picture, &task.options, &figures, &to),
              "hdr-flip");
        break;
    default:
        check(cm_difference_map(&task.reference, &task.picture, options.threads, &to), "errors");
        for (std::size_t i = 0; i < map.size(); ++i)
        {
            const bool is_shown = pictures.shown.empty() || pictures.shown[i] > 0.0f;
            map[i] = is_shown && counts(options, pictures, i)
                         ? map[i] * (pictures.integers ? 255.0f : 1.0f)
                         : std::numeric_limits<float>::quiet_NaN();
            figures.highest = std::fmax(figures.highest, static_cast<double>(map[i]));
        }
        break;
    }
    *highest = figures.highest;
    return map;
}
