// SPDX-License-Identifier: MIT
//
// Any surface as what lines are drawn over.

#ifndef CUBEMAP_TOOLS_SURFACE_PROJECTION_HPP
#define CUBEMAP_TOOLS_SURFACE_PROJECTION_HPP

#include "tools/image/surface_text.hpp"
#include "tools/image/projection.hpp"

#include <string>

// Derivatives are differences over a part of a pixel.
class SurfaceProjection : public Projection
{
public:
    // Of a surface as it is but for its rotation. The axes that directions are in: as the surface's stand in them.
    SurfaceProjection(const cm_surface &like, const cm_rotation &rotation);

    int planes() const noexcept override;
    int width() const noexcept override;
    int height() const noexcept override;
    void directions(int plane, int row, int first_column, std::size_t count,
                    PointBatch &batch) const override;
    void positions(std::size_t count, PointBatch &batch) const override;
    void derivatives(std::size_t count, const PointBatch &batch,
                     DerivativeBatch &derivatives) const override;
    bool wraps() const noexcept override
    {
        return around;
    }

private:
    SurfacePointer surface;
    bool around;
};

#endif
