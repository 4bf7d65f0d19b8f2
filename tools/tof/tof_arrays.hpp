// SPDX-License-Identifier: MIT
//
// Frames as arrays of NPY, files or a stream, and as files of HDF5.

#ifndef CUBEMAP_TOOLS_TOF_ARRAYS_HPP
#define CUBEMAP_TOOLS_TOF_ARRAYS_HPP

#include "tof_frame.hpp"
#include "tof_truth.hpp"

#include "modules/sim/io/array_file.h"

#include <vector>

// All of a frame, and of its truth where that is not nullptr; they must outlive this.
std::vector<cm_array> arrays_of(const TofFrame &frame, const TruthPictures *truth);

// Adds complete files to those that will appear together: one each, NAME_0012.npy.
void write_npy_files(const OutputFolder &folder, const std::vector<cm_array> &arrays,
                     std::size_t number, FileList &files);
// frame_0012.h5.
void write_hdf5_file(const OutputFolder &folder, const std::vector<cm_array> &arrays,
                     std::size_t number, FileList &files);
// One after another. Failure if the stream does not take them.
void write_npy_stream(AtomicFile &stream, const std::vector<cm_array> &arrays);

#endif
