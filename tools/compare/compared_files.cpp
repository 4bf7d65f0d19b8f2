// SPDX-License-Identifier: MIT

#include "compared_files.hpp"
#include "tools/cli/program.hpp"
#include "tools/image/face_names.hpp"

#include <algorithm>
#include <cstdint>

namespace
{

SphereOptions asked(const std::string &name, const std::string &option,
                    const std::string &specification)
{
    SphereOptions options;
    options.name = name;
    // only %f stands for six faces
    options.from.specification =
        names_faces(name) ? specification : without_key(specification, "layout");
    options.option = option;
    options.as_it_stands = true;
    return options;
}

// Six faces side by side are the strip of the same cube.
std::string as_strip(const std::string &specification)
{
    const std::string layout = key_of(specification, "layout");
    const std::string rest = layout.substr(std::min(layout.find(':'), layout.size()));
    return without_size(without_key(specification, "layout")) + ";layout=strip" + rest;
}

} // namespace

ComparedFiles::ComparedFiles(const std::string &name, const std::string &said_by,
                             const std::string &said)
    : option(said_by), specification(said), files(asked(name, said_by, said), 0)
{
}

int ComparedFiles::width() const
{
    return files.files().front().width() * static_cast<int>(files.files().size());
}

int ComparedFiles::height() const
{
    return files.files().front().height();
}

int ComparedFiles::channels() const
{
    return files.files().front().channels();
}

std::string ComparedFiles::channel_name(int channel) const
{
    return files.files().front().channel_name(channel);
}

bool ComparedFiles::holds_integers() const
{
    const auto holds = [](const ImageFile &file) { return file.stored().whole_numbers; };
    return std::all_of(files.files().begin(), files.files().end(), holds);
}

bool ComparedFiles::holds_light() const
{
    return files.description_of_pixels().color == CM_IMAGE_COLOR_LINEAR;
}

bool ComparedFiles::holds_curve() const
{
    const cm_image_color color = files.description_of_pixels().color;
    return color == CM_IMAGE_COLOR_SRGB || (color == CM_IMAGE_COLOR_UNKNOWN && holds_integers());
}

std::string ComparedFiles::size_text() const
{
    return in_quotes(files.files().front().path()) + " is " +
           std::to_string(files.files().front().width()) + " x " + std::to_string(height()) +
           " with " + std::to_string(channels()) + " channels";
}

bool ComparedFiles::is_six() const
{
    return files.files().size() == 6;
}

bool ComparedFiles::is_told() const
{
    return files.is_told();
}

void ComparedFiles::open_placed()
{
    files.open_placed();
}

std::string ComparedFiles::told() const
{
    const std::optional<SavedSurface> saved = saved_surface(files.files().front());
    if (!saved)
    {
        return "";
    }
    const std::string &text = saved->specification;
    return is_cube(text) ? without_size(text) : kind_of(text);
}

const std::vector<std::string> &ComparedFiles::warnings() const
{
    return files.warnings();
}

std::shared_ptr<const cm_surface>
ComparedFiles::made(const std::string &text, const std::optional<cm_rotation> &rotation) const
{
    std::string message;
    SurfacePointer surface = make_surface(text, width(), height(), rotation, message);
    if (!surface)
    {
        throw UsageFailure(option + ": " + in_quotes(specification.empty() ? text : specification) +
                           ", but " + size_text() + ": " + message);
    }
    if (cm_surface_picture_count(surface.get()) != 1)
    {
        throw UsageFailure(option + ": " + in_quotes(text) +
                           " is of several images; say a layout of one, as in "
                           "cube;layout=strip");
    }
    return surface;
}

std::shared_ptr<const cm_surface> ComparedFiles::surface()
{
    if (!specification.empty())
    {
        const std::shared_ptr<const cm_surface> said =
            made(is_six() ? as_strip(specification) : specification, {});
        if (!is_six())
        {
            files.take_as(*said);
            return said;
        }
    }
    else if (!is_told() && (is_six() || width() != 2 * height()))
    {
        throw UsageFailure(option + " is missing: " + size_text() +
                           ", which may be any map of the sphere");
    }
    files.find_surface();
    const std::string found = cm_surface_specification(&files.surface());
    return made(is_six() ? as_strip(found) : found, files.rotation());
}

std::vector<float> ComparedFiles::pixels()
{
    const std::size_t own = static_cast<std::size_t>(files.files().front().width()) *
                            static_cast<std::size_t>(channels());
    check_memory(in_quotes(files.files().front().path()), std::int64_t{width()} * height(),
                 channels());
    const std::size_t stride = own * files.files().size();
    std::vector<float> found(stride * static_cast<std::size_t>(height()));
    std::size_t begin = 0;
    for (ImageFile &file : files.files())
    {
        file.read(found.data() + begin, stride, Finite::any);
        begin += own;
    }
    return found;
}
