/* SPDX-License-Identifier: MIT
 *
 * The edges of a mesh with the triangles at both sides, of which outlines are found: where one triangle faces the eye and the
 * other does not, or where there is no other.
 */
#ifndef CUBEMAP_SIM_MESH_EDGES_H
#define CUBEMAP_SIM_MESH_EDGES_H

#include <cubemap/mesh.h>
#include <cubemap/pool.h>
#include <cubemap/status.h>

typedef struct mesh_edge
{
    uint32_t vertex[2];
    uint32_t triangle
        [2]; /* the second: MESH_NO_TRIANGLE where not two meet; or'ed with MESH_TURNED if they wind against
                             each other */
} mesh_edge;

#define MESH_NO_TRIANGLE UINT32_MAX
#define MESH_TURNED 0x80000000u

typedef struct mesh_edges
{
    size_t count;
    mesh_edge *edge;
} mesh_edges;

/* Vertices at the same place are one. CM_OK; CM_ERROR_MEMORY. */
cm_status mesh_edges_create(const cm_mesh *mesh, mesh_edges **made);
void mesh_edges_destroy(mesh_edges *edges);

/* Of each triangle: 1 or -1 by the side that faces the eye, 0 for neither. */
void mesh_edges_face(const cm_mesh *mesh, const double eye[3], cm_pool *pool, int8_t *facing);

/* Is the edge one of the outline? */
static inline int mesh_edge_is_outline(const mesh_edge *edge, const int8_t *facing)
{
    if (edge->triangle[1] == MESH_NO_TRIANGLE)
    {
        return 1;
    }
    const int turned = (edge->triangle[1] & MESH_TURNED) != 0 ? -1 : 1;
    return turned * facing[edge->triangle[0]] * facing[edge->triangle[1] & ~MESH_TURNED] <= 0;
}

#endif
