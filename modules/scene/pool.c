/* SPDX-License-Identifier: MIT
 *
 * Threads that stay. CM_HAVE_PTHREADS says that the platform has POSIX threads; without it everything runs in the calling
 * thread.
 *
 * One word holds whether work is open, how many threads are at it, and its number. A thread that is free joins while it is
 * open; the caller takes pieces, too, closes it when there are none left, and waits for those that have joined. So nobody
 * waits for a thread that has not woken yet. Whoever sleeps says so first and looks again then, and whoever has news writes
 * them first and looks for sleepers then: with sequential consistency one of the two sees the other (Dekker).
 */
#if defined(CM_HAVE_PTHREADS)
#if !defined(_GNU_SOURCE)
#define _GNU_SOURCE /* for all of POSIX in spite of -std=c11 */
#endif
#include <pthread.h>
#include <signal.h>
#include <time.h>
#endif

#include <cubemap/pool.h>

#include <stdlib.h>

#if defined(CM_HAVE_PTHREADS)

#include <fenv.h>
#include <stdatomic.h>

/* The word: the lowest bits count the threads at work, one bit is set while work is open, the others number it. */
#define COUNT_MASK ((uint64_t)0xffff)
#define OPEN ((uint64_t)0x10000)
#define NUMBER_ONE ((uint64_t)0x20000)
#define NUMBER_OF(word) ((word) / NUMBER_ONE)

#define SPIN_NANOSECONDS 100000
#define LOOKS_A_TIME 64 /* between two looks at the clock */
#define CACHE_LINE 64

struct cm_pool
{
    unsigned threads; /* that work, the caller among them */
    unsigned parts;   /* that the first piece is one of: twice the threads */
    int spins;
    size_t n;
    size_t least;
    cm_job job;
    void *user;
    fenv_t environment;
    char before_word[CACHE_LINE];
    atomic_uint_least64_t word;
    atomic_int stops;
    atomic_int is_busy; /* a call has the threads */
    char before_next[CACHE_LINE];
    atomic_size_t next; /* the first element that nobody has taken */
    char before_sleepers[CACHE_LINE];
    atomic_uint sleepers;
    atomic_int caller_sleeps;
    pthread_mutex_t mutex;
    pthread_cond_t news;
    pthread_cond_t done;
    pthread_t thread[CM_THREADS_MAX - 1];
};

/* ---- Waiting ---- */

static void relax(void)
{
#if defined(__x86_64__) || defined(__i386__)
    __builtin_ia32_pause();
#elif defined(__aarch64__)
    __asm__ volatile("yield");
#endif
}

static int64_t nanoseconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
}

/* Is there work that this thread has not looked at, or the end? */
static int has_news(cm_pool *pool, uint64_t seen)
{
    const uint64_t word = atomic_load(&pool->word);
    return ((word & OPEN) != 0 && NUMBER_OF(word) != seen) || atomic_load(&pool->stops);
}

static int is_left(cm_pool *pool, uint64_t unused)
{
    (void)unused;
    return (atomic_load(&pool->word) & COUNT_MASK) == 0;
}

/* Look for a while: 1 as soon as it is so. */
static int spin(cm_pool *pool, int (*is_so)(cm_pool *, uint64_t), uint64_t seen)
{
    const int64_t end = pool->spins ? nanoseconds() + SPIN_NANOSECONDS : 0;
    do
    {
        for (int i = 0; i < LOOKS_A_TIME; i++)
        {
            if (is_so(pool, seen))
            {
                return 1;
            }
            relax();
        }
    } while (pool->spins && nanoseconds() < end);
    return 0;
}

static void wait_for_news(cm_pool *pool, uint64_t seen)
{
    if (spin(pool, has_news, seen))
    {
        return;
    }
    pthread_mutex_lock(&pool->mutex);
    atomic_fetch_add(&pool->sleepers, 1);
    while (!has_news(pool, seen))
    {
        pthread_cond_wait(&pool->news, &pool->mutex);
    }
    atomic_fetch_sub(&pool->sleepers, 1);
    pthread_mutex_unlock(&pool->mutex);
}

static void wait_for_workers(cm_pool *pool)
{
    if (spin(pool, is_left, 0))
    {
        return;
    }
    pthread_mutex_lock(&pool->mutex);
    atomic_store(&pool->caller_sleeps, 1);
    while (!is_left(pool, 0))
    {
        pthread_cond_wait(&pool->done, &pool->mutex);
    }
    atomic_store(&pool->caller_sleeps, 0);
    pthread_mutex_unlock(&pool->mutex);
}

/* ---- Work ---- */

/* Pieces become shorter as less is left, so that all end together and few are taken (guided self-scheduling,
 * Polychronopoulos and Kuck 1987). */
static int take_piece(cm_pool *pool, size_t *begin, size_t *end)
{
    size_t from = atomic_load_explicit(&pool->next, memory_order_relaxed);
    size_t length;
    do
    {
        const size_t left = pool->n - from;
        if (left == 0)
        {
            return 0;
        }
        length = left / pool->parts;
        length = length < pool->least ? pool->least : length;
        length = length > left ? left : length;
    } while (!atomic_compare_exchange_weak_explicit(&pool->next, &from, from + length,
                                                    memory_order_relaxed, memory_order_relaxed));
    *begin = from;
    *end = from + length;
    return 1;
}

static void do_pieces(cm_pool *pool)
{
    size_t begin;
    size_t end;
    while (take_piece(pool, &begin, &end))
    {
        pool->job(begin, end, pool->user);
    }
}

/* Join what is open; its number is seen then. 0 if there is nothing to join. */
static int join_work(cm_pool *pool, uint64_t *seen)
{
    uint64_t word = atomic_load(&pool->word);
    while ((word & OPEN) != 0 && NUMBER_OF(word) != *seen)
    {
        if (atomic_compare_exchange_weak(&pool->word, &word, word + 1))
        {
            *seen = NUMBER_OF(word);
            return 1;
        }
    }
    return 0;
}

static void leave_work(cm_pool *pool)
{
    const uint64_t before = atomic_fetch_sub(&pool->word, 1);
    if ((before & OPEN) == 0 && (before & COUNT_MASK) == 1 && atomic_load(&pool->caller_sleeps))
    {
        pthread_mutex_lock(&pool->mutex);
        pthread_cond_signal(&pool->done);
        pthread_mutex_unlock(&pool->mutex);
    }
}

static void *work(void *argument)
{
    cm_pool *pool = argument;
    uint64_t seen = 0;
    while (!atomic_load(&pool->stops))
    {
        if (join_work(pool, &seen))
        {
            fesetenv(&pool->environment);
            do_pieces(pool);
            leave_work(pool);
        }
        wait_for_news(pool, seen);
    }
    return NULL;
}

/* ---- Making and ending ---- */

/* Signals are blocked in the threads: handlers belong to the program's. Not those that the thread's own work brings
 * about, as when a program supplies the pages of an array when they are touched. */
static void start_threads(cm_pool *pool, unsigned wanted)
{
    static const int own[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGTRAP, SIGSYS};
    sigset_t all;
    sigset_t before;
    sigfillset(&all);
    for (size_t i = 0; i < sizeof own / sizeof own[0]; i++)
    {
        sigdelset(&all, own[i]);
    }
    pthread_sigmask(SIG_SETMASK, &all, &before);
    unsigned started = 0;
    while (started + 1 < wanted && pthread_create(&pool->thread[started], NULL, work, pool) == 0)
    {
        started++;
    }
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    pool->threads = started + 1;
    pool->parts = 2 * pool->threads;
}

static int make_locks(cm_pool *pool)
{
    if (pthread_mutex_init(&pool->mutex, NULL) != 0)
    {
        return 0;
    }
    if (pthread_cond_init(&pool->news, NULL) == 0)
    {
        if (pthread_cond_init(&pool->done, NULL) == 0)
        {
            return 1;
        }
        pthread_cond_destroy(&pool->news);
    }
    pthread_mutex_destroy(&pool->mutex);
    return 0;
}

cm_status cm_pool_create(unsigned threads, cm_pool **pool)
{
    if (pool == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    const unsigned available = cm_threads_available();
    unsigned wanted = threads == 0 ? available : threads;
    wanted = wanted > CM_THREADS_MAX ? CM_THREADS_MAX : wanted;
    cm_pool *made = calloc(1, sizeof *made);
    if (made == NULL || !make_locks(made))
    {
        free(made);
        return CM_ERROR_MEMORY;
    }
    made->spins = wanted <= available;
    start_threads(made, wanted);
    *pool = made;
    return CM_OK;
}

void cm_pool_destroy(cm_pool *pool)
{
    if (pool == NULL)
    {
        return;
    }
    pthread_mutex_lock(&pool->mutex);
    atomic_store(&pool->stops, 1);
    pthread_cond_broadcast(&pool->news);
    pthread_mutex_unlock(&pool->mutex);
    for (unsigned i = 0; i + 1 < pool->threads; i++)
    {
        pthread_join(pool->thread[i], NULL);
    }
    pthread_cond_destroy(&pool->done);
    pthread_cond_destroy(&pool->news);
    pthread_mutex_destroy(&pool->mutex);
    free(pool);
}

/* ---- Running ---- */

/* A wait is where a cancelled thread may end, with the others still at work on what lies on its stack. Android has no
 * cancellation, and so no macro. */
static int hold_cancellation(void)
{
    int before = 0;
#if defined(PTHREAD_CANCEL_DISABLE)
    pthread_setcancelstate(PTHREAD_CANCEL_DISABLE, &before);
#endif
    return before;
}

static void restore_cancellation(int before)
{
#if defined(PTHREAD_CANCEL_DISABLE)
    pthread_setcancelstate(before, NULL);
#else
    (void)before;
#endif
}

/* As many as there are pieces for, beside the caller's. */
static void wake_sleepers(cm_pool *pool)
{
    const size_t sleepers = atomic_load(&pool->sleepers);
    if (sleepers == 0)
    {
        return;
    }
    const size_t others = (pool->n - 1) / pool->least;
    pthread_mutex_lock(&pool->mutex);
    if (others >= sleepers)
    {
        pthread_cond_broadcast(&pool->news);
    }
    for (size_t i = 0; i < others && others < sleepers; i++)
    {
        pthread_cond_signal(&pool->news);
    }
    pthread_mutex_unlock(&pool->mutex);
}

static void run_shared(cm_pool *pool)
{
    const int cancellation = hold_cancellation();
    fegetenv(&pool->environment);
    atomic_store_explicit(&pool->next, 0, memory_order_relaxed);
    /* nobody is at work and nothing is open: the word is this thread's own */
    const uint64_t number = NUMBER_OF(atomic_load(&pool->word)) + 1;
    atomic_store(&pool->word, number * NUMBER_ONE + OPEN);
    wake_sleepers(pool);
    do_pieces(pool);
    atomic_fetch_and(&pool->word, ~OPEN);
    wait_for_workers(pool);
    restore_cancellation(cancellation);
}

void cm_pool_run(cm_pool *pool, size_t n, size_t least, cm_job job, void *user)
{
    least = least == 0 ? 1 : least;
    if (n == 0)
    {
        return;
    }
    if (pool == NULL || pool->threads == 1 || n <= least || atomic_exchange(&pool->is_busy, 1))
    {
        job(0, n, user);
        return;
    }
    pool->n = n;
    pool->least = least;
    pool->job = job;
    pool->user = user;
    run_shared(pool);
    atomic_store(&pool->is_busy, 0);
}

#else

struct cm_pool
{
    unsigned threads;
};

cm_status cm_pool_create(unsigned threads, cm_pool **pool)
{
    if (pool == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    cm_pool *made = malloc(sizeof *made);
    if (made == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    (void)threads;
    made->threads = 1;
    *pool = made;
    return CM_OK;
}

void cm_pool_destroy(cm_pool *pool)
{
    free(pool);
}

void cm_pool_run(cm_pool *pool, size_t n, size_t least, cm_job job, void *user)
{
    (void)pool;
    (void)least;
    if (n > 0)
    {
        job(0, n, user);
    }
}

#endif

unsigned cm_pool_threads(const cm_pool *pool)
{
    return pool == NULL ? 1 : pool->threads;
}
