/* SPDX-License-Identifier: MIT
 *
 * What part_loops.inc makes, over whole vectors. A point of a disc is CM_DISC_COLUMNS numbers: those of cm_disc_point,
 * and 1, or -1 for the hemisphere of the antipode. Bad points are NaN.
 */
#ifndef LIBCUBEMAP_BATCH_PART_LOOPS_H
#define LIBCUBEMAP_BATCH_PART_LOOPS_H

#include <cubemap/mapping.h>

#include <stddef.h>
#include <stdint.h>

#define CM_DISC_COLUMNS 5

#define LOOPS_REAL double
#define LOOPS_NAME(name) name##_f64
#include "part_loops_types.inc"

#define LOOPS_REAL float
#define LOOPS_NAME(name) name##_f32
#include "part_loops_types.inc"

#endif
