/* SPDX-License-Identifier: MIT
 *
 * The occupied voxels of a level, in one walk: cubes above it are divided, what is below it is averaged.
 */
#include <string.h>

#include "cube_sum.h"
#include "interleave.h"
#include "walk.h"

typedef struct extraction
{
    const cm_octree *octree;
    int level;
    size_t capacity;
    cm_voxel *voxel;
    size_t count;
    uint32_t cube[3]; /* that of the level which the walk is in, larger than a block */
    int is_in_cube;
    cm_cube_sum sum; /* of it so far */
} extraction;

static void give(extraction *work, const cm_voxel *voxel)
{
    if (work->count < work->capacity)
    {
        work->voxel[work->count] = *voxel;
    }
    work->count++;
}

static void give_average(extraction *work, const cm_cube_sum *sum, const uint32_t place[3])
{
    const cm_voxel voxel = cm_cube_voxel(work->octree, sum, place, work->level);
    if (voxel.state == CM_VOXEL_OCCUPIED)
    {
        give(work, &voxel);
    }
}

/* ---- cubes larger than blocks: one after the other ---- */

static void end_cube(extraction *work)
{
    if (work->is_in_cube && cm_cube_is_occupied(&work->sum))
    {
        give_average(work, &work->sum, work->cube);
    }
    work->is_in_cube = 0;
}

/* The walk comes to something smaller than a cube. */
static void begin_cube(extraction *work, const uint32_t place[3])
{
    uint32_t cube[3];
    for (int axis = 0; axis < 3; axis++)
    {
        /* cubes are counted from the root, which is in the middle of the tree of a small map */
        const uint32_t first = work->octree->first[axis];
        cube[axis] = first + ((place[axis] - first) >> work->level << work->level);
    }
    if (!work->is_in_cube || memcmp(cube, work->cube, sizeof cube) != 0)
    {
        end_cube(work);
        memcpy(work->cube, cube, sizeof cube);
        work->sum = (cm_cube_sum){0};
        work->is_in_cube = 1;
    }
}

/* ---- what the walk meets ---- */

static int extract_even(void *user, const uint32_t place[3], int level, uint8_t alpha)
{
    extraction *work = user;
    if (level < work->level)
    {
        begin_cube(work, place);
        cm_cube_add(&work->sum, alpha, level);
        return 0;
    }
    const uint64_t voxels = alpha > CM_UNKNOWN ? (uint64_t)1 << 3 * (level - work->level) : 0;
    for (uint64_t i = 0; i < voxels; i++)
    {
        if (work->count >= work->capacity &&
            cm_box_has(work->octree->first, work->octree->beyond, place, level))
        {
            work->count += (size_t)(voxels - i); /* nobody could wait for each of a large cube */
            break;
        }
        uint32_t at[3];
        int is_inside = 1; /* a small map does not fill its tree */
        cm_divide(i, at);
        for (int axis = 0; axis < 3; axis++)
        {
            at[axis] = place[axis] + (at[axis] << work->level);
            is_inside &=
                at[axis] >= work->octree->first[axis] && at[axis] < work->octree->beyond[axis];
        }
        if (is_inside)
        {
            const cm_voxel voxel = cm_voxel_at(work->octree, at, work->level, alpha, 0);
            give(work, &voxel);
        }
    }
    return 0;
}

/* The place of a cell of level 0. */
static void place_of(const cm_region *region, unsigned block, unsigned cell, uint32_t place[3])
{
    unsigned at[3], in[3];
    cm_divide_3(block, at);
    cm_divide_3(cell, in);
    for (int axis = 0; axis < 3; axis++)
    {
        place[axis] = region->place[axis] + 8 * at[axis] + in[axis];
    }
}

static int extract_block(void *user, const cm_region *region, unsigned block, unsigned misses)
{
    extraction *work = user;
    const int is_solid = cm_block_is_solid(region, block);
    const int is_whole = work->level > CM_BLOCK_LEVEL;
    uint8_t alpha[512];
    uint32_t color[512], place[3];
    const unsigned detail =
        cm_block_read(region, block, &work->octree->rule, misses, alpha, is_solid ? color : NULL);
    if (is_whole)
    {
        place_of(region, block, 0, place);
        begin_cube(work, place);
        cm_cube_add_cells(&work->sum, alpha, color, detail, 0, 512);
        return 0;
    }
    if (work->level == 0)
    {
        for (unsigned cell = 0; cell < cm_cell_count(detail); cell++)
        {
            if (alpha[cell] > CM_UNKNOWN)
            {
                place_of(region, block, cell << 3 * detail, place);
                const cm_voxel voxel =
                    cm_voxel_at(work->octree, place, (int)detail, alpha[cell], color[cell]);
                give(work, &voxel);
            }
        }
        return 0;
    }
    const unsigned step = 1u << 3 * work->level;
    for (unsigned cell = 0; cell < 512; cell += step)
    {
        cm_cube_sum sum = {0};
        cm_cube_add_cells(&sum, alpha, color, detail, cell, step);
        if (cm_cube_is_occupied(&sum))
        {
            place_of(region, block, cell, place);
            give_average(work, &sum, place);
        }
    }
    return 0;
}

cm_status cm_octree_extract(const cm_octree *octree, int level, size_t capacity, cm_voxel *voxel,
                            size_t *count)
{
    if (octree == NULL || count == NULL || (voxel == NULL && capacity > 0))
    {
        return CM_ERROR_ARGUMENT;
    }
    if (level < 0 || level > octree->options.levels)
    {
        return CM_ERROR_RANGE;
    }
    extraction work = {.octree = octree, .level = level, .capacity = capacity, .voxel = voxel};
    cm_status status = CM_OK;
    if (level == octree->options.levels)
    {
        /* the root of a small map is not a cube of the tree */
        cm_voxel root;
        status = cm_look_at(octree, octree->options.centre, level, &root);
        if (status == CM_OK && root.state == CM_VOXEL_OCCUPIED)
        {
            give(&work, &root);
        }
    }
    else
    {
        cm_walk walk = {.only_solid = level <= CM_BLOCK_LEVEL,
                        .user = &work,
                        .even = extract_even,
                        .block = extract_block};
        cm_walk_all(octree, &walk);
        status = cm_walk_run(octree, &walk);
        end_cube(&work);
    }
    if (status != CM_OK)
    {
        return status;
    }
    *count = work.count;
    return work.count > capacity ? CM_ERROR_SPACE : CM_OK;
}
