/* SPDX-License-Identifier: MIT
 *
 * What an update changes in one block: its counts and its colors.
 */
#include "interleave.h"
#include "update_desk.h"

int cm_update_is_within(const cm_octree *octree, const cm_region *region, unsigned block)
{
    unsigned at[3];
    cm_divide_3(block, at);
    int within = 1;
    for (int axis = 0; axis < 3; axis++)
    {
        const uint32_t first = region->place[axis] + 8 * at[axis];
        within &= first >= octree->first[axis] && first + 8 <= octree->beyond[axis];
    }
    return within;
}

uint64_t cm_update_valid(const cm_octree *octree, const cm_region *region, unsigned block,
                         unsigned detail, unsigned group)
{
    if (cm_update_is_within(octree, region, block))
    {
        return ~(uint64_t)0;
    }
    unsigned at[3];
    cm_divide_3(block, at);
    uint64_t valid = 0;
    const size_t cells = cm_cell_count(detail);
    for (unsigned i = 0; i < 64 && i < cells; i++)
    {
        unsigned in[3];
        cm_divide_3((64 * group + i) << 3 * detail, in);
        int is_valid = 1;
        for (int axis = 0; axis < 3; axis++)
        {
            const uint32_t place = region->place[axis] + 8 * at[axis] + in[axis];
            is_valid &= place >= octree->first[axis] && place < octree->beyond[axis];
        }
        valid |= (uint64_t)is_valid << i;
    }
    return valid;
}

/* Hits without a color: what was no longer occupied has none of its former life. */
static void forget_colors(const uint8_t alpha[64], uint32_t *color, uint64_t hits)
{
    for (; hits != 0; hits &= hits - 1)
    {
        const unsigned i = (unsigned)__builtin_ctzll(hits);
        color[i] = alpha[i] > CM_UNKNOWN ? color[i] : 0;
    }
}

/* Before its alphas change. Adds to *has_changed; 0 if there is no memory. */
static int update_colors(const cm_update *update, cm_region *region, unsigned block,
                         const uint8_t *alpha, const cm_block_change *change, size_t groups,
                         int *has_changed)
{
    if (update->has_color)
    {
        uint32_t *color = cm_block_colors(region, block);
        if (color == NULL)
        {
            return 0;
        }
        *has_changed |= update->set->color(&update->hit, groups, alpha, change->hits,
                                           (const int32_t(*)[64])change->pixel, color);
        return 1;
    }
    uint32_t *color = region->color != NULL ? region->color[block] : NULL;
    for (size_t group = 0; color != NULL && group < groups; group++)
    {
        forget_colors(alpha + 64 * group, color + 64 * group, change->hits[group]);
    }
    return 1;
}

int cm_update_block(cm_update *update, cm_region *region, unsigned block,
                    const cm_block_change *change)
{
    const cm_count_rule *rule = &update->octree->rule;
    uint8_t *alpha = cm_block_open(region, block, rule, change->detail);
    if (alpha == NULL)
    {
        return 0;
    }
    const size_t groups = (cm_cell_count(region->detail[block]) + 63) / 64;
    uint64_t any_hits = 0;
    for (size_t group = 0; group < groups; group++)
    {
        any_hits |= change->hits[group];
    }
    int has_changed = 0;
    if (any_hits != 0 && !update_colors(update, region, block, alpha, change, groups, &has_changed))
    {
        return 0;
    }
    has_changed |= update->set->count(groups, alpha, change->hits, change->misses, rule->hit,
                                      rule->miss, rule->low, rule->high);
    if (has_changed)
    {
        region->changed[block] = update->octree->step;
    }
    if (any_hits != 0)
    {
        cm_region_mark(region, block, 1);
    }
    else
    {
        cm_block_settle(region, block);
    }
    return 1;
}

void cm_update_free_block(cm_update *update, cm_region *region, unsigned block)
{
    const cm_count_rule *rule = &update->octree->rule;
    const uint8_t old = region->value[block];
    const int is_even = region->form[block] == CM_BLOCK_EVEN;
    region->value[block] = is_even ? cm_after_misses(rule, old, 1) : cm_more_misses(old, 1);
    if (region->value[block] != old)
    {
        region->changed[block] = update->octree->step;
    }
    cm_block_drain(region, block, rule);
}
