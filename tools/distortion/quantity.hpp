// SPDX-License-Identifier: MIT
//
// The quantities of <cubemap/distortion.h> of which there are pictures, and how their values become
// places on a colour map.

#ifndef CUBEMAP_TOOLS_QUANTITY_HPP
#define CUBEMAP_TOOLS_QUANTITY_HPP

#include <cubemap/distortion.h>

#include <string>
#include <vector>

// From low to high, both above 0 where the scale is logarithmic.
struct ValueRange
{
    double low;
    double high;
};

struct Quantity
{
    const char *name;
    const char *symbol; // "D_A"
    const char *unit;   // "", or with a blank before it
    double *cm_distortion_arrays::*values;
    double factor; // from the library's unit to this one
    double
        middle;   // of a logarithmic scale, on which x / middle and middle / x are equally far from
                  // it; 0 for a linear scale
    double least; // the values cannot be below, and isolines there would be blots
    ValueRange range; // of colours, if the user says none
    const char *colors;
};

// Those of maps on the six faces of a cube, whose mean scale is 6 / pi.
const std::vector<Quantity> &quantities();

// The same of a map with this mean scale.
Quantity with_mean_scale(const Quantity &quantity, double mean);

// Where values lie on a colour map. A diverging map has its middle at the quantity's, and both its
// halves belong to equal ratios, though the range may not reach as far on one side. A sequential map is
// used from its light end, which is the last, to its dark one.
class ColorScale
{
public:
    ColorScale(const Quantity &quantity, const ValueRange &value_range, bool turned_round);

    double place(double value) const;

    // The value at a part of the way from low to high, in equal steps of colour.
    double value_at(double part) const;

    // " logarithmic about 1"
    std::string description() const;

    const ValueRange &range() const noexcept
    {
        return colored;
    }

private:
    bool logarithmic() const noexcept
    {
        return middle > 0;
    }

    ValueRange colored;
    double middle;
    double half; // the larger of the two ratios' logarithms
    bool reversed;
};

// "1.41421", as people read it.
std::string quantity_text(double value);

#endif
