// SPDX-License-Identifier: MIT
//
// cubemap-tof --environment: light whose electrons are known, from pictures of several kinds, and what is refused.

#include "image_cases.hpp"
#include "picture.hpp"

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <vector>

namespace
{

constexpr int view_width = 24;
constexpr int view_height = 18;
constexpr double sky_pi = 3.14159265358979323846;
constexpr double wall_reflectance = 0.5;

// Of floats, rows from the top, all of one value but for one.
void write_sky(const std::string &name, int columns, int rows, float everywhere, int x = 0,
               int y = 0, float there = -2)
{
    std::vector<float> sky(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows),
                           everywhere);
    if (there != -2)
    {
        sky[static_cast<std::size_t>((rows - 1 - y) * columns + x)] = there; // PFM is from below
    }
    std::string bytes(sky.size() * sizeof(float), '\0');
    std::memcpy(&bytes[0], sky.data(), bytes.size());
    write_file(name,
               "Pf\n" + std::to_string(columns) + " " + std::to_string(rows) + "\n-1.0\n" + bytes);
}

void write_sensor(const std::string &name, const std::string &power)
{
    write_file(
        name,
        std::string(
            R"({"camera": {"width": 24, "height": 18, "fx": 20, "fy": 20, "cx": 11.5, "cy": 8.5},
"pitch": 12e-6, "f_number": 1.2, "wavelength": 850e-9, "efficiency": 0.4, "exposure": 5e-3,
"frequency": 20e6, "phases": 4, "duty": 0.5, "contrast": 0.8,
"lights": [{"aperture": 6.283185307179586, "power": )") +
            power + "}]}");
}

void make_sky_inputs()
{
    write_file("wall.json", R"({"planes": [{"point": [0, 0, 2], "normal": [0, 0, -1],
"reflectance": 0.5}]})");
    write_file("tilted.json", R"({"planes": [{"point": [0, 0, 2], "normal": [0.3, -0.2, -1],
"reflectance": 0.5}]})");
    write_sensor("sensor.json", "0.7");
    write_file("pose.txt", "0 0 0 0 0 0 0 1\n");
    write_sky("even.pfm", 16, 8, 3);
    write_sky("sun.pfm", 64, 32, 0, 20, 24, 1000);
}

// Electrons of a surface of radiance 1 in a pixel: (pi/4) / N^2 cos^4, its area, the exposure and lambda / (h c).
double electrons_of_radiance(int x, int y)
{
    const double across = (x - 11.5) / 20;
    const double down = (y - 8.5) / 20;
    const double cosine2 = 1 / (1 + across * across + down * down);
    const double joule = sky_pi / 4 / (1.2 * 1.2) * cosine2 * cosine2 * 12e-6 * 12e-6 * 5e-3;
    return 0.4 * joule * 850e-9 / (6.62607015e-34 * 299792458.0);
}

// What a simulation has more electrons than one of the same scene without surroundings, as irradiance: all pixels' mean.
double irradiance(const std::string &scene, const std::string &options)
{
    does("tof simulate " + scene + " sensor.json pose.txt -o dark --quiet");
    does("tof simulate " + scene + " sensor.json pose.txt -o lit --quiet " + options);
    const Picture dark("dark/intensity_0000.exr");
    const Picture lit("lit/intensity_0000.exr");
    double sum = 0;
    for (int i = 0; i < view_width * view_height; ++i)
    {
        const int x = i % view_width;
        const int y = i / view_width;
        sum += (lit.first(x, y) - dark.first(x, y)) / electrons_of_radiance(x, y);
    }
    return sum / (view_width * view_height) * sky_pi / wall_reflectance;
}

void is_irradiance(const std::string &name, double found, double expected, double part)
{
    result(std::fabs(found / expected - 1) < part, name,
           std::to_string(found) + ", not " + std::to_string(expected));
}

void gives_electrons()
{
    make_sky_inputs();
    is_irradiance("an even sky", irradiance("wall.json", "--environment even.pfm"), 3 * sky_pi,
                  1e-5);
    write_sky("faces.pfm", 24, 4, 3);
    write_sky("pixels.pfm", 48, 4, 3);
    is_irradiance("an even sky on faces",
                  irradiance("wall.json", "--environment faces.pfm --environment-surface "
                                          "cube:coupled;layout=strip"),
                  3 * sky_pi, 1e-5);
    is_irradiance(
        "an even sky in HEALPix",
        irradiance("wall.json", "--environment pixels.pfm --environment-surface healpix:4"),
        3 * sky_pi, 1e-5);
    // the sun's texel: its solid angle, and where it is
    const double lon = (20.5 / 64 * 360 - 180) * sky_pi / 180;
    const double above = (90 - 24.0 / 32 * 180) * sky_pi / 180;
    const double below = (90 - 25.0 / 32 * 180) * sky_pi / 180;
    const double lat = (above + below) / 2;
    const double angle = 2 * sky_pi / 64 * (std::sin(above) - std::sin(below));
    is_irradiance("a sun of one texel", irradiance("wall.json", "--environment sun.pfm"),
                  -1000 * angle * std::sin(lat), 0.02);
    const double towards = (0.3 * std::cos(lat) * std::cos(lon) -
                            0.2 * std::cos(lat) * std::sin(lon) - std::sin(lat)) /
                           std::sqrt(1.13);
    is_irradiance("and where it stands", irradiance("tilted.json", "--environment sun.pfm"),
                  1000 * angle * towards, 0.02);
}

// Of a picture that is not even the same light comes in all of its kinds.
void is_the_same_in_all_surfaces()
{
    make_sky_inputs();
    write_sky("half.pfm", 4, 2, 1, 1, 1, 9);
    does("reproject --to equirect --size 64 --filter bilinear half.pfm smooth.pfm --quiet");
    const double seen = irradiance("tilted.json", "--environment smooth.pfm");
    for (const std::string kind : {"cube:coupled;layout=strip", "cube:gnomonic;layout=cross",
                                   "cube:healpix;layout=column", "healpix:16", "octahedral"})
    {
        does("reproject --to '" + kind + (kind == "healpix:16" ? "" : "' --size '32") +
             "' smooth.pfm other.pfm --quiet");
        is_irradiance(
            kind,
            irradiance("tilted.json", "--environment other.pfm --environment-surface " + kind),
            seen, 0.02);
    }
}

double mean_error(const Picture &picture, const Picture &truth, double &spread)
{
    double sum = 0;
    double square = 0;
    const double n = view_width * view_height;
    for (int i = 0; i < view_width * view_height; ++i)
    {
        const double off = picture.first(i % view_width, i / view_width) -
                           truth.first(i % view_width, i / view_width);
        sum += off;
        square += off * off;
    }
    spread = std::sqrt(square / n);
    return sum / n;
}

void makes_noise()
{
    make_sky_inputs();
    write_sensor("bright.json", "70"); // so that noise does not turn phases around
    does("tof simulate wall.json bright.json pose.txt -o calm --quiet");
    does("tof simulate wall.json bright.json pose.txt -o night --quiet --noise --seed 5");
    does("tof simulate wall.json bright.json pose.txt -o day --quiet --noise --seed 5 "
         "--environment even.pfm");
    does("tof simulate wall.json bright.json pose.txt -o again --quiet --noise --seed 5 "
         "--environment even.pfm --threads 7");
    result(same_content("day/phase_0000_2.exr", "again/phase_0000_2.exr"),
           "the same bits with seven threads");
    const Picture truth("calm/distance_0000.exr");
    double night = 0;
    double day = 0;
    mean_error(Picture("night/distance_0000.exr"), truth, night);
    const double off = mean_error(Picture("day/distance_0000.exr"), truth, day);
    result(day > 1.5 * night, "surroundings are noise",
           std::to_string(day) + " and " + std::to_string(night));
    result(std::fabs(off) < 4 * day / std::sqrt(view_width * view_height), "and no other distance",
           std::to_string(off) + " of " + std::to_string(day));
    const std::string about = content_of("day/metadata.json");
    result(matches(about, "\"environment\":.\"even.pfm\"") &&
               matches(about, "\"environment_surface\":.\"equirect\"") &&
               matches(about, "the surroundings'"),
           "metadata says where light is from", about);
}

// Kilobytes that the process has had at most since they were last asked for; 0 where the system does not tell.
long peak_kilobytes()
{
    std::ifstream status("/proc/self/status");
    long most = 0;
    for (std::string line; std::getline(status, line);)
    {
        most = line.rfind("VmHWM:", 0) == 0 ? std::stol(line.substr(6)) : most;
    }
    std::ofstream reset("/proc/self/clear_refs");
    return reset << "5" << std::flush ? most : 0;
}

// 64 times the texels of a face would be 22 MB here; all else takes 9. What sanitizers keep is not measured.
void takes_little_memory()
{
    make_sky_inputs();
    write_sky("small.pfm", 8, 4, 1);
    write_sky("large.pfm", 1024, 512, 1);
    const auto peak_of = [](const std::string &sky)
    {
        peak_kilobytes();
        does("tof simulate wall.json sensor.json pose.txt -o made --quiet --threads 1 "
             "--environment " +
             sky);
        return peak_kilobytes();
    };
    peak_of("small.pfm");
    const long small = peak_of("small.pfm");
    const long large = peak_of("large.pfm");
    const bool is_measured = small != 0 && !is_sanitized();
    result(!is_measured || large - small < 18000,
           is_measured ? "a picture is resampled by bands" : "memory cannot be measured here",
           std::to_string(small) + " kB and " + std::to_string(large));
}

void refuses_pictures()
{
    make_sky_inputs();
    const std::string good = "tof simulate wall.json sensor.json pose.txt -o made ";
    fails("a surface of no picture", 2, "--environment-surface says what --environment shows",
          good + "--environment-surface cube");
    fails("no such picture", 1, "'absent.pfm' cannot be read", good + "--environment absent.pfm");
    fails("a picture of no name", 1, "'' cannot be read", good + "--environment ''");
    fails("a surface of no name", 2, "--environment-surface: ''",
          good + "--environment even.pfm --environment-surface ''");
    write_sky("strip.pfm", 6, 1, 1);
    fails("a shape that says nothing", 2, "--environment-surface is missing: 'strip.pfm'",
          good + "--environment strip.pfm");
    fails("a shape of something else", 2, "'cube' of 'strip.pfm', which is 6 x 1",
          good + "--environment strip.pfm --environment-surface cube");
    fails("no surface", 2, "no mapping is called 'nothing'",
          good + "--environment strip.pfm --environment-surface nothing");
    write_sky("one.pfm", 4, 4, 1);
    fails("six pictures", 2, "is of several images",
          good + "--environment one.pfm --environment-surface cube");
    for (const float bad : {-1.0f, -0.5f, std::nanf(""), INFINITY, -INFINITY})
    {
        write_sky("bad.pfm", 16, 8, 1, 3, 2, bad);
        fails("a radiance of " + std::to_string(static_cast<double>(bad)), 1,
              "'bad.pfm' has a radiance that is no finite number of 0 or more at x = 3, y = 2",
              good + "--environment bad.pfm");
    }
}

} // namespace

const std::vector<Subject> &tof_environment_subjects()
{
    static const std::vector<Subject> subjects = {
        {"tof_surroundings", gives_electrons},
        {"tof_surfaces_around", is_the_same_in_all_surfaces},
        {"tof_noise_of_surroundings", makes_noise},
        {"tof_memory_of_surroundings", takes_little_memory},
        {"tof_bad_surroundings", refuses_pictures}};
    return subjects;
}
