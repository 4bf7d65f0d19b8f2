// SPDX-License-Identifier: MIT
//
// cubemap-tof simulate: frames of a time-of-flight camera along a trajectory.

#include "tof_command.hpp"
#include "tof_arrays.hpp"
#include "tof_brdf.hpp"
#include "tof_environment.hpp"
#include "tof_frame.hpp"
#include "tof_truth.hpp"
#include "tof_metadata.hpp"
#include "tof_options.hpp"
#include "tof_sensor.hpp"
#include "tof_table.h"

#include "modules/scene/io/pose_words.hpp"
#include "tools/cli/image_file.hpp"
#include "tools/cli/parallel.hpp"
#include "tools/cli/progress.hpp"
#include "tools/cli/scene_world.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <optional>
#include <cmath>
#include <cstring>

namespace
{

constexpr const char *poses_file = "poses.txt"; // comes with the last frame

using TofScenePointer = std::unique_ptr<cm_tof_scene, HandleDeleter<cm_tof_scene_destroy>>;

// What was done for all frames.
struct Done
{
    std::vector<double> milliseconds;
    std::uint64_t rays = 0;
    std::uint64_t oversampled = 0;
    std::uint64_t saturated = 0;
    std::uint64_t unmeasured = 0;
    std::uint32_t times = 0;
    std::uint32_t lights = 0;
};

// All that a frame is made of.
struct Simulation
{
    World world;
    TofScenePointer scene;
    TofSensor sensor;
    TimedPoses poses;
    TrajectoryPointer trajectory;
    PoolPointer pool;
    std::unique_ptr<TofEnvironment> environment;
    cm_tof_options options = {};
    CameraPointer plain; // without distortion, where the budget drops that
    std::string budget;  // JSON
    std::string error;   // of the budget, in words
    bool is_within = true;
    std::optional<double> paths_needed; // where more paths than are tried would do
};

void check_tof(cm_status status, const Simulation &with)
{
    if (status == CM_ERROR_MEMORY)
    {
        throw std::bad_alloc();
    }
    if (status == CM_ERROR_RANGE)
    {
        // all else its reader has asked
        const bool is_shot = with.sensor.sensor.shot_terms > 0;
        throw Failure(in_quotes(with.sensor.name) +
                      (is_shot ? ":" + std::to_string(with.sensor.shot_line) +
                                     ": shot_variance becomes too large towards shot_most"
                               : " has numbers outside what is simulated"));
    }
    check_scene(status, "");
}

bool has_too_many_triangles(const cm_scene &scene)
{
    bool any = false;
    for (std::uint32_t id = 0; id < cm_scene_count(&scene); ++id)
    {
        const cm_primitive &each = *cm_scene_at(&scene, id);
        any |= each.kind == CM_PRIMITIVE_MESH &&
               cm_mesh_describe(each.mesh)->triangle_count > CM_TOF_TRIANGLES_MOST;
    }
    return any;
}

Simulation prepare(const SimulateOptions &options)
{
    Simulation made;
    made.world = load_world(options.scene, make_brdf); // forks, and so before all else
    made.sensor =
        options.preset.empty() ? read_tof_sensor(options.sensor) : tof_preset(options.preset);
    made.poses = read_poses(options.trajectory);
    const cm_camera_options &shape = *cm_camera_describe(made.sensor.camera.get());
    check_memory(in_quotes(made.sensor.name) + ": a frame of " + std::to_string(shape.width) +
                     " x " + std::to_string(shape.height) + " pixels",
                 std::int64_t{shape.width} * shape.height, 1,
                 frame_pixel_bytes(made.sensor.sensor) + (options.truth ? truth_pixel_bytes() : 0));
    cm_trajectory *trajectory = nullptr;
    check_scene(cm_trajectory_create(made.poses.time.size(), made.poses.time.data(),
                                     made.poses.pose.data(), &trajectory, nullptr),
                "");
    made.trajectory.reset(trajectory);
    cm_tof_scene *scene = nullptr;
    const cm_status status = cm_tof_scene_create(made.world.scene.get(), &scene);
    if (status == CM_ERROR_RANGE)
    {
        throw Failure(in_quotes(options.scene) + " has a mesh with " +
                      (has_too_many_triangles(*made.world.scene)
                           ? "more than " + std::to_string(CM_TOF_TRIANGLES_MOST) + " triangles"
                           : "coordinates of 1e18 or more"));
    }
    check_tof(status, made);
    made.scene.reset(scene);
    made.pool = make_pool(options.threads);
    made.options = options.tof;
    if (options.environment)
    {
        made.environment = read_tof_environment(*options.environment, options.environment_surface,
                                                static_cast<unsigned>(options.threads));
        made.options.environment = &made.environment->given;
    }
    return made;
}

// ---- the budget

void drop_distortion(Simulation &with)
{
    cm_camera_options shape = *cm_camera_describe(with.sensor.sensor.camera);
    std::fill(std::begin(shape.distortion), std::end(shape.distortion), 0.0);
    cm_camera *camera = nullptr;
    check_scene(cm_camera_create(&shape, &camera), "");
    with.plain.reset(camera);
    with.sensor.sensor.camera = camera;
}

std::string millimetres_text(double metres)
{
    char text[40];
    std::snprintf(text, sizeof text, "%.3g mm", 1e3 * metres);
    return text;
}

// The error, and what remains of it by name where that is more than the limit.
std::string error_text(const cm_budget &budget, double limit)
{
    const bool is_within = budget.error <= limit;
    std::string text = "error " + millimetres_text(budget.error) + ", " +
                       (is_within ? "within " : "beyond ") + millimetres_text(limit);
    const char *between = ": ";
    for (std::size_t i = 0; !is_within && i < budget.count; ++i)
    {
        const cm_budget_entry &each = budget.entry[i];
        if (each.is_kept == 0 && each.contribution > 0)
        {
            text += between + std::string(each.name) + " " + millimetres_text(each.contribution);
            between = ", ";
        }
    }
    return text;
}

// About how many paths would do, if they alone are too few: their error goes by the root of their number.
std::optional<double> find_paths_needed(const cm_budget &budget, double limit,
                                        const cm_tof_options &chosen)
{
    for (std::size_t i = 0; is_traced(chosen) && i < budget.count; ++i)
    {
        const cm_budget_entry &each = budget.entry[i];
        const double left = limit - (budget.error - each.contribution);
        if (std::string(each.name) == "sampling of scattered light" && left > 0 &&
            each.contribution > left)
        {
            const double more = each.contribution / left;
            const double needed = chosen.paths * more * more;
            // two digits, up
            const double unit = std::max(1.0, std::pow(10, std::floor(std::log10(needed)) - 1));
            return std::ceil(needed / unit) * unit;
        }
    }
    return std::nullopt;
}

// What a budget that is not met would take.
std::string paths_text(double needed, const cm_tof_options &chosen)
{
    char text[120];
    std::snprintf(text, sizeof text,
                  needed > TOF_PATHS_MOST
                      ? " by %lu paths a pixel; about %.0f would do, which is more "
                        "than --paths takes"
                      : " by %lu paths a pixel; about --paths %.0f would do",
                  static_cast<unsigned long>(chosen.paths), needed);
    return text;
}

// Takes what the first frame needs for an error of at most that.
void plan(const SimulateOptions &options, Simulation &with)
{
    cm_budget_entry entry[CM_TOF_EFFECTS] = {};
    cm_budget budget = {};
    budget.size = sizeof budget;
    budget.entry = entry;
    cm_tof_options most = with.options;
    if (!options.samples_given)
    {
        most.sample_columns = most.sample_rows = 3;
    }
    if (options.bounces_given && most.bounces == 0)
    {
        most.bounces = -1; // direct light alone; 0 is any number
    }
    check_tof(cm_tof_plan(with.scene.get(), &with.sensor.sensor, with.sensor.light.data(),
                          with.sensor.light.size(), with.trajectory.get(), with.poses.time.front(),
                          *options.budget, &most, with.pool.get(), &with.options, &budget),
              with);
    with.budget = budget_text(budget);
    with.is_within = budget.error <= *options.budget;
    with.error = error_text(budget, *options.budget);
    with.paths_needed = find_paths_needed(budget, *options.budget, with.options);
    if (with.paths_needed)
    {
        with.error += paths_text(*with.paths_needed, with.options);
    }
    for (const cm_budget_entry &each : entry)
    {
        if (std::string(each.name) == "distortion" && each.is_kept == 0)
        {
            drop_distortion(with);
        }
    }
}

// ---- frames

void simulate_frame(Simulation &with, std::size_t number, TofFrame &frame, Done &done)
{
    cm_tof_options options = with.options;
    options.view = static_cast<std::uint32_t>(number);
    cm_tof_result result = frame.result();
    const auto begin = std::chrono::steady_clock::now();
    check_tof(cm_tof_simulate(with.scene.get(), &with.sensor.sensor, with.sensor.light.data(),
                              with.sensor.light.size(), with.trajectory.get(),
                              with.poses.time[number], &options, with.pool.get(), &result),
              with);
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
    done.milliseconds.push_back(took.count());
    done.rays += frame.report.rays;
    done.oversampled += frame.report.oversampled;
    done.saturated += frame.report.saturated;
    done.times = std::max(done.times, frame.report.times);
    done.lights = std::max(done.lights, frame.report.lights);
    done.unmeasured += static_cast<std::uint64_t>(
        std::count_if(frame.distance.begin(), frame.distance.end(),
                      [](float distance) { return std::isnan(distance); }));
}

std::string poses_text(const TimedPoses &poses)
{
    std::string text;
    for (std::size_t i = 0; i < poses.time.size(); ++i)
    {
        text += pose_line(poses.time[i], poses.pose[i]);
    }
    return text;
}

// The pictures of a frame, in the format that is asked for; truth may be nullptr.
void write_pictures(const SimulateOptions &options, const OutputFolder &folder,
                    const TofFrame &frame, const TruthPictures *truth, std::size_t number,
                    FileList &files)
{
    if (options.format == TOF_FORMAT_EXR)
    {
        write_frame(folder, frame, number, thread_count(options.threads), files);
        if (truth != nullptr)
        {
            files.push_back(truth->write(folder.path_of(frame_file_name("truth", number))));
        }
        return;
    }
    const auto write = options.format == TOF_FORMAT_NPY ? write_npy_files : write_hdf5_file;
    write(folder, arrays_of(frame, truth), number, files);
}

// What stands beside the pictures: with the first frame, and with the last.
void write_texts(const SimulateOptions &options, const Simulation &with, const OutputFolder &folder,
                 std::size_t number, FileList &files)
{
    if (number == 0)
    {
        write_text(folder.path_of("metadata.json"),
                   metadata_text(options, with.options, with.sensor, with.world.scene.get(),
                                 with.poses, with.budget),
                   files);
    }
    if (number + 1 == with.poses.time.size())
    {
        write_text(folder.path_of(poses_file), poses_text(with.poses), files);
    }
}

// Where frames go as soon as they are made.
class FrameOutput
{
public:
    FrameOutput(const SimulateOptions &given, const cm_streams &streams)
        : options(given), out(streams.out)
    {
        if (options.is_stream)
        {
            stream.emplace("standard output", streams.out);
        }
        else
        {
            folder.emplace(options.output);
        }
    }
    void put(const Simulation &with, const TofFrame &frame, const TruthPictures *truth,
             std::size_t number)
    {
        if (stream)
        {
            write_npy_stream(*stream, arrays_of(frame, truth));
            if (std::fflush(out) != 0) // who reads need not wait for the next
            {
                throw Failure(std::string("'standard output' cannot be written: ") +
                              std::strerror(errno));
            }
            return;
        }
        FileList files;
        write_pictures(options, *folder, frame, truth, number, files);
        write_texts(options, with, *folder, number, files);
        bring_frame(*folder, files, number, with.poses.time.size(), poses_file);
    }
    void finish()
    {
        if (stream)
        {
            stream->finish();
        }
    }

private:
    const SimulateOptions &options;
    std::FILE *out;
    std::optional<OutputFolder> folder;
    std::optional<AtomicFile> stream;
};

Done simulate_all(const SimulateOptions &options, Simulation &with, const cm_streams &streams)
{
    FrameOutput output(options, streams);
    if (options.budget)
    {
        plan(options, with);
    }
    const std::size_t count = with.poses.time.size();
    TofFrame frame(with.sensor.sensor);
    std::optional<TruthPictures> truth;
    if (options.truth)
    {
        truth.emplace(with.sensor.sensor.camera);
    }
    Done done;
    Progress progress(static_cast<std::int64_t>(count), !options.quiet, streams.err);
    for (std::size_t i = 0; i < count; ++i)
    {
        simulate_frame(with, i, frame, done);
        if (truth)
        {
            const std::vector<double> &time = with.poses.time;
            truth->find(with.scene.get(), with.trajectory.get(), time[i],
                        time[std::min(i + 1, count - 1)], time[i == 0 ? 0 : i - 1], frame.flags,
                        with.pool.get());
        }
        output.put(with, frame, truth ? &*truth : nullptr, i);
        progress.advance(1);
    }
    output.finish();
    return done;
}

// ---- what is told

// What the budget has chosen, and whether it is met.
std::string chosen_json(const Simulation &with)
{
    const cm_tof_options &chosen = with.options;
    const auto word = [](bool is_so) { return is_so ? "true" : "false"; };
    return std::string(", \"within_budget\": ") + word(with.is_within) +
           ", \"chosen\": {\"bounces\": " + std::to_string(chosen.bounces) +
           ", \"lights\": " + std::to_string(chosen.lights) +
           ", \"visibility\": " + word(chosen.visibility != 0) +
           ", \"paths\": " + std::to_string(chosen.paths) +
           ", \"traced\": " + word(is_traced(chosen)) + ", \"samples\": \"" +
           std::to_string(chosen.sample_columns) + "x" + std::to_string(chosen.sample_rows) +
           "\", \"noise\": " + word(chosen.noise != 0) + "}, \"paths_needed\": " +
           (with.paths_needed ? json_number(*with.paths_needed) : "null") +
           ", \"budget\": " + with.budget;
}

std::string done_json(const Done &done, const Simulation &with)
{
    return "{\"frames\": " + std::to_string(done.milliseconds.size()) +
           ", \"ms_per_frame\": {\"median\": " + json_number(median_of(done.milliseconds)) +
           ", \"max\": " +
           json_number(*std::max_element(done.milliseconds.begin(), done.milliseconds.end())) +
           "}, \"rays\": " + std::to_string(done.rays) +
           ", \"oversampled\": " + std::to_string(done.oversampled) +
           ", \"times\": " + std::to_string(done.times) +
           ", \"virtual_lights\": " + std::to_string(done.lights) +
           ", \"saturated\": " + std::to_string(done.saturated) +
           ", \"unmeasured\": " + std::to_string(done.unmeasured) +
           (with.budget.empty() ? "" : chosen_json(with)) + "}\n";
}

std::string done_text(const SimulateOptions &options, const Done &done, const Simulation &with)
{
    char text[300];
    std::snprintf(text, sizeof text,
                  ": %zu frames, median %.3g ms; %llu pixels saturated, %llu without light",
                  done.milliseconds.size(), median_of(done.milliseconds),
                  static_cast<unsigned long long>(done.saturated),
                  static_cast<unsigned long long>(done.unmeasured));
    return in_quotes(options.output) + text + (with.error.empty() ? "" : "; ") + with.error + "\n";
}

} // namespace

int simulate_tof(int argc, char **argv, const cm_streams &streams)
{
    const SimulateOptions options = parse_simulate_options(argc, argv, streams);
    if (options.printed)
    {
        return 0;
    }
    Simulation with = prepare(options);
    const Done done = simulate_all(options, with, streams);
    if (options.json)
    {
        print(streams, done_json(done, with));
    }
    else if (!options.quiet && !options.is_stream)
    {
        print(streams, done_text(options, done, with));
    }
    return 0;
}
