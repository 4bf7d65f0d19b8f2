// SPDX-License-Identifier: MIT

#include "scene_render.hpp"

#include "modules/scene/io/pose_words.hpp"
#include "tools/cli/scene_handle.hpp"
#include "scene_table.h"
#include "scene_view.hpp"
#include "tools/cli/scene_world.hpp"
#include "tools/cli/image_file.hpp"
#include "tools/cli/image_writer.hpp"
#include "tools/cli/parallel.hpp"
#include "tools/cli/program.hpp"
#include "tools/cli/progress.hpp"

#include <algorithm>
#include <filesystem>

namespace
{

constexpr std::uint32_t rows_a_piece = 8;

struct RenderOptions
{
    std::string scene;
    std::string camera;
    std::string trajectory;
    std::string output;
    std::optional<double> noise;
    std::uint64_t seed = 0;
    bool truth = false;
    int threads = 0;
    bool quiet = false;
    bool printed = false;
};

double read_noise(OptionReader &reader)
{
    const std::string text = reader.text();
    const std::string kind = "gaussian:";
    const std::optional<double> part =
        text.rfind(kind, 0) == 0 ? read_number(text.substr(kind.size())) : std::nullopt;
    if (!part || !(*part >= 0 && *part <= 1))
    {
        reader.refuse("gaussian:S with S from 0 to 1");
    }
    return *part;
}

void read_render_option(int id, OptionReader &reader, RenderOptions &options)
{
    switch (id)
    {
    case SCENE_OUTPUT:
        options.output = reader.text();
        break;
    case SCENE_NOISE:
        options.noise = read_noise(reader);
        break;
    case SCENE_SEED:
        options.seed = static_cast<std::uint64_t>(reader.number());
        break;
    case SCENE_TRUTH:
        options.truth = true;
        break;
    case SCENE_THREADS:
        options.threads = reader.whole_number();
        break;
    default:
        options.quiet = true;
        break;
    }
}

RenderOptions parse_render_options(int argc, char **argv, const cm_streams &streams)
{
    RenderOptions options;
    OptionReader reader(scene_render_command, argc, argv, streams);
    while (const int id = reader.next())
    {
        read_render_option(id, reader, options);
    }
    options.printed = reader.printed();
    if (options.printed)
    {
        return options;
    }
    const std::vector<std::string> names = reader.operands();
    if (names.size() != 3)
    {
        throw UsageFailure("SCENE, CAMERA.json and TRAJECTORY.txt are needed, " +
                           std::to_string(names.size()) + (names.size() == 1 ? " is" : " are") +
                           " given; see --help");
    }
    if (options.output.empty())
    {
        throw UsageFailure("-o DIR is needed: the folder to write; see --help");
    }
    options.scene = names[0];
    options.camera = names[1];
    options.trajectory = names[2];
    return options;
}

// ---- pictures of a view

cm_image picture_of(void *data, cm_pixel_type type, std::uint32_t channels,
                    const cm_camera_options &camera)
{
    cm_image image = {};
    image.size = sizeof image;
    image.data = data;
    image.type = type;
    image.width = camera.width;
    image.height = camera.height;
    image.channels = channels;
    return image;
}

cm_view view_of(const ViewMaking &making, double time, const cm_pose &pose, SceneView &pictures)
{
    const cm_camera_options &camera = *cm_camera_describe(making.camera);
    cm_view view = {};
    view.size = sizeof view;
    view.time = time;
    view.camera = making.camera;
    view.pose = pose;
    view.depth = picture_of(pictures.depth.data(), CM_PIXEL_U16, 1, camera);
    view.depth_is_range = camera.mapping != nullptr;
    view.depth_unit = 1 / making.depth_scale;
    view.color = picture_of(pictures.color.data(), CM_PIXEL_U8, 3, camera);
    return view;
}

void write_truth(const std::string &path, const cm_camera_options &camera,
                 const SceneView &pictures, int threads)
{
    const int channels = static_cast<int>(truth_channels.size());
    const int width = static_cast<int>(camera.width);
    const int height = static_cast<int>(camera.height);
    ImageDescription description(channels, CM_PIXEL_FLOAT);
    description.channel_names.assign(truth_channels.begin(), truth_channels.end());
    AtomicFile file(path);
    ImageWriter writer(plan_image("openexr", description, "openexr", path), width, height, path,
                       file, threads);
    writer.write(0, height, pictures.truth.data(), channels);
    writer.close();
    file.finish();
    file.appear();
}

void render_view(const ViewMaking &making, const TimedPoses &poses, std::size_t number, int threads,
                 Progress &progress, SceneView &pictures)
{
    const std::uint32_t height = cm_camera_describe(making.camera)->height;
    const auto place_of = [&poses](std::size_t k) {
        return ViewPlace{poses.time[k], poses.pose[k]};
    };
    const bool is_first = number == 0;
    const bool is_last = number + 1 == poses.pose.size();
    const ViewPlace here = place_of(number);
    const ViewPlace next = is_last ? here : place_of(number + 1);
    const ViewPlace before = is_first ? here : place_of(number - 1);
    const int pieces = static_cast<int>((height + rows_a_piece - 1) / rows_a_piece);
    parallel_for(pieces, threads,
                 [&](int piece)
                 {
                     const std::uint32_t first = static_cast<std::uint32_t>(piece) * rows_a_piece;
                     const std::uint32_t end = std::min(first + rows_a_piece, height);
                     render_rows(making, static_cast<std::uint32_t>(number), here,
                                 is_last ? nullptr : &next, is_first ? nullptr : &before, first,
                                 end, pictures);
                     progress.advance(end - first);
                 });
}

void make_folder(const std::string &name)
{
    std::error_code wrong;
    std::filesystem::create_directory(name, wrong);
    if (wrong)
    {
        throw Failure(in_quotes(name) + " cannot be made: " + wrong.message());
    }
}

// The system gives more than it has, and ends the program later.
void check_room(const RenderOptions &options, const cm_camera_options &shape)
{
    const std::size_t depths = 2 * sizeof(std::uint16_t); // and the copy that is written
    const std::size_t truths = options.truth ? truth_channels.size() * sizeof(float) : 0;
    check_memory(in_quotes(options.camera) + ": a view of " + std::to_string(shape.width) + " x " +
                     std::to_string(shape.height) + " pixels",
                 std::int64_t{shape.width} * shape.height, 1, depths + 3 + truths,
                 options.truth ? "; without --truth it needs less" : "");
}

// Does what may fail with a name in the folder in the making; the failure tells the name that was asked for.
template <typename Body>
void by_its_name(const std::string &making, const std::string &asked, const Body &body)
{
    try
    {
        body();
    }
    catch (const Failure &failure)
    {
        std::string text = failure.what();
        for (std::size_t at = 0; (at = text.find(making, at)) != std::string::npos;
             at += asked.size())
        {
            text.replace(at, making.size(), asked);
        }
        throw Failure(text, failure.exit_status());
    }
}

int render(const RenderOptions &options, const cm_streams &streams)
{
    const int threads = thread_count(options.threads);
    const World world = load_world(options.scene); // forks, and so before all else
    const CameraFile camera = read_camera(options.camera);
    const TimedPoses poses = read_poses(options.trajectory);
    ViewMaking making;
    const SceneInTime scene(world.scene.get());
    making.scene = &scene;
    making.camera = camera.camera.get();
    making.depth_scale = camera.depth_scale;
    making.noise = options.noise;
    making.seed = options.seed;
    making.truth = options.truth;
    const cm_camera_options &shape = *cm_camera_describe(making.camera);
    check_room(options, shape);
    const SequenceWriterPointer writer =
        create_sequence(options.output, CM_SEQUENCE_TUM, camera.camera.get(), camera.depth_scale);
    const std::string folder = cm_sequence_writer_folder(writer.get());
    const std::string truth = folder + "/truth";
    if (options.truth)
    {
        by_its_name(folder, options.output, [&] { make_folder(truth); });
    }
    SceneView pictures = empty_view(making);
    {
        Progress progress(static_cast<std::int64_t>(poses.pose.size()) * shape.height,
                          !options.quiet, streams.err);
        for (std::size_t i = 0; i < poses.pose.size(); ++i)
        {
            char message[CM_IMAGE_MESSAGE] = "";
            render_view(making, poses, i, threads, progress, pictures);
            const cm_view view = view_of(making, poses.time[i], poses.pose[i], pictures);
            check_scene(cm_sequence_write(writer.get(), &view, nullptr, message), message);
            if (options.truth)
            {
                const std::string name = truth + "/" + time_text(poses.time[i]) + ".exr";
                by_its_name(folder, options.output,
                            [&] { write_truth(name, shape, pictures, threads); });
            }
        }
    }
    finish_sequence(writer);
    return 0;
}

} // namespace

int render_scene(int argc, char **argv, const cm_streams &streams)
{
    const RenderOptions options = parse_render_options(argc, argv, streams);
    return options.printed ? 0 : render(options, streams);
}
