// SPDX-License-Identifier: MIT
//
// The file that a run of cubemap-octree writes: one run has it, from before its store opens until it has come to its place.

#ifndef CUBEMAP_TOOLS_OCTREE_RUN_FILE_HPP
#define CUBEMAP_TOOLS_OCTREE_RUN_FILE_HPP

#include <string>

// A file that no other run can take. It is locked itself, not its name, by flock, so that it stays taken while it is renamed;
// the locks of its store end when that closes, which is before. To be given back after the store: to close a file ends all locks
// that a process has on it by fcntl, as SQLite's are.
class RunFile
{
public:
    RunFile() = default;
    ~RunFile();
    RunFile(RunFile &&other) noexcept;
    RunFile &operator=(RunFile &&other) noexcept;
    RunFile(const RunFile &) = delete;
    RunFile &operator=(const RunFile &) = delete;

    // Takes what has this name, in the place of what was taken. False if nothing has it. Failure if another run has it. What is
    // no file, or may not be written, is not taken, and who opens it is told so.
    bool take(const std::string &path);

    // The same; a file that is not there is made, without a byte. Was it? Failure if it cannot be.
    bool make(const std::string &path);

    // Has this name what was taken? True of what could not be.
    bool is_at(const std::string &path) const;

    // Has the file that is taken no byte?
    bool is_empty() const;

    void give_back() noexcept;

private:
    int descriptor = -1;
};

// Where a new map is made beside an old one: PATH.unfinished. Of a name that is too long for this and the journal's end, its
// beginning, '~' and 16 digits that are the sum of all of it.
std::string unfinished_path(const std::string &path);

#endif
