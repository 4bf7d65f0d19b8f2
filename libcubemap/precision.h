/* SPDX-License-Identifier: MIT
 *
 * One precision of the library: the loops over the kernels, and the public functions that run blocks
 * of points through them. Read by double.c and by float.c, which say what CM_BACKEND and CM_PUBLIC
 * are.
 *
 * A point takes the same way in every function: project (direction to face and coordinates), turn
 * (from geo to the mapping's frame), warp; and back. Single points are arrays of one.
 */
#include <cubemap/kernel/dialect.h>

#define CM_NOT_A_NUMBER ((CM_REAL)NAN)
#define CM_TOLERANCE CM_LIT(1.0e-9)

/* ---- The kernels of each mapping as loops over a block ---- */

/* face 255 and NaN where the direction is none */
static void put_face_point(CM_NAME(cm_face_point) point, CM_REAL x, CM_REAL y, CM_REAL z,
                           CM_REAL *face, CM_REAL *a, CM_REAL *b)
{
    CM_REAL not_finite = (x - x) + (y - y) + (z - z);
    CM_BOOL good = (not_finite == CM_LIT(0.0)) & (CM_NAME(cm_magnitude)(x, y, z) > CM_LIT(0.0));
    *face = CM_SELECT(good, point.face, (CM_REAL)CM_NO_FACE);
    *a = CM_SELECT(good, point.a, CM_NOT_A_NUMBER);
    *b = CM_SELECT(good, point.b, CM_NOT_A_NUMBER);
}

#define CM_PROJECTION(id)                                                                          \
    static void project_##id(size_t n, const CM_REAL *x, const CM_REAL *y, const CM_REAL *z,       \
                             CM_REAL *restrict face, CM_REAL *restrict a, CM_REAL *restrict b)     \
    {                                                                                              \
        for (size_t i = 0; i < n; i++)                                                             \
        {                                                                                          \
            put_face_point(CM_NAME(cm_##id##_project)(x[i], y[i], z[i]), x[i], y[i], z[i],         \
                           &face[i], &a[i], &b[i]);                                                \
        }                                                                                          \
    }                                                                                              \
    static void unproject_##id(size_t n, const CM_REAL *face, const CM_REAL *a, const CM_REAL *b,  \
                               CM_REAL *restrict x, CM_REAL *restrict y, CM_REAL *restrict z)      \
    {                                                                                              \
        for (size_t i = 0; i < n; i++)                                                             \
        {                                                                                          \
            CM_NAME(cm_xyz) r = CM_NAME(cm_##id##_unproject)(face[i], a[i], b[i]);                 \
            CM_BOOL good = face[i] < CM_LIT(5.5);                                                  \
            x[i] = CM_SELECT(good, r.x, CM_NOT_A_NUMBER);                                          \
            y[i] = CM_SELECT(good, r.y, CM_NOT_A_NUMBER);                                          \
            z[i] = CM_SELECT(good, r.z, CM_NOT_A_NUMBER);                                          \
        }                                                                                          \
    }

CM_PROJECTION(cube)

#define CM_DESCRIPTORS
#define CM_SPHERE(id, ...) CM_PROJECTION(id)
/* A loop over a kernel, for one variant, which is a constant in it, so that it has no branch. */
#define CM_WARP_LOOPS(name, id, which)                                                             \
    static void warp_##name(size_t n, CM_REAL *restrict a, CM_REAL *restrict b,                    \
                            const CM_NAME(cm_constants) *constants)                                \
    {                                                                                              \
        CM_NAME(cm_constants) k = *constants;                                                      \
        k.variant = (CM_REAL)which;                                                                \
        for (size_t i = 0; i < n; i++)                                                             \
        {                                                                                          \
            CM_NAME(cm_uv) r = CM_NAME(cm_##id##_forward)(a[i], b[i], k);                          \
            a[i] = r.u;                                                                            \
            b[i] = r.v;                                                                            \
        }                                                                                          \
    }                                                                                              \
    static void unwarp_##name(size_t n, CM_REAL *restrict a, CM_REAL *restrict b,                  \
                              const CM_NAME(cm_constants) *constants)                              \
    {                                                                                              \
        CM_NAME(cm_constants) k = *constants;                                                      \
        k.variant = (CM_REAL)which;                                                                \
        for (size_t i = 0; i < n; i++)                                                             \
        {                                                                                          \
            CM_NAME(cm_pq) r = CM_NAME(cm_##id##_inverse)(a[i], b[i], k);                          \
            a[i] = r.p;                                                                            \
            b[i] = r.q;                                                                            \
        }                                                                                          \
    }
#define CM_WARP(id, ...) CM_WARP_LOOPS(id, id, 0)
#define CM_WARP_VARIANTS(id, ...)                                                                  \
    CM_WARP_LOOPS(id##_0, id, 0)                                                                   \
    CM_WARP_LOOPS(id##_1, id, 1)                                                                   \
    static void warp_##id(size_t n, CM_REAL *restrict a, CM_REAL *restrict b,                      \
                          const CM_NAME(cm_constants) *k)                                          \
    {                                                                                              \
        (k->variant == CM_LIT(0.0) ? warp_##id##_0 : warp_##id##_1)(n, a, b, k);                   \
    }                                                                                              \
    static void unwarp_##id(size_t n, CM_REAL *restrict a, CM_REAL *restrict b,                    \
                            const CM_NAME(cm_constants) *k)                                        \
    {                                                                                              \
        (k->variant == CM_LIT(0.0) ? unwarp_##id##_0 : unwarp_##id##_1)(n, a, b, k);               \
    }
#include <cubemap/kernel/catalogue.h>
#undef CM_SPHERE
#undef CM_WARP
#undef CM_WARP_VARIANTS
#undef CM_WARP_LOOPS

#define CM_SPHERE(id, ...) {project_##id, unproject_##id, NULL, NULL},
#define CM_WARP(id, ...) {project_cube, unproject_cube, warp_##id, unwarp_##id},

const CM_NAME(cm_kernels) CM_NAME(cm_kernel_table)[] = {
#include <cubemap/kernel/catalogue.h>
};

/* ---- Blocks ---- */

typedef struct block
{
    CM_REAL face[CM_BLOCK];
    CM_REAL a[CM_BLOCK];
    CM_REAL b[CM_BLOCK];
} block;

static const CM_NAME(cm_kernels) *kernels_of(const cm_mapping *mapping)
{
    return &CM_NAME(cm_kernel_table)[mapping->index];
}

/* from geo to the frame */
static void turn_block(const cm_turn *turn, size_t n, block *points)
{
    for (size_t i = 0; i < n; i++)
    {
        if (points->face[i] < CM_LIT(5.5))
        {
            int g = (int)points->face[i];
            CM_REAL a = points->a[i];
            CM_REAL b = points->b[i];
            points->face[i] = (CM_REAL)turn->face[g];
            points->a[i] = (CM_REAL)turn->sign_u[g] * (turn->swap[g] ? b : a);
            points->b[i] = (CM_REAL)turn->sign_v[g] * (turn->swap[g] ? a : b);
        }
    }
}

/* from the frame to geo */
static void turn_back_block(const cm_turn *turn, size_t n, block *points)
{
    for (size_t i = 0; i < n; i++)
    {
        if (points->face[i] < CM_LIT(5.5))
        {
            int g = turn->geo_face[(int)points->face[i]];
            CM_REAL a = (CM_REAL)turn->sign_u[g] * points->a[i];
            CM_REAL b = (CM_REAL)turn->sign_v[g] * points->b[i];
            points->face[i] = (CM_REAL)g;
            points->a[i] = turn->swap[g] ? b : a;
            points->b[i] = turn->swap[g] ? a : b;
        }
    }
}

static void forward_block(const cm_mapping *mapping, size_t n, const CM_REAL *x, const CM_REAL *y,
                          const CM_REAL *z, uint8_t *face, CM_REAL *u, CM_REAL *v)
{
    const CM_NAME(cm_kernels) *kernels = kernels_of(mapping);
    block points;
    kernels->project(n, x, y, z, points.face, points.a, points.b);
    if (!mapping->turn.identity)
    {
        turn_block(&mapping->turn, n, &points);
    }
    if (kernels->warp != NULL)
    {
        kernels->warp(n, points.a, points.b, &mapping->CM_NAME(constants));
    }
    for (size_t i = 0; i < n; i++)
    {
        CM_BOOL good = points.face[i] < CM_LIT(5.5);
        face[i] = (uint8_t)(int)points.face[i];
        u[i] = CM_SELECT(good, points.a[i], CM_NOT_A_NUMBER);
        v[i] = CM_SELECT(good, points.b[i], CM_NOT_A_NUMBER);
    }
}

/* A coordinate on a face that is nearly inside is put on the edge. */
static CM_REAL clamp(CM_REAL w)
{
    return cm_min(cm_max(w, CM_LIT(-1.0)), CM_LIT(1.0));
}

static CM_BOOL near_face(CM_REAL a, CM_REAL b)
{
    return (cm_abs(a) <= CM_LIT(1.0) + CM_TOLERANCE) & (cm_abs(b) <= CM_LIT(1.0) + CM_TOLERANCE);
}

static void inverse_block(const cm_mapping *mapping, size_t n, const uint8_t *face,
                          const CM_REAL *u, const CM_REAL *v, CM_REAL *x, CM_REAL *y, CM_REAL *z)
{
    const CM_NAME(cm_kernels) *kernels = kernels_of(mapping);
    block points;
    for (size_t i = 0; i < n; i++)
    {
        CM_BOOL good = (face[i] < 6) & near_face(u[i], v[i]);
        points.face[i] = CM_SELECT(good, (CM_REAL)face[i], (CM_REAL)CM_NO_FACE);
        points.a[i] = CM_SELECT(good, clamp(u[i]), CM_LIT(0.0));
        points.b[i] = CM_SELECT(good, clamp(v[i]), CM_LIT(0.0));
    }
    if (kernels->unwarp != NULL)
    {
        kernels->unwarp(n, points.a, points.b, &mapping->CM_NAME(constants));
    }
    if (!mapping->turn.identity)
    {
        turn_back_block(&mapping->turn, n, &points);
    }
    kernels->unproject(n, points.face, points.a, points.b, x, y, z);
}

/* ---- Public functions, documented in <cubemap/mapping.h> ---- */

void CM_PUBLIC(cm_forward_array)(const cm_mapping *mapping, size_t n, const CM_REAL *x,
                                 const CM_REAL *y, const CM_REAL *z, uint8_t *face, CM_REAL *u,
                                 CM_REAL *v)
{
    for (size_t done = 0; done < n; done += CM_BLOCK)
    {
        size_t count = n - done < CM_BLOCK ? n - done : CM_BLOCK;
        forward_block(mapping, count, x + done, y + done, z + done, face + done, u + done,
                      v + done);
    }
}

void CM_PUBLIC(cm_inverse_array)(const cm_mapping *mapping, size_t n, const uint8_t *face,
                                 const CM_REAL *u, const CM_REAL *v, CM_REAL *x, CM_REAL *y,
                                 CM_REAL *z)
{
    for (size_t done = 0; done < n; done += CM_BLOCK)
    {
        size_t count = n - done < CM_BLOCK ? n - done : CM_BLOCK;
        inverse_block(mapping, count, face + done, u + done, v + done, x + done, y + done,
                      z + done);
    }
}

void CM_PUBLIC(cm_forward_strided)(const cm_mapping *mapping, size_t n, const CM_REAL *xyz,
                                   ptrdiff_t stride, uint8_t *face, CM_REAL *u, CM_REAL *v)
{
    CM_REAL x[CM_BLOCK];
    CM_REAL y[CM_BLOCK];
    CM_REAL z[CM_BLOCK];
    for (size_t done = 0; done < n; done += CM_BLOCK)
    {
        size_t count = n - done < CM_BLOCK ? n - done : CM_BLOCK;
        for (size_t i = 0; i < count; i++)
        {
            const CM_REAL *point = xyz + (ptrdiff_t)(done + i) * stride;
            x[i] = point[0];
            y[i] = point[1];
            z[i] = point[2];
        }
        forward_block(mapping, count, x, y, z, face + done, u + done, v + done);
    }
}

void CM_PUBLIC(cm_inverse_strided)(const cm_mapping *mapping, size_t n, const uint8_t *face,
                                   const CM_REAL *u, const CM_REAL *v, CM_REAL *xyz,
                                   ptrdiff_t stride)
{
    CM_REAL x[CM_BLOCK];
    CM_REAL y[CM_BLOCK];
    CM_REAL z[CM_BLOCK];
    for (size_t done = 0; done < n; done += CM_BLOCK)
    {
        size_t count = n - done < CM_BLOCK ? n - done : CM_BLOCK;
        inverse_block(mapping, count, face + done, u + done, v + done, x, y, z);
        for (size_t i = 0; i < count; i++)
        {
            CM_REAL *point = xyz + (ptrdiff_t)(done + i) * stride;
            point[0] = x[i];
            point[1] = y[i];
            point[2] = z[i];
        }
    }
}

uint8_t CM_PUBLIC(cm_forward)(const cm_mapping *mapping, const CM_REAL direction[3], CM_REAL uv[2])
{
    uint8_t face;
    forward_block(mapping, 1, &direction[0], &direction[1], &direction[2], &face, &uv[0], &uv[1]);
    return face;
}

void CM_PUBLIC(cm_inverse)(const cm_mapping *mapping, uint8_t face, const CM_REAL uv[2],
                           CM_REAL direction[3])
{
    inverse_block(mapping, 1, &face, &uv[0], &uv[1], &direction[0], &direction[1], &direction[2]);
}

static cm_status warp_point(void (*warp)(size_t, CM_REAL *, CM_REAL *,
                                         const CM_NAME(cm_constants) *),
                            const cm_mapping *mapping, const CM_REAL from[2], CM_REAL to[2])
{
    if (warp == NULL)
    {
        return CM_ERROR_UNSUPPORTED;
    }
    CM_BOOL good = near_face(from[0], from[1]);
    CM_REAL a = clamp(from[0]);
    CM_REAL b = clamp(from[1]);
    warp(1, &a, &b, &mapping->CM_NAME(constants));
    to[0] = CM_SELECT(good, a, CM_NOT_A_NUMBER);
    to[1] = CM_SELECT(good, b, CM_NOT_A_NUMBER);
    return CM_OK;
}

cm_status CM_PUBLIC(cm_warp)(const cm_mapping *mapping, const CM_REAL pq[2], CM_REAL uv[2])
{
    return warp_point(kernels_of(mapping)->warp, mapping, pq, uv);
}

cm_status CM_PUBLIC(cm_unwarp)(const cm_mapping *mapping, const CM_REAL uv[2], CM_REAL pq[2])
{
    return warp_point(kernels_of(mapping)->unwarp, mapping, uv, pq);
}
