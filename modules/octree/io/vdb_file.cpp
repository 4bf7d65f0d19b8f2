// SPDX-License-Identifier: MIT

#include "vdb_file.h"

#include <cstdio>

#ifdef HAVE_OPENVDB

#include <cmath>
#include <exception>
#include <new>

#include <openvdb/openvdb.h>

namespace
{

// The cells of a voxel, which may be several of the grid's.
openvdb::CoordBBox cells_of(const cm_voxel &voxel, const cm_octree_options &options, double edge)
{
    const double place[3] = {voxel.x, voxel.y, voxel.z};
    const auto many = static_cast<openvdb::Int32>(std::lround(voxel.edge / edge));
    openvdb::Coord first;
    for (int i = 0; i < 3; ++i)
    {
        const double least = (place[i] - options.centre[i] - 0.5 * voxel.edge) / edge;
        first[i] = static_cast<openvdb::Int32>(std::lround(least));
    }
    return {first, first.offsetBy(many - 1)};
}

openvdb::math::Transform::Ptr transform_of(const cm_octree_options &options, double edge)
{
    auto transform = openvdb::math::Transform::createLinearTransform(edge);
    // an index of OpenVDB is the middle of its voxel
    transform->postTranslate(openvdb::Vec3d(options.centre[0] + 0.5 * edge,
                                            options.centre[1] + 0.5 * edge,
                                            options.centre[2] + 0.5 * edge));
    return transform;
}

void write_grids(const char *path, const cm_octree_options &options, int level, size_t count,
                 const cm_voxel *voxel)
{
    openvdb::initialize();
    const double edge = std::ldexp(options.edge, level);
    auto occupancy = openvdb::FloatGrid::create(0.0f);
    auto color = openvdb::Vec3SGrid::create(openvdb::Vec3f(0.0f));
    occupancy->setName("occupancy");
    color->setName("Cd");
    occupancy->setTransform(transform_of(options, edge));
    color->setTransform(transform_of(options, edge));
    for (size_t i = 0; i < count; ++i)
    {
        const openvdb::CoordBBox cells = cells_of(voxel[i], options, edge);
        occupancy->fill(cells, static_cast<float>(voxel[i].alpha) / 255.0f);
        if (voxel[i].has_color != 0)
        {
            const openvdb::Vec3f of_voxel(voxel[i].color[0], voxel[i].color[1], voxel[i].color[2]);
            color->fill(cells, of_voxel / 255.0f);
        }
    }
    openvdb::GridPtrVec grids = {occupancy};
    if (options.color != 0)
    {
        grids.push_back(color);
    }
    openvdb::io::File file(path);
    file.write(grids);
    file.close();
}

} // namespace

int cm_vdb_is_there(void)
{
    return 1;
}

cm_status cm_vdb_write(const char *path, const char *name, const cm_octree_options *options,
                       int level, size_t count, const cm_voxel *voxel, char *message)
{
    if (path == nullptr || name == nullptr || options == nullptr || message == nullptr ||
        (voxel == nullptr && count > 0) || level < 0 || level > CM_OCTREE_LEVELS_MAX)
    {
        return CM_ERROR_ARGUMENT;
    }
    try
    {
        write_grids(path, *options, level, count, voxel);
        return CM_OK;
    }
    catch (const std::bad_alloc &)
    {
        return CM_ERROR_MEMORY;
    }
    catch (const std::exception &failure)
    {
        std::snprintf(message, CM_IMAGE_MESSAGE, "%.200s: OpenVDB cannot write it: %.300s", name,
                      failure.what());
        return CM_ERROR_FILE;
    }
}

#else

int cm_vdb_is_there(void)
{
    return 0;
}

cm_status cm_vdb_write(const char *path, const char *name, const cm_octree_options *options,
                       int level, size_t count, const cm_voxel *voxel, char *message)
{
    (void)level;
    if (path == nullptr || name == nullptr || options == nullptr || message == nullptr ||
        (voxel == nullptr && count > 0))
    {
        return CM_ERROR_ARGUMENT;
    }
    std::snprintf(message, CM_IMAGE_MESSAGE,
                  "%.200s: this build has no OpenVDB; xyz and ply need none", name);
    return CM_ERROR_UNSUPPORTED;
}

#endif
