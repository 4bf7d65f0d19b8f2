// SPDX-License-Identifier: MIT
//
// What cubemap-reproject and cubemap-compare make of images on cubes, and what they say.

#include "direction_image.hpp"
#include "image_cases.hpp"
#include "picture_checks.hpp"

#include <algorithm>
#include <array>
#include <filesystem>

namespace
{

// ---- geometry

bool is_one_of(const std::string &name, const Words &names)
{
    return std::find(names.begin(), names.end(), name) != names.end();
}

// An image that holds its own directions must hold them after each conversion, up to the error of
// bilinear interpolation: h^2/4 for a grid of h radians, 1e-5 here. From a cube it is larger near
// the edges, where the grids of two faces meet at an angle: a fifth of a pixel at the corners.
void there_and_back(const std::string &mapping, const std::string &frame, const std::string &layout)
{
    // torn along edges, where the pixels of the neighbour are not those next to a face's own
    const double largest = mapping == "arvo" ? 1.5e-2 : 1.5e-3;
    const std::string name = layout == "faces" ? "cube_%f.tif" : "cube.tif";
    const std::string text = "cube:" + mapping + ", " + frame + ", " + layout;
    const Shape shape = {mapping, frame, layout};
    does("reproject --quiet --filter bilinear --to cube:" + mapping + " --frame " + frame +
         " --layout " + layout + " equirect.tif " + name);
    holds("equirect to " + text, [&] { check_direction_image(shape, name, 2e-5, 5e-6); });
    make_direction_image(shape, 256, name);
    does("reproject --quiet --filter bilinear --from cube:" + mapping + " --frame " + frame +
         " --from-layout " + layout + " " + name + " back.tif");
    holds(text + " to equirect",
          [&] { check_direction_image(equirect_shape, "back.tif", largest, 2e-5); });
}

// One in three, and those that are like no other: torn, singular, of twelve squares.
void several_mappings()
{
    make_direction_image(equirect_shape, 1024, "equirect.tif");
    const Words mappings = catalogue_names(false);
    const std::array<const char *, 3> frames = {"geo", "gl", "fits"};
    std::size_t turn = 0;
    for (std::size_t i = 0; i < mappings.size(); ++i)
    {
        const bool own = is_one_of(mappings[i], {"arvo", "conformal", "healpix", "coupled"});
        if (i % static_cast<std::size_t>(one_in(8)) == 0 && (i % 3 == 0 || own))
        {
            there_and_back(mappings[i], frames[turn % 3], turn % 2 == 0 ? "cross" : "strip");
            ++turn;
        }
    }
}

void every_frame()
{
    make_direction_image(equirect_shape, 1024, "equirect.tif");
    int turn = 0;
    for (const char *frame : {"geo", "gl", "fits"})
    {
        for (const char *layout : {"faces", "strip", "cross"})
        {
            if (turn++ % one_in(5) == 0)
            {
                there_and_back("coupled", frame, layout);
            }
        }
    }
    for (const char *layout : {"faces", "strip"})
    {
        if (turn++ % one_in(2) == 0)
        {
            there_and_back("coupled", "s2", layout);
        }
    }
    does("reproject --quiet --filter bilinear --to cube:coupled --frame s2 --layout cross "
         "equirect.tif cross.tif");
    does("reproject --quiet --filter bilinear cross.tif back.tif");
    holds("s2 as a cross, its faces turned",
          [] { check_direction_image(equirect_shape, "back.tif", 1.5e-3, 2e-5); });
}

void odd_sizes()
{
    make_direction_image(equirect_shape, 1024, "equirect.tif");
    for (const int size : {1, 2, 3, 17})
    {
        does("reproject --quiet --filter bilinear --size " + std::to_string(size) +
             " --layout strip equirect.tif cube.tif");
        holds("face of " + std::to_string(size) + " pixels",
              [] {
                  check_direction_image({"coupled", "geo", "strip"}, "cube.tif", 2e-5, 1e-5);
              });
    }
    does("reproject --quiet --filter bilinear --to equirect --size 2 equirect.tif two.tif");
    holds("equirectangular image of 2 pixels",
          [] { check_direction_image(equirect_shape, "two.tif", 2e-5, 2e-5); });
    // An odd width, where the far side of a pole lies between two pixels.
    make_constant(5, 3, 1, "float", 0.7f, "odd.tif");
    make_constant(8, 4, 1, "float", 0.7f, "even.tif");
    does("reproject --quiet --filter bilinear --from equirect --to equirect --size 8 odd.tif "
         "out.tif");
    passes("odd width, any aspect", "compare --max 0 out.tif even.tif");
}

// rHEALPix: cube:healpix with its polar squares elsewhere, turned.
void turned_squares()
{
    does("reproject --quiet --filter bilinear --to cube:healpix --layout cross equirect.tif "
         "first.tif");
    does("reproject --quiet --filter bilinear --from cube:healpix first.tif straight.tif");
    int turn = 0;
    for (const std::string columns :
         {"north=0,south=3", "north=2,south=0", "north=3,south=2", "north=1,south=1"})
    {
        for (const std::string frame : {"geo", "gl"})
        {
            if (turn++ % one_in(3) != 0)
            {
                continue;
            }
            does("reproject --quiet --filter bilinear --to cube:healpix --frame " + frame +
                 " --layout cross:" + columns + " equirect.tif turned.tif");
            does("reproject --quiet --filter bilinear --from cube:healpix --frame " + frame +
                 " --from-layout cross:" + columns + " turned.tif back.tif");
            passes("rHEALPix in " + frame + ", " + columns,
                   // two steps of float: positions come from other neighbours
                   "compare --max 3e-7 straight.tif back.tif");
        }
    }
    make_constant(8, 4, 1, "float", 0.5f, "grey.tif");
    does("reproject --quiet --filter bilinear --to cube:healpix --layout cross:north=3,south=0 "
         "--size 8 grey.tif "
         "cross.tif");
    const std::string description = describe_image("cross.tif");
    result(matches(description, "^32 x 24, 1 channels"), "size of a cross with turned faces",
           description);
}

void cube_to_cube()
{
    make_direction_image(equirect_shape, 1024 / one_in(2), "equirect.tif");
    turned_squares();
    make_direction_image(equirect_shape, 1024, "equirect.tif");
    does("reproject --quiet --filter bilinear --to cube:qsc --frame gl --layout cross equirect.tif "
         "first.tif");
    does("reproject --quiet --filter bilinear --from cube:qsc --to cube:tangent:c=1.1823 "
         "--from-frame gl --frame fits "
         "--layout strip first.tif second.tif");
    holds("cube to cube in another mapping, frame and layout",
          [] {
              check_direction_image({"tangent:c=1.1823", "fits", "strip"}, "second.tif", 1.5e-3,
                                    5e-5);
          });
    for (const std::string frame : {"gl", "fits", "s2"})
    {
        const std::string nearest =
            "reproject --quiet --filter bilinear --filter nearest --from cube:qsc --to cube:qsc ";
        does(nearest + "--from-frame gl --frame " + frame + " --layout strip first.tif there.tif");
        does(nearest + "--from-frame " + frame + " --frame gl --layout cross there.tif again.tif");
        passes("gl to " + frame + " and back loses nothing", "compare --max 0 first.tif again.tif");
    }
}

// ---- what it says

void talk()
{
    make_noise(64, 32, "noise.ppm");
    std::string said = does("reproject --filter bilinear noise.ppm face_%f.png").out;
    result(said == "noise.ppm (equirect 64x32, 3 channels, uint8) -> "
                   "face_0.png .. face_5.png (cube:coupled, frame geo, 16x16; bilinear)\n",
           "says what it did", said);
    said = does("reproject --quiet --filter bilinear noise.ppm face.png").out;
    result(said.empty() && std::filesystem::exists("face_3.png"),
           "quiet; a name without %f gets _0 to _5", said);
    said = does("reproject --to peirce noise.ppm peirce.png").out;
    said += does("reproject --from peirce peirce.png back.png").out;
    result(matches(said, "-> peirce\\.png \\(peirce 36x36; [a-z0-9-]*\\)$") &&
               matches(said, "^peirce\\.png \\(peirce 36x36, 3 channels, uint8\\) -> "
                             "back\\.png \\(equirect 64x32; [a-z0-9-]*\\)$"),
           "resolution of a square stays in the mean", said);
    said = does("reproject --to azimuthal:lambert noise.ppm disc.png").out;
    result(matches(said, "-> disc\\.png \\(azimuthal:lambert 29x29; [a-z0-9-]*\\)$"),
           "resolution of a disc stays in the mean", said);
    said = does("reproject --help").out + does("compare --help").out;
    result(matches(said, "^Usage: cubemap-reproject") && matches(said, "^Usage: cubemap-compare"),
           "help", said);
    said = does("reproject --version").out + does("compare --version").out;
    result(matches(said, "^cubemap-reproject [0-9]+\\.[0-9]+\\.[0-9]+$") &&
               matches(said, "^cubemap-compare [0-9]"),
           "version", said);
    std::filesystem::copy_file("noise.ppm", "-dash.ppm");
    passes("names that begin with a dash",
           "reproject --quiet --filter bilinear -- -dash.ppm -dash.png");
    std::filesystem::create_directory("a folder");
    passes("blanks in names",
           "reproject --quiet --filter bilinear --layout=cross noise.ppm 'a folder/the cross.png'");
}

void comparison()
{
    make_constant(4, 2, 3, "uint8", 0.2f, "a.png");
    make_constant(4, 2, 3, "uint8", 0.4f, "b.png");
    Ran ran = passes("compare: the same", "compare a.png a.png");
    result(matches(ran.out, "PSNR  *inf dB") &&
               matches(ran.out, "^maximum  *0 grey levels of 8 bits$"),
           "compare: no error", ran.out);
    ran =
        passes("compare: at the limit", "compare --max-mean 51.001 --max-rmse 51.001 a.png b.png");
    result(matches(ran.out, "^RMSE  *51 grey"), "compare: grey levels", ran.out);
    fails("compare: above the limit of RMSE", 1, "above the limit",
          "compare --quiet --max-rmse 50.9 a.png b.png");
    fails("compare: above the limit of the mean", 1, "above the limit",
          "compare --quiet --max-mean 50.9 a.png b.png");
    make_constant(4, 2, 1, "float", std::stof("nan"), "nan.tif");
    make_constant(4, 2, 1, "float", std::stof("inf"), "inf.tif");
    make_constant(4, 2, 1, "float", 1, "one.tif");
    passes("compare: NaN with NaN", "compare --max 0 nan.tif nan.tif");
    passes("compare: inf with inf", "compare --max 0 inf.tif inf.tif");
    fails("compare: NaN with 1", 1, "inf, above",
          "compare --quiet --max-rmse 1e30 nan.tif one.tif");
    fails("compare: inf with NaN", 1, "inf, above",
          "compare --quiet --max-mean 1e30 inf.tif nan.tif");
}

} // namespace

const std::vector<Subject> &reproject_subjects()
{
    static const std::vector<Subject> subjects = {{"several_mappings", several_mappings},
                                                  {"every_frame", every_frame},
                                                  {"odd_sizes", odd_sizes},
                                                  {"cube_to_cube", cube_to_cube},
                                                  {"reproject_talk", talk},
                                                  {"comparison", comparison}};
    return subjects;
}
