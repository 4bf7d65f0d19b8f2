/* SPDX-License-Identifier: MIT
 *
 * The filter of cubemap-project: lines of numbers through a mapping, in constant memory.
 */
#ifndef CUBEMAP_TOOLS_POINT_FILTER_H
#define CUBEMAP_TOOLS_POINT_FILTER_H

#include <stdbool.h>

#include <cubemap/cell_grid.h>
#include <cubemap/grid.h>
#include <cubemap/healpix.h>
#include <cubemap/mapping.h>

#include "tools/cli/failure.h"

struct filter_options
{
    int digits;          /* significant ones to write, 1 to 17 */
    bool inverse;        /* from faces, disc or square */
    bool single;         /* compute in float */
    bool xyz;            /* directions are x y z, not lon lat; on an ellipsoid those of normals */
    const cm_grid *grid; /* ellipsoid and rotation; NULL for none */
    /* Instead of places on the plane, if not NULL: */
    const cm_cell_grid *cells; /* of the grid */
    int level;                 /* of the cells that are written */
    const cm_healpix *pixels;
};

/* Read the input to its end and write the results. What is wrong with a line is told at once, with the
 * input's name; false if any was wrong, or after a failure. */
bool filter_points(const struct filter_options *options, const cm_mapping *mapping,
                   const cm_streams *streams, const char *name, cm_failure *failure);

#endif
