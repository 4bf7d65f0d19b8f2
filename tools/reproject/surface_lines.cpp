// SPDX-License-Identifier: MIT

#include "surface_lines.hpp"
#include "surface_projection.hpp"
#include "tools/image/chart_image.hpp"
#include "tools/image/cube_image.hpp"
#include "tools/image/equirect.hpp"

#include <cubemap/catalogue.h>

namespace
{

// How opaque ellipses are inside: what is below must still be seen.
constexpr double ellipse_fill = 0.35;

constexpr cm_rotation unturned = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

bool has_faces(const std::string &specification)
{
    return is_cube(specification) || is_chart(specification);
}

LineFaces faces_of(const std::string &specification, bool are_targets)
{
    const std::string head = head_of(specification);
    LineFaces faces = {is_cube(specification) ? head.substr(5) : head, *cm_frame_find("geo"),
                       are_targets};
    if (is_cube(specification))
    {
        faces.frame = *cm_frame_find(key_of(specification, "frame").c_str());
    }
    return faces;
}

// Its derivatives are exact.
std::unique_ptr<Projection> own_projection(const LineFaces &faces, const cm_surface &target)
{
    const int size = static_cast<int>(cm_surface_plane_width(&target));
    if (is_cube(cm_surface_specification(&target)))
    {
        return std::make_unique<CubeImage>(faces.mapping, faces.frame, size);
    }
    return std::make_unique<ChartImage>(faces.mapping, size);
}

// From the axes of the faces to those of the target.
std::unique_ptr<Projection> other_projection(const cm_surface &target, const cm_rotation &to,
                                             const cm_rotation &faces)
{
    if (is_whole_equirect(cm_surface_specification(&target)) && !is_turned(to) && !is_turned(faces))
    {
        return std::make_unique<Equirect>(static_cast<int>(cm_surface_plane_width(&target)),
                                          static_cast<int>(cm_surface_plane_height(&target)));
    }
    return std::make_unique<SurfaceProjection>(target, quotient(to, faces));
}

} // namespace

SurfaceLines::SurfaceLines(const OverlayOptions &options, const cm_surface &target,
                           const std::optional<cm_rotation> &turn, const Input &source)
    : style{options.line_width, options.line_color, ellipse_fill}
{
    const std::string to = cm_surface_specification(&target);
    const std::string from = cm_surface_specification(&source.surface());
    const bool own = has_faces(to);
    LineFaces faces = faces_of(own               ? to
                               : has_faces(from) ? from
                                                 : "cube:" CM_MAPPING_RECOMMENDED ";frame=geo",
                               own);
    turned = own               ? turn.value_or(unturned)
             : has_faces(from) ? source.rotation().value_or(unturned)
                               : unturned;
    faces.turn = is_turned(turned) ? &turned : nullptr;
    projection = own ? own_projection(faces, target)
                     : other_projection(target, turn.value_or(unturned), turned);
    overlay = std::make_unique<Overlay>(options, faces, *projection);
}

void SurfaceLines::draw(unsigned plane, std::uint32_t row, const PixelChannels &channels,
                        float *pixels) const
{
    LineRow lines(projection->width());
    overlay->add_lines(static_cast<int>(plane), static_cast<int>(row), lines);
    lines.draw(style, channels, pixels);
}
