// SPDX-License-Identifier: MIT

#include "optical_flow.h"

#include <cstring>

#include <cstddef>
#include <cstdint>
#include <cstdio>

namespace
{

// C may hand over any number, and C++ must not look at one as an enumeration that has it not.
bool is_method(const cm_flow_method &method)
{
    unsigned number = 0;
    static_assert(sizeof number == sizeof method, "the number of an enumeration");
    std::memcpy(&number, &method, sizeof number);
    return number < CM_FLOW_METHODS;
}

// OpenCV 4.6 asks for all memory there is where pictures for RLOF are smaller than its windows.
std::uint32_t least_side(cm_flow_method method)
{
    return method == CM_FLOW_RLOF ? CM_FLOW_SIDE_LEAST_RLOF : CM_FLOW_SIDE_LEAST;
}

bool is_side(cm_flow_method method, std::uint32_t side)
{
    return side >= least_side(method) && side <= CM_FLOW_SIDE_MOST;
}

} // namespace

#ifdef HAVE_OPENCV

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <new>
#include <string>
#include <vector>

#include <opencv2/imgproc.hpp>
#include <opencv2/optflow.hpp>
#include <opencv2/video/tracking.hpp>
#include <opencv2/ximgproc/sparse_match_interpolator.hpp>

namespace
{

// Both pictures in one scale, as a method takes them.
struct FlowInput
{
    cv::Mat from;
    cv::Mat to;
};

struct Scale
{
    float least = std::numeric_limits<float>::max();
    float most = std::numeric_limits<float>::lowest();

    void extend(const float *value, std::size_t count)
    {
        for (std::size_t i = 0; i < count; ++i)
        {
            if (std::isfinite(value[i]))
            {
                least = std::min(least, value[i]);
                most = std::max(most, value[i]);
            }
        }
    }

    bool is_flat() const
    {
        return !(most > least);
    }

    // 0..1
    float place(float value) const
    {
        const double width = static_cast<double>(most) - static_cast<double>(least);
        if (!std::isfinite(value) || !(width > 0.0))
        {
            return 0.0F;
        }
        return static_cast<float>((static_cast<double>(value) - static_cast<double>(least)) /
                                  width);
    }
};

cv::Mat scaled(const Scale &scale, cv::Size size, const float *value)
{
    cv::Mat picture(size, CV_32FC1);
    std::transform(value, value + size.area(), picture.ptr<float>(),
                   [&](float each) { return scale.place(each); });
    return picture;
}

cv::Mat in_bytes(const cv::Mat &picture)
{
    cv::Mat bytes;
    picture.convertTo(bytes, CV_8UC1, 255.0);
    return bytes;
}

// Of pictures without colours, which have no support regions along edges.
cv::Ptr<cv::optflow::RLOFOpticalFlowParameter> rlof_parameters()
{
    const auto parameters = cv::optflow::RLOFOpticalFlowParameter::create();
    parameters->setSupportRegionType(cv::optflow::SR_FIXED);
    return parameters;
}

Scale scale_of_both(cv::Size size, const float *from, const float *to)
{
    Scale scale;
    const auto count = static_cast<std::size_t>(size.area());
    scale.extend(from, count);
    scale.extend(to, count);
    return scale;
}

// Pixels between the points that are followed, at least; and how many there are at most, which the interpolator takes.
constexpr int grid_step = 8;
constexpr int points_most = 30000;
// OpenCV's interpolator reads what is not there if it is asked for more neighbours than there are points
// (opencv_contrib#4195), and so do its functions for whole flows.
constexpr std::size_t neighbours_most = 128;
constexpr std::size_t points_least = 8;

struct FlowPoints
{
    std::vector<cv::Point2f> from;
    std::vector<cv::Point2f> to;

    void keep(const std::vector<unsigned char> &status, cv::Size size)
    {
        const cv::Rect2f whole(-1.0F, -1.0F, static_cast<float>(size.width) + 1.0F,
                               static_cast<float>(size.height) + 1.0F);
        std::size_t kept = 0;
        for (std::size_t i = 0; i < from.size(); ++i)
        {
            if (status[i] != 0 && whole.contains(to[i]))
            {
                from[kept] = from[i];
                to[kept++] = to[i];
            }
        }
        from.resize(kept);
        to.resize(kept);
    }
};

FlowPoints grid_of(cv::Size size)
{
    const double least = std::sqrt(static_cast<double>(size.area()) / points_most);
    const int step = std::max(grid_step, static_cast<int>(std::ceil(least)));
    FlowPoints points;
    for (int row = step / 2; row < size.height; row += step)
    {
        for (int column = step / 2; column < size.width; column += step)
        {
            points.from.emplace_back(static_cast<float>(column), static_cast<float>(row));
        }
    }
    return points;
}

// Points of a grid are followed, and what they do is made dense along edges.
cv::Mat flow_of_points(cm_flow_method method, const cv::Mat &from, const cv::Mat &to)
{
    FlowPoints points = grid_of(from.size());
    std::vector<unsigned char> status;
    std::vector<float> error;
    if (method == CM_FLOW_LK)
    {
        cv::calcOpticalFlowPyrLK(from, to, points.from, points.to, status, error);
    }
    else
    {
        cv::optflow::calcOpticalFlowSparseRLOF(from, to, points.from, points.to, status, error,
                                               rlof_parameters());
    }
    points.keep(status, from.size());
    if (points.from.size() < points_least)
    {
        return cv::Mat(from.size(), CV_32FC2,
                       cv::Scalar::all(std::numeric_limits<double>::quiet_NaN()));
    }
    const auto interpolator = cv::ximgproc::createEdgeAwareInterpolator();
    interpolator->setK(static_cast<int>(std::min(neighbours_most, points.from.size() - 1)));
    cv::Mat flow;
    interpolator->interpolate(from, points.from, to, points.to, flow);
    return flow;
}

cv::Mat flow_by(cm_flow_method method, const FlowInput &input)
{
    cv::Mat flow;
    if (method == CM_FLOW_TVL1)
    {
        cv::optflow::createOptFlow_DualTVL1()->calc(input.from, input.to, flow);
        return flow;
    }
    const cv::Mat from = in_bytes(input.from);
    const cv::Mat to = in_bytes(input.to);
    switch (method)
    {
    case CM_FLOW_DIS:
        cv::DISOpticalFlow::create(cv::DISOpticalFlow::PRESET_MEDIUM)->calc(from, to, flow);
        break;
    case CM_FLOW_FARNEBACK:
        cv::calcOpticalFlowFarneback(from, to, flow, 0.5, 3, 15, 3, 5, 1.2, 0);
        break;
    default:
        return flow_of_points(method, from, to);
    }
    return flow;
}

cm_status fail(cm_status status, char *message, const char *text)
{
    const std::string line(text, std::strcspn(text, "\r\n"));
    (void)std::snprintf(message, CM_FLOW_MESSAGE, "optical flow: %s", line.c_str());
    return status;
}

cm_status find_flow(cm_flow_method method, cv::Size size, const float *from, const float *to,
                    float *flow, char *message)
{
    try
    {
        const Scale scale = scale_of_both(size, from, to);
        if (scale.is_flat())
        {
            std::fill(flow, flow + 2 * static_cast<std::size_t>(size.area()), 0.0F);
            return CM_OK;
        }
        const cv::Mat found = flow_by(method, {scaled(scale, size, from), scaled(scale, size, to)});
        if (found.size() != size || found.type() != CV_32FC2)
        {
            return fail(CM_ERROR_DATA, message, "OpenCV gave another picture");
        }
        for (int row = 0; row < size.height; ++row)
        {
            const std::size_t values = 2 * static_cast<std::size_t>(size.width);
            std::memcpy(flow + static_cast<std::size_t>(row) * values, found.ptr<float>(row),
                        values * sizeof(float));
        }
        return CM_OK;
    }
    catch (const std::bad_alloc &)
    {
        return fail(CM_ERROR_MEMORY, message, "there is no memory for it");
    }
    catch (const cv::Exception &failure)
    {
        return failure.code == cv::Error::StsNoMem
                   ? fail(CM_ERROR_MEMORY, message, "there is no memory for it")
                   : fail(CM_ERROR_DATA, message, failure.err.c_str());
    }
    catch (const std::exception &failure)
    {
        return fail(CM_ERROR_DATA, message, failure.what());
    }
}

} // namespace

int cm_flow_is_there(void)
{
    return 1;
}

#else

int cm_flow_is_there(void)
{
    return 0;
}

#endif

cm_status cm_flow_find(cm_flow_method method, uint32_t width, uint32_t height, const float *from,
                       const float *to, float *flow, char *message)
{
    if (from == nullptr || to == nullptr || flow == nullptr || message == nullptr)
    {
        return CM_ERROR_ARGUMENT;
    }
    if (!is_method(method))
    {
        (void)std::snprintf(message, CM_FLOW_MESSAGE, "optical flow: there is no such method");
        return CM_ERROR_ARGUMENT;
    }
    if (!is_side(method, width) || !is_side(method, height))
    {
        (void)std::snprintf(message, CM_FLOW_MESSAGE,
                            "optical flow: sides must have %u to %u pixels", least_side(method),
                            CM_FLOW_SIDE_MOST);
        return CM_ERROR_RANGE;
    }
#ifdef HAVE_OPENCV
    return find_flow(method, cv::Size(static_cast<int>(width), static_cast<int>(height)), from, to,
                     flow, message);
#else
    (void)std::snprintf(message, CM_FLOW_MESSAGE, "optical flow: this was built without OpenCV");
    return CM_ERROR_UNSUPPORTED;
#endif
}
