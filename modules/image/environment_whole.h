/* SPDX-License-Identifier: MIT
 *
 * Means over all texels of an environment.
 */
#ifndef MODULES_IMAGE_ENVIRONMENT_WHOLE_H
#define MODULES_IMAGE_ENVIRONMENT_WHOLE_H

#include <cubemap/environment.h>

/* Over a level. The lobe of GGX with that alpha^2, > CM_LOBE_MIRROR; or, if it is negative, the cosine, whose mean is
 * multiplied by pi. Each texel counts as subdivision x subdivision ones. CM_OK or CM_ERROR_MEMORY. */
cm_status cm_environment_whole(const cm_environment *environment, double alpha_squared,
                               uint32_t level, uint32_t subdivision, const cm_mapping *mapping,
                               unsigned threads, const cm_image to[6]);

#endif
