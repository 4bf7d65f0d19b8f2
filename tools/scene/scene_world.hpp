// SPDX-License-Identifier: MIT
//
// The worlds that cubemap-scene renders: with a name, from a mesh, from JSON.

#ifndef CUBEMAP_TOOLS_SCENE_WORLD_HPP
#define CUBEMAP_TOOLS_SCENE_WORLD_HPP

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

// A world with the meshes that it needs.
struct World
{
    std::vector<std::unique_ptr<cm_mesh, MeshDeleter>> meshes;
    std::unique_ptr<cm_scene, SceneDeleter> scene;
};

// SCENE of the command line. Failure; UsageFailure if it is neither a name nor a file of a kind that is read.
World load_world(const std::string &scene);

// The world of a text of JSON. name is for messages, and meshes are in its folder.
World parse_world(const std::string &name, const std::string &text);

#endif
