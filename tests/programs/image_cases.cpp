// SPDX-License-Identifier: MIT
//
// image_cases ROOT [SUBJECT...]: tests the image programs as functions of this process. ROOT is the
// top of the source tree; a subject is the name of a program or of one of its groups of cases
// (without them, all). The exit status is 1 if a case fails, or if there is none.

#include "image_cases.hpp"

#include "tools/colormap/colormap_main.h"
#include "tools/compare/compare_main.h"
#include "tools/distortion/distortion_main.h"
#include "tools/octree/octree_main.h"
#include "tools/orient/orient_main.h"
#include "tools/reproject/reproject_main.h"
#include "tools/tof/tof_main.h"
#ifdef HAVE_SCENE
#include "tools/scene/scene_main.h"
#endif

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <set>
#include <sstream>

#include <regex.h>
#include <sys/resource.h>
#include <unistd.h>

// Sanitizers have it: where their report goes.
extern "C" __attribute__((weak)) void __sanitizer_set_report_fd(void *);

namespace
{

using Program = int (*)(int, char **, const cm_streams *);

const std::map<std::string, Program> programs = {{"colormap", cm_colormap_main},
                                                 {"compare", cm_compare_main},
                                                 {"distortion", cm_distortion_main},
                                                 {"orient", cm_orient_main},
#ifdef HAVE_SCENE
                                                 {"octree", cm_octree_main},
                                                 {"scene", cm_scene_main},
#endif
#ifdef HAVE_TOF
                                                 {"tof", cm_tof_main},
#endif
                                                 {"reproject", cm_reproject_main}};

int cases = 0;
int failures = 0;
std::string root;
std::FILE *report = nullptr;
rlim_t largest_file = RLIM_INFINITY;

[[noreturn]] void give_up(const std::string &what)
{
    std::fprintf(report == nullptr ? stderr : report, "image_cases: %s\n", what.c_str());
    std::exit(EXIT_FAILURE);
}

// What is written to a descriptor of the process, whoever does it, goes to a file without a name.
class CaughtDescriptor
{
public:
    explicit CaughtDescriptor(int descriptor) : number(descriptor), file(std::tmpfile())
    {
        if (file == nullptr || dup2(fileno(file), number) != number)
        {
            give_up("no file for what the process writes");
        }
    }

    // What was written since the last call.
    std::string take()
    {
        std::string text;
        const off_t size = lseek(number, 0, SEEK_END);
        if (size > 0)
        {
            text.resize(static_cast<std::size_t>(size));
            const ssize_t count = pread(number, text.data(), text.size(), 0);
            text.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
            if (ftruncate(number, 0) != 0 || lseek(number, 0, SEEK_SET) != 0)
            {
                give_up("cannot empty a file");
            }
        }
        return text;
    }

private:
    int number;
    std::FILE *file;
};

CaughtDescriptor &caught(int descriptor)
{
    static CaughtDescriptor out(STDOUT_FILENO);
    static CaughtDescriptor err(STDERR_FILENO);
    return descriptor == STDOUT_FILENO ? out : err;
}

// From now on only result() writes to standard output.
void keep_own_output()
{
    report = fdopen(dup(STDOUT_FILENO), "w");
    if (report == nullptr)
    {
        give_up("no standard output");
    }
    if (__sanitizer_set_report_fd != nullptr)
    {
        const long number = dup(STDERR_FILENO);
        __sanitizer_set_report_fd(reinterpret_cast<void *>(number));
    }
    caught(STDOUT_FILENO);
}

class TextStream
{
public:
    TextStream() : stream(open_memstream(&text, &size))
    {
        if (stream == nullptr)
        {
            give_up("no memory");
        }
    }
    ~TextStream()
    {
        std::fclose(stream);
        std::free(text);
    }
    TextStream(const TextStream &) = delete;
    TextStream &operator=(const TextStream &) = delete;

    std::FILE *file() const
    {
        return stream;
    }
    std::string content() const
    {
        std::fflush(stream);
        return std::string(text, size);
    }

private:
    char *text = nullptr;
    std::size_t size = 0;
    std::FILE *stream;
};

void limit_files(rlim_t bytes)
{
    rlimit limit;
    getrlimit(RLIMIT_FSIZE, &limit);
    limit.rlim_cur = bytes < limit.rlim_max ? bytes : limit.rlim_max;
    setrlimit(RLIMIT_FSIZE, &limit);
}

std::string gdal_library;

// A library that was opened stays: until a subject asks for it there is none.
void set_aside_gdal()
{
    const char *const named = std::getenv("CUBEMAP_IMAGE_GDAL");
    gdal_library = named == nullptr ? "" : named;
    setenv("CUBEMAP_IMAGE_GDAL", "/none", 1);
}

bool is_one_line(const std::string &text)
{
    return std::count(text.begin(), text.end(), '\n') == 1 && text.back() == '\n';
}

void run_subject(const Subject &subject, const std::filesystem::path &folder)
{
    const std::filesystem::path own = folder / subject.name;
    std::filesystem::create_directory(own);
    std::filesystem::current_path(own);
    try
    {
        subject.run();
    }
    catch (const std::exception &exception)
    {
        result(false, subject.name, exception.what());
    }
    std::filesystem::current_path(folder);
    std::filesystem::remove_all(own);
}

// All subjects of the programs and the groups that are named; all if none is.
std::vector<Subject> chosen_subjects(std::set<std::string> names)
{
    const std::map<std::string, const std::vector<Subject> &> all = {
        {"compare", compare_subjects()},
        {"reproject", reproject_subjects()},
        {"charts", reproject_chart_subjects()},
        {"pixels", reproject_pixel_subjects()},
        {"mistakes", reproject_mistake_subjects()},
        {"surfaces", reproject_surface_subjects()},
        {"tags", reproject_tag_subjects()},
        {"rasters", reproject_raster_subjects()},
        {"outputs", reproject_output_subjects()},
        {"tiles", reproject_tile_subjects()},
        {"streams", reproject_stream_subjects()},
        {"memory", reproject_memory_subjects()},
        {"distortion", distortion_subjects()},
        {"orient", orient_subjects()},
#ifdef HAVE_SCENE
        {"octree", octree_subjects()},
        {"octree runs", octree_run_subjects()},
        {"scene", scene_subjects()},
        {"scene motion", scene_motion_subjects()},
        {"scene refusals", scene_refusal_subjects()},
#endif
#ifdef HAVE_TOF
        {"tof", tof_subjects()},
        {"tof refusals", tof_refusal_subjects()},
        {"tof surroundings", tof_environment_subjects()},
        {"tof measures", tof_evaluate_subjects()},
#endif
        {"colormap", colormap_subjects()}};
    const bool every = names.empty();
    std::vector<Subject> chosen;
    for (const auto &[program, subjects] : all)
    {
        const bool whole = every || names.erase(program) == 1;
        for (const Subject &subject : subjects)
        {
            if (names.erase(subject.name) == 1 || whole)
            {
                chosen.push_back(subject);
            }
        }
    }
    if (!names.empty())
    {
        give_up("there is no subject " + *names.begin());
    }
    return chosen;
}

} // namespace

bool open_gdal()
{
    if (!gdal_library.empty())
    {
        setenv("CUBEMAP_IMAGE_GDAL", gdal_library.c_str(), 1);
    }
    return !gdal_library.empty();
}

Words words_of(const std::string &line)
{
    Words words;
    bool inside = false;
    bool quoted = false;
    for (const char letter : line)
    {
        if (letter == '\'')
        {
            quoted = !quoted;
        }
        const bool blank = letter == ' ' && !quoted;
        if (!blank && !inside)
        {
            words.emplace_back();
        }
        inside = !blank;
        if (!blank && letter != '\'')
        {
            words.back() += letter;
        }
    }
    return words;
}

SizeLimit::SizeLimit(unsigned bytes)
{
    largest_file = bytes;
}

SizeLimit::~SizeLimit()
{
    largest_file = RLIM_INFINITY;
}

namespace
{

Ran run_between(const Words &words, std::FILE *in, std::FILE *given_out)
{
    const auto program = programs.find(words.front());
    if (program == programs.end())
    {
        give_up("there is no program " + words.front());
    }
    Words copies = words;
    copies.front() = "cubemap-" + words.front();
    std::vector<char *> arguments;
    for (std::string &copy : copies)
    {
        arguments.push_back(copy.data());
    }
    arguments.push_back(nullptr);
    TextStream out;
    TextStream err;
    const cm_streams streams = {in, given_out != nullptr ? given_out : out.file(), err.file()};
    Ran ran;
    limit_files(largest_file);
    ran.status = program->second(static_cast<int>(words.size()), arguments.data(), &streams);
    limit_files(RLIM_INFINITY);
    std::fflush(stdout);
    std::fflush(stderr);
    ran.out = out.content() + caught(STDOUT_FILENO).take();
    ran.err = err.content() + caught(STDERR_FILENO).take();
    return ran;
}

} // namespace

Ran run(const Words &words)
{
    return run_between(words, stdin, nullptr);
}

Ran run_with_input(const std::string &input, const std::string &line, std::FILE *out)
{
    std::FILE *const in = std::tmpfile();
    if (in == nullptr || std::fwrite(input.data(), 1, input.size(), in) != input.size())
    {
        give_up("no file for standard input");
    }
    std::rewind(in);
    const Ran ran = run_between(words_of(line), in, out);
    std::fclose(in);
    return ran;
}

Ran run(const std::string &line)
{
    return run(words_of(line));
}

void result(bool good, const std::string &name, const std::string &seen)
{
    ++cases;
    failures += good ? 0 : 1;
    std::fprintf(report, "%s %d - %s\n", good ? "ok" : "not ok", cases, name.c_str());
    std::istringstream lines(good ? "" : seen);
    for (std::string line; std::getline(lines, line);)
    {
        std::fprintf(report, "# %s\n", line.c_str());
    }
    std::fflush(report);
}

void holds(const std::string &name, const std::function<void()> &check)
{
    std::string wrong;
    try
    {
        check();
    }
    catch (const std::exception &exception)
    {
        wrong = exception.what();
    }
    result(wrong.empty(), name, wrong);
}

Ran passes(const std::string &name, const std::string &line)
{
    const Ran ran = run(line);
    result(ran.status == 0 && ran.err.empty(), name,
           line + "\nstatus " + std::to_string(ran.status) + "\n" + ran.out + ran.err);
    return ran;
}

void fails(const std::string &name, int status, const std::string &expression, const Words &words)
{
    std::filesystem::create_directory("made");
    const Ran ran = run(words);
    const std::string left = names_in("made");
    const bool good = ran.status == status && is_one_line(ran.err) && ran.out.empty() &&
                      matches(ran.err, "^cubemap-" + words.front() + ": .*(" + expression + ")") &&
                      left.empty();
    result(good, name,
           "status " + std::to_string(ran.status) + "\n" + ran.out + ran.err + "left: " + left);
    std::filesystem::remove_all("made");
}

void fails(const std::string &name, int status, const std::string &expression,
           const std::string &line)
{
    fails(name, status, expression, words_of(line));
}

Ran does(const std::string &line)
{
    const Ran ran = run(line);
    if (ran.status != 0 || !ran.err.empty())
    {
        result(false, line, "status " + std::to_string(ran.status) + "\n" + ran.err);
    }
    return ran;
}

void says(const std::string &name, const std::string &expression, const std::string &line)
{
    const Ran ran = does(line);
    result(matches(ran.out, expression) && ran.err.empty(), name, ran.out + ran.err);
}

bool matches(const std::string &text, const std::string &extended_regular_expression)
{
    regex_t compiled;
    if (regcomp(&compiled, extended_regular_expression.c_str(),
                REG_EXTENDED | REG_NOSUB | REG_NEWLINE) != 0)
    {
        give_up("not a regular expression: " + extended_regular_expression);
    }
    const bool found = regexec(&compiled, text.c_str(), 0, nullptr, 0) == 0;
    regfree(&compiled);
    return found;
}

bool is_sanitized()
{
    return __sanitizer_set_report_fd != nullptr;
}

std::string content_of(const std::string &name)
{
    std::ifstream file(name, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
}

void write_file(const std::string &name, const std::string &content)
{
    std::ofstream file(name, std::ios::binary);
    if (!file.write(content.data(), static_cast<std::streamsize>(content.size())).flush())
    {
        give_up(name + " cannot be written");
    }
}

bool same_content(const std::string &one, const std::string &other)
{
    const std::string content = content_of(one);
    return !content.empty() && content == content_of(other);
}

std::string names_in(const std::string &folder)
{
    std::set<std::string> names;
    for (const auto &entry : std::filesystem::directory_iterator(folder))
    {
        names.insert(entry.path().filename().string());
    }
    std::string text;
    for (const std::string &name : names)
    {
        text += name + " ";
    }
    return text;
}

void make_noise(int width, int height, const std::string &name)
{
    std::mt19937 generator(1);
    std::string content = "P6 " + std::to_string(width) + " " + std::to_string(height) + " 255\n";
    for (int i = 0; i < 3 * width * height; ++i)
    {
        content += static_cast<char>(generator() % 256);
    }
    write_file(name, content);
}

void make_turned(const std::string &noise, int width, int height, const std::string &name)
{
    const std::string whole = content_of(noise);
    const std::size_t size = 3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    const std::size_t head = whole.size() - size;
    std::string turned = whole.substr(0, head);
    for (std::size_t i = size; i > 0; i -= 3)
    {
        turned += whole.substr(head + i - 3, 3);
    }
    write_file(name, turned);
}

const std::string &source_tree()
{
    return root;
}

int one_in(int many)
{
    return std::getenv("CUBEMAP_QUICK_TESTS") != nullptr ? many : 1;
}

int main(int argc, char **argv)
{
    keep_own_output();
    if (argc < 2)
    {
        give_up("usage: image_cases ROOT [SUBJECT...]");
    }
    root = std::filesystem::canonical(argv[1]).string();
    set_aside_gdal();
    std::signal(SIGXFSZ, SIG_IGN); // as the programs' own start has it
    std::string name = (std::filesystem::temp_directory_path() / "cubemap-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr)
    {
        give_up("no folder " + name);
    }
    const std::filesystem::path folder = std::filesystem::canonical(name);
    for (const Subject &subject : chosen_subjects({argv + 2, argv + argc}))
    {
        run_subject(subject, folder);
    }
    std::filesystem::current_path("/");
    std::filesystem::remove_all(folder);
    std::fprintf(report, "%d cases, %d failed\n", cases, failures);
    return cases > 0 && failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
