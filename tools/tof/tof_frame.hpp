// SPDX-License-Identifier: MIT
//
// Frames of a simulated camera: in memory, and their files in a folder.

#ifndef CUBEMAP_TOOLS_TOF_FRAME_HPP
#define CUBEMAP_TOOLS_TOF_FRAME_HPP

#include "tof_sensor.hpp"

#include "tools/cli/atomic_file.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

// What cm_tof_simulate writes of a frame.
struct TofFrame
{
    explicit TofFrame(const cm_tof_sensor &sensor);

    // For the call; it points here.
    cm_tof_result result();

    int width = 0;
    int height = 0;
    int phases = 0; // of all series together
    std::vector<float> phase;
    std::vector<float> distance;
    std::vector<float> amplitude;
    std::vector<float> intensity;
    std::vector<std::uint8_t> flags;
    cm_tof_report report = {};
};

// The bytes of a pixel of a frame, and of what its files take while they are written.
std::size_t frame_pixel_bytes(const cm_tof_sensor &sensor);

// The folder that files appear in: made where it is absent, and away again if nothing has come into it.
class OutputFolder
{
public:
    // Failure if it cannot be made.
    explicit OutputFolder(const std::string &folder_name);
    ~OutputFolder();
    OutputFolder(const OutputFolder &) = delete;
    OutputFolder &operator=(const OutputFolder &) = delete;

    std::string path_of(const std::string &file) const;

private:
    std::string name;
    bool made = false;
};

// "distance_0012.exr".
std::string frame_file_name(const std::string &kind, std::size_t number,
                            const char *ending = "exr");

using FileList = std::vector<std::unique_ptr<AtomicFile>>;

// Brings in the complete files of a frame, of so many. What an earlier run has left of the name that the last frame brings goes
// away with the first: it would say that this run is completed.
void bring_frame(const OutputFolder &folder, const FileList &files, std::size_t number,
                 std::size_t count, const std::string &last);

// Adds the files of a frame, which are complete, to those that will appear together.
void write_frame(const OutputFolder &folder, const TofFrame &frame, std::size_t number, int threads,
                 FileList &files);
void write_text(const std::string &path, const std::string &text, FileList &files);

#endif
