/* SPDX-License-Identifier: MIT
 *
 * octahedral:clarberg: Clarberg's equal-area mapping of the sphere to the octahedral square, as used by pbrt:
 * Shirley's concentric mapping of two discs, turned by an eighth. It is the quincuncial layout of Lambert's
 * projection and Shirley's mapping with the square's corners on the meridians between the axes.
 */
#ifdef CM_DESCRIPTORS
/* clang-format off */
CM_SPHERE(clarberg,
          .identifier = "octahedral:clarberg",
          .aliases = "clarberg",
          .name = "Clarberg's equal-area octahedral square",
          .source = "Clarberg 2008; Pharr, Jakob, Humphreys 2023, section 3.8.3 (reformulated)",
          .kind = CM_KIND_LAYOUT,
          .family = CM_FAMILY_HYBRID,
          .properties = CM_EQUAL_AREA,
          .smooth_face = CM_SMOOTH_C0,
          .bounds = {.round_trip = 7, .plane_round_trip = 5, .forward = 6, .inverse = 4.5, .relative = 8})
/* clang-format on */
#else

/* no parameters */
CM_FN CM_NAME(cm_constants) CM_NAME(cm_clarberg_prepare)(CM_NAME(cm_constants) k)
{
    return k;
}

/* A direction by its octant: x and y as major and minor, and the angle from the nearer pole. */
CM_STRUCT(cm_clarberg_place)
{
    CM_REAL sine;   /* of half the angle from the nearer pole */
    CM_REAL cosine; /* the other one */
    CM_REAL height; /* |z| */
    CM_REAL slope;  /* minor / major */
    CM_BOOL x_wins;
}
CM_STRUCT_END(cm_clarberg_place)

CM_FN CM_NAME(cm_clarberg_place) CM_NAME(cm_clarberg_locate)(CM_REAL x, CM_REAL y, CM_REAL z)
{
    CM_NAME(cm_bearing) b = CM_NAME(cm_azimuthal_bearing)(
        x, y, cm_abs(z), CM_NAME(cm_make_parameters)(CM_LIT(1.0), CM_LIT(0.0)));
    CM_NAME(cm_clarberg_place) r;
    r.sine = b.t.half_sine;
    r.cosine = b.t.half_cosine;
    r.height = b.t.cosine;
    r.x_wins = cm_at_least(cm_abs(x), cm_abs(y));
    CM_REAL major = cm_max(cm_abs(x), cm_abs(y));
    r.slope =
        cm_min(cm_abs(x), cm_abs(y)) / CM_SELECT(cm_less(CM_LIT(0.0), major), major, CM_LIT(1.0));
    return r;
}

/* (a, b) of the result is (u, v). */
CM_FN CM_NAME(cm_face_point)
    CM_NAME(cm_clarberg_project)(CM_REAL x, CM_REAL y, CM_REAL z, CM_NAME(cm_constants) k)
{
    CM_UNUSED(k);
    CM_NAME(cm_clarberg_place) at = CM_NAME(cm_clarberg_locate)(x, y, z);
    /* 1 - radius is height / (1 + radius), from which the outer radii are more accurate */
    CM_REAL near_centre = CM_LIT(1.41421356237309504880168872420969807857) * at.sine;
    CM_REAL rest = at.height / (CM_LIT(1.0) + near_centre);
    CM_BOOL outer = cm_less(CM_LIT(0.625), near_centre);
    CM_REAL radius = CM_SELECT(outer, CM_LIT(1.0) - rest, near_centre);
    CM_REAL part = CM_LIT(0.5) * CM_NAME(cm_eighth_turns)(at.slope);
    CM_REAL minor = radius * part;
    CM_REAL major = radius - minor;
    /* of the lower half: 1 - minor and 1 - major */
    CM_BOOL lower = cm_less(z, CM_LIT(0.0));
    CM_REAL far_major = CM_SELECT(outer, rest + major, CM_LIT(1.0) - minor);
    CM_REAL far_minor = CM_SELECT(outer, rest + minor, CM_LIT(1.0) - major);
    CM_NAME(cm_uv) uv =
        CM_NAME(cm_disc_unfold)(at.x_wins, cm_min(CM_LIT(1.0), CM_SELECT(lower, far_major, major)),
                                cm_min(CM_LIT(1.0), CM_SELECT(lower, far_minor, minor)), x, y);
    CM_NAME(cm_face_point) r;
    r.face = CM_LIT(0.0);
    r.a = uv.u;
    r.b = uv.v;
    return r;
}

/* A point of the upper half's square: radius, slope and which coordinate is greater. */
CM_STRUCT(cm_clarberg_spot)
{
    CM_REAL height; /* 1 - |u| - |v|, less than 0 in the lower half */
    CM_REAL radius;
    CM_REAL part;  /* minor / radius */
    CM_REAL slope; /* minor / major of x and y */
    CM_BOOL x_wins;
}
CM_STRUCT_END(cm_clarberg_spot)

CM_FN CM_NAME(cm_clarberg_spot) CM_NAME(cm_clarberg_find)(CM_REAL u, CM_REAL v)
{
    CM_NAME(cm_clarberg_spot) r;
    r.height = CM_NAME(cm_octahedral_height)(u, v);
    CM_NAME(cm_uv) p =
        CM_NAME(cm_octahedral_fold)(cm_less(r.height, CM_LIT(0.0)), cm_abs(u), cm_abs(v));
    r.radius = p.u + p.v;
    r.x_wins = cm_at_least(p.u, p.v);
    r.part = cm_min(p.u, p.v) / CM_SELECT(cm_less(CM_LIT(0.0), r.radius), r.radius, CM_LIT(1.0));
    r.slope = CM_NAME(cm_slope_of_eighth_turns)(cm_min(CM_LIT(1.0), CM_LIT(2.0) * r.part));
    return r;
}

CM_FN CM_NAME(cm_xyz)
    CM_NAME(cm_clarberg_unproject)(CM_REAL face, CM_REAL u, CM_REAL v, CM_NAME(cm_constants) k)
{
    CM_UNUSED(k);
    CM_UNUSED(face);
    CM_NAME(cm_clarberg_spot) at = CM_NAME(cm_clarberg_find)(u, v);
    CM_REAL major = (at.radius * cm_sqrt(CM_LIT(2.0) - at.radius * at.radius)) *
                    CM_NAME(cm_disc_cosine)(at.slope);
    CM_NAME(cm_uv) xy = CM_NAME(cm_disc_unfold)(at.x_wins, major, major * at.slope, u, v);
    CM_NAME(cm_xyz) r;
    r.x = xy.u;
    r.y = xy.v;
    r.z = at.height * (CM_LIT(1.0) + at.radius);
    return r;
}

/* Of major and minor by (x_major, x_minor, |z|), with t the angle from the pole: the radius grows with t by
 * slope, minor is (2 / pi) radius angle. */
CM_FN CM_NAME(cm_gradients)
    CM_NAME(cm_clarberg_gradients)(CM_REAL x, CM_REAL y, CM_REAL z, CM_NAME(cm_constants) k)
{
    CM_UNUSED(k);
    CM_NAME(cm_clarberg_place) at = CM_NAME(cm_clarberg_locate)(x, y, z);
    CM_REAL half_root2 = CM_LIT(0.7071067811865475244008443621048490392848);
    CM_REAL slope = half_root2 * at.cosine;
    CM_REAL sine = CM_LIT(2.0) * (at.sine * at.cosine);
    CM_REAL cosine_lon = CM_NAME(cm_disc_cosine)(at.slope);
    CM_REAL sine_lon = at.slope * cosine_lon;
    CM_REAL part = CM_LIT(0.5) * CM_NAME(cm_eighth_turns)(at.slope);
    CM_REAL around = (CM_LIT(0.6366197723675813430755350534900574481378) * half_root2) / at.cosine;
    CM_REAL out_major = (slope * at.height) * cosine_lon;
    CM_REAL out_minor = (slope * at.height) * sine_lon;
    CM_REAL out_z = -(slope * sine);
    CM_REAL minor_major = part * out_major - around * sine_lon;
    CM_REAL minor_minor = part * out_minor + around * cosine_lon;
    CM_REAL minor_z = part * out_z;
    CM_REAL major_major = out_major - minor_major;
    CM_REAL major_minor = out_minor - minor_minor;
    CM_REAL major_z = out_z - minor_z;

    CM_REAL sign_x = cm_copysign(CM_LIT(1.0), x);
    CM_REAL sign_y = cm_copysign(CM_LIT(1.0), y);
    CM_BOOL lower = cm_less(z, CM_LIT(0.0));
    CM_REAL sign_z = CM_SELECT(lower, CM_LIT(-1.0), CM_LIT(1.0));
    CM_NAME(cm_uv) by_x = CM_NAME(cm_octahedral_turn)(
        lower, sign_x, sign_y, sign_x * CM_SELECT(at.x_wins, major_major, minor_minor),
        sign_x * CM_SELECT(at.x_wins, minor_major, major_minor));
    CM_NAME(cm_uv) by_y = CM_NAME(cm_octahedral_turn)(
        lower, sign_x, sign_y, sign_y * CM_SELECT(at.x_wins, major_minor, minor_major),
        sign_y * CM_SELECT(at.x_wins, minor_minor, major_major));
    CM_NAME(cm_uv) by_z = CM_NAME(cm_octahedral_turn)(
        lower, sign_x, sign_y, sign_z * CM_SELECT(at.x_wins, major_z, minor_z),
        sign_z * CM_SELECT(at.x_wins, minor_z, major_z));
    CM_NAME(cm_gradients) g;
    g.a_x = by_x.u;
    g.a_y = by_y.u;
    g.a_z = by_z.u;
    g.b_x = by_x.v;
    g.b_y = by_y.v;
    g.b_z = by_z.v;
    return g;
}

/* With t the angle from the pole and f that from the major axis, radius = major + minor and
 * f = (pi / 2) minor / radius; half_cosine is cos(t / 2), sin t = sqrt(2) radius half_cosine. */
CM_FN CM_NAME(cm_tangents)
    CM_NAME(cm_clarberg_tangents)(CM_REAL face, CM_REAL u, CM_REAL v, CM_NAME(cm_constants) k)
{
    CM_UNUSED(k);
    CM_UNUSED(face);
    CM_NAME(cm_clarberg_spot) at = CM_NAME(cm_clarberg_find)(u, v);
    CM_REAL root2 = CM_LIT(1.41421356237309504880168872420969807857);
    CM_REAL half_cosine = cm_sqrt(CM_LIT(1.0) - CM_LIT(0.5) * (at.radius * at.radius));
    CM_REAL outwards = root2 / half_cosine; /* dt / d radius */
    CM_REAL sine = (root2 * at.radius) * half_cosine;
    CM_REAL height = cm_abs(at.height) * (CM_LIT(1.0) + at.radius);
    CM_REAL around = (CM_LIT(1.570796326794896619231321691639751442099) * root2) * half_cosine;
    CM_REAL cosine_lon = CM_NAME(cm_disc_cosine)(at.slope);
    CM_REAL sine_lon = at.slope * cosine_lon;
    CM_REAL out_major = (outwards * height) * cosine_lon;
    CM_REAL out_minor = (outwards * height) * sine_lon;
    CM_REAL out_z = -(outwards * sine);
    CM_REAL by_major = -(around * at.part); /* of the angle, times sin t */
    CM_REAL by_minor = around * (CM_LIT(1.0) - at.part);

    CM_REAL sign_x = cm_copysign(CM_LIT(1.0), u);
    CM_REAL sign_y = cm_copysign(CM_LIT(1.0), v);
    CM_BOOL lower = cm_less(at.height, CM_LIT(0.0));
    CM_REAL sign_z = CM_SELECT(lower, CM_LIT(-1.0), CM_LIT(1.0));
    CM_REAL a_major = out_major - by_major * sine_lon; /* of the coordinate of major by major ... */
    CM_REAL a_minor = out_major - by_minor * sine_lon; /* ... and by minor */
    CM_REAL b_major = out_minor + by_major * cosine_lon;
    CM_REAL b_minor = out_minor + by_minor * cosine_lon;
    CM_NAME(cm_uv) of_x = CM_NAME(cm_octahedral_turn)(
        lower, sign_x, sign_y, sign_x * CM_SELECT(at.x_wins, a_major, b_minor),
        sign_x * CM_SELECT(at.x_wins, a_minor, b_major));
    CM_NAME(cm_uv) of_y = CM_NAME(cm_octahedral_turn)(
        lower, sign_x, sign_y, sign_y * CM_SELECT(at.x_wins, b_major, a_minor),
        sign_y * CM_SELECT(at.x_wins, b_minor, a_major));
    CM_NAME(cm_uv) of_z =
        CM_NAME(cm_octahedral_turn)(lower, sign_x, sign_y, sign_z * out_z, sign_z * out_z);
    CM_NAME(cm_tangents) t;
    t.x_a = of_x.u;
    t.x_b = of_x.v;
    t.y_a = of_y.u;
    t.y_b = of_y.v;
    t.z_a = of_z.u;
    t.z_b = of_z.v;
    return t;
}

#endif
