// SPDX-License-Identifier: MIT

#include "scene_in_time.hpp"

#include <new>

namespace
{

std::unique_ptr<cm_scene, SceneDeleter> empty_scene()
{
    cm_scene *made = nullptr;
    if (cm_scene_create(&made) != CM_OK)
    {
        throw std::bad_alloc();
    }
    return std::unique_ptr<cm_scene, SceneDeleter>(made);
}

// Of a primitive that a world has already, so that memory alone can be short.
void add_to(cm_scene *scene, const cm_primitive &primitive)
{
    if (cm_scene_add(scene, &primitive, nullptr) != CM_OK)
    {
        throw std::bad_alloc();
    }
}

// As the library cubemap-sim has it: before its first stamp and after its last one it stands.
cm_pose pose_at(const cm_trajectory *motion, double time)
{
    cm_pose pose;
    if (cm_trajectory_interpolate(motion, time, &pose) != CM_OK)
    {
        double first = 0;
        (void)cm_trajectory_at(motion, 0, &first, nullptr);
        const std::size_t end = time < first ? 0 : cm_trajectory_count(motion) - 1;
        (void)cm_trajectory_at(motion, end, nullptr, &pose);
    }
    return pose;
}

// n vectors of their own.
struct OwnVectors
{
    explicit OwnVectors(std::size_t n)
        : part{std::vector<double>(n), std::vector<double>(n), std::vector<double>(n)}
    {
    }
    void set(std::size_t i, const double vector[3])
    {
        for (std::size_t k = 0; k < 3; ++k)
        {
            part[k][i] = vector[k];
        }
    }
    std::array<std::vector<double>, 3> part;
};

} // namespace

SceneInTime::SceneInTime(const cm_scene *world) : whole(world)
{
    const std::size_t count = cm_scene_count(world);
    standing = empty_scene();
    for (std::size_t i = 0; i < count; ++i)
    {
        const std::uint32_t number = static_cast<std::uint32_t>(i);
        const cm_primitive &primitive = *cm_scene_at(world, number);
        if (primitive.motion == nullptr)
        {
            add_to(standing.get(), primitive);
            id.push_back(number);
            continue;
        }
        moving.push_back({number, primitive.motion, empty_scene()});
        add_to(moving.back().scene.get(), primitive);
    }
}

void SceneInTime::cast(double time, std::size_t n, const VectorArrays &origin,
                       const VectorArrays &direction, const cm_hit_arrays &hit) const
{
    const cm_scene *const first = moving.empty() ? whole : standing.get();
    cm_scene_cast_array(first, n, origin[0], origin[1], origin[2], direction[0], direction[1],
                        direction[2], &hit);
    if (moving.empty())
    {
        return;
    }
    for (std::size_t i = 0; hit.id != nullptr && i < n; ++i)
    {
        hit.id[i] = hit.id[i] == CM_SCENE_NOTHING ? CM_SCENE_NOTHING : id[hit.id[i]];
    }
    for (const Moving &each : moving)
    {
        cast_moving(each, time, n, origin, direction, hit);
    }
}

// Rays go where the primitive stands in the file: distances are the same there.
void SceneInTime::cast_moving(const Moving &each, double time, std::size_t n,
                              const VectorArrays &origin, const VectorArrays &direction,
                              const cm_hit_arrays &hit) const
{
    const cm_pose pose = pose_at(each.motion, time);
    OwnVectors from(n), along(n), normal(n), color(n);
    for (std::size_t i = 0; i < n; ++i)
    {
        double point[3] = {origin[0][i], origin[1][i], origin[2][i]};
        double way[3] = {direction[0][i], direction[1][i], direction[2][i]};
        cm_pose_apply(&pose, point, point);
        cm_rotate(&pose.rotation, way, way);
        from.set(i, point);
        along.set(i, way);
    }
    std::vector<double> distance(n);
    std::vector<std::uint32_t> met(n);
    const cm_hit_arrays own = {
        sizeof own,
        distance.data(),
        met.data(),
        nullptr,
        {normal.part[0].data(), normal.part[1].data(), normal.part[2].data()},
        {color.part[0].data(), color.part[1].data(), color.part[2].data()},
        nullptr};
    cm_scene_cast_array(each.scene.get(), n, from.part[0].data(), from.part[1].data(),
                        from.part[2].data(), along.part[0].data(), along.part[1].data(),
                        along.part[2].data(), &own);
    for (std::size_t i = 0; i < n; ++i)
    {
        const bool is_lower = hit.id != nullptr && each.id < hit.id[i];
        if (met[i] == CM_SCENE_NOTHING || distance[i] > hit.distance[i] ||
            (distance[i] == hit.distance[i] && !is_lower))
        {
            continue;
        }
        hit.distance[i] = distance[i];
        if (hit.id != nullptr)
        {
            hit.id[i] = each.id;
        }
        double turned[3] = {normal.part[0][i], normal.part[1][i], normal.part[2][i]};
        cm_rotate_back(&pose.rotation, turned, turned);
        for (std::size_t k = 0; k < 3 && hit.normal[k] != nullptr; ++k)
        {
            hit.normal[k][i] = turned[k];
        }
        for (std::size_t k = 0; k < 3 && hit.color[k] != nullptr; ++k)
        {
            hit.color[k][i] = color.part[k][i];
        }
    }
}

void SceneInTime::carry(std::uint32_t number, double from, double to, double point[3]) const
{
    const cm_primitive *const primitive = cm_scene_at(whole, number);
    if (primitive != nullptr && primitive->motion != nullptr)
    {
        const cm_pose here = pose_at(primitive->motion, from);
        const cm_pose there = pose_at(primitive->motion, to);
        cm_pose_apply(&here, point, point);
        cm_pose_apply_back(&there, point, point);
    }
}
