// SPDX-License-Identifier: MIT

#include "cube_image.hpp"
#include "tools/cli/program.hpp"

#include <algorithm>
#include <cstdlib>

namespace
{

// The signed axis along which the columns, or rows, of a face's picture count.
int right_axis(const cm_frame &frame, int face)
{
    return frame.face[face].u;
}

int down_axis(const cm_frame &frame, int face)
{
    return frame.first_row_v > 0 ? -frame.face[face].v : frame.face[face].v;
}

int face_towards(const cm_frame &frame, int axis)
{
    int face = 0;
    while (frame.face[face].outward != axis)
    {
        ++face;
    }
    return face;
}

// Is `to` what one sees to the right of `from` when the cube is unfolded, without a turn?
bool joins_right(const cm_frame &frame, int from, int to)
{
    return frame.face[to].outward == right_axis(frame, from) &&
           right_axis(frame, to) == -frame.face[from].outward &&
           down_axis(frame, to) == down_axis(frame, from);
}

bool joins_below(const cm_frame &frame, int from, int to)
{
    return frame.face[to].outward == down_axis(frame, from) &&
           down_axis(frame, to) == -frame.face[from].outward &&
           right_axis(frame, to) == right_axis(frame, from);
}

// Turns a face about its outward axis so that these are the axes along which its columns and rows count.
void turn_face(cm_frame &frame, int face, int right, int down)
{
    frame.face[face].u = static_cast<signed char>(right);
    frame.face[face].v = static_cast<signed char>(frame.first_row_v > 0 ? -down : down);
}

// The cross around a middle face; no placements if some face would have to be turned.
PictureLayout cross_around(const cm_frame &frame, int middle)
{
    const int right = face_towards(frame, right_axis(frame, middle));
    const int left = face_towards(frame, -right_axis(frame, middle));
    const int far = face_towards(frame, -frame.face[middle].outward);
    const int below = face_towards(frame, down_axis(frame, middle));
    const int above = face_towards(frame, -down_axis(frame, middle));
    PictureLayout cross = {4, 3, {}};
    if (joins_right(frame, left, middle) && joins_right(frame, middle, right) &&
        joins_right(frame, right, far) && joins_below(frame, above, middle) &&
        joins_below(frame, middle, below))
    {
        cross.placements = {{above, 1, 0}, {left, 0, 1}, {middle, 1, 1},
                            {right, 2, 1}, {far, 3, 1},  {below, 1, 2}};
    }
    return cross;
}

PictureLayout straight_cross(const cm_frame &frame)
{
    for (int middle = 0; middle < 6; ++middle)
    {
        const PictureLayout cross = cross_around(frame, middle);
        if (!cross.placements.empty())
        {
            return cross;
        }
    }
    throw Failure(std::string("frame ") + frame.identifier +
                  " has no cross without turned faces; use another --layout");
}

} // namespace

CubeImage::CubeImage(const std::string &specification, const cm_frame &faces_frame, int face_size)
    : FaceImage(specification, faces_frame, face_size)
{
}

cm_frame turn_poles(const cm_frame &frame, PolarColumns columns)
{
    cm_frame turned = frame;
    if (columns.north == 1 && columns.south == 1)
    {
        return turned;
    }
    const std::vector<Placement> placements = straight_cross(frame).placements;
    const int above = placements[static_cast<std::size_t>(columns.north) + 1].plane;
    const int below = placements[static_cast<std::size_t>(columns.south) + 1].plane;
    turn_face(turned, placements.front().plane, right_axis(frame, above),
              frame.face[above].outward);
    turn_face(turned, placements.back().plane, right_axis(frame, below),
              -frame.face[below].outward);
    return turned;
}

std::vector<PictureLayout> cube_pictures(CubeLayout layout, const cm_frame &frame,
                                         PolarColumns columns)
{
    if (layout == CubeLayout::cross)
    {
        PictureLayout cross = straight_cross(frame);
        cross.placements.front().column = columns.north;
        cross.placements.back().column = columns.south;
        return {cross};
    }
    std::vector<PictureLayout> faces;
    PictureLayout strip = {6, 1, {}};
    for (int face = 0; face < 6; ++face)
    {
        faces.push_back({1, 1, {{face, 0, 0}}});
        strip.placements.push_back({face, face, 0});
    }
    return layout == CubeLayout::faces ? faces : std::vector<PictureLayout>{strip};
}
