// SPDX-License-Identifier: MIT

#include "camera_file.h"

#include "file_failure.hpp"
#include "parsed_json.hpp"

#include <cubemap/catalogue.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <string>
#include <vector>

const char *const cm_camera_file_members[] = {
    "width",      "height",      "fx",      "fy",    "cx",   "cy",   "pixel_centre",
    "distortion", "depth_scale", "mapping", "frame", "size", nullptr};

namespace
{

// "width, height, fx" and so on.
std::string list_of_members()
{
    std::string made;
    for (const char *const *name = cm_camera_file_members; *name != nullptr; ++name)
    {
        made += (made.empty() ? "" : ", ") + std::string(*name);
    }
    return made;
}

// A camera of more is a mistake: 2^31 pixels.
constexpr double camera_pixels_most = 2147483648.0;
constexpr std::uint64_t camera_bytes_most = std::uint64_t{1} << 20;
constexpr double usual_depth_scale = 5000.0;

using MappingPointer = std::unique_ptr<cm_mapping, decltype(&cm_mapping_destroy)>;

struct CameraNumbers
{
    cm_camera_options options = {};
    std::string mapping;
    std::string frame = "geo";
    double size = 0.0;
    double depth_scale = usual_depth_scale;
};

class CameraText
{
public:
    CameraText(const std::string &file_name, std::string_view whole) : name(file_name), text(whole)
    {
        JsonFault fault;
        object = parse_json_object(text, fault);
        if (!object)
        {
            fail_line(name, fault.line, fault.what);
        }
    }

    CameraNumbers read() const;
    cm_camera *make(CameraNumbers camera) const;

private:
    [[noreturn]] void fail(const cJSON *item, const std::string &what) const
    {
        fail_line(name, line_of_item(text, object.get(), item), what, CM_ERROR_CAMERA);
    }
    // Of a member, or of the whole if there is none.
    [[noreturn]] void fail(const char *key, const std::string &what) const
    {
        const cJSON *const item = member(key);
        fail(item == nullptr ? object.get() : item, what);
    }
    const cJSON *member(const char *key) const
    {
        return cJSON_GetObjectItemCaseSensitive(object.get(), key);
    }
    double number(const cJSON *item) const
    {
        if (!cJSON_IsNumber(item) || !std::isfinite(item->valuedouble))
        {
            fail(item, std::string(item->string) + " is not a finite number");
        }
        return item->valuedouble;
    }
    std::string word(const cJSON *item) const
    {
        if (!cJSON_IsString(item))
        {
            fail(item, std::string(item->string) + " is not a text");
        }
        return item->valuestring;
    }
    void take(const cJSON *item, CameraNumbers &camera) const;
    void take_distortion(const cJSON *item, CameraNumbers &camera) const;
    void check_keys() const;
    void check_perspective(CameraNumbers &camera) const;
    void check_size(double width, double height) const;
    [[noreturn]] void fail_refused(const cm_camera_options &options) const;
    MappingPointer make_mapping(const CameraNumbers &camera) const;

    std::string name;
    std::string_view text;
    JsonPointer object{nullptr, cJSON_Delete};
};

void CameraText::take_distortion(const cJSON *item, CameraNumbers &camera) const
{
    if (!cJSON_IsArray(item) || cJSON_GetArraySize(item) > 14)
    {
        fail("distortion", "distortion is not a list of at most 14 numbers");
    }
    std::size_t i = 0;
    const cJSON *each = nullptr;
    cJSON_ArrayForEach(each, item)
    {
        if (!cJSON_IsNumber(each) || !std::isfinite(each->valuedouble))
        {
            fail("distortion", "distortion has what is not a finite number");
        }
        camera.options.distortion[i++] = each->valuedouble;
    }
}

void CameraText::take(const cJSON *item, CameraNumbers &camera) const
{
    const std::string key = item->string;
    cm_camera_options &options = camera.options;
    const std::array<std::pair<const char *, double *>, 7> numbers = {
        {{"fx", &options.fx},
         {"fy", &options.fy},
         {"cx", &options.cx},
         {"cy", &options.cy},
         {"pixel_centre", &options.pixel_centre},
         {"depth_scale", &camera.depth_scale},
         {"size", &camera.size}}};
    for (const auto &[known, to] : numbers)
    {
        if (key == known)
        {
            *to = number(item);
            return;
        }
    }
    if (key == "mapping" || key == "frame")
    {
        (key == "frame" ? camera.frame : camera.mapping) = word(item);
    }
    else if (key == "distortion")
    {
        take_distortion(item, camera);
    }
    else if (key == "width" || key == "height")
    {
        number(item);
    }
    else
    {
        fail(item, "a camera has no " + key.substr(0, 40) + "; it may have " + list_of_members());
    }
}

void CameraText::check_size(double width, double height) const
{
    const bool whole =
        width >= 1.0 && height >= 1.0 && width == std::floor(width) && height == std::floor(height);
    if (!whole || width * height >= camera_pixels_most)
    {
        const char *const key = member("size") != nullptr ? "size"
                                : width == std::floor(width) && width >= 1.0 &&
                                        !(height == std::floor(height) && height >= 1.0)
                                    ? "height"
                                    : "width";
        fail(key, "a picture of " + number_text(width) + " x " + number_text(height) +
                      " pixels; whole numbers are wanted, and less than 2^31 pixels");
    }
}

void CameraText::check_perspective(CameraNumbers &camera) const
{
    for (const char *const key : {"width", "height", "fx", "fy", "cx", "cy"})
    {
        if (member(key) == nullptr)
        {
            fail(object.get(), std::string(key) + " is missing");
        }
    }
    for (const char *const key : {"frame", "size"})
    {
        if (member(key) != nullptr)
        {
            fail(key, std::string(key) + " is of cameras with a mapping");
        }
    }
    const double width = number(member("width"));
    const double height = number(member("height"));
    check_size(width, height);
    camera.options.width = static_cast<std::uint32_t>(width);
    camera.options.height = static_cast<std::uint32_t>(height);
}

void CameraText::check_keys() const
{
    for (const cJSON *item = object->child; item != nullptr; item = item->next)
    {
        for (const cJSON *other = item->next; other != nullptr; other = other->next)
        {
            if (std::strcmp(item->string, other->string) == 0)
            {
                fail(other, std::string(item->string) + " is given twice");
            }
        }
    }
}

CameraNumbers CameraText::read() const
{
    CameraNumbers camera;
    camera.options.size = sizeof camera.options;
    const cJSON *item = nullptr;
    // before what is named twice, which takes the square of their number
    cJSON_ArrayForEach(item, object.get())
    {
        take(item, camera);
        if (cJSON_GetArraySize(object.get()) > 20)
        {
            fail(object.get(), "something is given twice");
        }
    }
    check_keys();
    if (!(camera.depth_scale > 0.0 && std::isfinite(1.0 / camera.depth_scale)))
    {
        fail("depth_scale", "depth_scale is units of depth a metre, and greater than 0");
    }
    if (camera.mapping.empty())
    {
        check_perspective(camera);
        return camera;
    }
    for (const char *const key : {"width", "height", "fx", "fy", "cx", "cy", "distortion"})
    {
        if (member(key) != nullptr)
        {
            fail(key, std::string(key) + " is of cameras without a mapping");
        }
    }
    if (member("size") == nullptr)
    {
        fail(object.get(), "size is missing");
    }
    return camera;
}

MappingPointer CameraText::make_mapping(const CameraNumbers &camera) const
{
    const cm_frame *const frame = cm_frame_find(camera.frame.c_str());
    if (frame == nullptr)
    {
        fail("frame", "no frame is called \"" + camera.frame.substr(0, 40) + "\"");
    }
    char why[400] = "";
    cm_mapping *mapping = nullptr;
    const cm_status status = cm_mapping_create(camera.mapping.c_str(), frame, &mapping);
    if (status == CM_ERROR_MEMORY)
    {
        throw std::bad_alloc();
    }
    if (status != CM_OK)
    {
        cm_specification_check(camera.mapping.c_str(), why, sizeof why);
        fail("mapping", std::string("mapping: ") + why);
    }
    MappingPointer made(mapping, cm_mapping_destroy);
    const cm_mapping_info *const info = cm_mapping_describe(mapping);
    if (info->kind == CM_KIND_DISC_SQUARE)
    {
        fail("mapping",
             "mapping: " + std::string(info->identifier) +
                 " is between a disc and a square and has no directions; azimuthal:lambert, "
                 "border and octahedral have, on one face");
    }
    return made;
}

// Which member it is without which the library would take the camera.
void CameraText::fail_refused(const cm_camera_options &options) const
{
    struct Part
    {
        const char *key;
        std::string what;
        void (*clear)(cm_camera_options &);
    };
    const std::array<Part, 5> parts = {
        {{"fx", "a focal length of " + number_text(options.fx) + " as fx",
          [](cm_camera_options &to) { to.fx = 1.0; }},
         {"fy", "a focal length of " + number_text(options.fy) + " as fy",
          [](cm_camera_options &to) { to.fy = 1.0; }},
         {"pixel_centre",
          "pixel_centre is " + number_text(options.pixel_centre) + ", not from 0 to 1",
          [](cm_camera_options &to) { to.pixel_centre = 0.0; }},
         {"distortion", "distortion has a number beyond 1e150",
          [](cm_camera_options &to) { std::fill_n(to.distortion, 12, 0.0); }},
         {"distortion", "distortion has a tilt, its numbers 13 and 14, of a right angle or more",
          [](cm_camera_options &to) { to.distortion[12] = to.distortion[13] = 0.0; }}}};
    cm_camera_options left = options;
    for (const Part &part : parts)
    {
        cm_camera *made = nullptr;
        part.clear(left);
        const cm_status status = cm_camera_create(&left, &made);
        cm_camera_destroy(made);
        if (status == CM_OK)
        {
            fail(part.key, part.what);
        }
    }
    fail(object.get(), "no camera has these numbers");
}

cm_camera *CameraText::make(CameraNumbers camera) const
{
    MappingPointer mapping(nullptr, cm_mapping_destroy);
    if (!(camera.options.pixel_centre >= 0.0 && camera.options.pixel_centre <= 1.0))
    {
        fail("pixel_centre",
             "pixel_centre is " + number_text(camera.options.pixel_centre) + ", not from 0 to 1");
    }
    if (!camera.mapping.empty())
    {
        mapping = make_mapping(camera);
        const bool six = cm_mapping_describe(mapping.get())->kind == CM_KIND_CUBE;
        check_size(camera.size, (six ? 6.0 : 1.0) * camera.size);
        camera.options.mapping = mapping.get();
        camera.options.width = static_cast<std::uint32_t>(camera.size);
        camera.options.height = camera.options.width * (six ? 6 : 1);
    }
    cm_camera *made = nullptr;
    const cm_status status = cm_camera_create(&camera.options, &made);
    if (status == CM_ERROR_MEMORY)
    {
        throw std::bad_alloc();
    }
    if (status != CM_OK)
    {
        fail_refused(camera.options);
    }
    return made;
}

void read_camera(const std::string &name, std::string_view text, cm_camera **camera,
                 double *depth_scale)
{
    const CameraText read(name, text);
    const CameraNumbers numbers = read.read();
    *camera = read.make(numbers);
    *depth_scale = numbers.depth_scale;
}

// The parameters that are not the standard ones, each behind a letter: the first, then commas.
std::string parameters_text(const cm_mapping *mapping, char first)
{
    const cm_mapping_info *const info = cm_mapping_describe(mapping);
    std::string text;
    for (std::size_t i = 0; i < info->parameter_count; ++i)
    {
        const double value = cm_mapping_parameter(mapping, i);
        if (value != info->parameter[i].standard && std::isfinite(value))
        {
            text += (text.empty() ? first : ',') + std::string(info->parameter[i].name) + "=" +
                    number_text(value);
        }
    }
    return text;
}

// Have both the same bits in directions all around, on a spiral?
bool is_same_mapping(const cm_mapping *one, const cm_mapping *other)
{
    constexpr int directions = 64;
    for (int i = 0; i < directions; ++i)
    {
        const double z = 1.0 - (2.0 * i + 1.0) / directions;
        const double angle = 2.399963 * i; // the golden one, nearly
        const double across = std::sqrt(1.0 - z * z);
        const std::array<double, 3> at = {across * std::cos(angle), across * std::sin(angle), z};
        std::array<double, 2> uv{}, other_uv{};
        const bool same_face =
            cm_forward(one, at.data(), uv.data()) == cm_forward(other, at.data(), other_uv.data());
        if (!same_face || std::memcmp(uv.data(), other_uv.data(), sizeof uv) != 0)
        {
            return false;
        }
    }
    return true;
}

std::vector<std::string> part_names(cm_kind kind)
{
    std::vector<std::string> names;
    for (std::size_t i = 0; i < cm_catalogue_count(); ++i)
    {
        const cm_mapping_info *const info = cm_catalogue_at(i);
        const std::string name = info->identifier;
        if (info->kind == kind)
        {
            names.push_back(name.substr(name.find(':') + 1));
        }
    }
    return names;
}

// Of a layout: a mapping does not tell its parts, so all are tried.
std::string layout_text(const cm_mapping *mapping)
{
    const std::string name = cm_mapping_describe(mapping)->identifier;
    const std::string parameters = parameters_text(mapping, ',');
    const std::vector<std::string> squares = part_names(CM_KIND_DISC_SQUARE);
    for (const std::string &azimuthal : part_names(CM_KIND_AZIMUTHAL))
    {
        for (const std::string &square : squares)
        {
            const std::string text = name + ":" + azimuthal + "," + square + parameters;
            cm_mapping *tried = nullptr;
            const cm_status status =
                cm_mapping_create(text.c_str(), cm_mapping_frame(mapping), &tried);
            if (status == CM_ERROR_MEMORY)
            {
                throw std::bad_alloc();
            }
            const MappingPointer owned(tried, cm_mapping_destroy);
            if (status == CM_OK && is_same_mapping(mapping, tried))
            {
                return text;
            }
        }
    }
    return ""; // which makes none
}

// The specification that makes the mapping again. What a specification cannot say is refused.
std::string mapping_text(const cm_mapping *mapping)
{
    const cm_mapping_info *const info = cm_mapping_describe(mapping);
    const bool parts = info->parts != nullptr && cm_mapping_has_bounds(mapping) == 0;
    const std::string text =
        parts ? layout_text(mapping) : info->identifier + parameters_text(mapping, ':');
    if (cm_specification_check(text.c_str(), nullptr, 0) != CM_OK)
    {
        throw FileFailure(CM_ERROR_UNSUPPORTED,
                          "a camera whose mapping has no short text cannot be written");
    }
    return text;
}

std::string camera_text(const cm_camera *camera, double depth_scale)
{
    const cm_camera_options &options = *cm_camera_describe(camera);
    if (!(depth_scale > 0.0) || !std::isfinite(depth_scale))
    {
        throw FileFailure(CM_ERROR_CAMERA, "depth_scale is not a number greater than 0");
    }
    std::string text = "{";
    const auto add = [&text](const char *key, const std::string &value)
    { text += (text.size() > 1 ? ", \"" : "\"") + std::string(key) + "\": " + value; };
    if (options.mapping != nullptr)
    {
        add("mapping", "\"" + mapping_text(options.mapping) + "\"");
        const char *const frame = cm_mapping_frame(options.mapping)->identifier;
        if (cm_frame_find(frame) == nullptr)
        {
            throw FileFailure(CM_ERROR_UNSUPPORTED,
                              "a camera in a frame of one's own cannot be written");
        }
        add("frame", "\"" + std::string(frame) + "\"");
        add("size", std::to_string(options.width));
    }
    else
    {
        add("width", std::to_string(options.width));
        add("height", std::to_string(options.height));
        add("fx", number_text(options.fx));
        add("fy", number_text(options.fy));
        add("cx", number_text(options.cx));
        add("cy", number_text(options.cy));
        std::string list;
        for (const double coefficient : options.distortion)
        {
            list += (list.empty() ? "" : ", ") + number_text(coefficient);
        }
        add("distortion", "[" + list + "]");
    }
    add("pixel_centre", number_text(options.pixel_centre));
    add("depth_scale", number_text(depth_scale));
    return text + "}\n";
}

} // namespace

cm_status cm_camera_file_parse(const char *name, const char *text, size_t length,
                               cm_camera **camera, double *depth_scale, char *message)
{
    if (name == nullptr || text == nullptr || camera == nullptr || depth_scale == nullptr)
    {
        return CM_ERROR_ARGUMENT;
    }
    return guarded_file(message, [&] { read_camera(name, {text, length}, camera, depth_scale); });
}

cm_status cm_camera_file_read(const char *path, cm_camera **camera, double *depth_scale,
                              char *message)
{
    if (path == nullptr || camera == nullptr || depth_scale == nullptr)
    {
        return CM_ERROR_ARGUMENT;
    }
    return guarded_file(
        message,
        [&] { read_camera(path, read_whole(path, camera_bytes_most), camera, depth_scale); });
}

cm_status cm_camera_file_format(const cm_camera *camera, double depth_scale, char **text,
                                char *message)
{
    if (camera == nullptr || text == nullptr)
    {
        return CM_ERROR_ARGUMENT;
    }
    return guarded_file(message,
                        [&]
                        {
                            const std::string made = camera_text(camera, depth_scale);
                            char *const copy = static_cast<char *>(std::malloc(made.size() + 1));
                            if (copy == nullptr)
                            {
                                throw std::bad_alloc();
                            }
                            std::memcpy(copy, made.c_str(), made.size() + 1);
                            *text = copy;
                        });
}

cm_status cm_camera_file_write(const char *path, const cm_camera *camera, double depth_scale,
                               char *message)
{
    if (path == nullptr || camera == nullptr)
    {
        return CM_ERROR_ARGUMENT;
    }
    return guarded_file(message, [&] { write_whole(path, camera_text(camera, depth_scale)); });
}
