// SPDX-License-Identifier: MIT
//
// Objects that move while cubemap-scene renders: where they are then, and where their points go, against closed forms.

#include "image_cases.hpp"
#include "truth_picture.hpp"

#include <array>
#include <cmath>
#include <stdexcept>

// other files of cases may be compiled together with this one
namespace scene_motion
{
namespace
{

using Point = std::array<double, 3>;

constexpr int width = 60;
constexpr int height = 40;
constexpr double focal_length = 50;
constexpr double centre_column = 29.5;
constexpr double centre_row = 19.5;

// The camera stands in the origin and looks along the world's x, z up: its rays have length 1 along x.
Point ray_of(int x, int y)
{
    return {1, -(x - centre_column) / focal_length, -(y - centre_row) / focal_length};
}

const std::array<double, 5> times = {0, 0.5, 1, 2, 3.25};

std::string name_of(const std::string &folder, std::size_t view)
{
    char text[100];
    std::snprintf(text, sizeof text, "%s/truth/%.6f.exr", folder.c_str(), times[view]);
    return text;
}

void write_inputs()
{
    std::string path;
    for (const double time : times)
    {
        path += std::to_string(time) + " 0 0 0 -0.5 0.5 -0.5 0.5\n";
    }
    write_file("path.txt", path);
    write_file("camera.json", "{\"width\":60,\"height\":40,\"fx\":50,\"fy\":50,\"cx\":29.5,"
                              "\"cy\":19.5}\n");
}

// ---- a ball before a wall at x = 5: it stands until 0.5, goes to the left, and turns, which nobody sees, until 2

constexpr double wall = 5;
constexpr double radius = 0.5;
constexpr double most_left = 0.6;

const char *const ball_and_wall =
    "{\"planes\":[{\"point\":[5,0,0],\"normal\":[-1,0,0],\"color\":[0,0,1]}],\n"
    "\"spheres\":[{\"centre\":[0,0,0],\"radius\":0.5,\"color\":[1,0,0],\"motion\":[\n"
    "[0.5,3,0,0,0,0,0,1],[2,3,0.6,0,0,0,0,1]]}]}";

double ball_at(double time)
{
    return most_left * std::fmin(std::fmax((time - 0.5) / 1.5, 0), 1);
}

// How many lengths of the ray it is to the ball; infinite if that is not met.
double ball_distance(const Point &ray, double left)
{
    const double square = ray[0] * ray[0] + ray[1] * ray[1] + ray[2] * ray[2];
    const double along = 3 * ray[0] + left * ray[1];
    const double rest = along * along - square * (9 + left * left - radius * radius);
    return rest < 0 ? static_cast<double>(INFINITY) : (along - std::sqrt(rest)) / square;
}

// Is the point, which is there, seen? 0 or 1, or -1 if nearly hidden. Of the ball the half towards the camera is.
int is_seen(const Point &point, bool is_ball, double left)
{
    const double side = 9 + left * left - radius * radius - 3 * point[0] - left * point[1];
    if (is_ball)
    {
        return std::fabs(side) < 1e-3 ? -1 : side > 0;
    }
    return !std::isfinite(ball_distance(point, left));
}

void check_ball_flow(const TruthPicture &made, const std::string &name, bool is_ball, Point point,
                     double from, double to, int x, int y)
{
    point[1] += is_ball ? ball_at(to) - ball_at(from) : 0;
    const double column = centre_column - focal_length * point[1] / point[0];
    const double row = centre_row - focal_length * point[2] / point[0];
    const bool inside = column >= -0.5 && column <= width - 0.5;
    const int seen = is_seen(point, is_ball, ball_at(to));
    const double flow = made.at(name + ".column", x, y);
    if (inside && seen == 1)
    {
        near(name + ".column", x, y, x + flow, column, 1e-3);
        near(name + ".row", x, y, y + made.at(name + ".row", x, y), row, 1e-3);
    }
    else if (seen == 0 && !std::isnan(flow))
    {
        wrong_at(x, y, name + " of what is hidden", flow, NAN);
    }
}

int check_ball_pixel(const TruthPicture &made, std::size_t view, int x, int y)
{
    const Point ray = ray_of(x, y);
    const double ball = ball_distance(ray, ball_at(times[view]));
    const bool is_ball = ball < wall;
    const double depth = is_ball ? ball : wall;
    const Point point = {depth * ray[0], depth * ray[1], depth * ray[2]};
    near("id", x, y, made.at("id", x, y), is_ball, 0);
    near("depth", x, y, made.at("depth", x, y), depth, 1e-6);
    near("position.y", x, y, made.at("position.y", x, y), point[1], 1e-6);
    const double normal = is_ball ? (point[1] - ball_at(times[view])) / radius : 0;
    near("normal.y", x, y, made.at("normal.y", x, y), normal, 1e-5);
    if (view + 1 < times.size())
    {
        check_ball_flow(made, "forward", is_ball, point, times[view], times[view + 1], x, y);
    }
    if (view > 0)
    {
        check_ball_flow(made, "backward", is_ball, point, times[view], times[view - 1], x, y);
    }
    return is_ball;
}

void check_ball()
{
    for (std::size_t view = 0; view < times.size(); ++view)
    {
        const TruthPicture made(name_of("ball", view));
        int balls = 0;
        for (int i = 0; i < width * height; ++i)
        {
            balls += check_ball_pixel(made, view, i % width, i / width);
        }
        if (balls < 150)
        {
            throw std::runtime_error("only " + std::to_string(balls) + " pixels have the ball");
        }
    }
}

// ---- a box that is turned by 45 degrees about the vertical, at (3, 0, 0), and shows an edge

const char *const turned_box =
    "{\"boxes\":[{\"min\":[-0.5,-0.5,-0.5],\"max\":[0.5,0.5,0.5],\"color\":[0,1,0],\"motion\":[\n"
    "[1,3,0,0,0,0,0.3826834323650898,0.9238795325112867]]}]}";

void check_box()
{
    const TruthPicture made(name_of("box", 3));
    int boxes = 0;
    for (int i = 0; i < width * height; ++i)
    {
        const int x = i % width, y = i / width;
        const Point ray = ray_of(x, y);
        // |x - 3| + |y| is half a diagonal
        const double depth = (3 - std::sqrt(0.5)) / (1 - std::fabs(ray[1]));
        if (depth > 3 || std::fabs(depth * ray[2]) > 0.5)
        {
            continue;
        }
        ++boxes;
        near("id", x, y, made.at("id", x, y), 0, 0);
        near("depth", x, y, made.at("depth", x, y), depth, 1e-6);
        near("normal.x", x, y, made.at("normal.x", x, y), -std::sqrt(0.5), 1e-6);
        near("normal.y", x, y, made.at("normal.y", x, y), std::copysign(std::sqrt(0.5), ray[1]),
             1e-6);
        near("normal.z", x, y, made.at("normal.z", x, y), 0, 1e-6);
        near("forward.column", x, y, made.at("forward.column", x, y), 0, 1e-6);
    }
    if (boxes < 200)
    {
        throw std::runtime_error("only " + std::to_string(boxes) + " pixels have the box");
    }
}

void objects()
{
    write_inputs();
    write_file("ball.json", ball_and_wall);
    write_file("box.json", turned_box);
    does("scene render ball.json camera.json path.txt -o ball --truth");
    does("scene render box.json camera.json path.txt -o box --truth");
    holds("a ball that moves, and where its points go", check_ball);
    holds("a box that turns", check_box);
    does("scene render ball.json camera.json path.txt -o more --truth --threads 3");
    result(content_of(name_of("ball", 2)) == content_of(name_of("more", 2)),
           "the same bits with 3 threads");
}

} // namespace
} // namespace scene_motion

const std::vector<Subject> &scene_motion_subjects()
{
    static const std::vector<Subject> subjects = {{"scene_objects", scene_motion::objects}};
    return subjects;
}
