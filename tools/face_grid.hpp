// SPDX-License-Identifier: MIT
//
// The lines of u and v that divide the faces of a cube into cells.

#ifndef CUBEMAP_TOOLS_FACE_GRID_HPP
#define CUBEMAP_TOOLS_FACE_GRID_HPP

#include "cube_image.hpp"

class FaceGrid
{
public:
    // N x N cells a face of the cube with this mapping, which must outlive the grid.
    FaceGrid(const cm_mapping &cube_mapping, int cells) : mapping(cube_mapping), count(cells)
    {
    }

    // Lowers each of the first distances to that of the nearest line, in pixels, by the derivatives at
    // the point.
    void lower_distances(std::size_t points, const PointBatch &batch,
                         const DerivativeBatch &derivatives, double *distance) const;

private:
    const cm_mapping &mapping;
    int count;
};

#endif
