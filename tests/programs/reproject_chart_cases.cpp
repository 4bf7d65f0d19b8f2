// SPDX-License-Identifier: MIT
//
// What cubemap-reproject makes of mappings of one face.

#include "direction_image.hpp"
#include "image_cases.hpp"
#include "picture_checks.hpp"

#include <filesystem>

namespace
{

struct ChartBounds
{
    const char *chart;
    double largest;
    double mean;
};

// Beside a disc's rim there is nothing to interpolate with: up to a pixel and a half.
constexpr ChartBounds chart_bounds[] = {
    {"octahedral", 6e-4, 2e-5},
    {"octahedral:clarberg", 3e-3, 5e-5},
    {"peirce", 4e-5, 2e-5},
    {"quincuncial:equidistant,radial,lon=20,lat=30", 4e-3, 2e-5},
    {"border:equidistant,squircle", 5e-5, 2e-5},
    {"border:breusing,elliptical,lon=20,lat=30", 8e-5, 3e-5},
    {"rhealpix", 6e-3, 1e-4},
    {"rhealpix:north=2,south=3", 6e-3, 1e-4},
    {"azimuthal:equidistant:full=1", 8e-3, 3e-5},
};

void charts()
{
    make_direction_image(equirect_shape, 1024, "equirect.tif");
    Words all = catalogue_names(true);
    for (const char *chart :
         {"azimuthal:lambert:full=1", "azimuthal:equidistant:fov=200,lon=20,lat=30", "peirce",
          "quincuncial:mixture,elliptical,lon=100,lat=-20,beta=0.7"})
    {
        all.emplace_back(chart);
    }
    for (std::size_t i = 0; i < all.size(); i += static_cast<std::size_t>(one_in(4)))
    {
        does("reproject --quiet --filter bilinear --to " + all[i] +
             " --size 256 equirect.tif chart.tif");
        holds("equirect to " + all[i],
              [&] { check_direction_image({all[i]}, "chart.tif", 2e-5, 6e-6); });
    }
    int turn = 0;
    for (const ChartBounds &bounds : chart_bounds)
    {
        if (turn++ % one_in(3) == 0)
        {
            const std::string chart = bounds.chart;
            make_direction_image({chart}, 512, "chart.tif");
            does("reproject --quiet --filter bilinear --from " + chart + " chart.tif back.tif");
            holds(chart + " to equirect",
                  [&] {
                      check_direction_image(equirect_shape, "back.tif", bounds.largest,
                                            bounds.mean);
                  });
        }
    }
    for (const std::string name :
         {"lambert", "stereographic", "equidistant", "mixture", "breusing"})
    {
        if (turn++ % one_in(3) == 0)
        {
            const std::string chart = "azimuthal:" + name;
            make_direction_image({chart}, 512, "chart.tif");
            does("reproject --quiet --filter bilinear --from " + chart +
                 " --to azimuthal:lambert --size 300 chart.tif back.tif");
            holds(chart + " to another",
                  [] { check_direction_image({"azimuthal:lambert"}, "back.tif", 1e-2, 5e-5); });
        }
    }
}

// A centre a quarter turn further on turns a layout, and the pixels beyond its border with it.
void chart_borders()
{
    make_noise(32, 32, "noise.ppm");
    make_turned("noise.ppm", 32, 32, "turned.ppm");
    for (const std::string chart : {"quincuncial:lambert,shirley", "border:equidistant,radial"})
    {
        const std::string from =
            "reproject --quiet --filter bilinear --from " + chart + " --to " + chart;
        does(from + ",lon=180 --size 45 noise.ppm half.png");
        does(from + " --size 45 turned.ppm turned.png");
        passes(chart + ", half a turn", "compare --max 1 half.png turned.png");
    }
    int size = 0;
    make_constant(5, 5, 1, "float", 0.7f, "wanted.tif");
    does("reproject --quiet --filter bilinear --from peirce --to azimuthal:lambert:fov=80 --size 5 "
         "wanted.tif "
         "disc.tif");
    for (const std::string &chart : catalogue_names(true))
    {
        for (const std::string filter : {"nearest", "bilinear"})
        {
            const std::string same = "reproject --quiet --filter bilinear --filter " + filter +
                                     " --from " + chart + " --to " + chart;
            does(same + " noise.ppm same.tif");
            does(same + " same.tif again.tif");
            passes(chart + " to the same, " + filter + ": the same pixels",
                   "compare --max 0 same.tif again.tif");
        }
        if (chart == "rhealpix") // no pixel of so few is on each of its squares
        {
            continue;
        }
        size = size % 3 + 1;
        make_constant(size, size, 1, "float", 0.7f, "small.tif");
        does("reproject --quiet --filter bilinear --from " + chart +
             " --to azimuthal:lambert:fov=80 --size 5 small.tif out.tif");
        passes(chart + " of " + std::to_string(size) + " pixels",
               "compare --max 0 out.tif disc.tif");
    }
}

// What is not on the map is black, and transparent if there is alpha.
void chart_background()
{
    make_constant(32, 32, 4, "float", 0.5f, "disc.tif");
    const std::string half = "reproject --quiet --filter bilinear --size 16 --to equirect --from ";
    does(half + "azimuthal:stereographic disc.tif half.tif");
    does(half + "azimuthal:stereographic:lat=-90 disc.tif other.tif");
    make_constant(16, 8, 4, "float", 0.5f, "ones.tif");
    const std::string one = does("compare half.tif ones.tif").out;
    const std::string other = does("compare other.tif ones.tif").out;
    result(matches(one, "^mean absolute error  0\\.25$") &&
               matches(other, "^mean absolute error  0\\.25$"),
           "half of the sphere is transparent", one + other);
    make_constant(64, 32, 4, "uint8", 1, "white.png");
    does(
        "reproject --quiet --filter bilinear --to azimuthal:lambert --size 100 white.png disc.png");
    make_constant(100, 100, 4, "uint8", 0, "black.png");
    // 7860 pixels of 10000 have their centres on the disc of radius 50
    const std::string beside = does("compare disc.png black.png").out;
    result(matches(beside, "^mean absolute error  200\\.4"), "beside a disc all is transparent",
           beside);
    const std::string lambert = "reproject --to azimuthal:lambert --size 64 ";
    does(lambert + "--quiet --graticule 30 --grid 2 --indicatrices 3 white.png lines.png");
    does(lambert + "--quiet white.png plain.png");
    passes("lines over a disc", "compare --max-mean 120 lines.png plain.png");
    const std::string said = does(lambert + "--indicatrices 3 white.png lines.png").out;
    result(!said.empty() && !matches(said, "left out"), "cells beside the disc are not missed",
           said);
}

} // namespace

const std::vector<Subject> &reproject_chart_subjects()
{
    static const std::vector<Subject> subjects = {{"charts", charts},
                                                  {"chart_borders", chart_borders},
                                                  {"chart_background", chart_background}};
    return subjects;
}
