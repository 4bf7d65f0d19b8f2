/* SPDX-License-Identifier: MIT
 *
 * The closed forms of auxiliary latitudes (latitude_exact.c).
 */
#ifndef LIBCUBEMAP_EARTH_LATITUDE_SHAPE_H
#define LIBCUBEMAP_EARTH_LATITUDE_SHAPE_H

#include <cubemap/latitude.h>

/* One ellipsoid, for the closed forms (latitude_exact.c). */
typedef struct cm_latitude_shape
{
    double axes;                     /* b / a = 1 - f */
    double ratio;                    /* a / b */
    double m;                        /* (a / b)^2 - 1: above 0 for oblate ones */
    double root_m;                   /* sqrt |m| */
    double e;                        /* sqrt |e^2|, e^2 = f (2 - f) */
    double e_rest;                   /* what e lacks */
    double zone;                     /* from the equator to the pole, for the authalic latitude */
    double quadrant;                 /* of the meridian over b, for the rectifying one */
    double least[CM_LATITUDE_COUNT]; /* of tan(latitude) / tan(parametric latitude) */
    double greatest[CM_LATITUDE_COUNT];
} cm_latitude_shape;

/* f is not 0. */
void cm_latitude_shape_make(double f, cm_latitude_shape *shape);

/* tan(to) / tan(from) where tan(from) = sine / cosine, both not below 0 and not both 0; relatively accurate. */
double cm_latitude_ratio(const cm_latitude_shape *shape, cm_latitude from, cm_latitude to,
                         double sine, double cosine);

#endif
