// SPDX-License-Identifier: MIT
//
// The files of cubemap-octree integrate: whose they are while a run writes them, what their names are, and what a run that
// ended too early leaves of them; and maps that are damaged.

#include "image_cases.hpp"

#include <cstring>
#include <filesystem>
#include <functional>
#include <stdexcept>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace
{

// Called before a file is renamed, with its name.
std::function<void(const std::string &)> before_rename;

// A file that somebody else has, while it lives; or has not, if that is so already.
class Held
{
public:
    explicit Held(const std::string &name) : file(open(name.c_str(), O_RDWR | O_CLOEXEC))
    {
        is_held = file >= 0 && flock(file, LOCK_EX | LOCK_NB) == 0;
    }
    ~Held()
    {
        if (file >= 0)
        {
            close(file);
        }
    }
    Held(const Held &) = delete;
    Held &operator=(const Held &) = delete;
    bool is_had() const
    {
        return is_held;
    }

private:
    int file;
    bool is_held = false;
};

// The room as four views of 48 x 36 pixels.
void make_small_room()
{
    write_file("camera.json",
               "{\"width\":48,\"height\":36,\"fx\":24,\"fy\":24,\"cx\":23.5,\"cy\":17.5}");
    write_file("path.txt", "1.0 0 0 1.2 -0.5 0.5 -0.5 0.5\n1.1 0 0 1.2 -0.7071068 0 0 0.7071068\n"
                           "1.2 0 0 1.2 -0.5 -0.5 0.5 0.5\n1.3 0 0 1.2 0 -0.7071068 0.7071068 0\n");
    does("scene render room camera.json path.txt -o room --quiet");
    std::filesystem::create_directory("made");
}

std::string integrated(const std::string &map, const std::string &edge)
{
    return "octree integrate room --edge " + edge + " --save-every 1 -o " + map;
}

// A run that ends at its third view.
Ran interrupted(const std::string &command)
{
    const std::string broken = "room/depth/1.200000.png";
    const std::string good = content_of(broken);
    write_file(broken, good.substr(0, good.size() / 2));
    Ran ran = run(command + " --quiet");
    write_file(broken, good);
    return ran;
}

void takes_files()
{
    make_small_room();
    does(integrated("a.map", "0.2") + " --quiet");
    const std::string old = content_of("a.map");
    interrupted(integrated("a.map", "0.1"));
    const std::string begun = content_of("a.map.unfinished");
    {
        const Held held("a.map.unfinished");
        fails("a file beside that another run has", 1, "a.map.unfinished' is in use",
              integrated("a.map", "0.1"));
        fails("and for another command", 1, "a.map.unfinished' is in use",
              integrated("a.map", "0.4"));
        result(content_of("a.map.unfinished") == begun, "it stays as it is");
    }
    {
        const Held held("a.map");
        fails("a map that another run has", 1, "a.map' is in use", integrated("a.map", "0.1"));
        result(content_of("a.map") == old, "it stays as it is, too");
    }
    std::string renamed;
    bool was_had = false, old_was_had = false;
    before_rename = [&](const std::string &name)
    {
        renamed = name;
        was_had = Held(name).is_had();
        old_was_had = Held("a.map").is_had();
    };
    says("then the run goes on", "\"resumed_at\": 2", integrated("a.map", "0.1") + " --json");
    before_rename = nullptr;
    result(matches(renamed, "a.map.unfinished$"), "the new map takes the place of the old one",
           renamed);
    result(!was_had, "nobody can take the new map before it has come to its place");
    result(!old_was_had, "nor the old one");
    result(Held("a.map").is_had(), "and then anybody can");
}

void names_files()
{
    make_small_room();
    // 120 letters of two bytes, and what is needed
    std::string letters;
    for (int i = 0; i < 118; ++i)
    {
        letters += "\xc3\xa4";
    }
    for (const std::size_t more : {0u, 1u, 2u, 3u, 10u, 11u})
    {
        const std::string name = letters + std::string(more, 'b'),
                          bytes = std::to_string(name.size());
        does(integrated(name, "0.4") + " --quiet");
        const std::string old = content_of(name);
        const Ran ended = interrupted(integrated(name, "0.2"));
        result(ended.status == 1 && content_of(name) == old,
               "a name of " + bytes + " bytes: the old map stays", ended.err);
        const std::string beside = name + ".unfinished";
        const std::string expected =
            more == 0 ? "^" + beside + " $" : "~[0-9a-f]{16}\\.unfinished $";
        std::string names;
        for (const auto &entry : std::filesystem::directory_iterator("."))
        {
            const std::string each = entry.path().filename().string();
            names += matches(each, "unfinished$") ? each + " " : "";
        }
        result(matches(names, expected), "what was committed is beside it", names);
        says("the same command goes on", "\"resumed_at\": 2", integrated(name, "0.2") + " --json");
        result(content_of(name) != old, "and the new map comes to its place");
    }
    const std::string long_name(247, 'a');
    const std::string other = std::string(246, 'a') + "b";
    for (const std::string &name : {long_name, other})
    {
        does(integrated(name, "0.4") + " --quiet");
        interrupted(integrated(name, "0.2"));
    }
    for (const std::string &name : {long_name, other})
    {
        says("names with one beginning have files of their own", "\"resumed_at\": 2",
             integrated(name, "0.2") + " --json");
    }
}

void begins_anew()
{
    make_small_room();
    does(integrated("a.map", "0.2") + " --quiet");
    const std::string old = content_of("a.map");
    write_file("a.map.unfinished", "");
    const Ran ended = run(integrated("a.map", "0.1") + " --camera absent.json");
    result(ended.status == 1 && content_of("a.map") == old, "an empty file beside is no map");
    const Ran ran = run(integrated("a.map", "0.1") + " --json");
    result(ran.status == 0 && matches(ran.out, "\"views\": 4, .*\"resumed_at\": 0") &&
               matches(ran.err, "^cubemap-octree: '.*a.map.unfinished' is empty, since a run ended "
                                "before it kept anything; it begins anew\n$"),
           "a run begins anew with it, and says so", ran.out + ran.err);
    result(!std::filesystem::exists("a.map.unfinished") && content_of("a.map") != old,
           "and the new map comes to its place");
    write_file("a.map.unfinished", "");
    const Ran quiet = run(integrated("a.map", "0.3") + " --quiet");
    result(quiet.status == 0 && quiet.err.empty(), "--quiet says nothing of it", quiet.err);
    {
        const SizeLimit limit(4096);
        fails("no room for the first commit", 1, "cannot be read or written",
              integrated("made/x", "0.1"));
        does("octree info a.map");
        const std::string before = content_of("a.map");
        const Ran full = run(integrated("a.map", "0.1") + " --quiet");
        result(full.status == 1 && content_of("a.map") == before &&
                   !std::filesystem::exists("a.map.unfinished"),
               "beside an old map it leaves nothing either", full.err);
    }
    passes("and the next run has room", integrated("a.map", "0.1") + " --quiet");
    std::filesystem::create_symlink("nowhere", "link.map");
    fails("a link to nothing", 1, "link.map' is a link to what is not there",
          integrated("link.map", "0.1"));
}

std::string big_endian(std::uint32_t number)
{
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8)
    {
        bytes.push_back(static_cast<char>(number >> shift & 255));
    }
    return bytes;
}

// What SQLite has in a journal while it commits: all pages of a database as they were (sqlite.org/fileformat2.html, 3).
std::string journal_of(const std::string &database)
{
    const auto byte = [&database](std::size_t at)
    { return static_cast<std::uint32_t>(static_cast<unsigned char>(database[at])); };
    const std::uint32_t size = byte(16) << 8 | byte(17), sector = 512, nonce = 7;
    const auto pages = static_cast<std::uint32_t>(database.size() / size);
    std::string journal = "\xd9\xd5\x05\xf9\x20\xa1\x63\xd7" + big_endian(pages) +
                          big_endian(nonce) + big_endian(pages) + big_endian(sector) +
                          big_endian(size);
    journal.resize(sector);
    for (std::uint32_t page = 0; page < pages; ++page)
    {
        std::uint32_t sum = nonce;
        for (std::uint32_t at = size - 200; at < size && at > 0; at -= 200)
        {
            sum += byte(std::size_t{page} * size + at);
        }
        journal += big_endian(page + 1) + database.substr(std::size_t{page} * size, size) +
                   big_endian(sum);
    }
    return journal;
}

// A journal of the map that was there would be put into the new one.
void replaces_ended_runs()
{
    make_small_room();
    does(integrated("a.map", "0.2") + " --quiet");
    does(integrated("b.map", "0.1") + " --quiet");
    const std::string old = content_of("a.map"), journal = journal_of(old);
    write_file("a.map", std::string(old.size(), 'x'));
    write_file("a.map-journal", journal);
    does("octree info a.map");
    result(content_of("a.map") == old, "a journal is what a run that was killed leaves");
    for (const std::string how : {"merge b.map b.map", "hull room --edge 0.1 --levels 6"})
    {
        write_file("a.map", old);
        write_file("a.map-journal", journal);
        does("octree " + how + " -o a.map");
        says(how + " over an ended run", "\"edge\": 0.1,", "octree info a.map --json");
        std::filesystem::remove("a.map");
        write_file("a.map-journal", journal);
        does("octree " + how + " -o a.map");
        says(how + " beside its journal", "\"edge\": 0.1,", "octree info a.map --json");
    }
}

// What is read only when it is asked for is not told to be empty if it is damaged.
void tells_damage()
{
    make_small_room();
    does(integrated("a.map", "0.1") + " --quiet");
    const std::string good = content_of("a.map"), frame = "\x28\xb5\x2f\xfd"; // of zstd
    const std::string points = "1 1 1\n-1 1 1\n1 -1 1\n-1 -1 1\n1 1 -1\n9999 0 0\n",
                      rays = "0 0 1.2 1 0.1 0.1\n0 0 1.2 -1 -0.1 -0.1\n0 0 1.2 1 -9 0.1\n";
    const struct
    {
        std::string input, line;
    } asked[] = {{points, "octree query a.map --memory 1M"},
                 {points, "octree query a.map --memory 1M --level 3"},
                 {rays, "octree ray a.map --memory 1M"}};
    for (const auto &each : asked)
    {
        write_file("a.map", good);
        const Ran right = run_with_input(each.input, each.line);
        int told = 0, wrong = right.status != 0;
        for (std::size_t at = good.find(frame); at != std::string::npos;
             at = good.find(frame, at + 1))
        {
            std::string damaged = good;
            damaged[at + 20] = static_cast<char>(damaged[at + 20] ^ 1);
            write_file("a.map", damaged);
            const Ran ran = run_with_input(each.input, each.line);
            told += ran.status == 1 && matches(ran.err, "a.map': .*damaged");
            wrong += ran.status == 0 ? ran.out != right.out
                                     : right.out.compare(0, ran.out.size(), ran.out) != 0;
        }
        result(told > 0 && wrong == 0, each.line + " of a damaged map",
               std::to_string(told) + " are told, " + std::to_string(wrong) + " are not");
    }
}

} // namespace

#ifdef __GLIBC__
// What the program renames comes here first.
extern "C" int rename(const char *from, const char *to) noexcept
{
    if (before_rename)
    {
        before_rename(from);
    }
    return renameat(AT_FDCWD, from, AT_FDCWD, to);
}
#endif

const std::vector<Subject> &octree_run_subjects()
{
    static const std::vector<Subject> subjects = {
        {"files of runs", takes_files},
        {"their names", names_files},
        {"empty files", begins_anew},
        {"journals of maps that are replaced", replaces_ended_runs},
        {"damaged maps", tells_damage}};
    return subjects;
}
