/* SPDX-License-Identifier: MIT */
#include "modules/memory/checked_size.h"
#include "survey.h"

#include <math.h>
#include <stdlib.h>

static cm_status visit_blocks(const cm_plan *plan, uint32_t blocks, cm_geometry *geometry,
                              cm_group *groups, cm_survey_visitor *visit, void *user)
{
    const cm_surface *to = plan->to;
    const uint32_t columns = (to->width + CM_BLOCK_EDGE - 1) / CM_BLOCK_EDGE;
    const uint32_t rows = (to->height + CM_BLOCK_EDGE - 1) / CM_BLOCK_EDGE;
    const uint32_t per_plane = blocks / to->planes > 4 ? blocks / to->planes : 4;
    const uint32_t across = (uint32_t)ceil(sqrt(per_plane));
    const uint32_t down = (per_plane + across - 1) / across;
    cm_status status = CM_OK;
    for (uint32_t i = 0; i < to->planes * across * down && status == CM_OK; i++)
    {
        const unsigned plane = (unsigned)(i / (across * down));
        const uint32_t x = i % across, y = i / across % down;
        const unsigned count = cm_geometry_block(
            geometry, plane, (uint32_t)((2 * x + 1) * (uint64_t)columns / (2 * across)),
            (uint32_t)((2 * y + 1) * (uint64_t)rows / (2 * down)), groups);
        for (unsigned k = 0; k < count && status == CM_OK; k++)
        {
            status = visit(user, &groups[k]);
        }
    }
    return status;
}

cm_status cm_survey(const cm_plan *plan, uint32_t blocks, cm_survey_visitor *visit, void *user)
{
    cm_geometry *geometry = cm_geometry_create(plan, 1);
    cm_group *groups = cm_array_of(CM_GROUPS_MAX, sizeof *groups);
    const cm_status status = geometry == NULL || groups == NULL
                                 ? CM_ERROR_MEMORY
                                 : visit_blocks(plan, blocks, geometry, groups, visit, user);
    free(groups);
    cm_geometry_destroy(geometry);
    return status;
}
