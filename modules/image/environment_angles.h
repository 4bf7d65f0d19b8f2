/* SPDX-License-Identifier: MIT
 *
 * Solid angles of texels.
 */
#ifndef MODULES_IMAGE_ENVIRONMENT_ANGLES_H
#define MODULES_IMAGE_ENVIRONMENT_ANGLES_H

#include <cubemap/mapping.h>

/* How many faces have angles of their own: a warp is the same on all. */
uint8_t cm_angle_faces(const cm_mapping *mapping);

/* Those of a face, rows going up with v. CM_OK or CM_ERROR_MEMORY. */
cm_status cm_face_angles(const cm_mapping *mapping, uint8_t face, uint32_t size, unsigned threads,
                         double *angle);

/* The edge of the coarse table of solid angles that levels are chosen by. */
#define CM_DENSITY_SIZE 64

/* log2 of the edges, in radians, of the texels of faces that have size of them along an edge, by a table of
 * cm_angle_faces faces with CM_DENSITY_SIZE^2 each, to be freed. CM_OK or CM_ERROR_MEMORY. */
cm_status cm_angle_edges_make(const cm_mapping *mapping, uint32_t size, unsigned threads,
                              float **edge);

#endif
