// SPDX-License-Identifier: MIT
//
// Output files that appear under their names only when all of them are complete.

#ifndef CUBEMAP_TOOLS_ATOMIC_FILE_HPP
#define CUBEMAP_TOOLS_ATOMIC_FILE_HPP

#include "modules/image/io/image_io.h"

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

// A file that is being written, under a temporary name in the folder where it will appear. Writing
// never fails: the first error is kept for finish(). What programs that were killed have left in
// that folder goes away.
class AtomicFile
{
public:
    // Failure if the file cannot be made, or if its name belongs to something that is not a file.
    explicit AtomicFile(const std::string &path);
    // Not a file but a stream, into which bytes go at once and in their order; it must outlive this.
    AtomicFile(const std::string &stream_name, std::FILE *stream);
    // Removes the temporary file unless appear() was called.
    ~AtomicFile();
    AtomicFile(const AtomicFile &) = delete;
    AtomicFile &operator=(const AtomicFile &) = delete;

    void seek(std::int64_t offset);
    std::size_t read(void *buffer, std::size_t size);
    void write(const void *buffer, std::size_t size);
    std::size_t size() const;

    // The same as a stream, which needs this file.
    cm_image_stream stream() noexcept;

    // The name under which a library that does not write to streams may write the file.
    const std::string &temporary_name() const noexcept
    {
        return temporary;
    }

    // The error that writing has met so far, as a Failure.
    void check() const;

    // All is written: bring it to the disk and close. Failure if anything went wrong on the way.
    void finish();

    // After finish(): the complete file goes to another folder, and stays there if the program ends before appear().
    // False if it cannot: then it is where it was.
    bool keep_as(const std::string &path) noexcept;
    // A complete file that keep_as() has left, in place of this one.
    void take(const std::string &path);

    // Rename to the final name. After finish() only.
    void appear();

private:
    void note_error(int number) noexcept;

    std::string name;      // as the user gave it
    std::string target;    // with symbolic links followed
    std::string temporary; // in the same folder
    std::FILE *file = nullptr;
    bool is_stream = false;
    std::int64_t position = 0;
    std::size_t slot = 0; // where the signal handler finds the temporary name
    int error_number = 0;
    bool kept = false; // temporary is what keep_as() has made
};

// Finishes all, then renames all; signals that would end the program wait until that is done.
void appear_together(const std::vector<std::unique_ptr<AtomicFile>> &files);

// Do these names lead to the same file?
bool same_file(const std::string &one, const std::string &other);

#endif
