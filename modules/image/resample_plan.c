/* SPDX-License-Identifier: MIT
 *
 * The life of a plan.
 */
#include "resample_plan.h"

#include <cubemap/options.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char *const filter_names[] = {"auto",        "nearest",  "bilinear",
                                           "catmull-rom", "mitchell", "lanczos3",
                                           "spline36",    "bspline5", "ewa"};

const char *cm_filter_name(cm_filter filter)
{
    const unsigned index = (unsigned)filter;
    return index < sizeof filter_names / sizeof *filter_names ? filter_names[index] : NULL;
}

static int are_good(const cm_plan_options *options)
{
    return cm_filter_name(options->filter) != NULL && isfinite(options->tolerance) &&
           options->pixels_most >= 0.0 && isfinite(options->pixels_most) &&
           (unsigned)options->transfer <= CM_TRANSFER_GAMMA &&
           (options->transfer != CM_TRANSFER_GAMMA ||
            (options->gamma > 0.0 && isfinite(options->gamma))) &&
           options->alpha <= CM_CHANNELS_MAX && options->vector <= CM_CHANNELS_MAX - 2 &&
           (options->vector == 0 || options->alpha == 0 || options->alpha < options->vector ||
            options->alpha > options->vector + 2) &&
           (unsigned)options->not_finite <= CM_NOT_FINITE_ZERO;
}

static int is_good_memory(const cm_memory *memory)
{
    return memory == NULL ||
           (memory->size == sizeof *memory && memory->allocate != NULL && memory->release != NULL);
}

/* A vector of the source's axes is turned into those of the Earth, and from there into the target's. */
static void take_turn(cm_plan *plan)
{
    const cm_rotation *from = &plan->from->rotation;
    const cm_rotation *to = &plan->to->rotation;
    for (int i = 0; i < 3; i++)
    {
        for (int j = 0; j < 3; j++)
        {
            plan->turn[i][j] = to->row[i][0] * from->row[j][0] + to->row[i][1] * from->row[j][1] +
                               to->row[i][2] * from->row[j][2];
        }
    }
}

cm_status cm_plan_create(const cm_surface *from, const cm_surface *to,
                         const cm_plan_options *options, cm_plan **plan)
{
    const cm_plan_options none = {.size = sizeof none};
    const cm_plan_options *wish = options == NULL ? &none : options;
    if (from == NULL || to == NULL || plan == NULL || wish->size != sizeof none ||
        !is_good_memory(wish->memory))
    {
        return CM_ERROR_ARGUMENT;
    }
    if (!are_good(wish))
    {
        return CM_ERROR_RANGE;
    }
    if (cm_instructions_check(wish->instructions, NULL, 0) != CM_OK)
    {
        return CM_ERROR_INSTRUCTIONS;
    }
    cm_plan *made = calloc(1, sizeof *made);
    if (made == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    made->options = *wish;
    if (wish->memory != NULL)
    {
        made->memory = *wish->memory;
        made->options.memory = &made->memory;
    }
    made->options.tolerance = wish->tolerance == 0.0 ? CM_TOLERANCE : fmax(wish->tolerance, 0.0);
    made->options.pixels_most = wish->pixels_most == 0.0 ? CM_PIXELS_MOST : wish->pixels_most;
    cm_status status = cm_surface_copy(from, &made->from);
    status = status == CM_OK ? cm_surface_copy(to, &made->to) : status;
    if (status != CM_OK)
    {
        cm_plan_destroy(made);
        return status;
    }
    take_turn(made);
    *plan = made;
    return CM_OK;
}

void cm_plan_destroy(cm_plan *plan)
{
    if (plan != NULL)
    {
        cm_surface_destroy(plan->from);
        cm_surface_destroy(plan->to);
        free(plan);
    }
}
