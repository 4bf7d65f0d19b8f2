// SPDX-License-Identifier: MIT

#include "checkerboard.h"

#include "optical_flow.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <new>
#include <vector>

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

namespace
{

constexpr double softness = 1.0; // pixels
constexpr double least_window = 3.0;

cv::TermCriteria until(int steps, double small)
{
    return {cv::TermCriteria::EPS | cv::TermCriteria::COUNT, steps, small};
}

bool find_corners(const cm_checkerboard &board, const cv::Mat &sharp,
                  std::vector<cv::Point2f> &corners)
{
    const cv::Size pattern(static_cast<int>(board.columns), static_cast<int>(board.rows));
    cv::Mat picture;
    cv::GaussianBlur(sharp, picture, cv::Size(0, 0), softness);
    if (!cv::findChessboardCorners(picture, pattern, corners,
                                   cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE))
    {
        return false;
    }
    // as wide as no window has two corners in it
    double apart = 100.0;
    for (std::size_t i = 1; i < corners.size(); i++)
    {
        apart = std::min(apart, cv::norm(corners[i] - corners[i - 1]));
    }
    const int half = static_cast<int>(std::max(least_window, 0.45 * apart));
    cv::cornerSubPix(picture, corners, cv::Size(half, half), cv::Size(-1, -1), until(100, 1e-4));
    return true;
}

std::vector<cv::Point3f> corners_of(const cm_checkerboard &board)
{
    std::vector<cv::Point3f> made;
    for (std::uint32_t i = 0; i < board.columns * board.rows; i++)
    {
        made.emplace_back(static_cast<float>(board.square * (i % board.columns)),
                          static_cast<float>(board.square * (i / board.columns)), 0.0f);
    }
    return made;
}

cm_status calibrate(const cm_checkerboard &board, std::uint32_t views, const std::uint8_t *pictures,
                    cm_found_lens &found)
{
    const cv::Size size(static_cast<int>(board.width), static_cast<int>(board.height));
    std::vector<std::vector<cv::Point2f>> seen;
    for (std::uint32_t view = 0; view < views; view++)
    {
        std::vector<std::uint8_t> copy(pictures + std::size_t{view} * board.width * board.height,
                                       pictures +
                                           std::size_t{view + 1} * board.width * board.height);
        std::vector<cv::Point2f> corners;
        if (find_corners(board, cv::Mat(size, CV_8U, copy.data()), corners))
        {
            seen.push_back(corners);
        }
    }
    if (seen.empty())
    {
        return CM_ERROR_DATA;
    }
    const std::vector<std::vector<cv::Point3f>> boards(seen.size(), corners_of(board));
    cv::Mat matrix, distortion;
    std::vector<cv::Mat> rotation, translation;
    found.views = static_cast<std::uint32_t>(seen.size());
    found.rms = cv::calibrateCamera(boards, seen, size, matrix, distortion, rotation, translation,
                                    cv::CALIB_FIX_K3, until(200, 1e-12));
    const double value[8] = {matrix.at<double>(0, 0),  matrix.at<double>(1, 1),
                             matrix.at<double>(0, 2),  matrix.at<double>(1, 2),
                             distortion.at<double>(0), distortion.at<double>(1),
                             distortion.at<double>(2), distortion.at<double>(3)};
    std::copy(value, value + 8, found.value);
    return CM_OK;
}

bool is_right(const cm_checkerboard &board, std::uint32_t views)
{
    constexpr std::uint32_t most = CM_FLOW_SIDE_MOST;
    return board.width - 1 < most && board.height - 1 < most && board.columns >= 2 &&
           board.rows >= 2 && board.columns <= most && board.rows <= most && board.square > 0.0 &&
           std::isfinite(board.square) && views > 0;
}

} // namespace

cm_status cm_checkerboard_calibrate(const cm_checkerboard *board, uint32_t views,
                                    const uint8_t *pictures, cm_found_lens *found, char *message)
{
    if (board == nullptr || pictures == nullptr || found == nullptr || message == nullptr)
    {
        return CM_ERROR_ARGUMENT;
    }
    if (!is_right(*board, views))
    {
        std::snprintf(message, CM_FLOW_MESSAGE, "no board, or no pictures of it");
        return CM_ERROR_RANGE;
    }
    try
    {
        cm_found_lens made = {};
        const cm_status status = calibrate(*board, views, pictures, made);
        if (status == CM_OK)
        {
            *found = made;
            return CM_OK;
        }
        std::snprintf(message, CM_FLOW_MESSAGE, "no picture shows the whole board");
        return status;
    }
    catch (const std::bad_alloc &)
    {
        std::snprintf(message, CM_FLOW_MESSAGE, "out of memory");
        return CM_ERROR_MEMORY;
    }
    catch (const std::exception &error)
    {
        std::snprintf(message, CM_FLOW_MESSAGE, "OpenCV: %s", error.what());
        for (char *letter = message; *letter != '\0'; ++letter)
        {
            *letter = static_cast<unsigned char>(*letter) < 0x20 ? ' ' : *letter;
        }
        return CM_ERROR_DATA;
    }
}
