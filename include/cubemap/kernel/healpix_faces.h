/* SPDX-License-Identifier: MIT
 *
 * healpix: the HEALPix projection (H = 4, K = 3) on six faces. The equatorial belt |z| <= 2/3 is
 * Lambert's cylindrical projection on faces 0..3 of the frame geo; the four triangles of a polar cap
 * meet in the middle of face 4 or 5. Centred on longitude 0, which is standard HEALPix after a shift
 * of longitude by 45 degrees. Poles are on the z axis in every frame.
 *
 * sigma = sqrt(3 (1 - |z|)) is computed from the distance to the axis, because 1 - |z| has lost it
 * near a pole.
 */
#ifdef CM_DESCRIPTORS
/* clang-format off */
CM_SPHERE(healpix,
          .identifier = "healpix",
          .aliases = "",
          .name = "HEALPix on six faces",
          .source = "Gorski et al. 2005; Calabretta & Roukema 2007; Dimitrijevic, Lambers, Rancic "
                    "2016, section 4.7",
          .family = CM_FAMILY_HYBRID,
          .properties = CM_EQUAL_AREA,
          .smooth_face = CM_SMOOTH_C0,
          .smooth_edge = CM_SMOOTH_C0,
          .smooth_corner = CM_SMOOTH_C0,
          .bounds = {.round_trip = 5.8, .plane_round_trip = 8, .forward = 5, .inverse = 3,
                     .relative = 8},
          .fast = CM_FAST_FORWARD | CM_FAST_INVERSE)
/* clang-format on */
#else

/* no parameters */
CM_FN CM_NAME(cm_constants) CM_NAME(cm_healpix_prepare)(CM_NAME(cm_constants) k)
{
    return k;
}

/* A direction is polar if |z| is above 2 / sqrt 5 of its distance from the axis, which is 2/3 of its
 * length. What rounding leaves beside that belongs to the belt, so that a point of the boundary that
 * has been a direction comes back as a point of the belt's edge: the factor is greater by a few eps.
 * Below CM_HEALPIX_SMALL directions are scaled up, because a product would lose digits. */
#if CM_REAL_BITS == 64
#define CM_HEALPIX_POLAR CM_LIT(0.894427190999916411)
#define CM_HEALPIX_SMALL CM_LIT(1.0e-150)
#define CM_HEALPIX_LARGE CM_LIT(4.1495155688809930e180) /* 2^600 */
#elif CM_REAL_BITS == 32
#define CM_HEALPIX_POLAR CM_LIT(0.894427478)
#define CM_HEALPIX_SMALL CM_LIT(1.0e-18)
#define CM_HEALPIX_LARGE CM_LIT(1152921504606846976.0) /* 2^60 */
#else
#define CM_HEALPIX_POLAR CM_LIT(0.89442719099991587856366946749251049418)
#define CM_HEALPIX_SMALL CM_LIT(1.0e-150)
#define CM_HEALPIX_LARGE CM_LIT(4.1495155688809930e180) /* 2^600 */
#endif

/* Where a direction is: the sector of longitude, and cap or belt. */
CM_STRUCT(cm_healpix_place)
{
    CM_BOOL x_wins; /* is the middle of the sector on the x axis? */
    CM_BOOL polar;
    CM_REAL sign;   /* of x or y there */
    CM_REAL t;      /* tangent of the longitude from there, towards greater ones */
    CM_REAL square; /* 1 + t^2 */
    CM_REAL root;   /* of square */
    CM_REAL r; /* in a cap the tangent of the distance from the pole, on the belt |z| / major */
}
CM_STRUCT_END(cm_healpix_place)

CM_FN CM_REAL CM_NAME(cm_healpix_scale)(CM_REAL x, CM_REAL y, CM_REAL z)
{
    return CM_SELECT(cm_less(CM_NAME(cm_magnitude)(x, y, z), CM_HEALPIX_SMALL), CM_HEALPIX_LARGE,
                     CM_LIT(1.0));
}

/* x, y, z finite and not all zero; with CM_HEALPIX_NONE_SMALL all directions have a scale of 1. */
CM_FN CM_NAME(cm_healpix_place) CM_NAME(cm_healpix_locate)(CM_REAL x, CM_REAL y, CM_REAL z)
{
    CM_NAME(cm_healpix_place) p;
#ifdef CM_HEALPIX_NONE_SMALL
    CM_REAL scale = CM_LIT(1.0);
#else
    CM_REAL scale = CM_NAME(cm_healpix_scale)(x, y, z);
#endif
    CM_REAL height = scale * cm_abs(z);
    p.x_wins = cm_at_least(cm_abs(x), cm_abs(y));
    p.sign = cm_copysign(CM_LIT(1.0), CM_SELECT(p.x_wins, x, y));
    CM_REAL major = scale * CM_SELECT(p.x_wins, cm_abs(x), cm_abs(y));
    CM_REAL minor = scale * CM_SELECT(p.x_wins, p.sign * y, -(p.sign * x));
    /* at a pole any longitude will do */
    p.t = minor / CM_SELECT(cm_less(CM_LIT(0.0), major), major, CM_LIT(1.0));
    p.square = CM_LIT(1.0) + p.t * p.t;
    p.root = cm_sqrt(p.square); /* the distance from the axis is major times that */
    p.polar = cm_less((CM_HEALPIX_POLAR * major) * p.root, height);
    p.r = (CM_SELECT(p.polar, major, height) / CM_SELECT(p.polar, height, major)) *
          CM_SELECT(p.polar, p.root, CM_LIT(1.0));
    return p;
}

/* How far in its sector a direction is: what faces and pixels (libcubemap/batch/healpix_lattice.inc) are made of. */
CM_STRUCT(cm_healpix_reach)
{
    CM_REAL sector; /* 0 to 3: the one whose middle is on +x, +y, -x, -y */
    CM_REAL f;      /* -1..1 through it, towards greater longitudes */
    CM_REAL sigma;  /* sqrt(3 (1 - |sin lat|)), in a cap */
    CM_REAL belt;   /* (3 / 2) |sin lat|, on the belt */
}
CM_STRUCT_END(cm_healpix_reach)

CM_FN CM_NAME(cm_healpix_reach) CM_NAME(cm_healpix_measure)(CM_NAME(cm_healpix_place) at)
{
    CM_NAME(cm_healpix_reach) reach;
    reach.sector = CM_SELECT(at.x_wins, CM_LIT(1.0) - at.sign, CM_LIT(2.0) - at.sign);
    reach.f = CM_NAME(cm_eighth_turns)(at.t);

    /* polar: with n = sqrt(1 + r^2), 1 - |sin lat| is r^2 / (n (n + 1)); on the belt |sin lat| is r / n
     * with the part of z to major */
    CM_REAL n2 = cm_mad(at.r, at.r, CM_SELECT(at.polar, CM_LIT(1.0), at.square));
    CM_REAL over_n = CM_NAME(cm_inverse_root)(n2);
    /* by the divider, where the other one is made of multiplications: both have work then */
    CM_REAL over_nn = CM_LIT(1.0) / cm_sqrt(cm_mad(n2, over_n, n2)); /* 1 / sqrt(n (n + 1)) */
    reach.sigma =
        cm_min(CM_LIT(1.0), at.r * (over_nn * CM_LIT(1.73205080756887729352744634150587236694)));
    reach.belt = cm_min(CM_LIT(1.0), CM_LIT(1.5) * (at.r * over_n));
    return reach;
}

/* x, y, z finite and not all zero. (a, b) of the result is (u, v). */
CM_FN CM_NAME(cm_face_point)
    CM_NAME(cm_healpix_project)(CM_REAL x, CM_REAL y, CM_REAL z, CM_NAME(cm_constants) k)
{
    CM_UNUSED(k);
    CM_NAME(cm_healpix_place) at = CM_NAME(cm_healpix_locate)(x, y, z);
    CM_NAME(cm_healpix_reach) reach = CM_NAME(cm_healpix_measure)(at);
    CM_REAL f = reach.f;
    CM_REAL sigma = reach.sigma;
    CM_REAL along = sigma * f;
    /* the triangle of sector k is that of sector 0 turned by k right angles; the south is the north
     * mirrored */
    CM_REAL signed_along = at.sign * along;
    CM_REAL signed_sigma = at.sign * sigma;
    CM_REAL cap_a = CM_SELECT(at.x_wins, signed_along, signed_sigma);
    CM_REAL cap_b = CM_SELECT(at.x_wins, -signed_sigma, signed_along);
    CM_BOOL south = cm_less(z, CM_LIT(0.0));

    CM_NAME(cm_face_point) r;
    r.face = CM_SELECT(at.polar, CM_SELECT(south, CM_LIT(5.0), CM_LIT(4.0)), reach.sector);
    r.a = CM_SELECT(at.polar, cap_a, f);
    r.b = CM_SELECT(at.polar, CM_SELECT(south, -cap_b, cap_b), cm_copysign(reach.belt, z));
    return r;
}

/* Where (u, v) of a face is: cap or belt, and the sector; in a cap that of the larger coordinate, and
 * equal ones belong to the sectors of the x axis, as forward. */
CM_STRUCT(cm_healpix_spot)
{
    CM_BOOL x_wins;
    CM_BOOL polar;
    CM_BOOL south;
    CM_REAL sign;
    CM_REAL sigma; /* in a cap */
    CM_REAL f;     /* -1..1 through the sector */
}
CM_STRUCT_END(cm_healpix_spot)

CM_FN CM_NAME(cm_healpix_spot) CM_NAME(cm_healpix_find)(CM_REAL face, CM_REAL u, CM_REAL v)
{
    CM_NAME(cm_healpix_spot) p;
    p.polar = cm_less(CM_LIT(3.5), face);
    p.south = cm_less(CM_LIT(4.5), face);
    CM_REAL w = CM_SELECT(p.south, -v, v);
    CM_BOOL x_sector = cm_at_least(cm_abs(w), cm_abs(u));
    CM_REAL cap_sign = cm_copysign(CM_LIT(1.0), CM_SELECT(x_sector, -w, u));
    p.sigma = CM_SELECT(x_sector, cm_abs(w), cm_abs(u));
    CM_REAL cap_along = cap_sign * CM_SELECT(x_sector, u, w);
    CM_REAL cap_f = cap_along / CM_SELECT(cm_less(CM_LIT(0.0), p.sigma), p.sigma, CM_LIT(1.0));
    /* on the belt the sector is the face */
    CM_BOOL minus = cm_less(CM_LIT(1.5), face);
    CM_REAL belt_sign = CM_SELECT(minus, CM_LIT(-1.0), CM_LIT(1.0));
    CM_BOOL x_face = cm_less(face - CM_SELECT(minus, CM_LIT(2.0), CM_LIT(0.0)), CM_LIT(0.5));
    CM_REAL along_x = CM_SELECT(p.polar, CM_SELECT(x_sector, CM_LIT(1.0), CM_LIT(0.0)),
                                CM_SELECT(x_face, CM_LIT(1.0), CM_LIT(0.0)));
    p.x_wins = cm_less(CM_LIT(0.5), along_x);
    p.sign = CM_SELECT(p.polar, cap_sign, belt_sign);
    p.f = CM_SELECT(p.polar, cap_f, u);
    return p;
}

/* The unit direction at the longitude of a spot, at distance rho from the axis and height z. */
CM_FN CM_NAME(cm_xyz)
    CM_NAME(cm_healpix_around)(CM_NAME(cm_healpix_spot) at, CM_REAL rho, CM_REAL z)
{
    CM_REAL lon = at.f * CM_LIT(0.78539816339744830961566084581987572105); /* pi / 4 */
    CM_REAL sine = CM_NAME(cm_sin_quarter)(lon);
    CM_REAL cosine = CM_LIT(1.0) - CM_NAME(cm_versine_quarter)(lon);
    CM_REAL major = at.sign * (rho * cosine);
    CM_REAL minor = at.sign * (rho * sine);
    CM_NAME(cm_xyz) r;
    r.x = CM_SELECT(at.x_wins, major, -minor);
    r.y = CM_SELECT(at.x_wins, minor, major);
    r.z = z;
    return r;
}

/* The unit direction of (u, v) on a face. */
CM_FN CM_NAME(cm_xyz)
    CM_NAME(cm_healpix_unproject)(CM_REAL face, CM_REAL u, CM_REAL v, CM_NAME(cm_constants) k)
{
    CM_UNUSED(k);
    CM_NAME(cm_healpix_spot) at = CM_NAME(cm_healpix_find)(face, u, v);
    CM_REAL s2 = at.sigma * at.sigma;
    CM_REAL belt_z = v * CM_LIT(2.0) / CM_LIT(3.0);
    CM_REAL cap_z = CM_LIT(1.0) - s2 / CM_LIT(3.0);
    CM_REAL rho = CM_SELECT(at.polar, at.sigma * (cm_sqrt(CM_LIT(6.0) - s2) / CM_LIT(3.0)),
                            cm_sqrt((CM_LIT(1.0) - belt_z) * (CM_LIT(1.0) + belt_z)));
    CM_REAL z = CM_SELECT(at.polar, CM_SELECT(at.south, -cap_z, cap_z), belt_z);
    return CM_NAME(cm_healpix_around)(at, rho, z);
}

/* The derivatives of (u, v) or by (u, v), which stand as a and b, from those by or of two coordinates of
 * a sector: along and sigma in a cap, f and v on the belt, of which the second is called across here.
 * Vectors have the components major, towards the middle of the sector, and minor, towards greater
 * longitude; in a cap z is that of the north. x_wins and sign are those of project. A cap's u and v are
 * along and sigma with the sector's sign, which cancels against that of major and minor. */
CM_FN CM_NAME(cm_tangents)
    CM_NAME(cm_healpix_turn)(CM_BOOL polar, CM_BOOL x_wins, CM_BOOL south, CM_REAL sign,
                             CM_NAME(cm_xyz) along, CM_NAME(cm_xyz) across)
{
    CM_REAL side = CM_SELECT(south, CM_LIT(-1.0), CM_LIT(1.0));
    CM_REAL flat_sign = CM_SELECT(polar, CM_LIT(1.0), sign);
    CM_REAL z_sign = CM_SELECT(polar, sign * side, CM_LIT(1.0));
    CM_REAL along_x = flat_sign * CM_SELECT(x_wins, along.x, -along.y);
    CM_REAL along_y = flat_sign * CM_SELECT(x_wins, along.y, along.x);
    CM_REAL along_z = z_sign * along.z;
    CM_REAL across_x = flat_sign * CM_SELECT(x_wins, across.x, -across.y);
    CM_REAL across_y = flat_sign * CM_SELECT(x_wins, across.y, across.x);
    CM_REAL across_z = z_sign * across.z;
    CM_NAME(cm_tangents) r;
    r.x_a = CM_SELECT(polar, CM_SELECT(x_wins, along_x, across_x), along_x);
    r.y_a = CM_SELECT(polar, CM_SELECT(x_wins, along_y, across_y), along_y);
    r.z_a = CM_SELECT(polar, CM_SELECT(x_wins, along_z, across_z), along_z);
    r.x_b = CM_SELECT(polar, side * CM_SELECT(x_wins, -across_x, along_x), across_x);
    r.y_b = CM_SELECT(polar, side * CM_SELECT(x_wins, -across_y, along_y), across_y);
    r.z_b = CM_SELECT(polar, side * CM_SELECT(x_wins, -across_z, along_z), across_z);
    return r;
}

/* The derivatives of cm_healpix_unproject by (u, v), which stand as a and b. On a border of two sectors
 * they are those of the sector that unproject chooses. At a pole, where four sectors meet and the map
 * has no derivatives, they are those of the sector of v's axis at its middle. */
CM_FN CM_NAME(cm_tangents)
    CM_NAME(cm_healpix_tangents)(CM_REAL face, CM_REAL u, CM_REAL v, CM_NAME(cm_constants) k)
{
    CM_UNUSED(k);
    CM_NAME(cm_healpix_spot) at = CM_NAME(cm_healpix_find)(face, u, v);
    CM_REAL quarter = CM_LIT(0.78539816339744830961566084581987572105); /* pi / 4 */
    CM_REAL third = CM_LIT(0.33333333333333333333333333333333333333);
    CM_REAL lon = at.f * quarter;
    CM_REAL sine = CM_NAME(cm_sin_quarter)(lon);
    CM_REAL cosine = CM_LIT(1.0) - CM_NAME(cm_versine_quarter)(lon);

    /* the distance from the axis is sigma root / 3 in a cap, and root on the belt */
    CM_REAL s2 = at.sigma * at.sigma;
    CM_REAL belt_z = CM_LIT(2.0) * (v * third);
    CM_REAL root = cm_sqrt(
        CM_SELECT(at.polar, CM_LIT(6.0) - s2, (CM_LIT(1.0) - belt_z) * (CM_LIT(1.0) + belt_z)));
    /* of which the derivative by sigma, or by v, at a constant f */
    CM_REAL outwards = CM_SELECT(at.polar, CM_LIT(6.0) - CM_LIT(2.0) * s2, CM_LIT(-2.0) * belt_z) /
                       (CM_LIT(3.0) * root);
    CM_REAL turn = quarter * CM_SELECT(at.polar, third * root, root);
    /* f = along / sigma turns back when sigma grows */
    CM_REAL back = CM_SELECT(at.polar, turn * at.f, CM_LIT(0.0));
    CM_NAME(cm_xyz) along;
    along.x = -(turn * sine);
    along.y = turn * cosine;
    along.z = CM_LIT(0.0);
    CM_NAME(cm_xyz) across;
    across.x = outwards * cosine + back * sine;
    across.y = outwards * sine - back * cosine;
    across.z = (CM_LIT(2.0) * third) * CM_SELECT(at.polar, -at.sigma, CM_LIT(1.0));
    return CM_NAME(cm_healpix_turn)(at.polar, at.x_wins, at.south, at.sign, along, across);
}

/* The derivatives of u and v, which stand as a and b, by a direction of unit length: those at (x, y, z)
 * scaled to it, however long that is. On a border, of sectors or of belt and cap, they are those of the
 * side to which cm_healpix_project counts the point. At a pole, where u and v have none, they are those
 * of the sector of the x axis, on the side of the sign of x, at its middle.
 *
 * With s = |sin lat|, rho the distance from the axis and h = sqrt((1 + s) / 3) = rho / sigma, in a cap
 *     grad sigma = (3 / 2) h (s along major, -rho along z)
 *     grad along = f grad sigma + (4 / pi) / h along minor,
 * in which nothing vanishes towards the pole. */
CM_FN CM_NAME(cm_gradients)
    CM_NAME(cm_healpix_gradients)(CM_REAL x, CM_REAL y, CM_REAL z, CM_NAME(cm_constants) k)
{
    CM_UNUSED(k);
    CM_NAME(cm_healpix_place) at = CM_NAME(cm_healpix_locate)(x, y, z);
    CM_REAL n = cm_sqrt(CM_SELECT(at.polar, CM_LIT(1.0), at.square) + at.r * at.r);

    /* one division for 1 / root, 1 / n and 1 / (n + 1) */
    CM_REAL n1 = n + CM_LIT(1.0);
    CM_REAL n_root = n * at.root;
    CM_REAL inverse_all = CM_LIT(1.0) / (n_root * n1);
    CM_REAL inverse_n = (inverse_all * at.root) * n1;
    CM_REAL cosine = (inverse_all * n) * n1;
    CM_REAL sine = at.t * cosine;
    CM_REAL rho = CM_SELECT(at.polar, at.r, at.root) * inverse_n;
    CM_REAL s = CM_SELECT(at.polar, inverse_n, cm_copysign(at.r * inverse_n, z));

    CM_REAL four = CM_LIT(1.27323954473516268615107010698011489628); /* 4 / pi */
    CM_REAL f = CM_SELECT(at.polar, four * (at.t + at.t * CM_NAME(cm_atan_excess)(at.t * at.t)),
                          CM_LIT(0.0));
    CM_REAL conjugate = cm_sqrt((CM_LIT(3.0) * n) * n1);    /* h = conjugate / (3 n) */
    CM_REAL half_h = (CM_LIT(0.5) * conjugate) * inverse_n; /* (3 / 2) h */
    CM_REAL inverse_rho = n * cosine;                       /* on the belt */
    CM_REAL around = four * CM_SELECT(at.polar, conjugate * (inverse_all * n_root), inverse_rho);
    /* on the belt v is (3 / 2) s, with the sign of z in s */
    CM_REAL inwards = CM_SELECT(at.polar, half_h * s, CM_LIT(-1.5) * (s * rho));
    CM_NAME(cm_xyz) across;
    across.x = inwards * cosine;
    across.y = inwards * sine;
    across.z = rho * CM_SELECT(at.polar, -half_h, CM_LIT(1.5) * rho);
    CM_NAME(cm_xyz) along;
    along.x = f * across.x - around * sine;
    along.y = f * across.y + around * cosine;
    along.z = f * across.z;
    CM_NAME(cm_tangents) both = CM_NAME(cm_healpix_turn)(
        at.polar, at.x_wins, cm_less(z, CM_LIT(0.0)), at.sign, along, across);
    CM_NAME(cm_gradients) g;
    g.a_x = both.x_a;
    g.a_y = both.y_a;
    g.a_z = both.z_a;
    g.b_x = both.x_b;
    g.b_y = both.y_b;
    g.b_z = both.z_b;
    return g;
}

#endif
