/* SPDX-License-Identifier: MIT
 *
 * Rays through a map, from cube to cube. Steps are between whole places, so that none goes back and none stays: the next cube begins
 * at the border that the ray leaves this one by, and the other two places are cut to what this one has.
 */
#include <math.h>
#include <string.h>

#include "indexed_ray.h"
#include "interleave.h"
#include "node_tree.h"
#include "paging.h"
#include "walk.h"

/* A ray in voxels of the tree. */
typedef struct ray_state
{
    const cm_octree *octree;
    cm_ray_line line;
    /* where it was looked up last: the region there, and the nodes above it with the misses that wait from each on upwards */
    const cm_region *region;
    unsigned misses;
    uint32_t looked[3];
    uint32_t node[CM_OCTREE_LEVELS_MAX + 1];
    uint8_t waiting[CM_OCTREE_LEVELS_MAX + 1];
    int has_nodes;
} ray_state;

/* A cube of one alpha: an even one, or a voxel. */
typedef struct ray_cube
{
    uint32_t corner[3];
    int level;
    uint8_t alpha;
    uint32_t color;
} ray_cube;

/* A direction as it is, but for lengths whose squares are no numbers: these by a power of two, which rounds nothing that counts. */
static double usual_length(const double direction[3], double usual[3])
{
    const double most = fmax(fabs(direction[0]), fmax(fabs(direction[1]), fabs(direction[2])));
    const int is_usual = most > 1e-100 && most < 1e100;
    double square = 0.0;
    for (int axis = 0; axis < 3; axis++)
    {
        usual[axis] = is_usual || !(most > 0.0 && most < INFINITY)
                          ? direction[axis]
                          : ldexp(direction[axis], -ilogb(most));
        square += usual[axis] * usual[axis];
    }
    return sqrt(square);
}

/* A ray at where it enters the box [first, beyond) of voxels, or begins in it. 0: it does not. */
static int begin(ray_state *ray, const cm_octree *octree, const uint32_t first[3],
                 const uint32_t beyond[3], const double origin[3], const double direction[3],
                 double far)
{
    double towards[3];
    const double length = usual_length(direction, towards);
    const double middle = (double)((uint64_t)1 << (octree->tree_level - 1));
    ray->octree = octree;
    ray->region = NULL;
    ray->has_nodes = 0;
    ray->line.at = 0.0;
    ray->line.end =
        far > 0.0 ? nextafter(far, INFINITY) : INFINITY; /* far itself belongs to the ray */
    int good = length > 0.0 && length < 1e100 && far >= 0.0;
    for (int axis = 0; axis < 3; axis++)
    {
        ray->line.origin[axis] =
            (origin[axis] - octree->options.centre[axis]) / octree->options.edge + middle;
        ray->line.step[axis] = towards[axis] / length / octree->options.edge;
        ray->line.by[axis] = 1.0 / ray->line.step[axis];
        if (!(fabs(ray->line.by[axis]) < CM_RAY_STANDS))
        {
            ray->line.step[axis] = 0.0;
        }
        good &= fabs(ray->line.origin[axis]) < 1e15;
        const double low = first[axis], high = beyond[axis];
        if (ray->line.step[axis] == 0.0)
        {
            good &= ray->line.origin[axis] >= low && ray->line.origin[axis] < high;
            continue;
        }
        const double a = (low - ray->line.origin[axis]) * ray->line.by[axis];
        const double b = (high - ray->line.origin[axis]) * ray->line.by[axis];
        const double enters = a < b ? a : b, leaves = a < b ? b : a;
        ray->line.at = enters > ray->line.at ? enters : ray->line.at;
        ray->line.end = leaves < ray->line.end ? leaves : ray->line.end;
    }
    for (int axis = 0; good && axis < 3; axis++)
    {
        /* what is below 0 is below the box */
        const double place = ray->line.origin[axis] + ray->line.at * ray->line.step[axis];
        const double low = first[axis], high = beyond[axis] - 1.0;
        ray->line.place[axis] = (int32_t)(place < low ? low : place > high ? high : place);
    }
    return good && ray->line.at <= ray->line.end;
}

/* As cm_node_find, from the node that this place and the last one share. */
static cm_spot find_spot(ray_state *ray, const uint32_t place[3])
{
    const cm_octree *octree = ray->octree;
    int level = octree->tree_level;
    if (ray->has_nodes)
    {
        const uint32_t other =
            (place[0] ^ ray->looked[0]) | (place[1] ^ ray->looked[1]) | (place[2] ^ ray->looked[2]);
        const int shared = other == 0 ? 0 : 32 - __builtin_clz(other);
        level = shared < ray->has_nodes ? ray->has_nodes : shared;
    }
    else
    {
        ray->node[level] = 0;
        ray->waiting[level] = 0;
    }
    cm_spot spot = {ray->node[level], level, ray->waiting[level]};
    while (octree->node[spot.node].kind == CM_NODE_INNER)
    {
        const cm_node *node = &octree->node[spot.node];
        spot.misses = cm_more_misses(spot.misses, node->value);
        spot.level--;
        spot.node = node->link + (place[0] >> spot.level & 1u) +
                    2u * (place[1] >> spot.level & 1u) + 4u * (place[2] >> spot.level & 1u);
        ray->node[spot.level] = spot.node;
        ray->waiting[spot.level] = (uint8_t)spot.misses;
    }
    if (octree->node[spot.node].kind != CM_NODE_LEAF)
    {
        spot.misses = cm_more_misses(spot.misses, octree->node[spot.node].value);
    }
    ray->has_nodes = spot.level;
    memcpy(ray->looked, place, sizeof ray->looked);
    return spot;
}

/* The region that the ray is in, or the cube of a leaf, which has none. */
static cm_status find(ray_state *ray, ray_cube *cube)
{
    const cm_octree *octree = ray->octree;
    const uint32_t place[3] = {(uint32_t)ray->line.place[0], (uint32_t)ray->line.place[1],
                               (uint32_t)ray->line.place[2]};
    const cm_region *region = ray->region;
    if (region != NULL && ((place[0] ^ region->place[0]) | (place[1] ^ region->place[1]) |
                           (place[2] ^ region->place[2])) >>
                                  CM_REGION_LEVEL ==
                              0)
    {
        return CM_OK;
    }
    const cm_spot spot = find_spot(ray, place);
    const cm_node *node = &octree->node[spot.node];
    ray->region = NULL;
    if (node->kind == CM_NODE_LEAF)
    {
        for (int axis = 0; axis < 3; axis++)
        {
            cube->corner[axis] = place[axis] >> spot.level << spot.level;
        }
        cube->level = spot.level;
        cube->alpha = cm_after_misses(&octree->rule, node->value, spot.misses);
        cube->color = 0;
        return CM_OK;
    }
    ray->misses = spot.misses;
    return cm_node_look(octree, spot.node, place, &ray->region);
}

/* What is where the ray is. */
static cm_status look(ray_state *ray, ray_cube *cube)
{
    const cm_octree *octree = ray->octree;
    const cm_status status = find(ray, cube);
    const cm_region *region = ray->region;
    if (status != CM_OK || region == NULL)
    {
        return status;
    }
    const uint32_t place[3] = {(uint32_t)ray->line.place[0], (uint32_t)ray->line.place[1],
                               (uint32_t)ray->line.place[2]};
    const unsigned block = cm_interleave_3(place[0] >> 3, place[1] >> 3, place[2] >> 3);
    const unsigned cell = cm_interleave_3(place[0], place[1], place[2]);
    const unsigned level =
        region->form[block] == CM_BLOCK_EVEN ? (unsigned)CM_BLOCK_LEVEL : region->detail[block];
    cube->level = (int)level;
    for (int axis = 0; axis < 3; axis++)
    {
        cube->corner[axis] = place[axis] >> level << level;
    }
    cube->alpha = cm_block_cell(region, block, &octree->rule, ray->misses, cell, NULL);
    if (cube->alpha > CM_UNKNOWN)
    {
        cm_block_cell(region, block, &octree->rule, ray->misses, cell, &cube->color);
    }
    return CM_OK;
}

/* To the cube behind this one; 0 at the ray's end. */
static int leave(ray_state *ray, const ray_cube *cube)
{
    const double size = (double)((uint64_t)1 << cube->level);
    double out[3];
    for (int axis = 0; axis < 3; axis++)
    {
        const double border = cube->corner[axis] + (ray->line.step[axis] > 0.0 ? size : 0.0);
        out[axis] = ray->line.step[axis] == 0.0
                        ? INFINITY
                        : (border - ray->line.origin[axis]) * ray->line.by[axis];
    }
    int axis = out[0] <= out[1] ? 0 : 1;
    axis = out[axis] <= out[2] ? axis : 2;
    ray->line.at = ray->line.at > out[axis] ? ray->line.at : out[axis];
    if (!(ray->line.at < ray->line.end))
    {
        return 0;
    }
    for (int i = 0; i < 3; i++)
    {
        const double low = cube->corner[i], high = cube->corner[i] + size - 1.0;
        const double place = ray->line.origin[i] + ray->line.at * ray->line.step[i];
        ray->line.place[i] = (int32_t)(place < low ? low : place > high ? high : place);
    }
    ray->line.place[axis] =
        (int32_t)cube->corner[axis] + (ray->line.step[axis] > 0.0 ? (int32_t)size : -1);
    return ray->line.place[axis] >= (int32_t)ray->octree->first[axis] &&
           ray->line.place[axis] < (int32_t)ray->octree->beyond[axis];
}

static cm_voxel voxel_of(const ray_state *ray, const ray_cube *cube)
{
    cm_voxel voxel = cm_voxel_at(ray->octree, cube->corner, cube->level, cube->alpha, cube->color);
    voxel.distance = ray->line.at;
    return voxel;
}

/* The largest cube around a place of a region whose blocks have nothing occupied; 0 if its own block may have. */
static int empty_level(const cm_region *region, unsigned block)
{
    const uint64_t word = region->solid[block / 64];
    if (word >> block % 64 & 1u)
    {
        return 0;
    }
    if (word != 0)
    {
        return (word >> (block & 56u) & 255u) == 0 ? CM_BLOCK_LEVEL + 1 : CM_BLOCK_LEVEL;
    }
    uint64_t any = 0;
    for (unsigned i = 0; i < CM_REGION_BLOCKS / 64; i++)
    {
        any |= region->solid[i];
    }
    return any == 0 ? CM_REGION_LEVEL : CM_REGION_LEVEL - 1;
}

/* From voxel to voxel in a block, up to the first that is occupied: 1. 0: it is in none, and the ray is where it leaves the block, or
 * at its end, which it does not reach then. */
static int march(ray_state *ray, unsigned block)
{
    static const uint8_t spread[8] = {0, 1, 8, 9, 64, 65, 72, 73};
    const cm_region *region = ray->region;
    const unsigned misses = cm_more_misses(ray->misses, region->value[block]);
    const unsigned least = CM_UNKNOWN + misses * ray->octree->rule.miss;
    const unsigned shift = 3 * region->detail[block];
    double next[3], border[3];
    int32_t in[3];
    for (int axis = 0; axis < 3; axis++)
    {
        border[axis] = ray->line.place[axis] + (ray->line.step[axis] > 0.0 ? 1.0 : 0.0);
        next[axis] = ray->line.step[axis] == 0.0
                         ? INFINITY
                         : (border[axis] - ray->line.origin[axis]) * ray->line.by[axis];
        in[axis] = ray->line.place[axis] & 7;
    }
    for (;;)
    {
        const unsigned cell =
            (unsigned)spread[in[0]] | (unsigned)spread[in[1]] << 1 | (unsigned)spread[in[2]] << 2;
        if (cm_block_stored(region, block, cell >> shift) > least)
        {
            return 1;
        }
        int axis = next[0] <= next[1] ? 0 : 1;
        axis = next[axis] <= next[2] ? axis : 2;
        ray->line.at = ray->line.at > next[axis] ? ray->line.at : next[axis];
        if (!(ray->line.at < ray->line.end))
        {
            return 0;
        }
        const int sign = ray->line.step[axis] > 0.0 ? 1 : -1;
        border[axis] += sign;
        next[axis] = (border[axis] - ray->line.origin[axis]) * ray->line.by[axis];
        in[axis] += sign;
        ray->line.place[axis] += sign;
        if (in[axis] & ~7)
        {
            return 0;
        }
    }
}

static int is_inside(const ray_state *ray)
{
    int inside = 1;
    for (int axis = 0; axis < 3; axis++)
    {
        inside &= ray->line.place[axis] >= (int32_t)ray->octree->first[axis] &&
                  ray->line.place[axis] < (int32_t)ray->octree->beyond[axis];
    }
    return inside;
}

/* On to the first occupied cube: 1, and it is in cube. 0: there is none. */
static int cast(ray_state *ray, ray_cube *cube)
{
    while (find(ray, cube) == CM_OK)
    {
        const cm_region *region = ray->region;
        int level = 0;
        if (region != NULL)
        {
            const unsigned block = cm_interleave_3((unsigned)ray->line.place[0] >> 3,
                                                   (unsigned)ray->line.place[1] >> 3,
                                                   (unsigned)ray->line.place[2] >> 3);
            level = empty_level(region, block);
            if (level == 0 && region->form[block] != CM_BLOCK_EVEN)
            {
                if (march(ray, block))
                {
                    return look(ray, cube) == CM_OK;
                }
                if (!(ray->line.at < ray->line.end) || !is_inside(ray))
                {
                    return 0;
                }
                continue;
            }
            /* an even block of what is occupied may have misses waiting */
            cube->alpha =
                level == 0 ? cm_after_misses(&ray->octree->rule, region->value[block], ray->misses)
                           : CM_UNKNOWN;
            cube->color = 0;
            cube->level = level == 0 ? CM_BLOCK_LEVEL : level;
            for (int axis = 0; axis < 3; axis++)
            {
                cube->corner[axis] = (uint32_t)ray->line.place[axis] >> cube->level << cube->level;
            }
        }
        if (cube->alpha > CM_UNKNOWN)
        {
            return 1;
        }
        if (!leave(ray, cube))
        {
            return 0;
        }
    }
    return 0;
}

/* ---- with an index ---- */

/* The occupied voxel of a block that a ray is in. */
static int found(ray_state *ray, const cm_ray_index *index, const cm_ray_block *block,
                 ray_cube *cube)
{
    if (block->level == CM_RAY_BLOCK_EVEN)
    {
        return look(ray, cube) == CM_OK;
    }
    uint32_t place[3];
    for (int axis = 0; axis < 3; axis++)
    {
        place[axis] = (uint32_t)ray->line.place[axis];
        cube->corner[axis] = place[axis] >> block->level << block->level;
    }
    const unsigned cell = cm_interleave_3(place[0], place[1], place[2]), word = cell / 64;
    const size_t at = block->first + block->before[word] +
                      cm_bit_count(block->mask[word] & cm_bits_below(cell % 64));
    cube->level = block->level;
    cube->alpha = index->alpha[at];
    cube->color = index->color[at];
    return 1;
}

static int cast_any(ray_state *ray, const cm_octree *octree, const double origin[3],
                    const double direction[3], double far, ray_cube *cube)
{
    const cm_ray_index *index = cm_ray_index_of(octree);
    if (index == NULL)
    {
        return begin(ray, octree, octree->first, octree->beyond, origin, direction, far) &&
               cast(ray, cube);
    }
    uint32_t first[3], beyond[3];
    cm_ray_index_box(octree, index, first, beyond);
    if (!begin(ray, octree, first, beyond, origin, direction, far))
    {
        return 0;
    }
    const cm_ray_block *block = cm_ray_index_cast(index, &ray->line);
    return block != NULL && found(ray, index, block, cube);
}

int cm_octree_ray(const cm_octree *octree, const double origin[3], const double direction[3],
                  double far, cm_voxel *voxel)
{
    ray_state ray;
    ray_cube cube;
    if (octree == NULL || origin == NULL || direction == NULL ||
        !cast_any(&ray, octree, origin, direction, far, &cube))
    {
        return 0;
    }
    if (voxel != NULL)
    {
        *voxel = voxel_of(&ray, &cube);
    }
    return 1;
}

cm_status cm_octree_walk_ray(const cm_octree *octree, const double origin[3],
                             const double direction[3], double far, cm_voxel_job job, void *user)
{
    if (octree == NULL || origin == NULL || direction == NULL || job == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    ray_state ray;
    ray_cube cube;
    if (!begin(&ray, octree, octree->first, octree->beyond, origin, direction, far))
    {
        return CM_OK;
    }
    do
    {
        const cm_status status = look(&ray, &cube);
        if (status != CM_OK)
        {
            return status;
        }
        if (cube.alpha != CM_UNKNOWN)
        {
            const cm_voxel voxel = voxel_of(&ray, &cube);
            if (job(user, &voxel))
            {
                return CM_ERROR_STOPPED;
            }
            /* who was called may have asked the same map, which with pages puts regions away */
            ray.region = octree->options.pages == NULL ? ray.region : NULL;
        }
    } while (leave(&ray, &cube));
    return CM_OK;
}
