// SPDX-License-Identifier: MIT
//
// Programs of depth views that run inside a harness, in a folder with files of which the input is one. Input: an argument a line;
// after an empty line a letter, which of the files is another one (- standard input), and what that has. Whatever a program is
// given, it succeeds and says nothing, or says why not in one line and leaves nothing.

#ifndef TESTS_FUZZ_PROGRAM_HPP
#define TESTS_FUZZ_PROGRAM_HPP

#include "fuzz_folder.hpp"

#include "modules/scene/io/camera_file.h"
#include "modules/scene/io/sequence.h"
#include "tools/cli/streams.h"

struct FuzzedProgram
{
    const char *name; // as its messages begin
    int (*run)(int, char **, const cm_streams *);
    const char *(*file_of)(char letter);                     // nullptr: no file
    bool (*is_large)(char letter, std::string_view content); // would it take long?
    bool (*asks_much)(const arguments &given);
    bool (*answers_lines)(const arguments &given); // those before a bad one are answered
};

constexpr const char *fuzzed_camera =
    "{\"width\":4,\"height\":3,\"fx\":4,\"fy\":4,\"cx\":1.5,\"cy\":1,\"depth_scale\":1000}";

// The camera of that text, to be destroyed.
inline cm_camera *make_fuzzed_camera()
{
    cm_camera *camera = nullptr;
    double scale = 0;
    char message[CM_IMAGE_MESSAGE] = "";
    EXPECT(cm_camera_file_parse("it", fuzzed_camera, strlen(fuzzed_camera), &camera, &scale,
                                message) == CM_OK,
           "%s", message);
    return camera;
}

// Two views of that camera.
inline void write_fuzzed_sequence(const std::string &folder, cm_sequence_layout layout,
                                  const cm_camera *camera)
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

// Does it describe a camera whose pictures take long, and show nothing else?
inline bool is_large_camera(std::string_view content)
{
    constexpr std::uint64_t pixels_most = 1024;
    char message[CM_IMAGE_MESSAGE] = "";
    bool large = false;
    cm_camera *camera = nullptr;
    double scale = 0;
    if (cm_camera_file_parse("it", content.data(), content.size(), &camera, &scale, message) ==
        CM_OK)
    {
        const cm_camera_options *const options = cm_camera_describe(camera);
        large = std::uint64_t{options->width} * options->height > pixels_most;
    }
    cm_camera_destroy(camera);
    return large;
}

inline void check_talk(const FuzzedProgram &program, int status, const talk &with,
                       bool answers_lines)
{
    const std::string begin = std::string(program.name) + ": ";
    EXPECT(status >= 0 && status <= 2, "exit status %d", status);
    EXPECT(status == 0 ? with.messages_size == 0 : is_one_message(with.messages, begin.c_str()),
           "exit status %d: %s", status, with.messages);
    EXPECT(status == 0 || with.output_size == 0 || answers_lines, "exit status %d, but: %s", status,
           with.output);
}

inline void run_program(const FuzzedProgram &program, const FuzzFolder &folder, arguments &given,
                        std::string_view input)
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
    const bool answers_lines = program.answers_lines(given);
    const int status = program.run(given.count, given.argument, &streams);
    folder.leave();
    stdin = own_input;
    EXPECT(std::fclose(in) == 0 && std::fclose(output) == 0 && std::fclose(messages) == 0,
           "no memory");
    check_talk(program, status, with, answers_lines);
    EXPECT(!folder.remove_others() || status == 0, "exit status %d, but something is left", status);
    drop_talk(&with);
}

inline int fuzz_program(const FuzzedProgram &program, const FuzzFolder &folder, const uint8_t *data,
                        size_t size)
{
    arguments given = read_arguments(program.name, data, size);
    const arguments kept = given; // the program changes their order
    const std::string rest(reinterpret_cast<const char *>(given.rest), given.rest_size);
    const char letter = rest.empty() ? '\0' : rest[0];
    const std::string_view content = std::string_view(rest).substr(rest.empty() ? 0 : 1);
    const char *const file = program.file_of(letter);
    const bool elsewhere = names_elsewhere(given) || content.find("..") != std::string_view::npos;
    if (!elsewhere && !program.is_large(letter, content) && !program.asks_much(given))
    {
        std::string before;
        if (file != nullptr)
        {
            before = folder.read(file);
            folder.write(file, content);
        }
        run_program(program, folder, given, letter == '-' ? content : std::string_view());
        if (file != nullptr)
        {
            folder.write(file, before);
        }
    }
    given = kept;
    drop_arguments(&given);
    return 0;
}

#endif
