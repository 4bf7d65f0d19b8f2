/* SPDX-License-Identifier: MIT
 *
 * square:conformal: the conformal mapping between disc and square (Schwarz-Christoffel).
 *
 * With W = u + iv, z = x + iy and K the complete elliptic integral of modulus 1 / sqrt(2),
 *     z = (2 / K) integral from 0 to W of dt / sqrt(1 + t^4).
 * In the octant 0 <= v <= u that is evaluated from whichever of three points is nearest:
 *     centre  z = (2 / K) W F(W^4)
 *     corner  1 + i - z = (2 sqrt(2) / K) e^(i pi / 4) sqrt(w) F(w^2), w = (1 - o) / (1 + o) with
 *             o = W e^(-i pi / 4): the corner is w = 0, and the integral has its old form again
 *     edge    1 - z = (2 sqrt(2) / K) s G(s^2), s = (1 - W) / (1 + W): the edge's middle is s = 0, the axis
 *             v = 0 is real, so that a small v keeps its digits
 * F(x) = sum binomial(-1/2, k) x^k / (4 k + 1), G(x) = sum P_k(-3) x^k / (2 k + 1) with Legendre's P, and the
 * inverse has their reversions. The rim is the line of real part 0 both of w and of s, which are
 * (rim, sqrt(2) gap) and (rim, -2 v) over something real, so that nothing cancels anywhere. Series of real
 * coefficients at a complex x are evaluated by the recurrence that takes two multiplications a term.
 * Cost: forward 24 terms, 3 roots, 4 divisions; inverse 12 terms, 1 division; besides the folding.
 */
#ifdef CM_DESCRIPTORS
/* clang-format off */
CM_SQUARE(conformal,
          .identifier = "square:conformal",
          .aliases = "square:schwarz-christoffel",
          .name = "conformal mapping between disc and square",
          .source = "Schwarz 1869; Fong 2015; Lambers 2016, section 2.5 (series derived here)",
          .kind = CM_KIND_DISC_SQUARE,
          .family = CM_FAMILY_BIVARIATE,
          .properties = CM_CONFORMAL,
          .smooth_face = CM_SMOOTH_ANALYTIC,
          .bounds = {.round_trip = 4.5, .plane_round_trip = 4.5, .forward = 3.25, .inverse = 2.25, .relative = 16})
/* clang-format on */
#else

#define CM_CONFORMAL_2_K CM_LIT(1.078705202376758713335871444711105465532)   /* 2 / K */
#define CM_CONFORMAL_2_K_1 CM_LIT(0.078705202376758713335871444711105465532) /* 2 / K - 1 */
#define CM_CONFORMAL_2R_K_1                                                                        \
    CM_LIT(0.525519527003626376124651961927231586585) /* 2 sqrt(2) / K - 1 */
#define CM_CONFORMAL_HALF_K CM_LIT(0.9270373386506859592169251735976300231088) /* K / 2 */
#define CM_CONFORMAL_HALF_K_1 CM_LIT(-0.0729626613493140407830748264023699768912)
#define CM_CONFORMAL_K2_8 CM_LIT(0.4296991136262733017181309862381598248688) /* K^2 / 8 */
#define CM_CONFORMAL_K_2R CM_LIT(0.6555143885730299526162098974727798534207) /* K / (2 sqrt(2)) */
#define CM_CONFORMAL_K_2R_1 CM_LIT(-0.3444856114269700473837901027525201465793)

/* One step of the recurrence b_k = a_k + 2 Re(x) b_(k+1) - |x|^2 b_(k+2). */
#define CM_CONFORMAL_STEP(a)                                                                       \
    b0 = cm_mad(twice, b1, cm_mad(minus, b2, a));                                                  \
    b2 = b1;                                                                                       \
    b1 = b0;

/* F(x) - 1, or G(x) - 1 at an edge. */
CM_FN CM_NAME(cm_complex) CM_NAME(cm_square_conformal_series)(CM_BOOL edge, CM_NAME(cm_complex) x)
{
#if CM_REAL_BITS == 128
    CM_NAME(cm_complex) power = CM_NAME(cm_make_complex)(CM_LIT(1.0), CM_LIT(0.0));
    CM_NAME(cm_complex) sum = CM_NAME(cm_make_complex)(CM_LIT(0.0), CM_LIT(0.0));
    CM_REAL binomial = CM_LIT(1.0);
    CM_REAL before = CM_LIT(0.0);
    CM_REAL legendre = CM_LIT(1.0);
    for (int k = 0; k < 64; k++)
    {
        CM_REAL next = (CM_LIT(-3.0) * (2 * k + 1) * legendre - k * before) / (k + 1);
        before = legendre;
        legendre = next;
        binomial = binomial * (-(k + CM_LIT(0.5)) / (k + 1));
        CM_REAL a = edge ? legendre / (2 * k + 3) : binomial / (4 * k + 5);
        power = CM_NAME(cm_complex_multiply)(power, x);
        sum.re = sum.re + a * power.re;
        sum.im = sum.im + a * power.im;
    }
    return sum;
#else
    CM_REAL twice = CM_LIT(2.0) * x.re;
    CM_REAL minus = -(x.re * x.re + x.im * x.im);
    CM_REAL b0;
    CM_REAL b1;
    CM_REAL b2 = CM_LIT(0.0);
#if CM_REAL_BITS == 64
    b1 = CM_SELECT(edge, CM_LIT(-1024281808551729.0), CM_LIT(-1.25810847180218843e-3));
    CM_CONFORMAL_STEP(CM_SELECT(edge, CM_LIT(187631425803692.733), CM_LIT(1.34386717662166345e-3)))
    CM_CONFORMAL_STEP(CM_SELECT(edge, CM_LIT(-34473865447161.0), CM_LIT(-1.43983142644334721e-3)))
    CM_CONFORMAL_STEP(CM_SELECT(edge, CM_LIT(6354727165791.2439), CM_LIT(1.54778626690838589e-3)))
    CM_CONFORMAL_STEP(
        CM_SELECT(edge, CM_LIT(-1175626408075.46154), CM_LIT(-1.66993922903202474e-3)))
    CM_CONFORMAL_STEP(CM_SELECT(edge, CM_LIT(218359920482.945946), CM_LIT(1.80904930919944628e-3)))
    CM_CONFORMAL_STEP(CM_SELECT(edge, CM_LIT(-40738134983.4), CM_LIT(-1.96860521100461483e-3)))
    CM_CONFORMAL_STEP(CM_SELECT(edge, CM_LIT(7638037473.0), CM_LIT(2.15307590909875356e-3)))
    CM_CONFORMAL_STEP(CM_SELECT(edge, CM_LIT(-1440076833.0), CM_LIT(-2.36826964089127838e-3)))
    CM_CONFORMAL_STEP(CM_SELECT(edge, CM_LIT(273236146.655172414), CM_LIT(2.62185931205749512e-3)))
    CM_CONFORMAL_STEP(
        CM_SELECT(edge, CM_LIT(-52219763.6666666667), CM_LIT(-2.92417013420248931e-3)))
    CM_CONFORMAL_STEP(CM_SELECT(edge, CM_LIT(10063838.76), CM_LIT(3.28939301627022879e-3)))
    CM_CONFORMAL_STEP(CM_SELECT(edge, CM_LIT(-1958553.0), CM_LIT(-3.73751322428385417e-3)))
    CM_CONFORMAL_STEP(CM_SELECT(edge, CM_LIT(385593.0), CM_LIT(4.2974890732183689e-3)))
#else
    b1 = CM_SELECT(edge, CM_LIT(385593.0), CM_LIT(4.2974890732183689e-3));
#endif
    CM_CONFORMAL_STEP(CM_SELECT(edge, CM_LIT(-76977.0), CM_LIT(-5.01271840688344595e-3)))
    CM_CONFORMAL_STEP(CM_SELECT(edge, CM_LIT(15631.1176470588235), CM_LIT(5.950927734375e-3)))
    CM_CONFORMAL_STEP(CM_SELECT(edge, CM_LIT(-3242.6), CM_LIT(-7.22319504310344828e-3)))
    CM_CONFORMAL_STEP(CM_SELECT(edge, CM_LIT(691.461538461538462), CM_LIT(9.0234375e-3)))
    CM_CONFORMAL_STEP(CM_SELECT(edge, CM_LIT(-153.0), CM_LIT(-0.01171875)))
    CM_CONFORMAL_STEP(CM_SELECT(edge, CM_LIT(35.6666666666666667), CM_LIT(0.0160845588235294118)))
    CM_CONFORMAL_STEP(CM_SELECT(edge, CM_LIT(-9.0), CM_LIT(-0.0240384615384615385)))
    CM_CONFORMAL_STEP(CM_SELECT(edge, CM_LIT(2.6), CM_LIT(0.0416666666666666667)))
    CM_CONFORMAL_STEP(CM_SELECT(edge, CM_LIT(-1.0), CM_LIT(-0.1)))
    return CM_NAME(cm_make_complex)(cm_mad(x.re, b1, minus * b2), b1 * x.im);
#endif
}

/* scale factor (1 + rest), with one rounding of what is nearly factor; more is scale - 1. */
CM_FN CM_NAME(cm_complex) CM_NAME(cm_square_conformal_grow)(CM_NAME(cm_complex) factor,
                                                            CM_NAME(cm_complex) rest, CM_REAL more)
{
    CM_REAL scale = CM_LIT(1.0) + more;
    rest.re = cm_mad(scale, rest.re, more);
    rest.im = scale * rest.im;
    CM_NAME(cm_complex) product = CM_NAME(cm_complex_multiply)(factor, rest);
    return CM_NAME(cm_make_complex)(factor.re + product.re, factor.im + product.im);
}

/* The point of expansion, and the variable there, in the octant 0 <= v <= u. */
CM_STRUCT(cm_square_conformal_place)
{
    CM_BOOL centre;
    CM_BOOL edge;               /* neither: corner */
    CM_NAME(cm_complex) base;   /* W^2, s or w: the series' argument is its square */
    CM_NAME(cm_complex) factor; /* W, s or (1 + i) sqrt(w) */
}
CM_STRUCT_END(cm_square_conformal_place)

/* u, v, and the point's rim and |gap| */
CM_FN CM_NAME(cm_square_conformal_place)
    CM_NAME(cm_square_conformal_locate)(CM_REAL u, CM_REAL v, CM_REAL rim, CM_REAL gap)
{
    CM_REAL root2 = CM_LIT(1.41421356237309504880168872420969807857);
    CM_REAL one = CM_LIT(1.0);
    CM_REAL sum = u + v;
    CM_REAL corner_over = one / ((one + root2 * sum) + (sum * sum + gap * gap) * CM_LIT(0.5));
    CM_NAME(cm_complex) w =
        CM_NAME(cm_make_complex)(rim * corner_over, (root2 * gap) * corner_over);
    CM_REAL length = cm_sqrt(w.re * w.re + w.im * w.im);
    length = cm_max(length, cm_max(w.re, w.im)); /* whose squares may be 0 */
    CM_REAL s_sum = cm_sqrt(length + w.im);
    CM_REAL s_difference = CM_SELECT(cm_less(w.im, w.re * CM_LIT(1.0e-40)), s_sum,
                                     w.re / CM_SELECT(cm_less(CM_LIT(0.0), s_sum), s_sum, one));

    CM_NAME(cm_square_conformal_place) r;
    r.centre = cm_at_least(rim, CM_LIT(0.5));
    r.edge = cm_both(cm_less(rim, CM_LIT(0.5)), cm_less(v, CM_LIT(0.25) * u));
    CM_REAL edge_over = one / ((one + u) * (one + u) + v * v);
    CM_NAME(cm_complex) s =
        CM_NAME(cm_make_complex)(rim * edge_over, CM_LIT(-2.0) * (v * edge_over));
    r.base.re = CM_SELECT(r.centre, gap * sum, CM_SELECT(r.edge, s.re, w.re));
    r.base.im = CM_SELECT(r.centre, CM_LIT(2.0) * (u * v), CM_SELECT(r.edge, s.im, w.im));
    r.factor.re = CM_SELECT(r.centre, u, CM_SELECT(r.edge, s.re, s_difference));
    r.factor.im = CM_SELECT(r.centre, v, CM_SELECT(r.edge, s.im, s_sum));
    return r;
}

CM_FN CM_NAME(cm_uv) CM_NAME(cm_square_conformal_forward)(CM_NAME(cm_disc_point) d)
{
    CM_BOOL u_wins = cm_at_least(d.gap, CM_LIT(0.0));
    CM_REAL u = CM_SELECT(u_wins, cm_abs(d.u), cm_abs(d.v));
    CM_REAL v = CM_SELECT(u_wins, cm_abs(d.v), cm_abs(d.u));
    CM_NAME(cm_square_conformal_place) at =
        CM_NAME(cm_square_conformal_locate)(u, v, d.rim, cm_abs(d.gap));
    CM_NAME(cm_complex) series =
        CM_NAME(cm_square_conformal_series)(at.edge, CM_NAME(cm_complex_square)(at.base));
    CM_NAME(cm_complex) z = CM_NAME(cm_square_conformal_grow)(
        at.factor, series, CM_SELECT(at.edge, CM_CONFORMAL_2R_K_1, CM_CONFORMAL_2_K_1));
    CM_REAL x = CM_SELECT(at.centre, z.re, CM_LIT(1.0) - z.re);
    CM_REAL y = CM_SELECT(at.centre, z.im, CM_SELECT(at.edge, -z.im, CM_LIT(1.0) - z.im));
    /* rounding may not lead out of the octant */
    x = cm_min(x, CM_LIT(1.0));
    return CM_NAME(cm_disc_unfold)(u_wins, x, cm_max(CM_LIT(0.0), cm_min(y, x)), d.u, d.v);
}

/* The same of the reversions, less 1: W of (K / 2) z by its fourth power, s and w by their squares. */
CM_FN CM_NAME(cm_complex)
    CM_NAME(cm_square_conformal_reversion)(CM_BOOL centre, CM_BOOL edge, CM_NAME(cm_complex) x)
{
    CM_REAL twice = CM_LIT(2.0) * x.re;
    CM_REAL minus = -(x.re * x.re + x.im * x.im);
    CM_REAL b0;
    CM_REAL b1;
    CM_REAL b2 = CM_LIT(0.0);
#define CM_CONFORMAL_PICK(g, q, h)                                                                 \
    CM_SELECT(centre, CM_LIT(g), CM_SELECT(edge, CM_LIT(q), CM_LIT(h)))
#if CM_REAL_BITS >= 64
    b1 =
        CM_CONFORMAL_PICK(1.85441853903597156e-12, 3.00693815987933635e-3, 2.53542736565007208e-11);
    CM_CONFORMAL_STEP(
        CM_CONFORMAL_PICK(2.19137473396006082e-11, 5.17083961789844143e-3, 2.7411364886546464e-10))
    CM_CONFORMAL_STEP(
        CM_CONFORMAL_PICK(2.58955738607682374e-10, 8.90497737556561086e-3, 2.93789115611369244e-9))
    CM_CONFORMAL_STEP(
        CM_CONFORMAL_PICK(3.06009161823495183e-9, 0.0152760180995475113, 3.1156454377476286e-8))
    CM_CONFORMAL_STEP(
        CM_CONFORMAL_PICK(3.61612403808924327e-8, 0.0260512820512820513, 3.26099826677139831e-7))
    CM_CONFORMAL_STEP(
        CM_CONFORMAL_PICK(4.27319004524886878e-7, 0.0451282051282051282, 3.35630583594384499e-6))
#else
    b1 = CM_CONFORMAL_PICK(4.27319004524886878e-7, 0.0451282051282051282, 3.35630583594384499e-6);
#endif
    CM_CONFORMAL_STEP(CM_CONFORMAL_PICK(5.04964806435394671e-6, 0.08, 3.37858220211161388e-5))
    CM_CONFORMAL_STEP(
        CM_CONFORMAL_PICK(5.96719457013574661e-5, 0.133333333333333333, 3.29813976872800402e-4))
    CM_CONFORMAL_STEP(CM_CONFORMAL_PICK(7.05128205128205128e-4, 0.2, 3.07692307692307692e-3))
    CM_CONFORMAL_STEP(CM_CONFORMAL_PICK(8.33333333333333333e-3, 0.4, 0.0266666666666666667))
    CM_CONFORMAL_STEP(CM_CONFORMAL_PICK(0.1, 1.0, 0.2))
    return CM_NAME(cm_make_complex)(cm_mad(x.re, b1, minus * b2), b1 * x.im);
#undef CM_CONFORMAL_PICK
}

#if CM_REAL_BITS > 64
/* A Newton step of the reversion, by the series of forward: value is W, s or w, target what it is of. */
CM_FN CM_NAME(cm_complex)
    CM_NAME(cm_square_conformal_step)(CM_BOOL centre, CM_BOOL edge, CM_NAME(cm_complex) target,
                                      CM_NAME(cm_complex) value)
{
    CM_NAME(cm_complex) square = CM_NAME(cm_complex_square)(value);
    CM_NAME(cm_complex) fourth = CM_NAME(cm_complex_square)(square);
    CM_NAME(cm_complex) f = CM_NAME(cm_square_conformal_series)(edge, centre ? fourth : square);
    f.re = f.re + CM_LIT(1.0);
    CM_NAME(cm_complex) of_value = CM_NAME(cm_complex_multiply)(value, f);
    CM_NAME(cm_complex) radicand = CM_NAME(cm_make_complex)(CM_LIT(1.0) + square.re, square.im);
    if (centre || edge)
    {
        radicand = fourth;
        radicand.re += CM_LIT(1.0) + (edge ? 6 * square.re : CM_LIT(0.0));
        radicand.im += edge ? 6 * square.im : CM_LIT(0.0);
    }
    else
    {
        of_value = CM_NAME(cm_complex_multiply)(of_value, f);
    }
    CM_NAME(cm_complex) rest =
        CM_NAME(cm_make_complex)(target.re - of_value.re, target.im - of_value.im);
    rest = CM_NAME(cm_complex_multiply)(rest, CM_NAME(cm_complex_root)(radicand));
    if (!centre && !edge)
    {
        rest = CM_NAME(cm_complex_multiply)(rest, CM_NAME(cm_complex_inverse)(f));
    }
    return CM_NAME(cm_make_complex)(value.re + rest.re, value.im + rest.im);
}
#endif

CM_FN CM_NAME(cm_disc_point) CM_NAME(cm_square_conformal_inverse)(CM_REAL x, CM_REAL y)
{
    CM_REAL one = CM_LIT(1.0);
    CM_BOOL x_wins = cm_at_least(cm_abs(x), cm_abs(y));
    CM_REAL a = cm_max(cm_abs(x), cm_abs(y));
    CM_REAL b = cm_min(cm_abs(x), cm_abs(y));
    CM_REAL a1 = one - a;
    CM_REAL b1 = one - b;
    CM_REAL distance = a * a + b * b;
    CM_BOOL centre = cm_at_least(CM_LIT(0.6), distance);
    CM_BOOL edge = cm_both(cm_less(CM_LIT(0.6), distance), cm_less(b, CM_LIT(0.35) * a));

    CM_NAME(cm_complex) t =
        CM_NAME(cm_make_complex)(CM_CONFORMAL_HALF_K * a, CM_CONFORMAL_HALF_K * b);
    CM_NAME(cm_complex) t2 = CM_NAME(cm_complex_square)(t);
    CM_NAME(cm_complex) target;
    target.re =
        CM_SELECT(edge, CM_CONFORMAL_K_2R * a1, (CM_CONFORMAL_K2_8 * a1) * (CM_LIT(2.0) * b1));
    target.im =
        CM_SELECT(edge, -(CM_CONFORMAL_K_2R * b), CM_CONFORMAL_K2_8 * ((a - b) * (a1 + b1)));
    CM_NAME(cm_complex) base = CM_NAME(cm_make_complex)(CM_SELECT(centre, t2.re, target.re),
                                                        CM_SELECT(centre, t2.im, target.im));
    CM_NAME(cm_complex) factor;
    factor.re = CM_SELECT(centre, a, CM_SELECT(edge, a1, target.re));
    factor.im = CM_SELECT(centre, b, CM_SELECT(edge, -b, target.im));
    CM_NAME(cm_complex) w = CM_NAME(cm_square_conformal_grow)(
        factor,
        CM_NAME(cm_square_conformal_reversion)(centre, edge, CM_NAME(cm_complex_square)(base)),
        CM_SELECT(centre, CM_CONFORMAL_HALF_K_1,
                  CM_SELECT(edge, CM_CONFORMAL_K_2R_1, CM_LIT(0.0))));
#if CM_REAL_BITS > 64
    target.re = CM_SELECT(centre, t.re, target.re);
    target.im = CM_SELECT(centre, t.im, target.im);
    w = CM_NAME(cm_square_conformal_step)(centre, edge, target, w);
#endif

    /* w is W, s or w; o and W follow from the last two in the same way */
    CM_REAL square = w.re * w.re + w.im * w.im;
    CM_REAL over = one / (((one + w.re) * (one + w.re)) + w.im * w.im);
    CM_REAL along = ((one - square) * over);
    CM_REAL across = CM_LIT(2.0) * (w.im * over);
    CM_REAL half_root2 = CM_LIT(0.7071067811865475244008443621048490392848);
    CM_REAL u = CM_SELECT(centre, w.re, CM_SELECT(edge, along, half_root2 * (along + across)));
    CM_REAL v = CM_SELECT(centre, w.im, CM_SELECT(edge, -across, half_root2 * (along - across)));
    CM_REAL rim = CM_SELECT(centre, one - square, CM_LIT(4.0) * (w.re * over));
    /* the rim is the more accurate there */
    CM_REAL excess = CM_NAME(cm_disc_rim)(u, v) - rim;
    CM_REAL longer = CM_SELECT(centre, CM_LIT(0.0), CM_LIT(0.5) * (excess + excess * rim));
    u = u + u * longer;
    v = v + v * longer;
    CM_REAL gap = CM_SELECT(
        centre, u - v,
        CM_SELECT(edge, u - v, CM_LIT(1.41421356237309504880168872420969807857) * across));
    return CM_NAME(cm_disc_unfold_point)(x_wins, u, v, rim, gap, x, y);
}

/* dz / dW = (2 / K) / sqrt(1 + W^4), of which the real part is, with p = 2 |u v|,
 * (1 - p) (1 + p) + (u^2 - v^2)^2, and 1 - p = rim + gap^2. It is infinite at the corners. */
CM_FN CM_NAME(cm_jacobian)
    CM_NAME(cm_square_conformal_jacobian)(CM_NAME(cm_disc_point) d, CM_REAL x, CM_REAL y)
{
    CM_UNUSED(x);
    CM_UNUSED(y);
    CM_REAL product = CM_LIT(2.0) * (d.u * d.v);
    CM_REAL difference = d.gap * (cm_abs(d.u) + cm_abs(d.v)); /* u^2 - v^2 */
    CM_REAL re =
        (d.rim + d.gap * d.gap) * (CM_LIT(1.0) + cm_abs(product)) + difference * difference;
    CM_REAL im = CM_LIT(2.0) * (product * difference);
    CM_NAME(cm_complex) slope =
        CM_NAME(cm_complex_inverse)(CM_NAME(cm_complex_root)(CM_NAME(cm_make_complex)(re, im)));
    CM_REAL a = CM_CONFORMAL_2_K * slope.re;
    CM_REAL b = CM_CONFORMAL_2_K * slope.im;
    return CM_NAME(cm_make_jacobian)(a, -b, b, a);
}

#endif
