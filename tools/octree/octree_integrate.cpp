// SPDX-License-Identifier: MIT

#include "octree_budget.hpp"
#include "octree_command.hpp"
#include "octree_map.hpp"
#include "octree_run_file.hpp"
#include "octree_table.h"
#include "octree_views.hpp"

#include "modules/scene/io/camera_file.h"
#include "modules/scene/io/check_sum.h"
#include "modules/scene/io/store_file.h"
#include "tools/cli/progress.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>

namespace
{

using Clock = std::chrono::steady_clock;

constexpr double seconds_between_commits = 5;

struct IntegrateOptions
{
    std::string folder;
    std::string output;
    std::string camera;
    cm_octree_options map = standard_map();
    std::optional<double> edge; // that was asked for
    std::optional<double> budget;
    std::uint64_t memory = 0;
    std::uint64_t save_every = 0;
    int threads = 0;
    bool json = false;
    bool quiet = false;
    bool printed = false;
};

void read_log_odds(OptionReader &reader, cm_octree_options &map)
{
    std::string text = reader.text() + ",";
    double *const numbers[] = {&map.hit, &map.miss, &map.low, &map.high};
    const char *const wanted = "HIT,MISS,LOW,HIGH with HIT and HIGH above 0, MISS and LOW below 0";
    for (double *each : numbers)
    {
        const std::size_t end = text.find(',');
        const std::optional<double> number = read_number(text.substr(0, end));
        if (!number)
        {
            reader.refuse(wanted);
        }
        *each = *number;
        text.erase(0, end + 1);
    }
    if (!text.empty() || !(map.hit > 0 && map.miss < 0 && map.low < 0 && map.high > 0))
    {
        reader.refuse(wanted);
    }
    map.rule = CM_OCTREE_LOG_ODDS;
}

// What the map is made of.
bool read_map_option(int id, OptionReader &reader, IntegrateOptions &options)
{
    cm_octree_options &map = options.map;
    switch (id)
    {
    case OCTREE_EDGE:
        read_grid_option(id, reader, map);
        options.edge = map.edge;
        return true;
    case OCTREE_COLOR:
        map.color = 1;
        return true;
    case OCTREE_FOOTPRINT:
        map.footprint = reader.number();
        return true;
    case OCTREE_NOISE:
        map.noise = reader.number();
        return true;
    case OCTREE_NEAR:
        map.near = reader.number();
        return true;
    case OCTREE_FAR:
        map.far = reader.number();
        return true;
    case OCTREE_NO_RETURN_FREE:
        map.no_return_is_free = 1;
        return true;
    case OCTREE_ENDPOINTS_ONLY:
        map.endpoints_only = 1;
        return true;
    case OCTREE_LOG_ODDS:
        read_log_odds(reader, map);
        return true;
    default:
        return read_grid_option(id, reader, map);
    }
}

void read_integrate_option(int id, OptionReader &reader, IntegrateOptions &options)
{
    switch (id)
    {
    case OCTREE_OUTPUT:
        options.output = reader.text();
        break;
    case OCTREE_CAMERA:
        options.camera = reader.text();
        break;
    case OCTREE_MEMORY:
        options.memory = read_memory(reader);
        break;
    case OCTREE_BUDGET:
        options.budget = reader.number();
        break;
    case OCTREE_SAVE_EVERY:
        options.save_every = static_cast<std::uint64_t>(reader.number());
        break;
    case OCTREE_THREADS:
        options.threads = reader.whole_number();
        break;
    case OCTREE_JSON:
        options.json = true;
        break;
    default:
        options.quiet = true;
        break;
    }
}

void check_integrate_options(const IntegrateOptions &options)
{
    const cm_octree_options &map = options.map;
    need_output(options.output, "MAP");
    if (options.output == "-")
    {
        throw UsageFailure("-o is '-', not a file to write");
    }
    if (map.no_return_is_free != 0 && !(map.far > 0))
    {
        throw UsageFailure("--no-return-free needs --far: how far it is free");
    }
    if (map.no_return_is_free != 0 && map.endpoints_only != 0)
    {
        throw UsageFailure("--no-return-free and --endpoints-only contradict each other");
    }
    if (map.far > 0 && !(map.near < map.far))
    {
        throw UsageFailure("--near is not below --far");
    }
}

IntegrateOptions parse_integrate_options(int argc, char **argv, const cm_streams &streams)
{
    IntegrateOptions options;
    OptionReader reader(octree_integrate_command, argc, argv, streams);
    while (const int id = reader.next())
    {
        if (!read_map_option(id, reader, options))
        {
            read_integrate_option(id, reader, options);
        }
    }
    options.printed = reader.printed();
    if (!options.printed)
    {
        options.folder = needed_operands(reader, 1, "DIR").front();
        check_integrate_options(options);
        if (options.budget)
        {
            options.map.edge = edge_within_budget(*options.budget, options.edge);
        }
    }
    return options;
}

// ---- the run

// What makes one run differ from another: what the map is made of, and the sequence.
std::string settings_of(const IntegrateOptions &options, cm_sequence *sequence)
{
    const cm_sequence_report &report = *cm_sequence_describe(sequence);
    const cm_octree_options &map = options.map;
    std::string text = "edge";
    for (const double number :
         {map.edge, map.centre[0], map.centre[1], map.centre[2], double(map.levels),
          double(map.rule), map.hit, map.miss, map.low, map.high, map.near, map.far,
          double(map.no_return_is_free + 2 * map.endpoints_only), map.noise, map.footprint,
          double(map.color)})
    {
        text += " " + json_number(number);
    }
    char *camera = nullptr;
    char message[CM_IMAGE_MESSAGE] = "";
    check_scene(cm_camera_file_format(report.camera, report.depth_scale, &camera, message),
                message);
    const std::unique_ptr<char, void (*)(void *)> owned(camera, std::free);
    const std::string shape = camera;
    text +=
        "; camera " + std::to_string(cm_check_sum(CM_CHECK_SUM_BEGIN, shape.data(), shape.size()));
    if (options.folder != "-")
    {
        text += "; views " + std::to_string(report.count) + " " + json_number(report.first) + " " +
                json_number(report.last) + " " +
                std::to_string(sequence_sum(sequence, options.folder));
    }
    return text;
}

// The store and the map in it, at the beginning of a run or where a former one was ended.
struct Working
{
    RunFile place; // MAP, if the new map is made beside it; these two end after the store
    RunFile file;  // of the store
    std::string path;
    std::string target; // where it goes once it is complete, if that is another path
    OctreeMap open;
    OctreeRun run;
    std::uint64_t begun = 0; // views that were there
    bool is_new = false;     // it has nothing that was committed
};

StorePointer open_store(const std::string &path, bool create)
{
    cm_store_file_options options = {};
    options.size = sizeof options;
    options.create = create ? 1 : 0;
    options.level = 1;
    cm_store *store = nullptr;
    char message[CM_IMAGE_MESSAGE] = "";
    check_scene(cm_store_file_open(path.c_str(), &options, &store, message), message);
    return StorePointer(store);
}

bool is_empty(cm_store *store)
{
    unsigned char key[CM_STORE_KEY_MAX];
    std::size_t count = 0;
    check_map(cm_store_next(store, nullptr, key, &count), "the map", store);
    return count == 0;
}

enum class Found
{
    nothing,
    begun, // by a run that the same command goes on with
    other, // begun by another command
    whole  // a map that is complete, and not only to be brought to its place
};

[[noreturn]] void refuse_file(const std::string &path, cm_status status)
{
    throw Failure(in_quotes(path) +
                  (status == CM_ERROR_VERSION
                       ? " exists and is of a newer version than this program"
                       : " exists and is no map, or a damaged one") +
                  "; give another name, or remove it");
}

// What a former run has left under the working path, which is taken up if it can be gone on with. A map that is complete but
// has not yet come to its place can.
Found take_up(const IntegrateOptions &options, const std::string &settings, Working &working,
              const cm_streams &streams)
{
    if (!working.file.take(working.path))
    {
        return Found::nothing;
    }
    // A run that was killed as it began, or whose disk was full then, leaves a file without a byte.
    const bool has_nothing = working.file.is_empty();
    StorePointer store = open_store(working.path, has_nothing);
    if (has_nothing && !working.target.empty() && !options.quiet)
    {
        std::fprintf(streams.err,
                     "cubemap-octree: %s is empty, since a run ended before it kept anything; it "
                     "begins anew\n",
                     in_quotes(working.path).c_str());
    }
    if (is_empty(store.get()))
    {
        working.open.store = std::move(store);
        working.is_new = true;
        return Found::begun;
    }
    cm_octree_options kept = options.map;
    kept.memory = options.memory;
    kept.pages = store.get();
    cm_octree *map = nullptr;
    const cm_status status = cm_octree_load(store.get(), &kept, &map);
    if (status != CM_OK && status != CM_ERROR_MEMORY)
    {
        refuse_file(working.path, status);
    }
    check_map(status, in_quotes(working.path));
    OctreePointer owned(map);
    const OctreeRun run = read_note(map);
    const bool is_in_place = working.target.empty();
    if (run.settings != settings || (run.complete && is_in_place))
    {
        return run.complete ? Found::whole : Found::other;
    }
    working.run = run;
    working.begun = run.views;
    working.open.store = std::move(store);
    working.open.map = std::move(owned);
    return Found::begun;
}

// The path of the run, and what a former one has left there: a map that is there stays until another is complete, which is
// made beside it.
void find_place(const IntegrateOptions &options, const std::string &settings, Working &working,
                const cm_streams &streams)
{
    working.path = options.output;
    const Found there = take_up(options, settings, working, streams);
    if (there == Found::nothing || there == Found::begun)
    {
        return;
    }
    working.place = std::move(working.file);
    working.target = std::filesystem::canonical(options.output).string();
    working.path = unfinished_path(working.target);
    const Found beside = take_up(options, settings, working, streams);
    if (beside == Found::whole)
    {
        throw Failure(in_quotes(working.path) +
                      ", where a new map is made beside the old one, is a complete map of another "
                      "command; give another name, or remove it");
    }
    if (beside == Found::other)
    {
        std::filesystem::remove(working.path);
    }
}

// What is left after a failure, "" for nothing.
std::string what_is_left(const Working &working)
{
    return working.is_new ? ""
                          : "; " + in_quotes(working.path) +
                                " is as it was committed last, and the same command goes on from "
                                "there";
}

void commit(Working &working)
{
    const std::string note = note_of(working.run);
    cm_store *const store = working.open.store.get();
    const cm_status status =
        cm_octree_save(working.open.map.get(), store, note.data(), note.size());
    check_map(status, in_quotes(working.path), store, what_is_left(working));
    working.is_new = false;
}

void begin_run(const IntegrateOptions &options, const std::string &settings, Working &working,
               const cm_streams &streams)
{
    find_place(options, settings, working, streams);
    working.run.settings = settings;
    working.run.complete = false;
    if (working.open.store == nullptr)
    {
        if (!working.file.make(working.path))
        {
            throw Failure(in_quotes(working.path) + " is in use: another run has just made it");
        }
        working.is_new = true;
        working.open.store = open_store(working.path, true);
    }
    if (working.open.map == nullptr)
    {
        cm_octree_options made = options.map;
        made.memory = options.memory;
        made.pages = working.open.store.get();
        cm_octree *map = nullptr;
        const cm_status status = cm_octree_create(&made, &map);
        if (status == CM_ERROR_RANGE)
        {
            throw UsageFailure("the options of the map do not go together: --edge, --levels, "
                               "--log-odds, --near and --far; see --help");
        }
        check_map(status, in_quotes(working.path));
        working.open.map.reset(map);
        // What is ended before its first views are kept opens, too. Until then the file goes if a view cannot be had.
        commit(working);
        working.is_new = true;
    }
}

void update(const IntegrateOptions &options, const cm_view &view, double depth, cm_pool *pool,
            Working &working, std::vector<double> &took)
{
    cm_store *const store = working.open.store.get();
    const Clock::time_point begin = Clock::now();
    const cm_status status = cm_octree_update(working.open.map.get(), &view, pool);
    took.push_back(1e3 * std::chrono::duration<double>(Clock::now() - begin).count());
    if (status == CM_ERROR_MEMORY)
    {
        throw std::bad_alloc();
    }
    if (status == CM_ERROR_RANGE)
    {
        throw refused_depth(options.map, view, depth, working.run.views + 1, options.folder);
    }
    if (status != CM_OK)
    {
        const std::string said = cm_store_message(store);
        throw Failure("view " + std::to_string(working.run.views + 1) + " of " +
                      in_quotes(options.folder) + ": " +
                      (said.empty() ? cm_status_text(status) : said) + what_is_left(working));
    }
}

void integrate_all(const IntegrateOptions &options, cm_sequence *sequence, Working &working,
                   std::vector<double> &took, const cm_streams &streams)
{
    const std::size_t count = cm_sequence_count(sequence);
    const bool is_known = count != CM_SEQUENCE_UNKNOWN;
    const PoolPointer pool = make_pool(options.threads);
    Progress progress(is_known ? static_cast<std::int64_t>(count) : 1, !options.quiet && is_known,
                      streams.err);
    progress.advance(static_cast<std::int64_t>(is_known ? working.begun : 0));
    Clock::time_point committed = Clock::now();
    const auto add = [&](const cm_view &view)
    {
        const double depth = greatest_depth(view);
        check_near_map(options.map, view, depth, working.run.views + 1, options.folder);
        update(options, view, depth, pool.get(), working, took);
        working.run.views++;
        working.run.empty += depth > 0 ? 0 : 1;
        const double since = std::chrono::duration<double>(Clock::now() - committed).count();
        const bool is_due = options.save_every > 0 ? working.run.views % options.save_every == 0
                                                   : since >= seconds_between_commits;
        if (is_due)
        {
            commit(working);
            committed = Clock::now();
        }
        progress.advance(1);
    };
    for_views_from(sequence, static_cast<std::size_t>(working.begun), add);
}

std::string integrate_json(const Working &working, const std::vector<double> &took,
                           const cm_octree_count &count, const std::string &budget,
                           std::uint64_t file_bytes)
{
    const double most = took.empty() ? std::nan("") : *std::max_element(took.begin(), took.end());
    const cm_octree_options &made = *cm_octree_describe(working.open.map.get());
    return "{\"views\": " + std::to_string(working.run.views) +
           ", \"ms_per_view\": {\"median\": " + json_number(median_of(took)) +
           ", \"max\": " + json_number(most) +
           "}, \"occupied\": " + std::to_string(count.occupied) +
           ", \"free\": " + std::to_string(count.free) +
           ", \"bytes\": " + std::to_string(count.bytes) +
           ", \"nodes\": " + std::to_string(count.nodes) +
           ", \"paged\": " + std::to_string(count.paged) +
           ", \"file_bytes\": " + std::to_string(file_bytes) +
           ", \"edge\": " + json_number(made.edge) +
           ", \"levels\": " + std::to_string(made.levels) +
           ", \"views_without_depth\": " + std::to_string(working.run.empty) +
           ", \"resumed_at\": " + std::to_string(working.begun) +
           (budget.empty() ? "" : ", \"budget\": " + budget) + "}\n";
}

std::string integrate_text(const IntegrateOptions &options, const Working &working,
                           const std::vector<double> &took, const cm_octree_count &count)
{
    char text[400];
    std::snprintf(text, sizeof text,
                  ": %llu views, %llu without depth; median %.3g ms a view; %llu voxels occupied, "
                  "%llu free; %.4g MB in memory\n",
                  static_cast<unsigned long long>(working.run.views),
                  static_cast<unsigned long long>(working.run.empty), median_of(took),
                  static_cast<unsigned long long>(count.occupied),
                  static_cast<unsigned long long>(count.free),
                  1e-6 * static_cast<double>(count.bytes));
    return in_quotes(options.output) + text;
}

// Views that are all empty are a mistake, unless what is not measured is free.
void check_measured(const IntegrateOptions &options, const OctreeRun &run)
{
    if (run.views == run.empty && options.map.no_return_is_free == 0)
    {
        throw Failure(in_quotes(options.folder) + ": none of its " + std::to_string(run.views) +
                      " views has a pixel that measured something");
    }
}

// The report of a run whose map is complete.
std::string finish(const IntegrateOptions &options, Working &working,
                   const std::vector<double> &took)
{
    cm_octree *const map = working.open.map.get();
    check_measured(options, working.run);
    check_map(cm_octree_compact(map), in_quotes(working.path), working.open.store.get());
    working.run.complete = true;
    commit(working);
    if (!working.file.is_at(working.path))
    {
        throw Failure(in_quotes(working.path) +
                      " was replaced or removed while the map was made, which is lost");
    }
    const cm_octree_count count = count_map(map, working.path);
    const std::uint64_t bytes = std::filesystem::file_size(working.path);
    if (options.json)
    {
        const std::string budget =
            options.budget ? budget_report(map, count, options.edge.value_or(0), bytes) : "";
        return integrate_json(working, took, count, budget, bytes);
    }
    return options.quiet ? "" : integrate_text(options, working, took, count);
}

// The file stays taken, so that nobody has it until what is done with it then is done.
void close_run(Working &working)
{
    working.open.map.reset();
    working.open.store.reset();
}

// A map that was made beside another takes its place.
void appear(Working &working)
{
    close_run(working);
    std::error_code wrong;
    if (!working.target.empty())
    {
        std::filesystem::rename(working.path, working.target, wrong);
    }
    if (wrong)
    {
        throw Failure(in_quotes(working.target) + " cannot be replaced: " + wrong.message() +
                      "; the map is in " + in_quotes(working.path));
    }
}

int integrate(const IntegrateOptions &options, const cm_streams &streams)
{
    const SequencePointer sequence = open_sequence(options.folder, options.camera);
    const std::string settings = settings_of(options, sequence.get());
    Working working;
    std::vector<double> took;
    try
    {
        begin_run(options, settings, working, streams);
        integrate_all(options, sequence.get(), working, took, streams);
        const std::string report = finish(options, working, took);
        appear(working);
        print(streams, report);
    }
    catch (...)
    {
        // nothing is left of what nothing was kept of
        close_run(working);
        if (working.is_new)
        {
            std::error_code ignored;
            std::filesystem::remove(working.path, ignored);
        }
        throw;
    }
    return 0;
}

} // namespace

int integrate_views(int argc, char **argv, const cm_streams &streams)
{
    const IntegrateOptions options = parse_integrate_options(argc, argv, streams);
    return options.printed ? 0 : integrate(options, streams);
}
