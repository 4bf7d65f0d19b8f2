/* SPDX-License-Identifier: MIT
 *
 * All loops for one instruction set. Its file defines CM_SET, the set's name, and CM_LANES, the file
 * of lanes/ with its words; or no CM_LANES for one point at a time.
 */
#include "internal.h"

#include <string.h>

#define BATCH_TEXT(x) #x
#define BATCH_NAME_TEXT(x) BATCH_TEXT(x)
#define BATCH_JOIN(a, b) a##b
#define BATCH_JOINED(a, b) BATCH_JOIN(a, b)

/* ---- Double ---- */

#define CM_LANES_BITS 64
#define CM_SCALAR_NAME(name) name##_f64
#define LANES_IO double
#define BATCH_NAME(name) name##_in_f64
#define BATCH_VARIANTS cm_batch_variants_f64
#include "batch_precision.h"
#include "lanes/undefine.h"

/* ---- Float ---- */

#define CM_LANES_BITS 32
#define CM_SCALAR_NAME(name) name##_f32
#define LANES_IO float
#define BATCH_NAME(name) name##_in_f32
#define BATCH_VARIANTS cm_batch_variants_f32
#include "batch_precision.h"

/* ---- The fast tier: arrays of double, computed in float. One point at a time gains nothing ---- */

#ifdef CM_LANES
#define BATCH_MAPS_ONLY
#define LANES_IO double
#define lanes_read(p) lanes_load_narrowed(p)
#define lanes_write(p, x) lanes_store_widened(p, x)
#define BATCH_NAME(name) name##_fast
#define BATCH_VARIANTS cm_batch_variants_f64
#include "batch.h"
#define BATCH_FAST batch_table_fast
#else
#define BATCH_FAST NULL
#endif
#include "lanes/undefine.h"

#include "orient_loops.h"

const cm_batch_set BATCH_JOINED(cm_batch_, CM_SET) = {.name = BATCH_NAME_TEXT(CM_SET),
                                                      .lanes_f64 = lanes_in_f64,
                                                      .lanes_f32 = lanes_in_f32,
                                                      .rest_f64 = rest_in_f64,
                                                      .rest_f32 = rest_in_f32,
                                                      .indicatrices_f64 = indicatrices_in_f64,
                                                      .indicatrices_f32 = indicatrices_in_f32,
                                                      .f64 = batch_table_in_f64,
                                                      .f32 = batch_table_in_f32,
                                                      .fast = BATCH_FAST,
                                                      .charts_f64 = &chart_loops_in_f64,
                                                      .charts_f32 = &chart_loops_in_f32,
                                                      .lonlat = &lonlat_loops_in_f64,
                                                      .latitudes = &latitude_loops,
                                                      .healpix = &healpix_loops,
                                                      .cells = &cell_loops,
                                                      .orient_sum = orient_sum};
