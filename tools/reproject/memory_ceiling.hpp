// SPDX-License-Identifier: MIT
//
// Pixels below a ceiling: what does not fit into memory lies in files without a name, whose pages are given back before
// there are too many.

#ifndef CUBEMAP_TOOLS_MEMORY_CEILING_HPP
#define CUBEMAP_TOOLS_MEMORY_CEILING_HPP

#include <cubemap/image.h>

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

class MemoryCeiling
{
public:
    // ceiling: bytes of memory that the process may have, 0 for no ceiling. Files are made in the folder that TMPDIR
    // names, else beside output. Each is told on messages before it is made; NULL tells nothing.
    MemoryCeiling(std::uint64_t ceiling, const std::string &output, std::FILE *messages);
    // All must have been released.
    ~MemoryCeiling();
    MemoryCeiling(const MemoryCeiling &) = delete;
    MemoryCeiling &operator=(const MemoryCeiling &) = delete;

    // Bytes of any value, aligned to 64: in memory where the ceiling leaves room, else in a file. `what` is for people:
    // "the pixels of 'a.tif'". std::bad_alloc if there is no memory, Failure if there is no room for the file.
    // kept: the name of a file, if it is to be that file, which stays and of which what is there already is kept.
    void *allocate(std::size_t size, const std::string &what, const std::string &kept = "");
    void release(void *pointer, std::size_t size) noexcept;

    // The same for the library, or NULL if there is no ceiling. What went wrong is thrown by rethrow().
    const cm_memory *functions() const noexcept
    {
        return ceiling == 0 ? nullptr : &table;
    }
    void rethrow();

    // Are these bytes in a file?
    bool is_in_file(const void *pointer);
    // They are on the disk from now on. Failure if they cannot be.
    void bring_to_disk(const void *pointer);

    // This thread has touched so many bytes of files since it last said so; pages are given back if there are too many.
    void touched(std::size_t size);

    // Bytes of memory, 0 for no ceiling.
    std::uint64_t bytes() const noexcept
    {
        return ceiling;
    }

    // Bytes in files.
    std::uint64_t in_files() const noexcept
    {
        return file_bytes;
    }

private:
    struct Mapping
    {
        void *begin;
        std::size_t size;
        int file;
    };

    bool fits(std::size_t size);
    void *map_file(std::size_t size, const std::string &what, const std::string &kept);
    int open_file(std::size_t size, const std::string &what, const std::string &kept) const;
    const Mapping *mapping_of(const void *pointer) const;
    void watch();
    void drop_pages();

    const std::uint64_t ceiling;
    const std::string folder;
    std::FILE *const messages;
    cm_memory table = {};
    std::uint64_t other_bytes = 0;  // of the process, when it was first asked
    std::uint64_t memory_bytes = 0; // that allocate() has given
    std::atomic<std::uint64_t> file_bytes{0};
    std::atomic<std::uint64_t> touched_bytes{0}; // since somebody looked
    std::vector<Mapping> mappings;
    std::exception_ptr failure;
    std::mutex mutex; // of all above
    std::condition_variable changed;
    bool over = false;
    std::thread watcher;
};

#endif
