/* SPDX-License-Identifier: MIT
 *
 * coupled-lean: coupled-cubic with half of its constants, equal-area to 4.4e-5. Of the cubic's terms those
 * are kept that matter,
 *     C(A, B) = g0 + g1 B + A (h0 + h1 B + h2 B^2),
 * and the formulas are those of coupled_cubic.h, which must be read before.
 */
#ifdef CM_DESCRIPTORS
/* clang-format off */
CM_WARP(coupled_lean,
        .identifier = "coupled-lean",
        .aliases = "",
        .name = "coupled with five constants, equal-area to 5e-5",
        .source = "libcubemap 2026, docs/guide/new-mappings.md",
        .family = CM_FAMILY_BIVARIATE,
        .smooth_face = CM_SMOOTH_ANALYTIC,
        .smooth_edge = CM_SMOOTH_C0,
        .smooth_corner = CM_SMOOTH_ANALYTIC,
        .bounds = {.round_trip = 2.7, .plane_round_trip = 4, .forward = 2, .inverse = 3,
                   .relative = 6},
        .fast = CM_FAST_FORWARD | CM_FAST_INVERSE)
/* clang-format on */
#else

CM_FN CM_NAME(cm_constants) CM_NAME(cm_coupled_lean_prepare)(CM_NAME(cm_constants) k)
{
    return k;
}

#define CM_LEAN_G0 CM_LIT(0.90985685045022978)
#define CM_LEAN_G1 CM_LIT(-0.25572175768155047)
#define CM_LEAN_H0 CM_LIT(-0.0051002998145648623)
#define CM_LEAN_H1 CM_LIT(-0.018112235254031639)
#define CM_LEAN_H2 CM_LIT(0.018567866355489335)

CM_FN CM_NAME(cm_cubic_value) CM_NAME(cm_lean_evaluate)(CM_REAL x, CM_REAL y)
{
    CM_NAME(cm_cubic_value) r;
    r.c_x = cm_mad(y, cm_mad(y, CM_LEAN_H2, CM_LEAN_H1), CM_LEAN_H0);
    r.c_y = cm_mad(x, cm_mad(y, CM_LIT(2.0) * CM_LEAN_H2, CM_LEAN_H1), CM_LEAN_G1);
    r.c = cm_mad(x, r.c_x, cm_mad(y, CM_LEAN_G1, CM_LEAN_G0));
    return r;
}

/* The first approximation of u^2, within 5e-4; two steps from there leave 1e-17. */
CM_FN CM_REAL CM_NAME(cm_lean_start)(CM_REAL x, CM_REAL y)
{
    return CM_NAME(cm_cubic_first)(
        x, cm_mad(y, cm_mad(y, CM_LIT(0.1530072914), CM_LIT(-0.4030384533)), CM_LIT(0.9043537474)));
}

CM_FN CM_NAME(cm_cubic_step) CM_NAME(cm_lean_newton)(CM_REAL x, CM_REAL y, CM_REAL a, CM_REAL b)
{
    return CM_NAME(cm_cubic_solve)(x, y, a, b, CM_NAME(cm_lean_evaluate)(a, b),
                                   CM_NAME(cm_lean_evaluate)(b, a));
}

CM_FN CM_NAME(cm_uv) CM_NAME(cm_coupled_lean_forward)(CM_REAL p, CM_REAL q, CM_NAME(cm_constants) k)
{
    CM_UNUSED(k);
    CM_REAL x = p * p;
    CM_REAL y = q * q;
    CM_NAME(cm_cubic_step) r =
        CM_NAME(cm_lean_newton)(x, y, CM_NAME(cm_lean_start)(x, y), CM_NAME(cm_lean_start)(y, x));
#if CM_REAL_BITS >= 64
    r = CM_NAME(cm_lean_newton)(x, y, r.a, r.b);
#endif
#if CM_REAL_BITS > 64
    r = CM_NAME(cm_lean_newton)(x, y, r.a, r.b);
    r = CM_NAME(cm_lean_newton)(x, y, r.a, r.b);
#endif
    return CM_NAME(cm_cubic_finish)(p, q, r);
}

CM_FN CM_NAME(cm_pq) CM_NAME(cm_coupled_lean_inverse)(CM_REAL u, CM_REAL v, CM_NAME(cm_constants) k)
{
    CM_UNUSED(k);
    CM_REAL x = u * u;
    CM_REAL y = v * v;
    return CM_NAME(cm_cubic_unwarp)(u, v, CM_NAME(cm_lean_evaluate)(x, y).c,
                                    CM_NAME(cm_lean_evaluate)(y, x).c);
}

CM_FN CM_NAME(cm_jacobian) CM_NAME(cm_coupled_lean_jacobian)(CM_REAL p, CM_REAL q, CM_REAL u,
                                                             CM_REAL v, CM_NAME(cm_constants) k)
{
    CM_UNUSED(p);
    CM_UNUSED(q);
    CM_UNUSED(k);
    return CM_NAME(cm_cubic_matrix)(u, v, CM_NAME(cm_lean_evaluate)(u * u, v * v),
                                    CM_NAME(cm_lean_evaluate)(v * v, u * u));
}

#endif
