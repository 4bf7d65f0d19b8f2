/* SPDX-License-Identifier: MIT */
#include "update_round.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "interleave.h"

typedef struct end_work
{
    const cm_update *update;
    const cm_round_desk *round;
    cm_ray_end *list;
    atomic_size_t count;
    double middle; /* of the tree, in finest edges */
} end_work;

/* Pixels whose voxels' centres are projected together. */
#define ENDS_TOGETHER 64

typedef struct end_group
{
    size_t count;
    uint64_t key[ENDS_TOGETHER];
    uint64_t pixel[ENDS_TOGETHER];
    double at[3][ENDS_TOGETHER]; /* centres of the voxels, in the camera's axes */
} end_group;

/* The voxel that a pixel's ray ends in, from the tree's lower corner. 0: none of the map. */
static int voxel_of(const end_work *work, size_t pixel, uint32_t place[3])
{
    const cm_octree *octree = work->update->octree;
    const cm_octree_options *options = &octree->options;
    const float *const *ray = (const float *const *)work->round->tree.ray;
    const double depth = (double)work->round->rule[pixel].depth;
    const double along = work->round->is_range ? 1.0 : (double)ray[2][pixel];
    double in_camera[3], point[3];
    for (int axis = 0; axis < 3; axis++)
    {
        in_camera[axis] = (double)ray[axis][pixel] * (depth / along);
    }
    cm_pose_apply_back(&work->update->view->pose, in_camera, point);
    for (int axis = 0; axis < 3; axis++)
    {
        const double at =
            floor(CM_PLACE_OF(point[axis], options->centre[axis], options->edge, work->middle));
        if (!(at >= octree->first[axis] && at < octree->beyond[axis]))
        {
            return 0; /* a ray that is not there ends nowhere: its coordinates are no numbers */
        }
        place[axis] = (uint32_t)at;
    }
    return 1;
}

/* Is the voxel at a place of a group not hit by the pixel that its centre falls on? */
static int is_lost(const end_work *work, const end_group *group, size_t i, double column,
                   double row)
{
    const double point[3] = {group->at[0][i], group->at[1][i], group->at[2][i]};
    const double value = cm_round_value(work->round, point);
    if (!(value > work->update->octree->options.near))
    {
        return 0;
    }
    const size_t pixel = cm_round_pixel(work->round, column, row);
    return pixel == SIZE_MAX || cm_round_word(&work->round->rule[pixel], (float)value, 1.0f) <= 0;
}

static void take_group(end_work *work, end_group *group)
{
    double column[ENDS_TOGETHER], row[ENDS_TOGETHER];
    cm_ray_end found[ENDS_TOGETHER];
    size_t count = 0;
    cm_camera_project_array(work->update->view->camera, group->count, group->at[0], group->at[1],
                            group->at[2], column, row);
    for (size_t i = 0; i < group->count; i++)
    {
        if (is_lost(work, group, i, column[i], row[i]))
        {
            found[count++] = (cm_ray_end){group->key[i], group->pixel[i]};
        }
    }
    if (count > 0)
    {
        memcpy(work->list + atomic_fetch_add(&work->count, count), found, count * sizeof *found);
    }
    group->count = 0;
}

static void find_in_rows(size_t first_row, size_t end_row, void *user)
{
    end_work *work = user;
    const size_t width = work->round->tree.width, stride = work->update->desk->view.stride;
    uint32_t last[3] = {UINT32_MAX, UINT32_MAX, UINT32_MAX};
    end_group group;
    group.count = 0;
    for (size_t pixel = first_row * width; pixel < end_row * width; pixel++)
    {
        uint32_t place[3];
        if (!(cm_round_reach(&work->round->rule[pixel]) >= 0.0f) || !voxel_of(work, pixel, place) ||
            memcmp(place, last, sizeof last) == 0)
        {
            continue; /* the first pixel of those that end in a voxel speaks for it */
        }
        memcpy(last, place, sizeof last);
        double at[3];
        const double in_tree[3] = {place[0], place[1], place[2]};
        cm_update_place(work->update, in_tree, at);
        for (int axis = 0; axis < 3; axis++)
        {
            group.at[axis][group.count] = at[axis];
        }
        group.key[group.count] = cm_interleave(place);
        group.pixel[group.count++] = pixel / width * stride + pixel % width;
        if (group.count == ENDS_TOGETHER)
        {
            take_group(work, &group);
        }
    }
    take_group(work, &group);
}

cm_status cm_round_ends_find(const cm_update *update, const cm_round_desk *round, cm_pool *pool,
                             cm_ray_ends *ends)
{
    cm_view_desk *desk = &update->desk->view;
    const size_t pixels = (size_t)round->tree.width * round->tree.height;
    if (pixels > desk->end_room)
    {
        free(desk->end);
        desk->end = malloc(pixels * sizeof *desk->end);
        desk->end_room = desk->end == NULL ? 0 : pixels;
    }
    if (desk->end == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    end_work work = {.update = update,
                     .round = round,
                     .list = desk->end,
                     .middle = ldexp(1.0, update->octree->tree_level - 1)};
    cm_pool_run(pool, round->tree.height, 16, find_in_rows, &work);
    *ends = cm_ray_ends_sort(work.list, atomic_load(&work.count));
    return CM_OK;
}
