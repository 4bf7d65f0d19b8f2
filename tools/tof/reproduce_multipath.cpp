// SPDX-License-Identifier: MIT
//
// Bulczak, Lambers and Kolb, Quantified, Interactive Simulation of AMCW ToF Camera including Multipath Effects, 2018: table 2
// and figure 9. The camera's own pictures are not public: paths of many bounces stand for them, and the reflectance is tuned
// once, in the scene Corner, until one bounce removes as much of direct light's error as it does there.

#include "reproduce.hpp"
#include "reproduce_stage.hpp"

#include <cmath>
#include <iterator>

namespace
{

constexpr std::uint32_t corner_pixels = 100; // half of the camera's along each way
constexpr double corner_wall = 1.0;          // metres, edges of the corner's plates
constexpr double corner_cube = 0.3;
constexpr double small_cube = 0.05;
constexpr int reference_bounces = 8;
constexpr std::uint32_t reference_paths = 128;

// Into the corner at the origin from the direction of (1, 1, 1): rows are the camera's axes.
cm_pose corner_pose(double apart)
{
    const double a = 1 / std::sqrt(2.0), b = 1 / std::sqrt(6.0), c = 1 / std::sqrt(3.0);
    cm_pose pose = {};
    pose.rotation = {{{-a, a, 0}, {b, b, -2 * b}, {-c, -c, -c}}};
    for (double &each : pose.position)
    {
        each = apart * c;
    }
    return pose;
}

std::vector<cm_primitive> corner(double reflectance)
{
    constexpr double thick = 0.01;
    return {box_between(-thick, 0, 0, 0, corner_wall, corner_wall, reflectance),
            box_between(0, -thick, 0, corner_wall, 0, corner_wall, reflectance),
            box_between(-thick, -thick, -thick, corner_wall, corner_wall, 0, reflectance)};
}

std::vector<cm_primitive> corner_with_cube(double reflectance, double shift)
{
    std::vector<cm_primitive> made = corner(reflectance);
    made.push_back(box_between(shift, shift, shift > 0 ? 0 : shift, shift + corner_cube,
                               shift + corner_cube, corner_cube, reflectance));
    return made;
}

struct CornerStage
{
    TofPointer<cm_camera> camera;
    cm_tof_sensor sensor;
    TofPointer<cm_trajectory> trajectory;
    PoolPointer pool;
};

CornerStage make_corner_stage(int threads, double apart, double aperture)
{
    CornerStage made = {
        make_pinhole(corner_pixels, corner_pixels, aperture), {}, nullptr, make_pool(threads)};
    made.sensor = plain_sensor(made.camera.get());
    made.sensor.wavelength = 870e-9;
    const double stamp = 0;
    const cm_pose pose = corner_pose(apart);
    cm_trajectory *trajectory = nullptr;
    need(cm_trajectory_create(1, &stamp, &pose, &trajectory, nullptr));
    made.trajectory.reset(trajectory);
    return made;
}

cm_tof_options options_of(int bounces)
{
    cm_tof_options options = {};
    options.size = sizeof options;
    options.bounces = bounces;
    options.paths = reference_paths;
    return options;
}

std::vector<float> picture(const CornerStage &stage, const std::vector<cm_primitive> &scene,
                           const cm_tof_options &options)
{
    return distances(make_stage(scene).get(), stage.sensor, plain_light(), stage.trajectory.get(),
                     0, options, stage.pool.get());
}

double mean_error(const std::vector<float> &one, const std::vector<float> &other)
{
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < one.size(); ++i)
    {
        if (!std::isnan(one[i]) && !std::isnan(other[i]))
        {
            sum += static_cast<double>(std::abs(one[i] - other[i]));
            ++count;
        }
    }
    return count == 0 ? 0 : sum / static_cast<double>(count);
}

// What one bounce removes of direct light's error.
struct Removal
{
    double direct, single, seen;
    std::vector<float> reference, one;
    double part() const
    {
        return 1 - single / direct;
    }
};

Removal measure(const CornerStage &stage, const std::vector<cm_primitive> &scene)
{
    Removal made = {};
    made.reference = picture(stage, scene, options_of(reference_bounces));
    made.one = picture(stage, scene, options_of(1));
    cm_tof_options with = options_of(1);
    with.visibility = 1;
    made.direct = mean_error(picture(stage, scene, options_of(0)), made.reference);
    made.single = mean_error(made.one, made.reference);
    made.seen = mean_error(picture(stage, scene, with), made.reference);
    return made;
}

// The reflectance with which one bounce removes 75 % in Corner: more bounces matter more the brighter walls are.
double tuned_reflectance(const CornerStage &stage, const ReproduceSettings &settings)
{
    double least = 0.1, most = 0.95;
    for (int i = 0; i < 7; ++i)
    {
        const double middle = 0.5 * (least + most);
        settings.tell("Corner, reflectance " + text_of_number(middle, 3));
        (measure(stage, corner(middle)).part() > 0.75 ? least : most) = middle;
    }
    return 0.5 * (least + most);
}

std::string percent(double part)
{
    return text_of_number(100 * part, 3) + " %";
}

// The reflectance it was tuned to.
double reproduce_corners(const ReproduceSettings &settings, Reproduction &to)
{
    const CornerStage stage = make_corner_stage(settings.threads, 1.3, 40 * half_turn / 180);
    const double reflectance = tuned_reflectance(stage, settings);
    struct Line
    {
        const char *name;
        std::vector<cm_primitive> scene;
        const char *paper;
        double low, high;
    };
    const Line lines[] = {
        {"Corner", corner(reflectance), "73 to 77 %, within 3 points", 0.73, 0.77},
        {"CornerCube", corner_with_cube(reflectance, 0), "73 to 80 %, within 3 points", 0.73, 0.80},
        {"CornerCubeShift", corner_with_cube(reflectance, 0.1), "53 to 56 %, within 3 points", 0.53,
         0.56}};
    // the paper's mean absolute errors of SimDirect and SimSingle, materials 1 and 5
    Chart bars = {"multipath-table-2-figures",
                  "Of direct light's error one bounce removes",
                  "scene: 1 Corner, 2 CornerCube, 3 CornerCubeShift",
                  "part removed",
                  true,
                  {{"paper, material 1",
                    {1, 2, 3},
                    {1 - 0.0238 / 0.0885, 1 - 0.0194 / 0.0728, 1 - 0.0396 / 0.0846}},
                   {"paper, material 5",
                    {1, 2, 3},
                    {1 - 0.0200 / 0.0884, 1 - 0.0138 / 0.0688, 1 - 0.0342 / 0.0777}},
                   {"here", {1, 2, 3}, {}},
                   {"here, with visibility", {1, 2, 3}, {}}},
                  {}};
    Chart chart = {
        "multipath-table-2", "One bounce less paths of eight bounces", "", "", false, {}, {}};
    for (const Line &line : lines)
    {
        settings.tell(line.name);
        const Removal removal = measure(stage, line.scene);
        to.rows.push_back(
            {std::string("table 2, ") + line.name + ": of direct light's error one bounce removes",
             line.paper,
             percent(removal.part()) + " (error " + text_of_number(1e3 * removal.direct, 3) +
                 " mm direct, " + text_of_number(1e3 * removal.single, 3) + " mm one bounce, " +
                 text_of_number(1e3 * removal.seen, 3) + " mm with visibility; reflectance " +
                 text_of_number(reflectance, 3) + ")",
             removal.part() > line.low - 0.03 && removal.part() < line.high + 0.03});
        bars.curves[2].y.push_back(removal.part());
        bars.curves[3].y.push_back(1 - removal.seen / removal.direct);
        ChartPicture difference = {line.name, "m", corner_pixels, removal.one};
        for (std::size_t i = 0; i < difference.value.size(); ++i)
        {
            difference.value[i] -= removal.reference[i];
        }
        chart.pictures.push_back(difference);
    }
    to.charts.push_back(chart);
    to.charts.push_back(bars);
    return reflectance;
}

// Fig. 9: a cube of aluminium, 5 cm, in the corner of table 2's first material. What is one bounce comes by paths: virtual lights
// are few, and something that mirrors sees none of them.
void reproduce_aluminium(const ReproduceSettings &settings, double reflectance, Reproduction &to)
{
    settings.tell("the cube of aluminium");
    cm_cook_torrance metal = {};
    metal.size = sizeof metal;
    metal.specular = 1;
    metal.roughness = 0.15;
    metal.eta = 2.8;
    metal.absorption = 8.45;
    cm_brdf *made = nullptr;
    need(cm_brdf_create_cook_torrance(&metal, &made));
    const TofPointer<cm_brdf> brdf(made);
    const CornerStage stage = make_corner_stage(settings.threads, 1.3, 10 * half_turn / 180);
    std::vector<cm_primitive> with = corner(reflectance);
    with.push_back(box_between(0, 0, 0, small_cube, small_cube, small_cube, 1));
    with.back().brdf = brdf.get();
    std::vector<cm_primitive> dull = with;
    dull.back().brdf = nullptr;
    const std::vector<float> truth = picture(stage, dull, options_of(0));
    cm_tof_options single = options_of(1), many = options_of(8);
    single.traces = 1;
    single.paths = many.paths = 4 * reference_paths;
    const std::vector<float> lights = picture(stage, with, options_of(1));
    const std::vector<float> one = picture(stage, with, single);
    const std::vector<float> eight = picture(stage, with, many);
    const std::vector<float> empty_truth = picture(stage, corner(reflectance), options_of(0));
    const std::vector<float> empty_one = picture(stage, corner(reflectance), single);
    const std::vector<float> empty_eight = picture(stage, corner(reflectance), many);
    // where the cube is: how far it moves what is measured of the corner without it, in the mean
    double height = 0, by_one = 0, by_eight = 0, by_lights = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < truth.size(); ++i)
    {
        const double cube_height = static_cast<double>(empty_truth[i] - truth[i]);
        if (cube_height > 0.01)
        {
            height += cube_height;
            by_lights += static_cast<double>(empty_one[i] - lights[i]);
            by_one += static_cast<double>(empty_one[i] - one[i]);
            by_eight += static_cast<double>(empty_eight[i] - eight[i]);
            ++count;
        }
    }
    const auto millimetres = [&](double sum)
    { return text_of_number(1e3 * sum / static_cast<double>(count), 3) + " mm"; };
    to.rows.push_back(
        {"fig. 9: an aluminium cube, " + millimetres(height) +
             " before the corner in the mean, brings nearer with one bounce",
         "it stays, half of it at least",
         "by " + millimetres(by_one) + " (by 338 lights " + millimetres(by_lights) + ")",
         by_one > 0.5 * height});
    to.rows.push_back({"fig. 9: and with eight bounces",
                       "it nearly vanishes, less than half of that", "by " + millimetres(by_eight),
                       std::abs(by_eight) < 0.5 * std::abs(by_one)});
    Chart chart = {"multipath-figure-9",
                   "Row through an aluminium cube of 5 cm in a corner",
                   "column",
                   "distance in m",
                   false,
                   {{"truth", {}, {}},
                    {"one bounce, by 338 lights", {}, {}},
                    {"one bounce, by paths", {}, {}},
                    {"eight bounces", {}, {}},
                    {"eight, no cube", {}, {}}},
                   {}};
    const std::vector<float> *const rows[] = {&truth, &lights, &one, &eight, &empty_eight};
    for (std::size_t curve = 0; curve < std::size(rows); ++curve)
    {
        for (std::size_t column = 0; column < corner_pixels; ++column)
        {
            chart.curves[curve].x.push_back(static_cast<double>(column));
            chart.curves[curve].y.push_back(
                static_cast<double>((*rows[curve])[corner_pixels / 2 * corner_pixels + column]));
        }
    }
    to.charts.push_back(chart);
}

} // namespace

Reproduction reproduce_multipath(const ReproduceSettings &settings)
{
    Reproduction made;
    const double reflectance = reproduce_corners(settings, made);
    reproduce_aluminium(settings, reflectance, made);
    return made;
}
