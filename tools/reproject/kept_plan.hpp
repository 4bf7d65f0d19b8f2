// SPDX-License-Identifier: MIT
//
// The geometry of a job, which pictures that are alike have in common.

#ifndef CUBEMAP_TOOLS_REPROJECT_KEPT_PLAN_HPP
#define CUBEMAP_TOOLS_REPROJECT_KEPT_PLAN_HPP

#include <cubemap/image.h>

#include <memory>
#include <optional>
#include <string>

// Throws what a status of the engine means, unless it is CM_OK.
void check_resampling(cm_status status);

class KeptPlan
{
public:
    // The last one, if the surfaces, how they are turned and the options are those of the last call.
    const cm_plan &get(const cm_surface &from, const std::optional<cm_rotation> &from_turned,
                       const cm_surface &to, const std::optional<cm_rotation> &to_turned,
                       const cm_plan_options &options);

private:
    struct Deleter
    {
        void operator()(cm_plan *owned) const noexcept
        {
            cm_plan_destroy(owned);
        }
    };

    std::unique_ptr<cm_plan, Deleter> plan;
    std::string what;
};

#endif
