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
    /* the block that was looked at last */
    const cm_region *region;
    unsigned misses;
} ray_state;

/* A cube of one alpha: an even one, or a voxel. */
typedef struct ray_cube
{
    uint32_t corner[3];
    int level;
    uint8_t alpha;
    uint32_t color;
} ray_cube;

static int begin(ray_state *ray, const cm_octree *octree, const double origin[3], const double direction[3],
                 double far)
{
    double square = 0.0;
    const double middle = ldexp(1.0, octree->tree_level - 1);
    for (int axis = 0; axis < 3; axis++)
    {
        square += direction[axis] * direction[axis];
    }
    const double length = sqrt(square);
    ray->octree = octree;
    ray->region = NULL;
    ray->at = 0.0;
    ray->end = far > 0.0 ? far : INFINITY;
    int good = length > 0.0 && length < 1e100 && far >= 0.0;
    for (int axis = 0; axis < 3; axis++)
    {
        ray->origin[axis] = (origin[axis] - octree->options.centre[axis]) / octree->options.edge + middle;
        ray->step[axis] = direction[axis] / length / octree->options.edge;
        ray->by[axis] = 1.0 / ray->step[axis];
        good &= fabs(ray->origin[axis]) < 1e15;
        const double low = octree->first[axis], high = octree->beyond[axis];
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
        const double place = floor(ray->origin[axis] + ray->at * ray->step[axis]);
        const double low = octree->first[axis], high = octree->beyond[axis] - 1.0;
        ray->place[axis] = (int32_t)(place < low ? low : place > high ? high : place);
    }
    return good && ray->at <= ray->end;
}

/* What is where the ray is. */
static cm_status look(ray_state *ray, ray_cube *cube)
{
    const cm_octree *octree = ray->octree;
    const uint32_t place[3] = {(uint32_t)ray->place[0], (uint32_t)ray->place[1], (uint32_t)ray->place[2]};
    const cm_region *region = ray->region;
    if (region == NULL || ((place[0] ^ region->place[0]) | (place[1] ^ region->place[1]) |
                           (place[2] ^ region->place[2])) >> CM_REGION_LEVEL != 0)
    {
        const cm_spot spot = cm_node_find(octree, place);
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
        const cm_status status = cm_node_look(octree, spot.node, place, &region);
        if (status != CM_OK)
        {
            return status;
        }
        ray->region = region;
        ray->misses = spot.misses;
    }
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
    const double size = ldexp(1.0, cube->level);
    double out[3];
    for (int axis = 0; axis < 3; axis++)
    {
        const double border = cube->corner[axis] + (ray->step[axis] > 0.0 ? size : 0.0);
        out[axis] = ray->step[axis] == 0.0 ? INFINITY : (border - ray->origin[axis]) * ray->by[axis];
    }
    int axis = out[0] <= out[1] ? 0 : 1;
    axis = out[axis] <= out[2] ? axis : 2;
    ray->at = fmax(ray->at, out[axis]);
    if (!(ray->at < ray->end))
    {
        return 0;
    }
    for (int i = 0; i < 3; i++)
    {
        const double low = cube->corner[i], high = cube->corner[i] + size - 1.0;
        const double place = floor(ray->origin[i] + ray->at * ray->step[i]);
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

int cm_octree_ray(const cm_octree *octree, const double origin[3], const double direction[3], double far,
                  cm_voxel *voxel)
{
    ray_state ray;
    ray_cube cube;
    if (octree == NULL || origin == NULL || direction == NULL || !begin(&ray, octree, origin, direction, far))
    {
        return 0;
    }
    do
    {
        if (look(&ray, &cube) != CM_OK)
        {
            return 0;
        }
        if (cube.alpha > CM_UNKNOWN)
        {
            if (voxel != NULL)
            {
                *voxel = voxel_of(&ray, &cube);
            }
            return 1;
        }
    } while (leave(&ray, &cube));
    return 0;
}

cm_status cm_octree_walk_ray(const cm_octree *octree, const double origin[3], const double direction[3],
                             double far, cm_voxel_job job, void *user)
{
    if (octree == NULL || origin == NULL || direction == NULL || job == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    ray_state ray;
    ray_cube cube;
    if (!begin(&ray, octree, origin, direction, far))
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
