// SPDX-License-Identifier: MIT

#include "whole_output.hpp"
#include "tools/image/geo_reference.hpp"
#include "tools/image/surface_tags.hpp"
#include "texture_rules.hpp"
#include "modules/image/io/texture_file.h"
#include "pixel_memory.hpp"
#include "tools/cli/image_writer.hpp"
#include "tools/cli/parallel.hpp"
#include "tools/cli/program.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>

namespace
{

struct MipsDeleter
{
    void operator()(cm_mips *owned) const noexcept
    {
        cm_mips_destroy(owned);
    }
};

using MipsPointer = std::unique_ptr<cm_mips, MipsDeleter>;

void check(cm_status status, const std::string &what)
{
    if (status == CM_ERROR_MEMORY)
    {
        throw std::bad_alloc();
    }
    if (status != CM_OK)
    {
        throw Failure(what + ": " + cm_status_text(status));
    }
}

// The number after ":border=" of a layout.
std::uint32_t border_of(const std::string &specification)
{
    const std::string layout = key_of(specification, "layout");
    const std::size_t at = layout.find("border=");
    return at == std::string::npos
               ? 0
               : static_cast<std::uint32_t>(std::strtoul(layout.c_str() + at + 7, nullptr, 10));
}

std::string without_border(const std::string &specification)
{
    std::string text = specification;
    const std::size_t at = text.find(":border=");
    return at == std::string::npos ? text : text.erase(at, text.find(';', at) - at);
}

std::string of_any_size(const std::string &specification)
{
    const std::string text = without_size(specification);
    return kind_of(text) == "healpix" ? "healpix" : text;
}

std::size_t pixel_bytes(const cm_image &picture)
{
    return cm_pixel_size(picture.type) * picture.channels;
}

// Dense.
cm_image picture_in(const PixelMemory &memory, cm_pixel_type type, std::uint32_t width,
                    std::uint32_t height, std::uint32_t channels)
{
    cm_image picture = {};
    picture.size = sizeof picture;
    picture.data = memory.bytes();
    picture.type = type;
    picture.width = width;
    picture.height = height;
    picture.channels = channels;
    return picture;
}

cm_texture_format texel_format(const ImageDescription &description)
{
    switch (description.type)
    {
    case CM_PIXEL_U16:
        return CM_TEXTURE_RGBA16;
    case CM_PIXEL_HALF:
        return CM_TEXTURE_RGBA16F;
    case CM_PIXEL_FLOAT:
        return CM_TEXTURE_RGBA32F;
    default:
        return description.color == CM_IMAGE_COLOR_SRGB ? CM_TEXTURE_RGBA8_SRGB : CM_TEXTURE_RGBA8;
    }
}

// What has no room is not said.
void put_text(const std::string &text, char (&to)[CM_TEXTURE_TEXT])
{
    if (text.size() < sizeof to)
    {
        std::copy(text.begin(), text.end(), to);
    }
}

// placed: the surface, if where it is on Earth is to be written.
void write_file(const cm_image &picture, const ImagePlan &plan, const std::string &name,
                AtomicFile &file, const cm_surface *placed)
{
    ImageWriter writer(plan, static_cast<int>(picture.width), static_cast<int>(picture.height),
                       name, file);
    writer.write(0, static_cast<int>(picture.height), picture.type, picture.data,
                 static_cast<int>(picture.channels));
    writer.close();
    if (placed != nullptr)
    {
        write_geographic_place(*placed, name, file);
    }
    file.finish();
}

// As cm_border has it.
std::string wide_border_text(std::uint32_t border, const cm_surface &level, std::uint32_t number)
{
    constexpr std::uint32_t always = 6;
    const std::uint32_t edge = cm_surface_plane_width(&level);
    return "OUTPUT cannot have a border of " + std::to_string(border) + " pixels around faces of " +
           std::to_string(edge) + (number > 0 ? ", those of level " + std::to_string(number) : "") +
           ": it may be half an edge, or " + std::to_string(always) + "; take " +
           std::to_string(std::max(always, edge / 2)) + " at most" +
           (number > 0 ? ", or leave --mips out" : ", or a larger --size");
}

// All pictures of a level as parts of one file.
void write_parts(const std::vector<cm_image> &pictures, const ImagePlan &plan,
                 const std::string &name, AtomicFile &file)
{
    const cm_image &first = pictures.front();
    ImageWriter writer(plan, static_cast<int>(first.width), static_cast<int>(first.height), name,
                       file);
    for (const cm_image &picture : pictures)
    {
        writer.write(0, static_cast<int>(picture.height), picture.type, picture.data,
                     static_cast<int>(picture.channels));
    }
    writer.close();
    file.finish();
}

} // namespace

// The pictures of a level, and the memory of those that are not the library's.
struct WholeOutput::Level
{
    SurfacePointer shown;
    std::vector<PixelMemory> memory;
    std::vector<cm_image> pictures;
};

WholeOutput::WholeOutput(const Options &options, SurfacePointer wanted,
                         const std::string &texture_format)
    : shown(std::move(wanted)), container(texture_format), texture(!texture_format.empty()),
      mips(options.mips)
{
    const std::string specification = cm_surface_specification(shown.get());
    border = border_of(specification);
    if (mips && is_pipe(options.output))
    {
        throw UsageFailure(
            "--mips writes a file for each level, and OUTPUT is a pipe; leave one out");
    }
    if (border > 0)
    {
        std::string message;
        inner = make_surface(without_border(specification), 0, 0, options.to.rotation, message);
        if (!inner)
        {
            throw UsageFailure("OUTPUT, " + in_quotes(specification) + ": " + message);
        }
    }
    if (texture && border > 0)
    {
        throw UsageFailure("--border: who reads a texture's faces goes on over their edges itself; "
                           "leave the border out");
    }
    if (texture && cm_surface_plane_count(shown.get()) != cm_surface_picture_count(shown.get()))
    {
        throw UsageFailure("a texture holds one picture, or six faces, not " +
                           in_quotes(of_any_size(specification)));
    }
    const auto has = [&specification](const char *key)
    { return !key_of(specification, key).empty(); };
    if (mips && (has("x") || has("y") || has("radius") ||
                 key_of(specification, "layout").find("pad=") != std::string::npos))
    {
        throw UsageFailure("--mips: levels of a surface with places in pixels, " +
                           in_quotes(specification) + ", cannot be said");
    }
}

// ---- levels

std::uint32_t WholeOutput::level_count() const
{
    std::uint32_t width = cm_surface_plane_width(&computed());
    std::uint32_t height = cm_surface_plane_height(&computed());
    if (!mips)
    {
        return 1;
    }
    if (texture)
    {
        return cm_texture_levels(width, height);
    }
    std::uint32_t count = 1;
    for (; width > 1 || height > 1; ++count)
    {
        width = (width + 1) / 2;
        height = (height + 1) / 2;
    }
    return count;
}

// Its pictures are as many planes wide and high, with the same border.
SurfacePointer WholeOutput::level_of(const cm_surface &of, std::uint32_t level) const
{
    const std::uint32_t around = &of == &computed() ? 0 : 2 * border;
    std::uint32_t width = cm_surface_plane_width(&of);
    std::uint32_t height = cm_surface_plane_height(&of);
    const std::uint32_t columns = cm_surface_width(&of) / (width + around);
    const std::uint32_t rows = cm_surface_height(&of) / (height + around);
    for (std::uint32_t i = 0; i < level; ++i)
    {
        width = (width + 1) / 2;
        height = (height + 1) / 2;
    }
    std::string message;
    SurfacePointer made = make_surface(of_any_size(cm_surface_specification(&of)),
                                       static_cast<int>(columns * (width + around)),
                                       static_cast<int>(rows * (height + around)), {}, message);
    if (!made)
    {
        throw Failure("level " + std::to_string(level) + " of OUTPUT, " +
                      in_quotes(cm_surface_specification(&of)) + ": " + message);
    }
    return made;
}

// With borders, and of that type.
WholeOutput::Level WholeOutput::make_level(const cm_mips *levels,
                                           const std::vector<cm_image> &pictures,
                                           std::uint32_t level, cm_pixel_type type,
                                           const cm_plan_options &values, int threads,
                                           MemoryCeiling &ceiling) const
{
    Level made;
    made.shown = level_of(*shown, level);
    const cm_image *const from =
        levels == nullptr ? pictures.data() : cm_mips_pictures(levels, level);
    const std::size_t count = cm_surface_picture_count(made.shown.get());
    if (border == 0 && from->type == type)
    {
        made.pictures.assign(from, from + count);
        return made;
    }
    const SurfacePointer own = level_of(computed(), level);
    const std::uint32_t width = cm_surface_width(made.shown.get());
    const std::uint32_t height = cm_surface_height(made.shown.get());
    const std::size_t bytes = std::size_t{width} * height * cm_pixel_size(type) * from->channels;
    for (std::size_t i = 0; i < count; ++i)
    {
        made.memory.emplace_back(ceiling, bytes, "a level of OUTPUT");
        std::memset(made.memory.back().bytes(), 0, bytes);
        made.pictures.push_back(
            picture_in(made.memory.back(), type, width, height, from->channels));
    }
    std::vector<cm_image> planes;
    for (std::uint32_t plane = 0; plane < cm_surface_plane_count(made.shown.get()); ++plane)
    {
        std::uint32_t picture = 0;
        std::uint32_t column = 0;
        std::uint32_t row = 0;
        cm_surface_pixel(made.shown.get(), plane, 0, 0, &picture, &column, &row);
        const cm_image &whole = made.pictures[picture];
        const std::size_t pixel = pixel_bytes(whole);
        cm_image to = whole;
        to.width = cm_surface_plane_width(made.shown.get()) + 2 * border;
        to.height = cm_surface_plane_height(made.shown.get()) + 2 * border;
        to.row_stride = static_cast<std::ptrdiff_t>(pixel * whole.width);
        to.data = static_cast<unsigned char *>(whole.data) +
                  (std::size_t{row - border} * whole.width + (column - border)) * pixel;
        planes.push_back(to);
    }
    const cm_status status =
        cm_border(own.get(), from, border, &values, static_cast<unsigned>(threads), planes.data());
    if (status == CM_ERROR_RANGE)
    {
        throw UsageFailure(wide_border_text(border, *own, level));
    }
    check(status, "the border of OUTPUT");
    return made;
}

// ---- files

std::vector<std::string> WholeOutput::file_names(const std::vector<std::string> &pictures) const
{
    std::vector<std::string> names = pictures;
    for (std::uint32_t level = 1; !texture && level < level_count(); ++level)
    {
        for (const std::string &picture : pictures)
        {
            const std::string extension = std::filesystem::path(picture).extension().string();
            std::string name = picture;
            names.push_back(
                name.insert(name.size() - extension.size(), "_m" + std::to_string(level)));
        }
    }
    return names;
}

void WholeOutput::write_texture(const std::vector<Level> &levels, const ImagePlan &plan,
                                const std::optional<cm_rotation> &rotation, AtomicFile &file,
                                const std::string &name) const
{
    cm_texture of = {};
    of.size = sizeof of;
    of.container = container == "dds" ? CM_TEXTURE_DDS : CM_TEXTURE_KTX2;
    of.format = texel_format(plan.description);
    of.width = cm_surface_width(shown.get());
    of.height = cm_surface_height(shown.get());
    of.faces = static_cast<std::uint32_t>(cm_surface_picture_count(shown.get()));
    of.levels = static_cast<std::uint32_t>(levels.size());
    of.alpha_multiplied = plan.description.alpha >= 0 && plan.description.alpha_multiplied ? 1 : 0;
    of.writer = "cubemap-reproject";
    put_text(of_any_size(cm_surface_specification(shown.get())), of.surface);
    put_text(rotation && is_turned(*rotation) ? rotation_text(*rotation) : "", of.rotation);
    std::vector<const cm_image *> pictures;
    for (const Level &level : levels)
    {
        pictures.push_back(level.pictures.data());
    }
    char message[CM_IMAGE_MESSAGE] = "";
    const cm_image_stream stream = file.stream();
    const cm_status status = cm_texture_write(&stream, &of, pictures.data(), message);
    file.check();
    if (status != CM_OK)
    {
        fail_image(in_quotes(name), status, message);
    }
    file.finish();
}

void WholeOutput::write(const std::vector<cm_image> &pictures, const ImagePlan &plan,
                        const std::optional<cm_rotation> &rotation, const cm_plan_options &values,
                        const std::vector<std::unique_ptr<AtomicFile>> &files,
                        const std::vector<std::string> &names, bool georeferenced, int threads,
                        MemoryCeiling &ceiling) const
{
    MipsPointer held;
    if (level_count() > 1)
    {
        cm_mips *made = nullptr;
        check(cm_mips_create(&computed(), pictures.data(), &values, static_cast<unsigned>(threads),
                             &made),
              "the levels of OUTPUT");
        held.reset(made);
    }
    const cm_pixel_type type = texture ? plan.description.type : pictures.front().type;
    std::vector<Level> levels;
    for (std::uint32_t level = 0; level < level_count(); ++level)
    {
        levels.push_back(make_level(held.get(), pictures, level, type, values, threads, ceiling));
        if (texture)
        {
            continue;
        }
        ImagePlan own = plan;
        save_surface(own, *levels.back().shown, rotation);
        if (!own.parts.empty())
        {
            write_parts(levels.back().pictures, own, names[level], *files[level]);
            levels.clear();
            continue;
        }
        const std::size_t first = level * pictures.size();
        parallel_for(static_cast<int>(pictures.size()), threads,
                     [&](int i)
                     {
                         const std::size_t at = first + static_cast<std::size_t>(i);
                         write_file(levels.back().pictures[static_cast<std::size_t>(i)], own,
                                    names[at], *files[at],
                                    georeferenced ? levels.back().shown.get() : nullptr);
                     });
        levels.clear();
    }
    if (texture)
    {
        write_texture(levels, plan, rotation, *files.front(), names.front());
    }
}

std::string WholeOutput::description() const
{
    const std::uint32_t count = level_count();
    return mips ? "; " + std::to_string(count) + (count == 1 ? " level" : " levels") : "";
}
