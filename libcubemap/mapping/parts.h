/* SPDX-License-Identifier: MIT
 *
 * Mappings that are made of parts: what runs the loops of parts in a row (parts.inc), by kind.
 */
#ifndef LIBCUBEMAP_MAPPING_PARTS_H
#define LIBCUBEMAP_MAPPING_PARTS_H

#include "libcubemap/batch/mapping_loops.h"

extern const cm_batch_f64 cm_chart_batches_f64[];
extern const cm_batch_f32 cm_chart_batches_f32[];

#endif
