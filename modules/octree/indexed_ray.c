/* SPDX-License-Identifier: MIT */
#include "indexed_ray.h"

#include <math.h>
#include <string.h>

#include "block_access.h"

/* A ray as its steps have it. */
typedef struct ray_path
{
    double origin[3];
    double step[3];
    double by[3];
    double at;
    double end;
    int32_t place[3];
    int32_t sign[3];
    int32_t back[3]; /* 1 where it goes back */
} ray_path;

static inline ray_path path_of(const cm_ray_line *line)
{
    ray_path path = {.at = line->at, .end = line->end};
    for (int axis = 0; axis < 3; axis++)
    {
        const int stands = line->step[axis] == 0.0;
        path.origin[axis] = line->origin[axis];
        path.step[axis] = line->step[axis];
        path.by[axis] = stands ? CM_RAY_STANDS : line->by[axis];
        path.place[axis] = line->place[axis];
        path.back[axis] = !stands && line->step[axis] < 0.0;
        path.sign[axis] = path.back[axis] ? -1 : 1;
    }
    return path;
}

/* Where a ray crosses a border of voxels. */
static inline double crossing(const ray_path *path, int axis, double border)
{
    return (border - path->origin[axis]) * path->by[axis];
}

/* Where a ray is along an axis that it does not leave the blocks by: onwards, and in them, whatever is rounded. */
static inline void stay_along(ray_path *path, int axis, int32_t border)
{
    const int32_t place = (int32_t)(path->origin[axis] + path->at * path->step[axis]);
    const int32_t old = path->place[axis], last = border - 1 + path->back[axis];
    const int32_t low = old < last ? old : last, high = old < last ? last : old;
    path->place[axis] = place < low ? low : place > high ? high : place;
}

/* Out of them through a side across an axis; a and b are the others. 0 at the ray's end. */
static inline int leave_through(ray_path *path, const int32_t border[3], double out, int axis,
                                int a, int b)
{
    path->at = path->at > out ? path->at : out;
    if (!(path->at < path->end))
    {
        return 0;
    }
    path->place[axis] = border[axis] - path->back[axis];
    stay_along(path, a, border[a]);
    stay_along(path, b, border[b]);
    return 1;
}

/* Out of the blocks around its own that are empty: so many less one in each direction. 0 at the ray's end. */
static inline int leap(ray_path *path, int32_t away)
{
    int32_t border[3];
    double out[3];
    for (int axis = 0; axis < 3; axis++)
    {
        border[axis] = CM_BLOCK_EDGE * ((path->place[axis] >> CM_BLOCK_LEVEL) +
                                        path->sign[axis] * away + path->back[axis]);
        out[axis] = crossing(path, axis, border[axis]);
    }
    if (out[0] <= out[1] && out[0] <= out[2])
    {
        return leave_through(path, border, out[0], 0, 1, 2);
    }
    if (out[1] < out[0] && out[1] <= out[2])
    {
        return leave_through(path, border, out[1], 1, 0, 2);
    }
    return leave_through(path, border, out[2], 2, 0, 1);
}

/* A ray in a block. */
typedef struct ray_march
{
    int32_t in[3];
    double border[3]; /* ahead */
    double out[3];    /* where that is crossed */
} ray_march;

/* One voxel on along an axis. 0: out of the block, or at the ray's end. */
static inline int step_along(ray_path *path, ray_march *march, int axis)
{
    path->at = path->at > march->out[axis] ? path->at : march->out[axis];
    march->in[axis] += path->sign[axis];
    march->border[axis] += path->sign[axis];
    march->out[axis] = crossing(path, axis, march->border[axis]);
    return (march->in[axis] & ~7) == 0 && path->at < path->end;
}

/* From voxel to voxel in a block, up to the first that is occupied: 1. 0: it is in none, and the ray is where it leaves the block, or
 * at its end. */
static inline int march_bits(ray_path *path, const uint64_t mask[8])
{
    static const uint8_t spread[8] = {0, 1, 8, 9, 64, 65, 72, 73};
    ray_march march;
    int is_met = 0;
    for (int axis = 0; axis < 3; axis++)
    {
        march.border[axis] = path->place[axis] + 1 - path->back[axis];
        march.out[axis] = crossing(path, axis, march.border[axis]);
        march.in[axis] = path->place[axis] & 7;
        path->place[axis] &= ~7;
    }
    for (int is_in = 1; is_in;)
    {
        const double *out = march.out;
        const unsigned cell = (unsigned)spread[march.in[0]] | (unsigned)spread[march.in[1]] << 1 |
                              (unsigned)spread[march.in[2]] << 2;
        is_met = (int)(mask[cell / 64] >> cell % 64 & 1u);
        if (is_met)
        {
            break;
        }
        if (out[0] <= out[1] && out[0] <= out[2])
        {
            is_in = step_along(path, &march, 0);
        }
        else if (out[1] < out[0] && out[1] <= out[2])
        {
            is_in = step_along(path, &march, 1);
        }
        else
        {
            is_in = step_along(path, &march, 2);
        }
    }
    for (int axis = 0; axis < 3; axis++)
    {
        path->place[axis] += march.in[axis];
    }
    return is_met;
}

const cm_ray_block *cm_ray_index_cast(const cm_ray_index *index, cm_ray_line *line)
{
    ray_path path = path_of(line);
    for (;;)
    {
        size_t at = 0;
        for (int axis = 2; axis >= 0; axis--)
        {
            const uint32_t block =
                (uint32_t)((path.place[axis] >> CM_BLOCK_LEVEL) - index->first[axis]);
            if (block >= (uint32_t)index->count[axis])
            {
                return NULL;
            }
            at = at * (uint32_t)index->count[axis] + block;
        }
        const int32_t away = index->away[at];
        if (away > 0)
        {
            if (!leap(&path, away))
            {
                return NULL;
            }
            continue;
        }
        const cm_ray_block *block = &index->block[cm_ray_block_number(index, at)];
        if (march_bits(&path, block->mask))
        {
            memcpy(line->place, path.place, sizeof line->place);
            line->at = path.at;
            return block;
        }
        if (!(path.at < path.end))
        {
            return NULL;
        }
    }
}

void cm_ray_index_box(const cm_octree *octree, const cm_ray_index *index, uint32_t first[3],
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
