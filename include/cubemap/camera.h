/* SPDX-License-Identifier: MIT
 *
 * Cameras: from directions to pixels and back. Of the library cubemap-scene.
 *
 *   axes        of a perspective camera: x right, y down, z forward. An omnidirectional camera's axes are its mapping's, as
 *               they are
 *   pixels      column and row of a pixel's centre are i + pixel_centre: 0 as OpenCV and TUM have it, 0.5 as pictures of
 *               this library
 *   faces       the six faces of a cube lie one under another: width N, height 6 N. What falls on a face's last edge is told to be
 *               just before it, by 2^-48 of the face, since the next face begins there
 *   distortion  OpenCV's model in full; its inverse is solved, not approximated
 *   valid field the rays up to the first fold: in each direction from the axis on, as long as the determinant of the
 *               distortion's Jacobian is positive (and its denominator, and the scale of a tilted sensor). What is beyond
 *               has no pixel, whatever the formula says of it; a pixel that nothing inside comes to has no ray
 *   picture     ends nothing: a perspective camera gives columns and rows beyond its picture, and takes them, as far as
 *               the valid field goes. A mapping has nothing outside its faces
 *   bad input   NaN gives NaN, and so does what is behind a perspective camera
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

/* To be filled with zeros but for size and what is wanted. With a mapping fx, fy, cx, cy and distortion are not read. */
typedef struct cm_camera_options
{
    size_t size; /* sizeof(cm_camera_options) */
    /* pixels, less than 2^31 of them; of a mapping N and 6 N, or N and N if it has one face */
    uint32_t width;
    uint32_t height; /* pixels from top to bottom */
    double fx;       /* focal length in pixels along rows, not 0; a negative one mirrors */
    double fy;       /* and along columns */
    double cx;       /* the principal point's column, as pixels are counted */
    double cy;       /* and its row */
    double
        pixel_centre; /* 0: centres at integers (OpenCV, TUM); 0.5: as in this library's images; up to 1 */
    double distortion[14]; /* OpenCV's order: k1 k2 p1 p2 k3 k4 k5 k6 s1 s2 s3 s4 tau_x tau_y; up to
                              1e150; the last two in radians, less than a quarter turn */
    const cm_mapping
        *mapping; /* instead of all that: an omnidirectional image; the camera keeps a copy */
} cm_camera_options;

/* Finds the valid field, too. Loops are of the instruction set that CUBEMAP_INSTRUCTIONS names, or of the best one.
 * CM_OK; CM_ERROR_ARGUMENT (NULL, size); CM_ERROR_CAMERA (no such camera: see above); CM_ERROR_MEMORY. */
CM_API cm_status cm_camera_create(const cm_camera_options *options, cm_camera **camera);

/* NULL is allowed. */
CM_API void cm_camera_destroy(cm_camera *camera);

/* What the camera was made of; its mapping is the camera's own copy. It lives as long as the camera. */
CM_API const cm_camera_options *cm_camera_describe(const cm_camera *camera);

/* n points of the camera's axes to columns and rows; NaN, NaN where the camera does not see them. Arrays here and below may
 * be NULL if n is 0; an output may be one of the inputs; the same point has the same bits, whatever n and its place. */
CM_API void cm_camera_project_array(const cm_camera *camera, size_t n, const double *x,
                                    const double *y, const double *z, double *column, double *row);

/* n columns and rows to rays. A perspective camera's have z = 1, so that depth times ray is the point; an omnidirectional
 * camera's have length 1, so that range times ray is. Three NaN where no ray of the valid field comes from. */
CM_API void cm_camera_ray_array(const cm_camera *camera, size_t n, const double *column,
                                const double *row, double *x, double *y, double *z);

/* d(column, row) / d(x, y, z) at a point of the camera's axes, 2 x 3 by rows, in closed form; NaN where it is not seen. */
CM_API void cm_camera_jacobian(const cm_camera *camera, const double point[3], double jacobian[6]);

/* Steradians of the pixel whose centre is there, as area times density at the centre; NaN outside. */
CM_API double cm_camera_solid_angle(const cm_camera *camera, double column, double row);

/* 1 if cm_camera_ray_array has a ray for that place, else 0. */
CM_API int cm_camera_has_ray(const cm_camera *camera, double column, double row);

/* How far the valid field of a perspective camera goes in one direction, from +x by the angle towards +y, in radians: the
 * tangent of the angle from the axis. INFINITY if nothing ends it up to 4e5; NaN of omnidirectional cameras. */
CM_API double cm_camera_border(const cm_camera *camera, double angle);

#ifdef __cplusplus
}
#endif

#endif
