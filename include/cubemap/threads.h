/* SPDX-License-Identifier: MIT
 *
 * The array functions of mapping.h over several threads, and the helper that splits such work.
 *
 *   threads     the most threads to work, the calling one among them; 0 means cm_threads_available(). Never more
 *               than CM_THREADS_MAX, nor more than one for each CM_POINTS_PER_THREAD points
 *   results     the same bits for any number of threads, and those of the function of mapping.h, as all else is
 *   chunks      each thread has one contiguous chunk, all equally long to within 128 elements, that begins at a
 *               multiple of 64, so that threads hardly share cache lines
 *   errors      none: what the system gives no thread for, the calling thread does itself
 *   life        threads are made for the call and gone when it returns. They have the platform's default stack, all
 *               signals blocked but those of faults in the work itself (SIGSEGV, SIGBUS and the like), and the
 *               caller's floating-point environment. A cancellation of the calling thread waits for the end of the
 *               call. The library keeps no pool and no state: any number of threads may call
 *   platforms   POSIX threads. Where the library was built without them the calling thread does it all
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

/* No function here has more threads work. */
#define CM_THREADS_MAX 256

/* No thread is made for fewer points than these: below, its making takes longer than what it saves
 * (docs/measured/costs.md). */
#define CM_POINTS_PER_THREAD 65536

/* The processors that the calling thread may run on, where the system tells (as nproc counts them),
 * else those that are online; at least 1, and 1 where the library was built without threads. Limits
 * on time rather than on processors, as containers have, are not counted. */
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
