// SPDX-License-Identifier: MIT
//
// What cubemap-compare measures beside mean, RMSE and maximum, which reproject_cases.cpp rests on.

#include "direction_image.hpp"
#include "image_cases.hpp"
#include "picture.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>

namespace
{

// The number behind a name in JSON, or in a line of words.
double number_behind(const std::string &text, const std::string &name)
{
    const std::size_t at = text.find(name);
    return at == std::string::npos ? std::numeric_limits<double>::quiet_NaN()
                                   : std::atof(text.c_str() + at + name.size());
}

void near(const std::string &name, double value, double wanted, double tolerance)
{
    result(std::fabs(value - wanted) <= tolerance, name,
           std::to_string(value) + ", not " + std::to_string(wanted));
}

const std::string every = "mean,rmse,max,bias,mse,psnr,ws-psnr,s-psnr,ssim,flip";

void constants()
{
    make_constant(8, 4, 3, "uint8", 0.2f, "a.png");
    make_constant(8, 4, 3, "uint8", 0.4f, "b.png");
    const std::string words = passes("all measures", "compare -m " + every + " a.png b.png").out;
    const std::string json =
        passes("all measures as JSON", "compare --json -m " + every + " a.png b.png").out;
    near("bias", number_behind(words, "mean error  "), 51, 1e-3);
    near("bias in JSON", number_behind(json, "\"bias\": "), 51, 1e-5);
    near("mean square", number_behind(words, "mean square error  "), 51 * 51, 1e-1);
    const double psnr = -20 * std::log10(0.2);
    for (const char *name : {"\"psnr\": ", "\"ws-psnr\": ", "\"s-psnr\": "})
    {
        near(std::string(name) + "of a constant error", number_behind(json, name), psnr, 1e-5);
    }
    near("WS-PSNR in words", number_behind(words, "WS-PSNR"), psnr, 1e-2);
    // (2 p q + c1) / (p^2 + q^2 + c1)
    near("SSIM of constants", number_behind(json, "\"ssim\": {\"mean\": "), 0.1601 / 0.2001, 1e-6);
    result(matches(words, "^FLIP  *0\\.[0-9]*, the most 0\\.") &&
               matches(words, "^maximum  *51 grey levels of 8 bits at x = 0, y = 0, channel R$"),
           "lines of words", words);
    result(std::count(words.begin(), words.end(), '\n') == 10 &&
               std::count(json.begin(), json.end(), '\n') == 1,
           "a line a measure", words + json);
    const std::string same = does("compare --json -m psnr,ssim,flip a.png a.png").out;
    result(matches(same, "\"psnr\": null") && matches(same, "\"ssim\": [{]\"mean\": 1,") &&
               matches(same, "\"flip\": [{]\"mean\": 0,"),
           "JSON of the same", same);
    near("peak", number_behind(does("compare -m psnr --peak 102 a.png b.png").out, "PSNR"),
         20 * std::log10(2), 1e-3);
    near("peak of the reference",
         number_behind(does("compare -m psnr --peak reference a.png b.png").out, "PSNR"), 0, 1e-3);
    result(does("compare a.png b.png").out ==
               does("compare -m psnr,max,rmse,mean a.png b.png --threads 2").out,
           "the standard measures");
    result(does("compare --quiet -m " + every + " a.png b.png").out.empty(), "quiet");
}

// Errors in one row of an equirectangular image: by area they weigh as much as the row does.
void areas()
{
    std::string content = "P5 8 4 255\n" + std::string(32, '\0');
    write_file("black.pgm", content);
    for (std::size_t i = content.size() - 32; i < content.size() - 24; ++i)
    {
        content[i] = static_cast<char>(255);
    }
    write_file("cap.pgm", content);
    const double share = (1 - std::cos(std::acos(-1.0) / 4)) / 2;
    const double psnr = -10 * std::log10(share);
    const std::string json = does("compare --json -m psnr,ws-psnr,s-psnr black.pgm cap.pgm").out;
    near("PSNR of a quarter", number_behind(json, "\"psnr\": "), -10 * std::log10(0.25), 1e-9);
    near("WS-PSNR of a cap", number_behind(json, "\"ws-psnr\": "), psnr, 1e-5);
    near("S-PSNR of a cap", number_behind(json, "\"s-psnr\": "), psnr, 1e-3);
    near(
        "PSNR by area",
        number_behind(does("compare --json -m psnr --by-area black.pgm cap.pgm").out, "\"psnr\": "),
        psnr, 1e-5);
    near("a border that has the error",
         number_behind(does("compare --json -m rmse --border 1 black.pgm cap.pgm").out,
                       "\"rmse\": "),
         0, 0);
    make_constant(3, 3, 1, "uint8", 0, "square.png");
    for (const std::string wrong : {"-m ws-psnr", "-m s-psnr", "--by-area"})
    {
        fails("square: " + wrong, 1, "for equirectangular images, twice as wide as high",
              "compare " + wrong + " square.png square.png");
    }
}

// One picture of the sphere is another one of it.
void surfaces()
{
    make_direction_image(equirect_shape, 64, "world.tif");
    does("reproject --filter bspline5 --to cube:coupled --layout cross --size 32 world.tif "
         "cross.tif");
    does("reproject --filter bspline5 --to azimuthal:equidistant:fov=200 --size 40 world.tif "
         "disc.tif");
    const std::string forth = does("compare --json -m max,ws-psnr,s-psnr "
                                   "--surface 'cube:coupled;layout=cross' world.tif cross.tif")
                                  .out;
    near("a cross beside the world", number_behind(forth, "\"max\": {\"value\": "), 0, 0.02);
    result(number_behind(forth, "\"ws-psnr\": ") > 50 && number_behind(forth, "\"s-psnr\": ") > 50,
           "a cross beside the world, by area", forth);
    const std::string back =
        does("compare --json -m max --reference-surface 'cube:coupled;layout=cross' "
             "cross.tif world.tif")
            .out;
    near("the world beside a cross", number_behind(back, "\"max\": {\"value\": "), 0, 0.02);
    near("what a disc shows",
         number_behind(does("compare --json -m max --surface azimuthal:equidistant:fov=200 "
                            "world.tif disc.tif")
                           .out,
                       "\"max\": {\"value\": "),
         0, 0.1);
    make_constant(128, 96, 3, "float", 0.5f, "untold.tif");
    fails("no surface", 1, "--surface and --reference-surface say", "compare world.tif untold.tif");
    fails("a surface of six files", 2, "say a layout of one",
          "compare --surface 'cube;layout=faces' world.tif disc.tif");
    fails("a surface of another shape", 2, "64 x 32 is not 4N x 3N",
          "compare --surface 'cube;layout=cross' world.tif world.tif");
    fails("no such surface", 2, "nonesuch", "compare --surface nonesuch world.tif world.tif");
    fails("which map?", 2, "--surface is missing",
          "compare --reference-surface equirect world.tif untold.tif");
}

// What is beside the map of one image is in windows of its edges, and says nothing.
void beside_the_map()
{
    make_constant(128, 96, 3, "uint8", 0.5f, "full.png");
    make_constant(64, 32, 3, "uint8", 0.5f, "gray.png");
    const std::string cross = does("compare --json -m ssim,flip --surface equirect "
                                   "--reference-surface 'cube;layout=cross' full.png gray.png")
                                  .out;
    near("SSIM beside a cross", number_behind(cross, "\"ssim\": {\"mean\": "), 1, 1e-6);
    near("FLIP beside a cross", number_behind(cross, "\"flip\": {\"mean\": "), 0, 1e-4);
    make_constant(64, 64, 3, "uint8", 0.5f, "lens.png");
    const std::string disc = does("compare --json -m ssim --reference-surface equirect --surface "
                                  "azimuthal:equidistant:fov=180 gray.png lens.png")
                                 .out;
    near("SSIM beside a disc", number_behind(disc, "\"ssim\": {\"mean\": "), 1, 1e-6);
}

// Numbers of sRGB beside light are compared, and said; light beside light is not.
void curves()
{
    make_constant(8, 4, 3, "uint8", 0.5f, "curve.png");
    make_constant(8, 4, 3, "float", 0.5f, "light.exr");
    for (const std::string names : {"curve.png light.exr", "light.exr curve.png"})
    {
        const std::string line = run("compare " + names).err;
        result(matches(line, "'light.exr' holds light, 'curve.png' numbers with sRGB's curve"),
               "another curve: " + names, line);
    }
    passes("the same curve", "compare light.exr light.exr");
    passes("no curve at all", "compare curve.png curve.png");
}

// Of what files say of themselves, and of six faces.
void told_surfaces()
{
    const auto largest = [](const std::string &names)
    {
        return number_behind(does("compare --json -m max,ws-psnr " + names).out,
                             "\"max\": {\"value\": ");
    };
    make_direction_image(equirect_shape, 64, "world.tif");
    const std::string qsc =
        "reproject --quiet --filter bspline5 --size 32 --to cube:qsc --frame gl "
        "--rotate 10,20,30 world.tif ";
    does(qsc + "cross.exr --layout cross");
    does(qsc + "face_%f.exr");
    does(qsc + "strip.exr --layout strip");
    does(qsc + "border_%f.exr --border 2");
    near("a tag says what B is", largest("world.tif cross.exr"), 0, 0.02);
    near("or what A is", largest("cross.exr world.tif"), 0, 0.02);
    const auto contradicted = [](const std::string &name, const std::string &words,
                                 const std::string &names, double least)
    {
        const Ran ran = run("compare --json -m max " + names);
        result(ran.status == 0 && matches(ran.err, words) &&
                   number_behind(ran.out, "\"max\": {\"value\": ") > least,
               name, ran.err + ran.out);
    };
    contradicted("a tag counts less than an option, which is told",
                 "'cross.exr' says that it is cube:qsc;.*; it is taken as cube:coupled;",
                 "--surface 'cube:coupled;frame=gl;layout=cross' world.tif cross.exr", 0.5);
    contradicted("and of A, too", "'cross.exr' says that it is cube:qsc;.* as cube:gnomonic;",
                 "--reference-surface 'cube:gnomonic;frame=gl;layout=cross' cross.exr world.tif",
                 0.5);
    near("six faces", largest("world.tif face_%f.exr"), 0, 0.02);
    near("six faces with borders", largest("border_%f.exr world.tif"), 0, 0.02);
    near("six faces are a strip", largest("face_%f.exr strip.exr"), 0, 0);
    near("of twice the same cube nothing is resampled", largest("face_%f.exr face_%f.exr"), 0, 0);
    contradicted("six faces, and an option, which does not say how they are turned",
                 "'face_0.exr' says that it is turned by 10,20,30; .* by 0,0,0",
                 "--surface cube:qsc;frame=gl world.tif face_%f.exr", 0.1);
    does("reproject --quiet --filter bspline5 --size 32 world.tif other_%f.exr");
    near("six faces of another cube", largest("other_%f.exr face_%f.exr"), 0, 0.02);
    does("reproject --quiet --filter bspline5 --size 32 world.tif other.exr --layout strip");
    const Ran ran = run("compare -m max other.exr strip.exr");
    result(ran.status == 0 &&
               matches(ran.err, "^cubemap-compare: 'other.exr' says that it is cube:coupled;.*, "
                                "'strip.exr' cube:qsc;.*; their pixels are "
                                "compared as they stand, unless --surface says what B is\n$"),
           "pixels are compared as ever where sizes are the same, but not without a word",
           ran.err + ran.out);
}

// Faces of a texture are turned as its format has them, whatever the mapping.
void faces_of_textures()
{
    does("reproject --quiet --filter bspline5 --to cube:gnomonic --size 64 " + source_tree() +
         "/tests/programs/golden/earth-64.png sky.dds");
    does("reproject --quiet --filter bspline5 --to equirect --size 64 sky.dds sky.png");
    const auto noise = [](const std::string &options)
    {
        return number_behind(does("compare --json -m psnr " + options + " sky.png sky.dds").out,
                             "\"psnr\": ");
    };
    const double untold = noise("");
    result(untold > 25, "six faces of a texture", std::to_string(untold));
    near("and what an option says is the same", noise("--surface cube:gnomonic"), untold, 1e-9);
    fails("no such faces", 2, "--surface: 'equirect', but 'sky.dds' is 64 x 64 with 4 channels: ",
          "compare --surface equirect sky.png sky.dds");
}

void untold_faces()
{
    make_direction_image(equirect_shape, 64, "world.tif");
    make_constant(16, 16, 3, "uint8", 0.5f, "bare_0.png");
    for (int face = 1; face < 6; ++face)
    {
        std::filesystem::copy_file("bare_0.png", "bare_" + std::to_string(face) + ".png");
    }
    near("faces of which nobody says anything",
         number_behind(does("compare --json -m max bare_%f.png "
                            "bare_%f.png")
                           .out,
                       "\"max\": {\"value\": "),
         0, 0);
    fails("of which cube?", 2, "--surface is missing",
          "compare world.tif bare_%f.png "
          "--reference-surface equirect");
    std::filesystem::remove("bare_4.png");
    fails("a face is missing", 1, "'bare_4.png' cannot be read: .*all six faces are needed",
          "compare bare_%f.png bare_%f.png");
}

void high_dynamic_range()
{
    make_constant(6, 6, 3, "float", 8, "bright.exr");
    make_constant(6, 6, 3, "float", 4, "half.exr");
    const std::string words = passes("HDR-FLIP", "compare -m hdr-flip bright.exr half.exr").out;
    result(matches(words, "^HDR-FLIP  *0\\.[0-9]*, the most 0\\.[0-9]* at x = 0, y = 0$") &&
               matches(words, "^exposures  *2, from 2\\^-"),
           "HDR-FLIP in words", words);
    const std::string json = does("compare --json -m flip,hdr-flip bright.exr half.exr").out;
    result(number_behind(json, "\"flip\": {\"mean\": ") == 0 &&
               number_behind(json, "\"hdr-flip\": {\"mean\": ") > 0.05 &&
               number_behind(json, "\"exposures\": ") == 2,
           "above 1 there is no FLIP of low dynamic range", json);
    make_constant(6, 6, 3, "uint8", 1, "white.png");
    fails("HDR-FLIP of integers", 1, "holds integers", "compare -m hdr-flip white.png white.png");
    make_constant(6, 6, 3, "float", std::stof("nan"), "nan.exr");
    for (const std::string measure : {"ssim", "flip", "hdr-flip"})
    {
        fails(measure + " of NaN", 1, "--skip-not-finite leaves them out",
              "compare -m " + measure + " bright.exr nan.exr");
        const std::string skipped =
            does("compare --skip-not-finite -m mean," + measure + " bright.exr nan.exr").out;
        result(matches(skipped, "^mean absolute error  *nan") &&
                   matches(skipped, "^left out  *36 pixels"),
               measure + " of nothing", skipped);
    }
}

void pictures()
{
    make_noise(64, 32, "noise.ppm");
    make_turned("noise.ppm", 64, 32, "turned.ppm");
    for (const std::string what : {"error", "ssim", "flip"})
    {
        const std::string line = "compare --quiet --difference-of " + what + " --difference ";
        passes("difference of " + what, line + "one.png noise.ppm turned.ppm --threads 1");
        passes("difference of " + what + ", again", line + "two.png noise.ppm turned.ppm");
        result(same_content("one.png", "two.png"), "threads change no bit of " + what);
        const Picture drawn("one.png");
        result(drawn.width == 64 && drawn.height == 32 && drawn.channels == 3,
               "size of the picture of " + what);
    }
    make_constant(4, 2, 3, "uint8", 0.2f, "a.png");
    make_constant(4, 2, 3, "uint8", 0.4f, "b.png");
    const std::string line = "compare --quiet --colors uniform-blue a.png b.png --difference ";
    does(line + "low.tif --range 60:80");
    does(line + "high.tif --range 0:51");
    does(line + "most.tif");
    does(line + "edge.tif --border 1");
    const Picture low("low.tif");
    const Picture high("high.tif");
    const Picture edge("edge.tif");
    result(!std::equal(low.at(0, 0), low.at(0, 0) + 3, high.at(0, 0)), "ends of the range");
    holds("the largest error has the last colour",
          [&]
          {
              if (Picture("most.tif").values != high.values)
              {
                  throw std::runtime_error("another colour");
              }
          });
    result(std::fabs(edge.first(1, 0) - 0.5) < 0.01, "the border is grey");
    fails("a limit, with a picture", 1, "above the limit",
          "compare --quiet --max 1 --difference seen.png a.png b.png");
    result(std::filesystem::exists("seen.png"), "the picture of what is above the limit");
}

// 8 bits and 16 bits tell the same, and differences of whole numbers are whole.
void whole_numbers()
{
    std::string bytes, words, more;
    for (int value = 0; value < 512; ++value)
    {
        bytes += static_cast<char>(value);
        words += std::string(2, static_cast<char>(value)); // by 257, big-endian
        more += static_cast<char>(value % 256 < 236 ? value + 20 : value);
    }
    write_file("bytes.pgm", "P5 32 16 255\n" + bytes);
    write_file("words.pgm", "P5 32 16 65535\n" + words);
    write_file("more.pgm", "P5 32 16 255\n" + more);
    does("reproject --quiet --from equirect --to equirect --filter nearest words.pgm words.png");
    passes("the same in 16 bits", "compare --max 0 --max-mean 0 bytes.pgm words.pgm");
    passes("and as PNG", "compare --max 0 --max-mean 0 bytes.pgm words.png");
    const std::string json =
        passes("20 levels apart", "compare --json --max 20 -m max bytes.pgm more.pgm").out;
    result(matches(json, "\"max\": [{]\"value\": 20, "), "20 levels are 20", json);
}

void wrong_comparisons()
{
    make_constant(4, 2, 3, "uint8", 0.2f, "a.png");
    const Words lines[] = {
        {"unknown measure", "'flop' is no measure; did you mean flip", "-m flop"},
        {"no measure", "'' is no measure", "-m psnr,"},
        {"peak of 0", "a number from 1e-90 to 1e90 or 'reference'", "--peak 0"},
        {"peak that is no number", "a number from 1e-90 to 1e90 or 'reference'", "--peak high"},
        {"range", "two numbers with LOW below HIGH", "--range 1:1"},
        {"half a range", "two numbers with LOW below HIGH", "--range 1"},
        {"range without end", "--range is too wide",
         "--range -1e308:1e308 --difference made/x.png"},
        {"colours", "no colour map is called 'viridis'", "--colors viridis"},
        {"density", "a number from 0.01 to 1000", "--pixels-per-degree 0"},
        {"border", "a whole number from 0 to 65536", "--border 1.5"},
        {"difference of what", "not one of error", "--difference-of psnr"},
        {"format", "must end in .png, .jpg or .tif", "--difference made/x.exr"},
        {"no format", "must end in", "--difference made/x"},
        {"overwriting", "is an image that is compared", "--difference ./a.png"}};
    for (const Words &line : lines)
    {
        fails(line[0], 2, line[1], "compare " + line[2] + " a.png a.png");
    }
    fails("no such folder", 1, "nowhere", "compare --difference nowhere/x.png a.png a.png");
}

} // namespace

const std::vector<Subject> &compare_subjects()
{
    static const std::vector<Subject> subjects = {
        {"compare_constants", constants},     {"compare_areas", areas},
        {"compare_surfaces", surfaces},       {"compare_range", high_dynamic_range},
        {"compare_told", told_surfaces},      {"compare_textures", faces_of_textures},
        {"compare_untold", untold_faces},     {"compare_pictures", pictures},
        {"compare_wrong", wrong_comparisons}, {"compare_whole", whole_numbers},
        {"compare_beside", beside_the_map},   {"compare_curves", curves}};
    return subjects;
}
