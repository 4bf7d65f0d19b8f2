// SPDX-License-Identifier: MIT
//
// What of an output is done, in a folder beside it, so that a program that was ended at any moment goes on from there.

#ifndef CUBEMAP_TOOLS_WORK_FOLDER_HPP
#define CUBEMAP_TOOLS_WORK_FOLDER_HPP

#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <vector>

// It has work.json, which says of which work, a journal of what is done, the rows of pictures that are not complete as
// they were computed, and pictures and tiles that are. What is in the journal, with its checksum, counts; all else is done again.
// Functions about different pictures may be called by different threads.
class WorkFolder
{
public:
    // The folder OUTPUT.resume, as an earlier run has left it, or new. identity is lines of JSON, and says what must be
    // the same so that the output is. Failure if the folder is of other work, in use, or cannot be made.
    WorkFolder(const std::string &output, const std::string &identity);
    WorkFolder(const WorkFolder &) = delete;
    WorkFolder &operator=(const WorkFolder &) = delete;

    // The rows from first to before end of a picture, if they are done.
    bool load(std::size_t picture, int first, int end, void *bytes, std::size_t size);
    // They are done now. Failure if they cannot be kept.
    void store(std::size_t picture, int first, int end, const void *bytes, std::size_t size);

    // Where the decoded pixels of INPUT's picture may be kept; "" where TMPDIR names another folder for them.
    std::string source_name(std::size_t picture) const;
    // Are they there, so many bytes?
    bool has_source(std::size_t picture, std::size_t size) const;
    // They are there now, on the disk.
    void note_source(std::size_t picture, std::size_t size);

    // Where a complete picture is kept.
    std::string picture_name(std::size_t picture) const;
    // Is it there?
    bool is_complete(std::size_t picture) const;
    // Now it is; its rows are needed no longer.
    void complete(std::size_t picture);

    // A folder in it, for an output of many files. What it has is known to who writes there.
    std::string tiles() const;

    // All is done: the folder goes away, which stays without this.
    void remove() noexcept;

    // Removes the folder of an output that was made without it, if there is one and no program uses it.
    static void forget(const std::string &output) noexcept;

private:
    class Descriptor
    {
    public:
        explicit Descriptor(int opened = -1) noexcept : number(opened)
        {
        }
        ~Descriptor();
        Descriptor(Descriptor &&other) noexcept;
        Descriptor &operator=(Descriptor &&other) noexcept;
        int get() const noexcept
        {
            return number;
        }

    private:
        int number;
    };
    struct Rows
    {
        int end;
        std::uint32_t checksum;
    };
    struct Picture
    {
        Descriptor rows_file;
        std::map<int, Rows> rows; // by the first one
        std::int64_t complete_size = -1;
        std::uint64_t source_size = 0; // of INPUT's picture of that number
    };

    void check_identity(const std::string &identity) const;
    void begin(const std::string &identity);
    void read_journal();
    void read_line(const std::string &line);
    void note(const std::string &line);
    int rows_file(std::size_t picture);
    std::string path(const std::string &name) const;
    [[noreturn]] void fail(int error) const;

    std::string folder;
    Descriptor journal;
    std::vector<Picture> pictures;
    std::mutex mutex; // of the journal and of pictures
};

#endif
