// SPDX-License-Identifier: MIT

#include "octree_command.hpp"
#include "octree_map.hpp"
#include "octree_table.h"

#include <algorithm>
#include <cstring>

namespace
{

struct HullOptions
{
    std::string folder;
    std::string output;
    std::string camera;
    cm_octree_options map = standard_map();
    bool survives = true;
    int threads = 0;
    bool json = false;
    bool quiet = false;
    bool printed = false;
};

HullOptions parse_hull_options(int argc, char **argv, const cm_streams &streams)
{
    HullOptions options;
    OptionReader reader(octree_hull_command, argc, argv, streams);
    while (const int id = reader.next())
    {
        if (read_grid_option(id, reader, options.map))
        {
            continue;
        }
        switch (id)
        {
        case OCTREE_OUTPUT:
            options.output = reader.text();
            break;
        case OCTREE_OUTSIDE:
            options.survives = reader.choice() == 0;
            break;
        case OCTREE_CAMERA:
            options.camera = reader.text();
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
    options.printed = reader.printed();
    if (!options.printed)
    {
        options.folder = needed_operands(reader, 1, "DIR").front();
        need_output(options.output, "MAP");
    }
    return options;
}

// Masks with memory of their own: those of a sequence live until the next view is asked for.
class MaskList
{
public:
    void add(const cm_view &view)
    {
        const cm_image &from = view.color;
        const std::size_t pixel = from.channels * cm_pixel_size(from.type);
        const std::size_t colors = pixel - (from.channels % 2 == 0 ? cm_pixel_size(from.type) : 0);
        const std::ptrdiff_t step =
            from.pixel_stride != 0 ? from.pixel_stride : static_cast<std::ptrdiff_t>(pixel);
        const std::ptrdiff_t row_step =
            from.row_stride != 0 ? from.row_stride : step * static_cast<std::ptrdiff_t>(from.width);
        std::vector<unsigned char> inside(std::size_t{from.width} * from.height);
        for (std::size_t i = 0; i < inside.size(); ++i)
        {
            const auto *const at = static_cast<const unsigned char *>(from.data) +
                                   static_cast<std::ptrdiff_t>(i / from.width) * row_step +
                                   static_cast<std::ptrdiff_t>(i % from.width) * step;
            // What hides, the last of two or four channels, is no color. Of every type the bytes of 0 are 0; of floats -0 is left, which no picture has
            inside[i] = std::any_of(at, at + colors, [](unsigned char byte) { return byte != 0; });
        }
        pictures.push_back(std::move(inside));
        cm_view copy = view;
        copy.depth.data = nullptr;
        copy.amplitude.data = nullptr;
        copy.color = {};
        copy.color.size = sizeof copy.color;
        copy.color.type = CM_PIXEL_U8;
        copy.color.width = from.width;
        copy.color.height = from.height;
        copy.color.channels = 1;
        copies.push_back(copy);
    }

    const std::vector<cm_view> &views()
    {
        for (std::size_t i = 0; i < copies.size(); ++i)
        {
            copies[i].color.data = pictures[i].data();
        }
        return copies;
    }

private:
    std::vector<std::vector<unsigned char>> pictures;
    std::vector<cm_view> copies;
};

MaskList read_masks(cm_sequence *sequence, const std::string &folder)
{
    MaskList masks;
    std::size_t number = 0;
    for_each_view(sequence,
                  [&](const cm_view &view)
                  {
                      ++number;
                      if (view.color.data == nullptr)
                      {
                          throw Failure(in_quotes(folder) + ": view " + std::to_string(number) +
                                        " has no colours, which are the mask");
                      }
                      masks.add(view);
                  });
    return masks;
}

int carve(const HullOptions &options, const cm_streams &streams)
{
    const SequencePointer sequence = open_sequence(options.folder, options.camera, true);
    MaskList masks = read_masks(sequence.get(), options.folder);
    const std::vector<cm_view> &views = masks.views();
    cm_octree *made = nullptr;
    const cm_status status = cm_octree_create(&options.map, &made);
    if (status == CM_ERROR_RANGE)
    {
        throw UsageFailure("--edge, --centre and --levels do not go together");
    }
    check_map(status, in_quotes(options.output));
    const OctreePointer map(made);
    const PoolPointer pool = make_pool(options.threads);
    check_map(cm_hull_carve(made, views.size(), views.data(), options.survives ? 1 : 0, pool.get()),
              in_quotes(options.folder));
    check_map(cm_octree_compact(made), in_quotes(options.output));
    OctreeRun run;
    run.views = views.size();
    run.settings = "hull";
    save_map(made, options.output, run);
    const cm_octree_count count = count_map(made, options.output);
    if (options.json)
    {
        print(streams, "{\"views\": " + std::to_string(run.views) +
                           ", \"occupied\": " + std::to_string(count.occupied) +
                           ", \"free\": " + std::to_string(count.free) +
                           ", \"bytes\": " + std::to_string(count.bytes) + "}\n");
    }
    else if (!options.quiet)
    {
        print(streams, in_quotes(options.output) + ": the hull of " + std::to_string(run.views) +
                           " masks, " + std::to_string(count.occupied) + " voxels\n");
    }
    return 0;
}

} // namespace

int carve_hull(int argc, char **argv, const cm_streams &streams)
{
    const HullOptions options = parse_hull_options(argc, argv, streams);
    return options.printed ? 0 : carve(options, streams);
}
