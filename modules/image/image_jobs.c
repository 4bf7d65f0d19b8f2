/* SPDX-License-Identifier: MIT */
#include "image_jobs.h"

#include <cubemap/threads.h>

/* Chunks of cm_run_threads begin at multiples of this. */
#define GRAIN 64

typedef struct pieces
{
    cm_piece piece;
    void *user;
} pieces;

static void run_chunk(size_t begin, size_t end, void *user)
{
    const pieces *p = user;
    for (size_t i = begin / GRAIN; i * GRAIN < end; i++)
    {
        p->piece(i, p->user);
    }
}

void cm_run_pieces(unsigned threads, size_t count, cm_piece piece, void *user)
{
    pieces p = {piece, user};
    cm_run_threads(threads, count * GRAIN, GRAIN, run_chunk, &p);
}
