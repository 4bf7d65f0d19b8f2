/* SPDX-License-Identifier: MIT
 *
 * Means over the lobe of GGX from texels of all levels: the further from the lobe's middle, the coarser they are. The
 * lobe changes over a distance of sqrt(alpha^2 + s) there, s = sin^2(theta / 2), so that a few hundred texels are
 * enough for a wide lobe and a few thousand for a narrow one.
 */
#ifndef MODULES_IMAGE_ENVIRONMENT_CELLS_H
#define MODULES_IMAGE_ENVIRONMENT_CELLS_H

#include <cubemap/environment.h>

/* What is taken if coarseness is 0. */
#define CM_CELLS_COARSENESS 0.15

/* Are the finest texels small enough for that lobe? */
int cm_cells_suffice(const cm_environment *environment, double alpha_squared, double coarseness);

/* alpha_squared > CM_LOBE_MIRROR; coarseness: the edge of texels over the distance above, > 0.
 * CM_OK or CM_ERROR_MEMORY. */
cm_status cm_environment_cells(const cm_environment *environment, double alpha_squared,
                               double coarseness, const cm_mapping *mapping, unsigned threads,
                               const cm_image to[6]);

#endif
