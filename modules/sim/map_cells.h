/* SPDX-License-Identifier: MIT
 *
 * Maps of the sphere by cells: how many faces one has, and what solid angle is behind its plane.
 */
#ifndef CUBEMAP_SIM_MAP_CELLS_H
#define CUBEMAP_SIM_MAP_CELLS_H

#include <cubemap/mapping.h>

#include <math.h>

/* Six of a cube, one of any other. */
static inline int map_faces(const cm_mapping *mapping)
{
    return cm_mapping_describe(mapping)->kind == CM_KIND_CUBE ? 6 : 1;
}

/* Solid angle by area, of the inverse's Jacobian as cm_inverse_jacobian has it; 0 where there is none. */
static inline double map_stretch(const double jacobian[6])
{
    double square = 0.0;
    for (int k = 0; k < 3; k++)
    {
        const int a = (k + 1) % 3, b = (k + 2) % 3;
        const double c =
            jacobian[2 * a] * jacobian[2 * b + 1] - jacobian[2 * b] * jacobian[2 * a + 1];
        square += c * c;
    }
    return isfinite(square) ? sqrt(square) : 0.0;
}

#endif
