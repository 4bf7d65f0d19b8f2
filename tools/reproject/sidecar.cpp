// SPDX-License-Identifier: MIT

#include "sidecar.hpp"
#include "json_text.hpp"
#include "surface_text.hpp"

#include <filesystem>

std::string sidecar_name(const std::string &output)
{
    std::filesystem::path path(output);
    std::string stem = path.stem().string();
    for (const char *mark : {"_%f", "-%f", "%f"})
    {
        const std::size_t at = stem.find(mark);
        if (at != std::string::npos)
        {
            stem.erase(at, std::string(mark).size());
        }
    }
    return (path.parent_path() / ((stem.empty() ? "faces" : stem) + ".json")).string();
}

std::string sidecar_text(const cm_surface &surface, const std::optional<cm_rotation> &rotation,
                         const std::vector<std::string> &pictures, const std::string &filter)
{
    std::string files;
    for (const std::string &name : pictures)
    {
        files +=
            (files.empty() ? "" : ", ") + quoted(std::filesystem::path(name).filename().string());
    }
    const std::string turned =
        rotation && is_turned(*rotation) ? rotation_text(*rotation) : "0,0,0";
    return "{\n  \"surface\": " + quoted(cm_surface_specification(&surface)) +
           ",\n  \"rotation\": [" + turned + "],\n  \"pictures\": [" + files +
           "],\n  \"width\": " + std::to_string(cm_surface_width(&surface)) +
           ",\n  \"height\": " + std::to_string(cm_surface_height(&surface)) +
           ",\n  \"filter\": " + quoted(filter) + "\n}\n";
}
