// SPDX-License-Identifier: MIT
//
// Steiner and others, Fast Motion Estimation for Field Sequential Imaging, 2019, table 2 and figure 6: how far from the truth each
// method leaves channels that were taken one after the other, and what that costs. Scenes have truth, so errors are known.

#include "field_method.h"
#include "reproduce.hpp"
#include "reproduce_stage.hpp"

#include "modules/image/io/image_io.h"

#include "tools/cli/program.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>

namespace
{

constexpr std::size_t frame_values = std::size_t{FIELD_CHANNELS} * FIELD_PIXELS;

// TV-L1 takes a quarter of an hour, RLOF half of one.
constexpr int flows_tried[CM_FLOW_METHODS] = {1, 1, 0, 1, 0};

// Frame 0 begins at step 0.
struct FieldFrame
{
    std::vector<float> before, now, truth;
};

FieldFrame draw_frame(const field_scene &scene)
{
    FieldFrame made = {std::vector<float>(frame_values), std::vector<float>(frame_values),
                       std::vector<float>(frame_values)};
    for (std::uint32_t channel = 0; channel < FIELD_CHANNELS; ++channel)
    {
        const std::size_t at = std::size_t{channel} * FIELD_PIXELS;
        const double step = channel;
        need(draw_channel(&scene, channel, step - double{FIELD_CHANNELS}, made.before.data() + at));
        need(draw_channel(&scene, channel, step, made.now.data() + at));
        need(draw_channel(&scene, channel, 0, made.truth.data() + at));
        add_noise(&scene, channel, made.now.data() + at);
        add_noise(&scene, channel + FIELD_CHANNELS, made.before.data() + at);
    }
    return made;
}

// The paper's IE, section 6.3: root mean square of the distance of the vectors of channels.
double interpolation_error(const std::vector<float> &found, const std::vector<float> &truth)
{
    double squares = 0;
    for (std::size_t i = 0; i < found.size(); ++i)
    {
        const double off = static_cast<double>(found[i]) - static_cast<double>(truth[i]);
        squares += off * off;
    }
    return std::sqrt(squares / double{FIELD_PIXELS});
}

// Errors are parts of the uncompensated picture's, means over scenes.
struct FieldScore
{
    double phases = 0, bands = 0; // of a time-of-flight camera, of wavebands
    double ms = 0;                // of the processor, a frame
};

void measure_scene(const cm_vision &vision, const field_scene &scene, std::size_t count,
                   const field_method *methods, std::vector<FieldScore> &to)
{
    const FieldFrame frame = draw_frame(scene);
    const double alone = interpolation_error(frame.now, frame.truth);
    const double scenes = static_cast<double>(field_scene_count());
    std::vector<float> corrected(frame_values);
    for (std::size_t i = 0; i < count; ++i)
    {
        char message[CM_IMAGE_MESSAGE] = "";
        const std::clock_t begin = std::clock();
        const cm_status status = run_method(&vision, methods + i, &scene, 0, frame.before.data(),
                                            frame.now.data(), corrected.data(), message);
        const double took = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
        if (status != CM_OK)
        {
            throw Failure(*message != '\0' ? message : cm_status_text(status));
        }
        const double error = interpolation_error(corrected, frame.truth) / alone;
        // half of the scenes are of either kind
        (scene.is_tof ? to[i].phases : to[i].bands) += 2 * error / scenes;
        to[i].ms += 1e3 * took / scenes;
    }
}

// What a flow's methods have come to.
struct FlowScores
{
    std::string name;
    std::array<FieldScore, 4> channels;                // CCM-B, -U, -2, -1
    std::array<FieldScore, CHANGE_CENSUS + 1> nearest; // NCM-nearest, by what is done to channels
};

FlowScores scores_of(cm_flow_method flow, std::size_t count, const field_method *methods,
                     const std::vector<FieldScore> &scores)
{
    FlowScores made = {cm_flow_method_name(flow), {}, {}};
    for (std::size_t i = 0; i < count; ++i)
    {
        const field_method &method = methods[i];
        if (method.kind != KIND_FLOW || method.flow != flow)
        {
            continue;
        }
        if (method.scheme < CM_NCM)
        {
            made.channels[static_cast<std::size_t>(method.scheme)] = scores[i];
        }
        else if (method.scheme == CM_NCM_NEAREST)
        {
            made.nearest[static_cast<std::size_t>(method.change)] = scores[i];
        }
    }
    return made;
}

using Pick = double FieldScore::*;

std::string list_of(const std::array<FieldScore, 4> &scores, Pick pick)
{
    std::string made;
    for (const FieldScore &each : scores)
    {
        made += (made.empty() ? "" : ", ") + text_of_number(each.*pick, 3);
    }
    return made;
}

bool grows(const std::array<FieldScore, 4> &scores, Pick pick, double sign)
{
    return std::is_sorted(scores.begin(), scores.end(),
                          [=](const FieldScore &a, const FieldScore &b)
                          { return sign * a.*pick < sign * b.*pick; });
}

void add_rows(const FlowScores &of, Reproduction &to)
{
    const std::string by = "flows by " + of.name + ": ";
    to.rows.push_back({by + "error of phases of CCM-B, -U, -2, -1", "grows",
                       list_of(of.channels, &FieldScore::phases),
                       grows(of.channels, &FieldScore::phases, 1)});
    to.rows.push_back({by + "error of wavebands of CCM-B, -U, -2, -1", "grows",
                       list_of(of.channels, &FieldScore::bands),
                       grows(of.channels, &FieldScore::bands, 1)});
    to.rows.push_back({by + "ms of CCM-B, -U, -2, -1", "falls",
                       list_of(of.channels, &FieldScore::ms),
                       grows(of.channels, &FieldScore::ms, -1)});
    const auto best = std::min_element(of.nearest.begin(), of.nearest.end(),
                                       [](const FieldScore &a, const FieldScore &b)
                                       { return a.phases < b.phases; });
    const auto change = static_cast<field_change>(best - of.nearest.begin());
    to.rows.push_back({by + "what helps NCM of phases most", "gradients",
                       std::string(field_change_name(change)) + " (" +
                           text_of_number(best->phases, 3) + " after " +
                           text_of_number(of.nearest[CHANGE_NONE].phases, 3) + ")",
                       change == CHANGE_GRADIENT || change == CHANGE_GRADIENT_N});
    const double plain = of.nearest[CHANGE_NONE].phases, worst = of.channels.back().phases;
    to.rows.push_back({by + "untransformed NCM of phases against the worst CCM", "loses",
                       text_of_number(plain, 3) + " against " + text_of_number(worst, 3),
                       plain > worst});
}

// A curve a scheme; points have the flow's and the change's names. Means of both kinds are geometric.
Chart scatter_chart(std::size_t count, const field_method *methods,
                    const std::vector<FieldScore> &scores)
{
    Chart chart = {"motion-figure-6",
                   "Motion compensation: what it costs against what it leaves",
                   "ms of the processor, a frame",
                   "error left (IE), as a part of the uncompensated picture's",
                   true,
                   {},
                   {}};
    chart.is_logarithmic = true;
    for (std::size_t i = 1; i < count; ++i)
    {
        const field_method &method = methods[i];
        const std::string name = method.kind == KIND_TRUTH ? "by true flows"
                                 : method.kind == KIND_PIXELWISE
                                     ? "PAC"
                                     : cm_compensation_name(method.scheme);
        const auto is_named = [&](const ChartCurve &curve) { return curve.name == name; };
        auto curve = std::find_if(chart.curves.begin(), chart.curves.end(), is_named);
        if (curve == chart.curves.end())
        {
            chart.curves.push_back({name, {}, {}});
            curve = chart.curves.end() - 1;
        }
        curve->x.push_back(scores[i].ms);
        curve->y.push_back(std::sqrt(scores[i].phases * scores[i].bands));
        curve->mark.push_back(method.kind == KIND_TRUTH ? cm_compensation_name(method.scheme)
                              : method.kind == KIND_PIXELWISE
                                  ? ""
                                  : std::string(name_flow(&method)) + " " +
                                        field_change_name(method.change));
    }
    return chart;
}

} // namespace

Reproduction reproduce_motion_compensation(const ReproduceSettings &settings)
{
    Reproduction made;
    char message[CM_IMAGE_MESSAGE] = "";
    const cm_vision *const vision = cm_vision_get(message);
    if (vision == nullptr)
    {
        made.missing = message;
        return made;
    }
    const field_method *methods = nullptr;
    const std::size_t count = field_methods(flows_tried, &methods);
    std::vector<FieldScore> scores(count);
    for (std::size_t i = 0; i < field_scene_count(); ++i)
    {
        const field_scene &scene = *field_scene_at(i);
        settings.tell(std::string("compensation of ") + scene.name);
        measure_scene(*vision, scene, count, methods, scores);
    }
    for (int flow = 0; flow < CM_FLOW_METHODS; ++flow)
    {
        if (flows_tried[flow] != 0)
        {
            add_rows(scores_of(static_cast<cm_flow_method>(flow), count, methods, scores), made);
        }
    }
    made.charts.push_back(scatter_chart(count, methods, scores));
    return made;
}
