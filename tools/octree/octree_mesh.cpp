// SPDX-License-Identifier: MIT

#include "octree_mesh.hpp"

#include "modules/scene/io/mesh_file.h"
#include "octree_map.hpp"

#include <array>
#include <cmath>

namespace
{

// What of the light is everywhere; the rest comes from the camera.
constexpr double ambient = 0.4;

using Vector = std::array<double, 3>;

Vector between(const double *from, const double *to)
{
    return {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
}

Vector cross(const Vector &a, const Vector &b)
{
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double dot(const Vector &a, const Vector &b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

cm_triangles triangles_of(const cm_mesh_options &shape, const std::vector<double> &position)
{
    cm_triangles triangles = {};
    triangles.size = sizeof triangles;
    triangles.vertex_count = shape.vertex_count;
    triangles.position = position.data();
    triangles.triangle_count = shape.triangle_count;
    triangles.index = shape.index;
    return triangles;
}

} // namespace

MeshCanvas::MeshCanvas(const std::string &file, const std::string &pose_file)
{
    cm_mesh *read = nullptr;
    char message[CM_IMAGE_MESSAGE] = "";
    check_scene(cm_mesh_file_read(file.c_str(), nullptr, &read, message), message);
    mesh.reset(read);
    const cm_mesh_options &shape = *cm_mesh_describe(read);
    position.assign(shape.position, shape.position + 3 * shape.vertex_count);
    if (!pose_file.empty())
    {
        const cm_pose standing = read_one_pose(pose_file);
        for (std::size_t i = 0; i < shape.vertex_count; ++i)
        {
            cm_pose_apply_back(&standing, &position[3 * i], &position[3 * i]);
        }
    }
}

void MeshCanvas::draw(const cm_camera *camera, const cm_pose &pose, cm_pool *pool)
{
    const cm_camera_options &size = *cm_camera_describe(camera);
    const cm_triangles triangles = triangles_of(*cm_mesh_describe(mesh.get()), position);
    cm_raster *made = nullptr;
    check_map(cm_raster_create(camera, 0, nullptr, &made), "the mesh");
    raster.reset(made);
    check_map(cm_raster_use_pool(made, pool), "the mesh");
    check_map(cm_raster_triangles(made, &pose, &triangles, 1), "the mesh");
    shade(pose, std::size_t{size.width} * size.height);
}

void MeshCanvas::shade(const cm_pose &pose, std::size_t pixels)
{
    const cm_mesh_options &shape = *cm_mesh_describe(mesh.get());
    const cm_triangles triangles = triangles_of(shape, position);
    std::vector<std::uint32_t> id(pixels);
    std::vector<float> second(pixels), third(pixels);
    check_map(cm_raster_read(raster.get(), nullptr, id.data()), "the mesh");
    check_map(cm_raster_weights(raster.get(), &pose, &triangles, second.data(), third.data()),
              "the mesh");
    color.assign(3 * pixels, 0.0f);
    for (std::size_t i = 0; i < pixels; ++i)
    {
        if (id[i] == CM_RASTER_NOTHING)
        {
            continue;
        }
        const std::uint32_t *const of = shape.index + 3 * std::size_t{id[i]};
        const double *const first = &position[3 * std::size_t{of[0]}];
        const Vector normal = cross(between(first, &position[3 * std::size_t{of[1]}]),
                                    between(first, &position[3 * std::size_t{of[2]}]));
        const Vector sight = between(first, pose.position);
        const double length = std::sqrt(dot(normal, normal) * dot(sight, sight));
        const double facing = length > 0 ? std::fabs(dot(normal, sight)) / length : 1;
        const float weight[3] = {1.0f - second[i] - third[i], second[i], third[i]};
        for (std::size_t k = 0; k < 3; ++k)
        {
            float mixed = shape.color == nullptr ? 1.0f : 0.0f;
            for (std::size_t j = 0; shape.color != nullptr && j < 3; ++j)
            {
                mixed += weight[j] * shape.color[3 * std::size_t{of[j]} + k];
            }
            color[3 * i + k] =
                static_cast<float>(shape.material.color[k] * (ambient + (1 - ambient) * facing)) *
                mixed;
        }
    }
}
