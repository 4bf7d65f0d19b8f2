// SPDX-License-Identifier: MIT
//
// The command line of cubemap-tof, and the files that it reads. Input: that of fuzz_program.hpp with the letters s sensor.json,
// p path.txt, w world.json, b table.csv. The program runs in a folder with these files; nothing elsewhere can be named.

#include "fuzz_program.hpp"

#include "modules/scene/io/trajectory_file.h"
#include "tools/cli/program.hpp"
#include "tools/tof/tof_main.h"
#include "tools/tof/tof_sensor.hpp"

namespace
{

constexpr const char *path_text = "0 0 0 0 0 0 0 1\n1e-3 0.1 0 0 0 0 0 1\n";
constexpr const char *world_text =
    "{\"spheres\":[{\"centre\":[0,0,1],\"radius\":0.2,\"motion\":[[0,0,0,0,0,0,0,1],"
    "[1,1,0,0,0,0,0,1]]}],\"planes\":[{\"point\":[0,0,2],\"normal\":[0,0,1],\"brdf\":{\"kind\":"
    "\"measured\",\"file\":\"table.csv\"}}]}";
constexpr const char *sensor_text =
    "{\"camera\":{\"width\":4,\"height\":3,\"fx\":4,\"fy\":4,\"cx\":1.5,\"cy\":1},\"pitch\":12e-6,"
    "\"f_number\":1.2,\"wavelength\":850e-9,\"efficiency\":0.4,\"exposure\":1e-3,\"frequency\":2e7,"
    "\"phases\":4,\"duty\":0.5,\"contrast\":0.8,\"lights\":[{\"power\":1,\"aperture\":6.28}]}";
constexpr const char *table_text = "0 0 0 0.3\n30 30 180 0.3\n60 60 90 0.2\n";

// More of them take long and show nothing else.
constexpr std::size_t poses_most = 3;
constexpr std::size_t pixels_most = 256;
constexpr int phases_most = 8;
constexpr std::size_t lights_most = 3;

// The folder with all files as they are without an input.
class TofFolder : public FuzzFolder
{
public:
    TofFolder() : FuzzFolder("fuzz-tof")
    {
        write("sensor.json", sensor_text);
        write("path.txt", path_text);
        write("world.json", world_text);
        write("table.csv", table_text);
        keep();
    }
};

const char *file_of(char letter)
{
    switch (letter)
    {
    case 's':
        return "sensor.json";
    case 'p':
        return "path.txt";
    case 'w':
        return "world.json";
    case 'b':
        return "table.csv";
    default:
        return nullptr;
    }
}

bool is_large_sensor(std::string_view text)
{
    try
    {
        const TofSensor made = parse_tof_sensor("it", text);
        const cm_camera_options &shape = *cm_camera_describe(made.camera.get());
        return std::size_t{shape.width} * shape.height > pixels_most ||
               made.sensor.phases > phases_most || made.light.size() > lights_most;
    }
    catch (const Failure &)
    {
        return false;
    }
}

bool is_large(char letter, std::string_view text)
{
    char message[CM_IMAGE_MESSAGE] = "";
    if (letter == 's')
    {
        return is_large_sensor(text);
    }
    cm_pose_list list = {};
    const bool large =
        letter == 'p' &&
        cm_trajectory_file_parse("it", text.data(), text.size(), &list, message) == CM_OK &&
        list.count > poses_most;
    cm_pose_list_clear(&list);
    return large;
}

// Whole papers, pictures of presets, budgets, and numbers of two digits.
bool asks_much(const arguments &given)
{
    bool is_texel = false, has_size = false;
    for (int i = 1; i < given.count; ++i)
    {
        const std::string word = given.argument[i];
        is_texel |= word == "texel";
        has_size |= word == "--size"; // a million pixels without it
        const std::size_t digit = word.find_first_of("0123456789");
        const bool is_long_number =
            digit != std::string::npos && word.find_first_of("0123456789", digit + 1) == digit + 1;
        if (word == "reproduce" || word.compare(0, 4, "--pr") == 0 || is_long_number)
        {
            return true;
        }
    }
    return is_texel && !has_size;
}

// Frames before one that fails have been written to the stream.
bool answers_frames(const arguments &)
{
    return true;
}

} // namespace

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const TofFolder folder;
    static constexpr FuzzedProgram program = {"cubemap-tof", cm_tof_main, file_of,
                                              is_large,      asks_much,   answers_frames};
    return fuzz_program(program, folder, data, size);
}
