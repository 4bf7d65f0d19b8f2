/* SPDX-License-Identifier: MIT
 *
 * layout: how the square of a mapping between disc and square becomes an image of the whole sphere.
 *
 * border: the whole sphere is on the disc, and the rim, which is one pole, is the square's border.
 * quincuncial: one hemisphere is in the middle, as a square that stands on its corner; the other one is the four
 * triangles around it, each mirrored at its side of the middle square (Peirce 1879).
 */
#ifdef CM_DESCRIPTORS
/* clang-format off */
CM_LAYOUT(border,
          .identifier = "border",
          .aliases = "",
          .name = "whole sphere on one square, a pole at its border",
          .source = "Lambers 2016, section 4.1",
          .kind = CM_KIND_LAYOUT,
          .family = CM_FAMILY_HYBRID,
          .smooth_face = CM_SMOOTH_C0,
          .parameter_count = 3,
          .parameter = {CM_PARAMETERS_CENTRE, CM_PARAMETER_BETA("that of the mixture")},
          .parts = "lambert,shirley",
          .bounds = {.round_trip = 0, .plane_round_trip = 5.5, .forward = 3.5, .inverse = 3, .relative = 0})
CM_LAYOUT(quincuncial,
          .identifier = "quincuncial",
          .aliases = "peirce:stereographic,conformal",
          .name = "whole sphere on one square, a hemisphere in its middle",
          .source = "Peirce 1879; Fong & Vogel 2011; Lambers 2016, section 4.2",
          .kind = CM_KIND_LAYOUT,
          .family = CM_FAMILY_HYBRID,
          .smooth_face = CM_SMOOTH_C0,
          .parameter_count = 3,
          .parameter = {CM_PARAMETERS_CENTRE, CM_PARAMETER_BETA("that of the mixture")},
          .parts = "stereographic,conformal",
          .bounds = {.round_trip = 7.4, .plane_round_trip = 5, .forward = 3.5, .inverse = 3.25, .relative = 0})
/* clang-format on */
#else

/* A point (a, b) of the square of a hemisphere; side is -1 for that of the antipode. */
CM_FN CM_NAME(cm_uv) CM_NAME(cm_quincuncial_place)(CM_REAL a, CM_REAL b, CM_REAL side)
{
    CM_REAL one_half = CM_LIT(0.5);
    CM_REAL x = one_half * (a + b);
    CM_REAL y = one_half * (b - a);
    CM_BOOL outer = cm_less(side, CM_LIT(0.0));
    return CM_NAME(cm_make_uv)(CM_SELECT(outer, cm_copysign(CM_LIT(1.0) - cm_abs(y), x), x),
                               CM_SELECT(outer, cm_copysign(CM_LIT(1.0) - cm_abs(x), y), y));
}

/* And back: (a, b), and the side as face, 1 or -1. */
CM_FN CM_NAME(cm_face_point) CM_NAME(cm_quincuncial_unplace)(CM_REAL u, CM_REAL v)
{
    CM_BOOL outer = cm_less(CM_LIT(1.0), cm_abs(u) + cm_abs(v));
    CM_REAL x = CM_SELECT(outer, cm_copysign(CM_LIT(1.0) - cm_abs(v), u), u);
    CM_REAL y = CM_SELECT(outer, cm_copysign(CM_LIT(1.0) - cm_abs(u), v), v);
    CM_NAME(cm_face_point) r;
    r.face = CM_SELECT(outer, CM_LIT(-1.0), CM_LIT(1.0));
    r.a = x - y;
    r.b = x + y;
    return r;
}

/* The derivatives of (u, v) by (a, b). */
CM_FN CM_NAME(cm_jacobian) CM_NAME(cm_quincuncial_jacobian)(CM_REAL a, CM_REAL b, CM_REAL side)
{
    CM_REAL one_half = CM_LIT(0.5);
    CM_BOOL outer = cm_less(side, CM_LIT(0.0));
    CM_REAL turn = -(cm_copysign(one_half, a + b) * cm_copysign(CM_LIT(1.0), b - a));
    return CM_NAME(cm_make_jacobian)(
        CM_SELECT(outer, -turn, one_half), CM_SELECT(outer, turn, one_half),
        CM_SELECT(outer, turn, -one_half), CM_SELECT(outer, turn, one_half));
}

#endif
