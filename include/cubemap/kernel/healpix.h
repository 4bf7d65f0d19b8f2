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
          .smooth_edge = CM_SMOOTH_C0)
/* clang-format on */
#else

/* x, y, z finite and not all zero. (a, b) of the result is (u, v). */
CM_FN CM_NAME(cm_face_point) CM_NAME(cm_healpix_project)(CM_REAL x, CM_REAL y, CM_REAL z)
{
    CM_REAL scale = CM_NAME(cm_magnitude)(x, y, z);
    CM_REAL sx = x / scale;
    CM_REAL sy = y / scale;
    CM_REAL sz = z / scale;
    CM_REAL ax = cm_abs(x);
    CM_REAL ay = cm_abs(y);
    CM_BOOL x_wins = ax >= ay;
    CM_REAL sign = cm_copysign(CM_LIT(1.0), CM_SELECT(x_wins, x, y));
    CM_REAL major = CM_SELECT(x_wins, ax, ay);
    CM_REAL minor = CM_SELECT(x_wins, sign * y, -(sign * x));
    /* tangent of the longitude from the middle of the sector; at a pole any will do */
    CM_REAL t = minor / CM_SELECT(major > CM_LIT(0.0), major, CM_LIT(1.0));
    CM_REAL f = CM_NAME(cm_atan_unit)(t) * CM_LIT(1.2732395447351626861510701069801); /* 4 / pi */
    f = cm_copysign(cm_min(cm_abs(f), CM_LIT(1.0)), t);
    CM_REAL sector = CM_SELECT(x_wins, CM_LIT(1.0) - sign, CM_LIT(2.0) - sign);

    CM_REAL n = cm_sqrt((sx * sx + sy * sy) + sz * sz);
    CM_REAL height = cm_abs(sz) / n;
    CM_BOOL polar = CM_LIT(3.0) * cm_abs(sz) > CM_LIT(2.0) * n;

    CM_REAL rho = CM_SELECT(x_wins, cm_abs(sx), cm_abs(sy)) * cm_sqrt(CM_LIT(1.0) + t * t);
    CM_REAL sigma = cm_min(rho * cm_sqrt(CM_LIT(3.0) / (n * (n + cm_abs(sz)))), CM_LIT(1.0));
    CM_REAL along = sigma * f;
    /* the triangle of sector k is that of sector 0 turned by k right angles; the south is the north
     * mirrored */
    CM_REAL signed_along = sign * along;
    CM_REAL signed_sigma = sign * sigma;
    CM_REAL cap_a = CM_SELECT(x_wins, signed_along, signed_sigma);
    CM_REAL cap_b = CM_SELECT(x_wins, -signed_sigma, signed_along);
    CM_BOOL south = sz < CM_LIT(0.0);

    CM_NAME(cm_face_point) r;
    r.face = CM_SELECT(polar, CM_SELECT(south, CM_LIT(5.0), CM_LIT(4.0)), sector);
    r.a = CM_SELECT(polar, cap_a, f);
    r.b = CM_SELECT(polar, CM_SELECT(south, -cap_b, cap_b),
                    cm_copysign(cm_min(CM_LIT(1.5) * height, CM_LIT(1.0)), sz));
    return r;
}

/* The unit direction of (u, v) on a face. */
CM_FN CM_NAME(cm_xyz) CM_NAME(cm_healpix_unproject)(CM_REAL face, CM_REAL u, CM_REAL v)
{
    CM_BOOL polar = face > CM_LIT(3.5);
    CM_BOOL south = face > CM_LIT(4.5);
    /* in a cap: the sector by the larger coordinate, ties to the sectors of the x axis, as forward */
    CM_REAL w = CM_SELECT(south, -v, v);
    CM_BOOL x_sector = cm_abs(w) >= cm_abs(u);
    CM_REAL cap_sign = cm_copysign(CM_LIT(1.0), CM_SELECT(x_sector, -w, u));
    CM_REAL sigma = CM_SELECT(x_sector, cm_abs(w), cm_abs(u));
    CM_REAL cap_along = cap_sign * CM_SELECT(x_sector, u, w);
    CM_REAL cap_f = cap_along / CM_SELECT(sigma > CM_LIT(0.0), sigma, CM_LIT(1.0));
    /* on the belt: the sector is the face */
    CM_BOOL minus = face > CM_LIT(1.5);
    CM_REAL belt_sign = CM_SELECT(minus, CM_LIT(-1.0), CM_LIT(1.0));
    CM_BOOL x_face = face - CM_SELECT(minus, CM_LIT(2.0), CM_LIT(0.0)) < CM_LIT(0.5);

    CM_REAL f = CM_SELECT(polar, cap_f, u);
    CM_REAL sign = CM_SELECT(polar, cap_sign, belt_sign);
    CM_REAL along_x = CM_SELECT(CM_SELECT(polar, x_sector, x_face), CM_LIT(1.0), CM_LIT(0.0));

    CM_REAL lon = f * CM_LIT(0.78539816339744830961566084581988); /* pi / 4 */
    CM_REAL sine = CM_NAME(cm_sin_quarter)(lon);
    CM_REAL cosine = CM_LIT(1.0) - CM_NAME(cm_versine_quarter)(lon);

    CM_REAL s2 = sigma * sigma;
    CM_REAL belt_z = v * CM_LIT(2.0) / CM_LIT(3.0);
    CM_REAL cap_z = CM_LIT(1.0) - s2 / CM_LIT(3.0);
    CM_REAL rho = CM_SELECT(polar, sigma * (cm_sqrt(CM_LIT(6.0) - s2) / CM_LIT(3.0)),
                            cm_sqrt((CM_LIT(1.0) - belt_z) * (CM_LIT(1.0) + belt_z)));
    CM_REAL major = sign * (rho * cosine);
    CM_REAL minor = sign * (rho * sine);
    CM_BOOL x_major = along_x > CM_LIT(0.5);
    CM_NAME(cm_xyz) r;
    r.x = CM_SELECT(x_major, major, -minor);
    r.y = CM_SELECT(x_major, minor, major);
    r.z = CM_SELECT(polar, CM_SELECT(south, -cap_z, cap_z), belt_z);
    return r;
}

#endif
