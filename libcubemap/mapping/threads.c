/* SPDX-License-Identifier: MIT
 *
 * Work split over threads. CM_HAVE_PTHREADS says that the platform has POSIX threads; without it
 * everything runs in the calling thread. They, and not those of C11, because macOS has no
 * <threads.h>, because only they can keep signals and cancellation away from the work, and because
 * the sanitizers know them.
 */
#if defined(CM_HAVE_PTHREADS)
#if !defined(_GNU_SOURCE)
#define _GNU_SOURCE /* for sched_getaffinity, and for all of POSIX in spite of -std=c11 */
#endif
#include <pthread.h>
#include <sched.h>
#include <signal.h>
#include <unistd.h>
#endif

#include <cubemap/threads.h>

#if defined(CM_HAVE_PTHREADS)

/* ---- Threads ---- */

unsigned cm_threads_available(void)
{
    long count = 0;
#if defined(CPU_COUNT)
    cpu_set_t allowed;
    if (sched_getaffinity(0, sizeof allowed, &allowed) == 0)
    {
        count = CPU_COUNT(&allowed);
    }
#endif
#if defined(_SC_NPROCESSORS_ONLN)
    if (count < 1)
    {
        count = sysconf(_SC_NPROCESSORS_ONLN);
    }
#endif
    return count < 1 ? 1 : (unsigned)count;
}

/* pthread_join is where a cancelled thread may end, with the others still at work on what lies on
 * its stack. Android has no cancellation, and so no macro. */
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

/* ---- Splitting ---- */

/* Chunks are multiples of so many elements: a cache line of the smallest ones, which are bytes. */
#define GRAIN 64

typedef struct split
{
    size_t n;
    size_t chunks; /* no more than there are grains */
    cm_job job;
    void *user;
} split;

typedef struct chunk
{
    const split *whole;
    size_t begin;
    size_t end;
} chunk;

/* Without a product that might overflow: the first chunks are a grain longer than the others. */
static size_t begin_of(const split *whole, size_t index)
{
    size_t grains = whole->n / GRAIN + (whole->n % GRAIN != 0);
    size_t longer = grains % whole->chunks;
    return GRAIN * (index * (grains / whole->chunks) + (index < longer ? index : longer));
}

static void *run_chunk(void *argument)
{
    const chunk *mine = argument;
    mine->whole->job(mine->begin, mine->end, mine->whole->user);
    return NULL;
}

/* One thread for each chunk but the last, from the first one on. Returns their number, which is
 * less if the system has no more. Signals are blocked in them: handlers belong to the program's
 * threads. Not those that the thread's own work brings about, as when a program supplies the pages of
 * an array when they are touched. */
static size_t start_threads(const split *whole, pthread_t *threads, chunk *chunks)
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
    size_t started = 0;
    while (started + 1 < whole->chunks)
    {
        chunks[started] = (chunk){whole, begin_of(whole, started), begin_of(whole, started + 1)};
        if (pthread_create(&threads[started], NULL, run_chunk, &chunks[started]) != 0)
        {
            break;
        }
        started++;
    }
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return started;
}

static void run_split(const split *whole)
{
    pthread_t threads[CM_THREADS_MAX - 1];
    chunk chunks[CM_THREADS_MAX - 1];
    int cancellation = hold_cancellation();
    size_t started = start_threads(whole, threads, chunks);
    /* the last chunk, and with it those that have no thread */
    whole->job(begin_of(whole, started), whole->n, whole->user);
    for (size_t i = 0; i < started; i++)
    {
        pthread_join(threads[i], NULL);
    }
    restore_cancellation(cancellation);
}

static size_t smaller(size_t a, size_t b)
{
    return a < b ? a : b;
}

void cm_run_threads(unsigned threads, size_t n, size_t least, cm_job job, void *user)
{
    split whole = {n, n / (least < GRAIN ? GRAIN : least), job, user};
    if (whole.chunks > 1) /* the system is asked only where it matters */
    {
        whole.chunks = smaller(whole.chunks, threads == 0 ? cm_threads_available() : threads);
        whole.chunks = smaller(whole.chunks, CM_THREADS_MAX);
    }
    if (whole.chunks > 1)
    {
        run_split(&whole);
    }
    else if (n > 0)
    {
        job(0, n, user);
    }
}

#else

unsigned cm_threads_available(void)
{
    return 1;
}

void cm_run_threads(unsigned threads, size_t n, size_t least, cm_job job, void *user)
{
    (void)threads;
    (void)least;
    if (n > 0)
    {
        job(0, n, user);
    }
}

#endif

/* ---- The array functions, documented in <cubemap/threads.h> ---- */

/* Their arguments after n, as a list of A(type, name, step): what follows by step for each point,
 * and with step 0 what is the same for all. */
/* clang-format off */
#define FORWARD_ARRAY(A, real)                                                                     \
    A(const real *, x, 1) A(const real *, y, 1) A(const real *, z, 1)                              \
    A(uint8_t *, face, 1) A(real *, u, 1) A(real *, v, 1)
#define INVERSE_ARRAY(A, real)                                                                     \
    A(const uint8_t *, face, 1) A(const real *, u, 1) A(const real *, v, 1)                        \
    A(real *, x, 1) A(real *, y, 1) A(real *, z, 1)
#define FORWARD_STRIDED(A, real)                                                                   \
    A(const real *, xyz, job->stride) A(ptrdiff_t, stride, 0)                                      \
    A(uint8_t *, face, 1) A(real *, u, 1) A(real *, v, 1)
#define INVERSE_STRIDED(A, real)                                                                   \
    A(const uint8_t *, face, 1) A(const real *, u, 1) A(const real *, v, 1)                        \
    A(real *, xyz, job->stride) A(ptrdiff_t, stride, 0)
/* clang-format on */

#define MEMBER(type, name, step) type name;
#define PARAMETER(type, name, step) , type name
#define VALUE(type, name, step) , name
#define FROM_BEGIN(type, name, step) , job->name + (step) * (ptrdiff_t)begin

/* A function of mapping.h over threads: its arguments as a struct, what calls it for a chunk, and
 * the public function. */
#define THREADED(name, plain, ARGUMENTS, real)                                                     \
    typedef struct plain##_job                                                                     \
    {                                                                                              \
        const cm_mapping *mapping;                                                                 \
        ARGUMENTS(MEMBER, real)                                                                    \
    } plain##_job;                                                                                 \
                                                                                                   \
    static void plain##_chunk(size_t begin, size_t end, void *user)                                \
    {                                                                                              \
        const plain##_job *job = user;                                                             \
        plain(job->mapping, end - begin ARGUMENTS(FROM_BEGIN, real));                              \
    }                                                                                              \
                                                                                                   \
    void name(const cm_mapping *mapping, unsigned threads, size_t n ARGUMENTS(PARAMETER, real))    \
    {                                                                                              \
        plain##_job job = {mapping ARGUMENTS(VALUE, real)};                                        \
        cm_run_threads(threads, n, CM_POINTS_PER_THREAD, plain##_chunk, &job);                     \
    }

THREADED(cm_forward_array_threads, cm_forward_array, FORWARD_ARRAY, double)
THREADED(cm_forward_array_threads_f32, cm_forward_array_f32, FORWARD_ARRAY, float)
THREADED(cm_inverse_array_threads, cm_inverse_array, INVERSE_ARRAY, double)
THREADED(cm_inverse_array_threads_f32, cm_inverse_array_f32, INVERSE_ARRAY, float)
THREADED(cm_forward_strided_threads, cm_forward_strided, FORWARD_STRIDED, double)
THREADED(cm_forward_strided_threads_f32, cm_forward_strided_f32, FORWARD_STRIDED, float)
THREADED(cm_inverse_strided_threads, cm_inverse_strided, INVERSE_STRIDED, double)
THREADED(cm_inverse_strided_threads_f32, cm_inverse_strided_f32, INVERSE_STRIDED, float)

/* ---- Jacobians, whose outputs are six arrays ---- */

/* The six arrays from a point on; as a macro for both precisions. */
#define SIX_FROM(jacobian, begin)                                                                  \
    {                                                                                              \
        (jacobian)[0] + (begin), (jacobian)[1] + (begin), (jacobian)[2] + (begin),                 \
            (jacobian)[3] + (begin), (jacobian)[4] + (begin), (jacobian)[5] + (begin)              \
    }

#define THREADED_JACOBIAN(name, plain, first_type, real)                                           \
    typedef struct plain##_job                                                                     \
    {                                                                                              \
        const cm_mapping *mapping;                                                                 \
        const first_type *first;                                                                   \
        const real *second;                                                                        \
        const real *third;                                                                         \
        real *const *jacobian;                                                                     \
    } plain##_job;                                                                                 \
                                                                                                   \
    static void plain##_chunk(size_t begin, size_t end, void *user)                                \
    {                                                                                              \
        const plain##_job *job = user;                                                             \
        real *const to[6] = SIX_FROM(job->jacobian, begin);                                        \
        plain(job->mapping, end - begin, job->first + begin, job->second + begin,                  \
              job->third + begin, to);                                                             \
    }                                                                                              \
                                                                                                   \
    void name(const cm_mapping *mapping, unsigned threads, size_t n, const first_type *first,      \
              const real *second, const real *third, real *const jacobian[6])                      \
    {                                                                                              \
        plain##_job job = {mapping, first, second, third, jacobian};                               \
        cm_run_threads(threads, n, CM_POINTS_PER_THREAD, plain##_chunk, &job);                     \
    }

THREADED_JACOBIAN(cm_forward_jacobian_array_threads, cm_forward_jacobian_array, double, double)
THREADED_JACOBIAN(cm_forward_jacobian_array_threads_f32, cm_forward_jacobian_array_f32, float,
                  float)
THREADED_JACOBIAN(cm_inverse_jacobian_array_threads, cm_inverse_jacobian_array, uint8_t, double)
THREADED_JACOBIAN(cm_inverse_jacobian_array_threads_f32, cm_inverse_jacobian_array_f32, uint8_t,
                  float)
