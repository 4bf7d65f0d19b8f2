/* SPDX-License-Identifier: MIT
 *
 * What a camera truly sees. Flows are those of the body that is seen: its point at the time is taken to its place at the other
 * time by the body's pose, and there to the picture by the camera's.
 */
#include "tof_world.h"

#include <math.h>

/* A time to which there is flow. */
typedef struct other_time
{
    tof_instant *instant;
    cm_pose camera;
    float *const *flow; /* pixels, pixels, metres */
} other_time;

typedef struct truth_work
{
    const cm_tof_scene *scene;
    const tof_instant *instant;
    const cm_camera *camera;
    const cm_tof_truth *truth;
    cm_pose pose;
    size_t width;
    size_t pixels;
    other_time other[2];
} truth_work;

/* Pixels in a row, TOF_BLOCK at the most, and what their rays met. */
typedef struct truth_block
{
    size_t first; /* of the picture */
    size_t n;
    double column[TOF_BLOCK], row[TOF_BLOCK];
    double origin[3][TOF_BLOCK];
    double direction[3][TOF_BLOCK];
    double cosine[TOF_BLOCK]; /* depth by range; NaN: no ray */
    double range[TOF_BLOCK];  /* infinite for nothing */
    double normal[3][TOF_BLOCK];
    double position[3][TOF_BLOCK];
    uint32_t id[TOF_BLOCK];
    uint32_t triangle[TOF_BLOCK];
} truth_block;

static void aim(const truth_work *doing, truth_block *block)
{
    double ray[3][TOF_BLOCK];
    for (size_t i = 0; i < block->n; i++)
    {
        block->column[i] = (double)((block->first + i) % doing->width);
        block->row[i] = (double)((block->first + i) / doing->width);
    }
    cm_camera_ray_array(doing->camera, block->n, block->column, block->row, ray[0], ray[1], ray[2]);
    for (size_t i = 0; i < block->n; i++)
    {
        const double length =
            sqrt(ray[0][i] * ray[0][i] + ray[1][i] * ray[1][i] + ray[2][i] * ray[2][i]);
        const int is_ray = length > 0.0;
        const double along[3] = {is_ray ? ray[0][i] / length : 0.0,
                                 is_ray ? ray[1][i] / length : 0.0,
                                 is_ray ? ray[2][i] / length : 1.0};
        double turned[3];
        cm_rotate_back(&doing->pose.rotation, along, turned);
        block->cosine[i] = is_ray ? along[2] : (double)NAN;
        for (int k = 0; k < 3; k++)
        {
            block->direction[k][i] = turned[k];
            block->origin[k][i] = doing->pose.position[k];
        }
    }
}

static int is_met(const truth_block *block, size_t i)
{
    return block->cosine[i] == block->cosine[i] && block->range[i] < INFINITY;
}

static void meet(const truth_work *doing, truth_block *block)
{
    const double *const origin[3] = {block->origin[0], block->origin[1], block->origin[2]};
    const double *const direction[3] = {block->direction[0], block->direction[1],
                                        block->direction[2]};
    const tof_hits hits = {.distance = block->range,
                           .id = block->id,
                           .triangle = block->triangle,
                           .normal = {block->normal[0], block->normal[1], block->normal[2]}};
    tof_cast(doing->instant, block->n, origin, direction, &hits);
    for (size_t i = 0; i < block->n; i++)
    {
        for (int k = 0; k < 3; k++)
        {
            block->position[k][i] =
                is_met(block, i) ? origin[k][i] + block->range[i] * direction[k][i] : (double)NAN;
        }
    }
}

static void put_ids(const truth_work *doing, const truth_block *block)
{
    const cm_tof_truth *truth = doing->truth;
    for (size_t i = 0; i < block->n; i++)
    {
        const size_t at = block->first + i;
        const uint32_t id = is_met(block, i) ? block->id[i] : CM_SCENE_NOTHING;
        const int is_there = id != CM_SCENE_NOTHING;
        if (truth->object != NULL)
        {
            truth->object[at] = id;
        }
        if (truth->shape != NULL)
        {
            truth->shape[at] =
                is_there ? (uint32_t)doing->scene->primitive[id].kind : CM_SCENE_NOTHING;
        }
        if (truth->triangle != NULL)
        {
            truth->triangle[at] = is_there ? block->triangle[i] : CM_SCENE_NOTHING;
        }
    }
}

static void put_places(const truth_work *doing, const truth_block *block)
{
    const cm_tof_truth *truth = doing->truth;
    for (size_t i = 0; i < block->n; i++)
    {
        const size_t at = block->first + i;
        const int is_there = is_met(block, i);
        for (int k = 0; k < 3; k++)
        {
            if (truth->position[k] != NULL)
            {
                truth->position[k][at] = block->position[k][i];
            }
            if (truth->normal[k] != NULL)
            {
                truth->normal[k][at] = is_there ? (float)block->normal[k][i] : NAN;
            }
        }
        if (truth->range != NULL)
        {
            truth->range[at] = is_there ? (float)block->range[i] : NAN;
        }
        if (truth->depth != NULL)
        {
            truth->depth[at] = is_there ? (float)(block->range[i] * block->cosine[i]) : NAN;
        }
    }
}

/* Where the places are at the other time, in the camera's axes of that time; and how far from it. */
static void carry(const truth_work *doing, const other_time *other, const truth_block *block,
                  double point[3][TOF_BLOCK], double *range)
{
    const tof_surface *now = tof_instant_surfaces(doing->instant);
    const tof_surface *then = tof_instant_surfaces(other->instant);
    for (size_t i = 0; i < block->n; i++)
    {
        double at[3] = {block->position[0][i], block->position[1][i], block->position[2][i]};
        if (is_met(block, i))
        {
            cm_pose_apply(&now[block->id[i]].body, at, at);
            cm_pose_apply_back(&then[block->id[i]].body, at, at);
            cm_pose_apply(&other->camera, at, at);
        }
        range[i] = sqrt(at[0] * at[0] + at[1] * at[1] + at[2] * at[2]);
        for (int k = 0; k < 3; k++)
        {
            point[k][i] = at[k];
        }
    }
}

static void put_flow(const truth_work *doing, const other_time *other, const truth_block *block)
{
    double point[3][TOF_BLOCK], range[TOF_BLOCK], column[TOF_BLOCK], row[TOF_BLOCK];
    if (other->instant == NULL)
    {
        return;
    }
    carry(doing, other, block, point, range);
    cm_camera_project_array(doing->camera, block->n, point[0], point[1], point[2], column, row);
    for (size_t i = 0; i < block->n; i++)
    {
        const double flow[3] = {column[i] - block->column[i], row[i] - block->row[i],
                                is_met(block, i) ? range[i] - block->range[i] : (double)NAN};
        for (int k = 0; k < 3; k++)
        {
            if (other->flow[k] != NULL)
            {
                other->flow[k][block->first + i] = (float)flow[k];
            }
        }
    }
}

static void find(size_t begin, size_t end, void *user)
{
    const truth_work *doing = user;
    truth_block block;
    for (size_t first = begin * TOF_BLOCK; first < end * TOF_BLOCK && first < doing->pixels;
         first += TOF_BLOCK)
    {
        block.first = first;
        block.n = doing->pixels - first < TOF_BLOCK ? doing->pixels - first : TOF_BLOCK;
        aim(doing, &block);
        meet(doing, &block);
        put_ids(doing, &block);
        put_places(doing, &block);
        put_flow(doing, &doing->other[0], &block);
        put_flow(doing, &doing->other[1], &block);
    }
}

static cm_status prepare_other(const truth_work *doing, const cm_trajectory *trajectory,
                               double time, float *const *flow, other_time *other)
{
    other->flow = flow;
    if (flow[0] == NULL && flow[1] == NULL && flow[2] == NULL)
    {
        return CM_OK;
    }
    tof_pose_at(trajectory, time, &other->camera);
    return tof_instant_create(doing->scene, time, &other->instant);
}

cm_status cm_tof_find_truth(const cm_tof_scene *scene, const cm_camera *camera,
                            const cm_trajectory *trajectory, double time, double next,
                            double before, cm_pool *pool, cm_tof_truth *truth)
{
    if (scene == NULL || camera == NULL || truth == NULL || truth->size != sizeof *truth)
    {
        return CM_ERROR_ARGUMENT;
    }
    if (!isfinite(time) || !isfinite(next) || !isfinite(before))
    {
        return CM_ERROR_RANGE;
    }
    const cm_camera_options *shape = cm_camera_describe(camera);
    tof_instant *instant = NULL;
    truth_work doing = {.scene = scene,
                        .camera = camera,
                        .truth = truth,
                        .width = shape->width,
                        .pixels = (size_t)shape->width * shape->height};
    tof_pose_at(trajectory, time, &doing.pose);
    cm_status status = tof_instant_create(scene, time, &instant);
    doing.instant = instant;
    if (status == CM_OK)
    {
        status = prepare_other(&doing, trajectory, next, truth->flow_next, &doing.other[0]);
    }
    if (status == CM_OK)
    {
        status = prepare_other(&doing, trajectory, before, truth->flow_before, &doing.other[1]);
    }
    if (status == CM_OK)
    {
        cm_pool_run(pool, (doing.pixels + TOF_BLOCK - 1) / TOF_BLOCK, 4, find, &doing);
    }
    tof_instant_destroy(doing.other[0].instant);
    tof_instant_destroy(doing.other[1].instant);
    tof_instant_destroy(instant);
    return status;
}
