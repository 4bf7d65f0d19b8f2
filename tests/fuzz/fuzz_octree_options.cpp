// SPDX-License-Identifier: MIT
//
// The command line of cubemap-octree, and the files that it reads. Input: that of fuzz_program.hpp with the letters c camera.json,
// p pose.txt, t tree.bt, v tree.ot. The program runs in a folder with these files, a sequence and a map; nothing elsewhere can be
// named.

#include "fuzz_program.hpp"

#include <initializer_list>
#include <vector>

#include "tools/octree/octree_main.h"

namespace
{

constexpr const char *pose_text = "1 0 0 1 0.5 -0.5 0.5 -0.5\n";
constexpr const char *tree_text =
    "# Octomap OcTree binary file\nid OcTree\nsize 3\nres 0.1\ndata\n\x06";

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
        write("camera.json", fuzzed_camera);
        write("pose.txt", pose_text);
        write("tree.bt", std::string(tree_text) + std::string(1, '\0'));
        write("tree.ot", "# Octomap OcTree file\nid OcTree\nsize 0\nres 0.1\ndata\n");
        cm_camera *const camera = make_fuzzed_camera();
        write_fuzzed_sequence(path_of("tum"), CM_SEQUENCE_TUM, camera);
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

bool is_large(char letter, std::string_view content)
{
    return letter == 'c' && is_large_camera(content);
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

} // namespace

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const OctreeFolder folder;
    static constexpr FuzzedProgram program = {"cubemap-octree", cm_octree_main, file_of,
                                              is_large,         asks_much,      is_filter};
    return fuzz_program(program, folder, data, size);
}
