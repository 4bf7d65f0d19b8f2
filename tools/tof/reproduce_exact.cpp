// SPDX-License-Identifier: MIT
//
// What formulas say exactly: a sphere around camera and light, a wall by hand, shot noise; and eq. 1 of the chapter on ground
// truth of 2013.

#include "reproduce.hpp"
#include "reproduce_stage.hpp"

#include <cubemap/depth_error.h>

#include <cmath>
#include <complex>

namespace
{

// Every scattering multiplies the phasor by reflectance times this: the mean of e^(i k r) over the chords from a place on
// the sphere, weighted by the light that comes along them.
std::complex<double> chord_factor(double radius, double wave_number)
{
    constexpr int pieces = 20000; // Simpson's rule
    const double step = 2 * radius / pieces;
    std::complex<double> sum = 0;
    for (int i = 0; i <= pieces; ++i)
    {
        const double r = step * i;
        const double weight = i == 0 || i == pieces ? 1 : i % 2 == 1 ? 4 : 2;
        sum += weight * r / (2 * radius * radius) * std::polar(1.0, wave_number * r);
    }
    return sum * step / 3.0;
}

// What is measured if the scattered light is that of so many bounces; below 0: of all.
double sphere_distance(double radius, double reflectance, double frequency, int bounces)
{
    const double wave_number = 2 * half_turn * frequency / CM_SPEED_OF_LIGHT;
    const std::complex<double> factor = reflectance * chord_factor(radius, wave_number);
    std::complex<double> sum = bounces < 0 ? 1.0 / (1.0 - factor) : 1.0, power = 1;
    for (int i = 0; i < bounces; ++i)
    {
        power *= factor;
        sum += power;
    }
    const double phase = std::arg(sum * std::polar(1.0, 2 * wave_number * radius));
    return (phase < 0 ? phase + 2 * half_turn : phase) / (2 * wave_number);
}

double mean_of(const std::vector<float> &values)
{
    double sum = 0;
    for (const float value : values)
    {
        sum += static_cast<double>(value);
    }
    return sum / static_cast<double>(values.size());
}

void reproduce_ball(const ReproduceSettings &settings, Reproduction &to)
{
    const PoolPointer pool = make_pool(settings.threads);
    const TofPointer<cm_camera> camera = make_pinhole(32, 24, 1);
    const TofPointer<cm_tof_scene> scene = make_stage({sphere_at(0, 0, 0, 1, 0.5)});
    struct Line
    {
        const char *what;
        int bounces;
        int traces;
        int simulated;
        double within;
    };
    constexpr Line lines[] = {{"sphere, direct light", 0, 0, 0, 1e-6},
                              {"sphere, one bounce by 338 lights", 1, 0, 1, 2e-3},
                              {"sphere, one bounce by paths", 1, 1, 1, 2e-3},
                              {"sphere, all bounces by paths (24 of them)", -1, 1, 24, 3e-3}};
    for (const Line &line : lines)
    {
        settings.tell(line.what);
        cm_tof_options options = {};
        options.size = sizeof options;
        options.bounces = line.simulated;
        options.traces = line.traces;
        options.paths = 64;
        const double expected = sphere_distance(1, 0.5, 20e6, line.bounces);
        const double measured = mean_of(distances(scene.get(), plain_sensor(camera.get()),
                                                  plain_light(), nullptr, 0, options, pool.get()));
        to.rows.push_back({line.what, text_of_number(expected, 7) + " m (exact)",
                           text_of_number(measured, 7) + " m",
                           std::abs(measured - expected) < line.within});
    }
}

// Lambers, Hoberg and Kolb 2015, eqs. 4 to 15.
void reproduce_wall(Reproduction &to)
{
    const TofPointer<cm_camera> camera = make_pinhole(33, 25, 1);
    const cm_tof_sensor sensor = plain_sensor(camera.get());
    const TofPointer<cm_tof_scene> scene = make_stage({plane_at(0, 0, 1.7, 0, 0, 1, 0.6)});
    std::vector<float> intensity(33 * 25);
    cm_tof_result result = {};
    result.size = sizeof result;
    result.intensity = intensity.data();
    const cm_tof_light light = plain_light();
    need(cm_tof_simulate(scene.get(), &sensor, &light, 1, nullptr, 0, nullptr, nullptr, &result));
    const double radiance = 0.6 * light.power / (4 * half_turn) / (1.7 * 1.7) / half_turn;
    const double energy =
        half_turn / 4 * radiance * sensor.pitch * sensor.pitch * sensor.exposure * sensor.duty;
    const double expected =
        sensor.efficiency * energy * sensor.wavelength / (6.62607015e-34 * CM_SPEED_OF_LIGHT);
    const double measured = static_cast<double>(intensity[12 * 33 + 16]);
    to.rows.push_back({"electrons of the middle pixel of a wall",
                       text_of_number(expected, 8) + " (by hand)", text_of_number(measured, 8),
                       std::abs(measured / expected - 1) < 1e-6});
}

void reproduce_noise(const ReproduceSettings &settings, Reproduction &to)
{
    const TofPointer<cm_camera> camera = make_pinhole(100, 100, 0.01); // all pixels alike
    const TofPointer<cm_tof_scene> scene = make_stage({plane_at(0, 0, 1.7, 0, 0, 1, 0.6)});
    for (const int phases : {4, 8})
    {
        settings.tell("shot noise");
        cm_tof_sensor sensor = plain_sensor(camera.get());
        sensor.phases = phases;
        cm_tof_options options = {};
        options.size = sizeof options;
        options.noise = 1;
        std::vector<float> intensity(100 * 100), distance(100 * 100);
        cm_tof_result result = {};
        result.size = sizeof result;
        result.intensity = intensity.data();
        result.distance = distance.data();
        const cm_tof_light light = plain_light();
        need(cm_tof_simulate(scene.get(), &sensor, &light, 1, nullptr, 0, &options, nullptr,
                             &result));
        const double mean = mean_of(distance);
        double squares = 0;
        for (const float value : distance)
        {
            squares += (static_cast<double>(value) - mean) * (static_cast<double>(value) - mean);
        }
        const double spread = std::sqrt(squares / (100 * 100 - 1));
        const double expected = cm_tof_noise_of_distance(&sensor, mean_of(intensity), 0);
        to.rows.push_back(
            {"spread of the distance by shot noise, " + std::to_string(phases) + " phases",
             text_of_number(1e3 * expected, 4) + " mm (formula)",
             text_of_number(1e3 * spread, 4) + " mm of 10,000 pixels",
             std::abs(spread / expected - 1) < 0.04});
    }
}

// Nair and others, Ground Truth for Evaluating Time of Flight Imaging, 2013, eq. 1, for a MESA SR 4000: pixels of 40 um behind
// 10 mm, by its maker. The chapter names neither, and its figure comes of none of them: what would give it is said beside.
void reproduce_checkerboard(Reproduction &to)
{
    constexpr double apart = 0.085, focal_length = 0.01, pixel = 40e-6, found_within = 0.1;
    constexpr double paper = 0.73e-3;
    const double one = cm_depth_error_checkerboard(1.0, apart, focal_length, found_within * pixel);
    // eq. 1, solved for the error on the chip
    const double seen = apart * focal_length;
    const double needed = paper * seen * seen / (2 * (apart * focal_length + paper * seen));
    to.rows.push_back(
        {"eq. 1 of 2013: error of a checkerboard's distance at 1 m by two corners", "0.73 mm",
         text_of_number(1e3 * one, 3) + " mm; 0.73 mm is that of pixels of " +
             text_of_number(1e6 * needed / found_within, 2) + " um, of corners found within " +
             text_of_number(needed / pixel, 2) + " pixels, or of " +
             text_of_number(std::pow(one / paper, 2), 3) + " corners",
         std::abs(one - paper) < 0.005e-3});
}

} // namespace

Reproduction reproduce_exact(const ReproduceSettings &settings)
{
    Reproduction made;
    reproduce_wall(made);
    reproduce_checkerboard(made);
    reproduce_noise(settings, made);
    reproduce_ball(settings, made);
    return made;
}
