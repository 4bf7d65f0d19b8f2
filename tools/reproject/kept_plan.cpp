// SPDX-License-Identifier: MIT

#include "kept_plan.hpp"
#include "tools/image/surface_text.hpp"
#include "tools/cli/program.hpp"

#include <new>

namespace
{

std::string surface_key(const cm_surface &surface, const std::optional<cm_rotation> &turned)
{
    return std::string(cm_surface_specification(&surface)) + " " +
           (turned ? rotation_text(*turned) : "");
}

// What is not the same for all pictures of one command line.
std::string options_key(const cm_plan_options &options)
{
    return std::to_string(options.filter) + " " + std::to_string(options.transfer) + " " +
           std::to_string(options.alpha) + " " + std::to_string(options.alpha_multiplied) + " " +
           std::to_string(options.not_finite);
}

} // namespace

void check_resampling(cm_status status)
{
    if (status == CM_ERROR_MEMORY)
    {
        throw std::bad_alloc();
    }
    if (status != CM_OK)
    {
        throw Failure(std::string("cannot be resampled: ") + cm_status_text(status));
    }
}

const cm_plan &KeptPlan::get(const cm_surface &from, const std::optional<cm_rotation> &from_turned,
                             const cm_surface &to, const std::optional<cm_rotation> &to_turned,
                             const cm_plan_options &options)
{
    const std::string wanted = surface_key(from, from_turned) + "\n" + surface_key(to, to_turned) +
                               "\n" + options_key(options);
    if (!plan || wanted != what)
    {
        cm_plan *made = nullptr;
        check_resampling(cm_plan_create(&from, &to, &options, &made));
        plan.reset(made);
        what = wanted;
    }
    return *plan;
}
