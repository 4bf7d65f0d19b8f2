// SPDX-License-Identifier: MIT
//
// Meridians and parallels.

#ifndef CUBEMAP_TOOLS_GRATICULE_HPP
#define CUBEMAP_TOOLS_GRATICULE_HPP

#include <vector>

// A direction of unit length, and how it moves with the pixels of a picture, to the right and down.
struct MovingDirection
{
    double at[3];
    double by_x[3];
    double by_y[3];
};

class Graticule
{
public:
    // Degrees that divide 360.
    explicit Graticule(double degrees);

    // How far the nearest line is, in pixels, by the derivatives at the point.
    double distance(const MovingDirection &point) const;

private:
    double to_parallel(const MovingDirection &point, double lat, double radius) const;
    double to_meridian(const MovingDirection &point, double lat, double radius) const;

    double step; // radians, as all here
    int last_parallel;
    std::vector<double> meridian_step; // between two parallels, from the equator on
};

#endif
