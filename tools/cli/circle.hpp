// SPDX-License-Identifier: MIT
//
// Half a turn in radians.

#ifndef CUBEMAP_TOOLS_CIRCLE_HPP
#define CUBEMAP_TOOLS_CIRCLE_HPP

constexpr double pi = 3.14159265358979323846;

#endif
