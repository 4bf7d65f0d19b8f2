// SPDX-License-Identifier: MIT

#include "face_parts.hpp"
#include "surface_text.hpp"
#include "texture_rules.hpp"
#include "tools/cli/program.hpp"
#include "tools/image/face_names.hpp"

#include <cubemap/frame.h>

#include <algorithm>
#include <cctype>
#include <utility>

namespace
{

constexpr std::size_t part_count = 6;

std::string lower(std::string text)
{
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    return text;
}

// Other words for the name of a face, as renderers have them: "px" and "posx" for "+x", "up" for "top".
std::string usual_name(const std::string &name)
{
    const std::string text = lower(name);
    const std::string axis = text.empty() ? "" : text.substr(text.size() - 1);
    if (text == "p" + axis || text == "pos" + axis)
    {
        return "+" + axis;
    }
    if (text == "n" + axis || text == "neg" + axis)
    {
        return "-" + axis;
    }
    return text == "up" ? "top" : text == "down" ? "bottom" : text;
}

std::string name_of(const ImageFile &part)
{
    const char *const name = part.stored().subimage_name;
    return name == nullptr ? "" : usual_name(name);
}

// Where in the file each face of the frame is; fewer than six if a name is missing.
std::vector<std::size_t> places_of(const cm_frame &frame, const std::vector<ImageFile> &parts)
{
    std::vector<std::size_t> places;
    for (const auto &face : frame.face)
    {
        for (std::size_t i = 0; i < parts.size(); ++i)
        {
            if (name_of(parts[i]) == face.name)
            {
                places.push_back(i);
                break;
            }
        }
    }
    return places;
}

} // namespace

void check_parts(const Options &options)
{
    if (!options.parts)
    {
        return;
    }
    if (is_pipe(options.output) || reproject_format(options.output) != "openexr")
    {
        throw UsageFailure(
            "--parts is for OpenEXR files, which can have several pictures; OUTPUT, " +
            in_quotes(options.output) + ", must end in .exr");
    }
    if (names_faces(options.output))
    {
        throw UsageFailure("--parts writes all six faces into one file; leave %f in " +
                           in_quotes(options.output) + " out");
    }
}

std::vector<std::string> part_names(const cm_surface &surface)
{
    const std::string specification = cm_surface_specification(&surface);
    if (cm_surface_picture_count(&surface) != part_count)
    {
        throw UsageFailure("--parts is for the six faces of a cube, and OUTPUT, " +
                           in_quotes(specification) + ", is one picture; leave --parts out");
    }
    std::vector<std::string> names;
    for (const auto &face : cm_frame_find(key_of(specification, "frame").c_str())->face)
    {
        names.emplace_back(face.name);
    }
    return names;
}

PartOrder order_parts(std::vector<ImageFile> &parts)
{
    static constexpr std::pair<const char *, PartOrder> known[] = {{"geo", PartOrder::geo},
                                                                   {"gl", PartOrder::gl}};
    for (const auto &[frame, order] : known)
    {
        const std::vector<std::size_t> places = places_of(*cm_frame_find(frame), parts);
        if (places.size() != part_count)
        {
            continue;
        }
        std::vector<ImageFile> ordered;
        for (const std::size_t place : places)
        {
            ordered.push_back(std::move(parts[place]));
        }
        parts = std::move(ordered);
        return order;
    }
    return PartOrder::file;
}

bool are_faces(const std::vector<ImageFile> &parts)
{
    return parts.size() == part_count &&
           std::all_of(parts.begin(), parts.end(),
                       [&parts](const ImageFile &part)
                       {
                           return part.width() == part.height() &&
                                  part.width() == parts.front().width() &&
                                  part.channels() == parts.front().channels();
                       });
}
