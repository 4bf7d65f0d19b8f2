// SPDX-License-Identifier: MIT
//
// Sensors that are built in. What is published of a camera is said beside it; the rest is assumed, chosen so that distances
// of its range have the noise that such cameras have.

#include "tof_sensor.hpp"
#include "tof_table.h"

#include "tools/cli/program.hpp"

namespace
{

struct Preset
{
    const char *name;
    const char *text;
};

// In the order of tof_preset_names.
constexpr Preset presets[] = {
    // Published: 224 x 171 pixels, 15 frames a second, 45 degrees from top to bottom, 850 nm, two frequencies.
    {"pico-flexx", R"({
 "camera": {"width": 224, "height": 171, "fx": 206.4, "fy": 206.4, "cx": 111.5, "cy": 85},
 "pitch": 17.5e-6, "f_number": 1.2, "wavelength": 850e-9, "efficiency": 0.4, "exposure": 0.7e-3,
 "readout": 0.5e-3, "pause": 0.05706666666666667, "frequency": 80.32e6, "second_frequency": 60.24e6,
 "phases": 4, "duty": 0.5, "contrast": 0.7, "full_well": 200000, "dark": 1000, "read_noise": 20,
 "lights": [{"position": [0.02, 0, 0], "power": 1, "aperture": 1.3}]
})"},
    // Published: 200 x 200 pixels of 45 um, 40 degrees, 870 nm, 20 MHz, lights at both sides.
    {"camcube", R"({
 "camera": {"width": 200, "height": 200, "fx": 274.7, "fy": 274.7, "cx": 99.5, "cy": 99.5},
 "pitch": 45e-6, "f_number": 1.4, "wavelength": 870e-9, "efficiency": 0.35, "exposure": 1e-3,
 "readout": 1e-3, "pause": 17e-3, "frequency": 20e6, "phases": 4, "duty": 0.5, "contrast": 0.6,
 "full_well": 1e6, "dark": 5000, "read_noise": 60,
 "lights": [{"position": [-0.1, 0, 0], "power": 1.5, "aperture": 0.9},
            {"position": [0.1, 0, 0], "power": 1.5, "aperture": 0.9}]
})"},
    // Lambers, Hoberg and Kolb 2015, section V: 256 columns, 70 degrees, 12 um, 26 frames in 0.2 s.
    {"dual-12um", R"({
 "camera": {"width": 256, "height": 192, "fx": 182.803, "fy": 182.803, "cx": 127.5, "cy": 95.5},
 "pitch": 12e-6, "f_number": 1.2, "wavelength": 850e-9, "efficiency": 0.4, "exposure": 1e-3,
 "readout": 0.923076923e-3, "frequency": 20e6, "phases": 4, "duty": 0.5, "contrast": 0.8,
 "full_well": 200000, "dark": 1000, "read_noise": 20,
 "lights": [{"power": 1, "aperture": 1.6}]
})"},
    // The same: half as many more pixels each way, 8 um, circuits between pixels.
    {"single-8um", R"({
 "camera": {"width": 384, "height": 288, "fx": 274.2045, "fy": 274.2045, "cx": 191.5, "cy": 143.5},
 "pitch": 8e-6, "f_number": 1.2, "wavelength": 850e-9, "efficiency": 0.4, "exposure": 1e-3,
 "readout": 0.923076923e-3, "frequency": 20e6, "phases": 4, "duty": 0.5, "contrast": 0.8,
 "full_well": 200000, "dark": 1000, "read_noise": 20, "single_readout": 1,
 "lights": [{"power": 1, "aperture": 1.6}]
})"}};

} // namespace

TofSensor tof_preset(const std::string &name)
{
    for (const Preset &each : presets)
    {
        if (name == each.name)
        {
            return parse_tof_sensor(name, each.text);
        }
    }
    throw UsageFailure("--preset is " + in_quotes(name) + ", which is not built in");
}
