// SPDX-License-Identifier: MIT
//
// What cubemap-scene renders, against closed forms in quadruple precision; what it tells, converts, measures and refuses.

#include "image_cases.hpp"
#include "picture.hpp"
#include "truth_picture.hpp"

#include "modules/scene/io/camera_file.h"
#include "truth/scenes/ray_truth.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <sstream>
#include <stdexcept>

#include <unistd.h>

#include <cubemap/camera.h>
#include <cubemap/world.h>

namespace
{

using Point = std::array<double, 3>;

constexpr int scene_width = 40;
constexpr int scene_height = 30;
constexpr double focal_length = 32;
constexpr double centre_column = 19.5;
constexpr double centre_row = 14.5;

// x right, y down, z forward; the camera looks along the world's x, and turns to the left by an angle about z.
struct TestPose
{
    Point position;
    double turn;

    Point world_of(const Point &ray) const
    {
        const Point straight = {ray[2], -ray[0], -ray[1]};
        return {std::cos(turn) * straight[0] - std::sin(turn) * straight[1],
                std::sin(turn) * straight[0] + std::cos(turn) * straight[1], straight[2]};
    }
    Point camera_of(const Point &world) const
    {
        const double x = world[0] - position[0], y = world[1] - position[1];
        const double along = std::cos(turn) * x + std::sin(turn) * y;
        const double left = -std::sin(turn) * x + std::cos(turn) * y;
        return {-left, -(world[2] - position[2]), along};
    }
    // As TUM writes it: half a turn about z times (-1/2, 1/2, -1/2, 1/2).
    std::string line(double time) const
    {
        const double c = std::cos(turn / 2), s = std::sin(turn / 2);
        char text[300];
        std::snprintf(text, sizeof text, "%.6f %.17g %.17g %.17g %.17g %.17g %.17g %.17g\n", time,
                      position[0], position[1], position[2], -c / 2 - s / 2, c / 2 - s / 2,
                      -c / 2 + s / 2, c / 2 + s / 2);
        return text;
    }
};

const std::array<TestPose, 3> test_poses = {
    {{{-1, 0.2, 1.2}, 0.1}, {{-0.95, 0.22, 1.21}, 0.12}, {{-0.9, 0.25, 1.19}, 0.16}}};

std::string time_of(std::size_t view)
{
    char text[40];
    std::snprintf(text, sizeof text, "%.6f", 1.5 + 0.1 * static_cast<double>(view));
    return text;
}

void write_scene_inputs()
{
    std::string path = "# a path\n";
    for (std::size_t i = 0; i < test_poses.size(); ++i)
    {
        path += test_poses[i].line(std::atof(time_of(i).c_str()));
    }
    write_file("path.txt", path);
    write_file("camera.json", "{\"width\":40,\"height\":30,\"fx\":32,\"fy\":32,\"cx\":19.5,"
                              "\"cy\":14.5}\n");
    write_file("cube.json", "{\"mapping\":\"coupled\",\"frame\":\"geo\",\"size\":16}\n");
}

struct PixelTruth
{
    Point ray;
    Point point;
    double depth;
    std::uint32_t id;
};

PixelTruth truth_of(const cm_scene *scene, const TestPose &pose, int x, int y)
{
    PixelTruth truth;
    truth.ray = {(x - centre_column) / focal_length, (y - centre_row) / focal_length, 1};
    const Point direction = pose.world_of(truth.ray);
    truth.depth = ray_truth(scene, pose.position.data(), direction.data(), &truth.id, nullptr);
    for (std::size_t i = 0; i < 3; ++i)
    {
        truth.point[i] = pose.position[i] + truth.depth * direction[i];
    }
    return truth;
}

// Is the point the first that the other view meets? Of what is hidden by nearly nothing nobody says.
bool is_seen(const cm_scene *scene, const TestPose &other, const Point &point, bool &clear)
{
    Point direction;
    std::uint32_t id;
    for (std::size_t i = 0; i < 3; ++i)
    {
        direction[i] = point[i] - other.position[i];
    }
    const double distance = ray_truth(scene, other.position.data(), direction.data(), &id, nullptr);
    clear = std::fabs(distance - (1 - 1e-6)) > 1e-7;
    return distance > 1 - 1e-6;
}

// Counts how many pixels of the flow have a value.
int check_flow(const cm_scene *scene, const TruthPicture &made, const std::string &name,
               const TestPose &other, const PixelTruth &truth, int x, int y)
{
    const Point local = other.camera_of(truth.point);
    const double column = centre_column + focal_length * local[0] / local[2];
    const double row = centre_row + focal_length * local[1] / local[2];
    const bool inside = local[2] > 0 && column >= -0.5 && column <= scene_width - 0.5 &&
                        row >= -0.5 && row <= scene_height - 0.5;
    bool clear = true;
    const bool seen = inside && is_seen(scene, other, truth.point, clear);
    const double flow = made.at(name + ".column", x, y);
    if (!clear)
    {
        return 0;
    }
    if (!seen)
    {
        if (!std::isnan(flow))
        {
            wrong_at(x, y, name + " of what is not seen", flow, NAN);
        }
        return 0;
    }
    near(name + ".column", x, y, x + flow, column, 1e-3);
    near(name + ".row", x, y, y + made.at(name + ".row", x, y), row, 1e-3);
    return 1;
}

void check_truth(const cm_scene *scene, std::size_t view)
{
    const TruthPicture made("made/room/truth/" + time_of(view) + ".exr");
    const Picture depth("made/room/depth/" + time_of(view) + ".png");
    const Picture color("made/room/rgb/" + time_of(view) + ".png");
    int flows = 0;
    for (int y = 0; y < scene_height; ++y)
    {
        for (int x = 0; x < scene_width; ++x)
        {
            const PixelTruth truth = truth_of(scene, test_poses[view], x, y);
            near("depth", x, y, made.at("depth", x, y), truth.depth, 1e-6);
            near("range", x, y, made.at("range", x, y),
                 truth.depth * std::hypot(truth.ray[0], truth.ray[1], 1), 1e-6);
            near("position.x", x, y, made.at("position.x", x, y), truth.point[0], 1e-6);
            near("position.z", x, y, made.at("position.z", x, y), truth.point[2], 1e-6);
            near("id", x, y, made.at("id", x, y), truth.id, 0);
            const double units = 5000 * truth.depth;
            const double stored = 65535 * depth.first(x, y);
            near("depth of the picture", x, y, stored, units, 0.51);
            const cm_primitive *const met = cm_scene_at(scene, truth.id);
            for (int i = 0; i < 3; ++i)
            {
                near("color", x, y, 255 * static_cast<double>(color.at(x, y)[i]),
                     std::round(255 * met->material.color[i]), 0.01);
            }
            if (view + 1 < test_poses.size())
            {
                flows += check_flow(scene, made, "forward", test_poses[view + 1], truth, x, y);
            }
            if (view > 0)
            {
                flows += check_flow(scene, made, "backward", test_poses[view - 1], truth, x, y);
            }
        }
    }
    if (flows < scene_width * scene_height / 2)
    {
        throw std::runtime_error("only " + std::to_string(flows) + " pixels have a flow");
    }
}

void check_room()
{
    cm_scene *made = nullptr;
    if (cm_scene_create_named("room", &made) != CM_OK)
    {
        throw std::runtime_error("no room");
    }
    const std::unique_ptr<cm_scene, void (*)(cm_scene *)> scene(made, cm_scene_destroy);
    for (std::size_t view = 0; view < test_poses.size(); ++view)
    {
        check_truth(scene.get(), view);
    }
}

// ---- cameras of other kinds, which move: what one pixel says, against its own ray and the projection of its point

// The camera's pixel of a point of the world; NaN if it has none.
std::array<double, 2> pixel_of(const cm_camera *camera, const TestPose &pose, const Point &point)
{
    const Point local = pose.camera_of(point);
    const cm_camera_options &options = *cm_camera_describe(camera);
    double column, row;
    cm_camera_project_array(camera, 1, &local[0], &local[1], &local[2], &column, &row);
    const double right = column - options.pixel_centre, down = row - options.pixel_centre;
    const bool inside = right >= -0.5 && right <= options.width - 0.5 && down >= -0.5 &&
                        down <= options.height - 0.5;
    return {inside ? right : NAN, inside ? down : NAN};
}

int check_moving_flow(const cm_scene *scene, const cm_camera *camera, const TruthPicture &made,
                      const std::string &name, const TestPose &other, const Point &point, int x,
                      int y)
{
    const std::array<double, 2> pixel = pixel_of(camera, other, point);
    bool clear = true;
    const bool seen = !std::isnan(pixel[0]) && is_seen(scene, other, point, clear);
    const double flow = made.at(name + ".column", x, y);
    if (clear && seen)
    {
        near(name + ".column", x, y, x + flow, pixel[0], 1e-3);
        near(name + ".row", x, y, y + made.at(name + ".row", x, y), pixel[1], 1e-3);
    }
    else if (clear && !std::isnan(flow))
    {
        wrong_at(x, y, name + " of what is not seen", flow, NAN);
    }
    return clear && seen;
}

// Returns how many flows there are.
int check_moving_pixel(const cm_scene *scene, const cm_camera *camera, const TruthPicture &made,
                       std::size_t view, int x, int y)
{
    const double centre = cm_camera_describe(camera)->pixel_centre;
    const double column = x + centre, row = y + centre;
    const TestPose &pose = test_poses[view];
    Point ray;
    cm_camera_ray_array(camera, 1, &column, &row, &ray[0], &ray[1], &ray[2]);
    if (std::isnan(ray[0]))
    {
        near("id without a ray", x, y, made.at("id", x, y), -1, 0);
        result(std::isnan(made.at("range", x, y)), "no range without a ray");
        return 0;
    }
    const Point direction = pose.world_of(ray);
    std::uint32_t id;
    const double times = ray_truth(scene, pose.position.data(), direction.data(), &id, nullptr);
    Point point;
    for (std::size_t i = 0; i < 3; ++i)
    {
        point[i] = pose.position[i] + times * direction[i];
    }
    near("range", x, y, made.at("range", x, y), times * std::hypot(ray[0], ray[1], ray[2]), 1e-6);
    near("position.x", x, y, made.at("position.x", x, y), point[0], 1e-6);
    near("position.y", x, y, made.at("position.y", x, y), point[1], 1e-6);
    near("position.z", x, y, made.at("position.z", x, y), point[2], 1e-6);
    near("id", x, y, made.at("id", x, y), id, 0);
    return check_moving_flow(scene, camera, made, "forward", test_poses[view + 1], point, x, y) +
           check_moving_flow(scene, camera, made, "backward", test_poses[view - 1], point, x, y);
}

void check_moving(const std::string &file, const std::string &folder)
{
    char message[CM_IMAGE_MESSAGE] = "";
    cm_camera *read = nullptr;
    cm_scene *made = nullptr;
    double depth_scale;
    if (cm_camera_file_read(file.c_str(), &read, &depth_scale, message) != CM_OK ||
        cm_scene_create_named("room", &made) != CM_OK)
    {
        throw std::runtime_error(message);
    }
    const std::unique_ptr<cm_camera, void (*)(cm_camera *)> camera(read, cm_camera_destroy);
    const std::unique_ptr<cm_scene, void (*)(cm_scene *)> scene(made, cm_scene_destroy);
    const cm_camera_options &options = *cm_camera_describe(read);
    const TruthPicture truth(folder + "/truth/" + time_of(1) + ".exr");
    int flows = 0;
    for (int y = 0; y < static_cast<int>(options.height); ++y)
    {
        for (int x = 0; x < static_cast<int>(options.width); ++x)
        {
            flows += check_moving_pixel(made, read, truth, 1, x, y);
        }
    }
    if (flows < static_cast<int>(options.width * options.height) / 2)
    {
        throw std::runtime_error("only " + std::to_string(flows) + " pixels have a flow");
    }
}

void moving()
{
    write_scene_inputs();
    write_file("lens.json",
               "{\"width\":40,\"height\":30,\"fx\":32,\"fy\":30,\"cx\":20.5,\"cy\":14.5,\"pixel_"
               "centre\":0.5,"
               "\"distortion\":[0.1,-0.02,0.001,-0.001,0.003,0.2,-0.05,0.01,0.001,0.0002,-0.001,"
               "0.0001,0.05,-0.03]}\n");
    write_file("fisheye.json",
               "{\"mapping\":\"azimuthal:equidistant\",\"frame\":\"geo\",\"size\":24}\n");
    write_file("half.json",
               "{\"mapping\":\"tangent\",\"frame\":\"gl\",\"size\":8,\"pixel_centre\":0.5}\n");
    for (const std::string name : {"lens", "cube", "fisheye", "half"})
    {
        does("scene render room " + name + ".json path.txt -o " + name + " --truth");
        holds(name + ": what pixels say of a camera that moves",
              [&name] { check_moving(name + ".json", name); });
    }
}

std::string content_of_all(const std::string &folder)
{
    std::string all;
    for (std::size_t i = 0; i < test_poses.size(); ++i)
    {
        all += content_of(folder + "/depth/" + time_of(i) + ".png");
    }
    return all;
}

// Of so many numbers the root mean square is within a tenth: 3600 of them have 1.2 % of deviation.
void check_noise()
{
    double sum = 0;
    int count = 0;
    for (std::size_t i = 0; i < test_poses.size(); ++i)
    {
        const Picture plain("made/room/depth/" + time_of(i) + ".png");
        const Picture noisy("one/depth/" + time_of(i) + ".png");
        for (int y = 0; y < scene_height; ++y)
        {
            for (int x = 0; x < scene_width; ++x, ++count)
            {
                const double error = noisy.first(x, y) / plain.first(x, y) - 1;
                sum += error * error;
            }
        }
    }
    near("the noise's part of range", 0, 0, std::sqrt(sum / count), 0.01, 0.001);
}

void rendering()
{
    write_scene_inputs();
    std::filesystem::create_directory("made");
    passes("render", "scene render room camera.json path.txt -o made/room --truth --quiet");
    result(names_in("made/room") ==
               "camera.json depth depth.txt groundtruth.txt rgb rgb.txt truth ",
           "the folder has what it should", names_in("made/room"));
    result(names_in("made") == "room ", "nothing else is left", names_in("made"));
    holds("the room is as its closed forms", check_room);
    sleep(1); // files have no time of writing in them
    does("scene render room camera.json path.txt -o again --threads 7 --truth --quiet");
    const std::string truth_file = "/truth/" + time_of(1) + ".exr";
    result(content_of("made/room" + truth_file) == content_of("again" + truth_file),
           "the same bits of truth a second later, and with 7 threads");
    does(
        "scene render room camera.json path.txt -o one --threads 1 --noise gaussian:0.01 --seed 3");
    does(
        "scene render room camera.json path.txt -o two --threads 2 --noise gaussian:0.01 --seed 3");
    does("scene render room camera.json path.txt -o seven --threads 7 --noise gaussian:0.01 --seed "
         "3");
    does("scene render room camera.json path.txt -o other --threads 7 --noise gaussian:0.01 --seed "
         "4");
    const std::string one = content_of_all("one");
    result(one == content_of_all("two") && one == content_of_all("seven"),
           "the same noise for any threads");
    result(one != content_of_all("other"), "another seed, other noise");
    holds("noise is as large as it should be", check_noise);
    does("scene render spheres cube.json path.txt -o cube --truth");
    holds("an omnidirectional camera holds range",
          []
          {
              const Picture depth("cube/depth/" + time_of(0) + ".png");
              const TruthPicture truth("cube/truth/" + time_of(0) + ".exr");
              near("width", 0, 0, depth.width, 16, 0);
              near("height", 0, 0, depth.height, 96, 0);
              for (int y = 0; y < 96; ++y)
              {
                  const double range = truth.at("range", 8, y);
                  const double stored = 65535 * depth.first(8, y);
                  const bool measured = range < 65535 / 5000.0;
                  near("range", 8, y, stored, measured ? 5000 * range : 0, 0.51);
              }
          });
}

// The pictures of depth in a folder of Open3D's.
std::string depths_of(const std::string &folder)
{
    std::string all;
    for (std::size_t i = 0; i < test_poses.size(); ++i)
    {
        all += content_of(folder + "/depth_0000" + std::to_string(i) + ".png");
    }
    return all;
}

void converting()
{
    write_scene_inputs();
    does("scene render corridor camera.json path.txt -o in");
    does("scene convert in --to open3d -o open");
    does("scene convert open --to tum -o back");
    does("scene convert back --to open3d -o again");
    const std::string depths = depths_of("open");
    result(!depths.empty() && depths == content_of_all("in") && depths == depths_of("again"),
           "depths are the same there and back");
    holds("poses are the same there and back",
          []
          {
              std::istringstream here(content_of("open/trajectory.log"));
              std::istringstream back(content_of("again/trajectory.log"));
              double one = 0, other = 0;
              int count = 0;
              for (; here >> one && back >> other; ++count)
              {
                  near("number of the log", count, 0, other, one, 1e-15); // by way of quaternions
              }
              near("numbers of the log", 0, 0, count, 19.0 * static_cast<double>(test_poses.size()),
                   0);
          });
    does("scene convert in --to 7scenes -o seven --quiet");
    does("scene convert seven --to open3d -o third");
    does("scene convert third --to 7scenes -o fourth");
    const std::string pose = "/frame-000002.pose.txt", depth = "/frame-000002.depth.png";
    result(content_of("seven" + pose) == content_of("fourth" + pose) &&
               content_of("seven" + depth) == content_of("fourth" + depth) &&
               content_of("third/trajectory.log") == content_of("open/trajectory.log"),
           "by way of 7-Scenes, too");
    // what is a multiple of a millimetre is kept: the second way there loses nothing, the first says what it lost
    result(matches(run("scene convert in --to 7scenes -o eight").err,
                   "eight: [0-9]+ depths rounded by up to 0\\.[45][0-9]* mm"),
           "what whole millimetres lose is told");
    does("scene convert eight --to tum -o ninth");
    result(!matches(does("scene convert ninth --to 7scenes -o tenth").err, "rounded"),
           "and nothing where nothing is lost");
    result(content_of("eight" + depth) == content_of("tenth" + depth),
           "whole millimetres come back");
    says("info says the scale and the rounding", "\"depth_scale\": 1000}, .*\"rounded_by\": 0.0005",
         "scene info ninth --json");
}

void telling()
{
    write_scene_inputs();
    does("scene render corridor camera.json path.txt -o in");
    says("info", "^corridor|tum: 3 views of 40 x 30 from 1.5", "scene info in");
    says("info as JSON",
         "\"views\": 3,.*\"skipped\": 0,.*\"poses\": 3,.*\"width\": 40,.*\"measured\": 1",
         "scene info in --json");
    write_file("away.json", R"({"spheres": [{"centre": [0, 0, -1e6], "radius": 1}]})");
    does("scene render away.json camera.json path.txt -o nothing");
    says("info of what sees nothing", "\ndepth nowhere: no pixel is measured\n$",
         "scene info nothing");
    std::filesystem::remove("in/depth/" + time_of(1) + ".png");
    says("what is absent is counted", "\"views\": 2, \"listed\": 3, \"skipped\": 1",
         "scene info in --json");
    passes("to 7-Scenes", "scene convert in --to 7scenes -o seven --quiet");
    says("from 7-Scenes", "\"layout\": \"7scenes\", \"views\": 2", "scene info seven --json");
    passes("to Open3D", "scene convert in --to open3d -o open --quiet");
    passes("and back", "scene convert open --to tum -o back --quiet");
    const std::string log = content_of("open/trajectory.log");
    write_file("open/trajectory.log", log.substr(0, log.find("\n1 ") + 1));
    says("of a log that was cut off", "\"views\": 1, \"listed\": 2, .*\"without_pose\": 1",
         "scene info open --json");
    result(std::filesystem::exists("back/groundtruth.txt"), "poses are there");
}

void evaluating()
{
    std::string truth, moved, line;
    for (int i = 0; i < 40; ++i)
    {
        const TestPose pose = {{std::sin(0.1 * i), std::cos(0.13 * i), 0.02 * i}, 0.05 * i};
        TestPose far = pose;
        far.position[0] += i % 2 == 0 ? 0.5 : 0.3;
        truth += pose.line(0.1 * i);
        moved += far.line(0.1 * i + 0.004);
        line += TestPose{{0.1 * i, 0, 0}, 0}.line(0.1 * i);
    }
    write_file("truth.txt", truth);
    write_file("moved.txt", moved);
    write_file("line.txt", line);
    const std::string number = "[0-9.]+e?-?[0-9]*";
    says("a trajectory against itself",
         "^\\{\"pairs\": 40, \"ate_rmse\": (0|" + number +
             "e-1[5-9]), \"rpe_translation_rmse\": (0|" + number +
             "e-1[5-9]), \"rpe_rotation_rmse_degrees\": (0|" + number +
             "e-1[3-9]), .*\"rank_deficient\": false\\}",
         "scene evaluate truth.txt truth.txt --json");
    says("10 cm to and fro", "\"pairs\": 40, \"ate_rmse\": 0.09[89]",
         "scene evaluate truth.txt moved.txt --json");
    says("in words", "^40 pairs", "scene evaluate truth.txt moved.txt");
    says("a line does not say how it is turned", "\"rank_deficient\": true",
         "scene evaluate line.txt line.txt --json");
    write_scene_inputs();
    does("scene render room camera.json path.txt -o r");
    says("what was rendered", "\"pairs\": 3, \"ate_rmse\": (0|" + number + "e-1[5-9]),",
         "scene evaluate path.txt r/groundtruth.txt --json");
    write_file("later.txt", test_poses[0].line(100));
    fails("no stamps in common", 1, "within 0.02 s", "scene evaluate truth.txt later.txt");
}

void scenes_of_json()
{
    write_scene_inputs();
    write_file("t.obj", "v 2 -5 -5\nv 2 5 -5\nv 2 0 9\nf 1 2 3\n");
    write_file(
        "all.json",
        "{\"planes\":[{\"point\":[0,0,0],\"normal\":[0,0,2],\"color\":[0.5,0.5,0.5]}],"
        "\"boxes\":[{\"min\":[4,-1,0],\"max\":[5,1,2],\"color\":[1,0,0],\"reflectance\":0.2}],"
        "\"spheres\":[{\"centre\":[3,1,1],\"radius\":0.5,\"color\":[0,1,0]}],"
        "\"cylinders\":[{\"from\":[3,-1,0],\"to\":[3,-1,2],\"radius\":0.2,\"color\":[0,0,1]}],"
        "\"meshes\":[{\"file\":\"t.obj\",\"position\":[5,0,0],\"quaternion\":[0,0,0,1],"
        "\"reflectance\":0.5}]}");
    passes("a scene of all kinds",
           "scene render all.json camera.json path.txt -o all --quiet --truth");
    passes("a mesh alone", "scene render t.obj camera.json path.txt -o mesh --quiet");
    std::filesystem::copy_file("t.obj", "T.OBJ");
    passes("a mesh with its ending in capitals",
           "scene render T.OBJ camera.json path.txt -o capitals --quiet");
    std::filesystem::copy_file("all.json", "ALL.JSON");
    passes("so a scene", "scene render ALL.JSON camera.json path.txt -o capitals2 --quiet");
    std::filesystem::create_directory("made");
    const auto refuses =
        [](const std::string &name, const std::string &text, const std::string &expression)
    {
        write_file("bad.json", text);
        fails(name, 1, expression, "scene render bad.json camera.json path.txt -o made/x");
    };
    refuses("no JSON", "{\n\"planes\":[,]}", "bad.json':2: is no JSON");
    refuses("text behind it", "{\"spheres\":[]} x", "is no JSON");
    refuses("an empty scene", "{}", "has nothing in it");
    refuses("an unknown list", "{\"cones\":[]}", "'cones' is not a list");
    refuses("an unknown member", "{\"spheres\":[{\"center\":[0,0,0]}]}",
            "spheres\\[0\\] has 'center'");
    refuses("too few numbers", "{\"spheres\":[{\"centre\":[0,0],\"radius\":1}]}",
            "bad.json':1: spheres\\[0\\].centre is not a list of 3 numbers");
    refuses("a radius of 0", "{\"spheres\":[{\"centre\":[0,0,0],\"radius\":0}]}",
            "bad.json':1: spheres\\[0\\].radius is 0, not a number above 0");
    refuses("a number too large", "{\"spheres\":[{\"centre\":[0,0,1e999],\"radius\":1}]}",
            "centre is not a finite number");
    refuses("a colour outside",
            "{\"spheres\":[{\"centre\":[0,0,0],\"radius\":1,\"color\":[2,0,0]}]}",
            "color is 2, not a number from 0 to 1");
    refuses("a place too far", "{\"spheres\":[{\"centre\":[0,0,1e200],\"radius\":1}]}",
            "spheres\\[0\\] has numbers that are too large");
    const std::string ball = "{\"centre\":[0,0,1],\"radius\":1}";
    refuses("the third of three",
            "{\"spheres\":[" + ball + ",\n" + ball + ",\n\n{\"centre\":[0,0,1],\"radius\":-1}]}",
            "bad.json':4: spheres\\[2\\].radius is -1");
    refuses("a member twice", "{\"spheres\":[{\"centre\":[0,0,1],\n\"radius\":1,\n\"radius\":1}]}",
            "bad.json':3: spheres\\[0\\].radius is given twice");
    refuses("a list twice", "{\"spheres\":[" + ball + "],\n\"spheres\":[" + ball + "]}",
            "bad.json':2: spheres is given twice");
    refuses("words like members",
            "{\"meshes\":[{\"file\":\"t.obj\"},\n{\"file\":\"\\\"position\\\": "
            "\",\n\"position\":[1]}]}",
            "bad.json':3: meshes\\[1\\].position is not a list");
    refuses("a plane without normal", "{\"planes\":[{\"point\":[0,0,0],\"normal\":[0,0,0]}]}",
            "planes\\[0\\] has no normal");
    refuses("a cylinder without axis",
            "{\"cylinders\":[{\"from\":[0,0,0],\"to\":[0,0,0],\"radius\":1}]}", "has no axis");
    write_file("points.obj", "v 0 0 0\n");
    refuses("a mesh without triangles", "{\"meshes\":[{\"file\":\"points.obj\"}]}",
            "points.obj: has no triangle");
    fails("such a mesh alone", 1, "points.obj: has no triangle",
          "scene render points.obj camera.json path.txt -o made/x");
    refuses("a box turned over", "{\"boxes\":[{\"min\":[1,1,1],\"max\":[0,2,2]}]}", "below max");
    refuses("a quaternion off unit length",
            "{\"meshes\":[{\"file\":\"t.obj\",\"quaternion\":[0,0,0,1.01]}]}", "quaternion");
    refuses("no such mesh", "{\"meshes\":[{\"file\":\"absent.obj\"}]}", "absent.obj");
}

void scene_talk()
{
    write_scene_inputs();
    says("help", "^Usage: cubemap-scene render", "scene --help");
    says("help of a command", "^Usage: cubemap-scene render", "scene render --help");
    says("version", "^cubemap-scene", "scene --version");
    fails("no command", 2, "a command is needed", "scene");
    fails("nearly a command", 2, "did you mean render\\?", "scene rendr room");
    fails("too little", 2, "are needed, 1 is given", "scene render room");
    fails("no folder", 2, "-o DIR is needed", "scene render room camera.json path.txt");
    fails("nearly a scene", 2, "did you mean room\\?",
          "scene render roon camera.json path.txt -o made/x");
    fails("no such noise", 2, "gaussian:S",
          "scene render room camera.json path.txt -o made/x --noise 0.1");
    fails("too much noise", 2, "gaussian:S",
          "scene render room camera.json path.txt -o made/x --noise gaussian:2");
    fails("no camera", 1, "absent.json", "scene render room absent.json path.txt -o made/x");
    fails("no path", 1, "absent.txt", "scene render room camera.json absent.txt -o made/x");
    fails("no scene file", 1, "absent.json",
          "scene render absent.json camera.json path.txt -o made/x");
    fails("no layout", 2, "--to LAYOUT", "scene convert in -o made/x");
    fails("no such folder", 1, "absent", "scene convert absent --to tum -o made/x");
    fails("no such sequence", 1, "absent", "scene info absent");
    fails("one trajectory", 2, "are needed, 1 is given", "scene evaluate path.txt");
    write_file("bad.txt", "0 0 0 0 0 0 0 1\n0 0 0 0 0 0 0 1\n");
    fails("equal stamps", 1, "bad.txt:2", "scene render room camera.json bad.txt -o made/x");
    std::filesystem::create_directory("full");
    write_file("full/kept", "x");
    fails("a folder with something in it", 1, "full",
          "scene render room camera.json path.txt -o full");
    result(names_in("full") == "kept ", "which stays", names_in("full"));
}

} // namespace

const std::vector<Subject> &scene_subjects()
{
    static const std::vector<Subject> subjects = {
        {"scene_talk", scene_talk},       {"scene_rendering", rendering},
        {"scene_moving", moving},         {"scene_telling", telling},
        {"scene_converting", converting}, {"scene_evaluating", evaluating},
        {"scene_files", scenes_of_json}};
    return subjects;
}
