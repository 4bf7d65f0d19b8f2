/* SPDX-License-Identifier: MIT
 *
 * Maps of OctoMap (Hornung and others, 2013): .ot, with a log-odds value a node, and .bt, with two bits a child.
 *
 *   read        trees of the ids OcTree, ColorOcTree and OcTreeStamped (.ot), of any id (.bt). Their 16 levels and their
 *               centre, 0, stay; values become those of log-odds with OctoMap's standard bounds, -2 and 3.5 (.bt: one of
 *               these), of which 127 steps are 3.5. A value of 0 is occupied there, and here
 *   refused     what is cut or goes on behind its last node, nodes below the finest voxels, another number of nodes than the
 *               head says, values that are not finite
 *   message     one line of CM_IMAGE_MESSAGE bytes at most, "FILE: what is wrong". Written on failure only
 *   failures    CM_ERROR_ARGUMENT, CM_ERROR_MEMORY, CM_ERROR_FILE, CM_ERROR_DATA, CM_ERROR_UNSUPPORTED (another id)
 */
#ifndef CUBEMAP_MODULES_OCTREE_OCTOMAP_FILE_H
#define CUBEMAP_MODULES_OCTREE_OCTOMAP_FILE_H

#include <cubemap/octree.h>

#include "modules/image/io/image_io.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The map of a file, for cm_octree_destroy. */
cm_status cm_octomap_read(const char *path, cm_octree **octree, char *message);

/* The same of count bytes; name is for the message. */
cm_status cm_octomap_parse(const char *name, const void *bytes, size_t count, cm_octree **octree,
                           char *message);

#ifdef __cplusplus
}
#endif

#endif
