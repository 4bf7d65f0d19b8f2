/* SPDX-License-Identifier: MIT
 *
 * zucker-quintic: Zucker & Higashi's odd polynomials of degree five, w (c0 + c1 w^2 + (1 - c0 - c1) w^4),
 * refit since with 12 digits.
 *
 * The published pair is not one: the two directions are separate fits, and a round trip with both misses
 * by up to 1.8e-3. Here the polynomial from the map to the sphere is the definition and the other
 * direction solves it, by Halley's method from the other polynomial; with forward=1 it is the other way
 * round. Written w + w (1 - w^2)(a - c w^2), c = 1 - c0 - c1, a = c0 - 1, the edge is exact; the printed
 * coefficients of one direction add up to 1 - 2e-12.
 */
#ifdef CM_DESCRIPTORS
/* clang-format off */
CM_WARP_VARIANTS(zucker_quintic,
                 .identifier = "zucker-quintic",
                 .aliases = "",
                 .name = "Zucker & Higashi's quintic polynomials",
                 .source = "Zucker & Higashi 2018, Cube-to-sphere projections for procedural texturing and "
                           "beyond (refit)",
                 .family = CM_FAMILY_UNIVARIATE,
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
CM_FN CM_NAME(cm_constants) CM_NAME(cm_zucker_quintic_prepare)(CM_NAME(cm_constants) k)
{
    k.variant = k.k0;
    return k;
}

/* a and c of a polynomial */
CM_STRUCT(cm_zucker_quintic_form)
{
    CM_REAL a;
    CM_REAL c;
}
CM_STRUCT_END(cm_zucker_quintic_form)

CM_FN CM_NAME(cm_zucker_quintic_form) CM_NAME(cm_zucker_quintic_to_map)(void)
{
    CM_NAME(cm_zucker_quintic_form) r;
    r.a = CM_LIT(0.34318229552);
    r.c = CM_LIT(0.143331770929);
    return r;
}

CM_FN CM_NAME(cm_zucker_quintic_form) CM_NAME(cm_zucker_quintic_to_sphere)(void)
{
    CM_NAME(cm_zucker_quintic_form) r;
    r.a = CM_LIT(-0.254441284407);
    r.c = CM_LIT(0.123894434214);
    return r;
}

CM_FN CM_REAL CM_NAME(cm_zucker_quintic_evaluate)(CM_REAL w, CM_NAME(cm_zucker_quintic_form) m)
{
    CM_REAL edge = (CM_LIT(1.0) - w) * (CM_LIT(1.0) + w);
    return CM_NAME(cm_stretch)(w, edge * cm_mad(-m.c, w * w, m.a));
}

/* One step of Halley's method from w towards the root of f(w) = w + w B(w^2) = y. */
CM_FN CM_REAL CM_NAME(cm_zucker_quintic_step)(CM_REAL w, CM_REAL y,
                                              CM_NAME(cm_zucker_quintic_form) m)
{
    CM_REAL z = w * w;
    CM_REAL edge = (CM_LIT(1.0) - w) * (CM_LIT(1.0) + w);
    CM_REAL b = edge * cm_mad(-m.c, z, m.a);
    CM_REAL b_z = cm_mad(CM_LIT(2.0) * m.c, z, -(m.a + m.c));
    CM_REAL slope = cm_mad(CM_LIT(2.0) * z, b_z, CM_LIT(1.0) + b);
    CM_REAL bend = w * cm_mad(CM_LIT(4.0) * m.c, z, CM_LIT(3.0) * b_z); /* f'' / 2 */
    CM_REAL rest = cm_mad(-w, b, y - w);
    return w + CM_NAME(cm_quotient)(rest * slope, cm_mad(slope, slope, rest * bend));
}

/* The root, from the other polynomial, which is off by 1.8e-3 at most: each step cubes that. */
CM_FN CM_REAL CM_NAME(cm_zucker_quintic_solve)(CM_REAL y, CM_NAME(cm_zucker_quintic_form) start,
                                               CM_NAME(cm_zucker_quintic_form) m)
{
    CM_REAL w = CM_NAME(cm_zucker_quintic_evaluate)(y, start);
    w = CM_NAME(cm_zucker_quintic_step)(w, y, m);
#if CM_REAL_BITS >= 64
    w = CM_NAME(cm_zucker_quintic_step)(w, y, m);
#endif
#if CM_REAL_BITS > 64
    w = CM_NAME(cm_zucker_quintic_step)(w, y, m);
#endif
    return cm_copysign(w, y);
}

CM_FN CM_REAL CM_NAME(cm_zucker_quintic_sigmoid)(CM_REAL w, CM_NAME(cm_constants) k)
{
    if (CM_VARIANT(k))
    {
        return CM_NAME(cm_zucker_quintic_evaluate)(w, CM_NAME(cm_zucker_quintic_to_map)());
    }
    return CM_NAME(cm_zucker_quintic_solve)(w, CM_NAME(cm_zucker_quintic_to_map)(),
                                            CM_NAME(cm_zucker_quintic_to_sphere)());
}

CM_FN CM_REAL CM_NAME(cm_zucker_quintic_sigmoid_inverse)(CM_REAL w, CM_NAME(cm_constants) k)
{
    if (!CM_VARIANT(k))
    {
        return CM_NAME(cm_zucker_quintic_evaluate)(w, CM_NAME(cm_zucker_quintic_to_sphere)());
    }
    return CM_NAME(cm_zucker_quintic_solve)(w, CM_NAME(cm_zucker_quintic_to_sphere)(),
                                            CM_NAME(cm_zucker_quintic_to_map)());
}

CM_UNIVARIATE(cm_zucker_quintic_forward, cm_zucker_quintic_sigmoid, cm_zucker_quintic_inverse,
              cm_zucker_quintic_sigmoid_inverse)

/* f' of a polynomial */
CM_FN CM_REAL CM_NAME(cm_zucker_quintic_gradient)(CM_REAL w, CM_NAME(cm_zucker_quintic_form) m)
{
    CM_REAL z = w * w;
    CM_REAL b = ((CM_LIT(1.0) - w) * (CM_LIT(1.0) + w)) * (m.a - m.c * z);
    return CM_LIT(1.0) + (b + (CM_LIT(2.0) * z) * ((CM_LIT(2.0) * m.c) * z - (m.a + m.c)));
}

CM_FN CM_REAL CM_NAME(cm_zucker_quintic_slope)(CM_REAL w, CM_REAL f, CM_NAME(cm_constants) k)
{
    if (CM_VARIANT(k))
    {
        return CM_NAME(cm_zucker_quintic_gradient)(w, CM_NAME(cm_zucker_quintic_to_map)());
    }
    return CM_LIT(1.0) /
           CM_NAME(cm_zucker_quintic_gradient)(f, CM_NAME(cm_zucker_quintic_to_sphere)());
}

CM_UNIVARIATE_JACOBIAN(cm_zucker_quintic_jacobian, cm_zucker_quintic_slope)

#endif
