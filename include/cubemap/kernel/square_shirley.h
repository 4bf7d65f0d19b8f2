/* SPDX-License-Identifier: MIT
 *
 * square:shirley: the equal-area "concentric" mapping between disc and square: circles about the centre become
 * squares, and on each the angle becomes the place.
 */
#ifdef CM_DESCRIPTORS
/* clang-format off */
CM_SQUARE(shirley,
          .identifier = "square:shirley",
          .aliases = "square:concentric",
          .name = "Shirley's concentric equal-area mapping",
          .source = "Shirley & Chiu 1997; Lambers 2016, section 2.2",
          .kind = CM_KIND_DISC_SQUARE,
          .family = CM_FAMILY_BIVARIATE,
          .properties = CM_EQUAL_AREA,
          .smooth_face = CM_SMOOTH_C0,
          .bounds = {.round_trip = 4, .plane_round_trip = 4, .forward = 2.5, .inverse = 3, .relative = 5.5})
/* clang-format on */
#else

CM_FN CM_NAME(cm_uv) CM_NAME(cm_square_shirley_forward)(CM_NAME(cm_disc_point) d)
{
    CM_NAME(cm_disc_octant) at = CM_NAME(cm_disc_fold)(d.u, d.v, d.gap);
    CM_REAL radius = CM_NAME(cm_disc_radius)(at, d.rim);
    return CM_NAME(cm_disc_unfold)(at.u_wins, radius, radius * CM_NAME(cm_eighth_turns)(at.slope),
                                   d.u, d.v);
}

/* The slope is tan((pi / 4) minor / major), or where that is beside 1, from its complement. */
CM_FN CM_NAME(cm_disc_point) CM_NAME(cm_square_shirley_inverse)(CM_REAL x, CM_REAL y)
{
    CM_NAME(cm_disc_octant) at = CM_NAME(cm_disc_fold)(x, y, cm_abs(x) - cm_abs(y));
    CM_REAL apart = at.major - at.minor;
    CM_BOOL diagonal = cm_less(apart, at.minor);
    CM_REAL some = CM_SELECT(cm_less(CM_LIT(0.0), at.major), at.major, CM_LIT(1.0));
    CM_REAL tangent =
        CM_NAME(cm_slope_of_eighth_turns)(CM_SELECT(diagonal, apart, at.minor) / some);
    CM_REAL over = CM_LIT(1.0) / (CM_LIT(1.0) + tangent);
    CM_REAL slope = CM_SELECT(diagonal, (CM_LIT(1.0) - tangent) * over, tangent);
    CM_REAL rest = CM_SELECT(diagonal, CM_LIT(2.0) * (tangent * over), CM_LIT(1.0) - tangent);
    CM_REAL major = at.major * CM_NAME(cm_disc_cosine)(slope);
    return CM_NAME(cm_disc_unfold_point)(at.u_wins, major, major * slope,
                                         (CM_LIT(1.0) - at.major) * (CM_LIT(1.0) + at.major),
                                         major * rest, x, y);
}

/* With t the slope: x = r, y = (4 / pi) r atan t. */
CM_FN CM_NAME(cm_jacobian)
    CM_NAME(cm_square_shirley_jacobian)(CM_NAME(cm_disc_point) d, CM_REAL x, CM_REAL y)
{
    CM_UNUSED(x);
    CM_UNUSED(y);
    CM_NAME(cm_disc_octant) at = CM_NAME(cm_disc_fold)(d.u, d.v, d.gap);
    CM_REAL t = at.slope;
    CM_REAL cosine = CM_NAME(cm_disc_cosine)(t);
    CM_REAL excess = t * CM_NAME(cm_atan_excess)(t * t);
    CM_REAL scale = CM_LIT(1.27323954473516268615107010698011489628) * cosine;
    CM_NAME(cm_jacobian) j = CM_NAME(cm_make_jacobian)(cosine, t * cosine, scale * excess,
                                                       scale * (CM_LIT(1.0) + t * (t + excess)));
    return CM_NAME(cm_disc_unfold_jacobian)(at.u_wins, j, d.u, d.v);
}

#endif
