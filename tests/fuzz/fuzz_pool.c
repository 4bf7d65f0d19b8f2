/* SPDX-License-Identifier: MIT
 *
 * Threads that stay: any number of elements, any least number for a piece, from within jobs too: each element is done once.
 */
#include <cubemap/pool.h>

#include <stdatomic.h>

#include "fuzz.h"

enum
{
    POOLS = 4,
    MOST = 512
};

typedef struct record
{
    cm_pool *pool;
    size_t within; /* elements of the work that each element has within itself */
    atomic_size_t pieces;
    atomic_size_t sum;
    atomic_uint done[MOST];
} record;

static void count_within(size_t begin, size_t end, void *user)
{
    atomic_fetch_add((atomic_size_t *)user, end - begin);
}

static void note_piece(size_t begin, size_t end, void *user)
{
    record *r = user;
    atomic_fetch_add(&r->pieces, 1);
    for (size_t i = begin; i < end; i++)
    {
        atomic_fetch_add(&r->done[i % MOST], 1);
        cm_pool_run(r->pool, r->within, 1, count_within, &r->sum);
    }
}

static void check_run(record *r, size_t n, size_t least)
{
    r->pieces = 0;
    r->sum = 0;
    for (size_t i = 0; i < MOST; i++)
    {
        r->done[i] = 0;
    }
    cm_pool_run(r->pool, n, least, note_piece, r);
    EXPECT(r->pieces <= n / (least == 0 ? 1 : least) + 1, "%zu pieces", (size_t)r->pieces);
    EXPECT(r->sum == n * r->within, "%zu of %zu within", (size_t)r->sum, n * r->within);
    for (size_t i = 0; i < MOST; i++)
    {
        EXPECT(r->done[i] == (i < n ? 1 : 0), "element %zu of %zu: %u", i, n, (unsigned)r->done[i]);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static cm_pool *pools[POOLS]; /* of 0 to 3 threads, the first none */
    static record r;
    supply from = {data, size};
    for (unsigned i = 1; i < POOLS && pools[i] == NULL; i++)
    {
        EXPECT(cm_pool_create(i, &pools[i]) == CM_OK, "no pool");
    }
    EXPECT(cm_pool_create(2, NULL) == CM_ERROR_ARGUMENT, "no place for a pool");
    for (int turn = 0; turn < 16 && from.left > 0; turn++)
    {
        const uint8_t kind = take_byte(&from);
        r.pool = pools[kind % POOLS];
        EXPECT(cm_pool_threads(r.pool) <= POOLS, "%u threads", cm_pool_threads(r.pool));
        r.within = kind / POOLS % 3;
        const size_t n = (take_byte(&from) * 256u + take_byte(&from)) % (MOST + 1);
        const size_t least = kind >= 192 ? SIZE_MAX - take_byte(&from) : take_byte(&from);
        check_run(&r, n, least);
        if (kind == 255) /* made anew, which is slow */
        {
            cm_pool_destroy(pools[1]);
            pools[1] = NULL;
            EXPECT(cm_pool_create(1, &pools[1]) == CM_OK, "no pool");
        }
    }
    return 0;
}
