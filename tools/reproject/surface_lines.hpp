// SPDX-License-Identifier: MIT
//
// Lines over a picture of a surface: whose faces they belong to, and in which axes.

#ifndef CUBEMAP_TOOLS_SURFACE_LINES_HPP
#define CUBEMAP_TOOLS_SURFACE_LINES_HPP

#include "reproject_input.hpp"
#include "tools/image/overlay.hpp"

class SurfaceLines
{
public:
    // Faces are the target's, else the source's, else the recommended cube's. UsageFailure as Overlay.
    SurfaceLines(const OverlayOptions &options, const cm_surface &target,
                 const std::optional<cm_rotation> &turn, const Input &source);

    // Draws a row of a plane.
    void draw(unsigned plane, std::uint32_t row, const PixelChannels &channels,
              float *pixels) const;

    std::string description() const
    {
        return overlay->description();
    }

private:
    LineStyle style;
    cm_rotation turned = {};
    std::unique_ptr<Projection> projection;
    std::unique_ptr<Overlay> overlay;
};

#endif
