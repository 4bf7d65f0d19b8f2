// SPDX-License-Identifier: MIT
//
// What reader and writer share: types of pixels, messages, and that no exception leaves.

#ifndef CUBEMAP_MODULES_IMAGE_OIIO_WORDS_HPP
#define CUBEMAP_MODULES_IMAGE_OIIO_WORDS_HPP

#include "image_io.h"

#include <cstdint>
#include <new>
#include <stdexcept>
#include <string>

#include <OpenImageIO/typedesc.h>

// What is wrong with a file or with an argument.
class ImageFailure : public std::runtime_error
{
public:
    explicit ImageFailure(const std::string &text, cm_status what = CM_ERROR_UNSUPPORTED)
        : std::runtime_error(text), number(what)
    {
    }
    cm_status status() const noexcept
    {
        return number;
    }

private:
    cm_status number;
};

// ImageFailure if it is none of them: C lets any number pass for one.
void check_type(const cm_pixel_type &type);

// The library's type for a type of pixels; and the nearest that loses nothing, else float.
OIIO::TypeDesc type_of(cm_pixel_type type);
cm_pixel_type pixel_type_of(OIIO::TypeDesc type);

// Bytes of a channel.
std::ptrdiff_t size_of(cm_pixel_type type);

// The first line of a library's message, without a full stop at its end.
std::string one_line(const std::string &text);

// At most as much as there is room for, without what ends a line.
void put_message(const std::string &text, char *message);

// Calls body; an exception becomes a status and a message.
template <typename Body> cm_status guarded(char *message, const Body &body) noexcept
{
    try
    {
        body();
        return CM_OK;
    }
    catch (const ImageFailure &failure)
    {
        put_message(failure.what(), message);
        return failure.status();
    }
    catch (const std::bad_alloc &)
    {
        put_message("needs more memory than there is", message);
        return CM_ERROR_MEMORY;
    }
    catch (const std::exception &exception)
    {
        put_message("cannot be read or written: " + one_line(exception.what()), message);
        return CM_ERROR_UNSUPPORTED;
    }
    catch (...)
    {
        put_message("cannot be read or written", message);
        return CM_ERROR_UNSUPPORTED;
    }
}

// The functions of the table.
cm_status open_reader(const char *path, std::uint32_t subimage, cm_image_reader **reader,
                      char *message);
const cm_image_description *describe_reader(const cm_image_reader *reader);
cm_status read_region(cm_image_reader *reader, const cm_image_region *region, cm_pixel_type type,
                      void *pixels, std::ptrdiff_t row_stride, char *message);
void close_reader(cm_image_reader *reader);
cm_status create_writer(const char *path, const cm_image_stream *stream,
                        const cm_image_description *description, cm_image_writer **writer,
                        char *message);
cm_status write_rows(cm_image_writer *writer, std::uint32_t first, std::uint32_t end,
                     cm_pixel_type type, const void *pixels, std::ptrdiff_t pixel_stride,
                     std::ptrdiff_t row_stride, char *message);
cm_status finish_writer(cm_image_writer *writer, char *message);
void drop_writer(cm_image_writer *writer);

#endif
