/* SPDX-License-Identifier: MIT
 *
 * Points and triangles as PLY (Turk 1994, "The PLY Polygon File Format"), in text or little-endian binary.
 *
 *   read        of "vertex" x y z, nx ny nz, red green blue (whole numbers of 8 bits, or 0 to 1 of floating point); of "face"
 *               the list vertex_indices or vertex_index, polygons as fans of triangles. All else is passed over
 *   message     one line of CM_IMAGE_MESSAGE bytes at most, "FILE:LINE: what is wrong", without a line behind a binary head.
 *               Written on failure only
 *   failures    CM_ERROR_ARGUMENT, CM_ERROR_MEMORY, CM_ERROR_FILE, CM_ERROR_DATA, CM_ERROR_UNSUPPORTED (big-endian)
 */
#ifndef CUBEMAP_MODULES_SCENE_PLY_FILE_H
#define CUBEMAP_MODULES_SCENE_PLY_FILE_H

#include "modules/image/io/image_io.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What such a file has. Arrays belong to the caller; those that were read are for cm_ply_clear. */
typedef struct cm_ply
{
    size_t point_count;
    double *position;     /* 3 each */
    float *normal;        /* 3 each; NULL: none */
    unsigned char *color; /* red, green, blue each; NULL: none */
    size_t triangle_count;
    uint32_t *corner; /* 3 points each; NULL: none */
} cm_ply;

/* Give back what was read, and make it empty. */
void cm_ply_clear(cm_ply *ply);

cm_status cm_ply_read(const char *path, cm_ply *ply, char *message);
/* The same of count bytes; name is for the message. */
cm_status cm_ply_parse(const char *name, const void *bytes, size_t count, cm_ply *ply,
                       char *message);

/* Write a file, which appears when it is complete: positions as double, normals as float. In text they are the same numbers
 * when they are read again. */
cm_status cm_ply_write(const char *path, const cm_ply *ply, bool binary, char *message);

#ifdef __cplusplus
}
#endif

#endif
