// SPDX-License-Identifier: MIT
//
// What a run of cubemap-reproject is, and what it has made, as JSON.

#ifndef CUBEMAP_TOOLS_WORK_MANIFEST_HPP
#define CUBEMAP_TOOLS_WORK_MANIFEST_HPP

#include "file_checksum.hpp"
#include "reproject_input.hpp"
#include "reproject_options.hpp"

#include <string>
#include <vector>

// A picture that was made.
struct MadePicture
{
    std::string name;
    FileSum sum;
};

// Of all pictures of an output.
struct PictureKind
{
    std::string surface;
    std::string rotation; // "0,0,0"
    int width;
    int height;
    int channels;
    std::string type; // of the values that are computed
};

// What decides on the output: program, arguments, input files with their sizes and times, and what was made of that; an
// object, its members on lines of their own.
std::string work_identity(const Options &options, const Input &input, const PictureKind &kind);

// That, and what was made with which filter.
std::string manifest_text(const Options &options, const Input &input, const PictureKind &kind,
                          const std::string &filter, const std::vector<MadePicture> &pictures);

#endif
