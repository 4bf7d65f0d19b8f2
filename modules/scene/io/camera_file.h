/* SPDX-License-Identifier: MIT
 *
 * CAMERA.json: a camera, and how many units of stored depth are a metre.
 *
 *   {"width":640,"height":480,"fx":525,"fy":525,"cx":319.5,"cy":239.5,"pixel_centre":0,"distortion":[14 numbers],
 *    "depth_scale":5000}, or {"mapping":"coupled","frame":"geo","size":256,"depth_scale":5000}
 *
 *   fx, fy      not 0; a negative one mirrors, as ICL-NUIM's fy of -480 does
 *   left out    distortion: zeros; pixel_centre: 0; depth_scale: 5000; frame: geo
 *   message     one line of CM_IMAGE_MESSAGE bytes at most, "FILE:LINE: what is wrong". Written on failure only
 *   failures    CM_ERROR_ARGUMENT, CM_ERROR_MEMORY, CM_ERROR_FILE, CM_ERROR_DATA (no such JSON), CM_ERROR_CAMERA (no such
 *               camera)
 */
#ifndef CUBEMAP_MODULES_SCENE_CAMERA_FILE_H
#define CUBEMAP_MODULES_SCENE_CAMERA_FILE_H

#include <cubemap/camera.h>

#include "modules/image/io/image_io.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The names of members that such an object may have; NULL behind the last. */
extern const char *const cm_camera_file_members[];

/* The camera of a file, for cm_camera_destroy. */
cm_status cm_camera_file_read(const char *path, cm_camera **camera, double *depth_scale,
                              char *message);

/* The same of a text of length bytes; name is for the message. */
cm_status cm_camera_file_parse(const char *name, const char *text, size_t length,
                               cm_camera **camera, double *depth_scale, char *message);

/* The text of such a file, ended by a newline and a zero byte, for free(). Read again it is the same camera, to the bit. */
cm_status cm_camera_file_format(const cm_camera *camera, double depth_scale, char **text,
                                char *message);

/* Write the file, which appears when it is complete. */
cm_status cm_camera_file_write(const char *path, const cm_camera *camera, double depth_scale,
                               char *message);

#ifdef __cplusplus
}
#endif

#endif
