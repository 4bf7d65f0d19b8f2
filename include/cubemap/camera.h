/* SPDX-License-Identifier: MIT
 *
 * Cameras: from directions to pixels and back. Of the library cubemap-scene.
 *
 *   axes        of a perspective camera: x right, y down, z forward. An omnidirectional camera's axes are its mapping's, as
 *               they are
 *   pixels      column and row of a pixel's centre are i + pixel_centre: 0 as OpenCV and TUM have it, 0.5 as pictures of
 *               this library
 *   faces       the six faces of a cube lie one under another: width N, height 6 N
 *   bad input   NaN gives NaN, and so does what a camera does not see
 *   threads     a camera is constant after its creation
 */
#ifndef CUBEMAP_CAMERA_H
#define CUBEMAP_CAMERA_H

#include <stddef.h>
#include <stdint.h>

#include <cubemap/export.h>
#include <cubemap/mapping.h>
#include <cubemap/status.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A camera, from cm_camera_create to cm_camera_destroy. */
typedef struct cm_camera cm_camera;

/* To be filled with zeros but for size and what is wanted. */
typedef struct cm_camera_options
{
    size_t size;            /* sizeof(cm_camera_options) */
    uint32_t width, height; /* pixels */
    double fx, fy, cx, cy;  /* focal lengths and principal point, in pixels */
    double
        pixel_centre; /* 0: centres at integers (OpenCV, TUM); 0.5: as in this library's images */
    double distortion[14]; /* OpenCV's order: k1 k2 p1 p2 k3 k4 k5 k6 s1 s2 s3 s4 tau_x tau_y */
    const cm_mapping
        *mapping; /* instead of all that: an omnidirectional image; the camera keeps a copy */
} cm_camera_options;

/* CM_OK; CM_ERROR_ARGUMENT (NULL, size); CM_ERROR_CAMERA (no such camera); CM_ERROR_MEMORY. */
CM_API cm_status cm_camera_create(const cm_camera_options *options, cm_camera **camera);
CM_API void cm_camera_destroy(cm_camera *camera);

/* What the camera was made of; its mapping is the camera's own copy. It lives as long as the camera. */
CM_API const cm_camera_options *cm_camera_describe(const cm_camera *camera);

/* Points of the camera's axes to columns and rows; NaN where the camera does not see them. */
CM_API void cm_camera_project_array(const cm_camera *camera, size_t n, const double *x,
                                    const double *y, const double *z, double *column, double *row);

/* Columns and rows to rays. A perspective camera's have z = 1, so that depth times ray is the point; an omnidirectional
 * camera's have length 1, so that range times ray is. NaN outside the picture's valid field. */
CM_API void cm_camera_ray_array(const cm_camera *camera, size_t n, const double *column,
                                const double *row, double *x, double *y, double *z);

/* Steradians of the pixel whose centre is there, as area times density at the centre; NaN outside. */
CM_API double cm_camera_solid_angle(const cm_camera *camera, double column, double row);

#ifdef __cplusplus
}
#endif

#endif
