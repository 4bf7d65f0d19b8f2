/* SPDX-License-Identifier: MIT
 *
 * The loops of one instruction set whose arrays hold what they compute in. Read by batch_set.h, which
 * has defined CM_LANES_BITS, CM_SCALAR_NAME, LANES_IO, BATCH_NAME and BATCH_VARIANTS; the words of lanes/
 * stay defined.
 */
#ifdef CM_LANES
#define CM_BACKEND 5
#include <cubemap/kernel/backend.h>
#else
#if CM_LANES_BITS == 64
#define CM_BACKEND 1
#else
#define CM_BACKEND 2
#endif
#include <cubemap/kernel/dialect.h>

#include "lanes/scalar.h"
#endif

enum
{
    BATCH_NAME(lanes) = LANES
};

static void BATCH_NAME(rest)(LANES_IO *to, const LANES_IO *from, size_t n)
{
    lanes_store(to, n == 1 ? lanes_all(*from) : lanes_some(from, n));
}

#define lanes_read(p) lanes_load(p)
#define lanes_write(p, x) lanes_store(p, x)
#include "batch.h"
