/* SPDX-License-Identifier: MIT
 *
 * The splitting of work: any number of elements, of threads, and any least number for a thread make
 * chunks that are all of the work, each element once, and are as threads.h says.
 */
#include <cubemap/threads.h>

#include <stdatomic.h>

#include "fuzz.h"

enum
{
    THREADS_MOST = 17,
    GRAIN = 64
};

typedef struct record
{
    atomic_size_t count;
    size_t begin[THREADS_MOST];
    size_t end[THREADS_MOST];
} record;

static void take_chunk(size_t begin, size_t end, void *user)
{
    record *chunks = user;
    size_t at = atomic_fetch_add(&chunks->count, 1);
    EXPECT(at < THREADS_MOST, "%zu chunks", at + 1);
    chunks->begin[at] = begin;
    chunks->end[at] = end;
}

/* The chunk that begins there. */
static size_t chunk_at(const record *chunks, size_t begin)
{
    for (size_t i = 0; i < chunks->count; i++)
    {
        if (chunks->begin[i] == begin)
        {
            return i;
        }
    }
    EXPECT(0, "no chunk begins at %zu", begin);
    return 0;
}

/* In a row, each to within two grains as long as the first. */
static void expect_chunks(const record *chunks, size_t n)
{
    size_t begin = 0;
    size_t first = n == 0 ? 0 : chunks->end[chunk_at(chunks, 0)];
    for (size_t i = 0; i < chunks->count; i++)
    {
        size_t at = chunk_at(chunks, begin);
        size_t length = chunks->end[at] - begin;
        EXPECT(begin % GRAIN == 0 && chunks->end[at] > begin && chunks->end[at] <= n,
               "%zu to %zu of %zu", begin, chunks->end[at], n);
        size_t apart = length < first ? first - length : length - first;
        EXPECT(apart <= 2 * GRAIN, "%zu and %zu of %zu", length, first, n);
        begin = chunks->end[at];
    }
    EXPECT(begin == n, "%zu of %zu are done", begin, n);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    supply from = {data, size};
    EXPECT(cm_threads_available() >= 1, "no thread to work");
    do
    {
        unsigned threads = take_byte(&from) % THREADS_MOST;
        size_t least = take_word(&from);
        uint64_t n;
        record chunks = {.count = 0};
        take_bytes(&from, &n, sizeof n);
        if (threads == 0 && cm_threads_available() > THREADS_MOST)
        {
            threads = THREADS_MOST;
        }
        cm_run_threads(threads, (size_t)n, least, take_chunk, &chunks);
        EXPECT(chunks.count <= 1 || chunks.count <= (size_t)n / (least < GRAIN ? GRAIN : least),
               "%zu chunks of %zu at least", (size_t)chunks.count, least);
        EXPECT(threads == 0 || chunks.count <= threads, "%zu chunks", (size_t)chunks.count);
        expect_chunks(&chunks, (size_t)n);
    } while (from.left > 0);
    return 0;
}
