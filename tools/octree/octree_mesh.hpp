// SPDX-License-Identifier: MIT
//
// A mesh that stands in a map: what a camera sees of it.

#ifndef CUBEMAP_TOOLS_OCTREE_MESH_HPP
#define CUBEMAP_TOOLS_OCTREE_MESH_HPP

#include "tools/cli/scene_handle.hpp"

#include <memory>
#include <string>
#include <vector>

#include <cubemap/mesh.h>
#include <cubemap/pool.h>
#include <cubemap/raster.h>

class MeshCanvas
{
public:
    // The mesh of a file, and how it stands: a file of one pose, or "". Failure.
    MeshCanvas(const std::string &file, const std::string &pose_file);

    // Draws it in front of a camera, which must outlive this. The pool may be nullptr.
    void draw(const cm_camera *camera, const cm_pose &pose, cm_pool *pool);

    const cm_raster *canvas() const noexcept
    {
        return raster.get();
    }
    // Three a pixel: its colours, shaded by the angle to the camera.
    const float *colors() const noexcept
    {
        return color.data();
    }

private:
    void shade(const cm_pose &pose, std::size_t pixels);

    std::unique_ptr<cm_mesh, HandleDeleter<cm_mesh_destroy>> mesh;
    std::vector<double> position; // of the world
    std::unique_ptr<cm_raster, HandleDeleter<cm_raster_destroy>> raster;
    std::vector<float> color;
};

#endif
