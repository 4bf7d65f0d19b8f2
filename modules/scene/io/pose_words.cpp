// SPDX-License-Identifier: MIT

#include "pose_words.hpp"

#include "file_failure.hpp"

#include <charconv>
#include <cmath>

namespace
{

// How far the rows are off orthonormal: the largest element of R R^T - 1.
double off_orthonormal(const cm_rotation &rotation)
{
    double worst = 0.0;
    for (int i = 0; i < 3; ++i)
    {
        for (int j = 0; j <= i; ++j)
        {
            const double product = rotation.row[i][0] * rotation.row[j][0] +
                                   rotation.row[i][1] * rotation.row[j][1] +
                                   rotation.row[i][2] * rotation.row[j][2];
            worst = std::fmax(worst, std::fabs(product - (i == j ? 1.0 : 0.0)));
        }
    }
    return worst;
}

double determinant(const cm_rotation &rotation)
{
    const double(*const r)[3] = rotation.row;
    return r[0][0] * (r[1][1] * r[2][2] - r[1][2] * r[2][1]) -
           r[0][1] * (r[1][0] * r[2][2] - r[1][2] * r[2][0]) +
           r[0][2] * (r[1][0] * r[2][1] - r[1][1] * r[2][0]);
}

// One step of Newton to the polar factor, R <- R (3 - R^T R) / 2 (Björck & Bowie 1971, eq. 2.6), which squares the distance.
cm_rotation nearer(const cm_rotation &from)
{
    cm_rotation to;
    for (int i = 0; i < 3; ++i)
    {
        for (int j = 0; j < 3; ++j)
        {
            double sum = 3.0 * from.row[i][j];
            for (int k = 0; k < 3; ++k)
            {
                const double product = from.row[i][0] * from.row[k][0] +
                                       from.row[i][1] * from.row[k][1] +
                                       from.row[i][2] * from.row[k][2];
                sum -= product * from.row[k][j];
            }
            to.row[i][j] = 0.5 * sum;
        }
    }
    return to;
}

} // namespace

bool pose_of_matrix(const std::array<std::array<double, 4>, 4> &matrix, cm_pose &pose)
{
    for (std::size_t i = 0; i < 3; ++i)
    {
        for (std::size_t j = 0; j < 3; ++j)
        {
            pose.rotation.row[i][j] = matrix[j][i]; // files go from camera to world
        }
        pose.position[i] = matrix[i][3];
    }
    const bool affine =
        matrix[3][0] == 0.0 && matrix[3][1] == 0.0 && matrix[3][2] == 0.0 && matrix[3][3] == 1.0;
    if (!affine || !(off_orthonormal(pose.rotation) <= 1e-3) || !(determinant(pose.rotation) > 0.0))
    {
        return false;
    }
    for (int step = 0; step < 4 && off_orthonormal(pose.rotation) > 1e-15; ++step)
    {
        pose.rotation = nearer(pose.rotation);
    }
    return true;
}

std::string time_text(double time)
{
    std::array<char, 400> text;
    const std::to_chars_result result =
        std::to_chars(text.begin(), text.end(), time, std::chars_format::fixed, 6);
    const std::string_view word(text.data(), static_cast<std::size_t>(result.ptr - text.data()));
    double again = 0.0;
    return word_number(word, again) && again == time ? std::string(word) : number_text(time);
}

std::string pose_line(double time, const cm_pose &pose)
{
    double quaternion[4];
    cm_pose_quaternion(&pose, quaternion);
    std::string line = time_text(time);
    for (const double number : pose.position)
    {
        line += " " + number_text(number);
    }
    for (const double number : quaternion)
    {
        line += " " + number_text(number);
    }
    return line + "\n";
}

std::string matrix_lines(const cm_pose &pose)
{
    std::string lines;
    for (int i = 0; i < 3; ++i)
    {
        for (int j = 0; j < 3; ++j)
        {
            lines += number_text(pose.rotation.row[j][i]) + " ";
        }
        lines += number_text(pose.position[i]) + "\n";
    }
    return lines + "0 0 0 1\n";
}
