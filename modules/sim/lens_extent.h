/* SPDX-License-Identifier: MIT
 *
 * What of the plane z = 1 a lens sees: the rays of all its pixels.
 */
#ifndef MODULES_SIM_LENS_EXTENT_H
#define MODULES_SIM_LENS_EXTENT_H

#include <cubemap/camera.h>
#include <cubemap/status.h>

typedef struct cm_lens_extent
{
    double least[2]; /* of x and y of rays through centres of pixels */
    double greatest[2];
    double outer_least[2]; /* and of those through their corners, too */
    double outer_greatest[2];
    double step; /* the least distance of neighbours' rays, in focal lengths by pixels */
} cm_lens_extent;

/* CM_OK; CM_ERROR_ARGUMENT (no camera); CM_ERROR_UNSUPPORTED (omnidirectional). */
cm_status cm_lens_check(const cm_camera *camera);

/* CM_OK; CM_ERROR_RANGE (no pixel has a ray); CM_ERROR_MEMORY. */
cm_status cm_lens_find_extent(const cm_camera *camera, cm_lens_extent *extent);

#endif
