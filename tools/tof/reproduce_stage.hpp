// SPDX-License-Identifier: MIT
//
// Scenes and sensors of experiments, which give back what they hold.

#ifndef CUBEMAP_TOOLS_TOF_REPRODUCE_STAGE_HPP
#define CUBEMAP_TOOLS_TOF_REPRODUCE_STAGE_HPP

#include <cstdint>
#include <memory>
#include <vector>

#include <cubemap/sim.h>

#include "tools/cli/scene_handle.hpp"

inline constexpr double half_turn = 3.14159265358979323846;

struct TofDeleter
{
    void operator()(cm_scene *owned) const noexcept
    {
        cm_scene_destroy(owned);
    }
    void operator()(cm_tof_scene *owned) const noexcept
    {
        cm_tof_scene_destroy(owned);
    }
    void operator()(cm_camera *owned) const noexcept
    {
        cm_camera_destroy(owned);
    }
    void operator()(cm_trajectory *owned) const noexcept
    {
        cm_trajectory_destroy(owned);
    }
    void operator()(cm_brdf *owned) const noexcept
    {
        cm_brdf_destroy(owned);
    }
};

template <class Owned> using TofPointer = std::unique_ptr<Owned, TofDeleter>;

// Fails with the text of a status that is not CM_OK.
void need(cm_status status);

// Pixels square, the axis in the middle of the picture.
TofPointer<cm_camera> make_pinhole(std::uint32_t width, std::uint32_t height, double aperture);

// One object, or several; motions and BRDFs must outlive what is made.
TofPointer<cm_tof_scene> make_stage(const std::vector<cm_primitive> &primitives);

// Along a straight line at a constant speed, from time -10 to 10, without turning; at time 0 it is where it was added.
TofPointer<cm_trajectory> make_line(const double velocity[3]);

cm_primitive plane_at(double x, double y, double z, double nx, double ny, double nz,
                      double reflectance);
cm_primitive box_between(double x, double y, double z, double to_x, double to_y, double to_z,
                         double reflectance);
cm_primitive sphere_at(double x, double y, double z, double radius, double reflectance);

// A camera of four phases at 20 MHz, whose frames take 0.2 s / 26.
cm_tof_sensor plain_sensor(const cm_camera *camera);

// A row of a pixel by parts of that width, 1 where it sees. Circuits see nothing: dual readout has one at both sides of a
// pixel, single readout one between any two active areas, which are half pixels.
std::vector<float> layout_mask(bool is_single, double pitch, double circuit, double part);

// Beside the camera, everywhere.
cm_tof_light plain_light();

// A frame's distances.
std::vector<float> distances(const cm_tof_scene *scene, const cm_tof_sensor &sensor,
                             const cm_tof_light &light, const cm_trajectory *trajectory,
                             double time, const cm_tof_options &options, cm_pool *pool);

#endif
