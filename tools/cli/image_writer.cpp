// SPDX-License-Identifier: MIT

#include "image_writer.hpp"
#include "image_file.hpp"
#include "program.hpp"
#include "stream_format.hpp"
#include "stream_writer.hpp"

void ImageWriter::Dropper::operator()(cm_image_writer *begun) const noexcept
{
    functions->drop(begun);
}

ImageWriter::ImageWriter(const ImagePlan &plan, int width, int height, const std::string &path,
                         AtomicFile &destination, int threads)
    : name(path), file(destination), stream(destination.stream())
{
    const bool own = find_stream_format(plan.format) != nullptr;
    const cm_image_io &functions = own ? stream_writing() : image_io();
    if (threads > 0 && !own)
    {
        functions.set_threads(threads);
    }
    const DescriptionView description(plan.description, plan.format, width, height, plan.parts);
    cm_image_writer *begun = nullptr;
    char message[CM_IMAGE_MESSAGE] = "";
    const cm_status status = functions.create(file.temporary_name().c_str(), &stream,
                                              &description.get(), &begun, message);
    if (status != CM_OK)
    {
        fail_image(in_quotes(name), status, message);
    }
    writer = {begun, Dropper{&functions}};
}

// What the file has met says more than what the image library says of it.
void ImageWriter::check(cm_status status, const char *message) const
{
    file.check();
    if (status != CM_OK)
    {
        fail_image(in_quotes(name), status, message);
    }
}

void ImageWriter::write(int first, int end, cm_pixel_type type, const void *rows, int channels)
{
    char message[CM_IMAGE_MESSAGE] = "";
    check(table().write(writer.get(), static_cast<std::uint32_t>(first),
                        static_cast<std::uint32_t>(end), type, rows,
                        static_cast<std::ptrdiff_t>(channel_bytes(type)) * channels, 0, message),
          message);
}

void ImageWriter::close()
{
    char message[CM_IMAGE_MESSAGE] = "";
    check(table().finish(writer.get(), message), message);
}
