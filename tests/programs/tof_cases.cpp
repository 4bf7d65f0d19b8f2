// SPDX-License-Identifier: MIT
//
// cubemap-tof: a sphere and walls whose distances are known, and what lies in the folder.

#include "image_cases.hpp"
#include "picture.hpp"
#include "tof_inputs.hpp"

#include "modules/scene/io/npy_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>

namespace
{

// One whose frames are shorter than any buffer.
constexpr const char *small_sensor =
    R"({"camera": {"width": 4, "height": 3, "fx": 4, "fy": 4, "cx": 1.5, "cy": 1}, "pitch": 12e-6, "f_number": 1,
"wavelength": 850e-9, "efficiency": 0.4, "exposure": 1e-3, "frequency": 20e6, "phases": 4, "duty": 0.5, "contrast": 0.8,
"lights": [{"power": 1, "aperture": 6.28}]})";

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

// What one picture measures and the other does not is counted.
void evaluates()
{
    make_tof_inputs();
    write_file("narrow.json", sensor_text("\"lights\": [{\"power\": 1, \"aperture\": 0.5}]"));
    does("tof simulate wall.json sensor.json pose.txt -o whole --quiet");
    does("tof simulate wall.json narrow.json pose.txt -o part --quiet");
    const char *const whole = " whole/distance_0000.exr", *const part = " part/distance_0000.exr";
    std::size_t dark = 0;
    for (const float each : Picture("part/distance_0000.exr").values)
    {
        dark += std::isnan(each) ? 1 : 0;
    }
    const std::string forth = does(std::string("tof evaluate --json") + part + whole).out;
    const std::string back = does(std::string("tof evaluate --json") + whole + part).out;
    const auto counts = [](std::size_t count, std::size_t missing, std::size_t extra)
    {
        return "\"count\": " + std::to_string(count) + ", \"missing\": " + std::to_string(missing) +
               ", \"extra\": " + std::to_string(extra) + ",";
    };
    result(dark > 100 && dark < 400 && forth.find(counts(432 - dark, dark, 0)) != std::string::npos,
           "what is missing is counted", forth);
    result(back.find(counts(432 - dark, 0, dark)) != std::string::npos,
           "and what is there beyond the truth", back);
    says("and people are told",
         "432 pixels count; 0 have a distance in the truth alone, 0 in what was measured alone\n$",
         std::string("tof evaluate") + whole + whole);
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
    write_file(
        "table.csv",
        "\xef\xbb\xbf# with the mark of UTF-8\r\n0, 0, 0, 0.3\r\n30 30 180 0.3\n60, 60, 90, 0.3\n");
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

// A folder of an earlier run, into which another brings its first frame and no more.
void is_cut_short(const std::string &command, const std::string &picture, const std::string &last)
{
    write_file("paused.txt", "0 0 0 0 0 0 0 1\n1 0 0 0.2 0 0 0 1\n2 0 0 0.5 0 0 0 1\n");
    const std::string line = "tof " + command + " -o again" + last + " --quiet";
    const std::string folder = "again" + last + "/";
    does(line + " wall.json " + (command == "texel" ? "" : "sensor.json ") + "path.txt");
    const std::string end = content_of(folder + last);
    std::filesystem::remove(folder + picture + "_0000.exr");
    std::filesystem::create_directory(folder + picture + "_0000.exr");
    const std::string other =
        line + " wall.json " + (command == "texel" ? "" : "sensor.json ") + "paused.txt";
    fails("a folder in the first frame's way: " + command, 1, "is a folder", other);
    result(content_of(folder + last) == end, last + " stays as long as its frames do");
    std::filesystem::remove(folder + picture + "_0000.exr");
    std::filesystem::remove(folder + picture + "_0001.exr");
    std::filesystem::create_directory(folder + picture + "_0001.exr");
    fails("a folder in the second's: " + command, 1, "is a folder", other);
    result(std::filesystem::is_regular_file(folder + picture + "_0000.exr") &&
               !std::filesystem::exists(folder + last),
           last + " of an earlier run is away where this one was not completed", names_in(folder));
}

void are_completed()
{
    make_tof_inputs();
    is_cut_short("simulate", "distance", "poses.txt");
    is_cut_short("texel", "depth", "matrices.txt");
}

} // namespace

const std::vector<Subject> &tof_subjects()
{
    static const std::vector<Subject> subjects = {
        {"tof_measures", measures},         {"tof_evaluates", evaluates},
        {"tof_folder", lies_in_a_folder},   {"tof_arrays", are_arrays},
        {"tof_hdf5", are_files_of_hdf5},    {"tof_texel", renders_texels},
        {"tof_sensors", knows_sensors},     {"tof_budgets", keeps_budgets},
        {"tof_shot_noise", has_shot_noise}, {"tof_completed", are_completed}};
    return subjects;
}
