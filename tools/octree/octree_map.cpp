// SPDX-License-Identifier: MIT

#include "octree_map.hpp"
#include "octree_run_file.hpp"
#include "octree_table.h"

#include "modules/octree/io/octomap_file.h"
#include "modules/scene/io/store_file.h"
#include "tools/cli/atomic_file.hpp"
#include "tools/cli/byte_size.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>

namespace
{

constexpr const char *note_begin = "cubemap-octree 1\n";

// The text behind "KEY " up to the end of its line; "" if there is none.
std::string noted(const std::string &note, const std::string &key)
{
    const std::size_t at = note.find("\n" + key + " ");
    if (at == std::string::npos)
    {
        return "";
    }
    const std::size_t begin = at + key.size() + 2;
    return note.substr(begin, note.find('\n', begin) - begin);
}

std::uint64_t noted_number(const std::string &note, const std::string &key)
{
    return std::strtoull(noted(note, key).c_str(), nullptr, 10);
}

bool is_octomap(const std::string &path)
{
    char begin[17] = "";
    const std::unique_ptr<std::FILE, int (*)(std::FILE *)> file(std::fopen(path.c_str(), "rb"),
                                                                std::fclose);
    return file != nullptr && std::fread(begin, 1, 16, file.get()) == 16 &&
           std::string(begin) == "# Octomap OcTree";
}

// What a store says of its file, without the name, which is said otherwise.
std::string without_name(const std::string &said, const std::string &name)
{
    return said.rfind(name + ": ", 0) == 0 ? said.substr(name.size() + 2) : said;
}

void check_saved(cm_status status, const std::string &path, const std::string &said)
{
    if (status == CM_ERROR_MEMORY)
    {
        throw std::bad_alloc();
    }
    if (status != CM_OK)
    {
        throw Failure(in_quotes(path) +
                      " cannot be written: " + (said.empty() ? cm_status_text(status) : said));
    }
}

// What a run that was killed while it committed left in a journal beside the name would be taken for the new map's: it goes
// back into the old map first, or away with one that is not there any more.
void settle_journal(const std::string &path)
{
    std::error_code ignored;
    const std::string map = std::filesystem::weakly_canonical(path, ignored).string();
    const std::string journal = map + "-journal";
    const std::uintmax_t bytes = std::filesystem::file_size(journal, ignored);
    if (ignored || bytes == 0)
    {
        return;
    }
    if (!std::filesystem::exists(map, ignored))
    {
        std::filesystem::remove(journal, ignored);
        return;
    }
    cm_store *old = nullptr;
    char message[CM_IMAGE_MESSAGE] = "";
    if (cm_store_file_open(map.c_str(), nullptr, &old, message) != CM_OK)
    {
        throw Failure(in_quotes(path) + " cannot be replaced while " + in_quotes(journal) +
                      " is beside it: " + without_name(message, map) + "; give another name");
    }
    cm_store_destroy(old);
}

} // namespace

std::string note_of(const OctreeRun &run)
{
    return note_begin + std::string("views ") + std::to_string(run.views) + "\nempty " +
           std::to_string(run.empty) + "\ncomplete " + (run.complete ? "1" : "0") + "\nsettings " +
           run.settings + "\n";
}

OctreeRun read_note(const cm_octree *map)
{
    std::size_t count = 0;
    const char *const bytes = static_cast<const char *>(cm_octree_user_data(map, &count));
    const std::string note(bytes == nullptr ? "" : bytes, count);
    OctreeRun run;
    if (note.rfind(note_begin, 0) == 0)
    {
        run.views = noted_number(note, "views");
        run.empty = noted_number(note, "empty");
        run.complete = noted(note, "complete") != "0";
        run.settings = noted(note, "settings");
    }
    return run;
}

void check_map(cm_status status, const std::string &what, const cm_store *store,
               const std::string &after)
{
    if (status == CM_ERROR_MEMORY)
    {
        throw std::bad_alloc();
    }
    if (status != CM_OK)
    {
        const std::string said = store == nullptr ? "" : cm_store_message(store);
        const std::string name = what.size() > 2 ? what.substr(1, what.size() - 2) : what;
        throw Failure(what + ": " +
                      (said.empty() ? cm_status_text(status) : without_name(said, name)) + after);
    }
}

OctreeMap open_map(const std::string &path, std::uint64_t memory)
{
    OctreeMap opened;
    cm_octree *map = nullptr;
    char message[CM_IMAGE_MESSAGE] = "";
    if (is_octomap(path))
    {
        check_scene(cm_octomap_read(path.c_str(), &map, message), message);
        opened.map.reset(map);
        return opened;
    }
    cm_store *store = nullptr;
    check_scene(cm_store_file_open(path.c_str(), nullptr, &store, message), message);
    opened.store.reset(store);
    cm_octree_options options = {};
    options.size = sizeof options;
    options.memory = memory;
    options.pages = memory == 0 ? nullptr : store;
    const cm_status status = cm_octree_load(store, &options, &map);
    if (status == CM_ERROR_DATA && cm_store_message(store)[0] == '\0')
    {
        throw Failure(in_quotes(path) + ": has no map, or a damaged one");
    }
    check_map(status, in_quotes(path), store);
    opened.map.reset(map);
    if (memory == 0)
    {
        opened.store.reset(); // all of it was loaded, and others may have the file
    }
    return opened;
}

void save_map(cm_octree *map, const std::string &path, const OctreeRun &run)
{
    AtomicFile file(path);
    RunFile old; // no other run writes into what is replaced
    old.take(path);
    settle_journal(path);
    {
        cm_store_file_options options = {};
        options.size = sizeof options;
        options.create = 1;
        cm_store *made = nullptr;
        char message[CM_IMAGE_MESSAGE] = "";
        const std::string &name = file.temporary_name();
        check_saved(cm_store_file_open(name.c_str(), &options, &made, message), path,
                    without_name(message, name));
        const StorePointer store(made);
        const std::string note = note_of(run);
        const cm_status saved = cm_octree_save(map, made, note.data(), note.size());
        check_saved(saved, path, without_name(cm_store_message(made), name));
    }
    file.finish();
    old.take(path); // of a run that has begun since then, too
    file.appear();
}

void check_level(int level, const cm_octree *map, const std::string &path)
{
    const int levels = cm_octree_describe(map)->levels;
    if (level > levels)
    {
        throw UsageFailure("--level is above the " + std::to_string(levels) + " levels of " +
                           in_quotes(path));
    }
}

cm_octree_count count_map(const cm_octree *map, const std::string &path)
{
    cm_octree_count count = {};
    count.size = sizeof count;
    check_map(cm_octree_count_voxels(map, &count), in_quotes(path));
    return count;
}

std::array<double, 3> read_place(OptionReader &reader)
{
    std::array<double, 3> place = {};
    std::string text = reader.text() + ",";
    for (double &each : place)
    {
        const std::size_t end = text.find(',');
        const std::optional<double> number = read_number(text.substr(0, end));
        if (!number)
        {
            reader.refuse("three numbers X,Y,Z");
        }
        each = *number;
        text.erase(0, end + 1);
    }
    if (!text.empty())
    {
        reader.refuse("three numbers X,Y,Z");
    }
    return place;
}

std::uint64_t read_memory(OptionReader &reader)
{
    const std::optional<std::uint64_t> bytes = read_byte_size(reader.text());
    if (!bytes || *bytes == 0)
    {
        reader.refuse("a size, such as 256M or 2G");
    }
    return *bytes;
}

cm_octree_options standard_map()
{
    cm_octree_options map = {};
    map.size = sizeof map;
    map.edge = 0.01;
    map.levels = 16;
    return map;
}

bool read_grid_option(int id, OptionReader &reader, cm_octree_options &map)
{
    switch (id)
    {
    case OCTREE_EDGE:
        map.edge = reader.number();
        return true;
    case OCTREE_LEVELS:
        map.levels = reader.whole_number();
        return true;
    case OCTREE_CENTRE:
    {
        const std::array<double, 3> centre = read_place(reader);
        std::copy(centre.begin(), centre.end(), map.centre);
        return true;
    }
    default:
        return false;
    }
}

std::vector<std::string> needed_operands(const OptionReader &reader, std::size_t count,
                                         const std::string &names)
{
    std::vector<std::string> operands = reader.operands();
    if (operands.size() != count)
    {
        throw UsageFailure(names + (count == 1 ? " is needed, " : " are needed, ") +
                           std::to_string(operands.size()) +
                           (operands.size() == 1 ? " is" : " are") + " given; see --help");
    }
    return operands;
}

void need_output(const std::string &output, const std::string &what)
{
    if (output.empty())
    {
        throw UsageFailure("-o " + what + " is needed: the file to write; see --help");
    }
}

cm_pose read_one_pose(const std::string &path)
{
    const TimedPoses poses = read_poses(path);
    if (poses.pose.size() != 1)
    {
        throw Failure(in_quotes(path) + ": has " + std::to_string(poses.pose.size()) +
                      " poses; one is needed");
    }
    return poses.pose.front();
}
