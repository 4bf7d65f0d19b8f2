// SPDX-License-Identifier: MIT

#include "surface_tags.hpp"
#include "surface_text.hpp"

#include <cubemap/number.h>
#include <cubemap/panorama.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <sstream>

namespace
{

constexpr const char *surface_tag = "cubemap:surface";
constexpr const char *rotation_tag = "cubemap:rotation";
constexpr const char *description_tag = "ImageDescription";

bool holds_own_tags(const std::string &format)
{
    const auto is = [&format](const char *name) { return format == name; };
    static constexpr const char *const formats[] = {"png", "openexr", "fits", "hdr", "ppm", "pgm"};
    return std::any_of(std::begin(formats), std::end(formats), is);
}

std::string tag_text(const cm_image_description &stored, const std::string &key)
{
    for (std::size_t i = 0; i < stored.tag_count; ++i)
    {
        if (key == stored.tags[i].key)
        {
            return stored.tags[i].text;
        }
    }
    return "";
}

// The value of a line NAME=VALUE.
std::string line_value(const std::string &text, const std::string &name)
{
    std::istringstream lines(text);
    std::string line;
    while (std::getline(lines, line))
    {
        if (line.compare(0, name.size() + 1, name + "=") == 0)
        {
            return line.substr(name.size() + 1);
        }
    }
    return "";
}

std::string read_tag(const ImageFile &image, const char *name)
{
    const std::string own = tag_text(image.stored(), name);
    return own.empty() ? line_value(tag_text(image.stored(), description_tag), name) : own;
}

// What people have written, without our lines.
std::string others_lines(const std::string &text)
{
    std::istringstream lines(text);
    std::string kept;
    std::string line;
    while (std::getline(lines, line))
    {
        if (line.compare(0, std::strlen("cubemap:"), "cubemap:") != 0)
        {
            kept += (kept.empty() ? "" : "\n") + line;
        }
    }
    return kept;
}

void set_description(ImageDescription &held, const std::string &ours)
{
    const auto is_it = [](const ImageTag &tag) { return tag.key == description_tag; };
    const auto found = std::find_if(held.tags.begin(), held.tags.end(), is_it);
    const std::string others = found == held.tags.end() ? "" : others_lines(found->text);
    if (found == held.tags.end() && ours.empty())
    {
        return;
    }
    held.set(description_tag, others + (others.empty() || ours.empty() ? "" : "\n") + ours);
}

} // namespace

namespace
{

// Metadata stand at the begin of files, or at their end.
constexpr std::size_t looked_at = std::size_t{1} << 18;

// The packet of XMP in a part of a file; "" if there is none. What reads image files leaves out what it does not know.
std::string xmp_in(const std::string &bytes)
{
    const std::string last = "</x:xmpmeta>";
    const std::size_t begin = bytes.find("<x:xmpmeta");
    const std::size_t end = begin == std::string::npos ? begin : bytes.find(last, begin);
    return end == std::string::npos ? "" : bytes.substr(begin, end + last.size() - begin);
}

std::string xmp_of(const std::string &path)
{
    std::ifstream file(path, std::ios::binary);
    std::string bytes(looked_at, '\0');
    file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    bytes.resize(static_cast<std::size_t>(file.gcount()));
    const std::string first = xmp_in(bytes);
    if (!first.empty() || !file)
    {
        return first;
    }
    file.seekg(0, std::ios::end);
    const std::streamoff size = file.tellg();
    file.seekg(std::max<std::streamoff>(0, size - static_cast<std::streamoff>(looked_at)));
    bytes.resize(looked_at);
    file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    bytes.resize(static_cast<std::size_t>(file.gcount()));
    return xmp_in(bytes);
}

std::optional<SavedSurface> photo_sphere(const ImageFile &image)
{
    const std::string xmp = image.is_stream() ? "" : xmp_of(image.path());
    cm_panorama panorama = {};
    panorama.size = sizeof panorama;
    if (xmp.empty() || cm_panorama_read(xmp.data(), xmp.size(), &panorama) != CM_OK)
    {
        return std::nullopt;
    }
    char text[400];
    cm_rotation rotation;
    // of the size that the fields say, which an edited picture does not have
    const bool has_size = panorama.cropped_width > 0 && panorama.cropped_height > 0;
    const auto width = static_cast<std::uint32_t>(image.width());
    const auto height = static_cast<std::uint32_t>(image.height());
    if (cm_panorama_surface(&panorama, has_size ? panorama.cropped_width : width,
                            has_size ? panorama.cropped_height : height, text, sizeof text,
                            &rotation) != CM_OK)
    {
        return std::nullopt;
    }
    SavedSurface saved;
    saved.specification = text;
    if (is_turned(rotation))
    {
        saved.rotation = rotation;
    }
    return saved;
}

void save_photo_sphere(ImageDescription &held, const cm_surface &surface)
{
    cm_panorama panorama = {};
    panorama.size = sizeof panorama;
    if (cm_panorama_of_surface(&surface, &panorama) != CM_OK)
    {
        return;
    }
    const auto pixels = [&held](const char *name, std::uint32_t value)
    { held.set_number(std::string("GPano:") + name, static_cast<int>(value)); };
    const auto degrees = [&held](const char *name, double value)
    {
        char text[CM_NUMBER_SIZE];
        cm_number_write(value, 15, text);
        held.set(std::string("GPano:") + name, text);
    };
    held.set("GPano:ProjectionType", "equirectangular");
    pixels("FullPanoWidthPixels", panorama.full_width);
    pixels("FullPanoHeightPixels", panorama.full_height);
    pixels("CroppedAreaLeftPixels", panorama.cropped_left);
    pixels("CroppedAreaTopPixels", panorama.cropped_top);
    pixels("CroppedAreaImageWidthPixels", panorama.cropped_width);
    pixels("CroppedAreaImageHeightPixels", panorama.cropped_height);
    degrees("PoseHeadingDegrees", panorama.heading);
    degrees("PosePitchDegrees", panorama.pitch);
    degrees("PoseRollDegrees", panorama.roll);
}

} // namespace

namespace
{

std::optional<SavedSurface> own_tag(const ImageFile &image)
{
    SavedSurface saved;
    saved.specification = read_tag(image, surface_tag);
    if (saved.specification.empty() ||
        cm_surface_check(saved.specification.c_str(), nullptr, nullptr, 0) != CM_OK)
    {
        return std::nullopt;
    }
    const std::string turned = read_tag(image, rotation_tag);
    cm_rotation rotation;
    if (!turned.empty())
    {
        if (cm_rotation_parse(turned.c_str(), &rotation, nullptr, 0) != CM_OK)
        {
            return std::nullopt;
        }
        saved.rotation = rotation;
    }
    return saved;
}

} // namespace

std::optional<SavedSurface> saved_surface(const ImageFile &image)
{
    std::optional<SavedSurface> own = own_tag(image);
    if (own && size_of_then(*own, image) == SizeThen::same)
    {
        return own;
    }
    // who cuts panoramas may know of the fields, and not of the tag
    std::optional<SavedSurface> photo = photo_sphere(image);
    return !own || (photo && size_of_then(*photo, image) == SizeThen::same) ? photo : own;
}

SizeThen size_of_then(const SavedSurface &saved, const ImageFile &image)
{
    std::string message;
    const SurfacePointer then = make_surface(saved.specification, 0, 0, {}, message);
    if (!then)
    {
        return SizeThen::same; // it says none
    }
    const auto width = static_cast<double>(cm_surface_width(then.get()));
    const auto height = static_cast<double>(cm_surface_height(then.get()));
    if (width == image.width() && height == image.height())
    {
        return SizeThen::same;
    }
    // of a picture that is scaled each edge is rounded to whole pixels
    const bool scaled = std::abs(image.width() - width * image.height() / height) <= 1 ||
                        std::abs(image.height() - height * image.width() / width) <= 1;
    return scaled ? SizeThen::scaled : SizeThen::cut;
}

void save_surface(ImagePlan &plan, const cm_surface &surface,
                  const std::optional<cm_rotation> &rotation)
{
    ImageDescription &held = plan.description;
    const std::string specification = cm_surface_specification(&surface);
    const std::string turned = rotation && is_turned(*rotation) ? rotation_text(*rotation) : "";
    std::string lines;
    if (holds_own_tags(plan.format))
    {
        held.set(surface_tag, specification);
        if (!turned.empty())
        {
            held.set(rotation_tag, turned);
        }
    }
    else if (plan.format == "jpeg" || plan.format == "tiff")
    {
        lines = std::string(surface_tag) + "=" + specification +
                (turned.empty() ? "" : std::string("\n") + rotation_tag + "=" + turned);
    }
    set_description(held, lines);
    // whose library writes XMP
    if (plan.format == "jpeg" || plan.format == "tiff")
    {
        save_photo_sphere(held, surface);
    }
}
