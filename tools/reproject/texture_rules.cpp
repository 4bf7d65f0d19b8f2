// SPDX-License-Identifier: MIT

#include "texture_rules.hpp"
#include "healpix_rules.hpp"
#include "tools/cli/program.hpp"
#include "tools/image/surface_text.hpp"

#include <algorithm>
#include <filesystem>

namespace
{

constexpr int most_channels = 4;

std::string lower_extension(const std::string &path)
{
    std::string extension = std::filesystem::path(path).extension().string();
    const auto lower_letter = [](char letter)
    { return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter; };
    std::transform(extension.begin(), extension.end(), extension.begin(), lower_letter);
    return extension;
}

std::string said(const std::string &option, const std::string &specification,
                 const std::string &key)
{
    const std::string in_key = key_of(specification, key);
    return in_key.empty() ? option : in_key;
}

} // namespace

std::string texture_format(const std::string &path)
{
    const std::string extension = lower_extension(path);
    return extension == ".dds" ? "dds" : extension == ".ktx2" ? "ktx2" : "";
}

std::string reproject_format(const std::string &path)
{
    const std::string texture = texture_format(path);
    if (!texture.empty())
    {
        return texture;
    }
    if (is_fits_name(path))
    {
        return "fits";
    }
    try
    {
        return output_format(path);
    }
    catch (const UsageFailure &)
    {
        throw UsageFailure(in_quotes(path) +
                           ": an output's name must end in .png, .jpg, .tif, .exr, .hdr, .ppm, "
                           ".pgm, .pfm, .dds, .ktx2 or .fits, or, of a folder of HiPS tiles, in /");
    }
}

void take_texture_rules(Options &options)
{
    if (texture_format(options.output).empty() || options.preset != nullptr)
    {
        return;
    }
    SurfaceOptions &to = options.to;
    if (!to.specification.empty() && !is_cube(to.specification))
    {
        return;
    }
    options.texture = true;
    const std::string frame = said(to.frame, to.specification, "frame");
    const std::string layout = said(to.layout, to.specification, "layout");
    if (!frame.empty() && frame != "gl")
    {
        throw UsageFailure("a cube map in " + in_quotes(options.output) +
                           " has its faces in the frame gl, not " + frame + "; leave --frame out");
    }
    if (!layout.empty() && layout != "faces")
    {
        throw UsageFailure("a cube map in " + in_quotes(options.output) +
                           " is six faces; leave the layout " + layout + " out");
    }
    const SavedSurface usual = texture_surface();
    if (to.specification.empty())
    {
        to.specification = head_of(usual.specification);
    }
    if (frame.empty())
    {
        to.frame = "gl";
        to.rotation = to.rotation ? product(*usual.rotation, *to.rotation) : usual.rotation;
    }
}

void plan_texture(ImagePlan &plan, const std::string &path)
{
    if (plan.description.channels > most_channels)
    {
        throw Failure(in_quotes(path) + ": textures hold 1 to 4 channels, the image has " +
                      std::to_string(plan.description.channels) + "; TIFF and EXR hold any number");
    }
}
