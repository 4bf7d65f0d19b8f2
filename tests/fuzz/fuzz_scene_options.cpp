// SPDX-License-Identifier: MIT
//
// The command line of cubemap-scene, and the files that it reads. Input: that of fuzz_program.hpp with the letters c camera.json,
// p path.txt, w world.json, d and g the lists and the poses of tum, l those of open, s one pose of seven. The program runs in a
// folder with these files; nothing elsewhere can be named.

#include "fuzz_program.hpp"

#include "modules/scene/io/trajectory_file.h"
#include "tools/scene/scene_main.h"

namespace
{

constexpr const char *path_text = "1 0 0 1 0.5 -0.5 0.5 -0.5\n2 0.1 0 1 0.5 -0.5 0.5 -0.5\n";
constexpr const char *world_text = "{\"spheres\":[{\"centre\":[2,0,1],\"radius\":1}],"
                                   "\"planes\":[{\"point\":[0,0,0],\"normal\":[0,0,1]}]}";

// More of them take long and show nothing else.
constexpr std::size_t poses_most = 6;

// The folder with all files as they are without an input.
class SceneFolder : public FuzzFolder
{
public:
    SceneFolder() : FuzzFolder("fuzz-scene")
    {
        write("camera.json", fuzzed_camera);
        write("cube.json", "{\"mapping\":\"coupled\",\"frame\":\"geo\",\"size\":2}");
        write("path.txt", path_text);
        write("world.json", world_text);
        cm_camera *const camera = make_fuzzed_camera();
        write_fuzzed_sequence(path_of("tum"), CM_SEQUENCE_TUM, camera);
        write_fuzzed_sequence(path_of("open"), CM_SEQUENCE_OPEN3D, camera);
        write_fuzzed_sequence(path_of("seven"), CM_SEQUENCE_SEVEN_SCENES, camera);
        cm_camera_destroy(camera);
        keep();
    }
};

const char *file_of(char letter)
{
    switch (letter)
    {
    case 'c':
        return "camera.json";
    case 'p':
        return "path.txt";
    case 'w':
        return "world.json";
    case 'd':
        return "tum/depth.txt";
    case 'g':
        return "tum/groundtruth.txt";
    case 'l':
        return "open/trajectory.log";
    case 's':
        return "seven/frame-000000.pose.txt";
    default:
        return nullptr;
    }
}

bool is_large(char letter, std::string_view text)
{
    char message[CM_IMAGE_MESSAGE] = "";
    bool large = letter == 'c' && is_large_camera(text);
    if (letter == 'p')
    {
        cm_pose_list list = {};
        large = cm_trajectory_file_parse("it", text.data(), text.size(), &list, message) == CM_OK &&
                list.count > poses_most;
        cm_pose_list_clear(&list);
    }
    return large;
}

bool never(const arguments &)
{
    return false;
}

} // namespace

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const SceneFolder folder;
    static constexpr FuzzedProgram program = {"cubemap-scene", cm_scene_main, file_of,
                                              is_large,        never,         never};
    return fuzz_program(program, folder, data, size);
}
