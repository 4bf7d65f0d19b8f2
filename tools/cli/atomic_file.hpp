// SPDX-License-Identifier: MIT
//
// Output files that appear under their names only when all of them are complete.

#ifndef CUBEMAP_TOOLS_ATOMIC_FILE_HPP
#define CUBEMAP_TOOLS_ATOMIC_FILE_HPP

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include <OpenImageIO/filesystem.h>

// A file that is being written, under a temporary name in the folder where it will appear. To the
// image library it is a stream that never fails: the first error is kept for finish().
class AtomicFile : public OIIO::Filesystem::IOProxy
{
public:
    // Failure if the file cannot be made, or if its name belongs to something that is not a file.
    explicit AtomicFile(const std::string &path);
    // Removes the temporary file unless appear() was called.
    ~AtomicFile() override;

    // Not "file": the library takes what calls itself that for its own IOFile.
    const char *proxytype() const override
    {
        return "atomic";
    }
    bool seek(std::int64_t offset) override;
    std::size_t read(void *buffer, std::size_t size) override;
    std::size_t write(const void *buffer, std::size_t size) override;
    std::size_t size() const override;

    // The name under which a library that does not write to streams may write the file.
    const std::string &temporary_name() const noexcept
    {
        return temporary;
    }

    // The error that writing has met so far, as a Failure.
    void check() const;

    // All is written: bring it to the disk and close. Failure if anything went wrong on the way.
    void finish();

    // Rename to the final name. After finish() only.
    void appear();

private:
    void note_error(int number) noexcept;

    std::string name;      // as the user gave it
    std::string target;    // with symbolic links followed
    std::string temporary; // in the same folder
    std::FILE *stream = nullptr;
    std::size_t slot = 0; // where the signal handler finds the temporary name
    int error_number = 0;
};

// Finishes all, then renames all; signals that would end the program wait until that is done.
void appear_together(const std::vector<std::unique_ptr<AtomicFile>> &files);

// From now on SIGINT, SIGTERM and SIGHUP remove the temporary files before they end the program
// (those of them that are ignored stay so), and a write beyond the limit on the size of files is an
// error, not a signal.
void guard_temporary_files();

// Do these names lead to the same file?
bool same_file(const std::string &one, const std::string &other);

#endif
