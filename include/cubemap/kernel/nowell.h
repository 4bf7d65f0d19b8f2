/* SPDX-License-Identifier: MIT
 *
 * nowell: x = u sqrt(1 - v^2/2 - ...), Nowell's map between the cube's and the sphere's surface.
 *
 * The printed forward direction takes the square root of a difference that vanishes on the axes
 * (2e-8 in double, 5e-4 in float, NaN); here its conjugate is divided by, which cannot cancel:
 * u = p sqrt(12 / (3 + 5 p^2 + q^2 + S)), S = sqrt((3 + p^2 + q^2)^2 - 16 p^2 q^2).
 */
#ifdef CM_DESCRIPTORS
/* clang-format off */
CM_WARP(nowell,
        .identifier = "nowell",
        .aliases = "ksc",
        .name = "Nowell's mapping",
        .source = "Nowell 2005, Mapping a cube to a sphere; Lambers 2020, eq. 3 (misprint "
                  "corrected, forward reformulated)",
        .family = CM_FAMILY_BIVARIATE,
        .smooth_face = CM_SMOOTH_ANALYTIC,
        .smooth_edge = CM_SMOOTH_C0,
        .smooth_corner = CM_SMOOTH_ANALYTIC,
        .bounds = {.round_trip = 2.7, .plane_round_trip = 4, .forward = 2, .inverse = 3,
                   .relative = 6},
        .fast = CM_FAST_FORWARD | CM_FAST_INVERSE)
/* clang-format on */
#else

CM_FN CM_NAME(cm_constants) CM_NAME(cm_nowell_prepare)(CM_NAME(cm_constants) k)
{
    return k;
}

/* u = p sqrt(12 / D), D = 3 + 5 p^2 + q^2 + S, where 12 - D = a (5 + (8 - a - 14 q^2) / (4 - q^2 + S))
 * with a = 1 - p^2, so that D = 12 exactly on the edge. */
CM_FN CM_REAL CM_NAME(cm_nowell_scale)(CM_REAL w, CM_REAL y, CM_REAL s)
{
    CM_REAL a = (CM_LIT(1.0) - w) * (CM_LIT(1.0) + w);
    CM_REAL rest =
        a * (CM_LIT(5.0) + (CM_LIT(8.0) - a - CM_LIT(14.0) * y) / ((CM_LIT(4.0) - y) + s));
    return CM_NAME(cm_divide_by_root)(w, rest * CM_LIT(-0.083333333333333333333333333333333333333));
}

CM_FN CM_NAME(cm_uv) CM_NAME(cm_nowell_forward)(CM_REAL p, CM_REAL q, CM_NAME(cm_constants) k)
{
    CM_UNUSED(k);
    CM_REAL x = p * p;
    CM_REAL y = q * q;
    CM_REAL sum = CM_LIT(3.0) + (x + y);
    CM_REAL product = CM_LIT(4.0) * cm_abs(p * q);
    CM_REAL s = cm_sqrt((sum - product) * (sum + product));
    return CM_NAME(cm_make_uv)(CM_NAME(cm_nowell_scale)(p, y, s),
                               CM_NAME(cm_nowell_scale)(q, x, s));
}

CM_FN CM_NAME(cm_pq) CM_NAME(cm_nowell_inverse)(CM_REAL u, CM_REAL v, CM_NAME(cm_constants) k)
{
    CM_UNUSED(k);
    CM_REAL a = (CM_LIT(1.0) - u) * (CM_LIT(1.0) + u);
    CM_REAL b = (CM_LIT(1.0) - v) * (CM_LIT(1.0) + v);
    CM_REAL u3 = CM_LIT(3.0) - u * u;
    CM_REAL v3 = CM_LIT(3.0) - v * v;
    CM_REAL g = a * (CM_LIT(1.0) + CM_LIT(2.0) * b);
    CM_REAL h = b * (CM_LIT(1.0) + CM_LIT(2.0) * a);
    return CM_NAME(cm_make_pq)(CM_NAME(cm_divide_by_root)(u, g / v3),
                               CM_NAME(cm_divide_by_root)(v, h / u3));
}

/* With A = u^2, B = v^2 the inverse is p = u sqrt((3 - B) / N), q = v sqrt((3 - A) / N) with
 * N = 6 - 3 A - 3 B + 2 A B. The determinant of its Jacobian has the factor N, which cancels against
 * that of the derivatives; what is left to divide by is 6 (3 - A - B). */
CM_FN CM_NAME(cm_jacobian)
    CM_NAME(cm_nowell_jacobian)(CM_REAL p, CM_REAL q, CM_REAL u, CM_REAL v, CM_NAME(cm_constants) k)
{
    CM_UNUSED(p);
    CM_UNUSED(q);
    CM_UNUSED(k);
    CM_REAL a = (CM_LIT(1.0) - u) * (CM_LIT(1.0) + u);
    CM_REAL b = (CM_LIT(1.0) - v) * (CM_LIT(1.0) + v);
    CM_REAL u3 = CM_LIT(2.0) + a; /* 3 - A */
    CM_REAL v3 = CM_LIT(2.0) + b;
    CM_REAL n = CM_LIT(2.0) + (a + b + CM_LIT(2.0) * (a * b));
    CM_REAL scale = CM_LIT(1.0) / (CM_LIT(6.0) * (CM_LIT(1.0) + (a + b)));
    CM_REAL root_p = scale * cm_sqrt(n * v3);
    CM_REAL root_q = scale * cm_sqrt(n * u3);
    CM_REAL cross = u * v;
    return CM_NAME(cm_make_jacobian)(((CM_LIT(1.0) + a) * u3) * root_p, -((cross * a) * root_q),
                                     -((cross * b) * root_p), ((CM_LIT(1.0) + b) * v3) * root_q);
}

#endif
