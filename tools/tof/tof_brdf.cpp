// SPDX-License-Identifier: MIT

#include "tof_brdf.hpp"

#include <cubemap/brdf.h>

#include <new>

namespace
{

cm_status create_brdf(const BrdfDescription &description, cm_brdf **made)
{
    if (description.kind == BrdfDescription::Kind::CookTorrance)
    {
        cm_cook_torrance options = {};
        options.size = sizeof options;
        options.diffuse = description.diffuse;
        options.specular = description.specular;
        options.roughness = description.roughness;
        options.eta = description.eta;
        options.absorption = description.absorption;
        return cm_brdf_create_cook_torrance(&options, made);
    }
    if (description.kind == BrdfDescription::Kind::Lambert)
    {
        return cm_brdf_create_lambert(made);
    }
    std::vector<cm_brdf_sample> samples;
    for (const BrdfWord &word : description.measured)
    {
        samples.push_back({word.theta_in, word.theta_out, word.azimuth, word.value});
    }
    return cm_brdf_create_measured(samples.size(), samples.data(), made);
}

} // namespace

std::shared_ptr<const cm_brdf> make_brdf(const BrdfDescription &description)
{
    cm_brdf *made = nullptr;
    const cm_status status = create_brdf(description, &made);
    if (status == CM_ERROR_MEMORY)
    {
        throw std::bad_alloc();
    }
    return status == CM_OK
               ? std::shared_ptr<const cm_brdf>(made, [](const cm_brdf *owned)
                                                { cm_brdf_destroy(const_cast<cm_brdf *>(owned)); })
               : nullptr;
}
