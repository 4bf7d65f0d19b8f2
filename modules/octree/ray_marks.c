/* SPDX-License-Identifier: MIT
 *
 * Voxels along a ray, one by one (Amanatides and Woo, A Fast Voxel Traversal Algorithm for Ray Tracing, 1987): the part of the ray
 * at which the next voxel begins is kept for each axis, as a whole number, and the least says where it goes. How many voxels it
 * goes along an axis is counted before, so that rounding never leads it past its end.
 */
#include "point_marks.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "interleave.h"

/* The whole ray. Twice as much is still a number. */
#define WHOLE ((int64_t)1 << 60)

/* Bits of a voxel's number within its region that are of x; those of y and z are to the left of them. */
#define OF_X 0x9249u

typedef struct ray_walk
{
    int64_t next[3]; /* the part of the ray at which the next voxel along an axis begins */
    int64_t part[3]; /* of one voxel */
    uint32_t in[3];  /* bits of the number within the region */
    uint32_t add[3]; /* what leads to the next */
    uint32_t region[3];
    int32_t sign[3];
    uint64_t left; /* voxels to come */
} ray_walk;

/* Bits of a coordinate within a region in every third place. */
static uint32_t spread(uint32_t place)
{
    return cm_interleave_3(place >> CM_BLOCK_LEVEL & 7u, 0, 0) << 9 |
           cm_interleave_3(place & 7u, 0, 0);
}

/* Rounded so that as many voxels begin within the ray as it goes through, and the next beyond it. */
static int64_t part_for(int64_t first, int64_t part, int64_t voxels)
{
    if (voxels > 1 && first + (voxels - 1) * part > WHOLE)
    {
        return (WHOLE - first) / (voxels - 1);
    }
    const int64_t beyond = WHOLE - first - voxels * part;
    return beyond < 0 ? part : part + beyond / voxels + 1;
}

static void begin_axis(ray_walk *ray, int axis, double from, double to)
{
    const int64_t place = (int64_t)floor(from), last = (int64_t)floor(to);
    const double length = fabs(to - from);
    const uint32_t mask = OF_X << axis;
    ray->sign[axis] = to > from ? 1 : -1;
    ray->add[axis] = to > from ? 0u - mask : ~(uint32_t)0;
    ray->in[axis] = spread((uint32_t)place) << axis;
    ray->region[axis] = (uint32_t)place >> CM_REGION_LEVEL << CM_REGION_LEVEL;
    ray->left += (uint64_t)llabs(last - place);
    ray->next[axis] = 2 * WHOLE;
    ray->part[axis] = 0;
    if (last != place)
    {
        const double border = (double)place + (ray->sign[axis] > 0 ? 1.0 : 0.0);
        const double first = fabs(border - from) / length, part = 1.0 / length;
        ray->next[axis] = (int64_t)(fmin(first, 1.0) * (double)WHOLE);
        ray->part[axis] = part_for(ray->next[axis], (int64_t)(fmin(part, 2.0) * (double)WHOLE),
                                   llabs(last - place));
    }
}

/* Voxels of one block, from one on, and the first behind it, which may be of the next region; 0 if the ray ends before. */
static int mark_block(ray_walk *ray, uint64_t misses[8])
{
    int64_t x = ray->next[0], y = ray->next[1], z = ray->next[2];
    uint32_t i = ray->in[0], j = ray->in[1], k = ray->in[2], voxel = i | j | k;
    const uint32_t block = voxel >> 9;
    uint64_t left = ray->left, is_x = 0, is_y = 0, is_z = 0;
    while (left > 0 && voxel >> 9 == block)
    {
        misses[voxel >> 6 & 7u] |= (uint64_t)1 << (voxel & 63u);
        /* all bits or none, since processors cannot guess which axis is next */
        const int64_t nearer = x <= y ? x : y;
        is_z = 0 - (uint64_t)(z < nearer);
        is_x = (0 - (uint64_t)(x <= y)) & ~is_z;
        is_y = ~(is_x | is_z);
        x += ray->part[0] & (int64_t)is_x;
        y += ray->part[1] & (int64_t)is_y;
        z += ray->part[2] & (int64_t)is_z;
        i = (i + (ray->add[0] & (uint32_t)is_x)) & OF_X;
        j = (j + (ray->add[1] & (uint32_t)is_y)) & OF_X << 1;
        k = (k + (ray->add[2] & (uint32_t)is_z)) & OF_X << 2;
        voxel = i | j | k;
        left--;
    }
    ray->next[0] = x;
    ray->next[1] = y;
    ray->next[2] = z;
    ray->in[0] = i;
    ray->in[1] = j;
    ray->in[2] = k;
    ray->left = left;
    const int axis = is_x ? 0 : is_y ? 1 : 2;
    if (ray->in[axis] == (ray->sign[axis] > 0 ? 0 : OF_X << axis))
    {
        ray->region[axis] += (uint32_t)(ray->sign[axis] * (1 << CM_REGION_LEVEL));
    }
    return left > 0;
}

/* Is a region, or what is within a small map of its only one, of the map? */
static int is_of_map(const cm_octree *octree, const uint32_t region[3])
{
    int is = 1;
    for (int axis = 0; axis < 3; axis++)
    {
        is &= (uint64_t)region[axis] + (1u << CM_REGION_LEVEL) > octree->first[axis] &&
              region[axis] < octree->beyond[axis];
    }
    return is;
}

int cm_marks_ray(cm_point_marks *marks, const cm_octree *octree, const double from[3],
                 const double to[3], int is_before)
{
    ray_walk ray;
    ray.left = is_before ? 0 : 1;
    for (int axis = 0; axis < 3; axis++)
    {
        begin_axis(&ray, axis, from[axis], to[axis]);
    }
    int goes_on = ray.left > 0;
    while (goes_on && is_of_map(octree, ray.region))
    {
        cm_block_marks *block =
            cm_marks_of(marks, ray.region, (ray.in[0] | ray.in[1] | ray.in[2]) >> 9);
        if (block == NULL)
        {
            return 0;
        }
        goes_on = mark_block(&ray, block->misses);
    }
    return 1;
}
