// SPDX-License-Identifier: MIT

#include "tof_frame.hpp"

#include "tools/cli/float_picture.hpp"
#include "tools/cli/program.hpp"

#include <cstdio>
#include <filesystem>

namespace
{

constexpr std::size_t pictures_beside_phases = 3; // distance, amplitude, intensity

std::size_t series_of(const cm_tof_sensor &sensor)
{
    return sensor.second_frequency > 0 ? 2 : 1;
}

} // namespace

TofFrame::TofFrame(const cm_tof_sensor &sensor)
{
    const cm_camera_options &camera = *cm_camera_describe(sensor.camera);
    const std::size_t pixels = std::size_t{camera.width} * camera.height;
    width = static_cast<int>(camera.width);
    height = static_cast<int>(camera.height);
    phases = static_cast<int>(series_of(sensor)) * sensor.phases;
    phase.resize(pixels * static_cast<std::size_t>(phases));
    distance.resize(pixels);
    amplitude.resize(pixels);
    intensity.resize(pixels);
    flags.resize(pixels);
}

cm_tof_result TofFrame::result()
{
    report = {};
    report.size = sizeof report;
    cm_tof_result all = {};
    all.size = sizeof all;
    all.phase = phase.data();
    all.distance = distance.data();
    all.amplitude = amplitude.data();
    all.intensity = intensity.data();
    all.flags = flags.data();
    all.report = &report;
    return all;
}

std::size_t frame_pixel_bytes(const cm_tof_sensor &sensor)
{
    const std::size_t phases = series_of(sensor) * static_cast<std::size_t>(sensor.phases);
    return sizeof(float) * (3 * phases + pictures_beside_phases) + 1;
}

OutputFolder::OutputFolder(const std::string &folder_name) : name(folder_name)
{
    std::error_code wrong;
    made = std::filesystem::create_directory(name, wrong);
    if (wrong || !std::filesystem::is_directory(name, wrong))
    {
        throw Failure(in_quotes(name) + " cannot be made" +
                      (wrong ? ": " + wrong.message() : ": it is not a folder"));
    }
}

OutputFolder::~OutputFolder()
{
    std::error_code ignored;
    if (made)
    {
        std::filesystem::remove(name, ignored); // not where there are files
    }
}

std::string OutputFolder::path_of(const std::string &file) const
{
    return name + (name.back() == '/' ? "" : "/") + file;
}

std::string frame_file_name(const std::string &kind, std::size_t number, const char *ending)
{
    char text[40];
    std::snprintf(text, sizeof text, "_%04zu.%s", number, ending);
    return kind + text;
}

void write_frame(const OutputFolder &folder, const TofFrame &frame, std::size_t number, int threads,
                 FileList &files)
{
    const std::size_t pixels = frame.distance.size();
    const auto add = [&](const std::string &file, const float *rows)
    {
        files.push_back(write_float_picture(folder.path_of(file), rows, frame.width, frame.height,
                                            1, {}, threads));
    };
    for (int k = 0; k < frame.phases; ++k)
    {
        char text[60];
        std::snprintf(text, sizeof text, "phase_%04zu_%d.exr", number, k);
        add(text, frame.phase.data() + pixels * static_cast<std::size_t>(k));
    }
    add(frame_file_name("distance", number), frame.distance.data());
    add(frame_file_name("amplitude", number), frame.amplitude.data());
    add(frame_file_name("intensity", number), frame.intensity.data());
}

void write_text(const std::string &path, const std::string &text, FileList &files)
{
    files.push_back(std::make_unique<AtomicFile>(path));
    files.back()->write(text.data(), text.size());
}

void bring_frame(const OutputFolder &folder, const FileList &files, std::size_t number,
                 std::size_t count, const std::string &last)
{
    if (number == 0 && count > 1)
    {
        for (const std::unique_ptr<AtomicFile> &each : files)
        {
            each->finish(); // no disk is too full any more
        }
        std::error_code ignored; // who cannot remove cannot rename, and is told so
        const std::filesystem::path old =
            std::filesystem::weakly_canonical(folder.path_of(last), ignored);
        if (std::filesystem::is_regular_file(old, ignored))
        {
            std::filesystem::remove(old, ignored);
        }
    }
    appear_together(files);
}
