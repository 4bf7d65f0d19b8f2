// SPDX-License-Identifier: MIT
//
// Poses as files write them: quaternions and matrices from camera to world.

#ifndef CUBEMAP_MODULES_SCENE_POSE_WORDS_HPP
#define CUBEMAP_MODULES_SCENE_POSE_WORDS_HPP

#include <cubemap/pose.h>

#include <array>
#include <string>

// A matrix from camera to world, whose rotation may be 1e-3 off orthonormal and is brought there; false if it is none.
bool pose_of_matrix(const std::array<std::array<double, 4>, 4> &matrix, cm_pose &pose);

// Seconds with six digits behind the point, or as many as it needs.
std::string time_text(double time);

// A line of TUM, and the four lines of a matrix, each with its newline.
std::string pose_line(double time, const cm_pose &pose);
std::string matrix_lines(const cm_pose &pose);

#endif
