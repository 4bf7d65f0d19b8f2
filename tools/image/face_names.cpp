// SPDX-License-Identifier: MIT

#include "face_names.hpp"

#include <filesystem>

namespace
{

constexpr const char *face_mark = "%f";

} // namespace

std::vector<std::string> face_names(const std::string &name)
{
    std::string pattern = name;
    if (!names_faces(pattern))
    {
        const std::string extension = std::filesystem::path(name).extension().string();
        pattern.insert(pattern.size() - extension.size(), std::string("_") + face_mark);
    }
    std::vector<std::string> names;
    for (int face = 0; face < 6; ++face)
    {
        std::string face_name = pattern;
        for (std::size_t at = 0; (at = face_name.find(face_mark, at)) != std::string::npos;)
        {
            face_name.replace(at, 2, std::to_string(face));
        }
        names.push_back(face_name);
    }
    return names;
}

bool names_faces(const std::string &name)
{
    return name.find(face_mark) != std::string::npos;
}

std::string name_list(const std::vector<std::string> &names)
{
    return names.front() + (names.size() > 1 ? " .. " + names.back() : "");
}
