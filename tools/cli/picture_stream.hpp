// SPDX-License-Identifier: MIT
//
// Pictures that come one after another through a pipe: PGM, PPM, PAM and PFM, or bare samples.

#ifndef CUBEMAP_TOOLS_PICTURE_STREAM_HPP
#define CUBEMAP_TOOLS_PICTURE_STREAM_HPP

#include "image_file.hpp"
#include "stream_format.hpp"

#include <cstdio>
#include <optional>
#include <string>

// What bare samples do not say of themselves.
struct BarePictures
{
    const StreamFormat *format = nullptr;
    int width = 0;
    int height = 0;
};

// WIDTHxHEIGHT:FORMAT; nothing if it is not that.
std::optional<BarePictures> read_bare_pictures(const std::string &text);

class PictureStream
{
public:
    // The stream must outlive this.
    PictureStream(std::FILE *from, const std::optional<BarePictures> &bare);
    PictureStream(const PictureStream &) = delete;
    PictureStream &operator=(const PictureStream &) = delete;

    // The next picture, whose pixels must be read before the one after it is asked for; nothing behind the last.
    // Failure if what comes is no picture.
    std::optional<ImageFile> next();

private:
    std::FILE *file;
    cm_image_stream stream;
    std::optional<BarePictures> samples;
    cm_pnm_reader reader = {};
};

#endif
