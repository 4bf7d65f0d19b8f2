/* SPDX-License-Identifier: MIT
 *
 * Lights made ready.
 */
#ifndef CUBEMAP_SIM_LAMP_H
#define CUBEMAP_SIM_LAMP_H

#include "tof_object.h"

/* CM_OK; CM_ERROR_ARGUMENT (NULL, none, size); CM_ERROR_RANGE. */
cm_status lamps_check(const cm_tof_light *light, size_t lights);

/* For a camera that stands there; tables are of lamps_tables. */
void lamps_place(const cm_tof_light *light, size_t lights, double *const *table,
                 const cm_pose *camera, tof_lamp *lamp);

/* Tables in W/sr, one a light; NULL for even ones. NULL: no memory. To be freed by lamps_free_tables. */
double **lamps_tables(const cm_tof_light *light, size_t lights);
void lamps_free_tables(double **table, size_t lights);

/* Does it throw shadows that the camera can see? At the camera's own place it sees what the camera sees. */
int lamp_is_beside(const tof_lamp *lamp, const double camera[3]);

#endif
