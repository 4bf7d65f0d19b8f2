/* SPDX-License-Identifier: MIT
 *
 * The walks of octrees call a function of C, which calls one of JavaScript.
 */
#include <cubemap/octree.h>

/* Of JavaScript: what is not 0 ends the walk. */
__attribute__((import_module("cubemap"), import_name("voxel"))) int
cubemap_voxel(const cm_voxel *voxel);

static int job(void *user, const cm_voxel *voxel)
{
    (void)user;
    return cubemap_voxel(voxel);
}

/* What a walk is to be given. */
cm_voxel_job cubemap_voxel_job(void);

__attribute__((visibility("default"))) cm_voxel_job cubemap_voxel_job(void)
{
    return job;
}
