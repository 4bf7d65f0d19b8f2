/* SPDX-License-Identifier: MIT
 *
 * Frames: how the six faces of the cube sit on the axes. A frame is a table, never code: for each
 * face the three signed axes that play outward, u and v.
 *
 *   geo   x through lon 0 lat 0, y through lon 90 E, z north. Faces 0 front (+x), 1 right (+y),
 *         2 back (-x), 3 left (-y), 4 top (+z), 5 bottom (-z), as in PROJ's qsc. On 0..3 u grows
 *         east and v north; top and bottom join the front face.
 *   fits  the same axes, numbered 0 top, 1..4 equatorial from lon 0 eastward, 5 bottom (FITS WCS
 *         paper II, Calabretta & Greisen 2002, section 5.6).
 *   gl    the cube-map table of OpenGL, Vulkan and Direct3D: +x -x +y -y +z -z, u along s, v along
 *         t (OpenGL 4.6 core, table 8.19). There v grows *down* a stored face.
 *   s2    the axes of geo, the faces of the S2 library: +x +y +z -x -y -z (s2geometry, s2coords.h). Each
 *         face is turned so that a Hilbert curve goes on from each to the next (cell.h).
 *
 * If the axes are right-handed, as those of a globe are, the pictures of the faces show the sphere from outside;
 * if they are left-handed, as in Direct3D, from inside. docs/guide/frames.md has the pictures.
 */
#ifndef CUBEMAP_FRAME_H
#define CUBEMAP_FRAME_H

#include <stddef.h>

#include <cubemap/export.h>
#include <cubemap/status.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Signed axes: CM_AXIS_X is +x, -CM_AXIS_X is -x. */
#define CM_AXIS_X 1
#define CM_AXIS_Y 2
#define CM_AXIS_Z 3

/* How one face sits. */
typedef struct cm_frame_face
{
    const char *name;    /* "front", "+x" */
    signed char outward; /* the signed axis through the face's centre */
    signed char u;       /* the signed axis along which u grows */
    signed char v;       /* the signed axis along which v grows */
} cm_frame_face;

/* A frame's table. */
typedef struct cm_frame
{
    size_t size;            /* sizeof(cm_frame), which tells the table's version */
    const char *identifier; /* "geo" */
    const char *name;       /* one line for people */
    int first_row_v;        /* +1 or -1: the value of v at the first row of a face's picture */
    cm_frame_face face[6];  /* by number */
} cm_frame;

/* The number of frames that the library knows, and the frame at an index below it (else NULL), in a
 * fixed order: geo, gl, fits, s2. The tables are constant and live as long as the program. */
CM_API size_t cm_frame_count(void);
CM_API const cm_frame *cm_frame_at(size_t index);

/* The frame of that identifier (upper and lower case are the same), or NULL. */
CM_API const cm_frame *cm_frame_find(const char *identifier);

/* Is this table a frame: six different outward axes, u and v perpendicular to them and to each
 * other, first_row_v +1 or -1? CM_OK, CM_ERROR_ARGUMENT (NULL) or CM_ERROR_FRAME. */
CM_API cm_status cm_frame_check(const cm_frame *frame);

#ifdef __cplusplus
}
#endif

#endif
