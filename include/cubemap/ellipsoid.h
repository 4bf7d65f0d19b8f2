/* SPDX-License-Identifier: MIT
 *
 * Ellipsoids of revolution: those that have a name, and any other by its axes. Lengths are metres. No function here
 * allocates or keeps anything; all may be called from any thread.
 */
#ifndef CUBEMAP_ELLIPSOID_H
#define CUBEMAP_ELLIPSOID_H

#include <stddef.h>

#include <cubemap/export.h>
#include <cubemap/status.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The axis of rotation is z. b = a (1 - f); f > 0 is oblate, as planets are, f < 0 prolate. */
typedef struct cm_ellipsoid
{
    size_t size;            /* sizeof(cm_ellipsoid), which tells the table's version */
    const char *identifier; /* "WGS84"; "" for one of the user's */
    const char *name;       /* one line for people */
    const char *source;     /* where the axes come from */
    double a;               /* the equatorial radius, metres: finite, above 0 */
    double f; /* the flattening (a - b) / a, from -99 to 0.99: b / a from 100 to 1 / 100 */
} cm_ellipsoid;

/* The number of ellipsoids that the library knows, and the one at an index below it (else NULL), in a fixed
 * order, WGS84 first: those of the Earth, today's and former ones (of the EPSG Geodetic Parameter Dataset and their own
 * publications), then other bodies (of the report of the IAU Working Group on Cartographic Coordinates and Rotational
 * Elements for 2015, Archinal et al. 2018; those that are nearly spheres or have three axes as spheres). Each has the
 * inverse flattening or the two axes that its source has. The tables are constant and live as long as the program. */
CM_API size_t cm_ellipsoid_count(void);
CM_API const cm_ellipsoid *cm_ellipsoid_at(size_t index);

/* The ellipsoid of that identifier (upper and lower case are the same), or NULL. */
CM_API const cm_ellipsoid *cm_ellipsoid_find(const char *identifier);

/* From a text: an identifier, or "A,1/F", the equatorial radius in metres and the inverse of the
 * flattening, e.g. "6378137,298.257223563" or, with the bar written, "6378137,1/298.257223563"; "6371000,0"
 * and "6371000" are spheres. Numbers are decimal, with a point in every locale, and without blanks.
 * CM_OK, and *ellipsoid then passes cm_ellipsoid_check; its texts live as long as the program.
 * CM_ERROR_ARGUMENT or CM_ERROR_ELLIPSOID, with *ellipsoid untouched, and then, if message is not NULL, at most
 * message_size bytes of one line that says what is wrong, always ended by a zero byte if message_size > 0. */
CM_API cm_status cm_ellipsoid_parse(const char *text, cm_ellipsoid *ellipsoid, char *message,
                                    size_t message_size);

/* Are size, a and f what they may be? CM_OK, CM_ERROR_ARGUMENT (NULL) or CM_ERROR_ELLIPSOID. */
CM_API cm_status cm_ellipsoid_check(const cm_ellipsoid *ellipsoid);

/* The surface, in square metres, and the radius of the sphere of that surface, in metres; NaN for what is no
 * ellipsoid (NULL too). Beyond the range of double a surface is infinite or 0. */
CM_API double cm_ellipsoid_area(const cm_ellipsoid *ellipsoid);
CM_API double cm_ellipsoid_authalic_radius(const cm_ellipsoid *ellipsoid);

#ifdef __cplusplus
}
#endif

#endif
