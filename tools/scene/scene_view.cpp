// SPDX-License-Identifier: MIT

#include "scene_view.hpp"

#include <cmath>
#include <limits>

#include <cubemap/random.h>

namespace
{

constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();
constexpr double most_units = 65535;
// A point is seen if nothing is nearer by more than this part of its range: a ray that grazes loses half its digits.
constexpr double seen_within = 1e-6;

using Numbers = std::vector<double>;

// Vectors of three, by components.
struct Vectors
{
    explicit Vectors(std::size_t n) : x(n), y(n), z(n)
    {
    }
    VectorArrays arrays() const
    {
        return {x.data(), y.data(), z.data()};
    }
    Numbers x, y, z;
};

// The rays of a row and what they meet.
struct RowHits
{
    explicit RowHits(std::size_t n)
        : column(n), row(n), ray(n), origin(n), direction(n), normal(n), color(n), distance(n),
          id(n)
    {
    }

    std::size_t count() const
    {
        return column.size();
    }
    double ray_length(std::size_t i) const
    {
        return std::sqrt(ray.x[i] * ray.x[i] + ray.y[i] * ray.y[i] + ray.z[i] * ray.z[i]);
    }

    Numbers column, row;
    Vectors ray; // in the camera's axes
    Vectors origin, direction, normal, color;
    Numbers distance;
    std::vector<std::uint32_t> id;
};

void turn_rays(const cm_pose &pose, RowHits &hits)
{
    for (std::size_t i = 0; i < hits.count(); ++i)
    {
        double ray[3] = {hits.ray.x[i], hits.ray.y[i], hits.ray.z[i]};
        cm_rotate_back(&pose.rotation, ray, ray);
        hits.direction.x[i] = ray[0];
        hits.direction.y[i] = ray[1];
        hits.direction.z[i] = ray[2];
        hits.origin.x[i] = pose.position[0];
        hits.origin.y[i] = pose.position[1];
        hits.origin.z[i] = pose.position[2];
    }
}

void cast_row(const ViewMaking &making, const ViewPlace &place, std::uint32_t row, RowHits &hits)
{
    const double centre = cm_camera_describe(making.camera)->pixel_centre;
    for (std::size_t i = 0; i < hits.count(); ++i)
    {
        hits.column[i] = static_cast<double>(i) + centre;
        hits.row[i] = row + centre;
    }
    cm_camera_ray_array(making.camera, hits.count(), hits.column.data(), hits.row.data(),
                        hits.ray.x.data(), hits.ray.y.data(), hits.ray.z.data());
    turn_rays(place.pose, hits);
    const cm_hit_arrays hit = {sizeof hit,
                               hits.distance.data(),
                               hits.id.data(),
                               nullptr,
                               {hits.normal.x.data(), hits.normal.y.data(), hits.normal.z.data()},
                               {hits.color.x.data(), hits.color.y.data(), hits.color.z.data()},
                               nullptr};
    making.scene->cast(place.time, hits.count(), hits.origin.arrays(), hits.direction.arrays(),
                       hit);
}

std::uint16_t units_of(double depth)
{
    const double units = std::round(depth);
    return units >= 1 && units <= most_units ? static_cast<std::uint16_t>(units) : std::uint16_t{0};
}

void put_pictures(const ViewMaking &making, std::uint32_t number, std::uint32_t row,
                  const RowHits &hits, SceneView &view)
{
    const std::size_t begin = row * hits.count();
    Numbers noise(making.noise ? hits.count() : 0);
    if (making.noise)
    {
        cm_random_normal_array(making.seed, number, static_cast<std::uint32_t>(begin), 0,
                               noise.size(), noise.data());
    }
    for (std::size_t i = 0; i < hits.count(); ++i)
    {
        const bool met = hits.id[i] != CM_SCENE_NOTHING;
        const double factor = making.noise ? 1 + *making.noise * noise[i] : 1;
        view.depth[begin + i] =
            met ? units_of(hits.distance[i] * factor * making.depth_scale) : std::uint16_t{0};
        const double color[3] = {hits.color.x[i], hits.color.y[i], hits.color.z[i]};
        for (std::size_t k = 0; k < 3; ++k)
        {
            view.color[3 * (begin + i) + k] =
                static_cast<std::uint8_t>(std::lround(255 * color[k]));
        }
    }
}

// ---- flow

struct Flow
{
    explicit Flow(std::size_t n) : column(n, nowhere), row(n, nowhere)
    {
    }
    Numbers column, row;
};

// Which points another view sees, by casting rays of length 1 that end there.
std::vector<bool> points_seen(const SceneInTime &scene, const ViewPlace &other,
                              const Vectors &points)
{
    const std::size_t n = points.x.size();
    Vectors origin(n), direction(n);
    Numbers distance(n);
    for (std::size_t i = 0; i < n; ++i)
    {
        origin.x[i] = other.pose.position[0];
        origin.y[i] = other.pose.position[1];
        origin.z[i] = other.pose.position[2];
        direction.x[i] = points.x[i] - other.pose.position[0];
        direction.y[i] = points.y[i] - other.pose.position[1];
        direction.z[i] = points.z[i] - other.pose.position[2];
    }
    const cm_hit_arrays hit = {sizeof hit,
                               distance.data(),
                               nullptr,
                               nullptr,
                               {nullptr, nullptr, nullptr},
                               {nullptr, nullptr, nullptr},
                               nullptr};
    scene.cast(other.time, n, origin.arrays(), direction.arrays(), hit);
    std::vector<bool> seen(n);
    for (std::size_t i = 0; i < n; ++i)
    {
        seen[i] = distance[i] >= 1 - seen_within;
    }
    return seen;
}

// From the pixels of a row, which are of a time, to where their points are then in another view.
Flow flow_to(const ViewMaking &making, const RowHits &hits, double time, Vectors points,
             const ViewPlace *other)
{
    const std::size_t n = hits.count();
    Flow flow(n);
    if (other == nullptr)
    {
        return flow;
    }
    const cm_camera_options &camera = *cm_camera_describe(making.camera);
    Vectors local(n);
    for (std::size_t i = 0; i < n; ++i)
    {
        double point[3] = {points.x[i], points.y[i], points.z[i]};
        making.scene->carry(hits.id[i], time, other->time, point);
        points.x[i] = point[0];
        points.y[i] = point[1];
        points.z[i] = point[2];
        cm_pose_apply(&other->pose, point, point);
        local.x[i] = point[0];
        local.y[i] = point[1];
        local.z[i] = point[2];
    }
    cm_camera_project_array(making.camera, n, local.x.data(), local.y.data(), local.z.data(),
                            flow.column.data(), flow.row.data());
    const std::vector<bool> seen = points_seen(*making.scene, *other, points);
    for (std::size_t i = 0; i < n; ++i)
    {
        const double right = flow.column[i] - camera.pixel_centre + 0.5;
        const double down = flow.row[i] - camera.pixel_centre + 0.5;
        const bool inside =
            right >= 0 && right <= camera.width && down >= 0 && down <= camera.height;
        flow.column[i] = inside && seen[i] ? flow.column[i] - hits.column[i] : nowhere;
        flow.row[i] = inside && seen[i] ? flow.row[i] - hits.row[i] : nowhere;
    }
    return flow;
}

void put_truth(const ViewMaking &making, double time, const ViewPlace *next,
               const ViewPlace *before, std::uint32_t row, const RowHits &hits, SceneView &view)
{
    const std::size_t n = hits.count();
    Vectors points(n);
    for (std::size_t i = 0; i < n; ++i)
    {
        const double far = hits.id[i] == CM_SCENE_NOTHING ? nowhere : hits.distance[i];
        points.x[i] = hits.origin.x[i] + far * hits.direction.x[i];
        points.y[i] = hits.origin.y[i] + far * hits.direction.y[i];
        points.z[i] = hits.origin.z[i] + far * hits.direction.z[i];
    }
    const Flow forward = flow_to(making, hits, time, points, next);
    const Flow backward = flow_to(making, hits, time, points, before);
    float *to = view.truth.data() + truth_channels.size() * n * row;
    for (std::size_t i = 0; i < n; ++i)
    {
        const bool met = hits.id[i] != CM_SCENE_NOTHING;
        const double far = met ? hits.distance[i] : nowhere;
        const double values[truth_channels.size()] = {far,
                                                      far * hits.ray_length(i),
                                                      points.x[i],
                                                      points.y[i],
                                                      points.z[i],
                                                      hits.normal.x[i],
                                                      hits.normal.y[i],
                                                      hits.normal.z[i],
                                                      met ? static_cast<double>(hits.id[i]) : -1,
                                                      forward.column[i],
                                                      forward.row[i],
                                                      backward.column[i],
                                                      backward.row[i]};
        for (const double value : values)
        {
            *to++ = static_cast<float>(value);
        }
    }
}

} // namespace

SceneView empty_view(const ViewMaking &making)
{
    const cm_camera_options &camera = *cm_camera_describe(making.camera);
    const std::size_t pixels = std::size_t{camera.width} * camera.height;
    SceneView view;
    view.depth.resize(pixels);
    view.color.resize(3 * pixels);
    view.truth.resize(making.truth ? truth_channels.size() * pixels : 0);
    return view;
}

void render_rows(const ViewMaking &making, std::uint32_t number, const ViewPlace &place,
                 const ViewPlace *next, const ViewPlace *before, std::uint32_t first,
                 std::uint32_t end, SceneView &view)
{
    RowHits hits(cm_camera_describe(making.camera)->width);
    for (std::uint32_t row = first; row < end; ++row)
    {
        cast_row(making, place, row, hits);
        put_pictures(making, number, row, hits, view);
        if (making.truth)
        {
            put_truth(making, place.time, next, before, row, hits, view);
        }
    }
}
