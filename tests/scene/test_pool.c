/* SPDX-License-Identifier: MIT
 *
 * Threads that stay: each element is done once, by any number of threads, from within jobs, and by several callers.
 */
#if !defined(_GNU_SOURCE)
#define _GNU_SOURCE
#endif

#include <cubemap/pool.h>

#include <errno.h>
#include <fenv.h>
#include <stdatomic.h>

#include "tests/suite.h"

enum
{
    COUNT = 100000
};

static const unsigned thread_counts[] = {1, 2, 3, 7};
#define COUNT_OF(array) (sizeof(array) / sizeof((array)[0]))

static atomic_uint done[COUNT];
static atomic_size_t pieces, shorter, least_length;

static void note(size_t begin, size_t end, void *user)
{
    atomic_uint *counts = user;
    for (size_t i = begin; i < end; i++)
    {
        atomic_fetch_add(&counts[i], 1);
    }
    atomic_fetch_add(&pieces, 1);
    atomic_fetch_add(&shorter, end - begin < atomic_load(&least_length));
}

static void expect_once(size_t n, unsigned times)
{
    for (size_t i = 0; i < COUNT; i++)
    {
        REQUIRE(done[i] == (i < n ? times : 0), "element %zu of %zu: %u", i, n, (unsigned)done[i]);
    }
}

static cm_pool *make_pool(unsigned threads)
{
    cm_pool *pool = NULL;
    ck_assert_int_eq(cm_pool_create(threads, &pool), CM_OK);
    return pool;
}

START_TEST(every_element_is_done_once)
{
    static const size_t lengths[] = {0, 1, 2, 3, 63, 64, 1000, COUNT};
    static const size_t leasts[] = {0, 1, 2, 64, 999, SIZE_MAX};
    for (size_t t = 0; t <= COUNT_OF(thread_counts); t++)
    {
        cm_pool *pool = t == COUNT_OF(thread_counts) ? NULL : make_pool(thread_counts[t]);
        for (size_t l = 0; l < COUNT_OF(lengths); l++)
        {
            for (size_t k = 0; k < COUNT_OF(leasts); k++)
            {
                const size_t n = lengths[l];
                const size_t least = leasts[k] == 0 ? 1 : leasts[k];
                memset(done, 0, sizeof done);
                atomic_store(&pieces, 0);
                atomic_store(&shorter, 0);
                atomic_store(&least_length, least);
                cm_pool_run(pool, n, leasts[k], note, done);
                expect_once(n, 1);
                ck_assert_uint_le(pieces, n / least + 1);
                ck_assert_uint_le(shorter, 1); /* the last */
            }
        }
        cm_pool_destroy(pool);
    }
}
END_TEST

static void note_length(size_t begin, size_t end, void *user)
{
    atomic_fetch_add((atomic_size_t *)user, end - begin);
}

START_TEST(the_greatest_length)
{
    cm_pool *pool = make_pool(3);
    atomic_size_t sum = 0;
    cm_pool_run(pool, SIZE_MAX, SIZE_MAX / 100, note_length, &sum);
    ck_assert(sum == SIZE_MAX);
    cm_pool_destroy(pool);
}
END_TEST

/* Short calls one behind the other, as frames are: with threads awake, asleep, and falling asleep. */
START_TEST(many_calls)
{
    cm_pool *pool = make_pool(4);
    static atomic_uint counts[16];
    const unsigned calls = is_quick() ? 2000 : 20000;
    memset(counts, 0, sizeof counts);
    for (unsigned i = 0; i < calls; i++)
    {
        cm_pool_run(pool, 16, 1, note, counts);
        for (volatile unsigned wait = 0; i % 100 == 99 && wait < 200000; wait = wait + 1)
        {
        }
    }
    for (size_t i = 0; i < 16; i++)
    {
        ck_assert_uint_eq(counts[i], calls);
    }
    cm_pool_destroy(pool);
}
END_TEST

typedef struct nest
{
    cm_pool *pool;
    cm_pool *other;
} nest;

static void run_within(size_t begin, size_t end, void *user)
{
    const nest *in = user;
    for (size_t i = begin; i < end; i++)
    {
        cm_pool_run(in->pool, 100, 1, note, done + 100 * i);
        cm_pool_run(in->other, 100, 1, note, done + 100 * i);
    }
}

START_TEST(jobs_may_run_jobs)
{
    for (size_t t = 0; t < COUNT_OF(thread_counts); t++)
    {
        const nest in = {make_pool(thread_counts[t]), make_pool(2)};
        memset(done, 0, sizeof done);
        cm_pool_run(in.pool, COUNT / 100, 1, run_within, (void *)&in);
        expect_once(COUNT, 2);
        cm_pool_destroy(in.pool);
        cm_pool_destroy(in.other);
    }
}
END_TEST

/* What a pass leaves the next one reads: all is seen by all. */
static double values[2][COUNT];

static void smooth(size_t begin, size_t end, void *user)
{
    const int from = *(const int *)user;
    for (size_t i = begin; i < end; i++)
    {
        const size_t next = i + 1 < COUNT ? i + 1 : 0;
        values[1 - from][i] = 0.5 * (values[from][i] + values[from][next]) / 1.1;
    }
}

START_TEST(same_bits_for_any_number_of_threads)
{
    static double expected[COUNT];
    for (size_t t = 0; t < COUNT_OF(thread_counts); t++)
    {
        cm_pool *pool = make_pool(thread_counts[t]);
        for (size_t i = 0; i < COUNT; i++)
        {
            values[0][i] = sin((double)i);
        }
        for (int pass = 0; pass < 40; pass++)
        {
            int from = pass % 2;
            cm_pool_run(pool, COUNT, 1, smooth, &from);
        }
        if (t == 0)
        {
            memcpy(expected, values[0], sizeof expected);
        }
        ck_assert(memcmp(expected, values[0], sizeof expected) == 0);
        cm_pool_destroy(pool);
    }
}
END_TEST

static void note_rounding(size_t begin, size_t end, void *user)
{
    for (size_t i = begin; i < end; i++)
    {
        ((atomic_int *)user)[i] = fegetround();
    }
}

START_TEST(rounding_is_the_callers)
{
#if defined(FE_UPWARD)
    static const int modes[] = {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD};
    static atomic_int met[1000];
    cm_pool *pool = make_pool(3);
    for (int i = 0; i < 300; i++)
    {
        ck_assert_int_eq(fesetround(modes[i % 3]), 0);
        cm_pool_run(pool, 1000, 1, note_rounding, met);
        fesetround(FE_TONEAREST);
        for (int k = 0; k < 1000; k++)
        {
            ck_assert_int_eq(met[k], modes[i % 3]);
        }
    }
    cm_pool_destroy(pool);
#endif
}
END_TEST

START_TEST(arguments)
{
    ck_assert_int_eq(cm_pool_create(2, NULL), CM_ERROR_ARGUMENT);
    ck_assert_uint_eq(cm_pool_threads(NULL), 1);
    cm_pool_destroy(NULL);
    cm_pool_run(NULL, 0, 1, note, NULL);
    cm_pool *pool = make_pool(0);
    ck_assert_uint_le(cm_pool_threads(pool), cm_threads_available());
    cm_pool_destroy(pool);
    pool = make_pool(1);
    ck_assert_uint_eq(cm_pool_threads(pool), 1);
    cm_pool_destroy(pool);
}
END_TEST

#if defined(HAVE_THREADS)
#include <pthread.h>
#include <sched.h>
#include <signal.h>

static int is_blocked(int signal)
{
    sigset_t blocked;
    pthread_sigmask(SIG_SETMASK, NULL, &blocked);
    return sigismember(&blocked, signal);
}

#if defined(WRAPS_THREADS)
int __real_pthread_create(pthread_t *thread, const pthread_attr_t *attributes,
                          void *(*start)(void *), void *argument);
int __wrap_pthread_create(pthread_t *thread, const pthread_attr_t *attributes,
                          void *(*start)(void *), void *argument);

/* Only the thread that runs the tests reads and writes them while they matter. */
static unsigned asked, allowed = UINT32_MAX, unblocked;

int __wrap_pthread_create(pthread_t *thread, const pthread_attr_t *attributes,
                          void *(*start)(void *), void *argument)
{
    unblocked += !is_blocked(SIGINT) || !is_blocked(SIGPROF) || is_blocked(SIGSEGV);
    return asked++ >= allowed ? EAGAIN : __real_pthread_create(thread, attributes, start, argument);
}

START_TEST(refused_threads_lose_nothing)
{
    for (allowed = 0; allowed < 4; allowed++)
    {
        asked = 0;
        unblocked = 0;
        cm_pool *pool = make_pool(4);
        ck_assert_uint_eq(cm_pool_threads(pool), 1 + (allowed < 3 ? allowed : 3));
        ck_assert_uint_eq(unblocked, 0);
        ck_assert(!is_blocked(SIGINT) && !is_blocked(SIGPROF));
        memset(done, 0, sizeof done);
        cm_pool_run(pool, COUNT, 1, note, done);
        expect_once(COUNT, 1);
        cm_pool_destroy(pool);
    }
    allowed = UINT32_MAX;
    asked = 0;
    cm_pool_destroy(make_pool(1));
    ck_assert_uint_eq(asked, 0);
    cm_pool_destroy(make_pool(100000));
    ck_assert_uint_eq(asked, CM_THREADS_MAX - 1);
}
END_TEST

#endif

typedef struct caller
{
    cm_pool *pool;
    atomic_uint counts[500];
} caller;

static void *call_often(void *argument)
{
    caller *mine = argument;
    for (int i = 0; i < 500; i++)
    {
        cm_pool_run(mine->pool, 500, 1 + (size_t)i % 7, note, mine->counts);
    }
    return NULL;
}

START_TEST(several_callers)
{
    static caller callers[5];
    pthread_t threads[5];
    cm_pool *pool = make_pool(3);
    for (int i = 0; i < 5; i++)
    {
        callers[i].pool = pool;
        ck_assert_int_eq(pthread_create(&threads[i], NULL, call_often, &callers[i]), 0);
    }
    for (int i = 0; i < 5; i++)
    {
        pthread_join(threads[i], NULL);
        for (int k = 0; k < 500; k++)
        {
            ck_assert_uint_eq(callers[i].counts[k], 500);
        }
    }
    cm_pool_destroy(pool);
}
END_TEST

/* Threads that can all be at work at once: each waits until all are there. */
typedef struct meeting
{
    atomic_uint here;
    unsigned all;
    atomic_int blocked;
} meeting;

static void meet(size_t begin, size_t end, void *user)
{
    meeting *m = user;
    (void)begin;
    (void)end;
    atomic_fetch_add(&m->blocked, is_blocked(SIGINT));
    atomic_fetch_add(&m->here, 1);
    while (atomic_load(&m->here) < m->all)
    {
        sched_yield();
    }
}

START_TEST(all_threads_come)
{
    cm_pool *pool = make_pool(5);
    for (int i = 0; i < 50; i++)
    {
        meeting m = {.all = 5};
        cm_pool_run(pool, 5, 1, meet, &m);
        ck_assert_uint_eq(m.here, 5);
        ck_assert_int_eq(m.blocked, 4);
    }
    cm_pool_destroy(pool);
}
END_TEST

static int finished;

static void *run_cancelled(void *pool)
{
    pthread_cancel(pthread_self());
    memset(done, 0, sizeof done);
    cm_pool_run(pool, COUNT, 1, note, done);
    finished = 1;
    pthread_testcancel();
    finished = 2;
    return NULL;
}

START_TEST(cancellation_waits)
{
    pthread_t thread;
    cm_pool *pool = make_pool(3);
    finished = 0;
    ck_assert_int_eq(pthread_create(&thread, NULL, run_cancelled, pool), 0);
    pthread_join(thread, NULL);
    ck_assert_int_eq(finished, 1);
    expect_once(COUNT, 1);
    cm_pool_destroy(pool);
}
END_TEST
#endif

int main(void)
{
    const TTest *const tests[] = {
        every_element_is_done_once,
        the_greatest_length,
        many_calls,
        jobs_may_run_jobs,
        same_bits_for_any_number_of_threads,
        rounding_is_the_callers,
        arguments,
#if defined(WRAPS_THREADS)
        refused_threads_lose_nothing,
#endif
#if defined(HAVE_THREADS)
        several_callers,
        all_threads_come,
        cancellation_waits,
#endif
        NULL
    };
    return run_suite("pool", tests);
}
