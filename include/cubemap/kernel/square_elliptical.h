/* SPDX-License-Identifier: MIT
 *
 * square:elliptical: the mapping by elliptical arcs: lines of constant x and of constant y are ellipses of the
 * disc.
 */
#ifdef CM_DESCRIPTORS
/* clang-format off */
CM_SQUARE(elliptical,
          .identifier = "square:elliptical",
          .aliases = "square:nowell",
          .name = "elliptical arcs",
          .source = "Nowell 2005; Fong 2015; Lambers 2016, section 2.4 (reformulated)",
          .kind = CM_KIND_DISC_SQUARE,
          .family = CM_FAMILY_BIVARIATE,
          .smooth_face = CM_SMOOTH_ANALYTIC,
          .bounds = {.round_trip = 6, .plane_round_trip = 6, .forward = 6, .inverse = 2, .relative = 6})
/* clang-format on */
#else

/* With s = sqrt(2) the printed x is (sqrt(A) - sqrt(B)) / 2, A = (s + u - v)(s + u + v),
 * B = (s - u - v)(s - u + v), which is 2 s u / (sqrt(A) + sqrt(B)). In the first quadrant s - u - v is what
 * cancels: times s + u + v it is 2 (1 - u^2 - v^2) + (u - v)^2. */
CM_FN CM_NAME(cm_uv) CM_NAME(cm_square_elliptical_forward)(CM_NAME(cm_disc_point) d)
{
    CM_REAL root2 = CM_LIT(1.41421356237309504880168872420969807857);
    CM_REAL sum = root2 + (cm_abs(d.u) + cm_abs(d.v));
    CM_REAL outside = (CM_LIT(2.0) * d.rim + d.gap * d.gap) / sum; /* sqrt(2) - |u| - |v| */
    CM_REAL more = root2 + d.gap;
    CM_REAL less = root2 - d.gap;
    CM_REAL u_roots = cm_sqrt(more * sum) + cm_sqrt(outside * less);
    CM_REAL v_roots = cm_sqrt(less * sum) + cm_sqrt(outside * more);
    CM_REAL scale = CM_LIT(2.0) * root2;
    CM_REAL over = scale / (u_roots * v_roots);
    return CM_NAME(cm_make_uv)(
        cm_copysign(cm_min(CM_LIT(1.0), cm_abs(d.u) * (over * v_roots)), d.u),
        cm_copysign(cm_min(CM_LIT(1.0), cm_abs(d.v) * (over * u_roots)), d.v));
}

CM_FN CM_NAME(cm_disc_point) CM_NAME(cm_square_elliptical_inverse)(CM_REAL x, CM_REAL y)
{
    CM_NAME(cm_disc_point) r;
    r.u = x * cm_sqrt(CM_LIT(1.0) - CM_LIT(0.5) * (y * y));
    r.v = y * cm_sqrt(CM_LIT(1.0) - CM_LIT(0.5) * (x * x));
    r.rim = ((CM_LIT(1.0) - x) * (CM_LIT(1.0) + x)) * ((CM_LIT(1.0) - y) * (CM_LIT(1.0) + y));
    /* u^2 - v^2 = x^2 - y^2 */
    CM_REAL sum = cm_abs(r.u) + cm_abs(r.v);
    r.gap = (cm_abs(x) - cm_abs(y)) *
            ((cm_abs(x) + cm_abs(y)) / CM_SELECT(cm_less(CM_LIT(0.0), sum), sum, CM_LIT(1.0)));
    return r;
}

/* By the inverse's: with a = sqrt(1 - y^2 / 2), b = sqrt(1 - x^2 / 2) that is u_x = a, u_y = -x y / (2 a),
 * v_x = -x y / (2 b), v_y = b; the determinant is (1 - x^2 / 2 - y^2 / 2) / (a b). It is singular at the
 * corners. */
CM_FN CM_NAME(cm_jacobian)
    CM_NAME(cm_square_elliptical_jacobian)(CM_NAME(cm_disc_point) d, CM_REAL x, CM_REAL y)
{
    CM_UNUSED(d);
    CM_REAL a = cm_sqrt(CM_LIT(1.0) - CM_LIT(0.5) * (y * y));
    CM_REAL b = cm_sqrt(CM_LIT(1.0) - CM_LIT(0.5) * (x * x));
    CM_REAL x1 = (CM_LIT(1.0) - x) * (CM_LIT(1.0) + x);
    CM_REAL y1 = (CM_LIT(1.0) - y) * (CM_LIT(1.0) + y);
    CM_REAL scale = CM_LIT(2.0) / (x1 + y1);
    CM_REAL cross = CM_LIT(0.5) * (x * y);
    return CM_NAME(cm_make_jacobian)((a * (b * b)) * scale, (cross * b) * scale,
                                     (cross * a) * scale, ((a * a) * b) * scale);
}

#endif
