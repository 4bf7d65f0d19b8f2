// SPDX-License-Identifier: MIT
//
// What cubemap-orient finds, says and draws.

#include "image_cases.hpp"
#include "picture_checks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <sstream>

namespace
{

constexpr double pi = 3.14159265358979323846;

// A grey picture, 72 x 36, one value in a disc about row 18, column 45 (longitude 47.5, latitude -2.5).
void draw_mask(int inside, int outside, const std::string &name)
{
    std::string text = "P2 72 36 255\n";
    for (int row = 0; row < 36; ++row)
    {
        for (int column = 0; column < 72; ++column)
        {
            const int square = (row - 18) * (row - 18) + (column - 45) * (column - 45);
            text += std::to_string(square <= 6 ? inside : outside) + "\n";
        }
    }
    write_file(name, text);
}

void draw_masks()
{
    draw_mask(255, 0, "disc.pgm");
    draw_mask(0, 255, "dark.pgm");
    draw_mask(0, 0, "none.pgm");
    write_file("odd.pgm", "P2 5 2 255 0 0 0 0 0 1 1 1 1 1\n");
    write_file("text.png", "no image\n");
}

// Success, the expression on standard output, nothing on standard error.
void prints(const std::string &name, const std::string &expression, const std::string &line)
{
    const Ran ran = run(line);
    result(ran.status == 0 && ran.err.empty() && matches(ran.out, expression), name,
           "status " + std::to_string(ran.status) + ": " + ran.out + ran.err);
}

// The number behind a name in a text of JSON; NaN if there is none.
double number_of(const std::string &json, const std::string &name)
{
    const std::size_t at = json.find("\"" + name + "\": ");
    return at == std::string::npos ? NAN : std::atof(json.c_str() + at + name.size() + 4);
}

void talk()
{
    draw_masks();
    prints("help", "^Usage: cubemap-orient", "orient --help");
    prints("version", "^cubemap-orient [0-9]", "orient --version");
    prints("list", "^land-coupled coupled deformation 17\\.15 9\\.09 31\\.98 ", "orient --list");
    fails("no mask", 2, "one mask is needed, 0 are given", "orient");
    fails("two masks", 2, "one mask is needed, 2 are given", "orient a b");
    fails("unknown option", 2, "no option --best", "orient --best disc.pgm");
    fails("wrong mapping", 2, "no mapping is called 'cube'", "orient -m cube disc.pgm");
    fails("one face", 2, "has one face", "orient -m octahedral disc.pgm");
    fails("nearly a mapping", 2, "did you mean coupled\\?", "orient -m coupld disc.pgm");
    fails("nearly an orientation", 2, "did you mean land-coupled\\?",
          "orient --evaluate land-coupeld disc.pgm");
    fails("nearly a measure", 2, "did you mean edges\\?", "orient --measure edgse disc.pgm");
    fails("wrong measure", 2, "'size', not one of deformation", "orient --measure size disc.pgm");
    fails("wrong orientation", 2, "LAT must be in", "orient --evaluate 1,91 disc.pgm");
    fails("unknown orientation", 2, "no orientation is called 'sea'",
          "orient --evaluate sea disc.pgm");
    fails("wrong resolution", 2, "from 0.01 to 10", "orient --resolution 0.001 disc.pgm");
    fails("wrong threshold", 2, "from 0 to 1", "orient --threshold 2 disc.pgm");
    fails("image without picture", 2, "picture says where", "orient --image disc.pgm disc.pgm");
    fails("no such file", 1, "'missing.png'", "orient missing.png");
    fails("no image", 1, "'text.png'", "orient text.png");
    fails("wrong shape", 1, "twice as wide as high", "orient odd.pgm");
    fails("nothing counts", 1, "no pixel that counts", "orient none.pgm");
    fails("picture of no known format", 2, "out.xyz",
          "orient --evaluate 0,0 --picture out.xyz disc.pgm");
    result(!std::filesystem::exists("out.xyz") && !matches(names_in("."), "xyz"),
           "no part of a picture is left", names_in("."));
}

using Vector = std::array<double, 3>;

Vector direction(double lon, double lat)
{
    return {std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat)};
}

// In degrees, from the nearest of the axes of the turned cube, which are the middles of its faces.
double from_middle_of_face(const std::string &json, const Vector &point)
{
    const double lon = number_of(json, "lon") * pi / 180;
    const double lat = number_of(json, "lat") * pi / 180;
    const double roll = number_of(json, "roll") * pi / 180;
    const Vector front = direction(lon, lat);
    const Vector east = {-std::sin(lon), std::cos(lon), 0};
    const Vector north = {-std::sin(lat) * std::cos(lon), -std::sin(lat) * std::sin(lon),
                          std::cos(lat)};
    Vector right;
    Vector top;
    for (std::size_t i = 0; i < 3; ++i)
    {
        right[i] = std::cos(roll) * east[i] + std::sin(roll) * north[i];
        top[i] = std::cos(roll) * north[i] - std::sin(roll) * east[i];
    }
    double nearest = 0;
    for (const Vector &axis : {front, right, top})
    {
        const double cosine = axis[0] * point[0] + axis[1] * point[1] + axis[2] * point[2];
        nearest = std::fmax(nearest, std::fabs(cosine));
    }
    return std::acos(std::fmin(1, nearest)) * 180 / pi;
}

// The disc goes to the middle of a face, and how bright it is and which sign it has is no matter.
void discs()
{
    draw_masks();
    // asked is not how sure the result is
    const std::string coarse = "orient -q --boxes " + std::to_string(6000 / one_in(6)) + " ";
    prints("a disc", "^mean angular deformation: 22.*-> 0?\\.?[0-9.]+ degrees$",
           coarse + "disc.pgm");
    const std::string bright = does(coarse + "--json --threshold 0.5 disc.pgm").out;
    const std::string inverted = does(coarse + "--json --invert --threshold 0.5 dark.pgm").out;
    const std::string thread =
        does(coarse + "--json --invert --threshold 0.5 --threads 1 dark.pgm").out;
    result(!bright.empty() && bright == inverted, "inverted", bright + inverted);
    result(!bright.empty() && bright == thread, "one thread", bright + thread);
    const double away = from_middle_of_face(bright, direction(47.5 * pi / 180, -2.5 * pi / 180));
    result(away <= 0.5 && number_of(bright, "after") <= 3.0, "the disc is in the middle of a face",
           bright);
    // what --evaluate says is what the search says
    char value[100];
    std::snprintf(value, sizeof value, "%.9f,%.9f,%.9f", number_of(bright, "lon"),
                  number_of(bright, "lat"), number_of(bright, "roll"));
    const std::string again =
        does(std::string("orient --json --evaluate=") + value + " disc.pgm").out;
    result(std::fabs(number_of(bright, "after") - number_of(again, "value")) <= 1e-4, "evaluated",
           bright + again);
    prints("edges", "edges over the mask: 2[0-9.]+ -> 0 km", coarse + "--measure edges disc.pgm");
}

// Its size, and the same pixels again.
void pictures()
{
    draw_masks();
    const std::string turned = "orient --evaluate 10,20,30 --size 32 --picture ";
    does(turned + "one.png disc.pgm");
    does(turned + "two.png --threads 1 disc.pgm");
    passes("picture", "compare --max 0 --quiet one.png two.png");
    does("orient --evaluate 10,20,30 --size 96 --picture words.png disc.pgm");
    // the uppermost dot of the c of "coupled, as it is", and of "coupled, turned"; the bar of a face's width
    holds("a title", [] { check_pixel("words.png", 205, 14, {0, 0, 0}); });
    holds("the title below", [] { check_pixel("words.png", 205, 14 + 3 * 96 + 6, {0, 0, 0}); });
    holds("a blank beside the title", [] { check_pixel("words.png", 204, 11, {1, 1, 1}); });
    holds(
        "the scale",
        [] {
            check_pixel("words.png", 210, 2 * 96 + 3 * 6 + 2, {38.0 / 255, 38.0 / 255, 51.0 / 255});
        });
    const Ran ran =
        run(Words{"orient", "--evaluate", "0,0", "--size", "32", "--picture", "three.png",
                  "--image", source_tree() + "/data/earth-2048.jpg", "disc.pgm"});
    result(ran.status == 0 && std::filesystem::exists("three.png"), "picture of an image", ran.err);
}

struct Named
{
    std::string name;
    std::string mapping;
    std::string measure;
    std::array<double, 3> angles;
    double before;
    double after;
};

std::vector<Named> listed_orientations()
{
    std::istringstream lines(does("orient --list").out);
    std::vector<Named> all;
    Named named;
    while (lines >> named.name >> named.mapping >> named.measure >> named.angles[0] >>
           named.angles[1] >> named.angles[2] >> named.before >> named.after)
    {
        all.push_back(named);
    }
    return all;
}

double evaluated(const Named &named, const std::string &orientation)
{
    const Ran ran = run(Words{"orient", "--json", "-m", named.mapping, "--measure", named.measure,
                              "--evaluate=" + orientation, source_tree() + "/data/land-1440.png"});
    return ran.status == 0 ? number_of(ran.out, "value") : NAN;
}

// The measure without rotation and in the orientation is what the library's table says, and half a degree
// away from it, along each of its three angles both ways, it is more.
std::string wrong_with(const Named &named)
{
    std::string wrong;
    const auto add = [&](const std::string &orientation, double value)
    { wrong += named.name + ": " + std::to_string(value) + " at " + orientation + "\n"; };
    for (const auto &[orientation, stated] :
         {std::pair<std::string, double>("0,0", named.before),
          std::pair<std::string, double>(named.name, named.after)})
    {
        const double value = evaluated(named, orientation);
        if (!(std::fabs(value - stated) <= 2e-6 * stated))
        {
            add(orientation, value);
        }
    }
    for (int i = 0; i < 6; ++i)
    {
        std::array<double, 3> angles = named.angles;
        angles[static_cast<std::size_t>(i / 2)] += i % 2 == 0 ? 0.5 : -0.5;
        char moved[100];
        std::snprintf(moved, sizeof moved, "%.9g,%.9g,%.9g", angles[0], angles[1], angles[2]);
        const double value = evaluated(named, moved);
        if (!(value > named.after))
        {
            add(moved, value);
        }
    }
    return named.after < named.before ? wrong : wrong + "no gain\n";
}

void named_orientations()
{
    int found = 0;
    std::string wrong;
    for (const Named &named : listed_orientations())
    {
        const Words asked = {"land-coupled", "land-tangent", "land-slice", "land-edges"};
        if (std::find(asked.begin(), asked.end(), named.name) != asked.end() &&
            found++ % one_in(4) == 0)
        {
            wrong += wrong_with(named);
        }
    }
    result(found == 4 && wrong.empty(), "named orientations", wrong);

    // 400 000 samples of each edge, by the pixel that each is in, say 9533.8 km; what has a name is no worse.
    const Named cut{"land-edges", "coupled", "edges", {}, 0, 0};
    const double sampled = evaluated(cut, "23.5813,-1.4300,33.3322");
    result(std::fabs(sampled - 9533.8) < 0.1, "edges by pixels", std::to_string(sampled));
    const double named = evaluated(cut, cut.name);
    result(named <= 9533.8, "land-edges is the least known", std::to_string(named));
}

} // namespace

const std::vector<Subject> &orient_subjects()
{
    static const std::vector<Subject> subjects = {{"orient_talk", talk},
                                                  {"discs", discs},
                                                  {"orient_pictures", pictures},
                                                  {"named_orientations", named_orientations}};
    return subjects;
}
