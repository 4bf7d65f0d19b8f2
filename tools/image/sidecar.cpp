// SPDX-License-Identifier: MIT

#include "sidecar.hpp"
#include "json_text.hpp"
#include "surface_text.hpp"
#include "tools/cli/json_object.hpp"
#include "tools/cli/program.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace
{

// A file of this kind has no more bytes.
constexpr std::size_t bytes_most = std::size_t{1} << 20;

std::optional<std::string> small_content_of(const std::string &path)
{
    std::ifstream file(path, std::ios::binary);
    std::string text(bytes_most, '\0');
    file.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(file.gcount()));
    return text.empty() ? std::nullopt : std::optional<std::string>(text);
}

std::optional<SavedSurface> saved_in(const JsonObject &object)
{
    const auto surface = object.find("surface");
    SavedSurface saved;
    if (surface == object.end() || surface->second.size() != 1 ||
        cm_surface_check(surface->second.front().c_str(), nullptr, nullptr, 0) != CM_OK)
    {
        return std::nullopt;
    }
    saved.specification = surface->second.front();
    std::string angles;
    if (const auto rotation = object.find("rotation"); rotation != object.end())
    {
        for (const std::string &angle : rotation->second)
        {
            angles += (angles.empty() ? "" : ",") + angle;
        }
    }
    cm_rotation rotation;
    if (!angles.empty() && cm_rotation_parse(angles.c_str(), &rotation, nullptr, 0) != CM_OK)
    {
        return std::nullopt;
    }
    if (!angles.empty() && is_turned(rotation))
    {
        saved.rotation = rotation;
    }
    return saved;
}

} // namespace

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

std::optional<SavedSurface> surface_beside(const std::string &input, const std::string &picture)
{
    const std::string name = sidecar_name(input);
    const std::optional<std::string> text = small_content_of(name);
    const std::optional<JsonObject> object = text ? read_json_object(*text) : std::nullopt;
    if (!object || object->count("pictures") == 0)
    {
        return std::nullopt;
    }
    const std::vector<std::string> &pictures = object->at("pictures");
    const std::string own = std::filesystem::path(picture).filename().string();
    if (std::find(pictures.begin(), pictures.end(), own) == pictures.end())
    {
        return std::nullopt;
    }
    std::optional<SavedSurface> saved = saved_in(*object);
    if (saved)
    {
        saved->where = name;
    }
    return saved;
}

SavedSurface read_sidecar(const std::string &path)
{
    errno = 0;
    const std::optional<std::string> text = small_content_of(path);
    if (!text)
    {
        throw Failure(in_quotes(path) +
                      " cannot be read: " + (errno != 0 ? std::strerror(errno) : "it is empty"));
    }
    const std::optional<JsonObject> object = read_json_object(*text);
    const std::optional<SavedSurface> saved = object ? saved_in(*object) : std::nullopt;
    if (!saved)
    {
        throw Failure(in_quotes(path) + " says no surface that is known; a file that --sidecar has "
                                        "written does");
    }
    return *saved;
}
