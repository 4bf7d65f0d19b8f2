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

#define CM_LANES_BITS 64
#define CM_SCALAR_NAME(name) name##_f64
#ifdef CM_LANES
#define CM_BACKEND 5
#include <cubemap/kernel/backend.h>
#else
#define CM_BACKEND 1
#include <cubemap/kernel/dialect.h>

#include "lanes/scalar.h"
#endif
#include "batch.h"
enum
{
    BATCH_LANES_F64 = LANES
};
#include "lanes/undefine.h"
#undef CM_LANES_BITS
#undef CM_SCALAR_NAME
#undef CM_BACKEND

#define CM_LANES_BITS 32
#define CM_SCALAR_NAME(name) name##_f32
#ifdef CM_LANES
#define CM_BACKEND 5
#include <cubemap/kernel/backend.h>
#else
#define CM_BACKEND 2
#include <cubemap/kernel/dialect.h>

#include "lanes/scalar.h"
#endif
#include "batch.h"
enum
{
    BATCH_LANES_F32 = LANES
};
#include "lanes/undefine.h"

#ifdef CM_LANES
#define BATCH_TABLE(bits) batch_table_lanes_f##bits
#else
#define BATCH_TABLE(bits) batch_table_f##bits
#endif

const cm_batch_set BATCH_JOINED(cm_batch_, CM_SET) = {.name = BATCH_NAME_TEXT(CM_SET),
                                                      .lanes_f64 = BATCH_LANES_F64,
                                                      .lanes_f32 = BATCH_LANES_F32,
                                                      .f64 = BATCH_TABLE(64),
                                                      .f32 = BATCH_TABLE(32)};
