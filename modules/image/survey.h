/* SPDX-License-Identifier: MIT
 *
 * Blocks of a plan's target that stand for all of it.
 */
#ifndef MODULES_IMAGE_SURVEY_H
#define MODULES_IMAGE_SURVEY_H

#include "geometry.h"

/* What is done with each group of pixels; anything but CM_OK ends the survey. */
typedef cm_status cm_survey_visitor(void *user, const cm_group *group);

/* Visits about so many blocks, spread over all planes, four of each at least, with derivatives. CM_OK, CM_ERROR_MEMORY, or
 * what the visitor returned. */
cm_status cm_survey(const cm_plan *plan, uint32_t blocks, cm_survey_visitor *visit, void *user);

#endif
