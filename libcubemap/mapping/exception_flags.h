/* SPDX-License-Identifier: MIT
 *
 * The floating-point exceptions of the caller, kept from the library's arithmetic. Loops over vectors compute both sides
 * of every choice, and what is not chosen may divide zero by zero, for good points too. Between cm_exceptions_hold and
 * cm_exceptions_restore no exception traps, and after it the flags are as they were.
 * To read the flags takes as long as a gnomonic point. So points and pixels alone, which raise nothing but inexact, leave
 * that one as it comes.
 *
 * Compilers do not know that arithmetic changes flags: between the two must stand what they cannot move, calls and what
 * reads and writes memory.
 */
#ifndef LIBCUBEMAP_MAPPING_EXCEPTION_FLAGS_H
#define LIBCUBEMAP_MAPPING_EXCEPTION_FLAGS_H

#if defined(__SSE2__) || defined(_M_X64)
#include <xmmintrin.h>

/* <fenv.h> would do it for the x87, too, which is not used here and takes ten times as long. */
typedef unsigned cm_exceptions;

static inline cm_exceptions cm_exceptions_hold(void)
{
    const unsigned held = _mm_getcsr();
    if ((held & _MM_MASK_MASK) != _MM_MASK_MASK)
    {
        _mm_setcsr(held | _MM_MASK_MASK);
    }
    return held;
}

/* To read the flags waits for all arithmetic before it, but to write them takes longer. */
static inline void cm_exceptions_restore(cm_exceptions held)
{
    if (_mm_getcsr() != held)
    {
        _mm_setcsr(held);
    }
}
#elif defined(__aarch64__) && defined(__GNUC__)
#include <stdint.h>

/* the flags alone: processors that trap are rare, and <fenv.h> has no way to ask for it */
typedef uint64_t cm_exceptions;

static inline cm_exceptions cm_exceptions_hold(void)
{
    uint64_t held;
    __asm__ volatile("mrs %0, fpsr" : "=r"(held)::"memory");
    return held;
}

static inline void cm_exceptions_restore(cm_exceptions held)
{
    uint64_t now;
    __asm__ volatile("mrs %0, fpsr" : "=r"(now)::"memory");
    if (now != held)
    {
        __asm__ volatile("msr fpsr, %0" ::"r"(held) : "memory");
    }
}
#else
#include <fenv.h>

typedef fenv_t cm_exceptions;

static inline cm_exceptions cm_exceptions_hold(void)
{
    fenv_t held;
    (void)feholdexcept(&held);
    return held;
}

static inline void cm_exceptions_restore(cm_exceptions held)
{
    (void)fesetenv(&held);
}
#endif

#endif
