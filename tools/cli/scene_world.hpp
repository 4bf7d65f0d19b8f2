// SPDX-License-Identifier: MIT
//
// Worlds of programs: with a name, from a mesh, from JSON.

#ifndef CUBEMAP_TOOLS_CLI_SCENE_WORLD_HPP
#define CUBEMAP_TOOLS_CLI_SCENE_WORLD_HPP

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <cubemap/world.h>

struct SceneDeleter
{
    void operator()(cm_scene *owned) const noexcept
    {
        cm_scene_destroy(owned);
    }
};

struct MeshDeleter
{
    void operator()(cm_mesh *owned) const noexcept
    {
        cm_mesh_destroy(owned);
    }
};

struct TrajectoryDeleter
{
    void operator()(cm_trajectory *owned) const noexcept
    {
        cm_trajectory_destroy(owned);
    }
};

// A measured value of a BRDF: radians, and per steradian.
struct BrdfWord
{
    double theta_in;
    double theta_out;
    double azimuth;
    double value;
};

// What JSON says of how a surface scatters. Numbers are checked by who makes a BRDF of it.
struct BrdfDescription
{
    enum class Kind
    {
        Lambert,
        CookTorrance,
        Measured
    };
    Kind kind = Kind::Lambert;
    double diffuse = 0;
    double specular = 0;
    double roughness = 0;
    double eta = 0;
    double absorption = 0;
    std::vector<BrdfWord> measured;
};

// Makes one; nothing if its numbers are none. Programs that do not simulate light have none of these.
using BrdfMaker = std::function<std::shared_ptr<const cm_brdf>(const BrdfDescription &)>;

// A world with the meshes, motions and BRDFs that it needs.
struct World
{
    std::vector<std::unique_ptr<cm_trajectory, TrajectoryDeleter>> motions;
    std::vector<std::shared_ptr<const cm_brdf>> brdfs;
    std::vector<std::unique_ptr<cm_mesh, MeshDeleter>> meshes;
    std::unique_ptr<cm_scene, SceneDeleter> scene;
};

// SCENE of the command line. Failure; UsageFailure if it is neither a name nor a file of a kind that is read.
World load_world(const std::string &scene, const BrdfMaker &maker = nullptr);

// The world of a text of JSON. name is for messages, and meshes are in its folder.
World parse_world(const std::string &name, const std::string &text,
                  const BrdfMaker &maker = nullptr);

#endif
