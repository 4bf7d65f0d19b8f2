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
    std::optional<std::uint32_t> size;
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

constexpr std::uint32_t usual_size = 128;

// Is a plane of a surface as it lies in the picture of a camera, where planes are one below the other? Asked at a place that no
// turn and no flip brings to itself.
bool is_plane_of(const cm_surface *surface, const cm_camera *camera, std::uint8_t plane)
{
    const double edge = cm_surface_plane_width(surface);
    const double column = 0.3 * edge;
    const double row = 0.1 * edge;
    const double row_below = row + plane * edge;
    double wanted[3];
    double drawn[3];
    cm_surface_directions(surface, 1, &plane, &column, &row, &wanted[0], &wanted[1], &wanted[2]);
    cm_camera_ray_array(camera, 1, &column, &row_below, &drawn[0], &drawn[1], &drawn[2]);
    return std::hypot(wanted[0] - drawn[0], wanted[1] - drawn[1], wanted[2] - drawn[2]) < 1e-9;
}

// A camera sees the planes of a surface one below the other: UsageFailure if it does not see these.
void check_planes(const cm_surface *surface, const cm_camera *camera, const std::string &name)
{
    const std::size_t count = cm_surface_plane_count(surface);
    bool is_seen = cm_camera_describe(camera)->height == count * cm_surface_plane_width(surface);
    for (std::size_t plane = 0; is_seen && plane < count; ++plane)
    {
        is_seen = is_plane_of(surface, camera, static_cast<std::uint8_t>(plane));
    }
    if (!is_seen)
    {
        throw UsageFailure("--to is " + in_quotes(name) +
                           ", but a probe is drawn on one square or on six faces; "
                           "cubemap-reproject makes others of them");
    }
}

SurfacePointer probe_surface(const SightOptions &options)
{
    const bool has_size = options.to.find("size=") != std::string::npos;
    if (has_size && options.size)
    {
        throw UsageFailure("--to is " + in_quotes(options.to) +
                           ", which has a size already; leave it out, or --size");
    }
    const std::string text =
        options.to + (has_size ? "" : ";size=" + std::to_string(options.size.value_or(usual_size)));
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

CameraPointer probe_camera(const SightOptions &options, const cm_surface *surface)
{
    const cm_mapping *const mapping = cm_surface_mapping(surface);
    cm_camera_options shape = {};
    shape.size = sizeof shape;
    shape.width = cm_surface_plane_width(surface);
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
    CameraPointer owned(camera);
    check_planes(surface, camera, options.to);
    return owned;
}

// The pictures of a surface, of colours on its planes one below the other; black where there is no plane.
std::vector<std::vector<float>> lay_out(const cm_surface *surface, const Sight &sight)
{
    const std::uint32_t edge = sight.width;
    const std::size_t width = cm_surface_width(surface);
    std::vector<std::vector<float>> pictures(
        cm_surface_picture_count(surface),
        std::vector<float>(3 * width * cm_surface_height(surface)));
    for (std::uint32_t row = 0; row < sight.height; ++row)
    {
        for (std::uint32_t column = 0; column < edge; ++column)
        {
            std::uint32_t picture = 0;
            std::uint32_t to_column = 0;
            std::uint32_t to_row = 0;
            cm_surface_pixel(surface, row / edge, column, row % edge, &picture, &to_column,
                             &to_row);
            std::copy_n(&sight.color[3 * (std::size_t{row} * edge + column)], 3,
                        &pictures[picture][3 * (to_row * width + to_column)]);
        }
    }
    return pictures;
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
    const SurfacePointer surface = probe_surface(options);
    const CameraPointer camera = probe_camera(options, surface.get());
    const std::vector<std::string> names = cm_surface_picture_count(surface.get()) > 1
                                               ? face_names(options.output)
                                               : std::vector<std::string>{options.output};
    output_format(names.front());
    const OctreeMap open = open_map(options.names[0], options.memory);
    cm_pose pose = {};
    pose.rotation = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    std::copy(options.at->begin(), options.at->end(), pose.position);
    const Sight sight = draw(open, options, camera.get(), pose, nullptr);
    const std::vector<std::vector<float>> pictures = lay_out(surface.get(), sight);
    const int width = static_cast<int>(cm_surface_width(surface.get()));
    const int height = static_cast<int>(cm_surface_height(surface.get()));
    std::vector<std::unique_ptr<AtomicFile>> files;
    for (std::size_t i = 0; i < names.size(); ++i)
    {
        files.push_back(write_float_picture(names[i], pictures[i].data(), width, height, 3, {},
                                            options.threads));
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
