// SPDX-License-Identifier: MIT
//
// What the readers and writers of this folder share: failures that name file and line, whole texts, their lines and numbers,
// and files that appear when they are complete.

#ifndef CUBEMAP_MODULES_SCENE_FILE_FAILURE_HPP
#define CUBEMAP_MODULES_SCENE_FILE_FAILURE_HPP

#include "text_begin.hpp"
#include "modules/image/io/image_io.h"

#include <cstddef>
#include <cstdint>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

// What is wrong, whole: "FILE:LINE: what is wrong".
class FileFailure : public std::runtime_error
{
public:
    FileFailure(cm_status what, const std::string &text) : std::runtime_error(text), number(what)
    {
    }
    cm_status status() const noexcept
    {
        return number;
    }

private:
    cm_status number;
};

// "FILE: " before the text; "FILE:LINE: ".
[[noreturn]] void fail_file(const std::string &file, const std::string &text,
                            cm_status status = CM_ERROR_DATA);
[[noreturn]] void fail_line(const std::string &file, std::size_t line, const std::string &text,
                            cm_status status = CM_ERROR_DATA);
// What the system says of errno; of ENOMEM std::bad_alloc.
[[noreturn]] void fail_system(const std::string &file, const std::string &text);

// At most CM_IMAGE_MESSAGE bytes, without what ends a line. message may be NULL.
void put_line(const std::string &text, char *message) noexcept;

// Calls body; an exception becomes a status and a message.
template <typename Body> cm_status guarded_file(char *message, const Body &body) noexcept
{
    try
    {
        body();
        return CM_OK;
    }
    catch (const FileFailure &failure)
    {
        put_line(failure.what(), message);
        return failure.status();
    }
    catch (const std::length_error &)
    {
        put_line("more memory is needed than there is", message);
        return CM_ERROR_MEMORY;
    }
    catch (const std::bad_alloc &)
    {
        put_line("more memory is needed than there is", message);
        return CM_ERROR_MEMORY;
    }
    catch (const std::exception &exception)
    {
        put_line(exception.what(), message);
        return CM_ERROR_DATA;
    }
}

// The words of a text's lines. What is empty or begins with # is passed over.
class LineWords
{
public:
    // The text, and the letters that part its words, must outlive this.
    LineWords(std::string file_name, std::string_view whole, std::string_view parted_by = " \t\r,");
    // To the next line that says something; false at the end.
    bool next();
    const std::vector<std::string_view> &words() const
    {
        return parts;
    }
    // A word as a finite number, or a failure that names the line.
    double number(std::size_t index) const;
    std::size_t line() const
    {
        return count;
    }
    [[noreturn]] void fail(const std::string &what, cm_status status = CM_ERROR_DATA) const
    {
        fail_line(name, count, what, status);
    }

private:
    std::string name;
    std::string_view text;
    std::string_view apart;
    std::size_t at = 0;
    std::size_t count = 0;
    std::vector<std::string_view> parts;
};

// All of a word as a number; false if it is none, as nan is. Beyond the range of double it is an infinity.
bool word_number(std::string_view word, double &number);
// A decimal that is the same number again.
std::string number_text(double number);

bool file_is_there(const std::string &path);
bool folder_is_there(const std::string &path);
std::string path_in(const std::string &folder, const std::string &name);
// Is one of a name's parts the parent of a folder?
bool leads_up(const std::string &name);
// What is in a folder, in any order. std::filesystem's iterators end the program where there is no memory.
std::vector<std::string> names_in_folder(const std::string &folder);
// All bytes of a file of at most so many.
std::string read_whole(const std::string &path, std::uint64_t most);
// No list of views or poses is longer.
constexpr std::uint64_t text_bytes_most = std::uint64_t{1} << 28;
// The file appears under its name when all of it is on the disk.
void write_whole(const std::string &path, std::string_view bytes);
// Bring what was written to the disk, and the names in a folder.
void sync_folder(const std::string &folder);

#endif
