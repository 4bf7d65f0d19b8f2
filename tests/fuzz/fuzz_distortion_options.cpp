// SPDX-License-Identifier: MIT
//
// The command line of cubemap-distortion, and the scale of colours and the lines that it asks for. Input:
// an argument a line.

#include "tools/distortion/colors.hpp"
#include "tools/distortion/distortion_options.hpp"
#include "tools/distortion/distortion_table.h"
#include "tools/image/graticule.hpp"

#include "fuzz_arguments.h"

#include <cmath>

namespace
{

void check_scale(const DistortionOptions &options)
{
    const ValueRange range = options.range.value_or(options.quantity->range);
    const ColorScale scale(*options.quantity, range, options.reverse);
    const double values[] = {
        range.low, range.high, scale.value_at(0.5), 0, options.quantity->middle, HUGE_VAL};
    for (const double value : values)
    {
        const double place = scale.place(value);
        EXPECT(place >= 0 && place <= 1, "%g of %g:%g is at %g", value, range.low, range.high,
               place);
    }
    EXPECT(std::isnan(scale.place(NAN)), "a place for NaN");
    EXPECT(!scale.description().empty(), "no description");
}

// A picture of four pixels a radian, at places around both poles and the antimeridian.
void check_graticule(double degrees)
{
    const Graticule graticule(degrees);
    for (int i = -8; i <= 8; ++i)
    {
        const double lat = 1.5707963267948966 * i / 8;
        const double lon = 0.7853981633974483 * i;
        const double cosine = std::cos(lat);
        const MovingDirection point = {
            {cosine * std::cos(lon), cosine * std::sin(lon), std::sin(lat)},
            {-0.25 * std::sin(lon), 0.25 * std::cos(lon), 0},
            {-0.25 * std::sin(lat) * std::cos(lon), -0.25 * std::sin(lat) * std::sin(lon),
             0.25 * cosine}};
        const double distance = graticule.distance(point);
        EXPECT(distance >= 0 && distance <= 4 * 3.1415926535897931, "%g pixels from a line of %g",
               distance, degrees);
    }
}

void check_options(const DistortionOptions &options)
{
    EXPECT(options.frame != nullptr && options.quantity != nullptr, "no frame or quantity");
    EXPECT(cm_specification_check(options.mapping.c_str(), nullptr, 0) == CM_OK, "mapping '%s'",
           options.mapping.c_str());
    EXPECT(options.size >= 1 && options.size <= DISTORTION_FACE_MAX, "size %d", options.size);
    EXPECT(!options.face || (*options.face >= 0 && *options.face <= 5), "no such face");
    EXPECT(!(options.face && options.layout), "face and layout");
    EXPECT(!options.isolines || *options.isolines > 0, "isolines");
    EXPECT(options.threads >= 0 && options.threads <= 1024, "%d threads", options.threads);
    if (options.printed)
    {
        return;
    }
    check_scale(options);
    check_colors("--colors", options.colors);
    if (options.overlay.graticule && *options.overlay.graticule >= 1)
    {
        check_graticule(*options.overlay.graticule);
    }
    EXPECT(options.overlay.line_width >= 0.1, "line width %g", options.overlay.line_width);
    for (const float channel : options.overlay.line_color)
    {
        EXPECT(channel >= 0 && channel <= 1.00001f, "line colour %g", double(channel));
    }
}

} // namespace

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static std::FILE *const null = std::fopen("/dev/null", "w");
    const cm_streams nowhere = {stdin, null, null};
    arguments given = read_arguments("cubemap-distortion", data, size);
    try
    {
        check_options(parse_distortion_options(given.count, given.argument, nowhere));
    }
    catch (const UsageFailure &failure)
    {
        EXPECT(failure.exit_status() == exit_usage && is_one_line(failure.what()) &&
                   *failure.what() != '\0',
               "'%s'", failure.what());
    }
    drop_arguments(&given);
    return 0;
}
