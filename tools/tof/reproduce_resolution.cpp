// SPDX-License-Identifier: MIT
//
// Lambers, Hoberg and Kolb 2015, figure 7: how fine single readout of 8 um and dual readout of 12 um see, by a slanted edge.

#include "reproduce.hpp"
#include "reproduce_stage.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

namespace
{

constexpr double slant = 5 * half_turn / 180; // from the vertical
constexpr double edge_near = 0.98, edge_far = 1.0;
constexpr double edge_focal = 3e-3;  // metres, of both
constexpr double edge_side = 1.2e-3; // metres of the sensor
constexpr double edge_bin = 1e-6;    // metres
constexpr int edge_bins = 400;
constexpr double edge_part = 0.25e-6; // metres of a pixel, a sample each

// How distances go from the near to the far one across the edge, by the place on the sensor across it: of all pixels, as
// the standard of slanted edges has it, in edge_bins that are finer than pixels.
std::vector<double> edge_profile(bool is_single, double pitch, double circuit)
{
    const std::uint32_t count = static_cast<std::uint32_t>(std::lround(edge_side / pitch));
    const TofPointer<cm_camera> camera =
        make_pinhole(count, count, 2 * std::atan(0.5 * count * pitch / edge_focal));
    cm_tof_sensor sensor = plain_sensor(camera.get());
    sensor.pitch = pitch;
    sensor.single_readout = is_single;
    const std::vector<float> mask = layout_mask(is_single, pitch, circuit, edge_part);
    sensor.mask_columns = static_cast<std::uint32_t>(mask.size());
    sensor.mask_rows = 1;
    sensor.mask = mask.data();
    cm_primitive block = box_between(-2, -2, 0, 0, 2, 0.01, 0.8);
    const TofPointer<cm_trajectory> turned = []
    {
        const double place[3] = {0, 0, edge_near};
        const double turn[4] = {0, 0, std::sin(0.5 * slant), std::cos(0.5 * slant)};
        cm_pose pose;
        need(cm_pose_from_quaternion(place, turn, &pose));
        const double stamp = 0;
        cm_trajectory *made = nullptr;
        need(cm_trajectory_create(1, &stamp, &pose, &made, nullptr));
        return TofPointer<cm_trajectory>(made);
    }();
    block.motion = turned.get();
    cm_tof_options options = {};
    options.size = sizeof options;
    options.sample_columns = sensor.mask_columns;
    options.sample_rows = 8;
    const std::vector<float> distance =
        distances(make_stage({plane_at(0, 0, edge_far, 0, 0, 1, 0.8), block}).get(), sensor,
                  plain_light(), nullptr, 0, options, nullptr);
    std::vector<double> sum(edge_bins, 0), weight(edge_bins, 0);
    const cm_camera_options &shape = *cm_camera_describe(camera.get());
    for (std::size_t i = 0; i < distance.size(); ++i)
    {
        const double x = (static_cast<double>(i % count) + 0.5 - shape.cx) / shape.fx;
        const double y = (static_cast<double>(i / count) + 0.5 - shape.cy) / shape.fy;
        const double depth = static_cast<double>(distance[i]) / std::sqrt(1 + x * x + y * y);
        const double across = (x * std::cos(slant) + y * std::sin(slant)) * edge_focal;
        const int at = static_cast<int>(std::floor(across / edge_bin)) + edge_bins / 2;
        if (at >= 0 && at < edge_bins)
        {
            sum[static_cast<std::size_t>(at)] += depth;
            weight[static_cast<std::size_t>(at)] += 1;
        }
    }
    for (std::size_t i = 0; i < sum.size(); ++i)
    {
        sum[i] = weight[i] > 0 ? sum[i] / weight[i] : i > 0 ? sum[i - 1] : edge_near;
    }
    return sum;
}

// The transfer function: the Fourier transform of the profile's derivative, by cycles a millimetre of the sensor.
ChartCurve transfer_of(const std::string &name, const std::vector<double> &profile)
{
    ChartCurve curve = {name, {}, {}};
    for (int cycles = 0; cycles <= 80; cycles += 2)
    {
        std::complex<double> sum = 0;
        for (int i = 1; i < edge_bins; ++i)
        {
            const double window = 0.5 - 0.5 * std::cos(2 * half_turn * i / edge_bins);
            const double place = (i - edge_bins / 2) * edge_bin * 1e3;
            sum +=
                window *
                (profile[static_cast<std::size_t>(i)] - profile[static_cast<std::size_t>(i - 1)]) *
                std::polar(1.0, -2 * half_turn * cycles * place);
        }
        curve.x.push_back(cycles);
        curve.y.push_back(std::abs(sum));
    }
    const double whole = curve.y.front();
    for (double &value : curve.y)
    {
        value /= whole;
    }
    return curve;
}

double value_at(const ChartCurve &curve, double x)
{
    const auto above = std::lower_bound(curve.x.begin(), curve.x.end(), x);
    const std::size_t i = static_cast<std::size_t>(above - curve.x.begin());
    const double part = (x - curve.x[i - 1]) / (curve.x[i] - curve.x[i - 1]);
    return curve.y[i - 1] + part * (curve.y[i] - curve.y[i - 1]);
}

} // namespace

Reproduction reproduce_resolution(const ReproduceSettings &settings)
{
    Reproduction made;
    const double nyquist = 1e-3 / (2 * 12e-6);
    Chart chart = {"layouts-figure-7",
                   "Transfer of a slanted edge",
                   "cycles a mm on the sensor",
                   "modulation",
                   false,
                   {},
                   {}};
    struct Line
    {
        double circuit; // metres
        const char *what;
    };
    constexpr Line lines[] = {{0, "of pixels that see everywhere"},
                              {0.5e-6, "with circuits of 0.5 um that see nothing"},
                              {1e-6, "with circuits of 1 um"},
                              {2e-6, "with circuits of 2 um, as figures 9 and 10 have here"}};
    for (const Line &line : lines)
    {
        settings.tell(std::string("slanted edges, ") + line.what);
        const std::string with =
            line.circuit > 0 ? ", circuits of " + text_of_number(1e6 * line.circuit, 2) + " um"
                             : "";
        const ChartCurve dual =
            transfer_of("dual readout, 12 um" + with, edge_profile(false, 12e-6, line.circuit));
        const ChartCurve single =
            transfer_of("single readout, 8 um" + with, edge_profile(true, 8e-6, line.circuit));
        made.rows.push_back(
            {std::string(
                 "fig. 7: at the Nyquist frequency of 12 um single readout of 8 um transfers "
                 "more, ") +
                 line.what,
             "better",
             text_of_number(value_at(dual, nyquist), 3) + " dual, " +
                 text_of_number(value_at(single, nyquist), 3) + " single",
             value_at(single, nyquist) > value_at(dual, nyquist)});
        if (line.circuit == 0 || line.circuit == 2e-6)
        {
            chart.curves.push_back(dual);
            chart.curves.push_back(single);
        }
    }
    made.charts.push_back(chart);
    return made;
}
