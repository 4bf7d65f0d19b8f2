// SPDX-License-Identifier: MIT
//
// What cubemap-reproject and cubemap-compare make of images.

#include "direction_image.hpp"
#include "image_cases.hpp"
#include "picture_checks.hpp"

#include <algorithm>
#include <array>
#include <filesystem>

#include <unistd.h>

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

// ---- mappings of one face

struct ChartBounds
{
    const char *chart;
    double largest;
    double mean;
};

// Beside a disc's rim there is nothing to interpolate with: up to a pixel and a half.
constexpr ChartBounds chart_bounds[] = {
    {"octahedral", 6e-4, 2e-5},
    {"octahedral:clarberg", 3e-3, 5e-5},
    {"peirce", 4e-5, 2e-5},
    {"quincuncial:equidistant,radial,lon=20,lat=30", 4e-3, 2e-5},
    {"border:equidistant,squircle", 5e-5, 2e-5},
    {"border:breusing,elliptical,lon=20,lat=30", 8e-5, 3e-5},
    {"rhealpix", 6e-3, 1e-4},
    {"rhealpix:north=2,south=3", 6e-3, 1e-4},
    {"azimuthal:equidistant:full=1", 8e-3, 3e-5},
};

void charts()
{
    make_direction_image(equirect_shape, 1024, "equirect.tif");
    Words all = catalogue_names(true);
    for (const char *chart :
         {"azimuthal:lambert:full=1", "azimuthal:equidistant:fov=200,lon=20,lat=30", "peirce",
          "quincuncial:mixture,elliptical,lon=100,lat=-20,beta=0.7"})
    {
        all.emplace_back(chart);
    }
    for (std::size_t i = 0; i < all.size(); i += static_cast<std::size_t>(one_in(4)))
    {
        does("reproject --quiet --filter bilinear --to " + all[i] +
             " --size 256 equirect.tif chart.tif");
        holds("equirect to " + all[i],
              [&] { check_direction_image({all[i]}, "chart.tif", 2e-5, 6e-6); });
    }
    int turn = 0;
    for (const ChartBounds &bounds : chart_bounds)
    {
        if (turn++ % one_in(3) == 0)
        {
            const std::string chart = bounds.chart;
            make_direction_image({chart}, 512, "chart.tif");
            does("reproject --quiet --filter bilinear --from " + chart + " chart.tif back.tif");
            holds(chart + " to equirect",
                  [&] {
                      check_direction_image(equirect_shape, "back.tif", bounds.largest,
                                            bounds.mean);
                  });
        }
    }
    for (const std::string name :
         {"lambert", "stereographic", "equidistant", "mixture", "breusing"})
    {
        if (turn++ % one_in(3) == 0)
        {
            const std::string chart = "azimuthal:" + name;
            make_direction_image({chart}, 512, "chart.tif");
            does("reproject --quiet --filter bilinear --from " + chart +
                 " --to azimuthal:lambert --size 300 chart.tif back.tif");
            holds(chart + " to another",
                  [] { check_direction_image({"azimuthal:lambert"}, "back.tif", 1e-2, 5e-5); });
        }
    }
}

// A centre a quarter turn further on turns a layout, and the pixels beyond its border with it.
void chart_borders()
{
    make_noise(32, 32, "noise.ppm");
    make_turned("noise.ppm", 32, 32, "turned.ppm");
    for (const std::string chart : {"quincuncial:lambert,shirley", "border:equidistant,radial"})
    {
        const std::string from =
            "reproject --quiet --filter bilinear --from " + chart + " --to " + chart;
        does(from + ",lon=180 --size 45 noise.ppm half.png");
        does(from + " --size 45 turned.ppm turned.png");
        passes(chart + ", half a turn", "compare --max 1 half.png turned.png");
    }
    int size = 0;
    make_constant(5, 5, 1, "float", 0.7f, "wanted.tif");
    does("reproject --quiet --filter bilinear --from peirce --to azimuthal:lambert:fov=80 --size 5 "
         "wanted.tif "
         "disc.tif");
    for (const std::string &chart : catalogue_names(true))
    {
        for (const std::string filter : {"nearest", "bilinear"})
        {
            const std::string same = "reproject --quiet --filter bilinear --filter " + filter +
                                     " --from " + chart + " --to " + chart;
            does(same + " noise.ppm same.tif");
            does(same + " same.tif again.tif");
            passes(chart + " to the same, " + filter + ": the same pixels",
                   "compare --max 0 same.tif again.tif");
        }
        if (chart == "rhealpix") // no pixel of so few is on each of its squares
        {
            continue;
        }
        size = size % 3 + 1;
        make_constant(size, size, 1, "float", 0.7f, "small.tif");
        does("reproject --quiet --filter bilinear --from " + chart +
             " --to azimuthal:lambert:fov=80 --size 5 small.tif out.tif");
        passes(chart + " of " + std::to_string(size) + " pixels",
               "compare --max 0 out.tif disc.tif");
    }
}

// What is not on the map is black, and transparent if there is alpha.
void chart_background()
{
    make_constant(32, 32, 4, "float", 0.5f, "disc.tif");
    const std::string half = "reproject --quiet --filter bilinear --size 16 --to equirect --from ";
    does(half + "azimuthal:stereographic disc.tif half.tif");
    does(half + "azimuthal:stereographic:lat=-90 disc.tif other.tif");
    make_constant(16, 8, 4, "float", 0.5f, "ones.tif");
    const std::string one = does("compare half.tif ones.tif").out;
    const std::string other = does("compare other.tif ones.tif").out;
    result(matches(one, "^mean absolute error  0\\.25$") &&
               matches(other, "^mean absolute error  0\\.25$"),
           "half of the sphere is transparent", one + other);
    make_constant(64, 32, 4, "uint8", 1, "white.png");
    does(
        "reproject --quiet --filter bilinear --to azimuthal:lambert --size 100 white.png disc.png");
    make_constant(100, 100, 4, "uint8", 0, "black.png");
    // 7860 pixels of 10000 have their centres on the disc of radius 50
    const std::string beside = does("compare disc.png black.png").out;
    result(matches(beside, "^mean absolute error  200\\.4"), "beside a disc all is transparent",
           beside);
    const std::string lambert = "reproject --to azimuthal:lambert --size 64 ";
    does(lambert + "--quiet --graticule 30 --grid 2 --indicatrices 3 white.png lines.png");
    does(lambert + "--quiet white.png plain.png");
    passes("lines over a disc", "compare --max-mean 120 lines.png plain.png");
    const std::string said = does(lambert + "--indicatrices 3 white.png lines.png").out;
    result(!said.empty() && !matches(said, "left out"), "cells beside the disc are not missed",
           said);
}

// ---- pixels

void exactness()
{
    make_noise(256, 128, "noise.ppm");
    for (const std::string filter : {"nearest", "bilinear"})
    {
        does("reproject --quiet --filter bilinear --filter " + filter +
             " --from equirect --to equirect noise.ppm same.png");
        passes("same size, " + filter + ": the same pixels", "compare --max 0 noise.ppm same.png");
    }
    does("reproject --quiet --filter bilinear --size 100 --threads 1 noise.ppm one_%f.png");
    does("reproject --quiet --filter bilinear --size 100 --threads 3 noise.ppm three_%f.png");
    does("reproject --quiet --filter bilinear --size 100 --threads 16 noise.ppm many_%f.png");
    for (int face = 0; face < 6; ++face)
    {
        const std::string end = "_" + std::to_string(face) + ".png";
        result(same_content("one" + end, "three" + end) && same_content("one" + end, "many" + end),
               "the same bits from 1, 3 and 16 threads, face " + std::to_string(face));
    }
    const std::string nearest =
        "reproject --quiet --filter bilinear --size 40 --filter nearest --layout strip ";
    does(nearest + "noise.ppm strip.png");
    does(nearest + "--from cube --to cube strip.png strip-again.png");
    passes("cube to the same cube: the same pixels", "compare --max 0 strip.png strip-again.png");
}

void constant_of(int channels, const std::string &type)
{
    const std::string end = type == "half" ? ".exr" : ".tif";
    const std::string what = std::to_string(channels) + " channels, " + type;
    make_constant(64, 32, channels, type, 0.3f, "source" + end);
    make_constant(96, 16, channels, type, 0.3f, "strip" + end);
    const std::string bilinear = "reproject --quiet --filter bilinear ";
    does(bilinear + "--layout strip source" + end + " out" + end);
    does(bilinear + "out" + end + " back" + end);
    passes("constant, " + what, "compare --max 0 out" + end + " strip" + end);
    passes("constant and back, " + what, "compare --max 0 back" + end + " source" + end);
    const std::string description = describe_image("out" + end);
    result(matches(description, "^96 x 16, " + what), "type and channels are kept, " + what,
           description);
}

// A constant image stays constant, to the last bit, in every type and number of channels.
void constants()
{
    for (int channels = 1; channels <= 5; channels += one_in(2))
    {
        for (const char *type : {"uint8", "uint16", "half", "float"})
        {
            constant_of(channels, type);
        }
    }
    make_constant(64, 32, 4, "float", 1, "source.tif");
    does("reproject --quiet --filter bilinear --layout cross source.tif cross.tif");
    const std::string description = describe_image("cross.tif");
    result(matches(description, "^64 x 48, 4 channels, float"), "size of a cross", description);
    std::string red = "P6 8 4 255\n";
    for (int i = 0; i < 32; ++i)
    {
        red += std::string("\xff\0\0", 3);
    }
    write_file("red.ppm", red);
    does("reproject --quiet --filter bilinear --layout cross red.ppm cross.png");
    make_constant(8, 6, 3, "uint8", 0, "black.png");
    const std::string said = does("compare cross.png black.png").out;
    // 255 in half of the pixels, one channel of three
    result(matches(said, "mean absolute error  42\\.5 grey"), "the corners of a cross are 0", said);
}

void formats()
{
    make_constant(64, 32, 3, "float", 0.5f, "source.exr");
    for (const std::string extension : {"png", "jpg", "tif", "exr", "hdr", "PNG"})
    {
        passes("to ." + extension,
               "reproject --quiet --filter bilinear --size 16 source.exr cube_%f." + extension);
        passes("from ." + extension,
               "reproject --quiet --filter bilinear cube_%f." + extension + " back.exr");
        passes("through ." + extension, "compare --max 0.006 source.exr back.exr");
    }
    make_constant(64, 32, 4, "uint8", 0.5f, "alpha.png");
    const Ran ran = passes("JPEG has no alpha", "reproject alpha.png cube_%f.jpg");
    result(matches(ran.out, "without alpha"), "and the program says so", ran.out);
    make_constant(64, 32, 4, "uint8", 0.5f, "alpha.png", {"oiio:UnassociatedAlpha=1"});
    passes("alpha from PNG to EXR", "reproject alpha.png half.exr --to equirect");
    const std::string description = describe_image("half.exr");
    result(matches(description, "4 channels, half"), "is kept", description);
    make_constant(64, 32, 4, "uint8", 0.2f, "alpha.png", {"oiio:UnassociatedAlpha=1"});
    does("reproject --quiet --filter bilinear alpha.png half.exr --to equirect");
    holds("and the colours, made light, are multiplied by it",
          [] {
              check_pixel("half.exr", 8, 8, {0.00662, 0.00662, 0.00662, 0.2});
          });
    does("reproject --quiet --filter bilinear --stored alpha.png half.exr --to equirect");
    holds("as they are stored, too",
          [] {
              check_pixel("half.exr", 8, 8, {0.04, 0.04, 0.04, 0.2});
          });
}

// A TIFF file with the orientation that turns its 32 x 16 pixels by 180 degrees.
void write_turned_tiff(const std::string &name)
{
    make_turned("noise.ppm", 32, 16, "turned.ppm");
    const std::string whole = content_of("turned.ppm");
    const std::string pixels = whole.substr(whole.size() - std::size_t{32} * 16 * 3);
    const auto number = [](unsigned value, int bytes)
    {
        std::string text;
        for (int i = 0; i < bytes; ++i)
        {
            text += static_cast<char>(value >> (8 * i));
        }
        return text;
    };
    const unsigned size = static_cast<unsigned>(pixels.size());
    const unsigned tags[][3] = {{256, 3, 32}, {257, 3, 16},  {258, 3, 8}, {259, 3, 1},
                                {262, 3, 2},  {273, 4, 8},   {274, 3, 3}, {277, 3, 3},
                                {278, 3, 16}, {279, 4, size}};
    std::string file = "II" + number(42, 2) + number(8 + size, 4) + pixels;
    file += number(static_cast<unsigned>(std::size(tags)), 2);
    for (const auto &tag : tags)
    {
        file += number(tag[0], 2) + number(tag[1], 2) + number(1, 4) + number(tag[2], 4);
    }
    write_file(name, file + number(0, 4));
}

void metadata()
{
    make_constant(64, 32, 3, "uint8", 0.5f, "source.jpg",
                  {"Copyright=Somebody", "Orientation=3", "XResolution=300",
                   "GPano:ProjectionType=equirectangular", "Exif:PixelXDimension=64"});
    does("reproject --quiet --filter bilinear source.jpg face_%f.tif");
    const std::string description = describe_image("face_5.tif");
    result(matches(description, "Copyright=Somebody"), "copyright is kept", description);
    result(!matches(description, "GPano|PixelXDimension|XResolution=300|Orientation=3"),
           "what no longer holds is not", description);
    make_noise(32, 16, "noise.ppm");
    does("reproject --quiet --filter bilinear --from equirect --to equirect noise.ppm plain.png");
    write_turned_tiff("turned.tif");
    does(
        "reproject --quiet --filter bilinear --from equirect --to equirect turned.tif upright.png");
    passes("orientation is applied", "compare --max 0 plain.png upright.png");
}

// Faces of several depths are taken as the deepest; TIFF is as it comes unless its source was packed.
void depths()
{
    for (int face = 0; face < 6; ++face)
    {
        make_constant(16, 16, 3, face == 3 ? "uint16" : "uint8", 0.4f,
                      "face_" + std::to_string(face) + ".png");
    }
    const std::string said = does("reproject face_%f.png back.png").out;
    result(matches(said, "3 channels, uint8 and uint16, taken as uint16\\)"),
           "six faces of two depths are taken as the deeper", said);
    const std::string deep = describe_image("back.png");
    result(matches(deep, "^64 x 32, 3 channels, uint16$"), "and the output has it", deep);
    make_constant(16, 16, 3, "float", 0.4f, "face_2.tif");
    for (const int face : {0, 1, 3, 4, 5})
    {
        make_constant(16, 16, 3, "uint8", 0.4f, "face_" + std::to_string(face) + ".tif");
    }
    const std::string mixed = does("reproject face_%f.tif back.tif").out;
    result(matches(mixed, "uint8 and float, taken as float\\)"), "whole numbers with floats",
           mixed);
    const std::string loose = describe_image("back.tif");
    result(matches(loose, "^64 x 32, 3 channels, float$") && matches(loose, "^compression=none$"),
           "TIFF is not packed", loose);
    make_constant(64, 32, 3, "uint8", 0.4f, "packed.tif", {"compression=lzw"});
    does("reproject --quiet --filter bilinear --to equirect --from equirect packed.tif again.tif");
    const std::string packed = describe_image("again.tif");
    result(matches(packed, "^compression=lzw$"), "unless it was", packed);
    for (int face = 0; face < 6; ++face)
    {
        make_constant(16, 16, 4, "uint8", 0.4f, "alpha_" + std::to_string(face) + ".tif",
                      {"oiio:UnassociatedAlpha=" + std::to_string(face == 5)});
    }
    fails("faces with and without colours multiplied by alpha", 1,
          "'alpha_5.tif' has alpha otherwise than 'alpha_0.tif'",
          "reproject alpha_%f.tif made/a.png");
}

void golden()
{
    const std::string folder = source_tree() + "/tests/programs/golden/";
    const auto go = [](const Words &words)
    {
        const Ran ran = run(words);
        if (ran.status != 0)
        {
            result(false, words.back(), ran.err);
        }
    };
    const auto is = [](const std::string &name, const std::string &made, const std::string &wanted)
    {
        const Ran ran = run(Words{"compare", "--max", "1", made, wanted});
        result(ran.status == 0 && ran.err.empty(), name, ran.out + ran.err);
    };
    const std::string source = folder + "earth-64.png";
    go({"reproject", "--quiet", "--filter", "bilinear", "--size", "16", "--layout", "cross", source,
        "cross.png"});
    is("golden: cross of the Earth", "cross.png", folder + "earth-cross-16.png");
    go({"reproject", "--quiet", "--filter", "bilinear", "--size", "64",
        folder + "earth-cross-16.png", "back.png"});
    is("golden: and back", "back.png", folder + "earth-back-64.png");
    go({"reproject", "--quiet", "--filter", "bilinear", "--size", "16", "--frame", "gl", "--to",
        "cube:tangent", "--layout", "strip", source, "strip.png"});
    is("golden: strip in frame gl", "strip.png", folder + "earth-strip-gl-16.png");
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
    cut("whole.jpg", content_of("whole.jpg").size() - 2, "part.jpg");
    fails("jpg without its last bytes", 1, "'part.jpg'", "reproject part.jpg made/a.png");
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

// ---- colours that are no light, and opacity that no file says

// TIFF 6.0, section 16: 2 x 1 pixels of four inks.
std::string ink_tiff()
{
    const auto word = [](unsigned value) {
        return std::string{static_cast<char>(value & 0xff), static_cast<char>(value >> 8 & 0xff)};
    };
    const auto number = [&word](unsigned value) { return word(value) + word(value >> 16); };
    constexpr unsigned entries = 9;
    constexpr unsigned bits_at = 8 + 2 + entries * 12 + 4;
    const auto entry = [&](unsigned tag, unsigned count, unsigned value)
    { return word(tag) + word(count > 1 ? 3 : 4) + number(count) + number(value); };
    return "II*" + std::string(1, 0) + number(8) + word(entries) + entry(256, 1, 2) +
           entry(257, 1, 1) + entry(258, 4, bits_at) + entry(259, 1, 1) + entry(262, 1, 5) +
           entry(273, 1, bits_at + 8) + entry(277, 1, 4) + entry(278, 1, 1) + entry(279, 1, 8) +
           number(0) + word(8) + word(8) + word(8) + word(8) + "CMYKcmyk";
}

void unusual_colors()
{
    // GIF89a, 2 x 1 pixels of two colours
    write_file("two.gif", std::string("GIF89a\x02\0\x01\0\x80\0\0", 13) +
                              std::string("\x10\x20\x30\xf0\xe0\xd0,\0\0\0\0\x02\0\x01\0\0", 16) +
                              std::string("\x02\x02\x44\x0a\0;", 6));
    does("reproject --quiet --to equirect --filter nearest two.gif two.tif");
    result(matches(describe_image("two.tif"), "^2 x 1, [34] channels, uint8$"), "GIF is read",
           describe_image("two.tif"));
    write_file("ink.tif", ink_tiff());
    const Ran ran = run("reproject --quiet --size 8 ink.tif a_%f.png");
    result(ran.status == 0 && matches(ran.err, "'ink.tif' is CMYK; .* without a profile"),
           "inks are told", ran.err);
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

} // namespace

const std::vector<Subject> &reproject_subjects()
{
    static const std::vector<Subject> subjects = {{"several_mappings", several_mappings},
                                                  {"every_frame", every_frame},
                                                  {"odd_sizes", odd_sizes},
                                                  {"cube_to_cube", cube_to_cube},
                                                  {"charts", charts},
                                                  {"chart_borders", chart_borders},
                                                  {"chart_background", chart_background},
                                                  {"exactness", exactness},
                                                  {"constants", constants},
                                                  {"formats", formats},
                                                  {"metadata", metadata},
                                                  {"unusual_colors", unusual_colors},
                                                  {"depths", depths},
                                                  {"golden", golden},
                                                  {"reproject_talk", talk},
                                                  {"comparison", comparison},
                                                  {"reproject_arguments", bad_arguments},
                                                  {"bad_input", bad_input},
                                                  {"reproject_output", bad_output}};
    return subjects;
}
