// SPDX-License-Identifier: MIT
//
// A file in a folder that has not appeared yet.

#ifndef CUBEMAP_TOOLS_TILE_FILE_HPP
#define CUBEMAP_TOOLS_TILE_FILE_HPP

#include "modules/image/io/image_io.h"

#include <cstdio>
#include <memory>
#include <string>

// Writing never fails: the first error is kept for finish().
class TileFile
{
public:
    // Its folder is made if it is not there.
    explicit TileFile(const std::string &path);

    // It needs this file.
    cm_image_stream stream() noexcept;

    // Failure, which names the folder, if anything went wrong.
    void finish(const std::string &folder);

private:
    struct Closer
    {
        void operator()(std::FILE *opened) const noexcept
        {
            std::fclose(opened);
        }
    };

    static TileFile &self(void *context)
    {
        return *static_cast<TileFile *>(context);
    }
    void note(bool good) noexcept;

    std::unique_ptr<std::FILE, Closer> file;
    int error_number = 0;
};

#endif
