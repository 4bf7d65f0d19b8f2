// SPDX-License-Identifier: MIT

#include "optical_flow.h"

#include <cstddef>
#include <cstdint>
#include <cstdio>

namespace
{

const char *const method_names[CM_FLOW_METHODS] = {"dis", "farneback", "tvl1", "lk", "rlof"};

bool is_method(cm_flow_method method)
{
    return static_cast<unsigned>(method) < CM_FLOW_METHODS;
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

const char *cm_flow_method_name(cm_flow_method method)
{
    return is_method(method) ? method_names[method] : nullptr;
}

#ifdef HAVE_OPENCV

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <limits>
#include <new>
#include <string>

#include <opencv2/imgproc.hpp>
#include <opencv2/optflow.hpp>
#include <opencv2/video/tracking.hpp>

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

cv::Mat in_color(const cv::Mat &bytes)
{
    cv::Mat color;
    cv::cvtColor(bytes, color, cv::COLOR_GRAY2BGR);
    return color;
}

Scale scale_of_both(cv::Size size, const float *from, const float *to)
{
    Scale scale;
    const auto count = static_cast<std::size_t>(size.area());
    scale.extend(from, count);
    scale.extend(to, count);
    return scale;
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
    case CM_FLOW_LK:
        cv::optflow::calcOpticalFlowSparseToDense(from, to, flow);
        break;
    default: // its support regions, which follow edges, are of colours
        cv::optflow::calcOpticalFlowDenseRLOF(in_color(from), in_color(to), flow);
        break;
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
                            "optical flow: sides must have %u to %u pixels",
                            static_cast<unsigned>(least_side(method)), CM_FLOW_SIDE_MOST);
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
