// SPDX-License-Identifier: MIT

#include "tile_file.hpp"
#include "tools/cli/program.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>

#include <sys/stat.h>

TileFile::TileFile(const std::string &path)
{
    std::error_code error;
    std::filesystem::create_directories(std::filesystem::path(path).parent_path(), error);
    file.reset(std::fopen(path.c_str(), "w+b"));
    note(file != nullptr);
}

cm_image_stream TileFile::stream() noexcept
{
    return {this,
            [](void *context, void *bytes, std::size_t count) {
                return self(context).file ? std::fread(bytes, 1, count, self(context).file.get())
                                          : 0;
            },
            [](void *context, const void *bytes, std::size_t count)
            {
                TileFile &to = self(context);
                to.note(to.file && std::fwrite(bytes, 1, count, to.file.get()) == count);
                return count;
            },
            [](void *context, std::int64_t place)
            {
                TileFile &to = self(context);
                to.note(to.file && fseeko(to.file.get(), place, SEEK_SET) == 0);
            },
            [](void *context)
            {
                struct stat status = {};
                TileFile &of = self(context);
                const bool good = of.file && std::fflush(of.file.get()) == 0 &&
                                  fstat(fileno(of.file.get()), &status) == 0;
                return good ? static_cast<std::size_t>(status.st_size) : 0;
            }};
}

void TileFile::finish(const std::string &folder)
{
    errno = 0;
    note(!file || std::fclose(file.release()) == 0);
    if (error_number != 0)
    {
        throw Failure(in_quotes(folder) + " cannot be written: " + std::strerror(error_number));
    }
}

void TileFile::note(bool good) noexcept
{
    error_number = good || error_number != 0 ? error_number : errno != 0 ? errno : EIO;
}
