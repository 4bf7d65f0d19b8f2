// SPDX-License-Identifier: MIT

#include "image_reader.hpp"

namespace
{

ReaderPointer open_any(const std::string &path, std::uint32_t which)
{
    ReaderPointer reader = open_texture(path, which);
    if (!reader)
    {
        reader = open_pnm(path, which);
    }
#ifdef HAVE_CFITSIO
    if (!reader)
    {
        reader = open_healpix(path, which);
    }
#endif
    return reader ? std::move(reader) : open_with_library(path, which);
}

} // namespace

cm_status open_reader(const char *path, std::uint32_t subimage, cm_image_reader **reader,
                      char *message)
{
    return guarded(message, [&] { *reader = open_any(path, subimage).release(); });
}

const cm_image_description *describe_reader(const cm_image_reader *reader)
{
    return &reader->description;
}

cm_status read_region(cm_image_reader *reader, const cm_image_region *region, cm_pixel_type type,
                      void *pixels, std::ptrdiff_t row_stride, char *message)
{
    return guarded(
        message,
        [&]
        {
            const cm_image_description &of = reader->description;
            check_type(type);
            if (region->x0 >= region->x1 || region->y0 >= region->y1 || region->x1 > of.width ||
                region->y1 > of.height)
            {
                throw ImageFailure("is " + std::to_string(of.width) + " x " +
                                       std::to_string(of.height) + "; it has no such part",
                                   CM_ERROR_ARGUMENT);
            }
            const std::ptrdiff_t dense = size_of(type) * static_cast<std::ptrdiff_t>(of.channels) *
                                         (region->x1 - region->x0);
            reader->read(*region, type, static_cast<char *>(pixels),
                         row_stride == 0 ? dense : row_stride);
        });
}

void close_reader(cm_image_reader *reader)
{
    delete reader;
}
