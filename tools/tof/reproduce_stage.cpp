// SPDX-License-Identifier: MIT

#include "reproduce_stage.hpp"

#include "tools/cli/program.hpp"

#include <cmath>

void need(cm_status status)
{
    if (status == CM_ERROR_MEMORY)
    {
        throw std::bad_alloc();
    }
    if (status != CM_OK)
    {
        throw Failure(cm_status_text(status));
    }
}

TofPointer<cm_camera> make_pinhole(std::uint32_t width, std::uint32_t height, double aperture)
{
    cm_camera_options options = {};
    options.size = sizeof options;
    options.width = width;
    options.height = height;
    options.fx = 0.5 * width / std::tan(0.5 * aperture);
    options.fy = options.fx;
    options.cx = 0.5 * width;
    options.cy = 0.5 * height;
    options.pixel_centre = 0.5;
    cm_camera *camera = nullptr;
    need(cm_camera_create(&options, &camera));
    return TofPointer<cm_camera>(camera);
}

TofPointer<cm_tof_scene> make_stage(const std::vector<cm_primitive> &primitives)
{
    cm_scene *made = nullptr;
    need(cm_scene_create(&made));
    const TofPointer<cm_scene> world(made);
    for (const cm_primitive &each : primitives)
    {
        need(cm_scene_add(made, &each, nullptr));
    }
    cm_tof_scene *scene = nullptr;
    need(cm_tof_scene_create(made, &scene));
    return TofPointer<cm_tof_scene>(scene);
}

TofPointer<cm_trajectory> make_line(const double velocity[3])
{
    constexpr double stamps[2] = {-10, 10};
    cm_pose poses[2] = {};
    for (int i = 0; i < 2; ++i)
    {
        poses[i].rotation = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
        for (int k = 0; k < 3; ++k)
        {
            poses[i].position[k] = stamps[i] * velocity[k];
        }
    }
    cm_trajectory *made = nullptr;
    need(cm_trajectory_create(2, stamps, poses, &made, nullptr));
    return TofPointer<cm_trajectory>(made);
}

namespace
{

cm_primitive empty_of(cm_primitive_kind kind, double reflectance)
{
    cm_primitive made = {};
    made.size = sizeof made;
    made.kind = kind;
    made.pose.rotation = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    made.material = {{1, 1, 1}, reflectance};
    return made;
}

void put(double to[3], double x, double y, double z)
{
    to[0] = x;
    to[1] = y;
    to[2] = z;
}

} // namespace

cm_primitive plane_at(double x, double y, double z, double nx, double ny, double nz,
                      double reflectance)
{
    cm_primitive made = empty_of(CM_PRIMITIVE_PLANE, reflectance);
    put(made.first, x, y, z);
    put(made.second, nx, ny, nz);
    return made;
}

cm_primitive box_between(double x, double y, double z, double to_x, double to_y, double to_z,
                         double reflectance)
{
    cm_primitive made = empty_of(CM_PRIMITIVE_BOX, reflectance);
    put(made.first, x, y, z);
    put(made.second, to_x, to_y, to_z);
    return made;
}

cm_primitive sphere_at(double x, double y, double z, double radius, double reflectance)
{
    cm_primitive made = empty_of(CM_PRIMITIVE_SPHERE, reflectance);
    put(made.first, x, y, z);
    made.radius = radius;
    return made;
}

cm_tof_sensor plain_sensor(const cm_camera *camera)
{
    cm_tof_sensor sensor = {};
    sensor.size = sizeof sensor;
    sensor.camera = camera;
    sensor.pitch = 12e-6;
    sensor.f_number = 1;
    sensor.wavelength = 850e-9;
    sensor.efficiency = 0.4;
    sensor.exposure = 1e-3;
    sensor.readout = 0.2 / 26 / 4 - sensor.exposure;
    sensor.frequency = 20e6;
    sensor.duty = 0.5;
    sensor.contrast = 0.8;
    sensor.phases = 4;
    return sensor;
}

std::vector<float> layout_mask(bool is_single, double pitch, double circuit, double part)
{
    const int areas = is_single ? 2 : 1;
    const double border = is_single ? 0.5 * circuit : circuit;
    std::vector<float> mask;
    for (long i = 0; i < std::lround(pitch / part); ++i)
    {
        const double place = std::fmod((static_cast<double>(i) + 0.5) * part, pitch / areas);
        mask.push_back(place > border && place < pitch / areas - border ? 1.0f : 0.0f);
    }
    return mask;
}

cm_tof_light plain_light()
{
    cm_tof_light light = {};
    light.size = sizeof light;
    light.power = 1;
    light.aperture = 6.28318530717958648;
    return light;
}

std::vector<float> distances(const cm_tof_scene *scene, const cm_tof_sensor &sensor,
                             const cm_tof_light &light, const cm_trajectory *trajectory,
                             double time, const cm_tof_options &options, cm_pool *pool)
{
    const cm_camera_options &shape = *cm_camera_describe(sensor.camera);
    std::vector<float> distance(std::size_t{shape.width} * shape.height);
    cm_tof_result result = {};
    result.size = sizeof result;
    result.distance = distance.data();
    need(cm_tof_simulate(scene, &sensor, &light, 1, trajectory, time, &options, pool, &result));
    return distance;
}
