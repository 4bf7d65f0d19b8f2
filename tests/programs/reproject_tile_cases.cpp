// SPDX-License-Identifier: MIT
//
// Outputs of cubemap-reproject that are many pictures in one: tiles of HiPS, and the parts of OpenEXR files.

#include "direction_image.hpp"
#include "image_cases.hpp"
#include "picture.hpp"
#include "modules/image/io/image_io.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <cubemap/healpix.h>

namespace
{

// ---- tiles of HiPS

// Pixels of some tiles of an order, numbered in NESTED by their row and column, hold their directions.
void check_tiles(std::uint32_t order, const std::string &ending, double largest)
{
    cm_healpix *grid = nullptr;
    if (cm_healpix_create(std::int64_t{16} << order, CM_HEALPIX_NESTED, nullptr, &grid) != CM_OK)
    {
        throw std::runtime_error("no grid");
    }
    const std::unique_ptr<cm_healpix, void (*)(cm_healpix *)> owned(grid, cm_healpix_destroy);
    for (std::int64_t tile = 0; tile < std::int64_t{12} << 2 * order; tile += 1 + 5 * order)
    {
        const std::string name =
            "sky/Norder" + std::to_string(order) + "/Dir0/Npix" + std::to_string(tile) + ending;
        const Picture picture(name);
        for (int i = 0; i < 16 * 16; i += 7)
        {
            // the bits of the row and of the column in turn
            std::int64_t number = tile * 256;
            for (int bit = 0; bit < 4; ++bit)
            {
                number += (i / 16 >> bit & 1) << 2 * bit;
                number += (i % 16 >> bit & 1) << (2 * bit + 1);
            }
            double at[3];
            cm_healpix_direction_from_pixel(grid, number, at);
            for (int c = 0; c < picture.channels; ++c)
            {
                // bytes hold no negative numbers
                const double found = static_cast<double>(picture.at(i % 16, i / 16)[c]);
                if (!(std::fabs(found - std::max(at[c], 0.0)) < largest))
                {
                    throw std::runtime_error(name + ": " + std::to_string(found) + ", not " +
                                             std::to_string(at[c]));
                }
            }
        }
    }
}

void tiles()
{
    make_direction_image(equirect_shape, 256, "equirect.tif");
    make_noise(64, 32, "noise.ppm");
    says("tiles",
         "^noise\\.ppm .* -> noise/ \\(healpix:128 1536x128; .*; HiPS tiles of 16x16 pixels, "
         "orders 0 to 3, png\\)",
         "reproject --size 16 --order 3 noise.ppm noise/");
    const std::string properties = content_of("noise/properties");
    for (const char *line : {"^creator_did +=", "^obs_title +=", "^dataproduct_type += image",
                             "^hips_version +=", "^hips_release_date += [0-9-]+T[0-9:]+Z",
                             "^hips_status +=", "^hips_frame += equatorial", "^hips_order += 3",
                             "^hips_tile_width += 16", "^hips_tile_format += png"})
    {
        result(matches(properties, line), std::string("properties: ") + line, properties);
    }
    result(names_in("noise") == "Norder0 Norder1 Norder2 Norder3 properties " &&
               names_in("noise/Norder3") == "Allsky.png Dir0 ",
           "folders", names_in("noise") + names_in("noise/Norder3"));
    const Picture all("noise/Norder3/Allsky.png");
    result(all.width == 27 * 16 && all.height == 29 * 16, "the preview's size");
    const Picture fifth("noise/Norder3/Dir0/Npix5.png");
    bool same = true;
    for (int i = 0; i < 256; ++i)
    {
        same = same && std::equal(fifth.at(i % 16, i / 16), fifth.at(i % 16, i / 16) + 3,
                                  all.at(5 * 16 + i % 16, i / 16));
    }
    result(same, "a tile in the preview");
    does("reproject --quiet --filter bilinear --stored --size 16 --order 2 equirect.tif sky/");
    holds("tiles of the greatest order", [] { check_tiles(2, ".png", 4e-3); });
    holds("tiles of a smaller order are means of four", [] { check_tiles(1, ".png", 6e-3); });
    make_constant(32, 16, 1, "float", 2.5f, "one.tif");
    does("reproject --quiet --size 16 --order 0 one.tif one/");
    const std::string fits = content_of("one/Norder0/Dir0/Npix11.fits");
    result(names_in("one/Norder0") == "Dir0 " && matches(fits.substr(0, 720), "NPIX *= *11 ") &&
               fits.substr(2880, 2) == "\x40\x20",
           "one channel of floats is FITS");
    fails("a folder that is there", 1, "is there already", "reproject noise.ppm sky/");
    fails("an order without a folder", 2, "whose name ends in /",
          "reproject --order 3 noise.ppm made/a.png");
    fails("a projection of tiles", 2, "leave --to", "reproject --to equirect noise.ppm made/a/");
    fails("an edge that tiles have not", 2, "a power of two",
          "reproject --size 50 noise.ppm made/a/");
    for (const char *line :
         {"--manifest made/a.json noise.ppm made/a/", "noise_%d.ppm made/a/", "- made/a/"})
    {
        fails(std::string("tiles and ") + line, 2, "of one picture in files",
              std::string("reproject ") + line);
    }
    fails("a folder in none", 1, "cannot be written: folder", "reproject noise.ppm none/a/");
    const SizeLimit limit(500);
    fails("a full disk and tiles", 1, "cannot be written: File too large",
          "reproject --order 0 --size 64 noise.ppm made/a/");
}

// ---- what tiles are

void tile_formats()
{
    make_direction_image(equirect_shape, 256, "equirect.tif");
    make_noise(64, 32, "noise.ppm");
    const std::string own = "reproject --quiet --filter bilinear --stored --size 16 --order 2 ";
    does(own + "--tiles jpeg --creator-did ivo://sky.example/P/noise equirect.tif sky/");
    const std::string properties = content_of("sky/properties");
    result(matches(properties, "^hips_tile_format += jpeg$") &&
               matches(properties, "^creator_did += ivo://sky.example/P/noise$"),
           "tiles of JPEG are said, and who publishes them", properties);
    result(names_in("sky/Norder2") == "Allsky.jpg Dir0 " &&
               content_of("sky/Norder2/Dir0/Npix7.jpg").substr(0, 3) == "\xff\xd8\xff",
           "tiles of JPEG", names_in("sky/Norder2"));
    holds("JPEG keeps what is smooth", [] { check_tiles(2, ".jpg", 0.05); });
    does(own + "--tiles jpeg --compression 30 noise.ppm coarse/");
    does(own + "--tiles jpeg --compression 100 noise.ppm fine/");
    result(content_of("coarse/Norder2/Dir0/Npix7.jpg").size() <
               content_of("fine/Norder2/Dir0/Npix7.jpg").size(),
           "the quality of tiles is chosen");
    make_constant(32, 16, 1, "uint8", 0.4f, "grey.tif");
    does(own + "--tiles fits grey.tif grey/");
    result(matches(content_of("grey/Norder0/Dir0/Npix0.fits").substr(0, 720), "BITPIX *= *-32 "),
           "bytes of one channel in FITS");
    make_constant(32, 16, 4, "uint8", 0.4f, "alpha.tif");
    does(own + "--tiles jpeg alpha.tif opaque/");
    result(Picture("opaque/Norder2/Dir0/Npix7.jpg").channels == 3, "JPEG leaves alpha out");
    fails("three channels in FITS", 2, "INPUT has 3; take jpeg or png",
          "reproject --tiles fits noise.ppm made/a/");
    fails("tiles without a folder", 2, "--tiles is for HiPS",
          "reproject --tiles png noise.ppm made/a.png");
    fails("tiles of GIF", 2, "jpeg, png or fits", "reproject --tiles gif noise.ppm made/a/");
    for (const char *creator :
         {"http://sky.example/P/a", "ivo://sky.example", "ivo:///P/a", "ivo://sky.example/"})
    {
        fails(std::string("published by ") + creator, 2, "not an identifier such as ivo://",
              std::string("reproject --creator-did ") + creator + " noise.ppm made/a/");
    }
}

// ---- parts of OpenEXR

bool same_pixels(const Picture &one, const Picture &other)
{
    return one.width == other.width && one.height == other.height &&
           one.channels == other.channels && one.values == other.values;
}

// OpenEXR's file layout: a string is its length, then its letters.
bool has_part(const std::string &file, const std::string &name)
{
    const char length[4] = {static_cast<char>(name.size()), 0, 0, 0};
    return content_of(file).find(std::string("name\0string\0", 12) + std::string(length, 4) +
                                 name) != std::string::npos;
}

void parts()
{
    make_noise(128, 64, "noise.ppm");
    const std::string own = "reproject --quiet --filter bspline5 --size 40 ";
    does(own + "noise.ppm face_%f.exr");
    says("a cube in parts", "^noise\\.ppm .* -> cube\\.exr \\(cube:coupled, .*; 6 parts;",
         "reproject --filter bspline5 --size 40 --parts noise.ppm cube.exr");
    bool same = true;
    for (unsigned i = 0; i < 6; ++i)
    {
        same = same &&
               same_pixels(Picture("cube.exr", i), Picture("face_" + std::to_string(i) + ".exr"));
    }
    result(same, "parts have the pixels of six files");
    for (const char *name : {"front", "right", "back", "left", "top", "bottom"})
    {
        result(has_part("cube.exr", name), std::string("a part has the name ") + name);
    }
    does("reproject --quiet --size 128 cube.exr again.exr");
    does("reproject --quiet --size 128 face_%f.exr other.exr");
    result(same_pixels(Picture("again.exr"), Picture("other.exr")), "parts are read as six files");
    does(own + "--for directx --parts noise.ppm axes.exr");
    result(has_part("axes.exr", "-y"), "names are those of the frame");
    does(own + "--threads 3 --parts noise.ppm threads.exr");
    result(same_pixels(Picture("threads.exr", 5), Picture("cube.exr", 5)),
           "for any number of threads");
    does("reproject --quiet --size 8 --mips --parts noise.ppm level.exr");
    result(Picture("level_m1.exr", 5).width == 4 && Picture("level_m3.exr", 5).width == 1,
           "levels in parts");
    does("reproject --quiet --size 8 --border 2 --parts noise.ppm border.exr");
    result(Picture("border.exr", 5).width == 12, "borders in parts");
}

// The faces of a cube, each of one value, as parts with these names.
void make_parts(const std::string &name, const std::vector<std::string> &names, int size)
{
    std::vector<float> values(static_cast<std::size_t>(size) * static_cast<std::size_t>(size) * 3);
    std::vector<const char *> words;
    for (const std::string &each : names)
    {
        words.push_back(each.c_str());
    }
    cm_image_description description = {};
    description.format = "openexr";
    description.width = static_cast<std::uint32_t>(size);
    description.height = static_cast<std::uint32_t>(size);
    description.channels = 3;
    description.type = CM_PIXEL_FLOAT;
    description.alpha = -1;
    description.part_names = words.data();
    description.part_count = static_cast<std::uint32_t>(words.size());
    char message[CM_IMAGE_MESSAGE] = "";
    const cm_image_io &io = *cm_image_io_get(message);
    cm_image_writer *writer = nullptr;
    bool good = io.create(name.c_str(), nullptr, &description, &writer, message) == CM_OK;
    for (std::size_t i = 0; good && i < names.size(); ++i)
    {
        std::fill(values.begin(), values.end(), static_cast<float>(i + 1));
        good = io.write(writer, 0, description.height, CM_PIXEL_FLOAT, values.data(), 0, 0,
                        message) == CM_OK;
    }
    good = good && io.finish(writer, message) == CM_OK;
    io.drop(writer);
    if (!good)
    {
        throw std::runtime_error(name + ": " + message);
    }
}

// What is ahead, at lon 0, at lat 90, and at lon 90, by parts with these names.
std::string looked(const std::vector<std::string> &names)
{
    make_parts("others.exr", names, 8);
    does("reproject --quiet --to equirect --size 64 others.exr globe.exr");
    const Picture globe("globe.exr");
    return std::to_string(std::lround(globe.first(32, 16))) +
           std::to_string(std::lround(globe.first(32, 0))) +
           std::to_string(std::lround(globe.first(48, 16)));
}

void parts_of_others()
{
    result(looked({"front", "right", "back", "left", "top", "bottom"}) == "152",
           "faces by their names");
    result(looked({"top", "bottom", "Left", "Right", "Front", "Back"}) == "514",
           "in whichever order they are");
    result(looked({"a", "b", "c", "d", "e", "f"}) == "152", "without such names, as they stand");
    // as in a texture: y up, +z ahead
    result(looked({"posx", "negx", "posy", "negy", "posz", "negz"}) ==
               looked({"px", "nx", "py", "ny", "pz", "nz"}),
           "axes have several names");
    const std::string axes = looked({"+x", "-x", "+y", "-y", "+z", "-z"});
    result(axes.substr(0, 2) == "53", "faces by their axes", axes);
    make_parts("stereo.exr", {"left", "right"}, 8);
    const Ran ran = run("reproject --quiet --from view --to equirect --size 16 stereo.exr a.exr");
    result(ran.status == 0 &&
               matches(ran.err, "'stereo.exr' has 2 pictures; the first is taken, 'left'"),
           "of other parts the first is taken, and said", ran.err);
}

void parts_refused()
{
    make_noise(64, 32, "noise.ppm");
    fails("parts of PNG", 2, "must end in .exr", "reproject --parts noise.ppm made/a.png");
    fails("parts in six files", 2, "leave %f", "reproject --parts noise.ppm made/a_%f.exr");
    fails("parts of one picture", 2, "is one picture; leave --parts out",
          "reproject --parts --to equirect noise.ppm made/a.exr");
    fails("parts through a pipe", 2, "must end in .exr", "reproject --parts noise.ppm -");
    fails("parts and tiles", 2, "leave --to, .*--parts", "reproject --parts noise.ppm made/a/");
    const SizeLimit limit(2000);
    fails("a full disk and parts", 1, "cannot be written: File too large",
          "reproject --parts noise.ppm made/a.exr");
}

// As long as INPUT is not read there is nothing that a signal would have to remove: signals act as ever.
void nothing_before_input()
{
    make_noise(64, 32, "noise.ppm");
    does("reproject --quiet --to equirect noise.ppm whole.hdr");
    const std::string whole = content_of("whole.hdr");
    write_file("cut.hdr", whole.substr(0, whole.size() / 2));
    std::filesystem::create_directory("here");
    const auto before = std::filesystem::last_write_time("here");
    fails("INPUT that ends too early", 1, "is damaged or ends too early",
          "reproject --size 64 --order 0 cut.hdr here/tiles/");
    result(std::filesystem::last_write_time("here") == before,
           "no folder of tiles before INPUT is read");
    fails("a folder that is not there is told before", 1, "folder 'nowhere': No such file",
          "reproject --size 64 --order 0 cut.hdr nowhere/tiles/");
}

} // namespace

const std::vector<Subject> &reproject_tile_subjects()
{
    static const std::vector<Subject> subjects = {{"nothing_before_input", nothing_before_input},
                                                  {"tiles", tiles},
                                                  {"tile_formats", tile_formats},
                                                  {"parts", parts},
                                                  {"parts_of_others", parts_of_others},
                                                  {"parts_refused", parts_refused}};
    return subjects;
}
