// SPDX-License-Identifier: MIT
//
// A file that is being written in rows, whichever library does it.

#ifndef CUBEMAP_MODULES_ROW_WRITER_HPP
#define CUBEMAP_MODULES_ROW_WRITER_HPP

#include "oiio_words.hpp"

#include <memory>
#include <string>

struct cm_image_writer
{
    virtual ~cm_image_writer() = default;
    cm_image_writer(const cm_image_writer &) = delete;
    cm_image_writer &operator=(const cm_image_writer &) = delete;

    // Strides may be 0. ImageFailure.
    virtual void write(std::uint32_t first, std::uint32_t end, cm_pixel_type type,
                       const char *pixels, std::ptrdiff_t pixel_stride,
                       std::ptrdiff_t row_stride) = 0;
    virtual void finish() = 0;

protected:
    cm_image_writer() = default;
};

using WriterPointer = std::unique_ptr<cm_image_writer>;

// ImageFailure.
WriterPointer begin_with_library(const std::string &path, const cm_image_stream *stream,
                                 const cm_image_description &description);
// A map of HEALPix in FITS. stream must not be NULL.
WriterPointer begin_healpix(const cm_image_stream *stream, const cm_image_description &description);

#endif
