// SPDX-License-Identifier: MIT

#include "picture.hpp"

#include "modules/image/io/image_io.h"

#include <stdexcept>

Picture::Picture(const std::string &name, unsigned which)
{
    char message[CM_IMAGE_MESSAGE] = "";
    const cm_image_io *const io = cm_image_io_get(message);
    cm_image_reader *reader = nullptr;
    if (io == nullptr || io->open(name.c_str(), which, &reader, message) != CM_OK)
    {
        throw std::runtime_error(name + ": " + message);
    }
    const cm_image_description &stored = *io->describe(reader);
    const cm_image_region all = {0, 0, stored.width, stored.height};
    width = static_cast<int>(stored.width);
    height = static_cast<int>(stored.height);
    channels = static_cast<int>(stored.channels);
    values.resize(std::size_t(width) * std::size_t(height) * std::size_t(channels));
    const cm_status status = io->read(reader, &all, CM_PIXEL_FLOAT, values.data(), 0, message);
    io->close(reader);
    if (status != CM_OK)
    {
        throw std::runtime_error(name + ": " + message);
    }
}
