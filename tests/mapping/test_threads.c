/* SPDX-License-Identifier: MIT
 *
 * Threads: the same bits for any number of them, also where the system refuses some; how the work
 * is split; signals, cancellation and rounding.
 *
 * test-threads cost measures, instead of testing, from how many points on a second thread pays.
 */
#if !defined(_GNU_SOURCE)
#define _GNU_SOURCE /* for what POSIX has, in spite of -std=c11 */
#endif

#include "tests/suite.h"

#include <errno.h>
#include <fenv.h>
#include <limits.h>
#include <time.h>

enum
{
    COUNT = 200003,
    GUARD = 64,
    STRIDE = 4,
    REPEATS = 501
};

/* instead of a number of threads: the function of mapping.h */
#define PLAIN UINT_MAX

static const unsigned thread_counts[] = {0, 1, 2, 3, 7, 16, 64, 300};
static const size_t lengths[] = {0, 1, 63, 64, 65, 1000, 150000, COUNT};

#define LENGTH_OF(array) (sizeof(array) / sizeof(array)[0])

/* ---- Input, with bad points in it ---- */

static double x[COUNT], y[COUNT], z[COUNT], xyz[STRIDE * COUNT], u[COUNT], v[COUNT];
static float x_f32[COUNT], y_f32[COUNT], z_f32[COUNT], xyz_f32[STRIDE * COUNT], u_f32[COUNT],
    v_f32[COUNT];
static uint8_t face[COUNT];

static void make_input(void)
{
    static const double odd[] = {(double)NAN, (double)INFINITY, 0.0, -0.0, 1.0, -1.0, 1.1};
    uint64_t state = 41;
    for (size_t i = 0; i < COUNT; i++)
    {
        double *numbers[] = {&x[i], &y[i], &z[i], &u[i], &v[i]};
        for (size_t k = 0; k < LENGTH_OF(numbers); k++)
        {
            *numbers[k] = next_real(&state);
        }
        if (i % 97 == 0)
        {
            *numbers[i / 97 % LENGTH_OF(numbers)] = odd[i / 97 % LENGTH_OF(odd)];
        }
        face[i] = i % 89 == 0 ? 255 : (uint8_t)(i % 7);
        x_f32[i] = xyz_f32[STRIDE * i] = (float)(xyz[STRIDE * i] = x[i]);
        y_f32[i] = xyz_f32[STRIDE * i + 1] = (float)(xyz[STRIDE * i + 1] = y[i]);
        z_f32[i] = xyz_f32[STRIDE * i + 2] = (float)(xyz[STRIDE * i + 2] = z[i]);
        u_f32[i] = (float)u[i];
        v_f32[i] = (float)v[i];
    }
}

/* ---- Output: all in one piece of memory, guards between, for one comparison to see ---- */

typedef struct output
{
    unsigned char bytes[(3 + STRIDE) * (COUNT * sizeof(double) + GUARD) + COUNT + 2 * GUARD];
    size_t size; /* of bytes, for the n at hand */
    void *a;
    void *b;
    void *c;
    void *packed;
    uint8_t *face;
} output;

static output expected, got;

static void clear_output(output *out, size_t n, size_t element)
{
    size_t column = GUARD + n * element;
    column += sizeof(double) - column % sizeof(double); /* aligned, and an element more of guard */
    out->a = out->bytes + GUARD;
    out->b = out->bytes + GUARD + column;
    out->c = out->bytes + GUARD + 2 * column;
    out->packed = out->bytes + GUARD + 3 * column;
    out->face = out->bytes + GUARD + 3 * column + STRIDE * n * element + GUARD;
    out->size = (size_t)(out->face - out->bytes) + n + GUARD;
    REQUIRE(out->size <= sizeof out->bytes, "no room for %zu", n);
    memset(out->bytes, 0x5a, out->size);
}

/* ---- The functions, with one signature ---- */

#define ARGUMENTS const cm_mapping *mapping, unsigned threads, size_t n, const output *out

#define EITHER(name, suffix, ...)                                                                  \
    (threads == PLAIN ? cm_##name##suffix(mapping, n, __VA_ARGS__)                                 \
                      : cm_##name##_threads##suffix(mapping, threads, n, __VA_ARGS__))

#define CALLS(real, suffix)                                                                        \
    static void forward_array##suffix(ARGUMENTS)                                                   \
    {                                                                                              \
        EITHER(forward_array, suffix, x##suffix, y##suffix, z##suffix, out->face, out->a, out->b); \
    }                                                                                              \
    static void inverse_array##suffix(ARGUMENTS)                                                   \
    {                                                                                              \
        EITHER(inverse_array, suffix, face, u##suffix, v##suffix, out->a, out->b, out->c);         \
    }                                                                                              \
    static void forward_strided##suffix(ARGUMENTS)                                                 \
    {                                                                                              \
        EITHER(forward_strided, suffix, xyz##suffix, STRIDE, out->face, out->a, out->b);           \
    }                                                                                              \
    /* from the last point to the first */                                                         \
    static void inverse_strided##suffix(ARGUMENTS)                                                 \
    {                                                                                              \
        real *last = (real *)out->packed + (n == 0 ? 0 : STRIDE * (n - 1));                        \
        EITHER(inverse_strided, suffix, face, u##suffix, v##suffix, last, -STRIDE);                \
    }                                                                                              \
    /* u over z, v over x, and back */                                                             \
    static void in_place##suffix(ARGUMENTS)                                                        \
    {                                                                                              \
        memcpy(out->a, x##suffix, n * sizeof(real));                                               \
        memcpy(out->b, y##suffix, n * sizeof(real));                                               \
        memcpy(out->c, z##suffix, n * sizeof(real));                                               \
        EITHER(forward_array, suffix, out->a, out->b, out->c, out->face, out->c, out->a);          \
        EITHER(inverse_array, suffix, out->face, out->c, out->a, out->a, out->b, out->c);          \
    }

CALLS(double, )
CALLS(float, _f32)

typedef struct subject
{
    const char *name;
    void (*call)(ARGUMENTS);
    size_t element;
} subject;

#define SUBJECTS(real, suffix)                                                                     \
    {"forward array, " #real, forward_array##suffix, sizeof(real)},                                \
        {"inverse array, " #real, inverse_array##suffix, sizeof(real)},                            \
        {"forward strided, " #real, forward_strided##suffix, sizeof(real)},                        \
        {"inverse strided, " #real, inverse_strided##suffix, sizeof(real)},                        \
        {"in place, " #real, in_place##suffix, sizeof(real)},

static const subject subjects[] = {SUBJECTS(double, ) SUBJECTS(float, _f32)};

static void check_subject(const subject *s, const cm_mapping *mapping, size_t n)
{
    clear_output(&expected, n, s->element);
    s->call(mapping, PLAIN, n, &expected);
    for (size_t t = 0; t < LENGTH_OF(thread_counts); t++)
    {
        clear_output(&got, n, s->element);
        s->call(mapping, thread_counts[t], n, &got);
        REQUIRE(memcmp(expected.bytes, got.bytes, got.size) == 0, "%s: %s, n %zu, %u threads",
                cm_mapping_describe(mapping)->identifier, s->name, n, thread_counts[t]);
    }
}

/* Every mapping, each in one of the frames; long arrays with two of the functions. */
START_TEST(same_bits_for_any_number_of_threads)
{
    for (size_t i = 0; i < cm_catalogue_count(); i++)
    {
        cm_mapping *mapping =
            make_mapping(cm_catalogue_at(i)->identifier, cm_frame_at(i % cm_frame_count()));
        for (size_t s = 0; s < LENGTH_OF(subjects); s++)
        {
            for (size_t l = 0; l < LENGTH_OF(lengths); l++)
            {
                if (lengths[l] <= 1000 || (i + s) % 5 == 0)
                {
                    check_subject(&subjects[s], mapping, lengths[l]);
                }
            }
        }
        cm_mapping_destroy(mapping);
    }
}
END_TEST

/* without arrays there is nothing to add to */
START_TEST(no_points_and_no_arrays)
{
    cm_mapping *mapping = make_mapping("coupled", NULL);
    cm_forward_array_threads(mapping, 7, 0, NULL, NULL, NULL, NULL, NULL, NULL);
    cm_inverse_strided_threads_f32(mapping, 7, 0, NULL, NULL, NULL, NULL, 3);
    cm_mapping_destroy(mapping);
}
END_TEST

/* ---- The splitting ---- */

static size_t chunk_of[COUNT]; /* where the element's chunk begins */
static unsigned times_done[COUNT];

static void note_chunk(size_t begin, size_t end, void *user)
{
    size_t *begins = user;
    for (size_t i = begin; i < end; i++)
    {
        begins[i] = begin;
        times_done[i]++;
    }
}

/* how many chunks they were, equally long to within 64, and the last up to 63 shorter still */
static size_t count_chunks(size_t n)
{
    size_t chunks = 0;
    size_t shortest = n;
    size_t longest = 0;
    size_t last_begin = n;
    for (size_t i = n; i-- > 0;)
    {
        REQUIRE(times_done[i] == 1 && chunk_of[i] <= i && chunk_of[i] % 64 == 0, "element %zu", i);
        if (chunk_of[i] == i)
        {
            size_t length = last_begin - i;
            shortest = length < shortest ? length : shortest;
            longest = length > longest ? length : longest;
            last_begin = i;
            chunks++;
        }
    }
    ck_assert(n == 0 || (last_begin == 0 && longest - shortest <= 127));
    return chunks;
}

static void check_split(unsigned threads, size_t n, size_t least)
{
    memset(times_done, 0, sizeof times_done);
    cm_run_threads(threads, n, least, note_chunk, chunk_of);
    size_t chunks = count_chunks(n);
    size_t most = n / (least < 64 ? 64 : least);
    most = most > CM_THREADS_MAX ? CM_THREADS_MAX : most;
    most = most > threads && threads > 0 ? threads : most;
    most = most < 1 ? 1 : most;
    ck_assert_uint_eq(chunks > 0, n > 0);
    ck_assert_uint_le(chunks, most);
#if defined(WRAPS_THREADS)
    ck_assert(n == 0 || threads == 0 || chunks == most);
#endif
    for (size_t i = n; i < COUNT; i++)
    {
        REQUIRE(times_done[i] == 0, "element %zu, n %zu", i, n);
    }
}

START_TEST(every_element_is_done_once)
{
    static const size_t leasts[] = {0, 1, 64, 100, 4096, SIZE_MAX};
    for (size_t t = 0; t < LENGTH_OF(thread_counts); t++)
    {
        for (size_t l = 0; l < LENGTH_OF(lengths); l++)
        {
            for (size_t k = 0; k < LENGTH_OF(leasts); k++)
            {
                check_split(thread_counts[t], lengths[l], leasts[k]);
            }
        }
    }
}
END_TEST

typedef struct wide_job
{
    size_t n;
    size_t done[CM_THREADS_MAX];
} wide_job;

static void note_length(size_t begin, size_t end, void *user)
{
    wide_job *job = user;
    job->done[begin / (job->n / CM_THREADS_MAX)] = end - begin;
}

/* nothing overflows where there are as many elements as a size_t counts */
START_TEST(the_greatest_length)
{
    static wide_job job = {.n = SIZE_MAX};
    cm_run_threads(CM_THREADS_MAX, job.n, 1, note_length, &job);
    size_t sum = 0;
    for (size_t i = 0; i < CM_THREADS_MAX; i++)
    {
        sum += job.done[i];
    }
    ck_assert(sum == job.n);
}
END_TEST

static void run_within(size_t begin, size_t end, void *user)
{
    const cm_mapping *mapping = user;
    uint8_t *faces = expected.face + begin;
    double *to_u = (double *)expected.a + begin;
    double *to_v = (double *)expected.b + begin;
    cm_forward_array_threads(mapping, 3, end - begin, x + begin, y + begin, z + begin, faces, to_u,
                             to_v);
}

/* more chunks than the array functions would make, and threads that make threads */
START_TEST(jobs_may_use_threads)
{
    cm_mapping *mapping = make_mapping("qsc", NULL);
    clear_output(&got, COUNT, sizeof(double));
    forward_array(mapping, PLAIN, COUNT, &got);
    for (size_t t = 0; t < LENGTH_OF(thread_counts); t++)
    {
        clear_output(&expected, COUNT, sizeof(double));
        cm_run_threads(thread_counts[t], COUNT, 1, run_within, mapping);
        ck_assert(memcmp(expected.bytes, got.bytes, got.size) == 0);
    }
    cm_mapping_destroy(mapping);
}
END_TEST

START_TEST(some_processor_is_available)
{
    ck_assert_uint_ge(cm_threads_available(), 1);
}
END_TEST

/* threads round as their caller does */
START_TEST(rounding_is_the_callers)
{
#if defined(FE_UPWARD)
    cm_mapping *mapping = make_mapping("tangent", NULL);
    if (fesetround(FE_UPWARD) == 0)
    {
        check_subject(&subjects[0], mapping, COUNT);
        fesetround(FE_TONEAREST);
        clear_output(&got, COUNT, sizeof(double));
        forward_array(mapping, PLAIN, COUNT, &got);
        ck_assert(memcmp(expected.bytes, got.bytes, got.size) != 0);
    }
    cm_mapping_destroy(mapping);
#endif
}
END_TEST

/* ---- Threads that are refused ---- */

#if defined(WRAPS_THREADS)
#include <pthread.h>
#include <sched.h>
#include <signal.h>
#include <sys/mman.h>
#include <unistd.h>

int __real_pthread_create(pthread_t *thread, const pthread_attr_t *attributes,
                          void *(*start)(void *), void *argument);
int __wrap_pthread_create(pthread_t *thread, const pthread_attr_t *attributes,
                          void *(*start)(void *), void *argument);

/* Only the thread that runs the tests reads and writes them while they matter. */
static unsigned asked, allowed = UINT_MAX, unblocked;
static int counting;

static int is_blocked(int signal)
{
    sigset_t blocked;
    pthread_sigmask(SIG_SETMASK, NULL, &blocked);
    return sigismember(&blocked, signal);
}

int __wrap_pthread_create(pthread_t *thread, const pthread_attr_t *attributes,
                          void *(*start)(void *), void *argument)
{
    if (counting)
    {
        unblocked += !is_blocked(SIGINT) || !is_blocked(SIGPROF) || is_blocked(SIGSEGV);
        if (asked++ >= allowed)
        {
            return EAGAIN;
        }
    }
    return __real_pthread_create(thread, attributes, start, argument);
}

static unsigned threads_made(unsigned threads, size_t n)
{
    cm_mapping *mapping = make_mapping("coupled", NULL);
    clear_output(&got, n, sizeof(double));
    asked = 0;
    counting = 1;
    forward_array(mapping, threads, n, &got);
    counting = 0;
    cm_mapping_destroy(mapping);
    return asked;
}

/* the calling thread is one of them, and none has too little to do */
START_TEST(as_many_threads_as_are_worth_it)
{
    ck_assert_uint_eq(threads_made(1, COUNT), 0);
    ck_assert_uint_eq(threads_made(2, COUNT), 1);
    ck_assert_uint_eq(threads_made(3, COUNT), 2);
    ck_assert_uint_eq(threads_made(300, COUNT), COUNT / CM_POINTS_PER_THREAD - 1);
    ck_assert_uint_eq(threads_made(2, 2 * CM_POINTS_PER_THREAD), 1);
    ck_assert_uint_eq(threads_made(2, 2 * CM_POINTS_PER_THREAD - 1), 0);
    ck_assert_uint_lt(threads_made(0, COUNT), cm_threads_available());
}
END_TEST

START_TEST(refused_threads_lose_nothing)
{
    for (allowed = 0; allowed < 4; allowed++)
    {
        for (size_t s = 0; s < LENGTH_OF(subjects); s++)
        {
            cm_mapping *mapping = make_mapping("healpix", NULL);
            clear_output(&expected, COUNT, subjects[s].element);
            subjects[s].call(mapping, PLAIN, COUNT, &expected);
            for (size_t t = 0; t < LENGTH_OF(thread_counts); t++)
            {
                clear_output(&got, COUNT, subjects[s].element);
                asked = 0;
                counting = 1;
                subjects[s].call(mapping, thread_counts[t], COUNT, &got);
                counting = 0;
                ck_assert(memcmp(expected.bytes, got.bytes, got.size) == 0);
            }
            cm_mapping_destroy(mapping);
        }
    }
    allowed = UINT_MAX;
}
END_TEST

/* blocked in the threads of the call, and nowhere else; but not those of faults in the work */
START_TEST(signals_are_left_to_the_program)
{
    unblocked = 0;
    ck_assert_uint_gt(threads_made(3, COUNT), 0);
    ck_assert_uint_eq(unblocked, 0);
    ck_assert(!is_blocked(SIGINT) && !is_blocked(SIGPROF));
}
END_TEST

/* as programs do that supply pages when they are touched */
static double *late;

static void supply_page(int signal)
{
    (void)signal;
    mprotect(late, COUNT * sizeof *late, PROT_READ | PROT_WRITE);
}

static void touch(size_t begin, size_t end, void *user)
{
    (void)user;
    for (size_t i = begin; i < end; i++)
    {
        late[i] = (double)i;
    }
}

START_TEST(pages_may_be_late)
{
    struct sigaction supply = {.sa_handler = supply_page}, before;
    size_t size = COUNT * sizeof *late;
    ck_assert_int_eq(sigaction(SIGSEGV, &supply, &before), 0);
    for (int i = 0; i < 20; i++)
    {
        late = mmap(NULL, size, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
        ck_assert(late != MAP_FAILED);
        cm_run_threads(3, COUNT, 1, touch, NULL);
        ck_assert(late[0] == 0.0 && late[COUNT - 1] == (double)(COUNT - 1));
        munmap(late, size);
    }
    ck_assert_int_eq(sigaction(SIGSEGV, &before, NULL), 0);
}
END_TEST

static void *run_cancelled(void *finished)
{
    pthread_cancel(pthread_self());
    memset(times_done, 0, sizeof times_done);
    cm_run_threads(5, COUNT, 1, note_chunk, chunk_of);
    *(int *)finished = 1;
    pthread_testcancel();
    *(int *)finished = 2;
    return NULL;
}

/* a cancelled caller does not leave while others use its arrays, and is cancelled then */
START_TEST(cancellation_waits)
{
    pthread_t thread;
    int finished = 0;
    ck_assert_int_eq(pthread_create(&thread, NULL, run_cancelled, &finished), 0);
    pthread_join(thread, NULL);
    ck_assert_int_eq(finished, 1);
    ck_assert_uint_eq(count_chunks(COUNT), 5);
}
END_TEST

/* how much the system does not tell: nothing, the processors of the thread, those online too */
static int untold;

#if defined(CPU_COUNT)
int __real_sched_getaffinity(pid_t process, size_t size, cpu_set_t *set);
int __wrap_sched_getaffinity(pid_t process, size_t size, cpu_set_t *set);

int __wrap_sched_getaffinity(pid_t process, size_t size, cpu_set_t *set)
{
    return untold > 0 ? -1 : __real_sched_getaffinity(process, size, set);
}
#endif

long __real_sysconf(int name);
long __wrap_sysconf(int name);

long __wrap_sysconf(int name)
{
    return untold > 1 ? -1 : __real_sysconf(name);
}

START_TEST(processors_that_are_not_told)
{
    untold = 1;
    ck_assert_uint_eq(cm_threads_available(), (unsigned)sysconf(_SC_NPROCESSORS_ONLN));
    untold = 2;
    ck_assert_uint_eq(cm_threads_available(), 1);
    untold = 0;
}
END_TEST

#endif

/* ---- What a thread costs ---- */

static double microseconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec * 1e6 + (double)now.tv_nsec * 1e-3;
}

static int compare(const void *a, const void *b)
{
    double difference = *(const double *)a - *(const double *)b;
    return (difference > 0.0) - (difference < 0.0);
}

static const cm_mapping *timed_mapping;

static void timed(size_t begin, size_t end, void *user)
{
    (void)user;
    cm_forward_array(timed_mapping, end - begin, x + begin, y + begin, z + begin, got.face + begin,
                     (double *)got.a + begin, (double *)got.b + begin);
}

static void timed_f32(size_t begin, size_t end, void *user)
{
    (void)user;
    cm_forward_array_f32(timed_mapping, end - begin, x_f32 + begin, y_f32 + begin, z_f32 + begin,
                         got.face + begin, (float *)got.a + begin, (float *)got.b + begin);
}

static double median_time(unsigned threads, size_t n, cm_job job)
{
    static double times[REPEATS];
    for (size_t i = 0; i < REPEATS; i++)
    {
        double start = microseconds();
        cm_run_threads(threads, n, 1, job, NULL);
        times[i] = microseconds() - start;
    }
    qsort(times, REPEATS, sizeof times[0], compare);
    return times[REPEATS / 2];
}

static int print_cost(void)
{
    static const char *const names[] = {"gnomonic", "coupled", "qsc"};
    clear_output(&got, COUNT, sizeof(double));
    printf("mapping    real    points  1 thread/us  2 threads/us  ratio\n");
    for (size_t i = 0; i < 2 * LENGTH_OF(names); i++)
    {
        cm_mapping *mapping;
        if (cm_mapping_create(names[i / 2], NULL, &mapping) != CM_OK)
        {
            return 1;
        }
        timed_mapping = mapping;
        for (size_t n = 4096; n <= COUNT; n *= 2)
        {
            double one = median_time(1, n, i % 2 == 0 ? timed : timed_f32);
            double two = median_time(2, n, i % 2 == 0 ? timed : timed_f32);
            printf("%-10s %-6s %7zu %12.1f %13.1f %6.2f\n", names[i / 2],
                   i % 2 == 0 ? "double" : "float", n, one, two, one / two);
        }
        cm_mapping_destroy(mapping);
    }
    return 0;
}

int main(int count, char **arguments)
{
    const TTest *const tests[] = {
        same_bits_for_any_number_of_threads,
        no_points_and_no_arrays,
        every_element_is_done_once,
        the_greatest_length,
        jobs_may_use_threads,
        some_processor_is_available,
        rounding_is_the_callers,
#if defined(WRAPS_THREADS)
        as_many_threads_as_are_worth_it,
        refused_threads_lose_nothing,
        signals_are_left_to_the_program,
        pages_may_be_late,
        cancellation_waits,
        processors_that_are_not_told,
#endif
        NULL,
    };
    make_input();
    return count > 1 && strcmp(arguments[1], "cost") == 0 ? print_cost()
                                                          : run_suite("threads", tests);
}
