// SPDX-License-Identifier: MIT
//
// cubemap-octree: maps of the analytic room, what is asked of them, and what is refused in one line.

#include "image_cases.hpp"
#include "picture.hpp"

#include "modules/octree/io/vdb_file.h"
#include "modules/scene/io/ply_file.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <stdexcept>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace
{

constexpr double turn = 6.283185307179586;
constexpr int path_views = 8;

// Camera to world: it stands on a circle of half a metre and looks outwards.
std::string octree_pose(int view, double time)
{
    const double angle = turn * view / path_views;
    const double c = std::cos(angle / 2), s = std::sin(angle / 2);
    char text[300];
    std::snprintf(text, sizeof text, "%.6f %.17g %.17g 1.3 %.17g %.17g %.17g %.17g\n", time,
                  0.5 * std::cos(angle), 0.5 * std::sin(angle), -c / 2 - s / 2, c / 2 - s / 2,
                  -c / 2 + s / 2, c / 2 + s / 2);
    return text;
}

std::string poses_between(int first, int end)
{
    std::string text;
    for (int i = first; i < end; ++i)
    {
        text += octree_pose(i, 1 + 0.1 * i);
    }
    return text;
}

void make_room(const std::string &name, int first, int end)
{
    write_file("path.txt", poses_between(first, end));
    does("scene render room camera.json path.txt -o " + name + " --quiet");
}

// The room as eight views of 96 x 72 pixels, and a map of it with voxels of 5 cm.
void make_octree_inputs()
{
    write_file("camera.json",
               "{\"width\":96,\"height\":72,\"fx\":80,\"fy\":80,\"cx\":47.5,\"cy\":35.5}");
    write_file("pose.txt", octree_pose(0, 1));
    make_room("room", 0, path_views);
    std::filesystem::create_directory("made");
}

void make_octree_map()
{
    make_octree_inputs();
    does("octree integrate room -o room.map --edge 0.05 --color --quiet --threads 1");
}

// The number behind a key of JSON.
double json_value(const std::string &text, const std::string &key)
{
    const std::size_t at = text.find("\"" + key + "\": ");
    if (at == std::string::npos)
    {
        throw std::runtime_error("there is no " + key + " in " + text);
    }
    return std::atof(text.c_str() + at + key.size() + 4);
}

void expect(bool good, const std::string &what)
{
    if (!good)
    {
        throw std::runtime_error(what);
    }
}

std::size_t lines_in(const std::string &text)
{
    std::size_t count = 0;
    for (const char each : text)
    {
        count += each == '\n' ? 1 : 0;
    }
    return count;
}

void integrates()
{
    make_octree_inputs();
    says("integrate tells in JSON",
         "^\\{\"views\": 8, \"ms_per_view\": \\{\"median\": [0-9.e-]+, \"max\": [0-9.e-]+\\}, "
         "\"occupied\": [1-9][0-9]+, \"free\": [1-9][0-9]+, \"bytes\": [1-9][0-9]+, ",
         "octree integrate room -o room.map --edge 0.05 --color --json");
    const Ran ran = does("octree integrate room -o one.map --edge 0.05 --color --json --threads 1");
    does("octree extract room.map -o room.xyz");
    does("octree extract one.map -o one.xyz");
    result(same_content("room.xyz", "one.xyz"), "the same voxels with one thread");
    holds("as many voxels are extracted as are told",
          [&ran]
          {
              expect(json_value(ran.out, "occupied") ==
                         static_cast<double>(lines_in(content_of("one.xyz"))),
                     ran.out);
          });
    says("a map is written anew", "\"views\": 8, ",
         "octree integrate room -o one.map --edge 0.05 --json");
    says("info tells what it is of", "\"color\": false, \"views\": 8, \"complete\": true",
         "octree info one.map --json");
    says("info tells people", "8 views", "octree info room.map");
    says("a map that no view sees", "\"occupied\": 0, \"free\": 0, .*\"views_without_depth\": 0",
         "octree integrate room -o small.map --edge 0.05 --levels 1 --centre 9,0,9 --json");
    passes("all options at once",
           "octree integrate room -o all.map --edge 0.1 --color --footprint 1 --memory 64M --noise "
           "0.01 --near 0.1 --far 8 --no-return-free --log-odds 0.85,-0.4,-2,3.5 --centre 0,0,1 "
           "--levels 10 --camera camera.json --threads 2 --save-every 3 --quiet");
    says("no space is free with endpoints only", "\"occupied\": [1-9][0-9]*, \"free\": 0",
         "octree integrate room -o ends.map --edge 0.1 --endpoints-only --json");
    says("endpoints only is told", "\"endpoints_only\": true", "octree info ends.map --json");
    says("log-odds are told", "\"rule\": \"log-odds\", \"log_odds\": \\[0.85, -0.4, -2, 3.5\\]",
         "octree info all.map --json");
}

void asks()
{
    make_octree_map();
    const Ran ran =
        run_with_input("1.5 0 1.3\n# walls\n\n3.001 0 1.3\n-3.001 0.1 1.3\n0 0 50\n1e9 0 0\n",
                       "octree query room.map");
    result(ran.status == 0 && ran.err.empty() &&
               matches(ran.out,
                       "^free 0.05 0 0 0\n# walls\n\noccupied 0.05 217 115 89\n"
                       "occupied 0.05 102 153 204\nunknown 0.05 0 0 0\nunknown 0 0 0 0\n$"),
           "query answers lines", ran.out + ran.err);
    const Ran coarse = run_with_input("1.5 0 1.3\n", "octree query room.map --level 2");
    result(coarse.out == "free 0.2 0 0 0\n", "query at a level", coarse.out);
    const Ran rays = run_with_input("0 0 1.3 1 0 0\n0 0 1.3 2 0 0\n0 0 1.3 0 0 1e-3\n0 0 9 0 0 1\n",
                                    "octree ray room.map");
    std::istringstream words(rays.out);
    double first = 0, second = 0;
    std::string rest;
    words >> first;
    std::getline(words, rest);
    words >> second;
    result(std::fabs(first - 3) < 0.1 && first == second && rest == " 217 115 89" &&
               matches(rays.out, "none\n$"),
           "ray answers lines", rays.out + rays.err);
    const Ran near = run_with_input("0 0 1.3 1 0 0\n", "octree ray room.map --far 1");
    result(near.out == "none\n", "ray up to --far", near.out);
    const Ran wrong = run_with_input("1.5 0 1.3\n0 0 x\n", "octree query room.map");
    result(wrong.status == 1 && wrong.out == "free 0.05 0 0 0\n" &&
               matches(wrong.err, "^cubemap-octree: standard input, line 2: '0 0 x' is not three "
                                  "numbers x y z\n$"),
           "a line that is no point is told", wrong.err);
    const Ran more = run_with_input("0 0 1 1 0 0 7\n", "octree ray room.map");
    result(more.status == 1 && matches(more.err, "line 1: .* is not six numbers"),
           "a line with more numbers is told", more.err);
    const Ran zero = run_with_input(std::string("0 0 1\0 2\n1 0 1\n", 15), "octree query room.map");
    result(zero.status == 1 && zero.out.empty() && matches(zero.err, "line 1: .* is not three"),
           "a line with a byte that is 0 is told", zero.out + zero.err);
    const Ran cut = run_with_input("0 0 1" + std::string(1, '\0') + std::string(8000, '1') + "\n",
                                   "octree query room.map");
    result(cut.status == 1 && cut.out.empty() && matches(cut.err, "line 1: .* is too long"),
           "a long line is one, whatever is in it", cut.out + cut.err);
    const Ran none = run_with_input("nan 0 1\n", "octree query room.map");
    result(none.status == 1, "what is no number is told", none.err);
}

void check_xyz()
{
    std::istringstream lines(content_of("room.xyz"));
    std::string questions, line;
    for (int i = 0; i < 50 && std::getline(lines, line); ++i)
    {
        questions += line.substr(0, line.find(' ', line.find(' ', line.find(' ') + 1) + 1)) + "\n";
    }
    const Ran ran = run_with_input(questions, "octree query room.map");
    std::istringstream answers(ran.out);
    lines.seekg(0);
    std::string answer;
    while (std::getline(answers, answer) && std::getline(lines, line))
    {
        // x y z EDGE R G B, and occupied EDGE R G B
        expect(answer == "occupied" + line.substr(line.find(" 0.05 ")), line + ": " + answer);
    }
}

void extracts()
{
    make_octree_map();
    passes("extract xyz", "octree extract room.map --level 0 -o room.xyz");
    holds("voxels of xyz are occupied where they are asked", check_xyz);
    const Ran stream = passes("extract to standard output", "octree extract room.map -o -");
    result(stream.out == content_of("room.xyz"), "the same lines in a file");
    passes("extract ply", "octree extract room.map -o room.ply");
    holds("ply has a point a voxel",
          []
          {
              cm_ply ply = {};
              char message[CM_IMAGE_MESSAGE] = "";
              expect(cm_ply_read("room.ply", &ply, message) == CM_OK, message);
              const std::size_t lines = lines_in(content_of("room.xyz"));
              const bool good = ply.point_count == lines && ply.color != nullptr;
              cm_ply_clear(&ply);
              expect(good, "another number of points, or no colours");
          });
    passes("extract ply with its ending in capitals", "octree extract room.map -o ROOM.PLY");
    result(content_of("ROOM.PLY") == content_of("room.ply"), "the same ply");
    const Ran coarse = passes("extract at a level", "octree extract room.map --level 3 -o -");
    result(lines_in(coarse.out) * 4 < lines_in(stream.out) && matches(coarse.out, " 0.4 "),
           "fewer voxels at a level");
    if (cm_vdb_is_there() != 0)
    {
        passes("extract vdb", "octree extract room.map --format vdb -o room.vdb");
        result(content_of("room.vdb").substr(0, 4) == " BDV", "vdb is a file of OpenVDB");
    }
    else
    {
        fails("vdb is refused", 1, "no OpenVDB",
              "octree extract room.map --format vdb -o made/room.vdb");
    }
    fails("no such level", 2, "--level is above the 16 levels",
          "octree extract room.map --level 17 -o made/x");
    fails("the map in its own place", 2, "the map itself",
          "octree extract room.map -o ./room.map --level 2");
    passes("the map is still one", "octree info room.map");
    fails("ply on standard output", 2, "for xyz", "octree extract room.map --format ply -o -");
}

void draws()
{
    make_octree_map();
    passes("render", "octree render room.map camera.json pose.txt -o view.png --depth depth.exr");
    holds("the picture is the room's",
          []
          {
              const Picture seen("view.png");
              const Picture truth("room/rgb/1.000000.png");
              int near = 0;
              for (int y = 0; y < 72; ++y)
              {
                  for (int x = 0; x < 96; ++x)
                  {
                      double off = 0;
                      for (int i = 0; i < 3; ++i)
                      {
                          off +=
                              std::fabs(static_cast<double>(seen.at(x, y)[i] - truth.at(x, y)[i]));
                      }
                      near += off < 0.15 ? 1 : 0;
                  }
              }
              expect(near > 96 * 72 * 9 / 10, std::to_string(near) + " pixels are near");
          });
    holds("depth is the room's",
          []
          {
              const Picture depth("depth.exr");
              expect(std::fabs(depth.first(70, 10) - 2.5) < 0.1, // the wall at 3 m from 0.5
                     std::to_string(depth.first(70, 10)));
          });
    passes("render with a light",
           "octree render room.map camera.json pose.txt -o lit.png --light 0,0,2 --threads 1");
    result(!same_content("lit.png", "view.png"), "a light changes the picture");
    passes("probe",
           "octree probe room.map --at 0,0,1.2 --to cube:coupled --size 16 -o probe_%f.exr");
    result(matches(names_in("."), "probe_0.exr .*probe_5.exr"), "a probe has six faces",
           names_in("."));
    passes("a probe in a layout",
           "octree probe room.map --at 0,0,1.2 --to cube:coupled;layout=cross "
           "--size 16 -o cross.exr");
    does("reproject --quiet --from cube:coupled --to cube:coupled;layout=cross probe_%f.exr "
         "laid.exr");
    passes("which has the faces in their places", "compare --quiet --max 0 cross.exr laid.exr");
    passes("probe on one square",
           "octree probe room.map --at 0,0,1.2 --to octahedral --size 24 -o square.exr");
    write_file("mesh.obj", "v 2 -0.3 1\nv 2 0.3 1\nv 2 0 1.5\nf 1 2 3\n");
    passes("render with a mesh",
           "octree render room.map camera.json pose.txt -o mesh.png --mesh mesh.obj");
    result(!same_content("mesh.png", "view.png"), "a mesh changes the picture");
    fails("depth as PNG", 2, "--depth is .*no floats",
          "octree render room.map camera.json pose.txt -o made/v.png --depth made/d.png");
    fails("a probe without a mapping", 2, "has no faces of a mapping",
          "octree probe room.map --at 0,0,1 --to equirect --size 16 -o made/p.exr");
    fails("a probe of twelve faces", 2, "drawn on one square or on six faces",
          "octree probe room.map --at 0,0,1 --to healpix --size 16 -o made/p.exr");
    fails("a probe of two sizes", 2, "has a size already",
          "octree probe room.map --at 0,0,1 --to cube:qsc;size=8 --size 16 -o made/p_%f.exr");
    fails("a probe nowhere", 2, "--at X,Y,Z is needed", "octree probe room.map -o made/p_%f.exr");
    write_file("two.txt", poses_between(0, 2));
    fails("two poses", 1, "has 2 poses; one is needed",
          "octree render room.map camera.json two.txt -o made/v.png");
    fails("no such level to draw", 2, "--level is above the 16 levels of 'room.map'",
          "octree render room.map camera.json pose.txt -o made/v.png --level 17");
    fails("no such level of a probe", 2, "--level is above the 16 levels of 'room.map'",
          "octree probe room.map --at 0,0,1 -o made/p_%f.exr --level 17");
    fails("no such mesh", 1, "absent.obj",
          "octree render room.map camera.json pose.txt -o made/v.png --mesh absent.obj");
}

void merges()
{
    make_octree_inputs();
    make_room("first", 0, 4);
    make_room("second", 4, path_views);
    does("octree integrate room -o room.map --edge 0.05 --quiet");
    does("octree integrate first -o first.map --edge 0.05 --quiet");
    does("octree integrate second -o second.map --edge 0.05 --quiet");
    says("merge",
         "\"views\": 8, \"occupied\": ", "octree merge first.map second.map -o both.map --json");
    does("octree merge second.map first.map -o turned.map");
    does("octree extract room.map -o room.xyz");
    does("octree extract both.map -o both.xyz");
    does("octree extract turned.map -o turned.xyz");
    result(same_content("room.xyz", "both.xyz"), "two maps merged are the map of all views");
    result(same_content("room.xyz", "turned.xyz"), "in any order");
    const double counts[2] = {json_value(does("octree info room.map --json").out, "free"),
                              json_value(does("octree info both.map --json").out, "free")};
    result(counts[0] == counts[1], "and free voxels, too");
    passes("merge into itself", "octree merge room.map room.map -o room.map");
    does("octree integrate first -o odds.map --edge 0.05 --quiet --log-odds 0.85,-0.4,-2,3.5");
    fails("two rules", 1, "different rules", "octree merge first.map odds.map -o made/x");
}

void resumes()
{
    make_octree_inputs();
    does("octree integrate room -o whole.map --edge 0.05 --color --quiet");
    const std::string broken = "room/depth/1.500000.png";
    const std::string good = content_of(broken);
    write_file(broken, good.substr(0, good.size() / 2));
    const std::string command =
        "octree integrate room -o run.map --edge 0.05 --color --save-every 2";
    const Ran ended = run(command + " --quiet");
    result(ended.status == 1 && matches(ended.err, broken), "a broken view ends the run",
           ended.err);
    says("the map has what was committed", "\"views\": 4, \"complete\": false",
         "octree info run.map --json");
    write_file(broken, good);
    says("the same command goes on", "\"views\": 8, .*\"resumed_at\": 4",
         command + " --json --memory 64M --threads 2");
    does("octree extract whole.map -o whole.xyz");
    does("octree extract run.map -o run.xyz");
    result(same_content("whole.xyz", "run.xyz"), "the map is the one of a run in one piece");
    write_file(broken, good.substr(0, good.size() / 2));
    run(command + " --quiet");
    write_file(broken, good);
    write_file("begun.map", ""); // of a run that was killed before its first byte
    says("a file without a byte is gone on with", "\"views\": 8, .*\"resumed_at\": 0",
         "octree integrate room -o begun.map --edge 0.1 --json");
    says("another command begins anew", "\"views\": 8, .*\"resumed_at\": 0",
         "octree integrate room -o run.map --edge 0.1 --json");
    // the same camera and poses in another world
    write_file(broken, good.substr(0, good.size() / 2));
    run("octree integrate room -o world.map --edge 0.1 --save-every 2 --quiet");
    does("scene render corridor camera.json path.txt -o corridor --quiet");
    says("nor does another scene go on", "\"views\": 8, .*\"resumed_at\": 0",
         "octree integrate corridor -o world.map --edge 0.1 --json");
}

// What a run writes is not replaced by others meanwhile.
void keeps_what_is_in_use()
{
    make_octree_map();
    does("octree integrate room -o used.map --edge 0.1 --quiet");
    const std::string old = content_of("used.map");
    const int file = open("used.map", O_RDWR | O_CLOEXEC);
    expect(file >= 0 && flock(file, LOCK_EX | LOCK_NB) == 0, "the map cannot be locked");
    for (const std::string command : {"merge room.map room.map", "hull room --edge 0.1 --levels 5",
                                      "integrate room --edge 0.1 --quiet"})
    {
        fails(command + " into a map that a run writes", 1, "used.map' is in use",
              "octree " + command + " -o used.map");
    }
    result(content_of("used.map") == old, "it is as it was");
    close(file);
    passes("then it can be replaced", "octree merge room.map room.map -o used.map");
}

// A map is there until the one that takes its place is complete, whatever ends the run that makes that.
void keeps_old_maps()
{
    make_octree_inputs();
    does("octree integrate room -o kept.map --edge 0.1 --quiet");
    const std::string old = content_of("kept.map");
    const std::string first = "room/depth/1.000000.png", later = "room/depth/1.500000.png";
    for (const std::string &broken : {first, later})
    {
        const std::string good = content_of(broken);
        write_file(broken, good.substr(0, good.size() / 2));
        const Ran ended =
            run("octree integrate room -o kept.map --edge 0.05 --save-every 2 --quiet");
        result(ended.status == 1 && content_of("kept.map") == old,
               "the old map survives a broken view", ended.err);
        write_file(broken, good);
        result(std::filesystem::exists("kept.map.unfinished") == (broken == later),
               "what was committed is beside it, and nothing else");
    }
    says("that is a map, too", "\"views\": 4, \"complete\": false",
         "octree info kept.map.unfinished --json");
    std::filesystem::create_symlink("kept.map", "link.map");
    says("the same command goes on", "\"views\": 8, .*\"resumed_at\": 4",
         "octree integrate room -o link.map --edge 0.05 --save-every 2 --json");
    result(!std::filesystem::exists("kept.map.unfinished") &&
               std::filesystem::is_symlink("link.map"),
           "the new map takes the old one's place");
    does("octree integrate room -o fresh.map --edge 0.05 --quiet");
    does("octree extract kept.map -o kept.xyz");
    does("octree extract fresh.map -o fresh.xyz");
    result(same_content("kept.xyz", "fresh.xyz"), "and is that of the new command");
    /* a run that was ended before its map, which was complete, came to its place */
    std::filesystem::rename("fresh.map", "kept.map.unfinished");
    says("a complete map comes to its place", "\"views\": 8, .*\"resumed_at\": 8",
         "octree integrate room -o kept.map --edge 0.05 --json");
    result(!std::filesystem::exists("kept.map.unfinished"), "and is beside no more");
    does("octree integrate room -o kept.map.unfinished --edge 0.2 --quiet");
    const std::string mine = content_of("kept.map.unfinished");
    fails("the map of another command is in the way", 1, "kept.map.unfinished.*complete map",
          "octree integrate room -o kept.map --edge 0.1");
    result(content_of("kept.map.unfinished") == mine, "and stays as it is");
    write_file("kept.map.unfinished", "mine");
    fails("a file that is no map is in the way", 1, "kept.map.unfinished",
          "octree integrate room -o kept.map --edge 0.1");
}

// Black everywhere, and opaque.
void make_opaque_mask(const std::string &name, int width, int height)
{
    std::string targa("\0\0\2\0\0\0\0\0\0\0\0\0", 12);
    for (const int number : {width & 255, width >> 8, height & 255, height >> 8, 32, 40})
    {
        targa += static_cast<char>(number);
    }
    for (int i = 0; i < width * height; ++i)
    {
        targa += std::string("\0\0\0\377", 4);
    }
    write_file(name, targa);
}

// Masks have no depth, and may be opaque where they are black.
void carves_files_of_others(const std::string &hull)
{
    std::filesystem::rename("masks/depth.txt", "masks/kept.txt");
    std::filesystem::rename("masks/depth", "masks/kept");
    const Ran ran = passes("hull of colours alone",
                           "octree hull masks -o flat.map --edge 0.02 --centre 0,0,1.3 "
                           "--levels 6 --outside dies --json");
    result(ran.out == hull, "depth is not needed", ran.out + hull);
    std::filesystem::rename("masks/kept.txt", "masks/depth.txt");
    std::filesystem::rename("masks/kept", "masks/depth");
    std::filesystem::create_directory("opaque");
    std::filesystem::copy("masks/camera.json", "opaque/camera.json",
                          std::filesystem::copy_options::overwrite_existing);
    write_file("opaque/groundtruth.txt", "1 0 0 0 0 0 0 1\n");
    write_file("opaque/rgb.txt", "1 black.tga\n");
    const Picture mask("masks/rgb/1.000000.png");
    make_opaque_mask("opaque/black.tga", mask.width, mask.height);
    const Ran black = passes("an opaque black mask", "octree hull opaque -o flat.map --edge 0.02 "
                                                     "--levels 6 --outside dies --json");
    result(json_value(black.out, "occupied") == 0, "alpha is no colour", black.out);
    write_file("opaque/rgb.txt", "1 black.tga\n2 away.tga\n");
    write_file("opaque/groundtruth.txt", "1 0 0 0 0 0 0 1\n2 0 0 0 0 0 0 1\n");
    fails("a mask that is missing", 1, "away.tga", "octree hull opaque -o made/x --edge 0.02");
}

void carves()
{
    make_octree_inputs();
    write_file("body.json", "{\"spheres\":[{\"centre\":[0,0,1.3],\"radius\":0.2}]}");
    std::string path;
    for (int i = 0; i < path_views; ++i)
    {
        // from the circle to its middle: half a turn on
        std::string line = octree_pose((i + path_views / 2) % path_views, 1 + i);
        const std::string from = octree_pose(i, 1 + i);
        std::istringstream turned(line), placed(from);
        std::string word, kept;
        for (int k = 0; k < 8; ++k)
        {
            std::string other;
            turned >> word;
            placed >> other;
            kept += (k > 0 ? " " : "") + (k < 4 ? other : word);
        }
        path += kept + "\n";
    }
    write_file("path.txt", path);
    does("scene render body.json camera.json path.txt -o masks --quiet");
    const Ran ran = passes("hull", "octree hull masks -o hull.map --edge 0.02 --centre 0,0,1.3 "
                                   "--levels 6 --outside dies --json");
    // a sphere of 0.2 m seen from a circle: no less than it, no more than the cylinder and cones around it
    const double volume = json_value(ran.out, "occupied") * 0.02 * 0.02 * 0.02;
    const double ball = turn * 2 / 3 * 0.2 * 0.2 * 0.2;
    result(volume > ball && volume < 1.6 * ball, "the hull is around the body",
           std::to_string(volume / ball));
    const Ran asked = run_with_input("0 0 1.3\n0.15 0 1.3\n0.3 0 1.3\n", "octree query hull.map");
    result(asked.out == "occupied 0.02 0 0 0\noccupied 0.02 0 0 0\nfree 0.02 0 0 0\n",
           "inside is occupied, outside free", asked.out);
    carves_files_of_others(ran.out);
    std::filesystem::remove("masks/rgb.txt");
    fails("no masks", 1, "view 1 has no colours", "octree hull masks -o made/x --edge 0.02");
}

void saves_memory()
{
    make_octree_inputs();
    does("octree integrate room -o whole.map --edge 0.02 --color --quiet");
    const Ran ran =
        passes("integrate below a ceiling",
               "octree integrate room -o small.map --edge 0.02 --color --memory 1M --json");
    result(json_value(ran.out, "paged") > 0, "some of it is in the file alone", ran.out);
    does("octree extract whole.map -o whole.xyz");
    passes("extract below a ceiling", "octree extract small.map --memory 1M -o small.xyz");
    result(same_content("whole.xyz", "small.xyz"), "it is the same map");
    passes("render below a ceiling",
           "octree render small.map camera.json pose.txt --memory 1M -o small.png");
    does("octree render whole.map camera.json pose.txt -o whole.png");
    result(same_content("whole.png", "small.png"), "it looks the same");
    const Ran budget =
        passes("a budget", "octree integrate room -o b.map --edge 0.01 --budget 0.04 --json");
    result(json_value(budget.out, "edge") == 0.04 &&
               matches(budget.out,
                       "\"budget\": \\{\"subject\": \"octree\", \"unit\": \"m\", .*finer "
                       "voxels.*free space voxel by voxel.*a byte for each counter"),
           "the coarsest voxels that keep it", budget.out);
    fails("a budget below what voxels keep", 2, "--budget is less than",
          "octree integrate room -o made/x --edge 0.1 --budget 0.01");
}

void refuses_words()
{
    make_octree_inputs();
    fails("no command", 2, "a command is needed", "octree");
    fails("no such command", 2, "did you mean query", "octree quary");
    fails("no folder", 2, "DIR is needed, 0 are given", "octree integrate -o made/x --edge 0.1");
    fails("no output", 2, "-o MAP is needed", "octree integrate room --edge 0.1");
    fails("output to a pipe", 2, "not a file", "octree integrate room -o - --edge 0.1");
    fails("an edge of nothing", 2, "--edge", "octree integrate room -o made/x --edge 0");
    fails("an edge below 0", 2, "--edge", "octree integrate room -o made/x --edge -0.1");
    fails("too many levels", 2, "--levels", "octree integrate room -o made/x --levels 21");
    fails("low above high", 2, "--log-odds",
          "octree integrate room -o made/x --log-odds 0.8,-0.4,2,-2");
    fails("three numbers of four", 2, "--log-odds",
          "octree integrate room -o made/x --log-odds 0.8,-0.4,2");
    fails("near beyond far", 2, "--near is not below --far",
          "octree integrate room -o made/x --near 3 --far 2");
    fails("free without an end", 2, "--no-return-free needs --far",
          "octree integrate room -o made/x --no-return-free");
    fails("free and no free space", 2, "contradict",
          "octree integrate room -o made/x --far 2 --no-return-free --endpoints-only");
    fails("a centre of two numbers", 2, "three numbers X,Y,Z",
          "octree integrate room -o made/x --centre 1,2");
    fails("no memory at all", 2, "a size, such as", "octree integrate room -o made/x --memory 0");
}

void refuses_files()
{
    make_octree_map();
    fails("no such map", 1, "absent.map", "octree query absent.map");
    write_file("text.map", "no map, but some text that is longer than a head\n");
    fails("no map", 1, "text.map", "octree info text.map");
    fails("a file that is no map stays", 1, "text.map",
          "octree integrate room -o text.map --edge 0.1");
    result(matches(content_of("text.map"), "^no map"), "it is as it was");
    const std::string map = content_of("room.map");
    write_file("cut.map", map.substr(0, map.size() / 2));
    fails("a map that is cut", 1, "cut.map", "octree info cut.map");
    write_file("cut.bt", "# Octomap OcTree binary file\nid OcTree\nsize 9\nres 0.1\ndata\n\x01");
    fails("a map of OctoMap that is cut", 1, "cut.bt: is cut", "octree info cut.bt");
    write_file("bad.json", "{\"width\":96}");
    fails("no camera", 1, "bad.json", "octree integrate room -o made/x --camera bad.json");
    write_file("camera2.json",
               "{\"width\":48,\"height\":72,\"fx\":80,\"fy\":80,\"cx\":23.5,\"cy\":35.5}");
    fails("another camera", 1, "room/depth",
          "octree integrate room -o made/x --camera camera2.json");
}

void refuses_views()
{
    make_octree_inputs();
    write_file("far.txt", octree_pose(0, 1) + "2 5000 0 1.2 0.5 -0.5 0.5 -0.5\n");
    does("scene render room camera.json far.txt -o far --quiet");
    fails("a pose that is kilometres away", 1, "view 2 at 2.000000 s is [0-9.]+ from the map",
          "octree integrate far -o made/x --edge 0.01");
    write_file("huge.json",
               "{\"width\":96,\"height\":72,\"fx\":80,\"fy\":80,\"cx\":47.5,\"cy\":35.5,"
               "\"depth_scale\":1e-6}");
    fails("depths beyond all maps", 1,
          "view 1 at 1.000000 s has depths up to [0-9.]+e\\+[0-9]+, .*--far says how far",
          "octree integrate room -o made/x --edge 0.05 --camera huge.json");
    says("but a small map is free", "\"occupied\": 0, \"free\": [1-9]",
         "octree integrate room -o free.map --edge 0.05 --camera huge.json --levels 8 --json");
    says("and a large one up to where a sensor sees", "\"occupied\": 0, \"free\": [1-9]",
         "octree integrate room -o free.map --edge 0.05 --camera huge.json --far 2 --json");
    write_file("nothing.json", "{\"spheres\":[{\"centre\":[0,0,-9],\"radius\":0.1}]}");
    does("scene render nothing.json camera.json pose.txt -o nothing --quiet");
    fails("views without a pixel", 1, "none of its 1 views has a pixel",
          "octree integrate nothing -o made/x --edge 0.05");
    says("but they may be free", "\"occupied\": 0, \"free\": [1-9]",
         "octree integrate nothing -o free.map --edge 0.05 --far 2 --no-return-free --json");
    write_file("path.txt", octree_pose(0, 1));
    fails("no such folder", 1, "absent", "octree integrate absent -o made/x --edge 0.1");
    does("octree integrate room -o fine.map --edge 0.02 --quiet");
    {
        const SizeLimit limit(40000);
        fails("no room for the map", 1, "'made/x': cannot be read or written",
              "octree integrate room -o made/x --edge 0.01 --save-every 1");
        fails("no room for another map", 1,
              "'made/y' cannot be written: cannot be read or written; nothing is changed",
              "octree merge fine.map fine.map -o made/y");
    }
    {
        const SizeLimit limit(131072);
        fails("no room for all of the map", 1,
              "'kept.map': cannot be read or written.*; 'kept.map' is as it was committed last, "
              "and the "
              "same command goes on from there",
              "octree integrate room -o kept.map --edge 0.01 --save-every 1");
    }
    says("what was kept is there", "\"views\": [1-7], \"complete\": false",
         "octree info kept.map --json");
}

} // namespace

const std::vector<Subject> &octree_subjects()
{
    static const std::vector<Subject> subjects = {{"integrate", integrates},
                                                  {"ask", asks},
                                                  {"extract", extracts},
                                                  {"draw", draws},
                                                  {"merge", merges},
                                                  {"resume", resumes},
                                                  {"in use", keeps_what_is_in_use},
                                                  {"old maps", keeps_old_maps},
                                                  {"hull", carves},
                                                  {"memory", saves_memory},
                                                  {"refused words", refuses_words},
                                                  {"refused files", refuses_files},
                                                  {"refused views", refuses_views}};
    return subjects;
}
