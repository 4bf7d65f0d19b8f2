// SPDX-License-Identifier: MIT
//
// What is asked of pictures of distortions and of lines over pictures, computed independently of the
// programs. Each check throws what is wrong.

#ifndef TESTS_PICTURE_CHECKS_HPP
#define TESTS_PICTURE_CHECKS_HPP

#include <array>
#include <string>
#include <vector>

// ---- values

// One face of values of gnomonic, against their closed form.
void check_gnomonic(const std::string &quantity, const std::string &name);

// Strips of values, of which QUANTITY in the pattern stands for the quantity, against differences of
// the directions that the library gives.
void check_differences(const std::string &mapping, const std::string &frame,
                       const std::string &pattern);

// ---- colours

// The red, green and blue of a colour map at a place.
std::array<double, 3> color_of_map(const std::string &specification, double place);

struct ScaleOfColors
{
    std::string specification;
    double low;
    double high;
    double middle; // 0 for a linear scale
    bool reverse = false;
};

// A picture of colours, against the values and the map itself.
void check_colors(const ScaleOfColors &scale, const std::string &values, const std::string &name);

// One face: mirrored left to right, upside down, and by its diagonal it is the same, to so many grey levels.
void check_symmetric(const std::string &name, double levels);

void check_uniform(const std::string &name, const std::array<double, 3> &color);

// A face of gnomonic with isolines of area in red, 4 wide.
void check_isolines(const std::string &name, double step);

// ---- ellipses, white on black with lines 2 wide

// One face of gnomonic: a = 1 + u^2 + v^2 along the radius, b = sqrt of that across.
void check_gnomonic_ellipses(const std::string &name, int cells, double degrees);

// The ellipse in the middle of a face is a circle.
void check_circle(const std::string &name, int cells);

// Of 3 x 3 gnomonic cells a face, those of the front and the back one.
void check_equirect_ellipses(const std::string &name, double degrees);

// So many separate figures, one that goes over the left and right edge being one.
void check_count(const std::string &name, int wanted);

// ---- lines, white on black, 2 wide

// 30 degrees over 720 x 360 pixels: the two pixels beside a line are all line, the next two casing, all
// others as they were in the source.
void check_equirect_graticule(const std::string &name, const std::string &source);

// A cross of gnomonic, 15 degrees.
void check_cube_graticule(const std::string &name);

// One face of a cube: at multiples of a cell, half of them at the edges.
void check_cube_grid(const std::string &name, int cells);

// 720 x 360, 3 x 3 cells of gnomonic.
void check_equirect_grid(const std::string &name);

// ---- single pixels

void check_pixel(const std::string &name, int x, int y, const std::vector<double> &wanted);

void check_finite(const std::string &name);

#endif
