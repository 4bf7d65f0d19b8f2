// SPDX-License-Identifier: MIT
//
// What cubemap-tof refuses in one line: words, numbers, sensors, scenes, and what cannot be written.

#include "image_cases.hpp"
#include "tof_inputs.hpp"

#include <array>
#include <cstdio>
#include <filesystem>

namespace
{

void refuses_tof_words()
{
    make_tof_inputs();
    const std::string good = "tof simulate wall.json sensor.json pose.txt -o made/x";
    fails("no command", 2, "a command is needed: simulate", "tof");
    fails("no path of texel images", 2, "SCENE and PATH.txt are needed, 1 is given",
          "tof texel room -o made/x");
    fails("no folder for texel images", 2, "-o DIR is needed", "tof texel room pose.txt");
    fails("more depths than pixels", 2, "--depths is more than --size",
          "tof texel room pose.txt -o made/x --size 8 --depths 9");
    fails("a window beyond the image", 2, "--window is more than --size",
          "tof texel room pose.txt -o made/x --size 8 --window 9");
    fails("a budget that cannot be told", 2, "--budget has no place to tell",
          "tof simulate wall.json sensor.json pose.txt -o - --budget 1mm");
    fails("a spacing that there is not", 2, "--spacing is 'angle'",
          "tof texel room pose.txt -o made/x --spacing angle");
    fails("another command", 2, "'simulat' is not a command: .*did you mean simulate",
          "tof simulat");
    fails("no operands", 2, "are needed, 0 are given", "tof simulate -o made/x");
    fails("a preset and a sensor", 2, "are needed with --preset, 3 are given",
          good + " --preset camcube");
    fails("no folder", 2, "-o DIR is needed", "tof simulate wall.json sensor.json pose.txt");
    fails("a stream of pictures", 2, "-o - writes arrays of NPY, not --format exr",
          "tof simulate wall.json sensor.json pose.txt -o - --format exr");
    fails("a stream of HDF5", 2, "-o - writes arrays of NPY, not --format hdf5",
          "tof simulate wall.json sensor.json pose.txt -o - --format hdf5");
    fails("JSON into a stream", 2, "--json has no place where -o - writes frames",
          "tof simulate wall.json sensor.json pose.txt -o - --json");
    fails("a format that there is not", 2, "--format is 'npz'", good + " --format npz");
    fails("a preset that there is not", 2, "--preset is 'camcub'",
          "tof simulate --preset camcub wall.json pose.txt -o made/x");
    for (const std::string count : {"3", "0x3", "3x", "65x1", "axb", "1x1x1"})
    {
        fails("samples " + count, 2, "--samples is '.*', not COLUMNSxROWS",
              good + " --samples " + count);
    }
    for (const std::string limit : {"0", "-1mm", "1km", "mm", "nan", "''"})
    {
        fails("budget " + limit, 2, "--budget is .*, not a length", good + " --budget " + limit);
    }
    fails("bounces below 0", 2, "--bounces", good + " --bounces -1");
    fails("no such scene", 2, "SCENE is 'roam'",
          "tof simulate roam sensor.json pose.txt -o made/x");
    write_file("in_the_way", "");
    fails("a file in the way", 1, "'in_the_way' cannot be made",
          "tof simulate wall.json sensor.json pose.txt -o in_the_way");
    does("tof simulate wall.json sensor.json pose.txt -o there --quiet");
    passes("a folder with something in it",
           "tof simulate wall.json sensor.json pose.txt -o there --quiet");
}

// What no light, lens or chip has: by file, line and name, at both ends of a range.
void refuses_tof_ranges()
{
    make_tof_inputs();
    const std::string text = sensor_text();
    const auto changed = [&](const std::string &from, const std::string &to)
    {
        std::string made = text;
        made.replace(made.find(from), from.size(), to);
        write_file("odd.json", made);
    };
    const char *const run = "tof simulate wall.json odd.json pose.txt -o odd --quiet";
    const std::array<std::array<const char *, 3>, 13> beyond = {
        {{"\"frequency\": 20e6", "\"frequency\": 1e308",
          "3: frequency is 1e.308, not a number from"},
         {"\"frequency\": 20e6", "\"frequency\": 999",
          "3: frequency is 999, not a number from 1000"},
         {"\"frequency\": 20e6", "\"frequency\": 20e6, \"second_frequency\": 1e-308",
          "3: second_frequency is 1e-308, not a number from 1000 to 1e.12, or 0"},
         {"\"pitch\": 12e-6", "\"pitch\": 12", "2: pitch is 12, not a number from 1e-09 to 1"},
         {"\"wavelength\": 850e-9", "\"wavelength\": 850", "2: wavelength is 850, not"},
         {"\"f_number\": 1.2", "\"f_number\": 1e-30", "2: f_number is 1e-30, not"},
         {"\"exposure\": 5e-3", "\"exposure\": 1e-300", "3: exposure is 1e-300, not"},
         {"\"duty\": 0.5", "\"duty\": 0.5, \"full_well\": 1e-3", "3: full_well is 0.001, not"},
         {"\"duty\": 0.5", "\"duty\": 0.5, \"harmonic\": [1, -1e30]",
          "3: harmonic has -1e.30, not"},
         {"\"duty\": 0.5", "\"duty\": 0.5, \"dark\": 1e30", "3: dark is 1e.30, not"},
         {"\"cx\": 11.5", "\"cx\": 1e300", "1: camera.cx is 1e.300, not a number from -1e.09 to"},
         {"\"fy\": 20", "\"fy\": 1e30", "1: camera.fy is 1e.30, not a number from 0.001 to"},
         {"\"power\": 0.7", "\"power\": 0.7, \"position\": [0, -1e300, 0]",
          "4: lights\\[0\\].position has -1e.300, not"}}};
    for (const auto &[from, to, expression] : beyond)
    {
        changed(from, to);
        fails(to, 1, std::string("'odd.json':") + expression, run);
    }
    std::string row = "1";
    for (int i = 0; i < 4096; ++i)
    {
        row += ", 1";
    }
    changed("\"duty\": 0.5", "\"duty\": 0.5, \"mask\": [[" + row + "]]");
    fails("a mask that is too wide", 1, "'odd.json':3: mask has more than 4096 columns or rows",
          run);
    changed("\"duty\"", "\"duyt\"");
    fails("a member that is misspelt", 1, "duty is missing: .*; is 'duyt' meant for it", run);
    changed("\"power\": 0.7", "\"power\": 0.7, \"Directoin\": [0, 0, 1]");
    fails("a member that is nearly one", 1, "'Directoin', which .*; did you mean direction", run);
    changed("\"height\"", "\"heigth\"");
    fails("a camera's member that is misspelt", 1,
          "'odd.json':1: camera has 'heigth', which .*; did you mean height\\?", run);
    changed("\"fx\"", "\"fX\"");
    fails("a short one", 1, "camera has 'fX', which .*; did you mean fx\\?", run);
    changed("\"camera\"", "\"cammera\"");
    fails("the camera itself", 1, "camera is missing: an object.*; is 'cammera' meant for it", run);
    changed("\"lights\"", "\"ligths\"");
    fails("the lights", 1, "lights is missing: a list.*; is 'ligths' meant for it", run);
    changed("\"phases\"", "\"phase\"");
    fails("the phases", 1, "phases is missing: a whole.*; is 'phase' meant for it", run);
    for (const char *const edge : {"1e3", "1e12"})
    {
        changed("\"frequency\": 20e6", std::string("\"frequency\": ") + edge);
        passes(std::string("a frequency of ") + edge, run);
    }
}

void sensor_fails(const std::string &name, const std::string &text, const std::string &expression)
{
    write_file("bad.json", text);
    fails(name, 1, "'?bad.json'?:.*" + expression,
          "tof simulate wall.json bad.json pose.txt -o made/x");
}

void refuses_sensors()
{
    make_tof_inputs();
    fails("no such sensor", 1, "absent.json",
          "tof simulate wall.json absent.json pose.txt -o made/x");
    fails("no such trajectory", 1, "absent.txt",
          "tof simulate wall.json sensor.json absent.txt -o made/x");
    sensor_fails("no JSON", "{\n\"pitch\": }", "2: is no JSON object");
    sensor_fails("no exposure", sensor_text(light_text, "\"readout\": 0"),
                 "exposure is missing: a number above 0");
    sensor_fails("an exposure of 0", sensor_text(light_text, "\"exposure\": 0"),
                 "3: exposure is 0, not a number above 0");
    sensor_fails("an exposure that is a text", sensor_text(light_text, "\"exposure\": \"1\""),
                 "exposure is not a number above 0");
    sensor_fails("an infinite number", sensor_text(light_text, "\"exposure\": 1e999"),
                 "exposure is not a number above 0");
    sensor_fails("a member that means nothing",
                 sensor_text(std::string("\"lense\": 1, ") + light_text),
                 "'lense' means nothing there");
    sensor_fails("a member twice", sensor_text(std::string("\"duty\": 0.5, ") + light_text),
                 "duty is given twice");
    sensor_fails("no lights", sensor_text("\"lights\": []"), "lights is not a list of one light");
    sensor_fails("a light of nothing", sensor_text("\"lights\": [7]"),
                 "lights\\[0\\] is no object");
    sensor_fails("degrees for radians",
                 sensor_text("\"lights\": [{\"power\": 1, \"aperture\": 60}]"),
                 "lights\\[0\\].aperture is a full angle in radians");
    sensor_fails("a light with something else",
                 sensor_text("\"lights\": [{\"power\": 1, \"aperture\": 1, \"color\": 1}]"),
                 "lights\\[0\\] has 'color', which means nothing there");
    sensor_fails("a place of two numbers",
                 sensor_text("\"lights\": [{\"position\": [1, 2], \"power\": 1, \"aperture\": 1}]"),
                 "lights\\[0\\].position is not a list of 3 numbers");
    sensor_fails(
        "light that is negative",
        sensor_text("\"lights\": [{\"power\": 1, \"aperture\": 1, \"intensity\": [1, -1]}]"),
        "intensity is -1, not a number of 0 or more");
}

// Masks, harmonics, polynomials and intensities.
void refuses_sensor_tables()
{
    make_tof_inputs();
    sensor_fails("a mask of unequal rows",
                 sensor_text(std::string("\"mask\": [[1, 1], [1]], ") + light_text),
                 "mask has rows that are not of 2 numbers");
    sensor_fails("a mask without its shape",
                 sensor_text(std::string("\"mask\": [1, 1], ") + light_text),
                 "mask has 2 numbers, not 0 columns of 0");
    sensor_fails("a mask above 1", sensor_text(std::string("\"mask\": [[2]], ") + light_text),
                 "mask has what is not a number from 0 to 1");
    std::string two = sensor_text();
    two.replace(two.find("\"phases\": 4"), 11, "\"phases\": 2");
    sensor_fails("two phases", two, "phases is not a whole number from 3");
    two.replace(two.find("\"phases\": 2"), 11, "\"phases\": []");
    sensor_fails("phases that are a list", two, "phases is not a whole number from 3");
    sensor_fails("an empty mask", sensor_text(std::string("\"mask\": [[]], ") + light_text),
                 "mask has rows that are not of");
    sensor_fails("harmonics that are not there",
                 sensor_text(std::string("\n\"harmonics\": 3, ") + light_text),
                 "5: harmonics has 0 numbers");
    sensor_fails("a NaN in a table", sensor_text(std::string("\"mask\": [[NaN]], ") + light_text),
                 "4: is no JSON object");
    sensor_fails("an empty place in a table",
                 sensor_text(std::string("\"harmonic\": [1, null], ") + light_text),
                 "harmonic is not a finite number");
    sensor_fails("a polynomial without its range",
                 sensor_text(std::string("\"shot_variance\": [1], ") + light_text),
                 "shot_most is not above shot_least");
    sensor_fails(
        "a polynomial of another length",
        sensor_text(std::string("\"shot_variance\": [1], \"shot_terms\": 2, ") + light_text),
        "shot_variance has 1 numbers");
    fails("shot noise without noise", 2,
          "--shot says where shot noise comes from; it needs --noise",
          "tof simulate wall.json sensor.json pose.txt -o made/x --shot freeman-tukey");
    sensor_fails("a cone of no width",
                 sensor_text("\"lights\": [{\"power\": 1, \"aperture\": 1e-300}]"),
                 "aperture is a full angle in radians, from 1e-6");
    sensor_fails("noise beyond all bounds",
                 sensor_text(std::string("\"fixed_pattern\": 1e9, ") + light_text),
                 "4: fixed_pattern is 1e.09, not a number from 0 to 1000");
    sensor_fails("readings beyond all bounds",
                 sensor_text(std::string("\"read_noise\": 1e31, ") + light_text),
                 "4: read_noise is 1e.31, not a number from 0 to 1e.30");
    sensor_fails("a polynomial beyond all bounds",
                 sensor_text(std::string("\"shot_least\": 1, \"shot_most\": 9,\n"
                                         "\"shot_variance\": [1, 1e300], ") +
                             light_text),
                 "5: shot_variance becomes too large");
    sensor_fails("an intensity that no float holds",
                 sensor_text("\"lights\": [{\"power\": 1, \"aperture\": 6,\n"
                             "\"intensity\": [1, 1e39]}]"),
                 "5: lights\\[0\\].intensity has a number beyond");
    sensor_fails("intensities that would all be 0",
                 sensor_text("\"lights\": [{\"power\": 1, \"aperture\": 1,\n"
                             "\"intensity\": [1e-60, 2e-60]}]"),
                 "5: lights\\[0\\].intensity has no number that single precision holds");
}

// A sensor's camera.
void refuses_sensor_cameras()
{
    make_tof_inputs();
    std::string camera = sensor_text();
    camera.replace(camera.find("\"fx\": 20"), 8, "\"fx\": 0");
    sensor_fails("a camera without focal length", camera,
                 "1: camera.fx is 0, not a number above 0");
    camera.replace(camera.find("\"fx\": 0"), 7, "\n\"fx\": -1");
    sensor_fails("a chip that mirrors", camera, "2: camera.fx is -1, not a number above 0");
    std::string named = camera;
    named.insert(named.find("\"fx\""), "\"mapping\": \"\", ");
    sensor_fails("with an empty mapping, too", named, "2: camera.fx is -1, not a number above 0");
    camera.replace(camera.find("\"fx\": -1"), 8, "\"fx\": 1e-200");
    sensor_fails("a focal length of nothing", camera, "2: a focal length of 1e-200 as fx");
    camera.replace(camera.find("\"fx\": 1e-200"), 12, "\"fx\": 1e999");
    sensor_fails("a focal length without end", camera, "2: camera.fx is not a number above 0");
    camera.replace(camera.find("\"fx\": 1e999"), 11, "\"fx\": 20,\n\"depth_scale\": -1");
    sensor_fails("a camera's other members", camera, "3: depth_scale is units of depth");
}

void scene_fails(const std::string &name, const std::string &members, const std::string &expression)
{
    write_file("odd.json",
               "{\"planes\": [{\"point\": [0, 0, 2], \"normal\": [0, 0, 1], " + members + "}]}");
    fails(name, 1, "'odd.json':1: planes\\[0\\]" + expression,
          "tof simulate odd.json sensor.json pose.txt -o made/x");
}

void refuses_motions()
{
    make_tof_inputs();
    scene_fails("a motion that is a number", "\"motion\": 3", ".motion is neither");
    scene_fails("a motion of seven numbers", "\"motion\": [[0, 0, 0, 0, 0, 0, 1]]",
                ".motion is neither");
    scene_fails("a time without end", "\"motion\": [[1e999, 0, 0, 0, 0, 0, 0, 1]]",
                ".motion is neither");
    scene_fails("a motion backwards",
                "\"motion\": [[1, 0, 0, 0, 0, 0, 0, 1], [0, 0, 0, 0, 0, 0, 0, 1]]",
                ".motion has no times, or times that do not grow");
    scene_fails("a motion that is twisted", "\"motion\": [[0, 0, 0, 0, 0, 0, 0, 2]]",
                ".motion has a quaternion that is more than 1e-3 off length 1");
    scene_fails("a motion without end", "\"motion\": [[0, 1e999, 0, 0, 0, 0, 0, 1]]",
                ".motion is neither");
    write_file(
        "odd.json",
        "{\"planes\": [{\"point\": [0, 0, 2], \"normal\": [0, 0, 1], \"motion\": [\n"
        "[0, 0, 0, 0, 0, 0, 0, 1],\n[1, 0, 0, 0, 0, 0, 0, 1],\n[1, 0, 0, 0, 0, 0, 0, 1]]}]}");
    fails("a time that is there twice", 1, "'odd.json':4: planes\\[0\\].motion has no times, or",
          "tof simulate odd.json sensor.json pose.txt -o made/x");
    scene_fails("no motion at all", "\"motion\": []", ".motion has no times");
}

void refuses_reflections()
{
    make_tof_inputs();
    scene_fails("a BRDF of no kind", "\"brdf\": {}", ".brdf.kind is not lambert");
    scene_fails("a BRDF with something else", "\"brdf\": {\"kind\": \"lambert\", \"eta\": 1}",
                ".brdf has 'eta', which means nothing there");
    scene_fails("facets beyond all slopes",
                "\"brdf\": {\"kind\": \"cook-torrance\", \"roughness\": 7, \"eta\": 1.5}",
                ".brdf.roughness is 7, not a number from 0.01 to 1");
    for (const std::string member : {"diffuse", "specular", "absorption"})
    {
        scene_fails("facets of " + member + " below 0",
                    "\"brdf\": {\"kind\": \"cook-torrance\", \"roughness\": 0.2, \"eta\": 1.5, \"" +
                        member + "\": -1}",
                    ".brdf." + member + " is -1, not a number");
    }
    scene_fails("facets that give more than they get",
                "\"brdf\": {\"kind\": \"cook-torrance\", \"roughness\": 0.2, \"eta\": 1.5, "
                "\"diffuse\": 0.6, \"specular\": 0.5}",
                ".brdf.specular is more than diffuse leaves of 1");
}

void refuses_measured_reflections()
{
    make_tof_inputs();
    std::filesystem::create_directory("folder.json");
    write_file("table.csv", "10, 20, 30\n");
    write_file("measured.json", "{\"planes\": [{\"point\": [0, 0, 2], \"normal\": [0, 0, 1], "
                                "\"brdf\": {\"kind\": \"measured\", \"file\": \"table.csv\"}}]}");
    fails("a table of three columns", 1, "'table.csv':1: is not theta_in theta_out azimuth value",
          "tof simulate measured.json sensor.json pose.txt -o made/x");
    for (const std::string line : {"0 0 0 nan", "0 0 0", "0 0 0 NaN # none", "inf -inf 0 1"})
    {
        write_file("table.csv", line + "\n");
        fails("a table with " + line, 1, "'table.csv':1: is not theta_in",
              "tof simulate measured.json sensor.json pose.txt -o made/x");
    }
    for (const std::string line : {"91 0 0 0.3", "0 -1 0 0.3", "0 0 0 -0.3", "0 0 0 1e39"})
    {
        write_file("table.csv", "0 0 0 0.3\n" + line + "\n");
        fails("a table with " + line, 1, "'table.csv':2: has a [a-z_]+ that is not from 0 to ",
              "tof simulate measured.json sensor.json pose.txt -o made/x");
    }
    write_file("table.csv", "# nothing\n");
    fails("a table of no values", 1, "'table.csv' has no line of theta_in",
          "tof simulate measured.json sensor.json pose.txt -o made/x");
    std::filesystem::remove("table.csv");
    std::filesystem::create_directory("table.csv");
    fails("a folder for a table", 1, "table.csv: is a folder, not a file",
          "tof simulate measured.json sensor.json pose.txt -o made/x");
    fails("a folder for a scene", 1, "folder.json: is a folder, not a file",
          "tof simulate folder.json sensor.json pose.txt -o made/x");
}

void refuses_meshes()
{
    make_tof_inputs();
    write_file("points.obj", "v 0 0 1\nv 1 0 1\nv 0 1 1\n");
    fails("a mesh of points", 1, "points.obj: has no triangle",
          "tof simulate points.obj sensor.json pose.txt -o made/x");
    write_file("far.obj", "v 0 0 1\nv 1e20 0 1\nv 0 1 1\nf 1 2 3\n");
    fails("a mesh beyond reach", 1, "'far.obj' has a mesh with coordinates of 1e18",
          "tof simulate far.obj sensor.json pose.txt -o made/x");
    write_file("odd.obj", "v 0 0 1\nv 1 0 1\nv 0 1 1\nf 1 2 9\n");
    write_file("comma.obj", "v 0 0 1\nv 1,0 0 1\nv 0 1 1\nf 1 2 3\n");
    fails("a number with a comma", 1, "comma.obj:2: a vertex with what is no finite number",
          "tof simulate comma.obj sensor.json pose.txt -o made/x");
    write_file("note.obj", "v 0 0 1 # here\nv 1 0 1\nv 0 1 1\nf 1 2 3\n");
    passes("a note behind a vertex", "tof simulate note.obj sensor.json pose.txt -o note --quiet");
    fails("a mesh of a vertex that is not there", 1, "odd.obj:4: a face of a vertex",
          "tof simulate odd.obj sensor.json pose.txt -o made/x");
    write_file("empty.json", "{}");
    fails("an empty scene", 1, "'empty.json': has nothing in it",
          "tof simulate empty.json sensor.json pose.txt -o made/x");
}

void refuses_full_disks()
{
    make_tof_inputs();
    const std::string good = "tof simulate wall.json sensor.json pose.txt -o made/x";
    {
        const SizeLimit limit(600);
        fails("a disk that is full", 1, "made/x/.*: ", good);
    }
    if (*truth_in_parts != 0)
    {
        const SizeLimit limit(16000); // between what a frame's pictures take and its truth
        fails("a disk that is full of truth", 1, "made/x/truth_0000.*: ", good + " --truth");
    }
    does("tof simulate wall.json sensor.json pose.txt -o seen --quiet");
    std::FILE *const full = std::fopen("/dev/full", "w");
    for (const std::string way : {"", " --json"})
    {
        if (full != nullptr)
        {
            const Ran ran = run_with_input(
                "", "tof evaluate seen/distance_0000.exr seen/distance_0000.exr" + way, full);
            result(ran.status == 1 && matches(ran.err, "standard output: No space left"),
                   "measures that nobody takes" + way, ran.err);
        }
    }
    if (full != nullptr)
    {
        std::fclose(full);
    }
}

} // namespace

const std::vector<Subject> &tof_refusal_subjects()
{
    static const std::vector<Subject> subjects = {
        {"tof_words", refuses_tof_words},
        {"tof_ranges", refuses_tof_ranges},
        {"tof_bad_sensors", refuses_sensors},
        {"tof_bad_tables", refuses_sensor_tables},
        {"tof_bad_cameras", refuses_sensor_cameras},
        {"tof_bad_motions", refuses_motions},
        {"tof_bad_reflections", refuses_reflections},
        {"tof_bad_measurements", refuses_measured_reflections},
        {"tof_bad_meshes", refuses_meshes},
        {"tof_full_disks", refuses_full_disks}};
    return subjects;
}
