// SPDX-License-Identifier: MIT
//
// The lines of u and v that divide the faces of a cube into cells.

#ifndef CUBEMAP_TOOLS_FACE_GRID_HPP
#define CUBEMAP_TOOLS_FACE_GRID_HPP

#include "cube_image.hpp"

class FaceGrid
{
public:
    // N x N cells a face of this mapping, which must outlive the grid. In pictures of the faces themselves
    // own_size is the edge of one in pixels; in others it is 0.
    FaceGrid(const cm_mapping &cube_mapping, int cells, int own_size)
        : mapping(cube_mapping), count(cells), size(own_size)
    {
    }

    // Lowers each of the first distances to that of the nearest line, in pixels, by the derivatives at
    // the point.
    void lower_distances(std::size_t points, const PointBatch &batch,
                         const DerivativeBatch &derivatives, double *distance) const;

private:
    void lower_own_distances(std::size_t points, const PointBatch &batch, double *distance) const;

    const cm_mapping &mapping;
    int count;
    int size;
};

#endif
