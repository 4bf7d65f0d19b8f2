// SPDX-License-Identifier: MIT

#include "oiio_words.hpp"
#include "image_io_entry.h"

#include <algorithm>
#include <cstring>

#include <OpenImageIO/imageio.h>

void check_type(const cm_pixel_type &type)
{
    std::uint32_t number = 0;
    static_assert(sizeof number == sizeof type);
    std::memcpy(&number, &type, sizeof number);
    if (number > CM_PIXEL_FLOAT)
    {
        throw ImageFailure("cannot be read or written so: no such type of pixels",
                           CM_ERROR_ARGUMENT);
    }
}

OIIO::TypeDesc type_of(cm_pixel_type type)
{
    switch (type)
    {
    case CM_PIXEL_U8:
        return OIIO::TypeUInt8;
    case CM_PIXEL_U16:
        return OIIO::TypeUInt16;
    case CM_PIXEL_HALF:
        return OIIO::TypeHalf;
    case CM_PIXEL_FLOAT:
        return OIIO::TypeFloat;
    }
    return OIIO::TypeUnknown;
}

cm_pixel_type pixel_type_of(OIIO::TypeDesc type)
{
    return type == OIIO::TypeUInt8    ? CM_PIXEL_U8
           : type == OIIO::TypeUInt16 ? CM_PIXEL_U16
           : type == OIIO::TypeHalf   ? CM_PIXEL_HALF
                                      : CM_PIXEL_FLOAT;
}

std::ptrdiff_t size_of(cm_pixel_type type)
{
    return static_cast<std::ptrdiff_t>(type_of(type).size());
}

std::string one_line(const std::string &text)
{
    std::string line = text.substr(0, text.find_first_of("\r\n"));
    while (!line.empty() && (line.back() == '.' || line.back() == ' '))
    {
        line.pop_back();
    }
    return line;
}

void put_message(const std::string &text, char *message)
{
    const std::size_t length = std::min(text.size(), std::size_t{CM_IMAGE_MESSAGE - 1});
    std::copy_n(text.begin(), length, message);
    const auto is_control = [](unsigned char byte) { return byte < ' ' || byte == 0x7f; };
    std::replace_if(message, message + length, is_control, '?');
    message[length] = '\0';
}

namespace
{

// The library stops its threads for this, and ends the process if they are at work.
void set_threads(std::int32_t threads) noexcept
{
    int now = 0;
    OIIO::getattribute("threads", now);
    if (threads > 0 && threads != now)
    {
        OIIO::attribute("threads", static_cast<int>(threads));
    }
    // OpenEXR has threads of its own
    OIIO::attribute("exr_threads", threads > 1 ? static_cast<int>(threads) : -1);
}

} // namespace

extern "C" OIIO_EXPORT const cm_image_io *cm_image_io_entry(std::uint32_t version)
{
    static const cm_image_io table = {CM_IMAGE_IO_VERSION, sizeof(cm_image_io), set_threads,
                                      open_reader,         describe_reader,     read_region,
                                      close_reader,        create_writer,       write_rows,
                                      finish_writer,       drop_writer};
    return version == CM_IMAGE_IO_VERSION ? &table : nullptr;
}
