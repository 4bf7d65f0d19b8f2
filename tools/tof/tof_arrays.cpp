// SPDX-License-Identifier: MIT

#include "tof_arrays.hpp"

#include "modules/sim/io/hdf5_file.h"
#include "tools/cli/program.hpp"

std::vector<cm_array> arrays_of(const TofFrame &frame, const TruthPictures *truth)
{
    const auto height = static_cast<std::uint64_t>(frame.height);
    const auto width = static_cast<std::uint64_t>(frame.width);
    std::vector<cm_array> arrays = {
        {"phase",
         CM_ARRAY_FLOAT,
         3,
         {static_cast<std::uint64_t>(frame.phases), height, width, 0},
         frame.phase.data()},
        {"distance", CM_ARRAY_FLOAT, 2, {height, width, 0, 0}, frame.distance.data()},
        {"amplitude", CM_ARRAY_FLOAT, 2, {height, width, 0, 0}, frame.amplitude.data()},
        {"intensity", CM_ARRAY_FLOAT, 2, {height, width, 0, 0}, frame.intensity.data()},
        {"flags", CM_ARRAY_U8, 2, {height, width, 0, 0}, frame.flags.data()}};
    if (truth != nullptr)
    {
        const cm_tof_truth is = truth->arrays();
        const auto three = [&](const char *name, cm_array_type type, const void *data) {
            arrays.push_back({name, type, 3, {3, height, width, 0}, data});
        };
        const auto one = [&](const char *name, cm_array_type type, const void *data) {
            arrays.push_back({name, type, 2, {height, width, 0, 0}, data});
        };
        three("truth_position", CM_ARRAY_DOUBLE, is.position[0]);
        three("truth_normal", CM_ARRAY_FLOAT, is.normal[0]);
        one("truth_object", CM_ARRAY_U32, is.object);
        one("truth_shape", CM_ARRAY_U32, is.shape);
        one("truth_triangle", CM_ARRAY_U32, is.triangle);
        one("truth_depth", CM_ARRAY_FLOAT, is.depth);
        one("truth_range", CM_ARRAY_FLOAT, is.range);
        three("truth_flow_next", CM_ARRAY_FLOAT, is.flow_next[0]);
        three("truth_flow_before", CM_ARRAY_FLOAT, is.flow_before[0]);
    }
    return arrays;
}

void write_npy_files(const OutputFolder &folder, const std::vector<cm_array> &arrays,
                     std::size_t number, FileList &files)
{
    for (const cm_array &each : arrays)
    {
        files.push_back(std::make_unique<AtomicFile>(
            folder.path_of(frame_file_name(each.name, number, "npy"))));
        write_npy_stream(*files.back(), {each});
    }
}

void write_npy_stream(AtomicFile &stream, const std::vector<cm_array> &arrays)
{
    const cm_image_stream to = stream.stream();
    for (const cm_array &each : arrays)
    {
        char message[CM_IMAGE_MESSAGE] = "";
        const cm_status status = cm_array_write_npy(&to, &each, message);
        stream.check();
        if (status != CM_OK)
        {
            throw Failure(message);
        }
    }
}

void write_hdf5_file(const OutputFolder &folder, const std::vector<cm_array> &arrays,
                     std::size_t number, FileList &files)
{
    char message[CM_IMAGE_MESSAGE] = "";
    const cm_hdf5 *const hdf5 = cm_hdf5_get(message);
    if (hdf5 == nullptr)
    {
        throw Failure(message);
    }
    const std::string path = folder.path_of(frame_file_name("frame", number, "h5"));
    files.push_back(std::make_unique<AtomicFile>(path));
    const cm_image_stream to = files.back()->stream();
    const cm_status status = hdf5->write(&to, arrays.data(), arrays.size(), message);
    files.back()->check();
    if (status != CM_OK)
    {
        throw Failure(in_quotes(path) + ": " + message);
    }
}
