// SPDX-License-Identifier: MIT
//
// cubemap-tof texel: fine colours over coarse depths of a scene, seen from each pose of a path.

#include "tof_arrays.hpp"
#include "tof_brdf.hpp"
#include "tof_command.hpp"
#include "tof_table.h"

#include "tools/cli/float_picture.hpp"
#include "tools/cli/image_file.hpp"
#include "tools/cli/parallel.hpp"
#include "tools/cli/program.hpp"
#include "tools/cli/progress.hpp"
#include "tools/cli/scene_world.hpp"

#include <cubemap/texel.h>

namespace
{

constexpr const char *matrices_file = "matrices.txt"; // comes with the last image

struct TexelOptions
{
    std::string scene;
    std::string path;
    std::string output;
    cm_texel_options texel = {};
    bool quiet = false;
    int threads = 0;
    bool printed = false; // nothing else is to be done
};

constexpr double degree = 3.14159265358979323846 / 180;

void read_texel_option(int id, OptionReader &reader, TexelOptions &options)
{
    const auto count = [&reader] { return static_cast<std::uint32_t>(reader.whole_number()); };
    switch (id)
    {
    case TOF_OUTPUT:
        options.output = reader.text();
        break;
    case TOF_FIELD:
        options.texel.field = reader.number() * degree;
        break;
    case TOF_SIZE:
        options.texel.width = count();
        break;
    case TOF_DEPTHS:
        options.texel.columns = options.texel.rows = count();
        break;
    case TOF_WINDOW:
        options.texel.window = count();
        break;
    case TOF_RAYS:
        options.texel.oversampling = count();
        break;
    case TOF_SPACING:
        options.texel.spacing = static_cast<cm_texel_spacing>(reader.choice());
        break;
    case TOF_THREADS:
        options.threads = reader.whole_number();
        break;
    default:
        options.quiet = true;
        break;
    }
}

TexelOptions parse_texel_options(int argc, char **argv, const cm_streams &streams)
{
    TexelOptions options;
    options.texel.size = sizeof options.texel;
    options.texel.field = 60 * degree;
    OptionReader reader(tof_texel_command, argc, argv, streams);
    while (const int id = reader.next())
    {
        read_texel_option(id, reader, options);
    }
    options.printed = reader.printed();
    if (options.printed)
    {
        return options;
    }
    const std::vector<std::string> names = reader.operands();
    if (names.size() != 2)
    {
        throw UsageFailure("SCENE and PATH.txt are needed, " + std::to_string(names.size()) +
                           (names.size() == 1 ? " is" : " are") + " given; see --help");
    }
    if (options.output.empty() || options.output == "-")
    {
        throw UsageFailure("-o DIR is needed: the folder to write; see --help");
    }
    cm_texel_options of_standard_window = options.texel;
    of_standard_window.window = 0;
    const bool are_depths_good = cm_texel_complete(&of_standard_window) == CM_OK;
    if (cm_texel_complete(&options.texel) != CM_OK)
    {
        throw UsageFailure(std::string(are_depths_good ? "--window" : "--depths") +
                           " is more than --size; see --help");
    }
    options.scene = names[0];
    options.path = names[1];
    return options;
}

// What a texel image has, in memory.
struct TexelPictures
{
    explicit TexelPictures(const cm_texel_options &options)
        : width(static_cast<int>(options.width)), height(static_cast<int>(options.height)),
          columns(static_cast<int>(options.columns)), rows(static_cast<int>(options.rows)),
          color(3 * std::size_t{options.width} * options.height),
          samples(std::size_t{options.columns} * options.rows), depth(samples), range(samples),
          point(3 * samples)
    {
    }
    cm_texel_image image()
    {
        cm_texel_image all = {};
        all.size = sizeof all;
        all.color = color.data();
        all.depth = depth.data();
        all.range = range.data();
        for (std::size_t k = 0; k < 3; ++k)
        {
            all.point[k] = point.data() + k * samples;
        }
        return all;
    }
    // Points with their coordinates side by side.
    std::vector<float> points() const
    {
        std::vector<float> all(3 * samples);
        for (std::size_t i = 0; i < 3 * samples; ++i)
        {
            all[i] = point[i % 3 * samples + i / 3];
        }
        return all;
    }

    int width, height, columns, rows;
    std::vector<float> color;
    std::size_t samples;
    std::vector<float> depth, range, point;
};

void write_pictures(const OutputFolder &folder, const TexelPictures &from, std::size_t number,
                    int threads, FileList &files)
{
    const auto add = [&](const char *kind, const float *rows, int width, int height, int channels,
                         const std::vector<std::string> &names)
    {
        files.push_back(write_float_picture(folder.path_of(frame_file_name(kind, number)), rows,
                                            width, height, channels, names, threads));
    };
    add("color", from.color.data(), from.width, from.height, 3, {});
    add("depth", from.depth.data(), from.columns, from.rows, 1, {});
    add("range", from.range.data(), from.columns, from.rows, 1, {});
    add("point", from.points().data(), from.columns, from.rows, 3, {"X", "Y", "Z"});
}

// The matrices that take points of each pose to the axes of the first: sixteen numbers a line, by rows.
std::string matrices_text(const std::vector<cm_pose> &poses)
{
    std::string text;
    for (const cm_pose &each : poses)
    {
        double matrix[16];
        check_scene(cm_texel_matrix(&poses.front(), &each, 1.0, matrix), "");
        for (int i = 0; i < 16; ++i)
        {
            char number[40];
            std::snprintf(number, sizeof number, "%.17g%c", matrix[i], i < 15 ? ' ' : '\n');
            text += number;
        }
    }
    return text;
}

void render_all(const TexelOptions &options, const World &world, const TimedPoses &poses,
                const cm_streams &streams)
{
    const OutputFolder folder(options.output);
    const PoolPointer pool = make_pool(options.threads);
    TexelPictures pictures(options.texel);
    const std::size_t count = poses.pose.size();
    Progress progress(static_cast<std::int64_t>(count), !options.quiet, streams.err);
    for (std::size_t i = 0; i < count; ++i)
    {
        FileList files;
        const cm_texel_image image = pictures.image();
        check_scene(
            cm_texel_render(world.scene.get(), &poses.pose[i], &options.texel, pool.get(), &image),
            "");
        write_pictures(folder, pictures, i, thread_count(options.threads), files);
        if (i + 1 == count)
        {
            write_text(folder.path_of(matrices_file), matrices_text(poses.pose), files);
        }
        bring_frame(folder, files, i, count, matrices_file);
        progress.advance(1);
    }
}

} // namespace

int render_texels(int argc, char **argv, const cm_streams &streams)
{
    const TexelOptions options = parse_texel_options(argc, argv, streams);
    if (options.printed)
    {
        return 0;
    }
    const World world = load_world(options.scene, make_brdf); // forks, and so before all else
    const TimedPoses poses = read_poses(options.path);
    check_memory("a texel image of " + std::to_string(options.texel.width) + " x " +
                     std::to_string(options.texel.height) + " pixels",
                 std::int64_t{options.texel.width} * options.texel.height, 1, 8 * sizeof(float));
    render_all(options, world, poses, streams);
    return 0;
}
