/* SPDX-License-Identifier: MIT
 *
 * The portable dialect: what a kernel is written in.
 *
 * A kernel is one text that several compilers read: C and C++ (in double and in float), GLSL, HLSL, OpenCL C,
 * CUDA and Metal.
 * This header gives that text its words, types.h its structs. Both are read anew for every backend,
 * so they and the kernels have no include guards; <cubemap/kernels.h> is the guarded way in.
 *
 * Rules of the dialect, all of them forced by the narrowest backend (GLSL ES 3.00):
 *   - scalars in, a small struct out; no pointers, no arrays, no recursion;
 *   - every real literal is CM_LIT(...) with a decimal point: there is no int -> float there;
 *   - no name that another shading language keeps for itself, as HLSL does point, line, sample and half;
 *   - names are whole words in CM_NAME(...): there is no ## there;
 *   - only the functions named below, no name of a math library;
 *   - CM_SELECT(condition, a, b) for a choice between values, its condition made by cm_less(a, b),
 *     cm_at_least(a, b) or cm_equal(a, b), or by cm_both(c, d) of two conditions: both sides are
 *     evaluated, so that a kernel has no branch. A branch on a mapping's variant (types.h), CM_VARIANT(k),
 *     is allowed: it is the same for every point;
 *   - where a mapping has zones with a formula each, the condition that tells them apart goes as a CM_ZONE through
 *     CM_BY_ZONE(condition, f, a, b) to f(zone, a, b), which chooses by CM_IN_ZONE(zone, a, b). That is
 *     CM_SELECT, but where points are computed one at a time, one zone's formula is computed alone:
 *     f is made twice, for a zone that is a constant. What is for points outside the zone alone may stand
 *     behind if (CM_OUTSIDE_ZONE(zone)), whether there may be some;
 *   - loops have a literal number of turns.
 *
 * Backends, chosen by defining CM_BACKEND before the first include:
 *   CM_BACKEND_DOUBLE   C11/C++17, double, names end in _f64
 *   CM_BACKEND_FLOAT    C11/C++17, float, names end in _f32
 *   CM_BACKEND_GLSL     GLSL 3.30 and later, GLSL ES 3.00 and later: highp float, names as they are
 *   CM_BACKEND_QUAD     gcc's __float128, names end in _f128: the truth that the tests measure the
 *                       others against. The includer supplies <quadmath.h> and what elementary.h
 *                       holds (truth/quad.h does)
 *   CM_BACKEND_LANES    vectors of several points: a CM_REAL is as many numbers as a register holds.
 *                       The includer supplies all words, in a file that CM_LANES names
 *                       (libcubemap/batch/lanes/)
 *   CM_BACKEND_HLSL     HLSL, shader model 5 and later; names as they are, like those below
 *   CM_BACKEND_OPENCL   OpenCL C 1.2 and later
 *   CM_BACKEND_CUDA     CUDA C++, for host and device
 *   CM_BACKEND_METAL    Metal 2 and later, after <metal_stdlib>
 */
#define CM_BACKEND_DOUBLE 1
#define CM_BACKEND_FLOAT 2
#define CM_BACKEND_GLSL 3
#define CM_BACKEND_QUAD 4
#define CM_BACKEND_LANES 5
#define CM_BACKEND_HLSL 6
#define CM_BACKEND_OPENCL 7
#define CM_BACKEND_CUDA 8
#define CM_BACKEND_METAL 9

#ifndef CM_BACKEND
#define CM_BACKEND CM_BACKEND_GLSL
#endif

#include "undefine.h"

#if CM_BACKEND == CM_BACKEND_DOUBLE
#define CM_REAL double
#define CM_REAL_BITS 64
#define CM_LIT(x) x
#define CM_NAME(name) name##_f64
#define cm_sqrt(x) sqrt(x)
#define cm_abs(x) fabs(x)
/* magnitude of m with the sign of s */
#define cm_copysign(m, s) copysign(m, s)
#elif CM_BACKEND == CM_BACKEND_FLOAT
#define CM_REAL float
#define CM_REAL_BITS 32
#define CM_LIT(x) x##f
#define CM_NAME(name) name##_f32
#define cm_sqrt(x) sqrtf(x)
#define cm_abs(x) fabsf(x)
#define cm_copysign(m, s) copysignf(m, s)
#elif CM_BACKEND == CM_BACKEND_QUAD
#define CM_REAL __float128
#define CM_REAL_BITS 128
#define CM_LIT(x) x##Q
#define CM_NAME(name) name##_f128
#define cm_sqrt(x) sqrtq(x)
#define cm_abs(x) fabsq(x)
#define cm_copysign(m, s) copysignq(m, s)
#elif CM_BACKEND == CM_BACKEND_LANES
#include CM_LANES
#else
#define CM_REAL float
#define CM_REAL_BITS 32
#define CM_NAME(name) name
#if CM_BACKEND == CM_BACKEND_GLSL
#define CM_LIT(x) x
#else
#define CM_LIT(x) x##f
#endif
#if CM_BACKEND == CM_BACKEND_GLSL || CM_BACKEND == CM_BACKEND_HLSL
#define cm_sqrt(x) sqrt(x)
#define cm_abs(x) abs(x)
/* the sign of a zero s is not seen: GLSL need not keep it */
#define cm_copysign(m, s) ((s) < CM_LIT(0.0) ? -abs(m) : abs(m))
#elif CM_BACKEND == CM_BACKEND_CUDA
#define cm_sqrt(x) sqrtf(x)
#define cm_abs(x) fabsf(x)
#define cm_copysign(m, s) copysignf(m, s)
#else
#define cm_sqrt(x) sqrt(x)
#define cm_abs(x) fabs(x)
#define cm_copysign(m, s) copysign(m, s)
#endif
#endif

#if CM_BACKEND == CM_BACKEND_GLSL || CM_BACKEND == CM_BACKEND_HLSL
#define CM_BOOL bool
#define CM_FN
#define CM_UNUSED(x)
#define CM_STRUCT(name) struct name
#define CM_STRUCT_END(name) ;
#else
#if CM_BACKEND != CM_BACKEND_LANES
#define CM_BOOL int
#endif
/* A loop over a kernel is made of vectors only if every call in it is inlined; without optimisation
 * kernels stay functions, for debuggers and for counting what is covered. */
#if CM_BACKEND == CM_BACKEND_CUDA || defined(__CUDACC__)
#define CM_FN static __host__ __device__ __forceinline__
#elif CM_BACKEND == CM_BACKEND_OPENCL || CM_BACKEND == CM_BACKEND_METAL
#define CM_FN static inline
#elif defined(__GNUC__) && defined(__OPTIMIZE__)
#define CM_FN static inline __attribute__((always_inline))
#else
#define CM_FN static inline
#endif
#define CM_UNUSED(x) (void)(x)
#define CM_STRUCT(name) typedef struct CM_NAME(name)
#define CM_STRUCT_END(name) CM_NAME(name);
#endif

#if CM_BACKEND != CM_BACKEND_LANES
/* a b + c: rounded once where that is as fast (some vectors, which say so by CM_FUSED), else twice. Exact if
 * the product is */
#define cm_mad(a, b, c) ((a) * (b) + (c))
#define cm_less(a, b) ((a) < (b))
#define cm_at_least(a, b) ((a) >= (b))
#define cm_equal(a, b) ((a) == (b))
#if CM_BACKEND == CM_BACKEND_GLSL || CM_BACKEND == CM_BACKEND_HLSL
#define cm_both(a, b) ((a) && (b))
#else
#define cm_both(a, b) ((a) & (b))
#endif
#define CM_SELECT(condition, a, b) ((condition) ? (a) : (b))
#define cm_min(a, b) CM_SELECT((a) < (b), a, b)
#define cm_max(a, b) CM_SELECT((a) > (b), a, b)
#define CM_VARIANT(k) ((k).variant != CM_LIT(0.0))
#endif

/* Who computes points one at a time defines CM_ALONE(condition), whether the only point's condition is true. By a branch
 * a point waits for its own zone's arithmetic, not for all. */
#ifdef CM_ALONE
#define CM_ZONE int
#define CM_BY_ZONE(condition, f, a, b) (CM_ALONE(condition) ? f(1, a, b) : f(0, a, b))
#define CM_IN_ZONE(zone, a, b) ((zone) ? (CM_REAL)(a) : (CM_REAL)(b))
#define CM_OUTSIDE_ZONE(zone) (!(zone))
#else
#define CM_ZONE CM_BOOL
#define CM_BY_ZONE(condition, f, a, b) f(condition, a, b)
#define CM_IN_ZONE(zone, a, b) CM_SELECT(zone, a, b)
#if CM_BACKEND == CM_BACKEND_GLSL || CM_BACKEND == CM_BACKEND_HLSL
#define CM_OUTSIDE_ZONE(zone) true
#else
#define CM_OUTSIDE_ZONE(zone) 1
#endif
#endif

/* The two functions of a univariate mapping from those of one coordinate: u = f(p), v = f(q). */
#define CM_UNIVARIATE(forward, f, inverse, f_inverse)                                              \
    CM_FN CM_NAME(cm_uv) CM_NAME(forward)(CM_REAL p, CM_REAL q, CM_NAME(cm_constants) k)           \
    {                                                                                              \
        return CM_NAME(cm_make_uv)(CM_NAME(f)(p, k), CM_NAME(f)(q, k));                            \
    }                                                                                              \
    CM_FN CM_NAME(cm_pq) CM_NAME(inverse)(CM_REAL u, CM_REAL v, CM_NAME(cm_constants) k)           \
    {                                                                                              \
        return CM_NAME(cm_make_pq)(CM_NAME(f_inverse)(u, k), CM_NAME(f_inverse)(v, k));            \
    }

/* The Jacobian of a univariate mapping from the slope of f at a coordinate given both ways, as w and as
 * f(w). */
#define CM_UNIVARIATE_JACOBIAN(jacobian, f_slope)                                                  \
    CM_FN CM_NAME(cm_jacobian)                                                                     \
        CM_NAME(jacobian)(CM_REAL p, CM_REAL q, CM_REAL u, CM_REAL v, CM_NAME(cm_constants) k)     \
    {                                                                                              \
        return CM_NAME(cm_make_jacobian)(CM_NAME(f_slope)(p, u, k), CM_LIT(0.0), CM_LIT(0.0),      \
                                         CM_NAME(f_slope)(q, v, k));                               \
    }
