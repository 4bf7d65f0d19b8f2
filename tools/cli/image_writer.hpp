// SPDX-License-Identifier: MIT
//
// Writing image files, row by row, into files that appear only when they are complete.

#ifndef CUBEMAP_TOOLS_IMAGE_WRITER_HPP
#define CUBEMAP_TOOLS_IMAGE_WRITER_HPP

#include "atomic_file.hpp"
#include "image_format.hpp"

#include <memory>
#include <string>

class ImageWriter
{
public:
    // file must outlive the writer. Failure if the format cannot hold such an image. threads as for
    // ImageFile.
    ImageWriter(const ImagePlan &plan, int width, int height, const std::string &path,
                AtomicFile &destination, int threads = 0);

    // The rows from first to before end, one after the other, in floats, with the given number of
    // channels, of which those that the plan has are written. In order from the top.
    void write(int first, int end, const float *rows, int channels)
    {
        write(first, end, CM_PIXEL_FLOAT, rows, channels);
    }

    // The same of pixels of another type.
    void write(int first, int end, cm_pixel_type type, const void *rows, int channels);

    // After the last row.
    void close();

private:
    struct Dropper
    {
        const cm_image_io *functions;
        void operator()(cm_image_writer *begun) const noexcept;
    };

    void check(cm_status status, const char *message) const;
    const cm_image_io &table() const noexcept
    {
        return *writer.get_deleter().functions;
    }

    std::string name;
    AtomicFile &file;
    cm_image_stream stream;
    std::unique_ptr<cm_image_writer, Dropper> writer{nullptr, Dropper{nullptr}};
};

#endif
