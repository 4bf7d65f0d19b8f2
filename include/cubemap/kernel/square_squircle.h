/* SPDX-License-Identifier: MIT
 *
 * square:squircle: the mapping along Fernandez-Guasti's squircles: circles about the centre become squircles,
 * and rays stay rays. Here s = 1 is the rim, and with the point's rim and gap nothing cancels.
 */
#ifdef CM_DESCRIPTORS
/* clang-format off */
CM_SQUARE(squircle,
          .identifier = "square:squircle",
          .aliases = "square:fernandez-guasti",
          .name = "Fernandez-Guasti's squircles",
          .source = "Fong 2015; Lambers 2016, section 2.3 (reformulated)",
          .kind = CM_KIND_DISC_SQUARE,
          .family = CM_FAMILY_BIVARIATE,
          .smooth_face = CM_SMOOTH_C1,
          .bounds = {.round_trip = 5, .plane_round_trip = 5, .forward = 3, .inverse = 2.5, .relative = 4})
/* clang-format on */
#else

/* The square of the sum of minor and major over the square of the radius. */
CM_FN CM_REAL CM_NAME(cm_squircle_spread)(CM_REAL slope)
{
    CM_REAL sum = CM_LIT(1.0) + slope;
    return (sum * sum) / (CM_LIT(1.0) + slope * slope);
}

CM_FN CM_NAME(cm_uv) CM_NAME(cm_square_squircle_forward)(CM_NAME(cm_disc_point) d)
{
    CM_NAME(cm_disc_octant) at = CM_NAME(cm_disc_fold)(d.u, d.v, d.gap);
    CM_REAL radicand = d.rim + (d.gap * d.gap) * CM_NAME(cm_squircle_spread)(at.slope);
    CM_REAL scale = cm_sqrt(CM_LIT(2.0) / (CM_LIT(1.0) + cm_sqrt(radicand)));
    return CM_NAME(cm_make_uv)(cm_copysign(cm_min(CM_LIT(1.0), cm_abs(d.u) * scale), d.u),
                               cm_copysign(cm_min(CM_LIT(1.0), cm_abs(d.v) * scale), d.v));
}

/* The factor that makes (u, v) of (x, y): sqrt(1 - x^2 y^2 / (x^2 + y^2)). */
CM_FN CM_REAL CM_NAME(cm_squircle_factor)(CM_REAL major, CM_REAL slope)
{
    CM_REAL t2 = slope * slope;
    CM_REAL inside = (CM_LIT(1.0) - major) * (CM_LIT(1.0) + major);
    return cm_sqrt((CM_LIT(1.0) + t2 * inside) / (CM_LIT(1.0) + t2));
}

CM_FN CM_NAME(cm_disc_point) CM_NAME(cm_square_squircle_inverse)(CM_REAL x, CM_REAL y)
{
    CM_REAL apart = cm_abs(x) - cm_abs(y);
    CM_NAME(cm_disc_octant) at = CM_NAME(cm_disc_fold)(x, y, apart);
    CM_REAL factor = CM_NAME(cm_squircle_factor)(at.major, at.slope);
    CM_NAME(cm_disc_point) r;
    r.u = x * factor;
    r.v = y * factor;
    r.rim = ((CM_LIT(1.0) - x) * (CM_LIT(1.0) + x)) * ((CM_LIT(1.0) - y) * (CM_LIT(1.0) + y));
    r.gap = apart * factor;
    return r;
}

/* By the inverse's: with g its factor and (c, s) the unit vector of (x, y), rho^2 = x^2 + y^2,
 * u_x = g - rho^2 c^2 s^4 / g, u_y = -rho^2 c^5 s / g, and so on; the determinant is
 * 1 - 2 x^2 y^2 / rho^2. It is singular at the corners. */
CM_FN CM_NAME(cm_jacobian)
    CM_NAME(cm_square_squircle_jacobian)(CM_NAME(cm_disc_point) d, CM_REAL x, CM_REAL y)
{
    CM_NAME(cm_disc_octant) at = CM_NAME(cm_disc_fold)(x, y, d.gap);
    CM_REAL t2 = at.slope * at.slope;
    CM_REAL over = CM_LIT(1.0) / (CM_LIT(1.0) + t2);
    CM_REAL factor = CM_NAME(cm_squircle_factor)(at.major, at.slope);
    CM_REAL part = ((at.major * at.major) * over) / factor; /* rho^2 c^4 / g */
    CM_REAL x1 = (CM_LIT(1.0) - at.major) * (CM_LIT(1.0) + at.major);
    CM_REAL y1 = (CM_LIT(1.0) - at.minor) * (CM_LIT(1.0) + at.minor);
    CM_REAL determinant = (y1 + t2 * x1) * over;
    CM_REAL scale = CM_LIT(1.0) / determinant;
    CM_REAL cross = (part * over) * at.slope;
    CM_NAME(cm_jacobian) j = CM_NAME(cm_make_jacobian)(
        (factor - (part * over) * t2) * scale, cross * scale, (cross * (t2 * t2)) * scale,
        (factor - (part * over) * (t2 * t2)) * scale);
    return CM_NAME(cm_disc_unfold_jacobian)(at.u_wins, j, x, y);
}

#endif
