/* SPDX-License-Identifier: MIT
 *
 * Blocks of pixels by patches or between nodes, where that is as exact as is asked, and pixel by pixel elsewhere.
 */
#include "geometry.h"

#include "geometry_between.h"
#include "geometry_edges.h"
#include "geometry_exact.h"
#include "patch.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Of cm_lattice_fine. */
#define LATTICE_BLOCKS 8

/* Lattices that are kept, each for its columns, from a row of blocks to the next. */
#define LATTICES_MOST 128

/* Places so far beyond a plane are still its own: filters reach beyond its edges. */
#define SLACK_MOST 0.25

struct cm_geometry
{
    const cm_plan *plan;
    const cm_place_set *set;
    int derivatives;
    cm_geometry_count count;
    cm_between between;
    uint32_t lattices;
    cm_lattice *lattice;
    cm_patches *patches; /* NULL: there are none */
};

/* ---- life ---- */

static uint32_t blocks_of(uint32_t pixels)
{
    return (pixels + CM_BLOCK_EDGE - 1) / CM_BLOCK_EDGE;
}

cm_geometry *cm_geometry_create(const cm_plan *plan, int derivatives)
{
    cm_geometry *made = calloc(1, sizeof *made);
    if (made == NULL)
    {
        return NULL;
    }
    const uint32_t chunks = (blocks_of(plan->to->width) + LATTICE_BLOCKS - 1) / LATTICE_BLOCKS;
    made->plan = plan;
    made->set = cm_place_set_find(plan->options.instructions);
    made->derivatives = derivatives;
    cm_between_begin(plan, made->set, derivatives, &made->between);
    made->lattices = chunks < LATTICES_MOST ? chunks : LATTICES_MOST;
    made->lattice = calloc(made->lattices, sizeof *made->lattice);
    for (uint32_t i = 0; made->lattice != NULL && i < made->lattices; i++)
    {
        made->lattice[i].shape = &cm_lattice_fine;
    }
    const int has_patches = !derivatives && !made->between.is_creased;
    made->patches = has_patches ? cm_patches_create(plan, made->set) : NULL;
    if (made->lattice == NULL || made->set == NULL || (has_patches && made->patches == NULL))
    {
        cm_geometry_destroy(made);
        return NULL;
    }
    return made;
}

void cm_geometry_destroy(cm_geometry *geometry)
{
    if (geometry != NULL)
    {
        cm_patches_destroy(geometry->patches);
        free(geometry->lattice);
        free(geometry);
    }
}

cm_geometry_count cm_geometry_counted(const cm_geometry *geometry)
{
    return geometry->count;
}

/* ---- blocks ---- */

static cm_lattice *lattice_at(cm_geometry *geometry, unsigned plane, uint32_t block_column,
                              uint32_t block_row)
{
    const uint32_t chunk = block_column / LATTICE_BLOCKS;
    cm_lattice *lattice = &geometry->lattice[chunk % geometry->lattices];
    cm_lattice_fill(lattice, geometry->plan, geometry->set, plane, block_row, chunk);
    return lattice;
}

/* A block of a patch. Returns 0 if it is none. */
static int patch_block(cm_geometry *geometry, unsigned plane, uint32_t block_column,
                       uint32_t block_row, cm_group *group)
{
    cm_patch_places places;
    if (!cm_patches_block(geometry->patches, plane, block_column, block_row, &places, group->x,
                          group->y))
    {
        return 0;
    }
    group->plane = places.plane;
    group->column = places.column;
    group->row = places.row;
    group->count = CM_BLOCK_PIXELS;
    group->is_bounded = 1;
    group->is_tight = 1;
    memcpy(group->low, places.low, sizeof group->low);
    memcpy(group->high, places.high, sizeof group->high);
    group->pixel = geometry->between.all_pixels;
    return 1;
}

/* Returns how many groups there are; 0: the block is to be done exactly. */
static unsigned near_block(cm_geometry *geometry, unsigned plane, uint32_t block_column,
                           uint32_t block_row, cm_group *groups)
{
    const cm_plan *plan = geometry->plan;
    const double slack = fmin(plan->options.tolerance, SLACK_MOST);
    cm_between_found found = CM_BETWEEN_ANYWHERE;
    if (geometry->patches == NULL || !patch_block(geometry, plane, block_column, block_row, groups))
    {
        cm_lattice_copy copy;
        const cm_lattice *lattice = lattice_at(geometry, plane, block_column, block_row);
        const cm_lattice_view view = cm_lattice_see(lattice, geometry->set, plan->from->period,
                                                    block_column % LATTICE_BLOCKS, &copy);
        found = cm_between_block(&geometry->between, &view, lattice->is_uniform, slack, groups);
    }
    if (found == CM_BETWEEN_NONE)
    {
        return 0;
    }
    cm_group_drop_beyond(plan->to, geometry->derivatives, block_column, block_row, groups);
    return found == CM_BETWEEN_INSIDE
               ? 1
               : cm_group_settle(plan->from, geometry->derivatives, slack, groups);
}

unsigned cm_geometry_block(cm_geometry *geometry, unsigned plane, uint32_t block_column,
                           uint32_t block_row, cm_group *groups)
{
    const unsigned used = geometry->plan->options.tolerance > 0.0
                              ? near_block(geometry, plane, block_column, block_row, groups)
                              : 0;
    if (used != 0)
    {
        geometry->count.interpolated++;
        return used;
    }
    geometry->count.exact++;
    return cm_exact_block(geometry->plan, geometry->derivatives, plane, block_column, block_row,
                          groups);
}
