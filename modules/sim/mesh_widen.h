/* SPDX-License-Identifier: MIT
 *
 * Triangles a little wider than they are, for a search in single precision: what meets a triangle in double precision meets
 * the wider one there. What the search finds has to be asked of the triangle itself.
 */
#ifndef CUBEMAP_SIM_MESH_WIDEN_H
#define CUBEMAP_SIM_MESH_WIDEN_H

/* In the triangle's plane, all that is within the margin of it; of a triangle of no area its first corner thrice. */
void mesh_widen(const double corner[3][3], double margin, double wide[3][3]);

#endif
