/* SPDX-License-Identifier: MIT
 *
 * The array functions of mapping.h over several threads, and the helper that splits such work.
 *
 * Conventions of every function here:
 *   threads     the most threads to work, the calling one among them; 0 means
 *               cm_threads_available(). Never more than CM_THREADS_MAX, nor more than the work is
 *               worth: see cost
 *   results     the same bits for any number of threads, and those of the function of mapping.h.
 *               All else is as there too: shapes, ranges, bad input, what may overlap
 *   chunks      each thread has one contiguous chunk, all equally long to within 128 elements, that
 *               begins at a multiple of 64, so that threads do not share cache lines but for one at
 *               a border where an array is not aligned
 *   errors      none: what the system gives no thread for, the calling thread does itself
 *   life        threads are made for the call and gone when it returns. They have the platform's
 *               default stack, all signals blocked but those of faults in the work itself (SIGSEGV,
 *               SIGBUS and the like), and the caller's floating-point environment. A cancellation of
 *               the calling thread waits for the end of the call. The library keeps no pool and no
 *               state: any number of threads may call
 *   cost        no allocation but the stacks that the system gives to threads, and some 8 kB more
 *               of the caller's stack; 60 to 80 microseconds a thread, which is why none is made
 *               for less than CM_POINTS_PER_THREAD points
 *   platforms   POSIX threads. Where the library was built without them the calling thread does it
 *               all
 */
#ifndef CUBEMAP_THREADS_H
#define CUBEMAP_THREADS_H

#include <stddef.h>
#include <stdint.h>

#include <cubemap/export.h>
#include <cubemap/mapping.h>

#ifdef __cplusplus
extern "C" {
#endif

#define CM_THREADS_MAX 256

/* With so many points each, two threads take from 1.7 times (gnomonic in float, the quickest mapping) to
 * 0.6 times as long as one: the second thread costs 60 to 80 microseconds in all, a point 1 to 5 ns in
 * double and 0.5 to 2 ns in float. On two cores of a Xeon with AVX-512 in a virtual machine with Linux;
 * `build/tests/mapping/test-threads cost` measures it. */
#define CM_POINTS_PER_THREAD 65536

/* The processors that the calling thread may run on, where the system tells (as nproc counts them),
 * else those that are online; at least 1, and 1 where the library was built without threads. Limits
 * on time rather than on processors, as containers have, are not counted. Cost: a system call. */
CM_API unsigned cm_threads_available(void);

/* Does the elements begin to end - 1 of some work; begin < end. */
typedef void (*cm_job)(size_t begin, size_t end, void *user);

/* Call job for chunks that make up 0 to n - 1, each element once, each thread for one chunk; all is
 * done when it returns. There are at most n / least threads, or one: least is the fewest elements
 * that are worth the making of a thread, and is taken as 64 if it is below that. Nothing is called
 * if n is 0. The results do not depend on threads if what job does for an element depends on
 * nothing that job does for others. job must return, neither jump nor throw, and may itself call
 * the functions here. */
CM_API void cm_run_threads(unsigned threads, size_t n, size_t least, cm_job job, void *user);

/* As the functions of mapping.h without _threads. */
CM_API void cm_forward_array_threads(const cm_mapping *mapping, unsigned threads, size_t n,
                                     const double *x, const double *y, const double *z,
                                     uint8_t *face, double *u, double *v);
CM_API void cm_forward_array_threads_f32(const cm_mapping *mapping, unsigned threads, size_t n,
                                         const float *x, const float *y, const float *z,
                                         uint8_t *face, float *u, float *v);
CM_API void cm_inverse_array_threads(const cm_mapping *mapping, unsigned threads, size_t n,
                                     const uint8_t *face, const double *u, const double *v,
                                     double *x, double *y, double *z);
CM_API void cm_inverse_array_threads_f32(const cm_mapping *mapping, unsigned threads, size_t n,
                                         const uint8_t *face, const float *u, const float *v,
                                         float *x, float *y, float *z);
CM_API void cm_forward_strided_threads(const cm_mapping *mapping, unsigned threads, size_t n,
                                       const double *xyz, ptrdiff_t stride, uint8_t *face,
                                       double *u, double *v);
CM_API void cm_forward_strided_threads_f32(const cm_mapping *mapping, unsigned threads, size_t n,
                                           const float *xyz, ptrdiff_t stride, uint8_t *face,
                                           float *u, float *v);
CM_API void cm_inverse_strided_threads(const cm_mapping *mapping, unsigned threads, size_t n,
                                       const uint8_t *face, const double *u, const double *v,
                                       double *xyz, ptrdiff_t stride);
CM_API void cm_inverse_strided_threads_f32(const cm_mapping *mapping, unsigned threads, size_t n,
                                           const uint8_t *face, const float *u, const float *v,
                                           float *xyz, ptrdiff_t stride);
CM_API void cm_forward_jacobian_array_threads(const cm_mapping *mapping, unsigned threads, size_t n,
                                              const double *x, const double *y, const double *z,
                                              double *const jacobian[6]);
CM_API void cm_forward_jacobian_array_threads_f32(const cm_mapping *mapping, unsigned threads,
                                                  size_t n, const float *x, const float *y,
                                                  const float *z, float *const jacobian[6]);
CM_API void cm_inverse_jacobian_array_threads(const cm_mapping *mapping, unsigned threads, size_t n,
                                              const uint8_t *face, const double *u, const double *v,
                                              double *const jacobian[6]);
CM_API void cm_inverse_jacobian_array_threads_f32(const cm_mapping *mapping, unsigned threads,
                                                  size_t n, const uint8_t *face, const float *u,
                                                  const float *v, float *const jacobian[6]);

#ifdef __cplusplus
}
#endif

#endif
