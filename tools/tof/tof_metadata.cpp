// SPDX-License-Identifier: MIT

#include "tof_metadata.hpp"
#include "tof_table.h"

#include <cmath>
#include <new>

#include <cubemap/version.h>

namespace
{

// A tree of cJSON that is made: what cannot be added is a lack of memory.
void need(const void *made)
{
    if (made == nullptr)
    {
        throw std::bad_alloc();
    }
}

void add_text(cJSON *to, const char *key, const std::string &text)
{
    need(cJSON_AddStringToObject(to, key, text.c_str()));
}

void add_number(cJSON *to, const char *key, double number)
{
    need(cJSON_AddNumberToObject(to, key, number));
}

void add_switch(cJSON *to, const char *key, bool is_on)
{
    need(cJSON_AddBoolToObject(to, key, is_on));
}

void add_software(cJSON *to)
{
    cJSON *const software = cJSON_AddObjectToObject(to, "software");
    need(software);
    add_text(software, "program", "cubemap-tof simulate");
    add_text(software, "version", cm_version());
}

void add_numbers(cJSON *to, const char *key, const double *number, int count)
{
    cJSON *const list = cJSON_CreateDoubleArray(number, count);
    need(list);
    cJSON_AddItemToObject(to, key, list);
}

// Planes, boxes and so on with what they scatter; ids are those of truth.
void add_scene(cJSON *to, const std::string &source, const cm_scene *scene)
{
    static const char *const shapes[] = {"plane", "box", "sphere", "cylinder", "mesh"};
    cJSON *const about = cJSON_AddObjectToObject(to, "scene");
    need(about);
    add_text(about, "source", source);
    cJSON *const list = cJSON_AddArrayToObject(about, "materials");
    need(list);
    for (std::uint32_t id = 0; id < cm_scene_count(scene); ++id)
    {
        const cm_primitive &each = *cm_scene_at(scene, id);
        cJSON *const object = cJSON_CreateObject();
        need(object);
        cJSON_AddItemToArray(list, object);
        add_number(object, "object", id);
        add_text(object, "shape", shapes[each.kind]);
        add_number(object, "reflectance", each.material.reflectance);
        add_numbers(object, "color", each.material.color, 3);
        add_text(object, "brdf", each.brdf == nullptr ? "Lambert" : "as the scene's file has it");
        add_switch(object, "moves", each.motion != nullptr);
    }
}

void add_options(cJSON *to, const SimulateOptions &asked, const cm_tof_options &done,
                 const std::string &budget)
{
    cJSON *const options = cJSON_AddObjectToObject(to, "options");
    need(options);
    add_number(options, "bounces", done.bounces);
    add_number(options, "lights", done.lights == 0 ? 338 : done.lights);
    add_switch(options, "visibility", done.visibility != 0);
    add_number(options, "paths", done.paths == 0 ? 64 : done.paths);
    add_switch(options, "traced", is_traced(done));
    add_text(options, "samples",
             std::to_string(done.sample_columns) + "x" + std::to_string(done.sample_rows));
    add_switch(options, "full", done.full != 0);
    add_switch(options, "noise", done.noise != 0);
    add_text(options, "shot", tof_shot_names[done.shot]);
    add_number(options, "seed", static_cast<double>(done.seed));
    if (asked.environment)
    {
        add_text(options, "environment", *asked.environment);
        add_text(options, "environment_surface", asked.environment_surface.value_or("equirect"));
    }
    if (asked.budget)
    {
        add_number(options, "budget", *asked.budget);
        need(cJSON_AddRawToObject(to, "budget", budget.c_str()));
    }
}

void add_frames(cJSON *to, const TofSensor &sensor, const TimedPoses &poses)
{
    cJSON *const frames = cJSON_AddObjectToObject(to, "frames");
    need(frames);
    add_number(frames, "count", static_cast<double>(poses.time.size()));
    add_number(frames, "seconds_each", cm_tof_frame_time(&sensor.sensor));
    add_numbers(frames, "time", poses.time.data(), static_cast<int>(poses.time.size()));
}

// What a picture is called: a file of its own, or an array in one of HDF5.
std::string picture_name(int format, const std::string &name)
{
    switch (format)
    {
    case TOF_FORMAT_NPY:
        return name + "_FRAME.npy";
    case TOF_FORMAT_HDF5:
        return "frame_FRAME.h5/" + name;
    default:
        return name + (name == "phase" ? "_FRAME_PHASE.exr" : "_FRAME.exr");
    }
}

// What is truly there: parts of a file of OpenEXR, else arrays of their own.
void add_truth_files(cJSON *files, int format)
{
    static const char *const subjects[][2] = {
        {"position", "metres, X, Y, Z in the world; NaN where nothing is"},
        {"normal", "X, Y, Z in the world, of length 1, towards the camera; NaN where nothing is"},
        {"object", "number in scene.materials; 4294967295 where nothing is"},
        {"shape", "0 plane, 1 box, 2 sphere, 3 cylinder, 4 mesh; 4294967295 where nothing is"},
        {"triangle", "number in its mesh, 0 of other shapes; 4294967295 where nothing is"},
        {"depth",
         "metres along the optical axis, of cameras with a mapping along the ray; NaN where "
         "nothing is"},
        {"range", "metres along the ray; NaN where nothing is"},
        {"flow_next", "columns, rows and metres of range to the next frame"},
        {"flow_before", "columns, rows and metres of range to the frame before"}};
    if (format == TOF_FORMAT_EXR)
    {
        cJSON *const parts = cJSON_AddObjectToObject(files, "truth_FRAME.exr");
        need(parts);
        for (const auto &[name, what] : subjects)
        {
            add_text(parts, name, what);
        }
        add_text(parts, "effects", "1 or 0: flying, motion, multipath, nothing, saturated");
        return;
    }
    for (const auto &[name, what] : subjects)
    {
        add_text(files, picture_name(format, std::string("truth_") + name).c_str(), what);
    }
}

void add_files(cJSON *to, int format, bool with_truth)
{
    static const char *const pictures[][2] = {
        {"phase", "electrons of circuit A less those of B; phases of the second frequency follow"},
        {"distance", "metres along the ray; NaN where no light came back"},
        {"amplitude", "electrons"},
        {"intensity", "electrons of both circuits, mean over phases"}};
    cJSON *const files = cJSON_AddObjectToObject(to, "files");
    need(files);
    for (const auto &[name, what] : pictures)
    {
        add_text(files, picture_name(format, name).c_str(), what);
    }
    if (format != TOF_FORMAT_EXR)
    {
        add_text(files, picture_name(format, "flags").c_str(),
                 "sums of 1 saturated, 2 nothing came back, 4 flying, 8 motion, 16 multipath");
    }
    if (with_truth)
    {
        add_truth_files(files, format);
    }
    add_text(files, "poses.txt",
             "time tx ty tz qx qy qz qw, camera to world, at a frame's beginning");
}

} // namespace

bool is_traced(const cm_tof_options &options)
{
    return options.bounces > 1 || (options.bounces == 1 && options.traces != 0);
}

std::string metadata_text(const SimulateOptions &asked, const cm_tof_options &done,
                          const TofSensor &sensor, const cm_scene *scene, const TimedPoses &poses,
                          const std::string &budget)
{
    const JsonPointer all(cJSON_CreateObject(), cJSON_Delete);
    need(all.get());
    add_software(all.get());
    need(cJSON_AddNullToObject(all.get(), "temperature")); // nothing that warms up is simulated
    add_text(all.get(), "light_situation",
             !asked.environment ? "the lights of the sensor alone"
                                : "the lights of the sensor and the surroundings'");
    cJSON *const given = cJSON_Duplicate(sensor.text.get(), 1);
    need(given);
    cJSON_AddItemToObject(all.get(), "sensor", given);
    if (!asked.preset.empty())
    {
        add_text(all.get(), "preset", asked.preset);
    }
    add_scene(all.get(), asked.scene, scene);
    add_options(all.get(), asked, done, budget);
    add_text(all.get(), "postprocessing", "none");
    add_frames(all.get(), sensor, poses);
    add_files(all.get(), asked.format, asked.truth);
    const std::unique_ptr<char, void (*)(void *)> text(cJSON_Print(all.get()), cJSON_free);
    need(text.get());
    return std::string(text.get()) + "\n";
}
