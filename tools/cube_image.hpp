// SPDX-License-Identifier: MIT
//
// The cube: six planes, and how their pictures are put together.

#ifndef CUBEMAP_TOOLS_CUBE_IMAGE_HPP
#define CUBEMAP_TOOLS_CUBE_IMAGE_HPP

#include "sphere_grid.hpp"

#include <memory>
#include <string>

#include <cubemap/mapping.h>

struct MappingDeleter
{
    void operator()(cm_mapping *owned) const noexcept
    {
        cm_mapping_destroy(owned);
    }
};

using MappingPointer = std::unique_ptr<cm_mapping, MappingDeleter>;

// The specification must be one that the library takes. Failure if the instruction set that the
// environment asks for is not there.
MappingPointer make_mapping(const std::string &specification, const cm_frame &frame);

class CubeImage : public Projection
{
public:
    // Faces of size x size pixels. The specification must be one that the library takes.
    CubeImage(const std::string &specification, const cm_frame &frame, int size);

    int planes() const noexcept override
    {
        return 6;
    }
    int width() const noexcept override
    {
        return size;
    }
    int height() const noexcept override
    {
        return size;
    }

    void directions(int plane, int row, int first_column, std::size_t count,
                    PointBatch &batch) const override;
    void positions(std::size_t count, PointBatch &batch) const override;
    void derivatives(std::size_t count, const PointBatch &batch,
                     DerivativeBatch &derivatives) const override;
    bool wraps() const noexcept override
    {
        return false;
    }
    void fill_border(SphereGrid &grid) const override;

    // Sets face, u and v (as plane, x and y) of the centres of count pixels of a row.
    void face_coordinates(int face, int row, int first_column, std::size_t count,
                          PointBatch &batch) const;

private:
    MappingPointer mapping;
    cm_frame frame;
    int size;
};

// Where in a picture a plane stands: the plane's upper left corner, in units of its size.
struct Placement
{
    int plane;
    int column;
    int row;
};

// A picture of columns x rows places for planes.
struct PictureLayout
{
    int columns;
    int rows;
    std::vector<Placement> placements;
};

enum class CubeLayout
{
    faces,
    strip,
    cross
};

// The pictures of a cube: one of each face, or a strip of the faces in their order, or the unfolded
// cube. In the cross no face is turned: the middle of its second row is the face that the one above
// and the one below it join as they are drawn. Failure if the frame has no such face.
std::vector<PictureLayout> cube_pictures(CubeLayout layout, const cm_frame &frame);

#endif
