// SPDX-License-Identifier: MIT
//
// The cube: six planes, and how their pictures are put together.

#ifndef CUBEMAP_TOOLS_CUBE_IMAGE_HPP
#define CUBEMAP_TOOLS_CUBE_IMAGE_HPP

#include "face_image.hpp"

#include <vector>

class CubeImage : public FaceImage
{
public:
    // Faces of size x size pixels. The specification must be one that the library takes, and for six
    // faces.
    CubeImage(const std::string &specification, const cm_frame &faces_frame, int face_size);
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

// The columns of a cross, 0 to 3, that its uppermost and lowest face are in.
struct PolarColumns
{
    int north = 1;
    int south = 1;
};

// The pictures of a cube: one of each face, or a strip of the faces in their order, or the unfolded
// cube. In the cross no face is turned: the second of its second row is the face that the one above
// and the one below it join as they are drawn. In other columns those two are turned, as turn_poles does it.
// Failure if the frame has no such face.
std::vector<PictureLayout> cube_pictures(CubeLayout layout, const cm_frame &frame,
                                         PolarColumns columns = {});

// The frame in which the faces of the cross join those of their columns as they are drawn.
cm_frame turn_poles(const cm_frame &frame, PolarColumns columns);

#endif
