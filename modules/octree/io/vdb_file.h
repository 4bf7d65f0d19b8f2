/* SPDX-License-Identifier: MIT
 *
 * Voxels as a file of OpenVDB: a grid of floats "occupancy", alpha / 255 of what is occupied, and one of vectors "Cd", the
 * colours from 0 to 1, if there are any. Index k is the voxel [k, k + 1) from the map's centre; the grids' transform leads
 * to the world.
 *
 *   message     one line of CM_IMAGE_MESSAGE bytes at most, "FILE: what is wrong". Written on failure only
 *   failures    CM_ERROR_ARGUMENT, CM_ERROR_MEMORY, CM_ERROR_FILE, CM_ERROR_UNSUPPORTED (this build has no OpenVDB)
 */
#ifndef CUBEMAP_MODULES_OCTREE_VDB_FILE_H
#define CUBEMAP_MODULES_OCTREE_VDB_FILE_H

#include <cubemap/octree.h>

#include "modules/image/io/image_io.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Write voxels of a level of a map that was made of these options into a file; name is for the message. */
cm_status cm_vdb_write(const char *path, const char *name, const cm_octree_options *options,
                       int level, size_t count, const cm_voxel *voxel, char *message);

/* 1 if this build has OpenVDB. */
int cm_vdb_is_there(void);

#ifdef __cplusplus
}
#endif

#endif
