// SPDX-License-Identifier: MIT
//
// What cubemap-reproject makes of pixels: types, channels, light, noise; and of what files say of them.

#include "direction_image.hpp"
#include "image_cases.hpp"
#include "picture.hpp"
#include "picture_checks.hpp"
#include "tiff_file.hpp"

#include <cstdint>
#include <cstring>
#include <filesystem>

namespace
{

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
void constant_pictures()
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

// A JPEG file of 16 x 8 pixels of four inks as most programs write them, YCCK with Adobe's marker.
std::string ink_jpeg()
{
    const auto bytes = [](const std::string &digits)
    {
        std::string made;
        for (std::size_t i = 0; i + 1 < digits.size(); i += 2)
        {
            made += static_cast<char>(std::stoi(digits.substr(i, 2), nullptr, 16));
        }
        return made;
    };
    const std::string steps(64, 'c');
    return bytes("ffd8ffee000e41646f626500640000000002ffdb004300") + steps + bytes("ffdb004301") +
           steps +
           bytes("ffc00014080008001004011100021101031101041100ffc40016000101010000000000000000"
                 "0000000000000506ffc40014100100000000000000000000000000000000ffc4001601010101"
                 "00000000000000000000000000000506ffc40014110100000000000000000000000000000000"
                 "ffda000e040100021103110400003f009eb2cfb4800fffd9");
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
    // WebP, 4 x 2 pixels of (200, 100, 50), which the image library need not know
    write_file("four.webp", std::string("RIFF\x1e\0\0\0WEBPVP8L\x11\0\0\0\x2f\x03\x40\0\0"
                                        "\x07\x50\xb2\x22\x57\xa6\xff\x81\x88\xe8\x7f\0\0",
                                        38));
    const Ran web = run("reproject --quiet --to equirect --filter nearest four.webp four.tif");
    result(web.status == 0 || matches(web.err, "is not an image that can be read"), "WebP is read",
           web.err);
    if (web.status == 0)
    {
        holds("its pixels",
              [] {
                  check_pixel("four.tif", 3, 1, {200 / 255.0, 100 / 255.0, 50 / 255.0});
              });
    }
    write_file("ink.tif", ink_tiff());
    const Ran ran = run("reproject --quiet --size 8 ink.tif a_%f.png");
    result(ran.status == 0 && matches(ran.err, "'ink.tif' is CMYK; .* without a profile"),
           "inks are told", ran.err);
    write_file("ink.jpg", ink_jpeg());
    const Ran other = run("reproject --quiet --size 8 ink.jpg a_%f.png");
    result(other.status == 0 && matches(other.err, "'ink.jpg' is CMYK; .* without a profile"),
           "inks are told, of JPEG", other.err);
}

// ---- values

// Columns of 0 and 255: between two of them is the half.
void light()
{
    std::string stripes = "P6 8 4 255\n";
    for (int i = 0; i < 32; ++i)
    {
        stripes += i % 2 == 0 ? std::string(3, '\0') : std::string("\xff\xff\xff");
    }
    write_file("stripes.ppm", stripes);
    const std::string half = "reproject --quiet --filter bilinear --to equirect --size 4 ";
    const auto grey = [](const std::string &name, double value) {
        holds(name,
              [&] {
                  check_pixel("half.png", 1, 0, {value / 255, value / 255, value / 255});
              });
    };
    does(half + "stripes.ppm half.png");
    grey("as it is stored, a half is 128", 128);
    does(half + "--linear stripes.ppm half.png");
    grey("as light, it is 188", 188);
    does(half + "--gamma 2 stripes.ppm half.png");
    grey("with a gamma of 2, 180", 180);
    make_constant(64, 32, 3, "half", 0.5f, "light.exr");
    says("light is written as sRGB, and it is said", "light written as sRGB",
         "reproject --to equirect light.exr half.png");
    grey("half of the light is 188", 188);
    says("and the other way round", "sRGB written as light",
         "reproject --to equirect half.png again.exr");
    passes("they are the same", "compare --max 0.004 light.exr again.exr");
    says("unless --stored", "\\(equirect 64x32; [a-z0-9-]*\\)$",
         "reproject --stored --to equirect light.exr half.png");
    grey("then a half is 128", 128);
    make_constant(64, 32, 3, "float", -0.5f, "negative.exr");
    does("reproject --quiet --layout strip --filter bilinear negative.exr strip.exr");
    make_constant(96, 16, 3, "float", -0.5f, "wanted.exr");
    passes("less than nothing stays", "compare --max 0 strip.exr wanted.exr");
}

void one_nan()
{
    std::vector<float> pixels(std::size_t{32} * 16, 0.5f);
    pixels[std::size_t{8} * 32 + 16] = std::stof("nan");
    write_tiff("nan.tif", 32, 16, pixels);
    make_constant(32, 16, 1, "float", 0.5f, "half.tif");
    const std::string same = "reproject --from equirect --to equirect --filter bilinear --size 64 ";
    says("one NaN is skipped, and it is said", "1 value that is not finite skipped",
         same + "nan.tif out.tif");
    make_constant(64, 32, 1, "float", 0.5f, "wanted.tif");
    passes("its neighbours stand for it", "compare --max 1e-6 out.tif wanted.tif");
    says("or it is 0", "1 value that is not finite taken as 0",
         same + "--not-finite zero nan.tif out.tif");
    holds("in the middle", [] { check_pixel("out.tif", 32, 16, {0.5 * 7 / 16}); });
    says("or it spreads", "1 value that is not finite kept",
         same + "--not-finite spread nan.tif out.tif");
    fails("as far as the filter reaches", 1, "inf, above",
          "compare --quiet --max 1 out.tif wanted.tif");
    fails("or it is refused", 1, "has a NaN at x = 16, y = 8, channel Y; --not-finite skip",
          "reproject --not-finite refuse nan.tif made/a.tif");
}

// What OUTPUT cannot have is cut, and said.
void cut_values()
{
    std::vector<float> pixels(std::size_t{32} * 16, 0.5f);
    pixels[3] = -0.25f;
    pixels[40] = 7.0f;
    pixels[41] = 1.5f;
    pixels[42] = 1.0f;
    pixels[43] = -0.0f;
    write_tiff("light.tif", 32, 16, pixels);
    const std::string to = "reproject --filter nearest --to equirect ";
    says("above 1 and below 0", "; 1 value below 0 written as 0; 2 values above 1 written as 1\\)$",
         to + "light.tif out.png");
    says("floats have all", "\\(equirect 32x16; nearest\\)$", to + "light.tif out.tif");
    make_constant(32, 16, 3, "half", -2.0f, "less.exr");
    says("of halves", "; 1536 values below 0 written as 0\\)$", to + "less.exr out.hdr");
    make_constant(32, 16, 3, "half", 0, "wanted.exr");
    passes("which are 0 in HDR", "compare --max 0 out.hdr wanted.exr");
    make_constant(32, 16, 3, "half", 2.0f, "more.exr");
    says("HDR has more than 1", "\\(equirect 32x16; nearest\\)$", to + "more.exr out.hdr");
    says("PNG has not", "; 1536 values above 1 written as 1\\)$", to + "more.exr out.png");
}

void dithers()
{
    make_constant(64, 32, 1, "uint16", 0.5f + 0.3f / 255, "grey.tif");
    does("reproject --quiet --to equirect --dither grey.tif grey.jpg --compression 100");
    const Picture dithered("grey.jpg");
    double sum = 0;
    for (const float value : dithered.values)
    {
        sum += static_cast<double>(value) * 255;
    }
    const double mean = sum / static_cast<double>(dithered.values.size());
    result(mean > 127.6 && mean < 128.0, "dithered, the mean stays", std::to_string(mean));
    make_noise(64, 32, "noise.ppm");
    does("reproject --quiet --threads 1 --dither noise.ppm one.png --layout cross");
    does("reproject --quiet --threads 3 --dither noise.ppm three.png --layout cross");
    result(same_content("one.png", "three.png"), "the same noise from any number of threads");
    make_constant(64, 32, 3, "float", 0.5f, "floats.tif");
    fails("floats need no noise", 2, "'a.exr', holds floats; leave it out",
          "reproject --to equirect --dither floats.tif a.exr");
    fails("nor do maps of HEALPix", 2, "'a.fits', holds floats; leave it out",
          "reproject --to healpix:8 --dither noise.ppm a.fits");
}

void files_and_filters()
{
    make_noise(64, 32, "noise.ppm");
    does("reproject --quiet --compression lzw --layout strip noise.ppm strip.tif");
    const std::string text = describe_image("strip.tif");
    result(matches(text, "compression=lzw"), "compression of TIFF", text);
    does("reproject --quiet --compression 20 --layout strip noise.ppm low.jpg");
    does("reproject --quiet --compression 95 --layout strip noise.ppm high.jpg");
    result(std::filesystem::file_size("low.jpg") < std::filesystem::file_size("high.jpg") / 2,
           "quality of JPEG");
    const std::string earth = source_tree() + "/tests/programs/golden/earth-64.png";
    does("reproject --quiet --compression 0 --layout strip " + earth + " low.png");
    does("reproject --quiet --compression 9 --layout strip " + earth + " high.png");
    result(std::filesystem::file_size("low.png") > std::filesystem::file_size("high.png"),
           "effort of PNG");
    passes("pixels stay", "compare --max 0 low.png high.png");
    make_direction_image(equirect_shape, 512, "equirect.tif");
    struct Sharpness
    {
        const char *filter;
        double largest;
    };
    for (const Sharpness &each :
         {Sharpness{"catmull-rom", 1e-4}, Sharpness{"mitchell", 3e-4}, Sharpness{"lanczos3", 4e-4},
          Sharpness{"spline36", 1e-4}, Sharpness{"bspline5", 1e-5}, Sharpness{"ewa", 1e-3},
          Sharpness{"auto", 1e-3}})
    {
        const std::string filter = each.filter;
        says("filter " + filter, "; " + (filter == "auto" ? "[a-z0-9-]+" : filter) + "\\)$",
             "reproject --filter " + filter + " equirect.tif face_%f.tif");
        const Shape faces = {"coupled", "geo", "faces"};
        holds("and its values",
              [&] { check_direction_image(faces, "face_%f.tif", each.largest, each.largest); });
    }
    does("reproject --quiet --tolerance 0 equirect.tif exact_%f.tif --filter bilinear");
    does("reproject --quiet equirect.tif face_%f.tif --filter bilinear");
    passes("within the tolerance", "compare --max 1e-5 exact_4.tif face_4.tif");
    for (int face = 0; face < 6; ++face)
    {
        make_constant(16, 16, 3, face == 2 ? "uint16" : "uint8", 0.5f,
                      "mixed_" + std::to_string(face) + ".png");
    }
    says("faces of two types", "uint8 and uint16, taken as uint16",
         "reproject mixed_%f.png back.png");
    for (const std::string to : {"view:fov=90", "cube;layout=eac", "equirect", "healpix:16"})
    {
        passes(
            "lines over " + to + ", turned",
            "reproject --quiet --rotate 10,20,30 --graticule 30 --grid 2 --indicatrices 2 --to " +
                to + " noise.ppm lines.png");
    }
}

} // namespace

const std::vector<Subject> &reproject_pixel_subjects()
{
    static const std::vector<Subject> subjects = {{"exactness", exactness},
                                                  {"constants", constant_pictures},
                                                  {"formats", formats},
                                                  {"metadata", metadata},
                                                  {"depths", depths},
                                                  {"golden", golden},
                                                  {"unusual_colors", unusual_colors},
                                                  {"light", light},
                                                  {"one_nan", one_nan},
                                                  {"cut_values", cut_values},
                                                  {"dithers", dithers},
                                                  {"files_and_filters", files_and_filters}};
    return subjects;
}
