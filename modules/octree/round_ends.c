/* SPDX-License-Identifier: MIT */
#include "modules/memory/checked_size.h"
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
    cm_round_rays rays;
} end_work;

/* Pixels whose voxels' centres are projected together. */
#define ENDS_TOGETHER 64

typedef struct end_group
{
    size_t count;
    uint32_t place[ENDS_TOGETHER][3];
    uint64_t pixel[ENDS_TOGETHER];
    double at[3][ENDS_TOGETHER]; /* centres of the voxels, in the camera's axes */
    float value[ENDS_TOGETHER];
} end_group;

/* What of a group is not hit by the pixel that its centre falls on. */
static void take_group(end_work *work, end_group *group)
{
    double column[ENDS_TOGETHER] = {0}, row[ENDS_TOGETHER] = {0};
    int32_t own[ENDS_TOGETHER];
    uint64_t hits[8], misses[8];
    cm_ray_end found[ENDS_TOGETHER];
    const cm_round_picture picture = cm_round_picture_of(work->update, work->round);
    size_t count = 0;
    cm_camera_project_array(work->update->view->camera, group->count, group->at[0], group->at[1],
                            group->at[2], column, row);
    for (size_t i = group->count; i < ENDS_TOGETHER; i++)
    {
        group->value[i] = NAN;
    }
    work->update->set->round_ask(&picture, ENDS_TOGETHER, column, row, 1.0f, group->value, own,
                                 hits, misses);
    for (size_t i = 0; i < group->count; i++)
    {
        if ((hits[0] >> i & 1u) == 0)
        {
            found[count++] = (cm_ray_end){cm_interleave(group->place[i]), group->pixel[i]};
        }
    }
    if (count > 0)
    {
        memcpy(work->list + atomic_fetch_add(&work->count, count), found, count * sizeof *found);
    }
    group->count = 0;
}

/* A voxel comes to the group if it is seen. */
static void add_voxel(end_work *work, const uint32_t place[3], uint64_t pixel, end_group *group)
{
    double at[3];
    const double in_tree[3] = {place[0], place[1], place[2]};
    cm_update_place(work->update, in_tree, at);
    const double value = cm_round_value(work->round, at);
    if (!(value > work->update->octree->options.near))
    {
        return;
    }
    for (int axis = 0; axis < 3; axis++)
    {
        group->at[axis][group->count] = at[axis];
        group->place[group->count][axis] = place[axis];
    }
    group->value[group->count] = (float)value;
    group->pixel[group->count++] = pixel;
    if (group->count == ENDS_TOGETHER)
    {
        take_group(work, group);
    }
}

/* Pixels of a row whose rays' ends are found together. */
#define PIXELS_TOGETHER 256

static void find_in_rows(size_t first_row, size_t end_row, void *user)
{
    end_work *work = user;
    const size_t width = work->round->tree.width, stride = work->update->desk->view.stride;
    int32_t last[3] = {-1, -1, -1}, x[PIXELS_TOGETHER], y[PIXELS_TOGETHER], z[PIXELS_TOGETHER];
    size_t count;
    end_group group;
    group.count = 0;
    for (size_t begin = first_row * width; begin < end_row * width; begin += count)
    {
        const size_t row = begin / width, column = begin - row * width, rest = width - column;
        count = rest < PIXELS_TOGETHER ? rest : PIXELS_TOGETHER;
        work->update->set->round_ends(count, &work->rays, begin, x, y, z);
        for (size_t i = 0; i < count; i++)
        {
            const int is_last = (x[i] == last[0]) & (y[i] == last[1]) & (z[i] == last[2]);
            if (is_last | (x[i] < 0) || !(cm_round_reach(&work->round->rule[begin + i]) >= 0.0f))
            {
                continue; /* the first pixel of those that end in a voxel speaks for it */
            }
            last[0] = x[i];
            last[1] = y[i];
            last[2] = z[i];
            add_voxel(work, (const uint32_t[3]){(uint32_t)x[i], (uint32_t)y[i], (uint32_t)z[i]},
                      row * stride + column + i, &group);
        }
    }
    take_group(work, &group);
}

static void describe_rays(end_work *work)
{
    const cm_octree *octree = work->update->octree;
    const cm_pose *pose = &work->update->view->pose;
    cm_round_rays *rays = &work->rays;
    *rays = (cm_round_rays){.rule = work->round->rule,
                            .is_range = work->round->is_range,
                            .edge = octree->options.edge,
                            .middle = ldexp(1.0, octree->tree_level - 1)};
    for (int axis = 0; axis < 3; axis++)
    {
        rays->ray[axis] = work->round->tree.ray[axis];
        memcpy(rays->back[axis], pose->rotation.row[axis], sizeof rays->back[axis]);
        rays->position[axis] = pose->position[axis];
        rays->centre[axis] = octree->options.centre[axis];
        rays->first[axis] = octree->first[axis];
        rays->beyond[axis] = octree->beyond[axis];
    }
}

cm_status cm_round_ends_find(const cm_update *update, const cm_round_desk *round, cm_pool *pool,
                             cm_ray_ends *ends)
{
    cm_view_desk *desk = &update->desk->view;
    const size_t pixels = (size_t)round->tree.width * round->tree.height;
    if (pixels > desk->end_room)
    {
        free(desk->end);
        desk->end = cm_array_of(pixels, sizeof *desk->end);
        desk->end_room = desk->end == NULL ? 0 : pixels;
    }
    if (desk->end == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    end_work work = {.update = update, .round = round, .list = desk->end};
    describe_rays(&work);
    cm_pool_run(pool, round->tree.height, 16, find_in_rows, &work);
    *ends = cm_ray_ends_sort(work.list, atomic_load(&work.count), desk->end_room);
    return CM_OK;
}
