/* SPDX-License-Identifier: MIT
 *
 * What mapping_loops.inc makes for every mapping.
 */
#ifndef LIBCUBEMAP_BATCH_MAPPING_LOOPS_H
#define LIBCUBEMAP_BATCH_MAPPING_LOOPS_H

#include <cubemap/kernels.h>
#include <cubemap/mapping.h>

#include <stddef.h>
#include <stdint.h>

#define LOOPS_REAL double
#define LOOPS_NAME(name) name##_f64
#include "mapping_loops_types.inc"

#define LOOPS_REAL float
#define LOOPS_NAME(name) name##_f32
#include "mapping_loops_types.inc"

#endif
