/* SPDX-License-Identifier: MIT
 *
 * How far distances are off because scattered light is sampled, and how many paths or virtual lights make that little.
 */
#ifndef CUBEMAP_SIM_SAMPLING_SPREAD_H
#define CUBEMAP_SIM_SAMPLING_SPREAD_H

#include "planned_frame.h"

#include <cubemap/budget.h>

/* For the bounces of *chosen: paths, lights and traces of it are set, and contribution, cost and reason of *entry. Numbers that
 * are given are not exceeded. A limit of 0 is one that no number meets. */
cm_status sampling_choose(const planning *with, const cm_tof_sensor *sensor,
                          const cm_tof_options *given, double limit, cm_tof_options *chosen,
                          cm_budget_entry *entry);

#endif
