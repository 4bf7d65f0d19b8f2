/* SPDX-License-Identifier: MIT
 *
 * A grid: a mapping on an ellipsoid, turned.
 */
#ifndef LIBCUBEMAP_EARTH_GRID_OBJECT_H
#define LIBCUBEMAP_EARTH_GRID_OBJECT_H

#include <cubemap/grid.h>

#include "libcubemap/batch/mapping_object.h"

struct cm_grid
{
    cm_mapping *mapping;
    cm_ellipsoid ellipsoid;
    cm_latitude latitude;
    cm_latitude_conversion *there; /* from geographic; NULL where nothing changes */
    cm_latitude_conversion *back;
    cm_rotation rotation;
    int is_rotated;
};

#endif
