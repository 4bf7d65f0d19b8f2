// SPDX-License-Identifier: MIT

#include "file_failure.hpp"

#include "modules/image/io/temporary_name.hpp"

#include <cubemap/number.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

void fail_file(const std::string &file, const std::string &text, cm_status status)
{
    throw FileFailure(status, file + ": " + text);
}

void fail_line(const std::string &file, std::size_t line, const std::string &text, cm_status status)
{
    throw FileFailure(status, file + ":" + std::to_string(line) + ": " + text);
}

void fail_system(const std::string &file, const std::string &text)
{
    if (errno == ENOMEM)
    {
        throw std::bad_alloc();
    }
    throw FileFailure(CM_ERROR_FILE, file + ": " + text + ": " + std::strerror(errno));
}

void put_line(const std::string &text, char *message) noexcept
{
    if (message == nullptr)
    {
        return;
    }
    const std::size_t length = std::min(text.size(), std::size_t{CM_IMAGE_MESSAGE - 1});
    std::copy_n(text.begin(), length, message);
    const auto is_control = [](unsigned char byte) { return byte < ' ' || byte == 0x7f; };
    std::replace_if(message, message + length, is_control, '?');
    message[length] = '\0';
}

namespace
{

// The beginning of a word of a file, for a message; bytes that end a line, or the message, are question marks.
std::string quoted(std::string_view word)
{
    std::string shown(word.substr(0, 40));
    std::replace_if(
        shown.begin(), shown.end(), [](unsigned char byte) { return byte < ' ' || byte == 0x7f; },
        '?');
    return "\"" + shown + "\"";
}

} // namespace

LineWords::LineWords(std::string file_name, std::string_view whole, std::string_view parted_by)
    : name(std::move(file_name)), text(whole), apart(parted_by)
{
    at = begin_of_text(text);
}

bool LineWords::next()
{
    while (at < text.size())
    {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        const std::string_view whole = text.substr(at, end - at);
        at = end + 1;
        ++count;
        parts.clear();
        std::size_t begin = whole.find_first_not_of(apart);
        while (begin != std::string_view::npos)
        {
            const std::size_t stop = std::min(whole.find_first_of(apart, begin), whole.size());
            parts.push_back(whole.substr(begin, stop - begin));
            begin = whole.find_first_not_of(apart, stop);
        }
        if (!parts.empty() && parts[0][0] != '#')
        {
            return true;
        }
    }
    return false;
}

double LineWords::number(std::size_t index) const
{
    double value = 0.0;
    const std::string_view word = parts.at(index);
    if (!word_number(word, value))
    {
        fail(quoted(word) + " is no number");
    }
    if (!(value - value == 0.0))
    {
        fail(quoted(word) + " is not finite");
    }
    return value;
}

bool word_number(std::string_view word, double &number)
{
    const std::size_t sign = !word.empty() && word[0] == '+';
    return cm_number_parse(word.data() + sign, word.size() - sign, &number) == 1;
}

std::string number_text(double number)
{
    std::array<char, CM_NUMBER_SIZE> text;
    return std::string(text.data(), cm_number_write_shortest(number, text.data()));
}

bool file_is_there(const std::string &path)
{
    struct stat status;
    return stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode);
}

bool folder_is_there(const std::string &path)
{
    struct stat status;
    return stat(path.c_str(), &status) == 0 && S_ISDIR(status.st_mode);
}

bool leads_up(const std::string &name)
{
    return ("/" + name + "/").find("/../") != std::string::npos;
}

std::string path_in(const std::string &folder, const std::string &name)
{
    return folder.empty() || folder.back() == '/' ? folder + name : folder + "/" + name;
}

std::vector<std::string> names_in_folder(const std::string &folder)
{
    const std::unique_ptr<DIR, int (*)(DIR *)> open(opendir(folder.c_str()), closedir);
    if (!open)
    {
        fail_system(folder, "cannot be read");
    }
    std::vector<std::string> names;
    errno = 0;
    while (const dirent *const entry = readdir(open.get()))
    {
        const std::string name = entry->d_name;
        if (name != "." && name != "..")
        {
            names.push_back(name);
        }
        errno = 0;
    }
    if (errno != 0)
    {
        fail_system(folder, "cannot be read");
    }
    return names;
}

std::string read_whole(const std::string &path, std::uint64_t most)
{
    const auto close = [](std::FILE *file) { std::fclose(file); };
    const std::unique_ptr<std::FILE, decltype(close)> file(std::fopen(path.c_str(), "rb"), close);
    struct stat status;
    if (!file || fstat(fileno(file.get()), &status) != 0)
    {
        fail_system(path, "cannot be read");
    }
    if (S_ISDIR(status.st_mode))
    {
        fail_file(path, "is a folder, not a file", CM_ERROR_FILE);
    }
    std::string bytes;
    std::array<char, 65536> part;
    std::size_t count = 0;
    while ((count = std::fread(part.data(), 1, part.size(), file.get())) > 0)
    {
        bytes.append(part.data(), count);
        if (bytes.size() > most)
        {
            fail_file(path, "has more than " + std::to_string(most) + " bytes");
        }
    }
    if (std::ferror(file.get()))
    {
        fail_system(path, "cannot be read");
    }
    return bytes;
}

namespace
{

// A file under another name in the same folder, which goes away if it does not appear.
class NewFile
{
public:
    explicit NewFile(const std::string &path) : target(path)
    {
        static std::atomic<unsigned> number{0};
        const std::size_t slash = path.find_last_of('/');
        const std::string folder = slash == std::string::npos ? "" : path.substr(0, slash + 1);
        for (int attempt = 0; descriptor < 0; ++attempt)
        {
            temporary = folder + own_temporary_name(static_cast<int>(1000 + number++ % 9000), "");
            descriptor = make_temporary_file(temporary, 0666);
            if (descriptor < 0 && (errno != EEXIST || attempt == 9000))
            {
                fail_system(path, "cannot be written");
            }
        }
    }
    ~NewFile()
    {
        if (descriptor >= 0)
        {
            close(descriptor);
        }
        if (!target.empty())
        {
            unlink(temporary.c_str());
        }
    }
    NewFile(const NewFile &) = delete;
    NewFile &operator=(const NewFile &) = delete;

    void write(std::string_view bytes)
    {
        while (!bytes.empty())
        {
            const ssize_t count = ::write(descriptor, bytes.data(), bytes.size());
            if (count < 0 && errno == EINTR)
            {
                continue;
            }
            if (count < 0)
            {
                fail_system(target, "cannot be written");
            }
            bytes.remove_prefix(static_cast<std::size_t>(count));
        }
    }
    void appear()
    {
        if (fsync(descriptor) != 0 && errno != EINVAL)
        {
            fail_system(target, "cannot be written");
        }
        if (std::rename(temporary.c_str(), target.c_str()) != 0)
        {
            fail_system(target, "cannot be written");
        }
        target.clear();
    }

private:
    std::string target;
    std::string temporary;
    int descriptor = -1;
};

} // namespace

void write_whole(const std::string &path, std::string_view bytes)
{
    NewFile file(path);
    file.write(bytes);
    file.appear();
}

void sync_folder(const std::string &folder)
{
    const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor >= 0)
    {
        fsync(descriptor);
        close(descriptor);
    }
}
