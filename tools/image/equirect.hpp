// SPDX-License-Identifier: MIT
//
// The equirectangular image: one plane that spans 360 x 180 degrees exactly. Its left edge is lon
// -180, its middle lon 0, east is to the right, its upper edge is the north pole.

#ifndef CUBEMAP_TOOLS_EQUIRECT_HPP
#define CUBEMAP_TOOLS_EQUIRECT_HPP

#include "projection.hpp"

#include <vector>

class Equirect : public Projection
{
public:
    Equirect(int width, int height);

    int planes() const noexcept override
    {
        return 1;
    }
    int width() const noexcept override
    {
        return columns;
    }
    int height() const noexcept override
    {
        return rows;
    }

    void directions(int plane, int row, int first_column, std::size_t count,
                    PointBatch &batch) const override;
    void positions(std::size_t count, PointBatch &batch) const override;
    void derivatives(std::size_t count, const PointBatch &batch,
                     DerivativeBatch &derivatives) const override;
    bool wraps() const noexcept override
    {
        return true;
    }

private:
    int columns;
    int rows;
    std::vector<double> cos_lon, sin_lon; // of the columns' centres
};

#endif
