// SPDX-License-Identifier: MIT

#include "temporary_name.hpp"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <memory>

#include <dirent.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace
{

constexpr const char *temporary_begin = ".cubemap-";

std::string name_of(pid_t process, int number, const std::string &extension)
{
    return temporary_begin + std::to_string(process) + "-" + std::to_string(number) + extension;
}

std::string extension_of(const std::string &file_name)
{
    const std::size_t point = file_name.rfind('.');
    return point == 0 || point == std::string::npos ? "" : file_name.substr(point);
}

// The process in a temporary name, or 0 if it is none.
pid_t process_of(const std::string &file_name)
{
    const std::string begin = temporary_begin;
    long process = 0;
    int number = 0;
    if (file_name.compare(0, begin.size(), begin) != 0 ||
        std::sscanf(file_name.c_str() + begin.size(), "%9ld-%4d", &process, &number) != 2 ||
        process <= 0)
    {
        return 0;
    }
    const pid_t found = static_cast<pid_t>(process);
    const std::string again = name_of(found, number, "");
    return again + extension_of(file_name) == file_name ? found : 0;
}

// False if somebody has it. Where files cannot be locked nobody knows.
bool lock(int descriptor)
{
    return flock(descriptor, LOCK_EX | LOCK_NB) == 0;
}

// Is what is open still what has this name?
bool has_name(int descriptor, const std::string &path)
{
    struct stat opened;
    struct stat named;
    return fstat(descriptor, &opened) == 0 && lstat(path.c_str(), &named) == 0 &&
           opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

// Has what is open lost its name? Numbers of files do not tell that of what is new: some file systems change them.
bool is_removed(int descriptor, const std::string &path)
{
    struct stat opened;
    struct stat named;
    return (fstat(descriptor, &opened) == 0 && opened.st_nlink == 0) ||
           (lstat(path.c_str(), &named) != 0 && errno == ENOENT);
}

// What was just made, locked. Between the two others may have found it unlocked: it is theirs then, to be removed, and the
// answer is that of a name that is taken.
int locked(int descriptor, const std::string &path)
{
    if (descriptor >= 0 &&
        ((!lock(descriptor) && errno == EWOULDBLOCK) || is_removed(descriptor, path)))
    {
        close(descriptor);
        errno = EEXIST;
        return -1;
    }
    return descriptor;
}

// Locked until it is closed, so that who has just made it does not take it for its own; -1 if somebody has it. flags tell files
// and folders apart.
int lock_left_over(const std::string &path, int flags)
{
    const int descriptor = open(path.c_str(), flags | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    if (descriptor >= 0 && !(lock(descriptor) && has_name(descriptor, path)))
    {
        close(descriptor);
        return -1;
    }
    return descriptor;
}

// By its name alone: in a container each process may have the number of one that was killed, and its own it has locked.
bool may_be_left_over(const std::string &file_name)
{
    const pid_t process = process_of(file_name);
    return process != 0 && (process == getpid() || (kill(process, 0) != 0 && errno == ESRCH));
}

struct FolderCloser
{
    void operator()(DIR *open) const noexcept
    {
        closedir(open);
    }
};

struct Opened
{
    int descriptor;
    ~Opened()
    {
        if (descriptor >= 0)
        {
            close(descriptor);
        }
    }
};

// By the system's own means: without memory the library's iterator ends the program.
template <typename IsMeant, typename Remove>
void remove_each(const std::string &folder, int flags, const IsMeant &is_meant,
                 const Remove &remove)
{
    const std::unique_ptr<DIR, FolderCloser> open(opendir(folder.c_str()));
    const dirent *entry = nullptr;
    while (open != nullptr && (entry = readdir(open.get())) != nullptr)
    {
        const std::string name = entry->d_name;
        const std::string path = folder + "/" + name;
        const Opened held = {may_be_left_over(name) && is_meant(name) ? lock_left_over(path, flags)
                                                                      : -1};
        if (held.descriptor >= 0)
        {
            remove(path);
        }
    }
}

} // namespace

std::string own_temporary_name(int number, const std::string &extension)
{
    return name_of(getpid(), number, extension);
}

int make_temporary_file(const std::string &path, mode_t mode)
{
    return locked(open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, mode), path);
}

int make_temporary_folder(const std::string &path)
{
    if (mkdir(path.c_str(), 0777) != 0)
    {
        return -1;
    }
    const int descriptor = open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0)
    {
        const int why = errno == ENOENT ? EEXIST : errno; // removed by others, as above
        rmdir(path.c_str());
        errno = why;
    }
    return locked(descriptor, path);
}

void remove_left_over_files(const std::string &folder)
{
    remove_each(
        folder, O_RDWR, [](const std::string &) { return true; },
        [](const std::string &path) { unlink(path.c_str()); });
}

void remove_left_over_folders(const std::string &folder, const std::string &extension)
{
    remove_each(
        folder, O_RDONLY | O_DIRECTORY,
        [&extension](const std::string &name) { return extension_of(name) == extension; },
        [](const std::string &path)
        {
            std::error_code error;
            std::filesystem::remove_all(path, error);
        });
}
