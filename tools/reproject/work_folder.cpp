// SPDX-License-Identifier: MIT
//
// The journal's lines are "rows PICTURE FIRST END CRC32", "picture PICTURE BYTES" and "source PICTURE BYTES". Each is written at once, and a last
// one without its end does not count.

#include "work_folder.hpp"
#include "file_checksum.hpp"
#include "tools/cli/program.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace
{

// No output has more pictures.
constexpr std::size_t picture_count = 16;

constexpr const char *identity_name = "work.json";
constexpr const char *journal_name = "journal";

constexpr const char *tiles_name = "tiles";

// OUTPUT may be a folder, with a stroke at its end.
std::string folder_of(const std::string &output)
{
    return output.substr(0, output.find_last_not_of('/') + 1) + ".resume";
}

bool is_ours(const std::string &name)
{
    return name == identity_name || name == journal_name || name == tiles_name ||
           name == std::string(identity_name) + ".new" || name.rfind("rows-", 0) == 0 ||
           name.rfind("picture-", 0) == 0 || name.rfind("source-", 0) == 0;
}

// Files that are ours, then the folder, unless something else is in it.
void remove_folder(const std::string &folder) noexcept
{
    std::error_code error;
    std::vector<std::filesystem::path> names;
    for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error))
    {
        if (is_ours(entry->path().filename().string()))
        {
            names.push_back(entry->path());
        }
    }
    // what says of which work goes last: without it the rest counts for nothing
    std::sort(names.begin(), names.end(),
              [](const auto &one, const auto &other)
              { return one.filename() != identity_name && other.filename() == identity_name; });
    for (const std::filesystem::path &name : names)
    {
        std::filesystem::remove_all(name, error);
    }
    rmdir(folder.c_str());
}

std::vector<std::string> lines_of(const std::string &text)
{
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);)
    {
        lines.push_back(line);
    }
    return lines;
}

std::string content_of(const std::string &path)
{
    std::ifstream file(path, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
}

std::string trimmed(const std::string &line)
{
    const std::size_t begin = line.find_first_not_of(" ");
    const std::size_t end = line.find_last_not_of(" ,");
    return begin == std::string::npos ? "" : line.substr(begin, end + 1 - begin);
}

bool write_all(int file, const void *bytes, std::size_t size, off_t at)
{
    const char *from = static_cast<const char *>(bytes);
    while (size > 0)
    {
        const ssize_t count = pwrite(file, from, size, at);
        if (count < 0 && errno != EINTR)
        {
            return false;
        }
        const std::size_t done = count > 0 ? static_cast<std::size_t>(count) : 0;
        from += done;
        at += static_cast<off_t>(done);
        size -= done;
    }
    return true;
}

bool read_all(int file, void *bytes, std::size_t size, off_t at)
{
    char *to = static_cast<char *>(bytes);
    while (size > 0)
    {
        const ssize_t count = pread(file, to, size, at);
        if (count == 0 || (count < 0 && errno != EINTR))
        {
            return false;
        }
        const std::size_t done = count > 0 ? static_cast<std::size_t>(count) : 0;
        to += done;
        at += static_cast<off_t>(done);
        size -= done;
    }
    return true;
}

} // namespace

// ---- life

WorkFolder::WorkFolder(const std::string &output, const std::string &identity)
    : folder(folder_of(output)), pictures(picture_count)
{
    struct stat status;
    if (mkdir(folder.c_str(), 0777) != 0 && errno != EEXIST)
    {
        fail(errno);
    }
    if (stat(folder.c_str(), &status) != 0 || !S_ISDIR(status.st_mode))
    {
        fail(ENOTDIR);
    }
    const bool is_known = std::filesystem::exists(path(identity_name));
    if (is_known)
    {
        check_identity(identity);
    }
    for (const auto &entry : std::filesystem::directory_iterator(folder))
    {
        if (!is_ours(entry.path().filename().string()))
        {
            throw Failure(in_quotes(folder) + " has " +
                          in_quotes(entry.path().filename().string()) +
                          ", which no interrupted work has left; --resume needs that folder");
        }
    }
    journal =
        Descriptor(open(path(journal_name).c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666));
    if (journal.get() < 0)
    {
        fail(errno);
    }
    if (flock(journal.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    {
        throw Failure(in_quotes(folder) + " is in use by another process that makes " +
                      in_quotes(output));
    }
    if (is_known)
    {
        read_journal();
    }
    else
    {
        begin(identity);
    }
}

WorkFolder::Descriptor::~Descriptor()
{
    if (number >= 0)
    {
        close(number);
    }
}

WorkFolder::Descriptor::Descriptor(Descriptor &&other) noexcept
    : number(std::exchange(other.number, -1))
{
}

WorkFolder::Descriptor &WorkFolder::Descriptor::operator=(Descriptor &&other) noexcept
{
    std::swap(number, other.number);
    return *this;
}

void WorkFolder::fail(int error) const
{
    throw Failure(in_quotes(folder) + " cannot be written: " + std::strerror(error));
}

std::string WorkFolder::path(const std::string &name) const
{
    return folder + "/" + name;
}

void WorkFolder::check_identity(const std::string &identity) const
{
    const std::vector<std::string> there = lines_of(content_of(path(identity_name)));
    const std::vector<std::string> here = lines_of(identity);
    for (std::size_t i = 0; i < std::max(there.size(), here.size()); ++i)
    {
        const std::string was = i < there.size() ? trimmed(there[i]) : "nothing";
        const std::string is = i < here.size() ? trimmed(here[i]) : "nothing";
        if (was != is)
        {
            throw Failure(in_quotes(folder) + " is of other work: it has " + in_quotes(was) +
                          " where this has " + in_quotes(is) +
                          "; give the same command, or remove that folder");
        }
    }
}

// The identity appears whole or not at all, before anything that it is about.
void WorkFolder::begin(const std::string &identity)
{
    const std::string name = path(std::string(identity_name) + ".new");
    std::ofstream file(name, std::ios::binary);
    file << identity;
    file.close();
    if (!file || ftruncate(journal.get(), 0) != 0 ||
        std::rename(name.c_str(), path(identity_name).c_str()) != 0)
    {
        fail(errno);
    }
}

void WorkFolder::remove() noexcept
{
    remove_folder(folder);
}

void WorkFolder::forget(const std::string &output) noexcept
{
    const std::string name = folder_of(output);
    const int file = open((name + "/" + journal_name).c_str(), O_RDWR | O_CLOEXEC);
    if (file >= 0 && flock(file, LOCK_EX | LOCK_NB) == 0)
    {
        remove_folder(name);
    }
    if (file >= 0)
    {
        close(file);
    }
}

// ---- the journal

void WorkFolder::read_journal()
{
    const std::string text = content_of(path(journal_name));
    const std::size_t end = text.rfind('\n');
    const std::size_t whole = end == std::string::npos ? 0 : end + 1;
    if (ftruncate(journal.get(), static_cast<off_t>(whole)) != 0)
    {
        fail(errno);
    }
    for (const std::string &line : lines_of(text.substr(0, whole)))
    {
        read_line(line);
    }
}

void WorkFolder::read_line(const std::string &line)
{
    std::istringstream words(line);
    std::string what;
    std::size_t picture = picture_count;
    words >> what >> picture;
    int first = 0;
    Rows rows = {};
    std::int64_t size = 0;
    if (picture >= picture_count)
    {
        return;
    }
    if (what == "rows" && words >> first >> rows.end >> rows.checksum)
    {
        pictures[picture].rows[first] = rows;
    }
    else if (what == "picture" && words >> size)
    {
        pictures[picture].complete_size = size;
    }
    else if (what == "source" && words >> size)
    {
        pictures[picture].source_size = static_cast<std::uint64_t>(size);
    }
}

void WorkFolder::note(const std::string &line)
{
    // to its end, in one piece
    const ssize_t count = write(journal.get(), line.data(), line.size());
    if (count != static_cast<ssize_t>(line.size()))
    {
        fail(count < 0 ? errno : ENOSPC);
    }
}

// ---- rows

int WorkFolder::rows_file(std::size_t picture)
{
    Descriptor &file = pictures[picture].rows_file;
    if (file.get() < 0)
    {
        file = Descriptor(open(path("rows-" + std::to_string(picture)).c_str(),
                               O_RDWR | O_CREAT | O_CLOEXEC, 0666));
    }
    if (file.get() < 0)
    {
        fail(errno);
    }
    return file.get();
}

bool WorkFolder::load(std::size_t picture, int first, int end, void *bytes, std::size_t size)
{
    std::unique_lock<std::mutex> lock(mutex);
    const auto found = pictures[picture].rows.find(first);
    if (found == pictures[picture].rows.end() || found->second.end != end)
    {
        return false;
    }
    const std::uint32_t checksum = found->second.checksum;
    const int file = rows_file(picture);
    lock.unlock();
    const std::size_t row = size / static_cast<std::size_t>(end - first);
    return read_all(file, bytes, size, static_cast<off_t>(row * static_cast<std::size_t>(first))) &&
           checksum_of(bytes, size) == checksum;
}

void WorkFolder::store(std::size_t picture, int first, int end, const void *bytes, std::size_t size)
{
    std::unique_lock<std::mutex> lock(mutex);
    const int file = rows_file(picture);
    lock.unlock();
    const std::uint32_t checksum = checksum_of(bytes, size);
    const std::size_t row = size / static_cast<std::size_t>(end - first);
    if (!write_all(file, bytes, size, static_cast<off_t>(row * static_cast<std::size_t>(first))))
    {
        fail(errno);
    }
    lock.lock();
    note("rows " + std::to_string(picture) + " " + std::to_string(first) + " " +
         std::to_string(end) + " " + std::to_string(checksum) + "\n");
}

// ---- what INPUT was decoded to

std::string WorkFolder::source_name(std::size_t picture) const
{
    const char *const elsewhere = std::getenv("TMPDIR");
    const bool is_said = elsewhere != nullptr && *elsewhere != '\0';
    return is_said ? "" : path("source-" + std::to_string(picture));
}

bool WorkFolder::has_source(std::size_t picture, std::size_t size) const
{
    struct stat status;
    const std::string name = source_name(picture);
    return !name.empty() && pictures[picture].source_size == size &&
           stat(name.c_str(), &status) == 0 && static_cast<std::uint64_t>(status.st_size) == size;
}

void WorkFolder::note_source(std::size_t picture, std::size_t size)
{
    const std::lock_guard<std::mutex> lock(mutex);
    note("source " + std::to_string(picture) + " " + std::to_string(size) + "\n");
}

// ---- tiles

std::string WorkFolder::tiles() const
{
    const std::string name = path(tiles_name);
    if (mkdir(name.c_str(), 0777) != 0 && errno != EEXIST)
    {
        fail(errno);
    }
    return name;
}

// ---- pictures

std::string WorkFolder::picture_name(std::size_t picture) const
{
    return path("picture-" + std::to_string(picture));
}

bool WorkFolder::is_complete(std::size_t picture) const
{
    struct stat status;
    return pictures[picture].complete_size >= 0 &&
           stat(picture_name(picture).c_str(), &status) == 0 &&
           status.st_size == pictures[picture].complete_size;
}

void WorkFolder::complete(std::size_t picture)
{
    struct stat status;
    if (stat(picture_name(picture).c_str(), &status) != 0)
    {
        fail(errno);
    }
    const std::lock_guard<std::mutex> lock(mutex);
    note("picture " + std::to_string(picture) + " " + std::to_string(status.st_size) + "\n");
    unlink(path("rows-" + std::to_string(picture)).c_str());
}
