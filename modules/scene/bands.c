/* SPDX-License-Identifier: MIT */
#include "bands.h"

#include <cubemap/threads.h>

/* Chunks of cm_run_threads begin at multiples of this. */
#define GRAIN 64

typedef struct all_bands
{
    size_t bands;
    size_t rows;
    size_t group;
    cm_band band;
    void *user;
} all_bands;

static size_t groups_of(size_t rows, size_t group)
{
    return rows / group + (rows % group != 0);
}

size_t cm_band_count(const cm_pool *pool, unsigned threads, size_t rows, size_t group)
{
    const size_t groups = groups_of(rows, group);
    const unsigned all = pool == NULL ? cm_threads_available() : cm_pool_threads(pool);
    size_t most = threads == 0 ? all : threads;
    most = most > CM_THREADS_MAX ? CM_THREADS_MAX : most;
    return groups == 0 ? 1 : most < groups ? most : groups;
}

static size_t first_of(const all_bands *all, size_t band)
{
    const size_t row = groups_of(all->rows, all->group) * band / all->bands * all->group;
    return row < all->rows ? row : all->rows;
}

static void run_some(size_t begin, size_t end, void *user)
{
    const all_bands *all = user;
    for (size_t i = begin; i < end; i++)
    {
        all->band(first_of(all, i), first_of(all, i + 1), i, all->user);
    }
}

static void run_chunk(size_t begin, size_t end, void *user)
{
    run_some(begin / GRAIN, (end + GRAIN - 1) / GRAIN, user);
}

void cm_run_bands(cm_pool *pool, size_t bands, size_t rows, size_t group, cm_band band, void *user)
{
    all_bands all = {bands, rows, group, band, user};
    if (pool != NULL)
    {
        cm_pool_run(pool, bands, 1, run_some, &all);
        return;
    }
    cm_run_threads((unsigned)bands, bands * GRAIN, GRAIN, run_chunk, &all);
}
