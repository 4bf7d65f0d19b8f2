/* SPDX-License-Identifier: MIT
 *
 * zucker-cobe: Zucker & Higashi's pair of polynomials in the manner of COBE's, refit since with 12 digits;
 * nearly equal-area (1.3 % at most).
 *
 * The published pair is not one: the two directions are separate fits, and a round trip with both misses
 * by up to 2.6e-3. Here the polynomial from the map to the sphere is the definition and the other
 * direction solves it, by Newton's method from the other polynomial; with forward=1 it is the other way
 * round. The first is the better: with it the area is within 1.3 %, with forward=1 within 16 %.
 */
#ifdef CM_DESCRIPTORS
/* clang-format off */
CM_WARP_VARIANTS(zucker_cobe,
                 .identifier = "zucker-cobe",
                 .aliases = "",
                 .name = "Zucker & Higashi's polynomials after COBE",
                 .source = "Zucker & Higashi 2018, Cube-to-sphere projections for procedural texturing and "
                           "beyond (refit)",
                 .family = CM_FAMILY_BIVARIATE,
                 .smooth_face = CM_SMOOTH_ANALYTIC,
                 .smooth_edge = CM_SMOOTH_C0,
                 .smooth_corner = CM_SMOOTH_ANALYTIC,
                 .parameter_count = 1,
                 .parameter = {CM_PARAMETER_FORWARD},
                 .bounds = {.round_trip = 2.7, .plane_round_trip = 4, .forward = 2, .inverse = 3,
                            .relative = 6},
                 .fast = CM_FAST_FORWARD)
/* clang-format on */
#else

/* the variant is which polynomial is the definition */
CM_FN CM_NAME(cm_constants) CM_NAME(cm_zucker_cobe_prepare)(CM_NAME(cm_constants) k)
{
    k.variant = k.k0;
    return k;
}

/* The coefficients of F(x, y) = x (1 + (1 - X)(g + S)), S = X (a + b X + c Y) + Y (d + e Y), X = x^2,
 * Y = y^2; g is the printed one less 1. */
CM_STRUCT(cm_zucker_cobe_form)
{
    CM_REAL g;
    CM_REAL a;
    CM_REAL b;
    CM_REAL c;
    CM_REAL d;
    CM_REAL e;
}
CM_STRUCT_END(cm_zucker_cobe_form)

CM_FN CM_NAME(cm_zucker_cobe_form) CM_NAME(cm_zucker_cobe_to_map)(void)
{
    CM_NAME(cm_zucker_cobe_form) r;
    r.g = CM_LIT(0.37738198385);
    r.a = CM_LIT(-0.212853382041);
    r.b = CM_LIT(0.0693532685333);
    r.c = CM_LIT(0.0941259684877);
    r.d = CM_LIT(-0.117847692949);
    r.e = CM_LIT(0.0107989197181);
    return r;
}

CM_FN CM_NAME(cm_zucker_cobe_form) CM_NAME(cm_zucker_cobe_to_sphere)(void)
{
    CM_NAME(cm_zucker_cobe_form) r;
    r.g = CM_LIT(-0.276048765048);
    r.a = CM_LIT(-0.0941180085824);
    r.b = CM_LIT(-0.0623272690881);
    r.c = CM_LIT(0.0409125981187);
    r.d = CM_LIT(0.0275922480902);
    r.e = CM_LIT(0.0342217026979);
    return r;
}

/* g + S and its derivatives by X and Y */
CM_FN CM_NAME(cm_cobe_value)
    CM_NAME(cm_zucker_cobe_evaluate)(CM_REAL x, CM_REAL y, CM_NAME(cm_zucker_cobe_form) m)
{
    CM_REAL by_x = cm_mad(m.c, y, cm_mad(m.b, x, m.a));
    CM_REAL by_y = cm_mad(m.e, y, m.d);
    CM_NAME(cm_cobe_value) r;
    r.b = cm_mad(x, by_x, cm_mad(y, by_y, m.g));
    r.b_x = cm_mad(m.b, x, by_x);
    r.b_y = cm_mad(m.e, y, cm_mad(m.c, x, by_y));
    return r;
}

/* (F(a, b), F(b, a)), as a pair that is either of the map or of the sphere */
CM_FN CM_NAME(cm_pq)
    CM_NAME(cm_zucker_cobe_polynomial)(CM_REAL a, CM_REAL b, CM_NAME(cm_zucker_cobe_form) m)
{
    CM_REAL x = a * a;
    CM_REAL y = b * b;
    CM_REAL of_a = CM_NAME(cm_zucker_cobe_evaluate)(x, y, m).b;
    CM_REAL of_b = CM_NAME(cm_zucker_cobe_evaluate)(y, x, m).b;
    return CM_NAME(cm_make_pq)(CM_NAME(cm_cobe_polynomial)(a, of_a),
                               CM_NAME(cm_cobe_polynomial)(b, of_b));
}

CM_FN CM_NAME(cm_pq) CM_NAME(cm_zucker_cobe_step)(CM_NAME(cm_pq) at, CM_REAL a, CM_REAL b,
                                                  CM_NAME(cm_zucker_cobe_form) m)
{
    CM_REAL x = at.p * at.p;
    CM_REAL y = at.q * at.q;
    return CM_NAME(cm_cobe_newton)(at.p, at.q, a, b, CM_NAME(cm_zucker_cobe_evaluate)(x, y, m),
                                   CM_NAME(cm_zucker_cobe_evaluate)(y, x, m));
}

/* The pair that the polynomial m takes to (a, b), from the other polynomial, which is off by 2.6e-3 at
 * most; each step squares that. */
CM_FN CM_NAME(cm_pq)
    CM_NAME(cm_zucker_cobe_solve)(CM_REAL a, CM_REAL b, CM_NAME(cm_zucker_cobe_form) start,
                                  CM_NAME(cm_zucker_cobe_form) m)
{
    CM_NAME(cm_pq) r = CM_NAME(cm_zucker_cobe_polynomial)(a, b, start);
    r = CM_NAME(cm_zucker_cobe_step)(r, a, b, m);
    r = CM_NAME(cm_zucker_cobe_step)(r, a, b, m);
#if CM_REAL_BITS >= 64
    r = CM_NAME(cm_zucker_cobe_step)(r, a, b, m);
#endif
#if CM_REAL_BITS > 64
    r = CM_NAME(cm_zucker_cobe_step)(r, a, b, m);
#endif
    return CM_NAME(cm_make_pq)(cm_copysign(r.p, a), cm_copysign(r.q, b));
}

CM_FN CM_NAME(cm_uv) CM_NAME(cm_zucker_cobe_forward)(CM_REAL p, CM_REAL q, CM_NAME(cm_constants) k)
{
    CM_NAME(cm_pq) r;
    if (CM_VARIANT(k))
    {
        r = CM_NAME(cm_zucker_cobe_polynomial)(p, q, CM_NAME(cm_zucker_cobe_to_map)());
    }
    else
    {
        r = CM_NAME(cm_zucker_cobe_solve)(p, q, CM_NAME(cm_zucker_cobe_to_map)(),
                                          CM_NAME(cm_zucker_cobe_to_sphere)());
    }
    return CM_NAME(cm_make_uv)(r.p, r.q);
}

CM_FN CM_NAME(cm_pq) CM_NAME(cm_zucker_cobe_inverse)(CM_REAL u, CM_REAL v, CM_NAME(cm_constants) k)
{
    if (!CM_VARIANT(k))
    {
        return CM_NAME(cm_zucker_cobe_polynomial)(u, v, CM_NAME(cm_zucker_cobe_to_sphere)());
    }
    return CM_NAME(cm_zucker_cobe_solve)(u, v, CM_NAME(cm_zucker_cobe_to_sphere)(),
                                         CM_NAME(cm_zucker_cobe_to_map)());
}

/* The derivatives of the polynomial m at (a, b). */
CM_FN CM_NAME(cm_jacobian)
    CM_NAME(cm_zucker_cobe_matrix)(CM_REAL a, CM_REAL b, CM_NAME(cm_zucker_cobe_form) m)
{
    CM_REAL x = a * a;
    CM_REAL y = b * b;
    return CM_NAME(cm_cobe_matrix)(a, b, CM_NAME(cm_zucker_cobe_evaluate)(x, y, m),
                                   CM_NAME(cm_zucker_cobe_evaluate)(y, x, m));
}

CM_FN CM_NAME(cm_jacobian) CM_NAME(cm_zucker_cobe_jacobian)(CM_REAL p, CM_REAL q, CM_REAL u,
                                                            CM_REAL v, CM_NAME(cm_constants) k)
{
    if (CM_VARIANT(k))
    {
        return CM_NAME(cm_zucker_cobe_matrix)(p, q, CM_NAME(cm_zucker_cobe_to_map)());
    }
    CM_NAME(cm_jacobian)
    j = CM_NAME(cm_zucker_cobe_matrix)(u, v, CM_NAME(cm_zucker_cobe_to_sphere)());
    CM_REAL scale = CM_LIT(1.0) / CM_NAME(cm_jacobian_determinant)(j);
    return CM_NAME(cm_make_jacobian)(j.v_q * scale, -(j.u_q * scale), -(j.v_p * scale),
                                     j.u_p * scale);
}

#endif
