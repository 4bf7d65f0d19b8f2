/* SPDX-License-Identifier: MIT
 *
 * Rays in blocks: what is bounded and outside of a block's cone, and planes behind all of it, are left out, if its rays have one
 * origin.
 */
#include "tof_world.h"

#include <math.h>
#include <string.h>

enum
{
    DIRECTIONS_APART = 8
};

/* A cone around directions of one origin. */
typedef struct cone
{
    double apex[3];
    double axis[3];
    double cosine, sine; /* of its half angle */
    int is_there;
} cone;

/* What whole vectors have beyond n is as the last ray. Few directions are enough for an axis. */
static cone cone_around(const tof_set *set, const tof_block *block, size_t n)
{
    cone around = {.is_there = block->has_apex, .cosine = 1.0};
    double square = 0.0;
    for (int k = 0; around.is_there && k < 3; k++)
    {
        around.apex[k] = block->apex[k];
        for (size_t i = 0; i < n; i += DIRECTIONS_APART)
        {
            around.axis[k] += block->direction[k][i] + block->direction[k][n - 1 - i];
        }
        square += around.axis[k] * around.axis[k];
    }
    const double length = sqrt(square);
    around.is_there &= length > 0.0;
    if (around.is_there)
    {
        for (int k = 0; k < 3; k++)
        {
            around.axis[k] /= length;
        }
        around.cosine = set->least_cosine(n, block, around.axis);
    }
    around.is_there &= around.cosine > 0.1;
    around.sine = sqrt(fmax(0.0, 1.0 - around.cosine * around.cosine)) + 1e-12;
    return around;
}

/* Is a ball wholly outside? Never said where it is not so. */
static int is_outside(const cone *around, const double centre[3], double radius)
{
    if (!around->is_there || !(radius < INFINITY))
    {
        return 0;
    }
    double along = 0.0, square = 0.0;
    for (int k = 0; k < 3; k++)
    {
        const double to = centre[k] - around->apex[k];
        along += to * around->axis[k];
        square += to * to;
    }
    const double across = sqrt(fmax(0.0, square - along * along));
    /* how far the centre is from the cone's side, outwards */
    return across * around->cosine - along * around->sine > radius * (1.0 + 1e-9) + 1e-9 * along ||
           along < -radius;
}

/* Do all rays of the cone leave a plane behind them? Never said where it is not so. */
static int is_behind(const cone *around, const tof_solid *plane)
{
    const double *normal = plane->axis[0];
    if (!around->is_there)
    {
        return 0;
    }
    double height = 0.0, along = 0.0, square = 0.0;
    for (int k = 0; k < 3; k++)
    {
        height += (plane->centre[k] - around->apex[k]) * normal[k];
        along += around->axis[k] * normal[k];
        square += normal[k] * normal[k];
    }
    /* the most that any ray goes to the side where the plane is */
    const double toward = height < 0.0 ? -along : along;
    const double most =
        toward * around->cosine + sqrt(fmax(0.0, square - along * along)) * around->sine;
    return toward < 0.0 && height != 0.0 && most < -1e-9 * sqrt(square);
}

static int is_left_out(const cone *around, const tof_solid *solid, const tof_bound *bound)
{
    return solid->kind == CM_PRIMITIVE_PLANE ? is_behind(around, solid)
                                             : is_outside(around, bound->centre, bound->radius);
}

static void load_block(tof_block *block, size_t n, size_t first, const double *const origin[3],
                       const double *const direction[3])
{
    const size_t room = (n + TOF_ROOM - 1) / TOF_ROOM * TOF_ROOM;
    block->has_apex = 1;
    for (int k = 0; k < 3; k++)
    {
        memcpy(block->origin[k], origin[k] + first, n * sizeof(double));
        memcpy(block->direction[k], direction[k] + first, n * sizeof(double));
        for (size_t i = n; i < room; i++)
        {
            block->origin[k][i] = block->origin[k][n - 1];
            block->direction[k][i] = block->direction[k][n - 1];
        }
        block->apex[k] = block->origin[k][0];
        /* each as the next one */
        block->has_apex &=
            memcmp(block->origin[k], block->origin[k] + 1, (n - 1) * sizeof *block->origin[k]) == 0;
    }
}

/* A mesh's triangles that are nearer than all before. */
static void meet_body(const tof_body *body, size_t n, tof_block *block, uint32_t *triangle)
{
    double origin[TOF_BLOCK][3], direction[TOF_BLOCK][3], normal[TOF_BLOCK][3];
    uint8_t is_met[TOF_BLOCK];
    uint32_t found[TOF_BLOCK];
    for (size_t i = 0; i < n; i++)
    {
        double from[3], along[3];
        for (int k = 0; k < 3; k++)
        {
            from[k] = block->has_apex ? block->apex[k] : block->origin[k][i];
            along[k] = block->direction[k][i];
        }
        cm_pose_apply(&body->pose, from, origin[i]);
        cm_rotate(&body->pose.rotation, along, direction[i]);
    }
    mesh_rays_cast(body->rays, n, origin, direction, block->distance, found, normal, is_met);
    for (size_t i = 0; i < n; i++)
    {
        if (is_met[i])
        {
            double turned[3];
            cm_rotate_back(&body->pose.rotation, normal[i], turned);
            const double toward = turned[0] * block->direction[0][i] +
                                  turned[1] * block->direction[1][i] +
                                  turned[2] * block->direction[2][i];
            for (int k = 0; k < 3; k++)
            {
                block->normal[k][i] = toward > 0.0 ? -turned[k] : turned[k];
            }
            block->number[i] = (double)body->id;
            triangle[i] = found[i];
        }
    }
}

void tof_meet(const tof_instant *instant, size_t n, tof_block *block, uint32_t *triangle)
{
    const size_t room = (n + TOF_ROOM - 1) / TOF_ROOM * TOF_ROOM;
    const cone around = cone_around(instant->set, block, n);
    for (size_t i = 0; i < room; i++)
    {
        block->number[i] = -1.0;
    }
    for (int k = 0; k < 3; k++)
    {
        memset(block->normal[k], 0, room * sizeof(double));
    }
    for (size_t i = 0; i < instant->solids; i++)
    {
        if (!is_left_out(&around, &instant->solid[i], &instant->bound[i]))
        {
            instant->set->meet(&instant->solid[i], n, block);
        }
    }
    for (size_t i = 0; i < instant->bodies; i++)
    {
        const tof_body *body = &instant->body[i];
        if (body->radius >= 0.0 && !is_outside(&around, body->centre, body->radius))
        {
            meet_body(body, n, block, triangle);
        }
    }
}

static void put_block(const tof_block *block, size_t n, size_t first, const uint32_t *triangle,
                      const tof_hits *hits)
{
    if (hits->distance != NULL)
    {
        memcpy(hits->distance + first, block->distance, n * sizeof(double));
    }
    for (int k = 0; k < 3; k++)
    {
        if (hits->normal[k] != NULL)
        {
            memcpy(hits->normal[k] + first, block->normal[k], n * sizeof(double));
        }
    }
    for (size_t i = 0; i < n; i++)
    {
        if (hits->id != NULL)
        {
            hits->id[first + i] =
                block->number[i] < 0.0 ? CM_SCENE_NOTHING : (uint32_t)block->number[i];
        }
        if (hits->triangle != NULL)
        {
            hits->triangle[first + i] = triangle[i];
        }
    }
}

void tof_cast(const tof_instant *instant, size_t n, const double *const origin[3],
              const double *const direction[3], const tof_hits *hits)
{
    _Alignas(64) tof_block block;
    uint32_t triangle[TOF_BLOCK];
    for (size_t first = 0; first < n; first += TOF_BLOCK)
    {
        const size_t count = n - first < TOF_BLOCK ? n - first : TOF_BLOCK;
        load_block(&block, count, first, origin, direction);
        for (size_t i = 0; i < TOF_BLOCK; i++)
        {
            block.distance[i] = INFINITY;
            triangle[i] = 0;
        }
        tof_meet(instant, count, &block, triangle);
        put_block(&block, count, first, triangle, hits);
    }
}

void tof_cast_shadows(const tof_instant *instant, size_t n, const double *const origin[3],
                      const double *const direction[3], const double *far, uint8_t *blocked)
{
    _Alignas(64) tof_block block;
    uint32_t triangle[TOF_BLOCK];
    for (size_t first = 0; first < n; first += TOF_BLOCK)
    {
        const size_t count = n - first < TOF_BLOCK ? n - first : TOF_BLOCK;
        load_block(&block, count, first, origin, direction);
        memset(block.distance, 0, sizeof block.distance);
        memcpy(block.distance, far + first, count * sizeof(double));
        tof_meet(instant, count, &block, triangle);
        for (size_t i = 0; i < count; i++)
        {
            blocked[first + i] = block.number[i] >= 0.0;
        }
    }
}
