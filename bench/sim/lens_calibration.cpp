// SPDX-License-Identifier: MIT
//
// Lambers, Sommerhoff and Kolb 2018, section 4, again: 17 pictures of a checkerboard, 800 x 600, through lenses of known
// parameters, which OpenCV's calibration is to find. By rays, by moved vertices and by resampled images.
//
// lens-calibration [OVERSAMPLING]     rays and pixels each way in a pixel of the picture; 4
//
// Ends with 1 if a parameter is more than 1 % off.

#include <cubemap/lens.h>
#include <cubemap/raster.h>

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{

constexpr int width = 800, height = 600, views = 17;
constexpr int columns = 13, rows = 9; // of inner corners
constexpr double square = 0.1;

struct setting
{
    const char *name;
    double fx, fy, cx, cy, k1, k2, p1, p2;
};

// The first is that of figure 2, the second has the lens of figure 1; each parameter of the others is another's.
constexpr setting settings[] = {
    {"figure 2", 400.0, 400.0, 399.5, 299.5, -0.05, 0.01, 0.03, -0.01},
    {"barrel", 700.0, 700.0, 399.5, 299.5, -0.11, 0.03, 0.002, 0.003},
    {"pincushion", 600.0, 610.0, 410.0, 290.0, 0.08, 0.05, -0.004, 0.006},
    {"off centre", 500.0, 480.0, 380.0, 320.0, -0.15, 0.04, 0.01, 0.005},
};

void expect(cm_status status, const char *what)
{
    if (status != CM_OK)
    {
        throw std::runtime_error(std::string(what) + ": " + cm_status_text(status));
    }
}

class camera
{
public:
    explicit camera(const cm_camera_options &options)
    {
        expect(cm_camera_create(&options, &handle_), "camera");
    }
    ~camera()
    {
        cm_camera_destroy(handle_);
    }
    camera(const camera &) = delete;
    camera &operator=(const camera &) = delete;
    const cm_camera *get() const
    {
        return handle_;
    }

private:
    cm_camera *handle_ = nullptr;
};

// Of a picture so many times as fine, centres at integers: pixel i of it is at (i + 0.5) / times - 0.5.
cm_camera_options options_of(const setting &of, int times)
{
    cm_camera_options made = {};
    made.size = sizeof made;
    made.width = static_cast<uint32_t>(width * times);
    made.height = static_cast<uint32_t>(height * times);
    made.fx = of.fx * times;
    made.fy = of.fy * times;
    made.cx = (of.cx + 0.5) * times - 0.5;
    made.cy = (of.cy + 0.5) * times - 0.5;
    const double distortion[4] = {of.k1, of.k2, of.p1, of.p2};
    std::copy(distortion, distortion + 4, made.distortion);
    return made;
}

// ---- the board ----

struct pose
{
    std::array<double, 9> axes;  // columns: the board's x, y and z in the camera's axes
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
pose turned(int view, double distance, const setting &of)
{
    const double around = view * 2.399963; // the golden angle: no two views are alike
    const double slant = view == 0 ? 0.0 : 0.2 + 0.15 * (view % 3);
    const double x = slant * std::cos(around), y = slant * std::sin(around),
                 roll = 0.12 * ((view % 5) - 2);
    const double cx = std::cos(x), sx = std::sin(x), cy = std::cos(y), sy = std::sin(y),
                 cr = std::cos(roll), sr = std::sin(roll);
    const double aside = 0.12 * (view % 4) * distance * width / of.fx;
    return {{cy * cr, -cy * sr, sy, sx * sy * cr + cx * sr, -sx * sy * sr + cx * cr, -sx * cy,
             -cx * sy * cr + sx * sr, cx * sy * sr + sx * cr, cx * cy},
            {(width * 0.5 - of.cx) / of.fx * distance + aside * std::cos(3.0 * around),
             (height * 0.5 - of.cy) / of.fy * distance + 0.7 * aside * std::sin(3.0 * around),
             distance}};
}

bool is_whole(const cm_camera *lens, const pose &board)
{
    constexpr double margin = 6.0;
    for (int i = 0; i < (columns + 2) * (rows + 2); i++)
    {
        const auto at = board.at((i % (columns + 2) - 0.5 * (columns + 1)) * square,
                                 (i / (columns + 2) - 0.5 * (rows + 1)) * square);
        double column, row;
        cm_camera_project_array(lens, 1, &at[0], &at[1], &at[2], &column, &row);
        if (!(column > margin && column < width - 1 - margin && row > margin &&
              row < height - 1 - margin))
        {
            return false;
        }
    }
    return true;
}

pose pose_of(int view, const setting &of, const cm_camera *lens)
{
    double distance = 0.5 * (columns + 1) * square * of.fx / width;
    while (!is_whole(lens, turned(view, distance, of)))
    {
        distance *= 1.01;
    }
    return turned(view, distance, of);
}

// 0 black, 1 white, at a place of the board whose middle is the origin; white around the squares.
float shade(double x, double y)
{
    const double a = x / square + 0.5 * (columns + 1), b = y / square + 0.5 * (rows + 1);
    const bool is_inside = a >= 0.0 && b >= 0.0 && a < columns + 1 && b < rows + 1;
    return is_inside && (static_cast<int>(a) + static_cast<int>(b)) % 2 == 0 ? 0.1f : 0.9f;
}

// Means of times x times pixels.
cv::Mat reduce(const std::vector<float> &fine, int times)
{
    cv::Mat made(height, width, CV_8U);
    for (int j = 0; j < height * width; j++)
    {
        double sum = 0.0;
        for (int k = 0; k < times * times; k++)
        {
            const size_t row = static_cast<size_t>(j / width * times + k / times);
            sum += static_cast<double>(fine[row * width * static_cast<size_t>(times) +
                                            static_cast<size_t>(j % width * times + k % times)]);
        }
        made.at<uint8_t>(j / width, j % width) =
            cv::saturate_cast<uint8_t>(255.0 * sum / times / times);
    }
    return made;
}

// ---- ways ----

// The board's plane, met by the rays of all pixels.
std::vector<float> shade_rays(const cm_camera *seen, const pose &board)
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

// What all views through a lens share.
struct ways
{
    ways(const setting &which, int oversampling)
        : of(which), times(oversampling), lens(options_of(of, times)),
          plain(without_lens(options_of(of, times))), wide(wide_of(lens.get()))
    {
        expect(cm_lens_guard(lens.get(), 0.1, &guard), "guard");
        expect(cm_lens_map_create(lens.get(), wide.get(), nullptr, &map), "map");
    }
    ~ways()
    {
        cm_lens_map_destroy(map);
    }
    ways(const ways &) = delete;
    ways &operator=(const ways &) = delete;

    static cm_camera_options without_lens(cm_camera_options options)
    {
        std::fill(options.distortion, options.distortion + 14, 0.0);
        return options;
    }
    static cm_camera_options wide_of(const cm_camera *lens)
    {
        cm_camera_options made = {};
        made.size = sizeof made;
        expect(cm_lens_pinhole(lens, 0.0, &made), "pinhole");
        return made;
    }

    setting of;
    int times;
    camera lens, plain, wide;
    double guard = 0.0;
    cm_lens_map *map = nullptr;
};

// Triangles of a board with a white rim, a square divided into parts x parts pairs, moved for the pinhole.
std::vector<float> draw_vertices(const ways &by, const pose &board)
{
    constexpr int parts = 4, rim = 6;
    constexpr int across = (columns + 1 + 2 * rim) * parts, down = (rows + 1 + 2 * rim) * parts;
    std::vector<double> x, y, z, position;
    std::vector<uint32_t> index;
    for (int v = 0; v < (across + 1) * (down + 1); v++)
    {
        const int i = v % (across + 1), j = v / (across + 1);
        const auto at =
            board.at((i - across * 0.5) * square / parts, (j - down * 0.5) * square / parts);
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
    expect(cm_lens_move_vertices(by.lens.get(), by.guard, x.size(), x.data(), y.data(), z.data(),
                                 x.data(), y.data(), z.data()),
           "vertices");
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
    expect(cm_raster_create(by.plain.get(), 0.0, nullptr, &raster), "canvas");
    std::vector<uint32_t> id(cm_raster_pixel_count(raster));
    const cm_status drawn = cm_raster_triangles(raster, nullptr, &triangles, 2);
    const cm_status seen = cm_raster_read(raster, nullptr, id.data());
    cm_raster_destroy(raster);
    expect(drawn, "triangles");
    expect(seen, "picture");
    std::vector<float> made;
    for (const uint32_t triangle : id)
    {
        const int cell = static_cast<int>(triangle / 2);
        made.push_back(triangle == CM_RASTER_NOTHING
                           ? 0.5f
                           : shade((cell % across + 0.5 - across * 0.5) * square / parts,
                                   (cell / across + 0.5 - down * 0.5) * square / parts));
    }
    return made;
}

// The enlarged pinhole's picture, resampled.
std::vector<float> take_images(const ways &by, const pose &board)
{
    const std::vector<float> from = shade_rays(by.wide.get(), board);
    std::vector<float> made(static_cast<size_t>(width) * height *
                            static_cast<size_t>(by.times * by.times));
    expect(cm_lens_map_color(by.map, 1, from.data(), made.data(), nullptr), "colours");
    if (cm_lens_map_unfilled(by.map) != 0)
    {
        throw std::runtime_error("the pinhole leaves a rim");
    }
    return made;
}

// ---- the calibration ----

struct found
{
    double value[8]; // fx, fy, cx, cy, k1, k2, p1, p2
    double rms;
    int views;
};

// A picture of square pixels without a lens's softness has steps along edges, of which gradients know more than of corners.
constexpr double softness = 1.0; // pixels

bool find_corners(const cv::Mat &sharp, std::vector<cv::Point2f> &corners)
{
    const cv::Size pattern(columns, rows);
    cv::Mat picture;
    cv::GaussianBlur(sharp, picture, cv::Size(0, 0), softness);
    if (!cv::findChessboardCorners(picture, pattern, corners,
                                   cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE))
    {
        return false;
    }
    // as wide as no window has two corners in it
    double apart = 100.0;
    for (size_t i = 1; i < corners.size(); i++)
    {
        apart = std::min(apart, cv::norm(corners[i] - corners[i - 1]));
    }
    const int half = std::max(3, static_cast<int>(0.45 * apart));
    cv::cornerSubPix(picture, corners, cv::Size(half, half), cv::Size(-1, -1),
                     cv::TermCriteria(cv::TermCriteria::EPS | cv::TermCriteria::COUNT, 100, 1e-4));
    return true;
}

found calibrate(const std::vector<cv::Mat> &pictures)
{
    std::vector<std::vector<cv::Point2f>> seen;
    std::vector<std::vector<cv::Point3f>> board;
    std::vector<cv::Point3f> corners;
    for (int i = 0; i < columns * rows; i++)
    {
        corners.emplace_back(static_cast<float>(square * (i % columns)),
                             static_cast<float>(square * (i / columns)), 0.0f);
    }
    for (const cv::Mat &picture : pictures)
    {
        std::vector<cv::Point2f> each;
        if (find_corners(picture, each))
        {
            seen.push_back(each);
            board.push_back(corners);
        }
    }
    found made = {};
    made.views = static_cast<int>(seen.size());
    cv::Mat matrix, distortion;
    std::vector<cv::Mat> rotation, translation;
    made.rms = cv::calibrateCamera(
        board, seen, cv::Size(width, height), matrix, distortion, rotation, translation,
        cv::CALIB_FIX_K3,
        cv::TermCriteria(cv::TermCriteria::EPS | cv::TermCriteria::COUNT, 200, 1e-12));
    const double value[8] = {matrix.at<double>(0, 0),  matrix.at<double>(1, 1),
                             matrix.at<double>(0, 2),  matrix.at<double>(1, 2),
                             distortion.at<double>(0), distortion.at<double>(1),
                             distortion.at<double>(2), distortion.at<double>(3)};
    std::copy(value, value + 8, made.value);
    return made;
}

std::vector<float> picture_of(int way, const ways &by, const pose &board)
{
    return way == 0   ? shade_rays(by.lens.get(), board)
           : way == 1 ? draw_vertices(by, board)
                      : take_images(by, board);
}

// The greatest error of a parameter, in per cent.
double try_way(int way, const ways &by)
{
    const setting &of = by.of;
    const camera lens(options_of(of, 1));
    static const char *const names[3] = {"rays", "vertices", "images"};
    std::vector<cv::Mat> pictures;
    for (int view = 0; view < views; view++)
    {
        pictures.push_back(reduce(picture_of(way, by, pose_of(view, of, lens.get())), by.times));
    }
    const found got = calibrate(pictures);
    const double truth[8] = {of.fx, of.fy, of.cx, of.cy, of.k1, of.k2, of.p1, of.p2};
    double worst = got.views == views ? 0.0 : 100.0;
    std::printf("%-11s %-9s %5d %6.3f ", of.name, names[way], got.views, got.rms);
    for (int i = 0; i < 8; i++)
    {
        const double error = 100.0 * std::fabs(got.value[i] / truth[i] - 1.0);
        worst = std::max(worst, error);
        std::printf(" %6.3f", error);
    }
    std::printf("\n");
    std::fflush(stdout);
    return worst;
}

} // namespace

int main(int count, char **words)
{
    const int times = count > 1 ? std::atoi(words[1]) : 4;
    if (times < 1 || times > 16)
    {
        std::fprintf(stderr, "lens-calibration: OVERSAMPLING is 1 to 16\n");
        return 2;
    }
    try
    {
        double worst = 0.0;
        std::printf("Errors of what OpenCV finds in %d checkerboards of %d x %d pixels, in %%\n",
                    views, width, height);
        std::printf("lens        drawn by  views  rms/px    fx     fy     cx     cy     k1     k2  "
                    "   p1     p2\n");
        for (const setting &each : settings)
        {
            const ways by(each, times);
            for (int way = 0; way < 3; way++)
            {
                worst = std::max(worst, try_way(way, by));
            }
        }
        std::printf("greatest: %.3f %%\n", worst);
        return worst <= 1.0 ? 0 : 1;
    }
    catch (const std::exception &error)
    {
        std::fprintf(stderr, "lens-calibration: %s\n", error.what());
        return 2;
    }
}
