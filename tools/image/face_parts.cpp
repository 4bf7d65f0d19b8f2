// SPDX-License-Identifier: MIT

#include "face_parts.hpp"
#include "tools/cli/lower_case.hpp"

#include <cubemap/frame.h>

#include <algorithm>
#include <utility>

namespace
{

constexpr std::size_t part_count = 6;

// Other words for the name of a face, as renderers have them: "px" and "posx" for "+x", "up" for "top".
std::string usual_name(const std::string &name)
{
    const std::string text = lower_case(name);
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
