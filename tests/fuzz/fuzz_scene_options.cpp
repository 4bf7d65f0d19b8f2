// SPDX-License-Identifier: MIT
//
// The command line of cubemap-scene, and the files that it reads. Input: an argument a line; after an empty line a letter, which
// of the files is another one (c camera.json, p path.txt, w world.json, d and g the lists and the poses of tum, l those of open,
// s one pose of seven, - standard input), and what that has. The program runs in a folder with these files; nothing elsewhere
// can be named. Whatever it is given, it succeeds and says nothing, or says why not in one line and leaves nothing.

#include "fuzz_folder.hpp"

#include "modules/scene/io/camera_file.h"
#include "modules/scene/io/sequence.h"
#include "modules/scene/io/trajectory_file.h"
#include "tools/scene/scene_main.h"

namespace
{

constexpr const char *camera_text =
    "{\"width\":4,\"height\":3,\"fx\":4,\"fy\":4,\"cx\":1.5,\"cy\":1,\"depth_scale\":1000}";
constexpr const char *path_text = "1 0 0 1 0.5 -0.5 0.5 -0.5\n2 0.1 0 1 0.5 -0.5 0.5 -0.5\n";
constexpr const char *world_text = "{\"spheres\":[{\"centre\":[2,0,1],\"radius\":1}],"
                                   "\"planes\":[{\"point\":[0,0,0],\"normal\":[0,0,1]}]}";

// Larger pictures, and more of them, take long and show nothing else.
constexpr std::uint32_t pixels_most = 1024;
constexpr std::size_t poses_most = 6;

void write_sequence(const std::string &folder, cm_sequence_layout layout, const cm_camera *camera)
{
    char message[CM_IMAGE_MESSAGE] = "";
    cm_sequence_writer *writer = nullptr;
    EXPECT(cm_sequence_create(folder.c_str(), layout, camera, 1000, &writer, message) == CM_OK,
           "%s", message);
    for (int i = 0; i < 2; ++i)
    {
        std::uint16_t depth[12] = {1000, 2000, 0, 4000, 500};
        cm_view view = {};
        view.size = sizeof view;
        view.time = 1 + i;
        view.camera = camera;
        view.pose.rotation = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
        view.depth = {sizeof view.depth, depth, CM_PIXEL_U16, 4, 3, 1, 0, 0};
        view.depth_unit = 0.001;
        EXPECT(cm_sequence_write(writer, &view, nullptr, message) == CM_OK, "%s", message);
    }
    EXPECT(cm_sequence_finish(writer, message) == CM_OK, "%s", message);
    cm_sequence_drop(writer);
}

// The folder with all files as they are without an input.
class SceneFolder : public FuzzFolder
{
public:
    SceneFolder() : FuzzFolder("fuzz-scene")
    {
        write("camera.json", camera_text);
        write("cube.json", "{\"mapping\":\"coupled\",\"frame\":\"geo\",\"size\":2}");
        write("path.txt", path_text);
        write("world.json", world_text);
        cm_camera *camera = nullptr;
        double scale = 0;
        char message[CM_IMAGE_MESSAGE] = "";
        EXPECT(cm_camera_file_parse("it", camera_text, strlen(camera_text), &camera, &scale,
                                    message) == CM_OK,
               "%s", message);
        write_sequence(path_of("tum"), CM_SEQUENCE_TUM, camera);
        write_sequence(path_of("open"), CM_SEQUENCE_OPEN3D, camera);
        write_sequence(path_of("seven"), CM_SEQUENCE_SEVEN_SCENES, camera);
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

// Would it take long?
bool is_large(char letter, std::string_view text)
{
    char message[CM_IMAGE_MESSAGE] = "";
    bool large = false;
    if (letter == 'c')
    {
        cm_camera *camera = nullptr;
        double scale = 0;
        if (cm_camera_file_parse("it", text.data(), text.size(), &camera, &scale, message) == CM_OK)
        {
            const cm_camera_options *const options = cm_camera_describe(camera);
            large = std::uint64_t{options->width} * options->height > pixels_most;
        }
        cm_camera_destroy(camera);
    }
    if (letter == 'p')
    {
        cm_pose_list list = {};
        large = cm_trajectory_file_parse("it", text.data(), text.size(), &list, message) == CM_OK &&
                list.count > poses_most;
        cm_pose_list_clear(&list);
    }
    return large;
}

void check_talk(int status, const talk &with)
{
    EXPECT(status >= 0 && status <= 2, "exit status %d", status);
    EXPECT(status == 0 ? with.messages_size == 0 : is_one_message(with.messages, "cubemap-scene: "),
           "exit status %d: %s", status, with.messages);
    EXPECT(status == 0 || with.output_size == 0, "exit status %d, but: %s", status, with.output);
}

void run_scene(const SceneFolder &folder, arguments &given, std::string_view input)
{
    talk with = {};
    std::FILE *const own_input = stdin;
    std::FILE *const in = input.empty()
                              ? std::fopen("/dev/null", "rb")
                              : fmemopen(const_cast<char *>(input.data()), input.size(), "rb");
    std::FILE *const output = open_memstream(&with.output, &with.output_size);
    std::FILE *const messages = open_memstream(&with.messages, &with.messages_size);
    EXPECT(in != nullptr && output != nullptr && messages != nullptr, "no memory");
    const cm_streams streams = {in, output, messages};
    stdin = in;
    folder.enter();
    const int status = cm_scene_main(given.count, given.argument, &streams);
    folder.leave();
    stdin = own_input;
    EXPECT(std::fclose(in) == 0 && std::fclose(output) == 0 && std::fclose(messages) == 0,
           "no memory");
    check_talk(status, with);
    EXPECT(!folder.remove_others() || status == 0, "exit status %d, but something is left", status);
    drop_talk(&with);
}

} // namespace

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const SceneFolder folder;
    arguments given = read_arguments("cubemap-scene", data, size);
    const arguments kept = given; // the program changes their order
    const std::string rest(reinterpret_cast<const char *>(given.rest), given.rest_size);
    const char letter = rest.empty() ? '\0' : rest[0];
    const std::string_view text = std::string_view(rest).substr(rest.empty() ? 0 : 1);
    const char *const file = file_of(letter);
    const bool elsewhere = names_elsewhere(given) || text.find("..") != std::string_view::npos;
    if (!elsewhere && !is_large(letter, text))
    {
        std::string before;
        if (file != nullptr)
        {
            before = folder.read(file);
            folder.write(file, text);
        }
        run_scene(folder, given, letter == '-' ? text : std::string_view());
        if (file != nullptr)
        {
            folder.write(file, before);
        }
    }
    given = kept;
    drop_arguments(&given);
    return 0;
}
