// SPDX-License-Identifier: MIT

#include "output_surface.hpp"
#include "picture_density.hpp"
#include "reproject_table.h"
#include "tools/cli/circle.hpp"
#include "tools/cli/program.hpp"
#include "tools/image/chart_image.hpp"

#include <algorithm>
#include <cmath>

namespace
{

// A picture to measure densities with.
constexpr int measured_picture_size = 512;

std::string with_size(const std::string &specification, int size)
{
    return kind_of(specification) == "healpix" ? "healpix:" + std::to_string(size)
                                               : specification + ";size=" + std::to_string(size);
}

// --border in the key layout.
std::string with_border(const std::string &specification, int border)
{
    const std::string layout = key_of(specification, "layout");
    if (layout.find(':') != std::string::npos)
    {
        throw UsageFailure("--border: the layout " + layout +
                           " has a border or turned faces; "
                           "leave one out");
    }
    const std::string bordered = without_key(specification, "layout") + ";layout=" + layout +
                                 ":border=" + std::to_string(border);
    if (cm_surface_check(bordered.c_str(), nullptr, nullptr, 0) != CM_OK)
    {
        throw UsageFailure("--border is for the layouts faces, strip, column, 3x2 and 2x3, not " +
                           layout + ", whose faces join");
    }
    return bordered;
}

std::string name_for_people(const std::string &specification)
{
    return is_whole_equirect(specification) ? "equirectangular" : head_of(specification);
}

// Nobody else asks for them.
void check_frames(const Options &options, const std::string &to, const std::string &from)
{
    if (!options.from.frame.empty() && !is_cube(from))
    {
        throw UsageFailure("--from-frame is for a cube, but INPUT is " + name_for_people(from) +
                           "; leave it out");
    }
    if (!options.to.frame.empty() && !is_cube(to) && !is_cube(from))
    {
        throw UsageFailure("--frame is for a cube, but INPUT is " + name_for_people(from) +
                           " and OUTPUT " + name_for_people(to) + "; leave it out");
    }
}

// Without a size, if the command line has none.
std::string wanted_specification(const Options &options, const Input &input)
{
    const SurfaceOptions &to = options.to;
    const bool from_equirect = kind_of(cm_surface_specification(&input.surface())) == "equirect";
    std::string text = !to.specification.empty() ? to.specification
                       : from_equirect           ? "cube"
                                                 : "equirect";
    check_frames(options, text, cm_surface_specification(&input.surface()));
    if (!is_cube(text))
    {
        if (!to.layout.empty())
        {
            throw UsageFailure(
                "--layout is for a cube, but OUTPUT is " + name_for_people(text) +
                (to.specification.empty() ? "; say --to cube if it is to be a cube" : ""));
        }
        if (options.border > 0)
        {
            throw UsageFailure("--border is for the faces of a cube, but OUTPUT is " +
                               name_for_people(text));
        }
        return text;
    }
    text += key_of(text, "frame").empty() ? ";frame=" + (to.frame.empty() ? "geo" : to.frame) : "";
    text += key_of(text, "layout").empty() ? ";layout=" + (to.layout.empty() ? "faces" : to.layout)
                                           : "";
    return options.border > 0 ? with_border(text, options.border) : text;
}

bool has_span(const std::string &specification)
{
    return is_whole_equirect(specification) || is_cube(specification) || is_chart(specification);
}

// The edge of a square of the unit sphere that has as many pixels as the picture has along its width: at
// the equator, and of a chart in the mean.
double span(const std::string &specification)
{
    if (is_whole_equirect(specification))
    {
        return 2 * pi;
    }
    return is_cube(specification)
               ? pi / 2
               : 2 / std::sqrt(ChartImage(head_of(specification), 1).mean_scale());
}

// Degrees from the western edge to the eastern one.
double lon_span(const std::string &equirect)
{
    return read_number(key_of(equirect, "east")).value_or(180) -
           read_number(key_of(equirect, "west")).value_or(-180);
}

PictureDensity measured_density(const std::string &specification)
{
    std::string message;
    const SurfacePointer measured =
        make_surface(with_size(specification, measured_picture_size), 0, 0, std::nullopt, message);
    if (!measured)
    {
        throw UsageFailure(in_quotes(specification) + ": " + message);
    }
    return density_of(*measured);
}

// With the same resolution as the input.
double natural_size(const std::string &specification, Keep keep, const Input &input)
{
    const std::string from = cm_surface_specification(&input.surface());
    if (keep == Keep::equator && has_span(from) && has_span(specification))
    {
        return cm_surface_plane_width(&input.surface()) / span(from) * span(specification);
    }
    if (keep == Keep::equator && kind_of(from) == "equirect" &&
        kind_of(specification) == "equirect")
    {
        return cm_surface_plane_width(&input.surface()) / lon_span(from) * lon_span(specification);
    }
    const PictureDensity source = density_of(input.surface());
    const PictureDensity target = measured_density(specification);
    const double ratio =
        keep == Keep::most ? source.most / target.least : std::sqrt(source.mean / target.mean);
    if (!std::isfinite(ratio))
    {
        throw UsageFailure("OUTPUT, " + in_quotes(specification) +
                           ", has places that are infinitely small; say --size");
    }
    return measured_picture_size * ratio;
}

int largest_size(const std::string &specification)
{
    return is_cube(specification) || is_chart(specification) ? REPROJECT_FACE_MAX
                                                             : REPROJECT_EQUIRECT_MAX;
}

// A size that the kind can have.
int chosen_size(const std::string &specification, Keep keep, const Input &input)
{
    const double natural = natural_size(specification, keep, input);
    const double most = largest_size(specification);
    const double rounded = keep == Keep::most ? std::ceil(natural - 1e-6) : std::round(natural);
    int size = static_cast<int>(std::clamp(rounded, 1.0, most));
    if (kind_of(specification) == "healpix")
    {
        int power = 1;
        while (power < size && power < 8192)
        {
            power *= 2;
        }
        return power;
    }
    std::string message;
    const auto can_be = [&](int wanted) {
        return make_surface(with_size(specification, wanted), 0, 0, std::nullopt, message) !=
               nullptr;
    };
    // circles side by side need an even width, too
    const bool odd =
        is_whole_equirect(specification) ? size % 2 != 0 : !can_be(size) && can_be(size + 1);
    return odd ? size + 1 : size;
}

int output_size(const std::string &specification, const Options &options, const Input &input)
{
    const int size = options.size ? *options.size : chosen_size(specification, options.keep, input);
    if (size > largest_size(specification))
    {
        throw UsageFailure("--size: " + std::to_string(size) + " is too large; the " +
                           (is_cube(specification)    ? "edge of a face"
                            : is_chart(specification) ? "edge of a square image"
                                                      : "width of an equirectangular image") +
                           " may be " + std::to_string(largest_size(specification)) + " at most");
    }
    if (is_whole_equirect(specification) && size % 2 != 0)
    {
        throw UsageFailure("--size: " + std::to_string(size) +
                           " is odd; the width of an equirectangular image must be even");
    }
    return size;
}

} // namespace

SurfacePointer output_surface(const Options &options, const Input &input)
{
    const std::string wanted = wanted_specification(options, input);
    std::string message;
    SurfacePointer whole = make_surface(wanted, 0, 0, options.to.rotation, message);
    if (whole)
    {
        if (options.size || options.keep != Keep::equator)
        {
            throw UsageFailure(std::string(options.size ? "--size" : "--keep") + ": OUTPUT, " +
                               in_quotes(wanted) + ", has a size already; leave one out");
        }
        return whole;
    }
    const std::string sized = with_size(wanted, output_size(wanted, options, input));
    whole = make_surface(sized, 0, 0, options.to.rotation, message);
    if (!whole)
    {
        throw UsageFailure("OUTPUT, " + in_quotes(sized) + ": " + message);
    }
    return whole;
}
