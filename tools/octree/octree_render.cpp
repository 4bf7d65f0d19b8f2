// SPDX-License-Identifier: MIT
//
// cubemap-octree render and probe: what is seen of a map.

#include "octree_command.hpp"
#include "octree_map.hpp"
#include "octree_mesh.hpp"
#include "octree_table.h"

#include "tools/cli/float_picture.hpp"
#include "tools/cli/image_file.hpp"
#include "tools/cli/image_format.hpp"
#include "tools/image/face_names.hpp"

#include <algorithm>
#include <cmath>

namespace
{

struct SightOptions
{
    std::vector<std::string> names;
    std::string output;
    std::string depth;
    std::string mesh;
    std::string mesh_pose;
    std::optional<std::array<double, 3>> at;
    std::string to = "cube:coupled";
    std::uint32_t size = 128;
    std::optional<std::array<double, 3>> light;
    double far = 0;
    int level = 0;
    std::uint64_t memory = 0;
    int threads = 0;
    bool printed = false;
};

void read_sight_option(int id, OptionReader &reader, SightOptions &options)
{
    switch (id)
    {
    case OCTREE_OUTPUT:
        options.output = reader.text();
        break;
    case OCTREE_DEPTH:
        options.depth = reader.text();
        break;
    case OCTREE_MESH:
        options.mesh = reader.text();
        break;
    case OCTREE_MESH_POSE:
        options.mesh_pose = reader.text();
        break;
    case OCTREE_AT:
        options.at = read_place(reader);
        break;
    case OCTREE_TO:
        options.to = reader.text();
        break;
    case OCTREE_SIZE:
        options.size = static_cast<std::uint32_t>(reader.whole_number());
        break;
    case OCTREE_LIGHT:
        options.light = read_place(reader);
        break;
    case OCTREE_FAR:
        options.far = reader.number();
        break;
    case OCTREE_LEVEL:
        options.level = reader.whole_number();
        break;
    case OCTREE_MEMORY:
        options.memory = read_memory(reader);
        break;
    default:
        options.threads = reader.whole_number();
        break;
    }
}

SightOptions parse_sight_options(const cm_command &command, int argc, char **argv,
                                 const cm_streams &streams)
{
    SightOptions options;
    OptionReader reader(command, argc, argv, streams);
    while (const int id = reader.next())
    {
        read_sight_option(id, reader, options);
    }
    options.printed = reader.printed();
    options.names = reader.operands();
    return options;
}

// Pictures that are drawn, floats from 0 to 1 and depth.
struct Sight
{
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<float> color;
    std::vector<float> depth;
};

cm_image float_image(std::vector<float> &pixels, const Sight &sight, std::uint32_t channels)
{
    cm_image image = {};
    image.size = sizeof image;
    image.data = pixels.data();
    image.type = CM_PIXEL_FLOAT;
    image.width = sight.width;
    image.height = sight.height;
    image.channels = channels;
    return image;
}

Sight draw(const OctreeMap &open, const SightOptions &options, const cm_camera *camera,
           const cm_pose &pose, MeshCanvas *mesh)
{
    check_level(options.level, open.map.get(), options.names.front());
    const cm_camera_options &shape = *cm_camera_describe(camera);
    Sight sight;
    sight.width = shape.width;
    sight.height = shape.height;
    const std::size_t pixels = std::size_t{shape.width} * shape.height;
    sight.color.resize(3 * pixels);
    sight.depth.resize(pixels);
    const PoolPointer pool = make_pool(options.threads);
    cm_octree_shading shading = {};
    shading.size = sizeof shading;
    shading.coarsest = options.level;
    shading.far = options.far;
    shading.pool = pool.get();
    if (options.light)
    {
        shading.light = 1;
        std::copy(options.light->begin(), options.light->end(), shading.light_position);
    }
    if (mesh != nullptr)
    {
        mesh->draw(camera, pose, pool.get());
        shading.mesh = mesh->canvas();
        shading.mesh_color = mesh->colors();
    }
    cm_image color = float_image(sight.color, sight, 3);
    cm_image depth = float_image(sight.depth, sight, 1);
    check_map(cm_octree_render(open.map.get(), camera, &pose, &shading, &color, &depth),
              in_quotes(options.names.front()), open.store.get());
    return sight;
}

void check_depth_name(const std::string &path)
{
    const std::string format = path.empty() ? "openexr" : output_format(path);
    if (format != "openexr" && format != "tiff")
    {
        throw UsageFailure("--depth is " + in_quotes(path) +
                           ", whose format has no floats; give a .exr or .tif");
    }
}

int render(const SightOptions &options)
{
    if (options.names.size() != 3)
    {
        throw UsageFailure("MAP, CAMERA.json and POSE.txt are needed, " +
                           std::to_string(options.names.size()) +
                           (options.names.size() == 1 ? " is" : " are") + " given; see --help");
    }
    need_output(options.output, "VIEW");
    output_format(options.output);
    check_depth_name(options.depth);
    if (!options.mesh_pose.empty() && options.mesh.empty())
    {
        throw UsageFailure("--mesh-pose is of --mesh, which is not given");
    }
    std::optional<MeshCanvas> mesh;
    if (!options.mesh.empty())
    {
        mesh.emplace(options.mesh, options.mesh_pose); // forks, and so before all else
    }
    const CameraFile camera = read_camera(options.names[1]);
    const cm_pose pose = read_one_pose(options.names[2]);
    const cm_camera_options &shape = *cm_camera_describe(camera.camera.get());
    check_memory(in_quotes(options.names[1]) + ": a picture of " + std::to_string(shape.width) +
                     " x " + std::to_string(shape.height) + " pixels",
                 std::int64_t{shape.width} * shape.height, 4);
    const OctreeMap open = open_map(options.names[0], options.memory);
    const Sight sight = draw(open, options, camera.camera.get(), pose, mesh ? &*mesh : nullptr);
    const int width = static_cast<int>(sight.width);
    const int height = static_cast<int>(sight.height);
    std::vector<std::unique_ptr<AtomicFile>> files;
    files.push_back(write_float_picture(options.output, sight.color.data(), width, height, 3, {},
                                        options.threads));
    if (!options.depth.empty())
    {
        files.push_back(write_float_picture(options.depth, sight.depth.data(), width, height, 1, {},
                                            options.threads));
    }
    appear_together(files);
    return 0;
}

// ---- probes

using SurfacePointer = std::unique_ptr<cm_surface, HandleDeleter<cm_surface_destroy>>;

SurfacePointer probe_surface(const SightOptions &options)
{
    const std::string text = options.to + (options.to.find("size=") == std::string::npos
                                               ? ";size=" + std::to_string(options.size)
                                               : "");
    cm_surface *surface = nullptr;
    if (cm_surface_create(text.c_str(), nullptr, &surface) != CM_OK)
    {
        char message[400] = "";
        cm_surface_check(text.c_str(), nullptr, message, sizeof message);
        throw UsageFailure(std::string("--to: ") + message);
    }
    SurfacePointer owned(surface);
    if (cm_surface_mapping(surface) == nullptr)
    {
        throw UsageFailure("--to is " + in_quotes(options.to) +
                           ", which has no faces of a mapping; cube:coupled has, or octahedral");
    }
    return owned;
}

CameraPointer probe_camera(const SightOptions &options)
{
    const SurfacePointer surface = probe_surface(options);
    const cm_mapping *const mapping = cm_surface_mapping(surface.get());
    cm_camera_options shape = {};
    shape.size = sizeof shape;
    shape.width = cm_surface_plane_width(surface.get());
    shape.height = shape.width * (cm_mapping_describe(mapping)->kind == CM_KIND_CUBE ? 6u : 1u);
    shape.pixel_centre = 0.5;
    shape.mapping = mapping;
    cm_camera *camera = nullptr;
    const cm_status status = cm_camera_create(&shape, &camera);
    if (status == CM_ERROR_CAMERA)
    {
        throw UsageFailure("--to is " + in_quotes(options.to) +
                           ", which is not the sphere around a place");
    }
    check_map(status, "--to");
    return CameraPointer(camera);
}

int probe(const SightOptions &options)
{
    if (options.names.size() != 1)
    {
        throw UsageFailure("MAP is needed, " + std::to_string(options.names.size()) +
                           " are given; see --help");
    }
    need_output(options.output, "PROBE");
    if (!options.at)
    {
        throw UsageFailure("--at X,Y,Z is needed: where the probe is");
    }
    const CameraPointer camera = probe_camera(options);
    const cm_camera_options &shape = *cm_camera_describe(camera.get());
    const bool is_cube = shape.height != shape.width;
    const std::vector<std::string> names =
        is_cube ? face_names(options.output) : std::vector<std::string>{options.output};
    output_format(names.front());
    const OctreeMap open = open_map(options.names[0], options.memory);
    cm_pose pose = {};
    pose.rotation = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    std::copy(options.at->begin(), options.at->end(), pose.position);
    const Sight sight = draw(open, options, camera.get(), pose, nullptr);
    const std::size_t face = 3 * std::size_t{sight.width} * sight.width;
    const int edge = static_cast<int>(sight.width);
    std::vector<std::unique_ptr<AtomicFile>> files;
    for (std::size_t i = 0; i < names.size(); ++i)
    {
        files.push_back(write_float_picture(names[i], sight.color.data() + i * face, edge, edge, 3,
                                            {}, options.threads));
    }
    appear_together(files);
    return 0;
}

} // namespace

int render_octree(int argc, char **argv, const cm_streams &streams)
{
    const SightOptions options = parse_sight_options(octree_render_command, argc, argv, streams);
    return options.printed ? 0 : render(options);
}

int probe_octree(int argc, char **argv, const cm_streams &streams)
{
    const SightOptions options = parse_sight_options(octree_probe_command, argc, argv, streams);
    return options.printed ? 0 : probe(options);
}
