/* SPDX-License-Identifier: MIT
 *
 * A camera: a lens with its field, or a mapping.
 */
#ifndef MODULES_SCENE_CAMERA_OBJECT_H
#define MODULES_SCENE_CAMERA_OBJECT_H

#include <cubemap/camera.h>

#include "camera_image.h"
#include "camera_net.h"

#include <stdatomic.h>

struct cm_camera
{
    cm_camera_options options; /* mapping is the camera's own */
    cm_lens lens;
    cm_camera_field field;
    cm_camera_image image;
    const cm_camera_set *set;
    _Atomic(cm_camera_net *)
        net; /* from the first pixel on that needed it; NULL before, or without memory */
    /* Of an omnidirectional camera: faces, half a face's width, the value of v in a face's first row, and what a column
     * has to be moved by to count from the picture's edge. */
    unsigned faces;
    double half;
    double first_v;
    double shift;
};

/* Those of an omnidirectional camera: camera_faces.c. */
cm_status cm_camera_take_mapping(cm_camera *camera, const cm_mapping *mapping);
void cm_camera_project_faces(const cm_camera *camera, size_t n, const double *x, const double *y,
                             const double *z, double *column, double *row);
void cm_camera_ray_faces(const cm_camera *camera, size_t n, const double *column, const double *row,
                         double *x, double *y, double *z);
double cm_camera_angle_faces(const cm_camera *camera, double column, double row);
void cm_camera_jacobian_faces(const cm_camera *camera, const double point[3], double jacobian[6]);

/* The lens of options that are good: camera_model.c. CM_ERROR_CAMERA if they are not. */
cm_status cm_camera_make_lens(const cm_camera_options *options, cm_lens *lens);

#endif
