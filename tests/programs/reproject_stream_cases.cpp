// SPDX-License-Identifier: MIT
//
// cubemap-reproject with many pictures: files with numbers, and pipes.

#include "image_cases.hpp"
#include "picture_checks.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>

namespace
{

constexpr int frame_width = 64;
constexpr int frame_height = 32;
constexpr std::size_t samples = std::size_t{frame_width} * frame_height * 3;

constexpr const char *same_to = "reproject --quiet --to equirect --filter nearest ";

// The samples of a picture of noise; another number is another picture.
std::string noise(int number)
{
    make_noise(frame_width, frame_height, "noise.ppm");
    const std::string content = content_of("noise.ppm");
    std::string values = content.substr(content.size() - samples);
    for (char &value : values)
    {
        value = static_cast<char>(value + 7 * number);
    }
    return values;
}

std::string picture(int number)
{
    return "P6\n64 32\n255\n" + noise(number);
}

void result_of(const Ran &ran, int status, const std::string &expression, const std::string &name)
{
    const bool lines = ran.err.find('\n') == ran.err.size() - 1;
    result(ran.status == status && matches(ran.err, expression) && lines, name,
           "status " + std::to_string(ran.status) + "\n" + ran.err);
}

// What goes in comes out again.
void unchanged(const std::string &name, const std::string &options, const std::string &input)
{
    const Ran ran = run_with_input(input, same_to + options + " - -");
    result(ran.status == 0 && ran.err.empty() && ran.out == input, name,
           ran.err + std::to_string(ran.out.size()) + " of " + std::to_string(input.size()) +
               " bytes, " + ran.out.substr(0, 60));
}

void pipes()
{
    unchanged("PPM through a pipe", "", picture(0));
    unchanged("three of them", "", picture(0) + picture(1) + picture(2));
    const std::string values = noise(0);
    unchanged("PGM of 16 bits", "", "P5\n32 16\n65535\n" + values.substr(0, 32 * 16 * 2));
    unchanged("PAM with alpha", "--from equirect",
              "P7\nWIDTH 32\nHEIGHT 16\nDEPTH 4\nMAXVAL 255\nTUPLTYPE RGB_ALPHA\nENDHDR\n" +
                  std::string(std::size_t{32} * 16 * 4, '\xff'));
    std::string light;
    for (int i = 0; i < 4 * 8; ++i)
    {
        const float value = 0.25f * static_cast<float>(i) - 1;
        char bytes[sizeof value];
        std::memcpy(bytes, &value, sizeof value);
        light += std::string(bytes, sizeof value);
    }
    unchanged("PFM, from below", "", "Pf\n8 4\n-1.0\n" + light);
    unchanged("bare bytes", "--raw 64x32:rgb24 --pipe rgb24", values + noise(1));
    unchanged("bare planes of floats", "--raw 8x4:grayf32le --pipe grayf32le", light);
    const Ran planes = run_with_input(picture(0), std::string(same_to) + "--pipe gbrpf32le - -");
    float green = 0;
    float red = 0;
    if (planes.out.size() == samples * sizeof(float))
    {
        std::memcpy(&green, planes.out.data() + 4 * 5, sizeof green);
        std::memcpy(&red, planes.out.data() + 4 * (2 * frame_width * frame_height + 5), sizeof red);
    }
    const auto value_at = [&values](std::size_t index)
    { return static_cast<float>(static_cast<unsigned char>(values[index])) / 255; };
    result(std::fabs(green - value_at(5 * 3 + 1)) < 1e-6f &&
               std::fabs(red - value_at(5 * 3)) < 1e-6f,
           "planes begin with green", planes.err);
    const Ran back =
        run_with_input(planes.out, std::string(same_to) + "--raw 64x32:gbrpf32le --pipe rgb24 - -");
    result(back.out == values, "and come back", back.err);
    const Ran said = run_with_input(picture(0) + picture(1), "reproject --layout 3x2 - -");
    result(said.status == 0 && matches(said.err, "^standard input \\(equirect 64x32, 3 channels, "
                                                 "uint8\\) -> - \\(cube:coupled, frame geo, 3x2 "
                                                 "48x32; [a-z0-9-]*\\), 2 pictures, [0-9.e+]* a "
                                                 "second$"),
           "what was done is on standard error", said.err);
    does("reproject --quiet --layout cross noise.ppm cross.png");
    const Ran sent = run("reproject --quiet cross.png -");
    result(sent.out.substr(0, 13) == "P6\n64 32\n255\n" && sent.out.size() == 13 + samples,
           "from a file into a pipe", sent.err);
}

// A file that is called as messages call the stream, and one as its sidecar would be, say nothing of what comes from it.
void nameless_pipes()
{
    write_file("sky.ppm", picture(0));
    does("reproject --quiet --sidecar --rotate 30,0 --to equirect sky.ppm standard.ppm");
    std::string beside = content_of("standard.json");
    const std::size_t at = beside.find("standard.ppm");
    result(at != std::string::npos, "a sidecar names its picture", beside);
    write_file("-.json", beside.replace(at, std::strlen("standard.ppm"), "standard input"));
    unchanged("a sidecar of no file", "", picture(0));
    std::filesystem::remove("-.json");
    does("reproject --quiet --rotate 30,0 --to equirect sky.ppm standard.jpg");
    write_file("standard input", content_of("standard.jpg"));
    unchanged("a file of the stream's name", "", picture(0));
    std::filesystem::remove("standard input");
}

void names_of_netpbm()
{
    write_file("in.ppm", picture(0));
    for (const std::string name : {"out.ppm", "out.png"})
    {
        does(same_to + std::string("in.ppm ") + name);
        passes("a file " + name, "compare --max 0 in.ppm " + name);
    }
    does("reproject --quiet --filter nearest --to equirect in.ppm light.pfm");
    does("reproject --quiet --filter nearest --to equirect light.pfm back.png");
    passes("PFM has light", "compare --max 0 in.ppm back.png");
    fails("PGM has one channel", 1, "pgm holds 1 channel, the image has 3",
          "reproject in.ppm --to equirect made/a.pgm");
    fails("no compression", 2, "ppm has no compression",
          "reproject in.ppm --to equirect --compression zip made/a.ppm");
    does("reproject --quiet --to equirect --graticule 30 in.ppm lines.ppm");
    does("reproject --quiet --to equirect --graticule 30 in.ppm lines.png");
    passes("lines, rounded alike", "compare --max 0 lines.ppm lines.png");
}

struct WrongPipe
{
    const char *name;
    int status;
    const char *words;
    const char *line;
    std::string input;
};

void wrong_pipes()
{
    const std::string whole = picture(0);
    const WrongPipe wrong[] = {
        {"nothing comes", 1, "has no picture", "reproject - made/a.png", ""},
        {"no picture comes", 1, "picture 1: .*begins with P5", "reproject - made/a.png",
         "GIF89a..."},
        {"a cut picture", 1, "picture 1: .*ends too early: 1 of 32 rows",
         "reproject --to equirect - made/a.png", whole.substr(0, whole.size() - 10)},
        {"a second picture that is cut", 1,
         "picture 2: .*ends too early: 16 of 32 rows are missing; the picture before it is written",
         "reproject --quiet --to equirect - made_%d.png",
         whole + whole.substr(0, 13 + (whole.size() - 13) / 2)},
        {"bare samples, cut", 1, "ends too early", "reproject --raw 64x32:rgb24 - made/a_%f.png",
         std::string(100, 'x')},
        {"six faces into a pipe", 2, "say --layout 3x2", "reproject - -", whole},
        {"six faces from a pipe", 2, "come as one picture",
         "reproject --from cube --from-layout faces - made/a.png", whole},
        {"too many channels", 1, "pgm holds 1 channel", "reproject --to equirect --pipe pgm - -",
         whole},
        {"a file beside a pipe", 2, "leave one out", "reproject --layout 3x2 --sidecar - -", whole},
        {"bare samples from a file", 2, "INPUT is 'noise.ppm', not -",
         "reproject --raw 64x32:rgb24 noise.ppm made/a.png", ""},
        {"a pipe's format of a file", 2, "not -", "reproject --pipe ppm - made/a.png", whole},
        {"no size", 2, "WIDTHxHEIGHT:FORMAT", "reproject --raw rgb24 - made/a.png", whole},
        {"an empty size", 2, "WIDTHxHEIGHT:FORMAT", "reproject --raw 0x4:rgb24 - made/a.png",
         whole},
        {"no format", 2, "one of: gray gray16le", "reproject --raw 4x4:yuv420p - made/a.png",
         whole},
        {"a shape that is none", 1, "picture 1: 'standard input' is 7 x 5",
         "reproject - made/a.png", "P6\n7 5\n255\n" + std::string(7 * 5 * 3, 'x')},
    };
    for (const WrongPipe &each : wrong)
    {
        std::filesystem::create_directory("made");
        make_noise(frame_width, frame_height, "noise.ppm");
        const Ran ran = run_with_input(each.input, each.line);
        result_of(ran, each.status, each.words, each.name);
        result(ran.out.empty() && names_in("made").empty(), "and nothing is written",
               names_in("made"));
    }
    std::FILE *const full = std::fopen("/dev/full", "w");
    if (full != nullptr)
    {
        result_of(run_with_input(whole, std::string(same_to) + "- -", full), 1,
                  "'standard output' cannot be written: No space left",
                  "a full disk behind the pipe");
        std::fclose(full);
    }
    const Ran two = run_with_input(whole + picture(1), "reproject --to equirect - one.png");
    result_of(two, 1, "more than one picture.*the picture before it is written",
              "two pictures for one file");
    result(std::filesystem::exists("one.png"), "the first is there");
}

// What one picture becomes, each of a film does.
void film_outputs()
{
    write_file("in.ppm", picture(1));
    does("reproject --quiet --mips --size 16 in.ppm one.ktx2");
    does("reproject --quiet --border 2 --mapping auto in.ppm one_%f.png");
    const std::string pictures = picture(0) + picture(1);
    const Ran textures = run_with_input(pictures, "reproject --mips --size 16 - sky_%02d.ktx2");
    result(textures.status == 0 && content_of("sky_02.ktx2") == content_of("one.ktx2"),
           "textures of a film", textures.err);
    const Ran borders =
        run_with_input(pictures, "reproject --border 2 --mapping auto - face_%02d_%f.png");
    result(borders.status == 0, "borders of a film, and a mapping that is chosen", borders.err);
    passes("are those of each picture", "compare --max 0 one_4.png face_02_4.png");
}

void films()
{
    const auto name = [](int number) { return "frame_" + std::to_string(number) + ".ppm"; };
    for (int i = 8; i <= 11; ++i)
    {
        write_file(name(i), picture(i));
    }
    write_file("frame_x.ppm", "no frame");
    const Ran ran = does("reproject frame_%d.ppm cube_%03d_%f.png");
    result(matches(ran.out, "^frame_8\\.ppm \\.\\. frame_11\\.ppm \\(equirect 64x32, 3 channels, "
                            "uint8\\) -> cube_008_0\\.png \\.\\. cube_011_5\\.png \\(cube:coupled, "
                            "frame geo, 16x16; [a-z0-9-]*\\), 4 pictures, [0-9.e+]* a second$"),
           "all numbers that are there", ran.out);
    for (const int i : {8, 11})
    {
        does("reproject --quiet " + name(i) + " alone_%f.png");
        const std::string there = "cube_0" + std::string(i < 10 ? "0" : "") + std::to_string(i);
        passes("a frame is what it is alone", "compare --max 0 alone_4.png " + there + "_4.png");
    }
    does("reproject --quiet --start 9 --count 2 frame_%d.ppm part_%d.png --layout strip");
    result(names_in(".").find("part_10.png part_9.png ") != std::string::npos &&
               names_in(".").find("part_11") == std::string::npos,
           "a part of them", names_in("."));
    does("reproject --quiet cube_%03d_%f.png back_%d.png");
    result(std::filesystem::exists("back_8.png") && std::filesystem::exists("back_11.png"),
           "from six faces each");
    const Ran piped = run("reproject --quiet --layout 3x2 frame_%d.ppm -");
    result(piped.out.size() == 4 * (13 + std::size_t{48} * 32 * 3), "into a pipe", piped.err);
}

void wrong_films()
{
    for (const int i : {1, 2, 3, 5})
    {
        write_file("frame_" + std::to_string(i) + ".ppm", picture(i));
    }
    const std::string all = "reproject --layout strip ";
    fails("a gap", 1, "'frame_4.ppm' is missing among pictures 1 to 5; 'frame_5.ppm' is there",
          all + "frame_%d.ppm made/a%d.png");
    fails("too few", 1, "'frame_4.ppm' is missing among pictures 2 to 4",
          all + "--start 2 --count 3 frame_%d.ppm made/a%d.png");
    fails("none", 1, "there is no file 'film_0001.png'", all + "film_%04d.png made/a%d.png");
    fails("no number in OUTPUT", 2, "as in cube_%04d.png", all + "frame_%d.ppm made/a.png");
    fails("no number in INPUT", 2, "INPUT has none", all + "frame_1.ppm made/a%d.png");
    fails("two numbers", 2, "has two numbers", all + "frame_%d.ppm made/a%d-%d.png");
    fails("a number of a folder", 2, "in the name of the file", all + "frame_%d.ppm made/%d/a.png");
    fails("a start of one file", 2, "--start is for films",
          all + "--start 1 frame_1.ppm made/a.png");
    fails("a count of one file", 2, "--count is for films",
          all + "--count 1 frame_1.ppm made/a.png");
    fails("over itself", 2, "is the same file as INPUT",
          "reproject --to equirect --start 5 frame_%d.ppm frame_%d.ppm");
    make_noise(32, 16, "frame_3.ppm");
    result_of(
        run(all + "--quiet --count 3 frame_%d.ppm size_%d.png"), 1,
        "'frame_3.ppm' is equirect;size=32;height=16, 3 channels, uint8, and the pictures before "
        "it are equirect;size=64;.*; the 2 pictures before it are written",
        "another size");
    write_file("frame_3.ppm", picture(3).substr(0, 3000));
    result_of(run(all + "--quiet --count 3 frame_%d.ppm cut_%d.png"), 1,
              "picture 3: 'frame_3.ppm' .*; the 2 pictures before it are written",
              "a damaged frame");
    const std::string names = names_in(".");
    result(names.find("cut_1.png cut_2.png frame") != std::string::npos &&
               names.find("size_1.png size_2.png ") != std::string::npos &&
               names.find("_3.png") == std::string::npos &&
               names.find(".cubemap") == std::string::npos,
           "those before it stay", names);
}

} // namespace

const std::vector<Subject> &reproject_stream_subjects()
{
    static const std::vector<Subject> subjects = {{"pipes", pipes},
                                                  {"nameless_pipes", nameless_pipes},
                                                  {"names_of_netpbm", names_of_netpbm},
                                                  {"wrong_pipes", wrong_pipes},
                                                  {"films", films},
                                                  {"film_outputs", film_outputs},
                                                  {"wrong_films", wrong_films}};
    return subjects;
}
