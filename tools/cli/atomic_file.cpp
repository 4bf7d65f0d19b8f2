// SPDX-License-Identifier: MIT

#include "atomic_file.hpp"
#include "modules/image/io/temporary_name.hpp"
#include "program.hpp"
#include "temporary_guard.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace
{

// The temporary names, for the signal handler: it must find them without a lock.
constexpr std::size_t slot_count = 256;
std::array<std::atomic<const char *>, slot_count> temporary_names;

constexpr std::array<int, 4> ending_signals = {SIGINT, SIGTERM, SIGHUP, SIGPIPE};

// A signal that has come, and how many SignalsHeld there are. The handler writes the one and then
// reads the other, SignalsHeld the other way round, so at least one of them sees both.
std::atomic<int> signal_come{0};
std::atomic<int> holders{0};

void remove_temporary_files_and_end(int signal_number)
{
    for (std::atomic<const char *> &entry : temporary_names)
    {
        const char *const name = entry.load();
        if (name != nullptr)
        {
            unlink(name);
        }
    }
    std::signal(signal_number, SIG_DFL);
    raise(signal_number);
}

void handle_ending_signal(int signal_number)
{
    signal_come = signal_number;
    if (holders == 0)
    {
        remove_temporary_files_and_end(signal_number);
    }
}

void end_if_signal_has_come()
{
    if (signal_come != 0)
    {
        remove_temporary_files_and_end(signal_come);
    }
}

std::size_t enter_temporary_name(const char *name)
{
    for (std::size_t i = 0; i < slot_count; ++i)
    {
        const char *empty = nullptr;
        if (temporary_names[i].compare_exchange_strong(empty, name))
        {
            return i;
        }
    }
    throw Failure("more than " + std::to_string(slot_count) + " output files at a time");
}

std::filesystem::path folder_of(const std::string &path)
{
    const std::filesystem::path folder = std::filesystem::path(path).parent_path();
    return folder.empty() ? "." : folder;
}

// Failure if an output must not appear under this name; else the access bits that it should have.
mode_t wanted_mode(const std::string &name, const std::string &target)
{
    struct stat status;
    if (stat(target.c_str(), &status) != 0)
    {
        const mode_t mask = umask(0);
        umask(mask);
        return 0666 & ~mask;
    }
    if (!S_ISREG(status.st_mode))
    {
        throw Failure(in_quotes(name) + " exists and is " +
                      (S_ISDIR(status.st_mode) ? "a folder" : "not a file") +
                      "; give the name of a file");
    }
    if (access(target.c_str(), W_OK) != 0)
    {
        throw Failure(in_quotes(name) + " cannot be written: " + std::strerror(errno));
    }
    return status.st_mode & 0777;
}

std::string follow_links(const std::string &path)
{
    std::error_code error;
    const std::filesystem::path target = std::filesystem::canonical(path, error);
    return error ? path : target.string();
}

} // namespace

SignalsHeld::SignalsHeld()
{
    if (++holders == 1)
    {
        end_if_signal_has_come();
    }
}

SignalsHeld::~SignalsHeld()
{
    if (--holders == 0)
    {
        end_if_signal_has_come();
    }
}

void check_held_signal()
{
    if (signal_come != 0)
    {
        throw Failure("a signal ends it");
    }
}

AtomicFile::AtomicFile(const std::string &path) : name(path), target(follow_links(path))
{
    const mode_t mode = wanted_mode(name, target);
    const std::filesystem::path folder = folder_of(target);
    const std::string extension = std::filesystem::path(target).extension().string();
    const SignalsHeld held;
    int descriptor = -1;
    for (int attempt = 0; descriptor < 0 && attempt < 1000; ++attempt)
    {
        temporary = (folder / own_temporary_name(attempt, extension)).string();
        descriptor = make_temporary_file(temporary, 0600);
        if (descriptor < 0 && errno != EEXIST)
        {
            break;
        }
        if (attempt == 0) // the first in this folder
        {
            remove_left_over_files(folder.string());
        }
    }
    if (descriptor < 0)
    {
        throw Failure(in_quotes(name) + " cannot be written: folder " + in_quotes(folder.string()) +
                      ": " + std::strerror(errno));
    }
    file = fdopen(descriptor, "w+b");
    if (file == nullptr)
    {
        unlink(temporary.c_str());
        close(descriptor);
        throw std::bad_alloc();
    }
    slot = enter_temporary_name(temporary.c_str());
    fchmod(descriptor, mode);
}

AtomicFile::AtomicFile(const std::string &stream_name, std::FILE *stream)
    : name(stream_name), file(stream), is_stream(true)
{
}

AtomicFile::~AtomicFile()
{
    const SignalsHeld held;
    if (file != nullptr && !is_stream)
    {
        std::fclose(file);
    }
    if (!temporary.empty() && !kept)
    {
        unlink(temporary.c_str());
        temporary_names[slot] = nullptr;
    }
}

void AtomicFile::note_error(int number) noexcept
{
    if (error_number == 0)
    {
        error_number = number != 0 ? number : EIO;
    }
}

void AtomicFile::seek(std::int64_t offset)
{
    if (error_number == 0 && fseeko(file, offset, SEEK_SET) != 0)
    {
        note_error(errno);
    }
    position = offset;
}

std::size_t AtomicFile::read(void *buffer, std::size_t size)
{
    std::size_t count = 0;
    if (error_number == 0 && fseeko(file, position, SEEK_SET) == 0)
    {
        count = std::fread(buffer, 1, size, file);
        fseeko(file, position + static_cast<std::int64_t>(count), SEEK_SET);
    }
    position += static_cast<std::int64_t>(count);
    return count;
}

void AtomicFile::write(const void *buffer, std::size_t size)
{
    if (error_number == 0 && std::fwrite(buffer, 1, size, file) != size)
    {
        note_error(errno);
    }
    position += static_cast<std::int64_t>(size);
}

std::size_t AtomicFile::size() const
{
    struct stat status;
    if (error_number != 0 || std::fflush(file) != 0 || fstat(fileno(file), &status) != 0)
    {
        return 0;
    }
    return static_cast<std::size_t>(status.st_size);
}

cm_image_stream AtomicFile::stream() noexcept
{
    return {this,
            [](void *context, void *bytes, std::size_t count)
            { return static_cast<AtomicFile *>(context)->read(bytes, count); },
            [](void *context, const void *bytes, std::size_t count)
            {
                static_cast<AtomicFile *>(context)->write(bytes, count);
                return count;
            },
            [](void *context, std::int64_t offset)
            { static_cast<AtomicFile *>(context)->seek(offset); },
            [](void *context) { return static_cast<AtomicFile *>(context)->size(); }};
}

void AtomicFile::check() const
{
    if (error_number != 0)
    {
        throw Failure(in_quotes(name) + " cannot be written: " + std::strerror(error_number));
    }
}

void AtomicFile::finish()
{
    if (file == nullptr)
    {
        return;
    }
    const bool flushed = std::fflush(file) == 0;
    if (!flushed || (!is_stream && fsync(fileno(file)) != 0 && errno != EINVAL))
    {
        note_error(errno);
    }
    if (!is_stream && std::fclose(file) != 0)
    {
        note_error(errno);
    }
    file = nullptr;
    check();
}

bool AtomicFile::keep_as(const std::string &path) noexcept
{
    const SignalsHeld held;
    if (std::rename(temporary.c_str(), path.c_str()) != 0)
    {
        return false;
    }
    temporary_names[slot] = nullptr;
    temporary = path;
    kept = true;
    return true;
}

void AtomicFile::take(const std::string &path)
{
    const SignalsHeld held;
    std::fclose(file);
    file = nullptr;
    unlink(temporary.c_str());
    temporary_names[slot] = nullptr;
    temporary = path;
    kept = true;
}

void AtomicFile::appear()
{
    if (is_stream)
    {
        return;
    }
    if (std::rename(temporary.c_str(), target.c_str()) != 0)
    {
        throw Failure(in_quotes(name) + " cannot be written: " + std::strerror(errno));
    }
    if (!kept)
    {
        temporary_names[slot] = nullptr;
    }
    temporary.clear();
}

void appear_together(const std::vector<std::unique_ptr<AtomicFile>> &files)
{
    for (const std::unique_ptr<AtomicFile> &each : files)
    {
        each->finish();
    }
    const SignalsHeld held;
    for (const std::unique_ptr<AtomicFile> &each : files)
    {
        each->appear();
    }
}

void guard_temporary_files()
{
    for (const int number : ending_signals)
    {
        struct sigaction action;
        if (sigaction(number, nullptr, &action) == 0 && action.sa_handler != SIG_IGN)
        {
            action = {};
            action.sa_handler = handle_ending_signal;
            sigfillset(&action.sa_mask);
            sigaction(number, &action, nullptr);
        }
    }
    std::signal(SIGXFSZ, SIG_IGN);
}

bool same_file(const std::string &one, const std::string &other)
{
    std::error_code error;
    return std::filesystem::equivalent(one, other, error) && !error;
}
