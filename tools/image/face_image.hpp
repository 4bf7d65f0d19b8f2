// SPDX-License-Identifier: MIT
//
// Square images of a mapping's faces: one plane for each.

#ifndef CUBEMAP_TOOLS_FACE_IMAGE_HPP
#define CUBEMAP_TOOLS_FACE_IMAGE_HPP

#include "projection.hpp"

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

// Six, or one.
int face_count(const cm_mapping &mapping);

class FaceImage : public Projection
{
public:
    int planes() const noexcept override
    {
        return face_count(*mapping);
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

    // The area of the faces, 2 wide, over that of what they have of the unit sphere.
    virtual double mean_scale() const;

    // Sets face, u and v (as plane, x and y) of the centres of count pixels of a row.
    void face_coordinates(int face, int row, int first_column, std::size_t count,
                          PointBatch &batch) const;

protected:
    // Faces of size x size pixels. The specification must be one that the library takes.
    FaceImage(const std::string &specification, const cm_frame &faces_frame, int face_size);

    const MappingPointer mapping;
    const cm_frame frame;
    const int size;
};

#endif
