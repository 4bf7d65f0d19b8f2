/* SPDX-License-Identifier: MIT
 *
 * rhealpix: HEALPix on one picture, as PROJ has it: the belt is four squares in a row from longitude -180 to
 * 180, and each cap is a square at one of them. u and v are PROJ's x and y on the unit sphere over pi, so that
 * u is in [-1, 1], v in [-3/4, 3/4]; what is neither belt nor cap is no point of the map.
 *
 * It is healpix (healpix_faces.h) in longitudes from the middle of the first square, its faces put side by side.
 */
#ifdef CM_DESCRIPTORS
/* clang-format off */
CM_SPHERE(rhealpix,
                    .identifier = "rhealpix",
                    .aliases = "",
                    .name = "HEALPix rearranged on one picture",
                    .source = "Gibb, Raichev, Speth 2016; PROJ, rhealpix",
                    .kind = CM_KIND_LAYOUT,
                    .family = CM_FAMILY_HYBRID,
                    .properties = CM_EQUAL_AREA,
                    .smooth_face = CM_SMOOTH_C0,
                    .parameter_count = 2,
                    .parameter = {{.name = "north",
                                   .meaning = "square of the belt that the north cap is at, from the west",
                                   .high = 3.0,
                                   .whole = 1},
                                  {.name = "south",
                                   .meaning = "square of the belt that the south cap is at",
                                   .high = 3.0,
                                   .whole = 1}},
                    .bounds = {.round_trip = 7.5, .plane_round_trip = 8, .forward = 4.75, .inverse = 5})
/* clang-format on */
#else

/* Of a cap at square n: k0 is the middle of the square, and cap and face are turned to each other by a quarter
 * turns, of which k1 is the cosine and k2 the sine; k3, k4, k5 of the south. */
CM_FN CM_NAME(cm_constants) CM_NAME(cm_rhealpix_prepare)(CM_NAME(cm_constants) k)
{
    CM_REAL none = CM_LIT(0.0);
    CM_REAL one = CM_LIT(1.0);
    CM_REAL north = k.k0;
    CM_REAL south = k.k1;
    CM_BOOL north_third = cm_equal(north, CM_LIT(3.0));
    CM_BOOL south_third = cm_equal(south, CM_LIT(3.0));
    k.k0 = CM_LIT(0.5) * north - CM_LIT(0.75);
    k.k1 = CM_SELECT(north_third, none, one - north);
    k.k2 = CM_SELECT(north_third, -one, CM_SELECT(cm_equal(north, one), one, none));
    k.k3 = CM_LIT(0.5) * south - CM_LIT(0.75);
    k.k4 = CM_SELECT(south_third, none, one - south);
    k.k5 = CM_SELECT(south_third, one, CM_SELECT(cm_equal(south, one), -one, none));
    return k;
}

/* Longitudes from the middle of the first square, 135 degrees west; the length grows by sqrt 2. */
CM_FN CM_NAME(cm_xyz) CM_NAME(cm_rhealpix_turn)(CM_REAL x, CM_REAL y, CM_REAL z)
{
    CM_REAL scale = CM_NAME(cm_azimuthal_scale)(CM_NAME(cm_magnitude)(x, y, z));
    x = x * scale;
    y = y * scale;
    CM_NAME(cm_xyz) r;
    r.x = -(x + y);
    r.y = x - y;
    r.z = CM_LIT(1.41421356237309504880168872420969807857) * (z * scale);
    return r;
}

/* And back, of vectors of any meaning, without the growth. */
CM_FN CM_NAME(cm_xyz) CM_NAME(cm_rhealpix_turn_back)(CM_REAL x, CM_REAL y, CM_REAL z)
{
    CM_REAL half_root2 = CM_LIT(0.7071067811865475244008443621048490392848);
    CM_NAME(cm_xyz) r;
    r.x = half_root2 * (y - x);
    r.y = -(half_root2 * (x + y));
    r.z = z;
    return r;
}

/* How healpix's (a, b) on a face lies in the picture: the middle, and the cosine and sine of its turn. */
CM_STRUCT(cm_rhealpix_square)
{
    CM_REAL u;
    CM_REAL v;
    CM_REAL cosine;
    CM_REAL sine;
}
CM_STRUCT_END(cm_rhealpix_square)

CM_FN CM_NAME(cm_rhealpix_square) CM_NAME(cm_rhealpix_place)(CM_REAL face, CM_NAME(cm_constants) k)
{
    CM_REAL none = CM_LIT(0.0);
    CM_REAL middle = CM_LIT(0.5);
    CM_BOOL north = cm_equal(face, CM_LIT(4.0));
    CM_BOOL south = cm_equal(face, CM_LIT(5.0));
    CM_NAME(cm_rhealpix_square) r;
    r.u = CM_SELECT(north, k.k0, CM_SELECT(south, k.k3, middle * face - CM_LIT(0.75)));
    r.v = CM_SELECT(north, middle, CM_SELECT(south, -middle, none));
    r.cosine = CM_SELECT(north, k.k1, CM_SELECT(south, k.k4, CM_LIT(1.0)));
    r.sine = CM_SELECT(north, k.k2, CM_SELECT(south, k.k5, none));
    return r;
}

/* (a, b) of the result is (u, v). */
CM_FN CM_NAME(cm_face_point)
    CM_NAME(cm_rhealpix_project)(CM_REAL x, CM_REAL y, CM_REAL z, CM_NAME(cm_constants) k)
{
    CM_REAL quarter = CM_LIT(0.25);
    CM_NAME(cm_xyz) d = CM_NAME(cm_rhealpix_turn)(x, y, z);
    CM_NAME(cm_face_point) p = CM_NAME(cm_healpix_project)(d.x, d.y, d.z, k);
    CM_NAME(cm_rhealpix_square) at = CM_NAME(cm_rhealpix_place)(p.face, k);
    CM_NAME(cm_face_point) r;
    r.face = CM_LIT(0.0);
    r.a = at.u + quarter * (at.cosine * p.a + at.sine * p.b);
    r.b = at.v + quarter * (at.cosine * p.b - at.sine * p.a);
    return r;
}

/* The face of a point of the picture, and (a, b) there, [-1, 1] each if it is a point of the map. */
CM_FN CM_NAME(cm_face_point)
    CM_NAME(cm_rhealpix_find)(CM_REAL u, CM_REAL v, CM_NAME(cm_constants) k)
{
    CM_REAL quarter = CM_LIT(0.25);
    CM_REAL four = CM_LIT(4.0);
    CM_REAL belt_face = CM_SELECT(cm_less(u, CM_LIT(0.0)),
                                  CM_SELECT(cm_less(u, CM_LIT(-0.5)), CM_LIT(0.0), CM_LIT(1.0)),
                                  CM_SELECT(cm_less(u, CM_LIT(0.5)), CM_LIT(2.0), CM_LIT(3.0)));
    CM_NAME(cm_face_point) r;
    /* where no cap is, the belt has the tolerance of an edge */
    CM_REAL beyond = CM_LIT(0.250000001);
    CM_REAL north = CM_SELECT(cm_less(beyond, cm_abs(u - k.k0)), beyond, quarter);
    CM_REAL south = CM_SELECT(cm_less(beyond, cm_abs(u - k.k3)), beyond, quarter);
    r.face =
        CM_SELECT(cm_less(north, v), four, CM_SELECT(cm_less(v, -south), CM_LIT(5.0), belt_face));
    CM_NAME(cm_rhealpix_square) at = CM_NAME(cm_rhealpix_place)(r.face, k);
    CM_REAL a = four * (u - at.u);
    CM_REAL b = four * (v - at.v);
    r.a = at.cosine * a - at.sine * b;
    r.b = at.cosine * b + at.sine * a;
    return r;
}

CM_FN CM_NAME(cm_xyz)
    CM_NAME(cm_rhealpix_unproject)(CM_REAL face, CM_REAL u, CM_REAL v, CM_NAME(cm_constants) k)
{
    CM_UNUSED(face);
    CM_REAL none = CM_LIT(0.0);
    CM_REAL one = CM_LIT(1.0);
    CM_NAME(cm_face_point) p = CM_NAME(cm_rhealpix_find)(u, v, k);
    CM_REAL outside = cm_max(cm_abs(p.a), cm_abs(p.b));
    /* 0, or NaN beside the caps and for NaN; of 0 / 0 in so many words compilers make NaN of either sign */
    CM_REAL nothing =
        (outside - outside) / CM_SELECT(cm_at_least(CM_LIT(1.000000004), outside), one, none);
    CM_REAL a = cm_min(cm_max(p.a, -one), one);
    CM_REAL b = cm_min(cm_max(p.b, -one), one);
    CM_NAME(cm_xyz) d = CM_NAME(cm_healpix_unproject)(p.face, a, b, k);
    return CM_NAME(cm_rhealpix_turn_back)(d.x + nothing, d.y + nothing, d.z + nothing);
}

CM_FN CM_NAME(cm_gradients)
    CM_NAME(cm_rhealpix_gradients)(CM_REAL x, CM_REAL y, CM_REAL z, CM_NAME(cm_constants) k)
{
    CM_REAL quarter = CM_LIT(0.25);
    CM_NAME(cm_xyz) d = CM_NAME(cm_rhealpix_turn)(x, y, z);
    CM_REAL face = CM_NAME(cm_healpix_project)(d.x, d.y, d.z, k).face;
    CM_NAME(cm_rhealpix_square) at = CM_NAME(cm_rhealpix_place)(face, k);
    CM_NAME(cm_gradients) g = CM_NAME(cm_healpix_gradients)(d.x, d.y, d.z, k);
    CM_NAME(cm_xyz) a = CM_NAME(cm_rhealpix_turn_back)(g.a_x, g.a_y, g.a_z);
    CM_NAME(cm_xyz) b = CM_NAME(cm_rhealpix_turn_back)(g.b_x, g.b_y, g.b_z);
    g.a_x = quarter * (at.cosine * a.x + at.sine * b.x);
    g.a_y = quarter * (at.cosine * a.y + at.sine * b.y);
    g.a_z = quarter * (at.cosine * a.z + at.sine * b.z);
    g.b_x = quarter * (at.cosine * b.x - at.sine * a.x);
    g.b_y = quarter * (at.cosine * b.y - at.sine * a.y);
    g.b_z = quarter * (at.cosine * b.z - at.sine * a.z);
    return g;
}

CM_FN CM_NAME(cm_tangents)
    CM_NAME(cm_rhealpix_tangents)(CM_REAL face, CM_REAL u, CM_REAL v, CM_NAME(cm_constants) k)
{
    CM_REAL four = CM_LIT(4.0);
    CM_NAME(cm_face_point) p = CM_NAME(cm_rhealpix_find)(u, v, k);
    CM_NAME(cm_rhealpix_square) at = CM_NAME(cm_rhealpix_place)(p.face, k);
    CM_NAME(cm_tangents) t = CM_NAME(cm_healpix_tangents)(p.face, p.a, p.b, k);
    CM_REAL nothing = CM_NAME(cm_rhealpix_unproject)(face, u, v, k).x * CM_LIT(0.0);
    CM_NAME(cm_xyz) by_a =
        CM_NAME(cm_rhealpix_turn_back)(t.x_a + nothing, t.y_a + nothing, t.z_a + nothing);
    CM_NAME(cm_xyz) by_b =
        CM_NAME(cm_rhealpix_turn_back)(t.x_b + nothing, t.y_b + nothing, t.z_b + nothing);
    t.x_a = four * (at.cosine * by_a.x + at.sine * by_b.x);
    t.y_a = four * (at.cosine * by_a.y + at.sine * by_b.y);
    t.z_a = four * (at.cosine * by_a.z + at.sine * by_b.z);
    t.x_b = four * (at.cosine * by_b.x - at.sine * by_a.x);
    t.y_b = four * (at.cosine * by_b.y - at.sine * by_a.y);
    t.z_b = four * (at.cosine * by_b.z - at.sine * by_a.z);
    return t;
}

#endif
