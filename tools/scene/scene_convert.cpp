// SPDX-License-Identifier: MIT

#include "scene_sequence.hpp"

#include "tools/cli/scene_handle.hpp"
#include "scene_table.h"
#include "tools/cli/program.hpp"
#include "tools/cli/progress.hpp"

#include <cstdio>
#include <optional>

namespace
{

struct ConvertOptions
{
    std::string folder;
    std::string output;
    std::string camera;
    std::optional<std::size_t> layout; // among the choices, which begin with CM_SEQUENCE_TUM
    bool quiet = false;
};

void check_convert_options(const ConvertOptions &options, std::size_t folders)
{
    if (folders != 1)
    {
        throw UsageFailure("one folder is needed, " + std::to_string(folders) +
                           " are given; see --help");
    }
    if (!options.layout || options.output.empty())
    {
        throw UsageFailure(std::string(options.layout ? "-o DIR2 is needed: the folder to write"
                                                      : "--to LAYOUT is needed") +
                           "; see --help");
    }
}

// The layout of a name, as the library has it.
cm_sequence_layout layout_of(std::size_t choice)
{
    static const char *const names[] = {"tum", "open3d", "7scenes"};
    cm_sequence_layout layout = CM_SEQUENCE_ANY;
    check_scene(cm_sequence_layout_find(names[choice], &layout), "");
    return layout;
}

// What whole units of the layout did not keep.
void tell_loss(const cm_sequence_loss &loss, const std::string &folder, std::FILE *to)
{
    if (loss.rounded > 0)
    {
        std::fprintf(to, "cubemap-scene: %s: %zu depths rounded by up to %.3g mm\n", folder.c_str(),
                     loss.rounded, 1e3 * loss.most);
    }
    if (loss.beyond > 0)
    {
        std::fprintf(to, "cubemap-scene: %s: %zu depths that 16 bits do not hold are left out\n",
                     folder.c_str(), loss.beyond);
    }
}

void convert(const ConvertOptions &options, const cm_streams &streams)
{
    const SequencePointer from = open_sequence(options.folder, options.camera);
    const cm_sequence_report &report = *cm_sequence_describe(from.get());
    const std::size_t count = cm_sequence_count(from.get());
    const SequenceWriterPointer to = create_sequence(options.output, layout_of(*options.layout),
                                                     report.camera, report.depth_scale);
    {
        const bool is_known = count != CM_SEQUENCE_UNKNOWN;
        Progress progress(is_known ? static_cast<std::int64_t>(count) : 1,
                          !options.quiet && is_known, streams.err);
        for_each_view(from.get(),
                      [&to, &progress](const cm_view &view)
                      {
                          char message[CM_IMAGE_MESSAGE] = "";
                          check_scene(cm_sequence_write(to.get(), &view, nullptr, message),
                                      message);
                          progress.advance(1);
                      });
    }
    const cm_sequence_loss loss = *cm_sequence_writer_loss(to.get());
    finish_sequence(to);
    if (!options.quiet)
    {
        tell_loss(loss, options.output, streams.err);
    }
}

} // namespace

int convert_scene(int argc, char **argv, const cm_streams &streams)
{
    ConvertOptions options;
    OptionReader reader(scene_convert_command, argc, argv, streams);
    while (const int id = reader.next())
    {
        switch (id)
        {
        case SCENE_OUTPUT:
            options.output = reader.text();
            break;
        case SCENE_TO:
            options.layout = reader.choice();
            break;
        case SCENE_CAMERA:
            options.camera = reader.text();
            break;
        default:
            options.quiet = true;
            break;
        }
    }
    if (reader.printed())
    {
        return 0;
    }
    const std::vector<std::string> names = reader.operands();
    check_convert_options(options, names.size());
    options.folder = names.front();
    convert(options, streams);
    return 0;
}
