/* SPDX-License-Identifier: MIT
 *
 * The loops over the kernels, for one instruction set and one precision: whole vectors of points from
 * array to array. Read by batch_set.h and batch_precision.h, which have defined the dialect's words and those
 * of lanes/, and which numbers the arrays hold: LANES_IO, read and written by lanes_read and lanes_write.
 * These and the names are undefined at the end. n is a multiple of LANES here; precision.h cares for the
 * rest.
 *
 * A point takes the same way in every function: project (direction to face and coordinates), turn
 * (from geo to the mapping's frame), warp; and back. A vector is read whole before it is written, so
 * that an output may be an input.
 */
#if defined(__GNUC__)
#define BATCH_FN static inline __attribute__((always_inline))
#else
#define BATCH_FN static inline
#endif

BATCH_FN CM_BOOL BATCH_NAME(batch_is_near_face)(CM_REAL a, CM_REAL b)
{
    CM_REAL limit = CM_LIT(1.0) + CM_LIT(1.0e-9);
    return cm_both(cm_at_least(limit, cm_abs(a)), cm_at_least(limit, cm_abs(b)));
}

/* A coordinate on a face that is nearly inside is put on the edge. */
BATCH_FN CM_REAL BATCH_NAME(batch_clamp)(CM_REAL w)
{
    return cm_min(cm_max(w, CM_LIT(-1.0)), CM_LIT(1.0));
}

/* from geo to the frame */
BATCH_FN CM_NAME(cm_face_point) BATCH_NAME(batch_turn)(const cm_turn *turn,
                                                       CM_NAME(cm_face_point) p)
{
    if (turn->identity)
    {
        return p;
    }
    LANES_INDEX index = lanes_index(p.face);
    CM_BOOL swap = lanes_bit(turn->swap_bits, index);
    CM_NAME(cm_face_point) r;
    r.a = lanes_flip(CM_SELECT(swap, p.b, p.a), turn->minus_u_bits, index);
    r.b = lanes_flip(CM_SELECT(swap, p.a, p.b), turn->minus_v_bits, index);
    r.face = lanes_digit(turn->face_digits, index);
    return r;
}

/* from the frame to geo */
BATCH_FN CM_NAME(cm_face_point) BATCH_NAME(batch_turn_back)(const cm_turn *turn,
                                                            CM_NAME(cm_face_point) p)
{
    if (turn->identity)
    {
        return p;
    }
    LANES_INDEX index = lanes_index(p.face);
    CM_BOOL swap = lanes_bit(turn->swap_back_bits, index);
    CM_REAL a = lanes_flip(p.a, turn->minus_u_back_bits, index);
    CM_REAL b = lanes_flip(p.b, turn->minus_v_back_bits, index);
    CM_NAME(cm_face_point) r;
    r.a = CM_SELECT(swap, b, a);
    r.b = CM_SELECT(swap, a, b);
    r.face = lanes_digit(turn->geo_face_digits, index);
    return r;
}

/* A pair of derivatives by, or of, the two coordinates of a face, as batch_turn has the coordinates. */
BATCH_FN void BATCH_NAME(batch_turn_pair)(uint64_t swap_bits, uint64_t minus_u_bits,
                                          uint64_t minus_v_bits, CM_REAL face, CM_REAL *a,
                                          CM_REAL *b)
{
    LANES_INDEX index = lanes_index(face);
    CM_BOOL swap = lanes_bit(swap_bits, index);
    CM_REAL first = CM_SELECT(swap, *b, *a);
    CM_REAL second = CM_SELECT(swap, *a, *b);
    *a = lanes_flip(first, minus_u_bits, index);
    *b = lanes_flip(second, minus_v_bits, index);
}

/* face of geo */
BATCH_FN CM_NAME(cm_gradients) BATCH_NAME(batch_turn_gradients)(const cm_turn *t, CM_REAL face,
                                                                CM_NAME(cm_gradients) g)
{
    if (!t->identity)
    {
        BATCH_NAME(batch_turn_pair)
        (t->swap_bits, t->minus_u_bits, t->minus_v_bits, face, &g.a_x, &g.b_x);
        BATCH_NAME(batch_turn_pair)
        (t->swap_bits, t->minus_u_bits, t->minus_v_bits, face, &g.a_y, &g.b_y);
        BATCH_NAME(batch_turn_pair)
        (t->swap_bits, t->minus_u_bits, t->minus_v_bits, face, &g.a_z, &g.b_z);
    }
    return g;
}

/* face of the frame */
BATCH_FN CM_NAME(cm_tangents) BATCH_NAME(batch_turn_tangents)(const cm_turn *t, CM_REAL face,
                                                              CM_NAME(cm_tangents) d)
{
    if (!t->identity)
    {
        BATCH_NAME(batch_turn_pair)
        (t->swap_back_bits, t->minus_u_back_bits, t->minus_v_back_bits, face, &d.x_a, &d.x_b);
        BATCH_NAME(batch_turn_pair)
        (t->swap_back_bits, t->minus_u_back_bits, t->minus_v_back_bits, face, &d.y_a, &d.y_b);
        BATCH_NAME(batch_turn_pair)
        (t->swap_back_bits, t->minus_u_back_bits, t->minus_v_back_bits, face, &d.z_a, &d.z_b);
    }
    return d;
}

/* Faces have numbers below this. */
BATCH_FN CM_REAL BATCH_NAME(batch_last_face)(const cm_mapping *mapping)
{
    return mapping->info->kind == CM_KIND_CUBE ? lanes_all((LANES_SCALAR)5.5)
                                               : lanes_all((LANES_SCALAR)0.5);
}

/* What is no point of a map becomes NaN here, and stays it on all ways to a direction. */
BATCH_FN CM_NAME(cm_face_point) BATCH_NAME(batch_load_map)(CM_REAL last_face, const uint8_t *face,
                                                           const LANES_IO *u, const LANES_IO *v)
{
    CM_REAL a = lanes_read(u);
    CM_REAL b = lanes_read(v);
    CM_NAME(cm_face_point) point;
    point.face = lanes_load_faces(face);
    CM_BOOL good = cm_both(cm_less(point.face, last_face), BATCH_NAME(batch_is_near_face)(a, b));
    point.a = lanes_or_nan(good, BATCH_NAME(batch_clamp)(a));
    point.b = lanes_or_nan(good, BATCH_NAME(batch_clamp)(b));
    return point;
}

BATCH_FN void BATCH_NAME(batch_store_map)(CM_BOOL good, CM_NAME(cm_face_point) p, uint8_t *face,
                                          LANES_IO *u, LANES_IO *v)
{
    lanes_store_faces(face, CM_SELECT(good, p.face, CM_LIT(255.0)));
    lanes_write(u, lanes_or_nan(good, p.a));
    lanes_write(v, lanes_or_nan(good, p.b));
}

/* ---- The loops. They are inlined with kernels that are constants, so that no call is left ---- */

/* Projections between the sphere and faces, which have no use for the constants if warps follow. */
typedef CM_NAME(cm_face_point) (*BATCH_NAME(batch_project))(CM_REAL x, CM_REAL y, CM_REAL z,
                                                            CM_NAME(cm_constants) k);
typedef CM_NAME(cm_xyz) (*BATCH_NAME(batch_unproject))(CM_REAL face, CM_REAL a, CM_REAL b,
                                                       CM_NAME(cm_constants) k);
typedef CM_NAME(cm_uv) (*BATCH_NAME(batch_warp))(CM_REAL p, CM_REAL q, CM_NAME(cm_constants) k);
typedef CM_NAME(cm_pq) (*BATCH_NAME(batch_unwarp))(CM_REAL u, CM_REAL v, CM_NAME(cm_constants) k);

BATCH_FN void BATCH_NAME(batch_forward)(BATCH_NAME(batch_project) project,
                                        BATCH_NAME(batch_warp) warp, CM_REAL variant,
                                        const cm_mapping *mapping, size_t n, const LANES_IO *x,
                                        const LANES_IO *y, const LANES_IO *z, uint8_t *face,
                                        LANES_IO *u, LANES_IO *v)
{
    CM_NAME(cm_constants) k = CM_NAME(lanes_constants)(mapping);
    k.variant = variant;
    for (size_t i = 0; i < n; i += LANES)
    {
        CM_REAL dx = lanes_read(x + i);
        CM_REAL dy = lanes_read(y + i);
        CM_REAL dz = lanes_read(z + i);
        CM_BOOL good = CM_NAME(lanes_is_direction)(dx, dy, dz);
        CM_NAME(cm_face_point) p = BATCH_NAME(batch_turn)(&mapping->turn, project(dx, dy, dz, k));
        if (warp != NULL)
        {
            CM_NAME(cm_uv) uv = warp(p.a, p.b, k);
            p.a = uv.u;
            p.b = uv.v;
        }
        BATCH_NAME(batch_store_map)(good, p, face + i, u + i, v + i);
    }
}

BATCH_FN void BATCH_NAME(batch_inverse)(BATCH_NAME(batch_unproject) unproject,
                                        BATCH_NAME(batch_unwarp) unwarp, CM_REAL variant,
                                        const cm_mapping *mapping, size_t n, const uint8_t *face,
                                        const LANES_IO *u, const LANES_IO *v, LANES_IO *x,
                                        LANES_IO *y, LANES_IO *z)
{
    CM_NAME(cm_constants) k = CM_NAME(lanes_constants)(mapping);
    k.variant = variant;
    CM_REAL last = BATCH_NAME(batch_last_face)(mapping);
    for (size_t i = 0; i < n; i += LANES)
    {
        CM_NAME(cm_face_point) p = BATCH_NAME(batch_load_map)(last, face + i, u + i, v + i);
        if (unwarp != NULL)
        {
            CM_NAME(cm_pq) pq = unwarp(p.a, p.b, k);
            p.a = pq.p;
            p.b = pq.q;
        }
        p = BATCH_NAME(batch_turn_back)(&mapping->turn, p);
        CM_NAME(cm_xyz) d = unproject(p.face, p.a, p.b, k);
        lanes_write(x + i, d.x);
        lanes_write(y + i, d.y);
        lanes_write(z + i, d.z);
    }
}

typedef CM_NAME(cm_gradients) (*BATCH_NAME(batch_gradients))(CM_REAL x, CM_REAL y, CM_REAL z,
                                                             CM_NAME(cm_constants) k);
typedef CM_NAME(cm_tangents) (*BATCH_NAME(batch_tangents))(CM_REAL face, CM_REAL a, CM_REAL b,
                                                           CM_NAME(cm_constants) k);
typedef CM_NAME(cm_jacobian) (*BATCH_NAME(batch_jacobian))(CM_REAL p, CM_REAL q, CM_REAL u,
                                                           CM_REAL v, CM_NAME(cm_constants) k);

BATCH_FN void BATCH_NAME(batch_forward_jacobian)(BATCH_NAME(batch_project) project,
                                                 BATCH_NAME(batch_gradients) gradients,
                                                 BATCH_NAME(batch_warp) warp,
                                                 BATCH_NAME(batch_jacobian) jacobian,
                                                 CM_REAL variant, const cm_mapping *mapping,
                                                 size_t n, const LANES_IO *x, const LANES_IO *y,
                                                 const LANES_IO *z, LANES_IO *const to[6])
{
    CM_NAME(cm_constants) k = CM_NAME(lanes_constants)(mapping);
    k.variant = variant;
    for (size_t i = 0; i < n; i += LANES)
    {
        CM_REAL dx = lanes_read(x + i);
        CM_REAL dy = lanes_read(y + i);
        CM_REAL dz = lanes_read(z + i);
        CM_BOOL good = CM_NAME(lanes_is_direction)(dx, dy, dz);
        CM_NAME(cm_face_point) geo = project(dx, dy, dz, k);
        CM_NAME(cm_gradients) g = gradients(dx, dy, dz, k);
        g = BATCH_NAME(batch_turn_gradients)(&mapping->turn, geo.face, g);
        if (warp != NULL)
        {
            CM_NAME(cm_face_point) p = BATCH_NAME(batch_turn)(&mapping->turn, geo);
            CM_NAME(cm_uv) uv = warp(p.a, p.b, k);
            g = CM_NAME(cm_jacobian_gradients)(jacobian(p.a, p.b, uv.u, uv.v, k), g);
        }
        lanes_write(to[0] + i, lanes_or_nan(good, g.a_x));
        lanes_write(to[1] + i, lanes_or_nan(good, g.a_y));
        lanes_write(to[2] + i, lanes_or_nan(good, g.a_z));
        lanes_write(to[3] + i, lanes_or_nan(good, g.b_x));
        lanes_write(to[4] + i, lanes_or_nan(good, g.b_y));
        lanes_write(to[5] + i, lanes_or_nan(good, g.b_z));
    }
}

BATCH_FN void BATCH_NAME(batch_inverse_jacobian)(BATCH_NAME(batch_tangents) tangents,
                                                 BATCH_NAME(batch_unwarp) unwarp,
                                                 BATCH_NAME(batch_jacobian) jacobian,
                                                 CM_REAL variant, const cm_mapping *mapping,
                                                 size_t n, const uint8_t *face, const LANES_IO *u,
                                                 const LANES_IO *v, LANES_IO *const to[6])
{
    CM_NAME(cm_constants) k = CM_NAME(lanes_constants)(mapping);
    k.variant = variant;
    CM_REAL last = BATCH_NAME(batch_last_face)(mapping);
    for (size_t i = 0; i < n; i += LANES)
    {
        CM_NAME(cm_face_point) uv = BATCH_NAME(batch_load_map)(last, face + i, u + i, v + i);
        CM_BOOL good = cm_equal(uv.a, uv.a);
        CM_NAME(cm_face_point) p = uv;
        if (unwarp != NULL)
        {
            CM_NAME(cm_pq) pq = unwarp(uv.a, uv.b, k);
            p.a = pq.p;
            p.b = pq.q;
        }
        CM_NAME(cm_face_point) geo = BATCH_NAME(batch_turn_back)(&mapping->turn, p);
        CM_NAME(cm_tangents) d = tangents(geo.face, geo.a, geo.b, k);
        d = BATCH_NAME(batch_turn_tangents)(&mapping->turn, uv.face, d);
        if (unwarp != NULL)
        {
            d = CM_NAME(cm_jacobian_tangents)(jacobian(p.a, p.b, uv.a, uv.b, k), d);
        }
        lanes_write(to[0] + i, lanes_or_nan(good, d.x_a));
        lanes_write(to[1] + i, lanes_or_nan(good, d.x_b));
        lanes_write(to[2] + i, lanes_or_nan(good, d.y_a));
        lanes_write(to[3] + i, lanes_or_nan(good, d.y_b));
        lanes_write(to[4] + i, lanes_or_nan(good, d.z_a));
        lanes_write(to[5] + i, lanes_or_nan(good, d.z_b));
    }
}

/* The warp alone, in place, NaN where there is no point of a face; only one of the two kernels is
 * given. */
BATCH_FN void BATCH_NAME(batch_warp_only)(BATCH_NAME(batch_warp) warp,
                                          BATCH_NAME(batch_unwarp) unwarp, CM_REAL variant,
                                          const cm_mapping *mapping, size_t n, LANES_IO *a,
                                          LANES_IO *b)
{
    CM_NAME(cm_constants) k = CM_NAME(lanes_constants)(mapping);
    k.variant = variant;
    for (size_t i = 0; i < n; i += LANES)
    {
        CM_REAL first = lanes_read(a + i);
        CM_REAL second = lanes_read(b + i);
        CM_BOOL good = BATCH_NAME(batch_is_near_face)(first, second);
        CM_NAME(cm_uv) r = {BATCH_NAME(batch_clamp)(first), BATCH_NAME(batch_clamp)(second)};
        if (warp != NULL)
        {
            r = warp(r.u, r.v, k);
        }
        else
        {
            CM_NAME(cm_pq) pq = unwarp(r.u, r.v, k);
            r.u = pq.p;
            r.v = pq.q;
        }
        lanes_write(a + i, lanes_or_nan(good, r.u));
        lanes_write(b + i, lanes_or_nan(good, r.v));
    }
}

/* The derivatives of the warp alone, by rows. */
BATCH_FN void BATCH_NAME(batch_warp_jacobian)(BATCH_NAME(batch_warp) warp,
                                              BATCH_NAME(batch_jacobian) jacobian, CM_REAL variant,
                                              const cm_mapping *mapping, size_t n,
                                              const LANES_IO *p, const LANES_IO *q,
                                              LANES_IO *const to[4])
{
    CM_NAME(cm_constants) k = CM_NAME(lanes_constants)(mapping);
    k.variant = variant;
    for (size_t i = 0; i < n; i += LANES)
    {
        CM_REAL first = lanes_read(p + i);
        CM_REAL second = lanes_read(q + i);
        CM_BOOL good = BATCH_NAME(batch_is_near_face)(first, second);
        first = BATCH_NAME(batch_clamp)(first);
        second = BATCH_NAME(batch_clamp)(second);
        CM_NAME(cm_uv) uv = warp(first, second, k);
        CM_NAME(cm_jacobian) j = jacobian(first, second, uv.u, uv.v, k);
        lanes_write(to[0] + i, lanes_or_nan(good, j.u_p));
        lanes_write(to[1] + i, lanes_or_nan(good, j.u_q));
        lanes_write(to[2] + i, lanes_or_nan(good, j.v_p));
        lanes_write(to[3] + i, lanes_or_nan(good, j.v_q));
    }
}

/* ---- One set of loops for each mapping; of the fast tier the maps alone ---- */

#define BATCH_MAPS(name, projection, warp, unwarp, which)                                          \
    static void BATCH_NAME(forward_##name)(const cm_mapping *mapping, size_t n, const LANES_IO *x, \
                                           const LANES_IO *y, const LANES_IO *z, uint8_t *face,    \
                                           LANES_IO *u, LANES_IO *v)                               \
    {                                                                                              \
        BATCH_NAME(batch_forward)                                                                  \
        (BATCH_NAME(projection##_project), warp, CM_LIT(which), mapping, n, x, y, z, face, u, v);  \
    }                                                                                              \
    static void BATCH_NAME(inverse_##name)(                                                        \
        const cm_mapping *mapping, size_t n, const uint8_t *face, const LANES_IO *u,               \
        const LANES_IO *v, LANES_IO *x, LANES_IO *y, LANES_IO *z)                                  \
    {                                                                                              \
        BATCH_NAME(batch_inverse)                                                                  \
        (BATCH_NAME(projection##_unproject), unwarp, CM_LIT(which), mapping, n, face, u, v, x, y,  \
         z);                                                                                       \
    }

#ifdef BATCH_MAPS_ONLY
#define BATCH_JACOBIANS(name, projection, warp, unwarp, jacobian, which)
#define BATCH_WARPS(name, id, which)
#else
#define BATCH_JACOBIANS(name, projection, warp, unwarp, jacobian, which)                           \
    static void BATCH_NAME(forward_jacobian_##name)(const cm_mapping *mapping, size_t n,           \
                                                    const LANES_IO *x, const LANES_IO *y,          \
                                                    const LANES_IO *z, LANES_IO *const to[6])      \
    {                                                                                              \
        BATCH_NAME(batch_forward_jacobian)                                                         \
        (BATCH_NAME(projection##_project), BATCH_NAME(projection##_gradients), warp, jacobian,     \
         CM_LIT(which), mapping, n, x, y, z, to);                                                  \
    }                                                                                              \
    static void BATCH_NAME(inverse_jacobian_##name)(const cm_mapping *mapping, size_t n,           \
                                                    const uint8_t *face, const LANES_IO *u,        \
                                                    const LANES_IO *v, LANES_IO *const to[6])      \
    {                                                                                              \
        BATCH_NAME(batch_inverse_jacobian)                                                         \
        (BATCH_NAME(projection##_tangents), unwarp, jacobian, CM_LIT(which), mapping, n, face, u,  \
         v, to);                                                                                   \
    }
#define BATCH_WARPS(name, id, which)                                                               \
    static void BATCH_NAME(warp_##name)(const cm_mapping *mapping, size_t n, LANES_IO *p,          \
                                        LANES_IO *q)                                               \
    {                                                                                              \
        BATCH_NAME(batch_warp_only)                                                                \
        (CM_NAME(cm_##id##_forward), NULL, CM_LIT(which), mapping, n, p, q);                       \
    }                                                                                              \
    static void BATCH_NAME(unwarp_##name)(const cm_mapping *mapping, size_t n, LANES_IO *u,        \
                                          LANES_IO *v)                                             \
    {                                                                                              \
        BATCH_NAME(batch_warp_only)                                                                \
        (NULL, CM_NAME(cm_##id##_inverse), CM_LIT(which), mapping, n, u, v);                       \
    }                                                                                              \
    static void BATCH_NAME(warp_jacobian_##name)(const cm_mapping *mapping, size_t n,              \
                                                 const LANES_IO *p, const LANES_IO *q,             \
                                                 LANES_IO *const to[4])                            \
    {                                                                                              \
        BATCH_NAME(batch_warp_jacobian)                                                            \
        (CM_NAME(cm_##id##_forward), CM_NAME(cm_##id##_jacobian), CM_LIT(which), mapping, n, p, q, \
         to);                                                                                      \
    }
#endif

#define BATCH_WARP_LOOPS(name, id, which)                                                          \
    BATCH_MAPS(name, cube, CM_NAME(cm_##id##_forward), CM_NAME(cm_##id##_inverse), which)          \
    BATCH_JACOBIANS(name, cube, CM_NAME(cm_##id##_forward), CM_NAME(cm_##id##_inverse),            \
                    CM_NAME(cm_##id##_jacobian), which)                                            \
    BATCH_WARPS(name, id, which)

/* A projection under names of these loops; with its constants, or with none to take. */
#define BATCH_PROJECTION(id, ...)                                                                  \
    BATCH_FN CM_NAME(cm_face_point) BATCH_NAME(id##_project)(CM_REAL x, CM_REAL y, CM_REAL z,      \
                                                             CM_NAME(cm_constants) k)              \
    {                                                                                              \
        (void)k;                                                                                   \
        return CM_NAME(cm_##id##_project)(x, y, z __VA_ARGS__);                                    \
    }                                                                                              \
    BATCH_FN CM_NAME(cm_xyz) BATCH_NAME(id##_unproject)(CM_REAL face, CM_REAL a, CM_REAL b,        \
                                                        CM_NAME(cm_constants) k)                   \
    {                                                                                              \
        (void)k;                                                                                   \
        return CM_NAME(cm_##id##_unproject)(face, a, b __VA_ARGS__);                               \
    }
#define BATCH_PROJECTION_SLOPES(id, ...)                                                           \
    BATCH_FN CM_NAME(cm_gradients) BATCH_NAME(id##_gradients)(CM_REAL x, CM_REAL y, CM_REAL z,     \
                                                              CM_NAME(cm_constants) k)             \
    {                                                                                              \
        (void)k;                                                                                   \
        return CM_NAME(cm_##id##_gradients)(x, y, z __VA_ARGS__);                                  \
    }                                                                                              \
    BATCH_FN CM_NAME(cm_tangents) BATCH_NAME(id##_tangents)(CM_REAL face, CM_REAL a, CM_REAL b,    \
                                                            CM_NAME(cm_constants) k)               \
    {                                                                                              \
        (void)k;                                                                                   \
        return CM_NAME(cm_##id##_tangents)(face, a, b __VA_ARGS__);                                \
    }
#ifdef BATCH_MAPS_ONLY
#undef BATCH_PROJECTION_SLOPES
#define BATCH_PROJECTION_SLOPES(id, ...)
#endif
#define BATCH_NONE
#define BATCH_THOSE , k

BATCH_PROJECTION(cube, BATCH_NONE)
BATCH_PROJECTION_SLOPES(cube, BATCH_NONE)

#define CM_DESCRIPTORS
#define CM_CHART(...)
#define BATCH_SPHERE_LOOPS(id, ...)                                                                \
    BATCH_PROJECTION(id, __VA_ARGS__)                                                              \
    BATCH_PROJECTION_SLOPES(id, __VA_ARGS__)                                                       \
    BATCH_MAPS(id##_0, id, NULL, NULL, 0.0)                                                        \
    BATCH_JACOBIANS(id##_0, id, NULL, NULL, NULL, 0.0)
#define CM_SPHERE(id, ...) BATCH_SPHERE_LOOPS(id, BATCH_NONE)
#define CM_SPHERE_CONSTANTS(id, ...) BATCH_SPHERE_LOOPS(id, BATCH_THOSE)
#define CM_WARP(id, ...) BATCH_WARP_LOOPS(id##_0, id, 0.0)
#define CM_WARP_VARIANTS(id, ...)                                                                  \
    BATCH_WARP_LOOPS(id##_0, id, 0.0)                                                              \
    BATCH_WARP_LOOPS(id##_1, id, 1.0)
#include <cubemap/kernel/catalogue.h>
#undef CM_CHART
#undef CM_SPHERE
#undef CM_SPHERE_CONSTANTS
#undef CM_WARP
#undef CM_WARP_VARIANTS

#define BATCH_MAPS_ENTRY(name)                                                                     \
    .forward = BATCH_NAME(forward_##name), .inverse = BATCH_NAME(inverse_##name)
#ifdef BATCH_MAPS_ONLY
#define BATCH_SPHERE_ENTRY(name) BATCH_MAPS_ENTRY(name)
#define BATCH_ENTRY(name) BATCH_MAPS_ENTRY(name)
#else
#define BATCH_SPHERE_ENTRY(name)                                                                   \
    BATCH_MAPS_ENTRY(name), .forward_jacobian = BATCH_NAME(forward_jacobian_##name),               \
                            .inverse_jacobian = BATCH_NAME(inverse_jacobian_##name)
#define BATCH_ENTRY(name)                                                                          \
    BATCH_SPHERE_ENTRY(name), .warp = BATCH_NAME(warp_##name),                                     \
                              .unwarp = BATCH_NAME(unwarp_##name),                                 \
                              .warp_jacobian = BATCH_NAME(warp_jacobian_##name)
#endif
#define CM_CHART(...) {{{.forward = NULL}}},
#define CM_SPHERE(id, ...) {{{BATCH_SPHERE_ENTRY(id##_0)}}},
#define CM_SPHERE_CONSTANTS(id, ...) {{{BATCH_SPHERE_ENTRY(id##_0)}}},
#define CM_WARP(id, ...) {{{BATCH_ENTRY(id##_0)}}},
#define CM_WARP_VARIANTS(id, ...) {{{BATCH_ENTRY(id##_0)}, {BATCH_ENTRY(id##_1)}}},

static const BATCH_VARIANTS BATCH_NAME(batch_table)[] = {
#include <cubemap/kernel/catalogue.h>
};

#undef CM_CHART
#undef CM_SPHERE
#undef CM_SPHERE_CONSTANTS
#undef CM_WARP
#undef CM_WARP_VARIANTS
#undef CM_DESCRIPTORS
#undef BATCH_PROJECTION
#undef BATCH_PROJECTION_SLOPES
#undef BATCH_SPHERE_LOOPS
#undef BATCH_NONE
#undef BATCH_THOSE
#undef BATCH_MAPS
#undef BATCH_JACOBIANS
#undef BATCH_WARPS
#undef BATCH_WARP_LOOPS
#undef BATCH_MAPS_ENTRY
#undef BATCH_ENTRY
#undef BATCH_SPHERE_ENTRY
#undef BATCH_FN
#undef BATCH_MAPS_ONLY
#undef BATCH_NAME
#undef BATCH_VARIANTS
#undef LANES_IO
#undef lanes_read
#undef lanes_write
