/* SPDX-License-Identifier: MIT
 *
 * What the files of an advice share.
 */
#ifndef LIBCUBEMAP_ADVISE_ADVICE_OBJECT_H
#define LIBCUBEMAP_ADVISE_ADVICE_OBJECT_H

#include <cubemap/cubemap.h>

/* Metres a radian of the sphere of the Earth's surface, in which errors are stated. */
#define CM_ADVICE_EARTH 6371007.2

struct cm_advice
{
    cm_advice_request request; /* its ellipsoid is not kept */
    int has_ellipsoid;
    size_t count;
    size_t qualified;
    cm_advice_candidate *candidate;
    char *specifications; /* of all, each with its zero byte */
};

/* What a sphere's angle is on the ground, and what a latitude does to a map: its own distortion, and its errors. */
typedef struct cm_advice_globe
{
    cm_latitude latitude;
    double isotropy; /* greatest ratio of the two scales, 1 for a sphere */
    double area;     /* greatest relative change of area, 0 for a sphere */
    double radius;   /* metres a radian, at most */
    double error;    /* of the latitude there and back, radians */
} cm_advice_globe;

/* For a mapping of the properties given; metres is the limit of the error, infinite for none. ellipsoid NULL: a
 * sphere. Fails only as conversions of latitudes do. */
cm_status cm_advice_globe_make(const cm_ellipsoid *ellipsoid, unsigned properties, double metres,
                               cm_advice_globe *globe);

/* The values of distortion on the sphere, of a mapping to six faces; then on a globe. */
cm_status cm_advice_measure(const cm_mapping *mapping, double value[CM_LIMIT_NUMBERS]);
void cm_advice_put_on_globe(const cm_advice_globe *globe, double value[CM_LIMIT_NUMBERS]);

/* The promised bound of a round trip in radians of the sphere; NaN if there is none. */
double cm_advice_round_trip(const cm_mapping *mapping, cm_precision precision);

/* What edges must be at least, by what is said of them and of faces. */
static inline cm_smoothness cm_advice_edge(const cm_advice_request *request)
{
    cm_smoothness whole = request->smooth > CM_SMOOTH_TORN ? CM_SMOOTH_C0 : CM_SMOOTH_TORN;
    return request->edge > whole ? request->edge : whole;
}

/* Is a limit a number that holds? */
static inline int cm_advice_is_limited(const cm_advice_request *request, int limit)
{
    return (request->limited >> limit & 1u) != 0 && request->limit[limit] < (double)INFINITY;
}

#endif
