/* SPDX-License-Identifier: MIT
 *
 * Threads that stay: work is handed to them without one being made. Of the library cubemap-scene.
 *
 *   pieces    begin anywhere and are handed out as threads become free, long ones first: which thread does what is left to
 *             chance. Results do not depend on it if what a job does for an element depends on nothing that it does for
 *             others
 *   waiting   idle threads look for work for a tenth of a millisecond, if there are no more of them than processors, and
 *             sleep then
 *   threads   one call of cm_pool_run at a time has the pool's threads. While it does, another from any thread, and one from
 *             within a job, does its work in the thread that calls
 *   signals   the pool's threads have all blocked but those of faults in the work itself; for each call they have its
 *             caller's floating-point environment. A cancellation of the caller waits for the end of the call
 *   platforms POSIX threads. Where the library was built without them the calling thread does it all, as it does for what
 *             the system gives no thread for
 */
#ifndef CUBEMAP_POOL_H
#define CUBEMAP_POOL_H

#include <stddef.h>

#include <cubemap/export.h>
#include <cubemap/status.h>
#include <cubemap/threads.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Threads that stay, from cm_pool_create to cm_pool_destroy. */
typedef struct cm_pool cm_pool;

/* threads: the most to work, the calling one among them, so that a pool of 1 makes none; 0 means
 * cm_threads_available(), and more than CM_THREADS_MAX are that many.
 * CM_OK; CM_ERROR_ARGUMENT (NULL); CM_ERROR_MEMORY. */
CM_API cm_status cm_pool_create(unsigned threads, cm_pool **pool);

/* No call of cm_pool_run may be at work. NULL is allowed. */
CM_API void cm_pool_destroy(cm_pool *pool);

/* How many threads work at most, the calling one among them; 1 of NULL. */
CM_API unsigned cm_pool_threads(const cm_pool *pool);

/* As cm_run_threads, but that pieces begin anywhere: job is called for pieces of least elements or more that make up 0 to
 * n - 1, each element once; all is done when it returns. The last piece may be shorter, and a least of 0 is 1. If pool is
 * NULL the calling thread does it all. Nothing is called if n is 0. job must return, neither jump nor throw. */
CM_API void cm_pool_run(cm_pool *pool, size_t n, size_t least, cm_job job, void *user);

#ifdef __cplusplus
}
#endif

#endif
