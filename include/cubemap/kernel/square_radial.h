/* SPDX-License-Identifier: MIT
 *
 * square:radial: radial stretching between disc and square. Rays from the centre stay rays; every circle
 * about it becomes a square.
 */
#ifdef CM_DESCRIPTORS
/* clang-format off */
CM_SQUARE(radial,
          .identifier = "square:radial",
          .aliases = "",
          .name = "radial stretching",
          .source = "Fong 2015; Lambers 2016, section 2.1 (sign corrected)",
          .kind = CM_KIND_DISC_SQUARE,
          .family = CM_FAMILY_BIVARIATE,
          .smooth_face = CM_SMOOTH_C0,
          .bounds = {.round_trip = 4, .plane_round_trip = 4, .forward = 2.25, .inverse = 2.75, .relative = 5})
/* clang-format on */
#else

CM_FN CM_NAME(cm_uv) CM_NAME(cm_square_radial_forward)(CM_NAME(cm_disc_point) d)
{
    CM_NAME(cm_disc_octant) at = CM_NAME(cm_disc_fold)(d.u, d.v, d.gap);
    CM_REAL radius = CM_NAME(cm_disc_radius)(at, d.rim);
    return CM_NAME(cm_disc_unfold)(at.u_wins, radius, radius * at.slope, d.u, d.v);
}

CM_FN CM_NAME(cm_disc_point) CM_NAME(cm_square_radial_inverse)(CM_REAL x, CM_REAL y)
{
    CM_NAME(cm_disc_octant) at = CM_NAME(cm_disc_fold)(x, y, cm_abs(x) - cm_abs(y));
    CM_REAL cosine = CM_NAME(cm_disc_cosine)(at.slope);
    return CM_NAME(cm_disc_unfold_point)(at.u_wins, at.major * cosine, at.minor * cosine,
                                         (CM_LIT(1.0) - at.major) * (CM_LIT(1.0) + at.major),
                                         (at.major - at.minor) * cosine, x, y);
}

/* With t the slope and w = sqrt(1 + t^2): x = major w, y = minor w. */
CM_FN CM_NAME(cm_jacobian)
    CM_NAME(cm_square_radial_jacobian)(CM_NAME(cm_disc_point) d, CM_REAL x, CM_REAL y)
{
    CM_UNUSED(x);
    CM_UNUSED(y);
    CM_NAME(cm_disc_octant) at = CM_NAME(cm_disc_fold)(d.u, d.v, d.gap);
    CM_REAL t = at.slope;
    CM_REAL cosine = CM_NAME(cm_disc_cosine)(t);
    CM_NAME(cm_jacobian) j =
        CM_NAME(cm_make_jacobian)(cosine, t * cosine, -((t * t * t) * cosine),
                                  (CM_LIT(1.0) + CM_LIT(2.0) * (t * t)) * cosine);
    return CM_NAME(cm_disc_unfold_jacobian)(at.u_wins, j, d.u, d.v);
}

#endif
