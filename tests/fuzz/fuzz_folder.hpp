// SPDX-License-Identifier: MIT
//
// A folder for a program that runs inside a harness: it is there as long as the harness runs, and what the program leaves in it
// is found.

#ifndef TESTS_FUZZ_FOLDER_HPP
#define TESTS_FUZZ_FOLDER_HPP

#include <fcntl.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <string_view>

#include "fuzz_arguments.h"
#include "fuzz_streams.h"

class FuzzFolder
{
public:
    // In memory, where the system has files there.
    explicit FuzzFolder(const char *beginning)
    {
        const std::filesystem::path memory = "/dev/shm";
        const bool is_there = access(memory.c_str(), W_OK) == 0;
        name = (is_there ? memory : std::filesystem::temp_directory_path()) /
               (std::string(beginning) + "-XXXXXX");
        EXPECT(mkdtemp(name.data()) != nullptr, "no folder %s", name.c_str());
        descriptor = open(name.c_str(), O_RDONLY | O_DIRECTORY);
        before = open(".", O_RDONLY | O_DIRECTORY);
        EXPECT(descriptor >= 0 && before >= 0, "no folder %s", name.c_str());
    }
    ~FuzzFolder()
    {
        std::error_code ignored;
        std::filesystem::remove_all(name, ignored);
    }
    FuzzFolder(const FuzzFolder &) = delete;
    FuzzFolder &operator=(const FuzzFolder &) = delete;

    void write(const std::string &file, std::string_view content) const
    {
        std::FILE *const stream = std::fopen(path_of(file).c_str(), "wb");
        EXPECT(stream != nullptr, "no file in %s", name.c_str());
        const std::size_t count = std::fwrite(content.data(), 1, content.size(), stream);
        EXPECT(count == content.size() && std::fclose(stream) == 0, "no room in %s", name.c_str());
    }
    std::string read(const std::string &file) const
    {
        std::ifstream stream(path_of(file), std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(stream), {});
    }
    std::string path_of(const std::string &file) const
    {
        return name + "/" + file;
    }

    // What is there now is not removed.
    void keep()
    {
        kept = names();
    }
    // Removes what has come since; whether there was anything.
    bool remove_others() const
    {
        bool any = false;
        for (const std::string &each : names())
        {
            if (kept.count(each) == 0)
            {
                any = true;
                std::filesystem::remove_all(path_of(each));
            }
        }
        return any;
    }

    // libFuzzer's own names begin where it was started.
    void enter() const
    {
        EXPECT(fchdir(descriptor) == 0, "cannot enter %s", name.c_str());
    }
    void leave() const
    {
        EXPECT(fchdir(before) == 0, "cannot leave %s", name.c_str());
    }

private:
    std::set<std::string> names() const
    {
        std::set<std::string> found;
        for (const auto &entry : std::filesystem::directory_iterator(name))
        {
            found.insert(entry.path().filename().string());
        }
        return found;
    }

    std::string name;
    std::set<std::string> kept;
    int descriptor = -1;
    int before = -1;
};

inline bool names_elsewhere(const arguments &given)
{
    for (int i = 1; i < given.count; ++i)
    {
        if (strchr(given.argument[i], '/') != nullptr)
        {
            return true;
        }
    }
    return false;
}

#endif
