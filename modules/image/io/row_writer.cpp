// SPDX-License-Identifier: MIT

#include "row_writer.hpp"

#include <cstring>

namespace
{

WriterPointer begin_any(const char *path, const cm_image_stream *stream,
                        const cm_image_description &description)
{
    if (std::strcmp(description.format, "fits") == 0)
    {
#ifdef HAVE_CFITSIO
        if (stream != nullptr)
        {
            return begin_healpix(stream, description);
        }
        throw ImageFailure("cannot be written: FITS needs a stream", CM_ERROR_ARGUMENT);
#else
        throw ImageFailure("cannot be written: maps of HEALPix need CFITSIO, which this build has "
                           "not");
#endif
    }
    return begin_with_library(path, stream, description);
}

} // namespace

cm_status create_writer(const char *path, const cm_image_stream *stream,
                        const cm_image_description *description, cm_image_writer **writer,
                        char *message)
{
    return guarded(message, [&] { *writer = begin_any(path, stream, *description).release(); });
}

cm_status write_rows(cm_image_writer *writer, std::uint32_t first, std::uint32_t end,
                     cm_pixel_type type, const void *pixels, std::ptrdiff_t pixel_stride,
                     std::ptrdiff_t row_stride, char *message)
{
    return guarded(message,
                   [&]
                   {
                       check_type(type);
                       writer->write(first, end, type, static_cast<const char *>(pixels),
                                     pixel_stride, row_stride);
                   });
}

cm_status finish_writer(cm_image_writer *writer, char *message)
{
    return guarded(message, [&] { writer->finish(); });
}

void drop_writer(cm_image_writer *writer)
{
    delete writer;
}
