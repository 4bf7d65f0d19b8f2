// SPDX-License-Identifier: MIT

#include "indicatrices.hpp"
#include "tools/cli/circle.hpp"
#include "tools/cli/program.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include <cubemap/distortion.h>

namespace
{

// An ellipse fills so much of the cell around its centre.
constexpr double part_of_cell = 0.9;

double cell_centre(int index, int cells)
{
    return (2.0 * index + 1) / cells - 1;
}

// The largest radius with which every ellipse stays inside its cell, 2 / cells wide. An ellipse reaches
// as far along u as its radius times the length of u's gradient, which is that of the derivative of
// the direction by v over the area of the two.
double largest_radius(const cm_mapping &cube, int cells)
{
    double steepest = 0;
    for (std::uint8_t face = 0; face < face_count(cube); ++face)
    {
        for (int i = 0; i < cells * cells; ++i)
        {
            const double uv[2] = {cell_centre(i % cells, cells), cell_centre(i / cells, cells)};
            cm_distortion at = {};
            cm_inverse_distortion(&cube, face, uv, &at);
            const double cosine = std::cos(at.orientation);
            const double sine = std::sin(at.orientation);
            // NaN where a disc has no place
            steepest = std::fmax(steepest, std::hypot(at.major * cosine, at.minor * sine));
            steepest = std::fmax(steepest, std::hypot(at.major * sine, at.minor * cosine));
        }
    }
    return part_of_cell / (cells * steepest);
}

} // namespace

Indicatrices::Indicatrices(const cm_mapping &cube, int cells, std::optional<double> wanted_radius,
                           const Projection &target)
    : sphere(target), ellipses(static_cast<std::size_t>(target.planes()))
{
    choose_radius(cube, cells, wanted_radius);
    for (std::uint8_t face = 0; face < face_count(cube); ++face)
    {
        add_face(cube, face, cells);
    }
    for (std::vector<Ellipse> &plane : ellipses)
    {
        std::sort(plane.begin(), plane.end(),
                  [](const Ellipse &one, const Ellipse &other) { return one.y < other.y; });
    }
}

void Indicatrices::choose_radius(const cm_mapping &cube, int cells, std::optional<double> wanted)
{
    const double largest = largest_radius(cube, cells);
    circle = wanted.value_or(largest);
    if (circle > largest / part_of_cell)
    {
        char text[100];
        std::snprintf(text, sizeof text,
                      "%.6g degrees would make ellipses overlap; with %d x %d a "
                      "face, %.6g at most",
                      circle * 180 / pi, cells, cells, largest / part_of_cell * 180 / pi);
        throw UsageFailure(std::string("--indicatrices-radius: ") + text);
    }
}

void Indicatrices::add_face(const cm_mapping &cube, std::uint8_t face, int cells)
{
    const auto batch = std::make_unique<PointBatch>();
    const auto derivatives = std::make_unique<DerivativeBatch>();
    for (int i = 0; i < cells * cells; ++i)
    {
        const double uv[2] = {cell_centre(i % cells, cells), cell_centre(i / cells, cells)};
        double direction[3];
        cm_inverse(&cube, face, uv, direction);
        if (std::isnan(direction[0]))
        {
            continue; // no place of a disc
        }
        batch->direction_x[0] = direction[0];
        batch->direction_y[0] = direction[1];
        batch->direction_z[0] = direction[2];
        sphere.positions(1, *batch);
        sphere.derivatives(1, *batch, *derivatives);
        Ellipse ellipse = {batch->x[0], batch->y[0], 0, 0, 0, 0, 0};
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
            const double by_x = derivatives->by_x[axis][0];
            const double by_y = derivatives->by_y[axis][0];
            ellipse.xx += by_x * by_x;
            ellipse.xy += by_x * by_y;
            ellipse.yy += by_y * by_y;
        }
        const double area = std::sqrt(ellipse.xx * ellipse.yy - ellipse.xy * ellipse.xy);
        ellipse.reach_x = circle * std::sqrt(ellipse.yy) / area;
        ellipse.reach_y = circle * std::sqrt(ellipse.xx) / area;
        // At a pole rounding may leave a finite ellipse of no meaning.
        if (!(ellipse.reach_x < sphere.width()) || !(ellipse.reach_y < sphere.height()))
        {
            ++singular;
            continue;
        }
        tallest = std::max(tallest, ellipse.reach_y);
        ellipses[batch->plane[0]].push_back(ellipse);
    }
}

void Indicatrices::draw_row(int plane, int row, double *distance, double *covered) const
{
    const std::vector<Ellipse> &all = ellipses[static_cast<std::size_t>(plane)];
    const double reach = tallest + margin + 1;
    const auto is_above = [](const Ellipse &ellipse, double y) { return ellipse.y < y; };
    const auto first = std::lower_bound(all.begin(), all.end(), row - reach, is_above);
    for (auto ellipse = first; ellipse != all.end() && ellipse->y <= row + 1 + reach; ++ellipse)
    {
        if (std::fabs(row + 0.5 - ellipse->y) <= ellipse->reach_y + margin)
        {
            draw_part(*ellipse, row, distance, covered);
        }
    }
}

// The distance by the derivative at the point is exact on the outline, and good near it.
void Indicatrices::draw_part(const Ellipse &ellipse, int row, double *distance,
                             double *covered) const
{
    const int width = sphere.width();
    const double reach = ellipse.reach_x + margin;
    int first = static_cast<int>(std::floor(ellipse.x - reach));
    int last = static_cast<int>(std::ceil(ellipse.x + reach));
    first = sphere.wraps() ? first : std::max(first, 0);
    last = std::min(last, sphere.wraps() ? first + width - 1 : width - 1);
    const double dy = row + 0.5 - ellipse.y;
    for (int column = first; column <= last; ++column)
    {
        const double dx = column + 0.5 - ellipse.x;
        const double along_x = ellipse.xx * dx + ellipse.xy * dy;
        const double along_y = ellipse.xy * dx + ellipse.yy * dy;
        const double from_centre = std::sqrt(dx * along_x + dy * along_y);
        const double slope = std::hypot(along_x, along_y) / from_centre;
        const double outside = from_centre > 0 ? (from_centre - circle) / slope
                                               : -std::min(ellipse.reach_x, ellipse.reach_y);
        const int place = (column % width + width) % width;
        distance[place] = std::min(distance[place], std::fabs(outside));
        covered[place] = std::max(covered[place], std::clamp(0.5 - outside, 0.0, 1.0));
    }
}
