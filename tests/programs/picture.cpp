// SPDX-License-Identifier: MIT

#include "picture.hpp"

#include <stdexcept>

#include <OpenImageIO/imageio.h>

Picture::Picture(const std::string &name)
{
    OIIO::ImageSpec request;
    request.attribute("oiio:UnassociatedAlpha", 1);
    const auto input = OIIO::ImageInput::open(name, &request);
    if (!input)
    {
        throw std::runtime_error(name + ": " + OIIO::geterror());
    }
    width = input->spec().width;
    height = input->spec().height;
    channels = input->spec().nchannels;
    values.resize(std::size_t(width) * std::size_t(height) * std::size_t(channels));
    if (!input->read_image(0, 0, 0, channels, OIIO::TypeFloat, values.data()))
    {
        throw std::runtime_error(name + ": " + input->geterror());
    }
}
