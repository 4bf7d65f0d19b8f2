/* SPDX-License-Identifier: MIT
 *
 * Footprints beside the poles of a source in longitude and latitude, where no ellipse in its columns and rows stands for
 * what lies around a pole. There the ellipse is one of the plane whose polar coordinates are rows from the pole and
 * longitude, and pixels of the level weigh as the kernel has it at their places on that plane, times their areas.
 *   rings          rows are the nodes of a quadrature, whose first weights are those for |r| beside r = 0: J. N. Lyness,
 *                  B. W. Ninham, Numerical quadrature and asymptotic expansions, Mathematics of Computation 21, 1967
 *   around a pole  the kernel is hardly wider than a row, and rings are half a row apart, interpolated by spline36
 *   columns        of more pixels than the plan allows every second one is taken, or third, as far as there are two in
 *                  the length of a row
 */
#ifndef MODULES_IMAGE_EWA_POLE_H
#define MODULES_IMAGE_EWA_POLE_H

#include "ewa_object.h"

/* Where caps end, for the levels that are there. */
void cm_ewa_caps(const cm_surface *surface, cm_ewa *ewa);

/* Takes the pixels of a group that lie beside a pole, of axes whose level is `coarsest` at most: their values come to be in
 * `to`, and their level is CM_EWA_DONE. *count is how many there are. CM_OK or CM_ERROR_MEMORY. */
#define CM_EWA_DONE (-1)
cm_status cm_ewa_poles(const cm_ewa *ewa, const cm_group *group, int32_t coarsest,
                       cm_scratch *scratch, cm_ewa_axes *axes, unsigned *count, float *to);

#endif
