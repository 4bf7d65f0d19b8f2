// SPDX-License-Identifier: MIT
//
// What cubemap-reproject makes of surfaces of all kinds, however they are turned.

#include "direction_image.hpp"
#include "image_cases.hpp"
#include "picture.hpp"
#include "picture_checks.hpp"

#include "tools/reproject/reproject_main.h"

#include <cstring>
#include <filesystem>

namespace
{

// ---- kinds of surfaces

void there_and_back(const std::string &to, double largest, double mean,
                    const std::string &filter = "bilinear")
{
    does("reproject --quiet --filter " + filter + " --to " + to + " equirect.tif there.tif");
    does("reproject --quiet --filter bilinear there.tif back.tif");
    holds("equirect to " + to + " and back",
          [&] { check_direction_image(equirect_shape, "back.tif", largest, mean); });
}

void kinds()
{
    make_direction_image(equirect_shape, 1024 / one_in(2), "equirect.tif");
    for (const char *layout : {"vcross", "column", "3x2", "2x3", "eac", "eac:pad=3"})
    {
        there_and_back(std::string("cube;layout=") + layout, 2e-3, 5e-5);
    }
    there_and_back("cube:qsc;frame=gl;layout=cross:north=0,south=3;size=256", 2e-3, 5e-5);
    there_and_back("healpix:128", 2e-3, 5e-5);
    there_and_back("equal-area;size=1024", 2e-2, 6e-4); // few rows near the poles
    there_and_back("dual-fisheye:equidistant:fov=200;size=1024", 2e-3, 5e-5);
    there_and_back("healpix:128", 2e-3, 5e-5, "ewa");
    does(
        "reproject --quiet --to cube --layout strip --size 17 --filter ewa equirect.tif strip.tif");
    holds("a pole in the middle of a footprint",
          [] {
              check_direction_image({"coupled", "geo", "strip"}, "strip.tif", 5e-3, 3e-3);
          });
    does("reproject --quiet --to cube --layout vcross equirect.tif there.tif");
    says("vcross by its shape", "^there\\.tif \\(cube:coupled, frame geo, vcross",
         "reproject --from cube:coupled there.tif back.tif");
}

// A part of a picture, with its edges between pixels, has the same pixels.
void parts()
{
    make_noise(72, 36, "noise.ppm"); // 5 degrees a pixel
    const std::string whole = content_of("noise.ppm");
    const std::string pixels = whole.substr(whole.size() - std::size_t{72} * 36 * 3);
    std::string part = "P6 18 9 255\n";
    for (std::size_t row = 9; row < 18; ++row)
    {
        part += pixels.substr((row * 72 + 36) * 3, 18 * 3);
    }
    write_file("part.ppm", part);
    const std::string spec = "equirect;west=0;east=90;south=0;north=45";
    does("reproject --quiet --filter bilinear --to " + spec + ";size=18 noise.ppm cut.png");
    passes("a part of an equirectangular picture", "compare --max 0 cut.png part.ppm");
    says("its tag says where it is", "^cut\\.png \\(equirect;west=0;east=90;south=0;north=45 18x9",
         "reproject --to equirect --size 72 cut.png back.png");
    does("reproject --quiet --to equirect --filter bilinear --size 72 --from " + spec +
         " part.ppm again.png");
    passes("and what --from says is the same", "compare --max 0 back.png again.png");
    does("reproject --quiet --to " + spec + " noise.ppm same.png");
    passes("without a size a part has the columns that the whole has there",
           "compare --max 0 same.png part.ppm");
    does("reproject --quiet --to equirect same.png whole.png");
    does("reproject --quiet --to " + spec + " whole.png same.png");
    passes("and the whole those of the part", "compare --max 0 same.png part.ppm");
    says("a view has the density of its source", "-> view\\.png \\(view:fov=90 [12][0-9]x1[0-9];",
         "reproject --to view:fov=90 noise.ppm view.png");
}

struct WrongSurface
{
    const char *name;
    const char *words;
    const char *arguments;
};

constexpr WrongSurface wrong_surfaces[] = {
    {"layout twice", "has layout=cross; leave one out",
     "--to cube;layout=cross --layout strip noise.ppm made/a.png"},
    {"frame twice", "has frame=gl; leave one out",
     "--from cube;frame=gl --from-frame geo noise.ppm made/a.png"},
    {"size twice", "has a size already", "--to equirect;size=64 --size 64 noise.ppm made/a.png"},
    {"size and density", "leave one out", "--size 64 --keep mean noise.ppm made/a.png"},
    {"density that is none", "mean or max", "--keep least noise.ppm made/a.png"},
    {"unknown key", "has no key 'edge'", "--to cube;edge=3 noise.ppm made/a.png"},
    {"nearly a kind", "did you mean healpix", "--to healpx:4 noise.ppm made/a.png"},
    {"rotation that is none", "--rotate: ", "--rotate 10 noise.ppm made/a.png"},
    {"nearly an orientation", "did you mean land-coupled",
     "--rotate land-couple noise.ppm made/a.png"},
    {"program that is none", "--for is 'blender', not", "--for blender noise.ppm made/a.png"},
    {"a program and a mapping", "leave those out", "--for unity --to cube noise.ppm made/a.png"},
    {"two ways to be light", "leave one out", "--linear --gamma 2 noise.ppm made/a.png"},
    {"a vector of two", "INPUT has 3", "--vector 2 noise.ppm made/a.png"},
    {"no such treatment", "skip, zero, spread, refuse", "--not-finite keep noise.ppm made/a.png"},
    {"tolerance too large", "--tolerance", "--tolerance 2 noise.ppm made/a.png"},
    {"compression of another format", "a number from 0 to 9",
     "--compression lzw noise.ppm made/a.png"},
    {"compression that is none", "one of: none lzw zip packbits",
     "--compression zap noise.ppm made/a.tif"},
    {"quality too high", "a quality from 1 to 100", "--compression 101 noise.ppm made/a.jpg"},
    {"compression of HDR", "one way only", "--compression rle noise.ppm made/a.hdr"},
    {"dither and lines", "leave one out", "--dither --graticule 30 noise.ppm made/a.png"},
};

void surface_arguments()
{
    make_noise(64, 32, "noise.ppm");
    for (const WrongSurface &each : wrong_surfaces)
    {
        fails(each.name, 2, each.words, std::string("reproject ") + each.arguments);
    }
    fails("a shape that the kind has not", 1, "64 x 32, no image in healpix:8",
          "reproject --from healpix:8 noise.ppm made/a.png");
}

void sizes()
{
    make_noise(64, 32, "noise.ppm");
    // 6 n^2 = 64 x 32
    says("as many pixels", "gnomonic, frame geo, 18x18, as many pixels as INPUT;",
         "reproject --keep mean --to cube:gnomonic noise.ppm mean.png");
    // the middle of a face has n / 2 pixels a radian, the source 64 / (2 pi)
    says("nowhere fewer", "gnomonic, frame geo, 21x21, as dense as INPUT where it is densest;",
         "reproject --keep max --to cube:gnomonic noise.ppm max.png");
    // tan: 4 n / pi at the edges' middles and corners, where faces are densest
    says("back, where faces are densest", "\\(equirect [0-9]*x[0-9]*, as dense",
         "reproject --keep max max_%f.png back.png");
    for (const std::string fov : {"180", "190", "193", "200"})
    {
        says("circles have an even width, fov=" + fov, ":fov=" + fov + " [0-9]*[02468]x",
             "reproject --to dual-fisheye:fov=" + fov + " noise.ppm circles.png");
    }
    says("HEALPix has powers of two", "healpix:16 192x16;",
         "reproject --to healpix noise.ppm healpix.png");
}

// ---- orientation

void rotations()
{
    make_noise(64, 32, "noise.ppm");
    const std::string whole = content_of("noise.ppm");
    const std::string pixels = whole.substr(whole.size() - std::size_t{64} * 32 * 3);
    std::string shifted = "P6 64 32 255\n";
    for (std::size_t row = 0; row < 32; ++row)
    {
        const std::string line = pixels.substr(row * 64 * 3, 64 * 3);
        shifted += line.substr(16 * 3) + line.substr(0, 16 * 3);
    }
    write_file("shifted.ppm", shifted);
    const std::string same = "reproject --quiet --filter nearest --to equirect ";
    does(same + "--rotate 90,0 noise.ppm turned.png");
    passes("a quarter turn to the east", "compare --max 0 turned.png shifted.ppm");
    does(same + "turned.png back.png");
    passes("and its tag turns it back", "compare --max 0 back.png noise.ppm");
    does(same + "--from-rotate 90,0,0 shifted.ppm back.png");
    passes("and so does --from-rotate", "compare --max 0 back.png noise.ppm");
    says("an orientation by its name", "turned by [-0-9.]+,[-0-9.]+,[-0-9.]+;",
         "reproject --rotate land-coupled noise.ppm land_%f.png");
}

// An image of directions stays one of directions in the axes of the target, if they are turned with it.
void vectors()
{
    make_direction_image(equirect_shape, 512, "equirect.tif");
    make_constant(64, 32, 3, "float", -2.0f, "two.tif");
    does("reproject --quiet --to equirect --vector 1 --rotate 30,40,50 equirect.tif turned.tif");
    holds("vectors turn with the axes",
          [] { check_direction_image(equirect_shape, "turned.tif", 1e-4, 3e-5); });
    does("reproject --quiet --to equirect --vector 1 turned.tif back.tif");
    holds("and back", [] { check_direction_image(equirect_shape, "back.tif", 2e-4, 6e-5); });
    // whole numbers hold them as normal maps do, from which they come back as floats
    const std::string vector = "reproject --quiet --to equirect --vector 1 ";
    does(vector + "equirect.tif bytes.png");
    holds("bytes are between -1 and 1",
          [] {
              check_pixel("bytes.png", 256, 128, {1.0, 128 / 255.0, 127 / 255.0});
          });
    does(vector + "--rotate 30,40,50 bytes.png turned.png");
    for (const std::string filter : {"nearest", "bilinear", "spline36", "bspline5", "ewa"})
    {
        does(vector + "--filter " + filter + " turned.png back.pfm");
        const double most = filter == "nearest" ? 0.02 : 0.012; // nearest is half a pixel off
        holds("and turn as floats do, " + filter,
              [most] { check_direction_image(equirect_shape, "back.pfm", most, 0.3 * most); });
    }
    says("a vector that is too long is told", "of vectors beyond 1 written as 1\\)$",
         "reproject --to equirect --vector 1 two.tif two.png");
    fails("nor have whole numbers lines over vectors", 2, "let OUTPUT be floats",
          vector + "--graticule 30 bytes.png lines.png");
}

void programs()
{
    make_direction_image(equirect_shape, 512, "equirect.tif");
    for (const std::string program :
         {"opengl", "vulkan", "directx", "unity", "unreal", "threejs", "youtube"})
    {
        const std::string name = program == "youtube" ? "sky.tif" : "sky_%f.tif";
        does("reproject --quiet --for " + program + " equirect.tif " + name);
        does("reproject --quiet " + name + " back.tif");
        holds("for " + program + " and back",
              [] { check_direction_image(equirect_shape, "back.tif", 3e-3, 1e-4); });
    }
}

void manual()
{
    const std::string page = content_of(source_tree() + "/tools/reproject/cubemap-reproject.1.in");
    const std::string examples = page.substr(page.find(".SH EXAMPLES"));
    std::string missing;
    const cm_option *option = nullptr;
    for (std::size_t i = 0; (option = cm_options_at(&cm_reproject_command, i)) != nullptr; ++i)
    {
        std::string written = " \\-\\-";
        for (const char *letter = option->name; *letter != '\0'; ++letter)
        {
            written += *letter == '-' ? "\\-" : std::string(1, *letter);
        }
        const bool printed = std::string(option->name) == "help" ||
                             std::string(option->name) == "version" ||
                             (option->flags & CM_OPTION_HIDDEN) != 0;
        missing += printed || examples.find(written + " ") != std::string::npos
                       ? ""
                       : std::string(option->name) + " ";
    }
    result(missing.empty(), "the man page's examples have every option", missing);
}

} // namespace

const std::vector<Subject> &reproject_surface_subjects()
{
    static const std::vector<Subject> subjects = {
        {"kinds", kinds},       {"parts", parts},         {"surface_arguments", surface_arguments},
        {"sizes", sizes},       {"rotations", rotations}, {"vectors", vectors},
        {"programs", programs}, {"manual", manual}};
    return subjects;
}
