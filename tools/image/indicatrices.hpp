// SPDX-License-Identifier: MIT
//
// Tissot's indicatrices: the ellipses that the derivative of a map makes of equal circles of the
// sphere (Snyder, Map projections: a working manual, 1987, pp. 20-21), magnified so that they can be
// seen.

#ifndef CUBEMAP_TOOLS_INDICATRICES_HPP
#define CUBEMAP_TOOLS_INDICATRICES_HPP

#include "cube_image.hpp"

#include <optional>
#include <vector>

class Indicatrices
{
public:
    // At the centres of N x N cells of each face of the mapping, in pictures of the target. Without a
    // radius, in radians, the largest at which they do not overlap. UsageFailure if they would with this
    // one.
    Indicatrices(const cm_mapping &cube, int cells, std::optional<double> wanted_radius,
                 const Projection &target);

    // Of the circles on the sphere, in radians.
    double radius() const noexcept
    {
        return circle;
    }

    // How many could not be drawn, for the target is singular there: at the poles.
    int missing() const noexcept
    {
        return singular;
    }

    // Lowers each distance of a row's pixels to the nearest ellipse's outline, in pixels, and raises
    // each part of a pixel that is covered by one.
    void draw_row(int plane, int row, double *distance, double *covered) const;

    // How much beyond an ellipse, in pixels, draw_row must see to.
    void set_margin(double pixels)
    {
        margin = pixels;
    }

private:
    // Around its centre the ellipse is xx dx^2 + 2 xy dx dy + yy dy^2 = circle^2.
    struct Ellipse
    {
        double x, y;
        double xx, xy, yy;
        double reach_x, reach_y; // half the width and half the height
    };

    void choose_radius(const cm_mapping &cube, int cells, std::optional<double> wanted);
    void add_face(const cm_mapping &cube, std::uint8_t face, int cells);
    void draw_part(const Ellipse &ellipse, int row, double *distance, double *covered) const;

    const Projection &sphere;
    double circle = 0;
    double margin = 1;
    int singular = 0;
    std::vector<std::vector<Ellipse>> ellipses; // of each plane, from the top to the bottom
    double tallest = 0;
};

#endif
