// SPDX-License-Identifier: MIT

#include "picture_checks.hpp"
#include "picture.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <random>
#include <stdexcept>

#include <cubemap/colormap.h>
#include <cubemap/cubemap.h>

namespace
{

constexpr double pi = 3.14159265358979323846;
constexpr double mean_scale = 6 / pi;
constexpr double half_line = 1.0;

double radians(double degrees)
{
    return degrees * pi / 180;
}

double degrees_of(double angle)
{
    return angle * 180 / pi;
}

// "WORDS X Y"
std::string at_pixel(const std::string &words, int x, int y)
{
    return words + " " + std::to_string(x) + " " + std::to_string(y);
}

void expect(bool condition, const std::string &otherwise)
{
    if (!condition)
    {
        throw std::runtime_error(otherwise);
    }
}

void close(double found, double wanted, double tolerance, const std::string &what)
{
    if (!(std::fabs(found - wanted) <= tolerance))
    {
        char text[100];
        std::snprintf(text, sizeof text, " is %.9g and should be %.9g", found, wanted);
        throw std::runtime_error(what + text);
    }
}

double centre(double i, int size)
{
    return (2 * i + 1) / size - 1;
}

// ---- values

using Quantities = std::map<std::string, double>;

double deformation_of(double isotropy)
{
    return degrees_of(2 * std::asin((isotropy - 1) / (isotropy + 1)));
}

Quantities gnomonic(double u, double v)
{
    const double square = 1 + u * u + v * v;
    const double isotropy = std::sqrt(square);
    return {{"scale", std::pow(square, 1.5)},
            {"area", std::pow(square, 1.5) / mean_scale},
            {"isotropy", isotropy},
            {"deformation", deformation_of(isotropy)},
            {"texel-aspect", std::sqrt((1 + v * v) / (1 + u * u))},
            {"texel-area", std::sqrt((1 + u * u) * (1 + v * v)) / (square * square) * mean_scale}};
}

using Vector = std::array<double, 3>;

double dot(const Vector &a, const Vector &b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// From the derivatives of the direction.
Quantities from_tangents(const Vector &by_u, const Vector &by_v)
{
    const double uu = dot(by_u, by_u);
    const double vv = dot(by_v, by_v);
    const double uv = dot(by_u, by_v);
    const double area = std::sqrt(uu * vv - uv * uv);
    const double half = std::hypot((uu - vv) / 2, uv);
    // longer over shorter axis: squared lengths over their product
    const double isotropy = ((uu + vv) / 2 + half) / area;
    return {{"area", 1 / area / mean_scale},
            {"isotropy", isotropy},
            {"texel-aspect", std::sqrt(uu / vv)},
            {"texel-area", std::sqrt(uu * vv) * mean_scale}};
}

using MappingOwner = std::unique_ptr<cm_mapping, decltype(&cm_mapping_destroy)>;

MappingOwner mapping_of(const std::string &specification, const std::string &frame)
{
    cm_mapping *mapping = nullptr;
    expect(cm_mapping_create(specification.c_str(), cm_frame_find(frame.c_str()), &mapping) ==
               CM_OK,
           specification + " is no mapping");
    return MappingOwner(mapping, cm_mapping_destroy);
}

using ColormapOwner = std::unique_ptr<cm_colormap, decltype(&cm_colormap_destroy)>;

ColormapOwner colormap_of(const std::string &specification)
{
    cm_colormap *map = nullptr;
    expect(cm_colormap_create(specification.c_str(), &map) == CM_OK,
           specification + " is no colour map");
    return ColormapOwner(map, cm_colormap_destroy);
}

std::array<double, 3> color_at(const cm_colormap *map, double place)
{
    cm_colormap_color color;
    cm_colormap_color_at(map, place, &color);
    return {color.srgb[0], color.srgb[1], color.srgb[2]};
}

// The derivative of the direction towards (du, dv), by a difference over twice that.
Vector difference(const cm_mapping *mapping, int face, const std::array<double, 2> &uv, double du,
                  double dv)
{
    const double after[2] = {uv[0] + du, uv[1] + dv};
    const double before[2] = {uv[0] - du, uv[1] - dv};
    Vector high;
    Vector low;
    cm_inverse(mapping, static_cast<std::uint8_t>(face), after, high.data());
    cm_inverse(mapping, static_cast<std::uint8_t>(face), before, low.data());
    const double step = 2 * (du + dv);
    return {(high[0] - low[0]) / step, (high[1] - low[1]) / step, (high[2] - low[2]) / step};
}

// ---- ellipses

struct OutlineRow
{
    int y;
    int first;
    int last;
};

struct Part
{
    int left;
    int top;
    int right;
    int bottom;
};

// For each row of a part of the picture the first and the last pixel of the outline's core.
std::vector<OutlineRow> outline_rows(const Picture &picture, const Part &part)
{
    std::vector<OutlineRow> rows;
    for (int y = part.top; y < part.bottom; ++y)
    {
        OutlineRow row = {y, -1, -1};
        for (int x = part.left; x < part.right; ++x)
        {
            if (picture.first(x, y) >= 0.5)
            {
                row.first = row.first < 0 ? x : row.first;
                row.last = x;
            }
        }
        if (row.first >= 0)
        {
            rows.push_back(row);
        }
    }
    return rows;
}

struct Ellipse
{
    double area = 0;
    double major = 0; // semi-axes
    double minor = 0;
    double turned = 0;
    double x = 0; // the middle
    double y = 0;
};

// In pixels, of a cell of a face: from the convex region that its outline, half a line wider, surrounds.
Ellipse ellipse_in_cell(const Picture &picture, int i, int j, int cells)
{
    const auto edge = [&](int k)
    { return static_cast<int>(std::lround(static_cast<double>(k) * picture.width / cells)); };
    const std::vector<OutlineRow> rows =
        outline_rows(picture, {edge(i), edge(j), edge(i + 1), edge(j + 1)});
    Ellipse found;
    for (const OutlineRow &row : rows)
    {
        const int count = row.last - row.first + 1;
        found.area += count;
        found.x += count * (row.first + row.last + 1) / 2.0;
        found.y += count * (row.y + 0.5);
    }
    expect(found.area > 0, "no ellipse in a cell");
    found.x /= found.area;
    found.y /= found.area;
    double xx = 0;
    double yy = 0;
    double xy = 0;
    for (const OutlineRow &row : rows)
    {
        const double count = row.last - row.first + 1;
        const double across = (row.first + row.last + 1) / 2.0 - found.x;
        const double down = row.y + 0.5 - found.y;
        xx += count * (across * across + (count * count - 1) / 12);
        yy += count * down * down;
        xy += count * across * down;
    }
    const double mean = (xx + yy) / 2 / found.area;
    const double half = std::hypot((xx - yy) / 2, xy) / found.area;
    found.major = 2 * std::sqrt(mean + half) - half_line;
    found.minor = 2 * std::sqrt(mean - half) - half_line;
    found.turned = 0.5 * std::atan2(2 * xy, xx - yy);
    return found;
}

// Ramanujan's approximation.
double perimeter(double a, double b)
{
    return pi * (3 * (a + b) - std::sqrt((3 * a + b) * (a + 3 * b)));
}

// How far the outline reaches along a line of pixels through the middle of an ellipse.
double reach(const Picture &picture, double x, double y, int along, int across, double half)
{
    const int most = static_cast<int>(std::lround(half)) + 4;
    int first = most + 1;
    int last = -most - 1;
    for (int k = -most; k <= most; ++k)
    {
        const int column = static_cast<int>(std::lround(x + k * along - 0.5));
        const int row = static_cast<int>(std::lround(y + k * across - 0.5));
        if (picture.first((column + picture.width) % picture.width, row) >= 0.5)
        {
            first = std::min(first, k);
            last = std::max(last, k);
        }
    }
    return last - first + 1;
}

// ---- lines

// Where lines, white on black, cross a row of pixels.
std::vector<double> line_centres(std::vector<double> values)
{
    values.push_back(0);
    std::vector<double> centres;
    double weight = 0;
    double moment = 0;
    for (std::size_t i = 0; i < values.size(); ++i)
    {
        if (values[i] > 0)
        {
            weight += values[i];
            moment += values[i] * (static_cast<double>(i) + 0.5);
        }
        else if (weight > 0)
        {
            centres.push_back(moment / weight);
            weight = moment = 0;
        }
    }
    return centres;
}

std::vector<double> without_ends(const std::vector<double> &all)
{
    expect(all.size() >= 2, "fewer than two lines");
    return std::vector<double>(all.begin() + 1, all.end() - 1);
}

std::vector<double> column_of(const Picture &picture, int x, int top, int bottom)
{
    std::vector<double> values;
    for (int y = top; y < bottom; ++y)
    {
        values.push_back(picture.first(x, y));
    }
    return values;
}

std::vector<double> row_of(const Picture &picture, int y, int left, int right)
{
    std::vector<double> values;
    for (int x = left; x < right; ++x)
    {
        values.push_back(picture.first(x, y));
    }
    return values;
}

void check_lines(const std::vector<double> &found, const std::vector<double> &wanted,
                 double tolerance, const std::string &what)
{
    expect(found.size() == wanted.size(), what + " has " + std::to_string(found.size()) +
                                              " lines, not " + std::to_string(wanted.size()));
    for (std::size_t i = 0; i < found.size(); ++i)
    {
        close(found[i], wanted[i], tolerance, what);
    }
}

// How far a value is from the nearest multiple of a step.
double from_multiple(double value, double step)
{
    return std::fabs(value - step * std::round(value / step));
}

// How many meridians a circle around the pole crosses, in the middle of a face that lies at (0, 0).
int meridians_across(const Picture &picture, double middle, int size, double degrees)
{
    const double radius = size / 2.0 / std::tan(radians(degrees));
    std::vector<bool> around;
    for (int k = 0; k < 7200; ++k)
    {
        const double angle = radians((k + 0.5) / 20 + 5);
        around.push_back(picture.first(static_cast<int>(middle + radius * std::cos(angle)),
                                       static_cast<int>(size / 2.0 + radius * std::sin(angle))) >=
                         0.5);
    }
    int crossings = 0;
    for (std::size_t k = 0; k < around.size(); ++k)
    {
        crossings += around[k] && !around[k == 0 ? around.size() - 1 : k - 1];
    }
    return crossings;
}

} // namespace

void check_gnomonic(const std::string &quantity, const std::string &name)
{
    const Picture picture(name);
    expect(picture.channels == 1 && picture.width == picture.height, "not one face of numbers");
    for (int y = 0; y < picture.height; ++y)
    {
        for (int x = 0; x < picture.width; ++x)
        {
            const double wanted =
                gnomonic(centre(x, picture.width), -centre(y, picture.width)).at(quantity);
            close(picture.first(x, y), wanted, 2e-6 * std::fmax(1, wanted),
                  at_pixel(quantity, x, y));
        }
    }
}

void check_differences(const std::string &mapping, const std::string &frame,
                       const std::string &pattern)
{
    const double step = 1e-5;
    const MappingOwner owner = mapping_of(mapping, frame);
    std::map<std::string, Picture> pictures;
    for (const char *quantity : {"area", "isotropy", "texel-aspect", "texel-area"})
    {
        std::string name = pattern;
        name.replace(name.find("QUANTITY"), 8, quantity);
        pictures.emplace(quantity, Picture(name));
    }
    const int size = pictures.at("area").height;
    const int first_row_v = frame == "gl" ? -1 : 1;
    std::mt19937 generator(1);
    for (int k = 0; k < 400; ++k)
    {
        const int x = static_cast<int>(generator() % static_cast<unsigned>(6 * size));
        const int y = static_cast<int>(generator() % static_cast<unsigned>(size));
        const std::array<double, 2> uv = {centre(x % size, size), -first_row_v * centre(y, size)};
        // differences do not work across the creases of qsc and healpix
        if (x % size == y || x % size == size - 1 - y)
        {
            continue;
        }
        const Quantities wanted = from_tangents(difference(owner.get(), x / size, uv, step, 0),
                                                difference(owner.get(), x / size, uv, 0, step));
        for (const auto &[quantity, picture] : pictures)
        {
            const double value = wanted.at(quantity);
            close(picture.first(x, y), value, 2e-6 * std::fmax(1, value),
                  at_pixel(mapping + " " + quantity, x, y));
        }
    }
}

std::array<double, 3> color_of_map(const std::string &specification, double place)
{
    return color_at(colormap_of(specification).get(), place);
}

void check_colors(const ScaleOfColors &scale, const std::string &values, const std::string &name)
{
    const Picture numbers(values);
    const Picture picture(name);
    const ColormapOwner map = colormap_of(scale.specification);
    expect(numbers.values.size() ==
               std::size_t(picture.width) * static_cast<std::size_t>(picture.height),
           "sizes differ");
    const double half = std::fmax(std::fabs(std::log(scale.low / scale.middle)),
                                  std::fabs(std::log(scale.high / scale.middle)));
    for (std::size_t i = 0; i < numbers.values.size(); ++i)
    {
        const double value =
            std::clamp(static_cast<double>(numbers.values[i]), scale.low, scale.high);
        double place = 1 - (value - scale.low) / (scale.high - scale.low);
        if (scale.middle > 0)
        {
            place = 0.5 + 0.5 * std::log(value / scale.middle) / half;
        }
        const std::array<double, 3> color = color_at(map.get(), scale.reverse ? 1 - place : place);
        const int x = static_cast<int>(i) % picture.width;
        const int y = static_cast<int>(i) / picture.width;
        for (std::size_t c = 0; c < 3; ++c)
        {
            close(static_cast<double>(picture.at(x, y)[c]), std::clamp(color[c], 0.0, 1.0),
                  0.8 / 255, at_pixel("pixel", x, y));
        }
    }
}

void check_symmetric(const std::string &name, double levels)
{
    const Picture picture(name);
    const int last = picture.width - 1;
    for (int y = 0; y < picture.height; ++y)
    {
        for (int x = 0; x < picture.width; ++x)
        {
            for (const float *other :
                 {picture.at(last - x, y), picture.at(x, last - y), picture.at(y, x)})
            {
                for (int c = 0; c < picture.channels; ++c)
                {
                    close(static_cast<double>(other[c]), static_cast<double>(picture.at(x, y)[c]),
                          levels / 255 + 1e-6, at_pixel("mirror image of", x, y));
                }
            }
        }
    }
}

void check_uniform(const std::string &name, const std::array<double, 3> &color)
{
    const Picture picture(name);
    for (int i = 0; i < picture.width * picture.height; ++i)
    {
        for (std::size_t c = 0; c < 3; ++c)
        {
            close(static_cast<double>(picture.at(i % picture.width, i / picture.width)[c]),
                  color[c], 0.6 / 255, "pixel " + std::to_string(i));
        }
    }
}

void check_isolines(const std::string &name, double step)
{
    const Picture picture(name);
    const int middle = picture.width / 2;
    std::vector<double> red;
    for (int x = middle; x < picture.width; ++x)
    {
        const float *const pixel = picture.at(x, middle);
        red.push_back(pixel[0] >= 1 && pixel[1] <= 0 && pixel[2] <= 0 ? 1.0 : 0.0);
    }
    // circles of (1 + r^2)^1.5 pi/6 = k step
    std::vector<double> wanted;
    for (int k = 1; k < 1000; ++k)
    {
        const double square = std::pow(k * step * mean_scale, 2.0 / 3) - 1;
        if (square > 0 && square <= 1)
        {
            wanted.push_back(std::sqrt(square) * picture.width / 2);
        }
    }
    std::vector<double> found = line_centres(red);
    std::transform(found.begin(), found.end(), found.begin(), [](double x) { return x - 0.5; });
    check_lines(found, wanted, 0.8, "isolines");
}

void check_gnomonic_ellipses(const std::string &name, int cells, double degrees)
{
    const Picture picture(name);
    const double radius = radians(degrees);
    const double size = picture.width;
    for (int j = 0; j < cells; ++j)
    {
        for (int i = 0; i < cells; ++i)
        {
            const double u = centre(i, cells);
            const double v = -centre(j, cells);
            const double square = 1 + u * u + v * v;
            const double a = square * radius * size / 2;
            const double b = std::sqrt(square) * radius * size / 2;
            const Ellipse found = ellipse_in_cell(picture, i, j, cells);
            // Steiner: what is within a distance of a convex figure
            const double wanted =
                pi * a * b + perimeter(a, b) * half_line + pi * half_line * half_line;
            close(found.area, wanted, 0.25 * std::sqrt(perimeter(a, b)) + 0.002 * wanted,
                  at_pixel("area of", i, j));
            close(found.major, a, 0.3, at_pixel("major axis of", i, j));
            close(found.minor, b, 0.3, at_pixel("minor axis of", i, j));
            close(found.x, (i + 0.5) * size / cells, 0.1, at_pixel("middle of", i, j));
            close(found.y, (j + 0.5) * size / cells, 0.1, at_pixel("middle of", i, j));
            if (2 * i + 1 != cells || 2 * j + 1 != cells)
            {
                const double away = found.turned - std::atan2(-v, u);
                close(away - pi * std::round(away / pi), 0, 0.02, at_pixel("direction of", i, j));
            }
        }
    }
}

void check_circle(const std::string &name, int cells)
{
    const Ellipse found = ellipse_in_cell(Picture(name), cells / 2, cells / 2, cells);
    close(found.major / found.minor, 1, 0.005, "the ratio of axes");
}

void check_equirect_ellipses(const std::string &name, double degrees)
{
    const Picture picture(name);
    const double radius = radians(degrees);
    const double per_radian = picture.width / (2 * pi);
    for (const double v : {-2.0 / 3, 0.0, 2.0 / 3})
    {
        for (const double u : {-2.0 / 3, 0.0, 2.0 / 3})
        {
            const double lon = std::atan(u);
            const double lat = std::atan2(v, std::hypot(1, u));
            const double x = (lon + pi) * per_radian;
            const double y = (pi / 2 - lat) * per_radian;
            const double a = radius / std::cos(lat) * per_radian;
            const double b = radius * per_radian;
            const std::string what = "ellipse at " + std::to_string(u) + " " + std::to_string(v);
            for (const double turn : {0.0, picture.width / 2.0})
            {
                close(reach(picture, x + turn, y, 1, 0, a), 2 * (a + half_line), 1.6, what);
                close(reach(picture, x + turn, y, 0, 1, b), 2 * (b + half_line), 1.6, what);
            }
        }
    }
}

void check_count(const std::string &name, int wanted)
{
    const Picture picture(name);
    std::vector<bool> inside;
    for (int i = 0; i < picture.width * picture.height; ++i)
    {
        inside.push_back(picture.first(i % picture.width, i / picture.width) > 0.3);
    }
    int count = 0;
    std::vector<int> pending;
    const auto visit = [&](int x, int y)
    {
        const int at = y * picture.width + (x + picture.width) % picture.width;
        if (y >= 0 && y < picture.height && inside[static_cast<std::size_t>(at)])
        {
            inside[static_cast<std::size_t>(at)] = false;
            pending.push_back(at);
        }
    };
    for (int start = 0; start < picture.width * picture.height; ++start)
    {
        count += inside[static_cast<std::size_t>(start)];
        visit(start % picture.width, start / picture.width);
        while (!pending.empty())
        {
            const int x = pending.back() % picture.width;
            const int y = pending.back() / picture.width;
            pending.pop_back();
            visit(x + 1, y);
            visit(x - 1, y);
            visit(x, y + 1);
            visit(x, y - 1);
        }
    }
    expect(count == wanted,
           std::to_string(count) + " figures where there should be " + std::to_string(wanted));
}

void check_equirect_graticule(const std::string &name, const std::string &source)
{
    const Picture picture(name);
    const Picture before(source);
    for (int y = 0; y < 360; ++y)
    {
        for (int x = 0; x < 720; ++x)
        {
            const double step = y < 60 || y >= 300 ? 180 : 60;
            const double to_meridian = from_multiple(x + 0.5, step);
            const double to_parallel = y > 30 && y < 330 ? from_multiple(y + 0.5, 60) : 99;
            const double distance = std::fmin(to_meridian, to_parallel);
            if (distance < 1)
            {
                close(picture.first(x, y), 1, 0, at_pixel("line at", x, y));
            }
            else if (distance > 2.6)
            {
                close(picture.first(x, y), before.first(x, y), 0, at_pixel("no line at", x, y));
            }
            else if (distance < 2)
            {
                expect(picture.first(x, y) < before.first(x, y), at_pixel("no casing at", x, y));
            }
        }
    }
}

// Meridians of the front face, parallels beside its edges, the four meridians and the circles around the
// pole.
void check_cube_graticule(const std::string &name)
{
    const Picture picture(name);
    const int size = picture.width / 4;
    const double middle = 1.5 * size;
    std::vector<double> wanted;
    for (int lon = -30; lon <= 30; lon += 15)
    {
        wanted.push_back(size / 2.0 * (1 + std::tan(radians(lon))));
    }
    // the edges lie on the meridians of 45 degrees: half of each line is on the face
    const std::vector<double> front =
        line_centres(row_of(picture, static_cast<int>(middle) + size / 16, size, 2 * size));
    check_lines(without_ends(front), wanted, 0.05, "front");
    for (int lon = -30; lon <= 30; lon += 15)
    {
        const int x = static_cast<int>(
            std::lround(middle + size / 2.0 * std::tan(radians(lon)) - size / 12.0));
        const double u = (x + 0.5 - middle) / (size / 2.0);
        wanted.clear();
        for (int lat = 30; lat >= -30; lat -= 15)
        {
            wanted.push_back(middle - size -
                             size / 2.0 * std::hypot(1, u) * std::tan(radians(lat)));
        }
        check_lines(line_centres(column_of(picture, x, size, 2 * size)), wanted, 0.1,
                    "parallels at " + std::to_string(lon));
    }
    for (int y = size; y < 2 * size; ++y)
    {
        close(picture.first(size - 1, y), picture.first(size, y), 1.0 / 255,
              "seam at " + std::to_string(y));
    }
    for (const auto &[degrees, meridians] :
         {std::pair(80, 4), std::pair(70, 24), std::pair(50, 24)})
    {
        const int found = meridians_across(picture, middle, size, degrees);
        expect(found == meridians, std::to_string(found) + " meridians at " +
                                       std::to_string(degrees) + " degrees, not " +
                                       std::to_string(meridians));
    }
}

void check_cube_grid(const std::string &name, int cells)
{
    const Picture picture(name);
    std::vector<double> wanted;
    for (int k = 1; k < cells; ++k)
    {
        wanted.push_back(static_cast<double>(picture.width) * k / cells);
    }
    const int at = picture.width / cells / 2;
    for (const std::vector<double> &line :
         {row_of(picture, at, 0, picture.width), column_of(picture, at, 0, picture.height)})
    {
        check_lines(without_ends(line_centres(line)), wanted, 0.01, "grid");
        close(line.front(), 1, 0, "the edge");
        close(line.back(), 1, 0, "the edge");
    }
}

// Near the equator at its lines of u, at the pole at one circle.
void check_equirect_grid(const std::string &name)
{
    const Picture picture(name);
    const double third = degrees_of(std::atan(1.0 / 3));
    std::vector<double> wanted;
    for (const int face : {-180, -90, 0, 90, 180})
    {
        for (const double lon : {-45.0, -third, third})
        {
            const double x = 2 * (180 + face + lon);
            if (x > 0 && x < 720)
            {
                wanted.push_back(x);
            }
        }
    }
    const std::vector<double> row = row_of(picture, 175, 0, picture.width);
    check_lines(line_centres(row), wanted, 0.05, "equator");
    double sum = 0;
    for (const double value : row)
    {
        sum += value;
    }
    close(sum, 2 * 12, 0.2, "the width of all lines");
    std::vector<double> top;
    for (const double lat : {third, 45.0, 90 - third, 90 + third, 135.0, 180 - third})
    {
        top.push_back(2 * lat);
    }
    check_lines(line_centres(column_of(picture, 359, 0, picture.height)), top, 0.1, "lon 0");
}

void check_pixel(const std::string &name, int x, int y, const std::vector<double> &wanted)
{
    const Picture picture(name);
    expect(std::size_t(picture.channels) == wanted.size(),
           "channels: " + std::to_string(picture.channels));
    for (std::size_t c = 0; c < wanted.size(); ++c)
    {
        close(static_cast<double>(picture.at(x, y)[c]), wanted[c], 1e-3, at_pixel("pixel", x, y));
    }
}

void check_finite(const std::string &name)
{
    const Picture picture(name);
    expect(std::none_of(picture.values.begin(), picture.values.end(),
                        [](float value) { return std::isnan(value); }),
           "there is a NaN");
}
