// SPDX-License-Identifier: MIT

#include "tof_truth.hpp"

#include "modules/sim/io/truth_file.h"
#include "tools/cli/program.hpp"
#include "tools/cli/scene_handle.hpp"

TruthPictures::TruthPictures(const cm_camera *of)
    : camera(of),
      pixels(std::size_t{cm_camera_describe(of)->width} * cm_camera_describe(of)->height),
      position(3 * pixels), normal(3 * pixels), ids(3 * pixels), ranges(2 * pixels),
      flow(6 * pixels), seen(pixels)
{
}

cm_tof_truth TruthPictures::arrays() const
{
    cm_tof_truth truth = {};
    truth.size = sizeof truth;
    for (std::size_t k = 0; k < 3; ++k)
    {
        truth.position[k] = const_cast<double *>(position.data()) + k * pixels;
        truth.normal[k] = const_cast<float *>(normal.data()) + k * pixels;
        truth.flow_next[k] = const_cast<float *>(flow.data()) + k * pixels;
        truth.flow_before[k] = const_cast<float *>(flow.data()) + (3 + k) * pixels;
    }
    truth.object = const_cast<std::uint32_t *>(ids.data());
    truth.shape = const_cast<std::uint32_t *>(ids.data()) + pixels;
    truth.triangle = const_cast<std::uint32_t *>(ids.data()) + 2 * pixels;
    truth.range = const_cast<float *>(ranges.data());
    truth.depth = const_cast<float *>(ranges.data()) + pixels;
    return truth;
}

void TruthPictures::find(const cm_tof_scene *scene, const cm_trajectory *trajectory, double time,
                         double next, double before, const std::vector<std::uint8_t> &flags,
                         cm_pool *pool)
{
    cm_tof_truth truth = arrays();
    check_scene(cm_tof_find_truth(scene, camera, trajectory, time, next, before, pool, &truth), "");
    seen = flags;
}

std::unique_ptr<AtomicFile> TruthPictures::write(const std::string &path) const
{
    auto file = std::make_unique<AtomicFile>(path);
    const cm_image_stream stream = file->stream();
    const cm_camera_options &shape = *cm_camera_describe(camera);
    const cm_tof_truth truth = arrays();
    char message[CM_IMAGE_MESSAGE] = "";
    const cm_status status =
        cm_truth_file_write(&stream, shape.width, shape.height, &truth, seen.data(), message);
    file->check();
    if (status != CM_OK)
    {
        throw Failure(in_quotes(path) + ": " + message);
    }
    return file;
}

std::size_t truth_pixel_bytes()
{
    return 3 * sizeof(double) + 14 * sizeof(float) + 1 + 20 * sizeof(float);
}
