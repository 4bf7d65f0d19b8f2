// SPDX-License-Identifier: MIT

#include "mesh_file.h"

#include "file_failure.hpp"
#include "flat_mesh.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <new>

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#if defined(__linux__)
#include <sys/prctl.h>
#endif

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define SANITIZED 1
#endif
#endif
#ifndef SANITIZED
#define SANITIZED 0 // sanitizers take terabytes of addresses
#endif

namespace
{

using Reader = FlatMesh (*)(const std::string &);
using Clock = std::chrono::steady_clock;

constexpr std::uint64_t standard_memory = std::uint64_t{4} << 30;
constexpr unsigned standard_seconds = 60;

// What goes before the arrays, from child to parent.
struct Heading
{
    std::uint64_t mark; // of a mesh, or of a message
    std::uint64_t vertices;
    std::uint64_t triangles;
};
constexpr std::uint64_t mesh_mark = 0x6873656d2d6d6301u;
constexpr std::uint64_t message_mark = 0x6873656d2d6d6302u;

// ---- the child

void limit(decltype(RLIMIT_AS) what, rlim_t most)
{
    rlimit limits;
    if (getrlimit(what, &limits) == 0)
    {
        limits.rlim_cur = std::min(most, limits.rlim_max);
        limits.rlim_max = what == RLIMIT_CPU ? limits.rlim_max : limits.rlim_cur;
        setrlimit(what, &limits);
    }
}

// What the process has already, where the system tells.
std::uint64_t addresses_in_use()
{
    unsigned long pages = 0;
    std::FILE *const file = std::fopen("/proc/self/statm", "r");
    if (file != nullptr)
    {
        pages = std::fscanf(file, "%lu", &pages) == 1 ? pages : 0;
        std::fclose(file);
    }
    return pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

void confine(std::uint64_t memory, unsigned seconds)
{
    for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU, SIGPIPE, SIGSEGV, SIGABRT})
    {
        std::signal(number, SIG_DFL); // what a program does then is not for its child
    }
#if defined(__linux__)
    prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
    const int nowhere = open("/dev/null", O_WRONLY);
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
    limit(RLIMIT_CPU, seconds);
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_FSIZE, 0);
    if (!SANITIZED)
    {
        limit(RLIMIT_AS, addresses_in_use() + memory);
    }
}

bool send(int to, const void *bytes, std::size_t size)
{
    const char *at = static_cast<const char *>(bytes);
    while (size > 0)
    {
        const ssize_t count = write(to, at, size);
        if (count < 0 && errno != EINTR)
        {
            return false;
        }
        at += std::max<ssize_t>(count, 0);
        size -= static_cast<std::size_t>(std::max<ssize_t>(count, 0));
    }
    return true;
}

template <typename Value> bool send(int to, const std::vector<Value> &values)
{
    return send(to, values.data(), values.size() * sizeof(Value));
}

void send_message(int to, const char *text)
{
    const Heading heading = {message_mark, 0, 0};
    send(to, &heading, sizeof heading);
    send(to, text, std::strlen(text));
}

void work_as_child(Reader reader, const char *path, int to)
{
    try
    {
        const FlatMesh mesh = reader(path);
        const Heading heading = {mesh_mark, mesh.position.size() / 3, mesh.index.size() / 3};
        send(to, &heading, sizeof heading) && send(to, mesh.position) && send(to, mesh.color) &&
            send(to, mesh.index);
    }
    catch (const std::bad_alloc &)
    {
        send_message(to, "needs more memory than a mesh may");
    }
    catch (const std::exception &exception)
    {
        send_message(to, exception.what());
    }
}

// ---- the parent

// What is wrong with the file, whose name comes before it in the end.
class MeshRefusal : public std::runtime_error
{
public:
    MeshRefusal(cm_status what, const std::string &text) : std::runtime_error(text), number(what)
    {
    }
    cm_status status() const noexcept
    {
        return number;
    }

private:
    cm_status number;
};

// All that a child says, up to its end or the limit.
class Listener
{
public:
    Listener(int descriptor, std::uint64_t most, std::uint64_t seconds)
        : from(descriptor), room(most), end(Clock::now() + std::chrono::seconds(seconds))
    {
    }

    void listen(std::vector<char> &said) const
    {
        char piece[65536];
        while (true)
        {
            wait();
            const ssize_t count = read(from, piece, sizeof piece);
            if (count == 0)
            {
                return;
            }
            if (count < 0 && errno != EINTR)
            {
                throw MeshRefusal(CM_ERROR_FILE, "the child that reads it cannot be heard");
            }
            if (count > 0)
            {
                said.insert(said.end(), piece, piece + count);
            }
            if (said.size() > room)
            {
                throw MeshRefusal(CM_ERROR_DATA, "needs more memory than a mesh may");
            }
        }
    }

private:
    // Piece by piece: signals interrupt it, and milliseconds of 32 bits end after 24 days.
    void wait() const
    {
        constexpr long long piece = 60000;
        pollfd waiting = {from, POLLIN, 0};
        int ready = 0;
        while (ready == 0 || (ready < 0 && errno == EINTR))
        {
            const long long left =
                std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
            if (left <= 0)
            {
                throw MeshRefusal(CM_ERROR_DATA, "takes longer than a mesh may");
            }
            ready = poll(&waiting, 1, static_cast<int>(std::min(left, piece)));
        }
    }

    int from;
    std::uint64_t room;
    Clock::time_point end;
};

// A child that reads a file; it is gone when this is.
class Child
{
public:
    Child(Reader reader, const char *path, std::uint64_t memory, unsigned seconds)
    {
        int ends[2];
        if (pipe(ends) != 0)
        {
            throw MeshRefusal(CM_ERROR_FILE, "there is no pipe to a child that would read it");
        }
        number = fork();
        if (number == 0)
        {
            close(ends[0]);
            confine(memory, seconds);
            work_as_child(reader, path, ends[1]);
            _exit(0);
        }
        close(ends[1]);
        out = ends[0];
        if (number < 0)
        {
            close(out);
            throw MeshRefusal(CM_ERROR_FILE, "there is no child that would read it");
        }
    }
    ~Child()
    {
        if (number > 0)
        {
            kill(number, SIGKILL);
            wait();
        }
        close(out);
    }
    Child(const Child &) = delete;
    Child &operator=(const Child &) = delete;

    int descriptor() const
    {
        return out;
    }

    // Its end, as waitpid tells.
    int wait()
    {
        int status = 0;
        while (waitpid(number, &status, 0) < 0 && errno == EINTR)
        {
        }
        number = -1;
        return status;
    }

private:
    pid_t number = -1;
    int out = -1;
};

void check_end(int status)
{
    if (WIFSIGNALED(status))
    {
        throw MeshRefusal(CM_ERROR_DATA, WTERMSIG(status) == SIGXCPU
                                             ? std::string("takes longer than a mesh may")
                                             : "crashes its reader with signal " +
                                                   std::to_string(WTERMSIG(status)));
    }
    if (WEXITSTATUS(status) != 0)
    {
        throw MeshRefusal(CM_ERROR_DATA, "ends its reader");
    }
}

// The arrays of a mesh, where as many bytes were said as its heading promises. A message is thrown.
FlatMesh arrays_of(const std::vector<char> &said)
{
    Heading heading;
    if (said.size() < sizeof heading)
    {
        throw MeshRefusal(CM_ERROR_DATA, "ends its reader");
    }
    std::memcpy(&heading, said.data(), sizeof heading);
    const char *at = said.data() + sizeof heading;
    const std::size_t size = said.size() - sizeof heading;
    if (heading.mark == message_mark)
    {
        throw MeshRefusal(CM_ERROR_DATA, std::string(at, size));
    }
    constexpr std::size_t a_vertex = 3 * (sizeof(double) + sizeof(float));
    constexpr std::size_t a_triangle = 3 * sizeof(std::uint32_t);
    if (heading.mark != mesh_mark || heading.vertices > size / a_vertex ||
        heading.triangles > size / a_triangle ||
        heading.vertices * a_vertex + heading.triangles * a_triangle != size)
    {
        throw MeshRefusal(CM_ERROR_DATA, "ends its reader");
    }
    FlatMesh flat;
    const auto take = [&at](auto &values, std::size_t count)
    {
        values.resize(count);
        const std::size_t bytes = count * sizeof values[0];
        if (bytes > 0)
        {
            std::memcpy(values.data(), at, bytes);
            at += bytes;
        }
    };
    take(flat.position, 3 * heading.vertices);
    take(flat.color, 3 * heading.vertices);
    take(flat.index, 3 * heading.triangles);
    return flat;
}

// Nothing that was said is believed.
cm_mesh *mesh_of(const std::vector<char> &said)
{
    const FlatMesh flat = arrays_of(said);
    cm_mesh_options options = {};
    options.size = sizeof options;
    options.vertex_count = flat.position.size() / 3;
    options.position = flat.position.data();
    options.color = flat.color.data();
    options.triangle_count = flat.index.size() / 3;
    options.index = flat.index.data();
    options.material = {{1, 1, 1}, 1};
    cm_mesh *mesh = nullptr;
    const cm_status status = cm_mesh_create(&options, &mesh);
    if (status != CM_OK)
    {
        throw MeshRefusal(status == CM_ERROR_MEMORY ? status : CM_ERROR_DATA,
                          status == CM_ERROR_MEMORY ? "needs more memory than there is"
                          : status == CM_ERROR_RANGE
                              ? "has coordinates or colours that are no numbers"
                              : "has an index that is out of range");
    }
    return mesh;
}

Reader reader_of(const std::string &path)
{
    const std::size_t dot = path.rfind('.');
    std::string ending = dot == std::string::npos ? "" : path.substr(dot);
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
#ifdef HAVE_TINYGLTF
    if (ending == ".gltf" || ending == ".glb")
    {
        return read_gltf;
    }
#endif
#ifdef HAVE_TINYOBJ
    if (ending == ".obj")
    {
        return read_obj;
    }
#endif
    throw MeshRefusal(CM_ERROR_UNSUPPORTED,
                      ending == ".gltf" || ending == ".glb" || ending == ".obj"
                          ? "this build reads no such meshes"
                          : "is no mesh that is read: .gltf, .glb or .obj");
}

// Of what a reader says, the first line, without a full stop. It begins with ":LINE: " where a line is wrong.
std::string first_words(const std::string &text)
{
    const std::string line = text.substr(0, text.find('\n'));
    return line.substr(0, line.find_last_not_of(". \r") + 1);
}

cm_mesh *read_mesh(const char *path, const cm_mesh_limits &limits)
{
    const Reader reader = reader_of(path);
    struct stat told;
    if (stat(path, &told) != 0)
    {
        throw MeshRefusal(CM_ERROR_FILE, std::string("cannot be opened: ") + std::strerror(errno));
    }
    if (!S_ISREG(told.st_mode))
    {
        throw MeshRefusal(CM_ERROR_FILE, "is no file");
    }
    const std::uint64_t memory = limits.memory == 0 ? standard_memory : limits.memory;
    const unsigned seconds = limits.seconds == 0 ? standard_seconds : limits.seconds;
    std::vector<char> said;
    Child child(reader, path, memory, seconds);
    Listener(child.descriptor(), memory, std::uint64_t{2} * seconds).listen(said);
    check_end(child.wait());
    return mesh_of(said);
}

} // namespace

cm_status cm_mesh_file_read(const char *path, const cm_mesh_limits *limits, cm_mesh **mesh,
                            char *message)
{
    if (path == nullptr || mesh == nullptr || message == nullptr ||
        (limits != nullptr && limits->size != sizeof *limits))
    {
        return CM_ERROR_ARGUMENT;
    }
    return guarded_file(
        message,
        [&]
        {
            try
            {
                *mesh = read_mesh(path, limits == nullptr ? cm_mesh_limits{} : *limits);
            }
            catch (const MeshRefusal &refusal)
            {
                const std::string what = first_words(refusal.what());
                throw FileFailure(refusal.status(), path + (what[0] == ':' ? what : ": " + what));
            }
        });
}
