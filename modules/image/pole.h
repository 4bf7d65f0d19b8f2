/* SPDX-License-Identifier: MIT
 *
 * The plane around a pole of a source whose rows are parallels, evenly apart, and whose columns are meridians all around:
 * its polar coordinates are rows from the pole and longitude. Beside the pole it bends little, and derivatives of its x and
 * y are good where those of columns have no bounds.
 */
#ifndef MODULES_IMAGE_POLE_H
#define MODULES_IMAGE_POLE_H

#include "surface_object.h"

#include <math.h>

/* No place counts as nearer to the pole, in rows, for derivatives of columns. */
#define CM_POLE_NEAREST (1.0 / 1024.0)

typedef struct cm_pole_place
{
    double x; /* rows */
    double y;
    double cosine; /* of the longitude from where columns begin */
    double sine;
    double along; /* rows to a column, along the parallel */
    double away;  /* rows from the pole to a row: 1, or -1 if it is the lower edge */
} cm_pole_place;

/* Is the lower edge the pole that a row is nearer to, of those that the surface has? */
static inline int cm_pole_is_lower(const cm_surface *surface, double row)
{
    return surface->poles == CM_POLE_LOWER ||
           (surface->poles != CM_POLE_UPPER && surface->height - row < row);
}

static inline cm_pole_place cm_pole_place_of(const cm_surface *surface, int is_lower, double column,
                                             double row)
{
    const double turn = 2.0 * 3.14159265358979323846 / surface->width;
    const double distance = is_lower ? surface->height - row : row;
    const double cosine = cos(turn * column), sine = sin(turn * column);
    return (cm_pole_place){.x = distance * cosine,
                           .y = distance * sine,
                           .cosine = cosine,
                           .sine = sine,
                           .along = turn * fmax(distance, CM_POLE_NEAREST),
                           .away = is_lower ? -1.0 : 1.0};
}

/* From derivatives of column and row to those of x and y. */
static inline void cm_pole_slope(const cm_pole_place *at, const double of_pixel[2],
                                 double of_plane[2])
{
    const double away = at->away * of_pixel[1], along = at->along * of_pixel[0];
    of_plane[0] = away * at->cosine - along * at->sine;
    of_plane[1] = away * at->sine + along * at->cosine;
}

/* And back. */
static inline void cm_pole_slope_back(const cm_pole_place *at, const double of_plane[2],
                                      double of_pixel[2])
{
    of_pixel[0] = (of_plane[1] * at->cosine - of_plane[0] * at->sine) / at->along;
    of_pixel[1] = (of_plane[0] * at->cosine + of_plane[1] * at->sine) * at->away;
}

#endif
