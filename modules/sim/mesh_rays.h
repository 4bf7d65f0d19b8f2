/* SPDX-License-Identifier: MIT
 *
 * Rays to a mesh: Embree searches in single precision, for triangles a little wider than the mesh's, so that it passes none
 * that a ray meets at a vertex or edge. Where they are met is computed in double precision, and what does not lie on its
 * triangle is looked for again, without a crack (Embree's issues 387, 416 and 423 tell of such hits).
 */
#ifndef CUBEMAP_SIM_MESH_RAYS_H
#define CUBEMAP_SIM_MESH_RAYS_H

#include "mesh_edges.h"

#include <cubemap/mesh.h>
#include <cubemap/status.h>

typedef struct mesh_rays mesh_rays;

/* CM_OK; CM_ERROR_RANGE (more triangles, or coordinates farther away, than Embree takes). */
cm_status mesh_rays_check(const cm_mesh_options *mesh);

/* The mesh must outlive it. CM_OK; CM_ERROR_RANGE as there; CM_ERROR_MEMORY. */
cm_status mesh_rays_create(const cm_mesh *mesh, mesh_rays **made);
void mesh_rays_destroy(mesh_rays *mesh);
const cm_mesh *mesh_rays_mesh(const mesh_rays *mesh);

/* Its edges, which are found when they are first asked for; any number of threads may ask. CM_OK; CM_ERROR_MEMORY. */
cm_status mesh_rays_edges(mesh_rays *mesh, const mesh_edges **found);

/* Centre and radius of a sphere around all of it; radius below 0: it has no triangles. */
void mesh_rays_bound(const mesh_rays *mesh, double centre[3], double *radius);

/* For n rays in the mesh's axes, directions of length 1, whose distance so far is given: where a triangle is nearer,
 * distance, triangle and its normal (of length 1, either way) are set, and is_met is 1. */
void mesh_rays_cast(const mesh_rays *mesh, size_t n, double (*const origin)[3],
                    double (*const direction)[3], double *distance, uint32_t *triangle,
                    double (*normal)[3], uint8_t *is_met);

#endif
