/* SPDX-License-Identifier: MIT
 *
 * Meshes: indexed triangles with a material. Of the library cubemap-scene.
 *
 *   triangles   three indices of vertices each; both sides are seen. What is outside depends on no winding
 *   units       as the user's, metres by custom; colours in 0..1
 *   copies      a mesh keeps its own copy of all that it is made of, and a tree of boxes in which rays find triangles
 *   threads     a mesh is constant after its creation
 */
#ifndef CUBEMAP_MESH_H
#define CUBEMAP_MESH_H

#include <stddef.h>
#include <stdint.h>

#include <cubemap/export.h>
#include <cubemap/status.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A mesh, from cm_mesh_create to cm_mesh_destroy. */
typedef struct cm_mesh cm_mesh;

/* How a surface looks. */
typedef struct cm_material
{
    double color[3];    /* 0..1, red, green, blue */
    double reflectance; /* 0..1, of the light of an active camera */
} cm_material;

/* To be filled with zeros but for size and what is wanted. Arrays that may be NULL are one value a vertex. */
typedef struct cm_mesh_options
{
    size_t size;            /* sizeof(cm_mesh_options) */
    size_t vertex_count;    /* below 2^31 */
    const double *position; /* vertex_count x 3 */
    const float *normal;    /* vertex_count x 3, of any length but 0; or NULL */
    const float *uv;        /* vertex_count x 2, places in a texture; or NULL */
    const float *color;     /* vertex_count x 3, which the material's colour multiplies; or NULL */
    size_t triangle_count;  /* below 2^31; 0 is allowed */
    const uint32_t *index;  /* triangle_count x 3, each below vertex_count */
    cm_material material;   /* of all triangles */
} cm_mesh_options;

/* All numbers must be finite, colours and reflectance in 0..1, and coordinates below 1e100. A mesh without triangles is one,
 * which no ray meets.
 * CM_OK; CM_ERROR_ARGUMENT (NULL, size, an index out of range, 2^31 triangles or vertices); CM_ERROR_RANGE (other
 * numbers); CM_ERROR_MEMORY. */
CM_API cm_status cm_mesh_create(const cm_mesh_options *options, cm_mesh **mesh);
CM_API void cm_mesh_destroy(cm_mesh *mesh);

/* What the mesh was made of; the arrays are the mesh's own, and live as long as it does. */
CM_API const cm_mesh_options *cm_mesh_describe(const cm_mesh *mesh);

/* The least and the greatest coordinates of the triangles' vertices; NaN where there is none. */
CM_API void cm_mesh_bounds(const cm_mesh *mesh, double least[3], double greatest[3]);

#ifdef __cplusplus
}
#endif

#endif
