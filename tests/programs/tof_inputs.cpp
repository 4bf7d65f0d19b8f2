// SPDX-License-Identifier: MIT

#include "tof_inputs.hpp"
#include "image_cases.hpp"

#include <filesystem>

namespace
{

constexpr const char *camera_text =
    R"("camera": {"width": 24, "height": 18, "fx": 20, "fy": 20, "cx": 11.5, "cy": 8.5})";

} // namespace

std::string sensor_text(const std::string &rest, const std::string &exposure)
{
    return std::string("{") + camera_text + ",\n\"pitch\": 12e-6, \"f_number\": 1.2, " +
           "\"wavelength\": 850e-9, \"efficiency\": 0.4,\n" + exposure +
           ", \"frequency\": 20e6, \"phases\": 4, \"duty\": 0.5, \"contrast\": 0.8,\n" + rest +
           "}\n";
}

void make_tof_inputs()
{
    write_file("sphere.json",
               R"({"spheres": [{"centre": [0, 0, 0], "radius": 1, "reflectance": 0.5}]})");
    write_file("wall.json", R"({"planes": [{"point": [0, 0, 2], "normal": [0, 0, 1]}]})");
    write_file("sensor.json", sensor_text());
    write_file("pose.txt", "0 0 0 0 0 0 0 1\n");
    write_file("path.txt", "0 0 0 0 0 0 0 1\n1 0 0 0.5 0 0 0 1\n");
    std::filesystem::create_directory("made");
}
