// SPDX-License-Identifier: MIT
//
// Lambers, Hoberg and Kolb, Simulation of Time-of-Flight Sensors for Evaluation of Chip Layout Variants, 2015: figures 6, 9
// and 10, and the number of pixels that a moving edge sweeps.

#include "reproduce.hpp"
#include "reproduce_stage.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace
{

constexpr double layout_aperture = 70 * half_turn / 180;
constexpr double near_depth = 0.6;
constexpr double far_depth = 1.5;
constexpr double affected_apart = 0.001;
constexpr int layout_frames = 26;

// A layout with its camera.
struct Layout
{
    TofPointer<cm_camera> camera;
    std::vector<float> mask;
    cm_tof_sensor sensor;
};

constexpr double layout_circuit = 2e-6;
constexpr double narrow_circuit = 0.5e-6; // with which figure 7 is as in the paper

Layout make_layout(bool is_single, double pitch, double circuit = layout_circuit)
{
    const double part = circuit < 1e-6 ? circuit : 1e-6;
    const std::uint32_t columns = pitch < 10e-6 ? 384 : 256;
    Layout made = {make_pinhole(columns, columns / 4 * 3, layout_aperture),
                   layout_mask(is_single, pitch, circuit, part),
                   {}};
    made.sensor = plain_sensor(made.camera.get());
    made.sensor.pitch = pitch;
    made.sensor.single_readout = is_single;
    made.sensor.mask_columns = static_cast<std::uint32_t>(made.mask.size());
    made.sensor.mask_rows = 1;
    made.sensor.mask = made.mask.data();
    return made;
}

// A sample for each part of the mask along rows, and steps in time that are the same for all layouts.
cm_tof_options options_of(const Layout &layout)
{
    cm_tof_options options = {};
    options.size = sizeof options;
    options.sample_columns = layout.sensor.mask_columns;
    options.sample_rows = 4;
    options.sample_times = 4;
    return options;
}

// How much of frames is affected.
struct Affected
{
    std::size_t pixels = 0;
    std::size_t rows = 0; // which have such pixels
};

// Pixels of a frame that have neither the depth of the object nor that of the wall. Of single readout a pixel's middle lies
// between those of its two circuits' areas, a quarter of the pitch to the right.
void count_affected(const Layout &layout, const std::vector<float> &distance, Affected &to)
{
    const cm_camera_options &shape = *cm_camera_describe(layout.camera.get());
    const double middle = layout.sensor.single_readout ? 0.75 : 0.5;
    for (std::uint32_t row = 0; row < shape.height; ++row)
    {
        std::size_t wrong = 0;
        for (std::uint32_t column = 0; column < shape.width; ++column)
        {
            const double x = (column + middle - shape.cx) / shape.fx;
            const double y = (row + 0.5 - shape.cy) / shape.fy;
            const double depth =
                static_cast<double>(distance[std::size_t{row} * shape.width + column]) /
                std::sqrt(1 + x * x + y * y);
            wrong += !(std::abs(depth - near_depth) <= affected_apart ||
                       std::abs(depth - far_depth) <= affected_apart);
        }
        to.pixels += wrong;
        to.rows += wrong > 0;
    }
}

// In all frames of 0.2 s. Each frame's object is a part of a pixel beside the one before, the same for all layouts and speeds, so
// that no figure depends on where in a pixel an edge lies.
Affected affected(const Layout &layout, const cm_primitive &object, const double velocity[3],
                  cm_pool *pool)
{
    const TofPointer<cm_trajectory> motion = make_line(velocity);
    Affected found;
    for (int frame = 0; frame < layout_frames; ++frame)
    {
        const double beside = 0.01 * std::fmod(0.618 * frame, 1.0);
        cm_primitive moved = object;
        moved.motion = motion.get();
        for (int k = 0; k < 2; ++k)
        {
            moved.first[k] += beside;
            moved.second[k] += beside;
        }
        const TofPointer<cm_tof_scene> scene =
            make_stage({plane_at(0, 0, far_depth, 0, 0, 1, 0.8), moved});
        const double time = (frame - 0.5 * layout_frames) * cm_tof_frame_time(&layout.sensor);
        count_affected(layout,
                       distances(scene.get(), layout.sensor, plain_light(), nullptr, time,
                                 options_of(layout), pool),
                       found);
    }
    return found;
}

// 10 x 50 cm, thin, at 60 cm.
cm_primitive rectangle(double width, double height)
{
    return box_between(-0.5 * width, -0.5 * height, near_depth, 0.5 * width, 0.5 * height,
                       near_depth + 1e-4, 0.8);
}

std::vector<double> speeds()
{
    std::vector<double> all;
    for (int speed = 0; speed <= 180; speed += 20)
    {
        all.push_back(speed);
    }
    return all;
}

// The part of all pixels, and if they are asked for the number of all frames' rows.
ChartCurve curve_of(const std::string &name, const Layout &layout, const cm_primitive &object,
                    int axis, double sign, const ReproduceSettings &settings, cm_pool *pool,
                    std::vector<double> *affected_rows = nullptr)
{
    ChartCurve curve = {name, speeds(), {}};
    const cm_camera_options &shape = *cm_camera_describe(layout.camera.get());
    const double pixels = static_cast<double>(shape.width) * shape.height * layout_frames;
    for (const double speed : curve.x)
    {
        settings.tell(name + ", " + text_of_number(speed, 3) + " cm/s");
        double velocity[3] = {0, 0, 0};
        velocity[axis] = sign * speed / 100;
        const Affected found = affected(layout, object, velocity, pool);
        curve.y.push_back(static_cast<double>(found.pixels) / pixels);
        if (affected_rows != nullptr)
        {
            affected_rows->push_back(static_cast<double>(found.rows));
        }
    }
    return curve;
}

bool rises(const std::vector<double> &values)
{
    return std::is_sorted(values.begin(), values.end()) && values.back() > values.front();
}

bool is_above(const std::vector<double> &one, const std::vector<double> &other)
{
    return std::equal(one.begin(), one.end(), other.begin(),
                      [](double a, double b) { return a > b; });
}

double mean_difference(const std::vector<double> &one, const std::vector<double> &other)
{
    double sum = 0;
    for (std::size_t i = 0; i < one.size(); ++i)
    {
        sum += one[i] - other[i];
    }
    return sum / static_cast<double>(one.size());
}

double most_difference(const std::vector<double> &one, const std::vector<double> &other)
{
    double most = 0;
    for (std::size_t i = 0; i < one.size(); ++i)
    {
        most = std::max(most, std::abs(one[i] - other[i]));
    }
    return most;
}

void reproduce_motion(const ReproduceSettings &settings, Reproduction &to)
{
    const PoolPointer pool = make_pool(settings.threads);
    const Layout dual = make_layout(false, 12e-6), single = make_layout(true, 8e-6),
                 coarse = make_layout(true, 12e-6);
    const cm_primitive tall = rectangle(0.1, 0.5), bar = rectangle(4.0, 0.1);
    const ChartCurve a = curve_of("dual, 12 um", dual, tall, 0, 1, settings, pool.get());
    const ChartCurve b = curve_of("single, 8 um", single, tall, 0, 1, settings, pool.get());
    const ChartCurve c = curve_of("single, 12 um", coarse, tall, 0, 1, settings, pool.get());
    const ChartCurve left =
        curve_of("single, 8 um, to the left", single, tall, 0, -1, settings, pool.get());
    std::vector<double> dual_rows, single_rows;
    const ChartCurve dual_down =
        curve_of("dual, down", dual, bar, 1, 1, settings, pool.get(), &dual_rows);
    const ChartCurve single_down =
        curve_of("single, down", coarse, bar, 1, 1, settings, pool.get(), &single_rows);
    to.charts.push_back({"layouts-figure-9-top",
                         "Pixels affected by motion, 12 um dual and 8 um single readout",
                         "speed in cm/s",
                         "part of the pixels",
                         false,
                         {a, b, left},
                         {}});
    to.charts.push_back({"layouts-figure-9-middle",
                         "Pixels affected by motion, both of 12 um",
                         "speed in cm/s",
                         "part of the pixels",
                         false,
                         {a, c},
                         {}});
    to.charts.push_back({"layouts-figure-9-bottom",
                         "Pixels affected by vertical motion, both of 12 um",
                         "speed in cm/s",
                         "part of the pixels",
                         false,
                         {dual_down, single_down},
                         {}});
    to.rows.push_back(
        {"fig. 9: at rest some pixels are affected, and more the faster it is", "so in all curves",
         text_of_number(a.y.front(), 3) + " to " + text_of_number(a.y.back(), 3) + " dual, " +
             text_of_number(b.y.front(), 3) + " to " + text_of_number(b.y.back(), 3) + " single",
         a.y.front() > 0 && b.y.front() > 0 && rises(a.y) && rises(b.y) && rises(c.y)});
    to.rows.push_back(
        {"fig. 9 top: single readout of 8 um is affected slightly more than dual of 12 um",
         "slightly", text_of_number(mean_difference(b.y, a.y), 3) + " more in the mean",
         is_above(b.y, a.y)});
    to.rows.push_back(
        {"fig. 9 middle: the difference is larger at equal pitch", "larger",
         text_of_number(mean_difference(c.y, a.y), 3) + " more in the mean",
         is_above(c.y, a.y) && mean_difference(c.y, a.y) > mean_difference(b.y, a.y)});
    to.rows.push_back(
        {"fig. 9 bottom: of vertical motion (a bar from rim to rim) both are the same",
         "exactly equal",
         "at most " + text_of_number(most_difference(dual_down.y, single_down.y), 3) + " apart",
         dual_down.y == single_down.y});
    // a mixed depth that is right by chance in some columns of a row is so in others of the other layout
    to.rows.push_back({"fig. 9 bottom: and rows with such pixels, of all frames", "exactly equal",
                       "at most " + text_of_number(most_difference(dual_rows, single_rows), 3) +
                           " of " + text_of_number(dual_rows.back(), 5) + " apart",
                       dual_rows == single_rows});
    to.rows.push_back({"motion to the left and to the right", "no significant difference",
                       "at most " + text_of_number(most_difference(b.y, left.y), 3) + " apart",
                       most_difference(b.y, left.y) < 0.05 * b.y.back()});
}

// One speed of figure 9, top, with narrow circuits.
void reproduce_narrow_circuits(const ReproduceSettings &settings, Reproduction &to)
{
    const PoolPointer pool = make_pool(settings.threads);
    const double velocity[3] = {1, 0, 0};
    double part[2];
    for (const bool is_single : {false, true})
    {
        settings.tell(std::string(is_single ? "single" : "dual") + ", circuits of 0.5 um");
        const Layout layout = make_layout(is_single, is_single ? 8e-6 : 12e-6, narrow_circuit);
        const cm_camera_options &shape = *cm_camera_describe(layout.camera.get());
        part[is_single] = static_cast<double>(
                              affected(layout, rectangle(0.1, 0.5), velocity, pool.get()).pixels) /
                          (static_cast<double>(shape.width) * shape.height * layout_frames);
    }
    to.rows.push_back(
        {"fig. 9 top, at 100 cm/s, with circuits of 0.5 um, with which fig. 7 holds: single "
         "readout is affected more",
         "slightly",
         text_of_number(part[0], 3) + " dual, " + text_of_number(part[1], 3) + " single",
         part[1] > part[0]});
}

// How many pixels an edge at 60 cm and 100 cm/s sweeps in a second.
void reproduce_sweep(Reproduction &to)
{
    const Layout dual = make_layout(false, 12e-6);
    const double x[2] = {0, 1}, y[2] = {0, 0}, z[2] = {near_depth, near_depth};
    double column[2], row[2];
    cm_camera_project_array(dual.camera.get(), 2, x, y, z, column, row);
    const double swept = column[1] - column[0];
    to.rows.push_back({"pixels a second that 100 cm/s at 60 cm sweep", "ca. 305",
                       text_of_number(swept, 4), std::abs(swept - 305) < 1});
}

// Fig. 6: the amplitude of a wall in the middle of the picture.
void reproduce_amplitude(Reproduction &to)
{
    const Layout dual = make_layout(false, 12e-6);
    ChartCurve curve = {"simulated", {}, {}}, law = {"by the square of the distance", {}, {}};
    const std::size_t middle = std::size_t{96} * 256 + 128;
    double most = 0, first = 0;
    for (double distance = 0.4; distance < 4.05; distance += 0.1)
    {
        const TofPointer<cm_tof_scene> scene = make_stage({plane_at(0, 0, distance, 0, 0, 1, 0.8)});
        std::vector<float> amplitude(std::size_t{256} * 192);
        cm_tof_result result = {};
        result.size = sizeof result;
        result.amplitude = amplitude.data();
        const cm_tof_light light = plain_light();
        need(cm_tof_simulate(scene.get(), &dual.sensor, &light, 1, nullptr, 0, nullptr, nullptr,
                             &result));
        const double value = static_cast<double>(amplitude[middle]) * distance * distance;
        first = first == 0 ? value : first;
        most = std::max(most, std::abs(value / first - 1));
        curve.x.push_back(distance);
        curve.y.push_back(static_cast<double>(amplitude[middle]));
        law.x.push_back(distance);
        law.y.push_back(first / (distance * distance));
    }
    to.charts.push_back({"layouts-figure-6",
                         "Amplitude of the middle pixel, a white wall",
                         "distance in m",
                         "electrons",
                         false,
                         {curve, law},
                         {}});
    to.rows.push_back({"fig. 6: amplitude over distance, against its square",
                       "matches what was measured", "within " + text_of_number(most, 2),
                       most < 1e-6});
}

ChartPicture picture_of(const std::string &name, const Layout &layout, const cm_tof_scene *scene,
                        const cm_tof_scene *still, cm_pool *pool)
{
    const double time = -0.5 * cm_tof_frame_time(&layout.sensor);
    const std::vector<float> moved =
        distances(scene, layout.sensor, plain_light(), nullptr, time, options_of(layout), pool);
    const std::vector<float> truth =
        distances(still, layout.sensor, plain_light(), nullptr, time, options_of(layout), pool);
    ChartPicture picture = {name, "m", cm_camera_describe(layout.camera.get())->width, {}};
    for (std::size_t i = 0; i < moved.size(); ++i)
    {
        picture.value.push_back(std::min(0.2f, std::max(-0.2f, moved[i] - truth[i])));
    }
    return picture;
}

double mean_size(const ChartPicture &picture)
{
    double sum = 0;
    for (const float error : picture.value)
    {
        sum += std::isnan(error) ? 0 : static_cast<double>(std::abs(error));
    }
    return sum / static_cast<double>(picture.value.size());
}

// Fig. 10: a sphere that moves, and what is wrong about it.
void reproduce_sphere(const ReproduceSettings &settings, Reproduction &to)
{
    const PoolPointer pool = make_pool(settings.threads);
    const double velocity[3] = {1, 0, 0};
    const TofPointer<cm_trajectory> motion = make_line(velocity);
    cm_primitive ball = sphere_at(0, 0, 0.75, 0.15, 0.8);
    const cm_primitive wall = plane_at(0, 0, far_depth, 0, 0, 1, 0.8);
    const TofPointer<cm_tof_scene> still = make_stage({wall, ball});
    ball.motion = motion.get();
    const TofPointer<cm_tof_scene> moving = make_stage({wall, ball});
    const Layout dual = make_layout(false, 12e-6), single = make_layout(true, 8e-6);
    settings.tell("sphere at 100 cm/s");
    const ChartPicture a =
        picture_of("dual readout, 12 um", dual, moving.get(), still.get(), pool.get());
    const ChartPicture b =
        picture_of("single readout, 8 um", single, moving.get(), still.get(), pool.get());
    to.charts.push_back({"layouts-figure-10",
                         "Error of distance of a sphere at 100 cm/s",
                         "",
                         "",
                         false,
                         {},
                         {a, b}});
    to.rows.push_back({"fig. 10: single readout is affected more by a moving sphere", "stronger",
                       text_of_number(1e3 * mean_size(a), 3) + " mm in the mean dual, " +
                           text_of_number(1e3 * mean_size(b), 3) + " mm single",
                       mean_size(b) > mean_size(a)});
}

} // namespace

Reproduction reproduce_layouts(const ReproduceSettings &settings)
{
    Reproduction made;
    reproduce_amplitude(made);
    reproduce_sweep(made);
    reproduce_sphere(settings, made);
    reproduce_motion(settings, made);
    reproduce_narrow_circuits(settings, made);
    return made;
}
