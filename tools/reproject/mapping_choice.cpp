// SPDX-License-Identifier: MIT

#include "mapping_choice.hpp"
#include "picture_density.hpp"
#include "tools/cli/catalogue_name.h"
#include "tools/cli/program.hpp"

#include <cubemap/catalogue.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace
{

constexpr const char *automatic = "auto";

// Faces to measure densities on.
constexpr int measured_face_size = 64;

// The keys of a specification, with the semicolon before them.
std::string keys_of(const std::string &specification)
{
    return specification.substr(head_of(specification).size());
}

bool is_tidy(const cm_mapping_info &info)
{
    return info.kind == CM_KIND_CUBE && info.smooth_face >= CM_SMOOTH_C0 &&
           info.smooth_edge >= CM_SMOOTH_C0;
}

// Pixels of a radian where there are the fewest, on a face of measured_face_size.
double least_density(const std::string &mapping)
{
    std::string message;
    const SurfacePointer surface = make_surface(
        "cube:" + mapping + ";size=" + std::to_string(measured_face_size), 0, 0, {}, message);
    return surface ? density_of(*surface).least : 0;
}

// What needs the fewest pixels for the finest detail anywhere: that whose longest pixel is the shortest. What is not
// better by more than a fiftieth counts as equal, and the first of the catalogue is taken.
std::string densest(bool equal_area)
{
    std::vector<std::pair<double, std::string>> found;
    double most = 0;
    for (std::size_t i = 0; i < cm_catalogue_count(); ++i)
    {
        const cm_mapping_info &info = *cm_catalogue_at(i);
        if (is_tidy(info) && (!equal_area || (info.properties & CM_EQUAL_AREA) != 0))
        {
            found.emplace_back(least_density(info.identifier), info.identifier);
            most = std::max(most, found.back().first);
        }
    }
    const auto best =
        std::find_if(found.begin(), found.end(),
                     [most](const auto &one) { return one.first >= most * (1 - 0.02); });
    return best == found.end() ? CM_MAPPING_RECOMMENDED : best->second;
}

} // namespace

void take_mapping(Options &options)
{
    SurfaceOptions &to = options.to;
    if (options.mapping.empty())
    {
        return;
    }
    const std::string head = head_of(to.specification);
    if (options.preset != nullptr || (!head.empty() && head != "cube"))
    {
        throw UsageFailure("--mapping says which cube OUTPUT is, and " +
                           (options.preset != nullptr
                                ? "--for " + std::string(options.preset->identifier)
                                : "--to " + head) +
                           " says another; leave one out");
    }
    const std::string keys = keys_of(to.specification);
    to.specification = (options.mapping == automatic ? "cube" : "cube:" + options.mapping) + keys;
    std::string message(400, '\0');
    if (cm_surface_check(to.specification.c_str(), nullptr, message.data(), message.size()) !=
        CM_OK)
    {
        throw UsageFailure("--mapping: " + in_quotes(options.mapping) + ": " + message.c_str() +
                           suggestion(nearest_mapping(options.mapping.c_str())));
    }
}

void choose_mapping(Options &options, const Input &input)
{
    if (options.mapping != automatic)
    {
        return;
    }
    const std::string from = cm_surface_specification(&input.surface());
    const std::string layout =
        options.to.layout.empty() ? key_of(options.to.specification, "layout") : options.to.layout;
    std::string chosen;
    if (options.texture)
    {
        chosen = "gnomonic";
        options.mapping_reason = "which graphics interfaces look up in a texture";
    }
    else if (layout.rfind("eac", 0) == 0)
    {
        chosen = "tangent";
        options.mapping_reason = "which the layout eac stands for";
    }
    else if (is_cube(from))
    {
        chosen = head_of(from).substr(std::string("cube:").size());
        options.mapping_reason = "that of INPUT, which loses nothing";
    }
    else if (options.filter == CM_FILTER_NEAREST)
    {
        chosen = densest(true);
        options.mapping_reason = "of equal areas, so that values are as frequent as on the sphere";
    }
    else
    {
        chosen = densest(false);
        options.mapping_reason = "whose longest pixel is the shortest";
    }
    options.mapping_reason = "mapping " + chosen + ", " + options.mapping_reason;
    options.to.specification = "cube:" + chosen + keys_of(options.to.specification);
}
