// SPDX-License-Identifier: MIT

#include "tof_sensor.hpp"

#include "modules/scene/io/camera_file.h"
#include "modules/scene/io/file_failure.hpp"
#include "modules/sim/io/sensor_ranges.h"
#include "tools/cli/json_members.hpp"
#include "tools/cli/program.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>

namespace
{

constexpr std::uint64_t sensor_bytes_most = std::uint64_t{1} << 26;
constexpr double whole_turn = 6.283185307179586;
constexpr double rounding = 1e-9;
constexpr double aperture_least = 1e-6;
constexpr std::size_t lights_most = 64;
constexpr std::size_t waves_most = 32; // of all series together
constexpr long phases_most = 64;
constexpr long shot_terms_most = 32;
constexpr long mask_most = 4096;

// Of a camera that measures: from the widest field to a kilometre's focal length, and parts of larger pictures.
constexpr double focal_least = 1e-3;
constexpr double focal_most = 1e9;
constexpr double centre_most = 1e9;
constexpr double position_most = 1e9; // metres, of a light; doubles are 0.1 um apart there

Range range_of(sensor_number_kind kind)
{
    return kind == SENSOR_NEEDED ? Range::above_zero
           : kind == SENSOR_PART ? Range::part
                                 : Range::zero_or_more;
}

double read_number(JsonMembers &members, const sensor_limit &limit)
{
    const double value = members.number(limit.name, range_of(limit.kind));
    if (!sensor_limit_allows(&limit, value))
    {
        char text[120];
        std::snprintf(text, sizeof text, " is %g, not a number from %g to %g%s", value, limit.least,
                      limit.most, limit.kind == SENSOR_OR_NONE && limit.least > 0 ? ", or 0" : "");
        members.fail(limit.name, text);
    }
    return value;
}

void read_numbers(JsonMembers &members, cm_tof_sensor &sensor)
{
    for (const sensor_limit &each : sensor_limits)
    {
        const double value = read_number(members, each);
        std::memcpy(reinterpret_cast<char *>(&sensor) + each.at, &value, sizeof value);
    }
    sensor.shot_least = members.number("shot_least", Range::zero_or_more);
    sensor.shot_most = members.number("shot_most", Range::zero_or_more);
}

// Of either sign.
void check_size(const JsonMembers &members, const char *key, const std::vector<double> &numbers,
                double most)
{
    for (const double each : numbers)
    {
        if (std::abs(each) > most)
        {
            char text[120];
            std::snprintf(text, sizeof text, " has %g, not a number from %g to %g", each, -most,
                          most);
            members.fail(key, text);
        }
    }
}

// What a camera's file may have, and no camera that measures has.
void check_lens(JsonMembers &camera)
{
    for (const char *const key : {"fx", "fy"})
    {
        camera.number(key, Range::above_zero, focal_least, focal_most);
    }
    for (const char *const key : {"cx", "cy"})
    {
        camera.number(key, Range::any, -centre_most, centre_most);
    }
}

// The camera is what a camera's file has, but for chips that mirror, of which there are none.
CameraPointer camera_of(const JsonPlace &place, JsonMembers &members)
{
    const cJSON *const json = members.find("camera");
    if (json == nullptr)
    {
        members.fail_missing("camera", "an object, as a camera's file has it");
    }
    if (!cJSON_IsObject(json))
    {
        members.fail("camera", " is not an object, as a camera's file has it");
    }
    JsonMembers parts(place, "camera", json);
    std::vector<std::string> names;
    for (const char *const *name = cm_camera_file_members; *name != nullptr; ++name)
    {
        names.emplace_back(*name);
    }
    parts.check_only(names);
    const cJSON *const mapping = parts.find("mapping");
    if (mapping == nullptr || (cJSON_IsString(mapping) && mapping->valuestring[0] == '\0'))
    {
        parts.number("fx", Range::above_zero);
        parts.number("fy", Range::above_zero);
    }
    const std::string_view own = text_of_item(place.text, place.root, json);
    const auto before = static_cast<std::size_t>(own.data() - place.text.data());
    std::string text(line_of_place(place.text, before) - 1, '\n'); // lines are the file's
    text += own;
    cm_camera *camera = nullptr;
    double depth_scale = 0;
    char message[CM_IMAGE_MESSAGE] = "";
    const cm_status status = cm_camera_file_parse(in_quotes(place.name).c_str(), text.data(),
                                                  text.size(), &camera, &depth_scale, message);
    if (status == CM_ERROR_MEMORY)
    {
        throw std::bad_alloc();
    }
    check_scene(status, message);
    CameraPointer made(camera);
    if (cm_camera_describe(camera)->mapping == nullptr)
    {
        check_lens(parts);
    }
    return made;
}

// By rows, as lists of their own or one after another.
void read_mask(JsonMembers &members, TofSensor &made)
{
    const cJSON *const rows = cJSON_IsArray(members.find("mask")) ? members.find("mask") : nullptr;
    const bool nested = rows != nullptr && cJSON_IsArray(rows->child);
    long columns = members.whole("mask_columns", 0, mask_most, 0);
    long count = members.whole("mask_rows", 0, mask_most, 0);
    if (!nested)
    {
        const std::vector<double> list = members.numbers("mask", Range::part_with_zero);
        made.mask.assign(list.begin(), list.end());
    }
    for (const cJSON *row = nested ? rows->child : nullptr; row != nullptr; row = row->next)
    {
        const long wide = cJSON_IsArray(row) ? cJSON_GetArraySize(row) : 0;
        columns = columns == 0 ? wide : columns;
        if (wide != columns || wide == 0)
        {
            members.fail("mask",
                         " has rows that are not of " + std::to_string(columns) + " numbers");
        }
        for (const cJSON *each = row->child; each != nullptr; each = each->next)
        {
            if (!cJSON_IsNumber(each) || !(each->valuedouble >= 0 && each->valuedouble <= 1))
            {
                members.fail("mask", " has what is not a number from 0 to 1");
            }
            made.mask.push_back(static_cast<float>(each->valuedouble));
        }
    }
    count = count == 0 && nested ? cJSON_GetArraySize(rows) : count;
    if (columns > mask_most || count > mask_most)
    {
        members.fail("mask", " has more than " + std::to_string(mask_most) + " columns or rows");
    }
    if (static_cast<std::size_t>(columns) * static_cast<std::size_t>(count) != made.mask.size())
    {
        members.fail("mask", " has " + std::to_string(made.mask.size()) + " numbers, not " +
                                 std::to_string(columns) + " columns of " + std::to_string(count));
    }
    made.sensor.mask_columns = static_cast<std::uint32_t>(columns);
    made.sensor.mask_rows = static_cast<std::uint32_t>(count);
    made.sensor.mask = made.mask.empty() ? nullptr : made.mask.data();
}

void read_signal(JsonMembers &members, TofSensor &made)
{
    const cJSON *const single = members.find("single_readout");
    made.sensor.single_readout = cJSON_IsBool(single)
                                     ? cJSON_IsTrue(single)
                                     : static_cast<int>(members.whole("single_readout", 0, 1, 0));
    made.sensor.phases = static_cast<int>(members.whole("phases", 3, phases_most, 0));
    if (made.sensor.phases == 0)
    {
        members.fail_missing("phases", "a whole number from 3 to " + std::to_string(phases_most));
    }
    made.harmonic = members.numbers("harmonic", Range::any);
    check_size(members, "harmonic", made.harmonic, SENSOR_HARMONIC_MOST);
    const long harmonics =
        members.whole("harmonics", 0, waves_most, static_cast<long>(made.harmonic.size()));
    const std::size_t series = made.sensor.second_frequency > 0 ? 2 : 1;
    if (static_cast<std::size_t>(harmonics) != made.harmonic.size() ||
        series * made.harmonic.size() > waves_most)
    {
        members.fail(made.harmonic.empty() ? "harmonics" : "harmonic",
                     " has " + std::to_string(made.harmonic.size()) + " numbers; there may be " +
                         std::to_string(waves_most / series) + ", and as many as harmonics says");
    }
    made.sensor.harmonics = made.harmonic.size();
    made.sensor.harmonic = made.harmonic.empty() ? nullptr : made.harmonic.data();
}

// A measured polynomial; how large it may become the library asks.
void read_shot(const JsonPlace &place, JsonMembers &members, TofSensor &made)
{
    made.shot_variance = members.numbers("shot_variance", Range::any);
    made.shot_line = line_of_item(place.text, place.root, members.find("shot_variance"));
    const std::size_t terms = made.shot_variance.size();
    const long said =
        members.whole("shot_terms", 0, shot_terms_most,
                      static_cast<long>(std::min(terms, std::size_t{shot_terms_most})));
    if (static_cast<std::size_t>(said) != terms)
    {
        members.fail("shot_variance", " has " + std::to_string(terms) + " numbers; there may be " +
                                          std::to_string(shot_terms_most) +
                                          ", and as many as shot_terms says");
    }
    if (terms > 0 &&
        !(made.sensor.shot_least >= 1 && made.sensor.shot_most > made.sensor.shot_least))
    {
        members.fail("shot_most", " is not above shot_least, which is 1 or more: from where to "
                                  "where shot_variance was measured");
    }
    made.sensor.shot_terms = terms;
    made.sensor.shot_variance = terms == 0 ? nullptr : made.shot_variance.data();
}

void read_light(const JsonPlace &place, const cJSON *json, std::size_t number, TofSensor &made)
{
    JsonMembers members(place, "lights[" + std::to_string(number) + "]", json);
    cm_tof_light light = {};
    light.size = sizeof light;
    members.take_numbers("position", Range::any, light.position, 3);
    check_size(members, "position", {light.position, light.position + 3}, position_most);
    members.take_numbers("direction", Range::any, light.direction, 3);
    light.power = members.number("power", Range::zero_or_more);
    light.aperture = members.number("aperture", Range::above_zero);
    if (light.aperture < aperture_least || light.aperture > whole_turn * (1 + rounding))
    {
        members.fail("aperture",
                     " is a full angle in radians, from 1e-6 to 2 pi, which is 6.283185307");
    }
    const std::vector<double> table = members.numbers("intensity", Range::zero_or_more);
    const long n = members.whole("n", 0, 1L << 24, static_cast<long>(table.size()));
    if (static_cast<std::size_t>(n) != table.size())
    {
        members.fail("n", " is not how many numbers intensity has");
    }
    members.check_known();
    const double most = table.empty() ? 0 : *std::max_element(table.begin(), table.end());
    if (most > double{std::numeric_limits<float>::max()} ||
        (most > 0 && most < double{std::numeric_limits<float>::min()}))
    {
        members.fail("intensity", most > 1 ? " has a number beyond those of single precision"
                                           : " has no number that single precision holds");
    }
    made.intensity.emplace_back(table.begin(), table.end());
    light.n = table.size();
    made.light.push_back(light);
}

void read_lights(const JsonPlace &place, JsonMembers &members, TofSensor &made)
{
    const cJSON *const list = members.find("lights");
    if (list == nullptr)
    {
        members.fail_missing("lights", "a list of one light or more");
    }
    if (!cJSON_IsArray(list) || list->child == nullptr)
    {
        members.fail("lights", " is not a list of one light or more");
    }
    for (const cJSON *each = list->child; each != nullptr; each = each->next)
    {
        if (made.light.size() == lights_most)
        {
            members.fail("lights", " has more than " + std::to_string(lights_most));
        }
        read_light(place, each, made.light.size(), made);
    }
    for (std::size_t i = 0; i < made.light.size(); ++i)
    {
        made.light[i].intensity = made.light[i].n == 0 ? nullptr : made.intensity[i].data();
    }
}

} // namespace

TofSensor parse_tof_sensor(const std::string &name, std::string_view text)
{
    TofSensor made;
    made.name = name;
    made.text = parse_json_file(name, text);
    const JsonPlace place = {name, text, made.text.get()};
    JsonMembers members(place, "", made.text.get());
    made.sensor.size = sizeof made.sensor;
    made.camera = camera_of(place, members);
    made.sensor.camera = made.camera.get();
    read_numbers(members, made.sensor);
    read_signal(members, made);
    read_mask(members, made);
    read_shot(place, members, made);
    read_lights(place, members, made);
    members.check_known();
    return made;
}

TofSensor read_tof_sensor(const std::string &path)
{
    std::string text;
    char message[CM_IMAGE_MESSAGE] = "";
    check_scene(guarded_file(message, [&] { text = read_whole(path, sensor_bytes_most); }),
                message);
    return parse_tof_sensor(path, text);
}
