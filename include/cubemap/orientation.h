/* SPDX-License-Identifier: MIT
 *
 * Orientations: how the base cube stands on the Earth. orient.h finds the one that suits a mask best.
 *
 *   angles      degrees: what people write, and exact at multiples of 90, as radians are not
 *   direction   three numbers of any length, as in mapping.h
 *   threads     nothing is changed but what the arguments point to, and nothing is allocated; any number of threads
 *               may call
 */
#ifndef CUBEMAP_ORIENTATION_H
#define CUBEMAP_ORIENTATION_H

#include <stddef.h>

#include <cubemap/export.h>
#include <cubemap/status.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A rotation, as a matrix by rows: the cube's x, y and z axis (frame.h: the middles of front, right and top
 * in geo) in the Earth's axes, so that row times direction of the Earth is direction of the cube. This struct
 * will not change. */
typedef struct cm_rotation
{
    double row[3][3]; /* row[0] is the cube's x axis */
} cm_rotation;

/* The middle of the cube's front (+x) goes to longitude lon and latitude lat, and then the cube is turned
 * about that axis by roll, anticlockwise seen from outside: roll 0 has its z axis in the meridian of lon. lon
 * and roll are any finite numbers, lat in [-90, 90]. The elements are exact where all three are multiples of 90.
 * CM_OK; CM_ERROR_ARGUMENT (NULL); CM_ERROR_ORIENTATION (other angles). */
CM_API cm_status cm_rotation_from_angles(double lon, double lat, double roll,
                                         cm_rotation *rotation);

/* The angles of a rotation: lon and roll in [-180, 180], lat in [-90, 90]; where the front looks to a pole, lon
 * is 0. cm_rotation_from_angles makes the same matrix of them, but for rounding; near the poles lon and roll are
 * each as uncertain as they must be.
 * CM_OK; CM_ERROR_ARGUMENT (NULL); CM_ERROR_ORIENTATION as cm_rotation_check. */
CM_API cm_status cm_rotation_angles(const cm_rotation *rotation, double *lon, double *lat,
                                    double *roll);

/* Is it orthonormal to 1e-12 and right-handed? CM_OK; CM_ERROR_ARGUMENT (NULL); CM_ERROR_ORIENTATION. */
CM_API cm_status cm_rotation_check(const cm_rotation *rotation);

/* Direction of the Earth to direction of the cube, and back. The length stays; multiples of 90 degrees give the
 * same numbers in other places, exactly. What is not finite, or longer than numbers go, gives an infinity or a NaN in some component.
 * to may be from. Not to be given NULL. */
CM_API void cm_rotate(const cm_rotation *rotation, const double from[3], double to[3]);
CM_API void cm_rotate_back(const cm_rotation *rotation, const double from[3], double to[3]);

/* From a text: "LON,LAT[,ROLL]" in degrees as for cm_rotation_from_angles, decimal numbers with a point in
 * every locale and nothing else between the commas; or the identifier of a named orientation (upper and lower case
 * are the same).
 * CM_OK; CM_ERROR_ARGUMENT or CM_ERROR_ORIENTATION, and then, if message is not NULL, at most message_size
 * bytes of one line that says what is wrong, always ended by a zero byte if message_size > 0. */
CM_API cm_status cm_rotation_parse(const char *text, cm_rotation *rotation, char *message,
                                   size_t message_size);

/* An orientation with a name: the optimum of a measure over a mask (orient.h). Read through pointers that the
 * library gives out; it may grow at its end. */
typedef struct cm_orientation
{
    size_t size;            /* sizeof(cm_orientation) */
    const char *identifier; /* "land-coupled" */
    const char *name;       /* one line for people */
    const char *mapping;    /* a specification */
    const char *measure;    /* what is least over the mask: a name of cm_orient_measure_name */
    double lon;             /* degrees, as cm_rotation_from_angles takes them */
    double lat;             /* degrees */
    double roll;            /* degrees */
    double before;          /* the measure of the cube that is not turned */
    double after;           /* and in this orientation */
} cm_orientation;

/* The number of orientations that have a name, and the one at an index below it (else NULL), in a fixed
 * order; and the one of an identifier (upper and lower case are the same), or NULL. The tables are constant and
 * live as long as the program. */
CM_API size_t cm_orientation_count(void);
CM_API const cm_orientation *cm_orientation_at(size_t index);
CM_API const cm_orientation *cm_orientation_find(const char *identifier);

#ifdef __cplusplus
}
#endif

#endif
