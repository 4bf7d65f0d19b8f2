// SPDX-License-Identifier: MIT

#include "part_rules.hpp"
#include "texture_rules.hpp"
#include "tools/cli/program.hpp"
#include "tools/image/face_names.hpp"
#include "tools/image/surface_text.hpp"

#include <cubemap/frame.h>

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
    if (cm_surface_picture_count(&surface) != 6)
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
