// SPDX-License-Identifier: MIT

#include "tof_truth.hpp"

#include "tools/cli/image_file.hpp"
#include "tools/cli/image_writer.hpp"
#include "tools/cli/scene_handle.hpp"

namespace
{

constexpr int truth_channels = 3;

// Numbers of objects, shapes and triangles as floats, which hold them up to 2^24; nothing is -1.
float float_of_id(std::uint32_t id)
{
    return id == CM_SCENE_NOTHING ? -1.0f : static_cast<float>(id);
}

} // namespace

TruthPictures::TruthPictures(const cm_camera *of)
    : camera(of),
      pixels(std::size_t{cm_camera_describe(of)->width} * cm_camera_describe(of)->height),
      position(3 * pixels), normal(3 * pixels), ids(3 * pixels), ranges(2 * pixels),
      flow(6 * pixels), seen(pixels)
{
}

void TruthPictures::find(const cm_tof_scene *scene, const cm_trajectory *trajectory, double time,
                         double next, double before, const std::vector<std::uint8_t> &flags,
                         cm_pool *pool)
{
    cm_tof_truth truth = {};
    truth.size = sizeof truth;
    for (std::size_t k = 0; k < 3; ++k)
    {
        truth.position[k] = position.data() + k * pixels;
        truth.normal[k] = normal.data() + k * pixels;
        truth.flow_next[k] = flow.data() + k * pixels;
        truth.flow_before[k] = flow.data() + (3 + k) * pixels;
    }
    truth.object = ids.data();
    truth.shape = ids.data() + pixels;
    truth.triangle = ids.data() + 2 * pixels;
    truth.range = ranges.data();
    truth.depth = ranges.data() + pixels;
    check_scene(cm_tof_find_truth(scene, camera, trajectory, time, next, before, pool, &truth), "");
    seen = flags;
}

std::unique_ptr<AtomicFile> TruthPictures::write(const std::string &path, int threads) const
{
    ImageDescription description(truth_channels, CM_PIXEL_FLOAT);
    description.compression = "rle"; // others take longer than the frame
    ImagePlan plan = plan_image("openexr", description, "openexr", path);
    plan.parts = {"position", "normal", "ids", "ranges", "flow_next", "flow_before", "effects"};
    plan.part_channels = {"x",      "y",      "z",        "x",      "y",     "z",
                          "object", "shape",  "triangle", "range",  "depth", "saturated",
                          "column", "row",    "range",    "column", "row",   "range",
                          "flying", "motion", "multipath"};
    const int width = static_cast<int>(cm_camera_describe(camera)->width);
    const int height = static_cast<int>(cm_camera_describe(camera)->height);
    auto file = std::make_unique<AtomicFile>(path);
    ImageWriter writer(plan, width, height, path, *file, threads);
    std::vector<float> rows(truth_channels * pixels);
    const auto put = [&](auto value)
    {
        for (std::size_t i = 0; i < pixels; ++i)
        {
            for (std::size_t k = 0; k < 3; ++k)
            {
                rows[3 * i + k] = value(i, k);
            }
        }
        writer.write(0, height, rows.data(), truth_channels);
    };
    const auto flagged = [&](std::size_t i, unsigned word)
    { return (seen[i] & word) != 0 ? 1.0f : 0.0f; };
    put([&](std::size_t i, std::size_t k) { return static_cast<float>(position[k * pixels + i]); });
    put([&](std::size_t i, std::size_t k) { return normal[k * pixels + i]; });
    put([&](std::size_t i, std::size_t k) { return float_of_id(ids[k * pixels + i]); });
    put([&](std::size_t i, std::size_t k)
        { return k < 2 ? ranges[k * pixels + i] : flagged(i, CM_TOF_SATURATED); });
    put([&](std::size_t i, std::size_t k) { return flow[k * pixels + i]; });
    put([&](std::size_t i, std::size_t k) { return flow[(3 + k) * pixels + i]; });
    put(
        [&](std::size_t i, std::size_t k)
        {
            static constexpr unsigned words[] = {CM_TOF_FLYING, CM_TOF_MOTION, CM_TOF_MULTIPATH};
            return flagged(i, words[k]);
        });
    writer.close();
    return file;
}

std::size_t truth_pixel_bytes()
{
    return 3 * sizeof(double) + 14 * sizeof(float) + 1 + (7 * 3 + 3) * sizeof(float);
}
