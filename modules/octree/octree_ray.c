/* SPDX-License-Identifier: MIT
 *
 * Rays through a map, from cube to cube. Steps are between whole places, so that none goes back and none stays: the next cube begins
 * at the border that the ray leaves this one by, and the other two places are cut to what this one has.
 */
#include <math.h>
#include <string.h>

#include "interleave.h"
#include "node_tree.h"
#include "paging.h"
#include "ray_index.h"
#include "walk.h"

/* A ray in voxels of the tree. */
typedef struct ray_state
{
    const cm_octree *octree;
    double origin[3];
    double step[3]; /* voxels for a unit of the world */
    double by[3];   /* 1 / step */
    double at;      /* where it is, in units of the world */
    double end;
    int32_t place[3]; /* the voxel that it is in */
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

/* A ray at where it enters the box [first, beyond) of voxels, or begins in it. 0: it does not. */
static int begin(ray_state *ray, const cm_octree *octree, const uint32_t first[3],
                 const uint32_t beyond[3], const double origin[3], const double direction[3],
                 double far)
{
    double square = 0.0;
    const double middle = (double)((uint64_t)1 << (octree->tree_level - 1));
    for (int axis = 0; axis < 3; axis++)
    {
        square += direction[axis] * direction[axis];
    }
    const double length = sqrt(square);
    ray->octree = octree;
    ray->region = NULL;
    ray->has_nodes = 0;
    ray->at = 0.0;
    ray->end = far > 0.0 ? far : INFINITY;
    int good = length > 0.0 && length < 1e100 && far >= 0.0;
    for (int axis = 0; axis < 3; axis++)
    {
        ray->origin[axis] =
            (origin[axis] - octree->options.centre[axis]) / octree->options.edge + middle;
        ray->step[axis] = direction[axis] / length / octree->options.edge;
        ray->by[axis] = 1.0 / ray->step[axis];
        good &= fabs(ray->origin[axis]) < 1e15;
        const double low = first[axis], high = beyond[axis];
        if (ray->step[axis] == 0.0)
        {
            good &= ray->origin[axis] >= low && ray->origin[axis] < high;
            continue;
        }
        const double a = (low - ray->origin[axis]) * ray->by[axis];
        const double b = (high - ray->origin[axis]) * ray->by[axis];
        ray->at = fmax(ray->at, fmin(a, b));
        ray->end = fmin(ray->end, fmax(a, b));
    }
    for (int axis = 0; good && axis < 3; axis++)
    {
        /* what is below 0 is below the box */
        const double place = ray->origin[axis] + ray->at * ray->step[axis];
        const double low = first[axis], high = beyond[axis] - 1.0;
        ray->place[axis] = (int32_t)(place < low ? low : place > high ? high : place);
    }
    return good && ray->at <= ray->end;
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
    const uint32_t place[3] = {(uint32_t)ray->place[0], (uint32_t)ray->place[1],
                               (uint32_t)ray->place[2]};
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
    const uint32_t place[3] = {(uint32_t)ray->place[0], (uint32_t)ray->place[1],
                               (uint32_t)ray->place[2]};
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
        const double border = cube->corner[axis] + (ray->step[axis] > 0.0 ? size : 0.0);
        out[axis] =
            ray->step[axis] == 0.0 ? INFINITY : (border - ray->origin[axis]) * ray->by[axis];
    }
    int axis = out[0] <= out[1] ? 0 : 1;
    axis = out[axis] <= out[2] ? axis : 2;
    ray->at = ray->at > out[axis] ? ray->at : out[axis];
    if (!(ray->at < ray->end))
    {
        return 0;
    }
    for (int i = 0; i < 3; i++)
    {
        const double low = cube->corner[i], high = cube->corner[i] + size - 1.0;
        const double place = ray->origin[i] + ray->at * ray->step[i];
        ray->place[i] = (int32_t)(place < low ? low : place > high ? high : place);
    }
    ray->place[axis] = (int32_t)cube->corner[axis] + (ray->step[axis] > 0.0 ? (int32_t)size : -1);
    return ray->place[axis] >= (int32_t)ray->octree->first[axis] &&
           ray->place[axis] < (int32_t)ray->octree->beyond[axis];
}

static cm_voxel voxel_of(const ray_state *ray, const ray_cube *cube)
{
    cm_voxel voxel = cm_voxel_at(ray->octree, cube->corner, cube->level, cube->alpha, cube->color);
    voxel.distance = ray->at;
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
        border[axis] = ray->place[axis] + (ray->step[axis] > 0.0 ? 1.0 : 0.0);
        next[axis] =
            ray->step[axis] == 0.0 ? INFINITY : (border[axis] - ray->origin[axis]) * ray->by[axis];
        in[axis] = ray->place[axis] & 7;
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
        ray->at = ray->at > next[axis] ? ray->at : next[axis];
        if (!(ray->at < ray->end))
        {
            return 0;
        }
        const int sign = ray->step[axis] > 0.0 ? 1 : -1;
        border[axis] += sign;
        next[axis] = (border[axis] - ray->origin[axis]) * ray->by[axis];
        in[axis] += sign;
        ray->place[axis] += sign;
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
        inside &= ray->place[axis] >= (int32_t)ray->octree->first[axis] &&
                  ray->place[axis] < (int32_t)ray->octree->beyond[axis];
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
            const unsigned block =
                cm_interleave_3((unsigned)ray->place[0] >> 3, (unsigned)ray->place[1] >> 3,
                                (unsigned)ray->place[2] >> 3);
            level = empty_level(region, block);
            if (level == 0 && region->form[block] != CM_BLOCK_EVEN)
            {
                if (march(ray, block))
                {
                    return look(ray, cube) == CM_OK;
                }
                if (!(ray->at < ray->end) || !is_inside(ray))
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
                cube->corner[axis] = (uint32_t)ray->place[axis] >> cube->level << cube->level;
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

/* A ray as its steps have it. An axis that it stands still on is never crossed: what begins at -1 and has no speed. */
typedef struct ray_path
{
    double origin[3];
    double step[3];
    double from[3];
    double by[3];
    double at;
    double end;
    int32_t place[3];
    int32_t sign[3];
    int32_t back[3]; /* 1 where it goes back */
} ray_path;

static ray_path path_of(const ray_state *ray)
{
    ray_path path = {.at = ray->at, .end = ray->end};
    for (int axis = 0; axis < 3; axis++)
    {
        const int stands = !(fabs(ray->by[axis]) < INFINITY);
        path.origin[axis] = ray->origin[axis];
        path.step[axis] = ray->step[axis];
        path.from[axis] = stands ? -1.0 : ray->origin[axis];
        path.by[axis] = stands ? INFINITY : ray->by[axis];
        path.place[axis] = ray->place[axis];
        path.back[axis] = !stands && ray->step[axis] < 0.0;
        path.sign[axis] = path.back[axis] ? -1 : 1;
    }
    return path;
}

/* Where a ray crosses a border of voxels. */
static inline double crossing(const ray_path *path, int axis, int32_t border)
{
    return (border - path->from[axis]) * path->by[axis];
}

/* Out of the blocks around its own that are empty: so many less one in each direction. 0 at the ray's end. */
static inline int leap(ray_path *path, int32_t away)
{
    int32_t border[3];
    double out[3];
    for (int axis = 0; axis < 3; axis++)
    {
        border[axis] =
            ((path->place[axis] >> CM_BLOCK_LEVEL) + path->sign[axis] * away + path->back[axis])
            << CM_BLOCK_LEVEL;
        out[axis] = crossing(path, axis, border[axis]);
    }
    const int is_x = (out[0] <= out[1]) & (out[0] <= out[2]);
    const int is_y = !(out[0] <= out[1]) & (out[1] <= out[2]);
    const int is_through[3] = {is_x, is_y, !is_x & !is_y};
    const double least = out[0] < out[1] ? out[0] : out[1];
    const double first = least < out[2] ? least : out[2];
    path->at = path->at > first ? path->at : first;
    if (!(path->at < path->end))
    {
        return 0;
    }
    for (int axis = 0; axis < 3; axis++)
    {
        /* onwards, and not out of the blocks but through that side, whatever is rounded */
        const int32_t place = (int32_t)(path->origin[axis] + path->at * path->step[axis]);
        const int32_t old = path->place[axis], back = path->back[axis];
        const int32_t low = back ? border[axis] : old;
        const int32_t high = back ? old : border[axis] - 1;
        const int32_t inside = place < low ? low : place > high ? high : place;
        path->place[axis] = is_through[axis] ? border[axis] - back : inside;
    }
    return 1;
}

/* One voxel on along an axis. 0: out of the block. */
static inline int step_along(ray_path *path, int axis, double out[3], int32_t in[3])
{
    path->at = path->at > out[axis] ? path->at : out[axis];
    in[axis] += path->sign[axis];
    path->place[axis] += path->sign[axis];
    out[axis] = crossing(path, axis, path->place[axis] + 1 - path->back[axis]);
    return (in[axis] & ~7) == 0;
}

/* From voxel to voxel in a block, up to the first that is occupied: 1. 0: it is in none, and the ray is where it leaves the block, or
 * at its end. */
static inline int march_bits(ray_path *path, const uint64_t mask[8])
{
    static const uint8_t spread[8] = {0, 1, 8, 9, 64, 65, 72, 73};
    double out[3];
    int32_t in[3];
    for (int axis = 0; axis < 3; axis++)
    {
        out[axis] = crossing(path, axis, path->place[axis] + 1 - path->back[axis]);
        in[axis] = path->place[axis] & 7;
    }
    for (int is_in = 1; is_in && path->at < path->end;)
    {
        const unsigned cell =
            (unsigned)spread[in[0]] | (unsigned)spread[in[1]] << 1 | (unsigned)spread[in[2]] << 2;
        if (mask[cell / 64] >> cell % 64 & 1u)
        {
            return 1;
        }
        if (out[0] <= out[1])
        {
            is_in = out[0] <= out[2] ? step_along(path, 0, out, in) : step_along(path, 2, out, in);
        }
        else
        {
            is_in = out[1] <= out[2] ? step_along(path, 1, out, in) : step_along(path, 2, out, in);
        }
    }
    return 0;
}

/* The occupied voxel of a block that a ray is in. */
static int found(ray_state *ray, const ray_path *path, const cm_ray_block *at, ray_cube *cube)
{
    const cm_octree *octree = ray->octree;
    memcpy(ray->place, path->place, sizeof ray->place);
    ray->at = path->at;
    if (at->alpha == NULL)
    {
        return look(ray, cube) == CM_OK;
    }
    const uint32_t *place = (const uint32_t *)path->place;
    const size_t cell = cm_interleave_3(place[0], place[1], place[2]) >> 3 * at->detail;
    cube->level = at->detail;
    for (int axis = 0; axis < 3; axis++)
    {
        cube->corner[axis] = place[axis] >> at->detail << at->detail;
    }
    cube->alpha = cm_after_misses(&octree->rule, at->alpha[cell], at->misses);
    cube->color = at->color == NULL ? 0 : at->color[cell];
    return 1;
}

/* As cast. */
static int cast_indexed(ray_state *ray, const cm_ray_index *index, ray_cube *cube)
{
    ray_path path = path_of(ray);
    for (;;)
    {
        size_t at = 0;
        for (int axis = 2; axis >= 0; axis--)
        {
            const uint32_t block =
                (uint32_t)((path.place[axis] >> CM_BLOCK_LEVEL) - index->first[axis]);
            if (block >= (uint32_t)index->count[axis])
            {
                return 0;
            }
            at = at * (uint32_t)index->count[axis] + block;
        }
        const int32_t away = index->away[at];
        if (away > 0)
        {
            if (!leap(&path, away))
            {
                return 0;
            }
            continue;
        }
        const size_t number = cm_ray_block_number(index, at);
        if (march_bits(&path, index->mask[number]))
        {
            return found(ray, &path, &index->block[number], cube);
        }
        if (!(path.at < path.end))
        {
            return 0;
        }
    }
}

/* The box of an index, as far as it is the map's. */
static void box_of(const cm_octree *octree, const cm_ray_index *index, uint32_t first[3],
                   uint32_t beyond[3])
{
    for (int axis = 0; axis < 3; axis++)
    {
        const uint32_t low = (uint32_t)index->first[axis] << CM_BLOCK_LEVEL;
        const uint32_t high = (uint32_t)(index->first[axis] + index->count[axis]) << CM_BLOCK_LEVEL;
        first[axis] = low > octree->first[axis] ? low : octree->first[axis];
        beyond[axis] = high < octree->beyond[axis] ? high : octree->beyond[axis];
    }
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
    box_of(octree, index, first, beyond);
    return begin(ray, octree, first, beyond, origin, direction, far) &&
           cast_indexed(ray, index, cube);
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
