/* SPDX-License-Identifier: MIT
 *
 * What is truly there: rays through the middles of pixels, and where what they meet is at other times.
 */
#include "tof_world.h"

#include <math.h>

/* Where bodies and the camera are at another time. */
typedef struct other_time
{
    tof_instant *instant;
    cm_pose camera;
} other_time;

typedef struct truth_work
{
    const tof_instant *instant;
    const cm_camera *camera;
    const cm_primitive *primitive;
    cm_pose pose;
    other_time other[2]; /* the next, the one before */
    const cm_tof_truth *truth;
    uint32_t width;
    double pixel_centre;
    int has_axis; /* a perspective camera */
} truth_work;

/* Rays of up to TOF_BLOCK pixels, and what they met. */
typedef struct truth_block
{
    size_t n;
    double column[TOF_BLOCK], row[TOF_BLOCK];
    double origin[3][TOF_BLOCK], direction[3][TOF_BLOCK];
    double along[TOF_BLOCK]; /* cosine from the optical axis; 1 where there is none */
    double range[TOF_BLOCK], normal[3][TOF_BLOCK];
    uint32_t id[TOF_BLOCK], triangle[TOF_BLOCK];
    double position[3][TOF_BLOCK]; /* NaN for nothing */
} truth_block;

static void make_rays(const truth_work *doing, size_t first, truth_block *at)
{
    double ray[3][TOF_BLOCK];
    for (size_t i = 0; i < at->n; i++)
    {
        at->column[i] = (double)((first + i) % doing->width) + doing->pixel_centre;
        at->row[i] = (double)((first + i) / doing->width) + doing->pixel_centre;
    }
    cm_camera_ray_array(doing->camera, at->n, at->column, at->row, ray[0], ray[1], ray[2]);
    for (size_t i = 0; i < at->n; i++)
    {
        double camera[3] = {ray[0][i], ray[1][i], ray[2][i]}, world[3];
        const double length =
            sqrt(camera[0] * camera[0] + camera[1] * camera[1] + camera[2] * camera[2]);
        for (int k = 0; k < 3; k++)
        {
            camera[k] = length > 0.0 ? camera[k] / length : (double)NAN;
        }
        cm_rotate_back(&doing->pose.rotation, camera, world);
        at->along[i] = doing->has_axis ? camera[2] : 1.0;
        for (int k = 0; k < 3; k++)
        {
            at->origin[k][i] = doing->pose.position[k];
            at->direction[k][i] = world[k];
        }
    }
}

/* Columns, rows and range of a block's places at another time, less those here; NaN where the camera does not see them. */
static void put_flow(const truth_work *doing, const other_time *then, const truth_block *at,
                     size_t first, float *const flow[3])
{
    double place[3][TOF_BLOCK], moved[3][TOF_BLOCK];
    for (size_t i = 0; i < at->n; i++)
    {
        double own[3], world[3], camera[3] = {NAN, NAN, NAN};
        if (at->id[i] != CM_SCENE_NOTHING)
        {
            const double here[3] = {at->position[0][i], at->position[1][i], at->position[2][i]};
            cm_pose_apply(&doing->instant->surface[at->id[i]].body, here, own);
            cm_pose_apply_back(&then->instant->surface[at->id[i]].body, own, world);
            cm_pose_apply(&then->camera, world, camera);
        }
        moved[2][i] = sqrt(camera[0] * camera[0] + camera[1] * camera[1] + camera[2] * camera[2]) -
                      at->range[i];
        for (int k = 0; k < 3; k++)
        {
            place[k][i] = camera[k];
        }
    }
    cm_camera_project_array(doing->camera, at->n, place[0], place[1], place[2], moved[0], moved[1]);
    for (size_t i = 0; i < at->n; i++)
    {
        moved[0][i] -= at->column[i];
        moved[1][i] -= at->row[i];
    }
    for (int k = 0; k < 3; k++)
    {
        for (size_t i = 0; flow[k] != NULL && i < at->n; i++)
        {
            flow[k][first + i] = (float)moved[k][i];
        }
    }
}

static void put_names(const truth_work *doing, const truth_block *at, size_t i, size_t pixel)
{
    const cm_tof_truth *truth = doing->truth;
    const int is_there = at->id[i] != CM_SCENE_NOTHING;
    if (truth->object != NULL)
    {
        truth->object[pixel] = at->id[i];
    }
    if (truth->shape != NULL)
    {
        truth->shape[pixel] =
            is_there ? (uint32_t)doing->primitive[at->id[i]].kind : CM_SCENE_NOTHING;
    }
    if (truth->triangle != NULL)
    {
        truth->triangle[pixel] = is_there ? at->triangle[i] : CM_SCENE_NOTHING;
    }
}

static void put_pixel(const truth_work *doing, truth_block *at, size_t i, size_t pixel)
{
    const cm_tof_truth *truth = doing->truth;
    const int is_there = at->id[i] != CM_SCENE_NOTHING;
    const double range = is_there ? at->range[i] : (double)NAN;
    for (int k = 0; k < 3; k++)
    {
        at->position[k][i] = at->origin[k][i] + range * at->direction[k][i];
        if (truth->position[k] != NULL)
        {
            truth->position[k][pixel] = at->position[k][i];
        }
        if (truth->normal[k] != NULL)
        {
            truth->normal[k][pixel] = is_there ? (float)at->normal[k][i] : NAN;
        }
    }
    if (truth->range != NULL)
    {
        truth->range[pixel] = (float)range;
    }
    if (truth->depth != NULL)
    {
        truth->depth[pixel] = (float)(range * at->along[i]);
    }
    put_names(doing, at, i, pixel);
}

static void put_blocks(size_t begin, size_t end, void *user)
{
    const truth_work *doing = user;
    _Alignas(64) truth_block at;
    for (size_t first = begin; first < end; first += at.n)
    {
        at.n = end - first < TOF_BLOCK ? end - first : TOF_BLOCK;
        make_rays(doing, first, &at);
        const double *const origin[3] = {at.origin[0], at.origin[1], at.origin[2]};
        const double *const direction[3] = {at.direction[0], at.direction[1], at.direction[2]};
        const tof_hits hits = {
            at.range, at.id, at.triangle, {at.normal[0], at.normal[1], at.normal[2]}};
        tof_cast(doing->instant, at.n, origin, direction, &hits);
        for (size_t i = 0; i < at.n; i++)
        {
            put_pixel(doing, &at, i, first + i);
        }
        for (int k = 0; k < 2; k++)
        {
            if (doing->other[k].instant != NULL)
            {
                put_flow(doing, &doing->other[k], &at, first,
                         k == 0 ? doing->truth->flow_next : doing->truth->flow_before);
            }
        }
    }
}

static int is_wanted(float *const flow[3])
{
    return flow[0] != NULL || flow[1] != NULL || flow[2] != NULL;
}

static cm_status make_other(const cm_tof_scene *scene, const cm_trajectory *trajectory, double time,
                            float *const flow[3], other_time *then)
{
    if (!is_wanted(flow))
    {
        return CM_OK;
    }
    tof_pose_at(trajectory, time, &then->camera);
    return tof_instant_create(scene, time, &then->instant);
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
    truth_work doing = {.camera = camera,
                        .primitive = scene->primitive,
                        .truth = truth,
                        .width = shape->width,
                        .pixel_centre = shape->pixel_centre,
                        .has_axis = shape->mapping == NULL};
    tof_pose_at(trajectory, time, &doing.pose);
    cm_status status = tof_instant_create(scene, time, &instant);
    if (status == CM_OK)
    {
        status = make_other(scene, trajectory, next, truth->flow_next, &doing.other[0]);
    }
    if (status == CM_OK)
    {
        status = make_other(scene, trajectory, before, truth->flow_before, &doing.other[1]);
    }
    if (status == CM_OK)
    {
        doing.instant = instant;
        cm_pool_run(pool, (size_t)shape->width * shape->height, 4 * TOF_BLOCK, put_blocks, &doing);
    }
    tof_instant_destroy(doing.other[1].instant);
    tof_instant_destroy(doing.other[0].instant);
    tof_instant_destroy(instant);
    return status;
}
