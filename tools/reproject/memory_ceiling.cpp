// SPDX-License-Identifier: MIT
//
// A file is mapped as shared: its pages belong to the system's cache of files, which writes and drops them as it needs.
// Those that the process has touched count as its own until it gives them back; what is in them stays in the file.

#include "memory_ceiling.hpp"
#include "large_pages.hpp"
#include "tools/cli/program.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <new>
#include <system_error>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

namespace
{

// What decoding, encoding and bands of rows take beside pixels.
constexpr std::uint64_t working_bytes = std::uint64_t{64} << 20;

// What is no larger stays in memory.
constexpr std::size_t small_bytes = std::size_t{64} << 10;

// How often the watcher looks. In that time a process can touch some ten megabytes.
constexpr std::chrono::milliseconds interval(2);

// Where others keep all cores busy, the watcher waits for its turn: so threads look themselves, after so many bytes.
constexpr std::uint64_t touched_between_looks = std::uint64_t{16} << 20;

// Bytes of the process in memory; 0 where the system does not tell.
std::uint64_t resident_bytes()
{
    std::uint64_t pages = 0;
#if defined(__linux__)
    const int file = open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
    if (file >= 0)
    {
        char text[100] = "";
        const ssize_t count = read(file, text, sizeof text - 1);
        close(file);
        const char *const second = count > 0 ? std::strchr(text, ' ') : nullptr;
        pages = second != nullptr ? std::strtoull(second, nullptr, 10) : 0;
    }
#endif
    return pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

std::string folder_beside(const std::string &output)
{
    const char *const named = std::getenv("TMPDIR");
    if (named != nullptr && *named != '\0')
    {
        return named;
    }
    const std::string folder = std::filesystem::path(output).parent_path().string();
    return folder.empty() ? "." : folder;
}

std::string gigabytes(std::uint64_t bytes)
{
    char text[40];
    std::snprintf(text, sizeof text, "%.1f GB", static_cast<double>(bytes) / 1e9);
    if (bytes < 100000000)
    {
        std::snprintf(text, sizeof text, "%.1f MB", static_cast<double>(bytes) / 1e6);
    }
    return text;
}

// What is free in the folder for who is not root; the largest number where nobody tells.
std::uint64_t free_bytes(const std::string &folder)
{
    struct statvfs status;
    return statvfs(folder.c_str(), &status) == 0
               ? static_cast<std::uint64_t>(status.f_bavail) * status.f_frsize
               : UINT64_MAX;
}

// A file that goes away with its last descriptor and mapping; -1 with errno.
int open_nameless(const std::string &folder)
{
    int file = -1;
#if defined(O_TMPFILE)
    file = open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
#endif
    if (file < 0)
    {
        std::string name = folder + "/.cubemap-spool-XXXXXX";
        file = mkstemp(name.data());
        if (file >= 0)
        {
            unlink(name.c_str());
        }
    }
    return file;
}

// Blocks of the disk for the whole file, since a page that finds none when it is written ends the process.
int make_room(int file, std::size_t size)
{
    const off_t length = static_cast<off_t>(size);
    int error = 0;
#if !defined(__APPLE__)
    do
    {
        error = posix_fallocate(file, 0, length);
    } while (error == EINTR);
#else
    error = EOPNOTSUPP;
#endif
    const bool cannot_tell = error == EOPNOTSUPP || error == EINVAL || error == ENOSYS;
    return !cannot_tell ? error : ftruncate(file, length) == 0 ? 0 : errno;
}

// The process has touched `grown` bytes at most between two looks: so much must be left, and as much again for a look that
// comes late.
std::uint64_t bytes_to_keep(std::uint64_t ceiling, std::uint64_t grown)
{
    const std::uint64_t least = std::max(ceiling / 6, std::uint64_t{96} << 20);
    const std::uint64_t spare = std::max(least, 2 * grown);
    return std::max(ceiling / 4, ceiling > spare ? ceiling - spare : 0);
}

} // namespace

MemoryCeiling::MemoryCeiling(std::uint64_t ceiling_bytes, const std::string &output,
                             std::FILE *told)
    : ceiling(ceiling_bytes), folder(folder_beside(output)), messages(told)
{
    table.size = sizeof table;
    table.context = this;
    table.allocate = [](void *context, std::size_t size) -> void *
    {
        MemoryCeiling &self = *static_cast<MemoryCeiling *>(context);
        try
        {
            return self.allocate(size, "what the filter needs");
        }
        catch (...)
        {
            const std::lock_guard<std::mutex> lock(self.mutex);
            self.failure = std::current_exception();
            return nullptr;
        }
    };
    table.release = [](void *context, void *pointer, std::size_t size)
    { static_cast<MemoryCeiling *>(context)->release(pointer, size); };
    table.touched = [](void *context, std::size_t size)
    { static_cast<MemoryCeiling *>(context)->touched(size); };
}

MemoryCeiling::~MemoryCeiling()
{
    {
        const std::lock_guard<std::mutex> lock(mutex);
        over = true;
    }
    changed.notify_all();
    if (watcher.joinable())
    {
        watcher.join();
    }
}

void MemoryCeiling::rethrow()
{
    const std::lock_guard<std::mutex> lock(mutex);
    if (failure)
    {
        std::rethrow_exception(failure);
    }
}

// Memory that was given counts before it is touched. A quarter is left for the pages of files.
bool MemoryCeiling::fits(std::size_t size)
{
    if (ceiling == 0)
    {
        return true;
    }
    const std::uint64_t resident = resident_bytes();
    other_bytes = memory_bytes == 0 && file_bytes == 0 ? resident : other_bytes;
    const std::uint64_t used = std::max(resident, other_bytes + memory_bytes) + working_bytes;
    return size <= ceiling && used <= ceiling - size && memory_bytes + size <= ceiling / 4 * 3;
}

void *MemoryCeiling::allocate(std::size_t size, const std::string &what, const std::string &kept)
{
    const std::lock_guard<std::mutex> lock(mutex);
    if (size > small_bytes && !fits(size))
    {
        return map_file(size, what, kept);
    }
    void *const pointer = allocate_pages(size);
    memory_bytes += size;
    return pointer;
}

void MemoryCeiling::release(void *pointer, std::size_t size) noexcept
{
    const std::lock_guard<std::mutex> lock(mutex);
    const Mapping *const found = mapping_of(pointer);
    if (found == nullptr)
    {
        std::free(pointer);
        memory_bytes -= size;
        return;
    }
    munmap(found->begin, found->size);
    close(found->file);
    file_bytes -= found->size;
    mappings.erase(mappings.begin() + (found - mappings.data()));
}

const MemoryCeiling::Mapping *MemoryCeiling::mapping_of(const void *pointer) const
{
    const auto found = std::find_if(mappings.begin(), mappings.end(),
                                    [pointer](const Mapping &one) { return one.begin == pointer; });
    return found == mappings.end() ? nullptr : &*found;
}

bool MemoryCeiling::is_in_file(const void *pointer)
{
    const std::lock_guard<std::mutex> lock(mutex);
    return mapping_of(pointer) != nullptr;
}

// Without the lock, which the watcher needs meanwhile.
void MemoryCeiling::bring_to_disk(const void *pointer)
{
    int file = -1;
    {
        const std::lock_guard<std::mutex> lock(mutex);
        const Mapping *const found = mapping_of(pointer);
        file = found == nullptr ? -1 : found->file;
    }
    if (file >= 0 && fsync(file) != 0)
    {
        throw Failure(std::string("a temporary file cannot be written: ") + std::strerror(errno));
    }
}

void *MemoryCeiling::map_file(std::size_t size, const std::string &what, const std::string &kept)
{
    const int file = open_file(size, what, kept);
    void *const begin = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    if (begin == MAP_FAILED)
    {
        const int error = errno;
        close(file);
        throw Failure("a file of " + gigabytes(size) + " in folder " + in_quotes(folder) +
                      " cannot be mapped: " + std::strerror(error));
    }
    mappings.push_back({begin, size, file});
    file_bytes += size;
    try
    {
        if (!watcher.joinable())
        {
            watcher = std::thread(&MemoryCeiling::watch, this);
        }
    }
    catch (const std::system_error &)
    {
        // The system gives no more threads, and drops pages when it needs them.
    }
    return begin;
}

// The file of this name and size as it is, if there is one.
int MemoryCeiling::open_file(std::size_t size, const std::string &what,
                             const std::string &kept) const
{
    const std::string where =
        kept.empty() ? folder : std::filesystem::path(kept).parent_path().string();
    const std::uint64_t room = free_bytes(where);
    const std::string place = "folder " + in_quotes(where);
    const int before = kept.empty() ? -1 : open(kept.c_str(), O_RDWR | O_CLOEXEC);
    struct stat status = {};
    if (before >= 0 && fstat(before, &status) == 0 &&
        static_cast<std::uint64_t>(status.st_size) == size)
    {
        return before;
    }
    if (before >= 0)
    {
        close(before);
    }
    if (room < size)
    {
        throw Failure(place + " has " + gigabytes(room) + " free, but " + what + ", " +
                      gigabytes(size) +
                      ", must go there; TMPDIR names another folder, and a larger --memory may do "
                      "without");
    }
    // small ones beside large ones are not worth a line
    if (messages != nullptr && size >= file_bytes / 16)
    {
        std::fprintf(messages,
                     "cubemap-reproject: a temporary file in %s, with %s free, will hold %s, %s\n",
                     place.c_str(), gigabytes(room).c_str(), what.c_str(), gigabytes(size).c_str());
        std::fflush(messages);
    }
    const int file = kept.empty()
                         ? open_nameless(folder)
                         : open(kept.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
    const int error = file < 0 ? errno : make_room(file, size);
    if (error != 0)
    {
        if (file >= 0)
        {
            close(file);
        }
        throw Failure(place + " takes no temporary file of " + gigabytes(size) + ": " +
                      std::strerror(error) + "; TMPDIR names another folder");
    }
    return file;
}

// ---- pages

void MemoryCeiling::watch()
{
    std::uint64_t before = resident_bytes();
    std::uint64_t grown = 0;
    std::unique_lock<std::mutex> lock(mutex);
    while (!over)
    {
        const std::uint64_t resident = resident_bytes();
        grown = std::max(grown, resident > before ? resident - before : 0);
        if (resident > bytes_to_keep(ceiling, grown))
        {
            drop_pages();
        }
        before = resident_bytes();
        changed.wait_for(lock, interval, [this] { return over; });
    }
}

// Whoever has the lock looks, even if it waits for its turn of a core: nobody touches more meanwhile.
void MemoryCeiling::touched(std::size_t size)
{
    if (file_bytes == 0 || touched_bytes.fetch_add(size) + size < touched_between_looks)
    {
        return;
    }
    touched_bytes = 0;
    const std::lock_guard<std::mutex> lock(mutex);
    const std::uint64_t spare = std::max(ceiling / 6, 2 * touched_between_looks);
    if (resident_bytes() + spare > ceiling)
    {
        drop_pages();
    }
}

// They are read again from the file, or from the system's cache of it. The same mapping in place of itself: while pages go,
// others that touch some wait, which they would not with madvise.
void MemoryCeiling::drop_pages()
{
    for (const Mapping &each : mappings)
    {
        if (mmap(each.begin, each.size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_FIXED, each.file,
                 0) == MAP_FAILED)
        {
            madvise(each.begin, each.size, MADV_DONTNEED);
        }
    }
}
