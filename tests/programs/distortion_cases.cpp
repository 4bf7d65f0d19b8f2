// SPDX-License-Identifier: MIT
//
// What cubemap-distortion draws, and the lines of cubemap-reproject.

#include "direction_image.hpp"
#include "image_cases.hpp"
#include "picture_checks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

namespace
{

const Words all_quantities = {"area",  "isotropy",     "deformation",
                              "scale", "texel-aspect", "texel-area"};

// ---- values

void closed_forms()
{
    for (const std::string &quantity : all_quantities)
    {
        passes("gnomonic, " + quantity, "distortion --quiet -m gnomonic --quantity " + quantity +
                                            " --values --face 2 --size 65 values.tif");
        holds("gnomonic, " + quantity + ", closed form",
              [&] { check_gnomonic(quantity, "values.tif"); });
    }
    does("distortion --quiet -m gnomonic --quantity isotropy --values --face 0 --size 2000 "
         "values.exr");
    holds("the corner of gnomonic: root 3", [] { check_pixel("values.exr", 1999, 0, {1.7316}); });
    for (const std::string quantity : {"area", "scale"})
    {
        does("distortion --quiet -m qsc --quantity " + quantity +
             " --values --face 4 --size 64 qsc.tif");
    }
    holds("the scale of an equal-area map: 6/pi",
          [] { check_pixel("qsc.tif", 3, 60, {1.909859}); });
}

void differences_of(const std::string &mapping, const std::string &frame)
{
    // the others follow from these
    for (const std::string quantity : {"area", "isotropy", "texel-aspect", "texel-area"})
    {
        does("distortion --quiet -m " + mapping + " --frame " + frame + " --quantity " + quantity +
             " --values --layout strip --size 16 " + mapping + "-" + quantity + ".tif");
    }
    holds(mapping + ", " + frame + ": as the library's directions have it",
          [&] { check_differences(mapping, frame, mapping + "-QUANTITY.tif"); });
}

void differences()
{
    const Words mappings = catalogue_names(false);
    const Words own = {"arvo", "conformal", "healpix"};
    const std::array<const char *, 4> frames = {"geo", "gl", "fits", "s2"};
    std::size_t turn = 0;
    for (std::size_t i = 0; i < mappings.size(); ++i)
    {
        if (i % 3 == 1 || std::find(own.begin(), own.end(), mappings[i]) != own.end())
        {
            differences_of(mappings[i], frames[turn++ % 4]);
        }
    }
}

// ---- colours

void colors()
{
    const std::string gnomonic = "distortion --quiet -m gnomonic --face 0 --size 40 ";
    const std::string own = "sequential-single:hue=140";
    does(gnomonic + "--values area.tif");
    does(gnomonic + "area.png");
    holds("area: a quarter and four are equally far from one",
          [] {
              check_colors({"diverging-lightness", 0.25, 4, 1}, "area.tif", "area.png");
          });
    does(gnomonic + "--range 0.8:2 --colors diverging-saturation range.png");
    holds("a range that is not symmetric keeps its middle",
          [] {
              check_colors({"diverging-saturation", 0.8, 2, 1}, "area.tif", "range.png");
          });
    does(gnomonic + "--quantity isotropy --values isotropy.tif");
    does(gnomonic + "--quantity isotropy isotropy.png");
    holds("isotropy: light at one",
          [] {
              check_colors({"sequential-custom", 1, 2, 0}, "isotropy.tif", "isotropy.png");
          });
    does(gnomonic + "--quantity isotropy --range 1.1:1.5 --reverse --colors " + own +
         " reverse.png");
    holds("reversed, with a map and a range of one's own",
          [&] {
              check_colors({own, 1.1, 1.5, 0, true}, "isotropy.tif", "reverse.png");
          });
    const std::string qsc =
        "distortion --quiet -m qsc --face 3 --size 40 --colors diverging-saturation ";
    const std::array<double, 3> middle = color_of_map("diverging-saturation", 0.5);
    does(qsc + "qsc.png");
    holds("an equal-area map has one colour", [&] { check_uniform("qsc.png", middle); });
    does(qsc + "--isolines 0.5 qsc.png");
    holds("and no isolines", [&] { check_uniform("qsc.png", middle); });
    does("distortion --quiet -m gnomonic --face 0 --size 501 --isolines 0.25 --line-width 4 "
         "--line-color ff0000 isolines.png");
    holds("isolines where they should be", [] { check_isolines("isolines.png", 0.25); });
    for (const std::string mapping : {"tangent", "qsc"})
    {
        does("distortion --quiet -m " + mapping +
             " --quantity deformation --face 0 --size 61 --isolines 5 --grid 4 symmetric.png");
        holds("symmetric, " + mapping, [] { check_symmetric("symmetric.png", 1); });
    }
    does("distortion --quiet -m outerra --indicatrices 5 --face 0 --size 200 symmetric.png");
    holds("symmetric ellipses", [] { check_symmetric("symmetric.png", 1); });
}

// ---- what it says

void reports()
{
    // (1 + r^2)^1.5 < 6/pi up to r = 0.7344: pi r^2 / 4 of the face
    const std::string said = does("distortion -m gnomonic --range 1:4 --size 500 area.png").out;
    result(matches(said, "42\\.4 % of the map is below 1 and has its colour") &&
               matches(said, "area \\(D_A\\): 0\\.5236[0-9]* to 2\\.7[0-9]* at"),
           "says what is beyond the colours, and the extremes", said);
    const std::string other = does("distortion -m qsc --size 8 area.png").out;
    result(std::count(said.begin(), said.end(), '\n') == 1 && !other.empty() &&
               !matches(other, "of the map"),
           "and nothing where nothing is", other);
    says("says which colours are cut", "% are outside sRGB and cut to it",
         "distortion -m tangent --size 8 --colors sequential-single:saturation=5 area.png");
    // over the means of a disc and of a square: (1 + r^2)^2 / 2, and 1
    says("areas of a disc, over their mean",
         "^azimuthal:stereographic, area \\(D_A\\): 0\\.5000[0-9]* to 1\\.99[0-9]* at "
         ".*\\(200x200\\)$",
         "distortion -m azimuthal:stereographic --size 200 disc.png");
    says("areas of a square", "^octahedral:clarberg, area \\(D_A\\): 1 to 1 at",
         "distortion -m octahedral:clarberg --size 100 square.png");
    says("the scale of a disc",
         "scale \\(s\\): 0\\.5 to 0\\.5 at .*0\\.125 to 2, logarithmic about 0\\.5 ",
         "distortion -m azimuthal:lambert --quantity scale --size 50 disc.png");
    says("texels of a square", "texel-area \\(L_x L_y\\): 0\\.00[0-9]* to 2\\.18[0-9]* at",
         "distortion -m peirce --quantity texel-area --size 64 square.png");
    says("help", "^Usage: cubemap-distortion", "distortion --help");
    says("version", "^cubemap-distortion [0-9]+\\.[0-9]+\\.[0-9]+$", "distortion --version");
    const std::string quiet = does("distortion --quiet --size 8 area.png").out;
    result(quiet.empty(), "quiet", quiet);
}

void files_and_metadata()
{
    for (const std::string extension : {"png", "jpg", "tif"})
    {
        does("distortion --quiet -m gnomonic --range 1:4 --size 32 area." + extension);
        const std::string description = describe_image("area." + extension);
        result(matches(description,
                       "ImageDescription=gnomonic, frame geo, area \\(D_A\\): 0\\.5.*, "
                       "1 to 4, .*is below 1") &&
                   matches(description, "uint8"),
               "metadata, " + extension, description);
    }
    does("distortion --quiet --values --size 32 area.exr");
    const std::string description = describe_image("area.exr");
    result(matches(description, "ImageDescription=coupled, frame geo, area") &&
               matches(description, "^128 x 96, 1 channels, float"),
           "metadata of values", description);
    const Ran ran = passes("faces", "distortion --layout faces --size 8 f%f.png");
    result(std::filesystem::exists("f0.png") && std::filesystem::exists("f5.png") &&
               matches(ran.out, "f0\\.png \\.\\. f5\\.png \\(8x8\\)"),
           "are six files", ran.out);
    passes("a legend", "distortion --size 8 --legend legend.png area.png");
    const std::string legend = describe_image("legend.png");
    result(matches(legend, "^520 x 84, 3 channels"), "has its size", legend);
    does(
        "distortion --quiet --size 8 --range 1:4 --colors diverging-saturation --legend legend.tif "
        "area.png");
    std::vector<double> end;
    for (const double value : color_of_map("diverging-saturation", 0.50056))
    {
        end.push_back(std::round(255 * value) / 255); // as 8 bits hold it
    }
    // the uppermost dots of the a of "area D_A, a ratio"
    holds("the legend's title", [] { check_pixel("legend.tif", 38, 10, {0, 0, 0}); });
    holds("the left end of the strip", [&] { check_pixel("legend.tif", 36, 37, end); });
    const std::string lines = "distortion --quiet --size 100 --isolines 0.1 --graticule 15 ";
    does(lines + "--threads 1 one.png");
    for (const std::string threads : {"2", "7"})
    {
        does(lines + "--threads " + threads + " many.png");
        result(same_content("one.png", "many.png"),
               "the same bits from 1 and " + threads + " threads");
    }
}

void distortion_sizes()
{
    for (const int size : {1, 2, 3, 4097})
    {
        const std::string number = std::to_string(size / (size > 3 ? one_in(16) : 1));
        passes(number + " pixels", "distortion --face 1 --size " + number +
                                       " --isolines 0.1 --grid 2 --graticule 30 --indicatrices 3 "
                                       "face.tif");
        const std::string description = describe_image("face.tif");
        result(matches(description, "^" + number + " x " + number + ", 3 channels"),
               "are " + number + " pixels", description);
    }
    passes(
        "smoothstep with its singular edge",
        "distortion -m smoothstep:c=1 --quantity isotropy --isolines 1 --grid 3 --indicatrices 3 "
        "--size 65 face.tif");
    holds("no NaN", [] { check_finite("face.tif"); });
}

// ---- ellipses

// Lines 2 wide on black, in one channel.
void on_black(const std::string &arguments)
{
    does("reproject --quiet --line-width 2 " + arguments);
}

void ellipses()
{
    make_constant(720, 360, 1, "float", 0, "black.tif");
    const std::string nine = "--indicatrices 3 --indicatrices-radius 9 ";
    on_black("--to cube:gnomonic --size 600 " + nine + "black.tif face.tif");
    holds("gnomonic: area, axes and directions of ellipses",
          [] { check_gnomonic_ellipses("face_0.tif", 3, 9); });
    holds("gnomonic: the same around the pole",
          [] { check_gnomonic_ellipses("face_4.tif", 3, 9); });
    on_black("--to cube:gnomonic --frame gl --size 600 " + nine + "black.tif face.tif");
    holds("gnomonic: the same in frame gl", [] { check_gnomonic_ellipses("face_2.tif", 3, 9); });
    on_black("--to cube:outerra --size 700 --indicatrices 5 black.tif face.tif");
    holds("outerra: a circle in the middle", [] { check_circle("face_1.tif", 5); });
    does("reproject --quiet --from equirect --to cube:gnomonic --size 90 black.tif flat.tif");
    on_black("--from cube:gnomonic --to equirect --size 1440 " + nine + "flat_%f.tif back.tif");
    holds("equirectangular: ellipses, and over the antimeridian",
          [] { check_equirect_ellipses("back.tif", 9); });
    const std::string said = does("reproject --from equirect --to equirect --size 800 "
                                  "--indicatrices 3 black.tif out.tif")
                                 .out;
    result(matches(said, "ellipses of circles of [0-9.]* degrees, 2 at poles left out"),
           "says the radius, and what is left out", said);
}

void counted_ellipses()
{
    make_constant(720, 360, 1, "float", 0, "black.tif");
    for (const int cells : {1, 2, 3, 4, 5, 7})
    {
        const std::string number = std::to_string(cells);
        const std::string thin = " --indicatrices " + number + " --line-width 0.1 black.tif ";
        const int all = 6 * cells * cells;
        const int left = all - cells % 2 * 2;
        does("reproject --quiet --from equirect --to equirect --size 800" + thin + "count.tif");
        holds("equirectangular: " + std::to_string(left) + " ellipses apart",
              [&] { check_count("count.tif", left); });
        does("reproject --quiet --from equirect --to cube:continuous --layout strip --size 100" +
             thin + "count.tif");
        holds("cube: " + std::to_string(all) + " ellipses apart",
              [&] { check_count("count.tif", all); });
    }
}

// ---- lines

void lines()
{
    make_constant(720, 360, 1, "float", 0.5f, "grey.tif");
    make_constant(720, 360, 1, "float", 0, "black.tif");
    on_black("--from equirect --to equirect --graticule 30 grey.tif graticule.tif");
    holds("equirectangular graticule, pixel by pixel",
          [] { check_equirect_graticule("graticule.tif", "grey.tif"); });
    on_black("--to cube:gnomonic --layout cross --size 400 --graticule 15 black.tif cross.tif");
    holds("graticule on a cube, its edges and poles", [] { check_cube_graticule("cross.tif"); });
    on_black("--to cube:gnomonic --size 401 --graticule 15 black.tif odd.tif");
    holds("a pixel on the pole", [] { check_pixel("odd_4.tif", 200, 200, {1}); });
    holds("and on the other", [] { check_pixel("odd_5.tif", 200, 200, {1}); });
    does("reproject --quiet --to cube:gnomonic --size 60 black.tif flat.tif");
    on_black("--from cube:gnomonic --to equirect --size 720 --grid 3 flat_%f.tif grid.tif");
    holds("grid of a cube over an equirectangular image", [] { check_equirect_grid("grid.tif"); });
    int turn = 0;
    for (const std::string mapping : {"gnomonic", "qsc", "cobe", "healpix"})
    {
        if (turn++ % one_in(2) != 0)
        {
            continue;
        }
        on_black("--to cube:" + mapping + " --size 240 --grid 6 black.tif grid.tif");
        holds("grid of " + mapping, [] { check_cube_grid("grid_1.tif", 6); });
        holds("grid of " + mapping + ", top", [] { check_cube_grid("grid_4.tif", 6); });
    }
}

struct WantedPixel
{
    const char *name;
    const char *file;
    int x;
    int y;
    std::vector<double> values;
};

void pixel_types()
{
    make_constant(64, 32, 4, "uint8", 0.2f, "alpha.png", {"oiio:UnassociatedAlpha=1"});
    make_constant(64, 32, 4, "half", 0.2f, "alpha.exr");
    make_constant(64, 32, 5, "float", 0.2f, "five.tif");
    make_constant(64, 32, 3, "uint16", 0.2f, "sixteen.png");
    make_constant(64, 32, 3, "half", std::stof("inf"), "inf.exr");
    make_constant(64, 32, 1, "float", 0.2f, "one.tif");
    const std::string meridians =
        "reproject --quiet --from equirect --to equirect --graticule 90 --line-width 2 ";
    does(meridians + "--line-color ff8000 alpha.png out.png");
    does(meridians + "--line-color ff8000 alpha.exr out.exr");
    does(meridians + "--line-color ff8000 five.tif out.tif");
    does(meridians + "sixteen.png sixteen-out.png");
    does(meridians + "--filter nearest inf.exr inf-out.exr");
    does(meridians + "--line-color ff0000 one.tif one-out.tif");
    const std::vector<WantedPixel> wanted = {
        {"alpha, not multiplied: the line is opaque", "out.png", 16, 8, {1, 0.50196, 0, 1}},
        {"alpha, multiplied: the line is opaque", "out.exr", 16, 8, {1, 0.50196, 0, 1}},
        {"alpha: the rest as it was", "out.exr", 8, 8, {0.2, 0.2, 0.2, 0.2}},
        {"five channels, one of them alpha: the fifth stays as it is",
         "out.tif",
         16,
         8,
         {1, 0.50196, 0, 1, 0.2}},
        {"16 bits", "sixteen-out.png", 16, 8, {1, 1, 1}},
        {"one channel: luminance", "one-out.tif", 16, 8, {0.2126}},
        // 0.6 black over alpha 0.2: alpha 0.68, and colour 0.2 * 0.08 / 0.68
        {"casing over alpha, not multiplied", "out.png", 17, 8, {0.0235, 0.0235, 0.0235, 0.6784}},
        {"casing over alpha, multiplied", "out.exr", 17, 8, {0.08, 0.08, 0.08, 0.68}}};
    for (const WantedPixel &pixel : wanted)
    {
        holds(pixel.name, [&] { check_pixel(pixel.file, pixel.x, pixel.y, pixel.values); });
    }
    holds("infinities: no NaN beside lines", [] { check_finite("inf-out.exr"); });
}

// ---- what is wrong

struct Wrong
{
    const char *name;
    const char *words;
    const char *arguments;
};

constexpr Wrong wrong_usage[] = {
    {"no name", "OUTPUT is needed", ""},
    {"two names", "OUTPUT is needed, 2", "made/a.png made/b.png"},
    {"unknown option", "no option --sise; did you mean --size", "--sise 5 made/a.png"},
    {"missing value", "--size needs an argument", "made/a.png --size"},
    {"value too many", "--values takes no argument", "--values=1 made/a.tif"},
    {"layout of one face", "--layout is for the six faces", "-m peirce --layout cross made/a.png"},
    {"frame of one face", "--frame is for the six faces", "-m peirce --frame gl made/a.png"},
    {"face 1 of one", "--face is for the six faces", "-m peirce --face 1 made/a.png"},
    {"no sphere", "joins disc and square", "-m square:radial made/a.png"},
    {"unknown mapping", "--mapping: .*nonesuch", "-m nonesuch made/a.png"},
    {"parameter out of range", "--mapping: ", "--mapping tangent:c=5 made/a.png"},
    {"unknown frame", "geo, gl, fits, s2", "--frame east made/a.png"},
    {"unknown quantity", "area, isotropy, .*, texel-area", "--quantity shape made/a.png"},
    {"unknown layout", "faces, strip or cross", "--layout row made/a.png"},
    {"face that is none", "--face is .* 0 to 5", "--face 6 made/a.png"},
    {"face and layout", "--face is for", "--face 1 --layout cross made/a.png"},
    {"range from 0 on a logarithmic scale", "LOW must be above 0", "--range 0:2 made/a.png"},
    {"unknown colours", "--colors: 'nonesuch'", "--colors nonesuch made/a.png"},
    {"colours out of range", "--colors: ", "--colors sequential-single:hue=999 made/a.png"},
    {"values in PNG", "ends in .tif or .exr", "--values made/a.png"},
    {"colours in EXR", "ends in .png, .jpg or .tif", "made/a.exr"},
    {"nearly a mapping", "did you mean gnomonic\\?", "-m gnomnic made/a.png"},
    {"nearly a quantity", "did you mean isotropy\\?", "--quantity istropy made/a.png"},
    {"nearly a colour map", "did you mean diverging-lightness\\?",
     "--colors diverging-lightnes made/a.png"},
    {"no extension", "must end in", "made/a"},
    {"values and colours", "--values writes numbers", "--values --colors rainbow made/a.tif"},
    {"values and lines", "--values writes numbers", "--values --grid 2 made/a.tif"},
    {"values and a legend", "--values writes numbers", "--values --legend made/l.png made/a.tif"},
    {"six names for one picture", "%f", "made/%f.png"},
    {"legend is the output", "same file", "--legend made/a.png made/a.png"},
    {"legend of the wrong kind", "ends in .png", "--legend made/l.exr made/a.png"},
};

void bad_values(const std::string &option, const std::string &words, const Words &values)
{
    for (const std::string &value : values)
    {
        fails(option + " '" + value + "'", 2, "--" + option + " is '" + words,
              Words{"distortion", "--" + option, value, "made/a.png"});
    }
}

// The options of lines, which two programs have.
void bad_lines(const Words &program)
{
    const auto wrong = [&](const std::string &name, const std::string &words, const Words &options)
    {
        Words all = program;
        all.insert(all.end(), options.begin(), options.end());
        all.emplace_back("made/a.png");
        fails(name + ", " + program.front(), 2, words, all);
    };
    for (const std::string value : {"0", "-1", "7", "181", "x", "", "nan", "0.001"})
    {
        wrong("graticule '" + value + "'", "--graticule is '", {"--graticule", value});
    }
    wrong("grid 0", "--grid is .* from 1 to", {"--grid", "0"});
    wrong("indicatrices 0", "--indicatrices is ", {"--indicatrices", "0"});
    wrong("a radius alone", "say --indicatrices N", {"--indicatrices-radius", "3"});
    wrong("a radius too large", "overlap; with 5 x 5 a face, [0-9.]* at most",
          {"--indicatrices", "5", "--indicatrices-radius", "12"});
    wrong("a line's look alone", "there are none", {"--line-width", "2"});
    wrong("line width", "--line-width is .* from 0.1 to 100", {"--grid", "2", "--line-width", "0"});
    for (const std::string value : {"red", "fff", "#ffffff", "gggggg", "1234567", ""})
    {
        wrong("line colour '" + value + "'", "--line-color is .* RRGGBB",
              {"--grid", "2", "--line-color", value});
    }
}

void bad_arguments()
{
    for (const Wrong &wrong : wrong_usage)
    {
        fails(wrong.name, 2, wrong.words, std::string("distortion ") + wrong.arguments);
    }
    bad_values("size", ".*', not a whole number from 1 to 65536", {"0", "-1", "65537", "1e3", ""});
    bad_values(
        "range", ".*', not LOW:HIGH",
        {"", "1", "1:", ":1", "2:1", "1:1", "nan:2", "1:inf", "-1:2", "1:2:3", "0x1:2", "a:b"});
    bad_values("isolines", ".*', not a number of 1e-06 or more",
               {"0", "-1", "x", "", "nan", "1e-7"});
    make_constant(64, 32, 3, "uint8", 0.5f, "grey.png");
    bad_lines({"distortion"});
    bad_lines({"reproject", "grey.png"});
}

void bad_output()
{
    fails("no such folder", 1, "'nowhere.*No such file", "distortion nowhere/a.png");
    fails("no such folder for the legend", 1, "'nowhere.*No such file",
          "distortion --legend nowhere/l.png made/a.png");
    std::filesystem::create_directory("folder.png");
    fails("output is a folder", 1, "is a folder", "distortion folder.png");
    for (const std::string extension : {"png", "jpg", "tif", "exr"})
    {
        const SizeLimit limit(4 * 1024);
        fails("limit on the size of files, " + extension, 1, "File too large",
              std::string("distortion --size 400 ") + (extension == "exr" ? "--values " : "") +
                  "made/a." + extension);
    }
    std::filesystem::create_directory("kept");
    write_file("kept/a.png", "old\n");
    {
        const SizeLimit limit(4 * 1024);
        run("distortion --size 400 --legend kept/l.png kept/a.png");
    }
    result(content_of("kept/a.png") == "old\n" && names_in("kept") == "a.png ",
           "an older file is kept when the new one fails", names_in("kept"));
    std::filesystem::create_directories("six/f5.png");
    const Ran ran = run("distortion --layout faces --size 8 six/f%f.png");
    result(ran.status == 1 && names_in("six") == "f5.png ", "six files or none",
           ran.err + names_in("six"));
}

} // namespace

const std::vector<Subject> &distortion_subjects()
{
    static const std::vector<Subject> subjects = {{"closed_forms", closed_forms},
                                                  {"differences", differences},
                                                  {"colors", colors},
                                                  {"reports", reports},
                                                  {"files_and_metadata", files_and_metadata},
                                                  {"sizes", distortion_sizes},
                                                  {"ellipses", ellipses},
                                                  {"counted_ellipses", counted_ellipses},
                                                  {"lines", lines},
                                                  {"pixel_types", pixel_types},
                                                  {"distortion_arguments", bad_arguments},
                                                  {"distortion_output", bad_output}};
    return subjects;
}
