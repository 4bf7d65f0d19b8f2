// SPDX-License-Identifier: MIT
//
// The command line of cubemap-octree, and the files that it reads. Input: an argument a line; after an empty line a letter, which
// of the files is another one (c camera.json, p pose.txt, t tree.bt, v tree.ot, - standard input), and what that has. The program
// runs in a folder with these files, a sequence and a map; nothing elsewhere can be named. Whatever it is given, it succeeds and
// says nothing, or says why not in one line and leaves nothing.

#include "fuzz_folder.hpp"

#include <initializer_list>
#include <vector>

#include "modules/scene/io/camera_file.h"
#include "modules/scene/io/sequence.h"
#include "tools/octree/octree_main.h"

namespace
{

constexpr const char *camera_text =
    "{\"width\":4,\"height\":3,\"fx\":4,\"fy\":4,\"cx\":1.5,\"cy\":1,\"depth_scale\":1000}";
constexpr const char *pose_text = "1 0 0 1 0.5 -0.5 0.5 -0.5\n";
constexpr const char *tree_text =
    "# Octomap OcTree binary file\nid OcTree\nsize 3\nres 0.1\ndata\n\x06";

// Larger pictures take long and show nothing else.
constexpr std::uint32_t pixels_most = 1024;

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

int call_octree(const cm_streams &streams, std::initializer_list<const char *> words)
{
    std::vector<std::string> texts(words.begin(), words.end());
    std::vector<char *> argument;
    for (std::string &each : texts)
    {
        argument.push_back(each.data());
    }
    argument.push_back(nullptr);
    return cm_octree_main(static_cast<int>(texts.size()), argument.data(), &streams);
}

// The folder with all files as they are without an input.
class OctreeFolder : public FuzzFolder
{
public:
    OctreeFolder() : FuzzFolder("fuzz-octree")
    {
        write("camera.json", camera_text);
        write("pose.txt", pose_text);
        write("tree.bt", std::string(tree_text) + std::string(1, '\0'));
        write("tree.ot", "# Octomap OcTree file\nid OcTree\nsize 0\nres 0.1\ndata\n");
        cm_camera *camera = nullptr;
        double scale = 0;
        char message[CM_IMAGE_MESSAGE] = "";
        EXPECT(cm_camera_file_parse("it", camera_text, strlen(camera_text), &camera, &scale,
                                    message) == CM_OK,
               "%s", message);
        write_sequence(path_of("tum"), CM_SEQUENCE_TUM, camera);
        cm_camera_destroy(camera);
        make_map();
        keep();
    }

private:
    void make_map() const
    {
        const cm_streams streams = {stdin, stdout, stderr};
        enter();
        EXPECT(call_octree(streams, {"cubemap-octree", "integrate", "tum", "-o", "a.map", "--edge",
                                     "0.25", "--levels", "6", "--quiet", "--threads", "1"}) == 0,
               "no map");
        leave();
    }
};

const char *file_of(char letter)
{
    switch (letter)
    {
    case 'c':
        return "camera.json";
    case 'p':
        return "pose.txt";
    case 't':
        return "tree.bt";
    case 'v':
        return "tree.ot";
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
    return large;
}

// Edges and pictures that are asked for may take all memory: only small ones are tried.
bool asks_much(const arguments &given)
{
    for (int i = 0; i < given.count; ++i)
    {
        const std::string_view word = given.argument[i];
        if (word.rfind("--ed", 0) == 0 || word.rfind("--si", 0) == 0 ||
            word.rfind("--le", 0) == 0 || word.rfind("--b", 0) == 0 ||
            word.find(";size") != std::string_view::npos)
        {
            return true;
        }
    }
    return false;
}

// Those that answer lines have answered the good ones before the bad one.
bool is_filter(const arguments &given)
{
    for (int i = 1; i < given.count; ++i)
    {
        const std::string_view word = given.argument[i];
        if (word == "query" || word == "ray")
        {
            return true;
        }
    }
    return false;
}

void check_talk(int status, const talk &with, bool answers_lines)
{
    EXPECT(status >= 0 && status <= 2, "exit status %d", status);
    EXPECT(status == 0 ? with.messages_size == 0
                       : is_one_message(with.messages, "cubemap-octree: "),
           "exit status %d: %s", status, with.messages);
    EXPECT(status == 0 || with.output_size == 0 || answers_lines, "exit status %d, but: %s", status,
           with.output);
}

void run_octree(const OctreeFolder &folder, arguments &given, std::string_view input)
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
    const bool answers_lines = is_filter(given);
    const int status = cm_octree_main(given.count, given.argument, &streams);
    folder.leave();
    stdin = own_input;
    EXPECT(std::fclose(in) == 0 && std::fclose(output) == 0 && std::fclose(messages) == 0,
           "no memory");
    check_talk(status, with, answers_lines);
    EXPECT(!folder.remove_others() || status == 0, "exit status %d, but something is left", status);
    drop_talk(&with);
}

} // namespace

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const OctreeFolder folder;
    arguments given = read_arguments("cubemap-octree", data, size);
    const arguments kept = given; // the program changes their order
    const std::string rest(reinterpret_cast<const char *>(given.rest), given.rest_size);
    const char letter = rest.empty() ? '\0' : rest[0];
    const std::string_view text = std::string_view(rest).substr(rest.empty() ? 0 : 1);
    const char *const file = file_of(letter);
    const bool elsewhere = names_elsewhere(given) || text.find("..") != std::string_view::npos;
    if (!elsewhere && !is_large(letter, text) && !asks_much(given))
    {
        std::string before;
        if (file != nullptr)
        {
            before = folder.read(file);
            folder.write(file, text);
        }
        run_octree(folder, given, letter == '-' ? text : std::string_view());
        if (file != nullptr)
        {
            folder.write(file, before);
        }
    }
    given = kept;
    drop_arguments(&given);
    return 0;
}
