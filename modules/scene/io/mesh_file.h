/* SPDX-License-Identifier: MIT
 *
 * Meshes from files: glTF 2.0 (.gltf, .glb) and Wavefront OBJ with its MTL.
 *
 *   child       a file is read by a child of the process with limits on memory and time, since readers of such files have
 *               crashed on crafted ones; what it hands over is checked as cm_mesh_create does. A child that crashes is one
 *               message
 *   glTF        triangles, strips and fans of the default scene, with the nodes' transforms; colours are the materials' base
 *               colour times the vertices'. Axes stay as they are in the file. Textures, skins and morphs are left out;
 *               numbers that cannot be read and extensions that change geometry are refused, but for
 *               KHR_mesh_quantization: positions of bytes and shorts
 *   OBJ         polygons as triangles, indices from either end, the diffuse colours of materials times those of vertices
 *   nearby      files that these name are read in their folder and below it only
 *   message     one line of CM_IMAGE_MESSAGE bytes at most, "FILE: what is wrong". Written on failure only
 */
#ifndef CUBEMAP_MODULES_SCENE_MESH_FILE_H
#define CUBEMAP_MODULES_SCENE_MESH_FILE_H

#include <cubemap/mesh.h>

#include "modules/image/io/image_io.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What the child may take; 0: as it is said there. */
typedef struct cm_mesh_limits
{
    size_t size;      /* sizeof(cm_mesh_limits) */
    uint64_t memory;  /* bytes beyond what the process has; 4 GiB */
    unsigned seconds; /* of processor time, and twice as long by the clock; 60 */
} cm_mesh_limits;

/* The mesh of a file, for cm_mesh_destroy, with reflectance 1. limits may be NULL. Not to be called by several threads at a
 * time, nor with others that allocate: the process forks.
 * CM_ERROR_ARGUMENT, CM_ERROR_MEMORY; CM_ERROR_FILE (no such file, or no child); CM_ERROR_UNSUPPORTED (neither .gltf, .glb nor
 * .obj, or this build has no reader for it); CM_ERROR_DATA (what is wrong with it, the limits too). */
cm_status cm_mesh_file_read(const char *path, const cm_mesh_limits *limits, cm_mesh **mesh,
                            char *message);

#ifdef __cplusplus
}
#endif

#endif
