// SPDX-License-Identifier: MIT

#include "healpix_rules.hpp"
#include "tools/image/surface_text.hpp"
#include "tools/cli/program.hpp"

#include <filesystem>

bool is_fits_name(const std::string &path)
{
    const std::string extension = std::filesystem::path(path).extension().string();
    return extension == ".fits" || extension == ".fit" || extension == ".FITS" ||
           extension == ".FIT";
}

void take_healpix_rules(Options &options)
{
    SurfaceOptions &to = options.to;
    const bool fits = is_fits_name(options.output);
    if (!options.healpix_order.empty() && !fits)
    {
        throw UsageFailure("--to: only .fits files have an order, :" + options.healpix_order +
                           ", of a HEALPix map; leave it out");
    }
    if (!fits)
    {
        return;
    }
    if ((!to.specification.empty() && kind_of(to.specification) != "healpix") || !to.layout.empty())
    {
        throw UsageFailure(in_quotes(options.output) +
                           ": a .fits file that is written is a map of HEALPix; say --to "
                           "healpix:NSIDE, or another kind of file");
    }
    if (options.mips)
    {
        throw UsageFailure("--mips: a map of HEALPix in FITS has no levels; write one for each");
    }
    to.specification = to.specification.empty() ? "healpix" : to.specification;
}

void plan_healpix(ImagePlan &plan, const Options &options)
{
    plan.description.type = CM_PIXEL_FLOAT;
    plan.description.stored_type.clear();
    plan.description.set("ORDERING", options.healpix_order == "nest" ? "NESTED" : "RING");
    if (options.to.rotation)
    {
        plan.description.set("COORDSYS", ""); // the axes are others
    }
}
