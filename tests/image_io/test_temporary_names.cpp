// SPDX-License-Identifier: MIT
//
// Files and folders that are not complete, beside a process that removes what is left over at the worst moments: between the
// making and the lock, where it finds them unlocked. The linker puts what is here between the library and the system.

#include "modules/image/io/temporary_name.hpp"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <string>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#define REQUIRE(condition)                                                                         \
    do                                                                                             \
    {                                                                                              \
        if (!(condition))                                                                          \
        {                                                                                          \
            std::fprintf(stderr, "%s:%d: not true: %s\n", __FILE__, __LINE__, #condition);         \
            std::exit(1);                                                                          \
        }                                                                                          \
    } while (0)

namespace
{

const char *const extension = ".made";
void (*before_lock)() = nullptr; // once
std::string in_removal;          // what is being removed, if it was locked then

std::string made_name(int number, const char *ending)
{
    return "./" + own_temporary_name(number, ending);
}

bool is_there(const std::string &path)
{
    struct stat status;
    return stat(path.c_str(), &status) == 0;
}

} // namespace

extern "C" {
int __real_flock(int descriptor, int operation);
int __wrap_flock(int descriptor, int operation);
int __real_unlink(const char *path);
int __wrap_unlink(const char *path);

int __wrap_flock(int descriptor, int operation)
{
    if (before_lock != nullptr)
    {
        void (*const act)() = before_lock;
        before_lock = nullptr;
        act();
    }
    return __real_flock(descriptor, operation);
}

int __wrap_unlink(const char *path)
{
    const int descriptor = open(path, O_RDONLY);
    if (descriptor >= 0 && __real_flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    {
        in_removal = path;
    }
    close(descriptor);
    return __real_unlink(path);
}
}

namespace
{

void remove_all_left_over()
{
    remove_left_over_files(".");
    remove_left_over_folders(".", extension);
}

// One that is gone, or another's of this name, is none that was made.
void check_made(int (*make)(const std::string &))
{
    const std::string name = made_name(0, extension);
    before_lock = remove_all_left_over;
    int descriptor = make(name);
    REQUIRE(descriptor == -1 && errno == EEXIST && !is_there(name));
    descriptor = make(name);
    REQUIRE(descriptor >= 0 && is_there(name));
    remove_all_left_over();
    REQUIRE(is_there(name)); // locked
    REQUIRE(make(name) == -1 && errno == EEXIST);
    close(descriptor);
    remove_all_left_over();
    REQUIRE(!is_there(name));
}

// It is locked until it is gone, so that its maker, too late, does not take it for its own.
void check_locked_in_removal()
{
    const std::string name = made_name(1, extension);
    close(make_temporary_file(name, 0600));
    remove_left_over_files(".");
    REQUIRE(!is_there(name) && in_removal == name);
}

// Another file has this name when what was found is locked: that is somebody's.
void check_name_of_another()
{
    static const std::string name = made_name(2, extension);
    static int other = -1;
    close(make_temporary_file(name, 0600));
    before_lock = []
    {
        __real_unlink(name.c_str());
        other = make_temporary_file(name, 0600);
    };
    remove_left_over_files(".");
    REQUIRE(other >= 0 && is_there(name));
    close(other);
    remove_left_over_files(".");
}

// Folders of another kind are not even locked.
void check_kinds()
{
    const std::string name = made_name(3, ".other");
    close(make_temporary_folder(name));
    remove_left_over_folders(".", extension);
    REQUIRE(is_there(name));
    remove_left_over_folders(".", ".other");
    REQUIRE(!is_there(name));
}

} // namespace

int main()
{
    char folder[] = "/tmp/test-temporary-names-XXXXXX";
    REQUIRE(mkdtemp(folder) != nullptr && chdir(folder) == 0);
    check_made([](const std::string &path) { return make_temporary_file(path, 0600); });
    check_made(make_temporary_folder);
    check_locked_in_removal();
    check_name_of_another();
    check_kinds();
    REQUIRE(rmdir(folder) == 0); // nothing is left
    std::puts("temporary names: all as they should be");
    return 0;
}
