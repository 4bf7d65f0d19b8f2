/* SPDX-License-Identifier: MIT
 *
 * The samples of a lobe around z: D(h) n l, with s = sin^2(theta / 2) of the angle from z proportional to
 * (1 - 2 s) / (alpha^2 (1 - s) + s)^2, where s <= 1/2.
 */
#ifndef MODULES_IMAGE_ENVIRONMENT_LOBE_H
#define MODULES_IMAGE_ENVIRONMENT_LOBE_H

#include <cubemap/environment.h>

/* Of an alpha^2 as small as that the lobe is a mirror's: below the rounding of directions many times over. */
#define CM_LOBE_MIRROR 1e-60

/* Samples of a lobe, in separate arrays. */
typedef struct cm_lobe
{
    size_t count;
    float *x;
    float *y;
    float *z;
    float *weight; /* their sum is 1 */
    float *
        edge; /* log2 of the edge, in radians, of the square that a sample stands for, blur added */
    float *memory; /* of all these; to be freed */
} cm_lobe;

/* alpha_squared > CM_LOBE_MIRROR, samples and blur as in cm_prefilter_options, with the method's own blur added.
 * CM_OK or CM_ERROR_MEMORY. */
cm_status cm_lobe_make(cm_prefilter_method method, double alpha_squared, uint32_t samples,
                       double blur, cm_lobe *lobe);

#endif
