/* SPDX-License-Identifier: MIT
 *
 * What a world made ready, and the same at a time, are made of.
 */
#ifndef CUBEMAP_SIM_TOF_WORLD_H
#define CUBEMAP_SIM_TOF_WORLD_H

#include <stdatomic.h>

#include "mesh_rays.h"
#include "tof_object.h"
#include "tof_set.h"

struct cm_tof_scene
{
    cm_primitive *primitive;
    size_t count;
    const mesh_rays **rays; /* a primitive: of its mesh; NULL of others */
    mesh_rays **meshes;     /* each mesh once */
    size_t mesh_count;
    const tof_set *set;
    _Atomic(void *)
        spare; /* memory of a frame that is done, for the next one: its first word is its size */
    _Atomic(tof_sky *) sky; /* surroundings of a frame that is done, for the next one */
};

/* Memory of at least so many bytes, for any type: the spare one if it is large enough. NULL: none. */
void *tof_scene_take(cm_tof_scene *scene, size_t size);

/* Gives it back, to be the spare one. */
void tof_scene_return(cm_tof_scene *scene, void *memory);

/* The surroundings made ready: the last frame's if they are the same. CM_OK; CM_ERROR_MEMORY. */
cm_status tof_scene_take_sky(cm_tof_scene *scene, const cm_tof_environment *environment,
                             cm_pool *pool, tof_sky **taken);

/* Gives them back, to be kept; NULL is allowed. */
void tof_scene_return_sky(cm_tof_scene *scene, tof_sky *sky);

/* A mesh as it stands at a time. */
typedef struct tof_body
{
    const mesh_rays *rays;
    uint32_t id;
    cm_pose pose; /* world to the mesh's axes */
    double centre[3];
    double radius; /* around all of it; below 0: nothing */
} tof_body;

/* Balls around what is bounded; radius is infinite of planes. */
typedef struct tof_bound
{
    double centre[3];
    double radius;
} tof_bound;

struct tof_instant
{
    const tof_set *set;
    tof_surface *surface; /* by id */
    tof_solid *solid;
    tof_bound *bound; /* of solids */
    size_t solids;
    tof_body *body;
    size_t bodies;
    int has_brdf; /* some surface is not Lambert's */
};

/* What the rays of a block meet nearer than its distances; triangles of meshes. */
void tof_meet(const tof_instant *instant, size_t n, tof_block *block, uint32_t *triangle);

/* The pose of a motion at a time: before its first stamp and after its last one it stands. */
void tof_pose_at(const cm_trajectory *motion, double time, cm_pose *pose);

#endif
