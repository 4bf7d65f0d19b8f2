// SPDX-License-Identifier: MIT
//
// A file that is read byte by byte, for what takes a cm_image_stream.

#ifndef CUBEMAP_MODULES_IMAGE_OPENED_FILE_HPP
#define CUBEMAP_MODULES_IMAGE_OPENED_FILE_HPP

#include <cstdio>
#include <memory>

struct FileCloser
{
    void operator()(std::FILE *opened) const noexcept
    {
        std::fclose(opened);
    }
};

using FilePointer = std::unique_ptr<std::FILE, FileCloser>;

// cm_image_stream.read, whose context is the file.
inline std::size_t read_file(void *context, void *bytes, std::size_t count)
{
    return std::fread(bytes, 1, count, static_cast<std::FILE *>(context));
}

#endif
