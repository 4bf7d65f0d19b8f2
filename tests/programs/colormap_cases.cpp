// SPDX-License-Identifier: MIT
//
// What cubemap-colormap writes. What needs a reader of JSON, of Python or of CIELUV is asked by
// colormap_checks.py, in one go.

#include "image_cases.hpp"
#include "picture.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <sstream>

#include <sys/wait.h>

namespace
{

const Words models = {
    "sequential-single",   "sequential-rainbow",   "sequential-custom", "sequential-saturation",
    "diverging-lightness", "diverging-saturation", "qualitative"};

const Words uniform_models = {"uniform-purple-yellow", "uniform-red-yellow", "uniform-blue",
                              "uniform-green",         "uniform-blue-red",   "uniform-purple-green",
                              "uniform-cyclic"};

std::string seen(const Ran &ran)
{
    return "status " + std::to_string(ran.status) + ": " + ran.err;
}

// Exits with 0, and standard error is one line that matches, or none if the expression is empty.
Ran warns(const std::string &name, const std::string &expression, const std::string &line)
{
    const Ran ran = run("colormap " + line);
    const bool good = expression.empty() ? ran.err.empty()
                                         : std::count(ran.err.begin(), ran.err.end(), '\n') == 1 &&
                                               matches(ran.err, expression);
    result(ran.status == 0 && good, name, seen(ran));
    return ran;
}

std::string output_of(const std::string &line)
{
    return does("colormap " + line).out;
}

Words lines_of(const std::string &text)
{
    Words lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);)
    {
        lines.push_back(line);
    }
    return lines;
}

void colormap_talk()
{
    result(matches(output_of("--help"), "^Usage: cubemap-colormap"), "help");
    result(matches(output_of("--version"), "^cubemap-colormap [0-9]+\\.[0-9]+\\.[0-9]+$"),
           "version");
    const std::string list = output_of("--list");
    const Words lines = lines_of(list);
    const auto is_listed = [&](const std::string &model)
    { return matches(list, "^" + model + " "); };
    const bool all = std::all_of(models.begin(), models.end(), is_listed) &&
                     std::all_of(uniform_models.begin(), uniform_models.end(), is_listed);
    result(all && std::count_if(lines.begin(), lines.end(),
                                [](const std::string &line)
                                { return matches(line, "^    source "); }) == 14,
           "the list has all maps", list);
}

// ---- text

// Do rows of numbers agree, and what is behind them to the letter?
bool rows_agree(const std::string &one, const std::string &other)
{
    double a[4];
    double b[4];
    int behind_a = 0;
    int behind_b = 0;
    const char *const format = "%lf,%lf,%lf,%lf%n";
    if (std::sscanf(one.c_str(), format, a, a + 1, a + 2, a + 3, &behind_a) != 4 ||
        std::sscanf(other.c_str(), format, b, b + 1, b + 2, b + 3, &behind_b) != 4)
    {
        return one == other;
    }
    return std::equal(a, a + 4, b, [](double x, double y) { return std::fabs(x - y) < 1e-11; }) &&
           one.substr(static_cast<std::size_t>(behind_a)) ==
               other.substr(static_cast<std::size_t>(behind_b));
}

void text()
{
    Ran ran =
        warns("csv by default", "",
              "single:hue=0,lightness-range=0.75,saturation-range=1,saturation=0 --samples 2");
    const Words wanted = {"t,red,green,blue,hex,lightness,chroma,hue,inside",
                          "0,0.232514527791,0.232514527791,0.232514527791,#3b3b3b,25,0,0,1",
                          "1,0.723900017328,0.723900017328,0.723900017328,#b9b9b9,75,0,0,1"};
    const Words got = lines_of(ran.out);
    result(got.size() == wanted.size() &&
               std::equal(wanted.begin(), wanted.end(), got.begin(), rows_agree),
           "csv has t, colours and LCH", ran.out);
    const std::string diverging = output_of("diverging --samples 257 --format csv");
    result(matches(diverging, "^0\\.5,([^,]*),\\1,\\1,"),
           "the middle of a diverging map is a colour of 257, and grey");
    Words forward = lines_of(output_of("rainbow --samples 7"));
    Words reversed = lines_of(output_of("rainbow --samples 7 --reverse"));
    std::reverse(forward.begin() + 1, forward.end());
    const auto same_colors = [](const std::string &one, const std::string &other)
    { return one == other; };
    result(forward.size() == 8 && std::equal(forward.begin(), forward.end(), reversed.begin(),
                                             reversed.end(), same_colors),
           "reverse");
    const std::string custom = output_of("Custom:HUES=10/20 --samples 3");
    result(!custom.empty() && custom == output_of("custom:hues=10@0/20@1 --samples 3"),
           "upper and lower case, places of stops", custom);
    const std::string palette = output_of("qualitative --samples 3 --format gimp --name three");
    const Words entries = lines_of(palette);
    result(palette.compare(0, 36, "GIMP Palette\nName: three\nColumns: 0\n") == 0 &&
               std::count_if(entries.begin(), entries.end(),
                             [](const std::string &line) {
                                 return matches(line, "^ *[0-9]+ +[0-9]+ +[0-9]+\t#[0-9a-f]{6}$");
                             }) == 3,
           "a palette", palette);
}

void names_of_files()
{
    for (const std::string suffix : {"json", "csv", "py", "gpl"})
    {
        output_of("rainbow -o file." + suffix);
    }
    result(content_of("file.json").compare(0, 1, "{") == 0 &&
               content_of("file.csv").compare(0, 2, "t,") == 0 &&
               matches(content_of("file.py"), "^NAME = \"cubemap-sequential-rainbow\"$") &&
               content_of("file.gpl").compare(0, 13, "GIMP Palette\n") == 0,
           "the name says the format");
    output_of("rainbow --format csv -o plain");
    result(same_content("plain", "file.csv"), "the format says it");
}

// ---- pictures

// The bytes of a pixel, as "#rrggbb".
std::string hex_of(const Picture &picture, int x, int y)
{
    char name[8];
    const float *const pixel = picture.at(x, y);
    const auto byte = [pixel](int c)
    { return static_cast<int>(std::lround(255 * pixel[c])) & 255; };
    std::snprintf(name, sizeof name, "#%02x%02x%02x", byte(0), byte(1), byte(2));
    return name;
}

// The colours in a table of comma-separated values.
Words hex_colors(const std::string &table)
{
    Words colors;
    for (const std::string &line : lines_of(table))
    {
        const std::size_t at = line.find('#');
        if (at != std::string::npos)
        {
            colors.push_back(line.substr(at, 7));
        }
    }
    return colors;
}

// How much a row goes up and down: the sum of the second differences of red.
double swing(const Picture &picture, int y)
{
    double sum = 0;
    for (int x = 1; x + 1 < picture.width; ++x)
    {
        sum +=
            std::fabs(picture.first(x - 1, y) - 2 * picture.first(x, y) + picture.first(x + 1, y));
    }
    return sum;
}

void test_patterns()
{
    const std::string options = "single:saturation=0 --test-pattern --size 160x20 ";
    output_of(options + "-o pattern.png");
    output_of(options + "--reverse -o mirrored.png");
    const Picture pattern("pattern.png");
    const Picture mirrored("mirrored.png");
    bool good = pattern.width == 160 && pattern.height == 20 &&
                swing(pattern, 0) > 5 * swing(pattern, 19) &&
                swing(pattern, 0) > swing(pattern, 6) && swing(pattern, 6) > swing(pattern, 12) &&
                swing(pattern, 12) > swing(pattern, 19);
    for (int x = 0; good && x < 160; ++x)
    {
        good = (x == 159 || pattern.first(x, 19) <= pattern.first(x + 1, 19)) &&
               hex_of(pattern, x, 19) == hex_of(mirrored, 159 - x, 19);
    }
    result(good, "the test pattern fades from top to bottom");
}

void colormap_pictures()
{
    output_of("qualitative --samples 5 --size 50x4 -o bands.png");
    Words colors = hex_colors(output_of("qualitative --samples 5"));
    const Picture bands("bands.png");
    bool good = bands.width == 50 && bands.height == 4 && colors.size() == 5;
    for (int i = 0; good && i < 200; ++i)
    {
        good = hex_of(bands, i % 50, i / 50) == colors[static_cast<std::size_t>(i % 50 / 10)];
    }
    result(good, "a picture of bands");
    output_of("rainbow -o strip.png");
    colors = hex_colors(output_of("rainbow --samples 512"));
    const Picture strip("strip.png");
    good = strip.width == 512 && strip.height == 64 && colors.size() == 512;
    for (int i = 0; good && i < 512 * 64; ++i)
    {
        good = hex_of(strip, i % 512, i / 512) == colors[static_cast<std::size_t>(i % 512)];
    }
    result(good, "a picture of the whole map");
    test_patterns();
}

// ---- the gamut

void gamut()
{
    const std::string too_much = "single:saturation=4 ";
    Ran ran = warns("a warning when colours are cut",
                    "warning: [0-9]+ of 256 colours are outside sRGB, the first at t = 0\\.[0-9]+; "
                    "--fit mends that, or saturation=2\\.20",
                    too_much);
    result(matches(ran.out, ",0$"), "the table says which");
    fails("strict refuses them", 1, "colours are outside sRGB",
          "colormap " + too_much + "--strict -o made/a.json");
    fails("strict refuses the test pattern", 1, "colours of the map are outside sRGB",
          "colormap " + too_much + "--strict --test-pattern -o made/a.png");
    warns("strict takes what is inside", "", "single --strict");
    ran = warns("fit says to what", "fitted into sRGB: saturation from 4 to 2\\.20[0-9]+$",
                too_much + "--fit --strict");
    result(!ran.out.empty() && !matches(ran.out, ",0$"), "fitted colours are inside");
    ran = warns("fit changes nothing that fits", "inside sRGB as it is", "single --fit");
    result(!ran.out.empty() && ran.out == output_of("single"), "and the map is the same");
    const std::string pale = "single:lightness-range=1,saturation-range=0.6,saturation=1 ";
    warns("fit of pale ends", "saturation-range from 0\\.6 to 1", pale + "--fit --strict");
    warns("advice for pale ends", "or a larger saturation-range; they are cut", pale);
}

// ---- what readers of other kinds find

// A line of the script: "ok NAME" or "not ok NAME: WHAT".
void take_result(const std::string &line)
{
    const bool good = line.compare(0, 3, "ok ") == 0;
    const std::size_t colon = line.find(": not true: ");
    const std::size_t start = good ? 3 : std::min<std::size_t>(7, line.size());
    result(good, line.substr(start, colon == std::string::npos ? colon : colon - start),
           good ? "" : line);
}

void run_checks()
{
    const std::string command =
        "python3 '" + source_tree() + "/tests/programs/colormap_checks.py' 2>&1";
    std::FILE *const pipe = popen(command.c_str(), "r");
    std::string said;
    char buffer[4096];
    while (pipe != nullptr && std::fgets(buffer, sizeof buffer, pipe) != nullptr)
    {
        said += buffer;
    }
    const int status = pipe == nullptr ? -1 : pclose(pipe);
    int results = 0;
    for (const std::string &line : lines_of(said))
    {
        if (matches(line, "^(not )?ok "))
        {
            take_result(line);
            ++results;
        }
    }
    result(WIFEXITED(status) && results >= 5, "colormap_checks.py runs to its end", said);
}

void json()
{
    for (const std::string &model : models)
    {
        write_file(model + ".json", warns(model + " as json", "", model + " --format json").out);
        output_of(model + " --samples 256 --format json -o " + model + ".256.json");
        output_of(model + " --samples 256 --format csv -o " + model + ".256.csv");
    }
    for (const std::string &model : uniform_models)
    {
        write_file(model + ".json", warns(model + " as json", "", model + " --format json").out);
    }
    // the colour in the middle of a fold, where two samples beside it are the same, is the only short step
    write_file("fold.json", output_of("diverging:divergence=0 --samples 256 --format json"));
    write_file("one.json", output_of("rainbow --samples 1 --format json"));
    write_file("cut.json", run("colormap single:saturation=4 --format json").out);
    output_of("diverging -o mine.py --name mine");
    const std::string custom = content_of("sequential-custom.json");
    const std::size_t at = custom.find("\"specification\": \"") + 18;
    const std::string specification = custom.substr(at, custom.find('"', at) - at);
    const Ran again = run(Words{"colormap", specification, "--format", "json"});
    result(again.status == 0 && again.out == custom, "the specification in json makes the same map",
           specification);
    run_checks();
}

// ---- what is wrong

struct WrongColormap
{
    const char *name;
    const char *words;
    const char *arguments;
};

constexpr WrongColormap wrong_colormap_usage[] = {
    {"no map", "one MAP is needed, 0 are given", ""},
    {"two maps", "one MAP is needed, 2 are given", "single rainbow -o made/a.json"},
    {"unknown map", "no colour map is called 'viridis'.*see --list", "viridis -o made/a.json"},
    {"nearly a map", "did you mean sequential-rainbow\\?", "sequential-rainbwo -o made/a.json"},
    {"control characters", "called 'a\\?b'", "'a\nb' -o made/a.json"},
    {"unknown parameter", "sequential-single has no parameter 'hug'", "single:hug=1"},
    {"a parameter of a map that has none", "uniform-blue has no parameters, so 'hue=1' is too much",
     "uniform-blue:hue=1"},
    {"range", "must be in \\[0, 360\\]", "single:hue=400"},
    {"unknown option", "no option --sampels; did you mean --samples", "single --sampels 3"},
    {"missing value", "--samples needs an argument", "single --samples"},
    {"value too many", "--fit takes no argument", "single --fit=1"},
    {"unknown format", "'gif', not one of json, csv, matplotlib, gimp, png", "single --format gif"},
    {"unknown suffix", "must end in .json, .csv, .py, .gpl or .png", "single -o made/a.gif"},
    {"no name of a file", "needs the name of a file", "single -o ''"},
    {"png to standard output", "a png goes to a file", "single --format png"},
    {"size of text", "--size is for png only, not for csv", "single --size 5x5"},
    {"test pattern of text", "--test-pattern is for png only, not for json",
     "single --test-pattern -o made/a.json"},
    {"samples of a test pattern", "--samples has no meaning",
     "single --test-pattern --samples 5 -o made/a.png"},
    {"name of csv", "--name is for matplotlib and gimp", "single --name a"},
    {"a name that is no word", "'a\"b', not a word", "single --format gimp --name a\"b"},
};

void bad_colormap_arguments()
{
    for (const WrongColormap &wrong : wrong_colormap_usage)
    {
        fails(wrong.name, 2, wrong.words, std::string("colormap ") + wrong.arguments);
    }
    for (const std::string number : {"0", "-1", "65537", "1.5", "x", ""})
    {
        fails("samples '" + number + "'", 2, "--samples is .*, not a whole number from 1 to 65536",
              Words{"colormap", "single", "--samples", number});
    }
    for (const std::string size : {"5", "5x", "0x5", "5x0", "x5", "5x5x", "40000x1", "", "5X5"})
    {
        fails("size '" + size + "'", 2, "--size is .*, not WIDTHxHEIGHT",
              Words{"colormap", "single", "--size", size, "-o", "made/a.png"});
    }
}

void files()
{
    fails("no such folder", 1, "cannot be written", "colormap single -o made/none/a.json");
    std::filesystem::create_directory("folder.json");
    fails("a folder", 1, "is a folder", "colormap single -o folder.json");
    write_file("kept.json", "old\n");
    Ran ran;
    {
        const SizeLimit limit(1024);
        ran = run("colormap rainbow --samples 60000 -o kept.json");
    }
    result(ran.status == 1 && content_of("kept.json") == "old\n" &&
               names_in(".") == "folder.json kept.json ",
           "no room: the old file stays, and no other", seen(ran) + names_in("."));
    output_of("rainbow -o kept.json");
    result(matches(content_of("kept.json"), "sequential-rainbow"), "an old file is replaced");
}

} // namespace

const std::vector<Subject> &colormap_subjects()
{
    static const std::vector<Subject> subjects = {{"colormap_talk", colormap_talk},
                                                  {"text", text},
                                                  {"names_of_files", names_of_files},
                                                  {"colormap_pictures", colormap_pictures},
                                                  {"gamut", gamut},
                                                  {"json", json},
                                                  {"colormap_arguments", bad_colormap_arguments},
                                                  {"colormap_files", files}};
    return subjects;
}
