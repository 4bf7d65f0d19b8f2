/* SPDX-License-Identifier: MIT
 *
 * The loops of maps that are made of parts, for one instruction set and one precision: azimuthal
 * projections, mappings between disc and square, and what joins them to images of the whole sphere. A part
 * goes from columns to columns over whole vectors; chart.h puts parts in a row. Read by
 * batch_precision.h before batch.h.
 */
#if defined(__GNUC__)
#define CHART_FN static inline __attribute__((always_inline))
#else
#define CHART_FN static inline
#endif

/* What is further outside than this, relative to the radius, is no point of a map; what is less so counts as
 * the rim. */
#if CM_LANES_BITS == 64
#define CHART_TOLERANCE 1.0e-9
#else
#define CHART_TOLERANCE 1.0e-6
#endif

typedef CM_NAME(cm_disc_point) (*BATCH_NAME(chart_project))(CM_REAL x, CM_REAL y, CM_REAL z,
                                                            CM_NAME(cm_constants) k);
typedef CM_NAME(cm_xyz) (*BATCH_NAME(chart_unproject))(CM_NAME(cm_disc_point) d,
                                                       CM_NAME(cm_constants) k);
typedef CM_NAME(cm_gradients) (*BATCH_NAME(chart_gradients))(CM_REAL x, CM_REAL y, CM_REAL z,
                                                             CM_NAME(cm_constants) k);
typedef CM_NAME(cm_tangents) (*BATCH_NAME(chart_tangents))(CM_NAME(cm_disc_point) d,
                                                           CM_NAME(cm_constants) k);
typedef CM_NAME(cm_uv) (*BATCH_NAME(chart_to_square))(CM_NAME(cm_disc_point) d);
typedef CM_NAME(cm_disc_point) (*BATCH_NAME(chart_to_disc))(CM_REAL x, CM_REAL y);
typedef CM_NAME(cm_jacobian) (*BATCH_NAME(chart_slopes))(CM_NAME(cm_disc_point) d, CM_REAL x,
                                                         CM_REAL y);

/* The columns of a disc's points. */
CHART_FN CM_NAME(cm_disc_point) BATCH_NAME(chart_load)(LANES_IO *const disc[CM_DISC_COLUMNS],
                                                       size_t i)
{
    CM_NAME(cm_disc_point) d;
    d.u = lanes_load(disc[0] + i);
    d.v = lanes_load(disc[1] + i);
    d.rim = lanes_load(disc[2] + i);
    d.gap = lanes_load(disc[3] + i);
    return d;
}

CHART_FN void BATCH_NAME(chart_store)(CM_NAME(cm_disc_point) d, CM_BOOL good,
                                      LANES_IO *const disc[CM_DISC_COLUMNS], size_t i)
{
    lanes_store(disc[0] + i, lanes_or_nan(good, d.u));
    lanes_store(disc[1] + i, lanes_or_nan(good, d.v));
    lanes_store(disc[2] + i, lanes_or_nan(good, d.rim));
    lanes_store(disc[3] + i, lanes_or_nan(good, d.gap));
}

/* ---- Directions: bad ones, other centres, the hemisphere of the antipode ---- */

typedef struct BATCH_NAME(chart_direction)
{
    CM_REAL x;
    CM_REAL y;
    CM_REAL z;
    CM_REAL side; /* -1 for the antipode's hemisphere, if that is folded onto the centre's */
    CM_BOOL good;
} BATCH_NAME(chart_direction);

/* The components along the axes of the centre, of a vector that they are turned from. */
CHART_FN void BATCH_NAME(chart_turn)(const cm_mapping *mapping, CM_REAL *x, CM_REAL *y, CM_REAL *z)
{
    if (mapping->is_turned)
    {
        const LANES_SCALAR *m = mapping->CM_SCALAR_NAME(axes);
        CM_REAL a = (lanes_all(m[0]) * *x + lanes_all(m[1]) * *y) + lanes_all(m[2]) * *z;
        CM_REAL b = (lanes_all(m[3]) * *x + lanes_all(m[4]) * *y) + lanes_all(m[5]) * *z;
        *z = (lanes_all(m[6]) * *x + lanes_all(m[7]) * *y) + lanes_all(m[8]) * *z;
        *x = a;
        *y = b;
    }
}

CHART_FN void BATCH_NAME(chart_turn_back)(const cm_mapping *mapping, CM_REAL *x, CM_REAL *y,
                                          CM_REAL *z)
{
    if (mapping->is_turned)
    {
        const LANES_SCALAR *m = mapping->CM_SCALAR_NAME(axes);
        CM_REAL a = (lanes_all(m[0]) * *x + lanes_all(m[3]) * *y) + lanes_all(m[6]) * *z;
        CM_REAL b = (lanes_all(m[1]) * *x + lanes_all(m[4]) * *y) + lanes_all(m[7]) * *z;
        *z = (lanes_all(m[2]) * *x + lanes_all(m[5]) * *y) + lanes_all(m[8]) * *z;
        *x = a;
        *y = b;
    }
}

CHART_FN BATCH_NAME(chart_direction)
    BATCH_NAME(chart_read)(const cm_mapping *mapping, CM_REAL x, CM_REAL y, CM_REAL z)
{
    CM_REAL zero = CM_LIT(0.0);
    BATCH_NAME(chart_direction) d;
    d.good = CM_NAME(lanes_is_direction)(x, y, z);
    CM_REAL scale = CM_NAME(cm_azimuthal_scale)(CM_NAME(cm_magnitude)(x, y, z));
    d.x = x * scale;
    d.y = y * scale;
    d.z = z * scale;
    BATCH_NAME(chart_turn)(mapping, &d.x, &d.y, &d.z);
    d.side = CM_LIT(1.0);
    if (mapping->is_folded)
    {
        d.side = CM_SELECT(cm_less(d.z, zero), CM_LIT(-1.0), CM_LIT(1.0));
        d.z = cm_abs(d.z);
    }
    return d;
}

/* ---- Azimuthal projections ---- */

CHART_FN void BATCH_NAME(chart_azimuthal_forward)(BATCH_NAME(chart_project) project,
                                                  const cm_mapping *mapping, size_t n,
                                                  const LANES_IO *x, const LANES_IO *y,
                                                  const LANES_IO *z,
                                                  LANES_IO *const disc[CM_DISC_COLUMNS])
{
    CM_NAME(cm_constants) k = CM_NAME(lanes_constants)(mapping);
    CM_REAL least = -((k.k0 * k.k0) * lanes_all((LANES_SCALAR)CHART_TOLERANCE));
    for (size_t i = 0; i < n; i += LANES)
    {
        BATCH_NAME(chart_direction)
        d = BATCH_NAME(chart_read)(mapping, lanes_load(x + i), lanes_load(y + i),
                                   lanes_load(z + i));
        CM_REAL margin = CM_NAME(cm_azimuthal_bearing)(d.x, d.y, d.z, k).t.margin;
        CM_BOOL good = cm_both(d.good, cm_at_least(margin, least));
        BATCH_NAME(chart_store)(project(d.x, d.y, d.z, k), good, disc, i);
        lanes_store(disc[4] + i, d.side);
    }
}

CHART_FN void BATCH_NAME(chart_azimuthal_inverse)(BATCH_NAME(chart_unproject) unproject,
                                                  const cm_mapping *mapping, size_t n,
                                                  LANES_IO *const disc[CM_DISC_COLUMNS],
                                                  LANES_IO *x, LANES_IO *y, LANES_IO *z)
{
    CM_NAME(cm_constants) k = CM_NAME(lanes_constants)(mapping);
    for (size_t i = 0; i < n; i += LANES)
    {
        CM_NAME(cm_xyz) d = unproject(BATCH_NAME(chart_load)(disc, i), k);
        d.z = d.z * lanes_load(disc[4] + i);
        BATCH_NAME(chart_turn_back)(mapping, &d.x, &d.y, &d.z);
        lanes_store(x + i, d.x);
        lanes_store(y + i, d.y);
        lanes_store(z + i, d.z);
    }
}

CHART_FN void BATCH_NAME(chart_azimuthal_gradients)(BATCH_NAME(chart_gradients) gradients,
                                                    const cm_mapping *mapping, size_t n,
                                                    const LANES_IO *x, const LANES_IO *y,
                                                    const LANES_IO *z, LANES_IO *const to[6])
{
    CM_NAME(cm_constants) k = CM_NAME(lanes_constants)(mapping);
    for (size_t i = 0; i < n; i += LANES)
    {
        BATCH_NAME(chart_direction)
        d = BATCH_NAME(chart_read)(mapping, lanes_load(x + i), lanes_load(y + i),
                                   lanes_load(z + i));
        CM_NAME(cm_gradients) g = gradients(d.x, d.y, d.z, k);
        g.a_z = g.a_z * d.side;
        g.b_z = g.b_z * d.side;
        BATCH_NAME(chart_turn_back)(mapping, &g.a_x, &g.a_y, &g.a_z);
        BATCH_NAME(chart_turn_back)(mapping, &g.b_x, &g.b_y, &g.b_z);
        lanes_store(to[0] + i, g.a_x);
        lanes_store(to[1] + i, g.a_y);
        lanes_store(to[2] + i, g.a_z);
        lanes_store(to[3] + i, g.b_x);
        lanes_store(to[4] + i, g.b_y);
        lanes_store(to[5] + i, g.b_z);
    }
}

CHART_FN void BATCH_NAME(chart_azimuthal_tangents)(BATCH_NAME(chart_tangents) tangents,
                                                   const cm_mapping *mapping, size_t n,
                                                   LANES_IO *const disc[CM_DISC_COLUMNS],
                                                   LANES_IO *const to[6])
{
    CM_NAME(cm_constants) k = CM_NAME(lanes_constants)(mapping);
    for (size_t i = 0; i < n; i += LANES)
    {
        CM_NAME(cm_tangents) t = tangents(BATCH_NAME(chart_load)(disc, i), k);
        CM_REAL side = lanes_load(disc[4] + i);
        t.z_a = t.z_a * side;
        t.z_b = t.z_b * side;
        BATCH_NAME(chart_turn_back)(mapping, &t.x_a, &t.y_a, &t.z_a);
        BATCH_NAME(chart_turn_back)(mapping, &t.x_b, &t.y_b, &t.z_b);
        lanes_store(to[0] + i, t.x_a);
        lanes_store(to[1] + i, t.x_b);
        lanes_store(to[2] + i, t.y_a);
        lanes_store(to[3] + i, t.y_b);
        lanes_store(to[4] + i, t.z_a);
        lanes_store(to[5] + i, t.z_b);
    }
}

/* ---- Disc and square ---- */

CHART_FN void BATCH_NAME(chart_square_forward)(BATCH_NAME(chart_to_square) to_square, size_t n,
                                               LANES_IO *const disc[CM_DISC_COLUMNS], LANES_IO *a,
                                               LANES_IO *b)
{
    for (size_t i = 0; i < n; i += LANES)
    {
        CM_NAME(cm_disc_point) d = BATCH_NAME(chart_load)(disc, i);
        CM_BOOL good = cm_equal(d.u, d.u);
        CM_NAME(cm_uv) r = to_square(d);
        lanes_store(a + i, lanes_or_nan(good, r.u));
        lanes_store(b + i, lanes_or_nan(good, r.v));
    }
}

CHART_FN void BATCH_NAME(chart_square_inverse)(BATCH_NAME(chart_to_disc) to_disc, size_t n,
                                               const LANES_IO *a, const LANES_IO *b,
                                               LANES_IO *const disc[CM_DISC_COLUMNS])
{
    for (size_t i = 0; i < n; i += LANES)
    {
        CM_REAL x = lanes_load(a + i);
        CM_REAL y = lanes_load(b + i);
        BATCH_NAME(chart_store)(to_disc(x, y), cm_equal(x, x), disc, i);
    }
}

/* u_a, u_b, v_a, v_b: the derivatives of the square's point (a, b) by that of the disc, by rows */
CHART_FN void BATCH_NAME(chart_square_jacobian)(BATCH_NAME(chart_slopes) slopes, size_t n,
                                                LANES_IO *const disc[CM_DISC_COLUMNS],
                                                const LANES_IO *a, const LANES_IO *b,
                                                LANES_IO *const to[4])
{
    for (size_t i = 0; i < n; i += LANES)
    {
        CM_NAME(cm_disc_point) d = BATCH_NAME(chart_load)(disc, i);
        CM_BOOL good = cm_equal(d.u, d.u);
        CM_NAME(cm_jacobian) j = slopes(d, lanes_load(a + i), lanes_load(b + i));
        lanes_store(to[0] + i, lanes_or_nan(good, j.u_p));
        lanes_store(to[1] + i, lanes_or_nan(good, j.u_q));
        lanes_store(to[2] + i, lanes_or_nan(good, j.v_p));
        lanes_store(to[3] + i, lanes_or_nan(good, j.v_q));
    }
}

/* ---- The ends of a row ---- */

/* Points of the disc, given by two coordinates. */
static void BATCH_NAME(chart_disc_in)(size_t n, const LANES_IO *u, const LANES_IO *v,
                                      LANES_IO *const disc[CM_DISC_COLUMNS])
{
    CM_REAL least = CM_LIT(-2.0) * lanes_all((LANES_SCALAR)CHART_TOLERANCE);
    for (size_t i = 0; i < n; i += LANES)
    {
        CM_REAL a = lanes_load(u + i);
        CM_REAL b = lanes_load(v + i);
        CM_BOOL good = cm_at_least(CM_LIT(2.0), cm_max(cm_abs(a), cm_abs(b)));
        good = cm_both(good, cm_at_least(CM_NAME(cm_disc_rim)(a, b), least));
        BATCH_NAME(chart_store)(CM_NAME(cm_make_disc_point)(a, b), good, disc, i);
        lanes_store(disc[4] + i, CM_LIT(1.0));
    }
}

/* Points of the square, with the side to which they belong in disc[4]. */
static void BATCH_NAME(chart_square_in)(const cm_mapping *mapping, size_t n, const LANES_IO *u,
                                        const LANES_IO *v, LANES_IO *a, LANES_IO *b, LANES_IO *side)
{
    CM_REAL one = CM_LIT(1.0);
    CM_REAL limit = one + CM_LIT(1.0e-9);
    for (size_t i = 0; i < n; i += LANES)
    {
        CM_REAL x = lanes_load(u + i);
        CM_REAL y = lanes_load(v + i);
        CM_BOOL good = cm_both(cm_at_least(limit, cm_abs(x)), cm_at_least(limit, cm_abs(y)));
        CM_NAME(cm_face_point) p;
        p.face = one;
        p.a = cm_min(cm_max(x, -one), one);
        p.b = cm_min(cm_max(y, -one), one);
        if (mapping->is_folded)
        {
            p = CM_NAME(cm_quincuncial_unplace)(p.a, p.b);
        }
        lanes_store(a + i, lanes_or_nan(good, p.a));
        lanes_store(b + i, lanes_or_nan(good, p.b));
        lanes_store(side + i, p.face);
    }
}

/* To their places on the map. */
static void BATCH_NAME(chart_square_out)(const cm_mapping *mapping, size_t n, const LANES_IO *side,
                                         LANES_IO *a, LANES_IO *b)
{
    for (size_t i = 0; i < n && mapping->is_folded; i += LANES)
    {
        CM_NAME(cm_uv) p = CM_NAME(cm_quincuncial_place)(lanes_load(a + i), lanes_load(b + i),
                                                         lanes_load(side + i));
        lanes_store(a + i, p.u);
        lanes_store(b + i, p.v);
    }
}

static void BATCH_NAME(chart_face_out)(size_t n, const LANES_IO *u, const LANES_IO *v,
                                       uint8_t *face, LANES_IO *to_u, LANES_IO *to_v)
{
    CM_REAL one = CM_LIT(1.0);
    for (size_t i = 0; i < n; i += LANES)
    {
        CM_REAL a = lanes_load(u + i);
        CM_REAL b = lanes_load(v + i);
        CM_BOOL good = cm_equal(a, a);
        lanes_store_faces(face + i, CM_SELECT(good, CM_LIT(0.0), CM_LIT(255.0)));
        lanes_store(to_u + i, lanes_or_nan(good, cm_min(cm_max(a, -one), one)));
        lanes_store(to_v + i, lanes_or_nan(good, cm_min(cm_max(b, -one), one)));
    }
}

/* NaN for points that are not on face 0. */
static void BATCH_NAME(chart_face_in)(size_t n, const uint8_t *face, const LANES_IO *u,
                                      const LANES_IO *v, LANES_IO *to_u, LANES_IO *to_v)
{
    for (size_t i = 0; i < n; i += LANES)
    {
        CM_BOOL good = cm_equal(lanes_load_faces(face + i), CM_LIT(0.0));
        lanes_store(to_u + i, lanes_or_nan(good, lanes_load(u + i)));
        lanes_store(to_v + i, lanes_or_nan(good, lanes_load(v + i)));
    }
}

/* NaN for points that are none. */
static void BATCH_NAME(chart_keep)(size_t n, const LANES_IO *where, LANES_IO *const to[6])
{
    for (size_t i = 0; i < n; i += LANES)
    {
        CM_REAL w = lanes_load(where + i);
        for (int k = 0; k < 6; k++)
        {
            lanes_store(to[k] + i, lanes_or_nan(cm_equal(w, w), lanes_load(to[k] + i)));
        }
    }
}

/* The Jacobian of the square's point with that of its place on the map. */
CHART_FN CM_NAME(cm_jacobian) BATCH_NAME(chart_placed)(const cm_mapping *mapping, size_t i,
                                                       const LANES_IO *side, const LANES_IO *a,
                                                       const LANES_IO *b,
                                                       LANES_IO *const by_disc[4])
{
    CM_NAME(cm_jacobian) j =
        CM_NAME(cm_make_jacobian)(lanes_load(by_disc[0] + i), lanes_load(by_disc[1] + i),
                                  lanes_load(by_disc[2] + i), lanes_load(by_disc[3] + i));
    if (mapping->is_folded)
    {
        CM_NAME(cm_jacobian) p = CM_NAME(cm_quincuncial_jacobian)(
            lanes_load(a + i), lanes_load(b + i), lanes_load(side + i));
        j = CM_NAME(cm_make_jacobian)(p.u_p * j.u_p + p.u_q * j.v_p, p.u_p * j.u_q + p.u_q * j.v_q,
                                      p.v_p * j.u_p + p.v_q * j.v_p, p.v_p * j.u_q + p.v_q * j.v_q);
    }
    return j;
}

/* The gradients of the disc's coordinates become those of the map's. */
static void BATCH_NAME(chart_gradients_out)(const cm_mapping *mapping, size_t n,
                                            const LANES_IO *side, const LANES_IO *a,
                                            const LANES_IO *b, LANES_IO *const by_disc[4],
                                            LANES_IO *const to[6])
{
    for (size_t i = 0; i < n; i += LANES)
    {
        CM_NAME(cm_jacobian) j = BATCH_NAME(chart_placed)(mapping, i, side, a, b, by_disc);
        CM_NAME(cm_gradients) g = {lanes_load(to[0] + i), lanes_load(to[1] + i),
                                   lanes_load(to[2] + i), lanes_load(to[3] + i),
                                   lanes_load(to[4] + i), lanes_load(to[5] + i)};
        g = CM_NAME(cm_jacobian_gradients)(j, g);
        lanes_store(to[0] + i, g.a_x);
        lanes_store(to[1] + i, g.a_y);
        lanes_store(to[2] + i, g.a_z);
        lanes_store(to[3] + i, g.b_x);
        lanes_store(to[4] + i, g.b_y);
        lanes_store(to[5] + i, g.b_z);
    }
}

/* The derivatives by the disc's coordinates become those by the map's. */
static void BATCH_NAME(chart_tangents_out)(const cm_mapping *mapping, size_t n,
                                           const LANES_IO *side, const LANES_IO *a,
                                           const LANES_IO *b, LANES_IO *const by_disc[4],
                                           LANES_IO *const to[6])
{
    for (size_t i = 0; i < n; i += LANES)
    {
        CM_NAME(cm_jacobian) j = BATCH_NAME(chart_placed)(mapping, i, side, a, b, by_disc);
        CM_NAME(cm_tangents) t = {.x_a = lanes_load(to[0] + i),
                                  .x_b = lanes_load(to[1] + i),
                                  .y_a = lanes_load(to[2] + i),
                                  .y_b = lanes_load(to[3] + i),
                                  .z_a = lanes_load(to[4] + i),
                                  .z_b = lanes_load(to[5] + i)};
        t = CM_NAME(cm_jacobian_tangents)(j, t);
        lanes_store(to[0] + i, t.x_a);
        lanes_store(to[1] + i, t.x_b);
        lanes_store(to[2] + i, t.y_a);
        lanes_store(to[3] + i, t.y_b);
        lanes_store(to[4] + i, t.z_a);
        lanes_store(to[5] + i, t.z_b);
    }
}

/* ---- One set of loops for each part, by index in the catalogue ---- */

#define CHART_AZIMUTHAL(id)                                                                        \
    static void BATCH_NAME(azimuthal_forward_##id)(                                                \
        const cm_mapping *mapping, size_t n, const LANES_IO *x, const LANES_IO *y,                 \
        const LANES_IO *z, LANES_IO *const disc[CM_DISC_COLUMNS])                                  \
    {                                                                                              \
        BATCH_NAME(chart_azimuthal_forward)                                                        \
        (CM_NAME(cm_azimuthal_##id##_project), mapping, n, x, y, z, disc);                         \
    }                                                                                              \
    static void BATCH_NAME(azimuthal_inverse_##id)(const cm_mapping *mapping, size_t n,            \
                                                   LANES_IO *const disc[CM_DISC_COLUMNS],          \
                                                   LANES_IO *x, LANES_IO *y, LANES_IO *z)          \
    {                                                                                              \
        BATCH_NAME(chart_azimuthal_inverse)                                                        \
        (CM_NAME(cm_azimuthal_##id##_unproject), mapping, n, disc, x, y, z);                       \
    }                                                                                              \
    static void BATCH_NAME(azimuthal_gradients_##id)(const cm_mapping *mapping, size_t n,          \
                                                     const LANES_IO *x, const LANES_IO *y,         \
                                                     const LANES_IO *z, LANES_IO *const to[6])     \
    {                                                                                              \
        BATCH_NAME(chart_azimuthal_gradients)                                                      \
        (CM_NAME(cm_azimuthal_##id##_gradients), mapping, n, x, y, z, to);                         \
    }                                                                                              \
    static void BATCH_NAME(azimuthal_tangents_##id)(const cm_mapping *mapping, size_t n,           \
                                                    LANES_IO *const disc[CM_DISC_COLUMNS],         \
                                                    LANES_IO *const to[6])                         \
    {                                                                                              \
        BATCH_NAME(chart_azimuthal_tangents)                                                       \
        (CM_NAME(cm_azimuthal_##id##_tangents), mapping, n, disc, to);                             \
    }
#define CHART_SQUARE(id)                                                                           \
    static void BATCH_NAME(square_forward_##id)(size_t n, LANES_IO *const disc[CM_DISC_COLUMNS],   \
                                                LANES_IO *a, LANES_IO *b)                          \
    {                                                                                              \
        BATCH_NAME(chart_square_forward)(CM_NAME(cm_square_##id##_forward), n, disc, a, b);        \
    }                                                                                              \
    static void BATCH_NAME(square_inverse_##id)(size_t n, const LANES_IO *a, const LANES_IO *b,    \
                                                LANES_IO *const disc[CM_DISC_COLUMNS])             \
    {                                                                                              \
        BATCH_NAME(chart_square_inverse)(CM_NAME(cm_square_##id##_inverse), n, a, b, disc);        \
    }                                                                                              \
    static void BATCH_NAME(square_jacobian_##id)(size_t n, LANES_IO *const disc[CM_DISC_COLUMNS],  \
                                                 const LANES_IO *a, const LANES_IO *b,             \
                                                 LANES_IO *const to[4])                            \
    {                                                                                              \
        BATCH_NAME(chart_square_jacobian)(CM_NAME(cm_square_##id##_jacobian), n, disc, a, b, to);  \
    }

#define CM_DESCRIPTORS
#define CM_SPHERE(...)
#define CM_SPHERE_CONSTANTS(...)
#define CM_WARP(...)
#define CM_LAYOUT(...)
#define CM_AZIMUTHAL(id, ...) CHART_AZIMUTHAL(id)
#define CM_SQUARE(id, ...) CHART_SQUARE(id)
#include <cubemap/kernel/catalogue.h>
#undef CM_SPHERE
#undef CM_SPHERE_CONSTANTS
#undef CM_WARP
#undef CM_LAYOUT
#undef CM_AZIMUTHAL
#undef CM_SQUARE

#define CM_SPHERE(...) {0},
#define CM_SPHERE_CONSTANTS(...) {0},
#define CM_WARP(...) {0},
#define CM_LAYOUT(...) {0},
#define CM_SQUARE(...) {0},
#define CM_AZIMUTHAL(id, ...)                                                                      \
    {.forward = BATCH_NAME(azimuthal_forward_##id),                                                \
     .inverse = BATCH_NAME(azimuthal_inverse_##id),                                                \
     .gradients = BATCH_NAME(azimuthal_gradients_##id),                                            \
     .tangents = BATCH_NAME(azimuthal_tangents_##id)},
static const CM_SCALAR_NAME(cm_azimuthal_loops) BATCH_NAME(azimuthal_table)[] = {
#include <cubemap/kernel/catalogue.h>
};
#undef CM_AZIMUTHAL
#undef CM_SQUARE

#define CM_AZIMUTHAL(...) {0},
#define CM_SQUARE(id, ...)                                                                         \
    {.forward = BATCH_NAME(square_forward_##id),                                                   \
     .inverse = BATCH_NAME(square_inverse_##id),                                                   \
     .jacobian = BATCH_NAME(square_jacobian_##id)},
static const CM_SCALAR_NAME(cm_square_loops) BATCH_NAME(square_table)[] = {
#include <cubemap/kernel/catalogue.h>
};
#undef CM_SPHERE
#undef CM_SPHERE_CONSTANTS
#undef CM_WARP
#undef CM_LAYOUT
#undef CM_AZIMUTHAL
#undef CM_SQUARE
#undef CM_DESCRIPTORS

static const CM_SCALAR_NAME(cm_chart_loops)
    BATCH_NAME(chart_loops) = {.azimuthal = BATCH_NAME(azimuthal_table),
                               .square = BATCH_NAME(square_table),
                               .disc_in = BATCH_NAME(chart_disc_in),
                               .square_in = BATCH_NAME(chart_square_in),
                               .square_out = BATCH_NAME(chart_square_out),
                               .face_in = BATCH_NAME(chart_face_in),
                               .face_out = BATCH_NAME(chart_face_out),
                               .gradients_out = BATCH_NAME(chart_gradients_out),
                               .tangents_out = BATCH_NAME(chart_tangents_out),
                               .keep = BATCH_NAME(chart_keep)};

#undef CHART_FN
#undef CHART_TOLERANCE
#undef CHART_AZIMUTHAL
#undef CHART_SQUARE
