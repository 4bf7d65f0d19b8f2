// SPDX-License-Identifier: MIT

#include "octree_run_file.hpp"

#include "modules/scene/io/check_sum.h"
#include "tools/cli/program.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace
{

constexpr const char *unfinished_end = ".unfinished";
constexpr std::size_t journal_bytes = 8; // "-journal", which SQLite puts behind a name
constexpr std::size_t name_most = 255;   // bytes that file systems take

// Is what is open still what has this name? The run that had it may have renamed it.
bool has_name(int descriptor, const std::string &path)
{
    struct stat opened;
    struct stat named;
    return fstat(descriptor, &opened) == 0 && stat(path.c_str(), &named) == 0 &&
           opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

bool is_link_to_nothing(const std::string &path)
{
    struct stat status;
    return lstat(path.c_str(), &status) == 0 && S_ISLNK(status.st_mode) &&
           stat(path.c_str(), &status) != 0;
}

// Its beginning of so many bytes, or fewer where a character of UTF-8 would be cut.
std::string beginning(const std::string &name, std::size_t bytes)
{
    while (bytes > 0 && (static_cast<unsigned char>(name[bytes]) & 0xc0u) == 0x80u)
    {
        --bytes;
    }
    return name.substr(0, bytes);
}

} // namespace

RunFile::~RunFile()
{
    give_back();
}

RunFile::RunFile(RunFile &&other) noexcept : descriptor(std::exchange(other.descriptor, -1))
{
}

RunFile &RunFile::operator=(RunFile &&other) noexcept
{
    std::swap(descriptor, other.descriptor);
    return *this;
}

void RunFile::give_back() noexcept
{
    if (descriptor >= 0)
    {
        close(descriptor);
    }
    descriptor = -1;
}

bool RunFile::take(const std::string &path)
{
    give_back();
    struct stat named;
    while (stat(path.c_str(), &named) == 0)
    {
        descriptor = S_ISREG(named.st_mode) ? open(path.c_str(), O_RDWR | O_CLOEXEC) : -1;
        if (descriptor < 0 && (!S_ISREG(named.st_mode) || errno != ENOENT))
        {
            return true;
        }
        // where files cannot be locked nobody knows
        if (descriptor >= 0 && flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
        {
            give_back();
            throw Failure(in_quotes(path) + " is in use: another run writes it");
        }
        if (descriptor >= 0 && has_name(descriptor, path))
        {
            return true;
        }
        give_back();
    }
    return false;
}

bool RunFile::make(const std::string &path)
{
    while (!take(path))
    {
        const int made = open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
        const int error = errno;
        if (made < 0 && error == EEXIST && is_link_to_nothing(path))
        {
            throw Failure(in_quotes(path) + " is a link to what is not there");
        }
        if (made < 0 && error != EEXIST)
        {
            throw Failure(in_quotes(path) + " cannot be made: " + std::strerror(error));
        }
        if (made >= 0)
        {
            descriptor = made;
            if ((flock(made, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) &&
                has_name(made, path))
            {
                return true;
            }
            give_back(); // another run was faster
        }
    }
    return false;
}

bool RunFile::is_at(const std::string &path) const
{
    return descriptor < 0 || has_name(descriptor, path);
}

bool RunFile::is_empty() const
{
    struct stat status;
    return descriptor >= 0 && fstat(descriptor, &status) == 0 && status.st_size == 0;
}

std::string unfinished_path(const std::string &path)
{
    const std::size_t slash = path.find_last_of('/') + 1; // 0 without one
    const std::string name = path.substr(slash);
    const std::size_t room = name_most - journal_bytes - std::strlen(unfinished_end);
    if (name.size() <= room)
    {
        return path + unfinished_end;
    }
    char sum[20];
    std::snprintf(sum, sizeof sum, "~%016llx",
                  static_cast<unsigned long long>(
                      cm_check_sum(CM_CHECK_SUM_BEGIN, name.data(), name.size())));
    return path.substr(0, slash) + beginning(name, room - std::strlen(sum)) + sum + unfinished_end;
}
