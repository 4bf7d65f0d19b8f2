// SPDX-License-Identifier: MIT
//
// Lines over pictures of the sphere: graticule, grids of faces, Tissot's indicatrices. Each pixel knows
// how far the nearest line is, from the derivatives of the projection; so lines are equally wide
// everywhere, and there are no seams.

#ifndef CUBEMAP_TOOLS_OVERLAY_HPP
#define CUBEMAP_TOOLS_OVERLAY_HPP

#include "face_grid.hpp"
#include "graticule.hpp"
#include "indicatrices.hpp"
#include "overlay_options.hpp"

#include <cubemap/orientation.h>

#include <limits>
#include <string>
#include <vector>

// How lines are put over pixels: in color, with a casing of the opposite lightness.
struct LineStyle
{
    double width; // pixels
    Color color;
    double fill; // how opaque ellipses are inside, 0 to 1
};

// Which of a pixel's channels are what.
struct PixelChannels
{
    int count;
    int alpha;       // -1: there is none
    bool multiplied; // are colours multiplied by alpha?
};

// For each pixel of a row, how far the nearest line is and how much of it an ellipse covers, and what
// that makes of its colour.
class LineRow
{
public:
    explicit LineRow(int width)
        : distance(static_cast<std::size_t>(width), std::numeric_limits<double>::infinity()),
          covered(static_cast<std::size_t>(width), 0.0)
    {
    }

    void draw(const LineStyle &style, const PixelChannels &channels, float *pixels) const;

    std::vector<double> distance;
    std::vector<double> covered;
};

// The mapping whose faces grid and ellipses belong to, and how it stands.
struct LineFaces
{
    std::string mapping;
    cm_frame frame;
    bool are_targets;                  // are they the faces of the target itself?
    const cm_rotation *turn = nullptr; // of the faces; NULL: as the Earth
};

class Overlay
{
public:
    // In pictures of the target, which must outlive the overlay, in the axes of the faces. UsageFailure if ellipses of
    // the radius would overlap.
    Overlay(const OverlayOptions &wanted, const LineFaces &faces, const Projection &target);

    // Adds the lines of a row of a plane.
    void add_lines(int plane, int row, LineRow &lines) const;

    // "graticule of 15 degrees, ellipses of circles of 4.05 degrees"
    std::string description() const;

private:
    void add_lines_of_batch(std::size_t count, const PointBatch &batch,
                            const DerivativeBatch &derivatives, double *distance) const;

    // From the axes of the faces to those of the Earth.
    MovingDirection on_earth(const MovingDirection &point) const;

    OverlayOptions options;
    const Projection &sphere;
    std::optional<cm_rotation> turn;
    MappingPointer cube;
    std::optional<Graticule> graticule;
    std::optional<FaceGrid> grid;
    std::optional<Indicatrices> indicatrices;
};

#endif
