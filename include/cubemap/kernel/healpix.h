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
          .aliases = "",
          .name = "HEALPix on six faces",
          .source = "Gorski et al. 2005; Calabretta & Roukema 2007; Dimitrijevic, Lambers, Rancic "
                    "2016, section 4.7",
          .family = CM_FAMILY_HYBRID,
          .properties = CM_EQUAL_AREA,
          .smooth_face = CM_SMOOTH_C0,
          .smooth_edge = CM_SMOOTH_C0,
          .bounds = {.round_trip = 5.8, .plane_round_trip = 8, .forward = 5, .inverse = 3,
                     .relative = 8})
/* clang-format on */
#else

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

/* x, y, z finite and not all zero. (a, b) of the result is (u, v). */
CM_FN CM_NAME(cm_face_point) CM_NAME(cm_healpix_project)(CM_REAL x, CM_REAL y, CM_REAL z)
{
    CM_REAL scale = CM_SELECT(cm_less(CM_NAME(cm_magnitude)(x, y, z), CM_HEALPIX_SMALL),
                              CM_HEALPIX_LARGE, CM_LIT(1.0));
    CM_REAL height = scale * cm_abs(z);
    CM_BOOL x_wins = cm_at_least(cm_abs(x), cm_abs(y));
    CM_REAL sign = cm_copysign(CM_LIT(1.0), CM_SELECT(x_wins, x, y));
    CM_REAL major = scale * CM_SELECT(x_wins, cm_abs(x), cm_abs(y));
    CM_REAL minor = scale * CM_SELECT(x_wins, sign * y, -(sign * x));
    /* tangent of the longitude from the middle of the sector; at a pole any will do */
    CM_REAL t = minor / CM_SELECT(cm_less(CM_LIT(0.0), major), major, CM_LIT(1.0));
    CM_REAL square = CM_LIT(1.0) + t * t;
    /* (4 / pi) atan t = t (1 + E) / (1 + E1), where 1 + E1 = pi / 4 */
    CM_REAL excess =
        CM_NAME(cm_atan_excess)(t * t) + CM_LIT(0.21460183660255169038433915418012427895);
    CM_REAL f =
        CM_NAME(cm_stretch_inside)(t, excess * CM_LIT(1.27323954473516268615107010698011489628));
    CM_REAL sector = CM_SELECT(x_wins, CM_LIT(1.0) - sign, CM_LIT(2.0) - sign);

    CM_REAL root = cm_sqrt(square); /* the distance from the axis is major times that */
    CM_BOOL polar = cm_less((CM_HEALPIX_POLAR * major) * root, height);
    /* polar: the tangent of the distance from the pole, r, and n = sqrt(1 + r^2), so that 1 - |sin lat|
     * is r^2 / (n (n + 1)); on the belt |sin lat| is r / n with the part of z to major */
    CM_REAL r = (CM_SELECT(polar, major, height) / CM_SELECT(polar, height, major)) *
                CM_SELECT(polar, root, CM_LIT(1.0));
    CM_REAL n = cm_sqrt(CM_SELECT(polar, CM_LIT(1.0), square) + r * r);
    CM_REAL sigma = cm_min(CM_LIT(1.0), r * cm_sqrt(CM_LIT(3.0) / (n * (n + CM_LIT(1.0)))));
    CM_REAL belt = cm_min(CM_LIT(1.0), CM_LIT(1.5) * (r / n));
    CM_REAL along = sigma * f;
    /* the triangle of sector k is that of sector 0 turned by k right angles; the south is the north
     * mirrored */
    CM_REAL signed_along = sign * along;
    CM_REAL signed_sigma = sign * sigma;
    CM_REAL cap_a = CM_SELECT(x_wins, signed_along, signed_sigma);
    CM_REAL cap_b = CM_SELECT(x_wins, -signed_sigma, signed_along);
    CM_BOOL south = cm_less(z, CM_LIT(0.0));

    CM_NAME(cm_face_point) point;
    point.face = CM_SELECT(polar, CM_SELECT(south, CM_LIT(5.0), CM_LIT(4.0)), sector);
    point.a = CM_SELECT(polar, cap_a, f);
    point.b = CM_SELECT(polar, CM_SELECT(south, -cap_b, cap_b), cm_copysign(belt, z));
    return point;
}

/* The unit direction of (u, v) on a face. */
CM_FN CM_NAME(cm_xyz) CM_NAME(cm_healpix_unproject)(CM_REAL face, CM_REAL u, CM_REAL v)
{
    CM_BOOL polar = cm_less(CM_LIT(3.5), face);
    CM_BOOL south = cm_less(CM_LIT(4.5), face);
    /* in a cap: the sector by the larger coordinate, ties to the sectors of the x axis, as forward */
    CM_REAL w = CM_SELECT(south, -v, v);
    CM_BOOL x_sector = cm_at_least(cm_abs(w), cm_abs(u));
    CM_REAL cap_sign = cm_copysign(CM_LIT(1.0), CM_SELECT(x_sector, -w, u));
    CM_REAL sigma = CM_SELECT(x_sector, cm_abs(w), cm_abs(u));
    CM_REAL cap_along = cap_sign * CM_SELECT(x_sector, u, w);
    CM_REAL cap_f = cap_along / CM_SELECT(cm_less(CM_LIT(0.0), sigma), sigma, CM_LIT(1.0));
    /* on the belt: the sector is the face */
    CM_BOOL minus = cm_less(CM_LIT(1.5), face);
    CM_REAL belt_sign = CM_SELECT(minus, CM_LIT(-1.0), CM_LIT(1.0));
    CM_BOOL x_face = cm_less(face - CM_SELECT(minus, CM_LIT(2.0), CM_LIT(0.0)), CM_LIT(0.5));

    CM_REAL f = CM_SELECT(polar, cap_f, u);
    CM_REAL sign = CM_SELECT(polar, cap_sign, belt_sign);
    CM_REAL along_x = CM_SELECT(polar, CM_SELECT(x_sector, CM_LIT(1.0), CM_LIT(0.0)),
                                CM_SELECT(x_face, CM_LIT(1.0), CM_LIT(0.0)));

    CM_REAL lon = f * CM_LIT(0.78539816339744830961566084581987572105); /* pi / 4 */
    CM_REAL sine = CM_NAME(cm_sin_quarter)(lon);
    CM_REAL cosine = CM_LIT(1.0) - CM_NAME(cm_versine_quarter)(lon);

    CM_REAL s2 = sigma * sigma;
    CM_REAL belt_z = v * CM_LIT(2.0) / CM_LIT(3.0);
    CM_REAL cap_z = CM_LIT(1.0) - s2 / CM_LIT(3.0);
    CM_REAL rho = CM_SELECT(polar, sigma * (cm_sqrt(CM_LIT(6.0) - s2) / CM_LIT(3.0)),
                            cm_sqrt((CM_LIT(1.0) - belt_z) * (CM_LIT(1.0) + belt_z)));
    CM_REAL major = sign * (rho * cosine);
    CM_REAL minor = sign * (rho * sine);
    CM_BOOL x_major = cm_less(CM_LIT(0.5), along_x);
    CM_NAME(cm_xyz) r;
    r.x = CM_SELECT(x_major, major, -minor);
    r.y = CM_SELECT(x_major, minor, major);
    r.z = CM_SELECT(polar, CM_SELECT(south, -cap_z, cap_z), belt_z);
    return r;
}

#endif
