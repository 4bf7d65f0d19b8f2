/* SPDX-License-Identifier: MIT
 *
 * What mapping.c chooses from: what runs the loops of parts in a row (parts.inc), by kind, and a point alone by loops.
 */
#ifndef LIBCUBEMAP_MAPPING_PARTS_H
#define LIBCUBEMAP_MAPPING_PARTS_H

#include "libcubemap/batch/mapping_loops.h"

extern const cm_batch_f64 cm_chart_batches_f64[];
extern const cm_batch_f32 cm_chart_batches_f32[];

/* One point alone (points.inc): by the loops, and as the set has it, but with the exception flags kept. */
extern const cm_lone_f64 cm_lone_by_loops_f64;
extern const cm_lone_f32 cm_lone_by_loops_f32;
extern const cm_lone_f64 cm_lone_held_f64;
extern const cm_lone_f32 cm_lone_held_f32;

#endif
