// SPDX-License-Identifier: MIT
//
// An opened image file, whichever library reads it.

#ifndef CUBEMAP_MODULES_IMAGE_READER_HPP
#define CUBEMAP_MODULES_IMAGE_READER_HPP

#include "oiio_words.hpp"

#include <memory>
#include <string>

struct cm_image_reader
{
    virtual ~cm_image_reader() = default;
    cm_image_reader(const cm_image_reader &) = delete;
    cm_image_reader &operator=(const cm_image_reader &) = delete;

    // A part that is in the picture. ImageFailure.
    virtual void read(const cm_image_region &region, cm_pixel_type type, char *pixels,
                      std::ptrdiff_t row_stride) = 0;

    cm_image_description description = {};

protected:
    cm_image_reader() = default;
};

using ReaderPointer = std::unique_ptr<cm_image_reader>;

// Each opens one of a file's pictures. ImageFailure; a null pointer if the file is for the others.
ReaderPointer open_texture(const std::string &path, std::uint32_t which);
ReaderPointer open_pnm(const std::string &path, std::uint32_t which);
ReaderPointer open_healpix(const std::string &path, std::uint32_t which);
ReaderPointer open_with_library(const std::string &path, std::uint32_t which);

#endif
