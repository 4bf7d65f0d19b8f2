// SPDX-License-Identifier: MIT
//
// cubemap-tof: a sphere and walls whose distances are known, what lies in the folder, and what is refused in one line.

#include "image_cases.hpp"
#include "picture.hpp"

#include "modules/scene/io/npy_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>

namespace
{

constexpr const char *camera_text =
    R"("camera": {"width": 24, "height": 18, "fx": 20, "fy": 20, "cx": 11.5, "cy": 8.5})";
constexpr const char *light_text = R"("lights": [{"power": 0.7, "aperture": 6.283185307179586}])";

// Truth is written as parts of an OpenEXR file only where that library is.
#ifdef HAVE_OPENEXR
constexpr const char *truth_in_parts = " --truth";
#else
constexpr const char *truth_in_parts = "";
#endif

// One whose frames are shorter than any buffer.
constexpr const char *small_sensor =
    R"({"camera": {"width": 4, "height": 3, "fx": 4, "fy": 4, "cx": 1.5, "cy": 1}, "pitch": 12e-6, "f_number": 1,
"wavelength": 850e-9, "efficiency": 0.4, "exposure": 1e-3, "frequency": 20e6, "phases": 4, "duty": 0.5, "contrast": 0.8,
"lights": [{"power": 1, "aperture": 6.28}]})";

// A sensor with something else, or more, at its end.
std::string sensor_text(const std::string &rest = light_text,
                        const std::string &exposure = "\"exposure\": 5e-3")
{
    return std::string("{") + camera_text + ",\n\"pitch\": 12e-6, \"f_number\": 1.2, " +
           "\"wavelength\": 850e-9, \"efficiency\": 0.4,\n" + exposure +
           ", \"frequency\": 20e6, \"phases\": 4, \"duty\": 0.5, \"contrast\": 0.8,\n" + rest +
           "}\n";
}

// A sphere around camera and light, a wall before them, and two poses.
void make_tof_inputs()
{
    write_file("sphere.json",
               R"({"spheres": [{"centre": [0, 0, 0], "radius": 1, "reflectance": 0.5}]})");
    write_file("wall.json", R"({"planes": [{"point": [0, 0, 2], "normal": [0, 0, 1]}]})");
    write_file("sensor.json", sensor_text());
    write_file("pose.txt", "0 0 0 0 0 0 0 1\n");
    write_file("path.txt", "0 0 0 0 0 0 0 1\n1 0 0 0.5 0 0 0 1\n");
    std::filesystem::create_directory("made");
}

// All distances of a picture.
void check_distances(const std::string &name, double lowest, double highest)
{
    const Picture seen(name);
    if (seen.channels != 1 || seen.values.size() != 24 * 18)
    {
        throw std::runtime_error(name + " is not one channel of 24 x 18");
    }
    for (const float each : seen.values)
    {
        if (!(static_cast<double>(each) >= lowest && static_cast<double>(each) <= highest))
        {
            throw std::runtime_error(name + " has " + std::to_string(each));
        }
    }
}

void measures()
{
    make_tof_inputs();
    says(
        "simulate tells in JSON",
        "^\\{\"frames\": 1, \"ms_per_frame\": \\{\"median\": [0-9.e-]+, \"max\": [0-9.e-]+\\}, "
        "\"rays\": 432, \"oversampled\": 0, \"times\": 1, \"virtual_lights\": 0, \"saturated\": 0, "
        "\"unmeasured\": 0\\}\n$",
        "tof simulate sphere.json sensor.json pose.txt -o direct --json");
    holds("the sphere is 1 m away",
          [] { check_distances("direct/distance_0000.exr", 1 - 1e-6, 1 + 1e-6); });
    passes("one bounce",
           "tof simulate sphere.json sensor.json pose.txt -o once --bounces 1 --quiet");
    holds(
        "once scattered light makes it 1.216921 m", // by Lambers's integral; 338 lights are nearly even
        [] { check_distances("once/distance_0000.exr", 1.16, 1.27); });
    says("people are told",
         "^'two': 2 frames, median .* ms; 0 pixels saturated, 0 without light\n$",
         "tof simulate wall.json sensor.json path.txt -o two");
    holds("the camera moves along the trajectory",
          []
          {
              const double before = Picture("two/distance_0000.exr").first(11, 8);
              const double after = Picture("two/distance_0001.exr").first(11, 8);
              if (std::fabs(before - after - 0.5) > 0.01)
              {
                  throw std::runtime_error(std::to_string(before) + " " + std::to_string(after));
              }
          });
    write_file("table.csv", "# degrees\n0, 0, 0, 0.3\n30 30 180 0.3\n60, 60, 90, 0.3\n");
    write_file(
        "matter.json",
        R"({"planes": [{"point": [0, 0, 2], "normal": [0, 0, 1], "motion": [[0, 0, 0, 0, 0, 0, 0, 1],
                  [1, 0, 0, 0.5, 0, 0, 0, 1]], "brdf": {"kind": "measured", "file": "table.csv"}}]})");
    write_file("later.txt", "2 0 0 0 0 0 0 1\n");
    passes("a wall that has moved, of a measured BRDF",
           "tof simulate matter.json sensor.json later.txt -o moved --quiet");
    holds("it stands where its motion ends",
          []
          {
              const double distance = Picture("moved/distance_0000.exr").first(11, 8);
              if (std::fabs(distance - 2.5) > 0.01)
              {
                  throw std::runtime_error(std::to_string(distance));
              }
          });
    write_file("behind.json", sensor_text("\"lights\": [{\"position\": [0, 0, 3], \"power\": 1, "
                                          "\"aperture\": 6.283185307179586}]"));
    write_file("strong.json", sensor_text("\"lights\": [{\"power\": 1e300, \"aperture\": 6}]"));
    says("charges that no number holds are saturated", "\"saturated\": 432, ",
         "tof simulate wall.json strong.json pose.txt -o strong --json --noise");
    write_file("within.json", R"({"boxes": [{"min": [-1, -1, 0], "max": [1, 1, 1]}]})");
    says("a camera in a wall sees what is behind", "\"unmeasured\": 0\\}",
         std::string("tof simulate within.json sensor.json pose.txt -o within --json") +
             truth_in_parts);
    write_file("open.obj", "v -9 -9 2\nv 9 -9 2\nv 0 9 2\nv 0 0 1\nf 1 2 3\nf 4 4 4\nf 1 2 2\n");
    says("an open mesh, and triangles of no area", "\"unmeasured\": 0\\}",
         "tof simulate open.obj sensor.json pose.txt -o open --json --bounces 1");
    write_file("zero.json", sensor_text("\"lights\": [{\"power\": 1, \"aperture\": 6, "
                                        "\"intensity\": [0]}]"));
    says("a table of one zero lights nothing", "\"unmeasured\": 432\\}",
         "tof simulate wall.json zero.json pose.txt -o zero --json");
    says("a light behind the wall lights nothing", "\"unmeasured\": 432\\}",
         "tof simulate wall.json behind.json pose.txt -o dark --json");
}

void lies_in_a_folder()
{
    make_tof_inputs();
    does("tof simulate wall.json sensor.json path.txt -o made/a --quiet --noise --seed 3 --samples "
         "2x3");
    result(names_in("made/a") == "amplitude_0000.exr amplitude_0001.exr distance_0000.exr "
                                 "distance_0001.exr intensity_0000.exr intensity_0001.exr "
                                 "metadata.json phase_0000_0.exr phase_0000_1.exr phase_0000_2.exr "
                                 "phase_0000_3.exr phase_0001_0.exr phase_0001_1.exr "
                                 "phase_0001_2.exr phase_0001_3.exr poses.txt ",
           "the files of two frames", names_in("made/a"));
    const std::string about = content_of("made/a/metadata.json");
    result(matches(about, "\"program\":.\"cubemap-tof simulate\"") &&
               matches(about, "\"seed\":.3") && matches(about, "\"samples\":.\"2x3\"") &&
               matches(about, "\"noise\":.true") && matches(about, "\"wavelength\":.8.5e-07") &&
               matches(about, "\"shape\":.\"plane\"") && matches(about, "\"temperature\":.null"),
           "metadata says how it was made", about);
    result(matches(content_of("made/a/poses.txt"), "^0.000000 0 0 0 [^\n]*\n1.000000 0 0 0.5 "),
           "poses are the trajectory's", content_of("made/a/poses.txt"));
    std::filesystem::create_directory("made/b");
    does("tof simulate wall.json sensor.json path.txt -o made/b --quiet --noise --seed 3 --samples "
         "2x3 "
         "--threads 7");
    does("tof simulate wall.json sensor.json path.txt -o made/c --quiet --noise --seed 4 --samples "
         "2x3");
    result(same_content("made/a/phase_0001_3.exr", "made/b/phase_0001_3.exr") &&
               same_content("made/a/distance_0000.exr", "made/b/distance_0000.exr"),
           "the same bits with seven threads");
    result(!same_content("made/a/phase_0001_3.exr", "made/c/phase_0001_3.exr"),
           "another seed has other noise");
    says("two frequencies", "\"frames\": 1",
         "tof simulate --preset pico-flexx room pose.txt -o made/d --json");
    result(std::filesystem::exists("made/d/phase_0000_7.exr") &&
               !std::filesystem::exists("made/d/phase_0000_8.exr"),
           "phases of the second follow the first's");
}

void has_shot_noise()
{
    make_tof_inputs();
    does("tof simulate wall.json sensor.json path.txt -o made/poisson --quiet --noise --seed 3 "
         "--samples 2x3");
    does("tof simulate wall.json sensor.json path.txt -o made/e --quiet --noise --seed 3 --samples "
         "2x3 --shot freeman-tukey");
    does("tof simulate wall.json sensor.json path.txt -o made/f --quiet --noise --seed 3 --samples "
         "2x3 --shot freeman-tukey --threads 7");
    result(!same_content("made/poisson/phase_0001_3.exr", "made/e/phase_0001_3.exr") &&
               same_content("made/e/phase_0001_3.exr", "made/f/phase_0001_3.exr"),
           "shot noise in Freeman and Tukey's space");
    result(matches(content_of("made/e/metadata.json"), "\"shot\":.\"freeman-tukey\""),
           "metadata says where it is from", content_of("made/e/metadata.json"));
    write_file("quiet.json", sensor_text(std::string("\"shot_variance\": [0], \"shot_least\": 1, "
                                                     "\"shot_most\": 2, ") +
                                         light_text));
    does("tof simulate wall.json quiet.json pose.txt -o made/g --quiet --noise "
         "--shot freeman-tukey");
    does("tof simulate wall.json sensor.json pose.txt -o made/h --quiet");
    result(std::fabs(Picture("made/g/distance_0000.exr").first(11, 8) -
                     Picture("made/h/distance_0000.exr").first(11, 8)) < 1e-6,
           "a measured polynomial of nothing is no noise");
}

// The numbers of an array without its head.
std::string numbers_of(const std::string &npy)
{
    const std::string whole = content_of(npy);
    return whole.substr(10 + static_cast<unsigned char>(whole[8]) +
                        256 * static_cast<unsigned char>(whole[9]));
}

constexpr const char *array_names[] = {
    "phase",          "distance",     "amplitude",       "intensity",        "flags",
    "truth_position", "truth_normal", "truth_object",    "truth_shape",      "truth_triangle",
    "truth_depth",    "truth_range",  "truth_flow_next", "truth_flow_before"};

void are_arrays()
{
    make_tof_inputs();
    const std::string pictures = "tof simulate wall.json sensor.json path.txt";
    does(pictures + " -o exr --quiet" + truth_in_parts);
    const std::string way = pictures + " --truth ";
    does(way + "-o npy --quiet --format npy");
    for (const std::string name : {"distance", "amplitude", "intensity", "truth_range"})
    {
        cm_image picture = {};
        char message[CM_IMAGE_MESSAGE] = "";
        const std::string file = "npy/" + name + "_0001.npy";
        const bool is_read = cm_npy_read(file.c_str(), &picture, message) == CM_OK;
        result(is_read && picture.width == 24 && picture.height == 18, name + " is an array",
               message);
        const Picture seen("exr/" + (name == "truth_range" ? "distance" : name) + "_0001.exr");
        const float *const value = static_cast<const float *>(picture.data);
        double most = 0;
        for (std::size_t i = 0; is_read && i < seen.values.size(); ++i)
        {
            most = std::max(most, std::fabs(static_cast<double>(value[i]) -
                                            static_cast<double>(seen.values[i])));
        }
        result(most <= (name == "truth_range" ? 1e-5 : 0), name + " is what the picture has",
               std::to_string(most));
        std::free(picture.data);
    }
    result(numbers_of("npy/phase_0000.npy").size() == 4 * 4 * 18 * 24 &&
               numbers_of("npy/truth_position_0000.npy").size() == 8 * 3 * 18 * 24 &&
               content_of("npy/truth_object_0000.npy")
                       .find("{'descr': '<u4', 'fortran_order': False, 'shape': (18, 24), }") == 10,
           "shapes and types");
    const std::string about = content_of("npy/metadata.json");
    for (const std::string name : array_names)
    {
        result(about.find("\"" + name + "_FRAME.npy\"") != std::string::npos,
               "metadata says what " + name + " is", about);
    }
    does(pictures + " -o bare --quiet --format npy");
    result(content_of("bare/metadata.json").find("truth_") == std::string::npos,
           "and nothing of truth that is not there");
    const std::string parts = content_of("exr/metadata.json");
    result(*truth_in_parts == 0 || (parts.find("\"truth_FRAME.exr\"") != std::string::npos &&
                                    parts.find("\"effects\"") != std::string::npos),
           "and which parts a picture of truth has", parts);
    std::string all;
    for (const std::string ending : {"_0000.npy", "_0001.npy"})
    {
        for (const std::string name : array_names)
        {
            all += content_of("npy/" + name + ending);
        }
    }
    const Ran stream = passes("frames as a stream", way + "-o -");
    result(stream.out == all, "the stream is the files one after another");
    std::FILE *const full = std::fopen("/dev/full", "w");
    if (full != nullptr)
    {
        const Ran ran = run_with_input("", way + "-o - --quiet", full);
        result(ran.status == 1 && matches(ran.err, "'standard output' cannot be written: No space"),
               "a stream that nobody takes", ran.err);
        write_file("few.json", small_sensor);
        const Ran few =
            run_with_input("", "tof simulate wall.json few.json pose.txt -o - --quiet", full);
        result(few.status == 1 && matches(few.err, "'standard output' cannot be written: No space"),
               "a short stream that nobody takes", few.err);
        std::fclose(full);
    }
    const SizeLimit limit(6000);
    fails("a disk that is full of arrays", 1, "made/x/truth_position_0000.npy'? cannot be written",
          "tof simulate wall.json sensor.json path.txt --truth -o made/x --format npy");
}

void are_files_of_hdf5()
{
    make_tof_inputs();
    const std::string way = "tof simulate wall.json sensor.json pose.txt --truth ";
    if (std::getenv("CUBEMAP_SIM_HDF5") == nullptr)
    {
        return; // this build has none
    }
    does(way + "-o npy --quiet --format npy");
    does(way + "-o one --quiet --format hdf5");
    does(way + "-o other --quiet --format hdf5 --threads 2");
    result(names_in("one") == "frame_0000.h5 metadata.json poses.txt ", "a file a frame",
           names_in("one"));
    const std::string whole = content_of("one/frame_0000.h5");
    result(whole.compare(1, 3, "HDF") == 0, "of HDF5");
    result(same_content("one/frame_0000.h5", "other/frame_0000.h5"), "the same bytes again");
    for (const std::string name : array_names)
    {
        result(whole.find(name) != std::string::npos &&
                   whole.find(numbers_of("npy/" + name + "_0000.npy")) != std::string::npos,
               name + " is in it");
    }
    const SizeLimit limit(6000);
    fails("a disk that is full of HDF5", 1, "made/x/frame_0000.h5'? cannot be written",
          way + "-o made/x --format hdf5");
}

// Of a wall at 2 m, and from half a metre nearer to it.
void renders_texels()
{
    make_tof_inputs();
    does("tof texel wall.json path.txt -o texel --size 64 --depths 4 --field 90 --quiet");
    result(names_in("texel") == "color_0000.exr color_0001.exr depth_0000.exr depth_0001.exr "
                                "matrices.txt point_0000.exr point_0001.exr range_0000.exr "
                                "range_0001.exr ",
           "files of texel images", names_in("texel"));
    const Picture color("texel/color_0000.exr"), depth("texel/depth_0001.exr"),
        point("texel/point_0000.exr");
    result(color.channels == 3 && color.values.size() == 3 * 64 * 64 && depth.channels == 1 &&
               depth.values.size() == 16 && point.values.size() == 48,
           "colours are fine, depths coarse");
    double most = 0;
    for (std::size_t i = 0; i < 16; ++i)
    {
        most = std::max({most, std::fabs(static_cast<double>(depth.values[i]) - 1.5),
                         std::fabs(static_cast<double>(point.values[3 * i + 2]) - 2)});
    }
    result(most < 1e-6, "the wall is where it is", std::to_string(most));
    result(content_of("texel/matrices.txt") == "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1\n"
                                               "1 0 0 0 0 1 0 0 0 0 1 0.5 0 0 0 1\n",
           "matrices begin at the first pose", content_of("texel/matrices.txt"));
    does("tof texel wall.json pose.txt -o even --size 64 --depths 4 --field 90 --spacing angles "
         "--rays 2 --window 3 --threads 2 --quiet");
    result(!same_content("texel/range_0000.exr", "even/range_0000.exr"), "even angles are others");
}

void knows_sensors()
{
    make_tof_inputs();
    write_file("mask.json",
               sensor_text(std::string("\"mask\": [[0, 1], [1, 0.5]], \"harmonic\": [1, "
                                       "0, 0.111], \"single_readout\": true, ") +
                           light_text));
    write_file("flat.json",
               sensor_text(std::string("\"mask\": [0, 1, 1, 0.5], \"mask_columns\": 2, "
                                       "\"mask_rows\": 2, \"harmonic\": [1, 0, 0.111], "
                                       "\"harmonics\": 3, \"single_readout\": 1, ") +
                           light_text));
    does("tof simulate wall.json mask.json pose.txt -o rows --quiet");
    does("tof simulate wall.json flat.json pose.txt -o flat --quiet");
    result(same_content("rows/phase_0000_1.exr", "flat/phase_0000_1.exr"),
           "a mask by rows is one in one list");
    does("tof simulate wall.json sensor.json pose.txt -o whole --quiet");
    result(!same_content("rows/phase_0000_1.exr", "whole/phase_0000_1.exr"), "a mask takes light");
    write_file("corner.json",
               sensor_text(std::string("\"mask\": [[1, 0], [0, 0]], ") + light_text));
    for (const std::string way : {"", "--full "})
    {
        does("tof simulate wall.json corner.json pose.txt -o corner --quiet --samples 2x2 " + way);
        const double x = (0 - 0.25 - 11.5) / 20, y = (0 - 0.25 - 8.5) / 20; // of the first pixel
        const double apart =
            Picture("corner/distance_0000.exr").first(0, 0) - 2 * std::sqrt(1 + x * x + y * y);
        result(std::fabs(apart) < 1e-3, "the one active sub-pixel is where it is " + way,
               std::to_string(apart));
    }
    write_file("spot.json", sensor_text("\"lights\": [{\"position\": [0.1, 0, 0], \"direction\": "
                                        "[0, 0, 2], \"power\": 1, \"aperture\": 1, \"intensity\": "
                                        "[1, 0.5, 0]}]"));
    says("a cone lights a part", "\"unmeasured\": [1-9][0-9]*\\}",
         "tof simulate wall.json spot.json pose.txt -o spot --json");
    write_file("full.json", sensor_text(std::string("\"full_well\": 1000, ") + light_text));
    says("saturation is told", "\"saturated\": [1-9][0-9]*, ",
         "tof simulate wall.json full.json pose.txt -o full --json");
    for (const std::string preset : {"camcube", "dual-12um", "single-8um"})
    {
        passes("preset " + preset,
               "tof simulate --preset " + preset + " room pose.txt -o " + preset + " --quiet");
    }
}

// In a corner, where scattered light does much: what is given is not exceeded, and what remains has a name.
void keeps_budgets()
{
    make_tof_inputs();
    write_file("corner.json", R"({"planes": [{"point": [0, 0, 2], "normal": [0, 0, 1]},
                  {"point": [0, 0.5, 0], "normal": [0, 1, 0]}, {"point": [0.6, 0, 0], "normal": [1, 0, 0]}]})");
    says("a budget is told",
         "\"budget\": \\{ ?\"subject\": \"time-of-flight frame\", .*\"name\": \"multipath\"",
         "tof simulate wall.json sensor.json pose.txt -o budget --budget 1mm --json");
    result(matches(content_of("budget/metadata.json"), "\"budget\":.0.001"),
           "and stands in the metadata");
    const std::string corner = "tof simulate corner.json sensor.json pose.txt --budget 20mm ";
    says("direct light is direct light, whatever the budget",
         "\"within_budget\": false, \"chosen\": \\{\"bounces\": 0, .*\"name\": \"multipath\", "
         "\"contribution\": 0.[0-9]*, [^}]*\"dropped: limit given\"",
         corner + "-o direct --bounces 0 --json");
    says("one bounce is one bounce",
         "\"chosen\": \\{\"bounces\": 1, .*\"name\": \"further bounces\", "
         "\"contribution\": 0.[0-9]*, [^}]*\"dropped: limit given\"",
         corner + "-o once --bounces 1 --json");
    says("people are told what remains",
         "; error [0-9.]* mm, beyond 20 mm: .*multipath [0-9.]* mm, further bounces",
         corner + "-o direct --bounces 0");
    says("paths that are given are not exceeded",
         "\"within_budget\": false, \"chosen\": \\{\"bounces\": 2, .*\"paths\": 8, .*\"sampling of "
         "scattered light\", "
         "\"contribution\": 0.[0-9]*, [^}]*\"beyond the limit: no more samples than are given\"",
         corner + "-o few --bounces 2 --paths 8 --json");
    says("without them there are as many as are needed",
         "\"chosen\": \\{\"bounces\": 2, .*\"paths\": [1-9][0-9][0-9]+, .*\"sampling of scattered "
         "light\", "
         "\"contribution\": 0.0[01][0-9]*, [^}]*\"the error is within the limit with the samples "
         "that are chosen\"",
         corner + "-o enough --bounces 2 --json");
    write_file("gray.json",
               R"({"planes": [{"point": [0, 0, 2], "normal": [0, 0, 1], "reflectance": 0.5},
                  {"point": [0, 0.5, 0], "normal": [0, 1, 0], "reflectance": 0.5}]})");
    const std::string gray = "tof simulate gray.json sensor.json pose.txt --budget 20mm ";
    says("how many paths would do is told",
         "\"within_budget\": false, .*\"paths_needed\": [5-9][0-9], ",
         gray + "-o too_few --paths 8 --json");
    says("and to people", "by 8 paths a pixel; about --paths [5-9][0-9] would do",
         gray + "-o too_few --paths 8");
    says("half of that do not", "\"within_budget\": false", gray + "-o too_few --paths 32 --json");
    says("so many do", "\"within_budget\": true, .*\"paths_needed\": null",
         gray + "-o so_many --paths 128 --json");
    says("more than are taken are told, too",
         "about [0-9]* would do, which is more than --paths takes",
         "tof simulate gray.json sensor.json pose.txt --budget 0.1mm -o too_few --paths 8");
    const std::string about = content_of("few/metadata.json");
    result(matches(about, "\"bounces\":.2,") && matches(about, "\"paths\":.8,") &&
               matches(about, "\"traced\":.true"),
           "metadata says by how many paths", about);
    does("tof simulate corner.json sensor.json pose.txt -o again --bounces 2 --paths 8 --noise "
         "--quiet");
    result(same_content("few/phase_0000_2.exr", "again/phase_0000_2.exr"),
           "what it says makes the same bits again");
}

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
    for (const char *const edge : {"1e3", "1e12"})
    {
        changed("\"frequency\": 20e6", std::string("\"frequency\": ") + edge);
        passes(std::string("a frequency of ") + edge, run);
    }
}

void refuses_tof_files()
{
    make_tof_inputs();
    const std::string good = "tof simulate wall.json sensor.json pose.txt -o made/x";
    const auto sensor_fails =
        [](const std::string &name, const std::string &text, const std::string &expression)
    {
        write_file("bad.json", text);
        fails(name, 1, "'?bad.json'?:.*" + expression,
              "tof simulate wall.json bad.json pose.txt -o made/x");
    };
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
    const auto scene_fails =
        [](const std::string &name, const std::string &members, const std::string &expression)
    {
        write_file("odd.json", "{\"planes\": [{\"point\": [0, 0, 2], \"normal\": [0, 0, 1], " +
                                   members + "}]}");
        fails(name, 1, "'odd.json':1: planes\\[0\\]" + expression,
              "tof simulate odd.json sensor.json pose.txt -o made/x");
    };
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

const std::vector<Subject> &tof_subjects()
{
    static const std::vector<Subject> subjects = {
        {"tof_measures", measures},        {"tof_folder", lies_in_a_folder},
        {"tof_arrays", are_arrays},        {"tof_hdf5", are_files_of_hdf5},
        {"tof_texel", renders_texels},     {"tof_sensors", knows_sensors},
        {"tof_budgets", keeps_budgets},    {"tof_words", refuses_tof_words},
        {"tof_files", refuses_tof_files},  {"tof_ranges", refuses_tof_ranges},
        {"tof_shot_noise", has_shot_noise}};
    return subjects;
}
