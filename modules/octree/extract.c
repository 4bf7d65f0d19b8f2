/* SPDX-License-Identifier: MIT
 *
 * Voxels of a map, one after the other: those of a box, and those that changed; and how many there are.
 */
#include <math.h>
#include <string.h>

#include "block_access.h"
#include "interleave.h"
#include "node_tree.h"
#include "walk.h"

/* ---- walks ---- */

/* Places of centres are doubled: those of finest voxels are between whole ones, those of larger voxels are not. */
typedef struct voxel_walk
{
    const cm_octree *octree;
    cm_voxel_job job;
    void *user;
    uint64_t least[3]; /* of centres, and the greatest */
    uint64_t greatest[3];
    uint32_t first[3]; /* the finest voxels whose centres are between */
    uint32_t beyond[3];
} voxel_walk;

static int has_centre(const voxel_walk *work, const uint32_t place[3], int level)
{
    int has = 1;
    for (int axis = 0; axis < 3; axis++)
    {
        const uint64_t centre = 2 * (uint64_t)place[axis] + (1u << level);
        has &= centre >= work->least[axis] && centre <= work->greatest[axis];
    }
    return has;
}

/* A cube in the box, or those parts of it that are. */
static int give_even(void *user, const uint32_t place[3], int level, uint8_t alpha)
{
    const voxel_walk *work = user;
    if (alpha == CM_UNKNOWN)
    {
        return 0;
    }
    if (cm_box_has(work->first, work->beyond, place, level))
    {
        const cm_voxel voxel = cm_voxel_at(work->octree, place, level, alpha, 0);
        return work->job(work->user, &voxel);
    }
    int stops = 0;
    for (unsigned child = 0; level > 0 && !stops && child < 8; child++)
    {
        uint32_t below[3];
        for (int axis = 0; axis < 3; axis++)
        {
            below[axis] = place[axis] + ((child >> axis & 1u) << (level - 1));
        }
        stops = cm_box_meets(work->first, work->beyond, below, level - 1) &&
                give_even(user, below, level - 1, alpha);
    }
    return stops;
}

static int give_block(void *user, const cm_region *region, unsigned block, unsigned misses)
{
    const voxel_walk *work = user;
    uint8_t alpha[512];
    uint32_t color[512];
    const unsigned detail = cm_block_read(region, block, &work->octree->rule, misses, alpha, color);
    unsigned at[3];
    cm_divide_3(block, at);
    for (unsigned cell = 0; cell < cm_cell_count(detail); cell++)
    {
        unsigned in[3];
        cm_divide_3(cell << 3 * detail, in);
        const uint32_t place[3] = {region->place[0] + 8 * at[0] + in[0],
                                   region->place[1] + 8 * at[1] + in[1],
                                   region->place[2] + 8 * at[2] + in[2]};
        if (alpha[cell] != CM_UNKNOWN && has_centre(work, place, (int)detail))
        {
            const cm_voxel voxel =
                cm_voxel_at(work->octree, place, (int)detail, alpha[cell], color[cell]);
            if (work->job(work->user, &voxel))
            {
                return 1;
            }
        }
    }
    return 0;
}

/* Those whose doubled centres are in the work's box, of blocks that changed after a step. */
static cm_status walk_voxels(voxel_walk *work, uint64_t since)
{
    cm_walk walk = {.user = work, .since = since, .even = give_even, .block = give_block};
    for (int axis = 0; axis < 3; axis++)
    {
        work->first[axis] = (uint32_t)(work->least[axis] / 2);
        work->beyond[axis] = (uint32_t)((work->greatest[axis] + 1) / 2);
        /* with the voxel behind a border on which the centre of a larger one is */
        walk.first[axis] = work->first[axis];
        walk.beyond[axis] = (uint32_t)(work->greatest[axis] / 2 + 1);
    }
    return cm_walk_run(work->octree, &walk);
}

/* The first doubled place that is not below what is in the world, by the places themselves, since they are rounded. */
static double first_from(const cm_octree *octree, int axis, double world)
{
    const double edge = octree->options.edge;
    double place =
        floor((world - octree->options.centre[axis]) / edge * 2.0) + ldexp(1.0, octree->tree_level);
    place += cm_place_world(octree, axis, 0.5 * place) < world;
    place -= cm_place_world(octree, axis, 0.5 * (place - 1.0)) >= world;
    return place;
}

/* And the last that is not above it. */
static double last_to(const cm_octree *octree, int axis, double world)
{
    const double place = first_from(octree, axis, world);
    return cm_place_world(octree, axis, 0.5 * place) > world ? place - 1.0 : place;
}

cm_status cm_octree_walk_box(const cm_octree *octree, const double least[3],
                             const double greatest[3], cm_voxel_job job, void *user)
{
    if (octree == NULL || least == NULL || greatest == NULL || job == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    voxel_walk work = {.octree = octree, .job = job, .user = user};
    for (int axis = 0; axis < 3; axis++)
    {
        const double root[2] = {2.0 * octree->first[axis], 2.0 * octree->beyond[axis]};
        const double first = first_from(octree, axis, least[axis]),
                     last = last_to(octree, axis, greatest[axis]);
        const double from = first > root[0] ? first : root[0], to = last < root[1] ? last : root[1];
        if (!(from <= to && least[axis] <= greatest[axis]))
        {
            return CM_OK;
        }
        work.least[axis] = (uint64_t)from;
        work.greatest[axis] = (uint64_t)to;
    }
    return walk_voxels(&work, 0);
}

cm_status cm_octree_walk_changes(const cm_octree *octree, uint64_t since, cm_voxel_job job,
                                 void *user)
{
    if (octree == NULL || job == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    voxel_walk work = {.octree = octree, .job = job, .user = user};
    for (int axis = 0; axis < 3; axis++)
    {
        work.least[axis] = 2 * (uint64_t)octree->first[axis];
        work.greatest[axis] = 2 * (uint64_t)octree->beyond[axis];
    }
    return walk_voxels(&work, since);
}

/* ---- blocks with what is occupied ---- */

typedef struct block_walk
{
    const cm_octree *octree;
    cm_block_job job;
    void *user;
    uint8_t alpha[512];
    uint8_t color[512][3];
    uint32_t word[512];
} block_walk;

static int give_values(block_walk *work, const uint32_t place[3], unsigned detail, int has_color)
{
    const int64_t middle = (int64_t)1 << (work->octree->tree_level - 1);
    const cm_block_values values = {
        .corner = {place[0] - middle, place[1] - middle, place[2] - middle},
        .detail = (int)detail,
        .alpha = work->alpha,
        .color = has_color ? (const uint8_t(*)[3])work->color : NULL,
    };
    return work->job(work->user, &values);
}

static int give_occupied_even(void *user, const uint32_t place[3], int level, uint8_t alpha)
{
    block_walk *work = user;
    if (alpha <= CM_UNKNOWN)
    {
        return 0;
    }
    memset(work->alpha, alpha, sizeof work->alpha);
    int stops = 0;
    const uint64_t blocks = (uint64_t)1 << 3 * (level - CM_BLOCK_LEVEL);
    for (uint64_t i = 0; !stops && i < blocks; i++)
    {
        uint32_t at[3] = {0, 0, 0};
        for (int bit = 0; bit < level - CM_BLOCK_LEVEL; bit++)
        {
            for (int axis = 0; axis < 3; axis++)
            {
                at[axis] |= (uint32_t)(i >> (3 * bit + axis) & 1u) << bit;
            }
        }
        const uint32_t below[3] = {place[0] + 8 * at[0], place[1] + 8 * at[1],
                                   place[2] + 8 * at[2]};
        stops = give_values(work, below, 0, 0);
    }
    return stops;
}

static int give_occupied_block(void *user, const cm_region *region, unsigned block, unsigned misses)
{
    block_walk *work = user;
    uint8_t alpha[512];
    uint32_t color[512];
    const unsigned detail = cm_block_read(region, block, &work->octree->rule, misses, alpha, color);
    int is_occupied = 0, has_color = 0;
    for (unsigned cell = 0; cell < 512; cell++)
    {
        work->alpha[cell] = alpha[cell >> 3 * detail];
        const uint32_t word = color[cell >> 3 * detail];
        is_occupied |= work->alpha[cell] > CM_UNKNOWN;
        has_color |= word != 0;
        cm_color_to(word, work->color[cell]);
    }
    unsigned at[3];
    cm_divide_3(block, at);
    const uint32_t place[3] = {region->place[0] + 8 * at[0], region->place[1] + 8 * at[1],
                               region->place[2] + 8 * at[2]};
    return is_occupied && give_values(work, place, detail, has_color);
}

cm_status cm_octree_occupied_blocks(const cm_octree *octree, cm_block_job job, void *user)
{
    block_walk work = {.octree = octree, .job = job, .user = user};
    cm_walk walk = {
        .only_solid = 1, .user = &work, .even = give_occupied_even, .block = give_occupied_block};
    cm_walk_all(octree, &walk);
    return cm_walk_run(octree, &walk);
}

/* ---- counts ---- */

typedef struct voxel_count
{
    const cm_octree *octree;
    uint64_t occupied;
    uint64_t free;
    uint64_t cells;
} voxel_count;

/* Voxels of a cube that are the map's: a small map does not fill its region. */
static uint64_t voxels_of(const cm_octree *octree, const uint32_t place[3], int level)
{
    uint64_t voxels = 1;
    for (int axis = 0; axis < 3; axis++)
    {
        const uint64_t end = (uint64_t)place[axis] + (1u << level);
        const uint64_t first =
            place[axis] > octree->first[axis] ? place[axis] : octree->first[axis];
        const uint64_t beyond = end < octree->beyond[axis] ? end : octree->beyond[axis];
        voxels *= beyond > first ? beyond - first : 0;
    }
    return voxels;
}

static int count_even(void *user, const uint32_t place[3], int level, uint8_t alpha)
{
    voxel_count *count = user;
    if (alpha != CM_UNKNOWN)
    {
        const uint64_t voxels = voxels_of(count->octree, place, level);
        count->occupied += alpha > CM_UNKNOWN ? voxels : 0;
        count->free += alpha < CM_UNKNOWN ? voxels : 0;
    }
    return 0;
}

static int count_block(void *user, const cm_region *region, unsigned block, unsigned misses)
{
    voxel_count *count = user;
    uint8_t alpha[512];
    const unsigned detail = cm_block_read(region, block, &count->octree->rule, misses, alpha, NULL);
    const size_t cells = cm_cell_count(detail);
    for (size_t cell = 0; cell < cells; cell++)
    {
        count->occupied += alpha[cell] > CM_UNKNOWN ? (uint64_t)1 << 3 * detail : 0;
        count->free += alpha[cell] < CM_UNKNOWN ? (uint64_t)1 << 3 * detail : 0;
    }
    count->cells += cells;
    return 0;
}

cm_status cm_octree_count_voxels(const cm_octree *octree, cm_octree_count *count)
{
    if (octree == NULL || count == NULL || count->size != sizeof *count)
    {
        return CM_ERROR_ARGUMENT;
    }
    voxel_count sum = {.octree = octree};
    cm_walk walk = {.user = &sum, .even = count_even, .block = count_block};
    cm_walk_all(octree, &walk);
    const cm_status status = cm_walk_run(octree, &walk);
    if (status != CM_OK)
    {
        return status;
    }
    count->occupied = sum.occupied;
    count->free = sum.free;
    count->nodes = octree->node_count;
    count->paged = 0;
    for (size_t i = 0; i < octree->node_count; i++)
    {
        count->nodes += octree->node[i].kind == CM_NODE_REGION ? CM_REGION_BLOCKS : 0;
        count->paged += octree->node[i].kind == CM_NODE_PAGED;
    }
    count->nodes += sum.cells;
    count->bytes = octree->bytes + octree->node_count * sizeof *octree->node;
    return CM_OK;
}
