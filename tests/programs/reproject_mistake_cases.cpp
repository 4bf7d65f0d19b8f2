// SPDX-License-Identifier: MIT
//
// Command lines, inputs and outputs with which cubemap-reproject cannot do what it should.

#include "direction_image.hpp"
#include "image_cases.hpp"
#include "picture_checks.hpp"

#include "tools/compare/compare_main.h"
#include "tools/reproject/reproject_main.h"

#include <algorithm>
#include <filesystem>

#include <unistd.h>

namespace
{

// ---- what is wrong

struct Wrong
{
    const char *name;
    const char *words;
    const char *arguments; // of cubemap-reproject
};

constexpr Wrong wrong_usage[] = {
    {"no names", "INPUT and OUTPUT", ""},
    {"one name", "INPUT and OUTPUT", "noise.ppm"},
    {"three names", "INPUT and OUTPUT", "noise.ppm made/a.png made/b.png"},
    {"unknown option", "no option --sise; did you mean --size", "--sise 5 noise.ppm made/a.png"},
    {"missing value", "--size needs an argument", "noise.ppm made/a.png --size"},
    {"value too many", "--quiet takes no argument", "--quiet=1 noise.ppm made/a.png"},
    {"size of a face too large", "may be 65536 at most", "--size 65537 noise.ppm made/a.png"},
    {"odd width", "must be even", "--to equirect --size 7 noise.ppm made/a.png"},
    {"unknown projection", "not equirect, cube or cube:MAPPING",
     "--to sinusoidal noise.ppm made/a.png"},
    {"a mapping of one face as a cube", "say peirce", "--to cube:peirce noise.ppm made/a.png"},
    {"a mapping of the cube alone", "say cube:qsc", "--to qsc noise.ppm made/a.png"},
    {"no sphere", "joins disc and square", "--from square:radial noise.ppm made/a.png"},
    {"azimuthal of what", "after 'azimuthal:' comes", "--to azimuthal:x noise.ppm made/a.png"},
    {"field of view out of range", "it must be in",
     "--to azimuthal:gnomonic:fov=180 noise.ppm made/a.png"},
    {"layout of one face", "--layout is for a cube, but OUTPUT is octahedral",
     "--to octahedral --layout strip noise.ppm made/a.png"},
    {"layout of one face in", "--from-layout is for a cube, but --from says octahedral",
     "--from octahedral --from-layout strip noise.ppm made/a.png"},
    {"size of a chart too large", "square image may be 65536 at most",
     "--to peirce --size 65537 noise.ppm made/a.png"},
    {"unknown mapping", "nonesuch", "--to cube:nonesuch noise.ppm made/a.png"},
    {"parameter out of range", "4", "--to cube:tangent:c=5 noise.ppm made/a.png"},
    {"parameter not a number", "--to: ", "--to cube:tangent:c=x noise.ppm made/a.png"},
    {"unknown parameter", "--from: ", "--from cube:qsc:c=1 noise.ppm made/a.png"},
    {"empty mapping", "--to: ", "--to cube: noise.ppm made/a.png"},
    {"unknown layout", "faces, strip or cross", "--layout row noise.ppm made/a.png"},
    {"a column that is none", "columns from 0 to 3",
     "--layout cross:north=4,south=0 noise.ppm made/a.png"},
    {"columns of a strip", "faces, strip or cross",
     "--layout strip:north=1,south=0 noise.ppm made/a.png"},
    {"unknown frame", "geo, gl, fits, s2", "--frame east noise.ppm made/a.png"},
    {"unknown filter", "auto, nearest, bilinear", "--filter cubic noise.ppm made/a.png"},
    {"negative threads", "--threads", "--threads -1 noise.ppm made/a.png"},
    {"layout of no cube", "--layout is for a cube",
     "--to equirect --layout strip noise.ppm made/a.png"},
    {"layout of no cube in", "--from-layout is for a cube",
     "--from equirect --from-layout strip noise.ppm made/a.png"},
    {"six names for one picture", "%f", "--layout strip noise.ppm made/%f.png"},
    {"six names for one picture of another kind",
     "'made/%f.png' has %f for six faces, but OUTPUT is one picture, octahedral; leave %f out",
     "--to octahedral noise.ppm made/%f.png"},
    {"six names for a texture", "a texture holds them in one file; leave %f out",
     "noise.ppm made/a_%f.dds"},
    {"frame of no cube in",
     "--from-frame is for a cube, but INPUT is equirectangular; leave it out",
     "--from-frame gl noise.ppm made/a.png"},
    {"frame of no cube", "--frame is for a cube, but INPUT is equirectangular and OUTPUT peirce;",
     "--frame gl --to peirce noise.ppm made/a.png"},
    {"a border wider than half a face",
     "a border of 9 pixels around faces of 16: it may be half an edge, or 6; take 8 at most, or a",
     "--border 9 --size 16 noise.ppm made/a.png"},
    {"a border wider than half a level's",
     "faces of 8, those of level 1: .* 6 at most, or leave --mips",
     "--border 8 --mips --size 16 noise.ppm made/a.png"},
    {"no extension", "must end in", "noise.ppm made/a"},
    {"unknown extension", "must end in", "noise.ppm made/a.docx"},
    {"nearly a mapping", "did you mean tangent\\?", "--to cube:tangnt:c=1 noise.ppm made/a.png"},
    {"nearly a chart", "did you mean octahedral", "--to octahedrl noise.ppm made/a.png"},
    {"nearly a layout", "did you mean cross\\?", "--layout corss noise.ppm made/a.png"},
    {"nearly a frame", "did you mean geo\\?", "--frame goe noise.ppm made/a.png"},
    {"nearly a filter", "did you mean nearest\\?", "--filter neares noise.ppm made/a.png"},
    {"an extension that is no format", "must end in", "noise.ppm made/a.null"},
    {"output is input", "same file", "--from equirect --to equirect noise.ppm ./noise.ppm"},
};

constexpr Wrong wrong_images[] = {
    {"a chart that is not square", "64 x 32; an image in peirce must be square",
     "--from peirce noise.ppm made/a.png"},
    {"neither shape", "50 x 30.*neither", "odd.ppm made/a.png"},
    {"strip of the wrong shape", "must be 6N x N", "--from-layout strip noise.ppm made/a.png"},
    {"cross of the wrong shape", "must be 4N x 3N",
     "--from cube --from-layout cross noise.ppm made/a.png"},
    {"no cube", "a cube must be", "--from cube noise.ppm made/a.png"},
};

void all_fail(const Wrong *begin, const Wrong *end, int status)
{
    for (const Wrong *wrong = begin; wrong != end; ++wrong)
    {
        fails(wrong->name, status, wrong->words, std::string("reproject ") + wrong->arguments);
    }
}

void bad_arguments()
{
    make_noise(64, 32, "noise.ppm");
    make_noise(60, 30, "other.ppm");
    make_noise(50, 30, "odd.ppm");
    std::filesystem::copy_file("noise.ppm", "%f.ppm");
    all_fail(std::begin(wrong_usage), std::end(wrong_usage), 2);
    all_fail(std::begin(wrong_images), std::end(wrong_images), 1);
    for (const std::string size : {"0", "-1", "-999999999999", "1e3", "0x10", "", " 5", "5x",
                                   "99999999999999999999", "262145"})
    {
        fails("size '" + size + "'", 2, "--size is '.*', not a whole number from 1 to",
              Words{"reproject", "--size", size, "noise.ppm", "made/a.png"});
    }
    std::filesystem::copy_file("noise.ppm", "a.png");
    std::filesystem::create_symlink("a.png", "b.png");
    fails("output is input by a link", 2, "same file", "reproject --layout strip a.png b.png");
    fails("compare: one name", 2, "two images", "compare noise.ppm");
    fails("compare: bad limit", 2, "not a number of 0 or more",
          "compare --max-rmse nan noise.ppm noise.ppm");
    fails("compare: unknown option", 2, "no option --rmse", "compare --rmse 1 noise.ppm noise.ppm");
    fails("compare: sizes", 1, "must be alike", "compare noise.ppm other.ppm");
    fails("compare: no such file", 1, "No such file", "compare noise.ppm none.ppm");
}

// ---- bad input

void cut_files()
{
    make_noise(512, 256, "noise.ppm");
    const auto cut = [](const std::string &whole, std::size_t size, const std::string &name)
    { write_file(name, content_of(whole).substr(0, size)); };
    for (const std::string extension : {"png", "jpg", "tif", "exr", "hdr"})
    {
        const std::string whole = "whole." + extension;
        const std::string part = "part." + extension;
        does("reproject --quiet --filter bilinear --from equirect --to equirect noise.ppm " +
             whole);
        const std::size_t size = content_of(whole).size();
        for (const std::size_t kept : {std::size_t{10}, size / 3, size - 40})
        {
            cut(whole, kept, part);
            const std::string after = " that ends after " + std::to_string(kept);
            fails(extension + " of " + std::to_string(size) + " bytes" + after, 1,
                  "'part." + extension + "'", "reproject " + part + " made/a.png");
            fails("compare: " + extension + after, 1, "'part." + extension + "'",
                  "compare " + part + " " + whole);
        }
    }
    cut("whole.png", content_of("whole.png").size() - 3, "part.png");
    fails("png without its last bytes", 1, "'part.png'", "reproject part.png made/a.png");
    fails("png without its last bytes that GDAL would read", 1,
          "'part.png' is damaged.*without its end$",
          "reproject --from equirect part.png made/a.png");
    does("reproject --quiet --filter nearest --to cube:qsc --layout strip --size 32 noise.ppm "
         "whole.tif");
    cut("whole.tif", content_of("whole.tif").find("cubemap:surface") + 4, "part.tif");
    fails("tif with all pixels, but without what says that they are qsc", 1,
          "'part.tif' is damaged or ends too early: what it says of itself is not whole$",
          "reproject part.tif made/a.png");
    cut("whole.jpg", content_of("whole.jpg").size() - 2, "part.jpg");
    fails("jpg without its last bytes", 1, "'part.jpg'", "reproject part.jpg made/a.png");
    cut("whole.jpg", content_of("whole.jpg").find("\xff\xda") + 13, "part.jpg");
    fails("jpg within the head of its pixels, which GDAL would make up", 1,
          "'part.jpg' is damaged or ends too early",
          "reproject --from equirect part.jpg made/a.png");
    cut("noise.ppm", 1000, "part.ppm");
    fails("ppm that ends early", 1, "'part.ppm'", "reproject part.ppm made/a.png");
}

// The head of a PNG file of 900000 x 450000 pixels, with nothing behind it.
void write_huge_png(const std::string &name)
{
    static const unsigned char bytes[] = {
        0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49,
        0x48, 0x44, 0x52, 0x00, 0x0d, 0xbb, 0xa0, 0x00, 0x06, 0xdd, 0xd0, 0x10, 0x06,
        0x00, 0x00, 0x00, 0x3e, 0x03, 0x25, 0x84, 0x00, 0x00, 0x00, 0x08, 0x49, 0x44,
        0x41, 0x54, 0x78, 0x9c, 0x03, 0x00, 0x00, 0x00, 0x00, 0x01, 0x48, 0x06, 0x89,
        0xd2, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
    write_file(name, std::string(reinterpret_cast<const char *>(bytes), sizeof bytes));
}

void values_that_are_none()
{
    for (const std::string type : {"half", "float"})
    {
        make_constant(8, 4, 3, type, std::stof("nan"), "nan.exr");
        fails("NaN, " + type, 1, "'nan.exr' has a NaN at x = 0, y = 0, channel R",
              "reproject --not-finite refuse nan.exr made/a.png");
        make_constant(8, 4, 3, type, std::stof("inf"), "inf.exr");
        fails("infinity, " + type, 1, "has an infinite value",
              "reproject --not-finite refuse inf.exr made/a.exr");
    }
    passes("infinity, nearest",
           "reproject --quiet --filter bilinear --filter nearest inf.exr out.exr");
}

void bad_faces()
{
    for (int face = 0; face < 6; ++face)
    {
        make_noise(16, 16, "face_" + std::to_string(face) + ".ppm");
    }
    make_noise(16, 8, "face_3.ppm");
    fails("a face that is not square", 1, "'face_3.ppm' is 16 x 8.*square",
          "reproject face_%f.ppm made/a.png");
    make_noise(8, 8, "face_3.ppm");
    fails("a face of another size", 1, "'face_3.ppm' is 8 x 8.*alike",
          "reproject face_%f.ppm made/a.png");
}

void bad_input()
{
    fails("no such file", 1, "No such file", "reproject none.png made/a.png");
    std::filesystem::create_directory("folder.png");
    fails("a folder", 1, "is a folder", "reproject folder.png made/a.png");
    write_file("empty.png", "");
    fails("an empty file", 1, "is empty", "reproject empty.png made/a.png");
    write_file("text.png", "this is not an image\n");
    fails("not an image", 1, "'text.png' is not an image", "reproject text.png made/a.png");
    make_noise(50, 30, "noise.ppm");
    write_file("random.jpg", content_of("noise.ppm").substr(20)); // behind the head
    fails("random bytes", 1, "'random.jpg' is not an image", "reproject random.jpg made/a.png");
    write_file("zero.ppm", "P6 0 0 255\n");
    fails("zero size", 1, "'zero.ppm' (is not an image|has no pixels)",
          "reproject zero.ppm made/a.png");
    fails("no such face", 1, "'none_0.png'.*No such file", "reproject none_%f.png made/a.png");
    cut_files();
    values_that_are_none();
    bad_faces();
    make_constant(8, 4, 5, "float", 0.5f, "five.tif");
    fails("five channels to PNG", 1, "PNG holds", "reproject five.tif made/a.png");
    fails("five channels to JPEG", 1, "JPEG holds", "reproject five.tif made/a.jpg");
    fails("five channels to HDR", 1, "HDR holds", "reproject five.tif made/a.hdr");
    write_huge_png("huge.png");
    fails("an image larger than the memory", 1, "'huge.png'", "reproject huge.png made/a.png");
}

// ---- bad output

void limits_on_size()
{
    for (const std::string extension : {"png", "jpg", "tif", "exr", "hdr"})
    {
        {
            const SizeLimit limit(8 * 1024);
            fails("limit on the size of files, " + extension, 1, "File too large",
                  "reproject --layout strip noise.ppm made/a." + extension);
        }
        const SizeLimit limit(4 * 1024);
        fails("limit on the size of files, six of " + extension, 1, "File too large",
              "reproject noise.ppm made/%f." + extension);
    }
    std::filesystem::create_directory("kept");
    write_file("kept/a.png", "old\n");
    {
        const SizeLimit limit(8 * 1024);
        run("reproject --layout strip noise.ppm kept/a.png");
    }
    result(content_of("kept/a.png") == "old\n" && names_in("kept") == "a.png ",
           "an older file is kept when the new one fails", names_in("kept"));
}

void bad_output()
{
    make_noise(512, 256, "noise.ppm");
    fails("no such folder", 1, "'nowhere.*No such file", "reproject noise.ppm nowhere/a.png");
    fails("a folder that is a file", 1, "Not a directory", "reproject noise.ppm noise.ppm/a.png");
    std::filesystem::create_directory("folder.png");
    fails("output is a folder", 1, "is a folder", "reproject --layout strip noise.ppm folder.png");
    std::filesystem::create_directory("folder");
    fails("output is a folder, without extension", 2,
          "'folder' is a folder; give the name of a file", "reproject noise.ppm folder");
    std::filesystem::create_symlink("/dev/full", "full.png");
    fails("output is a device", 1, "not a file", "reproject --layout strip noise.ppm full.png");
    if (geteuid() != 0)
    {
        std::filesystem::create_directory("locked");
        std::filesystem::permissions("locked", std::filesystem::perms::owner_read |
                                                   std::filesystem::perms::owner_exec);
        fails("a folder without the right to write", 1, "Permission denied",
              "reproject noise.ppm locked/a.png");
        std::filesystem::permissions("locked", std::filesystem::perms::owner_all);
    }
    limits_on_size();
    // The last of six names is taken by a folder: none may appear.
    std::filesystem::create_directories("six/face_5.png");
    const Ran ran = run("reproject --quiet --filter bilinear noise.ppm six/face_%f.png");
    result(ran.status == 1 && names_in("six") == "face_5.png ", "six files or none",
           ran.err + names_in("six"));
}

// ---- man pages

// Each option of the program is in one of the examples of its man page.
void examples(const cm_command &command, const std::string &page)
{
    std::string text = content_of(source_tree() + "/tools/" + page);
    const std::size_t begin = text.find(".SH EXAMPLE");
    text = begin == std::string::npos ? "" : text.substr(begin, text.find(".SH SEE") - begin);
    text.erase(std::remove(text.begin(), text.end(), '\\'), text.end());
    std::string missing;
    for (std::size_t i = 0; i < command.group_count; ++i)
    {
        for (std::size_t k = 0; k < command.groups[i].count; ++k)
        {
            const std::string name = std::string("--") + command.groups[i].options[k].name;
            missing += text.find(name + " ") == std::string::npos ? " " + name : "";
        }
    }
    result(!text.empty() && missing.empty(), "every option is in an example of " + page, missing);
}

void examples_of_options()
{
    examples(cm_reproject_command, "reproject/cubemap-reproject.1.in");
    examples(cm_compare_command, "compare/cubemap-compare.1.in");
}

} // namespace

const std::vector<Subject> &reproject_mistake_subjects()
{
    static const std::vector<Subject> subjects = {{"reproject_arguments", bad_arguments},
                                                  {"bad_input", bad_input},
                                                  {"reproject_output", bad_output},
                                                  {"examples_of_options", examples_of_options}};
    return subjects;
}
