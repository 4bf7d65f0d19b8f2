// SPDX-License-Identifier: MIT

#include "overlay.hpp"
#include "tools/cli/circle.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace
{

// The casing on each side of a line: that part of its width, but at least so many pixels.
constexpr double casing_part = 0.5;
constexpr double casing_least = 0.75;
constexpr double casing_opacity = 0.6;

double casing_of(double width)
{
    return std::max(casing_least, casing_part * width);
}

// How much of a pixel of width 1 a line covers, at this distance of their middles.
double coverage(double distance, double width)
{
    const double right = std::min(distance + 0.5, width / 2);
    const double left = std::max(distance - 0.5, -width / 2);
    return std::clamp(right - left, 0.0, 1.0);
}

float luminance(const Color &color)
{
    return 0.2126f * color[0] + 0.7152f * color[1] + 0.0722f * color[2]; // BT.709
}

// One colour over a pixel.
class Brush
{
public:
    Brush(const Color &brush_color, const PixelChannels &pixel_channels)
        : color(brush_color), channels(pixel_channels)
    {
        const int colors = channels.count - (channels.alpha >= 0 ? 1 : 0);
        if (colors < 3)
        {
            color.fill(luminance(color));
        }
    }

    // The first three channels that are not alpha take the colour, or one or two its luminance; further
    // ones are not colours and stay as they are.
    void put(double opacity, float *pixel) const
    {
        if (!(opacity > 0))
        {
            return;
        }
        const float part = static_cast<float>(opacity);
        const float alpha_before = channels.alpha >= 0 ? pixel[channels.alpha] : 1.0f;
        const float alpha_after = part + alpha_before * (1 - part);
        const bool divide = channels.alpha >= 0 && !channels.multiplied;
        // of a colour that is not multiplied, less shows below where little of it was there
        const float weight = divide ? part / alpha_after : part;
        std::size_t next = 0;
        for (int c = 0; c < channels.count && next < color.size(); ++c)
        {
            if (c != channels.alpha)
            {
                // no product where nothing is left: infinities may be below
                const float below = weight >= 1 ? 0.0f : (1 - weight) * pixel[c];
                pixel[c] = below + weight * color[next];
                ++next;
            }
        }
        if (channels.alpha >= 0)
        {
            pixel[channels.alpha] = alpha_after;
        }
    }

private:
    Color color;
    PixelChannels channels;
};

} // namespace

void LineRow::draw(const LineStyle &style, const PixelChannels &channels, float *pixels) const
{
    const Brush line(style.color, channels);
    const bool light = luminance(style.color) >= 0.5f;
    const Brush casing(light ? Color{0, 0, 0} : Color{1, 1, 1}, channels);
    const double cased = style.width + 2 * casing_of(style.width);
    for (std::size_t i = 0; i < distance.size(); ++i)
    {
        float *const pixel = pixels + i * static_cast<std::size_t>(channels.count);
        line.put(covered[i] * style.fill, pixel);
        if (distance[i] < cased / 2 + 0.5)
        {
            casing.put(casing_opacity * coverage(distance[i], cased), pixel);
            line.put(coverage(distance[i], style.width), pixel);
        }
    }
}

Overlay::Overlay(const OverlayOptions &wanted, const LineFaces &faces, const Projection &target)
    : options(wanted), sphere(target), cube(make_mapping(faces.mapping, faces.frame))
{
    if (faces.turn != nullptr)
    {
        turn = *faces.turn;
    }
    if (options.graticule)
    {
        graticule.emplace(*options.graticule);
    }
    if (options.grid)
    {
        grid.emplace(*cube, *options.grid, faces.are_targets ? target.width() : 0);
    }
    if (options.indicatrices)
    {
        std::optional<double> radius;
        if (options.indicatrices_radius)
        {
            radius = *options.indicatrices_radius * pi / 180;
        }
        indicatrices.emplace(*cube, *options.indicatrices, radius, target);
        indicatrices->set_margin(options.line_width / 2 + casing_of(options.line_width) + 1);
    }
}

void Overlay::add_lines(int plane, int row, LineRow &lines) const
{
    thread_local PointBatch batch;
    thread_local DerivativeBatch derivatives;
    for (int column = 0; (graticule || grid) && column < sphere.width();)
    {
        const std::size_t count =
            std::min(PointBatch::capacity, static_cast<std::size_t>(sphere.width() - column));
        sphere.directions(plane, row, column, count, batch);
        for (std::size_t i = 0; i < count; ++i)
        {
            batch.plane[i] = static_cast<std::uint8_t>(plane);
            batch.x[i] = column + static_cast<double>(i) + 0.5;
            batch.y[i] = row + 0.5;
        }
        sphere.derivatives(count, batch, derivatives);
        add_lines_of_batch(count, batch, derivatives, lines.distance.data() + column);
        column += static_cast<int>(count);
    }
    if (indicatrices)
    {
        indicatrices->draw_row(plane, row, lines.distance.data(), lines.covered.data());
    }
}

void Overlay::add_lines_of_batch(std::size_t count, const PointBatch &batch,
                                 const DerivativeBatch &derivatives, double *distance) const
{
    if (grid)
    {
        grid->lower_distances(count, batch, derivatives, distance);
    }
    for (std::size_t i = 0; graticule && i < count; ++i)
    {
        if (std::isnan(batch.direction_x[i]))
        {
            continue;
        }
        const auto &by_x = derivatives.by_x;
        const auto &by_y = derivatives.by_y;
        const MovingDirection point = {
            {batch.direction_x[i], batch.direction_y[i], batch.direction_z[i]},
            {by_x[0][i], by_x[1][i], by_x[2][i]},
            {by_y[0][i], by_y[1][i], by_y[2][i]}};
        distance[i] = std::fmin(distance[i], graticule->distance(turn ? on_earth(point) : point));
    }
}

MovingDirection Overlay::on_earth(const MovingDirection &point) const
{
    MovingDirection there;
    cm_rotate_back(&*turn, point.at, there.at);
    cm_rotate_back(&*turn, point.by_x, there.by_x);
    cm_rotate_back(&*turn, point.by_y, there.by_y);
    return there;
}

std::string Overlay::description() const
{
    const auto number = [](double value)
    {
        char text[40];
        std::snprintf(text, sizeof text, "%.6g", value);
        return std::string(text);
    };
    std::string text;
    const auto add = [&text](const std::string &part)
    { text += (text.empty() ? "" : ", ") + part; };
    if (graticule)
    {
        add("graticule of " + number(*options.graticule) + " degrees");
    }
    if (grid)
    {
        add("grid of " + std::to_string(*options.grid) + " x " + std::to_string(*options.grid));
    }
    if (indicatrices)
    {
        add("ellipses of circles of " + number(indicatrices->radius() * 180 / pi) + " degrees");
        if (indicatrices->missing() > 0)
        {
            add(std::to_string(indicatrices->missing()) + " at poles left out");
        }
    }
    return text;
}
