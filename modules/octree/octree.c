/* SPDX-License-Identifier: MIT */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <cubemap/options.h>

#include "block_access.h"
#include "node_tree.h"
#include "ray_index.h"

/* The set that instructions of cm_options mean. */
static cm_status find_set(const char *instructions, const cm_octree_set **set)
{
    const cm_options options = {.size = sizeof options, .instructions = instructions};
    cm_mapping *mapping = NULL;
    const cm_status status = cm_mapping_create_with("gnomonic", NULL, &options, &mapping);
    if (status == CM_OK)
    {
        *set = cm_octree_set_find(cm_mapping_instructions(mapping));
        cm_mapping_destroy(mapping);
    }
    return status;
}

static int is_positive(double value)
{
    return value > 0.0 && value < 1e100;
}

/* A number of steps of log-odds: one at least. */
static uint8_t steps_of(double value, double step, unsigned most)
{
    const double steps = floor(value / step + 0.5);
    return (uint8_t)(steps < 1.0 ? 1.0 : steps > most ? (double)most : steps);
}

static cm_status make_rule(const cm_octree_options *options, cm_count_rule *rule)
{
    if (options->rule == CM_OCTREE_COUNTS)
    {
        *rule = (cm_count_rule){2, 2, 0, 255};
        return CM_OK;
    }
    if (options->rule != CM_OCTREE_LOG_ODDS || !is_positive(options->hit) ||
        !is_positive(-options->miss) || !is_positive(-options->low) || !is_positive(options->high))
    {
        return CM_ERROR_RANGE;
    }
    const double step = fmax(options->high, -options->low) / CM_UNKNOWN;
    rule->hit = steps_of(options->hit, step, 255);
    rule->miss = steps_of(-options->miss, step, 255);
    rule->low = (uint8_t)(CM_UNKNOWN - steps_of(-options->low, step, CM_UNKNOWN));
    rule->high = (uint8_t)(CM_UNKNOWN + steps_of(options->high, step, CM_UNKNOWN));
    return CM_OK;
}

static int are_good(const cm_octree_options *options)
{
    int good = is_positive(options->edge) && options->levels >= 1 &&
               options->levels <= CM_OCTREE_LEVELS_MAX;
    for (int axis = 0; axis < 3; axis++)
    {
        good &= options->centre[axis] > -1e100 && options->centre[axis] < 1e100;
    }
    good &= options->near >= 0.0 && options->near < 1e100;
    good &= options->far == 0.0 || (is_positive(options->far) && options->far > options->near);
    good &= options->noise >= 0.0 && options->noise <= 1.0;
    good &= options->footprint >= 0.0 && options->footprint < 1e6;
    good &= !options->no_return_is_free || (options->far > 0.0 && !options->endpoints_only);
    return good;
}

static cm_status fill(cm_octree *octree, const cm_octree_options *options)
{
    octree->options = *options;
    const char *instructions = options->instructions;
    octree->options.instructions = NULL;
    if (instructions != NULL)
    {
        octree->instructions = malloc(strlen(instructions) + 1);
        if (octree->instructions == NULL)
        {
            return CM_ERROR_MEMORY;
        }
        strcpy(octree->instructions, instructions);
        octree->options.instructions = octree->instructions;
    }
    octree->tree_level = options->levels > CM_REGION_LEVEL ? options->levels : CM_REGION_LEVEL;
    const uint32_t middle = (uint32_t)1 << (octree->tree_level - 1);
    const uint32_t half = (uint32_t)1 << (options->levels - 1);
    for (int axis = 0; axis < 3; axis++)
    {
        octree->first[axis] = middle - half;
        octree->beyond[axis] = middle + half;
    }
    return cm_nodes_make(octree) ? CM_OK : CM_ERROR_MEMORY;
}

cm_status cm_octree_create(const cm_octree_options *options, cm_octree **octree)
{
    if (options == NULL || octree == NULL || options->size != sizeof *options ||
        (options->memory != 0 && options->pages == NULL))
    {
        return CM_ERROR_ARGUMENT;
    }
    cm_count_rule rule;
    const cm_octree_set *set = NULL;
    cm_status status = are_good(options) ? make_rule(options, &rule) : CM_ERROR_RANGE;
    status = status != CM_OK ? status : find_set(options->instructions, &set);
    if (status != CM_OK)
    {
        return status;
    }
    cm_octree *made = calloc(1, sizeof *made);
    if (made == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    made->rule = rule;
    made->set = set;
    status = fill(made, options);
    if (status != CM_OK)
    {
        cm_octree_destroy(made);
        return status;
    }
    *octree = made;
    return CM_OK;
}

void cm_octree_destroy(cm_octree *octree)
{
    if (octree != NULL)
    {
        if (octree->desk_destroy != NULL)
        {
            octree->desk_destroy(octree->desk);
        }
        cm_ray_index_forget(octree);
        cm_nodes_drop(octree);
        free(octree->user_data);
        free(octree->instructions);
        free(octree);
    }
}

const cm_octree_options *cm_octree_describe(const cm_octree *octree)
{
    return &octree->options;
}

uint64_t cm_octree_step(const cm_octree *octree)
{
    return octree->step;
}

int cm_octree_is_empty(const cm_octree *octree)
{
    return octree->node[0].kind == CM_NODE_LEAF && octree->node[0].value == CM_UNKNOWN;
}
