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
constexpr double cube_shift = 0.1;
constexpr double small_cube = 0.05;
constexpr double white_plastic = 0.85; // in near infrared
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

std::string percent(double part)
{
    return text_of_number(100 * part, 3) + " %";
}

// CornerCubeShift with a cube that stands aside of where it is simulated, along the one wall and away from the other: how far,
// until one bounce removes what it does in the paper. A cube in the corner has no place of its own.
std::string shifted_aside(const CornerStage &stage, double reflectance,
                          const ReproduceSettings &settings)
{
    constexpr double wanted = 0.545; // between both materials
    const std::vector<cm_primitive> scene = corner_with_cube(reflectance, cube_shift);
    const std::vector<float> direct = picture(stage, scene, options_of(0));
    const std::vector<float> single = picture(stage, scene, options_of(1));
    double least = 0, most = 0.05, aside = 0, error = 0, left = 0;
    for (int i = 0; i < 6; ++i)
    {
        aside = 0.5 * (least + most);
        settings.tell("CornerCubeShift, a cube " + text_of_number(1e3 * aside, 3) + " mm aside");
        std::vector<cm_primitive> real = scene;
        for (double *const corner : {real.back().first, real.back().second})
        {
            corner[0] += aside;
            corner[1] -= aside;
        }
        const std::vector<float> reference = picture(stage, real, options_of(reference_bounces));
        error = mean_error(direct, reference);
        left = mean_error(single, reference);
        (1 - left / error > wanted ? least : most) = aside;
    }
    return "; " + percent(1 - left / error) + " with a cube that stands " +
           text_of_number(1e3 * std::sqrt(2.0) * aside, 2) +
           " mm aside of where it is simulated (" + text_of_number(1e3 * error, 3) +
           " mm direct, " + text_of_number(1e3 * left, 3) + " mm one bounce)";
}

// The reflectance in Corner up to which something holds.
template <class Holds>
double tuned_reflectance(const CornerStage &stage, const ReproduceSettings &settings, Holds holds)
{
    double least = 0.1, most = 0.95;
    for (int i = 0; i < 7; ++i)
    {
        const double middle = 0.5 * (least + most);
        settings.tell("Corner, reflectance " + text_of_number(middle, 3));
        (holds(measure(stage, corner(middle))) ? least : most) = middle;
    }
    return 0.5 * (least + most);
}

// The reflectance it was tuned to.
double reproduce_corners(const ReproduceSettings &settings, Reproduction &to)
{
    const CornerStage stage = make_corner_stage(settings.threads, 1.3, 40 * half_turn / 180);
    // with brighter walls more bounces matter more
    const double reflectance = tuned_reflectance(
        stage, settings, [](const Removal &removal) { return removal.part() > 0.75; });
    struct Line
    {
        const char *name;
        std::vector<cm_primitive> scene;
        const char *paper;
        double low, high;
        std::string more = {};
    };
    const Line lines[] = {
        {"Corner", corner(reflectance), "73 to 77 %, within 3 points", 0.73, 0.77},
        {"CornerCube", corner_with_cube(reflectance, 0), "73 to 80 %, within 3 points", 0.73, 0.80},
        {"CornerCubeShift", corner_with_cube(reflectance, cube_shift),
         "53 to 56 %, within 3 points", 0.53, 0.56, shifted_aside(stage, reflectance, settings)}};
    // the paper's mean absolute errors of SimDirect and SimSingle, materials 1 and 5
    Chart bars = {"multipath-table-2-figures",
                  "Of direct light's error one bounce removes",
                  "",
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
                 text_of_number(reflectance, 3) + ")" + line.more,
             removal.part() > line.low - 0.03 && removal.part() < line.high + 0.03});
        bars.tick.push_back(line.name);
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

// Table 2's errors themselves, with walls as bright as direct light's error in Corner asks for.
void reproduce_errors(const ReproduceSettings &settings, Reproduction &to)
{
    const CornerStage stage = make_corner_stage(settings.threads, 1.3, 40 * half_turn / 180);
    const double reflectance = tuned_reflectance(
        stage, settings, [](const Removal &removal) { return removal.direct < 0.0885; });
    struct Line
    {
        const char *name;
        std::vector<cm_primitive> scene;
        const char *paper;
        double low, high; // metres, of both materials
    };
    const Line lines[] = {
        {"Corner", corner(reflectance), "88.5 and 88.4 mm; 23.8 and 20.0 left", 0.0884, 0.0885},
        {"CornerCube", corner_with_cube(reflectance, 0), "72.8 and 68.8 mm; 19.4 and 13.8 left",
         0.0688, 0.0728},
        {"CornerCubeShift", corner_with_cube(reflectance, cube_shift),
         "84.6 and 77.7 mm; 39.6 and 34.2 left", 0.0777, 0.0846}};
    for (const Line &line : lines)
    {
        settings.tell(line.name);
        const Removal removal = measure(stage, line.scene);
        to.rows.push_back(
            {std::string("table 2, ") + line.name +
                 ": direct light's error, tuned in Corner, and what one bounce leaves",
             std::string(line.paper) + "; the first within 5 mm",
             text_of_number(1e3 * removal.direct, 3) + " mm; " +
                 text_of_number(1e3 * removal.single, 3) + " left (reflectance " +
                 text_of_number(reflectance, 3) + ")",
             removal.direct > line.low - 0.005 && removal.direct < line.high + 0.005});
    }
}

// Fig. 9: a cube of aluminium, 5 cm, in a corner of the first material, and the corner alone.
struct Walls
{
    const char *name;
    const char *chart;
    double reflectance;
};

struct AluminiumPictures
{
    std::vector<float> truth, lights, one, eight;
    std::vector<float> empty_truth, empty_one, empty_eight;
};

TofPointer<cm_brdf> make_aluminium()
{
    cm_cook_torrance metal = {};
    metal.size = sizeof metal;
    metal.specular = 1;
    metal.roughness = 0.3;
    metal.eta = 2.8;
    metal.absorption = 8.45;
    cm_brdf *made = nullptr;
    need(cm_brdf_create_cook_torrance(&metal, &made));
    return TofPointer<cm_brdf>(made);
}

// What is one bounce comes by paths: virtual lights are few, and something that mirrors sees none of them.
AluminiumPictures take_aluminium(const CornerStage &stage, double reflectance)
{
    const TofPointer<cm_brdf> brdf = make_aluminium();
    const std::vector<cm_primitive> empty = corner(reflectance);
    std::vector<cm_primitive> dull = empty;
    dull.push_back(box_between(0, 0, 0, small_cube, small_cube, small_cube, 1));
    std::vector<cm_primitive> with = dull;
    with.back().brdf = brdf.get();
    cm_tof_options single = options_of(1), many = options_of(8);
    single.traces = 1;
    single.paths = many.paths = 4 * reference_paths;
    AluminiumPictures made;
    made.truth = picture(stage, dull, options_of(0));
    made.lights = picture(stage, with, options_of(1));
    made.one = picture(stage, with, single);
    made.eight = picture(stage, with, many);
    made.empty_truth = picture(stage, empty, options_of(0));
    made.empty_one = picture(stage, empty, single);
    made.empty_eight = picture(stage, empty, many);
    return made;
}

// Where the cube is: how far it moves what is measured of the corner without it, in the mean.
void add_aluminium_rows(const AluminiumPictures &taken, const Walls &walls, Reproduction &to)
{
    double height = 0, by_one = 0, by_eight = 0, by_lights = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < taken.truth.size(); ++i)
    {
        const double cube_height = static_cast<double>(taken.empty_truth[i] - taken.truth[i]);
        if (cube_height > 0.01)
        {
            height += cube_height;
            by_lights += static_cast<double>(taken.empty_one[i] - taken.lights[i]);
            by_one += static_cast<double>(taken.empty_one[i] - taken.one[i]);
            by_eight += static_cast<double>(taken.empty_eight[i] - taken.eight[i]);
            ++count;
        }
    }
    const auto millimetres = [&](double sum)
    { return text_of_number(1e3 * sum / static_cast<double>(count), 3) + " mm"; };
    const std::string where = std::string("fig. 9, walls of ") + walls.name + ": ";
    to.rows.push_back(
        {where + "an aluminium cube, " + millimetres(height) +
             " before the corner in the mean, brings nearer with one bounce",
         "it stays, half of it at least",
         "by " + millimetres(by_one) + " (by 338 lights " + millimetres(by_lights) + ")",
         by_one > 0.5 * height});
    to.rows.push_back({where + "and with eight bounces",
                       "it nearly vanishes, less than half of that", "by " + millimetres(by_eight),
                       std::abs(by_eight) < 0.5 * std::abs(by_one)});
}

Chart aluminium_chart(const AluminiumPictures &taken, const Walls &walls)
{
    Chart chart = {walls.chart,
                   std::string("Row through an aluminium cube of 5 cm, walls of ") + walls.name,
                   "column",
                   "distance in m",
                   false,
                   {{"truth", {}, {}},
                    {"one bounce, by 338 lights", {}, {}},
                    {"one bounce, by paths", {}, {}},
                    {"eight bounces", {}, {}},
                    {"eight, no cube", {}, {}}},
                   {}};
    const std::vector<float> *const rows[] = {&taken.truth, &taken.lights, &taken.one, &taken.eight,
                                              &taken.empty_eight};
    for (std::size_t curve = 0; curve < std::size(rows); ++curve)
    {
        for (std::size_t column = 0; column < corner_pixels; ++column)
        {
            chart.curves[curve].x.push_back(static_cast<double>(column));
            chart.curves[curve].y.push_back(
                static_cast<double>((*rows[curve])[corner_pixels / 2 * corner_pixels + column]));
        }
    }
    return chart;
}

void reproduce_aluminium(const ReproduceSettings &settings, const Walls &walls, Reproduction &to)
{
    settings.tell(std::string("the cube of aluminium, walls of ") + walls.name);
    const CornerStage stage = make_corner_stage(settings.threads, 1.3, 10 * half_turn / 180);
    const AluminiumPictures taken = take_aluminium(stage, walls.reflectance);
    add_aluminium_rows(taken, walls, to);
    to.charts.push_back(aluminium_chart(taken, walls));
}

} // namespace

Reproduction reproduce_multipath(const ReproduceSettings &settings)
{
    Reproduction made;
    const double reflectance = reproduce_corners(settings, made);
    reproduce_errors(settings, made);
    reproduce_aluminium(settings, {"white plastic, 0.85", "multipath-figure-9", white_plastic},
                        made);
    reproduce_aluminium(settings,
                        {"table 2's reflectance", "multipath-figure-9-table-2", reflectance}, made);
    return made;
}
