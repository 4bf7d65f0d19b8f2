// SPDX-License-Identifier: MIT
//
// Lambers, Sommerhoff and Kolb, Realistic Lens Distortion Rendering, 2018, section 4: 17 pictures of a checkerboard, 800 x 600,
// through lenses of known parameters, which OpenCV's calibration is to find. By rays, by moved vertices and by resampled images.

#include "reproduce.hpp"
#include "reproduce_stage.hpp"

#include "modules/image/io/image_io.h"
#include "modules/sim/io/vision.h"

#include "tools/cli/parallel.hpp"
#include "tools/cli/program.hpp"

#include <cubemap/lens.h>
#include <cubemap/raster.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace
{

constexpr int board_width = 800, board_height = 600, board_views = 17;
constexpr int board_columns = 13, board_rows = 9; // of inner corners
constexpr double board_square = 0.1;
constexpr int oversampling = 4; // rays and pixels each way in a pixel of the picture

struct Lens
{
    const char *name;
    double fx, fy, cx, cy, k1, k2, p1, p2;
};

// The first is that of figure 2, the second has the lens of figure 1; each parameter of the others is another's.
constexpr Lens lenses[] = {
    {"figure 2", 400.0, 400.0, 399.5, 299.5, -0.05, 0.01, 0.03, -0.01},
    {"barrel", 700.0, 700.0, 399.5, 299.5, -0.11, 0.03, 0.002, 0.003},
    {"pincushion", 600.0, 610.0, 410.0, 290.0, 0.08, 0.05, -0.004, 0.006},
    {"off centre", 500.0, 480.0, 380.0, 320.0, -0.15, 0.04, 0.01, 0.005},
};

TofPointer<cm_camera> make(const cm_camera_options &options)
{
    cm_camera *made = nullptr;
    need(cm_camera_create(&options, &made));
    return TofPointer<cm_camera>(made);
}

// Of a picture so many times as fine, centres at integers: pixel i of it is at (i + 0.5) / times - 0.5.
cm_camera_options options_of(const Lens &of, int times)
{
    cm_camera_options made = {};
    made.size = sizeof made;
    made.width = static_cast<uint32_t>(board_width * times);
    made.height = static_cast<uint32_t>(board_height * times);
    made.fx = of.fx * times;
    made.fy = of.fy * times;
    made.cx = (of.cx + 0.5) * times - 0.5;
    made.cy = (of.cy + 0.5) * times - 0.5;
    const double distortion[4] = {of.k1, of.k2, of.p1, of.p2};
    std::copy(distortion, distortion + 4, made.distortion);
    return made;
}

// ---- the board ----

struct BoardPose
{
    std::array<double, 9> axes;  // board_columns: the board's x, y and z in the camera's axes
    std::array<double, 3> place; // of its middle

    std::array<double, 3> at(double x, double y) const
    {
        std::array<double, 3> to{};
        for (size_t i = 0; i < 3; i++)
        {
            to[i] = place[i] + axes[3 * i] * x + axes[3 * i + 1] * y;
        }
        return to;
    }
};

// Turned about all axes and moved aside, so near that the board is just seen whole.
BoardPose turned(int view, double distance, const Lens &of)
{
    const double around = view * 2.399963; // the golden angle: no two board_views are alike
    const double slant = view == 0 ? 0.0 : 0.2 + 0.15 * (view % 3);
    const double x = slant * std::cos(around), y = slant * std::sin(around),
                 roll = 0.12 * ((view % 5) - 2);
    const double cx = std::cos(x), sx = std::sin(x), cy = std::cos(y), sy = std::sin(y),
                 cr = std::cos(roll), sr = std::sin(roll);
    const double aside = 0.12 * (view % 4) * distance * board_width / of.fx;
    return {{cy * cr, -cy * sr, sy, sx * sy * cr + cx * sr, -sx * sy * sr + cx * cr, -sx * cy,
             -cx * sy * cr + sx * sr, cx * sy * sr + sx * cr, cx * cy},
            {(board_width * 0.5 - of.cx) / of.fx * distance + aside * std::cos(3.0 * around),
             (board_height * 0.5 - of.cy) / of.fy * distance + 0.7 * aside * std::sin(3.0 * around),
             distance}};
}

bool is_whole(const cm_camera *lens, const BoardPose &board)
{
    constexpr double margin = 6.0;
    for (int i = 0; i < (board_columns + 2) * (board_rows + 2); i++)
    {
        const auto at =
            board.at((i % (board_columns + 2) - 0.5 * (board_columns + 1)) * board_square,
                     (i / (board_columns + 2) - 0.5 * (board_rows + 1)) * board_square);
        double column, row;
        cm_camera_project_array(lens, 1, &at[0], &at[1], &at[2], &column, &row);
        if (!(column > margin && column < board_width - 1 - margin && row > margin &&
              row < board_height - 1 - margin))
        {
            return false;
        }
    }
    return true;
}

BoardPose pose_of(int view, const Lens &of, const cm_camera *lens)
{
    double distance = 0.5 * (board_columns + 1) * board_square * of.fx / board_width;
    while (!is_whole(lens, turned(view, distance, of)))
    {
        distance *= 1.01;
    }
    return turned(view, distance, of);
}

// 0 black, 1 white, at a place of the board whose middle is the origin; white around the squares.
float shade(double x, double y)
{
    const double a = x / board_square + 0.5 * (board_columns + 1),
                 b = y / board_square + 0.5 * (board_rows + 1);
    const bool is_inside = a >= 0.0 && b >= 0.0 && a < board_columns + 1 && b < board_rows + 1;
    return is_inside && (static_cast<int>(a) + static_cast<int>(b)) % 2 == 0 ? 0.1f : 0.9f;
}

// Means of times x times pixels.
void reduce(const std::vector<float> &fine, int times, std::uint8_t *to)
{
    for (int j = 0; j < board_height * board_width; j++)
    {
        double sum = 0.0;
        for (int k = 0; k < times * times; k++)
        {
            const size_t row = static_cast<size_t>(j / board_width * times + k / times);
            sum +=
                static_cast<double>(fine[row * board_width * static_cast<size_t>(times) +
                                         static_cast<size_t>(j % board_width * times + k % times)]);
        }
        to[j] = static_cast<std::uint8_t>(std::lround(255.0 * sum / times / times));
    }
}

// ---- ways ----

// The board's plane, met by the rays of all pixels.
std::vector<float> shade_rays(const cm_camera *seen, const BoardPose &board)
{
    const cm_camera_options *options = cm_camera_describe(seen);
    const size_t n = options->width;
    std::vector<double> column(n), row(n), x(n), y(n), z(n);
    std::vector<float> made;
    const auto &a = board.axes;
    const auto &p = board.place;
    const double level = a[2] * p[0] + a[5] * p[1] + a[8] * p[2];
    for (uint32_t j = 0; j < options->height; j++)
    {
        for (size_t i = 0; i < n; i++)
        {
            column[i] = static_cast<double>(i) + options->pixel_centre;
            row[i] = j + options->pixel_centre;
        }
        cm_camera_ray_array(seen, n, column.data(), row.data(), x.data(), y.data(), z.data());
        for (size_t i = 0; i < n; i++)
        {
            const double depth = level / (a[2] * x[i] + a[5] * y[i] + a[8]);
            const double to[3] = {depth * x[i] - p[0], depth * y[i] - p[1], depth - p[2]};
            const bool is_met = depth > 0.0;
            made.push_back(!is_met ? 0.5f
                                   : shade(a[0] * to[0] + a[3] * to[1] + a[6] * to[2],
                                           a[1] * to[0] + a[4] * to[1] + a[7] * to[2]));
        }
    }
    return made;
}

// What all board_views through a lens share.
struct Ways
{
    explicit Ways(const Lens &which)
        : of(which), times(oversampling), lens(make(options_of(of, times))),
          plain(make(without_lens(options_of(of, times)))), wide(make(wide_of(lens.get())))
    {
        need(cm_lens_guard(lens.get(), 0.1, &guard));
        need(cm_lens_map_create(lens.get(), wide.get(), nullptr, &map));
    }
    ~Ways()
    {
        cm_lens_map_destroy(map);
    }
    Ways(const Ways &) = delete;
    Ways &operator=(const Ways &) = delete;

    static cm_camera_options without_lens(cm_camera_options options)
    {
        std::fill(options.distortion, options.distortion + 14, 0.0);
        return options;
    }
    static cm_camera_options wide_of(const cm_camera *lens)
    {
        cm_camera_options made = {};
        made.size = sizeof made;
        need(cm_lens_pinhole(lens, 0.0, &made));
        return made;
    }

    Lens of;
    int times;
    TofPointer<cm_camera> lens, plain, wide;
    double guard = 0.0;
    cm_lens_map *map = nullptr;
};

// Triangles of a board with a white rim, a board_square divided into parts x parts pairs, moved for the pinhole.
std::vector<float> draw_vertices(const Ways &by, const BoardPose &board)
{
    constexpr int parts = 4, rim = 6;
    constexpr int across = (board_columns + 1 + 2 * rim) * parts,
                  down = (board_rows + 1 + 2 * rim) * parts;
    std::vector<double> x, y, z, position;
    std::vector<uint32_t> index;
    for (int v = 0; v < (across + 1) * (down + 1); v++)
    {
        const int i = v % (across + 1), j = v / (across + 1);
        const auto at = board.at((i - across * 0.5) * board_square / parts,
                                 (j - down * 0.5) * board_square / parts);
        x.push_back(at[0]);
        y.push_back(at[1]);
        z.push_back(at[2]);
        if (i < across && j < down)
        {
            const uint32_t first = static_cast<uint32_t>(v), below = first + across + 1;
            for (const uint32_t corner : {first, first + 1, below, first + 1, below + 1, below})
            {
                index.push_back(corner);
            }
        }
    }
    need(cm_lens_move_vertices(by.lens.get(), by.guard, x.size(), x.data(), y.data(), z.data(),
                               x.data(), y.data(), z.data()));
    for (size_t v = 0; v < x.size(); v++)
    {
        position.insert(position.end(), {x[v], y[v], z[v]});
    }
    cm_triangles triangles = {};
    triangles.size = sizeof triangles;
    triangles.vertex_count = x.size();
    triangles.position = position.data();
    triangles.triangle_count = index.size() / 3;
    triangles.index = index.data();
    cm_raster *raster = nullptr;
    need(cm_raster_create(by.plain.get(), 0.0, nullptr, &raster));
    std::vector<uint32_t> id(cm_raster_pixel_count(raster));
    const cm_status drawn = cm_raster_triangles(raster, nullptr, &triangles, 2);
    const cm_status seen = cm_raster_read(raster, nullptr, id.data());
    cm_raster_destroy(raster);
    need(drawn);
    need(seen);
    std::vector<float> made;
    for (const uint32_t triangle : id)
    {
        const int cell = static_cast<int>(triangle / 2);
        made.push_back(triangle == CM_RASTER_NOTHING
                           ? 0.5f
                           : shade((cell % across + 0.5 - across * 0.5) * board_square / parts,
                                   (cell / across + 0.5 - down * 0.5) * board_square / parts));
    }
    return made;
}

// The enlarged pinhole's picture, resampled.
std::vector<float> take_images(const Ways &by, const BoardPose &board)
{
    const std::vector<float> from = shade_rays(by.wide.get(), board);
    std::vector<float> made(static_cast<size_t>(board_width) * board_height *
                            static_cast<size_t>(by.times * by.times));
    need(cm_lens_map_color(by.map, 1, from.data(), made.data(), nullptr));
    if (cm_lens_map_unfilled(by.map) != 0)
    {
        throw Failure("the pinhole leaves a rim");
    }
    return made;
}

// ---- the calibration ----

std::vector<float> picture_of(int way, const Ways &by, const BoardPose &board)
{
    return way == 0   ? shade_rays(by.lens.get(), board)
           : way == 1 ? draw_vertices(by, board)
                      : take_images(by, board);
}

// A way through a lens: per cent that each parameter is off.
struct LensErrors
{
    std::array<double, 8> off;
    double worst; // 100 if a board was not found
};

constexpr const char *way_names[3] = {"rays", "vertices", "images"};

LensErrors try_way(const cm_vision &vision, int way, const Ways &by, int threads)
{
    const Lens &of = by.of;
    const TofPointer<cm_camera> lens = make(options_of(of, 1));
    constexpr std::size_t pixels = std::size_t{board_width} * board_height;
    std::vector<std::uint8_t> pictures(board_views * pixels);
    parallel_for(board_views, threads,
                 [&](int view)
                 {
                     reduce(picture_of(way, by, pose_of(view, of, lens.get())), by.times,
                            pictures.data() + static_cast<std::size_t>(view) * pixels);
                 });
    const cm_checkerboard board = {board_width, board_height, board_columns, board_rows,
                                   board_square};
    cm_found_lens found = {};
    char message[CM_IMAGE_MESSAGE] = "";
    if (vision.calibrate(&board, board_views, pictures.data(), &found, message) != CM_OK)
    {
        throw Failure(message);
    }
    const double truth[8] = {of.fx, of.fy, of.cx, of.cy, of.k1, of.k2, of.p1, of.p2};
    LensErrors made = {{}, found.views == board_views ? 0.0 : 100.0};
    for (std::size_t i = 0; i < 8; ++i)
    {
        made.off[i] = 100.0 * std::fabs(found.value[i] / truth[i] - 1.0);
        made.worst = std::max(made.worst, made.off[i]);
    }
    return made;
}

} // namespace

Reproduction reproduce_lens(const ReproduceSettings &settings)
{
    Reproduction made;
    char message[CM_IMAGE_MESSAGE] = "";
    const cm_vision *const vision = cm_vision_get(message);
    if (vision == nullptr)
    {
        made.missing = message;
        return made;
    }
    Chart chart = {"lens-calibration",
                   "What OpenCV finds of 17 checkerboards",
                   "parameter",
                   "error in %",
                   true,
                   {},
                   {}};
    chart.tick = {"fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2"};
    for (const Lens &each : lenses)
    {
        const Ways by(each);
        for (int way = 0; way < 3; ++way)
        {
            settings.tell(std::string("lens ") + each.name + ", by " + way_names[way]);
            const LensErrors errors = try_way(*vision, way, by, settings.threads);
            const std::string name = std::string(each.name) + ", " + way_names[way];
            made.rows.push_back(
                {"17 checkerboards through lens " + name + ": worst parameter, and k1",
                 "within 1 %, k1 worse",
                 text_of_number(errors.worst, 2) + " %, k1 " + text_of_number(errors.off[4], 2) +
                     " %",
                 errors.worst <= 1.0});
            chart.curves.push_back(
                {name, {1, 2, 3, 4, 5, 6, 7, 8}, {errors.off.begin(), errors.off.end()}});
        }
    }
    made.charts.push_back(chart);
    return made;
}
