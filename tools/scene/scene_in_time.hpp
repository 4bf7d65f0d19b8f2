// SPDX-License-Identifier: MIT
//
// A world whose primitives move: what rays meet in it at a time, and where points of it are at another.

#ifndef CUBEMAP_TOOLS_SCENE_SCENE_IN_TIME_HPP
#define CUBEMAP_TOOLS_SCENE_SCENE_IN_TIME_HPP

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <cubemap/world.h>

#include "tools/cli/scene_world.hpp"

// The components of n vectors.
using VectorArrays = std::array<const double *, 3>;

// Constant after its creation; any number of threads may use it.
class SceneInTime
{
public:
    // The world, with its meshes and motions, must outlive this.
    explicit SceneInTime(const cm_scene *world);

    // As cm_scene_cast_array, in the world as it stands at that time; hit.triangle and hit.reflectance must be NULL, and
    // hit.distance must not.
    void cast(double time, std::size_t n, const VectorArrays &origin, const VectorArrays &direction,
              const cm_hit_arrays &hit) const;

    // A point of a primitive, from one time to another.
    void carry(std::uint32_t id, double from, double to, double point[3]) const;

private:
    using Scene = std::unique_ptr<cm_scene, SceneDeleter>;

    // One primitive as it stands in the file, and its way.
    struct Moving
    {
        std::uint32_t id;
        const cm_trajectory *motion;
        Scene scene;
    };

    void cast_moving(const Moving &moving, double time, std::size_t n, const VectorArrays &origin,
                     const VectorArrays &direction, const cm_hit_arrays &hit) const;

    const cm_scene *whole;
    Scene standing;                // what does not move, where something does
    std::vector<std::uint32_t> id; // of these in the whole world
    std::vector<Moving> moving;
};

#endif
