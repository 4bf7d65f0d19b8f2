// SPDX-License-Identifier: MIT

#include "graticule.hpp"
#include "tools/cli/circle.hpp"

#include <algorithm>
#include <cmath>

namespace
{

// Meridians end at a parallel beyond which they would be closer than this part of their distance at
// the equator, and at the last parallel but for those that are this far apart.
constexpr double closest = 0.25;
constexpr double apart_at_pole = pi / 2;

constexpr double rounding = 1e-9;

double product(const double one[3], const double other[3])
{
    return one[0] * other[0] + one[1] * other[1] + one[2] * other[2];
}

// By how much a pixel's step moves a point in this direction of the sphere, at most.
double per_pixel(const MovingDirection &point, const double along[3])
{
    return std::hypot(product(along, point.by_x), product(along, point.by_y));
}

// The smallest multiple of factor that divides count and is at least so large; else count.
int next_divisor(int count, int factor, double least)
{
    for (int k = factor; k < count; k += factor)
    {
        if (count % k == 0 && k >= least)
        {
            return k;
        }
    }
    return count;
}

} // namespace

Graticule::Graticule(double degrees)
    : step(degrees * pi / 180),
      last_parallel(static_cast<int>(std::ceil(90 / degrees - rounding)) - 1)
{
    const int count = static_cast<int>(std::lround(2 * pi / step));
    int factor = 1;
    for (int zone = 0; zone <= last_parallel; ++zone)
    {
        const double least =
            zone < last_parallel ? closest / std::cos((zone + 1) * step) : apart_at_pole / step;
        factor = next_divisor(count, factor, least - rounding);
        meridian_step.push_back(factor * step);
    }
}

double Graticule::distance(const MovingDirection &point) const
{
    const double radius = std::hypot(point.at[0], point.at[1]);
    const double lat = std::atan2(point.at[2], radius);
    return std::min(to_parallel(point, lat, radius), to_meridian(point, lat, radius));
}

double Graticule::to_parallel(const MovingDirection &point, double lat, double radius) const
{
    const double nearest =
        std::clamp<double>(std::round(lat / step), -last_parallel, last_parallel);
    const double towards_axis = radius > 0 ? -point.at[2] / radius : 0;
    const double north[3] = {towards_axis * point.at[0], towards_axis * point.at[1], radius};
    return std::fabs(lat - nearest * step) / per_pixel(point, north);
}

// All meridians meet at the pole, which has no east.
double Graticule::to_meridian(const MovingDirection &point, double lat, double radius) const
{
    if (!(radius > 0))
    {
        return 0;
    }
    const std::size_t zone = static_cast<std::size_t>(std::fabs(lat) / step);
    const double between = meridian_step[std::min(zone, meridian_step.size() - 1)];
    const double lon = std::atan2(point.at[1], point.at[0]);
    const double away = lon - between * std::round(lon / between);
    const double east[3] = {-point.at[1] / radius, point.at[0] / radius, 0};
    return std::fabs(away) * radius / per_pixel(point, east);
}
