// SPDX-License-Identifier: MIT
//
// Writing image files, row by row, into files that appear only when they are complete.

#ifndef CUBEMAP_TOOLS_IMAGE_WRITER_HPP
#define CUBEMAP_TOOLS_IMAGE_WRITER_HPP

#include "atomic_file.hpp"

#include <memory>
#include <string>

#include <OpenImageIO/imageio.h>

// What an output file is to hold.
struct ImagePlan
{
    std::string format;   // OpenImageIO's name of the file format
    OIIO::ImageSpec spec; // of the output, without its width and height
    bool alpha_dropped;   // the format has none
    bool multiply_alpha;  // the format wants colours multiplied by alpha, and they are not yet
};

// The file format that a name's extension stands for, UsageFailure if it is none that we write.
std::string output_format(const std::string &path);

// What a file of that format holds of an image that was read from a file with this description.
// Failure if the format cannot hold so many channels.
ImagePlan plan_image(const std::string &format, const OIIO::ImageSpec &source,
                     const std::string &source_format, const std::string &path);

class ImageWriter
{
public:
    // file must outlive the writer. Failure if the format cannot hold such an image.
    ImageWriter(const ImagePlan &plan, int width, int height, const std::string &path,
                AtomicFile &destination);

    // The rows from first to before end, one after the other, in floats, with the given number of
    // channels, of which those that the plan has are written. In order from the top.
    void write(int first, int end, const float *rows, int channels);

    // After the last row.
    void close();

private:
    bool open(const OIIO::ImageSpec &spec);
    void check(bool good);
    void check_end() const;

    std::string name;
    AtomicFile &file;
    const bool by_name; // rather than through the file as a stream
    std::unique_ptr<OIIO::ImageOutput> output;
};

#endif
