/* SPDX-License-Identifier: MIT
 *
 * cobe: the COBE quadrilateralized spherical cube (CSC), nearly equal-area.
 *
 * The published pair is not one: the inverse polynomial misses the inverse of the forward one by up
 * to 45 arc seconds, 1.39 km on Earth. Here the forward polynomial is the definition and the inverse
 * solves it, by Newton's method from the published inverse; legacy=1 gives the published inverse
 * itself, for files that were made with it. What FITS calls the direction from (chi, psi) to (x, y)
 * is the forward one here.
 */
#ifdef CM_DESCRIPTORS
/* clang-format off */
CM_WARP_VARIANTS(cobe,
                 .identifier = "cobe",
                 .aliases = "csc",
                 .name = "COBE quadrilateralized spherical cube",
                 .source = "Chan & O'Neill 1975; Calabretta & Greisen 2002, CSC; Dimitrijevic, Lambers, "
                           "Rancic 2016, eq. 4.6 to 4.9",
                 .family = CM_FAMILY_BIVARIATE,
                 .smooth_face = CM_SMOOTH_ANALYTIC,
                 .smooth_edge = CM_SMOOTH_C0,
                 .smooth_corner = CM_SMOOTH_ANALYTIC,
                 .parameter_count = 1,
                 .parameter = {{.name = "legacy",
                                .meaning = "1 for the published inverse, 0 for the exact one",
                                .standard = 0.0,
                                .low = 0.0,
                                .high = 1.0,
                                .whole = 1}},
                 .bounds = {.round_trip = 4, .plane_round_trip = 4, .forward = 2, .inverse = 4,
                            .relative = 8},
                 .fast = CM_FAST_INVERSE)
/* clang-format on */
#else

/* the variant is the legacy inverse */
CM_FN CM_NAME(cm_constants) CM_NAME(cm_cobe_prepare)(CM_NAME(cm_constants) k)
{
    k.variant = k.k0;
    return k;
}

/* The forward polynomial is F(p, q) = p (1 + (1 - p^2) B), v = F(q, p); b is B(X = p^2, Y = q^2), and
 * b_x, b_y are its derivatives by X and Y. */
CM_STRUCT(cm_cobe_value)
{
    CM_REAL b;
    CM_REAL b_x;
    CM_REAL b_y;
}
CM_STRUCT_END(cm_cobe_value)

#define CM_COBE_GAMMA CM_LIT(0.37484847732) /* gamma - 1 */
#define CM_COBE_CAPITAL_GAMMA CM_LIT(-0.13161671474)
#define CM_COBE_M_GAMMA CM_LIT(0.136486206721) /* M - Gamma */
#define CM_COBE_OMEGA CM_LIT(-0.159596235474)
#define CM_COBE_D0 CM_LIT(0.0759196200467)
#define CM_COBE_D1 CM_LIT(-0.0217762490699)
#define CM_COBE_C00 CM_LIT(0.141189631152)
#define CM_COBE_C10 CM_LIT(0.0809701286525)
#define CM_COBE_C01 CM_LIT(-0.281528535557)
#define CM_COBE_C20 CM_LIT(-0.178251207466)
#define CM_COBE_C11 CM_LIT(0.15384112876)
#define CM_COBE_C02 CM_LIT(0.106959469314)

CM_FN CM_NAME(cm_cobe_value) CM_NAME(cm_cobe_evaluate)(CM_REAL x, CM_REAL y)
{
    CM_REAL x1 = CM_LIT(1.0) - x;
    CM_REAL y1 = CM_LIT(1.0) - y;
    CM_REAL s = cm_mad(y, cm_mad(y, CM_COBE_C02, cm_mad(x, CM_COBE_C11, CM_COBE_C01)),
                       cm_mad(x, cm_mad(x, CM_COBE_C20, CM_COBE_C10), CM_COBE_C00));
    CM_REAL s_x = cm_mad(y, CM_COBE_C11, cm_mad(x, CM_LIT(2.0) * CM_COBE_C20, CM_COBE_C10));
    CM_REAL s_y = cm_mad(y, CM_LIT(2.0) * CM_COBE_C02, cm_mad(x, CM_COBE_C11, CM_COBE_C01));
    CM_REAL inner = cm_mad(y1, s, cm_mad(x, CM_COBE_M_GAMMA, CM_COBE_CAPITAL_GAMMA));
    CM_REAL d = cm_mad(x, CM_COBE_D1, CM_COBE_D0);
    CM_REAL outer = cm_mad(-x1, d, CM_COBE_OMEGA);
    CM_NAME(cm_cobe_value) r;
    r.b = CM_COBE_GAMMA + cm_mad(y, inner, x * outer);
    r.b_x =
        cm_mad(y, cm_mad(y1, s_x, CM_COBE_M_GAMMA), cm_mad(x, cm_mad(-x1, CM_COBE_D1, d), outer));
    r.b_y = cm_mad(y, cm_mad(y1, s_y, -s), inner);
    return r;
}

CM_FN CM_REAL CM_NAME(cm_cobe_polynomial)(CM_REAL w, CM_REAL b)
{
    return CM_NAME(cm_stretch)(w, ((CM_LIT(1.0) - w) * (CM_LIT(1.0) + w)) * b);
}

CM_FN CM_NAME(cm_uv) CM_NAME(cm_cobe_forward)(CM_REAL p, CM_REAL q, CM_NAME(cm_constants) k)
{
    CM_UNUSED(k);
    CM_REAL x = p * p;
    CM_REAL y = q * q;
    return CM_NAME(cm_make_uv)(CM_NAME(cm_cobe_polynomial)(p, CM_NAME(cm_cobe_evaluate)(x, y).b),
                               CM_NAME(cm_cobe_polynomial)(q, CM_NAME(cm_cobe_evaluate)(y, x).b));
}

/* The published inverse: p = u (1 + (1 - u^2) sum P_ij u^2i v^2j), coefficients of FITS WCS paper II;
 * in the form of cm_cobe_polynomial this is its sum. */
CM_FN CM_REAL CM_NAME(cm_cobe_published)(CM_REAL x, CM_REAL y)
{
    CM_REAL y0 =
        cm_mad(x,
               cm_mad(x,
                      cm_mad(x,
                             cm_mad(x,
                                    cm_mad(x, cm_mad(x, CM_LIT(0.02584375), CM_LIT(0.25795794)),
                                           CM_LIT(-0.62930065)),
                                    CM_LIT(0.54852384)),
                             CM_LIT(-0.22797056)),
                      CM_LIT(-0.07629969)),
               CM_LIT(-0.27292696));
    CM_REAL y1 = cm_mad(x,
                        cm_mad(x,
                               cm_mad(x,
                                      cm_mad(x, cm_mad(x, CM_LIT(-0.53022337), CM_LIT(1.71547508)),
                                             CM_LIT(-1.74114454)),
                                      CM_LIT(0.48051509)),
                               CM_LIT(-0.01471565)),
                        CM_LIT(-0.02819452));
    CM_REAL y2 = cm_mad(
        x,
        cm_mad(x, cm_mad(x, cm_mad(x, CM_LIT(-0.83180469), CM_LIT(0.98938102)), CM_LIT(0.30803317)),
               CM_LIT(-0.56800938)),
        CM_LIT(0.27058160));
    CM_REAL y3 =
        cm_mad(x, cm_mad(x, cm_mad(x, CM_LIT(0.08693841), CM_LIT(-0.93678576)), CM_LIT(1.50880086)),
               CM_LIT(-0.60441560));
    CM_REAL y4 = cm_mad(x, cm_mad(x, CM_LIT(0.33887446), CM_LIT(-1.41601920)), CM_LIT(0.93412077));
    CM_REAL y5 = cm_mad(x, CM_LIT(0.52032238), CM_LIT(-0.63915306));
    CM_REAL y6 = CM_LIT(0.14381585);
    return cm_mad(y, cm_mad(y, cm_mad(y, cm_mad(y, cm_mad(y, cm_mad(y, y6, y5), y4), y3), y2), y1),
                  y0);
}

/* One Newton step from (p, q) towards F(p, q) = u, F(q, p) = v, with f the values of F at (p, q) and g
 * those at (q, p). Serves every polynomial of this form (zucker_cobe.h). */
CM_FN CM_NAME(cm_pq) CM_NAME(cm_cobe_newton)(CM_REAL p, CM_REAL q, CM_REAL u, CM_REAL v,
                                             CM_NAME(cm_cobe_value) f, CM_NAME(cm_cobe_value) g)
{
    CM_REAL x = p * p;
    CM_REAL y = q * q;
    CM_REAL x1 = (CM_LIT(1.0) - p) * (CM_LIT(1.0) + p);
    CM_REAL y1 = (CM_LIT(1.0) - q) * (CM_LIT(1.0) + q);
    CM_REAL f_p = cm_mad(CM_LIT(2.0) * x, cm_mad(x1, f.b_x, -f.b), cm_mad(x1, f.b, CM_LIT(1.0)));
    CM_REAL g_q = cm_mad(CM_LIT(2.0) * y, cm_mad(y1, g.b_x, -g.b), cm_mad(y1, g.b, CM_LIT(1.0)));
    CM_REAL f_q = CM_LIT(2.0) * p * q * (x1 * f.b_y);
    CM_REAL g_p = CM_LIT(2.0) * p * q * (y1 * g.b_y);
    CM_REAL f_rest = cm_mad(-p, x1 * f.b, u - p);
    CM_REAL g_rest = cm_mad(-q, y1 * g.b, v - q);
    CM_REAL scale = CM_LIT(1.0) / cm_mad(f_p, g_q, -(f_q * g_p));
    return CM_NAME(cm_make_pq)(cm_mad(cm_mad(f_rest, g_q, -(g_rest * f_q)), scale, p),
                               cm_mad(cm_mad(g_rest, f_p, -(f_rest * g_p)), scale, q));
}

CM_FN CM_NAME(cm_pq) CM_NAME(cm_cobe_step)(CM_REAL p, CM_REAL q, CM_REAL u, CM_REAL v)
{
    CM_REAL x = p * p;
    CM_REAL y = q * q;
    return CM_NAME(cm_cobe_newton)(p, q, u, v, CM_NAME(cm_cobe_evaluate)(x, y),
                                   CM_NAME(cm_cobe_evaluate)(y, x));
}

CM_FN CM_NAME(cm_pq) CM_NAME(cm_cobe_inverse)(CM_REAL u, CM_REAL v, CM_NAME(cm_constants) k)
{
    CM_REAL x = u * u;
    CM_REAL y = v * v;
    CM_NAME(cm_pq) r =
        CM_NAME(cm_make_pq)(CM_NAME(cm_cobe_polynomial)(u, CM_NAME(cm_cobe_published)(x, y)),
                            CM_NAME(cm_cobe_polynomial)(v, CM_NAME(cm_cobe_published)(y, x)));
    if (!CM_VARIANT(k))
    {
        r = CM_NAME(cm_cobe_step)(r.p, r.q, u, v);
#if CM_REAL_BITS >= 64
        r = CM_NAME(cm_cobe_step)(r.p, r.q, u, v);
#endif
#if CM_REAL_BITS > 64
        r = CM_NAME(cm_cobe_step)(r.p, r.q, u, v);
        r = CM_NAME(cm_cobe_step)(r.p, r.q, u, v);
#endif
        r = CM_NAME(cm_make_pq)(cm_copysign(r.p, u), cm_copysign(r.q, v));
    }
    return r;
}

/* The derivatives of (F(p, q), F(q, p)), from the values as in cm_cobe_newton. */
CM_FN CM_NAME(cm_jacobian) CM_NAME(cm_cobe_matrix)(CM_REAL p, CM_REAL q, CM_NAME(cm_cobe_value) f,
                                                   CM_NAME(cm_cobe_value) g)
{
    CM_REAL x = p * p;
    CM_REAL y = q * q;
    CM_REAL x1 = (CM_LIT(1.0) - p) * (CM_LIT(1.0) + p);
    CM_REAL y1 = (CM_LIT(1.0) - q) * (CM_LIT(1.0) + q);
    CM_REAL cross = CM_LIT(2.0) * (p * q);
    return CM_NAME(cm_make_jacobian)(
        CM_LIT(1.0) + (x1 * f.b + CM_LIT(2.0) * x * (x1 * f.b_x - f.b)), cross * (x1 * f.b_y),
        cross * (y1 * g.b_y), CM_LIT(1.0) + (y1 * g.b + CM_LIT(2.0) * y * (y1 * g.b_x - g.b)));
}

/* That of the forward polynomial, in both variants. The published inverse is not the forward's, so the
 * matrix of its derivatives is not this one's inverse: their product differs from 1 by up to 0.7 %. */
CM_FN CM_NAME(cm_jacobian)
    CM_NAME(cm_cobe_jacobian)(CM_REAL p, CM_REAL q, CM_REAL u, CM_REAL v, CM_NAME(cm_constants) k)
{
    CM_UNUSED(u);
    CM_UNUSED(v);
    CM_UNUSED(k);
    CM_REAL x = p * p;
    CM_REAL y = q * q;
    return CM_NAME(cm_cobe_matrix)(p, q, CM_NAME(cm_cobe_evaluate)(x, y),
                                   CM_NAME(cm_cobe_evaluate)(y, x));
}

#endif
