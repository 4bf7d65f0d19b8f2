/* SPDX-License-Identifier: MIT
 *
 * The paths of one precision and how each of their forms is called. Read by calls_double.c and
 * calls_float.c, which say what REAL, PUBLIC and TABLE are.
 */
#include "paths.h"

/* More than the three chunks that the least number of points for a thread makes, and no multiple of
 * anything. */
#define POINTS_FOR_THREADS (3 * CM_POINTS_PER_THREAD + 333)

/* ---- Strides ---- */

#define BETWEEN ((REAL)77)

static size_t span_of(size_t n, int stride)
{
    return n == 0 ? 0 : (n - 1) * (size_t)abs(stride) + 3;
}

/* Directions so many elements apart in memory of their own that ends with them; between them is
 * BETWEEN. Returns the memory. */
static REAL *make_strided(size_t n, int stride, REAL **first)
{
    size_t size = span_of(n, stride);
    REAL *memory = need(malloc(size * sizeof(REAL) + (size == 0)));
    for (size_t i = 0; i < size; i++)
    {
        memory[i] = BETWEEN;
    }
    *first = memory + (stride < 0 && n > 0 ? size - 3 : 0);
    return memory;
}

static void pack(REAL *first, size_t n, int stride, void *const *columns)
{
    for (size_t i = 0; i < 3 * n; i++)
    {
        first[(ptrdiff_t)(i / 3) * stride + (ptrdiff_t)(i % 3)] = ((REAL *)columns[i % 3])[i / 3];
    }
}

/* Takes them out and leaves BETWEEN. */
static void unpack(REAL *first, size_t n, int stride, void *const *columns)
{
    for (size_t i = 0; i < 3 * n; i++)
    {
        REAL *place = &first[(ptrdiff_t)(i / 3) * stride + (ptrdiff_t)(i % 3)];
        ((REAL *)columns[i % 3])[i / 3] = *place;
        *place = BETWEEN;
    }
}

static const char *drop_strided(REAL *memory, size_t n, int stride)
{
    const char *wrong = NULL;
    for (size_t i = 0; i < span_of(n, stride); i++)
    {
        wrong = memory[i] == BETWEEN ? wrong : "written between the points";
    }
    free(memory);
    return wrong;
}

/* ---- Forward ---- */

static const char *forward_array(const cm_mapping *mapping, size_t n, void *const *in,
                                 void *const *out, int argument)
{
    (void)argument;
    PUBLIC(cm_forward_array)(mapping, n, in[0], in[1], in[2], out[0], out[1], out[2]);
    return NULL;
}

static const char *forward_array_threads(const cm_mapping *mapping, size_t n, void *const *in,
                                         void *const *out, int threads)
{
    PUBLIC(cm_forward_array_threads)
    (mapping, (unsigned)threads, n, in[0], in[1], in[2], out[0], out[1], out[2]);
    return NULL;
}

/* With over_argument the result overwrites the argument. */
static const char *forward_single(const cm_mapping *mapping, size_t n, void *const *in,
                                  void *const *out, int over_argument)
{
    for (size_t i = 0; i < n; i++)
    {
        REAL direction[3] = {((REAL *)in[0])[i], ((REAL *)in[1])[i], ((REAL *)in[2])[i]};
        REAL other[2];
        REAL *uv = over_argument ? direction : other;
        ((uint8_t *)out[0])[i] = PUBLIC(cm_forward)(mapping, direction, uv);
        ((REAL *)out[1])[i] = uv[0];
        ((REAL *)out[2])[i] = uv[1];
    }
    return NULL;
}

static const char *forward_strided(const cm_mapping *mapping, size_t n, void *const *in,
                                   void *const *out, int stride)
{
    REAL *first;
    REAL *memory = make_strided(n, stride, &first);
    pack(first, n, stride, in);
    PUBLIC(cm_forward_strided)(mapping, n, first, stride, out[0], out[1], out[2]);
    unpack(first, n, stride, in);
    return drop_strided(memory, n, stride);
}

static const char *forward_strided_threads(const cm_mapping *mapping, size_t n, void *const *in,
                                           void *const *out, int stride)
{
    REAL *first;
    REAL *memory = make_strided(n, stride, &first);
    pack(first, n, stride, in);
    PUBLIC(cm_forward_strided_threads)(mapping, 2, n, first, stride, out[0], out[1], out[2]);
    unpack(first, n, stride, in);
    return drop_strided(memory, n, stride);
}

/* ---- Inverse ---- */

static const char *inverse_array(const cm_mapping *mapping, size_t n, void *const *in,
                                 void *const *out, int argument)
{
    (void)argument;
    PUBLIC(cm_inverse_array)(mapping, n, in[0], in[1], in[2], out[0], out[1], out[2]);
    return NULL;
}

static const char *inverse_array_threads(const cm_mapping *mapping, size_t n, void *const *in,
                                         void *const *out, int threads)
{
    PUBLIC(cm_inverse_array_threads)
    (mapping, (unsigned)threads, n, in[0], in[1], in[2], out[0], out[1], out[2]);
    return NULL;
}

static const char *inverse_single(const cm_mapping *mapping, size_t n, void *const *in,
                                  void *const *out, int over_argument)
{
    for (size_t i = 0; i < n; i++)
    {
        REAL uv[3] = {((REAL *)in[1])[i], ((REAL *)in[2])[i], BETWEEN};
        REAL other[3];
        REAL *direction = over_argument ? uv : other;
        PUBLIC(cm_inverse)(mapping, ((uint8_t *)in[0])[i], uv, direction);
        for (int k = 0; k < 3; k++)
        {
            ((REAL *)out[k])[i] = direction[k];
        }
    }
    return NULL;
}

static const char *inverse_strided(const cm_mapping *mapping, size_t n, void *const *in,
                                   void *const *out, int stride)
{
    REAL *first;
    REAL *memory = make_strided(n, stride, &first);
    PUBLIC(cm_inverse_strided)(mapping, n, in[0], in[1], in[2], first, stride);
    unpack(first, n, stride, out);
    return drop_strided(memory, n, stride);
}

static const char *inverse_strided_threads(const cm_mapping *mapping, size_t n, void *const *in,
                                           void *const *out, int stride)
{
    REAL *first;
    REAL *memory = make_strided(n, stride, &first);
    PUBLIC(cm_inverse_strided_threads)(mapping, 2, n, in[0], in[1], in[2], first, stride);
    unpack(first, n, stride, out);
    return drop_strided(memory, n, stride);
}

/* ---- Jacobians ---- */

#define SIX_OF(out)                                                                                \
    {                                                                                              \
        (out)[0], (out)[1], (out)[2], (out)[3], (out)[4], (out)[5]                                 \
    }

static const char *forward_jacobian_array(const cm_mapping *mapping, size_t n, void *const *in,
                                          void *const *out, int argument)
{
    REAL *const jacobian[6] = SIX_OF(out);
    (void)argument;
    PUBLIC(cm_forward_jacobian_array)(mapping, n, in[0], in[1], in[2], jacobian);
    return NULL;
}

static const char *forward_jacobian_threads(const cm_mapping *mapping, size_t n, void *const *in,
                                            void *const *out, int threads)
{
    REAL *const jacobian[6] = SIX_OF(out);
    PUBLIC(cm_forward_jacobian_array_threads)
    (mapping, (unsigned)threads, n, in[0], in[1], in[2], jacobian);
    return NULL;
}

static const char *forward_jacobian_single(const cm_mapping *mapping, size_t n, void *const *in,
                                           void *const *out, int argument)
{
    (void)argument;
    for (size_t i = 0; i < n; i++)
    {
        const REAL direction[3] = {((REAL *)in[0])[i], ((REAL *)in[1])[i], ((REAL *)in[2])[i]};
        REAL jacobian[6];
        PUBLIC(cm_forward_jacobian)(mapping, direction, jacobian);
        for (int k = 0; k < 6; k++)
        {
            ((REAL *)out[k])[i] = jacobian[k];
        }
    }
    return NULL;
}

static const char *inverse_jacobian_array(const cm_mapping *mapping, size_t n, void *const *in,
                                          void *const *out, int argument)
{
    REAL *const jacobian[6] = SIX_OF(out);
    (void)argument;
    PUBLIC(cm_inverse_jacobian_array)(mapping, n, in[0], in[1], in[2], jacobian);
    return NULL;
}

static const char *inverse_jacobian_threads(const cm_mapping *mapping, size_t n, void *const *in,
                                            void *const *out, int threads)
{
    REAL *const jacobian[6] = SIX_OF(out);
    PUBLIC(cm_inverse_jacobian_array_threads)
    (mapping, (unsigned)threads, n, in[0], in[1], in[2], jacobian);
    return NULL;
}

static const char *inverse_jacobian_single(const cm_mapping *mapping, size_t n, void *const *in,
                                           void *const *out, int argument)
{
    (void)argument;
    for (size_t i = 0; i < n; i++)
    {
        const REAL uv[2] = {((REAL *)in[1])[i], ((REAL *)in[2])[i]};
        REAL jacobian[6];
        PUBLIC(cm_inverse_jacobian)(mapping, ((uint8_t *)in[0])[i], uv, jacobian);
        for (int k = 0; k < 6; k++)
        {
            ((REAL *)out[k])[i] = jacobian[k];
        }
    }
    return NULL;
}

/* ---- Distortion: of its columns those from which the others follow ---- */

#define DISTORTION_OF(out)                                                                         \
    {                                                                                              \
        .major = (out)[0], .minor = (out)[1], .orientation = (out)[2], .deformation = (out)[3],    \
        .texel_aspect = (out)[4], .texel_area = (out)[5]                                           \
    }

static const char *forward_distortion_array(const cm_mapping *mapping, size_t n, void *const *in,
                                            void *const *out, int argument)
{
    const PUBLIC(cm_distortion_arrays) to = DISTORTION_OF(out);
    (void)argument;
    PUBLIC(cm_forward_distortion_array)(mapping, n, in[0], in[1], in[2], &to);
    return NULL;
}

static const char *inverse_distortion_array(const cm_mapping *mapping, size_t n, void *const *in,
                                            void *const *out, int argument)
{
    const PUBLIC(cm_distortion_arrays) to = DISTORTION_OF(out);
    (void)argument;
    PUBLIC(cm_inverse_distortion_array)(mapping, n, in[0], in[1], in[2], &to);
    return NULL;
}

static void put_distortion(void *const *out, size_t i, const PUBLIC(cm_distortion) * d)
{
    const REAL values[6] = {d->major,       d->minor,        d->orientation,
                            d->deformation, d->texel_aspect, d->texel_area};
    for (int k = 0; k < 6; k++)
    {
        ((REAL *)out[k])[i] = values[k];
    }
}

static const char *forward_distortion_single(const cm_mapping *mapping, size_t n, void *const *in,
                                             void *const *out, int argument)
{
    (void)argument;
    for (size_t i = 0; i < n; i++)
    {
        const REAL direction[3] = {((REAL *)in[0])[i], ((REAL *)in[1])[i], ((REAL *)in[2])[i]};
        PUBLIC(cm_distortion) d;
        PUBLIC(cm_forward_distortion)(mapping, direction, &d);
        put_distortion(out, i, &d);
    }
    return NULL;
}

static const char *inverse_distortion_single(const cm_mapping *mapping, size_t n, void *const *in,
                                             void *const *out, int argument)
{
    (void)argument;
    for (size_t i = 0; i < n; i++)
    {
        const REAL uv[2] = {((REAL *)in[1])[i], ((REAL *)in[2])[i]};
        PUBLIC(cm_distortion) d;
        PUBLIC(cm_inverse_distortion)(mapping, ((uint8_t *)in[0])[i], uv, &d);
        put_distortion(out, i, &d);
    }
    return NULL;
}

/* ---- The warp alone ---- */

#define WARP_SINGLE(name)                                                                          \
    static const char *name##_single(const cm_mapping *mapping, size_t n, void *const *in,         \
                                     void *const *out, int over_argument)                          \
    {                                                                                              \
        const char *wrong = NULL;                                                                  \
        for (size_t i = 0; i < n; i++)                                                             \
        {                                                                                          \
            REAL from[2] = {((REAL *)in[0])[i], ((REAL *)in[1])[i]};                               \
            REAL other[2];                                                                         \
            REAL *to = over_argument ? from : other;                                               \
            wrong = PUBLIC(cm_##name)(mapping, from, to) == CM_OK ? wrong : "not CM_OK";           \
            ((REAL *)out[0])[i] = to[0];                                                           \
            ((REAL *)out[1])[i] = to[1];                                                           \
        }                                                                                          \
        return wrong;                                                                              \
    }

WARP_SINGLE(warp)
WARP_SINGLE(unwarp)

static const char *said(cm_status status)
{
    return status == CM_OK ? NULL : "not CM_OK";
}

static const char *warp_array(const cm_mapping *mapping, size_t n, void *const *in,
                              void *const *out, int argument)
{
    (void)argument;
    return said(PUBLIC(cm_warp_array)(mapping, n, in[0], in[1], out[0], out[1]));
}

static const char *unwarp_array(const cm_mapping *mapping, size_t n, void *const *in,
                                void *const *out, int argument)
{
    (void)argument;
    return said(PUBLIC(cm_unwarp_array)(mapping, n, in[0], in[1], out[0], out[1]));
}

static const char *warp_jacobian_array(const cm_mapping *mapping, size_t n, void *const *in,
                                       void *const *out, int argument)
{
    REAL *const jacobian[4] = {out[0], out[1], out[2], out[3]};
    (void)argument;
    return said(PUBLIC(cm_warp_jacobian_array)(mapping, n, in[0], in[1], jacobian));
}

static const char *warp_jacobian_single(const cm_mapping *mapping, size_t n, void *const *in,
                                        void *const *out, int argument)
{
    const char *wrong = NULL;
    (void)argument;
    for (size_t i = 0; i < n; i++)
    {
        const REAL pq[2] = {((REAL *)in[0])[i], ((REAL *)in[1])[i]};
        REAL jacobian[4];
        cm_status status = PUBLIC(cm_warp_jacobian)(mapping, pq, jacobian);
        wrong = status == CM_OK ? wrong : "not CM_OK";
        for (int k = 0; k < 4; k++)
        {
            ((REAL *)out[k])[i] = jacobian[k];
        }
    }
    return wrong;
}

/* ---- The table ---- */

#define FORMS_OF(way)                                                                              \
    {                                                                                              \
        {"array", way##_array, 0, 0}, {"single points", way##_single, 0, 600},                     \
            {"single points, over the argument", way##_single, 1, 600},                            \
            {"stride 3", way##_strided, 3, 600}, {"stride 4", way##_strided, 4, 600},              \
            {"stride -3", way##_strided, -3, 600}, {"stride 7", way##_strided, 7, 600},            \
            {"threads", way##_array_threads, 3, POINTS_FOR_THREADS},                               \
        {                                                                                          \
            "threads, stride -4", way##_strided_threads, -4, POINTS_FOR_THREADS                    \
        }                                                                                          \
    }

#define EPS_OF_1 "eps"
#define EPS_OF_MATRIX "eps of the largest entry"

const path_table TABLE = {
    .in = {REAL_NAME, sizeof(REAL) == sizeof(float), EPS, LEAST},
    .paths = {
        {"forward", DIRECTIONS, "rrr", "brr", EPS_OF_1, judge_map, NULL, CM_FAST_FORWARD, 1, 1,
         FORMS_OF(forward)},
        {"inverse", POINTS, "brr", "rrr", EPS_OF_1, judge_direction, NULL, CM_FAST_INVERSE, 1, 1,
         FORMS_OF(inverse)},
        {"forward Jacobian",
         DIRECTIONS,
         "rrr",
         "rrrrrr",
         EPS_OF_MATRIX,
         judge_jacobian,
         NULL,
         0,
         1,
         1,
         {{"array", forward_jacobian_array, 0, 0},
          {"single points", forward_jacobian_single, 0, 600},
          {"threads", forward_jacobian_threads, 3, POINTS_FOR_THREADS}}},
        {"inverse Jacobian",
         POINTS,
         "brr",
         "rrrrrr",
         EPS_OF_MATRIX,
         judge_jacobian,
         NULL,
         0,
         1,
         1,
         {{"array", inverse_jacobian_array, 0, 0},
          {"single points", inverse_jacobian_single, 0, 600},
          {"threads", inverse_jacobian_threads, 3, POINTS_FOR_THREADS}}},
        {"forward distortion",
         DIRECTIONS,
         "rrr",
         "rrrrrr",
         "of its bound",
         judge_distortion,
         NULL,
         0,
         1,
         1,
         {{"array", forward_distortion_array, 0, 0},
          {"single points", forward_distortion_single, 0, 600}}},
        {"inverse distortion",
         POINTS,
         "brr",
         "rrrrrr",
         "of its bound",
         judge_distortion,
         NULL,
         0,
         1,
         1,
         {{"array", inverse_distortion_array, 0, 0},
          {"single points", inverse_distortion_single, 0, 600}}},
        {"warp",
         PLANE,
         "rr",
         "rr",
         EPS_OF_1,
         judge_warped,
         has_warp,
         0,
         1,
         1,
         {{"array", warp_array, 0, 0},
          {"single points", warp_single, 0, 600},
          {"single points, over the argument", warp_single, 1, 600}}},
        {"unwarp",
         PLANE,
         "rr",
         "rr",
         EPS_OF_1,
         judge_unwarped,
         has_warp,
         0,
         1,
         1,
         {{"array", unwarp_array, 0, 0},
          {"single points", unwarp_single, 0, 600},
          {"single points, over the argument", unwarp_single, 1, 600}}},
        {"warp Jacobian",
         PLANE,
         "rr",
         "rrrr",
         EPS_OF_MATRIX,
         judge_jacobian,
         has_warp,
         0,
         1,
         1,
         {{"array", warp_jacobian_array, 0, 0}, {"single points", warp_jacobian_single, 0, 600}}},
    }};
