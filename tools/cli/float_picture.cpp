// SPDX-License-Identifier: MIT

#include "float_picture.hpp"

#include "image_writer.hpp"

std::unique_ptr<AtomicFile> write_float_picture(const std::string &path, const float *rows,
                                                int width, int height, int channels,
                                                const std::vector<std::string> &names, int threads)
{
    const std::string format = output_format(path);
    const bool is_float = format == "openexr" || format == "hdr" || format == "tiff";
    ImageDescription description(channels, is_float ? CM_PIXEL_FLOAT : CM_PIXEL_U8);
    description.channel_names = names;
    auto file = std::make_unique<AtomicFile>(path);
    ImageWriter writer(plan_image(format, description, format, path), width, height, path, *file,
                       threads);
    writer.write(0, height, rows, channels);
    writer.close();
    return file;
}
